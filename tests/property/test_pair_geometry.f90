!> Geometry of wheel on rail: independence of other parts beside the contact
!>
!> A guard rail, a groove, slices that end, another description of the same bodies: the forces do not change.
program test_pair_geometry
   use contact_base_choices, only : contact_location
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_test_files, only : write_file
   use contact_test_harness, only : environment, test_suite
   use contact_test_pair_builder, only : pair_case, railway_case
   implicit none (type, external)
   !> The part of the rail in contact alone; with a guard rail beside it; with a groove and its lip
   integer, parameter :: alone = 1, guarded = 2, grooved = 3
   character, parameter :: nl = new_line("a")
   type(test_suite) :: suite

   call suite%start("pair geometry")
   call parts_beside()
   call rail_of_slices()
   call suite%finish()

contains

   !> Points of a rail head with a steep flank, and other parts beside it on the gauge side
   function rail_points(beside) result(points)
      integer, intent(in) :: beside
      real(wp), allocatable :: points(:, :)
      !> Radii of top and corner, and the angle of the flank [mm, rad]
      real(wp), parameter :: top = 300.0_wp, corner = 13.0_wp, flank = 1.48_wp, half_top = 0.08_wp, lowest = 30.0_wp
      real(wp) :: angle, y, z, end(2)
      integer :: i

      allocate(points(2, 0))
      associate (centre => [(top - corner)*sin(half_top), top - (top - corner)*cos(half_top)])
         ! up the flank, from its lowest point
         end = [-centre(1) - corner*sin(flank), centre(2) - corner*cos(flank)]
         do i = 40, 1, -1
            z = end(2) + (lowest - end(2))*i/40
            points = reshape([points, end(1) - (z - end(2))/tan(flank), z], [2, size(points, 2) + 1])
         end do
         do i = 0, 60
            angle = flank + (half_top - flank)*i/60
            points = reshape([points, -centre(1) - corner*sin(angle), centre(2) - corner*cos(angle)], [2, size(points, 2) + 1])
         end do
         do i = 1, 80
            angle = half_top*(-1.0_wp + i/40.0_wp)
            points = reshape([points, top*sin(angle), top*(1.0_wp - cos(angle))], [2, size(points, 2) + 1])
         end do
      end associate
      y = points(1, 1)
      ! ends are moved by multiples of the mesh of the search, which begins there
      if (beside == guarded) points = reshape([polyline(y - [96.0_wp, 92.0_wp, 60.0_wp, 56.0_wp, 8.0_wp, 0.0_wp], &
         & [35.0_wp, -20.0_wp, -20.0_wp, 35.0_wp, 38.0_wp, points(2, 1)]), points], [2, 5*60 + size(points, 2)])
      if (beside == grooved) points = reshape([polyline(y - [72.0_wp, 69.0_wp, 58.0_wp, 52.0_wp, 8.0_wp, 0.0_wp], &
         & [30.0_wp, -3.0_wp, -3.0_wp, 40.0_wp, 42.0_wp, points(2, 1)]), points], [2, 5*60 + size(points, 2)])
   end function rail_points

   !> Points on straight lines between corners, 60 on each, without the last corner
   pure function polyline(y, z) result(points)
      real(wp), intent(in) :: y(:), z(:)
      real(wp), allocatable :: points(:, :)
      integer :: i, k

      allocate(points(2, 60*(size(y) - 1)))
      do k = 1, size(y) - 1
         do i = 0, 59
            points(:, 60*(k - 1) + i + 1) = [y(k), z(k)] + [y(k + 1) - y(k), z(k + 1) - z(k)]*i/60.0_wp
         end do
      end do
   end function polyline

   !> A wheel on the flank of the rail: parts beside the contact have no effect
   subroutine parts_beside()
      integer, parameter :: location(4) = [contact_location%locus, contact_location%locus_extended, contact_location%conformal, &
         & contact_location%grid]
      real(wp), parameter :: yaw(3) = [0.0_wp, 0.01_wp, -0.01_wp]
      type(pair_case) :: pair
      real(wp) :: right(3), steepest
      integer :: i, j, side, beside

      steepest = 0.0_wp
      do i = 1, size(location)
         do j = 1, size(yaw)
            if (i > 1 .and. j == 2) cycle
            do side = 1, 2
               if (i > 1 .and. side == 2) cycle
               do beside = alone, grooved
                  pair%spec = flank_case(yaw(j), beside, left=side == 2)
                  pair%spec%wheel_rail%search%location = location(i)
                  call pair%run(suite, "wheel on the flank")
                  ! results of the left side are those of its mirror image
                  if (beside == alone .and. side == 1) right = pair%result%force_track
                  call suite%close_to(pair%result%force_track, right, 1.0e-8_wp*norm2(right), &
                     & "forces with other parts beside the rail")
                  steepest = max(steepest, maxval(abs(pair%result%patches%delta)))
               end do
            end do
         end do
      end do
      call suite%check(steepest > 1.1_wp, "contact on the flank")
      call suite%equal(pair%log%warnings, 0, "no warning")
      call pair%release()
   end subroutine parts_beside

   !> A wheel pressed against the flank of a rail
   function flank_case(yaw, beside, left) result(spec)
      real(wp), intent(in) :: yaw
      integer, intent(in) :: beside
      logical, intent(in) :: left
      type(case_spec) :: spec
      real(wp) :: side

      side = merge(-1.0_wp, 1.0_wp, left)
      spec = railway_case(side*5.0_wp, side*yaw)
      associate (pair => spec%wheel_rail)
         pair%left = left
         deallocate(pair%rail_profile%name)
         pair%rail_profile%name = "points"
         pair%rail_profile%points = rail_points(beside)
         pair%track%gaught = -1.0_wp
         pair%track%raily0 = side*750.0_wp
         pair%track%cant = 0.0_wp
         ! the search has a mesh of 0.3 mm
         pair%search%ds = 0.25_wp
         pair%search%dx = 0.5_wp
      end associate
   end function flank_case

   !> A rail of equal slices is a plain rail, also beyond its slices, with a warning
   subroutine rail_of_slices()
      real(wp), parameter :: place(4) = [0.0_wp, 100.0_wp, -103.0_wp, 5.0e4_wp]
      type(pair_case) :: plain, sliced
      integer :: k, warnings
      character(len=:), allocatable :: text
      character(len=8) :: number

      plain%spec = railway_case(3.0_wp, 0.004_wp)
      plain%spec%wheel_rail%track%gaught = -1.0_wp
      plain%spec%wheel_rail%track%raily0 = 755.0_wp
      call plain%run(suite, "plain rail")
      text = "0 1" // nl // "5" // nl // "0 0 0" // nl // "1" // nl
      do k = -2, 2
         write(number, "(i0)") 50*k
         text = text // trim(number) // " '" // environment("CONTACT_SOURCE") // "/examples/profiles/60E1.prr'" // nl
      end do
      call write_file("equal.slcs", text)
      do k = 1, size(place)
         sliced%spec = plain%spec
         sliced%spec%wheel_rail%rail_profile%name = "equal.slcs"
         sliced%spec%wheel_rail%wheelset%s = place(k)
         warnings = sliced%log%warnings
         call sliced%run(suite, "rail of slices")
         call suite%equal(sliced%log%warnings - warnings, merge(0, 1, k == 1), "a warning if elements are beyond the slices")
         ! slices are sampled every 0.5 mm
         call suite%close_to(sliced%result%force_track, plain%result%force_track, 1.0e-3_wp*norm2(plain%result%force_track), &
            & "forces on a rail of slices")
         call suite%close_to(sliced%result%z_ws, plain%result%z_ws, 1.0e-4_wp, "height on a rail of slices")
      end do
      call plain%release()
      call sliced%release()
   end subroutine rail_of_slices
end program test_pair_geometry
