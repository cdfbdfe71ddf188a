!> What is asked for a wheel on a rail, and what follows from it without looking at the contact
module contact_wheelrail_problem
   use contact_base_choices, only : contact_location, force_control, motion, time_link, variation
   use contact_base_kinds, only : wp
   use contact_base_limits, only : case_limits
   use contact_friction_law, only : friction_set, mixed
   use contact_friction_new_law, only : friction_model
   use contact_patch_problem, only : patch_problem
   use contact_profile_curve, only : profile_curve
   use contact_profile_surface, only : profile_surface
   use contact_wheelrail_spec, only : wheel_rail_spec
   implicit none (type, external)
   private

   public :: wheel_rail_problem, relaxing_bodies, friction_by_row, follows_surface, keeps_lattice, parameters_at, &
      & rate_of_pure_rolling

   !> Viscoelastic bodies, rail and wheel; see `set_viscoelastic` of contact_elastic_model
   type :: relaxing_bodies
      !> Poisson ratios [-], instantaneous moduli [N/mm2], late over instantaneous compliance minus 1 [-]
      real(wp) :: poiss(2), gg(2), ratio(2)
      !> Relaxation times [s]
      real(wp) :: time(2)
   end type relaxing_bodies

   !> What is asked for a pair
   type :: wheel_rail_problem
      type(wheel_rail_spec) :: spec
      !> Prepared profiles in their own coordinates
      type(profile_curve) :: rail, wheel
      !> A rail that varies along the track, a wheel that is out of round; then the profile is that of the first slice
      type(profile_surface), allocatable :: rail_surface, wheel_surface
      !> Settings that all patches share: material, friction, motion, solvers
      type(patch_problem) :: template
      !> Viscoelastic bodies: the compliance of a patch follows from its rolling velocity; unallocated for other materials
      type(relaxing_bodies), allocatable :: relaxation
      !> Is the vertical force prescribed? Otherwise the height of the wheelset
      logical :: force_prescribed = .false.
      !> What is found besides, member of force_control: nothing, the pitch rate, or the deflection of the rail
      integer :: force = force_control%creepages
      !> Only search for contact?
      logical :: geometry_only = .false.
      !> Shall the errors of the totals be estimated?
      logical :: estimates_errors = .false.
      !> What the case may take; the deadline stands in the template, too
      type(case_limits) :: limits
      !> Start from the previous case?
      logical :: use_previous = .false.
      !> Is the case one of a loop over time, in which the last ones are starting values, whatever it continues? The answer does
      !> not depend on them beyond the tolerance, but figures behind it do
      logical :: in_loop = .false.
      !> How the case continues the previous one, member of time_link
      integer :: link = time_link%initiate
      !> Power of the interpenetration in the weights of the contact reference
      integer :: weight_power = 2
      !> Distance of a step relative to the length of an element [-]
      real(wp) :: relative_step = 1.0_wp
      !> How friction varies, member of variation, and its law, member of friction_model
      integer :: variation = variation%none, friction_law = friction_model%coulomb
      !> Parameters at control points: angles [rad] or positions along the track [mm], rising
      real(wp), allocatable :: control_point(:)
      type(friction_set), allocatable :: control(:)
      !> The rail's part of the compliance of both bodies [-]
      real(wp) :: rail_share = 0.5_wp
      !> Elements of a patch at most
      integer :: max_elements = 20000
   end type wheel_rail_problem

contains

   !> Pitch rate at which the circumference of the wheel is as fast as the rail [rad/s]
   pure real(wp) function rate_of_pure_rolling(problem) result(rate)
      !> Velocity, nominal radius of the wheel, and that of a roller
      type(wheel_rail_problem), intent(in) :: problem

      associate (wheel_rail => problem%spec)
         if (wheel_rail%roller) then
            rate = -wheel_rail%wheelset%rpitch*wheel_rail%track%nomradr/wheel_rail%wheelset%nomradw
         else
            rate = -wheel_rail%wheelset%vs/wheel_rail%wheelset%nomradw
         end if
      end associate
   end function rate_of_pure_rolling

   !> Do the elements stand on the lattice of the pair, as a transient motion needs it?
   pure logical function keeps_lattice(problem) result(keeps)
      !> Motion of the bodies
      type(wheel_rail_problem), intent(in) :: problem
      keeps = problem%template%motion == motion%shift .or. problem%template%motion == motion%transient_rolling
   end function keeps_lattice

   !> Do distances and slip of a patch follow a reference surface row by row?
   pure logical function follows_surface(problem) result(follows)
      !> Member of contact_reference, and the kind of bodies
      type(wheel_rail_problem), intent(in) :: problem
      follows = any(problem%spec%search%location == [contact_location%conformal, contact_location%locus_extended])
   end function follows_surface

   !> Does friction follow the inclination of the rail within a patch?
   pure logical function friction_by_row(problem) result(by_row)
      !> Control points of friction, and where they count
      type(wheel_rail_problem), intent(in) :: problem
      by_row = problem%variation == variation%by_angle .and. problem%spec%search%location == contact_location%conformal
   end function friction_by_row

   !> Parameters between control points, by linear interpolation; constant beyond them
   pure function parameters_at(problem, position) result(parameters)
      !> Control points and the parameters there
      type(wheel_rail_problem), intent(in) :: problem
      !> [rad] or [mm]
      real(wp), intent(in) :: position
      type(friction_set) :: parameters
      real(wp) :: t
      integer :: k, n

      n = size(problem%control_point)
      k = count(problem%control_point <= position)
      if (k == 0 .or. n == 1) then
         parameters = problem%control(1)
         return
      end if
      parameters = problem%control(min(k, n))
      if (k >= n) return
      t = (position - problem%control_point(k))/(problem%control_point(k + 1) - problem%control_point(k))
      parameters = mixed(problem%control(k), problem%control(k + 1), t)
   end function parameters_at
end module contact_wheelrail_problem
