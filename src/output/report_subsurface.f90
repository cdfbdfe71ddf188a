!> Extremes of the subsurface stresses, and the values at all points, in the .out file
module contact_output_report_subsurface
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_spec, only : case_spec
   use contact_output_formats, only : fixed, formatted, general, whole
   use contact_output_report_lines, only : write_title
   use contact_patch_result, only : patch_result, subsurface_result
   implicit none (type, external)
   private

   public :: write_subsurface

contains

   !> Write all subsurface blocks; nothing if none were requested
   !>
   !> Depends on the output digit of the subsurface input only, not on that of the case.
   subroutine write_subsurface(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      integer :: i

      if (.not. log%out%is_open()) return
      if (.not. spec%has_stress .or. spec%subsurface%output < 1) return
      if (.not. allocated(result%subsurface)) return
      do i = 1, size(result%subsurface)
         call write_title(log, " SUBSURFACE STRESSES BLOCK" // whole(i, 3) // ":")
         call log%result(" ")
         if (allocated(result%subsurface(i)%sighyd)) then
            if (size(result%subsurface(i)%sighyd) > 0) then
               call write_extremes(log, result%subsurface(i))
               if (spec%subsurface%output >= 4) call write_points(log, result%subsurface(i))
            end if
         end if
      end do
   end subroutine write_subsurface

   !> Write the eight lines with extreme values; of equal values the first point is used
   subroutine write_extremes(log, block)
      type(log_type), intent(inout) :: log
      type(subsurface_result), intent(in) :: block

      call extreme("ABSMAX SIGHYD", block%sighyd, first_largest(abs(block%sighyd)))
      call extreme("MAX     SIGVM", block%sigvm, first_largest(block%sigvm))
      call extreme("MAX     SIGTR", block%sigtr, first_largest(block%sigtr))
      call extreme("MAX    SIGMA1", block%sigma1, first_largest(block%sigma1))
      call extreme("MIN    SIGMA3", block%sigma3, first_largest(-block%sigma3))
      call extreme("ABSMAX  SIGXX", block%stress(1, :), first_largest(abs(block%stress(1, :))))
      call extreme("ABSMAX  SIGYY", block%stress(4, :), first_largest(abs(block%stress(4, :))))
      call extreme("ABSMAX  SIGZZ", block%stress(6, :), first_largest(abs(block%stress(6, :))))

   contains

      subroutine extreme(label, values, point)
         character(len=13), intent(in) :: label
         real(wp), intent(in) :: values(:)
         integer, intent(in) :: point

         call log%result(" " // label // " =" // fixed(values(point), 10, 3) // " AT (X,Y,Z) = (" &
            & // fixed(block%position(1, point), 8, 3) // "," // fixed(block%position(2, point), 8, 3) // "," &
            & // fixed(block%position(3, point), 8, 3) // ")")
      end subroutine extreme
   end subroutine write_extremes

   !> First of the points whose values are the maximum up to round-off: in a symmetric contact, round-off would select one of
   !> several equal points
   pure integer function first_largest(values) result(point)
      real(wp), intent(in) :: values(:)
      real(wp), parameter :: rounding = 1.0e-10_wp
      integer :: largest

      largest = maxloc(values, dim=1)
      do point = 1, largest - 1
         if (values(point) >= values(largest) - rounding*abs(values(largest))) return
      end do
      point = largest
   end function first_largest

   !> Write displacements and stress tensor of every point
   subroutine write_points(log, block)
      type(log_type), intent(inout) :: log
      type(subsurface_result), intent(in) :: block
      !> Component of the stress list for each row and column of the tensor
      integer, parameter :: entry(3, 3) = reshape([1, 2, 3, 2, 4, 5, 3, 5, 6], [3, 3])
      integer :: i, point

      call log%result("")
      do point = 1, size(block%sighyd)
         call log%result(" Position (X,Y,Z):" // formatted(block%position(:, point), "G"))
         call log%result(" DIRECTION, DISPLACEMENT; ROW OF THE STRESS TENSOR")
         do i = 1, 3
            call log%result(whole(i, 3) // "  " // general(block%displacement(i, point), 12, 4) // "; " &
               & // formatted(block%stress(entry(:, i), point), "G"))
         end do
         call log%result("  SigHyd = " // general(block%sighyd(point), 12, 4) // ", SigVM = " &
            & // general(block%sigvm(point), 12, 4))
         call log%result("")
      end do
   end subroutine write_points
end module contact_output_report_subsurface
