!> Checks that the groups a case keeps contain the numbers its choices need
!>
!> A choice may need numbers of a group that the case keeps. They have initial values if no earlier case has given them, and
!> kept velocities may belong to another kind of motion; neither may be used silently.
module contact_input_kept_numbers
   use contact_base_choices, only : force_control, material_model, motion, pressure_model, slip_source
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec, part_source
   use contact_input_control, only : add_for_digit, control_words
   use contact_input_problems, only : problem_list, severity
   implicit none (type, external)
   private

   public :: check_kept_numbers

   character(len=*), parameter :: materials = "the materials", track = "the track dimensions", velocities = "the velocities"

contains

   !> Report each choice whose numbers are kept, but were not given by any case
   subroutine check_kept_numbers(words, spec, problems)
      type(control_words), intent(in) :: words
      !> The case, after its groups were read
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems

      if (spec%parts%material /= part_source%given) call check_materials(words, spec, problems)
      if (allocated(spec%wheel_rail)) then
         call check_track(words, spec, problems)
         if (spec%parts%velocity /= part_source%given) call check_velocities(words, spec, problems)
         call check_rates(words, spec, problems)
         if (spec%parts%wheel_profile == part_source%given .and. spec%parts%flexibility /= part_source%given .and. &
            & any(abs([spec%wheel_rail%wheelset%flexible, spec%wheel_rail%wheelset%flexible_rate]) > 0.0_wp)) &
            & call add_for_digit(problems, words, severity%warning, "E", "the flexible deviations of the wheelset are kept " // &
            & "from an earlier case, although the case gives a new wheelset; deviations of 0 end them")
      else
         call check_slip(words, spec, problems)
         if (spec%motion >= motion%transient_rolling .and. spec%parts%material == part_source%renewed .and. &
            & .not. spec%given%rolling) call add_for_digit(problems, words, severity%warning, "C", "CHI, DQ and VELOC are " // &
            & "kept, but a case without rolling has set them to 0, 1 mm and 1 mm/s")
      end if
   end subroutine check_kept_numbers

   !> Numbers in the group of materials
   subroutine check_materials(words, spec, problems)
      type(control_words), intent(in) :: words
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems

      associate (given => spec%given)
         if (spec%pressure == pressure_model%thin_sheet) call require(given%sheet, "FLXZ", 'pressure = "thin_sheet"')
         if (spec%motion == motion%none) return
         select case (spec%material_model)
         case (material_model%viscoelastic)
            call require(given%viscoelastic, "FG and TC", 'material_model = "viscoelastic"')
         case (material_model%fastsim_single)
            call require(given%flexibility, "FLX", 'material_model = "fastsim_single"')
         case (material_model%fastsim)
            call require(given%slopes, "K0_MF, ALFAMF and BETAMF", 'material_model = "fastsim"')
         case (material_model%fastrip)
            call require(given%slopes, "K0_MF, ALFAMF and BETAMF", 'material_model = "fastrip"')
         case (material_model%interfacial_layer)
            call require(given%layer, "GG3, LAYTHK, TAU_C0 and K_TAU", 'material_model = "interfacial_layer"')
         end select
      end associate

   contains

      subroutine require(is_given, names, choice)
         !> Has a case given these numbers? Their names, and the choice that needs them
         logical, intent(in) :: is_given
         character(len=*), intent(in) :: names, choice

         if (.not. is_given) call report(words, problems, "C", names, choice, materials)
      end subroutine require
   end subroutine check_materials

   !> Numbers in the groups of the track and of the deviations of the rail
   subroutine check_track(words, spec, problems)
      type(control_words), intent(in) :: words
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems

      associate (given => spec%given)
         if (spec%force == force_control%massless_rail .and. .not. given%springs) call report(words, problems, "Z", &
            & "KYRAIL, FYRAIL, KZRAIL and FZRAIL", 'tangential = "massless_rail"', "the deviations of the rail")
         if (spec%wheel_rail%roller) then
            if (.not. given%roller_radius) call report(words, problems, "Z", "NOMRADR", "a roller", track)
         else
            if (.not. given%cant) call report(words, problems, "Z", "CANT", "a rail", track)
         end if
      end associate
   end subroutine check_track

   !> Numbers in the group of velocities, and their kind; without friction they are not used
   subroutine check_velocities(words, spec, problems)
      type(control_words), intent(in) :: words
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems

      if (spec%motion == motion%none) return
      associate (given => spec%given)
         if (spec%force == force_control%longitudinal_force) then
            if (.not. given%longitudinal_force) call report(words, problems, "E", "FX_WS", 'tangential = "longitudinal_force"', &
               & velocities)
         else
            if (.not. given%pitch_rate) call report(words, problems, "E", "VPITCH", "a prescribed pitch rate", velocities)
         end if
         if (spec%wheel_rail%roller) then
            if (.not. given%roller_rate) call report(words, problems, "E", "RPITCH", "a roller", velocities)
         else
            if (.not. given%speed) call report(words, problems, "E", "VS", "a rail", velocities)
         end if
         call check_kind(words, "E", velocities, given%are_shifts, spec%motion, problems)
      end associate
   end subroutine check_velocities

   !> Rates of the rail and of the flexible wheelset; without friction they are not used
   subroutine check_rates(words, spec, problems)
      type(control_words), intent(in) :: words
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems

      if (spec%motion == motion%none) return
      associate (rail => spec%wheel_rail%rail)
         if (spec%parts%deviations /= part_source%given .and. any(abs([rail%vy, rail%vz, rail%vroll]) > 0.0_wp)) &
            & call check_kind(words, "Z", "the velocities of the rail", spec%given%rail_shifts, spec%motion, problems)
      end associate
      if (spec%parts%flexibility /= part_source%given .and. any(abs(spec%wheel_rail%wheelset%flexible_rate) > 0.0_wp)) &
         & call check_kind(words, "E", "the velocities of the flexible deviations", spec%given%flexible_shifts, spec%motion, &
         & problems)
   end subroutine check_rates

   !> The extra rigid slip of the elements; without friction it is not used
   subroutine check_slip(words, spec, problems)
      type(control_words), intent(in) :: words
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems

      if (spec%motion == motion%none .or. spec%slip_source /= slip_source%given) return
      if (spec%parts%extra_slip == part_source%given .or. .not. allocated(spec%extra_slip)) return
      if (any(abs(spec%extra_slip) > 0.0_wp)) call check_kind(words, "E", "the values of the extra rigid slip", &
         & spec%given%slip_shifts, spec%motion, problems)
   end subroutine check_slip

   !> Report values that are kept although a change between shift and rolling has changed their meaning
   subroutine check_kind(words, digit, group, are_shifts, moves, problems)
      type(control_words), intent(in) :: words
      !> Digit that keeps the group, and its name
      character(len=*), intent(in) :: digit, group
      !> Were the values given for a shift?
      logical, intent(in) :: are_shifts
      !> Motion of the case, member of motion
      integer, intent(in) :: moves
      type(problem_list), intent(inout) :: problems

      if (are_shifts .neqv. moves == motion%shift) call add_for_digit(problems, words, severity%error, digit, group // &
         & " are kept, but in shifts they are displacements and rotations, in rolling rates: after a change between shift and " // &
         & "rolling new ones are needed")
   end subroutine check_kind

   !> Report numbers that no case has given
   subroutine report(words, problems, digit, names, choice, group)
      type(control_words), intent(in) :: words
      type(problem_list), intent(inout) :: problems
      !> Digit that keeps the group
      character(len=*), intent(in) :: digit
      !> Names of the numbers, the choice that needs them, and the group they belong to
      character(len=*), intent(in) :: names, choice, group

      call add_for_digit(problems, words, severity%error, digit, group // " are kept, but no case has given " // names // &
         & ", which " // choice // " needs")
   end subroutine report
end module contact_input_kept_numbers
