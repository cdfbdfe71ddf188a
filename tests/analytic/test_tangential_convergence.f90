!> Frictional contact against closed forms under refinement: Cattaneo-Mindlin, Carter, full
!> sliding, Spence
program test_tangential_convergence
   use contact_base_choices, only : estimate_choice, motion, time_link
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : part_source
   use contact_grid_element_division, only : element
   use contact_test_case_builder, only : creep, ellipse_case, forces, grid_case, hertz_case, line_case, observed, &
      & order_of, shift, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)

   real(wp), parameter :: gg = 200.0_wp, mu = 0.3_wp
   type(test_suite) :: suite

   call suite%start("tangential convergence")
   call cattaneo(suite, 0.5_wp)
   call cattaneo(suite, 0.875_wp)
   call mindlin(suite)
   call carter(suite, 0.36_wp)
   call carter(suite, 0.75_wp)
   call sliding(suite)
   call spence(suite, 0.25_wp, 0.15_wp)
   call spence(suite, 0.0_wp, 0.3_wp)
   call spence(suite, 0.4_wp, 0.05_wp)
   call spence_reaction(suite)
   call spence_limits(suite)
   call suite%finish()

contains

   !> Equal spheres without lateral contraction, for which the solution is exact; Johnson (1985), 7.2
   !>
   !> Stick radius c = a (1 - F)**(1/3), shift 3 mu P (2 - nu)/(8 a G) (1 - (1 - F)**(2/3)),
   !> traction mu p0 (sqrt(1 - r**2/a**2) - c/a sqrt(1 - r**2/c**2)).
   subroutine cattaneo(suite, force)
      type(test_suite), intent(inout) :: suite
      !> Relative tangential force [-]
      real(wp), intent(in) :: force
      integer, parameter :: sizes(*) = [15, 25, 43, 73, 125]
      real(wp), parameter :: aa = 1.0_wp, fn = 10.0_wp, peak = 1.5_wp*fn/(pi*aa**2)
      real(wp), dimension(size(sizes)) :: h, e_shift, e_field
      real(wp) :: cc, rr, exact, expected, stick
      type(test_case) :: case
      character(len=24) :: name
      integer :: k, ix, iy

      write(name, "(a, f6.3)") "Cattaneo, F =", force
      cc = aa*(1.0_wp - force)**(1.0_wp/3.0_wp)
      expected = 3.0_wp*mu*fn*2.0_wp/(8.0_wp*aa*gg)*(1.0_wp - (cc/aa)**2)
      do k = 1, size(sizes)
         case%spec = ellipse_case(aa, aa, fn, sizes(k), sizes(k), 1.137_wp)
         case%spec%material%poiss = 0.0_wp
         call shift(case%spec, mu=mu)
         call forces(case%spec, -force, 0.0_wp)
         call case%run(suite, trim(name))
         associate (r => case%result)
            h(k) = 1.0_wp/sizes(k)
            e_shift(k) = abs(r%cksi)/expected - 1.0_wp
            ! counting elements jumps with the grid, so that the radius is compared with their size
            stick = sqrt(r%nadh*r%grid%dx*r%grid%dy/pi)
            call suite%close_to(stick, cc, 0.25_wp*r%grid%dx, trim(name) // ": stick radius within a quarter of an element")
            e_field(k) = 0.0_wp
            do iy = 1, r%grid%my
               do ix = 1, r%grid%mx
                  rr = hypot(r%grid%x(ix), r%grid%y(iy))
                  exact = mu*peak*(sqrt(max(0.0_wp, 1.0_wp - (rr/aa)**2)) - cc/aa*sqrt(max(0.0_wp, 1.0_wp - (rr/cc)**2)))
                  e_field(k) = e_field(k) + hypot(abs(r%px(ix, iy)) - exact, r%py(ix, iy))*r%grid%dx*r%grid%dy/(mu*fn)
               end do
            end do
            call suite%close_to(sum(r%px)*r%grid%dx*r%grid%dy, -force*mu*fn, 1.0e-8_wp*fn, trim(name) // ": force")
            call suite%close_to(r%ceta, 0.0_wp, 1.0e-9_wp, trim(name) // ": no lateral shift")
         end associate
      end do
      call observed(suite, trim(name) // ", shift", h, e_shift, 1.75_wp, 0.5_wp, 4.0e-5_wp)
      call observed(suite, trim(name) // ", tractions (L1)", h, e_field, 1.5_wp, 0.2_wp, 1.5e-3_wp)
      call case%release()
   end subroutine cattaneo

   !> With nu > 0 the closed form neglects lateral tractions: the shift is right within a percent,
   !> and proportional to 2 - nu
   subroutine mindlin(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: nu(*) = [0.15_wp, 0.28_wp, 0.42_wp], force = 0.875_wp
      type(test_case) :: case
      real(wp) :: expected
      integer :: k

      do k = 1, size(nu)
         case%spec = ellipse_case(1.0_wp, 1.0_wp, 10.0_wp, 61, 61, 1.137_wp)
         case%spec%material%poiss = nu(k)
         call shift(case%spec, mu=mu)
         call forces(case%spec, -force)
         call case%run(suite, "Mindlin")
         expected = 3.0_wp*mu*10.0_wp*(2.0_wp - nu(k))/(8.0_wp*gg)*(1.0_wp - (1.0_wp - force)**(2.0_wp/3.0_wp))
         write(*, "(a, f5.2, a, 2es10.2)") "Mindlin, nu", nu(k), ": error of shift, stick radius", &
            & abs(case%result%cksi)/expected - 1.0_wp, sqrt(real(case%result%nadh, wp)/case%result%ncon)/0.5_wp - 1.0_wp
         call suite%close_to(abs(case%result%cksi), expected, 0.005_wp, "Mindlin, shift", relative=.true.)
         call suite%close_to(sqrt(real(case%result%nadh, wp)/case%result%ncon), 0.5_wp, 0.03_wp, &
            & "Mindlin, stick radius", relative=.true.)
      end do
      call case%release()
   end subroutine mindlin

   !> Cylinders in steady rolling: Q = mu P (1 - c**2/a**2) at the creepage mu (a - c) kappa;
   !> Carter (1926), Johnson (1985), 8.3; kappa is the relative curvature 2 a1
   subroutine carter(suite, force)
      type(test_suite), intent(inout) :: suite
      !> Relative tangential force [-]
      real(wp), intent(in) :: force
      !> The edges of the contact lie between elements: 5/6 of each window is in contact
      integer, parameter :: sizes(*) = [60, 120, 240, 480, 960]
      real(wp), parameter :: aa = 1.0_wp, bb = 1.0e4_wp, load = 20.0_wp, peak = 2.0_wp*load/(pi*aa)
      real(wp), dimension(size(sizes)) :: h, e_force, e_field, e_creep
      real(wp) :: cc, exact, xi, x
      type(test_case) :: case
      character(len=24) :: name
      integer :: k, ix

      write(name, "(a, f5.2)") "Carter, F =", force
      cc = aa*sqrt(1.0_wp - force)
      do k = 1, size(sizes)
         case%spec = line_case(aa, bb, 2.0_wp*load*bb, sizes(k), 1.2_wp)
         call case%run(suite, "cylinder")
         xi = mu*(aa - cc)*2.0_wp*case%result%hertz%a1
         call creep(case%spec, motion%steady_rolling, ksi=-xi, mu=mu)
         case%spec%rolling%dq = case%result%grid%dx
         call case%run(suite, trim(name))
         associate (r => case%result)
            h(k) = 1.0_wp/sizes(k)
            e_force(k) = r%fx_rel/force - 1.0_wp
            call suite%close_to(r%nadh*r%grid%dx, 2.0_wp*cc, r%grid%dx, trim(name) // ": stick width within an element")
            e_field(k) = 0.0_wp
            do ix = 1, r%grid%mx
               x = r%grid%x(ix)
               exact = mu*peak*(sqrt(max(0.0_wp, 1.0_wp - (x/aa)**2)) &
                  & - cc/aa*sqrt(max(0.0_wp, 1.0_wp - ((x - aa + cc)/cc)**2)))
               e_field(k) = e_field(k) + abs(r%px(ix, 1) - exact)*r%grid%dx/(mu*load)
            end do
         end associate
         call forces(case%spec, force)
         call case%run(suite, trim(name) // ", prescribed")
         e_creep(k) = case%result%cksi/(-xi) - 1.0_wp
         call suite%close_to(case%result%grid%dx*case%result%grid%dy*sum(case%result%px), force*mu*case%result%fn, &
            & 1.0e-8_wp, trim(name) // ": prescribed force", relative=.true.)
      end do
      call observed(suite, trim(name) // ", force", h, e_force, 1.0_wp, 0.1_wp, 1.0e-3_wp)
      call observed(suite, trim(name) // ", creepage", h, e_creep, 1.0_wp, 0.1_wp, 1.0e-3_wp)
      call observed(suite, trim(name) // ", tractions (L1)", h, e_field, 1.0_wp, 0.2_wp, 1.0e-3_wp)
      call case%release()
   end subroutine carter

   !> Large creepages: F = -mu Fn s/|s| to rounding, power -mu Fn |s| V to first order in the step
   subroutine sliding(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: sizes(*) = [15, 25, 43, 73]
      real(wp), parameter :: fn = 10.0_wp, ksi = 0.3_wp, eta = -0.4_wp, veloc = 3000.0_wp
      real(wp), dimension(size(sizes)) :: h, e_power
      type(test_case) :: case
      integer :: k

      do k = 1, size(sizes)
         case%spec = ellipse_case(1.0_wp, 0.7_wp, fn, sizes(k), sizes(k), 1.137_wp)
         call creep(case%spec, motion%steady_rolling, ksi=ksi, eta=eta, mu=mu)
         case%spec%rolling%veloc = veloc
         call case%run(suite, "full sliding")
         case%spec%rolling%dq = case%result%grid%dx
         call case%run(suite, "full sliding")
         associate (r => case%result)
            h(k) = 1.0_wp/sizes(k)
            call suite%equal(r%nslip, r%ncon, "all elements slip")
            call suite%close_to(reshape(hypot(r%px, r%py), [size(r%px)]), mu*reshape(r%pn, [size(r%pn)]), 1.0e-10_wp, &
               & "tractions at the bound")
            ! displacements turn the slip by angles of the order mu p0/(G |s|): the square is lost
            call suite%close_to(hypot(r%fx, r%fy), mu*fn, (mu*r%pmax/(gg*0.5_wp))**2, "force at the bound", relative=.true.)
            call suite%close_to([r%fx_rel, r%fy_rel], [-0.6_wp, 0.8_wp], mu*r%pmax/(gg*0.5_wp), "direction of the force")
            ! W = 1000 N mm/s
            e_power(k) = r%friction_power/(-mu*fn*0.5_wp*veloc/1000.0_wp) - 1.0_wp
         end associate
      end do
      case%spec = ellipse_case(1.0_wp, 0.7_wp, fn, 31, 31, 1.137_wp)
      case%spec%material%poiss = 0.0_wp
      call creep(case%spec, motion%steady_rolling, ksi=-ksi, mu=mu)
      call case%run(suite, "full sliding along x")
      call suite%close_to([case%result%fx_rel, case%result%fy_rel], [1.0_wp, 0.0_wp], 1.0e-13_wp, "full sliding along x")
      call observed(suite, "full sliding, power", h, e_power, 1.0_wp, 0.3_wp, 1.0e-3_wp)
      call case%release()
   end subroutine sliding

   !> Ratio c/a of stick and contact radius when a rigid sphere is pressed into a half-space
   !>
   !> Spence (1975): the same for a growing sphere as for a flat punch. There, with the pressure of
   !> the frictionless punch (one outer pass, so that shear does not act back),
   !>     ln((1 + c)/(1 - c))/(2 c) = mu/beta K(sqrt(1 - c**2)),    beta = K/(1 - nu),
   !> derived in doc/validation/analytic.md.
   real(wp) function spence_ratio(beta, friction) result(c)
      real(wp), intent(in) :: beta, friction
      real(wp) :: low, high, excess
      integer :: k

      low = 1.0e-9_wp
      high = 1.0_wp - 1.0e-15_wp
      do k = 1, 200
         c = 0.5_wp*(low + high)
         excess = atanh(c)/c - friction/beta*elliptic_k(c)
         if (excess > 0.0_wp) then
            high = c
         else
            low = c
         end if
      end do
   end function spence_ratio

   !> K of the complementary modulus c, by the arithmetic-geometric mean: pi/(2 agm(1, c))
   real(wp) function elliptic_k(c) result(value)
      real(wp), intent(in) :: c
      real(wp) :: a, b, mean
      integer :: k

      a = 1.0_wp
      b = c
      do k = 1, 40
         mean = 0.5_wp*(a + b)
         b = sqrt(a*b)
         a = mean
      end do
      value = 0.5_wp*pi/a
   end function elliptic_k

   !> Rigid sphere and half-space, in steps of growing radius; grid and steps are refined together
   subroutine spence(suite, nu, friction)
      type(test_suite), intent(inout) :: suite
      real(wp), intent(in) :: nu, friction
      integer, parameter :: sizes(*) = [17, 29, 49, 83]
      real(wp), dimension(size(sizes)) :: h, e_stick
      real(wp) :: ratio, expected
      character(len=40) :: name
      integer :: k

      write(name, "(a, f5.2, a, f5.2)") "Spence, nu =", nu, ", mu =", friction
      expected = spence_ratio((1.0_wp - 2.0_wp*nu)/(2.0_wp*(1.0_wp - nu)), friction)
      do k = 1, size(sizes)
         call press(suite, sizes(k), nu, friction, .false., ratio)
         h(k) = 1.0_wp/sizes(k)
         e_stick(k) = ratio/expected - 1.0_wp
         ! the radius of contact is 1, an element is 2.1/n
         call suite%close_to(ratio, expected, 1.05_wp/sizes(k), trim(name) // ": stick radius within half an element")
      end do
      write(*, "(2a, f8.4, a, f5.2, a, 4es9.1)") trim(name), ": closed form", expected, ", order", order_of(h, e_stick), &
         & "  errors", e_stick
   end subroutine spence

   !> Shear acts back on the pressures: with mu/beta kept, its effect begins with beta**2, and
   !> higher terms still count at these values
   subroutine spence_reaction(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: nu(*) = [0.25_wp, 0.35_wp, 0.42_wp]
      integer, parameter :: n = 61
      real(wp), dimension(size(nu)) :: beta, change
      real(wp) :: alone, full
      integer :: k

      beta = (1.0_wp - 2.0_wp*nu)/(2.0_wp*(1.0_wp - nu))
      do k = 1, size(nu)
         call press(suite, n, nu(k), 0.9_wp*beta(k), .false., alone)
         call press(suite, n, nu(k), 0.9_wp*beta(k), .true., full)
         change(k) = full/alone - 1.0_wp
         write(*, "(a, f6.3, 2(a, f8.4))") "Spence, beta", beta(k), ": stick ratio with pressures of Hertz", alone, &
            & ", with reaction of shear", full
      end do
      call observed(suite, "Spence, reaction (in beta)", beta, change, 2.5_wp, 0.6_wp, 0.01_wp)
   end subroutine spence_reaction

   !> Stick ratio after the last step; the ratios of the steps before must be the same
   subroutine press(suite, n, nu, friction, reaction, ratio)
      type(test_suite), intent(inout) :: suite
      integer, intent(in) :: n
      real(wp), intent(in) :: nu, friction
      !> Does shear act back on the pressures?
      logical, intent(in) :: reaction
      real(wp), intent(out) :: ratio
      real(wp), parameter :: radius = 50.0_wp
      real(wp) :: width, aa, ratios(n/2)
      type(test_case) :: case
      integer :: step

      width = 2.0_wp*1.05_wp/n
      case%spec = grid_case(0.5_wp/radius, 0.5_wp/radius, 1.0_wp, n, n, width, width, eps=1.0e-8_wp)
      case%spec%material%gg = [200.0_wp, 2.0e14_wp]
      case%spec%material%poiss = nu
      case%spec%iteration%maxout = merge(40, 1, reaction)
      call shift(case%spec, mu=friction)
      do step = 1, n/2
         aa = step/real(n/2, wp)
         case%spec%kinematics%fn = 4.0_wp/3.0_wp*(400.0_wp/(1.0_wp - nu))*aa**3/radius
         case%spec%link = merge(time_link%initiate, time_link%continue_all, step == 1)
         case%spec%parts%grid = merge(part_source%given, part_source%kept, step == 1)
         ! one pass that starts without shear leaves the pressures to Hertz
         case%spec%estimate = merge(estimate_choice%previous, estimate_choice%previous_normal, reaction)
         if (step == 1) case%spec%estimate = estimate_choice%fresh
         call case%run(suite, "Spence")
         ratios(step) = sqrt(count(case%result%division == element%adhesion)/real(case%result%ncon, wp))
      end do
      ratio = ratios(n/2)
      do step = n/5, n/2
         call suite%close_to(ratios(step), ratio, width*(n/2)/step, "Spence: same ratio at all loads, within an element")
      end do
      call case%release()
   end subroutine press

   subroutine spence_limits(suite)
      type(test_suite), intent(inout) :: suite
      real(wp) :: ratio

      call suite%close_to(spence_ratio(1.0e-6_wp, 1.0_wp), 1.0_wp, 1.0e-3_wp, "Spence: little coupling, all sticks")
      call press(suite, 21, 0.5_wp, 0.1_wp, .false., ratio)
      call suite%close_to(ratio, 1.0_wp, 0.0_wp, "Spence: no coupling at nu = 0.5, all sticks")
   end subroutine spence_limits
end program test_tangential_convergence
