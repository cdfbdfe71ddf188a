!> Request for a profile by a case, and settings contained in the file itself
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
   !> The body to which a profile belongs; the surface of a roller is a rail
   type(profile_side_list), parameter :: profile_side = profile_side_list()

   type :: smoothing_method_list
      !> Equal weights, penalty on the curvature; the parameter is its weight [mm3]
      integer :: ordinary = 0
      !> Weights by spacing, penalty on the curvature; the parameter is a wavelength [mm]
      integer :: weighted = 1
      !> Weights by spacing, penalty on the third derivative; the parameter is a wavelength [mm]
      integer :: b_spline = 2
   end type smoothing_method_list
   type(smoothing_method_list), parameter :: smoothing_method = smoothing_method_list()

   !> Request for a profile, as given in an input file
   type :: profile_request
      !> Path of the file
      character(len=:), allocatable :: file
      !> Folder below which the file must be, "" for the current one; unallocated: anywhere
      character(len=:), allocatable :: below
      !> Points that replace a file, rows y and z, shape (2, n); unallocated: the file is read
      real(wp), allocatable :: points(:, :)
      !> Member of profile_side
      integer :: side = profile_side%rail
      !> Mirror the lateral coordinate: 1 yes, 0 as given by the file, -1 no
      integer :: mirror_y = 0
      !> Mirror the vertical coordinate: 1 yes, 0 automatic (Simpack: as given by the file), -1 no
      integer :: mirror_z = 0
      !> Factor to millimetres
      real(wp) :: scale = 1.0_wp
      !> Member of smoothing_method, and its parameter; 0: interpolation
      integer :: method = smoothing_method%ordinary
      real(wp) :: smooth = 0.0_wp
      !> Turning angle [rad] of a zig-zag
      real(wp) :: zig_zag = 5.0_wp*pi/6.0_wp
      !> Minimum turning angle of a kink and maximum one nearby [rad], and range of "nearby" [mm]
      real(wp) :: kink_high = pi/6.0_wp, kink_low = pi/30.0_wp, kink_width = 2.0_wp
      !> Maximum hidden fraction of the arc length, 0...1
      real(wp) :: max_hidden = 0.5_wp
      !> Member of doubt
      integer :: doubt = 0
   end type profile_request

   type :: doubt_enum
      !> Accept more hidden points than allowed, without a message
      integer :: ignore = -2
      !> No warnings
      integer :: silent = -1
      !> Warnings
      integer :: warn = 0
      !> Warnings are errors
      integer :: refuse = 1
   end type doubt_enum
   !> Treatment of implausible profiles
   type(doubt_enum), parameter :: doubt = doubt_enum()

   !> Points of a file in its own units, with the processing that the file prescribes
   type :: profile_file
      !> Lateral and vertical coordinates
      real(wp), allocatable :: y(:), z(:)
      !> Line of each point in the file; unallocated for points given by a caller
      integer, allocatable :: line(:)
      !> Points closer than this to the previous one are dropped
      real(wp) :: nearest = 1.0e-4_wp
      !> Offsets added to the coordinates
      real(wp) :: shift_y = 0.0_wp, shift_z = 0.0_wp
      !> Rotation about x [rad] after the shift, from y towards z in the axes of the file
      real(wp) :: rotation = 0.0_wp
      !> Points outside these bounds are dropped (y) or moved to them (z); no bounds if lower exceeds upper
      real(wp) :: lower_y = 1.0_wp, upper_y = 0.0_wp, lower_z = 1.0_wp, upper_z = 0.0_wp
      logical :: mirror_y = .false., mirror_z = .false.
      !> May the vertical direction be determined from the shape?
      logical :: guess_z = .true.
      !> 1: reverse the order, 0: keep it, -1: determine it from the shape
      integer :: inversion = -1
      !> Number of units of the file per millimetre
      real(wp) :: units_per_mm = 1.0_wp
      !> Unit of length named by the file without a conversion; unallocated: none, or mm
      character(len=:), allocatable :: unit_name
      !> Line of the unit
      integer :: unit_line = 0
   end type profile_file

contains

   !> Do two requests give the same profile?
   pure logical function same_request(a, b) result(same)
      !> Two requests, compared in everything that affects the result
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
