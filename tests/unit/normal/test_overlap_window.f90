!> The normal problem in a window around the overlap or around estimated pressures, and displacements after a few limited pressures
program test_overlap_window
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : solve_report
   use contact_elastic_material, only : combine
   use contact_elastic_model, only : elastic_model
   use contact_elastic_operator, only : elastic_operator
   use contact_normal_conjugate_gradient, only : normal_problem, normal_workspace, release_normal, solve_normal
   use contact_normal_few_limits, only : add_limits, find_limits, limited_pressures
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   integer, parameter :: mx = 90, my = 70
   real(wp), parameter :: side = 0.1_wp, eps = 1.0e-10_wp
   type(test_suite) :: suite
   type(normal_problem) :: problem
   type(elastic_operator) :: operator
   type(elastic_model) :: model
   real(wp) :: p(mx, my), q(mx, my), u(mx, my), pen, found
   integer :: ix, iy

   call suite%start("overlap window")
   model%material = combine([0.28_wp, 0.28_wp], [82000.0_wp, 82000.0_wp])
   call operator%prepare(model, side, side, mx, my, 1)
   problem%mx = mx
   problem%my = my
   problem%dx = side
   problem%dy = side
   problem%eps = eps
   allocate(problem%h(mx, my))
   ! far from the centre of the potential contact area, and rough
   do iy = 1, my
      do ix = 1, mx
         problem%h(ix, iy) = 2.0e-4_wp*((ix - 70)**2 + 2*(iy - 15)**2) + 5.0e-4_wp*(sin(2.1_wp*ix) + cos(1.7_wp*iy))
      end do
   end do

   problem%force_prescribed = .false.
   pen = minval(problem%h) + 0.012_wp
   p = 0.0_wp
   call suite%equal(solve(p, pen), 0, "no product of the whole window with a prescribed approach")
   call operator%normal(p, u)
   call suite%check(count(p > 0.0_wp) > 50, "elements in contact")
   call suite%check(maxval(abs(problem%h + u - pen), p > 0.0_wp) <= 2.0_wp*eps*0.012_wp, "no distance in contact")
   call suite%check(minval(problem%h + u - pen) >= -2.0_wp*eps*0.012_wp, "no overlap anywhere")

   ! the same contact by its force, which is solved on the whole window
   problem%force_prescribed = .true.
   problem%fn = sum(p)*side**2
   q = 0.0_wp
   found = 0.0_wp
   call suite%check(solve(q, found) > 0, "products of the whole window with a prescribed force")
   call suite%close_to(found, pen, 1.0e-9_wp*pen, "the same approach")
   call suite%close_to(reshape(q, [mx*my]), reshape(p, [mx*my]), 1.0e-6_wp*maxval(p), "the same pressures")

   problem%force_prescribed = .false.
   pen = minval(problem%h) + 0.5_wp
   p = 0.0_wp
   call suite%check(solve(p, pen) > 0, "a large overlap fills the whole window")
   pen = minval(problem%h) - 1.0e-3_wp
   call suite%equal(solve(p, pen), 0, "no overlap")
   call suite%check(.not. any(p > 0.0_wp), "and no pressures")
   call check_limits(5)
   call check_limits(1000)
   call check_sequence()
   call operator%release()
   call suite%finish()

contains

   !> Products of the whole window for one solution, with a new workspace
   integer function solve(p, pen) result(products)
      real(wp), contiguous, intent(inout) :: p(:, :)
      real(wp), intent(inout) :: pen
      type(normal_workspace) :: workspace
      type(solve_report) :: report

      products = operator%products
      call solve_normal(problem, operator, workspace, p, pen, report)
      products = operator%products - products
      call release_normal(workspace)
   end function solve

   !> A problem that follows a similar one is solved around its pressures, with one product of the whole window to check the others
   subroutine check_sequence()
      real(wp) :: other(mx, my)

      ! more elements in contact than are solved by a factor
      problem%follows = .false.
      pen = minval(problem%h) + 0.1_wp
      p = 0.0_wp
      if (solve(p, pen) < 0) return
      call suite%check(count(p > 0.0_wp) > 250, "many elements in contact")
      pen = minval(problem%h) + 0.101_wp
      problem%follows = .true.
      call suite%equal(solve(p, pen), 1, "one product of the whole window in a sequence")
      problem%follows = .false.
      q = 0.0_wp
      call suite%check(solve(q, pen) /= 1, "another window without a sequence")
      call suite%close_to(reshape(p, [mx*my]), reshape(q, [mx*my]), 1.0e-6_wp*maxval(p), "the same pressures around the last ones")
      ! a second contact, of which the estimate has no pressures
      other = problem%h
      do iy = 1, my
         do ix = 1, mx
            problem%h(ix, iy) = min(problem%h(ix, iy), 2.0e-4_wp*(2*(ix - 22)**2 + (iy - 50)**2))
         end do
      end do
      problem%follows = .true.
      call suite%check(solve(p, pen) > 1, "an overlap elsewhere takes the whole window")
      call operator%normal(p, u)
      call suite%check(any(p(:40, :) > 0.0_wp), "the second contact")
      call suite%check(maxval(abs(problem%h + u - pen), p > 0.0_wp) <= 2.0_wp*eps*0.2_wp, "no distance in both contacts")
      call suite%check(minval(problem%h + u - pen) >= -2.0_wp*eps*0.2_wp, "no overlap with both contacts")
      problem%h = other
      problem%follows = .false.
   end subroutine check_sequence

   !> Update displacements after a step that makes some pressures negative, and compare with a product
   subroutine check_limits(several)
      integer, intent(in) :: several
      real(wp), parameter :: alpha = 0.7_wp
      real(wp) :: p(mx, my), d(mx, my), u(mx, my), q(mx, my), expected(mx, my)
      type(limited_pressures) :: limits
      integer :: k

      call random_number(p)
      call random_number(d)
      p = p + 1.0_wp
      do k = 1, several
         d(1 + mod(37*k, mx), 1 + mod(11*k, my)) = -5.0_wp
      end do
      limits = find_limits(problem, operator, alpha, d, p)
      if (several > 100) then
         call suite%equal(limits%n, -1, "too many limits")
         return
      end if
      call suite%equal(limits%n, several, "number of limits")
      call operator%normal(p, u)
      call operator%normal(d, q)
      u = u + alpha*q
      call add_limits(limits, problem, operator, u)
      p = max(0.0_wp, p + alpha*d)
      call operator%normal(p, expected)
      call suite%close_to(reshape(u, [mx*my]), reshape(expected, [mx*my]), 1.0e-13_wp*maxval(expected), "displacements")
   end subroutine check_limits
end program test_overlap_window
