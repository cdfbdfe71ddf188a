!> Numbers as fixed-width texts: the formats of the .out, .mat and .subs files
!>
!> Readers split lines on blanks or take fixed columns, so a number must never fill its
!> field with stars, lose the letter of its exponent or show a negative zero.
module contact_output_formats
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: fixed, general, generals, heading, printable, scientific, smart, smarts, whole

   !> Smaller magnitudes are shown as zero: their exponents would need three digits [-]
   real(wp), parameter :: smallest = 1.0e-99_wp
   !> From here on exponents need three digits [-]
   real(wp), parameter :: largest = 9.9e98_wp
   !> Smaller magnitudes are shown as zero by the smart format [-]
   real(wp), parameter :: smart_zero = 1.0e-20_wp

contains

   !> The value without what a reader could not digest: negative zero and tiny numbers become 0
   elemental real(wp) function printable(value)
      real(wp), intent(in) :: value
      printable = value
      if (abs(value) < smallest) printable = 0.0_wp
   end function printable

   !> Integer, right-aligned in width columns; longer if it does not fit
   pure function whole(value, width) result(text)
      integer, intent(in) :: value
      !> Number of columns
      integer, intent(in) :: width
      character(len=:), allocatable :: text
      character(len=24) :: digits
      integer :: count

      write(digits, '(i24)') value
      digits = adjustl(digits)
      count = len_trim(digits)
      text = repeat(" ", max(0, width - count)) // digits(1:count)
   end function whole

   !> Fixed point with the given decimals, right-aligned; large values lose decimals, then
   !> turn to scientific notation
   pure function fixed(value, width, decimals) result(text)
      real(wp), intent(in) :: value
      !> Number of columns and of decimals
      integer, intent(in) :: width, decimals
      character(len=width) :: text
      integer :: left

      do left = decimals, 0, -1
         write(text, edit("f", width, left)) printable(value)
         if (text(1:1) /= "*") return
      end do
      text = scientific(value, width, max(0, min(decimals, width - 8)))
   end function fixed

   !> Normalised scientific: one non-zero digit before the point
   pure function scientific(value, width, decimals) result(text)
      real(wp), intent(in) :: value
      !> Number of columns and of decimals
      integer, intent(in) :: width, decimals
      character(len=width) :: text

      if (abs(value) < largest .or. .not. ieee_is_finite(value)) then
         write(text, edit("es", width, decimals)) printable(value)
      else
         write(text, edit("es", width, decimals, wide=.true.)) value
      end if
   end function scientific

   !> Switching format: fixed with the given significant digits and four blanks behind for
   !> 0.1 <= |value| < 10**digits, else 0.dddE+xx
   pure function general(value, width, digits) result(text)
      real(wp), intent(in) :: value
      !> Number of columns and of significant digits
      integer, intent(in) :: width, digits
      character(len=width) :: text

      if (abs(value) < largest .or. .not. ieee_is_finite(value)) then
         write(text, edit("g", width, digits)) printable(value)
      else
         write(text, edit("e", width, digits, wide=.true.)) value
      end if
   end function general

   !> "Smart" format: fixed with a constant number of digits for 0.1 <= |value| < 10**places,
   !> else scientific with the given significant digits. The switch looks at the unrounded value.
   pure function smart(value, width, places, digits) result(text)
      real(wp), intent(in) :: value
      !> Number of columns, digits of the fixed form, digits of the scientific form
      integer, intent(in) :: width, places, digits
      character(len=width) :: text
      real(wp) :: shown
      integer :: magnitude

      shown = value
      if (.not. ieee_is_finite(value)) then
         write(text, edit("f", width, 1)) value
         return
      end if
      magnitude = 0
      if (abs(value) < smart_zero) then
         shown = 0.0_wp
      else
         magnitude = floor(log10(abs(value)) + 1.0e-7_wp)
      end if
      if (magnitude >= places .or. magnitude <= -2) then
         text = scientific(shown, width, digits - 1)
      else
         write(text, edit("f", width, max(0, places - magnitude - 1))) shown
      end if
   end function smart

   !> Values next to each other in the format G 12.4
   pure function generals(values) result(text)
      real(wp), intent(in) :: values(:)
      character(len=12*size(values)) :: text
      integer :: i
      do i = 1, size(values)
         text(12*i - 11:12*i) = general(values(i), 12, 4)
      end do
   end function generals

   !> Values next to each other in the format S 12/4/4
   pure function smarts(values) result(text)
      real(wp), intent(in) :: values(:)
      character(len=12*size(values)) :: text
      integer :: i
      do i = 1, size(values)
         text(12*i - 11:12*i) = smart(values(i), 12, 4, 4)
      end do
   end function smarts

   !> Column names above values: two blanks, then three blanks and a name in each twelve columns
   pure function heading(names) result(text)
      character(len=*), intent(in) :: names(:)
      character(len=:), allocatable :: text
      character(len=2 + 12*size(names)) :: line
      integer :: i

      line = ""
      do i = 1, size(names)
         line(12*i - 6:12*i + 2) = names(i)
      end do
      text = trim(line)
   end function heading

   !> Edit descriptor such as (es12.3) or, with three digits for the exponent, (es12.3e3)
   pure function edit(letters, width, digits, wide) result(text)
      character(len=*), intent(in) :: letters
      !> At most 99 columns and 9 digits
      integer, intent(in) :: width, digits
      !> Three digits for the exponent? Default no
      logical, intent(in), optional :: wide
      character(len=11) :: text

      text = "(" // letters // achar(48 + width/10) // achar(48 + mod(width, 10)) // "." &
         & // achar(48 + digits) // ")"
      if (present(wide)) text(index(text, ")"):) = "e3)"
   end function edit
end module contact_output_formats
