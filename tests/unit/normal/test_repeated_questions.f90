!> NormCG answers a repeated question from memory, and notices every difference
program test_repeated_questions
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : solve_report
   use contact_elastic_material, only : combine
   use contact_elastic_model, only : elastic_model
   use contact_elastic_operator, only : elastic_operator
   use contact_normal_conjugate_gradient, only : normal_problem, normal_workspace, release_normal, solve_normal
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   integer, parameter :: n = 15
   type(test_suite) :: suite
   type(normal_problem) :: problem
   type(normal_workspace) :: workspace
   type(elastic_operator) :: operator
   type(elastic_model) :: model
   real(wp) :: start(n, n), p(n, n), first(n, n), pen, first_pen
   integer :: ix, iy

   call suite%start("repeated questions")
   model%material = combine([0.28_wp, 0.28_wp], [82000.0_wp, 82000.0_wp])
   call operator%prepare(model, 0.1_wp, 0.1_wp, n, n, 1)
   problem%mx = n
   problem%my = n
   problem%dx = 0.1_wp
   problem%dy = 0.1_wp
   problem%fn = 200.0_wp
   allocate(problem%h(n, n))
   do iy = 1, n
      do ix = 1, n
         problem%h(ix, iy) = 1.0e-3_wp*((ix - 8)**2 + 2*(iy - 8)**2)
      end do
   end do
   start = 0.0_wp

   call suite%check(products(first, first_pen) > 0, "a new question is computed")
   call suite%equal(products(p, pen), 0, "the same question again is not")
   call suite%close_to(reshape(p, [n*n]), reshape(first, [n*n]), 0.0_wp, "the same pressures")
   call suite%close_to(pen, first_pen, 0.0_wp, "the same approach")

   problem%h(8, 8) = nearest(problem%h(8, 8), 1.0_wp)
   call expect_new("another distance in the last bit")
   start(3, 3) = 1.0e-9_wp
   call expect_new("another estimate")
   problem%fn = 201.0_wp
   call expect_new("another force")
   problem%eps = 1.0e-7_wp
   call expect_new("another tolerance")
   model%material = combine([0.28_wp, 0.28_wp], [81000.0_wp, 82000.0_wp])
   call operator%prepare(model, 0.1_wp, 0.1_wp, n, n, 1)
   call expect_new("another material")
   problem%dx = 0.11_wp
   call operator%prepare(model, 0.11_wp, 0.1_wp, n, n, 1)
   call expect_new("other elements")
   problem%force_prescribed = .false.
   first_pen = 2.0e-3_wp
   call expect_new("approach instead of force", first_pen)
   call expect_new("another approach", 2.1e-3_wp)
   call release_normal(workspace)
   call operator%release()
   call suite%finish()

contains

   !> Number of products of a solution
   integer function products(p, pen, given)
      real(wp), intent(out) :: p(n, n), pen
      real(wp), intent(in), optional :: given
      type(solve_report) :: report

      p = start
      pen = 0.0_wp
      if (present(given)) pen = given
      call solve_normal(problem, operator, workspace, p, pen, report)
      call suite%check(report%succeeded(), "the normal problem converges")
      products = report%products
   end function products

   !> A question that differs is computed, once, and its answer holds
   subroutine expect_new(what, given)
      character(len=*), intent(in) :: what
      real(wp), intent(in), optional :: given
      real(wp) :: again(n, n)

      call suite%check(products(p, pen, given) > 0, what // ": computed")
      call suite%equal(products(again, pen, given), 0, what // ": remembered")
      call suite%close_to(reshape(again, [n*n]), reshape(p, [n*n]), 0.0_wp, what // ": the same pressures")
   end subroutine expect_new
end program test_repeated_questions
