!> Flexibilities of the simplified theory: one number where the half-space has an integral operator
!>
!> A surface particle follows its own traction only, u = L p. Three values of L make the forces at
!> vanishing creepage agree with Kalker's linear theory; they are blended into one when slip
!> spreads (Vollebregt and Voltr 2023), and grow with the slip area for contaminated surfaces
!> (Spiryagin, Polach and Cole 2013).
module contact_simplified_flexibility
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_simplified_kalker, only : creepage_coefficients, kalker_coefficients
   implicit none (type, external)
   private

   public :: ellipse, equivalent_ellipse, three_flexibilities, blended_flexibilities
   public :: slope_reduction, slope_factor

   !> Semi-axes along and across the rolling direction [mm]
   type :: ellipse
      real(wp) :: aa = 0.0_wp, bb = 0.0_wp
   end type ellipse

   !> Parameters of the slope reduction, all [-]
   type :: slope_reduction
      !> Factor at vanishing creepage, share of it that is left at large creepage, rate of change
      real(wp) :: k0 = 1.0_wp, alpha = 1.0_wp, beta = 1.0_wp
   end type slope_reduction

   !> Smallest characteristic creepage [-] that creepages are compared with: no friction force gives none
   real(wp), parameter :: min_characteristic = 1.0e-10_wp

contains

   !> Ellipse with the area of a contact area and the proportions of its bounding box
   pure function equivalent_ellipse(contact, dx, dy) result(self)
      !> Elements in contact, shape (mx, my)
      logical, intent(in) :: contact(:, :)
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      type(ellipse) :: self
      integer :: ix, iy, ix0, ix1, iy0, iy1, n
      real(wp) :: c, proportion

      n = 0
      ix0 = size(contact, 1) + 1
      ix1 = 0
      iy0 = size(contact, 2) + 1
      iy1 = 0
      do iy = 1, size(contact, 2)
         do ix = 1, size(contact, 1)
            if (.not. contact(ix, iy)) cycle
            n = n + 1
            ix0 = min(ix0, ix)
            ix1 = max(ix1, ix)
            iy0 = min(iy0, iy)
            iy1 = iy
         end do
      end do
      if (n == 0) return
      c = sqrt(n*dx*dy/pi)
      proportion = sqrt((ix1 - ix0 + 1)*dx/((iy1 - iy0 + 1)*dy))
      self = ellipse(c*proportion, c/proportion)
   end function equivalent_ellipse

   !> Flexibilities for longitudinal, lateral and spin creepage [mm3/N]: equal forces at
   !> vanishing creepage, Kalker (1982)
   pure function three_flexibilities(area, gg, nu) result(flx)
      !> Semi-axes of the contact area [mm]
      type(ellipse), intent(in) :: area
      !> Combined modulus of rigidity [N/mm2] and Poisson ratio [-]
      real(wp), intent(in) :: gg, nu
      real(wp) :: flx(3)
      type(creepage_coefficients) :: c

      c = kalker_coefficients(area%aa, area%bb, nu)
      flx(1) = 8.0_wp*area%aa/(3.0_wp*c%c11*gg)
      flx(2) = 8.0_wp*area%aa/(3.0_wp*c%c22*gg)
      flx(3) = pi*area%aa*sqrt(area%aa/area%bb)/(4.0_wp*c%c23*gg)
   end function three_flexibilities

   !> Three values that approach a common one as the creepage grows
   !>
   !> The common value is the mean that Kalker (1982) gives for combined creepages.
   pure function blended_flexibilities(flx, area, gg, nu, load, creep, spin) result(blend)
      !> Values for vanishing creepage [mm3/N]
      real(wp), intent(in) :: flx(3)
      !> Semi-axes of the contact area [mm]
      type(ellipse), intent(in) :: area
      !> Combined modulus of rigidity [N/mm2] and Poisson ratio [-]
      real(wp), intent(in) :: gg, nu
      !> Largest friction force mu Fn [N]
      real(wp), intent(in) :: load
      !> Creepages [-] and spin [rad/mm]
      real(wp), intent(in) :: creep(2), spin
      real(wp) :: blend(3)
      type(creepage_coefficients) :: c
      real(wp) :: characteristic, weight, psi, total, mean

      c = kalker_coefficients(area%aa, area%bb, nu)
      characteristic = load/(area%aa*area%bb*gg)*hypot(1.0_wp/c%c11, 1.0_wp/c%c22)
      weight = min(1.0_wp, norm2(creep)/(3.0_wp*max(min_characteristic, characteristic)))
      ! pi a**2/4 over 8 a/3: the factors by which the three flexibilities weigh the creepages
      psi = spin*3.0_wp*pi*area%aa/32.0_wp
      total = hypot(norm2(creep), psi)
      mean = flx(1)
      if (total > 0.0_wp) mean = 1.0_wp/((creep(1)/total)**2/flx(1) + (creep(2)/total)**2/flx(2) + (psi/total)**2/flx(3))
      blend = (1.0_wp - weight)*flx + weight*mean
   end function blended_flexibilities

   !> Factor k by which stiffness 1/L is reduced [-]
   pure real(wp) function slope_factor(reduction, area, gg, nu, load, creep, spin) result(k)
      !> Parameters of the reduction for contaminated surfaces
      type(slope_reduction), intent(in) :: reduction
      !> Semi-axes of the contact area [mm]
      type(ellipse), intent(in) :: area
      !> Combined modulus of rigidity [N/mm2] and Poisson ratio [-]
      real(wp), intent(in) :: gg, nu
      !> Friction force in full sliding, mu Fn, with the friction of sliding [N]
      real(wp), intent(in) :: load
      !> Creepages [-]; spin [rad/mm], positive where it adds to the lateral slip at the leading edge: times -1 in rolling
      !> towards decreasing x
      real(wp), intent(in) :: creep(2), spin
      type(creepage_coefficients) :: c
      real(wp) :: lateral, share

      k = reduction%k0
      if (reduction%alpha >= 1.0_wp .or. reduction%beta <= 0.0_wp) return
      lateral = creep(2) + spin*area%aa
      if (abs(lateral) < abs(creep(2))) lateral = creep(2)
      c = kalker_coefficients(area%aa, area%bb, nu)
      ! share: ratio of the slip area to the area of adhesion, Spiryagin et al. (2013), times the load
      share = 0.25_wp*pi*gg*area%aa*area%bb*reduction%k0*c%c11*hypot(creep(1), lateral)
      k = reduction%k0*(reduction%alpha + (1.0_wp - reduction%alpha)*load/max(load + reduction%beta*share, tiny(load)))
   end function slope_factor
end module contact_simplified_flexibility
