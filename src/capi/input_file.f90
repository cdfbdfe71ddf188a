!> Entry that reads the settings of wheel and rail from an input file
module contact_capi_input_file
   use, intrinsic :: iso_c_binding, only : c_char, c_int
   use contact_base_choices, only : motion
   use contact_base_error, only : error_type, fatal_error, full_text
   use contact_capi_arguments, only : integer_of, path_of, set_argument
   use contact_capi_files, only : find_working_folder
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : report_error, log_message
   use contact_capi_problem, only : kind_of_motion, library_problem
   use contact_capi_profiles, only : read_given_profile
   use contact_capi_registry, only : enter, leave, scope
   use contact_cases_given, only : all_given
   use contact_cases_spec, only : case_spec
   use contact_control_digits, only : case_digits, digit_value, put_digit
   use contact_control_library_codes, only : input_type, library_code
   use contact_input_experiment_file, only : experiment_reader, input_case, is_readable_format
   use contact_input_problems, only : problem_list
   use contact_input_reader, only : read_case
   use contact_profile_request, only : profile_side
   use contact_text_lexer, only : input_lexer, input_value
   use contact_text_words, only : integer_text, replaced
   use contact_wheelrail_spec, only : profile_spec
   implicit none (type, external)
   private

   public :: cntc_readinpfile

   !> Digits that a file of Simpack does not change; differences in the first ones are reported
   character(len=2), parameter :: kept_digits(*) = [character(len=2) :: "P", "N", "F", "H", "S", "C1", "I"]
   integer, parameter :: n_reported = 5

contains

   !> Read the first case of a file, or a file of the Simpack user routine
   subroutine cntc_readinpfile(ire, inp_type, c_fname, len_fname, ierror) bind(c, name="inside_cntc_readinpfile")
      integer(c_int), intent(in), optional :: ire, inp_type, len_fname
      character(kind=c_char), intent(in), optional :: c_fname(*)
      integer(c_int), intent(inout), optional :: ierror
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(error_type), allocatable :: error
      character(len=:), allocatable :: file, folder
      integer :: code

      this = entry_type("cntc_readInpFile", integer_of(ire))
      call enter(this, scope%wheel_rail, problem, code)
      if (associated(problem)) then
         file = trim(path_of(c_fname, len_fname))
         if (len(file) == 0) then
            call fatal_error(error, "the name of the input file is missing")
         else
            call find_working_folder(folder)
            if (file(:1) /= "/") file = folder // file
            select case (integer_of(inp_type))
            case (input_type%module_1)
               call read_first_case(this, file, problem, error)
            case (input_type%simpack)
               call read_simpack_file(this, file, problem, error)
            case default
               call fatal_error(error, "unknown kind of input files " // integer_text(integer_of(inp_type)) // &
                  & "; accepted: 1988, 1990")
            end select
         end if
         if (allocated(error)) then
            code = library_code%input_file
            call report_error(this, full_text(error), code)
         end if
         call leave(problem)
      end if
      call set_argument(code, ierror)
   end subroutine cntc_readinpfile

   !> Read the first case of a file of module 1
   subroutine read_first_case(this, file, problem, error)
      type(entry_type), intent(in) :: this
      character(len=*), intent(in) :: file
      type(library_problem), intent(inout) :: problem
      type(error_type), allocatable, intent(out) :: error
      type(experiment_reader) :: reader
      type(input_case) :: first

      call reader%open_file(file, error)
      if (.not. allocated(error)) call reader%next_case(first, error)
      if (allocated(error)) return
      if (first%module_number /= 1) then
         call fatal_error(error, "the file must start with a case of module 1, wheel and rail", file=file)
         return
      end if
      call first%problems%first_failure(error)
      if (allocated(error)) return
      call adopt(this, file, first%digits, first%spec, problem)
   end subroutine read_first_case

   !> Read a file of the Simpack user routine: some digits keep their values, regardless of the file
   subroutine read_simpack_file(this, file, problem, error)
      type(entry_type), intent(in) :: this
      character(len=*), intent(in) :: file
      type(library_problem), intent(inout) :: problem
      type(error_type), allocatable, intent(out) :: error
      type(case_spec) :: spec, previous
      type(problem_list) :: problems
      type(case_digits) :: found
      character(len=:), allocatable :: name
      integer :: k, digit

      if (is_readable_format(file)) then
         call fatal_error(error, "a file of the Simpack user routine cannot be in the readable format; .inp files can", file=file)
         return
      end if
      previous = problem%spec
      previous%wheel_rail%wheelset = problem%stored%wheelset
      ! first for the digits, so that the checks find no change from the previous case, then for the values
      call read_simpack_case(file, previous, spec, found, problems, error)
      if (allocated(error)) return
      previous%wheel_rail%left = spec%wheel_rail%left
      previous%wheel_rail%roller = spec%wheel_rail%roller
      previous%normal = spec%normal
      ! what the file keeps are settings of the caller
      previous%given = all_given(spec%motion)
      call read_simpack_case(file, previous, spec, found, problems, error)
      if (.not. allocated(error)) call problems%first_failure(error)
      if (allocated(error)) return
      if (all(found%z /= [0, 3]) .or. all(found%e /= [0, 3])) then
         call fatal_error(error, "the digits Z and E must be 0 or 3, they are " // integer_text(found%z) // " and " // &
            & integer_text(found%e), file=file)
         return
      end if
      do k = 1, size(kept_digits)
         name = trim(kept_digits(k))
         digit = digit_value(problem%digits, name)
         if (digit_value(found, name) /= digit .and. k <= n_reported) call report_error(this, "the digit " // name // " = " // &
            & integer_text(digit_value(found, name)) // " of the file is not used, it stays " // integer_text(digit), &
            & library_code%success)
         call put_digit(found, name, digit)
      end do
      call adopt(this, file, found, spec, problem)
   end subroutine read_simpack_file

   !> Read module number and case
   subroutine read_simpack_case(file, previous, spec, digits, problems, error)
      character(len=*), intent(in) :: file
      type(case_spec), intent(in) :: previous
      type(case_spec), intent(out) :: spec
      type(case_digits), intent(out) :: digits
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_lexer) :: lexer
      type(input_value) :: v(1)
      integer :: first_line

      call lexer%open_file(file, error)
      if (.not. allocated(error)) call lexer%read_group("i", "MODULE", v, error)
      if (allocated(error)) return
      if (v(1)%i /= 0 .and. v(1)%i /= 11) then
         call fatal_error(error, "MODULE = " // v(1)%word // " does not open a file of the Simpack user routine; 0 and 11 do", &
            & file=file, line=v(1)%line, column=v(1)%column)
         return
      end if
      call read_case(lexer, 1, previous, .true., 1, spec, problems, error, first_line=first_line, digits=digits)
   end subroutine read_simpack_case

   !> Make the case the input of the next calculation, and read its profiles
   subroutine adopt(this, file, digits, spec, problem)
      type(entry_type), intent(in) :: this
      character(len=*), intent(in) :: file
      !> Digits of the case
      type(case_digits), intent(in) :: digits
      type(case_spec), intent(in) :: spec
      type(library_problem), intent(inout) :: problem
      type(profile_spec) :: rail, wheel

      rail = problem%spec%wheel_rail%rail_profile
      wheel = problem%spec%wheel_rail%wheel_profile
      problem%digits = digits
      problem%spec = spec
      problem%stored%wheelset = spec%wheel_rail%wheelset
      if (digits%e > 0) then
         problem%given%values = kind_of_motion(for_shift=spec%motion == motion%shift, is_new=.false.)
         problem%given%flexible = problem%given%values
         problem%given%for_roller = spec%wheel_rail%roller
      end if
      if (digits%z > 0) problem%given%rail = kind_of_motion(for_shift=spec%motion == motion%shift, is_new=.false.)
      ! a complete case replaces settings that were refused
      if (allocated(problem%refused)) deallocate(problem%refused)
      ! subsurface stresses are calculated by a separate routine
      problem%digits%s = 0
      associate (pair => problem%spec%wheel_rail)
         if (digits%z == 3) then
            call place_beside(file, pair%rail_profile)
            call problem%wheel_rail%profiles%forget(profile_side%rail)
            call read_given_profile(this, problem%wheel_rail%profiles, pair%rail_profile, profile_side%rail, problem%rail)
         else
            pair%rail_profile = rail
         end if
         if (digits%e == 3 .or. digits%e == 5) then
            call place_beside(file, pair%wheel_profile)
            call problem%wheel_rail%profiles%forget(profile_side%wheel)
            call read_given_profile(this, problem%wheel_rail%profiles, pair%wheel_profile, profile_side%wheel, problem%wheel)
         else
            pair%wheel_profile = wheel
         end if
      end associate
      call log_message(2, this, "the settings are those of " // file)
   end subroutine adopt

   !> Make the name of a profile relative to the folder of the input file
   subroutine place_beside(file, profile)
      character(len=*), intent(in) :: file
      type(profile_spec), intent(inout) :: profile
      character(len=:), allocatable :: work
      integer :: first

      profile%name = replaced(profile%name, "\", "/")
      if (profile%name(:1) == "/") return
      ! the working folder is prepended by the session
      call find_working_folder(work)
      first = 1
      if (work(:min(1, len(work))) /= "/" .and. index(file, work) == 1) first = len(work) + 1
      profile%name = file(first:index(file, "/", back=.true.)) // profile%name
   end subroutine place_beside
end module contact_capi_input_file
