!> One case of the readable format: choices and groups are converted to digits, then groups are read and checked as in input files
!>
!> A choice that a case does not give is that of the previous case. A group that it does not give is kept; data derived from a kept
!> group are computed anew if the rest of the case requires it, or as requested by the key `renew`.
module contact_input_toml_case
   use contact_base_choices, only : motion, slip_source
   use contact_cases_continuation, only : frame_of
   use contact_cases_own_keys, only : visit_own_case
   use contact_cases_spec, only : case_spec, grid_spec
   use contact_cases_whole_case, only : visit_case
   use contact_control_digits, only : case_digits, digit_names, digit_of, digit_table, put_digit, word_length
   use contact_control_translation, only : apply_digits, digits_of
   use contact_control_words, only : choice_words, digit_of_word, form_value, is_choice, key_of, key_table, translate_to_words
   use contact_input_control, only : check_digits, control_words, refuse_unbuilt_digits
   use contact_grid_potential_contact, only : potential_contact
   use contact_input_checks, only : check_case
   use contact_input_problems, only : problem_list, severity
   use contact_input_toml_kept, only : check_kept_creepages
   use contact_input_toml_reader, only : new_toml_reader, toml_reader
   use contact_input_toml_tables, only : toml_memory
   use contact_text_nearest, only : unknown_word, words_of
   use contact_toml_document, only : toml_document, toml_kind
   implicit none (type, external)
   private

   public :: read_toml_case, group_names, renewable

   !> Groups in the order of the input files, see contact_cases_whole_case
   character(len=16), parameter :: group_names(*) = [character(len=16) :: "iteration", "kinematics", "friction", "rolling", &
      & "influence", "material", "damping", "heat", "wear", "search", "track", "rail_profile", "deviations", "springs", &
      & "wheel_dimensions", "wheel_profile", "position", "velocity", "flexibility", "grid", "geometry", "extra_slip", &
      & "stress_output", "stress_points"]
   !> Groups with derived data that can be computed anew
   character(len=8), parameter :: renewable(3) = [character(len=8) :: "grid", "geometry", "material"]
   !> Keys of a case that are not choices
   character(len=14), parameter :: plain_keys(*) = [character(len=14) :: "module", "result_element", "contact_patch", "title", &
      & "solve", "gap_weight", "renew"]

contains

   !> Read a case
   !>
   !> As read_case of contact_input_reader; all problems are reported in `problems`.
   subroutine read_toml_case(document, case_node, memory, used, module_number, ends_module, previous, has_previous, &
      & spec, problems, coefficients, digits, is_repeat)
      type(toml_document), intent(in), target :: document
      !> Table of the case
      integer, intent(in) :: case_node
      !> Keys given by the previous cases of this result element
      type(toml_memory), intent(inout), target :: memory
      !> Which nodes have been read, shape (nodes)
      logical, intent(inout), target :: used(:)
      integer, intent(in) :: module_number
      !> Is it the last case in a series of its module and result element?
      logical, intent(in) :: ends_module
      !> The previous case of this module and result element, and whether there is one
      type(case_spec), intent(in) :: previous
      !> Is there a previous case, whose values are kept if none are given?
      logical, intent(in) :: has_previous
      type(case_spec), intent(out) :: spec
      !> Must be started
      type(problem_list), intent(inout), target :: problems
      !> Grid for which influence coefficients of module 3 were last computed
      type(potential_contact), intent(inout) :: coefficients
      !> Digits equivalent to the case
      type(case_digits), intent(out) :: digits
      !> Was the case read before, with other values of its numbers? Default false
      logical, intent(in), optional :: is_repeat
      type(control_words) :: words
      type(toml_reader) :: a
      character(len=:), allocatable :: text
      logical :: is_good
      integer :: k

      spec = previous
      a = new_toml_reader(document, case_node, problems, memory, used)
      if (present(is_repeat)) a%is_repeat = is_repeat
      words%has_keys = .true.
      if (has_previous) words%digits = digits_of(previous)
      call read_choices(a, module_number, has_previous, words, is_good)
      call set_group_digits(a, module_number, previous, has_previous, words)
      words%digits%r = words%digits%r + merge(1, 0, ends_module)
      call apply_digits(words%digits, module_number, spec)
      digits = words%digits
      a%moves = spec%motion
      if (is_good) then
         call check_digits(words, module_number, previous, has_previous, spec, problems)
         digits = words%digits
         call read_wear(a, spec)
         call visit_own_case(a, spec)
         if (spec%motion == motion%none .and. .not. has_previous) a%lenient_group = "friction"
         call visit_case(a, spec)
         if (a%is_good) then
            if (module_number == 3 .and. spec%motion /= motion%none) call check_kept_creepages(a, previous, spec)
            call check_case(words, a, previous, has_previous, coefficients, spec, problems)
            if (module_number == 3 .and. words%digits%c /= 0) coefficients = frame_of(spec%grid)
            if (.not. a%is_repeat) call a%refuse_unused(group_names)
         end if
         call refuse_unbuilt_digits(words, module_number, spec, problems)
      end if
      do k = 1, problems%count
         call translate_to_words(problems%items(k)%what%message, module_number, text)
         problems%items(k)%what%message = text
      end do
   end subroutine read_toml_case

   !> Choices that have a word, and numbers that select choices
   subroutine read_choices(a, module_number, has_previous, words, is_good)
      type(toml_reader), intent(inout) :: a
      integer, intent(in) :: module_number
      logical, intent(in) :: has_previous
      !> On entry the digits of the previous case, or the initial ones; on return those of the case
      type(control_words), intent(inout) :: words
      !> False if a choice is invalid, so that nothing else can be interpreted
      logical, intent(out) :: is_good
      character(len=:), allocatable :: name, missing
      integer :: digit, k, node, row, table
      logical :: is_known

      is_good = .true.
      if (.not. has_previous) then
         words%digits%o = 2
         words%digits%m2 = 0
         if (module_number == 1) words%digits%d = 2
         words%digits%c = 2
      end if
      missing = ""
      do k = 1, size(digit_names)
         name = trim(digit_names(k))
         row = key_of(name, module_number)
         call note_place(a, words, k, a%case_node)
         if (row == 0) cycle
         associate (key => key_table(row))
            table = a%case_node
            if (key%group /= "") table = a%document%child(a%case_node, trim(key%group))
            call a%note_key(trim(key%group), trim(key%key))
            node = 0
            if (table > 0) then
               if (a%document%nodes(table)%kind == toml_kind%table) node = a%document%child(table, trim(key%key))
               if (key%group /= "") call note_place(a, words, k, table)
            end if
            if (node == 0) then
               if (.not. has_previous .and. any(name == ["T ", "N ", "C1"])) missing = missing // ", " // trim(key%key) // " (" // &
                  & trim(key%title) // ")"
               cycle
            end if
            a%used(node) = .true.
            call note_place(a, words, k, node)
            call read_word(a, name, module_number, node, digit, is_known)
            if (is_known) then
               call put_digit(words%digits, name, digit)
               ! nothing else reads the table of a case that ends damping or temperatures
               if (any(name == ["M2", "H "]) .and. digit == 0) a%used(table) = .true.
            else
               is_good = .false.
            end if
         end associate
      end do
      if (len(missing) > 0) then
         call a%add_problem(severity%error, a%case_node, "the first case must give: " // missing(3:))
         is_good = .false.
      end if
   end subroutine read_choices

   !> Index of a digit in digit_names
   subroutine note_place(a, words, k, node)
      type(toml_reader), intent(in) :: a
      type(control_words), intent(inout) :: words
      integer, intent(in) :: k, node

      words%lines(k) = a%document%nodes(node)%line
      words%columns(k) = a%document%nodes(node)%column
   end subroutine note_place

   !> The digit for a word, or for a number that is given instead
   subroutine read_word(a, name, module_number, index, digit, is_known)
      type(toml_reader), intent(inout) :: a
      !> Letter of the digit
      character(len=*), intent(in) :: name
      integer, intent(in) :: module_number
      !> Node of the value
      integer, intent(in) :: index
      integer, intent(out) :: digit
      logical, intent(out) :: is_known
      character(len=word_length) :: accepted(size(digit_table))
      character(len=:), allocatable :: message, list

      digit = -1
      is_known = .false.
      associate (node => a%document%nodes(index))
         if (.not. is_choice(name)) then
            is_known = node%kind == toml_kind%integer .and. node%i >= 0 .and. node%i <= 9
            if (is_known) digit = int(node%i)
            if (.not. is_known) call a%add_problem(severity%error, index, a%document%key_of(index) // &
               & " must be an integer from 0 to 9")
            return
         end if
         accepted = choice_words(name, module_number)
         if (node%kind == toml_kind%string) then
            digit = digit_of_word(name, a%document%text_of(index), module_number)
            is_known = digit >= 0
            if (is_known) return
            call unknown_word(a%document%key_of(index), a%document%text_of(index), accepted, message)
         else
            call words_of(accepted, list)
            message = a%document%key_of(index) // " must be a word in quotes; accepted: " // list
         end if
         call a%add_problem(severity%error, index, message)
      end associate
   end subroutine read_word

   !> Digits that specify which groups a case gives, keeps and renews, and those that are not choices
   subroutine set_group_digits(a, module_number, previous, has_previous, words)
      type(toml_reader), intent(inout) :: a
      integer, intent(in) :: module_number
      type(case_spec), intent(in) :: previous
      logical, intent(in) :: has_previous
      !> Digits, of which those of choices are known
      type(control_words), intent(inout) :: words
      logical :: renew(size(renewable)), has_renew, rolls, rolled, starts_rolling

      call read_renew(a, renew, has_renew)
      call read_plain_keys(a, module_number, words)
      associate (digits => words%digits)
         if (has_previous) then
            if (a%has_group("iteration")) digits%g = or_kept(digits%g, "G", previous%solver)
            if (.not. a%has_group("iteration")) digits%g = 1
            if (a%has_group("friction")) digits%l = or_kept(digits%l, "L", previous%friction_law)
            if (.not. a%has_group("friction")) digits%l = 1
         end if
         if (a%has_group("damping")) then
            if (.not. has_key("damping", "model")) digits%m2 = 2
         else if (has_previous) then
            digits%m2 = 1
         end if
         if (a%has_group("heat")) then
            if (.not. has_key("heat", "model")) digits%h = 3
         else
            digits%h = 0
            if (has_previous .and. previous%has_heat) digits%h = 1
         end if
         if (.not. has_key("", "stresses")) digits%s = merge(1, 0, has_previous .and. previous%has_stress)
         if (a%has_group("stress_output")) digits%s = 2
         if (a%has_group("stress_points")) digits%s = 3
         ! direction, step and velocity are those of the last case with rolling, also behind cases without it
         starts_rolling = module_number == 3 .and. digits%t >= 2 .and. .not. previous%given%rolling
         if (has_renew .and. .not. renew(3)) starts_rolling = .false.
         if (a%has_group("material") .or. a%has_group("influence") .or. a%has_group("rolling") .or. .not. has_previous &
            & .or. starts_rolling) then
            digits%c = or_kept(digits%c, "C", previous%kernel)
         else
            digits%c = merge(1, 0, module_number == 1)
            rolls = digits%t >= 2
            rolled = previous%motion >= motion%transient_rolling
            if (renew(3) .or. (.not. has_renew .and. (a%has_group("grid") .or. (rolls .neqv. rolled)))) digits%c = 1
         end if
      end associate
      if (module_number == 1) then
         call set_wheel_rail_digits(a, previous, has_previous, words)
      else
         call set_contact_digits(a, previous, has_previous, renew, has_renew, words)
      end if

   contains

      !> Does the case give a key of a group, or of the case itself?
      logical function has_key(group, key)
         character(len=*), intent(in) :: group, key
         integer :: table

         has_key = .false.
         table = a%case_node
         if (group /= "") table = a%document%child(a%case_node, group)
         if (table == 0) return
         if (a%document%nodes(table)%kind == toml_kind%table) has_key = a%document%child(table, key) > 0
      end function has_key

      !> The chosen digit, or that of the choice of the previous case if the value is "keep"
      integer function or_kept(digit, name, choice)
         integer, intent(in) :: digit, choice
         character(len=*), intent(in) :: name

         or_kept = digit
         if (digit == 1 .or. (name == "C" .and. digit < 2)) or_kept = max(0, digit_of(name, choice, module_number))
      end function or_kept
   end subroutine set_group_digits

   !> Groups of contact problems of module 3
   subroutine set_contact_digits(a, previous, has_previous, renew, has_renew, words)
      type(toml_reader), intent(in) :: a
      type(case_spec), intent(in) :: previous
      logical, intent(in) :: has_previous
      !> Groups named by the key renew; is the key present?
      logical, intent(in) :: renew(:), has_renew
      type(control_words), intent(inout) :: words
      integer :: table

      associate (digits => words%digits)
         table = a%document%child(a%case_node, "grid")
         digits%d = merge(1, 0, renew(1))
         if (table > 0 .or. .not. has_previous) digits%d = 2
         digits%z = merge(1, 0, renew(2))
         if (a%has_group("geometry")) then
            digits%z = 2
         else if (.not. has_previous .or. (table > 0 .and. brings_geometry() .and. .not. renew(2))) then
            digits%z = 2
         else if (.not. has_renew .and. digits%d > 0) then
            digits%z = 1
         end if
         if (has_previous .and. .not. has_renew) then
            if (digits%d == 0 .and. digits%z == 0 .and. digits%p == 2 .and. digits%i == 0 &
               & .and. previous%grid%brings_geometry() .and. changes_load()) then
               ! semi-axes or curvatures are kept, and the grid around them follows load and materials
               digits%d = 1
               digits%z = 1
               digits%c = max(1, digits%c)
            end if
         end if
         if (a%has_group("extra_slip")) then
            digits%e = 9
         else if (a%document%child(a%case_node, "slip_source") == 0) then
            digits%e = 0
            if (has_previous .and. previous%slip_source /= slip_source%none) digits%e = 1
         end if
      end associate

   contains

      !> Does the case give a load, an approach or elastic constants?
      logical function changes_load()
         changes_load = a%document%child(a%case_node, "normal") > 0 &
            & .or. gives("kinematics", [character(len=6) :: "fn", "pen"]) &
            & .or. gives("material", [character(len=6) :: "gg", "gg1", "gg2", "poiss", "poiss1", "poiss2"])
      end function changes_load

      !> Does the case give one of the keys of a group?
      logical function gives(group, keys)
         character(len=*), intent(in) :: group, keys(:)
         integer :: k, node

         gives = .false.
         node = a%document%child(a%case_node, group)
         if (node == 0) return
         if (a%document%nodes(node)%kind /= toml_kind%table) return
         do k = 1, size(keys)
            gives = gives .or. a%document%child(node, trim(keys(k))) > 0
         end do
      end function gives

      !> Does the grid bring its own geometry? False without a grid: Fortran may evaluate both sides of `.and.`
      logical function brings_geometry()
         type(grid_spec) :: grid
         logical :: is_form
         integer :: form

         brings_geometry = .false.
         if (table == 0) return
         grid%form = previous%grid%form
         form = 0
         if (a%document%nodes(table)%kind == toml_kind%table) form = a%document%child(table, "form")
         if (form > 0) call form_value("IPOTCN", a%document%text_of(form), grid%form, is_form)
         brings_geometry = grid%brings_geometry()
      end function brings_geometry
   end subroutine set_contact_digits

   !> Groups of wheel and rail: each digit represents several
   subroutine set_wheel_rail_digits(a, previous, has_previous, words)
      type(toml_reader), intent(in) :: a
      type(case_spec), intent(in) :: previous
      logical, intent(in) :: has_previous
      type(control_words), intent(inout) :: words
      logical :: has_flexibility

      associate (digits => words%digits)
         if (.not. a%has_group("search") .and. has_previous) then
            digits%d = 1
         else if (digits%d < 2 .and. has_previous) then
            digits%d = digit_of("D", previous%wheel_rail%search%location, 1)
         end if
         digits%z = 0
         if (a%has_group("track")) digits%z = 1
         if (a%has_group("deviations") .or. a%has_group("springs")) digits%z = merge(3, 2, a%has_group("track"))
         if (a%has_group("rail_profile") .or. .not. has_previous) digits%z = 3
         has_flexibility = a%has_group("flexibility")
         digits%e = 0
         if (a%has_group("position")) digits%e = 1
         if (a%has_group("velocity")) digits%e = 2
         if (has_flexibility) digits%e = 4
         if (a%has_group("wheel_dimensions") .or. a%has_group("wheel_profile") .or. .not. has_previous) &
            & digits%e = merge(5, 3, has_flexibility)
      end associate
   end subroutine set_wheel_rail_digits

   !> The groups named by `renew`
   subroutine read_renew(a, renew, has_renew)
      type(toml_reader), intent(inout) :: a
      logical, intent(out) :: renew(size(renewable)), has_renew
      integer :: k, node, place

      renew = .false.
      node = a%document%child(a%case_node, "renew")
      call a%note_key("", "renew")
      has_renew = node > 0
      if (.not. has_renew) return
      a%used(node) = .true.
      if (a%document%nodes(node)%kind /= toml_kind%array) call a%add_problem(severity%error, node, &
         & 'renew must be an array of names of groups, such as ["geometry"]')
      k = a%document%nodes(node)%first
      do while (k > 0 .and. a%document%nodes(node)%kind == toml_kind%array)
         do place = 1, size(renewable)
            if (a%document%text_of(k) == renewable(place)) exit
         end do
         if (place <= size(renewable)) then
            renew(place) = .true.
         else
            call a%add_problem(severity%error, k, "only grid, geometry and material can be renewed")
         end if
         k = a%document%nodes(k)%next
      end do
   end subroutine read_renew

   !> Wear and fatigue are requested by a table of their numbers, until a case ends them
   subroutine read_wear(a, spec)
      type(toml_reader), intent(inout) :: a
      type(case_spec), intent(inout) :: spec
      integer :: node, table

      if (a%has_group("wear")) spec%has_wear = .true.
      table = a%document%child(a%case_node, "wear")
      if (table == 0) return
      if (a%document%nodes(table)%kind /= toml_kind%table) return
      call a%note_key("wear", "model")
      node = a%document%child(table, "model")
      if (node == 0) return
      a%used(node) = .true.
      if (a%document%nodes(node)%kind /= toml_kind%string .or. all(a%document%text_of(node) /= ["archard", "none   "])) then
         call a%add_problem(severity%error, node, 'model must be "archard" or "none"')
      else
         spec%has_wear = a%document%text_of(node) == "archard"
         ! nothing else reads the table of a case that ends them
         a%used(table) = .true.
      end if
   end subroutine read_wear

   !> Keys `solve` and `gap_weight`, and the names of the case for users
   subroutine read_plain_keys(a, module_number, words)
      type(toml_reader), intent(inout) :: a
      integer, intent(in) :: module_number
      type(control_words), intent(inout) :: words
      integer :: k, node

      words%digits%r = 0
      do k = 1, size(plain_keys)
         call a%note_key("", trim(plain_keys(k)))
         node = a%document%child(a%case_node, trim(plain_keys(k)))
         if (node == 0) cycle
         a%used(node) = plain_keys(k) /= "gap_weight" .or. module_number == 1
         associate (value => a%document%nodes(node))
            select case (plain_keys(k))
            case ("solve")
               if (value%kind /= toml_kind%logical) call a%add_problem(severity%error, node, "solve must be true or false")
               words%digits%r = merge(0, 2, value%l .or. value%kind /= toml_kind%logical)
            case ("gap_weight")
               if (value%kind /= toml_kind%integer .or. value%i < 0 .or. value%i > 2) then
                  call a%add_problem(severity%error, node, "gap_weight must be 0, 1 or 2")
               else
                  words%digits%gapwgt = int(value%i)
               end if
            case ("title")
               if (value%kind /= toml_kind%string) call a%add_problem(severity%error, node, "title must be a text in quotes")
            end select
         end associate
      end do
   end subroutine read_plain_keys
end module contact_input_toml_case
