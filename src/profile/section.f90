!> The part of a rail's profile that lies below a contact patch, in the axes of the patch
!>
!> The profile is followed from given positions as long as the lateral coordinate of the patch is monotone; other parts above the
!> plane, such as the far wall of a groove, do not belong to the section. Pieces of the profile are rotated when they are used, so
!> that the curve is not copied.
module contact_profile_section
   use contact_base_kinds, only : wp
   use contact_numeric_polynomial, only : monotone_cubic_root, quadratic_roots
   use contact_numeric_spline, only : piece_of
   use contact_profile_curve, only : profile_curve
   implicit none (type, external)
   private

   public :: profile_section

   !> A range of s along which the lateral coordinate increases or decreases
   type :: followed_stretch
      !> Its ends in s, and the lateral coordinate there [mm]
      real(wp) :: s(2) = 0.0_wp, y(2) = 0.0_wp
      !> Indices of the pieces with the ends, and of the piece with the last point
      integer :: first = 0, last = 0, piece = 0
   end type followed_stretch

   !> Section of a profile; its array is kept from one section to the next
   type :: profile_section
      private
      !> Cosine and sine of the roll angle of the axes, and their origin in the rolled axes [mm]
      real(wp) :: cosine = 1.0_wp, sine = 0.0_wp, origin(2) = 0.0_wp
      !> Number of stretches; the array may be larger
      integer :: n = 0
      type(followed_stretch), allocatable :: along(:)
   contains
      !> Find the section below a patch
      procedure :: follow
      !> Height of the surface at a lateral coordinate
      procedure :: height
   end type profile_section

   !> Initial number of allocated stretches: more are used only below patches that were joined from several
   integer, parameter :: few_stretches = 4

contains

   !> Find the stretches around given positions in which the lateral coordinate is monotone
   pure subroutine follow(self, curve, origin, angle, places, range)
      class(profile_section), intent(inout) :: self
      !> Profile of a rail
      type(profile_curve), intent(in) :: curve
      !> Origin (y, z) [mm] and roll angle [rad] of the axes of the patch in those of the curve
      real(wp), intent(in) :: origin(2), angle
      !> Arc lengths from which the profile is followed [mm]
      real(wp), intent(in) :: places(:)
      !> Increasing bounds of the lateral coordinate in the new axes, beyond which the profile is not followed [mm]
      real(wp), intent(in) :: range(2)
      integer :: i, k

      self%cosine = cos(angle)
      self%sine = sin(angle)
      self%origin = [self%cosine*origin(1) + self%sine*origin(2), self%cosine*origin(2) - self%sine*origin(1)]
      self%n = 0
      do i = 1, size(places)
         do k = 1, self%n
            if (places(i) >= self%along(k)%s(1) .and. places(i) <= self%along(k)%s(2)) exit
         end do
         if (k <= self%n) cycle
         call make_room(self)
         self%n = self%n + 1
         self%along(self%n) = stretch_around(self, curve, places(i), range)
      end do
   end subroutine follow

   !> Allocate one more stretch
   pure subroutine make_room(self)
      type(profile_section), intent(inout) :: self
      type(followed_stretch), allocatable :: longer(:)

      if (.not. allocated(self%along)) allocate(self%along(few_stretches))
      if (self%n < size(self%along)) return
      allocate(longer(2*self%n))
      longer(:self%n) = self%along
      call move_alloc(longer, self%along)
   end subroutine make_room

   !> The stretch around a position
   pure function stretch_around(self, curve, place, range) result(along)
      type(profile_section), intent(in) :: self
      type(profile_curve), intent(in) :: curve
      !> Arc length [mm]
      real(wp), intent(in) :: place
      !> See `follow`
      real(wp), intent(in) :: range(2)
      type(followed_stretch) :: along
      real(wp) :: turns(2), c(0:3), next(0:3)
      integer :: n

      associate (nodes => curve%y%s, first => along%first, last => along%last)
         first = piece_of(nodes, place)
         last = first
         along%piece = first
         along%s = [nodes(1), nodes(size(nodes))]
         ! towards smaller s
         c = lateral(self, curve, first)
         call turns_of(c, nodes(first + 1) - nodes(first), turns, n)
         if (n > 0) n = count(nodes(first) + turns(:n) <= place)
         do
            if (n > 0) then
               along%s(1) = nodes(first) + turns(n)
               exit
            end if
            along%s(1) = nodes(first)
            if (first == 1 .or. c(0) < range(1) .or. c(0) > range(2)) exit
            next = lateral(self, curve, first - 1)
            if (.not. slope_at_end(next, nodes(first) - nodes(first - 1))*c(1) > 0.0_wp) exit
            first = first - 1
            c = next
            call turns_of(c, nodes(first + 1) - nodes(first), turns, n)
         end do
         along%y(1) = value(c, along%s(1) - nodes(first))
         ! towards larger s
         c = lateral(self, curve, last)
         call turns_of(c, nodes(last + 1) - nodes(last), turns, n)
         if (n > 1 .and. nodes(last) + turns(1) <= place) turns(1) = turns(2)
         if (n > 0) n = merge(1, 0, nodes(last) + turns(1) > place)
         do
            if (n > 0) then
               along%s(2) = nodes(last) + turns(1)
               exit
            end if
            along%s(2) = nodes(last + 1)
            if (last == size(nodes) - 1) exit
            next = lateral(self, curve, last + 1)
            if (next(0) < range(1) .or. next(0) > range(2)) exit
            if (.not. slope_at_end(c, nodes(last + 1) - nodes(last))*next(1) > 0.0_wp) exit
            last = last + 1
            c = next
            call turns_of(c, nodes(last + 1) - nodes(last), turns, n)
         end do
         along%y(2) = value(c, along%s(2) - nodes(last))
      end associate
   end function stretch_around

   !> Height of the surface: the highest one of several stretches
   pure subroutine height(self, curve, y, z, found)
      class(profile_section), intent(inout) :: self
      !> The curve given to `follow`
      type(profile_curve), intent(in) :: curve
      !> Lateral coordinate in the axes of the patch [mm]
      real(wp), intent(in) :: y
      !> Height along the normal of the patch, into the rail [mm]; unchanged if there is no surface
      real(wp), intent(inout) :: z
      !> Is there a surface?
      logical, intent(out) :: found
      real(wp) :: c(0:3), place, here
      integer :: k

      found = .false.
      do k = 1, self%n
         associate (along => self%along(k), nodes => curve%y%s)
            if (y < min(along%y(1), along%y(2)) .or. y > max(along%y(1), along%y(2))) cycle
            call find_piece(self, curve, y, along)
            c = lateral(self, curve, along%piece)
            place = monotone_cubic_root(c, max(along%s(1), nodes(along%piece)) - nodes(along%piece), &
               & min(along%s(2), nodes(along%piece + 1)) - nodes(along%piece), y)
            c = self%cosine*curve%z%c(:, along%piece) - self%sine*curve%y%c(:, along%piece)
            c(0) = c(0) - self%origin(2)
            here = value(c, place)
            if (found .and. here >= z) cycle
            z = here
            found = .true.
         end associate
      end do
   end subroutine height

   !> Find the piece of a stretch with a lateral coordinate, starting from the last one: points are mostly in order
   pure subroutine find_piece(self, curve, y, along)
      type(profile_section), intent(in) :: self
      type(profile_curve), intent(in) :: curve
      !> Lateral coordinate within the stretch [mm]
      real(wp), intent(in) :: y
      !> On return with the piece
      type(followed_stretch), intent(inout) :: along
      logical :: rises

      rises = along%y(2) > along%y(1)
      do while (along%piece > along%first)
         if (start_of(along%piece) < y .eqv. rises) exit
         along%piece = along%piece - 1
      end do
      do while (along%piece < along%last)
         if (.not. (start_of(along%piece + 1) < y .eqv. rises)) exit
         along%piece = along%piece + 1
      end do

   contains

      !> Lateral coordinate of the beginning of a piece [mm]
      pure real(wp) function start_of(piece)
         integer, intent(in) :: piece
         start_of = self%cosine*curve%y%c(0, piece) + self%sine*curve%z%c(0, piece) - self%origin(1)
      end function start_of
   end subroutine find_piece

   !> Coefficients of the lateral coordinate along a piece
   pure function lateral(self, curve, piece) result(c)
      type(profile_section), intent(in) :: self
      type(profile_curve), intent(in) :: curve
      integer, intent(in) :: piece
      real(wp) :: c(0:3)

      c = self%cosine*curve%y%c(:, piece) + self%sine*curve%z%c(:, piece)
      c(0) = c(0) - self%origin(1)
   end function lateral

   !> Extrema of a coordinate within a piece
   pure subroutine turns_of(c, length, turns, n)
      !> Coefficients of the coordinate, and the length of the piece [mm]
      real(wp), intent(in) :: c(0:3), length
      !> Positions from the beginning of the piece [mm]; the first n are set
      real(wp), intent(out) :: turns(2)
      integer, intent(out) :: n
      real(wp) :: behind, between

      n = 0
      turns = 0.0_wp
      behind = slope_at_end(c, length)
      ! a parabola has no zero if its values at both ends and the intersection of its tangents there have the same sign
      between = c(1) + length*c(2)
      if (behind*between > 0.0_wp .and. c(1)*between > 0.0_wp) return
      call quadratic_roots(3.0_wp*c(3), 2.0_wp*c(2), c(1), 0.0_wp, length, turns, n)
   end subroutine turns_of

   !> Derivative of a coordinate at the end of a piece
   pure real(wp) function slope_at_end(c, length)
      !> Coefficients of the coordinate, and the length of the piece [mm]
      real(wp), intent(in) :: c(0:3), length
      slope_at_end = c(1) + length*(2.0_wp*c(2) + 3.0_wp*length*c(3))
   end function slope_at_end

   pure real(wp) function value(c, t)
      !> Coefficients, and the position in the piece [mm]
      real(wp), intent(in) :: c(0:3), t
      value = c(0) + t*(c(1) + t*(c(2) + t*c(3)))
   end function value
end module contact_profile_section
