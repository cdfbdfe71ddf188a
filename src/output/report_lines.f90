!> Lines of the .out file: titles, and names with their values below
module contact_output_report_lines
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_collector, only : collector
   use contact_output_formats, only : formatted, heading
   implicit none (type, external)
   private

   public :: joined, show, write_row, write_title

contains

   !> Write a title below a blank line
   subroutine write_title(log, title, above)
      type(log_type), intent(inout) :: log
      !> The title, with a blank in front
      character(len=*), intent(in) :: title
      !> The blank line; default: no characters
      character(len=*), intent(in), optional :: above

      if (present(above)) then
         call log%result(above)
      else
         call log%result("")
      end if
      call log%result(title)
   end subroutine write_title

   !> Write names, and their values below
   subroutine write_row(log, names, values, forms)
      type(log_type), intent(inout) :: log
      !> Names of at most nine characters, separated by blanks
      character(len=*), intent(in) :: names
      !> Values in internal units
      real(wp), intent(in) :: values(:)
      !> Letters for the formats of the values, see `formatted`
      character(len=*), intent(in) :: forms
      character(len=len(heading(""))) :: line

      line = heading(names)
      call log%result(line(:len_trim(line)))
      call log%result("  " // formatted(values, forms))
   end subroutine write_row

   !> Write names of input numbers, and their values below
   subroutine show(log, numbers, forms, first)
      type(log_type), intent(inout) :: log
      !> Names and values in the order of the input
      type(collector), intent(in) :: numbers
      !> One letter for each number that is written, see `formatted`
      character(len=*), intent(in) :: forms
      !> Index of the first number that is written; default 1
      integer, intent(in), optional :: first
      integer :: before

      before = 0
      if (present(first)) before = first - 1
      associate (last => before + len(forms))
         call write_row(log, joined(numbers%names(before + 1:last)), numbers%values(before + 1:last), forms)
      end associate
   end subroutine show

   !> Names in one text, separated by blanks
   pure function joined(names) result(text)
      !> The names, without blanks
      character(len=*), intent(in) :: names(:)
      character(len=(1 + len(names))*size(names)) :: text
      integer :: k

      do k = 1, size(names)
         text((1 + len(names))*(k - 1) + 1:(1 + len(names))*k) = names(k)
      end do
   end function joined
end module contact_output_report_lines
