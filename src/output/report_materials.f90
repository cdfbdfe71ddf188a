!> Materials and friction in the .out file, for contact problems and for wheel and rail
module contact_output_report_materials
   use contact_base_choices, only : has_slope_reduction, is_fastrip, material_model, pressure_model, variation
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_collector, only : collected_length, collector, friction_numbers
   use contact_cases_inputs, only : visit_damping, visit_material_model, visit_sheet
   use contact_cases_spec, only : case_spec, damping_spec, friction_set, material_spec, part_source
   use contact_output_formats, only : fixed, general, generals, heading, smart, whole
   implicit none (type, external)
   private

   public :: formatted, show, write_constants, write_flexibilities, write_friction, write_material_model

   !> Below this output level the middle of a friction table per row is omitted
   integer, parameter :: full_friction_table = 4

contains

   !> Write elastic constants, thin sheet, damping, heat
   subroutine write_constants(log, spec, combined)
      !> Receives the lines of the .out file
      type(log_type), intent(inout) :: log
      !> The case, with material constants of both bodies and of the thin sheet between them
      type(case_spec), intent(in) :: spec
      !> Combined Poisson's ratio [-], shear modulus [N/mm2] and difference parameter [-]
      real(wp), intent(in) :: combined(3)
      character(len=9), parameter :: names(5) = [character(len=9) :: "BKTEMP", "HEATCP", "LAMBDA", "DENSITY", "BETAPL"]
      type(damping_spec) :: damping
      type(collector) :: rates, sheet
      type(material_spec) :: material
      character :: a, b, form
      integer :: body, n

      a = merge("R", "1", allocated(spec%wheel_rail))
      b = merge("W", "2", allocated(spec%wheel_rail))
      form = merge("S", "G", allocated(spec%wheel_rail))
      call log%result("")
      call log%result(" MATERIAL CONSTANTS")
      call log%result(heading([character(len=3) :: "NU", "G", "AK", "EPS"]))
      call log%result("  " // formatted([combined, spec%iteration%eps], "G" // form // "G" // form))
      call log%result("")
      call log%result("    POISS(" // a // ")    POISS(" // b // ")     GG(" // a // ")       GG(" // b // ")")
      call log%result("  " // formatted([spec%material%poiss, spec%material%gg], "GG" // form // form))
      if (spec%pressure == pressure_model%thin_sheet) then
         call log%result("")
         call log%result(" ELASTIC THIN SHEET PARAMETERS")
         material = spec%material
         call visit_sheet(sheet, material)
         call show(log, sheet, "G")
      end if
      if (spec%has_damping .and. spec%parts%damping == part_source%given) then
         call log%result("")
         damping = spec%damping
         call visit_damping(rates, damping)
         call show(log, rates, "SSSS")
      end if
      if (.not. spec%has_heat) return
      call log%result("")
      n = merge(5, 4, allocated(spec%wheel_rail) .and. spec%material_model == material_model%interfacial_layer)
      call log%result(heading(names(:n)))
      associate (heat => spec%heat)
         do body = 1, 2
            call log%result("  " // formatted([heat%bktemp(body), heat%heatcp(body), heat%lambda(body), heat%dens(body), &
               & heat%betapl], repeat("G", merge(n, 4, body == 1))))
         end do
      end associate
   end subroutine write_constants

   !> Write constants of material models other than elastic
   subroutine write_material_model(log, model, material, velocity, flexibilities, factor)
      !> Receives the lines of the .out file
      type(log_type), intent(inout) :: log
      !> Member of material_model
      integer, intent(in) :: model
      !> Constants of both bodies
      type(material_spec), intent(in) :: material
      !> Rolling velocity [mm/s], for the relaxation lengths of viscoelastic bodies
      real(wp), intent(in), optional :: velocity
      !> Results of simplified theory: three flexibilities [mm3/N], and the factor of the slope reduction [-]
      real(wp), intent(in), optional :: flexibilities(:), factor
      character(len=collected_length), parameter :: names(6) = [character(len=collected_length) :: "FG(1)", "FG(2)", "TC(1)", &
         & "TC(2)", "VT(1)", "VT(2)"]
      type(collector) :: shown
      type(material_spec) :: copy

      copy = material
      call visit_material_model(shown, model, copy)
      call log%result("")
      if (model == material_model%viscoelastic) then
         call log%result(" VISCOELASTIC MATERIAL CONSTANTS")
         shown%names = names
         if (present(velocity)) shown%values = [shown%values, velocity*material%tc]
         call show(log, shown, "GGSSSS"(:size(shown%values)))
         return
      else if (model == material_model%interfacial_layer) then
         call log%result(" INTERFACIAL LAYER PARAMETERS")
         call show(log, shown, repeat("G", size(shown%values)))
         return
      else if (model == material_model%fastsim_single) then
         call log%result(" SIMPLIFIED THEORY MATERIAL CONSTANTS")
         call show(log, shown, "G")
         call log%result("")
      else if (present(flexibilities)) then
         call write_flexibilities(log, flexibilities)
         call log%result("")
      end if
      if (.not. has_slope_reduction(model)) return
      call log%result(" MODIFIED " // merge("FASTRIP", "FASTSIM", is_fastrip(model)) // " SLOPE REDUCTION PARAMETERS")
      if (present(factor)) then
         shown%names = [character(len=collected_length) :: shown%names, "K_EFF"]
         shown%values = [shown%values, factor]
      end if
      call show(log, shown, repeat("G", merge(4, 3, present(factor))), merge(2, 1, model == material_model%fastsim_single))
   end subroutine write_material_model

   !> Write computed flexibilities of simplified theory
   subroutine write_flexibilities(log, values)
      !> Receives the lines of the .out file
      type(log_type), intent(inout) :: log
      !> Flexibilities [mm3/N]
      real(wp), intent(in) :: values(:)

      call log%result(" SIMPLIFIED THEORY MATERIAL CONSTANTS")
      call log%result(heading([character(len=9) :: "FLX1", "FLX2", "FLX3"]))
      call log%result("  " // generals(values))
   end subroutine write_flexibilities

   !> Write the friction law: one line, or one per control point or grid row
   subroutine write_friction(log, law, varies, sets, level)
      !> Receives the lines of the .out file
      type(log_type), intent(inout) :: log
      !> Members of friction_model and variation
      integer, intent(in) :: law, varies
      !> Parameters: one set, or one per control point or row
      type(friction_set), intent(in) :: sets(:)
      !> Output level
      integer, intent(in) :: level
      type(collector) :: line
      character(len=:), allocatable :: names
      integer :: i, count
      logical :: shorten

      count = size(sets)
      if (count > 0) call friction_numbers(line, law, sets(1))
      if (count == 0) call friction_numbers(line, law, friction_set())
      names = heading(line%names)
      call log%result("")
      call log%result(" FRICTION LAW PARAMETERS")
      select case (varies)
      case (variation%none)
         call log%result(names)
         if (count > 0) call log%result("  " // generals(line%values))
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

      !> Values of a set, to be written below their names
      function numbers_of(set) result(text)
         type(friction_set), intent(in) :: set
         character(len=12*size(line%names)) :: text
         type(collector) :: a

         call friction_numbers(a, law, set)
         text = generals(a%values)
      end function numbers_of
   end subroutine write_friction

   !> Write names of input numbers, and their values below
   subroutine show(log, numbers, forms, first)
      !> Receives two lines
      type(log_type), intent(inout) :: log
      !> Names and values in the order of the input
      type(collector), intent(in) :: numbers
      !> One letter for each number that is written, as for `formatted`
      character(len=*), intent(in) :: forms
      !> Index of the first number that is written; default 1
      integer, intent(in), optional :: first
      integer :: before

      before = 0
      if (present(first)) before = first - 1
      call log%result(heading(numbers%names(before + 1:before + len(forms))))
      call log%result("  " // formatted(numbers%values(before + 1:before + len(forms)), forms))
   end subroutine show

   !> Values in 12 columns each
   pure function formatted(values, forms) result(line)
      !> Values in internal units
      real(wp), intent(in) :: values(:)
      !> One letter for each value: G: general, S: smart, L: smart with six digits, F: fixed with four decimals, P: with seven
      character(len=*), intent(in) :: forms
      character(len=12*len(forms)) :: line
      integer :: k

      do k = 1, len(forms)
         associate (value => values(k), field => line(12*k - 11:12*k))
            select case (forms(k:k))
            case ("S"); field = smart(value, 12, 4, 4)
            case ("L"); field = smart(value, 12, 4, 6)
            case ("F"); field = fixed(value, 12, 4)
            case ("P"); field = fixed(value, 12, 7)
            case default; field = general(value, 12, 4)
            end select
         end associate
      end do
   end function formatted
end module contact_output_report_materials
