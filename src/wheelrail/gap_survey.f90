!> Estimates of the gap between a wheel and a rail, to find where it may be small
!>
!> A search for the height of a wheel needs the exact gap where the bodies are close to each other. Elsewhere an estimate is
!> sufficient: the contact locus at the nodes of the wheel's profile by one step of its iteration, and straight lines between the
!> nodes.
module contact_wheelrail_gap_survey
   use, intrinsic :: iso_c_binding, only : c_int
   use contact_base_kinds, only : long, wp
   use contact_profile_curve, only : profile_curve
   use contact_wheelrail_placement, only : wheel_rail_placement
   use contact_wheelrail_wheel_loops, only : find_locus, survey_nodes
   implicit none (type, external)
   private

   public :: gap_survey

   !> What the survey needs of a wheel's profile; nodes are padded to a multiple of four by copies of the last one
   type :: surveyed_profile
      !> Number of the profile; 0 if it has none, and the data must be prepared anew
      integer(long) :: number = 0
      !> Number of nodes
      integer :: n = 0
      !> Coordinates of the nodes [mm], and slope dz/dy there [-], shape (padded nodes)
      real(wp), allocatable :: y(:), z(:), lean(:)
      !> Twice the bounds of the deviation of y and z from the chord of a piece [mm], shape (2, n - 1)
      real(wp), allocatable :: bulge(:, :)
      !> Range of z of the nodes [mm]
      real(wp) :: deepest = 0.0_wp
   contains
      procedure :: prepare
   end type surveyed_profile

   !> Estimates on the nodes of a wheel's profile and on a mesh over the rail; its arrays are kept from one survey to the next
   type :: gap_survey
      !> Number of mesh points whose gap must be computed exactly, and their indices in increasing order
      integer :: n_near = 0
      integer, allocatable :: near(:)
      !> First and last piece of the wheel's profile above a mesh point, first > last if there is none; shape (2, n)
      integer, allocatable :: pieces(:, :)
      type(surveyed_profile), private :: profile
      !> Locus at the nodes, coordinates in the track [mm]; shape (padded nodes)
      real(wp), allocatable, private :: x(:), y(:), z(:)
      !> Number of mesh points at or below the lateral position of a node; shape (padded nodes)
      integer(c_int), allocatable, private :: below(:)
      !> Lower bound of the gap by the estimate [mm], shape (n)
      real(wp), allocatable, private :: least(:)
      !> Lateral positions, heights of the rail, pieces and results of the points that are computed together; shape (n)
      real(wp), allocatable, private :: target(:), rail(:), place(:), found_x(:), found_z(:)
      integer(c_int), allocatable, private :: piece(:), found(:)
      integer, allocatable, private :: index(:)
   contains
      !> Compute the estimates
      procedure :: look
      !> Compute the gap at the marked points that have one piece of the wheel above them
      procedure :: compute
      procedure, private :: make_room
      procedure, private :: estimate_nodes
      procedure, private :: estimate_gaps
      procedure, private :: mark
   end type gap_survey

   !> Maximum distance of the locus from the lowest point of the wheel, relative to the radius
   real(wp), parameter, public :: furthest = 0.5_wp
   !> Upper bound of dy/ds along the profile, used instead of larger values if the profile is steeper [-]
   real(wp), parameter, public :: steepest = -1.0e-6_wp
   !> Accuracy of the lateral position of a point of the locus [mm], and of its longitudinal position relative to the radius
   real(wp), parameter, public :: lateral_accuracy = 1.0e-11_wp, along_accuracy = 1.0e-13_wp
   !> Maximum error of an estimate at a node without yaw angle [mm]
   real(wp), parameter :: node_error = 0.01_wp
   !> Nodes that are computed together
   integer, parameter :: lanes = 4

contains

   !> Prepare the data of a profile, unless they are those of the last one
   pure subroutine prepare(self, wheel)
      class(surveyed_profile), intent(inout) :: self
      type(profile_curve), intent(in) :: wheel
      integer :: k, n, padded

      if (self%number > 0 .and. self%number == wheel%number) return
      n = size(wheel%y%s)
      padded = n + modulo(-n, lanes)
      if (self%n /= n .and. allocated(self%y)) deallocate(self%y, self%z, self%lean, self%bulge)
      if (.not. allocated(self%y)) allocate(self%y(padded), self%z(padded), self%lean(padded), self%bulge(2, n - 1))
      self%n = n
      self%number = wheel%number
      associate (cy => wheel%y%c, cz => wheel%z%c)
         do k = 1, n - 1
            self%y(k) = cy(0, k)
            self%z(k) = cz(0, k)
            self%lean(k) = cz(1, k)/min(steepest, cy(1, k))
            associate (h => wheel%y%s(k + 1) - wheel%y%s(k))
               self%bulge(1, k) = 0.25_wp*h**2*max(abs(cy(2, k)), abs(cy(2, k) + 3.0_wp*h*cy(3, k)))
               self%bulge(2, k) = 0.25_wp*h**2*max(abs(cz(2, k)), abs(cz(2, k) + 3.0_wp*h*cz(3, k)))
            end associate
         end do
         associate (h => wheel%y%s(n) - wheel%y%s(n - 1))
            self%y(n:) = cy(0, n - 1) + h*(cy(1, n - 1) + h*(cy(2, n - 1) + h*cy(3, n - 1)))
            self%z(n:) = cz(0, n - 1) + h*(cz(1, n - 1) + h*(cz(2, n - 1) + h*cz(3, n - 1)))
            self%lean(n:) = (cz(1, n - 1) + h*(2.0_wp*cz(2, n - 1) + h*3.0_wp*cz(3, n - 1))) &
               & /min(steepest, cy(1, n - 1) + h*(2.0_wp*cy(2, n - 1) + h*3.0_wp*cy(3, n - 1)))
         end associate
      end associate
      self%deepest = maxval(abs(self%z))
   end subroutine prepare

   !> Estimate the gap over a mesh, and mark the points at which it must be computed exactly
   pure subroutine look(self, wheel, placement, y, z, on_rail, no_surface, reach, looked_at, gap, x)
      class(gap_survey), intent(inout) :: self
      !> Profile of a round wheel in its own coordinates
      type(profile_curve), intent(in) :: wheel
      !> Position of the bodies
      type(wheel_rail_placement), intent(in) :: placement
      !> Mesh over the rail at even distances and heights of the rail, in the track [mm]
      real(wp), intent(in) :: y(:), z(:)
      !> Does the rail exist at a mesh point?
      logical, intent(in) :: on_rail(:)
      !> Value of the gap where rail or wheel is missing [mm]
      real(wp), intent(in) :: no_surface
      !> Gaps that exceed the smallest one by less than `reach` are computed exactly, and those around a minimum that exceeds it by
      !> less than `looked_at` [mm]
      real(wp), intent(in) :: reach, looked_at
      !> Estimates of the gap and of the longitudinal position of the locus [mm]
      real(wp), intent(inout) :: gap(:), x(:)
      integer :: range(2)

      call self%profile%prepare(wheel)
      call self%make_room(size(self%profile%y), size(y))
      gap = no_surface
      x = 0.0_wp
      self%least = no_surface
      self%pieces(1, :) = self%profile%n
      self%pieces(2, :) = 0
      self%n_near = 0
      if (size(y) < 2) return
      call self%estimate_nodes(placement, y, range)
      call self%estimate_gaps(placement, y, z, on_rail, range, gap, x)
      call self%mark(gap, reach, looked_at, no_surface)
   end subroutine look

   !> Allocate arrays of the right size
   pure subroutine make_room(self, nodes, n)
      class(gap_survey), intent(inout) :: self
      !> Numbers of padded nodes and of mesh points
      integer, intent(in) :: nodes, n

      if (allocated(self%x)) then
         if (size(self%x) /= nodes) deallocate(self%x, self%y, self%z, self%below)
      end if
      if (.not. allocated(self%x)) allocate(self%x(nodes), self%y(nodes), self%z(nodes), self%below(nodes))
      if (allocated(self%near)) then
         if (size(self%near) /= n) deallocate(self%near, self%pieces, self%least, self%target, self%rail, self%place, &
            & self%found_x, self%found_z, self%piece, self%found, self%index)
      end if
      if (.not. allocated(self%near)) allocate(self%near(n), self%pieces(2, n), self%least(n), self%target(n), self%rail(n), &
         & self%place(n), self%found_x(n), self%found_z(n), self%piece(n), self%found(n), self%index(n))
   end subroutine make_room

   !> The locus at the nodes that may be above the mesh
   pure subroutine estimate_nodes(self, placement, y, range)
      class(gap_survey), intent(inout) :: self
      type(wheel_rail_placement), intent(in) :: placement
      !> Mesh [mm], at least two points
      real(wp), intent(in) :: y(:)
      !> First and last node that were computed
      integer, intent(out) :: range(2)
      !> Maximum distance of the locus above the lowest point of its circle, relative to the radius
      real(wp), parameter :: highest = 0.2_wp
      real(wp) :: margin, low, high
      integer :: first, last, n

      associate (axes => placement%wheel%axes, origin => placement%wheel%origin, of => self%profile)
         margin = furthest*placement%wheel_radius*abs(axes(2, 1)) &
            & + (of%deepest + highest*placement%wheel_radius)*abs(axes(2, 3)) + (y(2) - y(1))
         low = y(1) - margin - origin(2)
         high = y(size(y)) + margin - origin(2)
         n = of%n
         first = 1
         do while (first < n - 1)
            if (axes(2, 2)*of%y(first + 1) >= low .and. axes(2, 2)*of%y(first + 1) <= high) exit
            first = first + 1
         end do
         last = n
         do while (last > first + 1)
            if (axes(2, 2)*of%y(last - 1) >= low .and. axes(2, 2)*of%y(last - 1) <= high) exit
            last = last - 1
         end do
         ! four nodes are computed at once
         first = first - modulo(first - 1, lanes)
         last = last + modulo(-last, lanes)
         call survey_nodes(last - first + 1, of%y(first), of%z(first), of%lean(first), origin, axes, placement%wheel_radius, &
            & furthest, placement%roller_radius, placement%lowest_on_roller(), y(1), 1.0_wp/(y(2) - y(1)), size(y), &
            & self%x(first), self%y(first), self%z(first), self%below(first))
         range = [first, min(last, n)]
      end associate
   end subroutine estimate_nodes

   !> Gaps between the nodes, by straight lines
   !>
   !> A piece deviates from its chord by at most its largest second derivative times the square of its length over 8.
   pure subroutine estimate_gaps(self, placement, y, z, on_rail, range, gap, x)
      class(gap_survey), intent(inout) :: self
      type(wheel_rail_placement), intent(in) :: placement
      !> See `look`
      real(wp), intent(in) :: y(:), z(:)
      logical, intent(in) :: on_rail(:)
      !> First and last node of the estimates
      integer, intent(in) :: range(2)
      real(wp), intent(inout) :: gap(:), x(:)
      real(wp) :: t, slope, along, vertical, error, by_yaw
      integer :: i, k

      ! the second step of the iteration for the locus is smaller than the first one by a factor of the square of the yaw angle
      by_yaw = node_error + furthest*placement%wheel_radius*abs(placement%wheel%axes(2, 1))**3
      do k = range(1), range(2) - 1
         ! the surface faces the rail if y decreases along the profile
         if (self%below(k + 1) >= self%below(k)) cycle
         associate (left => self%y(k + 1), right => self%y(k), bulge => self%profile%bulge(:, k))
            slope = (self%z(k) - self%z(k + 1))/(right - left)
            error = by_yaw*(1.0_wp + abs(slope)) + bulge(2) + abs(slope)*bulge(1)
            do i = self%below(k + 1) + 1, self%below(k)
               if (.not. on_rail(i)) cycle
               self%pieces(1, i) = min(self%pieces(1, i), k)
               self%pieces(2, i) = k
               t = y(i) - left
               along = self%x(k + 1) + t/(right - left)*(self%x(k) - self%x(k + 1))
               vertical = z(i) + placement%roller_drop(along, z(i)) - (self%z(k + 1) + t*slope)
               self%least(i) = min(self%least(i), vertical - error)
               if (vertical >= gap(i)) cycle
               gap(i) = vertical
               x(i) = along
            end do
         end associate
      end do
   end subroutine estimate_gaps

   !> Mark the mesh points whose gap may be small
   pure subroutine mark(self, gap, reach, looked_at, no_surface)
      class(gap_survey), intent(inout) :: self
      !> Estimates [mm]
      real(wp), intent(in) :: gap(:)
      !> See `look`
      real(wp), intent(in) :: reach, looked_at, no_surface
      real(wp) :: most, lowest
      integer :: i, k, n, done

      n = size(gap)
      most = no_surface
      lowest = no_surface
      do i = 1, n
         most = min(most, 2.0_wp*gap(i) - self%least(i))
         lowest = min(lowest, gap(i))
      end do
      most = most + reach
      done = 0
      do i = 1, n
         if (self%least(i) > most) then
            if (.not. gap(i) < lowest + looked_at) cycle
            if (gap(i) > gap(max(1, i - 1)) .or. gap(i) > gap(min(n, i + 1))) cycle
         end if
         if (.not. gap(i) < no_surface) cycle
         ! the neighbours determine where the gap vanishes between mesh points
         do k = max(done + 1, i - 1), min(n, i + 1)
            self%n_near = self%n_near + 1
            self%near(self%n_near) = k
         end do
         done = min(n, i + 1)
      end do
   end subroutine mark

   !> Compute the gap exactly at the marked points that have one piece of the wheel above them
   pure subroutine compute(self, wheel, placement, y, z, gap, x, n_left, left)
      class(gap_survey), intent(inout) :: self
      !> Profile of a round wheel, as in the last call of `look`
      type(profile_curve), intent(in) :: wheel
      !> Position of the bodies, as in the last call of `look`
      type(wheel_rail_placement), intent(in) :: placement
      !> Lateral positions of the mesh [mm]
      real(wp), intent(in) :: y(:)
      !> Heights of the rail [mm]
      real(wp), intent(in) :: z(:)
      !> Gap [mm]; set at the points that are computed
      real(wp), intent(inout) :: gap(:)
      !> Longitudinal position of the locus [mm]; set at the points that are computed
      real(wp), intent(inout) :: x(:)
      !> Number of points that remain to be computed: several pieces or another one may be above them
      integer, intent(out) :: n_left
      !> Their indices; as many elements as points of the mesh
      integer, intent(inout) :: left(:)
      !> Maximum number of steps of Newton's method
      integer, parameter :: most_steps = 10
      integer :: i, j, k, n

      n = 0
      n_left = 0
      do j = 1, self%n_near
         i = self%near(j)
         k = self%pieces(1, i)
         if (k > self%pieces(2, i)) cycle
         if (k < self%pieces(2, i)) then
            n_left = n_left + 1
            left(n_left) = i
            cycle
         end if
         n = n + 1
         self%index(n) = i
         self%target(n) = y(i)
         self%rail(n) = z(i)
         self%piece(n) = k
         self%place(n) = (self%y(k) - y(i))/(self%y(k) - self%y(k + 1))*(wheel%y%s(k + 1) - wheel%y%s(k))
      end do
      associate (wheel_frame => placement%wheel)
         call find_locus(n, self%target, self%rail, self%piece, self%profile%n - 1, wheel%y%s, wheel%y%c, wheel%z%c, &
            & wheel_frame%origin, wheel_frame%axes, placement%wheel_radius, furthest, placement%roller_radius, &
            & placement%lowest_on_roller(), steepest, lateral_accuracy, along_accuracy, most_steps, self%place, self%found_x, &
            & self%found_z, self%found)
      end associate
      do j = 1, n
         i = self%index(j)
         if (self%found(j) == 1) then
            gap(i) = z(i) + placement%roller_drop(self%found_x(j), z(i)) - self%found_z(j)
            x(i) = self%found_x(j)
         else
            n_left = n_left + 1
            left(n_left) = i
         end if
      end do
   end subroutine compute
end module contact_wheelrail_gap_survey
