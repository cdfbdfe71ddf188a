!> The tangential problem of a patch: tangential tractions and slip on a given contact area
module contact_patch_tangential_step
   use contact_base_choices, only : is_classical, motion, solver_choice
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_coefficients, only : fill_shifted_coefficients
   use contact_friction_law, only : friction_driver
   use contact_grid_element_division, only : bounding_box, contact_box, element
   use contact_grid_picture, only : trace_picture
   use contact_numeric_pieces, only : pieces_of
   use contact_patch_kinematics, only : rigid_slip
   use contact_patch_leading_edge, only : correct_leading_edge
   use contact_patch_order, only : lower_order, set_second_order
   use contact_patch_problem, only : patch_problem, patch_state, rolling_direction
   use contact_patch_result, only : patch_result
   use contact_patch_workspace, only : patch_workspace, prepare_box, prepare_window
   use contact_patch_yield, only : carry_yield, set_yield
   use contact_tangential_classical, only : classical_method, method_name, solve_classical
   use contact_tangential_full_sliding, only : is_beyond_friction, slide_fully
   use contact_tangential_nested, only : solve_newton_krylov
   use contact_tangential_problem, only : prepare_solution, tangential_problem, tangential_solution
   implicit none (type, external)
   private

   public :: tangential_step

   !> Relaxation factors of the Gauss-Seidel methods if the input gives none, all values chosen. Contact areas of few elements are
   !> not relaxed; time steps and ConvexGS have one factor for adhesion and slip; steady rolling has two, which depend on the ratio
   !> DX/DY of the elements
   integer, parameter :: few_elements = 25
   real(wp), parameter :: long_element = 5.0_wp, longer_element = 15.0_wp
   real(wp), parameter :: relaxed_step = 0.5_wp, relaxed_square(2) = [0.9_wp, 1.0_wp], relaxed_long(2) = [0.8_wp, 0.8_wp], &
      & relaxed_longer(2) = [0.8_wp, 0.6_wp]

contains

   !> Solve for tangential tractions and slip on a given contact area
   subroutine tangential_step(problem, state, workspace, log, result)
      !> Motion, friction, creepages or forces, method
      type(patch_problem), intent(in) :: problem
      !> On entry pressures, element states and estimate of the tractions; on exit the solution
      type(patch_state), intent(inout) :: state
      !> Compliance of the box, tangential problem and solution
      type(patch_workspace), intent(inout) :: workspace
      !> Receives the trace of the solvers, and warnings
      type(log_type), intent(inout) :: log
      !> Slip, coefficients of friction, creepages and reports are set
      type(patch_result), intent(inout) :: result
      type(bounding_box) :: box

      box = contact_box(state%now%division)
      if (box%ix0 > box%ix1) then
         if (problem%remembers_yield) call carry_yield(problem, box, workspace%solution, state)
         result%tangential%ended = ending%not_started
         return
      end if
      call prepare_box(problem, box, workspace)
      if (problem%general_step) call prepare_step(problem, workspace)
      if (iterates_friction(problem)) call workspace%friction%start(problem, state, result%dt, &
         & result%tangential%order, result%outer_iterations == 1, result%mu)
      call set_and_solve(problem, state, box, workspace, log, result)
      if (allocated(workspace%tangential%second) .and. .not. any(result%tangential%ended == [ending%converged, &
         & ending%out_of_time, ending%beyond_friction])) then
         call lower_order("no progress with order 2", result%tangential)
         call workspace%friction%forget_paths()
         call rigid_slip(problem, result)
         call set_and_solve(problem, state, box, workspace, log, result)
      end if

      associate (solution => workspace%solution)
         state%now%px(box%ix0:box%ix1, box%iy0:box%iy1) = solution%p(:, :, 1)
         state%now%py(box%ix0:box%ix1, box%iy0:box%iy1) = solution%p(:, :, 2)
         state%now%division(box%ix0:box%ix1, box%iy0:box%iy1) = solution%division
         if (problem%n_forces >= 1) result%cksi = solution%creep(1)
         if (problem%n_forces >= 2) result%ceta = solution%creep(2)
         if (log%shows(3)) call trace_division(log, solution, result%tangential)
      end associate
      if (problem%remembers_yield) call carry_yield(problem, box, workspace%solution, state)
   end subroutine tangential_step

   !> Define the tangential problem with the order in effect, and solve it
   subroutine set_and_solve(problem, state, box, workspace, log, result)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      type(bounding_box), intent(in) :: box
      type(patch_workspace), intent(inout) :: workspace
      type(log_type), intent(inout) :: log
      type(patch_result), intent(inout) :: result

      call set_tangential(problem, state, box, workspace, result)
      call set_second_order(problem, state, box, result%tangential, workspace)
      if (problem%corrects_leading_edge) call correct_leading_edge(problem, state, box, result, workspace, log)
      if (problem%model%coupled()) call add_by_pressures(problem, state, box, workspace)
      if (log%shows(2)) call log%trace(2, " TANG: " // trim(type_of_motion(problem%motion)))
      if (iterates_friction(problem)) then
         call solve_with_friction(problem, state, box, workspace, log, result)
      else
         call choose_and_solve(problem, workspace, log, result%tangential)
         result%tangential%passes = result%tangential%passes + 1
         if (log%shows(9)) call show_division(state, box, workspace%solution, log)
      end if
   end subroutine set_and_solve

   !> Do coefficients of friction depend on the solution?
   pure logical function iterates_friction(problem)
      type(patch_problem), intent(in) :: problem

      iterates_friction = .false.
      if (allocated(problem%friction)) iterates_friction = problem%friction%driver() /= friction_driver%none
   end function iterates_friction

   !> Solve for tractions and for coefficients of friction that depend on slip, in turn
   subroutine solve_with_friction(problem, state, box, workspace, log, result)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      type(bounding_box), intent(in) :: box
      type(patch_workspace), intent(inout) :: workspace
      type(log_type), intent(inout) :: log
      type(patch_result), intent(inout) :: result

      do
         call choose_and_solve(problem, workspace, log, result%tangential)
         result%tangential%passes = result%tangential%passes + 1
         if (log%shows(9)) call show_division(state, box, workspace%solution, log)
         if (result%tangential%ended == ending%out_of_time) return
         call workspace%friction%advance(problem, state, box, workspace%solution, result%tangential%succeeded(), log, result%mu)
         if (workspace%friction%ended /= ending%not_started) exit
         call set_bound(state, box, result%mu, workspace%tangential, workspace%solution)
      end do
      if (.not. allocated(result%friction)) allocate(result%friction)
      call workspace%friction%report(problem, result%friction)
   end subroutine solve_with_friction

   !> Set new traction bounds; tractions on the old bound are scaled to the new one as an estimate
   pure subroutine set_bound(state, box, mu, t, s)
      type(patch_state), intent(in) :: state
      type(bounding_box), intent(in) :: box
      !> Coefficients of friction [-], shape of the grid
      real(wp), intent(in) :: mu(:, :)
      type(tangential_problem), intent(inout) :: t
      type(tangential_solution), intent(inout) :: s
      integer :: ix, iy, jx, jy
      real(wp) :: g, length
      logical :: yields_at_bound

      yields_at_bound = allocated(t%yield) .and. .not. t%hardens()
      do iy = 1, t%my
         jy = box%iy0 + iy - 1
         do ix = 1, t%mx
            jx = box%ix0 + ix - 1
            if (.not. t%contact(ix, iy)) cycle
            g = mu(jx, jy)*state%now%pn(jx, jy)
            if (yields_at_bound) g = min(g, t%yield%limit(ix, iy))
            t%bound(ix, iy) = g
            length = hypot(s%p(ix, iy, 1), s%p(ix, iy, 2))
            if (length <= 0.0_wp) cycle
            if (length > g .or. s%division(ix, iy) == element%slip) s%p(ix, iy, :) = s%p(ix, iy, :)*(g/length)
         end do
      end do
   end subroutine set_bound

   !> Restrict the tangential problem to the bounding box of the contact area
   subroutine set_tangential(problem, state, box, workspace, result)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      type(bounding_box), intent(in) :: box
      type(patch_workspace), intent(inout) :: workspace
      type(patch_result), intent(in) :: result
      integer :: iy, mx, my

      mx = box%ix1 - box%ix0 + 1
      my = box%iy1 - box%iy0 + 1
      associate (t => workspace%tangential, s => workspace%solution)
         if (allocated(t%contact)) then
            if (any(shape(t%contact) /= [mx, my])) then
               deallocate(t%contact, t%bound, t%shift, workspace%box_un, workspace%box_pn, workspace%box_ut, workspace%share)
            end if
         end if
         if (.not. allocated(t%contact)) then
            allocate(t%contact(mx, my), t%bound(mx, my), t%shift(mx, my, 2))
            allocate(workspace%box_un(mx, my), workspace%box_pn(mx, my), workspace%box_ut(mx, my, 2), workspace%share(mx, my))
         end if
         t%mx = mx
         t%my = my
         t%dx = problem%grid%dx
         t%dy = problem%grid%dy
         t%steady = problem%motion == motion%steady_rolling
         t%direction = rolling_direction(problem)
         t%row_direction = merge(-1, 1, problem%general_step .and. sin(problem%chi) < 0.0_wp)
         t%dq = problem%dq
         t%n_forces = problem%n_forces
         t%target = problem%force*result%mu_scal*result%fn/(problem%grid%dx*problem%grid%dy)
         t%settings = problem%settings
         t%settings%eps = problem%settings%eps*problem%traction_eps*workspace%sharper
         t%deadline = problem%deadline
         call set_relaxation(problem, result%ncon, t)
         if (allocated(t%yield)) deallocate(t%yield)
         if (allocated(t%share)) deallocate(t%share)
         if (allocated(t%edge)) deallocate(t%edge)
         call prepare_solution(t, s)
         if (allocated(s%path)) deallocate(s%path)
         if (iterates_friction(problem)) then
            if (workspace%friction%follows_paths()) allocate(s%path(mx, my))
         end if
         s%creep = [result%cksi, result%ceta]
         if (pieces_of(mx*my) == 1) then
            do iy = 1, my
               call set_row(state, box, iy, result, t, s)
            end do
         else
            !$omp parallel do
            do iy = 1, my
               call set_row(state, box, iy, result, t, s)
            end do
            !$omp end parallel do
         end if
         if (problem%remembers_yield) call set_yield(problem, state%before, box, t)
         if (.not. t%steady) t%shift = t%shift - workspace%old_displacement(box%ix0:box%ix1, box%iy0:box%iy1, :)
      end associate
   end subroutine set_tangential

   !> A row of the tangential problem: contact, bounds, rigid slip and estimated tractions
   pure subroutine set_row(state, box, iy, result, t, s)
      type(patch_state), intent(in) :: state
      type(bounding_box), intent(in) :: box
      !> Row of the box
      integer, intent(in) :: iy
      type(patch_result), intent(in) :: result
      type(tangential_problem), intent(inout) :: t
      type(tangential_solution), intent(inout) :: s
      integer :: ix, jx, jy
      real(wp) :: g, length

      jy = box%iy0 + iy - 1
      do ix = 1, t%mx
         jx = box%ix0 + ix - 1
         t%contact(ix, iy) = state%now%division(jx, jy) > element%exterior
         g = 0.0_wp
         if (t%contact(ix, iy)) g = result%mu(jx, jy)*state%now%pn(jx, jy)
         t%bound(ix, iy) = g
         t%shift(ix, iy, 1) = result%wx(jx, jy)
         t%shift(ix, iy, 2) = result%wy(jx, jy)
         s%p(ix, iy, :) = [state%now%px(jx, jy), state%now%py(jx, jy)]
         length = hypot(s%p(ix, iy, 1), s%p(ix, iy, 2))
         if (length > g) s%p(ix, iy, :) = s%p(ix, iy, :)*(g/length)
      end do
   end subroutine set_row

   !> Influence coefficients of the same particles one step before, for steps of any length and direction
   subroutine prepare_step(problem, workspace)
      type(patch_problem), intent(in) :: problem
      type(patch_workspace), intent(inout) :: workspace
      real(wp) :: shift_x, shift_y

      shift_x = problem%dq*cos(problem%chi)
      shift_y = problem%dq*sin(problem%chi)
      associate (box => workspace%box)
         call fill_shifted_coefficients(workspace%shifted, problem%model, box%dx, box%dy, box%mx, box%my, shift_x, shift_y)
         if (problem%model%coupled()) call workspace%previous%prepare(problem%model, box%dx, box%dy, box%mx, box%my, &
            & shift_x, shift_y)
      end associate
   end subroutine prepare_step

   !> Add the contribution of the present pressures to the slip
   subroutine add_by_pressures(problem, state, box, workspace)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      type(bounding_box), intent(in) :: box
      type(patch_workspace), intent(inout) :: workspace

      workspace%box_pn = state%now%pn(box%ix0:box%ix1, box%iy0:box%iy1)
      if (problem%general_step) then
         call workspace%box%tangential_by_normal(workspace%box_pn, workspace%box_ut)
         workspace%tangential%shift = workspace%tangential%shift + workspace%box_ut
         workspace%box_un = 0.0_wp
         call workspace%previous%tangential(workspace%box_un, workspace%box_un, workspace%box_pn, &
            & workspace%box_ut(:, :, 1), workspace%box_ut(:, :, 2))
         workspace%box_ut = -workspace%box_ut
         if (allocated(workspace%tangential%edge)) call displace_from_edge(problem, state, box, workspace)
      else if (workspace%tangential%steady) then
         call workspace%box%steady_by_normal(workspace%box_pn, workspace%box_ut)
      else
         call workspace%box%tangential_by_normal(workspace%box_pn, workspace%box_ut)
      end if
      workspace%tangential%shift = workspace%tangential%shift + workspace%box_ut
   end subroutine add_by_pressures

   !> Displacements by the present pressures at the edge of contact, for particles that entered during the step
   subroutine displace_from_edge(problem, state, box, workspace)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      type(bounding_box), intent(in) :: box
      !> box_ut is set, in elements with an edge, to minus the displacement at the edge [mm]
      type(patch_workspace), intent(inout) :: workspace
      integer :: ix, iy, edge

      call prepare_window(problem, workspace)
      call workspace%window%tangential_by_normal(state%now%pn, workspace%ut)
      associate (t => workspace%tangential)
         do iy = 1, t%my
            do ix = 1, t%mx
               if (t%edge(ix, iy) == 0) cycle
               edge = box%ix0 + ix - 1 + t%direction*t%edge(ix, iy)
               workspace%box_ut(ix, iy, :) = -workspace%ut(edge, box%iy0 + iy - 1, :)
            end do
         end do
      end associate
   end subroutine displace_from_edge

   !> Relaxation factors of the Gauss-Seidel methods: from the input, or by the shape of the elements
   pure subroutine set_relaxation(problem, ncon, t)
      type(patch_problem), intent(in) :: problem
      integer, intent(in) :: ncon
      type(tangential_problem), intent(inout) :: t
      real(wp) :: ratio, omega(2)

      if (problem%relaxation_given) return
      ratio = problem%grid%dx/problem%grid%dy
      if (ncon <= few_elements) then
         omega = 1.0_wp
      else if (.not. t%steady .or. problem%solver == solver_choice%convex_gs) then
         omega = relaxed_step
      else if (ratio <= long_element) then
         omega = relaxed_square
      else if (ratio <= longer_element) then
         omega = relaxed_long
      else
         omega = relaxed_longer
      end if
      t%settings%omegah = omega(1)
      t%settings%omegas = omega(2)
   end subroutine set_relaxation

   !> Use the default solver, with a classical one as fallback, or the classical solver that is requested
   subroutine choose_and_solve(problem, workspace, log, report)
      type(patch_problem), intent(in) :: problem
      type(patch_workspace), intent(inout) :: workspace
      type(log_type), intent(inout) :: log
      type(solve_report), intent(inout) :: report
      integer :: method

      method = classical_method_for(problem)
      report%asked = ""
      if (is_beyond_friction(workspace%tangential) .and. .not. problem%general_step) then
         call slide_fully(workspace%tangential, workspace%box, workspace%solution, report)
      else if (problem%general_step) then
         ! the default solver is limited to steps of one element along x
         call solve_classical(workspace%tangential, workspace%box, classical_method%convex_gs, workspace%solution, report, log, &
            & workspace%shifted)
      else if (.not. (problem%classical .and. is_classical(problem%solver))) then
         call solve_by_default(problem, method, workspace, log, report)
      else if (method /= classical_method%tang_cg .and. .not. workspace%box%has_table()) then
         call log%warning("no half-space coefficients (material.influence = ""conformal"" or ""tabulated""): solver &
            &Newton-Krylov instead of the requested one (iteration.solver = ""convex_gs"", ""gauss_seidel"" or &
            &""gd_steady"")")
         call solve_by_default(problem, method, workspace, log, report)
      else
         call solve_classical(workspace%tangential, workspace%box, method, workspace%solution, report, log)
      end if
      if (is_classical(problem%solver) .and. report%method /= method_name(method)) report%asked = method_name(method)
   end subroutine choose_and_solve

   !> Newton-Krylov, with a classical method as fallback if it stagnates
   subroutine solve_by_default(problem, method, workspace, log, report)
      type(patch_problem), intent(in) :: problem
      !> Fallback method, member of classical_method
      integer, intent(in) :: method
      type(patch_workspace), intent(inout) :: workspace
      type(log_type), intent(inout) :: log
      type(solve_report), intent(inout) :: report
      !> A classical method stops by the size of its updates, with a residual usually far below the tolerance: if one is requested,
      !> the default method gets a smaller tolerance, bounded by round-off. With this factor its residual is smaller than that of
      !> the classical method in 457 of 500 problems of test_solvers_agree, and below the tolerance in all
      real(wp), parameter :: usual_share = 0.1_wp, least = 1.0e-12_wp
      real(wp) :: eps

      associate (t => workspace%tangential)
         eps = t%settings%eps
         if (is_classical(problem%solver)) t%settings%eps = min(eps, max(usual_share*eps, least))
         call solve_newton_krylov(t, workspace%box, workspace%tangential_work, workspace%solution, report, log)
         t%settings%eps = eps
         ! the requested tolerance is EPS, also if tractions are solved more accurately
         report%tolerance = problem%settings%eps*max(1.0_wp, problem%traction_eps)
         if (report%ended == ending%out_of_time) return
         if ((is_classical(problem%solver) .or. eps < report%tolerance) .and. (report%ended == ending%stagnated &
            & .or. report%ended == ending%iteration_limit) .and. report%residual >= 0.0_wp &
            & .and. report%residual <= report%tolerance) report%ended = ending%converged
         ! after a failure of the second order, the caller reduces the order first
         if (report%succeeded() .or. allocated(t%second)) return
         if (problem%motion == motion%steady_rolling .and. .not. workspace%box%has_table()) return
         call log%warning("Newton-Krylov made no further progress; a classical method takes over")
         if (workspace%box%has_table()) then
            call solve_classical(t, workspace%box, method, workspace%solution, report, log)
         else
            call solve_classical(t, workspace%box, classical_method%tang_cg, workspace%solution, report, log)
         end if
         report%gave_up = "Newton-Krylov"
      end associate
   end subroutine solve_by_default

   !> The classical method that the case requests, or that is the fallback of the default solver; member of classical_method
   pure integer function classical_method_for(problem) result(method)
      type(patch_problem), intent(in) :: problem

      method = classical_method%tang_cg
      if (problem%motion == motion%steady_rolling) then
         method = classical_method%steady_gs
         if (problem%solver == solver_choice%gd_steady) method = classical_method%gd_steady
      end if
      if (problem%solver == solver_choice%convex_gs) method = classical_method%convex_gs
   end function classical_method_for

   !> Heading of the flow trace
   pure function type_of_motion(choice) result(text)
      integer, intent(in) :: choice
      character(len=28) :: text

      text = "STEADY STATE ROLLING CONTACT"
      if (choice == motion%shift) text = "SHIFT TRANSIENT"
      if (choice == motion%transient_rolling) text = "TRANSIENT ROLLING CONTACT"
   end function type_of_motion

   !> Picture of the element states of a solution, at its position on the grid
   subroutine show_division(state, box, solution, log)
      type(patch_state), intent(in) :: state
      type(bounding_box), intent(in) :: box
      type(tangential_solution), intent(in) :: solution
      type(log_type), intent(inout) :: log
      integer, allocatable :: division(:, :)

      division = state%now%division
      division(box%ix0:box%ix1, box%iy0:box%iy1) = solution%division
      call trace_picture(log, division)
   end subroutine show_division

   !> Line of the flow trace about the adhesion and slip areas
   subroutine trace_division(log, solution, report)
      type(log_type), intent(inout) :: log
      type(tangential_solution), intent(in) :: solution
      type(solve_report), intent(in) :: report
      character(len=80) :: line
      character(len=7) :: counter
      character(len=14) :: plastic

      counter = "  ItGS="
      if (report%method == "TangCG") counter = "  ItCG="
      if (report%method == "Newton-Krylov") counter = "  ItNK="
      plastic = ""
      if (allocated(solution%plastic)) write(plastic, "(I7)") count(solution%division == element%plastic)
      write(line, "(2A,2I7,2A,I6)") "      Tang: final element division: A, S", &
         & trim(merge(", P=", "=   ", allocated(solution%plastic))), count(solution%division == element%adhesion), &
         & count(solution%division == element%slip), trim(plastic), counter, report%iterations
      call log%trace(3, trim(line))
   end subroutine trace_division
end module contact_patch_tangential_step
