!> Properties of estimated errors: what does not change a solution does not change them, and they are finite and not larger than
!> the totals
program test_estimate_properties
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use contact_base_choices, only : motion, pressure_model
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec, damping_spec, heat_spec
   use contact_patch_quantities, only : total_list
   use contact_patch_result, only : patch_result
   use contact_test_case_builder, only : creep, ellipse_case, grid_case, line_case, shift, surface_case, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("properties of estimated errors")
   call with_damping()
   call with_constant_distance()
   call with_formula_pressures()
   call half_ellipses_after_another_grid()
   call suite%finish()

contains

   !> Estimated error of a total; -1 without an estimate
   real(wp) function error_of(solution, name) result(e)
      type(patch_result), intent(in) :: solution
      !> Name of the total
      character(len=*), intent(in) :: name
      type(total_list) :: list
      integer :: k

      e = -1.0_wp
      if (.not. allocated(solution%errors)) return
      call solution%totals(list)
      k = list%place_of(name)
      if (list%rows(k)%name /= name .or. k > size(solution%errors%value)) return
      if (.not. ieee_is_nan(solution%errors%value(k))) e = solution%errors%value(k)
   end function error_of

   !> The same estimates for all totals of two results
   subroutine compare(one, other, tolerance, what)
      type(patch_result), intent(in) :: one, other
      !> Relative difference
      real(wp), intent(in) :: tolerance
      character(len=*), intent(in) :: what
      type(total_list) :: list
      real(wp) :: e
      integer :: k, found

      call one%totals(list)
      found = 0
      do k = 1, list%length
         e = error_of(one, trim(list%rows(k)%name))
         if (e > 0.0_wp) found = found + 1
         call suite%close_to(error_of(other, trim(list%rows(k)%name)), e, tolerance*max(abs(e), tiny(e)), &
            & what // ": error of " // trim(list%rows(k)%name))
      end do
      call suite%check(found >= 4, what // ": errors are estimated")
   end subroutine compare

   !> Damping forces are additional totals, and not part of the others
   subroutine with_damping()
      type(test_case) :: plain, damped
      integer :: kind

      do kind = 1, 2
         plain%spec = grid_case(0.01_wp, 0.02_wp, 10.0_wp, 14, 12, 0.12_wp, 0.1_wp)
         if (kind == 1) then
            call creep(plain%spec, motion%steady_rolling, ksi=1.0e-3_wp, eta=5.0e-4_wp, mu=0.3_wp)
            plain%spec%has_heat = .true.
            plain%spec%heat = heat_spec(bktemp=[20.0_wp, 30.0_wp], heatcp=450.0_wp, lambda=0.05_wp, dens=7.85e-6_wp, betapl=0.0_wp)
         else
            call shift(plain%spec, x=1.0e-3_wp, mu=0.3_wp)
         end if
         plain%spec%estimates_errors = .true.
         damped%spec = plain%spec
         damped%spec%has_damping = .true.
         damped%spec%damping = damping_spec(1.0e-3_wp, 1.0e-3_wp, 1.0e6_wp, 1.0e6_wp)
         call plain%run(suite, "without damping")
         call damped%run(suite, "with damping")
         call compare(plain%result, damped%result, 1.0e-12_wp, merge("rolling with damping", "shift with damping  ", kind == 1))
         call suite%check(error_of(damped%result, "contact_area") < damped%result%contact_area(), "damping: the area has an error")
         call plain%release()
         call damped%release()
      end do
   end subroutine with_damping

   !> A constant in the undeformed distance changes the approach, and no error; surfaces smooth and rough
   subroutine with_constant_distance()
      !> Constants [mm]; the approach is 0.03 mm, the second one makes it nearly zero
      real(wp), parameter :: offset(4) = [0.0_wp, -0.03_wp, 1.0_wp, -1.0_wp]
      integer, parameter :: mx = 15, my = 13
      type(test_case) :: case
      type(patch_result) :: first
      real(wp) :: h(mx, my)
      integer :: surface, k, ix, iy

      do surface = 1, 2
         do k = 1, size(offset)
            do iy = 1, my
               do ix = 1, mx
                  h(ix, iy) = offset(k) + 0.01_wp*(0.15_wp*(ix - 8))**2 + 0.015_wp*(0.15_wp*(iy - 7))**2 &
                     & + (surface - 1)*2.0e-3_wp*mod(7*ix*ix + 11*iy + 3*ix*iy, 5)
               end do
            end do
            case%spec = surface_case(h, 10.0_wp, 0.15_wp, 0.15_wp)
            call creep(case%spec, motion%steady_rolling, ksi=1.0e-3_wp, eta=5.0e-4_wp, mu=0.3_wp)
            case%spec%estimates_errors = .true.
            call case%run(suite, "constant distance")
            if (k == 1) then
               first = case%result
            else
               call compare(first, case%result, 1.0e-5_wp, merge("smooth", "rough ", surface == 1) // ", other constant")
            end if
            call case%release()
         end do
      end do
   end subroutine with_constant_distance

   !> Pressures by formula do not follow from distance and approach, which may be zero; they carry the force exactly
   subroutine with_formula_pressures()
      type(test_case) :: trial
      integer :: kind
      character(len=:), allocatable :: what

      do kind = 1, 4
         select case (kind)
         case (1)
            what = "SDEC"
            trial%spec = half_ellipses()
         case (2)
            what = "line"
            trial%spec = line_case(0.5_wp, 3.0_wp, 100.0_wp, 14, scale=1.2_wp)
            trial%spec%grid%my = 12
            trial%spec%pressure = pressure_model%elliptical
         case (3)
            what = "elliptical"
            trial%spec = ellipse_case(2.0_wp, 1.0_wp, 30.0_wp, 13, 12)
            trial%spec%pressure = pressure_model%elliptical
         case (4)
            what = "parabolical"
            trial%spec = ellipse_case(2.0_wp, 1.0_wp, 30.0_wp, 13, 12)
            trial%spec%pressure = pressure_model%parabolical
         end select
         call creep(trial%spec, motion%steady_rolling, ksi=5.0e-4_wp, eta=2.0e-4_wp, mu=0.3_wp)
         trial%spec%estimates_errors = .true.
         call trial%run(suite, what)
         associate (found => trial%result)
            call suite%check(error_of(found, "fn") < 0.0_wp, what // ": the force has no error")
            call suite%check(error_of(found, "fx") > 0.0_wp .and. error_of(found, "fx") < 0.2_wp*0.3_wp*found%fn, what // ": FX")
            call suite%check(error_of(found, "fy") > 0.0_wp .and. error_of(found, "fy") < 0.2_wp*0.3_wp*found%fn, what // ": FY")
            call suite%check(error_of(found, "pmax") > 0.0_wp .and. error_of(found, "pmax") < 0.2_wp*found%pmax, what // ": PMAX")
         end associate
         call trial%release()
      end do
   end subroutine with_formula_pressures

   function half_ellipses() result(spec)
      type(case_spec) :: spec

      spec = ellipse_case(2.0_wp, 1.0_wp, 30.0_wp, 13, 12)
      spec%pressure = pressure_model%sdec
      spec%grid%form = -6
      spec%grid%bneg = 0.7_wp
      spec%grid%bpos = 1.4_wp
   end function half_ellipses

   !> Two half ellipses have no undeformed distance: neither that of an earlier grid, nor its planform, is used
   subroutine half_ellipses_after_another_grid()
      type(test_case) :: trial
      type(error_type), allocatable :: error
      integer :: kind

      do kind = 1, 3
         trial%spec = half_ellipses()
         select case (kind)
         case (2)
            trial%spec%geometry%form = 9
            allocate(trial%spec%geometry%h(27), source=0.5_wp)
         case (3)
            ! a circle of 0.5 mm
            trial%spec%geometry%planform = 2
            trial%spec%geometry%pl(:6) = [1.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, -0.25_wp]
         end select
         call creep(trial%spec, motion%steady_rolling, ksi=5.0e-4_wp, mu=0.3_wp)
         call trial%try(error)
         call suite%check(.not. allocated(error), "half ellipses after another grid are solved")
         if (allocated(error)) cycle
         call suite%check(all(abs(trial%result%h) <= 0.0_wp), "they have no undeformed distance")
         call suite%close_to(trial%result%fn, 30.0_wp, 1.0e-10_wp, "they carry their force")
         call trial%release()
      end do
   end subroutine half_ellipses_after_another_grid
end program test_estimate_properties
