!> Plans that are kept for all windows of one size, whoever owns them
!>
!> A plan is constant once it is made, FFTW executes it on any arrays of the same alignment, and arrays here begin at 16 bytes. A
!> contact that moves comes back to the same sizes again and again, and so do the other wheels of a vehicle. Kept plans live as
!> long as the process; what has no room is its owner's. All of this happens in the critical region of the planner.
module contact_fft_kept_plans
   use, intrinsic :: iso_c_binding, only : c_null_ptr, c_ptr
   implicit none (type, external)
   private

   public :: plan_kind, plans_per_size, take_plans, keep_plans

   type :: plan_kind_list
      !> Real transforms of one field, complex ones of two fields, and a whole period of a kernel
      integer :: single = 1, paired = 2, kernel = 3
   end type plan_kind_list
   !> What the plans of a size are for
   type(plan_kind_list), parameter :: plan_kind = plan_kind_list()

   !> Plans of one size: rows and columns, forward and backward
   integer, parameter :: plans_per_size = 4
   !> Sizes that are kept, and elements of a padded window at most: plans of large ones take memory
   integer, parameter :: most = 256, largest = 16384

   type :: kept_type
      integer :: kind = 0, my = 0, px = 0, py = 0
      type(c_ptr) :: plan(plans_per_size) = c_null_ptr
   end type kept_type

   integer :: n_kept = 0
   type(kept_type) :: kept(most)

contains

   !> Plans of a size, if they are kept
   subroutine take_plans(kind, my, px, py, plan, found)
      !> Member of plan_kind
      integer, intent(in) :: kind
      !> Rows of the window, and size of the padded window
      integer, intent(in) :: my, px, py
      !> Unchanged where they are not found
      type(c_ptr), intent(inout) :: plan(plans_per_size)
      !> Are they kept?
      logical, intent(out) :: found
      integer :: k

      found = .false.
      do k = 1, n_kept
         if (kept(k)%px /= px .or. kept(k)%py /= py .or. kept(k)%my /= my .or. kept(k)%kind /= kind) cycle
         plan = kept(k)%plan
         found = .true.
         return
      end do
   end subroutine take_plans

   !> Keep new plans, which from then on nobody frees
   subroutine keep_plans(kind, my, px, py, plan, is_kept)
      !> Member of plan_kind
      integer, intent(in) :: kind
      !> Rows of the window, and size of the padded window
      integer, intent(in) :: my, px, py
      !> Of the caller
      type(c_ptr), intent(in) :: plan(plans_per_size)
      !> False: there is no room, the plans are the caller's
      logical, intent(out) :: is_kept

      is_kept = n_kept < most .and. px*py <= largest
      if (.not. is_kept) return
      n_kept = n_kept + 1
      kept(n_kept) = kept_type(kind, my, px, py, plan)
   end subroutine keep_plans
end module contact_fft_kept_plans
