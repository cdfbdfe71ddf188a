!> Input values of wheel, rail and track, once for all formats
!>
!> As in contact_cases_inputs.
module contact_cases_rail_inputs
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_cases_archive, only : case_archive, text_variable
   use contact_wheelrail_spec, only : profile_spec, rail_spec, search_spec, track_spec, wheelset_spec
   implicit none (type, external)
   private

   public :: visit_search, visit_track, visit_profile, visit_deviations, visit_springs
   public :: visit_dimensions, visit_position, visit_velocity, visit_flexibility

   !> Scale factors of profiles up to this value mean 1 [-]
   real(wp), parameter :: no_scale = 5.0e-4_wp
   !> Minimum turning angle of a zig-zag [rad]
   real(wp), parameter :: min_zigzag = 0.25_wp*pi*(1.0_wp - epsilon(1.0_wp))
   !> Value of YTAPE without tape line [mm]
   real(wp), parameter :: no_tape = 1000.0_wp

contains

   !> Contact search and discretisation
   subroutine visit_search(a, search, with_step)
      class(case_archive), intent(inout) :: a
      type(search_spec), intent(inout), target :: search
      !> Include the step in elements? In the library it is set separately
      logical, intent(in) :: with_step

      call a%real("DX", search%dx)
      call a%real("DS", search%ds)
      if (with_step) call a%real("DQREL", search%dqrel)
      call a%real("A_SEP", search%a_sep)
      call a%real("D_SEP", search%d_sep)
      call a%real("D_COMB", search%d_comb)
      call a%real("D_TURN", search%d_turn, default=search%d_turn)
      call a%real("G_MISS", search%g_miss, default=search%g_miss)
      call a%end_line()
      if (.not. a%is_reading) return
      search%a_sep = max(0.0_wp, search%a_sep)
      search%d_sep = max(0.0_wp, search%d_sep)
      if (search%d_sep < search%d_comb .and. .not. a%of_library) call a%refuse("D_SEP", " is smaller than " // &
         & trim(a%shown("D_COMB")) // "; patches must combine before they separate")
      if (.not. a%was_given("D_TURN")) search%d_turn = 2.0_wp*search%d_sep - search%d_comb
   end subroutine visit_search

   !> Position of the rail in the track, or on a roller
   subroutine visit_track(a, track, roller)
      class(case_archive), intent(inout) :: a
      type(track_spec), intent(inout), target :: track
      !> Is the wheel on a roller instead of a rail?
      logical, intent(in) :: roller
      real(wp), target :: place(2)

      place = [track%raily0, track%railz0]
      if (track%gaught > 0.0_wp) place = [0.0_wp, track%gaugwd]
      call a%real("GAUGHT", track%gaught)
      call a%real("GAUGSQ|RAILY0", place(1))
      call a%real("GAUGWD|RAILZ0", place(2))
      if (roller) then
         call a%real("NOMRADR", track%nomradr)
      else
         call a%real("CANT", track%cant)
      end if
      call a%real("CURV", track%curvature, default=0.0_wp)
      call a%end_line()
      if (.not. a%is_reading) return
      if (roller) track%cant = 0.0_wp
      if (track%gaught > 0.0_wp) then
         call a%check("GAUGSQ|RAILY0", "GAUGSQ")
         if (abs(place(1)) >= 0.5_wp) call a%warn("GAUGSQ|RAILY0", " is not used: GAUGSQ is reserved for the choice of a &
            &further gauge face")
         call a%check("GAUGWD|RAILZ0", "GAUGWD")
         track%gaugwd = place(2)
      else
         call a%check("GAUGSQ|RAILY0", "RAILY0")
         call a%check("GAUGWD|RAILZ0", "RAILZ0")
         track%raily0 = place(1)
         track%railz0 = place(2)
      end if
   end subroutine visit_track

   !> Deviations of the rail and their rates
   subroutine visit_deviations(a, rail)
      class(case_archive), intent(inout) :: a
      type(rail_spec), intent(inout), target :: rail

      call a%real("DYRAIL", rail%dy)
      call a%real("DZRAIL", rail%dz)
      call a%real("DROLLR", rail%roll)
      call a%real("VYRAIL", rail%vy)
      call a%real("VZRAIL", rail%vz)
      call a%real("VROLLR", rail%vroll)
      call a%end_line()
   end subroutine visit_deviations

   !> Springs of a massless rail and their static forces
   subroutine visit_springs(a, rail)
      class(case_archive), intent(inout) :: a
      type(rail_spec), intent(inout), target :: rail

      call a%real("KYRAIL", rail%ky)
      call a%real("FYRAIL", rail%fy)
      call a%real("KZRAIL", rail%kz)
      call a%real("FZRAIL", rail%fz)
      call a%real("DYSTEP0", rail%first_step, default=1.0_wp)
      call a%end_line()
   end subroutine visit_springs

   !> Dimensions of the wheelset
   subroutine visit_dimensions(a, wheelset)
      class(case_archive), intent(inout) :: a
      type(wheelset_spec), intent(inout), target :: wheelset

      call a%real("FBDIST", wheelset%fbdist)
      call a%real("FBPOS", wheelset%fbpos)
      call a%real("NOMRADW", wheelset%nomradw)
      call a%real("YTAPE", wheelset%ytape, default=no_tape)
      call a%end_line()
   end subroutine visit_dimensions

   !> Position of the wheelset
   subroutine visit_position(a, wheelset, roller, with_force)
      class(case_archive), intent(inout) :: a
      type(wheelset_spec), intent(inout), target :: wheelset
      !> Position relative to the top of a roller? Otherwise along a track
      logical, intent(in) :: roller
      !> Vertical force instead of the height?
      logical, intent(in) :: with_force

      if (roller) then
         call a%real("X_WS", wheelset%x)
      else
         call a%real("S_WS", wheelset%s)
      end if
      call a%real("Y_WS", wheelset%y)
      if (with_force) then
         call a%real("FZ", wheelset%fz)
      else
         call a%real("Z_WS", wheelset%z)
      end if
      call a%real("ROLL", wheelset%roll)
      call a%real("YAW", wheelset%yaw)
      call a%real("PITCH", wheelset%pitch)
      call a%end_line()
      if (.not. a%is_reading) return
      if (roller) then
         wheelset%s = 0.0_wp
      else
         wheelset%x = 0.0_wp
      end if
   end subroutine visit_position

   !> Velocity of the wheelset; in shifts the displacements and rotations of one step
   subroutine visit_velocity(a, wheelset, roller, with_force)
      class(case_archive), intent(inout) :: a
      type(wheelset_spec), intent(inout), target :: wheelset
      !> Is the wheel on a roller instead of a rail?
      logical, intent(in) :: roller
      !> Longitudinal force instead of the pitch rate?
      logical, intent(in) :: with_force

      if (roller) then
         call a%real("RPITCH", wheelset%rpitch)
      else
         call a%real("VS", wheelset%vs)
      end if
      call a%real("VY", wheelset%vy)
      call a%real("VZ", wheelset%vz)
      call a%real("VROLL", wheelset%vroll)
      call a%real("VYAW", wheelset%vyaw)
      if (with_force) then
         call a%real("FX_WS", wheelset%fx)
      else
         call a%real("VPITCH", wheelset%vpitch)
      end if
      call a%end_line()
   end subroutine visit_velocity

   !> Flexible deviations of the wheel and their rates
   subroutine visit_flexibility(a, wheelset)
      class(case_archive), intent(inout) :: a
      type(wheelset_spec), intent(inout), target :: wheelset
      character(len=7), parameter :: deviations(6) = [character(len=7) :: "DXWHL", "DYWHL", "DZWHL", "DROLLW", "DYAWW", "DPITCHW"]
      character(len=7), parameter :: rates(6) = [character(len=7) :: "VXWHL", "VYWHL", "VZWHL", "VROLLW", "VYAWW", "VPITCHW"]
      integer :: k

      do k = 1, 6
         call a%real(trim(deviations(k)), wheelset%flexible(k))
      end do
      call a%end_line()
      do k = 1, 6
         call a%real(trim(rates(k)), wheelset%flexible_rate(k))
      end do
      call a%end_line()
   end subroutine visit_flexibility

   !> Name of a profile file and options for reading it
   subroutine visit_profile(a, name, profile)
      class(case_archive), intent(inout) :: a
      !> Name of the item that holds the name of the file
      character(len=*), intent(in) :: name
      !> Levels of error handling are kept if the case does not give others
      type(profile_spec), intent(inout), target :: profile
      type(text_variable), target :: file
      type(profile_spec) :: previous
      integer, target :: option

      if (a%is_reading) then
         previous = profile
         profile = profile_spec()
      else
         file%value = profile%name
      end if
      option = 2
      call a%text(name, file)
      call a%integer("MIRRORY", profile%mirror_y)
      call a%real("SCALEYZ", profile%scale)
      call a%real("SMOOTH", profile%smoothing)
      call a%integer("MIRRORZ", profile%mirror_z, default=0)
      call a%integer("PRFOPT", option, default=0)
      call a%end_line()
      if (a%is_reading .and. a%is_good) then
         profile%name = file%value
         call a%place(name, profile%line, profile%column)
         if (len_trim(profile%name) == 0) call a%refuse(name, " is empty; it must be the name of a profile file")
         if (profile%scale < 0.0_wp) call a%refuse("SCALEYZ", &
            & " cannot be used; accepted is a factor to mm; MIRRORY and MIRRORZ mirror a profile")
         if (profile%scale <= no_scale) profile%scale = 1.0_wp
         profile%smoothing = max(0.0_wp, profile%smoothing)
      end if
      if (option < 1) return

      if (a%is_reading) then
         profile%error_handling = previous%error_handling
         profile%largest_omission = previous%largest_omission
      end if
      call a%integer("ISMOOTH", profile%smoothing_method)
      call a%real("ZIGTHRS", profile%zigzag)
      call a%real("KINKHIGH", profile%kink_high)
      call a%real("KINKLOW", profile%kink_low)
      call a%real("KINKWID", profile%kink_width)
      call a%end_line()
      if (profile%zigzag < min_zigzag) call a%refuse("ZIGTHRS", &
         & " cannot be used; accepted is an angle of at least 45 degrees (45d), 180d and more for none")
      if (option < 2) return
      call a%integer("ERRHND", profile%error_handling)
      call a%real("MAXOMIT", profile%largest_omission)
      call a%end_line()
      if (profile%largest_omission < 0.0_wp .or. profile%largest_omission > 1.0_wp) call a%refuse("MAXOMIT", &
         & " cannot be used; accepted is a part of the length, 0 to 1")
   end subroutine visit_profile
end module contact_cases_rail_inputs
