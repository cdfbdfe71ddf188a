!> Positions of the bodies at a height of the wheelset, and the gap between them
module contact_wheelrail_geometry
   use contact_base_choices, only : contact_location, motion
   use contact_base_kinds, only : wp
   use contact_profile_curve, only : profile_curve
   use contact_profile_surface, only : surface_cut
   use contact_wheelrail_bodies, only : wheel_rail_bodies, place_bodies, rail_section
   use contact_wheelrail_carry_over, only : carried_step, lattice_box, max_patches
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_gap, only : gap_curve, measure_gap, rail_in_track
   use contact_wheelrail_placement, only : wheel_rail_placement, place_wheel_rail
   use contact_wheelrail_problem, only : follows_surface, load_of, wheel_rail_problem
   use contact_wheelrail_region, only : contact_region
   use contact_wheelrail_regions, only : smallest_gap
   use contact_wheelrail_variable, only : measure_variable_gap
   implicit none (type, external)
   private

   public :: learned_share, wheel_rail_geometry, place, measure, rail_at, lattice_x, box_on_lattice

   !> Force of friction relative to the normal force from a tangential solution, and the position of its patch
   type :: learned_share
      !> Lateral position [mm] and contact angle [rad]
      real(wp) :: y = 0.0_wp, alpha = 0.0_wp
      real(wp) :: share(3) = 0.0_wp
      !> Is it used by a patch of the present trial that continues the patch of the solution?
      logical :: is_taken = .false.
   contains
      !> Distance to another patch, relative to the limits for the same patch
      procedure :: distance_to
   end type learned_share

   !> Penetration up to which the gap is measured at first [mm]: sufficient for most wheels
   real(wp), parameter :: first_reach = 0.15_wp

   !> Positions of the bodies and results of the search for contact: data shared by the patches of a trial
   type :: wheel_rail_geometry
      !> Ratios 1...shares are known. They are used in all trials until the next tangential solution; a patch of a trial that
      !> continues none of their patches is solved with friction, and its ratio is added
      integer :: shares = 0
      type(learned_share) :: learned(max_patches)
      type(gap_curve) :: gap
      !> Surroundings of smallest gaps, on finer meshes
      type(gap_curve), allocatable :: closer(:)
      !> The rail at the position of the wheelset
      type(profile_curve) :: rail_in_track
      !> Sections of bodies that vary along or around; used if `searches_table` or with curved reference surfaces
      type(wheel_rail_bodies) :: bodies
      logical :: searches_table = .false.
      type(wheel_rail_placement) :: placement
      !> Height at which the gap was measured, and height of first touch [mm]
      real(wp) :: gap_height = 0.0_wp, touch = 0.0_wp
      !> Minimum height for which regions of contact are computed [mm]; see `balance_forces`
      real(wp) :: lowest_for_regions = -huge(1.0_wp)
      !> Penetration for the prescribed force [mm]: of the last search of this case, or 0
      real(wp) :: penetration = 0.0_wp
      !> Gaps that exceed the smallest one by less than this are computed exactly [mm]; increased with the penetration
      real(wp) :: reach = first_reach
      !> Are trials of the height consecutive as in a loop over time, and does the first one continue the last case?
      logical :: follows = .false., follows_last = .false.
      !> Does the search for the height start at the result of the last one as well? Otherwise only pressures do
      logical :: follows_height = .false.
      !> Tolerance of the pressures in the present trial, as a fraction of EPS
      real(wp) :: pressure_eps = 1.0_wp
      !> Tolerance of the tangential tractions in the present trial, as a fraction of EPS
      real(wp) :: traction_eps = 1.0_wp
      !> Is the present trial the first one of a case that follows the last one? Then tractions are extrapolated from the last
      !> two cases by this multiple of their difference [-]
      logical :: is_first = .false.
      real(wp) :: ahead = 0.0_wp
      !> In a trial without tangential problems: are the tractions of the patches estimated from the present ones?
      logical :: keeps_tractions = .false.
      !> Ratio of the sides of elements in the present trial to the prescribed ones
      integer :: coarser = 1
      !> Lateral deflection of the rail [mm] and pitch rate of the wheelset [rad/s]: prescribed, or those of the present trial
      real(wp) :: deflection = 0.0_wp, pitch_rate = 0.0_wp
      !> Top of the canted rail and its gauge point [mm], and the inputs of their computation: cant [rad], height of the gauge point
      !> [mm]
      real(wp) :: top_z = 0.0_wp, gauge_y = 0.0_wp
      real(wp) :: gauged_cant = 0.0_wp, gauged_height = 0.0_wp
      !> Profile of the rail in the last case, and the inputs of `rail_in_track` and of the mesh of `gap`: position, and size of
      !> elements [mm], 0 if they cannot be reused
      type(profile_curve) :: known
      type(frame) :: known_place
      real(wp) :: known_ds = 0.0_wp
      !> Positions of the tractions of the previous time step
      type(carried_step) :: before
      !> Position of the wheelset along the rail [mm], and the arc length of the rail's profile at its origin [mm]
      real(wp) :: travel = 0.0_wp, profile_origin = 0.0_wp
   end type wheel_rail_geometry

   !> Limits of distance [mm] and angle [rad] within which a ratio is used by a patch
   real(wp), parameter :: same_place = 5.0_wp, same_angle = 0.2_wp

contains

   pure real(wp) function distance_to(self, y, alpha) result(distance)
      class(learned_share), intent(in) :: self
      !> Lateral position [mm] and contact angle [rad]
      real(wp), intent(in) :: y, alpha

      distance = hypot((self%y - y)/same_place, (self%alpha - alpha)/same_angle)
   end function distance_to

   !> Place the wheelset at a height
   subroutine place(problem, geometry, z, dz)
      !> Profiles, and positions of the bodies in the track
      type(wheel_rail_problem), intent(in) :: problem
      !> On return with the placement; deflection and pitch rate are those of the trial
      type(wheel_rail_geometry), intent(inout) :: geometry
      !> Height of the wheelset above a rail without vertical deflection [mm], z down
      real(wp), intent(in) :: z
      !> Vertical deflection of the rail [mm], default 0
      real(wp), intent(in), optional :: dz
      real(wp) :: deflection(2)

      deflection = [geometry%deflection, 0.0_wp]
      if (present(dz)) deflection(2) = dz
      call place_wheel_rail(problem%spec, problem%wheel, geometry%top_z, geometry%gauge_y, z, deflection, &
         & geometry%placement)
   end subroutine place

   !> Measure the gap between the bodies, and the height of first touch
   subroutine measure(problem, geometry, z, depth)
      !> Profiles, and the size of elements
      type(wheel_rail_problem), intent(in) :: problem
      !> With the placement; gap, its height and the height of first touch are set
      type(wheel_rail_geometry), intent(inout) :: geometry
      !> Height of the wheelset [mm]
      real(wp), intent(in) :: z
      !> See `measure_variable_gap`
      real(wp), intent(in), optional :: depth
      real(wp) :: load
      logical :: keeps_rail, weighs_table

      call place(problem, geometry, z)
      associate (now => geometry%placement%rail, before => geometry%known_place, ds => problem%spec%search%ds)
         keeps_rail = abs(geometry%known_ds - ds) <= 0.0_wp .and. all(abs(now%origin - before%origin) <= 0.0_wp) &
            & .and. all(abs(now%axes - before%axes) <= 0.0_wp) .and. .not. allocated(problem%rail_surface)
      end associate
      if (.not. keeps_rail) geometry%rail_in_track = rail_at(problem, geometry%placement, 0.0_wp)
      geometry%known_ds = 0.0_wp
      ! the arc length along a prismatic rail starts at its origin; sections of a variable rail have different ends
      geometry%profile_origin = 0.0_wp
      if (allocated(problem%rail_surface)) geometry%profile_origin = geometry%rail_in_track%s_at(geometry%placement%rail%origin(2))
      geometry%searches_table = allocated(problem%rail_surface) .or. allocated(problem%wheel_surface) &
         & .or. any(problem%spec%search%location == [contact_location%grid, contact_location%steep_grid])
      if (geometry%searches_table .or. follows_surface(problem)) then
         geometry%bodies%rail = geometry%rail_in_track
         geometry%bodies%wheel = problem%wheel
         geometry%bodies%placement = geometry%placement
         geometry%bodies%angle_below_axle = problem%spec%search%angle_below_axle
         call place_bodies(geometry%bodies, problem%spec%wheelset%s, problem%spec%wheelset%pitch_of_wheel(), &
            & problem%spec%search%dx, problem%rail_surface, problem%wheel_surface)
      end if
      if (geometry%searches_table) then
         if (allocated(geometry%closer)) deallocate(geometry%closer)
         weighs_table = allocated(problem%wheel_surface) &
            & .or. any(problem%spec%search%location == [contact_location%grid, contact_location%steep_grid])
         load = 0.0_wp
         if (problem%force_prescribed) load = load_of(problem, problem%spec%wheelset%fz)
         call measure_variable_gap(geometry%bodies, problem%spec%search%ds, weighs_table, geometry%gap, depth, load)
      else
         ! an independent case does not depend on the penetration of previous cases
         if (.not. problem%in_loop) geometry%reach = first_reach
         if (present(depth)) geometry%reach = max(geometry%reach, depth)
         call measure_gap(geometry%rail_in_track, problem%wheel, geometry%placement, problem%spec%search%ds, geometry%gap, &
            & geometry%closer, keeps_rail, geometry%reach + max(0.0_wp, problem%spec%search%g_miss))
         if (geometry%gap%depth < huge(1.0_wp)) geometry%gap%depth = geometry%reach
         geometry%known_ds = problem%spec%search%ds
         geometry%known_place = geometry%placement%rail
      end if
      geometry%gap_height = z
      geometry%touch = z + smallest_gap(geometry%gap, geometry%closer)
   end subroutine measure

   !> Profile of the rail in track coordinates at a position along it; beyond its first and last slice a variable rail is constant
   function rail_at(problem, placement, x) result(curve)
      !> Profile or surface of the rail
      type(wheel_rail_problem), intent(in) :: problem
      !> Position of the rail's origin in the track, and its rotation
      type(wheel_rail_placement), intent(in) :: placement
      !> Position along the track relative to the wheelset [mm]
      real(wp), intent(in) :: x
      type(profile_curve) :: curve
      type(surface_cut) :: section

      if (allocated(problem%rail_surface)) then
         call rail_section(problem%rail_surface, placement, problem%spec%wheelset%s + x, section)
         if (section%present) then
            curve = section%curve
            return
         end if
      end if
      curve = rail_in_track(problem%rail, placement)
   end function rail_at

   !> Position along the track, relative to the origin of the lattice [mm]
   pure real(wp) function lattice_x(problem, geometry, x)
      !> Problem; does the lattice follow the rail or the wheelset?
      type(wheel_rail_problem), intent(in) :: problem
      !> With the travel of the wheelset
      type(wheel_rail_geometry), intent(in) :: geometry
      !> Position in the track [mm]
      real(wp), intent(in) :: x

      lattice_x = x
      if (problem%template%motion == motion%shift) lattice_x = x + geometry%travel
   end function lattice_x

   !> Bounds of a region on the lattice
   function box_on_lattice(problem, geometry, region) result(box)
      !> Problem; does the lattice follow the rail or the wheelset?
      type(wheel_rail_problem), intent(in) :: problem
      !> With the travel of the wheelset, and the rail in the track
      type(wheel_rail_geometry), intent(in) :: geometry
      !> Region of interpenetration
      type(contact_region), intent(in) :: region
      type(lattice_box) :: box
      real(wp) :: s(2)

      box%x = [lattice_x(problem, geometry, region%box%x(1)), lattice_x(problem, geometry, region%box%x(2))]
      s = geometry%rail_in_track%s_at(region%box%y) - geometry%profile_origin
      box%s = [minval(s), maxval(s)]
   end function box_on_lattice
end module contact_wheelrail_geometry
