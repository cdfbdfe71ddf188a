!> Cases with simplified theory: any way to the pressures, all motions, forces, mirror images, refusals
program test_simplified_cases
   use contact_base_choices, only : material_model, motion, normal_control, pressure_model, slip_source, time_link
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_grid_element_division, only : element
   use contact_patch_result, only : patch_result
   use contact_test_case_builder, only : creep, ellipse_case, forces, grid_case, line_case, shift, surface_case, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   integer, parameter :: models(3) = [material_model%fastsim_single, material_model%fastsim, material_model%fastrip]
   type(test_suite) :: suite

   call suite%start("simplified cases")
   call pressures(suite)
   call displacements(suite)
   call against_full_solution(suite)
   call time(suite)
   call prescribed_forces(suite)
   call mirrors(suite)
   call refusals(suite)
   call few_elements(suite)
   call suite%finish()

contains

   !> The same case with the given model
   function simplified(elastic, model) result(spec)
      type(case_spec), intent(in) :: elastic
      integer, intent(in) :: model
      type(case_spec) :: spec

      spec = elastic
      spec%material_model = model
      spec%material%flx = 5.0e-3_wp
   end function simplified

   !> Full pressures, given ones, approach instead of force, a grid of one's own: nearly the same
   subroutine pressures(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: full, given, pushed, own
      integer :: i

      do i = 1, size(models)
         full%spec = simplified(ellipse_case(2.0_wp, 1.0_wp, 20.0_wp, 44, 44, eps=1.0e-6_wp), models(i))
         call creep(full%spec, motion%steady_rolling, ksi=2.0e-3_wp, eta=3.0e-3_wp, phi=1.0e-3_wp)
         call full%run(suite, "full pressures")
         call sound(suite, full%result, "full pressures")
         given%spec = full%spec
         given%spec%pressure = pressure_model%elliptical
         call given%run(suite, "given pressures")
         call sound(suite, given%result, "given pressures")
         call suite%close_to([full%result%fx_rel, full%result%fy_rel], [given%result%fx_rel, given%result%fy_rel], 0.02_wp, &
            & "pressures solved or given")
         pushed%spec = full%spec
         pushed%spec%normal = normal_control%approach
         pushed%spec%kinematics%pen = full%result%pen
         call pushed%run(suite, "approach")
         call suite%close_to(pushed%result%fx_rel, full%result%fx_rel, 0.01_wp, "approach or force")
         own%spec = simplified(grid_case(full%result%hertz%a1, full%result%hertz%b1, 20.0_wp, 44, 44, 0.1_wp, 0.05_wp, &
            & eps=1.0e-6_wp), models(i))
         call creep(own%spec, motion%steady_rolling, ksi=2.0e-3_wp, eta=3.0e-3_wp, phi=1.0e-3_wp)
         call own%run(suite, "own grid")
         call suite%close_to([own%result%fx_rel, own%result%fy_rel], [full%result%fx_rel, full%result%fy_rel], 0.02_wp, &
            & "equivalent ellipse")
      end do
      call full%release()
      call given%release()
      call pushed%release()
      call own%release()
   end subroutine pressures

   !> Tractions within the bound, friction dissipates energy, tractions and displacements are consistent
   subroutine sound(suite, result, what)
      type(test_suite), intent(inout) :: suite
      type(patch_result), intent(in) :: result
      character(len=*), intent(in) :: what

      call suite%check(all(hypot(result%px, result%py) <= result%mu*result%pn*(1.0_wp + 1.0e-12_wp)), what // ": bound")
      call suite%check(result%friction_power <= 0.0_wp, what // ": power")
      call suite%check(result%itang == 1, what // ": one pass")
      call suite%check(result%flx(1) > 0.0_wp .and. result%k_eff > 0.0_wp, what // ": flexibilities")
      call suite%check(all(abs(result%sx) + abs(result%sy) <= 0.0_wp .or. result%division == element%slip), &
         & what // ": slip in the slip area")
   end subroutine sound

   !> Displacements are those of springs; normal ones of half-spaces; the energy of given pressures is not reported
   subroutine displacements(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case

      case%spec = simplified(ellipse_case(2.0_wp, 1.0_wp, 20.0_wp, 33, 33, eps=1.0e-6_wp), material_model%fastsim)
      call creep(case%spec, motion%steady_rolling, ksi=2.0e-3_wp)
      case%spec%material%k0_mf = 0.5_wp
      call case%run(suite, "displacements")
      call suite%check(maxval(abs(case%result%ux - 2.0_wp*case%result%flx(1)*case%result%px)) <= &
         & 1.0e-12_wp*maxval(abs(case%result%ux)), "u = (L/k) p")
      call suite%check(maxval(case%result%un) > 0.0_wp .and. case%result%elastic_energy > 0.0_wp, "normal displacements")
      case%spec%pressure = pressure_model%elliptical
      call case%run(suite, "given pressures")
      call suite%close_to(case%result%elastic_energy, 0.0_wp, 0.0_wp, "energy of given pressures")
      call suite%close_to(maxval(abs(case%result%un)), 0.0_wp, 0.0_wp, "normal displacements of given pressures")
      call case%release()
   end subroutine displacements

   !> Forces of the full solution, within the known error of simplified theory
   subroutine against_full_solution(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: sizes(4) = [1.0e-4_wp, 1.0e-3_wp, 3.0e-3_wp, 1.0e-2_wp]
      type(test_case) :: full, case
      integer :: i, j

      do j = 1, size(sizes)
         full%spec = ellipse_case(2.0_wp, 1.0_wp, 20.0_wp, 44, 44, eps=1.0e-6_wp)
         call creep(full%spec, motion%steady_rolling, ksi=sizes(j), eta=0.5_wp*sizes(j))
         call full%run(suite, "full solution")
         do i = 2, size(models)
            case%spec = simplified(full%spec, models(i))
            call case%run(suite, "simplified theory")
            call suite%close_to([case%result%fx_rel, case%result%fy_rel], [full%result%fx_rel, full%result%fy_rel], 0.08_wp, &
               & "forces of simplified theory")
         end do
      end do
      call full%release()
      call case%release()
   end subroutine against_full_solution

   !> Transient rolling ends in steady rolling, also if steps are not whole elements; shifts add up
   subroutine time(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: steady, case
      real(wp) :: force
      integer :: i, k

      do k = 1, 2
         steady%spec = simplified(ellipse_case(2.0_wp, 1.0_wp, 20.0_wp, 33, 33, eps=1.0e-6_wp), models(k))
         call creep(steady%spec, motion%steady_rolling, ksi=2.0e-3_wp, eta=3.0e-3_wp, phi=1.0e-3_wp)
         call steady%run(suite, "steady")
         case%spec = steady%spec
         case%spec%motion = motion%transient_rolling
         case%spec%rolling%dq = steady%result%dq
         do i = 1, 33
            call case%run(suite, "transient")
            case%spec%link = time_link%continue_all
         end do
         call suite%close_to([case%result%fx, case%result%fy], [steady%result%fx, steady%result%fy], 1.0e-9_wp, &
            & "transient to steady")
         call suite%check(all(case%result%division == steady%result%division), "transient to steady: division")
         case%spec%rolling%dq = 0.7_wp*steady%result%dq
         do i = 1, 60
            call case%run(suite, "transient, fractions of elements")
         end do
         call suite%close_to([case%result%fx_rel, case%result%fy_rel], [steady%result%fx_rel, steady%result%fy_rel], 0.03_wp, &
            & "transient to steady, fractions of elements")
      end do

      case%spec = simplified(ellipse_case(2.0_wp, 1.0_wp, 20.0_wp, 33, 33, eps=1.0e-6_wp), material_model%fastsim)
      call shift(case%spec, x=1.0e-3_wp)
      call case%run(suite, "shift")
      force = case%result%fx_rel
      call suite%check(force < 0.0_wp .and. case%result%nslip > 0 .and. case%result%nadh > 0, "partial slip in a shift")
      case%spec%link = time_link%continue_all
      call shift(case%spec, x=0.0_wp)
      call case%run(suite, "no shift")
      call suite%close_to(case%result%fx_rel, force, 1.0e-12_wp, "without a shift there is no change")
      call shift(case%spec, x=-1.0e-5_wp)
      call case%run(suite, "back")
      call suite%check(case%result%fx_rel > force, "back again")
      call steady%release()
      call case%release()
   end subroutine time

   !> Forces instead of creepages
   subroutine prescribed_forces(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      type(error_type), allocatable :: error
      integer :: i, n

      do i = 1, 2
         do n = 1, 2
            case%spec = simplified(ellipse_case(2.0_wp, 1.0_wp, 20.0_wp, 33, 33, eps=1.0e-6_wp), models(i))
            call creep(case%spec, motion%steady_rolling, phi=1.0e-3_wp)
            call forces(case%spec, 0.5_wp)
            if (n == 2) call forces(case%spec, 0.5_wp, -0.4_wp)
            call case%run(suite, "forces")
            call suite%close_to(case%result%fx/(0.3_wp*20.0_wp), 0.5_wp, 2.0e-6_wp, "the force")
            if (n == 2) call suite%close_to(case%result%fy/(0.3_wp*20.0_wp), -0.4_wp, 2.0e-6_wp, "the other force")
            call suite%check(case%result%cksi < 0.0_wp, "creepage against the force")
            call suite%close_to(maxval(abs(case%result%wx(:, 17)/case%result%dq - case%result%cksi)), 0.0_wp, &
               & 1.0e-10_wp, "rigid slip of the middle row")
         end do
      end do
      ! shift: the force is known from its first part
      case%spec = simplified(ellipse_case(2.0_wp, 1.0_wp, 20.0_wp, 33, 33, eps=1.0e-6_wp), material_model%fastsim)
      call shift(case%spec)
      call forces(case%spec, 0.5_wp, 0.2_wp)
      call case%run(suite, "shift by forces")
      ! not all of the force can be had
      case%spec = simplified(ellipse_case(2.0_wp, 1.0_wp, 20.0_wp, 9, 9, eps=1.0e-6_wp), material_model%fastsim)
      case%spec%pressure = pressure_model%parabolical
      call creep(case%spec, motion%steady_rolling, eta=1.0_wp)
      call forces(case%spec, 0.9999999_wp)
      call case%try(error)
      call suite%check(.not. allocated(error), "a statement, no failure")
      call case%release()
   end subroutine prescribed_forces

   !> Rolling the other way
   subroutine mirrors(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: one, two
      integer :: i

      do i = 1, size(models)
         one%spec = simplified(ellipse_case(2.0_wp, 1.0_wp, 20.0_wp, 34, 33), models(i))
         one%spec%pressure = pressure_model%elliptical
         call creep(one%spec, motion%steady_rolling, ksi=2.0e-3_wp, eta=3.0e-3_wp, phi=1.0e-3_wp)
         one%spec%kinematics%spinxo = 0.1_wp
         one%spec%kinematics%spinyo = 0.2_wp
         call one%run(suite, "one way")
         two%spec = one%spec
         two%spec%rolling%chi = acos(-1.0_wp)
         two%spec%kinematics%cksi = -one%spec%kinematics%cksi
         two%spec%kinematics%cphi = -one%spec%kinematics%cphi
         two%spec%kinematics%spinxo = -one%spec%kinematics%spinxo
         call two%run(suite, "the other way")
         call suite%close_to([two%result%fx_rel, two%result%fy_rel], [-one%result%fx_rel, one%result%fy_rel], 1.0e-10_wp, &
            & "mirror image: forces")
         call suite%check(all(two%result%division == one%result%division(34:1:-1, :)), "mirror image: division")
      end do
      call one%release()
      call two%release()
   end subroutine mirrors

   !> What no method can honour is refused
   subroutine refusals(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      type(error_type), allocatable :: error

      case%spec = simplified(ellipse_case(2.0_wp, 1.0_wp, 20.0_wp, 9, 9), material_model%fastrip)
      call shift(case%spec, x=1.0e-3_wp)
      call case%try(error)
      call suite%check(allocated(error), "FaStrip in a shift")
      call creep(case%spec, motion%steady_rolling, ksi=1.0e-3_wp)
      case%spec%slip_source = slip_source%given
      allocate(case%spec%extra_slip(2, 81), source=0.0_wp)
      call case%try(error)
      call suite%check(allocated(error), "FaStrip with an extra rigid slip")
      case%spec = simplified(ellipse_case(2.0_wp, 1.0_wp, 20.0_wp, 9, 9), material_model%fastsim)
      call shift(case%spec, x=1.0e-3_wp)
      case%spec%material%alfamf = 0.5_wp
      call case%try(error)
      call suite%check(allocated(error), "slope reduction in a shift")
      case%spec = simplified(ellipse_case(2.0_wp, 1.0_wp, 20.0_wp, 9, 9), material_model%fastsim_single)
      call creep(case%spec, motion%steady_rolling, ksi=1.0e-3_wp)
      case%spec%material%flx = 0.0_wp
      call case%try(error)
      call suite%check(allocated(error), "no flexibility")
      call case%release()
   end subroutine refusals

   !> One row, one element, no contact, no friction, dissimilar bodies
   subroutine few_elements(suite)
      type(test_suite), intent(inout) :: suite
      real(wp) :: h(3, 3)
      type(test_case) :: case
      integer :: i

      do i = 1, size(models)
         case%spec = simplified(line_case(1.0_wp, 100.0_wp, 1000.0_wp, 33), models(i))
         call creep(case%spec, motion%steady_rolling, ksi=1.0e-3_wp)
         call case%run(suite, "one row")
         call sound(suite, case%result, "one row")
         h = 1.0_wp
         h(2, 2) = 0.0_wp
         case%spec = simplified(surface_case(h, 1.0_wp, 1.0_wp, 1.0_wp), models(i))
         call creep(case%spec, motion%steady_rolling, ksi=1.0e-3_wp, eta=1.0e-3_wp)
         call case%run(suite, "one element")
         call suite%check(case%result%ncon == 1, "one element")
         call sound(suite, case%result, "one element")
         case%spec%normal = normal_control%approach
         case%spec%kinematics%pen = -1.0_wp
         call case%run(suite, "no contact")
         call suite%check(case%result%ncon == 0, "no contact")
         case%spec = simplified(ellipse_case(2.0_wp, 1.0_wp, 20.0_wp, 15, 15), models(i))
         call creep(case%spec, motion%steady_rolling, ksi=1.0e-3_wp, mu=0.0_wp)
         call case%run(suite, "no friction")
         call suite%close_to(maxval(abs(case%result%px)), 0.0_wp, 0.0_wp, "no friction")
         call creep(case%spec, motion%steady_rolling, ksi=1.0e-3_wp, mu=0.3_wp)
         case%spec%material%poiss = [0.0_wp, 0.4_wp]
         call case%run(suite, "dissimilar bodies")
      end do
      call case%release()
   end subroutine few_elements
end program test_simplified_cases
