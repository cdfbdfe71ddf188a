!> The archive that gives values to a case from the arrays of a caller
module contact_capi_setter
   use contact_base_kinds, only : wp
   use contact_capi_arguments, only : raised
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : complain, warn
   use contact_cases_archive, only : case_archive
   use contact_control_units, only : inward, quantity_of, unit_convention
   use contact_text_bounds, only : bounds_table, describe_breach
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: min_value, new_setter, setter

   !> A number that is not refused below a value that the models need, but raised to it: not negative ones, nor NaN
   type :: raised_number
      character(len=6) :: name
      real(wp) :: least
   end type raised_number
   !> Coefficients of friction, factors of slope reduction [-], slip velocities [mm/s], curvatures [1/mm], thickness [mm]
   type(raised_number), parameter :: raised_numbers(*) = [raised_number("FSTAT", 1.0e-6_wp), raised_number("FKIN", 1.0e-6_wp), &
      & raised_number("FREF", 1.0e-6_wp), raised_number("SABSH1", 1.0e-4_wp), raised_number("SABSH2", 1.0e-4_wp), &
      & raised_number("K0_MF", 1.0e-6_wp), raised_number("ALFAMF", 1.0e-6_wp), raised_number("BETAMF", 1.0e-6_wp), &
      & raised_number("A1", 1.0e-12_wp), raised_number("B1", 1.0e-12_wp), raised_number("LAYTHK", 1.0e-9_wp)]

   !> Takes its numbers one after the other; the first that is wrong is complained about
   type, extends(case_archive) :: setter
      private
      type(entry_type) :: call_of
      type(unit_convention) :: units
      !> Numbers of the caller; integers among them where there is no list of their own
      real(wp), allocatable :: numbers(:)
      integer, allocatable :: whole_numbers(:)
      !> How many were taken
      integer :: reals_taken = 0, integers_taken = 0
   contains
      procedure :: end_line => set_line
      procedure :: list => set_list
      procedure :: refuse => refuse_number
      procedure :: warn => warn_of_number
      procedure :: check => check_number
   end type setter

contains

   !> A setter for one call; how many numbers there must be has been checked
   function new_setter(call_of, units, reals, integers) result(a)
      type(entry_type), intent(in) :: call_of
      !> Of the caller
      type(unit_convention), intent(in) :: units
      real(wp), intent(in) :: reals(:)
      !> Absent: integers stand among the reals
      integer, intent(in), optional :: integers(:)
      type(setter) :: a

      a%is_reading = .true.
      a%of_library = .true.
      a%call_of = call_of
      a%units = units
      a%numbers = reals
      if (present(integers)) a%whole_numbers = integers
   end function new_setter

   !> Give the items in hand their values, unless one of them is beyond its bounds
   subroutine set_line(self)
      class(setter), intent(inout) :: self
      real(wp) :: values(size(self%items))
      integer :: k

      do k = 1, self%count
         if (.not. self%is_good) exit
         call take(self, k, values(k))
      end do
      if (self%is_good) then
         do k = 1, self%count
            associate (item => self%items(k))
               if (associated(item%i)) item%i = nint(values(k))
               if (associated(item%r)) item%r = values(k)
            end associate
         end do
      end if
      call self%finish_line()
   end subroutine set_line

   !> The value of an item in internal units
   subroutine take(self, place, value)
      class(setter), intent(inout) :: self
      !> In the line
      integer, intent(in) :: place
      real(wp), intent(out) :: value

      associate (item => self%items(place), row => self%items(place)%row)
         value = item%default
         if (associated(item%i) .and. allocated(self%whole_numbers)) then
            self%integers_taken = self%integers_taken + 1
            value = real(self%whole_numbers(self%integers_taken), wp)
         else
            item%given = self%reals_taken < size(self%numbers)
            if (.not. item%given) return
            self%reals_taken = self%reals_taken + 1
            value = self%numbers(self%reals_taken)
            if (associated(item%i)) value = anint(value)
            if (row > 0) value = value*inward(self%units, quantity_of(trim(bounds_table(row)%unit)))
         end if
         value = raised(value, min_value(item%name))
         if (.not. item%is_unchecked) call check_bounds(self, trim(item%name), value)
      end associate
   end subroutine take

   !> The value to which a smaller number is raised; below all numbers for those that are not raised
   pure real(wp) function min_value(name)
      character(len=*), intent(in) :: name
      integer :: k

      min_value = -huge(min_value)
      do k = 1, size(raised_numbers)
         if (raised_numbers(k)%name == name) min_value = raised_numbers(k)%least
      end do
   end function min_value

   !> Complain about a value beyond its bounds
   subroutine check_bounds(self, name, value, shown)
      class(setter), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: value
      !> Name in the complaint, where that is another one
      character(len=*), intent(in), optional :: shown
      character(len=:), allocatable :: complaint

      if (.not. self%is_good) return
      call describe_breach(name, "", value, complaint, shown)
      if (.not. allocated(complaint)) return
      self%is_good = .false.
      call complain(self%call_of, complaint // "; nothing is stored")
   end subroutine check_bounds

   !> Give a list its values
   subroutine set_list(self, name, values, n, units, bounds)
      class(setter), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: n
      character(len=*), intent(in), optional :: units(:)
      character(len=*), intent(in), optional :: bounds
      character(len=:), allocatable :: row
      integer :: k

      if (.not. self%is_good) return
      row = name
      if (present(bounds)) row = bounds
      values = self%numbers(self%reals_taken + 1:self%reals_taken + n)
      self%reals_taken = self%reals_taken + n
      if (.not. present(units)) values = values*inward(self%units, quantity_of("mm"))
      do k = 1, n
         if (present(units)) values(k) = values(k)*inward(self%units, quantity_of(trim(units(1 + mod(k - 1, size(units))))))
         call check_bounds(self, row, values(k), name // "(" // integer_text(k) // ")")
         if (.not. self%is_good) return
      end do
   end subroutine set_list

   !> A number cannot be used
   subroutine refuse_number(self, name, text)
      class(setter), intent(inout) :: self
      character(len=*), intent(in) :: name, text

      if (.not. self%is_good) return
      self%is_good = .false.
      call complain(self%call_of, trim(self%shown(name)) // text // "; nothing is stored")
   end subroutine refuse_number

   !> A number is doubtful or was replaced
   subroutine warn_of_number(self, name, text)
      class(setter), intent(inout) :: self
      character(len=*), intent(in) :: name, text

      if (self%is_good) call warn(self%call_of, trim(self%shown(name)) // text)
   end subroutine warn_of_number

   !> Check the bounds of a number that the caller of the archive has seen before
   subroutine check_number(self, name, bounds)
      class(setter), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=*), intent(in), optional :: bounds
      integer :: k

      k = self%place_of(name)
      if (k == 0) return
      if (present(bounds)) then
         call check_bounds(self, bounds, self%items(k)%r, name)
      else
         call check_bounds(self, name, self%items(k)%r)
      end if
   end subroutine check_number
end module contact_capi_setter
