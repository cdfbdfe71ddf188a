!> Intersection of lines with the surface of a round wheel
!>
!> Newton's method for the position on the profile and the height above a plane; the height is as smooth as the profile.
module contact_wheelrail_wheel_surface
   use contact_base_kinds, only : wp
   use contact_numeric_spline, only : piece_of
   use contact_profile_curve, only : profile_curve
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_wheel_loops, only : meet_points, together
   implicit none (type, external)
   private

   public :: row_from_estimates, wheel_height, wheel_row

   !> Tolerance of a Newton step, relative to the radius: the remaining error is of the order of its square over the radius of
   !> curvature of the profile, so a large roller has the tolerance of one whose radius is this multiple of the length of its
   !> profile
   real(wp), parameter :: tolerance = 1.0e-8_wp, large = 10.0_wp

contains

   !> Heights n of the wheel's surface above a row of points (x, s) of the plane
   !>
   !> Positions and heights are nearly parabolic along the track: the estimate for each point is extrapolated from the last three
   !> points, if possible for several points at once.
   pure subroutine wheel_row(wheel, radius, seen, x, s, start, place, n, found)
      !> Profile of a round wheel in its own coordinates
      type(profile_curve), intent(in) :: wheel
      !> See `wheel_height`
      real(wp), intent(in) :: radius
      !> The plane in wheel coordinates
      type(frame), intent(in) :: seen
      !> Positions in the plane [mm], x equidistant
      real(wp), intent(in) :: x(:), s
      !> Estimates for the first point: position on the profile and height [mm]
      real(wp), intent(in) :: start(2)
      !> Position on the profile and height of each point [mm], where they are found
      real(wp), intent(out) :: place(:), n(:)
      !> Does the line along n intersect the wheel?
      logical, intent(out) :: found(:)
      real(wp) :: after, bend(2), change(2)
      integer :: alone, i, k, known, piece
      logical :: done

      known = 0
      piece = 1
      alone = 0
      i = 1
      do while (i <= size(x))
         if (known > 2) then
            change = [place(i - 1) - place(i - 2), n(i - 1) - n(i - 2)]
            bend = change - [place(i - 2) - place(i - 3), n(i - 2) - n(i - 3)]
            if (i > alone .and. i + together - 1 <= size(x)) then
               do k = 1, together
                  after = 0.5_wp*k*(k + 1)
                  place(i + k - 1) = place(i - 1) + k*change(1) + after*bend(1)
                  n(i + k - 1) = n(i - 1) + k*change(2) + after*bend(2)
               end do
               associate (last => i + together - 1)
                  call meet_together(wheel, radius, seen, x(i:last), s, piece, place(i:last), n(i:last), done)
                  if (done) found(i:last) = .true.
               end associate
               if (done) then
                  known = known + together
                  i = i + together
                  cycle
               end if
               alone = i + together - 1
            end if
            place(i) = place(i - 1) + change(1) + bend(1)
            n(i) = n(i - 1) + change(2) + bend(2)
         else if (known > 0) then
            place(i) = place(i - 1)
            n(i) = n(i - 1)
         else
            place(i) = start(1)
            n(i) = start(2)
            if (i > 1) then
               if (found(1)) place(i) = place(1)
               if (found(1)) n(i) = n(1)
            end if
         end if
         call meet_wheel(wheel, radius, seen%origin + seen%axes(:, 1)*x(i) + seen%axes(:, 2)*s, seen%axes(:, 3), piece, place(i), &
            & n(i), found(i))
         known = merge(known + 1, 0, found(i))
         i = i + 1
      end do
   end subroutine wheel_row

   !> A row with estimates for all points
   pure subroutine row_from_estimates(wheel, radius, seen, x, s, place, n, found)
      !> Profile of a round wheel in its own coordinates
      type(profile_curve), intent(in) :: wheel
      !> See `wheel_height`
      real(wp), intent(in) :: radius
      !> The plane in wheel coordinates
      type(frame), intent(in) :: seen
      !> Positions along the row [mm]
      real(wp), contiguous, intent(in) :: x(:)
      !> Position of the row [mm]
      real(wp), intent(in) :: s
      !> Position on the profile and height of each point [mm], estimates on entry
      real(wp), contiguous, intent(inout) :: place(:), n(:)
      !> Does the line along n intersect the wheel?
      logical, contiguous, intent(out) :: found(:)
      real(wp), dimension(together) :: some_x, some_place, some_n
      integer :: i, k, last, piece
      logical :: done

      piece = piece_of(wheel%y%s, place(1))
      do i = 1, size(x), together
         last = min(i + together - 1, size(x))
         if (last - i + 1 == together) then
            call meet_together(wheel, radius, seen, x(i:last), s, piece, place(i:last), n(i:last), done)
         else
            ! beyond the end of the row the last point is repeated
            do k = 1, together
               some_x(k) = x(min(i + k - 1, last))
               some_place(k) = place(min(i + k - 1, last))
               some_n(k) = n(min(i + k - 1, last))
            end do
            call meet_together(wheel, radius, seen, some_x, s, piece, some_place, some_n, done)
            if (done) place(i:last) = some_place(:last - i + 1)
            if (done) n(i:last) = some_n(:last - i + 1)
         end if
         if (done) then
            found(i:last) = .true.
            cycle
         end if
         do k = i, last
            call meet_wheel(wheel, radius, seen%origin + seen%axes(:, 1)*x(k) + seen%axes(:, 2)*s, seen%axes(:, 3), piece, &
               & place(k), n(k), found(k))
         end do
      end do
   end subroutine row_from_estimates

   !> Solve several points of a row at once by Newton's method
   !>
   !> Their equations are independent and vectorise. Nothing is changed if one of the points does not converge in this way.
   pure subroutine meet_together(wheel, radius, seen, x, s, piece, place, n, done)
      !> See `wheel_row`
      type(profile_curve), intent(in) :: wheel
      real(wp), intent(in) :: radius
      type(frame), intent(in) :: seen
      real(wp), intent(in) :: x(together), s
      !> Piece of the profile near the estimates on entry, that of the first one on exit
      integer, intent(inout) :: piece
      !> Position on the profile and height above each point [mm]: estimates on entry, solutions on exit
      real(wp), contiguous, intent(inout) :: place(:), n(:)
      !> Are all points found?
      logical, intent(out) :: done
      !> Maximum distance of a point from the plane through the axle, relative to the radius; points beyond it are solved one by one
      real(wp), parameter :: near = 0.5_wp
      integer, parameter :: most_steps = 4
      real(wp) :: base(3)
      integer :: all_found

      base = seen%origin + seen%axes(:, 2)*s
      call meet_points(size(wheel%y%s) - 1, wheel%y%s, wheel%y%c, wheel%z%c, radius, base, seen%axes(:, 1), seen%axes(:, 3), &
         & near, step_tolerance(wheel, radius), most_steps, x, piece, place, n, all_found)
      done = all_found > 0
   end subroutine meet_together

   !> Height n of the wheel's surface above a point (x, s) of the plane
   pure subroutine wheel_height(wheel, radius, seen, x, s, place, n, found)
      !> Profile of a round wheel in its own coordinates
      type(profile_curve), intent(in) :: wheel
      !> Radius of the wheel at the origin of its profile [mm]
      real(wp), intent(in) :: radius
      !> The plane in wheel coordinates
      type(frame), intent(in) :: seen
      !> Position in the plane [mm]
      real(wp), intent(in) :: x, s
      !> Position on the profile and height [mm]: estimates on entry, solution on exit
      real(wp), intent(inout) :: place, n
      !> Does the line along n intersect the wheel?
      logical, intent(out) :: found
      integer :: piece

      piece = 1
      call meet_wheel(wheel, radius, seen%origin + seen%axes(:, 1)*x + seen%axes(:, 2)*s, seen%axes(:, 3), piece, place, n, found)
   end subroutine wheel_height

   !> Intersection of a line with the surface of the wheel, in wheel coordinates
   !>
   !> Unknowns are the position on the profile and the distance n along the line: the point is at the lateral position of the
   !> profile, and on the circle of this position.
   pure subroutine meet_wheel(wheel, radius, point, k, piece, place, n, found)
      type(profile_curve), intent(in) :: wheel
      !> Radius of the wheel at the origin of its profile [mm]
      real(wp), intent(in) :: radius
      !> A point on the line [mm], and its direction
      real(wp), intent(in) :: point(3), k(3)
      !> Estimate of the piece of the profile on entry, piece of the solution on exit
      integer, intent(inout) :: piece
      !> Position on the profile and distance along the line [mm]: estimates on entry, solution on exit
      real(wp), intent(inout) :: place, n
      logical, intent(out) :: found
      real(wp) :: q(3), y, z, y_s, z_s, r, depth, f(2), j(2, 2), det, step(2), last, longest
      integer :: iteration, pieces, beyond
      !> Number of successive steps beyond the end of the profile after which the line is taken to miss it
      integer, parameter :: max_beyond = 4

      found = .false.
      associate (nodes => wheel%y%s)
         pieces = size(nodes) - 1
         last = nodes(pieces + 1)
         place = min(max(place, nodes(1)), last)
         beyond = 0
         longest = step_tolerance(wheel, radius)
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
            ! steps are limited because of the curvature of profiles
            step(1) = min(max(step(1), -5.0_wp), 5.0_wp)
            place = place - step(1)
            n = n - step(2)
            if (place < nodes(1) - 1.0_wp .or. place > last + 1.0_wp) return
            found = abs(step(1)) + abs(step(2)) <= longest
            beyond = merge(beyond + 1, 0, place < nodes(1) .or. place > last)
            place = min(max(place, nodes(1)), last)
            if (found .or. beyond > max_beyond) return
         end do
      end associate
   end subroutine meet_wheel

   !> Tolerance of a Newton step [mm]
   pure real(wp) function step_tolerance(wheel, radius) result(longest)
      !> Profile of a round wheel or roller in its own coordinates
      type(profile_curve), intent(in) :: wheel
      !> Its radius at the origin of the profile [mm]
      real(wp), intent(in) :: radius

      longest = tolerance*min(radius, large*(wheel%y%s(size(wheel%y%s)) - wheel%y%s(1)))
   end function step_tolerance

   !> The piece that contains a position, starting from another piece
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
