!> Dissimilar bodies: the difference parameter K at its extremes
program test_hard_coupling
   use contact_base_choices, only : motion, normal_control
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_elastic_material, only : combine, combined_material
   use hard_case, only : close_table, elliptic_case, expect_solution, expect_statement, given_case, hard_run, open_table
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("hard coupling")
   call open_table("Dissimilar bodies")
   call extremes()
   call close_table()
   call suite%finish()

contains

   subroutine extremes()
      type(case_spec) :: spec
      type(hard_run) :: run
      type(combined_material) :: material
      integer :: t, k, m
      character(len=48) :: label
      integer, parameter :: passes(3) = [1, 10, 100]

      do t = motion%shift, motion%steady_rolling
         do k = 1, 4
            do m = 1, size(passes)
               spec = elliptic_case(t, 21, 21, 2.0_wp, 2.0_wp)
               call set_bodies(k, spec)
               material = combine(spec%material%poiss, spec%material%gg)
               spec%iteration%maxout = passes(m)
               spec%kinematics%cksi = 1.0e-3_wp
               spec%kinematics%cphi = 3.0e-4_wp
               write(label, "(a, f6.3, a, i0, a, i0)") "K ", material%ak, ", T=", t, ", MAXOUT ", passes(m)
               if (passes(m) == 10) then
                  ! ten passes may be too few, which a message reports
                  call expect_passes(run, spec, trim(label))
               else
                  call expect_solution(suite, run, spec, trim(label), slack=50.0_wp)
               end if
               spec%force = 1
               spec%kinematics%fx = -0.5_wp
               spec%kinematics%cphi = 0.0_wp
               if (passes(m) == 10) then
                  call expect_passes(run, spec, trim(label) // ", F=1")
               else
                  call expect_solution(suite, run, spec, trim(label) // ", F=1", slack=50.0_wp)
               end if
            end do
            spec%friction%sets(1)%fstat = 10.0_wp
            spec%force = 0
            write(label, "(a, f6.3, a, i0)") "K ", material%ak, ", mu 10, T=", t
            call expect_passes(run, spec, trim(label))
            spec = given_case(t, 15, 15)
            call set_bodies(k, spec)
            spec%iteration%maxout = 100
            spec%normal = normal_control%approach
            spec%kinematics%pen = 5.0e-3_wp
            spec%kinematics%cksi = 1.0e-3_wp
            write(label, "(a, f6.3, a, i0)") "K ", material%ak, ", N=0, T=", t
            call expect_solution(suite, run, spec, trim(label), slack=50.0_wp)
            write(label, "(a, f6.3, a, i0)") "K ", material%ak, ", one element, T=", t
            spec = given_case(t, 1, 1)
            call set_bodies(k, spec)
            spec%iteration%maxout = 10
            spec%kinematics%fn = 0.1_wp
            spec%kinematics%cksi = 1.0e-5_wp
            call expect_solution(suite, run, spec, trim(label))
         end do
      end do
      call run%release()
   end subroutine extremes

   !> The outer iteration reaches its tolerance or reports that it did not
   subroutine expect_passes(run, spec, name)
      type(hard_run), intent(inout) :: run
      type(case_spec), intent(in) :: spec
      character(len=*), intent(in) :: name
      integer :: before

      before = run%log%warnings
      call expect_statement(suite, run, spec, name, slack=1.0e30_wp)
      if (allocated(run%error)) return
      if (run%log%warnings == before) call suite%check(run%result%residual <= 50.0_wp*spec%iteration%eps, &
         & name // ": no message, so the coupled residual is small")
   end subroutine expect_passes

   !> Soft against rigid, both signs, and two moderate pairs
   subroutine set_bodies(k, spec)
      integer, intent(in) :: k
      type(case_spec), intent(inout) :: spec

      select case (k)
      case (1)
         spec%material%poiss = [0.0_wp, 0.28_wp]
         spec%material%gg = [1000.0_wp, 1.0e12_wp]
      case (2)
         spec%material%poiss = [0.28_wp, 0.0_wp]
         spec%material%gg = [1.0e12_wp, 1000.0_wp]
      case (3)
         spec%material%poiss = [0.2_wp, 0.4_wp]
         spec%material%gg = [1000.0_wp, 5000.0_wp]
      case (4)
         spec%material%poiss = [0.0_wp, 0.5_wp]
         spec%material%gg = [82000.0_wp, 82000.0_wp]
      end select
      spec%kinematics%fn = spec%kinematics%fn*spec%material%gg(merge(2, 1, k == 2))/82000.0_wp
   end subroutine set_bodies
end program test_hard_coupling
