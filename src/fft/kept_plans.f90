!> Plans that are kept for all windows of one size, whoever owns them
!>
!> A plan is constant once it is made, FFTW executes it on any arrays of the same alignment, and arrays here begin at 16 bytes. A
!> contact that moves comes back to the same sizes again and again, and so do the other wheels of a vehicle. Kept plans live as
!> long as the process; what has no room is its owner's. All of this happens in the critical region of the planner.
module contact_fft_kept_plans
   use, intrinsic :: iso_c_binding, only : c_null_ptr, c_ptr
   use contact_fft_library, only : destroy
   implicit none (type, external)
   private

   public :: plan_kind, plan_set

   type :: plan_kind_list
      !> Lines of one length, and two fields on a window
      integer :: lines = 1, paired = 2
   end type plan_kind_list
   !> What the plans of a size are for
   type(plan_kind_list), parameter :: plan_kind = plan_kind_list()

   !> Rows forward, rows backward, columns forward, columns backward; lines forward and backward only, the others are null
   integer, parameter :: plans_per_size = 4
   integer, parameter, public :: row_forward = 1, row_backward = 2, column_forward = 3, column_backward = 4
   integer, parameter, public :: line_forward = 1, line_backward = 2

   !> Plans of one size
   type :: plan_set
      type(c_ptr) :: plan(plans_per_size) = c_null_ptr
      !> Are they those of all windows of this size, which nobody frees?
      logical :: is_kept = .false.
   contains
      !> Take those of a size, if they are kept; in the critical region
      procedure :: take
      !> Keep new ones, if there is room; in the critical region
      procedure :: keep
      !> Free them, unless they are kept
      procedure :: release
   end type plan_set

   !> Sizes that are kept, and elements of a padded window or of a line at most: plans of large ones take memory
   integer, parameter :: most = 256, largest = 65536

   type :: kept_type
      integer :: kind = 0, my = 0, px = 0, py = 0
      type(c_ptr) :: plan(plans_per_size) = c_null_ptr
   end type kept_type

   integer :: n_kept = 0
   type(kept_type) :: kept(most)

contains

   subroutine take(self, kind, my, px, py)
      !> Empty where they are not kept
      class(plan_set), intent(inout) :: self
      !> Member of plan_kind
      integer, intent(in) :: kind
      !> Rows of the window, and size of the padded window; lines at once, their length, and 1
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
      !> The caller's own where there is no room
      class(plan_set), intent(inout) :: self
      !> Member of plan_kind
      integer, intent(in) :: kind
      !> Rows of the window, and size of the padded window; lines at once, their length, and 1
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
