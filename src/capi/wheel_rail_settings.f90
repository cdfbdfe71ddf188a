!> Settings of track, rail and wheelset (module 1)
module contact_capi_wheel_rail_settings
   use contact_base_kinds, only : wp
   use contact_capi_messages, only : log_message
   use contact_capi_motion, only : follow_digits
   use contact_capi_problem, only : library_problem
   use contact_capi_caller, only : caller
   use contact_cases_rail_inputs, only : visit_deviations, visit_dimensions, visit_flexibility, visit_position, visit_springs, &
      & visit_velocity
   use contact_control_translation, only : is_on_roller
   use contact_text_words, only : integer_text
   use contact_wheelrail_spec, only : rail_spec, track_spec, wheelset_spec
   implicit none (type, external)
   private

   public :: set_track, set_wheelset

contains

   !> Position of the rail in the track, deviations of the rail, springs of a massless rail (Z)
   subroutine set_track(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem
      type(track_spec) :: track
      type(rail_spec) :: rail

      associate (method => a%single(1), wheel_rail => problem%spec%wheel_rail)
         ! methods that set the same group belong together
         select case (method)
         case (0); continue
         case (1); problem%setting%group = "track"
         case (2); problem%setting%group = "deviations of the rail"
         case (3); problem%setting%group = "track|deviations of the rail"
         case (32, 33); problem%setting%group = "springs of the rail"
         case default; call a%refuse_call("there is no track method " // integer_text(method) // "; 0, 1, 2, 3, 32 and 33 are")
         end select
         track = wheel_rail%track
         rail = wheel_rail%rail
         do while (a%next_pass())
            if (method == 1 .or. method == 3) call visit_place(a, track)
            if (method == 2 .or. method == 3) call visit_deviations(a, rail)
            if (method >= 32) call visit_springs(a, rail)
         end do
         if (.not. a%is_good) return
         problem%digits%z = merge(0, 3, method == 0)
         wheel_rail%track = track
         wheel_rail%rail = rail
         if (method == 2 .or. method == 3) problem%given%rail%is_new = .true.
         call follow_digits(problem)
      end associate
   end subroutine set_track

   !> Gauge or absolute position, cant, radius of a roller, curvature
   subroutine visit_place(a, track)
      type(caller), intent(inout) :: a
      type(track_spec), intent(inout), target :: track
      real(wp), target :: square

      call a%real("GAUGHT", track%gaught)
      call a%end_line()
      if (track%gaught > 0.0_wp) then
         call a%real("GAUGSQ", square)
         call a%real("GAUGWD", track%gaugwd)
      else
         call a%real("RAILY0", track%raily0)
         call a%real("RAILZ0", track%railz0)
      end if
      call a%real("CANT", track%cant)
      call a%real("NOMRADR", track%nomradr, unchecked=.true.)
      call a%end_line()
      ! a track has no roller
      if (.not. abs(track%nomradr) <= 0.0_wp) call a%check("NOMRADR")
      call a%real("CURV", track%curvature, default=0.0_wp)
      call a%end_line()
   end subroutine visit_place

   !> Dimensions, position, velocity and flexible deviations of the wheelset: each routine sets its numbers, and E becomes the digit
   !> of an equivalent case of an input file
   subroutine set_wheelset(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem
      type(wheelset_spec) :: wheelset
      logical :: has_dimensions, is_roller

      associate (routine => a%call_of%name, method => a%single(1), e => problem%digits%e)
         has_dimensions = routine == "cntc_setWheelsetDimensions"
         if (method == 0 .and. .not. has_dimensions) return
         if (method < 0 .or. method > 5) call a%refuse_call("there is no wheelset method " // integer_text(method) // &
            & "; 0 to 5 are")
         wheelset = problem%stored%wheelset
         is_roller = is_on_roller(problem%digits)
         do while (a%next_pass())
            select case (routine)
            case ("cntc_setWheelsetDimensions")
               if (method == 3 .or. method == 5) call visit_dimensions(a, wheelset)
            ! on rollers as well; the meaning of the first value, which depends on the track, is resolved when the case is solved
            case ("cntc_setWheelsetPosition")
               call visit_position(a, wheelset, roller=.false., with_force=.false.)
            ! on rollers the first value is the pitch rate of the roller
            case ("cntc_setWheelsetVelocity")
               call visit_velocity(a, wheelset, is_roller, with_force=.false.)
            case default
               if (method >= 4) then
                  call visit_flexibility(a, wheelset)
               else
                  call a%skip(optional=.true.)
                  wheelset%flexible = 0.0_wp
                  wheelset%flexible_rate = 0.0_wp
               end if
            end select
         end do
         if (.not. a%is_good) return
         select case (routine)
         case ("cntc_setWheelsetDimensions")
            if (e <= 4) e = merge(method, 5, e <= 3)
         case ("cntc_setWheelsetPosition")
            e = max(1, e)
         case ("cntc_setWheelsetVelocity")
            if (method == 1) call log_message(1, a%call_of, "method 1 is treated as 2")
            if (e <= 1) e = max(2, method)
         case default
            if (method >= 4) then
               e = merge(5, 4, method == 5 .or. e == 3 .or. e == 5)
            else if (e >= 4) then
               e = e - 2
            end if
         end select
         problem%stored%wheelset = wheelset
         if (routine == "cntc_setWheelsetFlexibility") problem%given%flexible%is_new = .true.
         if (routine == "cntc_setWheelsetVelocity") then
            problem%given%numbers(1) = a%numbers(1)%v(1)
            problem%given%units = problem%units
            problem%given%values%is_new = .true.
         end if
         call follow_digits(problem)
      end associate
   end subroutine set_wheelset
end module contact_capi_wheel_rail_settings
