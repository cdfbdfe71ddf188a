!> Contact search and undeformed distance for a rail that varies along the track or a wheel that is out of round
!>
!> The gap is a function of two coordinates. At each lateral position its smallest value along the track, and the
!> place where it is, take the part of the contact locus; what remains of the search is the same. The
!> table of gaps also tells how far regions extend along the track.
module contact_wheelrail_variable
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_wheelrail_bodies, only : find_rail, find_wheel, pair_bodies
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_gap, only : gap_curve, no_surface
   implicit none (type, external)
   private

   public :: measure_variable_gap, variable_distance

   !> Fine mesh along the track [mm], about: where the rail varies its points stand on sections
   real(wp), parameter :: fine_x = 0.5_wp
   !> Coarse mesh in fine steps, along the track and across it
   integer, parameter :: coarse = 8
   !> Gaps are found on the fine mesh where the coarse one is within this of the smallest [mm]: more than wheels
   !> penetrate rails. Elsewhere they are interpolated, with errors of about a hundredth of a millimetre
   real(wp), parameter :: margin = 0.5_wp
   !> Lateral mesh relative to the elements, and search along the track to both sides, of the radius
   real(wp), parameter :: mesh_share = 0.3_wp, reach = 0.125_wp
   !> Distance where a surface is missing [mm]
   real(wp), parameter :: nothing_there = 999.0_wp

contains

   !> Gap table and, for each lateral position, its smallest value
   subroutine measure_variable_gap(bodies, ds, weighs_table, gap)
      type(pair_bodies), intent(in) :: bodies
      !> Lateral size of the elements [mm]
      real(wp), intent(in) :: ds
      !> See `gap_curve`
      logical, intent(in) :: weighs_table
      type(gap_curve), intent(inout) :: gap
      real(wp), allocatable :: corner(:, :), xc(:), yc(:)
      real(wp) :: range(2), limit, dx
      integer :: nx, nxc, nyc, i, j, ic, jc

      range = lateral_range(bodies)
      gap%dy = mesh_share*ds
      gap%n = ceiling((range(2) - range(1))/gap%dy) + 1
      gap%y = [(range(1) + (j - 1)*gap%dy, j=1, gap%n)]
      gap%x = 0.0_wp*gap%y
      gap%gap = no_surface + 0.0_wp*gap%y
      gap%z = 0.0_wp*gap%y
      gap%alpha = 0.0_wp*gap%y
      gap%kappa = 0.5_wp/bodies%placement%wheel_radius
      if (bodies%placement%roller_radius > 0.0_wp) gap%kappa = gap%kappa + 0.5_wp/bodies%placement%roller_radius
      gap%weighs_table = weighs_table

      dx = fine_x
      if (allocated(bodies%rail_strip)) dx = bodies%rail_strip%step*max(1, nint(fine_x/bodies%rail_strip%step))
      nxc = 2*ceiling(reach*bodies%placement%wheel_radius/(coarse*dx)) + 1
      nyc = (gap%n - 1 + coarse - 1)/coarse + 1
      xc = bodies%placement%wheel%origin(1) + [(dx*coarse*(i - (nxc + 1)/2), i=1, nxc)]
      yc = gap%y(1) + [(gap%dy*coarse*(j - 1), j=1, nyc)]
      allocate(corner(nxc, nyc))
      call fill(bodies, xc, yc, corner)
      limit = minval(corner) + margin

      nx = (nxc - 1)*coarse + 1
      gap%x_table = xc(1) + [(dx*(i - 1), i=1, nx)]
      if (allocated(gap%table)) deallocate(gap%table)
      allocate(gap%table(nx, gap%n), source=no_surface)
      if (limit > no_surface) return
      do jc = 1, nyc - 1
         do ic = 1, nxc - 1
            i = (ic - 1)*coarse + 1
            j = (jc - 1)*coarse + 1
            if (minval(corner(ic:ic + 1, jc:jc + 1)) > limit) then
               if (maxval(corner(ic:ic + 1, jc:jc + 1)) < no_surface) &
                  & call interpolate(corner(ic:ic + 1, jc:jc + 1), gap%table(i:i + coarse, j:min(j + coarse, gap%n)))
               cycle
            end if
            call fill(bodies, gap%x_table(i:i + coarse), gap%y(j:min(j + coarse, gap%n)), &
               & gap%table(i:i + coarse, j:min(j + coarse, gap%n)))
         end do
      end do
      do j = 1, gap%n
         call smallest_along(bodies, j, gap)
      end do
   end subroutine measure_variable_gap

   !> Gaps of the fine mesh inside a cell of the coarse one; what was found at its sides stays
   pure subroutine interpolate(corners, cell)
      real(wp), intent(in) :: corners(2, 2)
      real(wp), intent(inout) :: cell(:, :)
      real(wp) :: t, u
      integer :: i, j

      do j = 1, size(cell, 2)
         u = real(j - 1, wp)/coarse
         do i = 1, size(cell, 1)
            if (cell(i, j) < no_surface) cycle
            t = real(i - 1, wp)/(size(cell, 1) - 1)
            cell(i, j) = (1.0_wp - u)*((1.0_wp - t)*corners(1, 1) + t*corners(2, 1)) &
               & + u*((1.0_wp - t)*corners(1, 2) + t*corners(2, 2))
         end do
      end do
   end subroutine interpolate

   !> Lateral range of all sections of the rail
   pure function lateral_range(bodies) result(range)
      type(pair_bodies), intent(in) :: bodies
      real(wp) :: range(2), one(2)
      integer :: k

      if (.not. allocated(bodies%rail_strip)) then
         range = bodies%rail%y_range()
         return
      end if
      range = [huge(1.0_wp), -huge(1.0_wp)]
      do k = 1, size(bodies%rail_strip%sections)
         if (.not. bodies%rail_strip%sections(k)%present) cycle
         one = bodies%rail_strip%sections(k)%curve%y_range()
         range = [min(range(1), one(1)), max(range(2), one(2))]
      end do
      if (range(1) > range(2)) range = 0.0_wp
   end function lateral_range

   !> Vertical gap on a mesh
   pure subroutine fill(bodies, x, y, table)
      type(pair_bodies), intent(in) :: bodies
      real(wp), intent(in) :: x(:), y(:)
      !> Shape (x, y)
      real(wp), intent(out) :: table(:, :)
      type(frame) :: track, seen
      real(wp) :: place, start, rail, wheel
      logical :: found
      integer :: i, j

      seen = bodies%placement%wheel%seen_from_here(track)
      rail = 0.0_wp
      wheel = 0.0_wp
      do j = 1, size(y)
         start = bodies%wheel%s_at(y(j) - bodies%placement%wheel%origin(2))
         place = start
         do i = 1, size(x)
            table(i, j) = no_surface
            call find_rail(bodies, track, x(i), y(j), rail, found)
            if (.not. found) cycle
            call find_wheel(bodies, seen, x(i), y(j), place, wheel, found)
            if (.not. found) then
               place = start
               wheel = 0.0_wp
               cycle
            end if
            table(i, j) = rail - wheel
         end do
      end do
   end subroutine fill

   !> Place and value of the smallest gap along the track, by a parabola; the rail there
   !>
   !> The inclination is that of the rail's section at the wheelset, not at the place of the smallest gap: the
   !> established program does so, and published results depend on it where a rail changes quickly (0.025 rad for
   !> a wing rail that moves sideways 1:10).
   pure subroutine smallest_along(bodies, j, gap)
      type(pair_bodies), intent(in) :: bodies
      integer, intent(in) :: j
      type(gap_curve), intent(inout) :: gap
      type(frame) :: track
      real(wp) :: bend, shift
      logical :: found
      integer :: i

      i = minloc(gap%table(:, j), 1)
      gap%gap(j) = gap%table(i, j)
      gap%x(j) = gap%x_table(i)
      if (gap%gap(j) >= no_surface) return
      if (i > 1 .and. i < size(gap%x_table)) then
         if (max(gap%table(i - 1, j), gap%table(i + 1, j)) < no_surface) then
            bend = gap%table(i - 1, j) - 2.0_wp*gap%table(i, j) + gap%table(i + 1, j)
            shift = 0.0_wp
            if (bend > 0.0_wp) shift = 0.5_wp*(gap%table(i - 1, j) - gap%table(i + 1, j))/bend
            gap%x(j) = gap%x(j) + shift*(gap%x_table(2) - gap%x_table(1))
            gap%gap(j) = gap%gap(j) - 0.5_wp*bend*shift**2
         end if
      end if
      call find_rail(bodies, track, gap%x(j), gap%y(j), gap%z(j), found)
      if (.not. found) return
      call find_inclination(bodies, bodies%placement%wheel%origin(1), gap%y(j), gap%dy, gap%alpha(j), found)
      if (.not. found) call find_inclination(bodies, gap%x(j), gap%y(j), gap%dy, gap%alpha(j), found)
   end subroutine smallest_along

   !> Inclination of the rail across the track [rad], by a difference; one-sided at ends
   pure subroutine find_inclination(bodies, x, y, dy, alpha, found)
      type(pair_bodies), intent(in) :: bodies
      !> Place in the track and distance of the two points [mm]
      real(wp), intent(in) :: x, y, dy
      !> Unchanged where there is no surface
      real(wp), intent(inout) :: alpha
      !> Is there any surface?
      logical, intent(out) :: found
      type(frame) :: track
      real(wp) :: height(3)
      logical :: there(3)
      integer :: k, low, high

      height = 0.0_wp
      do k = 1, 3
         call find_rail(bodies, track, x, y + 0.5_wp*(k - 2)*dy, height(k), there(k))
      end do
      low = findloc(there, .true., 1)
      high = findloc(there, .true., 1, back=.true.)
      found = high > low
      if (found) alpha = atan((height(high) - height(low))/(0.5_wp*(high - low)*dy))
   end subroutine find_inclination

   !> Distance of the undeformed bodies over a plane [mm], shifted so that its minimum is zero, and the approach
   subroutine variable_distance(bodies, plane, grid, h, approach)
      type(pair_bodies), intent(in) :: bodies
      type(frame), intent(in) :: plane
      type(potential_contact), intent(in) :: grid
      !> Shape (mx, my)
      real(wp), allocatable, intent(inout) :: h(:, :)
      !> Largest interpenetration along n [mm]; negative when the bodies do not touch
      real(wp), intent(out) :: approach
      type(frame) :: seen
      real(wp) :: s, n_rail, n_wheel, place, start
      logical :: found
      integer :: ix, iy

      if (allocated(h)) then
         if (any(shape(h) /= [grid%mx, grid%my])) deallocate(h)
      end if
      if (.not. allocated(h)) allocate(h(grid%mx, grid%my))
      seen = bodies%placement%wheel%seen_from_here(plane)
      start = bodies%wheel%s_at(seen%origin(2))
      do iy = 1, grid%my
         s = grid%y(iy)
         place = start
         n_rail = 0.0_wp
         n_wheel = 0.0_wp
         do ix = 1, grid%mx
            h(ix, iy) = nothing_there
            call find_rail(bodies, plane, grid%x(ix), s, n_rail, found)
            if (.not. found) then
               n_rail = 0.0_wp
               cycle
            end if
            call find_wheel(bodies, seen, grid%x(ix), s, place, n_wheel, found)
            if (.not. found) then
               place = start
               n_wheel = 0.0_wp
               cycle
            end if
            h(ix, iy) = n_rail - n_wheel
         end do
      end do
      approach = -minval(h)
      h = h + approach
   end subroutine variable_distance
end module contact_wheelrail_variable
