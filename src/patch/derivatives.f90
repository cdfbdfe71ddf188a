!> Derivatives of the forces and moments of a patch to the distance of the bodies, to creepages and to friction
!>
!> Exact derivatives of the discrete solution as in `contact_patch_sensitivities`: contact area and element division are kept.
!> Pressures respond to changes of the distance, one linear system for each; sums of tractions have one adjoint system each,
!> whatever number of inputs there is.
module contact_patch_derivatives
   use contact_base_choices, only : motion
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_grid_element_division, only : bounding_box, contact_box, element
   use contact_normal_parts, only : displacement_between
   use contact_normal_responses, only : pressure_responses
   use contact_patch_kinematics, only : shift_by_slip
   use contact_patch_order, only : edge_slip, spin_offset_of
   use contact_patch_problem, only : patch_problem
   use contact_patch_result, only : patch_result
   use contact_patch_workspace, only : patch_workspace, prepare_box, prepare_window
   use contact_tangential_nested, only : traction_adjoint
   use contact_tangential_problem, only : slip_of, tangential_problem
   use contact_tangential_second_order, only : is_known
   implicit none (type, external)
   private

   public :: patch_derivatives, differentiate_patch, obstacle_to_derivatives

   !> Rows: forces Fx, Fy, Fn [N] and moments Mx, My, Mz about the origin of the grid [N mm]
   integer, parameter :: fx = 1, fy = 2, fn = 3, mx_ = 4, my_ = 5, mz = 6

   !> What the forces and moments change by, per unit of an input
   type :: patch_derivatives
      !> To the inputs that change the distance, with creepages and friction kept, shape (6, inputs)
      real(wp), allocatable :: by_distance(:, :)
      !> To the creepages [N, N mm] and the spin [N mm, N mm2]
      real(wp) :: by_creepage(6, 3) = 0.0_wp
      !> To the inputs that change the slip of the elements, shape (6, inputs); zero if there are none
      real(wp), allocatable :: by_slip(:, :)
      !> To the coefficient of friction
      real(wp) :: by_friction(6) = 0.0_wp
      !> Largest relative residual of the linear systems
      real(wp) :: reached = 0.0_wp
   end type patch_derivatives

   !> Of the residuals, relative to the right-hand sides. With a prescribed vertical force pressures by displacements and by the
   !> height cancel for the most part, so that they have to be found more sharply; measured for four figures
   real(wp), parameter :: for_pressures = 1.0e-7_wp, for_tractions = 1.0e-5_wp
   !> Search directions for one system of the normal problem at most; chosen
   integer, parameter :: most_directions = 100

contains

   !> Reason why there are no derivatives of a patch, blank if there are
   pure subroutine obstacle_to_derivatives(problem, reason)
      !> Method, friction and bodies of the patch
      type(patch_problem), intent(in) :: problem
      !> In words that follow "no derivatives: "
      character(len=:), allocatable, intent(out) :: reason

      reason = ""
      if (.not. problem%solves_for_pressure()) then
         reason = "pressures that are given or approximate"
      else if (problem%motion == motion%shift .or. problem%motion == motion%transient_rolling) then
         reason = "shifts and transient rolling"
      else if (problem%motion == motion%none) then
         return
      else if (allocated(problem%simplified)) then
         reason = "simplified theory"
      else if (allocated(problem%friction)) then
         reason = "friction that changes with slip or temperature, or from row to row"
      else if (problem%remembers_yield) then
         reason = "a surface that yields"
      else if (allocated(problem%model%memory)) then
         reason = "viscoelastic bodies"
      else if (.not. problem%model%is_flat()) then
         reason = "conformal and tabulated influence coefficients"
      else if (allocated(problem%damping)) then
         reason = "damping"
      else if (problem%couples()) then
         reason = "pressures that follow the tractions of bodies that differ"
      else if (problem%general_step) then
         reason = "steps that are not one element long"
      end if
   end subroutine obstacle_to_derivatives

   !> Derivatives at the solution of a patch
   subroutine differentiate_patch(problem, distance, workspace, result, derivatives, slip)
      !> What was solved, without obstacle
      type(patch_problem), intent(in) :: problem
      !> Changes of the undeformed distance, approach taken off, by each input [mm per unit], shape (mx, my, inputs); only values
      !> in contact count
      real(wp), contiguous, intent(in) :: distance(:, :, :)
      !> That of the solution
      type(patch_workspace), intent(inout) :: workspace
      !> Solution
      type(patch_result), intent(in) :: result
      !> Gets all of them
      type(patch_derivatives), intent(out) :: derivatives
      !> Changes of the extra slip by inputs of their own [- per unit], shape (mx, my, 2, inputs)
      real(wp), contiguous, intent(in), optional :: slip(:, :, :, :)
      real(wp), allocatable :: response(:, :, :), x(:)
      real(wp) :: area, row
      integer :: ix, iy, k

      allocate(derivatives%by_distance(6, size(distance, 3)), source=0.0_wp)
      if (present(slip)) allocate(derivatives%by_slip(6, size(slip, 4)), source=0.0_wp)
      if (result%ncon == 0) return
      allocate(response, mold=distance)
      call differentiate_pressures(problem, -distance, workspace, result, response, derivatives%reached)
      area = problem%grid%dx*problem%grid%dy
      x = [(problem%grid%x(ix), ix=1, problem%grid%mx)]
      do k = 1, size(distance, 3)
         associate (d => derivatives%by_distance(:, k))
            do iy = 1, problem%grid%my
               row = area*sum(response(:, iy, k))
               d(fn) = d(fn) + row
               d(mx_) = d(mx_) + row*problem%grid%y(iy)
               d(my_) = d(my_) - area*dot_product(response(:, iy, k), x)
            end do
         end associate
      end do
      if (problem%motion /= motion%none) call differentiate_tractions(problem, response, workspace, result, derivatives, slip)
   end subroutine differentiate_patch

   !> Changes of the pressures by displacements of the bodies
   subroutine differentiate_pressures(problem, displacement, workspace, result, response, reached)
      type(patch_problem), intent(in) :: problem
      !> [mm per unit], shape (mx, my, inputs)
      real(wp), contiguous, intent(in) :: displacement(:, :, :)
      type(patch_workspace), intent(inout) :: workspace
      type(patch_result), intent(in) :: result
      !> [N/mm2 per unit], of the same shape
      real(wp), contiguous, intent(inout) :: response(:, :, :)
      !> Largest relative residual of the linear systems
      real(wp), intent(out) :: reached
      type(bounding_box) :: box
      real(wp), allocatable :: cut(:, :, :), in_box(:, :, :)
      logical :: found

      reached = 0.0_wp
      call prepare_window(problem, workspace)
      found = .false.
      if (.not. allocated(problem%parts)) call workspace%normal_work%factor%pressure_responses(workspace%window, result%pn, &
         & displacement, response, found)
      if (found) return
      if (allocated(problem%parts) .or. problem%motion == motion%none) then
         call pressure_responses(workspace%window, problem%parts, result%pn, displacement, for_pressures, most_directions, &
            & response, reached)
         return
      end if
      ! the systems of the tractions need the operator of the box anyway
      box = contact_box(result%division)
      call prepare_box(problem, box, workspace)
      in_box = displacement(box%ix0:box%ix1, box%iy0:box%iy1, :)
      allocate(cut, mold=in_box)
      call pressure_responses(workspace%box, problem%parts, result%pn(box%ix0:box%ix1, box%iy0:box%iy1), in_box, for_pressures, &
         & most_directions, cut, reached)
      response = 0.0_wp
      response(box%ix0:box%ix1, box%iy0:box%iy1, :) = cut
   end subroutine differentiate_pressures

   !> Fx, Fy and Mz
   subroutine differentiate_tractions(problem, response, workspace, result, derivatives, extra)
      type(patch_problem), intent(in) :: problem
      !> Changes of the pressures, shape (mx, my, inputs)
      real(wp), contiguous, intent(in) :: response(:, :, :)
      type(patch_workspace), intent(inout) :: workspace
      type(patch_result), intent(in) :: result
      type(patch_derivatives), intent(inout) :: derivatives
      !> Changes of the extra slip, shape (mx, my, 2, inputs)
      real(wp), contiguous, intent(in), optional :: extra(:, :, :, :)
      !> The sums of tractions
      integer, parameter :: row(3) = [fx, fy, mz]
      type(bounding_box) :: box
      real(wp), allocatable :: weight(:, :, :, :), by_slip(:, :, :, :), by_bound(:, :, :), pressure(:, :)
      real(wp), allocatable :: slip(:, :, :), gap(:, :), at(:, :, :), by_angle(:, :, :), angle(:, :)
      real(wp), allocatable :: x(:), y(:)
      real(wp) :: area, reached, offset, s(2), sums(3)
      integer :: j, k, ix, iy

      box = contact_box(result%division)
      call prepare_box(problem, box, workspace)
      area = problem%grid%dx*problem%grid%dy
      offset = spin_offset_of(problem, result%tangential)*problem%dq
      ! from the centre of spin
      x = [(problem%grid%x(ix), ix=box%ix0, box%ix1)] - (problem%spin_centre(1) - offset*cos(problem%chi))
      y = [(problem%grid%y(iy), iy=box%iy0, box%iy1)] - (problem%spin_centre(2) - offset*sin(problem%chi))
      associate (t => workspace%tangential, solution => workspace%solution)
         allocate(weight(t%mx, t%my, 2, 3), source=0.0_wp)
         allocate(by_slip(t%mx, t%my, 2, 3), by_bound(t%mx, t%my, 3), by_angle(t%mx, t%my, 3), pressure(t%mx, t%my))
         if (allocated(t%second)) allocate(slip(t%mx, t%my, 2), at(t%mx, t%my, 2), gap(t%mx, t%my), angle(t%mx, t%my))
         weight(:, :, 1, 1) = area
         weight(:, :, 2, 2) = area
         do iy = 1, t%my
            weight(:, iy, 1, 3) = -area*problem%grid%y(box%iy0 + iy - 1)
            do ix = 1, t%mx
               weight(ix, iy, 2, 3) = area*problem%grid%x(box%ix0 + ix - 1)
            end do
         end do
         call traction_adjoint(t, workspace%box, for_tractions, workspace%tangential_work, solution, weight, by_slip, by_bound, &
            & by_angle, reached)
         derivatives%reached = max(derivatives%reached, reached)
         if (allocated(t%second)) call slip_of(t, workspace%box, solution%p, solution%creep, at)
         do j = 1, 3
            associate (c => derivatives%by_creepage(row(j), :))
               do iy = 1, t%my
                  s = problem%dq*[sum(by_slip(:, iy, 1, j)), sum(by_slip(:, iy, 2, j))]
                  c(1:2) = c(1:2) + s
                  c(3) = c(3) + problem%spin_weight(2)*problem%dq*dot_product(x, by_slip(:, iy, 2, j)) &
                     & - problem%spin_weight(1)*y(iy)*s(1)
               end do
            end associate
            pressure = result%pn(box%ix0:box%ix1, box%iy0:box%iy1)
            derivatives%by_friction(row(j)) = sum(by_bound(:, :, j)*pressure)
         end do
         if (present(extra)) then
            do k = 1, size(extra, 4)
               call sums_by_slip(problem, result%tangential%order, box, by_slip, extra(:, :, :, k), sums)
               derivatives%by_slip(row, k) = sums
            end do
         end if
         do k = 1, size(response, 3)
            pressure = response(box%ix0:box%ix1, box%iy0:box%iy1, k)
            do j = 1, 3
               derivatives%by_distance(row(j), k) = problem%mu*sum(by_bound(:, :, j)*pressure, &
                  & mask=solution%division /= element%plastic)
            end do
            if (.not. allocated(t%second)) cycle
            call gap_changes(problem, response(:, :, k), box, t, workspace%window, gap)
            call edge_slip(problem, t, workspace%box%diagonal(2), solution%p, at, &
               & result%pn(box%ix0:box%ix1, box%iy0:box%iy1), pressure, gap, slip, angle)
            do j = 1, 3
               derivatives%by_distance(row(j), k) = derivatives%by_distance(row(j), k) + sum(by_slip(:, :, :, j)*slip) &
                  & + sum(by_angle(:, :, j)*angle)
            end do
         end do
      end associate
   end subroutine differentiate_tractions

   !> Changes of sums of tractions by a change of the extra slip
   pure subroutine sums_by_slip(problem, order, box, by_slip, extra, sums)
      type(patch_problem), intent(in) :: problem
      !> Order of the discretisation
      integer, intent(in) :: order
      type(bounding_box), intent(in) :: box
      !> Derivatives of the sums by the rigid slip per step [N, N mm per mm], shape (box, 2, sums)
      real(wp), intent(in) :: by_slip(:, :, :, :)
      !> [- per unit], shape (mx, my, 2)
      real(wp), intent(in) :: extra(:, :, :)
      !> [N, N mm per unit]
      real(wp), intent(out) :: sums(:)
      real(wp) :: shift(problem%grid%mx, problem%grid%my)
      integer :: i, j

      sums = 0.0_wp
      do i = 1, 2
         shift = shift_by_slip(problem, order, extra(:, :, i))
         do j = 1, size(sums)
            sums(j) = sums(j) + sum(by_slip(:, :, i, j)*shift(box%ix0:box%ix1, box%iy0:box%iy1))
         end do
      end do
   end subroutine sums_by_slip

   !> Changes of the distance of the surfaces in the elements ahead of the leading ones
   !>
   !> In contact displacements follow the undeformed distance, which is extrapolated ahead by a parabola through the last three
   !> elements.
   subroutine gap_changes(problem, response, box, t, window, gap)
      type(patch_problem), intent(in) :: problem
      !> Change of the pressures, shape of the grid
      real(wp), contiguous, intent(in) :: response(:, :)
      type(bounding_box), intent(in) :: box
      !> Its edge terms show where distances are known
      type(tangential_problem), intent(in) :: t
      !> Compliance of the grid
      class(compliance), intent(inout) :: window
      !> [mm per unit], zero where distances are not known, shape of the box
      real(wp), intent(out) :: gap(:, :)
      !> Values ahead of one, two and three equidistant ones
      real(wp), parameter :: extension(3, 3) = reshape([1.0_wp, 0.0_wp, 0.0_wp, 2.0_wp, -1.0_wp, 0.0_wp, 3.0_wp, -3.0_wp, &
         & 1.0_wp], [3, 3])
      real(wp), allocatable :: un(:, :)
      integer :: ix, iy, jx, jy, k, n

      allocate(un, mold=response)
      call displacement_between(problem%parts, window, response, un)
      gap = 0.0_wp
      do iy = 1, t%my
         jy = box%iy0 + iy - 1
         do ix = 1, t%mx
            if (.not. is_known(t%second%gap(ix, iy))) cycle
            jx = box%ix0 + ix - 1
            n = 1
            do while (n < size(extension, 1) .and. ix - n*t%direction >= 1 .and. ix - n*t%direction <= t%mx)
               if (.not. t%contact(ix - n*t%direction, iy)) exit
               n = n + 1
            end do
            gap(ix, iy) = un(jx + t%direction, jy)
            do k = 1, n
               gap(ix, iy) = gap(ix, iy) - extension(k, n)*un(jx - (k - 1)*t%direction, jy)
            end do
         end do
      end do
   end subroutine gap_changes
end module contact_patch_derivatives
