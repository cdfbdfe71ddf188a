!> Wheel on rail in the .out file: echo of the input, total forces, contact patches
!>
!> The calculation is that of a right-hand pair; for the left side of the track the values that
!> depend on it are mirrored here.
module contact_output_report_wheel_rail
   use contact_base_case_status, only : case_status
   use contact_base_choices, only : contact_location, has_slope_reduction, is_fastrip, is_simplified, kernel_model, &
      & material_model, motion, normal_control, pressure_model, time_link, variation
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_spec, only : case_spec, material_spec, part_source
   use contact_control_digits, only : case_digits
   use contact_control_translation, only : digits_of
   use contact_grid_element_division, only : bounding_box, contact_box
   use contact_wheelrail_spec, only : profile_spec, wheel_rail_spec
   use contact_output_element_table, only : write_element_table
   use contact_output_formats, only : fixed, fixeds, general, generals, heading, smart, smarts, whole
   use contact_grid_picture, only : write_picture
   use contact_output_report_input, only : write_friction, write_sheet
   use contact_output_report_result, only : ending_text, remove_noise, write_solution_line, write_statistics, &
      & write_total_lines
   use contact_output_report_subsurface, only : write_subsurface
   use contact_patch_quantities, only : total_list
   use contact_patch_result, only : patch_result
   use contact_wheelrail_result, only : in_element_coordinates, wheel_rail_patch, wheel_rail_result
   implicit none (type, external)
   private

   public :: write_wheel_rail

   !> Deviations below this magnitude are not echoed [mm] or [rad]
   real(wp), parameter :: no_deviation = 1.0e-10_wp

contains

   !> Everything of a case of module 1 behind its flow trace
   subroutine write_wheel_rail(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_result), intent(in) :: result
      integer :: k, patches

      if (.not. log%out%is_open() .and. log%screen == 0) return
      patches = 0
      if (allocated(result%patches)) patches = size(result%patches)
      if (spec%output_level >= 1) then
         if (spec%output_level >= 2) call write_echo(log, spec, result, patches)
         if (patches == 0) then
            call log%line("")
            call log%line(" ------------ NO CONTACT FOUND FOR THIS WHEEL / WHEEL-SET ------------")
         end if
         call write_total_forces(log, spec, result)
         if (patches == 0 .and. .not. result%status%is_solved()) call log%result(ending_text(result%status))
      end if
      do k = 1, patches
         call write_patch(log, spec, result%patches(k), k, result%status)
      end do
      if (spec%output_level >= 4) call write_profiles(log, spec, result)
   end subroutine write_wheel_rail

   !> Digits, problem, and all groups of the input that the case gave
   subroutine write_echo(log, spec, result, patches)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_result), intent(in) :: result
      !> Number of contact patches
      integer, intent(in) :: patches
      character(len=:), allocatable :: body

      body = trim(merge("ROLLER", "RAIL  ", spec%wheel_rail%roller))
      call log%result("")
      call log%result(" WHEEL-" // body // " CONTACT, " // trim(merge("LEFT ", "RIGHT", spec%wheel_rail%left)) // " WHEEL," &
         & // whole(patches, 3) // " CONTACT PATCH" // trim(merge("  ", "ES", patches == 1)))
      call log%result("")
      call write_digits(log, digits_of(spec))
      call write_problem(log, spec)
      if (spec%parts%material == part_source%given) call write_materials(log, spec, result)
      if (spec%motion /= motion%none .and. spec%parts%friction == part_source%given .and. allocated(spec%friction%sets)) &
         & call write_friction(log, spec%friction_law, spec%variation, spec%friction%sets, spec%output_level)
      if (spec%parts%search == part_source%given) call write_discretisation(log, spec%wheel_rail)
      if (spec%parts%rail_profile == part_source%given) call write_profile_choice(log, spec%wheel_rail%rail_profile, body, &
         & spec%output_level)
      if (spec%parts%track == part_source%given) call write_track(log, spec%wheel_rail)
      if (spec%parts%deviations == part_source%given) call write_rail(log, spec, result)
      if (spec%parts%wheel_profile == part_source%given) &
         & call write_profile_choice(log, spec%wheel_rail%wheel_profile, "WHEEL", spec%output_level)
      if (spec%parts%position == part_source%given) call write_wheelset(log, spec, result)
   end subroutine write_echo

   !> Control digits as given
   subroutine write_digits(log, digits)
      type(log_type), intent(inout) :: log
      type(case_digits), intent(in) :: digits

      call log%result(" CPBTNFS.  CONFIG" // whole(digits%c1, 2) // ", PVTIME" // whole(digits%p, 2) // ", BOUND " &
         & // whole(digits%b, 2) // ", TANG  " // whole(digits%t, 2) // ", NORM  " // whole(digits%n, 2) // ", FORCE " &
         & // whole(digits%f, 2) // ", STRESS" // whole(digits%s, 2))
      call log%result(" VLDCMZE.  VARFRC" // whole(digits%v, 2) // ", FRCLAW" // whole(digits%l, 2) // ", DISCNS" &
         & // whole(digits%d + 10*digits%gapwgt, 2) // ", INFLCF" // whole(digits%c, 2) // ", MATER " // whole(digits%m, 2) &
         & // ", ZTRACK" // whole(digits%z, 2) // ", EWHEEL" // whole(digits%e, 2))
      call log%result(" HGIAOWR.  HEAT  " // whole(digits%h, 2) // ", GAUSEI" // whole(digits%g, 2) // ", IESTIM" &
         & // whole(digits%i, 2) // ", MATFIL" // whole(digits%a, 2) // ", OUTPUT" // whole(digits%o, 2) // ", FLOW  " &
         & // whole(digits%w, 2) // ", RETURN" // whole(digits%r, 2))
   end subroutine write_digits

   !> What problem is solved, in words
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
         if (spec%force == 1) then
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
      if (spec%iteration%maxout <= 1) then
         call log%result(" JOHNSON'S METHOD: NORMAL AND TANGENTIAL PROBLEM ARE SOLVED ONCE")
      else
         call log%result(" PANAGIOTOPOULOS' METHOD: NORMAL AND TANGENTIAL PROBLEM ALTERNATE. MAXOUT=" &
            & // whole(spec%iteration%maxout, 3))
      end if
   end subroutine write_problem

   !> Material constants, damping, heat, and what lies between the bodies
   subroutine write_materials(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      !> For the combined constants
      type(wheel_rail_result), intent(in) :: result
      integer :: body
      logical :: has_plastic_heat

      call log%result("")
      call log%result(" MATERIAL CONSTANTS")
      call log%result(heading([character(len=9) :: "NU", "G", "AK", "EPS"]))
      call log%result("  " // general(result%nu, 12, 4) // smarts([result%gg]) // general(result%ak, 12, 4) &
         & // smarts([spec%iteration%eps]))
      call log%result("")
      call log%result("    POISS(R)    POISS(W)     GG(R)       GG(W)")
      call log%result("  " // generals(spec%material%poiss) // smarts(spec%material%gg))
      if (spec%pressure == pressure_model%thin_sheet) call write_sheet(log, spec%material)
      if (spec%has_damping .and. spec%parts%damping == part_source%given) then
         call log%result("")
         call log%result(heading([character(len=9) :: "CDAMPN", "CDAMPT", "DFNMAX", "DFTMAX"]))
         call log%result("  " // smarts([spec%damping%cdampn, spec%damping%cdampt, spec%damping%dfnmax, spec%damping%dftmax]))
      end if
      if (spec%has_heat) then
         has_plastic_heat = spec%material_model == material_model%interfacial_layer
         call log%result("")
         if (has_plastic_heat) then
            call log%result(heading([character(len=9) :: "BKTEMP", "HEATCP", "LAMBDA", "DENSITY", "BETAPL"]))
         else
            call log%result(heading([character(len=9) :: "BKTEMP", "HEATCP", "LAMBDA", "DENSITY"]))
         end if
         do body = 1, 2
            associate (heat => spec%heat)
               if (has_plastic_heat .and. body == 1) then
                  call log%result("  " // generals([heat%bktemp(1), heat%heatcp(1), heat%lambda(1), heat%dens(1), heat%betapl]))
               else
                  call log%result("  " // generals([heat%bktemp(body), heat%heatcp(body), heat%lambda(body), heat%dens(body)]))
               end if
            end associate
         end do
      end if
      call write_material_model(log, spec%material, spec%material_model, spec%motion)
   end subroutine write_materials

   !> Constants of other than elastic behaviour
   subroutine write_material_model(log, material, model, relative_motion)
      type(log_type), intent(inout) :: log
      type(material_spec), intent(in) :: material
      !> Members of material_model and motion
      integer, intent(in) :: model, relative_motion
      character(len=7) :: method

      if (model == material_model%elastic) return
      if (relative_motion == motion%none .and. model /= material_model%viscoelastic) return
      if (is_simplified(model) .and. .not. has_slope_reduction(model)) return
      call log%result("")
      select case (model)
      case (material_model%viscoelastic)
         call log%result(" VISCOELASTIC MATERIAL CONSTANTS")
         call log%result(heading([character(len=9) :: "FG(1)", "FG(2)", "TC(1)", "TC(2)"]))
         call log%result("  " // generals(material%fg) // smarts(material%tc))
      case (material_model%interfacial_layer)
         call log%result(" INTERFACIAL LAYER PARAMETERS")
         call log%result(heading([character(len=9) :: "GG3", "LAYTHK", "TAU_C0", "K_TAU"]))
         call log%result("  " // generals([material%gg3, material%laythk, material%tau_c0, material%k_tau]))
      case default
         if (model == material_model%fastsim_single) then
            call log%result(" SIMPLIFIED THEORY MATERIAL CONSTANTS")
            call log%result(heading([character(len=9) :: "FLX"]))
            call log%result("  " // generals([material%flx]))
            call log%result("")
         end if
         method = "FASTSIM"
         if (is_fastrip(model)) method = "FASTRIP"
         call log%result(" MODIFIED " // method // " SLOPE REDUCTION PARAMETERS")
         call log%result(heading([character(len=9) :: "K0_MF", "ALFAMF", "BETAMF"]))
         call log%result("  " // generals([material%k0_mf, material%alfamf, material%betamf]))
      end select
   end subroutine write_material_model

   subroutine write_discretisation(log, pair)
      type(log_type), intent(inout) :: log
      type(wheel_rail_spec), intent(in) :: pair
      logical :: own_turn

      associate (search => pair%search)
         own_turn = abs(search%d_turn - (2.0_wp*search%d_sep - search%d_comb)) > no_deviation
         call log%result(" ")
         call log%result(" DISCRETISATION PARAMETERS")
         if (own_turn) then
            call log%result(heading([character(len=9) :: "DX", "DS", "DQREL", "A_SEP", "D_SEP", "D_COMB", "D_TURN"]))
            call log%result("  " // generals([search%dx, search%ds, search%dqrel, search%a_sep, search%d_sep, search%d_comb, &
               & search%d_turn]))
         else
            call log%result(heading([character(len=9) :: "DX", "DS", "DQREL", "A_SEP", "D_SEP", "D_COMB"]))
            call log%result("  " // generals([search%dx, search%ds, search%dqrel, search%a_sep, search%d_sep, search%d_comb]))
         end if
      end associate
   end subroutine write_discretisation

   !> A profile file and its processing
   subroutine write_profile_choice(log, profile, body, level)
      type(log_type), intent(inout) :: log
      type(profile_spec), intent(in) :: profile
      !> RAIL, ROLLER or WHEEL
      character(len=*), intent(in) :: body
      !> Output level
      integer, intent(in) :: level

      call log%result(" ")
      call log%result(" " // body // ' PROFILE "' // profile%name // '"')
      call log%result("   MIRRORY     MIRRORZ     ISMOOTH      " // trim(merge("LAMBDA", "L_FILT", profile%smoothing_method == 0)))
      call log%result(whole(profile%mirror_y, 7) // whole(profile%mirror_z, 12) // whole(profile%smoothing_method, 12) &
         & // "   " // fixed(profile%smoothing, 12, 4))
      if (level < 3) return
      call log%result(" ")
      call log%result("   ZIGTHRS     KINKHIG     KINKLOW      KINKWID     MAXOMIT")
      call log%result("  " // generals([profile%zigzag, profile%kink_high, profile%kink_low, profile%kink_width, &
         & profile%largest_omission]))
   end subroutine write_profile_choice

   subroutine write_track(log, pair)
      type(log_type), intent(inout) :: log
      type(wheel_rail_spec), intent(in) :: pair

      call log%result(" ")
      call log%result(" TRACK DIMENSIONS AND RAIL POSITION")
      associate (track => pair%track)
         if (track%gaught > 0.0_wp) then
            call log%result("    GAUGHT      GAUGWD        CANT        CURV")
            call log%result(fixed(track%gaught, 10, 3) // fixed(track%gaugwd, 12, 3) // fixed(track%cant, 12, 4) &
               & // smart(track%curvature, 12, 4, 4))
         else
            call log%result("    GAUGHT      RAILY0      RAILZ0        CANT        CURV")
            call log%result(fixed(track%gaught, 10, 3) // fixed(track%raily0, 12, 4) // fixed(track%railz0, 12, 4) &
               & // fixed(track%cant, 12, 4) // smart(track%curvature, 12, 4, 4))
         end if
      end associate
   end subroutine write_track

   !> Deviations of the rail, and the deflection of its springs
   subroutine write_rail(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_result), intent(in) :: result

      associate (rail => spec%wheel_rail%rail)
         if (any(abs([rail%dy, rail%dz, rail%roll, rail%vy, rail%vz, rail%vroll]) > no_deviation)) then
            call log%result(" ")
            call log%result(" RAIL IRREGULARITY")
            call log%result(heading([character(len=9) :: "DYRAIL", "DZRAIL", "DROLLR", "VYRAIL", "VZRAIL", "VROLLR"]))
            call log%result("  " // fixed(rail%dy, 12, 4) // fixed(rail%dz, 12, 4) // fixed(rail%roll, 12, 4) &
               & // smarts([rail%vy, rail%vz, rail%vroll]))
         end if
         if (spec%force /= 3) return
         call log%result(" ")
         call log%result(" MASSLESS RAIL DEFLECTION")
         call log%result(heading([character(len=9) :: "KY_RAIL", "DY_DEFL", "FY_RAIL", "KZ_RAIL", "DZ_DEFL", "FZ_RAIL"]))
         call log%result("  " // fixed(rail%ky, 12, 4) // fixed(sign_of(spec)*result%dy_defl, 12, 4) // smarts([rail%fy]) &
            & // fixed(rail%kz, 12, 4) // fixed(result%dz_defl, 12, 4) // smarts([rail%fz]))
      end associate
   end subroutine write_rail

   !> Position and velocity of the wheelset, given or found, and its flexible deviations
   subroutine write_wheelset(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_result), intent(in) :: result

      associate (w => spec%wheel_rail%wheelset, roller => spec%wheel_rail%roller)
         call log%result("")
         call log%result(" WHEEL-SET POSITION AND VELOCITY")
         call log%result("     " // trim(merge("X_WS", "S_WS", roller)) &
            & // "        Y_WS        Z_WS        ROLL_WS     YAW_WS      PITCH_WS")
         if (roller) then
            call log%result("  " // smarts([w%x, w%y]) // fixed(result%z_ws, 12, 4) // smarts([w%roll, w%yaw, w%pitch]))
         else
            call log%result("  " // smart(w%s, 12, 4, 6) // smarts([w%y]) // fixed(result%z_ws, 12, 4) &
               & // smarts([w%roll, w%yaw, w%pitch]))
         end if
         call log%result("")
         if (roller) then
            call log%result("  VPITCH_ROL    VY_WS       VZ_WS       VROLL_WS    VYAW_WS     VPITCH_WS")
            call log%result("  " // fixed(w%rpitch, 12, 7) // smarts([w%vy, w%vz, w%vroll, w%vyaw]) // fixed(result%vpitch, 12, 7))
         else
            call log%result("     VX_WS       VY_WS       VZ_WS       VROLL_WS    VYAW_WS     VPITCH_WS")
            call log%result("  " // smarts([w%vs, w%vy, w%vz, w%vroll, w%vyaw]) // fixed(result%vpitch, 12, 7))
         end if
         call log%result("")
         if (.not. any(abs([w%flexible, w%flexible_rate]) > no_deviation)) return
         call log%result(" FLEXIBLE WHEEL-SET DEVIATIONS")
         call log%result("     DXWHL       DYWHL       DZWHL       DROLLW      DYAWW       DPITCHW")
         call log%result("  " // smarts(w%flexible))
         call log%result("     VXWHL       VYWHL       VZWHL       VROLLW      VYAWW       VPITCHW")
         call log%result("  " // smarts(w%flexible_rate))
         call log%result("")
      end associate
   end subroutine write_wheelset

   !> -1 for the left side of the track
   pure real(wp) function sign_of(spec)
      type(case_spec), intent(in) :: spec
      sign_of = merge(-1.0_wp, 1.0_wp, spec%wheel_rail%left)
   end function sign_of

   !> Forces and moments on the rail of all patches together
   subroutine write_total_forces(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_result), intent(in) :: result
      character(len=:), allocatable :: body
      type(total_list) :: totals

      call result%totals(spec%wheel_rail, totals)
      body = trim(merge("ROLLER", "RAIL  ", spec%wheel_rail%roller))
      if (spec%output_level >= 4) then
         call log%result(" ")
         call log%result(" TOTAL FORCES AND MOMENTS ON " // body)
      else if (spec%output_level >= 2) then
         call log%result("")
         call log%result(" TOTAL FORCES ON " // body)
      end if
      call log%result("     FX(TR)      FY(TR)      FZ(TR)      FX(WS)      FY(WS)      FZ(WS)")
      call log%result(smarts(totals%of(["fx_tr", "fy_tr", "fz_tr", "fx_ws", "fy_ws", "fz_ws"])))
      if (spec%output_level < 4) return
      call log%result("")
      call log%result("     MX@R(TR)    MY@R(TR)    MZ@R(TR)    MX@W(WS)    MY@W(WS)    MZ@W(WS)")
      call log%result(smarts(totals%of(["mx_r_tr", "my_r_tr", "mz_r_tr", "mx_w_ws", "my_w_ws", "mz_w_ws"])))
   end subroutine write_total_forces

   !> One contact patch
   subroutine write_patch(log, spec, patch, number, status)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_patch), intent(in) :: patch
      integer, intent(in) :: number
      !> How the case ended
      type(case_status), intent(in) :: status
      character(len=:), allocatable :: origin
      type(total_list) :: totals
      real(wp) :: s
      integer :: k

      if (spec%output_level >= 1) then
         s = sign_of(spec)
         call patch%totals(totals, spec%wheel_rail%left)
         origin = ""
         if (spec%link /= time_link%initiate) then
            origin = " (NEW PATCH)"
            if (allocated(patch%previous)) then
               if (size(patch%previous) > 0) then
                  origin = " (PREV" // whole(patch%previous(1), 3)
                  do k = 2, size(patch%previous)
                     origin = origin // "," // whole(patch%previous(k), 3)
                  end do
                  origin = origin // ")"
               end if
            end if
         end if
         call log%result("")
         call log%result(" ----- DATA FOR CONTACT PATCH" // whole(number, 3) // origin // " -----")
         if (spec%output_level >= 2) then
            call write_reference(log, totals)
            if (allocated(patch%curve)) call write_curved_contact(log, patch, s)
            call write_patch_friction(log, spec, patch)
            if (spec%motion /= motion%none) call write_patch_flexibility(log, spec%material_model, patch%contact)
            call write_patch_kinematics(log, patch, s)
         end if
         call write_patch_totals(log, spec, patch, totals)
         if (spec%output_level >= 2) call write_statistics(log, spec, patch%contact)
         call write_solution_line(log, spec, patch%contact, status)
         if (spec%output_level >= 3) then
            call write_picture(log, patch%contact%division, spec%motion, patch%contact%chi)
            if (allocated(patch%curve)) call write_curve(log, patch, s)
         end if
         if (spec%output_level >= 5) call write_element_table(log, spec, in_element_coordinates(patch))
      end if
      if (spec%has_stress .and. allocated(patch%contact%subsurface)) &
         & call write_subsurface(log, spec, patch%contact)
   end subroutine write_patch

   !> Place of the contact reference in track, rail and wheel
   subroutine write_reference(log, totals)
      type(log_type), intent(inout) :: log
      !> Of the patch
      type(total_list), intent(in) :: totals

      call log%result("")
      call log%result(" CONTACT REFERENCE LOCATION")
      call log%result("     XCP(TR)     YCP(TR)     ZCP(TR)    DELTCP(TR)   YCP(R)      ZCP(R)")
      call log%result(fixeds(totals%of([character(len=9) :: "xcp_tr", "ycp_tr", "zcp_tr", "deltcp_tr", "ycp_r", "zcp_r"])))
      call log%result("")
      call log%result("     XCP(W)      YCP(W)      ZCP(W)")
      call log%result(fixeds(totals%of(["xcp_w", "ycp_w", "zcp_w"])))
   end subroutine write_reference

   !> How far the contact area reaches on its curved reference, the angles there, and the moments in the reference's axes
   subroutine write_curved_contact(log, patch, s)
      type(log_type), intent(inout) :: log
      type(wheel_rail_patch), intent(in) :: patch
      !> -1 for the left side
      real(wp), intent(in) :: s
      type(bounding_box) :: box
      real(wp), parameter :: degree = pi/180.0_wp
      real(wp) :: range(2)

      box = contact_box(patch%contact%division)
      call log%line("")
      if (box%iy1 >= box%iy0) then
         associate (grid => patch%contact%grid)
            range = s*[grid%y(box%iy0) - 0.5_wp*grid%dy, grid%y(box%iy1) + 0.5_wp*grid%dy]
            call log%line(" Contact in rows" // whole(box%iy0, 4) // " to" // whole(box%iy1, 4) // " of" // whole(grid%my, 4) &
               & // ", s from" // fixed(range(1), 9, 3) // " to" // fixed(range(2), 9, 3) // " mm")
         end associate
         range = s*patch%curve(3, [box%iy0, box%iy1])/degree
         call log%line(" Contact angle" // fixed(s*patch%delta/degree, 8, 2) // " deg at the reference, from" &
            & // fixed(range(1), 8, 2) // " to" // fixed(range(2), 8, 2) // " deg in the contact area")
      end if
      call log%line(" Moments about the reference MX, MS, MN:" // smarts([s, 1.0_wp, s]*patch%moment) // " N mm")
   end subroutine write_curved_contact

   !> Friction in the patch, where it varies over the rail
   subroutine write_patch_friction(log, spec, patch)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_patch), intent(in) :: patch

      if (.not. allocated(patch%friction)) return
      call write_friction(log, spec%friction_law, merge(variation%by_row, variation%none, patch%friction_varies), &
         & patch%friction, spec%output_level)
   end subroutine write_patch_friction

   !> Flexibilities of simplified theory, and what the slope reduction came to
   subroutine write_patch_flexibility(log, model, contact)
      type(log_type), intent(inout) :: log
      !> Member of material_model
      integer, intent(in) :: model
      type(patch_result), intent(in) :: contact
      character(len=7) :: method

      if (.not. is_simplified(model)) return
      if (model /= material_model%fastsim_single) then
         call log%result("")
         call log%result(" SIMPLIFIED THEORY MATERIAL CONSTANTS")
         call log%result(heading([character(len=9) :: "FLX1", "FLX2", "FLX3"]))
         call log%result("  " // generals(contact%flx))
      end if
      if (.not. has_slope_reduction(model)) return
      method = "FASTSIM"
      if (is_fastrip(model)) method = "FASTRIP"
      call log%result("")
      call log%result(" MODIFIED " // method // " SLOPE REDUCTION PARAMETERS")
      call log%result(heading([character(len=9) :: "K0_EFF"]))
      call log%result("  " // generals([contact%k_eff]))
   end subroutine write_patch_flexibility

   !> Creepages of the patch
   subroutine write_patch_kinematics(log, patch, s)
      type(log_type), intent(inout) :: log
      type(wheel_rail_patch), intent(in) :: patch
      !> -1 for the left side
      real(wp), intent(in) :: s

      associate (contact => patch%contact)
         call log%result("")
         call log%result(" KINEMATIC CONSTANTS")
         call log%result("     CHI         DQ          VELOC       CKSI        CETA        CPHI")
         call log%result("  " // smart(s*contact%chi, 12, 4, 4) // generals([contact%dq]) // smart(contact%veloc, 12, 4, 4) &
            & // smarts([contact%cksi, s*contact%ceta, s*contact%cphi]))
         if (.not. any(abs(patch%grid_reference) > 0.0_wp)) return
         call log%result("")
         call log%result("     SPINXO      SPINYO")
         call log%result("  " // generals([1.0_wp, s]*patch%grid_reference))
      end associate
   end subroutine write_patch_kinematics

   !> Forces, energy, approach, largest pressure
   subroutine write_patch_totals(log, spec, patch, totals)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_patch), intent(in) :: patch
      !> Its totals, of which those below the tolerance become zero
      type(total_list), intent(inout) :: totals
      character(len=*), parameter :: more = "ELAST.EN.   FRIC.POWER"
      character(len=12) :: names(2)
      real(wp) :: energy(2), force(4), reference(2)

      call remove_noise(spec, totals)
      names = [character(len=12) :: "FX/FSTAT/FN ", "FS/FSTAT/FN "]
      if (patch%friction_varies) names = [character(len=12) :: "   FX/FN    ", "   FS/FN    "]
      energy = [totals%of(["elastic_energy"]), patch%contact%friction_power]
      if (spec%wheel_rail%search%location == contact_location%conformal) then
         call write_total_lines(log, spec, totals, "   BAR_FN      BAR_FX      BAR_FS        MN         " // more, &
            & [totals%of(["bar_fn", "bar_fx", "bar_fs", "bar_mn"]), energy], "    TILDE_FN  " // names(1) // names(2) // "   ", &
            & [patch%tilde_fn, totals%of(["fx_rel", "fy_rel"])], "FS")
      else
         ! the moment is about the origin of the elements
         force = totals%of(["fn", "fx", "fy", "mz"])
         reference = totals%of(["x_elem", "y_elem"])
         force(4) = force(4) + reference(1)*force(3) - reference(2)*force(2)
         call write_total_lines(log, spec, totals, "     FN          FX          FS          MN         " // more, &
            & [force, energy], "     FN/G     " // names(1) // names(2) // "   ", &
            & [patch%contact%fn/patch%contact%gg, totals%of(["fx_rel", "fy_rel"])], "FS")
      end if
   end subroutine write_patch_totals

   !> Curved reference surface of conformal contact
   subroutine write_curve(log, patch, s)
      type(log_type), intent(inout) :: log
      type(wheel_rail_patch), intent(in) :: patch
      !> -1 for the left side
      real(wp), intent(in) :: s
      integer :: i

      call log%result("")
      call log%result(" CURVED REFERENCE SURFACE, TRACK COORDINATES," // whole(size(patch%curve, 2), 5) // " POINTS:")
      call log%result("    I        Y(I)       Z(I)       A(I)")
      do i = 1, size(patch%curve, 2)
         call log%result(whole(i, 6) // " " // fixed(s*patch%curve(1, i), 10, 4) // " " // fixed(patch%curve(2, i), 10, 4) &
            & // " " // fixed(s*patch%curve(3, i), 10, 4))
      end do
   end subroutine write_curve

   !> Profiles as used, in track coordinates
   subroutine write_profiles(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_result), intent(in) :: result
      real(wp) :: s
      integer :: i

      s = sign_of(spec)
      if (allocated(result%rail_profile%s)) then
         call log%result("")
         call log%result(" RAIL PROFILE USED, TRACK COORDINATES," // whole(size(result%rail_profile%s), 5) // " POINTS:")
         call log%result("    I        S(I)       Y(I)       Z(I)")
         do i = 1, size(result%rail_profile%s)
            call log%result(whole(i, 6) // " " // fixed(result%rail_profile%s(i), 10, 4) // " " &
               & // fixed(s*result%rail_profile%y(i), 10, 4) // " " // fixed(result%rail_profile%z(i), 10, 4))
         end do
      end if
      if (allocated(result%wheel_profile%s)) then
         call log%result("")
         call log%result(" PRINCIPAL WHEEL PROFILE, TRACK COORDINATES," // whole(size(result%wheel_profile%s), 5) // " POINTS:")
         call log%result("    I        S(I)       X(I)       Y(I)       Z(I)")
         do i = 1, size(result%wheel_profile%s)
            call log%result(whole(i, 6) // " " // fixed(result%wheel_profile%s(i), 10, 4) // " " &
               & // fixed(result%wheel_profile%x(i), 10, 4) // " " // fixed(s*result%wheel_profile%y(i), 10, 4) // " " &
               & // fixed(result%wheel_profile%z(i), 10, 4))
         end do
      end if
   end subroutine write_profiles
end module contact_output_report_wheel_rail
