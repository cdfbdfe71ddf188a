!> Complete elliptic integrals: values with 20 digits from another program, identities, limits
program test_elliptic
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_numeric_elliptic, only : complete_elliptic, elliptic_integrals
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> A few roundings of closed forms
   real(wp), parameter :: closed = 20.0_wp*epsilon(1.0_wp)
   type(test_suite) :: suite

   call suite%start("elliptic")
   call values(suite)
   call identities(suite)
   call limits(suite)
   call suite%finish()

contains

   !> Computed with mpmath, working with 25 digits or more; g = 1e-150 from the limit K = log(4/g)
   subroutine values(suite)
      type(test_suite), intent(inout) :: suite

      call one_value(suite, 0.5_wp, 2.1565156474996432354_wp, 1.2110560275684595248_wp, &
         & 0.89590282092473162126_wp, 1.2606128265749116142_wp, "g = 0.5")
      call one_value(suite, 0.1_wp, 3.6956373629898746778_wp, 1.0159935450252239356_wp, &
         & 0.98892643575285372612_wp, 2.7067109272370209517_wp, "g = 0.1")
      call one_value(suite, 1.0e-4_wp, 10.59663475708766032_wp, 1.0000000504831738439_wp, &
         & 0.99999995451682581815_wp, 9.596634802570834502_wp, "g = 1e-4")
      call one_value(suite, 1.0e-150_wp, 346.77405831022674322_wp, 1.0_wp, 1.0_wp, &
         & 345.77405831022674322_wp, "g = 1e-150")
   end subroutine values

   subroutine one_value(suite, g, k, e, b, d, what)
      type(test_suite), intent(inout) :: suite
      real(wp), intent(in) :: g, k, e, b, d
      character(len=*), intent(in) :: what
      type(elliptic_integrals) :: integrals

      integrals = complete_elliptic(g)
      call suite%close_to([integrals%k, integrals%e, integrals%b, integrals%d], [k, e, b, d], closed, what, &
         & relative=.true.)
   end subroutine one_value

   !> Legendre's relation couples complementary moduli; K and E are made of B and D
   subroutine identities(suite)
      type(test_suite), intent(inout) :: suite
      type(elliptic_integrals) :: one, two
      real(wp) :: g, previous
      integer :: i

      previous = huge(1.0_wp)
      do i = 1, 99
         g = 0.01_wp*i
         one = complete_elliptic(g)
         two = complete_elliptic(sqrt((1.0_wp - g)*(1.0_wp + g)))
         call suite%close_to(one%e*two%k + two%e*one%k - one%k*two%k, 0.5_wp*pi, 2.0_wp*closed, &
            & "Legendre's relation")
         call suite%close_to(one%e - g**2*one%k, (1.0_wp - g**2)*one%b, closed, "definition of B")
         call suite%close_to(one%k - one%e, (1.0_wp - g**2)*one%d, closed*one%k, "definition of D")
         call suite%check(one%k < previous, "K falls with g")
         previous = one%k
      end do
   end subroutine identities

   subroutine limits(suite)
      type(test_suite), intent(inout) :: suite
      type(elliptic_integrals) :: integrals
      real(wp), parameter :: near = 1.0e-6_wp

      integrals = complete_elliptic(1.0_wp)
      call suite%close_to([integrals%k, integrals%e, integrals%b, integrals%d], &
         & pi*[0.5_wp, 0.5_wp, 0.25_wp, 0.25_wp], closed, "circle")
      integrals = complete_elliptic(1.0_wp - near)
      call suite%close_to(integrals%d, 0.25_wp*pi*(1.0_wp + 0.75_wp*near), 2.0_wp*near**2, "D near the circle")
      call suite%close_to(integrals%b, 0.25_wp*pi*(1.0_wp + 0.25_wp*near), 2.0_wp*near**2, "B near the circle")
      integrals = complete_elliptic(1.0e-12_wp)
      call suite%close_to(integrals%d, log(4.0e12_wp) - 1.0_wp, 40.0_wp*closed, "D for a narrow ellipse")
      integrals = complete_elliptic(0.0_wp)
      call suite%close_to(integrals%e, 1.0_wp, closed, "E stays finite at zero")
      call suite%close_to(integrals%b, 1.0_wp, closed, "B stays finite at zero")
      call suite%close_to(integrals%k, log(4.0_wp) - log(tiny(1.0_wp)), 1.0e-12_wp, &
         & "K stays finite at zero", relative=.true.)
   end subroutine limits
end program test_elliptic
