!> How an accuracy is sought: when a grid will do, and the order that estimates of two grids show
program test_accuracy_plan
   use contact_base_choices, only : force_control, grid_form, material_model, motion, normal_control, time_link
   use contact_base_kinds, only : wp
   use contact_cases_accuracy_grid, only : is_worth, level_grid
   use contact_cases_accuracy_plan, only : accuracy_law, contact_sides, expected_across, expected_law, finer_across, &
      & first_order_alone, is_near_enough, observed_order
   use contact_cases_accuracy_series, only : accuracy_series
   use contact_cases_spec, only : case_spec
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   real(wp), parameter :: required = 1.0e-3_wp
   type(test_suite) :: suite

   call suite%start("accuracy_plan")
   call ends(suite)
   call orders(suite)
   call kinds(suite)
   call samples(suite)
   call sides(suite)
   call suite%finish()

contains

   subroutine ends(suite)
      type(test_suite), intent(inout) :: suite

      call suite%check(is_near_enough(0.6_wp*required, 0.0_wp, required), "the first grid, well below")
      call suite%check(.not. is_near_enough(0.85_wp*required, 0.0_wp, required), "the first grid, narrowly below")
      call suite%check(is_near_enough(0.85_wp*required, 0.5_wp*required, required), "two samples of which one is narrowly below")
      call suite%check(.not. is_near_enough(0.85_wp*required, 1.2_wp*required, required), "two samples, the other one above")
      call suite%check(.not. is_near_enough(0.95_wp*required, 0.1_wp*required, required), &
         & "an estimate that is too close, independent of the other")
      call suite%check(.not. is_near_enough(0.1_wp*required, 2.0_wp*required, required), "an estimate that is small by accident")
      call suite%check(.not. is_near_enough(-1.0_wp, 0.1_wp*required, required), "no estimate")
   end subroutine ends

   subroutine orders(suite)
      type(test_suite), intent(inout) :: suite
      type(accuracy_law) :: law
      real(wp) :: before, ratio

      law = accuracy_law(factor=0.6_wp, order=1.8_wp, falls=2.1_wp)
      before = 5.0e-3_wp
      ratio = 2.5_wp
      associate (expected => before*ratio**(-law%falls))
         call suite%close_to(observed_order(law, before*ratio**(-1.4_wp), before, expected), 1.4_wp, 1.0e-12_wp, "as observed")
         call suite%close_to(observed_order(law, before*ratio**(-3.0_wp), before, expected), 2.1_wp, 1.0e-12_wp, "not more")
         call suite%close_to(observed_order(law, before*ratio**(-0.2_wp), before, expected), 1.0_wp, 1.0e-12_wp, &
            & "not less than one")
      end associate
      call suite%close_to(observed_order(law, before, 0.0_wp, 0.0_wp), 2.1_wp, 1.0e-12_wp, "of the first grid")
      law = first_order_alone(law)
      call suite%close_to(observed_order(law, before, 0.0_wp, 0.0_wp), 1.0_wp, 1.0e-12_wp, "where the first order acts")
      call suite%check(finer_across(30.0_wp, 2.0_wp*required, required, 1.0_wp) &
         & > finer_across(30.0_wp, 2.0_wp*required, required, 2.0_wp), &
         & "a lower order needs more elements")
   end subroutine orders

   !> Kinds of contact whose estimates are larger have a finer first grid
   subroutine kinds(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec
      !> With fewer elements all kinds have the same first grid
      real(wp), parameter :: sharp = 0.1_wp*required
      real(wp) :: plain, spinning

      spec%motion = motion%steady_rolling
      spec%material%poiss = 0.28_wp
      spec%material%gg = 82000.0_wp
      spec%grid%form = grid_form%corner_and_sides
      spec%grid%mx = 20
      spec%grid%my = 20
      spec%grid%dx = 0.5_wp
      spec%grid%dy = 0.5_wp
      spec%kinematics%cksi = 1.0e-3_wp
      plain = expected_across(expected_law(spec), sharp)
      spec%kinematics%cphi = 1.0e-4_wp
      spinning = expected_across(expected_law(spec), sharp)
      call suite%check(spinning > plain, "some spin")
      spec%kinematics%cphi = 1.0e-2_wp
      call suite%check(expected_across(expected_law(spec), sharp) > spinning, "spin beyond the creepage")
      spec%kinematics%cphi = 1.0e2_wp
      call suite%check(expected_across(expected_law(spec), sharp) < 2.0_wp*plain, "spin alone: the turn is limited")
      spec%kinematics%cphi = 0.0_wp
      spec%force = force_control%fx_and_fy
      call suite%check(expected_across(expected_law(spec), sharp) > plain, "forces prescribed")
      spec%force = force_control%creepages
      spec%material_model = material_model%interfacial_layer
      call suite%check(expected_across(expected_law(spec), sharp) > plain, "an elastic layer")
      call suite%check(expected_across(expected_law(spec), sharp) < 2.0_wp*plain, "an elastic layer has the second order, too")
      spec%material_model = material_model%elastic
      spec%material%gg = [82000.0_wp, 20000.0_wp]
      call suite%check(expected_across(expected_law(spec), sharp) > plain, "unlike bodies")
      allocate(spec%friction%sets(1))
      spec%friction%sets%fkin = 0.6_wp
      plain = expected_across(expected_law(spec), sharp)
      spec%friction%sets%fkin = 0.2_wp
      call suite%check(expected_across(expected_law(spec), sharp) > 1.05_wp*plain, "unlike bodies with less friction")
   end subroutine kinds

   !> The error of the previous case of a series on the same grid is another sample of the error of a case
   subroutine samples(suite)
      type(test_suite), intent(inout) :: suite
      type(accuracy_series) :: series
      type(case_spec) :: spec
      type(level_grid) :: grid, finer

      spec%motion = motion%shift
      spec%link = time_link%initiate
      grid%counts = 24
      grid%lengths = 10.0_wp
      grid%eps = 1.0e-4_wp
      call series%take(spec, grid, 0.5_wp*required)
      call suite%close_to(series%sample(spec, grid), 0.0_wp, 0.0_wp, "a new sequence has no previous case")
      spec%link = time_link%continue_all
      call suite%close_to(series%sample(spec, grid), 0.5_wp*required, 0.0_wp, "the previous case on the same grid")
      finer = grid
      finer%counts = 36
      call suite%close_to(series%sample(spec, finer), 0.0_wp, 0.0_wp, "none on a finer grid")
      call suite%check(is_near_enough(0.85_wp*required, series%sample(spec, grid), required), "a second case narrowly below")
      call suite%check(.not. is_near_enough(0.85_wp*required, series%sample(spec, finer), required), &
         & "a single sample narrowly below")
   end subroutine samples

   !> Expected sides of the contact, and a next grid with more elements in one direction
   subroutine sides(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec
      real(wp), parameter :: radius = 300.0_wp, force = 2.0e4_wp
      real(wp) :: length(2), a
      integer :: k

      spec%material%poiss = 0.28_wp
      spec%material%gg = 82000.0_wp
      spec%normal = normal_control%force
      spec%kinematics%fn = force
      spec%grid%form = grid_form%corner_and_sides
      spec%grid%mx = 20
      spec%grid%my = 20
      spec%geometry%b([1, 3]) = 0.5_wp/radius
      ! a ball on a plane of the same material, whose combined modulus of rigidity is G
      a = (0.75_wp*force*radius*(1.0_wp - 0.28_wp)/82000.0_wp)**(1.0_wp/3.0_wp)
      do k = 1, 2
         spec%grid%dx = k
         spec%grid%dy = k
         call contact_sides(spec, length)
         call suite%close_to(length(1), 2.0_wp*a, 1.0e-6_wp, "the ellipse of Hertz in any window, along x")
         call suite%close_to(length(2), 2.0_wp*a, 1.0e-6_wp, "the ellipse of Hertz in any window, along y")
      end do
      spec%geometry%b(4) = 1.0e-3_wp
      call contact_sides(spec, length)
      call suite%close_to(length(1), 30.0_wp, 1.0e-12_wp, "a part of the window for other shapes")
      call suite%check(is_worth([47, 47], [47, 60]), "a finer grid in one direction alone")
      call suite%check(.not. is_worth([47, 47], [47, 48]), "a grid that is hardly finer")
   end subroutine sides
end program test_accuracy_plan
