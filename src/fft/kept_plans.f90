!> Cache of plans for lines, shared by all windows of the same length
!>
!> A plan is constant once it is made. FFTW executes it on any arrays of the same alignment, and all arrays here are aligned to
!> 16 bytes. Cached plans live as long as the process; plans that do not fit into the cache belong to their owner. All access is
!> within the critical region of the planner.
module contact_fft_kept_plans
   use, intrinsic :: iso_c_binding, only : c_null_ptr, c_ptr
   use contact_fft_library, only : destroy
   implicit none (type, external)
   private

   public :: plan_set

   !> Forward and backward
   integer, parameter :: plans_per_size = 2
   integer, parameter, public :: line_forward = 1, line_backward = 2

   !> Plans for one length
   type :: plan_set
      type(c_ptr) :: plan(plans_per_size) = c_null_ptr
      !> Are they in the cache and never freed?
      logical :: is_kept = .false.
   contains
      !> Get the plans of a length from the cache, if present; within the critical region
      procedure :: take
      !> Put new plans into the cache, if there is room; within the critical region
      procedure :: keep
      !> Free the plans, unless they are in the cache
      procedure :: release
   end type plan_set

   !> Maximum number of cached lengths, and maximum length: plans of large ones take memory
   integer, parameter :: most = 512, largest = 65536

   type :: kept_type
      integer :: n = 0
      type(c_ptr) :: plan(plans_per_size) = c_null_ptr
   end type kept_type

   integer :: n_kept = 0
   type(kept_type) :: kept(most)

contains

   subroutine take(self, n)
      !> Empty if they are not in the cache
      class(plan_set), intent(inout) :: self
      !> Length
      integer, intent(in) :: n
      integer :: k

      self%plan = c_null_ptr
      self%is_kept = .false.
      do k = 1, n_kept
         if (kept(k)%n /= n) cycle
         self%plan = kept(k)%plan
         self%is_kept = .true.
         return
      end do
   end subroutine take

   subroutine keep(self, n)
      !> Remain the caller's if there is no room
      class(plan_set), intent(inout) :: self
      !> Length
      integer, intent(in) :: n

      if (n_kept == most .or. n > largest) return
      self%is_kept = .true.
      n_kept = n_kept + 1
      kept(n_kept) = kept_type(n, self%plan)
   end subroutine keep

   subroutine release(self)
      class(plan_set), intent(inout) :: self
      integer :: k

      if (self%is_kept) then
         self%is_kept = .false.
      else
         !$omp critical (contact_fft_planner)
         do k = 1, size(self%plan)
            call destroy(self%plan(k))
         end do
         !$omp end critical (contact_fft_planner)
      end if
      self%plan = c_null_ptr
   end subroutine release
end module contact_fft_kept_plans
