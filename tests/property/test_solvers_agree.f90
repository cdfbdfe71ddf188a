!> Differential test: all tangential solvers on the same random problems
!>
!> A solver that reports that it did not converge is ignored for that problem; one
!> that claims success must agree with the Newton-Krylov solver.
program test_solvers_agree
   use contact_base_choices, only : motion, solver_choice
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_test_case_builder, only : creep, ellipse_case, forces, random_numbers, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)

   integer, parameter :: n_problems = 200
   !> Tolerance of the solvers: their last change (classical) or true residual (Newton-Krylov)
   real(wp), parameter :: eps = 1.0e-8_wp
   !> Agreement of forces (relative to mu Fn) and tractions (rms, relative to rms of the bound).
   !> ten times what 200 problems showed
   real(wp), parameter :: tol_force = 1.0e-7_wp, tol_traction = 5.0e-7_wp
   integer, parameter :: steady(*) = [solver_choice%default, solver_choice%gauss_seidel, solver_choice%convex_gs, &
      & solver_choice%gd_steady]
   integer, parameter :: kinds(*) = [motion%steady_rolling, motion%steady_rolling, motion%transient_rolling, motion%shift]
   type(test_suite) :: suite
   type(random_numbers) :: random
   integer :: k, refused(0:5), tried(0:5)
   !> Largest differences by method
   character(len=16) :: methods(8) = ""
   real(wp) :: worst(2, 8) = 0.0_wp
   integer :: agreed(8) = 0
   !> Problems in which the default method was used instead of a classical one, and those in which its residual was the larger one
   integer :: placed = 0, larger = 0

   call suite%start("solvers agree")
   write(*, "(a, i0)") "seed ", random%state
   refused = 0
   tried = 0
   do k = 1, n_problems
      call one_problem(suite, random, k)
   end do
   write(*, "(a, 6i4)") "tried  for choices G = 0...5:", tried
   write(*, "(a, 6i4)") "not converged, as reported:  ", refused
   do k = 1, count(agreed > 0)
      write(*, "(2a, i4, 2(a, es8.1))") methods(k), "ended", agreed(k), " problems; largest difference of forces", worst(1, k), &
         & ", of tractions", worst(2, k)
   end do
   call every_iteration(suite)
   write(*, "(2(a, i0))") "instead of classical methods: ", placed, ", with a larger residual: ", larger
   ! chosen; 43 of 500 with the fraction of the tolerance in contact_patch_tangential_step
   call suite%check(larger <= placed/5, "residuals as small as those of the classical methods")
   call suite%equal(count(agreed > 0), 4, "TangCG, ConvexGS, SteadyGS and GDsteady took part")
   call suite%equal(refused(solver_choice%default), 0, "Newton-Krylov, with its fall-back, always converges")
   call suite%finish()

contains

   !> A solver that is allowed n iterations makes all n of them before it stops
   subroutine every_iteration(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      type(error_type), allocatable :: error
      integer :: k, n

      case%spec = ellipse_case(1.0_wp, 1.0_wp, 5.0_wp, 15, 15, 1.2_wp, eps=1.0e-12_wp)
      call creep(case%spec, motion%steady_rolling, 0.003_wp, 0.001_wp, 0.0_wp, 0.3_wp)
      do k = 2, size(steady)
         case%spec%solver = steady(k)
         case%spec%classical = .true.
         do n = 1, 3
            case%spec%iteration%maxgs = n
            call case%try(error)
            call suite%check(.not. allocated(error), "few iterations are not an error")
            if (allocated(error)) cycle
            call suite%equal(case%result%tangential%iterations, n, "iterations of " // trim(case%result%tangential%method))
            call suite%check(.not. case%result%tangential%succeeded(), "the abandoned method is reported")
         end do
      end do
      call case%release()
   end subroutine every_iteration

   !> Keep the largest differences of a method
   subroutine remember(method, df, dp)
      character(len=*), intent(in) :: method
      real(wp), intent(in) :: df, dp
      integer :: i

      do i = 1, size(methods)
         if (agreed(i) == 0) methods(i) = method
         if (methods(i) /= method) cycle
         agreed(i) = agreed(i) + 1
         worst(:, i) = max(worst(:, i), [df, dp])
         return
      end do
   end subroutine remember

   !> Draw a problem, solve it with all solvers of its kind
   subroutine one_problem(suite, random, number)
      type(test_suite), intent(inout) :: suite
      type(random_numbers), intent(inout) :: random
      integer, intent(in) :: number
      type(test_case) :: case
      type(error_type), allocatable :: error
      real(wp), allocatable :: px(:, :), py(:, :)
      real(wp) :: aa, bb, nu, mu, fn, size_, angle, fx, fy, cksi, ceta, bound, df, dp, rough
      character(len=160) :: text
      character(len=:), allocatable :: name
      integer :: kind, n_forces, k, mx, my

      kind = kinds(mod(number, size(kinds)) + 1)
      n_forces = random%whole(0, 2)
      mx = random%whole(9, 25)
      my = random%whole(9, 25)
      aa = 1.0_wp
      bb = random%logarithmic(0.2_wp, 5.0_wp)
      nu = random%uniform(0.0_wp, 0.5_wp)
      mu = random%logarithmic(0.05_wp, 1.0_wp)
      fn = random%logarithmic(1.0_wp, 30.0_wp)*bb
      case%spec = ellipse_case(aa, bb, fn, mx, my, 1.2_wp, eps=eps)
      case%spec%material%poiss = nu
      case%spec%rolling%dq = 2.0_wp*1.2_wp*aa/mx
      ! creepages between nearly full adhesion and full sliding
      size_ = random%logarithmic(0.03_wp, 3.0_wp)*mu*fn/(200.0_wp*aa*bb)
      angle = random%uniform(0.0_wp, 6.283_wp)
      call creep(case%spec, kind, size_*cos(angle), size_*sin(angle), random%uniform(-1.0_wp, 1.0_wp)*size_/max(aa, bb), mu)
      size_ = random%uniform(0.05_wp, 0.95_wp)
      angle = random%uniform(0.0_wp, 6.283_wp)
      if (n_forces == 1) call forces(case%spec, size_*cos(angle))
      if (n_forces == 2) call forces(case%spec, size_*cos(angle), size_*sin(angle))
      write(text, "(a, i0, 3(a, i0), 5(a, es8.1))") "problem ", number, ": T=", kind, " F=", n_forces, " grid ", mx, &
         & " x", real(my, wp), " bb", bb, " nu", nu, " mu", mu, " force", size_
      name = trim(text)

      case%spec%solver = solver_choice%default
      tried(0) = tried(0) + 1
      call case%try(error)
      if (allocated(error)) then
         call suite%check(.false., name // ": " // full_text(error))
         call case%release()
         return
      end if
      if (.not. case%result%tangential%succeeded()) then
         refused(0) = refused(0) + 1
         call suite%check(.false., name // ": no solution to compare with")
         call case%release()
         return
      end if
      if (case%result%tangential%gave_up /= "") write(*, "(2a)") "FALL-BACK  ", name
      px = case%result%px
      py = case%result%py
      fx = case%result%grid%dx*case%result%grid%dy*sum(px)/(mu*fn)
      fy = case%result%grid%dx*case%result%grid%dy*sum(py)/(mu*fn)
      cksi = case%result%cksi
      ceta = case%result%ceta
      bound = mu*norm2(case%result%pn)
      rough = max(abs(cksi), abs(ceta), mu*fn/(200.0_wp*aa*bb)*0.1_wp)
      do k = 2, size(steady)
         if (kind /= motion%steady_rolling .and. steady(k) == solver_choice%gd_steady) cycle
         case%spec%solver = steady(k)
         case%spec%classical = .true.
         tried(steady(k)) = tried(steady(k)) + 1
         call case%try(error)
         if (allocated(error)) then
            call suite%check(.false., name // ": " // full_text(error))
            cycle
         end if
         associate (r => case%result)
            df = hypot(r%grid%dx*r%grid%dy*sum(r%px)/(mu*fn) - fx, r%grid%dx*r%grid%dy*sum(r%py)/(mu*fn) - fy)
            dp = sqrt(sum((r%px - px)**2) + sum((r%py - py)**2))/bound
            if (.not. r%tangential%succeeded()) then
               refused(steady(k)) = refused(steady(k)) + 1
               write(*, "(4a, i0, 4(a, es8.1))") "GAVE UP ", trim(r%tangential%method), " ", name, r%tangential%ended, &
                  & " forces differ", df, ", tractions", dp, " residual", r%tangential%residual
               cycle
            end if
            if (df > tol_force .or. dp > tol_traction) then
               write(*, "(4a, 4(a, es8.1))") "DIFFERS ", trim(r%tangential%method), " ", name, &
                  & " forces differ", df, ", tractions", dp, " residual", r%tangential%residual
               if (r%tangential%gave_up /= "") write(*, "(2a)") "   after fall-back from ", trim(r%tangential%gave_up)
            end if
            call remember(trim(r%tangential%method), df, dp)
            call suite%close_to(df, 0.0_wp, tol_force, name // ": forces by " // trim(r%tangential%method))
            call suite%close_to(dp, 0.0_wp, tol_traction, name // ": tractions by " // trim(r%tangential%method))
            call suite%close_to(r%cksi, cksi, 1.0e-3_wp*rough, name // ": ksi by " // trim(r%tangential%method))
            call suite%close_to(r%ceta, ceta, 1.0e-3_wp*rough, name // ": eta by " // trim(r%tangential%method))
         end associate
         call in_its_place(suite, case, name)
      end do
      call case%release()
   end subroutine one_problem

   !> If a classical method is requested the default one is used, to a residual that is as small
   subroutine in_its_place(suite, case, name)
      type(test_suite), intent(inout) :: suite
      !> Solved by the classical method
      type(test_case), intent(inout) :: case
      character(len=*), intent(in) :: name
      type(error_type), allocatable :: error
      character(len=len(case%result%tangential%method)) :: classical
      real(wp) :: residual

      classical = case%result%tangential%method
      if (case%result%tangential%gave_up /= "") classical = case%result%tangential%gave_up
      residual = case%result%tangential%residual
      case%spec%classical = .false.
      call case%try(error)
      case%spec%classical = .true.
      if (allocated(error)) then
         call suite%check(.false., name // ": " // full_text(error))
         return
      end if
      associate (report => case%result%tangential)
         call suite%check(report%succeeded() .and. report%residual <= eps, name // ": instead of " // trim(classical))
         if (report%gave_up == "") call suite%check(report%asked == classical, &
            & name // ": is reported instead of " // trim(classical))
         placed = placed + 1
         if (report%residual > residual) larger = larger + 1
      end associate
   end subroutine in_its_place
end program test_solvers_agree
