!> Warnings about contact at the border of the potential contact or at the end of a profile, with a sufficient grid
module contact_cases_border_warning
   use contact_base_choices, only : motion, pressure_model, time_link
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_geometry, only : undeformed_distance
   use contact_cases_spec, only : case_spec, grid_spec
   use contact_grid_element_division, only : bounding_box, contact_box
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_border, only : side_names
   use contact_patch_time_steps, only : link_time_steps
   use contact_patch_problem, only : patch_problem, patch_state
   use contact_patch_result, only : border_contact, patch_result
   use contact_patch_solve, only : solve_patch
   use contact_patch_workspace, only : patch_workspace, release_workspace
   use contact_text_words, only : integer_text, real_text
   use contact_wheelrail_result, only : buried_end, wheel_rail_result
   use contact_cases_distance, only : distance_form
   implicit none (type, external)
   private

   public :: beside_words, border_words, buried_words, is_same, warn_of_border, warn_of_buried_ends

   !> Names of the ends of profiles in increasing y of a right-hand pair; the inner end is next to the middle of the track
   character(len=5), parameter :: end_names(2) = ["inner", "outer"]

   !> Maximum length of the result of `buried_words`
   integer, parameter :: buried_length = 160

   !> Number of elements along each side of the grid on which the extent of the contact is estimated
   integer, parameter :: coarse = 40
   !> Number of exterior elements beside the contact area that a grid should have
   integer, parameter :: spare = 2

contains

   !> Warn of contact that is cut off
   subroutine warn_of_border(spec, problem, result, log, patch, advised)
      type(case_spec), intent(in) :: spec
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem
      !> Solution with `border`
      type(patch_result), intent(in) :: result
      type(log_type), intent(inout) :: log
      !> Index of the contact patch of wheel and rail; absent for module 3
      integer, intent(in), optional :: patch
      !> Grid for which a larger one was recommended last: as the estimate takes some milliseconds, it is not repeated for the same
      !> grid
      type(potential_contact), intent(inout), optional :: advised
      character(len=:), allocatable :: text, places, enough
      character(len=*), parameter :: cut_off = ": it is cut off, and pressures and forces are those of a smaller contact area"
      character(len=*), parameter :: needed = ". A larger potential contact is needed"

      associate (border => result%border)
         if (.not. (any(border%side) .or. any(border%surface_end) .or. border%hidden)) return
         call border_words(spec, border, places)
         if (.not. present(advised)) then
            text = "contact reaches " // places // cut_off
            if (present(patch)) text = "contact patch " // integer_text(patch) // ": " // text
            call log%warning(text)
         else if (is_same(advised, problem%grid)) then
            ! no further text is built, as this may occur in every case of a table
            call log%warning("contact reaches " // places // cut_off // needed)
         else
            call find_enough(spec, problem, result, enough)
            call log%warning("contact reaches " // places // cut_off // needed // enough)
            advised = problem%grid
         end if
      end associate
   end subroutine warn_of_border

   !> Are two grids equal?
   pure logical function is_same(a, b)
      !> Two grids
      type(potential_contact), intent(in) :: a, b

      is_same = a%mx == b%mx .and. a%my == b%my .and. all(abs([a%xl - b%xl, a%yl - b%yl, a%dx - b%dx, a%dy - b%dy]) <= 0.0_wp)
   end function is_same

   !> Warn of positions where wheel and rail overlap outside all patches
   subroutine warn_of_buried_ends(spec, wheel_rail, log)
      type(case_spec), intent(in) :: spec
      !> Result with the overlap found
      type(wheel_rail_result), intent(in) :: wheel_rail
      type(log_type), intent(inout) :: log
      character(len=buried_length) :: words
      integer :: k

      do k = 1, size(wheel_rail%buried)
         if (.not. wheel_rail%buried(k)%depth > 0.0_wp) cycle
         words = buried_words(spec, wheel_rail%buried(k), k)
         call log%warning(trim(words) // ". A real edge in contact there carries load, which is not included: use a longer profile &
            &of the wheel, or another position")
      end do
      if (.not. wheel_rail%beside%depth > 0.0_wp) return
      if (wheel_rail%beside%beyond_reach) then
         call log%warning(trim(beside_words(spec, wheel_rail%beside)) // ". The contact search extends to an eighth of the &
            &wheel's radius ahead of and behind the axle, farther below a yawed flank; a steep ramp, or a flank of more than 80 &
            &degrees, may be in contact beyond, and its load is not included")
      else
         call log%warning(trim(beside_words(spec, wheel_rail%beside)) // ". The search along the contact locus finds one position &
            &for each lateral position; the search over a grid (search.location = ""grid"") finds all")
      end if
   end subroutine warn_of_buried_ends

   !> A coordinate, rounded to a hundredth of a millimetre
   pure function place_text(value) result(text)
      !> Coordinate [mm]
      real(wp), intent(in) :: value
      character(len=len(real_text(0.01_wp*nint(100.0_wp*value)))) :: text

      text = real_text(0.01_wp*nint(100.0_wp*value))
   end function place_text

   !> Description of an end of the wheel's profile that is within the rail
   function buried_words(spec, buried, number) result(words)
      type(case_spec), intent(in) :: spec
      !> The end that was found
      type(buried_end), intent(in) :: buried
      !> 1: inner end, 2: outer end
      integer, intent(in) :: number
      character(len=buried_length) :: words
      real(wp) :: y

      y = buried%place(2)
      if (spec%wheel_rail%left) y = -y
      words = "the " // end_names(number) // " end of the wheel profile is " // real_text(buried%depth) // " mm inside the &
         &rail, outside all contact patches, at x = " // place_text(buried%place(1)) // ", y = " // place_text(y) // ", z = " // &
         & place_text(buried%place(3)) // " mm"
   end function buried_words

   !> Description of an overlap of wheel and rail at another position along the track
   function beside_words(spec, beside) result(words)
      type(case_spec), intent(in) :: spec
      !> The overlap that was found
      type(buried_end), intent(in) :: beside
      character(len=buried_length) :: words
      real(wp) :: y

      y = beside%place(2)
      if (spec%wheel_rail%left) y = -y
      words = "wheel and rail overlap by " // real_text(beside%depth) // " mm at x = " // place_text(beside%place(1)) // &
         & ", y = " // place_text(y) // " mm as well, where no contact patch is"
   end function beside_words

   !> Description of sides and ends; blank if there are none
   subroutine border_words(spec, border, words)
      type(case_spec), intent(in) :: spec
      !> Sides of the grid and ends of profiles that contact reaches
      type(border_contact), intent(in) :: border
      !> Text for messages
      character(len=:), allocatable, intent(out) :: words
      character(len=5), parameter :: body_names(2) = ["rail ", "wheel"]
      character(len=300) :: text
      logical :: side(4)
      integer :: body, k, length

      side = border%side
      if (allocated(spec%wheel_rail)) then
         if (spec%wheel_rail%left) side = side([1, 2, 4, 3])
      end if
      length = 0
      if (any(side)) then
         call add("the border of the potential contact (")
         do k = 1, 4
            if (.not. side(k)) cycle
            call add(side_names(k)(:len_trim(side_names(k))))
            if (any(side(k + 1:))) call add(", ")
         end do
         call add(")")
      end if
      do body = 1, 2
         do k = 1, 2
            if (.not. border%surface_end(k, body)) cycle
            if (length > 0) call add(", ")
            call add("the " // end_names(k) // " end of the ")
            call add(body_names(body)(:len_trim(body_names(body))))
            call add(" profile")
         end do
      end do
      if (border%hidden) then
         if (length > 0) call add(", ")
         call add("a part of the profiles that cannot be seen from the plane of the contact")
      end if
      words = text(:length)

   contains

      subroutine add(piece)
         character(len=*), intent(in) :: piece

         text(length + 1:length + len(piece)) = piece
         length = length + len(piece)
      end subroutine add
   end subroutine border_words

   !> Describe a sufficient grid, if the geometry is known beyond the potential contact
   subroutine find_enough(spec, problem, result, text)
      type(case_spec), intent(in) :: spec
      type(patch_problem), intent(in) :: problem
      type(patch_result), intent(in) :: result
      !> Remainder of a sentence, blank if no grid is known
      character(len=:), allocatable, intent(out) :: text
      type(potential_contact) :: extent
      integer :: low(2), high(2)
      logical :: found

      text = ""
      if (allocated(result%hertz)) then
         text = "; SCALE = " // real_text(enough_scale(spec%grid)) // " would be enough"
         return
      end if
      if (problem%pressure /= pressure_model%full .or. spec%geometry%form == distance_form%elementwise) return
      if (.not. problem%model%is_flat() .or. allocated(problem%model%memory)) return
      call estimate_extent(spec, problem, result, extent, found)
      if (.not. found) return
      associate (grid => problem%grid)
         ! sides that are free now may not be so for the complete contact
         low = max(0, spare + ceiling([(grid%xl - extent%xl)/grid%dx, (grid%yl - extent%yl)/grid%dy]))
         high = max(0, spare + ceiling([(extent%xl + extent%mx*extent%dx - grid%xl)/grid%dx - grid%mx, &
            & (extent%yl + extent%my*extent%dy - grid%yl)/grid%dy - grid%my]))
         where ([grid%mx, grid%my] < 3)
            low = 0
            high = 0
         end where
         text = "; with elements of this size MX = " // integer_text(grid%mx + low(1) + high(1)) // ", MY = " // &
            & integer_text(grid%my + low(2) + high(2)) // ", XL = " // real_text(grid%xl - low(1)*grid%dx) // ", YL = " // &
            & real_text(grid%yl - low(2)*grid%dy) // " would be enough"
      end associate
   end subroutine find_enough

   !> Size of a grid relative to a Hertzian ellipse that leaves exterior elements beside it [-]
   pure real(wp) function enough_scale(grid) result(scale)
      type(grid_spec), intent(in) :: grid
      integer :: n

      n = grid%mx
      if (grid%my >= 3) n = min(n, grid%my)
      scale = 2.0_wp
      if (n > 2*(spare + 1)) scale = real(n, wp)/(n - (spare + 1))
      scale = 0.01_wp*ceiling(100.0_wp*scale)
   end function enough_scale

   !> Extent of the contact without the limit of the potential contact, as a grid of one element with a margin
   !>
   !> The contact area is within the area where the undeformed distance is below the approach. With prescribed force the approach of
   !> the present solution is an upper bound, because part of the contact is missing. The frictionless problem is solved on coarse
   !> grids, first on this whole area, then around the contact area found there.
   subroutine estimate_extent(spec, problem, result, extent, found)
      type(case_spec), intent(in) :: spec
      type(patch_problem), intent(in) :: problem
      type(patch_result), intent(in) :: result
      type(potential_contact), intent(out) :: extent
      logical, intent(out) :: found
      !> Maximum number of steps by half of the width until the surfaces are apart
      integer, parameter :: max_steps = 30
      !> Maximum number of solutions on coarse grids until one has exterior elements at its border
      integer, parameter :: max_passes = 8
      type(patch_problem) :: trial
      type(potential_contact) :: grid
      type(bounding_box) :: box
      type(error_type), allocatable :: error
      real(wp) :: span(2)
      logical :: closed(4)
      integer :: k

      found = .false.
      call set_normal_problem(problem, trial)
      grid = with_coarse_elements(problem%grid)
      do k = 1, max_steps
         call undeformed_distance(spec%geometry, grid, h=trial%h, error=error)
         if (allocated(error)) return
         associate (h => trial%h, pen => result%pen)
            closed = [grid%mx < 3 .or. all(h(1, :) > pen), grid%mx < 3 .or. all(h(grid%mx, :) > pen), &
               & grid%my < 3 .or. all(h(:, 1) > pen), grid%my < 3 .or. all(h(:, grid%my) > pen)]
         end associate
         if (all(closed)) exit
         span = 0.5_wp*[grid%mx*grid%dx, grid%my*grid%dy]
         if (.not. closed(1)) grid%xl = grid%xl - span(1)
         if (.not. closed(3)) grid%yl = grid%yl - span(2)
         grid%dx = grid%dx + count(.not. closed(1:2))*span(1)/grid%mx
         grid%dy = grid%dy + count(.not. closed(3:4))*span(2)/grid%my
      end do
      if (.not. all(closed)) return
      do k = 1, max_passes
         trial%grid = grid
         call undeformed_distance(spec%geometry, grid, h=trial%h, error=error)
         if (allocated(error)) return
         call find_contact(trial, box, found)
         if (.not. found) return
         extent = around(grid, box, 1)
         found = k > 1 .and. (grid%mx < 3 .or. (box%ix0 > 1 .and. box%ix1 < grid%mx)) &
            & .and. (grid%my < 3 .or. (box%iy0 > 1 .and. box%iy1 < grid%my))
         if (found) return
         grid = around(grid, box, 3)
      end do
   end subroutine estimate_extent

   !> Box of elements, extended on each side, divided into the same number of elements; directions with less than 3 elements do not
   !> change
   pure function around(grid, box, more) result(new)
      type(potential_contact), intent(in) :: grid
      type(bounding_box), intent(in) :: box
      !> Additional elements on each side
      integer, intent(in) :: more
      type(potential_contact) :: new

      new = grid
      if (grid%mx >= 3) then
         new%xl = grid%xl + (box%ix0 - 1 - more)*grid%dx
         new%dx = grid%dx*(box%ix1 - box%ix0 + 1 + 2*more)/grid%mx
      end if
      if (grid%my >= 3) then
         new%yl = grid%yl + (box%iy0 - 1 - more)*grid%dy
         new%dy = grid%dy*(box%iy1 - box%iy0 + 1 + 2*more)/grid%my
      end if
   end function around

   !> The same potential contact with few elements
   pure function with_coarse_elements(grid) result(new)
      type(potential_contact), intent(in) :: grid
      type(potential_contact) :: new

      new = grid
      if (grid%mx >= 3) new%mx = coarse
      if (grid%my >= 3) new%my = coarse
      new%dx = grid%dx*grid%mx/new%mx
      new%dy = grid%dy*grid%my/new%my
   end function with_coarse_elements

   !> The normal problem alone, without data of motion and grid
   subroutine set_normal_problem(problem, trial)
      type(patch_problem), intent(in) :: problem
      type(patch_problem), intent(out) :: trial

      trial%model = problem%model
      trial%motion = motion%none
      trial%pressure = problem%pressure
      trial%force_prescribed = problem%force_prescribed
      trial%fn = problem%fn
      trial%pen = problem%pen
   end subroutine set_normal_problem

   !> Bounding box of the elements in contact
   subroutine find_contact(problem, box, found)
      type(patch_problem), intent(in) :: problem
      type(bounding_box), intent(out) :: box
      logical, intent(out) :: found
      type(patch_state) :: state
      type(patch_workspace) :: workspace
      type(patch_result) :: result
      type(log_type) :: silent
      type(error_type), allocatable :: error

      found = .false.
      call link_time_steps(problem, time_link%initiate, state, error)
      if (.not. allocated(error)) call solve_patch(problem, state, workspace, silent, result, error)
      if (.not. allocated(error)) then
         box = contact_box(result%division)
         found = result%normal%succeeded() .and. result%ncon > 0
      end if
      call release_workspace(workspace)
   end subroutine find_contact
end module contact_cases_border_warning
