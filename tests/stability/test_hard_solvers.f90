!> All named solvers on a smaller set of hard cases: they end with a solution, or report the residual that they reached
program test_hard_solvers
   use contact_base_choices, only : motion, solver_choice
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use hard_case, only : close_table, elliptic_case, expect_statement, given_case, hard_run, open_table, random_numbers
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite
   integer :: converged = 0, ended = 0

   call suite%start("hard cases for all solvers")
   call open_table("All solvers")
   call all_solvers()
   write(*, "(2(i0, a))") converged, " of ", ended, " cases converged, the others report it"
   call close_table()
   call suite%finish()

contains

   subroutine all_solvers()
      integer, parameter :: choices(4) = [solver_choice%default, solver_choice%convex_gs, solver_choice%gauss_seidel, &
         & solver_choice%gd_steady]
      character(len=9), parameter :: names(4) = ["default  ", "convex_gs", "gauss_s. ", "gd_steady"]
      type(hard_run) :: run
      type(case_spec) :: spec
      integer :: t, k, s
      character(len=64) :: label
      character(len=:), allocatable :: what

      do t = motion%shift, motion%steady_rolling
         do k = 1, 14
            do s = 1, size(choices)
               call hard_example(t, k, spec, what)
               spec%solver = choices(s)
               spec%classical = .true.
               spec%iteration%eps = 1.0e-5_wp
               write(label, "(2a, i0, 2a)") what, ", T=", t, ", ", names(s)
               ! sweeps end when the tractions no longer change, which does not bound the residual
               call expect_statement(suite, run, spec, trim(label), slack=merge(1.05_wp, 200.0_wp, s == 1))
               ended = ended + 1
               if (.not. allocated(run%error)) then
                  if (run%result%tangential%succeeded()) converged = converged + 1
               end if
            end do
         end do
      end do
      call run%release()
   end subroutine all_solvers

   subroutine hard_example(t, k, spec, what)
      integer, intent(in) :: t, k
      type(case_spec), intent(out) :: spec
      character(len=:), allocatable, intent(out) :: what
      integer :: seed

      spec = elliptic_case(t, 15, 15, 2.0_wp, 2.0_wp)
      spec%kinematics%cksi = merge(1.0e-3_wp, 5.0e-4_wp, t == motion%shift)
      spec%kinematics%cphi = 2.0e-4_wp
      select case (k)
      case (1)
         what = "moderate"
      case (2)
         what = "full sliding"
         spec%kinematics%cksi = 1.0_wp
      case (3)
         what = "full adhesion"
         spec%friction%sets(1)%fstat = 10.0_wp
      case (4)
         what = "zero creepage"
         spec%kinematics%cksi = 0.0_wp
         spec%kinematics%cphi = 0.0_wp
      case (5)
         what = "pure spin"
         spec%kinematics%cksi = 0.0_wp
         spec%kinematics%cphi = 0.1_wp
      case (6)
         what = "F=1 0.999"
         spec%force = 1
         spec%kinematics%fx = -0.999_wp
      case (7)
         what = "F=2 0.99 oblique"
         spec%force = 2
         spec%kinematics%fx = 0.7_wp
         spec%kinematics%fy = -0.7_wp
      case (8)
         what = "one element"
         spec = given_case(t, 1, 1)
         spec%kinematics%fn = 0.05_wp
         spec%kinematics%cksi = 1.0e-5_wp
      case (9)
         what = "one row"
         spec = given_case(t, 60, 1)
         spec%kinematics%cksi = 1.0e-3_wp
      case (10)
         what = "one column"
         spec = given_case(t, 1, 60)
         spec%kinematics%cksi = 1.0e-3_wp
      case (11)
         what = "mu 1e-6"
         spec%friction%sets(1)%fstat = 1.0e-6_wp
      case (12)
         what = "rough"
         spec = given_case(t, 15, 15)
         spec%geometry%form = 9
         allocate(spec%geometry%h(225))
         seed = 4711
         call random_numbers(seed, spec%geometry%h)
         spec%geometry%h = 1.0e-3_wp*spec%geometry%h
         spec%kinematics%cksi = 1.0e-3_wp
      case (13)
         what = "no contact"
         spec = given_case(t, 9, 9)
         spec%kinematics%fn = 0.0_wp
         spec%kinematics%cksi = 1.0e-3_wp
      case (14)
         what = "element ratio 10"
         spec = elliptic_case(t, 8, 60, 2.0_wp, 2.0_wp)
         spec%kinematics%cksi = 5.0e-4_wp
      end select
   end subroutine hard_example
end program test_hard_solvers
