!> The search for a root by questions and answers: roots, kinks, jumps, functions without a root
program test_root_search
   use contact_base_kinds, only : wp
   use contact_numeric_root_search, only : root_search
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("root search")
   call roots(suite)
   call without_root(suite)
   call suite%finish()

contains

   !> Smooth, with a kink, with a jump, from both sides and from far away
   subroutine roots(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: starts(4) = [-1.0e3_wp, 0.0_wp, 1.0_wp, 1.0e6_wp]
      type(root_search) :: search
      integer :: i

      do i = 1, size(starts)
         call search%start(starts(i), 0.01_wp, 1.0e-12_wp)
         do while (.not. search%finished)
            call search%update(1.0_wp - tanh(search%x) - 0.7_wp, .false.)
         end do
         call suite%check(search%found, "the root of a smooth function is found")
         call suite%close_to(search%best, atanh(0.3_wp), 1.0e-11_wp, "at its position")
         call suite%check(search%evaluations < 120, "in few evaluations")

         call search%start(starts(i), 1.0_wp, 1.0e-12_wp)
         do while (.not. search%finished)
            call search%update(merge(-1.0e-3_wp, -100.0_wp, search%x < 2.0_wp)*(search%x - 2.0_wp), .false.)
         end do
         call suite%check(search%found, "the root at a kink is found")
         call suite%close_to(search%best, 2.0_wp, 1.0e-8_wp, "the kink")

         call search%start(starts(i), 1.0_wp, 1.0e-12_wp)
         do while (.not. search%finished)
            call search%update(merge(0.5_wp, -0.3_wp, search%x < 3.0_wp), .false.)
         end do
         call suite%check(search%bracketed .and. .not. search%found, "a jump is not a root")
         call suite%close_to([search%best, search%best_value], [3.0_wp, 0.3_wp], 1.0e-12_wp, "but its position is found")
      end do
   end subroutine roots

   !> The search ends when the function saturates above zero, and always
   subroutine without_root(suite)
      type(test_suite), intent(inout) :: suite
      type(root_search) :: search

      call search%start(0.0_wp, 1.0_wp, 1.0e-6_wp)
      do while (.not. search%finished)
         call search%update(0.1_wp + 1.0_wp/(1.0_wp + search%x**2), search%x > 10.0_wp)
      end do
      call suite%check(.not. (search%found .or. search%bracketed), "no sign change is reported")
      call suite%check(search%evaluations < 40, "the walk ends when the function saturates")
      call suite%close_to(search%best_value, 0.1_wp, 1.0e-6_wp, "and gives the smallest value")
      call search%start(0.0_wp, 1.0_wp, 1.0e-6_wp)
      do while (.not. search%finished)
         call search%update(1.0_wp, .false.)
      end do
      call suite%check(.not. search%found, "a constant has no root")

      ! all of the function counts as saturated, and the first steps are too short to determine its slope
      call search%start(0.0_wp, 1.0e-7_wp, 1.0e-6_wp)
      search%reach = 1.0_wp
      do while (.not. search%finished)
         call search%update(0.1_wp*(2.0_wp - search%x), .true.)
      end do
      call suite%check(search%found .and. search%evaluations < 15, "short steps continue while the function still decreases")
      call search%start(0.0_wp, 1.0e-7_wp, 1.0e-6_wp)
      search%reach = 1.0_wp
      do while (.not. search%finished)
         call search%update(1.0_wp, .true.)
      end do
      call suite%check(.not. search%found .and. search%evaluations == 3, "a saturated constant is known after one long step")
   end subroutine without_root
end program test_root_search
