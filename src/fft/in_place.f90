!> Transforms that overwrite their argument
!>
!> FFTW's own interface declares input and output as two arrays, which Fortran forbids to be
!> the same; here both are addresses.
module contact_fft_in_place
   use, intrinsic :: iso_c_binding, only : c_int, c_ptr
   implicit none (type, external)
   private

   public :: plan_in_place, execute_in_place

   interface
      !> Plan complex one-dimensional transforms, see fftw_plan_many_dft
      type(c_ptr) function plan_in_place(rank, n, howmany, in, inembed, istride, idist, out, onembed, ostride, odist, &
         & sign, flags) bind(c, name='fftw_plan_many_dft')
         import :: c_int, c_ptr
         integer(c_int), value :: rank
         integer(c_int), intent(in) :: n(*)
         integer(c_int), value :: howmany
         type(c_ptr), value :: in
         integer(c_int), intent(in) :: inembed(*)
         integer(c_int), value :: istride, idist
         type(c_ptr), value :: out
         integer(c_int), intent(in) :: onembed(*)
         integer(c_int), value :: ostride, odist, sign, flags
      end function plan_in_place

      !> Run such a plan on another array of the same alignment
      subroutine execute_in_place(plan, in, out) bind(c, name='fftw_execute_dft')
         import :: c_ptr
         type(c_ptr), value :: plan, in, out
      end subroutine execute_in_place
   end interface
end module contact_fft_in_place
