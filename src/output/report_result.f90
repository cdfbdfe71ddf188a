!> Results of a case in the .out file: totals, sensitivities, statistics, solution
module contact_output_report_result
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_accuracy_report, only : accuracy_report
   use contact_base_case_status, only : case_status
   use contact_base_choices, only : force_control, is_rolling, motion, pressure_model, variation
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : solve_report
   use contact_cases_spec, only : case_spec
   use contact_output_formats, only : formatted, scientific, smart, whole
   use contact_output_report_lines, only : write_title
   use contact_patch_quantities, only : error_law, total_list
   use contact_patch_result, only : patch_result
   use contact_text_words, only : integer_text, real_text
   implicit none (type, external)
   private

   public :: ending_text, remove_noise, write_accuracy, write_errors, write_sensitivities, write_solution_line, &
      & write_statistics, write_total_lines, write_totals

   !> Number of errors of totals per line
   integer, parameter :: errors_per_line = 5

contains

   !> A number with two significant digits
   pure function short(number) result(text)
      real(wp), intent(in) :: number
      character(len=len_trim(adjustl(scientific(number, 10, 1)))) :: text

      text = adjustl(scientific(number, 10, 1))
   end function short

   !> Set totals below the tolerance of the solution to zero for printing
   pure subroutine remove_noise(spec, totals)
      type(case_spec), intent(in) :: spec
      type(total_list), intent(inout) :: totals
      character(len=6), parameter :: forces(*) = [character(len=6) :: "fx", "fy", "mz"], relative(*) = ["fx_rel", "fy_rel"]
      real(wp) :: small, scale(2)
      integer :: k

      small = 0.5_wp*spec%iteration%eps
      scale = totals%of([character(len=7) :: "fn", "mu_scal"])
      do k = 1, size(forces)
         associate (value => totals%rows(totals%place_of(forces(k)))%value)
            value = clean(value, small*abs(scale(1))*scale(2))
         end associate
      end do
      do k = 1, size(relative)
         associate (value => totals%rows(totals%place_of(relative(k)))%value)
            value = clean(value, small)
         end associate
      end do
      if (any(spec%pressure == [pressure_model%elliptical, pressure_model%parabolical, pressure_model%sdec])) &
         & totals%rows(totals%place_of("elastic_energy"))%value = 0.0_wp
   end subroutine remove_noise

   !> Zero if the magnitude is below the limit
   elemental real(wp) function clean(value, limit)
      real(wp), intent(in) :: value, limit
      clean = value
      if (abs(value) < limit) clean = 0.0_wp
   end function clean

   !> Write totals of a contact problem: forces, energy, approach, and the creepages or relative forces that were not prescribed
   subroutine write_totals(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      type(total_list) :: totals
      character(len=12) :: names(2)
      logical :: rolling
      real(wp) :: values(3)

      call result%totals(totals)
      call remove_noise(spec, totals)
      rolling = is_rolling(spec%motion)
      names = [character(len=12) :: "FX/FSTAT/FN", "FY/FSTAT/FN"]
      if (spec%variation == variation%by_row) names = [character(len=12) :: "  FX/FN", " FY/FN"]
      values = [result%fn/result%gg, totals%of(["fx_rel", "fy_rel"])]
      if (spec%force >= force_control%fx_and_ceta) then
         names(1) = merge(" CREEP X", " SHIFT X", rolling)
         values(2) = clean(result%cksi, spec%iteration%eps*abs(result%ceta))
      end if
      if (spec%force == force_control%fx_and_fy) then
         names(2) = merge(" CREEP Y", " SHIFT Y", rolling)
         values(3) = clean(result%ceta, spec%iteration%eps*abs(result%cksi))
      end if
      call write_total_lines(log, spec, totals, "     FN          FX          FY          MZ         ELAST.EN.   FRIC." &
         & // trim(merge("POWER", "WORK ", rolling)), [totals%of(["fn", "fx", "fy", "mz"]), &
         & totals%of(["elastic_energy"]), result%friction_power], "     FN/G      " // names(1) // " " // names(2) // " ", values, &
         & "FY")
   end subroutine write_totals

   !> Write lines of totals: the first six; the next three, approach, maximum pressure, and those with a heading; damping forces
   subroutine write_total_lines(log, spec, totals, first_heading, first, second_heading, second, lateral)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(total_list), intent(in) :: totals
      !> Names of the values that follow
      character(len=*), intent(in) :: first_heading, second_heading
      !> Numbers of the first line, and of the second line before the approach, as printed
      real(wp), intent(in) :: first(6), second(3)
      !> Name of the lateral force
      character(len=2), intent(in) :: lateral
      character(len=:), allocatable :: names, values
      real(wp) :: approach(2)
      integer :: k

      if (spec%output_level >= 2) call write_title(log, " TOTAL FORCES, TORSIONAL MOMENT, ELASTIC ENERGY, FRICTIONAL POWER")
      call log%result(first_heading)
      call log%result("  " // formatted(first, "S"))
      approach = totals%of([character(len=4) :: "pen", "pmax"])
      names = second_heading // "APPROACH     PMAX    "
      values = smart(approach(1), 12, 6, 4) // smart(approach(2), 12, 4, 4)
      do k = 1, totals%length
         if (totals%rows(k)%heading == "") cycle
         names = names // adjustr(totals%rows(k)%heading)
         values = values // smart(totals%rows(k)%value, 12, 4, 4)
      end do
      call log%result(names)
      call log%result("  " // formatted(second, "S") // values)
      if (.not. any(totals%rows(:totals%length)%name == "fn_damp")) return
      if (spec%output_level >= 2) call log%result("")
      call log%result(" DAMPING FORCES, NOT INCLUDED ABOVE:    FN          FX          " // lateral)
      call log%result("                                  " // formatted(totals%of(["fn_damp", "fx_damp", "fy_damp"]), "S"))
   end subroutine write_total_lines

   !> Write derivatives of the forces with respect to approach, creepages and spin
   subroutine write_sensitivities(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      character(len=2), parameter :: force_name(3) = ["FN", "FX", "FY"]
      character(len=:), allocatable :: row
      real(wp) :: table(3, 4)
      integer :: i, j

      if (spec%motion == motion%none) then
         call write_title(log, " THE SENSITIVITIES.")
         call log%result(" ZERO MEANS: NOT COMPUTED.")
         call log%result("  DFN/DPEN")
         call log%result(smart(result%sensitivity(1, 1), 12, 3, 3))
         return
      end if
      if (spec%variation == variation%by_row) then
         call write_title(log, " THE SENSITIVITIES. FX, FY STAND FOR (FX, FY)/FN.")
      else
         call write_title(log, " THE SENSITIVITIES. FX, FY STAND FOR (FX, FY)/FN/FSTAT.")
      end if
      call log%result(" ZERO MEANS: NOT COMPUTED.")
      call log%result("         DF/DPEN     DF/DKSI     DF/DETA     DF/DPHI")
      table = result%sensitivity(1:3, :)
      do j = 1, 4
         table(2:3, j) = clean(table(2:3, j), spec%iteration%epsens*maxval(abs(table(2:3, j))))
      end do
      do i = 1, 3
         row = "   " // force_name(i) // " "
         do j = 1, 4
            row = row // smart(table(i, j), 12, 3, 3)
         end do
         call log%result(row)
      end do
   end subroutine write_sensitivities

   !> Write the lines of the .out file: requested accuracy, what was chosen, estimated error, and computing time
   subroutine write_accuracy(log, report)
      type(log_type), intent(inout) :: log
      !> Report of the case on its accuracy
      type(accuracy_report), intent(in) :: report
      character(len=:), allocatable :: line

      call log%result("")
      line = " REQUIRED ACCURACY: " // short(report%required) // " OF THE FORCES, "
      if (report%is_met) then
         line = line // "REACHED"
      else
         line = line // "NOT REACHED: " // trim(report%reason)
      end if
      call log%result(line)
      line = "   estimated error "
      if (report%estimated < 0.0_wp) then
         line = line // "unknown"
      else
         line = line // short(report%estimated)
      end if
      line = line // ", elements"
      if (report%elements(1) > 0) line = line // " " // integer_text(report%elements(1)) // " x " // &
         & integer_text(report%elements(2))
      line = line // " of " // real_text(report%sides(1)) // " x " // real_text(report%sides(2)) // " mm"
      if (report%order > 0) line = line // ", order " // integer_text(report%order)
      call log%result(line // ", EPS " // short(report%eps))
      if (report%method /= "") call log%result("   simplified methods allowed: " // trim(report%method))
      line = "   " // integer_text(report%levels) // " grid"
      if (report%levels /= 1) line = line // "s"
      call log%result(line // ", " // short(report%seconds) // " s, of which the last one " // short(report%last_seconds) // " s")
   end subroutine write_accuracy

   !> Write estimated errors of the totals
   subroutine write_errors(log, errors, totals, reason)
      type(log_type), intent(inout) :: log
      !> Errors of the first totals of the list, in their units; NaN: none
      real(wp), intent(in) :: errors(:)
      type(total_list), intent(in) :: totals
      !> Reason why there is no estimate; "" if there is one
      character(len=*), intent(in) :: reason
      character(len=:), allocatable :: line, without
      integer :: k, n

      call write_title(log, " ESTIMATED ERRORS OF THE TOTALS, in their units")
      line = ""
      without = ""
      n = 0
      do k = 1, size(errors)
         associate (row => totals%rows(k))
            if (.not. row%in_files .or. row%law == error_law%none) cycle
            if (.not. ieee_is_finite(errors(k))) then
               without = without // " " // trim(row%name)
               cycle
            end if
            line = line // "  " // trim(row%name) // ": " // short(errors(k))
            if (row%unit /= "-") line = line // " " // trim(row%unit)
            n = n + 1
            if (mod(n, errors_per_line) > 0) cycle
         end associate
         call log%result("  " // line)
         line = ""
      end do
      if (len(line) > 0) call log%result("  " // line)
      if (len(without) > 0) call log%result("   given, or without an estimate:" // without)
      if (reason /= "") call log%result("   no estimate: " // reason)
   end subroutine write_errors

   !> Write numbers of elements per state, and iterations of the solvers
   subroutine write_statistics(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      character(len=:), allocatable :: names, numbers

      names = "    NPOT   NCON   NADH  NSLIP  "
      numbers = " " // whole(result%grid%npot(), 7) // whole(result%ncon, 7) // whole(result%nadh, 7) &
         & // whole(result%nslip, 7)
      if (spec%has_plasticity()) then
         names = names // "NPLAST "
         numbers = numbers // whole(result%nplast, 7)
      end if
      call write_title(log, " CONTACT STATISTICS")
      call log%result(" N: ELEMENTS IN A REGION,  I: PASSES OF A SOLVER (NEGATIVE: FAILED),")
      call log%result(" POT: POTENTIAL CONTACT AREA,  CON: CONTACT,  ADH: ADHESION")
      call log%result(names // "INORM  ITANG")
      call log%result(numbers // whole(result%inorm, 7) // whole(result%itang, 7))
   end subroutine write_statistics

   !> Write effects included, final solvers and their accuracy: one line of free text
   !>
   !> It begins with a blank and has words before all numbers, so that readers of columns skip it.
   subroutine write_solution_line(log, spec, result, status)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      !> Status of the case of the patch
      type(case_status), intent(in) :: status
      character(len=:), allocatable :: line
      logical :: has_tangential

      has_tangential = spec%motion /= motion%none
      line = " EFFECTS: "
      if (allocated(result%effects)) then
         line = line // harmless(result%effects)
      end if
      if (line == " EFFECTS: ") line = line // "none"
      line = line // "; SOLVER: " // method_name(result%normal)
      if (has_tangential) line = line // ", " // method_name(result%tangential) // order_text(result%tangential)
      if (has_tangential .and. result%tangential%asked /= "") line = line // " instead of " // harmless(result%tangential%asked)
      line = line // "; RESIDUAL: " // trim(residual_text(result%normal%residual))
      if (has_tangential) line = line // ", " // trim(residual_text(result%tangential%residual))
      if (has_tangential .and. result%outer_iterations > 1) &
         & line = line // ", " // trim(residual_text(result%residual)) // " coupled"
      line = line // "; ITERATIONS: " // whole(result%normal%iterations, 1)
      if (has_tangential) line = line // ", " // whole(result%tangential%iterations, 1)
      if (has_tangential .and. result%outer_iterations > 1) &
         & line = line // ", " // whole(result%outer_iterations, 1) // " outer"

      if (allocated(result%friction)) line = line // ", " // whole(result%friction%iterations, 1) // " friction"

      line = line // "; CONTACT AREA: " // trim(adjustl(smart(result%contact_area(), 12, 4, 4))) // " mm2"
      call add_fall_back(line, result%normal)
      if (has_tangential) call add_fall_back(line, result%tangential)
      if (.not. status%is_solved()) line = line // ";" // harmless(ending_text(status))
      call log%result(line)
   end subroutine write_solution_line

   !> What did not converge, for a line of the .out file
   pure function ending_text(status) result(text)
      !> Status of a case that was not solved
      type(case_status), intent(in) :: status
      character(len=len(" NOT CONVERGED: ") + len(status%reason)) :: text

      text = " NOT CONVERGED: " // status%reason
   end function ending_text

   !> Name of the final method of an iteration
   pure function method_name(report) result(name)
      type(solve_report), intent(in) :: report
      character(len=merge(len("none"), len_trim(report%method), report%method == "")) :: name

      name = harmless(report%method)
      if (name == "") name = "none"
   end function method_name

   !> Order of the discretisation if the second was requested, with the reason if it is the first
   pure function order_text(report) result(text)
      type(solve_report), intent(in) :: report
      character(len=merge(0, len(" of order 1") + merge(0, len_trim(report%order_reason) + 3, report%order_reason == ""), &
         & report%order == 0)) :: text

      if (report%order == 0) return
      text = " of order " // achar(iachar("0") + report%order)
      if (report%order_reason /= "") text = trim(text) // " (" // trim(report%order_reason) // ")"
   end function order_text

   !> Residual with two significant digits
   pure function residual_text(residual) result(text)
      !> Relative residual, negative if unknown
      real(wp), intent(in) :: residual
      character(len=10) :: text

      text = "unknown"
      if (residual >= 0.0_wp) text = short(residual)
   end function residual_text

   !> Add which method was abandoned, and which replaced it
   pure subroutine add_fall_back(line, report)
      character(len=:), allocatable, intent(inout) :: line
      type(solve_report), intent(in) :: report

      if (report%gave_up == "") return
      line = line // "; FALL-BACK: " // harmless(report%gave_up) // " to " // method_name(report)
   end subroutine add_fall_back

   !> Text without the word by which readers count cases
   pure function harmless(text) result(safe)
      character(len=*), intent(in) :: text
      character(len=len_trim(text)) :: safe
      integer :: at

      safe = text
      do
         at = index(safe, "Case")
         if (at == 0) exit
         safe(at:at) = "c"
      end do
   end function harmless
end module contact_output_report_result
