!> Entries that hand out element fields of one patch
module contact_capi_fields
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use contact_base_kinds, only : wp
   use contact_capi_arguments, only : give, give_list, integer_of, count_of
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : complain
   use contact_capi_problem, only : library_problem
   use contact_capi_registry, only : enter, leave, scope
   use contact_capi_view, only : field_list, look_at, result_view
   use contact_control_library_codes, only : field_kind, field_row, field_table
   use contact_control_units, only : outward, quantity_type
   use contact_patch_result, only : patch_result
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: cntc_getfielddata, cntc_gettractions, cntc_getmicroslip, cntc_getdisplacements, cntc_getelementdivision
   public :: cntc_getmaximumpressure, cntc_getmaximumtraction, cntc_getmaximumtemperature

contains

   !> One element field by its code
   subroutine cntc_getfielddata(ire, icp, ifld, lenarr, fld) bind(c, name="inside_cntc_getfielddata")
      integer(c_int), intent(in), optional :: ire, icp, ifld, lenarr
      real(c_double), intent(inout), optional :: fld(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this

      this = entry_type("cntc_getFieldData", integer_of(ire), integer_of(icp))
      call enter(this, scope%one_patch, problem)
      if (.not. associated(problem)) return
      call give_field(this, look_at(this, problem), integer_of(ifld), lenarr, fld)
      call leave(problem)
   end subroutine cntc_getfielddata

   !> Pressures and shear tractions
   subroutine cntc_gettractions(ire, icp, lenarr, pn, px, py) bind(c, name="inside_cntc_gettractions")
      integer(c_int), intent(in), optional :: ire, icp, lenarr
      real(c_double), intent(inout), optional :: pn(*), px(*), py(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(result_view) :: view

      this = entry_type("cntc_getTractions", integer_of(ire), integer_of(icp))
      call enter(this, scope%one_patch, problem)
      if (.not. associated(problem)) return
      view = look_at(this, problem)
      call give_field(this, view, field_kind%pn, lenarr, pn)
      call give_field(this, view, field_kind%px, lenarr, px)
      call give_field(this, view, field_kind%py, lenarr, py)
      call leave(problem)
   end subroutine cntc_gettractions

   !> Slip
   subroutine cntc_getmicroslip(ire, icp, lenarr, sx, sy) bind(c, name="inside_cntc_getmicroslip")
      integer(c_int), intent(in), optional :: ire, icp, lenarr
      real(c_double), intent(inout), optional :: sx(*), sy(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(result_view) :: view

      this = entry_type("cntc_getMicroSlip", integer_of(ire), integer_of(icp))
      call enter(this, scope%one_patch, problem)
      if (.not. associated(problem)) return
      view = look_at(this, problem)
      call give_field(this, view, field_kind%sx, lenarr, sx)
      call give_field(this, view, field_kind%sy, lenarr, sy)
      call leave(problem)
   end subroutine cntc_getmicroslip

   !> Displacement differences, the normal one first
   subroutine cntc_getdisplacements(ire, icp, lenarr, un, ux, uy) bind(c, name="inside_cntc_getdisplacements")
      integer(c_int), intent(in), optional :: ire, icp, lenarr
      real(c_double), intent(inout), optional :: un(*), ux(*), uy(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(result_view) :: view

      this = entry_type("cntc_getDisplacements", integer_of(ire), integer_of(icp))
      call enter(this, scope%one_patch, problem)
      if (.not. associated(problem)) return
      view = look_at(this, problem)
      call give_field(this, view, field_kind%un, lenarr, un)
      call give_field(this, view, field_kind%ux, lenarr, ux)
      call give_field(this, view, field_kind%uy, lenarr, uy)
      call leave(problem)
   end subroutine cntc_getdisplacements

   !> Hand over one field as far as there is room
   subroutine give_field(this, view, kind, length, array)
      type(entry_type), intent(in) :: this
      type(result_view), intent(in) :: view
      !> Member of field_kind
      integer, intent(in) :: kind
      integer(c_int), intent(in), optional :: length
      real(c_double), intent(inout), optional :: array(*)
      real(wp), allocatable :: field(:, :)
      real(wp) :: factor
      integer :: row

      if (.not. associated(view%patch)) return
      do row = size(field_table), 1, -1
         if (field_table(row)%kind == kind) exit
      end do
      if (row == 0) then
         call complain(this, "there is no field " // integer_text(kind))
         return
      end if
      call take_field(view%patch, kind, field)
      if (.not. allocated(field)) then
         call complain(this, "field " // integer_text(kind) // " is not available in this case")
         return
      end if
      associate (this_row => field_table(row))
         factor = outward(view%units, quantity_type(length=this_row%length, force=this_row%force), this_row%along, view%left)
      end associate
      call give_list(field_list(field, view%left, factor), length, array)
   end subroutine give_field

   !> A field in internal units; unallocated when the case has none
   subroutine take_field(patch, kind, field)
      type(patch_result), intent(in) :: patch
      integer, intent(in) :: kind
      real(wp), allocatable, intent(out) :: field(:, :)

      select case (kind)
      case (field_kind%h); call copy(patch%h)
      case (field_kind%mu); call copy(patch%mu)
      case (field_kind%px); call copy(patch%px)
      case (field_kind%py); call copy(patch%py)
      case (field_kind%pn); call copy(patch%pn)
      case (field_kind%ux); call copy(patch%ux)
      case (field_kind%uy); call copy(patch%uy)
      case (field_kind%un); call copy(patch%un)
      case (field_kind%taucrt); call copy(patch%tau_c)
      case (field_kind%uplsx); call copy(patch%uplx)
      case (field_kind%uplsy); call copy(patch%uply)
      case (field_kind%sx); call copy(patch%sx, 1.0_wp/patch%dq)
      case (field_kind%sy); call copy(patch%sy, 1.0_wp/patch%dq)
      case (field_kind%temp1); call copy(patch%temp1)
      case (field_kind%temp2); call copy(patch%temp2)
      ! the published interface hands out the rigid slip with the other sign
      case (field_kind%wx); call copy(patch%wx, -1.0_wp/patch%dq)
      case (field_kind%wy); call copy(patch%wy, -1.0_wp/patch%dq)
      end select

   contains

      !> Copy what is there
      subroutine copy(source, factor)
         real(wp), allocatable, intent(in) :: source(:, :)
         real(wp), intent(in), optional :: factor

         if (.not. allocated(source)) return
         field = source
         if (present(factor)) field = factor*field
      end subroutine copy
   end subroutine take_field

   !> States of the elements
   subroutine cntc_getelementdivision(ire, icp, lenarr, eldiv) bind(c, name="inside_cntc_getelementdivision")
      integer(c_int), intent(in), optional :: ire, icp, lenarr
      integer(c_int), intent(inout), optional :: eldiv(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(result_view) :: view

      this = entry_type("cntc_getElementDivision", integer_of(ire), integer_of(icp))
      call enter(this, scope%one_patch, problem)
      if (.not. associated(problem)) return
      view = look_at(this, problem)
      if (associated(view%patch)) then
         associate (division => view%patch%division)
            if (view%left) then
               call give_list(reshape(division(:, size(division, 2):1:-1), [size(division)]), lenarr, eldiv)
            else
               call give_list(reshape(division, [size(division)]), lenarr, eldiv)
            end if
         end associate
      end if
      call leave(problem)
   end subroutine cntc_getelementdivision

   !> Largest pressure
   subroutine cntc_getmaximumpressure(ire, icp, pnmax) bind(c, name="inside_cntc_getmaximumpressure")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(inout), optional :: pnmax
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(result_view) :: view

      this = entry_type("cntc_getMaximumPressure", integer_of(ire), integer_of(icp))
      call enter(this, scope%one_patch, problem)
      if (.not. associated(problem)) return
      view = look_at(this, problem)
      if (associated(view%patch)) call give(view%patch%pmax*outward(view%units, quantity_type(length=-2, force=1)), pnmax)
      call leave(problem)
   end subroutine cntc_getmaximumpressure

   !> Largest shear traction
   subroutine cntc_getmaximumtraction(ire, icp, ptmax) bind(c, name="inside_cntc_getmaximumtraction")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(inout), optional :: ptmax
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(result_view) :: view

      this = entry_type("cntc_getMaximumTraction", integer_of(ire), integer_of(icp))
      call enter(this, scope%one_patch, problem)
      if (.not. associated(problem)) return
      view = look_at(this, problem)
      if (associated(view%patch)) call give(maxval(hypot(view%patch%px, view%patch%py))* &
         & outward(view%units, quantity_type(length=-2, force=1)), ptmax)
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
      call enter(this, scope%one_patch, problem)
      if (.not. associated(problem)) return
      view = look_at(this, problem)
      if (associated(view%patch)) then
         if (allocated(view%patch%temp1)) then
            call give(maxval(view%patch%temp1), t1max)
            call give(maxval(view%patch%temp2), t2max)
         else
            call complain(this, "surface temperatures are not calculated in this case")
            call give(0.0_wp, t1max)
            call give(0.0_wp, t2max)
         end if
      end if
      call leave(problem)
   end subroutine cntc_getmaximumtemperature
end module contact_capi_fields
