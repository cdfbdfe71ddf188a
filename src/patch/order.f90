!> The order of discretisation that a patch is solved with, and what that needs
!>
!> The second order is for rolling, steady or in steps of one element along x, with the default solver, where pressures are a
!> solution on half-spaces, or semi-ellipses by formula: they tell where the edge of contact lies. Elsewhere
!> the established scheme acts, and the report says why.
module contact_patch_order
   use contact_base_choices, only : is_classical, kernel_model, motion, pressure_model
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : reason_length, solve_report
   use contact_grid_element_division, only : bounding_box
   use contact_patch_problem, only : patch_problem, patch_state
   use contact_patch_workspace, only : patch_workspace
   use contact_tangential_second_order, only : find_edge_terms
   implicit none (type, external)
   private

   public :: choose_order, lower_order, spin_offset_of, set_second_order

   !> Rigid slip of the second order is that in the middle of the step [steps]
   real(wp), parameter :: middle = 0.5_wp
   !> Steps that differ by less than this part of an element are one element long: the edge is off by that part of it; chosen
   real(wp), parameter :: step_slack = 0.01_wp
   !> Passes between pressures and tractions after which the turns of slip stay what they are; the next passes converge to a
   !> solution of one set of equations. Chosen: their change is below 1e-3 of the friction bound by then
   integer, parameter :: turning_passes = 3

contains

   !> Order of the tangential problem, with the reason where it is not the one that was asked for
   pure subroutine choose_order(problem, report)
      !> Order that is asked for, and all that decides
      type(patch_problem), intent(in) :: problem
      !> Gets order and reason; nothing where the first order was asked for, or motion has none
      type(solve_report), intent(inout) :: report

      if (problem%settings%order < 2 .or. problem%motion == motion%none) return
      report%order_reason = obstacle(problem)
      report%order = merge(2, 1, report%order_reason == "")
   end subroutine choose_order

   !> What stands in the way of the second order, blank for nothing
   pure function obstacle(problem) result(reason)
      type(patch_problem), intent(in) :: problem
      character(len=reason_length) :: reason

      reason = ""
      if (problem%motion == motion%shift) then
         reason = "order 2 is for rolling"
      else if (problem%motion == motion%transient_rolling .and. .not. is_one_element(problem)) then
         reason = "order 2 has steps of one element along x"
      else if (allocated(problem%simplified)) then
         reason = "simplified theory"
      else if (problem%general_step .or. (problem%classical .and. is_classical(problem%solver))) then
         reason = "order 2 is for the default solver"
      else if (.not. problem%solves_for_pressure() .and. .not. is_root(problem)) then
         reason = "pressures by formula"
      else if (problem%model%sheet > 0.0_wp) then
         reason = "elastic sheet"
      else if (problem%remembers_yield) then
         reason = "plastic layer"
      else if (problem%model%layer > 0.0_wp) then
         reason = "elastic layer"
      else if (problem%model%kernel == kernel_model%bilinear) then
         reason = "bilinear tractions"
      else if (.not. problem%model%is_flat()) then
         reason = "coefficients of curved or tabulated surfaces"
      end if
   end function obstacle

   !> Are pressures semi-ellipses in each row by formula?
   pure logical function is_root(problem)
      type(patch_problem), intent(in) :: problem

      is_root = allocated(problem%given_pressure) &
         & .and. any(problem%pressure == [pressure_model%elliptical, pressure_model%sdec])
   end function is_root

   !> Does a step of transient rolling take particles from element to element?
   pure logical function is_one_element(problem)
      type(patch_problem), intent(in) :: problem

      is_one_element = abs(problem%dq - problem%grid%dx) <= step_slack*problem%grid%dx &
         & .and. abs(sin(problem%chi)) <= step_slack
   end function is_one_element

   !> Fall back to the first order
   pure subroutine lower_order(reason, report)
      !> Why
      character(len=*), intent(in) :: reason
      !> Gets order and reason
      type(solve_report), intent(inout) :: report

      report%order = 1
      report%order_reason = reason
   end subroutine lower_order

   !> How far ahead of the elements the rigid slip is taken [steps]
   pure real(wp) function spin_offset_of(problem, report) result(offset)
      !> Offset of the first order
      type(patch_problem), intent(in) :: problem
      !> Order that acts
      type(solve_report), intent(in) :: report

      offset = problem%spin_offset
      if (report%order == 2) offset = middle
   end function spin_offset_of

   !> Edge terms of the tangential problem, from the pressures
   subroutine set_second_order(problem, state, box, pass, report, workspace)
      !> Elasticity
      type(patch_problem), intent(in) :: problem
      !> Pressures of the present step
      type(patch_state), intent(in) :: state
      !> Part of the grid of the tangential problem
      type(bounding_box), intent(in) :: box
      !> Number of the pass between pressures and tractions
      integer, intent(in) :: pass
      !> Order that acts
      type(solve_report), intent(in) :: report
      !> Compliance of the box; its tangential problem gets the terms, or loses them
      type(patch_workspace), intent(inout) :: workspace

      associate (t => workspace%tangential)
         if (report%order /= 2) then
            if (allocated(t%second)) deallocate(t%second)
            return
         end if
         if (.not. allocated(t%second)) allocate(t%second)
         workspace%box_pn = state%now%pn(box%ix0:box%ix1, box%iy0:box%iy1)
         call find_edge_terms(t%contact, workspace%box_pn, is_root(problem), t%dx, t%dy, t%direction, problem%model%material%nu, &
            & problem%model%material%gg, workspace%box%diagonal(2), t%second, pass > turning_passes)
      end associate
   end subroutine set_second_order
end module contact_patch_order
