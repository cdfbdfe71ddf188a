!> Cases as input files, so that cases solved through the library can be solved by the program
module contact_output_input_case
   use contact_base_choices, only : planform_choice, pressure_model, slip_source
   use contact_cases_spec, only : case_spec, grid_spec, part_source
   use contact_cases_whole_case, only : visit_case
   use contact_control_translation, only : digits_of
   use contact_grid_element_division, only : bounding_box, contact_box
   use contact_base_output_file, only : output_file
   use contact_output_file_writer, only : file_writer, put_words
   use contact_output_unwritten, only : unwritten_setting, unwritten_settings
   use contact_patch_problem, only : traction_fields
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: write_contact_case, write_input_case

   !> Number of elements kept around the contact area, and side of the window that is kept without contact [elements]
   integer, parameter :: margin = 2, empty_window = 5

contains

   !> Write a case: remarks on settings that the file cannot express, control words, and the groups that the case gives
   subroutine write_input_case(file, spec)
      !> An open file
      type(output_file), target, intent(in) :: file
      !> The case; names of profiles are written unchanged
      type(case_spec), intent(in) :: spec
      type(file_writer) :: a
      type(case_spec), target :: written

      call write_remarks(file, spec)
      a%file => file
      written = spec
      ! not in the format
      written%has_wear = .false.
      call put_words(a, digits_of(spec), module_number=merge(1, 3, allocated(spec%wheel_rail)))
      call visit_case(a, written)
   end subroutine write_input_case

   !> Write a remark for each setting of a case that the file cannot express
   subroutine write_remarks(file, spec)
      type(output_file), intent(in) :: file
      type(case_spec), intent(in) :: spec
      type(unwritten_setting), allocatable :: settings(:)
      integer :: k

      settings = unwritten_settings(spec)
      do k = 1, size(settings)
         associate (setting => settings(k))
            if (setting%option /= "") then
               call file%line(" % needs " // trim(setting%option))
            else if (setting%fact /= "") then
               call file%line(" % not in this file: " // trim(setting%fact))
            end if
         end associate
      end do
   end subroutine write_remarks

   !> Write a solved case of module 3; a grid that is not Hertzian is cut to the contact areas with a margin
   subroutine write_contact_case(file, spec, result, previous)
      type(output_file), target, intent(in) :: file
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      !> Time step that the case continues, on its grid; without contact if there is none
      type(traction_fields), intent(in) :: previous
      type(case_spec) :: written

      written = spec
      written%has_stress = .false.
      written%ends_module = .true.
      written%parts%grid = part_source%given
      written%parts%geometry = part_source%given
      if (all(spec%slip_source /= [slip_source%no_spin_x, slip_source%no_spin_y])) then
         written%parts%extra_slip = part_source%given
         if (.not. allocated(spec%extra_slip)) written%slip_source = slip_source%none
      end if
      ! the state of materials and temperatures, regardless of whether they were set for this case
      if (spec%has_damping) written%parts%damping = part_source%given
      written%parts%heat = part_source%given
      ! planforms cannot be set through the library
      written%geometry%planform = planform_choice%unrestricted
      if (spec%grid%needs_geometry()) call cut_to_contact(written, result, previous)
      call write_input_case(file, written)
   end subroutine write_contact_case

   !> Remove elements away from the contact area from all data that are given per element
   subroutine cut_to_contact(spec, result, previous)
      type(case_spec), intent(inout) :: spec
      type(patch_result), intent(in) :: result
      !> Time step that the case continues, whose contact area must stay in the grid
      type(traction_fields), intent(in) :: previous
      type(bounding_box) :: box
      integer :: ix, iy, k
      integer, allocatable :: elements(:)

      box = bounding_box(1, result%grid%mx, 1, result%grid%my)
      ! approximate methods use the interpenetration all around the contact area, and the length of the grid
      if (allocated(result%division) .and. all(spec%pressure /= [pressure_model%kpec, pressure_model%analyn])) &
         & box = kept_window(result%division, previous%division)
      associate (grid => result%grid)
         elements = [((ix + grid%mx*(iy - 1), ix = box%ix0, box%ix1), iy = box%iy0, box%iy1)]
         spec%grid = grid_spec(form=1, mx=box%ix1 - box%ix0 + 1, my=box%iy1 - box%iy0 + 1, &
            & xl=grid%xl + (box%ix0 - 1)*grid%dx, yl=grid%yl + (box%iy0 - 1)*grid%dy, dx=grid%dx, dy=grid%dy)
      end associate
      if (allocated(spec%geometry%h)) spec%geometry%h = [(spec%geometry%h(elements(k)), k = 1, size(elements))]
      if (allocated(spec%extra_slip)) spec%extra_slip = spec%extra_slip(:, elements)
   end subroutine cut_to_contact

   !> Bounds of both contact areas with a margin, within the grid; without contact its centre
   pure function kept_window(division, previous) result(box)
      !> Element states, shape (mx, my)
      integer, intent(in) :: division(:, :)
      !> Those of the previous time step; unallocated, or of another shape, if there is none
      integer, allocatable, intent(in) :: previous(:, :)
      type(bounding_box) :: box
      integer :: n(2)

      n = shape(division)
      box = contact_box(division)
      if (allocated(previous)) then
         if (all(shape(previous) == n)) box = contact_box(max(division, previous))
      end if
      if (box%ix0 > box%ix1) then
         box = bounding_box((n(1) - empty_window)/2 + 1, (n(1) + empty_window)/2, (n(2) - empty_window)/2 + 1, &
            & (n(2) + empty_window)/2)
      else
         box = bounding_box(box%ix0 - margin, box%ix1 + margin, box%iy0 - margin, box%iy1 + margin)
      end if
      box = bounding_box(max(1, box%ix0), min(n(1), box%ix1), max(1, box%iy0), min(n(2), box%iy1))
   end function kept_window
end module contact_output_input_case
