!> Echo of the input of a case in the .out file (output level 2 and higher)
module contact_output_report_input
   use contact_base_choices, only : force_control, grid_form, is_fastrip, is_rolling, is_simplified, material_model, motion, &
      & normal_control, pressure_model, solver_choice, variation
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_collector, only : collector
   use contact_cases_inputs, only : visit_kinematics, visit_rolling
   use contact_cases_spec, only : case_spec, kinematics_spec, part_source, rolling_spec
   use contact_control_digits, only : case_digits, digit_names, digit_value
   use contact_control_translation, only : digits_of
   use contact_output_formats, only : fixed, formatted, whole
   use contact_output_report_lines, only : show, write_row, write_title
   use contact_output_report_materials, only : write_constants, write_friction, write_material_model
   use contact_patch_result, only : hertz_result, patch_result
   implicit none (type, external)
   private

   public :: digit_words, write_input, write_last_digits, write_outer_iteration

   !> Names of the digits in the established program, in the order of digit_names
   character(len=6), parameter :: digit_titles(*) = [character(len=6) :: "CONFIG", "PVTIME", "BOUND", "TANG", "NORM", &
      & "FORCE", "STRESS", "VARFRC", "FRCLAW", "DISCNS", "INFLCF", "MATER", "RZNORM", "RZTANG", "M2", "X", "HEAT", "GAUSEI", &
      & "IESTIM", "MATFIL", "OUTPUT", "FLOW", "RETURN"]

contains

   !> Write digits, problem description and all groups of the input that are given by the case
   subroutine write_input(log, spec, result)
      type(log_type), intent(inout) :: log
      !> The case as given in the input
      type(case_spec), intent(in) :: spec
      !> Result, for derived constants: combined material, Hertz solution, time step
      type(patch_result), intent(in) :: result
      type(case_digits) :: digits

      digits = digits_of(spec)
      call log%result(" ")
      call log%result("  PBTNFS.            " // trim(digit_words(digits, 2, 7, .false.)))
      if (digits%v /= 0) then
         call log%result(" VLDCMZE.  " // trim(digit_words(digits, 8, 14, .false.)))
      else
         call log%result("  LDCMZE.            " // trim(digit_words(digits, 9, 14, .false.)))
      end if
      call write_last_digits(log, digits)
      call write_problem(log, spec)
      if (spec%parts%geometry /= part_source%kept .and. spec%grid%brings_geometry()) call write_hertz(log, spec, result)
      if (spec%solver == solver_choice%gd_steady) call write_gd_steady(log, spec)
      if (spec%parts%material == part_source%given) call write_materials(log, spec, result)
      if (spec%parts%friction == part_source%given .and. allocated(spec%friction%sets)) &
         & call write_friction(log, spec%friction_law, spec%variation, spec%friction%sets, spec%output_level)
      call write_kinematics(log, spec, result)
   end subroutine write_input

   !> Digits with their names in the established program, such as PVTIME, one after the other
   pure function digit_words(digits, first, last, is_wheel_rail) result(text)
      type(case_digits), intent(in) :: digits
      !> First and last position in digit_names
      integer, intent(in) :: first, last
      !> Do Z and E refer to track and wheelset?
      logical, intent(in) :: is_wheel_rail
      character(len=10*(last - first + 1)) :: text
      character(len=6) :: name
      integer :: k, value

      text = ""
      do k = first, last
         value = digit_value(digits, digit_names(k))
         name = digit_titles(k)
         if (is_wheel_rail) then
            if (digit_names(k) == "Z") name = "ZTRACK"
            if (digit_names(k) == "E") name = "EWHEEL"
            if (digit_names(k) == "D") value = value + 10*digits%gapwgt
         end if
         text(10*(k - first) + 1:) = name // whole(value, 2) // ", "
      end do
      text(len(text) - 1:) = ""
   end function digit_words

   !> Write the line of the third control word, and of the iteration between both problems
   subroutine write_last_digits(log, digits)
      type(log_type), intent(inout) :: log
      type(case_digits), intent(in) :: digits

      call log%result(" HGIAOWR.  " // trim(digit_words(digits, 17, 23, .false.)))
   end subroutine write_last_digits

   !> Is the normal problem solved once, or alternately with the tangential problem?
   subroutine write_outer_iteration(log, maxout)
      type(log_type), intent(inout) :: log
      !> Maximum number of outer iterations
      integer, intent(in) :: maxout

      if (maxout <= 1) then
         call log%result(" JOHNSON'S METHOD: NORMAL AND TANGENTIAL PROBLEM ARE SOLVED ONCE")
      else
         call log%result(" PANAGIOTOPOULOS' METHOD: NORMAL AND TANGENTIAL PROBLEM ALTERNATE. MAXOUT=" // whole(maxout, 3))
      end if
   end subroutine write_outer_iteration

   !> Describe the problem in words
   subroutine write_problem(log, spec)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      character(len=:), allocatable :: text

      text = "WITH PRESCRIBED " // trim(prescribed(spec)) // ", "
      select case (spec%pressure)
      case (pressure_model%kpec); text = text // "APPROXIMATE KPEC SOLUTION"
      case (pressure_model%analyn); text = text // "APPROXIMATE ANALYN SOLUTION"
      case (pressure_model%elliptical); text = "SKIPPED, ELLIPTICAL TRACTION BOUND"
      case (pressure_model%parabolical); text = "SKIPPED, PARABOLICAL TRACTION BOUND"
      case (pressure_model%sdec); text = "SKIPPED, SDEC TRACTION BOUND"
      case default; text = text // "FULL SOLUTION"
      end select
      if (spec%pressure /= pressure_model%thin_sheet) call log%result(" NORMAL PROBLEM " // text)
      if (spec%motion == motion%none) return

      text = "STEADY STATE ROLLING"
      if (is_simplified(spec%material_model)) then
         text = text // ',  "' // merge("FASTRIP", "FASTSIM", is_fastrip(spec%material_model)) // ' APPROACH"'
      else if (spec%motion == motion%shift) then
         text = "SHIFT TRANSIENT"
      else if (spec%motion == motion%transient_rolling) then
         text = "TRANSIENT ROLLING"
      end if
      call log%result(" " // text)
      select case (spec%force)
      case (force_control%creepages); call log%result(" CREEPAGE PRESCRIBED")
      case (force_control%fx_and_ceta); call log%result(" X-FORCE,  Y-CREEPAGE PRESCRIBED")
      case default; call log%result(" TANGENTIAL FORCE PRESCRIBED")
      end select
      call write_outer_iteration(log, spec%outer_iterations())
   end subroutine write_problem

   !> Prescribed quantity of the normal problem
   pure function prescribed(spec) result(text)
      type(case_spec), intent(in) :: spec
      character(len=12) :: text

      text = "APPROACH"
      if (spec%normal == normal_control%force) text = "NORMAL FORCE"
   end function prescribed

   !> Write Hertzian geometry: given values, derived values, grid
   subroutine write_hertz(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      type(hertz_result) :: hertz
      character(len=11) :: kind
      integer :: option

      option = spec%grid%form
      if (allocated(result%hertz)) hertz = result%hertz
      kind = "3D HERTZIAN"
      if (any(option == [grid_form%hertz_line, grid_form%hertz_line_curvature])) kind = "2D HERTZIAN"
      if (option == grid_form%half_ellipses) kind = "SDEC"
      call write_title(log, " " // trim(kind) // " GEOMETRY WITH PRESCRIBED " // trim(prescribed(spec)))
      select case (option)
      case (grid_form%hertz_curvatures)
         call labelled(" CURVATURE PRESCRIBED, A1,B1:", [spec%grid%a1, spec%grid%b1])
      case (grid_form%hertz_curvature_ratio)
         call labelled(" CURVATURE AND ELLIPTIC. PRESCRB, A1,AA/BB:", [spec%grid%a1, spec%grid%aob])
      case (grid_form%hertz_line_curvature)
         call labelled(" CURVATURE PRESCRIBED, A1,BB:", [spec%grid%a1, spec%grid%bb])
      case (grid_form%half_ellipses)
         call labelled(" SEMIAXES PRESCRIBED, AA,BNEG,BPOS:", [spec%grid%aa, spec%grid%bneg, spec%grid%bpos])
      case default
         call labelled(" SEMIAXES PRESCRIBED, AA,BB:", [spec%grid%aa, spec%grid%bb])
      end select
      if (spec%grid%is_hertzian() .and. option /= grid_form%hertz_curvatures) &
         & call labelled(" THE CURVATURES A1,B1 ARE:", [hertz%a1, hertz%b1])
      if (spec%grid%is_hertzian() .and. option /= grid_form%hertz_axes) &
         & call labelled(" BASIC SEMIAXES AA,BB, RATIO", [hertz%aa, hertz%bb, hertz%aob])
      if (spec%grid%is_hertzian()) call labelled(" EFFECTIVE RAD.CURV RHO, SEMI-AXIS CP", [hertz%rho, hertz%cp])
      call labelled(" POTENTIAL CONTACT, SCALE:", [result%grid%xl, result%grid%yl, spec%grid%scale])
      call log%result(label_field(" DISCRETISATION MX,MY, DX,DY:") // whole(result%grid%mx, 6) &
         & // whole(result%grid%my, 6) // formatted([result%grid%dx, result%grid%dy], "G"))

   contains

      subroutine labelled(label, values)
         character(len=*), intent(in) :: label
         real(wp), intent(in) :: values(:)
         call log%result(label_field(label) // formatted(values, "G"))
      end subroutine labelled
   end subroutine write_hertz

   !> Label in the Hertz block, padded to 43 columns
   pure character(len=43) function label_field(label)
      character(len=*), intent(in) :: label
      label_field = label
   end function label_field

   !> Parameters of the gradient-descent solver
   subroutine write_gd_steady(log, spec)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      character(len=6) :: decay
      real(wp) :: shown

      decay = "FDECAY"
      shown = spec%iteration%fdecay
      if (shown < 0.001_wp) then
         decay = "KDOWN"
         shown = real(max(1, nint(-shown)), wp)
      end if
      call write_title(log, " PARAMETERS FOR SOLVER GDSTEADY")
      call write_row(log, decay // " KDOWFB BETA D_IFC D_LIN D_CNS D_SLP POW_S", [shown, real(spec%iteration%kdowfb, wp), &
         & spec%iteration%betath, spec%iteration%d_ifc, spec%iteration%d_lin, spec%iteration%d_cns, spec%iteration%d_slp, &
         & spec%iteration%pow_s], "G")
   end subroutine write_gd_steady

   !> Write material constants, damping, heat, and the thin sheet between the bodies
   subroutine write_materials(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result

      call write_constants(log, spec, [result%nu, result%gg, result%ak])
      if (spec%material_model == material_model%elastic) return
      if (spec%motion == motion%none) then
         call write_material_model(log, spec%material_model, spec%material, spec%rolling%veloc)
      else
         call write_material_model(log, spec%material_model, spec%material, spec%rolling%veloc, result%flx, result%k_eff)
      end if
   end subroutine write_materials

   !> Write prescribed creepages or forces; computed ones follow with the results
   subroutine write_kinematics(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      type(collector) :: given, step
      type(kinematics_spec) :: kinematics
      type(rolling_spec) :: rolling
      character(len=:), allocatable :: names

      kinematics = spec%kinematics
      rolling = spec%rolling
      call visit_kinematics(given, kinematics, spec%normal, spec%force)
      call visit_rolling(step, rolling, spec%material_model)
      names = "VELOC    " // title(given%names(2)) // title(given%names(3)) // "   " // given%names(4)
      call write_title(log, " KINEMATIC CONSTANTS")
      if (is_rolling(spec%motion)) then
         call log%result("     CHI         DQ          " // trim(names))
         call log%result("  " // formatted([step%values(:3), given%values(2:4)], "GGS"))
      else
         call log%result("     DT          " // trim(names))
         call log%result("  " // fixed(result%dt, 8, 3) // "    " // formatted([result%veloc, given%values(2:4)], "S"))
      end if
      if (.not. any(abs(given%values(5:)) > 0.0_wp)) return
      call log%result("")
      call show(log, given, "GG", first=5)

   contains

      !> Title of a creepage, or of a force relative to its bound
      pure character(len=12) function title(name)
         !> CKSI, CETA, FX or FY
         character(len=*), intent(in) :: name

         title = "   " // name
         if (name(:1) == "F" .and. spec%variation == variation%by_row) title = "   " // trim(name) // "/FN"
         if (name(:1) == "F" .and. spec%variation /= variation%by_row) title = " " // trim(name) // "/FSTAT/FN"
      end function title
   end subroutine write_kinematics
end module contact_output_report_input
