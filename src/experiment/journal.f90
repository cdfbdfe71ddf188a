!> Journal of a run: a file in the folder of the results that records its progress, for `--resume`
!>
!> EXPNAM.unfinished exists during a run, and remains if the run ends before all cases are finished. Its first line contains the
!> settings. Each further line is a checkpoint at which all files contain all cases so far: the positions of their ends, the
!> counts, hashes of the input read, and a letter for each case since the previous line. Each line ends with its hash, so that
!> an incomplete or damaged line is detected. A failed write is not a failure of the run: the journal just ends earlier.
module contact_experiment_journal
   use contact_base_case_status, only : case_state, case_status, missed_iteration
   use contact_base_error, only : error_type
   use contact_base_kinds, only : long, wp
   use contact_base_output_file, only : output_file, remove_file
   use contact_text_file_text, only : add_to_hash, empty_hash
   use contact_text_lexer, only : input_lexer
   implicit none (type, external)
   private

   public :: advised, case_letter, checkpoint, is_advised, journal_file, journal_name, journal_settings, letter_of, read_journal

   character(len=*), parameter :: heading = "CONTACT unfinished run, layout 1", suffix = ".unfinished"

   type :: case_letter_list
      !> Solved, not converged
      character(len=1) :: solved = "s", not_converged = "n"
      !> Refused, stopped by the time limit
      character(len=1) :: refused = "r", time = "t"
      !> Input checked only
      character(len=1) :: noted = "i"
   end type case_letter_list
   !> Final status of a case, as a letter; upper case if a warning recommended a larger grid, which is not repeated
   type(case_letter_list), parameter :: case_letter = case_letter_list()

   !> All letters, and their upper case forms
   character(len=*), parameter :: known_letters = "snrtiSNRTI"

   !> Settings of the run that affect its results
   type :: journal_settings
      !> Version of the program
      character(len=32) :: version = ""
      !> Optional files
      logical :: json = .false., hdf5 = .false., vtk = .false.
      !> Member of heat_source
      integer :: heat_source = 0
      logical :: angle_below_axle = .true., classical = .false.
      !> Are errors estimated?
      logical :: errors = .false.
      !> Requested order of the discretisation, or as_input_says
      integer :: order = 0
      !> Requested accuracy, 0: none [-]
      real(wp) :: accuracy = 0.0_wp
      !> Are simplified methods allowed for it?
      logical :: allows_approximate = .false.
      !> Limits of a case: time [s], memory [bytes], elements
      real(wp) :: seconds = 0.0_wp
      integer(long) :: bytes = 0, elements = 0
   end type journal_settings

   !> A state in which all files contain the same cases
   type :: checkpoint
      !> Number of finished cases
      integer :: cases = 0
      !> Ends of .out, .jsonl and the list in .pvd [bytes]
      integer(long) :: out = 0, json = 0, vtk = 0
      !> Rows of cases and patches in the HDF5 file
      integer :: rows(2) = 0
      !> Numbers of errors and warnings, and of cases by final status
      integer :: errors = 0, warnings = 0, ended(case_state%solved:case_state%refused) = 0
      !> Hashes of the input up to the last case, and of the files read by the cases
      integer(long) :: input = empty_hash, files = empty_hash
   end type checkpoint

   !> The journal of the current run
   type :: journal_file
      type(output_file), private :: file
      character(len=:), allocatable, private :: name
      !> Current state of the run, and letters of the cases since the last line
      type(checkpoint) :: now
      character(len=:), allocatable, private :: letters
   contains
      procedure :: start
      procedure :: resume
      procedure :: record
      procedure :: save_line
      procedure :: finish
   end type journal_file

contains

   !> Name of the journal
   pure function journal_name(results) result(name)
      !> Folder and base name of the results
      character(len=*), intent(in) :: results
      character(len=len(results) + len(suffix)) :: name

      name = results // suffix
   end function journal_name

   !> Start the journal of a run
   subroutine start(self, results, settings, confined)
      class(journal_file), intent(inout) :: self
      !> Folder and base name of the results
      character(len=*), intent(in) :: results
      !> Settings of the run
      type(journal_settings), intent(in) :: settings
      !> As for open_file of output_file
      logical, intent(in) :: confined
      character(len=:), allocatable :: reason
      character(len=300) :: text

      self%name = journal_name(results)
      self%letters = ""
      call self%file%open_file(self%name, reason, confined)
      call self%file%line(heading)
      associate (s => settings)
         write(text, "(A, 1X, 3(L1, 1X), I0, 3(1X, L1), 1X, I0, 2ES25.16E3, 2(1X, I0), 1X, L1)") trim(s%version), &
            & s%json, s%hdf5, s%vtk, s%heat_source, s%angle_below_axle, s%classical, s%errors, s%order, s%accuracy, &
            & s%seconds, s%bytes, s%elements, s%allows_approximate
      end associate
      call write_hashed(self%file, text)
      call self%file%flush_now()
   end subroutine start

   !> Continue the journal after a line that was read
   subroutine resume(self, results, place, from, confined)
      class(journal_file), intent(inout) :: self
      !> Folder and base name of the results
      character(len=*), intent(in) :: results
      !> End of the line [bytes]
      integer(long), intent(in) :: place
      !> State of the run at that line
      type(checkpoint), intent(in) :: from
      !> As for open_file of output_file
      logical, intent(in) :: confined
      character(len=:), allocatable :: ignored

      self%name = journal_name(results)
      self%letters = ""
      self%now = from
      call self%file%open_again(self%name, place, ignored, confined)
   end subroutine resume

   !> Record a finished case; `now` describes the state after it
   subroutine record(self, letter)
      class(journal_file), intent(inout) :: self
      !> Final status of the case, as a letter
      character(len=1), intent(in) :: letter

      self%letters = self%letters // letter
   end subroutine record

   !> Write a line for the cases recorded since the last one; to be called when all files have been flushed
   subroutine save_line(self)
      class(journal_file), intent(inout) :: self
      character(len=300) :: text

      if (len(self%letters) == 0) return
      associate (c => self%now)
         write(text, "(16(I0, 1X))") c%cases, c%out, c%json, c%vtk, c%rows, c%errors, c%warnings, c%ended, c%input, c%files
      end associate
      call write_hashed(self%file, trim(text) // " " // self%letters)
      call self%file%flush_now()
      self%letters = ""
   end subroutine save_line

   !> End the journal
   subroutine finish(self, complete)
      class(journal_file), intent(inout) :: self
      !> Are all cases finished? Then, and if no case is finished, there is nothing to resume and the journal is deleted
      logical, intent(in) :: complete
      logical :: ignored

      if (.not. allocated(self%name)) return
      call self%save_line()
      call self%file%close_file(ignored)
      if (complete .or. self%now%cases == 0) call remove_file(self%name)
   end subroutine finish

   !> Write a line followed by its hash
   subroutine write_hashed(file, text)
      type(output_file), intent(in) :: file
      character(len=*), intent(in) :: text
      integer(long) :: hash
      character(len=16) :: figures

      hash = empty_hash
      call add_to_hash(trim(text), hash)
      write(figures, "(1X, I0)") hash
      call file%line(trim(text) // trim(figures))
   end subroutine write_hashed

   !> Read a journal up to the last line whose state all result files have reached
   subroutine read_journal(results, ends, rows, settings, found, last, place, letters)
      !> Folder and base name of the results
      character(len=*), intent(in) :: results
      !> Lengths of .out, .jsonl and .pvd [bytes]; 0 for files that were not requested
      integer(long), intent(in) :: ends(3)
      !> Rows of cases and patches in the HDF5 file; huge: no such file
      integer, intent(in) :: rows(2)
      !> Settings of the run
      type(journal_settings), intent(out) :: settings
      !> Are there settings, and therefore an earlier run?
      logical, intent(out) :: found
      !> State at the line; without cases if there is none
      type(checkpoint), intent(out) :: last
      !> End of that line in the file [bytes]
      integer(long), intent(out) :: place
      !> Final status of the cases
      character(len=:), allocatable, intent(out) :: letters
      type(input_lexer) :: file
      type(error_type), allocatable :: error
      type(checkpoint) :: c
      character(len=:), allocatable :: body, line, seen
      integer(long) :: behind
      integer :: k, status
      logical :: is_whole

      found = .false.
      letters = ""
      place = 0
      call file%open_file(journal_name(results), error)
      if (allocated(error)) return
      if (file%count_lines() < 2) return
      line = file%line_text(1)
      if (line /= heading) return
      behind = len(line) + 1
      call get_line(2)
      if (.not. is_whole) return
      associate (s => settings)
         read(body, *, iostat=status) s%version, s%json, s%hdf5, s%vtk, s%heat_source, s%angle_below_axle, s%classical, s%errors, &
            & s%order, s%accuracy, s%seconds, s%bytes, s%elements, s%allows_approximate
         if (status /= 0) return
         if (.not. (s%seconds >= 0.0_wp .and. s%bytes >= 0 .and. s%elements >= 0)) return
      end associate
      found = .true.
      place = behind
      seen = ""
      do k = 3, file%count_lines()
         call get_line(k)
         if (.not. is_whole) return
         read(body, *, iostat=status) c%cases, c%out, c%json, c%vtk, c%rows, c%errors, c%warnings, c%ended, c%input, c%files
         if (status /= 0) return
         seen = seen // body(index(body, " ", back=.true.) + 1:)
         if (len(seen) /= c%cases .or. .not. follows(c, last) .or. verify(seen, known_letters) > 0) return
         if (any([c%out, c%json, c%vtk] > ends) .or. any(c%rows > rows)) return
         last = c
         letters = seen
         place = behind
      end do

   contains

      !> Get a line without its hash, and the end of the line
      subroutine get_line(k)
         integer, intent(in) :: k
         integer(long) :: hash, expected
         integer :: space

         line = file%line_text(k)
         is_whole = .false.
         space = index(line, " ", back=.true.)
         ! the line end is included: the last line may be incomplete
         if (space < 2 .or. k == file%count_lines()) return
         read(line(space + 1:), *, iostat=status) expected
         if (status /= 0) return
         hash = empty_hash
         call add_to_hash(trim(line(:space - 1)), hash)
         if (hash /= expected) return
         body = trim(line(:space - 1))
         behind = behind + len(line) + 1
         is_whole = .true.
      end subroutine get_line
   end subroutine read_journal

   !> Can a run proceed from one checkpoint to another? No count and no position decreases
   pure logical function follows(next, before)
      type(checkpoint), intent(in) :: next, before

      follows = next%cases > before%cases .and. all(next%rows >= before%rows) .and. all(next%ended >= before%ended) &
         & .and. all([next%out, next%json, next%vtk] >= [before%out, before%json, before%vtk]) &
         & .and. all([next%errors, next%warnings] >= [before%errors, before%warnings]) .and. sum(next%ended) <= next%cases
   end function follows

   !> Letter of a case
   pure function letter_of(status, solved) result(letter)
      type(case_status), intent(in) :: status
      !> Was the case to be solved?
      logical, intent(in) :: solved
      character(len=1) :: letter

      letter = case_letter%solved
      if (status%state == case_state%refused) then
         letter = case_letter%refused
      else if (status%iteration == missed_iteration%time) then
         letter = case_letter%time
      else if (.not. solved) then
         letter = case_letter%noted
      else if (status%state == case_state%not_converged) then
         letter = case_letter%not_converged
      end if
   end function letter_of

   !> Letter of a case for which a larger grid was recommended
   pure function advised(letter) result(capital)
      !> Letter of the final status
      character(len=1), intent(in) :: letter
      character(len=1) :: capital

      capital = achar(iachar(letter) - 32)
   end function advised

   !> Was a larger grid recommended? The letter is converted to lower case
   pure subroutine is_advised(letter, answer)
      !> Letter of the final status
      character(len=1), intent(inout) :: letter
      !> True for a letter from `advised`
      logical, intent(out) :: answer

      answer = letter >= "A" .and. letter <= "Z"
      if (answer) letter = achar(iachar(letter) + 32)
   end subroutine is_advised
end module contact_experiment_journal
