!> Factory of compliances
module contact_elastic_new_compliance
   use contact_elastic_compliance, only : compliance
   use contact_elastic_conformal, only : conformal_operator
   use contact_elastic_model, only : elastic_model
   use contact_elastic_operator, only : elastic_operator
   use contact_elastic_one_sided, only : one_sided_operator
   use contact_elastic_tabulated, only : tabulated_operator
   implicit none (type, external)
   private

   public :: new_compliance

   !> Kinds of operators
   integer, parameter :: homogeneous = 1, curved = 2, viscoelastic = 3, from_table = 4

contains

   !> Create the operator required by a model; an existing one of the same kind is kept
   subroutine new_compliance(model, operator)
      !> Elastic model, which determines the kind
      type(elastic_model), intent(in) :: model
      !> Unallocated or of any kind; a new one is not yet prepared for a window
      class(compliance), allocatable, intent(inout) :: operator
      integer :: kind_

      kind_ = kind_needed(model)
      if (allocated(operator)) then
         if (kind_of(operator) == kind_) return
         call operator%release()
         deallocate(operator)
      end if
      select case (kind_)
      case (viscoelastic)
         allocate(one_sided_operator :: operator)
      case (from_table)
         allocate(tabulated_operator :: operator)
      case (curved)
         allocate(conformal_operator :: operator)
      case default
         allocate(elastic_operator :: operator)
      end select
   end subroutine new_compliance

   pure integer function kind_needed(model)
      type(elastic_model), intent(in) :: model

      kind_needed = homogeneous
      if (allocated(model%memory)) then
         kind_needed = viscoelastic
      else if (allocated(model%tabulated)) then
         kind_needed = from_table
      else if (allocated(model%inclination) .and. .not. model%rotates_by_offset()) then
         kind_needed = curved
      end if
   end function kind_needed

   pure integer function kind_of(operator)
      class(compliance), intent(in) :: operator

      kind_of = homogeneous
      select type (operator)
      type is (one_sided_operator)
         kind_of = viscoelastic
      type is (tabulated_operator)
         kind_of = from_table
      type is (conformal_operator)
         kind_of = curved
      end select
   end function kind_of
end module contact_elastic_new_compliance
