!> Solves one contact patch: normal and tangential problem, and what follows from them
!>
!> With K = 0 the two problems are solved once, one after the other (Johnson). Otherwise they
!> alternate with the tractions of the other one frozen (Panagiotopoulos) until the tractions
!> no longer change.
module contact_patch_solve
   use contact_base_choices, only : estimate_choice, motion, solver_choice
   use contact_base_constants, only : excluded_threshold
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_operator, only : elastic_operator
   use contact_elastic_previous, only : previous_operator
   use contact_grid_element_division, only : bounding_box, contact_box, element
   use contact_normal_conjugate_gradient, only : normal_problem, normal_workspace, release_normal, solve_normal
   use contact_patch_problem, only : patch_problem, patch_state, traction_fields
   use contact_patch_result, only : patch_result
   use contact_tangential_classical, only : classical_method, solve_classical
   use contact_tangential_nested, only : nested_workspace, release_nested, solve_newton_krylov
   use contact_tangential_problem, only : prepare_solution, tangential_problem, tangential_solution
   implicit none (type, external)
   private

   public :: patch_workspace, release_workspace, solve_patch, fit_fields

   !> Scratch of one patch: operators with their spectra, and the solvers' arrays
   type :: patch_workspace
      !> Compliance on the whole window and on the bounding box of the contact area
      type(elastic_operator) :: window, box
      type(previous_operator) :: previous
      type(normal_problem) :: normal
      type(normal_workspace) :: normal_work
      type(tangential_problem) :: tangential
      type(tangential_solution) :: solution
      type(nested_workspace) :: tangential_work
      !> Displacements at the previous time [mm], shape (mx, my, 2)
      real(wp), allocatable :: old_displacement(:, :, :)
      !> Scratch on the window, shapes (mx, my) and (mx, my, 2)
      real(wp), allocatable :: un(:, :), ut(:, :, :), pt(:, :, :), last(:, :, :)
      !> Scratch on the box
      real(wp), allocatable :: box_un(:, :), box_pn(:, :), box_ut(:, :, :)
   end type patch_workspace

   !> Outer iterations stop when the tractions change by less than this many times eps
   real(wp), parameter :: outer_factor = 5.0_wp

contains

   !> Solve for the tractions of this step
   subroutine solve_patch(problem, state, workspace, log, result, error)
      type(patch_problem), intent(in) :: problem
      !> now: estimate on entry, solution on exit; before: the previous moment
      type(patch_state), intent(inout) :: state
      type(patch_workspace), intent(inout) :: workspace
      type(log_type), intent(inout) :: log
      type(patch_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      integer :: outer
      real(wp) :: change, size_
      character(len=96) :: line

      call check_problem(problem, error)
      if (allocated(error)) return
      call fit_workspace(problem, workspace)
      call reset_result(problem, state, result)
      if (problem%motion /= motion%none) call rigid_slip(problem, result)
      if (problem%motion == motion%none) then
         state%now%px = 0.0_wp
         state%now%py = 0.0_wp
      else if (problem%motion /= motion%steady_rolling) then
         call previous_displacement(problem, state, workspace)
      end if

      do outer = 1, max(1, problem%maxout)
         result%outer_iterations = outer
         if (problem%maxout > 1) then
            workspace%last(:, :, 1) = state%now%px
            workspace%last(:, :, 2) = state%now%py
            workspace%last(:, :, 3) = state%now%pn
         end if
         call normal_step(problem, state, workspace, log, result)
         if (problem%motion == motion%none) exit
         call tangential_step(problem, state, workspace, log, result)
         if (problem%maxout <= 1 .or. result%ncon == 0) exit
         if (.not. (result%normal%succeeded() .and. result%tangential%succeeded())) exit
         change = sqrt((sum((state%now%px - workspace%last(:, :, 1))**2) + sum((state%now%py - workspace%last(:, :, 2))**2) &
            & + sum((state%now%pn - workspace%last(:, :, 3))**2))/(3.0_wp*result%ncon))
         size_ = sqrt((sum(state%now%px**2) + sum(state%now%py**2) + sum(state%now%pn**2))/(3.0_wp*result%ncon))
         write(line, '(i3,a,2es12.3)') outer, ", Panag/Out: |Pk - Pk-1|,  5 Eps |Pk| :", change, outer_factor*problem%eps*size_
         call log%trace(1, trim(line))
         if (change <= outer_factor*problem%eps*size_) exit
         if (outer == problem%maxout) call log%warning("the outer iteration did not reach its tolerance in MAXOUT passes")
      end do
      call derive(problem, state, workspace, result)
      state%started = .true.
   end subroutine solve_patch

   !> Free what the workspace holds outside Fortran's memory: plans of transforms
   subroutine release_workspace(workspace)
      type(patch_workspace), intent(inout) :: workspace

      call workspace%window%release()
      call workspace%box%release()
      call workspace%previous%release()
      call release_normal(workspace%normal_work)
      call release_nested(workspace%tangential_work)
   end subroutine release_workspace

   !> Refuse what has no solution
   subroutine check_problem(problem, error)
      type(patch_problem), intent(in) :: problem
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: force
      character(len=16) :: text

      if (problem%motion == motion%none .or. problem%n_forces == 0) return
      force = norm2(problem%force(:problem%n_forces))
      if (force < 1.0_wp) return
      write(text, '(f0.6)') force
      call fatal_error(error, "the prescribed tangential force is " // trim(text) // &
         & " times the friction bound; forces below 1 can be reached", error_kind%input)
   end subroutine check_problem

   !> Scratch of the size of the window; kept when the size is the same
   subroutine fit_workspace(problem, workspace)
      type(patch_problem), intent(in) :: problem
      type(patch_workspace), intent(inout) :: workspace
      integer :: mx, my

      mx = problem%grid%mx
      my = problem%grid%my
      if (allocated(workspace%un)) then
         if (all(shape(workspace%un) == [mx, my])) return
         deallocate(workspace%un, workspace%ut, workspace%pt, workspace%last, workspace%old_displacement)
      end if
      allocate(workspace%un(mx, my), workspace%ut(mx, my, 2), workspace%pt(mx, my, 2), workspace%last(mx, my, 3), &
         & workspace%old_displacement(mx, my, 2), source=0.0_wp)
   end subroutine fit_workspace

   !> Fields of a moment on a grid, zero where new; kept when the size is the same
   subroutine fit_fields(fields, grid_mx, grid_my)
      type(traction_fields), intent(inout) :: fields
      integer, intent(in) :: grid_mx, grid_my

      if (allocated(fields%division)) then
         if (all(shape(fields%division) == [grid_mx, grid_my])) return
         deallocate(fields%division, fields%pn, fields%px, fields%py)
      end if
      allocate(fields%division(grid_mx, grid_my), source=element%exterior)
      allocate(fields%pn(grid_mx, grid_my), fields%px(grid_mx, grid_my), fields%py(grid_mx, grid_my), source=0.0_wp)
   end subroutine fit_fields

   !> Start values of a result
   subroutine reset_result(problem, state, result)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      type(patch_result), intent(inout) :: result
      integer :: mx, my

      mx = problem%grid%mx
      my = problem%grid%my
      result%grid = problem%grid
      result%gg = problem%material%gg
      result%nu = problem%material%nu
      result%ak = problem%material%ak
      result%chi = problem%chi
      result%dq = problem%dq
      result%veloc = problem%veloc
      result%dt = problem%dq/max(1.0e-10_wp, problem%veloc)
      result%mu_scal = problem%mu
      result%fn = problem%fn
      result%pen = problem%pen
      result%cksi = problem%creep(1)
      result%ceta = problem%creep(2)
      result%cphi = problem%spin
      result%fx_rel = problem%force(1)
      result%fy_rel = problem%force(2)
      result%sensitivity = 0.0_wp
      result%nplast = 0
      result%outer_iterations = 0
      result%normal = solve_report()
      result%tangential = solve_report()
      result%inorm = 0
      result%itang = 0
      result%residual = 0.0_wp
      if (problem%n_forces >= 1) then
         result%cksi = 0.0_wp
         if (problem%n_forces == 2) result%ceta = 0.0_wp
         if (problem%estimate == estimate_choice%previous .or. problem%estimate == estimate_choice%unchanged) then
            result%cksi = state%creep(1)
            if (problem%n_forces == 2) result%ceta = state%creep(2)
         end if
      end if
      if (allocated(result%h)) then
         if (any(shape(result%h) /= [mx, my])) deallocate(result%h, result%division, result%mu, result%pn, result%px, &
            & result%py, result%un, result%ux, result%uy, result%sx, result%sy, result%wx, result%wy)
      end if
      if (.not. allocated(result%h)) then
         allocate(result%h(mx, my), result%mu(mx, my), result%pn(mx, my), result%px(mx, my), result%py(mx, my), &
            & result%un(mx, my), result%ux(mx, my), result%uy(mx, my), result%sx(mx, my), result%sy(mx, my), &
            & result%wx(mx, my), result%wy(mx, my))
         allocate(result%division(mx, my))
      end if
      result%h = problem%h
      result%mu = problem%mu
      result%un = 0.0_wp
      result%ux = 0.0_wp
      result%uy = 0.0_wp
      result%sx = 0.0_wp
      result%sy = 0.0_wp
      result%wx = 0.0_wp
      result%wy = 0.0_wp
      result%division = element%exterior
   end subroutine reset_result

   !> Rolling towards increasing or decreasing x
   pure integer function rolling_direction(problem)
      type(patch_problem), intent(in) :: problem
      rolling_direction = merge(-1, 1, problem%motion == motion%steady_rolling .and. cos(problem%chi) < 0.0_wp)
   end function rolling_direction

   !> Rigid slip per step without unknown creepages [mm], Kalker (1990)
   !>
   !> The offset of a sixth of the step makes the spin contribution second order accurate.
   pure subroutine rigid_slip(problem, result)
      type(patch_problem), intent(in) :: problem
      type(patch_result), intent(inout) :: result
      integer :: ix, iy
      real(wp) :: x0, y0, cx, cy

      x0 = problem%spin_centre(1) - problem%spin_offset*problem%dq*cos(problem%chi)
      y0 = problem%spin_centre(2) - problem%spin_offset*problem%dq*sin(problem%chi)
      cx = merge(problem%creep(1), 0.0_wp, problem%n_forces < 1)
      cy = merge(problem%creep(2), 0.0_wp, problem%n_forces < 2)
      do iy = 1, problem%grid%my
         do ix = 1, problem%grid%mx
            result%wx(ix, iy) = problem%dq*(cx - problem%spin*(problem%grid%y(iy) - y0))
            result%wy(ix, iy) = problem%dq*(cy + problem%spin*(problem%grid%x(ix) - x0))
         end do
      end do
      if (.not. allocated(problem%extra_slip)) return
      result%wx = result%wx + problem%dq*problem%extra_slip(:, :, 1)
      result%wy = result%wy + problem%dq*problem%extra_slip(:, :, 2)
   end subroutine rigid_slip

   !> Displacements at the previous time of the particles that are in the elements now
   subroutine previous_displacement(problem, state, workspace)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      type(patch_workspace), intent(inout) :: workspace
      real(wp) :: shift_x, shift_y

      workspace%old_displacement = 0.0_wp
      if (.not. any(state%before%division > element%exterior)) return
      shift_x = 0.0_wp
      shift_y = 0.0_wp
      if (problem%motion == motion%transient_rolling) then
         shift_x = problem%dq*cos(problem%chi)
         shift_y = problem%dq*sin(problem%chi)
         if (abs(shift_y) < 1.0e-10_wp*problem%dq) shift_y = 0.0_wp
         if (abs(shift_x) < 1.0e-10_wp*problem%dq) shift_x = 0.0_wp
      end if
      call workspace%previous%prepare(problem%material, problem%grid%dx, problem%grid%dy, problem%grid%mx, problem%grid%my, &
         & shift_x, shift_y)
      call workspace%previous%tangential(state%before%px, state%before%py, state%before%pn, &
         & workspace%old_displacement(:, :, 1), workspace%old_displacement(:, :, 2))
   end subroutine previous_displacement

   !> Pressures, approach or force, and the contact area
   subroutine normal_step(problem, state, workspace, log, result)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(inout) :: state
      type(patch_workspace), intent(inout) :: workspace
      type(log_type), intent(inout) :: log
      type(patch_result), intent(inout) :: result
      integer :: ix, iy
      logical :: first
      character(len=80) :: line

      first = result%outer_iterations == 1
      if (allocated(problem%given_pressure)) then
         state%now%pn = problem%given_pressure
         where (problem%h > excluded_threshold) state%now%pn = 0.0_wp
         result%normal%ended = ending%not_started
      else
         if (first) then
            if (allocated(problem%pressure_estimate)) state%now%pn = problem%pressure_estimate
         end if
         call workspace%window%prepare(problem%material, problem%grid%dx, problem%grid%dy, problem%grid%mx, problem%grid%my, &
            & rolling_direction(problem))
         associate (normal => workspace%normal)
            normal%mx = problem%grid%mx
            normal%my = problem%grid%my
            normal%dx = problem%grid%dx
            normal%dy = problem%grid%dy
            normal%h = problem%h
            if (problem%material%coupled() .and. problem%motion /= motion%none) then
               workspace%pt(:, :, 1) = state%now%px
               workspace%pt(:, :, 2) = state%now%py
               call workspace%window%normal_by_tangential(workspace%pt, workspace%un)
               where (normal%h < excluded_threshold) normal%h = normal%h + workspace%un
            end if
            normal%force_prescribed = problem%force_prescribed
            normal%fn = problem%fn
            normal%eps = problem%eps
            normal%maxgs = problem%maxgs
            call log%trace(4, " NORM")
            call solve_normal(normal, workspace%window, workspace%normal_work, state%now%pn, result%pen, result%normal, log)
         end associate
      end if
      result%ncon = 0
      do iy = 1, problem%grid%my
         do ix = 1, problem%grid%mx
            if (state%now%pn(ix, iy) > 0.0_wp) then
               result%ncon = result%ncon + 1
               if (state%now%division(ix, iy) == element%exterior) state%now%division(ix, iy) = element%adhesion
            else
               state%now%division(ix, iy) = element%exterior
               state%now%px(ix, iy) = 0.0_wp
               state%now%py(ix, iy) = 0.0_wp
            end if
         end do
      end do
      if (.not. allocated(problem%given_pressure)) then
         result%normal%passes = result%normal%passes + 1
         if (log%shows(3)) then
            write(line, '(a,2i7,a,i6)') "      Norm: final element division: C, E=", result%ncon, &
               & problem%grid%npot() - result%ncon, "  ItCG=", result%normal%iterations
            call log%trace(3, trim(line))
         end if
         if (.not. result%normal%succeeded()) call report_failure(log, "normal", result%normal)
      end if
      if (.not. problem%force_prescribed) result%fn = problem%grid%dx*problem%grid%dy*sum(state%now%pn)
      if (problem%motion == motion%none) then
         where (state%now%division > element%exterior) state%now%division = element%adhesion
      end if
   end subroutine normal_step

   !> Tangential tractions and slip on the given contact area
   subroutine tangential_step(problem, state, workspace, log, result)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(inout) :: state
      type(patch_workspace), intent(inout) :: workspace
      type(log_type), intent(inout) :: log
      type(patch_result), intent(inout) :: result
      type(bounding_box) :: box

      box = contact_box(state%now%division)
      if (box%ix0 > box%ix1) then
         result%tangential%ended = ending%not_started
         return
      end if
      call workspace%box%prepare(problem%material, problem%grid%dx, problem%grid%dy, box%ix1 - box%ix0 + 1, &
         & box%iy1 - box%iy0 + 1, rolling_direction(problem))
      call set_tangential(problem, state, box, workspace, result)
      if (log%shows(2)) call log%trace(2, " TANG: " // type_of_motion(problem%motion))
      call choose_and_solve(problem, workspace, log, result%tangential)
      result%tangential%passes = result%tangential%passes + 1

      associate (solution => workspace%solution)
         state%now%px(box%ix0:box%ix1, box%iy0:box%iy1) = solution%p(:, :, 1)
         state%now%py(box%ix0:box%ix1, box%iy0:box%iy1) = solution%p(:, :, 2)
         state%now%division(box%ix0:box%ix1, box%iy0:box%iy1) = solution%division
         if (problem%n_forces >= 1) result%cksi = solution%creep(1)
         if (problem%n_forces >= 2) result%ceta = solution%creep(2)
         result%sensitivity(2:3, 2:3) = solution%sensitivity
         if (log%shows(3)) call trace_division(log, solution, result%tangential)
      end associate
      if (.not. result%tangential%succeeded()) call report_failure(log, "tangential", result%tangential)
   end subroutine tangential_step

   !> Line of the flow trace about the adhesion and slip areas
   subroutine trace_division(log, solution, report)
      type(log_type), intent(inout) :: log
      type(tangential_solution), intent(in) :: solution
      type(solve_report), intent(in) :: report
      character(len=80) :: line
      character(len=7) :: counter

      counter = "  ItGS="
      if (report%method == "TangCG") counter = "  ItCG="
      if (report%method == "Newton-Krylov") counter = "  ItNK="
      write(line, '(a,2i7,a,i6)') "      Tang: final element division: A, S=", count(solution%division == element%adhesion), &
         & count(solution%division == element%slip), counter, report%iterations
      call log%trace(3, trim(line))
   end subroutine trace_division

   !> Crop the tangential problem to the contact area
   subroutine set_tangential(problem, state, box, workspace, result)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      type(bounding_box), intent(in) :: box
      type(patch_workspace), intent(inout) :: workspace
      type(patch_result), intent(in) :: result
      integer :: ix, iy, jx, jy, mx, my
      real(wp) :: g, length

      mx = box%ix1 - box%ix0 + 1
      my = box%iy1 - box%iy0 + 1
      associate (t => workspace%tangential, s => workspace%solution)
         if (allocated(t%contact)) then
            if (any(shape(t%contact) /= [mx, my])) then
               deallocate(t%contact, t%bound, t%shift, workspace%box_un, workspace%box_pn, workspace%box_ut)
            end if
         end if
         if (.not. allocated(t%contact)) then
            allocate(t%contact(mx, my), t%bound(mx, my), t%shift(mx, my, 2))
            allocate(workspace%box_un(mx, my), workspace%box_pn(mx, my), workspace%box_ut(mx, my, 2))
         end if
         t%mx = mx
         t%my = my
         t%dx = problem%grid%dx
         t%dy = problem%grid%dy
         t%steady = problem%motion == motion%steady_rolling
         t%direction = rolling_direction(problem)
         t%dq = problem%dq
         t%n_forces = problem%n_forces
         t%target = problem%force*problem%mu*result%fn/(problem%grid%dx*problem%grid%dy)
         t%eps = problem%eps
         t%maxgs = problem%maxgs
         t%maxin = problem%maxin
         t%maxnr = problem%maxnr
         call set_relaxation(problem, result%ncon, t)
         t%fdecay = problem%fdecay
         t%betath = problem%betath
         t%kdowfb = problem%kdowfb
         t%d_ifc = problem%d_ifc
         t%d_lin = problem%d_lin
         t%d_cns = problem%d_cns
         t%d_slp = problem%d_slp
         t%pow_s = problem%pow_s
         call prepare_solution(t, s)
         s%creep = [result%cksi, result%ceta]
         do iy = 1, my
            jy = box%iy0 + iy - 1
            do ix = 1, mx
               jx = box%ix0 + ix - 1
               t%contact(ix, iy) = state%now%division(jx, jy) > element%exterior
               g = 0.0_wp
               if (t%contact(ix, iy)) g = problem%mu*state%now%pn(jx, jy)
               t%bound(ix, iy) = g
               t%shift(ix, iy, 1) = result%wx(jx, jy)
               t%shift(ix, iy, 2) = result%wy(jx, jy)
               s%p(ix, iy, :) = [state%now%px(jx, jy), state%now%py(jx, jy)]
               length = hypot(s%p(ix, iy, 1), s%p(ix, iy, 2))
               if (length > g) s%p(ix, iy, :) = s%p(ix, iy, :)*(g/length)
            end do
         end do
         if (.not. t%steady) t%shift = t%shift - workspace%old_displacement(box%ix0:box%ix1, box%iy0:box%iy1, :)
         if (problem%material%coupled()) then
            workspace%box_pn = state%now%pn(box%ix0:box%ix1, box%iy0:box%iy1)
            if (t%steady) then
               call workspace%box%steady_by_normal(workspace%box_pn, workspace%box_ut)
            else
               call workspace%box%tangential_by_normal(workspace%box_pn, workspace%box_ut)
            end if
            t%shift = t%shift + workspace%box_ut
         end if
      end associate
   end subroutine set_tangential

   !> Relaxation of the Gauss-Seidel methods: from the input, or by the shape of the elements
   pure subroutine set_relaxation(problem, ncon, t)
      type(patch_problem), intent(in) :: problem
      integer, intent(in) :: ncon
      type(tangential_problem), intent(inout) :: t
      real(wp) :: ratio

      t%omegah = problem%omegah
      t%omegas = problem%omegas
      if (problem%relaxation_given) return
      ratio = problem%grid%dx/problem%grid%dy
      if (ncon <= 25) then
         t%omegah = 1.0_wp
         t%omegas = 1.0_wp
      else if (.not. t%steady .or. problem%solver == solver_choice%convex_gs) then
         t%omegah = 0.5_wp
         t%omegas = 0.5_wp
      else if (ratio <= 5.0_wp) then
         t%omegah = 0.9_wp
         t%omegas = 1.0_wp
      else
         t%omegah = 0.8_wp
         t%omegas = merge(0.8_wp, 0.6_wp, ratio <= 15.0_wp)
      end if
   end subroutine set_relaxation

   !> Run the solver that the case names; the default one hands over when it makes no progress
   subroutine choose_and_solve(problem, workspace, log, report)
      type(patch_problem), intent(in) :: problem
      type(patch_workspace), intent(inout) :: workspace
      type(log_type), intent(inout) :: log
      type(solve_report), intent(inout) :: report
      integer :: method

      method = classical_method%tang_cg
      if (problem%motion == motion%steady_rolling) method = classical_method%steady_gs
      select case (problem%solver)
      case (solver_choice%convex_gs)
         method = classical_method%convex_gs
      case (solver_choice%gauss_seidel)
         continue
      case (solver_choice%gd_steady)
         if (problem%motion == motion%steady_rolling) method = classical_method%gd_steady
      case default
         call solve_newton_krylov(workspace%tangential, workspace%box, workspace%tangential_work, workspace%solution, report, log)
         if (report%succeeded()) return
         call log%warning("Newton-Krylov made no further progress; a classical method takes over")
         call solve_classical(workspace%tangential, workspace%box, method, workspace%solution, report, log)
         report%gave_up = "Newton-Krylov"
         return
      end select
      call solve_classical(workspace%tangential, workspace%box, method, workspace%solution, report, log)
   end subroutine choose_and_solve

   !> Say that an iteration did not reach its tolerance
   subroutine report_failure(log, name, report)
      type(log_type), intent(inout) :: log
      character(len=*), intent(in) :: name
      type(solve_report), intent(in) :: report
      character(len=32) :: residual
      character(len=:), allocatable :: how

      write(residual, '(es10.2)') report%residual
      select case (report%ended)
      case (ending%iteration_limit)
         how = "used up its iterations"
      case (ending%stagnated)
         how = "stagnated"
      case default
         how = "diverged"
      end select
      call log%warning("the " // name // " problem: " // report%method // " " // how // "; relative residual " &
         & // trim(adjustl(residual)))
   end subroutine report_failure

   !> Heading of the flow trace
   pure function type_of_motion(choice) result(text)
      integer, intent(in) :: choice
      character(len=:), allocatable :: text

      text = "STEADY STATE ROLLING CONTACT"
      if (choice == motion%shift) text = "SHIFT TRANSIENT"
      if (choice == motion%transient_rolling) text = "TRANSIENT ROLLING CONTACT"
   end function type_of_motion

   !> Totals and fields that follow from the tractions
   subroutine derive(problem, state, workspace, result)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(inout) :: state
      type(patch_workspace), intent(inout) :: workspace
      type(patch_result), intent(inout) :: result
      type(bounding_box) :: box
      real(wp) :: area, scale
      integer :: iy, ix

      area = problem%grid%dx*problem%grid%dy
      box = contact_box(state%now%division)
      result%inorm = merge(result%normal%passes, -1, result%normal%succeeded())
      result%itang = merge(result%tangential%passes, -1, result%tangential%succeeded())
      result%division = state%now%division
      result%pn = state%now%pn
      result%px = state%now%px
      result%py = state%now%py
      result%pmax = maxval(result%pn)
      result%ncon = count(result%division > element%exterior)
      result%nadh = count(result%division == element%adhesion)
      result%nslip = count(result%division == element%slip)
      scale = problem%mu*result%fn + tiny(scale)
      if (problem%motion == motion%none) then
         result%fx_rel = 0.0_wp
         result%fy_rel = 0.0_wp
      else
         if (problem%n_forces < 1) result%fx_rel = area*sum(result%px)/scale
         if (problem%n_forces < 2) result%fy_rel = area*sum(result%py)/scale
      end if
      result%fx = result%fx_rel*scale
      result%fy = result%fy_rel*scale
      result%mx = 0.0_wp
      result%my = 0.0_wp
      result%mz = 0.0_wp
      do iy = 1, problem%grid%my
         do ix = 1, problem%grid%mx
            if (result%division(ix, iy) == element%exterior) cycle
            result%mx = result%mx + area*result%pn(ix, iy)*problem%grid%y(iy)
            result%my = result%my - area*result%pn(ix, iy)*problem%grid%x(ix)
            result%mz = result%mz + area*(result%py(ix, iy)*problem%grid%x(ix) - result%px(ix, iy)*problem%grid%y(iy))
         end do
      end do
      if (problem%motion /= motion%none) then
         if (problem%n_forces >= 1) result%wx = result%wx + problem%dq*result%cksi
         if (problem%n_forces >= 2) result%wy = result%wy + problem%dq*result%ceta
      end if
      result%elastic_energy = 0.0_wp
      result%friction_power = 0.0_wp
      result%residual = max(result%normal%residual, result%tangential%residual, 0.0_wp)
      if (result%ncon == 0) then
         state%now%pen = result%pen
         state%creep = [result%cksi, result%ceta]
         return
      end if
      call displacements(problem, state, box, workspace, result)
      if (problem%motion /= motion%none) then
         where (workspace%solution%division == element%slip)
            result%sx(box%ix0:box%ix1, box%iy0:box%iy1) = workspace%solution%slip(:, :, 1)
            result%sy(box%ix0:box%ix1, box%iy0:box%iy1) = workspace%solution%slip(:, :, 2)
         end where
         result%friction_power = area/(1000.0_wp*result%dt)*(sum(result%px*result%sx) + sum(result%py*result%sy))
         if (problem%material%coupled()) call coupled_residual(problem, box, result)
      end if
      if (.not. allocated(problem%given_pressure)) then
         result%elastic_energy = area/2000.0_wp*(sum(result%pn*result%un) + sum(result%px*result%ux) + sum(result%py*result%uy))
      else
         result%un = 0.0_wp
      end if
      state%now%pen = result%pen
      state%creep = [result%cksi, result%ceta]
   end subroutine derive

   !> Displacement differences: on the contact area, or on the whole window when wanted
   subroutine displacements(problem, state, box, workspace, result)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      type(bounding_box), intent(in) :: box
      type(patch_workspace), intent(inout) :: workspace
      type(patch_result), intent(inout) :: result

      if (problem%want_exterior .or. problem%motion == motion%none) then
         call workspace%window%prepare(problem%material, problem%grid%dx, problem%grid%dy, problem%grid%mx, &
            & problem%grid%my, rolling_direction(problem))
         call workspace%window%normal(state%now%pn, result%un)
         if (problem%motion /= motion%none) then
            workspace%pt(:, :, 1) = state%now%px
            workspace%pt(:, :, 2) = state%now%py
            call workspace%window%tangential(workspace%pt, workspace%ut)
            result%ux = workspace%ut(:, :, 1)
            result%uy = workspace%ut(:, :, 2)
         end if
         if (problem%material%coupled()) then
            if (problem%motion /= motion%none) then
               call workspace%window%normal_by_tangential(workspace%pt, workspace%un)
               result%un = result%un + workspace%un
            end if
            call workspace%window%tangential_by_normal(state%now%pn, workspace%ut)
            result%ux = result%ux + workspace%ut(:, :, 1)
            result%uy = result%uy + workspace%ut(:, :, 2)
         end if
         return
      end if
      workspace%box_pn = state%now%pn(box%ix0:box%ix1, box%iy0:box%iy1)
      call workspace%box%normal(workspace%box_pn, workspace%box_un)
      result%un(box%ix0:box%ix1, box%iy0:box%iy1) = workspace%box_un
      call workspace%box%tangential(workspace%solution%p, workspace%box_ut)
      result%ux(box%ix0:box%ix1, box%iy0:box%iy1) = workspace%box_ut(:, :, 1)
      result%uy(box%ix0:box%ix1, box%iy0:box%iy1) = workspace%box_ut(:, :, 2)
      if (problem%material%coupled()) then
         call workspace%box%normal_by_tangential(workspace%solution%p, workspace%box_un)
         call workspace%box%tangential_by_normal(workspace%box_pn, workspace%box_ut)
         associate (un => result%un(box%ix0:box%ix1, box%iy0:box%iy1), ux => result%ux(box%ix0:box%ix1, box%iy0:box%iy1), &
            & uy => result%uy(box%ix0:box%ix1, box%iy0:box%iy1))
            un = un + workspace%box_un
            ux = ux + workspace%box_ut(:, :, 1)
            uy = uy + workspace%box_ut(:, :, 2)
         end associate
      end if
      where (result%division == element%exterior)
         result%un = 0.0_wp
         result%ux = 0.0_wp
         result%uy = 0.0_wp
      end where
   end subroutine displacements

   !> Residual of the coupled conditions: normal gaps with the final tangential tractions
   !>
   !> The tangential problem was solved last, with the final pressures; its own residual counts.
   subroutine coupled_residual(problem, box, result)
      type(patch_problem), intent(in) :: problem
      type(bounding_box), intent(in) :: box
      type(patch_result), intent(inout) :: result
      real(wp) :: gap, worst
      integer :: ix, iy

      worst = 0.0_wp
      do iy = box%iy0, box%iy1
         do ix = box%ix0, box%ix1
            if (result%division(ix, iy) == element%exterior) cycle
            gap = result%h(ix, iy) - result%pen + result%un(ix, iy)
            worst = max(worst, abs(gap))
         end do
      end do
      if (allocated(problem%given_pressure)) return
      result%residual = max(result%tangential%residual, &
         & worst/max(abs(result%pen - minval(result%h)), tiny(worst)))
   end subroutine coupled_residual
end module contact_patch_solve
