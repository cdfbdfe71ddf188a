!> Variable profiles: slices files, surfaces through slices, and the store of profiles
program test_surface
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : long, wp
   use contact_base_log, only : log_type
   use contact_profile_request, only : profile_request, profile_side
   use contact_profile_store, only : load_profile, prepared_profile, profile_store
   use contact_profile_surface, only : surface_cut
   use contact_test_files, only : write_file
   use contact_test_harness, only : reference_folder, test_suite
   implicit none (type, external)
   character(len=*), parameter :: nl = new_line("a")
   type(test_suite) :: suite

   call suite%start("surface")
   call prism(suite)
   call swing(suite)
   call along(suite)
   call order(suite)
   call approximating(suite)
   call interrupted(suite)
   call wheel(suite)
   call corner(suite)
   call refusals(suite)
   call store(suite)
   call reference_files(suite)
   call suite%finish()

contains

   !> Height of the test rail at a lateral position: a parabola with radius 100 mm on top
   elemental real(wp) function crown(y)
      real(wp), intent(in) :: y

      crown = 0.005_wp*y**2
   end function crown

   function number(value) result(text)
      real(wp), intent(in) :: value
      character(len=:), allocatable :: text
      character(len=26) :: buffer

      write(buffer, "(es24.16)") value
      text = trim(adjustl(buffer))
   end function number

   !> Write the crown, moved by some distance, over -20...20 mm as a table
   subroutine write_slice(name, dy, dz, first)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: dy, dz
      !> Where it begins; default -20
      real(wp), intent(in), optional :: first
      character(len=:), allocatable :: text
      real(wp) :: y, start
      integer :: i

      start = -20.0_wp
      if (present(first)) start = first
      text = ""
      do i = 0, 160
         y = start + (20.0_wp - start)*i/160.0_wp
         text = text // number(y + dy) // " " // number(crown(y) + dz) // nl
      end do
      call write_file(name, text)
   end subroutine write_slice

   !> A slices file for the files slice1.txt ... with equidistant positions; followed by texts of features
   function slices_text(n, step, head, features) result(text)
      integer, intent(in) :: n
      real(wp), intent(in) :: step
      !> NFEAT NKINK NACCEL, and U_INTPOL
      character(len=*), intent(in) :: head
      character(len=*), intent(in) :: features
      character(len=:), allocatable :: text
      character(len=3) :: k
      integer :: i

      text = "% test" // nl // "0.0 1.0 U_OFFSET U_SCALE" // nl
      write(k, "(i0)") n
      text = text // trim(k) // " NSLC" // nl // head // nl
      do i = 1, n
         write(k, "(i0)") i
         text = text // number(step*(i - 1)) // " 'slice" // trim(k) // ".txt'" // nl
      end do
      text = text // features
   end function slices_text

   subroutine load(suite, profile, what, side)
      type(test_suite), intent(inout) :: suite
      type(prepared_profile), intent(out) :: profile
      character(len=*), intent(in) :: what
      integer, intent(in), optional :: side
      type(profile_request) :: request
      type(error_type), allocatable :: error
      type(log_type) :: log

      request%file = "test.slcs"
      if (present(side)) request%side = side
      request%mirror_z = -1
      call load_profile(request, profile, log, error)
      if (allocated(error)) call suite%check(.false., what // ": " // full_text(error))
      if (.not. allocated(error)) call suite%check(allocated(profile%surface), what // " is a surface")
   end subroutine load

   !> Abrupt changes of the outline make the surface overshoot between slices, with a warning; not with a feature or a slow change
   subroutine swing(suite)
      type(test_suite), intent(inout) :: suite
      type(log_type) :: log
      character(len=:), allocatable :: name, text
      integer :: i, k

      do i = 1, 10
         name = "slice" // achar(iachar("0") + mod(i, 10)) // ".txt"
         ! a flat top, from the sixth slice on with a side that goes down by 40 mm
         text = ""
         if (i > 5) text = "-20.0 40.0" // nl // "-19.7 30.0" // nl // "-19.4 20.0" // nl // "-19.1 10.0" // nl
         do k = merge(-18, -20, i > 5), 20
            text = text // number(real(k, wp)) // " 0.0" // nl
         end do
         call write_file(name, text)
      end do
      call write_file("test.slcs", replaced_last(slices_text(10, 10.0_wp, "0 0 0" // nl // "1", "")))
      call load_slices(suite, log)
      call suite%equal(log%warnings, 1, "a surface that swings between its slices")
      call write_file("test.slcs", replaced_last(slices_text(10, 10.0_wp, "0 0 0" // nl // "2", "")))
      call load_slices(suite, log)
      call suite%equal(log%warnings, 1, "and one through control points")
      do i = 1, 10
         call write_slice("slice" // achar(iachar("0") + mod(i, 10)) // ".txt", 0.0_wp, 0.5_wp*i, -20.0_wp + 0.2_wp*i)
      end do
      call write_file("test.slcs", replaced_last(slices_text(10, 10.0_wp, "0 0 0" // nl // "1", "")))
      call load_slices(suite, log)
      call suite%equal(log%warnings, 0, "outlines that change slowly")

   end subroutine swing

   !> The tenth slice is called slice0
   function replaced_last(text) result(other)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: other
      integer :: k

      k = index(text, "slice10")
      other = text(:k + 4) // text(k + 6:)
   end function replaced_last

   subroutine load_slices(suite, log)
      type(test_suite), intent(inout) :: suite
      type(log_type), intent(out) :: log
      type(profile_request) :: request
      type(prepared_profile) :: profile
      type(error_type), allocatable :: error

      request%file = "test.slcs"
      request%mirror_z = -1
      call load_profile(request, profile, log, error)
      if (allocated(error)) call suite%check(.false., "slices that swing: " // full_text(error))
   end subroutine load_slices

   !> The same slice everywhere is the prismatic profile
   subroutine prism(suite)
      type(test_suite), intent(inout) :: suite
      type(prepared_profile) :: profile
      type(surface_cut) :: section
      real(wp), parameter :: y(5) = [-19.0_wp, -7.3_wp, 0.1_wp, 5.0_wp, 18.8_wp]
      character(len=1) :: k
      integer :: i

      do i = 1, 6
         write(k, "(i0)") i
         call write_slice("slice" // k // ".txt", 0.0_wp, 0.0_wp)
      end do
      call write_file("test.slcs", slices_text(6, 10.0_wp, "0 0 0" // nl // "1", ""))
      call load(suite, profile, "prism")
      if (.not. allocated(profile%surface)) return
      call suite%close_to(profile%surface%u_range, [0.0_wp, 50.0_wp], 0.0_wp, "its range")
      do i = 0, 10
         call profile%surface%cut(5.0_wp*i, section)
         call suite%check(section%present, "there is a section")
         ! Natural ends make 2e-3/mm of curvature zero: 1e-4 mm within the last intervals
         call suite%close_to(section%curve%height(y), crown(y), 1.0e-4_wp, "the section is the slice")
         call suite%close_to(section%curve%height(y(2:4)), crown(y(2:4)), 1.0e-7_wp, "away from its ends as well as it gets")
         call suite%close_to(section%slope_along(y), 0.0_wp*y, 1.0e-12_wp, "no slope along the rail")
      end do
      call profile%surface%cut(-0.1_wp, section)
      call suite%check(.not. section%present, "nothing before the first slice")
      call profile%surface%cut(50.1_wp, section)
      call suite%check(.not. section%present, "nothing after the last one")
      call profile%surface%cut(50.0_wp + 1.0e-9_wp, section)
      call suite%check(section%present, "round-off at the end is accepted")
      call write_file("test.slcs", slices_text(6, 10.0_wp, "0  NFEAT" // nl // "1", ""))
      call load(suite, profile, "one number where three are possible")
   end subroutine prism

   !> Slices that move sideways and down as cubics of u: reproduced, with their slope
   subroutine along(suite)
      type(test_suite), intent(inout) :: suite
      type(prepared_profile) :: profile
      type(surface_cut) :: section
      real(wp), parameter :: y(5) = [-9.0_wp, -7.3_wp, 0.1_wp, 5.0_wp, 12.8_wp]
      real(wp) :: u, dy, dz, dy_u, dz_u
      character(len=1) :: k
      integer :: i

      do i = 1, 7
         write(k, "(i0)") i
         u = 10.0_wp*(i - 1)
         call write_slice("slice" // k // ".txt", 0.1_wp*u, 1.0e-5_wp*u**3 - 0.02_wp*u)
      end do
      call write_file("test.slcs", slices_text(7, 10.0_wp, "0 0 0" // nl // "1", ""))
      call load(suite, profile, "cubic")
      if (.not. allocated(profile%surface)) return
      do i = 0, 12
         u = 5.0_wp*i
         dy = 0.1_wp*u
         dz = 1.0e-5_wp*u**3 - 0.02_wp*u
         dy_u = 0.1_wp
         dz_u = 3.0e-5_wp*u**2 - 0.02_wp
         call profile%surface%cut(u, section)
         call suite%close_to(section%curve%height(y + dy), crown(y) + dz, 1.0e-7_wp, "cubic along the rail")
         call suite%close_to(section%slope_along(y + dy), dz_u - 0.01_wp*y*dy_u, 1.0e-6_wp, "its slope at fixed y")
         call check_changes(suite, section, y + dy)
      end do
   end subroutine along

   !> How slopes change across a section: by differences of these
   subroutine check_changes(suite, section, y)
      type(test_suite), intent(inout) :: suite
      type(surface_cut), intent(in) :: section
      !> Places within one piece [mm]
      real(wp), intent(in) :: y(:)
      real(wp), parameter :: h = 1.0e-4_wp
      real(wp) :: z, z_y(-1:1), z_u(-1:1), z_yy, z_uy
      logical :: found
      integer :: i, k, piece

      piece = 0
      do i = 1, size(y)
         do k = -1, 1
            call section%at(y(i) + k*h, z, z_y(k), z_u(k), found, piece)
         end do
         call section%at(y(i), z, z_y(0), z_u(0), found, piece, z_yy, z_uy)
         call suite%close_to(z_yy, (z_y(1) - z_y(-1))/(2.0_wp*h), 1.0e-6_wp, "how the slope across changes across")
         call suite%close_to(z_uy, (z_u(1) - z_u(-1))/(2.0_wp*h), 1.0e-6_wp, "how the slope along changes across")
      end do
   end subroutine check_changes

   !> Order 4 along the rail for a wave
   subroutine order(suite)
      type(test_suite), intent(inout) :: suite
      type(prepared_profile) :: profile
      type(surface_cut) :: section
      real(wp) :: errors(2), u
      character(len=3) :: k
      integer :: i, level, n

      do level = 1, 2
         n = 10*2**level + 1
         do i = 1, n
            write(k, "(i0)") i
            u = 100.0_wp*(i - 1)/(n - 1)
            call write_slice("slice" // trim(k) // ".txt", 0.0_wp, 0.1_wp*sin(u/15.0_wp))
         end do
         call write_file("test.slcs", slices_text(n, 100.0_wp/(n - 1), "0 0 0" // nl // "1", ""))
         call load(suite, profile, "wave")
         if (.not. allocated(profile%surface)) return
         errors(level) = 0.0_wp
         do i = 0, 200
            call profile%surface%cut(0.5_wp*i, section)
            errors(level) = max(errors(level), abs(section%curve%height(0.0_wp) - 0.1_wp*sin(0.5_wp*i/15.0_wp)))
         end do
      end do
      call suite%check(log(errors(1)/errors(2))/log(2.0_wp) > 3.7_wp, "order 4 along the rail")
   end subroutine order

   !> Approximation keeps straight lines, and gives a single high slice four sixths of its height
   subroutine approximating(suite)
      type(test_suite), intent(inout) :: suite
      type(prepared_profile) :: profile
      type(surface_cut) :: section
      real(wp), parameter :: hump(3:5) = [0.0_wp, -0.1_wp, -0.4_wp]
      character(len=1) :: k
      integer :: i

      do i = 1, 9
         write(k, "(i0)") i
         call write_slice("slice" // k // ".txt", 0.0_wp, 0.5_wp*i)
      end do
      call write_file("test.slcs", slices_text(9, 10.0_wp, "0 0 0" // nl // "2", ""))
      call load(suite, profile, "straight")
      if (.not. allocated(profile%surface)) return
      do i = 0, 16
         call profile%surface%cut(5.0_wp*i, section)
         call suite%close_to(section%curve%height(0.0_wp), 0.5_wp + 0.25_wp*i, 1.0e-9_wp, "a straight slope is preserved")
      end do
      do i = 1, 9
         write(k, "(i0)") i
         call write_slice("slice" // k // ".txt", 0.0_wp, merge(-0.6_wp, 0.0_wp, i == 5))
      end do
      call load(suite, profile, "hump")
      do i = 3, 5
         call profile%surface%cut(10.0_wp*(i - 1), section)
         call suite%close_to(section%curve%height(0.0_wp), hump(i), 1.0e-9_wp, "hump")
      end do
   end subroutine approximating

   !> Two parts, the left one only in the second half of the slices
   subroutine interrupted(suite)
      type(test_suite), intent(inout) :: suite
      type(prepared_profile) :: profile
      type(surface_cut) :: section
      character(len=:), allocatable :: features
      character(len=2) :: k
      real(wp) :: range(2)
      integer :: i

      features = ""
      do i = 1, 10
         write(k, "(i0)") i
         if (i <= 5) then
            call write_slice("slice" // trim(k) // ".txt", 0.0_wp, 0.0_wp, first=0.0_wp)
            features = features // number(10.0_wp*(i - 1)) // " -1 0. 999." // nl
         else
            call write_slice("slice" // trim(k) // ".txt", 0.0_wp, 0.0_wp)
            ! The length of the left half of the crown is 20.13 mm
            features = features // number(10.0_wp*(i - 1)) // " 0. 20.1324 999." // nl
         end if
      end do
      call write_file("test.slcs", slices_text(10, 10.0_wp, "3 0 0" // nl // "1", features))
      call load(suite, profile, "interrupted")
      if (.not. allocated(profile%surface)) return
      do i = 0, 18
         call profile%surface%cut(5.0_wp*i, section)
         range = section%curve%y_range()
         call suite%close_to(range, [merge(0.0_wp, -20.0_wp, i < 10), 20.0_wp], 1.0e-3_wp, "the existing part of the profile")
         call suite%close_to(section%curve%height(10.0_wp), crown(10.0_wp), 1.0e-5_wp, "the right part goes through")
      end do
      call write_file("test.slcs", slices_text(10, 10.0_wp, "3 1 0" // nl // "1", "1" // nl // features))
      call load(suite, profile, "with a kink")
   end subroutine interrupted

   !> Slices of a wheel with a corner: the section is straight from the second line beside it, where a spline oscillates
   subroutine corner(suite)
      type(test_suite), intent(inout) :: suite
      type(prepared_profile) :: profile
      type(surface_cut) :: section
      character(len=:), allocatable :: text
      character(len=1) :: k
      integer :: i, j

      text = ""
      do j = -400, 400
         text = text // number(-0.05_wp*j) // " " // number(0.005_wp*abs(j)) // nl
      end do
      do i = 1, 5
         write(k, "(i0)") i
         call write_file("slice" // k // ".txt", text)
      end do
      call write_file("test.slcs", slices_text(5, 0.1_wp, "0 0 0" // nl // "2", ""))
      call load(suite, profile, "wheel with a corner", profile_side%wheel)
      if (.not. allocated(profile%surface)) return
      call profile%surface%cut(0.17_wp, section)
      do j = -8, 8
         if (abs(j) < 4) cycle
         call suite%close_to(section%curve%height(0.4_wp*j), 0.04_wp*abs(j), 1.0e-5_wp, "straight beside the corner")
      end do
      call some_lines(suite, profile, 0.17_wp)
   end subroutine corner

   !> Angles modulo one turn; a wheel with slices on a part only is round elsewhere
   subroutine wheel(suite)
      type(test_suite), intent(inout) :: suite
      type(prepared_profile) :: profile
      type(surface_cut) :: section
      character(len=:), allocatable :: text
      character(len=1) :: k
      integer :: i, j

      do i = 1, 5
         write(k, "(i0)") i
         text = ""
         do j = -100, 100
            text = text // number(-0.2_wp*j) // " " // number(0.01_wp*j + 0.1_wp*merge(1, 0, i == 3)) // nl
         end do
         call write_file("slice" // k // ".txt", text)
      end do
      text = slices_text(5, 0.1_wp, "0 0 0" // nl // "1", "")
      text = text(:index(text, "0.0 1.0") - 1) // "-0.2" // text(index(text, "0.0 1.0") + 3:)
      call write_file("test.slcs", text)
      call load(suite, profile, "wheel", profile_side%wheel)
      if (.not. allocated(profile%surface)) return
      do i = -1, 1
         call profile%surface%cut(2.0_wp*pi*i, section)
         call suite%close_to(section%curve%height(0.0_wp), 0.1_wp, 1.0e-9_wp, "a hump after any number of turns")
         call profile%surface%cut(0.3_wp + 2.0_wp*pi*i, section)
         call suite%close_to(section%curve%height(0.0_wp), 0.0_wp, 1.0e-9_wp, "round elsewhere")
      end do
      call some_lines(suite, profile, 0.05_wp)
   end subroutine wheel

   !> A section through some of the lines equals the one through all lines where it is valid
   subroutine some_lines(suite, profile, position)
      type(test_suite), intent(inout) :: suite
      !> A wheel with a surface
      type(prepared_profile), intent(in) :: profile
      !> Angle of the section [rad]
      real(wp), intent(in) :: position
      type(surface_cut) :: whole, part
      real(wp) :: range(2), y, all_lines(5), some(5), worst, shortest
      logical :: found(2)
      integer :: first, n, i, piece(2)

      call profile%surface%cut(position, whole)
      n = profile%surface%lines
      worst = 0.0_wp
      shortest = huge(1.0_wp)
      piece = 0
      do first = 1, n, 5
         call profile%surface%cut(position, part, lines=[first, first + n/3])
         call suite%check(part%present, "a section through some lines")
         range = whole%curve%y_range()
         range = [max(range(1), part%valid(1)), min(range(2), part%valid(2))]
         shortest = min(shortest, range(2) - range(1))
         do i = 0, 50
            y = range(1) + (range(2) - range(1))*i/50.0_wp
            call whole%at(y, all_lines(1), all_lines(2), all_lines(3), found(1), piece(1), all_lines(4), all_lines(5))
            call part%at(y, some(1), some(2), some(3), found(2), piece(2), some(4), some(5))
            call suite%check(all(found), "both have a point there")
            worst = max(worst, maxval(abs(all_lines - some)))
         end do
      end do
      call suite%close_to(worst, 0.0_wp, 1.0e-11_wp, "points of a section through some lines")
      range = whole%curve%y_range()
      call suite%check(shortest > 0.0_wp .and. shortest < 0.5_wp*(range(2) - range(1)), "some sections are limited")
   end subroutine some_lines

   subroutine refused(suite, text, words, line, what, side)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: text, words, what
      integer, intent(in) :: line
      integer, intent(in), optional :: side
      type(profile_request) :: request
      type(prepared_profile) :: profile
      type(error_type), allocatable :: error
      type(log_type) :: log

      call write_file("test.slcs", text)
      request%file = "test.slcs"
      if (present(side)) request%side = side
      call load_profile(request, profile, log, error)
      call suite%check(allocated(error), what // " is refused")
      if (.not. allocated(error)) return
      call suite%check(index(error%message, words) > 0, what // ': "' // error%message // '" holds "' // words // '"')
      call suite%equal(error%line, line, what // ": line of the error")
   end subroutine refused

   subroutine refusals(suite)
      type(test_suite), intent(inout) :: suite
      character(len=*), parameter :: plain = "0 0 0" // nl // "1"
      character(len=:), allocatable :: text
      character(len=1) :: k
      integer :: i

      do i = 1, 6
         write(k, "(i0)") i
         call write_slice("slice" // k // ".txt", 0.0_wp, 0.0_wp)
      end do
      call refused(suite, "", "U_OFFSET", 1, "an empty slices file")
      call refused(suite, slices_text(3, 10.0_wp, plain, ""), "at least 4", 0, "three slices")
      call refused(suite, slices_text(6, 0.0005_wp, plain, ""), "must increase", 7, "slices too close")
      call refused(suite, slices_text(6, -1.0_wp, plain, ""), "must increase", 7, "slices in falling order")
      call refused(suite, slices_text(6, 1.0_wp, "0 0 0" // nl // "3", ""), "accepted are 1 to 2", 5, "an unknown interpolation")
      call refused(suite, slices_text(6, 1.0_wp, "3 0 1" // nl // "1", ""), "accepted is 0", 4, "accelerations")
      call refused(suite, slices_text(6, 1.0_wp, "3 2 0" // nl // "1", ""), "accepted are 0 to 1", 4, "too many kinks")
      call refused(suite, slices_text(6, 1.0_wp, "2 0 0" // nl // "1", ""), "end of the file", 12, "no features")
      call refused(suite, slices_text(6, 1.0_wp, "2 0 0" // nl // "1", "0 5 2"), "do not increase", 12, "decreasing features")
      call refused(suite, slices_text(6, 1.0_wp, "3 0 0" // nl // "1", "0 5 -1 9"), "between others", 12, "a missing feature")
      call refused(suite, slices_text(6, 1.0_wp, "2 0 0" // nl // "1", "0 5 -1"), "fewer than two", 12, "one feature")
      call refused(suite, slices_text(6, 1.0_wp, "2 0 0" // nl // "1", "1 0 9"), "position 1", 12, "features of another slice")
      text = ""
      do i = 1, 6
         write(k, "(i0)") i - 1
         text = text // k // merge("  0. 20. 99. ", " -1  20. 99. ", i < 3) // nl
      end do
      call refused(suite, slices_text(6, 1.0_wp, "3 0 0" // nl // "1", text), "consecutive slices", 6, "a part in two slices")
      call refused(suite, slices_text(60, 1.0_wp, plain, ""), "cannot be opened", 0, "a slice that is not there")
      call refused(suite, slices_text(6, 1.0_wp, plain, ""), "1.5 pi", 0, "angles in degrees", profile_side%wheel)
      call refused(suite, slices_text(6, 0.9_wp, plain, ""), "range inside", 0, "angles beyond one end", profile_side%wheel)
   end subroutine refusals

   !> Wait until a change of a file has another time than the last one
   subroutine let_clocks_tick()
      integer(long) :: start, now, rate

      call system_clock(start, rate)
      now = start
      do while (now - start < rate/4)
         call system_clock(now)
      end do
   end subroutine let_clocks_tick

   !> Each request is prepared once; a changed file again; the oldest goes when there are too many
   subroutine store(suite)
      type(test_suite), intent(inout) :: suite
      type(profile_store) :: profiles
      type(profile_request) :: request
      type(prepared_profile), pointer :: one, two
      type(error_type), allocatable :: error
      type(log_type) :: log
      integer :: known

      call write_slice("slice1.txt", 0.0_wp, 0.0_wp)
      call write_slice("slice2.txt", 0.0_wp, 0.0_wp)
      request%file = "slice1.txt"
      profiles%max_profiles = 2
      call profiles%get(request, one, log, error)
      call profiles%get(request, two, log, error)
      call suite%check(associated(one, two), "the same profile")
      call suite%equal(profiles%loads, 1, "prepared once")
      request%smooth = 1.0_wp
      call profiles%get(request, two, log, error)
      call suite%check(.not. associated(one, two), "other options, another profile")
      request%smooth = 0.0_wp
      call profiles%get(request, two, log, error)
      call suite%check(associated(one, two), "both are kept")
      call write_slice("slice1.txt", 0.0_wp, 1.0_wp)
      call profiles%get(request, one, log, error)
      call suite%close_to(one%curve%height(0.0_wp), 1.0_wp, 1.0e-9_wp, "a changed file is read again")
      call suite%equal(profiles%loads, 3, "three times read so far")
      call let_clocks_tick()
      call profiles%get(request, one, log, error)
      known = profiles%comparisons
      call profiles%get(request, one, log, error)
      call suite%equal(profiles%comparisons, known, "an unchanged file is not read for comparison")
      call write_slice("slice1.txt", 0.0_wp, 2.0_wp)
      call profiles%get(request, one, log, error)
      call suite%close_to(one%curve%height(0.0_wp), 2.0_wp, 1.0e-9_wp, "a file that was changed later, of the same length")
      call write_slice("slice1.txt", 0.0_wp, 3.0_wp)
      call profiles%get(request, one, log, error)
      call suite%close_to(one%curve%height(0.0_wp), 3.0_wp, 1.0e-9_wp, "and again at once")
      call suite%equal(profiles%loads, 5, "five times read so far")
      request%file = "slice2.txt"
      call profiles%get(request, two, log, error)
      request%file = "slice1.txt"
      call profiles%get(request, one, log, error)
      call suite%equal(profiles%loads, 6, "the one not used for long made room")
      request%file = "is/not/there.txt"
      call profiles%get(request, one, log, error)
      call suite%check(allocated(error) .and. .not. associated(one), "a missing file")
      call write_file("bad.txt", "1 x")
      request%file = "bad.txt"
      call profiles%get(request, one, log, error)
      call suite%check(allocated(error) .and. .not. associated(one), "a file that cannot be used")

      ! Slices: a change in one of them is seen
      call write_slice("slice3.txt", 0.0_wp, 0.0_wp)
      call write_slice("slice4.txt", 0.0_wp, 0.0_wp)
      call write_file("test.slcs", slices_text(4, 10.0_wp, "0 0 0" // nl // "1", ""))
      request%file = "test.slcs"
      call profiles%get(request, one, log, error)
      call profiles%get(request, one, log, error)
      call suite%equal(profiles%loads, 8, "slices are prepared once")
      call write_slice("slice3.txt", 0.0_wp, 0.1_wp)
      call profiles%get(request, one, log, error)
      call suite%equal(profiles%loads, 9, "again when one slice has changed")
      call profiles%release()
   end subroutine store

   subroutine reference_files(suite)
      type(test_suite), intent(inout) :: suite
      type(prepared_profile) :: profile
      type(profile_request) :: request
      type(error_type), allocatable :: error
      type(log_type) :: log
      type(surface_cut) :: section
      character(len=:), allocatable :: folder
      character(len=*), parameter :: names(6) = [character(len=40) :: "testbank/profiles/cross_nose.slcs", &
         & "testbank/profiles/wing_rail.slcs", "testbank/profiles/uk_crossing.slcs", "testbank/profiles/uk_interrupt_v2.slcs", &
         & "testbank/profiles/flat_d09.slcw", "examples/S1002_flat.slcw"]
      integer :: i

      folder = reference_folder()
      if (folder == "") then
         call suite%skip("published slices files", "CONTACT_REFERENCE is not there")
         return
      end if
      do i = 1, size(names)
         request%file = folder // "/" // trim(names(i))
         request%mirror_z = -1
         request%scale = merge(1000.0_wp, 1.0_wp, index(names(i), "uk_") > 0)
         request%side = merge(profile_side%wheel, profile_side%rail, i > 4)
         call load_profile(request, profile, log, error)
         if (allocated(error)) then
            call suite%check(.false., full_text(error))
            cycle
         end if
         call profile%surface%cut(0.5_wp*sum(profile%surface%u_range), section)
         call suite%check(section%present, trim(names(i)) // " has a surface in its middle")
         ! The artificial nose has a slope of 1:10, with the top at -u/10
         if (i /= 1) cycle
         call profile%surface%cut(37.0_wp, section)
         call suite%close_to(section%curve%height(10.0_wp), -3.7_wp, 1.0e-5_wp, "height of the nose")
         call suite%close_to(section%slope_along(10.0_wp), -0.1_wp, 1.0e-6_wp, "slope of the nose")
      end do
   end subroutine reference_files
end program test_surface
