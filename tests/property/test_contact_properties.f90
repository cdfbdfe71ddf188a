!> What holds for any contact: conditions of contact and friction, symmetries, scaling, repetition
program test_contact_properties
   use, intrinsic :: iso_fortran_env, only : int64
   use contact_base_choices, only : estimate_choice, motion, slip_source, time_link
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : part_source
   use contact_grid_element_division, only : element
   use contact_patch_result, only : patch_result
   use contact_test_case_builder, only : creep, ellipse_case, forces, random_numbers, surface_case, test_case
   use contact_test_harness, only : test_suite
   use omp_lib, only : omp_get_max_threads, omp_set_num_threads
   implicit none (type, external)

   real(wp), parameter :: eps = 1.0e-9_wp
   !> Two solutions of equal problems, each within eps of the exact one in its own norm
   real(wp), parameter :: same = 1.0e-7_wp
   integer, parameter :: kinds(*) = [motion%steady_rolling, motion%transient_rolling, motion%shift]
   type(test_suite) :: suite
   type(random_numbers) :: random
   integer :: k

   call suite%start("contact properties")
   random%state = 5926535897932384626_int64
   write(*, "(a, i0)") "seed ", random%state
   do k = 1, 30
      call conditions(suite, random, kinds(mod(k, 3) + 1), mod(k, 5) == 0)
   end do
   do k = 1, 9
      call symmetries(suite, random, kinds(mod(k, 3) + 1))
      call scaling(suite, random, kinds(mod(k, 3) + 1))
      call no_effect(suite, random, kinds(mod(k, 3) + 1))
      call continuity(suite, random, kinds(mod(k, 3) + 1))
      call repetition(suite, random, kinds(mod(k, 3) + 1))
   end do
   call interleaved(suite, random)
   call threads(suite)
   call suite%finish()

contains

   !> A rough paraboloid that rolls or shifts, with partial slip more often than not
   subroutine draw(random, kind, case)
      type(random_numbers), intent(inout) :: random
      !> Member of motion
      integer, intent(in) :: kind
      type(test_case), intent(inout) :: case
      real(wp), allocatable :: h(:, :)
      real(wp) :: dx, dy, x, y, ratio, fn, mu, size_, angle
      integer :: mx, my, ix, iy

      mx = random%whole(12, 30)
      my = random%whole(12, 30)
      ratio = random%logarithmic(0.3_wp, 3.0_wp)
      dx = 3.0_wp/mx
      dy = 3.0_wp/my/ratio
      allocate(h(mx, my))
      do iy = 1, my
         do ix = 1, mx
            x = (ix - 0.5_wp*(mx + 1))*dx
            y = (iy - 0.5_wp*(my + 1))*dy*ratio
            h(ix, iy) = 0.01_wp*(x**2 + y**2) + random%uniform(0.0_wp, 1.0e-3_wp)
         end do
      end do
      fn = random%logarithmic(3.0_wp, 10.0_wp)/ratio
      mu = random%logarithmic(0.1_wp, 0.6_wp)
      case%spec = surface_case(h, fn, dx, dy, eps)
      case%spec%material%poiss = random%uniform(0.0_wp, 0.5_wp)
      case%spec%mat_file = 2
      size_ = random%logarithmic(0.1_wp, 1.0_wp)*mu*fn*ratio/200.0_wp
      angle = random%uniform(0.0_wp, 6.283_wp)
      call creep(case%spec, kind, size_*cos(angle), size_*sin(angle), random%uniform(-1.0_wp, 1.0_wp)*size_, mu)
      size_ = random%uniform(0.1_wp, 0.9_wp)
      if (random%whole(0, 2) == 2) call forces(case%spec, size_*cos(angle), size_*sin(angle))
   end subroutine draw

   !> p >= 0, gap >= 0, p gap = 0; |pt| <= g, S = 0 or pt = -g S/|S|; slip recomputed from displacements
   subroutine conditions(suite, random, kind, dissimilar)
      type(test_suite), intent(inout) :: suite
      type(random_numbers), intent(inout) :: random
      integer, intent(in) :: kind
      logical, intent(in) :: dissimilar
      type(test_case) :: case
      real(wp), allocatable :: gap(:, :), sx(:, :), sy(:, :), bound(:, :), pt(:, :), slip(:, :)
      real(wp) :: tol_gap, tol_slip, tol_p, area
      logical, allocatable :: contact(:, :)

      call draw(random, kind, case)
      if (dissimilar) then
         case%spec%material%poiss = [0.2_wp, 0.35_wp]
         case%spec%material%gg = [150.0_wp, 300.0_wp]
         case%spec%iteration%maxout = 100
      end if
      call case%run(suite, "conditions")
      associate (r => case%result)
         contact = r%division > element%exterior
         area = r%grid%dx*r%grid%dy
         gap = r%h - r%pen + r%un
         tol_gap = 1.0e-6_wp*maxval(abs(r%un))
         call suite%check(all(r%pn >= 0.0_wp), "no tension")
         call suite%check(all((r%pn > 0.0_wp) .eqv. contact), "pressure in contact and only there")
         call suite%close_to(pack(gap, contact), spread(0.0_wp, 1, r%ncon), tol_gap, "no gap in contact")
         call suite%check(minval(gap) >= -tol_gap, "no penetration")
         call suite%close_to(area*sum(r%pn), r%fn, 1.0e-11_wp, "sum of pressures", relative=.true.)
         call suite%close_to(area*[sum(r%px), sum(r%py)], [r%fx, r%fy], 1.0e-7_wp*r%mu_scal*r%fn, "sum of tractions")
         bound = r%mu*r%pn
         pt = hypot(r%px, r%py)
         tol_p = 1.0e-6_wp*maxval(bound)
         call suite%check(all(pt <= bound*(1.0_wp + 1.0e-12_wp)), "tractions within the bound")
         ! previous tractions of the particles of these elements: none, or the state of steady rolling
         sx = r%wx + r%ux
         sy = r%wy + r%uy
         if (kind == motion%steady_rolling) then
            sx(:r%grid%mx - 1, :) = sx(:r%grid%mx - 1, :) - r%ux(2:, :)
            sy(:r%grid%mx - 1, :) = sy(:r%grid%mx - 1, :) - r%uy(2:, :)
         end if
         call suite%check(.not. any(contact(r%grid%mx, :)), "the window is wide enough")
         slip = hypot(sx, sy)
         tol_slip = 1.0e-6_wp*maxval(hypot(r%ux, r%uy))
         call suite%check(all(slip <= tol_slip .or. r%division /= element%adhesion), "no slip in adhesion")
         call suite%check(all(slip <= tol_slip .or. pt >= bound - tol_p .or. .not. contact), "slip only at the bound")
         call suite%check(all(r%px*sx + r%py*sy <= -pt*slip + tol_p*maxval(slip) + maxval(bound)*tol_slip .or. .not. contact), &
            & "tractions oppose slip")
         call suite%check(all(hypot(sx - r%sx, sy - r%sy) <= tol_slip .or. r%division /= element%slip), "slip of the result")
         call suite%check(r%friction_power <= 1.0e-9_wp*abs(r%elastic_energy), "friction dissipates")
      end associate
      call case%release()
   end subroutine conditions

   !> Mirrored surfaces and motions
   subroutine symmetries(suite, random, kind)
      type(test_suite), intent(inout) :: suite
      type(random_numbers), intent(inout) :: random
      integer, intent(in) :: kind
      type(test_case) :: case, mirror
      real(wp), allocatable :: h(:, :)
      integer :: mx, my

      call draw(random, kind, case)
      call case%run(suite, "symmetry")
      mx = case%spec%grid%mx
      my = case%spec%grid%my
      h = reshape(case%spec%geometry%h, [mx, my])

      mirror%spec = case%spec
      mirror%spec%geometry%h = reshape(h(:, my:1:-1), [mx*my])
      mirror%spec%kinematics%ceta = -case%spec%kinematics%ceta
      mirror%spec%kinematics%cphi = -case%spec%kinematics%cphi
      mirror%spec%kinematics%fy = -case%spec%kinematics%fy
      call mirror%run(suite, "mirror in y")
      associate (a => case%result, b => mirror%result)
         call near(suite, b%pn(:, my:1:-1), a%pn, a%pmax, "mirror in y: pressures")
         call near(suite, b%px(:, my:1:-1), a%px, a%mu_scal*a%pmax, "mirror in y: longitudinal tractions")
         call near(suite, -b%py(:, my:1:-1), a%py, a%mu_scal*a%pmax, "mirror in y: lateral tractions")
      end associate

      mirror%spec = case%spec
      mirror%spec%geometry%h = reshape(h(mx:1:-1, :), [mx*my])
      mirror%spec%kinematics%cksi = -case%spec%kinematics%cksi
      mirror%spec%kinematics%cphi = -case%spec%kinematics%cphi
      mirror%spec%kinematics%fx = -case%spec%kinematics%fx
      mirror%spec%rolling%chi = acos(-1.0_wp)
      call mirror%run(suite, "mirror in x")
      associate (a => case%result, b => mirror%result)
         call near(suite, b%pn(mx:1:-1, :), a%pn, a%pmax, "mirror in x: pressures")
         call near(suite, -b%px(mx:1:-1, :), a%px, a%mu_scal*a%pmax, "mirror in x: longitudinal tractions")
         call near(suite, b%py(mx:1:-1, :), a%py, a%mu_scal*a%pmax, "mirror in x: lateral tractions")
      end associate
      call case%release()
      call mirror%release()
   end subroutine symmetries

   !> Modulus and load by one factor; all lengths by one factor
   subroutine scaling(suite, random, kind)
      type(test_suite), intent(inout) :: suite
      type(random_numbers), intent(inout) :: random
      integer, intent(in) :: kind
      type(test_case) :: case, scaled
      real(wp) :: c

      call draw(random, kind, case)
      call case%run(suite, "scaling")
      c = random%logarithmic(1.0e-3_wp, 1.0e3_wp)
      scaled%spec = case%spec
      scaled%spec%material%gg = c*case%spec%material%gg
      scaled%spec%kinematics%fn = c*case%spec%kinematics%fn
      call scaled%run(suite, "stiffness scaled")
      associate (a => case%result, b => scaled%result)
         call near(suite, b%pn/c, a%pn, a%pmax, "stiffness scaled: pressures")
         call near(suite, b%px/c, a%px, a%mu_scal*a%pmax, "stiffness scaled: tractions x")
         call near(suite, b%py/c, a%py, a%mu_scal*a%pmax, "stiffness scaled: tractions y")
         call suite%close_to(b%pen, a%pen, same, "stiffness scaled: approach", relative=.true.)
      end associate
      scaled%spec = case%spec
      associate (s => scaled%spec)
         s%kinematics%fn = c**2*s%kinematics%fn
         s%grid%dx = c*s%grid%dx
         s%grid%dy = c*s%grid%dy
         s%grid%xl = c*s%grid%xl
         s%grid%yl = c*s%grid%yl
         s%geometry%h = c*s%geometry%h
         s%rolling%dq = c*s%rolling%dq
         if (kind == motion%shift) then
            s%kinematics%cksi = c*s%kinematics%cksi
            s%kinematics%ceta = c*s%kinematics%ceta
         else
            s%kinematics%cphi = s%kinematics%cphi/c
         end if
      end associate
      call scaled%run(suite, "lengths scaled")
      associate (a => case%result, b => scaled%result)
         call near(suite, b%pn, a%pn, a%pmax, "lengths scaled: pressures")
         call near(suite, b%px, a%px, a%mu_scal*a%pmax, "lengths scaled: tractions x")
         call near(suite, b%py, a%py, a%mu_scal*a%pmax, "lengths scaled: tractions y")
         call suite%close_to(b%pen/c, a%pen, same, "lengths scaled: approach", relative=.true.)
      end associate
      call case%release()
      call scaled%release()
   end subroutine scaling

   !> What has no strength changes no bit
   subroutine no_effect(suite, random, kind)
      type(test_suite), intent(inout) :: suite
      type(random_numbers), intent(inout) :: random
      integer, intent(in) :: kind
      type(test_case) :: case, other

      call draw(random, kind, case)
      case%spec%kinematics%cphi = 0.0_wp
      call case%run(suite, "no effect")
      other%spec = case%spec
      other%spec%slip_source = slip_source%given
      allocate(other%spec%extra_slip(2, case%result%grid%npot()), source=0.0_wp)
      call other%run(suite, "no extra slip")
      call bitwise(suite, other%result, case%result, "extra slip of zero")
      other%spec = case%spec
      other%spec%kinematics%spinxo = 3.0_wp
      other%spec%kinematics%spinyo = -2.0_wp
      other%spec%rolling%facphi = 0.5_wp
      call other%run(suite, "no spin")
      call bitwise(suite, other%result, case%result, "spin of zero, with any centre")
      other%spec = case%spec
      other%spec%material%flxz = 0.0_wp
      other%spec%rolling%veloc = 7.0_wp
      call other%run(suite, "velocity")
      call suite%check(all(other%result%px == case%result%px), "the velocity does not matter for Coulomb friction")
      call case%release()
      call other%release()
   end subroutine no_effect

   !> A little more load: a little more of everything
   subroutine continuity(suite, random, kind)
      type(test_suite), intent(inout) :: suite
      type(random_numbers), intent(inout) :: random
      integer, intent(in) :: kind
      real(wp), parameter :: delta = 1.0e-5_wp
      type(test_case) :: case, other

      call draw(random, kind, case)
      call case%run(suite, "continuity")
      other%spec = case%spec
      other%spec%kinematics%fn = case%spec%kinematics%fn*(1.0_wp + delta)
      call other%run(suite, "continuity")
      associate (a => case%result, b => other%result)
         call suite%close_to(b%pen, a%pen, 2.0_wp*delta*maxval(abs(a%un)), "approach continuous in the load")
         call suite%check(b%pen > a%pen, "approach grows with the load")
         call suite%close_to(b%pmax, a%pmax, 10.0_wp*delta, "peak pressure continuous in the load", relative=.true.)
         call suite%close_to([b%fx, b%fy], [a%fx, a%fy], 10.0_wp*delta*a%mu_scal*a%fn, "forces continuous in the load")
      end associate
      call case%release()
      call other%release()
   end subroutine continuity

   !> Identical results of the same problem and state, independent of earlier computations in the session
   subroutine repetition(suite, random, kind)
      type(test_suite), intent(inout) :: suite
      type(random_numbers), intent(inout) :: random
      integer, intent(in) :: kind
      type(test_case) :: case, other
      type(patch_result) :: first

      call draw(random, kind, case)
      call case%run(suite, "first run")
      first = case%result
      call case%run(suite, "second run")
      call bitwise(suite, case%result, first, "run again in the same session")
      call draw(random, motion%steady_rolling, other)
      other%spec%material%poiss = [0.1_wp, 0.4_wp]
      other%spec%iteration%maxout = 20
      call other%run(suite, "other problem")
      other%spec = case%spec
      call other%run(suite, "run after another problem")
      call bitwise(suite, other%result, first, "run after another problem in the same session")
      call case%release()
      call other%release()
   end subroutine repetition

   !> Two sequences in turn and one after the other
   subroutine interleaved(suite, random)
      type(test_suite), intent(inout) :: suite
      type(random_numbers), intent(inout) :: random
      type(test_case) :: a, b, a2, b2
      type(patch_result) :: a_alone(4), b_alone(4)
      integer :: step

      call draw(random, motion%transient_rolling, a)
      call draw(random, motion%shift, b)
      a2%spec = a%spec
      b2%spec = b%spec
      do step = 1, 4
         call next(a, step)
         call a%run(suite, "sequence alone")
         a_alone(step) = a%result
      end do
      do step = 1, 4
         call next(b, step)
         call b%run(suite, "sequence alone")
         b_alone(step) = b%result
      end do
      do step = 1, 4
         call next(a2, step)
         call a2%run(suite, "sequence in turn")
         call next(b2, step)
         call b2%run(suite, "sequence in turn")
         call bitwise(suite, a2%result, a_alone(step), "first sequence, alone and interleaved")
         call bitwise(suite, b2%result, b_alone(step), "second sequence, alone and interleaved")
      end do
      call suite%check(any(a_alone(4)%px /= a_alone(1)%px), "the sequence continues")
      call a%release()
      call b%release()
      call a2%release()
      call b2%release()
   end subroutine interleaved

   !> The next step of a sequence
   subroutine next(case, step)
      type(test_case), intent(inout) :: case
      integer, intent(in) :: step

      case%spec%link = merge(time_link%initiate, time_link%continue_all, step == 1)
      case%spec%estimate = merge(estimate_choice%fresh, estimate_choice%previous, step == 1)
      case%spec%parts%grid = merge(part_source%given, part_source%kept, step == 1)
      case%spec%parts%geometry = case%spec%parts%grid
      case%spec%kinematics%fn = case%spec%kinematics%fn*1.03_wp
   end subroutine next

   !> Grids large enough for the parallel loops
   subroutine threads(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: one, two
      integer :: before

      before = omp_get_max_threads()
      one%spec = ellipse_case(1.0_wp, 0.8_wp, 10.0_wp, 160, 150, 1.1_wp, eps)
      one%spec%rolling%dq = 2.2_wp/160
      call creep(one%spec, motion%steady_rolling, 2.0e-3_wp, 1.0e-3_wp, 2.0e-3_wp, 0.3_wp)
      two%spec = one%spec
      call omp_set_num_threads(1)
      call one%run(suite, "one thread")
      call omp_set_num_threads(2)
      call two%run(suite, "two threads")
      call omp_set_num_threads(before)
      associate (a => one%result, b => two%result)
         write(*, "(a, 2es9.1)") "one and two threads: difference of forces, tractions", &
            & hypot(a%fx - b%fx, a%fy - b%fy)/(a%mu_scal*a%fn), maxval(hypot(a%px - b%px, a%py - b%py))/(a%mu_scal*a%pmax)
         call suite%close_to([b%fx, b%fy, b%pen], [a%fx, a%fy, a%pen], 1.0e-10_wp, "threads: totals", relative=.true.)
         call suite%close_to([b%px, b%py, b%pn], [a%px, a%py, a%pn], 1.0e-10_wp*a%pmax, "threads: tractions")
      end associate
      call one%release()
      call two%release()
   end subroutine threads

   !> Root mean square of the difference relative to a scale
   subroutine near(suite, actual, expected, scale, what)
      type(test_suite), intent(inout) :: suite
      real(wp), intent(in) :: actual(:, :), expected(:, :), scale
      character(len=*), intent(in) :: what

      call suite%close_to(norm2(actual - expected)/(scale*sqrt(real(size(actual), wp))), 0.0_wp, same, what)
   end subroutine near

   !> Fields and totals have the same bits
   subroutine bitwise(suite, actual, expected, what)
      type(test_suite), intent(inout) :: suite
      type(patch_result), intent(in) :: actual, expected
      character(len=*), intent(in) :: what

      call suite%check(all(actual%pn == expected%pn), what // ": same pressures")
      call suite%check(all(actual%px == expected%px) .and. all(actual%py == expected%py), what // ": same tractions")
      call suite%check(all(actual%division == expected%division), what // ": same element division")
      call suite%check(all(actual%ux == expected%ux) .and. all(actual%uy == expected%uy), what // ": same displacements")
      call suite%check(actual%pen == expected%pen .and. actual%cksi == expected%cksi .and. actual%ceta == expected%ceta &
         & .and. actual%fx == expected%fx .and. actual%fy == expected%fy, what // ": same totals")
   end subroutine bitwise
end program test_contact_properties
