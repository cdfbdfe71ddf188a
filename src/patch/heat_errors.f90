!> Error of the highest temperature of a surface by the second order, from the shape of the field at its maximum
!>
!> See doc/theory/errors.md.
module contact_patch_heat_errors
   use contact_base_choices, only : motion
   use contact_base_kinds, only : wp
   use contact_patch_heat, only : frictional_heat, new_heat_passage
   use contact_patch_peak, only : rise_of
   use contact_patch_problem, only : patch_problem
   use contact_patch_result, only : patch_result
   use contact_temperature_flash_heating, only : heat_passage
   implicit none (type, external)
   private

   public :: error_of_maximum, maximum_error

   !> Error of the highest temperature; both surfaces have the same rise by friction
   type :: maximum_error
      !> Largest rise of the temperature by friction [degC]
      real(wp) :: rise = 0.0_wp
      !> Error of it: computed for the actual grid, without sign, and half of the usual one over all positions of the grid [degC]
      real(wp) :: computed = 0.0_wp, usual = 0.0_wp
   end type maximum_error

   !> Across the path pressures of elements are too high, by 0.2 n^-2: temperature at the maximum less the exact one, over the
   !> second difference of the field there. Median of 1180 temperatures of wheels (seeds 71001 to 71003)
   real(wp), parameter :: pressed = 0.04_wp
   !> What a centre of an element is below the maximum, in the mean over positions, over the same: the mean of u^2/2 up to half an
   !> element. Deviation of it, 0.037, and of the rest (0.02 to 0.04), together
   real(wp), parameter :: below = 1.0_wp/24.0_wp, scatter = 0.05_wp
   !> The lower bound is this fraction of the usual error
   real(wp), parameter :: fraction = 0.5_wp

contains

   !> Error of the highest temperature in contact, a value at the centre of an element
   pure type(maximum_error) function error_of_maximum(problem, result) result(error)
      !> Thermal constants and motion
      type(patch_problem), intent(in) :: problem
      !> Solution with temperatures
      type(patch_result), intent(in) :: result
      type(heat_passage) :: passage
      real(wp), allocatable :: rise(:, :), other(:, :)
      real(wp) :: bend(2), above(2), constant
      integer :: at(2)

      if (.not. allocated(result%temp1) .or. problem%motion /= motion%steady_rolling) return
      passage = new_heat_passage(problem, result%division)
      allocate(rise, other, mold=result%temp1)
      call passage%conduct(rise, other)
      rise = result%temp1 - rise
      at = maxloc(rise, mask=passage%contact)
      if (any(at == 0)) return
      error%rise = rise(at(1), at(2))
      call shape_of_line(rise(:, at(2)), at(1), bend(1), above(1))
      call shape_of_line(rise(at(1), :), at(2), bend(2), above(2))
      other = frictional_heat(problem, result)
      constant = passage%error_of_constant_heat(change_along(other(:, at(2)), at(1), -passage%direction))
      error%computed = abs(constant + pressed*bend(2) - sum(above))
      error%usual = fraction*norm2([constant - below*bend(1), (pressed - below)*bend(2), scatter*bend])
   end function error_of_maximum

   !> Increase of a field over an element of a line, from both elements beside it; zero outside the line
   pure real(wp) function change_along(line, i, direction) result(change)
      !> Values, and position
      real(wp), intent(in) :: line(:)
      integer, intent(in) :: i
      !> 1 or -1: towards the end or the beginning of the line
      integer, intent(in) :: direction

      change = 0.0_wp
      if (i < size(line)) change = line(i + 1)
      if (i > 1) change = change - line(i - 1)
      change = 0.5_wp*direction*change
   end function change_along

   !> Second difference of a field at its maximum along a line, and rise of the parabola above it; zero for fewer than three
   !> elements, which represent a field that is constant along the line
   pure subroutine shape_of_line(line, i, bend, above)
      !> Values [degC], zero outside the grid, and position of the largest one
      real(wp), intent(in) :: line(:)
      integer, intent(in) :: i
      !> [degC]
      real(wp), intent(out) :: bend, above
      real(wp) :: beside(2)

      bend = 0.0_wp
      above = 0.0_wp
      if (size(line) < 3) return
      beside = 0.0_wp
      if (i > 1) beside(1) = line(i - 1)
      if (i < size(line)) beside(2) = line(i + 1)
      bend = max(0.0_wp, 2.0_wp*line(i) - sum(beside))
      above = rise_of(line(i), beside)
   end subroutine shape_of_line
end module contact_patch_heat_errors
