!> Errors and problems of a run: written to the .out file and the error unit, counted, and the first one remembered
module contact_experiment_errors
   use contact_base_error, only : add_context, error_type, full_text
   use contact_experiment_state, only : experiment_state, no_unit
   use contact_input_experiment_file, only : input_case
   use contact_input_problems, only : problem_text, severity
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: find_refusal, place_error, read_case, report_error, report_final_error, report_problems

contains

   !> Write an error to the .out file and to the error unit, and remember the first one
   subroutine report_error(state, error)
      type(experiment_state), intent(inout) :: state
      type(error_type), intent(in) :: error

      call write_error(state, " ERROR. " // full_text(error))
      state%errors = state%errors + 1
      if (.not. allocated(state%first_error)) state%first_error = error
   end subroutine report_error

   !> Write the problems of a case: warnings to the log, errors as in report_error
   !>
   !> After a case with errors only those of values that the case itself gives are certain. Others may follow from values that it
   !> keeps; they are hidden if `keeps_refused` is set.
   subroutine report_problems(state, this, keeps_refused, is_hidden)
      type(experiment_state), intent(inout) :: state
      type(input_case), intent(in) :: this
      !> May the case keep values of a case with errors? Default: no
      logical, intent(in), optional :: keeps_refused
      !> Were errors hidden?
      logical, intent(out), optional :: is_hidden
      logical :: only_own
      integer :: k

      only_own = .false.
      if (present(keeps_refused)) only_own = keeps_refused
      if (present(is_hidden)) is_hidden = .false.
      do k = 1, this%problems%count
         associate (item => this%problems%items(k))
            if (item%severity == severity%warning) then
               call state%log%line(problem_text(item))
               state%log%warnings = state%log%warnings + 1
            else if (only_own .and. .not. item%is_own) then
               if (present(is_hidden)) is_hidden = .true.
            else
               call write_error(state, problem_text(item))
               state%errors = state%errors + 1
               if (.not. allocated(state%first_error)) then
                  state%first_error = item%what
                  call add_context(state%first_error, "case " // integer_text(this%number))
               end if
            end if
         end associate
      end do
   end subroutine report_problems

   !> Read the next case; problems of the input are reported if no case follows
   subroutine read_case(state, this, is_found, error)
      type(experiment_state), intent(inout) :: state
      type(input_case), intent(out) :: this
      !> False at the end of the input, and after an error
      logical, intent(out) :: is_found
      !> Allocated if the input cannot be read any further
      type(error_type), allocatable, intent(out) :: error

      call state%reader%next_case(this, error)
      is_found = .false.
      if (.not. allocated(error)) is_found = this%module_number /= 0
      ! a wrong digit may be the cause why the following text cannot be read
      if (.not. is_found) call report_problems(state, this)
   end subroutine read_case

   !> Report the error that ends the run before all cases are finished
   subroutine report_final_error(state, error)
      type(experiment_state), intent(inout) :: state
      type(error_type), intent(in) :: error

      call report_error(state, error)
      state%run%reason = full_text(error)
   end subroutine report_final_error

   !> Assign an error without position to the start of its case in the input
   subroutine place_error(state, this, error)
      type(experiment_state), intent(in) :: state
      type(input_case), intent(in) :: this
      type(error_type), intent(inout) :: error

      if (allocated(error%file)) return
      error%file = state%place%input
      error%line = this%first_line
   end subroutine place_error

   !> Why the input of a case is invalid: its first error
   subroutine find_refusal(this, reason)
      type(input_case), intent(in) :: this
      !> One sentence
      character(len=:), allocatable, intent(out) :: reason
      integer :: k

      reason = "its input cannot be used"
      do k = 1, this%problems%count
         associate (item => this%problems%items(k))
            if (item%severity == severity%warning) cycle
            reason = reason // ": " // full_text(item%what)
         end associate
         return
      end do
   end subroutine find_refusal

   !> Write a line to the .out file and to the error unit, after clearing the progress line
   subroutine write_error(state, text)
      type(experiment_state), intent(inout) :: state
      character(len=*), intent(in) :: text
      integer :: status

      call state%log%result(text)
      if (state%complaints == no_unit) return
      call state%progress%hide()
      if (state%log%screen /= 0) flush(state%log%screen, iostat=status)
      write(state%complaints, "(A)") text
      flush(state%complaints, iostat=status)
   end subroutine write_error
end module contact_experiment_errors
