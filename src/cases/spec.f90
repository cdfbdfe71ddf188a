!> Specification of a case: named choices and values in internal units (mm, N, s, rad, degC)
!>
!> The reader starts from the complete specification of the previous case and overwrites the groups that are read; values that a
!> "keep" digit leaves unchanged are therefore already there, and no room below `input` needs to know about it.
module contact_cases_spec
   use contact_base_choices, only : grid_form, heat_source, kernel_model, material_model, motion
   use contact_base_kinds, only : wp
   use contact_base_limits, only : case_limits
   use contact_base_solver_settings, only : solver_settings
   use contact_cases_given, only : given_numbers
   use contact_elastic_material, only : combine, combined_material
   use contact_friction_law, only : friction_set
   use contact_patch_wear, only : wear_spec
   use contact_wheelrail_spec, only : wheel_rail_spec
   use contact_subsurface_points, only : point_block
   implicit none (type, external)
   private

   public :: case_spec, iteration_spec, kinematics_spec, friction_set, friction_spec
   public :: rolling_spec, material_spec, damping_spec, heat_spec, wear_spec, grid_spec, geometry_spec
   public :: subsurface_spec, largest_yield_limit
   public :: case_parts, part_source

   type :: part_source_list
      !> The previous case; the previous case, but data derived from it are computed again; this case
      integer :: kept = 0, renewed = 1, given = 2
   end type part_source_list
   !> Source of the values of a group of the input
   type(part_source_list), parameter :: part_source = part_source_list()

   !> Source of each group of the input, member of part_source
   type :: case_parts
      !> Groups of both modules
      integer :: iteration = 2, friction = 2, rolling = 2, material = 2, damping = 2, heat = 2
      integer :: stress_output = 2, stress_points = 2
      !> Groups of module 3
      integer :: grid = 2, geometry = 2, extra_slip = 2
      !> Groups of module 1
      integer :: search = 2, track = 2, rail_profile = 2, deviations = 2
      integer :: wheel_profile = 2, position = 2, velocity = 2, flexibility = 2
   end type case_parts

   !> Settings of the iterative solvers, and other values of the same input line
   type, extends(solver_settings) :: iteration_spec
      !> Member of sensitivity_choice; maximum number of iterations, and tolerance, for sensitivities
      integer :: sensitivity = 1, mxsens = 30
      real(wp) :: epsens = 1.0e-4_wp
      !> Maximum number of elements (wheel-rail contact)
      integer :: npot_max = 20000
      !> Initial slip and relaxation factor of the friction iteration
      integer :: inislp = 0
      real(wp) :: omgslp = 0.5_wp
      !> Requested relative error of the forces [-]; 0: grid and tolerance of the case are used
      real(wp) :: accuracy = 0.0_wp
      !> Are simplified methods allowed instead of the full theory, if their error is known to be below the requested one?
      logical :: allows_approximate = .false.
   end type iteration_spec

   !> Prescribed approach or normal force, creepages or tangential forces
   type :: kinematics_spec
      !> Approach [mm] and normal force [N]; normal_control selects the prescribed one
      real(wp) :: pen = 0.0_wp, fn = 0.0_wp
      !> Relative tangential forces Fx/(mu_scal Fn), Fy/(mu_scal Fn) [-]; force_control: whether they are prescribed
      real(wp) :: fx = 0.0_wp, fy = 0.0_wp
      !> Creepages [-] (rolling) or shifts [mm]; spin [rad/mm] or rotation [rad]
      real(wp) :: cksi = 0.0_wp, ceta = 0.0_wp, cphi = 0.0_wp
      !> Spin centre [mm]
      real(wp) :: spinxo = 0.0_wp, spinyo = 0.0_wp
   end type kinematics_spec

   !> Friction law
   type :: friction_spec
      !> One set, or one per control point or grid row
      type(friction_set), allocatable :: sets(:)
      !> Friction memory: distance [mm] and minimum velocity [mm/s]
      real(wp) :: memdst = 1.0e-3_wp, mem_s0 = 10.0_wp
   end type friction_spec

   !> Rolling direction, distance travelled per step, rolling velocity
   type :: rolling_spec
      !> Rolling direction [rad], distance travelled per step [mm], rolling velocity [mm/s]
      real(wp) :: chi = 0.0_wp, dq = 1.0_wp, veloc = 1.0_wp
      !> Offset of the spin term in steps [-]
      real(wp) :: facphi = 1.0_wp/6.0_wp
   end type rolling_spec

   !> Material constants of the bodies and of the layer between them
   type :: material_spec
      !> Poisson ratios [-] and moduli of rigidity [N/mm2] of bodies 1 and 2
      real(wp) :: poiss(2) = 0.28_wp, gg(2) = 1.0_wp
      !> Vertical flexibility of a thin sheet [mm3/N]
      real(wp) :: flxz = 0.0_wp
      !> Viscoelastic bodies: compliance ratios [-] and relaxation times [s]
      real(wp) :: fg(2) = 0.0_wp, tc(2) = 0.0_wp
      !> Simplified theory: flexibility [mm3/N], slope reduction parameters [-]
      real(wp) :: flx = 0.0_wp, k0_mf = 1.0_wp, alfamf = 1.0_wp, betamf = 1.0_wp
      !> Interfacial layer: modulus of rigidity [N/mm2], thickness [mm], yield limit [N/mm2], slope [N/mm3]
      real(wp) :: gg3 = 1.0_wp, laythk = 0.0_wp, tau_c0 = 0.0_wp, k_tau = 0.0_wp
      !> Conformal correction: method, variant, table of lateral positions [mm] and inclinations [rad]
      integer :: if_meth = 0, variant = 4
      real(wp), allocatable :: table_y(:), table_alpha(:)
      !> File of numerical influence coefficients
      character(len=:), allocatable :: cfname
   contains
      !> Do the late responses of viscoelastic bodies differ so much that pressures and tangential tractions are coupled?
      procedure :: relaxes_apart
      !> Moduli of rigidity of the response of viscoelastic bodies without memory
      procedure :: immediate_moduli
      !> Kalker's difference parameter K of two bodies [-]
      procedure :: difference_parameter
      !> Do pressures and tangential tractions affect each other, because the materials differ?
      procedure :: are_unlike
   end type material_spec

   !> Force-based damping
   type :: damping_spec
      real(wp) :: cdampn = 0.0_wp, cdampt = 0.0_wp, dfnmax = 0.0_wp, dftmax = 0.0_wp
   end type damping_spec

   !> Thermal constants of bodies 1 and 2
   type :: heat_spec
      real(wp) :: bktemp(2) = 0.0_wp, heatcp(2) = 450.0_wp, lambda(2) = 0.05_wp, dens(2) = 7.85e-6_wp
      real(wp) :: betapl = 1.0_wp
      !> Were these values given in a case? Otherwise they are defaults
      logical :: is_given = .false.
      !> Member of heat_source; not part of the input file
      integer :: source = heat_source%established
   end type heat_spec

   !> Potential contact as given in the input (its form and values)
   type :: grid_spec
      !> Member of grid_form, 0 if nothing was given
      integer :: form = 0
      integer :: mx = 0, my = 0
      real(wp) :: a1 = 0.0_wp, b1 = 0.0_wp, aob = 1.0_wp, aa = 0.0_wp, bb = 0.0_wp
      real(wp) :: bneg = 0.0_wp, bpos = 0.0_wp, scale = 1.0_wp
      real(wp) :: xl = 0.0_wp, yl = 0.0_wp, dx = 0.0_wp, dy = 0.0_wp, xh = 0.0_wp, yh = 0.0_wp
      real(wp) :: xc1 = 0.0_wp, yc1 = 0.0_wp, xcm = 0.0_wp, ycm = 0.0_wp
   contains
      !> Does the form define its own undeformed distance, or require one? Neither before anything was given
      procedure :: brings_geometry, needs_geometry
      !> Is there a Hertz solution, and is it that of a line contact, with bb the half length?
      procedure :: is_hertzian, is_line_contact
   end type grid_spec

   !> Undeformed distance and planform
   type :: geometry_spec
      !> Members of distance_form and planform_choice
      integer :: form = 1, planform = 1
      !> Quadratic: B1...B6; with sines: B1...B8
      real(wp) :: b(8) = 0.0_wp
      !> Profile: NN = size(profile), XM, RM, Y1, DY1 and the profile B(1...NN) [mm]
      real(wp) :: xm = 0.0_wp, rm = 1.0_wp, y1 = 0.0_wp, dy1 = 1.0_wp
      real(wp), allocatable :: profile(:)
      !> Elementwise: one value per element [mm], size npot; columns and rows of the grid they were given for, 0 if not known
      real(wp), allocatable :: h(:)
      integer :: h_grid(2) = 0
      !> Quadratic: PL1...PL6; two rectangles: XL1 XH1 YL1 YH1 XL2 XH2 YL2 YH2
      real(wp) :: pl(8) = 0.0_wp
      !> Weighted rectangles: XL XH YL YH of each part [mm], shape (4, parts), and interaction factors of the pressures of the parts
      !> [-], symmetric, 1 on the diagonal, shape (parts, parts); unallocated for the other planforms
      real(wp), allocatable :: rectangles(:, :), interaction(:, :)
   end type geometry_spec

   !> Requested stresses below the surface
   type :: subsurface_spec
      !> Level of output to .subs (0, 1, 2) and to .out (0...4)
      integer :: matfil = 0, output = 0
      type(point_block), allocatable :: blocks(:)
   end type subsurface_spec

   !> Complete specification of a case
   type :: case_spec
      !> Named choices, see contact_base_choices
      integer :: link = 2, pressure = 0, motion = 0, normal = 0, force = 0
      integer :: variation = 0, friction_law = 0, kernel = 2, material_model = 0
      integer :: slip_source = 0, solver = 0, estimate = 0
      !> Is the classical solver named by `solver` used? Otherwise the default solver, if possible; not part of the input file
      logical :: classical = .false.
      !> Are damping, surface temperatures and stresses below the surface computed?
      logical :: has_damping = .false., has_heat = .false., has_stress = .false.
      !> Groups that the case gives, and groups that it keeps
      type(case_parts) :: parts
      !> Numbers that this case and those before it have given
      type(given_numbers) :: given
      !> Output: .mat file 0, 1, 2; .out level 0...6; flow trace 0...9
      integer :: mat_file = 0, output_level = 0, flow_level = 0
      !> Limits of time and memory
      type(case_limits) :: limits
      !> Are errors of the totals estimated? Not part of the input file
      logical :: estimates_errors = .false.
      !> Are wear and fatigue requested? Not part of the input file
      logical :: has_wear = .false.
      !> Is the case solved? Otherwise its input is only stored. Is it the last one in a sequence of cases of its module?
      logical :: solve = .true., ends_module = .false.
      type(iteration_spec) :: iteration
      type(kinematics_spec) :: kinematics
      type(friction_spec) :: friction
      type(rolling_spec) :: rolling
      type(material_spec) :: material
      type(damping_spec) :: damping
      type(heat_spec) :: heat
      type(wear_spec) :: wear
      type(grid_spec) :: grid
      type(geometry_spec) :: geometry
      !> Extra rigid slip, x and y per element, shape (2, npot), unallocated if never given; columns and rows of the grid it was
      !> given for, 0 if not known
      real(wp), allocatable :: extra_slip(:, :)
      integer :: slip_grid(2) = 0
      type(subsurface_spec) :: subsurface
      !> Wheel on rail (module 1); unallocated for module 3
      type(wheel_rail_spec), allocatable :: wheel_rail
   contains
      !> Is there an interfacial layer with a yield limit in the valid range?
      procedure :: has_plasticity
      !> Does the case give a grid or an undeformed distance, or form one from the values in store?
      procedure :: has_new_geometry
      !> Maximum number of outer iterations of this case, which is 1 for bodies that do not need them
      procedure :: outer_iterations
   end type case_spec

   !> Difference parameters below this value are treated as zero [-]
   real(wp), parameter, public :: quasi_identical = 1.0e-4_wp

   !> Yield limits outside these bounds mean that there is no plasticity [N/mm2]
   real(wp), parameter :: min_yield_limit = 1.0e-10_wp, largest_yield_limit = 1.0e10_wp

contains

   pure logical function brings_geometry(self)
      class(grid_spec), intent(in) :: self
      brings_geometry = self%is_hertzian() .or. self%form == grid_form%half_ellipses
   end function brings_geometry

   pure logical function needs_geometry(self)
      class(grid_spec), intent(in) :: self
      needs_geometry = any(self%form == [grid_form%corner_and_sides, grid_form%corners, grid_form%centre_and_sides, &
         & grid_form%centres])
   end function needs_geometry

   pure logical function is_hertzian(self)
      class(grid_spec), intent(in) :: self
      is_hertzian = any(self%form == [grid_form%hertz_curvatures, grid_form%hertz_curvature_ratio, grid_form%hertz_axes, &
         & grid_form%hertz_line_curvature, grid_form%hertz_line])
   end function is_hertzian

   pure logical function is_line_contact(self)
      class(grid_spec), intent(in) :: self
      is_line_contact = self%form == grid_form%hertz_line_curvature .or. self%form == grid_form%hertz_line
   end function is_line_contact

   !> Lateral displacements by pressures due to relaxation, fg (1 - 2 nu)/G, cancel if they are equal with equal relaxation times
   pure logical function relaxes_apart(self)
      class(material_spec), intent(in) :: self
      !> Difference relative to the compliance below which bodies are regarded as equal, as for AK [-]
      real(wp), parameter :: alike = 1.0e-4_wp
      real(wp) :: at_once(2), late(2), small

      small = alike*sum(1.0_wp/self%gg)
      late = self%fg*(1.0_wp - 2.0_wp*self%poiss)/self%gg
      ! without relaxation time the whole response is immediate
      at_once = merge(late, 0.0_wp, self%tc <= 0.0_wp)
      late = late - at_once
      relaxes_apart = abs(at_once(1) - at_once(2)) > small .or. abs(late(1) - late(2)) > small .or. &
         & (abs(self%tc(1) - self%tc(2)) > alike*maxval(self%tc) .and. maxval(late) > small)
   end function relaxes_apart

   !> Moduli of rigidity of the response of viscoelastic bodies without memory [N/mm2]: relaxed ones without relaxation time
   pure function immediate_moduli(self) result(modulus)
      class(material_spec), intent(in) :: self
      real(wp) :: modulus(2)

      modulus = self%gg
      where (self%tc <= 0.0_wp) modulus = self%gg/(1.0_wp + self%fg)
   end function immediate_moduli

   pure real(wp) function difference_parameter(self)
      class(material_spec), intent(in) :: self
      type(combined_material) :: both

      both = combine(self%poiss, self%gg)
      difference_parameter = both%ak
   end function difference_parameter

   pure logical function are_unlike(self, model)
      class(material_spec), intent(in) :: self
      !> Member of material_model
      integer, intent(in) :: model

      are_unlike = abs(self%difference_parameter()) >= quasi_identical
      if (.not. are_unlike .and. model == material_model%viscoelastic) are_unlike = self%relaxes_apart()
   end function are_unlike

   pure integer function outer_iterations(self)
      class(case_spec), intent(in) :: self
      logical :: affect_each_other

      outer_iterations = self%iteration%maxout
      if (outer_iterations <= 1 .or. self%motion == motion%none) return
      affect_each_other = self%kernel == kernel_model%conformal .or. self%kernel == kernel_model%tabulated
      if (.not. affect_each_other) affect_each_other = self%material%are_unlike(self%material_model)
      if (.not. affect_each_other) outer_iterations = 1
   end function outer_iterations

   pure logical function has_new_geometry(self)
      class(case_spec), intent(in) :: self
      has_new_geometry = self%parts%grid /= part_source%kept .or. self%parts%geometry /= part_source%kept
   end function has_new_geometry

   pure logical function has_plasticity(self)
      class(case_spec), intent(in) :: self
      has_plasticity = self%material_model == material_model%interfacial_layer .and. &
         & self%material%tau_c0 > min_yield_limit .and. self%material%tau_c0 <= largest_yield_limit
   end function has_plasticity
end module contact_cases_spec
