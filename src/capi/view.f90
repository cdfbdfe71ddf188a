!> Access of callers to the results of one patch: selection of patch, side, and rows
module contact_capi_view
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_kinds, only : wp
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : report_error
   use contact_capi_problem, only : library_problem
   use contact_control_units, only : outward, quantity_of, unit_convention
   use contact_patch_quantities, only : total_list
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: result_view, look_at

   !> One patch, with the unit factors and side of the caller
   type :: result_view
      !> Null if there is none
      type(patch_result), pointer :: patch => null()
      type(unit_convention) :: units
      !> Is it a mirrored wheel on the left side?
      logical :: left = .false.
   contains
      !> Totals by their names; indices of rows of elements
      procedure :: totals
      procedure :: rows
      !> Estimated errors of totals
      procedure :: errors
   end type result_view

   !> Value returned for an unknown error
   real(wp), parameter :: no_error = -1.0_wp

contains

   !> Results of a patch; reports an error if nothing has been calculated yet
   function look_at(this, problem) result(view)
      type(entry_type), intent(in) :: this
      !> Problem of the call, which has been entered
      type(library_problem), pointer, intent(in) :: problem
      type(result_view) :: view

      view%units = problem%units
      if (.not. problem%has_result) then
         call report_error(this, "nothing has been calculated yet")
         return
      end if
      if (problem%module_number == 1) then
         view%left = problem%bodies%left
         view%patch => problem%wheel_rail_result%patches(this%icp)%contact
      else
         view%patch => problem%result
      end if
   end function look_at

   !> Totals by their names, in the units and with the signs of the caller; 0 for those that do not exist in the case
   pure function totals(self, names) result(values)
      class(result_view), intent(in) :: self
      !> Names as in the list of totals; the patch may have none of them
      character(len=*), intent(in) :: names(:)
      real(wp) :: values(size(names))
      type(total_list) :: list
      integer :: k

      call self%patch%totals(list)
      do k = 1, size(names)
         associate (row => list%rows(list%place_of(names(k))))
            values(k) = 0.0_wp
            if (row%name == names(k)) values(k) = row%value*outward(self%units, quantity_of(row%unit), row%along, self%left)
         end associate
      end do
   end function totals

   !> Estimated errors of totals by their names, in the units of the caller; -1: none
   pure function errors(self, names) result(values)
      class(result_view), intent(in) :: self
      !> Names as in the list of totals; those that do not exist in the case have no error
      character(len=*), intent(in) :: names(:)
      real(wp) :: values(size(names))
      type(total_list) :: list
      integer :: k, row

      values = no_error
      if (.not. allocated(self%patch%errors)) return
      call self%patch%totals(list)
      do k = 1, size(names)
         row = list%place_of(names(k))
         if (list%rows(row)%name /= names(k) .or. row > size(self%patch%errors%value)) cycle
         if (ieee_is_finite(self%patch%errors%value(row))) values(k) = self%patch%errors%value(row) &
            & *abs(outward(self%units, quantity_of(list%rows(row)%unit), list%rows(row)%along, self%left))
      end do
   end function errors

   !> Indices of rows of elements, in increasing y of the caller
   pure function rows(self)
      class(result_view), intent(in) :: self
      integer :: rows(self%patch%grid%my)
      integer :: iy

      rows = [(iy, iy = 1, size(rows))]
      if (self%left) rows = rows(size(rows):1:-1)
   end function rows
end module contact_capi_view
