!> Time of a case with a prescribed accuracy: expected time per element, and grids for which there is time before the deadline
!>
!> Times were measured with random contacts and wheels by tests/accuracy/cost.py (seeds 99821, 99991 and 99992, falling friction
!> with 88111 and 88112, 1e-2 to 2e-4), for the first case of its size in a process, including the plans of transforms, with the
!> build of 2026-11-27, on the machine whose speed is the unit of contact_cases_machine_pace. Single contacts take half or twice
!> the time.
module contact_cases_accuracy_time
   use contact_base_choices, only : force_control, material_model, motion
   use contact_base_kinds, only : wp
   use contact_base_limits, only : case_limits
   use contact_cases_spec, only : case_spec, part_source
   use contact_elastic_material, only : combine, combined_material
   use contact_friction_new_law, only : is_varying_law
   implicit none (type, external)
   private

   public :: constant_time, has_outer_iterations, input_time, most_in_time, reading_time, time_is_left, time_per_element

   !> All grids of a case, time per element of the last one [s]: pressures; with tractions of a shift; in rolling; of a wheel, whose
   !> height is searched
   real(wp), parameter :: with_pressures = 0.8e-6_wp, with_shift = 1.7e-6_wp, with_rolling = 2.4e-6_wp, with_wheel = 4.3e-6_wp
   !> Time of each case, of files of profiles, of each value of a profile, and of coefficients of viscoelastic bodies [s]
   real(wp), parameter :: each_case = 1.1e-3_wp, each_files = 3.5e-3_wp, each_value = 1.75e-6_wp, each_memory = 1.0e-3_wp
   !> Factors of the time: outer iterations; viscoelastic bodies; trials for prescribed forces; friction that varies with slip; an
   !> interfacial layer, which needs few iterations; potential contacts of profiles, of which contact covers a smaller part
   real(wp), parameter :: outer_iterations = 1.8_wp, remembering = 1.3_wp, trials = 1.1_wp, changing_friction = 1.5_wp, &
      & with_layer = 0.6_wp, partly_covered = 0.7_wp
   !> Fraction of the remaining time that the first grid may be expected to take: slow machines and slow contacts take several times
   !> what is expected, and a case without a first grid has no result; chosen
   real(wp), parameter :: first_share = 0.015_wp
   !> Number of elements of a first grid that is tried in any time; chosen
   real(wp), parameter :: fewest = 200.0_wp
   !> Exponent of the number of elements in the time of a grid, and factor of reserve, to decide if there is time for another grid
   real(wp), parameter :: time_power = 1.1_wp, reserve = 1.2_wp

contains

   !> Expected time of all grids of a case per element of the last one [s]
   real(wp) function time_per_element(spec) result(rate)
      !> Case with an accuracy
      type(case_spec), intent(in) :: spec

      rate = with_rolling
      if (spec%motion == motion%shift) rate = with_shift
      if (spec%motion == motion%none) rate = with_pressures
      if (allocated(spec%wheel_rail)) rate = with_wheel
      if (has_outer_iterations(spec)) rate = outer_iterations*rate
      if (allocated(spec%geometry%profile)) rate = partly_covered*rate
      if (spec%motion == motion%none) return
      if (spec%material_model == material_model%viscoelastic) rate = remembering*rate
      if (spec%material_model == material_model%interfacial_layer) rate = with_layer*rate
      if (is_varying_law(spec%friction_law)) rate = changing_friction*rate
      if (spec%force /= force_control%creepages .and. .not. allocated(spec%wheel_rail)) rate = trials*rate
   end function time_per_element

   !> Expected time that does not depend on the number of elements [s]
   pure real(wp) function constant_time(spec) result(seconds)
      !> Case with an accuracy
      type(case_spec), intent(in) :: spec

      seconds = input_time(spec)
      if (spec%material_model == material_model%viscoelastic) seconds = seconds + each_memory
   end function constant_time

   !> Expected time before and after the solutions [s]
   pure real(wp) function input_time(spec) result(seconds)
      !> Case with an accuracy
      type(case_spec), intent(in) :: spec

      seconds = each_case + reading_time(spec)
   end function input_time

   !> Time of profiles that a case gives: values in the input, files of wheel and rail [s]
   pure real(wp) function reading_time(spec) result(seconds)
      !> Case, with or without an accuracy
      type(case_spec), intent(in) :: spec

      seconds = 0.0_wp
      if (allocated(spec%wheel_rail)) then
         if (spec%wheel_rail%new_rail_profile .or. spec%wheel_rail%new_wheel_profile) seconds = each_files
      else if (allocated(spec%geometry%profile) .and. spec%parts%geometry /= part_source%kept) then
         seconds = each_value*size(spec%geometry%profile)
      end if
   end function reading_time

   !> Are there several outer iterations, between pressures and tractions?
   pure logical function has_outer_iterations(spec)
      !> Case
      type(case_spec), intent(in) :: spec
      type(combined_material) :: material

      material = combine(spec%material%poiss, spec%material%gg)
      has_outer_iterations = material%coupled() .and. spec%motion /= motion%none .and. spec%outer_iterations() > 1
   end function has_outer_iterations

   !> Maximum number of elements of the first grid, so that it ends before the deadline also on a slow machine; huge without one
   real(wp) function most_in_time(spec) result(most)
      !> Case with an accuracy, whose deadline has been started
      type(case_spec), intent(in) :: spec
      real(wp) :: left

      most = huge(1.0_wp)
      left = spec%limits%deadline%left()
      if (left < huge(1.0_wp)) most = max(fewest, first_share*(left - constant_time(spec))/time_per_element(spec))
   end function most_in_time

   !> Is there time for a grid of more elements?
   logical function time_is_left(limits, seconds, ratio)
      !> Limits of the case: elements, memory, time
      type(case_limits), intent(in) :: limits
      !> Time of the present grid [s]
      real(wp), intent(in) :: seconds
      !> Ratio of the number of elements of the next grid to that of the present one
      real(wp), intent(in) :: ratio

      time_is_left = reserve*seconds*ratio**time_power <= limits%deadline%left()
   end function time_is_left
end module contact_cases_accuracy_time
