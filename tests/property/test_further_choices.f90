!> Choices that few cases make: planforms of several parts, parts of the spin, FaStrip as published, memory backwards
program test_further_choices
   use contact_base_choices, only : material_model, motion, normal_control, planform_choice, pressure_model, slip_source
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_test_case_builder, only : creep, ellipse_case, grid_case, surface_case, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("further choices")
   call parts()
   call approximate_parts()
   call parts_in_rolling()
   call spin_parts()
   call original_fastrip()
   call backwards()
   call suite%finish()

contains

   !> Two humps side by side: factors 1 leave one problem, factors 0 make two
   subroutine parts()
      type(test_case) :: one, two, alone
      real(wp), parameter :: factor(3) = [0.0_wp, 0.5_wp, 1.0_wp]
      real(wp) :: fn(3), gap
      integer :: k

      one%spec = grid_case(0.05_wp, 0.05_wp, 0.0_wp, 15, 34, 0.2_wp, 0.2_wp, eps=1.0e-10_wp)
      one%spec%normal = normal_control%approach
      one%spec%kinematics%pen = 0.05_wp
      ! of the two parts each contains half of the valley's floor
      one%spec%geometry%planform = 3
      one%spec%geometry%pl = [-1.5_wp, 1.5_wp, -3.4_wp, -1.0_wp, -1.5_wp, 1.5_wp, 0.6_wp, 3.4_wp]
      one%spec%geometry%b(3) = 0.004_wp
      one%spec%geometry%b(5) = 0.001_wp
      call one%run(suite, "two rectangles")
      do k = 1, 3
         two%spec = one%spec
         two%spec%geometry%planform = 4
         two%spec%geometry%rectangles = reshape(one%spec%geometry%pl, [4, 2])
         two%spec%geometry%interaction = reshape([1.0_wp, factor(k), factor(k), 1.0_wp], [2, 2])
         call two%run(suite, "two parts")
         fn(k) = two%result%fn
         ! the displacements at the surface are those of half-spaces, without the factors
         gap = maxval(abs(two%result%h + two%result%un - two%result%pen), two%result%division > element%exterior)
         if (k == 3) call suite%close_to(gap, 0.0_wp, 1.0e-10_wp, "two parts: no gap in the contact area")
         if (k < 3) call suite%check(gap > 1.0e-4_wp, "two parts: displacements without the factors overlap")
         call suite%check(index(two%result%effects, "parts") > 0, "two parts: they are named")
         if (k == 3) call suite%close_to(two%result%pn, one%result%pn, 1.0e-8_wp*one%result%pmax, "factors 1: one problem")
         if (k > 1) cycle
         alone%spec = one%spec
         alone%spec%geometry%pl(5:8) = alone%spec%geometry%pl(1:4)
         call alone%run(suite, "left part")
         call suite%close_to(two%result%pn(:, :15), alone%result%pn(:, :15), 1.0e-8_wp*one%result%pmax, "factors 0: left part")
         alone%spec = one%spec
         alone%spec%geometry%pl(1:4) = alone%spec%geometry%pl(5:8)
         call alone%run(suite, "right part")
         call suite%close_to(two%result%pn(:, 19:), alone%result%pn(:, 19:), 1.0e-8_wp*one%result%pmax, "factors 0: right part")
      end do
      call suite%check(fn(1) > fn(2) .and. fn(2) > fn(3), "more interaction, less force")
      call one%release()
      call two%release()
      call alone%release()
   end subroutine parts

   !> The same by KPEC and ANALYN, of elastic and viscoelastic bodies: factors were ignored, and the lower one of two humps had no
   !> force although nothing acted on it
   subroutine approximate_parts()
      type(test_case) :: whole, two, alone
      integer, parameter :: methods(3) = [pressure_model%kpec, pressure_model%analyn, pressure_model%kpec]
      real(wp), parameter :: factor(5) = [0.0_wp, 0.25_wp, 0.5_wp, 0.75_wp, 1.0_wp]
      real(wp) :: h(31, 42), fn(5), full, sides(2)
      integer :: j, k, m

      do m = 1, size(methods)
         do k = 1, 42
            h(:, k) = 0.02_wp*(abs(k - 21.5_wp)*0.2_wp - 2.1_wp)**2 + merge(0.012_wp, 0.0_wp, k > 21) &
               & + [(0.005_wp*(0.2_wp*(j - 16))**2, j=1, 31)]
         end do
         whole%spec = surface_case(h, 0.0_wp, 0.2_wp, 0.2_wp, eps=1.0e-8_wp)
         whole%spec%normal = normal_control%approach
         whole%spec%kinematics%pen = 0.03_wp
         if (m == 3) then
            call creep(whole%spec, motion%steady_rolling, 0.002_wp)
            whole%spec%material_model = material_model%viscoelastic
            whole%spec%material%fg = 1.0_wp
            whole%spec%material%tc = 1.0e-3_wp
         end if
         two%spec = whole%spec
         two%spec%geometry%planform = planform_choice%weighted_rectangles
         two%spec%geometry%rectangles = reshape([-9.0_wp, 9.0_wp, -9.0_wp, 0.0_wp, -9.0_wp, 9.0_wp, 0.0_wp, 9.0_wp], [4, 2])
         do k = 1, size(factor)
            two%spec%geometry%interaction = reshape([1.0_wp, factor(k), factor(k), 1.0_wp], [2, 2])
            two%spec%pressure = pressure_model%full
            call two%run(suite, "full solution of two parts")
            full = two%result%fn
            two%spec%pressure = methods(m)
            call two%run(suite, "two parts by an approximate method")
            fn(k) = two%result%fn
            if (k > 1) cycle
            ! each of them without the other one
            alone%spec = two%spec
            do j = 1, 2
               alone%spec%geometry%rectangles = two%spec%geometry%rectangles(:, [j, j])
               call alone%run(suite, "one part by an approximate method")
               sides(j) = alone%result%fn
            end do
            call suite%close_to(fn(1), sum(sides), 1.0e-10_wp*fn(1), "factors 0: separate contacts")
            call suite%check(minval(sides) > 0.1_wp*fn(1), "both humps carry")
            call suite%close_to(fn(1), full, 0.05_wp*full, "factors 0: near the full solution")
         end do
         whole%spec%pressure = methods(m)
         call whole%run(suite, "one area by an approximate method")
         call suite%close_to(fn(5), whole%result%fn, 1.0e-12_wp*fn(5), "factors 1: one area")
         call suite%check(all(abs(fn(2:) - fn(:4)) < 0.2_wp*fn(1)), "no jumps between the factors")
         ! a hump that hardly overlaps is lifted off by the displacement of the other one
         h(:, 22:) = h(:, 22:) + 0.017_wp
         two%spec%geometry%h = reshape(h, [size(h)])
         two%spec%geometry%interaction = reshape([1.0_wp, 0.5_wp, 0.5_wp, 1.0_wp], [2, 2])
         call two%run(suite, "a low part by an approximate method")
         call suite%check(any(h(:, 22:) < 0.03_wp) .and. .not. any(two%result%pn(:, 22:) > 0.0_wp), "a low part is lifted off")
      end do
      call whole%release()
      call two%release()
      call alone%release()
   end subroutine approximate_parts

   !> Parts with factors 1 roll as one, with both orders, also where the leading edge of one part is next to the other one
   subroutine parts_in_rolling()
      type(test_case) :: one, two
      integer, parameter :: models(2) = [material_model%elastic, material_model%viscoelastic], order(3) = [1, 2, 2]
      integer :: k, m

      do m = 1, size(models)
         do k = 1, size(order)
            one%spec = grid_case(0.01_wp, 0.005_wp, 100.0_wp, 15, 15, 0.2_wp, 0.3_wp, eps=1.0e-8_wp)
            call creep(one%spec, merge(motion%transient_rolling, motion%steady_rolling, k == 3 .and. m == 1), 0.002_wp, &
               & -0.001_wp, 0.002_wp)
            one%spec%material_model = models(m)
            one%spec%material%fg = 1.0_wp
            one%spec%material%tc = 1.0e-3_wp
            one%spec%iteration%order = order(k)
            two%spec = one%spec
            two%spec%geometry%planform = planform_choice%weighted_rectangles
            two%spec%geometry%rectangles = reshape([-9.0_wp, 0.3_wp, -9.0_wp, 9.0_wp, -9.0_wp, 9.0_wp, -9.0_wp, 9.0_wp], [4, 2])
            two%spec%geometry%interaction = spread([1.0_wp, 1.0_wp], 1, 2)
            call one%run(suite, "a whole in rolling")
            call two%run(suite, "parts in rolling")
            call suite%close_to([two%result%fx, two%result%fy], [one%result%fx, one%result%fy], 1.0e-5_wp*one%result%fn, &
               & "parts roll as one")
         end do
      end do
      call one%release()
      call two%release()
   end subroutine parts_in_rolling

   !> E = 2 and 3: a part of the spin is cancelled, as by an extra term in each element
   subroutine spin_parts()
      type(test_case) :: weighed, extra, none
      integer, parameter :: sources(2) = [slip_source%no_spin_x, slip_source%no_spin_y]
      integer, parameter :: models(2) = [material_model%elastic, material_model%fastsim_single]
      real(wp), parameter :: phi = 2.0e-3_wp
      integer :: k, m, i

      do m = 1, 2
         do k = 1, 2
            weighed%spec = grid_case(0.04_wp, 0.06_wp, 200.0_wp, 19, 17, 0.4_wp, 0.4_wp, eps=1.0e-9_wp)
            weighed%spec%material_model = models(m)
            weighed%spec%material%flx = 5.0e-3_wp
            call creep(weighed%spec, motion%steady_rolling, ksi=5.0e-4_wp, eta=3.0e-4_wp, phi=phi, mu=0.3_wp)
            weighed%spec%kinematics%spinxo = 0.3_wp
            weighed%spec%kinematics%spinyo = -0.2_wp
            extra%spec = weighed%spec
            none%spec = weighed%spec
            none%spec%kinematics%cphi = 0.0_wp
            weighed%spec%slip_source = sources(k)
            call weighed%run(suite, "part of the spin")
            extra%spec%slip_source = slip_source%given
            allocate(extra%spec%extra_slip(2, 19*17), source=0.0_wp)
            associate (g => extra%spec%grid, offset => 0.4_wp/6.0_wp)
               do i = 1, 19*17
                  if (k == 1) extra%spec%extra_slip(1, i) = phi*(g%yl + ((i - 1)/19 + 0.5_wp)*g%dy + 0.2_wp)
                  if (k == 2) extra%spec%extra_slip(2, i) = -phi*(g%xl + (mod(i - 1, 19) + 0.5_wp)*g%dx - 0.3_wp + offset)
               end do
            end associate
            call extra%run(suite, "extra term")
            call suite%close_to(weighed%result%px, extra%result%px, 1.0e-6_wp*extra%result%pmax, "part of the spin: px")
            call suite%close_to(weighed%result%py, extra%result%py, 1.0e-6_wp*extra%result%pmax, "part of the spin: py")
            call suite%check(index(weighed%result%effects, "part of the spin") > 0, "part of the spin: it is named")
            ! without spin there is no cancellation
            call none%run(suite, "no spin")
            weighed%spec%kinematics%cphi = 0.0_wp
            call weighed%run(suite, "part of no spin")
            call suite%close_to(weighed%result%px, none%result%px, 1.0e-12_wp*none%result%pmax, "part of no spin: px")
            deallocate(extra%spec%extra_slip)
         end do
      end do
      call weighed%release()
      call extra%release()
      call none%release()
   end subroutine spin_parts

   !> M = 6, 7: no slope reduction for any parameters; full sliding opposite to the slip with M = 7 only
   subroutine original_fastrip()
      type(test_case) :: case, modified
      integer, parameter :: models(2) = [material_model%fastrip_plain, material_model%fastrip_sliding]
      integer :: k, slides

      do slides = 0, 1
         do k = 1, 2
            modified%spec = ellipse_case(2.0_wp, 1.0_wp, 20.0_wp, 22, 22, eps=1.0e-6_wp)
            call creep(modified%spec, motion%steady_rolling, ksi=1.0e-8_wp, eta=1.0e-8_wp, phi=1.0e-9_wp, mu=0.3_wp)
            if (slides == 1) call creep(modified%spec, motion%steady_rolling, ksi=20.0_wp, eta=-30.0_wp, phi=9.0_wp, &
               & mu=0.3_wp)
            modified%spec%material_model = material_model%fastrip
            case%spec = modified%spec
            case%spec%material_model = models(k)
            case%spec%material%k0_mf = 0.3_wp
            case%spec%material%alfamf = 0.2_wp
            call case%run(suite, "FaStrip as published")
            call suite%check(case%result%tangential%method == "FaStrip", "FaStrip as published: by its name")
            call suite%close_to(case%result%k_eff, 1.0_wp, 0.0_wp, "FaStrip as published: no slope reduction")
            if (slides == 0 .or. k == 2) then
               call modified%run(suite, "modified FaStrip")
               call suite%close_to([case%result%fx_rel, case%result%fy_rel], [modified%result%fx_rel, modified%result%fy_rel], &
                  & 1.0e-6_wp*hypot(modified%result%fx_rel, modified%result%fy_rel), "FaStrip without reduction")
            end if
            if (slides == 0) cycle
            call suite%equal(case%result%nadh, 0, "FaStrip as published: full sliding")
            if (k == 2) call suite%check(opposite(case) > 1.0_wp - 1.0e-6_wp, "M = 7: against the slip in full sliding")
            if (k == 1) call suite%check(opposite(case) < 0.99_wp, "M = 6: elsewhere in full sliding with spin")
         end do
      end do
      call case%release()
      call modified%release()
   end subroutine original_fastrip

   !> Smallest cosine of the angle between tractions and the direction opposite to the rigid slip
   real(wp) function opposite(case) result(cosine)
      type(test_case), intent(in) :: case
      real(wp) :: w(2), p(2)
      integer :: ix, iy

      cosine = 1.0_wp
      associate (r => case%result, kin => case%spec%kinematics)
         do iy = 1, r%grid%my
            do ix = 1, r%grid%mx
               if (r%division(ix, iy) /= element%slip) cycle
               p = [r%px(ix, iy), r%py(ix, iy)]
               w = [kin%cksi - kin%cphi*r%grid%y(iy), kin%ceta + kin%cphi*(r%grid%x(ix) + r%dq/6.0_wp)]
               if (norm2(p) > 0.0_wp) cosine = min(cosine, -dot_product(p, w)/(norm2(p)*norm2(w)))
            end do
         end do
      end associate
   end function opposite

   !> Viscoelastic bodies that differ, rolling towards -x: the mirror image of rolling towards +x
   subroutine backwards()
      type(test_case) :: ahead, back
      integer, parameter :: n = 23
      integer :: k

      do k = 1, 2
         ahead%spec = grid_case(0.01_wp, 0.012_wp, 500.0_wp, n, 21, 0.5_wp, 0.5_wp, eps=1.0e-9_wp)
         ahead%spec%geometry%b(4) = 0.004_wp
         ahead%spec%material_model = material_model%viscoelastic
         ahead%spec%material%fg = [1.0_wp, 0.5_wp]
         ahead%spec%material%tc = [2.0e-3_wp, 1.0e-3_wp]
         ahead%spec%material%poiss = [0.28_wp, merge(0.28_wp, 0.1_wp, k == 1)]
         ahead%spec%iteration%maxout = merge(1, 40, k == 1)
         call creep(ahead%spec, motion%steady_rolling, ksi=2.0e-3_wp, eta=1.0e-3_wp, phi=5.0e-4_wp, mu=0.3_wp)
         ahead%spec%rolling%veloc = 1000.0_wp
         back%spec = ahead%spec
         back%spec%rolling%chi = pi
         back%spec%geometry%b(4) = -0.004_wp
         back%spec%kinematics%cksi = -2.0e-3_wp
         back%spec%kinematics%cphi = -5.0e-4_wp
         call ahead%run(suite, "memory, rolling ahead")
         call back%run(suite, "memory, rolling backwards")
         call suite%close_to(back%result%pn(n:1:-1, :), ahead%result%pn, 1.0e-6_wp*ahead%result%pmax, "memory backwards: pn")
         call suite%close_to(-back%result%px(n:1:-1, :), ahead%result%px, 1.0e-6_wp*ahead%result%pmax, "memory backwards: px")
         call suite%close_to(back%result%py(n:1:-1, :), ahead%result%py, 1.0e-6_wp*ahead%result%pmax, "memory backwards: py")
         ! pressures build up on the side that the contact moves to
         call suite%check(ahead%result%my*back%result%my < 0.0_wp, "reversed memory: the load is on the other side")
         call ahead%release()
         call back%release()
      end do
   end subroutine backwards
end program test_further_choices
