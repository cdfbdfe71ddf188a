!> A rail as a tensor-product spline that is evaluated anew at every point of a search: what the program does not do
!>
!> Both coordinates across the track are splines of the place u along the track and of a parameter v across it.
!> At a point of the track v follows from the lateral position by Newton's method, from the point before.
module contact_bench_point_by_point
   use contact_base_kinds, only : wp
   use contact_numeric_b_spline, only : basis_values, interpolate_sites, interpolation_knots, knot_interval
   use contact_profile_surface, only : profile_surface, surface_cut
   use contact_wheelrail_bodies, only : find_wheel, wheel_rail_bodies
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_gap, only : no_surface
   implicit none (type, external)
   private

   public :: tensor_rail, new_tensor_rail, smallest_gaps

   !> The surface of a rail in its own coordinates
   type :: tensor_rail
      !> Knots along and across
      real(wp), allocatable :: tu(:), tv(:)
      !> Coefficients of y and z, shape (along, across)
      real(wp), allocatable :: y(:, :), z(:, :)
   end type tensor_rail

contains

   !> From sections of a surface at some places, with the same number of points in each
   function new_tensor_rail(surface, u, points) result(rail)
      type(profile_surface), intent(in) :: surface
      !> Rising
      real(wp), intent(in) :: u(:)
      integer, intent(in) :: points
      type(tensor_rail) :: rail
      type(surface_cut) :: section
      real(wp), allocatable :: values(:, :), v(:)
      real(wp) :: range(2), s
      logical :: solved
      integer :: i, j

      v = [(real(j, wp), j=1, points)]
      rail%tu = interpolation_knots(u)
      rail%tv = interpolation_knots(v)
      allocate(rail%y(size(u), points), rail%z(size(u), points))
      do i = 1, size(u)
         call surface%cut(u(i), section)
         range = section%curve%s_range()
         do j = 1, points
            s = range(1) + (range(2) - range(1))*(j - 1)/(points - 1)
            rail%y(i, j) = section%curve%y%value(s)
            rail%z(i, j) = section%curve%z%value(s)
         end do
      end do
      call interpolate_sites(rail%tu, u, rail%y, solved)
      call interpolate_sites(rail%tu, u, rail%z, solved)
      values = transpose(rail%y)
      call interpolate_sites(rail%tv, v, values, solved)
      rail%y = transpose(values)
      values = transpose(rail%z)
      call interpolate_sites(rail%tv, v, values, solved)
      rail%z = transpose(values)
   end function new_tensor_rail

   !> Height at a place; the estimate of v is replaced by the solution
   subroutine height_at(rail, u, y, v, z, found)
      type(tensor_rail), intent(in) :: rail
      real(wp), intent(in) :: u, y
      real(wp), intent(inout) :: v
      real(wp), intent(out) :: z
      logical, intent(out) :: found
      real(wp) :: along(4), across(4), slope(4), column(4), step
      integer :: i, j, k, iteration

      i = knot_interval(rail%tu, u)
      call basis_values(rail%tu, i, u, along)
      found = .false.
      z = 0.0_wp
      do iteration = 1, 30
         v = min(max(v, rail%tv(4)), rail%tv(size(rail%tv) - 3))
         j = knot_interval(rail%tv, v)
         call basis_values(rail%tv, j, v, across, slope)
         do k = 1, 4
            column(k) = dot_product(along, rail%y(i - 3:i, j - 4 + k))
         end do
         step = (dot_product(across, column) - y)/dot_product(slope, column)
         v = v - step
         if (abs(step) > 1.0e-9_wp) cycle
         found = v >= rail%tv(4) .and. v <= rail%tv(size(rail%tv) - 3)
         exit
      end do
      if (.not. found) return
      do k = 1, 4
         column(k) = dot_product(along, rail%z(i - 3:i, j - 4 + k))
      end do
      z = dot_product(across, column)
   end subroutine height_at

   !> Smallest gap along the track for each lateral position and its place, every point of the mesh evaluated
   subroutine smallest_gaps(rail, bodies, s_ws, x, y, gap, place_of_gap)
      type(tensor_rail), intent(in) :: rail
      !> For the wheel, which is round, and the place of the rail, which is not rolled
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Position of the wheelset along the rail [mm]
      real(wp), intent(in) :: s_ws
      !> Mesh in the track [mm]
      real(wp), intent(in) :: x(:), y(:)
      real(wp), intent(out) :: gap(:), place_of_gap(:)
      type(frame) :: track, seen
      real(wp) :: row(size(x)), v, z, place, wheel, bend, shift
      logical :: found
      integer :: i, j

      seen = bodies%placement%wheel%seen_from_here(track)
      v = 0.5_wp*(rail%tv(1) + rail%tv(size(rail%tv)))
      wheel = 0.0_wp
      associate (origin => bodies%placement%rail%origin)
         do j = 1, size(y)
            place = bodies%wheel%s_at(y(j) - bodies%placement%wheel%origin(2))
            row = no_surface
            do i = 1, size(x)
               call height_at(rail, s_ws + x(i), y(j) - origin(2), v, z, found)
               if (.not. found) cycle
               call find_wheel(bodies, seen, x(i), y(j), place, wheel, found)
               if (found) row(i) = z + origin(3) - wheel
            end do
            i = minloc(row, 1)
            gap(j) = row(i)
            place_of_gap(j) = x(i)
            if (i == 1 .or. i == size(x)) cycle
            bend = row(i - 1) - 2.0_wp*row(i) + row(i + 1)
            if (max(row(i - 1), row(i + 1)) >= no_surface .or. .not. bend > 0.0_wp) cycle
            shift = 0.5_wp*(row(i - 1) - row(i + 1))/bend
            gap(j) = row(i) - 0.5_wp*bend*shift**2
            place_of_gap(j) = x(i) + shift*(x(2) - x(1))
         end do
      end associate
   end subroutine smallest_gaps
end module contact_bench_point_by_point
