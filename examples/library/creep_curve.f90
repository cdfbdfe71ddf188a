!> A traction curve: tangential force over creepage, of clean rollers and with a soft layer between them
!>
!> Two contact problems of one result element, which differ in the material only.
!> gfortran $DIR/include/contact_addon.f90 creep_curve.f90 $(pkg-config --cflags --libs contact) -o creep_curve
program creep_curve
   use, intrinsic :: iso_fortran_env, only : error_unit
   use contact_addon
   implicit none (type, external)
   integer, parameter :: wp = kind(1.0d0), element = 1
   real(wp), parameter :: creepages(*) = [0.0_wp, 0.0005_wp, 0.001_wp, 0.002_wp, 0.003_wp, 0.005_wp, 0.008_wp, &
      & 0.012_wp, 0.02_wp, 0.04_wp, 0.1_wp]
   integer :: version, error, icp, k
   real(wp) :: fn, fy, mz, fx(2)

   error = 0
   call cntc_initialize(element, 3, version, error, " ", 1)
   if (error /= 0) then
      write(error_unit, "(a, i0)") "the library cannot be initialised: error ", error
      error stop 1
   end if
   do icp = 1, 2
      call set_up(icp)
   end do
   call cntc_setmaterialparameters(element, 1, 0, 4, [0.28_wp, 0.28_wp, 82000.0_wp, 82000.0_wp])
   ! Layer: shear modulus [N/mm2] and thickness [mm]; it does not yield
   call cntc_setmaterialparameters(element, 2, 4, 8, [0.28_wp, 0.28_wp, 82000.0_wp, 82000.0_wp, 100.0_wp, 0.02_wp, &
      & 0.0_wp, 0.0_wp])

   write(*, "(a)") "# creepage, Fx / Fn clean, Fx / Fn with layer"
   do k = 1, size(creepages)
      do icp = 1, 2
         call cntc_setcreepages(element, icp, vx=creepages(k), vy=0.0_wp, phi=0.0_wp)
         call cntc_calculate(element, icp, error)
         if (error < 0) then
            write(error_unit, "(a, f8.4, a, i0)") "creepage ", creepages(k), ": error ", error
            error stop 1
         end if
         call cntc_getcontactforces(element, icp, fn, fx(icp), fy, mz)
      end do
      write(*, "(f8.4, 2f10.5)") creepages(k), fx/fn
   end do
   call cntc_finalize(element)

contains

   !> What both problems share: mm, N; steady rolling
   subroutine set_up(icp)
      integer, intent(in) :: icp

      call cntc_setflags(element, icp, 5, [CNTC_if_units, CNTC_ic_tang, CNTC_own_order, CNTC_ic_output, CNTC_ic_flow], &
         & [CNTC_un_cntc, 3, 2, 0, 0])
      call cntc_setfrictionmethod(element, icp, 0, 2, [0.35_wp, 0.35_wp])
      call cntc_setreferencevelocity(element, icp, 25000.0_wp)
      call cntc_sethertzcontact(element, icp, -3, 5, [25.0_wp, 25.0_wp, 6.5_wp, 5.0_wp, 1.2_wp])
      call cntc_setnormalforce(element, icp, 70000.0_wp)
      call cntc_setsolverflags(element, icp, 0, 4, [999, 100, 30, 1], 1, [1.0e-6_wp])
   end subroutine set_up

end program creep_curve
