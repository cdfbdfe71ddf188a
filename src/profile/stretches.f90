!> Stretches of a curve on which y is monotonic, and the inverse s(y) on them
module contact_profile_stretches
   use contact_base_kinds, only : wp
   use contact_numeric_polynomial, only : monotone_cubic_root, quadratic_roots
   use contact_numeric_spline, only : cubic_spline, piece_of
   implicit none (type, external)
   private

   public :: find_turns, follow_stretch, piece_in_stretch, place_in_piece, place_in_stretch, sorted, stretch, stretch_between

   !> A range of s on which y is monotonic
   type :: stretch
      !> Ends of the range
      real(wp) :: s_low, s_high
      !> Pieces that contain the ends
      integer :: first, last
      !> Does y increase with s?
      logical :: rises
   end type stretch

contains

   !> Ends of the stretches of s on which y is monotonic
   subroutine find_turns(y, turns)
      !> y as a function of s [mm]
      type(cubic_spline), intent(in) :: y
      !> Increasing; the first and last are the ends of the curve [mm]
      real(wp), allocatable, intent(out) :: turns(:)
      real(wp) :: roots(2), h, before, between, behind
      integer :: i, k, n, pieces, count
      real(wp), allocatable :: found(:)

      pieces = size(y%s) - 1
      allocate(found(3*pieces + 1))
      found(1) = y%s(1)
      count = 1
      do i = 1, pieces
         h = y%s(i + 1) - y%s(i)
         before = y%c(1, i) + h*(2.0_wp*y%c(2, i) + 3.0_wp*h*y%c(3, i))
         ! a parabola has no zero if its values at both ends and the intersection of its end tangents have the same sign
         between = y%c(1, i) + h*y%c(2, i)
         if (.not. (before*between > 0.0_wp .and. y%c(1, i)*between > 0.0_wp)) then
            call quadratic_roots(3.0_wp*y%c(3, i), 2.0_wp*y%c(2, i), y%c(1, i), 0.0_wp, h, roots, n)
            do k = 1, n
               count = count + 1
               found(count) = y%s(i) + roots(k)
            end do
         end if
         if (i == pieces) exit
         ! at the end of a piece y reverses at a corner, or where the slope is exactly zero
         behind = y%c(1, i + 1)
         if (before*behind > 0.0_wp) cycle
         count = count + 1
         found(count) = y%s(i + 1)
      end do
      turns = [found(:count), y%s(pieces + 1)]
   end subroutine find_turns

   !> The stretch between two arc lengths
   pure function stretch_between(y, s_low, s_high) result(along)
      !> y as a function of s [mm]
      type(cubic_spline), intent(in) :: y
      !> Ends of the stretch [mm], between two reversals
      real(wp), intent(in) :: s_low, s_high
      type(stretch) :: along

      along%s_low = s_low
      along%s_high = s_high
      along%first = piece_of(y%s, s_low)
      along%last = piece_of(y%s, s_high)
      along%rises = y%value(s_high) > y%value(s_low)
   end function stretch_between

   !> Arc length of a given y in a stretch where y is monotonic; the nearer end if there is none
   pure real(wp) function place_in_stretch(y, along, target) result(s)
      !> y as a function of s [mm]
      type(cubic_spline), intent(in) :: y
      !> Stretch where y is monotonic
      type(stretch), intent(in) :: along
      !> Value of y [mm]
      real(wp), intent(in) :: target
      integer :: piece

      piece = piece_in_stretch(y, along, target)
      s = y%s(piece) + place_in_piece(y, along, piece, target)
   end function place_in_stretch

   !> Index of the piece of a stretch that contains a value of y
   pure integer function piece_in_stretch(y, along, target) result(first)
      !> y as a function of s [mm]
      type(cubic_spline), intent(in) :: y
      !> Stretch where y is monotonic
      type(stretch), intent(in) :: along
      !> Value of y [mm]
      real(wp), intent(in) :: target
      integer :: last, middle

      first = along%first
      last = along%last
      do while (last > first)
         middle = (first + last + 1)/2
         if (y%c(0, middle) < target .eqv. along%rises) then
            first = middle
         else
            last = middle - 1
         end if
      end do
   end function piece_in_stretch

   !> Piece of a stretch that contains a value of y, and position in it, from estimates of both
   !>
   !> The estimate is followed to neighbouring pieces and corrected by Newton's method. If it is not near, the whole stretch is
   !> searched.
   pure subroutine follow_stretch(y, along, target, piece, place)
      !> y as a function of s [mm]
      type(cubic_spline), intent(in) :: y
      !> Stretch where y is monotonic
      type(stretch), intent(in) :: along
      !> Value of y [mm]
      real(wp), intent(in) :: target
      !> Estimate on entry, any number
      integer, intent(inout) :: piece
      !> Distance from the start of the piece [mm], estimate on entry
      real(wp), intent(inout) :: place
      !> Number of neighbouring pieces and of steps of Newton's method that are tried
      integer, parameter :: pieces = 4, steps = 4
      real(wp) :: low, high, bend, precision, s, slope, step
      logical :: found
      integer :: k

      found = .false.
      if (piece >= along%first .and. piece <= along%last) then
         s = y%s(piece) + place
         do k = 0, pieces
            if (piece > along%first) then
               if (y%c(0, piece) < target .neqv. along%rises) then
                  piece = piece - 1
                  cycle
               end if
            end if
            if (piece < along%last) then
               if (y%c(0, piece + 1) < target .eqv. along%rises) then
                  piece = piece + 1
                  cycle
               end if
            end if
            found = .true.
            exit
         end do
      end if
      if (.not. found) then
         piece = piece_in_stretch(y, along, target)
         place = place_in_piece(y, along, piece, target)
         return
      end if
      associate (start => y%s(piece))
         low = max(along%s_low, start) - start
         high = min(along%s_high, y%s(piece + 1)) - start
         place = min(max(s - start, low), high)
         ! accuracy as in `monotone_cubic_root`
         precision = 4.0_wp*epsilon(1.0_wp)*high
         bend = abs(y%c(2, piece)) + 3.0_wp*abs(y%c(3, piece))*high
         do k = 1, steps
            slope = y%c(1, piece) + place*(2.0_wp*y%c(2, piece) + place*3.0_wp*y%c(3, piece))
            step = y%c(0, piece) + place*(y%c(1, piece) + place*(y%c(2, piece) + place*y%c(3, piece))) - target
            if (abs(step) >= (high - low)*abs(slope)) exit
            step = step/slope
            place = place - step
            if (place < low .or. place > high) exit
            if (2.0_wp*bend*step**2 <= precision*abs(slope)) return
         end do
      end associate
      place = place_in_piece(y, along, piece, target)
   end subroutine follow_stretch

   !> Position of a given y in a piece of a stretch, from the start of the piece
   pure real(wp) function place_in_piece(y, along, piece, target) result(place)
      !> y as a function of s [mm]
      type(cubic_spline), intent(in) :: y
      !> Stretch where y is monotonic
      type(stretch), intent(in) :: along
      !> From `piece_in_stretch`
      integer, intent(in) :: piece
      !> Value of y [mm]
      real(wp), intent(in) :: target

      associate (start => y%s(piece))
         place = monotone_cubic_root(y%c(:, piece), max(along%s_low, start) - start, &
            & min(along%s_high, y%s(piece + 1)) - start, target)
      end associate
   end function place_in_piece

   !> Values in increasing order (heap sort)
   pure function sorted(values) result(order)
      !> Any numbers
      real(wp), intent(in) :: values(:)
      real(wp) :: order(size(values))
      integer :: n, i

      order = values
      n = size(order)
      do i = n/2, 1, -1
         call sift(order, i, n)
      end do
      do i = n, 2, -1
         order([1, i]) = order([i, 1])
         call sift(order, 1, i - 1)
      end do
   end function sorted

   pure subroutine sift(heap, top, n)
      real(wp), intent(inout) :: heap(:)
      integer, intent(in) :: top, n
      integer :: parent, child

      parent = top
      do while (2*parent <= n)
         child = 2*parent
         if (child < n) then
            if (heap(child + 1) > heap(child)) child = child + 1
         end if
         if (heap(parent) >= heap(child)) exit
         heap([parent, child]) = heap([child, parent])
         parent = child
      end do
   end subroutine sift
end module contact_profile_stretches
