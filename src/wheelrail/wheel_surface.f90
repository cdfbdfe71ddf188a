!> Where lines meet the surface of a round wheel
!>
!> Found by Newton's method for place on the profile and height above a plane, so that the height is as smooth as the profile.
module contact_wheelrail_wheel_surface
   use contact_base_kinds, only : wp
   use contact_numeric_spline, only : piece_of
   use contact_profile_curve, only : profile_curve
   use contact_wheelrail_frame, only : frame
   implicit none (type, external)
   private

   public :: wheel_height, wheel_row

   !> Of a step of Newton's method, relative to the radius: what remains after it is of the order of its square
   real(wp), parameter :: tolerance = 1.0e-8_wp
   !> Points of a row that are found at once
   integer, parameter :: together = 8

contains

   !> Heights n of the wheel's surface over a row of points (x, s) of the plane
   !>
   !> Places and heights follow parabolas closely along the track: each point starts from the three before it, where possible
   !> together with the next ones.
   pure subroutine wheel_row(wheel, radius, seen, x, s, start, n, found)
      !> Profile of a round wheel in its own coordinates
      type(profile_curve), intent(in) :: wheel
      !> See `wheel_height`
      real(wp), intent(in) :: radius
      !> The plane seen from the wheel
      type(frame), intent(in) :: seen
      !> At even distances
      real(wp), intent(in) :: x(:), s
      !> Place on the profile and height: estimates for the first point, on exit the solution there if it has one
      real(wp), intent(inout) :: start(2)
      !> Height over each point [mm]
      real(wp), intent(out) :: n(:)
      !> Does the line along n meet the wheel there?
      logical, intent(out) :: found(:)
      !> Place and height of the last three points, the last one first
      real(wp) :: recent(2, 3), estimate(2), point(3)
      integer :: i, alone, known, piece
      logical :: done

      recent(:, 1) = start
      known = 0
      piece = 1
      alone = 0
      i = 1
      do while (i <= size(x))
         if (known == 3 .and. i > alone .and. i + together - 1 <= size(x)) then
            call meet_together(wheel, radius, seen, x(i:i + together - 1), s, piece, recent, n(i:i + together - 1), done)
            if (done) then
               found(i:i + together - 1) = .true.
               i = i + together
               cycle
            end if
            alone = i + together - 1
         end if
         estimate = recent(:, 1)
         if (known == 3) estimate = 3.0_wp*(recent(:, 1) - recent(:, 2)) + recent(:, 3)
         point = seen%origin + seen%axes(:, 1)*x(i) + seen%axes(:, 2)*s
         call meet_wheel(wheel, radius, point, seen%axes(:, 3), piece, estimate(1), estimate(2), found(i))
         n(i) = estimate(2)
         if (found(i)) then
            if (i == 1) start = estimate
            recent(:, 2:3) = recent(:, 1:2)
            recent(:, 1) = estimate
            known = min(known + 1, 3)
         else
            recent(:, 1) = start
            known = 0
         end if
         i = i + 1
      end do
   end subroutine wheel_row

   !> Some points of a row at once, all on one piece of the profile: one step of Newton's method from a parabola
   !>
   !> Their equations do not wait for each other. Nothing is changed where one of the points needs more than this.
   pure subroutine meet_together(wheel, radius, seen, x, s, piece, recent, n, done)
      !> See `wheel_row`
      type(profile_curve), intent(in) :: wheel
      real(wp), intent(in) :: radius
      type(frame), intent(in) :: seen
      real(wp), intent(in) :: x(together), s
      !> Piece of the profile of the last point
      integer, intent(in) :: piece
      !> Place and height of the last three points, the last one first
      real(wp), intent(inout) :: recent(2, 3)
      !> Height over each point [mm]
      real(wp), intent(inout) :: n(together)
      !> Are all of them found?
      logical, intent(out) :: done
      !> Part of the radius that a point is away from the axle's plane at most, where it is not looked at by itself
      real(wp), parameter :: near = 0.5_wp
      real(wp), dimension(together) :: place, height, rest, t, q1, q2, q3, y_s, z_s, r, depth, f1, f2, j12, j21, j22, det
      real(wp) :: base(3), c(0:3, 2)
      integer :: i, k

      associate (nodes => wheel%y%s, axis => seen%axes(:, 1), along => seen%axes(:, 3))
         base = seen%origin + seen%axes(:, 2)*s
         c(:, 1) = wheel%y%c(:, piece)
         c(:, 2) = wheel%z%c(:, piece)
         do i = 1, together
            place(i) = recent(1, 1) + i*(recent(1, 1) - recent(1, 2)) + 0.5_wp*i*(i + 1)*(recent(1, 1) - 2.0_wp*recent(1, 2) &
               & + recent(1, 3))
            height(i) = recent(2, 1) + i*(recent(2, 1) - recent(2, 2)) + 0.5_wp*i*(i + 1)*(recent(2, 1) - 2.0_wp*recent(2, 2) &
               & + recent(2, 3))
            t(i) = place(i) - nodes(piece)
            q1(i) = base(1) + axis(1)*x(i) + along(1)*height(i)
            q2(i) = base(2) + axis(2)*x(i) + along(2)*height(i)
            q3(i) = base(3) + axis(3)*x(i) + along(3)*height(i)
            r(i) = radius + c(0, 2) + t(i)*(c(1, 2) + t(i)*(c(2, 2) + t(i)*c(3, 2)))
         end do
         done = all(place >= nodes(piece) .and. place <= nodes(piece + 1) .and. abs(q1) <= near*r)
         if (.not. done) return
         do i = 1, together
            y_s(i) = c(1, 1) + t(i)*(2.0_wp*c(2, 1) + t(i)*3.0_wp*c(3, 1))
            z_s(i) = c(1, 2) + t(i)*(2.0_wp*c(2, 2) + t(i)*3.0_wp*c(3, 2))
            depth(i) = sqrt(r(i)**2 - q1(i)**2)
            f1(i) = q2(i) - (c(0, 1) + t(i)*(c(1, 1) + t(i)*(c(2, 1) + t(i)*c(3, 1))))
            f2(i) = q3(i) + radius - depth(i)
            j12(i) = along(2)
            j21(i) = -r(i)*z_s(i)/depth(i)
            j22(i) = along(3) + q1(i)*along(1)/depth(i)
            det(i) = -y_s(i)*j22(i) - j12(i)*j21(i)
         end do
         done = all(abs(det) > 0.0_wp)
         if (.not. done) return
         do i = 1, together
            rest(i) = (f1(i)*j22(i) - j12(i)*f2(i))/det(i)
            place(i) = place(i) - rest(i)
            f2(i) = (-y_s(i)*f2(i) - f1(i)*j21(i))/det(i)
            height(i) = height(i) - f2(i)
         end do
         done = all(abs(rest) + abs(f2) <= tolerance*radius .and. place >= nodes(piece) .and. place <= nodes(piece + 1))
      end associate
      if (.not. done) return
      n = height
      do k = 1, size(recent, 2)
         recent(:, k) = [place(together + 1 - k), height(together + 1 - k)]
      end do
   end subroutine meet_together

   !> Height n of the wheel's surface over a point (x, s) of the plane
   pure subroutine wheel_height(wheel, radius, seen, x, s, place, n, found)
      !> Profile of a round wheel in its own coordinates
      type(profile_curve), intent(in) :: wheel
      !> Of the wheel at the origin of its profile [mm]
      real(wp), intent(in) :: radius
      !> The plane seen from the wheel
      type(frame), intent(in) :: seen
      !> Position in the plane [mm]
      real(wp), intent(in) :: x, s
      !> Estimates on entry, solution on exit
      real(wp), intent(inout) :: place, n
      !> Does the line along n meet the wheel?
      logical, intent(out) :: found
      integer :: piece

      piece = 1
      call meet_wheel(wheel, radius, seen%origin + seen%axes(:, 1)*x + seen%axes(:, 2)*s, seen%axes(:, 3), piece, place, n, found)
   end subroutine wheel_height

   !> Where a line meets the surface of the wheel, in the wheel's coordinates
   !>
   !> Unknown are the place on the profile and the distance n along the line: the point lies at the profile's lateral
   !> position, and on the circle that this place describes.
   pure subroutine meet_wheel(wheel, radius, point, k, piece, place, n, found)
      type(profile_curve), intent(in) :: wheel
      !> Of the wheel at the origin of its profile [mm]
      real(wp), intent(in) :: radius
      !> A point of the line [mm] and its direction
      real(wp), intent(in) :: point(3), k(3)
      !> A piece of the profile to begin with; on exit that of the place
      integer, intent(inout) :: piece
      !> Estimates on entry, solution on exit
      real(wp), intent(inout) :: place, n
      logical, intent(out) :: found
      real(wp) :: q(3), y, z, y_s, z_s, r, depth, f(2), j(2, 2), det, step(2), last
      integer :: iteration, pieces, beyond
      !> Steps in a row that leave the profile, until the line is taken to miss it
      integer, parameter :: max_beyond = 4

      found = .false.
      associate (nodes => wheel%y%s)
         pieces = size(nodes) - 1
         last = nodes(pieces + 1)
         place = min(max(place, nodes(1)), last)
         beyond = 0
         do iteration = 1, 30
            if (place < nodes(piece) .or. place > nodes(piece + 1)) piece = next_piece(nodes, piece, place)
            q = point + n*k
            call wheel%y%in_piece(piece, place - nodes(piece), y, y_s)
            call wheel%z%in_piece(piece, place - nodes(piece), z, z_s)
            r = radius + z
            if (abs(q(1)) >= r) return
            depth = sqrt(r**2 - q(1)**2)
            f(1) = q(2) - y
            f(2) = q(3) + radius - depth
            j(1, 1) = -y_s
            j(1, 2) = k(2)
            j(2, 1) = -r*z_s/depth
            j(2, 2) = k(3) + q(1)*k(1)/depth
            det = j(1, 1)*j(2, 2) - j(1, 2)*j(2, 1)
            if (.not. abs(det) > 0.0_wp) return
            step = [f(1)*j(2, 2) - j(1, 2)*f(2), j(1, 1)*f(2) - f(1)*j(2, 1)]/det
            ! not further than profiles bend
            step(1) = min(max(step(1), -5.0_wp), 5.0_wp)
            place = place - step(1)
            n = n - step(2)
            if (place < nodes(1) - 1.0_wp .or. place > last + 1.0_wp) return
            found = abs(step(1)) + abs(step(2)) <= tolerance*radius
            beyond = merge(beyond + 1, 0, place < nodes(1) .or. place > last)
            place = min(max(place, nodes(1)), last)
            if (found .or. beyond > max_beyond) return
         end do
      end associate
   end subroutine meet_wheel

   !> The piece that holds a place, near another piece or not
   pure integer function next_piece(nodes, piece, place) result(next)
      real(wp), intent(in) :: nodes(:), place
      integer, intent(in) :: piece

      next = piece
      if (place > nodes(piece + 1)) then
         next = min(piece + 1, size(nodes) - 1)
      else if (piece > 1) then
         next = piece - 1
      end if
      if (place < nodes(next) .or. place > nodes(next + 1)) next = piece_of(nodes, place)
   end function next_piece
end module contact_wheelrail_wheel_surface
