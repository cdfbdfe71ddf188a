!> Cache of plans, shared by all windows of the same size
!>
!> A plan is constant once it is made. FFTW executes it on any arrays of the same alignment, and all arrays here are aligned to
!> 16 bytes. A moving contact returns to the same sizes again and again, and so do the other wheels of a vehicle. Cached plans
!> live as long as the process; plans that do not fit into the cache belong to their owner. All access is within the critical
!> region of the planner.
module contact_fft_kept_plans
   use, intrinsic :: iso_c_binding, only : c_null_ptr, c_ptr
   use contact_base_kinds, only : wp
   use contact_fft_library, only : destroy, forwards, plan_complex
   implicit none (type, external)
   private

   public :: plan_kind, plan_set, start_planner

   type :: plan_kind_list
      !> For lines of one length; for the rows and for the columns of two fields on a window
      integer :: lines = 1, paired_rows = 2, paired_columns = 3
   end type plan_kind_list
   !> Purposes of plans
   type(plan_kind_list), parameter :: plan_kind = plan_kind_list()

   !> Forward and backward
   integer, parameter :: plans_per_size = 2
   integer, parameter, public :: line_forward = 1, line_backward = 2

   !> Plans for one size
   type :: plan_set
      type(c_ptr) :: plan(plans_per_size) = c_null_ptr
      !> Are they in the cache and never freed?
      logical :: is_kept = .false.
   contains
      !> Get the plans of a size from the cache, if present; within the critical region
      procedure :: take
      !> Put new plans into the cache, if there is room; within the critical region
      procedure :: keep
      !> Free the plans, unless they are in the cache
      procedure :: release
   end type plan_set

   !> Maximum number of cached sizes, and maximum size of a padded window or a line: plans of large ones take memory
   integer, parameter :: most = 512, largest = 65536

   type :: kept_type
      integer :: kind = 0, my = 0, px = 0, py = 0
      type(c_ptr) :: plan(plans_per_size) = c_null_ptr
   end type kept_type

   integer :: n_kept = 0
   type(kept_type) :: kept(most)

contains

   !> Start the planner of the library, which takes FFTW some tenths of a millisecond: for who prepares a loop over time
   subroutine start_planner()
      complex(wp) :: from(2), to(2)
      type(c_ptr) :: plan

      !$omp critical (contact_fft_planner)
      plan = plan_complex(2, 1, from, 1, 2, to, 1, 2, forwards)
      call destroy(plan)
      !$omp end critical (contact_fft_planner)
   end subroutine start_planner

   subroutine take(self, kind, my, px, py)
      !> Empty if they are not in the cache
      class(plan_set), intent(inout) :: self
      !> Member of plan_kind
      integer, intent(in) :: kind
      !> Number of rows, or 0 for columns, and size of the padded window; for lines their number, their length, and 1
      integer, intent(in) :: my, px, py
      integer :: k

      self%plan = c_null_ptr
      self%is_kept = .false.
      do k = 1, n_kept
         if (kept(k)%px /= px .or. kept(k)%py /= py .or. kept(k)%my /= my .or. kept(k)%kind /= kind) cycle
         self%plan = kept(k)%plan
         self%is_kept = .true.
         return
      end do
   end subroutine take

   subroutine keep(self, kind, my, px, py)
      !> Remain the caller's if there is no room
      class(plan_set), intent(inout) :: self
      !> Member of plan_kind
      integer, intent(in) :: kind
      !> Number of rows, or 0 for columns, and size of the padded window; for lines their number, their length, and 1
      integer, intent(in) :: my, px, py

      if (n_kept == most .or. px*py > largest) return
      self%is_kept = .true.
      n_kept = n_kept + 1
      kept(n_kept) = kept_type(kind, my, px, py, self%plan)
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
