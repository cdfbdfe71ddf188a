!> Relative motion of the bodies in a patch, and positions of the particles one time step before
module contact_patch_kinematics
   use contact_base_choices, only : motion
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_numeric_pieces, only : clear_long, copy_long
   use contact_patch_order, only : spin_offset_of
   use contact_patch_problem, only : patch_problem, patch_state, rolling_direction, traction_fields
   use contact_patch_result, only : patch_result
   use contact_patch_workspace, only : patch_workspace, prepare_window
   implicit none (type, external)
   private

   public :: rigid_slip, previous_displacement, shift_by_slip

   !> Components of a step relative to its length below this value are round-off of sine and cosine
   real(wp), parameter :: no_shift = 1.0e-10_wp

contains

   !> Rigid slip per step without unknown creepages [mm], Kalker (1990)
   !>
   !> An offset of a sixth of the step compensates part of the error of the first order; the second order uses the middle of the
   !> step.
   pure subroutine rigid_slip(problem, result, spin_weight)
      !> Creepages, spin with its centre, extra slip, distance per step
      type(patch_problem), intent(in) :: problem
      !> The rigid slip `wx`, `wy` per step is set [mm]; in simplified theory its centre of the contact is used
      type(patch_result), intent(inout) :: result
      !> Weights of the spin about the centre of the contact, in x and y, for simplified theory [-]; default 1
      real(wp), intent(in), optional :: spin_weight(2)
      real(wp) :: x0, y0, cx, cy, spin(2), offset
      integer :: ix, iy

      offset = spin_offset_of(problem, result%tangential)*problem%dq
      x0 = problem%spin_centre(1) - offset*cos(problem%chi)
      y0 = problem%spin_centre(2) - offset*sin(problem%chi)
      cx = merge(problem%creep(1), 0.0_wp, problem%n_forces < 1)
      cy = merge(problem%creep(2), 0.0_wp, problem%n_forces < 2)
      spin = problem%spin_weight*problem%spin
      if (present(spin_weight)) then
         cx = cx - spin(1)*(result%centre(2) - problem%spin_centre(2))
         cy = cy + spin(2)*(result%centre(1) - problem%spin_centre(1))
         x0 = result%centre(1) - offset*cos(problem%chi)
         y0 = result%centre(2) - offset*sin(problem%chi)
         ! the extra slip has this spin with weights of 1
         spin = spin_weight*spin + (spin_weight - 1.0_wp)*result%added_spin
      end if
      do ix = 1, problem%grid%mx
         result%wy(ix, 1) = problem%dq*(cy + spin(2)*(problem%grid%x(ix) - x0))
      end do
      do iy = 1, problem%grid%my
         result%wx(:, iy) = problem%dq*(cx - spin(1)*(problem%grid%y(iy) - y0))
         if (iy > 1) result%wy(:, iy) = result%wy(:, 1)
      end do
      if (.not. allocated(problem%extra_slip)) return
      result%wx = result%wx + shift_by_slip(problem, result%tangential%order, problem%extra_slip(:, :, 1))
      result%wy = result%wy + shift_by_slip(problem, result%tangential%order, problem%extra_slip(:, :, 2))
   end subroutine rigid_slip

   !> Rigid slip per step of an extra slip [mm], by the second order in the middle of the step; shape (mx, my)
   pure function shift_by_slip(problem, order, slip) result(shift)
      !> With the distance per step and the rolling direction
      type(patch_problem), intent(in) :: problem
      !> Order of the discretisation
      integer, intent(in) :: order
      !> One component of the slip relative to the rolling velocity [-], shape (mx, my)
      real(wp), intent(in) :: slip(:, :)
      real(wp) :: shift(size(slip, 1), size(slip, 2))

      if (order == 2) then
         shift = problem%dq*half_ahead(slip, rolling_direction(problem))
      else
         shift = problem%dq*slip
      end if
   end function shift_by_slip

   !> A field half an element ahead: mean with the next element, linear extrapolation at the end of the grid
   pure function half_ahead(field, direction) result(ahead)
      !> Field, shape (mx, my)
      real(wp), intent(in) :: field(:, :)
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      real(wp) :: ahead(size(field, 1), size(field, 2))
      integer :: ix, mx

      mx = size(field, 1)
      do ix = 1, mx
         if (ix + direction >= 1 .and. ix + direction <= mx) then
            ahead(ix, :) = 0.5_wp*(field(ix, :) + field(ix + direction, :))
         else
            ahead(ix, :) = field(ix, :) + 0.5_wp*(field(ix, :) - field(min(mx, max(1, ix - direction)), :))
         end if
      end do
   end function half_ahead

   !> Displacements at the previous time of the particles that are now in the elements
   subroutine previous_displacement(problem, state, workspace)
      !> Motion, grid and elasticity
      type(patch_problem), intent(in) :: problem
      !> Tractions of the previous time step on the present grid
      type(patch_state), intent(in) :: state
      !> `old_displacement` is set [mm]
      type(patch_workspace), intent(inout) :: workspace
      real(wp), allocatable :: edge(:, :, :)
      real(wp) :: shift_x, shift_y

      call clear_long(size(workspace%old_displacement), workspace%old_displacement)
      if (problem%corrects_leading_edge) then
         call displacement_of(problem, state%before, workspace, edge)
         call move_alloc(edge, workspace%edge_displacement)
      end if
      if (.not. any(state%before%division > element%exterior)) return
      shift_x = 0.0_wp
      shift_y = 0.0_wp
      if (problem%motion == motion%transient_rolling) then
         shift_x = problem%dq*cos(problem%chi)
         shift_y = problem%dq*sin(problem%chi)
         if (abs(shift_y) < no_shift*problem%dq) shift_y = 0.0_wp
         if (abs(shift_x) < no_shift*problem%dq) shift_x = 0.0_wp
      end if
      if (.not. problem%model%is_flat()) then
         call curved_displacement(problem, state%before, workspace, moved=shift_x /= 0.0_wp)
         return
      end if
      call workspace%previous%prepare(problem%model, problem%grid%dx, problem%grid%dy, problem%grid%mx, problem%grid%my, &
         & shift_x, shift_y)
      call workspace%previous%tangential(state%before%px, state%before%py, state%before%pn, &
         & workspace%old_displacement(:, :, 1), workspace%old_displacement(:, :, 2))
   end subroutine previous_displacement

   !> The same for surfaces whose curvature differs between rows: at the same positions, or one element further ahead
   subroutine curved_displacement(problem, before, workspace, moved)
      type(patch_problem), intent(in) :: problem
      !> The previous time step
      type(traction_fields), intent(in) :: before
      type(patch_workspace), intent(inout) :: workspace
      logical, intent(in) :: moved
      real(wp), allocatable :: displacement(:, :, :)

      call displacement_of(problem, before, workspace, displacement)
      workspace%old_displacement = displacement
      if (.not. moved) return
      ! A' = A - (A - A')
      call workspace%window%steady(workspace%pt, workspace%ut)
      workspace%old_displacement = workspace%old_displacement - workspace%ut
      call workspace%window%steady_by_normal(before%pn, workspace%ut)
      workspace%old_displacement = workspace%old_displacement - workspace%ut
   end subroutine curved_displacement

   !> Tangential displacements at the elements by the tractions of a time step
   subroutine displacement_of(problem, fields, workspace, displacement)
      type(patch_problem), intent(in) :: problem
      type(traction_fields), intent(in) :: fields
      type(patch_workspace), intent(inout) :: workspace
      !> Displacements [mm], shape (mx, my, 2)
      real(wp), allocatable, intent(out) :: displacement(:, :, :)
      real(wp), allocatable :: by_normal(:, :, :)

      call prepare_window(problem, workspace)
      call copy_long(size(fields%px), fields%px, workspace%pt(:, :, 1))
      call copy_long(size(fields%py), fields%py, workspace%pt(:, :, 2))
      allocate(displacement, by_normal, mold=workspace%pt)
      call workspace%window%tangential(workspace%pt, displacement)
      if (.not. problem%model%coupled()) return
      call workspace%window%tangential_by_normal(fields%pn, by_normal)
      displacement = displacement + by_normal
   end subroutine displacement_of
end module contact_patch_kinematics
