!> What a case of module 1 asks for beyond materials, friction and solvers: wheel, rail and track
!>
!> Numbers as the input gives them, in internal units, with the signs of the input: nothing is
!> mirrored here. Right-hand systems with x along the track, y to the right and z downwards.
module contact_wheelrail_spec
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: wheel_rail_spec, profile_spec, search_spec, track_spec, rail_spec, wheelset_spec

   !> A profile file and how it is to be read
   type :: profile_spec
      !> Name as the input gives it; unallocated when no profile was given yet
      character(len=:), allocatable :: name
      !> Points that a caller gives in place of a file, y and z in the rows, shape (2, n); unallocated: a file
      real(wp), allocatable :: points(:, :)
      !> Line and column of the name in the input file, for messages
      integer :: line = 0, column = 0
      !> Mirror in y: yes (1) or no (0, -1); in z: yes (1), no (-1), or as the file suggests (0)
      integer :: mirror_y = 0, mirror_z = 0
      !> Factor from the lengths of the file to mm
      real(wp) :: scale = 1.0_wp
      !> Smoothing method 0, 1, 2 and its parameter: weight [mm3] (0) or wavelength [mm] (1, 2)
      integer :: smoothing_method = 0
      real(wp) :: smoothing = 0.0_wp
      !> Angles that make a zig-zag and a kink [rad], and the distance [mm] within which a kink is alone
      real(wp) :: zigzag = 150.0_wp*pi/180.0_wp
      real(wp) :: kink_high = 30.0_wp*pi/180.0_wp, kink_low = 6.0_wp*pi/180.0_wp, kink_width = 2.0_wp
      !> Largest part of the points that may be left out because it cannot be seen [-]; error handling level
      real(wp) :: largest_omission = 0.5_wp
      integer :: error_handling = 0
   end type profile_spec

   !> Contact search and discretisation (D)
   type :: search_spec
      !> Member of contact_location
      integer :: location = 2
      !> Sides of the elements along x and along the profile [mm]; step per case in elements [-]
      real(wp) :: dx = 0.5_wp, ds = 0.5_wp, dqrel = 1.0_wp
      !> Angle [rad] and distances [mm] of separating, combining and turning patches
      real(wp) :: a_sep = pi, d_sep = 8.0_wp, d_comb = 4.0_wp, d_turn = 12.0_wp
      !> Gap below which near misses enlarge a patch [mm]; negative: never
      real(wp) :: g_miss = -1.0_wp
      !> Weights of the contact reference: 0 the default, 1 the interpenetration, 2 its square
      integer :: gap_weight = 0
      !> Contact angle on a rail that varies: of the section below the axle, as the established program takes it, instead of the
      !> section at the contact? Not part of the input file
      logical :: angle_below_axle = .true.
   end type search_spec

   !> Track or roller rig, and the place of the rail in it (Z)
   type :: track_spec
      !> Height of the gauge point [mm]; not positive: absolute placement of the rail
      real(wp) :: gaught = 14.0_wp
      !> Gauge width [mm]; place of the rail marker [mm]
      real(wp) :: gaugwd = 1435.0_wp, raily0 = 0.0_wp, railz0 = 0.0_wp
      !> Cant of the rail [rad]; curvature of the track [1/mm], positive to the right
      real(wp) :: cant = 0.0_wp, curvature = 0.0_wp
      !> Nominal radius of the roller [mm]
      real(wp) :: nomradr = 460.0_wp
   end type track_spec

   !> Deviations of the rail from its design place, their rates, and its springs (Z, F = 3)
   type :: rail_spec
      !> Lateral and vertical deviation [mm], roll [rad], and their rates [mm/s], [rad/s]
      real(wp) :: dy = 0.0_wp, dz = 0.0_wp, roll = 0.0_wp
      real(wp) :: vy = 0.0_wp, vz = 0.0_wp, vroll = 0.0_wp
      !> Massless rail: stiffness [N/mm] and static force [N], lateral and vertical
      real(wp) :: ky = 1000.0_wp, fy = 0.0_wp, kz = 1000.0_wp, fz = 0.0_wp
      !> First trial step of the lateral deflection [mm]
      real(wp) :: first_step = 1.0_wp
   end type rail_spec

   !> Wheelset: dimensions, position, velocity, flexible deviations (E)
   type :: wheelset_spec
      !> Flange-back distance, its place in the profile, nominal radius [mm]
      real(wp) :: fbdist = 1360.0_wp, fbpos = -70.0_wp, nomradw = 460.0_wp
      !> Place in the profile where the nominal radius holds [mm]; at least 999: profile origin
      real(wp) :: ytape = 1000.0_wp
      !> Position along the track, or x on rollers [mm]; lateral and vertical position [mm]
      real(wp) :: s = 0.0_wp, x = 0.0_wp, y = 0.0_wp, z = 0.0_wp
      !> Vertical force on the rail [N] when it is prescribed
      real(wp) :: fz = 0.0_wp
      !> Roll, yaw and pitch angle [rad]
      real(wp) :: roll = 0.0_wp, yaw = 0.0_wp, pitch = 0.0_wp
      !> Forward speed [mm/s] and rates [mm/s], [rad/s]; on rollers vs is the pitch rate of the roller;
      !> in shifts all of these are displacements and rotations
      real(wp) :: vs = 0.0_wp, vy = 0.0_wp, vz = 0.0_wp, vroll = 0.0_wp, vyaw = 0.0_wp, vpitch = 0.0_wp
      !> Pitch rate of the roller [rad/s]
      real(wp) :: rpitch = 0.0_wp
      !> Longitudinal force in wheelset axes [N] when prescribed in place of the pitch rate
      real(wp) :: fx = 0.0_wp
      !> Flexible deviations of the wheel x, y, z [mm], roll, yaw, pitch [rad], and their rates
      real(wp) :: flexible(6) = 0.0_wp, flexible_rate(6) = 0.0_wp
   end type wheelset_spec

   !> One wheel on one rail or roller
   type :: wheel_rail_spec
      !> Left side of the track? Roller rig?
      logical :: left = .false., roller = .false.
      !> Was a position given in terms of the vertical force? Member of normal_control
      integer :: position_control = 0
      !> Has the case new profiles?
      logical :: new_rail_profile = .false., new_wheel_profile = .false.
      type(search_spec) :: search
      type(track_spec) :: track
      type(rail_spec) :: rail
      type(wheelset_spec) :: wheelset
      type(profile_spec) :: rail_profile, wheel_profile
   end type wheel_rail_spec
end module contact_wheelrail_spec
