!> How a case ended: solved, not converged or refused
!>
!> All outputs, return codes and the exit status are derived from this one value. A patch sets it from the reports of its
!> iterations and from its forces, a wheel on a rail from its patches and from the searches for its forces. A case without a
!> result sets it where the computation is abandoned.
module contact_base_case_status
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : failure_text, size_text, solve_report
   implicit none (type, external)
   private

   public :: case_state, case_status, missed_iteration

   type :: case_state_list
      !> Only the input was checked (R = 2, 3), or there was no calculation yet; states of the library only
      integer :: not_calculated = -1
      !> Every iteration reached its tolerance, and all prescribed forces are met
      integer :: solved = 0
      !> An iteration ended above its tolerance, or a prescribed force is not met
      integer :: not_converged = 1
      !> The case was not computed
      integer :: refused = 2
   end type case_state_list
   !> Final states of a case
   type(case_state_list), parameter :: case_state = case_state_list()

   type :: missed_iteration_list
      integer :: none = 0
      integer :: normal = 1, tangential = 2
      !> Outer iteration: pressures and tractions, or friction with slip or temperature
      integer :: outer = 3
      !> Prescribed forces
      integer :: force = 4
      !> The time limit was reached; there is no result
      integer :: time = 5
   end type missed_iteration_list
   !> Iterations that may miss their tolerance, in order of cause: a smaller value is the cause of a larger one
   type(missed_iteration_list), parameter :: missed_iteration = missed_iteration_list()

   !> Final status of a case
   type :: case_status
      !> Member of case_state
      integer :: state = 0
      !> Iteration that did not converge, member of missed_iteration
      integer :: iteration = 0
      !> One sentence: the iteration and its residual, or why there is no result; unallocated when solved
      character(len=:), allocatable :: reason
   contains
      !> Is the case solved?
      procedure :: is_solved
      !> Is there a result, converged or not?
      procedure :: has_result
      !> Name of the state, padded with blanks
      procedure :: word
      !> Name of the iteration that did not converge, padded with blanks
      procedure :: iteration_word
      !> Mark the case as one whose input was only checked
      procedure :: only_check
      !> Record the outcome of an iteration
      procedure :: record_iteration
      !> Record a prescribed force that is not met
      procedure :: record_missed_force
      !> Mark the case as refused: it is not computed
      procedure :: refuse
      !> Mark the case as stopped by the time limit
      procedure :: run_out_of_time
      !> Merge the status of a part of the case
      procedure :: include => include_part
      procedure, private :: record_failure
   end type case_status

contains

   pure logical function is_solved(self)
      class(case_status), intent(in) :: self
      is_solved = self%state == case_state%solved
   end function is_solved

   pure logical function has_result(self)
      class(case_status), intent(in) :: self
      has_result = self%state /= case_state%refused .and. self%iteration /= missed_iteration%time
   end function has_result

   pure function word(self)
      class(case_status), intent(in) :: self
      character(len=13) :: word

      select case (self%state)
      case (case_state%solved)
         word = "solved"
      case (case_state%not_converged)
         word = "not converged"
      case default
         word = "refused"
      end select
   end function word

   pure function iteration_word(self) result(word)
      class(case_status), intent(in) :: self
      character(len=10) :: word
      character(len=10), parameter :: words(0:5) = [character(len=10) :: "none", "normal", "tangential", "outer", "force", "time"]

      word = words(self%iteration)
   end function iteration_word

   !> Mark the case as one whose input was only checked
   pure subroutine only_check(self)
      class(case_status), intent(inout) :: self

      self%state = case_state%not_calculated
      self%reason = "only the input was checked, as requested; there are no results"
   end subroutine only_check

   !> Record the outcome of an iteration; one that converged or was not started changes nothing
   subroutine record_iteration(self, iteration, name, report)
      class(case_status), intent(inout) :: self
      !> Member of missed_iteration
      integer, intent(in) :: iteration
      !> Name of the iteration, such as "normal problem"
      character(len=*), intent(in) :: name
      !> Outcome of the iteration
      type(solve_report), intent(in) :: report

      if (report%succeeded()) return
      call self%record_failure(iteration, trim(failure_text(name, report)))
   end subroutine record_iteration

   !> Record a prescribed force that is not met
   subroutine record_missed_force(self, name, requested, found, why)
      class(case_status), intent(inout) :: self
      !> Name of the force, such as "FX"
      character(len=*), intent(in) :: name
      !> Prescribed and computed force [N]
      real(wp), intent(in) :: requested, found
      !> Reason for the difference
      character(len=*), intent(in) :: why
      character(len=24) :: numbers(3)

      write(numbers(:2), "(G0.6)") requested, found
      numbers(:2) = adjustl(numbers(:2))
      numbers(3) = size_text(found - requested, 2)
      call self%record_failure(missed_iteration%force, "force, requested " // name // " " // trim(numbers(1)) // " N, found " // &
         & trim(numbers(2)) // " N, off by " // trim(numbers(3)) // " N: " // why)
   end subroutine record_missed_force

   !> Record a quantity above its tolerance; the first cause is kept
   subroutine record_failure(self, iteration, reason)
      class(case_status), intent(inout) :: self
      !> Member of missed_iteration
      integer, intent(in) :: iteration
      character(len=*), intent(in) :: reason

      if (self%state == case_state%refused) return
      if (self%state == case_state%not_converged) then
         if (self%iteration < iteration) return
         if (self%iteration == iteration) then
            self%reason = self%reason // "; " // reason
            return
         end if
      end if
      self%state = case_state%not_converged
      self%iteration = iteration
      self%reason = reason
   end subroutine record_failure

   subroutine refuse(self, reason)
      class(case_status), intent(inout) :: self
      !> Why there is no result
      character(len=*), intent(in) :: reason

      self%state = case_state%refused
      self%iteration = missed_iteration%none
      self%reason = reason
   end subroutine refuse

   subroutine run_out_of_time(self, reason)
      class(case_status), intent(inout) :: self
      !> Stage of the computation and elapsed time
      character(len=*), intent(in) :: reason

      self%state = case_state%not_converged
      self%iteration = missed_iteration%time
      self%reason = reason
   end subroutine run_out_of_time

   !> Merge the status of a part of the case
   subroutine include_part(self, part, where)
      class(case_status), intent(inout) :: self
      !> Status of the part; its reasons are added, prefixed with the name of the part
      type(case_status), intent(in) :: part
      !> Name of the part
      character(len=*), intent(in) :: where

      if (part%is_solved()) return
      if (part%state == case_state%refused) then
         call self%refuse(where // part%reason)
      else
         call self%record_failure(part%iteration, where // part%reason)
      end if
   end subroutine include_part
end module contact_base_case_status
