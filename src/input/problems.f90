!> Problems with the values of a case, collected so that reading continues after the first
module contact_input_problems
   use contact_base_error, only : error_kind, error_type, full_text
   use contact_text_bounds, only : describe_breach
   use contact_text_lexer, only : input_value
   implicit none (type, external)
   private

   public :: severity, input_problem, problem_list, problem_text

   type :: severity_list
      !> The case cannot be used
      integer :: error = 1
      !> A value was corrected or is doubtful
      integer :: warning = 2
      !> The case is valid but not implemented in this version
      integer :: unsupported = 3
   end type severity_list
   !> Kinds of problems
   type(severity_list), parameter :: severity = severity_list()

   !> A problem with its position in the file
   type :: input_problem
      !> Member of severity
      integer :: severity = 0
      !> Message and position
      type(error_type) :: what
      !> Is it about a value that the case gives itself? Otherwise it may follow from kept values
      logical :: is_own = .true.
   end type input_problem

   !> Growing list; items 1...count are in use
   type :: problem_list
      integer :: count = 0
      type(input_problem), allocatable :: items(:)
      !> Name of the input file; unallocated: none
      character(len=:), allocatable :: file
   contains
      procedure :: start
      procedure :: add
      procedure :: number_of
      procedure :: is_usable
      procedure :: first_failure
      procedure :: check_bounds
   end type problem_list

contains

   !> Empty the list and store the name of the file
   subroutine start(self, file)
      class(problem_list), intent(inout) :: self
      !> Path of the input file, for the positions in messages
      character(len=*), intent(in) :: file

      self%count = 0
      if (allocated(self%file)) deallocate(self%file)
      if (len(file) > 0) self%file = file
      if (allocated(self%items)) deallocate(self%items)
   end subroutine start

   !> Add a problem
   subroutine add(self, kind, message, line, column, is_own)
      class(problem_list), intent(inout) :: self
      !> Member of severity
      integer, intent(in) :: kind
      !> One sentence: what is wrong, and what is accepted
      character(len=*), intent(in) :: message
      !> Line in the file
      integer, intent(in) :: line
      !> Column in the line, from 1; absent or 0: the line as a whole
      integer, intent(in), optional :: column
      !> See input_problem; default: yes if there is a column
      logical, intent(in), optional :: is_own
      type(input_problem), allocatable :: longer(:)

      if (.not. allocated(self%items)) allocate(self%items(8))
      if (self%count == size(self%items)) then
         allocate(longer(2*self%count))
         longer(:self%count) = self%items
         call move_alloc(longer, self%items)
      end if
      self%count = self%count + 1
      associate (item => self%items(self%count))
         item%severity = kind
         item%what%kind = error_kind%input
         if (kind == severity%unsupported) item%what%kind = error_kind%unsupported
         item%what%message = message
         if (allocated(self%file)) item%what%file = self%file
         item%what%line = line
         if (present(column)) item%what%column = column
         item%is_own = item%what%column > 0
         if (present(is_own)) item%is_own = is_own
      end associate
   end subroutine add

   !> Number of problems of one severity
   pure integer function number_of(self, kind) result(n)
      class(problem_list), intent(in) :: self
      !> Member of severity
      integer, intent(in) :: kind

      n = 0
      if (self%count > 0) n = count(self%items(:self%count)%severity == kind)
   end function number_of

   !> Can the case be computed?
   pure logical function is_usable(self)
      class(problem_list), intent(in) :: self

      is_usable = self%number_of(severity%error) == 0 .and. self%number_of(severity%unsupported) == 0
   end function is_usable

   !> The first problem that is not a warning, as an error
   subroutine first_failure(self, error)
      class(problem_list), intent(in) :: self
      !> First problem because of which the case is refused; unallocated: none
      type(error_type), allocatable, intent(out) :: error
      integer :: k

      do k = 1, self%count
         if (self%items(k)%severity == severity%warning) cycle
         error = self%items(k)%what
         return
      end do
   end subroutine first_failure

   !> Check the bounds of a number
   subroutine check_bounds(self, value, name)
      class(problem_list), intent(inout) :: self
      !> Number with its position in the file
      type(input_value), intent(in) :: value
      !> Name of the bounds in the table; default: name of the value
      character(len=*), intent(in), optional :: name
      character(len=:), allocatable :: complaint

      if (present(name)) then
         call describe_breach(name, value%word, value%r, complaint, value%name)
      else
         call describe_breach(value%name, value%word, value%r, complaint)
      end if
      if (allocated(complaint)) call self%add(severity%error, complaint, value%line, value%column)
   end subroutine check_bounds

   !> Words at the beginning of a printed problem
   pure function opening(problem) result(words)
      type(input_problem), intent(in) :: problem
      character(len=16) :: words

      words = " Input: ERROR."
      if (problem%severity == severity%warning) words = " Input: WARNING."
   end function opening

   !> A problem as printed, " Input: ERROR. file:line:column: words"
   pure function problem_text(problem) result(text)
      !> A problem of the list
      type(input_problem), intent(in) :: problem
      character(len=len_trim(opening(problem)) + 1 + len(full_text(problem%what))) :: text

      text = trim(opening(problem)) // " " // full_text(problem%what)
   end function problem_text
end module contact_input_problems
