!> Rails that vary along the track, wheels that are out of round: gap, patches, undeformed distance
!>
!> A prismatic rail and a round wheel written as slices give the results of the profiles themselves; a tilted plane
!> and a wheel with a wave have known gaps.
program test_variable
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_grid_potential_contact, only : potential_contact
   use contact_profile_request, only : profile_request, profile_side
   use contact_profile_store, only : load_profile, prepared_profile
   use contact_profile_surface, only : surface_cut
   use contact_test_files, only : write_file
   use contact_test_harness, only : environment, reference_folder, test_suite
   use contact_wheelrail_bodies, only : find_rail, find_wheel, wheel_rail_bodies, place_bodies
   use contact_wheelrail_flat_patch, only : distance_scratch, patch_frame, patch_grid, start_places, &
      & undeformed_distance
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_gap, only : gap_curve, measure_gap, no_surface, rail_in_track
   use contact_wheelrail_placement, only : place_wheel_rail
   use contact_wheelrail_region, only : contact_region
   use contact_wheelrail_regions, only : find_regions, smallest_gap
   use contact_wheelrail_spec, only : wheel_rail_spec
   use contact_wheelrail_variable, only : measure_variable_gap, variable_distance
   implicit none (type, external)
   character(len=*), parameter :: nl = new_line("a")
   type(test_suite) :: suite
   type(prepared_profile) :: rail, wheel, rail_slices, wheel_slices
   logical :: ready

   call suite%start("variable")
   call prepare(suite)
   if (ready) call same_as_profiles(suite)
   if (ready) call ramp(suite)
   if (ready) call wave(suite)
   if (ready) call turning(suite)
   if (ready) call dent(suite)
   if (ready) call dip(suite)
   if (ready) call widening(suite)
   if (ready) call ends(suite)
   if (ready) call moving_head(suite)
   call published(suite)
   call suite%finish()

contains

   !> A slices file; the same profile file in all slices
   function same_slices(file, first, step, n) result(text)
      character(len=*), intent(in) :: file
      real(wp), intent(in) :: first, step
      integer, intent(in) :: n
      character(len=:), allocatable :: text
      character(len=30) :: number
      integer :: i

      write(number, "(i0)") n
      text = "0 1 U_OFFSET" // nl // trim(number) // nl // "0 0 0" // nl // "1" // nl
      do i = 1, n
         write(number, "(f20.12)") first + (i - 1)*step
         text = text // number // " '" // file // "'" // nl
      end do
   end function same_slices

   subroutine load(suite, file, side, profile, scale, mirror_z)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: file
      integer, intent(in) :: side
      type(prepared_profile), intent(out) :: profile
      real(wp), intent(in), optional :: scale
      integer, intent(in), optional :: mirror_z
      type(profile_request) :: request
      type(error_type), allocatable :: error
      type(log_type) :: log

      request%file = file
      if (present(scale)) request%scale = scale
      if (present(mirror_z)) request%mirror_z = mirror_z
      request%side = side
      call load_profile(request, profile, log, error)
      if (.not. allocated(error)) return
      call suite%check(.false., full_text(error))
      ready = .false.
   end subroutine load

   subroutine prepare(suite)
      type(test_suite), intent(inout) :: suite
      character(len=:), allocatable :: folder

      ready = .true.
      folder = environment("CONTACT_SOURCE") // "/examples/profiles/"
      call load(suite, folder // "60E1.prr", profile_side%rail, rail)
      call load(suite, folder // "S1002.prw", profile_side%wheel, wheel)
      call write_file("rail.slcs", same_slices(folder // "60E1.prr", -200.0_wp, 80.0_wp, 6))
      call load(suite, "rail.slcs", profile_side%rail, rail_slices)
      call write_file("wheel.slcw", same_slices(folder // "S1002.prw", -0.5_wp, 0.2_wp, 6))
      call load(suite, "wheel.slcw", profile_side%wheel, wheel_slices)
   end subroutine prepare

   !> A wheelset with lateral position and yaw on a rail placed absolutely
   function pair_at(y, yaw) result(pair)
      real(wp), intent(in) :: y, yaw
      type(wheel_rail_spec) :: pair

      pair%track%gaught = -1.0_wp
      pair%track%raily0 = 755.0_wp
      pair%track%cant = 0.025_wp
      pair%wheelset%y = y
      pair%wheelset%yaw = yaw
      pair%search%dx = 0.5_wp
      pair%search%ds = 0.5_wp
   end function pair_at

   !> Tread and flange contact of S1002 on 60E1: both descriptions agree
   subroutine same_as_profiles(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: y(2) = [0.0_wp, 6.5_wp], yaw(2) = [0.0_wp, 0.0156_wp]
      type(wheel_rail_spec) :: pair
      integer :: k

      do k = 1, size(y)
         pair = pair_at(y(k), yaw(k))
         call compare(suite, pair, "rail of slices", with_rail=.true., with_wheel=.false.)
         call compare(suite, pair, "wheel of slices", with_rail=.false., with_wheel=.true.)
         call compare(suite, pair, "both of slices", with_rail=.true., with_wheel=.true.)
      end do
   end subroutine same_as_profiles

   subroutine compare(suite, pair, what, with_rail, with_wheel)
      type(test_suite), intent(inout) :: suite
      type(wheel_rail_spec), intent(in) :: pair
      character(len=*), intent(in) :: what
      logical, intent(in) :: with_rail, with_wheel
      type(wheel_rail_bodies) :: bodies
      type(gap_curve) :: one, two
      type(contact_region), allocatable :: first(:), second(:), misses(:)
      integer :: left_out
      type(frame) :: plane
      type(distance_scratch) :: scratch
      type(potential_contact) :: grid
      real(wp), allocatable :: h(:, :), same(:, :)
      real(wp) :: z, pen, same_pen

      call place_wheel_rail(pair, wheel%curve, 0.0_wp, 0.0_wp, 0.0_wp, [0.0_wp, 0.0_wp], bodies%placement)
      bodies%rail = rail_in_track(rail%curve, bodies%placement)
      bodies%wheel = wheel%curve
      call measure_gap(bodies%rail, bodies%wheel, bodies%placement, pair%search%ds, one)
      call put_sections(bodies, pair, with_rail, with_wheel)
      call measure_variable_gap(bodies, pair%search%ds, .true., two)
      call suite%close_to(smallest_gap(two), smallest_gap(one), 2.0e-5_wp, what // ": smallest gap")

      z = smallest_gap(one) + 0.05_wp
      call find_regions(one, z, pair%search, 2, first, misses)
      call find_regions(two, z, pair%search, 2, second, misses)
      call suite%equal(size(second), size(first), what // ": number of patches")
      if (size(second) /= 1 .or. size(first) /= 1) return
      call suite%close_to([second%x, second%y], [first%x, first%y], 1.0e-2_wp, what // ": position of the patch")
      call suite%close_to(second%alpha, first%alpha, 1.0e-3_wp, what // ": its angle")
      call suite%close_to(second(1)%box%x, first(1)%box%x, 0.3_wp, what // ": its length")
      call suite%close_to(second(1)%box%y, first(1)%box%y, 0.1_wp, what // ": its width")
      call suite%close_to(second%weight/first%weight, [1.0_wp], 2.0e-2_wp, what // ": its weight")

      ! Weights from the gap of the locus: the same formula as for profiles
      call measure_variable_gap(bodies, pair%search%ds, .false., two)
      call find_regions(two, z, pair%search, 2, second, misses)
      call suite%equal(size(second), size(first), what // ": number of patches, weights of the locus")
      if (size(second) /= 1) return
      call suite%close_to([second%x, second%y], [first%x, first%y], 1.0e-2_wp, what // ": position, weights of the locus")
      call suite%close_to(second%weight/first%weight, [1.0_wp], 2.0e-3_wp, what // ": weight of the locus")

      call place_wheel_rail(pair, wheel%curve, 0.0_wp, 0.0_wp, z, [0.0_wp, 0.0_wp], bodies%placement)
      plane = patch_frame(bodies%rail, bodies%placement, first(1))
      call patch_grid(bodies%rail, [pair%search%dx, pair%search%ds], first(1), plane, [0.0_wp, 0.0_wp], 20000, grid)
      call start_places(bodies%rail, first(1), scratch)
      call undeformed_distance(bodies%rail, bodies%wheel, bodies%placement, plane, scratch, grid, h, pen, left_out)
      call variable_distance(bodies, plane, .false., grid, same, same_pen, left_out)
      call suite%close_to(same_pen, pen, 2.0e-5_wp, what // ": approach")
      ! Slices are sampled every 0.5 mm, which shows at the jumps of curvature between arcs
      call suite%close_to(pack(same - h, h < 2.0_wp*pen), 0.0_wp*pack(h, h < 2.0_wp*pen), 1.0e-4_wp, &
         & what // ": undeformed distance")
   end subroutine compare

   subroutine put_sections(bodies, pair, with_rail, with_wheel)
      type(wheel_rail_bodies), intent(inout) :: bodies
      type(wheel_rail_spec), intent(in) :: pair
      logical, intent(in) :: with_rail, with_wheel

      if (with_rail .and. with_wheel) then
         call place_bodies(bodies, pair%wheelset%s, pair%wheelset%pitch, pair%search%dx, rail_slices%surface, wheel_slices%surface)
      else if (with_rail) then
         call place_bodies(bodies, pair%wheelset%s, pair%wheelset%pitch, pair%search%dx, rail_slices%surface, wheel%surface)
      else
         call place_bodies(bodies, pair%wheelset%s, pair%wheelset%pitch, pair%search%dx, rail%surface, wheel_slices%surface)
      end if
   end subroutine put_sections

   !> A plane with a slope of 1:10 along the track, and a cylinder: contact behind the middle where slopes agree
   subroutine ramp(suite)
      type(test_suite), intent(inout) :: suite
      type(prepared_profile) :: plane, cylinder
      type(wheel_rail_spec) :: pair
      type(wheel_rail_bodies) :: bodies
      type(gap_curve) :: gap
      type(contact_region), allocatable :: regions(:), misses(:)
      character(len=:), allocatable :: text
      character(len=1) :: k
      real(wp) :: angle, exact
      integer :: i, j

      text = "0 1" // nl // "5" // nl // "0 0 0" // nl // "1" // nl
      do i = 1, 5
         write(k, "(i0)") i
         text = text // "  " // trim(number(100.0_wp*(i - 3))) // " 'plane" // k // ".txt'" // nl
         call write_file("plane" // k // ".txt", plane_table(-10.0_wp*(i - 3)))
      end do
      call write_file("plane.slcs", text)
      text = ""
      do j = -40, 40
         text = text // trim(number(-real(j, wp))) // " 0" // nl
      end do
      call write_file("cylinder.txt", text)
      call load(suite, "plane.slcs", profile_side%rail, plane)
      call load(suite, "cylinder.txt", profile_side%wheel, cylinder)
      if (.not. ready) return

      pair = pair_at(0.0_wp, 0.0_wp)
      pair%track%cant = 0.0_wp
      pair%track%raily0 = 750.0_wp
      call place_wheel_rail(pair, cylinder%curve, 0.0_wp, 0.0_wp, 0.0_wp, [0.0_wp, 0.0_wp], bodies%placement)
      bodies%rail = rail_in_track(plane%curve, bodies%placement)
      bodies%wheel = cylinder%curve
      call place_bodies(bodies, 37.0_wp, 0.0_wp, 1.0_wp, plane%surface, cylinder%surface)
      call measure_variable_gap(bodies, 0.5_wp, .true., gap)
      ! On the slope z = -(37 + x)/10: nearest where the circle has it, too
      angle = atan(0.1_wp)
      exact = -3.7_wp - (460.0_wp/cos(angle) - 460.0_wp)
      call suite%close_to(smallest_gap(gap), exact, 1.0e-6_wp, "gap over a ramp")
      i = gap%n/2
      call suite%close_to(gap%x(i), 460.0_wp*sin(angle), 1.0e-3_wp, "where it is smallest")
      call find_regions(gap, smallest_gap(gap) + 0.1_wp, pair%search, 2, regions, misses)
      call suite%equal(size(regions), 1, "one patch on the ramp")
      if (size(regions) /= 1) return
      call suite%close_to(regions(1)%x, 460.0_wp*sin(angle), 1.0e-2_wp, "its position along the track")
      call suite%close_to(regions(1)%y, 750.0_wp, 0.6_wp, "its lateral position")
   end subroutine ramp

   function number(value) result(text)
      real(wp), intent(in) :: value
      character(len=24) :: text

      write(text, "(f18.10)") value
   end function number

   !> A flat profile at a height, 80 mm wide
   function plane_table(z) result(text)
      real(wp), intent(in) :: z
      character(len=:), allocatable :: text
      integer :: j

      text = ""
      do j = -40, 40
         text = text // number(real(j, wp)) // " " // number(z) // nl
      end do
   end function plane_table

   !> A wheel with a flat spot, turned by the pitch: symmetric in the angle, deepest gap at the spot
   subroutine wave(suite)
      type(test_suite), intent(inout) :: suite
      type(prepared_profile) :: plane, spot
      type(wheel_rail_spec) :: pair
      type(wheel_rail_bodies) :: bodies
      type(gap_curve) :: gap(3)
      real(wp), parameter :: pitch(3) = [0.0_wp, 0.03_wp, -0.03_wp]
      integer :: i, j

      call write_file("flat.txt", plane_table(0.0_wp))
      call load(suite, "flat.txt", profile_side%rail, plane)
      call write_spot("spot", 0.4_wp, 0.05_wp)
      call load(suite, "spot.slcw", profile_side%wheel, spot)
      if (.not. ready) return
      pair = pair_at(0.0_wp, 0.0_wp)
      pair%track%cant = 0.0_wp
      pair%track%raily0 = 750.0_wp
      call place_wheel_rail(pair, spot%curve, 0.0_wp, 0.0_wp, 0.0_wp, [0.0_wp, 0.0_wp], bodies%placement)
      bodies%rail = rail_in_track(plane%curve, bodies%placement)
      bodies%wheel = spot%curve
      do i = 1, 3
         call place_bodies(bodies, 0.0_wp, pitch(i), 1.0_wp, plane%surface, spot%surface)
         call measure_variable_gap(bodies, 0.5_wp, .true., gap(i))
      end do
      j = gap(1)%n/2
      ! Lowest point of r(theta) cos(theta + pitch), by brute force
      ! Slices are 0.01 rad apart: h**4/384 times the fourth derivative is 2e-5 mm
      call suite%close_to(gap(1)%gap(j), smallest_by_hand(0.0_wp), 2.0e-5_wp, "gap under the spot")
      call suite%close_to(gap(2)%gap(j), smallest_by_hand(0.03_wp), 2.0e-5_wp, "gap beside the contact")
      call suite%close_to(gap(3)%gap(j), gap(2)%gap(j), 1.0e-8_wp, "symmetric in the pitch")
      call suite%close_to(gap(3)%x(j), -gap(2)%x(j), 1.0e-6_wp, "and the position along the track")
      call write_spot("ends", 0.9_wp, 0.03_wp)
      call load(suite, "ends.slcw", profile_side%wheel, spot)
      if (.not. ready) return
      bodies%wheel = spot%curve
      call place_bodies(bodies, 0.0_wp, 0.0_wp, 0.5_wp, plane%surface, spot%surface)
      call measure_variable_gap(bodies, 0.5_wp, .true., gap(1), depth=0.5_wp)
      call two_spots(suite, gap(1), pair)
   end subroutine wave

   !> A wheel that turns keeps its sections: gaps are those of bodies that are placed for the first time, also after a full turn,
   !> and after another wheel
   subroutine turning(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: pitch(8) = [0.0_wp, 0.004_wp, 0.0501_wp, 0.02_wp, 6.3_wp, 0.021_wp, -3.0e7_wp, 0.021_wp]
      !> Force of 100 kN over the stiffness of steel [mm2]
      real(wp), parameter :: load_of_wheel = 0.88_wp
      !> Kept sections may be shorter or longer than new ones [mm]
      real(wp), parameter :: round_off = 1.0e-11_wp
      type(prepared_profile) :: plane, plain, spots(2)
      type(wheel_rail_spec) :: pair
      type(wheel_rail_bodies) :: bodies, new
      type(gap_curve) :: kept, fresh
      integer :: i, k

      call load(suite, "flat.txt", profile_side%rail, plane)
      call write_spot("spot", 0.4_wp, 0.05_wp)
      call load(suite, "spot.slcw", profile_side%wheel, spots(1))
      call write_spot("other", 0.3_wp, 0.04_wp)
      call load(suite, "other.slcw", profile_side%wheel, spots(2))
      if (.not. ready) return
      pair = pair_at(0.0_wp, 0.01_wp)
      pair%track%cant = 0.0_wp
      pair%track%raily0 = 750.0_wp
      do i = 1, size(pitch)
         k = merge(2, 1, i == 4)
         associate (spot => spots(k))
            call place_wheel_rail(pair, spot%curve, 0.0_wp, 0.0_wp, 0.0_wp, [0.0_wp, 0.0_wp], bodies%placement)
            bodies%rail = rail_in_track(plane%curve, bodies%placement)
            bodies%wheel = spot%curve
            call place_bodies(bodies, 0.0_wp, pitch(i), 1.0_wp, plain%surface, spot%surface)
            call measure_variable_gap(bodies, 0.5_wp, .true., kept, load=load_of_wheel)
            new = wheel_rail_bodies(rail=bodies%rail, wheel=bodies%wheel, placement=bodies%placement)
            call place_bodies(new, 0.0_wp, pitch(i), 1.0_wp, plain%surface, spot%surface)
            call measure_variable_gap(new, 0.5_wp, .true., fresh, load=load_of_wheel)
         end associate
         call suite%equal(size(kept%table), size(fresh%table), "as large a table")
         if (size(kept%table) /= size(fresh%table)) cycle
         call suite%close_to(kept%gap, fresh%gap, round_off, "smallest gaps of a wheel that has turned")
         call suite%close_to(reshape(kept%table, [size(kept%table)]), reshape(fresh%table, [size(fresh%table)]), round_off, &
            & "gaps of a wheel that has turned")
         ! a wheel of 460 mm on a plane: a line contact of 80 mm, for which Hertz's theory of points is rough
         call suite%check(kept%depth > 0.05_wp .and. kept%depth <= 1.0_wp, "a depth for the force")
      end do
   end subroutine turning

   !> Slices of a plane wheel with a flat that fades out on both sides
   subroutine write_spot(name, depth, width)
      character(len=*), intent(in) :: name
      !> [mm] and [rad]
      real(wp), intent(in) :: depth, width
      character(len=:), allocatable :: text
      character(len=2) :: k
      real(wp) :: theta
      integer :: i

      text = "0 1" // nl // "41" // nl // "0 0 0" // nl // "1" // nl
      do i = 1, 41
         write(k, "(i0)") i
         theta = 0.01_wp*(i - 21)
         call write_file(name // trim(k) // ".txt", straight(-depth*exp(-(theta/width)**2)))
         text = text // number(theta) // " '" // name // trim(k) // ".txt'" // nl
      end do
      call write_file(name // ".slcw", text)
   end subroutine write_spot

   !> A wheel on the two ends of its flat has two patches, unless they are to be combined
   subroutine two_spots(suite, gap, pair)
      type(test_suite), intent(inout) :: suite
      type(gap_curve), intent(in) :: gap
      type(wheel_rail_spec), intent(in) :: pair
      type(contact_region), allocatable :: regions(:), misses(:)
      type(wheel_rail_spec) :: near
      real(wp) :: theta, lowest, here, place
      integer :: i

      lowest = huge(lowest)
      do i = 1, 20000
         theta = 1.0e-5_wp*i
         here = -(460.0_wp - 0.9_wp*exp(-(theta/0.03_wp)**2))*cos(theta)
         if (here >= lowest) cycle
         lowest = here
         place = 460.0_wp*sin(theta)
      end do
      call find_regions(gap, smallest_gap(gap) + 0.02_wp, pair%search, 2, regions, misses)
      call suite%equal(size(regions), 2, "two spots")
      if (size(regions) /= 2) return
      call suite%close_to(abs(regions%x), [place, place], 0.2_wp, "positions of the contacts")
      call suite%check(regions(1)%x*regions(2)%x < 0.0_wp, "one upstream and one downstream")
      call suite%close_to(regions(1)%weight/regions(2)%weight, 1.0_wp, 1.0e-3_wp, "equal contacts")
      call suite%check(all([regions(1)%box%x*sign(1.0_wp, regions(1)%x), regions(2)%box%x*sign(1.0_wp, regions(2)%x)] > 0.0_wp), &
         & "their bounds do not cross the middle")
      near = pair
      near%search%d_sep = 60.0_wp
      call find_regions(gap, smallest_gap(gap) + 0.02_wp, near%search, 2, regions, misses)
      call suite%equal(size(regions), 1, "blended spots")
      if (size(regions) == 1) call suite%equal(size(regions(1)%part), 2, "two parts")
      near%search%d_comb = 60.0_wp
      call find_regions(gap, smallest_gap(gap) + 0.02_wp, near%search, 2, regions, misses)
      call suite%equal(size(regions), 1, "combined spots")
      if (size(regions) == 1) call suite%close_to(regions(1)%x, 0.0_wp, 1.0e-2_wp, "their common reference")
      call find_regions(gap, smallest_gap(gap) + 0.4_wp, pair%search, 2, regions, misses)
      call suite%equal(size(regions), 1, "a wheel pressed in as far as its flat is deep has one patch")
   end subroutine two_spots

   !> Slices 1.5 mm apart, of which one is 0.01 mm higher: heights between the sections are those of the surface
   subroutine dent(suite)
      type(test_suite), intent(inout) :: suite
      type(prepared_profile) :: plane, wheel
      type(wheel_rail_spec) :: pair
      type(wheel_rail_bodies) :: bodies
      type(surface_cut) :: exact
      character(len=:), allocatable :: text
      character(len=2) :: k
      real(wp) :: theta, z, z_y, y_there, u_there, there, worst
      logical :: found
      integer :: i, piece

      piece = 0
      call write_file("flat.txt", plane_table(0.0_wp))
      call load(suite, "flat.txt", profile_side%rail, plane)
      call write_file("round.txt", straight(0.0_wp))
      call write_file("high.txt", straight(0.01_wp))
      text = "0 1" // nl // "13" // nl // "0 0 0" // nl // "1" // nl
      do i = 1, 13
         k = merge("'h", "'r", i == 7)
         text = text // number(1.5_wp*(i - 7)/460.0_wp) // " " // k // trim(merge("igh  ", "ound ", i == 7)) // ".txt'" // nl
      end do
      call write_file("dent.slcw", text)
      call load(suite, "dent.slcw", profile_side%wheel, wheel)
      if (.not. ready) return
      pair = pair_at(0.0_wp, 0.0_wp)
      call place_wheel_rail(pair, wheel%curve, 0.0_wp, 0.0_wp, 0.0_wp, [0.0_wp, 0.0_wp], bodies%placement)
      bodies%rail = rail_in_track(plane%curve, bodies%placement)
      bodies%wheel = wheel%curve
      call place_bodies(bodies, 0.0_wp, 1.0e-3_wp, 0.4_wp, plane%surface, wheel%surface)
      worst = 0.0_wp
      do i = -100, 100
         theta = 0.05_wp*i/460.0_wp
         call bodies%wheel_strip%at(theta, 0.1_wp, z, z_y, found)
         call suite%check(found, "the wheel is there")
         call wheel%surface%cut(theta - 1.0e-3_wp, exact)
         call exact%at(0.1_wp, there, y_there, u_there, found, piece)
         worst = max(worst, abs(z - there))
      end do
      call suite%close_to(worst, 0.0_wp, 2.0e-5_wp, "heights between sections")
   end subroutine dent

   !> A wheel that gets wider around its axle: between two sections there is surface where both of them have some
   subroutine widening(suite)
      type(test_suite), intent(inout) :: suite
      type(prepared_profile) :: plane, wheel
      type(wheel_rail_spec) :: pair
      type(wheel_rail_bodies) :: bodies
      character(len=:), allocatable :: text
      character(len=1) :: k
      real(wp) :: place, y, z(3), z_y
      logical :: found(3)
      integer :: i, j, one_only

      call write_file("flat.txt", plane_table(0.0_wp))
      call load(suite, "flat.txt", profile_side%rail, plane)
      text = "0 1" // nl // "6" // nl // "0 0 0" // nl // "1" // nl
      do i = 1, 6
         write(k, "(i0)") i
         call write_file("wide" // k // ".txt", straight(0.0_wp, 0.7_wp + 0.05_wp*i))
         text = text // number(0.02_wp*(i - 3.5_wp)) // " 'wide" // k // ".txt'" // nl
      end do
      call write_file("wide.slcw", text)
      call load(suite, "wide.slcw", profile_side%wheel, wheel)
      if (.not. ready) return
      pair = pair_at(0.0_wp, 0.0_wp)
      call place_wheel_rail(pair, wheel%curve, 0.0_wp, 0.0_wp, 0.0_wp, [0.0_wp, 0.0_wp], bodies%placement)
      bodies%rail = rail_in_track(plane%curve, bodies%placement)
      bodies%wheel = wheel%curve
      call place_bodies(bodies, 0.0_wp, 0.0_wp, 0.4_wp, plane%surface, wheel%surface)
      one_only = 0
      associate (strip => bodies%wheel_strip)
         do i = -30, 30
            place = strip%first + (strip%number_at(0.0_wp) - 1 + i + 0.4_wp)*strip%step
            do j = 0, 160
               y = 28.0_wp + 0.08_wp*j
               call strip%at(place, y, z(1), z_y, found(1))
               associate (number => strip%number_at(0.0_wp) + i)
                  call strip%heights(number, [y], z(2:2), found(2:2))
                  call strip%heights(number + 1, [y], z(3:3), found(3:3))
               end associate
               if (found(2) .neqv. found(3)) one_only = one_only + 1
               if (found(1) .neqv. all(found(2:))) call suite%check(.false., "surface where one section has none, y =" // number(y))
               if (found(1)) call suite%check(abs(z(1) - 0.5_wp*(z(2) + z(3))) < 0.1_wp, "a height between the two")
            end do
         end do
      end associate
      call suite%check(one_only > 20, "positions beyond the end of one section only")
   end subroutine widening

   !> A rail continues unchanged beyond its last slice; a wheel smaller than the coarse mesh is still found in contact
   subroutine ends(suite)
      type(test_suite), intent(inout) :: suite
      type(prepared_profile) :: rail, wheel
      type(wheel_rail_spec) :: pair
      type(wheel_rail_bodies) :: bodies
      type(gap_curve) :: gap
      logical :: weighs
      type(prepared_profile) :: last
      type(gap_curve) :: prismatic
      real(wp), parameter :: place(3) = [1.0e5_wp, 150.3_wp, -150.3_wp]
      integer :: j, k

      call load(suite, "dip.slcs", profile_side%rail, rail)
      call load(suite, "level.txt", profile_side%wheel, wheel)
      if (.not. ready) return
      pair = pair_at(0.0_wp, 0.0_wp)
      pair%track%cant = 0.0_wp
      pair%track%raily0 = 750.0_wp
      do k = 1, 2
         weighs = k == 2
         pair%wheelset%nomradw = 460.0_wp
         call place_wheel_rail(pair, wheel%curve, 0.0_wp, 0.0_wp, 0.0_wp, [0.0_wp, 0.0_wp], bodies%placement)
         bodies%rail = rail_in_track(rail%curve, bodies%placement)
         bodies%wheel = wheel%curve
         do j = 1, 3
            ! far beyond the last slice, and just beyond either end
            call place_bodies(bodies, place(j), 0.0_wp, 0.5_wp, rail%surface, wheel%surface)
            call measure_variable_gap(bodies, 0.5_wp, weighs, gap)
            call load(suite, trim(merge("dip1.txt ", "dip31.txt", place(j) < 0.0_wp)), profile_side%rail, last)
            bodies%rail = rail_in_track(last%curve, bodies%placement)
            call measure_gap(bodies%rail, bodies%wheel, bodies%placement, 0.5_wp, prismatic)
            ! near its end the surface has a corner of 0.04 rad, which sections 0.5 mm apart round off
            call suite%close_to(smallest_gap(gap), smallest_gap(prismatic), merge(1.0e-5_wp, 2.0e-3_wp, j == 1), &
               & "beyond its slices a rail continues")
            call suite%close_to(gap%x(minloc(gap%gap, 1)), 0.0_wp, merge(1.0e-3_wp, 0.5_wp, j == 1), "and is level along the track")
            call suite%check(rail%surface%part_beyond(place(j) + [-1.0_wp, 1.0_wp]) > 0.5_wp, "the part without slices")
         end do
         call suite%close_to(rail%surface%part_beyond([-151.0_wp, -149.0_wp]), 0.5_wp, 1.0e-12_wp, "half of it")
         call suite%close_to(rail%surface%part_beyond([-150.0_wp, 150.0_wp]), 0.0_wp, 0.0_wp, "none of it")
         pair%wheelset%nomradw = 10.0_wp
         call place_wheel_rail(pair, wheel%curve, 0.0_wp, 0.0_wp, 0.0_wp, [0.0_wp, 0.0_wp], bodies%placement)
         call place_bodies(bodies, 0.0_wp, 0.0_wp, 0.5_wp, rail%surface, wheel%surface)
         call measure_variable_gap(bodies, 0.5_wp, weighs, gap)
         call suite%close_to(smallest_gap(gap), 0.8_wp, 1.0e-3_wp, "a small wheel is in contact in the dip")
      end do
   end subroutine ends

   !> A rail with a dip and a crown, twisted so that the wheel is nearest in front of the dip on one side and behind it on
   !> the other: the search agrees with an evaluation of every point, evaluated independently, as deep as requested
   subroutine dip(suite)
      type(test_suite), intent(inout) :: suite
      type(prepared_profile) :: rail, wheel
      type(wheel_rail_spec) :: pair
      type(wheel_rail_bodies) :: bodies
      type(gap_curve) :: gap
      character(len=:), allocatable :: text, points
      character(len=2) :: k
      real(wp), parameter :: yaw(2) = [0.0_wp, 0.02_wp], depth(2) = [0.0_wp, 0.6_wp]
      real(wp), allocatable :: exact(:), place(:)
      logical, allocatable :: near(:)
      real(wp) :: u, middle
      logical :: weighs
      integer :: i, j

      text = "0 1" // nl // "31" // nl // "0 0 0" // nl // "1" // nl
      do i = 1, 31
         write(k, "(i0)") i
         u = 10.0_wp*(i - 16)
         points = ""
         do j = -40, 40
            points = points // number(real(j, wp)) // " " &
               & // number(0.8_wp*exp(-(u/20.0_wp)**2) + j**2/600.0_wp - 1.0e-3_wp*u*j) // nl
         end do
         call write_file("dip" // trim(k) // ".txt", points)
         text = text // number(u) // " 'dip" // trim(k) // ".txt'" // nl
      end do
      call write_file("dip.slcs", text)
      call write_file("level.txt", straight(0.0_wp))
      call load(suite, "dip.slcs", profile_side%rail, rail)
      call load(suite, "level.txt", profile_side%wheel, wheel)
      if (.not. ready) return
      do i = 1, 2
         pair = pair_at(0.0_wp, yaw(i))
         pair%track%cant = 0.0_wp
         pair%track%raily0 = 750.0_wp
         call place_wheel_rail(pair, wheel%curve, 0.0_wp, 0.0_wp, 0.0_wp, [0.0_wp, 0.0_wp], bodies%placement)
         bodies%rail = rail_in_track(rail%curve, bodies%placement)
         bodies%wheel = wheel%curve
         middle = bodies%placement%wheel%origin(1)
         do j = 1, 4
            weighs = j > 2
            call place_bodies(bodies, 0.5_wp - middle, 0.0_wp, 0.5_wp, rail%surface, wheel%surface)
            call measure_variable_gap(bodies, 0.5_wp, weighs, gap, depth(2 - mod(j, 2)))
            call suite%check(allocated(gap%table) .eqv. weighs, "a table when weights come from it")
            call search_everywhere(bodies, gap, exact, place)
            near = gap%gap < minval(exact) + gap%depth
            call suite%check(gap%depth >= depth(2 - mod(j, 2)), "as deep as requested")
            call suite%check(any(near .and. place > middle + 8.0_wp) .and. any(near .and. place < middle - 8.0_wp), &
               & "near in front of the dip and behind it")
            call suite%check(all(near .eqv. exact < minval(exact) + gap%depth), "all that is near is found")
            call suite%close_to(pack(gap%gap - exact, near), 0.0_wp*pack(exact, near), 1.0e-8_wp, "gaps as by every point")
            call suite%close_to(pack(gap%x - place, near), 0.0_wp*pack(exact, near), 1.0e-4_wp, "and their positions")
         end do
      end do
   end subroutine dip

   !> Smallest gap along the track at each lateral position and its abscissa, with every point evaluated independently
   subroutine search_everywhere(bodies, gap, lowest, place)
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> For its mesh
      type(gap_curve), intent(in) :: gap
      real(wp), allocatable, intent(out) :: lowest(:), place(:)
      type(frame) :: track, seen
      real(wp) :: row(-115:115), rail, wheel, s, x, bend, shift
      logical :: there(2)
      integer :: i, j

      allocate(lowest(gap%n), place(gap%n))
      seen = bodies%placement%wheel%seen_from_here(track)
      do j = 1, gap%n
         row = no_surface
         do i = -115, 115
            rail = 0.0_wp
            wheel = 0.0_wp
            s = bodies%wheel%s_at(gap%y(j) - bodies%placement%wheel%origin(2))
            x = bodies%placement%wheel%origin(1) + 0.5_wp*i
            call find_rail(bodies, track, x, gap%y(j), rail, there(1))
            call find_wheel(bodies, seen, x, gap%y(j), s, wheel, there(2))
            if (all(there)) row(i) = rail - wheel
         end do
         i = minloc(row, 1) - 116
         lowest(j) = row(i)
         place(j) = bodies%placement%wheel%origin(1) + 0.5_wp*i
         if (abs(i) == 115) cycle
         if (max(row(i - 1), row(i + 1)) >= no_surface) cycle
         bend = row(i - 1) - 2.0_wp*row(i) + row(i + 1)
         if (.not. bend > 0.0_wp) cycle
         shift = 0.5_wp*(row(i - 1) - row(i + 1))/bend
         lowest(j) = row(i) - 0.5_wp*bend*shift**2
         place(j) = bodies%placement%wheel%origin(1) + 0.5_wp*(i + shift)
      end do
   end subroutine search_everywhere

   !> Points of a straight profile at a height [mm]
   function straight(z, scale) result(text)
      real(wp), intent(in) :: z
      !> Of the lateral positions; 1 when it is absent
      real(wp), intent(in), optional :: scale
      character(len=:), allocatable :: text
      real(wp) :: factor
      integer :: j

      factor = 1.0_wp
      if (present(scale)) factor = scale
      text = ""
      do j = -40, 40
         text = text // number(-factor*real(j, wp)) // " " // number(z) // nl
      end do
   end function straight

   !> Contact references of the published tests of crossings and of wheels with a flat (original program,
   !> revision 2707; the vertical position is given)
   subroutine published(suite)
      type(test_suite), intent(inout) :: suite
      character(len=:), allocatable :: folder

      folder = reference_folder()
      if (folder == "") then
         call suite%skip("published crossings", "CONTACT_REFERENCE is not there")
         return
      end if
      folder = folder // "/testbank/profiles/"
      call crossing(suite, folder, "cross_nose.slcs", 1.0_wp, 0.0_wp, 0.0_wp, -2.1275_wp, &
         & [45.7571_wp, 755.1271_wp, -4.5765_wp, -0.0199_wp])
      call crossing(suite, folder, "wing_rail.slcs", 1.0_wp, 100.0_wp, 0.0_wp, 0.6589_wp, &
         & [-2.4205_wp, 779.2310_wp, 0.0138_wp, -0.0768_wp])
      call crossing(suite, folder, "uk_interrupt_v2.slcs", 1000.0_wp, 110.0_wp, 0.78_wp, -0.87_wp, &
         & [0.001_wp, 779.4804_wp, -1.4751_wp, -0.05_wp])
      call crossing(suite, folder, "uk_crossing.slcs", 1000.0_wp, 239.0_wp, 0.81_wp, -0.2255_wp, &
         & [-3.2075_wp, 788.6406_wp, -1.4259_wp, -0.0961_wp])
   end subroutine published

   !> Inclination of the wheel across the track at the reference of a region [rad], by differences
   real(wp) function wheel_angle(bodies, region) result(angle)
      type(wheel_rail_bodies), intent(inout) :: bodies
      type(contact_region), intent(in) :: region
      real(wp), parameter :: step = 0.01_wp
      type(frame) :: track, seen
      real(wp) :: z(2), place
      logical :: found
      integer :: k

      seen = bodies%placement%wheel%seen_from_here(track)
      do k = 1, 2
         z(k) = 0.0_wp
         place = bodies%wheel%s_at(region%y - bodies%placement%wheel%origin(2))
         call find_wheel(bodies, seen, region%x, region%y + (2*k - 3)*step, place, z(k), found)
         call suite%check(found, "the wheel is above the reference")
      end do
      angle = atan((z(2) - z(1))/(2.0_wp*step))
   end function wheel_angle

   !> The head of a rail that moves sideways below a conical wheel: wheel and rail have one tangent where they touch, also when
   !> the wheel is yawed and touches far from the section below its axle
   subroutine moving_head(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: yaw(3) = [0.0_wp, 0.02_wp, -0.02_wp]
      type(prepared_profile) :: rail, cone
      type(wheel_rail_spec) :: pair
      type(wheel_rail_bodies) :: bodies
      type(gap_curve) :: gap
      type(contact_region), allocatable :: regions(:), misses(:)
      character(len=:), allocatable :: text, points
      character(len=2) :: k
      real(wp) :: u
      integer :: i, j

      text = "0 1" // nl // "21" // nl // "0 0 0" // nl // "1" // nl
      do i = 1, 21
         write(k, "(i0)") i
         u = 10.0_wp*(i - 11)
         points = ""
         do j = -60, 60
            points = points // number(0.1_wp*u + 0.25_wp*j) // " " // number(20.0_wp - sqrt(400.0_wp - (0.25_wp*j)**2)) // nl
         end do
         call write_file("head" // trim(k) // ".txt", points)
         text = text // number(u) // " 'head" // trim(k) // ".txt'" // nl
      end do
      call write_file("head.slcs", text)
      points = ""
      do j = 40, -40, -1
         points = points // number(real(j, wp)) // " " // number(-0.3_wp*j) // nl
      end do
      call write_file("cone.txt", points)
      call load(suite, "head.slcs", profile_side%rail, rail)
      call load(suite, "cone.txt", profile_side%wheel, cone)
      if (.not. ready) return
      do i = 1, 3
         pair = pair_at(0.0_wp, yaw(i))
         pair%track%cant = 0.0_wp
         pair%track%raily0 = 750.0_wp
         pair%search%ds = 0.1_wp
         call place_wheel_rail(pair, cone%curve, 0.0_wp, 0.0_wp, 0.0_wp, [0.0_wp, 0.0_wp], bodies%placement)
         bodies%wheel = cone%curve
         call place_bodies(bodies, 0.0_wp, 0.0_wp, 0.2_wp, rail%surface, cone%surface)
         do j = 1, 2
            call measure_variable_gap(bodies, pair%search%ds, j == 2, gap)
            call find_regions(gap, smallest_gap(gap) + 0.002_wp, pair%search, 2, regions, misses)
            call suite%equal(size(regions), 1, "one patch on the moving head")
            if (size(regions) /= 1) cycle
            call suite%check(regions(1)%x < -1.0_wp, "it is not below the axle")
            call suite%close_to(regions(1)%alpha, wheel_angle(bodies, regions(1)), 5.0e-4_wp, "one tangent on the moving head")
         end do
      end do
   end subroutine moving_head

   subroutine crossing(suite, folder, name, scale, s_ws, y_ws, z_ws, expected)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: folder, name
      real(wp), intent(in) :: scale, s_ws, y_ws, z_ws
      !> Reference x, y, z [mm] and angle [rad]
      real(wp), intent(in) :: expected(4)
      type(prepared_profile) :: nose, round
      type(wheel_rail_spec) :: pair
      type(wheel_rail_bodies) :: bodies
      type(gap_curve) :: gap
      type(contact_region), allocatable :: regions(:), misses(:)
      type(frame) :: track
      real(wp) :: z, start, end
      logical :: found

      ready = .true.
      call load(suite, folder // name, profile_side%rail, nose, scale, mirror_z=-1)
      call load(suite, folder // "MBench_S1002_v3.prw", profile_side%wheel, round)
      if (.not. ready) return
      pair = pair_at(y_ws, 0.0_wp)
      pair%track%cant = 0.0_wp
      pair%track%raily0 = 750.0_wp
      pair%search%ds = 0.2_wp
      pair%search%dx = 0.2_wp
      call cpu_time(start)
      call place_wheel_rail(pair, round%curve, 0.0_wp, 0.0_wp, z_ws, [0.0_wp, 0.0_wp], bodies%placement)
      bodies%wheel = round%curve
      call place_bodies(bodies, s_ws, 0.0_wp, pair%search%dx, nose%surface, round%surface)
      call cpu_time(end)
      print "(2a, f8.3, a)", name, ": sections in", end - start, " s"
      call measure_variable_gap(bodies, pair%search%ds, .true., gap)
      call cpu_time(start)
      print "(2a, f8.3, a)", name, ": gap in", start - end, " s"
      call find_regions(gap, 0.0_wp, pair%search, 2, regions, misses)
      call suite%check(size(regions) > 0, name // ": contact is found")
      if (size(regions) == 0) return
      z = 0.0_wp
      call find_rail(bodies, track, regions(1)%x, regions(1)%y, z, found)
      print "(a, i0, a, 4f12.4, a, 4f12.4)", "  patches ", size(regions), ", first", regions(1)%x, regions(1)%y, z, &
         & regions(1)%alpha, ", published", expected
      call suite%close_to([regions(1)%x, regions(1)%y, z], expected(:3), 1.0e-3_wp, name // ": position of the contact reference")
      ! where wheel and rail touch they have the same tangent; the published angles of the second and the fourth of these
      ! rails are those of another section (doc/validation/wheel_rail.md)
      call suite%close_to(regions(1)%alpha, wheel_angle(bodies, regions(1)), 2.0e-3_wp, name // ": contact angle")
   end subroutine crossing

   real(wp) function smallest_by_hand(pitch) result(gap)
      real(wp), intent(in) :: pitch
      real(wp) :: theta
      integer :: i

      gap = huge(gap)
      do i = -150000, 150000
         theta = 1.0e-6_wp*i
         gap = min(gap, 460.0_wp - (460.0_wp - 0.4_wp*exp(-(theta/0.05_wp)**2))*cos(theta + pitch))
      end do
   end function smallest_by_hand
end program test_variable
