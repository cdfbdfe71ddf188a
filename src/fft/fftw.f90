!> The C interface of FFTW 3, and little else
!>
!> FFTW is seen by this room only; another library takes its place by rewriting `plan`.
module contact_fft_fftw
   use, intrinsic :: iso_c_binding
   implicit none (type, external)
   public
   include 'fftw3.f03'

contains

   !> Free a plan, if there is one; not thread-safe, see the planner
   subroutine destroy(plan)
      !> Null: there is none; null on exit
      type(c_ptr), intent(inout) :: plan

      if (c_associated(plan)) call fftw_destroy_plan(plan)
      plan = c_null_ptr
   end subroutine destroy
end module contact_fft_fftw
