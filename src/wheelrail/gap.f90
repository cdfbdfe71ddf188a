!> The vertical gap between wheel and rail along the contact locus
!>
!> A rail (or roller) that is prismatic along the track touches a wheel only at points where the wheel's surface is level along the
!> track. These points, one for each lateral position, are the contact locus. In vertical view the gap there is g(y) = z_rail(y) -
!> z_wheel(y), z down, negative for interpenetration; if the wheel is lowered by dz the gap decreases by dz everywhere, so that one
!> gap curve serves all heights.
module contact_wheelrail_gap
   use contact_base_kinds, only : wp
   use contact_profile_curve, only : profile_curve
   use contact_wheelrail_gap_survey, only : furthest, gap_survey
   use contact_wheelrail_locus, only : locus_at, locus_in_piece
   use contact_wheelrail_placement, only : wheel_rail_placement
   implicit none (type, external)
   private

   public :: gap_curve, measure_gap, measure_part, rail_in_track, smallest_in_row

   !> Gap where rail or wheel is missing [mm]
   real(wp), parameter, public :: no_surface = 999.0_wp

   !> Gap on an even mesh over the rail, track coordinates
   type :: gap_curve
      !> Number of points, and their distance [mm]
      integer :: n = 0
      real(wp) :: dy = 0.0_wp
      !> Lateral position, longitudinal position of the locus, gap [mm]; shape (n)
      real(wp), allocatable :: y(:), x(:), gap(:)
      !> Height of the rail [mm] and its inclination [rad]
      real(wp), allocatable :: z(:), alpha(:)
      !> 1/(2 r): curvature of wheel and roller along the track [1/mm]
      real(wp) :: kappa = 0.0_wp
      !> Gap over an even mesh along the track as well, shape (x_table, y), as far as it is within `depth` of the smallest one.
      !> Weights of regions are computed from it; if it is unallocated, from `gap` and `kappa`
      real(wp), allocatable :: x_table(:), table(:, :)
      !> The same table if weights are not computed from it: used to find contact outside the regions
      real(wp), allocatable :: unweighed(:, :)
      !> The smallest gap beyond the reach of the search along the track [mm], if it may close, and its position x, y [mm]
      real(wp) :: far = no_surface, far_place(2) = 0.0_wp
      !> Penetration for which the mesh is suited [mm]
      real(wp) :: depth = huge(1.0_wp)
      !> Index of the mesh point of another curve whose surroundings this curve resolves on a finer mesh; 0: the whole rail
      integer :: shows = 0
      !> Does the rail exist at a mesh point?
      logical, allocatable, private :: on_rail(:)
      !> Lateral positions in the track of the nodes of the wheel's profile [mm]
      real(wp), allocatable, private :: lateral(:)
      !> Estimates used instead of the gap at points where it is far from the smallest one, if `is_surveyed`
      type(gap_survey), private :: survey
      logical, private :: is_surveyed = .false.
   end type gap_curve

   !> Mesh width relative to the elements
   real(wp), parameter :: mesh_share = 0.3_wp
   !> Smallest mesh width [mm]
   real(wp), parameter :: min_mesh = 1.0e-3_wp
   !> The minimum of the parabola through three mesh points is accurate if the gap there differs by less than this fraction of the
   !> increase of the gap to the next points; parabolas of resolved contacts are accurate to 0.2 %
   real(wp), parameter :: right_share = 0.01_wp
   !> A finer mesh extends over `shown` mesh points to either side, and has `finer` times as many points
   integer, parameter :: shown = 6, finer = 8
   !> Maximum number of points of a finer mesh
   integer, parameter, public :: most_finer = 2*shown*finer + 1
   !> Finer meshes are used for gaps that exceed the smallest one by less than this: deeper contacts are not narrow [mm]
   real(wp), parameter :: looked_at = 1.0_wp

   !> Tolerance relative to the mesh width, so that no point is lost between two pieces
   real(wp), parameter :: tiny_part = 1.0e-9_wp

contains

   !> The rail's profile in track coordinates
   function rail_in_track(rail, placement) result(curve)
      !> Profile in the rail's own coordinates
      type(profile_curve), intent(in) :: rail
      !> Position of the rail's origin in the track, and its rotation
      type(wheel_rail_placement), intent(in) :: placement
      type(profile_curve) :: curve
      real(wp) :: angle, origin(2)

      angle = placement%rail%roll()
      ! origin of the track in rail coordinates
      origin = [-cos(angle)*placement%rail%origin(2) - sin(angle)*placement%rail%origin(3), &
         & sin(angle)*placement%rail%origin(2) - cos(angle)*placement%rail%origin(3)]
      curve = rail%seen_from(origin, -angle)
   end function rail_in_track

   !> Gap between a rail and a wheel at their present positions
   subroutine measure_gap(rail, wheel, placement, ds, gap, closer, keeps_rail, reach)
      !> The rail in track coordinates
      type(profile_curve), intent(in) :: rail
      !> The wheel in its own coordinates
      type(profile_curve), intent(in) :: wheel
      !> Position of the bodies
      type(wheel_rail_placement), intent(in) :: placement
      !> Lateral size of the elements [mm]
      real(wp), intent(in) :: ds
      !> Mesh and gap; its arrays are kept if they have the right size
      type(gap_curve), intent(inout) :: gap
      !> If the mesh is too coarse for a smallest gap: its surroundings on finer meshes
      type(gap_curve), allocatable, intent(inout), optional :: closer(:)
      !> Are rail and elements the same as in the previous call with `gap`? Default no
      logical, intent(in), optional :: keeps_rail
      !> Gaps that exceed the smallest one by more than this are estimates [mm]; default none
      real(wp), intent(in), optional :: reach
      logical :: keeps
      real(wp) :: range(2), dy
      integer :: n

      if (allocated(gap%table)) deallocate(gap%table)
      if (allocated(gap%unweighed)) deallocate(gap%unweighed)
      range = rail%y_range()
      dy = max(mesh_share*ds, min_mesh)
      n = ceiling((range(2) - range(1))/dy) + 1
      if (allocated(gap%lateral)) then
         if (size(gap%lateral) /= size(wheel%y%s)) deallocate(gap%lateral)
      end if
      if (.not. allocated(gap%lateral)) allocate(gap%lateral(size(wheel%y%s)))
      keeps = .false.
      if (present(keeps_rail)) keeps = keeps_rail
      if (.not. keeps) call lay_mesh(rail, range(1), dy, n, gap)
      gap%is_surveyed = present(reach)
      if (gap%is_surveyed) then
         call survey_gap(rail, wheel, placement, reach, gap)
      else
         call lateral_positions(wheel, placement, rail, [range(1), range(1) + n*dy], gap%lateral)
         call fill_gap(rail, wheel, placement, gap%lateral, gap)
      end if
      if (gap%is_surveyed) gap%depth = reach
      if (present(closer)) call look_closer(rail, wheel, placement, gap, closer)
   end subroutine measure_gap

   !> Gap between a prismatic rail and a round wheel at their present positions, in a part of the rail
   subroutine measure_part(rail, wheel, placement, start, dy, n, gap)
      !> The rail in track coordinates
      type(profile_curve), intent(in) :: rail
      !> The wheel in its own coordinates
      type(profile_curve), intent(in) :: wheel
      !> Position of the bodies
      type(wheel_rail_placement), intent(in) :: placement
      !> First lateral position, and distance of positions [mm]
      real(wp), intent(in) :: start, dy
      !> Number of positions
      integer, intent(in) :: n
      !> Mesh and gap
      type(gap_curve), intent(inout) :: gap
      real(wp) :: lateral(size(wheel%y%s))

      call lateral_positions(wheel, placement, rail, [start, start + n*dy], lateral)
      call lay_mesh(rail, start, dy, n, gap)
      call fill_gap(rail, wheel, placement, lateral, gap)
   end subroutine measure_part

   !> Compute the surroundings on a finer mesh if the parabola through three mesh points is not accurate
   subroutine look_closer(rail, wheel, placement, gap, closer)
      !> As in `measure_gap`
      type(profile_curve), intent(in) :: rail, wheel
      type(wheel_rail_placement), intent(in) :: placement
      !> Measured gap; lateral positions of all nodes are added if a finer mesh is needed
      type(gap_curve), intent(inout) :: gap
      !> On entry meshes of the previous gap, whose arrays are kept
      type(gap_curve), allocatable, intent(inout) :: closer(:)
      type(gap_curve), allocatable :: fewer(:)
      type(gap_curve) :: another
      real(wp) :: y, lowest, smallest
      integer :: i, n, first, last

      if (.not. allocated(closer)) allocate(closer(0))
      smallest = minval(gap%gap)
      n = 0
      do i = 2, gap%n - 1
         if (gap%gap(i) > gap%gap(i - 1) .or. gap%gap(i) > gap%gap(i + 1)) cycle
         if (maxval(gap%gap(i - 1:i + 1)) >= no_surface .or. gap%gap(i) > smallest + looked_at) cycle
         call smallest_in_row(gap%y(i - 1:i + 1), gap%gap(i - 1:i + 1), y, lowest)
         if (abs(gap_at(rail, wheel, placement, gap, i, y) - lowest) &
            & <= right_share*(maxval(gap%gap(i - 1:i + 1)) - gap%gap(i))) cycle
         n = n + 1
         if (n == 1 .and. gap%is_surveyed) &
            & call lateral_positions(wheel, placement, rail, [gap%y(1), gap%y(gap%n) + gap%dy], gap%lateral)
         if (n > size(closer)) closer = [closer, another]
         first = max(1, i - shown)
         last = min(gap%n, i + shown)
         call lay_mesh(rail, gap%y(first), gap%dy/finer, (last - first)*finer + 1, closer(n))
         call fill_gap(rail, wheel, placement, gap%lateral, closer(n))
         closer(n)%shows = i
      end do
      if (n == size(closer)) return
      fewer = closer(:n)
      call move_alloc(fewer, closer)
   end subroutine look_closer

   !> Gap at one lateral position [mm]
   real(wp) function gap_at(rail, wheel, placement, gap, near, y) result(lowest)
      !> As in `measure_gap`
      type(profile_curve), intent(in) :: rail, wheel
      type(wheel_rail_placement), intent(in) :: placement
      !> Measured gap
      type(gap_curve), intent(in) :: gap
      !> Inner mesh point next to the position
      integer, intent(in) :: near
      !> Lateral position in the track [mm]
      real(wp), intent(in) :: y
      real(wp) :: point(3), s, x, z
      integer :: k
      logical :: on_rail

      lowest = no_surface
      call rail%find(y, s, on_rail)
      if (.not. on_rail) return
      z = rail%z%value(s)
      if (gap%is_surveyed) then
         call lower_to_pieces(rail, wheel, placement, gap, near - 1, near + 1, y, z, lowest, x)
         return
      end if
      associate (lateral => gap%lateral)
         do k = 1, size(lateral) - 1
            if (.not. lateral(k) > lateral(k + 1)) cycle
            if (y - lateral(k) > tiny_part*gap%dy .or. lateral(k + 1) - y > tiny_part*gap%dy) cycle
            point = locus_at(wheel, placement, rail, y, k, lateral(k), lateral(k + 1))
            lowest = min(lowest, z + placement%roller_drop(point(1), z) - point(3))
         end do
      end associate
   end function gap_at

   !> Lateral positions at even distances, and the rail there
   subroutine lay_mesh(rail, start, dy, n, gap)
      !> Profile in track coordinates
      type(profile_curve), intent(in) :: rail
      !> First lateral position, distance [mm] and number of the positions
      real(wp), intent(in) :: start, dy
      integer, intent(in) :: n
      !> Mesh, heights and inclinations; its arrays are kept if they have the right size
      type(gap_curve), intent(inout) :: gap
      real(wp) :: s
      integer :: i

      gap%dy = dy
      gap%n = n
      call give_size(gap%y, n)
      call give_size(gap%x, n)
      call give_size(gap%gap, n)
      call give_size(gap%z, n)
      call give_size(gap%alpha, n)
      ! a search over a grid gives the other arrays its own size and leaves this one as it is
      if (allocated(gap%on_rail)) then
         if (size(gap%on_rail) /= n) deallocate(gap%on_rail)
      end if
      if (.not. allocated(gap%on_rail)) allocate(gap%on_rail(n))
      gap%z = 0.0_wp
      gap%alpha = 0.0_wp
      do i = 1, n
         gap%y(i) = start + (i - 1)*dy
         call rail%find(gap%y(i), s, gap%on_rail(i))
         if (.not. gap%on_rail(i)) cycle
         gap%z(i) = rail%z%value(s)
         gap%alpha(i) = rail%inclination(s)
      end do
   end subroutine lay_mesh

   !> Allocate an array; it is kept if it has the right size
   subroutine give_size(array, n)
      real(wp), allocatable, intent(inout) :: array(:)
      !> Size
      integer, intent(in) :: n

      if (allocated(array)) then
         if (size(array) == n) return
         deallocate(array)
      end if
      allocate(array(n))
   end subroutine give_size

   !> Gap at the points of a mesh
   subroutine fill_gap(rail, wheel, placement, lateral, gap)
      !> As in `measure_gap`
      type(profile_curve), intent(in) :: rail, wheel
      type(wheel_rail_placement), intent(in) :: placement
      !> Lateral positions in the track of the nodes of the wheel's profile [mm]
      real(wp), intent(in) :: lateral(:)
      !> With the mesh, see `lay_mesh`; gap and longitudinal positions are set
      type(gap_curve), intent(inout) :: gap
      real(wp) :: start
      integer :: k

      call forget_last(placement, gap)
      gap%x = 0.0_wp
      gap%gap = no_surface
      start = gap%y(1)
      associate (nodes => wheel%y%s)
         do k = 1, size(nodes) - 1
            ! the surface faces the rail if y decreases along the profile
            if (lateral(k) > lateral(k + 1)) call add_piece(k, lateral(k:k + 1))
         end do
      end associate

   contains

      !> Gap at the mesh points below a piece of the wheel's profile; if the locus of a rough profile folds, the lowest piece is
      !> used
      subroutine add_piece(piece, lateral)
         !> Number of the piece
         integer, intent(in) :: piece
         !> Decreasing lateral positions of its ends [mm]
         real(wp), intent(in) :: lateral(2)
         real(wp) :: point(3), vertical
         integer :: i

         do i = max(1, ceiling((lateral(2) - start)/gap%dy - tiny_part) + 1), &
            & min(gap%n, floor((lateral(1) - start)/gap%dy + tiny_part) + 1)
            if (.not. gap%on_rail(i)) cycle
            point = locus_at(wheel, placement, rail, gap%y(i), piece, lateral(1), lateral(2))
            vertical = gap%z(i) + placement%roller_drop(point(1), gap%z(i)) - point(3)
            if (vertical >= gap%gap(i)) cycle
            gap%x(i) = point(1)
            gap%gap(i) = vertical
         end do
      end subroutine add_piece
   end subroutine fill_gap

   !> Set what does not depend on the mesh, and remove results of the last gap
   pure subroutine forget_last(placement, gap)
      type(wheel_rail_placement), intent(in) :: placement
      type(gap_curve), intent(inout) :: gap

      gap%far = no_surface
      gap%depth = huge(gap%depth)
      gap%kappa = 0.5_wp/placement%wheel_radius
      if (placement%roller_radius > 0.0_wp) gap%kappa = gap%kappa + 0.5_wp/placement%roller_radius
   end subroutine forget_last

   !> Gap at the points of a mesh, computed exactly where it may be small
   subroutine survey_gap(rail, wheel, placement, reach, gap)
      !> As in `measure_gap`
      type(profile_curve), intent(in) :: rail, wheel
      type(wheel_rail_placement), intent(in) :: placement
      !> Gaps that exceed the smallest one by more than this are estimates [mm]
      real(wp), intent(in) :: reach
      !> With the mesh, see `lay_mesh`; gap and longitudinal positions are set
      type(gap_curve), intent(inout) :: gap
      integer :: left(gap%n), i, n_left

      call forget_last(placement, gap)
      call gap%survey%look(wheel, placement, gap%y, gap%z, gap%on_rail, no_surface, reach, looked_at, gap%gap, gap%x)
      call gap%survey%compute(wheel, placement, gap%y, gap%z, gap%gap, gap%x, n_left, left)
      do i = 1, n_left
         gap%gap(left(i)) = no_surface
         gap%x(left(i)) = 0.0_wp
         call lower_to_pieces(rail, wheel, placement, gap, left(i), left(i), gap%y(left(i)), gap%z(left(i)), gap%gap(left(i)), &
            & gap%x(left(i)))
      end do
   end subroutine survey_gap

   !> Lower a gap to that below the pieces of the wheel at a lateral position, by a survey of the gap
   subroutine lower_to_pieces(rail, wheel, placement, gap, first, last, y, z, lowest, x)
      !> As in `measure_gap`
      type(profile_curve), intent(in) :: rail, wheel
      type(wheel_rail_placement), intent(in) :: placement
      !> Surveyed gap
      type(gap_curve), intent(in) :: gap
      !> Mesh points around the position
      integer, intent(in) :: first, last
      !> Lateral position and height of the rail there [mm]
      real(wp), intent(in) :: y, z
      !> Gap, and longitudinal position of the locus [mm]
      real(wp), intent(inout) :: lowest, x
      real(wp) :: point(3), high, low, vertical
      integer :: k, n

      n = size(wheel%y%s)
      associate (pieces => gap%survey%pieces(:, first:last))
         low = huge(low)
         ! exact ends of pieces may be on the other side of a mesh point than the estimates
         do k = max(1, minval(pieces(1, :)) - 1), min(n - 1, maxval(pieces(2, :)) + 1)
            high = low
            if (.not. high < huge(high)) then
               point = locus_in_piece(wheel, placement, k, 0.0_wp, rail)
               high = point(2)
            end if
            point = locus_in_piece(wheel, placement, min(k + 1, n - 1), merge(wheel%y%s(n) - wheel%y%s(n - 1), 0.0_wp, &
               & k + 1 == n), rail)
            low = point(2)
            if (.not. high > low .or. y - high > tiny_part*gap%dy .or. low - y > tiny_part*gap%dy) cycle
            point = locus_at(wheel, placement, rail, y, k, high, low)
            vertical = z + placement%roller_drop(point(1), z) - point(3)
            if (vertical >= lowest) cycle
            lowest = vertical
            x = point(1)
         end do
      end associate
   end subroutine lower_to_pieces

   !> Smallest gap of a row of points, interpolated by a parabola
   pure subroutine smallest_in_row(x, g, place, lowest)
      !> Increasing positions along the row, and gaps there [mm]
      real(wp), intent(in) :: x(:), g(:)
      !> Position and value of the smallest gap [mm]
      real(wp), intent(out) :: place, lowest
      real(wp) :: bend, shift
      integer :: i

      i = minloc(g, 1)
      place = x(i)
      lowest = g(i)
      if (i == 1 .or. i == size(x)) return
      if (max(g(i - 1), g(i + 1)) >= no_surface) return
      bend = g(i - 1) - 2.0_wp*g(i) + g(i + 1)
      if (.not. bend > 0.0_wp) return
      shift = 0.5_wp*(g(i - 1) - g(i + 1))/bend
      place = place + shift*(x(2) - x(1))
      lowest = lowest - 0.5_wp*bend*shift**2
   end subroutine smallest_in_row

   !> Lateral positions in the track of the locus at the nodes of the wheel's profile [mm]
   !>
   !> Positions of pieces far from the rail are estimates.
   subroutine lateral_positions(wheel, placement, rail, range, lateral)
      type(profile_curve), intent(in) :: wheel
      type(wheel_rail_placement), intent(in) :: placement
      !> See `locus_in_piece`
      type(profile_curve), intent(in) :: rail
      !> Range regarded as near [mm]
      real(wp), intent(in) :: range(2)
      !> One position per node [mm]
      real(wp), intent(out) :: lateral(:)
      !> Maximum distance of the locus above the lowest point of its circle, relative to the radius
      real(wp), parameter :: highest = 0.2_wp
      real(wp) :: point(3)
      integer :: i, n, last, here, next

      n = size(lateral)
      call estimate(1, here)
      last = here
      do i = 1, n
         next = here
         if (i < n) call estimate(i + 1, next)
         if (here == 0 .or. last /= here .or. next /= here) then
            point = locus_in_piece(wheel, placement, min(i, n - 1), start_of(i), rail)
            lateral(i) = point(2)
         end if
         last = here
         here = next
      end do

   contains

      !> Estimate the lateral position at a node
      subroutine estimate(node, side)
         integer, intent(in) :: node
         !> Position of the node relative to the range: -1 below, 1 above; 0: within
         integer, intent(out) :: side
         real(wp) :: margin, y, z, slope

         associate (axes => placement%wheel%axes)
            call wheel%y%in_piece(min(node, n - 1), start_of(node), y, slope)
            call wheel%z%in_piece(min(node, n - 1), start_of(node), z, slope)
            lateral(node) = placement%wheel%origin(2) + axes(2, 2)*y + axes(2, 3)*z
            margin = (placement%wheel_radius + abs(z))*(furthest*abs(axes(2, 1)) + highest*abs(axes(2, 3)))
         end associate
         side = 0
         if (lateral(node) + margin < range(1)) side = -1
         if (lateral(node) - margin > range(2)) side = 1
      end subroutine estimate

      !> Distance of a node from the beginning of its piece: 0, except for the last node [mm]
      pure real(wp) function start_of(node)
         integer, intent(in) :: node

         start_of = merge(wheel%y%s(n) - wheel%y%s(n - 1), 0.0_wp, node == n)
      end function start_of
   end subroutine lateral_positions
end module contact_wheelrail_gap
