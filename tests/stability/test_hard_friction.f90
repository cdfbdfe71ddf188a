!> Extremes of friction: full sliding and adhesion, spin, forces near the limit, tolerances
program test_hard_friction
   use contact_base_choices, only : motion, pressure_model
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use hard_case, only : close_table, elliptic_case, expect_refusal, expect_solution, hard_run, open_table
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("hard friction")
   call open_table("Extremes of friction")
   call creepages()
   call forces()
   call parameters()
   call mirror()
   call close_table()
   call suite%finish()

contains

   !> A case in steady rolling with creepages
   function rolling(xi, eta, phi) result(spec)
      real(wp), intent(in) :: xi, eta, phi
      type(case_spec) :: spec

      spec = elliptic_case(motion%steady_rolling, 33, 35, 3.0_wp, 5.0_wp)
      spec%kinematics%cksi = xi
      spec%kinematics%ceta = eta
      spec%kinematics%cphi = phi
   end function rolling

   subroutine creepages()
      type(case_spec) :: spec
      type(hard_run) :: run
      integer :: t
      character(len=8) :: label

      spec = rolling(0.05_wp, 0.0_wp, 0.0_wp)
      call expect_solution(suite, run, spec, "full sliding, xi 0.05")
      call suite%equal(run%result%nadh, 0, "full sliding leaves no adhesion")
      call suite%close_to(run%result%fx_rel, -1.0_wp, 1.0e-5_wp, "force of full sliding")
      spec = rolling(1.0e3_wp, -2.0e3_wp, 0.0_wp)
      call expect_solution(suite, run, spec, "full sliding, xi 1000, eta -2000")
      spec = rolling(1.0e-3_wp, 2.0e-3_wp, 0.0_wp)
      spec%friction%sets(1)%fstat = 10.0_wp
      call expect_solution(suite, run, spec, "full adhesion, mu 10")
      spec = rolling(1.0e-9_wp, 0.0_wp, 0.0_wp)
      call expect_solution(suite, run, spec, "xi 1e-9")
      spec = rolling(0.0_wp, 0.0_wp, 0.0_wp)
      call expect_solution(suite, run, spec, "zero creepage")
      call suite%close_to([maxval(abs(run%result%px)), maxval(abs(run%result%py))], [0.0_wp, 0.0_wp], 0.0_wp, &
         & "no creepage, no traction")
      spec = rolling(0.0_wp, 0.0_wp, 1.0e-4_wp)
      call expect_solution(suite, run, spec, "pure spin 1e-4")
      spec = rolling(0.0_wp, 0.0_wp, 2.0e-3_wp)
      call expect_solution(suite, run, spec, "pure spin 2e-3")
      spec = rolling(0.0_wp, 0.0_wp, 0.1_wp)
      call expect_solution(suite, run, spec, "pure spin 0.1")
      spec = rolling(0.0_wp, 0.0_wp, 100.0_wp)
      call expect_solution(suite, run, spec, "pure spin 100")
      spec = rolling(3.0e-3_wp, 1.0e-3_wp, 3.0e-4_wp)
      call expect_solution(suite, run, spec, "nearly saturated, with spin")
      spec = rolling(5.0e-4_wp, 0.0_wp, 3.0e-4_wp)
      spec%iteration%eps = 1.0e-12_wp
      call expect_solution(suite, run, spec, "EPS 1e-12", slack=3.0_wp)
      spec = rolling(5.0e-4_wp, 0.0_wp, 3.0e-4_wp)
      spec%pressure = pressure_model%elliptical
      call expect_solution(suite, run, spec, "Hertzian pressure")
      spec = rolling(5.0e-4_wp, 0.0_wp, 3.0e-4_wp)
      spec%pressure = pressure_model%parabolical
      call expect_solution(suite, run, spec, "parabolic pressure")
      do t = motion%shift, motion%transient_rolling
         write(label, "(a, i0)") "T=", t
         spec = rolling(0.0_wp, 0.0_wp, 0.0_wp)
         spec%motion = t
         call expect_solution(suite, run, spec, "zero shift, " // trim(label))
         spec%kinematics%cksi = merge(1.0_wp, 5.0_wp, t == motion%shift)
         call expect_solution(suite, run, spec, "full sliding, " // trim(label))
         spec%kinematics%cksi = merge(1.0e-4_wp, 5.0e-4_wp, t == motion%shift)
         spec%friction%sets(1)%fstat = 10.0_wp
         call expect_solution(suite, run, spec, "nearly full adhesion, mu 10, " // trim(label))
         spec%friction%sets(1)%fstat = 0.3_wp
         spec%kinematics%cksi = 0.0_wp
         spec%kinematics%cphi = merge(2.0e-3_wp, 1.0e-2_wp, t == motion%shift)
         call expect_solution(suite, run, spec, "pure spin, " // trim(label))
         spec%kinematics%cphi = 10.0_wp
         call expect_solution(suite, run, spec, "pure spin 10, " // trim(label))
         spec%kinematics%cphi = 0.0_wp
         spec%kinematics%ceta = merge(5.0e-3_wp, 5.0e-2_wp, t == motion%shift)
         spec%iteration%eps = 1.0e-12_wp
         call expect_solution(suite, run, spec, "EPS 1e-12, " // trim(label), slack=3.0_wp)
      end do
      call run%release()
   end subroutine creepages

   !> Forces near the limit
   subroutine forces()
      type(case_spec) :: spec
      type(hard_run) :: run
      integer :: t, k
      character(len=40) :: label
      real(wp), parameter :: share(5) = [0.0_wp, 0.5_wp, 0.99_wp, 0.999_wp, 0.9999_wp]
      real(wp), parameter :: too_much(3) = [1.0_wp, 1.0001_wp, 25.0_wp]

      do t = motion%shift, motion%steady_rolling
         do k = 1, size(share)
            write(label, "(a, i0, a, f6.4)") "T=", t, ", ", share(k)
            spec = rolling(0.0_wp, 0.0_wp, 0.0_wp)
            spec%motion = t
            if (t == motion%shift) spec%rolling%dq = 1.0_wp
            spec%force = 1
            spec%kinematics%fx = -share(k)
            call expect_solution(suite, run, spec, "F=1, " // trim(label))
            spec%kinematics%fx = share(k)
            spec%kinematics%cphi = merge(3.0e-4_wp, 3.0e-3_wp, t /= motion%transient_rolling)
            call expect_solution(suite, run, spec, "F=1 with spin, " // trim(label))
            spec%force = 2
            spec%kinematics%cphi = 0.0_wp
            spec%kinematics%fx = -0.6_wp*share(k)
            spec%kinematics%fy = 0.8_wp*share(k)
            call expect_solution(suite, run, spec, "F=2 oblique, " // trim(label))
            spec%kinematics%cphi = 3.0e-4_wp
            spec%kinematics%fx = share(k)
            spec%kinematics%fy = 0.0_wp
            call expect_solution(suite, run, spec, "F=2 with spin, " // trim(label))
         end do
         do k = 1, size(too_much)
            write(label, "(a, i0, a, f7.4)") "T=", t, ", ", too_much(k)
            spec = rolling(0.0_wp, 0.0_wp, 0.0_wp)
            spec%motion = t
            spec%force = 1
            spec%kinematics%fx = -too_much(k)
            call expect_refusal(suite, run, spec, "F=1, " // trim(label), "friction bound")
            spec%force = 2
            spec%kinematics%fx = 0.6_wp*too_much(k)*(1.0_wp + 1.0e-12_wp)
            spec%kinematics%fy = 0.8_wp*too_much(k)*(1.0_wp + 1.0e-12_wp)
            call expect_refusal(suite, run, spec, "F=2, " // trim(label), "friction bound")
         end do
      end do
      ! the first component alone is within the limit, with creepage in y
      spec = rolling(0.0_wp, 1.0e-3_wp, 0.0_wp)
      spec%force = 1
      spec%kinematics%fx = -0.7_wp
      call expect_solution(suite, run, spec, "F=1 with eta 1e-3")
      spec%kinematics%fx = -0.999_wp
      call expect_solution(suite, run, spec, "F=1 0.999 with eta 1e-3")
      spec%kinematics%ceta = 0.1_wp
      spec%kinematics%fx = -0.9_wp
      call expect_solution(suite, run, spec, "F=1 0.9 with eta 0.1 (sliding)")
      call run%release()
   end subroutine forces

   !> Friction coefficients and Poisson ratios at their bounds
   subroutine parameters()
      type(case_spec) :: spec
      type(hard_run) :: run
      integer :: t, k
      character(len=24) :: label
      real(wp), parameter :: mu(6) = [0.0_wp, 1.0e-6_wp, 1.0e-3_wp, 1.0_wp, 10.0_wp, 1.0e4_wp], nu(2) = [0.0_wp, 0.5_wp]

      do t = motion%shift, motion%steady_rolling
         do k = 1, size(mu)
            write(label, "(a, es7.0, a, i0)") "mu", mu(k), ", T=", t
            spec = rolling(5.0e-4_wp, -3.0e-4_wp, 3.0e-4_wp)
            spec%motion = t
            spec%friction%sets(1)%fstat = mu(k)
            call expect_solution(suite, run, spec, trim(label))
         end do
         do k = 1, size(nu)
            write(label, "(a, f3.1, a, i0)") "nu ", nu(k), ", T=", t
            spec = rolling(5.0e-4_wp, -3.0e-4_wp, 3.0e-4_wp)
            spec%motion = t
            spec%material%poiss = nu(k)
            call expect_solution(suite, run, spec, trim(label))
            spec%force = 2
            spec%kinematics%fx = -0.3_wp
            spec%kinematics%fy = 0.4_wp
            call expect_solution(suite, run, spec, trim(label) // ", F=2")
         end do
      end do
      spec = rolling(0.0_wp, 0.0_wp, 0.0_wp)
      spec%friction%sets(1)%fstat = 10.0_wp
      spec%force = 2
      spec%kinematics%fx = 1.0e-4_wp
      spec%kinematics%fy = -1.0e-3_wp
      call expect_solution(suite, run, spec, "mu 10, F=2 small")
      call run%release()
   end subroutine parameters

   !> Rolling towards decreasing x is the mirror image of rolling towards increasing x
   subroutine mirror()
      type(case_spec) :: spec
      type(hard_run) :: run, mirrored
      integer :: t, mx
      character(len=4) :: label
      real(wp), parameter :: pi = acos(-1.0_wp)

      do t = motion%transient_rolling, motion%steady_rolling
         write(label, "(a, i0)") "T=", t
         spec = rolling(5.0e-4_wp, 3.0e-4_wp, 4.0e-4_wp)
         spec%motion = t
         spec%iteration%eps = 1.0e-9_wp
         call expect_solution(suite, run, spec, "chi 0, " // label)
         ! x -> -x changes the signs of x components and of rotations
         spec%rolling%chi = pi
         spec%kinematics%cksi = -spec%kinematics%cksi
         spec%kinematics%cphi = -spec%kinematics%cphi
         call expect_solution(suite, mirrored, spec, "chi 180, " // label)
         mx = run%result%grid%mx
         call suite%close_to(reshape(mirrored%result%px, [size(mirrored%result%px)]), &
            & reshape(-run%result%px(mx:1:-1, :), [size(mirrored%result%px)]), &
            & 1.0e-6_wp*maxval(abs(run%result%px)), "mirrored px, " // label)
         call suite%close_to(reshape(mirrored%result%py, [size(mirrored%result%py)]), &
            & reshape(run%result%py(mx:1:-1, :), [size(mirrored%result%py)]), &
            & 1.0e-6_wp*maxval(abs(run%result%px)), "mirrored py, " // label)
      end do
      call run%release()
      call mirrored%release()
   end subroutine mirror
end program test_hard_friction
