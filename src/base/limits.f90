!> Limits of a case: time, memory, number of elements; and the clock
!>
!> Without limits nothing is checked: the clock is read only if there is a deadline.
module contact_base_limits
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : long, wp
   use contact_base_memory, only : megabytes_text
   use contact_base_output_file, only : output_budget
   implicit none (type, external)
   private

   public :: case_limits, deadline_type, fill_limits, wall_clock

   !> Default limits of a confined run: time of a case and of the run [s], memory of a case and total size of all files [bytes],
   !> number of elements
   real(wp), parameter :: confined_seconds = 600.0_wp, confined_run_seconds = 3600.0_wp
   integer(long), parameter :: confined_bytes = 4000000000_long, confined_output = 1000000000_long, confined_elements = 1000000_long

   !> Deadline of a case or a run
   type :: deadline_type
      !> Time allowed [s]; huge: unlimited
      real(wp) :: seconds = huge(1.0_wp)
      !> Time of the deadline by wall_clock [s]; huge: never
      real(wp), private :: at = huge(1.0_wp)
   contains
      !> Start the allowed time
      procedure :: start
      !> Remaining time [s]; huge: unlimited
      procedure :: left
      !> Has the deadline passed?
      procedure :: has_passed
      !> Give an error if the deadline has passed
      procedure :: check => check_deadline
   end type deadline_type

   !> Limits of a case
   type :: case_limits
      type(deadline_type) :: deadline
      !> Memory, as estimated by contact_base_memory [bytes]
      integer(long) :: bytes = huge(1_long)
      !> Number of elements of the potential contact area, in wheel-rail contact of each patch
      integer(long) :: elements = huge(1_long)
      !> Total size of all files of the run; null: unlimited
      type(output_budget), pointer :: output => null()
      !> Restrict reading and writing to regular files below the folder of the experiment?
      logical :: confined = .false.
   contains
      !> Refuse more elements or memory than allowed
      procedure :: check
   end type case_limits

contains

   !> Apply the limits of a confined run if none are set
   pure subroutine fill_limits(limits, run_seconds, output_bytes)
      !> Limits of a case; those already set are kept
      type(case_limits), intent(inout) :: limits
      !> Time limit of the run [s]; huge: unlimited
      real(wp), intent(inout) :: run_seconds
      !> Total size of all files of the run [bytes]; huge: unlimited
      integer(long), intent(inout) :: output_bytes

      if (limits%deadline%seconds >= huge(1.0_wp)) limits%deadline%seconds = confined_seconds
      if (limits%bytes >= huge(1_long)) limits%bytes = confined_bytes
      if (limits%elements >= huge(1_long)) limits%elements = confined_elements
      if (run_seconds >= huge(1.0_wp)) run_seconds = confined_run_seconds
      if (output_bytes >= huge(1_long)) output_bytes = confined_output
   end subroutine fill_limits

   !> Elapsed time since a fixed instant [s]
   real(wp) function wall_clock() result(seconds)
      integer(long) :: ticks, rate

      call system_clock(ticks, rate)
      seconds = real(ticks, wp)/real(rate, wp)
   end function wall_clock

   subroutine start(self)
      class(deadline_type), intent(inout) :: self

      self%at = huge(1.0_wp)
      if (self%seconds < huge(1.0_wp)) self%at = wall_clock() + self%seconds
   end subroutine start

   real(wp) function left(self) result(seconds)
      class(deadline_type), intent(in) :: self

      seconds = huge(1.0_wp)
      if (self%at < huge(1.0_wp)) seconds = self%at - wall_clock()
   end function left

   logical function has_passed(self) result(passed)
      class(deadline_type), intent(in) :: self

      passed = .false.
      if (self%at < huge(1.0_wp)) passed = wall_clock() > self%at
   end function has_passed

   subroutine check_deadline(self, where, error)
      class(deadline_type), intent(in) :: self
      !> Stage of the computation, such as "in the normal problem"
      character(len=*), intent(in) :: where
      !> Allocated if the deadline has passed
      type(error_type), allocatable, intent(out) :: error
      character(len=24) :: text

      if (.not. self%has_passed()) return
      write(text, "(G0.4)") self%seconds
      call fatal_error(error, "the time limit of " // trim(text) // " s was reached " // where, error_kind%time)
   end subroutine check_deadline

   subroutine check(self, number, bytes_each, what, error)
      class(case_limits), intent(in) :: self
      !> Number of elements or points, and memory per item [bytes]
      integer(long), intent(in) :: number, bytes_each
      !> Name of the items: only "elements" are limited in number, all are limited in memory
      character(len=*), intent(in) :: what
      !> Allocated if a limit or the memory of the system is exceeded
      type(error_type), allocatable, intent(out) :: error
      character(len=160) :: text

      if (what == "elements" .and. number > self%elements) then
         write(text, "(I0, 3A, I0)") number, " ", what, " are more than the limit of ", self%elements
      else if (number > self%bytes/bytes_each) then
         write(text, "(I0, 6A)") number, " ", what, " need about ", &
            & trim(megabytes_text(number*bytes_each)), " of memory, more than the limit of ", trim(megabytes_text(self%bytes))
      else
         return
      end if
      call fatal_error(error, trim(text), error_kind%limit)
   end subroutine check
end module contact_base_limits
