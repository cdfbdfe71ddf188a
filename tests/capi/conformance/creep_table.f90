!> Creep forces of Hertzian ellipses by many threads, a result element each, without interfaces: the calls
!> go to the names with an underscore that Fortran gives them by itself.
!>
!> 3220 cases: five ratios of the ellipse, four spins, seven directions, 23 magnitudes of creepage, on 11 x 11
!> elements. Expected rows and sums: regression output of the published library, version 25.2.0 (win64,
!> serial). Rows within 0.002, slip within two elements; sums within 0.3 %.
!>
!> With numbers of threads as arguments it measures instead: creep_table 1 2 4
program creep_table
   use contact_base_kinds, only : wp
   use contact_test_harness, only : test_suite
   use omp_lib, only : omp_get_max_threads, omp_get_thread_num, omp_get_wtime, omp_set_num_threads
   implicit none (type, external)
   include "caddon_flags.inc"
   external :: cntc_initializefirst, cntc_initialize, cntc_setglobalflags, cntc_setflags, cntc_setfrictionmethod
   external :: cntc_setmaterialparameters, cntc_setreferencevelocity, cntc_setnormalforce, cntc_setcreepages
   external :: cntc_setsolverflags, cntc_sethertzcontact, cntc_calculate, cntc_gethertzcontact, cntc_getcontactforces
   external :: cntc_getnumelements, cntc_getgriddiscretization, cntc_getcontactpatchareas, cntc_finalizelast
   integer, parameter :: magnitudes = 23, angles = 7, spins = 4, ratios = 5
   integer, parameter :: cases = magnitudes*angles*spins*ratios
   real(wp), parameter :: magnitude(magnitudes) = [0.0_wp, 0.1_wp, 0.2_wp, 0.3_wp, 0.4_wp, 0.5_wp, 0.7_wp, 0.9_wp, &
      & 1.1_wp, 1.4_wp, 1.7_wp, 2.0_wp, 2.5_wp, 3.0_wp, 3.5_wp, 4.0_wp, 5.0_wp, 6.0_wp, 7.0_wp, 8.0_wp, 9.0_wp, &
      & 10.0_wp, 12.0_wp]
   real(wp), parameter :: spin(spins) = [0.0_wp, 0.5_wp, 1.0_wp, 2.0_wp]
   real(wp), parameter :: ratio(ratios) = [0.2_wp, 0.5_wp, 1.0_wp, 2.0_wp, 5.0_wp]
   real(wp), parameter :: semi_axis(ratios) = [4.0_wp, 6.0_wp, 9.0_wp, 12.0_wp, 20.0_wp]
   real(wp), parameter :: fn = 82000.0_wp, fstat = 0.3_wp
   !> Effective radius rho and mean semi-axis cp [mm] of each ratio, read from the library
   real(wp) :: rho(ratios), cp(ratios)
   !> Fx, Fy by fstat Fn, Mz by fstat Fn cp, slip [%] of each case; by one thread and by several
   real(wp) :: serial(4, cases), parallel(4, cases)
   integer :: ifcver, ierror
   type(test_suite) :: suite

   call suite%start("creep forces by many threads")
   if (command_argument_count() > 0) then
      call measure()
   else
      call run(1, serial)
      call compare_rows()
      call compare_sums()
      call check_symmetry()
      call run(max(4, omp_get_max_threads()), parallel)
      call suite%check(all(abs(parallel - serial) <= 0.0_wp), "several threads give the numbers of one")
   end if
   call suite%finish()

contains

   !> Print the time of the table by the numbers of threads given as arguments. Processor time is
   !> that of all threads; if it is constant, the speed-up is limited by free cores only.
   subroutine measure()
      character(len=20) :: word
      integer :: k, threads
      real(wp) :: start, seconds, first, processor(2)

      write(*, "(a)") "threads, wall and processor time of 3220 cases [s], cases per second, speed-up"
      do k = 1, command_argument_count()
         call get_command_argument(k, word)
         read(word, *) threads
         start = omp_get_wtime()
         call cpu_time(processor(1))
         call run(threads, serial)
         seconds = omp_get_wtime() - start
         call cpu_time(processor(2))
         if (k == 1) first = seconds
         write(*, "(i7, 2f10.3, f10.0, f8.2)") threads, seconds, processor(2) - processor(1), cases/seconds, first/seconds
      end do
   end subroutine measure

   !> The whole table by a number of threads
   subroutine run(threads, table)
      integer, intent(in) :: threads
      real(wp), intent(out) :: table(4, cases)
      integer :: ire, number, failures, ir
      real(wp) :: hertz(10)

      ierror = 0
      call cntc_initializefirst(ifcver, ierror, 0, " ", " ", "test_table_mx011", 1, 1, 16)
      call suite%equal(ierror, 0, "initializefirst")
      call omp_set_num_threads(threads)
      call cntc_setglobalflags(2, [CNTC_if_idebug, CNTC_if_openmp], [0, -1])
      call suite%equal(omp_get_max_threads(), threads, "the library leaves the threads of its caller alone")
      do ire = 1, threads
         call set_up(ire)
      end do
      do ir = 1, ratios
         call set_ellipse(1, ir)
         call cntc_calculate(1, 1, ierror)
         call suite%equal(ierror, 0, "calculate")
         call cntc_gethertzcontact(1, 1, size(hertz), hertz)
         rho(ir) = hertz(5)
         cp(ir) = hertz(6)
      end do
      call suite%close_to(rho, [1772.0_wp, 2075.0_wp, 2700.0_wp, 2075.0_wp, 1772.0_wp], 0.5_wp, "rho")
      call suite%close_to(cp, [8.944_wp, 8.485_wp, 9.0_wp, 8.485_wp, 8.944_wp], 0.0005_wp, "cp")

      failures = 0
      !$omp parallel do schedule(dynamic, 16) num_threads(threads) reduction(+: failures)
      do number = 1, cases
         call one_case(omp_get_thread_num() + 1, number, table(:, number), failures)
      end do
      !$omp end parallel do
      call suite%equal(failures, 0, "calculations with an error code")
      call cntc_finalizelast()
   end subroutine run

   !> The constant settings
   subroutine set_up(ire)
      integer, intent(in) :: ire

      ierror = 0
      call cntc_initialize(ire, 3, ifcver, ierror, " ", 1)
      call suite%equal(ierror, 0, "initialize")
      call cntc_setflags(ire, 1, 7, [CNTC_if_units, CNTC_if_wrtinp, CNTC_ic_matfil, CNTC_ic_output, CNTC_ic_flow, &
         & CNTC_ic_tang, CNTC_ic_bound], [CNTC_un_cntc, 0, 0, 0, 2, 3, 0])
      call cntc_setfrictionmethod(ire, 1, 0, 2, [fstat, fstat])
      call cntc_setmaterialparameters(ire, 1, 0, 4, [0.28_wp, 0.28_wp, 82000.0_wp, 82000.0_wp])
      call cntc_setreferencevelocity(ire, 1, 10000.0_wp)
      call cntc_setnormalforce(ire, 1, fn)
      call cntc_setcreepages(ire, 1, 0.0_wp, 0.0_wp, 0.0_wp)
      call cntc_setsolverflags(ire, 1, 0, 4, [299, 1, 30, 1], 1, [1e-6_wp])
   end subroutine set_up

   !> Ellipse of one ratio
   subroutine set_ellipse(ire, ir)
      integer, intent(in) :: ire, ir

      call cntc_sethertzcontact(ire, 1, -3, 5, [11.0_wp, 11.0_wp, semi_axis(ir), semi_axis(ir)/ratio(ir), &
         & 11.0_wp/7.0_wp])
   end subroutine set_ellipse

   !> One row of the table
   subroutine one_case(ire, number, row, failures)
      integer, intent(in) :: ire, number
      real(wp), intent(out) :: row(4)
      integer, intent(inout) :: failures
      real(wp) :: angle, creepage, force(4), area(3), dx, dy
      integer :: im, ia, is, ir, code, mx, my

      im = mod(number - 1, magnitudes) + 1
      ia = mod((number - 1)/magnitudes, angles)
      is = mod((number - 1)/(magnitudes*angles), spins) + 1
      ir = (number - 1)/(magnitudes*angles*spins) + 1
      angle = (30*ia - 90)*acos(-1.0_wp)/180.0_wp
      creepage = magnitude(im)*fstat*cp(ir)/rho(ir)
      call set_ellipse(ire, ir)
      call cntc_setcreepages(ire, 1, creepage*cos(angle), creepage*sin(angle), fstat*spin(is)/rho(ir))
      call cntc_setflags(ire, 1, 1, [CNTC_ic_output], [merge(2, 0, number == 1)])
      call cntc_calculate(ire, 1, code)
      if (code /= 0) failures = failures + 1
      call cntc_getcontactforces(ire, 1, force(1), force(2), force(3), force(4))
      call cntc_getnumelements(ire, 1, mx, my)
      call cntc_getgriddiscretization(ire, 1, dx, dy)
      call cntc_getcontactpatchareas(ire, 1, area(1), area(2), area(3))
      row(1:2) = force(2:3)/(fstat*fn)
      row(3) = force(4)/(fstat*fn*cp(ir))
      row(4) = 100.0_wp*nint(area(3)/(dx*dy))/max(1, nint(area(1)/(dx*dy)))
   end subroutine one_case

   !> Selected rows
   subroutine compare_rows()
      integer, parameter :: number(16) = [74, 30, 124, 235, 285, 495, 718, 1201, 1801, 1962, 2217, 2489, 2650, &
         & 2861, 3022, 3183]
      real(wp), parameter :: fx(16) = [-0.505875_wp, -0.399917_wp, -0.516200_wp, -0.358626_wp, -0.418350_wp, 0.0_wp, &
         & -0.405548_wp, -0.177530_wp, -0.198829_wp, -0.401630_wp, -0.417526_wp, -0.250361_wp, -0.886107_wp, &
         & -0.438567_wp, -0.426173_wp, -0.334955_wp]
      real(wp), parameter :: fy(16) = [0.0_wp, 0.535033_wp, -0.712332_wp, -0.110830_wp, -0.753055_wp, 0.663346_wp, &
         & 0.0_wp, -0.410771_wp, -0.201148_wp, 0.671312_wp, -0.899149_wp, -0.590159_wp, 0.0_wp, -0.879884_wp, &
         & -0.814617_wp, -0.602819_wp]
      real(wp), parameter :: mz(16) = [0.0_wp, -0.060303_wp, 0.043551_wp, -0.509630_wp, -0.321377_wp, -0.682618_wp, &
         & 0.0_wp, -0.486264_wp, -0.453284_wp, -0.106009_wp, -0.049482_wp, -0.398167_wp, 0.0_wp, -0.092646_wp, &
         & -0.234754_wp, -0.544796_wp]
      real(wp), parameter :: slip(16) = [34.1_wp, 46.3_wp, 68.3_wp, 46.3_wp, 78.0_wp, 95.1_wp, 26.8_wp, 75.6_wp, &
         & 68.9_wp, 51.2_wp, 100.0_wp, 97.6_wp, 65.9_wp, 100.0_wp, 95.1_wp, 100.0_wp]

      call suite%close_to(serial(1, number), fx, 0.002_wp, "longitudinal forces of selected rows")
      call suite%close_to(serial(2, number), fy, 0.002_wp, "lateral forces of selected rows")
      call suite%close_to(serial(3, number), mz, 0.002_wp, "moments of selected rows")
      call suite%close_to(serial(4, number), slip, 200.0_wp/41 + 0.05_wp, "slip of selected rows, by two elements")
   end subroutine compare_rows

   !> Sums per ratio: Fx, Fy, Mz, |Fy|, |Mz|, slip
   subroutine compare_sums()
      real(wp), parameter :: expected(6, ratios) = reshape([ &
         & -241.961_wp, -40.748_wp, -184.388_wp, 325.505_wp, 187.239_wp, 53714.8_wp, &
         & -248.669_wp, -61.408_wp, -93.914_wp, 332.808_wp, 97.511_wp, 50145.5_wp, &
         & -254.320_wp, -85.085_wp, -67.082_wp, 353.361_wp, 71.183_wp, 51837.7_wp, &
         & -264.757_wp, -110.782_wp, -73.448_wp, 381.100_wp, 77.725_wp, 54713.5_wp, &
         & -276.677_wp, -103.526_wp, -151.821_wp, 375.141_wp, 155.386_wp, 60639.4_wp], [6, ratios])
      character(len=*), parameter :: name(ratios) = ["0.2", "0.5", "1.0", "2.0", "5.0"]
      integer, parameter :: block = cases/ratios
      integer :: ir

      do ir = 1, ratios
         associate (part => serial(:, (ir - 1)*block + 1:ir*block))
            call suite%close_to([sum(part(1, :)), sum(part(2, :)), sum(part(3, :)), sum(abs(part(2, :))), &
               & sum(abs(part(3, :))), sum(part(4, :))], expected(:, ir), 0.003_wp, "sums of ratio "//name(ir), &
               & relative=.true.)
         end associate
      end do
   end subroutine compare_sums

   !> Without spin, opposite directions give opposite lateral forces; without creepage there is no force
   subroutine check_symmetry()
      integer :: ir, ia, start, opposite

      do ir = 1, ratios
         start = (ir - 1)*(cases/ratios)
         call suite%check(all(abs(serial(:, start + 1)) <= 0.0_wp), "no creepage, no force, no slip")
         do ia = 0, 2
            opposite = start + (6 - ia)*magnitudes
            associate (one => serial(:, start + ia*magnitudes + 1:start + (ia + 1)*magnitudes), &
                  & other => serial(:, opposite + 1:opposite + magnitudes))
               call suite%check(maxval(abs(one(1, :) - other(1, :))) < 1e-4_wp .and. &
                  & maxval(abs(one(2:3, :) + other(2:3, :))) < 1e-4_wp, "opposite directions without spin")
            end associate
         end do
      end do
   end subroutine check_symmetry

end program creep_table
