!> The .out file as public scripts read it: search for texts, skip lines, split on blanks
program test_report
   use contact_base_case_status, only : case_status, missed_iteration
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending
   use contact_cases_spec, only : case_spec
   use contact_output_formats, only : smart
   use contact_output_report, only : timer_line, write_banner, write_case, write_case_line, write_closing, write_end, &
      & write_subsurface
   use contact_patch_result, only : patch_result
   use contact_test_harness, only : test_suite
   use output_sample, only : fill_sample, find_line, numbers_on, read_lines, text_line, word_count
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("output report")
   call check_all_combinations()
   call check_solution_line()
   call check_noise()
   call check_plasticity()
   call check_hertz()
   call check_friction_rows()
   call check_picture()
   call check_subsurface()
   call check_edges()
   call suite%finish()

contains

   !> Write a file with one case
   subroutine write_file(spec, result, case_number, lines)
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      integer, intent(in) :: case_number
      type(text_line), allocatable, intent(out) :: lines(:)
      type(log_type) :: log
      type(timer_line) :: timers(2)
      character(len=:), allocatable :: reason
      logical :: complete

      timers(1) = timer_line("total", 1, 2.0_wp, 4.0_wp)
      timers(2) = timer_line("part", 3, 1.0_wp, 1.0_wp)
      call log%out%open_file("report.out", reason)
      call write_banner(log, "0.0")
      call write_case_line(log, case_number, 0)
      call write_case(log, spec, result)
      call write_subsurface(log, spec, result)
      call write_end(log, 2, timers)
      call write_closing(log, .false.)
      call log%out%close_file(complete)
      call suite%check(complete, "the report is complete")
      call read_lines("report.out", lines)
   end subroutine write_file

   subroutine check_all_combinations()
      type(case_spec) :: spec
      type(patch_result) :: result
      type(text_line), allocatable :: lines(:)
      character(len=24) :: label
      integer :: level, motion, force, normal

      do level = 0, 6
         do motion = 0, 3
            do force = 0, merge(2, 0, motion > 0)
               do normal = 0, 1
                  write(label, "(a, 4i2)") "O, T, F, N =", level, motion, force, normal
                  call fill_sample(spec, result, 12, 10)
                  spec%output_level = level
                  spec%motion = motion
                  spec%force = force
                  spec%normal = normal
                  call write_file(spec, result, 7, lines)
                  call check_file(lines, level, motion, force, normal, label)
               end do
            end do
         end do
      end do
   end subroutine check_all_combinations

   !> What a parser needs of one file
   subroutine check_file(lines, level, motion, force, normal, label)
      type(text_line), intent(in) :: lines(:)
      integer, intent(in) :: level, motion, force, normal
      character(len=*), intent(in) :: label
      real(wp), allocatable :: values(:)
      integer :: i, at, cases

      call suite%check(index(lines(2)%text, "detailed investigation of 3D") > 0, label // ": file is recognised")
      cases = 0
      do i = 1, size(lines)
         if (index(lines(i)%text, "Case") > 0) cases = cases + 1
      end do
      call suite%equal(cases, 1, label // ": number of lines with the word that counts cases")
      call suite%equal(lines(find_line(lines, "Case", 1))%text, " Case     7", label // ": line of the case")
      if (level == 0) then
         call suite%equal(find_line(lines, "ELAST.EN.", 1), 0, label // ": no results")
         call suite%equal(find_line(lines, "EFFECTS:", 1), 0, label // ": no line of effects")
         return
      end if

      at = find_line(lines, "ELAST.EN.   FRIC", 1)
      call suite%check(at > 0, label // ": results are found")
      if (at == 0) return
      if (level >= 2) call suite%equal(find_line(lines, " TOTAL FORCES, TORSIONAL MOMENT, ELASTIC ENERGY, FRICTIONAL POWER", &
         & 1), at - 1, label // ": title two lines above the values")
      call suite%equal(word_count(lines(at)%text), 6, label // ": names of the first line")
      call suite%check((index(lines(at)%text, "FRIC.POWER") > 0) .eqv. (motion >= 2), label // ": work or power")
      values = numbers_on(lines(at + 1)%text)
      call suite%equal(size(values), 6, label // ": numbers of the first line")
      if (size(values) == 6) call suite%close_to(values, [100000.0_wp, -15000.0_wp, 7500.0_wp, 0.0_wp, 3.62_wp, -1250.0_wp], &
         & 1.0e-3_wp, label // ": totals")
      values = numbers_on(lines(at + 3)%text)
      call suite%equal(size(values), 5, label // ": numbers of the second line")
      if (size(values) == 5) call suite%close_to(values, [1.22_wp, merge(1.0e-3_wp, -0.5_wp, force >= 1), &
         & merge(-2.0e-3_wp, 0.25_wp, force == 2), 0.0819_wp, 770.6_wp], 1.0e-3_wp, label // ": second line of totals")
      call suite%check((index(lines(at + 2)%text, merge("CREEP X", "SHIFT X", motion >= 2)) > 0) .eqv. (force >= 1), &
         & label // ": creepage or shift along x")
      call suite%check((index(lines(at + 2)%text, merge("CREEP Y", "SHIFT Y", motion >= 2)) > 0) .eqv. (force == 2), &
         & label // ": creepage or shift along y")
      call suite%check(find_line(lines, " EFFECTS: ", at) == at + 4 .or. level >= 2, label // ": line about the solution")

      at = find_line(lines, "KINEMATIC CONSTANTS", 1)
      call suite%check((at > 0) .eqv. (level >= 2), label // ": kinematics are echoed from level 2 on")
      if (level < 2) return
      values = numbers_on(lines(at + 2)%text)
      call suite%equal(size(values), merge(6, 5, motion >= 2), label // ": numbers of the kinematics")
      call suite%equal(word_count(lines(at + 1)%text), size(values), label // ": names of the kinematics")
      call suite%check((index(lines(at + 1)%text, "CHI") > 0) .eqv. (motion >= 2), label // ": CHI in rolling")
      call suite%check((index(lines(at + 1)%text, "CKSI") > 0) .eqv. (force == 0), label // ": CKSI when prescribed")
      call suite%check((index(lines(at + 1)%text, "CETA") > 0) .eqv. (force <= 1), label // ": CETA when prescribed")
      call suite%check((find_line(lines, " PROBLEM WITH PRESCRIBED NORMAL FORCE, FULL SOLUTION", 1) > 0) .eqv. (normal == 1), &
         & label // ": normal force prescribed")
      call suite%check((find_line(lines, " PROBLEM WITH PRESCRIBED APPROACH, FULL SOLUTION", 1) > 0) .eqv. (normal == 0), &
         & label // ": approach prescribed")

      at = find_line(lines, " CONTACT STATISTICS", 1)
      call suite%check(at > 0, label // ": statistics are found")
      values = numbers_on(lines(at + 4)%text)
      call suite%equal(size(values), 6, label // ": numbers of the statistics")
      if (size(values) == 6) call suite%equal(nint(values(1)), 120, label // ": number of elements")
      if (size(values) == 6) call suite%equal(nint(values(3) + values(4)), nint(values(2)), label // ": sum of the states")
      call suite%check(index(lines(at + 1)%text, " N:") == 1 .and. index(lines(at + 2)%text, " POT:") == 1 .and. &
         & index(lines(at + 2)%text, "CON:") > 0, label // ": explanation of the statistics")
      call suite%equal(find_line(lines, " EFFECTS: ", at), at + 5, label // ": line about the solution follows")
      call suite%check((find_line(lines, "FORM OF THE CONTACT", at) > 0) .eqv. (level >= 3), label // ": picture")
      at = find_line(lines, "QUANTITIES DISTRIBUTED", at)
      call suite%check((at > 0) .eqv. (level >= 5), label // ": table")
      if (at > 0) call check_table(lines, at, level, motion, label)
   end subroutine check_file

   !> Every line of the table has its numbers; all rows appear at level 6
   subroutine check_table(lines, start, level, motion, label)
      type(text_line), intent(in) :: lines(:)
      integer, intent(in) :: start, level, motion
      character(len=*), intent(in) :: label
      integer :: i, rows, elements

      rows = 0
      elements = 0
      do i = start, size(lines)
         if (index(lines(i)%text, " ROW") > 0) rows = rows + 1
         if (rows == 0) cycle
         if (lines(i)%text == "" .and. lines(i - 1)%text /= "" .and. index(lines(i - 1)%text, "ROW") == 0) then
            if (index(lines(min(i + 1, size(lines)))%text, " ROW") == 0) exit
         end if
         if (size(numbers_on(lines(i)%text)) == merge(5, 9, motion == 0)) elements = elements + 1
      end do
      if (level == 6) then
         call suite%equal(rows, 10, label // ": rows of the full table")
         call suite%equal(elements, 120, label // ": elements of the full table")
      else
         call suite%check(rows < 10 .and. elements > 60 .and. elements < 100, label // ": elements in contact")
      end if
   end subroutine check_table

   !> Effects, solvers, fall-back and failure are reported in words before all numbers
   subroutine check_solution_line()
      type(case_spec) :: spec
      type(patch_result) :: result
      type(text_line), allocatable :: lines(:)
      integer :: at

      call fill_sample(spec, result, 12, 10)
      spec%output_level = 1
      spec%motion = 3
      spec%force = 0
      call write_file(spec, result, 1, lines)
      at = find_line(lines, " EFFECTS: ", 1)
      call suite%equal(lines(at)%text, " EFFECTS: none; SOLVER: first method, second method; RESIDUAL: 1.2E-09, 3.4E-07; " &
         & // "ITERATIONS: 8, 31; CONTACT AREA: " // trim(adjustl(smart(0.048_wp*result%ncon, 12, 4, 4))) // " mm2", "a plain case")

      result%effects = "thin sheet in Case of need"
      result%outer_iterations = 4
      result%residual = 5.6e-5_wp
      result%tangential%gave_up = "third method"
      result%tangential%ended = ending%stagnated
      result%tangential%tolerance = 1.0e-6_wp
      call result%status%record_iteration(missed_iteration%tangential, "tangential problem", result%tangential)
      call write_file(spec, result, 1, lines)
      at = find_line(lines, " EFFECTS: ", 1)
      call suite%check(index(lines(at)%text, " EFFECTS: thin sheet in case of need;") == 1, "effects, harmless for counters")
      call suite%check(index(lines(at)%text, "5.6E-05 coupled") > 0, "residual of the outer iteration")
      call suite%check(index(lines(at)%text, "FALL-BACK: third method to second method") > 0, "fall-back")
      call suite%check(index(lines(at)%text, "NOT CONVERGED: tangential problem") > 0, "a failure is reported")

      spec%motion = 0
      result%status = case_status()
      call write_file(spec, result, 1, lines)
      at = find_line(lines, " EFFECTS: ", 1)
      call suite%equal(index(lines(at)%text, "second method"), 0, "no tangential solver without tangential problem")
   end subroutine check_solution_line

   !> Values below the tolerance are zeros, at and above it they stay
   subroutine check_noise()
      type(case_spec) :: spec
      type(patch_result) :: result
      type(text_line), allocatable :: lines(:)
      real(wp), allocatable :: values(:)
      integer :: at

      call fill_sample(spec, result, 12, 10)
      spec%output_level = 1
      spec%motion = 3
      spec%force = 0
      result%fx = -0.14_wp
      result%fx_rel = -4.9e-6_wp
      result%fy = 0.16_wp
      result%fy_rel = 5.1e-6_wp
      call write_file(spec, result, 1, lines)
      at = find_line(lines, "ELAST.EN.   FRIC", 1)
      call suite%check(index(lines(at + 1)%text, "-0.") == 0, "no negative zero")
      values = numbers_on(lines(at + 1)%text)
      call suite%close_to(values(2:3), [0.0_wp, 0.16_wp], 1.0e-12_wp, "small forces")
      values = numbers_on(lines(at + 3)%text)
      call suite%close_to(values(2:3), [0.0_wp, 5.1e-6_wp], 1.0e-12_wp, "small relative forces")

      spec%force = 2
      result%cksi = 1.0e-3_wp
      result%ceta = -0.9e-8_wp
      call write_file(spec, result, 1, lines)
      values = numbers_on(lines(at + 3)%text)
      call suite%close_to(values(2:3), [1.0e-3_wp, 0.0_wp], 1.0e-12_wp, "small computed creepage")
   end subroutine check_noise

   !> Seven numbers in the statistics exactly when the layer can yield
   subroutine check_plasticity()
      type(case_spec) :: spec
      type(patch_result) :: result
      type(text_line), allocatable :: lines(:)
      real(wp), allocatable :: values(:)
      integer :: at

      allocate(values(0))
      call fill_sample(spec, result, 12, 10)
      spec%output_level = 2
      spec%motion = 1
      spec%material_model = 4
      spec%material%tau_c0 = 560.0_wp
      result%nplast = 4
      call write_file(spec, result, 1, lines)
      at = find_line(lines, " CONTACT STATISTICS", 1)
      values = numbers_on(lines(at + 4)%text)
      call suite%equal(size(values), 7, "seven numbers with plasticity")
      call suite%equal(nint(values(5)), 4, "plastic elements")
      call suite%equal(lines(at + 3)%text, "    NPOT   NCON   NADH  NSLIP  NPLAST INORM  ITANG", "heading with plasticity")
      call suite%check(find_line(lines, " INTERFACIAL LAYER PARAMETERS", 1) > 0, "layer is echoed")

      spec%material%tau_c0 = 0.0_wp
      call write_file(spec, result, 1, lines)
      at = find_line(lines, " CONTACT STATISTICS", 1)
      call suite%equal(lines(at + 3)%text, "    NPOT   NCON   NADH  NSLIP  INORM  ITANG", "heading without plasticity")
   end subroutine check_plasticity

   !> Titles and columns of the Hertz block
   subroutine check_hertz()
      type(case_spec) :: spec
      type(patch_result) :: result
      type(text_line), allocatable :: lines(:)
      integer :: at, option

      do option = -6, -1
         call fill_sample(spec, result, 12, 10)
         allocate(result%hertz)
         spec%output_level = 2
         spec%grid%form = option
         spec%normal = 1
         spec%solver = 5
         spec%iteration%fdecay = -3.0_wp
         call write_file(spec, result, 1, lines)
         at = find_line(lines, " GEOMETRY WITH PRESCRIBED NORMAL FORCE", 1)
         call suite%check(at > 0, "title of the Hertz block")
         at = find_line(lines, " DISCRETISATION MX,MY, DX,DY:", at)
         call suite%equal(lines(at)%text(44:), "    12    10  0.2000      0.2400    ", "numbers begin in column 44")
         call suite%check((find_line(lines, "THE CURVATURES", 1) > 0) .eqv. (option /= -1 .and. option /= -6), &
            & "derived curvatures")
         at = find_line(lines, " PARAMETERS FOR SOLVER GDSTEADY", 1)
         call suite%check(index(lines(at + 1)%text, "KDOWN") > 0, "number of steps down of the gradient solver")
         call suite%equal(size(numbers_on(lines(at + 2)%text)), 8, "parameters of the gradient solver")
      end do
   end subroutine check_hertz

   !> Friction per row is shortened below level 4
   subroutine check_friction_rows()
      type(case_spec) :: spec
      type(patch_result) :: result
      type(text_line), allocatable :: lines(:)
      integer :: at, level, i

      do level = 2, 4, 2
         call fill_sample(spec, result, 12, 10)
         deallocate(spec%friction%sets)
         allocate(spec%friction%sets(10))
         spec%variation = 3
         spec%friction_law = 4
         spec%output_level = level
         spec%motion = 3
         spec%force = 1
         call write_file(spec, result, 1, lines)
         at = find_line(lines, " FRICTION LAW PARAMETERS", 1)
         i = at + 2
         do while (lines(i)%text /= "")
            i = i + 1
         end do
         call suite%equal(i - at - 2, merge(10, 5, level >= 4), "rows of the friction table")
         call suite%equal(size(numbers_on(lines(at + 2)%text)), 6, "numbers of one row")
         call suite%check(find_line(lines, " VLDCMZE.  VARFRC 3, FRCLAW 4", 1) > 0, "digits with variation")
         call suite%check(find_line(lines, "FX/FN", 1) > 0 .and. find_line(lines, "FX/FSTAT/FN", 1) == 0, &
            & "forces are relative to the normal force")
      end do
   end subroutine check_friction_rows

   !> Symbols, window, column numbers
   subroutine check_picture()
      type(case_spec) :: spec
      type(patch_result) :: result
      type(text_line), allocatable :: lines(:)
      integer :: at

      call fill_sample(spec, result, 5, 3)
      spec%output_level = 3
      spec%motion = 3
      result%division = 0
      result%division(2:4, 2) = [2, 2, 1]
      call write_file(spec, result, 1, lines)
      at = find_line(lines, " FORM OF THE CONTACT, ADHESION AND SLIP-AREA`S:", 1)
      call suite%equal(lines(at + 1)%text, "     3   o . . . o", "highest row")
      call suite%equal(lines(at + 2)%text, "     2   . S S * .", "row with contact")
      call suite%equal(lines(at + 3)%text, "     1   o . . . o", "lowest row")
      call suite%equal(lines(at + 4)%text, "         1 2 3 4 5", "column numbers")
      call suite%equal(lines(at + 5)%text, "     X  -->        Chi=  0.00 degrees", "direction")

      call fill_sample(spec, result, 60, 40)
      spec%output_level = 3
      result%division = 0
      result%division(8:58, 20) = 1
      result%division(9, 20) = 3
      call write_file(spec, result, 1, lines)
      at = find_line(lines, " FORM OF THE CONTACT", 1)
      call suite%equal(lines(at + 1)%text, "    21  o" // repeat(".", 51) // "o", "window of a large grid")
      call suite%equal(lines(at + 2)%text, "    20  .*|" // repeat("*", 49) // ".", "plasticity, no blanks between")
      call suite%equal(lines(at + 4)%text(1:22), "           1         2", "tens")
      call suite%equal(lines(at + 6)%text, "     X  -->", "no direction without rolling")

      result%division = 0
      call write_file(spec, result, 1, lines)
      at = find_line(lines, " FORM OF THE CONTACT", 1)
      call suite%equal(lines(at + 1)%text, "    25   o . . . . . . . . . o", "no contact: eleven around the middle")
   end subroutine check_picture

   !> Extremes in fixed columns, points on request
   subroutine check_subsurface()
      type(case_spec) :: spec
      type(patch_result) :: result
      type(text_line), allocatable :: lines(:)
      integer :: at, i, level

      do level = 0, 4
         call fill_sample(spec, result, 12, 10)
         spec%has_stress = .true.
         spec%subsurface%output = level
         allocate(result%subsurface(1))
         result%subsurface(1)%nx = 2
         result%subsurface(1)%ny = 1
         result%subsurface(1)%nz = 1
         result%subsurface(1)%position = reshape([0.0_wp, 0.5_wp, 0.1_wp, 1.0_wp, 0.5_wp, 0.1_wp], [3, 2])
         result%subsurface(1)%displacement = reshape([(real(i, wp), i = 1, 6)], [3, 2])
         result%subsurface(1)%stress = reshape([(-real(i, wp), i = 1, 12)], [6, 2])
         result%subsurface(1)%sighyd = [-3.0_wp, 2.0_wp]
         result%subsurface(1)%sigvm = [1.0_wp, 4.0_wp]
         result%subsurface(1)%sigtr = [5.0_wp, 5.0_wp]
         result%subsurface(1)%sigma1 = [-1.0_wp, -2.0_wp]
         result%subsurface(1)%sigma3 = [-7.0_wp, -123456.0_wp]
         call write_file(spec, result, 1, lines)
         at = find_line(lines, " SUBSURFACE STRESSES BLOCK  1:", 1)
         call suite%check((at > 0) .eqv. (level > 0), "block on request, independent of the output level")
         if (level == 0) cycle
         call suite%equal(lines(at + 2)%text, " ABSMAX SIGHYD =    -3.000 AT (X,Y,Z) = (   0.000,   0.500,   0.100)", &
            & "largest magnitude with sign")
         call suite%equal(lines(at + 4)%text(16:16), "=", "fixed columns")
         call suite%equal(lines(at + 4)%text(42:49), "   0.000", "the first of equals wins")
         call suite%equal(lines(at + 5)%text(1:26), " MAX    SIGMA1 =    -1.000", "largest principal stress")
         call suite%check(index(lines(at + 6)%text, "*") == 0, "no stars for large stresses")
         call suite%equal(lines(at + 9)%text(1:26), " ABSMAX  SIGZZ =   -12.000", "stress component")
         call suite%check((find_line(lines, " Position (X,Y,Z):", at) > 0) .eqv. (level == 4), "points on request")
         if (level == 4) call suite%equal(lines(find_line(lines, " Position", at) + 3)%text, &
            & "  2     2.000    ;   -2.000      -4.000      -5.000    ", "second row of the stress tensor")
      end do
   end subroutine check_subsurface

   !> No contact arrays, no log, large case numbers, result elements
   subroutine check_edges()
      type(case_spec) :: spec
      type(patch_result) :: result
      type(text_line), allocatable :: lines(:)
      type(log_type) :: log
      character(len=:), allocatable :: reason
      logical :: complete

      spec%output_level = 6
      call write_case(log, spec, result)
      call write_file(spec, result, 123456, lines)
      call suite%equal(lines(find_line(lines, " Case", 1))%text, " Case  123456", "large number of a case")
      call suite%equal(find_line(lines, "FORM OF THE CONTACT", 1), 0, "no picture without element division")

      call log%out%open_file("element.out", reason)
      call write_case_line(log, 12, 3)
      call log%out%close_file(complete)
      call suite%check(complete, "the report is complete")
      call read_lines("element.out", lines)
      call suite%equal(lines(2)%text, " Case    12, result element   3", "result element")

      call fill_sample(spec, result, 1, 1)
      spec%output_level = 6
      spec%motion = 2
      call write_file(spec, result, 1, lines)
      call suite%check(find_line(lines, " Y = ", 1) > 0, "a single element")
   end subroutine check_edges
end program test_report
