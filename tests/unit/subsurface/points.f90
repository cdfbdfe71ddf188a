!> Expansion of blocks of subsurface points
program test_subsurface_points
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_subsurface_points, only : expand_points, list_points, point_block, point_selection, point_set
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("subsurface points")
   call run(suite)
   call suite%finish()

contains

   subroutine run(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid
      type(point_block) :: block
      real(wp), allocatable :: position(:, :)
      integer :: nx, ny, nz

      grid = potential_contact(mx=5, my=3, xl=-5.0_wp, yl=0.0_wp, dx=2.0_wp, dy=1.0_wp)
      block%z = [0.5_wp, 0.75_wp]
      call expand(block, grid, nx, ny, nz, position)
      call suite%check(all([nx, ny, nz, size(position, 2)] == [5, 3, 2, 30]), "all elements")
      call suite%close_to(position(:, 1), [-4.0_wp, 0.5_wp, 0.5_wp], 1e-14_wp, "first point")
      call suite%close_to(position(:, 2), [-2.0_wp, 0.5_wp, 0.5_wp], 1e-14_wp, "x runs fastest")
      call suite%close_to(position(:, 6), [-4.0_wp, 1.5_wp, 0.5_wp], 1e-14_wp, "then y")
      call suite%close_to(position(:, 30), [4.0_wp, 2.5_wp, 0.75_wp], 1e-14_wp, "last point")

      block%selection = point_selection%ranges
      block%ixl = -2
      block%ixinc = 2
      block%ixh = 100
      block%iyl = 2
      block%iyinc = 0
      block%iyh = 2
      call expand(block, grid, nx, ny, nz, position)
      call suite%check(nx == 2 .and. ny == 1, "ranges are clipped: columns -2, 0, 2, 4 keep 2 and 4")
      call suite%close_to(position(1, 1:2), [-2.0_wp, 2.0_wp], 1e-14_wp, "columns 2 and 4")
      call suite%close_to(position(2, 1), 1.5_wp, 1e-14_wp, "row 2")

      block%selection = point_selection%lists
      block%ix = [4, 9, 1, 4, 0]
      block%iy = [3, 2]
      call expand(block, grid, nx, ny, nz, position)
      call suite%check(nx == 2 .and. ny == 2, "lists are sorted, clipped and without repetition")
      call suite%close_to(position(1, 1:2), [-4.0_wp, 2.0_wp], 1e-14_wp, "columns 1 and 4")
      block%ix = [7]
      call expand(block, grid, nx, ny, nz, position)
      call suite%check(nx == 0 .and. size(position, 2) == 0, "nothing inside the window: an empty block")

      block%selection = point_selection%free
      block%x = [3.0_wp, -1.0_wp, 3.0_wp]
      block%y = [0.0_wp]
      block%z = [1.0_wp, -1.0_wp]
      call expand(block, grid, nx, ny, nz, position)
      call suite%close_to(position(1, :), [-1.0_wp, 3.0_wp, 3.0_wp, -1.0_wp, 3.0_wp, 3.0_wp], 0.0_wp, "free x")
      call suite%close_to(position(3, [1, 4]), [-1.0_wp, 1.0_wp], 0.0_wp, "free z, sorted")
      deallocate(block%y)
      call expand(block, grid, nx, ny, nz, position)
      call suite%check(nx == 3 .and. ny == 0 .and. size(position, 2) == 0, "no list of y: an empty block")
      block%selection = point_selection%lists
      deallocate(block%ix)
      call expand(block, grid, nx, ny, nz, position)
      call suite%check(nx == 0 .and. ny == 2, "no list of columns: an empty block")
   end subroutine run

   !> Numbers and positions of the points of a block
   subroutine expand(block, grid, nx, ny, nz, position)
      type(point_block), intent(in) :: block
      type(potential_contact), intent(in) :: grid
      integer, intent(out) :: nx, ny, nz
      real(wp), allocatable, intent(out) :: position(:, :)
      type(point_set) :: points

      call expand_points(block, grid, points)
      nx = size(points%x)
      ny = size(points%y)
      nz = size(points%z)
      allocate(position(3, points%n()))
      call list_points(points, position)
   end subroutine expand
end program test_subsurface_points
