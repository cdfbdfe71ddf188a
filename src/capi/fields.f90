!> Results of one patch for callers: fields of its elements, their maxima, errors, wear
module contact_capi_fields
   use contact_base_choices, only : motion
   use contact_base_kinds, only : wp
   use contact_capi_caller, only : caller
   use contact_capi_messages, only : report_error
   use contact_capi_view, only : result_view
   use contact_control_units, only : outward, quantity, quantity_of, quantity_type
   use contact_patch_quantities, only : element_field
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: get_errors, get_field, get_fields, get_largest_temperatures, get_wear

contains

   !> Give one element field by its number
   subroutine get_field(a, view)
      type(caller), intent(in) :: a
      type(result_view), intent(in) :: view
      type(element_field), allocatable :: rows(:)
      integer :: row

      call view%patch%fields(rows)
      row = findloc(rows%code, a%single(1), 1)
      if (row == 0) then
         call report_error(a%call_of, "there is no field " // integer_text(a%single(1)))
      else if (.not. associated(rows(row)%values)) then
         call report_error(a%call_of, "field " // integer_text(a%single(1)) // " is not available in this case")
      else
         call give_field(a, 1, view, rows(row))
      end if
   end subroutine get_field

   !> Give fields that exist in all cases, one for each result of the routine
   subroutine get_fields(a, view, names)
      type(caller), intent(in) :: a
      type(result_view), intent(in) :: view
      !> Names of the fields
      character(len=*), intent(in) :: names(:)
      type(element_field), allocatable :: rows(:)
      integer :: k

      call view%patch%fields(rows)
      do k = 1, size(names)
         call give_field(a, k, view, rows(findloc(rows%name == names(k), .true., 1)))
      end do
   end subroutine get_fields

   !> Write one field to the caller's array up to its size, x varying fastest, from the lowest y in the axes of the caller
   subroutine give_field(a, k, view, row)
      type(caller), intent(in) :: a
      !> Index of the result
      integer, intent(in) :: k
      type(result_view), intent(in) :: view
      type(element_field), intent(in) :: row
      type(quantity_type) :: unit
      real(wp) :: factor

      unit = quantity_of(row%unit)
      factor = 1.0_wp
      ! by contract shifts are in mm in all units, and the rigid slip has the opposite sign
      if (any(row%name == ["sx", "sy", "wx", "wy"])) unit = quantity%number
      if (any(row%name == ["wx", "wy"])) factor = -1.0_wp
      factor = factor/row%divisor*outward(view%units, unit, row%along, view%left)
      call a%set_result(k, factor*reshape(row%values(:, view%rows()), [size(row%values)]))
   end subroutine give_field

   !> Estimated errors of the totals of a patch; -1 if there is no estimate
   subroutine get_errors(a, view)
      type(caller), intent(in) :: a
      type(result_view), intent(in) :: view
      character(len=16) :: names(12)

      if (.not. allocated(view%patch%errors)) call report_error(a%call_of, &
         & "no errors were estimated: set the flag CNTC_own_errors before the calculation")
      names = [character(len=16) :: "fn", "fx", "fy", "mz", "pen", "pmax", "contact_area", "cksi", "ceta", "friction_power", &
         & "elastic_energy", "max_temp1"]
      if (view%patch%motion == motion%shift) names(8:10) = [character(len=16) :: "shift_x", "shift_y", "friction_work"]
      call a%set_result(1, view%errors(names))
   end subroutine get_errors

   !> Totals of wear and fatigue of a patch; 0 for those that do not exist in the case
   subroutine get_wear(a, view)
      type(caller), intent(in) :: a
      type(result_view), intent(in) :: view

      if (.not. allocated(view%patch%wear)) call report_error(a%call_of, &
         & "there is no wear: set the flag CNTC_own_wear, or call cntc_setwear, before the calculation")
      call a%set_result(1, view%totals([character(len=16) :: "t_gamma", "wear_index", "max_power", "max_wear", "worn_section", &
         & "traction", "shakedown_load", "shakedown", "fatigue_index", "max_mises", "max_tresca"]))
   end subroutine get_wear

   !> Maximum surface temperatures; 0 if they are not calculated
   subroutine get_largest_temperatures(a, view)
      type(caller), intent(in) :: a
      type(result_view), intent(in) :: view

      if (allocated(view%patch%temp1)) then
         call a%set_each_result(view%patch%largest_temperatures())
      else
         call report_error(a%call_of, "surface temperatures are not calculated in this case")
         call a%set_each_result([0.0_wp, 0.0_wp])
      end if
   end subroutine get_largest_temperatures
end module contact_capi_fields
