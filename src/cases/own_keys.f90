!> Choices and numbers of a case that exist in the readable format only, listed once for all formats
!>
!> As in contact_cases_inputs. The program sets them by options of the command line for input files, callers of the library by
!> flags.
module contact_cases_own_keys
   use contact_base_choices, only : heat_source
   use contact_cases_accuracy_plan, only : largest_accuracy, smallest_accuracy
   use contact_cases_approximate_methods, only : allowances
   use contact_cases_archive, only : case_archive
   use contact_cases_spec, only : case_spec, heat_spec, iteration_spec
   implicit none (type, external)
   private

   public :: visit_own_case, visit_own_heat, visit_own_iteration

contains

   !> Keys of the case itself
   subroutine visit_own_case(a, spec)
      class(case_archive), intent(inout) :: a
      type(case_spec), intent(inout) :: spec

      call visit_flag(a, "errors", "are errors of the totals estimated?", [character(len=5) :: "true", "false"], &
         & spec%estimates_errors)
   end subroutine visit_own_case

   !> Keys of the group "iteration"
   subroutine visit_own_iteration(a, iteration)
      class(case_archive), intent(inout) :: a
      type(iteration_spec), intent(inout) :: iteration

      call a%own_choice("order", "order of the discretisation of rolling", ["1", "2"], iteration%order, usual=2)
      call a%own_number("accuracy", "largest relative error of the forces", iteration%accuracy, smallest_accuracy, &
         & largest_accuracy)
      call visit_flag(a, "allow", "what may replace the full theory", allowances(2:1:-1), iteration%allows_approximate)
   end subroutine visit_own_iteration

   !> Keys of the group "heat"
   subroutine visit_own_heat(a, heat)
      class(case_archive), intent(inout) :: a
      type(heat_spec), intent(inout) :: heat
      integer :: chosen

      chosen = merge(1, 2, heat%source == heat_source%moving)
      call a%own_choice("source", "how the heat of an element acts on itself", [character(len=11) :: "moving", "established"], &
         & chosen, usual=1)
      heat%source = merge(heat_source%moving, heat_source%established, chosen == 1)
   end subroutine visit_own_heat

   !> A flag, usually not set
   subroutine visit_flag(a, name, title, words, value)
      class(case_archive), intent(inout) :: a
      !> Key and meaning; the words for yes and no
      character(len=*), intent(in) :: name, title, words(2)
      logical, intent(inout) :: value
      integer :: chosen

      chosen = merge(1, 2, value)
      call a%own_choice(name, title, words, chosen, usual=2, none=2)
      value = chosen == 1
   end subroutine visit_flag
end module contact_cases_own_keys
