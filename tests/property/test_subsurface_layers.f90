!> Layers of element centres by transforms: equal to direct sums, and relations that hold for any field
program test_subsurface_layers
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_subsurface_direct, only : sum_directly
   use contact_subsurface_layers, only : transform_layers
   use contact_subsurface_load, only : new_surface_load, surface_load
   use contact_subsurface_points, only : list_points, point_set
   use contact_subsurface_response_shelf, only : response_shelf
   use contact_subsurface_stress, only : subsurface_field
   use contact_test_harness, only : test_suite
   use omp_lib, only : omp_get_max_threads, omp_set_num_threads
   implicit none (type, external)
   !> Modulus of rigidity and Poisson's ratio of both bodies
   real(wp), parameter :: gg(2) = [1.0_wp, 2.0_wp], nu(2) = [0.3_wp, 0.45_wp]
   !> Depths in sides of an element, from the surface to far beyond any switch of formulas
   real(wp), parameter :: depth(9) = [0.0_wp, 1e-6_wp, 0.4_wp, 5.0_wp, 19.9_wp, 20.1_wp, 300.0_wp, -0.3_wp, -40.0_wp]
   type(test_suite) :: suite

   call suite%start("subsurface layers")
   call shapes(suite)
   call series(suite)
   call threads(suite)
   call linear_and_mirrored(suite)
   call incompressible(suite)
   call choice(suite)
   call suite%finish()

contains

   !> Windows, selections and elements of many shapes
   subroutine shapes(suite)
      type(test_suite), intent(inout) :: suite
      integer :: kind

      do kind = 1, 2
         call compare(suite, 12, 9, 0.5_wp, 0.4_wp, [1, 12, 1, 9], [1, 2, 5, 12], [1, 4, 9], kind == 2, "full window")
         call compare(suite, 12, 9, 0.5_wp, 0.4_wp, [10, 12, 1, 2], [1, 2, 5, 12], [1, 4, 9], kind == 2, "load in a corner")
         call compare(suite, 12, 9, 0.5_wp, 0.4_wp, [3, 4, 3, 3], [7], [5], kind == 2, "one column")
         call compare(suite, 12, 9, 0.5_wp, 0.4_wp, [2, 11, 2, 8], [-7, 3, 30], [-4, 2, 20], kind == 2, "beyond the window")
         call compare(suite, 1, 1, 1.0_wp, 1.0_wp, [1, 1, 1, 1], [1], [1], kind == 2, "one element")
         call compare(suite, 20, 1, 0.1_wp, 0.1_wp, [3, 17, 1, 1], [1, 3, 10], [1], kind == 2, "one row")
         call compare(suite, 1, 20, 0.1_wp, 0.1_wp, [1, 1, 3, 17], [1], [1, 3, 10], kind == 2, "one column of elements")
         call compare(suite, 24, 7, 0.1_wp, 1.0_wp, [1, 24, 1, 7], [1, 3, 24], [1, 4], kind == 2, "long elements")
      end do
      call compare(suite, 40, 1, 0.1_wp, 300.0_wp, [1, 40, 1, 1], [1, 3, 20, 40], [1], .false., "line contact")
   end subroutine shapes

   !> Transforms against direct sums, to 1e-12 of the largest value in a layer
   subroutine compare(suite, mx, my, dx, dy, loaded, ix, iy, bilinear, what)
      type(test_suite), intent(inout) :: suite
      !> Elements and their sides [mm]; first and last loaded column and row; points
      integer, intent(in) :: mx, my, loaded(4), ix(:), iy(:)
      real(wp), intent(in) :: dx, dy
      logical, intent(in) :: bilinear
      character(len=*), intent(in) :: what
      type(surface_load) :: load
      type(potential_contact) :: grid
      real(wp), allocatable :: p(:, :, :), u(:, :, :), s(:, :, :), ud(:, :), sd(:, :), position(:, :)
      real(wp) :: worst(2), tolerance
      type(point_set) :: points
      integer :: k, n, t

      call make_load(mx, my, dx, dy, loaded, bilinear, grid, p, load)
      points%x = grid%x(ix)
      points%y = grid%y(iy)
      n = size(ix)*size(iy)
      allocate(u(3, n, size(depth)), s(6, n, size(depth)), ud(3, n), sd(6, n), position(3, n))
      worst = 0.0_wp
      ! with all tractions, then with pressures only
      do t = 1, 2
         if (t == 2) call new_surface_load(load, grid, p(:, :, 3), 0.0_wp*p(:, :, 1), 0.0_wp*p(:, :, 1), gg, nu, bilinear)
         call transform_layers(load, ix, iy, depth*min(dx, dy), u, s)
         do k = 1, size(depth)
            points%z = [depth(k)*min(dx, dy)]
            call list_points(points, position)
            call sum_directly(load, position, ud, sd)
            worst(1) = max(worst(1), maxval(abs(u(:, :, k) - ud))/maxval(abs(ud)))
            worst(2) = max(worst(2), maxval(abs(s(:, :, k) - sd))/maxval(abs(sd)))
         end do
      end do
      ! at many depths the direct sum over second differences is the less accurate one
      tolerance = merge(1e-11_wp, 1e-12_wp, bilinear)
      write(*, "(3a, 2es9.1)") merge("bilinear, ", "constant, ", bilinear), what, ":", worst
      call suite%check(worst(1) < tolerance, what // ": displacements")
      call suite%check(worst(2) < tolerance, what // ": stresses")
   end subroutine compare

   !> Tractions without any symmetry
   subroutine make_load(mx, my, dx, dy, loaded, bilinear, grid, p, load)
      integer, intent(in) :: mx, my, loaded(4)
      real(wp), intent(in) :: dx, dy
      logical, intent(in) :: bilinear
      type(potential_contact), intent(out) :: grid
      !> px, py, pn
      real(wp), allocatable, intent(out) :: p(:, :, :)
      type(surface_load), intent(out) :: load
      integer :: ix, iy

      grid = potential_contact(mx, my, -1.3_wp, 0.7_wp, dx, dy)
      allocate(p(mx, my, 3), source=0.0_wp)
      do iy = loaded(3), loaded(4)
         do ix = loaded(1), loaded(2)
            p(ix, iy, :) = [0.3_wp*sin(2.0_wp*ix + iy), 0.2_wp*cos(ix + 3.0_wp*iy), 1.0_wp + 0.5_wp*sin(0.7_wp*ix*iy)]
         end do
      end do
      call new_surface_load(load, grid, p(:, :, 3), p(:, :, 1), p(:, :, 2), gg, nu, bilinear)
   end subroutine make_load

   !> Consecutive cases have the fields of single ones, for any change of size, position and contents
   subroutine series(suite)
      type(test_suite), intent(inout) :: suite
      !> First and last loaded column and row of each case
      integer, parameter :: loaded(4, 9) = reshape([9, 9, 6, 6,  8, 10, 5, 7,  1, 18, 1, 13,  2, 4, 11, 13,  2, 4, 11, 13, &
         & 5, 12, 3, 9,  5, 12, 3, 9,  1, 18, 1, 13,  7, 7, 2, 12], [4, 9])
      !> The sixth to the eighth case have pressures only, the eighth has another depth; spectra are kept for repeated requests
      logical, parameter :: with_tractions(9) = [.true., .true., .true., .true., .true., .false., .false., .false., .true.], &
         & keeps(9) = [.false., .true., .true., .true., .true., .false., .true., .false., .false.]
      integer, parameter :: ix(4) = [1, 7, 15, 18], iy(3) = [1, 2, 13]
      type(surface_load) :: load
      type(potential_contact) :: grid
      type(response_shelf) :: shelf
      real(wp), allocatable :: p(:, :, :)
      real(wp) :: u(3, 12, 9), s(6, 12, 9), u1(3, 12, 9), s1(6, 12, 9), z(9), worst
      integer :: k
      logical :: as_planned

      worst = 0.0_wp
      as_planned = .true.
      z = depth
      do k = 1, size(keeps)
         call make_load(18, 13, 0.3_wp, 0.4_wp, loaded(:, k), .false., grid, p, load)
         if (.not. with_tractions(k)) &
            & call new_surface_load(load, grid, p(:, :, 3), 0.0_wp*p(:, :, 1), 0.0_wp*p(:, :, 1), gg, nu, .false.)
         if (k == 8) z(3) = 2.0_wp*z(3)
         call transform_layers(load, ix, iy, z, u, s)
         call transform_layers(load, ix, iy, z, u1, s1, shelf)
         as_planned = as_planned .and. (keeps(k) .eqv. shelf%nx >= 0)
         worst = max(worst, maxval(abs(u1 - u))/maxval(abs(u)), maxval(abs(s1 - s))/maxval(abs(s)))
      end do
      write(*, "(a, es9.1)") "cases that follow each other:", worst
      call suite%check(worst < 1e-13_wp, "cases that follow each other have the fields of single ones")
      call suite%check(as_planned, "spectra are kept from the second case of a series on")
   end subroutine series

   !> Results do not depend on the number of threads
   subroutine threads(suite)
      type(test_suite), intent(inout) :: suite
      type(surface_load) :: load
      type(potential_contact) :: grid
      real(wp), allocatable :: p(:, :, :)
      integer, parameter :: ix(3) = [1, 7, 15], iy(2) = [2, 11]
      real(wp) :: u(3, 6, 9, 3), s(6, 6, 9, 3)
      integer :: k, most

      call make_load(15, 12, 0.3_wp, 0.3_wp, [1, 15, 1, 12], .false., grid, p, load)
      most = omp_get_max_threads()
      do k = 1, 3
         call omp_set_num_threads(k)
         call transform_layers(load, ix, iy, depth, u(:, :, :, k), s(:, :, :, k))
      end do
      call omp_set_num_threads(most)
      call suite%check(all(u(:, :, :, 1) == u(:, :, :, 2)) .and. all(s(:, :, :, 1) == s(:, :, :, 3)), &
         & "equal to the last bit with one, two and three threads")
   end subroutine threads

   !> Sums of loads give sums of fields, loads mirrored in y give mirrored fields
   subroutine linear_and_mirrored(suite)
      type(test_suite), intent(inout) :: suite
      type(surface_load) :: load, half, mirrored
      type(potential_contact) :: grid
      real(wp), allocatable :: p(:, :, :), q(:, :, :)
      integer, parameter :: ix(10) = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10], iy(4) = [1, 2, 3, 4]
      real(wp) :: u(3, 10, 4, 9), s(6, 10, 4, 9), u1(3, 10, 4, 9), s1(6, 10, 4, 9), u2(3, 10, 4, 9), s2(6, 10, 4, 9)
      integer :: i

      call make_load(10, 4, 0.3_wp, 0.3_wp, [1, 10, 1, 4], .false., grid, p, load)
      call transform_layers(load, ix, iy, depth, u, s)
      q = p
      q(1:4, :, :) = 0.0_wp
      call new_surface_load(half, grid, q(:, :, 3), q(:, :, 1), q(:, :, 2), gg, nu)
      call transform_layers(half, ix, iy, depth, u1, s1)
      q = p - q
      call new_surface_load(half, grid, q(:, :, 3), q(:, :, 1), q(:, :, 2), gg, nu)
      call transform_layers(half, ix, iy, depth, u2, s2)
      call suite%check(maxval(abs(u1 + u2 - u)) < 1e-14_wp*maxval(abs(u)), "superposition: displacements")
      call suite%check(maxval(abs(s1 + s2 - s)) < 1e-14_wp*maxval(abs(s)), "superposition: stresses")

      q = p(:, 4:1:-1, :)
      call new_surface_load(mirrored, grid, q(:, :, 3), q(:, :, 1), -q(:, :, 2), gg, nu)
      call transform_layers(mirrored, ix, iy, depth, u1, s1)
      u1 = u1(:, :, 4:1:-1, :)
      s1 = s1(:, :, 4:1:-1, :)
      u1(2, :, :, :) = -u1(2, :, :, :)
      do i = 2, 5, 3
         s1(i, :, :, :) = -s1(i, :, :, :)
      end do
      call suite%check(maxval(abs(u1 - u)) < 1e-14_wp*maxval(abs(u)), "mirror in y: displacements")
      call suite%check(maxval(abs(s1 - s)) < 1e-14_wp*maxval(abs(s)), "mirror in y: stresses")
   end subroutine linear_and_mirrored

   !> An incompressible body is the limit of nearly incompressible ones, pressure included
   subroutine incompressible(suite)
      type(test_suite), intent(inout) :: suite
      type(surface_load) :: load
      type(potential_contact) :: grid
      real(wp), allocatable :: p(:, :, :)
      integer, parameter :: ix(2) = [3, 6], iy(2) = [1, 3]
      real(wp) :: u(3, 4, 9, 2), s(6, 4, 9, 2)
      integer :: k

      call make_load(8, 5, 0.3_wp, 0.3_wp, [1, 8, 1, 5], .false., grid, p, load)
      do k = 1, 2
         load%nu = merge(0.5_wp, 0.5_wp - 1e-9_wp, k == 1)
         call transform_layers(load, ix, iy, depth, u(:, :, :, k), s(:, :, :, k))
      end do
      call suite%check(maxval(abs(u(:, :, :, 1) - u(:, :, :, 2))) < 1e-8_wp*maxval(abs(u)), "nu = 1/2: displacements")
      call suite%check(maxval(abs(s(:, :, :, 1) - s(:, :, :, 2))) < 1e-8_wp*maxval(abs(s)), "nu = 1/2: stresses")
   end subroutine incompressible

   !> Whatever is chosen, the result is the same; also for points between centres and with empty loads
   subroutine choice(suite)
      type(test_suite), intent(inout) :: suite
      type(surface_load) :: load
      type(potential_contact) :: grid
      type(point_set) :: points, few
      real(wp), allocatable :: p(:, :, :)
      real(wp) :: u(3, 300), s(6, 300), u1(3, 1), s1(6, 1)
      integer :: i

      call make_load(15, 10, 0.3_wp, 0.3_wp, [1, 15, 1, 10], .false., grid, p, load)
      points%x = grid%x([(i, i = 1, 15)])
      points%y = grid%y([(i, i = 1, 10)])
      points%z = [-0.1_wp, 0.2_wp]
      few%x = points%x(4:4)
      few%y = points%y(7:7)
      few%z = points%z(2:2)
      call subsurface_field(load, points, u, s)
      call subsurface_field(load, few, u1, s1)
      call suite%close_to(u(:, 150 + 6*15 + 4), u1(:, 1), 1e-13_wp, "all points and one: displacements")
      call suite%close_to(s(:, 150 + 6*15 + 4), s1(:, 1), 1e-13_wp, "all points and one: stresses")
      few%x = points%x(4:4) + 0.01_wp
      call subsurface_field(load, few, u1, s1)
      call suite%check(maxval(abs(s1(:, 1) - s(:, 150 + 6*15 + 4))) > 1e-6_wp, "a point between centres")
      points%z = [-1e200_wp, 1e59_wp]
      call subsurface_field(load, points, u, s)
      call suite%check(all(s == 0.0_wp) .and. all(abs(u) < 1e-50_wp), "huge depths")
      p = 0.0_wp
      call new_surface_load(load, grid, p(:, :, 3), p(:, :, 1), p(:, :, 2), gg, nu)
      call subsurface_field(load, points, u, s)
      call suite%check(all(u == 0.0_wp) .and. all(s == 0.0_wp), "no loads: no stresses")
      call new_surface_load(load, grid, p(1:0, :, 3), p(1:0, :, 1), p(1:0, :, 2), gg, nu)
      call subsurface_field(load, points, u, s)
      call suite%check(all(u == 0.0_wp), "no elements: no displacements")
   end subroutine choice
end program test_subsurface_layers
