!> Contact search and undeformed distance for a rail that varies along the track or a wheel that is out of round
!>
!> The gap is a function of two coordinates. At each lateral position its smallest value along the track, and the
!> place where it is, take the part of the contact locus; what remains of the search is the same. The
!> table of gaps also tells how far regions extend along the track.
module contact_wheelrail_variable
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_wheelrail_bodies, only : find_rail_row, find_wheel, find_wheel_row, wheel_rail_bodies, search_reach, &
      & slice_pair, strip, widest_reach
   use contact_wheelrail_flat_patch, only : nothing_there, settle_distance
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_gap_bound, only : bound_gap, rail_extent
   use contact_wheelrail_gap, only : gap_curve, measure_gap, no_surface, smallest_in_row
   use contact_wheelrail_gap_mesh, only : fill, rail_heights
   implicit none (type, external)
   private

   public :: measure_variable_gap, turn_of_rail, variable_distance

   !> Fine mesh along the track [mm], about: where the rail varies its points stand on sections
   real(wp), parameter :: fine_x = 0.5_wp
   !> Coarse mesh in fine steps, along the track and across it
   integer, parameter :: coarse = 8
   !> Gaps are found on the fine mesh up to this above the smallest [mm]: as much as most wheels penetrate rails. Elsewhere
   !> they are interpolated, with errors of about a hundredth of a millimetre
   real(wp), parameter :: min_depth = 0.2_wp
   !> Prismatic bodies may be nearer to each other inside a coarse cell than at its corners by this [mm]; the contact locus tells
   !> where they are nearer still
   real(wp), parameter :: hidden = 0.1_wp
   !> Lateral mesh relative to the elements
   real(wp), parameter :: mesh_share = 0.3_wp

contains

   !> Gap table and, for each lateral position, its smallest value
   subroutine measure_variable_gap(bodies, ds, weighs_table, gap, depth)
      !> Sections of rail and wheel, and where they are; sections that are needed are made
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Lateral size of the elements [mm]
      real(wp), intent(in) :: ds
      !> Are weights of regions to come from the table? Otherwise it is kept to see what they leave out
      logical, intent(in) :: weighs_table
      !> Gets mesh, gaps and table; its arrays are kept when they have the right size
      type(gap_curve), intent(inout) :: gap
      !> Penetration that will be asked for [mm], if it is known to be large
      real(wp), intent(in), optional :: depth
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
      ! of prismatic bodies the locus is known: a flank may come near in less than a coarse cell, and far from the wheel
      prismatic = .not. (allocated(bodies%rail_strip) .or. allocated(bodies%wheel_strip))
      if (prismatic) then
         call measure_gap(bodies%rail, bodies%wheel, bodies%placement, ds, locus)
         near = locus%gap < min(minval(locus%gap) + min_depth + hidden, 0.5_wp*no_surface)
         if (any(near)) along = max(along, min(2.0_wp*coarse*dx + maxval(abs(locus%x - origin), near), &
            & 0.5_wp*bodies%placement%wheel_radius))
      end if
      nxc = 2*ceiling(along/(coarse*dx)) + 1
      xc = origin + [(dx*coarse*(i - (nxc + 1)/2), i=1, nxc)]
      gap%dy = mesh_share*ds
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
      call find_smallest(bodies, gap, table, first, last, xc, corner)
      where (last < first .and. gap%gap < no_surface) gap%gap = max(gap%gap, least)
      if (allocated(gap%table)) deallocate(gap%table)
      if (allocated(gap%unweighed)) deallocate(gap%unweighed)
      if (weighs_table) then
         call move_alloc(table, gap%table)
      else
         call move_alloc(table, gap%unweighed)
      end if
   end subroutine measure_variable_gap

   !> Of each row along the track what is from the first to the last cell that may be near: prismatic bodies
   subroutine choose_by_corners(gap, locus, xc, corner, first, last)
      !> With its rows and its depth, and that of the contact locus
      type(gap_curve), intent(in) :: gap, locus
      !> Places along the track and gaps of the coarse mesh [mm], shape (x, y)
      real(wp), intent(in) :: xc(:), corner(:, :)
      !> Numbers on the fine mesh, which begins with the coarse one; on entry no point is chosen
      integer, intent(inout) :: first(:), last(:)
      real(wp) :: limit
      integer :: ic, jc, j, nxc

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
         first(j) = min(first(j), max(ic - coarse, 1))
         last(j) = max(last(j), min(ic + coarse, (nxc - 1)*coarse + 1))
      end do
   end subroutine choose_by_corners

   !> The same of bodies that vary, by lower bounds of the gap: what is left out is farther away, whatever its shape
   subroutine choose_by_bounds(bodies, gap, xc, smallest, first, last, least)
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> With its rows and its depth; `far` and `far_place` are set
      type(gap_curve), intent(inout) :: gap
      !> Places of the coarse mesh along the track [mm]
      real(wp), intent(in) :: xc(:)
      !> A gap that is known [mm]
      real(wp), intent(in) :: smallest
      !> See `choose_by_corners`
      integer, intent(inout) :: first(:), last(:)
      !> Lower bounds of the gaps of rows [mm]
      real(wp), intent(inout) :: least(:)
      !> How often a smaller gap is looked for where the bound is lowest, and by how much it may be larger than the bound [mm]
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

      !> Beyond the reach of the search on one side: the smallest gap, if it is one that may close
      subroutine look_beyond(side)
         !> Sign along the track
         integer, intent(in) :: side
         !> Cells are as long as so many of the coarse mesh; in most cases the first ones are enough
         integer, parameter :: together(2) = [8, 2]
         !> An overlap is told as it is found after so many cells more
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

   !> Gaps of cells whose bound is lowest, until none can be smaller than what is known, or enough cells were looked at
   subroutine look_closer(bodies, edges, y, low, step, margin, most, smallest, place, without_swings)
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Ends of cells, and rows [mm]
      real(wp), intent(in) :: edges(:), y(:)
      !> Lower bounds [mm], shape (cells, rows)
      real(wp), intent(in) :: low(:, :)
      !> Fine mesh along the track; gaps that are smaller by less than the margin do not matter [mm]
      real(wp), intent(in) :: step, margin
      !> Cells that are looked at after one that is nearer than `smallest`; with a margin in all
      integer, intent(in) :: most
      !> What is known on entry, what is found on exit [mm], and its place x, y if it is smaller
      real(wp), intent(inout) :: smallest
      real(wp), intent(inout) :: place(2)
      !> Leave out what a rail makes of sudden changes between slices? It was told when the rail was read
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
         ! most sections are made for nothing, so a few come first
         do stride = merge(few, 1, mod(n, few) == 0), 1, -(few - 1)
            x = edges(cell(1)) + [(i*step, i=0, n, stride)]
            row = no_surface
            call fill(bodies, x, y(cell(2):cell(2)), [1], [size(x)], row(:size(x), :))
            i = minloc(row(:, 1), 1)
            if (row(i, 1) < smallest) exit
         end do
         i = min(i, size(x))
         if (without_swings .and. allocated(bodies%rail_strip) .and. row(i, 1) < smallest) then
            call rail_heights(bodies, x(i), y(cell(2):cell(2)), z, found)
            row(i, 1) = row(i, 1) + slices%swing(bodies%rail_strip, x(i), y(cell(2)), z(1))
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

   !> Lateral range of a rail that varies: of its sections at some places
   function lateral_range(bodies, x) result(range)
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> [mm]
      real(wp), intent(in) :: x(:)
      real(wp) :: range(2), one(2)
      integer :: i, k

      if (.not. allocated(bodies%rail_strip)) then
         range = bodies%rail%y_range()
         return
      end if
      range = [huge(1.0_wp), -huge(1.0_wp)]
      associate (along => bodies%rail_strip)
         do i = 1, size(x)
            k = along%number_at(x(i))
            if (k == 0) cycle
            call along%need(k)
            if (.not. along%sections(k)%present) cycle
            one = along%sections(k)%curve%y_range()
            range = [min(range(1), one(1)), max(range(2), one(2))]
         end do
      end associate
      if (range(1) > range(2)) range = 0.0_wp
   end function lateral_range

   !> Lateral positions that a rail has between its sections and beyond their range, in whole steps
   subroutine widen_rows(along, range_x, step, range)
      type(strip), intent(in) :: along
      !> Of the track [mm], and the step [mm]
      real(wp), intent(in) :: range_x(2), step
      !> In track coordinates [mm]
      real(wp), intent(inout) :: range(2)
      !> Boxes are a little wider than what they hold: less than this part of a step is left out
      real(wp), parameter :: least = 0.1_wp
      real(wp) :: wide(2), top

      call rail_extent(along, range_x, wide, top)
      range(1) = range(1) - step*max(0, ceiling((range(1) - wide(1))/step - least))
      range(2) = range(2) + step*max(0, ceiling((wide(2) - range(2))/step - least))
   end subroutine widen_rows

   !> Place and value of the smallest gap along the track at each lateral position; the rail there
   subroutine find_smallest(bodies, gap, table, first, last, xc, corner)
      type(wheel_rail_bodies), intent(inout) :: bodies
      type(gap_curve), intent(inout) :: gap
      !> Gaps of the fine mesh [mm], shape (x, y), and where they are in each row
      real(wp), intent(in) :: table(:, :)
      integer, intent(in) :: first(:), last(:)
      !> Places along the track and gaps of the coarse mesh [mm], shape (x, y), for rows without points
      real(wp), intent(in) :: xc(:), corner(:, :)
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
      call find_inclinations(bodies, gap)
   end subroutine find_smallest

   !> Smallest gap between two rows of the coarse mesh
   pure subroutine smallest_between(x, corner, row, place, lowest)
      real(wp), intent(in) :: x(:), corner(:, :)
      !> Counted from 0 at the first one
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

   !> Inclinations of the rail across the track at the places of the smallest gap [rad], by differences; one-sided at ends
   !>
   !> They belong to the section of the contact: wheel and rail share their tangent there, and the plane of a patch holds
   !> the direction of the track. The section below the axle is taken on request only (doc/theory/wheel_rail.md).
   subroutine find_inclinations(bodies, gap)
      type(wheel_rail_bodies), intent(inout) :: bodies
      type(gap_curve), intent(inout) :: gap
      real(wp) :: height(gap%n, 3), slope, x
      logical :: there(gap%n, 3)
      integer :: j, k, low, high

      gap%alpha = spread(0.0_wp, 1, gap%n)
      there = .false.
      do k = 1, 3
         if (.not. allocated(bodies%rail_strip)) then
            call bodies%rail%heights(gap%y + 0.5_wp*(k - 2)*gap%dy, height(:, k), there(:, k))
            cycle
         end if
         do j = 1, gap%n
            if (gap%gap(j) >= no_surface) cycle
            x = merge(bodies%placement%wheel%origin(1), gap%x(j), bodies%angle_below_axle)
            call bodies%rail_strip%at(x, gap%y(j) + 0.5_wp*(k - 2)*gap%dy, height(j, k), slope, there(j, k))
         end do
      end do
      do j = 1, gap%n
         low = findloc(there(j, :), .true., 1)
         high = findloc(there(j, :), .true., 1, back=.true.)
         if (high > low) gap%alpha(j) = atan((height(j, high) - height(j, low))/(0.5_wp*(high - low)*gap%dy))
      end do
   end subroutine find_inclinations

   !> How much more the rail is inclined at a place of contact than in the section below the axle [rad]; 0 where either is missing
   real(wp) function turn_of_rail(bodies, x, y) result(turn)
      !> Sections of rail and wheel, and where they are; sections that are needed are made
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> The place in track coordinates [mm]
      real(wp), intent(in) :: x, y
      !> Distance of the points whose heights are compared [mm]
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

   !> Distance of the undeformed bodies over a plane [mm], shifted so that its minimum is zero, and the approach
   subroutine variable_distance(bodies, plane, joined, grid, h, approach, strangers)
      !> Sections of rail and wheel, and where they are; sections that are needed are made
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Plane of the patch, in track coordinates
      type(frame), intent(in) :: plane
      !> See `settle_distance`
      logical, intent(in) :: joined
      !> Centres of the elements
      type(potential_contact), intent(in) :: grid
      !> Shape (mx, my)
      real(wp), allocatable, intent(inout) :: h(:, :)
      !> See `settle_distance`
      real(wp), intent(out) :: approach
      !> Elements that are left out, as for `settle_distance`
      integer, intent(out) :: strangers
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
      call settle_distance(grid, joined, h, approach, strangers)
   end subroutine variable_distance
end module contact_wheelrail_variable
