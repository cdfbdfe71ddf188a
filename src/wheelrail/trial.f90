!> All patches at a height of the wheelset
module contact_wheelrail_trial
   use contact_base_error, only : add_context, error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_patch_problem, only : patch_state
   use contact_wheelrail_carry_over, only : lattice_box, lattice_window
   use contact_wheelrail_geometry, only : box_on_lattice, learned_share, measure, most_patches, place
   use contact_wheelrail_memory, only : pair_memory, patch_slot
   use contact_wheelrail_patch_solution, only : solve_slot
   use contact_wheelrail_problem, only : pair_problem
   use contact_wheelrail_regions, only : contact_region, find_regions
   implicit none (type, external)
   private

   public :: evaluate, learn_shares

contains

   !> Patches and their solutions at a height
   subroutine evaluate(problem, memory, z, with_friction, log, error)
      type(pair_problem), intent(in) :: problem
      type(pair_memory), intent(inout) :: memory
      real(wp), intent(in) :: z
      !> Solve the tangential problems, too?
      logical, intent(in) :: with_friction
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      type(contact_region), allocatable :: regions(:), misses(:)
      type(lattice_box), allocatable :: boxes(:)
      integer :: k, n

      ! a gap that was measured for less penetration is measured again, with some more to spare for the next trials
      if (z - memory%here%touch > memory%here%gap%depth) &
         & call measure(problem, memory%here, memory%here%gap_height, 1.5_wp*(z - memory%here%touch))
      call place(problem, memory%here, z)
      memory%here%bodies%placement = memory%here%placement
      call find_regions(memory%here%gap, z - memory%here%gap_height, problem%spec%search, problem%weight_power, regions, misses)
      n = size(regions)
      if (n > most_patches) then
         call log%warning("more than 10 contact patches; the ones with the smallest weight are left out")
         do while (n > most_patches)
            k = minloc(regions%weight, dim=1)
            regions = [regions(:k - 1), regions(k + 1:)]
            n = n - 1
         end do
      end if
      call match_slots(memory, regions)
      memory%used = n
      allocate(boxes(n))
      do k = 1, n
         boxes(k) = box_on_lattice(problem, memory%here, regions(k))
      end do
      call memory%here%before%share_out(boxes)
      do k = 1, n
         memory%slot(k)%region = regions(k)
         memory%slot(k)%previous = memory%here%before%sources(k)
         call solve_slot(problem, memory%here, k, memory%slot(k), with_friction, log, error)
         if (allocated(error)) then
            call add_context(error, "contact patch " // achar(iachar("0") + mod(k, 10)))
            return
         end if
      end do
   end subroutine evaluate

   !> Bring the slots into the order of the regions, so that each one continues its own solution
   subroutine match_slots(memory, regions)
      type(pair_memory), intent(inout) :: memory
      type(contact_region), intent(in) :: regions(:)
      integer :: k, j, best
      real(wp) :: overlap, largest

      do k = 1, size(regions)
         best = 0
         largest = 0.0_wp
         do j = k, memory%used
            associate (old => memory%slot(j)%region%box%y, new => regions(k)%box%y)
               overlap = min(old(2), new(2)) - max(old(1), new(1))
            end associate
            if (overlap <= largest) cycle
            largest = overlap
            best = j
         end do
         if (best > k) then
            call exchange(memory%slot(k), memory%slot(best))
         else if (best == 0) then
            memory%slot(k)%state%started = .false.
         end if
      end do
   end subroutine match_slots

   !> Two slots change their memories
   subroutine exchange(a, b)
      type(patch_slot), intent(inout) :: a, b
      type(patch_state) :: state
      type(lattice_window) :: window

      state = a%state
      a%state = b%state
      b%state = state
      window = a%solved_window
      a%solved_window = b%solved_window
      b%solved_window = window
   end subroutine exchange

   !> Remember the forces of friction of all patches
   subroutine learn_shares(memory)
      type(pair_memory), intent(inout) :: memory
      integer :: k

      memory%here%shares = memory%used
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            memory%here%learned(k) = learned_share(slot%plane%origin(2), slot%plane%roll(), slot%friction_share)
         end associate
      end do
   end subroutine learn_shares
end module contact_wheelrail_trial
