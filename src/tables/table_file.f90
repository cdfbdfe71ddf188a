!> Reader of the file of a table of creep forces; its layout is described in doc/theory/tables.md
module contact_tables_table_file
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use, intrinsic :: iso_c_binding, only : c_int
   use, intrinsic :: iso_fortran_env, only : int32, int64, real32, real64
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : long, wp
   use contact_base_system, only : close_descriptor, open_input, read_input
   use contact_tables_axis, only : make_axis, order, spline_axis
   use contact_tables_creep_table, only : creep_table, values_per_node
   use contact_text_sha256, only : sha256
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: read_table

   !> First bytes of a file, and length of the checksum at its end
   character(len=*), parameter :: magic = "CONTACT table 2" // new_line("a")
   integer, parameter :: digits = 64
   !> Bytes before the knots; number of integers and of real numbers in them
   integer, parameter :: head_bytes = 128, wholes = 8, reals = 9
   !> Bytes per number
   integer, parameter :: real_bytes = 8, short_bytes = 4
   !> Maximum file size [bytes], maximum number of coefficients along an axis: limits of 32-bit indices
   integer(long), parameter :: longest = 2000000000_long
   integer, parameter :: max_along = 10000

contains

   !> Read a table
   subroutine read_table(file, table, error)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> Splines over all axes, as in the file
      type(creep_table), intent(out) :: table
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: text, reason
      integer(c_int) :: descriptor
      integer(long) :: length, done

      call open_input(file, descriptor, length, reason)
      if (allocated(reason)) then
         call fatal_error(error, "the table " // file // " cannot be opened: " // reason, kind=error_kind%file)
         return
      end if
      if (length > longest) then
         reason = "it is longer than 2 GB"
      else
         allocate(character(len=length) :: text)
         call read_input(descriptor, text, done, reason)
         if (.not. allocated(reason) .and. done < length) reason = "it ended while it was read"
      end if
      call close_descriptor(descriptor)
      if (.not. allocated(reason)) call parse_table(text, table, reason)
      if (allocated(reason)) call fatal_error(error, "the table " // file // " cannot be used: " // reason, kind=error_kind%file)
   end subroutine read_table

   !> Parse the bytes of a file
   subroutine parse_table(text, table, reason)
      character(len=*), intent(in) :: text
      type(creep_table), intent(inout) :: table
      !> What is wrong; unallocated if nothing
      character(len=:), allocatable, intent(out) :: reason
      integer(int32) :: whole(wholes)
      integer(int64) :: length
      real(real64) :: number(reals)
      integer(long) :: place
      logical :: is_good(5)

      if (len(text) < head_bytes + digits) then
         reason = "it is too short to be a table"
      else if (text(:len(magic)) /= magic) then
         reason = "it does not start like a table of this version, 'CONTACT table 2'"
      else
         length = transfer(text(49:56), length)
         if (length /= len(text)) then
            reason = "it is damaged: it has " // integer_text(len(text)) // " bytes, which is not the size that it states"
         else if (sha256(text(:len(text) - digits)) /= text(len(text) - digits + 1:)) then
            reason = "it is damaged: its checksum does not match its content"
         end if
      end if
      if (allocated(reason)) return
      whole = transfer(text(17:48), whole)
      number = transfer(text(57:head_bytes), number)
      table%has_offset = whole(1) == 2
      table%elements = whole(7)
      table%discretisation = whole(8)
      table%nu = number(1)
      table%required = number(2)
      table%error_force = number(3)
      table%error_moment = number(4)
      table%checked = number(5)
      table%band = number(6)
      table%grid_force = number(7)
      table%grid_moment = number(8)
      reason = "its content is invalid; it was not written by this program"
      if (whole(1) < 1 .or. whole(1) > 2 .or. any(whole(2:6) < 1 .or. whole(2:6) > max_along)) return
      ! their product would overflow for more; without rounding, as it is far from the limit of an integer
      if (product(real(whole(2:6), wp)) > longest) return
      if (.not. all(ieee_is_finite(number))) return
      if (table%band <= 0.0_wp .or. table%band >= 1.0_wp) return
      place = head_bytes
      call parse_axis(text, place, whole(2), table%shape, is_good(1))
      call parse_axis(text, place, whole(3), table%offset, is_good(2))
      call parse_axis(text, place, whole(4), table%x, is_good(3))
      call parse_axis(text, place, whole(5), table%y, is_good(4))
      call parse_axis(text, place, whole(6), table%z, is_good(5))
      if (.not. all(is_good) .or. any(whole(4:6) < order)) return
      ! the axis of spin begins at no spin
      if (table%z%high <= 0.0_wp) return
      length = values_per_node*product(int(whole(2:6), long))
      if (place + short_bytes*length + digits /= len(text, long)) return
      call parse_coefficients(text, place, length, table, is_good(1))
      if (is_good(1)) deallocate(reason)
   end subroutine parse_table

   !> Parse the knots of an axis
   subroutine parse_axis(text, place, count, axis, is_good)
      character(len=*), intent(in) :: text
      !> Position in the text [bytes]; advanced
      integer(long), intent(inout) :: place
      integer(int32), intent(in) :: count
      type(spline_axis), intent(inout) :: axis
      logical, intent(out) :: is_good
      real(real64) :: knots(count + order)
      integer(long) :: length

      length = 0
      if (count > 1) length = real_bytes*int(count + order, long)
      is_good = place + length + digits <= len(text, long)
      if (.not. is_good) return
      if (count > 1) knots = transfer(text(place + 1:place + length), knots)
      call make_axis(axis, int(count), knots, is_good)
      place = place + length
   end subroutine parse_axis

   !> Parse the coefficients
   subroutine parse_coefficients(text, place, length, table, is_good)
      character(len=*), intent(in) :: text
      integer(long), intent(in) :: place, length
      type(creep_table), intent(inout) :: table
      !> Are all of them finite?
      logical, intent(out) :: is_good
      real(real32) :: node(values_per_node)
      integer(long) :: k, from, bytes

      allocate(table%coefficients(length))
      is_good = .true.
      bytes = short_bytes*values_per_node
      do k = 0, length/values_per_node - 1
         from = place + k*bytes
         node = transfer(text(from + 1:from + bytes), node)
         is_good = is_good .and. all(ieee_is_finite(node))
         table%coefficients(values_per_node*k + 1:values_per_node*(k + 1)) = node
      end do
   end subroutine parse_coefficients
end module contact_tables_table_file
