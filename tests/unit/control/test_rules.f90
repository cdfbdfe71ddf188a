!> The rules between choices: each can be violated, is reported, and is listed in the manual
program test_rules
   use contact_cases_rules, only : choice_rule, choice_rules, demand_text, describe_number, is_broken, is_missed, number_rule, &
      & number_rules, refuse_broken_rules, value_of
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_base_error, only : error_type
   use contact_control_digits, only : case_digits
   use contact_control_digit_terms, only : translate_to_digits
   use contact_control_rule_text, only : allowed_digits, describe_broken_rule, letter_of
   use contact_control_translation, only : apply_digits, digits_of
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite
   integer :: i

   call suite%start("rules of choices")
   call break_all(suite)
   call numbers(suite)
   call terms(suite)
   call manual(suite, "## Compatible choices", [(row_of_choice(i), i = 1, size(choice_rules))])
   call manual(suite, "### Numbers required by choices", [(row_of_number(i), i = 1, size(number_rules))])
   call suite%finish()

contains

   !> Cases with all values of the digits of the rules: violations are reported with both digits, and each rule occurs
   subroutine break_all(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: kernels(4) = [2, 3, 4, 9], laws(5) = [0, 2, 3, 4, 6], slips(4) = [0, 2, 3, 9]
      integer, parameter :: heats(3) = [0, 1, 3], forms(11) = [0, 1, 2, 3, 4, -1, -2, -3, -4, -5, -6]
      logical :: met(size(choice_rules))
      type(case_digits) :: digits, again
      type(case_spec) :: fresh, spec
      type(error_type), allocatable :: error
      integer :: b, c, e, f, h, k, l, m, module_number, n, t, broken, wrong

      met = .false.
      wrong = 0
      do module_number = 1, 3, 2
         do m = 0, 7
            do t = 0, 3
               do c = 1, size(kernels)
                  do l = 1, size(laws)
                     do h = 1, size(heats)
                        do e = 1, merge(1, size(slips), module_number == 1)
                           do k = 0, 7
                              f = mod(k, 4)
                              if (f == merge(2, 3, module_number == 1)) cycle
                              n = k/4
                              b = mod(m + t + c + l, 7)
                              if (module_number == 1 .and. b >= 2 .and. b <= 4) b = 0
                              digits = case_digits(b=b, t=t, n=n, f=f, l=laws(l), d=2, c=kernels(c), m=m, z=2, e=slips(e), &
                                 & h=heats(h), r=1)
                              spec = fresh
                              call apply_digits(digits, module_number, spec)
                              ! no form before the first one, or if the grid is that of a wheel
                              spec%grid%form = merge(0, forms(mod(t + l + 3*h + m, size(forms)) + 1), module_number == 1)
                              call refuse_broken_rules(spec, error)
                              call count_broken(spec, digits, broken, met, wrong)
                              if (allocated(error) .neqv. broken > 0) wrong = wrong + 1
                              again = digits_of(spec)
                              if (any([again%b, again%t, again%n, again%f, again%l, again%c, again%m] /= &
                                 & [b, t, n, f, laws(l), kernels(c), m])) wrong = wrong + 1
                           end do
                        end do
                     end do
                  end do
               end do
            end do
         end do
      end do
      call suite%equal(wrong, 0, "rules that are not reported, or digits that are not recovered")
      do k = 1, size(choice_rules)
         call suite%check(met(k), "a case breaks the rule: " // trim(choice_rules(k)%subject) // " " // trim(choice_rules(k)%claim))
      end do

   end subroutine break_all

   !> The rules that a case breaks, each with a text that names both digits
   subroutine count_broken(spec, digits, broken, met, wrong)
      type(case_spec), intent(in) :: spec
      type(case_digits), intent(in) :: digits
      integer, intent(out) :: broken
      logical, intent(inout) :: met(:)
      !> Texts that are not as they should be
      integer, intent(inout) :: wrong
      type(choice_rule) :: rule
      character(len=:), allocatable :: text
      integer :: i

      broken = 0
      do i = 1, size(choice_rules)
         rule = choice_rules(i)
         if (.not. is_broken(rule, spec)) cycle
         if (.not. rule%only_warns) broken = broken + 1
         met(i) = .true.
         call describe_broken_rule(rule, spec, digits, text)
         if (index(text, trim(letter_of(rule%choice)) // " = ") /= 1) wrong = wrong + 1
         if (index(text, ", " // trim(letter_of(rule%other)) // " = ") == 0) wrong = wrong + 1
         if (index(text, "-1") > 0 .and. index(text, "IPOTCN") == 0) wrong = wrong + 1
         if (all(rule%values /= value_of(spec, rule%choice))) wrong = wrong + 1
      end do
   end subroutine count_broken

   !> A case for each rule about a number, which breaks it, and does not with another number
   subroutine numbers(suite)
      type(test_suite), intent(inout) :: suite
      character(len=:), allocatable :: text
      type(error_type), allocatable :: error
      type(case_spec) :: bad, good
      integer :: k

      do k = 1, size(number_rules)
         call example(trim(number_rules(k)%number), bad, good)
         call suite%check(is_missed(number_rules(k), bad), "missed: " // trim(number_rules(k)%number))
         call suite%check(.not. is_missed(number_rules(k), good), "kept: " // trim(number_rules(k)%number))
         call refuse_broken_rules(good, error)
         call suite%check(.not. allocated(error), "not refused: " // trim(number_rules(k)%number))
         call refuse_broken_rules(bad, error)
         call describe_number(number_rules(k), bad, text)
         call suite%check(allocated(error), "refused: " // text)
         if (.not. allocated(error)) cycle
         call suite%check(error%message == text, "the same words for all: " // error%message)
         call suite%check(index(text, " must be " // trim(demand_text(number_rules(k)%demand))) > 0, text)
      end do
   end subroutine numbers

   !> A case with a wrong number, and the same with a right one
   subroutine example(name, bad, good)
      character(len=*), intent(in) :: name
      type(case_spec), intent(out) :: bad, good

      bad%motion = 3
      select case (name)
      case ("PEN")
         bad%grid%form = -3
         bad%kinematics%pen = -0.1_wp
         good = bad
         good%kinematics%pen = 0.0_wp
      case ("KZRAIL")
         allocate(bad%wheel_rail)
         bad%force = 3
         bad%wheel_rail%rail%kz = 0.0_wp
         good = bad
         good%wheel_rail%rail%kz = 10.0_wp
      case ("CHI")
         bad%kernel = 4
         bad%rolling%chi = 0.1_wp
         good = bad
         good%motion = 1
      case ("BETAMF")
         bad%motion = 1
         bad%material_model = 3
         bad%material%alfamf = 0.5_wp
         bad%material%betamf = 0.2_wp
         good = bad
         good%material%alfamf = 1.0_wp
      case ("TAU_C0")
         bad%friction_law = 6
         bad%has_heat = .true.
         bad%material_model = 4
         bad%material%tau_c0 = 100.0_wp
         good = bad
         good%material%tau_c0 = 0.0_wp
      end select
   end subroutine example

   !> Choices in messages are converted to digits; other text is unchanged
   subroutine terms(suite)
      type(test_suite), intent(inout) :: suite

      call expect(suite, 'motion = "none"', "T = 0")
      call expect(suite, 'a shift, motion = "shift"; more', "a shift, T = 1; more")
      call expect(suite, '(material.influence = "conformal" or "tabulated")', "(C = 4 or 9)")
      call expect(suite, 'iteration.solver = "convex_gs", "gauss_seidel" or "gd_steady".', "G = 2, 3 or 5.")
      call expect(suite, 'sequence = "initiate" with estimate = "fresh"', "P = 2 with I = 0")
      call expect(suite, 'tangential = "massless_rail" and normal = "approach"', "F = 3 and N = 0")
      call expect(suite, 'tangential = "fx_and_ceta" or "nothing"', 'F = 1 or "nothing"')
      call expect(suite, 'solver = "convex_gs"', 'solver = "convex_gs"')
      call expect(suite, 'motion = "rest", RFNAME = "a.prr" and "b', 'motion = "rest", RFNAME = "a.prr" and "b')
      call expect(suite, 'motion = "', 'motion = "')
      call expect(suite, "", "")
   end subroutine terms

   subroutine expect(suite, message, expected)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: message, expected
      character(len=:), allocatable :: text

      call translate_to_digits(message, text)
      call suite%check(text == expected .and. len(text) == len(expected), "'" // text // "' is '" // expected // "'")
   end subroutine expect

   !> The manual has a row for each rule, and no other rows
   subroutine manual(suite, title, rules)
      type(test_suite), intent(inout) :: suite
      !> Of the section with the table
      character(len=*), intent(in) :: title
      !> The rules as rows of the manual
      character(len=300), intent(in) :: rules(:)
      logical :: seen(size(rules))
      character(len=300) :: folder, line
      integer :: k, status, unit, rows

      seen = .false.
      rows = 0
      call get_environment_variable("CONTACT_SOURCE", folder, status=status)
      if (status /= 0) folder = "."
      open(newunit=unit, file=trim(folder) // "/doc/user/input.md", status="old", action="read", iostat=status)
      call suite%check(status == 0, "doc/user/input.md is there")
      if (status /= 0) return
      do
         read(unit, "(a)", iostat=status) line
         if (status /= 0 .or. line == title) exit
      end do
      do
         read(unit, "(a)", iostat=status) line
         if (status /= 0 .or. line(:2) == "##") exit
         if (line(:2) == "| " .and. line(:8) /= "| digit " .and. line(:9) /= "| number ") rows = rows + 1
         where (line == rules) seen = .true.
      end do
      close(unit)
      do k = 1, size(rules)
         call suite%check(seen(k), "the manual has the row: " // trim(rules(k)))
      end do
      call suite%equal(rows, size(rules), "rows of the manual")
   end subroutine manual

   !> A rule of choices as a row of the manual
   function row_of_choice(k) result(row)
      integer, intent(in) :: k
      character(len=300) :: row
      character(len=16), parameter :: where(0:3) = [character(len=16) :: "", " (wheel on rail)", "", " (module 3)"]
      type(choice_rule) :: rule
      integer :: module_number

      rule = choice_rules(k)
      module_number = merge(1, 3, rule%module_number == 1)
      row = "| " // trim(letter_of(rule%choice)) // " = " // trim(allowed_digits(rule%choice, rule%values, module_number)) // &
         & trim(where(rule%module_number)) // " | " // trim(rule%subject) // " " // trim(rule%claim) // " | " // &
         & trim(letter_of(rule%other)) // " = " // trim(allowed_digits(rule%other, rule%allowed, module_number)) // " | " // &
         & trim(rule%reason) // " |"
   end function row_of_choice

   !> A rule about a number as a row of the manual
   function row_of_number(k) result(row)
      integer, intent(in) :: k
      character(len=300) :: row
      character(len=:), allocatable :: subject
      type(number_rule) :: rule

      rule = number_rules(k)
      call translate_to_digits(trim(rule%subject), subject)
      row = "| " // trim(rule%number) // " | " // trim(demand_text(rule%demand)) // " | " // subject // " | " // &
         & trim(rule%reason) // " |"
   end function row_of_number
end program test_rules
