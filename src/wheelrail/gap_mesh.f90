!> Vertical gap at points of a mesh over the track, row by row
module contact_wheelrail_gap_mesh
   use contact_base_kinds, only : wp
   use contact_wheelrail_bodies, only : find_wheel_row, wheel_rail_bodies
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_gap, only : no_surface
   implicit none (type, external)
   private

   public :: fill

contains

   !> Vertical gap at points of a mesh; the rail has sections at the positions x
   subroutine fill(bodies, x, y, first, last, table)
      !> Sections and positions of rail and wheel; sections are computed as needed
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Positions along the track and lateral positions, increasing [mm]
      real(wp), intent(in) :: x(:), y(:)
      !> First and last point to compute in each row along the track, none if last < first; other values are kept
      integer, intent(in) :: first(:), last(:)
      !> Gaps, shape (x, y) [mm]
      real(wp), intent(inout) :: table(:, :)
      type(frame) :: track, seen
      real(wp) :: wheel(size(x))
      logical :: found(size(x))
      integer :: j

      call fill_rail(bodies, x, y, first, last, table)
      seen = bodies%placement%wheel%seen_from_here(track)
      if (allocated(bodies%wheel_strip) .and. any(first <= last)) call expect_rows(bodies, seen, x, &
         & [minval(y, first <= last), maxval(y, first <= last)])
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

   !> Announce the lateral positions of a wheel's sections that a mesh needs
   subroutine expect_rows(bodies, seen, x, range)
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Track coordinates in those of the wheel
      type(frame), intent(in) :: seen
      !> Positions along the track, increasing, and lateral range in the track [mm]
      real(wp), intent(in) :: x(:), range(2)
      !> Range of heights of a wheel near a rail, to both sides of the track's surface [mm]
      real(wp), parameter :: height = 40.0_wp
      real(wp) :: across(2), along(2), up

      along = [x(1), x(size(x))]*seen%axes(2, 1)
      across = range*seen%axes(2, 2)
      up = height*abs(seen%axes(2, 3))
      call bodies%wheel_strip%expect(seen%origin(2) + [minval(along) + minval(across) - up, maxval(along) + maxval(across) + up])
   end subroutine expect_rows

   !> Height of the rail at points of a mesh, section by section
   subroutine fill_rail(bodies, x, y, first, last, table)
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> See `fill`
      real(wp), intent(in) :: x(:), y(:)
      integer, intent(in) :: first(:), last(:)
      real(wp), intent(inout) :: table(:, :)
      real(wp) :: z(size(y)), height(size(y)), rho
      logical :: wanted(size(y)), found(size(y)), visible(size(y))
      integer :: rows(size(y))
      integer :: i, k, n

      ! the section of a rail that does not vary is the same everywhere
      if (.not. allocated(bodies%rail_strip)) call bodies%rail%heights(y, height, visible)
      do i = minval(first), maxval(last)
         wanted = first <= i .and. i <= last
         n = count(wanted)
         if (n == 0) cycle
         rows(:n) = pack([(k, k=1, size(y))], wanted)
         if (allocated(bodies%rail_strip)) then
            call bodies%rail_strip%heights(bodies%rail_strip%number_at(x(i)), y(rows(:n)), z(:n), found(:n))
         else
            z(:n) = height(rows(:n))
            found(:n) = visible(rows(:n))
         end if
         if (bodies%placement%roller_radius > 0.0_wp) then
            do k = 1, n
               rho = bodies%placement%roller_radius - z(k)
               found(k) = found(k) .and. abs(x(i)) < rho
               if (found(k)) z(k) = z(k) + bodies%placement%roller_drop(x(i), z(k))
            end do
         end if
         table(i, rows(:n)) = merge(z(:n), no_surface, found(:n))
      end do
   end subroutine fill_rail
end module contact_wheelrail_gap_mesh
