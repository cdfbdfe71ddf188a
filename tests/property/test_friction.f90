!> Properties of friction laws and temperatures in whole cases
program test_friction
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_choices, only : motion, solver_choice, time_link
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : ending
   use contact_cases_spec, only : case_spec, friction_set
   use contact_friction_law, only : friction_law, friction_set
   use contact_friction_new_law, only : friction_model, new_friction_law
   use contact_grid_element_division, only : element
   use contact_test_case_builder, only : creep, forces, grid_case, start_case, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   integer, parameter :: laws(3) = [friction_model%linear, friction_model%rational, friction_model%exponential]
   type(test_suite) :: suite

   call suite%start("friction in whole cases")
   call no_strength(suite)
   call rows_of_one_kind(suite)
   call fixed_point(suite)
   call mirror_in_y(suite)
   call mirror_in_x(suite)
   call methods_agree(suite)
   call rows_act(suite)
   call steep_temperature(suite)
   call temperatures(suite)
   call slides_away(suite)
   call too_few_passes(suite)
   call refusals(suite)
   call suite%finish()

contains

   !> Rolling sphere, partly slipping
   type(case_spec) function rolling_case(kind) result(spec)
      !> Member of motion
      integer, intent(in) :: kind

      spec = grid_case(0.005_wp, 0.007_wp, 40.0_wp, 18, 15, 0.15_wp, 0.17_wp, eps=1.0e-8_wp)
      spec%material%gg = 8.0e2_wp
      call creep(spec, kind, 0.004_wp, 0.001_wp, 0.0008_wp, mu=0.3_wp)
      spec%rolling%veloc = 2.0e4_wp
      spec%iteration%maxin = 500
      spec%iteration%omgslp = 1.0_wp
   end function rolling_case

   !> Parameters of laws that decrease by a third over the slip velocities of these cases
   pure type(friction_set) function falling() result(set)
      set%fstat = 0.3_wp
      set%fkin = 0.2_wp
      set%coef1 = 0.07_wp
      set%coef2 = 0.03_wp
      set%sabsh1 = 60.0_wp
      set%sabsh2 = 200.0_wp
   end function falling

   !> A law of this number, without memory
   subroutine give_law(case, choice, set)
      type(test_case), intent(inout) :: case
      integer, intent(in) :: choice
      type(friction_set), intent(in) :: set

      case%spec%friction_law = choice
      case%spec%friction%sets(1) = set
      case%spec%friction%memdst = 0.0_wp
   end subroutine give_law

   !> Steel, with friction that changes with temperature
   subroutine give_heat(case)
      type(test_case), intent(inout) :: case
      case%spec%has_heat = .true.
      case%spec%heat%bktemp = [20.0_wp, 60.0_wp]
   end subroutine give_heat

   !> Laws with zero strength agree with Coulomb friction, in every motion and with forces
   subroutine no_strength(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: plain, case
      type(friction_set) :: set
      integer :: kind, n, k

      set%fstat = 0.3_wp
      set%fkin = 0.3_wp
      do kind = motion%shift, motion%steady_rolling
         do n = 0, 2
            call start_case(plain, rolling_case(kind))
            if (kind == motion%shift) plain%spec%kinematics%cphi = 1.0e-4_wp
            if (n == 1) call forces(plain%spec, -0.6_wp)
            if (n == 2) call forces(plain%spec, -0.5_wp, 0.3_wp)
            call plain%run(suite, "Coulomb")
            do k = 1, size(laws)
               call start_case(case, plain%spec)
               call give_law(case, laws(k), set)
               case%spec%friction%memdst = 0.01_wp*(k - 1)
               call case%run(suite, "no strength")
               call suite%close_to([case%result%px, case%result%py], [plain%result%px, plain%result%py], &
                  & 1.0e-6_wp*plain%result%pmax, "tractions as with Coulomb friction")
               call suite%close_to(case%result%fx, plain%result%fx, 1.0e-6_wp*plain%result%fn, "force as with Coulomb friction")
            end do
         end do
      end do
      set%dfheat = 0.0_wp
      call start_case(case, plain%spec)
      call give_law(case, friction_model%temperature, set)
      call give_heat(case)
      call case%run(suite, "no strength")
      call suite%close_to([case%result%px], [plain%result%px], 1.0e-6_wp*plain%result%pmax, "no change with temperature")
      call suite%check(.not. allocated(plain%result%friction), "Coulomb friction is not iterated")
      call suite%check(.not. allocated(plain%result%temp1), "no temperatures unless requested")
      call plain%release()
      call case%release()
   end subroutine no_strength

   !> Equal parameters in every row are one set
   subroutine rows_of_one_kind(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: one, many
      integer :: choice(5), k

      choice = [friction_model%coulomb, laws, friction_model%temperature]
      do k = 1, size(choice)
         call start_case(one, rolling_case(motion%steady_rolling))
         call give_law(one, choice(k), falling())
         one%spec%friction%memdst = 0.05_wp
         call give_heat(one)
         call one%run(suite, "one set")
         call start_case(many, one%spec)
         many%spec%friction%sets = spread(one%spec%friction%sets(1), 1, 15)
         call many%run(suite, "a set per row")
         call suite%close_to([many%result%px], [one%result%px], 1.0e-10_wp*one%result%pmax, "rows of one kind")
         call suite%close_to(many%result%mu_scal, 1.0_wp, 0.0_wp, "forces relative to FN")
         call suite%close_to(many%result%fx_rel, 0.3_wp*one%result%fx_rel, 1.0e-9_wp, "relative forces")
      end do
      call one%release()
      call many%release()
   end subroutine rows_of_one_kind

   !> On return the coefficients are those of the slip, and tractions in slip are on their bound
   subroutine fixed_point(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      class(friction_law), allocatable :: law
      type(error_type), allocatable :: error
      real(wp), allocatable :: mu(:, :), speed(:, :)
      integer :: kind, k, n

      do kind = motion%transient_rolling, motion%steady_rolling
         do n = 0, 2
            do k = 1, size(laws)
               call start_case(case, rolling_case(kind))
               call give_law(case, laws(k), falling())
               if (n == 1) call forces(case%spec, -0.55_wp)
               if (n == 2) call forces(case%spec, -0.4_wp, 0.2_wp)
               call case%run(suite, "falling friction")
               call suite%check(case%result%friction%succeeded(), "the friction iteration converges")
               associate (set => case%spec%friction%sets(1), r => case%result)
                  call new_friction_law(laws(k), [set], law, error)
                  speed = hypot(r%sx, r%sy)/r%dt
                  mu = r%mu
                  call law%coefficient(speed, mu)
                  call suite%close_to([r%mu], [mu], 2.0e-3_wp*0.1_wp, "coefficients belong to the slip")
                  call suite%check(r%nslip >= 4 .and. r%nadh >= 4, "slip and adhesion")
                  call suite%check(minval(r%mu) < 0.295_wp, "friction has fallen")
                  call suite%check(all(hypot(r%px, r%py) <= r%mu*r%pn + 1.0e-9_wp*r%pmax), "tractions inside the bound")
                  call suite%check(all(r%division /= element%slip .or. hypot(r%px, r%py) >= r%mu*r%pn - 1.0e-6_wp*r%pmax), &
                     & "slip is on the bound")
                  if (n >= 1) call suite%close_to(r%fx, -merge(0.55_wp, 0.4_wp, n == 1)*0.3_wp*r%fn, 1.0e-6_wp*r%fn, &
                     & "the prescribed force, relative to static friction")
               end associate
            end do
         end do
      end do
      call case%release()
   end subroutine fixed_point

   !> Reflection of rows, lateral creepage, spin and of the parameters
   subroutine mirror_in_y(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: one, two
      integer :: iy

      call start_case(one, rolling_case(motion%steady_rolling))
      call give_law(one, friction_model%rational, falling())
      one%spec%friction%sets = spread(one%spec%friction%sets(1), 1, 15)
      one%spec%friction%sets%coef1 = [(0.005_wp*iy, iy=1, 15)]
      one%spec%friction%sets%fstat = one%spec%friction%sets%fkin + one%spec%friction%sets%coef1 + 0.03_wp
      one%spec%friction%memdst = 0.02_wp
      call give_heat(one)
      call one%run(suite, "rows")
      call start_case(two, one%spec)
      two%spec%friction%sets = one%spec%friction%sets(15:1:-1)
      two%spec%kinematics%ceta = -one%spec%kinematics%ceta
      two%spec%kinematics%cphi = -one%spec%kinematics%cphi
      call two%run(suite, "rows, mirrored")
      associate (a => one%result, b => two%result)
         call suite%close_to([b%px(:, 15:1:-1)], [a%px], 1.0e-5_wp*a%pmax, "px is even")
         call suite%close_to([b%py(:, 15:1:-1)], [-a%py], 1.0e-5_wp*a%pmax, "py is odd")
         call suite%close_to([b%mu(:, 15:1:-1)], [a%mu], 1.0e-5_wp, "coefficients are even")
         call suite%close_to([b%temp1(:, 15:1:-1)], [a%temp1], 1.0e-3_wp*maxval(a%temp1), "temperatures are even")
      end associate
      call one%release()
      call two%release()
   end subroutine mirror_in_y

   !> Rolling the other way, with all of it: memory, temperature
   subroutine mirror_in_x(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: one, two
      integer :: k

      do k = 1, 2
         call start_case(one, rolling_case(motion%steady_rolling))
         call give_law(one, merge(friction_model%exponential, friction_model%temperature, k == 1), falling())
         one%spec%friction%sets%tref = 30.0_wp
         one%spec%friction%sets%dtheat = 20.0_wp
         one%spec%friction%memdst = 0.03_wp
         call give_heat(one)
         call one%run(suite, "forward")
         call start_case(two, one%spec)
         two%spec%rolling%chi = pi
         two%spec%kinematics%cksi = -one%spec%kinematics%cksi
         two%spec%kinematics%cphi = -one%spec%kinematics%cphi
         call two%run(suite, "backward")
         associate (a => one%result, b => two%result)
            call suite%close_to([b%px(18:1:-1, :)], [-a%px], 1.0e-5_wp*a%pmax, "px is odd")
            call suite%close_to([b%py(18:1:-1, :)], [a%py], 1.0e-5_wp*a%pmax, "py is even")
            call suite%close_to([b%mu(18:1:-1, :)], [a%mu], 1.0e-5_wp, "coefficients")
            call suite%close_to([b%temp2(18:1:-1, :)], [a%temp2], 1.0e-3_wp*maxval(a%temp2), "temperatures")
         end associate
      end do
      call one%release()
      call two%release()
   end subroutine mirror_in_x

   !> Newton-Krylov and the classical methods find the same, in every motion
   subroutine methods_agree(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: one, two
      integer :: kind, method

      do kind = motion%shift, motion%steady_rolling
         call start_case(one, rolling_case(kind))
         call give_law(one, friction_model%rational, falling())
         if (kind == motion%shift) then
            one%spec%friction%sets%sabsh1 = 0.004_wp
            one%spec%friction%sets%sabsh2 = 0.004_wp
            one%spec%kinematics%cphi = 1.0e-4_wp
         end if
         call one%run(suite, "Newton-Krylov")
         do method = solver_choice%convex_gs, solver_choice%gauss_seidel
            call start_case(two, one%spec)
            two%spec%solver = method
            two%spec%classical = .true.
            two%spec%iteration%omegah = 0.7_wp
            two%spec%iteration%omegas = 0.7_wp
            call two%run(suite, "Gauss-Seidel or conjugate gradients")
            call suite%close_to([two%result%px], [one%result%px], 2.0e-5_wp*one%result%pmax, "methods agree")
         end do
      end do
      call one%release()
      call two%release()
   end subroutine methods_agree

   !> Friction per row is seen in its rows
   subroutine rows_act(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      integer :: iy

      call start_case(case, rolling_case(motion%steady_rolling))
      case%spec%kinematics%cksi = 0.2_wp
      case%spec%kinematics%cphi = 0.0_wp
      case%spec%friction%sets = spread(case%spec%friction%sets(1), 1, 15)
      case%spec%friction%sets%fstat = [(0.1_wp + 0.02_wp*iy, iy=1, 15)]
      call case%run(suite, "sliding")
      associate (r => case%result)
         call suite%equal(r%nslip, r%ncon, "everything slides")
         call suite%close_to(hypot(r%px(9, :), r%py(9, :)), (0.1_wp + 0.02_wp*[(iy, iy=1, 15)])*r%pn(9, :), &
            & 1.0e-7_wp*r%pmax, "traction of each row")
      end associate
      call case%release()
   end subroutine rows_act

   !> Friction that drops with temperature as fast as one likes needs a few passes
   subroutine steep_temperature(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      type(friction_set) :: set
      integer :: k

      set%fref = 0.3_wp
      set%fstat = 0.3_wp
      set%fkin = 0.12_wp
      set%tref = 25.0_wp
      do k = 0, 2
         set%dtheat = 30.0_wp/10**k
         call start_case(case, rolling_case(motion%steady_rolling))
         case%spec%kinematics%cksi = 0.05_wp
         call give_law(case, friction_model%temperature, set)
         call give_heat(case)
         case%spec%heat%bktemp = 20.0_wp
         case%spec%heat%lambda = 1.0e-4_wp
         call case%run(suite, "steep law")
         associate (r => case%result)
            call suite%check(r%friction%succeeded(), "converged")
            call suite%check(r%friction%passes <= 8, "in a few passes")
            call suite%check(maxval(r%temp1) > 27.0_wp, "it gets warm")
            call suite%close_to([r%mu], [0.3_wp - 0.18_wp*min(1.0_wp, max(0.0_wp, (r%temp1 - 25.0_wp)/set%dtheat))], &
               & merge(1.0e-3_wp, 2.0e-2_wp, k < 2), "coefficients belong to the temperatures")
         end associate
      end do
      call case%release()
   end subroutine steep_temperature

   !> Bulk temperatures without motion, interface temperature without slip, more of both by friction
   subroutine temperatures(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      real(wp) :: cold

      call start_case(case, rolling_case(motion%none))
      call give_heat(case)
      call case%run(suite, "no motion")
      call suite%close_to([case%result%temp1], spread(20.0_wp, 1, 270), 0.0_wp, "bulk temperature 1")
      call suite%close_to([case%result%temp2], spread(60.0_wp, 1, 270), 0.0_wp, "bulk temperature 2")
      call start_case(case, rolling_case(motion%steady_rolling))
      call give_heat(case)
      case%spec%kinematics%cksi = 0.0_wp
      case%spec%kinematics%ceta = 0.0_wp
      case%spec%kinematics%cphi = 0.0_wp
      call case%run(suite, "no slip")
      call suite%close_to(case%result%temp1(9, 8), 40.0_wp, 1.0e-9_wp, "interface temperature")
      case%spec%kinematics%cksi = 0.05_wp
      call case%run(suite, "sliding")
      cold = case%result%temp1(9, 8)
      call suite%check(cold > 41.0_wp, "friction heats")
      case%spec%rolling%veloc = 4.0_wp*case%spec%rolling%veloc
      call case%run(suite, "sliding four times as fast")
      call suite%close_to(case%result%temp1(9, 8) - 40.0_wp, 2.0_wp*(cold - 40.0_wp), 1.0e-6_wp*cold, &
         & "heat by friction grows with the root of the velocity")
      call case%release()
   end subroutine temperatures

   !> No friction at all, no contact, full sliding
   subroutine slides_away(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      type(friction_set) :: set
      integer :: k

      set%fstat = 0.0_wp
      set%fkin = 0.0_wp
      do k = 1, size(laws)
         call start_case(case, rolling_case(motion%steady_rolling))
         call give_law(case, laws(k), set)
         call give_heat(case)
         call case%run(suite, "no friction")
         call suite%check(all(abs(case%result%px) <= 0.0_wp), "no traction")
         call start_case(case, rolling_case(motion%transient_rolling))
         call give_law(case, laws(k), falling())
         case%spec%kinematics%cksi = 10.0_wp
         case%spec%iteration%inislp = -1
         call case%run(suite, "full sliding")
         call suite%equal(case%result%nslip, case%result%ncon, "all elements slip")
         call suite%check(maxval(case%result%mu, case%result%ncon > 0 .and. case%result%pn > 0.0_wp) < 0.21_wp, &
            & "kinetic friction")
         case%spec%normal = 0
         case%spec%kinematics%pen = -0.1_wp
         case%spec%link = time_link%continue_all
         call case%run(suite, "no contact")
         call suite%equal(case%result%ncon, 0, "no contact")
      end do
      call case%release()
   end subroutine slides_away

   !> An iteration that reaches its limit reports it and returns finite results
   subroutine too_few_passes(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      type(error_type), allocatable :: error

      call start_case(case, rolling_case(motion%steady_rolling))
      call give_law(case, friction_model%exponential, falling())
      case%spec%iteration%maxin = 12
      case%spec%friction%sets%sabsh1 = 5.0_wp
      call case%try(error)
      call suite%check(.not. allocated(error), "no error")
      call suite%equal(case%result%friction%ended, ending%iteration_limit, "the limit is reported")
      call suite%equal(case%result%tangential%passes, 2, "two passes are MAXIN - 10")
      call suite%check(all(ieee_is_finite(case%result%px)), "finite results")
      call case%release()
   end subroutine too_few_passes

   subroutine refusals(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case

      call start_case(case, rolling_case(motion%steady_rolling))
      call give_law(case, friction_model%temperature, falling())
      call refused(suite, case, "friction by temperature without temperatures")
      call start_case(case, rolling_case(motion%transient_rolling))
      call give_heat(case)
      call refused(suite, case, "temperatures in transient rolling")
      call start_case(case, rolling_case(motion%steady_rolling))
      case%spec%friction%sets = spread(falling(), 1, 14)
      call refused(suite, case, "14 sets for 15 rows")
      call start_case(case, rolling_case(motion%steady_rolling))
      call give_heat(case)
      case%spec%heat%lambda(2) = 0.0_wp
      call refused(suite, case, "a conductivity of zero")
      call case%release()
   end subroutine refusals

   subroutine refused(suite, case, what)
      type(test_suite), intent(inout) :: suite
      type(test_case), intent(inout) :: case
      character(len=*), intent(in) :: what
      type(error_type), allocatable :: error

      call case%try(error)
      call suite%check(allocated(error), what // " is refused")
   end subroutine refused
end program test_friction
