!> Viscoelastic bodies: contact conditions hold for any relaxation length, from a hundredth to a thousand elements
program test_viscoelastic
   use, intrinsic :: iso_fortran_env, only : output_unit
   use contact_base_choices, only : material_model, motion, normal_control, pressure_model
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
   call short_and_long_memory()
   call displacements_below()
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

   !> Bodies that relax within a small part of an element, or of which nothing relaxes within the contact, are elastic: both orders,
   !> pressures that are solved for and those of KPEC, unlike bodies
   subroutine short_and_long_memory()
      integer, parameter :: pressures(2) = [pressure_model%full, pressure_model%kpec]
      real(wp), parameter :: length(2) = [1.0e-9_wp, 1.0e9_wp]
      type(test_case) :: memory, elastic
      integer :: order, k, l

      do order = 1, 2
         do k = 1, size(pressures)
            do l = 1, size(length)
               memory%spec = grid_case(1.0e-3_wp, 2.0e-3_wp, 1.0_wp, 15, 12, 0.5_wp, 0.4_wp, eps=1.0e-8_wp)
               memory%spec%normal = normal_control%approach
               memory%spec%kinematics%pen = 0.008_wp
               memory%spec%pressure = pressures(k)
               memory%spec%iteration%order = order
               memory%spec%iteration%maxout = 30
               call creep(memory%spec, motion%steady_rolling, ksi=5.0e-4_wp, eta=-3.0e-4_wp, phi=2.0e-4_wp, mu=0.3_wp)
               memory%spec%material%poiss = [0.25_wp, 0.45_wp]
               elastic%spec = memory%spec
               memory%spec%material_model = material_model%viscoelastic
               memory%spec%material%fg = [0.5_wp, 3.0_wp]
               memory%spec%material%tc = length(l)*memory%spec%grid%dx/memory%spec%rolling%veloc*[1.0_wp, 3.0_wp]
               if (l == 1) elastic%spec%material%gg = elastic%spec%material%gg/(1.0_wp + memory%spec%material%fg)
               call memory%run(suite, "memory")
               call elastic%run(suite, "no memory")
               call suite%close_to([memory%result%fn, memory%result%fx, memory%result%fy]/elastic%result%fn, &
                  & [elastic%result%fn, elastic%result%fx, elastic%result%fy]/elastic%result%fn, 1.0e-6_wp, &
                  & merge("relaxed at once", "relaxed never  ", l == 1))
            end do
         end do
      end do
      call memory%release()
      call elastic%release()
   end subroutine short_and_long_memory

   !> Without relaxation time displacements below the surface are those of the relaxed modulus
   subroutine displacements_below()
      type(test_case) :: relaxed
      real(wp) :: surface

      relaxed%spec = grid_case(1.0e-3_wp, 1.0e-3_wp, 1.0_wp, 9, 9, 0.5_wp, 0.5_wp, eps=1.0e-8_wp)
      call creep(relaxed%spec, motion%steady_rolling, ksi=5.0e-4_wp, mu=0.3_wp)
      relaxed%spec%material_model = material_model%viscoelastic
      relaxed%spec%material%fg = [1.0_wp, 3.0_wp]
      relaxed%spec%material%tc = 0.0_wp
      relaxed%spec%has_stress = .true.
      allocate(relaxed%spec%subsurface%blocks(2))
      relaxed%spec%subsurface%blocks(1)%z = [1.0e-6_wp]
      relaxed%spec%subsurface%blocks(2)%z = [-1.0e-6_wp]
      call relaxed%run(suite, "displacements below")
      associate (fields => relaxed%result%subsurface)
         surface = maxval(relaxed%result%un)
         call suite%close_to(maxval(fields(1)%displacement(3, :) - fields(2)%displacement(3, :)), surface, 1.0e-4_wp*surface, &
            & "both bodies yield by the approach")
      end associate
      call relaxed%release()
   end subroutine displacements_below

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
