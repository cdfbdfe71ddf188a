!> Wheel on rail through its cases: specification in, result out
module contact_cases_wheel_rail_session
   use contact_base_choices, only : contact_location, estimate_choice, force_control, kernel_model, material_model, &
      & motion, normal_control, pressure_model, sensitivity_choice, time_link, variation
   use contact_base_error, only : add_context, error_type, fatal_error
   use contact_base_kinds, only : long, wp
   use contact_base_log, only : log_type
   use contact_base_memory, only : bytes_per_element, require_memory
   use contact_cases_border_warning, only : warn_of_border, warn_of_buried_ends
   use contact_cases_resolution_warning, only : warn_of_few_elements
   use contact_cases_effects, only : name_effects
   use contact_cases_elastic_setup, only : kept_table, set_model, update_table
   use contact_cases_friction_setup, only : set_friction, set_thermal
   use contact_cases_patch_setup, only : set_method, set_simplified_theory, set_yield_limit
   use contact_cases_session, only : refuse_nonsense
   use contact_cases_rules, only : refuse_broken_rules
   use contact_cases_spec, only : case_spec
   use contact_cases_stress_errors, only : estimate_stress_errors
   use contact_cases_subsurface, only : subsurface_stresses, warn_of_subsurface
   use contact_elastic_model, only : influence_table
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_damping, only : damping_law
   use contact_patch_wear, only : derive_wear
   use contact_profile_curve, only : profile_curve
   use contact_profile_request, only : profile_request, profile_side
   use contact_profile_store, only : prepared_profile, profile_store
   use contact_profile_surface, only : profile_surface
   use contact_text_bounds, only : check_number
   use contact_text_words, only : integer_text, real_text
   use contact_wheelrail_memory, only : wheel_rail_memory, release_wheel_rail
   use contact_wheelrail_solve, only : solve_wheel_rail
   use contact_wheelrail_problem, only : wheel_rail_problem, relaxing_bodies
   use contact_wheelrail_result, only : wheel_rail_result
   use contact_wheelrail_spec, only : profile_spec, wheel_rail_spec
   implicit none (type, external)
   private

   public :: wheel_rail_session, check_files, load_profile, release_wheel_rail_session, solve_wheel_rail_case

   !> Data of one wheel on one rail
   type :: wheel_rail_session
      type(wheel_rail_problem) :: problem
      type(wheel_rail_memory) :: memory
      !> Profiles used so far
      type(profile_store) :: profiles
      !> Last requests to the store for rail and wheel
      type(profile_request) :: wanted(2)
      !> Influence coefficients from a file
      type(kept_table) :: coefficients
   end type wheel_rail_session

contains

   !> Solve one case, or only read its input (R = 2, 3)
   subroutine solve_wheel_rail_case(session, spec, folder, log, result, error)
      type(wheel_rail_session), intent(inout) :: session
      !> Complete specification of a case of module 1
      type(case_spec), intent(in) :: spec
      !> Folder to which names of profile files are relative, "" for the current one
      character(len=*), intent(in) :: folder
      type(log_type), intent(inout) :: log
      !> Unchanged if nothing is computed
      type(wheel_rail_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error

      log%level = spec%flow_level
      call log%begin_case()
      call solve_and_describe(session, spec, folder, log, result, error)
      call log%translate_choices(error)
      call log%end_case()
   end subroutine solve_wheel_rail_case

   !> Solve the case between the beginning and the end of its log
   subroutine solve_and_describe(session, spec, folder, log, result, error)
      type(wheel_rail_session), intent(inout) :: session
      type(case_spec), intent(in) :: spec
      !> As for solve_wheel_rail_case
      character(len=*), intent(in) :: folder
      type(log_type), intent(inout) :: log
      type(wheel_rail_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      integer :: k

      call refuse_broken_rules(spec, error)
      if (spec%pressure == pressure_model%thin_sheet) call check_number("FLXZ", spec%material%flxz, error)
      if (allocated(error)) return
      call set_wheel_rail(session, spec, folder, log, error)
      if (allocated(error)) return
      call solve_wheel_rail(session%problem, session%memory, log, result, error)
      if (allocated(error)) return
      if (.not. result%has_finite_totals()) then
         call refuse_nonsense(error)
         call session%memory%last%clear()
         if (allocated(session%memory%slot)) session%memory%slot%state%started = .false.
         return
      end if
      if (spec%output_level >= 4) call keep_profiles(session, result)
      call warn_of_buried_ends(spec, result, log)
      do k = 1, size(result%patches)
         associate (contact => result%patches(k)%contact, search => spec%wheel_rail%search, slot => session%memory%slot(k))
            if (spec%solve) then
               call warn_of_border(spec, slot%problem, contact, log, k)
               call warn_of_few_elements(contact, "DS", log, k)
               if (max(contact%grid%dx/search%dx, contact%grid%dy/search%ds) > 1.5_wp) call log%warning("the elements of patch " &
                  & // integer_text(k) // " have sides of " // real_text(contact%grid%dx) // " x " // &
                  & real_text(contact%grid%dy) // " mm instead of DX x DS = " // real_text(search%dx) // " x " // &
                  & real_text(search%ds) // " mm, because there are at most NPOT_MAX = " // &
                  & integer_text(spec%iteration%npot_max))
               call warn_of_small_table(session%problem%template%model%tabulated, contact%grid, k, log)
               if (spec%has_wear) call derive_wear(spec%wear, [0.0_wp, 0.0_wp], contact)
            end if
            if (allocated(contact%subsurface)) deallocate(contact%subsurface)
            ! patches of a case that is only checked have no pressures
            if (spec%has_stress .and. spec%solve) &
               & call subsurface_stresses(spec, contact, error, spec%wheel_rail%left)
            if (.not. allocated(error)) call warn_of_subsurface(spec, contact, log)
            if (allocated(slot%coarse) .and. .not. allocated(error)) &
               & call estimate_stress_errors(spec, slot%coarse%result, contact, spec%wheel_rail%left)
            call name_effects(spec, slot%problem, contact)
         end associate
         if (allocated(error)) return
      end do
   end subroutine solve_and_describe

   !> Warn if a patch has more elements than a table of influence coefficients
   subroutine warn_of_small_table(table, grid, number, log)
      !> Table; unallocated for half-spaces
      type(influence_table), allocatable, intent(in) :: table
      type(potential_contact), intent(in) :: grid
      !> Number of the patch
      integer, intent(in) :: number
      type(log_type), intent(inout) :: log

      if (.not. allocated(table)) return
      if (grid%mx <= table%nx .and. grid%my <= table%ny + 1) return
      call log%warning("patch " // integer_text(number) // " has " // integer_text(grid%mx) // " by " // integer_text(grid%my) &
         & // " elements, the file of influence coefficients only " // integer_text(table%nx) // " by " // &
         & integer_text(table%ny + 1) // ": coefficients at larger distances are 0")
   end subroutine warn_of_small_table

   !> Points of the profiles in track coordinates: the rail at the wheelset, the wheel at its lowest meridian
   subroutine keep_profiles(session, result)
      type(wheel_rail_session), intent(in) :: session
      type(wheel_rail_result), intent(inout) :: result
      real(wp) :: point(3)
      integer :: i

      associate (rail => session%memory%geometry%rail_in_track, wheel => session%problem%wheel, &
         & axes => session%memory%geometry%placement%wheel)
         result%rail_profile%s = rail%y%s
         result%rail_profile%y = rail%y%nodes()
         result%rail_profile%z = rail%z%nodes()
         result%wheel_profile%s = wheel%y%s
         result%wheel_profile%x = wheel%y%s
         result%wheel_profile%y = wheel%y%nodes()
         result%wheel_profile%z = wheel%z%nodes()
         do i = 1, size(wheel%y%s)
            point = axes%to_parent([0.0_wp, result%wheel_profile%y(i), result%wheel_profile%z(i)])
            result%wheel_profile%x(i) = point(1)
            result%wheel_profile%y(i) = point(2)
            result%wheel_profile%z(i) = point(3)
         end do
      end associate
   end subroutine keep_profiles

   !> Release the memory of a session that is allocated outside Fortran; must be called before the session is destroyed
   subroutine release_wheel_rail_session(session)
      type(wheel_rail_session), intent(inout) :: session
      call release_wheel_rail(session%memory)
      call session%profiles%release()
   end subroutine release_wheel_rail_session

   !> Read and prepare the files of a case without solving it: profiles, which must fit the nominal radii, and influence
   !> coefficients
   subroutine check_files(session, spec, folder, log, error)
      type(wheel_rail_session), intent(inout) :: session
      !> Complete specification of a case of module 1
      type(case_spec), intent(in) :: spec
      !> As for solve_wheel_rail_case
      character(len=*), intent(in) :: folder
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error

      associate (problem => session%problem)
         call load_profile(session%profiles, spec%wheel_rail%rail_profile, profile_side%rail, folder, session%wanted(1), &
            & problem%rail, problem%rail_surface, log, error, spec%limits%confined)
         if (.not. allocated(error)) call load_profile(session%profiles, spec%wheel_rail%wheel_profile, profile_side%wheel, &
            & folder, session%wanted(2), problem%wheel, problem%wheel_surface, log, error, spec%limits%confined)
         if (.not. allocated(error)) call check_dimensions(spec%wheel_rail, problem%rail, problem%wheel, log, error)
      end associate
      if (.not. allocated(error)) call update_table(spec, folder, session%coefficients, log, error)
   end subroutine check_files

   !> Do the dimensions of track and wheelset fit the profiles?
   subroutine check_dimensions(wheel_rail, rail, wheel, log, error)
      type(wheel_rail_spec), intent(in) :: wheel_rail
      !> The profiles; of slices the first
      type(profile_curve), intent(in) :: rail, wheel
      !> Receives a warning about a gauge point below the profile
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      !> The profile of a ball ends at its axle, within round-off
      real(wp), parameter :: at_axle = 0.999_wp
      type(profile_curve) :: canted
      real(wp) :: low, high, s, range(2)

      associate (track => wheel_rail%track, wheelset => wheel_rail%wheelset)
         if (track%gaught > 0.0_wp .and. (wheel_rail%new_rail_profile .or. wheel_rail%new_track)) then
            canted = rail%seen_from([0.0_wp, 0.0_wp], track%cant)
            call canted%top(s, high)
            range = canted%s_range()
            low = canted%z%value(range(1))
            if (track%gaught > low - high) call log%warning("GAUGHT = " // real_text(track%gaught) // " mm, but the profile &
               &of the rail ends " // real_text(low - high) // " mm below its top on the gauge side: its gauge end is used as &
               &the gauge point")
         end if
         range = 0.0_wp
         if (wheel_rail%roller) range = rail%z%node_range()
         if (wheel_rail%roller .and. track%nomradr < at_axle*range(2)) then
            call fatal_error(error, "NOMRADR = " // real_text(track%nomradr) // " mm is less than the depth of the profile, " // &
               & real_text(range(2)) // " mm: its sides would lie beyond the axle")
            return
         end if
         range = wheel%z%node_range()
         if (wheelset%nomradw < -at_axle*range(1)) then
            call fatal_error(error, "NOMRADW = " // real_text(wheelset%nomradw) // " mm is less than the height of the &
               &profile, " // real_text(-range(1)) // " mm: it would reach beyond the axle")
            return
         end if
         range = wheel%y_range()
         if (wheelset%has_tape() .and. (wheelset%ytape < range(1) .or. wheelset%ytape > range(2))) call fatal_error(error, &
            & "YTAPE = " // real_text(wheelset%ytape) // " mm is beside the wheel profile, which extends from y = " // &
            & real_text(range(1)) // " to " // real_text(range(2)) // " mm; 999 or more means the origin of the profile")
      end associate
   end subroutine check_dimensions

   !> Convert the specification to the problem of the pair
   subroutine set_wheel_rail(session, spec, folder, log, error)
      type(wheel_rail_session), intent(inout) :: session
      type(case_spec), intent(in) :: spec
      character(len=*), intent(in) :: folder
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      !> Tolerance of DQREL [-]
      real(wp), parameter :: step_tolerance = 0.01_wp
      type(case_spec), allocatable :: first_set

      associate (problem => session%problem, template => session%problem%template)
         problem%spec = spec%wheel_rail%pair_spec
         call check_files(session, spec, folder, log, error)
         if (allocated(error)) return
         problem%force_prescribed = spec%normal == normal_control%force
         problem%geometry_only = .not. spec%solve
         problem%use_previous = spec%estimate /= estimate_choice%fresh .and. spec%link /= time_link%initiate
         problem%force = spec%force
         problem%link = spec%link
         problem%weight_power = merge(1, 2, spec%wheel_rail%search%gap_weight == 1)
         problem%relative_step = spec%wheel_rail%search%dqrel
         problem%max_elements = spec%iteration%npot_max
         problem%limits = spec%limits
         problem%estimates_errors = spec%estimates_errors
         call require_memory(int(spec%iteration%npot_max, long), bytes_per_element, "elements, as many as are allowed,", error)
         if (.not. allocated(error)) call set_model(spec, template%model, error)
         if (allocated(error)) return
         if (spec%kernel == kernel_model%tabulated) template%model%tabulated = session%coefficients%table
         if (allocated(problem%relaxation)) deallocate(problem%relaxation)
         if (spec%material_model == material_model%viscoelastic) problem%relaxation = relaxing_bodies( &
            & spec%material%poiss, spec%material%gg, spec%material%fg, spec%material%tc)
         ! the inclinations are those of each patch; in a plane there are none
         if (spec%kernel == kernel_model%conformal .and. spec%wheel_rail%search%location == contact_location%conformal) then
            allocate(template%model%inclination)
            template%model%inclination%variant = spec%material%variant
            template%model%inclination%uniform = spec%material%if_meth == 0
         end if
         associate (compliance => (1.0_wp - spec%material%poiss)/spec%material%gg)
            problem%rail_share = compliance(1)/sum(compliance)
         end associate
         call set_method(spec, template)
         template%pressure = spec%pressure
         ! a sheet is part of the bodies: the normal problem is the same
         if (spec%pressure == pressure_model%thin_sheet) template%pressure = pressure_model%full
         template%grid%my = 1
         problem%variation = spec%variation
         problem%friction_law = spec%friction_law
         if (spec%variation == variation%none) then
            call set_friction(spec, template, error)
         else
            problem%control_point = spec%friction%sets%position
            problem%control = spec%friction%sets
            allocate(first_set, source=spec)
            first_set%friction%sets = spec%friction%sets(:1)
            call set_friction(first_set, template, error)
         end if
         if (.not. allocated(error)) call set_thermal(spec, template, error)
         if (.not. allocated(error)) call set_simplified_theory(spec, template, log, error)
         if (.not. allocated(error)) call set_yield_limit(spec, template)
         if (allocated(error)) return
         ! as in module 3: particles of a layer are followed from element to element
         if (template%remembers_yield .and. spec%motion == motion%transient_rolling &
            & .and. abs(problem%relative_step - 1.0_wp) > step_tolerance) then
            problem%relative_step = 1.0_wp
            call log%warning("a layer that yields advances by one element per step: DQREL is set to 1")
         end if
         if (allocated(template%damping)) deallocate(template%damping)
         if (spec%has_damping) then
            allocate(template%damping)
            template%damping = damping_law(coefficient=[spec%damping%cdampn, spec%damping%cdampt], &
               & largest_rate=[spec%damping%dfnmax, spec%damping%dftmax])
         end if
         template%want_exterior = spec%mat_file >= 2 .or. spec%output_level >= 6
         ! the contact stiffness is used by the search for the height
         template%sensitivity = merge(sensitivity_choice%normal, sensitivity_choice%none, &
            & problem%force_prescribed .or. problem%force == force_control%massless_rail)
         template%reports_sensitivity = .false.
         template%mxsens = spec%iteration%mxsens
         template%epsens = spec%iteration%epsens
      end associate
   end subroutine set_wheel_rail

   !> Path of the file of a profile
   pure subroutine name_file(profile, folder, file)
      !> Name of the file, or points
      type(profile_spec), intent(in) :: profile
      !> Folder to which the name is relative
      character(len=*), intent(in) :: folder
      !> Path; kept if it has the right length
      character(len=:), allocatable, intent(inout) :: file
      integer :: i, before

      before = 0
      if (.not. allocated(profile%points) .and. len(folder) > 0 .and. scan(profile%name(:min(1, len(profile%name))), "/\") == 0) &
         & before = len(folder) + 1
      if (allocated(file)) then
         if (len(file) /= before + len(profile%name)) deallocate(file)
      end if
      if (.not. allocated(file)) allocate(character(len=before + len(profile%name)) :: file)
      if (before > 0) then
         file(:before - 1) = folder
         file(before:before) = "/"
      end if
      do i = 1, len(profile%name)
         file(before + i:before + i) = profile%name(i:i)
         if (profile%name(i:i) == "\") file(before + i:before + i) = "/"
      end do
   end subroutine name_file

   !> Get a profile from the store, which reads it if it is new or has changed
   subroutine load_profile(profiles, profile, side, folder, wanted, curve, surface, log, error, confined)
      !> Profiles of all cases, each read once
      type(profile_store), intent(inout) :: profiles
      !> Name of the file and how it is to be read
      type(profile_spec), intent(in) :: profile
      !> Member of profile_side
      integer, intent(in) :: side
      !> Folder to which the name is relative
      character(len=*), intent(in) :: folder
      !> Previous request to the store, replaced by the present one
      type(profile_request), intent(inout) :: wanted
      !> Smoothed profile, in its own axes [mm]
      type(profile_curve), intent(inout) :: curve
      !> Allocated on exit for slices files
      type(profile_surface), allocatable, intent(inout) :: surface
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      !> Must the file be below the folder? Default no
      logical, intent(in), optional :: confined
      type(prepared_profile), pointer :: prepared
      character(len=5) :: body
      integer :: before
      logical :: is_confined

      call name_file(profile, folder, wanted%file)
      if (allocated(profile%points)) then
         wanted%points = profile%points
      else if (allocated(wanted%points)) then
         deallocate(wanted%points)
      end if
      is_confined = .false.
      if (present(confined)) is_confined = confined
      if (is_confined) then
         wanted%below = folder
      else if (allocated(wanted%below)) then
         deallocate(wanted%below)
      end if
      wanted%side = side
      wanted%mirror_y = profile%mirror_y
      wanted%mirror_z = profile%mirror_z
      wanted%scale = profile%scale
      wanted%method = profile%smoothing_method
      wanted%smooth = profile%smoothing
      wanted%zig_zag = profile%zigzag
      wanted%kink_high = profile%kink_high
      wanted%kink_low = profile%kink_low
      wanted%kink_width = profile%kink_width
      wanted%max_hidden = profile%largest_omission
      wanted%doubt = profile%error_handling
      body = merge("rail ", "wheel", side == profile_side%rail)
      before = profiles%loads
      call profiles%get(wanted, prepared, log, error)
      if (profiles%loads > before) call log%line(" reading " // body // " profile """ // profile%name // """")
      if (allocated(error)) then
         call add_context(error, trim(body) // " profile")
         return
      end if
      if (curve%side /= prepared%curve%side .or. .not. curve%same_as(prepared%curve)) curve = prepared%curve
      if (allocated(surface)) deallocate(surface)
      if (allocated(prepared%surface)) allocate(surface, source=prepared%surface)
   end subroutine load_profile
end module contact_cases_wheel_rail_session
