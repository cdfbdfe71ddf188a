!> Numbers as fixed-width texts: the formats of the .out, .mat and .subs files
!>
!> Readers split lines on blanks or use fixed columns. A number therefore never fills its field with asterisks, loses the letter of
!> its exponent or appears as negative zero. Digits are computed by integer arithmetic: large tables are written an order of
!> magnitude faster than with edit descriptors. The last digit may differ from theirs if the next one is a five followed by zeros
!> up to 15 digits.
module contact_output_formats
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_is_nan
   use contact_base_kinds, only : long, wp
   use contact_text_words, only : columns_of
   implicit none (type, external)
   private

   public :: fixed, formatted, general, heading, scientific, smart, whole

   !> Smaller magnitudes are written as zero: their exponents would need three digits [-]
   real(wp), parameter :: smallest = 1.0e-99_wp
   !> Smaller magnitudes are written as zero in the format of `smart` [-]
   real(wp), parameter :: smart_zero = 1.0e-20_wp
   !> Maximum magnitude of a number that is converted to an integer [-]
   real(wp), parameter :: integer_limit = 9.0e15_wp
   !> Columns of the working text, and of a line of names
   integer, parameter :: room = 40, line_length = 132
   !> Powers of ten that are represented exactly
   real(wp), parameter :: ten(0:22) = [1.0e0_wp, 1.0e1_wp, 1.0e2_wp, 1.0e3_wp, 1.0e4_wp, 1.0e5_wp, 1.0e6_wp, &
      & 1.0e7_wp, 1.0e8_wp, 1.0e9_wp, 1.0e10_wp, 1.0e11_wp, 1.0e12_wp, 1.0e13_wp, 1.0e14_wp, 1.0e15_wp, 1.0e16_wp, &
      & 1.0e17_wp, 1.0e18_wp, 1.0e19_wp, 1.0e20_wp, 1.0e21_wp, 1.0e22_wp]

   !> A number rounded to a number of significant digits: digits * 10**(exponent - count + 1)
   type :: rounded
      !> The digits as an integer, 0 for zero
      integer(long) :: digits = 0
      !> Exponent of ten of the first digit
      integer :: exponent = 0
      logical :: negative = .false.
   end type rounded

contains

   !> Integer, right-aligned in width columns; longer if it does not fit
   pure function whole(value, width) result(text)
      !> Value to be written
      integer, intent(in) :: value
      !> Number of columns
      integer, intent(in) :: width
      character(len=max(width, columns_of(value))) :: text
      character(len=room) :: work
      integer :: first

      work = ""
      first = room + 1
      call prepend(work, first, abs(int(value, long)), 1)
      if (value < 0) call prepend_sign(work, first)
      text = work(room + 1 - len(text):)
   end function whole

   !> Fixed point with the given number of decimals, right-aligned; for large values the number of decimals is reduced, then
   !> scientific notation is used
   pure function fixed(value, width, decimals) result(text)
      !> Value to be written
      real(wp), intent(in) :: value
      !> Number of columns and of decimals
      integer, intent(in) :: width, decimals
      character(len=width) :: text
      character(len=room) :: work
      real(wp) :: scaled
      integer :: first, places

      if (.not. ieee_is_finite(value)) then
         text = not_a_number(value, width)
         return
      end if
      do places = decimals, 0, -1
         if (abs(value) >= integer_limit) exit
         scaled = abs(value)*ten(places)
         if (scaled >= integer_limit) cycle
         work = ""
         first = room + 1
         call prepend_fixed(work, first, nint(scaled, long), places, value < 0.0_wp)
         if (work(first:first) == "0" .and. room + 1 - first == width + 1 .and. places > 0) first = first + 1
         if (room + 1 - first > width) cycle
         text = work(room + 1 - width:room)
         return
      end do
      text = scientific(value, width, max(0, min(decimals, width - 8)))
   end function fixed

   !> Normalised scientific notation: one non-zero digit before the decimal point
   pure function scientific(value, width, decimals) result(text)
      !> Value to be written
      real(wp), intent(in) :: value
      !> Number of columns and of decimals
      integer, intent(in) :: width, decimals
      character(len=width) :: text
      type(rounded) :: number

      if (.not. ieee_is_finite(value)) then
         text = not_a_number(value, width)
         return
      end if
      number = round_to(value, decimals + 1)
      text = with_exponent(number, number%exponent, decimals, width)
   end function scientific

   !> Fixed point with the given number of significant digits, followed by four blanks, if 0.1 <= |value| < 10**digits after
   !> rounding; otherwise 0.dddE+xx
   pure function general(value, width, digits) result(text)
      !> Value to be written
      real(wp), intent(in) :: value
      !> Number of columns and of significant digits
      integer, intent(in) :: width, digits
      character(len=width) :: text
      character(len=room) :: work
      type(rounded) :: number
      integer :: first

      if (.not. ieee_is_finite(value)) then
         text = not_a_number(value, width)
         return
      end if
      number = round_to(value, digits)
      if (number%exponent >= -1 .and. number%exponent < digits) then
         work = ""
         first = room - 3
         call prepend_fixed(work, first, number%digits, digits - 1 - number%exponent, number%negative)
         text = work(room + 1 - width:room)
      else
         text = with_exponent(number, number%exponent + 1, digits, width)
      end if
   end function general

   !> Fixed point with a constant number of digits if 0.1 <= |value| < 10**places, otherwise scientific notation with the given
   !> number of significant digits. The choice depends on the unrounded value.
   pure function smart(value, width, places, digits) result(text)
      !> Value to be written
      real(wp), intent(in) :: value
      !> Number of columns, digits of the fixed form, digits of the scientific form
      integer, intent(in) :: width, places, digits
      character(len=width) :: text
      real(wp) :: shown
      integer :: magnitude

      if (.not. ieee_is_finite(value)) then
         text = not_a_number(value, width)
         return
      end if
      magnitude = 0
      shown = value
      if (abs(value) < smart_zero) then
         shown = 0.0_wp
      else
         magnitude = floor(log10(abs(value)) + 1.0e-7_wp)
      end if
      if (magnitude >= places .or. magnitude <= -2) then
         text = scientific(shown, width, digits - 1)
      else
         text = fixed(shown, width, max(0, places - magnitude - 1))
      end if
   end function smart

   !> Values side by side in 12 columns each
   pure function formatted(values, forms) result(line)
      !> Values to be written
      real(wp), intent(in) :: values(:)
      !> One letter for each value, the last one also for those that follow. G: general, S: smart, L: smart with six digits,
      !> F: fixed with four decimals, P: with seven
      character(len=*), intent(in) :: forms
      character(len=12*size(values)) :: line
      integer :: k, letter

      do k = 1, size(values)
         letter = min(k, len(forms))
         associate (value => values(k), field => line(12*k - 11:12*k))
            select case (forms(letter:letter))
            case ("S"); field = smart(value, 12, 4, 4)
            case ("L"); field = smart(value, 12, 4, 6)
            case ("F"); field = fixed(value, 12, 4)
            case ("P"); field = fixed(value, 12, 7)
            case default; field = general(value, 12, 4)
            end select
         end associate
      end do
   end function formatted

   !> Column names for a line of values: two blanks, then three blanks and a name in every twelve columns; padded with blanks
   pure function heading(names) result(text)
      !> At most ten names of at most nine characters, separated by blanks
      character(len=*), intent(in) :: names
      character(len=line_length) :: text
      integer :: at, k, next

      text = ""
      next = 6
      at = next
      do k = 1, len(names)
         if (names(k:k) /= " ") then
            if (at > line_length) return
            text(at:at) = names(k:k)
            at = at + 1
         else if (at > next) then
            next = next + 12
            at = next
         end if
      end do
   end function heading

   !> Round to significant digits
   pure function round_to(value, count) result(number)
      !> Finite value
      real(wp), intent(in) :: value
      !> Number of significant digits, at most 15
      integer, intent(in) :: count
      type(rounded) :: number
      integer(long) :: limit

      if (abs(value) < smallest) return
      number%negative = value < 0.0_wp
      limit = nint(ten(count), long)
      number%exponent = floor(log10(abs(value)))
      number%digits = nint(shifted(abs(value), count - 1 - number%exponent), long)
      if (10*number%digits < limit) then
         ! the logarithm was rounded up to the next power of ten
         number%exponent = number%exponent - 1
         number%digits = nint(shifted(abs(value), count - 1 - number%exponent), long)
      end if
      if (number%digits >= limit) then
         number%exponent = number%exponent + 1
         number%digits = (number%digits + 5)/10
      end if
   end function round_to

   !> value * 10**power with minimum round-off
   pure real(wp) function shifted(value, power)
      real(wp), intent(in) :: value
      integer, intent(in) :: power

      if (power >= 0 .and. power <= 22) then
         shifted = value*ten(power)
      else if (power < 0 .and. power >= -22) then
         shifted = value/ten(-power)
      else if (power > 0) then
         shifted = value*10.0_wp**(power/2)*10.0_wp**(power - power/2)
      else
         shifted = value/10.0_wp**((-power)/2)/10.0_wp**(-power - (-power)/2)
      end if
   end function shifted

   !> Digits with the given number of decimals, and an exponent
   pure function with_exponent(number, exponent, decimals, width) result(text)
      type(rounded), intent(in) :: number
      !> Exponent to be written, number of decimals, number of columns
      integer, intent(in) :: exponent, decimals, width
      character(len=width) :: text
      character(len=room) :: work
      integer :: first

      work = ""
      first = room + 1
      call prepend(work, first, abs(int(exponent, long)), 2)
      first = first - 2
      work(first:first + 1) = merge("E-", "E+", exponent < 0)
      call prepend_fixed(work, first, number%digits, decimals, number%negative)
      text = work(room + 1 - width:room)
   end function with_exponent

   !> Prepend digits with a decimal point
   pure subroutine prepend_fixed(work, first, digits, decimals, negative)
      character(len=room), intent(inout) :: work
      !> First used column
      integer, intent(inout) :: first
      integer(long), intent(in) :: digits
      !> Number of digits after the decimal point
      integer, intent(in) :: decimals
      !> Prepend a minus sign, unless all digits are zero?
      logical, intent(in) :: negative
      integer(long) :: unit

      unit = nint(ten(decimals), long)
      call prepend(work, first, mod(digits, unit), decimals)
      first = first - 1
      work(first:first) = "."
      call prepend(work, first, digits/unit, 1)
      if (negative .and. digits > 0) call prepend_sign(work, first)
   end subroutine prepend_fixed

   !> Prepend an integer with at least `least` digits
   pure subroutine prepend(work, first, number, least)
      character(len=room), intent(inout) :: work
      !> First used column
      integer, intent(inout) :: first
      !> Non-negative
      integer(long), intent(in) :: number
      integer, intent(in) :: least
      integer(long) :: rest
      integer :: count

      rest = number
      count = 0
      do while (rest > 0 .or. count < least)
         first = first - 1
         count = count + 1
         work(first:first) = achar(48 + int(mod(rest, 10_long)))
         rest = rest/10
      end do
   end subroutine prepend

   !> Prepend a minus sign
   pure subroutine prepend_sign(work, first)
      character(len=room), intent(inout) :: work
      !> First used column
      integer, intent(inout) :: first

      first = first - 1
      work(first:first) = "-"
   end subroutine prepend_sign

   !> NaN or infinity, right-aligned
   pure function not_a_number(value, width) result(text)
      real(wp), intent(in) :: value
      !> Number of columns, at least 3
      integer, intent(in) :: width
      character(len=width) :: text

      text = ""
      if (ieee_is_nan(value)) then
         text(width - 2:) = "NaN"
      else if (value > 0.0_wp .or. width < 4) then
         text(width - 2:) = "Inf"
      else
         text(width - 3:) = "-Inf"
      end if
   end function not_a_number
end module contact_output_formats
