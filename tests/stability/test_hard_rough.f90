!> Rough surfaces: many small contact areas, several random surfaces, given element by element
program test_hard_rough
   use contact_base_choices, only : motion, normal_control
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_grid_element_division, only : element
   use hard_case, only : close_table, expect_solution, given_case, hard_run, open_table, random_numbers
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("rough surfaces")
   call open_table("Rough surfaces")
   call draws()
   call close_table()
   call suite%finish()

contains

   subroutine draws()
      integer, parameter :: n = 48, seeds(4) = [20261, 7, 123456789, 31415]
      type(case_spec) :: spec
      type(hard_run) :: run
      integer :: draw, kind, t, seed, tangential
      real(wp), allocatable :: heights(:)
      character(len=64) :: label

      allocate(heights(n*n))
      do draw = 1, size(seeds)
         seed = seeds(draw)
         call random_numbers(seed, heights)
         do kind = 1, 3
            write(*, "(a, i0, a, i0)") "rough surface, seed ", seeds(draw), ", kind ", kind
            do t = motion%none, motion%steady_rolling
               spec = given_case(t, n, n)
               spec%geometry%form = 9
               spec%geometry%h = surface(kind, n, heights)
               spec%kinematics%cksi = merge(1.0e-4_wp, 1.0e-3_wp, t == motion%shift)
               spec%kinematics%ceta = 0.3_wp*spec%kinematics%cksi
               spec%kinematics%cphi = 1.0e-4_wp
               write(label, "(a, i0, a, i0, a, i0)") "seed ", seeds(draw), ", kind ", kind, ", T=", t
               call expect_solution(suite, run, spec, trim(label), sampled=.true.)
               if (draw == 1) write(*, "(a, i0, a)") "   ", islands(run%result%division), " islands"
               spec%normal = normal_control%approach
               spec%kinematics%pen = 0.8_wp*run%result%pen + 0.2_wp*minval(run%result%h)
               call expect_solution(suite, run, spec, trim(label) // ", N=0", sampled=.true.)
               if (t == motion%none) cycle
               do tangential = 1, 2
                  spec%normal = normal_control%force
                  spec%force = tangential
                  spec%kinematics%fx = -0.7_wp
                  spec%kinematics%fy = 0.5_wp
                  write(label, "(a, i0, a, i0, a, i0, a, i0)") "seed ", seeds(draw), ", kind ", kind, ", T=", t, ", F=", tangential
                  call expect_solution(suite, run, spec, trim(label), sampled=.true.)
               end do
            end do
         end do
      end do
      call run%release()
   end subroutine draws

   !> Undeformed distance: white noise on a sphere, white noise on a plane, smooth bumps on a sphere
   function surface(kind, n, heights) result(h)
      integer, intent(in) :: kind, n
      real(wp), intent(in) :: heights(:)
      real(wp) :: h(n*n)
      real(wp) :: x, y, bump
      integer :: ix, iy, k

      do iy = 1, n
         do ix = 1, n
            k = ix + n*(iy - 1)
            x = 0.1_wp*(ix - 0.5_wp*(n + 1))
            y = 0.1_wp*(iy - 0.5_wp*(n + 1))
            select case (kind)
            case (1)
               h(k) = 2.0e-3_wp*(x**2 + y**2) + 5.0e-4_wp*heights(k)
            case (2)
               h(k) = 3.0e-3_wp*heights(k)
            case default
               bump = sin(6.0_wp*x + 6.0_wp*heights(1))*sin(5.0_wp*y + 6.0_wp*heights(2)) &
                  & + 0.5_wp*sin(11.0_wp*x - 3.0_wp*y + 6.0_wp*heights(3))
               h(k) = 1.0e-3_wp*(x**2 + y**2) + 2.0e-3_wp*bump
            end select
         end do
      end do
   end function surface

   !> Number of connected parts of the contact area, by spreading labels
   integer function islands(division)
      integer, intent(in) :: division(:, :)
      integer, allocatable :: mark(:, :)
      integer :: ix, iy, jx, jy, low
      logical :: moved

      allocate(mark(size(division, 1), size(division, 2)), source=0)
      do iy = 1, size(mark, 2)
         do ix = 1, size(mark, 1)
            if (division(ix, iy) > element%exterior) mark(ix, iy) = ix + size(mark, 1)*(iy - 1)
         end do
      end do
      do
         moved = .false.
         do iy = 1, size(mark, 2)
            do ix = 1, size(mark, 1)
               if (mark(ix, iy) == 0) cycle
               low = mark(ix, iy)
               do jy = max(1, iy - 1), min(size(mark, 2), iy + 1)
                  do jx = max(1, ix - 1), min(size(mark, 1), ix + 1)
                     if (mark(jx, jy) > 0) low = min(low, mark(jx, jy))
                  end do
               end do
               if (low == mark(ix, iy)) cycle
               mark(ix, iy) = low
               moved = .true.
            end do
         end do
         if (.not. moved) exit
      end do
      islands = 0
      do iy = 1, size(mark, 2)
         do ix = 1, size(mark, 1)
            if (mark(ix, iy) == ix + size(mark, 1)*(iy - 1)) islands = islands + 1
         end do
      end do
   end function islands
end program test_hard_rough
