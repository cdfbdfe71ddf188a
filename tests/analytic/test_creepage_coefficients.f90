!> Kalker's creepage coefficients from the full solution: steady rolling without slip
!>
!> With friction that no traction reaches, forces are linear in the creepages. They converge like
!> the size of the elements (the tractions are infinite at the trailing edge), so two grids are
!> extrapolated; the number of elements in contact stands for the area of the ellipse. With an argument the
!> program prints the table of doc/validation/simplified.md on finer grids.
program test_creepage_coefficients
   use, intrinsic :: iso_fortran_env, only : output_unit
   use contact_base_choices, only : motion, pressure_model
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_simplified_kalker, only : creepage_coefficients, kalker_coefficients
   use contact_test_case_builder, only : creep, ellipse_case, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("creepage coefficients")
   if (command_argument_count() > 0) then
      call print_table(suite)
   else
      call one_ellipse(suite, 0.3_wp, 0.25_wp)
      call one_ellipse(suite, 1.0_wp, 0.0_wp)
      call one_ellipse(suite, 1.0_wp, 0.25_wp)
      call one_ellipse(suite, 2.0_wp, 0.5_wp)
   end if
   call suite%finish()

contains

   !> One entry of the table, within the accuracy of both
   subroutine one_ellipse(suite, ratio, nu)
      type(test_suite), intent(inout) :: suite
      !> a/b and Poisson ratio
      real(wp), intent(in) :: ratio, nu
      type(creepage_coefficients) :: c

      c = kalker_coefficients(ratio, 1.0_wp, nu)
      call suite%close_to(extrapolated(suite, ratio, nu, [30, 60]), [c%c11, c%c22, c%c23], 0.012_wp, "C11, C22, C23", &
         & relative=.true.)
   end subroutine one_ellipse

   subroutine print_table(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: ratios(9) = [0.1_wp, 0.2_wp, 0.5_wp, 0.7_wp, 1.0_wp, 1.0_wp/0.7_wp, 2.0_wp, 5.0_wp, 10.0_wp]
      type(creepage_coefficients) :: c
      real(wp) :: found(3)
      integer :: i, k

      do k = 0, 2
         do i = 1, size(ratios)
            c = kalker_coefficients(ratios(i), 1.0_wp, 0.25_wp*k)
            found = extrapolated(suite, ratios(i), 0.25_wp*k, [80, 160])
            write(output_unit, "(a, f5.3, a, f4.2, 3(a, f6.3, a, f6.3, a, f5.2), a)") "| ", ratios(i), " | ", 0.25_wp*k, &
               & " | ", c%c11, " | ", found(1), " | ", 100.0_wp*(found(1)/c%c11 - 1.0_wp), &
               & " | ", c%c22, " | ", found(2), " | ", 100.0_wp*(found(2)/c%c22 - 1.0_wp), &
               & " | ", c%c23, " | ", found(3), " | ", 100.0_wp*(found(3)/c%c23 - 1.0_wp), " |"
         end do
      end do
   end subroutine print_table

   !> Coefficients on two grids, extrapolated with order 1
   function extrapolated(suite, ratio, nu, n) result(c)
      type(test_suite), intent(inout) :: suite
      real(wp), intent(in) :: ratio, nu
      !> Elements over the length of the ellipse, twice as many on the second grid
      integer, intent(in) :: n(2)
      real(wp) :: c(3), value(3, 2)
      integer :: i, k

      do i = 1, 2
         do k = 1, 3
            value(k, i) = coefficient(suite, ratio, nu, n(i), k)
         end do
      end do
      c = 2.0_wp*value(:, 2) - value(:, 1)
   end function extrapolated

   !> C11 (k = 1), C22 (2), C23 (3) on one grid
   function coefficient(suite, ratio, nu, n, k) result(c)
      type(test_suite), intent(inout) :: suite
      real(wp), intent(in) :: ratio, nu
      integer, intent(in) :: n, k
      real(wp) :: c
      real(wp), parameter :: small = 1.0e-6_wp, fn = 1.0_wp, friction = 1.0_wp
      type(test_case) :: case
      real(wp) :: area

      case%spec = ellipse_case(sqrt(ratio), 1.0_wp/sqrt(ratio), fn, n, n, scale=1.0_wp, eps=1.0e-8_wp)
      case%spec%pressure = pressure_model%elliptical
      case%spec%material%poiss = nu
      select case (k)
      case (1)
         call creep(case%spec, motion%steady_rolling, ksi=small, mu=friction)
      case (2)
         call creep(case%spec, motion%steady_rolling, eta=small, mu=friction)
      case (3)
         call creep(case%spec, motion%steady_rolling, phi=small, mu=friction)
      end select
      call case%run(suite, "rolling without slip")
      call suite%check(case%result%nslip == 0, "no slip")
      area = case%result%ncon*case%result%grid%dx*case%result%grid%dy/pi
      c = -merge(case%result%fx, case%result%fy, k == 1)/(case%result%gg*small*area)
      if (k == 3) c = c/sqrt(area)
      call case%release()
   end function coefficient
end program test_creepage_coefficients
