!> Echo of the input of wheel and rail in the .out file (output level 2 and higher)
module contact_output_report_wheel_rail_input
   use contact_base_choices, only : force_control, has_slope_reduction, is_fastrip, is_simplified, kernel_model, &
      & material_model, motion, normal_control, pressure_model
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_collector, only : collector
   use contact_cases_rail_inputs, only : visit_deviations, visit_flexibility, visit_position, visit_search, &
      & visit_velocity
   use contact_cases_spec, only : case_spec, part_source
   use contact_control_digits, only : case_digits
   use contact_control_translation, only : digits_of
   use contact_output_formats, only : fixed, formatted, whole
   use contact_output_report_input, only : digit_words, write_last_digits, write_outer_iteration
   use contact_output_report_lines, only : show, write_row, write_title
   use contact_output_report_materials, only : write_constants, write_friction, write_material_model
   use contact_wheelrail_result, only : wheel_rail_result
   use contact_wheelrail_spec, only : profile_spec, rail_spec, search_spec, wheel_rail_spec, wheelset_spec
   implicit none (type, external)
   private

   public :: write_wheel_rail_input

   !> Deviations below this magnitude are omitted [mm] or [rad]
   real(wp), parameter :: no_deviation = 1.0e-10_wp

contains

   !> Write digits, problem, and all groups of the input that are given by the case
   subroutine write_wheel_rail_input(log, spec, result, patches)
      type(log_type), intent(inout) :: log
      !> The case as given in the input
      type(case_spec), intent(in) :: spec
      !> Result, for computed positions and velocities that the input does not prescribe
      type(wheel_rail_result), intent(in) :: result
      !> Number of contact patches
      integer, intent(in) :: patches
      character(len=:), allocatable :: body
      type(case_digits) :: digits

      body = trim(merge("ROLLER", "RAIL  ", spec%wheel_rail%roller))
      call write_title(log, " WHEEL-" // body // " CONTACT, " // trim(merge("LEFT ", "RIGHT", spec%wheel_rail%left)) // " WHEEL," &
         & // whole(patches, 3) // " CONTACT PATCH" // trim(merge("  ", "ES", patches == 1)))
      digits = digits_of(spec)
      call write_title(log, " CPBTNFS.  " // trim(digit_words(digits, 1, 7, .true.)))
      call log%result(" VLDCMZE.  " // trim(digit_words(digits, 8, 14, .true.)))
      call write_last_digits(log, digits)
      call write_problem(log, spec)
      if (spec%parts%material == part_source%given) call write_materials(log, spec, result)
      if (spec%motion /= motion%none .and. spec%parts%friction == part_source%given .and. allocated(spec%friction%sets)) &
         & call write_friction(log, spec%friction_law, spec%variation, spec%friction%sets, spec%output_level)
      if (spec%parts%search == part_source%given) call write_discretisation(log, spec%wheel_rail%search)
      if (spec%parts%rail_profile == part_source%given) call write_profile_choice(log, spec%wheel_rail%rail_profile, body, &
         & spec%output_level)
      if (spec%parts%track == part_source%given) call write_track(log, spec%wheel_rail)
      if (spec%parts%deviations == part_source%given) call write_rail(log, spec, result)
      if (spec%parts%wheel_profile == part_source%given) &
         & call write_profile_choice(log, spec%wheel_rail%wheel_profile, "WHEEL", spec%output_level)
      if (spec%parts%position == part_source%given) call write_wheelset(log, spec, result)
   end subroutine write_wheel_rail_input

   !> Describe the problem in words
   subroutine write_problem(log, spec)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      character(len=:), allocatable :: text

      text = " VERTICAL PROBLEM WITH PRESCRIBED POSITION, "
      if (spec%normal == normal_control%force) text = " VERTICAL PROBLEM WITH PRESCRIBED VERTICAL FORCE, "
      select case (spec%pressure)
      case (pressure_model%kpec)
         text = text // "APPROXIMATE KPEC SOLUTION"
      case (pressure_model%analyn)
         text = text // "APPROXIMATE ANALYN SOLUTION"
      case default
         text = text // "FULL SOLUTION"
      end select
      call log%result(text)
      if (spec%motion /= motion%none) then
         select case (spec%motion)
         case (motion%shift)
            text = " SHIFT TRANSIENT"
         case (motion%transient_rolling)
            text = " TRANSIENT ROLLING"
         case default
            text = " STEADY STATE ROLLING"
         end select
         if (any(spec%material_model == [material_model%fastsim_single, material_model%fastsim])) &
            & text = text // ', "FASTSIM APPROACH"'
         if (is_fastrip(spec%material_model)) text = text // ', "FASTRIP APPROACH"'
         if (spec%force == force_control%longitudinal_force) then
            text = text // ", X-FORCE PRESCRIBED"
         else if (spec%motion == motion%shift) then
            text = text // ", SHIFT PRESCRIBED"
         else
            text = text // ", CREEPAGE PRESCRIBED"
         end if
         call log%result(text)
      end if
      if (spec%kernel == kernel_model%conformal) then
         text = ", CONSTANT CURVATURE"
         if (spec%material%if_meth == 1) text = ", VARYING CURVATURE"
         call log%result(" USING CONFORMAL IF-CORRECTION: BLANCO(v" // whole(spec%material%variant, 1) // ")" // text)
      end if
      call write_outer_iteration(log, spec%outer_iterations())
   end subroutine write_problem

   !> Write material constants, damping, heat, and the thin sheet between the bodies
   subroutine write_materials(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      !> Result, for the combined constants
      type(wheel_rail_result), intent(in) :: result

      call write_constants(log, spec, [result%nu, result%gg, result%ak])
      associate (model => spec%material_model)
         if (model == material_model%elastic) return
         if (spec%motion == motion%none .and. model /= material_model%viscoelastic) return
         if (is_simplified(model) .and. .not. has_slope_reduction(model)) return
         call write_material_model(log, model, spec%material)
      end associate
   end subroutine write_materials

   !> Write settings of the contact search
   subroutine write_discretisation(log, search)
      type(log_type), intent(inout) :: log
      type(search_spec), intent(in) :: search
      type(collector) :: shown
      type(search_spec) :: copy
      logical :: own_turn

      own_turn = abs(search%d_turn - (2.0_wp*search%d_sep - search%d_comb)) > no_deviation
      copy = search
      call visit_search(shown, copy, with_step=.true.)
      call write_title(log, " DISCRETISATION PARAMETERS", " ")
      call show(log, shown, repeat("G", merge(7, 6, own_turn)))
   end subroutine write_discretisation

   !> Write a profile file and its processing
   subroutine write_profile_choice(log, profile, body, level)
      type(log_type), intent(inout) :: log
      type(profile_spec), intent(in) :: profile
      !> RAIL, ROLLER or WHEEL
      character(len=*), intent(in) :: body
      !> Output level
      integer, intent(in) :: level

      call write_title(log, " " // body // ' PROFILE "' // profile%name // '"', " ")
      call log%result("   MIRRORY     MIRRORZ     ISMOOTH      " // trim(merge("LAMBDA", "L_FILT", profile%smoothing_method == 0)))
      call log%result(whole(profile%mirror_y, 7) // whole(profile%mirror_z, 12) // whole(profile%smoothing_method, 12) &
         & // "   " // fixed(profile%smoothing, 12, 4))
      if (level < 3) return
      call write_title(log, "   ZIGTHRS     KINKHIG     KINKLOW      KINKWID     MAXOMIT", " ")
      call log%result("  " // formatted([profile%zigzag, profile%kink_high, profile%kink_low, profile%kink_width, &
         & profile%largest_omission], "G"))
   end subroutine write_profile_choice

   subroutine write_track(log, pair)
      type(log_type), intent(inout) :: log
      type(wheel_rail_spec), intent(in) :: pair

      call write_title(log, " TRACK DIMENSIONS AND RAIL POSITION", " ")
      associate (track => pair%track)
         if (track%gaught > 0.0_wp) then
            call log%result("    GAUGHT      GAUGWD        CANT        CURV")
            call log%result(fixed(track%gaught, 10, 3) // fixed(track%gaugwd, 12, 3) // formatted([track%cant, track%curvature], &
               & "FS"))
         else
            call log%result("    GAUGHT      RAILY0      RAILZ0        CANT        CURV")
            call log%result(fixed(track%gaught, 10, 3) // formatted([track%raily0, track%railz0, track%cant, track%curvature], &
               & "FFFS"))
         end if
      end associate
   end subroutine write_track

   !> Write deviations of the rail, and the deflection of its springs
   subroutine write_rail(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_result), intent(in) :: result
      type(collector) :: shown
      type(rail_spec) :: copy

      associate (rail => spec%wheel_rail%rail)
         if (any(abs([rail%dy, rail%dz, rail%roll, rail%vy, rail%vz, rail%vroll]) > no_deviation)) then
            copy = rail
            call visit_deviations(shown, copy)
            call write_title(log, " RAIL IRREGULARITY", " ")
            call show(log, shown, "FFFSSS")
         end if
         if (spec%force /= force_control%massless_rail) return
         call write_title(log, " MASSLESS RAIL DEFLECTION", " ")
         call write_row(log, "KY_RAIL DY_DEFL FY_RAIL KZ_RAIL DZ_DEFL FZ_RAIL", [rail%ky, &
            & merge(-1, 1, spec%wheel_rail%left)*result%dy_defl, rail%fy, rail%kz, result%dz_defl, rail%fz], "FFSFFS")
      end associate
   end subroutine write_rail

   !> Write position and velocity of the wheelset, prescribed or computed, and its flexible deviations
   subroutine write_wheelset(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_result), intent(in) :: result
      type(collector) :: place, rates, flexible
      type(wheelset_spec) :: copy

      copy = spec%wheel_rail%wheelset
      associate (roller => spec%wheel_rail%roller)
         call visit_position(place, copy, roller, with_force=.false.)
         call visit_velocity(rates, copy, roller, with_force=.false.)
         call write_title(log, " WHEEL-SET POSITION AND VELOCITY")
         place%names(4:) = [character(len=8) :: "ROLL_WS", "YAW_WS", "PITCH_WS"]
         place%values(3) = result%z_ws
         call show(log, place, merge("S", "L", roller) // "SFSSS")
         rates%values(6) = result%vpitch
         if (roller) then
            call write_title(log, "  VPITCH_ROL    VY_WS       VZ_WS       VROLL_WS    VYAW_WS     VPITCH_WS")
         else
            call write_title(log, "     VX_WS       VY_WS       VZ_WS       VROLL_WS    VYAW_WS     VPITCH_WS")
         end if
         call log%result("  " // formatted(rates%values, merge("P", "S", roller) // "SSSSP"))
         call log%result("")
      end associate
      if (.not. any(abs([copy%flexible, copy%flexible_rate]) > no_deviation)) return
      call log%result(" FLEXIBLE WHEEL-SET DEVIATIONS")
      call visit_flexibility(flexible, copy)
      call show(log, flexible, "SSSSSS")
      call show(log, flexible, "SSSSSS", first=7)
      call log%result("")
   end subroutine write_wheelset
end module contact_output_report_wheel_rail_input
