!> Surfaces other than plain half-spaces with piecewise constant tractions: each against its definition
program test_surfaces
   use contact_base_choices, only : kernel_model
   use contact_base_kinds, only : wp
   use contact_elastic_bilinear, only : fill_bilinear, fill_shifted_bilinear
   use contact_elastic_compliance, only : compliance
   use contact_elastic_corners, only : combine_corners, corner_functions
   use contact_elastic_halfspace, only : fill_shifted_table, fill_table, kernel_table
   use contact_elastic_material, only : combine, combined_material
   use contact_elastic_memory, only : fill_with_memory
   use contact_elastic_model, only : elastic_model, fading_memory
   use contact_elastic_new_compliance, only : new_compliance
   use contact_elastic_previous, only : previous_operator
   use contact_numeric_quadrature, only : gauss_legendre
   use contact_test_harness, only : test_suite
   implicit none (type, external)

   type(test_suite) :: suite

   call suite%start("surfaces")
   call hats(suite)
   call hats_from_far(suite)
   call memory_by_quadrature(suite)
   call memory_limits(suite)
   call memory_products(suite)
   call conformal_products(suite)
   call flat_limit(suite)
   call layer(suite)
   call suite%finish()

contains

   !> A hat is the mean of rectangles over one cell: quadrature that crowds towards the edges
   subroutine hats(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: ratio(4) = [1.0_wp, 0.2_wp, 12.0_wp, 1.0e4_wp]
      type(combined_material) :: m
      type(kernel_table) :: table, moved
      real(wp) :: dx, dy, sx, sy
      integer :: i, k, l

      m = combine([0.3_wp, 0.1_wp], [5.0_wp, 2.0_wp])
      dx = 0.3_wp
      do i = 1, size(ratio)
         dy = ratio(i)*dx
         sx = 0.37_wp*dx
         sy = -0.21_wp*dy
         call fill_bilinear(table, m, dx, dy, 30, 3)
         call fill_shifted_bilinear(moved, m, dx, dy, 30, 3, sx, sy)
         do l = -3, 3, 3
            do k = -30, 30
               if (abs(k) > 3 .and. mod(abs(k), 7) /= 0) cycle
               call suite%close_to(entry_of(table, k, l), hat(m, dx, dy, k*dx, l*dy), 2.0e-9_wp*table%nn(0, 0), "hats")
               call suite%close_to(entry_of(moved, k, l), hat(m, dx, dy, k*dx + sx, l*dy + sy), 2.0e-9_wp*table%nn(0, 0), &
                  & "hats, moved")
            end do
         end do
      end do
   end subroutine hats

   !> Coefficients at an offset
   pure function entry_of(table, k, l) result(v)
      type(kernel_table), intent(in) :: table
      integer, intent(in) :: k, l
      real(wp) :: v(6)
      v = [table%nn(k, l), table%xx(k, l), table%yy(k, l), table%xy(k, l), table%xn(k, l), table%yn(k, l)]
   end function entry_of

   !> Displacements by a hat at (x, y) by quadrature over the cell, split at the kinks of the rectangle's coefficient
   function hat(m, dx, dy, x, y) result(v)
      type(combined_material), intent(in) :: m
      real(wp), intent(in) :: dx, dy, x, y
      real(wp) :: v(6)
      real(wp) :: ax(240), wx(240), ay(240), wy(240)
      integer :: i, j, nx, ny

      call cell_rule(x, dx, ax, wx, nx)
      call cell_rule(y, dy, ay, wy, ny)
      v = 0.0_wp
      do j = 1, ny
         do i = 1, nx
            v = v + wx(i)*wy(j)*rectangle(m, dx, dy, ax(i), ay(j))
         end do
      end do
   end function hat

   !> Points over (x - h/2, x + h/2) with total weight 1; crowded towards kinks at -h/2 and h/2, and at 0
   subroutine cell_rule(x, h, at, weight, n)
      real(wp), intent(in) :: x, h
      real(wp), intent(out) :: at(:), weight(:)
      integer, intent(out) :: n
      real(wp) :: ends(5), a, b, g(60), w(60)
      integer :: i, k

      ends = [x - 0.5_wp*h, -0.5_wp*h, 0.0_wp, 0.5_wp*h, x + 0.5_wp*h]
      ends(2:4) = max(ends(1), min(ends(5), ends(2:4)))
      call gauss_legendre(g, w)
      n = 0
      at = 0.0_wp
      weight = 0.0_wp
      do k = 1, 4
         a = ends(k)
         b = ends(k + 1)
         if (b - a < 1.0e-14_wp*h) cycle
         do i = 1, size(g)
            ! crowded towards both ends, t^3 (10 - 15 t + 6 t^2)
            n = n + 1
            at(n) = a + (b - a)*g(i)**3*(10.0_wp - 15.0_wp*g(i) + 6.0_wp*g(i)**2)
            weight(n) = w(i)*30.0_wp*(g(i)*(1.0_wp - g(i)))**2*(b - a)/h
         end do
      end do
   end subroutine cell_rule

   !> Coefficients of a rectangle at any point
   pure function rectangle(m, dx, dy, x, y) result(c)
      type(combined_material), intent(in) :: m
      real(wp), intent(in) :: dx, dy, x, y
      real(wp) :: c(6), h, v

      h = 0.5_wp*dx
      v = 0.5_wp*dy
      c = combine_corners(corner_functions(x + h, y + v, .true.) - corner_functions(x - h, y + v, .true.) &
         & - corner_functions(x + h, y - v, .true.) + corner_functions(x - h, y - v, .true.), m)
   end function rectangle

   !> Far away a hat and a rectangle are the same up to the square of the relative size
   subroutine hats_from_far(suite)
      type(test_suite), intent(inout) :: suite
      type(combined_material) :: m
      type(kernel_table) :: hats, boxes
      real(wp) :: difference(2)
      integer :: i

      m = combine([0.3_wp, 0.1_wp], [5.0_wp, 2.0_wp])
      call fill_bilinear(hats, m, 0.1_wp, 0.1_wp, 2000, 2)
      call fill_table(boxes, m, 0.1_wp, 0.1_wp, 2000, 2)
      do i = 1, 2
         difference(i) = abs(hats%nn(100*i, 1)/boxes%nn(100*i, 1) - 1.0_wp)
      end do
      call suite%close_to(difference(1)/difference(2), 4.0_wp, 0.01_wp, "order with which hats become rectangles")
      call suite%check(abs(hats%nn(2000, 1)/boxes%nn(2000, 1) - 1.0_wp) < 1.0e-7_wp, "hats from far away")
   end subroutine hats_from_far

   !> Memory coefficients against the integral over the past, element by element and smooth on each half
   subroutine memory_by_quadrature(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: length(5) = [0.003_wp, 0.05_wp, 0.4_wp, 3.0_wp, 200.0_wp]
      real(wp), parameter :: side(2) = [0.25_wp, 1000.0_wp]
      integer, parameter :: place(2, 13) = reshape([-9, 0, -2, 0, -1, 0, 0, 0, 1, 0, -1, 1, 4, -1, 2, 2, -4, 3, 8, -3, &
         & 27, 0, 59, 4, -60, -2], [2, 13])
      type(kernel_table) :: table, elastic
      type(fading_memory) :: memory
      type(elastic_model) :: model
      real(wp) :: past(6), dx
      integer :: i, j, k

      dx = 0.16_wp
      do j = 1, 2
         do i = 1, size(length)
            call model%set_viscoelastic([0.4_wp, 0.2_wp], [1143.0_wp, 3000.0_wp], [1.5_wp, 0.0_wp], [length(i), 0.0_wp], 1)
            memory = model%memory
            call fill_with_memory(table, model%material, memory, .true., dx, side(j), 60, 4)
            call fill_table(elastic, model%material, dx, side(j), 60, 4)
            do k = 1, size(place, 2)
               past = memory_of(memory%late(1), length(i), dx, side(j), place(1, k)*dx, place(2, k)*side(j))
               if (place(2, k) == 0) past([4, 6]) = 0.0_wp
               call suite%close_to(entry_of(table, place(1, k), place(2, k)), entry_of(elastic, place(1, k), place(2, k)) + past, &
                  & 1.0e-10_wp*table%nn(0, 0), "memory by quadrature")
            end do
         end do
      end do
   end subroutine memory_by_quadrature

   !> int_0^inf exp(-s) C(x + v s, y) ds with very many points
   function memory_of(late, length, dx, dy, x, y) result(m)
      type(combined_material), intent(in) :: late
      real(wp), intent(in) :: length, dx, dy, x, y
      real(wp) :: m(6), a, b, h, g(24), w(24), t, at
      integer :: i

      call gauss_legendre(g, w)
      m = 0.0_wp
      a = x
      do while (a < x + 45.0_wp*length)
         ! pieces that end at the edges of the element, grow with the distance to it and with the time
         h = min(2.0_wp*length, 0.25_wp*dx + 0.2_wp*abs(a))
         b = a + h
         if (a < -0.5_wp*dx - 1.0e-12_wp .and. b > -0.5_wp*dx) b = -0.5_wp*dx
         if (a < 0.5_wp*dx - 1.0e-12_wp .and. b > 0.5_wp*dx) b = 0.5_wp*dx
         do i = 1, size(g)
            t = g(i)**3*(10.0_wp - 15.0_wp*g(i) + 6.0_wp*g(i)**2)
            at = a + (b - a)*t
            m = m + w(i)*30.0_wp*(g(i)*(1.0_wp - g(i)))**2*(b - a)/length*exp((x - at)/length)*rectangle(late, dx, dy, at, y)
         end do
         a = b
      end do
   end function memory_of

   !> Fast relaxation: the late compliance; slow relaxation: the instantaneous one
   subroutine memory_limits(suite)
      type(test_suite), intent(inout) :: suite
      type(elastic_model) :: fast, slow, soft, hard
      type(kernel_table) :: a, b
      integer :: k, l

      call hard%set_viscoelastic([0.4_wp, 0.1_wp], [1143.0_wp, 2000.0_wp], [0.0_wp, 0.0_wp], [1.0_wp, 1.0_wp], 1)
      call soft%set_viscoelastic([0.4_wp, 0.1_wp], [1143.0_wp, 2000.0_wp], [1.0_wp, 2.0_wp], [0.0_wp, 0.0_wp], 1)
      call fast%set_viscoelastic([0.4_wp, 0.1_wp], [1143.0_wp, 2000.0_wp], [1.0_wp, 2.0_wp], [1.0e-12_wp, 2.0e-12_wp], 1)
      call slow%set_viscoelastic([0.4_wp, 0.1_wp], [1143.0_wp, 2000.0_wp], [1.0_wp, 2.0_wp], [1.0e12_wp, 1.0e12_wp], 1)
      call suite%check(.not. allocated(soft%memory) .and. .not. allocated(hard%memory), "bodies without memory")
      call suite%check(fast%coupled() .and. slow%coupled(), "memory of dissimilar bodies couples")
      call fill_with_memory(a, fast%material, fast%memory, .true., 0.16_wp, 0.2_wp, 12, 5)
      call fill_table(b, soft%material, 0.16_wp, 0.2_wp, 12, 5)
      do l = -5, 5
         do k = -12, 12
            call suite%close_to(entry_of(a, k, l), entry_of(b, k, l), 1.0e-9_wp*b%nn(0, 0), "fast relaxation")
         end do
      end do
      call fill_with_memory(a, slow%material, slow%memory, .true., 0.16_wp, 0.2_wp, 12, 5)
      call fill_table(b, hard%material, 0.16_wp, 0.2_wp, 12, 5)
      do l = -5, 5
         do k = -12, 12
            call suite%close_to(entry_of(a, k, l), entry_of(b, k, l), 1.0e-9_wp*b%nn(0, 0), "slow relaxation")
         end do
      end do
      call fast%set_viscoelastic([0.4_wp, 0.4_wp], [1.0_wp, 1.0_wp], [1.0_wp, 1.0_wp], [1.0_wp, 1.0_wp], 1)
      call suite%check(.not. fast%coupled(), "memory of similar bodies does not couple")
   end subroutine memory_limits

   !> Products with a memory against direct sums
   subroutine memory_products(suite)
      type(test_suite), intent(inout) :: suite
      type(elastic_model) :: model
      type(kernel_table) :: table
      class(compliance), allocatable :: operator
      integer, parameter :: shapes(2, 4) = reshape([1, 1, 7, 1, 1, 5, 9, 6], [2, 4])
      integer :: k

      call model%set_viscoelastic([0.4_wp, 0.1_wp], [1143.0_wp, 2000.0_wp], [1.0_wp, 2.0_wp], [0.3_wp, 0.8_wp], 1)
      do k = 1, size(shapes, 2)
         call fill_with_memory(table, model%material, model%memory, .true., 0.16_wp, 0.2_wp, 12, 12)
         call new_compliance(model, operator)
         call operator%prepare(model, 0.16_wp, 0.2_wp, shapes(1, k), shapes(2, k), 1)
         call compare(suite, operator, table, spread(0.0_wp, 1, shapes(2, k)), 4, "products with memory")
         call operator%release()
      end do
   end subroutine memory_products

   !> All variants of the conformal correction against matrices rotated one by one
   subroutine conformal_products(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: mx = 6, my = 9
      real(wp), parameter :: dx = 0.3_wp, dy = 0.2_wp, first = -0.7_wp
      type(elastic_model) :: model
      type(kernel_table) :: table
      class(compliance), allocatable :: operator
      real(wp) :: alpha(my)
      integer :: variant, method, material, i, direction
      character(len=40) :: name

      do material = 1, 2
         model%material = combine([0.3_wp, merge(0.3_wp, 0.1_wp, material == 1)], [5.0_wp, merge(5.0_wp, 2.0_wp, material == 1)])
         model%kernel = kernel_model%conformal
         call fill_table(table, model%material, dx, dy, 12, 12)
         if (.not. allocated(table%xn)) then
            allocate(table%xn, table%yn, mold=table%nn)
            table%xn = 0.0_wp
            table%yn = 0.0_wp
         end if
         if (.not. allocated(model%inclination)) allocate(model%inclination)
         model%inclination%s = [-0.6_wp, -0.1_wp, 0.4_wp, 1.0_wp]
         model%inclination%alpha = [-0.9_wp, -0.1_wp, 0.05_wp, 0.8_wp]
         do method = 0, 1
            do variant = 1, 4
               model%inclination%variant = variant
               model%inclination%uniform = method == 0
               alpha = model%inclination%angle([(first + (i - 1)*dy, i = 1, my)])
               do direction = -1, 1, 2
                  write(name, "(a, i0, a, i0)") "conformal, variant ", variant, ", method ", method
                  call new_compliance(model, operator)
                  call operator%prepare(model, dx, dy, mx, my, direction, first)
                  call suite%check(operator%has_table() .eqv. (method == 0 .and. variant == 4), name // ": one table for all")
                  call compare(suite, operator, table, alpha, variant, trim(name), direction)
                  call operator%release()
               end do
            end do
         end do
      end do
   end subroutine conformal_products

   !> Products of an operator against sums over rotated matrices of a table
   subroutine compare(suite, operator, table, alpha, variant, name, direction)
      type(test_suite), intent(inout) :: suite
      class(compliance), intent(inout) :: operator
      !> Of flat bodies
      type(kernel_table), intent(in) :: table
      !> Inclination of every row
      real(wp), intent(in) :: alpha(:)
      integer, intent(in) :: variant
      character(len=*), intent(in) :: name
      integer, intent(in), optional :: direction
      real(wp), dimension(operator%mx, operator%my, 3) :: p, now, before
      real(wp) :: ut(operator%mx, operator%my, 2), un(operator%mx, operator%my), tolerance
      integer :: ix, iy, ahead

      ahead = 1
      if (present(direction)) ahead = direction
      do iy = 1, operator%my
         do ix = 1, operator%mx
            p(ix, iy, :) = [sin(1.7_wp*ix + iy), cos(ix - 2.3_wp*iy), 1.0_wp + sin(0.9_wp*ix*iy)]
         end do
      end do
      tolerance = 1.0e-12_wp*table%nn(0, 0)*operator%mx*operator%my
      now = sums(table, p, [1, 2], alpha, variant, 0)
      before = sums(table, p, [1, 2], alpha, variant, ahead)
      call operator%tangential(p(:, :, 1:2), ut)
      call suite%close_to(reshape(ut, [size(ut)]), reshape(now(:, :, 1:2), [size(ut)]), tolerance, name // ": tangential")
      call operator%steady(p(:, :, 1:2), ut)
      call suite%close_to(reshape(ut, [size(ut)]), reshape(now(:, :, 1:2) - before(:, :, 1:2), [size(ut)]), tolerance, &
         & name // ": steady")
      call operator%normal_by_tangential(p(:, :, 1:2), un)
      call suite%close_to(reshape(un, [size(un)]), reshape(now(:, :, 3), [size(un)]), tolerance, name // ": normal by tangential")
      now = sums(table, p, [3], alpha, variant, 0)
      before = sums(table, p, [3], alpha, variant, ahead)
      call operator%normal(p(:, :, 3), un)
      call suite%close_to(reshape(un, [size(un)]), reshape(now(:, :, 3), [size(un)]), tolerance, name // ": normal")
      call operator%tangential_by_normal(p(:, :, 3), ut)
      call suite%close_to(reshape(ut, [size(ut)]), reshape(now(:, :, 1:2), [size(ut)]), tolerance, name // ": by normal")
      call operator%steady_by_normal(p(:, :, 3), ut)
      call suite%close_to(reshape(ut, [size(ut)]), reshape(now(:, :, 1:2) - before(:, :, 1:2), [size(ut)]), tolerance, &
         & name // ": steady by normal")
   end subroutine compare

   !> Displacements in all directions by tractions in some
   function sums(table, p, parts, alpha, variant, ahead) result(u)
      type(kernel_table), intent(in) :: table
      real(wp), intent(in) :: p(:, :, :), alpha(:)
      !> Directions of the tractions that count; offset of the receiving elements
      integer, intent(in) :: parts(:), variant, ahead
      real(wp) :: u(size(p, 1), size(p, 2), 3)
      real(wp) :: b(3, 3)
      integer :: ix, iy, jx, jy

      u = 0.0_wp
      do iy = 1, size(p, 2)
         do ix = 1, size(p, 1)
            do jy = 1, size(p, 2)
               do jx = 1, size(p, 1)
                  b = corrected(matrix(table, ix - jx + ahead, iy - jy), alpha(jy) - alpha(iy), variant)
                  u(ix, iy, :) = u(ix, iy, :) + matmul(b(:, parts), p(jx, jy, parts))
               end do
            end do
         end do
      end do
   end function sums

   !> Matrix of flat bodies at an offset, directions x, s, n
   pure function matrix(table, k, l) result(a)
      type(kernel_table), intent(in) :: table
      integer, intent(in) :: k, l
      real(wp) :: a(3, 3)

      a(1, :) = [table%xx(k, l), table%xy(k, l), table%xn(k, l)]
      a(2, :) = [table%xy(k, l), table%yy(k, l), table%yn(k, l)]
      a(3, :) = [-table%xn(k, l), -table%yn(k, l), table%nn(k, l)]
   end function matrix

   pure function corrected(a, alpha, variant) result(b)
      real(wp), intent(in) :: a(3, 3), alpha
      integer, intent(in) :: variant
      real(wp) :: b(3, 3)

      select case (variant)
      case (1)
         b = matmul(a, rotation(alpha))
      case (2)
         b = matmul(a, rotation(alpha))
         b(1, 3) = a(1, 3)
      case (3)
         b = matmul(rotation(alpha), a)
      case default
         b = matmul(rotation(0.5_wp*alpha), matmul(a, rotation(0.5_wp*alpha)))
      end select
   end function corrected

   pure function rotation(angle) result(r)
      real(wp), intent(in) :: angle
      real(wp) :: r(3, 3)

      r(1, :) = [1.0_wp, 0.0_wp, 0.0_wp]
      r(2, :) = [0.0_wp, cos(angle), -sin(angle)]
      r(3, :) = [0.0_wp, sin(angle), cos(angle)]
   end function rotation

   !> Constant inclination is not a curvature: the same as flat bodies
   subroutine flat_limit(suite)
      type(test_suite), intent(inout) :: suite
      type(elastic_model) :: flat, even
      class(compliance), allocatable :: a, b
      real(wp) :: p(5, 4, 2), u(5, 4, 2), v(5, 4, 2)
      integer :: variant, method

      flat%material = combine([0.3_wp, 0.1_wp], [5.0_wp, 2.0_wp])
      call new_compliance(flat, a)
      call a%prepare(flat, 0.3_wp, 0.2_wp, 5, 4, 1)
      call random_number(p)
      call a%steady(p, u)
      do variant = 1, 4
         do method = 0, 1
            even = flat
            even%kernel = kernel_model%conformal
            allocate(even%inclination)
            even%inclination%variant = variant
            even%inclination%uniform = method == 0
            even%inclination%s = [0.0_wp, 1.0_wp]
            even%inclination%alpha = [0.4_wp, 0.4_wp]
            call new_compliance(even, b)
            call b%prepare(even, 0.3_wp, 0.2_wp, 5, 4, 1)
            call b%steady(p, v)
            call suite%close_to(reshape(v, [size(v)]), reshape(u, [size(u)]), 1.0e-14_wp, "no curvature")
            call b%release()
         end do
      end do
      call a%release()
   end subroutine flat_limit

   !> A layer adds the local traction now, and the one of the same particle before
   subroutine layer(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: mx = 7, my = 4
      real(wp), parameter :: flexibility = 0.6_wp
      type(elastic_model) :: plain, layered
      class(compliance), allocatable :: a, b
      type(previous_operator) :: old, old_layered
      real(wp) :: p(mx, my, 2), u(mx, my, 2), v(mx, my, 2), w(mx, my, 2), ahead(mx, my, 2), none(mx, my), share
      integer :: direction, i

      call random_number(p)
      none = 0.0_wp
      plain%material = combine([0.3_wp, 0.3_wp], [5.0_wp, 5.0_wp])
      layered = plain
      layered%layer = flexibility
      do direction = -1, 1, 2
         ahead = 0.0_wp
         if (direction == 1) ahead(:mx - 1, :, :) = p(2:, :, :)
         if (direction == -1) ahead(2:, :, :) = p(:mx - 1, :, :)
         call new_compliance(plain, a)
         call new_compliance(layered, b)
         call a%prepare(plain, 0.3_wp, 0.2_wp, mx, my, direction)
         call b%prepare(layered, 0.3_wp, 0.2_wp, mx, my, direction)
         call a%tangential(p, u)
         call b%tangential(p, v)
         call suite%close_to(reshape(v - u, [size(u)]), reshape(flexibility*p, [size(u)]), 1.0e-13_wp, "layer")
         call a%steady(p, u)
         call b%steady(p, v)
         call suite%close_to(reshape(v - u, [size(u)]), reshape(flexibility*(p - ahead), [size(u)]), 1.0e-13_wp, "layer, steady")
         do i = 0, 2
            share = 0.35_wp*i
            call old%prepare(plain, 0.3_wp, 0.2_wp, mx, my, direction*share*0.3_wp, 0.0_wp)
            call old_layered%prepare(layered, 0.3_wp, 0.2_wp, mx, my, direction*share*0.3_wp, 0.0_wp)
            call old%tangential(p(:, :, 1), p(:, :, 2), none, u(:, :, 1), u(:, :, 2))
            call old_layered%tangential(p(:, :, 1), p(:, :, 2), none, v(:, :, 1), v(:, :, 2))
            w = flexibility*((1.0_wp - share)*p + share*ahead)
            call suite%close_to(reshape(v - u, [size(u)]), reshape(w, [size(u)]), 1.0e-13_wp, "layer, previous time step")
         end do
      end do
      call a%release()
      call b%release()
      call old%release()
      call old_layered%release()
   end subroutine layer
end program test_surfaces
