!> Contact search and undeformed distance for a rail that varies along the track or a wheel that is out of round
!>
!> The gap is a function of two coordinates. At each lateral position, its minimum along the track and the position of this minimum
!> replace the contact locus of round bodies; the rest of the search is the same. The table of gaps also gives the extent of regions
!> along the track.
module contact_wheelrail_variable
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_wheelrail_bodies, only : find_rail_row, find_wheel, find_wheel_row, wheel_rail_bodies, search_reach, &
      & slice_pair, strip, widest_reach
   use contact_wheelrail_first_penetration, only : hertz_penetration
   use contact_wheelrail_flat_patch, only : nothing_there, shift_distance
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_gap_bound, only : bound_gap, rail_extent
   use contact_wheelrail_gap, only : gap_curve, measure_gap, no_surface, smallest_in_row
   use contact_wheelrail_gap_mesh, only : fill
   implicit none (type, external)
   private

   public :: measure_variable_gap, turn_of_rail, variable_distance

   !> Approximate step of the fine mesh along the track [mm]; if the rail varies, its points are at sections
   real(wp), parameter :: fine_x = 0.5_wp
   !> Step of the coarse mesh in steps of the fine mesh, along the track and across it
   integer, parameter :: coarse = 8
   !> Gaps are computed on the fine mesh up to this value above the smallest one [mm], the maximum penetration of most wheels; if a
   !> wheel varies and a force presses it on a rail that does not, to the penetration by this force (`depth_under`).
   !> Elsewhere they are those of the contact locus if the bodies are prismatic, otherwise interpolated, with errors of about a
   !> hundredth of a millimetre on a tread
   real(wp), parameter :: min_depth = 0.2_wp
   !> Maximum decrease of the gap of prismatic bodies within a coarse cell, below its corners [mm]; larger decreases are found by
   !> the contact locus
   real(wp), parameter :: hidden = 0.1_wp
   !> Step of the lateral mesh relative to the elements. For a wheel that varies on a rail that does not, places and forces of a
   !> patch change by 1e-5 or less with half the step; noses and joints of rails are narrower. Prismatic bodies have the mesh of
   !> their locus
   real(wp), parameter :: mesh_share = 0.3_wp, mesh_share_of_wheel = 0.6_wp
   !> Distance of points for inclinations of the rail, relative to the elements
   real(wp), parameter :: difference_share = 0.15_wp

contains

   !> Table of gaps and, for each lateral position, its minimum
   subroutine measure_variable_gap(bodies, ds, weighs_table, gap, depth, load)
      !> Sections and positions of rail and wheel; sections are computed as needed
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Lateral size of the elements [mm]
      real(wp), intent(in) :: ds
      !> Are weights of regions computed from the table? Otherwise it is kept to detect regions that were omitted
      logical, intent(in) :: weighs_table
      !> Mesh, gaps and table are set; arrays of equal size are reused
      type(gap_curve), intent(inout) :: gap
      !> Penetration to be expected [mm], if it is known to be large
      real(wp), intent(in), optional :: depth
      !> Prescribed force over G/(1 - nu) [mm2], from which the penetration of a wheel that varies is estimated if it is not known;
      !> 0: none
      real(wp), intent(in), optional :: load
      real(wp), allocatable :: corner(:, :), table(:, :), xc(:), yc(:), least(:)
      integer, allocatable :: first(:), last(:)
      type(gap_curve) :: locus
      logical, allocatable :: near(:)
      logical :: prismatic
      real(wp) :: range(2), dx, along, origin
      integer :: nxc, nyc, i, j, ic

      dx = fine_x
      if (allocated(bodies%rail_strip)) dx = bodies%rail_strip%step*max(1, nint(fine_x/bodies%rail_strip%step))
      origin = bodies%placement%wheel%origin(1)
      along = search_reach(bodies)
      ! the locus of prismatic bodies is known: on a flank the gap may be small within less than a coarse cell, and far from the
      ! axle
      prismatic = .not. (allocated(bodies%rail_strip) .or. allocated(bodies%wheel_strip))
      if (prismatic) then
         call measure_gap(bodies%rail, bodies%wheel, bodies%placement, ds, locus)
         near = locus%gap < min(minval(locus%gap) + min_depth + hidden, 0.5_wp*no_surface)
         if (any(near)) along = max(along, min(2.0_wp*coarse*dx + maxval(abs(locus%x - origin), near), &
            & 0.5_wp*bodies%placement%wheel_radius))
      end if
      nxc = 2*ceiling(along/(coarse*dx)) + 1
      xc = origin + [(dx*coarse*(i - (nxc + 1)/2), i=1, nxc)]
      gap%dy = merge(mesh_share, mesh_share_of_wheel, allocated(bodies%rail_strip))*ds
      if (prismatic) gap%dy = locus%dy
      range = lateral_range(bodies, xc)
      if (allocated(bodies%rail_strip)) call widen_rows(bodies%rail_strip, xc([1, nxc]), coarse*gap%dy, range)
      gap%n = ceiling((range(2) - range(1))/gap%dy) + 1
      gap%y = [(range(1) + (j - 1)*gap%dy, j=1, gap%n)]
      gap%kappa = 0.5_wp/bodies%placement%wheel_radius
      if (bodies%placement%roller_radius > 0.0_wp) gap%kappa = gap%kappa + 0.5_wp/bodies%placement%roller_radius
      gap%depth = min_depth
      if (present(depth)) gap%depth = max(depth, min_depth)

      nyc = max(1, (gap%n - 1 + coarse - 1)/coarse) + 1
      yc = gap%y(1) + [(gap%dy*coarse*(j - 1), j=1, nyc)]
      allocate(corner(nxc, nyc))
      call fill(bodies, xc, yc, spread(1, 1, nyc), spread(nxc, 1, nyc), corner)
      if (present(load) .and. .not. (present(depth) .or. prismatic .or. allocated(bodies%rail_strip))) &
         & gap%depth = depth_under(load, corner, (coarse*dx)*(coarse*gap%dy))
      allocate(first(gap%n), source=(nxc - 1)*coarse + 1)
      allocate(last(gap%n), source=0)
      allocate(least(gap%n), source=-no_surface)
      gap%far = no_surface
      if (prismatic) then
         call choose_by_corners(gap, locus, xc, corner, first, last)
      else
         call choose_by_bounds(bodies, gap, xc, minval(corner), first, last, least)
      end if
      i = min(minval(first), (nxc - 1)*coarse)
      gap%x_table = xc(1) + [(dx*(ic - 1), ic=i, max(maxval(last), i + 1))]
      first = first - (i - 1)
      last = last - (i - 1)
      allocate(table(size(gap%x_table), gap%n), source=no_surface)
      call fill(bodies, gap%x_table, gap%y, first, last, table)
      call find_smallest(bodies, gap, table, first, last, xc, corner, locus)
      call find_inclinations(bodies, difference_share*ds, gap)
      where (last < first .and. gap%gap < no_surface) gap%gap = max(gap%gap, least)
      if (allocated(gap%table)) deallocate(gap%table)
      if (allocated(gap%unweighed)) deallocate(gap%unweighed)
      if (weighs_table) then
         call move_alloc(table, gap%table)
      else
         call move_alloc(table, gap%unweighed)
      end if
   end subroutine measure_variable_gap

   !> Depth of the table of a wheel that varies [mm], from the force and the area within which the gap exceeds the smallest one by
   !> less than `min_depth`
   pure real(wp) function depth_under(load, corner, cell) result(depth)
      !> See `measure_variable_gap`
      real(wp), intent(in) :: load
      !> Gaps of the coarse mesh [mm], and area of a cell [mm2]
      real(wp), intent(in) :: corner(:, :), cell
      !> Ratio to the penetration by Hertz's theory, as the shape of the gap is known roughly: the gap is measured again for deeper
      !> trials
      real(wp), parameter :: margin = 1.2_wp
      !> Number of points from which the area is known well enough, and limits of the depth [mm]
      integer, parameter :: enough = 16
      real(wp), parameter :: least = 0.05_wp, most = 1.0_wp
      integer :: n

      n = count(corner < min(minval(corner) + min_depth, no_surface))
      depth = min_depth
      ! a paraboloid a x**2 + b y**2 is below min_depth on an ellipse of area pi min_depth/sqrt(a b)
      if (n >= enough .and. load > 0.0_wp) depth = min(max(margin*hertz_penetration(load, pi*min_depth/(n*cell)), least), most)
   end function depth_under

   !> Choose in each row along the track the range of cells whose gap may be small, for prismatic bodies
   subroutine choose_by_corners(gap, locus, xc, corner, first, last)
      !> Gap with its rows and depth, and gap of the contact locus
      type(gap_curve), intent(in) :: gap, locus
      !> Positions along the track and gaps of the coarse mesh [mm], shape (x, y)
      real(wp), intent(in) :: xc(:), corner(:, :)
      !> First and last point on the fine mesh, whose first point is that of the coarse mesh; none is chosen on entry
      integer, intent(inout) :: first(:), last(:)
      real(wp) :: limit
      integer :: ic, jc, j, nxc, beside

      nxc = size(xc)
      limit = min(min(minval(corner), minval(locus%gap)) + gap%depth + hidden, 0.5_wp*no_surface)
      do jc = 1, size(corner, 2) - 1
         j = (jc - 1)*coarse + 1
         do ic = 1, nxc - 1
            if (minval(corner(ic:ic + 1, jc:jc + 1)) > limit) cycle
            associate (rows => min(j + coarse, gap%n))
               first(j:rows) = min(first(j:rows), (ic - 1)*coarse + 1)
               last(j:rows) = max(last(j:rows), ic*coarse + 1)
            end associate
         end do
      end do
      do j = 1, min(gap%n, locus%n)
         if (.not. locus%gap(j) < limit) cycle
         ic = nint((locus%x(j) - xc(1))*coarse/(xc(2) - xc(1))) + 1
         ! along the track the gap is a parabola, and a cell more is for what it neglects
         beside = coarse + ceiling(sqrt((limit - locus%gap(j))/gap%kappa)*coarse/(xc(2) - xc(1)))
         first(j) = min(first(j), max(ic - beside, 1))
         last(j) = max(last(j), min(ic + beside, (nxc - 1)*coarse + 1))
      end do
   end subroutine choose_by_corners

   !> The same for bodies that vary, by lower bounds of the gap, which hold for any shape
   subroutine choose_by_bounds(bodies, gap, xc, smallest, first, last, least)
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Gap with its rows and depth; `far` and `far_place` are set
      type(gap_curve), intent(inout) :: gap
      !> Positions of the coarse mesh along the track [mm]
      real(wp), intent(in) :: xc(:)
      !> Upper bound of the smallest gap [mm]
      real(wp), intent(in) :: smallest
      !> See `choose_by_corners`
      integer, intent(inout) :: first(:), last(:)
      !> Lower bounds of the gap in each row [mm]
      real(wp), intent(inout) :: least(:)
      !> Maximum number of cells with lowest bound that are evaluated to find a smaller gap, and accepted difference of gap and
      !> bound [mm]
      integer, parameter :: tries = 20
      real(wp), parameter :: near_enough = 0.05_wp
      real(wp), allocatable :: low(:, :)
      real(wp) :: limit, distance, place(2), step
      integer :: cells, j, ic

      cells = size(xc) - 1
      step = (xc(2) - xc(1))/coarse
      allocate(low(cells, gap%n))
      call bound_gap(bodies, xc, gap%y, smallest + gap%depth, low)
      do j = 1, gap%n
         least(j) = minval(low(:, j))
      end do
      limit = smallest
      call look_closer(bodies, xc, gap%y, low, step, near_enough, tries, limit, place, without_swings=.false.)
      limit = min(limit + gap%depth, 0.5_wp*no_surface)
      do j = 1, gap%n
         do ic = 1, cells
            if (low(ic, j) > limit) cycle
            first(j) = min(first(j), (ic - 1)*coarse + 1)
            last(j) = ic*coarse + 1
         end do
      end do
      call look_beyond(-1)
      call look_beyond(1)

   contains

      !> Smallest gap on one side outside the range of the search, if it may close
      subroutine look_beyond(side)
         !> Side along the track, -1 or 1
         integer, intent(in) :: side
         !> Length of cells in cells of the coarse mesh, in two attempts; usually the first one is sufficient
         integer, parameter :: together(2) = [8, 2]
         !> Number of further cells that are evaluated after an overlap was found
         integer, parameter :: enough = 5
         real(wp), allocatable :: edges(:), beyond(:, :)
         integer :: n, i, k

         distance = min(limit, gap%far)
         do k = 1, size(together)
            associate (origin => bodies%placement%wheel%origin(1), length => together(k)*(xc(2) - xc(1)), &
               & start => merge(xc(1), xc(cells + 1), side < 0))
               n = ceiling((widest_reach(bodies) - abs(start - origin))/length)
               if (n <= 0) return
               edges = [(start + length*i, i=merge(-n, 0, side < 0), merge(0, n, side < 0))]
            end associate
            if (allocated(beyond)) deallocate(beyond)
            allocate(beyond(n, gap%n))
            call bound_gap(bodies, edges, gap%y, distance, beyond)
            if (minval(beyond) >= distance) return
         end do
         call look_closer(bodies, edges, gap%y, beyond, step, 0.0_wp, enough, distance, place, without_swings=.true.)
         if (distance >= min(limit, gap%far)) return
         gap%far = distance
         gap%far_place = place
      end subroutine look_beyond
   end subroutine choose_by_bounds

   !> Evaluate the gap in cells with lowest bounds, until no smaller gap is possible, or the maximum number of cells is reached
   subroutine look_closer(bodies, edges, y, low, step, margin, most, smallest, place, without_swings)
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Ends of the cells, and positions of the rows [mm]
      real(wp), intent(in) :: edges(:), y(:)
      !> Lower bounds of the gap [mm], shape (cells, rows)
      real(wp), intent(in) :: low(:, :)
      !> Step of the fine mesh along the track; improvements of the smallest gap below the margin are ignored [mm]
      real(wp), intent(in) :: step, margin
      !> Maximum number of cells after the first one below `smallest`; with a margin, of all cells
      integer, intent(in) :: most
      !> Smallest known gap on entry, smallest gap found on exit [mm], and its position x, y if it is smaller
      real(wp), intent(inout) :: smallest
      real(wp), intent(inout) :: place(2)
      !> Exclude overshoot of a rail at sudden changes between slices? A warning was given when the rail was read
      logical, intent(in) :: without_swings
      type(slice_pair) :: slices
      real(wp) :: waiting(size(low, 1), size(low, 2)), least(size(low, 2))
      real(wp), allocatable :: row(:, :), x(:)
      real(wp) :: z(1)
      logical :: found(1)
      integer :: cell(2), i, n, looked, stride
      integer, parameter :: few = 4

      n = nint((edges(2) - edges(1))/step)
      allocate(row(n + 1, 1))
      waiting = low
      least = minval(low, 1)
      looked = 0
      do while (looked < most)
         cell(2) = minloc(least, 1)
         if (least(cell(2)) >= min(smallest - margin, 0.5_wp*no_surface)) exit
         cell(1) = minloc(waiting(:, cell(2)), 1)
         ! most cells do not give a smaller gap, so a coarse step is tried first
         do stride = merge(few, 1, mod(n, few) == 0), 1, -(few - 1)
            x = edges(cell(1)) + [(i*step, i=0, n, stride)]
            row = no_surface
            call fill(bodies, x, y(cell(2):cell(2)), [1], [size(x)], row(:size(x), :))
            i = minloc(row(:, 1), 1)
            if (row(i, 1) < smallest) exit
         end do
         i = min(i, size(x))
         if (without_swings .and. allocated(bodies%rail_strip) .and. row(i, 1) < smallest) then
            call bodies%rail_strip%heights(bodies%rail_strip%number_at(x(i)), y(cell(2):cell(2)), z, found)
            row(i, 1) = row(i, 1) + slices%overshoot(bodies%rail_strip, x(i), y(cell(2)), z(1))
            if (looked == 0) looked = 1
         end if
         if (row(i, 1) < smallest) then
            smallest = row(i, 1)
            place = [x(i), y(cell(2))]
            if (looked == 0) looked = 1
         end if
         if (looked > 0 .or. margin > 0.0_wp) looked = looked + 1
         waiting(cell(1), cell(2)) = no_surface
         least(cell(2)) = minval(waiting(:, cell(2)))
      end do
   end subroutine look_closer

   !> Lateral range of a rail that varies, from its sections at some positions
   function lateral_range(bodies, x) result(range)
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Positions along the track [mm]
      real(wp), intent(in) :: x(:)
      real(wp) :: range(2), one(2)
      integer :: i

      if (.not. allocated(bodies%rail_strip)) then
         range = bodies%rail%y_range()
         return
      end if
      range = [huge(1.0_wp), -huge(1.0_wp)]
      associate (along => bodies%rail_strip)
         do i = 1, size(x)
            one = along%y_range(along%number_at(x(i)))
            range = [min(range(1), one(1)), max(range(2), one(2))]
         end do
      end associate
      if (range(1) > range(2)) range = 0.0_wp
   end function lateral_range

   !> Extend the lateral range to positions that a rail has between its sections, in whole steps
   subroutine widen_rows(along, range_x, step, range)
      type(strip), intent(in) :: along
      !> Range along the track [mm], and lateral step [mm]
      real(wp), intent(in) :: range_x(2), step
      !> Lateral range in track coordinates [mm]
      real(wp), intent(inout) :: range(2)
      !> Bounding boxes are slightly larger than the surface: extensions by less than this fraction of a step are ignored
      real(wp), parameter :: least = 0.1_wp
      real(wp) :: wide(2), top

      call rail_extent(along, range_x, wide, top)
      range(1) = range(1) - step*max(0, ceiling((range(1) - wide(1))/step - least))
      range(2) = range(2) + step*max(0, ceiling((wide(2) - range(2))/step - least))
   end subroutine widen_rows

   !> Position and value of the smallest gap along the track at each lateral position, and height and inclination of the rail there
   subroutine find_smallest(bodies, gap, table, first, last, xc, corner, locus)
      type(wheel_rail_bodies), intent(inout) :: bodies
      type(gap_curve), intent(inout) :: gap
      !> Gaps on the fine mesh [mm], shape (x, y), and first and last point in each row
      real(wp), intent(in) :: table(:, :)
      integer, intent(in) :: first(:), last(:)
      !> Positions along the track and gaps of the coarse mesh [mm], shape (x, y), for rows without points
      real(wp), intent(in) :: xc(:), corner(:, :)
      !> The same by the contact locus, for rows without points of prismatic bodies; no rows if the bodies vary
      type(gap_curve), intent(in) :: locus
      type(frame) :: track, seen
      real(wp) :: place, wheel
      logical :: found
      integer :: j

      gap%x = spread(0.0_wp, 1, gap%n)
      gap%gap = spread(no_surface, 1, gap%n)
      gap%z = gap%x
      seen = bodies%placement%wheel%seen_from_here(track)
      wheel = 0.0_wp
      do j = 1, gap%n
         if (last(j) >= first(j)) then
            call smallest_in_row(gap%x_table(first(j):last(j)), table(first(j):last(j), j), gap%x(j), gap%gap(j))
         else if (j <= locus%n) then
            ! between corners the gap of a flank may be off by many millimetres
            gap%x(j) = locus%x(j)
            gap%gap(j) = locus%gap(j)
         else
            call smallest_between(xc, corner, real(j - 1, wp)/coarse, gap%x(j), gap%gap(j))
         end if
         if (gap%gap(j) >= no_surface) cycle
         place = bodies%wheel%s_at(gap%y(j) - bodies%placement%wheel%origin(2))
         call find_wheel(bodies, seen, gap%x(j), gap%y(j), place, wheel, found)
         if (found) then
            gap%z(j) = wheel + gap%gap(j)
         else
            wheel = 0.0_wp
         end if
      end do
   end subroutine find_smallest

   !> Smallest gap between two rows of the coarse mesh
   pure subroutine smallest_between(x, corner, row, place, lowest)
      real(wp), intent(in) :: x(:), corner(:, :)
      !> Position of the row, in coarse steps from the first one
      real(wp), intent(in) :: row
      real(wp), intent(out) :: place, lowest
      real(wp) :: g(size(x)), t
      integer :: jc, i

      jc = min(int(row) + 1, size(corner, 2) - 1)
      t = row - (jc - 1)
      g = no_surface
      where (max(corner(:, jc), corner(:, jc + 1)) < no_surface) g = (1.0_wp - t)*corner(:, jc) + t*corner(:, jc + 1)
      i = minloc(g, 1)
      place = x(i)
      lowest = g(i)
   end subroutine smallest_between

   !> Inclinations of the rail across the track at the positions of the smallest gap [rad], by finite differences; one-sided at ends
   !>
   !> They are those of the section at the contact: wheel and rail have a common tangent there, and the plane of a patch contains
   !> the direction of the track. The section below the axle is used on request only (doc/theory/wheel_rail.md).
   subroutine find_inclinations(bodies, step, gap)
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Distance of points [mm]
      real(wp), intent(in) :: step
      type(gap_curve), intent(inout) :: gap
      real(wp) :: height(gap%n, 3), slope, x
      logical :: there(gap%n, 3)
      integer :: j, k, low, high

      gap%alpha = spread(0.0_wp, 1, gap%n)
      there = .false.
      do k = 1, 3
         if (.not. allocated(bodies%rail_strip)) then
            call bodies%rail%heights(gap%y + (k - 2)*step, height(:, k), there(:, k))
            cycle
         end if
         do j = 1, gap%n
            if (gap%gap(j) >= no_surface) cycle
            x = merge(bodies%placement%wheel%origin(1), gap%x(j), bodies%angle_below_axle)
            call bodies%rail_strip%at(x, gap%y(j) + (k - 2)*step, height(j, k), slope, there(j, k))
         end do
      end do
      do j = 1, gap%n
         low = findloc(there(j, :), .true., 1)
         high = findloc(there(j, :), .true., 1, back=.true.)
         if (high > low) gap%alpha(j) = atan((height(j, high) - height(j, low))/((high - low)*step))
      end do
   end subroutine find_inclinations

   !> Inclination of the rail at a position of contact minus that in the section below the axle [rad]; 0 if either is missing
   real(wp) function turn_of_rail(bodies, x, y) result(turn)
      !> Sections and positions of rail and wheel; sections are computed as needed
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Position in track coordinates [mm]
      real(wp), intent(in) :: x, y
      !> Distance of the points of the finite differences [mm]
      real(wp), parameter :: step = 0.1_wp
      real(wp) :: height(2, 2), place, slope
      logical :: there(2, 2)
      integer :: j, k

      turn = 0.0_wp
      if (.not. allocated(bodies%rail_strip)) return
      do k = 1, 2
         place = merge(bodies%placement%wheel%origin(1), x, k == 1)
         do j = 1, 2
            call bodies%rail_strip%at(place, y + (j - 1.5_wp)*step, height(j, k), slope, there(j, k))
         end do
      end do
      if (all(there)) turn = atan((height(2, 2) - height(1, 2))/step) - atan((height(2, 1) - height(1, 1))/step)
   end function turn_of_rail

   !> Distance of the undeformed bodies above a plane [mm], shifted to a minimum of zero, and the approach
   subroutine variable_distance(bodies, plane, joined, grid, h, approach, left_out)
      !> Sections and positions of rail and wheel; sections are computed as needed
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Plane of the patch, in track coordinates
      type(frame), intent(in) :: plane
      !> See `shift_distance`
      logical, intent(in) :: joined
      !> Grid of elements
      type(potential_contact), intent(in) :: grid
      !> Undeformed distance [mm], shape (mx, my)
      real(wp), allocatable, intent(inout) :: h(:, :)
      !> See `shift_distance`
      real(wp), intent(out) :: approach
      !> Number of excluded elements, see `shift_distance`
      integer, intent(out) :: left_out
      type(frame) :: seen
      real(wp) :: x(grid%mx), n_wheel(grid%mx), n_rail(grid%mx)
      logical :: on_wheel(grid%mx), on_rail(grid%mx)
      integer :: ix, iy

      if (allocated(h)) then
         if (any(shape(h) /= [grid%mx, grid%my])) deallocate(h)
      end if
      if (.not. allocated(h)) allocate(h(grid%mx, grid%my))
      seen = bodies%placement%wheel%seen_from_here(plane)
      x = [(grid%x(ix), ix=1, grid%mx)]
      do iy = 1, grid%my
         call find_rail_row(bodies, plane, x, grid%y(iy), n_rail, on_rail)
         call find_wheel_row(bodies, seen, x, grid%y(iy), n_wheel, on_wheel)
         h(:, iy) = merge(n_rail - n_wheel, nothing_there, on_rail .and. on_wheel)
      end do
      call shift_distance(grid, joined, h, approach, left_out)
   end subroutine variable_distance
end module contact_wheelrail_variable
