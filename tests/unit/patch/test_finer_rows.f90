!> Errors of forces by few rows, from a solution with narrower rows: against solutions with rows of a ninth, and what they cost
program test_finer_rows
   use contact_base_choices, only : estimate_choice, motion, pressure_model, solver_choice, time_link
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solver_settings, only : solver_settings
   use contact_elastic_material, only : combine
   use contact_grid_element_division, only : bounding_box, contact_box
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_error_estimate, only : coarse_level, release_coarse_level, solve_coarse_level
   use contact_patch_error_scales, only : rows_error
   use contact_patch_finer_rows, only : find_errors_of_rows
   use contact_patch_problem, only : patch_problem, patch_state
   use contact_patch_result, only : patch_result
   use contact_patch_solve, only : solve_patch
   use contact_patch_workspace, only : patch_workspace, release_workspace
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> Width of the rows for which errors are true, over that of the original ones
   integer, parameter :: ninth = 9
   !> Width of the window across [mm], and numbers of its rows that put 1 to 5 rows in contact
   real(wp), parameter :: width = 9.0_wp
   integer, parameter :: rows(6) = [3, 5, 6, 9, 12, 15], expected(6) = [1, 1, 2, 3, 4, 5]
   type(test_suite) :: suite
   integer :: k

   call suite%start("finer_rows")
   do k = 1, size(rows)
      call slender_contact(rows(k), expected(k))
   end do
   call suite%finish()

contains

   !> A slender contact rolling with creepages and spin: original rows, or rows of a fraction of their width
   subroutine new_problem(n, fraction, problem)
      !> Number of original rows of the window
      integer, intent(in) :: n
      !> Rows for each of them
      integer, intent(in) :: fraction
      type(patch_problem), intent(out) :: problem
      integer :: ix, iy

      problem%grid = potential_contact(mx=24, my=n*fraction, dx=0.8_wp, dy=width/(n*fraction), xl=-9.6_wp, yl=-0.5_wp*width)
      problem%model%material = combine([0.28_wp, 0.28_wp], [82000.0_wp, 82000.0_wp])
      allocate(problem%h(problem%grid%mx, problem%grid%my))
      do iy = 1, problem%grid%my
         do ix = 1, problem%grid%mx
            problem%h(ix, iy) = problem%grid%x(ix)**2/1000.0_wp + problem%grid%y(iy)**2/100.0_wp
         end do
      end do
      problem%pressure = pressure_model%full
      problem%motion = motion%steady_rolling
      problem%solver = solver_choice%default
      problem%estimate = estimate_choice%fresh
      problem%fn = 2.0e4_wp
      problem%creep = [4.0e-4_wp, -2.0e-4_wp]
      problem%spin = 3.0e-4_wp
      problem%dq = problem%grid%dx
      problem%settings = solver_settings(order=2, eps=1.0e-6_wp)
   end subroutine new_problem

   !> Solve from nothing
   subroutine solve(problem, state, result)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(out) :: state
      type(patch_result), intent(inout) :: result
      type(patch_workspace) :: workspace
      type(log_type) :: log
      type(error_type), allocatable :: error

      associate (grid => problem%grid)
         state%now%grid = grid
         allocate(state%now%pn(grid%mx, grid%my), state%now%px(grid%mx, grid%my), state%now%py(grid%mx, grid%my), source=0.0_wp)
         allocate(state%now%division(grid%mx, grid%my), source=0)
      end associate
      state%before = state%now
      call solve_patch(problem, state, workspace, log, result, error)
      call suite%check(.not. allocated(error) .and. result%status%is_solved(), "a slender contact is solved")
      call release_workspace(workspace)
   end subroutine solve

   !> Errors of a contact of some rows
   subroutine slender_contact(n, expected)
      !> Number of rows of the window, and of those in contact
      integer, intent(in) :: n, expected
      type(patch_problem) :: problem, exact
      type(patch_state) :: state, exact_state
      type(patch_result) :: result, exact_result
      type(coarse_level) :: level, finer
      type(rows_error) :: errors
      type(bounding_box) :: box
      type(error_type), allocatable :: error
      real(wp) :: truth(2), ratio, none(0)
      character(len=16) :: label

      write(label, "(I0,A)") expected, " rows: "
      call new_problem(n, 1, problem)
      call solve(problem, state, result)
      call new_problem(n, ninth, exact)
      call solve(exact, exact_state, exact_result)
      box = contact_box(result%division)
      call suite%equal(box%iy1 - box%iy0 + 1, expected, trim(label) // " in contact")
      call solve_coarse_level(problem, state, time_link%initiate, level, result, error)
      call find_errors_of_rows(problem, state, level, result, 1, none, finer, errors, error)
      if (n < 4) then
         call suite%check(.not. errors%known, trim(label) // " too few for cubics")
         return
      end if
      call suite%check(errors%known .and. .not. errors%scatters, trim(label) // " errors are known")
      truth = [result%fx - exact_result%fx, result%fy - exact_result%fy]
      associate (found => errors%value(1:2), finer_grid => finer%result%grid)
         ratio = norm2(found)/norm2(truth)
         call suite%check(ratio > 0.7_wp .and. ratio < 2.0_wp, trim(label) // " size of the error")
         call suite%check(dot_product(found, truth) > 0.8_wp*norm2(found)*norm2(truth), trim(label) // " its direction")
         ! narrower rows up to the centres of the next original ones
         call suite%equal(finer_grid%my, merge(3, 2, expected < 3)*(expected + 2) - 2, trim(label) // " narrower rows")
         call suite%equal(finer_grid%mx, box%ix1 - box%ix0 + 3, trim(label) // " columns")
      end associate
      ! from interpolated tractions there were five and more
      call suite%check(finer%result%normal%iterations <= 3, trim(label) // " few iterations for pressures")
      call suite%check(finer%result%tangential%products < 0.85_wp*result%tangential%products, &
         & trim(label) // " fewer products than the original solution")
      call release_coarse_level(level)
      call release_coarse_level(finer)
   end subroutine slender_contact
end program test_finer_rows
