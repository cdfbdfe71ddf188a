!> The test harness: named suites that count, print failures at once and set the exit status
!>
!>     type(test_suite) :: suite
!>     call suite%start("small systems")
!>     call suite%check(converged, "the solver converges")
!>     call suite%close_to(x, 2.0_wp, 1e-12_wp, "root of x**2 - 4")
!>     call suite%finish()
module contact_test_harness
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_is_nan
   use, intrinsic :: iso_fortran_env, only : output_unit
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: test_suite, reference_folder, environment

   !> Exit status shown by ctest as "Skipped"
   integer, parameter :: skip_status = 77

   !> One suite is one program and one entry of ctest
   type :: test_suite
      !> Name in the messages
      character(len=:), allocatable :: name
      !> Counts so far
      integer :: passed = 0, failed = 0, skipped = 0
   contains
      procedure :: start => start_suite
      procedure :: check => check_condition
      procedure, private :: close_scalar
      procedure, private :: close_array
      procedure, private :: close_field
      !> Real numbers, scalar, rank 1 or 2, within a tolerance; NaN is never close
      generic :: close_to => close_scalar, close_array, close_field
      procedure, private :: equal_integer
      procedure, private :: equal_text
      !> Integers or texts, exactly
      generic :: equal => equal_integer, equal_text
      procedure :: skip => skip_part
      procedure :: finish => finish_suite
   end type test_suite

contains

   !> Set the name of the suite and all counts to zero
   subroutine start_suite(self, name)
      class(test_suite), intent(inout) :: self
      character(len=*), intent(in) :: name

      self%name = name
      self%passed = 0
      self%failed = 0
      self%skipped = 0
   end subroutine start_suite

   !> Count one check; a failure is printed at once
   subroutine check_condition(self, condition, what)
      class(test_suite), intent(inout) :: self
      !> Condition to be checked
      logical, intent(in) :: condition
      !> Description of the check
      character(len=*), intent(in) :: what

      call count_check(self, condition, what, "")
   end subroutine check_condition

   !> Check that two numbers agree: |actual - expected| <= tolerance (times |expected| if relative)
   subroutine close_scalar(self, actual, expected, tolerance, what, relative)
      class(test_suite), intent(inout) :: self
      real(wp), intent(in) :: actual, expected
      !> Not negative
      real(wp), intent(in) :: tolerance
      character(len=*), intent(in) :: what
      !> Is the tolerance relative to the expected value? Default no
      logical, intent(in), optional :: relative
      character(len=160) :: values

      write(values, "(3(a, es24.16e3))") "actual", actual, ", expected", expected, &
         & ", tolerance", tolerance
      call count_check(self, is_close(actual, expected, tolerance, relative), what, trim(values))
   end subroutine close_scalar

   !> The same for all elements of two arrays of one shape; a failure shows the first bad element
   subroutine close_array(self, actual, expected, tolerance, what, relative)
      class(test_suite), intent(inout) :: self
      real(wp), intent(in) :: actual(:), expected(:)
      real(wp), intent(in) :: tolerance
      character(len=*), intent(in) :: what
      logical, intent(in), optional :: relative
      character(len=200) :: values
      integer :: i

      if (size(actual) /= size(expected)) then
         write(values, "(2(a, i0))") "size ", size(actual), ", expected size ", size(expected)
         call count_check(self, .false., what, trim(values))
         return
      end if
      do i = 1, size(actual)
         if (is_close(actual(i), expected(i), tolerance, relative)) cycle
         write(values, "(a, i0, 3(a, es24.16e3))") "element ", i, ": actual", actual(i), &
            & ", expected", expected(i), ", tolerance", tolerance
         call count_check(self, .false., what, trim(values))
         return
      end do
      call count_check(self, .true., what, "")
   end subroutine close_array

   !> The same for fields of one shape
   subroutine close_field(self, actual, expected, tolerance, what, relative)
      class(test_suite), intent(inout) :: self
      real(wp), intent(in) :: actual(:, :), expected(:, :)
      real(wp), intent(in) :: tolerance
      character(len=*), intent(in) :: what
      logical, intent(in), optional :: relative

      call self%close_array(reshape(actual, [size(actual)]), reshape(expected, [size(expected)]), tolerance, what, relative)
   end subroutine close_field

   !> Check that two integers are equal
   subroutine equal_integer(self, actual, expected, what)
      class(test_suite), intent(inout) :: self
      integer, intent(in) :: actual, expected
      character(len=*), intent(in) :: what
      character(len=60) :: values

      write(values, "(2(a, i0))") "actual ", actual, ", expected ", expected
      call count_check(self, actual == expected, what, trim(values))
   end subroutine equal_integer

   !> Check that two texts are equal, trailing blanks included
   subroutine equal_text(self, actual, expected, what)
      class(test_suite), intent(inout) :: self
      character(len=*), intent(in) :: actual, expected
      character(len=*), intent(in) :: what
      logical :: same

      same = len(actual) == len(expected)
      if (same) same = actual == expected
      call count_check(self, same, what, &
         & "actual """ // actual // """, expected """ // expected // """")
   end subroutine equal_text

   !> Report that a part cannot run here, with the reason; a suite that only skips is shown as skipped
   subroutine skip_part(self, what, why)
      class(test_suite), intent(inout) :: self
      character(len=*), intent(in) :: what, why

      self%skipped = self%skipped + 1
      write(output_unit, "(5a)") "SKIPPED ", suite_name(self), ": ", what, " - " // why
      flush(output_unit)
   end subroutine skip_part

   !> Print the counts and end the program: status 0 passed, 1 failed or nothing done, 77 skipped
   subroutine finish_suite(self)
      class(test_suite), intent(in) :: self

      write(output_unit, "(2a, 3(i0, a))") suite_name(self), ": ", self%passed, " passed, ", &
         & self%failed, " failed, ", self%skipped, " skipped"
      flush(output_unit)
      if (self%failed > 0) stop 1, quiet=.true.
      if (self%passed > 0) return
      if (self%skipped > 0) stop skip_status, quiet=.true.
      write(output_unit, "(a)") "FAILED: nothing was checked"
      stop 1, quiet=.true.
   end subroutine finish_suite

   !> Folder of the reference data, without a slash at its end; empty if it is missing
   function reference_folder() result(folder)
      character(len=:), allocatable :: folder
      logical :: there

      folder = environment("CONTACT_REFERENCE")
      if (len(folder) == 0) return
      inquire(file=folder // "/ORIGIN.md", exist=there)
      if (.not. there) folder = ""
   end function reference_folder

   !> Value of an environment variable, empty if it is not set.
   !> Set by ctest: CONTACT_REFERENCE, CONTACT_SOURCE (top of the checkout), CONTACT_PROGRAM
   function environment(name) result(value)
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: value
      integer :: length, status

      call get_environment_variable(name, length=length, status=status)
      if (status /= 0) length = 0
      allocate(character(len=length) :: value)
      if (length > 0) call get_environment_variable(name, value)
   end function environment

   !> Do two numbers agree? NaN agrees with nothing, an infinity with itself.
   !> NaN is excluded first because a comparison with it traps in debug builds.
   pure function is_close(actual, expected, tolerance, relative) result(is_near)
      real(wp), intent(in) :: actual, expected, tolerance
      logical, intent(in), optional :: relative
      logical :: is_near
      real(wp) :: allowed

      is_near = .false.
      if (ieee_is_nan(actual) .or. ieee_is_nan(expected) .or. ieee_is_nan(tolerance)) return
      is_near = actual == expected
      if (is_near .or. .not. (ieee_is_finite(actual) .and. ieee_is_finite(expected))) return
      allowed = tolerance
      if (present(relative)) then
         if (relative) allowed = tolerance * abs(expected)
      end if
      ! halved, so that the difference of two huge numbers does not overflow
      is_near = abs(0.5_wp * actual - 0.5_wp * expected) <= 0.5_wp * allowed
   end function is_close

   !> Count one check and print it if it failed
   subroutine count_check(self, passed, what, values)
      class(test_suite), intent(inout) :: self
      logical, intent(in) :: passed
      character(len=*), intent(in) :: what, values

      if (passed) then
         self%passed = self%passed + 1
         return
      end if
      self%failed = self%failed + 1
      write(output_unit, "(4a)") "FAILED ", suite_name(self), ": ", what
      if (len(values) > 0) write(output_unit, "(2a)") "       ", values
      flush(output_unit)
   end subroutine count_check

   !> Name of the suite, also when it was never started
   pure function suite_name(self) result(name)
      class(test_suite), intent(in) :: self
      character(len=:), allocatable :: name

      name = "unnamed suite"
      if (allocated(self%name)) name = self%name
   end function suite_name
end module contact_test_harness
