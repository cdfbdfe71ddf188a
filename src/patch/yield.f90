!> Yield limit of the layer between the bodies: from the material of a patch to its tangential problem and back
module contact_patch_yield
   use contact_base_choices, only : motion
   use contact_base_constants, only : nmm_per_joule
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : bounding_box
   use contact_patch_problem, only : carried, patch_problem, patch_state, rolling_direction, traction_fields
   use contact_patch_result, only : patch_result
   use contact_tangential_problem, only : tangential_problem, tangential_solution
   implicit none (type, external)
   private

   public :: set_yield, carry_yield, derive_yield

   !> Minimum of the yield limit in softening, relative to the initial limit [-]
   real(wp), parameter :: lowest_share = 0.1_wp
   !> Slopes below this fraction of the stiffness of an element, G/DX, are regarded as zero [-]; for steel about 1e-6 N/mm3
   real(wp), parameter :: no_slope = 1.0e-11_wp

contains

   !> Set the yield limits in the tangential problem
   !>
   !> Without slope they are included in the traction bound.
   subroutine set_yield(problem, before, box, tangential)
      !> Initial yield limit and its slope
      type(patch_problem), intent(in) :: problem
      !> The previous time step
      type(traction_fields), intent(in) :: before
      !> First and last column and row of the tangential problem in the grid
      type(bounding_box), intent(in) :: box
      !> The traction bounds of friction are set on entry
      type(tangential_problem), intent(inout) :: tangential

      allocate(tangential%yield)
      associate (yield => tangential%yield)
         yield%lowest = lowest_share*problem%initial_yield_limit
         if (abs(problem%yield_slope) >= no_slope*problem%model%material%gg/problem%grid%dx) yield%slope = problem%yield_slope
         if (tangential%steady) then
            allocate(yield%limit(tangential%mx, tangential%my), source=problem%initial_yield_limit)
         else
            yield%limit = before%memory(carried%tau_c)%value(box%ix0:box%ix1, box%iy0:box%iy1)
         end if
         if (.not. tangential%hardens()) tangential%bound = min(tangential%bound, yield%limit)
      end associate
   end subroutine set_yield

   !> Yield limits and plastic displacements after the step; they do not change outside the contact area
   subroutine carry_yield(problem, box, solution, state)
      !> `remembers_yield`: whether they are needed
      type(patch_problem), intent(in) :: problem
      !> Position of the solution in the grid; empty without contact
      type(bounding_box), intent(in) :: box
      !> Plastic displacements and yield limits on the box
      type(tangential_solution), intent(in) :: solution
      !> Its present time step is set
      type(patch_state), intent(inout) :: state
      integer :: ix, iy, k, jx, jy
      logical :: upwards
      real(wp) :: limit, displacement(2)

      associate (now => state%now, before => state%before, mx => problem%grid%mx)
         if (problem%motion /= motion%steady_rolling) then
            now%memory(carried%tau_c:carried%uply) = before%memory(carried%tau_c:carried%uply)
            if (box%ix0 > box%ix1) return
            now%memory(carried%tau_c)%value(box%ix0:box%ix1, box%iy0:box%iy1) = solution%limit
            call add(now%memory(carried%uplx)%value(box%ix0:box%ix1, box%iy0:box%iy1), solution%plastic(:, :, 1))
            call add(now%memory(carried%uply)%value(box%ix0:box%ix1, box%iy0:box%iy1), solution%plastic(:, :, 2))
            return
         end if
         ! state of an element: that of the next element upstream, plus the change in the step
         upwards = rolling_direction(problem) < 0
         do iy = 1, problem%grid%my
            limit = problem%initial_yield_limit
            displacement = 0.0_wp
            jy = iy - box%iy0 + 1
            do k = 1, mx
               ix = merge(k, mx + 1 - k, upwards)
               if (ix >= box%ix0 .and. ix <= box%ix1 .and. iy >= box%iy0 .and. iy <= box%iy1) then
                  jx = ix - box%ix0 + 1
                  limit = solution%limit(jx, jy)
                  displacement = displacement + solution%plastic(jx, jy, :)
               end if
               now%memory(carried%tau_c)%value(ix, iy) = limit
               now%memory(carried%uplx)%value(ix, iy) = displacement(1)
               now%memory(carried%uply)%value(ix, iy) = displacement(2)
            end do
         end do
      end associate

   contains

      pure subroutine add(total, change)
         real(wp), intent(inout) :: total(:, :)
         real(wp), intent(in) :: change(:, :)
         total = total + change
      end subroutine add
   end subroutine carry_yield

   !> Fields, number of plastic elements, and work of plastic deformation
   subroutine derive_yield(problem, state, solution, result)
      !> Grid, motion, and whether surfaces yield
      type(patch_problem), intent(in) :: problem
      !> Yield limits and plastic displacements; without motion those of the previous time step
      type(patch_state), intent(inout) :: state
      !> Plastic displacements of the step, on the box
      type(tangential_solution), intent(in) :: solution
      !> With numbers of elements; the fields and `nplast` are set; the work of plastic deformation is added to the frictional power
      type(patch_result), intent(inout) :: result

      if (allocated(result%tau_c)) deallocate(result%tau_c, result%uplx, result%uply)
      result%nplast = result%ncon - result%nadh - result%nslip
      if (.not. problem%remembers_yield) return
      if (problem%motion == motion%none) then
         state%now%memory(carried%tau_c:carried%uply) = state%before%memory(carried%tau_c:carried%uply)
      end if
      result%tau_c = state%now%memory(carried%tau_c)%value
      result%uplx = state%now%memory(carried%uplx)%value
      result%uply = state%now%memory(carried%uply)%value
      if (problem%motion == motion%none .or. result%ncon == 0) return
      result%friction_power = result%friction_power &
         & - problem%grid%dx*problem%grid%dy/(nmm_per_joule*result%dt)*sum(solution%p*solution%plastic)
   end subroutine derive_yield
end module contact_patch_yield
