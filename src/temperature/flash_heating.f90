!> Surface temperatures of two rolling bodies: conduction between them and frictional heat
!>
!> Fast particles carry heat away before it spreads laterally: below each element there is one-dimensional conduction into a
!> half-space, Carslaw and Jaeger (1959), Ertz and Knothe (2002). A heat flux q(x) into a body of effusivity beta that moves at
!> velocity V gives
!>
!>     T(x) = T_0 + 1/(beta sqrt(pi V)) * integral of q(x')/sqrt(|x - x'|) over all x' upstream.
!>
!> Surfaces in contact have the same temperature. Frictional heat is therefore divided in proportion to the effusivities, and
!> both surfaces have the same temperature rise.
module contact_temperature_flash_heating
   use contact_base_choices, only : heat_source
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_friction_heated, only : heated_law
   use contact_friction_memory, only : friction_memory
   implicit none (type, external)
   private

   public :: body_pair, heat_passage, min_peclet_number, new_body_pair

   !> Above this Peclet number, conduction along the surface changes the maximum temperature by less than 3 %
   real(wp), parameter :: min_peclet_number = 10.0_wp

   !> Thermal constants of both bodies
   type :: body_pair
      !> Bulk temperatures [degC]
      real(wp) :: bulk(2) = 0.0_wp
      !> Effusivities sqrt(lambda rho c) [N/(mm sqrt(s) degC)]
      real(wp) :: effusivity(2) = 1.0_wp
      !> Thermal diffusivities lambda/(rho c) [mm2/s]
      real(wp) :: diffusivity(2) = 0.0_wp
      !> Fraction of the plastic work converted into heat [-]
      real(wp) :: plastic_share = 1.0_wp
      !> Member of heat_source
      integer :: source = heat_source%established
   contains
      !> Ratio of transport along the surface to conduction
      procedure :: peclet_number
      !> Common temperature of bodies in contact, without friction
      procedure :: interface_temperature
   end type body_pair

   !> State of the surfaces along their path through the grid
   type :: heat_passage
      type(body_pair) :: bodies
      !> Side of the elements along x [mm], velocity [mm/s]
      real(wp) :: dx = 1.0_wp, veloc = 1.0_wp
      !> Rolling towards increasing (+1) or decreasing (-1) x; particles move in the opposite direction
      integer :: direction = 1
      !> Elements in contact, shape (mx, my)
      logical, allocatable :: contact(:, :)
   contains
      !> Temperatures without friction
      procedure :: conduct
      !> Temperatures for a given frictional heat
      procedure :: surface_temperatures
      !> Friction coefficients consistent with the temperatures they cause
      procedure :: heat_by_friction
      !> Error by heat that is constant on elements
      procedure :: error_of_constant_heat
      procedure, private :: weights
      procedure, private :: rise_per_heat
   end type heat_passage

contains

   !> Create from bulk temperatures [degC], specific heats [J/(kg degC)], conductivities [W/(mm degC)], densities [kg/mm3]
   pure function new_body_pair(bulk, specific_heat, conductivity, density, plastic_share) result(bodies)
      !> Values of bodies 1 and 2 in these units
      real(wp), intent(in) :: bulk(2), specific_heat(2), conductivity(2), density(2)
      !> Fraction of the plastic work converted into heat [-]
      real(wp), intent(in) :: plastic_share
      type(body_pair) :: bodies
      !> N mm per J
      real(wp), parameter :: newton_millimetres = 1.0e3_wp

      bodies%bulk = bulk
      bodies%effusivity = newton_millimetres*sqrt(conductivity*density*specific_heat)
      ! W/(mm degC) over J/(mm3 degC)
      bodies%diffusivity = conductivity/(density*specific_heat)
      bodies%plastic_share = plastic_share
   end function new_body_pair

   !> Peclet number V a/(2 kappa) [-], the smaller value of both bodies
   pure real(wp) function peclet_number(self, half_length, veloc) result(number)
      class(body_pair), intent(in) :: self
      !> Half the length of the source along x [mm], velocity [mm/s]
      real(wp), intent(in) :: half_length, veloc

      number = abs(veloc)*half_length/(2.0_wp*maxval(self%diffusivity))
   end function peclet_number

   !> Mean of the bulk temperatures, weighted by the effusivities
   !>
   !> The original program exchanges the weights; for equal effusivities there is no difference.
   pure real(wp) function interface_temperature(self) result(temperature)
      class(body_pair), intent(in) :: self
      temperature = dot_product(self%effusivity, self%bulk)/sum(self%effusivity)
   end function interface_temperature

   !> Temperatures [degC] by conduction between bodies of different bulk temperature
   !>
   !> In contact both surfaces have the interface temperature. Behind the contact a surface cools: if it was held at T_m over a
   !> length l, it has T_0 + (T_m - T_0)(2/pi) asin(sqrt(l/d)) at distance d > l from the leading edge.
   pure subroutine conduct(self, t1, t2)
      class(heat_passage), intent(in) :: self
      !> Temperatures of bodies 1 and 2 [degC], shape (mx, my)
      real(wp), contiguous, intent(inout) :: t1(:, :), t2(:, :)
      real(wp) :: shared, rest
      integer :: ix, iy, first, last, passed, length

      shared = self%bodies%interface_temperature()
      first = merge(size(t1, 1), 1, self%direction > 0)
      last = size(t1, 1) + 1 - first
      do iy = 1, size(t1, 2)
         ! number of elements since the leading edge, and up to the end of the contact so far
         passed = 0
         length = 0
         do ix = first, last, -self%direction
            if (passed > 0 .or. self%contact(ix, iy)) passed = passed + 1
            if (self%contact(ix, iy)) length = passed
            rest = 0.0_wp
            if (self%contact(ix, iy)) then
               rest = 1.0_wp
            else if (passed > 0) then
               rest = 2.0_wp/pi*asin(sqrt(length/(passed - 0.5_wp)))
            end if
            t1(ix, iy) = self%bodies%bulk(1) + rest*(shared - self%bodies%bulk(1))
            t2(ix, iy) = self%bodies%bulk(2) + rest*(shared - self%bodies%bulk(2))
         end do
      end do
   end subroutine conduct

   !> Temperatures [degC] for a given frictional heat
   pure subroutine surface_temperatures(self, heat, t1, t2)
      class(heat_passage), intent(in) :: self
      !> Frictional heat [N/(mm s)], shape (mx, my)
      real(wp), contiguous, intent(in) :: heat(:, :)
      !> Temperatures of bodies 1 and 2 [degC], shape (mx, my)
      real(wp), contiguous, intent(inout) :: t1(:, :), t2(:, :)
      real(wp), allocatable :: weight(:), rise(:)
      integer :: ix, iy, jx, m, first, last

      call self%conduct(t1, t2)
      m = size(heat, 1)
      allocate(rise(m))
      weight = self%weights(m)
      first = merge(m, 1, self%direction > 0)
      last = m + 1 - first
      do iy = 1, size(heat, 2)
         if (.not. any(heat(:, iy) > 0.0_wp)) cycle
         ! rise(k): k elements from the leading edge
         rise = 0.0_wp
         jx = 0
         do ix = first, last, -self%direction
            jx = jx + 1
            if (heat(ix, iy) > 0.0_wp) rise(jx:) = rise(jx:) + heat(ix, iy)*weight(:m - jx + 1)
         end do
         rise = rise*self%rise_per_heat()
         if (self%direction > 0) rise = rise(m:1:-1)
         t1(:, iy) = t1(:, iy) + rise
         t2(:, iy) = t2(:, iy) + rise
      end do
   end subroutine surface_temperatures

   !> Consistent coefficients of friction and temperatures for a given slip velocity
   !>
   !> The temperature of an element depends only on upstream elements and on the element itself. Marching with the particles
   !> therefore solves for both at once, whereas alternating between them oscillates if friction decreases steeply with
   !> temperature. The memory uses the lower bound of the slip velocity instead of the slip velocity itself, as in the original
   !> program. Particles enter with the coefficient of the interface temperature, and ahead of and behind the contact friction is
   !> that of the temperature which both surfaces would have if they touched: without frictional heat nothing changes, and neither
   !> the size of the grid nor the order of the bodies counts.
   subroutine heat_by_friction(self, law, memory, pn, speed, heat, dt, mu, t1)
      class(heat_passage), intent(in) :: self
      !> Law whose coefficient depends on temperature
      type(heated_law), intent(in) :: law
      !> Adaptation of the coefficients along the path of the particles; its slip velocity is the lower bound
      type(friction_memory), intent(in) :: memory
      !> Pressure [N/mm2], and slip velocity [mm/s] of elements whose traction is mu pn, shape (mx, my)
      real(wp), contiguous, intent(in) :: pn(:, :), speed(:, :)
      !> Heat from other sources [N/(mm s)], shape (mx, my)
      real(wp), contiguous, intent(in) :: heat(:, :)
      !> Time in which particles pass one element [s]
      real(wp), intent(in) :: dt
      !> Coefficients [-] and temperatures of body 1 [degC], shape (mx, my)
      real(wp), contiguous, intent(inout) :: mu(:, :), t1(:, :)
      real(wp), allocatable :: weight(:), rise(:), t2(:, :)
      real(wp) :: before, own, given, released, per_heat, shared, cold, theta
      integer :: ix, iy, jx, m, first, last

      m = size(pn, 1)
      allocate(rise(m), t2(m, size(pn, 2)))
      call self%conduct(t1, t2)
      weight = self%weights(m)
      per_heat = self%rise_per_heat()
      shared = self%bodies%interface_temperature()
      theta = memory%weight(0.0_wp, dt)
      first = merge(m, 1, self%direction > 0)
      last = m + 1 - first
      do iy = 1, size(pn, 2)
         rise = 0.0_wp
         before = law%self_heated(iy, shared, rise=0.0_wp, theta=0.0_wp, mu_before=0.0_wp)
         jx = 0
         do ix = first, last, -self%direction
            jx = jx + 1
            given = heat(ix, iy)
            cold = shared + per_heat*(rise(jx) + weight(1)*given)
            own = pn(ix, iy)*speed(ix, iy)
            mu(ix, iy) = law%self_heated(iy, cold, per_heat*weight(1)*own, theta, before)
            before = mu(ix, iy)
            released = given + mu(ix, iy)*own
            if (released > 0.0_wp) rise(jx:) = rise(jx:) + released*weight(:m - jx + 1)
            t1(ix, iy) = t1(ix, iy) + per_heat*rise(jx)
         end do
      end do
   end subroutine heat_by_friction

   !> Integrals of 1/(2 sqrt(distance)) over elements 0, 1, ... m - 1 positions upstream [sqrt(mm)]
   !>
   !> Particles at the centre of an element have received the heat of half of it. The established program counts this twice,
   !> which increases temperatures by a term of the order of sqrt(dx).
   pure function weights(self, m) result(weight)
      class(heat_passage), intent(in) :: self
      integer, intent(in) :: m
      real(wp) :: weight(m)
      integer :: k

      weight(1) = sqrt(0.5_wp*self%dx)
      if (self%bodies%source == heat_source%established) weight(1) = 2.0_wp*weight(1)
      do k = 2, m
         ! difference of two roots, without cancellation
         weight(k) = sqrt(self%dx)/(sqrt(k - 0.5_wp) + sqrt(k - 1.5_wp))
      end do
   end function weights

   !> Error of a temperature by heat that is constant on elements, whose own heat counts once [degC]
   !>
   !> The sum of k (sqrt(k + 1/2) - sqrt(k - 1/2)) over the elements k upstream exceeds the integral of s/(2 sqrt(s)) by
   !> -zeta(-1/2, 1/2), whatever their number.
   pure real(wp) function error_of_constant_heat(self, change) result(error)
      class(heat_passage), intent(in) :: self
      !> Increase of the heat over an element along the path of the particles [N/(mm s)]
      real(wp), intent(in) :: change
      !> zeta(-1/2, 1/2) = (1/sqrt(2) - 1) zeta(-1/2)
      real(wp), parameter :: zeta = 0.06088_wp

      error = zeta*sqrt(self%dx)*change*self%rise_per_heat()
   end function error_of_constant_heat

   !> Temperature rise per heat and weight [degC/(N/(mm s))/sqrt(mm)]
   pure real(wp) function rise_per_heat(self) result(rise)
      class(heat_passage), intent(in) :: self
      rise = 2.0_wp/(sum(self%bodies%effusivity)*sqrt(pi*self%veloc))
   end function rise_per_heat
end module contact_temperature_flash_heating
