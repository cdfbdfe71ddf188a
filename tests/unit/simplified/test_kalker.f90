!> Kalker's coefficients: entries of the table, interpolation, limits; ellipses and flexibilities
program test_kalker
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : bounding_box
   use contact_simplified_flexibility, only : blended_flexibilities, contact_extent, ellipse, equivalent_ellipse, slope_factor, &
      & slope_reduction, three_flexibilities
   use contact_simplified_kalker, only : creepage_coefficients, kalker_coefficients
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   real(wp), parameter :: closed = 1.0e-13_wp
   type(test_suite) :: suite

   call suite%start("kalker")
   call entries(suite)
   call between(suite)
   call limits(suite)
   call ellipses(suite)
   call printed_flexibilities(suite)
   call slopes(suite)
   call suite%finish()

contains

   !> Some entries of Kalker's table
   subroutine entries(suite)
      type(test_suite), intent(inout) :: suite

      call one_entry(suite, 0.1_wp, 0.25_wp, [3.31_wp, 2.52_wp, 0.473_wp])
      call one_entry(suite, 0.5_wp, 0.25_wp, [3.62_wp, 3.01_wp, 0.929_wp])
      call one_entry(suite, 1.0_wp, 0.25_wp, [4.12_wp, 3.67_wp, 1.47_wp])
      call one_entry(suite, 1.0_wp, 0.5_wp, [5.20_wp, 3.98_wp, 1.63_wp])
      call one_entry(suite, 1.0_wp/0.9_wp, 0.0_wp, [3.51_wp, 3.51_wp, 1.44_wp])
      call one_entry(suite, 2.0_wp, 0.25_wp, [5.10_wp, 4.90_wp, 2.62_wp])
      call one_entry(suite, 10.0_wp, 0.5_wp, [12.9_wp, 16.0_wp, 18.0_wp])
   end subroutine entries

   subroutine one_entry(suite, ratio, nu, expected)
      type(test_suite), intent(inout) :: suite
      !> a/b, Poisson ratio, C11, C22, C23
      real(wp), intent(in) :: ratio, nu, expected(3)
      type(creepage_coefficients) :: c

      c = kalker_coefficients(3.0_wp*ratio, 3.0_wp, nu)
      call suite%close_to([c%c11, c%c22, c%c23], expected, 1.0e-12_wp, "entry of the table", relative=.true.)
   end subroutine one_entry

   !> Between the entries: monotone in the ratio, without jumps
   subroutine between(suite)
      type(test_suite), intent(inout) :: suite
      type(creepage_coefficients) :: c, last
      real(wp) :: nu
      integer :: i, k

      do k = 0, 5
         nu = 0.1_wp*k
         last = kalker_coefficients(0.1_wp, 1.0_wp, nu)
         do i = 1, 399
            c = kalker_coefficients(0.1_wp*10.0_wp**(0.005_wp*i), 1.0_wp, nu)
            call suite%check(c%c22 >= last%c22 .and. c%c23 > last%c23, "C22 and C23 increase with a/b")
            call suite%close_to([c%c11, c%c22, c%c23], [last%c11, last%c22, last%c23], 0.03_wp, "no jumps", relative=.true.)
            last = c
         end do
      end do
      c = kalker_coefficients(2.0_wp, 1.0_wp, -0.9_wp)
      call suite%check(min(c%c11, c%c22, c%c23) > 0.0_wp, "negative Poisson ratios")
      c = kalker_coefficients(0.0_wp, 0.0_wp, 0.25_wp)
      call suite%close_to(c%c11, 4.12_wp, closed, "no contact: a circle", relative=.true.)
   end subroutine between

   !> Narrow ellipses: the strip, and the step between the limits and the table
   subroutine limits(suite)
      type(test_suite), intent(inout) :: suite
      type(creepage_coefficients) :: inside, outside
      real(wp) :: nu
      integer :: k

      do k = 0, 2
         nu = 0.25_wp*k
         outside = kalker_coefficients(1.0e-9_wp, 1.0_wp, nu)
         call suite%close_to(outside%c11, 0.25_wp*pi**2/(1.0_wp - nu), closed, "C11 of a strip", relative=.true.)
         call suite%close_to(outside%c22, 0.25_wp*pi**2, closed, "C22 of a strip", relative=.true.)
         inside = kalker_coefficients(0.1_wp, 1.0_wp, nu)
         outside = kalker_coefficients(0.1_wp - 1.0e-9_wp, 1.0_wp, nu)
         call suite%close_to([outside%c11, outside%c22, outside%c23], [inside%c11, inside%c22, inside%c23], 0.065_wp, &
            & "narrow along rolling", relative=.true.)
         inside = kalker_coefficients(10.0_wp, 1.0_wp, nu)
         outside = kalker_coefficients(10.0_wp + 1.0e-6_wp, 1.0_wp, nu)
         call suite%close_to([outside%c11, outside%c22, outside%c23], [inside%c11, inside%c22, inside%c23], 0.05_wp, &
            & "narrow across rolling", relative=.true.)
      end do
   end subroutine limits

   !> The equivalent ellipse of a rectangle, of one with holes and notches, and of an empty area
   subroutine ellipses(suite)
      type(test_suite), intent(inout) :: suite
      type(ellipse) :: area
      type(bounding_box) :: box
      logical :: contact(9, 7)
      integer :: n

      contact = .false.
      contact(3:6, 2:4) = .true.
      call contact_extent(contact, n, box)
      area = equivalent_ellipse(n, box, 0.5_wp, 2.0_wp)
      call suite%close_to(pi*area%aa*area%bb, 12.0_wp, closed, "area", relative=.true.)
      call suite%close_to(area%aa/area%bb, 2.0_wp/6.0_wp, closed, "proportions", relative=.true.)
      ! a hole, an empty row, and a part that extends further in the last row
      contact(4:5, 3) = .false.
      contact(2:2, 6) = .true.
      contact(9:9, 7) = .true.
      call contact_extent(contact, n, box)
      call suite%check(n == 12 .and. all([box%ix0, box%ix1, box%iy0, box%iy1] == [2, 9, 2, 7]), "extent of parts with holes")
      area = equivalent_ellipse(n, box, 0.5_wp, 2.0_wp)
      call suite%close_to(pi*area%aa*area%bb, 12.0_wp, closed, "area of parts with holes", relative=.true.)
      call suite%close_to(area%aa/area%bb, 4.0_wp/12.0_wp, closed, "proportions of their box", relative=.true.)
      contact = .false.
      call contact_extent(contact, n, box)
      area = equivalent_ellipse(n, box, 0.5_wp, 2.0_wp)
      call suite%close_to([area%aa, area%bb], [0.0_wp, 0.0_wp], 0.0_wp, "no contact")
   end subroutine ellipses

   !> Flexibilities that CONTACT prints for a/b = 2 with lateral creepage and spin, and limits of the blend
   subroutine printed_flexibilities(suite)
      type(test_suite), intent(inout) :: suite
      type(ellipse), parameter :: area = ellipse(8.0_wp, 4.0_wp)
      real(wp), parameter :: gg = 82000.0_wp, nu = 0.28_wp, load = 2.46e4_wp
      real(wp) :: flx(3), blend(3)

      flx = three_flexibilities(area, gg, nu)
      blend = blended_flexibilities(flx, area, gg, nu, load, [0.0_wp, -6.25e-4_wp], 6.25e-4_wp)
      call suite%close_to(blend, [4.937e-5_wp, 5.152e-5_wp, 4.090e-5_wp], 1.1e-4_wp, "three flexibilities", relative=.true.)
      blend = blended_flexibilities(flx, area, gg, nu, load, [0.0_wp, 0.0_wp], 6.25e-4_wp)
      call suite%close_to(blend, flx, closed, "pure spin is not blended", relative=.true.)
      blend = blended_flexibilities(flx, area, gg, nu, load, [1.0_wp, 0.0_wp], 0.0_wp)
      call suite%close_to(blend, spread(flx(1), 1, 3), closed, "large creepage: one flexibility", relative=.true.)
      blend = blended_flexibilities(flx, area, gg, nu, 0.0_wp, [0.0_wp, 0.0_wp], 0.0_wp)
      call suite%close_to(blend, flx, closed, "no creepage, no friction", relative=.true.)
   end subroutine printed_flexibilities

   subroutine slopes(suite)
      type(test_suite), intent(inout) :: suite
      type(ellipse), parameter :: area = ellipse(8.0_wp, 4.0_wp)
      real(wp), parameter :: gg = 82000.0_wp, nu = 0.28_wp, load = 2.46e4_wp
      type(slope_reduction), parameter :: reduction = slope_reduction(0.5_wp, 0.1_wp, 0.4_wp)

      call suite%close_to(slope_factor(slope_reduction(), area, gg, nu, load, [1.0e-3_wp, 0.0_wp], 0.0_wp), 1.0_wp, 0.0_wp, &
         & "no reduction")
      call suite%close_to(slope_factor(reduction, area, gg, nu, load, [0.0_wp, 0.0_wp], 0.0_wp), 0.5_wp, closed, &
         & "without creepage k = k0")
      call suite%close_to(slope_factor(reduction, area, gg, nu, load, [1.0e9_wp, 0.0_wp], 0.0_wp), 0.05_wp, 1.0e-9_wp, &
         & "large creepage: k = k0 alpha")
      call suite%close_to(slope_factor(reduction, area, gg, nu, 0.0_wp, [1.0_wp, 0.0_wp], 0.0_wp), 0.05_wp, closed, &
         & "without friction as well")
      call suite%check(slope_factor(reduction, area, gg, nu, 0.0_wp, [0.0_wp, 0.0_wp], 0.0_wp) > 0.0_wp, &
         & "neither creepage nor friction")
   end subroutine slopes
end program test_kalker
