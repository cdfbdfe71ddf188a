!> The description of the input: every form of every group is read back as it was written, and every number has bounds
module description_archives
   use contact_base_kinds, only : wp
   use contact_cases_archive, only : case_archive
   use contact_text_bounds, only : bounds_of, bounds_table
   implicit none (type, external)
   private

   public :: collector, filler

   !> Gives every number another value within its bounds
   type, extends(case_archive) :: filler
      integer :: given = 0
   contains
      procedure :: end_line => fill_line
      procedure :: list => fill_list
   end type filler

   !> Notes every number with its name
   type, extends(case_archive) :: collector
      integer :: n = 0
      real(wp) :: values(2000) = 0.0_wp
      character(len=16) :: names(2000) = ""
      !> Rows of the table of bounds that were met
      logical :: met(size(bounds_table)) = .false.
      !> Was there a number without bounds that is not checked elsewhere?
      logical :: without_bounds = .false.
   contains
      procedure :: end_line => collect_line
      procedure :: list => collect_list
   end type collector

contains

   !> The next value between two bounds, with digits that a short format would lose
   subroutine next_value(self, lowest, highest, value)
      class(filler), intent(inout) :: self
      real(wp), intent(in) :: lowest, highest
      real(wp), intent(out) :: value
      real(wp) :: part

      self%given = self%given + 1
      part = 0.1_wp + 0.7_wp*mod(self%given*0.6180339887498949_wp, 1.0_wp)
      value = lowest + part*(min(highest, max(lowest, 0.0_wp) + 9.0_wp) - lowest)
      if (lowest < -1.0e3_wp) value = part*9.0_wp - 4.0_wp
   end subroutine next_value

   subroutine fill_line(self)
      class(filler), intent(inout) :: self
      real(wp) :: value
      integer :: k, row

      do k = 1, self%count
         associate (item => self%items(k))
            if (associated(item%s)) item%s%value = "name of " // trim(item%name)
            if (associated(item%s) .or. (item%is_unchecked .and. associated(item%i))) cycle
            row = item%row
            if (row == 0) row = bounds_of("PROFILE")
            call next_value(self, bounds_table(row)%lowest, bounds_table(row)%highest, value)
            if (associated(item%r)) item%r = value
            if (associated(item%i)) item%i = nint(value)
         end associate
      end do
      call self%finish_line()
   end subroutine fill_line

   subroutine fill_list(self, name, values, n, units, bounds)
      class(filler), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: n
      character(len=*), intent(in), optional :: units(:)
      character(len=*), intent(in), optional :: bounds
      integer :: k, row

      row = bounds_of(name)
      if (present(bounds)) row = bounds_of(bounds)
      if (present(units)) row = max(1, row)
      if (allocated(values)) deallocate(values)
      allocate(values(n))
      do k = 1, n
         call next_value(self, bounds_table(row)%lowest, bounds_table(row)%highest, values(k))
      end do
   end subroutine fill_list

   subroutine collect_line(self)
      class(collector), intent(inout) :: self
      integer :: k

      do k = 1, self%count
         associate (item => self%items(k))
            if (item%row > 0) self%met(item%row) = .true.
            if (item%row == 0 .and. .not. (item%is_unchecked .or. associated(item%s))) self%without_bounds = .true.
            if (associated(item%r)) call note(self, trim(item%name), item%r)
            if (associated(item%i)) call note(self, trim(item%name), real(item%i, wp))
         end associate
      end do
      call self%finish_line()
   end subroutine collect_line

   subroutine collect_list(self, name, values, n, units, bounds)
      class(collector), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: n
      character(len=*), intent(in), optional :: units(:)
      character(len=*), intent(in), optional :: bounds
      integer :: k, row

      row = bounds_of(name)
      if (present(bounds)) row = bounds_of(bounds)
      if (row > 0) self%met(row) = .true.
      if (row == 0 .or. (present(units) .and. size(values) /= n)) self%without_bounds = .true.
      do k = 1, n
         call note(self, name, values(k))
      end do
   end subroutine collect_list

   subroutine note(self, name, value)
      class(collector), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: value

      self%n = self%n + 1
      self%names(self%n) = name
      self%values(self%n) = value
   end subroutine note
end module description_archives

program test_description
   use contact_base_choices, only : material_model, solver_choice, variation
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_archive, only : case_archive
   use contact_cases_distance, only : visit_distance
   use contact_cases_grid_inputs, only : visit_grid, visit_planform
   use contact_cases_inputs, only : visit_coefficient_file, visit_conformal, visit_damping, visit_elastic, visit_friction, &
      & visit_friction_rows, visit_heat, visit_inclinations, visit_iteration, visit_kinematics, visit_material_model, &
      & visit_rolling, visit_sheet, visit_wear
   use contact_cases_rail_inputs, only : visit_deviations, visit_dimensions, visit_flexibility, visit_position, visit_profile, &
      & visit_search, visit_springs, visit_track, visit_velocity
   use contact_cases_spec, only : case_spec, friction_set
   use contact_cases_subsurface_inputs, only : visit_blocks, visit_stress_output
   use contact_control_digits, only : digit_table
   use contact_input_file_reader, only : file_reader, new_file_reader
   use contact_input_problems, only : problem_list, problem_text
   use contact_base_output_file, only : output_file
   use contact_output_file_writer, only : file_writer
   use contact_test_harness, only : test_suite
   use contact_text_bounds, only : bounds_table
   use contact_text_lexer, only : input_lexer
   use description_archives, only : collector, filler
   use contact_friction_law, only : friction_driver, friction_law
   use contact_friction_new_law, only : friction_model, new_friction_law
   implicit none (type, external)
   !> The friction laws of L
   integer, parameter :: laws(*) = pack(digit_table%choice, digit_table%name == "L" .and. digit_table%word /= "")
   !> Forms of the groups; from the first law each of them by none, angle, position and rows
   integer, parameter :: first_law = 53, forms = first_law - 1 + 4*size(laws)
   type(test_suite) :: suite
   logical :: met(size(bounds_table))
   integer :: form, k

   call suite%start("description of the input")
   met = .false.
   do form = 1, forms
      call round_trip(suite, form, met)
   end do
   do k = 1, size(bounds_table)
      if (is_elsewhere(bounds_table(k)%name)) cycle
      call suite%check(met(k), "a group has the number " // trim(bounds_table(k)%name))
   end do
   call suite%finish()

contains

   !> Numbers of profile and coefficient files, of calls, and of special lines of the readers of blocks
   pure logical function is_elsewhere(name)
      character(len=*), intent(in) :: name
      character(len=*), parameter :: others(*) = [character(len=11) :: "MXSENS", "EPSENS", "EXRHS", "POLACH_A", "POLACH_B", "CZZ", &
         & "IXL", "IXINC", "IXH", "IYL", "IYINC", "IYH", "NX", "NY", "NZ", "IX", "IY", "X", "Y", "Z", "ZL", "DZ", "PROFILE", &
         & "GAUGSQ", "GAUGWD", "RAILY0", "RAILZ0"]

      is_elsewhere = any(others == name)
   end function is_elsewhere

   !> Friction law of a form, -1 where it has none
   pure integer function law_of(form) result(law)
      integer, intent(in) :: form

      law = -1
      if (form >= first_law) law = laws(1 + mod(form - first_law, size(laws)))
   end function law_of

   !> A law that was read is created, and its value without slip and temperature is the coefficient at rest
   subroutine laws_at_rest(suite, label, choice, sets)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: label
      integer, intent(in) :: choice
      type(friction_set), intent(in) :: sets(:)
      class(friction_law), allocatable :: law
      type(error_type), allocatable :: error
      real(wp), allocatable :: cause(:, :), mu(:, :), rest(:, :)
      real(wp) :: lowest

      call new_friction_law(choice, sets, law, error)
      call suite%check(.not. allocated(error), label // ": new_friction_law makes the law")
      if (allocated(error)) return
      lowest = merge(-273.15_wp, 0.0_wp, law%driver() == friction_driver%temperature)
      allocate(cause(1, size(sets)), source=lowest)
      allocate(mu, rest, mold=cause)
      call law%coefficient(cause, mu)
      call law%at_rest(rest)
      call suite%close_to(mu(1, :), rest(1, :), 1.0e-14_wp*maxval(rest), label &
         & // ": its coefficient without slip or heat is fstat, which visit_friction_set sets")
   end subroutine laws_at_rest

   !> Take one form of one group to or from an archive
   subroutine visit(a, form, spec)
      class(case_archive), intent(inout) :: a
      integer, intent(in) :: form
      type(case_spec), intent(inout), target :: spec
      integer, parameter :: solvers(0:5) = [solver_choice%default, solver_choice%default, solver_choice%convex_gs, &
         & solver_choice%gauss_seidel, solver_choice%default_friction, solver_choice%gd_steady]
      integer, parameter :: grids(10) = [-6, -5, -4, -3, -2, -1, 1, 2, 3, 4], distances(4) = [1, 2, 3, 9]

      associate (pair => spec%wheel_rail, m => spec%material)
         select case (form)
         case (1:6)
            call visit_iteration(a, spec%iteration, solvers(form - 1), with_elements=form > 1)
         case (7:12)
            call visit_kinematics(a, spec%kinematics, mod(form, 2), (form - 7)/2)
         case (13)
            call visit_rolling(a, spec%rolling, material_model%elastic)
         case (14:21)
            call visit_elastic(a, m)
            call visit_material_model(a, form - 14, m)
         case (22)
            call visit_sheet(a, m)
            call visit_conformal(a, m)
            call visit_coefficient_file(a, m)
         case (23)
            if (.not. allocated(m%table_y)) m%table_y = [-1.25_wp, 0.1_wp, 3.7_wp]
            if (.not. allocated(m%table_alpha)) m%table_alpha = [-0.3_wp, 0.01_wp, 0.2_wp]
            call visit_inclinations(a, m)
         case (24)
            call visit_damping(a, spec%damping)
            call visit_stress_output(a, spec%subsurface)
         case (25:26)
            call visit_heat(a, spec%heat, with_plastic_work=form == 26)
         case (27:36)
            spec%grid%form = grids(form - 26)
            call visit_grid(a, spec%grid)
         case (37:40)
            spec%geometry%form = distances(form - 36)
            call visit_distance(a, spec%geometry, 6)
         case (41:43)
            spec%geometry%planform = form - 39
            if (.not. allocated(spec%geometry%rectangles)) allocate(spec%geometry%rectangles(4, 3))
            if (.not. allocated(spec%geometry%interaction)) allocate(spec%geometry%interaction(3, 3), source=0.5_wp)
            call visit_planform(a, spec%geometry)
         case (44)
            call visit_search(a, pair%search, with_step=.true.)
         case (45:46)
            call visit_track(a, pair%track, roller=form == 46)
         case (47)
            call visit_deviations(a, pair%rail)
            call visit_springs(a, pair%rail)
            call visit_dimensions(a, pair%wheelset)
            call visit_flexibility(a, pair%wheelset)
         case (48:49)
            call visit_position(a, pair%wheelset, form == 48, with_force=form == 49)
            call visit_velocity(a, pair%wheelset, form == 48, with_force=form == 49)
         case (50:51)
            call visit_profile(a, trim(merge("RFNAME", "WFNAME", form == 50)), pair%rail_profile)
         case (52)
            call visit_wear(a, spec%wear)
         case (first_law:)
            select case ((form - first_law)/size(laws))
            case (0); call visit_friction(a, law_of(form), variation%none, spec%friction)
            case (1); call visit_friction(a, law_of(form), variation%by_angle, spec%friction)
            case (2); call visit_friction(a, law_of(form), variation%by_position, spec%friction)
            case default; call visit_friction_rows(a, law_of(form), 3, spec%friction)
            end select
         end select
      end associate
   end subroutine visit

   !> Fill a group, write it, read it into an empty case, and compare
   subroutine round_trip(suite, form, met)
      type(test_suite), intent(inout) :: suite
      integer, intent(in) :: form
      logical, intent(inout) :: met(:)
      type(case_spec), target :: written, found
      type(filler) :: random
      type(collector) :: before, after
      type(output_file), target :: file
      type(file_writer) :: writer
      type(file_reader) :: reader
      type(input_lexer), target :: lexer
      type(problem_list), target :: problems
      character(len=16) :: label
      character(len=:), allocatable :: text
      character(len=:), allocatable :: reason
      character(len=400) :: line
      integer :: status, unit
      logical :: complete

      write(label, '("form ", I0)') form
      if (form >= first_law) write(label, '("L = ", I0, ", V = ", I0)') law_of(form), (form - first_law)/size(laws)
      allocate(written%wheel_rail)
      allocate(found%wheel_rail)
      allocate(written%friction%sets(3))
      written%friction%sets = friction_set()
      written%wheel_rail%rail_profile%name = "a name"
      random%given = 17*form
      call fill(random, form, written)
      call file%open_file("written.txt", reason)
      writer%file => file
      call visit(writer, form, written)
      call file%close_file(complete)
      call suite%check(complete, trim(label) // " is written")
      open(newunit=unit, file="written.txt", action="read", status="old")
      text = ""
      do
         read(unit, "(A)", iostat=status) line
         if (status /= 0) exit
         text = text // trim(line) // new_line("a")
      end do
      close(unit)
      call lexer%open_text(text, "written")
      call problems%start("written")
      reader = new_file_reader(lexer, problems)
      call visit(reader, form, found)
      call suite%check(reader%is_good, trim(label) // " is read: " // text)
      call suite%check(problems%count == 0, trim(label) // " has no problems: " // first_problem(problems) // text)
      call suite%check(lexer%at_end(), trim(label) // " is read to its end: " // text)
      call visit(before, form, written)
      call visit(after, form, found)
      call suite%equal(after%n, before%n, trim(label) // ": numbers")
      call suite%check(before%n > 0 .and. all(abs(before%values - after%values) <= 1.0e-14_wp*abs(before%values)), &
         & trim(label) // " comes back: " // text)
      call suite%check(all(before%names == after%names), trim(label) // ": names")
      call suite%check(.not. before%without_bounds, trim(label) // ": every number has bounds")
      met = met .or. before%met
      if (form >= first_law) call laws_at_rest(suite, trim(label), law_of(form), found%friction%sets)
   end subroutine round_trip

   !> Give a case values that fit to each other
   subroutine fill(random, form, spec)
      type(filler), intent(inout) :: random
      integer, intent(in) :: form
      type(case_spec), intent(inout), target :: spec
      integer :: k

      random%is_reading = .true.
      call visit(random, form, spec)
      do k = 1, size(spec%friction%sets)
         associate (set => spec%friction%sets(k))
            set%position = 0.11_wp*k
            set%fkin = merge(set%fstat, min(set%fkin, set%fstat), law_of(form) == friction_model%coulomb)
            set%dfheat = 0.5_wp*min(set%dfheat, 0.1_wp)
         end associate
      end do
      associate (g => spec%grid, i => spec%iteration, s => spec%wheel_rail%search, p => spec%wheel_rail%rail_profile)
         g%xh = g%xl + 1.5_wp
         g%yh = g%yl + 2.5_wp
         g%xcm = g%xc1 + 1.5_wp
         g%ycm = g%yc1 + 2.5_wp
         g%mx = max(2, g%mx)
         g%my = max(2, g%my)
         i%npot_max = max(100, i%npot_max)
         i%inislp = sign(1, i%inislp)
         i%d_ifc = 0.3_wp
         i%d_lin = 0.2_wp
         i%d_cns = 1.7_wp
         i%d_slp = 0.123456789012_wp
         i%pow_s = 0.7_wp
         s%a_sep = 1.3_wp
         s%d_comb = 3.3_wp
         s%d_sep = 5.1_wp
         p%zigzag = 2.1_wp
         p%scale = 0.977_wp
         p%smoothing = 0.25_wp
         p%largest_omission = 0.41_wp
      end associate
      spec%kinematics%fx = 0.3_wp
      spec%kinematics%fy = -0.4_wp
      spec%geometry%pl(2::2) = spec%geometry%pl(1::2) + 1.0_wp
      if (form == 43) spec%geometry%rectangles = spread([-1.0_wp, 1.5_wp, -2.0_wp, 2.5_wp], 2, 3)
      if (form == 45) spec%wheel_rail%track%gaught = -1.0_wp
      if (form == 46) spec%wheel_rail%track%gaught = 14.0_wp
   end subroutine fill

   !> The words of the first problem
   function first_problem(problems) result(text)
      type(problem_list), intent(in) :: problems
      character(len=200) :: text

      text = ""
      if (problems%count > 0) text = problem_text(problems%items(1))
   end function first_problem
end program test_description
