!> The rules of contact_cases_rules, expressed in digits
module contact_control_rule_text
   use contact_cases_rules, only : choice_kind, choice_rule, value_of
   use contact_cases_spec, only : case_spec
   use contact_control_digits, only : case_digits, choice_of, digit_of, is_known
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: describe_broken_rule, allowed_digits, letter_of

contains

   !> Letter of the digit of a choice, or name of the number that represents it
   pure character(len=6) function letter_of(choice)
      !> Member of choice_kind
      integer, intent(in) :: choice

      select case (choice)
      case (choice_kind%pressure); letter_of = "B"
      case (choice_kind%motion); letter_of = "T"
      case (choice_kind%normal); letter_of = "N"
      case (choice_kind%force); letter_of = "F"
      case (choice_kind%friction_law); letter_of = "L"
      case (choice_kind%kernel); letter_of = "C"
      case (choice_kind%material_model); letter_of = "M"
      case (choice_kind%slip_source); letter_of = "E"
      case (choice_kind%heat); letter_of = "H"
      case (choice_kind%grid_form); letter_of = "IPOTCN"
      case default; letter_of = "?"
      end select
   end function letter_of

   !> "M = 1, viscoelastic material, needs steady rolling, T = 3, not T = 2: ..."
   subroutine describe_broken_rule(rule, spec, digits, text)
      !> The violated rule
      type(choice_rule), intent(in) :: rule
      !> The case that violates it
      type(case_spec), intent(in) :: spec
      !> Control digits of the case, for the names of the choices
      type(case_digits), intent(in) :: digits
      !> What is wrong, why, and what is accepted
      character(len=:), allocatable, intent(out) :: text
      character(len=:), allocatable :: found
      integer :: module_number

      module_number = merge(1, 3, allocated(spec%wheel_rail))
      found = trim(letter_of(rule%other)) // " = " // integer_text(digit_in(rule%other))
      text = trim(letter_of(rule%choice)) // " = " // integer_text(digit_in(rule%choice)) // ", " // trim(rule%subject) // ", " // &
         & trim(rule%claim) // ", "
      if (rule%claim(:6) == "cannot") then
         text = text // found
      else
         text = text // trim(letter_of(rule%other)) // " = " // trim(allowed_digits(rule%other, rule%allowed, module_number)) // &
            & ", not " // found
      end if
      text = text // ": " // trim(rule%reason)

   contains

      !> Digit of a choice of the case
      integer function digit_in(choice)
         integer, intent(in) :: choice

         select case (choice)
         case (choice_kind%heat); digit_in = digits%h
         case (choice_kind%grid_form); digit_in = value_of(spec, choice)
         case default; digit_in = digit_of(trim(letter_of(choice)), value_of(spec, choice), module_number)
         end select
      end function digit_in
   end subroutine describe_broken_rule

   !> Digits of values of a choice, "0, 1 or 3"
   pure function allowed_digits(choice, values, module_number) result(text)
      !> Member of choice_kind
      integer, intent(in) :: choice
      !> Values of the choice; values without a digit are skipped
      integer, intent(in) :: values(:)
      integer, intent(in) :: module_number
      character(len=28) :: text
      integer :: digit, left, k
      logical :: named(-9:9)

      do digit = -9, 9
         if (choice == choice_kind%grid_form) then
            named(digit) = any(values == digit)
         else
            named(digit) = is_known(trim(letter_of(choice)), digit, module_number) .and. &
               & any(values == choice_of(trim(letter_of(choice)), digit, module_number))
         end if
      end do
      text = ""
      left = count(named)
      do k = -9, 9
         if (.not. named(k)) cycle
         left = left - 1
         text = trim(text) // " " // integer_text(k)
         if (left > 1) text = trim(text) // ","
         if (left == 1) text = trim(text) // " or"
      end do
      text = adjustl(text)
   end function allowed_digits
end module contact_control_rule_text
