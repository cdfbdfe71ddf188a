!> Conversion of experiments between the two input formats
module contact_experiment_convert
   use contact_base_error, only : add_context, error_kind, error_type, fatal_error
   use contact_base_output_file, only : output_file, remove_file
   use contact_cases_spec, only : case_spec
   use contact_experiment_input_cases, only : next_valid_case
   use contact_experiment_place, only : choose_input, experiment_place, input_suffix, locate_experiment, readable_suffix
   use contact_input_experiment_file, only : experiment_reader, input_case
   use contact_output_finished_file, only : move_file, open_result
   use contact_output_input_case, only : write_input_case
   use contact_output_toml_case_writer, only : toml_experiment_writer
   use contact_output_unwritten, only : unwritten_setting, unwritten_settings
   use contact_text_buffer, only : text_buffer
   use contact_text_words, only : integer_text
   use contact_toml_document, only : toml_document
   use contact_toml_parser, only : parse_toml
   implicit none (type, external)
   private

   public :: convert_experiment

   character(len=*), parameter :: line_feed = achar(10)

contains

   !> Write an experiment in the other format: .toml for .inp, .inp for .toml
   !>
   !> The new file is written completely and can be read without errors, or it is not created.
   subroutine convert_experiment(experiment, output_folder, overwrite, messages, output, error)
      !> Name of the experiment, with or without suffix
      character(len=*), intent(in) :: experiment
      !> Folder of the new file, "" for that of the input
      character(len=*), intent(in) :: output_folder
      !> May an existing file be replaced?
      logical, intent(in) :: overwrite
      !> Messages about problems of the input, and about settings that the new file cannot express
      type(text_buffer), intent(inout) :: messages
      !> Name of the new file
      character(len=:), allocatable, intent(out) :: output
      type(error_type), allocatable, intent(out) :: error
      type(experiment_place) :: place
      character(len=:), allocatable :: temporary, suffix
      type(output_file), target :: file
      integer :: cases, checked
      logical :: has_both, is_there, is_whole, names_files, to_readable

      place = locate_experiment(experiment, output_folder)
      call choose_input(place, has_both)
      if (has_both) then
         call fatal_error(error, "there are " // place%name // input_suffix // " and " // place%name // readable_suffix // &
            & ": the suffix must say which one is to be converted", error_kind%file, place%folder // place%name)
         return
      end if
      to_readable = index(place%input, input_suffix, back=.true.) == len(place%input) - len(input_suffix) + 1
      suffix = input_suffix
      if (to_readable) suffix = readable_suffix
      output = place%results // suffix
      inquire(file=output, exist=is_there)
      if (is_there .and. .not. overwrite) then
         call fatal_error(error, "the file exists already; --force replaces it", error_kind%file, output)
         return
      end if
      temporary = place%results // ".converted" // suffix
      call open_result(file, temporary, output, error)
      if (allocated(error)) return
      if (to_readable) then
         call write_readable(place%input, file, messages, cases, names_files, error)
      else
         call write_established(place%input, file, messages, cases, names_files, error)
      end if
      call file%close_file(is_whole)
      if (.not. (is_whole .or. allocated(error))) call fatal_error(error, "the file is not complete; is the disk full?", &
         & error_kind%file, output)
      if (.not. allocated(error)) then
         call count_cases(temporary, checked, error)
         if (.not. allocated(error) .and. checked /= cases) call fatal_error(error, integer_text(cases) // &
            & " cases were converted, but " // integer_text(checked) // " are in the file; is the disk full?", error_kind%file, &
            & output)
      end if
      if (.not. allocated(error)) then
         if (move_file(temporary, output) /= 0) call fatal_error(error, "the file cannot be given its name", error_kind%file, &
            & output)
      end if
      if (allocated(error)) call remove_file(temporary)
      if (.not. allocated(error) .and. output_folder /= "" .and. names_files) call messages%add_line(" Files that " // output // &
         & " names are relative to its own folder: copy them there, profiles and tables of coefficients")
   end subroutine convert_experiment

   !> Does a case refer to a file relative to the folder of its input?
   pure logical function has_relative_file(spec)
      type(case_spec), intent(in) :: spec

      has_relative_file = is_relative(spec%material%cfname)
      if (.not. allocated(spec%wheel_rail)) return
      has_relative_file = has_relative_file .or. is_relative(spec%wheel_rail%rail_profile%name) &
         & .or. is_relative(spec%wheel_rail%wheel_profile%name)
   end function has_relative_file

   !> Is this a relative path?
   pure logical function is_relative(name)
      character(len=:), allocatable, intent(in) :: name

      is_relative = .false.
      if (.not. allocated(name)) return
      if (len_trim(name) == 0) return
      is_relative = scan(name(1:1), "/\") == 0 .and. index(name, ":") /= 2
   end function is_relative

   !> Convert all cases to the readable format
   subroutine write_readable(input, file, messages, cases, names_files, error)
      character(len=*), intent(in) :: input
      !> An open file
      type(output_file), intent(inout), target :: file
      !> As for convert_experiment
      type(text_buffer), intent(inout) :: messages
      !> Number of cases
      integer, intent(out) :: cases
      !> Does a case refer to a file relative to its folder?
      logical, intent(out) :: names_files
      type(error_type), allocatable, intent(out) :: error
      type(experiment_reader) :: reader
      type(toml_experiment_writer) :: writer
      type(toml_document) :: document
      type(input_case) :: this
      character(len=:), allocatable :: remarks, text
      integer :: first, last
      logical :: is_case

      names_files = .false.
      cases = 0
      call reader%open_file(input, error)
      do while (.not. allocated(error))
         last = reader%lexer%line
         call next_valid_case(reader, this, is_case, error, messages)
         if (.not. is_case) exit
         names_files = names_files .or. has_relative_file(this%spec)
         call find_remarks(reader, last + 1, this%first_line - 1, "%", "# ", remarks)
         cases = cases + 1
         call writer%add_case(this%module_number, this%reid, this%cpid, this%spec, remarks)
      end do
      if (allocated(error)) return
      if (cases == 0) then
         call fatal_error(error, "there is no case to convert", error_kind%input, input)
         return
      end if
      call writer%text%get(text)
      call parse_toml(text, input, document, error)
      if (allocated(error)) then
         call add_context(error, "in the readable format")
         return
      end if
      first = 1
      do while (first <= len(text))
         last = first + index(text(first:), line_feed) - 1
         call file%line(text(first:last - 1))
         first = last + 1
      end do
   end subroutine write_readable

   !> Convert all cases to the established format
   subroutine write_established(input, file, messages, cases, names_files, error)
      character(len=*), intent(in) :: input
      !> An open file
      type(output_file), intent(inout), target :: file
      !> As for convert_experiment
      type(text_buffer), intent(inout) :: messages
      !> Number of cases
      integer, intent(out) :: cases
      !> Does a case refer to a file relative to its folder?
      logical, intent(out) :: names_files
      type(error_type), allocatable, intent(out) :: error
      type(experiment_reader) :: reader
      type(input_case) :: this
      character(len=:), allocatable :: remarks
      type(unwritten_setting), allocatable :: lost(:)
      logical :: begins_module, is_case
      integer :: k

      names_files = .false.
      cases = 0
      begins_module = .true.
      call reader%open_file(input, error)
      do while (.not. allocated(error))
         call next_valid_case(reader, this, is_case, error, messages)
         if (.not. is_case) exit
         names_files = names_files .or. has_relative_file(this%spec)
         cases = cases + 1
         call find_remarks(reader, 1, this%first_line - 1, "#", "% ", remarks)
         if (len(remarks) > 0) call file%line(remarks(:len(remarks) - 1))
         if (begins_module) call write_module_line(file, this)
         begins_module = this%spec%ends_module
         call collect_unwritten(this%spec, lost)
         call write_input_case(file, this%spec)
      end do
      if (allocated(error)) return
      call file%line(" 0   % MODULE: end")
      if (.not. allocated(lost)) return
      do k = 1, size(lost)
         if (lost(k)%option /= "") then
            call messages%add_line(" In " // input // " " // trim(lost(k)%fact) // "; the new file needs " // trim(lost(k)%option))
         else if (lost(k)%fact /= "") then
            call messages%add_line(" In " // input // " " // trim(lost(k)%fact) // "; the new file cannot request this")
         end if
      end do
   end subroutine write_established

   !> Collect settings that the new file cannot express, of each kind the first one
   subroutine collect_unwritten(spec, lost)
      type(case_spec), intent(in) :: spec
      !> Those found so far; allocated here
      type(unwritten_setting), allocatable, intent(inout) :: lost(:)
      type(unwritten_setting), allocatable :: found(:)
      integer :: k

      found = unwritten_settings(spec)
      if (.not. allocated(lost)) lost = found
      do k = 1, size(lost)
         if (lost(k)%fact == "") lost(k) = found(k)
      end do
   end subroutine collect_unwritten

   !> Write the line MODULE {REID {CPID}}
   subroutine write_module_line(file, this)
      type(output_file), intent(inout) :: file
      type(input_case), intent(in) :: this

      if (this%reid == 0) then
         call file%line(" " // integer_text(this%module_number) // "   % MODULE")
      else
         call file%line(" " // integer_text(this%module_number) // " " // integer_text(this%reid) // " " // &
            & integer_text(this%cpid) // "   % MODULE, REID, CPID")
      end if
   end subroutine write_module_line

   !> Comments directly above a line, with the comment mark replaced
   subroutine find_remarks(reader, first, last, mark, new_mark, remarks)
      type(experiment_reader), intent(in) :: reader
      !> Range of lines; only the last contiguous comments are used
      integer, intent(in) :: first, last
      !> Comment mark in the input, and its replacement
      character(len=*), intent(in) :: mark, new_mark
      !> Lines with line ends
      character(len=:), allocatable, intent(out) :: remarks
      character(len=:), allocatable :: line
      integer :: k, letter

      remarks = ""
      do k = last, first, -1
         line = adjustl(reader%lexer%line_text(k))
         if (mark == "#" .and. index(line, mark) /= 1) exit
         if (index(line, mark) /= 1) cycle
         line = trim(adjustl(line(2:)))
         ! comments may contain any bytes, but the readable format must be UTF-8
         do letter = 1, len(line)
            if (mark == "%" .and. iachar(line(letter:letter)) > 126) line(letter:letter) = "?"
         end do
         remarks = trim(new_mark // line) // line_feed // remarks
      end do
   end subroutine find_remarks

   !> Number of cases in a file without errors
   subroutine count_cases(file, cases, error)
      character(len=*), intent(in) :: file
      integer, intent(out) :: cases
      type(error_type), allocatable, intent(out) :: error
      type(experiment_reader) :: reader
      type(input_case) :: this
      logical :: is_case

      cases = 0
      call reader%open_file(file, error)
      do while (.not. allocated(error))
         call next_valid_case(reader, this, is_case, error)
         if (.not. is_case) exit
         cases = cases + 1
      end do
      if (allocated(error)) call add_context(error, "in the file that was written, which is a program fault")
   end subroutine count_cases
end module contact_experiment_convert
