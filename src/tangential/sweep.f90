!> Stopping criteria of Gauss-Seidel sweeps, and their trace
module contact_tangential_sweep
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_kinds, only : wp
   use contact_base_limits, only : deadline_type
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending
   use contact_grid_element_division, only : element
   implicit none (type, external)
   private

   public :: update_watch, trace_iteration

   ! as in CONTACT (Vollebregt)
   !> Minimum size of the tractions for the stopping criterion [N/mm2], or relative to a maximum bound below 1 N/mm2
   real(wp), parameter :: min_size = 1.0e-6_wp
   !> Average ratio of updates above which reaching the iteration limit is regarded as stagnation
   real(wp), parameter :: stagnating_rate = 0.997_wp

   !> Monitors the size of the updates of an iteration
   type :: update_watch
      !> Tolerance relative to the tractions
      real(wp) :: eps = 1.0e-6_wp
      !> Number of elements in contact and largest traction bound [N/mm2]
      integer :: n_contact = 0
      real(wp) :: largest_bound = 0.0_wp
      !> First and last size of an update, size of the tractions [N/mm2], root mean squares
      real(wp) :: first = 0.0_wp, dif = 0.0_wp, size = 0.0_wp
      !> Deadline of the case
      type(deadline_type) :: deadline
      !> Number of updates so far
      integer :: updates = 0
   contains
      !> Process an update, and decide whether and how the iteration ends
      procedure :: check_update
      !> Average ratio of successive updates
      procedure :: rate
      !> Root mean square over the contact area
      procedure :: mean
   end type update_watch

contains

   !> Process an update; gives ending%not_started while the iteration continues
   subroutine check_update(self, square_dif, square_size, limit, ended)
      class(update_watch), intent(inout) :: self
      !> Sums of squares of the update and of the tractions
      real(wp), intent(in) :: square_dif, square_size
      !> Maximum number of updates
      integer, intent(in) :: limit
      !> Member of ending
      integer, intent(out) :: ended

      ended = ending%diverged
      if (.not. (ieee_is_finite(square_dif) .and. ieee_is_finite(square_size))) return
      self%updates = self%updates + 1
      self%dif = self%mean(square_dif)
      self%size = self%mean(square_size)
      if (self%updates == 1) self%first = self%dif
      if (self%dif <= self%eps*max(min_size*min(1.0_wp, self%largest_bound), self%size)) then
         ended = ending%converged
      else if (self%updates >= limit) then
         ended = ending%iteration_limit
         if (self%rate() > stagnating_rate) ended = ending%stagnated
         if (self%rate() > 1.0_wp) ended = ending%diverged
      else if (self%deadline%has_passed()) then
         ended = ending%out_of_time
      else
         ended = ending%not_started
      end if
   end subroutine check_update

   !> Root mean square over the contact area
   pure real(wp) function mean(self, squares)
      class(update_watch), intent(in) :: self
      !> Sum of squares over elements and both directions
      real(wp), intent(in) :: squares
      mean = sqrt(squares/(2*max(1, self%n_contact)))
   end function mean

   !> Average ratio of successive updates [-]
   pure real(wp) function rate(self)
      class(update_watch), intent(in) :: self
      rate = 0.0_wp
      if (self%updates > 1 .and. self%first > 0.0_wp) rate = (self%dif/self%first)**(1.0_wp/(self%updates - 1))
   end function rate

   !> Write a line per iteration at flow-trace level 5
   subroutine trace_iteration(log, watch, method, state)
      !> Receives the line
      type(log_type), intent(inout) :: log
      !> Number of the iteration, size of the update
      type(update_watch), intent(in) :: watch
      !> Name of the method, at the start of the line
      character(len=*), intent(in) :: method
      !> Element states
      integer, intent(in) :: state(:, :)
      character(len=120) :: text

      if (.not. log%shows(5)) return
      write(text, "(I6, 3A, 2ES12.4, A, 2I7)") watch%updates, ", ", method, ": |Pk-Pk-1|, Eps |Pk|:", &
         & watch%dif, watch%eps*watch%size, ", A, S=", count(state == element%adhesion), count(state == element%slip)
      call log%trace(5, trim(text))
   end subroutine trace_iteration
end module contact_tangential_sweep
