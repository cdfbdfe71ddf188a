!> Outcome of a requested accuracy, in the .out file
module contact_output_accuracy_statement
   use contact_base_accuracy_report, only : accuracy_report
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_output_formats, only : scientific
   use contact_text_words, only : integer_text, real_text
   implicit none (type, external)
   private

   public :: write_accuracy

contains

   !> Write the lines of the .out file: requested accuracy, what was chosen, estimated error, and computing time
   subroutine write_accuracy(log, report)
      type(log_type), intent(inout) :: log
      !> Report of the case on its accuracy
      type(accuracy_report), intent(in) :: report
      character(len=:), allocatable :: line

      call log%result("")
      line = " REQUIRED ACCURACY: " // short(report%required) // " OF THE FORCES, "
      if (report%is_met) then
         line = line // "REACHED"
      else
         line = line // "NOT REACHED: " // trim(report%reason)
      end if
      call log%result(line)
      line = "   estimated error "
      if (report%estimated < 0.0_wp) then
         line = line // "unknown"
      else
         line = line // short(report%estimated)
      end if
      line = line // ", elements"
      if (report%elements(1) > 0) line = line // " " // integer_text(report%elements(1)) // " x " // &
         & integer_text(report%elements(2))
      line = line // " of " // real_text(report%sides(1)) // " x " // real_text(report%sides(2)) // " mm"
      if (report%order > 0) line = line // ", order " // integer_text(report%order)
      call log%result(line // ", EPS " // short(report%eps))
      if (report%method /= "") call log%result("   simplified methods allowed: " // trim(report%method))
      line = "   " // integer_text(report%levels) // " grid"
      if (report%levels /= 1) line = line // "s"
      call log%result(line // ", " // short(report%seconds) // " s, of which the last one " // short(report%last_seconds) // " s")
   end subroutine write_accuracy

   !> A number with two significant digits
   pure function short(number) result(text)
      real(wp), intent(in) :: number
      character(len=len_trim(adjustl(scientific(number, 10, 1)))) :: text

      text = adjustl(scientific(number, 10, 1))
   end function short
end module contact_output_accuracy_statement
