!> Control points that enclose a part of a variable profile
!>
!> Along u each line of a surface is a cubic spline. On a stretch without knots it is a single cubic, which lies within the
!> convex hull of four control points. They give bounds of a surface without cuts at individual positions, between which it
!> could be anywhere.
module contact_profile_surface_hull
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_numeric_b_spline, only : basis_values, knot_interval
   use contact_profile_request, only : profile_side
   use contact_profile_surface, only : profile_surface
   implicit none (type, external)
   private

   public :: stretch_breaks, stretch_hull

contains

   !> Positions that divide a range into stretches without knots; they include the ends of the surface
   subroutine stretch_breaks(surface, range, breaks)
      !> Surface with knots along u
      type(profile_surface), intent(in) :: surface
      !> Increasing: along the track [mm], or around the wheel, less than one turn [rad]
      real(wp), intent(in) :: range(2)
      !> Increasing, `range` first and last
      real(wp), allocatable, intent(out) :: breaks(:)
      real(wp) :: turn
      integer :: g, lap

      turn = merge(2.0_wp*pi, 0.0_wp, surface%side == profile_side%wheel)
      breaks = range
      do g = 1, size(surface%groups)
         associate (group => surface%groups(g))
            do lap = merge(-1, 0, turn > 0.0_wp), merge(1, 0, turn > 0.0_wp)
               call add([group%low, group%high] + lap*turn)
               call add(group%t(5:size(group%t) - 4) + lap*turn)
            end do
         end associate
      end do
      if (.not. turn > 0.0_wp) return
      ! a wheel that is not given all around continues from its last slice to half a turn, and from there to its first one
      call add([-pi, pi])

   contains

      !> Insert positions that are new and within the range
      subroutine add(places)
         real(wp), intent(in) :: places(:)
         integer :: i, k

         do i = 1, size(places)
            if (places(i) <= range(1) .or. places(i) >= range(2)) cycle
            k = count(breaks <= places(i))
            if (breaks(k) >= places(i)) cycle
            breaks = [breaks(:k), places(i), breaks(k + 1:)]
         end do
      end subroutine add
   end subroutine stretch_breaks

   !> Control points of all lines of a stretch; beyond the ends of the surface those at the end
   subroutine stretch_hull(surface, stretch, y, z, first, last, lines)
      !> Surface with at least one line
      type(profile_surface), intent(in) :: surface
      !> Between two consecutive values of `stretch_breaks`
      real(wp), intent(in) :: stretch(2)
      !> Shape (lines, 4) [mm], in the coordinates of the surface; set from `first` to `last`
      real(wp), intent(out) :: y(:, :), z(:, :)
      !> Contiguous range of lines that a cut would use; `last` < `first` if there is none
      integer, intent(out) :: first, last
      !> First and last line that are needed; default: all
      integer, intent(in), optional :: lines(2)
      real(wp) :: u(2), middle, h, b(4, 2), slope(4, 2), weights(4, 4)
      logical :: there(surface%lines)
      integer :: g, i, j, k, m, range(2)

      u = stretch
      middle = 0.5_wp*(u(1) + u(2))
      if (surface%side == profile_side%wheel) u = u - 2.0_wp*pi*nint(middle/(2.0_wp*pi))
      u = min(max(u, surface%u_range(1)), surface%u_range(2))
      middle = 0.5_wp*(u(1) + u(2))
      h = (u(2) - u(1))/3.0_wp
      there = .false.
      range = [1, surface%lines]
      if (present(lines)) range = [max(lines(1), 1), min(lines(2), surface%lines)]
      do g = 1, size(surface%groups)
         associate (group => surface%groups(g))
            if (middle < group%low .or. middle > group%high) cycle
            j = knot_interval(group%t, middle)
            do k = 1, 2
               call basis_values(group%t, j, u(k), b(:, k), slope(:, k))
            end do
            weights(:, 1) = b(:, 1)
            weights(:, 2) = b(:, 1) + h*slope(:, 1)
            weights(:, 3) = b(:, 2) - h*slope(:, 2)
            weights(:, 4) = b(:, 2)
            do k = 1, 4
               do i = max(range(1), group%first), min(range(2), group%last)
                  m = i - group%first + 1
                  y(i, k) = weights(1, k)*group%y(m, j - 3) + weights(2, k)*group%y(m, j - 2) + weights(3, k)*group%y(m, j - 1) &
                     & + weights(4, k)*group%y(m, j)
                  z(i, k) = weights(1, k)*group%z(m, j - 3) + weights(2, k)*group%z(m, j - 2) + weights(3, k)*group%z(m, j - 1) &
                     & + weights(4, k)*group%z(m, j)
               end do
            end do
            there(group%first:group%last) = .true.
         end associate
      end do
      first = findloc(there, .true., 1)
      last = first
      if (first == 0) then
         last = -1
         return
      end if
      do while (last < surface%lines)
         if (.not. there(last + 1)) exit
         last = last + 1
      end do
      first = max(first, range(1))
      last = min(last, range(2))
   end subroutine stretch_hull
end module contact_profile_surface_hull
