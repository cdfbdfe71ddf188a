!> Kalker's creepage coefficients: the slope of the creep force curve at vanishing creepage
!>
!> For an elliptic contact with semi-axes a (along rolling) and b, c = sqrt(a b), without slip area:
!>
!>     Fx = -G c**2 C11 xi,   Fy = -G c**2 (C22 eta + c C23 phi),   Mz = G c**3 C23 eta - ...
!>
!> The table and the limits for slender ellipses are Kalker's (1967; 1990, appendix E).
module contact_simplified_kalker
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: creepage_coefficients, kalker_coefficients

   !> Coefficients of the linear theory [-]
   type :: creepage_coefficients
      !> Longitudinal, lateral, and lateral due to spin
      real(wp) :: c11 = 0.0_wp, c22 = 0.0_wp, c23 = 0.0_wp
   end type creepage_coefficients

   !> Ratio of the semi-axes at the end of the table; the limits for slender ellipses are used below it
   real(wp), parameter :: narrow = 0.1_wp

   !> C11, C22, C23, each for nu = 0, 1/4, 1/2; columns a/b = 0.1, 0.2, ..., 1
   real(wp), parameter :: table_ab(9, 10) = reshape([ &
      & 2.51_wp, 3.31_wp, 4.85_wp, 2.51_wp, 2.52_wp, 2.53_wp, 0.334_wp, 0.473_wp, 0.731_wp, &
      & 2.59_wp, 3.37_wp, 4.81_wp, 2.59_wp, 2.63_wp, 2.66_wp, 0.483_wp, 0.603_wp, 0.809_wp, &
      & 2.68_wp, 3.44_wp, 4.80_wp, 2.68_wp, 2.75_wp, 2.81_wp, 0.607_wp, 0.715_wp, 0.889_wp, &
      & 2.78_wp, 3.53_wp, 4.82_wp, 2.78_wp, 2.88_wp, 2.98_wp, 0.720_wp, 0.823_wp, 0.977_wp, &
      & 2.88_wp, 3.62_wp, 4.83_wp, 2.88_wp, 3.01_wp, 3.14_wp, 0.827_wp, 0.929_wp, 1.07_wp, &
      & 2.98_wp, 3.72_wp, 4.91_wp, 2.98_wp, 3.14_wp, 3.31_wp, 0.930_wp, 1.03_wp, 1.18_wp, &
      & 3.09_wp, 3.81_wp, 4.97_wp, 3.09_wp, 3.28_wp, 3.48_wp, 1.03_wp, 1.14_wp, 1.29_wp, &
      & 3.19_wp, 3.91_wp, 5.05_wp, 3.19_wp, 3.41_wp, 3.65_wp, 1.13_wp, 1.25_wp, 1.40_wp, &
      & 3.29_wp, 4.01_wp, 5.12_wp, 3.29_wp, 3.54_wp, 3.82_wp, 1.23_wp, 1.36_wp, 1.51_wp, &
      & 3.40_wp, 4.12_wp, 5.20_wp, 3.40_wp, 3.67_wp, 3.98_wp, 1.33_wp, 1.47_wp, 1.63_wp], [9, 10])

   !> The same for b/a = 0.1, 0.2, ..., 1
   real(wp), parameter :: table_ba(9, 10) = reshape([ &
      & 10.7_wp, 11.7_wp, 12.9_wp, 10.7_wp, 12.8_wp, 16.0_wp, 12.2_wp, 14.6_wp, 18.0_wp, &
      & 6.96_wp, 7.78_wp, 8.82_wp, 6.96_wp, 8.14_wp, 9.79_wp, 5.72_wp, 6.63_wp, 7.89_wp, &
      & 5.57_wp, 6.34_wp, 7.34_wp, 5.57_wp, 6.40_wp, 7.51_wp, 3.79_wp, 4.32_wp, 5.01_wp, &
      & 4.84_wp, 5.57_wp, 6.57_wp, 4.84_wp, 5.48_wp, 6.31_wp, 2.88_wp, 3.24_wp, 3.70_wp, &
      & 4.37_wp, 5.10_wp, 6.11_wp, 4.37_wp, 4.90_wp, 5.56_wp, 2.35_wp, 2.62_wp, 2.96_wp, &
      & 4.06_wp, 4.78_wp, 5.80_wp, 4.06_wp, 4.50_wp, 5.04_wp, 2.01_wp, 2.23_wp, 2.50_wp, &
      & 3.82_wp, 4.54_wp, 5.58_wp, 3.82_wp, 4.21_wp, 4.67_wp, 1.76_wp, 1.95_wp, 2.18_wp, &
      & 3.65_wp, 4.36_wp, 5.42_wp, 3.65_wp, 3.99_wp, 4.39_wp, 1.58_wp, 1.75_wp, 1.94_wp, &
      & 3.51_wp, 4.22_wp, 5.30_wp, 3.51_wp, 3.81_wp, 4.16_wp, 1.44_wp, 1.59_wp, 1.77_wp, &
      & 3.40_wp, 4.12_wp, 5.20_wp, 3.40_wp, 3.67_wp, 3.98_wp, 1.33_wp, 1.47_wp, 1.63_wp], [9, 10])

   !> Lower bound of the ratio of the semi-axes: represents a line contact, as the limits have logarithms of the ratio
   real(wp), parameter :: min_ratio = 1.0e-6_wp

contains

   !> Coefficients for an ellipse and a Poisson ratio
   !>
   !> Linear between the columns of the table; 1/C is quadratic in nu. For slender ellipses beyond the table its limits are used,
   !> with a jump of up to 6 % at the end of the table.
   pure function kalker_coefficients(aa, bb, nu) result(c)
      !> Semi-axes along and across the rolling direction [mm]; a circle if not positive
      real(wp), intent(in) :: aa, bb
      !> Combined Poisson ratio [-]
      real(wp), intent(in) :: nu
      type(creepage_coefficients) :: c
      real(wp) :: g, entry(9), weight
      integer :: column

      if (aa <= 0.0_wp .and. bb <= 0.0_wp) then
         g = 1.0_wp
      else
         g = max(min(aa, bb)/max(aa, bb), min_ratio)
      end if
      if (g < narrow) then
         if (aa < bb) then
            c = narrow_along(g, nu)
         else
            c = narrow_across(g, nu)
         end if
         return
      end if
      column = min(max(int(10.0_wp*g), 1), 9)
      weight = 10.0_wp*g - column
      if (aa <= bb) then
         entry = (1.0_wp - weight)*table_ab(:, column) + weight*table_ab(:, column + 1)
      else
         entry = (1.0_wp - weight)*table_ba(:, column) + weight*table_ba(:, column + 1)
      end if
      c%c11 = at_poisson(entry(1:3), nu)
      c%c22 = at_poisson(entry(4:6), nu)
      c%c23 = at_poisson(entry(7:9), nu)
   end function kalker_coefficients

   !> One coefficient from its values at nu = 0, 1/4, 1/2
   pure real(wp) function at_poisson(values, nu) result(c)
      real(wp), intent(in) :: values(3), nu

      c = 1.0_wp/(8.0_wp*(nu - 0.25_wp)*(nu - 0.5_wp)/values(1) - 16.0_wp*nu*(nu - 0.5_wp)/values(2) &
         & + 8.0_wp*nu*(nu - 0.25_wp)/values(3))
   end function at_poisson

   !> Limit for a/b = g -> 0
   pure function narrow_along(g, nu) result(c)
      real(wp), intent(in) :: g, nu
      type(creepage_coefficients) :: c

      c%c11 = 0.25_wp*pi**2/(1.0_wp - nu)
      c%c22 = 0.25_wp*pi**2
      c%c23 = pi*sqrt(g)/(3.0_wp*(1.0_wp - nu))*(1.0_wp + nu*(log(16.0_wp/g) - 5.0_wp))
   end function narrow_along

   !> Limit for b/a = g -> 0
   pure function narrow_across(g, nu) result(c)
      real(wp), intent(in) :: g, nu
      type(creepage_coefficients) :: c
      real(wp) :: q, l, c4

      l = log(16.0_wp/g**2)
      c4 = 3.0_wp - log(4.0_wp)
      q = (1.0_wp - nu)*l + 2.0_wp*nu
      c%c11 = 2.0_wp*pi/((l - 2.0_wp*nu)*g)*(1.0_wp + c4/(l - 2.0_wp*nu))
      c%c22 = 2.0_wp*pi/(g*q)*(1.0_wp + (1.0_wp - nu)*c4/q)
      c%c23 = 2.0_wp*pi/(3.0_wp*g*sqrt(g)*((1.0_wp - nu)*l - 2.0_wp + 4.0_wp*nu))
   end function narrow_across
end module contact_simplified_kalker
