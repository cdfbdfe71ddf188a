!> Accelerated fixed-point iterations: exactness for linear maps, maps that push away, hostile values
program test_anderson
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_kinds, only : wp
   use contact_numeric_anderson, only : anderson_iteration
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   integer, parameter :: n = 6
   type(test_suite) :: suite

   call suite%start("Anderson acceleration")
   call linear_maps()
   call short_memory()
   call fixed_at_once()
   call growing()
   call suite%finish()

contains

   !> g(x) = b + factor C x, C a rotation of planes mixed with a contraction, solution known
   pure function mapped(factor, x, solution) result(g)
      real(wp), intent(in) :: factor, x(n), solution(n)
      real(wp) :: g(n), d(n)

      d = x - solution
      g = solution + factor*[d(2), -d(1), 0.5_wp*d(3), -0.7_wp*d(4) + 0.2_wp*d(3), 0.9_wp*d(6), -0.3_wp*d(5)]
   end function mapped

   !> With n + 1 passes remembered, a linear map is solved in about n + 1 of them, also when it pushes away
   subroutine linear_maps()
      type(anderson_iteration) :: iteration
      real(wp), parameter :: factors(*) = [0.5_wp, 0.99_wp, 3.0_wp]
      real(wp) :: x(n), solution(n)
      integer :: i, k

      solution = [(0.3_wp*i - 1.0_wp, i = 1, n)]
      do k = 1, size(factors)
         x = 0.0_wp
         call iteration%start(n, n + 1)
         do i = 1, n + 2
            call iteration%advance(x, mapped(factors(k), x, solution))
         end do
         call suite%close_to(x, solution, 1.0e-8_wp, "a linear map is solved in n + 2 steps")
      end do
   end subroutine linear_maps

   !> Three remembered steps still beat the plain iteration by far
   subroutine short_memory()
      type(anderson_iteration) :: iteration
      real(wp) :: x(n), plain(n), solution(n)
      integer :: i

      solution = 1.0_wp
      x = 0.0_wp
      plain = 0.0_wp
      call iteration%start(n, 3)
      do i = 1, 25
         call iteration%advance(x, mapped(0.95_wp, x, solution))
         plain = mapped(0.95_wp, plain, solution)
      end do
      call suite%check(norm2(x - solution) < 1.0e-3_wp*norm2(plain - solution), "three remembered steps")
   end subroutine short_memory

   !> Nothing changes at the solution; no weights are made of differences that are all zero
   subroutine fixed_at_once()
      type(anderson_iteration) :: iteration
      real(wp) :: x(n)
      integer :: i

      x = 2.0_wp
      call iteration%start(n, 4)
      do i = 1, 4
         call iteration%advance(x, x)
      end do
      call suite%close_to(x, spread(2.0_wp, 1, n), 0.0_wp, "a fixed point stays")
   end subroutine fixed_at_once

   !> A map with a jump: the history is dropped and steps get shorter, nothing overflows
   subroutine growing()
      type(anderson_iteration) :: iteration
      real(wp) :: x(1), g(1)
      integer :: i

      x = 1.0_wp
      call iteration%start(1, 5)
      do i = 1, 100
         g = merge(-4.0_wp, 3.0_wp, x > 0.0_wp)*(1.0_wp + abs(x))
         call iteration%advance(x, g)
      end do
      call suite%check(ieee_is_finite(x(1)), "a map without a fixed point gives finite numbers")
   end subroutine growing
end program test_anderson
