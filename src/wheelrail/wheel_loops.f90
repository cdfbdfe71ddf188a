!> Points of a wheel over a row of elements, several at once; the loops are in wheel_loops.c
module contact_wheelrail_wheel_loops
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   implicit none (type, external)
   private

   public :: meet_points, spread_polynomial, together

   !> Number of points that are solved together
   integer, parameter :: together = 8

   interface
      !> Intersections of lines with a piece of a round wheel, by Newton's method
      pure subroutine meet_points(piece, y, z, radius, base, axis, along, near, tolerance, most_steps, x, place, n, found) &
         & bind(c, name="contact_wheel_meet")
         import :: c_double, c_int, together
         !> Ends of the piece [mm]; coefficients of lateral position and height of the profile from its first end on
         real(c_double), intent(in) :: piece(2), y(0:3), z(0:3)
         !> Radius of the wheel at the origin of its profile [mm]
         real(c_double), value :: radius
         !> In the axes of the wheel: a point of the plane for x = 0 [mm], direction of x, direction of the lines
         real(c_double), intent(in) :: base(3), axis(3), along(3)
         !> Maximum distance from the plane through the axle, and tolerance of the steps; both relative to the radius
         real(c_double), value :: near, tolerance
         !> Maximum number of steps
         integer(c_int), value :: most_steps
         !> Positions of the points [mm]
         real(c_double), intent(in) :: x(together)
         !> Position on the profile and height above each point [mm]: estimates on entry, solutions on exit
         real(c_double), intent(inout) :: place(together), n(together)
         !> 1 if all points are found on the piece, otherwise 0, and nothing is changed
         integer(c_int), intent(out) :: found
      end subroutine meet_points

      !> Values of a polynomial of degree 7 at points from -1 to 1 at even distances
      pure subroutine spread_polynomial(p, n, values) bind(c, name="contact_wheel_spread")
         import :: c_double, c_int
         !> Coefficients of the powers
         real(c_double), intent(in) :: p(0:7)
         !> Number of points, at least 2
         integer(c_int), value :: n
         !> Values of the polynomial
         real(c_double), intent(inout) :: values(n)
      end subroutine spread_polynomial
   end interface
end module contact_wheelrail_wheel_loops
