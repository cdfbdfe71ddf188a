!> Reading of cases of module 3: stored and kept values, and one faulty input per check
program test_reader3
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec, part_source
   use contact_input_experiment_file, only : experiment_reader, input_case
   use contact_input_problems, only : problem_list, problem_text, severity
   use contact_input_reader, only : read_case
   use contact_test_harness, only : environment, test_suite
   use contact_text_lexer, only : input_lexer
   implicit none (type, external)
   character, parameter :: nl = achar(10)

   !> A line of a case, or several with semicolons between
   type :: text_line
      character(len=:), allocatable :: text
   end type text_line

   type(test_suite) :: suite

   call suite%start("reader of module 3")
   call plain_case(suite)
   call all_groups(suite)
   call kept_values(suite)
   call subsurface_blocks(suite)
   call digits_of_one_case(suite)
   call digits_of_two_cases(suite)
   call numbers(suite)
   call friction(suite)
   call materials(suite)
   call grids(suite)
   call geometries(suite)
   call combinations(suite)
   call grids_of_two_cases(suite)
   call outer_iteration(suite)
   call unreadable(suite)
   call rare_choices(suite)
   call collected(suite)
   call experiments(suite)
   call manual_example(suite)
   call suite%finish()

contains

   !> INISLP as the solvers see it
   subroutine inislp_becomes(suite, text, expected)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: text
      integer, intent(in) :: expected
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_one("3=0400001|4=100 100 30 1 1e-5;" // text // " 0.4", spec, problems, error)
      call suite%check(.not. allocated(error) .and. spec%iteration%inislp == expected, "INISLP = " // text)
   end subroutine inislp_becomes

   !> A rolling case on a given grid, with changes
   !>
   !> Changes are "number=text" with bars between: line numbers 1...12 as below; semicolons begin new
   !> lines, and an empty text removes the line.
   function new_case(changes) result(text)
      character(len=*), intent(in) :: changes
      character(len=:), allocatable :: text
      type(text_line) :: lines(12)
      integer :: first, last, k, place

      lines(1)%text = "203100"
      lines(2)%text = "0022020"
      lines(3)%text = "0000001"
      lines(4)%text = "100 100 30 1 1e-5"
      lines(5)%text = "1000.0 0.001 0.0 0.0"
      lines(6)%text = "0.3 0.3"
      lines(7)%text = "0d 0.1 1000."
      lines(8)%text = "0.28 0.28 82000. 82000."
      lines(9)%text = "1"
      lines(10)%text = "10 8 -0.5 -0.4 0.1 0.1"
      lines(11)%text = "1 1"
      lines(12)%text = "0.01 0 0.01 0 0 0"
      first = 1
      do while (first <= len(changes))
         last = index(changes(first:) // "|", "|") + first - 2
         place = index(changes(first:last), "=") + first - 1
         read(changes(first:place - 1), *) k
         lines(k)%text = changes(place + 1:last)
         first = last + 2
      end do
      text = ""
      do k = 1, size(lines)
         if (len(lines(k)%text) > 0) text = text // lines(k)%text // nl
      end do
      do k = 1, len(text)
         if (text(k:k) == ";") text(k:k) = nl
      end do
   end function new_case

   !> Read one case
   subroutine read_one(changes, spec, problems, error)
      character(len=*), intent(in) :: changes
      type(case_spec), intent(out) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_lexer) :: lexer
      type(case_spec) :: nothing

      call lexer%open_text(new_case(changes), "test")
      call read_case(lexer, 3, nothing, .false., 1, spec, problems, error)
   end subroutine read_one

   !> Read two cases, the problems are those of the second
   subroutine read_two(first, second, spec, problems, error)
      character(len=*), intent(in) :: first, second
      type(case_spec), intent(out) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_lexer) :: lexer
      type(case_spec) :: previous

      call read_one(first, previous, problems, error)
      if (allocated(error)) return
      call lexer%open_text(new_case(second), "test")
      call read_case(lexer, 3, previous, .true., 2, spec, problems, error)
   end subroutine read_two

   !> Exactly one error, or warning, with a phrase; choices that are not implemented are not counted
   subroutine one_problem(suite, kind, phrase, problems, error, what)
      type(test_suite), intent(inout) :: suite
      integer, intent(in) :: kind
      character(len=*), intent(in) :: phrase
      type(problem_list), intent(in) :: problems
      type(error_type), allocatable, intent(in) :: error
      character(len=*), intent(in) :: what
      integer :: k, others

      if (allocated(error)) then
         call suite%check(.false., what // ": " // full_text(error))
         return
      end if
      others = problems%number_of(severity%error) + problems%number_of(severity%warning)
      if (kind == severity%unsupported) others = others + problems%number_of(severity%unsupported)
      call suite%check(others == 1, what // ", exactly one problem")
      do k = 1, problems%count
         if (problems%items(k)%severity /= kind) cycle
         call suite%check(index(problem_text(problems%items(k)), phrase) > 0, what // ": " // &
            & problem_text(problems%items(k)))
         call suite%check(problems%items(k)%what%line > 0, what // ", has a line")
         return
      end do
      if (others > 1) then
         do k = 1, problems%count
            call suite%check(.false., what // ": " // problem_text(problems%items(k)))
         end do
      end if
      call suite%check(.false., what // ": has no problem of its kind")
   end subroutine one_problem

   !> One error in a first case
   subroutine wrong(suite, changes, phrase)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: changes, phrase
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_one(changes, spec, problems, error)
      call one_problem(suite, severity%error, phrase, problems, error, changes)
   end subroutine wrong

   !> One warning in a first case
   subroutine dubious(suite, changes, phrase)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: changes, phrase
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_one(changes, spec, problems, error)
      call one_problem(suite, severity%warning, phrase, problems, error, changes)
   end subroutine dubious

   !> Nothing wrong in a first case, except choices that are not implemented
   subroutine right(suite, changes)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: changes
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_one(changes, spec, problems, error)
      call no_problem(suite, problems, error, changes)
   end subroutine right

   !> One error in a second case
   subroutine wrong_second(suite, first, second, phrase)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: first, second, phrase
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_two(first, second, spec, problems, error)
      call one_problem(suite, severity%error, phrase, problems, error, first // " then " // second)
   end subroutine wrong_second

   !> One warning in a second case
   subroutine dubious_second(suite, first, second, phrase)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: first, second, phrase
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_two(first, second, spec, problems, error)
      call one_problem(suite, severity%warning, phrase, problems, error, first // " then " // second)
   end subroutine dubious_second

   !> Nothing wrong in a second case
   subroutine right_second(suite, first, second)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: first, second
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_two(first, second, spec, problems, error)
      call no_problem(suite, problems, error, first // " then " // second)
   end subroutine right_second

   subroutine no_problem(suite, problems, error, what)
      type(test_suite), intent(inout) :: suite
      type(problem_list), intent(in) :: problems
      type(error_type), allocatable, intent(in) :: error
      character(len=*), intent(in) :: what
      integer :: k

      if (allocated(error)) then
         call suite%check(.false., what // ": " // full_text(error))
         return
      end if
      do k = 1, problems%count
         if (problems%items(k)%severity /= severity%unsupported) &
            & call suite%check(.false., what // ": " // problem_text(problems%items(k)))
      end do
      call suite%check(.true., what)
   end subroutine no_problem

   !> Reading cannot continue
   subroutine fails(suite, changes, phrase)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: changes, phrase
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_one(changes, spec, problems, error)
      call suite%check(allocated(error), "ends the reading: " // changes)
      if (allocated(error)) call suite%check(index(full_text(error), phrase) > 0, changes // ": " // full_text(error))
   end subroutine fails

   !> What is stored for the plain case
   subroutine plain_case(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_one("", spec, problems, error)
      call no_problem(suite, problems, error, "plain case")
      call suite%check(problems%is_usable() .and. problems%count == 0, "the plain case can be computed")
      call suite%check(spec%link == 2 .and. spec%motion == 3 .and. spec%normal == 1 .and. spec%force == 0, "named choices")
      call suite%check(spec%kernel == 2 .and. spec%friction_law == 0 .and. spec%solver == 0, "effective choices")
      call suite%check(all([spec%parts%grid, spec%parts%geometry, spec%parts%material] == part_source%given) &
         & .and. spec%solve, "flags")
      call suite%check(spec%iteration%maxgs == 100 .and. spec%iteration%eps == 1.0e-5_wp, "iteration")
      call suite%check(spec%kinematics%fn == 1000.0_wp .and. spec%kinematics%cksi == 1.0e-3_wp, "kinematics")
      call suite%check(spec%friction%sets(1)%fstat == 0.3_wp, "friction")
      call suite%check(spec%rolling%dq == 0.1_wp .and. spec%rolling%veloc == 1000.0_wp, "rolling")
      call suite%close_to(spec%rolling%facphi, 1.0_wp/6.0_wp, 0.0_wp, "FACPHI")
      call suite%check(all(spec%material%gg == 82000.0_wp), "materials")
      call suite%check(spec%grid%form == 1 .and. spec%grid%mx == 10 .and. spec%grid%my == 8, "grid")
      call suite%check(spec%geometry%form == 1 .and. spec%geometry%b(3) == 0.01_wp, "geometry")
   end subroutine plain_case

   !> All optional groups, in their order
   subroutine all_groups(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call right(suite, "2=022020 = words, text|3=001341")
      call right(suite, "3=10000001;1000000 4")
      call right(suite, "1=203103|3=0000001|12=0.01 0 0.01 0 0 0;1 0;1;3 0.0 0.5;2;1 1 5;1 2 7;3 0 0.5;3;2 2;1 2;3 4;1 0 1;" // &
         & "5;2;0 1;6;1 1 2;1 1 2;1;0.5;7;1 1;2;2;1;0.1;9;1 1 1;0;0;-0.5;0")

      ! only the sign of INISLP has a meaning, and whether it is 0
      call inislp_becomes(suite, "1", 1)
      call inislp_becomes(suite, "0.3", 1)
      call inislp_becomes(suite, "-0.3", -1)
      call inislp_becomes(suite, "-1", -1)
      call inislp_becomes(suite, "0", 0)
      call inislp_becomes(suite, "0.0", 0)

      call read_one("2=0624029 2|3=3200001|4=100 100 30 1 1e-5 50;0.8 0.9 1.0 0.4|6=0.4 20. -0.1 500.;0.001 5.|" // &
         & "7=180d 0.1 1000. 0.2|8=0 2 2; 0 0d 1 90d; 0.3 0.3 1. 1.;5. 6. 7. 8.;20 450 .05 7.85-6;30 450 .05 7.85-6|" // &
         & "10=2 1 0 0 1 1|12=0.01 0 0.01 0 0 0;1 2 3 4", spec, problems, error)
      call suite%check(.not. allocated(error), "friction memory, table, damping, heat, extra slip")
      if (.not. allocated(error)) then
         call suite%check(spec%iteration%npot_max == 100, "NPOT_MAX is clipped")
         call suite%check(spec%iteration%omegah == 0.8_wp .and. spec%iteration%inislp == 1, "relaxation; INISLP as a real")
         call suite%check(spec%friction%memdst == 0.001_wp .and. spec%friction%sets(1)%dtheat == 500.0_wp, "memory")
         call suite%close_to(spec%friction%sets(1)%fkin, 0.3_wp, 1.0e-15_wp, "kinetic friction of L = 6")
         call suite%close_to(spec%rolling%chi, pi, 1.0e-15_wp, "CHI in degrees")
         call suite%check(spec%rolling%facphi == 0.2_wp, "FACPHI given")
         call suite%close_to(spec%material%table_alpha, [0.0_wp, 0.5_wp*pi], 1.0e-15_wp, "table of inclinations")
         call suite%check(spec%has_damping .and. spec%damping%dftmax == 8.0_wp, "damping")
         call suite%check(spec%heat%bktemp(2) == 30.0_wp .and. spec%heat%dens(1) == 7.85e-6_wp, "heat")
         call suite%check(all(spec%extra_slip == reshape([1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp], [2, 2])), "extra slip")
         call suite%check(spec%slip_source == 9 .and. spec%kernel == 4, "extra slip and kernel by name")
      end if

      call read_one("3=0500001|4=100 100 30 1 1e-5;0.9 0.1 1 0. 1. 2. 3. 20.", spec, problems, error)
      call no_problem(suite, problems, error, "G = 5")
      call suite%check(spec%iteration%d_ifc == 0.01_wp .and. spec%iteration%pow_s == 10.0_wp, "clipped values of G = 5")
      call dubious(suite, "3=0500001|4=100 100 30 1 1e-5;0.9 0.1 1 1. -1. 2. 3. 1.", "D_LIN")
      call right(suite, "3=0400001|4=100 100 30 1 1e-5;-1 0.5")
      call wrong(suite, "2=0021020|7=|8=", "C = 1 keeps the materials, but this is the first case")
      call wrong(suite, "2=0022010|11=|12=", "Z = 1 forms the undeformed distance from the values in store, but this is the first")
   end subroutine all_groups

   !> Values kept by digits
   subroutine kept_values(suite)
      type(test_suite), intent(inout) :: suite
      character(len=*), parameter :: kept = "1=203100|2=0100000|3=0100001|4=|6=|7=|8=|9=|10=|11=|12="
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_two("3=0200001|4=77 100 30 1 1e-6;0.8 0.9 0 0.4|6=0.25 0.25", kept // "|5=10 0 0 0", spec, problems, error)
      call no_problem(suite, problems, error, "a case that keeps everything")
      call suite%check(spec%iteration%maxgs == 77 .and. spec%solver == 2, "solver settings are kept")
      call suite%check(spec%friction%sets(1)%fstat == 0.25_wp .and. spec%friction_law == 0, "friction is kept")
      call suite%check(spec%rolling%dq == 0.1_wp .and. spec%material%gg(1) == 82000.0_wp, "materials are kept")
      call suite%check(spec%grid%mx == 10 .and. spec%geometry%b(1) == 0.01_wp, "grid and geometry are kept")
      call suite%check(spec%kinematics%fn == 10.0_wp, "kinematics are new")
      call suite%check(all([spec%parts%grid, spec%parts%geometry, spec%parts%material] /= part_source%given), "no value is new")

      call read_two("", "1=202100|5=10 0 0 0 1 2|7=0 0.3 100", spec, problems, error)
      call suite%check(spec%kinematics%spinxo == 1.0_wp .and. spec%kinematics%spinyo == 2.0_wp, "spin centre")
      call read_two("5=10 0 0 0 1 2", "", spec, problems, error)
      call suite%check(spec%kinematics%spinxo == 0.0_wp, "the spin centre is reset")
      call read_two("", "1=201100|7=", spec, problems, error)
      call suite%check(spec%rolling%dq == 1.0_wp .and. spec%rolling%veloc == 1.0_wp, "shifts have no step and velocity")

      call read_two("9=-3|10=10 8 1 2 1.1|11=|12=", kept, spec, problems, error)
      call no_problem(suite, problems, error, "a Hertzian grid that is kept")
      call suite%check(spec%grid%form == -3 .and. spec%grid%bb == 2.0_wp .and. .not. spec%has_new_geometry(), "Hertzian grid")
      call read_one("9=-1|10=10 8 .1 .2 1.1|11=|12=", spec, problems, error)
      call suite%check(spec%has_new_geometry() .and. spec%geometry%b(3) == 0.2_wp, "curvatures of a Hertzian grid")

      call read_two("2=0022029|12=0.01 0 0.01 0 0 0;" // repeat("1 2 ", 80), "2=0100001|4=100 100 30 1 1e-5|6=|7=|8=|9=|" // &
         & "10=|11=|12=", spec, problems, error)
      call no_problem(suite, problems, error, "extra slip is kept")
      call suite%check(spec%slip_source == 9 .and. size(spec%extra_slip, 2) == 80, "extra slip of the first case")
      call read_two("2=0022029|12=0.01 0 0.01 0 0 0;" // repeat("1 2 ", 80), "", spec, problems, error)
      call suite%check(spec%slip_source == 0 .and. .not. allocated(spec%extra_slip), "extra slip is removed by E = 0")
      call read_two("2=0022020 2|8=.3 .3 1 1;1 2 3 4", "", spec, problems, error)
      call suite%check(spec%has_damping .and. spec%damping%cdampn == 1.0_wp, "damping is kept without a second number")
      call read_two("2=0022020 2|8=.3 .3 1 1;1 2 3 4", "2=0022020 0", spec, problems, error)
      call suite%check(.not. spec%has_damping .and. spec%damping%cdampn == 0.0_wp, "damping is switched off by M2 = 0")
   end subroutine kept_values

   !> Subsurface blocks as they are stored
   subroutine subsurface_blocks(suite)
      type(test_suite), intent(inout) :: suite
      character(len=*), parameter :: start = "1=203103|12=0.01 0 0.01 0 0 0;"
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call read_one(start // "2 0;1;3 0.25 0.5;9;2 1 2;3 1;0;-1 -2;2;2 0 9;1 2 7;1 0 1;0", spec, problems, error)
      call no_problem(suite, problems, error, "three blocks")
      call suite%check(spec%subsurface%matfil == 2 .and. spec%subsurface%output == 0, "output digits")
      call suite%check(size(spec%subsurface%blocks) == 3, "number of blocks")
      if (size(spec%subsurface%blocks) /= 3) return
      call suite%close_to(spec%subsurface%blocks(1)%z, [0.25_wp, 0.75_wp, 1.25_wp], 1.0e-15_wp, "depths from a step")
      call suite%close_to(spec%subsurface%blocks(2)%x, [1.0_wp, 3.0_wp], 0.0_wp, "coordinates are sorted")
      call suite%close_to(spec%subsurface%blocks(2)%z, [-2.0_wp, -1.0_wp], 0.0_wp, "depths are sorted")
      call suite%check(spec%subsurface%blocks(3)%ixinc == 1 .and. spec%subsurface%blocks(3)%iyh == 7, "column and row ranges")
      call read_one(start // "0 0;1;1 0 1;" // repeat("5;1;0.5;", 30) // "0", spec, problems, error)
      call suite%check(size(spec%subsurface%blocks) == 31, "many blocks")
      call dubious(suite, start // "0 0;3;4 1;5 5 -2 3.2;1;1 0 1;0", "2 of the 4 numbers of IX are dropped")
      call fails(suite, start // "0 0;4;0", "ISUBS = 4 is not a known option")
      call wrong(suite, start // "3 0;0", "MATFIL_S = 3 is outside its range 0 to 2")
      call wrong(suite, start // "0 5;0", "OUTPUT_S = 5 is outside its range 0 to 4")
      call wrong(suite, start // "3 0;0", "MATFIL_S = 3 is outside its range 0 to 2")
      call wrong(suite, start // "0 5;0", "OUTPUT_S = 5 is outside its range 0 to 4")
      call fails(suite, start // "0 0;1;0 0 1;0", "NZ = 0 is outside its range 1 to 9999 (subsurface block 1, case 1)")
      call fails(suite, start // "0 0;9;1 10000 1;0", "NY = 10000 is outside its range")
      call fails(suite, start // "0 0;3;0 1", "NX = 0 is outside its range")
      call fails(suite, start // "0 0;3;1 0", "NY = 0 is outside its range")
      call fails(suite, start // "0 0;9;0 1 1;0", "NX = 0 is outside its range")
      call fails(suite, start // "0 0;9;1 0 1;0", "NY = 0 is outside its range")
      call fails(suite, start // "0 0;9;1 1 0;0", "NZ = 0 is outside its range")
      call fails(suite, start // "0 0;5;0;0.5;0", "NZ = 0 is outside its range")
      call wrong(suite, start // "0 0;2;0 1 5;1 1 5;1 0 1;0", "IXL = 0 is outside its range")
      call wrong(suite, start // "0 0;2;4 1 3;1 1 5;1 0 1;0", "IXH = 3 is outside its range 4 to 999999")
      call wrong(suite, start // "0 0;2;1 1 3;0 1 5;1 0 1;0", "IYL = 0")
      call wrong(suite, start // "0 0;2;1 1 3;6 1 5;1 0 1;0", "IYH = 5")
      call wrong(suite, start // "0 0;1;1 0 0;0", "DZ = 0 is below its lower bound")
   end subroutine subsurface_blocks

   !> Ranges of digits, and requirements of digits of a first case
   subroutine digits_of_one_case(suite)
      type(test_suite), intent(inout) :: suite
      character(len=*), parameter :: blocks = "12=0.01 0 0.01 0 0 0;0 0"

      call wrong(suite, "1=273100", "B = 7 is not a known digit of module 3; allowed are 0, 1, 2, 3, 4, 5, 6")
      call wrong(suite, "1=204100|7=", "T = 4 is not")
      call wrong(suite, "1=203200", "N = 2 is not")
      call wrong(suite, "1=203130|5=1000 0.1 0.1 0", "F = 3 is not")
      call wrong(suite, "1=203104|" // blocks, "S = 4 is not")
      call wrong(suite, "2=1022020", "V = 1 is not")
      call wrong(suite, "2=12022020", "V = 12 is not")
      call wrong(suite, "2=0522020|6=", "L = 5 is not")
      call wrong(suite, "2=0032020|9=|10=|11=|12=", "D = 3 is not")
      call wrong(suite, "2=0025020", "C = 5 is not")
      call wrong(suite, "2=0022820", "M = 8 is not")
      call wrong(suite, "2=0022030|11=|12=", "Z = 3 is not")
      call wrong(suite, "2=0022024", "E = 4 is not")
      call wrong(suite, "3=20000001;0", "X = 2 is not")
      call wrong(suite, "3=2000001", "H = 2 is not")
      call wrong(suite, "3=0600001", "G = 6 is not")
      call wrong(suite, "3=0003001", "A = 3 is not")
      call wrong(suite, "3=0000701", "O = 7 is not")
      call wrong(suite, "3=0000004", "R = 4 is not")
      call wrong(suite, "2=0022020 31", "GAPWGT = 3 is outside")
      call wrong(suite, "2=-0022020", "is negative")
      call dubious(suite, "1=5203100", "the first digit of 5203100 is not used")
      call wrong(suite, "1=12203100", "PBTNFS = 12203100 has more than six digits")
      call wrong(suite, "2=0022020 3|8=.3 .3 1 1;0 0 0 0", "M2 = 3 is not a known digit of module 3; allowed are 0, 1, 2")
      call wrong(suite, "2=0022020 -2", "the second number of the control word, -2, is negative")
      call wrong_second(suite, "", "1=403100", "P = 4 is not")
      call wrong_second(suite, "", "3=0040001", "I = 4 is not")
      call dubious(suite, "1=003100", "P = 0 is replaced by 2")
      call dubious(suite, "3=0010001", "I = 1 is replaced by 0")
      call wrong(suite, "2=0122020|6=", "L = 1 keeps")
      call wrong(suite, "2=0002000|9=|10=|11=|12=", "D = 0 keeps")
      call wrong(suite, "2=0012010|9=|10=|11=|12=", "D = 1 forms the potential contact area from the values in store, but")
      call wrong(suite, "1=203101", "S = 1 keeps")
      call wrong(suite, "1=203102|" // blocks, "S = 2 keeps")
      call wrong(suite, "2=0022000|11=|12=", "Z = 0 keeps")
      call wrong(suite, "1=201100|2=0020020|7=|8=", "C = 0 keeps")
      call wrong(suite, "1=201100|2=0022120|7=|8=.3 .3 1 1;0 0 0 0", "M = 1, viscoelastic")
      call wrong(suite, "1=201100|3=3000001|7=|8=.3 .3 1 1;0 450 .05 1;0 450 .05 1", "H = 3, surface temperatures, need steady")
      call wrong(suite, "1=201100|3=3000001|7=|8=.3 .3 1 1;0 1 1 1;0 1 1 1", "H = 3, surface temperatures, need steady")
      call wrong(suite, "2=0622020|6=.3 0 -.1 100;0 0", "L = 6, friction that changes with temperature, needs")
      call wrong(suite, "2=0622320|3=3000001|6=.3 0 -.1 100;0 0|8=.3 .3 1 1;1 1 1;0 1 1 1;0 1 1 1", &
         & "cannot be used with simplified theory, M = 3")
   end subroutine digits_of_one_case

   !> What digits of a later case demand of the one before
   subroutine digits_of_two_cases(suite)
      type(test_suite), intent(inout) :: suite
      character(len=*), parameter :: kept = "2=0100000|6=|7=|8=|9=|10=|11=|12=", extra = &
         & "2=0022029|10=1 1 0 0 1 1|12=0.01 0 0.01 0 0 0;", extra_kept = "2=0102001|6=|9=|10=|11=|12="

      call wrong_second(suite, "", kept // "|1=203101", "no case has given any")
      call wrong_second(suite, "", kept // "|1=203102|12=0 0", "no case has given any")
      call right_second(suite, "1=203103|12=0.01 0 0.01 0 0 0;0 0;1;1 0 1;0", kept // "|1=203102|12=0 0")
      call right_second(suite, "3=3000001|8=.3 .3 1 1;0 450 .05 1;0 450 .05 1", kept // "|3=1000001")
      call wrong_second(suite, "", kept // "|3=1000001", "H = 1 keeps the thermal constants, but no case has given any")
      call wrong_second(suite, "", kept // "|2=3100000", "V changes from 0 to 3")
      call wrong_second(suite, "", kept // "|1=201100", "T changes from 3 to 1")
      call wrong_second(suite, "1=200100|7=", kept // "|1=202100", "T changes from 0 to 2")
      call right_second(suite, "", kept // "|1=202100")
      call right_second(suite, "1=200100|7=", kept // "|1=201100")
      ! numbers of groups that are kept
      call wrong_second(suite, "", kept // "|1=213100", "the materials are kept, but no case has given FLXZ, which B = 1 needs")
      call right_second(suite, "1=213100|8=.3 .3 1 1;1e-6", kept // "|1=213100")
      call wrong_second(suite, "", kept // "|2=0100100", "no case has given FG and TC, which M = 1 needs")
      call wrong_second(suite, "", kept // "|2=0101200", "no case has given FLX, which M = 2 needs")
      call wrong_second(suite, "2=0022320|8=.3 .3 1 1;1 1 1", kept // "|2=0101200", "no case has given FLX, which M = 2 needs")
      call wrong_second(suite, "", kept // "|2=0101300", "no case has given K0_MF, ALFAMF and BETAMF, which M = 3 needs")
      call wrong_second(suite, "", kept // "|2=0101400", "no case has given GG3, LAYTHK, TAU_C0 and K_TAU, which M = 4 needs")
      call right_second(suite, "2=0022520|8=.3 .3 1 1;1 1 1", kept // "|2=0101300")
      call right_second(suite, "", kept // "|2=0101700")
      call dubious_second(suite, "1=201100|7=", kept // "|2=0101000", "CHI, DQ and VELOC are kept")
      ! an extra rigid slip of rolling is not one of a shift
      call right_second(suite, extra // "0.001 0.002", "1=202100|" // extra_kept)
      call wrong_second(suite, extra // "0.001 0.002", "1=201100|7=|" // extra_kept, "the extra rigid slip are kept, but in shifts")
      call wrong_second(suite, "1=201100|7=|" // extra // "0.001 0.002", extra_kept, "the extra rigid slip are kept, but in shifts")
      call right_second(suite, extra // "0 0", "1=201100|7=|" // extra_kept)
      call right_second(suite, extra // "0.001 0.002", "1=200100|7=|" // extra_kept)
      call right_second(suite, extra // "0.001 0.002", "1=201100|7=|" // extra // "0.001 0.002")
   end subroutine digits_of_two_cases

   !> Values of the iteration, kinematics and rolling groups
   subroutine numbers(suite)
      type(test_suite), intent(inout) :: suite

      call wrong(suite, "4=0 100 30 1 1e-5", "test:4:1: MAXGS = 0 is outside its range 1 to 999999: ")
      call wrong(suite, "4=1000000 100 30 1 1e-5", "MAXGS = 1000000")
      call wrong(suite, "4=100 1000000 30 1 1e-5", "MAXIN = 1000000 is outside its range 1 to 999999")
      call right(suite, "4=9999 999999 9999 1 1e-5")
      call wrong(suite, "4=100 100 0 1 1e-5", "MAXNR = 0")
      call wrong(suite, "4=100 100 30 0 1e-5", "MAXOUT = 0")
      call wrong(suite, "4=100 100 30 1 0.", "EPS = 0. is below its lower bound 1.00000E-20")
      call wrong(suite, "5=-1. 0 0 0", "Input: ERROR. test:5:1: FN = -1. is below its lower bound 0")
      call right(suite, "5=0. 0 0 0")
      call right(suite, "1=203000|5=-0.01 0 0 0")
      call wrong(suite, "1=203110|5=10 -1.5 0 0", "FX = -1.5 is below its lower bound -1")
      call wrong(suite, "1=203120|5=10 0.8 0.8 0", "FX**2 + FY**2 = 1.28 is above")
      call right(suite, "1=203120|5=10 0.6 -0.6 0")
      call dubious(suite, "5=10 0 0 0 1.5", "SPINXO = 1.5 is given without SPINYO")
      call dubious(suite, "5=1000,0 0,0 0,0 0,0", "the decimal separator is a point")
      call right(suite, "7=0,1,1000 CHI, DQ, VELOC")
      call right(suite, "7=0.,0.1,1000. 7")
      call wrong(suite, "7=0 0 1000", "DQ = 0 is below its lower bound 1.00000E-08 mm")
      call wrong(suite, "7=0 0.1 -1000", "VELOC = -1000 is below")
      call right(suite, "4=100 100 30 1 0.5")
      call wrong(suite, "2=0022120|7=1d 0.1 1000|8=.3 .3 1 1;0 0 0 0", "CHI = 1d is not along x")
   end subroutine numbers

   !> Friction laws
   subroutine friction(suite)
      type(test_suite), intent(inout) :: suite

      call wrong(suite, "6=0 0", "FSTAT = 0 is below its lower bound 1.00000E-06")
      call dubious(suite, "6=0.3 0.2", "FKIN = 0.2 differs from FSTAT")
      call dubious(suite, "6=0.3 0.2", "in an input file FSTAT = 0.3, by cntc_setFrictionMethod the smaller one")
      call right(suite, "2=0222020|6=0.1 0.2 1.0 0.0 0.0;0.001 10")
      call wrong(suite, "2=0222020|6=-0.1 0.2 1.0 0.1 1.0;0.001 10", "FKIN = -0.1 is below")
      call wrong(suite, "2=0222020|6=0.1 -0.2 1.0 0.1 1.0;0.001 10", "FLIN1 = -0.2 is below")
      call wrong(suite, "2=0322020|6=0.1 0.2 1.0 -0.1 1.0;0.001 10", "FRAT2 = -0.1 is below")
      call wrong(suite, "2=0422020|6=0.1 -0.2 1.0 0.1 1.0;0.001 10", "FEXP1 = -0.2 is below")
      call wrong(suite, "2=0422020|6=0.1 0.2 0.0 0.1 1.0;0.001 10", "SABSH1 = 0.0 is below")
      call wrong(suite, "2=0422020|6=0.1 0.2 1.0 0.1 0.0;0.001 10", "SABSH2 = 0.0 is below")
      call wrong(suite, "2=0422020|6=0.1 0.2 1.0 0.1 1.0;-0.001 10", "MEMDST = -0.001 is below")
      call wrong(suite, "2=0422020|6=0.1 0.2 1.0 0.1 1.0;0.001 -10", "MEM_S0 = -10 is below")
      call wrong(suite, "2=0622020|3=3000001|6=-.3 0 .5 100;0 0|8=.3 .3 1 1;0 1 1 1;0 1 1 1", "FREF = -.3 is below")
      call wrong(suite, "2=0622020|3=3000001|6=.3 0 -.4 100;0 0|8=.3 .3 1 1;0 1 1 1;0 1 1 1", "FREF + DFHEAT = -0.1 is below")
      call wrong(suite, "2=0622020|3=3000001|6=.3 0 -.1 0;0 0|8=.3 .3 1 1;0 1 1 1;0 1 1 1", "DTHEAT = 0 must be larger than 0")
      call right(suite, "2=3022020|6=|10=10 2 -0.5 -0.4 0.1 0.1|12=0 0 0 0 0 0;.3 .3;.2 .2")
      call wrong(suite, "2=3222020|6=|10=10 2 -0.5 -0.4 0.1 0.1|12=0 0 0 0 0 0;.3 0 0 0 0;-.2 0 0 0 0;0 0", "FKIN = -.2")
   end subroutine friction

   !> Materials, damping, heat
   subroutine materials(suite)
      type(test_suite), intent(inout) :: suite
      character(len=*), parameter :: steel = "8=.3 .3 1 1;"

      call right(suite, "1=200100|7=|8=-.1 .3 1 1")
      call wrong(suite, "1=200100|7=|8=-1 .3 1 1", "POISS1 = -1 must be larger than -1")
      call wrong(suite, "8=.3 .6 1 1|1=200100|7=", "POISS2 = .6 is above its upper bound 0.5")
      call wrong(suite, "8=.3 .3 0 1", "GG1 = 0 is below its lower bound 1.00000E-05")
      call wrong(suite, "1=200100|7=|8=.3 .3 1 1e21", "GG2 = 1e21 is above its upper bound 1.00000E+20 N/mm2")
      call right(suite, "1=213100|" // steel // "1e-6")
      call wrong(suite, "1=213100|" // steel // "0", "FLXZ = 0 is below")
      call wrong(suite, "2=0022120|" // steel // "-1 0 0 0", "FG1 = -1 is below")
      call wrong(suite, "2=0022120|" // steel // "0 -1 0 0", "FG2 = -1 is below")
      call wrong(suite, "2=0022120|" // steel // "0 0 -1 0", "TC1 = -1 is below")
      call wrong(suite, "2=0022120|" // steel // "0 0 0 -1", "TC2 = -1 is below")
      call wrong(suite, "2=0022220|" // steel // "0 1 1 1", "FLX = 0 is below")
      call wrong(suite, "2=0022220|" // steel // "1 0 1 1", "K0_MF = 0 is below")
      call wrong(suite, "2=0022320|" // steel // "1.1 1 1", "K0_MF = 1.1 is above")
      call wrong(suite, "2=0022520|" // steel // "1 1.1 1", "ALFAMF = 1.1 is above")
      call wrong(suite, "2=0022320|" // steel // "1 1 -1", "BETAMF = -1 is below")
      call right(suite, "2=0022420|" // steel // "1 0 1e11 0")
      call wrong(suite, "2=0022420|" // steel // "0 0 0 0", "GG3 = 0 is below")
      call wrong(suite, "2=0022420|" // steel // "1 -1 0 0", "LAYTHK = -1 is below")
      call right(suite, "2=0022620")
      call wrong(suite, "2=0024020|4=100 100 30 10 1e-5|8=2 1 2;0 0 1 0;.3 .3 1 1", "IF_METH = 2 is outside its range 0 to 1")
      call wrong(suite, "2=0024020|4=100 100 30 10 1e-5|8=0 5 2;0 0 1 0;.3 .3 1 1", "VARIANT = 5 is outside its range 1 to 4")
      call wrong(suite, "2=0024020|4=100 100 30 10 1e-5|8=0 1 0;.3 .3 1 1", "NN = 0 is outside its range 2 to 999999")
      call right(suite, "3=3000001|" // steel // "0 1 1 1;0 1 1 1")
      call right(suite, "1=200100|3=3000001|7=|" // steel // "0 1 1 1;0 1 1 1")
      call right(suite, "2=0029020|4=100 100 30 10 1e-5|8='a,b.txt';.3 .3 1 1")
      call wrong(suite, "2=0022020 2|" // steel // "-1 0 0 0", "CDAMPN = -1 is below")
      call wrong(suite, "2=0022020 2|" // steel // "0 -1 0 0", "CDAMPT = -1 is below")
      call wrong(suite, "2=0022020 2|" // steel // "0 0 -1 0", "DFNMAX = -1 is below")
      call wrong(suite, "2=0022020 2|" // steel // "0 0 0 -1", "DFTMAX = -1 is below")
      call wrong(suite, "3=3000001|" // steel // "0 0 1 1;0 1 1 1", "HEATCP1 = 0 is below")
      call wrong(suite, "3=3000001|" // steel // "0 1 1 1;0 1 0 1", "LAMBDA2 = 0 is below")
      call wrong(suite, "3=3000001|" // steel // "0 1 1 0;0 1 1 1", "DENS1 = 0 is below")
      call wrong(suite, "2=0022420|3=3000001|" // steel // "1 0 0 0;0 1 1 1;0 1 1 1;1.5", "BETAPL = 1.5 is above")
   end subroutine materials

   !> Potential contact areas
   subroutine grids(suite)
      type(test_suite), intent(inout) :: suite
      character(len=*), parameter :: hertz = "|11=|12="

      call wrong(suite, "9=5|10=|11=|12=", "IPOTCN = 5 is not a known option")
      call wrong(suite, "9=0|10=|11=|12=", "IPOTCN = 0 is not a known option")
      call right(suite, "9=-1|10=10 8 .1 .1 1.1" // hertz)
      call wrong(suite, "9=-1|10=10 8 0 .1 1.1" // hertz, "A1 = 0 is below its lower bound")
      call wrong(suite, "9=-1|10=10 8 .1 -1 1.1" // hertz, "B1 = -1 is below its lower bound")
      call wrong(suite, "9=-2|10=10 8 .1 0 1.1" // hertz, "AOB = 0 is below its lower bound")
      call wrong(suite, "9=-3|10=10 8 0 1 1.1" // hertz, "AA = 0 is below its lower bound")
      call wrong(suite, "9=-3|10=10 8 1 0 1.1" // hertz, "BB = 0 is below its lower bound")
      call wrong(suite, "9=-3|10=10 8 1 1 0" // hertz, "SCALE = 0 is below its lower bound")
      call wrong(suite, "9=-4|10=10 8 0 1 1" // hertz, "A1 = 0 is below its lower bound")
      call wrong(suite, "9=-5|10=10 8 1 0 1" // hertz, "BB = 0 is below its lower bound")
      call wrong(suite, "1=243100|9=-6|10=10 8 1 0 1 1" // hertz, "BNEG = 0 is below")
      call wrong(suite, "1=243100|9=-6|10=10 8 1 1 0 1" // hertz, "BPOS = 0 is below")
      call wrong(suite, "1=243100|9=-6|10=10 8 0 1 1 1" // hertz, "AA = 0 is below its lower bound")
      call wrong(suite, "10=0 8 0 0 .1 .1", "MX = 0 is outside its range 1 to 2000000")
      call wrong(suite, "10=10 -1 0 0 .1 .1", "MY = -1 is outside its range 1 to 2000000")
      call wrong(suite, "10=2000 1001 0 0 .1 .1", "is above its upper bound of 2000000 elements")
      call wrong(suite, "10=2000000000 8 0 0 .1 .1", "MX = 2000000000 is outside its range")
      call wrong(suite, "10=10 8 0 0 0 .1", "DX = 0 is below its lower bound 1.00000E-08")
      call wrong(suite, "9=3|10=10 8 0 0 .1 -.1", "DY = -.1 is below its lower bound 1.00000E-08")
      call right(suite, "9=2|10=1 1 0 0 .1 .1")
      call wrong(suite, "9=2|10=10 8 0 0 0 1", "XH = 0 must be larger than XL = 0")
      call wrong(suite, "9=2|10=10 8 0 0 1 -1", "YH = -1 must be larger than YL = 0")
      call right(suite, "9=4|10=2 2 0 0 .1 .1")
      call wrong(suite, "9=4|10=10 8 1 0 0 1", "XCM = 0 must be larger than XC1 = 1")
      call wrong(suite, "9=4|10=10 8 0 1 1 1", "YCM = 1 must be larger than YC1 = 1")
      call wrong(suite, "9=4|10=1 8 0 0 1 1", "MX = 1 is below its lower bound 2 for IPOTCN = 4")
      call wrong(suite, "9=4|10=10 1 0 0 1 1", "MY = 1 is below its lower bound 2 for IPOTCN = 4")
   end subroutine grids

   !> Undeformed distances and planforms
   subroutine geometries(suite)
      type(test_suite), intent(inout) :: suite
      character(len=*), parameter :: quadratic = "12=0.01 0 0.01 0 0 0;"

      call wrong(suite, "11=4 1|12=", "IBASE = 4 is not a known option")
      call wrong(suite, "11=1 5", "IPLAN = 5 is not a known option")
      call right(suite, "11=2 1|12=2 0 1 0 .1;0 0")
      call wrong(suite, "11=2 1|12=1 0 1 0 .1;0", "NN = 1 is outside its range 2 to 999999")
      call wrong(suite, "11=2 1|12=2 0 1 0 0;0 0", "DY1 = 0 is below")
      call right(suite, "11=3 1|12=1 2 3 4 5 6 7 8")
      call right(suite, "11=9 1|10=2 2 0 0 1 1|12=1 2;3 4")
      call right(suite, "11=1 2|" // quadratic // "1 2 3 4 5 6")
      call right(suite, "11=1 3|" // quadratic // "0 1 0 1 0 1 0 1")
      call wrong(suite, "11=1 3|" // quadratic // "0 1 0 1 0 1 1 1", "YH2 = 1 must be larger than YL2 = 1")
      call wrong(suite, "11=1 3|" // quadratic // "0 1 0 1 2 1 0 1", "XH2 = 1 must be larger than XL2 = 2")
      call right(suite, "11=1 4|" // quadratic // "3;0 1 0 1 0 1 0 1 0 1 0 1;.1 .2 .3")
   end subroutine geometries

   !> Digits and numbers together
   subroutine combinations(suite)
      type(test_suite), intent(inout) :: suite
      character(len=*), parameter :: ellipse = "|9=-3|10=10 8 1 1 1|11=|12=", strip = "|9=-5|10=10 8 1 1 1|11=|12="

      call right(suite, "1=223100" // ellipse)
      call wrong(suite, "1=223100", &
         & "needs a Hertzian option, IPOTCN = -5, -4, -3, -2 or -1, not IPOTCN = 1")
      call wrong(suite, "1=233100|2=0022320|8=.3 .3 1 1;1 1 1", "needs a Hertzian option")
      call wrong(suite, "1=203100|9=-6|10=10 8 1 1 1 1|11=|12=", &
         & "IPOTCN = -6, a grid around two half ellipses, needs the pressures of SDEC, B = 4, not B = 0")
      call wrong(suite, "1=243100" // ellipse, &
         & "B = 4, SDEC, needs a grid around two half ellipses, IPOTCN = -6, not IPOTCN = -3")
      call right(suite, "1=243100|9=-6|10=10 8 1 1 1 1|11=|12=")
      call right(suite, "1=203100" // strip)
      call wrong(suite, "1=203000|5=.01 0 0 0" // strip, &
         & "IPOTCN = -5, a Hertzian line contact, needs the normal force, N = 1, not N = 0")
      call dubious(suite, "1=223100" // strip, "the approach is not computed")
      call wrong(suite, "1=203000|5=-.01 0 0 0" // ellipse, &
         & "PEN = -0.01 must be 0 or more for a Hertzian option with a prescribed approach")
      call dubious(suite, "1=233100" // ellipse, "B = 3, a parabolic traction bound")
      call wrong(suite, "1=243000|9=-6|10=10 8 1 1 1 1|11=|12=", "B = 4, SDEC, needs the normal force, N = 1, not N = 0")
      call wrong(suite, "1=253100", "B = 5, KPEC or ANALYN, needs the approach")
      call wrong(suite, "1=263100", "B = 6, KPEC or ANALYN, needs the approach")
      call right(suite, "1=253000")
   end subroutine combinations

   !> A new grid and values kept from the old one
   subroutine grids_of_two_cases(suite)
      type(test_suite), intent(inout) :: suite
      character(len=*), parameter :: old = "2=0020020|8=|7="
      character(len=*), parameter :: go_on = "1=003100|"
      character(len=*), parameter :: kept = "2=0100010|6=|7=|8=|9=|10=|11=|12="

      call right_second(suite, "", old // "|10=8 8 0 0 .100005 .1")
      call wrong_second(suite, "", old // "|10=8 8 0 0 .101 .1", "DX = 0.101 differs from the 0.1 of the influence")
      call wrong_second(suite, "", old // "|10=8 8 0 0 .1 .2", "DY = 0.2 differs from the 0.1 of the influence")
      call wrong_second(suite, "", old // "|10=11 8 0 0 .1 .1", "MX = 11 is above its upper bound, the 10 of the influence")
      call wrong_second(suite, "", old // "|10=8 9 0 0 .1 .1", "MY = 9 is above its upper bound, the 8 of the influence")
      call right_second(suite, "9=-3|10=10 8 1 1 1|11=|12=", old // "|9=2|10=8 8 0 0 1.6 2.0")
      call right_second(suite, "", go_on // "10=12 7 -0.6 -0.3 .1 .1")
      call right_second(suite, "", go_on // "10=12 7 -0.60005 -0.3 .1 .1")
      call wrong_second(suite, "", go_on // "10=12 7 -0.61 -0.3 .1 .1", "XC1, the centre of the first element, moves by -0.11")
      call wrong_second(suite, "", go_on // "10=12 7 -0.6 -0.35 .1 .1", "YC1, the centre of the first element, moves by 0.05")
      call wrong_second(suite, "", go_on // "10=12 7 -0.6 -0.3 .11 .1", "DX = 0.11 differs from the 0.1 of the previous case")
      call wrong_second(suite, "", "3=0010001|10=12 7 -0.6 -0.3 .1 .11", "DY = 0.11 differs from the 0.1 of the previous")
      call right_second(suite, "", "10=12 7 -0.61 -0.3 .12 .1")
      call wrong_second(suite, "10=2 2 0 0 1 1|11=9 1|12=1 2 3 4", "2=0022010|10=3 2 0 0 1 1|11=|12=", "IBASE = 9")
      call wrong_second(suite, "10=2 2 0 0 1 1|11=9 1|12=1 2 3 4", "2=0022010|10=2 2 5 0 1 1|11=|12=", "IBASE = 9")
      call right_second(suite, "10=2 2 0 0 1 1|11=9 1|12=1 2 3 4", "2=0022010|10=2 2 0 0 1 1|11=|12=")
      call right_second(suite, "10=2 2 0 0 1 1|11=9 1|12=1 2 3 4", kept)
      call wrong_second(suite, "2=0022029|10=1 1 0 0 1 1|12=1 0 1 0 0 0;1 2", "2=0022021", "E = 1 keeps the extra")
      call memory_of_coefficients(suite)
   end subroutine grids_of_two_cases

   !> C = 0 compares with the grid of the coefficients, not of the previous case
   subroutine memory_of_coefficients(suite)
      type(test_suite), intent(inout) :: suite
      character(len=*), parameter :: module_line = "3" // nl
      type(experiment_reader) :: reader
      type(input_case) :: this
      type(error_type), allocatable :: error
      integer :: k

      call reader%open_text(module_line // new_case("") // module_line // new_case("2=0020020|7=|8=|10=5 5 0 0 .1 .1") // &
         & module_line // new_case("2=0020020|7=|8=") // "0", "test")
      do k = 1, 3
         call reader%next_case(this, error)
         call suite%check(.not. allocated(error) .and. this%problems%count == 0, "a smaller grid between two of one size")
      end do
   end subroutine memory_of_coefficients

   !> Outer iteration and difference of materials
   subroutine outer_iteration(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call right(suite, "4=100 100 30 10 1e-5")
      call dubious(suite, "4=100 100 30 10 1e-5|8=.3 .3001 1 1", "MAXOUT = 10 is replaced by 1")
      call read_one("4=100 100 30 10 1e-5", spec, problems, error)
      call suite%check(spec%outer_iterations() == 1, "one outer iteration for similar bodies")
      call read_two("4=100 100 30 7 1e-5", "3=0100001|4=|8=.3 .4 1 1", spec, problems, error)
      call suite%check(spec%outer_iterations() == 7, "MAXOUT is kept while bodies are similar")
      call dubious(suite, "8=.3 .4 1 1", "dissimilar materials, AK = 0.05;")
      call right(suite, "4=100 100 30 10 1e-5|8=.3 .4 1 1")
      call dubious(suite, "8=.4 .3 1 1", "dissimilar materials, AK = -0.05;")
      call right(suite, "4=100 100 30 10 1e-5|8=.4 .3 1 1")
      call dubious(suite, "2=0024020|8=0 1 2;0 0 1 0;.3 .3 1 1", "dissimilar shapes")
      call right(suite, "1=200100|4=100 100 30 10 1e-5|7=")
      ! one of materials, iterations and motion is new, the others are kept
      call dubious_second(suite, "4=100 100 30 10 1e-5|8=.3 .4 1 1", "2=0020020|7=|8=", "dissimilar materials, AK = 0.05;")
      call right_second(suite, "8=.3 .4 1 1", "2=0020020|3=0100001|4=|7=|8=")
      call right(suite, "1=200100|7=|8=.3 .4 1 1")
      call dubious_second(suite, "1=200100|7=|8=.3 .4 1 1", "1=201100|2=0020020|3=0100001|4=|7=|8=", &
         & "dissimilar materials, AK = 0.05;")
   end subroutine outer_iteration

   !> Text that cannot be read
   subroutine unreadable(suite)
      type(test_suite), intent(inout) :: suite

      call fails(suite, "1=abc", "test:1:1: ""abc"" is not an integer; expected PBTNFS")
      call fails(suite, "4=abc 100 30 1 1e-5", "test:4:1: ""abc"" is not an integer; expected MAXGS, an integer, value 1 of " // &
         & "the group MAXGS MAXIN MAXNR MAXOUT EPS NPOT_MAX; the line reads ""abc 100 30 1 1e-5"" (case 1)")
      call fails(suite, "5=10 0 0 CPHI", """CPHI"" is not a number; expected CPHI")
      call fails(suite, "7=0 0.1d 1000", """0.1d"" is not a number; expected DQ")
      call fails(suite, "10=10. 8 0 0 1 1", """10."" is not an integer; expected MX")
      call fails(suite, "2=0029020|8=file.txt;.3 .3 1 1", """file.txt"" is not a text in single quotes")
      call fails(suite, "12=1 2 3 4 5", "the end of the file is reached; expected B(6)")
      call fails(suite, "10=|11=|12=", "the end of the file is reached; expected MX")
      call fails(suite, "1=abc", "(case 1)")
      call fails(suite, "11=9 1|10=0 8 0 0 1 1|12=1", "the list H has one entry for each element")
      call fails(suite, "2=0022029|10=1000000 8 0 0 1 1", "the list EXRHS has one entry for each element")
   end subroutine unreadable

   !> Choices that few cases make, with their numbers
   subroutine rare_choices(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error

      call right(suite, "1=213100|8=.3 .3 1 1;1")
      call right(suite, "2=0022620")
      call right(suite, "2=0022720")
      call right(suite, "2=0022022")
      call right(suite, "2=0022023")
      call right(suite, "2=0022120|7=180d 0.1 1000|8=.3 .3 1 1;0 0 0 0")
      call wrong(suite, "1=202100|2=0022620", "M = 6, FaStrip, needs steady rolling")
      call wrong(suite, "1=203100|2=0023120|8=.3 .3 1 1;1 1 .1 .1", "M = 1, viscoelastic material, needs half-spaces")
      call wrong(suite, "2=0022622", "its strips know creepages and spin only")
      call right(suite, "11=1 4|12=0 0 0 0 0 0;1;0 1 0 1")
      call wrong(suite, "11=1 4|12=0 0 0 0 0 0;1;0 1 1 1", "rectangle 1 has not")
      call wrong(suite, "11=1 4|12=0 0 0 0 0 0;2;0 1 0 1 2 3 0 1;1.1", "1.1 is above its upper bound 1")
      call fails(suite, "11=1 4|12=0 0 0 0 0 0;101", "NP = 101, the number of parts of IPLAN = 4, is outside its range 1 to 100")
      call read_one("11=1 4|12=0 0 0 0 0 0;3;0 1 0 1 2 3 0 1 4 5 0 1;.1 .2;.3", spec, problems, error)
      call suite%check(.not. allocated(error), "three parts are read")
      call suite%equal(size(spec%geometry%rectangles, 2), 3, "three parts")
      call suite%close_to([spec%geometry%interaction(1, 2), spec%geometry%interaction(1, 3), spec%geometry%interaction(2, 3), &
         & spec%geometry%interaction(3, 2), spec%geometry%interaction(2, 2)], [0.1_wp, 0.2_wp, 0.3_wp, 0.3_wp, 1.0_wp], &
         & 1.0e-15_wp, "factors of three parts, by rows of the upper triangle")
   end subroutine rare_choices

   !> Several problems at once are all reported, in the order of the file
   subroutine collected(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec
      type(problem_list) :: problems
      type(error_type), allocatable :: error
      integer :: k

      call read_one("1=003100|3=0000801|4=0 0 0 0 -1|5=-1 0 0 0|6=0 0|7=0 -1 -1|8=.6 .6 1 1|10=0 0 0 0 0 0|11=1 6", &
         & spec, problems, error)
      call suite%check(.not. allocated(error), "many problems do not stop the reading")
      call suite%equal(problems%number_of(severity%error), 17, "number of errors")
      call suite%equal(problems%number_of(severity%warning), 1, "number of warnings")
      do k = 2, problems%number_of(severity%error)
         if (problems%items(k)%severity /= severity%error .or. problems%items(k)%what%line < 3) cycle
         call suite%check(problems%items(k)%what%line >= problems%items(k - 1)%what%line .or. k <= 2, "order of the file")
      end do
      call suite%check(index(problem_text(problems%items(2)), " Input: WARNING. test:1:1: P = 0") == 1, "head of a warning")
   end subroutine collected

   !> The level above: modules, result elements, faulty cases in a sequence
   subroutine experiments(suite)
      type(test_suite), intent(inout) :: suite

      call sequence(suite, "3 MODULE" // nl // new_case("") // "3" // nl // new_case("") // "0 END" // nl // "rubbish", &
         & [1, 2], "", "two cases")
      call sequence(suite, "3" // nl // new_case("3=0000000") // new_case("3=0000002") // new_case("") // "0", [1, 2, 3], "", &
         & "staying in the module")
      call sequence(suite, "3 7" // nl // new_case("") // "3 8" // nl // new_case("") // "3 7" // nl // new_case("") // &
         & "3 7 2" // nl // new_case("") // "3" // nl // new_case("") // "0", [1, 1, 2, 1, 1], "", "result elements")
      call sequence(suite, "3" // nl // new_case("4=0 1 1 1 1e-5") // "3" // nl // new_case("5=-1 0 0 0") // "0", [1, 2], "", &
         & "two faulty cases")
      call sequence(suite, "0", [integer ::], "", "nothing")
      call sequence(suite, "3" // nl // new_case(""), [1], "the end of the file is reached; expected MODULE", "no end")
      call sequence(suite, "", [integer ::], "the end of the file is reached; expected MODULE", "an empty file")
      call sequence(suite, "2", [integer ::], "MODULE = 2 is not a known module", "a wrong module")
      call sequence(suite, "x", [integer ::], """x"" is not an integer; expected MODULE", "no module")
      call sequence(suite, nl // " 1", [integer ::], "the end of the file is reached; expected CPBTNFS", &
         & "wheel-rail contact without a case")
      call sequence(suite, "3 0", [integer ::], "REID = 0 is outside its range 1 to 999", "a wrong element")
      call sequence(suite, "3 1000", [integer ::], "REID = 1000 is outside its range 1 to 999", "another wrong element")
      call sequence(suite, "3 1 10", [integer ::], "CPID = 10 is outside its range 1 to 9", "a wrong patch")
      call sequence(suite, "3" // nl // new_case("") // "3" // nl // "abc", [1], """abc"" is not an integer; expected PBTNFS", &
         & "an unreadable second case")
         call replaced_store(suite)
      call too_many_elements(suite)
   end subroutine experiments

   !> The numbers of the cases, then the end or an error
   subroutine sequence(suite, text, numbers, phrase, what)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: text
      integer, intent(in) :: numbers(:)
      !> Empty when the end is regular
      character(len=*), intent(in) :: phrase, what
      type(experiment_reader) :: reader
      type(input_case) :: this
      type(error_type), allocatable :: error
      integer :: k

      call reader%open_text(text, "test")
      do k = 1, size(numbers)
         call reader%next_case(this, error)
         call suite%check(.not. allocated(error) .and. this%module_number == 3 .and. this%number == numbers(k), what)
         if (allocated(error)) return
      end do
      call reader%next_case(this, error)
      call suite%check(allocated(error) .eqv. len(phrase) > 0, what // ", end")
      if (allocated(error)) then
         call suite%check(index(full_text(error), phrase) > 0, what // ": " // full_text(error))
      else
         call suite%check(this%module_number == 0, what // ", module 0")
      end if
   end subroutine sequence

   !> What is known only after a case was prepared can be put into the store
   subroutine replaced_store(suite)
      type(test_suite), intent(inout) :: suite
      type(experiment_reader) :: reader
      type(input_case) :: this
      type(error_type), allocatable :: error

      call reader%open_text("3" // nl // new_case("9=-3|10=9 9 1 1 1|11=|12=") // "3" // nl // &
         & new_case("2=0022010|11=|12=") // "0", "test")
      call reader%next_case(this, error)
      this%spec%geometry%b(1) = 0.125_wp
      call reader%store_case(this%spec)
      call reader%next_case(this, error)
      call suite%check(this%spec%geometry%b(1) == 0.125_wp .and. this%spec%parts%geometry == part_source%renewed, &
         & "a replaced store")
   end subroutine replaced_store

   !> The complete example of doc/user/input.md, its first piece between ``` lines
   subroutine manual_example(suite)
      type(test_suite), intent(inout) :: suite
      type(experiment_reader) :: reader
      type(input_case) :: this
      type(error_type), allocatable :: error
      character(len=:), allocatable :: folder, text
      character(len=200) :: line
      integer :: fences, status, unit

      folder = environment("CONTACT_SOURCE")
      if (len(folder) == 0) folder = "."
      open(newunit=unit, file=folder // "/doc/user/input.md", status="old", action="read", iostat=status)
      if (status /= 0) then
         call suite%skip("example of the manual", "doc/user/input.md is not there")
         return
      end if
      text = ""
      fences = 0
      do while (fences < 2)
         read(unit, "(a)", iostat=status) line
         if (status /= 0) exit
         if (line(1:3) == "```") then
            fences = fences + 1
         else if (fences == 1) then
            text = text // trim(line) // nl
         end if
      end do
      close(unit)
      call reader%open_text(text, "manual")
      call reader%next_case(this, error)
      call no_problem(suite, this%problems, error, "example of the manual")
      call reader%next_case(this, error)
      call suite%check(.not. allocated(error) .and. this%module_number == 0, "end of the example of the manual")
   end subroutine manual_example

   !> At most a hundred result elements
   subroutine too_many_elements(suite)
      type(test_suite), intent(inout) :: suite
      type(experiment_reader) :: reader
      type(input_case) :: this
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text
      character(len=4) :: number
      integer :: k

      text = ""
      do k = 1, 101
         write(number, "(i0)") k
         text = text // "3 " // trim(number) // nl // new_case("")
      end do
      call reader%open_text(text // "0", "test")
      do k = 1, 100
         call reader%next_case(this, error)
         if (allocated(error)) exit
      end do
      call suite%check(.not. allocated(error) .and. this%reid == 100, "a hundred elements")
      call reader%next_case(this, error)
      call suite%check(allocated(error), "one element too many")
   end subroutine too_many_elements
end program test_reader3
