!> Estimate of tractions for steady rolling with an elastic layer between the bodies, by marching along rows
!>
!> With a layer of flexibility L the slip of a step has L (p_i - p_(i+1)): a soft layer makes tractions depend on those ahead, one
!> after the other. Newton's method moves the border of adhesion towards the trailing edge by one element per step only, because an
!> element sticks by the tractions ahead of it, which stick no sooner. A march from the leading edge, with the displacements of the
!> bodies from the last estimate, finds the border at once.
module contact_tangential_layer_start
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_tangential_problem, only : slip_of, tangential_problem, tangential_solution, true_residual
   implicit none (type, external)
   private

   public :: march_along_rows

   !> Maximum number of marches; the last one is that which reduces the residual by less than this factor; chosen
   integer, parameter :: max_marches = 20
   real(wp), parameter :: worth_it = 0.7_wp

contains

   !> Improve an estimate as long as marches reduce the residual; does nothing without a layer
   subroutine march_along_rows(problem, operator, r, trial, trial_slip, solution, residual)
      !> Steady rolling: rigid slip, bounds, terms of the leading edge
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> Scale of the slip in the residual, see residual_scale [(N/mm2)/mm]
      real(wp), intent(in) :: r
      !> Workspace for tractions and slip, shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: trial(:, :, :), trial_slip(:, :, :)
      !> Tractions and slip, improved
      type(tangential_solution), intent(inout) :: solution
      !> Their residual [-]
      real(wp), intent(inout) :: residual
      real(wp) :: after, gain
      integer :: march

      if (.not. problem%steady .or. .not. operator%model%layer > 0.0_wp .or. problem%hardens()) return
      gain = 0.0_wp
      do march = 1, max_marches
         if (gain > worth_it) return
         call march_once(problem, operator%model%layer, operator%diagonal(2), solution, trial)
         call slip_of(problem, operator, trial, solution%creep, trial_slip)
         after = true_residual(problem, trial, trial_slip, r)
         if (.not. after < residual) return
         solution%p = trial
         solution%slip = trial_slip
         gain = after/residual
         residual = after
      end do
   end subroutine march_along_rows

   !> Tractions that stop the slip, or against it on their bounds, one element after the other from the leading edge on
   pure subroutine march_once(problem, layer, diagonal, solution, p)
      type(tangential_problem), intent(in) :: problem
      !> Displacement per unit traction of the layer, and of an element with the layer [mm/(N/mm2)]
      real(wp), intent(in) :: layer, diagonal
      !> Tractions and slip of the last estimate
      type(tangential_solution), intent(in) :: solution
      !> New tractions [N/mm2], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: p(:, :, :)
      real(wp) :: change(2), new(2), length
      integer :: ix, iy, first, last

      first = merge(problem%mx, 1, problem%direction > 0)
      last = problem%mx + 1 - first
      p = 0.0_wp
      do iy = 1, problem%my
         change = 0.0_wp
         do ix = first, last, -problem%direction
            if (.not. problem%contact(ix, iy)) then
               change = 0.0_wp
               cycle
            end if
            new = (solution%slip(ix, iy, :) - layer*change)/diagonal
            if (allocated(problem%second)) new = new*problem%second%weight(ix, iy)
            new = solution%p(ix, iy, :) - new
            length = hypot(new(1), new(2))
            if (length > problem%bound(ix, iy)) new = new*(problem%bound(ix, iy)/length)
            change = new - solution%p(ix, iy, :)
            p(ix, iy, :) = new
         end do
      end do
   end subroutine march_once
end module contact_tangential_layer_start
