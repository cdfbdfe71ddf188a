!> The last normal problem and its solution, kept because tables of creep forces solve the same problem repeatedly
module contact_normal_last_answer
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_compliance, only : compliance
   use contact_elastic_model, only : elastic_model
   use contact_normal_problem, only : normal_problem
   use contact_numeric_pieces, only : copy_field
   implicit none (type, external)
   private

   public :: answer_type

   !> A solved problem, its initial estimate, and its solution
   type :: answer_type
      !> Is there a solution?
      logical :: is_known = .false.
      type(normal_problem) :: problem
      type(elastic_model) :: model
      real(wp) :: y_first = 0.0_wp
      real(wp), allocatable :: estimate(:, :), p(:, :)
      !> Approach [mm]
      real(wp) :: pen = 0.0_wp
      integer :: iterations = 0
      real(wp) :: residual = 0.0_wp
   contains
      procedure :: is_same_question
      procedure :: note_question
      procedure :: note_answer
   end type answer_type

contains

   !> Is this exactly the last problem, with the same estimate?
   pure logical function is_same_question(self, problem, operator, p, pen) result(same)
      class(answer_type), intent(in) :: self
      !> Current problem
      type(normal_problem), intent(in) :: problem
      !> Operator for it
      class(compliance), intent(in) :: operator
      !> Pressures [N/mm2], shape (mx, my), and approach [mm]
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Approach of the estimate [mm]
      real(wp), intent(in) :: pen

      same = self%is_known .and. .not. allocated(problem%parts)
      if (.not. same) return
      associate (q => self%problem)
         same = q%mx == problem%mx .and. q%my == problem%my .and. q%dx == problem%dx .and. q%dy == problem%dy &
            & .and. (q%force_prescribed .eqv. problem%force_prescribed) .and. q%eps == problem%eps &
            & .and. q%maxgs == problem%maxgs .and. self%y_first == operator%y_first
         if (.not. same) return
         if (problem%force_prescribed) then
            same = q%fn == problem%fn
         else
            same = self%pen == pen
         end if
         if (same) same = self%model%same_as(operator%model)
         if (same) same = all(self%estimate == p)
         if (same) same = all(q%h == problem%h)
      end associate
   end function is_same_question

   !> Record a problem. Allocated arrays of the same size are reused, which copying the problem as a whole would not do
   subroutine note_question(self, problem, operator, p)
      class(answer_type), intent(inout) :: self
      !> Copied, except for its deadline
      type(normal_problem), intent(in) :: problem
      !> Operator for it; its model and window are recorded
      class(compliance), intent(in) :: operator
      !> Estimate [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: p(:, :)

      self%is_known = .false.
      if (allocated(problem%parts)) return
      associate (q => self%problem)
         q%mx = problem%mx
         q%my = problem%my
         q%dx = problem%dx
         q%dy = problem%dy
         q%force_prescribed = problem%force_prescribed
         q%fn = problem%fn
         q%eps = problem%eps
         q%maxgs = problem%maxgs
      end associate
      call copy_field(problem%h, self%problem%h)
      if (.not. self%model%same_as(operator%model)) self%model = operator%model
      self%y_first = operator%y_first
      call copy_field(p, self%estimate)
   end subroutine note_question

   !> Record the solution, if the method converged
   subroutine note_answer(self, problem, p, pen, report)
      class(answer_type), intent(inout) :: self
      !> The problem that was recorded
      type(normal_problem), intent(in) :: problem
      !> Pressures [N/mm2], shape (mx, my), and approach [mm]
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Approach of the solution [mm]
      real(wp), intent(in) :: pen
      !> Outcome of the method
      type(solve_report), intent(in) :: report

      if (report%ended /= ending%converged .or. allocated(problem%parts)) return
      call copy_field(p, self%p)
      self%pen = pen
      self%iterations = report%iterations
      self%residual = report%residual
      self%is_known = .true.
   end subroutine note_answer
end module contact_normal_last_answer
