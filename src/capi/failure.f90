!> Recovery after a call that was abandoned for lack of memory; see door.c and base/guard.c
module contact_capi_failure
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_f_pointer, c_int, c_null_char, c_null_ptr, c_ptr
   use omp_lib, only : omp_unset_lock
   use contact_base_case_status, only : case_status
   use contact_base_guard, only : cause_text
   use contact_capi_arguments, only : integer_of, set_argument
   use contact_capi_host, only : call_stage, find_call, give_floats_back, note_call
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : report_error, keep_status, refuse_for_ever
   use contact_capi_problem, only : abandon_problem, abandon_results, library_problem
   use contact_capi_registry, only : forget_call, is_setting
   use contact_control_library_codes, only : library_code
   implicit none (type, external)
   private

   public :: contact_call_failed

contains

   !> Put the problem of the call into a defined state, release what the thread holds, report the failure
   subroutine contact_call_failed(cause, name, ire, icp, ierror) bind(c, name="contact_call_failed")
      !> Member of guard_end
      integer(c_int), value :: cause
      !> Name of the routine, null-terminated
      character(kind=c_char), intent(in) :: name(*)
      !> Arguments of the call; absent if it has none
      integer(c_int), intent(in), optional :: ire, icp
      !> Receives -99; absent if the call has no such argument
      integer(c_int), intent(inout), optional :: ierror
      type(entry_type) :: this
      type(library_problem), pointer :: problem
      type(case_status) :: status
      type(c_ptr) :: address
      integer(c_int) :: stage
      character(len=:), allocatable :: reason
      integer :: i

      this = entry_type("", integer_of(ire), integer_of(icp))
      do i = 1, len(this%name)
         if (name(i) == c_null_char) exit
         this%name(i:i) = name(i)
      end do
      reason = trim(cause_text(cause))
      call find_call(address, stage)
      call note_call(c_null_ptr, call_stage%outside)
      nullify(problem)
      if (c_associated(address)) call c_f_pointer(address, problem)
      if (stage == call_stage%calculation) then
         call abandon_results(problem)
         reason = reason // "; results of earlier calculations are lost, the settings are kept"
         call status%refuse(reason)
         call keep_status(problem, status)
      else if (stage == call_stage%inside .and. (is_setting(this) .or. this%name == "cntc_readinpfile")) then
         call abandon_problem(problem)
         reason = reason // "; the settings of the problem are lost, finalise and initialise the result element"
         call refuse_for_ever(problem, this, reason)
      end if
      call report_error(this, reason)
      if (associated(problem)) then
         if (stage >= call_stage%inside) then
            call give_floats_back()
            call omp_unset_lock(problem%lock)
         end if
         call forget_call(problem, stage == call_stage%calculation)
      end if
      call set_argument(library_code%other, ierror)
   end subroutine contact_call_failed
end module contact_capi_failure
