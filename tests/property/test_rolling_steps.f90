!> Steps and directions of rolling: longer than an element with the leading-edge correction, and any with ConvexGS
program test_rolling_steps
   use contact_base_choices, only : estimate_choice, motion, solver_choice, time_link
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec, part_source
   use contact_test_case_builder, only : creep, ellipse_case, forces, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> Elements along the window, and their side [mm]
   integer, parameter :: n = 21
   real(wp), parameter :: side = 6.6_wp/n
   type(test_suite) :: suite
   type(test_case) :: steady

   call suite%start("steps of rolling")
   steady%spec = rolling_case()
   call steady%run(suite, "steady rolling")
   call long_steps(0.0_wp)
   call long_steps(pi)
   call given_force(0.0_wp)
   call given_force(pi)
   call long_steady_steps(0.0_wp, 0.28_wp)
   call long_steady_steps(pi, 0.28_wp)
   call long_steady_steps(0.0_wp, 0.0_wp)
   call directions()
   call limits()
   call steady%release()
   call suite%finish()

contains

   !> Sphere with longitudinal creepage and some spin, partial slip
   function rolling_case() result(spec)
      type(case_spec) :: spec

      spec = ellipse_case(3.0_wp, 3.0_wp, 2000.0_wp, n, n, eps=1.0e-7_wp)
      call creep(spec, motion%steady_rolling, 2.0e-3_wp, 0.0_wp, 2.0e-4_wp, 0.3_wp)
      spec%rolling%dq = side
   end function rolling_case
   !> Transient rolling with constant creepages ends in the steady state, also when particles enter in the middle of a step
   subroutine long_steps(chi)
      !> Rolling direction [rad]; the other way round longitudinal creepage changes its sign
      real(wp), intent(in) :: chi
      type(test_case) :: case
      integer :: m, step
      character(len=40) :: what
      !> Relative errors with steps of one, two and three elements; without the correction fx is wrong by 4 and 8 %
      real(wp), parameter :: of_fx(3) = [1.0e-3_wp, 5.0e-3_wp, 1.0e-2_wp], of_mz(3) = [1.0e-3_wp, 0.06_wp, 0.12_wp]

      do m = 1, 3
         write(what, "(a, i0, a, f4.0)") "DQ = ", m, " DX, CHI = ", chi*180.0_wp/pi
         case%spec = steady%spec
         case%spec%motion = motion%transient_rolling
         case%spec%rolling%dq = m*side
         case%spec%rolling%chi = chi
         case%spec%kinematics%cksi = cos(chi)*steady%spec%kinematics%cksi
         do step = 1, 130/m
            case%spec%link = merge(time_link%initiate, time_link%continue_all, step == 1)
            case%spec%parts%grid = merge(part_source%given, part_source%kept, step == 1)
            case%spec%estimate = merge(estimate_choice%fresh, estimate_choice%previous, step == 1)
            call case%run(suite, trim(what))
         end do
         call suite%equal(case%log%warnings, 0, trim(what) // ": no warning")
         call suite%close_to(cos(chi)*case%result%fx, steady%result%fx, of_fx(m), trim(what) // ": Fx of steady rolling", &
            & relative=.true.)
         call suite%close_to(case%result%mz, steady%result%mz, of_mz(m), trim(what) // ": Mz of steady rolling", relative=.true.)
         call case%release()
      end do
   end subroutine long_steps

   !> Long steps with the force that steady rolling has, and with both forces, end at the creepages of steady rolling
   subroutine given_force(chi)
      !> Rolling direction [rad]
      real(wp), intent(in) :: chi
      type(test_case) :: case
      integer :: n_forces, step
      character(len=48) :: what
      !> Without the correction the creepage is wrong by 7 %
      real(wp), parameter :: error_of_creepage = 0.02_wp

      do n_forces = 1, 2
         write(what, "(a, i0, a, f4.0)") "DQ = 3 DX with ", n_forces, " forces, CHI = ", chi*180.0_wp/pi
         case%spec = steady%spec
         case%spec%motion = motion%transient_rolling
         case%spec%rolling%dq = 3.0_wp*side
         case%spec%rolling%chi = chi
         case%spec%kinematics%cphi = 0.0_wp
         if (n_forces == 1) then
            call forces(case%spec, cos(chi)*steady%result%fx_rel)
         else
            call forces(case%spec, cos(chi)*steady%result%fx_rel, 0.0_wp)
         end if
         do step = 1, 45
            case%spec%link = merge(time_link%initiate, time_link%continue_all, step == 1)
            case%spec%parts%grid = merge(part_source%given, part_source%kept, step == 1)
            case%spec%estimate = merge(estimate_choice%fresh, estimate_choice%previous, step == 1)
            call case%run(suite, trim(what))
         end do
         call suite%equal(case%log%warnings, 0, trim(what) // ": no warning")
         call suite%close_to(cos(chi)*case%result%cksi, steady%result%cksi, error_of_creepage, trim(what) // &
            & ": creepage of steady rolling", relative=.true.)
         call suite%close_to(case%result%ceta, 0.0_wp, 1.0e-6_wp, trim(what) // ": no lateral creepage")
         call case%release()
      end do
   end subroutine given_force

   !> Steady rolling with ConvexGS in long steps: the forces of steps of one element
   subroutine long_steady_steps(chi, poiss)
      !> Rolling direction [rad], Poisson ratio of the second body, 0.28 for equal bodies
      real(wp), intent(in) :: chi, poiss
      type(test_case) :: case
      real(wp) :: fx
      integer :: m
      character(len=48) :: what
      !> Steps of two, three and four elements; without the correction fx is wrong by 2.4, 4.8, and 7.3 %, of dissimilar bodies
      !> by 6, 12 and 18 %
      real(wp) :: of_fx

      of_fx = merge(5.0e-3_wp, 2.5e-2_wp, poiss > 0.0_wp)
      do m = 1, 4
         write(what, "(a, i0, a, f4.0, a, f5.2)") "ConvexGS, DQ = ", m, " DX, CHI = ", chi*180.0_wp/pi, ", POISS ", poiss
         case%spec = steady%spec
         case%spec%solver = merge(solver_choice%default, solver_choice%convex_gs, m == 1)
         case%spec%iteration%eps = 1.0e-6_wp
         case%spec%iteration%omegah = 0.5_wp
         case%spec%iteration%omegas = 0.5_wp
         case%spec%iteration%maxout = merge(1, 30, poiss > 0.0_wp)
         case%spec%material%poiss(2) = poiss
         case%spec%rolling%chi = chi
         case%spec%rolling%dq = m*side
         case%spec%kinematics%cksi = cos(chi)*steady%spec%kinematics%cksi
         case%spec%kinematics%cphi = 0.0_wp
         call case%run(suite, trim(what))
         call suite%equal(case%log%warnings, 0, trim(what) // ": no warning")
         if (m == 1) fx = case%result%fx
         call suite%close_to(case%result%fx, fx, of_fx, trim(what) // ": Fx of steps of one element", relative=.true.)
         call case%release()
      end do
   end subroutine long_steady_steps

   !> Steady rolling of a sphere in any direction: the same forces in directions along and across
   subroutine directions()
      type(test_case) :: case
      real(wp) :: chi, along, across
      integer :: k
      character(len=24) :: what

      do k = 0, 11
         chi = k*pi/6.0_wp
         write(what, "(a, i0)") "ConvexGS, CHI = ", 30*k
         case%spec = steady%spec
         case%spec%solver = solver_choice%convex_gs
         case%spec%iteration%eps = 1.0e-6_wp
         case%spec%iteration%omegah = 0.5_wp
         case%spec%iteration%omegas = 0.5_wp
         case%spec%rolling%chi = chi
         ! steps of one element, but once
         case%spec%rolling%dq = merge(0.5_wp, 1.0_wp, k == 0)*side
         case%spec%kinematics%cksi = steady%spec%kinematics%cksi*cos(chi)
         case%spec%kinematics%ceta = steady%spec%kinematics%cksi*sin(chi)
         call case%run(suite, trim(what))
         along = cos(chi)*case%result%fx + sin(chi)*case%result%fy
         across = cos(chi)*case%result%fy - sin(chi)*case%result%fx
         call suite%close_to(along, steady%result%fx, 1.0e-2_wp, trim(what) // ": force along", relative=.true.)
         call suite%close_to(across, steady%result%fy, 0.05_wp, trim(what) // ": force across", relative=.true.)
         if (mod(k, 3) == 0 .and. k > 0) call suite%close_to([along, across], [steady%result%fx, steady%result%fy], 1.0e-4_wp, &
            & trim(what) // ": grid and direction turned together", relative=.true.)
         call case%release()
      end do
   end subroutine directions

   !> Steps without a correction give a warning, impossible ones are refused
   subroutine limits()
      type(test_case) :: case
      type(error_type), allocatable :: error

      case%spec = steady%spec
      case%spec%rolling%chi = 0.5_wp
      call case%try(error)
      call suite%check(allocated(error), "steady rolling in an oblique direction is refused without ConvexGS")
      case%spec = steady%spec
      case%spec%motion = motion%transient_rolling
      case%spec%rolling%dq = 2.0_wp*side
      case%spec%rolling%chi = 0.5_wp
      call case%try(error)
      call suite%check(.not. allocated(error), "long steps in an oblique direction are solved")
      call suite%equal(case%log%warnings, 1, "long steps in an oblique direction: a warning")
      call case%release()
   end subroutine limits
end program test_rolling_steps
