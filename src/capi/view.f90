!> Results of one patch as callers get them: which patch, which side, which rows
module contact_capi_view
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_kinds, only : wp
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : complain
   use contact_capi_problem, only : library_problem
   use contact_control_units, only : outward, quantity_of, unit_convention
   use contact_patch_quantities, only : total_list
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: result_view, look_at

   !> One patch with the factors for the caller
   type :: result_view
      !> Null when there is none
      type(patch_result), pointer :: patch => null()
      type(unit_convention) :: units
      !> Is it a mirrored wheel on the left side?
      logical :: left = .false.
   contains
      !> Totals by their names, and numbers of rows of elements
      procedure :: totals
      procedure :: rows
      !> Estimated errors of totals
      procedure :: errors
   end type result_view

   !> What callers get in place of an error that is not known
   real(wp), parameter :: no_error = -1.0_wp

contains

   !> The results of a patch; complains when nothing has been calculated yet
   function look_at(this, problem) result(view)
      type(entry_type), intent(in) :: this
      !> That was entered
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

   !> Totals by their names, in the units and with the signs of the caller; 0 for those that the case does not have
   pure function totals(self, names) result(values)
      class(result_view), intent(in) :: self
      !> As the list of totals has them; the patch may be without them
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

   !> Estimated errors of totals by their names, in the units of the caller; -1 for none
   pure function errors(self, names) result(values)
      class(result_view), intent(in) :: self
      !> As the list of totals has them; those that the case does not have get no value
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

   !> Numbers of rows of elements, from the lowest y as the caller sees it
   pure function rows(self)
      class(result_view), intent(in) :: self
      integer :: rows(self%patch%grid%my)
      integer :: iy

      rows = [(iy, iy = 1, size(rows))]
      if (self%left) rows = rows(size(rows):1:-1)
   end function rows
end module contact_capi_view
