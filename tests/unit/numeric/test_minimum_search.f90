!> The search for a minimum by questions and answers: smooth ones, kinks, functions without one
program test_minimum_search
   use contact_base_kinds, only : wp
   use contact_numeric_minimum_search, only : minimum_search
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("minimum search")
   call minima(suite)
   call without_minimum(suite)
   call suite%finish()

contains

   !> Minima are found from first steps that are too short and too long
   subroutine minima(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: first(5) = [1.0e-6_wp, 0.03_wp, 1.0_wp, 50.0_wp, 1.0e6_wp]
      type(minimum_search) :: search
      integer :: i

      do i = 1, size(first)
         call search%start(first(i), 1.0e-6_wp)
         do while (.not. search%finished)
            call search%update((search%x - 0.7_wp)**2)
         end do
         call suite%close_to(search%best, 0.7_wp, 1.0e-5_wp, "parabola")
         call suite%check(search%evaluations < 60, "in few evaluations")

         call search%start(first(i), 1.0e-6_wp)
         do while (.not. search%finished)
            call search%update(2.0_wp*exp(-search%x) + 0.5_wp*search%x)
         end do
         call suite%close_to(search%best, log(4.0_wp), 1.0e-4_wp, "exponential")

         call search%start(first(i), 1.0e-6_wp)
         do while (.not. search%finished)
            call search%update(merge(5.0_wp, -1.0_wp, search%x > 3.0_wp)*(search%x - 3.0_wp))
         end do
         call suite%close_to(search%best, 3.0_wp, 1.0e-4_wp, "kink")
      end do
   end subroutine minima

   !> It ends if the function is increasing, decreasing, constant or NaN
   subroutine without_minimum(suite)
      type(test_suite), intent(inout) :: suite
      type(minimum_search) :: search

      call search%start(1.0_wp, 1.0e-3_wp)
      do while (.not. search%finished)
         call search%update(search%x)
      end do
      call suite%check(search%best < 1.0e-8_wp .and. search%evaluations < 100, "an increasing function")
      call search%start(1.0_wp, 1.0e-3_wp)
      do while (.not. search%finished)
         call search%update(-search%x)
      end do
      call suite%check(search%best > 1.0e8_wp .and. search%evaluations < 100, "a decreasing function")
      call search%start(1.0_wp, 1.0e-3_wp)
      do while (.not. search%finished)
         call search%update(2.0_wp)
      end do
      call suite%check(search%evaluations < 100, "a constant")
      call search%start(1.0_wp, 1.0e-3_wp)
      do while (.not. search%finished)
         call search%update(search%x*huge(search%x)*10.0_wp - search%x*huge(search%x)*10.0_wp)
      end do
      call suite%check(search%evaluations < 100, "no number")
   end subroutine without_minimum
end program test_minimum_search
