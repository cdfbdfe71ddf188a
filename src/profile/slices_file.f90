!> Slices files: positions of the slices of a variable profile, their files, and corresponding features
!>
!>     U_OFFSET  U_SCALE
!>     NSLC
!>     NFEAT  NKINK  NACCEL
!>     U_INTPOL                        1 interpolating, 2 approximating
!>     U_SLC  'NAME'                   NSLC times
!>     P_KINK(1...NKINK)               parts with a kink to the next one
!>     U_SLC  S_F(1...NFEAT)           NSLC times when NFEAT > 1; negative: not in this slice
!>
!> Rails .slcs: u along the track [mm]; wheels .slcw: u is the angle around the wheel [rad].
module contact_profile_slices_file
   use contact_base_constants, only : pi
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_profile_request, only : profile_side
   use contact_text_lexer, only : input_lexer, input_value
   use contact_text_words, only : integer_text, real_text, replaced
   implicit none (type, external)
   private

   public :: slices_list, slice_entry, read_slices_file, resolve_path

   !> A slice
   type :: slice_entry
      !> Position: along the track [mm], or angle around the wheel [rad]
      real(wp) :: u = 0.0_wp
      !> Path of its file, and line in the slices file
      character(len=:), allocatable :: file
      integer :: line = 0
   end type slice_entry

   !> Content of a slices file
   type :: slices_list
      type(slice_entry), allocatable :: slices(:)
      !> Are the slices control points (approximating) rather than interpolated?
      logical :: approximating = .false.
      !> Arc lengths of the features [mm] from the first point, (feature, slice); negative if absent
      real(wp), allocatable :: features(:, :)
      !> Is there a kink at the feature?
      logical, allocatable :: is_kink(:)
   end type slices_list

   integer, parameter :: max_slices = 4999, max_features = 999
   !> Minimum distance between slices in units of u, and between features [mm]
   real(wp), parameter :: min_distance = 1.0e-3_wp, min_feature = 1.0e-6_wp
   !> Positions of the end features if the file names none [mm]
   real(wp), parameter :: far = 1.0e6_wp

contains

   !> Read positions and names of the slices, features, kinks
   !>
   !> Long because the parts of the file share what was read so far; each is an internal procedure of at most 22 lines.
   subroutine read_slices_file(text, side, list, error)
      !> The complete file; its reading position is advanced
      type(input_lexer), intent(inout) :: text
      !> Member of profile_side
      integer, intent(in) :: side
      !> Positions and files of the slices, features, kinks
      type(slices_list), intent(out) :: list
      !> Gives file, line and what is accepted
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(3)
      real(wp) :: offset, scale
      integer :: n, features, kinks, k

      call text%read_group("rr", "U_OFFSET U_SCALE", v, error)
      if (allocated(error)) return
      offset = v(1)%r
      scale = v(2)%r
      call text%read_group("i", "NSLC", v, error)
      if (.not. allocated(error)) call refuse_outside(v(1), 1, max_slices)
      if (allocated(error)) return
      n = v(1)%i
      call text%read_group("iII", "NFEAT NKINK NACCEL", v, error)
      if (.not. allocated(error)) call refuse_outside(v(1), 0, max_features)
      if (allocated(error)) return
      features = v(1)%i
      kinks = 0
      if (features > 1) then
         kinks = v(2)%i
         call refuse_outside(v(2), 0, features - 2)
         if (.not. allocated(error) .and. v(3)%i /= 0) call fatal_error(error, "NACCEL = " // integer_text(v(3)%i) // &
            & ": jumps of curvature between parts are not supported; accepted is 0, with a kink (NKINK) where the section bends", &
            & error_kind%unsupported, text%file, v(3)%line, v(3)%column)
         if (allocated(error)) return
      end if
      call text%read_group("i", "U_INTPOL", v, error)
      if (.not. allocated(error)) call refuse_outside(v(1), 1, 2)
      if (allocated(error)) return
      list%approximating = v(1)%i == 2

      allocate(list%slices(n))
      do k = 1, n
         call text%read_group("rs", "U_SLC NAME", v, error)
         if (allocated(error)) return
         list%slices(k)%u = scale*(offset + v(1)%r)
         call resolve_path(text%file, v(2)%s, list%slices(k)%file)
         list%slices(k)%line = v(1)%line
         if (k == 1) cycle
         if (list%slices(k)%u - list%slices(k - 1)%u > min_distance) cycle
         call fatal_error(error, "slice " // integer_text(k) // " is at " // real_text(list%slices(k)%u) // ", the one before at " &
            & // real_text(list%slices(k - 1)%u) // "; positions must increase by more than 0.001", file=text%file, line=v(1)%line)
         return
      end do
      if (side == profile_side%wheel) then
         call check_angles(list, text%file, error)
         if (allocated(error)) return
      end if
      call read_kinks()
      if (.not. allocated(error)) call read_features()

   contains

      subroutine refuse_outside(value, lowest, highest)
         type(input_value), intent(in) :: value
         integer, intent(in) :: lowest, highest

         if (value%i >= lowest .and. value%i <= highest) return
         call fatal_error(error, value%name // " = " // integer_text(value%i) // " cannot be used; accepted are " // &
            & integer_text(lowest) // " to " // integer_text(highest), file=text%file, line=value%line, column=value%column)
      end subroutine refuse_outside

      subroutine read_kinks()
         real(wp), allocatable :: numbers(:)
         integer :: line, i

         allocate(list%is_kink(max(2, features)))
         list%is_kink = .false.
         if (kinks == 0) return
         call text%read_array(kinks, "P_KINK", numbers, error, line=line)
         if (allocated(error)) return
         do i = 1, kinks
            if (nint(numbers(i)) < 1 .or. nint(numbers(i)) > features - 2 .or. abs(numbers(i) - nint(numbers(i))) > 0.0_wp) then
               call fatal_error(error, "P_KINK = " // real_text(numbers(i)) // ": accepted are 1 to " // &
                  & integer_text(features - 2), file=text%file, line=line)
               return
            end if
            list%is_kink(nint(numbers(i)) + 1) = .true.
         end do
      end subroutine read_kinks

      subroutine read_features()
         real(wp), allocatable :: numbers(:)
         integer :: line, i

         allocate(list%features(max(2, features), n))
         list%features(1, :) = 0.0_wp
         list%features(2, :) = far
         if (features <= 1) return
         do i = 1, n
            call text%read_array(features + 1, "U_SLC S_F", numbers, error, line=line)
            if (allocated(error)) return
            if (abs(scale*(offset + numbers(1)) - list%slices(i)%u) > min_distance) then
               call fatal_error(error, "features are given for position " // real_text(numbers(1)) // "; expected slice " // &
                  & integer_text(i) // " at " // real_text(list%slices(i)%u/scale - offset), file=text%file, line=line)
               return
            end if
            list%features(:, i) = numbers(2:)
            call check_features(numbers(2:), i, line)
            if (allocated(error)) return
         end do
      end subroutine read_features

      !> Check that the features present are contiguous, at least two, and increasing
      subroutine check_features(s, slice, line)
         real(wp), intent(in) :: s(:)
         integer, intent(in) :: slice, line
         logical :: there(size(s))
         integer :: first, last
         character(len=:), allocatable :: complaint

         there = s > -min_feature
         first = findloc(there, .true., 1)
         last = findloc(there, .true., 1, back=.true.)
         complaint = ""
         if (count(there) < 2) then
            complaint = "has fewer than two features"
         else if (count(there) /= last - first + 1) then
            complaint = "lacks a feature between others"
         else if (any(s(first + 1:last) - s(first:last - 1) <= min_feature)) then
            complaint = "has features that do not increase"
         end if
         if (len(complaint) > 0) call fatal_error(error, "slice " // integer_text(slice) // " " // complaint // &
            & "; expected negative values only at the start and the end, between them increasing positions [mm]", &
            & file=text%file, line=line)
      end subroutine check_features
   end subroutine read_slices_file

   !> Check that angles are within one and a half turns, and exceed one turn at both ends or at neither
   subroutine check_angles(list, file, error)
      type(slices_list), intent(in) :: list
      character(len=*), intent(in) :: file
      type(error_type), allocatable, intent(inout) :: error
      real(wp), parameter :: tolerance = 1.0e-4_wp
      real(wp) :: low, high

      low = list%slices(1)%u
      high = list%slices(size(list%slices))%u
      if (low < -1.5_wp*pi .or. high > 1.5_wp*pi) then
         call fatal_error(error, "the slices reach from " // real_text(low) // " to " // real_text(high) // " rad; accepted are &
            &angles within 1.5 pi of zero (is the scale factor right?)", file=file)
      else if ((low < -pi - tolerance .and. high < pi - tolerance) .or. (high > pi + tolerance .and. low > -pi + tolerance)) then
         call fatal_error(error, "the slices reach from " // real_text(low) // " to " // real_text(high) // " rad; expected a &
            &range inside of -pi...pi, or one that holds it", file=file)
      end if
   end subroutine check_angles

   !> A file name relative to the folder of another file
   pure subroutine resolve_path(file, name, path)
      !> Path of the other file; name, absolute or relative to its folder
      character(len=*), intent(in) :: file, name
      !> Path of the named file
      character(len=:), allocatable, intent(out) :: path

      path = replaced(name, "\", "/")
      if (len(path) == 0) return
      if (path(1:1) == "/" .or. index(path, ":/") == 2) return
      path = file(:scan(file, "/\", back=.true.)) // path
   end subroutine resolve_path
end module contact_profile_slices_file
