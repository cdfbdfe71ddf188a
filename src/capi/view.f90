!> Results of one patch as callers get them: which patch, which side, which rows
module contact_capi_view
   use contact_base_kinds, only : wp
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : complain
   use contact_capi_problem, only : library_problem
   use contact_control_units, only : inward, outward, quantity, unit_convention
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: result_view, look_at, field_list

   !> One patch with the factors for the caller
   type :: result_view
      !> Null when there is none
      type(patch_result), pointer :: patch => null()
      type(unit_convention) :: units
      !> Is it a mirrored wheel on the left side?
      logical :: left = .false.
   end type result_view

contains

   !> The results of a patch; complains when nothing has been calculated yet
   function look_at(this, problem) result(view)
      type(entry_type), intent(in) :: this
      !> A problem that was entered
      type(library_problem), pointer, intent(in) :: problem
      type(result_view) :: view

      view%units = problem%units
      if (.not. problem%has_result) then
         call complain(this, "nothing has been calculated yet")
         return
      end if
      if (problem%module_number == 1) then
         view%left = problem%spec%wheel_rail%left
         view%patch => problem%wheel_rail_result%patches(this%icp)%contact
      else
         view%patch => problem%result
      end if
   end function look_at

   !> A field as a list, x running fastest, from the lowest y as the caller sees it
   pure function field_list(field, left, factor) result(list)
      !> Shape (mx, my)
      real(wp), intent(in) :: field(:, :)
      logical, intent(in) :: left
      real(wp), intent(in) :: factor
      real(wp), allocatable :: list(:)

      if (left) then
         list = factor*reshape(field(:, size(field, 2):1:-1), [size(field)])
      else
         list = factor*reshape(field, [size(field)])
      end if
   end function field_list
end module contact_capi_view
