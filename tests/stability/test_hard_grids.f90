!> The hard cases of the prototype of the method, on its grids: elliptic pressures, steady rolling
program test_hard_grids
   use contact_base_choices, only : motion, pressure_model
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use hard_case, only : close_table, elliptic_case, expect_solution, hard_run, open_table
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> Products on the finest grid that the preconditioned prototype needed from zero
   integer, parameter :: most = 179
   type(test_suite) :: suite

   call suite%start("hard grids")
   call open_table("Hard cases of the prototype (it needed 17 to 179 products)")
   call axes()
   call grids()
   call parameters()
   call close_table()
   call suite%finish()

contains

   !> Solve; the products must not exceed those of the prototype
   subroutine compare(spec, name, products)
      type(case_spec), intent(inout) :: spec
      character(len=*), intent(in) :: name
      integer, intent(in) :: products
      type(hard_run) :: run

      spec%pressure = pressure_model%elliptical
      call expect_solution(suite, run, spec, name)
      if (.not. allocated(run%error)) then
         call suite%check(run%result%tangential%products <= products, name // ": no more products than the prototype")
         call suite%check(run%result%tangential%gave_up == "", name // ": no fall-back")
      end if
      call run%release()
   end subroutine compare

   subroutine axes()
      real(wp), parameter :: aa(4) = [0.3_wp, 6.0_wp, 0.1_wp, 5.0_wp], bb(4) = [6.0_wp, 0.3_wp, 5.0_wp, 0.1_wp]
      type(case_spec) :: spec
      integer :: k
      character(len=40) :: label

      do k = 1, size(aa)
         spec = elliptic_case(motion%steady_rolling, 80, 80, aa(k), bb(k))
         spec%kinematics%fn = 3000.0_wp
         call creepages(spec, 1.0e-3_wp, 3.0e-4_wp, 3.0e-4_wp)
         write(label, "(a, f3.1, a, f3.1)") "axes ", aa(k), " x ", bb(k)
         call compare(spec, trim(label), 81)
      end do
   end subroutine axes

   subroutine grids()
      integer, parameter :: sizes(2, 6) = reshape([200, 20, 20, 200, 400, 8, 8, 400, 300, 1, 1, 60], [2, 6])
      type(case_spec) :: spec
      integer :: k
      character(len=40) :: label

      do k = 1, size(sizes, 2)
         spec = elliptic_case(motion%steady_rolling, sizes(1, k), sizes(2, k), 3.0_wp, 5.0_wp)
         call creepages(spec, 5.0e-4_wp, -3.0e-4_wp, 3.0e-4_wp)
         write(label, "(a, i0, a, i0)") "3 x 5, grid ", sizes(1, k), " x ", sizes(2, k)
         call compare(spec, trim(label), most)
      end do
   end subroutine grids

   subroutine parameters()
      real(wp), parameter :: mu(4) = [1.0e-4_wp, 0.05_wp, 1.0_wp, 10.0_wp], &
         & spin(4) = [1.0e-3_wp, 5.0e-3_wp, 2.0e-2_wp, 0.1_wp], nu(2) = [0.0_wp, 0.5_wp]
      type(case_spec) :: spec
      integer :: k
      character(len=40) :: label

      do k = 1, size(mu)
         spec = elliptic_case(motion%steady_rolling, 80, 80, 3.0_wp, 5.0_wp)
         call creepages(spec, 5.0e-4_wp, 0.0_wp, 3.0e-4_wp)
         spec%friction%sets(1)%fstat = mu(k)
         write(label, "(a, es8.1)") "mu ", mu(k)
         call compare(spec, trim(label), 50)
      end do
      do k = 1, size(spin)
         spec = elliptic_case(motion%steady_rolling, 80, 80, 3.0_wp, 5.0_wp)
         call creepages(spec, 0.0_wp, 0.0_wp, spin(k))
         write(label, "(a, es8.1)") "spin ", spin(k)
         call compare(spec, trim(label), 79)
      end do
      do k = 1, size(nu)
         spec = elliptic_case(motion%steady_rolling, 80, 80, 3.0_wp, 5.0_wp)
         call creepages(spec, 5.0e-4_wp, 0.0_wp, 6.0e-4_wp)
         spec%material%poiss = nu(k)
         write(label, "(a, f3.1)") "nu ", nu(k)
         call compare(spec, trim(label), most)
      end do
   end subroutine parameters

   subroutine creepages(spec, xi, eta, phi)
      type(case_spec), intent(inout) :: spec
      real(wp), intent(in) :: xi, eta, phi

      spec%kinematics%cksi = xi
      spec%kinematics%ceta = eta
      spec%kinematics%cphi = phi
   end subroutine creepages
end program test_hard_grids
