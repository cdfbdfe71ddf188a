!> Dissimilar bodies: passes of the outer iteration, from little coupling to much
!>
!> The strength of the coupling is the product of friction and the difference parameter K. Up to mu K = 1.5 every
!> case converges, up to mu = 1 within the passes that the plain iteration needs at most; beyond, cases may fail to
!> converge and report it.
program test_outer_iteration
   use, intrinsic :: iso_fortran_env, only : output_unit
   use contact_base_choices, only : motion
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_test_case_builder, only : creep, ellipse_case, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> Difference parameters, coefficients of friction, creepages relative to those of full sliding
   real(wp), parameter :: coupling(*) = [0.05_wp, 0.25_wp, 0.5_wp, -0.5_wp], mu(*) = [0.1_wp, 0.3_wp, 1.0_wp, 3.0_wp, 10.0_wp], &
      & level(*) = [0.01_wp, 0.3_wp, 1.0_wp, 10.0_wp]
   !> Passes of the plain iteration with the largest |K|, by coefficient of friction
   integer, parameter :: plain(3) = [8, 9, 16]
   real(wp), parameter :: eps = 1.0e-6_wp
   type(test_suite) :: suite
   integer :: t, i, j

   call suite%start("outer iteration")
   do t = motion%shift, motion%steady_rolling
      do i = 1, size(coupling)
         do j = 1, size(mu)
            call creepages(t, coupling(i), j)
         end do
      end do
   end do
   call strong_coupling(suite)
   call suite%finish()

contains

   !> mu K = 1.5 on many grids, of which some once needed three times as many passes as the others, or did not end
   subroutine strong_coupling(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      type(error_type), allocatable :: error
      real(wp), parameter :: scales(*) = [1.0_wp, 1.02_wp, 1.05_wp, 1.1_wp, 1.2_wp, 1.3_wp], shifts(*) = [0.9_wp, 1.0_wp, 1.1_wp]
      integer, parameter :: most = 40
      integer :: i, j, passes(size(shifts), size(scales))
      logical :: solved

      solved = .true.
      do i = 1, size(scales)
         do j = 1, size(shifts)
            case%spec = ellipse_case(2.0_wp, 2.0_wp, 83.7758_wp, 15, 15, scale=scales(i), eps=eps)
            case%spec%material%gg = [1000.0_wp, 1.0e12_wp]
            case%spec%material%poiss = [0.0_wp, 0.28_wp]
            case%spec%iteration%maxout = 100
            call creep(case%spec, motion%shift, 0.06_wp*shifts(j), 0.018_wp*shifts(j), mu=3.0_wp)
            call case%try(error)
            passes(j, i) = case%result%outer_iterations
            solved = solved .and. .not. allocated(error)
            if (solved) solved = case%result%status%is_solved()
         end do
      end do
      write(output_unit, "(a, t30, a, 18i4)") "mu K = 1.5 on many grids", "passes", passes
      call suite%check(solved .and. all(passes <= most), "mu K = 1.5 on many grids: few passes on all of them")
      call case%release()
   end subroutine strong_coupling

   subroutine creepages(t, k, j)
      integer, intent(in) :: t, j
      real(wp), intent(in) :: k
      type(test_case) :: case
      type(error_type), allocatable :: error
      character(len=60) :: what
      integer :: l, passes(size(level))
      !> Largest pressure [N/mm2] and modulus of rigidity of the soft body
      real(wp), parameter :: p0 = 10.0_wp, modulus = 1000.0_wp
      real(wp) :: size_

      write(what, "(a, i0, a, f5.2, a, f5.1)") "T=", t, ", K", k, ", mu", mu(j)
      do l = 1, size(level)
         case%spec = ellipse_case(2.0_wp, 2.0_wp, p0*acos(-1.0_wp)*4.0_wp/1.5_wp, 15, 15, eps=eps)
         case%spec%material%gg = merge([modulus, 1.0e12_wp], [1.0e12_wp, modulus], k > 0.0_wp)
         case%spec%material%poiss = merge([0.5_wp - abs(k), 0.28_wp], [0.28_wp, 0.5_wp - abs(k)], k > 0.0_wp)
         case%spec%iteration%maxout = 100
         size_ = level(l)*mu(j)*p0/modulus
         if (t == motion%shift) then
            call creep(case%spec, t, 2.0_wp*size_, 0.6_wp*size_, mu=mu(j))
         else
            case%spec%rolling%dq = 4.0_wp*case%spec%grid%scale/case%spec%grid%mx
            call creep(case%spec, t, size_, phi=0.2_wp*size_, mu=mu(j))
         end if
         call case%try(error)
         if (allocated(error)) then
            call suite%check(.false., trim(what) // ": " // full_text(error))
            return
         end if
         passes(l) = case%result%outer_iterations
         if (mu(j)*abs(k) <= 1.5_wp) then
            call suite%check(case%result%status%is_solved(), trim(what) // ": converges")
         else if (.not. case%result%status%is_solved()) then
            cycle
         end if
         call suite%check(case%result%residual <= 10.0_wp*eps, trim(what) // ": the contact conditions hold")
         if (j <= size(plain)) call suite%check(passes(l) <= plain(j), trim(what) // ": not more passes than without acceleration")
      end do
      write(output_unit, "(a, t30, a, 4i6)") trim(what), "passes", passes
      call case%release()
   end subroutine creepages
end program test_outer_iteration
