!> Estimates of the gap between a wheel and a rail, to find where it may be small
!>
!> A search for the height of a wheel needs the exact gap where the bodies are close to each other. Elsewhere an estimate is
!> sufficient: the contact locus at the nodes of the wheel's profile by one step of its iteration, and straight lines between the
!> nodes.
module contact_wheelrail_gap_survey
   use contact_base_kinds, only : wp
   use contact_profile_curve, only : profile_curve
   use contact_wheelrail_placement, only : wheel_rail_placement
   implicit none (type, external)
   private

   public :: gap_survey

   !> Estimates on the nodes of a wheel's profile and on a mesh over the rail; its arrays are kept from one survey to the next
   type :: gap_survey
      !> Locus at the nodes, coordinates x, y, z in the track [mm], shape (3, nodes)
      real(wp), allocatable :: node(:, :)
      !> Gap at the mesh points, and longitudinal position of the locus there [mm], shape (n)
      real(wp), allocatable :: gap(:), x(:)
      !> Lower bound of the gap by the estimate [mm], shape (n)
      real(wp), allocatable, private :: least(:)
      !> First and last piece of the wheel's profile above a mesh point, first > last if there is none; shape (2, n)
      integer, allocatable, private :: pieces(:, :)
      !> Must the gap be computed exactly? Shape (n)
      logical, allocatable :: is_near(:)
      !> Must both ends of a piece of the wheel's profile be computed exactly? Shape (nodes)
      logical, allocatable :: needs_piece(:)
   contains
      !> Compute the estimates
      procedure :: look
      procedure, private :: make_room
      procedure, private :: estimate_nodes
      procedure, private :: estimate_gaps
      procedure, private :: mark
   end type gap_survey

   !> Maximum distance of the locus from the lowest point of the wheel, relative to the radius
   real(wp), parameter, public :: furthest = 0.5_wp
   !> Upper bound of dy/ds along the profile, used instead of larger values if the profile is steeper [-]
   real(wp), parameter, public :: steepest = -1.0e-6_wp
   !> Maximum error of an estimate at a node without yaw angle [mm]
   real(wp), parameter :: node_error = 0.01_wp

contains

   !> Estimate the gap over a mesh, and mark the points at which it must be computed exactly
   pure subroutine look(self, wheel, placement, y, z, on_rail, no_surface, reach, looked_at)
      class(gap_survey), intent(inout) :: self
      !> Profile of a round wheel in its own coordinates
      type(profile_curve), intent(in) :: wheel
      !> Position of the bodies, on a track
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

      call self%make_room(size(wheel%y%s), size(y))
      call self%estimate_nodes(wheel, placement)
      call self%estimate_gaps(wheel, placement, y, z, on_rail, no_surface)
      call self%mark(reach, looked_at, no_surface)
   end subroutine look

   !> Allocate arrays of the right size
   pure subroutine make_room(self, nodes, n)
      class(gap_survey), intent(inout) :: self
      !> Numbers of nodes and of mesh points
      integer, intent(in) :: nodes, n

      if (allocated(self%node)) then
         if (size(self%node, 2) /= nodes) deallocate(self%node, self%needs_piece)
      end if
      if (.not. allocated(self%node)) allocate(self%node(3, nodes), self%needs_piece(nodes))
      if (allocated(self%gap)) then
         if (size(self%gap) /= n) deallocate(self%gap, self%x, self%least, self%pieces, self%is_near)
      end if
      if (.not. allocated(self%gap)) allocate(self%gap(n), self%x(n), self%least(n), self%pieces(2, n), &
         & self%is_near(n))
   end subroutine make_room

   !> The locus at the nodes, by the first step of the iteration for its longitudinal position
   pure subroutine estimate_nodes(self, wheel, placement)
      class(gap_survey), intent(inout) :: self
      type(profile_curve), intent(in) :: wheel
      type(wheel_rail_placement), intent(in) :: placement
      real(wp) :: radius, lean, local(3)
      integer :: k, n

      n = size(wheel%y%s)
      associate (axes => placement%wheel%axes, origin => placement%wheel%origin, cy => wheel%y%c, cz => wheel%z%c)
         do k = 1, n
            if (k < n) then
               local(2:3) = [cy(0, k), cz(0, k)]
               lean = cz(1, k)/min(steepest, cy(1, k))
            else
               associate (h => wheel%y%s(n) - wheel%y%s(n - 1))
                  local(2) = cy(0, n - 1) + h*(cy(1, n - 1) + h*(cy(2, n - 1) + h*cy(3, n - 1)))
                  local(3) = cz(0, n - 1) + h*(cz(1, n - 1) + h*(cz(2, n - 1) + h*cz(3, n - 1)))
                  lean = (cz(1, n - 1) + h*(2.0_wp*cz(2, n - 1) + h*3.0_wp*cz(3, n - 1))) &
                     & /min(steepest, cy(1, n - 1) + h*(2.0_wp*cy(2, n - 1) + h*3.0_wp*cy(3, n - 1)))
               end associate
            end if
            radius = placement%wheel_radius + local(3)
            local(1) = radius*(axes(1, 2)*lean - axes(1, 3))/axes(1, 1)
            local(1) = max(-furthest*placement%wheel_radius, min(furthest*placement%wheel_radius, local(1)))
            local(3) = sqrt(radius**2 - local(1)**2) - placement%wheel_radius
            self%node(:, k) = origin + axes(:, 1)*local(1) + axes(:, 2)*local(2) + axes(:, 3)*local(3)
         end do
      end associate
   end subroutine estimate_nodes

   !> Gaps between the nodes, by straight lines
   !>
   !> A piece deviates from its chord by at most its largest second derivative times the square of its length over 8.
   pure subroutine estimate_gaps(self, wheel, placement, y, z, on_rail, no_surface)
      class(gap_survey), intent(inout) :: self
      type(profile_curve), intent(in) :: wheel
      type(wheel_rail_placement), intent(in) :: placement
      !> See `look`
      real(wp), intent(in) :: y(:), z(:)
      logical, intent(in) :: on_rail(:)
      real(wp), intent(in) :: no_surface
      real(wp) :: per_step, t, vertical, error, by_yaw, turned
      integer :: i, k

      self%gap = no_surface
      self%least = no_surface
      self%x = 0.0_wp
      self%pieces(1, :) = size(wheel%y%s)
      self%pieces(2, :) = 0
      if (size(y) < 2) return
      per_step = 1.0_wp/(y(2) - y(1))
      ! the second step of the iteration for the locus is smaller than the first one by a factor of the square of the yaw angle
      by_yaw = node_error + furthest*placement%wheel_radius*abs(placement%wheel%axes(2, 1))**3
      do k = 1, size(wheel%y%s) - 1
         associate (a => self%node(:, k), b => self%node(:, k + 1), h => wheel%y%s(k + 1) - wheel%y%s(k), &
            & cy => wheel%y%c(2:3, k), cz => wheel%z%c(2:3, k))
            ! the surface faces the rail if y decreases along the profile
            if (.not. a(2) > b(2)) cycle
            if (a(2) < y(1) .or. b(2) > y(size(y))) cycle
            t = (b(3) - a(3))/(b(2) - a(2))
            turned = max(abs(cz(1)), abs(cz(1) + 3.0_wp*h*cz(2))) + abs(t)*max(abs(cy(1)), abs(cy(1) + 3.0_wp*h*cy(2)))
            error = by_yaw*(1.0_wp + abs(t)) + 0.25_wp*h**2*turned
            do i = max(1, ceiling((b(2) - y(1))*per_step) + 1), min(size(y), floor((a(2) - y(1))*per_step) + 1)
               if (.not. on_rail(i)) cycle
               self%pieces(1, i) = min(self%pieces(1, i), k)
               self%pieces(2, i) = max(self%pieces(2, i), k)
               t = (y(i) - a(2))/(b(2) - a(2))
               vertical = z(i) - (a(3) + t*(b(3) - a(3)))
               self%least(i) = min(self%least(i), vertical - error)
               if (vertical >= self%gap(i)) cycle
               self%gap(i) = vertical
               self%x(i) = a(1) + t*(b(1) - a(1))
            end do
         end associate
      end do
   end subroutine estimate_gaps

   !> Mark the mesh points whose gap may be small, and the pieces of the wheel above them
   pure subroutine mark(self, reach, looked_at, no_surface)
      class(gap_survey), intent(inout) :: self
      !> See `look`
      real(wp), intent(in) :: reach, looked_at, no_surface
      real(wp) :: most, lowest
      integer :: i, n
      logical :: is_minimum

      n = size(self%gap)
      most = no_surface
      lowest = no_surface
      do i = 1, n
         most = min(most, 2.0_wp*self%gap(i) - self%least(i))
         lowest = min(lowest, self%gap(i))
      end do
      most = most + reach
      self%is_near = .false.
      do i = 1, n
         if (.not. self%gap(i) < no_surface) cycle
         is_minimum = self%gap(i) < lowest + looked_at
         if (is_minimum) is_minimum = self%gap(i) <= min(self%gap(max(1, i - 1)), self%gap(min(n, i + 1)))
         ! the neighbours determine where the gap vanishes between mesh points
         if (self%least(i) <= most .or. is_minimum) self%is_near(max(1, i - 1):min(n, i + 1)) = .true.
      end do
      self%needs_piece = .false.
      do i = 1, n
         ! exact ends of pieces may be on the other side of a mesh point than the estimates
         if (self%is_near(i)) self%needs_piece(max(1, self%pieces(1, i) - 1):min(size(self%needs_piece), &
            & self%pieces(2, i) + 1)) = .true.
      end do
   end subroutine mark
end module contact_wheelrail_gap_survey
