!> Contact search and undeformed distance for a rail that varies along the track or a wheel that is out of round
!>
!> The gap is a function of two coordinates. At each lateral position its smallest value along the track, and the
!> place where it is, take the part of the contact locus; what remains of the search is the same. The
!> table of gaps also tells how far regions extend along the track.
module contact_wheelrail_variable
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_wheelrail_bodies, only : find_rail_row, find_wheel, find_wheel_row, pair_bodies, search_reach
   use contact_wheelrail_flat_patch, only : nothing_there, settle_distance
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_gap, only : gap_curve, measure_gap, no_surface, smallest_in_row
   implicit none (type, external)
   private

   public :: measure_variable_gap, turn_of_rail, variable_distance

   !> Fine mesh along the track [mm], about: where the rail varies its points stand on sections
   real(wp), parameter :: fine_x = 0.5_wp
   !> Coarse mesh in fine steps, along the track and across it
   integer, parameter :: coarse = 8
   !> Gaps are found on the fine mesh up to this above the smallest [mm]: as much as most wheels penetrate rails. Elsewhere
   !> they are interpolated, with errors of about a hundredth of a millimetre
   real(wp), parameter :: least_depth = 0.2_wp
   !> The surfaces may be nearer to each other inside a coarse cell than at its corners by this [mm]
   real(wp), parameter :: hidden = 0.1_wp
   !> Lateral mesh relative to the elements
   real(wp), parameter :: mesh_share = 0.3_wp

contains

   !> Gap table and, for each lateral position, its smallest value
   subroutine measure_variable_gap(bodies, ds, weighs_table, gap, depth)
      type(pair_bodies), intent(inout) :: bodies
      !> Lateral size of the elements [mm]
      real(wp), intent(in) :: ds
      !> Are weights of regions to come from the table? Otherwise only the smallest gaps are kept
      logical, intent(in) :: weighs_table
      type(gap_curve), intent(inout) :: gap
      !> Penetration that will be asked for [mm], if it is known to be large
      real(wp), intent(in), optional :: depth
      real(wp), allocatable :: corner(:, :), table(:, :), xc(:), yc(:)
      integer, allocatable :: first(:), last(:)
      type(gap_curve) :: locus
      logical, allocatable :: near(:)
      logical :: prismatic
      real(wp) :: range(2), limit, dx, along
      integer :: nxc, nyc, i, j, ic, jc

      dx = fine_x
      if (allocated(bodies%rail_strip)) dx = bodies%rail_strip%step*max(1, nint(fine_x/bodies%rail_strip%step))
      along = search_reach(bodies)
      ! of prismatic bodies the locus is known: a flank may come near in less than a coarse cell, and far from the wheel
      prismatic = .not. (allocated(bodies%rail_strip) .or. allocated(bodies%wheel_strip))
      if (prismatic) then
         call measure_gap(bodies%rail, bodies%wheel, bodies%placement, ds, locus)
         near = locus%gap < min(minval(locus%gap) + least_depth + hidden, 0.5_wp*no_surface)
         if (any(near)) along = max(along, min(2.0_wp*coarse*dx + maxval(abs(locus%x - bodies%placement%wheel%origin(1)), near), &
            & 0.5_wp*bodies%placement%wheel_radius))
      end if
      nxc = 2*ceiling(along/(coarse*dx)) + 1
      xc = bodies%placement%wheel%origin(1) + [(dx*coarse*(i - (nxc + 1)/2), i=1, nxc)]
      range = lateral_range(bodies, xc)
      gap%dy = mesh_share*ds
      gap%n = ceiling((range(2) - range(1))/gap%dy) + 1
      gap%y = [(range(1) + (j - 1)*gap%dy, j=1, gap%n)]
      gap%kappa = 0.5_wp/bodies%placement%wheel_radius
      if (bodies%placement%roller_radius > 0.0_wp) gap%kappa = gap%kappa + 0.5_wp/bodies%placement%roller_radius
      gap%depth = least_depth
      if (present(depth)) gap%depth = max(depth, least_depth)

      nyc = max(1, (gap%n - 1 + coarse - 1)/coarse) + 1
      yc = gap%y(1) + [(gap%dy*coarse*(j - 1), j=1, nyc)]
      allocate(corner(nxc, nyc))
      call fill(bodies, xc, yc, spread(1, 1, nyc), spread(nxc, 1, nyc), corner)

      ! of each row along the track what is from the first to the last cell that may be near
      limit = minval(corner)
      if (prismatic) limit = min(limit, minval(locus%gap))
      limit = min(limit + gap%depth + hidden, 0.5_wp*no_surface)
      allocate(first(gap%n), source=(nxc - 1)*coarse + 1)
      allocate(last(gap%n), source=0)
      do jc = 1, nyc - 1
         j = (jc - 1)*coarse + 1
         do ic = 1, nxc - 1
            if (minval(corner(ic:ic + 1, jc:jc + 1)) > limit) cycle
            associate (rows => min(j + coarse, gap%n))
               first(j:rows) = min(first(j:rows), (ic - 1)*coarse + 1)
               last(j:rows) = max(last(j:rows), ic*coarse + 1)
            end associate
         end do
      end do
      if (prismatic) then
         do j = 1, min(gap%n, locus%n)
            if (.not. locus%gap(j) < limit) cycle
            ic = nint((locus%x(j) - xc(1))/dx) + 1
            first(j) = min(first(j), max(ic - coarse, 1))
            last(j) = max(last(j), min(ic + coarse, (nxc - 1)*coarse + 1))
         end do
      end if
      i = min(minval(first), (nxc - 1)*coarse)
      gap%x_table = xc(1) + [(dx*(ic - 1), ic=i, max(maxval(last), i + 1))]
      first = first - (i - 1)
      last = last - (i - 1)
      allocate(table(size(gap%x_table), gap%n), source=no_surface)
      if (weighs_table) then
         call fill(bodies, gap%x_table, gap%y, first, last, table)
      else
         call fill_valley(bodies, gap%x_table, gap%y, first, last, table)
      end if
      if (allocated(gap%beside)) deallocate(gap%beside, gap%x_beside)
      if (.not. weighs_table) call find_beside(bodies, first, last, table, gap)
      call find_smallest(bodies, gap, table, first, last, xc, corner)
      if (weighs_table) then
         call move_alloc(table, gap%table)
      else if (allocated(gap%table)) then
         deallocate(gap%table)
      end if
   end subroutine measure_variable_gap

   !> Lateral range of a rail that varies: of its sections at some places
   function lateral_range(bodies, x) result(range)
      type(pair_bodies), intent(inout) :: bodies
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

   !> Vertical gap at points of a mesh; the rail has sections at its places x
   subroutine fill(bodies, x, y, first, last, table)
      type(pair_bodies), intent(inout) :: bodies
      !> Rising
      real(wp), intent(in) :: x(:), y(:)
      !> Points that are wanted in each row along the track, none if the last one is before the first; the others stay
      integer, intent(in) :: first(:), last(:)
      !> Shape (x, y)
      real(wp), intent(inout) :: table(:, :)
      type(frame) :: track, seen
      real(wp) :: wheel(size(x))
      logical :: found(size(x))
      integer :: j

      call fill_rail(bodies, x, y, first, last, table)
      seen = bodies%placement%wheel%seen_from_here(track)
      do j = 1, size(y)
         if (first(j) > last(j)) cycle
         associate (row => table(first(j):last(j), j), n => last(j) - first(j) + 1)
            if (minval(row) >= no_surface) cycle
            call find_wheel_row(bodies, seen, x(first(j):last(j)), y(j), wheel(:n), found(:n))
            where (found(:n) .and. row < no_surface)
               row = row - wheel(:n)
            else where
               row = no_surface
            end where
         end associate
      end do
   end subroutine fill

   !> The same where only the smallest gap of each row counts
   !>
   !> Rows of the coarse mesh are searched throughout. What is smallest in the rows between lies between the places found
   !> there, or a little beyond; a row whose smallest gap is at an end of that stretch is searched throughout, too.
   subroutine fill_valley(bodies, x, y, first, last, table)
      type(pair_bodies), intent(inout) :: bodies
      !> See `fill`; on entry the table has no surface
      real(wp), intent(in) :: x(:), y(:)
      integer, intent(in) :: first(:), last(:)
      real(wp), intent(inout) :: table(:, :)
      !> Points beyond the places found
      integer, parameter :: beyond = 3
      integer :: from(size(y)), to(size(y)), lowest(size(y))
      logical :: open
      integer :: j, low, high

      from = size(x) + 1
      to = 0
      do j = 1, size(y)
         if (mod(j - 1, coarse) > 0 .and. j < size(y)) cycle
         from(j) = first(j)
         to(j) = last(j)
      end do
      call fill(bodies, x, y, from, to, table)
      lowest = minloc(table, 1)
      do j = 1, size(y)
         low = j - mod(j - 1, coarse)
         high = min(low + coarse, size(y))
         if (j == low .or. j == high) then
            from(j) = size(x) + 1
            to(j) = 0
         else
            from(j) = first(j)
            to(j) = last(j)
            if (max(table(lowest(low), low), table(lowest(high), high)) >= no_surface) cycle
            from(j) = max(first(j), min(lowest(low), lowest(high)) - beyond)
            to(j) = min(last(j), max(lowest(low), lowest(high)) + beyond)
         end if
      end do
      call fill(bodies, x, y, from, to, table)
      do j = 1, size(y)
         lowest(j) = minloc(table(:, j), 1)
         open = from(j) <= to(j) .and. (table(lowest(j), j) >= no_surface .or. lowest(j) == from(j) .or. lowest(j) == to(j))
         if (open .and. (from(j) > first(j) .or. to(j) < last(j))) then
            from(j) = first(j)
            to(j) = last(j)
         else
            from(j) = size(x) + 1
            to(j) = 0
         end if
      end do
      call fill(bodies, x, y, from, to, table)
   end subroutine fill_valley

   !> Places with a smallest gap of their own along the track, in rows of the coarse mesh that were searched throughout, and in rows
   !> next to those that have one
   subroutine find_beside(bodies, first, last, table, gap)
      type(pair_bodies), intent(inout) :: bodies
      !> See `fill`
      integer, intent(in) :: first(:), last(:)
      !> As `fill_valley` left it
      real(wp), intent(inout) :: table(:, :)
      !> `x_beside` and `beside` are set
      type(gap_curve), intent(inout) :: gap
      integer :: from(gap%n), to(gap%n)
      integer :: j, low, high

      allocate(gap%x_beside(gap%n), source=0.0_wp)
      allocate(gap%beside(gap%n), source=no_surface)
      do j = 1, gap%n
         if (mod(j - 1, coarse) > 0 .and. j < gap%n) cycle
         call second_smallest(gap%x_table, table(:, j), gap%x_beside(j), gap%beside(j))
      end do
      if (minval(gap%beside) >= no_surface) return
      from = size(gap%x_table) + 1
      to = 0
      do j = 1, gap%n
         low = j - mod(j - 1, coarse)
         high = min(low + coarse, gap%n)
         if (j == low .or. j == high .or. min(gap%beside(low), gap%beside(high)) >= no_surface) cycle
         from(j) = first(j)
         to(j) = last(j)
      end do
      call fill(bodies, gap%x_table, gap%y, from, to, table)
      do j = 1, gap%n
         if (from(j) <= to(j)) call second_smallest(gap%x_table, table(:, j), gap%x_beside(j), gap%beside(j))
      end do
   end subroutine find_beside

   !> The second smallest of the minima of a row
   pure subroutine second_smallest(x, g, place, value)
      real(wp), intent(in) :: x(:), g(:)
      !> `no_surface` where there is one minimum only
      real(wp), intent(out) :: place, value
      !> Gaps between two minima are larger by this at least [mm]
      real(wp), parameter :: ridge = 1.0e-4_wp
      real(wp) :: highest
      integer :: i, side, lowest

      place = 0.0_wp
      value = no_surface
      lowest = minloc(g, 1)
      do side = -1, 1, 2
         highest = g(lowest)
         do i = lowest + side, merge(size(g), 1, side > 0), side
            highest = max(highest, g(i))
            if (g(i) >= value .or. g(i) > highest - ridge) cycle
            place = x(i)
            value = g(i)
         end do
      end do
   end subroutine second_smallest

   !> Height of the rail at points of a mesh, section after section
   subroutine fill_rail(bodies, x, y, first, last, table)
      type(pair_bodies), intent(inout) :: bodies
      !> See `fill`
      real(wp), intent(in) :: x(:), y(:)
      integer, intent(in) :: first(:), last(:)
      real(wp), intent(inout) :: table(:, :)
      real(wp) :: z(size(y)), rho
      logical :: wanted(size(y)), found(size(y))
      integer :: rows(size(y))
      integer :: i, k, n

      do i = minval(first), maxval(last)
         wanted = first <= i .and. i <= last
         n = count(wanted)
         if (n == 0) cycle
         rows(:n) = pack([(k, k=1, size(y))], wanted)
         call rail_heights(bodies, x(i), y(rows(:n)), z(:n), found(:n))
         if (bodies%placement%roller_radius > 0.0_wp) then
            do k = 1, n
               rho = bodies%placement%roller_radius - z(k)
               found(k) = found(k) .and. abs(x(i)) < rho
               if (found(k)) z(k) = bodies%placement%roller_radius - sqrt(rho**2 - x(i)**2)
            end do
         end if
         table(i, rows(:n)) = merge(z(:n), no_surface, found(:n))
      end do
   end subroutine fill_rail

   !> Heights of the rail's section at a place where it has one
   subroutine rail_heights(bodies, x, y, z, found)
      type(pair_bodies), intent(inout) :: bodies
      real(wp), intent(in) :: x
      !> Rising
      real(wp), intent(in) :: y(:)
      real(wp), intent(out) :: z(:)
      logical, intent(out) :: found(:)
      integer :: k

      if (.not. allocated(bodies%rail_strip)) then
         call bodies%rail%heights(y, z, found)
         return
      end if
      z = 0.0_wp
      found = .false.
      associate (along => bodies%rail_strip)
         k = along%number_at(x)
         if (k == 0) return
         call along%need(k)
         if (along%sections(k)%present) call along%sections(k)%curve%heights(y, z, found)
      end associate
   end subroutine rail_heights

   !> Place and value of the smallest gap along the track at each lateral position; the rail there
   subroutine find_smallest(bodies, gap, table, first, last, xc, corner)
      type(pair_bodies), intent(inout) :: bodies
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
      type(pair_bodies), intent(inout) :: bodies
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
      type(pair_bodies), intent(inout) :: bodies
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
      type(pair_bodies), intent(inout) :: bodies
      type(frame), intent(in) :: plane
      !> See `settle_distance`
      logical, intent(in) :: joined
      type(potential_contact), intent(in) :: grid
      !> Shape (mx, my)
      real(wp), allocatable, intent(inout) :: h(:, :)
      !> See `settle_distance`
      real(wp), intent(out) :: approach
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
