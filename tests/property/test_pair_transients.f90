!> Shifts and transient rolling of wheel on rail: limits, equalities, repeated and mirrored steps
program test_pair_transients
   use contact_base_choices, only : motion, time_link
   use contact_base_kinds, only : wp
   use contact_test_files, only : write_file
   use contact_test_harness, only : environment, test_suite
   use contact_test_pair_builder, only : ball_case, pair_case, railway_case
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("pair transients")
   call hertz()
   call shift_is_rolling()
   call rolling_becomes_steady()
   call steady_is_continued()
   call links()
   call mirrored()
   call slices()
   call suite%finish()

contains

   !> A ball on a plane against Hertz's theory: the error decreases with the element size
   subroutine hertz()
      type(pair_case) :: pair
      real(wp), parameter :: pen = 0.16_wp, radius = 100.0_wp, modulus = 200.0_wp/(1.0_wp - 0.28_wp)
      real(wp) :: theory, error(2)
      integer :: k

      theory = 4.0_wp/3.0_wp*modulus*sqrt(radius)*pen**1.5_wp
      do k = 1, 2
         pair%spec = ball_case(pen)
         pair%spec%motion = motion%none
         pair%spec%wheel_rail%search%dx = 0.8_wp/k
         pair%spec%wheel_rail%search%ds = 0.8_wp/k
         call pair%run(suite, "ball")
         error(k) = abs(pair%result%force_track(3)/theory - 1.0_wp)
      end do
      call suite%check(error(1) < 5.0e-3_wp .and. error(2) < 1.5e-3_wp, "the force is that of Hertz's theory")
      call pair%release()
   end subroutine hertz

   !> Increments of a shift that are those of a step of rolling
   subroutine shift_is_rolling()
      type(pair_case) :: rolling, shifting
      real(wp) :: scale
      integer :: step

      rolling%spec = ball_case(0.1_wp)
      rolling%spec%motion = motion%transient_rolling
      rolling%spec%wheel_rail%wheelset%vpitch = -0.99_wp
      shifting%spec = rolling%spec
      shifting%spec%motion = motion%shift
      associate (w => shifting%spec%wheel_rail%wheelset)
         ! displacements of a step of one element, at the mean of the speeds of wheel and circumference
         scale = 0.5_wp/(0.5_wp*(100.0_wp + 0.99_wp*(100.0_wp - 0.1_wp)))
         w%vs = 100.0_wp*scale
         w%vpitch = -0.99_wp*scale
      end associate
      do step = 1, 8
         shifting%spec%wheel_rail%wheelset%s = 0.5_wp*step
         call rolling%run(suite, "rolling")
         call shifting%run(suite, "shift")
         call suite%close_to(shifting%result%force_track(1), rolling%result%force_track(1), &
            & 2.0e-3_wp*abs(rolling%result%force_track(1)), "a shift by an element is a step of rolling")
         rolling%spec%link = time_link%continue_all
         shifting%spec%link = time_link%continue_all
      end do
      call suite%check(abs(rolling%result%force_track(1)) > 1.0_wp, "the force builds up")
      call rolling%release()
      call shifting%release()
   end subroutine shift_is_rolling

   !> Transient rolling with constant creepage ends in steady rolling
   subroutine rolling_becomes_steady()
      type(pair_case) :: steady, rolling
      integer :: step, k

      steady%spec = railway_case(2.0_wp, 0.004_wp)
      call steady%run(suite, "steady rolling")
      rolling%spec = steady%spec
      rolling%spec%motion = motion%transient_rolling
      do step = 1, 50
         call rolling%run(suite, "transient rolling")
         rolling%spec%link = time_link%continue_all
      end do
      do k = 1, 3
         call suite%close_to(rolling%result%force_track(k), steady%result%force_track(k), 60.0_wp, "transient becomes steady")
      end do
      call steady%release()
      call rolling%release()
   end subroutine rolling_becomes_steady

   !> A steady state that is continued in steps or by shifts does not change
   subroutine steady_is_continued()
      type(pair_case) :: pair
      real(wp) :: steady
      integer :: kind, step

      do kind = motion%shift, motion%transient_rolling
         pair%spec = ball_case(0.1_wp)
         call pair%run(suite, "steady ball")
         steady = pair%result%force_track(1)
         pair%spec%motion = kind
         pair%spec%link = time_link%continue_all
         do step = 1, 3
            associate (w => pair%spec%wheel_rail%wheelset)
               w%s = 0.5_wp*step
               if (kind == motion%shift) then
                  w%vs = 0.5_wp
                  w%vpitch = -0.996_wp*0.5_wp/100.0_wp
               end if
            end associate
            call pair%run(suite, "continued ball")
            call suite%close_to(pair%result%force_track(1), steady, 5.0e-3_wp*abs(steady), "a steady state is continued")
         end do
         call suite%check(all(pair%result%patches(1)%previous == [1]), "the patch continues the only one")
      end do
      call pair%release()
   end subroutine steady_is_continued

   !> P = 3 repeats a step, P = 2 starts a new sequence, P = 1 drops the tangential tractions
   subroutine links()
      type(pair_case) :: pair
      real(wp) :: first, second

      pair%spec = ball_case(0.1_wp)
      pair%spec%motion = motion%transient_rolling
      call pair%run(suite, "first step")
      first = pair%result%force_track(1)
      pair%spec%link = time_link%continue_all
      call pair%run(suite, "second step")
      second = pair%result%force_track(1)
      call suite%check(abs(second) > 1.5_wp*abs(first), "the second step continues")
      pair%spec%link = time_link%repeat_step
      call pair%run(suite, "second step again")
      call suite%close_to(pair%result%force_track(1), second, 1.0e-12_wp*abs(second), "a step is repeated")
      pair%spec%link = time_link%continue_normal
      call pair%run(suite, "pressures only")
      call suite%close_to(pair%result%force_track(1), first, 1.0e-6_wp*abs(first), "tangential tractions are forgotten")
      pair%spec%link = time_link%initiate
      call pair%run(suite, "a new sequence")
      call suite%close_to(pair%result%force_track(1), first, 1.0e-12_wp*abs(first), "a new sequence begins without tractions")
      call suite%check(size(pair%result%patches(1)%previous) == 0, "its patch is new")
      call pair%release()
   end subroutine links

   !> The left side is the mirror image of the right one
   subroutine mirrored()
      type(pair_case) :: right, left
      integer :: step

      right%spec = railway_case(5.5_wp, 0.006_wp)
      right%spec%motion = motion%shift
      associate (w => right%spec%wheel_rail%wheelset)
         w%vs = 0.5_wp
         w%vpitch = -0.5_wp*1.002_wp/460.0_wp
      end associate
      left%spec = right%spec
      left%spec%wheel_rail%left = .true.
      left%spec%wheel_rail%wheelset%y = -5.5_wp
      left%spec%wheel_rail%wheelset%yaw = -0.006_wp
      do step = 1, 3
         right%spec%wheel_rail%wheelset%s = 0.37_wp*step
         left%spec%wheel_rail%wheelset%s = 0.37_wp*step
         call right%run(suite, "right")
         call left%run(suite, "left")
         call suite%check(all(abs(left%result%force_track - right%result%force_track) <= 0.0_wp), &
            & "left is the mirror image of right, bit by bit")
         right%spec%link = time_link%continue_all
         left%spec%link = time_link%continue_all
      end do
      call right%release()
      call left%release()
   end subroutine mirrored

   !> A rail of equal slices is the prismatic rail, step by step
   subroutine slices()
      type(pair_case) :: prismatic, sliced
      character(len=*), parameter :: nl = new_line("a")
      character(len=:), allocatable :: text, file
      character(len=12) :: place
      integer :: step, k

      file = environment("CONTACT_SOURCE") // "/examples/profiles/60E1.prr"
      text = "0 1 U_OFFSET" // nl // "6" // nl // "0 0 0" // nl // "1" // nl
      do k = 1, 6
         write(place, "(f12.3)") -200.0_wp + 80.0_wp*(k - 1)
         text = text // place // " '" // file // "'" // nl
      end do
      call write_file("equal.slcs", text)
      prismatic%spec = railway_case(0.0_wp, 0.002_wp)
      prismatic%spec%motion = motion%transient_rolling
      prismatic%spec%wheel_rail%track%gaught = -1.0_wp
      prismatic%spec%wheel_rail%track%raily0 = 755.0_wp
      sliced%spec = prismatic%spec
      sliced%spec%wheel_rail%rail_profile%name = "equal.slcs"
      do step = 1, 2
         call prismatic%run(suite, "prismatic rail")
         call sliced%run(suite, "rail of slices")
         do k = 1, 3
            call suite%close_to(sliced%result%force_track(k), prismatic%result%force_track(k), 6.0_wp, &
               & "equal slices are a prismatic rail")
         end do
         prismatic%spec%link = time_link%continue_all
         sliced%spec%link = time_link%continue_all
      end do
      call prismatic%release()
      call sliced%release()
   end subroutine slices
end program test_pair_transients
