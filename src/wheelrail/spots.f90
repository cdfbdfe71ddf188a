!> Interpenetration that is divided along the track, as below the two ends of a wheel flat
!>
!> On a mesh, points with interpenetration that are neighbours, also diagonally, form one spot. A stretch of lateral positions with
!> several spots is divided into gap curves with one spot each.
module contact_wheelrail_spots
   use contact_base_kinds, only : wp
   use contact_wheelrail_gap, only : gap_curve, no_surface, smallest_in_row
   implicit none (type, external)
   private

   public :: spot, separate_spots

   !> One of several spots
   type :: spot
      !> Gap without the interpenetration of other spots
      type(gap_curve) :: gap
      !> Smallest gap at each lateral position at the present height [mm]
      real(wp), allocatable :: g(:)
      !> First and last lateral position with interpenetration
      integer :: first = 0, last = 0
   end type spot

contains

   !> The spots of a stretch; none if it has a single one
   subroutine separate_spots(gap, g, first, last, spots)
      !> Gap with its table
      type(gap_curve), intent(in) :: gap
      !> Gap at the present height [mm]
      real(wp), intent(in) :: g(:)
      !> First and last lateral position with g < 0
      integer, intent(in) :: first, last
      !> One gap per spot, in the order of y
      type(spot), allocatable, intent(out) :: spots(:)
      integer, allocatable :: label(:, :)
      integer :: i, k, n

      if (is_one_spot(gap, g, first, last)) then
         allocate(spots(0))
         return
      end if
      allocate(label(size(gap%x_table), first:last))
      do i = first, last
         label(:, i) = merge(-1, 0, gap%table(:, i) + (g(i) - gap%gap(i)) < 0.0_wp)
         ! a stretch that is too short for the table is at the position of the smallest gap
         if (all(label(:, i) == 0)) label(minloc(abs(gap%x_table - gap%x(i)), 1), i) = -1
      end do
      call number_spots(label, n)
      if (n < 2) then
         allocate(spots(0))
         return
      end if
      allocate(spots(n))
      do k = 1, n
         spots(k)%first = first - 1 + findloc(any(label == k, 1), .true., 1)
         spots(k)%last = first - 1 + findloc(any(label == k, 1), .true., 1, back=.true.)
         call isolate_spot(gap, g, label, first, k, spots(k))
      end do
   end subroutine separate_spots

   !> Does every lateral position have one contiguous interval of interpenetration, connected to that of its neighbour? Otherwise
   !> spots are numbered
   pure logical function is_one_spot(gap, g, first, last)
      !> See `separate_spots`
      type(gap_curve), intent(in) :: gap
      real(wp), intent(in) :: g(:)
      integer, intent(in) :: first, last
      integer :: i, k, low, high, inside, before(2)

      is_one_spot = .false.
      before = [1, size(gap%x_table)]
      do i = first, last
         low = 0
         high = 0
         inside = 0
         associate (change => g(i) - gap%gap(i))
            do k = 1, size(gap%x_table)
               if (.not. gap%table(k, i) + change < 0.0_wp) cycle
               if (low == 0) low = k
               high = k
               inside = inside + 1
            end do
         end associate
         if (inside == 0 .or. inside /= high - low + 1) return
         if (low > before(2) + 1 .or. high < before(1) - 1) return
         before = [low, high]
      end do
      is_one_spot = .true.
   end function is_one_spot

   !> Number the points of each spot, 1...n, replacing -1
   pure subroutine number_spots(label, n)
      integer, intent(inout) :: label(:, :)
      integer, intent(out) :: n
      integer :: waiting(2, size(label))
      integer :: i, j, ix, iy, x, y, w

      n = 0
      do j = 1, size(label, 2)
         do i = 1, size(label, 1)
            if (label(i, j) /= -1) cycle
            n = n + 1
            label(i, j) = n
            waiting(:, 1) = [i, j]
            w = 1
            do while (w > 0)
               x = waiting(1, w)
               y = waiting(2, w)
               w = w - 1
               do iy = max(1, y - 1), min(size(label, 2), y + 1)
                  do ix = max(1, x - 1), min(size(label, 1), x + 1)
                     if (label(ix, iy) /= -1) cycle
                     label(ix, iy) = n
                     w = w + 1
                     waiting(:, w) = [ix, iy]
                  end do
               end do
            end do
         end do
      end do
   end subroutine number_spots

   !> The gap without the interpenetration of other spots
   pure subroutine isolate_spot(gap, g, label, start, k, own)
      type(gap_curve), intent(in) :: gap
      real(wp), intent(in) :: g(:)
      !> Lateral position of the first row of the labels
      integer, intent(in) :: start
      !> Spot numbers on the table, from the first lateral position of the stretch
      integer, intent(in) :: label(:, start:)
      integer, intent(in) :: k
      !> Spot with its first and last lateral position; its gap is set
      type(spot), intent(inout) :: own
      integer :: i, beside, low, high

      own%gap = gap
      own%g = g
      do i = max(start, own%first - 1), min(ubound(label, 2), own%last + 1)
         ! beyond the ends of the spot, the x range is that of its last row
         beside = min(max(i, own%first), own%last)
         low = max(1, findloc(label(:, beside) == k, .true., 1) - 1)
         high = min(size(label, 1), findloc(label(:, beside) == k, .true., 1, back=.true.) + 1)
         where (label(:, i) > 0 .and. label(:, i) /= k) own%gap%table(:, i) = no_surface
         call smallest_in_row(gap%x_table(low:high), own%gap%table(low:high, i), own%gap%x(i), own%gap%gap(i))
         own%g(i) = own%gap%gap(i) + (g(i) - gap%gap(i))
         if (i == beside) cycle
         own%g(i) = max(own%g(i), tiny(1.0_wp))
      end do
   end subroutine isolate_spot
end module contact_wheelrail_spots
