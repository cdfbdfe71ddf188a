!> Words of a line of an input file: separators, quotes and comments; and pieces of lines for messages
module contact_text_line_words
   implicit none (type, external)
   private

   public :: find_word, printable, quote, single_quotes, word_place

   !> Position of a word
   type :: word_place
      !> First and last character in the text, without the quotes around it; first = 0 when there is none
      integer :: first = 0, last = 0
      !> Position after the word
      integer :: next = 0
      !> Is it quoted, and was the closing quote found?
      logical :: quoted = .false., closed = .false.
   end type word_place

   !> Separators of words: blank, tab, comma, equals sign, and control characters
   character(len=*), parameter :: separators = " ,=" // achar(9) // achar(13) // achar(11) // achar(12) // achar(0)
   !> Beginning and end of a text, beginning of a comment
   character(len=*), parameter :: quote = "'", comment = "%"
   !> Maximum length of a line quoted in messages
   integer, parameter :: longest_echo = 80

contains

   !> Next word of a line, from a given position on
   pure type(word_place) function find_word(text, from) result(place)
      !> The text up to the end of the line
      character(len=*), intent(in) :: text
      !> First character that may belong to the word
      integer, intent(in) :: from
      integer :: k

      do k = from, len(text)
         if (scan(text(k:k), separators) == 0) exit
      end do
      if (k > len(text)) return
      if (text(k:k) == comment) return

      if (text(k:k) == quote) then
         place%quoted = .true.
         place%first = k + 1
         ! two quotes in succession represent a quote within the text
         do k = place%first, len(text)
            if (text(k:k) /= quote) cycle
            place%closed = .not. place%closed
            if (k == len(text)) exit
            if (place%closed .and. text(k + 1:k + 1) /= quote) exit
         end do
         place%last = merge(k - 1, len(text), place%closed)
         place%next = place%last + 2
         return
      end if
      place%first = k
      do k = place%first, len(text)
         if (scan(text(k:k), separators // comment) > 0) exit
      end do
      place%last = k - 1
      place%next = k
   end function find_word

   !> Number of pairs of quotes in succession
   pure integer function pairs(text)
      character(len=*), intent(in) :: text
      integer :: k

      pairs = 0
      k = 1
      do while (k < len(text))
         if (text(k:k + 1) == quote // quote) then
            pairs = pairs + 1
            k = k + 1
         end if
         k = k + 1
      end do
   end function pairs

   !> The content of a quoted text, with one quote for each pair of quotes
   pure function single_quotes(text) result(content)
      !> Text between its outer quotes
      character(len=*), intent(in) :: text
      character(len=len(text) - pairs(text)) :: content
      integer :: i, k

      k = 1
      do i = 1, len(content)
         content(i:i) = text(k:k)
         if (k < len(text)) k = k + merge(1, 0, text(k:k + 1) == quote // quote)
         k = k + 1
      end do
   end function single_quotes

   !> A piece of a line without control characters, shortened for a message; padded with blanks
   pure function echo(piece) result(text)
      character(len=*), intent(in) :: piece
      character(len=longest_echo + 3) :: text
      integer :: k

      text = adjustl(piece)
      if (len_trim(adjustl(piece)) > longest_echo) text(longest_echo + 1:) = "..."
      do k = 1, len(text)
         if (iachar(text(k:k)) < 32 .or. iachar(text(k:k)) == 127) text(k:k) = " "
      end do
   end function echo

   !> The same without trailing blanks
   pure function printable(piece) result(text)
      !> Part of an input
      character(len=*), intent(in) :: piece
      character(len=len_trim(echo(piece))) :: text

      text = echo(piece)
   end function printable
end module contact_text_line_words
