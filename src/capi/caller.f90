!> Call of a library routine: the archive that reads values of a case from the caller's arrays, and the buffers of results
module contact_capi_caller
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_f_pointer, c_int, c_null_ptr, c_ptr
   use contact_base_kinds, only : long, wp
   use contact_capi_arguments, only : no_number, raised
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : report_error, count_fits, warn
   use contact_cases_archive, only : case_archive
   use contact_control_units, only : inward, quantity_of, unit_convention
   use contact_text_bounds, only : bounds_table, describe_breach, is_within
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: caller, integer_list, min_value, real_list, result_buffer

   !> Maximum number of scalar real arguments of a routine
   integer, parameter, public :: max_single_reals = 8

   !> A number that is raised to the minimum required by the models instead of being refused; not if it is negative or NaN
   type :: raised_number
      character(len=6) :: name
      real(wp) :: least
   end type raised_number
   !> Coefficients of friction, factors of slope reduction [-], slip velocities [mm/s], curvatures [1/mm], thickness [mm], step of
   !> depths [mm]
   type(raised_number), parameter :: raised_numbers(*) = [raised_number("FSTAT", 1.0e-6_wp), raised_number("FKIN", 1.0e-6_wp), &
      & raised_number("FREF", 1.0e-6_wp), raised_number("SABSH1", 1.0e-4_wp), raised_number("SABSH2", 1.0e-4_wp), &
      & raised_number("K0_MF", 1.0e-6_wp), raised_number("ALFAMF", 1.0e-6_wp), raised_number("BETAMF", 1.0e-6_wp), &
      & raised_number("A1", 1.0e-12_wp), raised_number("B1", 1.0e-12_wp), raised_number("LAYTHK", 1.0e-9_wp), &
      & raised_number("DZ", 1.0e-9_wp)]

   !> The largest one of these minima
   real(wp), parameter :: highest_least = maxval(raised_numbers%least)

   !> Arrays of the caller, accessed in place and never written to
   type :: integer_list
      integer, pointer :: v(:) => null()
   end type integer_list
   type :: real_list
      real(wp), pointer :: v(:) => null()
   end type real_list

   !> Buffer of a result
   type :: result_buffer
      type(c_ptr) :: address = c_null_ptr
      !> Number of elements of the buffer; 0 if the caller gave a null pointer
      integer :: length = 0
   end type result_buffer

   !> Number of values that a setting requires, and has read
   type :: tally
      !> Number of required values, of optional values, and of optional values that remain
      integer :: needed = 0, optional = 0, spare = 0
      integer :: taken = 0
   contains
      procedure :: count_next
   end type tally

   !> Call of a routine
   !>
   !> A setting reads its numbers in order, and the first invalid one is reported. It is described between `do while
   !> (a%next_pass())` and `end do`, and stored if `is_good` after the loop: the first pass counts the required numbers, and if the
   !> caller gave as many, the second pass reads them. Other routines access the components directly, and return results with
   !> `set_result`.
   type, extends(case_archive) :: caller
      type(entry_type) :: call_of
      !> Units of the caller
      type(unit_convention) :: units
      !> Scalar integers; the first one is the number of the method or option, if there is one
      integer :: single(2) = no_number
      !> Lists of integers and of real numbers; scalar real arguments are the first list
      type(integer_list) :: integers(2)
      type(real_list) :: numbers(3)
      !> Values of the scalar real arguments
      real(wp) :: single_reals(max_single_reals) = 0.0_wp
      !> Is there a list of integers? If not, integers are in the list of real numbers
      logical :: has_integers = .false.
      !> Name of a file
      character(len=:), allocatable :: path
      !> Buffers of the results of the routine, in their order
      type(result_buffer) :: buffers(4)
      !> Is the next number optional? If missing, its value is unchanged
      logical :: may_miss = .false.
      integer, private :: pass = 0
      type(tally), private :: integer_tally, real_tally
   contains
      procedure :: next_pass
      procedure :: skip
      procedure :: refuse_call
      procedure :: end_line => set_line
      procedure :: list => set_list
      procedure :: report => report_number
      procedure :: fail => refuse_number
      procedure :: check => check_number
      !> Return a list, or one number per result; lists are truncated to the size of the buffer
      generic :: set_result => set_numbers, set_integers
      generic :: set_each_result => set_each_number, set_each_integer
      !> Buffer of a result
      procedure :: numbers_at
      procedure :: integers_at
      procedure, private :: set_numbers, set_integers, set_each_number, set_each_integer
   end type caller

contains

   !> Is there another pass? The first counts the numbers, the second reads them
   logical function next_pass(self)
      class(caller), intent(inout) :: self

      self%pass = self%pass + 1
      self%is_reading = self%pass > 1
      next_pass = self%pass == 1 .and. self%is_good
      if (self%pass /= 2 .or. .not. self%is_good) return
      if (self%has_integers) self%is_good = fit(self%integer_tally, size(self%integers(1)%v))
      if (self%is_good) self%is_good = fit(self%real_tally, size(self%numbers(1)%v))
      next_pass = self%is_good

   contains

      !> Does the number of given values match the required one?
      logical function fit(what, given)
         type(tally), intent(inout) :: what
         integer, intent(in) :: given

         fit = count_fits(self%call_of, self%single(1), given, what%needed, what%needed + what%optional)
         what%spare = given - what%needed
      end function fit
   end function next_pass

   !> Skip a number that is not used
   subroutine skip(self, optional)
      class(caller), intent(inout) :: self
      !> May it be missing?
      logical, intent(in) :: optional
      logical :: given

      call self%real_tally%count_next(self%is_reading, optional, given)
   end subroutine skip

   !> Count one more number, or determine whether the caller gave it
   pure subroutine count_next(self, is_taking, optional, given)
      class(tally), intent(inout) :: self
      !> Second pass? May the number be missing?
      logical, intent(in) :: is_taking, optional
      !> Was the number given, in addition to those that were read?
      logical, intent(out) :: given

      given = is_taking .and. (self%spare > 0 .or. .not. optional)
      if (given) self%taken = self%taken + 1
      if (optional) then
         self%spare = self%spare - 1
         if (.not. is_taking) self%optional = self%optional + 1
      else if (.not. is_taking) then
         self%needed = self%needed + 1
      end if
   end subroutine count_next

   !> Refuse the call with a reason; nothing is stored
   subroutine refuse_call(self, reason)
      class(caller), intent(inout) :: self
      !> One sentence without the name of the setting
      character(len=*), intent(in) :: reason

      if (self%is_good) call report_error(self%call_of, reason)
      self%is_good = .false.
   end subroutine refuse_call

   !> Set the current items, unless one of them is out of bounds
   subroutine set_line(self)
      class(caller), intent(inout) :: self
      real(wp) :: values(size(self%items))
      integer :: k

      do k = 1, self%count
         if (.not. self%is_good) exit
         call get_value(self, k, values(k))
      end do
      if (self%is_good .and. self%is_reading) then
         do k = 1, self%count
            associate (item => self%items(k))
               if (associated(item%i)) item%i = nint(values(k))
               if (associated(item%r)) item%r = values(k)
            end associate
         end do
      end if
      call self%finish_line()
   end subroutine set_line

   !> Value of an item in internal units
   subroutine get_value(self, place, value)
      class(caller), intent(inout) :: self
      !> Index in the line
      integer, intent(in) :: place
      real(wp), intent(out) :: value
      logical :: is_among_reals

      associate (item => self%items(place), row => self%items(place)%row)
         is_among_reals = .not. (associated(item%i) .and. self%has_integers)
         if (is_among_reals) then
            call self%real_tally%count_next(self%is_reading, item%is_optional .or. self%may_miss, item%given)
         else
            call self%integer_tally%count_next(self%is_reading, item%is_optional .or. self%may_miss, item%given)
         end if
         value = item%default
         if (self%may_miss .and. associated(item%r)) value = item%r
         if (.not. item%given) return
         if (is_among_reals) then
            value = self%numbers(1)%v(self%real_tally%taken)
            if (associated(item%i)) value = anint(value)
            if (row > 0 .and. .not. self%units%is_internal()) &
               & value = value*inward(self%units, quantity_of(bounds_table(row)%unit))
         else
            value = real(self%integers(1)%v(self%integer_tally%taken), wp)
         end if
         ! most numbers are too large or negative: comparing them takes less time than comparing names
         if (value >= 0.0_wp .and. value < highest_least) value = raised(value, min_value(item%name))
         if (item%is_unchecked .or. is_within(row, value)) return
         call check_bounds(self, item%name(:len_trim(item%name)), value)
      end associate
   end subroutine get_value

   !> Minimum to which smaller values of a number are raised; -huge for numbers that are not raised
   pure real(wp) function min_value(name)
      !> Name as in the table of bounds
      character(len=*), intent(in) :: name
      integer :: k

      min_value = -huge(min_value)
      do k = 1, size(raised_numbers)
         if (raised_numbers(k)%name(1:1) /= name(1:1)) cycle
         if (raised_numbers(k)%name == name) min_value = raised_numbers(k)%least
      end do
   end function min_value

   !> Report a value out of bounds
   subroutine check_bounds(self, name, value, shown)
      class(caller), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: value
      !> Name in the message, if it differs
      character(len=*), intent(in), optional :: shown
      character(len=:), allocatable :: complaint

      if (.not. self%is_good) return
      call describe_breach(name, "", value, complaint, shown)
      if (allocated(complaint)) call self%refuse_call(complaint // "; nothing is stored")
   end subroutine check_bounds

   !> Set a list
   subroutine set_list(self, name, values, n, units, bounds)
      class(caller), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: n
      character(len=*), intent(in), optional :: units(:)
      character(len=*), intent(in), optional :: bounds
      character(len=:), allocatable :: row
      integer :: k

      if (.not. self%is_reading) self%real_tally%needed = self%real_tally%needed + n
      if (.not. (self%is_good .and. self%is_reading)) return
      row = name
      if (present(bounds)) row = bounds
      associate (taken => self%real_tally%taken)
         values = self%numbers(1)%v(taken + 1:taken + n)
         taken = taken + n
      end associate
      if (.not. present(units)) values = values*inward(self%units, quantity_of("mm"))
      do k = 1, n
         if (present(units)) values(k) = values(k)*inward(self%units, quantity_of(trim(units(1 + mod(k - 1, size(units))))))
         call check_bounds(self, row, values(k), name // "(" // integer_text(k) // ")")
         if (.not. self%is_good) return
      end do
   end subroutine set_list

   !> Report that a number cannot be used, is doubtful or was replaced
   subroutine report_number(self, is_error, name, text)
      class(caller), intent(inout) :: self
      logical, intent(in) :: is_error
      character(len=*), intent(in) :: name, text

      if (.not. self%is_reading) return
      if (is_error) then
         call self%refuse_call(trim(self%shown(name)) // text // "; nothing is stored")
      else if (self%is_good) then
         call warn(self%call_of, trim(self%shown(name)) // text)
      end if
   end subroutine report_number

   !> Refuse the call because of a number
   subroutine refuse_number(self, name, text)
      class(caller), intent(inout) :: self
      character(len=*), intent(in) :: name, text

      call self%report(.true., name, text)
   end subroutine refuse_number

   !> Check the bounds of a number that was read before
   subroutine check_number(self, name, bounds)
      class(caller), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=*), intent(in), optional :: bounds
      integer :: k

      k = self%place_of(name)
      if (k == 0 .or. .not. self%is_reading) return
      if (present(bounds)) then
         call check_bounds(self, bounds, self%items(k)%r, name)
      else
         call check_bounds(self, name, self%items(k)%r)
      end if
   end subroutine check_number

   !> Buffer of a result, of size 0 if the caller gave none
   function numbers_at(self, k, n) result(buffer)
      class(caller), intent(in) :: self
      !> Index of the result
      integer, intent(in) :: k
      !> Number of elements, if it is not a separate argument
      integer(long), intent(in), optional :: n
      real(c_double), pointer :: buffer(:)
      integer(long) :: length

      length = self%buffers(k)%length
      if (present(n)) length = merge(n, 0_long, c_associated(self%buffers(k)%address))
      call c_f_pointer(self%buffers(k)%address, buffer, [length])
   end function numbers_at

   !> The same for integers
   function integers_at(self, k) result(buffer)
      class(caller), intent(in) :: self
      !> Index of the result
      integer, intent(in) :: k
      integer(c_int), pointer :: buffer(:)

      call c_f_pointer(self%buffers(k)%address, buffer, [self%buffers(k)%length])
   end function integers_at

   !> Return real numbers, truncated to the size of the buffer
   subroutine set_numbers(self, k, list, fills)
      class(caller), intent(in) :: self
      !> Index of the result
      integer, intent(in) :: k
      !> Values in the units of the caller
      real(wp), intent(in) :: list(:)
      !> Fill the rest of the buffer with zeros? Default: no
      logical, intent(in), optional :: fills
      real(c_double), pointer :: buffer(:)
      integer :: n

      buffer => self%numbers_at(k)
      n = min(size(list), size(buffer))
      buffer(:n) = real(list(:n), c_double)
      if (present(fills)) buffer(n + 1:) = 0.0_c_double
   end subroutine set_numbers

   !> Return integers, truncated to the size of the buffer
   subroutine set_integers(self, k, list)
      class(caller), intent(in) :: self
      !> Index of the result, and values
      integer, intent(in) :: k, list(:)
      integer(c_int), pointer :: buffer(:)
      integer :: n

      buffer => self%integers_at(k)
      n = min(size(list), size(buffer))
      buffer(:n) = int(list(:n), c_int)
   end subroutine set_integers

   !> Return results that are single real numbers
   subroutine set_each_number(self, values)
      class(caller), intent(in) :: self
      !> One value for each result, in the units of the caller
      real(wp), intent(in) :: values(:)
      integer :: k

      do k = 1, size(values)
         call self%set_result(k, values(k:k))
      end do
   end subroutine set_each_number

   !> Return results that are single integers
   subroutine set_each_integer(self, values)
      class(caller), intent(in) :: self
      !> One value for each result
      integer, intent(in) :: values(:)
      integer :: k

      do k = 1, size(values)
         call self%set_result(k, values(k:k))
      end do
   end subroutine set_each_integer
end module contact_capi_caller
