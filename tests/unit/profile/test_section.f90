!> The section of a rail below a patch: the same heights as those of the curve that is seen from the patch
program test_section
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_profile_curve, only : profile_curve
   use contact_profile_prepare, only : read_profile
   use contact_profile_request, only : profile_request, profile_side
   use contact_profile_section, only : profile_section
   use contact_test_files, only : write_profile
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("sections of a rail")
   call compare(suite, "head", 0.0_wp)
   ! a groove, whose walls hide parts of it from steep planes
   call compare(suite, "groove", 12.0_wp)
   call suite%finish()

contains

   !> Heights over rows of many planes, with the same section again and again
   subroutine compare(suite, name, depth)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: name
      !> Of the groove [mm]
      real(wp), intent(in) :: depth
      real(wp), parameter :: rolls(*) = [0.0_wp, -0.4_wp, 0.9_wp], half = 6.0_wp, step = 0.37_wp
      type(profile_curve) :: rail, seen
      type(profile_section) :: section
      type(profile_request) :: request
      type(log_type) :: log
      type(error_type), allocatable :: error
      real(wp) :: y(145), z(145), origin(2), places(2), n, worst, height
      logical :: found
      integer :: i, j, k, differ, points, hidden

      y = [(0.5_wp*i, i=-72, 72)]
      z = y**2/600.0_wp + depth*exp(-((y - 10.0_wp)/4.0_wp)**4)
      call write_profile(name // "_section.txt", y, z)
      request%file = name // "_section.txt"
      request%side = profile_side%rail
      call read_profile(request, rail, log, error)
      call suite%check(.not. allocated(error), name // ": profile")
      if (allocated(error)) return
      worst = 0.0_wp
      differ = 0
      points = 0
      hidden = 0
      do i = -12, 12
         origin = [2.5_wp*i, rail%height(2.5_wp*i)]
         ! the second position may lie in another stretch
         places = [rail%s_at(origin(1)), rail%s_at(origin(1) + 1.3_wp)]
         do j = 1, size(rolls)
            seen = rail%seen_from(origin, rolls(j), around=places)
            call section%follow(rail, origin, rolls(j), places, [-half - step, half + step])
            do k = -16, 16
               n = 0.0_wp
               call section%height(rail, k*step, n, found)
               height = 0.0_wp
               if (seen%has(k*step)) height = seen%height(k*step)
               if (found .neqv. seen%has(k*step)) differ = differ + 1
               if (.not. found) hidden = hidden + 1
               worst = max(worst, abs(n - height))
               points = points + 1
            end do
         end do
      end do
      call suite%close_to(worst, 0.0_wp, 1.0e-12_wp, name // ": heights [mm]")
      call suite%equal(differ, 0, name // ": points that only one of both sees")
      call suite%check(hidden > 0 .and. hidden < points, name // ": points that are not seen are among them")
   end subroutine compare
end program test_section
