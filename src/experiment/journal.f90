!> How far a run has come, in a file of its own beside the results: what `--resume` goes on from
!>
!> EXPNAM.unfinished is there while a run goes on, and stays when it ends before all cases are finished. A line with the
!> settings is followed by one for each moment at which all files held all cases so far: the places of their ends, the counts,
!> hashes of what was read, and a letter for each case since the line before. Each line ends with its hash, so that a torn or
!> damaged one is seen. A write that fails is no failure of the run: the file ends earlier then.
module contact_experiment_journal
   use contact_base_case_status, only : case_state, case_status, missed_iteration
   use contact_base_error, only : error_type
   use contact_base_kinds, only : long, wp
   use contact_base_output_file, only : output_file, remove_file
   use contact_text_lexer, only : add_to_hash, empty_hash, input_lexer
   implicit none (type, external)
   private

   public :: advised, case_letter, checkpoint, is_advised, journal_file, journal_name, journal_settings, letter_of, read_journal

   character(len=*), parameter :: heading = "CONTACT unfinished run, layout 1", suffix = ".unfinished"

   type :: case_letter_list
      !> Solved, not converged
      character(len=1) :: solved = "s", not_converged = "n"
      !> Refused, given up when its time was over
      character(len=1) :: refused = "r", time = "t"
      !> Input taken note of
      character(len=1) :: noted = "i"
   end type case_letter_list
   !> How a case ended, in one letter; a capital where a larger grid was named in a warning, which is not said again
   type(case_letter_list), parameter :: case_letter = case_letter_list()

   !> All of them, with their capitals
   character(len=*), parameter :: known_letters = "snrtiSNRTI"

   !> With what the run was asked for, as far as results depend on it
   type :: journal_settings
      !> Version of the program
      character(len=32) :: version = ""
      !> Files beside the usual ones
      logical :: json = .false., hdf5 = .false., vtk = .false.
      !> Member of heat_source
      integer :: heat_source = 0
      logical :: angle_below_axle = .true., classical = .false.
      !> Are errors estimated?
      logical :: errors = .false.
      !> Order of the discretisation that was asked for, or as_input_says
      integer :: order = 0
      !> Accuracy that was asked for, 0 for none [-]
      real(wp) :: accuracy = 0.0_wp
      !> Were simplified methods allowed for it?
      logical :: allows_approximate = .false.
      !> Limits of a case: time [s], memory [bytes], elements
      real(wp) :: seconds = 0.0_wp
      integer(long) :: bytes = 0, elements = 0
   end type journal_settings

   !> A moment at which all files hold the same cases
   type :: checkpoint
      !> Cases that are finished
      integer :: cases = 0
      !> Ends of .out, .jsonl and the list in .pvd [bytes]
      integer(long) :: out = 0, json = 0, vtk = 0
      !> Rows of cases and patches in the HDF5 file
      integer :: rows(2) = 0
      !> Counts of errors and warnings, and of cases by how they ended
      integer :: errors = 0, warnings = 0, ended(case_state%solved:case_state%refused) = 0
      !> Hashes of the input up to the last case, and of the files that the cases read
      integer(long) :: input = empty_hash, files = empty_hash
   end type checkpoint

   !> The file while a run goes on
   type :: journal_file
      type(output_file), private :: file
      character(len=:), allocatable, private :: name
      !> Where the run is, and letters of the cases since the last line
      type(checkpoint) :: now
      character(len=:), allocatable, private :: letters
   contains
      procedure :: start
      procedure :: go_on
      procedure :: note
      procedure :: save_line
      procedure :: finish
   end type journal_file

contains

   !> Name of the file
   pure function journal_name(results) result(name)
      !> Folder and name of the results
      character(len=*), intent(in) :: results
      character(len=len(results) + len(suffix)) :: name

      name = results // suffix
   end function journal_name

   !> Begin the file of a run
   subroutine start(self, results, settings, confined)
      class(journal_file), intent(inout) :: self
      !> Folder and name of the results
      character(len=*), intent(in) :: results
      !> What the run was asked for
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

   !> Go on with the file behind a line that was read
   subroutine go_on(self, results, place, from, confined)
      class(journal_file), intent(inout) :: self
      !> Folder and name of the results
      character(len=*), intent(in) :: results
      !> End of the line [bytes], and what it says
      integer(long), intent(in) :: place
      !> State of the run behind that line
      type(checkpoint), intent(in) :: from
      !> As for open_file of output_file
      logical, intent(in) :: confined
      character(len=:), allocatable :: ignored

      self%name = journal_name(results)
      self%letters = ""
      self%now = from
      call self%file%open_again(self%name, place, ignored, confined)
   end subroutine go_on

   !> A case is finished: what `now` says holds
   subroutine note(self, letter)
      class(journal_file), intent(inout) :: self
      !> How the case ended, in one letter
      character(len=1), intent(in) :: letter

      self%letters = self%letters // letter
   end subroutine note

   !> Write a line for the cases that were noted since the last one; call it when all files were handed to the system
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

   !> The run has ended
   subroutine finish(self, complete)
      class(journal_file), intent(inout) :: self
      !> Are all cases finished? Then, as without any finished case, there is nothing to go on with
      logical, intent(in) :: complete
      logical :: ignored

      if (.not. allocated(self%name)) return
      call self%save_line()
      call self%file%close_file(ignored)
      if (complete .or. self%now%cases == 0) call remove_file(self%name)
   end subroutine finish

   !> A line with its hash behind it
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

   !> Read a file up to the last line that all files of results reach
   subroutine read_journal(results, ends, rows, settings, found, last, place, letters)
      !> Folder and name of the results
      character(len=*), intent(in) :: results
      !> Lengths of .out, .jsonl and .pvd [bytes]; of those that were not asked for 0
      integer(long), intent(in) :: ends(3)
      !> Rows of cases and patches in the HDF5 file, huge without one
      integer, intent(in) :: rows(2)
      !> What the run was asked for
      type(journal_settings), intent(out) :: settings
      !> Are there settings? Then there was a run
      logical, intent(out) :: found
      !> What the line says, no cases when there is none, and its end [bytes]
      type(checkpoint), intent(out) :: last
      !> End of that line in the file [bytes]
      integer(long), intent(out) :: place
      !> How the cases ended
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
      call take_line(2)
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
         call take_line(k)
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

      !> A line without its hash, and the end of it
      subroutine take_line(k)
         integer, intent(in) :: k
         integer(long) :: hash, wanted
         integer :: space

         line = file%line_text(k)
         is_whole = .false.
         space = index(line, " ", back=.true.)
         ! the end of the line counts: the last one may be torn
         if (space < 2 .or. k == file%count_lines()) return
         read(line(space + 1:), *, iostat=status) wanted
         if (status /= 0) return
         hash = empty_hash
         call add_to_hash(trim(line(:space - 1)), hash)
         if (hash /= wanted) return
         body = trim(line(:space - 1))
         behind = behind + len(line) + 1
         is_whole = .true.
      end subroutine take_line
   end subroutine read_journal

   !> Can a run come from one moment to another? No count and no place ever goes down
   pure logical function follows(next, before)
      type(checkpoint), intent(in) :: next, before

      follows = next%cases > before%cases .and. all(next%rows >= before%rows) .and. all(next%ended >= before%ended) &
         & .and. all([next%out, next%json, next%vtk] >= [before%out, before%json, before%vtk]) &
         & .and. all([next%errors, next%warnings] >= [before%errors, before%warnings]) .and. sum(next%ended) <= next%cases
   end function follows

   !> The letter of a case
   pure function letter_of(status, solved) result(letter)
      type(case_status), intent(in) :: status
      !> Was it to be solved?
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

   !> A letter for a case in which a larger grid was named
   pure function advised(letter) result(capital)
      !> How the case ended
      character(len=1), intent(in) :: letter
      character(len=1) :: capital

      capital = achar(iachar(letter) - 32)
   end function advised

   !> Was a larger grid named? The letter becomes a plain one
   pure subroutine is_advised(letter, answer)
      !> How the case ended
      character(len=1), intent(inout) :: letter
      !> True for a letter that `advised` has made
      logical, intent(out) :: answer

      answer = letter >= "A" .and. letter <= "Z"
      if (answer) letter = achar(iachar(letter) + 32)
   end subroutine is_advised
end module contact_experiment_journal
