!> Linear extrapolation of a solved patch to a slightly different approach
module contact_patch_small_step
   use contact_base_choices, only : motion
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_grid_element_division, only : bounding_box, contact_box, element
   use contact_numeric_vectors, only : copy_numbers
   use contact_patch_derived, only : derive
   use contact_patch_problem, only : patch_problem, patch_state
   use contact_patch_result, only : patch_result
   use contact_patch_simplified_step, only : simplified_step
   use contact_patch_tangential_step, only : tangential_step
   use contact_patch_workspace, only : patch_workspace
   implicit none (type, external)
   private

   public :: can_step, small_step, step_with_tractions

contains

   !> Is the derivative known, and sufficient?
   !>
   !> Not with heat, yield limits, friction that depends on slip, or pressures that depend on tractions.
   pure logical function can_step(problem, state)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem
      !> Its solution
      type(patch_state), intent(in) :: state

      can_step = (allocated(state%now%rate) .or. .not. problem%solves_for_pressure()) .and. .not. (problem%force_prescribed &
         & .or. problem%couples() .or. allocated(problem%friction) .or. allocated(problem%thermal) .or. problem%remembers_yield &
         & .or. allocated(problem%damping) .or. problem%n_forces > 0)
   end function can_step

   !> Pressures, tractions and forces at another approach
   !>
   !> Pressures change by their derivative, approximate ones in proportion to the force of Hertz's theory, and tangential tractions
   !> in proportion to the pressures: exact in the slip area; in the adhesion area the error is a fraction of a change that is
   !> within the tolerance. `complete` determines the largest pressure.
   pure subroutine small_step(problem, change, state, result)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem
      !> Change of the approach [mm]
      real(wp), intent(in) :: change
      !> Solution; updated
      type(patch_state), intent(inout) :: state
      !> Result of the solution; updated
      type(patch_result), intent(inout) :: result
      type(bounding_box) :: box
      real(wp) :: ratio, area, force(3)
      logical :: is_hertzian
      integer :: ix, iy

      area = problem%grid%dx*problem%grid%dy
      is_hertzian = .not. problem%solves_for_pressure()
      ratio = 1.0_wp
      if (is_hertzian .and. result%pen > 0.0_wp) ratio = max(0.0_wp, 1.0_wp + 1.5_wp*change/result%pen)
      result%mx = 0.0_wp
      result%my = 0.0_wp
      result%mz = 0.0_wp
      ! tractions are zero outside the contact
      force = 0.0_wp
      box = contact_box(result%division)
      do iy = box%iy0, box%iy1
         do ix = box%ix0, box%ix1
            if (.not. (result%pn(ix, iy) > 0.0_wp .and. result%division(ix, iy) > element%exterior)) cycle
            if (.not. is_hertzian) ratio = max(0.0_wp, 1.0_wp + change*state%now%rate(ix, iy)/result%pn(ix, iy))
            if (.not. ratio > 0.0_wp) then
               ! the element leaves: an element without pressure is no part of the contact, nor the end of a row
               result%division(ix, iy) = element%exterior
               state%now%division(ix, iy) = element%exterior
            end if
            result%pn(ix, iy) = ratio*result%pn(ix, iy)
            result%px(ix, iy) = ratio*result%px(ix, iy)
            result%py(ix, iy) = ratio*result%py(ix, iy)
            force = force + [result%pn(ix, iy), result%px(ix, iy), result%py(ix, iy)]
            result%mx = result%mx + area*result%pn(ix, iy)*problem%grid%y(iy)
            result%my = result%my - area*result%pn(ix, iy)*problem%grid%x(ix)
            result%mz = result%mz + area*(result%py(ix, iy)*problem%grid%x(ix) - result%px(ix, iy)*problem%grid%y(iy))
         end do
      end do
      result%pen = result%pen + change
      result%fn = area*force(1)
      result%fx = area*force(2)
      result%fy = area*force(3)
      call copy_numbers(size(result%pn), result%pn, state%now%pn)
      call copy_numbers(size(result%px), result%px, state%now%px)
      call copy_numbers(size(result%py), result%py, state%now%py)
      state%now%pen = result%pen
      state%now%force = [result%fn, result%fx, result%fy]
   end subroutine small_step

   !> The same for a change that exceeds the tolerance: tractions and derived quantities are solved anew
   subroutine step_with_tractions(problem, change, state, workspace, log, result)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem
      !> Change of the approach [mm]
      real(wp), intent(in) :: change
      !> Solution; updated
      type(patch_state), intent(inout) :: state
      !> Work space of the solution
      type(patch_workspace), intent(inout) :: workspace
      !> Receives the trace of the solvers, and warnings
      type(log_type), intent(inout) :: log
      !> Result of the solution with totals and reports; updated
      type(patch_result), intent(inout) :: result

      call small_step(problem, change, state, result)
      if (problem%motion == motion%none) return
      if (allocated(problem%simplified)) then
         call simplified_step(problem, state, workspace, log, result)
      else
         call tangential_step(problem, state, workspace, log, result)
      end if
      call derive(problem, state, workspace, result)
      state%now%force = [result%fn, result%fx, result%fy]
   end subroutine step_with_tractions
end module contact_patch_small_step
