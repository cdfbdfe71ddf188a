!> Totals and fields derived from the tractions of a patch
module contact_patch_derived
   use contact_base_choices, only : estimate_choice, motion
   use contact_base_constants, only : nmm_per_joule
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : solve_report
   use contact_grid_element_division, only : bounding_box, contact_box, element
   use contact_normal_conjugate_gradient, only : approach_scale
   use contact_normal_few_elements, only : by_factor
   use contact_numeric_pieces, only : clear_long, copy_long, copy_whole, fill_long, fill_whole
   use contact_patch_kinematics, only : rigid_slip
   use contact_patch_peak, only : largest_pressure
   use contact_patch_problem, only : carried, patch_problem, patch_state
   use contact_patch_result, only : patch_result
   use contact_patch_workspace, only : patch_workspace, pressure_displacement, prepare_window
   use contact_patch_yield, only : derive_yield
   implicit none (type, external)
   private

   public :: complete, derive, remember_friction, reset_result

   !> Lower bound of the velocity in the computation of the time step [mm/s]
   real(wp), parameter :: min_velocity = 1.0e-10_wp
   !> Elements in contact up to which sums of displacements take less time than transforms
   integer, parameter :: few_elements = 200

contains

   !> Initial values of a result
   subroutine reset_result(problem, state, result)
      !> Size of the grid, and quantities known in advance
      type(patch_problem), intent(in) :: problem
      !> Estimate of the creepages
      type(patch_state), intent(in) :: state
      !> Its arrays get the size of the grid and initial values
      type(patch_result), intent(inout) :: result
      integer :: mx, my

      mx = problem%grid%mx
      my = problem%grid%my
      result%grid = problem%grid
      result%gg = problem%model%material%gg
      result%nu = problem%model%material%nu
      result%ak = problem%model%material%ak
      result%motion = problem%motion
      result%chi = problem%chi
      result%dq = problem%dq
      result%veloc = problem%veloc
      result%dt = problem%dq/max(min_velocity, problem%veloc)
      result%mu_scal = problem%mu
      result%fn = problem%fn
      result%pen = problem%pen
      result%cksi = problem%creep(1)
      result%ceta = problem%creep(2)
      result%cphi = problem%spin
      result%flx = 0.0_wp
      result%k_eff = 0.0_wp
      result%centre = 0.0_wp
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
      call copy_long(mx*my, problem%h, result%h)
      call fill_long(mx*my, problem%mu, result%mu)
      if (allocated(problem%friction)) call problem%friction%at_rest(result%mu)
      if (allocated(result%friction)) deallocate(result%friction)
      call clear_long(mx*my, result%un)
      call clear_long(mx*my, result%ux)
      call clear_long(mx*my, result%uy)
      call clear_long(mx*my, result%sx)
      call clear_long(mx*my, result%sy)
      call clear_long(mx*my, result%wx)
      call clear_long(mx*my, result%wy)
      call fill_whole(mx*my, element%exterior, result%division)
   end subroutine reset_result

   !> Totals and fields derived from the tractions
   subroutine derive(problem, state, workspace, result)
      !> Elasticity, motion, and requested outputs
      type(patch_problem), intent(in) :: problem
      !> Solved tractions; approach and creepages are stored for later cases
      type(patch_state), intent(inout) :: state
      !> Compliances, and the displacements of the last solutions
      type(patch_workspace), intent(inout) :: workspace
      !> Slip and coefficients of friction on entry; totals and fields are set
      type(patch_result), intent(inout) :: result
      type(bounding_box) :: box
      real(wp) :: area, scale
      integer :: iy, ix

      area = problem%grid%dx*problem%grid%dy
      if (allocated(problem%simplified) .and. problem%motion /= motion%none) then
         box = workspace%touching
      else
         box = contact_box(state%now%division)
      end if
      result%inorm = merge(result%normal%passes, -1, result%normal%succeeded())
      result%itang = merge(result%tangential%passes, -1, result%tangential%succeeded())
      call copy_whole(size(result%division), state%now%division, result%division)
      call copy_long(size(result%pn), state%now%pn, result%pn)
      call copy_long(size(result%px), state%now%px, result%px)
      call copy_long(size(result%py), state%now%py, result%py)
      result%pmax = 0.0_wp
      if (.not. is_deferred(problem)) result%pmax = largest_pressure(result%pn, result%tangential%order)
      call sum_up(problem, box, result)
      scale = result%mu_scal*result%fn + tiny(scale)
      if (problem%motion == motion%none) then
         result%fx_rel = 0.0_wp
         result%fy_rel = 0.0_wp
      else
         result%fx_rel = result%fx/scale
         result%fy_rel = result%fy/scale
      end if
      if (problem%motion /= motion%none .and. .not. (is_deferred(problem) .and. allocated(problem%simplified))) &
         & call add_creepages(problem, result)
      result%elastic_energy = 0.0_wp
      result%friction_power = 0.0_wp
      result%residual = max(result%normal%residual, result%tangential%residual, 0.0_wp)
      if (result%ncon == 0) then
         call derive_yield(problem, state, workspace%solution, result)
         state%now%pen = result%pen
         state%creep = [result%cksi, result%ceta]
         return
      end if
      if (.not. is_deferred(problem)) call displacements(problem, state, box, workspace, result)
      if (allocated(problem%simplified)) then
         if (.not. is_deferred(problem)) result%friction_power = power_of_slip(box, result)
      else if (problem%motion /= motion%none) then
         associate (solution => workspace%solution)
            do iy = box%iy0, box%iy1
               do ix = box%ix0, box%ix1
                  if (solution%division(ix - box%ix0 + 1, iy - box%iy0 + 1) /= element%slip) cycle
                  result%sx(ix, iy) = solution%slip(ix - box%ix0 + 1, iy - box%iy0 + 1, 1)
                  result%sy(ix, iy) = solution%slip(ix - box%ix0 + 1, iy - box%iy0 + 1, 2)
               end do
            end do
         end associate
         result%friction_power = area/(nmm_per_joule*result%dt)*(sum(result%px*result%sx) + sum(result%py*result%sy))
         if (problem%model%coupled()) call coupled_residual(problem, box, result)
      end if
      call derive_yield(problem, state, workspace%solution, result)
      if (.not. is_deferred(problem)) call derive_energy(problem, box, result)
      state%now%pen = result%pen
      state%creep = [result%cksi, result%ceta]
   end subroutine derive

   !> Frictional power in simplified theory [W]; tractions are zero outside the contact
   pure real(wp) function power_of_slip(box, result) result(power)
      !> Contains the contact area
      type(bounding_box), intent(in) :: box
      !> Tractions, slip and time step
      type(patch_result), intent(in) :: result
      real(wp) :: along, across
      integer :: ix, iy

      along = 0.0_wp
      across = 0.0_wp
      do iy = box%iy0, box%iy1
         do ix = box%ix0, box%ix1
            along = along + result%px(ix, iy)*result%sx(ix, iy)
            across = across + result%py(ix, iy)*result%sy(ix, iy)
         end do
      end do
      power = result%grid%dx*result%grid%dy/(nmm_per_joule*result%dt)*(along + across)
   end function power_of_slip

   !> Numbers of elements, forces and moments; tractions are zero outside the contact
   pure subroutine sum_up(problem, box, result)
      type(patch_problem), intent(in) :: problem
      !> Contains the contact area
      type(bounding_box), intent(in) :: box
      !> Element states and tractions on entry; the numbers, tangential forces and moments are set
      type(patch_result), intent(inout) :: result
      !> Number of columns whose sums are formed together; an array of the width of the contact would come from the heap
      integer, parameter :: columns = 64
      !> Sums of each column: pressures, tractions, and their moments about the x axis and about the normal
      real(wp) :: sums(columns, 5)
      real(wp) :: area, moment(3), force(2), x, y
      integer :: first, n, k, ix, iy, touching, adhering, slipping

      area = problem%grid%dx*problem%grid%dy
      force = 0.0_wp
      moment = 0.0_wp
      touching = 0
      adhering = 0
      slipping = 0
      do first = box%ix0, box%ix1, columns
         n = min(columns, box%ix1 - first + 1)
         sums(:n, :) = 0.0_wp
         do iy = box%iy0, box%iy1
            y = problem%grid%y(iy)
            do k = 1, n
               ix = first - 1 + k
               sums(k, 1) = sums(k, 1) + result%pn(ix, iy)
               sums(k, 2) = sums(k, 2) + result%px(ix, iy)
               sums(k, 3) = sums(k, 3) + result%py(ix, iy)
               sums(k, 4) = sums(k, 4) + y*result%pn(ix, iy)
               sums(k, 5) = sums(k, 5) - y*result%px(ix, iy)
            end do
            do ix = first, first - 1 + n
               touching = touching + merge(1, 0, result%division(ix, iy) > element%exterior)
               adhering = adhering + merge(1, 0, result%division(ix, iy) == element%adhesion)
               slipping = slipping + merge(1, 0, result%division(ix, iy) == element%slip)
            end do
         end do
         do k = 1, n
            x = problem%grid%x(first - 1 + k)
            force = force + sums(k, 2:3)
            moment = moment + [sums(k, 4), -x*sums(k, 1), x*sums(k, 3) + sums(k, 5)]
         end do
      end do
      if (problem%motion == motion%none) moment(3) = 0.0_wp
      result%fx = area*force(1)
      result%fy = area*force(2)
      result%ncon = touching
      result%nadh = adhering
      result%nslip = slipping
      result%mx = area*moment(1)
      result%my = area*moment(2)
      result%mz = area*moment(3)
   end subroutine sum_up

   !> Are displacements deferred to `complete`? Not for moving coupled bodies, whose residual needs them
   pure logical function is_deferred(problem)
      type(patch_problem), intent(in) :: problem
      is_deferred = problem%defers_displacements .and. (problem%motion == motion%none .or. allocated(problem%simplified) &
         & .or. .not. problem%model%coupled())
   end function is_deferred

   !> Compute what was deferred: displacements, elastic energy and largest pressure, in simplified theory rigid slip and frictional
   !> power
   subroutine complete(problem, state, workspace, result)
      !> See `derive`
      type(patch_problem), intent(in) :: problem
      !> Solved tractions
      type(patch_state), intent(in) :: state
      !> Compliances
      type(patch_workspace), intent(inout) :: workspace
      !> Derived from the same tractions; completed
      type(patch_result), intent(inout) :: result
      type(bounding_box) :: box

      if (result%ncon == 0 .or. .not. is_deferred(problem)) return
      box = contact_box(state%now%division)
      result%pmax = largest_pressure(result%pn, result%tangential%order)
      if (allocated(problem%simplified) .and. problem%motion /= motion%none) then
         call rigid_slip(problem, result, spin_weight=result%flx(1:2)/result%flx(3))
         call add_creepages(problem, result)
         result%friction_power = result%friction_power + power_of_slip(box, result)
      end if
      call displacements(problem, state, box, workspace, result)
      call derive_energy(problem, box, result)
   end subroutine complete

   !> Add creepages that were found for prescribed forces to the rigid slip
   pure subroutine add_creepages(problem, result)
      type(patch_problem), intent(in) :: problem
      type(patch_result), intent(inout) :: result

      if (problem%n_forces >= 1) result%wx = result%wx + problem%dq*result%cksi
      if (problem%n_forces >= 2) result%wy = result%wy + problem%dq*result%ceta
   end subroutine add_creepages

   !> Elastic energy, if displacements are known; tractions are zero outside the contact
   pure subroutine derive_energy(problem, box, result)
      type(patch_problem), intent(in) :: problem
      !> Contains the contact area
      type(bounding_box), intent(in) :: box
      type(patch_result), intent(inout) :: result
      real(wp) :: work(3)
      integer :: ix, iy

      if (.not. allocated(problem%given_pressure)) then
         work = 0.0_wp
         do iy = box%iy0, box%iy1
            do ix = box%ix0, box%ix1
               work(1) = work(1) + result%pn(ix, iy)*result%un(ix, iy)
               work(2) = work(2) + result%px(ix, iy)*result%ux(ix, iy)
               work(3) = work(3) + result%py(ix, iy)*result%uy(ix, iy)
            end do
         end do
         result%elastic_energy = problem%grid%dx*problem%grid%dy/(2.0_wp*nmm_per_joule)*(work(1) + work(2) + work(3))
      else
         result%un = 0.0_wp
      end if
   end subroutine derive_energy

   !> Displacement differences in simplified theory: tangential ones of the springs, normal ones of half-spaces
   subroutine spring_displacements(problem, state, workspace, result)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      type(patch_workspace), intent(inout) :: workspace
      type(patch_result), intent(inout) :: result

      result%ux = workspace%simplified_solution%compliance(1)*result%px
      result%uy = workspace%simplified_solution%compliance(2)*result%py
      if (allocated(problem%given_pressure)) return
      if (.not. problem%want_exterior .and. result%normal%method == by_factor) then
         ! the equations of the elements in contact are satisfied to round-off
         call close_gap(size(result%un), result%pen, result%h, result%pn, result%un)
         return
      end if
      if (.not. problem%want_exterior .and. result%ncon <= few_elements .and. workspace%sums%suits(problem%model)) then
         if (.not. allocated(workspace%sums)) allocate(workspace%sums)
         associate (grid => problem%grid)
            call workspace%sums%prepare(problem%model, grid%dx, grid%dy, grid%mx, grid%my)
         end associate
         call workspace%sums%displace(state%now%pn, result%un)
         return
      end if
      call pressure_displacement(problem, workspace, state%now%pn, result%un)
      if (.not. problem%want_exterior) then
         where (result%division == element%exterior) result%un = 0.0_wp
      end if
   end subroutine spring_displacements

   !> Displacements that close the gap where there is pressure
   pure subroutine close_gap(n, pen, h, pn, un)
      !> Number of elements
      integer, intent(in) :: n
      !> Approach and undeformed distance [mm], pressures [N/mm2]
      real(wp), intent(in) :: pen, h(n), pn(n)
      !> Displacement differences [mm]
      real(wp), intent(inout) :: un(n)

      un = merge(pen - h, 0.0_wp, pn > 0.0_wp)
   end subroutine close_gap

   !> Store friction data that particles carry along, if later time steps depend on them
   subroutine remember_friction(problem, result, state)
      !> The case; `remembers_friction`: whether they are needed
      type(patch_problem), intent(in) :: problem
      !> Coefficients of friction and slip of the solution
      type(patch_result), intent(in) :: result
      !> Its present time step is set
      type(patch_state), intent(inout) :: state

      if (.not. problem%remembers_friction) return
      state%now%memory(carried%mu)%value = result%mu
      state%now%memory(carried%sx)%value = result%sx
      state%now%memory(carried%sy)%value = result%sy
   end subroutine remember_friction

   !> Displacement differences, on the contact area or, if requested, on the whole grid
   subroutine displacements(problem, state, box, workspace, result)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      type(bounding_box), intent(in) :: box
      type(patch_workspace), intent(inout) :: workspace
      type(patch_result), intent(inout) :: result
      integer :: ix, iy

      if (allocated(problem%simplified)) then
         call spring_displacements(problem, state, workspace, result)
         return
      end if
      if (problem%motion == motion%none .and. .not. problem%model%coupled()) then
         call pressure_displacement(problem, workspace, state%now%pn, result%un)
         return
      end if
      if (problem%want_exterior .or. problem%motion == motion%none) then
         call prepare_window(problem, workspace)
         call workspace%window%normal(state%now%pn, result%un)
         if (problem%motion /= motion%none) then
            call copy_long(size(state%now%px), state%now%px, workspace%pt(:, :, 1))
            call copy_long(size(state%now%py), state%now%py, workspace%pt(:, :, 2))
            call workspace%window%tangential(workspace%pt, workspace%ut)
            call copy_long(size(result%ux), workspace%ut(:, :, 1), result%ux)
            call copy_long(size(result%uy), workspace%ut(:, :, 2), result%uy)
         end if
         if (problem%model%coupled()) then
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
      ! the last step of a height search may have been a linear extrapolation
      workspace%solution%p(:, :, 1) = state%now%px(box%ix0:box%ix1, box%iy0:box%iy1)
      workspace%solution%p(:, :, 2) = state%now%py(box%ix0:box%ix1, box%iy0:box%iy1)
      call workspace%box%tangential(workspace%solution%p, workspace%box_ut)
      result%ux(box%ix0:box%ix1, box%iy0:box%iy1) = workspace%box_ut(:, :, 1)
      result%uy(box%ix0:box%ix1, box%iy0:box%iy1) = workspace%box_ut(:, :, 2)
      if (problem%model%coupled()) then
         call workspace%box%normal_by_tangential(workspace%solution%p, workspace%box_un)
         call workspace%box%tangential_by_normal(workspace%box_pn, workspace%box_ut)
         associate (un => result%un(box%ix0:box%ix1, box%iy0:box%iy1), ux => result%ux(box%ix0:box%ix1, box%iy0:box%iy1), &
            & uy => result%uy(box%ix0:box%ix1, box%iy0:box%iy1))
            un = un + workspace%box_un
            ux = ux + workspace%box_ut(:, :, 1)
            uy = uy + workspace%box_ut(:, :, 2)
         end associate
      end if
      do iy = 1, problem%grid%my
         do ix = 1, problem%grid%mx
            if (result%division(ix, iy) /= element%exterior) cycle
            result%un(ix, iy) = 0.0_wp
            result%ux(ix, iy) = 0.0_wp
            result%uy(ix, iy) = 0.0_wp
         end do
      end do
   end subroutine displacements

   !> Residual of the coupled conditions: deformed distance with the final tangential tractions
   !>
   !> The tangential problem was solved last, with the final pressures, so that its own residual is valid.
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
      ! the displacements do not include the factors between parts
      if (.not. problem%solves_for_pressure() .or. allocated(problem%parts)) return
      result%residual = max(result%tangential%residual, worst/approach_scale(result%pen, minval(result%h), worst))
   end subroutine coupled_residual
end module contact_patch_derived
