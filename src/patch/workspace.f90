!> Work space of one contact patch: compliances with their spectra, and the arrays of the solvers
module contact_patch_workspace
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_elastic_halfspace, only : kernel_table
   use contact_elastic_new_compliance, only : new_compliance
   use contact_elastic_one_sided, only : one_sided_operator, share_table
   use contact_elastic_pressure_sums, only : pressure_sums
   use contact_elastic_previous, only : previous_operator
   use contact_elastic_shelf, only : operator_shelf
   use contact_grid_element_division, only : bounding_box
   use contact_numeric_anderson, only : anderson_iteration
   use contact_normal_conjugate_gradient, only : normal_problem, normal_workspace, release_normal
   use contact_patch_friction_iteration, only : friction_iteration
   use contact_patch_problem, only : patch_problem, rolling_direction
   use contact_simplified_problem, only : simplified_problem, simplified_solution
   use contact_tangential_nested, only : nested_workspace, release_nested
   use contact_tangential_problem, only : tangential_problem, tangential_solution
   implicit none (type, external)
   private

   public :: patch_workspace, fit_workspace, pressure_displacement, prepare_window, prepare_box, release_workspace

   !> Sizes of grids that serve several smaller ones, in elements: multiples of `fine_size` up to `few_elements`, above it of
   !> `coarse_size`
   integer, parameter :: fine_size = 8, few_elements = 64, coarse_size = 16

   !> Work space; its contents have no meaning from one case to the next
   type :: patch_workspace
      !> Compliance on the whole grid and on the bounding box of the contact area
      class(compliance), allocatable :: window, box
      !> Compliances of other grids and boxes that were in use
      type(operator_shelf) :: windows, boxes
      !> Compliance on a grid of rounded size that serves several ones, and others of such sizes
      class(compliance), allocatable :: rounded
      type(operator_shelf) :: all_rounded
      !> Pressures and displacements on this grid
      real(wp), allocatable :: rounded_pn(:, :), rounded_un(:, :)
      type(previous_operator) :: previous
      !> Normal displacements of few elements, for approximate pressures; unallocated if not applicable to the bodies
      type(pressure_sums), allocatable :: sums
      !> Influence coefficients of the same particles one step before, in steady rolling with steps of any length
      type(kernel_table) :: shifted
      type(normal_problem) :: normal
      type(normal_workspace) :: normal_work
      type(tangential_problem) :: tangential
      type(tangential_solution) :: solution
      type(nested_workspace) :: tangential_work
      type(friction_iteration) :: friction
      !> Acceleration of the outer iteration, and the fraction of EPS to which its passes solve for pressures and tractions
      type(anderson_iteration) :: outer
      real(wp) :: sharper = 1.0_wp
      !> The tangential problem and its solution in simplified theory
      type(simplified_problem) :: simplified
      type(simplified_solution) :: simplified_solution
      !> Box around the contact area of its last solution
      type(bounding_box) :: touching
      !> Displacements at the previous time [mm], shape (mx, my, 2)
      real(wp), allocatable :: old_displacement(:, :, :)
      !> For the leading-edge correction: displacements at the elements by the previous tractions [mm], shape (mx, my, 2)
      real(wp), allocatable :: edge_displacement(:, :, :)
      !> Normal displacements for which the pressures were solved, and those by the present tangential tractions [mm], shape (mx,
      !> my)
      real(wp), allocatable :: un(:, :), lift(:, :)
      !> Work arrays on the grid, shape (mx, my, 2)
      real(wp), allocatable :: ut(:, :, :), pt(:, :, :)
      !> Work arrays on the box
      real(wp), allocatable :: box_un(:, :), box_pn(:, :), box_ut(:, :, :)
      !> Fraction of the step during which the elements of the box were in contact, for the leading-edge correction
      real(wp), allocatable :: share(:, :)
   end type patch_workspace

contains

   !> Allocate the work arrays on the grid; arrays of equal size are reused
   subroutine fit_workspace(problem, workspace)
      !> Its grid defines the size
      type(patch_problem), intent(in) :: problem
      !> Arrays on the grid, without values; memory that is never used is never touched
      type(patch_workspace), intent(inout) :: workspace
      integer :: mx, my

      if (.not. (problem%iterates() .or. problem%model%coupled())) return
      mx = problem%grid%mx
      my = problem%grid%my
      if (allocated(workspace%un)) then
         if (all(shape(workspace%un) == [mx, my])) return
         deallocate(workspace%un, workspace%lift, workspace%ut, workspace%pt, workspace%old_displacement)
      end if
      allocate(workspace%un(mx, my), workspace%lift(mx, my), workspace%ut(mx, my, 2), workspace%pt(mx, my, 2), &
         & workspace%old_displacement(mx, my, 2))
   end subroutine fit_workspace

   !> Prepare the compliance on the whole grid
   subroutine prepare_window(problem, workspace)
      !> Elasticity, grid and rolling direction
      type(patch_problem), intent(in) :: problem
      !> `window` is prepared
      type(patch_workspace), intent(inout) :: workspace

      call workspace%windows%fetch(problem%model, problem%grid%dx, problem%grid%dy, problem%grid%mx, problem%grid%my, &
         & workspace%window)
      call new_compliance(problem%model, workspace%window)
      call workspace%window%prepare(problem%model, problem%grid%dx, problem%grid%dy, problem%grid%mx, problem%grid%my, &
         & rolling_direction(problem), problem%grid%y(1))
   end subroutine prepare_window

   !> Normal displacements of flat half-spaces by pressures that were solved without the compliance of the grid
   !>
   !> The grid is padded with zeros to a size that serves several grids: influence coefficients, spectra and plans of an earlier
   !> case can be reused. If there is a compliance for the grid itself, it is used.
   subroutine pressure_displacement(problem, workspace, pn, un)
      !> Elasticity and grid
      type(patch_problem), intent(in) :: problem
      !> `window` or `rounded` is used
      type(patch_workspace), intent(inout) :: workspace
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: pn(:, :)
      !> Displacement difference [mm], positive where the surfaces move apart, shape (mx, my)
      real(wp), contiguous, intent(inout) :: un(:, :)
      integer :: n(2)
      logical :: at_hand

      associate (grid => problem%grid)
         at_hand = allocated(workspace%window)
         if (at_hand) at_hand = workspace%window%is_for(problem%model, grid%dx, grid%dy, grid%mx, grid%my)
         if (at_hand .or. .not. workspace%sums%suits(problem%model)) then
            call prepare_window(problem, workspace)
            call workspace%window%normal(pn, un)
            return
         end if
         n = [rounded_up(grid%mx), rounded_up(grid%my)]
         if (allocated(workspace%rounded_pn)) then
            if (any(shape(workspace%rounded_pn) /= n)) deallocate(workspace%rounded_pn, workspace%rounded_un)
         end if
         if (.not. allocated(workspace%rounded_pn)) allocate(workspace%rounded_pn(n(1), n(2)), workspace%rounded_un(n(1), n(2)))
         call workspace%all_rounded%fetch(problem%model, grid%dx, grid%dy, n(1), n(2), workspace%rounded)
         call new_compliance(problem%model, workspace%rounded)
         call workspace%rounded%prepare(problem%model, grid%dx, grid%dy, n(1), n(2), rolling_direction(problem), grid%y(1))
         workspace%rounded_pn = 0.0_wp
         workspace%rounded_pn(:grid%mx, :grid%my) = pn
         call workspace%rounded%normal(workspace%rounded_pn, workspace%rounded_un)
         un = workspace%rounded_un(:grid%mx, :grid%my)
      end associate
   end subroutine pressure_displacement

   !> Rounded size of a grid
   pure integer function rounded_up(n)
      !> Size in elements
      integer, intent(in) :: n
      integer :: step

      step = merge(fine_size, coarse_size, n <= few_elements)
      rounded_up = ((n + step - 1)/step)*step
   end function rounded_up

   !> Prepare the compliance on the bounding box of the contact area
   subroutine prepare_box(problem, box, workspace)
      !> Elasticity, grid and rolling direction
      type(patch_problem), intent(in) :: problem
      !> First and last column and row of the box in the grid
      type(bounding_box), intent(in) :: box
      !> `box` is prepared
      type(patch_workspace), intent(inout) :: workspace

      call workspace%boxes%fetch(problem%model, problem%grid%dx, problem%grid%dy, box%ix1 - box%ix0 + 1, &
         & box%iy1 - box%iy0 + 1, workspace%box)
      call new_compliance(problem%model, workspace%box)
      if (problem%shares_table) call share_with_box(problem, workspace, box%ix1 - box%ix0 + 1, box%iy1 - box%iy0 + 1)
      call workspace%box%prepare(problem%model, problem%grid%dx, problem%grid%dy, box%ix1 - box%ix0 + 1, &
         & box%iy1 - box%iy0 + 1, rolling_direction(problem), problem%grid%y(box%iy0))
   end subroutine prepare_box

   !> Take the influence coefficients of viscoelastic bodies on the box from those of the grid
   subroutine share_with_box(problem, workspace, mx, my)
      !> Elasticity and grid
      type(patch_problem), intent(in) :: problem
      !> Compliances of grid and box, the latter not yet prepared
      type(patch_workspace), intent(inout) :: workspace
      !> Size of the box in elements
      integer, intent(in) :: mx, my

      if (.not. allocated(workspace%window)) return
      ! it may be that of an earlier case
      if (.not. workspace%window%is_for(problem%model, problem%grid%dx, problem%grid%dy, problem%grid%mx, problem%grid%my)) return
      select type (window => workspace%window)
      class is (one_sided_operator)
         select type (part => workspace%box)
         class is (one_sided_operator)
            call share_table(window, mx, my, part)
         end select
      end select
   end subroutine share_with_box

   !> Free the memory that the workspace holds outside Fortran: plans of transforms
   subroutine release_workspace(workspace)
      !> Plans of its compliances and solvers are freed; it may be used again
      type(patch_workspace), intent(inout) :: workspace

      if (allocated(workspace%window)) call workspace%window%release()
      if (allocated(workspace%box)) call workspace%box%release()
      if (allocated(workspace%rounded)) call workspace%rounded%release()
      call workspace%windows%release()
      call workspace%all_rounded%release()
      call workspace%boxes%release()
      call workspace%previous%release()
      call release_normal(workspace%normal_work)
      call release_nested(workspace%tangential_work)
   end subroutine release_workspace
end module contact_patch_workspace
