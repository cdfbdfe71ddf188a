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
   call suite%finish()

contains

   subroutine limits(suite)
      type(test_suite), intent(inout) :: suite
      type(friction_memory) :: memory

      call suite%check(.not. memory%acts(), "none by default")
      call suite%close_to(memory%weight(3.0_wp, 0.1_wp), 0.0_wp, 0.0_wp, "without distance nothing is remembered")
      memory = friction_memory(distance=0.5_wp, lowest_speed=0.0_wp)
      call suite%check(memory%acts(), "a distance acts")
      call suite%close_to(memory%weight(0.0_wp, 0.1_wp), 1.0_wp, closed, "without slip nothing changes")
      call suite%close_to(memory%weight(5.0_wp, 0.1_wp), 0.5_wp, closed, "half after the memory distance")
      call suite%close_to(memory%weight(1.0e12_wp, 0.1_wp), 0.0_wp, 1.0e-10_wp, "fast slip forgets")
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
end program test_memory
