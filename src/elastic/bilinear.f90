!> Influence coefficients of homogeneous half-spaces, continuous bilinear tractions
!>
!> The basis function of an element is the hat of height 1 over 2 dx by 2 dy. Near the element a coefficient is the mixed second
!> difference of a fourth antiderivative of the point kernel over nine points. This difference loses as many digits as
!> (distance/element)^4 has and is therefore computed in extended precision. Further away, where the kernel is smooth on the
!> scale of an element, the coefficient is the mean of that of the rectangle over one cell, by Gauss quadrature with three
!> points in each direction.
module contact_elastic_bilinear
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_elastic_corners, only : combine_corners, corner_functions
   use contact_elastic_halfspace, only : kernel_table, set_entry, set_mirrored, shape_table
   use contact_elastic_material, only : combined_material
   implicit none (type, external)
   private

   public :: fill_bilinear, fill_shifted_bilinear

   !> Extended precision for the near field; working precision if there is no other
   integer, parameter :: long = max(selected_real_kind(30), wp)
   !> Beyond this distance, in longer element sides, the mean over a cell is used
   real(wp), parameter :: far = 20.0_wp

contains

   !> All coefficients without shift: one quadrant is computed, the others follow by symmetry
   subroutine fill_bilinear(table, material, dx, dy, nx, ny)
      !> Receives offsets, sides and coefficients; its arrays are allocated here
      type(kernel_table), intent(inout) :: table
      !> Combined constants of both bodies
      type(combined_material), intent(in) :: material
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Maximum offsets in elements
      integer, intent(in) :: nx, ny
      real(wp), allocatable :: v(:, :, :)
      integer :: k, l

      call shape_table(table, material, dx, dy, nx, ny)
      table%shift_x = 0.0_wp
      table%shift_y = 0.0_wp
      allocate(v(6, 0:nx, 0:ny))
      call coefficients(material, dx, dy, 0, 0, 0.0_wp, 0.0_wp, v)
      do l = 0, ny
         do k = 0, nx
            call set_mirrored(table, k, l, v(:, k, l))
         end do
      end do
   end subroutine fill_bilinear

   !> All coefficients for observation points shifted by (shift_x, shift_y)
   subroutine fill_shifted_bilinear(table, material, dx, dy, nx, ny, shift_x, shift_y)
      !> Receives offsets, sides and coefficients; its arrays are allocated here
      type(kernel_table), intent(inout) :: table
      !> Combined constants of both bodies
      type(combined_material), intent(in) :: material
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Maximum offsets in elements
      integer, intent(in) :: nx, ny
      !> Shift of the observation points [mm]
      real(wp), intent(in) :: shift_x, shift_y
      real(wp), allocatable :: v(:, :, :)
      integer :: k, l

      call shape_table(table, material, dx, dy, nx, ny)
      table%shift_x = shift_x
      table%shift_y = shift_y
      allocate(v(6, -nx:nx, -ny:ny))
      call coefficients(material, dx, dy, -nx, -ny, shift_x, shift_y, v)
      do l = -ny, ny
         do k = -nx, nx
            call set_entry(table, k, l, v(:, k, l))
         end do
      end do
   end subroutine fill_shifted_bilinear

   !> Coefficients nn, xx, yy, xy, xn, yn over a range of offsets
   subroutine coefficients(material, dx, dy, k0, l0, shift_x, shift_y, v)
      type(combined_material), intent(in) :: material
      real(wp), intent(in) :: dx, dy
      !> First offsets
      integer, intent(in) :: k0, l0
      real(wp), intent(in) :: shift_x, shift_y
      real(wp), intent(out) :: v(:, k0:, l0:)
      !> Abscissae over a unit cell and weights
      real(wp), parameter :: point(3) = [-0.5_wp, 0.0_wp, 0.5_wp]*sqrt(0.6_wp)
      real(wp), parameter :: weight(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp
      real(wp), allocatable :: corner(:, :, :)
      real(long), allocatable :: node(:, :, :)
      logical, allocatable :: wanted(:, :)
      real(wp) :: x, y, limit
      integer :: k, l, i, j, k1, l1

      k1 = ubound(v, 2)
      l1 = ubound(v, 3)
      v = 0.0_wp
      allocate(corner(5, k0 - 1:k1, l0 - 1:l1))
      do j = 1, 3
         do i = 1, 3
            !$omp parallel do private(k) if (size(v) > 100000)
            do l = l0 - 1, l1
               do k = k0 - 1, k1
                  corner(:, k, l) = corner_functions((k + 0.5_wp + point(i))*dx + shift_x, (l + 0.5_wp + point(j))*dy + shift_y, &
                     & material%coupled())
               end do
            end do
            do l = l0, l1
               do k = k0, k1
                  v(:, k, l) = v(:, k, l) + weight(i)*weight(j)*combine_corners(corner(:, k, l) - corner(:, k - 1, l) &
                     & - corner(:, k, l - 1) + corner(:, k - 1, l - 1), material)
               end do
            end do
         end do
      end do

      limit = far*max(dx, dy)
      allocate(wanted(k0 - 1:k1 + 1, l0 - 1:l1 + 1), source=.false.)
      do l = l0, l1
         y = l*dy + shift_y
         do k = k0, k1
            x = k*dx + shift_x
            if (hypot(x, y) < limit) wanted(k - 1:k + 1, l - 1:l + 1) = .true.
         end do
      end do
      allocate(node(6, k0 - 1:k1 + 1, l0 - 1:l1 + 1))
      !$omp parallel do private(k) schedule(dynamic)
      do l = l0 - 1, l1 + 1
         do k = k0 - 1, k1 + 1
            if (wanted(k, l)) node(:, k, l) = node_functions(k*real(dx, long) + shift_x, l*real(dy, long) + shift_y, &
               & material%coupled())
         end do
      end do
      do l = l0, l1
         y = l*dy + shift_y
         do k = k0, k1
            x = k*dx + shift_x
            if (hypot(x, y) < limit) v(:, k, l) = combine_nodes(second_difference(node(:, k - 1:k + 1, l - 1:l + 1), dx, dy), &
               & material)
         end do
      end do
   end subroutine coefficients

   !> Mixed second difference over nine points, divided by the area of an element
   pure function second_difference(f, dx, dy) result(d)
      real(long), intent(in) :: f(6, 3, 3)
      real(wp), intent(in) :: dx, dy
      real(wp) :: d(6)
      real(long) :: row(6, 3)

      row = f(:, 1, :) - 2*f(:, 2, :) + f(:, 3, :)
      d = real((row(:, 1) - 2*row(:, 2) + row(:, 3))/(real(dx, long)*real(dy, long)), wp)
   end function second_difference

   !> Fourth antiderivatives (twice by x, twice by y) of 1/r, x2/r3, y2/r3, xy/r3, x/r2, y/r2
   pure function node_functions(x, y, coupled) result(f)
      real(long), intent(in) :: x, y
      logical, intent(in) :: coupled
      real(long) :: f(6), r, lx, ly, ax, ay

      r = hypot(x, y)
      ! ln(y + r) is asinh(y/|x|) + ln|x|; the last term cancels in the second difference over y
      lx = 0.0_long
      ly = 0.0_long
      if (y /= 0.0_long) lx = asinh(x/abs(y))
      if (x /= 0.0_long) ly = asinh(y/abs(x))
      f = 0.0_long
      f(1) = 0.5_long*x*y*(x*ly + y*lx) - r**3/6
      f(2) = 0.5_long*x*y**2*lx + x**2*r/6 - y**2*r/3
      f(3) = 0.5_long*y*x**2*ly + y**2*r/6 - x**2*r/3
      f(4) = -x*y*r/3 - (x**3*ly + y**3*lx)/6
      if (.not. coupled .or. r <= 0.0_long) return
      ax = 0.0_long
      ay = 0.0_long
      if (x /= 0.0_long) ax = atan(y/x)
      if (y /= 0.0_long) ay = atan(x/y)
      f(5) = x*(3*y**2 - x**2)*log(r)/6 + 0.5_long*x**2*y*ax + y**3*ay/6
      f(6) = y*(3*x**2 - y**2)*log(r)/6 + 0.5_long*y**2*x*ay + x**3*ax/6
   end function node_functions

   !> From differences of the node functions to nn, xx, yy, xy, xn, yn
   pure function combine_nodes(d, material) result(v)
      real(wp), intent(in) :: d(6)
      type(combined_material), intent(in) :: material
      real(wp) :: v(6), factor

      factor = 1.0_wp/(pi*material%gg)
      v(1) = factor*(1.0_wp - material%nu)*d(1)
      v(2) = factor*((1.0_wp - material%nu)*d(1) + material%nu*d(2))
      v(3) = factor*((1.0_wp - material%nu)*d(1) + material%nu*d(3))
      v(4) = factor*material%nu*d(4)
      v(5) = -factor*material%ak*d(5)
      v(6) = -factor*material%ak*d(6)
   end function combine_nodes
end module contact_elastic_bilinear
