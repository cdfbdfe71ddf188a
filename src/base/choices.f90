!> Named choices of a case
!>
!> All rooms compare with these names; only the room `control` knows the digits of the input format that select them.
module contact_base_choices
   implicit none (type, external)
   private

   public :: time_link, pressure_model, motion, normal_control, force_control
   public :: kernel_model, material_model, solver_choice, estimate_choice, slip_source, heat_source, heat_source_name
   public :: variation, contact_location
   public :: sensitivity_choice
   public :: grid_form, planform_choice
   public :: has_slope_reduction, is_classical, is_fastrip, is_rolling, is_simplified

   !> How a case is linked to the previous one (P)
   type :: time_link_list
      integer :: continue_all = 0, continue_normal = 1, initiate = 2, repeat_step = 3
   end type time_link_list
   type(time_link_list), parameter :: time_link = time_link_list()

   !> Source of the normal pressures (B)
   type :: pressure_model_list
      integer :: full = 0, thin_sheet = 1, elliptical = 2, parabolical = 3, sdec = 4, kpec = 5, analyn = 6
   end type pressure_model_list
   type(pressure_model_list), parameter :: pressure_model = pressure_model_list()

   !> Relative motion of the bodies (T)
   type :: motion_list
      integer :: none = 0, shift = 1, transient_rolling = 2, steady_rolling = 3
   end type motion_list
   type(motion_list), parameter :: motion = motion_list()

   !> Prescribed quantity in normal direction (N)
   type :: normal_control_list
      integer :: approach = 0, force = 1
   end type normal_control_list
   type(normal_control_list), parameter :: normal_control = normal_control_list()

   !> Prescribed quantities in tangential direction (F)
   type :: force_control_list
      integer :: creepages = 0, fx_and_ceta = 1, fx_and_fy = 2
      !> Module 1: longitudinal force instead of the pitch rate; rail on springs
      integer :: longitudinal_force = 1, massless_rail = 3
   end type force_control_list
   type(force_control_list), parameter :: force_control = force_control_list()

   !> Variation of friction over the contact (V)
   type :: variation_list
      integer :: none = 0, by_angle = 1, by_position = 2, by_row = 3
   end type variation_list
   type(variation_list), parameter :: variation = variation_list()

   !> Influence coefficients (C)
   type :: kernel_model_list
      integer :: piecewise_constant = 2, bilinear = 3, conformal = 4, tabulated = 9
   end type kernel_model_list
   type(kernel_model_list), parameter :: kernel_model = kernel_model_list()

   !> Material behaviour (M)
   type :: material_model_list
      integer :: elastic = 0, viscoelastic = 1, fastsim_single = 2, fastsim = 3, interfacial_layer = 4, fastrip = 5
      !> FaStrip without slope reduction: as published, and with flexibilities that merge into a single one in full sliding
      integer :: fastrip_plain = 6, fastrip_sliding = 7
   end type material_model_list
   type(material_model_list), parameter :: material_model = material_model_list()

   !> Tangential solver (G). The default solver replaces the others where it can, unless `classical` of the case is set
   type :: solver_choice_list
      !> Newton-Krylov with automatic fallback
      integer :: default = 0
      !> Always ConvexGS, relaxation factors from the input
      integer :: convex_gs = 2
      !> SteadyGS in steady rolling, TangCG otherwise, relaxation factors from the input
      integer :: gauss_seidel = 3
      !> As default, with parameters of the friction iteration from the input
      integer :: default_friction = 4
      !> GDsteady with fallback to SteadyGS
      integer :: gd_steady = 5
   end type solver_choice_list
   type(solver_choice_list), parameter :: solver_choice = solver_choice_list()

   !> Initial estimate (I)
   type :: estimate_choice_list
      integer :: fresh = 0, previous = 1, previous_normal = 2, unchanged = 3
   end type estimate_choice_list
   type(estimate_choice_list), parameter :: estimate_choice = estimate_choice_list()

   !> Additional term of the rigid slip (E)
   type :: slip_source_list
      integer :: none = 0, no_spin_y = 2, no_spin_x = 3, given = 9
   end type slip_source_list
   type(slip_source_list), parameter :: slip_source = slip_source_list()

   !> Treatment of the self-heating of an element by friction
   type :: heat_source_list
      !> established: counted twice, as in the established program; moving: counted once, solution for moving sources
      integer :: established = 0, moving = 1
   end type heat_source_list
   type(heat_source_list), parameter :: heat_source = heat_source_list()
   !> Names of the members of heat_source, from 0 on
   character(len=13), parameter :: heat_source_name(0:1) = ["established  ", "moving source"]

   !> Method that locates and describes the contact of wheel and rail (D of module 1)
   type :: contact_location_list
      !> Contact locus: planar patches, the same with extra rigid slip, and curved patches
      integer :: locus = 2, locus_extended = 3, conformal = 4
      !> Search over a grid; the second is identical to the first, which refines its grid where necessary
      integer :: grid = 5, steep_grid = 6
      !> Contact locus with the first point of contact as reference point
      integer :: first_contact = 7
      !> Locus and grid in a fixed oblique view
      integer :: oblique_locus = 8, oblique_grid = 9
   end type contact_location_list
   type(contact_location_list), parameter :: contact_location = contact_location_list()

   !> Form in which the potential contact area is given (IPOTCN)
   type :: grid_form_list
      !> A corner or the centre of the first element, with the element sides or with the opposite corner or centre
      integer :: corner_and_sides = 1, corners = 2, centre_and_sides = 3, centres = 4
      !> Around a Hertzian contact given by curvatures or semi-axes, around a line contact, around two half ellipses
      integer :: hertz_curvatures = -1, hertz_curvature_ratio = -2, hertz_axes = -3
      integer :: hertz_line_curvature = -4, hertz_line = -5, half_ellipses = -6
   end type grid_form_list
   type(grid_form_list), parameter :: grid_form = grid_form_list()

   !> Planform: where contact is possible (IPLAN)
   type :: planform_list
      integer :: unrestricted = 1, quadratic = 2, two_rectangles = 3, weighted_rectangles = 4
   end type planform_list
   type(planform_list), parameter :: planform_choice = planform_list()

   !> Requested sensitivities; each level includes those before it
   type :: sensitivity_choice_list
      !> forces: of the tangential forces to the creepages with prescribed forces; normal: also of the normal force to the
      !> approach; all: of all forces to all inputs
      integer :: none = 0, forces = 1, normal = 2, all = 3
   end type sensitivity_choice_list
   type(sensitivity_choice_list), parameter :: sensitivity_choice = sensitivity_choice_list()

contains

   !> Is this a classical solver, for which the default solver is used where it can be?
   pure elemental logical function is_classical(choice)
      !> Member of solver_choice
      integer, intent(in) :: choice

      is_classical = choice == solver_choice%convex_gs .or. choice == solver_choice%gauss_seidel &
         & .or. choice == solver_choice%gd_steady
   end function is_classical

   !> Does one body roll over the other?
   elemental logical function is_rolling(kind)
      !> Member of motion
      integer, intent(in) :: kind

      is_rolling = kind == motion%transient_rolling .or. kind == motion%steady_rolling
   end function is_rolling

   !> Does simplified theory solve the tangential problem?
   elemental logical function is_simplified(model)
      !> Member of material_model
      integer, intent(in) :: model

      is_simplified = model == material_model%fastsim_single .or. model == material_model%fastsim .or. is_fastrip(model)
   end function is_simplified

   !> Are the tractions in the adhesion area given by strip theory?
   elemental logical function is_fastrip(model)
      !> Member of material_model
      integer, intent(in) :: model

      is_fastrip = model == material_model%fastrip .or. model == material_model%fastrip_plain &
         & .or. model == material_model%fastrip_sliding
   end function is_fastrip

   !> Does the case give parameters that reduce the stiffness of simplified theory?
   elemental logical function has_slope_reduction(model)
      !> Member of material_model
      integer, intent(in) :: model

      has_slope_reduction = is_simplified(model) .and. model /= material_model%fastrip_plain &
         & .and. model /= material_model%fastrip_sliding
   end function has_slope_reduction
end module contact_base_choices
