!> Result of the solution for one wheel on one rail
!>
!> All quantities refer to a right-hand pair: for a wheel on the left side of the track this is the mirror image, which output
!> mirrors back. Track coordinates: x along the track, y to the right, z down.
module contact_wheelrail_result
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_accuracy_report, only : accuracy_report
   use contact_base_case_status, only : case_status
   use contact_base_kinds, only : wp
   use contact_friction_law, only : friction_set
   use contact_base_choices, only : motion
   use contact_patch_quantities, only : error_law, error_scale, orientation, total_list
   use contact_patch_result, only : patch_result
   use contact_wheelrail_spec, only : pair_spec
   implicit none (type, external)
   private

   public :: buried_end, wheel_rail_result, wheel_rail_patch, profile_points, in_element_coordinates, moment_about_elements

   !> One contact patch of wheel and rail
   type :: wheel_rail_patch
      !> Contact reference in track coordinates [mm], contact angle [rad]
      real(wp) :: x = 0.0_wp, y = 0.0_wp, z = 0.0_wp, delta = 0.0_wp
      !> Contact reference in the rail profile's coordinates [mm], contact angle relative to the rail [rad]
      real(wp) :: y_rail = 0.0_wp, z_rail = 0.0_wp, delta_rail = 0.0_wp
      !> Contact reference in the wheel profile's coordinates [mm]
      real(wp) :: x_wheel = 0.0_wp, y_wheel = 0.0_wp, z_wheel = 0.0_wp
      !> Contact reference in the coordinates of the elements of a transient case, which are fixed to the rail [mm]; 0 if the
      !> reference is the origin of the elements
      real(wp) :: grid_reference(2) = 0.0_wp
      !> Patches of the previous case that this one continues; empty for a new patch
      integer, allocatable :: previous(:)
      !> Curved reference of conformal contact: y, z [mm] and angle [rad] per grid row in track coordinates, shape (3, my);
      !> unallocated for flat contact
      real(wp), allocatable :: curve(:, :)
      !> Sum of the normal tractions of conformal contact, each in the axes of its row [N]
      real(wp) :: tilde_fn = 0.0_wp
      !> Parameters of friction in this patch, one set or one per row, if friction varies over the rail; otherwise unallocated
      type(friction_set), allocatable :: friction(:)
      !> Does friction vary within the patch?
      logical :: friction_varies = .false.
      !> Forces on the rail in the axes x, s, n of the reference [N]: those of `contact` for flat patches, transformed row by row
      !> for conformal ones
      real(wp) :: force(3) = 0.0_wp
      !> Moment about the reference in the same axes [N mm]
      real(wp) :: moment(3) = 0.0_wp
      !> Tractions, slip and totals in the axes of the patch
      type(patch_result) :: contact
   contains
      !> All totals of the patch, for outputs
      procedure :: totals => patch_totals
   end type wheel_rail_patch

   !> Points of a profile in track coordinates
   type :: profile_points
      !> Arc length and x, y, z [mm], each of shape (n)
      real(wp), allocatable :: s(:), x(:), y(:), z(:)
   end type profile_points

   !> Overlap of the bodies outside all patches: an end of the wheel's profile, or another position along the track
   type :: buried_end
      !> Depth below the surface of the rail [mm]; 0: none
      real(wp) :: depth = 0.0_wp
      !> Position of the maximum depth, in track coordinates [mm]
      real(wp) :: place(3) = 0.0_wp
      !> Is it outside the range of the contact search along the track?
      logical :: beyond_reach = .false.
   end type buried_end

   !> Result of wheel and rail
   type :: wheel_rail_result
      !> Status of the case: its patches, and the searches for prescribed forces
      type(case_status) :: status
      !> Combined modulus of rigidity [N/mm2], Poisson ratio [-], difference parameter [-]
      real(wp) :: gg = 1.0_wp, nu = 0.0_wp, ak = 0.0_wp
      !> Height of the wheelset [mm] and pitch rate [rad/s], prescribed or found
      real(wp) :: z_ws = 0.0_wp, vpitch = 0.0_wp
      !> Deflection of a massless rail [mm]
      real(wp) :: dy_defl = 0.0_wp, dz_defl = 0.0_wp
      !> Smallest vertical gap [mm]; negative: penetration
      real(wp) :: smallest_gap = 0.0_wp
      !> Total force on the rail [N], in track and wheelset axes
      real(wp) :: force_track(3) = 0.0_wp, force_wheelset(3) = 0.0_wp
      !> Total moment on the rail [N mm], about the rail marker in track axes, and about the wheel marker in wheelset axes
      real(wp) :: moment_rail(3) = 0.0_wp, moment_wheel(3) = 0.0_wp
      !> Rail marker in the track: y, z [mm], roll [rad]
      real(wp) :: rail_y = 0.0_wp, rail_z = 0.0_wp, rail_roll = 0.0_wp
      !> Wheel marker in the track: x, y, z [mm], roll, yaw [rad]; lateral position of the wheel profile in the wheelset [mm]
      real(wp) :: wheel_x = 0.0_wp, wheel_y = 0.0_wp, wheel_z = 0.0_wp, wheel_roll = 0.0_wp, wheel_yaw = 0.0_wp
      real(wp) :: wheel_offset = 0.0_wp
      !> Contact patches, field side first; size zero without contact
      type(wheel_rail_patch), allocatable :: patches(:)
      !> Ends of the wheel's profile within the rail, which carry no load in this model: at the lower and the higher y
      type(buried_end) :: buried(2)
      !> Overlap at another position along the track, at a lateral position with contact: omitted by a search that keeps one
      !> position per lateral position
      type(buried_end) :: beside
      !> Profiles as used; set if the output level requests them
      type(profile_points) :: rail_profile, wheel_profile
      !> Number of evaluations of the total force, and its deviation from the prescribed one [N]
      integer :: force_evaluations = 0
      !> Maximum number of trials in one search for the vertical force in this case
      integer :: max_trials = 0
      real(wp) :: force_error = 0.0_wp
      !> Estimated error of each row of `totals` in its unit, NaN without estimate; unallocated if not requested
      real(wp), allocatable :: errors(:)
      !> Report on the requested accuracy; unallocated if none was requested
      type(accuracy_report), allocatable :: accuracy
   contains
      !> All totals, for outputs
      procedure :: totals => wheel_rail_totals
      !> Positions of rail and wheel, for outputs
      procedure :: markers
      !> Are all totals, and those of the patches, finite?
      procedure :: has_finite_totals
   end type wheel_rail_result

contains

   !> Total forces of the wheel on the rail, and positions that were found, in the order in which they are written
   pure subroutine wheel_rail_totals(self, pair, list)
      class(wheel_rail_result), intent(in) :: self
      !> For the side of the track and the position of the wheelset, which is that of its side
      class(pair_spec), intent(in) :: pair
      !> Emptied, then filled with the rows of wheel and rail
      type(total_list), intent(inout) :: list

      call list%start(pair%left)
      call list%add_friction("fx_tr", "N", "force on the rail along the track", self%force_track(1), orientation%along, &
         & error_scale%force)
      call list%add_friction("fy_tr", "N", "lateral force on the rail in track coordinates", self%force_track(2), &
         & orientation%across, error_scale%force)
      call list%add_friction("fz_tr", "N", "vertical force on the rail in track coordinates", self%force_track(3), &
         & orientation%along, error_scale%force)
      call list%add_friction("fx_ws", "N", "longitudinal force on the rail in wheelset coordinates", self%force_wheelset(1), &
         & orientation%along, error_scale%force)
      call list%add_friction("fy_ws", "N", "lateral force on the rail in wheelset coordinates", self%force_wheelset(2), &
         & orientation%across, error_scale%force)
      call list%add_friction("fz_ws", "N", "vertical force on the rail in wheelset coordinates", self%force_wheelset(3), &
         & orientation%along, error_scale%force)
      ! moments are axial vectors: mirroring changes the sign of their x and z components
      call list%add_friction("mx_r_tr", "N mm", "roll moment about the rail marker, track axes", self%moment_rail(1), &
         & orientation%across, error_scale%moment)
      call list%add_friction("my_r_tr", "N mm", "pitch moment about the rail marker, track axes", self%moment_rail(2), &
         & orientation%along, error_scale%moment)
      call list%add_friction("mz_r_tr", "N mm", "yaw moment about the rail marker, track axes", self%moment_rail(3), &
         & orientation%across, error_scale%moment)
      call list%add_friction("mx_w_ws", "N mm", "roll moment about the wheel marker, wheelset axes", self%moment_wheel(1), &
         & orientation%across, error_scale%moment)
      call list%add_friction("my_w_ws", "N mm", "pitch moment about the wheel marker, wheelset axes", self%moment_wheel(2), &
         & orientation%along, error_scale%moment)
      call list%add_friction("mz_w_ws", "N mm", "yaw moment about the wheel marker, wheelset axes", self%moment_wheel(3), &
         & orientation%across, error_scale%moment)
      call list%add("s_ws", "mm", "position of the wheelset along the track", pair%wheelset%s)
      call list%add("y_ws", "mm", "lateral position of the wheelset", pair%wheelset%y)
      call list%add("z_ws", "mm", "height of the wheelset, prescribed or computed", self%z_ws, law=error_law%normal)
      call list%add("roll_ws", "rad", "roll angle of the wheelset", pair%wheelset%roll)
      call list%add("yaw_ws", "rad", "yaw angle of the wheelset", pair%wheelset%yaw)
      call list%add("vpitch_ws", "rad/s", "pitch rate of the wheelset, prescribed or computed", self%vpitch, law=error_law%creepage)
      call list%add("dy_defl", "mm", "lateral deflection of the rail", self%dy_defl, orientation%side)
      call list%add("dz_defl", "mm", "vertical deflection of the rail", self%dz_defl)
      call list%add("smallest_gap", "mm", "smallest vertical gap, negative: overlap", self%smallest_gap)
      call list%count("force_trials", "heights tried in a search for the vertical force, at most", self%max_trials)
   end subroutine wheel_rail_totals

   !> Positions of rail and wheel, in track coordinates
   pure subroutine markers(self, left, list)
      class(wheel_rail_result), intent(in) :: self
      !> Is this a wheel on the left side of the track?
      logical, intent(in) :: left
      !> List to fill with the rows of both markers; previous rows are removed
      type(total_list), intent(inout) :: list

      call list%start(left)
      call list%add("y_r", "mm", "rail marker, lateral", self%rail_y, orientation%side)
      call list%add("z_r", "mm", "rail marker, vertical", self%rail_z)
      call list%add("roll_r", "rad", "roll angle of the rail", self%rail_roll, orientation%side)
      call list%add("x_w", "mm", "wheel marker, longitudinal", self%wheel_x)
      call list%add("y_w", "mm", "wheel marker, lateral", self%wheel_y, orientation%side)
      call list%add("z_w", "mm", "wheel marker, vertical", self%wheel_z)
      call list%add("roll_w", "rad", "roll angle of the wheel", self%wheel_roll, orientation%side)
      call list%add("yaw_w", "rad", "yaw angle of the wheel", self%wheel_yaw, orientation%side)
      call list%add("ynom_whl", "mm", "origin of the profile from the middle of the wheelset, outwards", self%wheel_offset)
   end subroutine markers

   !> All totals of a patch: those of the contact, and the position of its reference
   pure subroutine patch_totals(self, list, left)
      class(wheel_rail_patch), intent(in) :: self
      !> List to fill with the rows of the patch; previous rows are removed
      type(total_list), intent(inout) :: list
      !> Is this a wheel on the left side of the track?
      logical, intent(in) :: left

      call self%contact%totals(list, left)
      call list%add("xcp_tr", "mm", "contact reference along the track", self%x)
      call list%add("ycp_tr", "mm", "contact reference, lateral, track coordinates", self%y, orientation%side)
      call list%add("zcp_tr", "mm", "contact reference, vertical, track coordinates", self%z)
      call list%add("deltcp_tr", "rad", "contact angle in track coordinates", self%delta, orientation%side)
      call list%add("ycp_r", "mm", "contact reference, lateral, rail profile", self%y_rail, orientation%side)
      call list%add("zcp_r", "mm", "contact reference, vertical, rail profile", self%z_rail)
      call list%add("deltcp_r", "rad", "contact angle in the rail profile", self%delta_rail, orientation%side)
      call list%add("xcp_w", "mm", "contact reference, longitudinal, wheel profile", self%x_wheel)
      call list%add("ycp_w", "mm", "contact reference, lateral, wheel profile", self%y_wheel, orientation%side)
      call list%add("zcp_w", "mm", "contact reference, vertical, wheel profile", self%z_wheel)
      call list%add("x_elem", "mm", "contact reference in the coordinates of the elements", self%grid_reference(1), &
         & in_files=.false.)
      call list%add("y_elem", "mm", "contact reference in the coordinates of the elements", self%grid_reference(2), &
         & orientation%side, in_files=.false.)
      ! successive time steps have common elements, but not a common contact reference
      if (self%contact%motion == motion%shift .or. self%contact%motion == motion%transient_rolling) &
         & call list%add("mz_elem", "N mm", "moment about the normal through the origin of the elements, MN of the .out file", &
         & moment_about_elements(self, self%contact%fx, self%contact%fy, self%contact%mz), orientation%across)
      if (.not. allocated(self%curve)) return
      ! with a curved reference FN, FX and FY are sums of tractions with different axes
      call list%add("bar_fn", "N", "normal force of a curved patch, axes of the contact reference", self%force(3))
      call list%add("bar_fx", "N", "longitudinal force of a curved patch, axes of the contact reference", self%force(1), &
         & orientation%along)
      call list%add("bar_fs", "N", "lateral force of a curved patch, axes of the contact reference", self%force(2), &
         & orientation%across)
      call list%add("bar_mn", "N mm", "moment of a curved patch about the normal of the contact reference", self%moment(3), &
         & orientation%across)
   end subroutine patch_totals

   pure logical function has_finite_totals(self) result(finite)
      class(wheel_rail_result), intent(in) :: self
      integer :: k

      finite = all(ieee_is_finite([self%z_ws, self%vpitch, self%dy_defl, self%dz_defl, self%force_track, self%force_wheelset, &
         & self%moment_rail, self%moment_wheel]))
      if (.not. (finite .and. allocated(self%patches))) return
      do k = 1, size(self%patches)
         finite = finite .and. self%patches(k)%contact%has_finite_totals()
      end do
   end function has_finite_totals

   !> Solution of a patch with the origin of its elements as reference, which differs from the contact reference in transient cases
   pure function in_element_coordinates(patch) result(contact)
      !> Patch whose grid refers to the origin of its elements
      type(wheel_rail_patch), intent(in) :: patch
      type(patch_result) :: contact

      contact = patch%contact
      associate (x => patch%grid_reference(1), s => patch%grid_reference(2))
         contact%grid%xl = contact%grid%xl + x
         contact%grid%yl = contact%grid%yl + s
      end associate
   end function in_element_coordinates

   !> Moment about the normal through the origin of the elements, from that about the contact reference [N mm]
   pure real(wp) function moment_about_elements(patch, fx, fy, mz) result(moment)
      !> Patch with the position of its reference in element coordinates
      type(wheel_rail_patch), intent(in) :: patch
      !> Tangential forces [N] and moment about the contact reference [N mm]
      real(wp), intent(in) :: fx, fy, mz

      moment = mz + patch%grid_reference(1)*fy - patch%grid_reference(2)*fx
   end function moment_about_elements
end module contact_wheelrail_result
