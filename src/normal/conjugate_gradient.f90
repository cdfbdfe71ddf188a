!> NormCG: the normal contact problem by bound-constrained conjugate gradients
!>
!> Find p >= 0 with e = h - pen + A p >= 0 and p e = 0, for a prescribed approach or a prescribed force. After Polonsky and Keer
!> (1999) and Vollebregt (2014): conjugate gradients with Polak-Ribiere directions that are not restarted when the contact area
!> changes, preconditioned by the circulant inverse of A; for a prescribed force with directions of zero total force (the
!> approach is the corresponding multiplier). Within nested iteration the number of transforms does not depend on the grid.
module contact_normal_conjugate_gradient
   use contact_base_constants, only : excluded_threshold
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_compliance, only : compliance
   use contact_elastic_new_compliance, only : new_compliance
   use contact_elastic_shelf, only : operator_shelf
   use contact_grid_coarsening, only : shortest_side
   use contact_normal_coarse_problem, only : coarsen, prolong
   use contact_normal_few_elements, only : area_factor, solve_few
   use contact_normal_few_limits, only : add_limits, find_limits, limited_pressures
   use contact_normal_overlap, only : overlap_window, window_near, window_type
   use contact_normal_gradient_loops, only : choose_free, go_along, mean_gap, mean_of_free, project, &
      & residuals, turn_direction
   use contact_normal_last_answer, only : answer_type
   use contact_normal_problem, only : approach_scale, load_lowest_element, make_admissible, normal_problem, &
      & pressure_displacement
   use contact_numeric_pieces, only : add_long, fill_long, inner_long
   implicit none (type, external)
   private

   public :: approach_scale, normal_problem, normal_workspace, pressure_displacement, release_normal, solve_normal

   !> Workspace of one level of nested iteration
   type :: level_type
      type(normal_problem) :: problem
      class(compliance), allocatable :: operator
      real(wp), allocatable :: p(:, :)
      real(wp), allocatable :: u(:, :), r(:, :), z(:, :), d(:, :), q(:, :), previous(:, :)
      !> 1 for elements that have pressure or overlap, 0 for others
      real(wp), allocatable :: free(:, :)
   end type level_type

   !> Workspace of all levels, without meaning between calls; level 1 is the finest grid
   type :: normal_workspace
      type(level_type), allocatable :: level(:)
      !> The last problem and its solution: tables of creep forces repeat one normal problem
      type(answer_type), private :: last
      !> Part of a larger potential contact area: around the overlap, or around the estimated pressures of a problem in a sequence;
      !> operators of the parts in a sequence
      type(level_type) :: part
      type(operator_shelf), private :: part_operators
      !> The part in which the last problem of a sequence was solved; of size 0 if it was not
      type(window_type) :: near_window
      !> Displacements in the window of the whole problem [mm]
      real(wp), allocatable, private :: displacement(:, :)
      !> Factor of the last contact of few elements, for sequences of problems
      type(area_factor) :: factor
   end type normal_workspace

   !> Maximum number of levels
   integer, parameter :: levels = 12
   !> Smaller windows are solved without coarser levels
   integer, parameter :: smallest = 1500
   !> Tolerance of the coarse levels; an estimate better than the second value is not replaced by one from coarse grids
   real(wp), parameter :: coarse_tolerance = 5.0e-3_wp, good_estimate = 3.0e-2_wp
   !> This number of iterations without a violation below this fraction of the smallest one is regarded as stagnation; chosen
   real(wp), parameter :: is_smaller = 0.9_wp
   integer, parameter :: patience = 60
   !> The initial pressures extend to this fraction of the range of undeformed distances, and at least to the length [mm];
   !> chosen
   real(wp), parameter :: first_depth = 0.3_wp, min_range = 1.0e-10_wp
   !> Round-off of one product relative to the largest displacement, and the fraction of the tolerance that it may reach; chosen
   real(wp), parameter :: of_a_product = 1.0e-15_wp, is_small = 1.0e-3_wp
   !> Total forces with a smaller relative difference are not corrected: round-off
   real(wp), parameter :: same_force = 1.0e-14_wp

contains

   !> Solve for pressures and approach or force
   subroutine solve_normal(problem, operator, workspace, p, pen, report, log)
      !> Undeformed distance, prescribed force or approach, tolerance
      type(normal_problem), intent(in) :: problem
      !> Prepared for the window
      class(compliance), intent(inout) :: operator
      !> Coarser levels with operators and workspace, kept from call to call
      type(normal_workspace), intent(inout) :: workspace
      !> On entry an estimate (zero if there is none), on exit pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(inout) :: p(:, :)
      !> Approach [mm]: prescribed, or result
      real(wp), intent(inout) :: pen
      !> Outcome, iterations, residual; transforms are added to the present count
      type(solve_report), intent(inout) :: report
      !> Receives a line per iteration from flow-trace level 6 on; absent: no trace
      type(log_type), intent(inout), optional :: log
      type(window_type) :: window
      real(wp) :: pairs_before
      integer :: k, products_before
      logical :: traced

      if (.not. allocated(workspace%level)) allocate(workspace%level(levels))
      report%method = "NormCG"
      report%tolerance = problem%eps
      traced = .false.
      if (present(log)) traced = log%shows(6)
      if (.not. traced .and. workspace%last%is_same_question(problem, operator, p, pen)) then
         p = workspace%last%p
         pen = workspace%last%pen
         report%ended = ending%converged
         report%iterations = workspace%last%iterations
         report%residual = workspace%last%residual
         return
      end if
      call workspace%last%note_question(problem, operator, p)
      pairs_before = operator%fft_pairs()
      products_before = operator%products
      report%ended = ending%not_started
      if (problem%follows) call solve_few(problem, operator, workspace%factor, p, pen, report)
      workspace%near_window = window_type()
      if (report%ended /= ending%converged) call solve_near(problem, operator, workspace, p, pen, report, log)
      if (report%ended /= ending%converged) then
         window = overlap_window(problem, operator, pen)
         if (window%mx > 0) then
            call solve_in_window(problem, operator, workspace, window, p, pen, report, log)
         else
            call solve_level(problem, operator, workspace, 1, p, pen, problem%eps, report, log)
         end if
      end if
      call workspace%last%note_answer(problem, p, pen, report)
      report%products = report%products + operator%products - products_before
      report%fft_pairs = report%fft_pairs + operator%fft_pairs() - pairs_before
      do k = 2, size(workspace%level)
         if (.not. allocated(workspace%level(k)%operator)) cycle
         call workspace%level(k)%operator%collect_pairs(problem%mx*problem%my, report%fft_pairs)
      end do
   end subroutine solve_normal

   !> Solve in a window around the estimated pressures, and check the other elements
   subroutine solve_near(problem, operator, workspace, p, pen, report, log)
      !> One of a sequence of problems, with a prescribed approach
      type(normal_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(normal_workspace), intent(inout) :: workspace
      real(wp), contiguous, intent(inout) :: p(:, :)
      real(wp), intent(inout) :: pen
      !> Not converged if there is no such window, or if other elements overlap; p is an estimate then
      type(solve_report), intent(inout) :: report
      type(log_type), intent(inout), optional :: log
      type(window_type) :: window
      real(wp) :: worst

      window = window_near(problem, operator, p)
      if (window%mx == 0) return
      call solve_in_window(problem, operator, workspace, window, p, pen, report, log)
      if (report%ended /= ending%converged) return
      if (allocated(workspace%displacement)) then
         if (any(shape(workspace%displacement) /= shape(p))) deallocate(workspace%displacement)
      end if
      if (.not. allocated(workspace%displacement)) allocate(workspace%displacement(problem%mx, problem%my))
      call pressure_displacement(problem, operator, p, workspace%displacement)
      worst = maxval(pen - problem%h - workspace%displacement, .not. p > 0.0_wp)
      if (worst > problem%eps*approach_scale(pen, minval(problem%h), worst)) then
         report%ended = ending%not_started
      else
         workspace%near_window = window
      end if
   end subroutine solve_near

   !> Solve in a window that contains the contact
   subroutine solve_in_window(problem, operator, workspace, window, p, pen, report, log)
      !> Problem with a prescribed approach
      type(normal_problem), intent(in) :: problem
      class(compliance), intent(in) :: operator
      type(normal_workspace), intent(inout) :: workspace
      !> Part of the potential contact area
      type(window_type), intent(in) :: window
      real(wp), contiguous, intent(inout) :: p(:, :)
      real(wp), intent(inout) :: pen
      type(solve_report), intent(inout) :: report
      type(log_type), intent(inout), optional :: log
      integer :: products_before

      associate (part => workspace%part)
         call window%cut(problem, part%problem)
         if (problem%follows) call workspace%part_operators%fetch(operator%model, problem%dx, problem%dy, window%mx, window%my, &
            & part%operator)
         call new_compliance(operator%model, part%operator)
         call part%operator%prepare(operator%model, problem%dx, problem%dy, window%mx, window%my, 1, &
            & operator%y_first + window%before_y*problem%dy)
         products_before = part%operator%products
         ! derivatives of the last solution are not counted here
         part%operator%transforms = 0
         part%p = window%part_of(p)
         call solve_level(part%problem, part%operator, workspace, 1, part%p, pen, problem%eps, report, log)
         call window%put_back(part%p, p)
         report%products = report%products + part%operator%products - products_before
         call part%operator%collect_pairs(problem%mx*problem%my, report%fft_pairs)
      end associate
   end subroutine solve_in_window

   !> Solve on one level: estimate from the next coarser one if this is useful, then iterate
   recursive subroutine solve_level(problem, operator, workspace, k, p, pen, tolerance, report, log)
      type(normal_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(normal_workspace), intent(inout) :: workspace
      integer, intent(in) :: k
      real(wp), contiguous, intent(inout) :: p(:, :)
      real(wp), intent(inout) :: pen
      real(wp), intent(in) :: tolerance
      type(solve_report), intent(inout) :: report
      type(log_type), intent(inout), optional :: log
      type(solve_report) :: coarse_report
      real(wp) :: residual

      report%ended = ending%converged
      report%iterations = 0
      report%residual = 0.0_wp
      if (problem%force_prescribed .and. problem%fn <= 0.0_wp) then
         p = 0.0_wp
         pen = minval(problem%h)
         return
      end if
      if (.not. problem%force_prescribed .and. pen <= minval(problem%h)) then
         p = 0.0_wp
         return
      end if
      call fit_level(workspace%level(k), problem%mx, problem%my)
      call make_admissible(problem, p)
      if (k < size(workspace%level) .and. operator%can_coarsen() .and. problem%mx*problem%my >= smallest &
         & .and. max(problem%mx, problem%my) >= shortest_side) then
         residual = huge(residual)
         if (any(p > 0.0_wp)) then
            call pressure_displacement(problem, operator, p, workspace%level(k)%u)
            residual = estimate_quality(problem, workspace%level(k)%u, p, pen)
         end if
         if (residual > good_estimate) then
            associate (coarse => workspace%level(k + 1))
               call coarsen(problem, coarse%problem)
               call new_compliance(operator%model, coarse%operator)
               call coarse%operator%prepare(operator%model, coarse%problem%dx, coarse%problem%dy, coarse%problem%mx, &
                  & coarse%problem%my, 1, operator%y_first + 0.5_wp*(coarse%problem%dy - problem%dy))
               call fit_level(coarse, coarse%problem%mx, coarse%problem%my)
               coarse%p = 0.0_wp
               call solve_level(coarse%problem, coarse%operator, workspace, k + 1, coarse%p, pen, coarse_tolerance, &
                  & coarse_report, log)
               call prolong(coarse%p, problem, p)
               call make_admissible(problem, p)
            end associate
         end if
      end if
      if (.not. any(p > 0.0_wp)) call first_guess(problem, operator, workspace%level(k), p, pen)
      call iterate(problem, operator, workspace%level(k), p, pen, tolerance, report, log)
   end subroutine solve_level

   !> Conjugate gradients on one level
   subroutine iterate(problem, operator, level, p, pen, tolerance, report, log)
      type(normal_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(level_type), intent(inout) :: level
      real(wp), contiguous, intent(inout) :: p(:, :)
      real(wp), intent(inout) :: pen
      real(wp), intent(in) :: tolerance
      type(solve_report), intent(inout) :: report
      type(log_type), intent(inout), optional :: log
      character(len=96) :: line
      real(wp) :: rz, dq, dr, worst, scale, h_min, best
      integer :: it, n, since_best, updates
      logical :: exact_u

      n = problem%mx*problem%my
      h_min = minval(problem%h)
      call fill_long(n, 0.0_wp, level%previous)
      call fill_long(n, 0.0_wp, level%d)
      rz = 1.0_wp
      updates = 0
      best = huge(best)
      since_best = 0
      call pressure_displacement(problem, operator, p, level%u)
      report%ended = ending%iteration_limit
      do it = 1, problem%maxgs + 1
         ! for a prescribed force the approach that makes the mean residual zero
         if (problem%force_prescribed) pen = mean_gap(n, problem%h, level%u, p)
         worst = residuals(n, pen, problem%h, level%u, p, level%r)
         if (.not. worst <= huge(worst)) then
            report%ended = ending%diverged
            exit
         end if
         scale = approach_scale(pen, h_min, worst)
         report%residual = worst/scale
         if (present(log)) then
            if (log%shows(6)) then
               write(line, "(4X,I6,A,I5,A,I5,A,I8,A,ES10.2)") it - 1, ", NormCG: grid", problem%mx, " x", problem%my, ", C=", &
                  & count(p > 0.0_wp), ", residual :", report%residual
               call log%trace(6, trim(line))
            end if
         end if
         if (worst <= tolerance*scale) then
            if (updates*of_a_product*maxval(abs(level%u)) <= is_small*tolerance*scale) then
               report%ended = ending%converged
               exit
            end if
            ! displacements were updated by sums, whose round-off matters: accept convergence only after recomputing them
            call pressure_displacement(problem, operator, p, level%u)
            updates = 0
            cycle
         end if
         if (worst < is_smaller*best) then
            best = worst
            since_best = 0
         else
            since_best = since_best + 1
         end if
         if (since_best > patience) then
            report%ended = ending%stagnated
            exit
         end if
         if (it > problem%maxgs) exit
         if (problem%deadline%has_passed()) then
            report%ended = ending%out_of_time
            exit
         end if
         report%iterations = it

         call set_direction(problem, operator, level, p, it == 1, rz, dr, dq)
         if (.not. (dr > 0.0_wp .and. dq > 0.0_wp)) then
            ! the residual inside the contact area is zero, and elements that overlap cannot be added: a contact of one element
            report%ended = ending%stagnated
            exit
         end if
         call step_along(problem, operator, level, dr/dq, p, exact_u)
         updates = merge(0, updates + 1, exact_u)
      end do
   end subroutine iterate

   !> Compute the next direction d and its product q
   subroutine set_direction(problem, operator, level, p, first, rz, dr, dq)
      type(normal_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(level_type), intent(inout) :: level
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Is this the first direction?
      logical, intent(in) :: first
      !> r.z of the previous direction on entry, of this one on exit
      real(wp), intent(inout) :: rz
      !> d.r and d.A d; 0 if no direction decreases the energy
      real(wp), intent(out) :: dr, dq
      real(wp) :: beta, products(2), rz_old
      integer :: n

      dr = 0.0_wp
      dq = 0.0_wp
      rz_old = rz
      n = problem%mx*problem%my
      call choose_free(n, p, problem%h, excluded_threshold, level%free, level%r)
      call operator%normal_inverse(level%r, level%z)
      call project_direction(level%z)
      if (.not. products(1) > 0.0_wp) then
         level%z = level%r
         call project_direction(level%z)
      end if
      rz = products(1)
      if (.not. rz > 0.0_wp) return
      beta = 0.0_wp
      if (.not. first) beta = max(0.0_wp, (rz - products(2))/rz_old)
      call turn_direction(n, beta, level%z, level%r, level%d, level%previous)
      call project_direction(level%d)
      dr = products(1)
      if (.not. dr > 0.0_wp) then
         level%d = level%z
         dr = rz
      end if
      call pressure_displacement(problem, operator, level%d, level%q)
      dq = inner_long(n, level%d, level%q)

   contains

      !> Project to the free elements, and for a prescribed force to zero sum; products with this and the previous residual
      subroutine project_direction(v)
         real(wp), contiguous, intent(inout) :: v(:, :)
         real(wp) :: mean

         mean = 0.0_wp
         if (problem%force_prescribed) mean = mean_of_free(n, level%free, v)
         call project(n, level%free, mean, v, level%r, level%previous, products)
      end subroutine project_direction
   end subroutine set_direction

   !> Step along the direction; negative pressures are set to zero, and the force is preserved
   !>
   !> Displacements are recomputed if more than a few pressures are limited, otherwise updated.
   subroutine step_along(problem, operator, level, alpha, p, exact_u)
      type(normal_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(level_type), intent(inout) :: level
      !> Step length
      real(wp), intent(in) :: alpha
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(inout) :: p(:, :)
      !> Were the displacements recomputed rather than updated by those of the step?
      logical, intent(out) :: exact_u
      type(limited_pressures) :: limits
      real(wp) :: mean
      integer :: n
      logical :: is_limited

      n = problem%mx*problem%my
      limits = find_limits(problem, operator, alpha, level%d, p)
      is_limited = go_along(n, alpha, level%d, p) < 0.0_wp
      exact_u = is_limited .and. limits%n < 0
      if (is_limited) then
         if (.not. any(p > 0.0_wp)) then
            call load_lowest_element(problem, p)
            exact_u = .true.
         end if
      end if
      mean = 1.0_wp
      if (problem%force_prescribed) mean = problem%fn/(sum(p)*problem%dx*problem%dy)
      if (abs(mean - 1.0_wp) > same_force) p = p*mean
      if (exact_u) then
         call pressure_displacement(problem, operator, p, level%u)
      else
         call add_long(n, alpha, level%q, level%u)
         if (limits%n > 0) call add_limits(limits, problem, operator, level%u)
         if (abs(mean - 1.0_wp) > same_force) level%u = mean*level%u
      end if
   end subroutine step_along

   !> Quality of an estimate: violation of the contact conditions relative to the approach
   real(wp) function estimate_quality(problem, u, p, pen) result(quality)
      type(normal_problem), intent(in) :: problem
      real(wp), contiguous, intent(in) :: u(:, :), p(:, :)
      real(wp), intent(in) :: pen
      real(wp) :: approach

      approach = pen
      if (problem%force_prescribed) approach = sum(problem%h + u, p > 0.0_wp)/count(p > 0.0_wp)
      quality = max(maxval(abs(problem%h + u - approach), p > 0.0_wp), maxval(approach - problem%h - u))
      quality = quality/approach_scale(approach, minval(problem%h), quality)
   end function estimate_quality

   !> Initial pressures without an estimate
   subroutine first_guess(problem, operator, level, p, pen)
      type(normal_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(level_type), intent(inout) :: level
      real(wp), contiguous, intent(inout) :: p(:, :)
      real(wp), intent(in) :: pen
      real(wp) :: h_min, h_max

      h_min = minval(problem%h)
      if (problem%force_prescribed) then
         h_max = maxval(problem%h, problem%h < excluded_threshold)
         p = max(0.0_wp, h_min + first_depth*max(h_max - h_min, min_range) - problem%h)
         ! a level so far away that adding to it has no effect
         if (.not. any(p > 0.0_wp)) call load_lowest_element(problem, p)
         p = p*(problem%fn/(sum(p)*problem%dx*problem%dy))
         return
      end if
      p = max(0.0_wp, pen - problem%h)
      call pressure_displacement(problem, operator, p, level%u)
      p = p*(sum(p*p)/sum(p*level%u))
   end subroutine first_guess

   !> Free the plans of all levels
   subroutine release_normal(workspace)
      !> Levels whose plans are freed; may be used again
      type(normal_workspace), intent(inout) :: workspace
      integer :: k

      if (.not. allocated(workspace%level)) return
      if (allocated(workspace%part%operator)) call workspace%part%operator%release()
      call workspace%part_operators%release()
      do k = 1, size(workspace%level)
         if (allocated(workspace%level(k)%operator)) call workspace%level(k)%operator%release()
      end do
   end subroutine release_normal

   !> Allocate workspace; kept if the size is unchanged
   subroutine fit_level(level, mx, my)
      type(level_type), intent(inout) :: level
      integer, intent(in) :: mx, my

      if (allocated(level%u)) then
         if (all(shape(level%u) == [mx, my])) return
         deallocate(level%p, level%u, level%r, level%z, level%d, level%q, level%previous, level%free)
      end if
      ! memory is touched by the thread that first writes there
      allocate(level%p(mx, my), level%u(mx, my), level%r(mx, my), level%z(mx, my), level%d(mx, my), level%q(mx, my), &
         & level%previous(mx, my), level%free(mx, my))
   end subroutine fit_level
end module contact_normal_conjugate_gradient
