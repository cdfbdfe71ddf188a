!> The layer between the bodies against closed forms: a single element, full shearing, a soft layer
program test_interfacial_layer
   use contact_base_choices, only : estimate_choice, material_model, motion, solver_choice, time_link
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : part_source
   use contact_grid_element_division, only : element
   use contact_test_case_builder, only : creep, ellipse_case, shift, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite
   !> Modulus of all layers [N/mm2]
   real(wp), parameter :: layer_modulus = 60.0_wp

   call suite%start("interfacial layer")
   call yield_path(layer_thickness=0.0_wp)
   call curved_path()
   call full_shearing()
   call transient_to_steady(flexibility=0.0_wp)
   call yield_path(layer_thickness=0.02_wp)
   call soft_layer()
   call transient_to_steady(flexibility=2.0e-5_wp)
   call suite%finish()

contains

   !> One element: springs of bodies and layer in series with the plastic slope
   !>
   !> Forward beyond the yield limit, a rest, backward until it yields the other way, forward again.
   subroutine yield_path(layer_thickness)
      !> [mm]
      real(wp), intent(in) :: layer_thickness
      real(wp), parameter :: slopes(3) = [0.0_wp, 300.0_wp, -150.0_wp], limit = 80.0_wp
      real(wp), parameter :: steps(9) = [0.01_wp, 0.03_wp, 0.02_wp, 0.0_wp, -0.05_wp, -0.06_wp, -0.01_wp, 0.04_wp, 0.07_wp]
      type(test_case) :: case
      real(wp) :: stiffness, p, t, du, trial, way, work
      integer :: k, step
      character(len=64) :: what

      do k = 1, size(slopes)
         case%spec = ellipse_case(0.5_wp, 0.5_wp, 900.0_wp, 1, 1, scale=1.0_wp)
         case%spec%material%gg = 9000.0_wp
         ! stiffness of everything elastic, from a step without yielding
         call make_layer(case, layer_thickness, 0.0_wp, 0.0_wp)
         call shift(case%spec, 1.0e-3_wp, mu=0.7_wp)
         call case%run(suite, "elastic step")
         stiffness = -case%result%px(1, 1)/1.0e-3_wp
         if (layer_thickness > 0.0_wp) call suite%check(stiffness < layer_modulus/layer_thickness, "the layer is softer than alone")

         call make_layer(case, layer_thickness, limit, slopes(k))
         p = 0.0_wp
         t = limit
         way = 0.0_wp
         do step = 1, size(steps)
            call shift(case%spec, steps(step), mu=0.7_wp)
            if (step == 2) then
               case%spec%link = time_link%continue_all
               case%spec%estimate = estimate_choice%previous
               case%spec%parts%grid = part_source%kept
               case%spec%parts%geometry = part_source%kept
            end if
            write(what, "(a, f7.1, a, f5.2, a, i0)") "slope", slopes(k), ", layer", layer_thickness, ", step ", step
            call case%run(suite, trim(what))
            du = 0.0_wp
            trial = p - stiffness*steps(step)
            if (abs(trial) > t) then
               ! k du = dt and stiffness (|D| - du) = |p| - ..., both along the trial traction
               du = (abs(trial) - t)/(stiffness + slopes(k))
               t = t + slopes(k)*du
               p = sign(t, trial)
               way = way + sign(du, trial)
            else
               p = trial
            end if
            work = -abs(p)*du/1000.0_wp
            call suite%close_to(case%result%px(1, 1), p, 1.0e-7_wp*limit, trim(what) // ": traction")
            call suite%close_to(case%result%tau_c(1, 1), t, 1.0e-7_wp*limit, trim(what) // ": yield limit")
            call suite%close_to(case%result%uplx(1, 1), way, 1.0e-9_wp, trim(what) // ": plastic displacement")
            call suite%close_to(case%result%friction_power, work, 1.0e-9_wp, trim(what) // ": work")
            call suite%equal(case%result%nplast, merge(1, 0, du > 0.0_wp), trim(what) // ": element state")
         end do
      end do
      call case%release()
   end subroutine yield_path

   !> A turn of the shift turns the traction; the limit grows with the length of the way
   subroutine curved_path()
      type(test_case) :: case
      real(wp) :: before(2), grown, way(2)
      integer :: step

      case%spec = ellipse_case(0.5_wp, 0.5_wp, 900.0_wp, 1, 1, scale=1.0_wp)
      case%spec%material%gg = 9000.0_wp
      call make_layer(case, 0.0_wp, 80.0_wp, 300.0_wp)
      before = 0.0_wp
      grown = 80.0_wp
      do step = 1, 24
         call shift(case%spec, 0.01_wp*cos(0.15_wp*step), 0.01_wp*sin(0.15_wp*step), mu=0.7_wp)
         call case%run(suite, "curved path")
         case%spec%link = time_link%continue_all
         case%spec%estimate = estimate_choice%previous
         way = [case%result%uplx(1, 1), case%result%uply(1, 1)]
         grown = grown + 300.0_wp*norm2(way - before)
         call suite%close_to(case%result%tau_c(1, 1), grown, 1.0e-6_wp, "curved path: the limit grows with the way")
         if (case%result%nplast > 0) then
            call suite%close_to(hypot(case%result%px(1, 1), case%result%py(1, 1)), grown, 1.0e-6_wp, "curved path: at the limit")
            call suite%close_to(case%result%px(1, 1)*(way(2) - before(2)) - case%result%py(1, 1)*(way(1) - before(1)), 0.0_wp, &
               & 1.0e-6_wp, "curved path: plastic displacement along the traction")
         end if
         before = way
      end do
      call suite%check(case%result%nplast == 1, "curved path: yields")
      call case%release()
   end subroutine curved_path

   !> At very large creepage every element is at its bound; hardening leaves friction alone
   subroutine full_shearing()
      type(test_case) :: case
      real(wp) :: expected
      real(wp), parameter :: slopes(3) = [0.0_wp, 5.0e5_wp, -1.0e7_wp]
      integer :: k, method
      integer, parameter :: methods(3) = [solver_choice%default, solver_choice%gauss_seidel, solver_choice%convex_gs]

      do method = 1, size(methods)
         do k = 1, size(slopes)
            case%spec = ellipse_case(4.0_wp, 3.0_wp, 20000.0_wp, 19, 15)
            case%spec%material%gg = 82000.0_wp
            case%spec%solver = methods(method)
            case%spec%classical = .true.
            call make_layer(case, 0.0_wp, 100.0_wp, slopes(k))
            call creep(case%spec, motion%steady_rolling, ksi=0.5_wp, mu=0.3_wp)
            call case%run(suite, "full shearing")
            select case (k)
            case (1)
               expected = sum(min(0.3_wp*case%result%pn, 100.0_wp))
            case (2)
               expected = sum(0.3_wp*case%result%pn)
            case default
               ! the leading element falls to a tenth of its limit, unless it slips
               expected = sum(min(0.3_wp*case%result%pn, 10.0_wp))
               call suite%check(minval(case%result%tau_c) >= 9.9999_wp, "softening ends at a tenth of the limit")
               call suite%check(-sum(case%result%px) >= 0.999_wp*expected, "fast softening: not below the lowest limit")
               cycle
            end select
            call suite%close_to(-sum(case%result%px)/expected, 1.0_wp, 1.0e-4_wp, "full shearing: all elements at their bound")
         end do
      end do
      call case%release()
   end subroutine full_shearing

   !> Bodies that are rigid beside the layer: every row is a chain of springs, solved from the leading edge
   subroutine soft_layer()
      type(test_case) :: case
      real(wp), parameter :: slopes(4) = [0.0_wp, 40000.0_wp, -2000.0_wp, -9000.0_wp]
      real(wp), parameter :: limit = 60.0_wp, mu = 0.4_wp, ksi = 0.004_wp, flexibility = 2.0e-4_wp
      real(wp), parameter :: chi(2) = [0.0_wp, pi]
      integer, parameter :: methods(3) = [solver_choice%default, solver_choice%gauss_seidel, solver_choice%convex_gs]
      real(wp) :: p, t, g, m, worst
      integer :: k, method, side, ix, iy, j, mx

      do side = 1, 2
         do method = 1, size(methods)
            do k = 1, size(slopes)
               case%spec = ellipse_case(4.0_wp, 3.0_wp, 20000.0_wp, 41, 9)
               case%spec%material%gg = 1.0e12_wp
               case%spec%solver = methods(method)
               case%spec%classical = .true.
               call make_layer(case, flexibility*layer_modulus, limit, slopes(k))
               call creep(case%spec, motion%steady_rolling, ksi=ksi, mu=mu)
               case%spec%rolling%chi = chi(side)
               call case%run(suite, "soft layer")
               worst = 0.0_wp
               mx = case%result%grid%mx
               do iy = 1, case%result%grid%my
                  p = 0.0_wp
                  t = limit
                  do j = 1, mx
                     ix = merge(mx + 1 - j, j, side == 1)
                     if (case%result%division(ix, iy) == element%exterior) cycle
                     ! |p| without slip or yielding, and what both do to it
                     p = p + case%result%dq*ksi/flexibility
                     g = mu*case%result%pn(ix, iy)
                     if (t < g .and. p > t) then
                        ! a limit that falls faster than the layer unloads drops to the lowest one
                        m = 1000.0_wp
                        if (slopes(k) > -1.0_wp/flexibility) m = (p - t)/(1.0_wp/flexibility + slopes(k))
                        if (slopes(k) > 0.0_wp) m = min(m, (g - t)/slopes(k))
                        t = max(0.1_wp*limit, t + slopes(k)*m)
                        p = min(g, t)
                     end if
                     p = min(g, p)
                     worst = max(worst, abs(-case%result%px(ix, iy) - p))
                  end do
               end do
               call suite%check(worst < 1.0e-4_wp*limit, "soft layer: chains of springs")
               call suite%check(case%result%nplast > 50, "soft layer: yields")
            end do
         end do
      end do
      call case%release()
   end subroutine soft_layer

   !> Transient rolling ends in steady rolling, with hardening
   subroutine transient_to_steady(flexibility)
      !> Of the layer [mm3/N]
      real(wp), intent(in) :: flexibility
      type(test_case) :: steady, transient
      integer :: k

      steady%spec = ellipse_case(1.0_wp, 1.5_wp, 1200.0_wp, 16, 12)
      steady%spec%material%gg = 82000.0_wp
      call make_layer(steady, flexibility*layer_modulus, 80.0_wp, 1.0e5_wp)
      call creep(steady%spec, motion%steady_rolling, ksi=0.002_wp, mu=0.5_wp)
      call steady%run(suite, "steady")
      call suite%check(steady%result%nplast > 0 .and. steady%result%nslip > 0, "steady: some elements yield, some slip")
      transient%spec = steady%spec
      transient%spec%motion = motion%transient_rolling
      transient%spec%rolling%dq = steady%result%grid%dx
      do k = 1, 60
         call transient%run(suite, "transient")
         transient%spec%link = time_link%continue_all
         transient%spec%estimate = estimate_choice%previous
         transient%spec%parts%grid = part_source%kept
         transient%spec%parts%geometry = part_source%kept
      end do
      print "(a, 3es12.4)", "transient to steady", transient%result%fx_rel - steady%result%fx_rel, &
         & maxval(abs(transient%result%px - steady%result%px))/maxval(abs(steady%result%px)), &
         & transient%result%friction_power/steady%result%friction_power - 1.0_wp
      call suite%close_to(transient%result%fx_rel, steady%result%fx_rel, 1.0e-5_wp, "transient to steady: force")
      call suite%check(maxval(abs(transient%result%px - steady%result%px)) < 1.0e-4_wp*maxval(abs(steady%result%px)), &
         & "transient to steady: tractions")
      call suite%check(maxval(abs(transient%result%tau_c - steady%result%tau_c), steady%result%division > element%exterior) &
         & < 1.0e-3_wp*80.0_wp, "transient to steady: limits")
      call suite%check(maxval(abs(transient%result%uplx - steady%result%uplx), steady%result%division > element%exterior) &
         & < 1.0e-3_wp*maxval(abs(steady%result%uplx)), "transient to steady: plastic displacements")
      call suite%close_to(transient%result%friction_power, steady%result%friction_power, 1.0e-4_wp, &
         & "transient to steady: power", relative=.true.)
      call steady%release()
      call transient%release()
   end subroutine transient_to_steady

   !> M = 4 with this thickness, yield limit and slope
   subroutine make_layer(case, thickness, limit, slope)
      type(test_case), intent(inout) :: case
      real(wp), intent(in) :: thickness, limit, slope

      case%spec%material_model = material_model%interfacial_layer
      case%spec%material%gg3 = layer_modulus
      case%spec%material%laythk = thickness
      case%spec%material%tau_c0 = limit
      case%spec%material%k_tau = slope
      case%spec%link = time_link%initiate
      case%spec%estimate = estimate_choice%fresh
      case%spec%parts%grid = part_source%given
      case%spec%parts%geometry = part_source%given
   end subroutine make_layer
end program test_interfacial_layer
