!> Truncated and mutated input: an error or a case, never a crash
program test_hostile_input
   use, intrinsic :: iso_fortran_env, only : int64
   use contact_base_error, only : error_type, full_text
   use contact_input_experiment_file, only : experiment_reader, input_case
   use contact_input_problems, only : problem_text
   use contact_test_harness, only : environment, test_suite
   implicit none (type, external)
   character, parameter :: nl = achar(10)
   !> Number of mutated files
   integer, parameter :: mutations = 20000
   !> An input that reads every kind of group, five cases
   character(len=40), parameter :: valid_lines(*) = [character(len=40) :: &
      & "3 2 1  MODULE, a case with most groups", "203103", "0422029 2", "10200000", "1000000 0", &
      & "100 100 30 1 1e-5 20000", "0.9 1.0 0 0.5", "1000. 0.001 0 .1-03 1 2", "0.2 0.1 1. 0 0", ".001 10", &
      & "180d 0.1 1000. 0.2", "0.28,0.28,82000 82000", "0 0 0 0", "1", "2 2 -0.5 -0.4 0.1 0.1", &
      & "2 3", "3 0 1 0 .1", "1 2 3", "0 1 0 1 0 1 0 1", "1 2 3 4 5 6 7 8", &
      & "1 2", "1", "2 0 1", "2", "1 1 2", "1 1 2", "1 0 1", "7", "2 1", "2 1", "1", "2", "0 1", "9", "1 1 1", "0", "0", ".5", &
      & "0", &
      & "% the next one stays in the module", "203100", "029420", "3400001", &
      & "10 10 10 10 1e-4", "1 .5", "1 0 0 0", ".3 .3", "0 1 1", "'file, name'", ".3 .4 1 2", "1 0 0 0", &
      & "0 1 1 1", "0 1 1 1", ".5", "1", "3 3 0 0 1 1", "9 4", "1 2 3", "4 5 6 7 8 9", "2", "0 1 0 1 0 1 0 1", ".5", &
      & "3", "203100", "3622320", "1500001", "9 9 9 1 1e-5", ".9 .1 1 1 1 1 1 1", "1 0 0 0", "0 1 1", ".3 .3 1 1", "1 1 1", &
      & "2", "2 2 0 0 1 1", "3 2", "1 2 3 4 5 6 7 8", "1 2 3 4 5 6", ".3 0 -.1 99", ".3 0 -.1 99", "0 0", &
      & "3 4", "200100", "024020", "1", "9 9 9 10 1e-5", "1 0 0 0", ".3 .3", "0 1 2", "0 0d 1 10d", ".3 .3 1 1", &
      & "-3", "3 3 1 1 1", &
      & "3 4", "201120", "100000", "100001", "1 .1 .1 0", "0"]
   type(test_suite) :: suite
   character(len=:), allocatable :: valid
   logical :: complete
   integer :: cases, k

   call suite%start("hostile input")
   valid = ""
   do k = 1, size(valid_lines)
      valid = valid // trim(valid_lines(k)) // nl
   end do
   call read_all(valid, cases, complete)
   call suite%equal(cases, 5, "cases of the valid input")
   call suite%check(complete, "the input is valid")
   call prefixes(suite, valid)
   call mutated(suite, valid)
   call extremes(suite, valid)
   deallocate(valid)
   call suite%finish()

contains

   !> Read until the end or an error, and produce all messages
   subroutine read_all(text, cases, complete)
      character(len=*), intent(in) :: text
      !> Number of cases that were read
      integer, intent(out) :: cases
      !> Was the end of the input reached without an error?
      logical, intent(out) :: complete
      type(experiment_reader) :: reader
      type(input_case) :: this
      type(error_type), allocatable :: error, failure
      integer :: k, length

      call reader%open_text(text, "hostile.inp")
      cases = 0
      length = 0
      do
         call reader%next_case(this, error)
         do k = 1, this%problems%count
            length = length + len(problem_text(this%problems%items(k)))
         end do
         if (allocated(error)) length = length + len(full_text(error))
         if (allocated(error) .or. this%module_number == 0) exit
         cases = cases + 1
         call this%problems%first_failure(failure)
         if (allocated(failure)) length = length + len(full_text(failure))
      end do
      complete = .not. allocated(error) .and. length >= 0
   end subroutine read_all

   !> The input truncated after each of its characters
   subroutine prefixes(suite, valid)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: valid
      logical :: complete
      integer :: cases, k, wrong

      wrong = 0
      do k = 0, len(valid) - 2
         call read_all(valid(:k), cases, complete)
         if (complete .or. cases > 5) wrong = wrong + 1
      end do
      call suite%equal(wrong, 0, "every prefix ends in an error")
   end subroutine prefixes

   !> Bytes replaced, words exchanged, pieces removed and doubled
   subroutine mutated(suite, valid)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: valid
      character(len=*), parameter :: words(*) = [character(len=12) :: "NaN", "-1", "0", "9999999999", "1e999", "-1e-999", "'", &
         & "%", nl, "2147483647", "-2147483648", "1e30", "abc", "3", "1,,,1", "''", "1d", ".", "999999", "-6"]
      character(len=:), allocatable :: text, given
      integer(int64) :: seed, state
      logical :: complete
      integer :: cases, change, first, k, last, total

      seed = 20240917_int64
      given = environment("CONTACT_TEST_SEED")
      if (len(given) > 0) read(given, *) seed
      write(*, "(a, i0)") "seed (CONTACT_TEST_SEED): ", seed
      state = max(1_int64, modulo(seed, 2147483646_int64))
      total = 0
      do k = 1, mutations
         text = valid
         do change = 1, random(state, 4)
            first = random(state, len(text))
            last = min(len(text), first + random(state, 12) - 1)
            select case (random(state, 5))
            case (1)
               text(first:first) = char(random(state, 256) - 1)
            case (2)
               text = text(:first - 1) // " " // trim(words(random(state, size(words)))) // " " // text(last + 1:)
            case (3)
               text = text(:first - 1) // text(last + 1:)
            case (4)
               text = text(:last) // text(first:)
            case (5)
               text = text(:first) // achar(iachar("0") + random(state, 10) - 1) // text(first + 1:)
            end select
            if (len(text) == 0) text = valid
         end do
         call read_all(text, cases, complete)
         total = total + cases
      end do
      call suite%check(total > 0, "mutated input is read to its end or refused")
   end subroutine mutated

   !> A number from 1 to n, by the generator of Park and Miller (1988)
   integer function random(state, n) result(number)
      !> State of the generator
      integer(int64), intent(inout) :: state
      integer, intent(in) :: n

      state = modulo(16807_int64*state, 2147483647_int64)
      number = 1 + int(modulo(state, int(n, int64)))
   end function random

   !> Inputs that no editor writes
   subroutine extremes(suite, valid)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: valid
      logical :: complete
      integer :: cases, k
      character(len=256) :: bytes

      do k = 1, 256
         bytes(k:k) = char(k - 1)
      end do
      call read_all(repeat(bytes, 100), cases, complete)
      call suite%check(.not. complete, "all bytes")
      call read_all(repeat("9", 1000000), cases, complete)
      call suite%check(.not. complete, "a very long number")
      call read_all(repeat(nl, 100000) // "0", cases, complete)
      call suite%check(complete, "many empty lines")
      call read_all("0" // repeat(" x", 500000), cases, complete)
      call suite%check(complete, "a very long line")
      call read_all(repeat("'", 10001), cases, complete)
      call suite%check(.not. complete, "only quotes")
      call read_all(repeat(valid(:len(valid) - 2), 40) // "0", cases, complete)
      call suite%check(complete .and. cases == 200, "many cases")
   end subroutine extremes
end program test_hostile_input
