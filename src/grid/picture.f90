!> Text picture of the element division
module contact_grid_picture
   use contact_base_choices, only : motion
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_grid_element_division, only : bounding_box, contact_box, element
   implicit none (type, external)
   private

   public :: picture_window, trace_picture, write_picture

   !> Flow trace level of intermediate element divisions
   integer, parameter :: picture_level = 9

   !> Maximum number of columns shown with a blank before each symbol
   integer, parameter :: spaced_columns = 46
   !> If the contact starts and ends within this number of columns of the border, the full range is shown
   integer, parameter :: near_border = 5
   !> Half the number of columns shown around the middle if there is no contact
   integer, parameter :: empty_half = 5

contains

   !> Write the picture of a solution, with its title and the rolling direction
   subroutine write_picture(log, division, motion_kind, chi)
      !> The picture is written to the .out file only
      type(log_type), intent(inout) :: log
      !> Element states, shape (mx, my)
      integer, intent(in) :: division(:, :)
      !> Member of motion; the rolling direction is shown for rolling
      integer, intent(in) :: motion_kind
      !> Rolling direction [rad]
      real(wp), intent(in) :: chi
      character(len=:), allocatable :: lines(:)
      character(len=40) :: last_line
      integer :: k

      call log%result("")
      call log%line(" FORM OF THE CONTACT, ADHESION AND SLIP-AREA`S:")
      call draw(division, lines)
      do k = 1, size(lines)
         call log%line(trim(lines(k)))
      end do
      last_line = "     X  -->"
      if (motion_kind == motion%transient_rolling .or. motion_kind == motion%steady_rolling) &
         & write(last_line, "(A, F6.2, A)") "     X  -->        Chi=", chi*180.0_wp/pi, " degrees"
      call log%line(trim(last_line))
   end subroutine write_picture

   !> Write an intermediate element division, for the most detailed flow trace
   subroutine trace_picture(log, division)
      !> Written from flow-trace level 9 on
      type(log_type), intent(inout) :: log
      !> Element states, shape (mx, my)
      integer, intent(in) :: division(:, :)
      character(len=:), allocatable :: lines(:)
      integer :: k

      if (.not. log%shows(picture_level)) return
      call draw(division, lines)
      do k = 1, size(lines)
         call log%trace(picture_level, trim(lines(k)))
      end do
   end subroutine trace_picture

   !> Rows of the picture, topmost first, and the column numbers below them
   pure subroutine draw(division, lines)
      integer, intent(in) :: division(:, :)
      character(len=:), allocatable, intent(out) :: lines(:)
      type(bounding_box) :: window
      integer :: ix, iy, k, step, shown, digits, position
      !> Columns of text before the first element
      integer, parameter :: margin = 8

      window = picture_window(division)
      shown = window%ix1 - window%ix0 + 1
      step = merge(2, 1, shown <= spaced_columns)
      digits = 1 + count(shown >= [10, 200])
      allocate(character(len=margin + step*shown) :: lines(window%iy1 - window%iy0 + 1 + digits))
      lines = ""
      do iy = window%iy1, window%iy0, -1
         associate (row => lines(window%iy1 - iy + 1))
            write(row, "(I6)") iy
            do ix = window%ix0, window%ix1
               position = margin + step*(ix - window%ix0 + 1)
               row(position:position) = symbol(division(ix, iy))
               if (row(position:position) == "." .and. any(ix == [window%ix0, window%ix1]) &
                  & .and. any(iy == [window%iy0, window%iy1])) row(position:position) = "o"
            end do
         end associate
      end do
      do k = 1, digits
         lines(size(lines) - k + 1)(margin + 1:) = column_digits(window, step, 10**(k - 1))
      end do
   end subroutine draw

   !> Part of the grid that is shown
   pure function picture_window(division) result(window)
      !> Element states, shape (mx, my)
      integer, intent(in) :: division(:, :)
      type(bounding_box) :: window

      window = contact_box(division)
      if (window%ix0 > window%ix1) then
         call around_middle(size(division, 1), window%ix0, window%ix1)
         call around_middle(size(division, 2), window%iy0, window%iy1)
      else
         call widen(size(division, 1), window%ix0, window%ix1)
         call widen(size(division, 2), window%iy0, window%iy1)
      end if
   end function picture_window

   !> Extend the range by one on each side; use the full range if the contact nearly fills it
   pure subroutine widen(size, first, last)
      integer, intent(in) :: size
      integer, intent(inout) :: first, last

      if (first <= near_border .and. last > size - near_border) then
         first = 1
         last = size
      else
         first = max(1, first - 1)
         last = min(size, last + 1)
      end if
   end subroutine widen

   !> A small range around the middle
   pure subroutine around_middle(size, first, last)
      integer, intent(in) :: size
      integer, intent(out) :: first, last

      first = max(1, (size + 1)/2 - empty_half)
      last = min(size, (size + 1)/2 + empty_half)
   end subroutine around_middle

   !> One decimal digit of the column numbers, shown where the lower digits are zero
   pure function column_digits(window, step, unit) result(line)
      type(bounding_box), intent(in) :: window
      !> Text columns per element; 1, 10 or 100
      integer, intent(in) :: step, unit
      character(len=step*(window%ix1 - window%ix0 + 1)) :: line
      integer :: ix, position

      line = ""
      do ix = window%ix0, window%ix1
         if (mod(ix, unit) /= 0) cycle
         position = step*(ix - window%ix0 + 1)
         line(position:position) = achar(48 + mod(ix/unit, 10))
      end do
   end function column_digits

   !> Symbol of an element state
   elemental character(len=1) function symbol(state)
      integer, intent(in) :: state

      if (state == element%exterior) then
         symbol = "."
      else if (state == element%adhesion) then
         symbol = "*"
      else if (state == element%slip) then
         symbol = "S"
      else
         symbol = "|"
      end if
   end function symbol
end module contact_grid_picture
