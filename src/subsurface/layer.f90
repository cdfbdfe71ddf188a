!> Fields in many points at element centres and at one depth
!>
!> The response in such a point to a load on an element depends on the difference of their column
!> and row numbers only. A table of responses by these differences replaces logarithms by
!> products: 27 numbers per pair of point and element.
module contact_subsurface_layer
   use contact_base_kinds, only : long, wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_subsurface_element_field, only : add_loads, combine_field, hooke, n_derivatives, &
      & rectangle_derivatives, turn_back
   implicit none (type, external)
   private

   public :: layer_offsets, layer_end, place_layer, layer_field

   !> Columns and rows of the points of a layer; they may lie outside the grid
   type :: layer_offsets
      integer, allocatable :: ix(:), iy(:)
      !> Ranges of differences point minus element that occur
      integer :: kx0 = 0, kx1 = -1, ky0 = 0, ky1 = -1
   end type layer_offsets

   !> Points this close to a centre, per side of an element, are taken to lie on it
   real(wp), parameter :: on_centre = 1.0e-9_wp
   !> Largest number of differences in a table, some 200 MB
   integer(long), parameter :: largest_table = 1000000_long
   !> Cost of one entry of the table, in evaluations of one corner
   integer(long), parameter :: entry_cost = 5_long

contains

   !> Last of the points that follow each other at one depth
   pure integer function layer_end(position, first) result(last)
      !> Points [mm], shape (3, n)
      real(wp), intent(in) :: position(:, :)
      integer, intent(in) :: first

      last = first
      do while (last < size(position, 2))
         if (position(3, last + 1) /= position(3, first)) exit
         last = last + 1
      end do
   end function layer_end

   !> Find the columns and rows of the points, and whether a table pays off
   pure subroutine place_layer(grid, position, n_corners, offsets, worthwhile)
      type(potential_contact), intent(in) :: grid
      !> Points at one depth [mm], shape (3, n)
      real(wp), intent(in) :: position(:, :)
      !> Number of corners that would be summed for each point otherwise
      integer, intent(in) :: n_corners
      type(layer_offsets), intent(out) :: offsets
      !> False also if a point does not lie on a centre
      logical, intent(out) :: worthwhile
      real(wp) :: column, row
      integer(long) :: entries
      integer :: n, point

      worthwhile = .false.
      n = size(position, 2)
      if (n < 2*entry_cost) return
      allocate(offsets%ix(n), offsets%iy(n))
      do point = 1, n
         column = (position(1, point) - grid%xl)/grid%dx + 0.5_wp
         row = (position(2, point) - grid%yl)/grid%dy + 0.5_wp
         ! also leaves for NaN
         if (.not. (abs(column) <= real(largest_table, wp) .and. abs(row) <= real(largest_table, wp))) return
         offsets%ix(point) = nint(column)
         offsets%iy(point) = nint(row)
         if (abs(column - offsets%ix(point)) > on_centre .or. abs(row - offsets%iy(point)) > on_centre) return
      end do
      offsets%kx0 = minval(offsets%ix) - grid%mx
      offsets%kx1 = maxval(offsets%ix) - 1
      offsets%ky0 = minval(offsets%iy) - grid%my
      offsets%ky1 = maxval(offsets%iy) - 1
      entries = int(offsets%kx1 - offsets%kx0 + 1, long)*(offsets%ky1 - offsets%ky0 + 1)
      worthwhile = entries <= largest_table .and. entry_cost*entries < int(n, long)*n_corners
   end subroutine place_layer

   !> Displacements and stresses in the points of a layer
   subroutine layer_field(grid, offsets, pn, px, py, gg, nu, z, displacement, stress)
      type(potential_contact), intent(in) :: grid
      type(layer_offsets), intent(in) :: offsets
      !> Tractions on body 1 [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: pn(:, :), px(:, :), py(:, :)
      !> Modulus of rigidity [N/mm2] and Poisson's ratio [-] of body 1 and 2
      real(wp), intent(in) :: gg(2), nu(2)
      !> Depth of the layer [mm]
      real(wp), intent(in) :: z
      !> Displacements [mm], shape (3, n), and stresses [N/mm2], shape (6, n)
      real(wp), contiguous, intent(out) :: displacement(:, :), stress(:, :)
      !> Displacements and stresses per unit load: 9 of them, 3 loads, differences
      real(wp), allocatable :: response(:, :, :, :)
      real(wp) :: total(9)
      integer :: body, ix, iy, kx, ky, point

      body = merge(1, 2, z >= 0.0_wp)
      allocate(response(9, 3, offsets%kx0:offsets%kx1, offsets%ky0:offsets%ky1))
      !$omp parallel do default(shared) private(kx) schedule(dynamic)
      do ky = offsets%ky0, offsets%ky1
         do kx = offsets%kx0, offsets%kx1
            call unit_responses(kx*grid%dx, ky*grid%dy, z, grid%dx, grid%dy, gg(body), nu(body), &
               & response(:, :, kx, ky))
         end do
      end do
      !$omp end parallel do

      !$omp parallel do default(shared) private(total, ix, iy, kx, ky) schedule(dynamic, 16)
      do point = 1, size(displacement, 2)
         total = 0.0_wp
         do iy = 1, grid%my
            ky = offsets%iy(point) - iy
            do ix = 1, grid%mx
               if (pn(ix, iy) == 0.0_wp .and. px(ix, iy) == 0.0_wp .and. py(ix, iy) == 0.0_wp) cycle
               kx = offsets%ix(point) - ix
               total = total + px(ix, iy)*response(:, 1, kx, ky) + py(ix, iy)*response(:, 2, kx, ky) &
                  & + pn(ix, iy)*response(:, 3, kx, ky)
            end do
         end do
         displacement(:, point) = total(1:3)
         stress(:, point) = total(4:9)
      end do
      !$omp end parallel do
   end subroutine layer_field

   !> Displacements and stresses by unit tractions px, py, pn on one element
   pure subroutine unit_responses(x, y, z, dx, dy, gg, nu, response)
      !> Point relative to the centre of the element, in contact coordinates [mm]
      real(wp), intent(in) :: x, y, z
      !> Sides of the element [mm]
      real(wp), intent(in) :: dx, dy
      !> Modulus of rigidity [N/mm2] and Poisson's ratio [-] of the body of the point
      real(wp), intent(in) :: gg, nu
      !> Three displacements and six stresses for each of the loads
      real(wp), intent(out) :: response(9, 3)
      real(wp) :: d(n_derivatives), total(n_derivatives, 3), load(3), gradient(3, 3), mirror
      integer :: t

      mirror = merge(1.0_wp, -1.0_wp, z >= 0.0_wp)
      call rectangle_derivatives([x, mirror*y, mirror*z], dx, dy, d)
      do t = 1, 3
         load = 0.0_wp
         load(t) = merge(mirror, 1.0_wp, t == 1)
         total = 0.0_wp
         call add_loads(d, load, total)
         call combine_field(total, mirror*z, gg, nu, response(1:3, t), gradient)
         if (mirror < 0.0_wp) call turn_back(response(1:3, t), gradient)
         response(4:9, t) = hooke(gradient, gg, nu)
      end do
   end subroutine unit_responses
end module contact_subsurface_layer
