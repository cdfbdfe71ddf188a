!> Specification of a case of module 1, except materials, friction and solvers: wheel, rail and track
!>
!> Values of the input, in internal units, with the signs of the input: nothing is mirrored here. Right-handed systems with x along
!> the track, y to the right and z down.
module contact_wheelrail_spec
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: pair_spec, wheel_rail_spec, profile_spec, search_spec, track_spec, rail_spec, wheelset_spec

   !> A profile file and the options for reading it
   type :: profile_spec
      !> Name in the input; unallocated if no profile has been given
      character(len=:), allocatable :: name
      !> Points given by a caller instead of a file, y and z in the rows [mm], shape (2, n); unallocated: a file
      real(wp), allocatable :: points(:, :)
      !> Line and column of the name in the input file, for messages
      integer :: line = 0, column = 0
      !> Mirror in y: yes (1) or no (0, -1); in z: yes (1), no (-1), or determined by the file (0)
      integer :: mirror_y = 0, mirror_z = 0
      !> Factor from lengths in the file to mm
      real(wp) :: scale = 1.0_wp
      !> Smoothing method 0, 1, 2 and its parameter: weight [mm3] (0) or wavelength [mm] (1, 2)
      integer :: smoothing_method = 0
      real(wp) :: smoothing = 0.0_wp
      !> Angles that define a zig-zag and a kink [rad], and distance [mm] within which a kink must be the only one
      real(wp) :: zigzag = 150.0_wp*pi/180.0_wp
      real(wp) :: kink_high = 30.0_wp*pi/180.0_wp, kink_low = 6.0_wp*pi/180.0_wp, kink_width = 2.0_wp
      !> Maximum fraction of the points that may be omitted because they are hidden [-]; error handling level
      real(wp) :: largest_omission = 0.5_wp
      integer :: error_handling = 0
   end type profile_spec

   !> Contact search and discretisation (D)
   type :: search_spec
      !> Type of contact reference, member of contact_location
      integer :: location = 2
      !> Sides of the elements along x and along the profile [mm]; distance travelled per step, in elements [-]
      real(wp) :: dx = 0.5_wp, ds = 0.5_wp, dqrel = 1.0_wp
      !> Angle [rad] and distances [mm] for separating, combining and rotating patches
      real(wp) :: a_sep = pi, d_sep = 8.0_wp, d_comb = 4.0_wp, d_turn = 12.0_wp
      !> Maximum gap of near misses that extend a patch [mm]; negative: none
      real(wp) :: g_miss = -1.0_wp
      !> Weights of the contact reference: 0 default, 1 interpenetration, 2 square of the interpenetration
      integer :: gap_weight = 0
      !> Is the contact angle on a rail that varies taken from the section below the axle, as in the established program? Otherwise
      !> from the section at the contact. Not part of the input file
      logical :: angle_below_axle = .true.
   end type search_spec

   !> Track or roller rig, and position of the rail in it (Z)
   type :: track_spec
      !> Height of the gauge point [mm]; not positive: absolute placement of the rail
      real(wp) :: gaught = 14.0_wp
      !> Gauge width [mm]; position of the rail marker [mm]
      real(wp) :: gaugwd = 1435.0_wp, raily0 = 0.0_wp, railz0 = 0.0_wp
      !> Cant of the rail [rad]; curvature of the track [1/mm], positive to the right
      real(wp) :: cant = 0.0_wp, curvature = 0.0_wp
      !> Nominal radius of the roller [mm]
      real(wp) :: nomradr = 460.0_wp
   end type track_spec

   !> Deviations of the rail from its design position, their rates, and its springs (Z, F = 3)
   type :: rail_spec
      !> Lateral and vertical deviation [mm], roll [rad], and their rates [mm/s], [rad/s]
      real(wp) :: dy = 0.0_wp, dz = 0.0_wp, roll = 0.0_wp
      real(wp) :: vy = 0.0_wp, vz = 0.0_wp, vroll = 0.0_wp
      !> Massless rail: stiffness [N/mm] and static force [N], in lateral and vertical direction
      real(wp) :: ky = 1000.0_wp, fy = 0.0_wp, kz = 1000.0_wp, fz = 0.0_wp
      !> First trial step of the lateral deflection [mm]
      real(wp) :: first_step = 1.0_wp
   end type rail_spec

   !> Wheelset: dimensions, position, velocity, flexible deviations (E)
   type :: wheelset_spec
      !> Flange-back distance, position of the flange back in the profile, nominal radius [mm]
      real(wp) :: fbdist = 1360.0_wp, fbpos = -70.0_wp, nomradw = 460.0_wp
      !> Lateral position of the tape line in the profile, where the nominal radius holds [mm]; 999 or more: profile origin
      real(wp) :: ytape = 1000.0_wp
      !> Position along the track, or x on rollers [mm]; lateral and vertical position [mm]
      real(wp) :: s = 0.0_wp, x = 0.0_wp, y = 0.0_wp, z = 0.0_wp
      !> Prescribed vertical force on the rail [N]
      real(wp) :: fz = 0.0_wp
      !> Roll, yaw and pitch angle [rad]
      real(wp) :: roll = 0.0_wp, yaw = 0.0_wp, pitch = 0.0_wp
      !> Forward velocity [mm/s] and rates [mm/s], [rad/s]; on rollers vs is the pitch rate of the roller; in shifts all of these
      !> are displacements and rotations
      real(wp) :: vs = 0.0_wp, vy = 0.0_wp, vz = 0.0_wp, vroll = 0.0_wp, vyaw = 0.0_wp, vpitch = 0.0_wp
      !> Pitch rate of the roller [rad/s]
      real(wp) :: rpitch = 0.0_wp
      !> Prescribed longitudinal force in wheelset axes [N], instead of the pitch rate
      real(wp) :: fx = 0.0_wp
      !> Flexible deviations of the wheel x, y, z [mm], roll, yaw, pitch [rad], and their rates
      real(wp) :: flexible(6) = 0.0_wp, flexible_rate(6) = 0.0_wp
   contains
      procedure :: pitch_of_wheel
      procedure :: has_tape
   end type wheelset_spec

   !> One wheel on one rail or roller, but for the files of their profiles
   type :: pair_spec
      !> Left side of the track? Roller rig?
      logical :: left = .false., roller = .false.
      !> Is the position determined by the vertical force? Member of normal_control
      integer :: position_control = 0
      type(search_spec) :: search
      type(track_spec) :: track
      type(rail_spec) :: rail
      type(wheelset_spec) :: wheelset
   end type pair_spec

   !> The same with the profiles
   type, extends(pair_spec) :: wheel_rail_spec
      !> Has the case new profiles, and new dimensions of the track?
      logical :: new_rail_profile = .false., new_wheel_profile = .false., new_track = .false.
      type(profile_spec) :: rail_profile, wheel_profile
   end type wheel_rail_spec
contains

   !> Rotation of the wheel about its axle [rad]: pitch of the wheelset and flexible deviation; selects the slice at the bottom
   pure real(wp) function pitch_of_wheel(self)
      class(wheelset_spec), intent(in) :: self

      pitch_of_wheel = self%pitch + self%flexible(6)
   end function pitch_of_wheel

   !> Is the nominal radius given at a tape line?
   pure logical function has_tape(self)
      class(wheelset_spec), intent(in) :: self
      !> Magnitude of YTAPE from which there is none [mm]
      real(wp), parameter :: no_tape = 999.0_wp

      has_tape = abs(self%ytape) < no_tape
   end function has_tape
end module contact_wheelrail_spec
