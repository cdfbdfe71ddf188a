!> Messages with choices given as control digits
!>
!> Below the reader, messages name choices as the readable format does: `sequence = "initiate"`, or, if there are several,
!> `iteration.solver = "convex_gs" or "gauss_seidel"`. For users of input files and of the library they are replaced by digits: `P
!> = 2` and `G = 2 or 3`.
module contact_control_digit_terms
   use contact_base_error, only : error_type
   use contact_control_words, only : digit_of_word, key_table
   implicit none (type, external)
   private

   public :: translate_to_digits, translate_error_to_digits

contains

   !> Replace the choices in a message by digits
   pure subroutine translate_to_digits(message, text)
      !> Sentence with choices such as `sequence = "initiate"`
      character(len=*), intent(in) :: message
      !> The sentence with digits, `P = 2`
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
         call convert_words(message, message(first:mark - 1), mark + len(before) - 1, figures, last)
         if (len(figures) > 0) then
            text = text // message(done + 1:first - 1) // figures
         else
            text = text // message(done + 1:last)
         end if
         done = last
      end do
      text = text // message(done + 1:)
   end subroutine translate_to_digits

   !> Digits for the words of a key, "G = 2, 3 or 5"
   pure subroutine convert_words(message, key, at, figures, last)
      character(len=*), intent(in) :: message
      !> Key, such as iteration.solver, and position of the quotation mark before its first word
      character(len=*), intent(in) :: key
      integer, intent(in) :: at
      !> Empty if there is no such choice
      character(len=:), allocatable, intent(out) :: figures
      !> Position of the end of the words
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
   end subroutine convert_words

   !> Find the digit of a word, in either module
   pure subroutine find_choice(key, word, name, digit)
      !> Key, such as iteration.solver, and the word in quotation marks after it
      character(len=*), intent(in) :: key, word
      !> Letter of the digit
      character(len=2), intent(out) :: name
      !> -1: none
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

   !> Replace the choices in the message of an error by digits
   pure subroutine translate_error_to_digits(error)
      !> Unchanged if unallocated
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: text

      if (.not. allocated(error)) return
      if (.not. allocated(error%message)) return
      call translate_to_digits(error%message, text)
      call move_alloc(text, error%message)
   end subroutine translate_error_to_digits
end module contact_control_digit_terms
