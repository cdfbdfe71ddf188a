!> Sessions and results of one problem, kept between its cases; allocated and freed in this module only
!>
!> They are pointers for three reasons: the long code that frees such a tree is compiled once, in this module, and not in every
!> procedure that holds one; a slot can be moved in a table; and they are never copied.
module contact_cases_slot
   use contact_cases_wheel_rail_session, only : wheel_rail_session, release_wheel_rail_session
   use contact_cases_session, only : contact_session, release_session
   use contact_patch_result, only : patch_result
   use contact_wheelrail_result, only : wheel_rail_result
   implicit none (type, external)
   private

   public :: open_contact, open_wheel_rail, problem_slot, release_slot

   !> One problem; null: not opened for the module
   type :: problem_slot
      !> Session of a contact problem (module 3)
      type(contact_session), pointer :: session => null()
      type(patch_result), pointer :: result => null()
      !> Session of wheel on rail (module 1)
      type(wheel_rail_session), pointer :: wheel_rail => null()
      type(wheel_rail_result), pointer :: wheel_rail_result => null()
   end type problem_slot

contains

   !> Open for contact problems; no effect if it is open
   subroutine open_contact(slot)
      type(problem_slot), intent(inout) :: slot
      if (.not. associated(slot%session)) allocate(slot%session, slot%result)
   end subroutine open_contact

   !> Open for wheel on rail; no effect if it is open
   subroutine open_wheel_rail(slot)
      type(problem_slot), intent(inout) :: slot
      if (.not. associated(slot%wheel_rail)) allocate(slot%wheel_rail, slot%wheel_rail_result)
   end subroutine open_wheel_rail

   !> Free everything that was opened
   subroutine release_slot(slot)
      type(problem_slot), intent(inout) :: slot

      if (associated(slot%session)) then
         call release_session(slot%session)
         deallocate(slot%session, slot%result)
      end if
      if (associated(slot%wheel_rail)) then
         call release_wheel_rail_session(slot%wheel_rail)
         deallocate(slot%wheel_rail, slot%wheel_rail_result)
      end if
   end subroutine release_slot
end module contact_cases_slot
