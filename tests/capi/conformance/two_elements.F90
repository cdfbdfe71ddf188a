!> Two result elements of basic contact in SIMPACK units, written like published callers: the
!> preprocessor brings flags and interfaces, some calls name their arguments.
!>
!> Element 1: Hertzian ellipse, approach given. Element 2: undeformed distances per element, force given, a
!> layer and decreasing friction. Expected figures: regression outputs of the published library, version
!> 25.2.0 (win64, serial), as printed there; forces within 0.2 % of the largest component of the case,
!> pressures within 0.5 %, numbers of elements within 2.
program two_elements
   use, intrinsic :: iso_c_binding, only : C_CHAR
   use contact_test_harness, only : test_suite
   implicit none (type, external)
#include "caddon_flags.inc"
#include "contact_addon.ifc"
   integer, parameter :: icp = 2
   integer :: flags(CNTC_FLAGS_DIM), values(CNTC_FLAGS_DIM), mtflg(CNTC_FLAGS_DIM)
   double precision :: mtval(CNTC_FLAGS_DIM)
   integer :: ire, ifcver, ierror
   character(len=32) :: outdir
   type(test_suite) :: suite

   call suite%start("two result elements of basic contact")
   outdir = " "
   do ire = 1, 2
      ierror = 0
      call cntc_initialize(ire=ire, imodul=3, ifcver=ifcver, ierror=ierror, c_outdir=outdir, len_outdir=1)
      call suite%equal(ierror, 0, "initialize")
      call suite%check(ifcver >= 2500, "the version tells callers to use the present forms")
      call set_up(ire)
   end do

   call calculate(1, 0, "a")
   call compare(1, "a", 21, 33, 0.00005d0, [42083.1d0, 4883.3d0, 4617.4d0, 23.7d0], [363, 138, 225], 675.4d0, 202.1d0)
   call compare_fields(1, "a", [675.4d0, 180.0d0, 126.9d0], [11, 17, 10, 13, 7, 20], [-0.00491d0, 0.00135d0], &
      & [5, 8, 3, 12])

   call calculate(2, 14, "b")
   call compare(2, "b", 23, 33, 0.00005d0, [42083.0d0, 2374.7d0, 1433.2d0, 10.2d0], [389, 346, 43], 675.5d0, 122.7d0)
   call compare_fields(2, "b", [675.5d0, 122.4d0, 27.2d0], [15, 15, 11, 6, 15, 20], [-0.02017d0, 0.00096d0], &
      & [7, 10, 9, 5])

   call cntc_setnormalforce(2, icp, fn=19563d0)
   call cntc_setcreepages(2, icp, vx=0.001d0, vy=0d0, phi=-0.3d0)
   call calculate(2, 0, "c")
   call compare(2, "c", 23, 33, 0.000030d0, [19563.0d0, 1251.4d0, -405.2d0, -2.3d0], [225, 214, 11], 523.4d0, 79.5d0)
   call compare_fields(2, "c", [523.4d0, 79.3d0, -13.0d0], [15, 15, 10, 19, 15, 11], [-0.01533d0, 0.00021d0], &
      & [10, 22, 9, 19])

   call cntc_finalize(2)
   call calculate(1, 0, "d")
   call compare(1, "d", 21, 33, 0.00005d0, [42083.1d0, 4883.3d0, 4617.4d0, 23.7d0], [363, 138, 225], 675.4d0, 202.1d0)
   call cntc_finalize(1)
   call check_dump()
   call suite%finish()

contains

   !> All settings of one element
   subroutine set_up(ire)
      integer, intent(in) :: ire
      double precision :: h(23*33), x, y
      integer :: ix, iy

      flags = 0
      flags(1:7) = [CNTC_if_units, CNTC_if_wrtinp, CNTC_ic_matfil, CNTC_ic_output, CNTC_ic_flow, CNTC_if_idebug, &
         & CNTC_if_openmp]
      values(1:7) = [CNTC_un_spck, 1, 0, 3, 4, 2, 1]
      call cntc_setflags(ire, icp, CNTC_FLAGS_DIM, flags, values)
      mtflg(1:5) = [CNTC_mt_tim, CNTC_mt_xw, CNTC_mt_yw, CNTC_mt_yr, CNTC_mt_xr]
      mtval(1:5) = [0.1d0 + ire, 12d0, 0.050d0, -0.012d0, 6d0]
      call cntc_setmetadata(ire, icp, 5, mtflg, mtval)
      call cntc_setreferencevelocity(ire, icp, 24d0)
      call cntc_setrollingstepsize(ire, icp, chi=0d0, dq=0.0005d0)
      call cntc_setcreepages(ire, icp, 0.001d0, 0d0, 0.4d0)
      if (ire == 1) then
         call cntc_setmaterialparameters(ire, icp, 0, 4, [0.28d0, 0.28d0, 82d9, 82d9])
         call cntc_setfrictionmethod(ire, icp, imeth=0, nparam=2, params=[0.3d0, 0.3d0])
         call cntc_setpenetration(ire, icp, 0.00005d0)
         call cntc_sethertzcontact(ire, icp, ipotcn=-3, nparam=5, params=[21d0, 33d0, 0.00425d0, 0.007d0, 21d0/17d0])
         call cntc_setsolverflags(ire, icp, gdigit=0, nints=4, iparam=[999, 30, 30, 1], nreals=1, rparam=[1d-4])
      else
         call cntc_setmaterialparameters(ire, icp, 4, 8, [0.28d0, 0.28d0, 82d9, 82d9, 100d6, 1d-5, 0d0, 0d0])
         call cntc_setfrictionmethod(ire, icp, 5, 3, [0.30d0, 0.60d0, log(2d0)/1.25d0])
         call cntc_setnormalforce(ire, icp, 42083d0)
         call cntc_setpotcontact(ire, icp, 1, 6, [23d0, 33d0, -0.00725d0, -0.00725d0, 0.0005d0, 0.0005d0])
         do iy = 1, 33
            do ix = 1, 23
               x = -0.00725d0 + (ix - 0.5d0)*0.0005d0
               y = -0.00725d0 + (iy - 0.5d0)*0.0005d0
               h(ix + (iy - 1)*23) = 1.214d0*x**2 + 0.5731d0*y**2
            end do
         end do
         call cntc_setundeformeddistc(ire, icp, ibase=9, nparam=size(h), prmudf=h)
      end if
   end subroutine set_up

   !> Solve, and compare the error code
   subroutine calculate(ire, expected, label)
      integer, intent(in) :: ire, expected
      character(len=*), intent(in) :: label

      ierror = -1
      call cntc_calculate(ire, icp, ierror)
      if (expected == 0) then
         call suite%equal(ierror, 0, label//": error code")
      else
         call suite%check(abs(ierror - expected) <= 2, label//": number of elements at the border")
      end if
   end subroutine calculate

   !> Totals of one case
   subroutine compare(ire, label, mx, my, pen, force, counts, pnmax, ptmax)
      integer, intent(in) :: ire, mx, my
      character(len=*), intent(in) :: label
      !> Forces Fn, Fx, Fy and moment Mz; contact, adhesion and slip elements
      double precision, intent(in) :: pen, force(4), pnmax, ptmax
      integer, intent(in) :: counts(3)
      double precision :: got_pen, got(4), area(3), dx, dy, largest
      integer :: got_mx, got_my
      integer, allocatable :: eldiv(:)

      call cntc_getnumelements(ire, icp, mx=got_mx, my=got_my)
      call suite%equal(got_mx, mx, label//": mx")
      call suite%equal(got_my, my, label//": my")
      call cntc_getpenetration(ire, icp, got_pen)
      call suite%close_to(got_pen, pen, 0.5d-6, label//": approach")
      call cntc_getcontactforces(ire, icp, got(1), got(2), got(3), got(4))
      call suite%close_to(got(1:3), force(1:3), 0.002d0*force(1), label//": forces")
      call suite%close_to(got(4), force(4), 0.1d0, label//": moment")
      call cntc_getgriddiscretization(ire, icp, dx, dy)
      call suite%close_to(dx, 0.0005d0, 1d-12, label//": dx")
      call cntc_getcontactpatchareas(ire, icp, carea=area(1), harea=area(2), sarea=area(3))
      call suite%check(all(abs(nint(area/(dx*dy)) - counts) <= 2), label//": areas of contact, adhesion, slip")
      allocate(eldiv(mx*my))
      call cntc_getelementdivision(ire, icp, size(eldiv), eldiv)
      call suite%check(all(abs([count(eldiv >= 1), count(eldiv == 1), count(eldiv == 2)] - counts) <= 2), &
         & label//": element division")
      call cntc_getmaximumpressure(ire, icp, largest)
      call suite%close_to(largest*1d-6, pnmax, 0.005d0*pnmax, label//": largest pressure")
      call cntc_getmaximumtraction(ire, icp, largest)
      call suite%close_to(largest*1d-6, ptmax, 0.005d0*ptmax, label//": largest traction")
   end subroutine compare

   !> Largest entries of pn, px, py and sx, sy, and their positions
   subroutine compare_fields(ire, label, traction, places, slip, slip_places)
      integer, intent(in) :: ire
      character(len=*), intent(in) :: label
      !> [MPa]; ix and iy of each; [-]; ix and iy of each
      double precision, intent(in) :: traction(3), slip(2)
      integer, intent(in) :: places(6), slip_places(4)
      double precision, allocatable :: field(:, :)
      integer :: mx, my, k
      character(len=2), parameter :: name(5) = ["pn", "px", "py", "sx", "sy"]

      call cntc_getnumelements(ire, icp, mx, my)
      allocate(field(mx*my, 5))
      call cntc_gettractions(ire, icp, mx*my, pn=field(1, 1), px=field(1, 2), py=field(1, 3))
      call cntc_getmicroslip(ire, icp, mx*my, field(:, 4), field(:, 5))
      do k = 1, 3
         call one_field(field(:, k)*1d-6, traction(k), 0.005d0*traction(1), places(2*k - 1:2*k), mx, &
            & label//": "//name(k))
      end do
      do k = 1, 2
         call one_field(field(:, 3 + k), slip(k), 0.02d0*abs(slip(1)), slip_places(2*k - 1:2*k), mx, &
            & label//": "//name(3 + k))
      end do
   end subroutine compare_fields

   !> The named element has the expected value, and no other has a larger one
   subroutine one_field(field, expected, tolerance, place, mx, label)
      double precision, intent(in) :: field(:), expected, tolerance
      integer, intent(in) :: place(2), mx
      character(len=*), intent(in) :: label

      call suite%close_to(field(place(1) + (place(2) - 1)*mx), expected, tolerance, label//", value at its place")
      call suite%close_to(maxval(abs(field)), abs(expected), tolerance, label//", largest")
   end subroutine one_field

   !> The cases are written as input in the order of their calculation, closed by module 0
   subroutine check_dump()
      character(len=200) :: line
      integer :: unit, status, cases, last

      cases = 0
      last = -1
      open(newunit=unit, file="contact_addon.inp", status="old", action="read", iostat=status)
      call suite%equal(status, 0, "the cases are written as input")
      if (status /= 0) return
      do
         read(unit, "(a)", iostat=status) line
         if (status /= 0) exit
         if (index(line, "MODULE") > 0) read(line, *) last
         if (index(line, "MODULE") > 0 .and. last == 3) cases = cases + 1
      end do
      close(unit)
      call suite%equal(cases, 4, "cases in the written input")
      call suite%equal(last, 0, "the written input is closed")
   end subroutine check_dump

end program two_elements
