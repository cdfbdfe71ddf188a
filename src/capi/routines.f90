!> Common part of all routines for settings and results: unpacks arguments, finds the problem, and locks it against other threads
!>
!> A routine receives its arguments as a `caller`. A null pointer from C is read as a missing value: no elements, `no_number`, or
!> NaN; for a result, nothing is written.
module contact_capi_routines
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_double, c_f_pointer, c_int, c_null_char, c_ptr
   use contact_base_kinds, only : wp
   use contact_capi_arguments, only : integer_of, path_of, real_of
   use contact_capi_caller, only : caller, result_buffer
   use contact_capi_contact, only : set_creepages, set_extra_slip, set_grid, set_hertz, set_normal, set_undeformed_distance, &
      & set_velocity
   use contact_capi_fields, only : get_errors, get_field, get_fields, get_largest_temperatures, get_wear
   use contact_capi_flags, only : get_flags, set_flags, set_metadata
   use contact_capi_messages, only : log_message
   use contact_capi_physics, only : set_friction, set_heat, set_materials, set_rolling_step, set_solver, set_tangential_forces, &
      & set_time_step, set_wear
   use contact_capi_problem, only : library_problem
   use contact_capi_profile_values, only : get_profile_values
   use contact_capi_profiles, only : set_profile
   use contact_capi_registry, only : enter, leave, scope, scope_type
   use contact_capi_results, only : get_approach, get_creepages, get_element_sides, get_grid, get_hertz, get_parameters, &
      & get_sensitivities, get_time, kinematic_constants, reset_time
   use contact_capi_subsurface, only : add_block, get_block, get_block_size
   use contact_capi_view, only : look_at, result_view
   use contact_capi_wheel_rail_results, only : get_forces, get_location, get_wheelset_position, get_wheelset_velocity
   use contact_capi_wheel_rail_settings, only : set_track, set_wheelset
   use contact_control_units, only : outward, quantity
   implicit none (type, external)
   private

   public :: run_routine

   !> Maximum number of points of a profile
   integer, parameter :: most_points = 1000000

contains

   !> Run a routine
   subroutine run_routine(name, kinds, arguments) bind(c, name="contact_run_routine")
      !> Name of the routine in messages; letters for the problems it applies to and for each of its arguments, see
      !> make_interface.py. Null-terminated
      character(kind=c_char), intent(in) :: name(*), kinds(*)
      !> Addresses of the arguments
      type(c_ptr), intent(in) :: arguments(*)
      type(library_problem), pointer :: problem
      type(result_view) :: view
      type(caller), target :: a
      integer :: k

      do k = 1, len(a%call_of%name)
         if (name(k) == c_null_char) exit
         a%call_of%name(k:k) = name(k)
      end do
      a%is_reading = .true.
      a%of_library = .true.
      call unpack_arguments(kinds, arguments, a)
      call enter(a%call_of, scope_of(kinds(1)), problem)
      if (.not. associated(problem)) return
      a%units = problem%units
      if (kinds(1) == "v") view = look_at(a%call_of, problem)
      if (kinds(1) /= "v" .or. associated(view%patch)) call execute_call(a, problem, view)
      call leave(problem)
   end subroutine run_routine

   !> Apply a setting, or give results
   subroutine execute_call(a, problem, view)
      type(caller), intent(inout) :: a
      type(library_problem), pointer, intent(inout) :: problem
      !> For routines that require a solved patch
      type(result_view), intent(in) :: view

      select case (a%call_of%name)
      case ("cntc_setFlags"); call set_flags(a, problem)
      case ("cntc_setMetadata"); call set_metadata(a, problem)
      case ("cntc_setSolverFlags"); call set_solver(a, problem)
      case ("cntc_setMaterialParameters"); call set_materials(a, problem)
      case ("cntc_setTemperatureData"); call set_heat(a, problem)
      case ("cntc_setWear"); call set_wear(a, problem)
      case ("cntc_setTimeStep"); call set_time_step(a)
      case ("cntc_setRollingStepsize"); call set_rolling_step(a, problem)
      case ("cntc_setFrictionMethod"); call set_friction(a, problem)
      case ("cntc_setTangentialForces"); call set_tangential_forces(a, problem)
      case ("cntc_setPotContact"); call set_grid(a, problem)
      case ("cntc_setHertzContact"); call set_hertz(a, problem)
      case ("cntc_setUndeformedDistc"); call set_undeformed_distance(a, problem)
      case ("cntc_setPenetration"); call set_normal(a, "PEN", problem%stored%kinematics%pen, problem%digits%n, 0)
      case ("cntc_setNormalForce"); call set_normal(a, "FN", problem%stored%kinematics%fn, problem%digits%n, 1)
      case ("cntc_setVerticalForce"); call set_normal(a, "FZ", problem%stored%wheelset%fz, problem%digits%n, 1)
      case ("cntc_setCreepages"); call set_creepages(a, problem)
      case ("cntc_setExtraRigidSlip"); call set_extra_slip(a, problem)
      case ("cntc_setReferenceVelocity"); call set_velocity(a, problem)
      case ("cntc_setTrackDimensions"); call set_track(a, problem)
      case ("cntc_setWheelsetDimensions", "cntc_setWheelsetPosition", "cntc_setWheelsetVelocity", "cntc_setWheelsetFlexibility")
         call set_wheelset(a, problem)
      case ("cntc_setProfileInputFname", "cntc_setProfileInputValues"); call set_profile(a, problem)
      case ("subs_addBlock"); call add_block(a, problem)
      case ("cntc_resetCalculationTime"); call reset_time(a, problem)
      case ("cntc_getFlags"); call get_flags(a, problem)
      case ("cntc_getParameters"); call get_parameters(a, problem)
      case ("cntc_getProfileValues"); call get_profile_values(a, problem)
      case ("cntc_getProfileValues_new")
         call get_profile_values(a, problem)
         call log_message(0, a%call_of, "the same as cntc_getProfileValues")
      case ("cntc_getWheelsetPosition"); call get_wheelset_position(a, problem)
      case ("cntc_getWheelsetVelocity"); call get_wheelset_velocity(a, problem)
      case ("cntc_getNumContactPatches"); call a%set_each_result([size(problem%wheel_rail_result%patches)])
      case ("cntc_getContactLocation"); call get_location(a, problem)
      case ("cntc_getReferenceVelocity"); call a%set_result(1, kinematic_constants(problem, a%call_of%icp))
      case ("cntc_getHertzContact"); call get_hertz(a, problem)
      case ("cntc_getGridDiscretization"); call get_element_sides(a, problem)
      case ("cntc_getPenetration"); call get_approach(a, problem)
      case ("cntc_getCreepages"); call get_creepages(a, problem)
      case ("cntc_getGlobalForces"); call get_forces(a, problem)
      case ("cntc_getCalculationTime"); call get_time(a, problem)
      case ("subs_getBlocksize"); call get_block_size(a, problem)
      case ("subs_getResults"); call get_block(a, problem)
      case ("cntc_getNumElements"); call a%set_each_result([view%patch%grid%mx, view%patch%grid%my])
      case ("cntc_getPotContact"); call get_grid(a, problem, view)
      case ("cntc_getContactForces"); call a%set_each_result(view%totals(["fn", "fx", "fy", "mz"]))
      case ("cntc_getContactPatchAreas")
         call a%set_each_result([view%patch%ncon, view%patch%nadh, view%patch%nslip]*(view%patch%grid%dx*view%patch%grid%dy &
            & *outward(view%units, quantity%area)))
      case ("cntc_getElementDivision")
         call a%set_result(1, reshape(view%patch%division(:, view%rows()), [size(view%patch%division)]))
      case ("cntc_getMaximumPressure"); call a%set_each_result(view%totals(["pmax"]))
      case ("cntc_getMaximumTraction")
         call a%set_each_result([maxval(hypot(view%patch%px, view%patch%py))*outward(view%units, quantity%pressure)])
      case ("cntc_getMaximumTemperature"); call get_largest_temperatures(a, view)
      case ("cntc_getErrors"); call get_errors(a, view)
      case ("cntc_getWear"); call get_wear(a, view)
      case ("cntc_getFieldData"); call get_field(a, view)
      case ("cntc_getTractions"); call get_fields(a, view, ["pn", "px", "py"])
      case ("cntc_getMicroSlip"); call get_fields(a, view, ["sx", "sy"])
      case ("cntc_getDisplacements"); call get_fields(a, view, ["un", "ux", "uy"])
      case ("cntc_getSensitivities"); call get_sensitivities(a, problem, view)
      end select
   end subroutine execute_call

   !> Problems to which a routine applies
   pure type(scope_type) function scope_of(letter) result(allowed)
      !> The first letter of its kinds
      character(kind=c_char), intent(in) :: letter

      select case (letter)
      case ("a"); allowed = scope%any
      case ("c"); allowed = scope%contact
      case ("w"); allowed = scope%wheel_rail
      case ("g"); allowed = scope%wheel_rail_any
      case ("l"); allowed = scope%wheel_rail_patch
      case ("p", "v"); allowed = scope%one_patch
      case default; allowed = scope%settings
      end select
   end function scope_of

   !> Unpack the arguments of a call
   subroutine unpack_arguments(kinds, arguments, a)
      character(kind=c_char), intent(in) :: kinds(*)
      type(c_ptr), intent(in) :: arguments(*)
      type(caller), intent(inout), target :: a
      real(c_double), pointer :: list(:)
      integer(c_int), pointer :: integers(:)
      character(kind=c_char), pointer :: letters(:)
      integer :: k, place, length, results, singles, single_reals, integer_lists, real_lists

      results = 0
      singles = 0
      single_reals = 0
      integer_lists = 0
      real_lists = 0
      a%numbers(1)%v => a%single_reals(:0)
      k = 2
      place = 1
      do while (kinds(k) /= c_null_char)
         select case (kinds(k))
         case ("e")
            a%call_of%ire = integer_at(arguments(place))
         case ("p")
            a%call_of%icp = integer_at(arguments(place))
         case ("i")
            singles = singles + 1
            a%single(singles) = integer_at(arguments(place))
         case ("r")
            single_reals = single_reals + 1
            a%single_reals(single_reals) = real_at(arguments(place))
            a%numbers(1)%v => a%single_reals(:single_reals)
         case ("I")
            call get_length()
            integer_lists = integer_lists + 1
            a%has_integers = .true.
            call c_f_pointer(arguments(place), integers, [length])
            a%integers(integer_lists)%v => integers
         case ("R", "P")
            call get_length()
            real_lists = real_lists + 1
            call c_f_pointer(arguments(place), list, [length])
            a%numbers(real_lists)%v => list
         case ("T")
            call get_length()
            call c_f_pointer(arguments(place), letters, [length])
            a%path = trim(path_of(letters, int(length, c_int)))
         case ("x", "X")
            length = merge(1, 0, c_associated(arguments(place)))
            if (kinds(k) == "X") call get_length()
            results = results + 1
            a%buffers(results) = result_buffer(arguments(place), length)
         end select
         k = k + 1
         place = place + 1
      end do

   contains

      !> Number of elements of an array, from the argument that contains its length; 0 if the array is missing
      subroutine get_length()
         length = max(0, integer_at(arguments(1 + iachar(kinds(k + 1)) - iachar("0"))))
         if (.not. c_associated(arguments(place))) length = 0
         if (kinds(k) == "P") length = merge(2*length, 0, length <= most_points)
         k = k + 1
      end subroutine get_length
   end subroutine unpack_arguments

   !> An integer argument
   integer function integer_at(address) result(value)
      type(c_ptr), intent(in) :: address
      integer(c_int), pointer :: argument

      nullify(argument)
      if (c_associated(address)) call c_f_pointer(address, argument)
      value = integer_of(argument)
   end function integer_at

   !> A real argument
   real(wp) function real_at(address) result(value)
      type(c_ptr), intent(in) :: address
      real(c_double), pointer :: argument

      nullify(argument)
      if (c_associated(address)) call c_f_pointer(address, argument)
      value = real_of(argument)
   end function real_at
end module contact_capi_routines
