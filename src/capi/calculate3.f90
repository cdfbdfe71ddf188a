!> Calculation for a contact problem (module 3) of a caller, from settings to results and files
module contact_capi_calculate3
   use contact_base_case_status, only : case_status
   use contact_base_choices, only : estimate_choice, force_control, motion, normal_control, slip_source, time_link
   use contact_base_error, only : error_type, fatal_error, full_text
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_capi_files, only : find_result_file, find_working_folder
   use contact_capi_input_dump, only : dump_contact_case
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : report_error
   use contact_capi_problem, only : library_problem
   use contact_cases_accuracy, only : solve_contact_case
   use contact_cases_continuation, only : describe_coefficients, frame_of
   use contact_cases_spec, only : case_spec
   use contact_control_digits, only : case_digits
   use contact_control_library_codes, only : code_of_contact, library_code
   use contact_grid_potential_contact, only : potential_contact
   use contact_input_checks, only : check_case
   use contact_input_control, only : control_words, refuse_unbuilt_digits
   use contact_input_file_reader, only : file_reader
   use contact_input_problems, only : problem_list
   use contact_output_mat_file, only : mat_place, write_mat_file
   use contact_output_report, only : write_case
   use contact_patch_border, only : border_elements
   use contact_patch_time_steps, only : elements_left_out
   implicit none (type, external)
   private

   public :: finish_contact, solve_contact

contains

   !> Solve a case, unless its settings are incompatible
   subroutine solve_contact(problem, digits, log, code, error)
      type(library_problem), intent(inout) :: problem
      !> Effective digits
      type(case_digits), intent(in) :: digits
      type(log_type), intent(inout) :: log
      !> Member of library_code
      integer, intent(out) :: code
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: folder

      if (digits%e == 1) problem%spec%slip_source = slip_source%given
      call write_case_line(log, problem)
      code = library_code%other
      call check_settings(digits, problem%spec, error)
      if (allocated(error)) return
      code = library_code%discretisation
      call check_coefficients(digits%c == 0, problem%spec, problem%coefficients, error)
      if (allocated(error)) return
      call find_working_folder(folder)
      call solve_contact_case(problem%session, problem%spec, log, problem%result, problem%solved, error, folder)
      code = library_code%other
      if (.not. allocated(error)) return
      if (.not. continues(problem)) code = library_code%discretisation
   end subroutine solve_contact

   !> Store the result as starting point, print it, and write files
   subroutine finish_contact(this, problem, log, status, code)
      type(entry_type), intent(in) :: this
      type(library_problem), intent(inout) :: problem
      type(log_type), intent(inout) :: log
      type(case_status), intent(inout) :: status
      !> Member of library_code, or the number of elements in contact at the border of the grid
      integer, intent(out) :: code
      type(case_spec) :: solved

      if (problem%spec%solve) then
         status = problem%result%status
         problem%has_result = .true.
         call keep_solution(problem)
         ! the effective rolling direction and step are written
         solved = problem%spec
         if (allocated(problem%solved)) solved = problem%solved
         solved%rolling = problem%stored%acting
         call write_results(this, problem, solved, log)
         if (problem%session%started_anew) then
            ! the input that is written does not contain the case that failed
            solved%link = time_link%initiate
            solved%estimate = estimate_choice%fresh
         end if
         call dump_contact_case(this, problem, solved)
      else
         call status%only_check()
         code = library_code%success
         return
      end if
      code = code_of_contact(status)
      if (code /= library_code%success) then
         call report_error(this, status%reason, code)
      else if (problem%has_result) then
         code = border_elements(problem%result%division)
      end if
   end subroutine finish_contact

   !> Write the line that opens a case
   subroutine write_case_line(log, problem)
      type(log_type), intent(inout) :: log
      type(library_problem), intent(in) :: problem
      character(len=80) :: line

      if (problem%spec%output_level < 1) return
      write(line, "(A, I6, A, I3, A, I3)") " Case", problem%cases, " for contact problem", problem%icp, &
         & " on result element", problem%ire
      call log%line("")
      call log%line(trim(line))
   end subroutine write_case_line

   !> Refuse combinations that cannot be solved, naming them
   subroutine check_settings(digits, spec, error)
      type(case_digits), intent(in) :: digits
      type(case_spec), intent(in) :: spec
      type(error_type), allocatable, intent(out) :: error
      type(problem_list) :: problems
      type(control_words) :: words
      type(file_reader) :: nowhere

      call problems%start("")
      words%digits = digits
      call check_case(words, nowhere, spec, .false., potential_contact(), spec, problems)
      call refuse_unbuilt_digits(words, 3, spec, problems)
      call problems%first_failure(error)
   end subroutine check_settings

   !> Check that kept influence coefficients (C = 0) are for elements of the same size, and for at least as many of them
   subroutine check_coefficients(is_kept, spec, kept, error)
      !> Are the coefficients kept?
      logical, intent(in) :: is_kept
      type(case_spec), intent(in) :: spec
      !> Grid of the coefficients
      type(potential_contact), intent(inout) :: kept
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: text

      if (is_kept .and. kept%mx > 0) then
         call describe_coefficients(frame_of(spec%grid), kept, text)
         if (allocated(text)) call fatal_error(error, text // " (C = 0)")
      else
         kept = frame_of(spec%grid)
      end if
   end subroutine check_coefficients

   !> Does the grid of a refused case continue that of the previous case?
   pure logical function continues(problem)
      type(library_problem), intent(in) :: problem
      real(wp) :: box(4)
      integer :: lost

      continues = .true.
      if (.not. problem%has_result) return
      if (problem%spec%link == time_link%initiate .and. problem%spec%estimate == estimate_choice%fresh) return
      associate (new => problem%session%problem%grid, old => problem%result%grid)
         if (.not. problem%session%problem%has_geometry) return
         continues = new%continues(old)
         if (.not. continues) return
         call elements_left_out(problem%result%division, old, new, lost, box)
         continues = lost == 0
      end associate
   end function continues

   !> Store the result as starting point, as callers of the published interface expect
   subroutine keep_solution(problem)
      type(library_problem), intent(inout) :: problem

      associate (result => problem%result, kinematics => problem%stored%kinematics, &
         & acting => problem%stored%acting)
         ! prescribed values are kept, even if they were not reached
         if (problem%spec%normal == normal_control%force) then
            kinematics%pen = result%pen
         else
            kinematics%fn = result%fn
         end if
         acting%chi = result%chi
         acting%dq = result%dq
         acting%veloc = result%veloc
         if (problem%spec%motion == motion%none) return
         if (problem%spec%force < force_control%fx_and_ceta) kinematics%fx = result%fx_rel
         if (problem%spec%force < force_control%fx_and_fy) kinematics%fy = result%fy_rel
         kinematics%cksi = result%cksi
         kinematics%ceta = result%ceta
      end associate
   end subroutine keep_solution

   !> Print the results, and write the file with all elements
   subroutine write_results(this, problem, spec, log)
      type(entry_type), intent(in) :: this
      type(library_problem), intent(in) :: problem
      !> The case
      type(case_spec), intent(in) :: spec
      type(log_type), intent(inout) :: log
      type(error_type), allocatable :: error
      character(len=40) :: name
      character(len=:), allocatable :: path

      !$omp critical (contact_printing)
      call write_case(log, spec, problem%result)
      !$omp end critical (contact_printing)
      if (spec%mat_file < 1) return
      write(name, '("caddon_re", I3.3, "_cp", I1, ".", I0.4, ".mat")') problem%ire, problem%icp, problem%cases
      call find_result_file(trim(name), path)
      call write_mat_file(path, spec, problem%result, problem%result%status, error, place_of(problem))
      if (allocated(error)) call report_error(this, full_text(error))
   end subroutine write_results

   !> Metadata of the case, as given by the caller
   pure function place_of(problem) result(place)
      type(library_problem), intent(in) :: problem
      type(mat_place) :: place

      associate (metadata => problem%metadata)
         place%rail(1:2) = [metadata%time, metadata%s_wheel]
         place%reference(1:2) = [metadata%x_rail, metadata%y_rail]
         place%reference(5:6) = [metadata%x_wheel, metadata%y_wheel]
      end associate
   end function place_of
end module contact_capi_calculate3
