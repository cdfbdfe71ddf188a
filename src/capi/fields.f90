!> Entries that hand out element fields of one patch
module contact_capi_fields
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use contact_base_choices, only : motion
   use contact_base_kinds, only : wp
   use contact_capi_arguments, only : give, give_list, integer_of
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : complain
   use contact_capi_problem, only : library_problem
   use contact_capi_registry, only : leave
   use contact_capi_view, only : enter_result, result_view
   use contact_control_units, only : outward, quantity, quantity_of, quantity_type
   use contact_patch_quantities, only : element_field
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: cntc_getfielddata, cntc_gettractions, cntc_getmicroslip, cntc_getdisplacements, cntc_getelementdivision
   public :: cntc_getmaximumpressure, cntc_getmaximumtraction, cntc_getmaximumtemperature, cntc_geterrors, cntc_getwear

contains

   !> One element field by its number
   subroutine cntc_getfielddata(ire, icp, ifld, lenarr, fld) bind(c, name="inside_cntc_getfielddata")
      integer(c_int), intent(in), optional :: ire, icp, ifld, lenarr
      real(c_double), intent(inout), optional :: fld(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(result_view) :: view
      type(element_field), allocatable :: rows(:)
      integer :: row

      this = entry_type("cntc_getFieldData", integer_of(ire), integer_of(icp))
      call enter_result(this, problem, view)
      if (.not. associated(problem)) return
      call view%patch%fields(rows)
      row = findloc(rows%code, integer_of(ifld), 1)
      if (row == 0) then
         call complain(this, "there is no field " // integer_text(integer_of(ifld)))
      else if (.not. associated(rows(row)%values)) then
         call complain(this, "field " // integer_text(integer_of(ifld)) // " is not available in this case")
      else
         call give_field(view, rows(row), lenarr, fld)
      end if
      call leave(problem)
   end subroutine cntc_getfielddata

   !> Pressures and tangential tractions
   subroutine cntc_gettractions(ire, icp, lenarr, pn, px, py) bind(c, name="inside_cntc_gettractions")
      integer(c_int), intent(in), optional :: ire, icp, lenarr
      real(c_double), intent(inout), optional :: pn(*), px(*), py(*)

      call give_fields("cntc_getTractions", ire, icp, ["pn", "px", "py"], lenarr, pn, px, py)
   end subroutine cntc_gettractions

   !> Slip
   subroutine cntc_getmicroslip(ire, icp, lenarr, sx, sy) bind(c, name="inside_cntc_getmicroslip")
      integer(c_int), intent(in), optional :: ire, icp, lenarr
      real(c_double), intent(inout), optional :: sx(*), sy(*)

      call give_fields("cntc_getMicroSlip", ire, icp, ["sx", "sy"], lenarr, sx, sy)
   end subroutine cntc_getmicroslip

   !> Displacement differences, the normal one first
   subroutine cntc_getdisplacements(ire, icp, lenarr, un, ux, uy) bind(c, name="inside_cntc_getdisplacements")
      integer(c_int), intent(in), optional :: ire, icp, lenarr
      real(c_double), intent(inout), optional :: un(*), ux(*), uy(*)

      call give_fields("cntc_getDisplacements", ire, icp, ["un", "ux", "uy"], lenarr, un, ux, uy)
   end subroutine cntc_getdisplacements

   !> Hand over fields that all cases have
   subroutine give_fields(routine, ire, icp, names, length, first, second, third)
      !> Name of the routine that was called
      character(len=*), intent(in) :: routine
      integer(c_int), intent(in), optional :: ire, icp, length
      !> Of the fields
      character(len=*), intent(in) :: names(:)
      real(c_double), intent(inout), optional :: first(*), second(*), third(*)
      type(library_problem), pointer :: problem
      type(result_view) :: view
      type(element_field), allocatable :: rows(:)
      integer :: k

      call enter_result(entry_type(routine, integer_of(ire), integer_of(icp)), problem, view)
      if (.not. associated(problem)) return
      call view%patch%fields(rows)
      do k = 1, size(names)
         associate (row => rows(findloc(rows%name == names(k), .true., 1)))
            if (k == 1) call give_field(view, row, length, first)
            if (k == 2) call give_field(view, row, length, second)
            if (k == 3) call give_field(view, row, length, third)
         end associate
      end do
      call leave(problem)
   end subroutine give_fields

   !> Hand over one field as far as there is room, x running fastest, from the lowest y as the caller sees it
   subroutine give_field(view, row, length, array)
      type(result_view), intent(in) :: view
      type(element_field), intent(in) :: row
      integer(c_int), intent(in), optional :: length
      real(c_double), intent(inout), optional :: array(*)
      type(quantity_type) :: unit
      real(wp) :: factor

      unit = quantity_of(row%unit)
      factor = 1.0_wp
      ! by contract shifts are in mm in all units, and the rigid slip has the other sign
      if (any(row%name == ["sx", "sy", "wx", "wy"])) unit = quantity%number
      if (any(row%name == ["wx", "wy"])) factor = -1.0_wp
      factor = factor/row%divisor*outward(view%units, unit, row%along, view%left)
      call give_list(factor*reshape(row%values(:, view%rows()), [size(row%values)]), length, array)
   end subroutine give_field

   !> States of the elements
   subroutine cntc_getelementdivision(ire, icp, lenarr, eldiv) bind(c, name="inside_cntc_getelementdivision")
      integer(c_int), intent(in), optional :: ire, icp, lenarr
      integer(c_int), intent(inout), optional :: eldiv(*)
      type(library_problem), pointer :: problem
      type(result_view) :: view

      call enter_result(entry_type("cntc_getElementDivision", integer_of(ire), integer_of(icp)), problem, view)
      if (.not. associated(problem)) return
      associate (division => view%patch%division)
         call give_list(reshape(division(:, view%rows()), [size(division)]), lenarr, eldiv)
      end associate
      call leave(problem)
   end subroutine cntc_getelementdivision

   !> Estimated errors of the totals of a patch; -1 for none
   subroutine cntc_geterrors(ire, icp, lenarr, rvalues) bind(c, name="inside_cntc_geterrors")
      integer(c_int), intent(in), optional :: ire, icp, lenarr
      real(c_double), intent(inout), optional :: rvalues(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(result_view) :: view
      character(len=16) :: names(12)

      this = entry_type("cntc_getErrors", integer_of(ire), integer_of(icp))
      call enter_result(this, problem, view)
      if (.not. associated(problem)) return
      if (.not. allocated(view%patch%errors)) &
         & call complain(this, "no errors were estimated: set the flag CNTC_own_errors before the calculation")
      names = [character(len=16) :: "fn", "fx", "fy", "mz", "pen", "pmax", "contact_area", "cksi", "ceta", "friction_power", &
         & "elastic_energy", "max_temp1"]
      if (view%patch%motion == motion%shift) names(8:10) = [character(len=16) :: "shift_x", "shift_y", "friction_work"]
      call give_list(view%errors(names), lenarr, rvalues)
      call leave(problem)
   end subroutine cntc_geterrors

   !> Totals of wear and fatigue of a patch; 0 for those that the case has not
   subroutine cntc_getwear(ire, icp, lenarr, rvalues) bind(c, name="inside_cntc_getwear")
      integer(c_int), intent(in), optional :: ire, icp, lenarr
      real(c_double), intent(inout), optional :: rvalues(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(result_view) :: view
      character(len=16), parameter :: names(11) = [character(len=16) :: "t_gamma", "wear_index", "max_power", "max_wear", &
         & "worn_section", "traction", "shakedown_load", "shakedown", "fatigue_index", "max_mises", "max_tresca"]

      this = entry_type("cntc_getWear", integer_of(ire), integer_of(icp))
      call enter_result(this, problem, view)
      if (.not. associated(problem)) return
      if (.not. allocated(view%patch%wear)) &
         & call complain(this, "there is no wear: set the flag CNTC_own_wear, or call cntc_setwear, before the calculation")
      call give_list(view%totals(names), lenarr, rvalues)
      call leave(problem)
   end subroutine cntc_getwear

   !> Largest pressure
   subroutine cntc_getmaximumpressure(ire, icp, pnmax) bind(c, name="inside_cntc_getmaximumpressure")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(inout), optional :: pnmax
      type(library_problem), pointer :: problem
      type(result_view) :: view

      call enter_result(entry_type("cntc_getMaximumPressure", integer_of(ire), integer_of(icp)), problem, view)
      if (.not. associated(problem)) return
      call give(sum(view%totals(["pmax"])), pnmax)
      call leave(problem)
   end subroutine cntc_getmaximumpressure

   !> Largest tangential traction
   subroutine cntc_getmaximumtraction(ire, icp, ptmax) bind(c, name="inside_cntc_getmaximumtraction")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(inout), optional :: ptmax
      type(library_problem), pointer :: problem
      type(result_view) :: view

      call enter_result(entry_type("cntc_getMaximumTraction", integer_of(ire), integer_of(icp)), problem, view)
      if (.not. associated(problem)) return
      call give(maxval(hypot(view%patch%px, view%patch%py))*outward(view%units, quantity%pressure), ptmax)
      call leave(problem)
   end subroutine cntc_getmaximumtraction

   !> Largest surface temperatures; 0 when they are not calculated
   subroutine cntc_getmaximumtemperature(ire, icp, t1max, t2max) bind(c, name="inside_cntc_getmaximumtemperature")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(inout), optional :: t1max, t2max
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(result_view) :: view

      this = entry_type("cntc_getMaximumTemperature", integer_of(ire), integer_of(icp))
      call enter_result(this, problem, view)
      if (.not. associated(problem)) return
      if (allocated(view%patch%temp1)) then
         call give(maxval(view%patch%temp1), t1max)
         call give(maxval(view%patch%temp2), t2max)
      else
         call complain(this, "surface temperatures are not calculated in this case")
         call give(0.0_wp, t1max)
         call give(0.0_wp, t2max)
      end if
      call leave(problem)
   end subroutine cntc_getmaximumtemperature
end module contact_capi_fields
