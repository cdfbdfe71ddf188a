!> Approximate normal methods in whole cases: against the full solution, scaling, refusals; damping forces
program test_approximate_methods
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_choices, only : material_model, motion, normal_control, pressure_model, time_link
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : part_source
   use contact_patch_damping, only : damping_forces, damping_law
   use contact_patch_result, only : patch_result
   use contact_test_case_builder, only : creep, forces, hertz_case, surface_case, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   integer, parameter :: methods(3) = [pressure_model%full, pressure_model%kpec, pressure_model%analyn]
   character(len=8), parameter :: name_of(3) = [character(len=8) :: "full", "KPEC", "ANALYN"]
   !> Shapes of the rail below a wheel of radius 460 mm, and what force, highest pressure, area and tangential force of
   !> the two methods may be off [-]; measured: doc/theory/approximate_normal.md
   character(len=24), parameter :: shape_name(5) = [character(len=24) :: "quadratic", "worn rail", "fourth power", "corner", &
      & "two humps"]
   real(wp), parameter :: allowed(4, 2, 5) = reshape([ &
      & 0.005_wp, 0.005_wp, 0.02_wp, 0.005_wp, 0.005_wp, 0.005_wp, 0.02_wp, 0.005_wp, &
      & 0.005_wp, 0.01_wp, 0.02_wp, 0.005_wp, 0.005_wp, 0.01_wp, 0.02_wp, 0.005_wp, &
      & 0.03_wp, 0.14_wp, 0.08_wp, 0.04_wp, 0.01_wp, 0.14_wp, 0.04_wp, 0.01_wp, &
      & 0.09_wp, 0.28_wp, 0.06_wp, 0.02_wp, 0.03_wp, 0.23_wp, 0.06_wp, 0.02_wp, &
      & 0.12_wp, 0.27_wp, 0.14_wp, 0.08_wp, 0.26_wp, 0.16_wp, 0.09_wp, 0.15_wp], [4, 2, 5])
   type(test_suite) :: suite
   integer :: shape_

   call suite%start("approximate methods in cases")
   write(*, "(a, t26, a, t36, 4a12)") "rail", "method", "force", "pressure", "area", "Fx"
   do shape_ = 1, size(shape_name)
      call against_full(suite, shape_)
   end do
   call double_ellipse(suite)
   call coupled(suite)
   call sequences(suite)
   call refusals(suite)
   call damping_law_alone(suite)
   call damping_in_sequences(suite)
   call suite%finish()

contains

   !> Height of the rail below its highest point [mm]
   elemental real(wp) function rail(shape_, y) result(depth)
      !> Place in shape_name
      integer, intent(in) :: shape_
      real(wp), intent(in) :: y

      select case (shape_)
      case (1); depth = y**2/700.0_wp
      case (2); depth = y**2/700.0_wp + merge(9.0e-5_wp, -2.0e-5_wp, y > 0.0_wp)*y**3
      case (3); depth = 6.0e-5_wp*y**4
      case (4); depth = y**2/merge(60.0_wp, 800.0_wp, y > 0.0_wp)
      case default; depth = 1.0e-4_wp*(y**2 - 12.0_wp)**2
      end select
   end function rail

   !> A wheel rolls over a rail of this shape
   subroutine set_case(shape_, method, case)
      integer, intent(in) :: shape_
      !> Member of pressure_model
      integer, intent(in) :: method
      type(test_case), intent(inout) :: case
      integer, parameter :: mx = 55, my = 67
      real(wp), parameter :: dx = 0.3_wp, dy = 0.3_wp
      real(wp) :: h(mx, my)
      integer :: ix, iy

      do iy = 1, my
         do ix = 1, mx
            h(ix, iy) = ((ix - 0.5_wp*(mx + 1))*dx)**2/920.0_wp + rail(shape_, (iy - 0.5_wp*(my + 1))*dy)
         end do
      end do
      case%spec = surface_case(h, 0.0_wp, dx, dy, eps=1.0e-7_wp)
      case%spec%material%gg = 82000.0_wp
      case%spec%normal = normal_control%approach
      case%spec%kinematics%pen = 0.05_wp
      case%spec%pressure = method
      call creep(case%spec, motion%steady_rolling, ksi=-8.0e-4_wp, eta=4.0e-4_wp, phi=1.0e-4_wp)
   end subroutine set_case

   !> How far from the solution of the contact conditions
   subroutine against_full(suite, shape_)
      type(test_suite), intent(inout) :: suite
      integer, intent(in) :: shape_
      type(test_case) :: case
      real(wp) :: figures(4, 3), off(4)
      integer :: m

      do m = 1, size(methods)
         call set_case(shape_, methods(m), case)
         call case%run(suite, trim(shape_name(shape_)) // ", " // trim(name_of(m)))
         figures(:, m) = [case%result%fn, case%result%pmax, real(case%result%ncon, wp), case%result%fx]
         if (m == 1) cycle
         off = figures(:, m)/figures(:, 1) - 1.0_wp
         write(*, '(a, a, t36, 4(f10.1, " %"))') shape_name(shape_), trim(name_of(m)), 100.0_wp*off
         call suite%check(all(abs(off) <= allowed(:, m - 1, shape_)), trim(name_of(m)) // " on " // trim(shape_name(shape_)) &
            & // ": as good as it was")
         call suite%check(case%result%elastic_energy > 0.0_wp .and. case%result%normal%passes == 0, trim(name_of(m)) &
            & // " on " // trim(shape_name(shape_)) // ": energy without a pass of a solver")
      end do
      call case%release()
   end subroutine against_full

   !> SDEC: prescribed force, no energy, and Hertz's tangential problem if both halves are equal
   subroutine double_ellipse(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      real(wp) :: expected(3)

      case%spec = hertz_case(0.01_wp, 0.016_wp, 20.0_wp, 41, 41, scale=1.05_wp)
      case%spec%pressure = pressure_model%elliptical
      call creep(case%spec, motion%steady_rolling, 2.0e-3_wp, 1.0e-3_wp, 3.0e-4_wp)
      case%spec%rolling%dq = 0.05_wp
      call case%run(suite, "ellipse")
      expected = [case%result%fx, case%result%fy, case%result%mz]
      case%spec%grid%form = -6
      case%spec%grid%aa = case%result%hertz%aa
      case%spec%grid%bneg = case%result%hertz%bb
      case%spec%grid%bpos = case%result%hertz%bb
      case%spec%pressure = pressure_model%sdec
      call case%run(suite, "SDEC")
      call suite%close_to([case%result%fx, case%result%fy, case%result%mz], expected, 1.0e-6_wp, "SDEC with equal halves")
      call suite%close_to(case%result%fn, 20.0_wp, 0.0_wp, "SDEC: force")
      call suite%close_to(case%result%elastic_energy, 0.0_wp, 0.0_wp, "SDEC: no energy")
      call case%release()
   end subroutine double_ellipse

   !> Dissimilar bodies: the approximate pressures see the displacements by friction
   subroutine coupled(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      integer :: m

      do m = 1, size(methods)
         call set_case(2, methods(m), case)
         case%spec%material%poiss = [0.3_wp, 0.0_wp]
         case%spec%iteration%maxout = 30
         case%spec%iteration%eps = 1.0e-6_wp
         call case%run(suite, "dissimilar, " // trim(name_of(m)))
         call suite%check(case%result%outer_iterations > 1 .and. case%result%outer_iterations < 30, &
            & "dissimilar, " // trim(name_of(m)) // ": the outer iteration ends")
      end do
      call case%release()
   end subroutine coupled

   !> Methods alternate in sequences of every kind, also with simplified theory and prescribed forces
   subroutine sequences(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: kinds(3) = [motion%shift, motion%transient_rolling, motion%steady_rolling]
      type(test_case) :: case
      character(len=40) :: what
      integer :: kind, theory, step, m

      do kind = 1, size(kinds)
         do theory = 1, 2
            do step = 1, 6
               m = mod(step, 3) + 1
               call set_case(2, methods(m), case)
               write(what, "(a, 3i2)") "sequence", kind, theory, step
               case%spec%motion = kinds(kind)
               if (theory == 2) case%spec%material_model = material_model%fastsim
               if (kinds(kind) == motion%shift) then
                  case%spec%kinematics%cksi = 2.0e-3_wp
                  case%spec%kinematics%ceta = -1.0e-3_wp
               end if
               if (step > 1) then
                  case%spec%link = time_link%continue_all
                  case%spec%parts%grid = part_source%kept
                  case%spec%parts%geometry = part_source%kept
               end if
               if (step > 3) call forces(case%spec, 0.4_wp, -0.2_wp)
               case%spec%kinematics%pen = 0.05_wp + 0.002_wp*step
               call case%run(suite, what)
               call suite%check(ieee_is_finite(case%result%fx) .and. ieee_is_finite(case%result%friction_power) .and. &
                  & hypot(case%result%fx, case%result%fy) <= case%result%mu_scal*case%result%fn*(1.0_wp + 1.0e-9_wp) .and. &
                  & case%result%ncon > 0, what // ": forces within their bound")
               if (case%spec%force == 2) call suite%close_to([case%result%fx_rel, case%result%fy_rel], [0.4_wp, -0.2_wp], &
                  & 1.0e-6_wp, what // ": prescribed forces")
            end do
         end do
      end do
      call case%release()
   end subroutine sequences

   !> What no method can do is refused
   subroutine refusals(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case

      call set_case(1, pressure_model%kpec, case)
      case%spec%normal = normal_control%force
      case%spec%kinematics%fn = 1.0e4_wp
      call refuse(suite, case, "KPEC with a force")
      call set_case(1, pressure_model%elliptical, case)
      call refuse(suite, case, "Hertzian pressure without Hertz")
      call set_case(1, pressure_model%sdec, case)
      call refuse(suite, case, "SDEC without its geometry")
      call set_case(1, pressure_model%thin_sheet, case)
      call refuse(suite, case, "thin sheet")
      call set_case(1, pressure_model%sdec, case)
      case%spec%grid%form = -6
      case%spec%grid%aa = 1.0_wp
      case%spec%grid%bneg = 1.0_wp
      case%spec%grid%bpos = 1.0_wp
      call refuse(suite, case, "SDEC with an approach")
      call set_case(1, pressure_model%kpec, case)
      case%spec%kinematics%pen = -0.1_wp
      call case%run(suite, "no contact")
      call suite%check(case%result%ncon == 0 .and. abs(case%result%fn) <= 0.0_wp, "KPEC without contact")
      call case%release()
   end subroutine refusals

   subroutine refuse(suite, case, what)
      type(test_suite), intent(inout) :: suite
      type(test_case), intent(inout) :: case
      character(len=*), intent(in) :: what
      type(error_type), allocatable :: error

      call case%try(error)
      call suite%check(allocated(error), what // " is refused")
   end subroutine refuse

   !> Proportional to the rate, limited, nothing without change
   subroutine damping_law_alone(suite)
      type(test_suite), intent(inout) :: suite
      type(damping_law) :: law

      law = damping_law([2.0_wp, 3.0_wp], [100.0_wp, 10.0_wp])
      call suite%close_to(damping_forces(law, [1.0_wp, 2.0_wp, 3.0_wp], [2.0_wp, 2.0_wp, 2.0_wp], 0.5_wp), &
         & [4.0_wp, 0.0_wp, -6.0_wp], 1.0e-12_wp, "proportional to the rate")
      call suite%close_to(damping_forces(law, [0.0_wp, 0.0_wp, 0.0_wp], [1.0e3_wp, 1.0e3_wp, -1.0e3_wp], 0.5_wp), &
         & [200.0_wp, 30.0_wp, -30.0_wp], 1.0e-12_wp, "limited")
      call suite%close_to(damping_forces(law, [1.0_wp, 1.0_wp, 1.0_wp], [1.0_wp, 1.0_wp, 1.0_wp], 0.0_wp), &
         & [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "no change in no time")
      call suite%close_to(damping_forces(law, [1.0_wp, 1.0_wp, 1.0_wp], [3.0_wp, 3.0_wp, 3.0_wp], 0.0_wp), &
         & [200.0_wp, 30.0_wp, 30.0_wp], 0.0_wp, "a sudden change is limited")
   end subroutine damping_law_alone

   !> Which previous forces count: all (P = 0), the normal one (P = 1), none (P = 2), those before (P = 3)
   subroutine damping_in_sequences(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      real(wp) :: first(3), second(3), plain(3)

      call step(suite, case, time_link%initiate, 20.0_wp, first)
      call suite%close_to(case%result%damping, [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "a new sequence is not damped")
      call step(suite, case, time_link%continue_all, 23.0_wp, second)
      call suite%close_to(case%result%damping, 0.5_wp*(second - first)/case%result%dt, 1.0e-9_wp, "P = 0", relative=.true.)
      call step(suite, case, time_link%repeat_step, 24.0_wp, second)
      call suite%close_to(case%result%damping, 0.5_wp*(second - first)/case%result%dt, 1.0e-9_wp, "P = 3", relative=.true.)
      call step(suite, case, time_link%continue_normal, 24.0_wp, second)
      call suite%close_to(case%result%damping, [0.0_wp, 0.5_wp*second(2:)/case%result%dt], 1.0e-9_wp, "P = 1")
      call step(suite, case, time_link%initiate, 20.0_wp, second)
      call suite%close_to(case%result%damping, [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "P = 2")
      case%spec%has_damping = .false.
      call case%run(suite, "no damping")
      plain = [case%result%fn, case%result%fx, case%result%fy]
      call suite%check(.not. allocated(case%result%damping), "no damping, no damping force")
      call suite%close_to(plain, second, 0.0_wp, "damping does not change the elastic forces")
      call case%release()
   end subroutine damping_in_sequences

   !> One step of a sequence under a force
   subroutine step(suite, case, link, fn, force)
      type(test_suite), intent(inout) :: suite
      type(test_case), intent(inout) :: case
      !> Member of time_link
      integer, intent(in) :: link
      real(wp), intent(in) :: fn
      real(wp), intent(out) :: force(3)

      case%spec = hertz_case(0.01_wp, 0.016_wp, 20.0_wp, 21, 21, scale=1.3_wp)
      case%spec%parts%grid = merge(part_source%given, part_source%kept, link == time_link%initiate)
      case%spec%parts%geometry = case%spec%parts%grid
      case%spec%kinematics%fn = fn
      case%spec%link = link
      case%spec%has_damping = .true.
      case%spec%damping%cdampn = 0.5_wp
      case%spec%damping%cdampt = 0.5_wp
      case%spec%damping%dfnmax = 1.0e20_wp
      case%spec%damping%dftmax = 1.0e20_wp
      call creep(case%spec, motion%transient_rolling, 2.0e-3_wp, 1.0e-3_wp)
      case%spec%rolling%dq = 0.05_wp
      case%spec%rolling%veloc = 10.0_wp
      call case%run(suite, "damped step")
      force = [case%result%fn, case%result%fx, case%result%fy]
   end subroutine step
end program test_approximate_methods
