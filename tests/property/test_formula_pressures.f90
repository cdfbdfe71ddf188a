!> Pressures by formula (B = 2, 3, 4): the total is the sum of the pressures, and it is the prescribed force
program test_formula_pressures
   use contact_base_choices, only : material_model, motion, normal_control, pressure_model
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_patch_result, only : patch_result
   use contact_test_case_builder, only : creep, ellipse_case, forces, line_case, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> Elements along and across: few, odd and even, the corner of an ellipse alone
   integer, parameter :: sizes(2, 7) = reshape([2, 2, 3, 3, 5, 4, 11, 11, 12, 9, 31, 20, 44, 44], [2, 7])
   type(test_suite) :: suite

   call suite%start("pressures by formula")
   call totals()
   call windows()
   call saturation()
   call approach_and_force()
   call nothing_in_sight()
   call suite%finish()

contains

   !> An ellipse, or two half ellipses for SDEC
   function formula_case(pressure, mx, my) result(spec)
      !> Member of pressure_model
      integer, intent(in) :: pressure
      integer, intent(in) :: mx, my
      type(case_spec) :: spec

      spec = ellipse_case(2.0_wp, 1.0_wp, 30.0_wp, mx, my)
      spec%pressure = pressure
      if (pressure /= pressure_model%sdec) return
      spec%grid%form = -6
      spec%grid%bneg = 0.7_wp
      spec%grid%bpos = 1.4_wp
   end function formula_case

   !> Sums of the fields, as anyone would form them from the printed tractions
   subroutine compare(result, fn, what)
      type(patch_result), intent(in) :: result
      !> Prescribed force [N]
      real(wp), intent(in) :: fn
      character(len=*), intent(in) :: what
      real(wp) :: area

      area = result%grid%dx*result%grid%dy
      call suite%close_to(result%fn/fn, 1.0_wp, 1.0e-12_wp, what // ": the prescribed force")
      call suite%close_to(area*sum(result%pn)/result%fn, 1.0_wp, 1.0e-12_wp, what // ": FN is the sum of the pressures")
      call suite%close_to([area*sum(result%px), area*sum(result%py)]/fn, [result%fx, result%fy]/fn, 1.0e-12_wp, &
         & what // ": FX, FY are the sums of the tractions")
      call suite%close_to([result%fx, result%fy]/(result%mu_scal*result%fn), [result%fx_rel, result%fy_rel], 1.0e-12_wp, &
         & what // ": relative forces are parts of that FN")
   end subroutine compare

   subroutine totals()
      integer, parameter :: kinds(3) = [pressure_model%elliptical, pressure_model%parabolical, pressure_model%sdec]
      character(len=*), parameter :: names(3) = ["elliptical ", "parabolical", "SDEC       "]
      type(test_case) :: case
      character(len=60) :: what
      integer :: i, k, f

      do k = 1, size(kinds)
         do i = 1, size(sizes, 2)
            do f = 0, 1
               write(what, "(A, I3, A, I3, A, I0)") names(k), sizes(1, i), " x", sizes(2, i), ", F = ", f
               case%spec = formula_case(kinds(k), sizes(1, i), sizes(2, i))
               call creep(case%spec, motion%steady_rolling, ksi=5.0e-4_wp, eta=2.0e-4_wp, mu=0.3_wp)
               if (f == 1) call forces(case%spec, 0.5_wp)
               call case%run(suite, trim(what))
               call compare(case%result, 30.0_wp, trim(what))
               call case%release()
            end do
         end do
      end do
   end subroutine totals

   !> A window that cuts the contact, and one whose only row is longer than the cylinder
   subroutine windows()
      type(test_case) :: case

      case%spec = formula_case(pressure_model%elliptical, 20, 20)
      case%spec%grid%scale = 0.5_wp
      call case%run(suite, "half of the axes")
      call compare(case%result, 30.0_wp, "half of the axes")
      call case%release()
      case%spec = line_case(0.5_wp, 10.0_wp, 100.0_wp, 40, scale=1.5_wp)
      case%spec%pressure = pressure_model%elliptical
      call case%run(suite, "one long row")
      call compare(case%result, 100.0_wp, "one long row")
      call case%release()
   end subroutine windows

   !> Sliding everywhere, the friction force is that of the prescribed force: full and simplified theory
   subroutine saturation()
      type(test_case) :: case
      integer :: i, model

      do model = 1, 2
         do i = 1, size(sizes, 2)
            case%spec = formula_case(pressure_model%parabolical, sizes(1, i), sizes(2, i))
            if (model == 2) case%spec%material_model = material_model%fastsim
            call creep(case%spec, motion%steady_rolling, ksi=0.5_wp, mu=0.3_wp)
            call case%run(suite, "sliding")
            call suite%close_to(case%result%fx, -0.3_wp*30.0_wp, 0.01_wp, "sliding: mu FN")
            call case%release()
         end do
      end do
   end subroutine saturation

   !> The force of an approach brings that approach back
   subroutine approach_and_force()
      type(test_case) :: case
      real(wp) :: fn

      case%spec = formula_case(pressure_model%elliptical, 9, 9)
      case%spec%normal = normal_control%approach
      case%spec%kinematics%pen = 0.01_wp
      call case%run(suite, "approach")
      fn = case%result%fn
      call compare(case%result, fn, "approach")
      call case%release()
      case%spec%normal = normal_control%force
      case%spec%kinematics%fn = fn
      call case%run(suite, "its force")
      call suite%close_to(case%result%pen, 0.01_wp, 1.0e-12_wp, "its force: the approach again")
      call case%release()
   end subroutine approach_and_force

   !> Pressures are not scaled if no centre of an element is in contact
   subroutine nothing_in_sight()
      type(test_case) :: case
      type(error_type), allocatable :: error

      case%spec = formula_case(pressure_model%elliptical, 2, 2)
      case%spec%grid%scale = 2.0_wp
      call case%try(error)
      call suite%check(allocated(error), "no centre in the contact: refused")
      call case%release()
   end subroutine nothing_in_sight
end program test_formula_pressures
