!> FaStrip: adhesion by strip theory, direction of slip by Fastsim (Sichani, Enblom and Berg 2016)
!>
!> Each row of an elliptic contact is treated as a strip in line contact. In its adhesion area, at the leading edge, the tractions
!> are those of strip theory (Haines and Ollerton 1963, Kalker 1967), with creepages scaled such that the forces at vanishing
!> creepage are Kalker's. In the slip area the tractions are on the bound, in the direction computed by Fastsim.
module contact_simplified_fastrip
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_simplified_flexibility, only : ellipse
   use contact_simplified_kalker, only : creepage_coefficients, kalker_coefficients
   implicit none (type, external)
   private

   public :: strip_data, apply_strip_theory, slip_half_length

   !> Data of the contact for strip theory
   type :: strip_data
      !> Ellipse equivalent to the contact area, coordinates of its centre [mm]
      type(ellipse) :: area
      real(wp) :: centre(2) = 0.0_wp
      !> Combined modulus of rigidity [N/mm2] and Poisson ratio [-]
      real(wp) :: gg = 1.0_wp, nu = 0.0_wp
      !> Normal force [N]
      real(wp) :: fn = 0.0_wp
      !> Reduction factor of the stiffness for contaminated surfaces [-]
      real(wp) :: slope = 1.0_wp
      !> Creepages at the spin centre [-], spin [rad/mm], spin centre [mm]
      real(wp) :: creep(2) = 0.0_wp, spin = 0.0_wp, spin_centre(2) = 0.0_wp
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer :: direction = 1
   end type strip_data

contains

   !> Replace Fastsim's tractions, row by row and in each row for each run of neighbouring elements in contact
   pure subroutine apply_strip_theory(data, x, y, dx, mu, contact, bound, p, slip, division, scratch)
      !> Ellipse, material, force and creepages for strip theory
      type(strip_data), intent(in) :: data
      !> Centres of the columns and rows [mm], shapes (mx) and (my)
      real(wp), contiguous, intent(in) :: x(:), y(:)
      !> Width of the elements [mm]
      real(wp), intent(in) :: dx
      !> Coefficient of friction of each row [-], shape (my)
      real(wp), intent(in) :: mu(:)
      !> Elements in contact, shape (mx, my)
      logical, contiguous, intent(in) :: contact(:, :)
      !> Traction bound [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: bound(:, :)
      !> On entry the solution of Fastsim: tractions [N/mm2] and slip per step [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: p(:, :, :), slip(:, :, :)
      !> Element states, shape (mx, my)
      integer, contiguous, intent(inout) :: division(:, :)
      !> Workspace of the shape of p; its contents are not used
      real(wp), contiguous, intent(inout) :: scratch(:, :, :)
      type(creepage_coefficients) :: c
      integer :: mx, iy, first, last

      mx = size(contact, 1)
      c = kalker_coefficients(data%area%aa, data%area%bb, data%nu)
      do iy = 1, size(contact, 2)
         if (mu(iy)*data%fn <= 0.0_wp) cycle
         last = 0
         do
            first = last + 1
            do while (first <= mx)
               if (contact(first, iy)) exit
               first = first + 1
            end do
            if (first > mx) exit
            last = first
            do while (last < mx)
               if (.not. contact(last + 1, iy)) exit
               last = last + 1
            end do
            call one_strip(data, c, first, last, x, y(iy), dx, mu(iy), bound(:, iy), p(:, iy, 1), p(:, iy, 2), slip(:, iy, 1), &
               & slip(:, iy, 2), division(:, iy), scratch(:, iy, 1), scratch(:, iy, 2))
         end do
      end do
   end subroutine apply_strip_theory

   !> One strip: adhesion from strip theory if that is possible
   pure subroutine one_strip(data, c, first, last, x, y, dx, mu, bound, px, py, sx, sy, division, along, across)
      type(strip_data), intent(in) :: data
      !> Kalker's coefficients of the ellipse [-]
      type(creepage_coefficients), intent(in) :: c
      !> First and last element of the strip in its row
      integer, intent(in) :: first, last
      !> Row: centres [mm], coefficient of friction [-] and traction bounds [N/mm2]
      real(wp), contiguous, intent(in) :: x(:), bound(:)
      real(wp), intent(in) :: y, dx, mu
      !> Tractions [N/mm2], and slip per step [mm]
      real(wp), contiguous, intent(inout) :: px(:), py(:), sx(:), sy(:)
      integer, contiguous, intent(inout) :: division(:)
      !> Workspace: tractions by strip theory relative to the largest bound [-]
      real(wp), contiguous, intent(inout) :: along(:), across(:)
      real(wp) :: creep(2), spin, q, a, half, middle, d, size_, kappa, lambda, xi, length, largest, peak, edge, factor
      integer :: i, n, sticks(2)

      n = last - first + 1
      a = data%area%aa
      half = 0.5_wp*n*dx
      middle = 0.5_wp*(x(first) + x(last))
      creep(1) = data%creep(1) - data%spin*(data%centre(2) - data%spin_centre(2))
      creep(2) = data%creep(2) + data%spin*(middle - data%spin_centre(1))
      call scale_creepages(data, c, mu, creep, spin)
      ! relative to the leading edge: rolling towards decreasing x is the mirror image
      creep(1) = data%direction*creep(1)
      spin = data%direction*spin
      q = creep(1) - spin*(y - data%centre(2))/a
      d = slip_half_length(a, data%nu, q, creep(2), spin)
      kappa = q
      lambda = creep(2) + spin*min(d, half)/a
      size_ = hypot(kappa, lambda)
      if (size_ > 0.0_wp) then
         kappa = kappa/size_
         lambda = lambda/size_
      end if
      ! elements in adhesion, at the leading edge
      sticks = [first, last]
      edge = 2.0_wp*min(d, half) - half
      if (data%direction > 0) then
         do while (sticks(1) <= last)
            if (x(sticks(1)) - middle > edge) exit
            sticks(1) = sticks(1) + 1
         end do
      else
         do while (sticks(2) >= first)
            if (middle - x(sticks(2)) > edge) exit
            sticks(2) = sticks(2) - 1
         end do
      end if
      if (d <= half) then
         largest = 0.0_wp
         do i = sticks(1), sticks(2)
            xi = data%direction*(x(i) - middle)
            along(i) = root(half**2 - xi**2)/a
            across(i) = root((half - d)**2 - (xi - d)**2)/a
         end do
         do i = sticks(1), sticks(2)
            length = across(i)
            across(i) = lambda*along(i) - (lambda - spin)*length
            along(i) = kappa*(along(i) - length)
            largest = max(largest, along(i)**2 + across(i)**2)
         end do
         if (largest > 1.0_wp) return
      end if
      peak = mu*peak_pressure(data)
      ! tractions are of the order of pressures: their squares neither overflow nor vanish
      ! tractions of strip theory may exceed the bound of the actual pressures
      do i = sticks(1), sticks(2)
         px(i) = data%direction*along(i)*peak
         py(i) = across(i)*peak
         length = sqrt(px(i)**2 + py(i)**2)
         factor = bound(i)/max(length, bound(i), tiny(length))
         px(i) = px(i)*factor
         py(i) = py(i)*factor
      end do
      do i = sticks(1), sticks(2)
         sx(i) = 0.0_wp
         sy(i) = 0.0_wp
         division(i) = element%adhesion
      end do
      associate (along_x => data%direction*kappa, before => sticks(1) - first, after => last - max(sticks(2), first - 1))
         call slide(before, along_x, lambda, bound(first:), px(first:), py(first:), division(first:))
         call slide(after, along_x, lambda, bound(last - after + 1:), px(last - after + 1:), py(last - after + 1:), &
            & division(last - after + 1:))
      end associate
   end subroutine one_strip

   !> Tractions on the bound, in the direction computed by Fastsim, or in that of strip theory if they are zero
   pure subroutine slide(n, along, across, bound, px, py, division)
      !> Number of elements
      integer, intent(in) :: n
      !> Direction of strip theory [-]
      real(wp), intent(in) :: along, across
      !> Traction bounds [N/mm2]
      real(wp), intent(in) :: bound(n)
      !> Tractions [N/mm2]
      real(wp), intent(inout) :: px(n), py(n)
      integer, intent(inout) :: division(n)
      real(wp) :: length, factor
      integer :: i

      do i = 1, n
         length = sqrt(px(i)**2 + py(i)**2)
         factor = bound(i)/merge(length, 1.0_wp, length > 0.0_wp)
         px(i) = merge(px(i)*factor, along*bound(i), length > 0.0_wp)
         py(i) = merge(py(i)*factor, across*bound(i), length > 0.0_wp)
         division(i) = element%slip
      end do
   end subroutine slide

   !> Square root, 0 for negative numbers
   elemental real(wp) function root(square)
      real(wp), intent(in) :: square

      root = 0.0_wp
      if (square > 0.0_wp) root = sqrt(square)
   end function root

   !> Scale the creepages and the spin of the contact to those of a strip, in place
   !>
   !> The factors are Kalker's coefficients over those of a strip, pi**2/(4 (1 - nu)) and so on.
   pure subroutine scale_creepages(data, c, mu, creep, spin)
      type(strip_data), intent(in) :: data
      !> Kalker's coefficients of the ellipse [-]
      type(creepage_coefficients), intent(in) :: c
      !> Coefficient of friction [-]
      real(wp), intent(in) :: mu
      !> Creepages [-] on entry, scaled on exit
      real(wp), intent(inout) :: creep(2)
      !> Scaled spin [-]
      real(wp), intent(out) :: spin
      real(wp) :: unit

      unit = -data%slope*data%gg/(mu*peak_pressure(data))
      creep(1) = unit*2.0_wp*(1.0_wp - data%nu)*c%c11/pi**2*creep(1)
      creep(2) = unit*2.0_wp*(1.0_wp - data%nu)*c%c22/pi**2*creep(2)
      spin = unit*3.0_wp*sqrt(data%area%aa*data%area%bb)*c%c23/(2.0_wp*pi)*data%spin
   end subroutine scale_creepages

   !> Half-length of the slip area by strip theory [mm]; huge in full sliding
   !>
   !> Root of a quadratic equation, in the form without cancellation
   elemental real(wp) function slip_half_length(a, nu, q, eta, spin) result(d)
      !> Semi-axis of the ellipse along x [mm], Poisson ratio
      real(wp), intent(in) :: a, nu
      !> Scaled creepages of the strip: longitudinal, including the contribution of spin, and lateral; scaled spin [-]
      real(wp), intent(in) :: q, eta, spin
      !> Spin above which there is no adhesion area [-]
      real(wp), parameter :: excessive = 1.0e8_wp
      !> Denominators, of order 1, below this value mean full sliding: round-off is about 1e-16
      real(wp), parameter :: no_adhesion = 1.0e-12_wp
      real(wp) :: size_, q1, eta1, discriminant, root

      d = huge(d)
      if (abs(spin) > excessive) return
      size_ = max(abs(q), abs(eta))
      if (size_ <= 0.0_wp) then
         d = 0.0_wp
         return
      end if
      q1 = q/size_
      eta1 = eta/size_
      discriminant = eta1**2 + (1.0_wp - spin**2)*q1**2
      if (discriminant < 0.0_wp) return
      root = sqrt(discriminant)
      if (eta1*spin > 0.0_wp) then
         if (1.0_wp - spin**2 < no_adhesion) return
         d = size_*(a/(1.0_wp - nu))*((root + eta1*spin)/(1.0_wp - spin**2))
      else
         if (root - eta1*spin < no_adhesion) return
         d = size_*(a/(1.0_wp - nu))*((eta1**2 + q1**2)/(root - eta1*spin))
      end if
   end function slip_half_length

   !> Maximum pressure of the Hertz distribution on the ellipse [N/mm2]
   pure real(wp) function peak_pressure(data) result(p0)
      type(strip_data), intent(in) :: data

      p0 = 1.5_wp*data%fn/(pi*data%area%aa*data%area%bb)
   end function peak_pressure
end module contact_simplified_fastrip
