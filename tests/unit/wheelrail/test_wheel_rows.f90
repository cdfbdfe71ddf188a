!> Heights of a wheel over the rows of a patch: the same as those that are found point by point
program test_wheel_rows
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_profile_curve, only : profile_curve
   use contact_profile_prepare, only : read_profile
   use contact_profile_request, only : profile_request, profile_side
   use contact_test_files, only : write_profile
   use contact_test_harness, only : test_suite
   use contact_wheelrail_frame, only : frame, new_frame
   use contact_wheelrail_wheel_rows, only : wheel_rows
   use contact_wheelrail_wheel_surface, only : wheel_height
   implicit none (type, external)
   real(wp), parameter :: radius = 460.0_wp, missing = -999.0_wp
   type(test_suite) :: suite

   call suite%start("rows of a wheel")
   ! a round tread, one that bends differently from point to point, and one with an edge
   call compare(suite, "smooth", 0.0_wp, 0.0_wp)
   call compare(suite, "rough", 2.0e-3_wp, 0.0_wp)
   call compare(suite, "kinked", 0.0_wp, -0.1_wp)
   call suite%finish()

contains

   !> Rows of any number of points, over planes that are rolled and yawed, in the middle of the profile and beside its end
   subroutine compare(suite, name, roughness, kink)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: name
      !> Height of waves that follow no pattern [mm], and change of slope in the middle [-]
      real(wp), intent(in) :: roughness, kink
      integer, parameter :: numbers(*) = [1, 2, 7, 8, 9, 23, 75]
      real(wp), parameter :: rolls(*) = [0.0_wp, -0.3_wp], yaws(*) = [0.0_wp, 0.02_wp], places(*) = [0.0_wp, 7.0_wp, 38.5_wp]
      type(profile_curve) :: wheel
      type(profile_request) :: request
      type(log_type) :: log
      ! kept from patch to patch, as a loop over time does
      type(wheel_rows) :: rows
      type(error_type), allocatable :: error
      real(wp) :: y(161), z(161), worst
      integer :: i, j, k, l, lost, differ

      y = [(0.5_wp*i, i=80, -80, -1)]
      z = sqrt(300.0_wp**2 - y**2) - 300.0_wp + kink*abs(y - 0.2_wp)
      do i = 1, size(z)
         z(i) = z(i) + roughness*sin(1.0_wp*i**2)
      end do
      call write_profile(name // ".txt", y, z)
      request%file = name // ".txt"
      request%side = profile_side%wheel
      call read_profile(request, wheel, log, error)
      call suite%check(.not. allocated(error), name // ": profile")
      if (allocated(error)) return
      worst = 0.0_wp
      lost = 0
      differ = 0
      do i = 1, size(rolls)
         do j = 1, size(yaws)
            do k = 1, size(places)
               do l = 1, size(numbers)
                  call look_at_patch(wheel, new_frame([0.0_wp, places(k), wheel%height(places(k))], rolls(i), yaws(j)), &
                     & numbers(l), rows, worst, lost, differ)
               end do
            end do
         end do
      end do
      call suite%close_to(worst, 0.0_wp, 5.0e-10_wp, name // ": heights [mm]")
      call suite%equal(differ, 0, name // ": points that only one of both finds")
      call suite%check(lost > 0, name // ": rows beyond the end of the profile are among them")
   end subroutine compare

   !> Largest difference between heights of a patch and those of its points
   subroutine look_at_patch(wheel, seen, points, rows, worst, lost, differ)
      type(profile_curve), intent(in) :: wheel
      !> Plane, seen from the wheel
      type(frame), intent(in) :: seen
      !> In a row
      integer, intent(in) :: points
      !> Of other patches on entry
      type(wheel_rows), intent(inout) :: rows
      !> Raised where differences are larger [mm]
      real(wp), intent(inout) :: worst
      !> Points without wheel, and those that only one of both finds
      integer, intent(inout) :: lost, differ
      real(wp), parameter :: half = 7.0_wp
      real(wp) :: n(points), place, height, x, s
      logical :: found
      integer :: ix, iy

      call rows%begin([-half, merge(-half, half, points == 1)], points, [wheel%s_at(seen%origin(2)), 0.0_wp])
      do iy = -8, 8
         s = 0.4_wp*iy
         call rows%find(wheel, radius, seen, s, missing, n)
         place = wheel%s_at(seen%origin(2) + s*seen%axes(2, 2))
         height = 0.0_wp
         do ix = 1, points
            x = -half + (ix - 1)*2.0_wp*half/max(1, points - 1)
            call wheel_height(wheel, radius, seen, x, s, place, height, found)
            if (.not. found) lost = lost + 1
            if (found .neqv. n(ix) > missing) differ = differ + 1
            if (found .and. n(ix) > missing) worst = max(worst, abs(height - n(ix)))
         end do
      end do
   end subroutine look_at_patch
end program test_wheel_rows
