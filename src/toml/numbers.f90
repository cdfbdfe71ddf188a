!> Integers and real numbers of TOML
module contact_toml_numbers
   use contact_base_kinds, only : long, wp
   use contact_text_words, only : to_real, word_state
   implicit none (type, external)
   private

   public :: read_number

   character(len=*), parameter :: figures = "0123456789"

contains

   !> Convert a word to an integer or a real number
   subroutine read_number(word, is_real, i, r, complaint)
      !> Non-empty word
      character(len=*), intent(in) :: word
      !> Does it have a decimal point or an exponent?
      logical, intent(out) :: is_real
      !> Set for integers
      integer(long), intent(out) :: i
      !> Set for both kinds
      real(wp), intent(out) :: r
      !> Why it is not a number; unallocated if it is one
      character(len=:), allocatable, intent(out) :: complaint
      character(len=len(word)) :: plain
      integer :: state
      logical :: is_good

      i = 0
      r = 0.0_wp
      call check_form(word, is_good, is_real)
      if (.not. is_good) then
         call describe_form(word, complaint)
         return
      end if
      call remove_underscores(word, plain)
      if (is_real) then
         call to_real(trim(plain), r, state)
         if (word(1:1) == "-") r = sign(r, -1.0_wp)
         if (state /= word_state%good) then
            complaint = "is too large for a number"
         else if (abs(r) < tiny(1.0_wp) .and. scan(plain(:scan(plain // "e", "eE") - 1), "123456789") > 0) then
            complaint = "is too small for a number; 0 is meant, or another exponent"
         end if
      else
         call to_long(trim(plain), i, is_good)
         r = real(i, wp)
         if (.not. is_good) complaint = "is too large for an integer"
      end if
   end subroutine read_number

   !> Check the form: optional sign, digits without leading zeros, optional fraction and exponent
   pure subroutine check_form(word, is_good, is_real)
      character(len=*), intent(in) :: word
      !> Is it a valid number?
      logical, intent(out) :: is_good
      !> Does it have a decimal point or an exponent?
      logical, intent(out) :: is_real
      integer :: at, first

      is_real = .false.
      first = merge(2, 1, scan(word(1:1), "+-") == 1)
      at = first
      call skip_figures(word, at, is_good)
      if (is_good .and. at > first + 1) is_good = word(first:first) /= "0"
      if (is_good .and. letter(word, at) == ".") then
         is_real = .true.
         at = at + 1
         call skip_figures(word, at, is_good)
      end if
      if (is_good .and. scan(letter(word, at), "eE") == 1) then
         is_real = .true.
         at = at + 1
         if (scan(letter(word, at), "+-") == 1) at = at + 1
         call skip_figures(word, at, is_good)
      end if
      is_good = is_good .and. at > len(word)
   end subroutine check_form

   !> A letter of a word; blank beyond its end
   pure character function letter(word, at)
      character(len=*), intent(in) :: word
      integer, intent(in) :: at

      letter = " "
      if (at <= len(word)) letter = word(at:at)
   end function letter

   !> Skip digits with single underscores between them
   pure subroutine skip_figures(word, at, is_good)
      character(len=*), intent(in) :: word
      !> Position; on return after the digits
      integer, intent(inout) :: at
      !> Is there at least one digit, and no underscore at either end?
      logical, intent(out) :: is_good

      is_good = .false.
      do while (at <= len(word))
         if (index(figures, word(at:at)) > 0) then
            is_good = .true.
         else if (word(at:at) == "_" .and. is_good) then
            is_good = .false.
         else
            exit
         end if
         at = at + 1
      end do
   end subroutine skip_figures

   !> Remove the underscores from a number
   pure subroutine remove_underscores(word, plain)
      character(len=*), intent(in) :: word
      !> Number padded with blanks
      character(len=len(word)), intent(out) :: plain
      integer :: k, n

      plain = ""
      n = 0
      do k = 1, len(word)
         if (word(k:k) == "_") cycle
         n = n + 1
         plain(n:n) = word(k:k)
      end do
   end subroutine remove_underscores

   !> Convert to a 64-bit integer
   pure subroutine to_long(word, value, is_good)
      !> Optional sign and digits
      character(len=*), intent(in) :: word
      integer(long), intent(out) :: value
      !> False if it is too large
      logical, intent(out) :: is_good
      !> Above this value another digit may not fit
      integer(long), parameter :: highest = 922337203685477579_long
      integer :: k

      value = 0
      is_good = .false.
      do k = 1, len(word)
         if (scan(word(k:k), "+-") == 1) cycle
         if (value > highest) return
         value = 10*value + iachar(word(k:k)) - iachar("0")
      end do
      if (word(1:1) == "-") value = -value
      is_good = .true.
   end subroutine to_long

   !> Why a word that starts like a number is not one
   subroutine describe_form(word, complaint)
      character(len=*), intent(in) :: word
      character(len=:), allocatable, intent(out) :: complaint
      integer :: first

      first = merge(2, 1, scan(word(1:1), "+-") == 1)
      if (word(first:) == "inf" .or. word(first:) == "nan") then
         complaint = "is no number that a case can have"
      else if (letter(word, 5) == "-" .and. verify(word(:min(4, len(word))), figures) == 0) then
         complaint = "is a date; dates and times have no meaning here"
      else if (letter(word, 3) == ":") then
         complaint = "is a time; dates and times have no meaning here"
      else if (letter(word, first) == "0" .and. scan(letter(word, first + 1), "xob") == 1) then
         complaint = "is not decimal; write 255, not 0xff"
      else if (letter(word, first) == "0" .and. scan(letter(word, first + 1), figures) == 1) then
         complaint = "is no number, it begins with a needless zero"
      else if (letter(word, first) == ".") then
         complaint = "is no number, a figure must stand before the point"
      else if (verify(word, figures // "+-._eE") > 0) then
         complaint = 'is no number; with a unit it needs quotes and a blank, "460 mm"'
      else
         complaint = "is no number; 82000, 0.28, 1e-5 and 1_000 are"
      end if
   end subroutine describe_form
end module contact_toml_numbers
