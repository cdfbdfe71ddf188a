!> Friction memory: limits of the weight, decay along the path, both directions, order of the method
program test_memory
   use contact_base_kinds, only : wp
   use contact_friction_memory, only : friction_memory
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   real(wp), parameter :: closed = 10.0_wp*epsilon(1.0_wp)
   type(test_suite) :: suite

   call suite%start("friction memory")
   call limits(suite)
   call a_step(suite)
   call directions(suite)
   call order(suite)
   call exact_decay(suite)
   call second_order(suite)
   call bounds_and_mirror(suite)
   call suite%finish()

contains

   subroutine limits(suite)
      type(test_suite), intent(inout) :: suite
      type(friction_memory) :: memory

      call suite%check(.not. memory%acts(), "none by default")
      call suite%close_to(memory%weight(3.0_wp, 0.1_wp), 0.0_wp, 0.0_wp, "without distance there is no memory")
      memory = friction_memory(distance=0.5_wp, lowest_speed=0.0_wp)
      call suite%check(memory%acts(), "a distance acts")
      call suite%close_to(memory%weight(0.0_wp, 0.1_wp), 1.0_wp, closed, "without slip nothing changes")
      call suite%close_to(memory%weight(5.0_wp, 0.1_wp), 0.5_wp, closed, "half after the memory distance")
      call suite%close_to(memory%weight(1.0e12_wp, 0.1_wp), 0.0_wp, 1.0e-10_wp, "fast slip erases the memory")
      memory%lowest_speed = 5.0_wp
      call suite%close_to(memory%weight(0.0_wp, 0.1_wp), 0.5_wp, closed, "the lowest velocity acts at rest")
   end subroutine limits

   subroutine a_step(suite)
      type(test_suite), intent(inout) :: suite
      type(friction_memory) :: memory
      real(wp) :: mu(2, 1), speed(2, 1)

      speed(:, 1) = [5.0_wp, 0.0_wp]
      mu = 0.2_wp
      call memory%step(speed, 0.1_wp, reshape([0.4_wp, 0.4_wp], [2, 1]), mu)
      call suite%close_to(mu(:, 1), [0.2_wp, 0.2_wp], 0.0_wp, "without memory: the law")
      memory%distance = 0.5_wp
      call memory%step(speed, 0.1_wp, reshape([0.4_wp, 0.4_wp], [2, 1]), mu)
      call suite%close_to(mu(:, 1), [0.3_wp, 0.4_wp], closed, "a step")
   end subroutine a_step

   !> Rolling to the other side is the mirror image
   subroutine directions(suite)
      type(test_suite), intent(inout) :: suite
      type(friction_memory) :: memory
      real(wp) :: one(30, 2), two(30, 2), speed(30, 2)
      integer :: i

      memory%distance = 0.5_wp
      memory%lowest_speed = 0.1_wp
      speed(:, 1) = [(max(0.0_wp, 10.0_wp*sin(0.4_wp*i)), i=1, 30)]
      speed(:, 2) = 0.5_wp*speed(:, 1)
      one = 0.3_wp - 0.01_wp*speed
      two = one(30:1:-1, :)
      call memory%march(speed, 0.02_wp, 1, [0.3_wp, 0.2_wp], one)
      call memory%march(speed(30:1:-1, :), 0.02_wp, -1, [0.3_wp, 0.2_wp], two)
      call suite%close_to(reshape(one, [60]), reshape(two(30:1:-1, :), [60]), 0.0_wp, "mirror image")
      call suite%check(all(one <= 0.3_wp + closed .and. one >= 0.2_wp - closed), "between the extremes")
   end subroutine directions

   !> Constant slip: mu decays as exp(-s t/d); the error halves with the step
   subroutine order(suite)
      type(test_suite), intent(inout) :: suite
      real(wp) :: error(3)
      integer :: k

      do k = 1, 3
         error(k) = decay_error(100*2**k)
      end do
      call suite%close_to(error(1)/error(2), 2.0_wp, 0.05_wp, "first order")
      call suite%close_to(error(2)/error(3), 2.0_wp, 0.05_wp, "first order")
   end subroutine order

   !> Error of the coefficient after a path of twice the memory distance
   real(wp) function decay_error(n) result(error)
      integer, intent(in) :: n
      type(friction_memory) :: memory
      real(wp), allocatable :: mu(:, :), speed(:, :)

      memory%distance = 0.5_wp
      allocate(mu(n, 1), source=0.2_wp)
      allocate(speed(n, 1), source=10.0_wp)
      call memory%march(speed, 0.1_wp/n, 1, [0.4_wp], mu)
      error = abs(mu(1, 1) - (0.2_wp + 0.2_wp*exp(-2.0_wp)))
   end function decay_error

   !> Constant slip, second order: the decay is exact for any step, also with the lowest velocity instead of the slip
   subroutine exact_decay(suite)
      type(test_suite), intent(inout) :: suite
      type(friction_memory) :: memory
      real(wp) :: mu(4, 1), speed(4, 1)
      real(wp), parameter :: path(3) = [1.0e-4_wp, 0.3_wp, 40.0_wp], dt = 0.1_wp
      integer :: k

      memory%distance = 0.5_wp
      do k = 1, 3
         speed = path(k)/dt
         mu = 0.2_wp
         call memory%march_along(speed, dt*speed, dt, 1, [0.4_wp], mu)
         call suite%close_to(mu(1, 1), 0.2_wp + 0.2_wp*exp(-8.0_wp*path(k)), closed, "decay along four elements")
         memory%lowest_speed = path(k)/dt
         speed = 0.0_wp
         mu = 0.2_wp
         call memory%march_along(speed, speed, dt, -1, [0.4_wp], mu)
         call suite%close_to(mu(4, 1), 0.2_wp + 0.2_wp*exp(-8.0_wp*path(k)), closed, "the same by the lowest velocity")
         memory%lowest_speed = 0.0_wp
      end do
   end subroutine exact_decay

   !> Slip that grows from zero: errors of a quarter with half the step. s = 10 t^2 in 0 <= t <= 1 and mu_law = 0.4 - 0.02 s, so
   !> that with x = 10 t^3/(3 d) mu = mu_law + the integral of 0.4 t exp(x - x(1))
   subroutine second_order(suite)
      type(test_suite), intent(inout) :: suite
      real(wp) :: error(3)
      integer :: k

      do k = 1, 3
         error(k) = growth_error(80*2**k)
      end do
      call suite%close_to(error(1)/error(2), 4.0_wp, 0.15_wp, "second order")
      call suite%close_to(error(2)/error(3), 4.0_wp, 0.1_wp, "second order")
   end subroutine second_order

   !> Error at t = 1 with n steps, by time steps and by marching, which are the same
   real(wp) function growth_error(n) result(error)
      integer, intent(in) :: n
      type(friction_memory) :: memory
      real(wp), allocatable :: mu(:, :), speed(:, :), path(:, :), step(:, :), law(:, :)
      real(wp) :: t, exact
      integer, parameter :: fine = 20000
      integer :: i

      memory%distance = 0.5_wp
      allocate(mu(n, 1), speed(n, 1), path(n, 1))
      do i = 1, n
         t = real(n + 1 - i, wp)/n
         speed(i, 1) = 10.0_wp*t**2
         path(i, 1) = 10.0_wp*(t**3 - (t - 1.0_wp/n)**3)/3.0_wp
      end do
      mu = 0.4_wp - 0.02_wp*speed
      allocate(law, source=mu)
      call memory%march_along(speed, path, 1.0_wp/n, 1, [0.4_wp], mu)
      allocate(step, source=law)
      call memory%step_along(speed(:n - 1, :), path(:n - 1, :), 1.0_wp/n, speed(2:, :), law(2:, :), mu(2:, :), step(:n - 1, :))
      call suite%close_to(step(:n - 1, 1), mu(:n - 1, 1), closed, "steps are those of marching")
      exact = 0.2_wp
      do i = 1, fine
         t = (i - 0.5_wp)/fine
         exact = exact + 0.4_wp*t*exp(10.0_wp*(t**3 - 1.0_wp)/1.5_wp)/fine
      end do
      error = abs(mu(1, 1) - exact)
   end function growth_error

   !> Slip that begins and ends suddenly: coefficients stay between those of the law, and the mirror image is the same
   subroutine bounds_and_mirror(suite)
      type(test_suite), intent(inout) :: suite
      type(friction_memory) :: memory
      real(wp) :: one(30, 2), two(30, 2), speed(30, 2), path(30, 2)
      integer :: i, k

      do k = 1, 3
         memory%distance = 0.05_wp*10.0_wp**k
         memory%lowest_speed = merge(0.0_wp, 0.1_wp, k == 2)
         speed(:, 1) = [(max(0.0_wp, 10.0_wp*sin(0.9_wp*i)), i=1, 30)]
         speed(:, 2) = 0.5_wp*speed(:, 1)
         path = 0.02_wp*speed
         one = 0.3_wp - 0.01_wp*speed
         two = one(30:1:-1, :)
         call memory%march_along(speed, path, 0.02_wp, 1, [0.3_wp, 0.2_wp], one)
         call memory%march_along(speed(30:1:-1, :), path(30:1:-1, :), 0.02_wp, -1, [0.3_wp, 0.2_wp], two)
         call suite%close_to(reshape(one, [60]), reshape(two(30:1:-1, :), [60]), 0.0_wp, "second order: mirror image")
         call suite%check(all(one <= 0.3_wp + closed .and. one >= 0.2_wp - closed), "second order: between the extremes")
      end do
   end subroutine bounds_and_mirror
end program test_memory
