!> Data that a pair keeps from trial to trial and from case to case, and its sums over the patches
module contact_wheelrail_memory
   use contact_base_choices, only : motion
   use contact_base_kinds, only : wp
   use contact_friction_law, only : friction_set
   use contact_patch_error_estimate, only : coarse_level, release_coarse_level
   use contact_patch_problem, only : patch_problem, patch_state
   use contact_patch_result, only : patch_result
   use contact_patch_workspace, only : patch_workspace, release_workspace
   use contact_wheelrail_carry_over, only : carried_step, lattice_window, max_patches
   use contact_wheelrail_course, only : course_type, power
   use contact_wheelrail_creepage, only : contact_motion
   use contact_wheelrail_curved_patch, only : curved_reference
   use contact_wheelrail_flat_patch, only : distance_scratch
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_geometry, only : wheel_rail_geometry
   use contact_wheelrail_region, only : contact_region
   use contact_wheelrail_regions, only : found_regions
   implicit none (type, external)
   private

   public :: make_coarse_level, make_coarse_workspace, make_slots, patch_slot, share_history, wheel_rail_memory, release_wheel_rail
   public :: force_not_estimated, sum_of_normal_forces, total_force, vertical_force, vertical_slope

   !> Ratios of friction to normal force of a patch [-], in the axes x, s, n of its plane
   type :: share_history
      !> Number of cases that are known, at most 2, and their ratios, the last one first
      integer, private :: known = 0
      real(wp), private :: share(3, 2) = 0.0_wp
      !> Estimate in the last trial without tangential problem
      real(wp) :: estimate(3) = 0.0_wp
   contains
      !> Add that of a case
      procedure :: note
      !> Estimate that of the next case
      procedure :: extrapolate
      procedure :: forget
   end type share_history

   !> One patch with its data
   type :: patch_slot
      type(patch_problem) :: problem
      type(patch_state) :: state
      type(patch_workspace) :: workspace
      !> Workspace of trials on coarser elements; unallocated before there are any
      type(patch_workspace), allocatable :: coarse_workspace
      type(patch_result) :: result
      !> The coarse level for error estimates; unallocated until they are requested
      type(coarse_level), allocatable :: coarse
      !> Few rows of elements, finer, for error estimates; unallocated until they are requested
      type(coarse_level), allocatable :: rows
      type(contact_region) :: region
      type(frame) :: plane
      !> Curved reference surface; unallocated for a flat patch whose slip is that of its reference
      type(curved_reference), allocatable :: curve
      !> Heights of rail and wheel over that surface [mm], shape (mx, my)
      real(wp), allocatable :: on_rail(:, :), on_wheel(:, :)
      type(contact_motion) :: motion
      !> If friction varies over the rail: one set of parameters or one per row; otherwise unallocated
      type(friction_set), allocatable :: friction(:)
      !> Position of the contact reference on the lattice of the pair [mm]
      real(wp) :: reference(2) = 0.0_wp
      !> Window of the grid on the lattice, and window of the solution in `state`
      type(lattice_window) :: window, solved_window
      !> Data that the undeformed distance keeps from trial to trial
      type(distance_scratch) :: distance
      !> Number of elements left out because the gap jumps between them and the reference; see `shift_distance`
      integer :: left_out = 0
      !> Patches of the previous time step that this one continues
      integer, allocatable :: previous(:)
      !> Forces [N] and moment [N mm] on the rail in the axes x, s, n of the plane
      real(wp) :: force(3) = 0.0_wp, moment(3) = 0.0_wp
      !> Force due to pressures on the rail in the axes x, s, n of the plane [N]
      real(wp) :: pressure_force(3) = 0.0_wp
      !> Force of friction in the same axes, relative to the normal force [-]: of the last tangential
      !> solution, or an estimate
      real(wp) :: friction_share(3) = 0.0_wp
      !> Those of the last cases in a loop over time
      type(share_history) :: shares
   end type patch_slot

   !> Data of a pair that are kept from case to case, and workspace
   type :: wheel_rail_memory
      !> Height of the wheelset above a rail without vertical deflection in the previous case [mm]
      real(wp) :: z_ws = 0.0_wp
      logical :: started = .false.
      !> Number of patches of the last evaluation, slots 1...used
      integer :: used = 0
      type(patch_slot), allocatable :: slot(:)
      type(wheel_rail_geometry) :: geometry
      !> Regions of the last trial
      type(found_regions) :: found
      !> Tractions of the last solved case
      type(carried_step) :: last
      !> Motion of the last case
      integer :: motion = motion%none
      !> Heights of the last cases of a time loop
      type(course_type) :: course
   end type wheel_rail_memory

contains

   ! Data with initial values are allocated here, not where they are used: the compiler makes a copy of the values on the stack,
   ! of up to 40 kB, which lasts as long as the procedure

   !> Allocate the patches of a pair, unless they are there
   subroutine make_slots(memory)
      !> Data of the pair
      type(wheel_rail_memory), intent(inout) :: memory

      if (.not. allocated(memory%slot)) allocate(memory%slot(max_patches))
   end subroutine make_slots

   !> Allocate the work space of trials with larger elements, unless it is there
   subroutine make_coarse_workspace(slot)
      !> Patch with such trials
      type(patch_slot), intent(inout) :: slot

      if (.not. allocated(slot%coarse_workspace)) allocate(slot%coarse_workspace)
   end subroutine make_coarse_workspace

   !> Allocate the coarse level of an estimate of errors, and that of finer rows, unless they are there
   subroutine make_coarse_level(slot)
      !> Solved patch
      type(patch_slot), intent(inout) :: slot

      if (.not. allocated(slot%coarse)) allocate(slot%coarse)
      if (.not. allocated(slot%rows)) allocate(slot%rows)
   end subroutine make_coarse_level

   !> Release the memory that is allocated outside Fortran
   subroutine release_wheel_rail(memory)
      !> Workspaces of all patches are released; tractions are kept
      type(wheel_rail_memory), intent(inout) :: memory
      integer :: k

      if (.not. allocated(memory%slot)) return
      do k = 1, size(memory%slot)
         call release_workspace(memory%slot(k)%workspace)
         if (allocated(memory%slot(k)%coarse_workspace)) call release_workspace(memory%slot(k)%coarse_workspace)
         if (allocated(memory%slot(k)%coarse)) call release_coarse_level(memory%slot(k)%coarse)
         if (allocated(memory%slot(k)%rows)) call release_coarse_level(memory%slot(k)%rows)
      end do
   end subroutine release_wheel_rail

   pure subroutine note(self, share)
      class(share_history), intent(inout) :: self
      !> Ratio of a solved case [-]
      real(wp), intent(in) :: share(3)

      self%share(:, 2) = self%share(:, 1)
      self%share(:, 1) = share
      self%known = min(2, self%known + 1)
   end subroutine note

   pure subroutine extrapolate(self, ahead, share)
      class(share_history), intent(in) :: self
      !> Multiple of the difference of the last two cases that is added to the last one [-]
      real(wp), intent(in) :: ahead
      !> Not changed if no case is known [-]
      real(wp), intent(inout) :: share(3)

      if (self%known > 0) share = self%share(:, 1)
      if (self%known > 1) share = share + ahead*(share - self%share(:, 2))
   end subroutine extrapolate

   pure subroutine forget(self)
      class(share_history), intent(inout) :: self
      self%known = 0
   end subroutine forget

   !> Sum of the normal forces of all patches [N]
   pure real(wp) function sum_of_normal_forces(memory) result(total)
      !> Solved patches
      type(wheel_rail_memory), intent(in) :: memory
      integer :: k

      total = 0.0_wp
      do k = 1, memory%used
         total = total + memory%slot(k)%result%fn
      end do
   end function sum_of_normal_forces

   !> Force on the rail in track axes [N], friction from the last tangential solution
   pure function total_force(memory) result(force)
      !> Patches of the last trial
      type(wheel_rail_memory), intent(in) :: memory
      real(wp) :: force(3)
      integer :: k

      force = 0.0_wp
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            force = force + matmul(slot%plane%axes, slot%pressure_force + slot%friction_share*slot%result%fn)
         end associate
      end do
   end function total_force

   !> Vertical force on the rail [N], friction from the last tangential solution
   pure real(wp) function vertical_force(memory) result(force)
      !> Patches of the last trial
      type(wheel_rail_memory), intent(in) :: memory
      real(wp) :: all(3)

      all = total_force(memory)
      force = all(3)
   end function vertical_force

   !> Part of the vertical force due to the difference of the friction ratios from their estimates in the trial before [N]
   pure real(wp) function force_not_estimated(memory) result(force)
      !> Patches of the last trial, of which the one before had estimated ratios
      type(wheel_rail_memory), intent(in) :: memory
      integer :: k

      force = 0.0_wp
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            force = force + dot_product(slot%plane%axes(3, :), slot%friction_share - slot%shares%estimate)*slot%result%fn
         end associate
      end do
   end function force_not_estimated

   !> Derivative of the vertical force with respect to the height, from the contact stiffness if it is known [N/mm]
   pure real(wp) function vertical_slope(memory, estimated) result(slope)
      !> Patches of the last trial
      type(wheel_rail_memory), intent(in) :: memory
      !> Is Hertz's stiffness used for a patch whose stiffness is not known? Otherwise 0
      logical, intent(in) :: estimated
      real(wp) :: stiffness
      integer :: k

      slope = 0.0_wp
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            if (.not. slot%result%fn > 0.0_wp) cycle
            stiffness = slot%result%sensitivity(1, 1)
            if (estimated .and. slot%result%pen > 0.0_wp .and. .not. stiffness > 0.0_wp) &
               & stiffness = slot%result%fn/(power*slot%result%pen)
            ! the normal force changes by the stiffness, and the vertical force with it
            slope = slope + slot%plane%axes(3, 3)*stiffness &
               & *dot_product(slot%plane%axes(3, :), slot%pressure_force/slot%result%fn + slot%friction_share)
         end associate
      end do
   end function vertical_slope
end module contact_wheelrail_memory
