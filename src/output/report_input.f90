!> Echo of the input of a case in the .out file (output level 2 and higher)
module contact_output_report_input
   use contact_base_choices, only : force_control, grid_form, has_slope_reduction, is_fastrip, material_model, &
      & motion, normal_control, pressure_model, solver_choice, variation
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_collector, only : collector, friction_numbers
   use contact_cases_spec, only : case_spec, friction_set, kinematics_spec, material_spec, part_source
   use contact_control_digits, only : case_digits
   use contact_control_translation, only : digits_of
   use contact_output_formats, only : fixed, general, generals, heading, smart, smarts, whole
   use contact_patch_result, only : hertz_result, patch_result
   implicit none (type, external)
   private

   public :: write_input, write_friction, write_sheet

   !> Below this output level the middle of a friction table per row is left out
   integer, parameter :: full_friction_table = 4

contains

   !> Write digits, problem description and all groups of the input that the case gave
   subroutine write_input(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      !> For derived constants: combined material, Hertz solution, time step
      type(patch_result), intent(in) :: result

      call write_digits(log, digits_of(spec))
      call write_problem(log, spec)
      if (spec%parts%geometry /= part_source%kept .and. spec%grid%brings_geometry()) call write_hertz(log, spec, result)
      if (spec%solver == solver_choice%gd_steady) call write_gd_steady(log, spec)
      if (spec%parts%material == part_source%given) call write_materials(log, spec, result)
      if (spec%parts%friction == part_source%given .and. allocated(spec%friction%sets)) &
         & call write_friction(log, spec%friction_law, spec%variation, spec%friction%sets, spec%output_level)
      call write_kinematics(log, spec, result)
   end subroutine write_input

   !> Control digits as given
   subroutine write_digits(log, digits)
      type(log_type), intent(inout) :: log
      type(case_digits), intent(in) :: digits
      character(len=:), allocatable :: start

      call log%result(" ")
      call log%result("  PBTNFS.            PVTIME" // whole(digits%p, 2) // ", BOUND " // whole(digits%b, 2) &
         & // ", TANG  " // whole(digits%t, 2) // ", NORM  " // whole(digits%n, 2) // ", FORCE " // whole(digits%f, 2) &
         & // ", STRESS" // whole(digits%s, 2))
      start = "  LDCMZE.            "
      if (digits%v /= 0) start = " VLDCMZE.  VARFRC" // whole(digits%v, 2) // ", "
      call log%result(start // "FRCLAW" // whole(digits%l, 2) // ", DISCNS" // whole(digits%d, 2) // ", INFLCF" &
         & // whole(digits%c, 2) // ", MATER " // whole(digits%m, 2) // ", RZNORM" // whole(digits%z, 2) // ", RZTANG" &
         & // whole(digits%e, 2))
      call log%result(" HGIAOWR.  HEAT  " // whole(digits%h, 2) // ", GAUSEI" // whole(digits%g, 2) // ", IESTIM" &
         & // whole(digits%i, 2) // ", MATFIL" // whole(digits%a, 2) // ", OUTPUT" // whole(digits%o, 2) // ", FLOW  " &
         & // whole(digits%w, 2) // ", RETURN" // whole(digits%r, 2))
   end subroutine write_digits

   !> What problem is solved, in words
   subroutine write_problem(log, spec)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec

      if (spec%pressure == pressure_model%full) then
         call log%result(" NORMAL PROBLEM WITH PRESCRIBED " // trim(prescribed(spec)) // ", FULL SOLUTION")
      else if (spec%pressure == pressure_model%kpec) then
         call log%result(" NORMAL PROBLEM WITH PRESCRIBED " // trim(prescribed(spec)) // ", APPROXIMATE KPEC SOLUTION")
      else if (spec%pressure == pressure_model%analyn) then
         call log%result(" NORMAL PROBLEM WITH PRESCRIBED " // trim(prescribed(spec)) // ", APPROXIMATE ANALYN SOLUTION")
      else if (spec%pressure == pressure_model%elliptical) then
         call log%result(" NORMAL PROBLEM SKIPPED, ELLIPTICAL TRACTION BOUND")
      else if (spec%pressure == pressure_model%parabolical) then
         call log%result(" NORMAL PROBLEM SKIPPED, PARABOLICAL TRACTION BOUND")
      else if (spec%pressure == pressure_model%sdec) then
         call log%result(" NORMAL PROBLEM SKIPPED, SDEC TRACTION BOUND")
      end if
      if (spec%motion == motion%none) return

      if (spec%material_model == material_model%fastsim_single .or. spec%material_model == material_model%fastsim) then
         call log%result(' STEADY STATE ROLLING,  "FASTSIM APPROACH"')
      else if (is_fastrip(spec%material_model)) then
         call log%result(' STEADY STATE ROLLING,  "FASTRIP APPROACH"')
      else if (spec%motion == motion%shift) then
         call log%result(" SHIFT TRANSIENT")
      else if (spec%motion == motion%transient_rolling) then
         call log%result(" TRANSIENT ROLLING")
      else
         call log%result(" STEADY STATE ROLLING")
      end if
      if (spec%force == force_control%creepages) then
         call log%result(" CREEPAGE PRESCRIBED")
      else if (spec%force == force_control%fx_and_ceta) then
         call log%result(" X-FORCE,  Y-CREEPAGE PRESCRIBED")
      else
         call log%result(" TANGENTIAL FORCE PRESCRIBED")
      end if
      if (spec%iteration%maxout <= 1) then
         call log%result(" JOHNSON'S METHOD: NORMAL AND TANGENTIAL PROBLEM ARE SOLVED ONCE")
      else
         call log%result(" PANAGIOTOPOULOS' METHOD: NORMAL AND TANGENTIAL PROBLEM ALTERNATE. MAXOUT=" &
            & // whole(spec%iteration%maxout, 3))
      end if
   end subroutine write_problem

   !> Prescribed quantity of the normal problem
   pure function prescribed(spec) result(text)
      type(case_spec), intent(in) :: spec
      character(len=12) :: text

      text = "APPROACH"
      if (spec%normal == normal_control%force) text = "NORMAL FORCE"
   end function prescribed

   !> Hertzian geometry: given values, derived ones, grid
   subroutine write_hertz(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      type(hertz_result) :: hertz
      integer :: option

      option = spec%grid%form
      if (allocated(result%hertz)) hertz = result%hertz
      call log%result("")
      select case (option)
      case (grid_form%half_ellipses)
         call log%result(" SDEC GEOMETRY WITH PRESCRIBED " // trim(prescribed(spec)))
      case (grid_form%hertz_line, grid_form%hertz_line_curvature)
         call log%result(" 2D HERTZIAN GEOMETRY WITH PRESCRIBED " // trim(prescribed(spec)))
      case default
         call log%result(" 3D HERTZIAN GEOMETRY WITH PRESCRIBED " // trim(prescribed(spec)))
      end select
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
         & // whole(result%grid%my, 6) // generals([result%grid%dx, result%grid%dy]))

   contains

      subroutine labelled(label, values)
         character(len=*), intent(in) :: label
         real(wp), intent(in) :: values(:)
         call log%result(label_field(label) // generals(values))
      end subroutine labelled
   end subroutine write_hertz

   !> Label of the Hertz block: 43 columns
   pure character(len=43) function label_field(label)
      character(len=*), intent(in) :: label
      label_field = label
   end function label_field

   !> Parameters of the gradient-descent solver
   subroutine write_gd_steady(log, spec)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      character(len=9) :: decay
      real(wp) :: shown

      decay = "FDECAY"
      shown = spec%iteration%fdecay
      if (shown < 0.001_wp) then
         decay = "KDOWN"
         shown = real(max(1, nint(-shown)), wp)
      end if
      call log%result("")
      call log%result(" PARAMETERS FOR SOLVER GDSTEADY")
      call log%result(heading([character(len=9) :: decay, "KDOWFB", "BETA", "D_IFC", "D_LIN", "D_CNS", "D_SLP", "POW_S"]))
      call log%result("  " // generals([shown, real(spec%iteration%kdowfb, wp), spec%iteration%betath, &
         & spec%iteration%d_ifc, spec%iteration%d_lin, spec%iteration%d_cns, spec%iteration%d_slp, spec%iteration%pow_s]))
   end subroutine write_gd_steady

   !> Material constants, damping, heat, and what lies between the bodies
   subroutine write_materials(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      integer :: body

      call log%result("")
      call log%result(" MATERIAL CONSTANTS")
      call log%result(heading([character(len=9) :: "NU", "G", "AK", "EPS"]))
      call log%result("  " // generals([result%nu, result%gg, result%ak, spec%iteration%eps]))
      call log%result("")
      call log%result("    POISS(1)    POISS(2)     GG(1)       GG(2)")
      call log%result("  " // generals([spec%material%poiss, spec%material%gg]))
      if (spec%pressure == pressure_model%thin_sheet) call write_sheet(log, spec%material)
      if (spec%has_damping .and. spec%parts%damping == part_source%given) then
         call log%result("")
         call log%result(heading([character(len=9) :: "CDAMPN", "CDAMPT", "DFNMAX", "DFTMAX"]))
         call log%result("  " // smarts([spec%damping%cdampn, spec%damping%cdampt, spec%damping%dfnmax, &
            & spec%damping%dftmax]))
      end if
      if (spec%has_heat) then
         call log%result("")
         call log%result(heading([character(len=9) :: "BKTEMP", "HEATCP", "LAMBDA", "DENSITY"]))
         do body = 1, 2
            call log%result("  " // generals([spec%heat%bktemp(body), spec%heat%heatcp(body), spec%heat%lambda(body), &
               & spec%heat%dens(body)]))
         end do
      end if
      call write_material_model(log, spec, result)
   end subroutine write_materials

   !> Flexibility of an elastic thin sheet between the bodies
   subroutine write_sheet(log, material)
      type(log_type), intent(inout) :: log
      type(material_spec), intent(in) :: material

      call log%result("")
      call log%result(" ELASTIC THIN SHEET PARAMETERS")
      call log%result(heading([character(len=9) :: "FLXZ"]))
      call log%result("  " // generals([material%flxz]))
   end subroutine write_sheet

   !> Constants of other than elastic behaviour
   subroutine write_material_model(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      !> For the flexibilities of simplified theory
      type(patch_result), intent(in) :: result

      if (spec%material_model == material_model%elastic) return
      call log%result("")
      associate (material => spec%material)
         select case (spec%material_model)
         case (material_model%viscoelastic)
            call log%result(" VISCOELASTIC MATERIAL CONSTANTS")
            call log%result(heading([character(len=9) :: "FG(1)", "FG(2)", "TC(1)", "TC(2)", "VT(1)", "VT(2)"]))
            call log%result("  " // generals(material%fg) // smarts([material%tc, spec%rolling%veloc*material%tc]))
         case (material_model%interfacial_layer)
            call log%result(" INTERFACIAL LAYER PARAMETERS")
            call log%result(heading([character(len=9) :: "GG3", "LAYTHK", "TAU_C0", "K_TAU"]))
            call log%result("  " // generals([material%gg3, material%laythk, material%tau_c0, material%k_tau]))
         case default
            call write_simplified_theory(log, spec, result)
         end select
      end associate
   end subroutine write_material_model

   !> Flexibilities, and slope reduction with the factor that it came to
   subroutine write_simplified_theory(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      character(len=7) :: method

      if (spec%material_model == material_model%fastsim_single) then
         call log%result(" SIMPLIFIED THEORY MATERIAL CONSTANTS")
         call log%result(heading([character(len=9) :: "FLX"]))
         call log%result("  " // generals([spec%material%flx]))
         call log%result("")
      else if (spec%motion /= motion%none) then
         call log%result(" SIMPLIFIED THEORY MATERIAL CONSTANTS")
         call log%result(heading([character(len=9) :: "FLX1", "FLX2", "FLX3"]))
         call log%result("  " // generals(result%flx))
         call log%result("")
      end if
      if (.not. has_slope_reduction(spec%material_model)) return
      method = "FASTSIM"
      if (is_fastrip(spec%material_model)) method = "FASTRIP"
      call log%result(" MODIFIED " // method // " SLOPE REDUCTION PARAMETERS")
      associate (material => spec%material)
         if (spec%motion == motion%none) then
            call log%result(heading([character(len=9) :: "K0_MF", "ALFAMF", "BETAMF"]))
            call log%result("  " // generals([material%k0_mf, material%alfamf, material%betamf]))
         else
            call log%result(heading([character(len=9) :: "K0_MF", "ALFAMF", "BETAMF", "K_EFF"]))
            call log%result("  " // generals([material%k0_mf, material%alfamf, material%betamf, result%k_eff]))
         end if
      end associate
   end subroutine write_simplified_theory

   !> Friction law: one line, or one per control point or grid row
   subroutine write_friction(log, law, varies, sets, level)
      type(log_type), intent(inout) :: log
      !> Members of friction_model and variation
      integer, intent(in) :: law, varies
      type(friction_set), intent(in) :: sets(:)
      !> Output level
      integer, intent(in) :: level
      type(collector) :: line
      character(len=:), allocatable :: names
      integer :: i, count
      logical :: shorten

      call friction_numbers(line, law, friction_set())
      names = heading(line%names)
      call log%result("")
      call log%result(" FRICTION LAW PARAMETERS")
      count = size(sets)
      select case (varies)
      case (variation%none)
         call log%result(names)
         if (count > 0) call log%result("  " // numbers_of(sets(1)))
      case (variation%by_row)
         call log%result("     IY     " // names)
         shorten = level < full_friction_table .and. count > 4
         do i = 1, count
            if (shorten .and. i == 3) call log%result(repeat(" ", 22) // "...")
            if (shorten .and. i > 2 .and. i < count - 1) cycle
            call log%result("  " // whole(i, 8) // "    " // numbers_of(sets(i)))
         end do
      case default
         call log%result(merge("     ALPHA  ", "     SVF    ", varies == variation%by_angle) // names)
         do i = 1, count
            call log%result("  " // general(sets(i)%position, 12, 4) &
               & // numbers_of(sets(i)))
         end do
      end select

   contains

      !> The values of a set, below their names
      function numbers_of(set) result(text)
         type(friction_set), intent(in) :: set
         character(len=12*size(line%names)) :: text
         type(collector) :: a

         call friction_numbers(a, law, set)
         text = generals(a%values)
      end function numbers_of
   end subroutine write_friction

   !> Prescribed creepages or forces; what was found follows with the results
   subroutine write_kinematics(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      character(len=12) :: first_name, second_name
      type(kinematics_spec) :: given
      real(wp) :: first, second

      given = spec%kinematics
      first_name = "   CKSI"
      second_name = "   CETA"
      first = given%cksi
      second = given%ceta
      if (spec%force >= force_control%fx_and_ceta) then
         first_name = " FX/FSTAT/FN"
         if (spec%variation == variation%by_row) first_name = "   FX/FN"
         first = given%fx
      end if
      if (spec%force == force_control%fx_and_fy) then
         second_name = " FY/FSTAT/FN"
         if (spec%variation == variation%by_row) second_name = "   FY/FN"
         second = given%fy
      end if

      call log%result("")
      call log%result(" KINEMATIC CONSTANTS")
      if (spec%motion == motion%none .or. spec%motion == motion%shift) then
         call log%result("     DT          VELOC    " // first_name // second_name // "   CPHI")
         call log%result("  " // fixed(result%dt, 8, 3) // "    " // smarts([result%veloc, first, second, given%cphi]))
      else
         call log%result("     CHI         DQ          VELOC    " // first_name // second_name // "   CPHI")
         call log%result("  " // generals([spec%rolling%chi, spec%rolling%dq]) &
            & // smart(spec%rolling%veloc, 12, 4, 4) // smarts([first, second, given%cphi]))
      end if
      if (given%spinxo == 0.0_wp .and. given%spinyo == 0.0_wp) return
      call log%result("")
      call log%result(heading([character(len=9) :: "SPINXO", "SPINYO"]))
      call log%result("  " // generals([given%spinxo, given%spinyo]))
   end subroutine write_kinematics
end module contact_output_report_input
