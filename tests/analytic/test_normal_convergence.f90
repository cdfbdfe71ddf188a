!> Hertz's solutions against the solver under grid refinement, and Love's single element
program test_normal_convergence
   use, intrinsic :: iso_fortran_env, only : output_unit
   use contact_base_choices, only : motion
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_test_case_builder, only : creep, ellipse_case, grid_case, hertz_case, line_case, observed, random_numbers, &
      & test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)

   real(wp), parameter :: gg = 200.0_wp, nu = 0.28_wp, modulus = gg/(1.0_wp - nu)
   !> Elements across the window (odd: one in the centre); a fixed ratio of window and contact that is no simple fraction
   !> makes the rim cut the elements differently on each grid
   integer, parameter :: sizes(*) = [15, 25, 43, 73, 125, 213]
   real(wp), parameter :: window = 1.137_wp
   type(test_suite) :: suite

   call suite%start("normal convergence")
   call sphere(suite)
   call ellipse(suite, 3.0_wp)
   call ellipse(suite, 0.2_wp)
   call cylinder(suite)
   call shifted_grids(suite)
   call single_element(suite)
   call suite%finish()

contains

   !> a**2 = R delta, F = 4/3 E* sqrt(R) delta**1.5, p0 = 2 E*/pi sqrt(delta/R); Johnson (1985), 4.2
   subroutine sphere(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: radius = 50.0_wp, aa = 1.0_wp, pen = aa**2/radius
      real(wp), parameter :: fn = 4.0_wp/3.0_wp*modulus*sqrt(radius*pen)*pen, peak = 1.5_wp*fn/(pi*aa**2)

      call refine(suite, "circle", 0.5_wp/radius, 0.5_wp/radius, fn, pen, peak, aa, aa)
   end subroutine sphere

   !> Curvatures, approach by Hertz: closed forms with elliptic integrals, see test_hertz
   subroutine ellipse(suite, ratio)
      type(test_suite), intent(inout) :: suite
      real(wp), intent(in) :: ratio
      type(test_case) :: case
      real(wp), parameter :: fn = 30.0_wp
      character(len=32) :: name

      write(name, "(a, f4.1)") "ellipse a/b =", ratio
      case%spec = ellipse_case(1.0_wp, 1.0_wp/ratio, fn, 5, 5)
      call case%run(suite, trim(name))
      associate (hertz => case%result%hertz)
         call refine(suite, trim(name), hertz%a1, hertz%b1, fn, hertz%pen, 1.5_wp*fn*ratio/pi, 1.0_wp, 1.0_wp/ratio)
      end associate
      call case%release()
   end subroutine ellipse

   !> Errors on a sequence of grids, and their order
   subroutine refine(suite, name, a1, b1, fn, pen, peak, aa, bb)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: a1, b1, fn, pen, peak, aa, bb
      real(wp), dimension(size(sizes)) :: h, e_pen, e_peak, e_area, e_field
      real(wp) :: exact
      type(test_case) :: case
      integer :: k, ix, iy

      do k = 1, size(sizes)
         case%spec = hertz_case(a1, b1, fn, sizes(k), sizes(k), window)
         call case%run(suite, name)
         associate (r => case%result)
            h(k) = 1.0_wp/sizes(k)
            e_pen(k) = r%pen/pen - 1.0_wp
            e_peak(k) = r%pmax/peak - 1.0_wp
            e_area(k) = sqrt(r%ncon*r%grid%dx*r%grid%dy/(pi*aa*bb)) - 1.0_wp
            e_field(k) = 0.0_wp
            do iy = 1, r%grid%my
               do ix = 1, r%grid%mx
                  exact = peak*sqrt(max(0.0_wp, 1.0_wp - (r%grid%x(ix)/aa)**2 - (r%grid%y(iy)/bb)**2))
                  e_field(k) = e_field(k) + abs(r%pn(ix, iy) - exact)*r%grid%dx*r%grid%dy/fn
               end do
            end do
            call suite%close_to(r%fn, fn, 1.0e-12_wp, name // ": force", relative=.true.)
         end associate
      end do
      call observed(suite, name // ", approach", h, e_pen, 2.0_wp, 0.4_wp, 1.0e-5_wp)
      call observed(suite, name // ", peak pressure", h, e_peak, 2.0_wp, 0.4_wp, 1.0e-5_wp)
      call observed(suite, name // ", contact radius", h(2:), e_area(2:), 1.0_wp, 0.25_wp, 2.0e-3_wp)
      call observed(suite, name // ", pressures (L1)", h, e_field, 1.5_wp, 0.2_wp, 4.0e-4_wp)
      call case%release()
   end subroutine refine

   !> a**2 = 4 P R/(pi E*), p0 = 2 P/(pi a); Johnson (1985), 4.2(c)
   subroutine cylinder(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: aa = 1.0_wp, bb = 1.0e4_wp, load = 20.0_wp, peak = 2.0_wp*load/(pi*aa)
      real(wp), dimension(size(sizes)) :: h, e_peak, e_width, e_field
      type(test_case) :: case
      real(wp) :: exact
      integer :: k, ix

      do k = 1, size(sizes)
         case%spec = line_case(aa, bb, 2.0_wp*load*bb, sizes(k), window)
         call case%run(suite, "cylinder")
         associate (r => case%result)
            h(k) = 1.0_wp/sizes(k)
            e_peak(k) = r%pmax/peak - 1.0_wp
            e_width(k) = 0.5_wp*r%ncon*r%grid%dx/aa - 1.0_wp
            e_field(k) = 0.0_wp
            do ix = 1, r%grid%mx
               exact = peak*sqrt(max(0.0_wp, 1.0_wp - (r%grid%x(ix)/aa)**2))
               e_field(k) = e_field(k) + abs(r%pn(ix, 1) - exact)*r%grid%dx/load
            end do
         end associate
      end do
      call observed(suite, "cylinder, peak pressure", h, e_peak, 2.0_wp, 0.4_wp, 1.0e-5_wp)
      call observed(suite, "cylinder, half width", h(2:), e_width(2:), 1.3_wp, 0.4_wp, 1.0e-2_wp)
      call observed(suite, "cylinder, pressures (L1)", h, e_field, 1.5_wp, 0.3_wp, 4.0e-4_wp)
      call case%release()
   end subroutine cylinder

   !> The largest pressure of order 2 hardly depends on where the grid lies, and its error falls as n^-2
   subroutine shifted_grids(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: radius = 50.0_wp, aa = 1.0_wp, fn = 4.0_wp/3.0_wp*modulus*aa**3/radius, peak = 1.5_wp*fn/(pi*aa**2)
      integer, parameter :: across(*) = [10, 20, 40], offsets = 16
      real(wp) :: error(offsets, 2), deviation(2), h(size(across)), mean(size(across)), shift(2)
      type(test_case) :: case
      type(random_numbers) :: random
      integer :: k, i, order

      do k = 1, size(across)
         h(k) = 2.0_wp*aa/across(k)
         do i = 1, offsets
            shift = [random%uniform(-0.5_wp, 0.5_wp), random%uniform(-0.5_wp, 0.5_wp)]
            do order = 1, 2
               case%spec = grid_case(0.5_wp/radius, 0.5_wp/radius, fn, across(k) + 3, across(k) + 3, h(k), h(k))
               case%spec%grid%xl = case%spec%grid%xl + shift(1)*h(k)
               case%spec%grid%yl = case%spec%grid%yl + shift(2)*h(k)
               case%spec%iteration%order = order
               call creep(case%spec, motion%steady_rolling, 1.0e-3_wp)
               call case%run(suite, "shifted grid")
               error(i, order) = case%result%pmax/peak - 1.0_wp
            end do
            call suite%check(error(i, 2) >= error(i, 1), "a peak is not below the largest pressure of an element")
         end do
         deviation = sqrt(sum((error - spread(sum(error, 1)/offsets, 1, offsets))**2, 1)/offsets)
         write(output_unit, "(a, i0, a, 2es9.1)") "largest pressure, ", across(k), " elements: deviation by order", deviation
         call suite%check(deviation(2) < deviation(1)/3.0_wp, "the largest pressure of order 2 hardly depends on the offset")
         mean(k) = sum(error(:, 2))/offsets
      end do
      call observed(suite, "sphere, peak between centres", h, mean, 2.0_wp, 0.3_wp, 2.0e-4_wp)
      call case%release()
   end subroutine shifted_grids

   !> Love (1929): displacement in the centre of a uniformly loaded rectangle
   subroutine single_element(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: sides(2, 4) = reshape([1.0_wp, 1.0_wp, 0.3_wp, 0.4_wp, 2.0_wp, 0.1_wp, 1.0e-3_wp, 5.0_wp], [2, 4])
      real(wp), parameter :: fn = 3.0_wp
      real(wp) :: expected, dx, dy
      type(test_case) :: case
      integer :: k

      do k = 1, size(sides, 2)
         dx = sides(1, k)
         dy = sides(2, k)
         case%spec = grid_case(0.01_wp, 0.02_wp, fn, 1, 1, dx, dy)
         call case%run(suite, "one element")
         expected = 2.0_wp*fn/(dx*dy*pi*modulus)*(dx*asinh(dy/dx) + dy*asinh(dx/dy))
         call suite%close_to(case%result%pen, expected, 1.0e-12_wp, "approach of one element", relative=.true.)
      end do
      call case%release()
   end subroutine single_element
end program test_normal_convergence
