!> ANALYN: contact area and pressures from Hertz's solution in each row
!>
!> After Sichani, Enblom and Berg (2014), in the variant that takes the curvatures of each row from the
!> grid: the gap along a row and the one across the rows are quadratic near the smallest gap of the row;
!> Hertz's ellipse for these two curvatures says how deep the surfaces penetrate, how long contact is
!> and how high the pressure is in the row. Quadratic surfaces give Hertz's solution.
!> Equations: doc/theory/approximate_normal.md
module contact_normal_analyn
   use contact_base_choices, only : normal_control
   use contact_base_constants, only : excluded_threshold, pi
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_normal_hertz, only : hertz_by_curvatures, hertz_contact, hertz_load
   implicit none (type, external)
   private

   public :: analyn_pressure

   !> Smallest curvature that is told from the unevenness of profiles [1/mm], a radius of 5 m; as in CONTACT
   real(wp), parameter :: least_curvature = 1.0e-4_wp
   !> Overlap below which there is no contact [mm]; only to keep clear of underflow
   real(wp), parameter :: least_overlap = 1.0e-30_wp
   !> Samples on either side for the curvature along a row, at most; they end where the overlap has fallen
   !> to this part
   integer, parameter :: most_samples = 10
   real(wp), parameter :: fallen = 0.3_wp

contains

   !> Pressures [N/mm2]
   pure subroutine analyn_pressure(grid, gap, modulus, pn)
      type(potential_contact), intent(in) :: grid
      !> Distance of the undeformed surfaces less the approach [mm], shape (mx, my); negative where
      !> they overlap, above excluded_threshold where there is no contact possible
      real(wp), intent(in) :: gap(:, :)
      !> Contact modulus G/(1 - nu) of the combined material [N/mm2]
      real(wp), intent(in) :: modulus
      !> Shape (mx, my), positive in contact
      real(wp), intent(out) :: pn(:, :)
      type(hertz_contact) :: hertz
      real(wp) :: overlap, depth, a1, b1, half_length, highest
      real(wp) :: lowest(size(gap, 2)), place(size(gap, 2))
      integer :: column(size(gap, 2))
      integer :: ix, iy

      pn = 0.0_wp
      if (size(gap) == 0) return
      do iy = 1, grid%my
         column(iy) = minloc(gap(:, iy), dim=1)
         call lowest_point(grid, gap(:, iy), column(iy), place(iy), lowest(iy))
      end do
      overlap = -minval(lowest)
      if (.not. overlap > least_overlap) return
      do iy = 1, grid%my
         if (.not. lowest(iy) < 0.0_wp) cycle
         a1 = max(curvature_along(grid, gap(:, iy), column(iy)), least_curvature)
         b1 = max(curvature_across(grid, gap(column(iy), :), iy), least_curvature)
         hertz = hertz_by_curvatures(hertz_load(normal_control%approach, pen=overlap, modulus=modulus), a1, b1)
         depth = 1.0_wp - (lowest(iy) + overlap)/(b1*hertz%bb**2)
         if (.not. depth > 0.0_wp) cycle
         half_length = hertz%aa*sqrt(depth)
         highest = 1.5_wp*hertz%fn/(pi*hertz%aa*hertz%bb)*sqrt(depth)
         do ix = 1, grid%mx
            if (.not. gap(ix, iy) < excluded_threshold) cycle
            pn(ix, iy) = highest*sqrt(max(0.0_wp, 1.0_wp - ((grid%x(ix) - place(iy))/half_length)**2))
         end do
      end do
   end subroutine analyn_pressure

   !> Where along a row the gap is smallest: vertex of the parabola through three elements
   !>
   !> Differs from the original, which takes the centre of an element, because pressures would be off
   !> the middle on grids with as many elements on either side.
   pure subroutine lowest_point(grid, row, column, place, lowest)
      type(potential_contact), intent(in) :: grid
      !> Gap of the row [mm], and place of its smallest value
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
      ! half an element away at most, since the element in the middle has the smallest value
      if (.not. bend > abs(slope)) return
      place = place - grid%dx*slope/bend
      lowest = lowest - 0.5_wp*slope**2/bend
   end subroutine lowest_point

   !> Half the second derivative of the gap along a row [1/mm]: least squares around its smallest value
   pure real(wp) function curvature_along(grid, row, column) result(curvature)
      type(potential_contact), intent(in) :: grid
      !> Gap of the row [mm]
      real(wp), intent(in) :: row(:)
      !> Place of the smallest gap
      integer, intent(in) :: column
      real(wp) :: sum2, sum4, moment0, moment2, n
      integer :: k, i, middle

      curvature = 0.0_wp
      if (size(row) < 3) return
      middle = min(max(column, 2), size(row) - 1)
      if (any(row(middle - 1:middle + 1) > excluded_threshold)) return
      k = 1
      do while (k < most_samples)
         if (middle - k - 1 < 1 .or. middle + k + 1 > size(row)) exit
         if (max(row(middle - k - 1), row(middle + k + 1)) > fallen*row(column)) exit
         k = k + 1
      end do
      ! parabola through 2 k + 1 equidistant samples
      n = 2*k + 1
      sum2 = 0.0_wp
      sum4 = 0.0_wp
      moment0 = 0.0_wp
      moment2 = 0.0_wp
      do i = -k, k
         sum2 = sum2 + real(i, wp)**2
         sum4 = sum4 + real(i, wp)**4
         moment0 = moment0 + (row(middle + i) - row(middle))
         moment2 = moment2 + real(i, wp)**2*(row(middle + i) - row(middle))
      end do
      curvature = (n*moment2 - sum2*moment0)/(n*sum4 - sum2**2)/grid%dx**2
   end function curvature_along

   !> Half the second difference of the gap across the rows [1/mm], one-sided at the edges of the window
   pure real(wp) function curvature_across(grid, column, iy) result(curvature)
      type(potential_contact), intent(in) :: grid
      !> Gap of all rows at one x [mm]
      real(wp), intent(in) :: column(:)
      !> The row
      integer, intent(in) :: iy
      integer :: middle

      curvature = 0.0_wp
      if (size(column) < 3) return
      middle = min(max(iy, 2), size(column) - 1)
      if (any(column(middle - 1:middle + 1) > excluded_threshold)) return
      curvature = 0.5_wp*(column(middle - 1) - 2.0_wp*column(middle) + column(middle + 1))/grid%dy**2
   end function curvature_across
end module contact_normal_analyn
