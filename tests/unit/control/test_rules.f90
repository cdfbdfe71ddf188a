!> The rules of choices that go together: each can be broken and told, and stands in the manual
program test_rules
   use contact_cases_rules, only : choice_rule, choice_rules, is_broken, refuse_broken_rules, value_of
   use contact_cases_spec, only : case_spec
   use contact_base_error, only : error_type
   use contact_control_digits, only : case_digits
   use contact_control_rule_text, only : allowed_digits, describe_broken_rule, letter_of
   use contact_control_translation, only : digits_of, take_digits
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("rules of choices")
   call break_all(suite)
   call manual(suite)
   call suite%finish()

contains

   !> Cases with all values of the digits that rules know: whatever breaks a rule is told with both digits, and each rule is met
   subroutine break_all(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: kernels(4) = [2, 3, 4, 9], laws(5) = [0, 2, 3, 4, 6], slips(4) = [0, 2, 3, 9]
      integer, parameter :: heats(3) = [0, 1, 3]
      logical :: met(size(choice_rules))
      type(case_digits) :: digits, again
      type(case_spec) :: spec
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
                              spec = case_spec()
                              call take_digits(digits, module_number, spec)
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
      call suite%equal(wrong, 0, "rules that are not told, or digits that do not come back")
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
         broken = broken + 1
         met(i) = .true.
         call describe_broken_rule(rule, spec, digits, text)
         if (index(text, letter_of(rule%choice) // " = ") /= 1) wrong = wrong + 1
         if (index(text, ", " // letter_of(rule%other) // " = ") == 0 .or. index(text, "-1") > 0) wrong = wrong + 1
         if (all(rule%values /= value_of(spec, rule%choice))) wrong = wrong + 1
      end do
   end subroutine count_broken

   !> The manual has a row for each rule, and no other rows
   subroutine manual(suite)
      type(test_suite), intent(inout) :: suite
      logical :: seen(size(choice_rules))
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
         if (status /= 0 .or. line == "## Choices that go together") exit
      end do
      do
         read(unit, "(a)", iostat=status) line
         if (status /= 0 .or. line(:3) == "## ") exit
         if (line(:2) == "| " .and. index(line, " = ") > 0) rows = rows + 1
         do k = 1, size(choice_rules)
            if (line == row_of(choice_rules(k))) seen(k) = .true.
         end do
      end do
      close(unit)
      do k = 1, size(choice_rules)
         call suite%check(seen(k), "the manual has the row: " // trim(row_of(choice_rules(k))))
      end do
      call suite%equal(rows, size(choice_rules), "rows of the manual")
   end subroutine manual

   !> A rule as a row of the manual
   function row_of(rule) result(row)
      type(choice_rule), intent(in) :: rule
      character(len=300) :: row
      character(len=16), parameter :: where(0:3) = [character(len=16) :: "", " (wheel on rail)", "", " (module 3)"]
      integer :: module_number

      module_number = merge(1, 3, rule%module_number == 1)
      row = "| " // letter_of(rule%choice) // " = " // trim(allowed_digits(rule%choice, rule%values, module_number)) // &
         & trim(where(rule%module_number)) // " | " // trim(rule%subject) // " " // trim(rule%claim) // " | " // &
         & letter_of(rule%other) // " = " // trim(allowed_digits(rule%other, rule%allowed, module_number)) // " | " // &
         & trim(rule%reason) // " |"
   end function row_of
end program test_rules
