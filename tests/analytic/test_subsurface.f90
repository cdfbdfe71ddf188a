!> Subsurface stresses against closed forms, quadrature, equilibrium and symmetry
program test_subsurface
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_subsurface_element_field, only : add_loads, combine_field, corner_derivatives, gauss_point, &
      & gauss_weight, n_derivatives, rectangle_field, source_derivatives
   use contact_subsurface_stress, only : principal_stresses, stress_invariants, subsurface_field
   use contact_test_harness, only : reference_folder, test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("subsurface")
   call point_loads(suite)
   call corner_sum_is_integral(suite)
   call far_and_near_agree(suite)
   call one_element_example(suite)
   call one_element_file(suite)
   call hertz_on_axis(suite)
   call surface_tractions(suite)
   call equilibrium(suite)
   call reflections(suite)
   call sum_over_elements(suite)
   call layers(suite)
   call special_points(suite)
   call invariants(suite)
   call suite%finish()

contains

   !> Boussinesq and Cerruti, as in Johnson (1985)
   subroutine point_loads(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: x = 0.7_wp, y = -0.4_wp, z = 0.9_wp, gg = 1.3_wp, nu = 0.3_wp
      real(wp) :: d(n_derivatives), total(n_derivatives, 3), u(3), du(3, 3), s(6), r

      r = sqrt(x**2 + y**2 + z**2)
      call source_derivatives(x, y, z, d)
      total = 0.0_wp
      call add_loads(d, [0.0_wp, 0.0_wp, 1.0_wp], total)
      call combine_field(total, z, gg, nu, u, du)
      s = stress_of(du, gg, nu)
      call suite%close_to(u(1), (x*z/r**3 - (1.0_wp - 2.0_wp*nu)*x/(r*(r + z)))/(4.0_wp*pi*gg), 1e-15_wp, "Boussinesq ux")
      call suite%close_to(u(3), (z**2/r**3 + 2.0_wp*(1.0_wp - nu)/r)/(4.0_wp*pi*gg), 1e-15_wp, "Boussinesq uz")
      call suite%close_to(s([3, 5, 6]), -1.5_wp*z**2/(pi*r**5)*[x, y, z], 1e-14_wp, "Boussinesq stresses")
      total = 0.0_wp
      call add_loads(d, [1.0_wp, 0.0_wp, 0.0_wp], total)
      call combine_field(total, z, gg, nu, u, du)
      s = stress_of(du, gg, nu)
      call suite%close_to(u(1), (1.0_wp/r + x**2/r**3 + (1.0_wp - 2.0_wp*nu)*(1.0_wp/(r + z) &
         & - x**2/(r*(r + z)**2)))/(4.0_wp*pi*gg), 1e-15_wp, "Cerruti ux")
      call suite%close_to(u(2), (x*y/r**3 - (1.0_wp - 2.0_wp*nu)*x*y/(r*(r + z)**2))/(4.0_wp*pi*gg), &
         & 1e-15_wp, "Cerruti uy")
      call suite%close_to(u(3), (x*z/r**3 + (1.0_wp - 2.0_wp*nu)*x/(r*(r + z)))/(4.0_wp*pi*gg), 1e-15_wp, "Cerruti uz")
      call suite%close_to(s([3, 5, 6]), -1.5_wp*x*z/(pi*r**5)*[x, y, z], 1e-14_wp, "Cerruti stresses")
   end subroutine point_loads

   !> The closed form is the integral of the point load over the rectangle
   subroutine corner_sum_is_integral(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: dx = 1.0_wp, dy = 0.6_wp, nu = 0.28_wp, load(3) = [0.3_wp, -0.7_wp, 1.0_wp]
      real(wp), parameter :: place(3, 5) = reshape([0.0_wp, 0.0_wp, 0.5_wp,  0.5_wp, 0.1_wp, 0.4_wp, &
         & -0.5_wp, -0.3_wp, 0.4_wp,  -2.0_wp, -3.0_wp, 0.2_wp,  0.2_wp, -2.0_wp, 1.0e-4_wp], [3, 5])
      integer, parameter :: panels = 40
      real(wp) :: d(n_derivatives), total(n_derivatives, 3), u(3), du(3, 3), u_ref(3), du_ref(3, 3), xs, ys
      integer :: i, ip, j, jp, n

      do n = 1, size(place, 2)
         total = 0.0_wp
         do jp = 1, panels
            do ip = 1, panels
               do j = 1, 4
                  do i = 1, 4
                     xs = ((ip - 0.5_wp + gauss_point(i))/panels - 0.5_wp)*dx
                     ys = ((jp - 0.5_wp + gauss_point(j))/panels - 0.5_wp)*dy
                     call source_derivatives(place(1, n) - xs, place(2, n) - ys, place(3, n), d)
                     call add_loads(d, gauss_weight(i)*gauss_weight(j)*dx*dy/panels**2*load, total)
                  end do
               end do
            end do
         end do
         call combine_field(total, place(3, n), 1.0_wp, nu, u_ref, du_ref)
         call rectangle_field(place(:, n), dx, dy, load, 1.0_wp, nu, u, du)
         call suite%close_to(norm2(u - u_ref)/norm2(u_ref), 0.0_wp, 1e-12_wp, "displacements by quadrature")
         call suite%close_to(norm2(du - du_ref)/norm2(du_ref), 0.0_wp, 1e-12_wp, "gradients by quadrature")
      end do
   end subroutine corner_sum_is_integral

   !> The far field by quadrature joins the near field by corners
   subroutine far_and_near_agree(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: way(3) = [0.6_wp, -0.48_wp, 0.64_wp], load(3) = [0.3_wp, -0.7_wp, 1.0_wp]
      real(wp) :: near_u(3), near_du(3, 3), far_u(3), far_du(3, 3), u(3), du(3, 3), d(n_derivatives), total(n_derivatives, 3)

      call rectangle_field(19.99999_wp*way, 1.0_wp, 1.0_wp, load, 1.0_wp, 0.3_wp, near_u, near_du)
      call rectangle_field(20.00001_wp*way, 1.0_wp, 1.0_wp, load, 1.0_wp, 0.3_wp, far_u, far_du)
      ! the change over this distance follows from the decay with 1/R and 1/R**2
      call suite%close_to(norm2(near_u - far_u*20.00001_wp/19.99999_wp)/norm2(far_u), 0.0_wp, 1e-8_wp, "displacements join")
      call suite%close_to(norm2(near_du - far_du*(20.00001_wp/19.99999_wp)**2)/norm2(far_du), 0.0_wp, 1e-8_wp, &
         & "gradients join")
      call quadrant_sum(20.00001_wp*way, load, total)
      call combine_field(total, 20.00001_wp*way(3), 1.0_wp, 0.3_wp, u, du)
      call suite%close_to(norm2(u - far_u)/norm2(u), 0.0_wp, 1e-12_wp, "displacements at the switch")
      call suite%close_to(norm2(du - far_du)/norm2(du), 0.0_wp, 1e-11_wp, "gradients at the switch")
      call rectangle_field(1.0e5_wp*way, 1.0_wp, 1.0_wp, load, 1.0_wp, 0.3_wp, far_u, far_du)
      call source_derivatives(1.0e5_wp*way(1), 1.0e5_wp*way(2), 1.0e5_wp*way(3), d)
      total = 0.0_wp
      call add_loads(d, load, total)
      call combine_field(total, 1.0e5_wp*way(3), 1.0_wp, 0.3_wp, u, du)
      call suite%close_to(norm2(du - far_du)/norm2(du), 0.0_wp, 1e-9_wp, "very far: a point load")
   end subroutine far_and_near_agree

   !> Corner sum of the unit square
   subroutine quadrant_sum(position, load, total)
      real(wp), intent(in) :: position(3), load(3)
      real(wp), intent(out) :: total(n_derivatives, 3)
      real(wp) :: d(n_derivatives)
      integer :: i, j

      total = 0.0_wp
      do j = -1, 1, 2
         do i = -1, 1, 2
            call corner_derivatives(position(1) + 0.5_wp*i, position(2) + 0.5_wp*j, position(3), 1e-7_wp, d)
            call add_loads(d, i*j*load, total)
         end do
      end do
   end subroutine quadrant_sum

   !> Values on the axis of Kalker's example, printed with six digits
   subroutine one_element_example(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: z(4) = [0.0_wp, 0.5_wp, 1.0_wp, 5.0_wp]
      real(wp) :: position(3, 4), u(3, 4), s(6, 4), inv(4, 5)

      position(1:2, :) = 1e-5_wp
      position(3, :) = z
      call example_field(position, u, s)
      call stress_invariants(s, inv(:, 1), inv(:, 2), inv(:, 3), inv(:, 4), inv(:, 5))
      call suite%close_to(u(1, :), [0.482073_wp, 0.175332_wp, 0.094955_wp, 0.019385_wp], 6e-7_wp, "ux")
      call suite%close_to(u(3, :), [0.403982_wp, 0.265146_wp, 0.170498_wp, 0.038600_wp], 6e-7_wp, "uz")
      call suite%close_to(inv(:, 1), [-0.853264_wp, -0.284416_wp, -0.109379_wp, -5.3787e-3_wp], 6e-7_wp, "sighyd")
      call suite%close_to(inv(:, 2), [1.74426_wp, 0.676093_wp, 0.342630_wp, 0.020110_wp], 6e-6_wp, "sigvm")
      call suite%close_to(s(:, 1), [-0.779815_wp, 1.2305e-4_wp, -0.998999_wp, -0.779977_wp, 0.0_wp, -1.0_wp], &
         & 1.1e-6_wp, "stresses at the surface")
      call suite%close_to(inv(1, 3:5), [2.010_wp, 0.115_wp, -1.895_wp], 6e-4_wp, "Tresca and principal stresses")
   end subroutine one_element_example

   !> Pressure 1, traction 0.999 on one element of 1 by 1, off centre as in the example
   subroutine example_field(position, u, s)
      real(wp), intent(in), contiguous :: position(:, :)
      real(wp), intent(out), contiguous :: u(:, :), s(:, :)
      type(potential_contact) :: grid
      real(wp) :: pn(1, 1), px(1, 1), py(1, 1)

      grid = potential_contact(1, 1, -0.4999_wp, -0.4998_wp, 1.0_wp, 1.0_wp)
      pn = 1.0_wp
      px = 0.999_wp
      py = 0.0_wp
      call subsurface_field(grid, pn, px, py, [1.0_wp, 1.0_wp], [0.28_wp, 0.28_wp], position, u, s)
   end subroutine example_field

   !> All 6630 points of the stored result of the example
   subroutine one_element_file(suite)
      type(test_suite), intent(inout) :: suite
      character(len=:), allocatable :: folder
      character(len=400) :: line
      real(wp), allocatable :: table(:, :), u(:, :), s(:, :), inv(:, :), reference(:), actual(:), position(:, :)
      real(wp) :: row(14)
      integer :: bad, n, status, unit, point

      folder = reference_folder()
      if (len(folder) == 0) then
         call suite%skip("stored example", "no reference data")
         return
      end if
      allocate(table(14, 7000))
      n = 0
      open(newunit=unit, file=folder // "/examples/subsurf.ref_subs", status="old", action="read", iostat=status)
      call suite%check(status == 0, "subsurf.ref_subs can be read")
      if (status /= 0) return
      do
         read(unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (index(line, "%") > 0) cycle
         ! the line with the numbers of points has three integers
         if (index(line(1:16), ".") == 0) cycle
         read(line, *, iostat=status) row
         if (status /= 0) exit
         n = n + 1
         table(:, n) = row
      end do
      close(unit)
      call suite%equal(n, 6630, "number of points")
      allocate(u(3, n), s(6, n), inv(n, 5), position(3, n), source=0.0_wp)
      position = table(1:3, 1:n)
      call example_field(position, u, s)
      call stress_invariants(s, inv(:, 1), inv(:, 2), inv(:, 3), inv(:, 4), inv(:, 5))
      ! The numbers are printed with five digits; at the surface the reference moves points that
      ! lie beside an edge by 5e-7 of the distance, and finds tractions of that order outside contact
      bad = 0
      do point = 1, n
         reference = table(4:14, point)
         actual = [u(:, point), inv(point, 1:2), s(:, point)]
         if (all(abs(actual - reference) <= merge(5e-6_wp, 1e-9_wp, position(3, point) == 0.0_wp) &
            & + 5.1e-5_wp*abs(reference))) cycle
         bad = bad + 1
         if (bad > 5) cycle
         write(*, '(a, 3es12.4)') "stored example at", table(1:3, point)
         write(*, '(11es13.5)') actual, reference
      end do
      call suite%equal(bad, 0, "points that differ from the stored example")
   end subroutine one_element_file

   !> Stresses on the axis of a Hertzian contact of spheres; second order in the element size
   subroutine hertz_on_axis(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: nu = 0.3_wp, z(4) = [0.25_wp, 0.48_wp, 1.0_wp, 2.0_wp]
      integer, parameter :: levels(3) = [16, 32, 64]
      type(potential_contact) :: grid
      real(wp), allocatable :: pn(:, :), none(:, :)
      real(wp) :: position(3, 4), u(3, 4), s(6, 4), sz(4), sr(4), err(3)
      integer :: level, m

      sz = -1.0_wp/(1.0_wp + z**2)
      sr = -(1.0_wp + nu)*(1.0_wp - z*atan(1.0_wp/z)) + 0.5_wp/(1.0_wp + z**2)
      position = 0.0_wp
      position(3, :) = z
      do level = 1, size(levels)
         m = levels(level)
         grid = potential_contact(m, m, -1.0_wp, -1.0_wp, 2.0_wp/m, 2.0_wp/m)
         call hertz_pressure(grid, pn)
         none = 0.0_wp*pn
         call subsurface_field(grid, pn, none, none, [1.0_wp, 1.0_wp], [nu, nu], position, u, s)
         err(level) = max(maxval(abs(s(6, :) - sz)), maxval(abs(s(1, :) - sr)), maxval(abs(s(4, :) - sr)))
      end do
      call suite%check(err(3) < 1e-3_wp, "Hertz stresses on the axis, 64 elements")
      call suite%check(log(err(1)/err(3))/log(4.0_wp) > 1.3_wp, "Hertz stresses converge with order above 1.3")
      write(*, '(a, 3es10.2, a, f5.2)') "Hertz: errors", err, ", order", log(err(1)/err(3))/log(4.0_wp)
   end subroutine hertz_on_axis

   !> Averages of the semi-elliptical pressure over each element, by the midpoint rule of 8 x 8
   subroutine hertz_pressure(grid, pn)
      type(potential_contact), intent(in) :: grid
      real(wp), allocatable, intent(out) :: pn(:, :)
      integer, parameter :: fine = 8
      real(wp) :: x, y
      integer :: i, ix, iy, j

      allocate(pn(grid%mx, grid%my), source=0.0_wp)
      do iy = 1, grid%my
         do ix = 1, grid%mx
            do j = 1, fine
               do i = 1, fine
                  x = grid%x(ix) + ((i - 0.5_wp)/fine - 0.5_wp)*grid%dx
                  y = grid%y(iy) + ((j - 0.5_wp)/fine - 0.5_wp)*grid%dy
                  pn(ix, iy) = pn(ix, iy) + sqrt(max(0.0_wp, 1.0_wp - x**2 - y**2))/fine**2
               end do
            end do
         end do
      end do
   end subroutine hertz_pressure

   !> Tractions that vary without any symmetry
   subroutine general_load(grid, pn, px, py)
      type(potential_contact), intent(out) :: grid
      real(wp), allocatable, intent(out) :: pn(:, :), px(:, :), py(:, :)
      integer :: ix, iy

      grid = potential_contact(5, 4, -1.3_wp, -0.7_wp, 0.5_wp, 0.4_wp)
      allocate(pn(5, 4), px(5, 4), py(5, 4))
      do iy = 1, 4
         do ix = 1, 5
            pn(ix, iy) = 1.0_wp + 0.1_wp*ix - 0.2_wp*iy + 0.07_wp*ix*iy
            px(ix, iy) = 0.3_wp - 0.05_wp*ix*iy
            py(ix, iy) = 0.2_wp*cos(1.0_wp*ix + 2.0_wp*iy)
         end do
      end do
      pn(2, 2) = 0.0_wp
      px(2, 2) = 0.0_wp
      py(2, 2) = 0.0_wp
   end subroutine general_load

   !> At the surface of both bodies the stresses balance the tractions
   subroutine surface_tractions(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid
      real(wp), allocatable :: pn(:, :), px(:, :), py(:, :)
      real(wp) :: position(3, 3), u(3, 3), s(6, 3), expected(3)
      integer :: ix, iy

      call general_load(grid, pn, px, py)
      do iy = 1, 4
         do ix = 1, 5
            position(1, :) = grid%x(ix)
            position(2, :) = grid%y(iy)
            position(3, :) = [0.0_wp, 1e-14_wp, -1e-14_wp]
            call subsurface_field(grid, pn, px, py, [1.0_wp, 2.0_wp], [0.28_wp, 0.4_wp], position, u, s)
            expected = -[px(ix, iy), py(ix, iy), pn(ix, iy)]
            call suite%close_to(s([3, 5, 6], 1), expected, 5e-13_wp, "tractions at z = 0")
            call suite%close_to(s([3, 5, 6], 2), expected, 5e-13_wp, "tractions for z to 0 in body 1")
            call suite%close_to(s([3, 5, 6], 3), expected, 5e-13_wp, "tractions for z to 0 in body 2")
         end do
      end do
      position = spread([9.0_wp, -7.0_wp, 0.0_wp], 2, 3)
      call subsurface_field(grid, pn, px, py, [1.0_wp, 2.0_wp], [0.28_wp, 0.4_wp], position, u, s)
      call suite%close_to(s([3, 5, 6], 1), [0.0_wp, 0.0_wp, 0.0_wp], 1e-13_wp, "no tractions outside")
   end subroutine surface_tractions

   !> Finite differences: the stresses are in equilibrium
   subroutine equilibrium(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: place(3, 3) = reshape([1, 2, 3,  2, 4, 5,  3, 5, 6], [3, 3])
      real(wp), parameter :: step = 2e-3_wp
      real(wp), parameter :: weight(4) = [1.0_wp, -8.0_wp, 8.0_wp, -1.0_wp]/(12.0_wp*step)
      integer, parameter :: shift(4) = [-2, -1, 1, 2]
      type(potential_contact) :: grid
      real(wp), allocatable :: pn(:, :), px(:, :), py(:, :)
      real(wp) :: centre(3), position(3, 4), u(3, 4), s(6, 4), divergence(3), u0(3, 1), s0(6, 1), du(3, 3)
      integer :: body, i, j, n

      call general_load(grid, pn, px, py)
      do body = 1, 2
         centre = [0.31_wp, -0.12_wp, merge(0.6_wp, -0.6_wp, body == 1)]
         divergence = 0.0_wp
         do j = 1, 3
            position = spread(centre, 2, 4)
            do n = 1, 4
               position(j, n) = centre(j) + shift(n)*step
            end do
            call subsurface_field(grid, pn, px, py, [1.0_wp, 2.0_wp], [0.28_wp, 0.4_wp], position, u, s)
            du(:, j) = matmul(u, weight)
            do i = 1, 3
               divergence(i) = divergence(i) + dot_product(weight, s(place(i, j), :))
            end do
         end do
         call subsurface_field(grid, pn, px, py, [1.0_wp, 2.0_wp], [0.28_wp, 0.4_wp], reshape(centre, [3, 1]), u0, s0)
         call suite%close_to(divergence, [0.0_wp, 0.0_wp, 0.0_wp], 1e-8_wp, "divergence of the stresses")
         call suite%close_to(s0(:, 1), stress_of(du, real(body, wp), merge(0.28_wp, 0.4_wp, body == 1)), 1e-8_wp, &
            & "stresses follow from the displacements")
      end do
   end subroutine equilibrium

   !> Mirrored loads give mirrored fields, and body 2 is body 1 turned about the x-axis
   subroutine reflections(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: gg(2) = [1.0_wp, 1.0_wp], nu(2) = [0.3_wp, 0.3_wp], tol = 1e-14_wp
      type(potential_contact) :: grid, flipped
      real(wp), allocatable :: pn(:, :), px(:, :), py(:, :), pm(:, :), qx(:, :), qy(:, :)
      real(wp) :: point(3, 1), u(3, 1), s(6, 1), um(3, 1), sm(6, 1)

      call general_load(grid, pn, px, py)
      point(:, 1) = [0.3_wp, 0.55_wp, 0.2_wp]
      call subsurface_field(grid, pn, px, py, gg, nu, point, u, s)

      flipped = grid
      flipped%xl = -grid%xl - grid%mx*grid%dx
      pm = pn(5:1:-1, :)
      qx = px(5:1:-1, :)
      qy = py(5:1:-1, :)
      call subsurface_field(flipped, pm, -qx, qy, gg, nu, &
         & point*reshape([-1.0_wp, 1.0_wp, 1.0_wp], [3, 1]), um, sm)
      call suite%close_to(um(:, 1), u(:, 1)*[-1, 1, 1], tol, "mirror in x: displacements")
      call suite%close_to(sm(:, 1), s(:, 1)*[1, -1, -1, 1, 1, 1], 10*tol, "mirror in x: stresses")

      flipped = grid
      flipped%yl = -grid%yl - grid%my*grid%dy
      pm = pn(:, 4:1:-1)
      qx = px(:, 4:1:-1)
      qy = py(:, 4:1:-1)
      call subsurface_field(flipped, pm, qx, -qy, gg, nu, &
         & point*reshape([1.0_wp, -1.0_wp, 1.0_wp], [3, 1]), um, sm)
      call suite%close_to(um(:, 1), u(:, 1)*[1, -1, 1], tol, "mirror in y: displacements")
      call suite%close_to(sm(:, 1), s(:, 1)*[1, -1, 1, 1, -1, 1], 10*tol, "mirror in y: stresses")

      ! reaction on body 2, seen after half a revolution about x
      call subsurface_field(flipped, pm, -qx, qy, gg, nu, &
         & point*reshape([1.0_wp, -1.0_wp, -1.0_wp], [3, 1]), um, sm)
      call suite%close_to(um(:, 1), u(:, 1)*[1, -1, -1], tol, "body 2: displacements")
      call suite%close_to(sm(:, 1), s(:, 1)*[1, -1, -1, 1, 1, 1], 10*tol, "body 2: stresses")
   end subroutine reflections

   !> The sum over corners with jumps is the sum over elements, near and far
   subroutine sum_over_elements(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid
      real(wp), allocatable :: pn(:, :), px(:, :), py(:, :)
      real(wp), parameter :: gg(2) = [1.0_wp, 1.0_wp], nu(2) = [0.3_wp, 0.3_wp]
      real(wp) :: place(3, 4), u(3, 4), s(6, 4), us(3), dus(3, 3), ue(3), due(3, 3)
      integer :: ix, iy, n

      call general_load(grid, pn, px, py)
      place = reshape([0.1_wp, 0.2_wp, 0.3_wp,  -1.3_wp, 0.1_wp, 0.7_wp,  4.0_wp, -3.0_wp, 2.0_wp, &
         & 30.0_wp, -40.0_wp, 20.0_wp], [3, 4])
      call subsurface_field(grid, pn, px, py, gg, nu, place, u, s)
      do n = 1, 4
         us = 0.0_wp
         dus = 0.0_wp
         do iy = 1, grid%my
            do ix = 1, grid%mx
               call rectangle_field(place(:, n) - [grid%x(ix), grid%y(iy), 0.0_wp], grid%dx, grid%dy, &
                  & [px(ix, iy), py(ix, iy), pn(ix, iy)], gg(1), nu(1), ue, due)
               us = us + ue
               dus = dus + due
            end do
         end do
         call suite%close_to(u(:, n)/norm2(us), us/norm2(us), 1e-12_wp, "sum over elements: displacements")
         call suite%close_to(s(:, n)/norm2(dus), stress_of(dus, gg(1), nu(1))/norm2(dus), 2e-12_wp, &
            & "sum over elements: stresses")
      end do
   end subroutine sum_over_elements

   !> A layer of element centres by the table of responses is the same as point by point
   subroutine layers(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid
      real(wp), allocatable :: pn(:, :), px(:, :), py(:, :)
      real(wp), parameter :: gg(2) = [1.0_wp, 2.0_wp], nu(2) = [0.3_wp, 0.4_wp]
      real(wp), parameter :: depth(6) = [0.0_wp, 0.01_wp, 0.5_wp, -0.02_wp, -1.0_wp, -30.0_wp]
      real(wp) :: place(3, 20), u(3, 20), s(6, 20), u1(3, 1), s1(6, 1)
      integer :: ix, iy, layer, n
      logical :: same

      call general_load(grid, pn, px, py)
      do layer = 1, size(depth)
         do iy = 1, 4
            do ix = 1, 5
               place(:, ix + 5*(iy - 1)) = [grid%x(ix), grid%y(iy), depth(layer)]
            end do
         end do
         call subsurface_field(grid, pn, px, py, gg, nu, place, u, s)
         same = .true.
         do n = 1, size(place, 2)
            call subsurface_field(grid, pn, px, py, gg, nu, place(:, n:n), u1, s1)
            same = same .and. norm2(u(:, n) - u1(:, 1)) <= 1e-12_wp*norm2(u1)
            same = same .and. norm2(s(:, n) - s1(:, 1)) <= 1e-12_wp*norm2(s1)
         end do
         call suite%check(same, "layer by table and point by point")
      end do
   end subroutine layers

   !> Finite, and right where a limit exists, on edges, corners and their extensions
   subroutine special_points(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid
      real(wp) :: p(1, 1), none(1, 1), place(3, 6), u(3, 6), s(6, 6), u1(3, 6), s1(6, 6)
      real(wp), parameter :: gg(2) = [1.0_wp, 1.0_wp], nu(2) = [0.3_wp, 0.3_wp]

      grid = potential_contact(1, 1, -0.5_wp, -0.5_wp, 1.0_wp, 1.0_wp)
      p = 1.0_wp
      none = 0.0_wp
      ! extensions of the four edges, then an edge and a corner
      place = reshape([0.5_wp, 3.0_wp, 0.0_wp,  0.5_wp, -3.0_wp, 0.0_wp,  4.0_wp, -0.5_wp, 0.0_wp, &
         & -4.0_wp, -0.5_wp, 0.0_wp,  0.5_wp, 0.1_wp, 0.0_wp,  -0.5_wp, 0.5_wp, 0.0_wp], [3, 6])
      call subsurface_field(grid, p, 0.4_wp*p, 0.2_wp*p, gg, nu, place, u, s)
      call suite%check(all(abs(s) < 1e3_wp), "stresses on edges are finite")
      place(1:2, :) = place(1:2, :) + 1e-6_wp
      place(3, :) = 1e-6_wp
      call subsurface_field(grid, p, 0.4_wp*p, 0.2_wp*p, gg, nu, place, u1, s1)
      call suite%check(all(abs(u - u1) < 3e-5_wp), "displacements are continuous")
      call suite%check(all(abs(s(:, 1:4) - s1(:, 1:4)) < 1e-5_wp), "stresses are continuous beyond the ends of edges")
      call subsurface_field(grid, none, none, none, gg, nu, place, u, s)
      call suite%check(all(u == 0.0_wp) .and. all(s == 0.0_wp), "no loads: no stresses")
   end subroutine special_points

   !> Principal stresses: known, repeated and nearly repeated ones
   subroutine invariants(suite)
      type(test_suite), intent(inout) :: suite
      real(wp) :: s(6, 1), hyd(1), vm(1), tr(1), s1(1), s3(1)

      call suite%close_to(principal_stresses([1.0_wp, 0.0_wp, 0.0_wp, 3.0_wp, 0.0_wp, 2.0_wp]), &
         & [3.0_wp, 2.0_wp, 1.0_wp], 1e-15_wp, "diagonal")
      call suite%close_to(principal_stresses([2.0_wp, 1.0_wp, 1.0_wp, 2.0_wp, 1.0_wp, 2.0_wp]), &
         & [4.0_wp, 1.0_wp, 1.0_wp], 4e-15_wp, "repeated")
      call suite%close_to(principal_stresses([-5.0_wp, 1e-12_wp, 0.0_wp, -5.0_wp, 0.0_wp, -5.0_wp]), &
         & [-5.0_wp + 1e-12_wp, -5.0_wp, -5.0_wp - 1e-12_wp], 2e-15_wp, "nearly repeated")
      call suite%close_to(principal_stresses([0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]), &
         & [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "zero")
      s(:, 1) = [0.0_wp, 0.0_wp, 3.0_wp, 0.0_wp, 4.0_wp, 0.0_wp]
      call stress_invariants(s, hyd, vm, tr, s1, s3)
      call suite%close_to([hyd, vm, tr, s1, s3], [0.0_wp, 5.0_wp*sqrt(3.0_wp), 10.0_wp, 5.0_wp, -5.0_wp], 1e-14_wp, &
         & "pure shear")
   end subroutine invariants

   !> Hooke's law, written anew
   pure function stress_of(du, gg, nu) result(s)
      real(wp), intent(in) :: du(3, 3), gg, nu
      real(wp) :: s(6), full(3, 3)
      integer :: i

      full = gg*(du + transpose(du))
      do i = 1, 3
         full(i, i) = full(i, i) + 2.0_wp*gg*nu/(1.0_wp - 2.0_wp*nu)*(du(1, 1) + du(2, 2) + du(3, 3))
      end do
      s = [full(1, 1), full(1, 2), full(1, 3), full(2, 2), full(2, 3), full(3, 3)]
   end function stress_of
end program test_subsurface
