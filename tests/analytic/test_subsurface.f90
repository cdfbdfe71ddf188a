!> Subsurface stresses against closed forms, quadrature, equilibrium and symmetry
program test_subsurface
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_subsurface_direct, only : sum_directly
   use contact_subsurface_element_field, only : body_responses, corner_derivatives, element_derivatives, &
      & load_quadrature, n_derivatives, n_fields, new_quadrature, node_derivatives, source_derivatives
   use contact_subsurface_invariants, only : principal_stresses, stress_invariants
   use contact_subsurface_load, only : new_surface_load, surface_load
   use contact_test_harness, only : reference_folder, test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("subsurface")
   call point_loads(suite)
   call closed_forms_are_integrals(suite)
   call far_and_near_agree(suite)
   call one_element_example(suite)
   call one_element_file(suite)
   call hertz_on_axis(suite)
   call love_on_axis(suite)
   call line_contact(suite)
   call smoother_when_bilinear(suite)
   call surface_tractions(suite)
   call equilibrium(suite)
   call reflections(suite)
   call sum_over_elements(suite)
   call special_points(suite)
   call invariants(suite)
   call suite%finish()

contains

   !> Boussinesq and Cerruti, as in Johnson (1985)
   subroutine point_loads(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: x = 0.7_wp, y = -0.4_wp, z = 0.9_wp, gg = 1.3_wp, nu = 0.3_wp
      real(wp) :: d(n_derivatives), u(3), s(6), r

      r = sqrt(x**2 + y**2 + z**2)
      call source_derivatives(x, y, z, d)
      call fields_of(d, [0.0_wp, 0.0_wp, 1.0_wp], z, gg, nu, u, s)
      call suite%close_to(u(1), (x*z/r**3 - (1.0_wp - 2.0_wp*nu)*x/(r*(r + z)))/(4.0_wp*pi*gg), 1e-15_wp, "Boussinesq ux")
      call suite%close_to(u(3), (z**2/r**3 + 2.0_wp*(1.0_wp - nu)/r)/(4.0_wp*pi*gg), 1e-15_wp, "Boussinesq uz")
      call suite%close_to(s([3, 5, 6]), -1.5_wp*z**2/(pi*r**5)*[x, y, z], 1e-14_wp, "Boussinesq stresses")
      call fields_of(d, [1.0_wp, 0.0_wp, 0.0_wp], z, gg, nu, u, s)
      call suite%close_to(u(1), (1.0_wp/r + x**2/r**3 + (1.0_wp - 2.0_wp*nu)*(1.0_wp/(r + z) &
         & - x**2/(r*(r + z)**2)))/(4.0_wp*pi*gg), 1e-15_wp, "Cerruti ux")
      call suite%close_to(u(2), (x*y/r**3 - (1.0_wp - 2.0_wp*nu)*x*y/(r*(r + z)**2))/(4.0_wp*pi*gg), &
         & 1e-15_wp, "Cerruti uy")
      call suite%close_to(u(3), (x*z/r**3 + (1.0_wp - 2.0_wp*nu)*x/(r*(r + z)))/(4.0_wp*pi*gg), 1e-15_wp, "Cerruti uz")
      call suite%close_to(s([3, 5, 6]), -1.5_wp*x*z/(pi*r**5)*[x, y, z], 1e-14_wp, "Cerruti stresses")
   end subroutine point_loads

   !> Closed forms are integrals of the point load: constant over a rectangle, and falling off linearly
   subroutine closed_forms_are_integrals(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: dx = 1.0_wp, dy = 0.6_wp
      real(wp), parameter :: place(3, 5) = reshape([0.0_wp, 0.0_wp, 0.5_wp,  0.5_wp, 0.1_wp, 0.4_wp, &
         & -0.5_wp, -0.3_wp, 0.4_wp,  -2.0_wp, -3.0_wp, 0.2_wp,  0.2_wp, -2.0_wp, 1.0e-4_wp], [3, 5])
      integer, parameter :: panels = 40
      type(load_quadrature) :: rule
      real(wp) :: d(n_derivatives), part(n_derivatives), total(n_derivatives), xs, ys, weight
      integer :: i, ip, j, jp, n
      logical :: bilinear

      rule = new_quadrature(.false.)
      bilinear = .false.
      do
         do n = 1, size(place, 2)
            total = 0.0_wp
            do jp = -panels, panels - 1
               do ip = -panels, panels - 1
                  do j = 1, size(rule%point)
                     do i = 1, size(rule%point)
                        xs = (ip + 0.5_wp + rule%point(i))/panels
                        ys = (jp + 0.5_wp + rule%point(j))/panels
                        if (bilinear) then
                           weight = (1.0_wp - abs(xs))*(1.0_wp - abs(ys))
                        else
                           weight = merge(1.0_wp, 0.0_wp, abs(xs) < 0.5_wp .and. abs(ys) < 0.5_wp)
                        end if
                        if (weight <= 0.0_wp) cycle
                        call source_derivatives(place(1, n) - xs*dx, place(2, n) - ys*dy, place(3, n), part)
                        total = total + rule%weight(i)*rule%weight(j)*weight*dx*dy/panels**2*part
                     end do
                  end do
               end do
            end do
            call element_derivatives(place(:, n), dx, dy, bilinear, d)
            call compare(suite, d(1:6), total(1:6), "second derivatives by quadrature")
            call compare(suite, d(7:16), total(7:16), "third derivatives by quadrature")
            call compare(suite, d(17:26), total(17:26), "fourth derivatives by quadrature")
         end do
         if (bilinear) exit
         bilinear = .true.
      end do
   end subroutine closed_forms_are_integrals

   !> Closeness relative to the largest of a group
   subroutine compare(suite, actual, expected, what)
      type(test_suite), intent(inout) :: suite
      real(wp), intent(in) :: actual(:), expected(:)
      character(len=*), intent(in) :: what

      call suite%close_to((actual - expected)/norm2(expected), 0.0_wp*expected, 2e-12_wp, what)
   end subroutine compare

   !> The far field by quadrature joins the near field by closed forms, and ends as that of a point load
   subroutine far_and_near_agree(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: way(3) = [0.6_wp, -0.48_wp, 0.64_wp], load(3) = [0.3_wp, -0.7_wp, 1.0_wp]
      real(wp), parameter :: far(2) = [20.00001_wp, 6.00001_wp]
      integer, parameter :: second_difference(-1:1) = [1, -2, 1]
      real(wp) :: near_u(3), near_s(6), far_u(3), far_s(6), d(n_derivatives), part(n_derivatives), at(3)
      integer :: i, j, kind

      do kind = 1, 2
         at = far(kind)*way
         d = 0.0_wp
         do j = -1, 1
            do i = -1, 1
               if (kind == 1) then
                  if (i == 0 .or. j == 0) cycle
                  call corner_derivatives(at(1) + 0.5_wp*i, at(2) + 0.5_wp*j, at(3), 1e-7_wp, part)
                  d = d + i*j*part
               else
                  call node_derivatives(at(1) + i, at(2) + j, at(3), 1e-7_wp, part)
                  d = d + second_difference(i)*second_difference(j)*part
               end if
            end do
         end do
         call fields_of(d, load, at(3), 1.0_wp, 0.3_wp, near_u, near_s)
         call element_derivatives(at, 1.0_wp, 1.0_wp, kind == 2, d)
         call fields_of(d, load, at(3), 1.0_wp, 0.3_wp, far_u, far_s)
         call suite%close_to(norm2(near_u - far_u)/norm2(far_u), 0.0_wp, 1e-12_wp, "displacements at the switch")
         call suite%close_to(norm2(near_s - far_s)/norm2(far_s), 0.0_wp, 1e-11_wp, "stresses at the switch")

         at = 1.0e5_wp*way
         call element_derivatives(at, 1.0_wp, 1.0_wp, kind == 2, d)
         call fields_of(d, load, at(3), 1.0_wp, 0.3_wp, far_u, far_s)
         call source_derivatives(at(1), at(2), at(3), d)
         call fields_of(d, load, at(3), 1.0_wp, 0.3_wp, near_u, near_s)
         call suite%close_to(norm2(near_s - far_s)/norm2(far_s), 0.0_wp, 1e-9_wp, "very far: a point load")
      end do
   end subroutine far_and_near_agree

   !> Displacements and stresses in body 1 from derivatives and a load
   subroutine fields_of(d, load, z, gg, nu, u, s)
      real(wp), intent(in) :: d(n_derivatives), load(3), z, gg, nu
      real(wp), intent(out) :: u(3), s(6)
      real(wp) :: response(n_fields, 3)

      call body_responses(d, z, gg, nu, 1.0_wp, response)
      u = matmul(response(1:3, :), load)
      s = matmul(response(4:9, :), load)
   end subroutine fields_of

   !> Direct sums over the elements of a grid
   subroutine field_at(grid, pn, px, py, gg, nu, position, u, s, bilinear)
      type(potential_contact), intent(in) :: grid
      real(wp), intent(in), contiguous :: pn(:, :), px(:, :), py(:, :), position(:, :)
      real(wp), intent(in) :: gg(2), nu(2)
      real(wp), intent(out), contiguous :: u(:, :), s(:, :)
      logical, intent(in), optional :: bilinear
      type(surface_load) :: load

      call new_surface_load(load, grid, pn, px, py, gg, nu, bilinear)
      call sum_directly(load, position, u, s)
   end subroutine field_at

   !> Values on the axis of Kalker's example, printed with six digits
   subroutine one_element_example(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: z(4) = [0.0_wp, 0.5_wp, 1.0_wp, 5.0_wp]
      real(wp) :: position(3, 4), u(3, 4), s(6, 4), inv(4, 6)

      position(1:2, :) = 1e-5_wp
      position(3, :) = z
      call example_field(position, u, s)
      call stress_invariants(s, inv(:, 1), inv(:, 2), inv(:, 3), inv(:, 4), inv(:, 5), inv(:, 6))
      call suite%close_to(u(1, :), [0.482073_wp, 0.175332_wp, 0.094955_wp, 0.019385_wp], 6e-7_wp, "ux")
      call suite%close_to(u(3, :), [0.403982_wp, 0.265146_wp, 0.170498_wp, 0.038600_wp], 6e-7_wp, "uz")
      call suite%close_to(inv(:, 1), [-0.853264_wp, -0.284416_wp, -0.109379_wp, -5.3787e-3_wp], 6e-7_wp, "sighyd")
      call suite%close_to(inv(:, 2), [1.74426_wp, 0.676093_wp, 0.342630_wp, 0.020110_wp], 6e-6_wp, "sigvm")
      call suite%close_to(s(:, 1), [-0.779815_wp, 1.2305e-4_wp, -0.998999_wp, -0.779977_wp, 0.0_wp, -1.0_wp], &
         & 1.1e-6_wp, "stresses at the surface")
      call suite%close_to(inv(1, [3, 4, 6]), [2.010_wp, 0.115_wp, -1.895_wp], 6e-4_wp, "Tresca and principal stresses")
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
      call field_at(grid, pn, px, py, [1.0_wp, 1.0_wp], [0.28_wp, 0.28_wp], position, u, s)
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
         read(unit, "(a)", iostat=status) line
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
      allocate(u(3, n), s(6, n), inv(n, 6), position(3, n), source=0.0_wp)
      position = table(1:3, 1:n)
      call example_field(position, u, s)
      call stress_invariants(s, inv(:, 1), inv(:, 2), inv(:, 3), inv(:, 4), inv(:, 5), inv(:, 6))
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
         write(*, "(a, 3es12.4)") "stored example at", table(1:3, point)
         write(*, "(11es13.5)") actual, reference
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
         call field_at(grid, pn, none, none, [1.0_wp, 1.0_wp], [nu, nu], position, u, s)
         err(level) = max(maxval(abs(s(6, :) - sz)), maxval(abs(s(1, :) - sr)), maxval(abs(s(4, :) - sr)))
      end do
      call suite%check(err(3) < 1e-3_wp, "Hertz stresses on the axis, 64 elements")
      call suite%check(log(err(1)/err(3))/log(4.0_wp) > 1.3_wp, "Hertz stresses converge with order above 1.3")
      write(*, "(a, 3es10.2, a, f5.2)") "Hertz: errors", err, ", order", log(err(1)/err(3))/log(4.0_wp)
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

   !> Normal stress below the centre of a uniform rectangle of sides 2 a and 2 b (Love 1929)
   subroutine love_on_axis(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: a = 0.7_wp, b = 0.4_wp, z(4) = [0.01_wp, 0.3_wp, 2.0_wp, 11.0_wp]
      type(potential_contact) :: grid
      real(wp) :: p(1, 1), none(1, 1), place(3, 4), u(3, 4), s(6, 4), r(4), sz(4)

      grid = potential_contact(1, 1, -a, -b, 2*a, 2*b)
      p = 1.0_wp
      none = 0.0_wp
      place = 0.0_wp
      place(3, :) = z
      call field_at(grid, p, none, none, [1.0_wp, 1.0_wp], [0.3_wp, 0.3_wp], place, u, s)
      r = sqrt(a**2 + b**2 + z**2)
      sz = -2.0_wp/pi*(atan(a*b/(z*r)) + a*b*z/r*(1.0_wp/(a**2 + z**2) + 1.0_wp/(b**2 + z**2)))
      call suite%close_to(s(6, :), sz, 1e-13_wp, "Love's rectangle: stress on the axis")
   end subroutine love_on_axis

   !> Cylinders: largest shear stress 0.30 of the largest pressure at 0.786 half-widths (Johnson 1985)
   subroutine line_contact(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: m = 400, n = 101
      type(potential_contact) :: grid
      real(wp) :: p(m, 1), none(m, 1), place(3, n), u(3, n), s(6, n), shear(n)
      integer :: i

      grid = potential_contact(m, 1, -1.0_wp, -5000.0_wp, 2.0_wp/m, 10000.0_wp)
      p(:, 1) = sqrt(1.0_wp - grid%x([(i, i = 1, m)])**2)
      none = 0.0_wp
      place = 0.0_wp
      place(3, :) = [(0.7_wp + 0.002_wp*(i - 1), i = 1, n)]
      call field_at(grid, p, none, none, [1.0_wp, 1.0_wp], [0.3_wp, 0.3_wp], place, u, s)
      shear = 0.5_wp*(s(1, :) - s(6, :))
      call suite%close_to(maxval(shear), 0.3003_wp, 2e-4_wp, "line contact: largest shear stress")
      call suite%close_to(place(3, maxloc(shear, dim=1)), 0.786_wp, 3e-3_wp, "line contact: its depth")
      call suite%close_to(s(4, :), 0.3_wp*(s(1, :) + s(6, :)), 1e-4_wp, &
         & "line contact: plane strain, up to the ratio of width and length")
   end subroutine line_contact

   !> Close to the surface, bilinear tractions have no peaks at the edges of elements
   subroutine smoother_when_bilinear(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid
      real(wp), parameter :: gg(2) = [1.0_wp, 1.0_wp], nu(2) = [0.3_wp, 0.3_wp]
      integer, parameter :: m(4) = [20, 40, 20, 160]
      real(wp), allocatable :: p(:, :)
      real(wp) :: place(3, 9), u(3, 9), s(6, 9, 4), error(3)
      integer :: i, level

      place(1, :) = [(0.31_wp + 0.0125_wp*(i - 1), i = 1, 9)]
      place(2, :) = 0.2_wp
      place(3, :) = 0.01_wp
      do level = 1, 4
         grid = potential_contact(m(level), m(level), -1.0_wp, -1.0_wp, 2.0_wp/m(level), 2.0_wp/m(level))
         p = matmul(reshape(cos(0.5_wp*pi*grid%x([(i, i = 1, m(level))]))**2, [m(level), 1]), &
            & reshape(cos(0.5_wp*pi*grid%y([(i, i = 1, m(level))]))**2, [1, m(level)]))
         call field_at(grid, p, 0.5_wp*p, 0.0_wp*p, gg, nu, place, u, s(:, :, level), level /= 3)
      end do
      do level = 1, 3
         error(level) = maxval(abs(s(:, :, level) - s(:, :, 4)))
      end do
      write(*, "(a, 3es10.2)") "near the surface: bilinear 20 and 40, constant 20:", error
      call suite%check(error(3) > 4.0_wp*error(1), "bilinear tractions are four times more accurate near the surface")
      call suite%check(log(error(1)/error(2))/log(2.0_wp) > 1.5_wp, "and converge with order above 1.5")
   end subroutine smoother_when_bilinear

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
            call field_at(grid, pn, px, py, [1.0_wp, 2.0_wp], [0.28_wp, 0.4_wp], position, u, s)
            expected = -[px(ix, iy), py(ix, iy), pn(ix, iy)]
            call suite%close_to(s([3, 5, 6], 1), expected, 5e-13_wp, "tractions at z = 0")
            call suite%close_to(s([3, 5, 6], 2), expected, 5e-13_wp, "tractions for z to 0 in body 1")
            call suite%close_to(s([3, 5, 6], 3), expected, 5e-13_wp, "tractions for z to 0 in body 2")
         end do
      end do
      position = spread([9.0_wp, -7.0_wp, 0.0_wp], 2, 3)
      call field_at(grid, pn, px, py, [1.0_wp, 2.0_wp], [0.28_wp, 0.4_wp], position, u, s)
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
            call field_at(grid, pn, px, py, [1.0_wp, 2.0_wp], [0.28_wp, 0.4_wp], position, u, s)
            du(:, j) = matmul(u, weight)
            do i = 1, 3
               divergence(i) = divergence(i) + dot_product(weight, s(place(i, j), :))
            end do
         end do
         call field_at(grid, pn, px, py, [1.0_wp, 2.0_wp], [0.28_wp, 0.4_wp], reshape(centre, [3, 1]), u0, s0)
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
      call field_at(grid, pn, px, py, gg, nu, point, u, s)

      flipped = grid
      flipped%xl = -grid%xl - grid%mx*grid%dx
      pm = pn(5:1:-1, :)
      qx = px(5:1:-1, :)
      qy = py(5:1:-1, :)
      call field_at(flipped, pm, -qx, qy, gg, nu, &
         & point*reshape([-1.0_wp, 1.0_wp, 1.0_wp], [3, 1]), um, sm)
      call suite%close_to(um(:, 1), u(:, 1)*[-1, 1, 1], tol, "mirror in x: displacements")
      call suite%close_to(sm(:, 1), s(:, 1)*[1, -1, -1, 1, 1, 1], 10*tol, "mirror in x: stresses")

      flipped = grid
      flipped%yl = -grid%yl - grid%my*grid%dy
      pm = pn(:, 4:1:-1)
      qx = px(:, 4:1:-1)
      qy = py(:, 4:1:-1)
      call field_at(flipped, pm, qx, -qy, gg, nu, &
         & point*reshape([1.0_wp, -1.0_wp, 1.0_wp], [3, 1]), um, sm)
      call suite%close_to(um(:, 1), u(:, 1)*[1, -1, 1], tol, "mirror in y: displacements")
      call suite%close_to(sm(:, 1), s(:, 1)*[1, -1, 1, 1, -1, 1], 10*tol, "mirror in y: stresses")

      ! reaction on body 2, seen after half a revolution about x
      call field_at(flipped, pm, -qx, qy, gg, nu, &
         & point*reshape([1.0_wp, -1.0_wp, -1.0_wp], [3, 1]), um, sm)
      call suite%close_to(um(:, 1), u(:, 1)*[1, -1, -1], tol, "body 2: displacements")
      call suite%close_to(sm(:, 1), s(:, 1)*[1, -1, -1, 1, 1, 1], 10*tol, "body 2: stresses")
   end subroutine reflections

   !> The rearranged sum over corners or centres is the sum over elements, near and far
   subroutine sum_over_elements(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid
      real(wp), allocatable :: pn(:, :), px(:, :), py(:, :)
      real(wp), parameter :: gg(2) = [1.0_wp, 1.0_wp], nu(2) = [0.3_wp, 0.3_wp]
      real(wp) :: place(3, 4), u(3, 4), s(6, 4), d(n_derivatives), ue(3), se(6), us(3), ss(6)
      integer :: ix, iy, kind, n

      call general_load(grid, pn, px, py)
      place = reshape([0.1_wp, 0.2_wp, 0.3_wp,  -1.3_wp, 0.1_wp, 0.7_wp,  4.0_wp, -3.0_wp, 2.0_wp, &
         & 30.0_wp, -40.0_wp, 20.0_wp], [3, 4])
      do kind = 1, 2
         call field_at(grid, pn, px, py, gg, nu, place, u, s, kind == 2)
         do n = 1, 4
            us = 0.0_wp
            ss = 0.0_wp
            do iy = 1, grid%my
               do ix = 1, grid%mx
                  call element_derivatives(place(:, n) - [grid%x(ix), grid%y(iy), 0.0_wp], grid%dx, grid%dy, kind == 2, d)
                  call fields_of(d, [px(ix, iy), py(ix, iy), pn(ix, iy)], place(3, n), gg(1), nu(1), ue, se)
                  us = us + ue
                  ss = ss + se
               end do
            end do
            call suite%close_to(u(:, n)/norm2(us), us/norm2(us), 1e-12_wp, "sum over elements: displacements")
            call suite%close_to(s(:, n)/norm2(ss), ss/norm2(ss), merge(2e-11_wp, 2e-12_wp, kind == 2), &
               & "sum over elements: stresses")
         end do
      end do
   end subroutine sum_over_elements

   !> Finite, and right where a limit exists, on edges, corners and their extensions
   subroutine special_points(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid
      real(wp) :: p(1, 1), none(1, 1), place(3, 6), u(3, 6), s(6, 6), u1(3, 6), s1(6, 6)
      real(wp), parameter :: gg(2) = [1.0_wp, 1.0_wp], nu(2) = [0.3_wp, 0.3_wp]
      integer :: n

      grid = potential_contact(1, 1, -0.5_wp, -0.5_wp, 1.0_wp, 1.0_wp)
      p = 1.0_wp
      none = 0.0_wp
      ! extensions of the four edges, then an edge and a corner
      place = reshape([0.5_wp, 3.0_wp, 0.0_wp,  0.5_wp, -3.0_wp, 0.0_wp,  4.0_wp, -0.5_wp, 0.0_wp, &
         & -4.0_wp, -0.5_wp, 0.0_wp,  0.5_wp, 0.1_wp, 0.0_wp,  -0.5_wp, 0.5_wp, 0.0_wp], [3, 6])
      call field_at(grid, p, 0.4_wp*p, 0.2_wp*p, gg, nu, place, u, s)
      call suite%check(all(abs(s) < 1e3_wp), "stresses on edges are finite")
      place(1:2, :) = place(1:2, :) + 1e-6_wp
      place(3, :) = 1e-6_wp
      call field_at(grid, p, 0.4_wp*p, 0.2_wp*p, gg, nu, place, u1, s1)
      call suite%check(all(abs(u - u1) < 3e-5_wp), "displacements are continuous")
      call suite%check(all(abs(s(:, 1:4) - s1(:, 1:4)) < 1e-5_wp), "stresses are continuous beyond the ends of edges")
      do n = 1, 2
         place(3, :) = [1e5_wp, 1e20_wp, 1e100_wp, 1e300_wp, 1e-300_wp, -1e-300_wp]
         call field_at(grid, p, 0.4_wp*p, 0.2_wp*p, gg, nu, place, u, s, n == 2)
         call suite%check(all(abs(u) < 1.0_wp) .and. all(abs(s) < 1e3_wp), "huge and tiny depths: finite")
         call suite%check(all(abs(s(:, 1:4)) < 1e-9_wp), "huge depths: no stresses")
      end do
      call field_at(grid, none, none, none, gg, nu, place, u, s)
      call suite%check(all(u == 0.0_wp) .and. all(s == 0.0_wp), "no loads: no stresses")
   end subroutine special_points

   !> Principal stresses: known, repeated and nearly repeated ones
   subroutine invariants(suite)
      type(test_suite), intent(inout) :: suite
      real(wp) :: s(6, 1), hyd(1), vm(1), tr(1), s1(1), s2(1), s3(1)

      call suite%close_to(principal_stresses([1.0_wp, 0.0_wp, 0.0_wp, 3.0_wp, 0.0_wp, 2.0_wp]), &
         & [3.0_wp, 2.0_wp, 1.0_wp], 1e-15_wp, "diagonal")
      call suite%close_to(principal_stresses([2.0_wp, 1.0_wp, 1.0_wp, 2.0_wp, 1.0_wp, 2.0_wp]), &
         & [4.0_wp, 1.0_wp, 1.0_wp], 4e-15_wp, "repeated")
      call suite%close_to(principal_stresses([-5.0_wp, 1e-12_wp, 0.0_wp, -5.0_wp, 0.0_wp, -5.0_wp]), &
         & [-5.0_wp + 1e-12_wp, -5.0_wp, -5.0_wp - 1e-12_wp], 2e-15_wp, "nearly repeated")
      call suite%close_to(principal_stresses([0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]), &
         & [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "zero")
      s(:, 1) = [0.0_wp, 0.0_wp, 3.0_wp, 0.0_wp, 4.0_wp, 0.0_wp]
      call stress_invariants(s, hyd, vm, tr, s1, s2, s3)
      call suite%close_to([hyd, vm, tr, s1, s2, s3], [0.0_wp, 5.0_wp*sqrt(3.0_wp), 10.0_wp, 5.0_wp, 0.0_wp, -5.0_wp], 1e-14_wp, &
         & "pure shear")
      call groups_of_points(suite)
   end subroutine invariants

   !> Points are processed four at once: each gets what it gets alone, and one that is undefined remains so
   subroutine groups_of_points(suite)
      use, intrinsic :: ieee_arithmetic, only : ieee_divide_by_zero, ieee_get_flag, ieee_invalid, ieee_is_nan, ieee_quiet_nan, &
         & ieee_set_flag, ieee_value
      type(test_suite), intent(inout) :: suite
      integer, parameter :: n = 7
      real(wp) :: s(6, n), hyd(n), vm(n), tr(n), s1(n), s2(n), s3(n)
      logical :: raised(2)
      integer :: k

      do k = 1, n
         s(:, k) = 10.0_wp**(40*(k - 4))*[2.0_wp, 1.0_wp, 1.0_wp, 2.0_wp, 1.0_wp, 2.0_wp]
      end do
      s(:, 3) = 0.0_wp
      s(:, 5) = [1.0_wp, 0.3_wp, -0.2_wp, 4.0_wp, 0.7_wp, -3.0_wp]
      call ieee_set_flag([ieee_divide_by_zero, ieee_invalid], .false.)
      call stress_invariants(s, hyd, vm, tr, s1, s2, s3)
      call ieee_get_flag(ieee_divide_by_zero, raised(1))
      call ieee_get_flag(ieee_invalid, raised(2))
      call suite%check(.not. any(raised), "no exceptions, which stop a program with traps")
      do k = 1, n
         call suite%check(all(abs([s1(k), s2(k), s3(k)] - principal_stresses(s(:, k))) <= 0.0_wp), "alone and with others")
         if (k == 3 .or. k == 5) cycle
         call suite%close_to([s1(k), s2(k), s3(k)]/s(2, k), [4.0_wp, 1.0_wp, 1.0_wp], 4e-15_wp, "any magnitude")
      end do
      ! sums of the principal values and of their products in pairs
      call suite%close_to([s1(5) + s2(5) + s3(5), s1(5)*s2(5) + s2(5)*s3(5) + s3(5)*s1(5)], &
         & [2.0_wp, 4.0_wp - 12.0_wp - 3.0_wp - 0.3_wp**2 - 0.2_wp**2 - 0.7_wp**2], 2e-14_wp, "general")
      s(2, 2) = ieee_value(1.0_wp, ieee_quiet_nan)
      call stress_invariants(s, hyd, vm, tr, s1, s2, s3)
      call suite%check(all(ieee_is_nan([vm(2), tr(2), s1(2), s2(2), s3(2)])), "undefined")
      call suite%check(.not. any(ieee_is_nan([s1(1), s1(3), s1(4)])), "others remain defined")
   end subroutine groups_of_points

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
