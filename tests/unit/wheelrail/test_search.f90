!> Contact search of wheel and rail: patches, references, grids, approach
!>
!> Against the published figures of the Manchester contact benchmark (case A-2.2, right wheel; original
!> program, revision 2707), with its profile files if available; and a sphere on a plane.
program test_search
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_grid_potential_contact, only : potential_contact
   use contact_profile_curve, only : profile_curve
   use contact_profile_prepare, only : read_profile
   use contact_profile_request, only : profile_request, profile_side
   use contact_test_files, only : write_profile
   use contact_test_harness, only : environment, test_suite
   use contact_wheelrail_flat_patch, only : distance_scratch, patch_frame, patch_grid, start_places, &
      & undeformed_distance
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_gap, only : gap_curve, measure_gap, no_surface, rail_in_track, smallest_in_row
   use contact_wheelrail_placement, only : gauge_point, wheel_rail_placement, place_wheel_rail
   use contact_wheelrail_profile_ends, only : depth_within
   use contact_wheelrail_region, only : contact_region, parts_of
   use contact_wheelrail_regions, only : find_regions, smallest_gap
   use contact_wheelrail_spec, only : wheel_rail_spec
   implicit none (type, external)
   !> A conical wheel: height at y = 0 and slope of the profile
   real(wp), parameter :: height = 30.0_wp, slope = -0.9_wp
   type(test_suite) :: suite

   call suite%start("contact search")
   call lowest_of_a_row(suite)
   call depth_below_a_rail(suite)
   call sphere_on_plane(suite)
   call mirrored_wheel(suite)
   call locus_on_roller(suite)
   call back_of_flange(suite)
   call benchmark(suite)
   call suite%finish()

contains

   !> The minimum of a parabola, between points; of a row that ends at its lowest point, that point
   subroutine lowest_of_a_row(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: x(5) = [-2.0_wp, -1.0_wp, 0.0_wp, 1.0_wp, 2.0_wp], bottom = 0.3_wp
      real(wp) :: g(5), place, lowest
      integer :: side

      g = 0.5_wp + (x - bottom)**2
      call smallest_in_row(x, g, place, lowest)
      call suite%close_to(place, bottom, 1.0e-12_wp, "between points")
      call suite%close_to(lowest, 0.5_wp, 1.0e-12_wp, "the lowest gap")
      do side = -1, 1, 2
         g = 0.5_wp + (x - bottom)**2
         g(3 + side) = no_surface
         if (side > 0) g(3 + 2*side) = no_surface
         call smallest_in_row(x, g, place, lowest)
         call suite%close_to(place, 0.0_wp, 1.0e-300_wp, "outside of the surface")
         call suite%close_to(lowest, 0.5_wp + bottom**2, 1.0e-12_wp, "the gap of this point")
      end do
   end subroutine lowest_of_a_row

   !> Depth of points below a rail with crests and hollows: the distance to the nearest of very many points of it
   subroutine depth_below_a_rail(suite)
      type(test_suite), intent(inout) :: suite
      type(profile_curve) :: rail
      type(error_type), allocatable :: error
      real(wp), allocatable :: curve(:, :)
      real(wp) :: y(81), z(81), point(2), distance, s
      integer :: i, j, k

      y = [(real(i, wp), i=-40, 40)]
      z = 8.0_wp*cos(y/6.0_wp)
      call write_profile("waves.txt", y, z)
      call profile_of("waves.txt", profile_side%rail, rail, error)
      call suite%check(.not. allocated(error), "a rail with waves")
      if (allocated(error)) return
      allocate(curve(2, 80001))
      associate (nodes => rail%y%s)
         do k = 0, size(curve, 2) - 1
            s = nodes(1) + (nodes(size(nodes)) - nodes(1))*k/(size(curve, 2) - 1)
            curve(:, k + 1) = [rail%y%value(s), rail%z%value(s)]
         end do
      end associate
      do i = 10000, 70000, 3000
         do j = 1, 4
            point = curve(:, i) + [0.0_wp, 1.5_wp*j]
            distance = sqrt(minval((curve(1, :) - point(1))**2 + (curve(2, :) - point(2))**2))
            ! chords of 1 mm are up to 0.03 mm away from crests
            call suite%close_to(depth_within(rail, point), distance, 0.04_wp, "depth below a rail")
         end do
         call suite%check(depth_within(rail, curve(:, i) - [0.0_wp, 1.0_wp]) <= 0.0_wp, "above the rail")
      end do
   end subroutine depth_below_a_rail

   !> A profile given by points in a file
   subroutine profile_of(file, side, curve, error)
      character(len=*), intent(in) :: file
      integer, intent(in) :: side
      type(profile_curve), intent(out) :: curve
      type(error_type), allocatable, intent(out) :: error
      type(profile_request) :: request
      type(log_type) :: log

      request%file = file
      request%side = side
      call read_profile(request, curve, log, error)
   end subroutine profile_of

   !> A yawed and rolled conical wheel on a small roller: the locus has the smallest gap, compared with all positions
   subroutine locus_on_roller(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: yaw(4) = [0.02_wp, -0.02_wp, 0.1_wp, 0.1_wp], radius(4) = [300.0_wp, 300.0_wp, 200.0_wp, 1.0e6_wp]
      !> Flexible roll of the wheel
      real(wp), parameter :: bent = 0.01_wp
      type(profile_curve) :: rail, wheel, in_track
      type(error_type), allocatable :: error
      type(wheel_rail_spec) :: pair
      type(wheel_rail_placement) :: placement
      type(gap_curve) :: gap
      real(wp) :: a, b, low, high, gap_a, gap_b, place
      integer :: i, j, k

      call write_profile("roller.txt", [(0.5_wp*i, i=-60, 60)], [(0.002_wp*(0.5_wp*i)**2, i=-60, 60)])
      call write_profile("cone.txt", [(-1.0_wp*i, i=-50, 50)], [(height - slope*i, i=-50, 50)])
      call profile_of("roller.txt", profile_side%rail, rail, error)
      if (.not. allocated(error)) call profile_of("cone.txt", profile_side%wheel, wheel, error)
      call suite%check(.not. allocated(error), "the profiles of roller and wheel are read")
      if (allocated(error)) return
      pair%track%gaught = -1.0_wp
      pair%wheelset%fbdist = 0.0_wp
      pair%wheelset%fbpos = 0.0_wp
      pair%wheelset%nomradw = 460.0_wp
      pair%wheelset%roll = 0.05_wp
      pair%wheelset%flexible(4) = bent
      do k = 1, size(yaw)
         pair%wheelset%yaw = yaw(k)
         pair%roller = .true.
         pair%track%nomradr = radius(k)
         ! wheel and roller nearly touch at y = 0
         call place_wheel_rail(pair, wheel, 0.0_wp, 0.0_wp, -height, [0.0_wp, 0.0_wp], placement)
         in_track = rail_in_track(rail, placement)
         call measure_gap(in_track, wheel, placement, 0.5_wp, gap)
         do i = gap%n/2 - 40, gap%n/2 + 40, 20
            ! the gap is convex along the track: nested intervals
            low = -100.0_wp
            high = 100.0_wp
            do j = 1, 120
               a = low + 0.381966_wp*(high - low)
               b = low + 0.618034_wp*(high - low)
               call gap_by_hand(placement, in_track, a, gap%y(i), gap_a, place)
               call gap_by_hand(placement, in_track, b, gap%y(i), gap_b, place)
               if (gap_a < gap_b) then
                  high = b
               else
                  low = a
               end if
            end do
            call suite%close_to(gap%gap(i), gap_a, 1.0e-9_wp, "smallest gap on the roller")
            call suite%close_to(gap%x(i), place, 1.0e-4_wp, "where it is")
         end do
      end do
   end subroutine locus_on_roller

   !> Gap [mm] between a conical wheel and a roller at a lateral position of the track, on the section at a position x of the
   !> wheel's axes; and where this is along the track
   subroutine gap_by_hand(placement, rail, x, y, gap, place)
      type(wheel_rail_placement), intent(in) :: placement
      !> In track coordinates
      type(profile_curve), intent(in) :: rail
      real(wp), intent(in) :: x, y
      real(wp), intent(out) :: gap, place
      real(wp) :: point(3), ends(2), middle, rho
      integer :: n

      ends = [-50.0_wp, 50.0_wp]
      do n = 1, 60
         middle = 0.5_wp*(ends(1) + ends(2))
         point = placement%wheel%to_parent([x, middle, sqrt((460.0_wp + height + slope*middle)**2 - x**2) - 460.0_wp])
         if (point(2) < y) then
            ends(1) = middle
         else
            ends(2) = middle
         end if
      end do
      place = point(1)
      rho = placement%roller_radius - rail%height(y)
      gap = rail%height(y) + place**2/(rho + sqrt(rho**2 - place**2)) - point(3)
   end subroutine gap_by_hand

   !> A ball of 500 mm on a plane: the gap is that of a sphere
   subroutine sphere_on_plane(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: radius = 500.0_wp, pen = 0.1_wp
      type(profile_curve) :: rail, wheel, in_track
      type(error_type), allocatable :: error
      type(wheel_rail_spec) :: pair
      type(wheel_rail_placement) :: placement
      type(gap_curve) :: gap
      type(contact_region), allocatable :: regions(:), misses(:)
      type(frame) :: plane
      type(distance_scratch) :: scratch
      type(potential_contact) :: grid
      real(wp), allocatable :: h(:, :), y(:)
      real(wp) :: approach, exact, worst
      integer :: i, ix, iy, left_out

      y = [(real(i, wp), i=-60, 60)]*0.5_wp
      call write_profile("plane.txt", y, 0.0_wp*y)
      call write_profile("ball.txt", -y, sqrt(radius**2 - y**2) - radius)
      call profile_of("plane.txt", profile_side%rail, rail, error)
      if (.not. allocated(error)) call profile_of("ball.txt", profile_side%wheel, wheel, error)
      call suite%check(.not. allocated(error), "profiles of a plane and a ball")
      if (allocated(error)) return
      pair%track%gaught = 0.0_wp
      pair%wheelset%fbdist = 0.0_wp
      pair%wheelset%fbpos = 0.0_wp
      pair%wheelset%nomradw = radius
      pair%wheelset%yaw = 0.01_wp
      pair%search%dx = 0.2_wp
      pair%search%ds = 0.2_wp
      call place_wheel_rail(pair, wheel, 0.0_wp, 0.0_wp, pen, [0.0_wp, 0.0_wp], placement)
      in_track = rail_in_track(rail, placement)
      call measure_gap(in_track, wheel, placement, pair%search%ds, gap)
      call suite%close_to(smallest_gap(gap), -pen, 1.0e-5_wp, "smallest gap")
      call find_regions(gap, 0.0_wp, pair%search, 2, regions, misses)
      call suite%equal(size(regions), 1, "one patch")
      if (size(regions) /= 1) return
      call suite%close_to([regions(1)%x, regions(1)%y, regions(1)%alpha], [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-6_wp, "reference")
      call suite%close_to(regions(1)%box%y, [-1.0_wp, 1.0_wp]*sqrt(2.0_wp*radius*pen - pen**2), 1.0e-3_wp, "lateral extent")
      call suite%close_to(regions(1)%box%x, [-1.0_wp, 1.0_wp]*sqrt(2.0_wp*radius*pen), 1.0e-3_wp, "longitudinal extent")
      plane = patch_frame(in_track, placement, regions(1))
      call patch_grid(in_track, [pair%search%dx, pair%search%ds], regions(1), plane, [0.0_wp, 0.0_wp], 20000, grid)
      call start_places(in_track, regions(1), scratch)
      call undeformed_distance(in_track, wheel, placement, plane, scratch, grid, h, approach, left_out)
      worst = 0.0_wp
      do iy = 1, grid%my
         do ix = 1, grid%mx
            exact = radius - sqrt(radius**2 - grid%x(ix)**2 - grid%y(iy)**2)
            worst = max(worst, abs(h(ix, iy) - approach + pen - exact))
         end do
      end do
      call suite%close_to(approach, pen, 1.0e-5_wp, "approach")
      call suite%close_to(worst, 0.0_wp, 1.0e-6_wp, "undeformed distance of a sphere")
      call suite%check(patch_is_covered(grid, regions(1)), "one element more than the patch on each side")

      call patch_grid(in_track, [pair%search%dx, pair%search%ds], regions(1), plane, [0.0_wp, 0.0_wp], 2000, grid)
      call suite%check(grid%npot() < 2000 .and. grid%dx >= 0.4_wp, "larger elements where there would be too many")
      call find_regions(gap, -2.0_wp*pen, pair%search, 2, regions, misses)
      call suite%check(size(regions) == 0 .and. size(misses) == 1, "a lifted wheel: a near miss")
      if (size(misses) == 1) call suite%close_to(misses(1)%gap, pen, 1.0e-5_wp, "its gap")
   end subroutine sphere_on_plane

   pure logical function patch_is_covered(grid, region)
      type(potential_contact), intent(in) :: grid
      type(contact_region), intent(in) :: region

      patch_is_covered = grid%xl + grid%dx <= region%box%x(1) .and. grid%xl + (grid%mx - 1)*grid%dx >= region%box%x(2) &
         & .and. grid%yl + grid%dy <= region%box%y(1) .and. grid%yl + (grid%my - 1)*grid%dy >= region%box%y(2)
   end function patch_is_covered

   !> Left and right are mirror images: the same numbers from mirrored input
   subroutine mirrored_wheel(suite)
      type(test_suite), intent(inout) :: suite
      type(profile_curve) :: wheel
      type(error_type), allocatable :: error
      type(wheel_rail_spec) :: pair
      type(wheel_rail_placement) :: right, left

      call profile_of("ball.txt", profile_side%wheel, wheel, error)
      if (allocated(error)) return
      pair%wheelset%y = 3.0_wp
      pair%wheelset%roll = -0.01_wp
      pair%wheelset%yaw = 0.02_wp
      pair%rail%dy = 0.5_wp
      pair%rail%roll = 0.003_wp
      call place_wheel_rail(pair, wheel, 0.0_wp, -40.0_wp, 0.1_wp, [0.0_wp, 0.0_wp], right)
      pair%left = .true.
      pair%wheelset%y = -3.0_wp
      pair%wheelset%roll = 0.01_wp
      pair%wheelset%yaw = -0.02_wp
      pair%rail%dy = -0.5_wp
      pair%rail%roll = -0.003_wp
      call place_wheel_rail(pair, wheel, 0.0_wp, -40.0_wp, 0.1_wp, [0.0_wp, 0.0_wp], left)
      call suite%check(all(right%wheel%origin == left%wheel%origin) .and. all(right%wheel%axes == left%wheel%axes) &
         & .and. all(right%rail%origin == left%rail%origin) .and. all(right%rail%axes == left%rail%axes), &
         & "mirrored input gives the same pair, to the last bit")
   end subroutine mirrored_wheel

   !> A rail below the steep back of the flange, or beside the wheel: estimates of the gap are finite, and the smallest one is right
   subroutine back_of_flange(suite)
      type(test_suite), intent(inout) :: suite
      !> Yaw [rad]; radii of rollers [mm], 0 for a track
      real(wp), parameter :: yaw(3) = [0.0_wp, 8.0e-3_wp, -3.0e-2_wp], radius(2) = [0.0_wp, 500.0_wp]
      !> Least element [mm]; gaps over flanks are accurate to some 1e-10 mm
      real(wp), parameter :: side = 1.0_wp, on_flank = 1.0e-9_wp
      type(profile_curve) :: rail, wheel, in_track
      type(error_type), allocatable :: error
      type(wheel_rail_spec) :: pair
      type(wheel_rail_placement) :: placement
      type(gap_curve) :: whole, surveyed
      character(len=48) :: what
      real(wp) :: top_z, gauge_y
      integer :: i, j, k

      call profile_of(environment("CONTACT_SOURCE") // "/examples/profiles/60E1.prr", profile_side%rail, rail, error)
      if (.not. allocated(error)) call profile_of(environment("CONTACT_SOURCE") // "/examples/profiles/S1002.prw", &
         & profile_side%wheel, wheel, error)
      call suite%check(.not. allocated(error), "profiles of the examples")
      if (allocated(error)) return
      call gauge_point(rail, 0.0_wp, 14.0_wp, top_z, gauge_y)
      pair%wheelset%z = 0.0_wp
      do j = 1, size(radius)
         pair%roller = radius(j) > 0.0_wp
         pair%track%nomradr = radius(j)
         do k = 1, size(yaw)
            pair%wheelset%yaw = yaw(k)
            do i = 0, 14
               pair%wheelset%y = -140.0_wp + 20.0_wp*i
               write(what, "(a,f6.0,a,f7.3,a,f5.0)") "y =", pair%wheelset%y, " mm, yaw", yaw(k), " rad, roller", radius(j)
               call place_wheel_rail(pair, wheel, top_z, gauge_y, -60.0_wp, [0.0_wp, 0.0_wp], placement)
               in_track = rail_in_track(rail, placement)
               call measure_gap(in_track, wheel, placement, side, whole)
               call measure_gap(in_track, wheel, placement, side, surveyed, reach=0.2_wp)
               call suite%check(all(surveyed%gap <= no_surface), what // ": estimates are numbers")
               call suite%close_to(smallest_gap(surveyed), smallest_gap(whole), on_flank, what // ": smallest gap")
            end do
         end do
      end do
   end subroutine back_of_flange

   subroutine benchmark(suite)
      type(test_suite), intent(inout) :: suite
      character(len=:), allocatable :: folder
      type(profile_curve) :: rail, wheel, in_track
      type(error_type), allocatable :: error
      type(wheel_rail_spec) :: pair
      type(wheel_rail_placement) :: placement
      type(gap_curve) :: gap
      type(contact_region), allocatable :: regions(:), misses(:)
      type(frame) :: plane
      type(distance_scratch) :: scratch
      type(potential_contact) :: grid
      real(wp), allocatable :: h(:, :)
      real(wp) :: top_z, gauge_y, approach
      character(len=16) :: what
      logical :: there
      integer :: k, left_out
      !> Lateral position, roll, yaw, height of the wheelset; then published: reference x, y, z, contact angle, approach
      !> (an inclined one hangs on the height of 4 decimals), number of elements
      real(wp), parameter :: cases(10, 8) = reshape([ &
         & 0.0_wp, 0.0_wp, 0.0_wp, 0.1981_wp, 0.0_wp, 751.8726_wp, 0.1252_wp, -0.0290_wp, 0.01596_wp, 3999.0_wp, &
         & 0.5_wp, -0.00002304_wp, 0.0012_wp, 0.1938_wp, -0.8614_wp, 744.5026_wp, 0.4289_wp, -0.0568_wp, 0.01948_wp, 3995.0_wp, &
         & 1.0_wp, -0.00005049_wp, 0.0024_wp, 0.1839_wp, -1.7013_wp, 741.9908_wp, 0.5753_wp, -0.0696_wp, 0.02448_wp, 2550.0_wp, &
         & 3.0_wp, -0.0001803_wp, 0.0072_wp, 0.1143_wp, -4.999_wp, 739.9698_wp, 0.7367_wp, -0.0923_wp, 0.02439_wp, 1632.0_wp, &
         & 5.0_wp, -0.0003554_wp, 0.012_wp, 0.0015_wp, -6.9999_wp, 727.0855_wp, 3.0041_wp, -0.2905_wp, 0.02719_wp, 3960.0_wp, &
         & 5.5_wp, -0.0004777_wp, 0.0132_wp, -0.0866_wp, -7.37_wp, 726.1169_wp, 3.3006_wp, -0.3363_wp, 0.02926_wp, 969.0_wp, &
         & 6.5_wp, -0.004376_wp, 0.0156_wp, -3.0468_wp, 5.801_wp, 718.4931_wp, 10.3654_wp, -1.1591_wp, 0.03623_wp, 1164.0_wp, &
         & 10.0_wp, -0.01126431_wp, 0.024_wp, -8.2668_wp, -5.2821_wp, 721.088_wp, 6.5066_wp, -0.7992_wp, 0.03411_wp, 781.0_wp], &
         & [10, 8])

      folder = environment("CONTACT_REFERENCE")
      there = len(folder) > 0
      if (there) inquire(file=folder // "/examples/MBench_UIC60_v3.prr", exist=there)
      if (.not. there) then
         call suite%skip("benchmark", "the profiles of the reference folder are not available")
         return
      end if
      call profile_of(folder // "/examples/MBench_UIC60_v3.prr", profile_side%rail, rail, error)
      if (.not. allocated(error)) call profile_of(folder // "/examples/MBench_S1002_v3.prw", profile_side%wheel, wheel, error)
      call suite%check(.not. allocated(error), "profiles of the benchmark")
      if (allocated(error)) return
      call gauge_point(rail, 0.0_wp, 14.0_wp, top_z, gauge_y)
      call suite%close_to(gauge_y, -43.0326_wp, 1.0e-4_wp, "gauge point")
      pair%search%dx = 0.2_wp
      pair%search%ds = 0.2_wp
      do k = 1, size(cases, 2)
         write(what, "(a,f5.1)") "y =", cases(1, k)
         pair%wheelset%y = cases(1, k)
         pair%wheelset%roll = cases(2, k)
         pair%wheelset%yaw = cases(3, k)
         call place_wheel_rail(pair, wheel, top_z, gauge_y, cases(4, k), [0.0_wp, 0.0_wp], placement)
         in_track = rail_in_track(rail, placement)
         call measure_gap(in_track, wheel, placement, pair%search%ds, gap)
         call compare_survey(suite, trim(what), in_track, wheel, placement, pair%search%ds, gap, 1.0e-12_wp)
         call surveys_of_yawed_wheels(suite, trim(what), pair, rail, wheel, top_z, gauge_y, cases(4, k))
         call find_regions(gap, 0.0_wp, pair%search, 2, regions, misses)
         call suite%equal(size(regions), 1, trim(what) // ": one patch")
         if (size(regions) /= 1) cycle
         plane = patch_frame(in_track, placement, regions(1))
         call suite%close_to(plane%origin, cases(5:7, k), 3.5e-3_wp, trim(what) // ": contact reference")
         call suite%close_to(plane%roll(), cases(8, k), 1.0e-4_wp, trim(what) // ": contact angle")
         call patch_grid(in_track, [pair%search%dx, pair%search%ds], regions(1), plane, [0.0_wp, 0.0_wp], 20000, grid)
         call suite%equal(grid%npot(), nint(cases(10, k)), trim(what) // ": elements")
         call start_places(in_track, regions(1), scratch)
         call undeformed_distance(in_track, wheel, placement, plane, scratch, grid, h, approach, left_out)
         call suite%close_to(approach, cases(9, k), 2.5e-4_wp, trim(what) // ": approach")
         call suite%check(size(parts_of(regions(1))) == merge(2, 1, k == 5), trim(what) // ": blended parts")
         if (k == 5 .and. size(parts_of(regions(1))) == 2) call suite%close_to(regions(1)%interaction(1, 2), 0.389_wp, 1.0e-3_wp, &
            & "interaction of blended parts")
      end do
   end subroutine benchmark

   !> Surveys at other yaw angles and for larger elements, up to those of wheels in a switch
   subroutine surveys_of_yawed_wheels(suite, what, pair, rail, wheel, top_z, gauge_y, z)
      type(test_suite), intent(inout) :: suite
      !> Name of the position
      character(len=*), intent(in) :: what
      !> Position of the wheelset
      type(wheel_rail_spec), intent(in) :: pair
      !> Profiles, and placement of the rail as for `place_wheel_rail`
      type(profile_curve), intent(in) :: rail, wheel
      real(wp), intent(in) :: top_z, gauge_y, z
      !> [rad]
      real(wp), parameter :: yaw(4) = [0.0_wp, 1.0e-3_wp, -8.0e-3_wp, 4.0e-2_wp]
      real(wp), parameter :: side = 1.0_wp
      !> Radii of rollers [mm], 0 for a track
      real(wp), parameter :: radius(3) = [0.0_wp, 500.0_wp, 150.0_wp]
      !> Points of the locus are accurate to 1e-11 mm across the track, hence gaps on flanks to some 1e-11, and the minima of
      !> parabolas through points of a coarse mesh, where the gap rises steeply to both sides, to some 1e-10 [mm]
      real(wp), parameter :: on_flank = 1.0e-9_wp
      type(wheel_rail_spec) :: turned
      type(wheel_rail_placement) :: placement
      type(profile_curve) :: in_track
      type(gap_curve) :: whole
      character(len=40) :: angle
      integer :: j, k

      turned = pair
      do j = 1, size(radius)
         turned%roller = radius(j) > 0.0_wp
         turned%track%nomradr = radius(j)
         do k = 1, size(yaw)
            write(angle, "(f8.4,a,f6.0,a)") yaw(k), " rad, roller", radius(j), " mm"
            turned%wheelset%yaw = yaw(k)
            call place_wheel_rail(turned, wheel, top_z, gauge_y, z, [0.0_wp, 0.0_wp], placement)
            in_track = rail_in_track(rail, placement)
            call measure_gap(in_track, wheel, placement, side, whole)
            call compare_survey(suite, what // ", yaw" // trim(angle), in_track, wheel, placement, side, whole, on_flank)
         end do
      end do
   end subroutine surveys_of_yawed_wheels

   !> A gap that is found exactly near its smallest value only, against one that is found everywhere
   subroutine compare_survey(suite, what, rail, wheel, placement, ds, whole, tolerance)
      type(test_suite), intent(inout) :: suite
      !> Name of the position
      character(len=*), intent(in) :: what
      !> As for `measure_gap`
      type(profile_curve), intent(in) :: rail, wheel
      type(wheel_rail_placement), intent(in) :: placement
      real(wp), intent(in) :: ds
      !> The gap of this position
      type(gap_curve), intent(in) :: whole
      !> Of the smallest gap [mm]
      real(wp), intent(in) :: tolerance
      !> [mm]; estimates are right within their own bound
      real(wp), parameter :: reach = 0.2_wp, estimate_error = 0.05_wp
      type(gap_curve) :: surveyed
      integer :: estimated

      call measure_gap(rail, wheel, placement, ds, surveyed, reach=reach)
      call suite%close_to(smallest_gap(surveyed), smallest_gap(whole), tolerance, what // ": smallest gap, &
         &estimates beyond")
      associate (difference => abs(surveyed%gap - whole%gap), near => whole%gap < minval(whole%gap) + reach)
         call suite%close_to(maxval(difference, mask=near), 0.0_wp, 1.0e-10_wp, what // ": gaps within reach")
         call suite%close_to(maxval(difference, mask=whole%gap < no_surface), 0.0_wp, estimate_error, what // ": estimates")
         estimated = count(difference > 1.0e-9_wp)
      end associate
      call suite%check(estimated > whole%n/4, what // ": much of the gap is estimated")
   end subroutine compare_survey
end program test_search
