!> Operations on the points of a profile: close points, zig-zags, direction, loops, kinks
!>
!> In canonical order z points down; the lateral coordinate of a rail increases along the list (gauge side first), that of a
!> wheel decreases (flange last).
module contact_profile_points
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_profile_request, only : profile_side
   implicit none (type, external)
   private

   public :: drop_close_points, remove_zig_zags, keep_points, needs_mirror_z, needs_reversal, runs_backwards
   public :: chord_lengths, find_loop, find_kinks, find_spike, find_outlier, find_gap, turning_angles

   !> Tables with fewer points are drawn by hand and may have any shape
   integer, parameter :: few_points = 6

contains

   !> Drop points that are closer than a given distance to the last point kept
   pure subroutine drop_close_points(y, z, nearest)
      !> Coordinates [mm], shape (number of points); shortened
      real(wp), allocatable, intent(inout) :: y(:), z(:)
      !> Minimum distance between points [mm]
      real(wp), intent(in) :: nearest
      logical :: keep(size(y))
      integer :: i, last

      keep = .true.
      last = 1
      do i = 2, size(y)
         keep(i) = hypot(y(i) - y(last), z(i) - z(last)) >= nearest
         if (keep(i)) last = i
      end do
      call keep_points(y, z, keep)
   end subroutine drop_close_points

   pure subroutine keep_points(y, z, keep)
      !> Coordinates [mm], shape (number of points); shortened
      real(wp), allocatable, intent(inout) :: y(:), z(:)
      !> Points to keep, same shape
      logical, intent(in) :: keep(:)

      if (all(keep)) return
      y = pack(y, keep)
      z = pack(z, keep)
   end subroutine keep_points

   !> Turning angle at each point [rad], in (-pi, pi]; zero at the ends
   pure function turning_angles(y, z) result(turn)
      !> Coordinates [mm], shape (number of points)
      real(wp), intent(in) :: y(:), z(:)
      real(wp) :: turn(size(y))
      real(wp) :: dy(2), dz(2)
      integer :: i

      turn = 0.0_wp
      do i = 2, size(y) - 1
         dy = [y(i) - y(i - 1), y(i + 1) - y(i)]
         dz = [z(i) - z(i - 1), z(i + 1) - z(i)]
         turn(i) = atan2(dy(1)*dz(2) - dz(1)*dy(2), dy(1)*dy(2) + dz(1)*dz(2))
      end do
   end function turning_angles

   !> The first spike, where the line goes out and returns along itself; 0 if there is none
   !>
   !> At a spike the distance between the points before and after it is shorter than half of either of its sides: its angle is
   !> less than 29 degrees. This is not so for corners and overlapping sections.
   pure integer function find_spike(y, z, height) result(first)
      !> Coordinates [mm]
      real(wp), intent(in) :: y(:), z(:)
      !> Minimum length of the spike [mm]
      real(wp), intent(in) :: height
      integer :: n

      n = size(y)
      first = 0
      if (n < few_points) return
      do first = 2, n - 1
         if (is_spike(y(first - 1:first + 1), z(first - 1:first + 1), height)) return
      end do
      first = 0
   end function find_spike

   !> Is the second of three points the tip of a spike?
   pure logical function is_spike(y, z, height)
      !> See find_spike
      real(wp), intent(in) :: y(3), z(3), height
      real(wp) :: shorter

      shorter = min(hypot(y(2) - y(1), z(2) - z(1)), hypot(y(3) - y(2), z(3) - z(2)))
      is_spike = shorter >= height .and. hypot(y(3) - y(1), z(3) - z(1)) < 0.5_wp*shorter
   end function is_spike

   !> The first point that deviates from the line of its neighbours; 0 if there is none
   !>
   !> It is a spike, or the line turns to one side at the point and to the other side at both neighbours. Corners, even coarse
   !> ones, have no such neighbours.
   pure integer function find_outlier(y, z, height) result(first)
      !> Coordinates [mm]
      real(wp), intent(in) :: y(:), z(:)
      !> Minimum distance from the line through the neighbours [mm]
      real(wp), intent(in) :: height
      !> Minimum angles at the point and at its neighbours [rad]
      real(wp), parameter :: sharp = pi/3.0_wp, turned = pi/9.0_wp
      real(wp) :: turn(size(y)), shorter, chord, distance
      integer :: i, n

      n = size(y)
      first = 0
      if (n < few_points) return
      turn = turning_angles(y, z)
      do i = 2, n - 1
         first = i
         if (is_spike(y(i - 1:i + 1), z(i - 1:i + 1), height)) return
         if (abs(turn(i)) < sharp) cycle
         if (any(-turn([max(2, i - 1), min(n - 1, i + 1)])*sign(1.0_wp, turn(i)) < turned)) cycle
         ! twice the area of the triangle divided by its base, or the shorter side
         shorter = min(hypot(y(i) - y(i - 1), z(i) - z(i - 1)), hypot(y(i + 1) - y(i), z(i + 1) - z(i)))
         chord = hypot(y(i + 1) - y(i - 1), z(i + 1) - z(i - 1))
         if (.not. chord > 0.0_wp) cycle
         distance = abs((y(i + 1) - y(i - 1))*(z(i) - z(i - 1)) - (z(i + 1) - z(i - 1))*(y(i) - y(i - 1)))/chord
         if (min(shorter, distance) >= height) return
      end do
      first = 0
   end function find_outlier

   !> The first point followed by a gap that is very large compared with the usual distance; 0 if there is none
   pure integer function find_gap(y, z, least, ratio) result(first)
      !> Coordinates [mm]
      real(wp), intent(in) :: y(:), z(:)
      !> Minimum gap [mm], and relative to the mean distance without the largest one
      real(wp), intent(in) :: least, ratio
      real(wp) :: step(size(y) - 1), usual
      integer :: n

      n = size(step)
      first = 0
      if (n < 10) return
      step = hypot(y(2:) - y(:n), z(2:) - z(:n))
      usual = (sum(step) - maxval(step))/(n - 1)
      first = findloc(step > max(least, ratio*usual), .true., 1)
   end function find_gap

   !> Replace the two ends of a segment that runs backwards by their midpoint
   !>
   !> A zig-zag is a segment with sharp turns at both ends, as results from two overlapping sections.
   pure subroutine remove_zig_zags(y, z, threshold, count)
      !> Coordinates [mm], shape (number of points); shortened
      real(wp), allocatable, intent(inout) :: y(:), z(:)
      !> Turning angle of a sharp turn [rad]
      real(wp), intent(in) :: threshold
      !> Number of segments removed
      integer, intent(out) :: count
      real(wp) :: turn(size(y))
      logical :: keep(size(y))
      integer :: i

      count = 0
      if (size(y) < 4) return
      turn = abs(turning_angles(y, z))
      keep = .true.
      i = 2
      do while (i <= size(y) - 2)
         if (turn(i) > threshold .and. turn(i + 1) > threshold) then
            y(i) = 0.5_wp*(y(i) + y(i + 1))
            z(i) = 0.5_wp*(z(i) + z(i + 1))
            keep(i + 1) = .false.
            count = count + 1
            i = i + 1
         end if
         i = i + 1
      end do
      call keep_points(y, z, keep)
   end subroutine remove_zig_zags

   !> Does z point upwards? Determined from the side faces
   pure logical function needs_mirror_z(side, y, z) result(mirror)
      !> Member of profile_side
      integer, intent(in) :: side
      !> Coordinates in the order of the file and in any unit; y positive towards the field side
      real(wp), intent(in) :: y(:), z(:)

      if (side == profile_side%rail) then
         mirror = rail_is_upside_down(z)
      else
         mirror = wheel_is_upside_down(z) .or. wheel_ends_at_raised_tip(y, z)
      end if
   end function needs_mirror_z

   !> The side faces of a rail hang down: z decreases inwards from either end
   pure logical function rail_is_upside_down(z) result(mirror)
      real(wp), intent(in) :: z(:)
      !> Fraction of the points considered at either end
      real(wp), parameter :: zone = 0.10_wp
      !> Significant difference, relative to the range of z
      real(wp), parameter :: visible = 0.001_wp
      real(wp) :: difference
      integer :: n, near, left, right, i, lowest

      n = size(z)
      near = max(1, int(zone*n))
      difference = visible*(maxval(z) - minval(z))
      left = 0
      right = 0
      do i = 2, min(n, 1 + near)
         if (left == 0 .and. abs(z(i) - z(1)) > difference) left = merge(1, -1, z(i) < z(1))
         if (right == 0 .and. abs(z(n + 1 - i) - z(n)) > difference) right = merge(1, -1, z(n + 1 - i) < z(n))
      end do
      if (left == 0 .and. right == 0) then
         ! only the position of the lowest z is left as a criterion; a horizontal line is accepted as it is
         lowest = minloc(z, 1)
         mirror = (lowest <= near .or. lowest > n - near) .and. difference > 0.0_wp
      else
         mirror = left + right < 0
      end if
   end function rail_is_upside_down

   !> The flange of a wheel hangs down, and the field side has the lowest z
   pure logical function wheel_is_upside_down(z) result(mirror)
      real(wp), intent(in) :: z(:)
      real(wp), parameter :: zone = 0.05_wp
      integer :: n, near, lowest, highest

      n = size(z)
      near = max(1, int(zone*n))
      lowest = minloc(z, 1)
      highest = maxloc(z, 1)
      if (lowest <= near .or. lowest > n - near) then
         mirror = .false.
      else if (highest <= near .or. highest > n - near) then
         mirror = .true.
      else
         mirror = z((lowest + highest)/2) > 0.5_wp*(z(lowest) + z(highest))
      end if
   end function wheel_is_upside_down

   !> Does a wheel profile without flange back end at the tip of a flange that points upwards? The tip is the lowest z at the end
   !> with the lowest y, and the tread, with most of the points, has high z
   pure logical function wheel_ends_at_raised_tip(y, z) result(ends)
      real(wp), intent(in) :: y(:), z(:)
      !> Fraction of the points considered at the end
      real(wp), parameter :: zone = 0.05_wp
      !> Least height of a flange, and least distance of its tip from the highest z, relative to the width of the profile
      real(wp), parameter :: visible = 0.1_wp, far = 0.5_wp
      real(wp) :: width
      integer :: n, near, lowest, highest

      n = size(z)
      near = max(1, int(zone*n))
      lowest = minloc(z, 1)
      highest = maxloc(z, 1)
      width = maxval(y) - minval(y)
      ends = (lowest <= near .or. lowest > n - near) .and. z(highest) - z(lowest) > visible*width &
         & .and. y(highest) - y(lowest) > far*width .and. z((lowest + highest)/2) > 0.5_wp*(z(lowest) + z(highest))
   end function wheel_ends_at_raised_tip

   !> Must the order be reversed? Determined from the steps at the top of a rail and at the tip of a flange
   pure logical function needs_reversal(side, y, z) result(reverse)
      !> Member of profile_side
      integer, intent(in) :: side
      !> Coordinates with z down; at least two points
      real(wp), intent(in) :: y(:), z(:)
      real(wp) :: before, behind, turn(size(y))
      integer :: n, i

      n = size(y)
      if (side == profile_side%rail) then
         i = min(minloc(z, 1), n - 1)
         reverse = y(i + 1) < y(i)
         return
      end if
      i = maxloc(z, 1)
      if (i == 1 .or. i == n) then
         i = min(i, n - 1)
         reverse = y(i + 1) > y(i)
         return
      end if
      before = y(i) - y(i - 1)
      behind = y(i + 1) - y(i)
      if (before <= 0.0_wp .and. behind <= 0.0_wp) then
         reverse = .false.
      else if (before >= 0.0_wp .and. behind >= 0.0_wp) then
         reverse = .true.
      else
         turn = turning_angles(y, z)
         reverse = turn(i) < 0.0_wp
      end if
   end function needs_reversal

   !> Is the overall direction wrong? y must increase along a rail and decrease along a wheel
   pure logical function runs_backwards(side, y) result(backwards)
      !> Member of profile_side
      integer, intent(in) :: side
      !> Lateral coordinates [mm] in the order of the list
      real(wp), intent(in) :: y(:)

      if (side == profile_side%rail) then
         backwards = y(size(y)) <= y(1)
      else
         backwards = y(size(y)) >= y(1)
      end if
   end function runs_backwards

   !> Cumulative chord lengths from the first point [mm]
   pure function chord_lengths(y, z) result(s)
      !> Coordinates [mm], shape (number of points)
      real(wp), intent(in) :: y(:), z(:)
      real(wp) :: s(size(y))
      integer :: i

      s(1) = 0.0_wp
      do i = 2, size(y)
         s(i) = s(i - 1) + hypot(y(i) - y(i - 1), z(i) - z(i - 1))
      end do
   end function chord_lengths

   !> The first two segments that cross and are not neighbours
   !>
   !> Bounding boxes of groups of segments reduce the work far below that of all pairs.
   pure subroutine find_loop(y, z, first, second)
      !> Coordinates [mm], shape (number of points)
      real(wp), intent(in) :: y(:), z(:)
      !> Indices of the first points of the segments; 0 if there is no loop
      integer, intent(out) :: first, second
      !> Number of segments of a group; segments that only touch do not cross
      integer, parameter :: group = 16
      real(wp), parameter :: touch = 1.0e-9_wp
      real(wp), allocatable :: box(:, :)
      integer :: n, groups, i, j, k, l

      first = 0
      second = 0
      n = size(y) - 1
      groups = (n + group - 1)/group
      allocate(box(4, groups))
      do i = 1, groups
         k = (i - 1)*group + 1
         l = min(i*group, n) + 1
         box(:, i) = [minval(y(k:l)), maxval(y(k:l)), minval(z(k:l)), maxval(z(k:l))]
      end do
      do i = 1, groups
         do j = i, groups
            if (apart(box(:, i), box(:, j))) cycle
            do k = (i - 1)*group + 1, min(i*group, n)
               do l = max(k + 2, (j - 1)*group + 1), min(j*group, n)
                  if (.not. segments_cross(y([k, k + 1, l, l + 1]), z([k, k + 1, l, l + 1]), touch)) cycle
                  first = k
                  second = l
                  return
               end do
            end do
         end do
      end do
   end subroutine find_loop

   pure logical function apart(a, b)
      !> Lowest and highest y, lowest and highest z
      real(wp), intent(in) :: a(4), b(4)

      apart = a(1) > b(2) .or. b(1) > a(2) .or. a(3) > b(4) .or. b(3) > a(4)
   end function apart

   !> Do the segments 1-2 and 3-4 cross in the interior of both?
   pure logical function segments_cross(y, z, touch) result(cross)
      real(wp), intent(in) :: y(4), z(4)
      !> An end closer than this to the other segment lies on it [mm]
      real(wp), intent(in) :: touch

      cross = .false.
      if (apart([minval(y(:2)), maxval(y(:2)), minval(z(:2)), maxval(z(:2))], &
         & [minval(y(3:)), maxval(y(3:)), minval(z(3:)), maxval(z(3:))])) return
      cross = on_both_sides(y(1:2), z(1:2), y(3:4), z(3:4), touch) .and. &
         & on_both_sides(y(3:4), z(3:4), y(1:2), z(1:2), touch)
   end function segments_cross

   !> Are the points p, q of (ys, zs) on opposite sides of a line, and farther than `touch` from it?
   pure logical function on_both_sides(yl, zl, ys, zs, touch) result(both)
      real(wp), intent(in) :: yl(2), zl(2), ys(2), zs(2), touch
      real(wp) :: distance(2), length

      length = hypot(yl(2) - yl(1), zl(2) - zl(1))
      distance = ((yl(2) - yl(1))*(zs - zl(1)) - (zl(2) - zl(1))*(ys - yl(1)))/max(length, tiny(length))
      both = minval(distance) < -touch .and. maxval(distance) > touch
   end function on_both_sides

   !> True corners: sharp turns without other significant turns nearby
   !>
   !> A single point between two corners is a corner too.
   pure function find_kinks(y, z, high, low, width) result(is_kink)
      !> Coordinates [mm], shape (number of points)
      real(wp), intent(in) :: y(:), z(:)
      !> Minimum turning angle of a corner, maximum turning angle nearby [rad], and range of "nearby" [mm]
      real(wp), intent(in) :: high, low, width
      logical :: is_kink(size(y))
      real(wp) :: turn(size(y)), s(size(y))
      integer :: i, j

      is_kink = .false.
      if (high >= pi) return
      turn = abs(turning_angles(y, z))
      s = chord_lengths(y, z)
      do i = 2, size(y) - 1
         if (turn(i) <= high) cycle
         is_kink(i) = .true.
         do j = i - 1, 1, -1
            if (s(i) - s(j) > width) exit
            if (turn(j) > low) is_kink(i) = .false.
         end do
         do j = i + 1, size(y)
            if (s(j) - s(i) > width) exit
            if (turn(j) > low) is_kink(i) = .false.
         end do
      end do
      do i = 2, size(y) - 1
         if (is_kink(i - 1) .and. is_kink(i + 1)) is_kink(i) = .true.
      end do
   end function find_kinks
end module contact_profile_points
