!> Transforms by pocketfft, whose licence allows distribution with any program; see library_fftw.f90
module contact_fft_library
   use, intrinsic :: iso_c_binding, only : c_associated, c_double_complex, c_int, c_null_ptr, c_ptr
   implicit none (type, external)
   private

   public :: backwards, destroy, execute_complex, fast_lengths, forwards, plan_complex

   !> Even lengths that are transformed fast; above them any product of small primes is
   integer, parameter :: fast_lengths(*) = [2, 4, 6, 8, 10, 12, 14, 16, 20, 32, 40, 48, 56, 64, 72, 80, 96, 112, 128]

   !> Directions of complex transforms
   integer, parameter :: forwards = -1, backwards = 1

   interface
      type(c_ptr) function plan_complex(n, many, from, stride, distance, to, to_stride, to_distance, direction) &
         & bind(c, name="contact_pocketfft_complex")
         import :: c_double_complex, c_int, c_ptr
         implicit none (type, external)
         !> Length and number of the transforms, strides within and between them in either array, and the direction
         integer(c_int), value :: n, many, stride, distance, to_stride, to_distance, direction
         !> Values to be transformed, and transformed values
         complex(c_double_complex), intent(inout) :: from(*), to(*)
      end function plan_complex

      subroutine execute_complex(plan, from, to) bind(c, name="contact_pocketfft_run_complex")
         import :: c_double_complex, c_ptr
         implicit none (type, external)
         !> Plan of the same kind
         type(c_ptr), value :: plan
         !> Values to be transformed; overwritten by backward transforms
         complex(c_double_complex), intent(inout) :: from(*)
         !> Transformed values
         complex(c_double_complex), intent(inout) :: to(*)
      end subroutine execute_complex

      subroutine delete_plan(plan) bind(c, name="contact_pocketfft_destroy")
         import :: c_ptr
         implicit none (type, external)
         !> Plan of the same kind
         type(c_ptr), value :: plan
      end subroutine delete_plan
   end interface

contains

   !> Free a plan if it exists
   subroutine destroy(plan)
      !> May be null; null on exit
      type(c_ptr), intent(inout) :: plan

      if (c_associated(plan)) call delete_plan(plan)
      plan = c_null_ptr
   end subroutine destroy
end module contact_fft_library
