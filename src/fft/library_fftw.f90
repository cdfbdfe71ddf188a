!> Transforms by FFTW 3 or another library with its interface
!>
!> CONTACT_FFT selects library_fftw or library_pocketfft, which contain the same module. The rest of the room is independent of
!> the library.
module contact_fft_library
   use, intrinsic :: iso_c_binding, only : c_associated, c_null_ptr, c_ptr
   use contact_base_kinds, only : wp
   use contact_fft_fftw, only : backwards => fftw_backward, execute_complex => fftw_execute_dft, fftw_destroy_plan, &
      & fftw_estimate, fftw_plan_many_dft, forwards => fftw_forward
   implicit none (type, external)
   private

   public :: backwards, destroy, execute_complex, fast_lengths, forwards, plan_complex

   !> Even lengths for which estimated plans are fast, by measurement: no longer length takes less time, including its larger
   !> spectrum. Plans of lengths with a factor 3 are often slow: 640 takes little more than half the time of 576, and 160 that
   !> of 144
   integer, parameter :: fast_lengths(*) = [2, 4, 6, 8, 10, 12, 14, 16, 20, 32, 40, 48, 56, 64, 72, 80, 96, 112, 128, &
      & 140, 160, 200, 224, 240, 256, 280, 320, 400, 448, 512, 640, 768, 800, 1024, 1120, 1280, 1440, 1536, 1600, 2048, 2240, &
      & 2304, 2560]

contains
   !> Plan for a number of complex transforms of one length; null on failure. Like all planners not thread-safe
   type(c_ptr) function plan_complex(n, many, from, stride, distance, to, to_stride, to_distance, direction) result(plan)
      !> Length and number of the transforms
      integer, intent(in) :: n, many
      !> Arrays of the kind to be transformed, source and target; their values may be overwritten
      complex(wp), intent(inout) :: from(*), to(*)
      !> Strides within a transform and between transforms, in either array
      integer, intent(in) :: stride, distance, to_stride, to_distance
      !> forwards or backwards
      integer, intent(in) :: direction

      plan = fftw_plan_many_dft(1, [n], many, from, [n], stride, distance, to, [n], to_stride, to_distance, &
         & direction, fftw_estimate)
   end function plan_complex

   !> Free a plan if it exists; not thread-safe, see the planner
   subroutine destroy(plan)
      !> May be null; null on exit
      type(c_ptr), intent(inout) :: plan

      if (c_associated(plan)) call fftw_destroy_plan(plan)
      plan = c_null_ptr
   end subroutine destroy
end module contact_fft_library
