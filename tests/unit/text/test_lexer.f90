!> Words, groups and their errors
program test_lexer
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_test_harness, only : test_suite
   use contact_text_lexer, only : input_lexer, input_value
   use contact_text_words, only : integer_text, real_text, to_angle, to_integer, to_real, word_state
   implicit none (type, external)
   character, parameter :: nl = achar(10), cr = achar(13), tab = achar(9)
   type(test_suite) :: suite

   call suite%start("lexer")
   call integers(suite)
   call reals(suite)
   call angles(suite)
   call numbers_as_text(suite)
   call groups(suite)
   call optional_values(suite)
   call texts(suite)
   call arrays(suite)
   call messages(suite)
   call files(suite)
   call suite%finish()

contains

   !> Integers
   subroutine integers(suite)
      type(test_suite), intent(inout) :: suite

      call is_integer(suite, "12", 12)
      call is_integer(suite, "-7", -7)
      call is_integer(suite, "+0012", 12)
      call is_integer(suite, "2147483647", huge(1))
      call is_no_integer(suite, "5.", word_state%malformed)
      call is_no_integer(suite, "1e2", word_state%malformed)
      call is_no_integer(suite, "-", word_state%malformed)
      call is_no_integer(suite, "", word_state%malformed)
      call is_no_integer(suite, "1-", word_state%malformed)
      call is_no_integer(suite, "2147483648", word_state%too_large)
      call is_no_integer(suite, "99999999999999999999999999999", word_state%too_large)
   end subroutine integers

   subroutine is_integer(suite, word, expected)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: word
      integer, intent(in) :: expected
      integer :: value, state

      call to_integer(word, value, state)
      call suite%check(state == word_state%good .and. value == expected, "integer " // word)
   end subroutine is_integer

   subroutine is_no_integer(suite, word, expected)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: word
      integer, intent(in) :: expected
      integer :: value, state

      call to_integer(word, value, state)
      call suite%check(state == expected .and. value == 0, "no integer: " // word)
   end subroutine is_no_integer

   !> Real numbers in all forms
   subroutine reals(suite)
      type(test_suite), intent(inout) :: suite
      character(len=4), parameter :: malformed(*) = ["abc ", "1.2.", "1e  ", "e5  ", ".   ", "+   ", "1,2 ", "3*2 ", &
         & "1e+ ", "1d2x", "0x1f", "--1 ", "1q2 ", "T   "]
      real(wp) :: value
      integer :: k, state

      call is_real(suite, "5", 5.0_wp)
      call is_real(suite, "5.", 5.0_wp)
      call is_real(suite, ".5", 0.5_wp)
      call is_real(suite, "-.5", -0.5_wp)
      call is_real(suite, "+3", 3.0_wp)
      call is_real(suite, "1e-5", 1.0e-5_wp)
      call is_real(suite, "1E-5", 1.0e-5_wp)
      call is_real(suite, "1d-3", 1.0e-3_wp)
      call is_real(suite, "1.5D+2", 150.0_wp)
      call is_real(suite, ".1-07", 1.0e-8_wp)
      call is_real(suite, "1.2+3", 1200.0_wp)
      call is_real(suite, "0.00000000000000000000000000000000000000000000000000125", 1.25e-51_wp)
      call is_real(suite, "0e999999999999999999", 0.0_wp)
      call is_real(suite, "1e-999999999999999999", 0.0_wp)
      call is_real(suite, "1e-400", 0.0_wp)
      call is_real(suite, "123456789012345678901234567890e-29", 1.2345678901234567890_wp)
      do k = 1, size(malformed)
         call to_real(trim(malformed(k)), value, state)
         call suite%check(state == word_state%malformed, "no number: " // malformed(k))
      end do
      call to_real("1e999", value, state)
      call suite%check(state == word_state%too_large, "a number beyond the range")
      call to_real("NaN", value, state)
      call suite%check(state == word_state%not_finite, "NaN is refused")
      call to_real("-Infinity", value, state)
      call suite%check(state == word_state%not_finite, "infinity is refused")
      call rounding(suite)
   end subroutine reals

   !> Every number is rounded as the run-time library rounds it, to the last bit
   subroutine rounding(suite)
      type(test_suite), intent(inout) :: suite
      character(len=*), parameter :: forms(*) = [character(len=12) :: "(es12.5)", "(es22.14e3)", "(es23.15e3)", &
         & "(es25.17e3)", "(f12.4)", "(f18.3)", "(es10.2e3)"]
      character(len=30) :: word
      real(wp) :: value, expected, random(2)
      integer :: k, form, state, wrong, seed_size

      call random_seed(size=seed_size)
      call random_seed(put=[(12345 + k, k = 1, seed_size)])
      wrong = 0
      do k = 1, 20000
         form = 1 + mod(k, size(forms))
         call random_number(random)
         expected = (random(1) - 0.5_wp)*10.0_wp**merge(6.0_wp*random(2), 60.0_wp*(random(2) - 0.5_wp), forms(form)(2:2) == "f")
         write(word, forms(form)) expected
         read(word, "(f30.0)") expected
         call to_real(trim(adjustl(word)), value, state)
         if (state /= word_state%good .or. abs(value - expected) > 0.0_wp) wrong = wrong + 1
      end do
      call suite%check(wrong == 0, "numbers are rounded as the run-time library does")
   end subroutine rounding

   subroutine is_real(suite, word, expected)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: word
      real(wp), intent(in) :: expected
      real(wp) :: value
      integer :: state

      call to_real(word, value, state)
      call suite%check(state == word_state%good, "a number: " // word)
      call suite%close_to(value, expected, 4.0_wp*epsilon(1.0_wp)*abs(expected), "value of " // word)
   end subroutine is_real

   !> Angles with and without a letter
   subroutine angles(suite)
      type(test_suite), intent(inout) :: suite

      call is_angle(suite, "90d", 0.5_wp*pi)
      call is_angle(suite, "180.d", pi)
      call is_angle(suite, "-45D", -0.25_wp*pi)
      call is_angle(suite, "1.5r", 1.5_wp)
      call is_angle(suite, "1.5R", 1.5_wp)
      call is_angle(suite, "0.25", 0.25_wp)
      call is_angle(suite, "90d0", 90.0_wp)
   end subroutine angles

   subroutine is_angle(suite, word, expected)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: word
      real(wp), intent(in) :: expected
      real(wp) :: value
      integer :: state

      call to_angle(word, value, state)
      call suite%check(state == word_state%good, "an angle: " // word)
      call suite%close_to(value, expected, 4.0_wp*epsilon(1.0_wp)*abs(expected), "value of angle " // word)
   end subroutine is_angle

   !> Numbers in messages
   subroutine numbers_as_text(suite)
      type(test_suite), intent(inout) :: suite

      call suite%check(integer_text(-12) == "-12", "integer in words")
      call suite%check(real_text(0.0_wp) == "0", "zero in words")
      call suite%check(real_text(100.0_wp) == "100", "a whole number in words")
      call suite%check(real_text(-0.25_wp) == "-0.25", "a fraction in words")
      call suite%check(real_text(1.0e-8_wp) == "1.00000E-08", "a small number in words")
   end subroutine numbers_as_text

   !> Lines, separators, comments
   subroutine groups(suite)
      type(test_suite), intent(inout) :: suite

      call reads(suite, "1 2 3.5", "on one line")
      call reads(suite, "1" // nl // "2" // nl // nl // "3.5", "spread over lines")
      call reads(suite, "1" // tab // "2" // tab // "3.5", "tabs")
      call reads(suite, "1,2,3.5", "commas")
      call reads(suite, "%" // nl // "  % comment 9 9 9" // cr // nl // "1 2%3" // cr // nl // "3.5 text", "comments, CR-LF")
      call reads(suite, "1=2 = 3.5", "equals signs")
      call reads(suite, "1 2" // repeat(" ", 5000) // "3.5", "a long line")
      call reads(suite, "1 2 3.5 9 9 9", "surplus words are ignored")
      call reads(suite, char(239) // char(187) // char(191) // "1 2 3.5", "byte order mark")
   end subroutine groups

   !> Three values, then a group on the next line that must not see leftovers
   subroutine reads(suite, text, what)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: text, what
      type(input_lexer) :: lexer
      type(input_value) :: v(3)
      type(error_type), allocatable :: error

      call lexer%open_text(text // nl // "77", "test")
      call lexer%read_group("iir", "A B C", v, error)
      call suite%check(.not. allocated(error), what)
      if (allocated(error)) return
      call suite%check(v(1)%i == 1 .and. v(2)%i == 2 .and. v(3)%r == 3.5_wp, what // ", values")
      call suite%check(.not. lexer%at_end(), what // ", more to come")
      call lexer%read_group("i", "D", v, error)
      call suite%check(.not. allocated(error), what // ", next group")
      if (.not. allocated(error)) call suite%check(v(1)%i == 77, what // ", value of the next group")
      call suite%check(lexer%at_end(), what // ", the end")
   end subroutine reads

   !> Optional values: only on the line of the last mandatory one, until a word does not parse
   subroutine optional_values(suite)
      type(test_suite), intent(inout) :: suite

      call counts(suite, "1 2 3 4", 4, "all given")
      call counts(suite, "1 2 3", 3, "one missing")
      call counts(suite, "1 2", 2, "both missing")
      call counts(suite, "1" // nl // "2 3" // nl // "4", 3, "not from the next line")
      call counts(suite, "1 2 text 3", 2, "a word that is not a number ends the group")
      call counts(suite, "1 2 3.5 4", 2, "a number of the wrong type too")
      call counts(suite, "1 2 % 3", 2, "a comment too")
   end subroutine optional_values

   subroutine counts(suite, text, expected, what)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: text, what
      integer, intent(in) :: expected
      type(input_lexer) :: lexer
      type(input_value) :: v(4)
      type(error_type), allocatable :: error

      call lexer%open_text(text, "test")
      call lexer%read_group("irIR", "A B C D", v, error)
      call suite%check(.not. allocated(error), what)
      call suite%check(count(v%given) == expected, what // ", number of values")
   end subroutine counts

   !> Quoted texts
   subroutine texts(suite)
      type(test_suite), intent(inout) :: suite

      call is_text(suite, "'file.txt'", "file.txt")
      call is_text(suite, "'a b, c=d % e' rest", "a b, c=d % e")
      call is_text(suite, "''", "")
      call is_text(suite, "'c:\x\y'", "c:\x\y")
      call is_text(suite, "'a''b' rest", "a'b")
      call is_text(suite, "'''a''''b'''", "'a''b'")
      call is_text(suite, "''''", "'")
      call is_text(suite, "'' 'b'", "")
      call fails(suite, "file.txt", "s", "NAME", "in single quotes", 1)
      call fails(suite, "'file.txt", "s", "NAME", "second quote is missing", 1)
      call fails(suite, "'a''", "s", "NAME", "second quote is missing", 1)
      call fails(suite, "'''", "s", "NAME", "second quote is missing", 1)
      call fails(suite, '"file.txt"', "s", "NAME", "in single quotes", 1)
      call fails(suite, "'5'", "i", "N", "is not an integer", 1)
   end subroutine texts

   subroutine is_text(suite, text, expected)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: text, expected
      type(input_lexer) :: lexer
      type(input_value) :: v(1)
      type(error_type), allocatable :: error

      call lexer%open_text(text, "test")
      call lexer%read_group("s", "NAME", v, error)
      call suite%check(.not. allocated(error), "a text: " // text)
      if (.not. allocated(error)) call suite%check(v(1)%s == expected .and. len(v(1)%s) == len(expected), "text " // expected)
   end subroutine is_text

   !> Arrays
   subroutine arrays(suite)
      type(test_suite), intent(inout) :: suite
      type(input_lexer) :: lexer
      type(error_type), allocatable :: error
      real(wp), allocatable :: list(:)
      character(len=:), allocatable :: text
      integer :: k, line

      text = ""
      do k = 1, 2500
         text = text // integer_text(k) // merge(nl, " ", mod(k, 7) == 0)
      end do
      call lexer%open_text(nl // text // " 99 rest", "test")
      call lexer%read_array(2500, "H", list, error, line=line)
      call suite%check(.not. allocated(error), "a long array")
      if (.not. allocated(error)) then
         call suite%check(size(list) == 2500 .and. line == 2, "its length and line")
         call suite%close_to(sum(list), 2500.0_wp*2501.0_wp/2.0_wp, 0.0_wp, "its sum")
         call suite%check(lexer%at_end(), "the rest of the last line is ignored")
      end if
      call lexer%open_text("180d 1", "test")
      call lexer%read_array(2, "Y", list, error, angles=.true.)
      call suite%check(.not. allocated(error), "an array of angles")
      if (.not. allocated(error)) call suite%close_to(list, [pi, 1.0_wp], 1.0e-15_wp, "angles")
      call lexer%read_array(0, "Y", list, error)
      call suite%check(.not. allocated(error) .and. size(list) == 0, "an empty array reads nothing")
      call lexer%open_text("1 2" // nl // "x", "test")
      call lexer%read_array(3, "H", list, error)
      call suite%check(allocated(error), "no number in an array")
      if (allocated(error)) call suite%check(index(full_text(error), "test:2:1: ""x"" is not a number; expected H(3)") == 1, &
         & "which element, which line")
      call lexer%open_text("1 2", "test")
      call lexer%read_array(2000000000, "H", list, error)
      call suite%check(allocated(error), "an array that is much longer than the file")
   end subroutine arrays

   !> Texts and positions of errors
   subroutine messages(suite)
      type(test_suite), intent(inout) :: suite

      call fails(suite, "1 abc", "ii", "MX MY", """abc"" is not an integer; expected MY, an integer, value 2 of the group MX MY", 3)
      call fails(suite, "1 5.", "ii", "MX MY", """5."" is not an integer", 3)
      call fails(suite, "  1e", "r", "DX", "is not a number", 3)
      call fails(suite, "NaN", "r", "DX", "is not a finite number", 1)
      call fails(suite, "1e400", "r", "DX", "is too large", 1)
      call fails(suite, "5x", "a", "CHI", "is not an angle", 1)
      call fails(suite, "1 abc", "ii", "MX MY", "the line reads ""1 abc""", 3)
      call fails(suite, "1", "ii", "MX MY", "the end of the file is reached; expected MY, an integer, in the group MX MY", 0)
      call fails(suite, "", "i", "MODULE", "the end of the file is reached", 0)
   end subroutine messages

   subroutine fails(suite, text, types, names, phrase, column)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: text, types, names, phrase
      integer, intent(in) :: column
      type(input_lexer) :: lexer
      type(input_value) :: v(4)
      type(error_type), allocatable :: error

      call lexer%open_text(text, "test")
      call lexer%read_group(types, names, v, error)
      call suite%check(allocated(error), "refused: " // text)
      if (.not. allocated(error)) return
      call suite%check(index(error%message, phrase) > 0, "words for " // text // ": " // error%message)
      call suite%check(error%column == column .and. error%line == 1 .and. error%file == "test", "place of " // text)
   end subroutine fails

   !> Files on the disk
   subroutine files(suite)
      type(test_suite), intent(inout) :: suite
      type(input_lexer) :: lexer
      type(input_value) :: v(2)
      type(error_type), allocatable :: error
      character(len=6), parameter :: wide(4) = [character(len=6) :: char(255) // char(254) // "1" // char(0), &
         & char(254) // char(255) // char(0) // "1", "1" // char(0) // "2" // char(0), char(0) // "1" // char(0) // "2"]
      integer :: k, unit

      open(newunit=unit, file="test_lexer.inp", access="stream", form="unformatted", status="replace")
      write(unit) "1" // cr // nl // "2.5" // cr // nl
      close(unit)
      call lexer%open_file("test_lexer.inp", error)
      call suite%check(.not. allocated(error), "a file")
      if (.not. allocated(error)) then
         call lexer%read_group("ir", "A B", v, error)
         call suite%check(.not. allocated(error) .and. v(1)%i == 1 .and. v(2)%r == 2.5_wp, "its values")
      end if
      ! other line ends, and two bytes per letter
      call lexer%open_text("1" // cr // "2.5" // cr // "3", "mac")
      call lexer%read_group("ir", "A B", v, error)
      call suite%check(.not. allocated(error) .and. v(2)%r == 2.5_wp .and. v(2)%line == 2, "lines that end with CR")
      call suite%equal(lexer%count_lines(), 3, "their number")
      do k = 1, size(wide)
         open(newunit=unit, file="test_lexer.inp", access="stream", form="unformatted", status="replace")
         write(unit) trim(wide(k))
         close(unit)
         call lexer%open_file("test_lexer.inp", error)
         call suite%check(allocated(error), "UTF-16 is refused")
         if (allocated(error)) call suite%check(index(full_text(error), "UTF-16") > 0, "by its name")
      end do
      open(newunit=unit, file="test_lexer.inp", status="replace")
      close(unit)
      call lexer%open_file("test_lexer.inp", error)
      call suite%check(.not. allocated(error), "an empty file")
      call suite%check(lexer%at_end(), "an empty file has no words")
      open(newunit=unit, file="test_lexer.inp", status="old")
      close(unit, status="delete")
      call lexer%open_file("no/such/file.inp", error)
      call suite%check(allocated(error), "a file that is not there")
      call lexer%open_file(".", error)
      call suite%check(allocated(error), "a folder")
   end subroutine files
end program test_lexer
