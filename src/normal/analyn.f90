!> ANALYN: contact area and pressures from Hertz's solution in each row
!>
!> After Sichani, Enblom and Berg (2014), in the variant that takes the curvatures of each row from the grid: the gaps along and
!> across a row are quadratic near the smallest gap of the row. Hertz's ellipse for these two curvatures gives the penetration,
!> the length of the contact and the maximum pressure of the row. For quadratic surfaces the result is Hertz's solution.
!> Equations: doc/theory/approximate_normal.md
module contact_normal_analyn
   use contact_base_choices, only : normal_control
   use contact_base_constants, only : excluded_threshold, pi
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_normal_hertz, only : hertz_by_curvatures, hertz_contact, hertz_load
   use contact_numeric_vectors, only : clear_numbers, smallest_of
   implicit none (type, external)
   private

   public :: analyn_pressure

   !> Smallest curvature that is distinguished from the unevenness of profiles [1/mm], a radius of 5 m, as in CONTACT; for
   !> flatter bodies this fraction of the largest curvature at the deepest point
   real(wp), parameter :: min_curvature = 1.0e-4_wp, min_share = 0.1_wp
   !> Gaps whose difference is smaller than this fraction of the overlap are regarded as equal [-]: round-off makes one of two
   !> mirrored elements the deeper one
   real(wp), parameter :: equally_small = 1.0e-9_wp
   !> Smaller overlaps are not regarded as contact [mm]; only prevents underflow
   real(wp), parameter :: min_overlap = 1.0e-30_wp
   !> Maximum number of samples on either side for the curvature along a row; sampling ends where the overlap has decreased to
   !> this fraction
   integer, parameter :: max_samples = 10
   real(wp), parameter :: fallen = 0.3_wp

   !> Point of a row with the smallest gap
   type :: low_place
      !> Position and gap [mm], half the second derivatives along and across the row [1/mm]
      real(wp) :: x = 0.0_wp, lowest = 0.0_wp, a1 = 0.0_wp, b1 = 0.0_wp
      !> First and last element with this gap; the last one is 0 if the row has several such groups
      integer :: first = 0, last = 0
   end type low_place

contains

   !> Pressures [N/mm2]
   pure subroutine analyn_pressure(grid, gap, modulus, pn)
      !> Centres and sides of the elements
      type(potential_contact), intent(in) :: grid
      !> Distance of the undeformed surfaces minus the approach [mm], shape (mx, my); negative if they overlap; above
      !> excluded_threshold: contact is excluded
      real(wp), contiguous, intent(in) :: gap(:, :)
      !> Contact modulus G/(1 - nu) of the combined material [N/mm2]
      real(wp), intent(in) :: modulus
      !> Shape (mx, my), positive in contact
      real(wp), contiguous, intent(inout) :: pn(:, :)
      type(hertz_contact) :: hertz
      type(low_place) :: here
      !> Smallest gap of each row and centres of the columns [mm]
      real(wp) :: low(grid%my), x(grid%mx)
      real(wp) :: overlap, tolerance, depth, half_length, highest, sharpest, least, ratio, curved, before
      !> The place of each row, if there is only one
      type(low_place) :: place(grid%my)
      integer :: ix, iy, first, last, from, to, groups

      call clear_numbers(size(pn), pn)
      if (size(gap) == 0) return
      do iy = 1, grid%my
         low(iy) = smallest_of(grid%mx, gap(:, iy))
      end do
      do ix = 1, grid%mx
         x(ix) = grid%x(ix)
      end do
      tolerance = equally_small*abs(minval(low))
      overlap = -huge(overlap)
      sharpest = 0.0_wp
      do iy = 1, grid%my
         last = 0
         groups = 0
         do
            call next_run(gap(:, iy), low(iy), tolerance, first, last)
            if (first == 0) exit
            here = lowest_place(grid, gap, iy, first, last)
            groups = groups + 1
            place(iy) = here
            place(iy)%first = first
            place(iy)%last = merge(last, 0, groups == 1)
            if (-here%lowest > overlap + tolerance) sharpest = 0.0_wp
            if (-here%lowest > overlap - tolerance) then
               call find_curvatures(grid, gap, iy, first, last, 0.0_wp, here)
               sharpest = max(sharpest, here%a1, here%b1)
            end if
            overlap = max(overlap, -here%lowest)
         end do
      end do
      if (.not. overlap > min_overlap) return
      least = min_curvature
      if (sharpest > 0.0_wp) least = min(least, min_share*sharpest)
      ratio = 0.0_wp
      do iy = 1, grid%my
         if (place(iy)%last > 0 .and. .not. place(iy)%lowest < 0.0_wp) cycle
         last = 0
         do
            if (place(iy)%last > 0) then
               if (last > 0) exit
               here = place(iy)
               first = here%first
               last = here%last
            else
               call next_run(gap(:, iy), low(iy), tolerance, first, last)
               if (first == 0) exit
               here = lowest_place(grid, gap, iy, first, last)
            end if
            if (.not. here%lowest < 0.0_wp) cycle
            call find_curvatures(grid, gap, iy, first, last, least, here)
            curved = min(here%a1, here%b1)/max(here%a1, here%b1)
            associate (load => hertz_load(normal_control%approach, pen=overlap, modulus=modulus))
               if (ratio > 0.0_wp) then
                  ! the ratio changes little from row to row
                  hertz = hertz_by_curvatures(load, here%a1, here%b1, near=min(1.0_wp, ratio*(curved/before)**(1.0_wp/hertz%slope)))
               else
                  hertz = hertz_by_curvatures(load, here%a1, here%b1)
               end if
            end associate
            ratio = min(hertz%aob, 1.0_wp/hertz%aob)
            before = curved
            depth = 1.0_wp - (here%lowest + overlap)/(here%b1*hertz%bb**2)
            if (.not. depth > 0.0_wp) cycle
            half_length = hertz%aa*sqrt(depth)
            highest = 1.5_wp*hertz%fn/(pi*hertz%aa*hertz%bb)*sqrt(depth)
            from = max(1, first - reach(grid, half_length))
            to = min(grid%mx, last + reach(grid, half_length))
            call add_ellipse(to - from + 1, x(from:to), gap(from:to, iy), here%x, half_length, highest, pn(from:to, iy))
         end do
      end do
   end subroutine analyn_pressure

   !> Pressures of one ellipse along a row, where they are larger than those that are known
   pure subroutine add_ellipse(n, x, gap, centre, half_length, highest, pn)
      !> Number of elements
      integer, intent(in) :: n
      !> Centres of the elements, and their gap [mm]
      real(wp), intent(in) :: x(n), gap(n)
      !> Centre and half length of the contact in this row [mm], and the maximum pressure [N/mm2]
      real(wp), intent(in) :: centre, half_length, highest
      !> Pressures [N/mm2]
      real(wp), intent(inout) :: pn(n)
      real(wp) :: here
      integer :: i

      do i = 1, n
         here = highest*sqrt(max(0.0_wp, 1.0_wp - ((x(i) - centre)/half_length)**2))
         pn(i) = merge(max(pn(i), here), pn(i), gap(i) < excluded_threshold)
      end do
   end subroutine add_ellipse

   !> Number of elements on either side of the smallest gap of a row within which there is pressure
   pure integer function reach(grid, half_length)
      type(potential_contact), intent(in) :: grid
      !> Half the length of the contact in this row [mm]
      real(wp), intent(in) :: half_length

      reach = grid%mx
      if (half_length < grid%mx*grid%dx) reach = int(half_length/grid%dx) + 2
   end function reach

   !> The next group of adjacent elements in a row whose gaps equal the smallest one
   !>
   !> A row that is symmetric about a side of an element has two such elements; there is more than one group if two summits of
   !> equal height are in contact.
   pure subroutine next_run(row, lowest, tolerance, first, last)
      !> Gaps of the row and the smallest one [mm], tolerance for equality
      real(wp), intent(in) :: row(:), lowest, tolerance
      !> First element of the group, 0 if there is none
      integer, intent(out) :: first
      !> On entry last element of the previous group, 0 initially; on exit of this one
      integer, intent(inout) :: last
      integer :: ix

      first = 0
      do ix = last + 1, size(row)
         if (row(ix) > lowest + tolerance) then
            if (first > 0) return
         else
            if (first == 0) first = ix
            last = ix
         end if
      end do
   end subroutine next_run

   !> Mean position and gap of a group
   pure type(low_place) function lowest_place(grid, gap, iy, first, last) result(mean)
      type(potential_contact), intent(in) :: grid
      real(wp), intent(in) :: gap(:, :)
      !> Row, first and last element of the group
      integer, intent(in) :: iy, first, last
      real(wp) :: x, lowest
      integer :: ix

      do ix = first, last
         call lowest_point(grid, gap(:, iy), ix, x, lowest)
         mean%x = mean%x + x
         mean%lowest = mean%lowest + lowest
      end do
      if (first == last) return
      mean%x = mean%x/(last - first + 1)
      mean%lowest = mean%lowest/(last - first + 1)
   end function lowest_place

   !> Mean curvatures of a group
   pure subroutine find_curvatures(grid, gap, iy, first, last, least, mean)
      type(potential_contact), intent(in) :: grid
      real(wp), intent(in) :: gap(:, :)
      !> Row, first and last element of the group
      integer, intent(in) :: iy, first, last
      !> Lower bound of the curvatures [1/mm]
      real(wp), intent(in) :: least
      !> Curvatures are set
      type(low_place), intent(inout) :: mean
      integer :: ix

      mean%a1 = 0.0_wp
      mean%b1 = 0.0_wp
      do ix = first, last
         mean%a1 = mean%a1 + max(curvature_along(grid, gap(:, iy), ix), least)
         mean%b1 = mean%b1 + max(curvature_across(grid, gap(ix, :), iy), least)
      end do
      if (first == last) return
      mean%a1 = mean%a1/(last - first + 1)
      mean%b1 = mean%b1/(last - first + 1)
   end subroutine find_curvatures

   !> Position of the smallest gap along a row: vertex of the parabola through three elements
   !>
   !> The original takes the centre of an element instead, which makes pressures asymmetric on grids with an even number of
   !> elements.
   pure subroutine lowest_point(grid, row, column, place, lowest)
      type(potential_contact), intent(in) :: grid
      !> Gaps of the row [mm], and column of the smallest one
      real(wp), intent(in) :: row(:)
      integer, intent(in) :: column
      !> Position and gap of the vertex [mm]
      real(wp), intent(out) :: place, lowest
      real(wp) :: slope, bend

      place = grid%x(column)
      lowest = row(column)
      if (column == 1 .or. column == size(row)) return
      if (any(row(column - 1:column + 1) > excluded_threshold)) return
      slope = 0.5_wp*(row(column + 1) - row(column - 1))
      bend = row(column + 1) - 2.0_wp*row(column) + row(column - 1)
      ! at most half an element away, since the middle element has the smallest value
      if (.not. bend > abs(slope)) return
      place = place - grid%dx*slope/bend
      lowest = lowest - 0.5_wp*slope**2/bend
   end subroutine lowest_point

   !> Half the second derivative of the gap along a row [1/mm], by least squares around its smallest value
   pure real(wp) function curvature_along(grid, row, column) result(curvature)
      type(potential_contact), intent(in) :: grid
      !> Gap of the row [mm]
      real(wp), intent(in) :: row(:)
      !> Column of the smallest gap
      integer, intent(in) :: column
      real(wp) :: sum2, sum4, moment0, moment2, n, rise
      integer :: k, middle

      curvature = 0.0_wp
      if (size(row) < 3) return
      middle = min(max(column, 2), size(row) - 1)
      if (any(row(middle - 1:middle + 1) > excluded_threshold)) return
      moment0 = 0.0_wp
      moment2 = 0.0_wp
      k = 0
      do
         k = k + 1
         rise = (row(middle - k) - row(middle)) + (row(middle + k) - row(middle))
         moment0 = moment0 + rise
         moment2 = moment2 + real(k*k, wp)*rise
         if (k == max_samples .or. middle - k - 1 < 1 .or. middle + k + 1 > size(row)) exit
         if (max(row(middle - k - 1), row(middle + k + 1)) > fallen*row(column)) exit
      end do
      ! parabola through 2 k + 1 equidistant samples
      n = 2*k + 1
      sum2 = real(k*(k + 1)*(2*k + 1)/3, wp)
      sum4 = real(k*(k + 1)*(2*k + 1)*(3*k*(k + 1) - 1)/15, wp)
      curvature = (n*moment2 - sum2*moment0)/(n*sum4 - sum2**2)/grid%dx**2
   end function curvature_along

   !> Half the second difference of the gap across the rows [1/mm], one-sided at the borders of the grid
   pure real(wp) function curvature_across(grid, column, iy) result(curvature)
      type(potential_contact), intent(in) :: grid
      !> Gap of all rows at one x [mm]
      real(wp), intent(in) :: column(:)
      !> Index of the row
      integer, intent(in) :: iy
      integer :: middle

      curvature = 0.0_wp
      if (size(column) < 3) return
      middle = min(max(iy, 2), size(column) - 1)
      if (any(column(middle - 1:middle + 1) > excluded_threshold)) return
      curvature = 0.5_wp*(column(middle - 1) - 2.0_wp*column(middle) + column(middle + 1))/grid%dy**2
   end function curvature_across
end module contact_normal_analyn
