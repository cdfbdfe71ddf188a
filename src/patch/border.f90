!> Contact that reaches the border of the potential contact
!>
!> Elements beyond the border carry no pressure: if contact is cut off there, pressures are too high and the force is wrong.
module contact_patch_border
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_patch_problem, only : patch_problem
   use contact_patch_result, only : border_contact, patch_result
   implicit none (type, external)
   private

   public :: border_code, border_elements, find_border, side_names

   !> Names of the sides in the order of border_contact%side
   character(len=6), parameter :: side_names(4) = ["x low ", "x high", "y low ", "y high"]

contains

   !> Sides of the potential contact that cut off contact
   !>
   !> A side where the undeformed distance equals that of the neighbouring line of elements is the end of a body, such as a cylinder
   !> of finite length or a punch, and does not count. Directions with less than 3 elements have no border: they represent plane
   !> strain.
   pure subroutine find_border(problem, result)
      !> Grid and undeformed distance
      type(patch_problem), intent(in) :: problem
      !> Solved; `border` is set
      type(patch_result), intent(inout) :: result

      result%border = border_contact()
      if (result%ncon == 0) return
      result%border%elements = border_elements(result%division)
      if (result%border%elements == 0) return
      associate (mx => result%grid%mx, my => result%grid%my, pn => result%pn, h => problem%h, border => result%border)
         if (mx >= 3) then
            border%side(1) = is_cut(result%division(1, :), h(1, :), h(2, :))
            border%side(2) = is_cut(result%division(mx, :), h(mx, :), h(mx - 1, :))
            if (border%side(1)) border%pressure = maxval(pn(1, :))
            if (border%side(2)) border%pressure = max(border%pressure, maxval(pn(mx, :)))
         end if
         if (my >= 3) then
            border%side(3) = is_cut(result%division(:, 1), h(:, 1), h(:, 2))
            border%side(4) = is_cut(result%division(:, my), h(:, my), h(:, my - 1))
            if (border%side(3)) border%pressure = max(border%pressure, maxval(pn(:, 1)))
            if (border%side(4)) border%pressure = max(border%pressure, maxval(pn(:, my)))
         end if
      end associate
   end subroutine find_border

   !> Is there contact in a line of elements at the border where the undeformed distance differs from that of the next line?
   pure logical function is_cut(division, h, inside)
      !> Element states; undeformed distance in this line and in the next one [mm]
      integer, intent(in) :: division(:)
      real(wp), intent(in) :: h(:), inside(:)
      !> Relative differences up to this value are round-off [-]
      real(wp), parameter :: same = 1.0e-10_wp

      is_cut = any(division > element%exterior .and. abs(h - inside) > same*max(abs(h), abs(inside)))
   end function is_cut

   !> Number of elements in contact in the outer columns and rows; directions with less than 3 elements have no border
   pure integer function border_elements(division) result(n)
      !> Element states, shape (mx, my)
      integer, intent(in) :: division(:, :)
      integer :: mx, my, first, last

      mx = size(division, 1)
      my = size(division, 2)
      n = 0
      first = 1
      last = mx
      if (mx >= 3) then
         n = count(division([1, mx], :) > element%exterior)
         first = 2
         last = mx - 1
      end if
      if (my >= 3) n = n + count(division(first:last, [1, my]) > element%exterior)
   end function border_elements

   !> Sides and ends as a bit code: 1 x low, 2 x high, 4 y low, 8 y high, 16 and 32 low and high end of body 1, 64 and 128 those of
   !> body 2, 256 a hidden surface
   pure integer function border_code(border, mirrored) result(code)
      !> Sides of the grid, ends of bodies and hidden surfaces that contact reaches
      type(border_contact), intent(in) :: border
      !> Is the sign of y reversed for the caller? Default: no
      logical, intent(in), optional :: mirrored
      logical :: side(4), reached(9)
      integer :: k

      side = border%side
      if (present(mirrored)) then
         if (mirrored) side = side([1, 2, 4, 3])
      end if
      reached(1:4) = side
      reached(5:8) = reshape(border%surface_end, [4])
      reached(9) = border%hidden
      code = 0
      do k = 1, size(reached)
         if (reached(k)) code = ibset(code, k - 1)
      end do
   end function border_code
end module contact_patch_border
