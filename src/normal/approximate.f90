!> Normal pressures by approximate methods instead of the full solution
!>
!> One procedure for the methods with prescribed approach; closed-form pressures for a prescribed force are in
!> contact_normal_estimate.
module contact_normal_approximate
   use contact_base_choices, only : pressure_model
   use contact_base_constants, only : excluded_threshold
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_compliance, only : compliance
   use contact_elastic_pressure_sums, only : pressure_sums
   use contact_grid_potential_contact, only : potential_contact
   use contact_normal_analyn, only : analyn_pressure
   use contact_normal_kpec, only : kpec_shape
   use contact_normal_parts, only : contact_parts
   implicit none (type, external)
   private

   public :: approximate_pressure

contains

   !> Pressures for a prescribed approach
   !>
   !> The report ends as "converged" after one pass, without iterations and with unknown residual, since these methods do not
   !> satisfy the contact conditions to any tolerance. If the surfaces overlap but no element has a pressure, it ends as
   !> "stagnated" with a warning.
   subroutine approximate_pressure(model, grid, gap, modulus, parts, operator, sums, pn, report, log)
      !> Member of pressure_model: kpec or analyn
      integer, intent(in) :: model
      !> Centres and sides of the elements
      type(potential_contact), intent(in) :: grid
      !> Gap including displacements by tangential tractions, minus the approach [mm], shape (mx, my); negative if the surfaces
      !> overlap; above excluded_threshold: contact is excluded
      real(wp), contiguous, intent(in) :: gap(:, :)
      !> Contact modulus G/(1 - nu) of the combined material [N/mm2]
      real(wp), intent(in) :: modulus
      !> Parts with reduced interaction; unallocated: none
      type(contact_parts), allocatable, intent(in) :: parts
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
      if (allocated(parts)) call separate_parts(model, grid, gap, modulus, parts, operator, sums, pn, report)
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
      real(wp), allocatable :: weight(:, :)
      real(wp) :: displacement

      allocate(weight, mold=pn)
      call kpec_shape(grid, gap, pn, weight)
      if (.not. any(pn > 0.0_wp)) return
      call displace_deepest(weight, pn, operator, sums, displacement, report)
      call scale(size(pn), deepest_overlap(weight, gap)/displacement, pn)
   end subroutine scaled_kpec

   !> Overlap of the elements that represent the deepest point [mm]
   pure real(wp) function deepest_overlap(weight, gap) result(overlap)
      !> Weights of the elements [-], and gaps [mm], of the same shape
      real(wp), contiguous, intent(in) :: weight(:, :), gap(:, :)
      integer :: ix, iy

      overlap = 0.0_wp
      do iy = 1, size(gap, 2)
         do ix = 1, size(gap, 1)
            if (weight(ix, iy) > 0.0_wp) overlap = overlap - weight(ix, iy)*gap(ix, iy)
         end do
      end do
   end function deepest_overlap

   !> Displacement of the elements that represent the deepest point [mm]
   subroutine displace_deepest(weight, pn, operator, sums, displacement, report)
      !> Weights of the elements [-], and pressures [N/mm2], of the shape of the window
      real(wp), contiguous, intent(in) :: weight(:, :), pn(:, :)
      class(compliance), allocatable, intent(inout) :: operator
      type(pressure_sums), allocatable, intent(inout) :: sums
      real(wp), intent(out) :: displacement
      type(solve_report), intent(inout) :: report
      real(wp), allocatable :: un(:, :)

      if (allocated(sums)) then
         ! displacements of the deepest elements only
         call sums%weighted(weight, pn, displacement)
         return
      end if
      allocate(un, mold=pn)
      call operator%normal(pn, un)
      displacement = sum(weight*un)
      report%products = report%products + 1
      report%fft_pairs = report%fft_pairs + 1.0_wp
   end subroutine displace_deepest

   !> Pressures of parts: those of the whole area where the interaction is full, those of separate areas where there is none
   !>
   !> Between them linear in the largest factor of a part with another one. Those of separate areas are scaled together, such that
   !> each part has its overlap at its deepest point; a part that the others lift off has none.
   subroutine separate_parts(model, grid, gap, modulus, parts, operator, sums, pn, report)
      integer, intent(in) :: model
      type(potential_contact), intent(in) :: grid
      real(wp), contiguous, intent(in) :: gap(:, :)
      real(wp), intent(in) :: modulus
      type(contact_parts), intent(in) :: parts
      class(compliance), allocatable, intent(inout) :: operator
      type(pressure_sums), allocatable, intent(inout) :: sums
      !> Pressures of the whole area on entry [N/mm2]
      real(wp), contiguous, intent(inout) :: pn(:, :)
      type(solve_report), intent(inout) :: report
      real(wp), allocatable :: own(:, :, :), weight(:, :, :), part_gap(:, :), matrix(:, :), overlap(:), factor(:)
      real(wp) :: share
      integer :: q, r, n

      n = size(parts%interaction, 2)
      allocate(own(grid%mx, grid%my, n), weight(grid%mx, grid%my, n))
      allocate(matrix(n, n), overlap(n), source=0.0_wp)
      allocate(factor(n), source=0.0_wp)
      do q = 1, n
         part_gap = merge(gap, 2.0_wp*excluded_threshold, parts%label == q)
         call kpec_shape(grid, part_gap, own(:, :, q), weight(:, :, q))
         overlap(q) = deepest_overlap(weight(:, :, q), part_gap)
         if (model == pressure_model%analyn) call analyn_pressure(grid, part_gap, modulus, own(:, :, q))
      end do
      do q = 1, n
         do r = 1, n
            if (.not. (min(overlap(q), overlap(r)) > 0.0_wp .and. parts%interaction(r, q) > 0.0_wp)) cycle
            if (r == q .and. model == pressure_model%analyn) then
               ! its pressures alone are those for this overlap
               matrix(q, q) = overlap(q)
            else
               call displace_deepest(weight(:, :, r), own(:, :, q), operator, sums, matrix(r, q), report)
               matrix(r, q) = parts%interaction(r, q)*matrix(r, q)
            end if
         end do
      end do
      call balance(matrix, overlap, factor)
      do q = 1, n
         share = 0.0_wp
         do r = 1, n
            if (r /= q) share = max(share, parts%interaction(r, q))
         end do
         where (parts%label == q) pn = share*pn + (1.0_wp - share)*factor(q)*own(:, :, q)
      end do
   end subroutine separate_parts

   !> Factors of the shapes of parts, at least 0, by projected Gauss-Seidel iteration: a part acts most on itself
   pure subroutine balance(matrix, overlap, factor)
      !> Displacements of each part by each shape [mm], those of a part without overlap are zero, and overlaps [mm]
      real(wp), intent(in) :: matrix(:, :), overlap(:)
      !> The factors [N/mm2]
      real(wp), intent(out) :: factor(:)
      !> Chosen; two parts need about ten passes
      integer, parameter :: passes = 1000
      real(wp) :: before, change
      integer :: i, q

      factor = 0.0_wp
      do i = 1, passes
         change = 0.0_wp
         do q = 1, size(factor)
            if (.not. matrix(q, q) > 0.0_wp) cycle
            before = factor(q)
            factor(q) = max(0.0_wp, before + (overlap(q) - dot_product(matrix(q, :), factor))/matrix(q, q))
            change = max(change, abs(factor(q) - before))
         end do
         if (change <= epsilon(change)*maxval(factor)) exit
      end do
   end subroutine balance

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
