!> What a case asks of a profile file, and what the file itself asks for
module contact_profile_request
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: profile_request, profile_file, profile_side, smoothing_method, same_request
   public :: doubt

   type :: profile_side_list
      integer :: rail = 1, wheel = 2
   end type profile_side_list
   !> Which of the two bodies a profile belongs to; the surface of a roller is a rail
   type(profile_side_list), parameter :: profile_side = profile_side_list()

   type :: smoothing_method_list
      !> Equal weights, curvature penalty, the parameter is its weight [mm3]
      integer :: ordinary = 0
      !> Weights by spacing, curvature penalty, the parameter is a wavelength [mm]
      integer :: weighted = 1
      !> Weights by spacing, penalty on the third derivative, the parameter is a wavelength [mm]
      integer :: b_spline = 2
   end type smoothing_method_list
   type(smoothing_method_list), parameter :: smoothing_method = smoothing_method_list()

   !> The profile line of an input file
   type :: profile_request
      !> Name of the file as it is to be opened
      character(len=:), allocatable :: file
      !> Folder below which the file must be, "" for the current one; unallocated: anywhere
      character(len=:), allocatable :: below
      !> Points in place of a file, y and z in the rows, shape (2, n); unallocated: the file is read
      real(wp), allocatable :: points(:, :)
      !> Member of profile_side
      integer :: side = profile_side%rail
      !> Mirror the lateral coordinate: 1 yes, 0 as the file says, -1 no
      integer :: mirror_y = 0
      !> Mirror the vertical coordinate: 1 yes, 0 automatic (Simpack: as the file says), -1 no
      integer :: mirror_z = 0
      !> Factor to millimetres
      real(wp) :: scale = 1.0_wp
      !> Member of smoothing_method and its parameter, 0 for interpolation
      integer :: method = smoothing_method%ordinary
      real(wp) :: smooth = 0.0_wp
      !> Turning angle [rad] that makes a zig-zag
      real(wp) :: zig_zag = 5.0_wp*pi/6.0_wp
      !> Turning angles [rad] of a kink and of what may not be near one, within this distance [mm]
      real(wp) :: kink_high = pi/6.0_wp, kink_low = pi/30.0_wp, kink_width = 2.0_wp
      !> Largest part of the length that may be hidden behind the rest, 0...1
      real(wp) :: max_hidden = 0.5_wp
      !> Member of doubt
      integer :: doubt = 0
   end type profile_request

   type :: doubt_enum
      !> Carry on in spite of more hidden points than allowed, without a word
      integer :: ignore = -2
      !> No warnings
      integer :: silent = -1
      !> Warnings
      integer :: warn = 0
      !> What would be a warning is an error
      integer :: refuse = 1
   end type doubt_enum
   !> What to do about a profile that is not as it should be
   type(doubt_enum), parameter :: doubt = doubt_enum()

   !> Points of a file with the processing that the file itself prescribes, in its own units
   type :: profile_file
      !> Lateral and vertical coordinates
      real(wp), allocatable :: y(:), z(:)
      !> Line of each point in the file; unallocated for points that a caller gives
      integer, allocatable :: line(:)
      !> Points nearer than this to the one before are dropped
      real(wp) :: nearest = 1.0e-4_wp
      !> Added to the coordinates
      real(wp) :: shift_y = 0.0_wp, shift_z = 0.0_wp
      !> Rotation about x [rad] behind the shift, from y towards z as the file has them
      real(wp) :: rotation = 0.0_wp
      !> Points outside of these bounds are dropped (y) or moved to them (z); none when lower is not
      !> below upper
      real(wp) :: lower_y = 1.0_wp, upper_y = 0.0_wp, lower_z = 1.0_wp, upper_z = 0.0_wp
      logical :: mirror_y = .false., mirror_z = .false.
      !> May the vertical direction be found from the shape?
      logical :: guess_z = .true.
      !> 1 reverse the order, 0 keep it, -1 find it from the shape
      integer :: inversion = -1
      !> Units of the file per millimetre
      real(wp) :: units_per_mm = 1.0_wp
      !> Unit of length that the file names though it does not say how it is to be used; unallocated: none, or mm
      character(len=:), allocatable :: unit_name
      !> Line where it does
      integer :: unit_line = 0
   end type profile_file

contains

   !> Would both give the same profile?
   pure logical function same_request(a, b) result(same)
      !> Two requests, compared in all that a result depends on
      type(profile_request), intent(in) :: a, b

      same = allocated(a%file) .and. allocated(b%file)
      if (.not. same) return
      same = allocated(a%points) .eqv. allocated(b%points)
      if (.not. same) return
      same = a%file == b%file .and. len(a%file) == len(b%file) .and. a%side == b%side .and. a%mirror_y == b%mirror_y &
         & .and. a%mirror_z == b%mirror_z .and. a%scale == b%scale .and. a%method == b%method .and. a%smooth == b%smooth &
         & .and. a%zig_zag == b%zig_zag .and. a%kink_high == b%kink_high .and. a%kink_low == b%kink_low &
         & .and. a%kink_width == b%kink_width .and. a%max_hidden == b%max_hidden .and. a%doubt == b%doubt
   end function same_request
end module contact_profile_request
