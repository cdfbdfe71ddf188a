!> Influence coefficients of homogeneous half-spaces as sums over the corners of an element, piecewise constant tractions
!>
!> Displacement differences at a point (x, y) due to a unit traction on a rectangle around the origin, after Love (1929) and
!> Kalker (1990): signed sums of corner functions over the four corners. Logarithms are written as asinh: ln(y + r) =
!> asinh(y/|x|) + ln|x|, where the last term cancels in the difference over y; there is no cancellation for negative arguments.
module contact_elastic_corners
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_elastic_material, only : combined_material
   implicit none (type, external)
   private

   public :: combine_corners, corner_functions, normal_coefficient

   !> Ratio of two coordinates below which a term x asinh(y/|x|) is negligible, and y/|x| might overflow
   real(wp), parameter :: on_axis = 1.0e-14_wp

contains

   !> Functions whose mixed difference over the corners gives the coefficients
   !>
   !> x asinh(y/|x|), y asinh(x/|y|), r, and for coupled problems y ln r + x atan(y/x), x ln r + y atan(x/y), with their limits
   !> for x = 0 or y = 0.
   pure function corner_functions(x, y, coupled) result(f)
      !> Position relative to a corner [mm]
      real(wp), intent(in) :: x, y
      !> Are the last two required? They are zero otherwise
      logical, intent(in) :: coupled
      real(wp) :: f(5), r

      r = hypot(x, y)
      f = 0.0_wp
      if (abs(x) > on_axis*abs(y)) f(1) = x*asinh(y/abs(x))
      if (abs(y) > on_axis*abs(x)) f(2) = y*asinh(x/abs(y))
      f(3) = r
      if (.not. coupled .or. r <= 0.0_wp) return
      f(4) = y*log(r)
      if (x /= 0.0_wp) f(4) = f(4) + x*atan(y/x)
      f(5) = x*log(r)
      if (y /= 0.0_wp) f(5) = f(5) + y*atan(x/y)
   end function corner_functions

   !> Convert differences of the corner functions to nn, xx, yy, xy, xn, yn
   pure function combine_corners(d, material) result(v)
      !> Mixed differences of the five corner functions [mm]
      real(wp), intent(in) :: d(5)
      !> Combined constants of both bodies
      type(combined_material), intent(in) :: material
      real(wp) :: v(6), factor

      factor = 1.0_wp/(pi*material%gg)
      v(1) = normal_coefficient(d, material)
      v(2) = factor*((1.0_wp - material%nu)*d(1) + d(2))
      v(3) = factor*(d(1) + (1.0_wp - material%nu)*d(2))
      v(4) = -factor*material%nu*d(3)
      v(5) = -factor*material%ak*d(4)
      v(6) = -factor*material%ak*d(5)
   end function combine_corners

   !> Coefficient nn only
   pure real(wp) function normal_coefficient(d, material)
      !> As for combine_corners; only the first two matter
      real(wp), intent(in) :: d(5)
      !> Combined constants of both bodies
      type(combined_material), intent(in) :: material

      normal_coefficient = 1.0_wp/(pi*material%gg)*(1.0_wp - material%nu)*(d(1) + d(2))
   end function normal_coefficient
end module contact_elastic_corners
