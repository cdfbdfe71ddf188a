!> Subsurface stresses of one contact patch: blocks of points in, fields out
module contact_cases_subsurface
   use contact_base_choices, only : kernel_model
   use contact_base_error, only : add_context, error_type, fatal_error
   use contact_base_kinds, only : long
   use contact_base_memory, only : require_memory
   use contact_cases_spec, only : case_spec
   use contact_patch_result, only : patch_result, subsurface_result
   use contact_subsurface_invariants, only : stress_invariants
   use contact_subsurface_load, only : new_surface_load, surface_load
   use contact_subsurface_points, only : expand_points, list_points, point_block, point_set
   use contact_subsurface_stress, only : subsurface_field
   use contact_wheelrail_result, only : mirrored
   implicit none (type, external)
   private

   public :: subsurface_stresses

   !> Most points of one block, some 3 GB
   integer(long), parameter :: most_points = 20000000_long
   !> The results of a point, its place included, and as much again while they are computed
   integer(long), parameter :: bytes_per_point = 300_long

contains

   !> Displacements, stresses and their invariants in the blocks of points of a case
   subroutine subsurface_stresses(spec, result, error, left)
      type(case_spec), intent(in) :: spec
      !> A solved patch; columns and rows of the blocks are those of its grid
      type(patch_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      !> Does the patch belong to a wheel on the left side, of which it is the mirror image? Points and results are then
      !> in the coordinates of the left side. Default: no
      logical, intent(in), optional :: left
      type(surface_load) :: load
      character(len=60) :: text
      integer :: k
      logical :: mirror

      if (allocated(result%subsurface)) deallocate(result%subsurface)
      if (.not. allocated(spec%subsurface%blocks)) return
      mirror = .false.
      if (present(left)) mirror = left
      if (mirror) then
         call take_load(mirrored(result))
      else
         call take_load(result)
      end if
      allocate(result%subsurface(size(spec%subsurface%blocks)))
      do k = 1, size(result%subsurface)
         call block_stresses(load, spec%subsurface%blocks(k), result%subsurface(k), error)
         if (.not. allocated(error)) cycle
         write(text, '(A, I0)') "subsurface block ", k
         call add_context(error, trim(text))
         deallocate(result%subsurface)
         return
      end do

   contains

      subroutine take_load(patch)
         type(patch_result), intent(in) :: patch

         call new_surface_load(load, patch%grid, patch%pn, patch%px, patch%py, spec%material%gg, spec%material%poiss, &
            & spec%kernel == kernel_model%bilinear)
      end subroutine take_load
   end subroutine subsurface_stresses

   !> One block
   subroutine block_stresses(load, block, result, error)
      type(surface_load), intent(in) :: load
      type(point_block), intent(in) :: block
      type(subsurface_result), intent(out) :: result
      type(error_type), allocatable, intent(out) :: error
      type(point_set) :: points
      character(len=160) :: text
      integer :: n

      call expand_points(block, load%grid, points)
      if (points%n() > most_points) then
         write(text, '(A, I0, A, I0, A)') "the block has ", points%n(), " points, more than ", most_points, &
            & " are not computed at once; several smaller blocks"
         call fatal_error(error, trim(text))
      else
         call require_memory(points%n(), bytes_per_point, "points below the surface", error)
      end if
      if (allocated(error)) return
      n = int(points%n())
      result%nx = size(points%x)
      result%ny = size(points%y)
      result%nz = size(points%z)
      allocate(result%position(3, n), result%displacement(3, n), result%stress(6, n))
      allocate(result%sighyd(n), result%sigvm(n), result%sigtr(n), result%sigma1(n), result%sigma2(n), result%sigma3(n))
      call list_points(points, result%position)
      call subsurface_field(load, points, result%displacement, result%stress)
      call stress_invariants(result%stress, result%sighyd, result%sigvm, result%sigtr, result%sigma1, result%sigma2, &
         & result%sigma3)
   end subroutine block_stresses
end module contact_cases_subsurface
