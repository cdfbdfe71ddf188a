!> Table of tractions and slip per element in the .out file
module contact_output_element_table
   use contact_base_choices, only : motion
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_spec, only : case_spec
   use contact_grid_element_division, only : list_elements
   use contact_numeric_pieces, only : pieces_of
   use contact_output_formats, only : fixed, formatted, general, whole
   use contact_output_report_lines, only : write_title
   use contact_patch_quantities, only : element_field
   use contact_patch_result, only : patch_result
   use contact_text_words, only : capital
   implicit none (type, external)
   private

   public :: write_element_table

   !> Width of a column, of all columns without motion, of those before other fields, and of a line with ten of these at most. Lines
   !> keep the blanks at their end, as those of the established program do
   integer, parameter :: width = 11, still_columns = 59, first_columns = 102, longest_line = first_columns + 10*width
   !> Lines that are made together; chosen
   integer, parameter :: lines_of_block = 4096

contains

   !> Write the table for the elements in contact, at output level 6 for all elements
   subroutine write_element_table(log, spec, result)
      type(log_type), intent(inout) :: log
      type(case_spec), intent(in) :: spec
      type(patch_result), target, intent(in) :: result
      type(element_field), allocatable :: fields(:)
      !> Lines of a block, and all elements
      character(len=longest_line), allocatable :: lines(:)
      integer, allocatable :: at(:, :)
      integer :: first, k, last_row, n, length

      call result%fields(fields)
      fields = pack(fields, has_column(fields))
      length = merge(still_columns, first_columns + width*size(fields), spec%motion == motion%none)
      call write_table_head(log, spec%motion, fields)
      call list_elements(result%division, spec%output_level >= 6, at)
      allocate(lines(min(lines_of_block, size(at, 2))))
      last_row = 0
      do first = 1, size(at, 2), lines_of_block
         n = min(lines_of_block, size(at, 2) - first + 1)
         call set_lines(spec%motion, result, fields, at(:, first:first + n - 1), lines)
         do k = 1, n
            associate (row => at(2, first + k - 1))
               if (row /= last_row) then
                  call write_title(log, " Y = " // general(result%grid%y(row), 12, 4) // " ROW" // whole(row, 3) &
                     & // " OF THE POTENTIAL CONTACT")
                  call log%result("")
                  last_row = row
               end if
            end associate
            call log%result(lines(k)(:length))
         end do
      end do
   end subroutine write_element_table

   !> Make the lines of elements; threads share those of large grids
   subroutine set_lines(motion_kind, result, fields, at, lines)
      !> Member of `motion`
      integer, intent(in) :: motion_kind
      type(patch_result), intent(in) :: result
      !> Fields with a separate column
      type(element_field), intent(in) :: fields(:)
      !> Column and row of each element
      integer, intent(in) :: at(:, :)
      character(len=longest_line), intent(inout) :: lines(:)
      integer :: k

      if (pieces_of(result%grid%npot()) == 1) then
         do k = 1, size(at, 2)
            call set_line(motion_kind, result, fields, at(1, k), at(2, k), lines(k))
         end do
      else
         !$omp parallel do
         do k = 1, size(at, 2)
            call set_line(motion_kind, result, fields, at(1, k), at(2, k), lines(k))
         end do
         !$omp end parallel do
      end if
   end subroutine set_lines

   !> Title, explanation and column heading
   subroutine write_table_head(log, motion_kind, fields)
      type(log_type), intent(inout) :: log
      !> Member of `motion`
      integer, intent(in) :: motion_kind
      !> Fields with a separate column
      type(element_field), intent(in) :: fields(:)
      character(len=1 + width*size(fields)) :: more
      integer :: k

      more = ""
      do k = 1, size(fields)
         more(2 + width*(k - 1):1 + width*k) = repeat(" ", width - len_trim(fields(k)%name)) // capital(fields(k)%name)
      end do
      call write_title(log, " QUANTITIES DISTRIBUTED OVER THE CONTACT AREA:")
      call log%result(" H-PEN: UNDEFORMED DISTANCE MINUS APPROACH [MM], X [MM], PN: NORMAL PRESSURE [N/MM2],")
      if (motion_kind == motion%none) then
         call log%result(" PT: TANGENTIAL TRACTION ON BODY 1 [N/MM2], ARG: ITS DIRECTION IN DEGREES.")
         call log%result("")
         call log%result("     X          H-PEN        PN       ABS(PT)        ARG(PT)")
         return
      end if
      call log%result(" PT: TANGENTIAL TRACTION ON BODY 1 [N/MM2], ARG: ITS DIRECTION IN DEGREES, TRCBND: ITS BOUND,")
      if (motion_kind == motion%shift) then
         call log%result(" S: SLIP DISTANCE [MM], OPPOSITE TO PT, RIGID SHIFT: SHIFT WITHOUT DEFORMATION [MM].")
         call log%result("")
         call log%result("     X         H-PEN        PN      TRCBND    ABS(PT)     ARG(PT;-S)  ABS(S)      " &
            & // "RIGID SHIFT(X, Y)")
      else
         call log%result(" S: RELATIVE SLIP VELOCITY [-], OPPOSITE TO PT, RIGID SLIP: THE SAME WITHOUT DEFORMATION.")
         call log%result("")
         call log%result("     X         H-PEN        PN      TRCBND    ABS(PT)     ARG(PT;-S)  ABS(S)      " &
            & // "RIGID SLIP(X, Y)" // trim(more))
      end if
   end subroutine write_table_head

   !> Does a field have a separate column?
   elemental logical function has_column(field)
      type(element_field), intent(in) :: field

      has_column = associated(field%values) .and. field%figures > 0
   end function has_column

   !> The line of an element; slip per step is converted to relative slip
   pure subroutine set_line(motion_kind, result, fields, ix, iy, line)
      !> Member of `motion`
      integer, intent(in) :: motion_kind
      type(patch_result), intent(in) :: result
      !> Fields with a separate column
      type(element_field), intent(in) :: fields(:)
      integer, intent(in) :: ix, iy
      character(len=longest_line), intent(inout) :: line
      real(wp) :: px, py, traction, angle, gap, bound
      integer :: k

      px = result%px(ix, iy)
      py = result%py(ix, iy)
      traction = hypot(px, py)
      angle = 0.0_wp
      if (traction > 0.0_wp) angle = atan2(py + 0.0_wp, px)*180.0_wp/pi
      gap = result%h(ix, iy) - result%pen
      bound = result%mu(ix, iy)*result%pn(ix, iy)
      if (allocated(result%tau_c)) bound = min(bound, result%tau_c(ix, iy))
      if (motion_kind == motion%none) then
         line = " " // formatted([result%grid%x(ix), gap, result%pn(ix, iy), traction], "G") // fixed(angle, 10, 1)
         return
      end if
      line = " " // general(result%grid%x(ix), 12, 4) // general(gap, 11, 3) // general(result%pn(ix, iy), 11, 3) &
         & // general(bound, 11, 3) // general(traction, 11, 3) // fixed(angle, 10, 1) &
         & // "  " // general(hypot(result%sx(ix, iy), result%sy(ix, iy))/result%dq, 11, 3) &
         & // general(result%wx(ix, iy)/result%dq, 11, 3) // general(result%wy(ix, iy)/result%dq, 11, 3)
      do k = 1, size(fields)
         line(first_columns + width*(k - 1) + 1:first_columns + width*k) = general(fields(k)%values(ix, iy)/fields(k)%divisor, &
            & width, fields(k)%figures)
      end do
   end subroutine set_line
end module contact_output_element_table
