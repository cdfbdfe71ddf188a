!> Evaluation of all patches at a height of the wheelset
module contact_wheelrail_trial
   use contact_base_error, only : add_context, error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_patch_problem, only : patch_state
   use contact_wheelrail_carry_over, only : lattice_box, lattice_window, max_patches
   use contact_wheelrail_geometry, only : box_on_lattice, learned_share, measure, wheel_rail_geometry, place
   use contact_wheelrail_memory, only : wheel_rail_memory, patch_slot, share_history
   use contact_wheelrail_patch_solution, only : solve_slot
   use contact_wheelrail_problem, only : wheel_rail_problem
   use contact_wheelrail_region, only : contact_region
   use contact_wheelrail_regions, only : collect_regions, remove_region
   use contact_wheelrail_variable, only : turn_of_rail
   implicit none (type, external)
   private

   public :: evaluate, learn_shares

contains

   !> Find the patches at a height, and solve them
   subroutine evaluate(problem, memory, z, with_friction, log, error)
      !> The problem of wheel and rail
      type(wheel_rail_problem), intent(in) :: problem
      !> Patches and solutions are stored in the slots 1...used
      type(wheel_rail_memory), intent(inout) :: memory
      !> Height of the wheelset above a rail without vertical deflection [mm], z down
      real(wp), intent(in) :: z
      !> Are the tangential problems solved?
      logical, intent(in) :: with_friction
      !> Receives the trace of the solvers, and warnings
      type(log_type), intent(inout) :: log
      !> Allocated if a patch has no result
      type(error_type), allocatable, intent(out) :: error
      type(lattice_box) :: boxes(max_patches)
      character(len=15) :: name
      integer :: k

      call problem%limits%deadline%check("in the search for contact", error)
      if (allocated(error)) return
      ! a gap that was measured for less penetration is measured again, with a margin for the next trials
      if (z - memory%geometry%touch > memory%geometry%gap%depth) &
         & call measure(problem, memory%geometry, memory%geometry%gap_height, 1.5_wp*(z - memory%geometry%touch))
      call place(problem, memory%geometry, z)
      memory%geometry%bodies%placement = memory%geometry%placement
      call collect_regions(memory%geometry%gap, max(z, memory%geometry%lowest_for_regions) - memory%geometry%gap_height, &
         & problem%spec%search, problem%weight_power, memory%found, memory%geometry%closer)
      if (memory%found%n > max_patches) then
         call log%warning("more than 10 contact patches; the ones with the smallest weight are left out")
         do while (memory%found%n > max_patches)
            call remove_region(memory%found, minloc(memory%found%region(:memory%found%n)%weight, dim=1))
         end do
      end if
      call match_slots(memory, memory%found%region(:memory%found%n))
      memory%used = memory%found%n
      do k = 1, memory%used
         boxes(k) = box_on_lattice(problem, memory%geometry, memory%found%region(k))
      end do
      call memory%geometry%before%share_out(boxes(:memory%used))
      memory%geometry%learned%is_taken = .false.
      do k = 1, memory%used
         memory%slot(k)%region = memory%found%region(k)
         call memory%geometry%before%find_sources(k, memory%slot(k)%previous)
         call solve_slot(problem, memory%geometry, k, memory%slot(k), with_friction, log, error)
         name = "contact patch " // achar(iachar("0") + mod(k, 10))
         if (allocated(error)) then
            call add_context(error, name)
            return
         end if
         call warn_beyond_slices(problem, memory%slot(k), name, log)
         call warn_of_angle(problem, memory%geometry, memory%slot(k)%region, name, log)
         if (memory%slot(k)%left_out > 0) call log%warning(name // ": the gap falls by more than 1 mm from one row of elements &
            &to the next; what lies beyond belongs to another part of rail or wheel and is left out.")
      end do
   end subroutine evaluate

   !> Warn that the plane of a patch is not tangent to the surfaces: on a rail that varies along the track it has the inclination of
   !> the section below the axle, unless requested otherwise
   subroutine warn_of_angle(problem, geometry, region, name, log)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_geometry), intent(inout) :: geometry
      type(contact_region), intent(in) :: region
      !> Name of the patch in messages
      character(len=*), intent(in) :: name
      type(log_type), intent(inout) :: log
      !> Minimum angle for a warning [rad]: it gives a lateral force of half a per cent of the normal force
      real(wp), parameter :: noticeable = 5.0e-3_wp
      real(wp) :: turn
      character(len=400) :: text

      if (.not. (problem%spec%search%angle_below_axle .and. allocated(problem%rail_surface))) return
      turn = turn_of_rail(geometry%bodies, region%x, region%y)
      if (abs(turn) < noticeable) return
      write(text, "(A,F6.3,A)") ": its plane has the inclination of the rail's section below the axle, as in the &
         &established program. Where wheel and rail touch they are inclined by ", turn, " rad more; lateral forces &
         &miss that part of the normal force. The angle of the contact is taken on request"
      call log%warning(name // trim(text))
   end subroutine warn_of_angle

   !> Warn that elements of a patch are outside the slices of the rail. There is no warning for a wheel with slices on a part of the
   !> circumference, which is continued with its last slice on purpose
   subroutine warn_beyond_slices(problem, slot, name, log)
      type(wheel_rail_problem), intent(in) :: problem
      type(patch_slot), intent(in) :: slot
      !> Name of the patch in messages
      character(len=*), intent(in) :: name
      type(log_type), intent(inout) :: log
      real(wp) :: s(2)
      character(len=200) :: text

      if (.not. allocated(problem%rail_surface)) return
      associate (given => problem%rail_surface%u_range, grid => slot%problem%grid)
         s = problem%spec%wheelset%s + slot%plane%origin(1) + grid%xl + [0.0_wp, grid%mx*grid%dx]
         if (.not. problem%rail_surface%part_beyond(s) > 0.0_wp) return
         write(text, "(4(A,F0.2),A)") ": its elements extend from S = ", s(1), " to ", s(2), " mm along the track, the &
            &slices of the rail from ", given(1), " to ", given(2), " mm. Beyond them the rail is that of the nearest one."
      end associate
      call log%warning(name // trim(text))
   end subroutine warn_beyond_slices

   !> Assign slots to regions such that each one continues its own solution
   subroutine match_slots(memory, regions)
      type(wheel_rail_memory), intent(inout) :: memory
      type(contact_region), intent(in) :: regions(:)
      integer :: k, j, best
      real(wp) :: overlap, largest

      do k = 1, size(regions)
         best = 0
         largest = 0.0_wp
         do j = k, memory%used
            associate (old => memory%slot(j)%region%box, new => regions(k)%box)
               overlap = min(old%y(2), new%y(2)) - max(old%y(1), new%y(1))
               ! spots that follow each other along the track are distinguished by their overlap along it
               overlap = overlap*(1.0_wp + max(0.0_wp, min(old%x(2), new%x(2)) - max(old%x(1), new%x(1))))
            end associate
            if (overlap <= largest) cycle
            largest = overlap
            best = j
         end do
         if (best > k) then
            call exchange(memory%slot(k), memory%slot(best))
         else if (best == 0) then
            memory%slot(k)%state%started = .false.
            call memory%slot(k)%shares%forget()
         end if
      end do
   end subroutine match_slots

   !> Exchange the states of two slots
   subroutine exchange(a, b)
      type(patch_slot), intent(inout) :: a, b
      type(patch_state) :: state
      type(lattice_window) :: window
      type(share_history) :: shares

      state = a%state
      a%state = b%state
      b%state = state
      window = a%solved_window
      a%solved_window = b%solved_window
      b%solved_window = window
      shares = a%shares
      a%shares = b%shares
      b%shares = shares
   end subroutine exchange

   !> Store the friction ratios of all patches
   subroutine learn_shares(memory)
      !> Solved patches on entry; the ratios are stored with their positions in `geometry%learned`
      type(wheel_rail_memory), intent(inout) :: memory
      integer :: k

      memory%geometry%shares = memory%used
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            memory%geometry%learned(k) = learned_share(slot%plane%origin(2), slot%plane%roll(), slot%friction_share)
         end associate
      end do
   end subroutine learn_shares
end module contact_wheelrail_trial
