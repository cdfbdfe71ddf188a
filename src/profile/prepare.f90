!> Reading and preparation of a profile
module contact_profile_prepare
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_numeric_b_spline, only : not_a_knot_splines, smooth_b_splines
   use contact_numeric_spline, only : cubic_spline, natural_splines, smoothing_splines
   use contact_profile_curve, only : new_curve, profile_curve
   use contact_profile_miniprof, only : read_miniprof
   use contact_profile_points, only : chord_lengths, drop_close_points, find_gap, find_kinks, find_loop, find_outlier, &
      & find_spike, keep_points, needs_mirror_z, needs_reversal, remove_zig_zags, runs_backwards
   use contact_profile_request, only : doubt, profile_file, profile_request, profile_side, smoothing_method
   use contact_profile_simpack, only : read_simpack
   use contact_text_lexer, only : input_lexer
   use contact_text_words, only : integer_text, real_text
   implicit none (type, external)
   private

   public :: read_profile, prepare_points, extension_of, is_slices_file, length_origin

   !> Range of profile lengths in millimetres [mm]; excludes files in other units
   real(wp), parameter :: shortest = 5.0_wp, longest = 500.0_wp
   !> Maximum number of kinks of a profile
   integer, parameter :: max_kinks = 99

   !> From this hidden fraction on practically nothing of a profile is visible, whatever the request permits
   real(wp), parameter :: all_hidden = 0.999_wp

contains

   !> Read and prepare a profile; warnings are treated as requested by the user
   subroutine read_profile(request, curve, log, error)
      !> File, and how it is to be read and smoothed
      type(profile_request), intent(in) :: request
      !> Splines, visible parts and statistics
      type(profile_curve), intent(out) :: curve
      !> Receives warnings
      type(log_type), intent(inout) :: log
      !> Gives file, line and what is wrong
      type(error_type), allocatable, intent(out) :: error
      type(log_type) :: discarded
      character(len=:), allocatable :: name
      integer :: before

      if (request%doubt < doubt%warn) then
         call clean_profile(request, curve, discarded, error)
         return
      end if
      before = log%occurrences
      call clean_profile(request, curve, log, error)
      if (request%doubt == doubt%refuse .and. log%occurrences > before .and. .not. allocated(error)) then
         call find_name(request, name)
         call fatal_error(error, "ERRHND = 1 refuses a profile with warnings", file=name)
      end if
   end subroutine read_profile

   !> Name of the profile in messages
   pure subroutine find_name(request, name)
      type(profile_request), intent(in) :: request
      character(len=:), allocatable, intent(out) :: name

      name = "profile"
      if (allocated(request%file)) name = request%file
   end subroutine find_name

   !> Read, clean and smooth a profile from a file, or from given points
   subroutine clean_profile(request, curve, log, error)
      type(profile_request), intent(in) :: request
      type(profile_curve), intent(out) :: curve
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      type(input_lexer) :: text
      type(profile_file) :: file
      real(wp), allocatable :: y(:), z(:)

      if (allocated(request%points)) then
         file%y = request%points(1, :)
         file%z = request%points(2, :)
      else
         call refuse_extension(request, error)
         if (.not. allocated(error)) call text%open_file(request%file, error, request%below)
         if (allocated(error)) return
         select case (extension_of(request%file))
         case ("prr", "prw")
            call read_simpack(text, request%side, file, log, error)
         case default
            call read_miniprof(text, file, log, error)
         end select
      end if
      if (.not. allocated(error)) call normalise(file, request, y, z, log, error)
      if (.not. allocated(error)) call prepare_points(request, y, z, curve, error)
   end subroutine clean_profile

   !> Lower-case extension of a file name, at most four letters; known kinds have three
   pure function extension_of(file) result(extension)
      !> Path as the user gave it
      character(len=*), intent(in) :: file
      character(len=4) :: extension
      integer :: i

      i = index(file, ".", back=.true.)
      extension = ""
      if (i == 0 .or. scan(file(i + 1:), "/\") > 0) return
      extension = file(i + 1:)
      do i = 1, len(extension)
         if (extension(i:i) >= "A" .and. extension(i:i) <= "Z") extension(i:i) = achar(iachar(extension(i:i)) + 32)
      end do
      if (any(extension(:3) == ["prr", "prw", "ban", "whl"])) extension = extension(:3)
   end function extension_of

   !> Has a file the extension of slices of a rail or a wheel?
   pure logical function is_slices_file(file)
      !> Its name
      character(len=*), intent(in) :: file

      is_slices_file = extension_of(file) == "slcs" .or. extension_of(file) == "slcw"
   end function is_slices_file

   !> Refuse a file whose extension belongs to the other body
   subroutine refuse_extension(request, error)
      type(profile_request), intent(in) :: request
      type(error_type), allocatable, intent(out) :: error

      select case (extension_of(request%file))
      case ("prr", "ban")
         if (request%side == profile_side%wheel) call fatal_error(error, "this is the file of a rail, but a wheel is &
            &wanted; accepted are .prw, .whl, .slcw, and tables with any other extension", file=request%file)
      case ("prw", "whl")
         if (request%side == profile_side%rail) call fatal_error(error, "this is the file of a wheel, but a rail is &
            &wanted; accepted are .prr, .ban, .slcs, and tables with any other extension", file=request%file)
      end select
   end subroutine refuse_extension

   !> Points in millimetres in canonical order
   subroutine normalise(file, request, y, z, log, error)
      type(profile_file), intent(in) :: file
      type(profile_request), intent(in) :: request
      real(wp), allocatable, intent(out) :: y(:), z(:)
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      integer :: zig_zags, first, second
      logical :: reverse
      real(wp) :: length
      character(len=:), allocatable :: expected

      y = file%y
      z = file%z
      call refuse_units(file, request, error)
      if (allocated(error)) return
      call drop_close_points(y, z, file%nearest)
      call remove_zig_zags(y, z, request%zig_zag, zig_zags)
      call check_points(file, request, y, z, log, error)
      if (allocated(error)) return
      if (zig_zags > 0) then
         call log%warning(request%file // ": " // integer_text(zig_zags) // " zig-zag(s) removed.")
         call drop_close_points(y, z, file%nearest)
      end if
      y = y + file%shift_y
      z = z + file%shift_z
      if (abs(file%rotation) > 0.0_wp) call rotate(y, z, file%rotation)
      if (file%lower_y < file%upper_y) call keep_points(y, z, y >= file%lower_y .and. y <= file%upper_y)
      if (file%lower_z < file%upper_z) then
         z = min(max(z, file%lower_z), file%upper_z)
         call drop_close_points(y, z, file%nearest)
      end if
      if (size(y) < 2) then
         call fatal_error(error, "there are " // integer_text(size(y)) // " different points; a profile needs at least two", &
            & file=request%file)
         return
      end if
      if (mirrors_y(file, request)) y = -y
      if (mirrors_z(file, request, y, z)) z = -z
      y = y*request%scale/file%units_per_mm
      z = z*request%scale/file%units_per_mm
      call warn_of_direction(file, request, y, z, log)
      if (request%side == profile_side%wheel) call warn_of_flange(request, y, z, log)
      length = sum(hypot(y(2:) - y(:size(y) - 1), z(2:) - z(:size(y) - 1)))
      if (length < shortest .or. length > longest) then
         call fatal_error(error, "the profile is " // real_text(length) // " mm long; accepted are " // real_text(shortest) // &
            & " to " // real_text(longest) // " mm (is the scale factor right?)", file=request%file)
         return
      end if

      reverse = file%inversion == 1
      ! the order given by the file refers to y after the mirroring requested by the file
      if (file%inversion < 0 .or. (mirrors_y(file, request) .neqv. file%mirror_y)) reverse = needs_reversal(request%side, y, z)
      if (reverse) then
         y = y(size(y):1:-1)
         z = z(size(z):1:-1)
      end if
      if (runs_in_reverse(request%side, y, z) .and. .not. runs_in_reverse(request%side, y(size(y):1:-1), z(size(z):1:-1))) then
         call find_name(request, expected)
         call log%warning(expected // ": the points run from y = " // real_text(y(1)) // " to " // real_text(y(size(y))) // &
            & " mm with the inversion requested by the file; their order is reversed, as the shape requires.")
         y = y(size(y):1:-1)
         z = z(size(z):1:-1)
      end if
      if (runs_in_reverse(request%side, y, z)) then
         expected = "that of a wheel must decrease, with the flange down"
         if (request%side == profile_side%rail) expected = "that of a rail must increase, with the running surface on top"
         call fatal_error(error, "the lateral coordinate runs from " // real_text(y(1)) // " to " // real_text(y(size(y))) // &
            & " mm; " // expected // " (mirror y or z, or change the inversion in the file)", file=request%file)
         return
      end if
      call find_loop(y, z, first, second)
      if (first > 0) then
         call fatal_error(error, "the profile crosses itself: segment " // integer_text(first) // " at y = " // &
            & real_text(y(first)) // " mm and segment " // integer_text(second) // " at y = " // real_text(y(second)) // &
            & " mm; a curve without loops is required", file=request%file)
      end if
   end subroutine normalise

   !> Does the order of the points contradict the shape?
   pure logical function runs_in_reverse(side, y, z) result(reverse)
      !> Member of profile_side
      integer, intent(in) :: side
      real(wp), intent(in) :: y(:), z(:)

      reverse = runs_backwards(side, y) .or. needs_reversal(side, y, z)
   end function runs_in_reverse

   !> Rotate points about the x axis, from y towards z
   pure subroutine rotate(y, z, angle)
      real(wp), intent(inout) :: y(:), z(:)
      !> [rad]
      real(wp), intent(in) :: angle
      real(wp) :: before(size(y))

      before = y
      y = cos(angle)*y - sin(angle)*z
      z = sin(angle)*before + cos(angle)*z
   end subroutine rotate

   !> Refuse a file in another unit without a scale factor
   subroutine refuse_units(file, request, error)
      type(profile_file), intent(in) :: file
      type(profile_request), intent(in) :: request
      type(error_type), allocatable, intent(out) :: error

      if (.not. allocated(file%unit_name) .or. abs(request%scale - 1.0_wp) > 0.0_wp) return
      call fatal_error(error, "Units = " // file%unit_name // ", but SCALEYZ is 1; expected millimetres, or the factor to &
         &millimetres as SCALEYZ", file=request%file, line=file%unit_line)
   end subroutine refuse_units

   !> Check for implausible points: refuse a spike, warn about outliers and about a large gap
   subroutine check_points(file, request, y, z, log, error)
      type(profile_file), intent(in) :: file
      type(profile_request), intent(in) :: request
      !> Points without zig-zags, in the unit of the file
      real(wp), intent(in) :: y(:), z(:)
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      !> Height of a spike [mm]; length of a gap [mm], and relative to the usual distance between points
      real(wp), parameter :: spike = 1.0_wp, gap = 10.0_wp, gap_ratio = 20.0_wp
      real(wp) :: factor
      integer :: i

      factor = abs(request%scale)/file%units_per_mm
      if (request%doubt > doubt%ignore .and. find_spike(factor*y, factor*z, spike) > 0) then
         i = find_spike(factor*file%y, factor*file%z, spike)
         if (i > 0) then
            call refuse_spike(i)
            return
         end if
      end if
      i = find_outlier(factor*file%y, factor*file%z, spike)
      if (i > 0) then
         call warn(i, " deviates from the line of its neighbours by more than " // real_text(spike) // " mm; the curve &
            &passes through it nevertheless.")
         return
      end if
      i = find_gap(factor*file%y, factor*file%z, gap, gap_ratio)
      if (i > 0) call warn(i, " is " // real_text(factor*hypot(file%y(i + 1) - file%y(i), file%z(i + 1) - file%z(i))) // " mm away &
         &from the next one, much more than usual; the curve between them is interpolated over this gap.")

   contains

      !> Refuse a profile with a spike
      subroutine refuse_spike(i)
         integer, intent(in) :: i
         integer :: line

         line = 0
         if (allocated(file%line)) line = file%line(i)
         call fatal_error(error, "point " // integer_text(i) // " at y = " // real_text(file%y(i)) // ", z = " // &
            & real_text(file%z(i)) // " is the end of a spike: the line goes there and returns along itself, as no surface &
            &does; expected a point near its neighbours, or ERRHND = -2 to take the points as they are", file=request%file, &
            & line=line)
      end subroutine refuse_spike

      !> Issue a warning about a point
      subroutine warn(i, what)
         integer, intent(in) :: i
         character(len=*), intent(in) :: what
         character(len=:), allocatable :: name

         call find_name(request, name)
         if (allocated(file%line)) name = name // ", line " // integer_text(file%line(i))
         call log%warning(name // ": point " // integer_text(i) // " at y = " // real_text(file%y(i)) // ", z = " // &
            & real_text(file%z(i)) // what)
      end subroutine warn
   end subroutine check_points

   !> Mirroring requested by both the user and the file cancels; "no" of the user overrides the file
   pure logical function mirrors_y(file, request) result(mirror)
      type(profile_file), intent(in) :: file
      type(profile_request), intent(in) :: request

      mirror = request%mirror_y + merge(1, 0, file%mirror_y) == 1
   end function mirrors_y

   !> Warn if z clearly points upwards with the direction that the user or the file requests
   !>
   !> Narrow profiles are left alone: a groove has raised sides in its correct position.
   subroutine warn_of_direction(file, request, y, z, log)
      type(profile_file), intent(in) :: file
      type(profile_request), intent(in) :: request
      !> Coordinates as mirrored [mm]
      real(wp), intent(in) :: y(:), z(:)
      type(log_type), intent(inout) :: log
      !> Least height of a flange or of side faces relative to the width, and least width of a rail head or a wheel [mm]
      real(wp), parameter :: visible = 0.1_wp, wide = 50.0_wp
      real(wp) :: upwards(size(z))
      character(len=:), allocatable :: name

      if (file%guess_z .and. request%mirror_z == 0) return
      if (maxval(y) - minval(y) < wide) return
      if (maxval(z) - minval(z) < visible*(maxval(y) - minval(y))) return
      upwards = -z
      if (.not. needs_mirror_z(request%side, y, z) .or. needs_mirror_z(request%side, y, upwards)) return
      call find_name(request, name)
      call log%warning(name // ": by its shape the profile is upside down: z has to point downwards. Its direction is that of " // &
         & "MIRRORZ, and of mirror.z in a Simpack file.")
   end subroutine warn_of_direction

   !> Warn if the flange of a wheel is clearly on its outer side, as in profiles of left wheels
   !>
   !> The flange is the deepest part. Profiles without one are not high enough; those of two flanges have both sides deep.
   subroutine warn_of_flange(request, y, z, log)
      type(profile_request), intent(in) :: request
      !> Coordinates as mirrored [mm]
      real(wp), intent(in) :: y(:), z(:)
      type(log_type), intent(inout) :: log
      !> Least width of a wheel [mm], least height of a flange relative to it, and part of the width on which a flange stands
      real(wp), parameter :: wide = 50.0_wp, visible = 0.1_wp, part = 0.4_wp
      real(wp) :: width, height, inner, outer
      character(len=:), allocatable :: name

      width = maxval(y) - minval(y)
      height = maxval(z) - minval(z)
      if (width < wide .or. height < visible*width) return
      inner = maxval(z, y <= minval(y) + part*width)
      outer = maxval(z, y >= maxval(y) - part*width)
      if (outer < maxval(z) .or. inner > outer - 0.5_wp*height) return
      call find_name(request, name)
      call log%warning(name // ": by its shape the wheel has its flange on the outer side, where y is largest; y has to point " // &
         & "away from the flange (MIRRORY mirrors y)")
   end subroutine warn_of_flange

   !> As for y; if the file leaves it open, it is determined from the shape unless the user sets it
   pure logical function mirrors_z(file, request, y, z) result(mirror)
      type(profile_file), intent(in) :: file
      type(profile_request), intent(in) :: request
      !> Coordinates, y as mirrored
      real(wp), intent(in) :: y(:), z(:)

      mirror = request%mirror_z + merge(1, 0, file%mirror_z) == 1
      if (file%guess_z .and. request%mirror_z == 0) mirror = needs_mirror_z(request%side, y, z)
   end function mirrors_z

   !> Smooth points in canonical order, and determine the visible parts of the curve
   subroutine prepare_points(request, y, z, curve, error)
      !> Side and smoothing
      type(profile_request), intent(in) :: request
      !> Coordinates [mm]
      real(wp), intent(in) :: y(:), z(:)
      !> Splines and visible parts
      type(profile_curve), intent(out) :: curve
      !> Why the points do not form a profile
      type(error_type), allocatable, intent(out) :: error
      type(cubic_spline), allocatable :: splines(:)
      real(wp), allocatable :: s(:)
      logical, allocatable :: is_kink(:)
      logical :: solved
      character(len=:), allocatable :: file

      call find_name(request, file)
      s = chord_lengths(y, z)
      s = s - length_origin(s, y, z)
      is_kink = find_kinks(y, z, request%kink_high, request%kink_low, request%kink_width)
      if (count(is_kink) > max_kinks) then
         call fatal_error(error, "there are " // integer_text(count(is_kink)) // " kinks; accepted are at most " // &
            & integer_text(max_kinks) // " (raise KINKHIGH)", file=file)
         return
      end if
      call smooth_points(request, s, y, z, is_kink, splines, solved)
      if (.not. solved) then
         call fatal_error(error, "smoothing with " // real_text(request%smooth) // " fails on points that are " // &
            & real_text(minval(s(2:) - s(:size(s) - 1))) // " mm apart; smooth less or drop close points", file=file)
         return
      end if
      curve = new_curve(request%side, splines(1), splines(2))
      if (request%doubt > doubt%ignore .and. curve%hidden_part() > min(request%max_hidden, all_hidden)) then
         call fatal_error(error, real_text(100.0_wp*curve%hidden_part()) // " % of the profile is hidden behind the rest; &
            &at most " // real_text(100.0_wp*request%max_hidden) // " % is accepted (is it upside down?)", file=file)
      end if
   end subroutine prepare_points

   !> Smooth both coordinates by the selected method
   subroutine smooth_points(request, s, y, z, is_kink, splines, solved)
      type(profile_request), intent(in) :: request
      real(wp), intent(in) :: s(:), y(:), z(:)
      logical, intent(in) :: is_kink(:)
      type(cubic_spline), allocatable, intent(out) :: splines(:)
      logical, intent(out) :: solved
      !> Weights of kinks, and for the weighted methods of ends
      real(wp), parameter :: kink_weight = 100.0_wp, end_weight = 20.0_wp
      !> Smaller values mean interpolation [mm4], [mm6]
      real(wp), parameter :: min_fourth = 1.0e-10_wp, min_sixth = 1.0e-6_wp
      !> Ratio of the largest to the smallest eigenvalue in smoothing by B-splines
      real(wp), parameter :: conditioning = 20.0e-6_wp
      real(wp) :: weights(size(s)), points(size(s), 2), lambda, spacing
      integer :: n
      !> Minimum distance between knots [mm], finer than any measurement; maximum number of intervals
      real(wp), parameter :: min_spacing = 0.001_wp
      integer, parameter :: max_intervals = 4998

      n = size(s)
      points(:, 1) = y
      points(:, 2) = z
      if (request%method == smoothing_method%ordinary) then
         weights = 1.0_wp
         lambda = request%smooth
      else
         weights(1) = end_weight*(s(2) - s(1))
         weights(2:n - 1) = 0.5_wp*(s(3:) - s(:n - 2))
         weights(n) = end_weight*(s(n) - s(n - 1))
         lambda = (request%smooth/(2.0_wp*pi))**4
      end if
      where (is_kink) weights = kink_weight*weights
      if (request%method == smoothing_method%b_spline) then
         if (request%smooth <= 0.0_wp) then
            call not_a_knot_splines(s, points, splines, solved, is_kink)
            return
         end if
         lambda = max(min_sixth, (request%smooth/(2.0_wp*pi))**6)
         spacing = max(min_spacing, 0.25_wp*request%smooth, (conditioning*lambda)**(1.0_wp/6.0_wp), &
            & (s(n) - s(1))/max_intervals)
         call smooth_b_splines(s, points, weights, lambda, spacing, splines, solved, is_kink)
      else
         if (lambda > min_fourth) then
            call smoothing_splines(s, points, weights, lambda, splines, solved, is_kink)
            return
         end if
         allocate(splines(2))
         call natural_splines(s, points, splines, is_kink)
         solved = .true.
      end if
   end subroutine smooth_points

   !> Arc length of the origin of s: at y = 0 if y is monotonic, otherwise at the point nearest to (0, 0)
   pure real(wp) function length_origin(s, y, z) result(origin)
      !> Arc length, and coordinates of the points [mm], all of one shape
      real(wp), intent(in) :: s(:), y(:), z(:)
      integer :: n, i
      logical :: rises

      n = size(s)
      rises = y(n) > y(1)
      if (all((y(2:) > y(:n - 1)) .eqv. rises) .and. all(y(2:) /= y(:n - 1))) then
         if (rises .eqv. y(1) >= 0.0_wp) then
            origin = s(1)
            return
         else if (rises .eqv. y(n) <= 0.0_wp) then
            origin = s(n)
            return
         end if
         do i = 1, n - 2
            if ((y(i + 1) >= 0.0_wp) .eqv. rises) exit
         end do
         origin = s(i) - y(i)*(s(i + 1) - s(i))/(y(i + 1) - y(i))
      else
         origin = s(minloc(y**2 + z**2, 1))
      end if
   end function length_origin
end module contact_profile_prepare
