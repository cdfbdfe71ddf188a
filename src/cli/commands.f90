!> Commands contact convert and contact explain
module contact_cli_commands
   use, intrinsic :: iso_fortran_env, only : error_unit, output_unit
   use contact_base_error, only : error_type, fatal_error, full_text
   use contact_base_kinds, only : wp
   use contact_cli_accuracy_words, only : read_accuracy, read_permission
   use contact_cli_command_line, only : get_word
   use contact_experiment_convert, only : convert_experiment
   use contact_experiment_explain, only : explain_experiment
   use contact_text_buffer, only : text_buffer
   implicit none (type, external)
   private

   public :: is_command, run_command

   character(len=*), parameter :: usage = "Usage: contact convert [--force] [--output-dir DIR] [--quiet] EXPNAM.inp|EXPNAM.toml, &
      &contact explain [--accuracy TOL] [--allow approximate] EXPNAM"

contains

   !> Is the first word of the command line "convert" or "explain"?
   logical function is_command()
      character(len=8) :: word

      word = ""
      if (command_argument_count() > 0) call get_command_argument(1, word)
      is_command = word == "convert" .or. word == "explain"
   end function is_command

   !> Execute the command line; returns the exit status
   integer function run_command() result(status)
      type(error_type), allocatable :: error
      type(text_buffer) :: messages
      character(len=:), allocatable :: word, command, experiment, folder, output, value
      integer :: k
      real(wp) :: accuracy
      logical :: force, quiet, allows_approximate

      call get_word(1, command)
      accuracy = 0.0_wp
      allows_approximate = .false.
      force = .false.
      quiet = .false.
      folder = ""
      k = 1
      do while (k < command_argument_count() .and. .not. allocated(error))
         k = k + 1
         call get_word(k, word)
         if (word == "--help" .or. word == "-h") then
            write(output_unit, "(A)") usage
            status = 0
            return
         else if (word == "--force" .and. command == "convert") then
            force = .true.
         else if (word == "--quiet" .and. command == "convert") then
            quiet = .true.
         else if (word == "--output-dir" .and. command == "convert" .and. k < command_argument_count()) then
            k = k + 1
            call get_word(k, folder)
         else if (command == "explain" .and. is_option(word, "--accuracy", k)) then
            call read_option_value(word, k, value)
            call read_accuracy(value, accuracy, error)
         else if (command == "explain" .and. is_option(word, "--allow", k)) then
            call read_option_value(word, k, value)
            call read_permission(value, allows_approximate, error)
         else if (index(word, "-") == 1 .and. word /= "--") then
            call fatal_error(error, "contact " // command // " has no option '" // word // "', or it lacks its value")
         else if (allocated(experiment)) then
            call fatal_error(error, "one experiment at a time; '" // experiment // "' and '" // word // "' are two")
         else if (word /= "--") then
            experiment = word
         end if
      end do
      if (.not. allocated(error) .and. .not. allocated(experiment)) call fatal_error(error, &
         & "the name of the experiment is missing")
      status = 1
      if (allocated(error)) then
         write(error_unit, "(A)") "contact: " // error%message, usage
         return
      end if
      if (command == "explain") then
         call explain_experiment(experiment, messages, error, accuracy, allows_approximate)
         call write_lines(output_unit, messages)
      else
         call convert_experiment(experiment, folder, force, messages, output, error)
         call write_lines(error_unit, messages)
         if (.not. allocated(error) .and. .not. quiet) write(output_unit, "(A)") " " // output // " is written"
      end if
      if (allocated(error)) then
         flush(output_unit)
         write(error_unit, "(A)") " Input: ERROR. " // full_text(error)
      else
         status = 0
      end if
   end function run_command

   !> Is a word a given option, with its value after "=" or in the next word?
   pure logical function is_option(word, option, k)
      character(len=*), intent(in) :: word, option
      !> Index of the word
      integer, intent(in) :: k

      is_option = index(word, option // "=") == 1 .or. (word == option .and. k < command_argument_count())
   end function is_option

   !> Get the value of an option
   subroutine read_option_value(word, k, value)
      character(len=*), intent(in) :: word
      !> Index of the word; on return that of its value
      integer, intent(inout) :: k
      character(len=:), allocatable, intent(inout) :: value
      integer :: equals

      equals = index(word, "=")
      value = word(equals + 1:)
      if (equals > 0) return
      k = k + 1
      call get_word(k, value)
   end subroutine read_option_value

   !> Write the lines of a text
   subroutine write_lines(unit, messages)
      integer, intent(in) :: unit
      type(text_buffer), intent(in) :: messages
      character(len=:), allocatable :: text

      call messages%get(text)
      if (len(text) > 0) write(unit, "(A)") text(:len(text) - 1)
   end subroutine write_lines
end module contact_cli_commands
