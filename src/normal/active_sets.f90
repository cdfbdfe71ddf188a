!> The normal contact problem by active sets, for operators that are not symmetric
!>
!> Conjugate gradients need a symmetric operator. That of viscoelastic bodies is not: an element feels the pressures ahead
!> of it more than those behind. Where relaxation lengths are about the size of an element NormCG stagnates. Here the
!> pressures of a set of elements are solved for as linear equations, and the set is changed by what
!> violates the contact conditions p >= 0, e >= 0: all of it at once, and one element at a time while that does not help. With
!> a positive definite symmetric part the latter ends (block principal pivoting, Judice and Pires 1994; one at a time
!> after Murty 1974). The linear equations are solved by generalised conjugate residuals (Eisenstat, Elman and
!> Schultz 1983), which need no symmetry either.
module contact_normal_active_sets
   use contact_base_constants, only : excluded_threshold
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_compliance, only : compliance
   use contact_normal_problem, only : approach_scale, carries_nothing, normal_problem, pressure_displacement
   implicit none (type, external)
   private

   public :: solve_by_active_sets

   !> Sets that are tried at most, sets without improvement before elements are changed one at a time
   integer, parameter :: max_sets = 500, patience = 6
   !> Directions that are kept, part of the tolerance that is left to the linear equations
   integer, parameter :: kept = 40
   real(wp), parameter :: linear_part = 0.1_wp

   !> Fields of a solution, shape (mx, my)
   type :: fields
      !> Pressures [N/mm2], their displacements and r = pen - h - u [mm]
      real(wp), allocatable :: p(:, :), u(:, :), r(:, :)
      !> Elements whose pressures are solved for
      logical, allocatable :: active(:, :)
      !> Directions and what the operator makes of them, shape (mx, my, kept)
      real(wp), allocatable :: z(:, :, :), q(:, :, :)
   end type fields

contains

   !> Pressures and approach or force, from those where another method gave up
   subroutine solve_by_active_sets(problem, operator, p, pen, report)
      !> Undeformed distance, prescribed force or approach, tolerance
      type(normal_problem), intent(in) :: problem
      !> Prepared for the window
      class(compliance), intent(inout) :: operator
      !> Estimate on entry, pressures on exit [N/mm2], shape (mx, my); the estimate if this fails
      real(wp), contiguous, intent(inout) :: p(:, :)
      !> Approach [mm]: prescribed, or an exit value
      real(wp), intent(inout) :: pen
      !> Of the method that gave up on entry
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

   !> Solve on a set, look at the contact conditions, change the set
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
         ! the signs decide: pressures that pull, and surfaces that overlap outside
         leaves = now%active .and. now%p < 0.0_wp
         enters = .not. now%active .and. problem%h < excluded_threshold .and. now%r > 0.0_wp
         call judge(problem, operator, now, pen, worst, scale)
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

   !> Pressures of the active set that close the gap there; of the right total when the force is prescribed
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
      ! also outside, where surfaces may overlap
      call find_residual(problem, operator, now, pen)
   end subroutine solve_linear

   !> r = pen - h - u everywhere; the approach of a prescribed force is the one with the mean 0 on the active set
   subroutine find_residual(problem, operator, now, pen)
      type(normal_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(fields), intent(inout) :: now
      real(wp), intent(inout) :: pen

      call pressure_displacement(problem, operator, now%p, now%u)
      if (problem%force_prescribed) pen = sum(problem%h + now%u, now%active)/max(1, count(now%active))
      now%r = pen - problem%h - now%u
   end subroutine find_residual

   !> Zero off the active set, and there of zero sum when the force is prescribed
   subroutine restrict(problem, active, field)
      type(normal_problem), intent(in) :: problem
      logical, contiguous, intent(in) :: active(:, :)
      real(wp), contiguous, intent(inout) :: field(:, :)
      real(wp) :: mean

      mean = 0.0_wp
      if (problem%force_prescribed) mean = sum(field, active)/max(1, count(active))
      field = merge(field - mean, 0.0_wp, active)
   end subroutine restrict

   !> The true violation of the contact conditions by pressures without tension
   subroutine judge(problem, operator, now, pen, worst, scale)
      type(normal_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(fields), intent(inout) :: now
      real(wp), intent(inout) :: pen
      !> Largest violation [mm], and what it is compared with
      real(wp), intent(out) :: worst, scale

      now%p = max(now%p, 0.0_wp)
      if (problem%force_prescribed) now%p = now%p*(problem%fn/(sum(now%p)*problem%dx*problem%dy))
      call pressure_displacement(problem, operator, now%p, now%u)
      if (problem%force_prescribed) pen = sum(problem%h + now%u, now%p > 0.0_wp)/max(1, count(now%p > 0.0_wp))
      now%r = pen - problem%h - now%u
      worst = maxval(merge(abs(now%r), max(0.0_wp, now%r), now%p > 0.0_wp))
      scale = approach_scale(pen, minval(problem%h), worst)
   end subroutine judge

   !> Of all elements that would change, the last one alone
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
