!> Search for the height of a wheel: smooth forces, kinks, jumps, folds, and forces out of reach
program test_force_balance
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use contact_base_kinds, only : wp
   use contact_test_harness, only : test_suite
   use contact_wheelrail_force_balance, only : balance_ending, force_balance
   implicit none (type, external)
   !> Shapes of the force as a function of the penetration
   integer, parameter :: hertz = 1, second_patch = 2, jump_down = 3, jump_up = 4, fold = 5, bounded = 6, broken = 7, &
      & carried = 8, flank = 9
   type(test_suite) :: suite
   real(wp) :: target, slope
   integer :: k

   call suite%start("force balance")
   do k = -3, 6
      target = 10.0_wp**k
      call reaches(suite, hertz, target, 0.1_wp, .true., 5)
      call reaches(suite, hertz, target, 0.1_wp, .false., 14)
      call reaches(suite, hertz, target, 1.0e-6_wp, .false., 25)
      ! a first trial close to the height determines it
      call reaches(suite, hertz, target, 0.997_wp*(1.0e-5_wp*target)**(2.0_wp/3.0_wp), .false., 2)
      call reaches(suite, second_patch, target, 0.02_wp, .true., 9)
      call reaches(suite, second_patch, target, 0.02_wp, .false., 16)
      call reaches(suite, jump_up, 1.0e3_wp*target, 0.1_wp, .false., 60)
   end do
   ! next to the height that is sought, on both sides of it: steps are not made longer than Newton's method wants
   call force_at(second_patch, 0.2_wp, target, slope)
   do k = -3, 3
      if (k /= 0) call reaches(suite, second_patch, target, 0.2_wp*(1.0_wp + sign(10.0_wp**(-1 - abs(k)), real(k, wp))), .true., 3)
      if (k /= 0) call reaches(suite, second_patch, target, 0.2_wp*(1.0_wp + sign(10.0_wp**(-1 - abs(k)), real(k, wp))), .false., 7)
   end do
   call reaches(suite, fold, 5.0e3_wp, 0.1_wp, .false., 40)
   do k = 0, 3
      call reaches(suite, carried, 10.0_wp**k, 0.05_wp, .true., 24)
   end do
   do k = 2, 5
      call reaches(suite, flank, 10.0_wp**k, 0.02_wp, .true., 11)
   end do
   call over_a_jump(suite)
   call jump_with_slopes(suite)
   call jump_with_stiffness(suite)
   call out_of_reach(suite)
   call suite%finish()

contains

   !> Force [N] and slope [N/mm] at a penetration [mm]
   pure subroutine force_at(shape, d, force, slope)
      integer, intent(in) :: shape
      real(wp), intent(in) :: d
      real(wp), intent(out) :: force, slope

      force = 1.0e5_wp*max(0.0_wp, d)**1.5_wp
      slope = 1.5e5_wp*sqrt(max(0.0_wp, d))
      select case (shape)
      case (second_patch)
         force = force + 3.0e5_wp*max(0.0_wp, d - 0.05_wp)**1.5_wp
         slope = slope + 4.5e5_wp*sqrt(max(0.0_wp, d - 0.05_wp))
      case (jump_down)
         if (d > 0.1_wp) force = force - 1.0e3_wp
      case (jump_up)
         if (d > 0.1_wp) force = force + 1.0e3_wp
      case (fold)
         force = force + 2.0e3_wp*sin(60.0_wp*d)
      case (bounded)
         force = 1.0e3_wp*tanh(max(0.0_wp, d))
      case (carried)
         ! friction lifts the wheel until a flank is in contact; slopes neglect the rotation of the flank
         force = -4.0e3_wp*d + 2.0e7_wp*max(0.0_wp, d - 0.2_wp)**2.5_wp
         slope = -4.0e3_wp + 1.5e7_wp*max(0.0_wp, d - 0.2_wp)**1.5_wp
      case (flank)
         ! a climbing wheel: the slope of the force increases, and the estimated slopes are a quarter of the true ones
         force = 2.0e3_wp*(exp(10.0_wp*max(0.0_wp, d)) - 1.0_wp)
         slope = 5.0e3_wp*exp(10.0_wp*max(0.0_wp, d))
      case (broken)
         force = 0.0_wp
         if (d > 0.1_wp) force = ieee_value(force, ieee_quiet_nan)
      end select
   end subroutine force_at

   !> Run a search
   subroutine search(shape, target, guess, with_slope, most, estimated, balance, with_stiffness)
      integer, intent(in) :: shape
      real(wp), intent(in) :: target, guess
      logical, intent(in) :: with_slope
      integer, intent(in) :: most
      logical, intent(in) :: estimated
      type(force_balance), intent(inout) :: balance
      !> Is the slope passed as an estimate by the stiffness?
      logical, intent(in), optional :: with_stiffness
      real(wp), parameter :: touch = 0.7_wp
      real(wp) :: z, force, slope, stiffness

      call balance%start(target, 1.0e-8_wp, touch, 500.0_wp, most, estimated)
      do while (balance%ended == balance_ending%running)
         z = balance%next_trial(touch + guess)
         call force_at(shape, z - touch, force, slope)
         stiffness = 0.0_wp
         if (present(with_stiffness)) stiffness = merge(slope, 0.0_wp, with_stiffness)
         if (.not. with_slope) slope = 0.0_wp
         call balance%record(z, force, slope, merge(2, 1, z > touch + 0.1_wp), stiffness)
      end do
   end subroutine search

   subroutine reaches(suite, shape, target, guess, with_slope, most)
      type(test_suite), intent(inout) :: suite
      integer, intent(in) :: shape
      real(wp), intent(in) :: target, guess
      logical, intent(in) :: with_slope
      integer, intent(in) :: most
      type(force_balance) :: balance
      character(len=60) :: what
      real(wp) :: force, slope

      call search(shape, target, guess, with_slope, most, .false., balance)
      call force_at(shape, balance%z - 0.7_wp, force, slope)
      write(what, "(a,i0,a,es9.2,a,i0,a,i0)") "shape ", shape, ", force ", target, ": trials ", balance%trials, ", ended ", &
         & balance%ended
      if (shape == jump_up .and. target > 1.0e5_wp*0.1_wp**1.5_wp .and. target < 1.0e5_wp*0.1_wp**1.5_wp + 1.0e3_wp) then
         call suite%check(balance%ended == balance_ending%jump, trim(what) // ", inside the jump")
         return
      end if
      call suite%check(balance%ended == balance_ending%reached, trim(what))
      call suite%close_to(force, target, 2.0e-8_wp, trim(what) // ", the force", relative=.true.)
   end subroutine reaches

   !> The prescribed force lies in a downward jump: both branches have solutions, one is found
   subroutine over_a_jump(suite)
      type(test_suite), intent(inout) :: suite
      type(force_balance) :: balance

      call search(jump_down, 1.0e5_wp*0.1_wp**1.5_wp - 5.0e2_wp, 0.2_wp, .false., 40, .false., balance)
      call suite%check(balance%ended == balance_ending%reached, "two solutions: one is found")
      call search(jump_up, 1.0e5_wp*0.1_wp**1.5_wp + 3.0e2_wp, 0.2_wp, .false., 80, .false., balance)
      call suite%check(balance%ended == balance_ending%jump, "a force inside an upward jump is stated")
      call suite%close_to(balance%z, 0.8_wp, 1.0e-9_wp, "with the position of the jump")
      call suite%close_to(balance%force, 1.0e5_wp*0.1_wp**1.5_wp, 1.0_wp, "and the closer side")
   end subroutine over_a_jump

   !> Where the stiffness of the contact is known, a jump is distinguished from a steep slope, and is found in few trials
   subroutine jump_with_slopes(suite)
      type(test_suite), intent(inout) :: suite
      type(force_balance) :: balance
      real(wp), parameter :: foot = 1.0e5_wp*0.1_wp**1.5_wp
      integer :: k

      do k = 1, 9
         call search(jump_up, foot + 1.0e2_wp*k, 0.03_wp*k, .true., 28, .false., balance)
         call suite%check(balance%ended == balance_ending%jump, "an upward jump is found in 28 trials")
         call suite%check(balance%low%z <= 0.8_wp .and. balance%high%z > 0.8_wp .and. balance%high%z - balance%low%z < 1.1e-6_wp, &
            & "the position of the jump is within a narrow bracket")
         call suite%close_to(balance%low%force, foot, 1.0_wp, "force below the jump")
         call suite%close_to(balance%high%force, foot + 1.0e3_wp, 1.0_wp, "force above it")
         call suite%check(balance%low%patches == 1 .and. balance%high%patches == 2, "patches on both sides")
         ! forces that are only estimated: the caller is requested to compute them accurately before the position is refined
         call search(jump_up, foot + 1.0e2_wp*k, 0.03_wp*k, .true., 28, .true., balance)
         call suite%check(balance%ended == balance_ending%jump .and. balance%trials < 15, "a suspected jump ends the search early")
      end do
      ! a second patch that is much stiffer than the first one is not a jump
      call search(second_patch, 3.0e3_wp, 0.02_wp, .true., 12, .true., balance)
      call suite%check(balance%ended == balance_ending%reached, "a kink is not a jump")
   end subroutine jump_with_slopes

   !> Where only an estimate of the slope is known, a jump is found before the limit of trials
   subroutine jump_with_stiffness(suite)
      type(test_suite), intent(inout) :: suite
      type(force_balance) :: balance
      real(wp), parameter :: foot = 1.0e5_wp*0.1_wp**1.5_wp
      integer :: k

      do k = 1, 9
         call search(jump_up, foot + 1.0e2_wp*k, 0.03_wp*k, .false., 60, .false., balance, with_stiffness=.true.)
         call suite%check(balance%ended == balance_ending%jump .and. balance%trials < 50, "a jump is found by the stiffness")
         call suite%check(balance%high%z - balance%low%z < 1.1e-9_wp, "within a narrower bracket")
      end do
   end subroutine jump_with_stiffness

   subroutine out_of_reach(suite)
      type(test_suite), intent(inout) :: suite
      type(force_balance) :: balance

      call search(bounded, 2.0e3_wp, 0.1_wp, .false., 60, .false., balance)
      call suite%check(balance%ended == balance_ending%out_of_reach, "a force that is never reached")
      call search(broken, 1.0e3_wp, 0.05_wp, .false., 60, .false., balance)
      call suite%check(balance%ended == balance_ending%out_of_reach, "a force that is not a number")
      call search(second_patch, 1.0e4_wp, 0.02_wp, .false., 2, .false., balance)
      call suite%check(balance%ended == balance_ending%trial_limit, "too few trials")
   end subroutine out_of_reach
end program test_force_balance
