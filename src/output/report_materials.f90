!> Materials and friction in the .out file, for contact problems and for wheel and rail
module contact_output_report_materials
   use contact_base_choices, only : has_slope_reduction, is_fastrip, material_model, pressure_model, variation
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_collector, only : collected_length, collector, friction_numbers
   use contact_cases_inputs, only : visit_damping, visit_material_model, visit_sheet
   use contact_cases_spec, only : case_spec, damping_spec, friction_set, material_spec, part_source
   use contact_output_formats, only : formatted, general, heading, whole
   use contact_output_report_lines, only : joined, show, write_row, write_title
   implicit none (type, external)
   private

   public :: write_constants, write_flexibilities, write_friction, write_material_model

   !> Below this output level the middle of a friction table per row is omitted
   integer, parameter :: full_friction_table = 4

contains

   !> Write elastic constants, thin sheet, damping, heat
   subroutine write_constants(log, spec, combined)
      type(log_type), intent(inout) :: log
      !> The case, with material constants of both bodies and of the thin sheet between them
      type(case_spec), intent(in) :: spec
      !> Combined Poisson's ratio [-], shear modulus [N/mm2] and difference parameter [-]
      real(wp), intent(in) :: combined(3)
      type(damping_spec) :: damping
      type(collector) :: rates, sheet
      type(material_spec) :: material
      character :: a, b, form
      character(len=60) :: second
      integer :: columns

      a = merge("R", "1", allocated(spec%wheel_rail))
      b = merge("W", "2", allocated(spec%wheel_rail))
      form = merge("S", "G", allocated(spec%wheel_rail))
      call write_title(log, " MATERIAL CONSTANTS")
      call write_row(log, "NU G AK EPS", [combined, spec%iteration%eps], "G" // form // "G" // form)
      call write_title(log, "    POISS(" // a // ")    POISS(" // b // ")     GG(" // a // ")       GG(" // b // ")")
      call log%result("  " // formatted([spec%material%poiss, spec%material%gg], "GG" // form // form))
      if (spec%pressure == pressure_model%thin_sheet) then
         call write_title(log, " ELASTIC THIN SHEET PARAMETERS")
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
      columns = merge(5, 4, allocated(spec%wheel_rail) .and. spec%material_model == material_model%interfacial_layer)
      associate (heat => spec%heat)
         call write_row(log, "BKTEMP HEATCP LAMBDA DENSITY" // merge(" BETAPL", "       ", columns == 5), &
            & [heat%bktemp(1), heat%heatcp(1), heat%lambda(1), heat%dens(1)], "G")
         second = formatted([heat%bktemp(2), heat%heatcp(2), heat%lambda(2), heat%dens(2), heat%betapl], "G")
         call log%result("  " // second(:12*columns))
      end associate
   end subroutine write_constants

   !> Write constants of material models other than elastic
   subroutine write_material_model(log, model, material, velocity, flexibilities, factor)
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
      type(log_type), intent(inout) :: log
      !> Flexibilities [mm3/N]
      real(wp), intent(in) :: values(:)

      call log%result(" SIMPLIFIED THEORY MATERIAL CONSTANTS")
      call write_row(log, "FLX1 FLX2 FLX3", values, "G")
   end subroutine write_flexibilities

   !> Write the friction law: one line, or one per control point or grid row
   subroutine write_friction(log, law, varies, sets, level)
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
      names = trim(heading(joined(line%names)))
      call write_title(log, " FRICTION LAW PARAMETERS")
      select case (varies)
      case (variation%none)
         call log%result(names)
         if (count > 0) call log%result("  " // formatted(line%values, "G"))
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
            call log%result("  " // general(sets(i)%position, 12, 4) // numbers_of(sets(i)))
         end do
      end select

   contains

      !> Values of a set, to be written below their names
      function numbers_of(set) result(text)
         type(friction_set), intent(in) :: set
         character(len=12*size(line%names)) :: text
         type(collector) :: a

         call friction_numbers(a, law, set)
         text = formatted(a%values, "G")
      end function numbers_of
   end subroutine write_friction
end module contact_output_report_materials
