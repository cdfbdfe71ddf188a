!> All groups of the input that a case gives, in the order of the input files, once for all formats
module contact_cases_whole_case
   use contact_base_choices, only : force_control, grid_form, kernel_model, material_model, &
      & motion, normal_control, planform_choice, pressure_model, slip_source, variation
   use contact_base_kinds, only : long, wp
   use contact_cases_archive, only : case_archive
   use contact_cases_given, only : given_numbers, note_materials, note_velocity
   use contact_cases_grid_inputs, only : largest_grid, visit_grid, visit_planform
   use contact_cases_inputs, only : visit_coefficient_file, visit_conformal, visit_damping, visit_elastic, visit_friction, &
      & visit_friction_rows, visit_heat, visit_inclinations, visit_iteration, visit_kinematics, visit_material_model, &
      & visit_rolling, visit_sheet, visit_wear
   use contact_cases_own_keys, only : visit_own_heat, visit_own_iteration
   use contact_cases_rail_inputs, only : visit_deviations, visit_dimensions, visit_flexibility, visit_position, visit_profile, &
      & visit_search, visit_springs, visit_track, visit_velocity
   use contact_cases_spec, only : case_spec, damping_spec, geometry_spec, grid_spec, part_source, quasi_identical
   use contact_cases_subsurface_inputs, only : visit_blocks, visit_stress_output
   use contact_elastic_material, only : coupling_threshold
   use contact_profile_prepare, only : is_slices_file
   use contact_text_words, only : integer_text, real_text
   use contact_wheelrail_spec, only : wheel_rail_spec
   use contact_cases_distance, only : is_distance_form, list_forms, visit_distance
   implicit none (type, external)
   private

   public :: visit_case

contains

   !> Transfer the values given by a case from or to an archive; choices and parts must be set, other values are unchanged
   subroutine visit_case(a, spec)
      class(case_archive), intent(inout) :: a
      type(case_spec), intent(inout), target :: spec
      logical :: is_wheel_rail, keeps_materials

      is_wheel_rail = allocated(spec%wheel_rail)
      associate (parts => spec%parts)
         keeps_materials = parts%material /= part_source%given
         if (parts%iteration == part_source%given) then
            call a%open_group("iteration")
            ! module 3 may give a maximum number of elements, which has no effect there
            call visit_own_iteration(a, spec%iteration)
            call visit_iteration(a, spec%iteration, spec%solver, with_elements=is_wheel_rail .or. a%is_reading)
            if (a%is_reading .and. a%is_good .and. keeps_materials) call doubt_outer_iteration(a, spec)
            call a%close_group()
         end if
         if (.not. is_wheel_rail) then
            call a%open_group("kinematics")
            call visit_kinematics(a, spec%kinematics, spec%normal, spec%force)
            if (a%is_reading .and. a%is_good .and. keeps_materials .and. .not. spec%given%outer_iterations_judged) &
               & call doubt_outer_iteration(a, spec)
            call a%close_group()
         end if
         if (parts%friction == part_source%given .and. spec%variation /= variation%by_row) then
            call a%open_group("friction")
            call visit_friction(a, spec%friction_law, merge(spec%variation, variation%none, is_wheel_rail), spec%friction)
            call a%close_group()
         end if
         if (.not. is_wheel_rail) call visit_rolling_group(a, spec)
         if (parts%material == part_source%given) call visit_materials(a, spec, is_wheel_rail)
         if (parts%damping == part_source%given) call visit_damping_group(a, spec)
         if (parts%heat == part_source%given .and. spec%has_heat) then
            call a%open_group("heat")
            call visit_own_heat(a, spec%heat)
            call visit_heat(a, spec%heat, with_plastic_work=spec%material_model == material_model%interfacial_layer)
            call a%close_group()
         end if
         if (spec%has_wear) then
            call a%open_group("wear")
            call visit_wear(a, spec%wear)
            call a%close_group()
         end if
         if (is_wheel_rail) then
            call visit_rail_and_track(a, spec, spec%wheel_rail, spec%given)
            call visit_wheelset(a, spec, spec%wheel_rail, spec%given)
         else
            call visit_grid_and_geometry(a, spec)
         end if
         if (.not. spec%has_stress) return
         if (parts%stress_output == part_source%given) then
            call a%open_group("stress_output")
            call visit_stress_output(a, spec%subsurface)
            call a%close_group()
         end if
         if (parts%stress_points == part_source%given) then
            call a%open_group("stress_points")
            call visit_blocks(a, spec%subsurface)
            call a%close_group()
         end if
      end associate
   end subroutine visit_case

   !> Rolling direction, step and velocity; for other motions fixed values replace the stored ones
   subroutine visit_rolling_group(a, spec)
      class(case_archive), intent(inout) :: a
      type(case_spec), intent(inout) :: spec

      if (spec%motion == motion%transient_rolling .or. spec%motion == motion%steady_rolling) then
         if (spec%parts%rolling /= part_source%given) return
         call a%open_group("rolling")
         call visit_rolling(a, spec%rolling, spec%material_model)
         call a%close_group()
         if (a%is_reading) spec%given%rolling = .true.
      else if (a%is_reading) then
         spec%rolling%chi = 0.0_wp
         spec%rolling%dq = 1.0_wp
         spec%rolling%veloc = 1.0_wp
         spec%given%rolling = .false.
      end if
   end subroutine visit_rolling_group

   !> Influence coefficients and materials
   subroutine visit_materials(a, spec, is_wheel_rail)
      class(case_archive), intent(inout) :: a
      type(case_spec), intent(inout) :: spec
      !> Wheel on rail? Then inclinations are those of the profiles
      logical, intent(in) :: is_wheel_rail

      if (spec%kernel == kernel_model%conformal .or. spec%kernel == kernel_model%tabulated) then
         call a%open_group("influence")
         if (spec%kernel == kernel_model%tabulated) then
            call visit_coefficient_file(a, spec%material)
         else if (is_wheel_rail) then
            call visit_conformal(a, spec%material)
         else
            call visit_inclinations(a, spec%material)
         end if
         call a%close_group()
      end if
      call a%open_group("material")
      call visit_elastic(a, spec%material)
      if (spec%pressure == pressure_model%thin_sheet) call visit_sheet(a, spec%material)
      call visit_material_model(a, spec%material_model, spec%material)
      if (a%is_reading .and. a%is_good) then
         call note_materials(spec%given, spec%pressure, spec%material_model)
         call doubt_outer_iteration(a, spec)
      end if
      call a%close_group()
   end subroutine visit_materials

   !> Warn of a maximum number of outer iterations that does not suit the bodies
   !>
   !> Called once for each choice of bodies and iterations, in the group that completes it: the materials, the iterations if the
   !> case keeps its materials, or the kinematics if it keeps both and is the first one with friction.
   subroutine doubt_outer_iteration(a, spec)
      class(case_archive), intent(inout) :: a
      type(case_spec), intent(inout) :: spec
      real(wp) :: ak
      character(len=:), allocatable :: given

      spec%given%outer_iterations_judged = spec%motion /= motion%none
      if (spec%motion == motion%none) return
      ! invalid values have been reported already
      if (.not. (minval(spec%material%gg) >= 1.0e-5_wp .and. minval([spec%material%fg, spec%material%tc]) >= 0.0_wp)) return
      ak = spec%material%difference_parameter()
      given = "MAXOUT = " // integer_text(spec%iteration%maxout)
      if (spec%iteration%maxout >= 2) then
         ! without any coupling of pressures and tractions, one iteration is sufficient
         if (spec%outer_iterations() == 1 .and. abs(ak) >= coupling_threshold) call a%warn_of_group(given // &
            & " is replaced by 1: the bodies are quasi-identical, AK = " // real_text(ak))
      else if (abs(ak) >= quasi_identical) then
         call a%warn_of_group(given // " means no outer iteration, but the bodies have dissimilar materials, AK = " // &
            & real_text(ak) // "; MAXOUT = 10 or more is recommended")
      else if (spec%kernel == kernel_model%conformal .or. spec%kernel == kernel_model%tabulated) then
         call a%warn_of_group(given // " means no outer iteration, but the bodies have dissimilar shapes, see their " // &
            & "influence coefficients; MAXOUT = 10 or more is recommended")
      else if (spec%material_model == material_model%viscoelastic) then
         if (spec%material%relaxes_apart()) call a%warn_of_group(given // &
            & " means no outer iteration, but the viscoelastic bodies relax differently; MAXOUT = 10 or more is recommended")
      end if
   end subroutine doubt_outer_iteration

   !> Damping; cleared if there is none
   subroutine visit_damping_group(a, spec)
      class(case_archive), intent(inout) :: a
      type(case_spec), intent(inout) :: spec

      if (spec%has_damping) then
         call a%open_group("damping")
         call visit_damping(a, spec%damping)
         call a%close_group()
      else if (a%is_reading) then
         spec%damping = damping_spec()
      end if
   end subroutine visit_damping_group

   !> Potential contact area, undeformed distance and planform, and values given for each element
   subroutine visit_grid_and_geometry(a, spec)
      class(case_archive), intent(inout) :: a
      type(case_spec), intent(inout) :: spec
      real(wp), allocatable :: slip(:)
      integer :: n

      associate (parts => spec%parts)
         if (parts%grid == part_source%given) call visit_grid_group(a, spec)
         if (parts%geometry == part_source%given .and. spec%grid%needs_geometry()) &
            & call visit_geometry_group(a, spec)
         if (parts%friction == part_source%given .and. spec%variation == variation%by_row .and. a%is_good) then
            call a%open_group("friction")
            call visit_friction_rows(a, spec%friction_law, max(1, spec%grid%my), spec%friction)
            call a%close_group()
         end if
         if (parts%extra_slip /= part_source%given) return
      end associate
      if (spec%slip_source /= slip_source%given) then
         if (a%is_reading .and. allocated(spec%extra_slip)) deallocate(spec%extra_slip)
         return
      end if
      n = element_count(spec%grid)
      call a%open_group("extra_slip")
      if (n == 0) call a%fail("", "the list EXRHS has one entry for each element, but there is no grid that can be used")
      if (allocated(spec%extra_slip)) slip = reshape(spec%extra_slip, [size(spec%extra_slip)])
      call a%list("EXRHS", slip, 2*n)
      if (a%is_reading .and. a%is_good) then
         spec%extra_slip = reshape(slip, [2, n])
         spec%given%slip_shifts = spec%motion == motion%shift
      end if
      call a%close_group()
   end subroutine visit_grid_and_geometry

   !> Potential contact area
   !>
   !> A Hertzian option brings its own geometry, so that IBASE and IPLAN are 1 from then on.
   subroutine visit_grid_group(a, spec)
      class(case_archive), intent(inout) :: a
      type(case_spec), intent(inout) :: spec
      type(grid_spec), target :: grid

      call a%open_group("grid")
      grid%form = spec%grid%form
      call a%integer("IPOTCN", grid%form, unchecked=.true.)
      call a%end_line()
      if (.not. a%is_good) return
      if (.not. (grid%brings_geometry() .or. grid%needs_geometry())) then
         call a%refuse("IPOTCN", " is not a known option; allowed are -6 to -1 and 1 to 4")
      else if (.not. a%is_reading) then
         call visit_grid(a, spec%grid)
      else
         call visit_grid(a, grid)
         if (a%is_good) call store_grid(grid, spec)
      end if
      call a%close_group()
   end subroutine visit_grid_group

   !> Read a new grid; if it brings its own geometry, it replaces the given one
   subroutine store_grid(grid, spec)
      type(grid_spec), intent(in) :: grid
      type(case_spec), intent(inout) :: spec

      spec%grid = grid
      if (.not. grid%brings_geometry()) return
      spec%geometry = geometry_spec()
      if (grid%form /= grid_form%hertz_curvatures) return
      spec%geometry%b(1) = grid%a1
      spec%geometry%b(3) = grid%b1
   end subroutine store_grid

   !> Undeformed distance and planform of grids that are not Hertzian
   subroutine visit_geometry_group(a, spec)
      class(case_archive), intent(inout) :: a
      type(case_spec), intent(inout) :: spec
      type(geometry_spec), target :: geometry
      character(len=:), allocatable :: forms

      call a%open_group("geometry")
      if (.not. a%is_reading) geometry = spec%geometry
      call a%integer("IBASE", geometry%form, unchecked=.true.)
      call a%integer("IPLAN", geometry%planform, unchecked=.true.)
      call a%end_line()
      if (.not. is_distance_form(geometry%form)) then
         call list_forms(" and ", forms)
         call a%refuse("IBASE", " is not a known option; allowed are " // forms)
      end if
      if (all(geometry%planform /= [planform_choice%unrestricted, planform_choice%quadratic, planform_choice%two_rectangles, &
         & planform_choice%weighted_rectangles])) call a%refuse("IPLAN", " is not a known option; allowed are 1 to 4")
      call visit_distance(a, geometry, element_count(spec%grid))
      call visit_planform(a, geometry)
      if (a%is_reading .and. a%is_good) spec%geometry = geometry
      call a%close_group()
   end subroutine visit_geometry_group

   !> Number of elements of a grid, 0 if the grid is invalid
   pure integer function element_count(grid) result(n)
      type(grid_spec), intent(in) :: grid

      n = 0
      if (min(grid%mx, grid%my) < 1) return
      if (int(grid%mx, long)*int(grid%my, long) <= largest_grid) n = grid%mx*grid%my
   end function element_count

   !> Contact search, track dimensions, rail profile, deviations of the rail and its springs
   subroutine visit_rail_and_track(a, spec, wheel_rail, given)
      class(case_archive), intent(inout) :: a
      type(case_spec), intent(in) :: spec
      !> Specification of wheel and rail of this case
      type(wheel_rail_spec), intent(inout) :: wheel_rail
      !> Updated by what is read
      type(given_numbers), intent(inout) :: given

      if (spec%parts%search == part_source%given) then
         call a%open_group("search")
         call visit_search(a, wheel_rail%search, with_step=.true.)
         call a%close_group()
      end if
      if (spec%parts%track == part_source%given) then
         call a%open_group("track")
         call visit_track(a, wheel_rail%track, wheel_rail%roller)
         call a%close_group()
         if (a%is_reading) then
            given%roller_radius = given%roller_radius .or. wheel_rail%roller
            given%cant = given%cant .or. .not. wheel_rail%roller
            wheel_rail%new_track = .true.
         end if
      end if
      if (spec%parts%rail_profile == part_source%given) then
         call a%open_group("rail_profile")
         call visit_profile(a, "RFNAME", wheel_rail%rail_profile)
         if (a%is_reading) wheel_rail%new_rail_profile = a%is_good
         if (a%is_reading .and. a%is_good .and. wheel_rail%track%gaught > 0.0_wp) then
            if (is_slices_file(wheel_rail%rail_profile%name)) call a%refuse_group("GAUGHT = " // &
               & real_text(wheel_rail%track%gaught) // &
               & " places the rail by its gauge point, but the profile varies along the track; a slices file needs absolute " // &
               & "placement, GAUGHT = 0 or negative")
         end if
         call a%close_group()
      end if
      if (spec%parts%deviations == part_source%given) then
         call a%open_group("deviations")
         call visit_deviations(a, wheel_rail%rail)
         call a%close_group()
         if (a%is_reading) given%rail_shifts = spec%motion == motion%shift
         if (spec%force == force_control%massless_rail) then
            call a%open_group("springs")
            call visit_springs(a, wheel_rail%rail)
            call a%close_group()
            if (a%is_reading) given%springs = .true.
         end if
      end if
   end subroutine visit_rail_and_track

   !> Wheelset dimensions, wheel profile, position, velocity, flexible deviations
   !>
   !> Flexible deviations are kept until others are given.
   subroutine visit_wheelset(a, spec, wheel_rail, given)
      class(case_archive), intent(inout) :: a
      type(case_spec), intent(in) :: spec
      !> Specification of wheel and rail of this case
      type(wheel_rail_spec), intent(inout) :: wheel_rail
      !> Updated by what is read
      type(given_numbers), intent(inout) :: given

      associate (parts => spec%parts)
         if (parts%wheel_profile == part_source%given) then
            call a%open_group("wheel_dimensions")
            call visit_dimensions(a, wheel_rail%wheelset)
            call a%close_group()
            call a%open_group("wheel_profile")
            call visit_profile(a, "WFNAME", wheel_rail%wheel_profile)
            if (a%is_reading) wheel_rail%new_wheel_profile = a%is_good
            call a%close_group()
         end if
         if (parts%position == part_source%given) then
            call a%open_group("position")
            call visit_position(a, wheel_rail%wheelset, wheel_rail%roller, with_force=spec%normal == normal_control%force)
            call a%close_group()
         end if
         if (parts%velocity == part_source%given) then
            call a%open_group("velocity")
            call visit_velocity(a, wheel_rail%wheelset, wheel_rail%roller, &
               & with_force=spec%force == force_control%longitudinal_force)
            call a%close_group()
            if (a%is_reading) call note_velocity(given, wheel_rail%roller, spec%force, spec%motion)
         end if
         if (parts%flexibility == part_source%given) then
            call a%open_group("flexibility")
            call visit_flexibility(a, wheel_rail%wheelset)
            call a%close_group()
            if (a%is_reading) given%flexible_shifts = spec%motion == motion%shift
         end if
      end associate
   end subroutine visit_wheelset
end module contact_cases_whole_case
