!> The table of control digits, decoding and encoding of the control words, and the manual
program test_digits
   use contact_control_digits, only : allowed_text, case_digits, choice_of, decode_words, digit_names, digit_of, digit_row, &
      & digit_table, digit_text, digit_value, is_built, is_known, word_text
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("control digits")
   call round_trip(suite)
   call historic_forms(suite)
   call surplus_digits(suite)
   call questions(suite)
   call manual(suite)
   call readable_words(suite)
   call suite%finish()

contains

   !> Every row of the table through the words and back
   subroutine round_trip(suite)
      type(test_suite), intent(inout) :: suite
      type(case_digits) :: digits
      type(digit_row) :: row
      integer :: k, word1, word2, word3, second, of_module

      do k = 1, size(digit_table)
         row = digit_table(k)
         word1 = 0
         word2 = 0
         word3 = 0
         second = 0
         of_module = merge(3, row%module_number, row%module_number == 0)
         select case (row%name)
         case ("C1"); word1 = row%digit*1000000
         case ("M2"); second = row%digit
         case ("P"); word1 = row%digit*100000
         case ("B"); word1 = row%digit*10000
         case ("T"); word1 = row%digit*1000
         case ("N"); word1 = row%digit*100
         case ("F"); word1 = row%digit*10
         case ("S"); word1 = row%digit
         case ("V"); word2 = row%digit*1000000
         case ("L"); word2 = row%digit*100000
         case ("D"); word2 = row%digit*10000
         case ("C"); word2 = row%digit*1000
         case ("M"); word2 = row%digit*100
         case ("Z"); word2 = row%digit*10
         case ("E"); word2 = row%digit
         case ("X"); word3 = row%digit*10000000
         case ("H"); word3 = row%digit*1000000
         case ("G"); word3 = row%digit*100000
         case ("I"); word3 = row%digit*10000
         case ("A"); word3 = row%digit*1000
         case ("O"); word3 = row%digit*100
         case ("W"); word3 = row%digit*10
         case ("R"); word3 = row%digit
         end select
         call decode_words(word1, word2, word3, of_module, digits, second)
         call suite%check(digit_value(digits, trim(row%name)) == row%digit, "decode " // row%name)
         call compare(suite, digits, [mod(word1, 1000000), word2, mod(word3, 10000000), second], "encode " // row%name)
         call suite%check(is_known(trim(row%name), row%digit, of_module), "is known: " // row%name)
         call suite%check(is_built(trim(row%name), row%digit, of_module) .eqv. row%built, "is built: " // row%name)
         call suite%check(choice_of(trim(row%name), row%digit, of_module) == row%choice, "choice of " // row%name)
         call suite%check(digit_text(trim(row%name), row%digit, of_module) == row%text, "text of " // row%name)
         call suite%check(count(digit_table%name == row%name .and. digit_table%digit == row%digit .and. &
            & (digit_table%module_number == row%module_number .or. digit_table%module_number*row%module_number == 0)) == 1, &
            & "one row for each value of " // row%name)
         call suite%check(any(digit_names == row%name), "the list of names has " // row%name)
      end do
   end subroutine round_trip

   !> Do the digits encode to these words?
   subroutine compare(suite, digits, words, what)
      type(test_suite), intent(inout) :: suite
      type(case_digits), intent(in) :: digits
      !> Words 1, 2, 3 and the second number of word 2
      integer, intent(in) :: words(4)
      character(len=*), intent(in) :: what
      character(len=7) :: text
      integer :: got(3), k

      do k = 1, 3
         text = word_text(digits, k)
         read(text, *) got(k)
      end do
      call suite%check(all(got == words(:3)) .and. 10*digits%gapwgt + digits%m2 == words(4), what)
   end subroutine compare

   !> Words without their leading digits
   subroutine historic_forms(suite)
      type(test_suite), intent(inout) :: suite
      type(case_digits) :: digits

      call decode_words(203100, 42033, 2221, 3, digits)
      call suite%check(digits%v == 0 .and. digits%l == 0 .and. digits%d == 4 .and. digits%c == 2 .and. digits%m == 0 &
         & .and. digits%z == 3 .and. digits%e == 3, "word 2 with six digits")
      call suite%check(digits%x == 0 .and. digits%h == 0 .and. digits%g == 0 .and. digits%i == 0 .and. digits%a == 2 &
         & .and. digits%o == 2 .and. digits%w == 2 .and. digits%r == 1, "word 3 with six digits")
      call suite%check(digits%m2 == 1, "damping is kept when not given")
      call decode_words(203100, 122020, 10001541, 3, digits)
      call suite%check(digits%x == 1 .and. digits%o == 5 .and. digits%w == 4 .and. digits%r == 1, "word 3 with eight digits")
      call decode_words(203100, 42033, 341, 3, digits)
      call suite%check(word_text(digits, 1) == "203100" .and. word_text(digits, 2) == "0042033" .and. &
         & word_text(digits, 3) == "0000341", "words with leading zeros")
   end subroutine historic_forms

   !> Too many digits, and the second number of word 2
   subroutine surplus_digits(suite)
      type(test_suite), intent(inout) :: suite
      type(case_digits) :: digits

      call decode_words(7203100, 0, 0, 3, digits)
      call suite%check(digits%p == 2, "digits to the left of P are ignored")
      call decode_words(0, 12022020, 0, 3, digits)
      call suite%check(digits%v == 12, "digits to the left of V belong to V")
      call decode_words(0, 0, 210000001, 3, digits)
      call suite%check(digits%x == 21, "digits to the left of X belong to X")
      call decode_words(0, 0, 0, 3, digits, 25)
      call suite%check(digits%gapwgt == 2 .and. digits%m2 == 5, "second number: weighting and damping, unknown digits as well")
      call decode_words(0, 0, 0, 3, digits)
      call suite%check(digits%gapwgt == 2 .and. digits%m2 == 1, "the weighting is kept without a second number")
      call decode_words(0, 0, 0, 3, digits, -3)
      call suite%check(digits%m2 == 0, "a negative second number switches damping off")
   end subroutine surplus_digits

   !> Questions about values that do not exist
   subroutine questions(suite)
      type(test_suite), intent(inout) :: suite

      call suite%check(allowed_text("C", 3) == "0, 1, 2, 3, 4, 9", "the allowed values in words")
      call suite%check(.not. is_known("L", 5, 3) .and. .not. is_built("L", 5, 3), "an unknown value")
      call suite%check(.not. is_known("Q", 0, 3), "an unknown digit")
      call suite%check(choice_of("L", 5, 3) == 5, "an unknown value is its own choice")
      call suite%check(digit_text("L", 5, 1) == "unknown", "an unknown value has no meaning")
      call suite%check(is_built("B", 1, 3), "an elastic thin sheet is built")
      call suite%equal(digit_of("B", 1, 3), 1, "digit of a choice")
      call suite%check(allowed_text("B", 1) == "0, 1, 5, 6", "module 1 has different values")
      call suite%check(is_known("D", 7, 1) .and. .not. is_known("D", 7, 3), "a value of module 1 only")
      call suite%equal(digit_of("B", 77, 3), -1, "no digit for an unknown choice")
   end subroutine questions

   !> The manual lists every row with its words: `| P | 0 | text |`, marked if it is not implemented
   subroutine manual(suite)
      type(test_suite), intent(inout) :: suite
      logical :: seen(size(digit_table))
      integer :: k

      seen = .false.
      call look_for_rows(suite, "input.md", digit_table%module_number /= 1, seen)
      call look_for_rows(suite, "wheel_rail.md", digit_table%module_number == 1, seen)
      do k = 1, size(digit_table)
         call suite%check(seen(k), "the manual has the row of " // trim(digit_table(k)%name) // " " // &
            & achar(iachar("0") + digit_table(k)%digit))
      end do
   end subroutine manual

   !> Look for the rows of one page
   subroutine look_for_rows(suite, page, required, seen)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: page
      !> Rows that belong on the page, and those that are there
      logical, intent(in) :: required(:)
      logical, intent(inout) :: seen(:)
      character(len=:), allocatable :: expected
      character(len=300) :: folder, line
      integer :: k, status, unit

      call get_environment_variable("CONTACT_SOURCE", folder, status=status)
      if (status /= 0) folder = "."
      open(newunit=unit, file=trim(folder) // "/doc/user/" // page, status="old", action="read", iostat=status)
      call suite%check(status == 0, "doc/user/" // page // " is there")
      if (status /= 0) return
      do
         read(unit, "(a)", iostat=status) line
         if (status /= 0) exit
         do k = 1, size(digit_table)
            if (.not. required(k)) cycle
            associate (row => digit_table(k))
               expected = "| " // trim(row%name) // " | " // achar(iachar("0") + row%digit) // " | " // trim(row%text)
               if (.not. row%built) expected = expected // " (not implemented)"
               if (line == expected // " |") seen(k) = .true.
            end associate
         end do
      end do
      close(unit)
   end subroutine look_for_rows

   !> A word of the readable format means one value of a digit in each module
   subroutine readable_words(suite)
      type(test_suite), intent(inout) :: suite
      character(len=*), parameter :: letters = "abcdefghijklmnopqrstuvwxyz_"
      integer :: j, k

      do k = 1, size(digit_table)
         associate (row => digit_table(k))
            call suite%check(verify(trim(row%word), letters) == 0, "word of " // row%name)
            if (row%word == "") cycle
            do j = 1, k - 1
               if (digit_table(j)%name /= row%name .or. digit_table(j)%word /= row%word) cycle
               call suite%check(digit_table(j)%module_number /= row%module_number .and. digit_table(j)%module_number /= 0 &
                  & .and. row%module_number /= 0, "one value of " // row%name // " is called " // trim(row%word))
            end do
         end associate
      end do
   end subroutine readable_words
end program test_digits
