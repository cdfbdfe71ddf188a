!> Reading of cases of module 1: stored and kept values, and faulty input
program test_reader1
   use contact_base_choices, only : contact_location, normal_control, variation
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_input_problems, only : problem_list, problem_text, severity
   use contact_input_reader, only : read_case
   use contact_test_harness, only : test_suite
   use contact_text_lexer, only : input_lexer
   use contact_friction_new_law, only : friction_model
   implicit none (type, external)
   character, parameter :: nl = achar(10)
   real(wp), parameter :: closed = 100.0_wp*epsilon(1.0_wp)
   type(test_suite) :: suite

   call suite%start("reader of module 1")
   call full_case(suite)
   call kept_values(suite)
   call kept_numbers(suite)
   call roller(suite)
   call friction_points(suite)
   call faulty_cases(suite)
   call unbuilt_cases(suite)
   call suite%finish()

contains

   !> A first case; each argument replaces a line of it, semicolons begin new lines
   function new_case(word1, word2, friction, search, rail, wheelset) result(text)
      character(len=*), intent(in), optional :: word1, word2, friction, search, rail, wheelset
      character(len=:), allocatable :: text
      integer :: k

      text = line("1203100", word1) // line("0022033", word2) // "0000321;" // "999 100 30 1 1e-5;" &
         & // line("0.3 0.25", friction) // "0.28 0.28 82000. 82000.;" // line("0.2 0.3 1. 90d 8. 4.", search) &
         & // line("14. 0 1435. 0.025;'rail.prr' 0 1. 0.  RFNAME;1. 2. 0.003 4. 5. 0.006", rail) &
         & // line("1360. -70. 460.;'wheel.prw' 1 1. 2.5 -1 1;1 100d 20d 4d 1.5;0. 0.5 10000. 1d 0.002 0.1;" // &
         & "2000. 1. 2. 3d 0.004 -4.3", wheelset)
      do k = 1, len(text)
         if (text(k:k) == ";") text(k:k) = nl
      end do
   end function new_case

   function line(default, given) result(text)
      character(len=*), intent(in) :: default
      character(len=*), intent(in), optional :: given
      character(len=:), allocatable :: text

      text = default // ";"
      if (present(given)) text = given // ";"
      if (text == ";") text = ""
   end function line

   !> Read a text after a previous case, or as the first one
   subroutine read_text(text, spec, problems, error, previous)
      character(len=*), intent(in) :: text
      type(case_spec), intent(out) :: spec
      type(problem_list), intent(out) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(case_spec), intent(in), optional :: previous
      type(input_lexer) :: lexer
      type(case_spec) :: nothing
      integer :: first_line

      call lexer%open_text(text, "test")
      if (present(previous)) then
         call read_case(lexer, 1, previous, .true., 2, spec, problems, error, first_line=first_line)
      else
         call read_case(lexer, 1, nothing, .false., 1, spec, problems, error, first_line=first_line)
      end if
   end subroutine read_text

   subroutine full_case(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_text(new_case(), spec, problems, error)
      call suite%check(.not. allocated(error), "a complete first case")
      if (allocated(error)) return
      call suite%check(problems%number_of(severity%error) == 0, "has no errors")
      call suite%check(spec%normal == normal_control%force .and. spec%variation == variation%none, "named choices")
      associate (pair => spec%wheel_rail)
         call suite%check(.not. pair%left .and. .not. pair%roller, "right wheel on the track")
         call suite%check(pair%search%location == contact_location%locus, "contact locus")
         call suite%close_to([pair%search%dx, pair%search%ds, pair%search%dqrel, pair%search%a_sep, pair%search%d_sep, &
            & pair%search%d_comb, pair%search%d_turn, pair%search%g_miss], [0.2_wp, 0.3_wp, 1.0_wp, 0.5_wp*pi, 8.0_wp, &
            & 4.0_wp, 12.0_wp, -1.0_wp], closed, "search and discretisation, with their defaults")
         call suite%close_to([pair%track%gaught, pair%track%gaugwd, pair%track%cant], [14.0_wp, 1435.0_wp, 0.025_wp], closed, &
            & "track dimensions")
         call suite%close_to([pair%rail%dy, pair%rail%dz, pair%rail%roll, pair%rail%vy, pair%rail%vz, pair%rail%vroll], &
            & [1.0_wp, 2.0_wp, 0.003_wp, 4.0_wp, 5.0_wp, 0.006_wp], closed, "deviations of the rail")
         call suite%check(pair%rail_profile%name == "rail.prr" .and. pair%wheel_profile%name == "wheel.prw", "profile names")
         call suite%check(pair%rail_profile%smoothing_method == 0 .and. pair%rail_profile%mirror_z == 0, &
            & "the text after four profile items is a comment")
         call suite%check(pair%wheel_profile%mirror_y == 1 .and. pair%wheel_profile%mirror_z == -1 .and. &
            & pair%wheel_profile%smoothing_method == 1, "options of the wheel profile")
         call suite%close_to([pair%wheel_profile%smoothing, pair%wheel_profile%zigzag, pair%wheel_profile%kink_high, &
            & pair%wheel_profile%kink_low, pair%wheel_profile%kink_width], [2.5_wp, pi/1.8_wp, pi/9.0_wp, pi/45.0_wp, 1.5_wp], &
            & closed, "smoothing and kinks of the wheel profile")
         associate (w => pair%wheelset)
            call suite%close_to([w%fbdist, w%fbpos, w%nomradw, w%s, w%y, w%fz, w%roll, w%yaw, w%pitch], [1360.0_wp, -70.0_wp, &
               & 460.0_wp, 0.0_wp, 0.5_wp, 1.0e4_wp, pi/180.0_wp, 0.002_wp, 0.1_wp], closed, "dimensions and position")
            call suite%close_to([w%vs, w%vy, w%vz, w%vroll, w%vyaw, w%vpitch], [2000.0_wp, 1.0_wp, 2.0_wp, pi/60.0_wp, &
               & 0.004_wp, -4.3_wp], closed, "velocity")
         end associate
      end associate
   end subroutine full_case

   subroutine kept_values(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: first, spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_text(new_case(), first, problems, error)
      call read_text("1203000" // nl // "0111001" // nl // "0100321" // nl // "3. 4. -0.2 0. 0. 0." // nl, spec, problems, error, &
         & first)
      call suite%check(.not. allocated(error), "a later case with a position only")
      if (allocated(error)) return
      call suite%check(problems%number_of(severity%error) == 0, "has no errors")
      associate (w => spec%wheel_rail%wheelset)
         call suite%close_to([w%s, w%y, w%z, w%vs, w%nomradw], [3.0_wp, 4.0_wp, -0.2_wp, 2000.0_wp, 460.0_wp], closed, &
            & "the position is new, everything else is kept")
      end associate
      call suite%check(.not. spec%wheel_rail%new_rail_profile .and. spec%wheel_rail%rail_profile%name == "rail.prr", &
         & "the profile is kept")

      call read_text("1003100" // nl // "0121000" // nl // "0100321" // nl // "0.4 0.3 1. 90d 8. 4." // nl, spec, problems, error, &
         & first)
      call suite%check(problems%number_of(severity%error) == 0, "new elements in a steady sequence")
      call read_text("1001100" // nl // "0121000" // nl // "0100321" // nl // "0.4 0.3 1. 90d 8. 4." // nl, spec, problems, error, &
         & first)
      call has_problem(suite, problems, "DX or DS differ", "new elements in a transient sequence")
   end subroutine kept_values

   !> A later case whose choices need numbers of a group that it keeps: given by an earlier case, or refused
   subroutine kept_numbers(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: first, spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error
      character(len=*), parameter :: here = "0. 0.5 10000. 0. 0. 0."

      call read_text(new_case(), first, problems, error)
      call read_next("1203110", "0111000", "", first, spec, problems, error)
      call has_problem(suite, problems, "the velocities are kept, but no case has given FX_WS, which F = 1 needs", &
         & "a longitudinal force that was never given")
      call read_next("1203110", "0111001", here, first, spec, problems, error)
      call has_problem(suite, problems, "no case has given FX_WS", "also with a new position")
      call read_next("1203110", "0111002", here // nl // "2000. 0. 0. 0. 0. 500.", first, spec, problems, error)
      call is_good(suite, problems, error, "a longitudinal force of this case")
      first = spec
      call read_next("1203100", "0111000", "", first, spec, problems, error)
      call is_good(suite, problems, error, "the pitch rate of the first case")
      call read_next("1203110", "0111000", "", first, spec, problems, error)
      call is_good(suite, problems, error, "the longitudinal force of the case before")
      call suite%close_to([spec%wheel_rail%wheelset%fx], [500.0_wp], closed, "its value")

      call read_next("1203130", "0111000", "", first, spec, problems, error)
      call has_problem(suite, problems, "no case has given KYRAIL, FYRAIL, KZRAIL and FZRAIL, which F = 3 needs", &
         & "springs that were never given")
      call read_next("1203130", "0111020", "0. 0. 0. 0. 0. 0." // nl // "1e4 0. 1e4 0.", first, spec, problems, error)
      call is_good(suite, problems, error, "springs of this case")
      call read_next("1201100", "0111001", here, first, spec, problems, error)
      call has_problem(suite, problems, "the velocities are kept, but in shifts", "velocities as shifts")
      call read_next("1202100", "0111001", here, first, spec, problems, error)
      call is_good(suite, problems, error, "velocities of steady rolling in transient rolling")
      call read_next("1201100", "0111022", "0. 0. 0. 0. 0. 0." // nl // here // nl // "0.01 0. 0. 0. 0. -1e-5", first, spec, &
         & problems, error)
      call is_good(suite, problems, error, "shifts of this case")
      first = spec
      call read_next("1203100", "0111001", here, first, spec, problems, error)
      call has_problem(suite, problems, "the velocities are kept, but in shifts", "shifts as velocities")
      call read_next("1200100", "0111001", here, first, spec, problems, error)
      call is_good(suite, problems, error, "shifts are not used without friction")
      call kept_rates(suite)

      call read_text(new_case(), first, problems, error)
      call read_next("5203100", "0111000", "", first, spec, problems, error)
      call has_problem(suite, problems, "no case has given NOMRADR, which a roller needs", "the radius of a roller")
      call has_problem(suite, problems, "no case has given RPITCH, which a roller needs", "the pitch rate of a roller")
      call read_next("0203100", "0111000", "", first, spec, problems, error)
      call is_good(suite, problems, error, "the other side of the track")
      call read_next("1213100", "0111000", "", first, spec, problems, error)
      call has_problem(suite, problems, "the materials are kept, but no case has given FLXZ, which B = 1 needs", "a thin sheet")
      call read_next("1203100", "0111100", "", first, spec, problems, error)
      call has_problem(suite, problems, "no case has given FG and TC, which M = 1 needs", "viscoelastic bodies")
      call read_next("1203100", "0111500", "", first, spec, problems, error)
      call has_problem(suite, problems, "no case has given K0_MF, ALFAMF and BETAMF, which M = 5 needs", "slope reduction")
      call read_next("1203100", "0111600", "", first, spec, problems, error)
      call is_good(suite, problems, error, "FaStrip without slope reduction")
      call read_next("1203100", "0111005", "1360. -70. 460." // nl // "'wheel.prw' 0 1. 0." // nl // here // nl // &
         & "2000. 0. 0. 0. 0. -4." // nl // "0. 1. 0. 0. 0. 0." // nl // "0. 0. 0. 0. 0. 0.", first, spec, problems, error)
      first = spec
      call read_next("1203100", "0111003", "1360. -70. 460." // nl // "'wheel.prw' 0 1. 0." // nl // here // nl // &
         & "2000. 0. 0. 0. 0. -4.", first, spec, problems, error)
      call has_problem(suite, problems, "the flexible deviations of the wheelset are kept", "a new wheelset, bent as before", &
         & severity%warning)
   end subroutine kept_numbers

   !> Rates of the rail and of the flexible wheelset that are kept after a change between rolling and shift
   subroutine kept_rates(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: first, spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error
      character(len=*), parameter :: here = "0. 0.5 10000. 0. 0. 0.", shift = here // nl // "0.01 0. 0. 0. 0. -1e-5"
      character(len=*), parameter :: deviations = "0. 0. 0. 0. 0. 0.", rates = "1. 0. 0. 0. 0. 0."

      call read_text(new_case(), first, problems, error)
      call read_next("1203100", "0111020", rates, first, spec, problems, error)
      call is_good(suite, problems, error, "deviations of the rail")
      first = spec
      call read_next("1201100", "0111002", shift, first, spec, problems, error)
      call is_good(suite, problems, error, "deviations of the rail without velocities in a shift")
      call read_next("1203100", "0111020", "0. 0. 0. 1. 0. 0.", first, spec, problems, error)
      call is_good(suite, problems, error, "a velocity of the rail")
      first = spec
      call read_next("1201100", "0111002", shift, first, spec, problems, error)
      call has_problem(suite, problems, "the velocities of the rail are kept, but in shifts", "as a shift of the rail")
      call read_next("1201100", "0111022", "0. 0. 0. 1. 0. 0." // nl // shift, first, spec, problems, error)
      call is_good(suite, problems, error, "a shift of the rail")

      call read_text(new_case(), first, problems, error)
      call read_next("1203100", "0111004", here // nl // "2000. 0. 0. 0. 0. -4." // nl // deviations // nl // rates, first, spec, &
         & problems, error)
      call is_good(suite, problems, error, "a velocity of the flexible wheelset")
      first = spec
      call read_next("1202100", "0111002", here // nl // "2000. 0. 0. 0. 0. -4.", first, spec, problems, error)
      call is_good(suite, problems, error, "kept in transient rolling")
      call read_next("1201100", "0111002", shift, first, spec, problems, error)
      call has_problem(suite, problems, "the velocities of the flexible deviations are kept, but in shifts", "as a shift")
      call read_next("1200100", "0111001", here, first, spec, problems, error)
      call is_good(suite, problems, error, "and not used without friction")
   end subroutine kept_rates

   !> A case after `previous` with its control words and groups
   subroutine read_next(word1, word2, groups, previous, spec, problems, error)
      character(len=*), intent(in) :: word1, word2, groups
      type(case_spec), intent(in) :: previous
      type(case_spec), intent(out) :: spec
      type(problem_list), intent(out) :: problems
      type(error_type), allocatable, intent(out) :: error

      call read_text(word1 // nl // word2 // nl // "0100321" // nl // groups // nl, spec, problems, error, previous)
   end subroutine read_next

   !> A case without errors
   subroutine is_good(suite, problems, error, what)
      type(test_suite), intent(inout) :: suite
      type(problem_list), intent(in) :: problems
      type(error_type), allocatable, intent(in) :: error
      character(len=*), intent(in) :: what

      call suite%check(.not. allocated(error) .and. problems%number_of(severity%error) == 0, what)
   end subroutine is_good

   subroutine roller(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_text(new_case(word1="4203100", rail="0. 750. 1. 500.;'rail.prr' 0 1. 0.;0. 0. 0. 0. 0. 0.", &
         & wheelset="1360. -70. 460. -5.;'wheel.whl' 0 1. 0.;7. 0.5 10000. 0. 0. 0.;1d 0. 0. 0. 0. -4.3"), spec, problems, error)
      call suite%check(.not. allocated(error), "a wheel on a roller")
      if (allocated(error)) return
      associate (pair => spec%wheel_rail)
         call suite%check(pair%left .and. pair%roller, "left side of a roller rig")
         call suite%close_to([pair%track%nomradr, pair%track%raily0, pair%track%railz0, pair%wheelset%x, &
            & pair%wheelset%rpitch, pair%wheelset%ytape], [500.0_wp, 750.0_wp, 1.0_wp, 7.0_wp, pi/180.0_wp, -5.0_wp], closed, &
            & "absolute placement, roller radius and pitch rate, tape line")
      end associate
   end subroutine roller

   subroutine friction_points(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec, next
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_text(new_case(word2="1022033", friction="2; -20d 0.2 0.2; -10d 0.3 0.3"), spec, problems, error)
      call suite%check(.not. allocated(error), "friction by angle")
      if (allocated(error)) return
      call suite%check(size(spec%friction%sets) == 2, "two control points")
      call suite%close_to([spec%friction%sets%position], [-pi/9.0_wp, -pi/18.0_wp], closed, "their angles")
      call suite%close_to([spec%friction%sets%fstat], [0.2_wp, 0.3_wp], closed, "their coefficients")
      call read_text(new_case(), next, problems, error, previous=spec)
      call suite%check(.not. allocated(error), "one set after several")
      if (allocated(error)) return
      call suite%check(size(next%friction%sets) == 1, "the control points of the case before are gone")

      call read_text(new_case(word2="2422033", friction="1; 5. 0.2 0.1 20. 0. 0.; 0.01 1."), spec, problems, error)
      call suite%check(.not. allocated(error), "a falling law at one position")
      if (allocated(error)) return
      call suite%check(spec%friction_law == friction_model%exponential, "exponential law")
      call suite%close_to([spec%friction%sets(1)%position, spec%friction%sets(1)%fstat, spec%friction%memdst], &
         & [5.0_wp, 0.3_wp, 0.01_wp], closed, "position, coefficient, memory")

      call read_text(new_case(word2="1022033", friction="2; -10d 0.2 0.2; -20d 0.3 0.3"), spec, problems, error)
      call has_problem(suite, problems, "ALPHA = -20d does not lie above the one before it, ALPHA = -10d", "angles that decrease")
   end subroutine friction_points

   subroutine faulty_cases(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_text(new_case(word1="2203100"), spec, problems, error)
      call has_problem(suite, problems, "C1 = 2 is not a known digit of module 1; allowed are 0, 1, 4, 5", "unknown configuration")
      call read_text(new_case(word1="1203120"), spec, problems, error)
      call has_problem(suite, problems, "F = 2 is not a known digit", "a force digit of module 3")
      call read_text(new_case(word2="0025033"), spec, problems, error)
      call has_problem(suite, problems, "C = 5 is not a known digit", "coefficients of no kind")
      call read_text(new_case(word1="1200010"), spec, problems, error)
      call has_problem(suite, problems, "F = 1, a prescribed longitudinal force, needs a tangential problem, T = 1, 2 or 3", &
         & "a longitudinal force without friction")
      call read_text(new_case(search="0.2 0.3 1. 90d 3. 4."), spec, problems, error)
      call has_problem(suite, problems, "D_SEP = 3. is smaller than D_COMB = 4.", "separation before combination")
      call read_text(new_case(search="0. 0.3 1. 90d 8. 4."), spec, problems, error)
      call has_problem(suite, problems, "DX = 0.", "element without length")
      call read_text(new_case(rail="14. 0 1435. 0.;'nose.slcs' 0 1. 0.;0. 0. 0. 0. 0. 0."), spec, problems, error)
      call has_problem(suite, problems, "a slices file needs absolute placement", "variable rail placed by its gauge")
      call read_text(new_case(rail="14. 0 1435. 0.;'' 0 1. 0.;0. 0. 0. 0. 0. 0."), spec, problems, error)
      call has_problem(suite, problems, "RFNAME is empty", "no name of a profile")
      call read_text(new_case(word2="0022011", rail="", wheelset="0. 0. 1. 0. 0. 0."), spec, problems, error)
      call has_problem(suite, problems, "no rail profile has been given", "first case without profiles")
      call read_text(new_case(wheelset="1360. -70. 460.;wheel.prw 0 1. 0."), spec, problems, error)
      call suite%check(allocated(error), "a name without quotes ends the reading")
      if (allocated(error)) call suite%check(index(full_text(error), "test:12:1") > 0, "with its position")
   end subroutine faulty_cases

   !> Choices of the format that are not implemented are refused at their digit, also when they are kept
   subroutine unbuilt_cases(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec, later
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_text(new_case(), spec, problems, error)
      call suite%equal(problems%number_of(severity%unsupported), 0, "a plain case requests nothing that is not implemented")
      call read_text(new_case(word2="0082033"), spec, problems, error)
      call suite%equal(problems%number_of(severity%unsupported), 1, "an oblique view is refused")
      call has_problem(suite, problems, "test:2:1: D = 8, contact locus in an oblique view that fits few profiles, " // &
         & "is not implemented", &
         & "by its name, with its position", severity%unsupported)
      call read_text(new_case(word2="0024033", friction="0.3 0.3;0 4"), spec, problems, error)
      call has_problem(suite, problems, "C = 4, the angle correction for conformal contact, has no effect with D = 2", &
         & "flat patches have no inclination", severity%warning)
      call read_text(new_case(word2="0082033"), spec, problems, error)
      call read_text(new_case(word2="0011002", friction="", search="", rail="", &
         & wheelset="0. 0. 1. 0. 0. 0.;2000. 0. 0. 0. 0. -4."), later, problems, error, spec)
      call has_problem(suite, problems, "D = 8,", "a search that is kept counts, too", severity%unsupported)
   end subroutine unbuilt_cases

   !> Is there an error, or a problem of another severity, with these words?
   subroutine has_problem(suite, problems, words, what, kind)
      type(test_suite), intent(inout) :: suite
      type(problem_list), intent(in) :: problems
      character(len=*), intent(in) :: words, what
      !> Member of severity, default error
      integer, intent(in), optional :: kind
      logical :: found
      integer :: k, expected

      found = .false.
      expected = severity%error
      if (present(kind)) expected = kind
      do k = 1, problems%count
         if (problems%items(k)%severity /= expected) cycle
         if (index(problem_text(problems%items(k)), words) > 0) found = .true.
      end do
      call suite%check(found, what)
   end subroutine has_problem
end program test_reader1
