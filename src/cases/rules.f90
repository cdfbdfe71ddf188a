!> Rules on combinations of choices of a case and on its values: each rule once, with its reason
!>
!> Readers of input and the library report the digits or words of the choices that break a rule, and their position;
!> `refuse_broken_rules` serves callers that have neither. The manual has tables of all rules.
module contact_cases_rules
   use contact_base_choices, only : force_control, grid_form, kernel_model, material_model, motion, &
      & normal_control, pressure_model, slip_source
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_friction_new_law, only : friction_model
   use contact_text_words, only : real_text
   implicit none (type, external)
   private

   public :: choice_kind, choice_rule, choice_rules, is_broken, refuse_broken_rules, value_of
   public :: number_rule, number_rules, demand_text, describe_number, is_missed

   type :: choice_kind_list
      integer :: pressure = 1, motion = 2, normal = 3, force = 4, friction_law = 5, kernel = 6, material_model = 7
      integer :: slip_source = 8, heat = 9, grid_form = 10
   end type choice_kind_list
   !> The choices of a case to which rules apply
   type(choice_kind_list), parameter :: choice_kind = choice_kind_list()

   !> Maximum number of values in a list; shorter lists are filled with this number, which is not a value of any choice
   integer, parameter :: list_length = 6, nothing = -99
   !> Value of a choice that the case has not made yet
   integer, parameter :: not_made = -98

   !> One rule: some values of a choice are allowed only with some values of another choice
   type :: choice_rule
      !> Members of choice_kind
      integer :: choice, other
      !> Values for which the rule holds, and values of the other choice that are allowed with them
      integer :: values(list_length), allowed(list_length)
      !> 1 or 3 for cases of one module, 0 for all
      integer :: module_number
      !> Name of the choice, "needs ...", "is meant for ..." or "cannot be used with ...", and the reason or an alternative
      character(len=44) :: subject
      character(len=56) :: claim
      character(len=96) :: reason
      !> Do readers of input only give a warning if the rule is broken?
      logical :: only_warns = .false.
   end type choice_rule

   type :: demand_list
      integer :: above_zero = 1, not_negative = 2, zero = 3, along_x = 4
   end type demand_list
   !> Conditions on a value
   type(demand_list), parameter :: demand = demand_list()
   character(len=48), parameter :: demand_text(*) = [character(len=48) :: "larger than 0", "0 or more", "0", &
      & "along x, 0 or 180 degrees within 0.01 rad,"]
   !> Sine of the maximum angle between rolling direction and x axis [-]
   real(wp), parameter :: along_x = 0.01_wp

   !> One rule: condition on a value for a combination of two choices
   type :: number_rule
      !> Members of choice_kind, and the values for which the rule holds
      integer :: choice, other
      integer :: values(list_length), others(list_length)
      !> Name of the value in the input, and its group
      character(len=8) :: number
      character(len=12) :: group
      !> Member of demand
      integer :: demand
      !> Member of error_kind
      integer :: kind
      !> Choice that requires the condition, and the reason
      character(len=112) :: subject
      character(len=96) :: reason
   end type number_rule

   ! lists of values, with their filling
   integer, parameter :: e(list_length) = nothing
   integer, parameter :: fastrip(3) = [material_model%fastrip, material_model%fastrip_plain, material_model%fastrip_sliding]
   integer, parameter :: full_theory(3) = [material_model%elastic, material_model%viscoelastic, material_model%interfacial_layer]
   integer, parameter :: hertzian(5) = [grid_form%hertz_curvatures, grid_form%hertz_curvature_ratio, grid_form%hertz_axes, &
      & grid_form%hertz_line_curvature, grid_form%hertz_line]
   integer, parameter :: still_or_steady(2) = [motion%none, motion%steady_rolling]
   integer, parameter :: no = 0, yes = 1

   !> All rules on combinations of choices
   type(choice_rule), parameter :: choice_rules(*) = [ &
      & choice_rule(choice_kind%material_model, choice_kind%motion, [material_model%viscoelastic, e(2:)], &
      & [motion%steady_rolling, e(2:)], 0, "viscoelastic material", "needs steady rolling", &
      & "its memory is that of a motion that does not change"), &
      & choice_rule(choice_kind%material_model, choice_kind%kernel, [material_model%viscoelastic, e(2:)], &
      & [kernel_model%piecewise_constant, e(2:)], 0, "viscoelastic material", "needs half-spaces with constant tractions", &
      & "other influence coefficients have no memory"), &
      & choice_rule(choice_kind%material_model, choice_kind%pressure, [material_model%viscoelastic, e(2:)], &
      & [pressure_model%full, pressure_model%thin_sheet, pressure_model%elliptical, pressure_model%parabolical, &
      & pressure_model%sdec, pressure_model%kpec], 0, "viscoelastic material", "cannot be used with ANALYN", &
      & "its pressures follow from one modulus; KPEC takes displacements with their memory"), &
      & choice_rule(choice_kind%material_model, choice_kind%pressure, [material_model%viscoelastic, e(2:)], &
      & [pressure_model%full, pressure_model%thin_sheet, pressure_model%sdec, pressure_model%kpec, e(5:)], 3, &
      & "viscoelastic material", "is meant for pressures that are solved for", &
      & "those on Hertz's ellipse are symmetric, and its size is that without memory", only_warns=.true.), &
      & choice_rule(choice_kind%material_model, choice_kind%motion, [fastrip, e(4:)], [still_or_steady, e(3:)], 0, "FaStrip", &
      & "needs steady rolling or no motion", "Fastsim can do shifts and transient rolling"), &
      & choice_rule(choice_kind%slip_source, choice_kind%material_model, &
      & [slip_source%no_spin_x, slip_source%no_spin_y, slip_source%given, e(4:)], &
      & [full_theory, material_model%fastsim_single, material_model%fastsim, e(6:)], 3, "an extra term in the rigid slip", &
      & "cannot be used with FaStrip", "its strips know creepages and spin only; Fastsim can do it"), &
      & choice_rule(choice_kind%heat, choice_kind%motion, [yes, e(2:)], [still_or_steady, e(3:)], 0, "surface temperatures", &
      & "need steady rolling or no motion", "they are those of a motion that does not change"), &
      & choice_rule(choice_kind%friction_law, choice_kind%heat, [friction_model%temperature, e(2:)], [yes, e(2:)], 0, &
      & "friction that changes with temperature", "needs surface temperatures", "it follows from them"), &
      & choice_rule(choice_kind%friction_law, choice_kind%material_model, [friction_model%temperature, e(2:)], &
      & [full_theory, e(4:)], 0, "friction that changes with temperature", "cannot be used with simplified theory", &
      & "its friction is found before its tractions"), &
      & choice_rule(choice_kind%force, choice_kind%motion, [force_control%longitudinal_force, e(2:)], &
      & [motion%shift, motion%transient_rolling, motion%steady_rolling, e(4:)], 1, "a prescribed longitudinal force", &
      & "needs a tangential problem", "without one there are no tangential forces"), &
      & choice_rule(choice_kind%force, choice_kind%motion, [force_control%massless_rail, e(2:)], &
      & [motion%shift, motion%transient_rolling, motion%steady_rolling, e(4:)], 1, "a rail on springs", &
      & "needs a tangential problem", "without one there are no lateral forces"), &
      & choice_rule(choice_kind%pressure, choice_kind%normal, [pressure_model%sdec, e(2:)], [normal_control%force, e(2:)], 3, &
      & "SDEC", "needs the normal force", "its pressures do not follow from an approach"), &
      & choice_rule(choice_kind%pressure, choice_kind%normal, [pressure_model%kpec, pressure_model%analyn, e(3:)], &
      & [normal_control%approach, e(2:)], 3, "KPEC or ANALYN", "needs the approach", &
      & "the full solution and Hertzian pressures take a force"), &
      & choice_rule(choice_kind%pressure, choice_kind%grid_form, [pressure_model%elliptical, pressure_model%parabolical, e(3:)], &
      & [hertzian, e(6:)], 3, "pressure on a Hertzian ellipse", "needs a Hertzian option", &
      & "the full solution does with any geometry"), &
      & choice_rule(choice_kind%pressure, choice_kind%grid_form, [pressure_model%sdec, e(2:)], [grid_form%half_ellipses, e(2:)], &
      & 3, "SDEC", "needs a grid around two half ellipses", "its pressures are those of these ellipses"), &
      & choice_rule(choice_kind%grid_form, choice_kind%pressure, [grid_form%half_ellipses, e(2:)], [pressure_model%sdec, e(2:)], &
      & 3, "a grid around two half ellipses", "needs the pressures of SDEC", &
      & "it has no undeformed distance to solve the normal problem for"), &
      & choice_rule(choice_kind%grid_form, choice_kind%normal, [grid_form%hertz_line_curvature, grid_form%hertz_line, e(3:)], &
      & [normal_control%force, e(2:)], 3, "a Hertzian line contact", "needs the normal force", &
      & "the approach of two-dimensional bodies depends on how far they reach"), &
      & choice_rule(choice_kind%grid_form, choice_kind%pressure, [grid_form%hertz_line_curvature, grid_form%hertz_line, e(3:)], &
      & [pressure_model%full, pressure_model%thin_sheet, pressure_model%kpec, pressure_model%analyn, e(5:)], 3, &
      & "a Hertzian line contact", "is meant for pressures that are solved for", &
      & "with those by formula the approach is not computed", only_warns=.true.), &
      & choice_rule(choice_kind%pressure, choice_kind%material_model, [pressure_model%parabolical, e(2:)], &
      & [material_model%fastsim_single, material_model%fastsim, material_model%interfacial_layer, fastrip], 3, &
      & "a parabolic traction bound", "is meant for simplified theory", "the full theory has the elliptical one", &
      & only_warns=.true.)]

   !> Conditions on values, for cases with both choices
   type(number_rule), parameter :: number_rules(*) = [ &
      & number_rule(choice_kind%grid_form, choice_kind%normal, [hertzian, e(6:)], [normal_control%approach, e(2:)], &
      & "PEN", "kinematics", demand%not_negative, error_kind%input, "a Hertzian option with a prescribed approach", &
      & "bodies apart have no contact ellipse"), &
      & number_rule(choice_kind%force, choice_kind%normal, [force_control%massless_rail, e(2:)], [normal_control%approach, e(2:)], &
      & "KZRAIL", "springs", demand%above_zero, error_kind%input, &
      & "a rail on springs with a prescribed height, tangential = ""massless_rail"" and normal = ""approach""", &
      & "nothing else carries the vertical force"), &
      & number_rule(choice_kind%kernel, choice_kind%motion, [kernel_model%conformal, kernel_model%tabulated, e(3:)], &
      & [motion%transient_rolling, motion%steady_rolling, e(3:)], "CHI", "rolling", demand%along_x, error_kind%input, &
      & "conformal contact and coefficients from a file, material.influence = ""conformal"" or ""tabulated""", &
      & "they know rolling along x only"), &
      & number_rule(choice_kind%material_model, choice_kind%motion, [material_model%fastsim_single, material_model%fastsim, &
      & material_model%fastrip, e(4:)], [motion%shift, e(2:)], "BETAMF", "material", demand%zero, error_kind%input, &
      & "slope reduction in a shift, motion = ""shift""", &
      & "it depends on creepages of rolling; ALFAMF = 1 does without it as well"), &
      & number_rule(choice_kind%friction_law, choice_kind%material_model, [friction_model%temperature, e(2:)], &
      & [material_model%interfacial_layer, e(2:)], "TAU_C0", "material", demand%zero, error_kind%unsupported, &
      & "friction that changes with temperature, friction.law = ""temperature""", &
      & "the heat of plastic work is not part of its iteration")]

contains

   !> Value of a choice of a case, member of its list in contact_base_choices; 0 or 1 for heat
   pure integer function value_of(spec, choice)
      !> The case
      type(case_spec), intent(in) :: spec
      !> Member of choice_kind
      integer, intent(in) :: choice

      select case (choice)
      case (choice_kind%pressure); value_of = spec%pressure
      case (choice_kind%motion); value_of = spec%motion
      case (choice_kind%normal); value_of = spec%normal
      case (choice_kind%force); value_of = spec%force
      case (choice_kind%friction_law); value_of = spec%friction_law
      case (choice_kind%kernel); value_of = spec%kernel
      case (choice_kind%material_model); value_of = spec%material_model
      case (choice_kind%slip_source); value_of = merge(slip_source%none, spec%slip_source, spec%motion == motion%none)
      case (choice_kind%heat); value_of = merge(yes, no, spec%has_heat)
      case (choice_kind%grid_form); value_of = merge(not_made, spec%grid%form, spec%grid%form == 0)
      case default; value_of = nothing
      end select
   end function value_of

   !> Does a case break a rule?
   pure logical function is_broken(rule, spec)
      !> Rule on choices
      type(choice_rule), intent(in) :: rule
      !> The case to check
      type(case_spec), intent(in) :: spec
      integer :: module_number

      is_broken = .false.
      if (any([value_of(spec, rule%choice), value_of(spec, rule%other)] == not_made)) return
      module_number = merge(1, 3, allocated(spec%wheel_rail))
      is_broken = (rule%module_number == 0 .or. rule%module_number == module_number) .and. &
         & any(rule%values == value_of(spec, rule%choice)) .and. all(rule%allowed /= value_of(spec, rule%other))
   end function is_broken

   !> Value to which a rule applies; 0 if it has no effect
   pure real(wp) function number_of(spec, name) result(number)
      type(case_spec), intent(in) :: spec
      !> Name as in the input
      character(len=*), intent(in) :: name

      number = 0.0_wp
      select case (name)
      case ("PEN"); number = spec%kinematics%pen
      case ("KZRAIL"); if (allocated(spec%wheel_rail)) number = spec%wheel_rail%rail%kz
      case ("CHI"); number = spec%rolling%chi
      case ("BETAMF"); if (spec%material%alfamf < 1.0_wp) number = spec%material%betamf
      case ("TAU_C0"); if (spec%has_plasticity()) number = spec%material%tau_c0
      end select
   end function number_of

   !> Does a value violate a condition?
   pure logical function is_missed(rule, spec)
      !> Rule on a value
      type(number_rule), intent(in) :: rule
      !> The case to check
      type(case_spec), intent(in) :: spec

      is_missed = .false.
      if (.not. (any(rule%values == value_of(spec, rule%choice)) .and. any(rule%others == value_of(spec, rule%other)))) return
      associate (number => number_of(spec, rule%number))
         select case (rule%demand)
         case (demand%above_zero); is_missed = .not. number > 0.0_wp
         case (demand%not_negative); is_missed = number < 0.0_wp
         case (demand%zero); is_missed = abs(number) > 0.0_wp
         case (demand%along_x); is_missed = abs(sin(number)) > along_x
         end select
      end associate
   end function is_missed

   !> "PEN = -0.1 must be 0 or more for a Hertzian option with a prescribed approach: ..."
   pure subroutine describe_number(rule, spec, text)
      !> Rule on a value
      type(number_rule), intent(in) :: rule
      !> The case that breaks it
      type(case_spec), intent(in) :: spec
      !> Name, value and accepted range
      character(len=:), allocatable, intent(out) :: text

      text = trim(rule%number) // " = " // real_text(number_of(spec, rule%number)) // " must be " // &
         & trim(demand_text(rule%demand)) // " for " // trim(rule%subject) // ": " // trim(rule%reason)
   end subroutine describe_number

   !> Refuse a case that breaks a rule, with a message in words
   subroutine refuse_broken_rules(spec, error)
      !> The case to check
      type(case_spec), intent(in) :: spec
      !> Allocated if a rule is broken, with its reason
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: text
      type(choice_rule) :: rule
      integer :: k

      do k = 1, size(choice_rules)
         rule = choice_rules(k)
         if (rule%only_warns .or. .not. is_broken(rule, spec)) cycle
         call fatal_error(error, trim(rule%subject) // " " // trim(rule%claim) // ": " // trim(rule%reason), error_kind%input)
         return
      end do
      do k = 1, size(number_rules)
         if (.not. is_missed(number_rules(k), spec)) cycle
         call describe_number(number_rules(k), spec, text)
         call fatal_error(error, text, number_rules(k)%kind)
         return
      end do
   end subroutine refuse_broken_rules
end module contact_cases_rules
