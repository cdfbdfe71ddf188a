!> Archive that writes a case as an input file
module contact_output_file_writer
   use contact_base_kinds, only : wp
   use contact_base_output_file, only : output_file
   use contact_cases_archive, only : case_archive, item_kind
   use contact_control_digits, only : case_digits, word_text
   use contact_text_words, only : integer_text, replaced, to_real
   implicit none (type, external)
   private

   public :: file_writer, put_words

   !> Columns of a number, without the blank before the next one: sixteen digits identify most numbers, seventeen all
   integer, parameter :: width = 24
   !> Maximum length of a list that is written on one line, and numbers per line of longer lists
   integer, parameter :: short_list = 8, per_line = 4

   !> Writes the numbers of each line, followed by their names as a comment
   type, extends(case_archive) :: file_writer
      !> An open file
      type(output_file), pointer :: file => null()
   contains
      procedure :: end_line => write_line
      procedure :: list => write_list
   end type file_writer

contains

   !> Write the current items
   subroutine write_line(self)
      class(file_writer), intent(inout) :: self
      character(len=:), allocatable :: values, names
      integer :: k

      values = ""
      names = ""
      do k = 1, self%count
         associate (item => self%items(k))
            if (k > 1) values = values // " "
            select case (item%kind)
            case (item_kind%integer, item_kind%branch)
               values = values // integer_text(item%i)
            case (item_kind%text)
               values = values // "'" // replaced(item%s%value, "'", "''") // "'"
            case default
               values = values // numbers([item%r])
            end select
            names = names // " " // trim(item%name)
         end associate
      end do
      call put_line(self, values, names(2:))
      call self%finish_line()
   end subroutine write_line

   !> Write a list
   subroutine write_list(self, name, values, n, units, bounds)
      class(file_writer), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: n
      !> Units of input files
      character(len=*), intent(in), optional :: units(:)
      character(len=*), intent(in), optional :: bounds
      integer :: first, step

      associate (files_have => present(units), their_own => present(bounds))
         step = merge(n, per_line, n <= short_list)
         do first = 1, n, max(1, step)
            call put_line(self, numbers(values(first:min(n, first + step - 1))), name)
         end do
      end associate
   end subroutine write_list

   !> Write values, then their names as a comment
   subroutine put_line(self, values, names)
      class(file_writer), intent(in) :: self
      character(len=*), intent(in) :: values, names

      call self%file%line(" " // values // "   % " // names)
   end subroutine put_line

   !> Real numbers to full precision, padded with blanks
   pure function number_row(values) result(text)
      real(wp), intent(in) :: values(:)
      character(len=(width + 1)*size(values)) :: text
      character(len=width) :: word
      real(wp) :: back
      integer :: k, last, state

      text = ""
      last = -1
      do k = 1, size(values)
         write(word, "(ES23.15E3)") values(k)
         call to_real(trim(adjustl(word)), back, state)
         if (abs(back - values(k)) > 0.0_wp) write(word, "(ES24.16E3)") values(k)
         if (abs(values(k)) < 1.0e6_wp .and. abs(values(k)) >= 0.0_wp) then
            if (abs(values(k) - anint(values(k))) <= 0.0_wp) write(word, "(F10.1)") values(k)
         end if
         text(last + 2:) = adjustl(word)
         last = len_trim(text)
      end do
   end function number_row

   !> The same without trailing blanks
   pure function numbers(values) result(text)
      real(wp), intent(in) :: values(:)
      character(len=len_trim(number_row(values))) :: text

      text = number_row(values)
   end function numbers

   !> Write the three control words
   subroutine put_words(self, digits, module_number)
      class(file_writer), intent(in) :: self
      type(case_digits), intent(in) :: digits
      integer, intent(in) :: module_number

      if (module_number == 1) then
         call put_line(self, achar(iachar("0") + digits%c1) // word_text(digits, 1), "CPBTNFS")
      else
         call put_line(self, word_text(digits, 1), "PBTNFS")
      end if
      call put_line(self, word_text(digits, 2) // " " // integer_text(10*digits%gapwgt + digits%m2), "VLDCMZE, GAPWGT M2")
      ! without the digit X, because no fourth word is written
      call put_line(self, word_text(digits, 3), "HGIAOWR")
   end subroutine put_words
end module contact_output_file_writer
