!> The normal contact problem by active sets, for operators that are not symmetric
!>
!> Conjugate gradients need a symmetric operator. That of viscoelastic bodies is not symmetric: an element responds more to the
!> pressures ahead of it than to those behind, and NormCG stagnates for relaxation lengths of about the element size. Here the
!> pressures of a set of elements are the solution of linear equations, and the set is changed where the contact conditions p >=
!> 0, e >= 0 are violated: at all elements at once, or at one element at a time if this does not help. If the symmetric part is
!> positive definite the latter terminates (block principal pivoting, Judice and Pires 1994; one at a time after Murty 1974).
!> The linear equations are solved by generalised conjugate residuals (Eisenstat, Elman and Schultz 1983), which do not need
!> symmetry either.
module contact_normal_active_sets
   use contact_base_constants, only : excluded_threshold
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_compliance, only : compliance
   use contact_normal_problem, only : approach_scale, carries_nothing, normal_problem, pressure_displacement
   implicit none (type, external)
   private

   public :: solve_by_active_sets

   !> Maximum number of sets; number of sets without improvement before elements are changed one at a time
   integer, parameter :: max_sets = 500, patience = 6
   !> Maximum number of stored directions; fraction of the tolerance allowed for the linear equations
   integer, parameter :: kept = 40
   real(wp), parameter :: linear_part = 0.1_wp

   !> Fields of a solution, shape (mx, my)
   type :: fields
      !> Pressures [N/mm2], their displacements, and residual r = pen - h - u [mm]
      real(wp), allocatable :: p(:, :), u(:, :), r(:, :)
      !> Elements of the active set
      logical, allocatable :: active(:, :)
      !> Directions and their products with the operator, shape (mx, my, kept)
      real(wp), allocatable :: z(:, :, :), q(:, :, :)
   end type fields

contains

   !> Solve for the pressures and the approach or the force, starting from the result of another method that failed
   subroutine solve_by_active_sets(problem, operator, p, pen, report)
      !> Undeformed distance, prescribed force or approach, tolerance
      type(normal_problem), intent(in) :: problem
      !> Prepared for the window
      class(compliance), intent(inout) :: operator
      !> On entry an estimate, on exit pressures [N/mm2], shape (mx, my); the estimate on failure
      real(wp), contiguous, intent(inout) :: p(:, :)
      !> Approach [mm]: prescribed, or result
      real(wp), intent(inout) :: pen
      !> On entry the report of the method that failed
      type(solve_report), intent(inout) :: report
      type(fields) :: now
      type(solve_report) :: own
      real(wp) :: approach
      integer :: products_before

      products_before = operator%products
      allocate(now%p, source=p)
      allocate(now%u, now%r, mold=p)
      allocate(now%active(size(p, 1), size(p, 2)))
      allocate(now%z(size(p, 1), size(p, 2), kept), now%q(size(p, 1), size(p, 2), kept))
      now%active = p > 0.0_wp
      approach = pen
      call change_sets(problem, operator, now, approach, own)
      report%products = report%products + operator%products - products_before
      if (own%ended /= ending%converged) then
         if (own%ended == ending%out_of_time) report%ended = own%ended
         return
      end if
      p = now%p
      pen = approach
      report%gave_up = report%method
      report%method = "active sets"
      report%ended = own%ended
      report%iterations = own%iterations
      report%residual = own%residual
   end subroutine solve_by_active_sets

   !> Solve on a set, check the contact conditions, and change the set
   subroutine change_sets(problem, operator, now, pen, report)
      type(normal_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(fields), intent(inout) :: now
      real(wp), intent(inout) :: pen
      type(solve_report), intent(inout) :: report
      real(wp) :: worst, scale, largest
      integer :: set, wrong, fewest, waited
      logical, allocatable :: leaves(:, :), enters(:, :)

      fewest = huge(fewest)
      waited = 0
      report%ended = ending%iteration_limit
      do set = 1, max_sets
         if (.not. any(now%active)) exit
         if (problem%deadline%has_passed()) then
            report%ended = ending%out_of_time
            return
         end if
         call solve_linear(problem, operator, now, pen, report)
         largest = maxval(abs(now%p))
         if (.not. largest <= huge(largest)) exit
         ! the signs decide: tensile pressures, and surfaces that overlap outside the set
         leaves = now%active .and. now%p < 0.0_wp
         enters = .not. now%active .and. problem%h < excluded_threshold .and. now%r > 0.0_wp
         call measure_violation(problem, operator, now, pen, worst, scale)
         report%residual = worst/scale
         if (worst <= problem%eps*scale) then
            report%ended = ending%converged
            return
         end if
         wrong = count(leaves) + count(enters)
         if (wrong == 0) exit
         if (wrong < fewest) then
            fewest = wrong
            waited = 0
         else
            waited = waited + 1
         end if
         if (waited > patience) call last_one_only(leaves, enters)
         now%active = (now%active .and. .not. leaves) .or. enters
      end do
      report%ended = ending%stagnated
   end subroutine change_sets

   !> Pressures of the active set that close the gap on it, with the prescribed total force if there is one
   subroutine solve_linear(problem, operator, now, pen, report)
      type(normal_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(fields), intent(inout) :: now
      real(wp), intent(inout) :: pen
      type(solve_report), intent(inout) :: report
      real(wp) :: total, norm, alpha, tolerance
      integer :: step, k, n

      where (.not. now%active) now%p = 0.0_wp
      if (problem%force_prescribed) then
         total = sum(now%p)*problem%dx*problem%dy
         if (total > carries_nothing*problem%fn) then
            now%p = now%p*(problem%fn/total)
         else
            now%p = merge(problem%fn/(problem%dx*problem%dy*count(now%active)), 0.0_wp, now%active)
         end if
      end if
      call find_residual(problem, operator, now, pen)
      n = 0
      do step = 1, problem%maxgs
         tolerance = linear_part*problem%eps*approach_scale(pen, minval(problem%h), 0.0_wp)
         if (.not. maxval(abs(now%r), now%active) > tolerance) exit
         report%iterations = report%iterations + 1
         if (n == kept) then
            n = 0
            call find_residual(problem, operator, now, pen)
         end if
         n = n + 1
         associate (z => now%z(:, :, n), q => now%q(:, :, n))
            now%u = merge(now%r, 0.0_wp, now%active)
            call operator%normal_inverse(now%u, z)
            call restrict(problem, now%active, z)
            call pressure_displacement(problem, operator, z, q)
            call restrict(problem, now%active, q)
            do k = 1, n - 1
               alpha = sum(q*now%q(:, :, k))
               q = q - alpha*now%q(:, :, k)
               z = z - alpha*now%z(:, :, k)
            end do
            norm = sqrt(sum(q*q))
            if (.not. norm > 0.0_wp) exit
            q = q/norm
            z = z/norm
            alpha = sum(q*now%r, now%active)
            now%p = now%p + alpha*z
            where (now%active) now%r = now%r - alpha*q
         end associate
      end do
      ! also outside the set, where surfaces may overlap
      call find_residual(problem, operator, now, pen)
   end subroutine solve_linear

   !> Residual r = pen - h - u everywhere; for a prescribed force the approach makes its mean on the active set zero
   subroutine find_residual(problem, operator, now, pen)
      type(normal_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(fields), intent(inout) :: now
      real(wp), intent(inout) :: pen

      call pressure_displacement(problem, operator, now%p, now%u)
      if (problem%force_prescribed) pen = sum(problem%h + now%u, now%active)/max(1, count(now%active))
      now%r = pen - problem%h - now%u
   end subroutine find_residual

   !> Set a field to zero outside the active set, and to zero sum on it if the force is prescribed
   subroutine restrict(problem, active, field)
      type(normal_problem), intent(in) :: problem
      logical, contiguous, intent(in) :: active(:, :)
      real(wp), contiguous, intent(inout) :: field(:, :)
      real(wp) :: mean

      mean = 0.0_wp
      if (problem%force_prescribed) mean = sum(field, active)/max(1, count(active))
      field = merge(field - mean, 0.0_wp, active)
   end subroutine restrict

   !> Violation of the contact conditions by the pressures without tension
   subroutine measure_violation(problem, operator, now, pen, worst, scale)
      type(normal_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(fields), intent(inout) :: now
      real(wp), intent(inout) :: pen
      !> Largest violation [mm], and the scale for it
      real(wp), intent(out) :: worst, scale

      now%p = max(now%p, 0.0_wp)
      if (problem%force_prescribed) now%p = now%p*(problem%fn/(sum(now%p)*problem%dx*problem%dy))
      call pressure_displacement(problem, operator, now%p, now%u)
      if (problem%force_prescribed) pen = sum(problem%h + now%u, now%p > 0.0_wp)/max(1, count(now%p > 0.0_wp))
      now%r = pen - problem%h - now%u
      worst = maxval(merge(abs(now%r), max(0.0_wp, now%r), now%p > 0.0_wp))
      scale = approach_scale(pen, minval(problem%h), worst)
   end subroutine measure_violation

   !> Keep only the last of all elements to be changed
   subroutine last_one_only(leaves, enters)
      logical, contiguous, intent(inout) :: leaves(:, :), enters(:, :)
      integer :: ix, iy
      logical :: found

      found = .false.
      do iy = size(leaves, 2), 1, -1
         do ix = size(leaves, 1), 1, -1
            if (found) then
               leaves(ix, iy) = .false.
               enters(ix, iy) = .false.
            end if
            found = found .or. leaves(ix, iy) .or. enters(ix, iy)
         end do
      end do
   end subroutine last_one_only
end module contact_normal_active_sets
