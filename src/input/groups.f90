!> The groups of a case behind its control words, in the order of the input files
module contact_input_groups
   use contact_base_choices, only : force_control, kernel_model, material_model, motion, normal_control, pressure_model, variation
   use contact_base_error, only : error_type
   use contact_base_kinds, only : long, wp
   use contact_cases_grid_inputs, only : largest_grid, visit_distance, visit_grid, visit_planform
   use contact_cases_inputs, only : visit_coefficient_file, visit_conformal, visit_damping, visit_elastic, visit_friction, &
      & visit_friction_rows, visit_heat, visit_inclinations, visit_iteration, visit_kinematics, visit_material_model, &
      & visit_rolling, visit_sheet
   use contact_cases_rail_inputs, only : visit_deviations, visit_dimensions, visit_flexibility, visit_position, visit_profile, &
      & visit_search, visit_springs, visit_track, visit_velocity
   use contact_cases_spec, only : case_spec, damping_spec, geometry_spec, grid_spec, material_spec
   use contact_control_digits, only : choice_of
   use contact_input_file_reader, only : file_reader, new_file_reader
   use contact_input_problems, only : problem_list, severity
   use contact_input_subsurface_reader, only : read_subsurface
   use contact_text_lexer, only : input_lexer
   use contact_text_words, only : integer_text, real_text
   use contact_wheelrail_spec, only : profile_spec, wheel_rail_spec
   implicit none (type, external)
   private

   public :: case_lines, read_groups

   !> Lines to which messages refer
   type :: case_lines
      !> Kinematics, and the grid group when the case has one
      integer :: kinematics = 0, grid = 0
   end type case_lines

   !> Difference parameters below this value count as zero [-]
   real(wp), parameter :: quasi_identical = 1.0e-4_wp
   !> Below this there is no difference in the equations, see contact_elastic_material
   real(wp), parameter :: no_difference = 1.0e-6_wp

contains

   !> Read what the digits ask for; the rest stays as it is
   subroutine read_groups(lexer, module_number, spec, problems, lines, error)
      type(input_lexer), intent(inout), target :: lexer
      !> 1 or 3
      integer, intent(in) :: module_number
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout), target :: problems
      type(case_lines), intent(out) :: lines
      type(error_type), allocatable, intent(out) :: error
      type(file_reader) :: a

      a = new_file_reader(lexer, problems)
      if (spec%digits%g /= 1) call visit_iteration(a, spec%iteration, spec%solver, with_elements=.true.)
      if (module_number == 1) then
         if (spec%digits%l /= 1) call visit_friction(a, spec%friction_law, spec%variation, spec%friction)
      else
         call visit_kinematics(a, spec%kinematics, spec%normal, spec%force)
         lines%kinematics = lexer%line
         if (spec%digits%l /= 1 .and. spec%digits%v /= 3) call visit_friction(a, spec%friction_law, variation%none, spec%friction)
         call read_rolling(a, spec)
      end if
      if (spec%digits%c >= 2) call read_materials(a, module_number, spec, problems)
      if (spec%digits%m2 >= 2) call visit_damping(a, spec%damping)
      if (spec%digits%m2 == 0) spec%damping = damping_spec()
      if (spec%digits%h == 3) call visit_heat(a, spec%heat, &
         & with_plastic_work=spec%material_model == material_model%interfacial_layer)
      if (module_number == 1) then
         if (spec%digits%d >= 2) then
            spec%wheel_rail%search%location = choice_of("D", spec%digits%d, module_number)
            call visit_search(a, spec%wheel_rail%search, with_step=.true.)
         end if
         call read_track(a, spec, spec%wheel_rail, problems)
         call read_wheelset(a, spec, spec%wheel_rail)
      else
         if (spec%digits%d == 2) call read_grid(a, spec, lines%grid)
         if (spec%digits%z == 2 .and. spec%grid%ipotcn > 0) call read_geometry(a, spec)
         if (spec%digits%l /= 1 .and. spec%digits%v == 3 .and. a%is_good) call visit_friction_rows(a, spec%friction_law, &
            & max(1, spec%grid%my), spec%friction)
         call read_extra_slip(a, spec)
      end if
      if (spec%digits%s >= 2) call read_subsurface(a, spec%digits%s == 3, spec%subsurface)
      if (allocated(a%error)) call move_alloc(a%error, error)
   end subroutine read_groups

   !> Rolling direction, step and velocity; other motions replace what is stored by fixed values
   subroutine read_rolling(a, spec)
      type(file_reader), intent(inout) :: a
      type(case_spec), intent(inout) :: spec

      if (spec%motion == motion%transient_rolling .or. spec%motion == motion%steady_rolling) then
         if (spec%digits%c >= 2) call visit_rolling(a, spec%rolling, spec%material_model)
      else
         spec%rolling%chi = 0.0_wp
         spec%rolling%dq = 1.0_wp
         spec%rolling%veloc = 1.0_wp
      end if
   end subroutine read_rolling

   !> Influence coefficients and materials
   subroutine read_materials(a, module_number, spec, problems)
      type(file_reader), intent(inout) :: a
      !> 1 or 3
      integer, intent(in) :: module_number
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      integer :: line, column

      if (spec%kernel == kernel_model%conformal .and. module_number == 1) call visit_conformal(a, spec%material)
      if (spec%kernel == kernel_model%conformal .and. module_number == 3) call visit_inclinations(a, spec%material)
      if (spec%kernel == kernel_model%tabulated) call visit_coefficient_file(a, spec%material)
      call visit_elastic(a, spec%material)
      line = 0
      column = 0
      call a%place("POISS1", line, column)
      if (spec%pressure == pressure_model%thin_sheet) call visit_sheet(a, spec%material)
      call visit_material_model(a, spec%material_model, spec%material)
      if (.not. a%is_good) return
      associate (material => spec%material)
         if (minval(material%gg) >= 1.0e-5_wp .and. minval([material%fg, material%tc]) >= 0.0_wp) &
            & call check_outer_iteration(spec, line, column, problems)
      end associate
   end subroutine read_materials

   !> Dissimilar bodies need the outer iteration, similar bodies do not
   subroutine check_outer_iteration(spec, line, column, problems)
      type(case_spec), intent(inout) :: spec
      !> Place of the material constants
      integer, intent(in) :: line, column
      type(problem_list), intent(inout) :: problems
      real(wp) :: ak
      logical :: is_dissimilar_shape, relaxes_apart
      character(len=:), allocatable :: given

      if (spec%digits%t == 0) return
      ak = difference_parameter(spec%material)
      is_dissimilar_shape = spec%digits%c == 4 .or. spec%digits%c == 9
      relaxes_apart = spec%digits%m == 1
      ! wrong values have been told already
      if (relaxes_apart) relaxes_apart = min(minval(spec%material%fg), minval(spec%material%tc)) >= 0.0_wp
      if (relaxes_apart) relaxes_apart = spec%material%relaxes_apart()
      given = "MAXOUT = " // integer_text(spec%iteration%maxout)
      if (spec%iteration%maxout >= 2) then
         if (is_dissimilar_shape .or. relaxes_apart .or. abs(ak) >= quasi_identical) return
         ! where pressures and tractions do not act on each other at all, one pass is all that can be done
         if (abs(ak) >= no_difference) call problems%add(severity%warning, given // " is replaced by 1: the bodies are " // &
            & "quasi-identical, AK = " // real_text(ak), line, column)
         spec%iteration%maxout = 1
      else if (abs(ak) >= quasi_identical) then
         call problems%add(severity%warning, given // " means no outer iteration, but the bodies have dissimilar " // &
            & "materials, AK = " // real_text(ak) // "; MAXOUT = 10 or more is recommended", line, column)
      else if (is_dissimilar_shape) then
         call problems%add(severity%warning, given // " means no outer iteration, but the bodies have dissimilar " // &
            & "shapes, C = " // integer_text(spec%digits%c) // "; MAXOUT = 10 or more is recommended", line, column)
      else if (relaxes_apart) then
         call problems%add(severity%warning, given // " means no outer iteration, but the bodies relax differently, M = 1; " // &
            & "MAXOUT = 10 or more is recommended", line, column)
      end if
   end subroutine check_outer_iteration

   !> Kalker's difference parameter K of two bodies [-]
   pure real(wp) function difference_parameter(material) result(ak)
      type(material_spec), intent(in) :: material

      associate (nu => material%poiss, g => material%gg)
         ak = 0.5_wp*((1.0_wp - 2.0_wp*nu(1))*(g(2)/(g(1) + g(2))) - (1.0_wp - 2.0_wp*nu(2))*(g(1)/(g(1) + g(2))))
      end associate
   end function difference_parameter

   !> Potential contact area
   !>
   !> A Hertzian option brings its own geometry, so that IBASE and IPLAN are 1 from there on.
   subroutine read_grid(a, spec, line)
      type(file_reader), intent(inout) :: a
      type(case_spec), intent(inout) :: spec
      !> Line with IPOTCN
      integer, intent(out) :: line
      type(grid_spec), target :: grid

      call a%integer("IPOTCN", grid%ipotcn, unchecked=.true.)
      call a%end_line()
      line = a%lexer%line
      if (.not. a%is_good) return
      if (grid%ipotcn < -6 .or. grid%ipotcn > 4 .or. grid%ipotcn == 0) then
         call a%refuse("IPOTCN", " is not a known option; allowed are -6 to -1 and 1 to 4")
         return
      end if
      call visit_grid(a, grid)
      if (.not. a%is_good) return
      spec%grid = grid
      if (grid%ipotcn > 0) return
      spec%new_geometry = .true.
      spec%geometry = geometry_spec()
      if (grid%ipotcn == -1) then
         spec%geometry%b(1) = grid%a1
         spec%geometry%b(3) = grid%b1
      end if
   end subroutine read_grid

   !> Undeformed distance and planform of grids that are not Hertzian
   subroutine read_geometry(a, spec)
      type(file_reader), intent(inout) :: a
      type(case_spec), intent(inout) :: spec
      type(geometry_spec), target :: geometry

      call a%integer("IBASE", geometry%ibase, unchecked=.true.)
      call a%integer("IPLAN", geometry%iplan, unchecked=.true.)
      call a%end_line()
      if (all(geometry%ibase /= [1, 2, 3, 9])) call a%refuse("IBASE", " is not a known option; allowed are 1, 2, 3 and 9")
      if (geometry%iplan < 1 .or. geometry%iplan > 4) call a%refuse("IPLAN", " is not a known option; allowed are 1 to 4")
      call visit_distance(a, geometry, element_count(spec%grid))
      call visit_planform(a, geometry)
      if (a%is_good) spec%geometry = geometry
   end subroutine read_geometry

   !> Extra term of the rigid slip (E); 0 removes it
   subroutine read_extra_slip(a, spec)
      type(file_reader), intent(inout) :: a
      type(case_spec), intent(inout) :: spec
      real(wp), allocatable :: list(:)
      integer :: n

      if (spec%digits%e == 1) return
      if (spec%digits%e /= 9) then
         if (allocated(spec%extra_slip)) deallocate(spec%extra_slip)
         return
      end if
      n = element_count(spec%grid)
      if (n == 0) call a%fail("", "the list EXRHS has one entry for each element, but there is no grid that can be used")
      call a%list("EXRHS", list, 2*n)
      if (a%is_good) spec%extra_slip = reshape(list, [2, n])
   end subroutine read_extra_slip

   !> Number of elements of a grid, 0 when it cannot be used
   pure integer function element_count(grid) result(n)
      type(grid_spec), intent(in) :: grid

      n = 0
      if (min(grid%mx, grid%my) < 1) return
      if (int(grid%mx, long)*int(grid%my, long) <= largest_grid) n = grid%mx*grid%my
   end function element_count

   !> Track dimensions, rail profile, deviations of the rail and its springs
   subroutine read_track(a, spec, pair, problems)
      type(file_reader), intent(inout) :: a
      type(case_spec), intent(in) :: spec
      !> Of this case
      type(wheel_rail_spec), intent(inout) :: pair
      type(problem_list), intent(inout) :: problems

      associate (z => spec%digits%z)
         if (z == 1 .or. z == 3) call visit_track(a, pair%track, pair%roller)
         if (z == 3) then
            call visit_profile(a, "RFNAME", pair%rail_profile)
            pair%new_rail_profile = a%is_good
            if (a%is_good .and. pair%track%gaught > 0.0_wp) then
               if (is_slices(pair%rail_profile)) call problems%add(severity%error, "GAUGHT = " // &
                  & real_text(pair%track%gaught) // " places the rail by its gauge point, but the profile varies along the " // &
                  & "track; a slices file needs absolute placement, GAUGHT = 0 or negative", pair%rail_profile%line, &
                  & pair%rail_profile%column)
            end if
         end if
         if (z >= 2) call visit_deviations(a, pair%rail)
         if (spec%force /= force_control%massless_rail) return
         if (z >= 2) call visit_springs(a, pair%rail)
         if (spec%normal == normal_control%approach .and. .not. pair%rail%kz > 0.0_wp .and. a%is_good) call problems%add( &
            & severity%error, "KZRAIL = " // real_text(pair%rail%kz) // ": a rail on springs with a prescribed height, F = 3 " // &
            & "and N = 0, needs a vertical stiffness above 0", a%lexer%line)
      end associate
   end subroutine read_track

   !> Wheelset dimensions, wheel profile, position, velocity, flexible deviations
   !>
   !> Flexible deviations stay until others are given.
   subroutine read_wheelset(a, spec, pair)
      type(file_reader), intent(inout) :: a
      type(case_spec), intent(in) :: spec
      !> Of this case
      type(wheel_rail_spec), intent(inout) :: pair

      associate (e => spec%digits%e)
         if (e == 3 .or. e == 5) then
            call visit_dimensions(a, pair%wheelset)
            call visit_profile(a, "WFNAME", pair%wheel_profile)
            pair%new_wheel_profile = a%is_good
         end if
         if (e >= 1) call visit_position(a, pair%wheelset, pair%roller, with_force=spec%normal == normal_control%force)
         if (e >= 2) call visit_velocity(a, pair%wheelset, pair%roller, &
            & with_force=spec%force == force_control%longitudinal_force)
         if (e >= 4) call visit_flexibility(a, pair%wheelset)
      end associate
   end subroutine read_wheelset

   !> Is it a file with slices of a variable profile?
   pure logical function is_slices(profile)
      type(profile_spec), intent(in) :: profile
      integer :: dot
      character(len=4) :: extension

      dot = index(profile%name, ".", back=.true.)
      extension = profile%name(dot + 1:)
      is_slices = dot > 0 .and. any(extension == ["slcs", "slcw", "SLCS", "SLCW"])
   end function is_slices
end module contact_input_groups
