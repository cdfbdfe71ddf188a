!> Processor time of subsurface stresses: transforms against direct sums
program performance_subsurface
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_subsurface_direct, only : number_of_terms, sum_directly
   use contact_subsurface_invariants, only : stress_invariants
   use contact_subsurface_layers, only : transform_layers
   use contact_subsurface_load, only : new_surface_load, surface_load
   use omp_lib, only : omp_set_num_threads
   implicit none (type, external)
   integer, parameter :: sizes(4) = [31, 71, 151, 301]
   integer :: k

   call omp_set_num_threads(1)
   write(*, "(a)") "One thread, processor time. Circle of 0.86 of the window loaded with px, py, pn; all centres, 40 depths"
   write(*, "(a)") "   window  tractions loaded   transforms   per depth  direct, a point  equal cost   direct, all  largest"
   write(*, "(a)") "                    elements      s           ms           us        points/depth       s      difference"
   do k = 1, size(sizes)
      call measure(sizes(k), .false.)
      if (k < 4) call measure(sizes(k), .true.)
   end do
   call measure_invariants()

contains

   !> One line of the table
   subroutine measure(m, bilinear)
      integer, intent(in) :: m
      logical, intent(in) :: bilinear
      integer, parameter :: nz = 40, few = 4
      type(surface_load) :: load
      type(potential_contact) :: grid
      real(wp), allocatable :: p(:, :, :), u(:, :, :, :), s(:, :, :, :)
      real(wp) :: place(3, few*nz), ud(3, few*nz), sd(6, few*nz), z(nz), r2, layers, direct, t0, t1, worst
      integer :: ix, iy, iz, n, step

      grid = potential_contact(m, m, -1.16_wp, -1.16_wp, 2.32_wp/m, 2.32_wp/m)
      allocate(p(m, m, 3), source=0.0_wp)
      do iy = 1, m
         do ix = 1, m
            r2 = grid%x(ix)**2 + grid%y(iy)**2
            if (r2 < 1.0_wp) p(ix, iy, :) = sqrt(1.0_wp - r2)*[0.2_wp*cos(3.0_wp*grid%x(ix)), 0.1_wp*sin(4.0_wp*grid%y(iy)), 1.0_wp]
         end do
      end do
      call new_surface_load(load, grid, p(:, :, 3), p(:, :, 1), p(:, :, 2), [1.0_wp, 1.0_wp], [0.28_wp, 0.28_wp], bilinear)
      z = [(0.05_wp*(iz - 1), iz = 1, nz)]
      allocate(u(3, m, m, nz), s(6, m, m, nz), source=0.0_wp)
      call cpu_time(t0)
      call transform_layers(load, [(ix, ix = 1, m)], [(iy, iy = 1, m)], z, u, s)
      call cpu_time(t1)
      layers = t1 - t0
      step = m/few
      do iz = 1, nz
         do n = 1, few
            place(:, n + few*(iz - 1)) = [grid%x(n*step), grid%y(1 + (n - 1)*step), z(iz)]
         end do
      end do
      call cpu_time(t0)
      call sum_directly(load, place, ud, sd)
      call cpu_time(t1)
      direct = (t1 - t0)/size(place, 2)
      worst = 0.0_wp
      do iz = 1, nz
         do n = 1, few
            worst = max(worst, maxval(abs(sd(:, n + few*(iz - 1)) - s(:, n*step, 1 + (n - 1)*step, iz))))
         end do
      end do
      write(*, "(i5, a, i0, t13, a, i9, f11.3, f12.2, f13.1, i15, f16.1, es13.1)") m, " x ", m, &
         & merge("bilinear", "constant", bilinear), count(p(:, :, 3) > 0.0_wp), layers, layers/nz*1e3_wp, direct*1e6_wp, &
         & nint(layers/nz/direct), direct*m**2*nz, worst/maxval(abs(s))
      if (number_of_terms(load) == 0) error stop
   end subroutine measure

   !> Principal stresses
   subroutine measure_invariants()
      integer, parameter :: n = 200000
      real(wp), allocatable :: s(:, :), v(:, :)
      real(wp) :: t0, t1

      allocate(s(6, n), v(n, 6))
      call random_number(s)
      call cpu_time(t0)
      call stress_invariants(s, v(:, 1), v(:, 2), v(:, 3), v(:, 4), v(:, 5), v(:, 6))
      call cpu_time(t1)
      write(*, "(a, f6.3, a)") "invariants of 200,000 points:", t1 - t0, " s"
   end subroutine measure_invariants
end program performance_subsurface
