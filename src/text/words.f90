!> Conversion of words of an input file to integers, real numbers and angles, and of numbers to text
!>
!> The length of a text returned by a function is an expression of its arguments, here and in all rooms: gfortran keeps the
!> length of a `character(len=:), allocatable` result in a variable that all threads share.
module contact_text_words
   use contact_base_constants, only : pi
   use contact_base_kinds, only : long, wp
   implicit none (type, external)
   private

   public :: word_state, to_integer, to_real, to_angle, columns_of, integer_text, real_text, exact_text, replaced, small, capital

   type :: word_state_list
      integer :: good = 0
      !> The characters do not form a value of this type
      integer :: malformed = 1
      !> The number exceeds the range of the machine
      integer :: too_large = 2
      !> NaN or infinity, written as a word
      integer :: not_finite = 3
   end type word_state_list
   !> Outcome of the conversion of a word
   type(word_state_list), parameter :: word_state = word_state_list()

   character(len=*), parameter :: figures = "0123456789"

contains

   !> Convert an optional sign and digits
   pure subroutine to_integer(word, value, state)
      !> Without blanks
      character(len=*), intent(in) :: word
      !> Result, 0 unless the state is good
      integer, intent(out) :: value
      !> Member of word_state
      integer, intent(out) :: state
      integer(long) :: sum
      integer :: k, first

      value = 0
      state = word_state%malformed
      first = 1
      if (len(word) == 0) return
      if (scan(word(1:1), "+-") == 1) first = 2
      if (first > len(word)) return
      if (verify(word(first:), figures) > 0) return

      state = word_state%too_large
      sum = 0
      do k = first, len(word)
         sum = 10*sum + iachar(word(k:k)) - iachar("0")
         if (sum > huge(value)) return
      end do
      value = int(sum)
      if (word(1:1) == "-") value = -value
      state = word_state%good
   end subroutine to_integer

   !> Convert a real number in any form that Fortran programs write, including `1d-3` and `.1-07`
   !>
   !> The form is checked here: list-directed and formatted reading accept more (`1,5`, `3*2`, blanks as zeros, NaN), and
   !> numbers beyond the range would trap in a debug build.
   pure subroutine to_real(word, value, state)
      !> Without blanks
      character(len=*), intent(in) :: word
      !> Result, 0 unless the state is good
      real(wp), intent(out) :: value
      !> Member of word_state
      integer, intent(out) :: state
      !> Decimal exponents that are always within the range of real numbers
      integer, parameter :: highest = 307, lowest = -307
      character(len=:), allocatable :: number
      character(len=12) :: form
      integer :: mantissa, exponent, leading, exponent_value, first, status
      logical :: is_zero, done

      value = 0.0_wp
      state = word_state%malformed
      if (len(word) == 0) return
      first = 1
      if (scan(word(1:1), "+-") == 1) first = 2
      if (spells_not_finite(word(first:))) then
         state = word_state%not_finite
         return
      end if
      call measure_mantissa(word(first:), mantissa, leading, is_zero)
      if (mantissa == 0) return
      mantissa = first + mantissa - 1

      exponent_value = 0
      if (mantissa < len(word)) then
         exponent = mantissa + 1
         if (scan(word(exponent:exponent), "eEdD") == 1) exponent = exponent + 1
         if (exponent > len(word)) return
         call read_exponent(word(exponent:), exponent_value, status)
         if (status /= word_state%good) return
      end if

      if (is_zero .or. leading + exponent_value < lowest) then
         state = word_state%good
         return
      end if
      if (leading + exponent_value > highest) then
         state = word_state%too_large
         return
      end if
      call round_once(word(first:mantissa), exponent_value, value, done)
      if (done) then
         if (word(1:1) == "-") value = -value
         state = word_state%good
         return
      end if
      number = word(1:mantissa) // "e" // integer_text(exponent_value)
      form = "(F" // integer_text(len(number)) // ".0)"
      read(number, form, iostat=status) value
      if (status /= 0) then
         value = 0.0_wp
         return
      end if
      state = word_state%good
   end subroutine to_real

   !> Value of a number whose digits and power of ten are exact, so that a single operation rounds it correctly (Clinger, How to
   !> read floating point numbers accurately, 1990)
   pure subroutine round_once(mantissa, exponent, value, done)
      !> Digits with at most one decimal point
      character(len=*), intent(in) :: mantissa
      integer, intent(in) :: exponent
      real(wp), intent(out) :: value
      !> False if there are too many digits or the power is too high
      logical, intent(out) :: done
      integer, parameter :: longest = 15, highest = 22
      integer :: k, power
      real(wp), parameter :: powers(0:highest) = [(10.0_wp**k, k = 0, highest)]
      integer(long) :: sum

      value = 0.0_wp
      sum = 0
      power = exponent
      done = len(mantissa) <= longest + 1
      if (.not. done) return
      do k = 1, len(mantissa)
         if (mantissa(k:k) == ".") then
            power = exponent - (len(mantissa) - k)
         else
            sum = 10*sum + iachar(mantissa(k:k)) - iachar("0")
         end if
      end do
      done = sum < 10_long**longest .and. abs(power) <= highest
      if (.not. done) return
      if (power < 0) then
         value = real(sum, wp)/powers(-power)
      else
         value = real(sum, wp)*powers(power)
      end if
   end subroutine round_once

   !> Convert a real number with an optional suffix: `d` or `D` for degrees, `r` or `R` for radians
   pure subroutine to_angle(word, value, state)
      !> Without blanks
      character(len=*), intent(in) :: word
      !> Angle [rad]
      real(wp), intent(out) :: value
      !> Member of word_state
      integer, intent(out) :: state
      integer :: last

      last = len(word)
      value = 0.0_wp
      state = word_state%malformed
      if (last == 0) return
      select case (word(last:last))
      case ("d", "D")
         call to_real(word(:last - 1), value, state)
         value = value*(pi/180.0_wp)
      case ("r", "R")
         call to_real(word(:last - 1), value, state)
      case default
         call to_real(word, value, state)
      end select
   end subroutine to_angle

   !> Find the digits and the decimal point at the start of a word
   pure subroutine measure_mantissa(word, length, leading, is_zero)
      character(len=*), intent(in) :: word
      !> Number of characters, 0 if there is no digit
      integer, intent(out) :: length
      !> Decimal exponent of the first non-zero digit
      integer, intent(out) :: leading
      !> Are all digits zero?
      logical, intent(out) :: is_zero
      integer :: k, point, count_figures, first_nonzero

      point = 0
      count_figures = 0
      first_nonzero = 0
      do k = 1, len(word)
         if (word(k:k) == "." .and. point == 0) then
            point = k
         else if (index(figures, word(k:k)) > 0) then
            count_figures = count_figures + 1
            if (first_nonzero == 0 .and. word(k:k) /= "0") first_nonzero = k
         else
            exit
         end if
      end do
      length = k - 1
      if (count_figures == 0) length = 0
      if (point == 0) point = length + 1
      is_zero = first_nonzero == 0
      if (first_nonzero < point) then
         leading = point - first_nonzero - 1
      else
         leading = point - first_nonzero
      end if
   end subroutine measure_mantissa

   !> Exponent with optional sign; clipped far beyond the range
   pure subroutine read_exponent(word, value, state)
      character(len=*), intent(in) :: word
      integer, intent(out) :: value
      integer, intent(out) :: state
      !> Larger than the length of any mantissa that fits into memory
      integer, parameter :: limit = 1000000000

      call to_integer(word, value, state)
      if (state == word_state%too_large) then
         value = limit
         if (word(1:1) == "-") value = -limit
         state = word_state%good
      end if
      value = max(-limit, min(limit, value))
   end subroutine read_exponent

   !> Is this nan, inf or infinity, in any case?
   pure logical function spells_not_finite(word) result(spells)
      character(len=*), intent(in) :: word
      character(len=8) :: lower
      integer :: k

      spells = .false.
      if (len(word) < 3 .or. len(word) > 8) return
      lower = word
      do k = 1, len(word)
         if (lower(k:k) >= "A" .and. lower(k:k) <= "Z") lower(k:k) = achar(iachar(lower(k:k)) + 32)
      end do
      spells = lower == "nan" .or. lower == "inf" .or. lower == "infinity"
   end function spells_not_finite

   !> Number of characters of an integer
   pure integer function columns_of(value) result(columns)
      !> May be negative
      integer, intent(in) :: value
      integer :: rest

      columns = merge(2, 1, value < 0)
      rest = value/10
      do while (rest /= 0)
         columns = columns + 1
         rest = rest/10
      end do
   end function columns_of

   !> An integer without blanks
   pure function integer_text(value) result(text)
      !> May be negative
      integer, intent(in) :: value
      character(len=columns_of(value)) :: text

      write(text, "(I0)") value
   end function integer_text

   !> A real number with six significant digits, without unnecessary zeros, padded with blanks
   pure function six_figures(value) result(text)
      real(wp), intent(in) :: value
      character(len=14) :: text
      integer :: last

      if (value == 0.0_wp) then
         text = "0"
      else if (abs(value) < 1.0e-4_wp .or. abs(value) >= 1.0e6_wp) then
         write(text, "(ES12.5)") value
      else
         write(text, "(F14.6)") value
         last = verify(text, " 0", back=.true.)
         if (text(last:last) == ".") last = last - 1
         text(last + 1:) = ""
      end if
      text = adjustl(text)
   end function six_figures

   !> The same without trailing blanks
   pure function real_text(value) result(text)
      !> Any number
      real(wp), intent(in) :: value
      character(len=len_trim(six_figures(value))) :: text

      text = six_figures(value)
   end function real_text

   !> Number of occurrences of a letter in a text
   pure integer function occurrences(text, letter) result(count)
      character(len=*), intent(in) :: text
      character, intent(in) :: letter
      integer :: i

      count = 0
      do i = 1, len(text)
         if (text(i:i) == letter) count = count + 1
      end do
   end function occurrences

   !> A text with each occurrence of a letter replaced
   pure function replaced(text, letter, by) result(changed)
      !> Any
      character(len=*), intent(in) :: text
      !> Letter to be replaced
      character, intent(in) :: letter
      !> Replacement, of any length
      character(len=*), intent(in) :: by
      character(len=len(text) + occurrences(text, letter)*(len(by) - 1)) :: changed
      integer :: i, last

      last = 0
      do i = 1, len(text)
         if (text(i:i) == letter) then
            changed(last + 1:last + len(by)) = by
            last = last + len(by)
         else
            last = last + 1
            changed(last:last) = text(i:i)
         end if
      end do
   end function replaced

   !> Shortest representation of a real number that reads back to the same value, with a decimal point or an exponent; padded
   !> with blanks
   pure function exact_text(value) result(text)
      !> Any number
      real(wp), intent(in) :: value
      character(len=26) :: text
      !> Numbers from 1e-5 to 1e7 are written without exponent
      integer, parameter :: lowest = -5, highest = 6
      character(len=24) :: word
      character(len=12) :: form
      character(len=:), allocatable :: digits
      real(wp) :: back
      integer :: exponent, figures_used, last, state, status

      do figures_used = 15, 17
         write(form, "(A, I0, A)") "(ES24.", figures_used - 1, "E3)"
         write(word, form) abs(value)
         call to_real(trim(adjustl(word)), back, state)
         if (state == word_state%good .and. .not. abs(back - abs(value)) > 0.0_wp) exit
      end do
      word = adjustl(word)
      last = index(word, "E")
      read(word(last + 1:), *, iostat=status) exponent
      digits = word(1:1) // word(3:last - 1)
      last = max(1, verify(digits, "0", back=.true.))
      digits = digits(:last)
      if (abs(value) <= 0.0_wp) exponent = 0
      if (exponent < lowest .or. exponent > highest) then
         text = digits(1:1)
         if (last > 1) text = digits(1:1) // "." // digits(2:)
         text = trim(text) // "e" // integer_text(exponent)
      else if (exponent < 0) then
         text = "0." // repeat("0", -exponent - 1) // digits
      else if (last <= exponent + 1) then
         text = digits // repeat("0", exponent + 1 - last) // ".0"
      else
         text = digits(:exponent + 1) // "." // digits(exponent + 2:)
      end if
      if (sign(1.0_wp, value) < 0.0_wp) text = "-" // text(:len(text) - 1)
   end function exact_text

   !> A text in lower case
   pure function small(text)
      !> Letters other than A to Z are unchanged
      character(len=*), intent(in) :: text
      character(len=len(text)) :: small
      integer :: k

      small = text
      do k = 1, len(text)
         if (text(k:k) >= "A" .and. text(k:k) <= "Z") small(k:k) = achar(iachar(text(k:k)) + 32)
      end do
   end function small

   !> A text in upper case
   elemental function capital(text)
      !> Letters other than a to z are unchanged
      character(len=*), intent(in) :: text
      character(len=len(text)) :: capital
      integer :: k

      capital = text
      do k = 1, len(text)
         if (text(k:k) >= "a" .and. text(k:k) <= "z") capital(k:k) = achar(iachar(text(k:k)) - 32)
      end do
   end function capital
end module contact_text_words
