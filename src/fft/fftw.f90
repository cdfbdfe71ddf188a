!> The C interface of FFTW 3, and nothing else
!>
!> FFTW is seen by this room only; another library takes its place by rewriting `plan`.
module contact_fft_fftw
   use, intrinsic :: iso_c_binding
   implicit none
   public
   include 'fftw3.f03'
end module contact_fft_fftw
