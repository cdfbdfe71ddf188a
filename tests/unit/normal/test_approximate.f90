!> Approximate normal pressures as kernels: Hertz's solution, symmetries, degenerate gaps
program test_approximate
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_choices, only : normal_control, pressure_model
   use contact_base_constants, only : excluded_distance, pi
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : solve_report
   use contact_elastic_compliance, only : compliance
   use contact_elastic_material, only : combined_material, combine
   use contact_elastic_model, only : elastic_model
   use contact_elastic_new_compliance, only : new_compliance
   use contact_elastic_pressure_sums, only : pressure_sums
   use contact_grid_potential_contact, only : potential_contact
   use contact_normal_approximate, only : approximate_pressure
   use contact_normal_estimate, only : elliptic_pressure, sdec_pressure
   use contact_normal_hertz, only : hertz_by_curvatures, hertz_contact, hertz_load
   use contact_normal_parts, only : contact_parts
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> Methods that start from the gap, with their names
   integer, parameter :: methods(2) = [pressure_model%kpec, pressure_model%analyn]
   character(len=6), parameter :: name_of(2) = ["KPEC  ", "ANALYN"]
   type(test_suite) :: suite

   call suite%start("approximate normal methods")
   call quadratic_surfaces(suite)
   call sizes_of_bodies(suite)
   call rolled_profile(suite)
   call degenerate_gaps(suite)
   call warning_at_edge(suite)
   call double_ellipse(suite)
   call mirrors(suite)
   call no_jumps(suite)
   call missed_overlap(suite)
   call sums_and_transforms(suite)
   call suite%finish()

contains

   !> Pressures by KPEC follow the gap without jumps: where the deepest point changes from a hump to a wider one, and while an
   !> overlap of several rows grows. The force then changes in 400 small steps by much the same amount
   subroutine no_jumps(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: n = 400
      type(potential_contact) :: grid
      real(wp), allocatable :: gap(:, :), pn(:, :)
      real(wp) :: force(0:n), y, approach, tilt
      integer :: i, ix, iy, series
      character(len=60) :: what

      grid = window(41, 60, 8.0_wp, 14.0_wp)
      allocate(gap(grid%mx, grid%my))
      do series = 1, 2
         do i = 0, n
            approach = 0.05_wp
            tilt = 0.0_wp
            if (series == 1) tilt = 1.0e-7_wp*(i - n/2)
            if (series == 2) approach = 0.05_wp*(1.0_wp + 1.0e-4_wp*i)
            do iy = 1, grid%my
               y = grid%y(iy)
               do ix = 1, grid%mx
                  gap(ix, iy) = grid%x(ix)**2/920.0_wp + tilt*y - approach
                  if (series == 1) then
                     gap(ix, iy) = gap(ix, iy) + min((y + 5.0_wp)**2/200.0_wp, (y - 5.0_wp)**2/1200.0_wp)
                  else
                     gap(ix, iy) = gap(ix, iy) + 3.0e-5_wp*(y - 1.3_wp)**4
                  end if
               end do
            end do
            pn = pressure_of(pressure_model%kpec, grid, gap)
            force(i) = sum(pn)*grid%dx*grid%dy
         end do
         write(what, "(A,I0,A,ES9.2,A)") "KPEC without jumps, series ", series, ": largest step", &
            & maxval(abs(force(1:) - force(:n - 1)))/force(0), " of FN"
         call suite%check(maxval(abs(force(1:) - force(:n - 1))) < 1.0e-3_wp*force(0), trim(what))
      end do
   end subroutine no_jumps

   !> Overlapping surfaces without any pressure are reported: here they are flatter than the smallest curvature of ANALYN
   subroutine missed_overlap(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid
      real(wp), allocatable :: pn(:, :)
      integer :: warnings

      grid = window(4, 6, 92.0_wp, 147.0_wp)
      pn = pressure_of(pressure_model%analyn, grid, quadratic_gap(grid, 1.9e-6_wp, 8.9e-7_wp, 5.0e-3_wp), warnings)
      call suite%check(any(pn > 0.0_wp) .or. warnings > 0, "missing contact in spite of overlap is reported")
      pn = pressure_of(pressure_model%analyn, grid, quadratic_gap(grid, 1.9e-6_wp, 8.9e-7_wp, -5.0e-3_wp), warnings)
      call suite%equal(warnings, 0, "no warning for surfaces that do not overlap")
   end subroutine missed_overlap

   !> Mirrored surfaces have mirrored pressures, on grids of odd and even size that are coarse, with humps of equal height, and
   !> wherever the smallest gap is due to round-off
   subroutine mirrors(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid
      real(wp), allocatable :: gap(:, :), pn(:, :), image(:, :)
      integer :: i, shape_, mx, my, ix, iy
      real(wp) :: x, y

      do mx = 20, 21
         do my = 4, 7
            grid = window(mx, my, 3.0_wp, 2.0_wp)
            allocate(gap(mx, my))
            do shape_ = 1, 4
               do iy = 1, my
                  do ix = 1, mx
                     x = grid%x(ix)
                     y = grid%y(iy)
                     select case (shape_)
                     case (1)
                        gap(ix, iy) = 0.01_wp*x**2 + 0.02_wp*y**2
                     case (2)
                        ! waves across the rolling direction: several humps are equally deep
                        gap(ix, iy) = 0.002_wp*sin(4.2_wp*x) + 0.002_wp*x**2 + 0.02_wp*y**2
                     case (3)
                        gap(ix, iy) = 1.0e-3_wp*(x**2 - 1.5_wp)**2 + 0.02_wp*y**2 + 1.0e-3_wp*y
                     case default
                        gap(ix, iy) = 0.01_wp*(x - 0.3_wp)**2 + 0.02_wp*abs(y - 0.2_wp)**3 + 0.003_wp*x*y
                     end select
                  end do
               end do
               gap = gap - minval(gap) - 0.02_wp
               do i = 1, size(methods)
                  pn = pressure_of(methods(i), grid, gap)
                  image = pressure_of(methods(i), grid, gap(mx:1:-1, :))
                  call suite%close_to(maxval(abs(image(mx:1:-1, :) - pn)), 0.0_wp, 1.0e-7_wp*maxval(pn), name_of(i) // &
                     & ": mirrored in x")
                  image = pressure_of(methods(i), grid, gap(:, my:1:-1))
                  call suite%close_to(maxval(abs(image(:, my:1:-1) - pn)), 0.0_wp, 1.0e-7_wp*maxval(pn), name_of(i) // &
                     & ": mirrored in y")
                  if (shape_ /= 1 .and. shape_ /= 3) cycle
                  call suite%close_to(maxval(abs(pn(mx:1:-1, :) - pn)), 0.0_wp, 1.0e-7_wp*maxval(pn), name_of(i) // &
                     & ": symmetric in x as the gap is")
                  ! round-off determines the position of the smallest gap
                  image = gap*(1.0_wp + 1.0e-15_wp*spread([(real(mod(7*ix, 5), wp), ix=1, mx)], 2, my))
                  image = pressure_of(methods(i), grid, image)
                  call suite%close_to(maxval(abs(image - pn)), 0.0_wp, 1.0e-6_wp*maxval(pn), name_of(i) // ": rounding")
               end do
            end do
            deallocate(gap)
         end do
      end do
      grid = window(13, 10, 3.0_wp, 2.0_wp)
      pn = reshape([(0.0_wp, i=1, 130)], [13, 10])
      image = pn
      call sdec_pressure(grid, 2.0_wp, 0.7_wp, 1.5_wp, 100.0_wp, pn)
      call sdec_pressure(grid, 2.0_wp, 1.5_wp, 0.7_wp, 100.0_wp, image)
      call suite%close_to(maxval(abs(image(:, 10:1:-1) - pn)), 0.0_wp, 1.0e-12_wp*maxval(pn), "SDEC: mirrored in y")
   end subroutine mirrors

   !> Square window around the origin
   pure function window(mx, my, half_x, half_y) result(grid)
      integer, intent(in) :: mx, my
      !> Half of the sides [mm]
      real(wp), intent(in) :: half_x, half_y
      type(potential_contact) :: grid

      grid = potential_contact(mx, my, -half_x, -half_y, 2.0_wp*half_x/mx, 2.0_wp*half_y/my)
   end function window

   !> Displacements of the deepest elements by sums, and by transforms
   subroutine sums_and_transforms(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid
      real(wp), allocatable :: one(:, :), other(:, :)
      integer :: n

      do n = 10, 60, 25
         grid = window(n, n + 7, 6.0_wp, 5.0_wp)
         one = pressure_of(pressure_model%kpec, grid, quadratic_gap(grid, 1.1e-3_wp, 2.3e-3_wp, 0.02_wp))
         other = pressure_of(pressure_model%kpec, grid, quadratic_gap(grid, 1.1e-3_wp, 2.3e-3_wp, 0.02_wp), by_transforms=.true.)
         call suite%check(maxval(one) > 0.0_wp, "there is contact")
         call suite%close_to([other], [one], 1.0e-12_wp*maxval(one), "sums and transforms")
      end do
   end subroutine sums_and_transforms

   !> Pressures of one method, steel
   function pressure_of(model, grid, gap, warnings, by_transforms) result(pn)
      integer, intent(in) :: model
      type(potential_contact), intent(in) :: grid
      real(wp), intent(in) :: gap(:, :)
      integer, intent(out), optional :: warnings
      !> By the operator of the window, as for bodies without one table of coefficients
      logical, intent(in), optional :: by_transforms
      real(wp), allocatable :: pn(:, :)
      real(wp), allocatable :: copy(:, :)
      class(compliance), allocatable :: operator
      type(pressure_sums), allocatable :: sums
      type(contact_parts), allocatable :: parts
      type(combined_material) :: material
      type(solve_report) :: report
      type(log_type) :: log

      material = steel()
      copy = gap
      allocate(pn, mold=copy)
      if (present(by_transforms)) then
         call new_compliance(elastic_model(material), operator)
         call operator%prepare(elastic_model(material), grid%dx, grid%dy, grid%mx, grid%my, 1)
      else
         allocate(sums)
         call sums%prepare(elastic_model(material), grid%dx, grid%dy, grid%mx, grid%my)
      end if
      call approximate_pressure(model, grid, copy, material%gg/(1.0_wp - material%nu), parts, operator, sums, pn, report, log)
      if (present(warnings)) warnings = log%warnings
      if (allocated(operator)) call operator%release()
   end function pressure_of

   pure function steel() result(material)
      type(combined_material) :: material
      material = combine([0.28_wp, 0.28_wp], [82000.0_wp, 82000.0_wp])
   end function steel

   !> Quadratic gap less an approach
   pure function quadratic_gap(grid, a1, b1, pen) result(gap)
      type(potential_contact), intent(in) :: grid
      !> Curvatures [1/mm], approach [mm]
      real(wp), intent(in) :: a1, b1, pen
      real(wp) :: gap(grid%mx, grid%my)
      integer :: ix, iy

      do iy = 1, grid%my
         do ix = 1, grid%mx
            gap(ix, iy) = a1*grid%x(ix)**2 + b1*grid%y(iy)**2 - pen
         end do
      end do
   end function quadratic_gap

   !> Hertz's solution is exact for both methods; remaining errors are those of the grid
   subroutine quadratic_surfaces(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: a1 = 2.5e-3_wp, pen = 0.03_wp
      real(wp), parameter :: ratios(5) = [0.05_wp, 0.3_wp, 1.0_wp, 2.0_wp, 15.0_wp]
      integer, parameter :: sizes(4) = [20, 21, 61, 120]
      type(combined_material) :: material
      type(hertz_contact) :: hertz
      type(potential_contact) :: grid
      real(wp), allocatable :: pn(:, :), exact(:, :)
      real(wp) :: modulus, area, tolerance, worst(3)
      character(len=60) :: what
      integer :: k, m, j

      material = steel()
      modulus = material%gg/(1.0_wp - material%nu)
      do j = 1, size(sizes)
         do m = 1, size(methods)
            worst = 0.0_wp
            do k = 1, size(ratios)
               hertz = hertz_by_curvatures(hertz_load(normal_control%approach, pen=pen, modulus=modulus), a1, ratios(k)*a1)
               grid = window(sizes(j), sizes(j), 1.3_wp*hertz%aa, 1.3_wp*hertz%bb)
               pn = pressure_of(methods(m), grid, quadratic_gap(grid, a1, ratios(k)*a1, pen))
               allocate(exact, mold=pn)
               call elliptic_pressure(grid, hertz%aa, hertz%bb, .false., hertz%fn, exact)
               area = pi*hertz%aa*hertz%bb
               worst = max(worst, abs([sum(pn)*grid%dx*grid%dy/hertz%fn, count(pn > 0.0_wp)*grid%dx*grid%dy/area, &
                  & maxval(pn)/(1.5_wp*hertz%fn/area)] - 1.0_wp))
               write(what, "(2a, f6.2, a, i4)") trim(name_of(m)), ", curvature ratio", ratios(k), ", grid of", sizes(j)
               tolerance = 0.5_wp/real(sizes(j), wp)
               call suite%close_to(sum(pn)*grid%dx*grid%dy, hertz%fn, tolerance, what // ": force", relative=.true.)
               call suite%close_to(maxval(abs(pn - exact), exact > 0.4_wp*maxval(exact))/maxval(exact), 0.0_wp, tolerance, &
                  & what // ": pressures away from the rim")
               call suite%check(all(abs(pn - pn(grid%mx:1:-1, :)) <= 1.0e-9_wp*maxval(pn)), what // ": symmetric along x")
               deallocate(exact)
            end do
            print "(2a,i4,a,3f8.4)", trim(name_of(m)), ", grid of", sizes(j), &
               & ": largest relative error of force, area, highest pressure", worst
         end do
      end do
   end subroutine quadratic_surfaces

   !> Large and small bodies: with all lengths times a factor pressures stay, also where curvatures are below 1e-4 per mm
   subroutine sizes_of_bodies(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: factors(4) = [1.0e-3_wp, 10.0_wp, 1.0e3_wp, 1.0e6_wp], ratios(3) = [0.3_wp, 1.0_wp, 8.0_wp]
      type(potential_contact) :: grid
      real(wp), allocatable :: pn(:, :), other(:, :)
      character(len=60) :: what
      integer :: k, m, j

      do m = 1, size(methods)
         do j = 1, size(ratios)
            grid = window(24, 25, 6.0_wp, 6.0_wp)
            pn = pressure_of(methods(m), grid, quadratic_gap(grid, 2.5e-3_wp, ratios(j)*2.5e-3_wp, 0.03_wp))
            do k = 1, size(factors)
               write(what, "(2a, f6.2, a, es8.1)") trim(name_of(m)), ", curvature ratio", ratios(j), ", lengths times", factors(k)
               grid = window(24, 25, 6.0_wp*factors(k), 6.0_wp*factors(k))
               other = pressure_of(methods(m), grid, quadratic_gap(grid, 2.5e-3_wp/factors(k), ratios(j)*2.5e-3_wp/factors(k), &
                  & 0.03_wp*factors(k)))
               call suite%close_to(other, pn, 1.0e-9_wp*maxval(pn), trim(what))
            end do
         end do
      end do
   end subroutine sizes_of_bodies

   !> A wheel on a worn rail, not symmetric: mirrored surfaces give mirrored pressures, and moduli scale
   subroutine rolled_profile(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid
      real(wp), allocatable :: gap(:, :), pn(:, :), other(:, :)
      real(wp) :: x, y
      integer :: m, ix, iy

      grid = window(37, 53, 8.0_wp, 12.0_wp)
      allocate(gap(grid%mx, grid%my))
      do iy = 1, grid%my
         do ix = 1, grid%mx
            x = grid%x(ix) - 0.03_wp
            y = grid%y(iy) - 0.7_wp
            gap(ix, iy) = x**2/920.0_wp + y**2/700.0_wp + 2.0e-5_wp*y**3 + 4.0e-6_wp*y**4 + 1.0e-4_wp*x*y - 0.021_wp
         end do
      end do
      do m = 1, size(methods)
         pn = pressure_of(methods(m), grid, gap)
         call suite%check(all(pn >= 0.0_wp) .and. any(pn > 0.0_wp), trim(name_of(m)) // " presses the profile")
         call suite%check(all(pn <= 0.0_wp .or. gap < 0.0_wp), trim(name_of(m)) // ": contact only where surfaces overlap")
         other = pressure_of(methods(m), grid, gap(:, grid%my:1:-1))
         call suite%check(all(abs(pn - other(:, grid%my:1:-1)) <= 1.0e-9_wp*maxval(pn)), trim(name_of(m)) // " mirrored in y")
         other = pressure_of(methods(m), grid, gap(grid%mx:1:-1, :))
         call suite%check(all(abs(pn - other(grid%mx:1:-1, :)) <= 1.0e-9_wp*maxval(pn)), trim(name_of(m)) // " mirrored in x")
         other = pressure_of(methods(m), grid, gap + 0.021_wp)
         call suite%check(all(other <= 0.0_wp), trim(name_of(m)) // ": no pressure without overlap")
      end do
   end subroutine rolled_profile

   !> Gaps that no curvature describes: every method ends, with pressures that press
   subroutine degenerate_gaps(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid
      real(wp), allocatable :: gap(:, :)
      integer :: ix, iy

      grid = window(15, 17, 3.0_wp, 4.0_wp)
      gap = quadratic_gap(grid, 0.01_wp, 0.01_wp, 0.02_wp)
      call press(suite, grid, spread(spread(-0.01_wp, 1, 15), 2, 17), "flat")
      call press(suite, grid, quadratic_gap(grid, 0.01_wp, 0.0_wp, 0.02_wp), "cylinder across")
      call press(suite, grid, quadratic_gap(grid, 0.0_wp, 0.01_wp, 0.02_wp), "cylinder along")
      call press(suite, grid, quadratic_gap(grid, 0.01_wp, 0.01_wp, 1.0_wp), "window full of overlap")
      call press(suite, grid, quadratic_gap(grid, -0.001_wp, -0.001_wp, 0.001_wp), "lowest at the corners")
      call press(suite, grid, eoshift(gap, 7, boundary=1.0_wp), "lowest in the first column")
      call press(suite, grid, eoshift(gap, -8, boundary=1.0_wp, dim=2), "lowest in the last row")
      call press(suite, grid, quadratic_gap(grid, 4.0_wp, 4.0_wp, 0.01_wp), "one element in contact")
      call press(suite, grid, quadratic_gap(grid, 0.01_wp, 0.01_wp, 1.0e-200_wp), "hardly touching", touches=.false.)
      call press(suite, grid, spread([(0.001_wp*ix - 0.01_wp, ix=1, 15)], 2, 17), "inclined plane along")
      call press(suite, grid, spread([(0.001_wp*iy - 0.01_wp, iy=1, 17)], 1, 15), "inclined plane across")
      gap = quadratic_gap(grid, 0.01_wp, 0.0_wp, 0.02_wp) &
         & + spread([(0.005_wp*(abs(grid%y(iy)) - 2.0_wp)**2, iy=1, 17)], 1, 15)
      call press(suite, grid, gap, "two humps across")
      gap = quadratic_gap(grid, 0.0_wp, 0.01_wp, 0.02_wp) &
         & + spread([(0.02_wp*(abs(grid%x(ix)) - 1.5_wp)**2, ix=1, 15)], 2, 17)
      call press(suite, grid, gap, "two humps along")
      gap = quadratic_gap(grid, 0.01_wp, 0.01_wp, 0.02_wp)
      gap(7, :) = excluded_distance
      gap(:, 10) = excluded_distance
      call press(suite, grid, gap, "excluded elements beside the lowest point")
      gap = excluded_distance
      gap(8, 9) = -0.01_wp
      call press(suite, grid, gap, "all excluded but one")
      gap = excluded_distance
      call press(suite, grid, gap, "all excluded", touches=.false.)
      do iy = 1, 17
         do ix = 1, 15
            gap(ix, iy) = 0.01_wp*sin(12345.0_wp*ix)*cos(777.0_wp*iy + ix)
         end do
      end do
      call press(suite, grid, gap, "rough")
      grid = window(15, 1, 3.0_wp, 100.0_wp)
      call press(suite, grid, quadratic_gap(grid, 0.01_wp, 0.0_wp, 0.02_wp), "one row")
      grid = window(1, 15, 100.0_wp, 3.0_wp)
      call press(suite, grid, quadratic_gap(grid, 0.0_wp, 0.01_wp, 0.02_wp), "one column")
      grid = window(2, 2, 3.0_wp, 3.0_wp)
      call press(suite, grid, quadratic_gap(grid, 0.01_wp, 0.01_wp, 0.05_wp), "four elements")
      grid = window(1, 1, 1.0_wp, 1.0_wp)
      call press(suite, grid, quadratic_gap(grid, 0.01_wp, 0.01_wp, 0.02_wp), "one element")
   end subroutine degenerate_gaps

   subroutine press(suite, grid, gap, what, touches)
      type(test_suite), intent(inout) :: suite
      type(potential_contact), intent(in) :: grid
      real(wp), intent(in) :: gap(:, :)
      character(len=*), intent(in) :: what
      !> Is contact expected? Default yes
      logical, intent(in), optional :: touches
      real(wp), allocatable :: pn(:, :)
      logical :: expected
      integer :: m

      expected = .true.
      if (present(touches)) expected = touches
      do m = 1, size(methods)
         pn = pressure_of(methods(m), grid, gap)
         call suite%check(all(ieee_is_finite(pn)) .and. all(pn >= 0.0_wp), trim(name_of(m)) // ", " // what // ": finite")
         call suite%check(any(pn > 0.0_wp) .eqv. expected, trim(name_of(m)) // ", " // what // ": contact as expected")
      end do
   end subroutine press

   !> The warning is given if and only if overlap reaches the edge
   subroutine warning_at_edge(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid
      real(wp), allocatable :: pn(:, :)
      integer :: warnings

      grid = window(21, 21, 1.0_wp, 1.0_wp)
      pn = pressure_of(pressure_model%kpec, grid, quadratic_gap(grid, 0.01_wp, 0.01_wp, 0.005_wp), warnings)
      call suite%equal(warnings, 0, "no warning with a margin")
      pn = pressure_of(pressure_model%kpec, grid, quadratic_gap(grid, 0.01_wp, 0.01_wp, 0.012_wp), warnings)
      call suite%equal(warnings, 1, "warning for overlap at the edge")
      grid = window(21, 1, 1.0_wp, 1.0_wp)
      pn = pressure_of(pressure_model%analyn, grid, quadratic_gap(grid, 0.01_wp, 0.01_wp, 0.005_wp), warnings)
      call suite%equal(warnings, 0, "one row is a line contact, without an edge across")
   end subroutine warning_at_edge

   !> SDEC: an ellipse when symmetric, mirrored when mirrored, and of the prescribed force
   subroutine double_ellipse(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: fn = 5000.0_wp
      type(potential_contact) :: grid
      real(wp), allocatable :: pn(:, :), other(:, :)

      grid = window(80, 90, 5.0_wp, 5.0_wp)
      allocate(pn(80, 90), other(80, 90))
      call sdec_pressure(grid, 4.0_wp, 3.0_wp, 3.0_wp, fn, pn)
      call elliptic_pressure(grid, 4.0_wp, 3.0_wp, .false., fn, other)
      call suite%check(all(abs(pn - other) <= 1.0e-12_wp*maxval(pn)), "SDEC with equal halves is an ellipse")
      call sdec_pressure(grid, 4.0_wp, 1.0_wp, 5.0_wp, fn, pn)
      call sdec_pressure(grid, 4.0_wp, 5.0_wp, 1.0_wp, fn, other)
      call suite%check(all(abs(pn - other(:, 90:1:-1)) <= 1.0e-12_wp*maxval(pn)), "SDEC mirrored")
      call suite%close_to(sum(pn)*grid%dx*grid%dy, fn, 5.0e-3_wp, "SDEC has the prescribed force", relative=.true.)
      call suite%close_to(count(pn > 0.0_wp)*grid%dx*grid%dy, 12.0_wp*pi, 1.0e-2_wp, "SDEC has the area of an ellipse", &
         & relative=.true.)
      call sdec_pressure(grid, 4.0_wp, 1.0e-9_wp, 5.0_wp, fn, pn)
      call suite%check(all(ieee_is_finite(pn)) .and. all(pn >= 0.0_wp), "SDEC with one half missing")
      call sdec_pressure(grid, 0.0_wp, 1.0_wp, 1.0_wp, fn, pn)
      call suite%check(all(abs(pn) <= 0.0_wp), "SDEC without an area")
   end subroutine double_ellipse
end program test_approximate
