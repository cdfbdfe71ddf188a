!> Where contact is cut off, in words, on both sides of the track
program test_border_words
   use contact_base_kinds, only : wp
   use contact_cases_border_warning, only : border_words, is_same
   use contact_cases_spec, only : case_spec
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_result, only : border_contact
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("border_words")
   call sides(suite)
   call ends(suite)
   call same_grids(suite)
   call suite%finish()

contains

   !> Every choice of sides: on the left the low and the high side in y are exchanged
   subroutine sides(suite)
      type(test_suite), intent(inout) :: suite
      character(len=6), parameter :: right(4) = ["x low ", "x high", "y low ", "y high"]
      integer, parameter :: mirrored(4) = [1, 2, 4, 3]
      type(case_spec) :: spec
      type(border_contact) :: border
      character(len=:), allocatable :: words, expected
      logical :: is_named(4)
      integer :: choice, kind, k

      do kind = 0, 2
         if (kind == 1) allocate(spec%wheel_rail)
         if (kind > 0) spec%wheel_rail%left = kind == 2
         do choice = 0, 15
            border%side = [(btest(choice, k), k=0, 3)]
            is_named = border%side
            if (kind == 2) is_named = is_named(mirrored)
            expected = ""
            do k = 1, 4
               if (.not. is_named(k)) cycle
               if (len(expected) > 0) expected = expected // ", "
               expected = expected // trim(right(k))
            end do
            if (choice > 0) expected = "the border of the potential contact (" // expected // ")"
            call border_words(spec, border, words)
            call suite%equal(words, expected, "sides")
         end do
      end do
   end subroutine sides

   !> Ends of profiles keep their names on the left: the inner one is towards the middle of the track
   subroutine ends(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec
      type(border_contact) :: border
      character(len=:), allocatable :: words
      integer :: kind

      allocate(spec%wheel_rail)
      do kind = 1, 2
         spec%wheel_rail%left = kind == 2
         border = border_contact()
         border%surface_end(1, 1) = .true.
         call border_words(spec, border, words)
         call suite%equal(words, "the inner end of the rail profile", "low end of body 1")
         border%surface_end(2, 2) = .true.
         call border_words(spec, border, words)
         call suite%equal(words, "the inner end of the rail profile, the outer end of the wheel profile", "two ends")
         border%hidden = .true.
         border%surface_end(:, 1) = .false.
         border%side(1) = .true.
         call border_words(spec, border, words)
         call suite%equal(words, "the border of the potential contact (x low), the outer end of the wheel profile, a part of " // &
            & "the profiles that cannot be seen from the plane of the contact", "everything")
         border%side = .true.
         border%surface_end = .true.
         call border_words(spec, border, words)
         call suite%check(index(words, "(x low, x high, y low, y high), the inner end of the rail profile, the outer end " // &
            & "of the rail profile, the inner end of the wheel profile, the outer end of the wheel profile, a part") > 0, &
            & "all at once")
      end do
      border = border_contact(hidden=.true.)
      call border_words(spec, border, words)
      call suite%equal(words, "a part of the profiles that cannot be seen from the plane of the contact", "hidden")
   end subroutine ends

   !> A grid that differs in one number is another one
   subroutine same_grids(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid, other
      integer :: k, sign

      grid = potential_contact(mx=7, my=9, xl=-1.0_wp, yl=-2.0_wp, dx=0.3_wp, dy=0.4_wp)
      call suite%check(is_same(grid, grid), "a grid is the same as itself")
      do k = 1, 6
         do sign = -1, 1, 2
            other = grid
            select case (k)
            case (1); other%mx = grid%mx + sign
            case (2); other%my = grid%my + sign
            case (3); other%xl = grid%xl + sign*1.0e-9_wp
            case (4); other%yl = grid%yl + sign*1.0e-9_wp
            case (5); other%dx = grid%dx + sign*1.0e-9_wp
            case (6); other%dy = grid%dy + sign*1.0e-9_wp
            end select
            call suite%check(.not. is_same(grid, other), "another grid")
         end do
      end do
   end subroutine same_grids
end program test_border_words
