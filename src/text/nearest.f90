!> The word of a list that is most similar to a mistyped word
module contact_text_nearest
   use contact_text_line_words, only : printable
   implicit none (type, external)
   private

   public :: edit_distance, nearest_word, unknown_word, words_of

   !> Maximum length of words that are compared
   integer, parameter :: longest = 32

contains

   !> Number of letters to be inserted, deleted, replaced or swapped with the next one to turn one word into the other
   pure integer function edit_distance(first, second) result(distance)
      !> At most 32 letters
      character(len=*), intent(in) :: first, second
      integer :: d(-1:longest, -1:longest), i, j

      d = 2*longest
      do i = 0, len(first)
         d(i, 0) = i
      end do
      do j = 0, len(second)
         d(0, j) = j
      end do
      do j = 1, len(second)
         do i = 1, len(first)
            d(i, j) = min(d(i - 1, j) + 1, d(i, j - 1) + 1, d(i - 1, j - 1) + merge(0, 1, first(i:i) == second(j:j)))
            if (min(i, j) < 2) cycle
            if (first(i - 1:i) == second(j:j) // second(j - 1:j - 1)) d(i, j) = min(d(i, j), d(i - 2, j - 2) + 1)
         end do
      end do
      distance = d(len(first), len(second))
   end function edit_distance

   !> Index of the most similar word in a list, 0 if none is similar: more than a third of its letters would change
   pure integer function nearest_word(word, list) result(place)
      !> Mistyped word
      character(len=*), intent(in) :: word
      !> Words padded with blanks; blank ones are skipped
      character(len=*), intent(in) :: list(:)
      integer :: best, distance, k, n

      place = 0
      if (len(word) == 0 .or. len(word) > longest) return
      best = huge(best)
      do k = 1, size(list)
         n = len_trim(list(k))
         if (n == 0 .or. n > longest) cycle
         distance = edit_distance(word, list(k)(:n))
         if (distance >= best .or. 3*distance > max(3, len(word), n)) cycle
         best = distance
         place = k
      end do
   end function nearest_word

   !> Words as listed in messages: "a", "b", "c"
   pure subroutine words_of(words, text)
      !> Words; blank ones are ignored
      character(len=*), intent(in) :: words(:)
      !> Text for messages
      character(len=:), allocatable, intent(out) :: text
      integer :: k, n

      text = ""
      n = 0
      do k = 1, size(words)
         if (words(k) == "") cycle
         n = n + 1
         if (n > 1) text = text // ", "
         text = text // '"' // trim(words(k)) // '"'
      end do
   end subroutine words_of

   !> Message about an unknown word: unknown motion "shfit"; did you mean "shift"? Accepted: "none", "shift"
   pure subroutine unknown_word(what, word, accepted, message)
      !> Kind of the word, for example the name of its key
      character(len=*), intent(in) :: what
      !> The word as given
      character(len=*), intent(in) :: word
      !> Accepted words; blank ones are ignored
      character(len=*), intent(in) :: accepted(:)
      !> One sentence or two
      character(len=:), allocatable, intent(out) :: message
      character(len=:), allocatable :: list
      integer :: place

      call words_of(accepted, list)
      message = "unknown " // what // ' "' // printable(word) // '"'
      place = nearest_word(word, accepted)
      if (place > 0) then
         message = message // '; did you mean "' // trim(accepted(place)) // '"? Accepted: ' // list
      else
         message = message // "; accepted: " // list
      end if
   end subroutine unknown_word
end module contact_text_nearest
