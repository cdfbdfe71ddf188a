!> Warnings: each one once a case, and how often; equal but for numbers with a point is equal
program test_log
   use contact_base_log, only : log_type
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("log")
   call warnings(suite)
   call held_back(suite)
   call suite%finish()

contains

   !> Which warnings are regarded as the same
   subroutine warnings(suite)
      type(test_suite), intent(inout) :: suite
      type(log_type) :: log
      character(len=:), allocatable :: lines

      call begin(log)
      call log%warning("the force of 12.5 N is not met")
      call log%warning("the force of 3.25 N is not met")
      call log%warning("the force of -1.0E-05 N is not met")
      call suite%check(log%warnings == 1 .and. log%occurrences == 3, "numbers with a point make no difference")
      call log%warning("the force of 4 N is not met")
      call log%warning("the force of 5 N is not met")
      call suite%check(log%warnings == 3, "whole numbers do")
      call log%warning("the force of 12.5 N is not met at all")
      call log%warning("the force of 12.5 N is not")
      call log%warning("the force of 12.5 mN is not met")
      call log%warning("a force of 12.5 N is not met")
      call suite%check(log%warnings == 7, "more words, fewer words, other words do")
      call log%warning("")
      call log%warning("")
      call suite%check(log%occurrences == 11, "an empty warning is counted")
      call log%end_case()
      call finish(log, lines)
      call suite%check(index(lines, "times in this case) the force of 12.5 N is not met" // achar(10)) > 0, &
         & "how often, with the first words: " // lines)
      call suite%check(index(lines, "3.25") == 0, "the later ones are not written")
      call suite%check(index(lines, "(1 times") == 0, "a single occurrence is not reported")
      call suite%check(count_of(lines, "4 N is not met") == 1, "a single warning is written once")

      call begin(log)
      call log%warning("first")
      call log%end_case()
      call log%begin_case()
      call log%warning("first")
      call finish(log, lines)
      call suite%check(count_of(lines, " Warning: first") == 2, "a new case repeats the message")
   end subroutine warnings

   !> Warnings of trials
   subroutine held_back(suite)
      type(test_suite), intent(inout) :: suite
      type(log_type) :: log
      character(len=:), allocatable :: lines

      call begin(log)
      call log%hold()
      call log%warning("of a trial that does not count")
      call log%hold()
      call log%warning("of the last trial")
      call log%warning("and a second one")
      call suite%check(log%occurrences == 0, "held back")
      call log%write_held()
      call log%warning("after it")
      call suite%check(log%warnings == 3, "written warnings are counted")
      call finish(log, lines)
      call suite%check(index(lines, "does not count") == 0, "warnings of trials are forgotten")
      call suite%check(index(lines, "of the last trial") < index(lines, "and a second one") .and. &
         & index(lines, "and a second one") < index(lines, "after it") &
         & .and. index(lines, "of the last trial") > 0, "in their order")
      call suite%check(index(lines, new_line("a") // new_line("a")) == 0, "each on a separate line, and nothing between")

      call begin(log)
      log%level = 4
      call log%trace(4, "shown")
      call log%trace(5, "hidden")
      call suite%check(log%shows(4) .and. .not. log%shows(5), "levels")
      call finish(log, lines)
      call suite%check(index(lines, "shown") > 0 .and. index(lines, "hidden") == 0, "lines of levels")
   end subroutine held_back

   !> A log into a file
   subroutine begin(log)
      type(log_type), intent(out) :: log
      character(len=:), allocatable :: reason

      call log%out%open_file("log.txt", reason)
      if (allocated(reason)) error stop "log.txt cannot be written"
   end subroutine begin

   !> Close the file of a log and read it
   subroutine finish(log, lines)
      type(log_type), intent(inout) :: log
      character(len=:), allocatable, intent(out) :: lines
      integer :: unit, length
      logical :: complete

      call log%out%close_file(complete)
      open(newunit=unit, file="log.txt", access="stream", form="unformatted", action="read", status="old")
      inquire(unit, size=length)
      allocate(character(len=length) :: lines)
      read(unit) lines
      close(unit)
   end subroutine finish

   !> Number of occurrences of a text
   pure integer function count_of(text, part) result(n)
      character(len=*), intent(in) :: text, part
      integer :: k

      n = 0
      do k = 1, len(text) - len(part) + 1
         if (text(k:k + len(part) - 1) == part) n = n + 1
      end do
   end function count_of
end program test_log
