!> The forms of the undeformed distance (IBASE): their list, input values, and meaning
!>
!> As in contact_cases_inputs, the values are named once for all formats. Two procedures depend on the form, `visit_distance` and
!> `fill_distance`.
module contact_cases_distance
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_cases_archive, only : case_archive
   use contact_cases_numbers, only : require_nonzero, require_positive
   use contact_cases_spec, only : geometry_spec
   use contact_grid_potential_contact, only : potential_contact
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: distance_form, is_distance_form, list_forms, visit_distance, fill_distance, fill_quadratic, quadratic

   !> Form of the undeformed distance (IBASE)
   type :: distance_form_list
      integer :: quadratic = 1, profile = 2, quadratic_and_sines = 3, elementwise = 9
   end type distance_form_list
   type(distance_form_list), parameter :: distance_form = distance_form_list()

   !> All forms
   integer, parameter :: all_forms(*) = [distance_form%quadratic, distance_form%profile, distance_form%quadratic_and_sines, &
      & distance_form%elementwise]

contains

   !> Is there a form with this number?
   pure logical function is_distance_form(number)
      !> Member of distance_form, or any other number
      integer, intent(in) :: number
      is_distance_form = any(all_forms == number)
   end function is_distance_form

   !> The numbers of all forms as a text, "1, 2, 3 and 9"
   subroutine list_forms(before_last, text)
      !> Word before the last number
      character(len=*), intent(in) :: before_last
      !> Text for messages
      character(len=:), allocatable, intent(out) :: text
      integer :: k

      text = integer_text(all_forms(1))
      do k = 2, size(all_forms) - 1
         text = text // ", " // integer_text(all_forms(k))
      end do
      text = text // before_last // integer_text(all_forms(size(all_forms)))
   end subroutine list_forms

   !> Values that belong to a form of the undeformed distance (IBASE)
   subroutine visit_distance(a, geometry, elements)
      class(case_archive), intent(inout) :: a
      !> The form is set
      type(geometry_spec), intent(inout), target :: geometry
      !> Number of elements of the grid, 0 if there is no valid grid
      integer, intent(in) :: elements
      real(wp), allocatable :: list(:)
      integer, target :: n

      select case (geometry%form)
      case (distance_form%quadratic)
         list = geometry%b(:6)
         call a%list("B", list, 6, units=[character(len=4) :: "1/mm", "1/mm", "1/mm", "-", "-", "mm"])
         if (a%is_reading .and. a%is_good) geometry%b(:6) = list
      case (distance_form%profile)
         n = 0
         if (allocated(geometry%profile)) n = size(geometry%profile)
         call a%integer("NN", n)
         call a%real("XM", geometry%xm)
         call a%real("RM", geometry%rm)
         call a%real("Y1", geometry%y1)
         call a%real("DY1", geometry%dy1)
         call a%end_line()
         call a%list("B", geometry%profile, n)
      case (distance_form%quadratic_and_sines)
         list = geometry%b
         call a%list("B", list, 8, units=[character(len=4) :: "mm", "1/mm", "mm", "mm", "1/mm", "mm", "mm", "mm"], &
            & bounds="B(IBASE3)")
         if (a%is_reading .and. a%is_good) geometry%b = list
      case (distance_form%elementwise)
         if (elements == 0) call a%fail("", "the list H has one entry for each element, but there is no grid that can be used")
         call a%list("H", geometry%h, elements)
      end select
   end subroutine visit_distance

   !> Undeformed distance of a case, at the centres of the elements
   subroutine fill_distance(spec, grid, h, error)
      !> Form and its values
      type(geometry_spec), intent(in) :: spec
      !> Grid of elements
      type(potential_contact), intent(in) :: grid
      !> Undeformed distance [mm], shape (mx, my)
      real(wp), intent(out) :: h(:, :)
      !> Allocated if the values cannot be used
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: forms

      h = 0.0_wp
      if (.not. all(ieee_is_finite([spec%b, spec%xm, spec%rm, spec%y1, spec%dy1]))) then
         call fatal_error(error, "the numbers of the undeformed distance must be finite")
         return
      end if
      select case (spec%form)
      case (distance_form%quadratic)
         call fill_quadratic(grid, spec%b(1:6), h)
      case (distance_form%profile)
         call fill_profile(spec, grid, h, error)
      case (distance_form%quadratic_and_sines)
         call fill_sines(spec, grid, h, error)
      case (distance_form%elementwise)
         call fill_given(spec, grid, h, error)
      case default
         call list_forms(" and ", forms)
         call fatal_error(error, "IBASE = " // integer_text(spec%form) // " is not a form of the undeformed distance; " // &
            & forms // " are")
      end select
   end subroutine fill_distance

   !> IBASE = 1: c1 x**2 + c2 x y + c3 y**2 + c4 x + c5 y + c6
   pure subroutine fill_quadratic(grid, c, h)
      !> Grid of elements
      type(potential_contact), intent(in) :: grid
      !> Coefficients: three [1/mm], two [-], one [mm]
      real(wp), intent(in) :: c(6)
      !> Undeformed distance [mm], shape (mx, my)
      real(wp), intent(out) :: h(:, :)
      integer :: ix, iy

      do iy = 1, grid%my
         do ix = 1, grid%mx
            h(ix, iy) = quadratic(c, grid%x(ix), grid%y(iy))
         end do
      end do
   end subroutine fill_quadratic

   !> A quadratic form [mm]
   pure real(wp) function quadratic(c, x, y) result(value)
      !> Coefficients as for fill_quadratic, and position [mm]
      real(wp), intent(in) :: c(6), x, y
      value = (c(1)*x + c(2)*y + c(4))*x + (c(3)*y + c(5))*y + c(6)
   end function quadratic

   !> IBASE = 2: body of revolution, profile over y by linear interpolation and extrapolation
   subroutine fill_profile(spec, grid, h, error)
      type(geometry_spec), intent(in) :: spec
      type(potential_contact), intent(in) :: grid
      real(wp), intent(out) :: h(:, :)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: height
      integer :: ix, iy

      h = 0.0_wp
      call require_positive("profile step DY1", spec%dy1, error)
      call require_nonzero("radius RM", spec%rm, error)
      if (allocated(error)) return
      if (.not. allocated(spec%profile)) then
         call fatal_error(error, "the profile of IBASE = 2 has not been given")
         return
      end if
      if (size(spec%profile) < 2) then
         call fatal_error(error, "the profile of IBASE = 2 needs 2 points at least, it has " &
            & // integer_text(size(spec%profile)))
         return
      end if
      if (.not. all(ieee_is_finite(spec%profile))) then
         call fatal_error(error, "the heights of the profile of IBASE = 2 must be finite")
         return
      end if
      do iy = 1, grid%my
         height = profile_height(spec, grid%y(iy))
         do ix = 1, grid%mx
            h(ix, iy) = height + 0.5_wp*(grid%x(ix) - spec%xm)**2/spec%rm
         end do
      end do
   end subroutine fill_profile

   !> Height of the profile [mm]; extrapolated from the first and last interval
   pure real(wp) function profile_height(spec, y) result(height)
      type(geometry_spec), intent(in) :: spec
      real(wp), intent(in) :: y
      real(wp) :: position
      integer :: k

      associate (p => spec%profile)
         position = (y - spec%y1)/spec%dy1
         ! limited as a real number first: far outside the profile the conversion to an integer would overflow
         k = 1 + int(min(max(position, 0.0_wp), real(size(p) - 2, wp)))
         height = p(k) + (position - real(k - 1, wp))*(p(k + 1) - p(k))
      end associate
   end function profile_height

   !> IBASE = 3: difference of two sines over x, plus parabolas with radii b7/2 and b8/2
   subroutine fill_sines(spec, grid, h, error)
      type(geometry_spec), intent(in) :: spec
      type(potential_contact), intent(in) :: grid
      real(wp), intent(out) :: h(:, :)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: x
      integer :: ix

      h = 0.0_wp
      call require_nonzero("parameter B7", spec%b(7), error)
      call require_nonzero("parameter B8", spec%b(8), error)
      if (allocated(error)) return
      associate (b => spec%b)
         do ix = 1, grid%mx
            x = grid%x(ix)
            h(ix, :) = b(1)*sin(b(2)*(x - b(3))) - b(4)*sin(b(5)*(x - b(6))) + x**2/b(7) &
               & + grid%y(row_numbers(grid%my))**2/b(8)
         end do
      end associate
   end subroutine fill_sines

   !> Row numbers 1...my
   pure function row_numbers(my) result(rows)
      integer, intent(in) :: my
      integer :: rows(my)
      integer :: iy
      rows = [(iy, iy = 1, my)]
   end function row_numbers

   !> IBASE = 9: one value per element
   subroutine fill_given(spec, grid, h, error)
      type(geometry_spec), intent(in) :: spec
      type(potential_contact), intent(in) :: grid
      real(wp), intent(out) :: h(:, :)
      type(error_type), allocatable, intent(out) :: error
      integer :: given

      given = 0
      if (allocated(spec%h)) given = size(spec%h)
      if (any(spec%h_grid > 0 .and. spec%h_grid /= [grid%mx, grid%my])) then
         h = 0.0_wp
         call fatal_error(error, "the undeformed distance is given for " // integer_text(spec%h_grid(1)) // " x " // &
            & integer_text(spec%h_grid(2)) // " elements (IBASE = 9), the potential contact has " // integer_text(grid%mx) // &
            & " x " // integer_text(grid%my))
         return
      end if
      if (given == grid%npot()) then
         h = reshape(spec%h, [grid%mx, grid%my])
         return
      end if
      h = 0.0_wp
      call fatal_error(error, "the undeformed distance is given for " // integer_text(given) &
         & // " elements (IBASE = 9), the potential contact has " // integer_text(grid%mx) // " x " &
         & // integer_text(grid%my) // " = " // integer_text(grid%npot()))
   end subroutine fill_given
end module contact_cases_distance
