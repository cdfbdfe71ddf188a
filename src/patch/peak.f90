!> Largest value of a field between the centres of its elements
!>
!> Elements have one value each, and the largest of them is below the peak of the field by what the field bends from the peak to the
!> nearest centre: up to 1/n^2 of it with n elements across a contact, and another part of that for each position of the grid.
module contact_patch_peak
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: largest_pressure, peak_of

contains

   !> Largest pressure of a patch: with order 2 that between centres of elements [N/mm2]
   pure real(wp) function largest_pressure(pn, order)
      !> Pressures of elements [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: pn(:, :)
      !> Order that the tangential problem was solved with, 1 or 2
      integer, intent(in) :: order

      if (order == 2) then
         largest_pressure = peak_of(pn)
      else
         largest_pressure = maxval(pn)
      end if
   end function largest_pressure

   !> Peak of the parabolas through the squares of the largest value and of its neighbours, zero outside of the field
   !>
   !> Squares, because those of Hertzian pressures are a paraboloid. The peak lies within half an element, and is above the largest
   !> value by an eighth at most, in its square and in each direction.
   pure real(wp) function peak_of(field) result(peak)
      !> Shape (mx, my), without negative values
      real(wp), contiguous, intent(in) :: field(:, :)
      integer :: at(2)

      peak = maxval(field)
      if (.not. peak > 0.0_wp) return
      at = maxloc(field)
      peak = peak*sqrt(1.0_wp + rise(field(:, at(2)), at(1)) + rise(field(at(1), :), at(2)))
   end function peak_of

   !> How far the parabola through the squares of three values rises above that of the one in the middle, over it [-]
   pure real(wp) function rise(line, i)
      !> A line of elements with the largest value at i
      real(wp), intent(in) :: line(:)
      integer, intent(in) :: i
      real(wp) :: beside(2), bend

      rise = 0.0_wp
      ! fewer than three elements stand for something that does not change in this direction
      if (size(line) < 3) return
      beside = 0.0_wp
      if (i > 1) beside(1) = (line(i - 1)/line(i))**2
      if (i < size(line)) beside(2) = (line(i + 1)/line(i))**2
      bend = 2.0_wp - sum(beside)
      if (bend > 0.0_wp) rise = (beside(2) - beside(1))**2/(8.0_wp*bend)
   end function rise
end module contact_patch_peak
