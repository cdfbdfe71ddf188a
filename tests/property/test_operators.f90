!> The compliance operators: fast products against direct sums, coefficients against quadrature
program test_operators
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_elastic_halfspace, only : fill_shifted_table, fill_table, kernel_table
   use contact_elastic_material, only : combine, combined_material
   use contact_elastic_model, only : elastic_model
   use contact_elastic_operator, only : elastic_operator, normal_inverse_of_two, normal_of_two
   use contact_elastic_previous, only : previous_operator
   use contact_test_case_builder, only : random_numbers
   use contact_test_harness, only : test_suite
   implicit none (type, external)

   !> Sums of N terms by transforms, relative to the largest value
   real(wp), parameter :: rounding = 500.0_wp*epsilon(1.0_wp)
   integer, parameter :: shapes(2, 12) = reshape([1, 1, 1, 7, 9, 1, 2, 2, 3, 5, 13, 4, 17, 17, &
      & 16, 11, 31, 8, 6, 29, 37, 1, 1, 40], [2, 12])
   type(test_suite) :: suite
   type(random_numbers) :: random
   integer :: k

   call suite%start("operators")
   write(*, "(a, i0)") "seed ", random%state
   do k = 1, size(shapes, 2)
      call products(suite, random, shapes(1, k), shapes(2, k))
   end do
   call symmetry(suite, random)
   call quadrature(suite)
   call zero_kernel(suite)
   call suite%finish()

contains

   !> All products on one window, for random element shapes and materials
   subroutine products(suite, random, mx, my)
      type(test_suite), intent(inout) :: suite
      type(random_numbers), intent(inout) :: random
      integer, intent(in) :: mx, my
      type(elastic_operator) :: operator
      type(previous_operator) :: previous
      type(combined_material) :: material
      type(kernel_table) :: table, ahead, old
      real(wp) :: pn(mx, my), pt(mx, my, 2), un(mx, my), ut(mx, my, 2), vn(mx, my), vt(mx, my, 2), dx, dy, sx, sy
      integer :: ix, iy, direction
      character(len=24) :: name

      write(name, "(i0, a, i0)") mx, " x ", my
      dx = random%logarithmic(0.05_wp, 1.0_wp)
      dy = random%logarithmic(0.05_wp, 1.0_wp)
      material = combine([random%uniform(0.0_wp, 0.2_wp), random%uniform(0.3_wp, 0.5_wp)], &
         & [random%logarithmic(1.0_wp, 1.0e5_wp), random%logarithmic(1.0_wp, 1.0e5_wp)])
      do iy = 1, my
         do ix = 1, mx
            pn(ix, iy) = random%uniform(0.0_wp, 1.0_wp)
            pt(ix, iy, :) = [random%uniform(-1.0_wp, 1.0_wp), random%uniform(-1.0_wp, 1.0_wp)]
         end do
      end do
      call fill_shifted_table(table, material, dx, dy, mx, my, 0.0_wp, 0.0_wp)
      do direction = -1, 1, 2
         call operator%prepare(elastic_model(material), dx, dy, mx, my, direction)
         call fill_shifted_table(ahead, material, dx, dy, mx, my, direction*dx, 0.0_wp)
         call operator%normal(pn, un)
         call direct(table%nn, pn, vn)
         call near(suite, [un], [vn], name // ": normal")
         call normal_of_two(operator, pt, ut)
         call direct(table%nn, pt(:, :, 1), vt(:, :, 1))
         call direct(table%nn, pt(:, :, 2), vt(:, :, 2))
         call near(suite, [ut], [vt], name // ": normal, two fields")
         call normal_inverse_of_two(operator, pt, ut)
         call operator%normal_inverse(pt(:, :, 1), vt(:, :, 1))
         call operator%normal_inverse(pt(:, :, 2), vt(:, :, 2))
         call near(suite, [ut], [vt], name // ": inverse, two fields")
         call operator%tangential(pt, ut)
         call direct_pair(table, pt, vt)
         call near(suite, [ut], [vt], name // ": tangential")
         call operator%steady(pt, ut)
         call direct_pair(ahead, pt, vt)
         call direct_difference(table, pt, vt)
         call near(suite, [ut], [vt], name // ": steady rolling")
         call operator%normal_by_tangential(pt, un)
         call direct(-table%xn, pt(:, :, 1), vn)
         call direct(-table%yn, pt(:, :, 2), un, vn)
         call operator%normal_by_tangential(pt, un)
         call near(suite, [un], [vn], name // ": normal by tangential")
         call operator%tangential_by_normal(pn, ut)
         call direct(table%xn, pn, vt(:, :, 1))
         call direct(table%yn, pn, vt(:, :, 2))
         call near(suite, [ut], [vt], name // ": tangential by normal")
         call operator%steady_by_normal(pn, ut)
         call direct(table%xn - ahead%xn, pn, vt(:, :, 1))
         call direct(table%yn - ahead%yn, pn, vt(:, :, 2))
         call near(suite, [ut], [vt], name // ": steady by normal")
      end do
      sx = random%uniform(-2.0_wp, 2.0_wp)*dx
      sy = random%uniform(-2.0_wp, 2.0_wp)*dy
      if (my == 1) sy = 0.0_wp
      call previous%prepare(elastic_model(material), dx, dy, mx, my, sx, sy)
      call previous%tangential(pt(:, :, 1), pt(:, :, 2), pn, ut(:, :, 1), ut(:, :, 2))
      call fill_shifted_table(old, material, dx, dy, mx, my, sx, sy)
      call direct_pair(old, pt, vt)
      call direct(old%xn, pn, un, vt(:, :, 1))
      call direct(old%yn, pn, un, vt(:, :, 2))
      call near(suite, [ut], [vt], name // ": previous moment")
      call operator%release()
      call previous%release()
   end subroutine products

   !> Equal up to round-off, relative to the largest value
   subroutine near(suite, actual, expected, what)
      type(test_suite), intent(inout) :: suite
      real(wp), intent(in) :: actual(:), expected(:)
      character(len=*), intent(in) :: what

      call suite%close_to(actual, expected, rounding*maxval(abs(expected)), what)
   end subroutine near

   !> u = kernel * p by its definition; with `total` the sum is added to that array
   subroutine direct(kernel, p, u, total)
      !> Coefficients, offsets -mx:mx, -my:my
      real(wp), intent(in) :: kernel(:, :), p(:, :)
      real(wp), intent(inout) :: u(:, :)
      real(wp), intent(inout), optional :: total(:, :)
      integer :: ix, iy, jx, jy, mx, my

      mx = size(p, 1)
      my = size(p, 2)
      u = 0.0_wp
      do iy = 1, my
         do ix = 1, mx
            do jy = 1, my
               do jx = 1, mx
                  u(ix, iy) = u(ix, iy) + kernel(ix - jx + mx + 1, iy - jy + my + 1)*p(jx, jy)
               end do
            end do
         end do
      end do
      if (present(total)) total = total + u
   end subroutine direct

   !> Tangential displacements by tangential tractions
   subroutine direct_pair(table, p, u)
      type(kernel_table), intent(in) :: table
      real(wp), intent(in) :: p(:, :, :)
      real(wp), intent(inout) :: u(:, :, :)
      real(wp) :: part(size(p, 1), size(p, 2))

      call direct(table%xx, p(:, :, 1), u(:, :, 1))
      call direct(table%xy, p(:, :, 2), part, u(:, :, 1))
      call direct(table%xy, p(:, :, 1), u(:, :, 2))
      call direct(table%yy, p(:, :, 2), part, u(:, :, 2))
   end subroutine direct_pair

   !> u becomes A p - u
   subroutine direct_difference(table, p, u)
      type(kernel_table), intent(in) :: table
      real(wp), intent(in) :: p(:, :, :)
      real(wp), intent(inout) :: u(:, :, :)
      real(wp) :: now(size(p, 1), size(p, 2), 2)

      call direct_pair(table, p, now)
      u = now - u
   end subroutine direct_difference

   !> Normal and tangential influence are symmetric and positive definite
   subroutine symmetry(suite, random)
      type(test_suite), intent(inout) :: suite
      type(random_numbers), intent(inout) :: random
      integer, parameter :: mx = 11, my = 6
      type(elastic_operator) :: operator
      real(wp), dimension(mx, my, 2) :: p, q, ap, aq
      integer :: i, j, k, trial

      call operator%prepare(elastic_model(combine([0.3_wp, 0.45_wp], [3.0_wp, 1.0_wp])), 0.3_wp, 0.2_wp, mx, my, 1)
      do trial = 1, 10
         do k = 1, 2
            do j = 1, my
               do i = 1, mx
                  p(i, j, k) = random%uniform(-1.0_wp, 1.0_wp)
                  q(i, j, k) = random%uniform(-1.0_wp, 1.0_wp)
               end do
            end do
         end do
         call operator%tangential(p, ap)
         call operator%tangential(q, aq)
         call suite%close_to(sum(q*ap), sum(p*aq), rounding*sum(abs(q))*maxval(abs(ap)), "tangential influence is symmetric")
         call suite%check(sum(p*ap) > 0.0_wp, "tangential influence is positive")
         call operator%normal(p(:, :, 1), ap(:, :, 1))
         call operator%normal(q(:, :, 1), aq(:, :, 1))
         call suite%close_to(sum(q(:, :, 1)*ap(:, :, 1)), sum(p(:, :, 1)*aq(:, :, 1)), &
            & rounding*sum(abs(q))*maxval(abs(ap(:, :, 1))), "normal influence is symmetric")
         call suite%check(sum(p(:, :, 1)*ap(:, :, 1)) > 0.0_wp, "normal influence is positive")
      end do
      call operator%release()
   end subroutine symmetry

   !> Point kernels of Boussinesq and Cerruti integrated over the element by Gauss's rule
   subroutine quadrature(suite)
      type(test_suite), intent(inout) :: suite
      ! nodes and weights of 5 points on [-1, 1]; Abramowitz & Stegun, table 25.4
      real(wp), parameter :: node(5) = [-0.906179845938663992797626878299_wp, -0.538469310105683091036314420700_wp, 0.0_wp, &
         & 0.538469310105683091036314420700_wp, 0.906179845938663992797626878299_wp]
      real(wp), parameter :: weight(5) = [0.236926885056189087514264040720_wp, 0.478628670499366468041291514836_wp, &
         & 0.568888888888888888888888888889_wp, 0.478628670499366468041291514836_wp, 0.236926885056189087514264040720_wp]
      integer, parameter :: panels = 8
      real(wp), parameter :: dx = 0.7_wp, dy = 0.4_wp, tol = 1.0e-11_wp
      type(combined_material) :: m
      type(kernel_table) :: table
      real(wp) :: x, y, r, w, s(6), f
      integer :: k, l, a, b, i, j

      m = combine([0.3_wp, 0.1_wp], [5.0_wp, 2.0_wp])
      call fill_table(table, m, dx, dy, 5, 5)
      f = 1.0_wp/(pi*m%gg)
      do l = -5, 5
         do k = -5, 5
            if (abs(k) + abs(l) < 2) cycle
            s = 0.0_wp
            do j = 1, panels
               do i = 1, panels
                  do b = 1, 5
                     do a = 1, 5
                        x = k*dx - dx*(-0.5_wp + (i - 0.5_wp + 0.5_wp*node(a))/panels)
                        y = l*dy - dy*(-0.5_wp + (j - 0.5_wp + 0.5_wp*node(b))/panels)
                        r = hypot(x, y)
                        w = f*weight(a)*weight(b)*0.25_wp*dx*dy/panels**2
                        s(1) = s(1) + w*(1.0_wp - m%nu)/r
                        s(2) = s(2) + w*((1.0_wp - m%nu)/r + m%nu*x**2/r**3)
                        s(3) = s(3) + w*((1.0_wp - m%nu)/r + m%nu*y**2/r**3)
                        s(4) = s(4) + w*m%nu*x*y/r**3
                        s(5) = s(5) - w*m%ak*x/r**2
                        s(6) = s(6) - w*m%ak*y/r**2
                     end do
                  end do
               end do
            end do
            call suite%close_to([table%nn(k, l), table%xx(k, l), table%yy(k, l), table%xy(k, l), table%xn(k, l), table%yn(k, l)], &
               & s, tol*s(1), "coefficients by quadrature")
         end do
      end do
      ! in the element itself: polar coordinates leave a regular integral
      s = 0.0_wp
      do i = 1, 20000
         x = 2.0_wp*pi*(i - 0.5_wp)/20000
         r = min(0.5_wp*dx/max(abs(cos(x)), 1.0e-30_wp), 0.5_wp*dy/max(abs(sin(x)), 1.0e-30_wp))*2.0_wp*pi/20000
         s(1:3) = s(1:3) + f*r*[1.0_wp - m%nu, 1.0_wp - m%nu + m%nu*cos(x)**2, 1.0_wp - m%nu + m%nu*sin(x)**2]
      end do
      call suite%close_to([table%nn(0, 0), table%xx(0, 0), table%yy(0, 0)], s(1:3), 1.0e-7_wp*s(1), &
         & "coefficients of the element itself")
   end subroutine quadrature

   !> Equal bodies are not coupled
   subroutine zero_kernel(suite)
      type(test_suite), intent(inout) :: suite
      type(combined_material) :: m

      m = combine([0.28_wp, 0.28_wp], [2.0_wp, 2.0_wp])
      call suite%check(.not. m%coupled(), "equal bodies are not coupled")
      call suite%close_to([m%gg, m%nu, m%ak], [2.0_wp, 0.28_wp, 0.0_wp], 1.0e-15_wp, "constants of equal bodies")
   end subroutine zero_kernel
end program test_operators
