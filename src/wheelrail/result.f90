!> What is known of one wheel on one rail after the solution
!>
!> Right-hand pair throughout: for a wheel on the left side of the track this is the mirror
!> image, and output mirrors it back. Track coordinates: x along the track, y to the right, z down.
module contact_wheelrail_result
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_case_status, only : case_status
   use contact_base_kinds, only : wp
   use contact_friction_law, only : friction_parameters
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: buried_end, wheel_rail_result, wheel_rail_patch, profile_points, in_element_coordinates, mirrored, &
      & moment_about_elements

   !> One contact patch of the pair
   type :: wheel_rail_patch
      !> Contact reference in track coordinates [mm], contact angle [rad]
      real(wp) :: x = 0.0_wp, y = 0.0_wp, z = 0.0_wp, delta = 0.0_wp
      !> The same in the rail profile's coordinates [mm], angle relative to the rail [rad]
      real(wp) :: y_rail = 0.0_wp, z_rail = 0.0_wp, delta_rail = 0.0_wp
      !> The same in the wheel profile's coordinates [mm]
      real(wp) :: x_wheel = 0.0_wp, y_wheel = 0.0_wp, z_wheel = 0.0_wp
      !> Contact reference in the coordinates of the elements of a transient case, which stand on the rail [mm]; 0
      !> where the reference is the origin of the elements
      real(wp) :: grid_reference(2) = 0.0_wp
      !> Patches of the previous case from which this one continues; empty for a new one
      integer, allocatable :: previous(:)
      !> Curved reference of conformal contact: y, z [mm] and angle [rad] per grid row in track coordinates,
      !> shape (3, my); unallocated for flat contact
      real(wp), allocatable :: curve(:, :)
      !> Sum of the local normal tractions of conformal contact [N]
      real(wp) :: tilde_fn = 0.0_wp
      !> Where friction varies over the rail: its parameters in this patch, one set or one per row; otherwise unallocated
      type(friction_parameters), allocatable :: friction(:)
      !> Does friction vary inside the patch?
      logical :: friction_varies = .false.
      !> Forces on the rail in the axes x, s, n of the reference [N]: those of `contact` for flat patches,
      !> rotated row by row for conformal ones
      real(wp) :: force(3) = 0.0_wp
      !> Moment about the reference in the same axes [N mm]
      real(wp) :: moment(3) = 0.0_wp
      !> Tractions, slip, totals in the axes of the patch
      type(patch_result) :: contact
   end type wheel_rail_patch

   !> Points of a profile in track coordinates
   type :: profile_points
      !> Arc length and x, y, z [mm], each of shape (n)
      real(wp), allocatable :: s(:), x(:), y(:), z(:)
   end type profile_points

   !> A place where the bodies overlap and no patch is: an end of the wheel's profile, or another place along the track
   type :: buried_end
      !> Depth below the surface of the rail [mm]; 0: none
      real(wp) :: depth = 0.0_wp
      !> Where it is deepest, in track coordinates [mm]
      real(wp) :: place(3) = 0.0_wp
      !> Is it farther along the track than contact is sought?
      logical :: beyond_reach = .false.
   end type buried_end

   !> The pair
   type :: wheel_rail_result
      !> How the case ended: its patches, and the searches for prescribed forces
      type(case_status) :: status
      !> Combined modulus [N/mm2], Poisson ratio [-], difference parameter [-]
      real(wp) :: gg = 1.0_wp, nu = 0.0_wp, ak = 0.0_wp
      !> Height of the wheelset [mm] and pitch rate [rad/s], prescribed or found
      real(wp) :: z_ws = 0.0_wp, vpitch = 0.0_wp
      !> Deflection of a massless rail [mm]
      real(wp) :: dy_defl = 0.0_wp, dz_defl = 0.0_wp
      !> Smallest gap in vertical direction [mm]; negative: penetration
      real(wp) :: smallest_gap = 0.0_wp
      !> Total force on the rail [N] in track and wheelset axes
      real(wp) :: force_track(3) = 0.0_wp, force_wheelset(3) = 0.0_wp
      !> Total moment on the rail [N mm] about the rail marker in track axes, about the wheel marker in wheelset axes
      real(wp) :: moment_rail(3) = 0.0_wp, moment_wheel(3) = 0.0_wp
      !> Rail marker in the track: y, z [mm], roll [rad]
      real(wp) :: rail_y = 0.0_wp, rail_z = 0.0_wp, rail_roll = 0.0_wp
      !> Wheel marker in the track: x, y, z [mm], roll, yaw [rad]; lateral place of the wheel profile in the wheelset [mm]
      real(wp) :: wheel_x = 0.0_wp, wheel_y = 0.0_wp, wheel_z = 0.0_wp, wheel_roll = 0.0_wp, wheel_yaw = 0.0_wp
      real(wp) :: wheel_offset = 0.0_wp
      !> Contact patches, field side first; of size zero without contact
      type(wheel_rail_patch), allocatable :: patches(:)
      !> Ends of the wheel's profile within the rail, which carry no load geometry: those of the lower and the higher y
      type(buried_end) :: buried(2)
      !> Overlap at another place along the track, at a lateral position with contact: a search that keeps one place for each
      !> lateral position leaves it out
      type(buried_end) :: beside
      !> Profiles as used; filled when the output level asks for them
      type(profile_points) :: rail_profile, wheel_profile
      !> Evaluations of the total force, and how far it is from the prescribed one [N]
      integer :: force_evaluations = 0
      !> Heights tried in one search for the vertical force: largest number of this case
      integer :: max_trials = 0
      real(wp) :: force_error = 0.0_wp
   contains
      !> Are all totals, and those of the patches, finite numbers?
      procedure :: has_finite_totals
   end type wheel_rail_result

contains

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

   !> The solution of a patch on its grid with the origin of the elements: in a transient case that is not the reference
   pure function in_element_coordinates(patch) result(contact)
      type(wheel_rail_patch), intent(in) :: patch
      type(patch_result) :: contact

      contact = patch%contact
      associate (x => patch%grid_reference(1), s => patch%grid_reference(2))
         contact%grid%xl = contact%grid%xl + x
         contact%grid%yl = contact%grid%yl + s
      end associate
   end function in_element_coordinates

   !> Moment about the normal through the origin of the elements, from that about the contact reference
   pure real(wp) function moment_about_elements(patch, fx, fy, mz) result(moment)
      type(wheel_rail_patch), intent(in) :: patch
      !> Tangential forces [N] and the moment about the contact reference [N mm]
      real(wp), intent(in) :: fx, fy, mz

      moment = mz + patch%grid_reference(1)*fy - patch%grid_reference(2)*fx
   end function moment_about_elements

   !> The mirror image of a patch: rows in reversed order, lateral components with the other sign. Totals and stresses
   !> below the surface stay
   function mirrored(right) result(left)
      type(patch_result), intent(in) :: right
      type(patch_result) :: left
      integer :: n

      left = right
      n = right%grid%my
      left%grid%yl = -(right%grid%yl + n*right%grid%dy)
      left%division = right%division(:, n:1:-1)
      left%h = right%h(:, n:1:-1)
      left%mu = right%mu(:, n:1:-1)
      left%pn = right%pn(:, n:1:-1)
      left%px = right%px(:, n:1:-1)
      left%py = -right%py(:, n:1:-1)
      left%un = right%un(:, n:1:-1)
      left%ux = right%ux(:, n:1:-1)
      left%uy = -right%uy(:, n:1:-1)
      left%sx = right%sx(:, n:1:-1)
      left%sy = -right%sy(:, n:1:-1)
      if (allocated(right%tau_c)) then
         left%tau_c = right%tau_c(:, n:1:-1)
         left%uplx = right%uplx(:, n:1:-1)
         left%uply = -right%uply(:, n:1:-1)
      end if
      if (allocated(right%temp1)) then
         left%temp1 = right%temp1(:, n:1:-1)
         left%temp2 = right%temp2(:, n:1:-1)
      end if
   end function mirrored
end module contact_wheelrail_result
