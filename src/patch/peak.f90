!> Maximum of a field between the centres of its elements
!>
!> The largest value at the centres of elements is below the peak of the field, by up to 1/n^2 of it with n elements across a
!> contact, varying with the position of the grid.
module contact_patch_peak
   use contact_base_kinds, only : wp
   use contact_numeric_vectors, only : largest_of
   implicit none (type, external)
   private

   public :: largest_pressure, peak_at, peak_of, place_of, rise_of

contains

   !> Maximum pressure of a patch [N/mm2]; with order 2 that between centres of elements
   pure real(wp) function largest_pressure(pn, order)
      !> Pressures of elements [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: pn(:, :)
      !> Order of the solution of the tangential problem, 1 or 2
      integer, intent(in) :: order

      if (order == 2) then
         largest_pressure = peak_of(pn)
      else
         largest_pressure = largest_of(size(pn), pn)
      end if
   end function largest_pressure

   !> Peak of the parabolas through the squares of the largest value and its neighbours; the field is zero outside the grid
   !>
   !> Squares are used because those of Hertzian pressures form a paraboloid. The peak is limited to half an element from the
   !> centre, and its square to an eighth above that of the largest value, in each direction.
   pure real(wp) function peak_of(field) result(peak)
      !> Field without negative values, shape (mx, my)
      real(wp), contiguous, intent(in) :: field(:, :)

      peak = largest_of(size(field), field)
      if (peak > 0.0_wp) peak = peak_at(field, place_of(field, peak))
   end function peak_of

   !> The same of a positive value that is not less than its neighbours
   pure real(wp) function peak_at(field, at) result(peak)
      !> Field without negative values, shape (mx, my)
      real(wp), intent(in) :: field(:, :)
      !> Column and row of the value
      integer, intent(in) :: at(2)

      peak = field(at(1), at(2))*sqrt(1.0_wp + rise(field(:, at(2)), at(1)) + rise(field(at(1), :), at(2)))
   end function peak_at

   !> First element with at least a value, column and row; zero if there is none
   pure function place_of(field, value) result(at)
      !> Field, shape (mx, my)
      real(wp), contiguous, intent(in) :: field(:, :)
      !> Value in the unit of the field
      real(wp), intent(in) :: value
      integer :: at(2), ix, iy

      do iy = 1, size(field, 2)
         do ix = 1, size(field, 1)
            if (field(ix, iy) >= value) then
               at = [ix, iy]
               return
            end if
         end do
      end do
      at = 0
   end function place_of

   !> Relative rise above the middle one of the parabola through the squares of three values [-]
   pure real(wp) function rise(line, i)
      !> Values along a line of elements with the largest value at i
      real(wp), intent(in) :: line(:)
      integer, intent(in) :: i
      real(wp) :: beside(2)

      rise = 0.0_wp
      ! fewer than three elements represent a field that is constant in this direction
      if (size(line) < 3) return
      beside = 0.0_wp
      if (i > 1) beside(1) = (line(i - 1)/line(i))**2
      if (i < size(line)) beside(2) = (line(i + 1)/line(i))**2
      rise = rise_of(1.0_wp, beside)
   end function rise

   !> Rise of the parabola through a largest value and its neighbours above it
   pure real(wp) function rise_of(largest, beside) result(above)
      !> Largest value, and those at equal distances before and after it, in any unit
      real(wp), intent(in) :: largest, beside(2)
      real(wp) :: bend

      above = 0.0_wp
      bend = 2.0_wp*largest - sum(beside)
      if (bend > 0.0_wp) above = (beside(2) - beside(1))**2/(8.0_wp*bend)
   end function rise_of
end module contact_patch_peak
