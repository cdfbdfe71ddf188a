!> The C interface of FFTW 3, for library_fftw only
module contact_fft_fftw
   use, intrinsic :: iso_c_binding
   implicit none (type, external)
   public
   include 'fftw3.f03'
end module contact_fft_fftw
