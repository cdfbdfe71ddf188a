!> Contact surfaces and subsurface blocks as VTK files, for ParaView and similar programs
!>
!> <name>.<case><patch>.vts holds the elements as cells, <name>.<case><patch>.block<k>.vts the points of a
!> subsurface block, <name>.<case>.rail.vts and .wheel.vts the surfaces of both bodies, and <name>.pvd lists all of them with
!> the number of the case as time. Wheel and rail: points and vectors are in track coordinates.
module contact_output_vtk_files
   use, intrinsic :: iso_c_binding, only : c_long
   use contact_base_choices, only : is_rolling, motion
   use contact_base_error, only : add_context, error_type
   use contact_base_kinds, only : long, wp
   use contact_base_limits, only : case_limits
   use contact_base_output_file, only : output_file
   use contact_cases_spec, only : case_spec
   use contact_output_case_record, only : case_head, planned_text, run_summary, side_sign
   use contact_output_finished_file, only : case_file_name, close_result, open_result, open_result_again
   use contact_output_vtk_bodies, only : body_points, body_profile
   use contact_output_vtk_grid, only : finish_grid, put, start_grid, vtk_grid
   use contact_patch_quantities, only : element_field, is_lateral
   use contact_patch_result, only : patch_result, subsurface_result
   use contact_text_words, only : integer_text, replaced
   use contact_wheelrail_result, only : wheel_rail_patch, wheel_rail_result
   implicit none (type, external)
   private

   public :: vtk_files

   !> The collection of files of an experiment
   type :: vtk_files
      !> Folder and name of the results
      character(len=:), allocatable, private :: base
      !> File of the collection, and position of its closing lines [bytes]
      type(output_file), private :: file
      integer(c_long), private :: last = 0
      !> Number of cases of the input; number of cases of which a file could not be written
      integer, private :: planned = 0, lost = 0
   contains
      procedure :: open_collection
      procedure :: close_collection
      procedure :: place
      !> Write the files of a solved case of module 3, of module 1
      procedure :: write_contact
      procedure :: write_wheel_rail
      procedure, private :: list_file
      procedure, private :: list_loss
   end type vtk_files

   !> Entry of the list for a case whose files are missing
   character(len=*), parameter :: loss = "    <!-- missing: a file of case "

   !> Part numbers of the surfaces of the bodies in the list, above those of the patches
   integer, parameter :: rail_part = 98, wheel_part = 99

   !> Length of the remark at the end of the collection, the same for all remarks, so that each overwrites the one before
   !> [characters]
   integer, parameter :: remark_length = 80

contains

   !> Open the collection
   subroutine open_collection(self, base, run, limits, error, place)
      class(vtk_files), intent(inout) :: self
      !> Folder and name of the results
      character(len=*), intent(in) :: base
      !> Number of planned cases
      type(run_summary), intent(in) :: run
      type(case_limits), intent(in) :: limits
      type(error_type), allocatable, intent(out) :: error
      !> Continue after this number of bytes; absent: new file
      integer(long), intent(in), optional :: place

      self%base = base
      self%planned = run%planned
      if (present(place)) then
         call count_losses(base // ".pvd", place, self%lost)
         call open_result_again(self%file, base // ".pvd", place, error, limits)
         if (allocated(error)) return
         self%last = place
         call write_unfinished(self)
         return
      end if
      call open_result(self%file, base // ".pvd", base // ".pvd", error, limits)
      if (allocated(error)) return
      call self%file%line('<?xml version="1.0"?>')
      call self%file%line('<VTKFile type="Collection" version="1.0">')
      call self%file%line("  <Collection>")
      self%last = self%file%place()
      call write_unfinished(self)
   end subroutine open_collection

   !> Size of the list so far, without its end [bytes]
   integer(long) function place(self)
      class(vtk_files), intent(in) :: self
      place = self%last
   end function place

   !> Record the progress of the run, and close
   subroutine close_collection(self, run, error)
      class(vtk_files), intent(inout) :: self
      type(run_summary), intent(in) :: run
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: remark

      if (.not. self%file%is_open()) return
      call self%file%seek(self%last)
      remark = trim(merge("complete,    ", "not complete,", run%is_complete() .and. self%lost == 0)) // " " // &
         & trim(planned_text(run))
      if (self%lost > 0) remark = remark // ", files missing in " // integer_text(self%lost)
      call write_end(self, remark)
      call close_result(self%file, self%base // ".pvd", error)
   end subroutine close_collection

   !> Write the end of the collection of an unfinished run
   subroutine write_unfinished(self)
      class(vtk_files), intent(inout) :: self

      call write_end(self, "not complete, " // integer_text(self%planned) // " cases were planned")
      call self%file%flush_now()
   end subroutine write_unfinished

   !> Write the closing lines with a remark
   subroutine write_end(self, remark)
      class(vtk_files), intent(in) :: self
      character(len=*), intent(in) :: remark
      character(len=remark_length) :: padded

      padded = remark
      call self%file%line("  </Collection>")
      call self%file%line("  <!-- " // padded // " -->")
      call self%file%line("</VTKFile>")
   end subroutine write_end

   !> Add a file to the collection, which is complete again afterwards
   subroutine list_file(self, name, case_number, part)
      class(vtk_files), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: case_number, part

      call add_entry(self, '    <DataSet timestep="' // integer_text(case_number) // '" part="' // integer_text(part) // &
         & '" file="' // for_xml(name(index(name, "/", back=.true.) + 1:)) // '"/>')
   end subroutine list_file

   !> Insert a line before the end of the collection
   subroutine add_entry(self, line)
      class(vtk_files), intent(inout) :: self
      character(len=*), intent(in) :: line

      call self%file%seek(self%last)
      call self%file%line(line)
      self%last = self%file%place()
      call write_unfinished(self)
   end subroutine add_entry

   !> Record in the list that a file of a case could not be written
   subroutine list_loss(self, case_number)
      class(vtk_files), intent(inout) :: self
      integer, intent(in) :: case_number

      self%lost = self%lost + 1
      call add_entry(self, loss // integer_text(case_number) // " -->")
   end subroutine list_loss

   !> Number of cases of a list of which a file is missing
   subroutine count_losses(name, length, lost)
      character(len=*), intent(in) :: name
      !> Length of the list [bytes]
      integer(long), intent(in) :: length
      integer, intent(out) :: lost
      character(len=:), allocatable :: list
      integer(long) :: at
      integer :: next, status, unit

      lost = 0
      allocate(character(len=length) :: list)
      open(newunit=unit, file=name, access="stream", action="read", status="old", iostat=status)
      if (status /= 0) return
      read(unit, iostat=status) list
      close(unit)
      if (status /= 0) return
      at = 1
      do
         next = index(list(at:), loss)
         if (next == 0) exit
         lost = lost + 1
         at = at + next
      end do
   end subroutine count_losses

   !> A text with the characters escaped that are reserved in XML
   pure function for_xml(text) result(safe)
      character(len=*), intent(in) :: text
      character(len=len(replaced(replaced(replaced(text, "&", "&amp;"), "<", "&lt;"), '"', "&quot;"))) :: safe

      safe = replaced(replaced(replaced(text, "&", "&amp;"), "<", "&lt;"), '"', "&quot;")
   end function for_xml

   !> Write a solved case of module 3
   subroutine write_contact(self, head, spec, contact, error)
      class(vtk_files), intent(inout) :: self
      type(case_head), intent(in) :: head
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: contact
      type(error_type), allocatable, intent(out) :: error

      call write_patch(self, head, spec, contact, 0, error)
      if (allocated(error)) call self%list_loss(head%number)
   end subroutine write_contact

   !> Write a solved case of module 1
   subroutine write_wheel_rail(self, head, spec, pair, rail, wheel, error)
      class(vtk_files), intent(inout) :: self
      !> Number of the case
      type(case_head), intent(in) :: head
      !> Specification
      type(case_spec), intent(in) :: spec
      !> Results
      type(wheel_rail_result), intent(in) :: pair
      !> Profiles or surfaces of both bodies
      type(body_profile), intent(in) :: rail, wheel
      type(error_type), allocatable, intent(out) :: error
      integer :: k

      do k = 1, size(pair%patches)
         call write_patch(self, head, spec, pair%patches(k)%contact, k, error, pair%patches(k))
         if (.not. allocated(error)) cycle
         call self%list_loss(head%number)
         return
      end do
      call write_body(self, head, spec, pair, rail, "rail", error)
      if (.not. allocated(error)) call write_body(self, head, spec, pair, wheel, "wheel", error)
      if (allocated(error)) call self%list_loss(head%number)
   end subroutine write_wheel_rail

   !> Write the surface of a body; nothing if there is none
   subroutine write_body(self, head, spec, pair, profile, name, error)
      type(vtk_files), intent(inout) :: self
      type(case_head), intent(in) :: head
      type(case_spec), intent(in) :: spec
      type(wheel_rail_result), intent(in) :: pair
      type(body_profile), intent(in) :: profile
      !> "rail" or "wheel"
      character(len=*), intent(in) :: name
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: file
      real(wp), allocatable :: points(:, :, :)
      type(vtk_grid) :: grid

      call body_points(spec, pair, profile, name == "wheel", points)
      if (size(points) == 0) return
      points(2, :, :) = side_sign(spec)*points(2, :, :)
      call start_grid(grid, [size(points, 2), size(points, 3), 1], .false., size(points))
      file = case_file_name(self%base, head%number, name // ".vts", head%result_element, head%contact_problem, 0)
      call finish_grid(grid, file, reshape(points, [size(points)]), error, spec%limits)
      if (.not. allocated(error)) call self%list_file(file, head%number, merge(wheel_part, rail_part, name == "wheel"))
      call add_context(error, "writing VTK files")
   end subroutine write_body

   !> Write surface and blocks of a patch
   subroutine write_patch(self, head, spec, contact, number, error, place)
      type(vtk_files), intent(inout) :: self
      type(case_head), intent(in) :: head
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: contact
      !> Number of the patch, 0 for module 3
      integer, intent(in) :: number
      type(error_type), allocatable, intent(out) :: error
      !> Position of the patch, in module 1
      type(wheel_rail_patch), intent(in), optional :: place
      character(len=:), allocatable :: name
      integer :: k, part

      part = max(0, number - 1)
      name = case_file_name(self%base, head%number, "vts", head%result_element, head%contact_problem, number)
      call write_surface(name, spec, contact, error, place)
      if (.not. allocated(error)) call self%list_file(name, head%number, part)
      if (allocated(contact%subsurface)) then
         do k = 1, size(contact%subsurface)
            if (allocated(error)) exit
            name = case_file_name(self%base, head%number, "block" // integer_text(k) // ".vts", head%result_element, &
               & head%contact_problem, number)
            call write_block(name, spec, contact%subsurface(k), error, place)
            if (.not. allocated(error)) call self%list_file(name, head%number, 100*k + part)
         end do
      end if
      call add_context(error, "writing VTK files")
   end subroutine write_patch

   !> Write the elements of a patch as cells
   subroutine write_surface(name, spec, contact, error, place)
      character(len=*), intent(in) :: name
      type(case_spec), intent(in) :: spec
      type(patch_result), target, intent(in) :: contact
      type(error_type), allocatable, intent(out) :: error
      type(wheel_rail_patch), intent(in), optional :: place
      type(vtk_grid) :: grid
      type(element_field), allocatable :: fields(:)
      character(len=32) :: label
      real(wp), allocatable :: points(:, :, :), traction(:, :, :), slip(:, :, :)
      real(wp) :: distance, s
      integer :: ix, iy, k

      s = side_sign(spec)
      call contact%fields(fields)
      associate (mx => contact%grid%mx, my => contact%grid%my)
         allocate(points(3, 0:mx, 0:my), traction(3, mx, my), slip(3, mx, my))
         do iy = 0, my
            do ix = 0, mx
               points(:, ix, iy) = in_track([contact%grid%xl + ix*contact%grid%dx, contact%grid%yl + iy*contact%grid%dy, 0.0_wp], &
                  & s, place, real(iy, wp) + 0.5_wp)
            end do
         end do
         distance = merge(contact%dq, 1.0_wp, is_rolling(contact%motion))
         do iy = 1, my
            do ix = 1, mx
               traction(:, ix, iy) = turned([contact%px(ix, iy), contact%py(ix, iy), contact%pn(ix, iy)], s, place, iy)
               slip(:, ix, iy) = turned([contact%sx(ix, iy), contact%sy(ix, iy), 0.0_wp], s, place, iy)/distance
            end do
         end do
         call start_grid(grid, [mx + 1, my + 1, 1], .true., size(points) + mx*my*(7 + size(fields)))
         call put(grid, "element state", 1, reshape(real(contact%division, wp), [mx*my]))
         do k = 1, size(fields)
            if (fields(k)%label == "" .or. fields(k)%is_zero .or. .not. associated(fields(k)%values)) cycle
            label = fields(k)%label
            if (fields(k)%unit /= "-") label = trim(label) // " [" // trim(fields(k)%unit) // "]"
            call put(grid, trim(label), 1, merge(s, 1.0_wp, is_lateral(fields(k)%along))/fields(k)%divisor &
               & *reshape(fields(k)%values, [mx*my]))
         end do
         call put(grid, "traction [N/mm2]", 3, reshape(traction, [3*mx*my]))
         if (contact%motion /= motion%none) call put(grid, trim(merge("relative slip", "slip [mm]    ", &
            & is_rolling(contact%motion))), 3, reshape(slip, [3*mx*my]))
         call finish_grid(grid, name, reshape(points, [size(points)]), error, spec%limits)
      end associate
   end subroutine write_surface

   !> Write the points of a subsurface block
   subroutine write_block(name, spec, block, error, place)
      character(len=*), intent(in) :: name
      type(case_spec), intent(in) :: spec
      type(subsurface_result), intent(in) :: block
      type(error_type), allocatable, intent(out) :: error
      type(wheel_rail_patch), intent(in), optional :: place
      type(vtk_grid) :: grid
      real(wp), allocatable :: points(:, :), displacement(:, :)
      !> Components in the order of VTK: xx, yy, zz, xy, yz, xz; axes of the patch
      integer, parameter :: vtk_order(6) = [1, 4, 6, 2, 5, 3]
      real(wp) :: s
      integer :: k, n

      s = side_sign(spec)
      n = size(block%position, 2)
      allocate(points(3, n), displacement(3, n))
      do k = 1, n
         points(:, k) = in_track(block%position(:, k)*[1.0_wp, s, 1.0_wp], s, place)
         displacement(:, k) = turned(block%displacement(:, k)*[1.0_wp, s, 1.0_wp], s, place)
      end do
      call start_grid(grid, [block%nx, block%ny, block%nz], .false., 20*n)
      call put(grid, "von Mises [N/mm2]", 1, block%sigvm)
      call put(grid, "mean stress [N/mm2]", 1, block%sighyd)
      call put(grid, "Tresca [N/mm2]", 1, block%sigtr)
      call put(grid, "sigma 1 [N/mm2]", 1, block%sigma1)
      call put(grid, "sigma 2 [N/mm2]", 1, block%sigma2)
      call put(grid, "sigma 3 [N/mm2]", 1, block%sigma3)
      call put(grid, "displacement [mm]", 3, reshape(displacement, [3*n]))
      call put(grid, "stress, axes of the patch [N/mm2]", 6, reshape(block%stress(vtk_order, :), [6*n]))
      call finish_grid(grid, name, reshape(points, [size(points)]), error, spec%limits)
   end subroutine write_block

   !> A point of a patch in track coordinates; unchanged in module 3
   pure function in_track(local, s, place, row) result(point)
      !> x, y, z [mm] about the reference of the patch, for a right-hand pair
      real(wp), intent(in) :: local(3)
      !> -1 for the left side
      real(wp), intent(in) :: s
      type(wheel_rail_patch), intent(in), optional :: place
      !> Row of elements to which the height of the point is relative, for curved references; the centre of row i is at i
      real(wp), intent(in), optional :: row
      real(wp) :: point(3), t
      integer :: k

      point = local
      if (.not. present(place)) return
      if (allocated(place%curve) .and. present(row)) then
         if (size(place%curve, 2) > 1) then
            k = min(max(1, floor(row)), size(place%curve, 2) - 1)
            t = row - k
            point = [place%x + local(1), (1.0_wp - t)*place%curve(1, k) + t*place%curve(1, k + 1), &
               & (1.0_wp - t)*place%curve(2, k) + t*place%curve(2, k + 1)]
            point(2) = s*point(2)
            return
         end if
      end if
      point = [place%x + local(1), place%y + cos(place%delta)*local(2) - sin(place%delta)*local(3), &
         & place%z + sin(place%delta)*local(2) + cos(place%delta)*local(3)]
      point(2) = s*point(2)
   end function in_track

   !> A vector of a patch in track axes; unchanged in module 3
   pure function turned(local, s, place, row) result(vector)
      real(wp), intent(in) :: local(3), s
      type(wheel_rail_patch), intent(in), optional :: place
      !> Row of elements, for curved references
      integer, intent(in), optional :: row
      real(wp) :: vector(3), angle

      vector = local
      if (.not. present(place)) return
      angle = place%delta
      if (allocated(place%curve) .and. present(row)) angle = place%curve(3, row)
      vector = [local(1), s*(cos(angle)*local(2) - sin(angle)*local(3)), sin(angle)*local(2) + cos(angle)*local(3)]
   end function turned
end module contact_output_vtk_files
