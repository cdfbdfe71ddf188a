!> Order of the discretisation of a patch, and the data of the second order
!>
!> The second order is available for rolling, steady or in steps of one element along x, with the default solver, if pressures are
!> a solution for half-spaces, or semi-ellipses by formula: the edge of contact is computed from them. Otherwise the established
!> scheme is used, with the reason in the report.
module contact_patch_order
   use contact_base_choices, only : is_classical, kernel_model, motion, pressure_model
   use contact_base_constants, only : excluded_threshold
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : reason_length, solve_report
   use contact_elastic_material, only : combined_material
   use contact_grid_element_division, only : bounding_box
   use contact_normal_parts, only : displacement_between
   use contact_patch_problem, only : patch_problem, patch_state
   use contact_patch_workspace, only : patch_workspace, prepare_window
   use contact_tangential_problem, only : tangential_problem
   use contact_tangential_second_order, only : bodies_end, find_edge_terms, second_order, unknown_gap
   implicit none (type, external)
   private

   public :: choose_order, edge_slip, lower_order, order_of_errors, spin_offset_of, set_second_order

   !> The second order uses the rigid slip in the middle of the step [steps]
   real(wp), parameter :: middle = 0.5_wp
   !> Steps that differ from one element by less than this fraction are regarded as one element; the error of the edge position is
   !> the same fraction of an element; chosen
   real(wp), parameter :: step_slack = 0.01_wp
   !> Largest change of pressures in central differences of edge terms, and the smallest one, which round-off requires, as fractions
   !> of the largest pressure; largest change as a fraction of a pressure at the edge, as terms are quotients by it; chosen
   real(wp), parameter :: pressure_step = 1.0e-6_wp, min_step = 1.0e-10_wp, edge_step = 1.0e-3_wp

contains

   !> Choose the order of the tangential problem, with the reason if it is not the requested one
   pure subroutine choose_order(problem, report)
      !> Requested order, and the data that determine whether it is available
      type(patch_problem), intent(in) :: problem
      !> Receives order and reason; unchanged if the first order was requested, or without motion
      type(solve_report), intent(inout) :: report

      if (problem%settings%order < 2 .or. problem%motion == motion%none) return
      report%order_reason = obstacle(problem)
      report%order = merge(2, 1, report%order_reason == "")
   end subroutine choose_order

   !> Reason why the second order is not available; blank if it is
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
      else if (.not. problem%solves_for_pressure() .and. .not. has_semi_ellipses(problem)) then
         reason = "pressures by formula"
      else if (problem%model%sheet > 0.0_wp) then
         reason = "elastic sheet"
      else if (problem%remembers_yield) then
         reason = "plastic layer"
      else if (problem%model%kernel == kernel_model%bilinear) then
         reason = "bilinear tractions"
      else if (.not. problem%model%is_flat()) then
         reason = "coefficients of curved or tabulated surfaces"
      end if
   end function obstacle

   !> Are pressures semi-ellipses in each row by formula?
   pure logical function has_semi_ellipses(problem)
      type(patch_problem), intent(in) :: problem

      has_semi_ellipses = allocated(problem%given_pressure) &
         & .and. any(problem%pressure == [pressure_model%elliptical, pressure_model%sdec])
   end function has_semi_ellipses

   !> Does a step of transient rolling move particles by one element along x?
   pure logical function is_one_element(problem)
      type(patch_problem), intent(in) :: problem

      is_one_element = abs(problem%dq - problem%grid%dx) <= step_slack*problem%grid%dx &
         & .and. abs(sin(problem%chi)) <= step_slack
   end function is_one_element

   !> Fall back to the first order
   pure subroutine lower_order(reason, report)
      !> Why the second order is not used
      character(len=*), intent(in) :: reason
      !> Receives order and reason
      type(solve_report), intent(inout) :: report

      report%order = 1
      report%order_reason = reason
   end subroutine lower_order

   !> Order of the discretisation errors: 2 only if all terms of the second order are included
   pure integer function order_of_errors(report) result(order)
      !> Order that was used, with a reason if it is not the requested one or if terms are omitted
      type(solve_report), intent(in) :: report

      order = merge(2, 1, report%order == 2 .and. report%order_reason == "")
   end function order_of_errors

   !> Offset in rolling direction at which the rigid slip is evaluated [steps]
   pure real(wp) function spin_offset_of(problem, report) result(offset)
      !> Offset of the first order
      type(patch_problem), intent(in) :: problem
      !> Order in use
      type(solve_report), intent(in) :: report

      offset = problem%spin_offset
      if (report%order == 2) offset = middle
   end function spin_offset_of

   !> Compute the edge terms of the tangential problem from the pressures
   subroutine set_second_order(problem, state, box, report, workspace)
      !> Elasticity
      type(patch_problem), intent(in) :: problem
      !> Pressures of the present step
      type(patch_state), intent(in) :: state
      !> Part of the grid of the tangential problem
      type(bounding_box), intent(in) :: box
      !> Order in use
      type(solve_report), intent(in) :: report
      !> Compliance of the box; the terms of its tangential problem are set, or deallocated for the first order
      type(patch_workspace), intent(inout) :: workspace
      real(wp), allocatable :: gap(:, :)
      type(combined_material) :: material

      associate (t => workspace%tangential)
         if (report%order /= 2) then
            if (allocated(t%second)) deallocate(t%second)
            return
         end if
         if (.not. allocated(t%second)) allocate(t%second)
         workspace%box_pn = state%now%pn(box%ix0:box%ix1, box%iy0:box%iy1)
         allocate(gap(t%mx, t%my), source=unknown_gap)
         if (.not. has_semi_ellipses(problem)) call find_gaps(problem, state%now%pn, box, t%direction, workspace, gap)
         material = problem%model%material_after(t%dx)
         call find_edge_terms(t%contact, workspace%box_pn, gap, has_semi_ellipses(problem), t%dx, t%dy, t%direction, &
            & material%nu, material%gg, workspace%box%diagonal(2), problem%model%layer, t%second)
      end associate
   end subroutine set_second_order

   !> Compute the deformed distance in the elements ahead of the leading ones from the pressures
   subroutine find_gaps(problem, pn, box, direction, workspace, gap)
      type(patch_problem), intent(in) :: problem
      !> [N/mm2], shape of the grid
      real(wp), contiguous, intent(in) :: pn(:, :)
      type(bounding_box), intent(in) :: box
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> Compliance of the window, and the undeformed distance
      type(patch_workspace), intent(inout) :: workspace
      !> [mm], shape of the box; unchanged where it is unknown
      real(wp), intent(inout) :: gap(:, :)
      real(wp), allocatable :: un(:, :)
      integer :: ix, iy, jx

      call prepare_window(problem, workspace)
      allocate(un, mold=pn)
      associate (normal => workspace%normal)
         call displacement_between(problem%parts, workspace%window, pn, un)
         do iy = box%iy0, box%iy1
            do ix = box%ix0, box%ix1
               jx = ix + direction
               if (.not. pn(ix, iy) > 0.0_wp) cycle
               if (jx < 1 .or. jx > problem%grid%mx) then
                  gap(ix - box%ix0 + 1, iy - box%iy0 + 1) = bodies_end
                  cycle
               end if
               if (normal%h(jx, iy) > excluded_threshold) gap(ix - box%ix0 + 1, iy - box%iy0 + 1) = bodies_end
               if (pn(jx, iy) > 0.0_wp .or. normal%h(jx, iy) > excluded_threshold) cycle
               if (allocated(problem%parts)) then
                  ! displacements are those of a part
                  if (problem%parts%label(jx, iy) == 0) cycle
               end if
               ! minus the distance that remains in the leading element, an error of the solution
               gap(ix - box%ix0 + 1, iy - box%iy0 + 1) = max(0.0_wp, normal%h(jx, iy) - normal%h(ix, iy) + un(jx, iy) - un(ix, iy))
            end do
         end do
      end associate
   end subroutine find_gaps

   !> Derivatives of the slip of elements near the edge, and of the angles by which it is turned, due to the change of edge terms
   !> and of the parts of neighbours with the pressures
   subroutine edge_slip(problem, tangential, diagonal, p, at, pressure, change, gap_change, slip, angle)
      !> Elasticity
      type(patch_problem), intent(in) :: problem
      !> Tangential problem with edge terms at the current pressures
      type(tangential_problem), intent(in) :: tangential
      !> Compliance of an element A_xx(0) [mm/(N/mm2)]
      real(wp), intent(in) :: diagonal
      !> Tractions [N/mm2], shape (mx, my, 2)
      real(wp), intent(in) :: p(:, :, :)
      !> Slip per step [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: at(:, :, :)
      !> Pressures [N/mm2] and their derivatives with respect to some input, shape (mx, my)
      real(wp), intent(in) :: pressure(:, :), change(:, :)
      !> Derivatives of the distances in the elements ahead [mm per unit], zero where these are unknown, shape (mx, my)
      real(wp), intent(in) :: gap_change(:, :)
      !> [mm per unit of the input], shape (mx, my, 2)
      real(wp), intent(out) :: slip(:, :, :)
      !> [rad per unit of the input], shape (mx, my)
      real(wp), intent(out) :: angle(:, :)
      type(second_order) :: terms(2)
      type(combined_material) :: material
      real(wp) :: step, side, c(3), turn(2, 2)
      integer :: ix, iy, k

      slip = 0.0_wp
      angle = 0.0_wp
      if (.not. any(abs(change) > 0.0_wp)) return
      step = step_of(pressure, change, tangential%second)
      material = problem%model%material_after(tangential%dx)
      do k = 1, 2
         side = real(2*k - 3, wp)*step
         call find_edge_terms(tangential%contact, pressure + side*change, tangential%second%gap + side*gap_change, &
            & has_semi_ellipses(problem), tangential%dx, tangential%dy, tangential%direction, material%nu, material%gg, diagonal, &
            & problem%model%layer, terms(k))
      end do
      do k = 1, size(terms(1)%at, 2)
         associate (ix => terms(1)%at(1, k), iy => terms(1)%at(2, k))
            c = (terms(2)%kappa(:, k) - terms(1)%kappa(:, k))/(2.0_wp*step)
            slip(ix, iy, 1) = c(1)*p(ix, iy, 1) + c(3)*p(ix, iy, 2)
            slip(ix, iy, 2) = c(3)*p(ix, iy, 1) + c(2)*p(ix, iy, 2)
         end associate
      end do
      do iy = 1, tangential%my
         do ix = 1, tangential%mx
            if (.not. any(abs(terms(2)%part(:, ix, iy) - terms(1)%part(:, ix, iy)) > 0.0_wp)) cycle
            do k = 1, 2
               turn(:, k) = terms(k)%turn_of(tangential%mx, tangential%my, tangential%direction, at, ix, iy)
            end do
            angle(ix, iy) = (turn(1, 1)*turn(2, 2) - turn(2, 1)*turn(1, 2))/(2.0_wp*step)
         end do
      end do
   end subroutine edge_slip

   !> Step of the input for central differences of edge terms [unit]
   pure real(wp) function step_of(pressure, change, second) result(step)
      !> Pressures [N/mm2] and their derivatives, not all zero, shape (mx, my)
      real(wp), intent(in) :: pressure(:, :), change(:, :)
      !> Edge terms: the elements whose pressures they depend on
      type(second_order), intent(in) :: second
      real(wp) :: largest, p, d
      integer :: k

      largest = maxval(pressure)/maxval(abs(change))
      step = pressure_step*largest
      do k = 1, size(second%at, 2)
         p = pressure(second%at(1, k), second%at(2, k))
         d = abs(change(second%at(1, k), second%at(2, k)))
         if (step*d > edge_step*p) step = edge_step*p/d
      end do
      step = max(step, min_step*largest)
   end function step_of
end module contact_patch_order
