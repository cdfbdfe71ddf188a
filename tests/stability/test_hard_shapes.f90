!> Extremes of shape: single elements, rows, columns, edges of the window, slender contacts
program test_hard_shapes
   use contact_base_choices, only : motion, normal_control
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec, part_source
   use contact_grid_element_division, only : element
   use hard_case, only : close_table, elliptic_case, expect_refusal, expect_solution, given_case, hard_run, open_table
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("hard shapes")
   call open_table("Extremes of shape")
   call single_elements()
   call strips()
   call edges()
   call nothing()
   call slender()
   call planforms()
   call close_table()
   call suite%finish()

contains

   !> A moderate amount of creepage or shift
   subroutine set_creepage(spec)
      type(case_spec), intent(inout) :: spec

      spec%kinematics%cksi = merge(2.0e-4_wp, 1.0e-3_wp, spec%motion == motion%shift)
      spec%kinematics%ceta = -0.5_wp*spec%kinematics%cksi
      spec%kinematics%cphi = merge(2.0e-4_wp, 2.0e-3_wp, spec%motion == motion%shift)
   end subroutine set_creepage

   subroutine single_elements()
      type(case_spec) :: spec
      type(hard_run) :: run
      integer :: t, window, k
      character(len=40) :: label
      real(wp), parameter :: share(4) = [0.0_wp, 0.5_wp, 0.999_wp, 0.9999_wp]

      do window = 1, 5, 4
         do t = motion%none, motion%steady_rolling
            write(label, "(a, i0, a, i0)") "one element, window ", window, ", T=", t
            spec = given_case(t, window, window)
            spec%kinematics%fn = 0.05_wp
            call expect_solution(suite, run, spec, trim(label))
            call suite%equal(run%result%ncon, 1, trim(label) // ": one element in contact")
            if (t == motion%none) cycle
            call set_creepage(spec)
            call expect_solution(suite, run, spec, trim(label) // " with creepage")
            spec%kinematics%cksi = 10.0_wp
            call expect_solution(suite, run, spec, trim(label) // " sliding")
            spec%kinematics%cksi = 0.0_wp
            spec%kinematics%ceta = 0.0_wp
            do k = 1, size(share)
               spec%force = 1
               spec%kinematics%fx = -share(k)
               write(label, "(a, i0, a, i0, a, f6.4)") "one element, window ", window, ", T=", t, ", F=1 ", share(k)
               call expect_solution(suite, run, spec, trim(label))
               spec%force = 2
               spec%kinematics%fx = 0.6_wp*share(k)
               spec%kinematics%fy = 0.8_wp*share(k)
               write(label, "(a, i0, a, i0, a, f6.4)") "one element, window ", window, ", T=", t, ", F=2 ", share(k)
               call expect_solution(suite, run, spec, trim(label))
            end do
         end do
      end do
      call run%release()
   end subroutine single_elements

   !> One row, one column, few rows
   subroutine strips()
      integer, parameter :: sizes(2, 8) = reshape([40, 1, 1, 40, 300, 1, 1, 300, 40, 2, 2, 40, 100, 3, 3, 100], [2, 8])
      type(case_spec) :: spec
      type(hard_run) :: run
      integer :: t, k
      character(len=40) :: label

      do k = 1, size(sizes, 2)
         do t = motion%shift, motion%steady_rolling
            write(label, "(i0, a, i0, a, i0)") sizes(1, k), " x ", sizes(2, k), ", T=", t
            spec = given_case(t, sizes(1, k), sizes(2, k))
            spec%kinematics%fn = 5.0_wp*maxval(sizes(:, k))
            call set_creepage(spec)
            call expect_solution(suite, run, spec, trim(label))
            spec%force = 2
            spec%kinematics%fx = 0.5_wp
            spec%kinematics%fy = -0.5_wp
            call expect_solution(suite, run, spec, trim(label) // ", F=2")
         end do
      end do
      ! two-dimensional: one row, very long across
      do t = motion%shift, motion%steady_rolling
         spec = given_case(t, 80, 1)
         spec%grid%dy = 1.0e5_wp*spec%grid%dx
         spec%grid%yl = -0.5_wp*spec%grid%dy
         spec%geometry%b(3) = 0.0_wp
         spec%kinematics%fn = 500.0_wp*spec%grid%dy
         spec%kinematics%cksi = merge(2.0e-4_wp, 1.0e-2_wp, t /= motion%shift)
         write(label, "(a, i0)") "two-dimensional, dy/dx 1e5, T=", t
         call expect_solution(suite, run, spec, trim(label))
         spec%force = 1
         spec%kinematics%fx = -0.657_wp
         call expect_solution(suite, run, spec, trim(label) // ", F=1")
         spec%kinematics%fx = -0.999_wp
         call expect_solution(suite, run, spec, trim(label) // ", F=1 0.999")
      end do
      call run%release()
   end subroutine strips

   !> Contact cut off by the edge of the window, and windows that are in contact everywhere
   subroutine edges()
      type(case_spec) :: spec
      type(hard_run) :: run
      integer :: t, k
      character(len=40) :: label
      character(len=6), parameter :: sides(4) = ["low x ", "high x", "low y ", "high y"]
      real(wp), parameter :: moves(2, 4) = reshape([1.0_wp, 0.0_wp, -1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, -1.0_wp], [2, 4])

      do t = motion%shift, motion%steady_rolling
         do k = 1, 4
            spec = given_case(t, 21, 23)
            spec%grid%xl = spec%grid%xl + moves(1, k)
            spec%grid%yl = spec%grid%yl + moves(2, k)
            call set_creepage(spec)
            write(label, "(a, i0)") "contact at the edge: " // trim(sides(k)) // ", T=", t
            call expect_solution(suite, run, spec, trim(label))
            call suite%check(any(run%result%division([1, 21], :) > element%exterior) &
               & .or. any(run%result%division(:, [1, 23]) > element%exterior), trim(label) // ": touches the edge")
            spec%normal = normal_control%approach
            spec%kinematics%pen = 5.0e-3_wp
            call expect_solution(suite, run, spec, trim(label) // ", N=0")
         end do
         spec = given_case(t, 20, 20)
         spec%kinematics%fn = 1.0e5_wp
         call set_creepage(spec)
         write(label, "(a, i0)") "whole window in contact, T=", t
         call expect_solution(suite, run, spec, trim(label))
         call suite%equal(run%result%ncon, 400, trim(label) // ": all elements")
         spec%normal = normal_control%approach
         spec%kinematics%pen = 100.0_wp
         call expect_solution(suite, run, spec, trim(label) // ", N=0 with a large approach")
         call suite%equal(run%result%ncon, 400, trim(label) // ": all elements, large approach")
         spec = given_case(t, 20, 20)
         spec%geometry%b = 0.0_wp
         call set_creepage(spec)
         write(label, "(a, i0)") "flat punch, T=", t
         call expect_solution(suite, run, spec, trim(label))
         spec%geometry%b(6) = -1.0_wp
         call expect_solution(suite, run, spec, trim(label) // ", moved by 1 mm")
      end do
      call run%release()
   end subroutine edges

   !> No contact, no force
   subroutine nothing()
      type(case_spec) :: spec
      type(hard_run) :: run
      integer :: t
      character(len=40) :: label

      do t = motion%none, motion%steady_rolling
         spec = given_case(t, 11, 12)
         spec%kinematics%fn = 0.0_wp
         call set_creepage(spec)
         write(label, "(a, i0)") "FN 0, T=", t
         call expect_solution(suite, run, spec, trim(label))
         call suite%equal(run%result%ncon, 0, trim(label) // ": no contact")
         spec%normal = normal_control%approach
         spec%kinematics%pen = -0.1_wp
         write(label, "(a, i0)") "PEN below the lowest point, T=", t
         call expect_solution(suite, run, spec, trim(label))
         call suite%equal(run%result%ncon, 0, trim(label) // ": no contact")
         if (t > motion%none) then
            spec%force = 2
            spec%kinematics%fx = 0.5_wp
            call expect_solution(suite, run, spec, trim(label) // ", F=2")
            spec%force = 0
         end if
         ! contact again in the next case of the same session
         spec%link = 0
         spec%parts%grid = part_source%kept
         spec%parts%geometry = part_source%kept
         spec%kinematics%pen = 5.0e-3_wp
         if (t == motion%steady_rolling) spec%link = 2
         call expect_solution(suite, run, spec, trim(label) // ", contact in the next case")
         spec%kinematics%pen = -5.0e-3_wp
         call expect_solution(suite, run, spec, trim(label) // ", contact lost again")
         call suite%equal(run%result%ncon, 0, trim(label) // ": lost")
         spec = elliptic_case(t, 11, 12, 3.0_wp, 5.0_wp)
         spec%grid%form = -1
         spec%grid%a1 = 1.0e-3_wp
         spec%grid%b1 = 1.0e-3_wp
         spec%kinematics%fn = 0.0_wp
         call expect_solution(suite, run, spec, trim(label) // ", Hertz, FN 0")
         spec%kinematics%fn = 1.0e-12_wp
         call expect_solution(suite, run, spec, trim(label) // ", Hertz, FN 1e-12")
         spec%kinematics%fn = 1.0e12_wp
         call expect_solution(suite, run, spec, trim(label) // ", Hertz, FN 1e12")
      end do
      call run%release()
   end subroutine nothing

   !> Slender ellipses and slender elements
   subroutine slender()
      type(case_spec) :: spec
      type(hard_run) :: run
      integer :: t, k
      character(len=40) :: label
      real(wp), parameter :: ratio(6) = [0.02_wp, 0.1_wp, 0.3_wp, 3.0_wp, 10.0_wp, 50.0_wp]
      real(wp), parameter :: sides(6) = [0.05_wp, 0.2_wp, 0.5_wp, 2.0_wp, 5.0_wp, 20.0_wp]

      do t = motion%shift, motion%steady_rolling
         do k = 1, size(ratio)
            spec = elliptic_case(t, 25, 25, sqrt(ratio(k)), 1.0_wp/sqrt(ratio(k)))
            write(label, "(a, f5.2, a, i0)") "ellipse ratio ", ratio(k), ", T=", t
            call set_creepage(spec)
            call expect_solution(suite, run, spec, trim(label))
            spec%force = 2
            spec%kinematics%fx = -0.6_wp
            spec%kinematics%fy = 0.6_wp
            call expect_solution(suite, run, spec, trim(label) // ", F=2")
         end do
         do k = 1, size(sides)
            ! a round contact, dx/dy as given
            spec = elliptic_case(t, nint(28.0_wp/sqrt(sides(k))), nint(28.0_wp*sqrt(sides(k))), 1.0_wp, 1.0_wp)
            write(label, "(a, f5.2, a, i0)") "element ratio ", sides(k), ", T=", t
            call set_creepage(spec)
            call expect_solution(suite, run, spec, trim(label))
            spec%force = 1
            spec%kinematics%fx = -0.9_wp
            call expect_solution(suite, run, spec, trim(label) // ", F=1")
         end do
      end do
      call run%release()
   end subroutine slender

   !> Elements that a planform excludes
   subroutine planforms()
      type(case_spec) :: spec
      type(hard_run) :: run
      integer :: t
      character(len=40) :: label

      do t = motion%shift, motion%steady_rolling
         spec = given_case(t, 24, 24)
         spec%geometry%planform = 3
         spec%geometry%pl = [-1.0_wp, -0.2_wp, -1.0_wp, 1.0_wp, 0.3_wp, 0.8_wp, -0.4_wp, 0.9_wp]
         call set_creepage(spec)
         write(label, "(a, i0)") "two rectangles, T=", t
         call expect_solution(suite, run, spec, trim(label))
         spec%geometry%b = 0.0_wp
         call expect_solution(suite, run, spec, trim(label) // ", flat")
         spec%normal = normal_control%approach
         spec%kinematics%pen = 1.0e-3_wp
         call expect_solution(suite, run, spec, trim(label) // ", flat, N=0")
         ! a ring is not given by one quadratic form; a disc is
         spec = given_case(t, 24, 24)
         spec%geometry%planform = 2
         spec%geometry%pl(1:6) = [1.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, -0.25_wp]
         call set_creepage(spec)
         write(label, "(a, i0)") "disc, T=", t
         call expect_solution(suite, run, spec, trim(label))
         spec%geometry%pl(6) = 1.0_wp
         call expect_refusal(suite, run, spec, trim(label) // ", empty planform", "planform")
      end do
      call run%release()
   end subroutine planforms
end program test_hard_shapes
