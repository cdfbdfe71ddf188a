!> Results of a solved case for programs: status, totals, and how they were obtained
!>
!> Values are unfiltered, unlike those of the .out file.
module contact_output_case_record
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_accuracy_report, only : accuracy_report
   use contact_base_case_status, only : case_state, case_status
   use contact_base_choices, only : motion
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : ending, solve_report
   use contact_cases_border_warning, only : beside_words, border_words, buried_words
   use contact_cases_spec, only : case_spec
   use contact_output_record, only : record_writer
   use contact_patch_quantities, only : error_law, total_list
   use contact_patch_resolution, only : elements_across, is_coarse
   use contact_patch_result, only : patch_result
   use contact_wheelrail_result, only : wheel_rail_patch, wheel_rail_result
   implicit none (type, external)
   private

   public :: case_head, describe_head, describe_list, describe_patch, describe_run, describe_wheel_rail, planned_text, &
      & run_summary, side_sign

   !> Progress of a run
   type :: run_summary
      !> Number of cases of the input; if it cannot be read to its end, number of those before that point
      integer :: planned = 0
      !> Can the input be read to its end?
      logical :: readable = .true.
      !> Number of finished cases: solved, refused, or only read
      integer :: finished = 0
      !> Number of cases by their final status, indexed by the members of case_state
      integer :: ended(case_state%solved:case_state%refused) = 0
      !> Why the run ended before all cases were finished; unallocated if it did not, or is still running
      character(len=:), allocatable :: reason
   contains
      !> Are all cases finished?
      procedure :: is_complete
   end type run_summary

   !> Identification and status of a case
   type :: case_head
      !> Number of the case; result element, 0 for none; contact patch number of the module line; module
      integer :: number = 0, result_element = 0, contact_problem = 1, module_number = 3
      !> Line of the input at which the case begins
      integer :: line = 0
      !> Number of finished cases of the run, including this one
      integer :: finished = 0
      !> Final status
      type(case_status) :: status
      !> Elapsed time of the solution [s]
      real(wp) :: seconds = 0.0_wp
   end type case_head

   !> How an iteration ended, in words, indexed by the members of ending
   character(len=*), parameter :: ending_names(ending%not_started:ending%out_of_time) = [character(len=15) :: "nothing to do", &
      & "converged", "iteration limit", "stagnated", "diverged", "beyond friction", "out of time"]

contains

   pure logical function is_complete(self)
      class(run_summary), intent(in) :: self
      is_complete = self%readable .and. self%finished == self%planned .and. .not. allocated(self%reason)
   end function is_complete

   !> "6 of 12 cases", "6 of at least 12 cases", padded with blanks
   pure function planned_text(run) result(text)
      type(run_summary), intent(in) :: run
      character(len=48) :: text

      if (run%readable) then
         write(text, "(I0, A, I0, A)") run%finished, " of ", run%planned, merge(" case ", " cases", run%planned == 1)
      else
         write(text, "(I0, A, I0, A)") run%finished, " of at least ", run%planned, merge(" case ", " cases", run%planned == 1)
      end if
   end function planned_text

   !> Write the progress of the run; numbers of cases by their status are written at its end
   subroutine describe_run(record, run)
      class(record_writer), intent(inout) :: record
      type(run_summary), intent(in) :: run

      call record%flag("complete", "are all cases of the input finished?", run%is_complete())
      call record%count("cases_planned", "cases of the input; of one that cannot be read to its end those up to there", run%planned)
      call record%flag("input_readable", "can the input be read to its end?", run%readable)
      call record%count("cases_finished", "cases that are finished: solved, refused, or only taken note of", run%finished)
      if (.not. (run%is_complete() .or. allocated(run%reason))) return
      call record%count("solved", "cases that were solved", run%ended(case_state%solved))
      call record%count("not_converged", "cases that did not converge", run%ended(case_state%not_converged))
      call record%count("refused", "cases that were refused", run%ended(case_state%refused))
      if (allocated(run%reason)) call record%text("reason", "why the run ended before all cases were finished", run%reason)
   end subroutine describe_run

   !> -1 for a wheel on the left side of the track, otherwise 1
   pure real(wp) function side_sign(spec) result(s)
      type(case_spec), intent(in) :: spec

      s = 1.0_wp
      if (.not. allocated(spec%wheel_rail)) return
      if (spec%wheel_rail%left) s = -1.0_wp
   end function side_sign

   !> Number, status and time of a case
   subroutine describe_head(record, head)
      class(record_writer), intent(inout) :: record
      type(case_head), intent(in) :: head

      call record%count("case", "number of the case", head%number)
      call record%count("result_element", "result element of the module line, 0: none", head%result_element)
      call record%count("contact_problem", "contact problem of the module line", head%contact_problem)
      call record%count("module", "1: wheel and rail, 3: one contact problem", head%module_number)
      call record%count("line", "line of the input at which the case begins", head%line)
      call record%flag("solved", "is there a result?", head%status%has_result())
      call record%flag("converged", "did all iterations reach their tolerance, and are all prescribed forces there?", &
         & head%status%is_solved())
      call record%text("status", "how the case ended: solved, not converged, refused", trim(head%status%word()))
      call record%count("status_code", "how the case ended, 0: solved, 1: not converged, 2: refused", head%status%state)
      call record%count("missed", "what did not converge, 0: none, 1: normal, 2: tangential, 3: outer, 4: force, 5: time", &
         & head%status%iteration)
      call record%number("seconds", "", "elapsed time of the solution", head%seconds)
      if (head%status%is_solved()) return
      call record%text("iteration", "what did not converge", trim(head%status%iteration_word()))
      call record%text("reason", "which iteration failed, and by how much; or why there is no result", head%status%reason)
      if (.not. head%status%has_result()) call record%text("failure", "why there is no result", head%status%reason)
   end subroutine describe_head

   !> Totals of all patches of a wheel on a rail together
   subroutine describe_wheel_rail(record, spec, pair)
      class(record_writer), intent(inout) :: record
      type(case_spec), intent(in) :: spec
      type(wheel_rail_result), intent(in) :: pair
      character(len=5), parameter :: names(2) = ["inner", "outer"]
      type(total_list) :: totals
      integer :: k

      call pair%totals(spec%wheel_rail, totals)
      call describe_list(record, "totals", totals)
      if (allocated(pair%errors)) call describe_errors(record, pair%errors, totals, "")
      if (allocated(pair%accuracy)) call describe_accuracy(record, pair%accuracy)
      if (pair%beside%depth > 0.0_wp) call record%text("beside", "another position along the track where wheel and rail &
         &overlap, which carries no load here", trim(beside_words(spec, pair%beside)))
      if (.not. any(pair%buried%depth > 0.0_wp)) return
      call record%open_group("buried")
      do k = 1, size(pair%buried)
         if (pair%buried(k)%depth > 0.0_wp) call record%text(names(k), "an end of the wheel profile within the rail, which &
            &carries no load here", trim(buried_words(spec, pair%buried(k), k)))
      end do
      call record%close_group()
   end subroutine describe_wheel_rail

   !> One contact patch: totals, warnings about them, and how it was solved
   subroutine describe_patch(record, spec, contact, place)
      class(record_writer), intent(inout) :: record
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: contact
      !> Position of the patch, in module 1
      type(wheel_rail_patch), intent(in), optional :: place
      type(total_list) :: totals

      if (present(place)) then
         call place%totals(totals, spec%wheel_rail%left)
      else
         call contact%totals(totals)
      end if
      call describe_list(record, "totals", totals)
      if (allocated(contact%errors)) call describe_errors(record, contact%errors%value, totals, trim(contact%errors%reason))
      if (allocated(contact%accuracy)) call describe_accuracy(record, contact%accuracy)
      call describe_border(record, spec, contact)
      call describe_resolution(record, contact)
      call describe_solution(record, spec, contact)
   end subroutine describe_patch

   !> A group of totals, or of other values of a list
   subroutine describe_list(record, name, totals)
      class(record_writer), intent(inout) :: record
      !> Group name; each total can be plotted over the cases
      character(len=*), intent(in) :: name
      type(total_list), intent(in) :: totals
      integer :: k

      call record%open_group(name, columns=name == "totals")
      do k = 1, totals%length
         associate (row => totals%rows(k))
            if (.not. row%in_files) cycle
            if (row%is_count) then
               call record%count(trim(row%name), trim(row%meaning), nint(row%value))
            else
               call record%number(trim(row%name), trim(row%unit), trim(row%meaning), row%value)
            end if
         end associate
      end do
      call record%close_group()
   end subroutine describe_list

   !> Estimated errors of the totals; totals without an estimate are named
   subroutine describe_errors(record, errors, totals, reason)
      class(record_writer), intent(inout) :: record
      !> Errors of the first totals of the list, in their units; NaN for those without an estimate
      real(wp), intent(in) :: errors(:)
      type(total_list), intent(in) :: totals
      !> Why there is no estimate; "" if there is one
      character(len=*), intent(in) :: reason
      character(len=:), allocatable :: without
      integer :: k

      without = ""
      call record%open_group("errors", columns=.true.)
      do k = 1, size(errors)
         associate (row => totals%rows(k))
            if (.not. row%in_files .or. row%law == error_law%none) cycle
            if (ieee_is_finite(errors(k))) then
               call record%number(trim(row%name) // "_error", trim(row%unit), "estimated error of " // trim(row%name), &
                  & errors(k))
            else
               if (len(without) > 0) without = without // ", "
               without = without // trim(row%name)
            end if
         end associate
      end do
      if (len(without) > 0) call record%text("without", "totals that were given, or of which no error is known", without)
      if (reason /= "") call record%text("reason", "why there is no estimate", reason)
      call record%close_group()
   end subroutine describe_errors

   !> Result of the solution to a prescribed accuracy
   subroutine describe_accuracy(record, report)
      class(record_writer), intent(inout) :: record
      !> Report of the case
      type(accuracy_report), intent(in) :: report

      call record%open_group("accuracy", columns=.true.)
      call record%number("asked", "-", "required accuracy: largest relative error of the forces", report%required)
      if (report%estimated >= 0.0_wp) call record%number("estimated", "-", "estimated relative error of the forces", &
         & report%estimated)
      call record%flag("reached", "is the estimate within the required accuracy?", report%is_met)
      if (report%elements(1) > 0) call record%count("mx", "elements along x that were chosen", report%elements(1))
      if (report%elements(1) > 0) call record%count("my", "elements along y that were chosen", report%elements(2))
      call record%number("dx", "mm", "side of elements along x that was chosen", report%sides(1))
      call record%number("dy", "mm", "side of elements along y that was chosen", report%sides(2))
      if (report%order > 0) call record%count("order", "order of the discretisation of rolling", report%order)
      call record%number("eps", "-", "tolerance of the solvers that was chosen", report%eps)
      call record%count("grids", "grids that were solved", report%levels)
      call record%number("seconds_of_grids", "s", "elapsed time of all grids", report%seconds)
      call record%number("seconds_of_last", "s", "elapsed time of the grid that was kept", report%last_seconds)
      if (report%method /= "") call record%text("simplified", "the simplified method that was chosen, or why none", &
         & trim(report%method))
      if (.not. report%is_met) call record%text("reason", "why it was not reached", trim(report%reason))
      call record%close_group()
   end subroutine describe_accuracy

   !> Position where contact is truncated by the border of the potential contact or the end of a profile; nothing if it is not
   subroutine describe_border(record, spec, contact)
      class(record_writer), intent(inout) :: record
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: contact
      character(len=:), allocatable :: words

      call border_words(spec, contact%border, words)
      if (len(words) == 0) return
      call record%open_group("border")
      call record%text("reached", "where contact is cut off", words)
      call record%number("pressure", "N/mm2", "largest pressure there", contact%border%pressure)
      call record%close_group()
   end subroutine describe_border

   !> Number of elements across the contact, if these are too few; otherwise nothing
   subroutine describe_resolution(record, contact)
      class(record_writer), intent(inout) :: record
      type(patch_result), intent(in) :: contact
      integer :: across(2)

      if (.not. is_coarse(contact)) return
      across = max(1, elements_across(contact%division))
      call record%open_group("coarse")
      call record%count("along_x", "most elements in contact in a row along x", across(1))
      call record%count("along_y", "most elements in contact in a column along y", across(2))
      call record%close_group()
   end subroutine describe_resolution

   !> Methods that ended the solution of a patch, and their residuals
   subroutine describe_solution(record, spec, contact)
      class(record_writer), intent(inout) :: record
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: contact

      call record%open_group("solver", columns=.true., brief=.true.)
      call describe_report(record, "normal", contact%normal)
      if (spec%motion /= motion%none) call describe_report(record, "tangential", contact%tangential)
      if (allocated(contact%friction)) call describe_report(record, "friction", contact%friction)
      call record%count("outer_iterations", "turns of normal and tangential problem", contact%outer_iterations)
      if (spec%motion /= motion%none .and. contact%outer_iterations > 1) &
         & call record%number("coupled_residual", "", "relative residual of both problems together", contact%residual)
      call record%close_group()
   end subroutine describe_solution

   !> One iterative method
   subroutine describe_report(record, problem, report)
      class(record_writer), intent(inout) :: record
      !> Name of the problem
      character(len=*), intent(in) :: problem
      type(solve_report), intent(in) :: report
      character(len=:), allocatable :: method

      method = trim(report%method)
      if (method == "") method = "none"
      call record%text(problem // "_method", "method that ended the iteration", method)
      if (report%asked /= "") call record%text(problem // "_asked", "method of the input, if another one was used", &
         & trim(report%asked))
      if (report%gave_up /= "") call record%text(problem // "_gave_up", "method that was abandoned", trim(report%gave_up))
      if (report%order > 0) call record%count(problem // "_order", "order of the discretisation", report%order)
      if (report%order_reason /= "") call record%text(problem // "_order_reason", "why order 1, or what order 2 leaves out", &
         & trim(report%order_reason))
      call record%text(problem // "_ended", "how the iteration ended", trim(ending_names(report%ended)))
      call record%count(problem // "_iterations", "iterations of the last call", report%iterations)
      if (report%residual >= 0.0_wp) call record%number(problem // "_residual", "", "relative residual", report%residual)
      call record%number(problem // "_tolerance", "", "requested tolerance", report%tolerance)
   end subroutine describe_report
end module contact_output_case_record
