!> Command line: parsing of options and arguments, prompts for missing ones, and execution
module contact_cli_arguments
   use, intrinsic :: iso_fortran_env, only : error_unit, input_unit, output_unit
   use contact_base_choices, only : heat_source
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : long, wp
   use contact_base_limits, only : case_limits, fill_limits
   use contact_cli_command_line, only : get_word
   use contact_cli_commands, only : is_command, run_command
   use contact_cli_process, only : catch_signals, exit_status_of_signal, restore_signals, stop_by_signal
   use contact_cli_report, only : is_report, run_report
   use contact_cli_versions, only : contact_version, write_versions
   use contact_cli_accuracy_words, only : read_accuracy, read_permission
   use contact_experiment_progress, only : is_terminal
   use contact_experiment_run, only : as_input_says, run_experiment, run_settings
   use contact_text_words, only : replaced
   implicit none (type, external)
   private

   public :: run_command_line

   type :: mode_list
      !> Licence management; does nothing
      integer :: licence = 1
      !> Read, compute, write results
      integer :: compute = 2
      !> Read and check only
      integer :: check = 3
   end type mode_list
   !> Names of the modes
   type(mode_list), parameter :: mode = mode_list()

   !> Exit status codes
   integer, parameter :: success = 0, failure = 1, unconverged = 2
   !> Name of the experiment if the answer to the prompt is empty
   character(len=*), parameter :: default_experiment = "contact"
   !> Maximum length of an answer
   integer, parameter :: longest_answer = 4096
   !> Maximum number of threads
   integer, parameter :: max_threads = 4096
   character(len=*), parameter :: usage = "Usage: contact [options] [IMODE [EXPNAM]], see contact --help"

   !> Parsed command line
   type :: command
      !> Mode, 0: not given
      integer :: mode = 0
      !> Name of the experiment; unallocated: not given
      character(len=:), allocatable :: experiment
      !> Folder of the results; unallocated: not given
      character(len=:), allocatable :: output_folder
      !> Number of threads, 0: not given
      integer :: threads = 0
      !> Totals as JSON lines: "" to a file, "-" to the standard output; unallocated: none
      character(len=:), allocatable :: json
      !> Write the HDF5 file?
      logical :: hdf5 = .false.
      !> Write VTK files?
      logical :: vtk = .false.
      !> Member of heat_source, or as_input_says
      integer :: heat_source = as_input_says
      !> Order of the discretisation of rolling, or as_input_says
      integer :: order = as_input_says
      !> Requested bound of the relative error of the forces, 0: none
      real(wp) :: accuracy = 0.0_wp
      !> Allow simplified methods for it?
      logical :: allows_approximate = .false.
      !> Contact angles as in the established program?
      logical :: angle_below_axle = .true.
      !> Run the classical solvers selected by cases?
      logical :: classical = .false.
      !> Estimate the errors of the totals?
      logical :: errors = .false.
      !> Limits of a case, and restriction of the run to its folder
      type(case_limits) :: limits
      !> Limits of the run: time [s], and total size of its files [bytes]
      real(wp) :: run_seconds = huge(1.0_wp)
      integer(long) :: output_bytes = huge(1_long)
      !> Exit with status 2 if a case does not converge?
      logical :: strict = .false.
      !> Resume a run that ended before all cases were finished?
      logical :: resume = .false.
      logical :: quiet = .false., help = .false., version = .false.
   end type command

contains

   !> Execute the command line; returns the exit status
   integer function run_command_line() result(status)
      type(command) :: requested
      type(error_type), allocatable :: error

      status = success
      if (is_report()) then
         status = run_report()
         return
      end if
      if (is_command()) then
         status = run_command()
         return
      end if
      call read_arguments(requested, error)
      if (.not. allocated(error)) then
         if (requested%help) then
            call write_help()
            return
         else if (requested%version) then
            call write_versions(output_unit)
            return
         end if
         if (requested%mode == 0) call prompt_mode(requested, error)
      end if
      if (.not. allocated(error)) then
         if (requested%mode == mode%licence) then
            write(output_unit, "(A)") "CONTACT is open source: no licence is needed, and mode 1 has nothing to do."
            return
         end if
         if (requested%resume .and. requested%mode == mode%check) then
            call fatal_error(error, "--resume continues a computation, mode 2; a check, mode 3, has nothing to continue")
         else if (.not. allocated(requested%experiment)) then
            call prompt_experiment(requested, error)
         end if
      end if
      if (allocated(error)) then
         flush(output_unit)
         write(error_unit, "(A)") "contact: " // error%message, usage
         status = failure
         return
      end if
      call run(requested, status)
   end function run_command_line

   !> Run the experiment; errors have been written on return
   subroutine run(requested, status)
      type(command), intent(inout) :: requested
      !> Exit status
      integer, intent(out) :: status
      type(run_settings) :: settings
      type(error_type), allocatable :: error
      logical :: interrupted

      settings%experiment = requested%experiment
      if (allocated(requested%output_folder)) settings%output_folder = requested%output_folder
      settings%version = contact_version
      settings%check_only = requested%mode == mode%check
      settings%threads = requested%threads
      settings%strict = requested%strict
      settings%resume = requested%resume
      settings%limits = requested%limits
      if (requested%limits%confined) call fill_limits(settings%limits, requested%run_seconds, requested%output_bytes)
      settings%run_deadline%seconds = requested%run_seconds
      settings%output_bytes = requested%output_bytes
      settings%stop_requested => stop_by_signal
      settings%exports%hdf5 = requested%hdf5
      settings%exports%vtk = requested%vtk
      settings%heat_source = requested%heat_source
      settings%order = requested%order
      settings%accuracy = requested%accuracy
      settings%allows_approximate = requested%allows_approximate
      settings%angle_below_axle = requested%angle_below_axle
      settings%classical = requested%classical
      settings%errors = requested%errors
      if (allocated(requested%json)) settings%exports%json = requested%json
      if (.not. requested%quiet) then
         settings%screen = output_unit
         settings%progress = is_terminal()
      end if
      settings%complaints = error_unit
      call catch_signals()
      call run_experiment(settings, error, interrupted)
      call restore_signals()
      status = success
      if (.not. allocated(error)) return
      status = merge(unconverged, failure, error%kind == error_kind%not_converged)
      if (interrupted) status = exit_status_of_signal()
   end subroutine run

   !> Separate the words of the command line into options and positional arguments
   subroutine read_arguments(requested, error)
      type(command), intent(out) :: requested
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: word
      integer :: k, position
      logical :: options

      options = .true.
      position = 0
      k = 0
      do while (k < command_argument_count())
         k = k + 1
         call get_word(k, word)
         if (options .and. word == "--") then
            options = .false.
         else if (options .and. index(word, "-") == 1) then
            call read_option(requested, word, k, error)
         else
            position = position + 1
            if (position == 1) then
               call read_mode(requested, word, error)
            else if (position == 2 .and. len_trim(word) > 0) then
               requested%experiment = word
            end if
         end if
         if (allocated(error)) return
      end do
   end subroutine read_arguments

   !> Parse an option, and its value if it has one
   !>
   !> Long because each option is a case of a single select statement.
   subroutine read_option(requested, word, k, error)
      type(command), intent(inout) :: requested
      !> Option; a value may follow after an equals sign
      character(len=*), intent(in) :: word
      !> Index of the word; on return that of the last one used
      integer, intent(inout) :: k
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: name, value
      integer :: equals

      equals = index(word, "=")
      name = word
      if (equals > 0) name = word(:equals - 1)
      select case (name)
      case ("--help", "-h")
         requested%help = .true.
      case ("--version")
         requested%version = .true.
      case ("--quiet")
         requested%quiet = .true.
      case ("--output-dir")
         call read_value("the name of a folder")
         if (.not. allocated(error)) requested%output_folder = value
         return
      case ("--threads")
         call read_value("a number of threads")
         if (allocated(error)) return
         requested%threads = to_number(value)
         if (requested%threads < 1 .or. requested%threads > max_threads) call fatal_error(error, &
            & "the number of threads, '" // value // "', is not an integer from 1 to 4096")
         return
      case ("--heat")
         call read_value("the name of a way to compute temperatures: established or moving-source")
         if (allocated(error)) return
         select case (value)
         case ("established")
            requested%heat_source = heat_source%established
         case ("moving-source")
            requested%heat_source = heat_source%moving
         case default
            call fatal_error(error, 'unknown heat model "' // value // &
               & '"; accepted: established, moving-source')
         end select
         return
      case ("--order")
         call read_value("the order of the discretisation of rolling: 1 or 2")
         if (allocated(error)) return
         requested%order = to_number(value)
         if (all(requested%order /= [1, 2])) call fatal_error(error, 'unknown order of the discretisation "' // value // &
            & '"; accepted: 1, 2')
         return
      case ("--accuracy")
         call read_value("the largest relative error of the forces, 1e-6 to 0.1")
         if (allocated(error)) return
         call read_accuracy(value, requested%accuracy, error)
         return
      case ("--allow")
         call read_value("what may replace the full theory: approximate")
         if (allocated(error)) return
         call read_permission(value, requested%allows_approximate, error)
         return
      case ("--contact-angle")
         call read_value("where contact angles are taken: established or contact")
         if (allocated(error)) return
         requested%angle_below_axle = value == "established"
         if (value /= "contact" .and. value /= "established") call fatal_error(error, 'unknown contact angle "' // value // &
            & '"; accepted: established, contact')
         return
      case ("--classical")
         requested%classical = .true.
      case ("--confine")
         requested%limits%confined = .true.
      case ("--limit-time", "--limit-memory", "--limit-elements", "--limit-run-time", "--limit-output")
         call read_limit()
         return
      case ("--errors")
         requested%errors = .true.
      case ("--strict")
         requested%strict = .true.
      case ("--resume")
         requested%resume = .true.
      case ("--hdf5")
         requested%hdf5 = .true.
      case ("--vtk")
         requested%vtk = .true.
      case ("--json")
         requested%json = ""
         if (equals == 0) return
         requested%json = word(equals + 1:)
         if (requested%json /= "-") call fatal_error(error, "the option --json writes EXPNAM.jsonl, or with --json=- to the " &
            & // "standard output; it takes no other value")
         requested%quiet = .true.
         return
      case default
         call fatal_error(error, "there is no option '" // name // &
            & "'; the options are --help, --version, --output-dir DIR, --threads N, --heat NAME, --order N, --accuracy TOL, " // &
            & "--allow approximate, --errors, --hdf5, --json, --vtk, --confine, --limit-time S, --limit-run-time S, " // &
            & "--limit-memory MB, --limit-elements N, --limit-output MB, --resume, --strict and --quiet")
         return
      end select
      if (equals > 0) call fatal_error(error, "the option " // name // " takes no value")

   contains

      !> Parse the value of a limit, a positive number
      subroutine read_limit()
         real(wp) :: number

         call read_value("a positive number")
         if (allocated(error)) return
         number = to_real(value)
         if (.not. (number > 0.0_wp .and. number < 1.0e12_wp)) then
            call fatal_error(error, "the value of " // name // ", '" // value // "', is not a positive number below 1e12")
            return
         end if
         select case (name)
         case ("--limit-time")
            requested%limits%deadline%seconds = number
         case ("--limit-memory")
            requested%limits%bytes = int(1.0e6_wp*number, long)
         case ("--limit-run-time")
            requested%run_seconds = number
         case ("--limit-output")
            requested%output_bytes = int(1.0e6_wp*number, long)
         case default
            requested%limits%elements = int(number, long)
         end select
      end subroutine read_limit

      !> Get the value of the option: after the equals sign, or the next word
      subroutine read_value(what)
         character(len=*), intent(in) :: what

         value = ""
         if (equals > 0) then
            value = word(equals + 1:)
         else if (k < command_argument_count()) then
            k = k + 1
            call get_word(k, value)
         end if
         if (len_trim(value) == 0) call fatal_error(error, "the option " // name // " needs " // what)
      end subroutine read_value
   end subroutine read_option

   !> Parse the mode from the first positional argument
   subroutine read_mode(requested, word, error)
      type(command), intent(inout) :: requested
      character(len=*), intent(in) :: word
      type(error_type), allocatable, intent(out) :: error

      requested%mode = to_number(word)
      if (is_mode(requested%mode)) return
      call fatal_error(error, "the first argument, '" // word // "', is not a mode; the modes are 1, 2 and 3, and there are " // &
         & "the commands convert, explain, report, study and table")
   end subroutine read_mode

   !> Does this mode exist?
   pure logical function is_mode(number)
      integer, intent(in) :: number
      is_mode = number == mode%licence .or. number == mode%compute .or. number == mode%check
   end function is_mode

   !> List the modes and prompt until one is chosen
   subroutine prompt_mode(requested, error)
      type(command), intent(inout) :: requested
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: answer

      write(output_unit, "(A)") "What shall be done?", &
         & "  1  licence management (not needed)", &
         & "  2  read EXPNAM.inp, compute, write the results", &
         & "  3  read and check EXPNAM.inp"
      do
         call prompt("Mode (1, 2 or 3): ", answer, error)
         if (allocated(error)) return
         requested%mode = to_number(answer)
         if (is_mode(requested%mode)) return
      end do
   end subroutine prompt_mode

   !> Prompt for the name of the experiment
   subroutine prompt_experiment(requested, error)
      type(command), intent(inout) :: requested
      type(error_type), allocatable, intent(out) :: error

      call prompt("Name of the experiment (empty for '" // default_experiment // "'): ", requested%experiment, error)
      if (allocated(error)) return
      if (len_trim(requested%experiment) == 0) requested%experiment = default_experiment
   end subroutine prompt_experiment

   !> Prompt for an answer; the end of the input is an error
   subroutine prompt(question, answer, error)
      character(len=*), intent(in) :: question
      character(len=:), allocatable, intent(out) :: answer
      type(error_type), allocatable, intent(out) :: error
      character(len=longest_answer) :: line
      integer :: status

      write(output_unit, "(A)", advance="no") question
      flush(output_unit)
      read(input_unit, "(A)", iostat=status) line
      if (status == 0) then
         ! files from other systems have a carriage return at the end of a line
         answer = trim(adjustl(replaced(line, achar(13), " ")))
      else
         answer = ""
         write(output_unit, "(A)") ""
         call fatal_error(error, "the input ended where an answer was expected")
      end if
   end subroutine prompt

   !> An unsigned integer, -1 if the word is not one
   pure integer function to_number(word) result(number)
      character(len=*), intent(in) :: word
      integer :: status

      number = -1
      if (len_trim(word) == 0 .or. verify(trim(word), "0123456789") /= 0) return
      read(word, *, iostat=status) number
      if (status /= 0) number = -1
   end function to_number

   !> A number, -1 if the word is not one
   real(wp) function to_real(word) result(number)
      character(len=*), intent(in) :: word
      integer :: status

      number = -1.0_wp
      if (verify(word, "0123456789.eE+-") /= 0) return
      read(word, *, iostat=status) number
      if (status /= 0) number = -1.0_wp
   end function to_real

   !> Write the text of --help
   subroutine write_help()
      write(output_unit, "(A)") &
         & "Usage: contact [options] [IMODE [EXPNAM]]", &
         & "       contact convert [--force] [--output-dir DIR] EXPNAM.inp | EXPNAM.toml", &
         & "       contact explain EXPNAM", &
         & "       contact report EXPNAM | --serve [FOLDER]", &
         & "       contact study STUDY.toml [--explain] [--workers N] [--scheduler ADDRESS]", &
         & "       contact table FILE [--tolerance E] [--ratio LOW HIGH] [--about]", &
         & "", &
         & "Rolling and sliding contact with friction.", &
         & "", &
         & "IMODE   1  licence management (none is needed)", &
         & "        2  read EXPNAM.inp, compute, write EXPNAM.out and other results", &
         & "        3  read and check EXPNAM.inp, compute nothing", &
         & "EXPNAM  name of the experiment, with a folder if necessary, with or without .inp or .toml; without, .inp is read", &
         & "        if it exists, and .toml, the readable format, otherwise", &
         & "Missing arguments are prompted for.", &
         & "convert writes an experiment in the other format; explain describes its cases in words", &
         & "report  makes one HTML page of the results of --hdf5, or serves a folder to a browser on this machine", &
         & "study   computes many cases from one description, on this machine or many; contact study --help", &
         & "table   makes a table of creep forces, for look-ups of less than a microsecond; contact table --help", &
         & "", &
         & "Options", &
         & "  --output-dir DIR  write the results to this folder instead of that of the input", &
         & "  --threads N       number of threads; default is OMP_NUM_THREADS or all processors", &
         & "  --heat NAME       surface temperatures: established, as the established program (default for .inp), or", &
         & "                    moving-source, without counting the heat of an element twice at its centre", &
         & "  --order N         discretisation of rolling: 1, the established one, or 2, with errors proportional to the", &
         & "                    square of the element size; default is 1 for .inp, and that of each case for .toml", &
         & "  --accuracy TOL    choose grid, order and EPS of each case so that the estimated error of the forces, relative to", &
         & "                    the friction bound or to FN, is at most TOL, 1e-6 to 0.1", &
         & "  --allow approximate  allow simplified methods for that, if their error is known and below TOL", &
         & "  --contact-angle NAME  on rails that vary along the track: established, of the section below the axle", &
         & "                    (default), or contact, of wheel and rail where they touch", &
         & "  --classical       use the solvers that G names; without it, the faster default solver is used", &
         & "  --errors          estimate the errors of all totals, from a coarser level of the same contact", &
         & "  --hdf5            write inputs, totals and fields of all cases to EXPNAM.h5", &
         & "  --json            write the totals of every case as JSON lines to EXPNAM.jsonl; --json=- writes", &
         & "                    them to the standard output, and nothing else", &
         & "  --vtk             write contact surfaces and subsurface blocks as VTK files, listed in EXPNAM.pvd", &
         & "  --limit-time S    abandon a case after S seconds, and continue with the next", &
         & "  --limit-memory MB, --limit-elements N  refuse cases that need more memory or elements", &
         & "  --resume          continue a run that was interrupted, or that ended at an error of the input, corrected since", &
         & "  --limit-run-time S, --limit-output MB  end the run after this time, or when its files are larger", &
         & "  --confine         for untrusted input: read and write ordinary files below the folder of the", &
         & "                    experiment only, with limits of 600 s and 3600 s, 4000 MB, 1000000 elements,", &
         & "                    1000 MB of output unless others are given", &
         & "  --strict          exit with status 2 if a case did not converge", &
         & "  --quiet           write nothing but errors to the screen", &
         & "  --help            this text", &
         & "  --version         versions of program, compiler and libraries", &
         & "", &
         & "The exit status is 0 on success, 1 after any error, with --strict 2 if a case did not converge,", &
         & "and 128 + n when signal n ended the run after the current case."
   end subroutine write_help
end module contact_cli_arguments
