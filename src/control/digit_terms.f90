!> Messages in the terms of those who write digits
!>
!> Below the readers a message names a choice as the readable format does: `sequence = "initiate"`, or, where there are several,
!> `iteration.solver = "convex_gs" or "gauss_seidel"`. Users of input files and of the library read `P = 2` and `G = 2 or 3`.
module contact_control_digit_terms
   use contact_base_error, only : error_type
   use contact_control_words, only : digit_of_word, key_table
   implicit none (type, external)
   private

   public :: tell_in_digits, tell_error_in_digits

contains

   !> A message with digits in the place of choices
   pure subroutine tell_in_digits(message, text)
      !> A sentence with choices such as `sequence = "initiate"`
      character(len=*), intent(in) :: message
      !> The sentence with P = 2 in their place
      character(len=:), allocatable, intent(out) :: text
      character(len=*), parameter :: key_letters = "abcdefghijklmnopqrstuvwxyz_.", before = ' = "'
      character(len=:), allocatable :: figures
      integer :: done, first, last, mark

      text = ""
      done = 0
      do
         mark = index(message(done + 1:), before)
         if (mark == 0) exit
         mark = done + mark
         first = done + verify(message(done + 1:mark - 1), key_letters, back=.true.) + 1
         call take_words(message, message(first:mark - 1), mark + len(before) - 1, figures, last)
         if (len(figures) > 0) then
            text = text // message(done + 1:first - 1) // figures
         else
            text = text // message(done + 1:last)
         end if
         done = last
      end do
      text = text // message(done + 1:)
   end subroutine tell_in_digits

   !> "G = 2, 3 or 5" for the words behind a key
   pure subroutine take_words(message, key, at, figures, last)
      character(len=*), intent(in) :: message
      !> iteration.solver, and where the quotation mark before its first word stands
      character(len=*), intent(in) :: key
      integer, intent(in) :: at
      !> "" when there is no such choice
      character(len=:), allocatable, intent(out) :: figures
      !> Where the words end
      integer, intent(out) :: last
      character(len=4), parameter :: between(2) = [character(len=4) :: ", ", " or "]
      character(len=:), allocatable :: separator
      character(len=2) :: name
      integer :: digit, k, length, next

      figures = ""
      separator = ""
      last = at
      next = at
      do
         length = index(message(next + 1:), '"') - 1
         if (length < 0) return
         call find_choice(key, message(next + 1:next + length), name, digit)
         if (digit < 0) return
         if (len(figures) == 0) figures = trim(name) // " = "
         figures = figures // separator // achar(iachar("0") + digit)
         last = next + length + 1
         do k = 1, size(between)
            length = len_trim(between(k)) + 1
            if (message(last + 1:min(len(message), last + length + 1)) == between(k)(:length) // '"') exit
         end do
         if (k > size(between)) return
         separator = between(k)(:length)
         next = last + length + 1
      end do
   end subroutine take_words

   !> The digit behind a word, of whichever module
   pure subroutine find_choice(key, word, name, digit)
      !> iteration.solver, and what stands in quotation marks behind it
      character(len=*), intent(in) :: key, word
      !> Letter of the digit
      character(len=2), intent(out) :: name
      !> -1 when there is none
      integer, intent(out) :: digit
      integer :: dot, row

      digit = -1
      name = ""
      dot = index(key, ".")
      do row = 1, size(key_table)
         if (key_table(row)%key /= key(dot + 1:) .or. key_table(row)%group /= key(:max(0, dot - 1))) cycle
         name = key_table(row)%name
         digit = max(digit_of_word(trim(name), word, 1), digit_of_word(trim(name), word, 3))
         return
      end do
   end subroutine find_choice

   !> An error with digits in the place of choices; nothing on success
   pure subroutine tell_error_in_digits(error)
      !> Unallocated: nothing is done
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: text

      if (.not. allocated(error)) return
      if (.not. allocated(error%message)) return
      call tell_in_digits(error%message, text)
      call move_alloc(text, error%message)
   end subroutine tell_error_in_digits
end module contact_control_digit_terms
