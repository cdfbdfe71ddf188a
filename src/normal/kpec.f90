!> KPEC: contact area and shape of the pressures from the interpenetration of the surfaces
!>
!> Kik and Piotrowski (1996) let the surfaces overlap by a fixed part of the approach and take the
!> overlap for the contact area. Here the part varies from row to row as it does for an ellipse
!> (Vollebregt, in the guide of CONTACT), so that Hertz's area comes out where the surfaces are quadratic. Pressures
!> are semi-ellipses along each row, all with the same quotient of height and length.
!> Equations: doc/theory/approximate_normal.md
module contact_normal_kpec
   use contact_base_choices, only : normal_control
   use contact_base_constants, only : excluded_threshold
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_normal_hertz, only : hertz_by_curvatures, hertz_contact, hertz_load
   implicit none (type, external)
   private

   public :: kpec_shape

   !> Overlap below which there is no contact [mm]; only to keep clear of underflow
   real(wp), parameter :: min_overlap = 1.0e-30_wp
   !> Level at which the extent of the overlap is measured, as a part of the approach [-]
   real(wp), parameter :: half_way = 0.5_wp
   !> Smallest curvature that counts: it would open the gap by this part of the overlap along the window [-]
   real(wp), parameter :: min_rise = 0.25_wp
   !> Elements whose gap is larger than the smallest one by less than this part of the overlap stand for the deepest place,
   !> with a weight that falls to zero there [-]. With one element alone pressures would jump where another one takes its place
   real(wp), parameter :: nearly_deepest = 0.01_wp
   !> Distance of the ends of a row of contact beyond the outermost centres, at least, in elements [-]; only to keep an
   !> element of contact
   real(wp), parameter :: min_overhang = 1.0e-4_wp
   !> Extent across the rows, at least, in rows [-]
   real(wp), parameter :: min_extent = 0.02_wp

   !> The ellipse that gives the threshold of each row
   type :: threshold_ellipse
      !> Middle of the overlap across the rows [mm]
      real(wp) :: ym = 0.0_wp
      !> Semi-axis across the rows [mm]
      real(wp) :: bb = 1.0_wp
      !> Heights at the ends of the semi-axes along x and y, as parts of the approach [-]
      real(wp) :: level_x = half_way, level_y = half_way
   end type threshold_ellipse

   !> A contact area of one row reaches at least so many times as far across as the middle of that row is from its centre; chosen
   real(wp), parameter :: beyond_row = 1.1_wp

contains

   !> Pressures up to a factor.
   !>
   !> The factor is found by the caller, who knows the compliance: at the deepest place the pressures bring about a
   !> displacement equal to the overlap.
   pure subroutine kpec_shape(grid, gap, shape_, weight)
      !> Centres and sides of the elements
      type(potential_contact), intent(in) :: grid
      !> Distance of the undeformed surfaces less the approach [mm], shape (mx, my); negative where
      !> they overlap, above excluded_threshold where there is no contact possible
      real(wp), intent(in) :: gap(:, :)
      !> Pressures [-], shape (mx, my): positive in contact, largest 1 or less; all zero without overlap
      real(wp), intent(out) :: shape_(:, :)
      !> Weights of the elements in what is told of the deepest place [-], shape (mx, my); their sum is 1 where there is overlap
      real(wp), intent(out) :: weight(:, :)
      type(threshold_ellipse) :: ellipse
      real(wp) :: overlap, longest
      real(wp) :: middle(size(gap, 2)), half_length(size(gap, 2)), limit(size(gap, 2))
      integer :: ix, iy

      shape_ = 0.0_wp
      weight = 0.0_wp
      if (size(gap) == 0) return
      overlap = -minval(gap)
      if (.not. overlap > min_overlap) return
      weight = max(0.0_wp, 1.0_wp - (gap + overlap)/(nearly_deepest*overlap))
      weight = weight/sum(weight)
      ellipse = fit_ellipse(grid, gap, weight, overlap)
      do iy = 1, grid%my
         limit(iy) = (row_level(ellipse, grid%y(iy)) - 1.0_wp)*overlap
         call row_extent(grid, gap(:, iy), limit(iy), middle(iy), half_length(iy))
      end do
      longest = maxval(half_length)
      do iy = 1, grid%my
         if (half_length(iy) <= 0.0_wp) cycle
         do ix = 1, grid%mx
            if (gap(ix, iy) > limit(iy)) cycle
            shape_(ix, iy) = sqrt(max(0.0_wp, half_length(iy)**2 - (grid%x(ix) - middle(iy))**2))/longest
         end do
      end do
   end subroutine kpec_shape

   !> Part of the approach by which the gap may have opened at the rim of contact in a row [-]
   pure real(wp) function row_level(ellipse, y) result(level)
      type(threshold_ellipse), intent(in) :: ellipse
      !> Position of the row [mm]
      real(wp), intent(in) :: y

      level = ellipse%level_x + (ellipse%level_y - ellipse%level_x)*((y - ellipse%ym)/ellipse%bb)**2
      level = min(1.0_wp, max(0.0_wp, level))
   end function row_level

   !> Hertz's ellipse for the curvatures of the overlap
   pure function fit_ellipse(grid, gap, weight, overlap) result(ellipse)
      type(potential_contact), intent(in) :: grid
      real(wp), intent(in) :: gap(:, :)
      !> Weights of the elements at the deepest place [-], shape (mx, my)
      real(wp), intent(in) :: weight(:, :)
      !> Overlap there [mm]
      real(wp), intent(in) :: overlap
      type(threshold_ellipse) :: ellipse
      type(hertz_contact) :: hertz
      real(wp) :: a1, b1, start, end_
      integer :: ix, iy
      logical :: one_row

      a1 = 0.0_wp
      do iy = 1, grid%my
         do ix = 1, grid%mx
            if (weight(ix, iy) > 0.0_wp) a1 = a1 + weight(ix, iy)*curvature_along(grid, gap(:, iy), ix, overlap)
         end do
      end do
      call extent_across(grid, gap, overlap, start, end_, one_row)
      ellipse%ym = 0.5_wp*(start + end_)
      b1 = half_way*overlap/(0.5_wp*(end_ - start))**2
      hertz = hertz_by_curvatures(hertz_load(normal_control%approach, pen=overlap), a1, b1)
      ellipse%bb = hertz%bb
      if (one_row) ellipse%bb = max(ellipse%bb, beyond_row*abs(grid%y(maxloc(maxval(weight, dim=1), dim=1)) - ellipse%ym))
      ellipse%level_x = a1*hertz%aa**2/overlap
      ellipse%level_y = b1*hertz%bb**2/overlap
   end function fit_ellipse

   !> Half the second derivative of the gap along a row [1/mm], over the length of half the overlap
   !>
   !> Not negative, since the gap is smallest in the middle; min_rise makes it positive.
   pure real(wp) function curvature_along(grid, row, middle, overlap) result(curvature)
      type(potential_contact), intent(in) :: grid
      !> Gap of the row [mm]
      real(wp), intent(in) :: row(:)
      !> Place of the smallest gap
      integer, intent(in) :: middle
      real(wp), intent(in) :: overlap
      real(wp) :: rise, next_rise, low, high, gap_before, part
      integer :: k

      rise = 0.0_wp
      gap_before = -overlap
      do k = 1, size(row)
         if (.not. (is_possible(row, middle - k) .or. is_possible(row, middle + k))) exit
         if (is_possible(row, middle - k) .and. is_possible(row, middle + k)) then
            low = row(middle - k)
            high = row(middle + k)
         else if (rise > 0.0_wp) then
            exit
         else
            ! the smallest gap is beside the window or an excluded element: the same on the other side
            low = row(merge(middle - k, middle + k, is_possible(row, middle - k)))
            high = low
         end if
         next_rise = (0.5_wp*(low + high) + overlap)/(k*grid%dx)**2
         if (max(low, high) > -half_way*overlap) then
            ! between the elements on either side of the level, so that it passes from one to the next without a jump
            part = 1.0_wp
            if (k > 1) part = (-half_way*overlap - gap_before)/(max(low, high) - gap_before)
            rise = rise + part*(next_rise - rise)
            exit
         end if
         rise = next_rise
         gap_before = max(low, high)
      end do
      curvature = max(rise, min_rise*overlap/(size(row)*grid%dx)**2)
   end function curvature_along

   !> Is there such an element, and may it be in contact?
   pure logical function is_possible(row, ix)
      real(wp), intent(in) :: row(:)
      integer, intent(in) :: ix

      is_possible = ix >= 1 .and. ix <= size(row)
      if (is_possible) is_possible = row(ix) < excluded_threshold
   end function is_possible

   !> Between which positions the surfaces overlap by half of the largest overlap
   pure subroutine extent_across(grid, gap, overlap, start, end_, one_row)
      type(potential_contact), intent(in) :: grid
      real(wp), intent(in) :: gap(:, :)
      real(wp), intent(in) :: overlap
      !> Positions [mm], start < end_
      real(wp), intent(out) :: start, end_
      !> Does one row only overlap so much?
      logical, intent(out) :: one_row
      real(wp) :: lowest(size(gap, 2)), widen
      integer :: iy, first, last

      lowest = minval(gap, dim=1)
      first = 0
      last = 0
      do iy = 1, grid%my
         if (lowest(iy) > -half_way*overlap) cycle
         if (first == 0) first = iy
         last = iy
      end do
      one_row = first == last
      start = grid%y(first) - grid%dy*steps_to_level(lowest, first, -1, -half_way*overlap)
      end_ = grid%y(last) + grid%dy*steps_to_level(lowest, last, 1, -half_way*overlap)
      widen = 0.5_wp*max(0.0_wp, min_extent*grid%dy - (end_ - start))
      start = start - widen
      end_ = end_ + widen
   end subroutine extent_across

   !> Distance from a row to where the smallest gaps of the rows reach a level, in rows: linear between the row and
   !> the next one outwards; linear extrapolation at the edge of the window
   pure real(wp) function steps_to_level(lowest, row, outwards, level) result(steps)
      !> Smallest gap of each row [mm]
      real(wp), intent(in) :: lowest(:)
      !> Last row with a gap below the level; +1 or -1
      integer, intent(in) :: row, outwards
      !> [mm]
      real(wp), intent(in) :: level
      real(wp) :: here, there

      here = lowest(row)
      steps = 0.5_wp
      if (is_possible(lowest, row + outwards)) then
         ! the next row is above the level
         steps = (level - here)/(lowest(row + outwards) - here)
      else if (is_possible(lowest, row - outwards)) then
         there = 2.0_wp*here - lowest(row - outwards)
         steps = real(size(lowest), wp)
         if (there > here) steps = min(steps, (level - here)/(there - here))
         steps = max(0.5_wp, steps)
      end if
   end function steps_to_level

   !> Middle and half the length of the contact area in one row; half length 0: no contact
   pure subroutine row_extent(grid, row, limit, middle, half_length)
      type(potential_contact), intent(in) :: grid
      !> Gap of the row, and the largest gap in contact [mm]
      real(wp), intent(in) :: row(:), limit
      real(wp), intent(out) :: middle, half_length
      real(wp) :: trailing, leading
      integer :: first, last

      middle = 0.0_wp
      half_length = 0.0_wp
      do first = 1, size(row)
         if (row(first) <= limit) exit
      end do
      if (first > size(row)) return
      do last = size(row), first, -1
         if (row(last) <= limit) exit
      end do
      trailing = grid%x(first) - grid%dx*overhang(row, first, -1, limit)
      leading = grid%x(last) + grid%dx*overhang(row, last, 1, limit)
      middle = 0.5_wp*(trailing + leading)
      half_length = 0.5_wp*(leading - trailing)
   end subroutine row_extent

   !> How far contact goes on beyond the centre of its last element, in elements
   pure real(wp) function overhang(row, ix, outwards, limit)
      real(wp), intent(in) :: row(:)
      !> Last element in contact, +1 or -1
      integer, intent(in) :: ix, outwards
      real(wp), intent(in) :: limit

      overhang = 0.5_wp
      if (.not. is_possible(row, ix + outwards)) return
      if (row(ix + outwards) > row(ix)) overhang = (limit - row(ix))/(row(ix + outwards) - row(ix))
      overhang = min(1.0_wp - min_overhang, max(min_overhang, overhang))
   end function overhang
end module contact_normal_kpec
