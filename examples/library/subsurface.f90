!> Stresses below a ball that slides over a plane: their largest value moves towards the surface with friction
program subsurface
   use, intrinsic :: iso_fortran_env, only : error_unit
   use contact_addon
   implicit none (type, external)
   integer, parameter :: wp = kind(1.0d0), element = 1, problem = 1
   integer, parameter :: nx = 25, nz = 31, points = nx*nz
   real(wp), parameter :: frictions(*) = [0.0001_wp, 0.15_wp, 0.3_wp, 0.5_wp]
   real(wp) :: x(nx), z(nz), values(points, 3)
   integer :: version, error, k, largest

   error = 0
   call cntc_initialize(element, 3, version, error, " ", 1)
   if (error /= 0) then
      write(error_unit, "(a, i0)") "the library cannot be initialised: error ", error
      error stop 1
   end if
   call cntc_setflags(element, problem, 4, [CNTC_if_units, CNTC_ic_tang, CNTC_ic_output, CNTC_ic_flow], &
      & [CNTC_un_cntc, 3, 0, 0])
   call cntc_setmaterialparameters(element, problem, 0, 4, [0.3_wp, 0.3_wp, 80000.0_wp, 80000.0_wp])
   call cntc_sethertzcontact(element, problem, -3, 5, [40.0_wp, 40.0_wp, 1.0_wp, 1.0_wp, 1.1_wp])
   call cntc_setnormalforce(element, problem, 2000.0_wp)
   ! So much creepage that all of the contact slips; the force on the ball points to -x
   call cntc_setcreepages(element, problem, 1.0_wp, 0.0_wp, 0.0_wp)
   ! Plane below the middle of the contact, in steps of 0.1 and 0.05 mm
   x = [(0.1_wp*k, k=-12, 12)]
   z = [(0.05_wp*k, k=0, nz - 1)]
   call subs_addblock(element, problem, 1, 9, nx, 1, nz, x, [0.0_wp], z)

   write(*, "(a)") "# friction, largest von Mises stress [N/mm2], its place x, z [mm]"
   do k = 1, size(frictions)
      call cntc_setfrictionmethod(element, problem, 0, 2, [frictions(k), frictions(k)])
      call cntc_calculate(element, problem, error)
      if (error >= 0) call subs_calculate(element, problem, error)
      if (error < 0) then
         write(error_unit, "(a, f7.4, a, i0)") "friction ", frictions(k), ": error ", error
         error stop 1
      end if
      ! Columns: x, z, von Mises stress
      call subs_getresults(element, problem, 1, points, 3, [1, 3, 8], values)
      largest = maxloc(values(:, 3), dim=1)
      write(*, "(f7.4, f9.1, f7.2, f6.2)") frictions(k), values(largest, 3), values(largest, 1), values(largest, 2)
   end do
   call cntc_finalize(element)
end program subsurface
