!> The compliance that suits an elastic model
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

contains

   !> Make an operator of the kind that a model needs; one that is of this kind already is kept
   subroutine new_compliance(model, operator)
      type(elastic_model), intent(in) :: model
      class(compliance), allocatable, intent(inout) :: operator
      class(compliance), allocatable :: wanted

      call make_kind(model, wanted)
      if (allocated(operator)) then
         if (same_type_as(operator, wanted)) return
         call operator%release()
         deallocate(operator)
      end if
      call move_alloc(wanted, operator)
   end subroutine new_compliance

   !> An empty operator
   subroutine make_kind(model, operator)
      type(elastic_model), intent(in) :: model
      class(compliance), allocatable, intent(out) :: operator

      if (allocated(model%memory)) then
         allocate(one_sided_operator :: operator)
      else if (allocated(model%tabulated)) then
         allocate(tabulated_operator :: operator)
      else if (allocated(model%inclination) .and. .not. model%rotates_by_offset()) then
         allocate(conformal_operator :: operator)
      else
         allocate(elastic_operator :: operator)
      end if
   end subroutine make_kind
end module contact_elastic_new_compliance
