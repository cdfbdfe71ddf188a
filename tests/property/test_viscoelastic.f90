!> Viscoelastic bodies: contact conditions hold for any relaxation length, from a hundredth to a thousand elements
program test_viscoelastic
   use, intrinsic :: iso_fortran_env, only : output_unit
   use contact_base_choices, only : material_model, motion, normal_control
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_patch_result, only : patch_result
   use contact_test_case_builder, only : creep, grid_case, random_numbers, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   integer, parameter :: count_ = 120
   type(test_suite) :: suite
   type(random_numbers) :: random
   type(test_case) :: case
   character(len=60) :: what
   integer :: k, other

   call suite%start("viscoelastic bodies")
   write(output_unit, "(a, i0)") "state of the random numbers: ", random%state
   other = 0
   do k = 1, count_
      case%spec = scene()
      write(what, "(a, i0, a, 2f6.2, a, 2es9.1)") "scene ", k, ", FG", case%spec%material%fg, ", lengths", &
         & case%spec%material%tc*case%spec%rolling%veloc/case%spec%grid%dx
      call case%run(suite, trim(what))
      call fulfilled(case%result, case%spec%iteration%eps, trim(what))
      if (case%result%normal%method /= "NormCG") other = other + 1
      call case%release()
   end do
   write(output_unit, "(i0, a, i0, a)") other, " of ", count_, " scenes were not solved by NormCG"
   call suite%check(other > 0, "some scenes need more than conjugate gradients")
   call suite%finish()

contains

   !> Steady rolling of like bodies with relaxation lengths around the size of an element, by force or by approach
   function scene() result(spec)
      type(case_spec) :: spec
      real(wp) :: length, a

      a = random%logarithmic(0.05_wp, 20.0_wp)
      spec = grid_case(1.0e-3_wp/a, random%logarithmic(3.0e-4_wp, 3.0e-3_wp)/a, 1.0_wp, random%whole(2, 24), random%whole(1, 18), &
         & 1.0_wp, 1.0_wp, eps=1.0e-6_wp)
      spec%grid%dx = 2.3_wp*a/spec%grid%mx
      spec%grid%dy = 2.3_wp*a/spec%grid%my
      spec%grid%xl = -1.15_wp*a
      spec%grid%yl = -1.15_wp*a
      spec%material%gg = random%logarithmic(1.0_wp, 1.0e5_wp)
      spec%material_model = material_model%viscoelastic
      spec%material%fg = random%uniform(0.5_wp, 3.0_wp)
      call creep(spec, motion%steady_rolling, ksi=1.0e-4_wp, mu=0.3_wp)
      spec%rolling%veloc = 1000.0_wp
      length = spec%grid%dx*random%logarithmic(0.01_wp, 1000.0_wp)
      spec%material%tc = length/spec%rolling%veloc
      spec%kinematics%pen = random%uniform(0.3e-3_wp, 1.0e-3_wp)*a
      spec%kinematics%fn = spec%material%gg(1)*a*spec%kinematics%pen
      if (random%whole(0, 1) == 0) spec%normal = normal_control%approach
      spec%mat_file = 2
   end function scene

   !> No gap in contact, no overlap outside, the right total
   subroutine fulfilled(result, eps, name)
      type(patch_result), intent(in) :: result
      real(wp), intent(in) :: eps
      character(len=*), intent(in) :: name
      real(wp) :: gap(size(result%h, 1), size(result%h, 2)), scale

      gap = result%h - result%pen + result%un
      scale = result%pen - minval(result%h)
      call suite%check(all(result%pn >= 0.0_wp), name // ": no tension")
      call suite%close_to(maxval(merge(abs(gap), max(0.0_wp, -gap), result%pn > 0.0_wp))/scale, 0.0_wp, 1.01_wp*eps, &
         & name // ": contact conditions")
      call suite%close_to(sum(result%pn)*result%grid%dx*result%grid%dy, result%fn, 1.0e-12_wp*result%fn, name // ": total")
   end subroutine fulfilled
end program test_viscoelastic
