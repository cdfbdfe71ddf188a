!> Calculation for wheel and rail (module 1) of a caller, from settings to results and files
module contact_capi_calculate1
   use contact_base_case_status, only : case_status
   use contact_base_error, only : error_type, fatal_error, full_text
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_capi_files, only : find_result_file, find_working_folder
   use contact_capi_input_dump, only : dump_wheel_rail_case
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : report_error, log_message
   use contact_capi_problem, only : library_problem, max_patches
   use contact_cases_continuation, only : describe_search
   use contact_cases_wheel_rail_accuracy, only : solve_wheel_on_rail
   use contact_cases_spec, only : case_spec
   use contact_control_digits, only : case_digits, digit_names, digit_value, is_known
   use contact_control_library_codes, only : code_of_wheel_rail, library_code
   use contact_grid_potential_contact, only : potential_contact
   use contact_input_checks, only : check_case
   use contact_input_control, only : control_words, refuse_unbuilt_digits
   use contact_input_file_reader, only : file_reader
   use contact_input_problems, only : problem_list
   use contact_output_wheel_rail_files, only : has_files, write_wheel_rail_files
   use contact_output_report_wheel_rail, only : write_wheel_rail
   use contact_text_words, only : integer_text, real_text
   use contact_wheelrail_body_frames, only : frames_of
   implicit none (type, external)
   private

   public :: check_data, finish_wheel_rail, solve_wheel_rail

contains

   !> Solve a case whose data are complete, unless its settings are incompatible
   subroutine solve_wheel_rail(this, problem, digits, log, code, error)
      type(entry_type), intent(in) :: this
      type(library_problem), intent(inout) :: problem
      !> Effective digits
      type(case_digits), intent(in) :: digits
      type(log_type), intent(inout) :: log
      !> Member of library_code
      integer, intent(out) :: code
      type(error_type), allocatable, intent(out) :: error

      code = library_code%other
      ! the first coordinate is the position along the track; on rollers the position of the wheelset relative to the top of the
      ! roller
      associate (wheelset => problem%spec%wheel_rail%wheelset)
         if (problem%spec%wheel_rail%roller) then
            wheelset%x = wheelset%x + wheelset%s
            wheelset%s = 0.0_wp
         else
            wheelset%s = wheelset%s + wheelset%x
            wheelset%x = 0.0_wp
         end if
      end associate
      call write_case_line(log, problem)
      call check_settings(digits, problem%spec, problem%known_digits, error)
      if (allocated(error)) return
      call dump_wheel_rail_case(this, problem)
      call find_working_folder(problem%work_folder)
      ! calls are steps in time; programs that run input files treat each case as independent
      problem%wheel_rail%problem%in_loop = .true.
      call solve_wheel_on_rail(problem%wheel_rail, problem%spec, problem%work_folder, log, problem%wheel_rail_result, &
         & problem%solved, error)
   end subroutine solve_wheel_rail

   !> Store the result as starting point, print it, and write files
   !>
   !> A result without contact, or with more patches than can be addressed, is reported in the log only.
   subroutine finish_wheel_rail(this, problem, log, status, code)
      type(entry_type), intent(in) :: this
      type(library_problem), intent(inout) :: problem
      type(log_type), intent(inout) :: log
      type(case_status), intent(inout) :: status
      !> Member of library_code
      integer, intent(out) :: code

      code = library_code%success
      ! patches of a case that is only checked have no fields, and are not available
      problem%has_result = problem%spec%solve
      associate (result => problem%wheel_rail_result)
         if (problem%spec%solve) then
            problem%stored%wheelset%z = result%z_ws
            problem%stored%wheelset%vpitch = result%vpitch
            call keep_places(problem)
            status = result%status
            if (.not. status%is_solved()) then
               code = code_of_wheel_rail(status, size(result%patches))
               call report_error(this, status%reason, code)
            end if
            if (allocated(problem%solved)) then
               call write_results(this, problem, problem%solved, log)
            else
               call write_results(this, problem, problem%spec, log)
            end if
         else
            call status%only_check()
         end if
         if (size(result%patches) == 0) call log_message(1, this, "wheel and rail do not touch")
         if (size(result%patches) > max_patches) call log_message(0, this, "more than " // integer_text(max_patches) // &
            & " contact patches, the last ones are not available")
         if (.not. problem%has_result) result%patches = result%patches(:0)
      end associate
   end subroutine finish_wheel_rail

   !> Keep the places that follow from the position of the wheelset and from the profiles, which the next case may change
   subroutine keep_places(problem)
      type(library_problem), intent(inout) :: problem
      integer :: k

      associate (pair => problem%wheel_rail%problem, result => problem%wheel_rail_result, bodies => problem%bodies)
         bodies%frames = frames_of(pair%spec, result)
         do k = 1, min(max_patches, size(result%patches))
            bodies%along(:, k) = [pair%rail%s_at(result%patches(k)%y_rail), pair%wheel%s_at(result%patches(k)%y_wheel)]
         end do
      end associate
   end subroutine keep_places

   !> Check that profiles, friction and discretisation are available and compatible
   subroutine check_data(problem, code, error)
      type(library_problem), intent(in) :: problem
      !> Member of library_code for the missing data
      integer, intent(out) :: code
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: text

      code = library_code%profile
      if (problem%rail%detail /= 0) then
         call fatal_error(error, "the profile of the rail is missing or cannot be used")
      else if (problem%wheel%detail /= 0) then
         call fatal_error(error, "the profile of the wheel is missing or cannot be used")
      else if (allocated(problem%rail%surface) .and. problem%spec%wheel_rail%track%gaught > 0.0_wp) then
         call fatal_error(error, "a rail that varies along the track cannot be placed by its gauge point; its position must " // &
            & "be given, with a gauge height of 0 or less")
      else if (size(problem%spec%friction%sets) < 1) then
         code = library_code%friction
         call fatal_error(error, "there are no friction data")
      else if (problem%has_result) then
         code = library_code%discretisation
         ! a new sequence, P = 2, continues nothing; nor does a case after one without patches
         if (problem%digits%p == 2 .or. size(problem%wheel_rail_result%patches) == 0) return
         call describe_search(problem%motion(), problem%spec%wheel_rail%search, problem%wheel_rail%problem%spec%search, text)
         if (allocated(text)) call fatal_error(error, text)
      end if
   end subroutine check_data

   !> Write the line that opens a case
   subroutine write_case_line(log, problem)
      type(log_type), intent(inout) :: log
      type(library_problem), intent(in) :: problem
      character(len=:), allocatable :: line

      if (problem%spec%output_level < 1 .and. problem%spec%flow_level < 1) return
      line = " Case " // integer_text(problem%cases) // " for w/r contact on result element " // integer_text(problem%ire)
      associate (metadata => problem%metadata)
         if (metadata%run /= 0) then
            line = line // ", run " // integer_text(metadata%run) // ", axle " // integer_text(metadata%axle) // ", side " // &
               & integer_text(metadata%side)
         else if (abs(metadata%time) > 0.0_wp) then
            line = line // ", t= " // real_text(metadata%time)
         end if
      end associate
      call log%line("")
      call log%line(line)
   end subroutine write_case_line

   !> Refuse digits and combinations that cannot be solved, naming them
   subroutine check_settings(digits, spec, known, error)
      type(case_digits), intent(in) :: digits
      type(case_spec), intent(in) :: spec
      !> The last digits whose values are all known, as a list; unallocated before there are any
      integer, allocatable, intent(inout) :: known(:)
      type(error_type), allocatable, intent(out) :: error
      type(problem_list) :: problems
      type(control_words) :: words
      type(file_reader) :: nowhere
      character(len=len(digit_names)) :: name
      integer :: k, digit
      logical :: is_same

      is_same = allocated(known)
      if (is_same) is_same = all(known == transfer(digits, known))
      if (.not. is_same) then
         do k = 1, size(digit_names)
            name = digit_names(k)
            digit = digit_value(digits, name)
            if (.not. is_known(name, digit, 1)) then
               call fatal_error(error, trim(name) // " = " // integer_text(digit) // " is not a known digit of wheel-rail contact")
               return
            end if
         end do
         known = transfer(digits, [0])
      end if
      if (spec%wheel_rail%roller .and. .not. spec%wheel_rail%track%nomradr > 0.0_wp) then
         call fatal_error(error, "a wheel on a roller needs the nominal radius of the roller")
      else if (.not. (spec%wheel_rail%search%dx > 0.0_wp .and. spec%wheel_rail%search%ds > 0.0_wp)) then
         call fatal_error(error, "the sides of the elements must be positive")
      end if
      if (allocated(error)) return
      call problems%start("")
      words%digits = digits
      call refuse_unbuilt_digits(words, 1, spec, problems)
      call check_case(words, nowhere, spec, .false., potential_contact(), spec, problems)
      call problems%first_failure(error)
   end subroutine check_settings

   !> Print the results, and write the files with all elements
   subroutine write_results(this, problem, spec, log)
      type(entry_type), intent(in) :: this
      type(library_problem), intent(in) :: problem
      !> The case as solved
      type(case_spec), intent(in) :: spec
      type(log_type), intent(inout) :: log
      type(error_type), allocatable :: error
      character(len=:), allocatable :: path

      !$omp critical (contact_printing)
      call write_wheel_rail(log, spec, problem%wheel_rail_result)
      !$omp end critical (contact_printing)
      if (.not. has_files(spec)) return
      call find_result_file("caddon", path)
      call write_wheel_rail_files(path, problem%cases, problem%ire, spec, problem%wheel_rail_result, error, &
         & problem%metadata%time)
      if (allocated(error)) call report_error(this, full_text(error))
   end subroutine write_results
end module contact_capi_calculate1
