!> One contact patch: the problem of a time step, and the state that is kept from case to case
module contact_patch_problem
   use contact_base_choices, only : motion, pressure_model
   use contact_base_kinds, only : wp
   use contact_base_limits, only : deadline_type
   use contact_base_solver_settings, only : solver_settings
   use contact_elastic_model, only : elastic_model
   use contact_friction_law, only : friction_law
   use contact_friction_memory, only : friction_memory
   use contact_grid_potential_contact, only : potential_contact
   use contact_normal_parts, only : contact_parts
   use contact_patch_damping, only : damping_law
   use contact_patch_result, only : hertz_result
   use contact_simplified_problem, only : simplified_model
   use contact_temperature_flash_heating, only : body_pair
   implicit none (type, external)
   private

   public :: carried, patch_problem, patch_state, traction_fields, memory_field, rolling_direction

   !> Complete description of the problem of one time step; constant during the solution
   type :: patch_problem
      type(potential_contact) :: grid
      type(elastic_model) :: model
      !> Simplified theory for the tangential problem; unallocated: half-spaces
      type(simplified_model), allocatable :: simplified
      !> Are grid and undeformed distance reused while their input does not change?
      logical :: has_geometry = .false.
      !> Hertz solution of a Hertzian geometry; unallocated for other geometries
      type(hertz_result), allocatable :: hertz
      !> Undeformed distance [mm], shape (mx, my)
      real(wp), allocatable :: h(:, :)
      !> Parts of the patch whose interaction is reduced; unallocated: one part
      type(contact_parts), allocatable :: parts
      !> Given pressures [N/mm2], shape (mx, my); unallocated for the full solution
      real(wp), allocatable :: given_pressure(:, :)
      !> Estimate of the pressures [N/mm2] that replaces the previous ones; unallocated: none
      real(wp), allocatable :: pressure_estimate(:, :)
      !> Source of the pressures, member of pressure_model: solver or approximate method
      integer :: pressure = 0
      !> Members of motion, of estimate_choice and of solver_choice
      integer :: motion = 0, estimate = 0, solver = 0
      !> Are displacements and elastic energy left to `complete` of contact_patch_derived where the solution does not need them?
      logical :: defers_displacements = .false.
      !> Is the classical solver named in the input used even where the default solver is possible?
      logical :: classical = .false.
      !> Is the normal force prescribed, or the approach?
      logical :: force_prescribed = .true.
      !> Normal force [N], approach [mm]
      real(wp) :: fn = 0.0_wp, pen = 0.0_wp
      !> Number of prescribed tangential forces (0, 1, 2) and the relative forces F/(mu Fn) [-]
      integer :: n_forces = 0
      real(wp) :: force(2) = 0.0_wp
      !> Creepages [-] or shifts [mm]; spin [rad/mm] or rotation [rad]; spin centre [mm]
      real(wp) :: creep(2) = 0.0_wp, spin = 0.0_wp, spin_centre(2) = 0.0_wp
      !> Weights of the spin term in x and y [-]: 1, or 0 for a component that an extra term cancels
      real(wp) :: spin_weight(2) = 1.0_wp
      !> Offset of the spin term in steps [-]
      real(wp) :: spin_offset = 0.0_wp
      !> Extra rigid slip per unit distance [-], shape (mx, my, 2); unallocated: none
      real(wp), allocatable :: extra_slip(:, :, :)
      !> Rolling direction [rad], distance travelled per step [mm], rolling velocity [mm/s]
      real(wp) :: chi = 0.0_wp, dq = 1.0_wp, veloc = 1.0_wp
      !> Static coefficient of friction [-]; 1 if it differs between rows; scales relative forces
      real(wp) :: mu = 0.3_wp
      !> Friction law; unallocated: Coulomb friction with the coefficient above
      class(friction_law), allocatable :: friction
      type(friction_memory) :: friction_memory
      !> Initial slip velocity of the friction iteration: that of the previous case (0), zero (1), rolling velocity (-1)
      integer :: slip_start = 0
      !> Relaxation factor of the slip velocity where the coefficient is above the previous one of the particles [-]
      real(wp) :: slip_relaxation = 1.0_wp
      !> Thermal constants; unallocated: no temperatures
      type(body_pair), allocatable :: thermal
      !> Does the next time step depend on coefficients of friction and slip, or on yield limits and plastic displacements? Only
      !> then are they stored with the particles
      logical :: remembers_friction = .false., remembers_yield = .false.
      !> Static coefficient of friction per row [-], shape (my), and initial yield limit [N/mm2]: values of particles that enter the
      !> grid; set if the quantity is remembered
      real(wp), allocatable :: static_mu(:)
      real(wp) :: initial_yield_limit = 0.0_wp
      !> Derivative of the yield limit with respect to the plastic displacement [N/mm3]
      real(wp) :: yield_slope = 0.0_wp
      !> Tolerance, limits and parameters of the solvers
      type(solver_settings) :: settings
      !> Factor of the tolerance for pressures [-]. Below 1 in a search that needs differences smaller than the tolerance
      real(wp) :: pressure_eps = 1.0_wp
      !> Factor of the tolerance for tangential tractions [-]
      real(wp) :: traction_eps = 1.0_wp
      !> Is the estimate of the pressures extrapolated in the approach, with their derivative in the last solution?
      logical :: follows_approach = .false.
      !> Time limit
      type(deadline_type) :: deadline
      !> Is the relaxation factor given in the input? Otherwise it depends on the shape of the elements
      logical :: relaxation_given = .false.
      !> Is the slip of elements that entered the contact area during the step corrected? Only for steps longer than an element,
      !> along x
      logical :: corrects_leading_edge = .false.
      !> Steady rolling in any direction with steps of any length (ConvexGS)? Otherwise one element per step along x
      logical :: general_step = .false.
      !> Member of sensitivity_choice; maximum number of iterations, and tolerance of the relative residual [-], for sensitivities
      integer :: sensitivity = 0, mxsens = 30
      !> Are sensitivities an output? Otherwise they serve a height search, with lower accuracy
      logical :: reports_sensitivity = .true.
      real(wp) :: epsens = 1.0e-4_wp
      !> Damping proportional to the rate of forces; unallocated: none
      type(damping_law), allocatable :: damping
      !> Are displacements of exterior elements requested?
      logical :: want_exterior = .false.
      !> Take influence coefficients of viscoelastic bodies for the contact area from those for the grid? They differ by round-off
      logical :: shares_table = .false.
   contains
      !> Do the pressures satisfy the contact conditions? Otherwise they are given or approximate
      procedure :: solves_for_pressure
      !> Are pressures or tractions found by iteration from an estimate? Otherwise all follow from formulas
      procedure :: iterates
      !> Do pressures depend on the tangential tractions?
      procedure :: couples
      !> Is a quantity stored with the particles, and which value do particles without history have?
      procedure :: carries
      procedure :: fill_fresh
   end type patch_problem

   type :: carried_list
      !> Coefficient of friction [-] and slip per step [mm]
      integer :: mu = 1, sx = 2, sy = 3
      !> Yield limit [N/mm2] and plastic displacement difference [mm] of the interfacial layer
      integer :: tau_c = 4, uplx = 5, uply = 6
      !> Number of quantities
      integer :: count = 6
   end type carried_list
   !> Quantities that particles carry from time step to time step
   type(carried_list), parameter :: carried = carried_list()

   !> One of these quantities
   type :: memory_field
      !> One value per element, shape (mx, my); unallocated if no effect of the case needs it
      real(wp), allocatable :: value(:, :)
   end type memory_field

   !> Tractions and element states of one time step, on its grid
   type :: traction_fields
      type(potential_contact) :: grid
      integer, allocatable :: division(:, :)
      real(wp), allocatable :: pn(:, :), px(:, :), py(:, :)
      !> Approach [mm]
      real(wp) :: pen = 0.0_wp
      !> Derivative of the pressures with respect to the approach [N/mm3]; unallocated if not needed
      real(wp), allocatable :: rate(:, :)
      !> Does the time step belong to a solved case? Its forces Fn, Fx, Fy, without damping [N]
      logical :: is_solved = .false.
      real(wp) :: force(3) = 0.0_wp
      !> Quantities of the particles, indexed by the members of carried
      type(memory_field) :: memory(carried%count)
   end type traction_fields

   !> State of the physics that is kept from case to case
   type :: patch_state
      !> Has a case been solved? Was the last one steady rolling?
      logical :: started = .false., is_steady = .false.
      !> Present and previous time step
      type(traction_fields) :: now, before
      !> Solution of the case before the last one, in a loop over time, for extrapolations; not used if its grid is empty
      type(traction_fields) :: earlier
      !> Last creepages [-]
      real(wp) :: creep(2) = 0.0_wp
   end type patch_state

contains

   !> Rolling towards increasing (+1) or decreasing (-1) x
   pure integer function rolling_direction(problem)
      !> Motion and rolling direction
      type(patch_problem), intent(in) :: problem
      rolling_direction = merge(-1, 1, problem%motion >= motion%transient_rolling .and. cos(problem%chi) < 0.0_wp)
   end function rolling_direction

   pure logical function solves_for_pressure(self) result(solves)
      class(patch_problem), intent(in) :: self
      solves = self%pressure == pressure_model%full .and. .not. allocated(self%given_pressure)
   end function solves_for_pressure

   pure logical function iterates(self)
      class(patch_problem), intent(in) :: self
      iterates = self%solves_for_pressure() .or. (self%motion /= motion%none .and. .not. allocated(self%simplified))
   end function iterates

   pure logical function couples(self)
      class(patch_problem), intent(in) :: self
      couples = self%model%coupled() .and. self%motion /= motion%none .and. .not. allocated(self%given_pressure) &
         & .and. .not. allocated(self%simplified)
   end function couples

   pure logical function carries(self, kind)
      class(patch_problem), intent(in) :: self
      !> Member of carried
      integer, intent(in) :: kind

      carries = merge(self%remembers_friction, self%remembers_yield, kind <= carried%sy)
   end function carries

   !> Values of particles without history, per row of elements
   pure subroutine fill_fresh(self, kind, value)
      class(patch_problem), intent(in) :: self
      !> Member of carried
      integer, intent(in) :: kind
      !> Value of particles without history, shape (my)
      real(wp), intent(out) :: value(:)

      value = 0.0_wp
      if (kind == carried%mu) value = self%static_mu
      if (kind == carried%tau_c) value = self%initial_yield_limit
   end subroutine fill_fresh
end module contact_patch_problem
