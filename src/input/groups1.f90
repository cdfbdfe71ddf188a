!> The groups of a case of module 1 that module 3 does not have: friction over the rail, search,
!> track, rail, wheelset, and their profiles
module contact_input_groups1
   use contact_base_choices, only : contact_location, normal_control
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec, friction_set
   use contact_wheelrail_spec, only : profile_spec, wheelset_spec
   use contact_control_digits1, only : choice1_of
   use contact_input_groups3, only : read_friction_memory, read_friction_set
   use contact_input_problems, only : problem_list, severity
   use contact_input_values, only : read_values
   use contact_text_lexer, only : input_lexer, input_value
   use contact_text_words, only : real_text
   implicit none (type, external)
   private

   public :: read_friction_points, read_search, read_track, read_wheelset

   !> Numbers of control points of friction that can be given
   integer, parameter :: most_points = 10
   !> Control points of friction lie at least this far apart [rad] or [mm]
   real(wp), parameter :: least_step = 1.0e-6_wp
   !> Scales below this value mean 1 [-]
   real(wp), parameter :: no_scale = 5.0e-4_wp
   !> Smallest turning angle that makes a zig-zag [rad]
   real(wp), parameter :: least_zigzag = 0.25_wp*pi*(1.0_wp - epsilon(1.0_wp))

contains

   !> Friction (L other than 1): one set, or one per angle (V = 1) or position along the track (V = 2)
   subroutine read_friction_points(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(friction_set), allocatable :: sets(:)
      type(input_value) :: v(1), previous
      integer :: k, n

      if (spec%digits%l == 1) return
      n = 1
      if (spec%digits%v == 1 .or. spec%digits%v == 2) then
         call read_values(lexer, "i", "NVF", v, problems, error)
         if (allocated(error)) return
         n = min(max(1, v(1)%i), most_points)
      end if
      allocate(sets(n))
      do k = 1, n
         if (spec%digits%v == 0) then
            call read_friction_set(lexer, spec%digits%l, sets(k), problems, error)
            if (allocated(error)) return
            cycle
         end if
         v(1)%name = trim(merge("ALPHA", "SVF  ", spec%digits%v == 1))
         call read_friction_set(lexer, spec%digits%l, sets(k), problems, error, v(1))
         if (allocated(error)) return
         sets(k)%position = v(1)%r
         if (k > 1) then
            if (.not. sets(k)%position >= sets(k - 1)%position + least_step) call problems%add(severity%error, &
               & v(1)%name // " = " // v(1)%word // " does not lie above the one before it, " // previous%word // &
               & "; control points of friction must increase by at least 1e-6", v(1)%line, v(1)%column)
         end if
         previous = v(1)
      end do
      call move_alloc(sets, spec%friction%sets)
      call read_friction_memory(lexer, spec, problems, error)
   end subroutine read_friction_points

   !> Contact search and discretisation (D of 2 and above)
   subroutine read_search(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(8)

      if (spec%digits%d < 2) return
      associate (search => spec%wheel_rail%search)
         search%location = choice1_of("D", spec%digits%d)
         call read_values(lexer, "rrrarrRR", "DX DS DQREL A_SEP D_SEP D_COMB D_TURN G_MISS", v, problems, error)
         if (allocated(error)) return
         search%dx = v(1)%r
         search%ds = v(2)%r
         search%dqrel = v(3)%r
         search%a_sep = max(0.0_wp, v(4)%r)
         search%d_sep = max(0.0_wp, v(5)%r)
         search%d_comb = v(6)%r
         if (search%d_sep < search%d_comb) call problems%add(severity%error, "D_SEP = " // v(5)%word // &
            & " is smaller than D_COMB = " // v(6)%word // "; patches must combine before they separate", v(5)%line, v(5)%column)
         search%d_turn = 2.0_wp*search%d_sep - search%d_comb
         if (v(7)%given) search%d_turn = v(7)%r
         if (v(8)%given) search%g_miss = v(8)%r
      end associate
   end subroutine read_search

   !> Track dimensions, rail profile, deviations of the rail and its springs (Z)
   subroutine read_track(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(6)
      logical :: by_gauge

      associate (track => spec%wheel_rail%track, rail => spec%wheel_rail%rail)
         if (spec%digits%z == 1 .or. spec%digits%z == 3) then
            if (spec%wheel_rail%roller) then
               call read_values(lexer, "rrrrR", "GAUGHT GAUGSQ|RAILY0 GAUGWD|RAILZ0 NOMRADR CURV", v, problems, error)
               if (allocated(error)) return
               track%nomradr = v(4)%r
               track%cant = 0.0_wp
            else
               call read_values(lexer, "rrraR", "GAUGHT GAUGSQ|RAILY0 GAUGWD|RAILZ0 CANT CURV", v, problems, error)
               if (allocated(error)) return
               track%cant = v(4)%r
            end if
            track%gaught = v(1)%r
            by_gauge = track%gaught > 0.0_wp
            if (by_gauge) then
               call problems%check_bounds(v(2), "GAUGSQ")
               call problems%check_bounds(v(3), "GAUGWD")
               track%gaugwd = v(3)%r
            else
               call problems%check_bounds(v(2), "RAILY0")
               call problems%check_bounds(v(3), "RAILZ0")
               track%raily0 = v(2)%r
               track%railz0 = v(3)%r
            end if
            track%curvature = 0.0_wp
            if (v(5)%given) track%curvature = v(5)%r
         end if
         if (spec%digits%z == 3) then
            call read_profile_choice(lexer, "RFNAME", spec%wheel_rail%rail_profile, problems, error)
            if (allocated(error)) return
            spec%wheel_rail%new_rail_profile = .true.
            if (track%gaught > 0.0_wp .and. is_slices(spec%wheel_rail%rail_profile)) call problems%add(severity%error, &
               & "GAUGHT = " // real_text(track%gaught) // " places the rail by its gauge point, but the profile varies along " // &
               & "the track; a slices file needs absolute placement, GAUGHT = 0 or negative", &
               & spec%wheel_rail%rail_profile%line, spec%wheel_rail%rail_profile%column)
         end if
         if (spec%digits%z >= 2) then
            call read_values(lexer, "rrarra", "DYRAIL DZRAIL DROLLR VYRAIL VZRAIL VROLLR", v, problems, error)
            if (allocated(error)) return
            rail%dy = v(1)%r
            rail%dz = v(2)%r
            rail%roll = v(3)%r
            rail%vy = v(4)%r
            rail%vz = v(5)%r
            rail%vroll = v(6)%r
            if (spec%digits%f == 3) then
               call read_values(lexer, "rrrrR", "KYRAIL FYRAIL KZRAIL FZRAIL DYSTEP0", v, problems, error)
               if (allocated(error)) return
               rail%ky = v(1)%r
               rail%fy = v(2)%r
               rail%kz = v(3)%r
               rail%fz = v(4)%r
               rail%first_step = 1.0_wp
               if (v(5)%given) rail%first_step = v(5)%r
            end if
         end if
         if (spec%digits%f == 3 .and. spec%digits%n == 0 .and. .not. rail%kz > 0.0_wp) call problems%add(severity%error, &
            & "KZRAIL = " // real_text(rail%kz) // ": a rail on springs with a prescribed height, F = 3 and N = 0, " // &
            & "needs a vertical stiffness above 0", lexer%line)
      end associate
   end subroutine read_track

   !> Wheelset dimensions, wheel profile, position, velocity, flexible deviations (E)
   !>
   !> Flexible deviations stay until others are given.
   subroutine read_wheelset(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(6)

      associate (wheelset => spec%wheel_rail%wheelset)
         if (spec%digits%e == 3 .or. spec%digits%e == 5) then
            call read_values(lexer, "rrrR", "FBDIST FBPOS NOMRADW YTAPE", v, problems, error)
            if (allocated(error)) return
            wheelset%fbdist = v(1)%r
            wheelset%fbpos = v(2)%r
            wheelset%nomradw = v(3)%r
            wheelset%ytape = 1000.0_wp
            if (v(4)%given) wheelset%ytape = v(4)%r
            call read_profile_choice(lexer, "WFNAME", spec%wheel_rail%wheel_profile, problems, error)
            if (allocated(error)) return
            spec%wheel_rail%new_wheel_profile = .true.
         end if
         if (spec%digits%e >= 1) then
            call read_position(lexer, spec, wheelset, problems, error)
            if (allocated(error)) return
         end if
         if (spec%digits%e >= 2) then
            call read_velocity(lexer, spec, wheelset, problems, error)
            if (allocated(error)) return
         end if
         if (spec%digits%e >= 4) then
            call read_values(lexer, "rrraaa", "DXWHL DYWHL DZWHL DROLLW DYAWW DPITCHW", v, problems, error)
            if (allocated(error)) return
            wheelset%flexible = v%r
            call read_values(lexer, "rrraaa", "VXWHL VYWHL VZWHL VROLLW VYAWW VPITCHW", v, problems, error)
            if (allocated(error)) return
            wheelset%flexible_rate = v%r
         end if
      end associate
   end subroutine read_wheelset

   !> Position of the wheelset; the vertical force takes the place of its height when that is prescribed
   subroutine read_position(lexer, spec, wheelset, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(in) :: spec
      type(wheelset_spec), intent(inout) :: wheelset
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(6)
      character(len=:), allocatable :: names

      names = trim(merge("X_WS", "S_WS", spec%wheel_rail%roller)) // " Y_WS " // &
         & trim(merge("FZ  ", "Z_WS", spec%normal == normal_control%force)) // " ROLL YAW PITCH"
      call read_values(lexer, "rrraaa", names, v, problems, error)
      if (allocated(error)) return
      wheelset%s = 0.0_wp
      wheelset%x = 0.0_wp
      if (spec%wheel_rail%roller) then
         wheelset%x = v(1)%r
      else
         wheelset%s = v(1)%r
      end if
      wheelset%y = v(2)%r
      if (spec%normal == normal_control%force) then
         wheelset%fz = v(3)%r
      else
         wheelset%z = v(3)%r
      end if
      wheelset%roll = v(4)%r
      wheelset%yaw = v(5)%r
      wheelset%pitch = v(6)%r
   end subroutine read_position

   !> Velocity of the wheelset; in shifts the displacements and rotations of one step
   subroutine read_velocity(lexer, spec, wheelset, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(in) :: spec
      type(wheelset_spec), intent(inout) :: wheelset
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(6)
      character(len=:), allocatable :: names, types

      types = "rrraaa"
      names = "VS VY VZ VROLL VYAW"
      if (spec%wheel_rail%roller) then
         types = "arraaa"
         names = "RPITCH VY VZ VROLL VYAW"
      end if
      if (spec%digits%f == 1) then
         types(6:6) = "r"
         names = names // " FX_WS"
      else
         names = names // " VPITCH"
      end if
      call read_values(lexer, types, names, v, problems, error)
      if (allocated(error)) return
      if (spec%wheel_rail%roller) then
         wheelset%rpitch = v(1)%r
      else
         wheelset%vs = v(1)%r
      end if
      wheelset%vy = v(2)%r
      wheelset%vz = v(3)%r
      wheelset%vroll = v(4)%r
      wheelset%vyaw = v(5)%r
      if (spec%digits%f == 1) then
         wheelset%fx = v(6)%r
      else
         wheelset%vpitch = v(6)%r
      end if
   end subroutine read_velocity

   !> Name of a profile file and how to read it
   subroutine read_profile_choice(lexer, name, profile, problems, error)
      type(input_lexer), intent(inout) :: lexer
      !> Name of the item
      character(len=*), intent(in) :: name
      !> Error handling keeps its previous values where the case does not give new ones
      type(profile_spec), intent(inout) :: profile
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(6)
      type(profile_spec) :: previous
      integer :: option

      previous = profile
      call read_values(lexer, "sirrII", name // " MIRRORY SCALEYZ SMOOTH MIRRORZ PRFOPT", v, problems, error)
      if (allocated(error)) return
      profile = profile_spec()
      profile%name = v(1)%s
      profile%line = v(1)%line
      profile%column = v(1)%column
      if (len_trim(profile%name) == 0) call problems%add(severity%error, name // " is empty; it must be the name of a " // &
         & "profile file", v(1)%line, v(1)%column)
      profile%mirror_y = v(2)%i
      profile%scale = v(3)%r
      call expect(v(3), v(3)%r >= 0.0_wp, "a factor to mm; MIRRORY and MIRRORZ mirror a profile")
      if (v(3)%r <= no_scale) profile%scale = 1.0_wp
      profile%smoothing = max(0.0_wp, v(4)%r)
      if (v(5)%given) then
         profile%mirror_z = v(5)%i
      end if
      option = 0
      if (v(6)%given) then
         option = v(6)%i
      end if
      if (option < 1) return

      profile%error_handling = previous%error_handling
      profile%largest_omission = previous%largest_omission
      call read_values(lexer, "iaaar", "ISMOOTH ZIGTHRS KINKHIGH KINKLOW KINKWID", v, problems, error)
      if (allocated(error)) return
      profile%smoothing_method = v(1)%i
      profile%zigzag = v(2)%r
      call expect(v(2), v(2)%r >= least_zigzag, "an angle of at least 45 degrees (45d), 180d and more for none")
      profile%kink_high = v(3)%r
      profile%kink_low = v(4)%r
      profile%kink_width = v(5)%r
      if (option < 2) return
      call read_values(lexer, "ir", "ERRHND MAXOMIT", v, problems, error)
      if (allocated(error)) return
      profile%error_handling = v(1)%i
      profile%largest_omission = v(2)%r
      call expect(v(2), v(2)%r >= 0.0_wp .and. v(2)%r <= 1.0_wp, "a part of the length, 0 to 1")

   contains

      !> Refuse a number that the preparation of profiles cannot use
      subroutine expect(value, usable, accepted)
         type(input_value), intent(in) :: value
         logical, intent(in) :: usable
         character(len=*), intent(in) :: accepted

         if (.not. usable) call problems%add(severity%error, value%name // " = " // value%word // &
            & " cannot be used; accepted is " // accepted, value%line, value%column)
      end subroutine expect
   end subroutine read_profile_choice

   !> Is it a file with slices of a variable profile?
   pure logical function is_slices(profile)
      type(profile_spec), intent(in) :: profile
      integer :: dot
      character(len=4) :: extension

      is_slices = .false.
      dot = index(profile%name, ".", back=.true.)
      if (dot == 0) return
      extension = profile%name(dot + 1:)
      is_slices = extension == "slcs" .or. extension == "slcw" .or. extension == "SLCS" .or. extension == "SLCW"
   end function is_slices
end module contact_input_groups1
