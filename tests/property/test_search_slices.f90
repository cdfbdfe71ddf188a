!> The search on variable profiles finds every contact of its mesh: compared with the gap at every point of that mesh
!>
!> Rails with ridges narrower than the coarse mesh, at random positions and for some slices only; wheels with and without a
!> flange, round and with a wave; roll and yaw.
program test_search_slices
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_profile_request, only : profile_request, profile_side
   use contact_profile_store, only : load_profile, prepared_profile
   use contact_test_case_builder, only : random_numbers
   use contact_test_files, only : write_file
   use contact_test_harness, only : environment, test_suite
   use contact_wheelrail_bodies, only : find_rail, find_wheel, wheel_rail_bodies, place_bodies, search_reach
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_gap, only : gap_curve, no_surface, rail_in_track
   use contact_wheelrail_gap_bound, only : bound_gap
   use contact_wheelrail_placement, only : place_wheel_rail
   use contact_wheelrail_spec, only : wheel_rail_spec
   use contact_wheelrail_variable, only : measure_variable_gap
   implicit none (type, external)
   character(len=*), parameter :: nl = new_line("a")
   type(test_suite) :: suite
   type(random_numbers) :: random
   integer :: scene

   call suite%start("search_slices")
   random%state = 7
   do scene = 1, 8
      call compare(suite, scene)
   end do
   call suite%finish()

contains

   !> One pair: the search and all points of its mesh
   subroutine compare(suite, scene)
      type(test_suite), intent(inout) :: suite
      integer, intent(in) :: scene
      type(prepared_profile) :: rail, wheel
      type(wheel_rail_spec) :: pair
      type(wheel_rail_bodies) :: bodies
      type(gap_curve) :: gap
      type(frame) :: track, seen
      real(wp), allocatable :: lowest(:), low(:, :)
      real(wp) :: x, z, place, n, here, least, over, under
      character(len=10) :: name
      logical :: found
      integer :: i, j, k, cells
      real(wp), parameter :: cell = 4.0_wp

      write(name, "(a, i0)") "scene ", scene
      call write_rail(with_waves=mod(scene, 2) == 0)
      call load(suite, "ridges.slcs", profile_side%rail, rail)
      select case (mod(scene, 4))
      case (0)
         call load(suite, environment("CONTACT_SOURCE") // "/examples/profiles/S1002.prw", profile_side%wheel, wheel)
      case (1)
         call write_wheel()
         call load(suite, "wavy.slcw", profile_side%wheel, wheel)
      case default
         call write_file("cylinder.txt", table(0.0_wp, wheel=.true.))
         call load(suite, "cylinder.txt", profile_side%wheel, wheel)
      end select
      pair%track%gaught = -1.0_wp
      pair%track%raily0 = 750.0_wp
      pair%wheelset%y = random%uniform(-3.0_wp, 3.0_wp)
      pair%wheelset%yaw = random%uniform(-0.02_wp, 0.02_wp)
      pair%wheelset%roll = random%uniform(-0.005_wp, 0.005_wp)
      pair%search%dx = 1.0_wp
      pair%search%ds = 1.0_wp
      call place_wheel_rail(pair, wheel%curve, 0.0_wp, 0.0_wp, 0.0_wp, [0.0_wp, 0.0_wp], bodies%placement)
      bodies%rail = rail_in_track(rail%curve, bodies%placement)
      bodies%wheel = wheel%curve
      call place_bodies(bodies, 0.0_wp, 0.0_wp, pair%search%dx, rail%surface, wheel%surface)
      call measure_variable_gap(bodies, pair%search%ds, mod(scene, 3) == 0, gap)

      ! the gap at all points of the mesh, and the bound of each cell
      allocate(lowest(gap%n), source=no_surface)
      cells = floor(search_reach(bodies)/cell)
      allocate(low(2*cells, gap%n))
      call bound_gap(bodies, bodies%placement%wheel%origin(1) + [(cell*i, i=-cells, cells)], gap%y, huge(1.0_wp), low)
      over = -huge(over)
      under = -huge(under)
      seen = bodies%placement%wheel%seen_from_here(track)
      do j = 1, gap%n
         do i = 1, 2*cells
            least = no_surface
            do k = 0, 4
               x = bodies%placement%wheel%origin(1) + cell*(i - cells - 1) + k
               z = 0.0_wp
               call find_rail(bodies, track, x, gap%y(j), z, found)
               if (.not. found) cycle
               n = 0.0_wp
               place = bodies%wheel%s_at(gap%y(j) - bodies%placement%wheel%origin(2))
               call find_wheel(bodies, seen, x, gap%y(j), place, n, found)
               if (found) least = min(least, z - n)
            end do
            if (least < no_surface) under = max(under, low(i, j) - least)
            lowest(j) = min(lowest(j), least)
         end do
      end do
      call suite%close_to(max(under, 0.0_wp), 0.0_wp, 0.0_wp, trim(name) // ": bounds are below the gaps")
      here = minval(lowest)
      do j = 1, gap%n
         if (lowest(j) < here + gap%depth) over = max(over, gap%gap(j) - lowest(j))
      end do
      call suite%close_to(max(over, 0.0_wp), 0.0_wp, 1.0e-6_wp, trim(name) // ": no gap is smaller than that of the search")
      call suite%close_to(minval(gap%gap), here, 0.02_wp, trim(name) // ": the smallest gap")
   end subroutine compare

   !> Seven slices of a rail 80 mm wide, with ridges in three of them one after the other
   subroutine write_rail(with_waves)
      !> Does the height of the rail vary along the track as well?
      logical, intent(in) :: with_waves
      character(len=:), allocatable :: text
      real(wp) :: ridge(3, 4), height
      integer :: i, k, first(4)
      character(len=1) :: digit

      do k = 1, 4
         ridge(:, k) = [random%uniform(-30.0_wp, 30.0_wp), random%uniform(0.5_wp, 0.9_wp), random%uniform(0.3_wp, 1.0_wp)]
         first(k) = random%whole(1, 6)
      end do
      text = "0 1" // nl // "8" // nl // "0 0 0" // nl // "1" // nl
      do i = 1, 8
         write(digit, "(i0)") i
         height = 0.0_wp
         if (with_waves) height = random%uniform(-0.1_wp, 0.1_wp)
         call write_file("ridges" // digit // ".txt", table(height, ridge=ridge, &
            & there=[(i >= first(k) .and. i <= first(k) + 2, k=1, 4)]))
         text = text // number(18.0_wp*(i - 4.3_wp)) // " 'ridges" // digit // ".txt'" // nl
      end do
      call write_file("ridges.slcs", text)
   end subroutine write_rail

   !> Slices of a wheel whose radius has waves, closer than the coarse mesh
   subroutine write_wheel()
      character(len=:), allocatable :: text
      character(len=2) :: digits
      real(wp) :: phase
      integer :: i

      phase = random%uniform(0.0_wp, 6.0_wp)
      text = "0 1" // nl // "90" // nl // "0 0 0" // nl // "1" // nl
      do i = 1, 90
         write(digits, "(i2.2)") i
         call write_file("wavy" // digits // ".txt", table(0.05_wp*cos(2.3_wp*i + phase), wheel=.true.))
         text = text // number(0.003_wp*(i - 45)) // " 'wavy" // digits // ".txt'" // nl
      end do
      call write_file("wavy.slcw", text)
   end subroutine write_wheel

   !> A level profile with ridges
   function table(z, wheel, ridge, there) result(text)
      !> [mm]
      real(wp), intent(in) :: z
      !> In the order of a wheel?
      logical, intent(in), optional :: wheel
      !> Place, width and height of each ridge [mm], shape (3, ridges)
      real(wp), intent(in), optional :: ridge(:, :)
      logical, intent(in), optional :: there(:)
      character(len=:), allocatable :: text
      real(wp) :: y, height
      integer :: j, k

      text = ""
      do j = -160, 160
         y = 0.25_wp*j
         if (present(wheel)) y = -y
         height = z
         if (present(ridge)) then
            do k = 1, size(ridge, 2)
               if (there(k)) height = height - ridge(3, k)*exp(-((y - ridge(1, k))/ridge(2, k))**2)
            end do
         end if
         text = text // number(y) // " " // number(height) // nl
      end do
   end function table

   function number(value) result(text)
      real(wp), intent(in) :: value
      character(len=24) :: text

      write(text, "(f18.10)") value
   end function number

   subroutine load(suite, file, side, profile)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: file
      integer, intent(in) :: side
      type(prepared_profile), intent(out) :: profile
      type(profile_request) :: request
      type(error_type), allocatable :: error
      type(log_type) :: log

      request%file = file
      request%side = side
      call load_profile(request, profile, log, error)
      if (allocated(error)) call suite%check(.false., full_text(error))
   end subroutine load
end program test_search_slices
