!> The Manchester benchmark with a wheel S1002 on a rail 60E1: a wheelset is moved sideways, and forces and
!> contact points of its right wheel are asked for
!>
!> usage: manchester FOLDER_OF_PROFILES
program manchester
   use, intrinsic :: iso_fortran_env, only : error_unit
   use contact_addon
   implicit none (type, external)
   integer, parameter :: wp = kind(1.0d0), element = 1, whole = -1
   !> [mm/s], [mm]
   real(wp), parameter :: speed = 2000.0_wp, radius = 460.0_wp
   character(len=1000) :: folder
   integer :: version, error, patches, step
   real(wp) :: y, forces(24), place(14)

   call get_command_argument(1, folder)
   if (folder == "") then
      write(error_unit, "(a)") "usage: manchester FOLDER_OF_PROFILES"
      error stop 2
   end if
   error = 0
   call cntc_initialize(element, 1, version, error, " ", 1)
   if (error /= 0) then
      write(error_unit, "(a, i0)") "the library cannot be initialised: error ", error
      error stop 1
   end if
   ! mm, N; right rail; steady rolling
   call cntc_setflags(element, whole, 6, [CNTC_if_units, CNTC_ic_config, CNTC_ic_tang, CNTC_own_order, CNTC_ic_output, &
      & CNTC_ic_flow], [CNTC_un_cntc, 1, 3, 2, 0, 0])
   call cntc_setmaterialparameters(element, whole, 0, 4, [0.28_wp, 0.28_wp, 82000.0_wp, 82000.0_wp])
   call cntc_setfrictionmethod(element, whole, 0, 2, [0.3_wp, 0.3_wp])
   call cntc_setsolverflags(element, whole, 0, 4, [999, 100, 30, 1], 1, [1.0e-5_wp])
   ! Elements of 0.2 mm; patches are apart by 90 degrees or 8 mm, together below 4 mm
   call cntc_setpotcontact(element, whole, -1, 5, [0.2_wp, 0.2_wp, 1.5707963_wp, 8.0_wp, 4.0_wp])
   call cntc_setrollingstepsize(element, whole, 0.0_wp, 1.0_wp)
   ! Gauge 1435 mm at 14 mm below the top of the rail, cant 1:40
   call cntc_settrackdimensions(element, 3, 11, [14.0_wp, 0.0_wp, 1435.0_wp, 0.025_wp, spread(0.0_wp, 1, 7)])
   call cntc_setwheelsetdimensions(element, 3, 3, [1360.0_wp, -70.0_wp, radius])
   call set_profile("60E1.prr", 0)
   call set_profile("S1002.prw", 1)
   call cntc_setverticalforce(element, 10000.0_wp)

   write(*, "(a)") "# y wheelset [mm], patches, Fx, Fy on the rail [N], y and angle of the first contact [mm], [rad]"
   do step = 0, 6
      y = real(step, wp)
      call cntc_setwheelsetposition(element, 1, 6, [0.0_wp, y, 0.0_wp, 0.0_wp, 0.0024_wp*y, 0.0_wp])
      call cntc_setwheelsetvelocity(element, 2, 6, [speed, spread(0.0_wp, 1, 4), -speed/radius])
      call cntc_calculate(element, whole, error)
      if (error < 0) then
         write(error_unit, "(a, f5.1, a, i0)") "y = ", y, " mm: error ", error
         error stop 1
      end if
      call cntc_getnumcontactpatches(element, patches)
      call cntc_getglobalforces(element, whole, size(forces), forces)
      call cntc_getcontactlocation(element, 1, size(place), place)
      write(*, "(f5.1, i4, 2f10.1, f11.3, f9.4)") y, patches, forces(1:2), place(2), place(4)
   end do
   call cntc_finalize(element)

contains

   !> Kind 0 is a rail, 1 a wheel; the files are in mm
   subroutine set_profile(file, kind)
      character(len=*), intent(in) :: file
      integer, intent(in) :: kind
      character(len=:), allocatable :: name

      name = trim(folder) // "/" // file
      call cntc_setprofileinputfname(element, name, len(name), 1, [kind], 2, [1.0_wp, 0.0_wp])
   end subroutine set_profile

end program manchester
