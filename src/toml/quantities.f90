!> Numbers with a unit, "460 mm", "0.46 m", "12 deg", "10 kN", converted to the required unit
module contact_toml_quantities
   use contact_base_constants, only : pi
   use contact_base_kinds, only : long, wp
   use contact_text_words, only : integer_text, to_real, word_state
   use contact_toml_numbers, only : read_number
   implicit none (type, external)
   private

   public :: read_quantity

   !> A unit: powers of length, force, time, angle, temperature and mass, and the factor 10**power * rest to mm, N, s, rad,
   !> degC, kg
   type :: unit_type
      integer :: dimensions(6) = 0
      integer :: power = 0
      real(wp) :: rest = 1.0_wp
   end type unit_type

   type :: unit_row
      character(len=5) :: name
      type(unit_type) :: unit
   end type unit_row

   !> Powers of ten are kept separate from other factors, so that 0.46 m is exactly 460 mm
   type(unit_row), parameter :: units(*) = [ &
      & unit_row("mm", unit_type([1, 0, 0, 0, 0, 0], 0)), unit_row("m", unit_type([1, 0, 0, 0, 0, 0], 3)), &
      & unit_row("cm", unit_type([1, 0, 0, 0, 0, 0], 1)), unit_row("km", unit_type([1, 0, 0, 0, 0, 0], 6)), &
      & unit_row("um", unit_type([1, 0, 0, 0, 0, 0], -3)), unit_row("nm", unit_type([1, 0, 0, 0, 0, 0], -6)), &
      & unit_row("in", unit_type([1, 0, 0, 0, 0, 0], 0, 25.4_wp)), &
      & unit_row("N", unit_type([0, 1, 0, 0, 0, 0], 0)), unit_row("kN", unit_type([0, 1, 0, 0, 0, 0], 3)), &
      & unit_row("MN", unit_type([0, 1, 0, 0, 0, 0], 6)), &
      & unit_row("Pa", unit_type([-2, 1, 0, 0, 0, 0], -6)), unit_row("kPa", unit_type([-2, 1, 0, 0, 0, 0], -3)), &
      & unit_row("MPa", unit_type([-2, 1, 0, 0, 0, 0], 0)), unit_row("GPa", unit_type([-2, 1, 0, 0, 0, 0], 3)), &
      & unit_row("s", unit_type([0, 0, 1, 0, 0, 0], 0)), unit_row("ms", unit_type([0, 0, 1, 0, 0, 0], -3)), &
      & unit_row("us", unit_type([0, 0, 1, 0, 0, 0], -6)), unit_row("min", unit_type([0, 0, 1, 0, 0, 0], 0, 60.0_wp)), &
      & unit_row("h", unit_type([0, 0, 1, 0, 0, 0], 0, 3600.0_wp)), &
      & unit_row("rad", unit_type([0, 0, 0, 1, 0, 0], 0)), unit_row("mrad", unit_type([0, 0, 0, 1, 0, 0], -3)), &
      & unit_row("deg", unit_type([0, 0, 0, 1, 0, 0], 0, pi/180.0_wp)), &
      & unit_row("degC", unit_type([0, 0, 0, 0, 1, 0], 0)), unit_row("K", unit_type([0, 0, 0, 0, 1, 0], 0)), &
      & unit_row("kg", unit_type([0, 0, 0, 0, 0, 1], 0)), unit_row("g", unit_type([0, 0, 0, 0, 0, 1], -3)), &
      & unit_row("J", unit_type([1, 1, 0, 0, 0, 0], 3)), unit_row("kJ", unit_type([1, 1, 0, 0, 0, 0], 6)), &
      & unit_row("W", unit_type([1, 1, -1, 0, 0, 0], 3)), unit_row("%", unit_type([0, 0, 0, 0, 0, 0], -2)), &
      & unit_row("-", unit_type([0, 0, 0, 0, 0, 0], 0)), unit_row("1", unit_type([0, 0, 0, 0, 0, 0], 0))]

contains

   !> Convert a number with a unit
   subroutine read_quantity(text, expected, value, complaint)
      !> Number, blank and unit
      character(len=*), intent(in) :: text
      !> Required unit, as in the table of bounds; "- or mm" allows either of two
      character(len=*), intent(in) :: expected
      !> Value in the internal unit
      real(wp), intent(out) :: value
      !> Why it is invalid; unallocated if it is valid
      character(len=:), allocatable, intent(out) :: complaint
      type(unit_type) :: given, required
      character(len=:), allocatable :: name
      integer(long) :: i
      integer :: blank, first, last
      logical :: is_real, is_known, fits

      value = 0.0_wp
      blank = scan(text, " ")
      if (blank < 2) then
         complaint = 'is no number with a unit; "460 mm" is one, with a blank between them'
         return
      end if
      call read_number(text(:blank - 1), is_real, i, value, complaint)
      if (allocated(complaint)) then
         complaint = 'is no number with a unit; "' // text(:blank - 1) // '" ' // complaint
         return
      end if
      name = trim(adjustl(text(blank:)))
      call read_unit(name, given, is_known)
      if (.not. is_known) then
         complaint = 'has the unknown unit "' // name // '"; expected is ' // trim(required_unit(expected))
         return
      end if
      fits = .false.
      first = 1
      do while (.not. fits .and. first <= len_trim(expected))
         last = index(expected(first:), " or ")
         last = merge(len_trim(expected), first + last - 2, last == 0)
         call read_unit(expected(first:last), required, is_known)
         if (is_known) fits = all(required%dimensions == given%dimensions)
         first = last + 5
      end do
      ! kelvin: temperatures would need an offset and differences would not, and the table does not distinguish them
      if (name == "K" .and. fits) then
         complaint = "is in kelvin; temperatures are in degC"
      else if (.not. fits .and. (expected == "integer" .or. index(expected, "...") > 0)) then
         complaint = "has a unit, but a plain number is expected"
      else if (.not. fits) then
         complaint = 'has the unit "' // name // '", expected is ' // trim(required_unit(expected)) // &
         & " or a unit that can be converted to it"
      end if
      if (allocated(complaint)) return
      call scale_number(text(:blank - 1), given%power - required%power, value, fits)
      if (.not. fits) complaint = "is too large or too small for a number"
      if (abs(given%rest - required%rest) > 0.0_wp) value = value*(given%rest/required%rest)
   end subroutine read_quantity

   !> A unit as shown in a message, padded with blanks
   pure function required_unit(expected) result(text)
      character(len=*), intent(in) :: expected
      character(len=len(expected) + 14) :: text

      text = expected
      if (index(expected, "-") == 1) text = "a plain number" // expected(2:)
   end function required_unit

   !> A number times a power of ten, rounded once
   subroutine scale_number(word, power, value, is_good)
      !> Valid TOML number
      character(len=*), intent(in) :: word
      integer, intent(in) :: power
      real(wp), intent(out) :: value
      !> False if out of range
      logical, intent(out) :: is_good
      character(len=len(word)) :: mantissa
      integer :: exponent, k, last, n, status, state

      exponent = 0
      last = scan(word, "eE")
      if (last > 0) read(word(last + 1:), *, iostat=status) exponent
      if (last == 0) last = len(word) + 1
      mantissa = ""
      n = 0
      do k = 1, last - 1
         if (word(k:k) == "_") cycle
         n = n + 1
         mantissa(n:n) = word(k:k)
      end do
      call to_real(mantissa(:n) // "e" // integer_text(exponent + power), value, state)
      is_good = state == word_state%good .and. (abs(value) > 0.0_wp .or. scan(mantissa, "123456789") == 0)
   end subroutine scale_number

   !> Parse a product or quotient of units: "N/mm2", "m/s", "J/(kg K)", "1/m"
   pure subroutine read_unit(text, unit, is_known)
      character(len=*), intent(in) :: text
      type(unit_type), intent(out) :: unit
      logical, intent(out) :: is_known
      integer :: at, first, power, row, way
      logical :: is_grouped

      at = 1
      way = 1
      is_grouped = .false.
      is_known = len_trim(text) > 0
      do while (is_known .and. at <= len_trim(text))
         select case (text(at:at))
         case (" ", "*")
            at = at + 1
         case ("/")
            is_known = way > 0
            way = -1
            at = at + 1
         case ("(")
            is_known = .not. is_grouped
            is_grouped = .true.
            at = at + 1
         case (")")
            is_known = is_grouped
            is_grouped = .false.
            way = 1
            at = at + 1
         case default
            first = at
            if (text(at:at) == "1" .or. text(at:at) == "-" .or. text(at:at) == "%") then
               at = at + 1
            else
               do while (at <= len_trim(text))
                  if (verify(text(at:at), "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ") > 0) exit
                  at = at + 1
               end do
            end if
            is_known = .false.
            if (at == first) exit
            do row = 1, size(units)
               if (units(row)%name == text(first:at - 1)) exit
            end do
            if (row > size(units)) exit
            is_known = .true.
            power = 1
            if (at < len(text)) then
               if (text(at:at) == "^") at = at + 1
            end if
            if (at <= len(text)) then
               if (scan(text(at:at), "23") == 1) then
                  power = iachar(text(at:at)) - iachar("0")
                  at = at + 1
               end if
            end if
            unit%dimensions = unit%dimensions + way*power*units(row)%unit%dimensions
            unit%power = unit%power + way*power*units(row)%unit%power
            unit%rest = unit%rest*units(row)%unit%rest**(way*power)
            if (.not. is_grouped) way = 1
         end select
      end do
      is_known = is_known .and. .not. is_grouped
   end subroutine read_unit
end module contact_toml_quantities
