!> Flexibilities of the simplified theory, which replace the influence coefficients of the half-space
!>
!> The displacement of a surface particle depends on its own traction only, u = L p. Three values of L reproduce the forces of
!> Kalker's linear theory at vanishing creepage; they are blended into one as slip spreads (Vollebregt and Voltr 2023), and increase
!> with the slip area for contaminated surfaces (Spiryagin, Polach and Cole 2013).
module contact_simplified_flexibility
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : bounding_box
   use contact_simplified_kalker, only : creepage_coefficients, kalker_coefficients
   implicit none (type, external)
   private

   public :: contact_extent, ellipse, equivalent_ellipse, three_flexibilities, blended_flexibilities
   public :: slope_reduction, slope_factor

   !> Semi-axes along and across the rolling direction [mm]
   type :: ellipse
      real(wp) :: aa = 0.0_wp, bb = 0.0_wp
   end type ellipse

   !> Parameters of the slope reduction of contaminated surfaces, all [-]
   type :: slope_reduction
      !> Factor at vanishing creepage, fraction of it at large creepage, rate of change
      real(wp) :: k0 = 1.0_wp, alpha = 1.0_wp, beta = 1.0_wp
   end type slope_reduction

   !> Lower bound of the characteristic creepage [-], which is zero without friction force
   real(wp), parameter :: min_characteristic = 1.0e-10_wp

contains

   !> Ellipse with the area of the contact area and the aspect ratio of its bounding box
   pure function equivalent_ellipse(n, box, dx, dy) result(self)
      !> Number of elements, 0: the semi-axes are zero
      integer, intent(in) :: n
      !> See `contact_extent`
      type(bounding_box), intent(in) :: box
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      type(ellipse) :: self
      real(wp) :: c, proportion

      if (n == 0) return
      c = sqrt(n*dx*dy/pi)
      proportion = sqrt((box%ix1 - box%ix0 + 1)*dx/((box%iy1 - box%iy0 + 1)*dy))
      self = ellipse(c*proportion, c/proportion)
   end function equivalent_ellipse

   !> Number of elements in contact, and the smallest rectangle that contains them
   pure subroutine contact_extent(contact, n, box)
      !> Elements in contact, shape (mx, my)
      logical, contiguous, intent(in) :: contact(:, :)
      !> Number
      integer, intent(out) :: n
      !> Rectangle; empty without contact
      type(bounding_box), intent(out) :: box
      integer :: iy, first, last, mx

      mx = size(contact, 1)
      n = 0
      box = bounding_box(mx + 1, 0, size(contact, 2) + 1, 0)
      do iy = 1, size(contact, 2)
         do first = 1, mx
            if (contact(first, iy)) exit
         end do
         if (first > mx) cycle
         do last = mx, first, -1
            if (contact(last, iy)) exit
         end do
         n = n + count(contact(first:last, iy))
         box = bounding_box(min(box%ix0, first), max(box%ix1, last), min(box%iy0, iy), iy)
      end do
   end subroutine contact_extent

   !> Flexibilities for longitudinal, lateral and spin creepage [mm3/N] that give the forces of linear theory at vanishing creepage,
   !> Kalker (1982)
   pure function three_flexibilities(area, gg, nu) result(flx)
      !> Semi-axes of the contact ellipse [mm]
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

   !> Three flexibilities that approach a common value with increasing creepage
   !>
   !> The common value is the mean of Kalker (1982) for combined creepages.
   pure function blended_flexibilities(flx, area, gg, nu, load, creep, spin) result(blend)
      !> Flexibilities at vanishing creepage [mm3/N]
      real(wp), intent(in) :: flx(3)
      !> Semi-axes of the contact ellipse [mm]
      type(ellipse), intent(in) :: area
      !> Combined modulus of rigidity [N/mm2] and Poisson ratio [-]
      real(wp), intent(in) :: gg, nu
      !> Maximum friction force mu Fn [N]
      real(wp), intent(in) :: load
      !> Creepages [-] and spin [rad/mm]
      real(wp), intent(in) :: creep(2), spin
      real(wp) :: blend(3)
      type(creepage_coefficients) :: c
      real(wp) :: characteristic, weight, psi, total, mean

      c = kalker_coefficients(area%aa, area%bb, nu)
      characteristic = load/(area%aa*area%bb*gg)*hypot(1.0_wp/c%c11, 1.0_wp/c%c22)
      weight = min(1.0_wp, norm2(creep)/(3.0_wp*max(min_characteristic, characteristic)))
      ! pi a**2/4 over 8 a/3: the weights of the three creepages
      psi = spin*3.0_wp*pi*area%aa/32.0_wp
      total = hypot(norm2(creep), psi)
      mean = flx(1)
      if (total > 0.0_wp) mean = 1.0_wp/((creep(1)/total)**2/flx(1) + (creep(2)/total)**2/flx(2) + (psi/total)**2/flx(3))
      blend = (1.0_wp - weight)*flx + weight*mean
   end function blended_flexibilities

   !> Factor k by which the stiffness 1/L is reduced [-]
   pure real(wp) function slope_factor(reduction, area, gg, nu, load, creep, spin) result(k)
      !> Parameters of the reduction for contaminated surfaces
      type(slope_reduction), intent(in) :: reduction
      !> Semi-axes of the contact ellipse [mm]
      type(ellipse), intent(in) :: area
      !> Combined modulus of rigidity [N/mm2] and Poisson ratio [-]
      real(wp), intent(in) :: gg, nu
      !> Friction force in full sliding, mu Fn, with the kinetic coefficient of friction [N]
      real(wp), intent(in) :: load
      !> Creepages [-]; spin [rad/mm], positive where it adds to the lateral slip at the leading edge: multiplied by -1 when rolling
      !> towards decreasing x
      real(wp), intent(in) :: creep(2), spin
      type(creepage_coefficients) :: c
      real(wp) :: lateral, share

      k = reduction%k0
      if (reduction%alpha >= 1.0_wp .or. reduction%beta <= 0.0_wp) return
      lateral = creep(2) + spin*area%aa
      if (abs(lateral) < abs(creep(2))) lateral = creep(2)
      c = kalker_coefficients(area%aa, area%bb, nu)
      ! share: ratio of the slip area to the adhesion area, Spiryagin et al. (2013), times the load
      share = 0.25_wp*pi*gg*area%aa*area%bb*reduction%k0*c%c11*hypot(creep(1), lateral)
      k = reduction%k0*(reduction%alpha + (1.0_wp - reduction%alpha)*load/max(load + reduction%beta*share, tiny(load)))
   end function slope_factor
end module contact_simplified_flexibility
