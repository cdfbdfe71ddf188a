!> How a case ended: solved, not converged or refused
!>
!> The one value from which every output, code and exit status is derived. A patch gets it from the reports of its
!> iterations and from its forces, a pair from its patches and from the searches for its forces; a case that has no result
!> gets it where it is given up.
module contact_base_case_status
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : failure_text, size_text, solve_report
   implicit none (type, external)
   private

   public :: case_state, case_status, missed_iteration

   type :: case_state_list
      !> Every iteration reached its tolerance, and every prescribed force is there
      integer :: solved = 0
      !> An iteration ended above its tolerance, or a prescribed force is missed
      integer :: not_converged = 1
      !> The case was not computed
      integer :: refused = 2
   end type case_state_list
   !> Names of the ways in which a case ends
   type(case_state_list), parameter :: case_state = case_state_list()

   type :: missed_iteration_list
      integer :: none = 0
      integer :: normal = 1, tangential = 2
      !> Pressures against tractions, friction against slip or temperature
      integer :: outer = 3
      !> Prescribed forces
      integer :: force = 4
      !> The time that was allowed ran out; there is no result
      integer :: time = 5
   end type missed_iteration_list
   !> Names of the iterations that may miss their tolerance; a smaller one is the cause of a larger one
   type(missed_iteration_list), parameter :: missed_iteration = missed_iteration_list()

   !> How a case ended
   type :: case_status
      !> Member of case_state
      integer :: state = 0
      !> What did not converge, member of missed_iteration
      integer :: iteration = 0
      !> One sentence: which iteration, and by how much it missed; or why there is no result. Unallocated when solved
      character(len=:), allocatable :: reason
   contains
      !> Did the case end as it should?
      procedure :: is_solved
      !> Is there a result, converged or not?
      procedure :: has_result
      !> The state in words, with blanks behind
      procedure :: word
      !> What did not converge, in one word with blanks behind
      procedure :: iteration_word
      !> Take note of an iteration that has failed
      procedure :: judge
      !> Take note of a prescribed force that is not there
      procedure :: miss_force
      !> The case is not computed
      procedure :: refuse
      !> The time that was allowed ran out
      procedure :: run_out_of_time
      !> A part of the case ended like that
      procedure :: include => include_part
      procedure, private :: miss
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

   !> Take note of an iteration if it has failed
   subroutine judge(self, iteration, name, report)
      class(case_status), intent(inout) :: self
      !> Member of missed_iteration
      integer, intent(in) :: iteration
      !> What was iterated, such as "normal problem"
      character(len=*), intent(in) :: name
      !> How it ended; one that converged, or was not done, changes nothing
      type(solve_report), intent(in) :: report

      if (report%succeeded()) return
      call self%miss(iteration, trim(failure_text(name, report)))
   end subroutine judge

   !> Take note of a prescribed force that is not there
   subroutine miss_force(self, name, requested, found, why)
      class(case_status), intent(inout) :: self
      !> Which force, such as "FX"
      character(len=*), intent(in) :: name
      !> [N]
      real(wp), intent(in) :: requested, found
      !> The reason, if one is known
      character(len=*), intent(in) :: why
      character(len=24) :: numbers(3)

      write(numbers(:2), "(G0.6)") requested, found
      numbers(:2) = adjustl(numbers(:2))
      numbers(3) = size_text(found - requested, 2)
      call self%miss(missed_iteration%force, "force, requested " // name // " " // trim(numbers(1)) // " N, found " // &
         & trim(numbers(2)) // " N, off by " // trim(numbers(3)) // " N: " // why)
   end subroutine miss_force

   !> Something is above its tolerance; the cause of it all stays
   subroutine miss(self, iteration, reason)
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
   end subroutine miss

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
      !> What was going on, and how long
      character(len=*), intent(in) :: reason

      self%state = case_state%not_converged
      self%iteration = missed_iteration%time
      self%reason = reason
   end subroutine run_out_of_time

   !> A part of the case ended like that
   subroutine include_part(self, part, where)
      class(case_status), intent(inout) :: self
      !> The part's own status: its findings are added, its reasons kept with the part's name
      type(case_status), intent(in) :: part
      !> Which part, in front of its reason
      character(len=*), intent(in) :: where

      if (part%is_solved()) return
      if (part%state == case_state%refused) then
         call self%refuse(where // part%reason)
      else
         call self%miss(part%iteration, where // part%reason)
      end if
   end subroutine include_part
end module contact_base_case_status
