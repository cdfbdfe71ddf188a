!> C interface: creep forces from tables; see include/contact.h
module contact_capi_table
   use, intrinsic :: ieee_arithmetic, only : ieee_positive_inf, ieee_value
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_f_pointer, c_int, c_loc, c_null_ptr, c_ptr
   use contact_base_error, only : error_type
   use contact_base_guard, only : cause_text, do_guarded, free_left_blocks, guard_end, new_owner
   use contact_capi_arguments, only : copy_text, set_message
   use contact_capi_host, only : give_floats_back, hold_floats
   use contact_tables_creep_table, only : creep_table, find_creep_force, lookup_status, max_spin
   use contact_tables_table_file, only : read_table
   implicit none (type, external)
   private

   public :: contact_table_open, contact_table_close, contact_table_about, contact_table_force, &
      & contact_table_force_derivatives, contact_table_forces

   !> Data of a contact, contact_table_patch of the header
   type, bind(c) :: patch_type
      real(c_double) :: fn, mu, gg, aa, bneg, bpos
   end type patch_type

   !> Properties of a table, contact_table_facts of the header
   type, bind(c) :: facts_type
      integer(c_int) :: has_offset, elements, order
      real(c_double) :: poisson, ratio(2), offset, spin, asked, error(2), points, grid_error(2), bytes
   end type facts_type

   !> A call, passed to the guarded procedures
   type :: request_type
      type(c_ptr) :: file = c_null_ptr
      type(creep_table), pointer :: table => null()
      type(error_type), allocatable :: error
   end type request_type

contains

   !> Read a table; null if it cannot be used
   function contact_table_open(file, message, length) result(handle) bind(c, name="contact_table_open")
      type(c_ptr), value :: file, message
      integer(c_int), value :: length
      type(c_ptr) :: handle
      type(request_type), target :: request
      integer :: cause, owner

      handle = c_null_ptr
      call set_message("", message, length)
      request%file = file
      owner = new_owner()
      call hold_floats()
      call do_guarded(read_inside, c_loc(request), owner, cause)
      call give_floats_back()
      if (cause /= guard_end%done) then
         call free_left_blocks(owner)
         call set_message(trim(cause_text(cause)) // " for the table", message, length)
      else if (allocated(request%error)) then
         call set_message(request%error%message, message, length)
      else
         handle = c_loc(request%table)
      end if
   end function contact_table_open

   !> Read it under the guard
   subroutine read_inside(data) bind(c)
      !> A request_type
      type(c_ptr), value :: data
      type(request_type), pointer :: request
      character(len=:), allocatable :: file

      call c_f_pointer(data, request)
      call copy_text(request%file, file)
      allocate(request%table)
      call read_table(file, request%table, request%error)
      if (allocated(request%error)) deallocate(request%table)
   end subroutine read_inside

   !> Free a table; nothing if null
   subroutine contact_table_close(handle) bind(c, name="contact_table_close")
      type(c_ptr), value :: handle
      type(creep_table), pointer :: table

      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, table)
      deallocate(table)
   end subroutine contact_table_close

   !> Properties of a table
   function contact_table_about(handle, facts) result(status) bind(c, name="contact_table_about")
      type(c_ptr), value :: handle
      type(facts_type), intent(out), optional :: facts
      !> 0, or 1 if there is no table
      integer(c_int) :: status
      type(creep_table), pointer :: table

      status = 1_c_int
      if (.not. (c_associated(handle) .and. present(facts))) return
      call c_f_pointer(handle, table)
      facts%has_offset = merge(1_c_int, 0_c_int, table%has_offset)
      facts%elements = int(table%elements, c_int)
      facts%order = int(table%discretisation, c_int)
      facts%poisson = table%nu
      facts%ratio = exp([table%shape%low, table%shape%high])
      facts%offset = table%offset%high
      facts%spin = max_spin(table)
      if (facts%spin >= huge(facts%spin)) facts%spin = ieee_value(facts%spin, ieee_positive_inf)
      facts%asked = table%required
      facts%error = [table%error_force, table%error_moment]
      facts%points = table%checked
      facts%grid_error = [table%grid_force, table%grid_moment]
      facts%bytes = real(storage_size(table%coefficients)/8*size(table%coefficients, kind=8), c_double)
      status = 0_c_int
   end function contact_table_about

   !> Forces of a contact
   function contact_table_force(handle, patch, creepage, force) result(status) bind(c, name="contact_table_force")
      type(c_ptr), value :: handle
      type(patch_type), intent(in), optional :: patch
      real(c_double), intent(in), optional :: creepage(3)
      real(c_double), intent(out), optional :: force(3)
      !> CONTACT_TABLE_INSIDE, _OUTSIDE, _WRONG
      integer(c_int) :: status
      type(creep_table), pointer :: table
      integer :: found

      status = int(lookup_status%invalid, c_int)
      if (.not. present(force)) return
      force = 0.0_c_double
      if (.not. (c_associated(handle) .and. present(patch) .and. present(creepage))) return
      call c_f_pointer(handle, table)
      call find_creep_force(table, patch%fn, patch%mu, patch%gg, patch%aa, patch%bneg, patch%bpos, creepage, force, found)
      status = int(found, c_int)
   end function contact_table_force

   !> Forces of a contact and their derivatives with respect to the creepages
   function contact_table_force_derivatives(handle, patch, creepage, force, derivatives) result(status) &
      & bind(c, name="contact_table_force_derivatives")
      type(c_ptr), value :: handle
      type(patch_type), intent(in), optional :: patch
      real(c_double), intent(in), optional :: creepage(3)
      real(c_double), intent(out), optional :: force(3), derivatives(3, 3)
      !> CONTACT_TABLE_INSIDE, _OUTSIDE, _WRONG
      integer(c_int) :: status
      type(creep_table), pointer :: table
      real(c_double) :: slopes(3, 3)
      integer :: found

      status = int(lookup_status%invalid, c_int)
      if (.not. (present(force) .and. present(derivatives))) return
      force = 0.0_c_double
      derivatives = 0.0_c_double
      if (.not. (c_associated(handle) .and. present(patch) .and. present(creepage))) return
      call c_f_pointer(handle, table)
      call find_creep_force(table, patch%fn, patch%mu, patch%gg, patch%aa, patch%bneg, patch%bpos, creepage, force, found, &
         & slopes)
      derivatives = transpose(slopes)
      status = int(found, c_int)
   end function contact_table_force_derivatives

   !> Forces of many contacts
   function contact_table_forces(handle, count, patches, creepages, forces, derivatives, answers) result(worst) &
      & bind(c, name="contact_table_forces")
      type(c_ptr), value :: handle
      integer(c_int), value :: count
      type(patch_type), intent(in), optional :: patches(*)
      real(c_double), intent(in), optional :: creepages(3, *)
      real(c_double), intent(inout), optional :: forces(3, *)
      type(c_ptr), value :: derivatives, answers
      !> The largest of CONTACT_TABLE_INSIDE, _OUTSIDE, _WRONG
      integer(c_int) :: worst
      real(c_double), pointer :: slopes(:, :, :)
      integer(c_int), pointer :: endings(:)
      real(c_double) :: one(3, 3)
      integer(c_int) :: ended
      integer :: k

      worst = int(lookup_status%invalid, c_int)
      if (count < 0 .or. .not. (present(patches) .and. present(creepages) .and. present(forces))) return
      worst = int(lookup_status%inside, c_int)
      if (c_associated(derivatives)) call c_f_pointer(derivatives, slopes, [3, 3, int(count)])
      if (c_associated(answers)) call c_f_pointer(answers, endings, [int(count)])
      do k = 1, count
         if (c_associated(derivatives)) then
            ended = contact_table_force_derivatives(handle, patches(k), creepages(:, k), forces(:, k), one)
            slopes(:, :, k) = one
         else
            ended = contact_table_force(handle, patches(k), creepages(:, k), forces(:, k))
         end if
         if (c_associated(answers)) endings(k) = ended
         worst = max(worst, ended)
      end do
   end function contact_table_forces
end module contact_capi_table
