! A caller of the published library: include files in a module by the preprocessor, texts of C
module settings
   use, intrinsic :: iso_c_binding, only: C_CHAR, C_NULL_CHAR
   implicit none
   include 'caddon_flags.inc'
#include "contact_addon.ifc"
contains
   subroutine rolling(ire, icp)
      integer, intent(in) :: ire, icp
      real(kind=8) :: params(10)

      params(1:4) = (/ 0.28d0, 0.28d0, 82000d0, 82000d0 /)
      call cntc_setmaterialparameters(ire, icp, 0, 4, params)
      call cntc_setfrictionmethod(ire, icp, 0, 2, (/ 0.3d0, 0.3d0 /))
      call cntc_setreferencevelocity(ire, icp, veloc=10000d0)
      params(1:5) = (/ 21d0, 21d0, 5d0, 4d0, 1.2d0 /)
      call cntc_sethertzcontact(ire, icp, -3, 5, params)
      call cntc_setnormalforce(ire, icp, 20000d0)
      call cntc_setcreepages(ire, icp, vx=0.001d0, vy=0d0, phi=0d0)
   end subroutine rolling
end module settings

program stranger
   use settings
   implicit none
   integer, parameter :: mxflgs = CNTC_FLAGS_DIM
   character(len=1, kind=C_CHAR) :: c_wrkdir(256), c_outdir(256), c_expnam(256)
   character(len=256) :: f_expnam
   integer :: ifcver, ierror, i, ire, flags(mxflgs), values(mxflgs)
   real(kind=8) :: fn, fx, fy, mz

   c_wrkdir = ' '
   c_outdir = ' '
   f_expnam = 'stranger_f' // C_NULL_CHAR
   do i = 1, 256
      c_expnam(i) = f_expnam(i:i)
   enddo
   ierror = 0
   call cntc_initializefirst_new(ifcver, ierror, 0, c_wrkdir, c_outdir, c_expnam, 1, 1, len_trim(f_expnam))
   if (ierror.ne.0 .or. ifcver.le.2499) stop 1
   do ire = 1, 2
      call cntc_initialize(ire, 3, ifcver, ierror, ' ', 1)
      flags(1:3) = (/ CNTC_if_units, CNTC_if_openmp, CNTC_if_debug /)
      values(1:3) = (/ CNTC_un_cntc, -1, 0 /)
      call cntc_setflags(ire, 1, 3, flags, values)
      call rolling(ire, 1)
      call cntc_calculate(ire, 1, ierror)
      if (ierror.ne.0) stop 2
      call cntc_getcontactforces(ire, 1, fn, fx, fy, mz)
      if (ire.eq.2) write(*,'(f9.3,f10.3)') fn, fx
   enddo
   call cntc_finalizelast
end program stranger
