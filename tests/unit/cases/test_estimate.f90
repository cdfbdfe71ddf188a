!> Estimates of cost: dependence on the number of elements, and on effects that make a case expensive
program test_estimate
   use contact_base_choices, only : material_model, motion, normal_control, solver_choice
   use contact_base_kinds, only : long, wp
   use contact_base_memory, only : bytes_per_element
   use contact_cases_estimate, only : case_cost, cost_text, estimate_cost
   use contact_cases_machine_pace, only : machine_pace
   use contact_cases_spec, only : case_spec, part_source
   use contact_test_harness, only : test_suite
   use contact_friction_new_law, only : friction_model
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("estimate")
   call contact_problems(suite)
   call wheel_and_rail(suite)
   call words(suite)
   call pace(suite)
   call suite%finish()

contains

   !> Seconds of a case of n by n elements beyond those of every case
   real(wp) function seconds(given, n)
      type(case_spec), intent(in) :: given
      integer, intent(in) :: n
      type(case_spec) :: spec
      type(case_cost) :: cost

      spec = given
      spec%grid%mx = n
      spec%grid%my = n
      call estimate_cost(spec, cost)
      seconds = cost%seconds - 1.0e-4_wp
   end function seconds

   subroutine contact_problems(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec, other
      type(case_cost) :: cost, with_points
      real(wp) :: normal, tangential
      integer :: kind

      spec%material%poiss = 0.28_wp
      spec%material%gg = 82000.0_wp
      spec%grid%mx = 30
      spec%grid%my = 20
      call estimate_cost(spec, cost)
      call suite%check(cost%elements == 600_long .and. .not. cost%at_most, "elements")
      call suite%close_to(cost%bytes, 600.0_wp*bytes_per_element, 1.0e-9_wp, "memory", relative=.true.)
      other = spec
      other%has_stress = .true.
      allocate(other%subsurface%blocks(2))
      other%subsurface%blocks(1)%z = [0.0_wp, 0.5_wp, 1.0_wp]
      other%subsurface%blocks(2)%z = [2.0_wp]
      call estimate_cost(other, with_points)
      call suite%close_to(with_points%bytes - cost%bytes, 4*600*300.0_wp, 1.0e-6_wp, "memory of points below the surface")
      spec%motion = motion%none
      normal = seconds(spec, 100)
      call suite%close_to(seconds(spec, 200)/normal, 4.0_wp, 1.0e-9_wp, "pressures: by elements")
      ! a million elements take seconds, not milliseconds or hours
      call suite%close_to(seconds(spec, 1000), 5.0_wp, 4.5_wp, "pressures: order of magnitude")
      do kind = 1, 4
         other = spec
         other%classical = .true.
         select case (kind)
         case (1); other%motion = motion%shift
         case (2); other%motion = motion%steady_rolling
         case (3); other%motion = motion%steady_rolling; other%solver = solver_choice%gauss_seidel
         case (4); other%motion = motion%shift; other%solver = solver_choice%convex_gs
         end select
         tangential = seconds(other, 100) - normal
         if (kind >= 3) then
            ! the default solver instead of a classical one
            other%classical = .false.
            call suite%close_to((seconds(other, 200) - 4.0_wp*normal)/(seconds(other, 100) - normal), 4.0_wp, 1.0e-9_wp, &
               & "instead of a classical one")
            other%classical = .true.
         end if
         call suite%check(tangential > normal, "tractions take more than pressures")
         call suite%close_to((seconds(other, 200) - 4.0_wp*normal)/tangential, merge(4.0_wp, 8.0_wp, kind <= 2), 1.0e-9_wp, &
            & "tractions: how they grow")
         other%friction_law = friction_model%exponential
         call suite%close_to((seconds(other, 100) - normal)/tangential, 1.7_wp, 1.0e-9_wp, "friction that changes with slip")
         other%friction_law = friction_model%coulomb
         other%material%gg = [82000.0_wp, 8000.0_wp]
         other%iteration%maxout = 2
         call suite%close_to(seconds(other, 100)/(seconds(spec, 100) + tangential), 2.0_wp, 1.0e-9_wp, "turns of dissimilar bodies")
         other%iteration%maxout = 100
         call suite%close_to(seconds(other, 100)/(seconds(spec, 100) + tangential), 2.0_wp, 1.0e-9_wp, "no more than two turns")
         other%iteration%maxout = 1
         call suite%close_to(seconds(other, 100)/(seconds(spec, 100) + tangential), 1.0_wp, 1.0e-9_wp, "one turn")
      end do
      other = spec
      other%motion = motion%steady_rolling
      tangential = seconds(other, 100) - normal
      other%material_model = material_model%viscoelastic
      call suite%close_to((seconds(other, 100) - normal)/tangential, 2.8_wp, 1.0e-9_wp, "bodies that relax")
      ! values of a profile are read by the case that gives them
      other = spec
      allocate(other%geometry%profile(2000), source=0.0_wp)
      call suite%close_to(seconds(other, 100) - normal, 3.5e-3_wp, 1.0e-9_wp, "a profile")
      other%parts%geometry = part_source%kept
      call suite%close_to(seconds(other, 100), normal, 1.0e-12_wp, "a profile of a case before")
      other = spec
      other%solver = solver_choice%gauss_seidel
      other%material%gg = [82000.0_wp, 8000.0_wp]
      other%iteration%maxout = 5
      call suite%close_to(seconds(other, 100), normal, 1.0e-12_wp, "without motion there are no turns")
      spec%solve = .false.
      call estimate_cost(spec, cost)
      call suite%check(cost%elements == 0 .and. cost%bytes <= 0.0_wp, "input that is only noted")
      call suite%close_to(cost%seconds, 1.0e-4_wp, 1.0e-12_wp, "time of input that is only noted")
   end subroutine contact_problems

   !> A ball of 400 mm radius, its Hertzian contact with a quarter more on each side
   subroutine wheel_and_rail(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec
      type(case_cost) :: cost, finer, approach
      real(wp) :: a

      allocate(spec%wheel_rail)
      spec%material%poiss = 0.28_wp
      spec%material%gg = 82000.0_wp
      spec%normal = normal_control%force
      spec%wheel_rail%wheelset%fz = 1.0e5_wp
      spec%wheel_rail%search%dx = 0.4_wp
      spec%wheel_rail%search%ds = 0.1_wp
      call estimate_cost(spec, cost)
      ! a**3 = 3 F R/(4 E*), E* = G/(1 - nu) for two bodies of the same kind
      a = (0.75_wp*1.0e5_wp*400.0_wp*(1.0_wp - 0.28_wp)/82000.0_wp)**(1.0_wp/3.0_wp)
      call suite%check(abs(cost%elements - (2.5_wp*a)**2/(0.4_wp*0.1_wp)) <= 1.0_wp .and. .not. cost%at_most, "elements of a patch")
      call suite%check(cost%seconds > 2.1e-3_wp, "time of the search")
      spec%wheel_rail%new_wheel_profile = .true.
      call estimate_cost(spec, finer)
      call suite%close_to(finer%seconds - cost%seconds, 3.5e-3_wp, 1.0e-9_wp, "files of profiles")
      spec%wheel_rail%new_wheel_profile = .false.
      spec%wheel_rail%search%dx = 0.2_wp
      call estimate_cost(spec, finer)
      call suite%close_to(real(finer%elements, wp)/cost%elements, 2.0_wp, 1.0e-3_wp, "finer elements")
      call suite%close_to(finer%bytes/finer%elements, real(bytes_per_element, wp), 1.0e-9_wp, "memory", relative=.true.)
      spec%iteration%npot_max = 1000
      call estimate_cost(spec, cost)
      call suite%check(cost%elements == 1000 .and. cost%at_most, "no more than NPOT_MAX")
      spec%normal = normal_control%approach
      call estimate_cost(spec, approach)
      call suite%check(approach%elements == 1000 .and. approach%at_most, "without a force the size is not known")
      ! two trials
      call suite%close_to((cost%seconds - 9.0e-4_wp)/(approach%seconds - 9.0e-4_wp), 3.0_wp, 1.0e-6_wp, "trials for a force")
      ! steps of transient rolling: elements are fixed to the rail, independent of NPOT_MAX, up to the limit of refusal
      spec%normal = normal_control%force
      spec%motion = motion%transient_rolling
      spec%iteration%npot_max = 5000
      call estimate_cost(spec, cost)
      call suite%check(cost%elements == finer%elements .and. cost%beyond_most .and. .not. cost%at_most, "steps beyond NPOT_MAX")
      spec%iteration%npot_max = 100
      call estimate_cost(spec, cost)
      call suite%check(cost%elements == 1000 .and. cost%beyond_most .and. cost%at_most, "steps far beyond NPOT_MAX")
   end subroutine wheel_and_rail

   !> The speed of the machine: measured once, positive, and not off by orders of magnitude on any machine of today
   subroutine pace(suite)
      type(test_suite), intent(inout) :: suite
      real(wp) :: first

      first = machine_pace()
      call suite%check(first > 0.02_wp .and. first < 200.0_wp, "pace of the machine")
      call suite%close_to(machine_pace(), first, 0.0_wp, "measured once")
   end subroutine pace

   subroutine words(suite)
      type(test_suite), intent(inout) :: suite

      call suite%equal(trim(cost_text(case_cost(elements=600, bytes=2.5e6_wp, seconds=0.0123_wp), 1.0_wp)), &
         & "about 600 elements, 3 MB, 0.012 s", "small")
      call suite%equal(trim(cost_text(case_cost(elements=7, bytes=0.0_wp, seconds=2.0e-4_wp), 2.0_wp)), &
         & "about 7 elements, 1 MB, 0.00040 s", "a machine that takes twice as long")
      call suite%equal(trim(cost_text(case_cost(elements=20000, at_most=.true., bytes=1.2e9_wp, seconds=12.4_wp), 1.0_wp)), &
         & "at most 20000 elements, 1201 MB, 12 s", "large")
      call suite%equal(trim(cost_text(case_cost(elements=7, bytes=0.0_wp, seconds=1.0_wp), 1.0_wp)), &
         & "about 7 elements, 1 MB, 1 s", "one second")
      call suite%equal(trim(cost_text(case_cost(elements=7, bytes=0.0_wp, seconds=3.0e7_wp), 1.0_wp)), &
         & "about 7 elements, 1 MB, 3.E+07 s", "a year")
      call suite%equal(trim(cost_text(case_cost(elements=63744, bytes=9.5e7_wp, seconds=4.0_wp, beyond_most=.true.), 1.0_wp)), &
         & "about 63744 elements, 96 MB, 4 s: more elements than NPOT_MAX, which are not enlarged in shifts and transient " // &
         & "rolling; larger DX and DS make it quick", "more than NPOT_MAX")
   end subroutine words
end program test_estimate
