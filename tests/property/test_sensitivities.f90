!> Sensitivities against central differences of solutions, and Mindlin's stiffness
program test_sensitivities
   use contact_base_choices, only : material_model, motion, normal_control, sensitivity_choice, solver_choice
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_test_case_builder, only : ellipse_case, creep, forces, grid_case, shift, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   character(len=9), parameter :: kind_name(3) = [character(len=9) :: "shift", "transient", "steady"]
   character(len=3), parameter :: input_name(4) = ["PEN", "KSI", "ETA", "PHI"]
   integer, parameter :: kinds(3) = [motion%shift, motion%transient_rolling, motion%steady_rolling]
   type(test_suite) :: suite
   integer :: k

   call suite%start("sensitivities")
   do k = 1, size(kinds)
      call differences(suite, k, 0.0_wp, solver_choice%default)
      call differences(suite, k, 0.25_wp, solver_choice%default)
   end do
   call differences(suite, 3, 0.0_wp, solver_choice%gauss_seidel)
   call differences(suite, 1, 0.25_wp, solver_choice%convex_gs)
   call differences(suite, 1, 0.0_wp, solver_choice%default, slope=0.0_wp)
   call differences(suite, 1, 0.0_wp, solver_choice%default, slope=40.0_wp)
   call differences(suite, 3, 0.0_wp, solver_choice%default, slope=0.0_wp)
   call differences(suite, 3, 0.0_wp, solver_choice%default, slope=40.0_wp)
   call differences(suite, 3, 0.0_wp, solver_choice%default, slope=2000.0_wp)
   call frictionless(suite)
   call mindlin(suite)
   call levels(suite)
   call suite%finish()

contains

   !> Two bodies that roll or shift with partial slip, spin included
   subroutine set_case(kind, softness, solver, case)
      !> Place in kinds
      integer, intent(in) :: kind
      !> Poisson ratio of body 1 less that of body 2 [-]: coupling of normal and tangential problem
      real(wp), intent(in) :: softness
      !> Member of solver_choice
      integer, intent(in) :: solver
      type(test_case), intent(inout) :: case

      case%spec = grid_case(0.010_wp, 0.016_wp, 1.0_wp, 27, 23, 0.11_wp, 0.11_wp, eps=1.0e-10_wp)
      case%spec%normal = normal_control%approach
      case%spec%kinematics%pen = 0.02_wp
      case%spec%material%poiss = 0.25_wp + [0.5_wp, -0.5_wp]*softness
      call creep(case%spec, kinds(kind), 1.1e-3_wp, 0.5e-3_wp, 3.0e-4_wp, mu=0.3_wp)
      if (kinds(kind) == motion%transient_rolling) call creep(case%spec, kinds(kind), 1.1e-2_wp, 0.5e-2_wp)
      if (kinds(kind) == motion%shift) call shift(case%spec, 1.6e-3_wp, 0.7e-3_wp)
      case%spec%solver = solver
      case%spec%classical = .true.
      case%spec%iteration%sensitivity = sensitivity_choice%all
      case%spec%iteration%epsens = 1.0e-9_wp
      case%spec%iteration%mxsens = 200
   end subroutine set_case

   !> Derivatives are those of the solutions of the program itself
   subroutine differences(suite, kind, softness, solver, slope)
      type(test_suite), intent(inout) :: suite
      integer, intent(in) :: kind, solver
      real(wp), intent(in) :: softness
      !> Slope of the yield limit [N/mm3]; absent: no yielding
      real(wp), intent(in), optional :: slope
      type(test_case) :: case
      real(wp) :: table(4, 4), numerical(4, 2), steps(4), scale(4)
      character(len=:), allocatable :: what
      integer :: input, side

      what = trim(kind_name(kind))
      if (softness > 0.0_wp) what = what // ", dissimilar"
      call set_case(kind, softness, solver, case)
      if (present(slope)) call let_yield(case%spec, slope)
      if (present(slope)) what = what // merge(", yielding   ", ", hardening  ", slope <= 0.0_wp)
      call case%run(suite, what)
      if (present(slope)) call suite%check(case%result%nplast > 20, what // ": plastic elements")
      table = case%result%sensitivity
      call suite%check(case%result%nadh > 20 .and. case%result%nslip > 10, what // ": partial slip")
      scale = abs([case%result%fn, 1.0_wp, 1.0_wp, case%result%mu_scal*case%result%fn])
      steps = 1.0e-6_wp*[0.02_wp, 1.0e-3_wp, 1.0e-3_wp, 1.0e-3_wp]
      do input = 1, 4
         do side = 1, 2
            call set_case(kind, softness, solver, case)
            if (present(slope)) call let_yield(case%spec, slope)
            call move(case%spec, input, merge(-1.0_wp, 1.0_wp, side == 1)*steps(input))
            call case%run(suite, what)
            numerical(:, side) = [case%result%fn, case%result%fx_rel, case%result%fy_rel, case%result%mz]
         end do
         numerical(:, 1) = (numerical(:, 2) - numerical(:, 1))/(2.0_wp*steps(input))
         write(*, "(3a, 4es12.4, a, 4es12.4)") what, ", ", input_name(input), table(:, input), "   differences", numerical(:, 1)
         call suite%close_to(table(:, input)/scale, numerical(:, 1)/scale, 1.0e-4_wp*maxval(abs(numerical(:, 1)/scale)), &
            & what // ", column " // input_name(input))
      end do
      call case%release()
   end subroutine differences

   !> A thin layer between the bodies that yields
   subroutine let_yield(spec, slope)
      type(case_spec), intent(inout) :: spec
      real(wp), intent(in) :: slope

      spec%material_model = material_model%interfacial_layer
      spec%material%gg3 = 1.0_wp
      spec%material%laythk = 0.0_wp
      spec%material%tau_c0 = 0.4_wp
      spec%material%k_tau = slope
   end subroutine let_yield

   !> Change one input
   subroutine move(spec, input, step)
      type(case_spec), intent(inout) :: spec
      integer, intent(in) :: input
      real(wp), intent(in) :: step

      select case (input)
      case (1); spec%kinematics%pen = spec%kinematics%pen + step
      case (2); spec%kinematics%cksi = spec%kinematics%cksi + step
      case (3); spec%kinematics%ceta = spec%kinematics%ceta + step
      case (4); spec%kinematics%cphi = spec%kinematics%cphi + step
      end select
   end subroutine move

   !> Hertz: dFn/dpen = 3 Fn/(2 pen); the same for prescribed force
   subroutine frictionless(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case

      case%spec = ellipse_case(2.0_wp, 1.0_wp, 30.0_wp, 61, 61)
      case%spec%iteration%sensitivity = sensitivity_choice%normal
      call case%run(suite, "ellipse")
      call suite%close_to(case%result%sensitivity(1, 1), 1.5_wp*case%result%fn/case%result%pen, 0.01_wp, &
         & "stiffness of Hertz's contact", relative=.true.)
      call suite%check(all(abs(case%result%sensitivity(2:, :)) <= 0.0_wp), "only dFn/dpen without friction")
      call case%release()
   end subroutine frictionless

   !> Mindlin's circular contact: dF/dS along a shift of a circular contact
   subroutine mindlin(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      real(wp), parameter :: share(3) = [0.2_wp, 0.5_wp, 0.875_wp]
      real(wp) :: largest, slope
      integer :: k

      do k = 1, size(share)
         case%spec = ellipse_case(1.0_wp, 1.0_wp, 9.0_wp, 61, 61)
         case%spec%material%poiss = 0.0_wp
         case%spec%iteration%sensitivity = sensitivity_choice%forces
         case%spec%output_level = 2
         call shift(case%spec, mu=0.4_wp)
         call forces(case%spec, -share(k), 0.0_wp)
         call case%run(suite, "sphere")
         ! F/(mu Fn) = 1 - (1 - S/S_max)**(3/2), S_max = 3 mu Fn (2 - nu)/(16 G a) per body
         largest = 2.0_wp*3.0_wp*0.4_wp*9.0_wp*2.0_wp/(16.0_wp*200.0_wp)
         slope = -1.5_wp/largest*(1.0_wp - share(k))**(1.0_wp/3.0_wp)
         print "(a, f6.3, 2es12.4)", "Mindlin, F =", share(k), case%result%sensitivity(2, 2), slope
         call suite%close_to(case%result%sensitivity(2, 2), slope, 0.02_wp, "Mindlin's tangent stiffness", relative=.true.)
         ! across, friction turns the tractions with the shift: Fx/Sx
         call suite%close_to(case%result%sensitivity(3, 3), -share(k)/case%result%cksi, 0.02_wp, &
            & "stiffness across", relative=.true.)
      end do
      call case%release()
   end subroutine mindlin

   !> Derivatives that are not requested are zero
   subroutine levels(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case

      call set_case(3, 0.0_wp, solver_choice%default, case)
      case%spec%iteration%sensitivity = sensitivity_choice%forces
      case%spec%output_level = 2
      call case%run(suite, "creepages prescribed")
      call suite%check(all(abs(case%result%sensitivity) <= 0.0_wp), "no prescribed force, no sensitivity")
      case%spec%iteration%sensitivity = sensitivity_choice%normal
      call case%run(suite, "creepages prescribed")
      call suite%check(case%result%sensitivity(1, 1) > 0.0_wp .and. all(abs(case%result%sensitivity(2:, :)) <= 0.0_wp), &
         & "the normal one alone")
      call set_case(3, 0.0_wp, solver_choice%default, case)
      call forces(case%spec, -0.3_wp)
      case%spec%iteration%sensitivity = sensitivity_choice%forces
      call case%run(suite, "force prescribed")
      call suite%check(all(abs(case%result%sensitivity) <= 0.0_wp), "not computed when not printed")
      case%spec%output_level = 2
      call case%run(suite, "force prescribed")
      call suite%check(case%result%sensitivity(2, 2) < 0.0_wp .and. all(abs(case%result%sensitivity(:, [1, 3, 4])) <= 0.0_wp), &
         & "one force, one column")
      call set_case(3, 0.0_wp, solver_choice%default, case)
      case%spec%kinematics%pen = -1.0_wp
      call case%run(suite, "no contact")
      call suite%check(all(abs(case%result%sensitivity) <= 0.0_wp), "no contact, no sensitivity")
      call set_case(3, 0.0_wp, solver_choice%default, case)
      case%spec%friction%sets(1)%fstat = 0.0_wp
      call case%run(suite, "no friction")
      call suite%check(case%result%sensitivity(1, 1) > 0.0_wp .and. all(abs(case%result%sensitivity(2:3, :)) <= 0.0_wp), &
         & "no friction, no tangential sensitivity")
      call set_case(3, 0.0_wp, solver_choice%default, case)
      case%spec%kinematics%cksi = 1.0_wp
      call case%run(suite, "full sliding")
      call suite%check(all(abs(case%result%sensitivity(2:3, 2)) < 10.0_wp), "full sliding: forces hardly change")
      call case%release()
   end subroutine levels
end program test_sensitivities
