!> Profiles: cleaning, readers with good and hostile files, the curve and its visible part
program test_profile
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_profile_curve, only : profile_curve
   use contact_profile_points, only : chord_lengths, find_kinks, find_loop, needs_mirror_z, needs_reversal, &
      & remove_zig_zags
   use contact_profile_prepare, only : extension_of, length_origin, prepare_points, read_profile
   use contact_profile_request, only : doubt, profile_request, profile_side, smoothing_method
   use contact_test_files, only : write_file
   use contact_test_harness, only : reference_folder, test_suite
   implicit none (type, external)
   character(len=*), parameter :: nl = new_line("a")
   !> A rail in the form of a roof with rounded ridge, as rows of y z
   character(len=*), parameter :: roof = "-20 10" // nl // "-10 3" // nl // "-5 1" // nl // "0 0" // nl // "5 1" // nl // &
      & "10 3" // nl // "20 10" // nl
   character(len=*), parameter :: simpack_head = "! a comment" // nl // " header.begin" // nl // "version = 1" // nl // &
      & "type = 0 ! rail" // nl // "header.end" // nl // "spline.begin" // nl // "comment = 'not ! a comment'" // nl // &
      & "units.len.f = 1000." // nl
   character(len=*), parameter :: simpack_tail = "point.end" // nl // "spline.end" // nl
   type(test_suite) :: suite

   call suite%start("profile")
   call cleaning(suite)
   call directions(suite)
   call tables(suite)
   call simpack(suite)
   call miniprof(suite)
   call outliers(suite)
   call refusals(suite)
   call arc(suite)
   call hidden(suite)
   call doubts(suite)
   call smoothing(suite)
   call reference_files(suite)
   call suite%finish()

contains

   function rail_request(file) result(request)
      character(len=*), intent(in) :: file
      type(profile_request) :: request

      request%file = file
   end function rail_request

   function wheel_request(file) result(request)
      character(len=*), intent(in) :: file
      type(profile_request) :: request

      request%file = file
      request%side = profile_side%wheel
   end function wheel_request

   !> Read a text under a name; claim success
   subroutine read_text(suite, request, text, curve, what, warnings)
      type(test_suite), intent(inout) :: suite
      type(profile_request), intent(in) :: request
      character(len=*), intent(in) :: text, what
      type(profile_curve), intent(out) :: curve
      integer, intent(in), optional :: warnings
      type(error_type), allocatable :: error
      type(log_type) :: log

      call write_file(request%file, text)
      call read_profile(request, curve, log, error)
      if (allocated(error)) then
         call suite%check(.false., what // ": " // full_text(error))
      else if (present(warnings)) then
         call suite%equal(log%warnings, warnings, what // ": number of warnings")
      else
         call suite%equal(log%warnings, 0, what // ": number of warnings")
      end if
   end subroutine read_text

   !> Read a text; claim an error that names the file and holds certain words
   subroutine refused(suite, request, text, words, line, what)
      type(test_suite), intent(inout) :: suite
      type(profile_request), intent(in) :: request
      character(len=*), intent(in) :: text, words, what
      !> Line that the error names, 0 for none
      integer, intent(in) :: line
      type(profile_curve) :: curve
      type(error_type), allocatable :: error
      type(log_type) :: log

      call write_file(request%file, text)
      call read_profile(request, curve, log, error)
      call suite%check(allocated(error), what // " is refused")
      if (.not. allocated(error)) return
      call suite%check(index(error%message, words) > 0, what // ': "' // error%message // '" holds "' // words // '"')
      call suite%equal(error%file, request%file, what // ": file of the error")
      call suite%equal(error%line, line, what // ": line of the error")
   end subroutine refused

   subroutine cleaning(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), allocatable :: y(:), z(:)
      logical, allocatable :: kinks(:)
      integer :: first, second, count, i

      ! Two sections that overlap by half a millimetre
      y = [0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp, 2.5_wp, 3.5_wp, 4.5_wp]
      z = 0.001_wp*y
      call remove_zig_zags(y, z, 150.0_wp*pi/180.0_wp, count)
      call suite%equal(count, 1, "one zig-zag")
      call suite%close_to(y, [0.0_wp, 1.0_wp, 2.0_wp, 2.75_wp, 3.5_wp, 4.5_wp], 1.0e-15_wp, "its points become one")
      call remove_zig_zags(y, z, 150.0_wp*pi/180.0_wp, count)
      call suite%equal(count, 0, "all zig-zags are removed")

      call find_loop([0.0_wp, 10.0_wp, 10.0_wp, 5.0_wp], [0.0_wp, 0.0_wp, 5.0_wp, -5.0_wp], first, second)
      call suite%equal(first, 1, "loop of three segments, first")
      call suite%equal(second, 3, "loop of three segments, second")
      y = [(0.01_wp*i, i=0, 1000)]
      z = sin(y)
      call find_loop(y, z, first, second)
      call suite%equal(first, 0, "no loop in a wave")
      y = [y, 5.005_wp, 5.005_wp]
      z = [z, 8.0_wp, -8.0_wp]
      call find_loop(y, z, first, second)
      call suite%equal(second, 1002, "loop over many points")
      call find_loop([0.0_wp, 10.0_wp, 10.0_wp, 5.0_wp], [0.0_wp, 0.0_wp, 5.0_wp, 0.0_wp], first, second)
      call suite%equal(first, 0, "touching is not crossing")

      y = [(1.0_wp*i, i=-10, 10)]
      z = abs(y)
      kinks = find_kinks(y, z, pi/6.0_wp, pi/30.0_wp, 2.0_wp)
      call suite%equal(findloc(kinks, .true., 1), 11, "a corner of 90 degrees")
      z(12) = z(12) + 0.3_wp
      kinks = find_kinks(y, z, pi/6.0_wp, pi/30.0_wp, 2.0_wp)
      call suite%check(.not. any(kinks), "no corner next to roughness")
      kinks = find_kinks(y, z, pi/6.0_wp, pi/30.0_wp, 0.5_wp)
      call suite%check(kinks(11), "a narrow window does not see it")
      kinks = find_kinks(y, z, pi, pi/30.0_wp, 0.5_wp)
      call suite%check(.not. any(kinks), "search switched off")
      y = 3.0_wp*y
      z = 0.0_wp*y
      z(12:) = 3.0_wp
      kinks = find_kinks(y, z, pi/6.0_wp, pi/30.0_wp, 2.0_wp)
      call suite%check(all(kinks(11:12)), "both ends of a step")

      call suite%close_to(chord_lengths([0.0_wp, 3.0_wp, 3.0_wp], [0.0_wp, 4.0_wp, 5.0_wp]), [0.0_wp, 5.0_wp, 6.0_wp], &
         & 1.0e-15_wp, "sums of chords")
      call suite%close_to(length_origin([0.0_wp, 5.0_wp, 6.0_wp], [-1.0_wp, 3.0_wp, 4.0_wp], [0.0_wp, 0.0_wp, 0.0_wp]), 1.25_wp, &
         & 1.0e-15_wp, "s = 0 at y = 0")
      call suite%close_to(length_origin([0.0_wp, 5.0_wp, 6.0_wp], [4.0_wp, 3.0_wp, -1.0_wp], [0.0_wp, 0.0_wp, 0.0_wp]), 5.75_wp, &
         & 1.0e-15_wp, "the same with decreasing y")
      call suite%close_to(length_origin([0.0_wp, 5.0_wp, 6.0_wp], [4.0_wp, 5.0_wp, 6.0_wp], [0.0_wp, 0.0_wp, 0.0_wp]), 0.0_wp, &
         & 0.0_wp, "y = 0 beyond the first point")
      call suite%close_to(length_origin([0.0_wp, 5.0_wp, 6.0_wp], [4.0_wp, 0.1_wp, 6.0_wp], [0.0_wp, 0.0_wp, 0.0_wp]), 5.0_wp, &
         & 0.0_wp, "nearest point when y turns round")
   end subroutine cleaning

   !> Directions of z and of the list, found from shapes with and without side faces
   subroutine directions(suite)
      type(test_suite), intent(inout) :: suite
      real(wp) :: y(41), z(41)
      integer :: i

      y = [(1.0_wp*i, i=-20, 20)]
      z = 0.02_wp*y**2
      call suite%check(.not. needs_mirror_z(profile_side%rail, y, z), "rail with z down")
      call suite%check(needs_mirror_z(profile_side%rail, y, -z), "rail with z up")
      call suite%check(.not. needs_mirror_z(profile_side%rail, y, 0.0_wp*z + [(merge(5.0_wp, 0.0_wp, i < 3), i=1, 41)]), &
         & "rail with one side")
      call suite%check(.not. needs_reversal(profile_side%rail, y, z), "rail in order")
      call suite%check(needs_reversal(profile_side%rail, -y, z), "rail in reverse order")
      ! Wheel from field side to flange: cone, then the flange
      y = -y
      z = -0.05_wp*y
      where (y < -10.0_wp) z = 20.0_wp - 0.2_wp*(y + 15.0_wp)**2
      call suite%check(.not. needs_mirror_z(profile_side%wheel, y, z), "wheel with z down")
      call suite%check(needs_mirror_z(profile_side%wheel, y, -z), "wheel with z up")
      ! the first 36 points end at the tip of the flange
      associate (u => y(:36), v => z(:36))
         call suite%check(.not. needs_mirror_z(profile_side%wheel, u, v), "wheel that ends at the tip, z down")
         call suite%check(needs_mirror_z(profile_side%wheel, u, -v), "wheel that ends at the tip, z up")
         call suite%check(needs_mirror_z(profile_side%wheel, u(36:1:-1), -v(36:1:-1)), "the same in reverse order")
         call suite%check(.not. needs_mirror_z(profile_side%wheel, -u, v), "the same of the other side, z down")
      end associate
      ! a tread without flange, bevelled at the field side
      call suite%check(.not. needs_mirror_z(profile_side%wheel, y(:31), [(-5.0_wp*(5 - min(i, 5)) + 0.05_wp*i, i=1, 31)]), &
         & "bevelled tread with z down")
      call suite%check(.not. needs_reversal(profile_side%wheel, y, z), "wheel in order")
      call suite%check(needs_reversal(profile_side%wheel, y(41:1:-1), z(41:1:-1)), "wheel in reverse order")
      call suite%check(needs_reversal(profile_side%wheel, -y, z), "wheel of the other side")
      call suite%equal(trim(extension_of("a/b.c/x")), "", "extension of a name without one")
      call suite%equal(trim(extension_of("x.PRRx")), "prr", "extension in capitals, cut")
      call suite%equal(extension_of("x.SLCS"), "slcs", "slices")
   end subroutine directions

   !> The same roof written in all the ways that are accepted
   subroutine tables(suite)
      type(test_suite), intent(inout) :: suite
      type(profile_curve) :: curve
      type(profile_request) :: request

      request = rail_request("roof.txt")
      call read_text(suite, request, roof, curve, "table")
      call is_roof(suite, curve, "table")
      call read_text(suite, request, "# title" // nl // nl // crlf(roof) // nl // "% end", curve, "CR-LF and comments")
      call is_roof(suite, curve, "CR-LF and comments")
      call read_text(suite, request, char(239) // char(187) // char(191) // roof(:len(roof) - 1), curve, &
         & "byte order mark, no end of the last line")
      call is_roof(suite, curve, "byte order mark")
      call read_text(suite, request, "20 10" // nl // "10,3" // nl // "5 1" // nl // "0 0" // nl // "-5 1" // nl // "-10 3" // nl &
         & // "-20 10", curve, "reverse order")
      call is_roof(suite, curve, "reverse order")
      call read_text(suite, request, "-20 -10" // nl // "-10 -3" // nl // "-5 -1" // nl // "-0 0" // nl // "5 -1" // nl // "10 -3" &
         & // nl // "20 -10", curve, "z up")
      call is_roof(suite, curve, "z up")
      call read_text(suite, request, roof(:index(roof, "0 0") - 1) // "0 0" // nl // "0 0" // nl // "0.00001 0" // &
         & roof(index(roof, "0 0") + 3:), curve, "points twice")
      call is_roof(suite, curve, "points twice")
      request%scale = 1000.0_wp
      call read_text(suite, request, "-.02d0 10e-3" // nl // "-10-3 3-3" // nl // "-0.005 0.001" // nl // "0 0" // nl // &
         & "0.005 0.001" // nl // "0.01 0.003" // nl // "0.02 0.01", curve, "metres")
      call is_roof(suite, curve, "metres")
      request%scale = 1.0_wp
      request%mirror_y = 1
      call read_text(suite, request, roof, curve, "mirrored")
      call is_roof(suite, curve, "mirrored")
      request%mirror_y = 0
      call read_text(suite, request, "-20 10 7" // nl // "-10 3 7" // nl // "-5 1 7" // nl // "0 0 7" // nl // "5 1 7" // nl // &
         & "10 3 7" // nl // "20 10 7", curve, "three columns", warnings=1)
      call is_roof(suite, curve, "three columns")
   end subroutine tables

   pure function crlf(text) result(changed)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: changed
      integer :: i

      changed = ""
      do i = 1, len(text)
         if (text(i:i) == nl) changed = changed // achar(13)
         changed = changed // text(i:i)
      end do
   end function crlf

   subroutine is_roof(suite, curve, what)
      type(test_suite), intent(inout) :: suite
      type(profile_curve), intent(in) :: curve
      character(len=*), intent(in) :: what

      if (.not. allocated(curve%y%s)) return
      call suite%close_to(curve%y%nodes(), [-20.0_wp, -10.0_wp, -5.0_wp, 0.0_wp, 5.0_wp, 10.0_wp, 20.0_wp], 1.0e-12_wp, &
         & what // ": y")
      call suite%close_to(curve%z%nodes(), [10.0_wp, 3.0_wp, 1.0_wp, 0.0_wp, 1.0_wp, 3.0_wp, 10.0_wp], 1.0e-12_wp, what // ": z")
      call suite%close_to(curve%s_at(0.0_wp), 0.0_wp, 1.0e-12_wp, what // ": s = 0")
   end subroutine is_roof

   subroutine simpack(suite)
      type(test_suite), intent(inout) :: suite
      !> Cosine and sine of 30 degrees
      real(wp), parameter :: c = sqrt(0.75_wp), s = 0.5_wp
      type(profile_curve) :: curve
      type(profile_request) :: request
      character(len=:), allocatable :: text
      integer :: k

      request = rail_request("roof.prr")
      call read_text(suite, request, simpack_head // "point.begin" // nl // roof // simpack_tail // "rubbish", curve, "Simpack")
      call is_roof(suite, curve, "Simpack")
      call read_text(suite, request, crlf(simpack_head // "point.begin" // nl // roof // simpack_tail), curve, "Simpack, CR-LF")
      call is_roof(suite, curve, "Simpack, CR-LF")
      text = simpack_head // "shift.y = 2" // nl // "shift.z=-5" // nl // "bound.y.min = -18.5" // nl // "bound.y.max=100" &
         & // nl // "bound.z.min = -5" // nl // "bound.z.max = -3" // nl // "mirror.y = 1" // nl // "inversion = 1" // nl // &
         & "point.begin" // nl // roof // simpack_tail
      call read_text(suite, request, text, curve, "processing of the file")
      ! y + 2 leaves -18...22, z - 5 kept in [-5, -3]; y is mirrored and the order reversed
      call suite%close_to(curve%y%nodes(), [-22.0_wp, -12.0_wp, -7.0_wp, -2.0_wp, 3.0_wp, 8.0_wp, 18.0_wp], 1.0e-12_wp, &
         & "shifted, mirrored and reversed y")
      call suite%close_to(curve%z%nodes(), [-3.0_wp, -3.0_wp, -4.0_wp, -5.0_wp, -4.0_wp, -3.0_wp, -3.0_wp], 1.0e-12_wp, &
         & "shifted and bounded z")
      ! The mirror option of the user reverses that of the file: the order is determined again
      do k = -1, 1, 2
         request%mirror_y = k
         call read_text(suite, request, text, curve, "not mirrored after all")
         call suite%close_to(curve%y%nodes(), [-18.0_wp, -8.0_wp, -3.0_wp, 2.0_wp, 7.0_wp, 12.0_wp, 22.0_wp], 1.0e-12_wp, &
            & "y as it was, shifted")
      end do
      request%mirror_y = 1
      call read_text(suite, request, simpack_head // "inversion = 0" // nl // "point.begin" // nl // "-20 10" // nl // "-10 3" // &
         & nl // "0 0" // nl // "5 1" // nl // "20 10" // nl // simpack_tail, curve, "mirrored by the user")
      call suite%close_to(curve%y%nodes(), [-20.0_wp, -5.0_wp, 0.0_wp, 10.0_wp, 20.0_wp], 1.0e-12_wp, "mirrored and reordered")
      request%mirror_y = 0
      ! a file that is wrong about its order, either way
      call read_text(suite, request, simpack_head // "inversion = 1" // nl // "point.begin" // nl // roof // simpack_tail, curve, &
         & "reversed in vain", warnings=1)
      call is_roof(suite, curve, "reversed in vain")
      call read_text(suite, request, simpack_head // "inversion = 0" // nl // "point.begin" // nl // "20 10" // nl // "10 3" // nl &
         & // "5 1" // nl // "0 0" // nl // "-5 1" // nl // "-10 3" // nl // "-20 10" // nl // &
         & simpack_tail, curve, "not reversed", &
         & warnings=1)
      call is_roof(suite, curve, "not reversed")
      ! after the shift, before the bounds: (y, z) = (3, 4) + (1, 0) becomes (4 c - 4 s, 4 s + 4 c)
      call read_text(suite, request, simpack_head // "shift.y = 1" // nl // "units.ang.f = 57.29577951308232" // nl // &
         & "rotate = 30" // nl // "bound.y.max = 1e3" // nl // "bound.y.min = -18" // nl // "point.begin" // nl // "-20 10" // nl &
         & // "-17 8" // nl // "3 4" // nl // "20 10" // nl // simpack_tail, curve, "rotated")
      call suite%close_to(curve%y%nodes(), [-16.0_wp*c - 8.0_wp*s, 4.0_wp*c - 4.0_wp*s, 21.0_wp*c - 10.0_wp*s], 1.0e-12_wp, &
         & "rotated y")
      call suite%close_to(curve%z%nodes(), [-16.0_wp*s + 8.0_wp*c, 4.0_wp*s + 4.0_wp*c, 21.0_wp*s + 10.0_wp*c], 1.0e-12_wp, &
         & "rotated z")
      call read_text(suite, request, simpack_head // "point.begin" // nl // roof // "1" // nl // "1 2 3 4" // nl // &
         & "30 20 1.0" // nl // simpack_tail, curve, "rows of wrong length", warnings=2)
      call suite%equal(size(curve%y%s), 8, "rows of wrong length are skipped")
      call read_text(suite, request, simpack_head // "colour = red" // nl // "point.begin" // nl // roof // simpack_tail, curve, &
         & "a key that is not known", warnings=1)
   end subroutine simpack

   subroutine miniprof(suite)
      type(test_suite), intent(inout) :: suite
      type(profile_curve) :: curve
      type(profile_request) :: request

      request = rail_request("roof.ban")
      call read_text(suite, request, "Filename=x.ban" // nl // "XOffset=1.5" // nl // "YOffset=" // nl // "ColumnDef=X,Y,A" // nl &
         & // nl // "-21.5 10 0" // nl // "-11.5 3 0" // nl // "-6.5 1 0" // nl // "-1.5 0 0" // nl // "3.5 1 0" // nl // &
         & "8.5 3 0" // nl // "18.5 10 0" // nl, curve, "Miniprof")
      call is_roof(suite, curve, "Miniprof")
      call read_text(suite, request, "ColumnDef=Y,K,X" // nl // "10 5 -20" // nl // "3 5 -10" // nl // "1 5 -5" // nl // "7 7" &
         & // nl // "0 5 0" // nl // "1 5 5" // nl // "3 5 10" // nl // "10 5 20", curve, "columns in other order", warnings=2)
      call is_roof(suite, curve, "columns in other order")
      call read_text(suite, request, "old style header" // nl // nl // roof, curve, "header without keys")
      call is_roof(suite, curve, "header without keys")
      ! numbers below a line of text belong to the header, up to the blank line, with a warning
      call read_text(suite, request, "Rail profile" // nl // "12.5 7.25 1e3" // nl // "Gauge 1435" // nl // "x=1" // &
         & nl // "9 9" // &
         & nl // nl // roof, curve, "header with numbers", warnings=1)
      call is_roof(suite, curve, "header with numbers")
      call read_text(suite, request, "Rail profile" // nl // "Gauge 1435" // nl // nl // roof // nl, curve, "header of text")
      call is_roof(suite, curve, "header of text")
      ! the heading of a table, also when a blank line ends the file
      call read_text(suite, request, "y z" // nl // roof // nl, curve, "heading of a table")
      call is_roof(suite, curve, "heading of a table")
      ! text after the numbers
      call read_text(suite, request, "-20 10 gauge side" // nl // "-10 3" // nl // "-5 1 a=2" // nl // "0 0 top" // &
         & nl // "5 1" // nl &
         & // "10 3" // nl // "20 10", curve, "text after numbers", warnings=1)
      call is_roof(suite, curve, "text after numbers")
      call read_text(suite, request, "ColumnDef=X,Y" // nl // nl // "-20 10 left" // nl // "-10 3 a" // nl // "-5 1" // &
         & nl // "0 0" // &
         & nl // "5 1" // nl // "10 3" // nl // "20 10", curve, "text after columns", warnings=1)
      call is_roof(suite, curve, "text after columns")
      ! keys with other capital letters, as in the established program, are ignored, with a warning
      call read_text(suite, request, "columndef=Y,X" // nl // "xoffset=1" // nl // "yOffset=1" // nl // "UNITS=inch" // nl // &
         & "tilt=1" // nl // "gauge=1" // nl // nl // roof, curve, "spelling of keys", warnings=5)
      call is_roof(suite, curve, "spelling of keys")
      ! unit and tilt of the file
      call read_text(suite, request, "Units=mm" // nl // "Tilt=0.0" // nl // nl // roof, curve, "units and tilt")
      call read_text(suite, request, "Tilt=0.5" // nl // nl // roof, curve, "tilt", warnings=1)
      call refused(suite, request, "Tilt=0" // nl // "Units=inch" // nl // nl // roof, "Units = inch", 2, "inches without a factor")
      request%scale = 2.0_wp
      call read_text(suite, request, "Units=inch" // nl // nl // roof, curve, "inches with a factor")
   end subroutine miniprof

   !> Points that no wheel or rail has bring a warning with file, line and point; corners, also coarse ones, do not
   subroutine outliers(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: moved(2, 8) = reshape([0.0_wp, 3.0_wp, 0.0_wp, -3.0_wp, 115.0_wp, 0.0_wp, -115.0_wp, 0.0_wp, &
         & 0.0_wp, 1.2_wp, 0.0_wp, 0.0_wp, 0.1_wp, 0.0_wp, 0.0_wp, 0.02_wp], [2, 8])
      real(wp), parameter :: spacing(3) = [0.2_wp, 0.5_wp, 1.5_wp]
      type(profile_curve) :: curve
      type(profile_request) :: request
      type(error_type), allocatable :: error
      type(log_type) :: log
      real(wp) :: y, z
      character(len=:), allocatable :: text
      character(len=40) :: row
      integer :: i, j, k, n

      request = rail_request("outlier.txt")
      request%doubt = doubt%refuse
      do j = 1, size(spacing)
         n = nint(30.0_wp/spacing(j))
         do k = 1, size(moved, 2)
            text = ""
            do i = -n, n
               y = spacing(j)*i
               ! a head with a corner at its side
               z = 0.002_wp*y**2 + max(0.0_wp, abs(y) - 25.0_wp)*4.0_wp
               if (i == 5) y = y + moved(1, k)
               if (i == 5) z = z + moved(2, k)
               write(row, "(2F20.10)") y, z
               text = text // row // nl
            end do
            call write_file(request%file, text)
            call read_profile(request, curve, log, error)
            if (k > 5) then
               call suite%check(.not. allocated(error), "noise and a corner are not outliers")
            else
               call suite%check(allocated(error), "an outlier is noticed")
            end if
            if (k > 2 .or. j > 1) cycle
            ! far out beside its neighbours: a spike, which is refused at every level but the last one
            request%doubt = doubt%silent
            call refused(suite, request, text, "is the end of a spike", n + 6, "a spike")
            request%doubt = doubt%ignore
            call read_profile(request, curve, log, error)
            call suite%check(.not. allocated(error), "a spike is accepted on request")
            request%doubt = doubt%refuse
         end do
      end do
      ! coarse sections that overlap look like a spike until the zig-zag is gone
      call read_text(suite, rail_request("overlap.txt"), "-9 .2" // nl // "-6 .1" // nl // "-3 .02" // nl // "0 0" // nl // &
         & "3 .02" // nl // "6 .1" // nl // "3.9 .05" // nl // "6.9 .13" // nl // "10.2 .3", curve, "overlap", warnings=2)
      ! a hole: the last points are far away; and coarse tables without any
      call read_text(suite, rail_request("hole.txt"), "-5 .1" // nl // "-4 .08" // nl // "-3 .05" // nl // "-2 .02" // &
         & nl // "-1 0" // &
         & nl // "0 0" // nl // "1 0" // nl // "2 .02" // nl // "3 .05" // nl // "4 .08" // nl // "5 .1" // nl // &
         & "95 9", curve, "hole", &
         & warnings=1)
      call read_text(suite, rail_request("coarse.txt"), "-36 30" // nl // "-35 2" // nl // "-33 0" // nl // "33 0" // &
         & nl // "35 2" // nl &
         & // "36 30" // nl // "60 30" // nl // "60.5 0" // nl // "75 0" // nl // "76 30", curve, "coarse")
   end subroutine outliers

   subroutine refusals(suite)
      type(test_suite), intent(inout) :: suite
      type(profile_request) :: request
      type(profile_curve) :: curve
      type(error_type), allocatable :: error
      type(log_type) :: log

      request = rail_request("bad.txt")
      call refused(suite, request, "", "there are 0 different points", 0, "an empty file")
      call refused(suite, request, "y;z" // nl // "-3,5;1,5" // nl // "4;1", "no point was found", 2, "columns with semicolons")
      call refused(suite, request, "5 5", "there are 1 different points", 0, "one point")
      call refused(suite, request, "5 5" // nl // "5 5" // nl // "5 5", "there are 1 different points", 0, "one point three times")
      call refused(suite, request, "0 0" // nl // "1 NaN", '"NaN" is not a finite number', 2, "NaN")
      call refused(suite, request, "0 0" // nl // "1 1e999", '"1e999" is too large', 2, "overflow")
      call refused(suite, request, "0 0" // nl // "1 two", '"two" is not a number; expected a point', 2, "a word")
      call refused(suite, request, "0 0" // nl // "1", "a single number", 2, "one number")
      call refused(suite, request, "0 0" // nl // "X=1", "follows the first point", 2, "a key after points")
      call refused(suite, request, "-.02 .01" // nl // "0 0" // nl // ".02 .01", "mm long", 0, "metres without a factor")
      call refused(suite, request, "-2000 1000" // nl // "0 0" // nl // "2000 1000", "mm long", 0, "micrometres")
      call refused(suite, request, "-20 5" // nl // "0 0" // nl // "10 2" // nl // "10 6" // nl // "5 6" // nl // "5 .5" // nl // &
         & "20 5", "segment 2 at y = 0 mm and segment 5 at y = 5 mm", 0, "a loop")
      call refused(suite, request, "ColumnDef=X,Q" // nl // nl // roof, "ColumnDef", 1, "columns that are not known")
      call refused(suite, request, "XOffset=abc" // nl // nl // roof, '"abc" is not a number', 1, "an offset that is a word")

      request = rail_request("bad.prr")
      call refused(suite, request, "", "expected spline.end", 1, "an empty Simpack file")
      call refused(suite, request, simpack_head, "expected spline.end", 9, "a Simpack file that ends too early")
      call refused(suite, request, "header.begin" // nl // "type = 1", "a rail is required", 2, "a wheel in a rail file")
      call refused(suite, request, "header.begin" // nl // "type = one", '"one" is not a number', 2, "a word in the header")
      call refused(suite, request, "header.begin" // nl // "type = 0 1", "has 2 values", 2, "a header value too many")
      call refused(suite, request, "header.begin" // nl // "spline.begin", "inside the block header", 2, "wrong nesting")
      call refused(suite, request, "point.begin", "is outside its block", 1, "points without a block")
      call refused(suite, request, "spline.start", "unknown word", 1, "a word that is not known")
      call refused(suite, request, simpack_head // "rotate = 5" // nl // "point.begin" // nl // roof // simpack_tail, &
         & "rotate = 5", 9, "a rotation in degrees without their unit")
      call refused(suite, request, simpack_head // "units.ang.f = 0", "expected a positive number", 9, "a unit of zero")
      call refused(suite, request, simpack_head // "point.begin" // nl // "0 0" // nl // "inf 1" // nl // simpack_tail, &
         & "not a finite number", 11, "an infinite point")
      request%side = profile_side%wheel
      call refused(suite, request, simpack_head, "file of a rail", 0, "a rail file for a wheel")

      request = rail_request("is/not/there.prr")
      call read_profile(request, curve, log, error)
      call suite%check(allocated(error), "a missing file is refused")
      if (allocated(error)) call suite%check(index(full_text(error), "is/not/there.prr") == 1, "the message names it")
   end subroutine refusals

   !> Points on a quarter circle and more: the spline and its inverse, order 4 under refinement
   subroutine arc(suite)
      type(test_suite), intent(inout) :: suite
      real(wp) :: errors(2), s, z
      type(profile_curve) :: curve, view
      type(profile_request) :: request
      type(error_type), allocatable :: error
      real(wp), allocatable :: y(:), angle(:)
      integer :: i, k, n

      do k = 1, 2
         n = 50*k
         angle = [(1.2_wp*i/n, i=-n, n)]
         call prepare_points(request, 30.0_wp*sin(angle), 30.0_wp*(1.0_wp - cos(angle)), curve, error)
         call suite%check(.not. allocated(error), "arc")
         y = [(20.0_wp*i/77.0_wp, i=-77, 77)]
         errors(k) = maxval(abs(curve%height(y) - (30.0_wp - sqrt(900.0_wp - y**2))))
         call suite%close_to(curve%y%value(curve%s_at(y)), y, 1.0e-12_wp, "y(s(y)) = y")
         call suite%close_to(curve%inclination(curve%s_at(15.0_wp)), pi/6.0_wp, 1.0e-4_wp, "inclination of a rail")
         call suite%close_to(curve%normal(curve%s_at(-15.0_wp)), [-0.5_wp, -sqrt(0.75_wp)], 1.0e-4_wp, "normal out of the rail")
      end do
      call suite%close_to(log(errors(1)/errors(2))/log(2.0_wp), 4.0_wp, 0.3_wp, "order of interpolation")
      call suite%check(.not. any(curve%has([-29.0_wp, 29.0_wp])), "no points beyond the ends")
      call in_a_row(suite, curve, "arc")
      call curve%top(s, z)
      call suite%close_to([s, z], [0.0_wp, 0.0_wp], 1.0e-12_wp, "highest point")

      ! Seen along the radius at -0.5 rad the arc is the same
      view = curve%seen_from([30.0_wp*sin(-0.5_wp), 30.0_wp*(1.0_wp - cos(0.5_wp))], -0.5_wp, [-25.0_wp, 5.0_wp])
      y = [-8.0_wp, 0.0_wp, 8.0_wp]
      call suite%close_to(view%height(y), 30.0_wp - sqrt(900.0_wp - y**2), 1.0e-6_wp, "seen along another radius")
      call suite%check(.not. view%has(25.0_wp), "only the requested range")
   end subroutine arc

   !> Heights of many points are those of each
   subroutine in_a_row(suite, curve, what)
      type(test_suite), intent(inout) :: suite
      type(profile_curve), intent(in) :: curve
      character(len=*), intent(in) :: what
      real(wp) :: y(-400:400), z(-400:400)
      logical :: found(-400:400)
      integer :: i

      y = [(0.08_wp*i, i=-400, 400)]
      call curve%heights(y, z, found)
      call suite%check(all(found .eqv. curve%has(y)), what // ": where there are points in a row")
      call suite%close_to(pack(z, found), pack(curve%height(y), found), 1.0e-12_wp, what // ": heights in a row")
   end subroutine in_a_row

   !> Overhanging profiles: the part visible from above (rail) and from below (wheel)
   subroutine hidden(suite)
      type(test_suite), intent(inout) :: suite
      type(profile_curve) :: curve
      type(profile_request) :: request
      type(error_type), allocatable :: error
      real(wp), parameter :: y(9) = [-8.0_wp, -10.0_wp, -10.0_wp, -5.0_wp, 0.0_wp, 5.0_wp, 10.0_wp, 10.0_wp, 8.0_wp]
      real(wp), parameter :: z(9) = [12.0_wp, 8.0_wp, 2.0_wp, 0.1_wp, 0.0_wp, 0.1_wp, 2.0_wp, 8.0_wp, 12.0_wp]

      request%kink_high = 4.0_wp
      request%max_hidden = 1.0_wp
      call prepare_points(request, y, z, curve, error)
      call suite%check(.not. allocated(error), "rail with an overhang")
      call suite%close_to(curve%height([-5.0_wp, 0.0_wp, 5.0_wp]), [0.1_wp, 0.0_wp, 0.1_wp], 1.0e-12_wp, "its top is seen")
      call suite%check(curve%height(-8.5_wp) < 3.0_wp, "not its underside")
      call in_a_row(suite, curve, "overhang of a rail")
      ! Below the widest points, near z = 5: 2 (4.5 + 3) mm of 42 mm
      call suite%close_to(curve%hidden_part(), 0.36_wp, 0.03_wp, "the part below the widest points is hidden")
      request%side = profile_side%wheel
      call prepare_points(request, -y, -z, curve, error)
      call suite%close_to(curve%height([-5.0_wp, 0.0_wp, 5.0_wp]), [-0.1_wp, 0.0_wp, -0.1_wp], 1.0e-12_wp, &
         & "the wheel is the mirror image")
      call in_a_row(suite, curve, "overhang of a wheel")
      request%side = profile_side%rail
      request%max_hidden = 0.1_wp
      call prepare_points(request, y, z, curve, error)
      call suite%check(allocated(error), "more hidden than allowed is refused")
      request%doubt = doubt%ignore
      call prepare_points(request, y, z, curve, error)
      call suite%check(.not. allocated(error), "unless the user permits it")
      request%doubt = doubt%warn
      ! A wall that hides nothing but has no width
      request%max_hidden = 1.0_wp
      call prepare_points(request, [0.0_wp, 0.0_wp, 0.0_wp], [0.0_wp, 5.0_wp, 10.0_wp], curve, error)
      call suite%check(allocated(error), "a vertical wall is refused")
      call prepare_points(request, [0.0_wp, 0.0_wp, 10.0_wp, 10.0_wp], [8.0_wp, 0.0_wp, 0.0_wp, 8.0_wp], curve, error)
      call suite%check(.not. allocated(error), "a box")
   end subroutine hidden

   !> A zig-zag gives a warning, no message, or an error
   subroutine doubts(suite)
      type(test_suite), intent(inout) :: suite
      type(profile_curve) :: curve
      type(profile_request) :: request
      type(error_type), allocatable :: error
      type(log_type) :: log
      integer, parameter :: choices(4) = [doubt%ignore, doubt%silent, doubt%warn, doubt%refuse]
      integer, parameter :: warnings(4) = [0, 0, 1, 1]
      integer :: k, i

      request%file = "zig_zag.dat"
      allocate(request%points(2, 21), source=0.0_wp)
      do i = 1, 21
         request%points(1, i) = -20.0_wp + 2.0_wp*i
         request%points(2, i) = 0.01_wp*request%points(1, i)**2
      end do
      request%points(:, 11) = [2.5_wp, 0.06_wp]
      request%points(:, 12) = [1.9_wp, 0.05_wp]
      do k = 1, size(choices)
         request%doubt = choices(k)
         log%warnings = 0
         call log%begin_case()
         call read_profile(request, curve, log, error)
         call suite%equal(log%warnings, warnings(k), "warnings about a zig-zag")
         call suite%check(allocated(error) .eqv. choices(k) == doubt%refuse, "refused only on request")
         if (allocated(error) .and. choices(k) /= doubt%refuse) call suite%check(.false., full_text(error))
      end do
   end subroutine doubts

   !> The three methods damp a wave on an arc as they should, and keep the points without a parameter
   subroutine smoothing(suite)
      type(test_suite), intent(inout) :: suite
      type(profile_curve) :: curve
      type(profile_request) :: request
      type(error_type), allocatable :: error
      real(wp) :: y(801), z(801), left(3)
      integer :: i, method
      real(wp), parameter :: length = 2.0_wp, height = 1.0e-4_wp

      y = [(0.05_wp*(i - 401), i=1, 801)]
      z = height*cos(2.0_wp*pi*y/length)
      do method = smoothing_method%ordinary, smoothing_method%b_spline
         request%method = method
         request%smooth = 0.0_wp
         call prepare_points(request, y, z, curve, error)
         call suite%close_to(curve%height(y), z, 1.0e-12_wp, "no smoothing keeps the points")
         request%smooth = 4.0_wp
         if (method == smoothing_method%ordinary) request%smooth = (4.0_wp/(2.0_wp*pi))**4/0.05_wp
         call prepare_points(request, y, z, curve, error)
         left = curve%height([-2.0_wp, 0.0_wp, 2.0_wp])/height
         if (method == smoothing_method%b_spline) then
            call suite%check(maxval(left) < 0.03_wp, "half the wavelength: 1/65")
         else
            call suite%close_to(left, 1.0_wp/17.0_wp + 0.0_wp*left, 2.0e-3_wp, "half the wavelength: 1/17")
         end if
      end do
   end subroutine smoothing

   !> Facts of the published files of the Manchester benchmark and of all other files that are there
   subroutine reference_files(suite)
      type(test_suite), intent(inout) :: suite
      type(profile_curve) :: curve, other
      type(profile_request) :: request
      type(error_type), allocatable :: error
      type(log_type) :: log
      character(len=:), allocatable :: folder
      real(wp) :: s, z
      character(len=*), parameter :: rails(*) = [character(len=16) :: "circ_r100.prr", "circ_r300.prr", "flat_plane.prr", &
         & "groove_r1002.prr", "groove_r1025.prr", "site_b_hr.prr"]
      character(len=*), parameter :: wheels(*) = [character(len=24) :: "circ_r10.prw", "circ_r100.prw", "flat_plane.prw", &
         & "worn_high_mileage.prw"]
      integer :: i

      folder = reference_folder()
      if (folder == "") then
         call suite%skip("published profiles", "CONTACT_REFERENCE is not there")
         return
      end if
      request = rail_request(folder // "/examples/MBench_UIC60_v3.prr")
      call read_profile(request, curve, log, error)
      call suite%check(.not. allocated(error), "benchmark rail")
      if (allocated(error)) return
      call suite%equal(size(curve%y%s), 495, "its points")
      call suite%close_to(curve%s_range(), [-73.687_wp, 58.702_wp], 1.0e-3_wp, "its length")
      call suite%close_to(curve%y_range(), [-43.705_wp, 30.596_wp], 1.0e-3_wp, "its range")
      call curve%top(s, z)
      call suite%close_to(z, -7.2e-8_wp, 5.0e-9_wp, "its top")
      request = rail_request(folder // "/examples/MBench_UIC60_v3.ban")
      request%mirror_y = 1
      call read_profile(request, other, log, error)
      call suite%check(.not. allocated(error), "the same as Miniprof file")
      if (.not. allocated(error)) call suite%close_to(other%height([-30.0_wp, 0.0_wp, 25.0_wp]), &
         & curve%height([-30.0_wp, 0.0_wp, 25.0_wp]), 1.0e-5_wp, "the same as Miniprof file")
      request = wheel_request(folder // "/examples/MBench_S1002_v3.prw")
      call read_profile(request, curve, log, error)
      call suite%check(.not. allocated(error), "benchmark wheel")
      if (allocated(error)) return
      call suite%equal(size(curve%y%s), 399, "its points")
      call suite%close_to(curve%s_range(), [-60.075_wp, 89.313_wp], 1.0e-3_wp, "its length")
      do i = 1, size(rails)
         call read_profile(rail_request(folder // "/testbank/profiles/" // trim(rails(i))), curve, log, error)
         call suite%check(.not. allocated(error), trim(rails(i)) // " is read")
      end do
      do i = 1, size(wheels)
         call read_profile(wheel_request(folder // "/testbank/profiles/" // trim(wheels(i))), curve, log, error)
         call suite%check(.not. allocated(error), trim(wheels(i)) // " is read")
      end do
   end subroutine reference_files
end program test_profile
