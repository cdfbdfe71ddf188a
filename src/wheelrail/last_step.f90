!> Last step of a search for the height: a linear extrapolation of the solved patches to the prescribed force
module contact_wheelrail_last_step
   use contact_base_choices, only : motion
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_patch_small_step, only : small_step, step_with_tractions
   use contact_wheelrail_memory, only : vertical_force, wheel_rail_memory
   use contact_wheelrail_patch_solution, only : can_step_all, find_forces, update_share
   use contact_wheelrail_problem, only : wheel_rail_problem
   implicit none (type, external)
   private

   public :: balance_point, can_finish, fine_tractions, finish, smooth_part

   !> Height and force of the last trial, and the force that is searched
   type :: balance_point
      !> Prescribed force and its tolerance [N]
      real(wp) :: target = 0.0_wp, tolerance = 0.0_wp
      !> Stiffness of a spring [N/mm], and height at which it has no force [mm]
      real(wp) :: spring = 0.0_wp, touch = 0.0_wp
      !> Height [mm], force [N] and its derivative [N/mm]
      real(wp) :: z = 0.0_wp, force = 0.0_wp, derivative = 0.0_wp
      !> Ratio of the derivative to its value by the stiffness of the contacts [-]
      real(wp) :: stiffer = 1.0_wp
   end type balance_point

   !> If a trial misses the force by less than `finished` times EPS, the rest may be a linear extrapolation, which neglects the
   !> rotation of patches: this effect may be at most `turned` times EPS of the force
   real(wp), parameter :: finished = 20.0_wp, turned = 0.2_wp
   !> The same for approximate pressures, which are scaled: the derivative of their force is known to a tenth
   real(wp), parameter :: finished_scaled = 2.0_wp
   !> Maximum number of steps of this extrapolation
   integer, parameter :: max_rounds = 4
   !> Fraction of EPS to be reached by a search that follows the last case
   real(wp), parameter :: smooth = 0.02_wp
   !> Tolerance of tangential tractions relative to that of the pressures
   real(wp), parameter :: smooth_tractions = 5.0_wp

contains

   !> Is a linear extrapolation from the last trial accurate enough?
   pure logical function can_finish(tolerance, miss, stiffer, has_derivative)
      !> Tolerance of the force [N]
      real(wp), intent(in) :: tolerance
      !> Deviation of the force in the trial [N], and ratio of its derivative to the value by the stiffness [-]
      real(wp), intent(in) :: miss, stiffer
      !> Are pressures those of the full theory, whose derivative is known? Others are scaled
      logical, intent(in) :: has_derivative

      can_finish = miss <= tolerance
      if (has_derivative) then
         can_finish = can_finish .or. (miss <= finished*tolerance .and. abs(stiffer - 1.0_wp)*miss <= turned*tolerance)
      else
         can_finish = can_finish .or. miss <= finished_scaled*tolerance
      end if
   end function can_finish

   !> Last Newton step as a linear extrapolation, if all patches allow it: to the prescribed force itself
   !>
   !> If the deviation exceeds EPS, or if tractions are rough, they are solved anew, which changes the force, and another step
   !> follows: one within EPS scales them to the force.
   subroutine finish(problem, memory, has_rough_tractions, point, log, is_done)
      !> The problem of wheel and rail
      type(wheel_rail_problem), intent(in) :: problem
      !> Solved patches; updated to the new height
      type(wheel_rail_memory), intent(inout) :: memory
      !> Were tractions solved with the tolerance of a first trial?
      logical, intent(in) :: has_rough_tractions
      !> The last trial on entry, the new height and force on exit
      type(balance_point), intent(inout) :: point
      !> Receives the trace of the solvers
      type(log_type), intent(inout) :: log
      !> Was the force reached? Otherwise another trial is needed, also if the tractions of a patch were not found
      logical, intent(out) :: is_done
      logical :: is_far
      real(wp) :: step
      integer :: k, round

      is_done = .false.
      if (.not. point%derivative > 0.0_wp .or. memory%used == 0) return
      if (.not. can_step_all(memory)) return
      is_far = abs(point%force - point%target) > point%tolerance .or. has_rough_tractions
      if (has_rough_tractions) then
         do k = 1, memory%used
            memory%slot(k)%problem%traction_eps = fine_tractions(problem)
         end do
      end if
      do round = 1, max_rounds
         step = (point%target - point%force)/point%derivative
         do k = 1, memory%used
            associate (slot => memory%slot(k), change => point%stiffer*memory%slot(k)%plane%axes(3, 3)*step)
               ! rotation and displacement of patches increase the stiffness; the step of each patch includes this factor
               if (is_far) then
                  call step_with_tractions(slot%problem, change, slot%state, slot%workspace, log, slot%result)
                  if (.not. slot%result%tangential%succeeded()) return
               else
                  call small_step(slot%problem, change, slot%state, slot%result)
               end if
               call find_forces(slot)
               ! new tractions have another ratio to the pressures
               if (is_far .and. slot%problem%motion /= motion%none) call update_share(slot)
            end associate
         end do
         point%z = point%z + step
         point%force = vertical_force(memory) + point%spring*(point%z - point%touch)
         is_done = .not. is_far
         if (is_done .or. .not. can_finish(point%tolerance, abs(point%force - point%target), point%stiffer, .true.)) return
         is_far = abs(point%force - point%target) > point%tolerance
      end do
   end subroutine finish

   !> Accuracy of the force relative to EPS, to limit noise between cases [-]
   pure real(wp) function smooth_part(problem)
      !> The problem of wheel and rail, with EPS
      type(wheel_rail_problem), intent(in) :: problem
      !> Relative forces below this value are affected by round-off and residuals of iterations
      real(wp), parameter :: finest = 1.0e-8_wp

      smooth_part = min(1.0_wp, max(smooth, finest/problem%template%settings%eps))
   end function smooth_part

   !> Tolerance of tangential tractions relative to EPS [-]
   pure real(wp) function fine_tractions(problem)
      !> The problem of wheel and rail, with EPS
      type(wheel_rail_problem), intent(in) :: problem

      fine_tractions = min(1.0_wp, smooth_tractions*smooth_part(problem))
   end function fine_tractions
end module contact_wheelrail_last_step
