!> Sensitivities of the forces of a patch to approach, creepages and spin
!>
!> Exact derivatives of the discrete solution: one linear system per input, with the operator of the normal problem on the contact
!> area, and with the Jacobian of the tangential problem. Quantities that the solution freezes stay frozen: the contact area, normal
!> displacements by tangential tractions, and the coefficient of friction in each element.
module contact_patch_sensitivities
   use contact_base_choices, only : motion, sensitivity_choice
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_elastic_compliance, only : compliance
   use contact_grid_element_division, only : bounding_box, contact_box, element
   use contact_normal_conjugate_gradient, only : normal_workspace
   use contact_normal_stiffness, only : pressure_derivative
   use contact_patch_order, only : spin_offset_of
   use contact_patch_problem, only : patch_problem, patch_state
   use contact_patch_result, only : patch_result
   use contact_patch_workspace, only : patch_workspace
   use contact_tangential_nested, only : traction_derivative
   implicit none (type, external)
   private

   public :: find_sensitivities

   !> Rows and columns of the table
   integer, parameter :: row_fn = 1, row_fx = 2, row_fy = 3, row_mz = 4
   integer, parameter :: to_pen = 1, to_ksi = 2, to_eta = 3, to_phi = 4

   !> Relative residuals up to this multiple of EPSENS give no warning
   real(wp), parameter :: accepted = 10.0_wp

contains

   !> Compute the sensitivities that the problem requests
   subroutine find_sensitivities(problem, workspace, state, result, log)
      !> Requested sensitivities and their tolerance; prescribed forces
      type(patch_problem), intent(in) :: problem
      !> Compliances, and the tangential problem with its solution
      type(patch_workspace), intent(inout) :: workspace
      !> The derivative of the pressures is stored if estimates are extrapolated in the approach
      type(patch_state), intent(inout) :: state
      !> Totals on entry; `sensitivity` is set
      type(patch_result), intent(inout) :: result
      !> Receives a warning if a linear system was not solved accurately enough
      type(log_type), intent(inout) :: log
      real(wp), allocatable :: q(:, :)
      real(wp) :: reached
      logical :: wanted(4)
      character(len=12) :: text

      reached = 0.0_wp
      if (problem%sensitivity == sensitivity_choice%none .or. result%ncon == 0) return
      if (problem%sensitivity >= sensitivity_choice%normal .and. problem%solves_for_pressure()) &
         & call normal_stiffness(problem, workspace%window, workspace%normal_work, state, result, q, reached)
      ! there is no linearised problem for steps of other length than one element
      if (problem%motion /= motion%none .and. .not. allocated(problem%simplified) .and. .not. problem%general_step) &
         & call tangential_part()
      if (reached <= accepted*problem%epsens .or. .not. problem%reports_sensitivity) return
      write(text, "(ES8.1)") reached
      call log%warning("sensitivities are less accurate than EPSENS: a relative residual of " // trim(adjustl(text)) // &
         & " is left after MXSENS iterations")

   contains

      subroutine tangential_part()
         wanted = [.false., problem%n_forces >= 1, problem%n_forces >= 2, .false.]
         if (problem%sensitivity >= sensitivity_choice%all) wanted = [allocated(q), .true., .true., .true.]
         if (any(wanted)) call force_changes(problem, wanted, q, workspace, result, reached)
      end subroutine tangential_part
   end subroutine find_sensitivities

   !> dFn/dpen [N/mm], and the derivative of the pressures with respect to the approach
   subroutine normal_stiffness(problem, operator, solver, state, result, q, reached)
      type(patch_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      !> Work space of the solution: factorisation, possibly that of the contact area, and window around it
      type(normal_workspace), intent(inout) :: solver
      type(patch_state), intent(inout) :: state
      type(patch_result), intent(inout) :: result
      !> Derivative of the pressures [N/mm3], shape (mx, my); unallocated if it is stored in the state and not needed elsewhere
      real(wp), allocatable, intent(out) :: q(:, :)
      !> Relative residual [-]
      real(wp), intent(out) :: reached
      logical :: has_estimate

      if (problem%follows_approach) then
         has_estimate = allocated(state%now%rate)
         if (.not. has_estimate) allocate(state%now%rate, mold=result%pn)
         call find_rate(problem, operator, solver, has_estimate, result, state%now%rate, reached)
         if (problem%sensitivity >= sensitivity_choice%all) q = state%now%rate
      else
         allocate(q, mold=result%pn)
         call find_rate(problem, operator, solver, .false., result, q, reached)
      end if
   end subroutine normal_stiffness

   !> Derivative of the pressures, and dFn/dpen as its sum
   subroutine find_rate(problem, operator, solver, has_estimate, result, q, reached)
      type(patch_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(normal_workspace), intent(inout) :: solver
      !> Is q an estimate on entry?
      logical, intent(in) :: has_estimate
      type(patch_result), intent(inout) :: result
      !> Derivative of the pressures with respect to the approach [N/mm3], shape (mx, my)
      real(wp), contiguous, intent(inout) :: q(:, :)
      !> Relative residual [-]
      real(wp), intent(out) :: reached
      logical :: is_found
      !> Tolerance with an estimate; the error of the stiffness is of the order of its square
      real(wp), parameter :: rough = 5.0e-3_wp
      real(wp) :: tolerance

      reached = 0.0_wp
      is_found = .false.
      if (problem%follows_approach .and. .not. allocated(problem%parts)) &
         & call solver%factor%pressure_derivative(operator, result%pn, result%ncon, q, is_found)
      tolerance = problem%epsens
      if (has_estimate) tolerance = max(tolerance, rough)
      if (.not. is_found .and. solver%near_window%mx > 0) then
         call find_rate_nearby(problem, solver, tolerance, has_estimate, result, q, reached)
      else if (.not. is_found) then
         call pressure_derivative(operator, problem%parts, result%division > element%exterior, tolerance, problem%mxsens, q, &
            & reached, has_estimate)
      end if
      result%sensitivity(row_fn, to_pen) = problem%grid%dx*problem%grid%dy*sum(q)
   end subroutine find_rate

   !> The same in the window around the contact area in which the normal problem was solved
   subroutine find_rate_nearby(problem, solver, tolerance, has_estimate, result, q, reached)
      type(patch_problem), intent(in) :: problem
      type(normal_workspace), intent(inout) :: solver
      !> Of the relative residual [-]
      real(wp), intent(in) :: tolerance
      !> Is q an estimate on entry?
      logical, intent(in) :: has_estimate
      type(patch_result), intent(in) :: result
      !> Derivative of the pressures with respect to the approach [N/mm3], shape (mx, my)
      real(wp), contiguous, intent(inout) :: q(:, :)
      !> Relative residual [-]
      real(wp), intent(out) :: reached
      logical, allocatable :: contact(:, :)
      real(wp), allocatable :: part(:, :)

      associate (window => solver%near_window)
         allocate(part, source=window%part_of(q))
         allocate(contact, source=window%part_of(result%pn) > 0.0_wp)
         call pressure_derivative(solver%part%operator, problem%parts, contact, tolerance, problem%mxsens, part, reached, &
            & has_estimate)
         call window%put_back(part, q)
      end associate
   end subroutine find_rate_nearby

   !> Derivatives of the tangential forces with respect to the requested inputs
   subroutine force_changes(problem, wanted, q, workspace, result, worst)
      type(patch_problem), intent(in) :: problem
      !> Columns of the table to fill
      logical, intent(in) :: wanted(4)
      !> Derivative of the pressures with respect to the approach [N/mm3], shape (mx, my); unallocated if not known
      real(wp), allocatable, intent(in) :: q(:, :)
      type(patch_workspace), intent(inout) :: workspace
      type(patch_result), intent(inout) :: result
      !> Maximum relative residual so far [-]
      real(wp), intent(inout) :: worst
      type(bounding_box) :: box
      real(wp), allocatable :: shift(:, :, :), bound(:, :), change(:, :, :), box_q(:, :)
      real(wp) :: x0, y0, scale, moment, reached, offset
      integer :: input, ix, iy

      box = contact_box(result%division)
      offset = spin_offset_of(problem, result%tangential)*problem%dq
      x0 = problem%spin_centre(1) - offset*cos(problem%chi)
      y0 = problem%spin_centre(2) - offset*sin(problem%chi)
      scale = problem%grid%dx*problem%grid%dy/(result%mu_scal*result%fn + tiny(scale))
      associate (t => workspace%tangential, operator => workspace%box)
         allocate(shift(t%mx, t%my, 2), change(t%mx, t%my, 2), bound(t%mx, t%my))
         do input = to_pen, to_phi
            if (.not. wanted(input)) cycle
            shift = 0.0_wp
            bound = 0.0_wp
            select case (input)
            case (to_pen)
               box_q = q(box%ix0:box%ix1, box%iy0:box%iy1)
               bound = result%mu(box%ix0:box%ix1, box%iy0:box%iy1)*box_q
               where (workspace%solution%division == element%plastic) bound = 0.0_wp
               if (problem%model%coupled()) then
                  if (t%steady) then
                     call operator%steady_by_normal(box_q, shift)
                  else
                     call operator%tangential_by_normal(box_q, shift)
                  end if
               end if
            case (to_ksi)
               shift(:, :, 1) = problem%dq
            case (to_eta)
               shift(:, :, 2) = problem%dq
            case (to_phi)
               do iy = 1, t%my
                  do ix = 1, t%mx
                     shift(ix, iy, 1) = -problem%spin_weight(1)*problem%dq*(problem%grid%y(box%iy0 + iy - 1) - y0)
                     shift(ix, iy, 2) = problem%spin_weight(2)*problem%dq*(problem%grid%x(box%ix0 + ix - 1) - x0)
                  end do
               end do
            end select
            if (problem%corrects_leading_edge .and. input /= to_pen) &
               & shift = spread(workspace%share, 3, 2)*shift
            call traction_derivative(t, operator, problem%epsens, workspace%tangential_work, workspace%solution, shift, bound, &
               & change, reached)
            worst = max(worst, reached)
            result%sensitivity(row_fx, input) = scale*sum(change(:, :, 1))
            result%sensitivity(row_fy, input) = scale*sum(change(:, :, 2))
            moment = 0.0_wp
            do iy = 1, t%my
               do ix = 1, t%mx
                  moment = moment + problem%grid%x(box%ix0 + ix - 1)*change(ix, iy, 2) &
                     & - problem%grid%y(box%iy0 + iy - 1)*change(ix, iy, 1)
               end do
            end do
            result%sensitivity(row_mz, input) = problem%grid%dx*problem%grid%dy*moment
         end do
      end associate
      if (.not. wanted(to_pen)) return
      ! forces relative to the normal force, which changes with the approach
      result%sensitivity([row_fx, row_fy], to_pen) = result%sensitivity([row_fx, row_fy], to_pen) &
         & - [result%fx_rel, result%fy_rel]*result%sensitivity(row_fn, to_pen)/result%fn
   end subroutine force_changes
end module contact_patch_sensitivities
