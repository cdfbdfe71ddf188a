!> The normal problem of a patch: pressures, contact area, approach or normal force
module contact_patch_normal_step
   use contact_base_choices, only : motion, pressure_model
   use contact_base_constants, only : excluded_threshold
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending
   use contact_elastic_pressure_sums, only : pressure_sums
   use contact_grid_element_division, only : element
   use contact_grid_picture, only : trace_picture
   use contact_normal_active_sets, only : solve_by_active_sets
   use contact_normal_approximate, only : approximate_pressure
   use contact_normal_conjugate_gradient, only : solve_normal
   use contact_normal_problem, only : force_round_off
   use contact_numeric_pieces, only : copy_field, copy_long
   use contact_patch_field_loops, only : mark_elements, subtract_approach
   use contact_patch_problem, only : patch_problem, patch_state
   use contact_patch_relative_tractions, only : divide_by_pressures, multiply_by_pressures
   use contact_patch_result, only : patch_result
   use contact_patch_workspace, only : patch_workspace, prepare_window
   implicit none (type, external)
   private

   public :: normal_step, shear_lift

contains

   !> Solve for pressures, approach or normal force, and the contact area
   subroutine normal_step(problem, state, workspace, log, result)
      !> Undeformed distance, prescribed force or approach, method
      type(patch_problem), intent(in) :: problem
      !> Estimate of pressures and approach on entry; solution with element states on exit
      type(patch_state), intent(inout) :: state
      !> Compliance on the grid, and work space
      type(patch_workspace), intent(inout) :: workspace
      !> Receives the trace of the solver, and warnings of approximate methods
      type(log_type), intent(inout) :: log
      !> The report of the normal problem and the contact area are set
      type(patch_result), intent(inout) :: result
      logical :: first, scales
      character(len=80) :: line

      first = result%outer_iterations == 1
      scales = .false.
      if (allocated(problem%given_pressure)) then
         state%now%pn = problem%given_pressure
         where (problem%h > excluded_threshold) state%now%pn = 0.0_wp
         result%normal%ended = ending%not_started
      else
         if (first) then
            if (allocated(problem%pressure_estimate)) state%now%pn = problem%pressure_estimate
            ! simplified theory does not start from tractions
            scales = problem%follows_approach .and. .not. (problem%couples() .or. allocated(problem%simplified))
            if (problem%follows_approach) call follow_approach(problem, scales, state)
         end if
         if (problem%pressure == pressure_model%full .or. problem%couples() &
            & .or. .not. suits_sums(problem)) then
            call prepare_window(problem, workspace)
         end if
         associate (normal => workspace%normal)
            normal%mx = problem%grid%mx
            normal%my = problem%grid%my
            normal%dx = problem%grid%dx
            normal%dy = problem%grid%dy
            call copy_field(problem%h, normal%h)
            if (allocated(normal%parts)) deallocate(normal%parts)
            if (allocated(problem%parts)) allocate(normal%parts, source=problem%parts)
            if (problem%couples()) then
               if (first) then
                  call shear_lift(problem, state, workspace)
                  workspace%un = workspace%lift
               end if
               where (normal%h < excluded_threshold) normal%h = normal%h + workspace%un
            end if
            normal%force_prescribed = problem%force_prescribed
            normal%fn = problem%fn
            normal%eps = problem%settings%eps*problem%pressure_eps*workspace%sharper
            normal%maxgs = problem%settings%maxgs
            normal%follows = problem%follows_approach
            normal%deadline = problem%deadline
            if (problem%pressure == pressure_model%full) then
               call log%trace(4, " NORM")
               call solve_normal(normal, workspace%window, workspace%normal_work, state%now%pn, result%pen, result%normal, log)
               ! the requested tolerance is EPS
               result%normal%tolerance = problem%settings%eps
               if (result%normal%residual <= problem%settings%eps .and. any(result%normal%ended == [ending%stagnated, &
                  & ending%iteration_limit])) result%normal%ended = ending%converged
               ! conjugate gradients require symmetry, which viscoelastic bodies do not have
               if (result%normal%ended == ending%stagnated .and. allocated(problem%model%memory)) &
                  & call solve_by_active_sets(normal, workspace%window, state%now%pn, result%pen, result%normal)
            else
               call subtract_approach(size(normal%h), problem%pen, excluded_threshold, normal%h)
               associate (material => problem%model%material)
                  call prepare_sums(problem, workspace)
                  call approximate_pressure(problem%pressure, problem%grid, normal%h, material%gg/(1.0_wp - material%nu), &
                     & normal%parts, workspace%window, workspace%sums, state%now%pn, result%normal, log)
               end associate
            end if
         end associate
      end if
      call mark_contact(state, scales, result%ncon)
      if (problem%solves_for_pressure()) then
         result%normal%passes = result%normal%passes + 1
         if (log%shows(3)) then
            write(line, "(A,2I7,A,I6)") "      Norm: final element division: C, E=", result%ncon, &
               & problem%grid%npot() - result%ncon, "  ItCG=", result%normal%iterations
            call log%trace(3, trim(line))
         end if
         call trace_picture(log, state%now%division)
      end if
      ! the total force is that of the pressures; a prescribed force that agrees to round-off is kept exactly
      result%fn = problem%grid%dx*problem%grid%dy*sum(state%now%pn)
      if (problem%force_prescribed .and. abs(result%fn - problem%fn) <= force_round_off*problem%fn) result%fn = problem%fn
      if (problem%motion == motion%none) call all_adhere(state%now%division)
   end subroutine normal_step

   !> Without motion all elements in contact are in adhesion
   pure subroutine all_adhere(division)
      integer, intent(inout) :: division(:, :)
      integer :: ix, iy

      do iy = 1, size(division, 2)
         do ix = 1, size(division, 1)
            division(ix, iy) = merge(element%adhesion, element%exterior, division(ix, iy) > element%exterior)
         end do
      end do
   end subroutine all_adhere

   !> Can the displacements for approximate pressures be computed by direct sums?
   pure logical function suits_sums(problem)
      type(patch_problem), intent(in) :: problem
      type(pressure_sums) :: sums

      suits_sums = sums%suits(problem%model)
   end function suits_sums

   !> Prepare the coefficients of direct sums, if these are possible
   subroutine prepare_sums(problem, workspace)
      type(patch_problem), intent(in) :: problem
      type(patch_workspace), intent(inout) :: workspace

      if (.not. suits_sums(problem)) then
         if (allocated(workspace%sums)) deallocate(workspace%sums)
         return
      end if
      if (.not. allocated(workspace%sums)) allocate(workspace%sums)
      if (problem%pressure == pressure_model%kpec .or. allocated(problem%parts)) call workspace%sums%prepare(problem%model, &
         & problem%grid%dx, problem%grid%dy, problem%grid%mx, problem%grid%my)
   end subroutine prepare_sums

   !> Set element states by the pressures; tractions of exterior elements are set to zero
   subroutine mark_contact(state, scales, ncon)
      !> Pressures on entry; element states are set
      type(patch_state), intent(inout) :: state
      !> Are the tangential tractions relative to the pressures?
      logical, intent(in) :: scales
      !> Number of elements in contact
      integer, intent(out) :: ncon

      associate (now => state%now)
         if (scales) call multiply_by_pressures(now%pn, now%px, now%py)
         ncon = mark_elements(size(now%pn), element%exterior, element%adhesion, now%pn, now%px, now%py, now%division)
      end associate
   end subroutine mark_contact

   !> Estimates for the present approach: pressures by their derivative in the last solution, tractions relative to the pressures
   pure subroutine follow_approach(problem, scales, state)
      !> Its approach is the present one
      type(patch_problem), intent(in) :: problem
      !> Are tractions divided by the pressures?
      logical, intent(in) :: scales
      !> Pressures, approach and derivative of the last solution on entry; estimates on exit
      type(patch_state), intent(inout) :: state
      !> Maximum change relative to the approach, over which pressures are nearly linear [-]
      real(wp), parameter :: largest_change = 0.3_wp
      real(wp) :: change
      integer :: ix, iy

      if (scales) call divide_by_pressures(state%now%pn, state%now%px, state%now%py)
      change = problem%pen - state%now%pen
      if (.not. allocated(state%now%rate) .or. problem%force_prescribed) return
      if (.not. abs(change) < largest_change*problem%pen) return
      do iy = 1, size(state%now%pn, 2)
         do ix = 1, size(state%now%pn, 1)
            if (state%now%pn(ix, iy) > 0.0_wp) &
               & state%now%pn(ix, iy) = max(0.0_wp, state%now%pn(ix, iy) + change*state%now%rate(ix, iy))
         end do
      end do
   end subroutine follow_approach

   !> Normal displacements by the present tangential tractions
   subroutine shear_lift(problem, state, workspace)
      !> Elasticity and grid
      type(patch_problem), intent(in) :: problem
      !> Present tangential tractions
      type(patch_state), intent(in) :: state
      !> `lift` is set: displacements [mm], positive where the surfaces move apart
      type(patch_workspace), intent(inout) :: workspace

      call prepare_window(problem, workspace)
      call copy_long(size(state%now%px), state%now%px, workspace%pt(:, :, 1))
      call copy_long(size(state%now%py), state%now%py, workspace%pt(:, :, 2))
      call workspace%window%normal_by_tangential(workspace%pt, workspace%lift)
   end subroutine shear_lift
end module contact_patch_normal_step
