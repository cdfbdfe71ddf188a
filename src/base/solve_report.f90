!> Outcome of an iteration, as data for its callers
module contact_base_solve_report
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: reason_length, solve_report, ending, failure_text, size_text

   type :: ending_list
      !> There was nothing to iterate (empty contact, skipped problem)
      integer :: not_started = 0
      !> The tolerance was reached
      integer :: converged = 1
      !> The maximum number of iterations was reached
      integer :: iteration_limit = 2
      !> The residual no longer decreased
      integer :: stagnated = 3
      !> The iterates diverged
      integer :: diverged = 4
      !> The prescribed force exceeds the friction bound
      integer :: beyond_friction = 5
      !> The time limit was reached
      integer :: out_of_time = 6
   end type ending_list
   !> Ways in which an iteration ends
   type(ending_list), parameter :: ending = ending_list()

   !> Length of the names of methods; fixed, so that setting a report does not allocate memory
   integer, parameter :: name_length = 24
   !> Length of the reason for the order
   integer, parameter :: reason_length = 48

   !> Outcome of one iterative method
   type :: solve_report
      !> Name of the method that ended the iteration; blank when none ran
      character(len=name_length) :: method = ""
      !> Name of the method that was tried first and abandoned; normally blank
      character(len=name_length) :: gave_up = ""
      !> Name of the method selected in the input if another one was used instead; normally blank
      character(len=name_length) :: asked = ""
      !> Member of ending
      integer :: ended = 0
      !> Iterations of the method (conjugate gradients, sweeps, Newton steps) in the last call
      integer :: iterations = 0
      !> Passes of the enclosing driver (INORM, ITANG), summed over outer iterations
      integer :: passes = 0
      !> Products with the full compliance operator, in all calls
      integer :: products = 0
      !> Number of transforms in all calls, in pairs of one forward and one backward real transform of the padded window; coarse
      !> levels are weighted by their size
      real(wp) :: fft_pairs = 0.0_wp
      !> True residual of the contact conditions, relative (see the method's room); -1 if unknown
      real(wp) :: residual = -1.0_wp
      !> Requested tolerance
      real(wp) :: tolerance = 0.0_wp
      !> Order of the discretisation that was used, 1 or 2, if 2 was requested; 0 otherwise
      integer :: order = 0
      !> Why order 1 was used instead, or what order 2 leaves out
      character(len=reason_length) :: order_reason = ""
   contains
      !> Did the iteration reach its tolerance, or was there nothing to do?
      procedure :: succeeded => report_succeeded
   end type solve_report

contains

   pure logical function report_succeeded(self) result(succeeded)
      class(solve_report), intent(in) :: self
      succeeded = self%ended == ending%converged .or. self%ended == ending%not_started
   end function report_succeeded

   !> Failure of an iteration, with its residual and tolerance, padded with blanks
   function failure_text(name, report) result(text)
      !> Name of the iteration, such as "normal problem"
      character(len=*), intent(in) :: name
      !> Outcome of the iteration, with residual and tolerance
      type(solve_report), intent(in) :: report
      character(len=len(name) + name_length + 88) :: text
      character(len=11) :: numbers(2)
      character(len=27) :: how

      select case (report%ended)
      case (ending%iteration_limit)
         how = "reached the iteration limit"
      case (ending%stagnated)
         how = "stagnated"
      case (ending%beyond_friction)
         how = "cannot reach the force"
      case (ending%out_of_time)
         how = "reached the time limit"
      case default
         how = "diverged"
      end select
      text = name // ", " // trim(report%method) // " " // how
      if (report%residual < 0.0_wp) return
      numbers(1) = size_text(report%residual, 1)
      numbers(2) = size_text(report%tolerance, 1)
      text = trim(text) // ": relative residual " // trim(numbers(1)) // ", tolerance " // trim(numbers(2))
   end function failure_text

   !> A number with any exponent, such as "1.6E-07"
   pure function size_text(value, decimals) result(text)
      !> Any number; if not finite, its name is given
      real(wp), intent(in) :: value
      !> Number of decimals, 1 or 2
      integer, intent(in) :: decimals
      character(len=11) :: text
      character(len=10) :: form
      logical :: is_long

      is_long = abs(value) >= 1.0e99_wp .or. (abs(value) < 1.0e-98_wp .and. abs(value) > 0.0_wp)
      write(form, '("(ES11.", I0, "E", I0, ")")') decimals, merge(3, 2, is_long)
      write(text, form) value
      text = adjustl(text)
   end function size_text
end module contact_base_solve_report
