!> Normal pressures by approximate methods instead of the full solution
!>
!> One procedure for the methods with prescribed approach; closed-form pressures for a prescribed force are in
!> contact_normal_estimate.
module contact_normal_approximate
   use contact_base_choices, only : pressure_model
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_compliance, only : compliance
   use contact_elastic_pressure_sums, only : pressure_sums
   use contact_grid_potential_contact, only : potential_contact
   use contact_normal_analyn, only : analyn_pressure
   use contact_normal_kpec, only : kpec_shape
   implicit none (type, external)
   private

   public :: approximate_pressure

contains

   !> Pressures for a prescribed approach
   !>
   !> The report ends as "converged" after one pass, without iterations and with unknown residual, since these methods do not
   !> satisfy the contact conditions to any tolerance. If the surfaces overlap but no element has a pressure, it ends as
   !> "stagnated" with a warning.
   subroutine approximate_pressure(model, grid, gap, modulus, operator, sums, pn, report, log)
      !> Member of pressure_model: kpec or analyn
      integer, intent(in) :: model
      !> Centres and sides of the elements
      type(potential_contact), intent(in) :: grid
      !> Gap including displacements by tangential tractions, minus the approach [mm], shape (mx, my); negative if the surfaces
      !> overlap; above excluded_threshold: contact is excluded
      real(wp), contiguous, intent(in) :: gap(:, :)
      !> Contact modulus G/(1 - nu) of the combined material [N/mm2]
      real(wp), intent(in) :: modulus
      !> Prepared for the window if `sums` do not suit the bodies
      class(compliance), allocatable, intent(inout) :: operator
      !> Prepared for the window if they suit the bodies
      type(pressure_sums), allocatable, intent(inout) :: sums
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(inout) :: pn(:, :)
      !> Outcome; transforms are added to the present count
      type(solve_report), intent(inout) :: report
      !> Receives a warning if surfaces overlap without pressures
      type(log_type), intent(inout) :: log

      if (overlaps_at_edge(gap)) call log%warning("the surfaces overlap at the edge of the potential contact area; " &
         & // "the approximate normal method is less accurate there")
      select case (model)
      case (pressure_model%kpec)
         report%method = "KPEC"
         call scaled_kpec(grid, gap, operator, sums, pn, report)
      case (pressure_model%analyn)
         report%method = "ANALYN"
         call analyn_pressure(grid, gap, modulus, pn)
      end select
      report%iterations = 0
      report%ended = ending%converged
      if (any(pn > 0.0_wp) .or. .not. any(gap < 0.0_wp)) return
      ! an ellipse smaller than an element, or too flat for the method
      report%ended = ending%stagnated
      call log%warning("the surfaces overlap, and " // trim(report%method) // " finds no element in contact. " &
         & // "Use smaller elements, or the full solution")
   end subroutine approximate_pressure

   !> KPEC, scaled so that the displacement equals the largest overlap
   subroutine scaled_kpec(grid, gap, operator, sums, pn, report)
      type(potential_contact), intent(in) :: grid
      real(wp), contiguous, intent(in) :: gap(:, :)
      class(compliance), allocatable, intent(inout) :: operator
      type(pressure_sums), allocatable, intent(inout) :: sums
      real(wp), contiguous, intent(inout) :: pn(:, :)
      type(solve_report), intent(inout) :: report
      real(wp), allocatable :: un(:, :)
      real(wp), allocatable :: weight(:, :)
      real(wp) :: displacement, overlap
      integer :: ix, iy

      allocate(weight, mold=pn)
      call kpec_shape(grid, gap, pn, weight)
      if (.not. any(pn > 0.0_wp)) return
      if (allocated(sums)) then
         ! displacements of the deepest elements only
         call sums%weighted(weight, pn, displacement)
         overlap = 0.0_wp
         do iy = 1, grid%my
            do ix = 1, grid%mx
               if (weight(ix, iy) > 0.0_wp) overlap = overlap - weight(ix, iy)*gap(ix, iy)
            end do
         end do
         call scale(size(pn), overlap/displacement, pn)
         return
      end if
      allocate(un, mold=pn)
      call operator%normal(pn, un)
      pn = pn*(-sum(weight*gap)/sum(weight*un))
      report%products = report%products + 1
      report%fft_pairs = report%fft_pairs + 1.0_wp
   end subroutine scaled_kpec

   !> Multiply contiguous numbers by a factor
   pure subroutine scale(n, factor, values)
      integer, intent(in) :: n
      real(wp), intent(in) :: factor
      real(wp), intent(inout) :: values(n)

      values = factor*values
   end subroutine scale

   !> Do the surfaces overlap in an element at the border of the grid?
   pure logical function overlaps_at_edge(gap)
      real(wp), intent(in) :: gap(:, :)
      integer :: mx, my

      mx = size(gap, 1)
      my = size(gap, 2)
      overlaps_at_edge = .false.
      if (size(gap) == 0) return
      ! a grid of one row or column is a line contact, which has no border on that side
      if (my > 1) overlaps_at_edge = any(gap(:, [1, my]) < 0.0_wp)
      if (mx > 1) overlaps_at_edge = overlaps_at_edge .or. any(gap([1, mx], :) < 0.0_wp)
   end function overlaps_at_edge
end module contact_normal_approximate
