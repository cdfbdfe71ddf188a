!> Forces that are prescribed for wheel on rail: a longitudinal one (F = 1), and a rail on springs (F = 3)
program test_pair_forces
   use contact_base_case_status, only : missed_iteration
   use contact_base_choices, only : force_control, motion, normal_control, time_link
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_cases_wheel_rail_accuracy, only : solve_wheel_on_rail
   use contact_test_harness, only : test_suite
   use contact_test_pair_builder, only : pair_case, railway_case
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("pair forces")
   call quiet_trials()
   call geometry_alone()
   call stiff_springs()
   call soft_springs()
   call springs_at_height()
   call free_rail()
   call rail_out_of_reach()
   call longitudinal_force()
   call beyond_friction()
   call nothing_to_pull()
   call pull_in_steps()
   call asked_accuracy(force_control%creepages)
   call asked_accuracy(force_control%longitudinal_force)
   call suite%finish()

contains

   !> Heights that are tried on the way do not warn, the one at which the force acts does
   subroutine quiet_trials()
      type(pair_case) :: pair, strict
      type(error_type), allocatable :: error
      integer :: k, failures

      ! Two passes between pressures and tractions are too few for the first height, and enough from the last but one on
      pair%spec = railway_case(0.0_wp, 0.0_wp)
      pair%spec%iteration%eps = 1.0e-5_wp
      pair%spec%material%gg = [82000.0_wp, 20000.0_wp]
      pair%spec%iteration%maxout = 2
      strict%spec = pair%spec
      strict%spec%normal = normal_control%approach
      call pair%run(suite, "quiet trials")
      call suite%equal(pair%log%warnings, 0, "warnings of heights that were only tried")
      strict%spec%wheel_rail%wheelset%z = pair%result%z_ws
      call strict%try(error)
      call suite%check(.not. allocated(error) .and. strict%result%status%iteration == missed_iteration%outer, &
         & "two passes are too few from scratch")
      call suite%equal(strict%log%warnings, 1, "and that is reported once")
      ! Pressures that do not converge: reported once for each contact patch
      pair%spec%iteration%maxgs = 1
      pair%spec%motion = motion%none
      call pair%try(error)
      call suite%check(.not. allocated(error), "unconverged pressures are not an error")
      failures = 0
      do k = 1, size(pair%result%patches)
         if (.not. pair%result%patches(k)%contact%normal%succeeded()) failures = failures + 1
      end do
      call suite%check(failures > 0 .and. pair%result%force_evaluations > 1, "pressures are unfinished in several trials")
      call suite%check(pair%result%status%iteration == missed_iteration%normal, "the status has the cause")
      ! and once for a force that is not met within EPS
      if (abs(pair%result%force_error) > pair%spec%iteration%eps*pair%spec%wheel_rail%wheelset%fz) failures = failures + 1
      call suite%equal(pair%log%warnings, failures, "warnings of the last height only")
      call pair%release()
      call strict%release()
   end subroutine quiet_trials

   !> A case without computation has about the height of the force, and no missed force
   subroutine geometry_alone()
      type(pair_case) :: solved, skipped

      solved%spec = railway_case(0.0_wp, 0.0_wp)
      call solved%run(suite, "solved")
      skipped%spec = solved%spec
      skipped%spec%solve = .false.
      call skipped%run(suite, "geometry alone")
      call suite%equal(skipped%log%warnings, 0, "geometry alone: no warning")
      call suite%equal(size(skipped%result%patches), 1, "geometry alone: its patch")
      call suite%close_to(skipped%result%z_ws, solved%result%z_ws, 0.03_wp, "geometry alone: height")
      call solved%release()
      call skipped%release()
   end subroutine geometry_alone

   !> Very stiff springs have no effect
   subroutine stiff_springs()
      type(pair_case) :: fixed, sprung
      real(wp), parameter :: y(2) = [0.0_wp, 6.5_wp]
      integer :: k, i

      do k = 1, 2
         fixed%spec = railway_case(y(k), 0.004_wp)
         call fixed%run(suite, "fixed rail")
         sprung%spec = fixed%spec
         sprung%spec%force = force_control%massless_rail
         sprung%spec%wheel_rail%rail%ky = 1.0e9_wp
         sprung%spec%wheel_rail%rail%kz = 1.0e9_wp
         call sprung%run(suite, "stiff springs")
         do i = 1, 3
            call suite%close_to(sprung%result%force_track(i), fixed%result%force_track(i), 6.0_wp, "stiff springs: force")
         end do
         call suite%close_to(sprung%result%z_ws, fixed%result%z_ws, 1.0e-3_wp, "stiff springs: height")
      end do
      call fixed%release()
      call sprung%release()
   end subroutine stiff_springs

   !> Springs balance the contact and the static forces; left is the mirror image of right
   subroutine soft_springs()
      type(pair_case) :: right, left

      right%spec = railway_case(3.0_wp, 0.002_wp)
      right%spec%force = force_control%massless_rail
      right%spec%wheel_rail%rail%ky = 5000.0_wp
      right%spec%wheel_rail%rail%fy = 700.0_wp
      right%spec%wheel_rail%rail%kz = 50000.0_wp
      right%spec%wheel_rail%rail%fz = -9000.0_wp
      call right%run(suite, "springs")
      associate (r => right%result, rail => right%spec%wheel_rail%rail)
         call suite%close_to(rail%ky*r%dy_defl, r%force_track(2) + rail%fy, 1.0_wp, "lateral balance")
         call suite%close_to(rail%kz*r%dz_defl, r%force_track(3) + rail%fz, 1.0_wp, "vertical balance")
         call suite%close_to(r%force_track(3), 60000.0_wp, 0.1_wp, "vertical force")
         call suite%check(abs(r%dy_defl) > 0.1_wp .and. r%dz_defl > 1.0_wp, "the rail gives way")
      end associate
      left%spec = right%spec
      left%spec%wheel_rail%left = .true.
      left%spec%wheel_rail%wheelset%y = -3.0_wp
      left%spec%wheel_rail%wheelset%yaw = -0.002_wp
      left%spec%wheel_rail%rail%fy = -700.0_wp
      call left%run(suite, "springs, left side")
      call suite%close_to(left%result%dy_defl, right%result%dy_defl, tiny(1.0_wp), "the left rail deflects as the mirror image")
      call suite%close_to(left%result%z_ws, right%result%z_ws, tiny(1.0_wp), "the left wheel is as high")
      call right%release()
      call left%release()
   end subroutine soft_springs

   !> The height of the wheelset is prescribed: contact and spring divide it
   subroutine springs_at_height()
      type(pair_case) :: fixed, sprung, again

      fixed%spec = railway_case(0.0_wp, 0.0_wp)
      call fixed%run(suite, "60 kN")
      sprung%spec = fixed%spec
      sprung%spec%normal = normal_control%approach
      sprung%spec%force = force_control%massless_rail
      sprung%spec%wheel_rail%rail%ky = 1.0e9_wp
      sprung%spec%wheel_rail%rail%kz = 40000.0_wp
      ! deep enough for the same force, with a spring that has given way by 1.5 mm
      sprung%spec%wheel_rail%wheelset%z = fixed%result%z_ws + 1.5_wp
      call sprung%run(suite, "spring below")
      call suite%close_to(sprung%result%force_track(3), 60000.0_wp, 6.0_wp, "the spring carries what the contact carries")
      call suite%close_to(sprung%result%dz_defl, 1.5_wp, 2.0e-4_wp, "the spring gives way")
      call suite%close_to(sprung%result%z_ws, fixed%result%z_ws + 1.5_wp, 1.0e-12_wp, "the height is the prescribed one")
      ! a wheel above the rail, separated by a static force
      again%spec = sprung%spec
      again%spec%wheel_rail%rail%fz = 1.0e6_wp
      call again%run(suite, "rail pulled away")
      call suite%check(size(again%result%patches) == 0, "the rail is pulled away from the wheel")
      call suite%close_to(again%result%dz_defl, 25.0_wp, 1.0e-9_wp, "by the static force alone")
      call fixed%release()
      call sprung%release()
      call again%release()
   end subroutine springs_at_height

   !> A rail without lateral stiffness moves to the position without lateral force, for any position of the wheelset
   subroutine free_rail()
      type(pair_case) :: pair
      real(wp) :: place(2)
      integer :: k

      do k = 1, 2
         pair%spec = railway_case(4.0_wp*(k - 1), 0.002_wp)
         pair%spec%force = force_control%massless_rail
         pair%spec%wheel_rail%rail%ky = 0.0_wp
         pair%spec%wheel_rail%rail%kz = 0.0_wp
         call pair%run(suite, "free rail")
         call suite%close_to(pair%result%force_track(2), 0.0_wp, 6.0_wp, "no lateral force")
         place(k) = pair%result%dy_defl - 4.0_wp*(k - 1)
      end do
      call suite%close_to(place(2), place(1), 2.0e-3_wp, "the rail moves with the wheelset")
      call pair%release()
   end subroutine free_rail

   !> A free rail on which a larger force acts than the contact can hold
   subroutine rail_out_of_reach()
      type(pair_case) :: pair
      type(error_type), allocatable :: error

      pair%spec = railway_case(0.0_wp, 0.0_wp)
      pair%spec%force = force_control%massless_rail
      pair%spec%wheel_rail%rail%ky = 0.0_wp
      pair%spec%wheel_rail%rail%fy = 1.0e6_wp
      pair%spec%wheel_rail%search%dx = 1.0_wp
      pair%spec%wheel_rail%search%ds = 1.0_wp
      call pair%try(error)
      call suite%check(.not. allocated(error) .and. .not. pair%result%status%is_solved() .and. pair%log%warnings > 0, &
         & "a lateral force out of reach ends with a warning")
      call pair%release()
   end subroutine rail_out_of_reach

   !> The pitch rate that is found gives the force
   subroutine longitudinal_force()
      type(pair_case) :: sought, given
      real(wp), parameter :: fx(3) = [0.0_wp, 8000.0_wp, -15000.0_wp]
      integer :: k

      do k = 1, 3
         sought%spec = railway_case(5.0_wp, 0.004_wp)
         sought%spec%force = force_control%longitudinal_force
         sought%spec%wheel_rail%wheelset%fx = fx(k)
         call sought%run(suite, "longitudinal force")
         call suite%close_to(sought%result%force_wheelset(1), fx(k), 0.2_wp, "the force is reached")
         given%spec = sought%spec
         given%spec%force = force_control%creepages
         given%spec%wheel_rail%wheelset%vpitch = sought%result%vpitch
         call given%run(suite, "its pitch rate")
         call suite%close_to(given%result%force_wheelset(1), fx(k), 2.0_wp, "the pitch rate gives the force")
         call suite%close_to(given%result%force_wheelset(3), sought%result%force_wheelset(3), 1.0_wp, "the same vertical force")
      end do
      ! the same at a given height
      sought%spec%normal = normal_control%approach
      sought%spec%wheel_rail%wheelset%z = given%result%z_ws
      call sought%run(suite, "longitudinal force at a height")
      call suite%close_to(sought%result%vpitch, given%spec%wheel_rail%wheelset%vpitch, 1.0e-3_wp, "the same at a given height")
      call sought%release()
      call given%release()
   end subroutine longitudinal_force

   !> A force above the friction bound: the search ends with full sliding and reports it
   subroutine beyond_friction()
      type(pair_case) :: pair
      type(error_type), allocatable :: error
      real(wp), parameter :: fx(2) = [40000.0_wp, -22000.0_wp]
      integer :: k

      do k = 1, 2
         pair%spec = railway_case(0.0_wp, 0.0_wp)
         pair%spec%force = force_control%longitudinal_force
         pair%spec%wheel_rail%wheelset%fx = fx(k)
         call pair%try(error)
         call suite%check(.not. allocated(error) .and. .not. pair%result%status%is_solved() .and. pair%log%warnings == k, &
            & "a longitudinal force out of reach ends with a warning")
         call suite%close_to(abs(pair%result%force_wheelset(1)), 0.35_wp*60000.0_wp, 200.0_wp, "with full sliding")
         call suite%check(pair%result%force_wheelset(1)*fx(k) > 0.0_wp, "in the direction of the force")
      end do
      call pair%release()
   end subroutine beyond_friction

   !> No contact, no force
   subroutine nothing_to_pull()
      type(pair_case) :: pair
      type(error_type), allocatable :: error

      pair%spec = railway_case(0.0_wp, 0.0_wp)
      pair%spec%force = force_control%longitudinal_force
      pair%spec%wheel_rail%wheelset%fz = 0.0_wp
      call pair%run(suite, "no load and no force")
      pair%spec%wheel_rail%wheelset%fx = 100.0_wp
      call pair%try(error)
      call suite%check(.not. allocated(error) .and. .not. pair%result%status%is_solved() .and. pair%log%warnings == 1, &
         & "a force without contact is out of reach")
      call pair%release()
   end subroutine nothing_to_pull

   !> In shifts and transient rolling a force is built up in steps
   subroutine pull_in_steps()
      type(pair_case) :: pair
      integer :: step, kind

      do kind = motion%shift, motion%transient_rolling
         pair%spec = railway_case(1.0_wp, 0.0_wp)
         pair%spec%motion = kind
         pair%spec%force = force_control%longitudinal_force
         if (kind == motion%shift) pair%spec%wheel_rail%wheelset%vs = 0.5_wp
         do step = 1, 4
            pair%spec%wheel_rail%wheelset%fx = 3000.0_wp*step
            pair%spec%wheel_rail%wheelset%s = 0.5_wp*step
            call pair%run(suite, "force in steps")
            call suite%close_to(pair%result%force_wheelset(1), 3000.0_wp*step, 0.2_wp, "the force of the step is reached")
            pair%spec%link = time_link%continue_all
         end do
      end do
      call pair%release()
   end subroutine pull_in_steps

   !> With a required accuracy the search for the height starts from that of the elements before: fewer trials give the same result
   subroutine asked_accuracy(force)
      !> Prescribed velocities or a longitudinal force, member of force_control
      integer, intent(in) :: force
      type(pair_case) :: pair, alone
      type(case_spec), allocatable :: solved, as_given
      type(error_type), allocatable :: error
      real(wp) :: within

      pair%spec = railway_case(6.0_wp, 0.004_wp)
      pair%spec%force = force
      pair%spec%wheel_rail%wheelset%fx = 2000.0_wp
      pair%spec%iteration%accuracy = 2.0e-4_wp
      call solve_wheel_on_rail(pair%session, pair%spec, "", pair%log, pair%result, solved, error)
      call suite%check(.not. allocated(error), "a wheel with a required accuracy")
      if (allocated(error)) return
      call suite%check(pair%result%accuracy%levels > 1 .and. pair%result%accuracy%is_met, "two sizes of elements reach it")
      alone%spec = solved
      alone%spec%iteration%accuracy = 0.0_wp
      call solve_wheel_on_rail(alone%session, alone%spec, "", alone%log, alone%result, as_given, error)
      call suite%check(.not. allocated(error), "the last elements alone")
      if (allocated(error)) return
      call suite%check(pair%result%force_evaluations < alone%result%force_evaluations, "fewer trials than from scratch")
      ! searches end within EPS of the total force
      within = 2.0_wp*solved%iteration%eps*pair%spec%wheel_rail%wheelset%fz
      call suite%close_to(pair%result%force_track, alone%result%force_track, within, "the same forces")
      call suite%close_to(pair%result%z_ws, alone%result%z_ws, solved%iteration%eps*0.1_wp, "the same height")
      call suite%check(.not. pair%session%problem%refines, "the next case starts from scratch")
      call pair%release()
      call alone%release()
   end subroutine asked_accuracy
end program test_pair_forces
