!> One element on a spring with falling friction: both branches in closed form
!>
!> The element slips by S = W - A g in a step, with compliance A and traction g = mu(S/dt) pn. For
!> friction that falls linearly this is a linear equation on either side of the kink; where friction falls
!> faster than the spring, sticking and sliding are both solutions, and the start decides.
program test_falling_friction
   use contact_base_choices, only : motion, time_link
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec, friction_set, part_source
   use contact_test_case_builder, only : creep, grid_case, start_case, test_case
   use contact_test_harness, only : test_suite
   use contact_friction_new_law, only : friction_model
   implicit none (type, external)
   !> Step [mm] and velocity [mm/s]
   real(wp), parameter :: step = 0.1_wp, veloc = 1000.0_wp
   real(wp), parameter :: dt = step/veloc
   type(test_suite) :: suite
   real(wp) :: compliance, pressure

   call suite%start("falling friction of one element")
   call find_spring(suite)
   call gentle_slope(suite)
   call two_solutions(suite)
   call suite%finish()

contains

   !> One element, transient rolling
   type(case_spec) function element_case(wx) result(spec)
      !> Rigid slip in a step [mm]
      real(wp), intent(in) :: wx

      spec = grid_case(0.01_wp, 0.01_wp, 10.0_wp, 1, 1, 0.5_wp, 0.5_wp)
      call creep(spec, motion%transient_rolling, wx/step)
      spec%rolling%dq = step
      spec%rolling%veloc = veloc
      spec%iteration%maxin = 1000
   end function element_case

   !> Compliance and pressure from a case that sticks
   subroutine find_spring(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case

      call start_case(case, element_case(1.0e-6_wp))
      case%spec%friction%sets(1)%fstat = 10.0_wp
      call case%run(suite, "sticking")
      pressure = case%result%pn(1, 1)
      compliance = -1.0e-6_wp/case%result%px(1, 1)
      call suite%check(compliance > 0.0_wp, "the spring")
      call case%release()
   end subroutine find_spring

   !> mu falls from 0.4 to 0.2 over a range of slip velocities, given as a multiple of what the spring can follow
   pure type(friction_set) function falling(multiple) result(set)
      real(wp), intent(in) :: multiple

      set%fstat = 0.4_wp
      set%fkin = 0.2_wp
      set%coef1 = 0.2_wp
      ! the spring follows where A pn c/(2 s_h dt) < 1
      set%sabsh1 = 0.5_wp*multiple*compliance*pressure*set%coef1/dt
   end function falling

   !> s = (W - A pn mu_s)/(1 - A pn c/(2 s_h dt)) below the kink, W - A pn mu_k above it
   subroutine gentle_slope(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      real(wp) :: w, slip, factor
      integer :: k, start

      do start = -1, 1
         do k = 1, 9
            factor = 0.35_wp + 0.05_wp*k
            w = compliance*pressure*factor
            call start_case(case, element_case(w))
            case%spec%friction_law = friction_model%linear
            case%spec%friction%sets(1) = falling(2.0_wp)
            case%spec%friction%memdst = 0.0_wp
            case%spec%iteration%inislp = start
            case%spec%iteration%omgslp = 1.0_wp
            call case%run(suite, "gentle slope")
            slip = max(0.0_wp, (w - 0.4_wp*compliance*pressure)/(1.0_wp - 0.5_wp))
            if (slip > 2.0_wp*case%spec%friction%sets(1)%sabsh1*dt) slip = w - 0.2_wp*compliance*pressure
            call suite%close_to(case%result%sx(1, 1), slip, 2.0e-3_wp*w, "slip on a gentle slope, whatever the start")
            call suite%check(case%result%friction%succeeded(), "converged")
            call case%release()
         end do
      end do
   end subroutine gentle_slope

   !> Friction that falls twice as fast as the spring follows: sticking and sliding are solutions
   subroutine two_solutions(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      real(wp) :: w, slip
      integer :: start

      w = 0.35_wp*compliance*pressure
      slip = w - 0.2_wp*compliance*pressure
      do start = -1, 1
         call start_case(case, element_case(w))
         case%spec%friction_law = friction_model%linear
         case%spec%friction%sets(1) = falling(0.5_wp)
         call suite%check(slip > 2.0_wp*case%spec%friction%sets(1)%sabsh1*dt, "sliding is a solution")
         case%spec%friction%memdst = 0.0_wp
         case%spec%iteration%inislp = start
         call case%run(suite, "steep slope")
         if (start < 0) then
            call suite%close_to(case%result%sx(1, 1), slip, 1.0e-6_wp*w, "from above: sliding")
            call suite%close_to(case%result%mu(1, 1), 0.2_wp, 1.0e-12_wp, "from above: kinetic friction")
            call suite%equal(case%result%nslip, 1, "from above: a slip element")
         else
            call suite%close_to(case%result%px(1, 1), -0.35_wp*pressure, 1.0e-6_wp*pressure, "from below: sticking")
            call suite%close_to(case%result%mu(1, 1), 0.4_wp, 1.0e-12_wp, "from below: static friction")
            call suite%equal(case%result%nadh, 1, "from below: an adhesion element")
         end if
         ! the same step once more from the slip of the previous case: the branch is kept in a new step
         if (start /= 0) then
            case%spec%iteration%inislp = 0
            case%spec%link = time_link%continue_all
            case%spec%kinematics%cksi = merge(0.15_wp, 0.03_wp, start < 0)*compliance*pressure/step
            case%spec%parts%grid = part_source%kept
            case%spec%parts%geometry = part_source%kept
            call case%run(suite, "next step")
         end if
         call case%release()
      end do
   end subroutine two_solutions
end program test_falling_friction
