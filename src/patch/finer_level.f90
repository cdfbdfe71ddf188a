!> A solution interpolated to other elements of the same window: initial values of the iterations on a finer grid
module contact_patch_finer_level
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_problem, only : carried, memory_field, traction_fields
   implicit none (type, external)
   private

   public :: interpolate_fields

contains

   !> Interpolate tractions between the centres of the old elements, bilinear; zero outside the old window
   subroutine interpolate_fields(grid, fields)
      !> Grid of the new elements
      type(potential_contact), intent(in) :: grid
      !> On entry on the old elements, on exit on the new ones, without the memory carried by particles
      type(traction_fields), intent(inout) :: fields
      type(traction_fields) :: old
      integer :: first(2, max(grid%mx, grid%my))
      real(wp) :: part(2, max(grid%mx, grid%my))
      integer :: ix, iy, kind

      if (.not. allocated(fields%pn)) return
      old%grid = fields%grid
      call move_alloc(fields%division, old%division)
      call move_alloc(fields%pn, old%pn)
      call move_alloc(fields%px, old%px)
      call move_alloc(fields%py, old%py)
      fields%grid = grid
      if (allocated(fields%rate)) deallocate(fields%rate)
      do kind = 1, carried%count
         fields%memory(kind) = memory_field()
      end do
      allocate(fields%pn(grid%mx, grid%my), fields%px(grid%mx, grid%my), fields%py(grid%mx, grid%my))
      allocate(fields%division(grid%mx, grid%my), source=element%exterior)
      call place((grid%x([(ix, ix=1, grid%mx)]) - old%grid%x(1))/old%grid%dx, first(1, :grid%mx), part(1, :grid%mx))
      call place((grid%y([(iy, iy=1, grid%my)]) - old%grid%y(1))/old%grid%dy, first(2, :grid%my), part(2, :grid%my))
      do iy = 1, grid%my
         do ix = 1, grid%mx
            fields%pn(ix, iy) = value_at(old%pn, first(1, ix), first(2, iy), part(1, ix), part(2, iy))
            fields%px(ix, iy) = value_at(old%px, first(1, ix), first(2, iy), part(1, ix), part(2, iy))
            fields%py(ix, iy) = value_at(old%py, first(1, ix), first(2, iy), part(1, ix), part(2, iy))
            if (.not. fields%pn(ix, iy) > 0.0_wp) cycle
            fields%division(ix, iy) = max(element%adhesion, old%division( &
               & min(old%grid%mx, max(1, first(1, ix) + nint(part(1, ix)))), &
               & min(old%grid%my, max(1, first(2, iy) + nint(part(2, iy))))))
         end do
      end do
   end subroutine interpolate_fields

   !> The last element whose centre is at or before a point, and the distance of the point from this centre
   elemental subroutine place(distance, first, part)
      !> Distance from the centre of the first element [elements]
      real(wp), intent(in) :: distance
      !> Index of the element, 0 or less before the first one
      integer, intent(out) :: first
      !> Distance from its centre [elements], 0 to 1
      real(wp), intent(out) :: part

      first = floor(distance) + 1
      part = distance - floor(distance)
   end subroutine place

   !> Value interpolated between four centres, zero outside the field
   pure real(wp) function value_at(field, ix, iy, a, b) result(value)
      real(wp), intent(in) :: field(:, :)
      !> Indices of the element before the point
      integer, intent(in) :: ix, iy
      !> Distances from its centre [elements]
      real(wp), intent(in) :: a, b
      integer :: i, k

      value = 0.0_wp
      do k = max(1, iy), min(size(field, 2), iy + 1)
         do i = max(1, ix), min(size(field, 1), ix + 1)
            value = value + merge(a, 1.0_wp - a, i > ix)*merge(b, 1.0_wp - b, k > iy)*field(i, k)
         end do
      end do
   end function value_at
end module contact_patch_finer_level
