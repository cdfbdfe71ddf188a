!> Transforms by FFTW 3, or by another library with its interface
!>
!> Of library_fftw and library_pocketfft, which hold one module, CONTACT_FFT chooses one. The rest of the room knows no library.
module contact_fft_library
   use, intrinsic :: iso_c_binding, only : c_associated, c_null_ptr, c_ptr
   use contact_base_kinds, only : wp
   use contact_fft_fftw, only : backwards => fftw_backward, execute_backward => fftw_execute_dft_c2r, &
      & execute_complex => fftw_execute_dft, execute_forward => fftw_execute_dft_r2c, fftw_destroy_input, fftw_destroy_plan, &
      & fftw_estimate, fftw_plan_dft_r2c_2d, fftw_plan_many_dft, fftw_plan_many_dft_c2r, fftw_plan_many_dft_r2c, &
      & forwards => fftw_forward
   implicit none (type, external)
   private

   public :: plan_complex, plan_forward, plan_backward, plan_plane, forwards, backwards
   public :: execute_complex, execute_forward, execute_backward, destroy

contains
   !> Plan for some complex transforms of one length; null where there is none. Like all planners not thread-safe
   type(c_ptr) function plan_complex(n, many, from, stride, distance, to, to_stride, to_distance, direction) result(plan)
      !> Length and number of the transforms
      integer, intent(in) :: n, many
      !> Arrays of the kind that will be transformed, from one to another; their values may be lost
      complex(wp), intent(inout) :: from(*), to(*)
      !> Steps between the elements of one transform, and between the first elements of two, in either array
      integer, intent(in) :: stride, distance, to_stride, to_distance
      !> forwards or backwards
      integer, intent(in) :: direction

      plan = fftw_plan_many_dft(1, [n], many, from, [n], stride, distance, to, [n], to_stride, to_distance, &
         & direction, fftw_estimate)
   end function plan_complex

   !> Plan for some transforms of real values to their n/2 + 1 coefficients
   type(c_ptr) function plan_forward(n, many, from, stride, distance, to, to_stride, to_distance) result(plan)
      !> As for complex transforms
      integer, intent(in) :: n, many
      !> The real values, as for complex transforms
      real(wp), intent(inout) :: from(*)
      !> Their coefficients
      complex(wp), intent(inout) :: to(*)
      !> As for complex transforms
      integer, intent(in) :: stride, distance, to_stride, to_distance

      plan = fftw_plan_many_dft_r2c(1, [n], many, from, [n], stride, distance, to, [n/2 + 1], to_stride, &
         & to_distance, fftw_estimate)
   end function plan_forward

   !> Plan for some transforms of coefficients back to n real values; it may destroy the coefficients
   type(c_ptr) function plan_backward(n, many, from, stride, distance, to, to_stride, to_distance) result(plan)
      !> As for complex transforms
      integer, intent(in) :: n, many
      !> The coefficients, as for complex transforms
      complex(wp), intent(inout) :: from(*)
      !> Their real values
      real(wp), intent(inout) :: to(*)
      !> As for complex transforms
      integer, intent(in) :: stride, distance, to_stride, to_distance

      plan = fftw_plan_many_dft_c2r(1, [n], many, from, [n/2 + 1], stride, distance, to, [n], to_stride, to_distance, &
         & ior(fftw_estimate, fftw_destroy_input))
   end function plan_backward

   !> Plan for the transform of a plane of real values in both directions
   type(c_ptr) function plan_plane(rows, columns, from, to) result(plan)
      !> Number of rows, and their length
      integer, intent(in) :: rows, columns
      !> Real values, shape (columns, rows)
      real(wp), intent(inout) :: from(*)
      !> Coefficients, shape (columns/2 + 1, rows)
      complex(wp), intent(inout) :: to(*)

      plan = fftw_plan_dft_r2c_2d(rows, columns, from, to, fftw_estimate)
   end function plan_plane

   !> Free a plan, if there is one; not thread-safe, see the planner
   subroutine destroy(plan)
      !> Null: there is none; null on exit
      type(c_ptr), intent(inout) :: plan

      if (c_associated(plan)) call fftw_destroy_plan(plan)
      plan = c_null_ptr
   end subroutine destroy
end module contact_fft_library
