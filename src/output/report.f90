!> The .out file: banner, case lines, blocks of a case by output level, end of the run
module contact_output_report
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_spec, only : case_spec
   use contact_output_element_table, only : write_element_table
   use contact_output_formats, only : fixed, whole
   use contact_grid_picture, only : write_picture
   use contact_output_report_input, only : write_input
   use contact_output_report_result, only : write_accuracy, write_errors, write_sensitivities, write_solution_line, &
      & write_statistics, write_totals
   use contact_output_report_subsurface, only : write_subsurface
   use contact_patch_quantities, only : total_list
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: timer_line, write_banner, write_case, write_case_line, write_closing, write_end, write_subsurface

   !> Horizontal rule of the banner and of the timer table
   character(len=*), parameter :: banner_rule = "   " // repeat("-", 72)
   character(len=*), parameter :: timer_rule = "|" // repeat("-", 74) // "|"
   !> From this case number on the case line is two columns longer
   integer, parameter :: many_cases = 100000

   !> One line of the timer table
   type :: timer_line
      !> Name of the timer; the first 20 characters are written
      character(len=:), allocatable :: name
      !> Number of calls
      integer :: calls = 0
      !> Processor and elapsed time [s]
      real(wp) :: cpu = 0.0_wp, wall = 0.0_wp
   end type timer_line

contains

   !> Banner at the top of screen and file; public readers recognise the file by its second line
   subroutine write_banner(log, version)
      type(log_type), intent(inout) :: log
      !> Version number; omitted if absent
      character(len=*), intent(in), optional :: version

      call log%line(banner_rule)
      call log%line(framed("CONTACT - detailed investigation of 3D rolling and sliding contact"))
      call log%line(framed("with friction, by the boundary element method"))
      if (present(version)) then
         call log%line(framed(""))
         call log%line(framed("Version " // version // ", open source"))
      end if
      call log%line(banner_rule)
   end subroutine write_banner

   !> One line of the banner
   pure function framed(text) result(line)
      character(len=*), intent(in) :: text
      character(len=75) :: line

      line = "   |  " // text
      line(73:) = "  |"
   end function framed

   !> Write the line that opens a case
   subroutine write_case_line(log, case_number, reid)
      type(log_type), intent(inout) :: log
      !> Number of the case in the file or session, from 1
      integer, intent(in) :: case_number
      !> Result element; 0: none
      integer, intent(in) :: reid
      character(len=:), allocatable :: line

      line = " Case" // whole(case_number, merge(8, 6, case_number >= many_cases))
      if (reid > 0) line = line // ", result element" // whole(reid, 4)
      call log%line("")
      call log%line(line)
   end subroutine write_case_line

   !> Write everything between the flow trace and the subsurface blocks, according to the output level of the case
   subroutine write_case(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      type(total_list) :: totals

      if (.not. log%out%is_open() .and. log%screen == 0) return
      if (spec%output_level < 1) return
      if (log%out%is_open()) then
         if (spec%output_level >= 2) call write_input(log, spec, result)
         call write_totals(log, spec, result)
         if (spec%output_level >= 2) call write_sensitivities(log, spec, result)
         if (spec%output_level >= 2) call write_statistics(log, spec, result)
         if (allocated(result%errors)) then
            call result%totals(totals)
            call write_errors(log, result%errors%value, totals, trim(result%errors%reason))
         end if
         if (allocated(result%accuracy)) call write_accuracy(log, result%accuracy)
         call write_solution_line(log, spec, result, result%status)
      end if
      if (spec%output_level < 3 .or. .not. allocated(result%division)) return
      call write_picture(log, result%division, spec%motion, result%chi)
      if (log%out%is_open() .and. spec%output_level >= 5 .and. allocated(result%pn)) call write_element_table(log, spec, result)
   end subroutine write_case

   !> Write the number of threads and the timer table; percentages refer to the first timer
   subroutine write_end(log, threads, timers)
      type(log_type), intent(inout) :: log
      !> Number of threads used
      integer, intent(in) :: threads
      !> Timers, the total first; empty: no table
      type(timer_line), intent(in) :: timers(:)
      character(len=20) :: name
      integer :: i

      call log%result("")
      if (threads > 1) call log%result(" Parallel run using" // whole(threads, 3) // " threads")
      if (size(timers) == 0) return
      call log%result(" Time spent:")
      call log%result(timer_rule)
      call log%result("|Activity             |          |  processor time    |    elapsed time    |")
      call log%result("|                     |   calls  |    sec     |  %    |    sec     |  %    |")
      call log%result(timer_rule)
      do i = 1, size(timers)
         name = ""
         if (allocated(timers(i)%name)) name = timers(i)%name
         call log%result("|" // name // " |" // whole(timers(i)%calls, 9) // " |" // fixed(timers(i)%cpu, 11, 1) &
            & // " |" // fixed(percentage(timers(i)%cpu, timers(1)%cpu), 6, 1) // " |" &
            & // fixed(timers(i)%wall, 11, 1) // " |" // fixed(percentage(timers(i)%wall, timers(1)%wall), 6, 1) // " |")
      end do
      call log%result(timer_rule)
   end subroutine write_end

   !> Percentage of a total, 0 if the total is too small to be measured
   pure real(wp) function percentage(part, total)
      real(wp), intent(in) :: part, total
      percentage = 0.0_wp
      if (total > 0.0_wp) percentage = 100.0_wp*part/total
   end function percentage

   !> Write the last line on screen and in the file
   subroutine write_closing(log, failed)
      type(log_type), intent(inout) :: log
      !> Did an error end the run?
      logical, intent(in) :: failed

      if (failed) then
         call log%line(" CONTACT ended with errors.")
      else if (log%warnings > 0) then
         call log%line(" CONTACT ended normally, warnings:" // whole(log%warnings, 4))
      else
         call log%line(" CONTACT ended normally.")
      end if
   end subroutine write_closing
end module contact_output_report
