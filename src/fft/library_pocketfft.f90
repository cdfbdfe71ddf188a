!> Transforms by pocketfft, which may be handed on with programs of any licence; see library_fftw.f90
module contact_fft_library
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_double_complex, c_int, c_null_ptr, c_ptr
   implicit none (type, external)
   private

   public :: plan_complex, plan_forward, plan_backward, plan_plane, forwards, backwards
   public :: execute_complex, execute_forward, execute_backward, destroy

   !> Directions of complex transforms
   integer, parameter :: forwards = -1, backwards = 1

   interface
      type(c_ptr) function plan_complex(n, many, from, stride, distance, to, to_stride, to_distance, direction) &
         & bind(c, name="contact_pocketfft_complex")
         import :: c_double_complex, c_int, c_ptr
         implicit none (type, external)
         !> Length and number of the transforms, steps inside of one and between two in either array, and the direction
         integer(c_int), value :: n, many, stride, distance, to_stride, to_distance, direction
         !> Values to be transformed, and what they become
         complex(c_double_complex), intent(inout) :: from(*), to(*)
      end function plan_complex

      type(c_ptr) function plan_forward(n, many, from, stride, distance, to, to_stride, to_distance) &
         & bind(c, name="contact_pocketfft_forward")
         import :: c_double, c_double_complex, c_int, c_ptr
         implicit none (type, external)
         !> Length and number of the transforms, steps inside of one and between two in either array, and the direction
         integer(c_int), value :: n, many, stride, distance, to_stride, to_distance
         !> Values to be transformed; those that go back may be lost
         real(c_double), intent(inout) :: from(*)
         !> Gets the transformed values
         complex(c_double_complex), intent(inout) :: to(*)
      end function plan_forward

      type(c_ptr) function plan_backward(n, many, from, stride, distance, to, to_stride, to_distance) &
         & bind(c, name="contact_pocketfft_backward")
         import :: c_double, c_double_complex, c_int, c_ptr
         implicit none (type, external)
         !> Length and number of the transforms, steps inside of one and between two in either array, and the direction
         integer(c_int), value :: n, many, stride, distance, to_stride, to_distance
         !> Values to be transformed; those that go back may be lost
         complex(c_double_complex), intent(inout) :: from(*)
         !> Gets the transformed values
         real(c_double), intent(inout) :: to(*)
      end function plan_backward

      type(c_ptr) function plan_plane(rows, columns, from, to) bind(c, name="contact_pocketfft_plane")
         import :: c_double, c_double_complex, c_int, c_ptr
         implicit none (type, external)
         !> Number of rows, and their length
         integer(c_int), value :: rows, columns
         !> Values to be transformed; those that go back may be lost
         real(c_double), intent(inout) :: from(*)
         !> Gets the transformed values
         complex(c_double_complex), intent(inout) :: to(*)
      end function plan_plane

      subroutine execute_complex(plan, from, to) bind(c, name="contact_pocketfft_run_complex")
         import :: c_double_complex, c_ptr
         implicit none (type, external)
         !> A plan of the same kind
         type(c_ptr), value :: plan
         !> Values to be transformed; those that go back may be lost
         complex(c_double_complex), intent(inout) :: from(*)
         !> Gets the transformed values
         complex(c_double_complex), intent(inout) :: to(*)
      end subroutine execute_complex

      subroutine execute_forward(plan, from, to) bind(c, name="contact_pocketfft_run_forward")
         import :: c_double, c_double_complex, c_ptr
         implicit none (type, external)
         !> A plan of the same kind
         type(c_ptr), value :: plan
         !> Values to be transformed; those that go back may be lost
         real(c_double), intent(inout) :: from(*)
         !> Gets the transformed values
         complex(c_double_complex), intent(inout) :: to(*)
      end subroutine execute_forward

      subroutine execute_backward(plan, from, to) bind(c, name="contact_pocketfft_run_backward")
         import :: c_double, c_double_complex, c_ptr
         implicit none (type, external)
         !> A plan of the same kind
         type(c_ptr), value :: plan
         !> Values to be transformed; those that go back may be lost
         complex(c_double_complex), intent(inout) :: from(*)
         !> Gets the transformed values
         real(c_double), intent(inout) :: to(*)
      end subroutine execute_backward

      subroutine delete_plan(plan) bind(c, name="contact_pocketfft_destroy")
         import :: c_ptr
         implicit none (type, external)
         !> A plan of the same kind
         type(c_ptr), value :: plan
      end subroutine delete_plan
   end interface

contains

   !> Free a plan, if there is one
   subroutine destroy(plan)
      !> Null: there is none; null on exit
      type(c_ptr), intent(inout) :: plan

      if (c_associated(plan)) call delete_plan(plan)
      plan = c_null_ptr
   end subroutine destroy
end module contact_fft_library
