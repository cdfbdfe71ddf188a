!> Conditions on the grid of a case that continues the previous one, or keeps data that depend on the grid
!>
!> Readers of input report violations with their position, the library reports them on calculation. An unallocated text means that
!> there is no violation.
module contact_cases_continuation
   use contact_base_choices, only : grid_form, motion
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_geometry, only : build_grid
   use contact_cases_spec, only : grid_spec
   use contact_grid_potential_contact, only : is_same_side, potential_contact
   use contact_patch_result, only : hertz_result
   use contact_text_words, only : integer_text, real_text
   use contact_wheelrail_spec, only : search_spec
   implicit none (type, external)
   private

   public :: describe_coefficients, describe_grid, describe_search, frame_of, is_known, keeps_elements

contains

   !> Grid as far as the input defines it: without sides if the Hertz solution is needed first, or if the values define no grid
   function frame_of(grid) result(frame)
      !> Form, sides and numbers of elements of the case
      type(grid_spec), intent(in) :: grid
      type(potential_contact) :: frame
      type(hertz_result) :: hertz
      type(error_type), allocatable :: error

      if (grid%needs_geometry() .or. any(grid%form == [grid_form%hertz_axes, grid_form%hertz_line, grid_form%half_ellipses])) then
         hertz%aa = grid%aa
         hertz%bb = grid%bb
         call build_grid(grid, hertz, frame, error)
      end if
      if (frame%mx == 0 .or. allocated(error)) frame = potential_contact(mx=grid%mx, my=grid%my, dx=0.0_wp, dy=0.0_wp)
   end function frame_of

   !> Does the input define the position of the elements?
   pure logical function is_known(frame)
      !> Result of frame_of
      type(potential_contact), intent(in) :: frame

      is_known = frame%dx > 0.0_wp .and. frame%dy > 0.0_wp
   end function is_known

   !> Influence coefficients that are kept must be for elements of the same size, and must cover the grid
   pure subroutine describe_coefficients(frame, kept, text)
      !> The grid, and that of the coefficients; without elements if there are none
      type(potential_contact), intent(in) :: frame, kept
      !> Violation; unallocated if there is none
      character(len=:), allocatable, intent(out) :: text
      character(len=*), parameter :: whose = " of the influence coefficients that are kept"

      if (kept%mx == 0) return
      if (is_known(frame) .and. is_known(kept)) then
         if (.not. is_same_side(frame%dx, kept%dx)) then
            text = "DX = " // real_text(frame%dx) // " differs from the " // real_text(kept%dx) // whose
         else if (.not. is_same_side(frame%dy, kept%dy)) then
            text = "DY = " // real_text(frame%dy) // " differs from the " // real_text(kept%dy) // whose
         end if
      end if
      if (allocated(text)) return
      if (frame%mx > kept%mx) then
         text = "MX = " // integer_text(frame%mx) // " is above its upper bound, the " // integer_text(kept%mx) // whose
      else if (frame%my > kept%my) then
         text = "MY = " // integer_text(frame%my) // " is above its upper bound, the " // integer_text(kept%my) // whose
      end if
   end subroutine describe_coefficients

   !> A grid that continues a solution must have the same elements
   pure subroutine describe_grid(frame, old, text)
      !> The grid, and that of the previous case
      type(potential_contact), intent(in) :: frame, old
      !> Violation; unallocated if there is none
      character(len=:), allocatable, intent(out) :: text
      real(wp) :: shift(2)

      if (.not. (is_known(frame) .and. is_known(old))) return
      if (frame%continues(old)) return
      if (.not. is_same_side(frame%dx, old%dx)) then
         text = "DX = " // real_text(frame%dx) // " differs from the " // real_text(old%dx) // " of the previous case"
      else if (.not. is_same_side(frame%dy, old%dy)) then
         text = "DY = " // real_text(frame%dy) // " differs from the " // real_text(old%dy) // " of the previous case"
      else
         shift = frame%offset(old)
         if (abs(shift(1) - anint(shift(1))) >= abs(shift(2) - anint(shift(2)))) then
            text = "XC1, the centre of the first element, moves by " // real_text(frame%x(1) - old%x(1)) // &
               & ", which is not a whole multiple of DX = " // real_text(frame%dx)
         else
            text = "YC1, the centre of the first element, moves by " // real_text(frame%y(1) - old%y(1)) // &
               & ", which is not a whole multiple of DY = " // real_text(frame%dy)
         end if
      end if
      text = text // "; the solution of the previous case cannot be used"
   end subroutine describe_grid

   !> Do both grids have the same elements, as far as the input defines them?
   pure logical function keeps_elements(frame, old)
      !> Results of frame_of for this case and for the previous one
      type(potential_contact), intent(in) :: frame, old

      keeps_elements = frame%mx == old%mx .and. frame%my == old%my
      if (.not. (keeps_elements .and. is_known(frame) .and. is_known(old))) return
      keeps_elements = frame%continues(old) .and. all(nint(frame%offset(old)) == 0)
   end function keeps_elements

   !> A transient case of wheel on rail must have the same elements as the previous one
   pure subroutine describe_search(relative_motion, new, old, text)
      !> Member of motion
      integer, intent(in) :: relative_motion
      !> Search parameters of this case and of the previous one
      type(search_spec), intent(in) :: new, old
      !> Violation; unallocated if there is none
      character(len=:), allocatable, intent(out) :: text

      if (relative_motion /= motion%shift .and. relative_motion /= motion%transient_rolling) return
      if (is_same_side(new%dx, old%dx) .and. is_same_side(new%ds, old%ds)) return
      text = "DX or DS differ from those of the previous case, which this transient case continues"
   end subroutine describe_search
end module contact_cases_continuation
