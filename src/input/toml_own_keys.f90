!> Keys of a case that belong to no number of the input files: order, errors, accuracy, permission, source of heat, wear
module contact_input_toml_own_keys
   use contact_base_choices, only : heat_source
   use contact_cases_accuracy_plan, only : is_accuracy
   use contact_cases_approximate_methods, only : allowances
   use contact_cases_spec, only : case_spec
   use contact_control_words, only : usual_order
   use contact_input_problems, only : severity
   use contact_input_toml_reader, only : toml_reader
   use contact_toml_document, only : toml_kind
   implicit none (type, external)
   private

   public :: take_accuracy, take_errors, take_heat_source, take_order, take_permission, take_wear

contains

   !> A key of a group that belongs to no number of the input files
   subroutine find_key(a, group, key, node)
      type(toml_reader), intent(inout) :: a
      !> Name of the table, and the key in it
      character(len=*), intent(in) :: group, key
      !> Of the value; 0 where there is none
      integer, intent(out) :: node

      node = a%document%child(a%case_node, group)
      if (node == 0) return
      if (a%document%nodes(node)%kind /= toml_kind%table) then
         node = 0
         return
      end if
      call a%note_key(group, key)
      node = a%document%child(node, key)
      if (node > 0) a%used(node) = .true.
   end subroutine find_key

   !> Order of the discretisation of rolling, kept from case to case
   subroutine take_order(a, has_previous, spec)
      !> Document and its case in hand
      type(toml_reader), intent(inout) :: a
      !> Is there a case before this one?
      logical, intent(in) :: has_previous
      type(case_spec), intent(inout) :: spec
      integer :: node

      if (.not. has_previous) spec%iteration%order = usual_order
      call find_key(a, "iteration", "order", node)
      if (node == 0) return
      associate (value => a%document%nodes(node))
         if (value%kind == toml_kind%integer .and. any(value%i == [1, 2])) then
            spec%iteration%order = int(value%i)
         else
            call a%add_problem(severity%error, node, "order must be 1 or 2")
         end if
      end associate
   end subroutine take_order

   !> Are errors of the totals estimated? Kept from case to case
   subroutine take_errors(a, spec)
      !> Document and its case in hand
      type(toml_reader), intent(inout) :: a
      type(case_spec), intent(inout) :: spec
      integer :: node

      node = a%document%child(a%case_node, "errors")
      if (node == 0) return
      associate (value => a%document%nodes(node))
         if (value%kind == toml_kind%logical) then
            spec%estimates_errors = value%l
         else
            call a%add_problem(severity%error, node, "errors must be true or false")
         end if
      end associate
   end subroutine take_errors

   !> Are wear and fatigue asked for? By a table of them, as long as no case ends them
   subroutine take_wear(a, spec)
      !> Document and its case in hand
      type(toml_reader), intent(inout) :: a
      type(case_spec), intent(inout) :: spec
      integer :: node

      if (a%has_group("wear")) spec%has_wear = .true.
      call find_key(a, "wear", "model", node)
      if (node == 0) return
      if (a%document%nodes(node)%kind /= toml_kind%string .or. all(a%document%text_of(node) /= ["archard", "none   "])) then
         call a%add_problem(severity%error, node, 'model must be "archard" or "none"')
      else
         spec%has_wear = a%document%text_of(node) == "archard"
         ! the table of a case that ends them is visited by nobody
         a%used(a%document%child(a%case_node, "wear")) = .true.
      end if
   end subroutine take_wear

   !> The accuracy that is asked for, 0 for none; kept from case to case
   subroutine take_accuracy(a, spec)
      !> Document and its case in hand
      type(toml_reader), intent(inout) :: a
      type(case_spec), intent(inout) :: spec
      integer :: node

      call find_key(a, "iteration", "accuracy", node)
      if (node == 0) return
      associate (value => a%document%nodes(node))
         if ((value%kind == toml_kind%real .or. value%kind == toml_kind%integer) .and. is_accuracy(value%r)) then
            spec%iteration%accuracy = value%r
         else
            call a%add_problem(severity%error, node, "accuracy must be a number from 1e-6 to 0.1, or 0 for none")
         end if
      end associate
   end subroutine take_accuracy

   !> May simplified methods be chosen for an accuracy? Kept from case to case
   subroutine take_permission(a, spec)
      !> Document and its case in hand
      type(toml_reader), intent(inout) :: a
      type(case_spec), intent(inout) :: spec
      integer :: node

      call find_key(a, "iteration", "allow", node)
      if (node == 0) return
      if (a%document%nodes(node)%kind == toml_kind%string .and. any(a%document%text_of(node) == allowances)) then
         spec%iteration%allows_approximate = a%document%text_of(node) == allowances(2)
      else
         call a%add_problem(severity%error, node, 'allow must be "approximate" or "nothing"')
      end if
   end subroutine take_permission

   !> How temperatures are computed: with moving sources, unless a case asks for those of the established program
   subroutine take_heat_source(a, spec)
      !> Document and its case in hand
      type(toml_reader), intent(inout) :: a
      type(case_spec), intent(inout) :: spec
      integer :: node, table

      table = a%document%child(a%case_node, "heat")
      if (table == 0) return
      if (a%document%nodes(table)%kind /= toml_kind%table) return
      call a%note_key("heat", "source")
      node = a%document%child(table, "source")
      if (node > 0) then
         call a%memory%remember("heat.source", node)
         a%used(node) = .true.
      else
         node = a%memory%recall("heat.source")
      end if
      spec%heat%source = heat_source%moving
      if (node == 0) return
      if (a%document%text_of(node) == "established" .and. a%document%nodes(node)%kind == toml_kind%string) then
         spec%heat%source = heat_source%established
      else if (a%document%text_of(node) /= "moving" .or. a%document%nodes(node)%kind /= toml_kind%string) then
         call a%add_problem(severity%error, node, 'source must be "moving" or "established"')
      end if
   end subroutine take_heat_source
end module contact_input_toml_own_keys
