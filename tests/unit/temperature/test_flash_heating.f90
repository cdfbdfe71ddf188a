!> Surface temperatures: uniform and elliptical sources, orders, cooling, both bodies, own friction
program test_flash_heating
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type
   use contact_base_choices, only : heat_source
   use contact_base_kinds, only : wp
   use contact_friction_heated, only : heated_law
   use contact_friction_law, only : friction_law, friction_set
   use contact_friction_memory, only : friction_memory
   use contact_friction_new_law, only : friction_model, new_friction_law
   use contact_temperature_flash_heating, only : body_pair, heat_passage, min_peclet_number, new_body_pair
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> Half the length of the contact [mm], velocity [mm/s], heat flux [N/(mm s)]
   real(wp), parameter :: half_length = 4.0_wp, veloc = 2.5e4_wp, flux = 3.0e5_wp
   type(test_suite) :: suite

   call suite%start("flash heating")
   call flash_temperatures(suite)
   call partition(suite)
   call slow_motion(suite)
   call constants(suite)
   call uniform_source(suite)
   call elliptical_source(suite)
   call factor_two(suite)
   call conduction(suite)
   call mirror(suite)
   call own_friction(suite)
   call warm_bodies(suite)
   call limits(suite)
   call suite%finish()

contains

   !> One row of n elements over three lengths of the contact, which is the second third
   type(heat_passage) function row(n) result(passage)
      integer, intent(in) :: n
      integer :: i

      passage%bodies%effusivity = [14.0_wp, 9.0_wp]
      passage%dx = 6.0_wp*half_length/n
      passage%veloc = veloc
      passage%direction = -1
      passage%bodies%source = heat_source%moving
      allocate(passage%contact(n, 1))
      passage%contact(:, 1) = [(3*i > n .and. 3*i <= 2*n, i=1, n)]
   end function row

   !> Distance of the centres from the leading edge [mm]
   pure function distance(passage) result(d)
      type(heat_passage), intent(in) :: passage
      real(wp) :: d(size(passage%contact, 1))
      integer :: i

      d = [((i - 0.5_wp)*passage%dx - 2.0_wp*half_length, i=1, size(d))]
   end function distance

   !> Highest temperatures of fast sources in the second third of a row, with a known heat per body
   !>
   !> Uniform band of half-length a: 2 q sqrt(2 a)/(beta sqrt(pi V)) at its trailing edge. Heat as a parabola,
   !> 1 - (x/a)**2: q sqrt(a)/(beta sqrt(pi V)) times the maximum of the polynomial that the integral of the parabola
   !> over 1/sqrt makes, sqrt(d) (8/3 d - 16/15 d**2), d in units of a from the leading edge, at d = 3/2.
   subroutine flash_temperatures(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: n(2) = [300, 1200]
      type(heat_passage) :: passage
      real(wp), allocatable :: t1(:, :), t2(:, :), heat(:, :), d(:)
      real(wp) :: scale, band, parabola, error(2)
      integer :: k

      scale = flux*sqrt(half_length)/(23.0_wp*sqrt(pi*veloc))
      band = 2.0_wp*sqrt(2.0_wp)*scale
      parabola = sqrt(1.5_wp)*(8.0_wp/3.0_wp*1.5_wp - 16.0_wp/15.0_wp*1.5_wp**2)*scale
      do k = 1, 2
         passage = row(n(k))
         allocate(t1(n(k), 1), t2(n(k), 1), heat(n(k), 1))
         d = distance(passage)/half_length
         heat = merge(flux, 0.0_wp, passage%contact)
         call passage%surface_temperatures(heat, t1, t2)
         error(k) = 1.0_wp - maxval(t1)/band
         heat(:, 1) = flux*max(0.0_wp, 1.0_wp - (d - 1.0_wp)**2)
         call passage%surface_temperatures(heat, t1, t2)
         call suite%close_to(maxval(t1)/parabola, 1.0_wp, 3.0e-4_wp, "parabolic source: highest temperature")
         call suite%close_to(maxval(t2)/parabola, 1.0_wp, 3.0e-4_wp, "parabolic source: both bodies")
         deallocate(t1, t2, heat)
      end do
      ! the last centre lies half an element before the trailing edge, of 100 and of 400 elements
      call suite%close_to(error(1), 1.0_wp - sqrt(1.0_wp - 0.5_wp/100.0_wp), 1.0e-9_wp, "uniform band: highest temperature")
      call suite%close_to(error(2), 1.0_wp - sqrt(1.0_wp - 0.5_wp/400.0_wp), 1.0e-9_wp, "uniform band, finer")
   end subroutine flash_temperatures

   !> Heat divides in proportion to the effusivities: an insulating body leaves all of it to the other one
   subroutine partition(suite)
      type(test_suite), intent(inout) :: suite
      type(heat_passage) :: passage
      real(wp) :: both(60, 1), alone(60, 1), t2(60, 1), heat(60, 1)

      passage = row(60)
      heat = merge(flux, 0.0_wp, passage%contact)
      passage%bodies%effusivity = [10.0_wp, 10.0_wp]
      call passage%surface_temperatures(heat, both, t2)
      passage%bodies%effusivity = [10.0_wp, 1.0e-9_wp]
      call passage%surface_temperatures(heat, alone, t2)
      call suite%close_to(alone(:, 1), 2.0_wp*both(:, 1), 1.0e-8_wp*maxval(alone), "equal bodies take half of the heat each")
      passage%bodies%effusivity = [30.0_wp, 10.0_wp]
      call passage%surface_temperatures(heat, both, t2)
      call suite%close_to(both(:, 1), 0.25_wp*alone(:, 1), 1.0e-8_wp*maxval(alone), "heat divides by the effusivities")
      call suite%close_to(both(:, 1), t2(:, 1), 0.0_wp, "the same temperature rise for both")
   end subroutine partition

   !> The limit below which the program warns: a moving band source with conduction along the surface (Carslaw and Jaeger)
   !> against the solution for fast motion
   subroutine slow_motion(suite)
      type(test_suite), intent(inout) :: suite
      type(body_pair) :: bodies

      call suite%close_to(fast_over_exact(min_peclet_number), 1.024_wp, 1.0e-3_wp, "at the limit of the Peclet number: 2.4 %")
      call suite%close_to(fast_over_exact(1.0_wp), 1.138_wp, 1.0e-3_wp, "too high in slow motion")
      call suite%close_to(fast_over_exact(400.0_wp), 1.0_wp, 1.5e-3_wp, "right in fast motion")
      bodies = new_body_pair([0.0_wp, 0.0_wp], [450.0_wp, 450.0_wp], [0.05_wp, 0.025_wp], [7.85e-6_wp, 7.85e-6_wp], 1.0_wp)
      call suite%close_to(bodies%peclet_number(5.88_wp, 30000.0_wp), 6231.3_wp, 1.0_wp, "Peclet number of the better conductor")
   end subroutine slow_motion

   !> Highest temperature of a uniform band in fast motion over that with conduction along the surface
   !>
   !> With u = V x/(2 kappa) and the Peclet number L: T = 2 q kappa/(pi k V) * integral of exp(w) K0(|w|) over the
   !> distances w to the parts of the source, positive upstream, and in fast motion 2 q kappa/(pi k V) * 2 sqrt(pi L) at most.
   !> The integrals are x exp(x) (K0(x) + K1(x)) - 1 and x exp(-x) (K0(x) - K1(x)) + 1.
   real(wp) function fast_over_exact(l) result(ratio)
      real(wp), intent(in) :: l
      real(wp) :: highest, rise, k(2), d
      integer :: i

      ! the maximum lies at a distance d before the trailing edge
      highest = 0.0_wp
      do i = 0, 100
         d = 0.02_wp*i*min(1.0_wp, l)
         k = scaled_bessel(2.0_wp*l - d)
         rise = (2.0_wp*l - d)*(k(1) + k(2)) - 1.0_wp
         if (i > 0) then
            k = scaled_bessel(d)
            rise = rise + d*exp(-2.0_wp*d)*(k(1) - k(2)) + 1.0_wp
         end if
         highest = max(highest, rise)
      end do
      ratio = 2.0_wp*sqrt(pi*l)/highest
   end function fast_over_exact

   !> exp(w) K0(w), exp(w) K1(w) by the trapezoidal rule in s for exp(-w (cosh s - 1)), which converges exponentially
   function scaled_bessel(w) result(values)
      real(wp), intent(in) :: w
      real(wp) :: values(2)
      real(wp), parameter :: step = 0.05_wp
      real(wp) :: term, c
      integer :: i

      values = 0.5_wp
      do i = 1, 2000
         c = cosh(i*step)
         term = exp(-w*(c - 1.0_wp))
         values = values + [term, term*c]
         if (term*c < 1.0e-13_wp) exit
      end do
      values = values*step
   end function scaled_bessel

   subroutine constants(suite)
      type(test_suite), intent(inout) :: suite
      type(body_pair) :: bodies

      bodies = new_body_pair([20.0_wp, 20.0_wp], [450.0_wp, 900.0_wp], [0.05_wp, 0.1_wp], [8.0e-6_wp, 4.0e-6_wp], 1.0_wp)
      call suite%close_to(bodies%effusivity, 1.0e3_wp*sqrt([1.8e-4_wp, 3.6e-4_wp]), 1.0e-12_wp, "effusivities")
      bodies%bulk = [0.0_wp, 120.0_wp]
      bodies%effusivity = [1.0_wp, 3.0_wp]
      call suite%close_to(bodies%interface_temperature(), 90.0_wp, 1.0e-12_wp, "the better conductor dominates")
   end subroutine constants

   !> Carslaw and Jaeger: 2 q/(beta sqrt(pi V)) (sqrt(d) - sqrt(d - l)), exact for piecewise constant heat
   subroutine uniform_source(suite)
      type(test_suite), intent(inout) :: suite
      type(heat_passage) :: passage
      real(wp), allocatable :: t1(:, :), t2(:, :), heat(:, :), exact(:), d(:)

      passage = row(60)
      allocate(t1(60, 1), t2(60, 1), heat(60, 1))
      heat = merge(flux, 0.0_wp, passage%contact)
      call passage%surface_temperatures(heat, t1, t2)
      d = distance(passage)
      exact = 2.0_wp*flux/(23.0_wp*sqrt(pi*veloc))*(sqrt(max(0.0_wp, d)) - sqrt(max(0.0_wp, d - 2.0_wp*half_length)))
      call suite%close_to(t1(:, 1), exact, 1.0e-12_wp*maxval(exact), "uniform source, body 1")
      call suite%close_to(t2(:, 1), exact, 1.0e-12_wp*maxval(exact), "uniform source, body 2")
   end subroutine uniform_source

   !> Heat as the root of a circle, which is steep at the edges: first order, by quadrature of the integral
   subroutine elliptical_source(suite)
      type(test_suite), intent(inout) :: suite
      real(wp) :: error(3)
      integer :: k

      do k = 1, 3
         error(k) = elliptical_error(60*2**k, heat_source%moving)
      end do
      call suite%close_to(error(1)/error(2), 2.0_wp, 0.1_wp, "elliptical source: first order")
      call suite%close_to(error(2)/error(3), 2.0_wp, 0.1_wp, "elliptical source: first order")
      call suite%check(error(3) < 2.0e-3_wp, "elliptical source: 160 elements in contact")
   end subroutine elliptical_source

   !> Largest error of the temperature in contact, relative to the largest temperature
   real(wp) function elliptical_error(n, source) result(error)
      !> Elements of the row, member of heat_source
      integer, intent(in) :: n, source
      type(heat_passage) :: passage
      real(wp), allocatable :: t1(:, :), t2(:, :), heat(:, :), exact(:), d(:)
      integer :: i

      passage = row(n)
      passage%bodies%source = source
      allocate(t1(n, 1), t2(n, 1), heat(n, 1), exact(n))
      d = distance(passage)
      heat(:, 1) = flux*sqrt(max(0.0_wp, 1.0_wp - (d/half_length - 1.0_wp)**2))
      call passage%surface_temperatures(heat, t1, t2)
      exact = [(elliptical_temperature(d(i)), i=1, n)]
      error = maxval(abs(t1(:, 1) - exact), passage%contact(:, 1))/maxval(exact)
   end function elliptical_error

   !> Temperature under an elliptical source by the midpoint rule in t, distance = d (1 - t**2)
   pure real(wp) function elliptical_temperature(d) result(t)
      real(wp), intent(in) :: d
      integer, parameter :: n = 4000
      real(wp) :: s, x
      integer :: i

      t = 0.0_wp
      if (d <= 0.0_wp) return
      do i = 1, n
         s = (i - 0.5_wp)/n
         x = d*(1.0_wp - s**2)
         t = t + 2.0_wp*sqrt(d)*flux*sqrt(max(0.0_wp, 1.0_wp - (x/half_length - 1.0_wp)**2))/n
      end do
      t = t/(23.0_wp*sqrt(pi*veloc))
   end function elliptical_temperature

   !> The established variant counts the heat of an element twice at its centre: an error of the order of the root of the step
   subroutine factor_two(suite)
      type(test_suite), intent(inout) :: suite
      type(heat_passage) :: standard

      call suite%check(standard%bodies%source == heat_source%established, "the default is the established variant")
      call suite%close_to(elliptical_error(240, heat_source%established)/elliptical_error(480, heat_source%established), &
         & sqrt(2.0_wp), 0.05_wp, "established variant: order one half")
   end subroutine factor_two

   !> Bodies of different temperature: interface temperature, and cooling downstream
   subroutine conduction(suite)
      type(test_suite), intent(inout) :: suite
      type(heat_passage) :: passage
      real(wp), allocatable :: t1(:, :), t2(:, :), d(:)
      integer :: i, n

      n = 60
      passage = row(n)
      passage%bodies%bulk = [10.0_wp, 148.0_wp]
      allocate(t1(n, 1), t2(n, 1))
      d = distance(passage)
      call passage%conduct(t1, t2)
      do i = 1, n
         if (d(i) < 0.0_wp) then
            call suite%close_to([t1(i, 1), t2(i, 1)], passage%bodies%bulk, 0.0_wp, "bulk temperatures ahead")
         else if (passage%contact(i, 1)) then
            call suite%close_to([t1(i, 1), t2(i, 1)], [64.0_wp, 64.0_wp], 1.0e-12_wp, "one temperature in contact")
         else
            call suite%close_to((t1(i, 1) - 10.0_wp)/54.0_wp, 2.0_wp/pi*asin(sqrt(2.0_wp*half_length/d(i))), 1.0e-12_wp, &
               & "cooling of body 1")
            call suite%close_to((t2(i, 1) - 148.0_wp)/(-84.0_wp), 2.0_wp/pi*asin(sqrt(2.0_wp*half_length/d(i))), &
               & 1.0e-12_wp, "warming of body 2")
         end if
      end do
   end subroutine conduction

   !> Rolling to the other side
   subroutine mirror(suite)
      type(test_suite), intent(inout) :: suite
      type(heat_passage) :: one, two
      real(wp) :: a1(60, 1), a2(60, 1), b1(60, 1), b2(60, 1), heat(60, 1)
      integer :: i

      one = row(60)
      one%bodies%bulk = [-5.0_wp, 30.0_wp]
      heat(:, 1) = [(merge(flux*i, 0.0_wp, one%contact(i, 1)), i=1, 60)]
      call one%surface_temperatures(heat, a1, a2)
      two = one
      two%direction = 1
      two%contact = one%contact(60:1:-1, :)
      call two%surface_temperatures(heat(60:1:-1, :), b1, b2)
      call suite%close_to(a1(:, 1), b1(60:1:-1, 1), 0.0_wp, "mirror image, body 1")
      call suite%close_to(a2(:, 1), b2(60:1:-1, 1), 0.0_wp, "mirror image, body 2")
   end subroutine mirror

   !> The march gives coefficients and temperatures that belong together, however steep the law
   subroutine own_friction(suite)
      type(test_suite), intent(inout) :: suite
      type(heat_passage) :: passage
      type(friction_memory) :: memory
      type(friction_set) :: set
      class(friction_law), allocatable :: law
      type(error_type), allocatable :: error
      real(wp) :: pn(60, 1), speed(60, 1), mu(60, 1), expected(60, 1), t1(60, 1), s1(60, 1), s2(60, 1), nothing(60, 1)
      real(wp) :: range
      integer :: k, with

      passage = row(60)
      passage%bodies%bulk = [40.0_wp, 90.0_wp]
      nothing = 0.0_wp
      pn = merge(900.0_wp, 0.0_wp, passage%contact)
      speed = merge(1500.0_wp, 0.0_wp, passage%contact)
      do with = 0, 1
         memory%distance = 0.2_wp*with
         memory%lowest_speed = 2.0e3_wp
         do k = 1, 4
            range = 10.0_wp**(4 - k)
            set = friction_set(fstat=0.4_wp, fkin=0.1_wp, tref=50.0_wp, dtheat=range)
            call new_friction_law(friction_model%temperature, [set], law, error)
            select type (law)
            type is (heated_law)
               call passage%heat_by_friction(law, memory, pn, speed, nothing, 1.0e-5_wp, mu, t1)
            end select
            call passage%surface_temperatures(mu*pn*speed, s1, s2)
            call suite%close_to(t1(:, 1), s1(:, 1), 1.0e-9_wp, "temperatures of the march")
            ! both surfaces have this temperature in contact, and would have it elsewhere
            associate (beta => passage%bodies%effusivity/sum(passage%bodies%effusivity))
               call law%coefficient(beta(1)*s1 + beta(2)*s2, expected)
            end associate
            s1 = passage%bodies%interface_temperature()
            call law%coefficient(s1, s2)
            call memory%march(nothing, 1.0e-5_wp, passage%direction, s2(1, :), expected)
            call suite%close_to(mu(:, 1), expected(:, 1), 1.0e-10_wp, "coefficients of the march")
         end do
      end do
   end subroutine own_friction

   !> Without frictional heat the coefficient is that of the interface temperature, with any memory and any order of the bodies.
   !> Particles entered with the coefficient of cold bodies, and ahead of the contact took that of body 1
   subroutine warm_bodies(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: distance(3) = [0.0_wp, 0.01_wp, 1.0e3_wp]
      type(heat_passage) :: passage
      type(friction_set) :: set
      class(friction_law), allocatable :: law
      type(error_type), allocatable :: error
      real(wp) :: nothing(60, 1), mu(60, 1), t1(60, 1)
      integer :: i, k

      passage = row(60)
      passage%bodies%bulk = [600.0_wp, 150.0_wp]
      nothing = 0.0_wp
      set = friction_set(fstat=0.4_wp, fkin=0.1_wp, tref=50.0_wp, dtheat=600.0_wp)
      call new_friction_law(friction_model%temperature, [set], law, error)
      select type (law)
      type is (heated_law)
         do i = 1, 2
            do k = 1, size(distance)
               call passage%heat_by_friction(law, friction_memory(distance(k), 2.0e3_wp), nothing, nothing, nothing, 1.0e-5_wp, &
                  & mu, t1)
               call suite%close_to(mu(:, 1), spread(0.4_wp - 0.3_wp*(passage%bodies%interface_temperature() - 50.0_wp)/600.0_wp, &
                  & 1, 60), 1.0e-14_wp, "coefficient of warm bodies")
            end do
            passage%bodies%bulk = passage%bodies%bulk(2:1:-1)
            passage%bodies%effusivity = passage%bodies%effusivity(2:1:-1)
         end do
      class default
         call suite%check(.false., "law of another kind")
      end select
   end subroutine warm_bodies

   subroutine limits(suite)
      type(test_suite), intent(inout) :: suite
      type(heat_passage) :: passage
      real(wp) :: t1(60, 1), t2(60, 1), heat(60, 1)

      passage = row(60)
      passage%bodies%bulk = [11.0_wp, 7.0_wp]
      passage%contact = .false.
      heat = 0.0_wp
      call passage%surface_temperatures(heat, t1, t2)
      call suite%close_to(t1(:, 1), spread(11.0_wp, 1, 60), 0.0_wp, "no contact: bulk temperature, body 1")
      call suite%close_to(t2(:, 1), spread(7.0_wp, 1, 60), 0.0_wp, "no contact: bulk temperature, body 2")
      passage%dx = 2.0_wp
      passage%bodies%source = heat_source%established
      passage%contact = reshape([.true.], [1, 1])
      call passage%surface_temperatures(reshape([23.0_wp*sqrt(pi*veloc)], [1, 1]), t1(:1, :), t2(:1, :))
      call suite%close_to(t1(1, 1), (14.0_wp*11.0_wp + 9.0_wp*7.0_wp)/23.0_wp + 4.0_wp, 1.0e-12_wp, "one element")
   end subroutine limits
end program test_flash_heating
