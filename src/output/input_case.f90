!> Cases as input files: what was solved through the library can be solved by the program
module contact_output_input_case
   use contact_base_choices, only : force_control, heat_source, kernel_model, material_model, motion, &
      & normal_control, pressure_model, slip_source
   use contact_base_kinds, only : wp
   use contact_cases_grid_inputs, only : visit_distance, visit_grid
   use contact_cases_inputs, only : visit_conformal, visit_damping, visit_elastic, visit_friction, visit_heat, visit_iteration, &
      & visit_kinematics, visit_material_model, visit_rolling, visit_sheet
   use contact_cases_rail_inputs, only : visit_deviations, visit_dimensions, visit_flexibility, visit_position, visit_profile, &
      & visit_search, visit_springs, visit_track, visit_velocity
   use contact_cases_spec, only : case_spec, geometry_spec, grid_spec
   use contact_grid_element_division, only : bounding_box, contact_box
   use contact_grid_potential_contact, only : potential_contact
   use contact_output_file_writer, only : file_writer, put_words
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: write_contact_case, write_pair_case

   !> Elements that are kept around the contact area, and sides of the window that is kept without contact
   integer, parameter :: margin = 2, empty_window = 5

contains

   !> A solved case of module 3; a window that is not Hertzian is cut to the contact area and a margin
   subroutine write_contact_case(unit, spec, result)
      integer, intent(in) :: unit
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      type(file_writer) :: a
      type(case_spec) :: written
      type(bounding_box) :: box
      real(wp), allocatable :: slip(:)
      integer :: ix, iy

      a%unit = unit
      written = spec
      associate (digits => written%digits)
         digits%s = 0
         digits%d = 2
         digits%z = 2
         if (all(spec%slip_source /= [slip_source%no_spin_x, slip_source%no_spin_y])) &
            & digits%e = merge(9, 0, allocated(spec%extra_slip) .and. spec%digits%e > 0)
         digits%r = merge(1, 3, spec%solve)
         ! how materials and temperatures act, not whether they were set again
         if (spec%has_damping) digits%m2 = 2
         if (digits%h == 1) digits%h = 3
      end associate
      box = bounding_box(1, result%grid%mx, 1, result%grid%my)
      if (spec%grid%ipotcn > 0 .and. allocated(result%division)) box = kept_window(result%division)
      call put_words(unit, written%digits, module_number=3)
      if (written%digits%g /= 1) call visit_iteration(a, written%iteration, written%solver, with_elements=.false.)
      call visit_kinematics(a, written%kinematics, written%normal, written%force)
      call put_friction(a, written)
      if (written%motion >= motion%transient_rolling .and. written%digits%c >= 2) call visit_rolling(a, written%rolling, &
         & written%material_model)
      call put_materials(a, written)
      call put_grid(a, written%grid, result%grid, box)
      if (spec%grid%ipotcn > 0) call put_geometry(a, written%geometry, result%grid, box)
      if (written%digits%e /= 9) return
      associate (mx => result%grid%mx)
         slip = [((spec%extra_slip(:, ix + mx*(iy - 1)), ix = box%ix0, box%ix1), iy = box%iy0, box%iy1)]
      end associate
      call a%list("EXRHS", slip, size(slip))
   end subroutine write_contact_case

   !> The contact area with a margin, within the window; without contact its middle
   pure function kept_window(division) result(box)
      !> Element states, shape (mx, my)
      integer, intent(in) :: division(:, :)
      type(bounding_box) :: box
      integer :: n(2)

      n = shape(division)
      box = contact_box(division)
      if (box%ix0 > box%ix1) then
         box = bounding_box((n(1) - empty_window)/2 + 1, (n(1) + empty_window)/2, (n(2) - empty_window)/2 + 1, &
            & (n(2) + empty_window)/2)
      else
         box = bounding_box(box%ix0 - margin, box%ix1 + margin, box%iy0 - margin, box%iy1 + margin)
      end if
      box = bounding_box(max(1, box%ix0), min(n(1), box%ix1), max(1, box%iy0), min(n(2), box%iy1))
   end function kept_window

   !> Friction law with its points, unless it is kept
   subroutine put_friction(a, spec)
      type(file_writer), intent(inout) :: a
      type(case_spec), intent(inout) :: spec

      if (spec%digits%l /= 1) call visit_friction(a, spec%friction_law, spec%variation, spec%friction)
   end subroutine put_friction

   !> Materials, damping and temperatures, as far as they are not kept
   subroutine put_materials(a, spec)
      type(file_writer), intent(inout) :: a
      type(case_spec), intent(inout) :: spec

      if (spec%digits%c >= 2) then
         ! only wheel and rail, whose inclinations are those of the profiles
         if (spec%digits%c == kernel_model%conformal) call visit_conformal(a, spec%material)
         call visit_elastic(a, spec%material)
         if (spec%pressure == pressure_model%thin_sheet) call visit_sheet(a, spec%material)
         call visit_material_model(a, spec%material_model, spec%material)
      end if
      if (spec%digits%m2 >= 2) call visit_damping(a, spec%damping)
      if (spec%digits%h /= 3) return
      if (spec%heat%source == heat_source%moving) a%remark = ", temperatures as with --heat moving-source"
      call visit_heat(a, spec%heat, with_plastic_work=spec%material_model == material_model%interfacial_layer)
      if (allocated(a%remark)) deallocate(a%remark)
   end subroutine put_materials

   !> Potential contact area; a window by its lower corner
   subroutine put_grid(a, asked, grid, box)
      type(file_writer), intent(inout) :: a
      !> As the case gave it
      type(grid_spec), intent(in) :: asked
      type(potential_contact), intent(in) :: grid
      !> Elements that are kept
      type(bounding_box), intent(in) :: box
      type(grid_spec), target :: written

      written = asked
      if (asked%ipotcn > 0) written = grid_spec(ipotcn=1, mx=box%ix1 - box%ix0 + 1, my=box%iy1 - box%iy0 + 1, &
         & xl=grid%xl + (box%ix0 - 1)*grid%dx, yl=grid%yl + (box%iy0 - 1)*grid%dy, dx=grid%dx, dy=grid%dy)
      call a%integer("IPOTCN", written%ipotcn, unchecked=.true.)
      call a%end_line()
      call visit_grid(a, written)
   end subroutine put_grid

   !> Undeformed distance; planforms cannot be set through the library
   subroutine put_geometry(a, asked, grid, box)
      type(file_writer), intent(inout) :: a
      type(geometry_spec), intent(in) :: asked
      type(potential_contact), intent(in) :: grid
      type(bounding_box), intent(in) :: box
      type(geometry_spec), target :: written
      integer :: ix, iy

      written = asked
      written%iplan = 1
      if (allocated(asked%h)) written%h = [((asked%h(ix + grid%mx*(iy - 1)), ix = box%ix0, box%ix1), iy = box%iy0, box%iy1)]
      call a%integer("IBASE", written%ibase, unchecked=.true.)
      call a%integer("IPLAN", written%iplan, unchecked=.true.)
      call a%end_line()
      call visit_distance(a, written, (box%ix1 - box%ix0 + 1)*(box%iy1 - box%iy0 + 1))
   end subroutine put_geometry

   !> A case of module 1, with what its digits ask for
   subroutine write_pair_case(unit, spec)
      integer, intent(in) :: unit
      !> Names of profiles are written as they are here
      type(case_spec), intent(in) :: spec
      type(file_writer) :: a
      type(case_spec), target :: written

      a%unit = unit
      written = spec
      call put_words(unit, spec%digits, module_number=1)
      if (spec%digits%g /= 1) call visit_iteration(a, written%iteration, spec%solver, with_elements=.true.)
      call put_friction(a, written)
      call put_materials(a, written)
      associate (digits => spec%digits, pair => written%wheel_rail)
         if (digits%d >= 2) call visit_search(a, pair%search, with_step=.true.)
         if (digits%z == 1 .or. digits%z == 3) call visit_track(a, pair%track, pair%roller)
         if (digits%z == 3) call visit_profile(a, "RFNAME", pair%rail_profile)
         if (digits%z >= 2) call visit_deviations(a, pair%rail)
         if (digits%z >= 2 .and. spec%force == force_control%massless_rail) call visit_springs(a, pair%rail)
         if (digits%e == 3 .or. digits%e == 5) then
            call visit_dimensions(a, pair%wheelset)
            call visit_profile(a, "WFNAME", pair%wheel_profile)
         end if
         if (digits%e >= 1) call visit_position(a, pair%wheelset, pair%roller, &
            & with_force=spec%normal == normal_control%force)
         if (digits%e >= 2) call visit_velocity(a, pair%wheelset, pair%roller, &
            & with_force=spec%force == force_control%longitudinal_force)
         if (digits%e >= 4) call visit_flexibility(a, pair%wheelset)
      end associate
   end subroutine write_pair_case
end module contact_output_input_case
