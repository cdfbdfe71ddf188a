!> The problem of a wheel on a rail, and quantities that follow from it without contact search
module contact_wheelrail_problem
   use contact_base_choices, only : contact_location, force_control, motion, time_link, variation
   use contact_base_kinds, only : wp
   use contact_base_limits, only : case_limits
   use contact_friction_law, only : friction_set, mixed
   use contact_friction_new_law, only : friction_model
   use contact_patch_problem, only : patch_problem
   use contact_profile_curve, only : profile_curve
   use contact_profile_surface, only : profile_surface
   use contact_wheelrail_spec, only : pair_spec
   implicit none (type, external)
   private

   public :: wheel_rail_problem, relaxing_bodies, friction_by_row, follows_surface, keeps_lattice, load_of, parameters_at, &
      & rate_of_pure_rolling, share_of_rail

   !> Viscoelastic rail and wheel; see `set_viscoelastic` of contact_elastic_model
   type :: relaxing_bodies
      !> Poisson ratios [-], instantaneous moduli of rigidity [N/mm2], ratio of late to instantaneous compliance minus 1 [-]
      real(wp) :: poiss(2), gg(2), ratio(2)
      !> Relaxation times [s]
      real(wp) :: time(2)
   end type relaxing_bodies

   !> The problem of a wheel on a rail
   type :: wheel_rail_problem
      type(pair_spec) :: spec
      !> Prepared profiles in their own coordinates
      type(profile_curve) :: rail, wheel
      !> A rail that varies along the track, a wheel that is out of round; unallocated otherwise. The profile above is then that of
      !> the first slice
      type(profile_surface), allocatable :: rail_surface, wheel_surface
      !> Settings common to all patches: material, friction, motion, solvers
      type(patch_problem) :: template
      !> Viscoelastic bodies, whose compliance depends on the rolling velocity of a patch; unallocated for other materials
      type(relaxing_bodies), allocatable :: relaxation
      !> Is the vertical force prescribed? Otherwise the height of the wheelset
      logical :: force_prescribed = .false.
      !> Additional unknown, member of force_control: none, the pitch rate, or the deflection of the rail
      integer :: force = force_control%creepages
      !> Contact search only?
      logical :: geometry_only = .false.
      !> Are errors of the totals estimated?
      logical :: estimates_errors = .false.
      !> Limits of time and memory; the deadline is also in the template
      type(case_limits) :: limits
      !> Does the solution start from the previous case?
      logical :: use_previous = .false.
      !> Is the last case solved again with other elements? Its height, friction ratios, pitch rate and deflection are estimates
      logical :: refines = .false.
      !> Is the case one of a loop over time, where the last cases give estimates, independent of `link`? The result does not depend
      !> on them within the tolerance, but its last digits do
      logical :: in_loop = .false.
      !> Relation to the previous case, member of time_link
      integer :: link = time_link%initiate
      !> Power of the interpenetration in the weights of the contact reference
      integer :: weight_power = 2
      !> Distance travelled per step, relative to the length of an element [-]
      real(wp) :: relative_step = 1.0_wp
      !> Variation of friction over the rail, member of variation, and friction law, member of friction_model
      integer :: variation = variation%none, friction_law = friction_model%coulomb
      !> Control points of friction: contact angles [rad] or positions along the track [mm], increasing; parameters at these points
      real(wp), allocatable :: control_point(:)
      type(friction_set), allocatable :: control(:)
      !> Fraction of the instantaneous compliance of both bodies due to the rail [-]
      real(wp) :: rail_share = 0.5_wp
      !> Maximum number of elements of a patch
      integer :: max_elements = 20000
   end type wheel_rail_problem

contains

   !> Fraction of the compliance of both bodies due to the rail [-]
   !>
   !> That of viscoelastic bodies is a mean of the contact: they have relaxed for the time that particles take from the leading edge
   !> of Hertz's circle of contact to its centre.
   pure real(wp) function share_of_rail(problem, approach, veloc) result(share)
      !> Bodies and radii
      type(wheel_rail_problem), intent(in) :: problem
      !> Approach of the bodies [mm], rolling velocity [mm/s]
      real(wp), intent(in) :: approach, veloc
      !> Lower bounds of velocities [mm/s], and of relaxation times relative to the time in contact [-]
      real(wp), parameter :: standstill = 1.0e-9_wp, immediate = 1.0e-3_wp
      real(wp) :: curvature, time, compliance(2)

      share = problem%rail_share
      if (.not. allocated(problem%relaxation)) return
      curvature = 1.0_wp/problem%spec%wheelset%nomradw
      if (problem%spec%roller) curvature = curvature + 1.0_wp/problem%spec%track%nomradr
      time = sqrt(max(0.0_wp, approach)/curvature)/max(veloc, standstill)
      associate (bodies => problem%relaxation)
         compliance = [share, 1.0_wp - share]*(1.0_wp + bodies%ratio*(1.0_wp - exp(-time/max(bodies%time, immediate*time, &
            & tiny(time)))))
      end associate
      share = compliance(1)/sum(compliance)
   end function share_of_rail

   !> Pitch rate at which the circumferential velocity of the wheel equals the rolling velocity [rad/s]
   pure real(wp) function rate_of_pure_rolling(problem) result(rate)
      !> Rolling velocity, nominal radius of the wheel, and that of a roller
      type(wheel_rail_problem), intent(in) :: problem

      associate (wheel_rail => problem%spec)
         if (wheel_rail%roller) then
            rate = -wheel_rail%wheelset%rpitch*wheel_rail%track%nomradr/wheel_rail%wheelset%nomradw
         else
            rate = -wheel_rail%wheelset%vs/wheel_rail%wheelset%nomradw
         end if
      end associate
   end function rate_of_pure_rolling

   !> Force relative to the stiffness of the bodies, F (1 - nu)/G [mm2]; 0 for a force that pulls
   pure real(wp) function load_of(problem, force) result(load)
      !> With the material of the bodies
      type(wheel_rail_problem), intent(in) :: problem
      !> Vertical force [N]
      real(wp), intent(in) :: force

      associate (material => problem%template%model%material)
         load = max(0.0_wp, force)*(1.0_wp - material%nu)/material%gg
      end associate
   end function load_of

   !> Are the elements aligned with the lattice of wheel and rail, as transient motions require?
   pure logical function keeps_lattice(problem) result(keeps)
      !> Motion of the bodies
      type(wheel_rail_problem), intent(in) :: problem
      keeps = problem%template%motion == motion%shift .or. problem%template%motion == motion%transient_rolling
   end function keeps_lattice

   !> Do distances and slip of a patch refer to a curved reference surface, row by row?
   pure logical function follows_surface(problem) result(follows)
      !> Member of contact_reference, and type of the bodies
      type(wheel_rail_problem), intent(in) :: problem
      follows = any(problem%spec%search%location == [contact_location%conformal, contact_location%locus_extended])
   end function follows_surface

   !> Does friction vary with the inclination of the rail within a patch?
   pure logical function friction_by_row(problem) result(by_row)
      !> Control points of friction, and their use
      type(wheel_rail_problem), intent(in) :: problem
      by_row = problem%variation == variation%by_angle .and. problem%spec%search%location == contact_location%conformal
   end function friction_by_row

   !> Parameters of friction between control points, by linear interpolation; constant beyond them
   pure function parameters_at(problem, position) result(parameters)
      !> Control points of friction and their parameters
      type(wheel_rail_problem), intent(in) :: problem
      !> Contact angle [rad] or position along the track [mm]
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
