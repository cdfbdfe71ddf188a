!> Points of a wheel over a row of elements or a mesh, several at once; the loops are in wheel_loops.c
module contact_wheelrail_wheel_loops
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   implicit none (type, external)
   private

   public :: meet_points, spread_polynomial, survey_nodes, find_locus, together

   !> Number of points that are solved together
   integer, parameter :: together = 8

   interface
      !> Intersections of lines with a round wheel, by Newton's method
      pure subroutine meet_points(pieces, ends, cy, cz, radius, base, axis, along, near, tolerance, most_steps, x, piece, place, &
         & n, found) bind(c, name="contact_wheel_meet")
         import :: c_double, c_int, together
         !> Number of pieces of the profile
         integer(c_int), value :: pieces
         !> Their ends [mm]; coefficients of lateral position and height
         real(c_double), intent(in) :: ends(pieces + 1), cy(0:3, pieces), cz(0:3, pieces)
         !> Radius of the wheel at the origin of its profile [mm]
         real(c_double), value :: radius
         !> In the axes of the wheel: a point of the plane for x = 0 [mm], direction of x, direction of the lines
         real(c_double), intent(in) :: base(3), axis(3), along(3)
         !> Maximum distance from the plane through the axle, relative to the radius, and tolerance of the steps [mm]
         real(c_double), value :: near, tolerance
         !> Maximum number of steps
         integer(c_int), value :: most_steps
         !> Positions of the points [mm]
         real(c_double), intent(in) :: x(together)
         !> A piece near the estimates on entry, that of the first estimate on exit
         integer(c_int), intent(inout) :: piece
         !> Position on the profile and height above each point [mm]: estimates on entry, solutions on exit
         real(c_double), intent(inout) :: place(together), n(together)
         !> 1 if all points are found, otherwise 0, and positions and heights are not changed
         integer(c_int), intent(out) :: found
      end subroutine meet_points

      !> Polynomial through the values at some nodes, at points from -1 to 1 at even distances
      pure subroutine spread_polynomial(powers, node, n, values, last) bind(c, name="contact_wheel_spread")
         import :: c_double, c_int, together
         !> Coefficients of the powers (first index) for a unit value at a node (second index)
         real(c_double), intent(in) :: powers(together, together)
         !> Values at the nodes
         real(c_double), intent(in) :: node(together)
         !> Number of points, at least 2
         integer(c_int), value :: n
         !> Values of the polynomial
         real(c_double), intent(inout) :: values(n)
         !> Magnitudes of the coefficients of the two highest powers
         real(c_double), intent(inout) :: last(2)
      end subroutine spread_polynomial

      !> The contact locus of a round wheel at the nodes of its profile, by the first step of the iteration for its longitudinal
      !> position; on a roller by two steps, as if its profile were a straight line at its top
      pure subroutine survey_nodes(n, y, z, lean, origin, axes, radius, furthest, roller, lowest, start, per_step, points, x, &
         & across, height, below) bind(c, name="contact_wheel_nodes")
         import :: c_double, c_int
         !> Number of nodes, a multiple of four
         integer(c_int), value :: n
         !> Coordinates of the nodes in the wheel's profile [mm], and slope dz/dy there [-]
         real(c_double), intent(in) :: y(n), z(n), lean(n)
         !> Origin [mm] and axes of the wheel in the track
         real(c_double), intent(in) :: origin(3), axes(3, 3)
         !> Radius of the wheel [mm]; maximum distance from the plane through the axle, relative to it
         real(c_double), value :: radius, furthest
         !> Radius of a roller, 0 on a track, and least height above its axle [mm]
         real(c_double), value :: roller, lowest
         !> First lateral position of a mesh [mm], and reciprocal of its width [1/mm]
         real(c_double), value :: start, per_step
         !> Number of points of the mesh
         integer(c_int), value :: points
         !> Coordinates of the locus in the track [mm]
         real(c_double), intent(inout) :: x(n), across(n), height(n)
         !> Number of mesh points at or below the lateral position of each node
         integer(c_int), intent(inout) :: below(n)
      end subroutine survey_nodes

      !> Points of the contact locus of a round wheel at given lateral positions
      pure subroutine find_locus(n, y, rail, piece, pieces, ends, cy, cz, origin, axes, radius, furthest, roller, lowest, &
         & steepest, accuracy, tolerance, most_steps, place, x, z, found) bind(c, name="contact_wheel_locus")
         import :: c_double, c_int
         !> Number of points
         integer(c_int), value :: n
         !> Lateral positions in the track, and heights of the rail's profile there, which are used on a roller only [mm]
         real(c_double), intent(in) :: y(n), rail(n)
         !> Piece of the profile on which each point is expected
         integer(c_int), intent(in) :: piece(n)
         !> Number of pieces
         integer(c_int), value :: pieces
         !> Their ends [mm], and coefficients of lateral position and height
         real(c_double), intent(in) :: ends(pieces + 1), cy(0:3, pieces), cz(0:3, pieces)
         !> Origin [mm] and axes of the wheel in the track
         real(c_double), intent(in) :: origin(3), axes(3, 3)
         !> Radius of the wheel [mm]; maximum distance from the plane through the axle, relative to it
         real(c_double), value :: radius, furthest
         !> Radius of a roller, 0 on a track, and least height above its axle [mm]
         real(c_double), value :: roller, lowest
         !> Upper bound of dy/ds along the profile [-]
         real(c_double), value :: steepest
         !> Accuracy of the lateral position [mm], and of the longitudinal one relative to the radius
         real(c_double), value :: accuracy, tolerance
         !> Maximum number of steps
         integer(c_int), value :: most_steps
         !> Estimated positions from the beginnings of the pieces [mm]
         real(c_double), intent(in) :: place(n)
         !> Longitudinal position and height in the track [mm]
         real(c_double), intent(inout) :: x(n), z(n)
         !> 1 if the point is found on its piece, otherwise 0
         integer(c_int), intent(inout) :: found(n)
      end subroutine find_locus
   end interface
end module contact_wheelrail_wheel_loops
