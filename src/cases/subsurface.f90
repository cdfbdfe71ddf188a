!> Stresses below the surface of one contact patch in blocks of points
module contact_cases_subsurface
   use contact_base_choices, only : kernel_model, material_model
   use contact_base_error, only : add_context, error_type, fatal_error
   use contact_base_kinds, only : long, wp
   use contact_base_limits, only : case_limits
   use contact_base_log, only : log_type
   use contact_base_memory, only : require_memory
   use contact_cases_spec, only : case_spec
   use contact_grid_element_division, only : bounding_box, contact_box
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_result, only : mirrored, patch_result, subsurface_result
   use contact_subsurface_invariants, only : stress_invariants
   use contact_subsurface_load, only : new_surface_load, surface_load
   use contact_subsurface_points, only : expand_points, list_points, point_block, point_set, stepped_depth, stepped_points
   use contact_subsurface_response_shelf, only : response_shelf
   use contact_text_words, only : integer_text, real_text
   use contact_subsurface_stress, only : subsurface_field
   implicit none (type, external)
   private

   public :: stress_memory, subsurface_stresses, warn_of_subsurface

   !> Maximum number of points of a block, about 3 GB
   integer(long), parameter :: max_points = 20000000_long
   !> Memory of the results of a point, including its position, plus the same amount during the computation [bytes]
   integer(long), parameter :: bytes_per_point = 300_long

contains

   !> Displacements, stresses and their invariants in the blocks of points of a case
   subroutine subsurface_stresses(spec, result, error, left, shelf)
      type(case_spec), intent(in) :: spec
      !> A solved patch; columns and rows of the blocks refer to its grid
      type(patch_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      !> Does the patch belong to a wheel on the left side, with its mirror image as solution? Points and results are then in the
      !> coordinates of the left side. Default: no
      logical, intent(in), optional :: left
      !> Data kept between successive cases for the first block; absent: none
      type(response_shelf), intent(inout), optional :: shelf
      type(surface_load) :: load
      type(potential_contact) :: area
      character(len=60) :: text
      integer :: k
      logical :: mirror

      if (allocated(result%subsurface)) deallocate(result%subsurface)
      if (.not. allocated(spec%subsurface%blocks)) return
      mirror = .false.
      if (present(left)) mirror = left
      if (mirror) then
         call set_load(mirrored(result))
      else
         call set_load(result)
      end if
      allocate(result%subsurface(size(spec%subsurface%blocks)))
      do k = 1, size(result%subsurface)
         call spec%limits%deadline%check("before the stresses below the surface", error)
         if (.not. allocated(error)) then
            if (k == 1) then
               call block_stresses(load, spec%subsurface%blocks(k), area, spec%limits, result%subsurface(k), error, shelf)
            else
               call block_stresses(load, spec%subsurface%blocks(k), area, spec%limits, result%subsurface(k), error)
            end if
         end if
         if (.not. allocated(error)) cycle
         write(text, "(A, I0)") "subsurface block ", k
         call add_context(error, trim(text))
         deallocate(result%subsurface)
         return
      end do

   contains

      subroutine set_load(patch)
         type(patch_result), intent(in) :: patch
         real(wp) :: modulus(2)

         modulus = spec%material%gg
         if (spec%material_model == material_model%viscoelastic) modulus = spec%material%immediate_moduli()
         call new_surface_load(load, patch%grid, patch%pn, patch%px, patch%py, modulus, spec%material%poiss, &
            & spec%kernel == kernel_model%bilinear)
         area = around_contact(patch)
      end subroutine set_load
   end subroutine subsurface_stresses

   !> Warn of points whose stresses are affected by the piecewise constant tractions, and of displacements without memory
   subroutine warn_of_subsurface(spec, result, log)
      type(case_spec), intent(in) :: spec
      !> Solution with its blocks
      type(patch_result), intent(in) :: result
      type(log_type), intent(inout) :: log
      integer :: k

      if (.not. allocated(result%subsurface)) return
      if (spec%material_model == material_model%viscoelastic) then
         if (any(spec%material%fg > 0.0_wp .and. spec%material%tc > 0.0_wp)) call log%warning("displacements below the surface &
            &are those of the moduli GG, without the memory of viscoelastic bodies; stresses do not depend on it")
      end if
      do k = 1, size(result%subsurface)
         if (result%subsurface(k)%stepped == 0) cycle
         call log%warning("subsurface block " // integer_text(k) // ": " // integer_text(result%subsurface(k)%stepped) // &
            & " points lie less than DX/4 = " // real_text(stepped_depth(result%grid)) // " mm below the surface and off " // &
            & "the centres of elements. Tractions are constant on elements: stresses at their edges are not those of the " // &
            & "bodies. Use depths of DX/4 and more, or the centres of elements (ISUBS 1 to 7)")
      end do
   end subroutine warn_of_subsurface

   !> Bounding box of the elements in contact, extended by one element on each side; empty for a single element, which serves to
   !> study constant tractions
   pure function around_contact(patch) result(area)
      type(patch_result), intent(in) :: patch
      type(potential_contact) :: area
      type(bounding_box) :: box

      area = patch%grid
      box = contact_box(patch%division)
      area%xl = area%xl + (box%ix0 - 2)*area%dx
      area%yl = area%yl + (box%iy0 - 2)*area%dy
      area%mx = merge(box%ix1 - box%ix0 + 3, 0, patch%ncon > 1)
      area%my = box%iy1 - box%iy0 + 3
   end function around_contact

   !> Memory required for the stresses of a case [bytes]
   pure integer(long) function stress_memory(spec, grid) result(bytes)
      type(case_spec), intent(in) :: spec
      !> Grid with its numbers of columns and rows
      type(potential_contact), intent(in) :: grid
      type(point_set) :: points
      integer :: k

      bytes = 0_long
      if (.not. spec%has_stress .or. .not. allocated(spec%subsurface%blocks)) return
      do k = 1, size(spec%subsurface%blocks)
         call expand_points(spec%subsurface%blocks(k), grid, points)
         bytes = bytes + bytes_per_point*points%n()
      end do
   end function stress_memory

   !> Displacements and stresses in one block
   subroutine block_stresses(load, block, area, limits, result, error, shelf)
      type(surface_load), intent(in) :: load
      type(point_block), intent(in) :: block
      !> The elements in contact and their neighbours
      type(potential_contact), intent(in) :: area
      type(case_limits), intent(in) :: limits
      type(subsurface_result), intent(out) :: result
      type(error_type), allocatable, intent(out) :: error
      !> See subsurface_stresses
      type(response_shelf), intent(inout), optional :: shelf
      type(point_set) :: points
      character(len=160) :: text
      integer :: n

      call expand_points(block, load%grid, points)
      if (points%n() > max_points) then
         write(text, "(A, I0, A, I0, A)") "the block has ", points%n(), " points, more than ", max_points, &
            & " are not computed at once; several smaller blocks"
         call fatal_error(error, trim(text))
      else
         call limits%check(points%n(), bytes_per_point, "points below the surface", error)
         if (.not. allocated(error)) call require_memory(points%n(), bytes_per_point, "points below the surface", error)
      end if
      if (allocated(error)) return
      n = int(points%n())
      result%nx = size(points%x)
      result%ny = size(points%y)
      result%nz = size(points%z)
      ! without columns in the grid there are no rows and depths either: their coordinates are those of points
      if (n == 0) then
         result%nx = 0
         result%ny = 0
         result%nz = 0
      end if
      allocate(result%position(3, n), result%displacement(3, n), result%stress(6, n))
      allocate(result%sighyd(n), result%sigvm(n), result%sigtr(n), result%sigma1(n), result%sigma2(n), result%sigma3(n))
      call list_points(points, result%position)
      result%stepped = stepped_points(points, area)
      call subsurface_field(load, points, result%displacement, result%stress, shelf)
      call stress_invariants(result%stress, result%sighyd, result%sigvm, result%sigtr, result%sigma1, result%sigma2, &
         & result%sigma3)
   end subroutine block_stresses
end module contact_cases_subsurface
