!> Wheel and rail in the .out file: total forces, contact patches
!>
!> Results are those of a wheel on the right side of the track; for the left side the values that change sign are mirrored here.
module contact_output_report_wheel_rail
   use contact_base_case_status, only : case_status
   use contact_base_choices, only : contact_location, has_slope_reduction, is_fastrip, is_simplified, material_model, motion, &
      & time_link, variation
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_spec, only : case_spec
   use contact_grid_element_division, only : bounding_box, contact_box
   use contact_output_element_table, only : write_element_table
   use contact_output_formats, only : fixed, formatted, whole
   use contact_grid_picture, only : write_picture
   use contact_output_report_lines, only : write_row, write_title
   use contact_output_report_materials, only : write_flexibilities, write_friction
   use contact_output_report_result, only : ending_text, remove_noise, write_accuracy, write_errors, write_solution_line, &
      & write_statistics, write_total_lines
   use contact_output_report_subsurface, only : write_subsurface
   use contact_output_report_wheel_rail_input, only : write_wheel_rail_input
   use contact_patch_quantities, only : total_list
   use contact_patch_result, only : patch_result
   use contact_wheelrail_result, only : in_element_coordinates, wheel_rail_patch, wheel_rail_result
   implicit none (type, external)
   private

   public :: write_wheel_rail

contains

   !> Write everything of a case of module 1 after its flow trace
   subroutine write_wheel_rail(log, spec, result)
      type(log_type), intent(inout) :: log
      !> The case as given in the input
      type(case_spec), intent(in) :: spec
      !> Total forces and patches
      type(wheel_rail_result), intent(in) :: result
      integer :: k, patches

      if (.not. log%out%is_open() .and. log%screen == 0) return
      patches = 0
      if (allocated(result%patches)) patches = size(result%patches)
      if (spec%output_level >= 1) then
         if (spec%output_level >= 2) call write_wheel_rail_input(log, spec, result, patches)
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

   !> -1 for the left side of the track
   pure real(wp) function sign_of(spec)
      type(case_spec), intent(in) :: spec
      sign_of = merge(-1.0_wp, 1.0_wp, spec%wheel_rail%left)
   end function sign_of

   !> Write total forces and moments on the rail, the sum over all patches
   subroutine write_total_forces(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_result), intent(in) :: result
      character(len=:), allocatable :: body
      type(total_list) :: totals

      call result%totals(spec%wheel_rail, totals)
      body = trim(merge("ROLLER", "RAIL  ", spec%wheel_rail%roller))
      if (spec%output_level >= 4) then
         call write_title(log, " TOTAL FORCES AND MOMENTS ON " // body, " ")
      else if (spec%output_level >= 2) then
         call write_title(log, " TOTAL FORCES ON " // body)
      end if
      call log%result("     FX(TR)      FY(TR)      FZ(TR)      FX(WS)      FY(WS)      FZ(WS)")
      call log%result(formatted(totals%of(["fx_tr", "fy_tr", "fz_tr", "fx_ws", "fy_ws", "fz_ws"]), "S"))
      if (allocated(result%errors)) call write_errors(log, result%errors, totals, "")
      if (allocated(result%accuracy)) call write_accuracy(log, result%accuracy)
      if (spec%output_level < 4) return
      call write_title(log, "     MX@R(TR)    MY@R(TR)    MZ@R(TR)    MX@W(WS)    MY@W(WS)    MZ@W(WS)")
      call log%result(formatted(totals%of(["mx_r_tr", "my_r_tr", "mz_r_tr", "mx_w_ws", "my_w_ws", "mz_w_ws"]), "S"))
   end subroutine write_total_forces

   !> Write one contact patch
   subroutine write_patch(log, spec, patch, number, status)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_patch), intent(in) :: patch
      integer, intent(in) :: number
      !> Status of the case
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
         call write_title(log, " ----- DATA FOR CONTACT PATCH" // whole(number, 3) // origin // " -----")
         if (spec%output_level >= 2) then
            call write_reference(log, totals)
            if (allocated(patch%curve)) call write_curved_contact(log, patch, s)
            call write_patch_friction(log, spec, patch)
            if (spec%motion /= motion%none) call write_patch_flexibility(log, spec%material_model, patch%contact)
            call write_patch_kinematics(log, patch, s)
         end if
         call write_patch_totals(log, spec, patch, totals)
         if (spec%output_level >= 2) call write_statistics(log, spec, patch%contact)
         if (allocated(patch%contact%errors)) call write_errors(log, patch%contact%errors%value, totals, &
            & trim(patch%contact%errors%reason))
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

   !> Write the position of the contact reference point in track, rail and wheel coordinates
   subroutine write_reference(log, totals)
      type(log_type), intent(inout) :: log
      !> Totals of the patch
      type(total_list), intent(in) :: totals

      call write_title(log, " CONTACT REFERENCE LOCATION")
      call log%result("     XCP(TR)     YCP(TR)     ZCP(TR)    DELTCP(TR)   YCP(R)      ZCP(R)")
      call log%result(formatted(totals%of([character(len=9) :: "xcp_tr", "ycp_tr", "zcp_tr", "deltcp_tr", "ycp_r", "zcp_r"]), "F"))
      call write_title(log, "     XCP(W)      YCP(W)      ZCP(W)")
      call log%result(formatted(totals%of(["xcp_w", "ycp_w", "zcp_w"]), "F"))
   end subroutine write_reference

   !> Write the extent of the contact area on its curved reference surface, the angles at its ends, and the moments in the axes of
   !> the reference
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
      call log%line(" Moments about the reference MX, MS, MN:" // formatted([s, 1.0_wp, s]*patch%moment, "S") // " N mm")
   end subroutine write_curved_contact

   !> Write the friction in the patch, if it varies over the rail
   subroutine write_patch_friction(log, spec, patch)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_patch), intent(in) :: patch

      if (.not. allocated(patch%friction)) return
      call write_friction(log, spec%friction_law, merge(variation%by_row, variation%none, patch%friction_varies), &
         & patch%friction, spec%output_level)
   end subroutine write_patch_friction

   !> Write flexibilities of simplified theory, and the resulting slope reduction
   subroutine write_patch_flexibility(log, model, contact)
      type(log_type), intent(inout) :: log
      !> Member of material_model
      integer, intent(in) :: model
      type(patch_result), intent(in) :: contact

      if (.not. is_simplified(model)) return
      if (model /= material_model%fastsim_single) then
         call log%result("")
         call write_flexibilities(log, contact%flx)
      end if
      if (.not. has_slope_reduction(model)) return
      call write_title(log, " MODIFIED " // merge("FASTRIP", "FASTSIM", is_fastrip(model)) // " SLOPE REDUCTION PARAMETERS")
      call write_row(log, "K0_EFF", [contact%k_eff], "G")
   end subroutine write_patch_flexibility

   !> Write creepages of the patch
   subroutine write_patch_kinematics(log, patch, s)
      type(log_type), intent(inout) :: log
      type(wheel_rail_patch), intent(in) :: patch
      !> -1 for the left side
      real(wp), intent(in) :: s

      associate (contact => patch%contact)
         call write_title(log, " KINEMATIC CONSTANTS")
         call write_row(log, "CHI DQ VELOC CKSI CETA CPHI", [s*contact%chi, contact%dq, contact%veloc, contact%cksi, &
            & s*contact%ceta, s*contact%cphi], "SGS")
         if (.not. any(abs(patch%grid_reference) > 0.0_wp)) return
         call log%result("")
         call write_row(log, "SPINXO SPINYO", [1.0_wp, s]*patch%grid_reference, "G")
      end associate
   end subroutine write_patch_kinematics

   !> Write forces, energy, approach, maximum pressure
   subroutine write_patch_totals(log, spec, patch, totals)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_patch), intent(in) :: patch
      !> Totals of the patch, of which those below the tolerance are set to zero
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
         ! the moment refers to the origin of the elements
         force = totals%of(["fn", "fx", "fy", "mz"])
         reference = totals%of(["x_elem", "y_elem"])
         force(4) = force(4) + reference(1)*force(3) - reference(2)*force(2)
         call write_total_lines(log, spec, totals, "     FN          FX          FS          MN         " // more, &
            & [force, energy], "     FN/G     " // names(1) // names(2) // "   ", &
            & [patch%contact%fn/patch%contact%gg, totals%of(["fx_rel", "fy_rel"])], "FS")
      end if
   end subroutine write_patch_totals

   !> Write the curved reference surface of conformal contact
   subroutine write_curve(log, patch, s)
      type(log_type), intent(inout) :: log
      type(wheel_rail_patch), intent(in) :: patch
      !> -1 for the left side
      real(wp), intent(in) :: s

      associate (curve => patch%curve)
         call write_points(log, " CURVED REFERENCE SURFACE", "Y(I)       Z(I)       A(I)", &
            & reshape([s*curve(1, :), curve(2, :), s*curve(3, :)], [size(curve, 2), 3]))
      end associate
   end subroutine write_curve

   !> Write the profiles used, in track coordinates
   subroutine write_profiles(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(wheel_rail_result), intent(in) :: result

      if (allocated(result%rail_profile%s)) then
         associate (curve => result%rail_profile)
            call write_points(log, " RAIL PROFILE USED", "S(I)       Y(I)       Z(I)", &
               & reshape([curve%s, sign_of(spec)*curve%y, curve%z], [size(curve%s), 3]))
         end associate
      end if
      if (allocated(result%wheel_profile%s)) then
         associate (curve => result%wheel_profile)
            call write_points(log, " PRINCIPAL WHEEL PROFILE", "S(I)       X(I)       Y(I)       Z(I)", &
               & reshape([curve%s, curve%x, sign_of(spec)*curve%y, curve%z], [size(curve%s), 4]))
         end associate
      end if
   end subroutine write_profiles

   !> Write a table of points in track coordinates
   subroutine write_points(log, title, names, table)
      type(log_type), intent(inout) :: log
      !> Title, and names of the columns
      character(len=*), intent(in) :: title, names
      !> Values in columns
      real(wp), intent(in) :: table(:, :)
      character(len=:), allocatable :: line
      integer :: i, k

      call write_title(log, title // ", TRACK COORDINATES," // whole(size(table, 1), 5) // " POINTS:")
      call log%result("    I        " // names)
      do i = 1, size(table, 1)
         line = whole(i, 6)
         do k = 1, size(table, 2)
            line = line // " " // fixed(table(i, k), 10, 4)
         end do
         call log%result(line)
      end do
   end subroutine write_points
end module contact_output_report_wheel_rail
