!> KPEC: contact area and shape of the pressures from the interpenetration of the surfaces
!>
!> Kik and Piotrowski (1996) let the surfaces overlap by a fixed fraction of the approach and use the overlap as contact area.
!> Here the fraction varies from row to row as for an ellipse (Vollebregt, guide of CONTACT), so that Hertz's area is obtained
!> for quadratic surfaces. Pressures are semi-ellipses along each row, all with the same ratio of height to length.
!> Equations: doc/theory/approximate_normal.md
module contact_normal_kpec
   use contact_base_choices, only : normal_control
   use contact_base_constants, only : excluded_threshold
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_normal_hertz, only : hertz_by_curvatures, hertz_contact, hertz_load
   use contact_numeric_vectors, only : smallest_of
   implicit none (type, external)
   private

   public :: kpec_shape

   !> Smaller overlaps are not regarded as contact [mm]; only prevents underflow
   real(wp), parameter :: min_overlap = 1.0e-30_wp
   !> Level at which the extent of the overlap is measured, as a fraction of the approach [-]
   real(wp), parameter :: half_way = 0.5_wp
   !> Smallest effective curvature: it would open the gap by this fraction of the overlap along the grid [-]
   real(wp), parameter :: min_rise = 0.25_wp
   !> Elements whose gap exceeds the smallest one by less than this fraction of the overlap represent the deepest point, with
   !> weights that decrease to zero at the limit [-]. With a single element pressures would jump when another element becomes
   !> the deepest
   real(wp), parameter :: nearly_deepest = 0.01_wp
   !> Minimum distance between the ends of a row of contact and the outermost centres, in elements [-]; only keeps such an
   !> element in contact
   real(wp), parameter :: min_overhang = 1.0e-4_wp
   !> Minimum extent across the rows, in rows [-]
   real(wp), parameter :: min_extent = 0.02_wp

   !> Ellipse that gives the threshold of each row
   type :: threshold_ellipse
      !> Centre of the overlap across the rows [mm]
      real(wp) :: ym = 0.0_wp
      !> Semi-axis across the rows [mm]
      real(wp) :: bb = 1.0_wp
      !> Heights at the ends of the semi-axes along x and y, as fractions of the approach [-]
      real(wp) :: level_x = half_way, level_y = half_way
   end type threshold_ellipse

   !> Minimum lateral extent of a contact area of one row, relative to the offset of the centre of the row; chosen
   real(wp), parameter :: beyond_row = 1.1_wp

contains

   !> Pressures up to a factor
   !>
   !> The caller, who knows the compliance, determines the factor such that the displacement at the deepest point equals the
   !> overlap.
   pure subroutine kpec_shape(grid, gap, shape_, weight)
      !> Centres and sides of the elements
      type(potential_contact), intent(in) :: grid
      !> Distance of the undeformed surfaces minus the approach [mm], shape (mx, my); negative if they overlap; above
      !> excluded_threshold: contact is excluded
      real(wp), contiguous, intent(in) :: gap(:, :)
      !> Pressures [-], shape (mx, my): positive in contact, at most 1; all zero without overlap
      real(wp), contiguous, intent(out) :: shape_(:, :)
      !> Weights of the elements that represent the deepest point [-], shape (mx, my); their sum is 1 if there is overlap
      real(wp), contiguous, intent(out) :: weight(:, :)
      type(threshold_ellipse) :: ellipse
      real(wp) :: overlap, longest, level, total
      real(wp) :: middle(size(gap, 2)), half_length(size(gap, 2)), limit(size(gap, 2)), lowest(size(gap, 2))
      integer :: extent(2, size(gap, 2)), deep(2), ix, iy

      shape_ = 0.0_wp
      weight = 0.0_wp
      if (size(gap) == 0) return
      do iy = 1, grid%my
         lowest(iy) = smallest_of(grid%mx, gap(:, iy))
      end do
      overlap = -minval(lowest)
      if (.not. overlap > min_overlap) return
      ! rows with weights
      deep = [grid%my + 1, 0]
      total = 0.0_wp
      do iy = 1, grid%my
         if (lowest(iy) + overlap > nearly_deepest*overlap) cycle
         deep = [min(deep(1), iy), iy]
         do ix = 1, grid%mx
            weight(ix, iy) = max(0.0_wp, 1.0_wp - (gap(ix, iy) + overlap)/(nearly_deepest*overlap))
            total = total + weight(ix, iy)
         end do
      end do
      weight(:, deep(1):deep(2)) = weight(:, deep(1):deep(2))/total
      ellipse = fit_ellipse(grid, gap, weight, deep, lowest, overlap)
      do iy = 1, grid%my
         limit(iy) = (row_level(ellipse, grid%y(iy)) - 1.0_wp)*overlap
         half_length(iy) = 0.0_wp
         if (lowest(iy) <= limit(iy)) call row_extent(grid, gap(:, iy), limit(iy), middle(iy), half_length(iy), extent(:, iy))
      end do
      longest = maxval(half_length)
      do iy = 1, grid%my
         if (half_length(iy) <= 0.0_wp) cycle
         level = half_length(iy)**2
         do ix = extent(1, iy), extent(2, iy)
            if (gap(ix, iy) > limit(iy)) cycle
            shape_(ix, iy) = sqrt(max(0.0_wp, level - (grid%x(ix) - middle(iy))**2))/longest
         end do
      end do
   end subroutine kpec_shape

   !> Gap opening at the edge of contact in a row, as a fraction of the approach [-]
   pure real(wp) function row_level(ellipse, y) result(level)
      type(threshold_ellipse), intent(in) :: ellipse
      !> Position of the row [mm]
      real(wp), intent(in) :: y

      level = ellipse%level_x + (ellipse%level_y - ellipse%level_x)*((y - ellipse%ym)/ellipse%bb)**2
      level = min(1.0_wp, max(0.0_wp, level))
   end function row_level

   !> Hertz's ellipse for the curvatures of the overlap
   pure function fit_ellipse(grid, gap, weight, deep, lowest, overlap) result(ellipse)
      type(potential_contact), intent(in) :: grid
      real(wp), contiguous, intent(in) :: gap(:, :)
      !> Weights of the elements that represent the deepest point [-], shape (mx, my)
      real(wp), contiguous, intent(in) :: weight(:, :)
      !> First and last row with weights
      integer, intent(in) :: deep(2)
      !> Smallest gap of each row [mm]
      real(wp), intent(in) :: lowest(:)
      !> Overlap at the deepest point [mm]
      real(wp), intent(in) :: overlap
      type(threshold_ellipse) :: ellipse
      type(hertz_contact) :: hertz
      real(wp) :: a1, b1, start, end_
      integer :: ix, iy
      logical :: one_row

      a1 = 0.0_wp
      do iy = deep(1), deep(2)
         do ix = 1, grid%mx
            if (weight(ix, iy) > 0.0_wp) a1 = a1 + weight(ix, iy)*curvature_along(grid, gap(:, iy), ix, overlap)
         end do
      end do
      call extent_across(grid, lowest, overlap, start, end_, one_row)
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
   !> Not negative, as the gap is smallest in the middle; min_rise makes it positive.
   pure real(wp) function curvature_along(grid, row, middle, overlap) result(curvature)
      type(potential_contact), intent(in) :: grid
      !> Gap of the row [mm]
      real(wp), intent(in) :: row(:)
      !> Column of the smallest gap
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
            ! the smallest gap is next to the border or an excluded element: assume symmetry
            low = row(merge(middle - k, middle + k, is_possible(row, middle - k)))
            high = low
         end if
         next_rise = (0.5_wp*(low + high) + overlap)/(k*grid%dx)**2
         if (max(low, high) > -half_way*overlap) then
            ! interpolated between the elements on either side of the level, so that it varies continuously
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

   !> Does the element exist, and is contact possible there?
   pure logical function is_possible(row, ix)
      real(wp), intent(in) :: row(:)
      integer, intent(in) :: ix

      is_possible = ix >= 1 .and. ix <= size(row)
      if (is_possible) is_possible = row(ix) < excluded_threshold
   end function is_possible

   !> Positions between which the surfaces overlap by more than half of the largest overlap
   pure subroutine extent_across(grid, lowest, overlap, start, end_, one_row)
      type(potential_contact), intent(in) :: grid
      !> Smallest gap of each row [mm]
      real(wp), intent(in) :: lowest(:)
      !> Overlap at the deepest point [mm]
      real(wp), intent(in) :: overlap
      !> Positions [mm], start < end_
      real(wp), intent(out) :: start, end_
      !> Does only one row have such an overlap?
      logical, intent(out) :: one_row
      real(wp) :: widen
      integer :: iy, first, last

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

   !> Distance from a row to the point where the smallest gaps of the rows reach a level, in rows: by linear interpolation to
   !> the next row outwards, or linear extrapolation at the border of the grid
   pure real(wp) function steps_to_level(lowest, row, outwards, level) result(steps)
      !> Smallest gap of each row [mm]
      real(wp), intent(in) :: lowest(:)
      !> Last row with a gap below the level; direction +1 or -1
      integer, intent(in) :: row, outwards
      !> Level [mm]
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

   !> Centre and half length of the contact area in one row; half length 0: no contact
   pure subroutine row_extent(grid, row, limit, middle, half_length, extent)
      type(potential_contact), intent(in) :: grid
      !> Gaps of the row, and the largest gap in contact [mm]
      real(wp), intent(in) :: row(:), limit
      real(wp), intent(out) :: middle, half_length
      !> First and last element in contact; not set if there is none
      integer, intent(inout) :: extent(2)
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
      extent = [first, last]
      trailing = grid%x(first) - grid%dx*overhang(row, first, -1, limit)
      leading = grid%x(last) + grid%dx*overhang(row, last, 1, limit)
      middle = 0.5_wp*(trailing + leading)
      half_length = 0.5_wp*(leading - trailing)
   end subroutine row_extent

   !> Distance by which contact extends beyond the centre of its last element, in elements
   pure real(wp) function overhang(row, ix, outwards, limit)
      real(wp), intent(in) :: row(:)
      !> Last element in contact, direction +1 or -1
      integer, intent(in) :: ix, outwards
      real(wp), intent(in) :: limit

      overhang = 0.5_wp
      if (.not. is_possible(row, ix + outwards)) return
      if (row(ix + outwards) > row(ix)) overhang = (limit - row(ix))/(row(ix + outwards) - row(ix))
      overhang = min(1.0_wp - min_overhang, max(min_overhang, overhang))
   end function overhang
end module contact_normal_kpec
