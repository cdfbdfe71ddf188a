!> Which choices of a case go together: each rule once, with its reason
!>
!> Readers of input and the library tell the digits or words of the choices that break a rule, `refuse_broken_rules` tells callers
!> that have neither, and the manual has a table of all rules.
module contact_cases_rules
   use contact_base_choices, only : force_control, kernel_model, material_model, motion, normal_control, &
      & pressure_model, slip_source
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_cases_spec, only : case_spec
   use contact_friction_new_law, only : friction_model
   implicit none (type, external)
   private

   public :: choice_kind, choice_rule, choice_rules, is_broken, refuse_broken_rules, value_of

   type :: choice_kind_list
      integer :: pressure = 1, motion = 2, normal = 3, force = 4, friction_law = 5, kernel = 6, material_model = 7
      integer :: slip_source = 8, heat = 9
   end type choice_kind_list
   !> The choices of a case that rules speak of
   type(choice_kind_list), parameter :: choice_kind = choice_kind_list()

   !> Most values of a list; shorter ones are filled with this number, which is no choice
   integer, parameter :: list_length = 6, nothing = -99

   !> One rule: a choice with one of some values goes with some values of another choice only
   type :: choice_rule
      !> Members of choice_kind
      integer :: choice, other
      !> Values for which the rule holds, and those of the other choice that go with them
      integer :: values(list_length), allowed(list_length)
      !> 1 or 3 for the cases of one module, 0 for all
      integer :: module_number
      !> What is chosen, "needs ..." or "cannot be used with ...", and the reason or what to use instead
      character(len=44) :: subject
      character(len=56) :: claim
      character(len=96) :: reason
   end type choice_rule

   ! lists of values, and what fills them
   integer, parameter :: e(list_length) = nothing
   integer, parameter :: fastrip(3) = [material_model%fastrip, material_model%fastrip_plain, material_model%fastrip_sliding]
   integer, parameter :: full_theory(3) = [material_model%elastic, material_model%viscoelastic, material_model%interfacial_layer]
   integer, parameter :: still_or_steady(2) = [motion%none, motion%steady_rolling]
   integer, parameter :: no = 0, yes = 1

   !> All rules
   type(choice_rule), parameter :: choice_rules(*) = [ &
      & choice_rule(choice_kind%material_model, choice_kind%motion, [material_model%viscoelastic, e(2:)], &
      & [motion%steady_rolling, e(2:)], 0, "viscoelastic material", "needs steady rolling", &
      & "its memory is that of a motion that does not change"), &
      & choice_rule(choice_kind%material_model, choice_kind%kernel, [material_model%viscoelastic, e(2:)], &
      & [kernel_model%piecewise_constant, e(2:)], 0, "viscoelastic material", "needs half-spaces with constant tractions", &
      & "other influence coefficients have no memory"), &
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
      & "the full solution and Hertzian pressures take a force")]

contains

   !> Value of a choice of a case, member of its list in contact_base_choices; 0 or 1 for heat
   pure integer function value_of(spec, choice)
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
      case default; value_of = nothing
      end select
   end function value_of

   !> Does a case break a rule?
   pure logical function is_broken(rule, spec)
      type(choice_rule), intent(in) :: rule
      type(case_spec), intent(in) :: spec
      integer :: module_number

      module_number = merge(1, 3, allocated(spec%wheel_rail))
      is_broken = (rule%module_number == 0 .or. rule%module_number == module_number) .and. &
         & any(rule%values == value_of(spec, rule%choice)) .and. all(rule%allowed /= value_of(spec, rule%other))
   end function is_broken

   !> Refuse a case that breaks a rule, in words
   subroutine refuse_broken_rules(spec, error)
      type(case_spec), intent(in) :: spec
      type(error_type), allocatable, intent(out) :: error
      type(choice_rule) :: rule
      integer :: k

      do k = 1, size(choice_rules)
         rule = choice_rules(k)
         if (.not. is_broken(rule, spec)) cycle
         call fatal_error(error, trim(rule%subject) // " " // trim(rule%claim) // ": " // trim(rule%reason), error_kind%input)
         return
      end do
   end subroutine refuse_broken_rules
end module contact_cases_rules
