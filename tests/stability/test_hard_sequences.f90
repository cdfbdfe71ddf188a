!> Long sequences, windows that move, patches that split and merge, two interleaved problems
program test_hard_sequences
   use contact_base_choices, only : estimate_choice, motion, normal_control, time_link
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec, part_source
   use hard_case, only : close_table, examine, expect_solution, findings, given_case, hard_run, open_table, run_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   real(wp), parameter :: pi = acos(-1.0_wp)
   type(test_suite) :: suite

   call suite%start("hard sequences")
   call open_table("Sequences")
   call oscillating_force()
   call growing_load()
   call rolling_windows()
   call split_and_merge()
   call two_sessions()
   call close_table()
   call suite%finish()

contains

   !> Is this step written to the table and checked by direct sums?
   pure logical function looked_at(step)
      integer, intent(in) :: step
      looked_at = step <= 5 .or. mod(step, 100) == 0
   end function looked_at

   !> One step of a long sequence: every step must converge, some are examined in full
   subroutine take_step(run, spec, name, step)
      type(hard_run), intent(inout) :: run
      type(case_spec), intent(in) :: spec
      character(len=*), intent(in) :: name
      integer, intent(in) :: step
      character(len=8) :: label

      write(label, "(i0)") step
      if (looked_at(step)) then
         call expect_solution(suite, run, spec, name // ", step " // trim(label), slack=1.05_wp)
         return
      end if
      call run_case(run, spec)
      if (allocated(run%error)) then
         call suite%check(.false., name // ", step " // trim(label) // ": " // run%error%message)
         return
      end if
      call suite%check(run%result%normal%succeeded() .and. run%result%tangential%succeeded(), &
         & name // ", step " // trim(label) // " converges")
   end subroutine take_step

   !> 1000 shifts with an alternating tangential force, as in fretting
   subroutine oscillating_force()
      type(case_spec) :: spec
      type(hard_run) :: run
      integer :: step
      real(wp) :: first, last

      spec = given_case(motion%shift, 17, 17)
      spec%kinematics%fn = 60.0_wp
      first = 0.0_wp
      last = 0.0_wp
      do step = 1, 1000
         spec%force = 1
         spec%kinematics%fx = 0.9_wp*sin(2.0_wp*pi*step/40.0_wp)
         call take_step(run, spec, "swinging force", step)
         spec%link = time_link%continue_all
         spec%estimate = estimate_choice%previous
         spec%parts%grid = part_source%kept
         spec%parts%geometry = part_source%kept
         if (step == 90) first = run%result%cksi
         if (step == 970) last = run%result%cksi
      end do
      call suite%close_to(last, first, 1.0e-3_wp, "the cycle of an alternating force repeats itself", relative=.true.)
      call run%release()
   end subroutine oscillating_force

   !> The normal force alternates as well: the contact area grows and shrinks
   subroutine growing_load()
      type(case_spec) :: spec
      type(hard_run) :: run
      integer :: step

      spec = given_case(motion%shift, 17, 17)
      do step = 1, 300
         spec%kinematics%fn = 60.0_wp*(1.0_wp + 0.9_wp*sin(2.0_wp*pi*step/23.0_wp))
         spec%kinematics%cksi = 2.0e-5_wp*cos(2.0_wp*pi*step/31.0_wp)
         spec%kinematics%ceta = 1.0e-5_wp*sin(2.0_wp*pi*step/17.0_wp)
         call take_step(run, spec, "swinging load", step)
         spec%link = time_link%continue_all
         spec%estimate = estimate_choice%previous
         spec%parts%grid = part_source%kept
         spec%parts%geometry = part_source%kept
      end do
      call run%release()
   end subroutine growing_load

   !> 1000 steps of transient rolling, the window moves with the contact
   subroutine rolling_windows()
      type(case_spec) :: spec
      type(hard_run) :: run
      integer :: step

      spec = given_case(motion%transient_rolling, 17, 15)
      spec%kinematics%fn = 60.0_wp
      do step = 1, 1000
         spec%kinematics%cksi = 1.0e-3_wp*(1.0_wp + sin(2.0_wp*pi*step/50.0_wp))
         spec%kinematics%ceta = 4.0e-4_wp*cos(2.0_wp*pi*step/70.0_wp)
         ! the bodies are described in fixed axes: the contact moves by one element per step
         if (step > 1) then
            spec%grid%xl = spec%grid%xl + merge(spec%grid%dx, 0.0_wp, mod(step, 5) == 0)
            spec%grid%yl = spec%grid%yl + merge(spec%grid%dy, 0.0_wp, mod(step, 50) == 0) &
               & - merge(spec%grid%dy, 0.0_wp, mod(step, 50) == 25)
         end if
         spec%geometry%b(4) = -2.0_wp*spec%geometry%b(1)*(spec%grid%xl + 0.5_wp*17*spec%grid%dx)
         spec%geometry%b(5) = -2.0_wp*spec%geometry%b(3)*(spec%grid%yl + 0.5_wp*15*spec%grid%dy)
         call take_step(run, spec, "moving window", step)
         spec%link = time_link%continue_all
         spec%estimate = estimate_choice%previous
      end do
      call run%release()
   end subroutine rolling_windows

   !> Two bumps under a sphere with varying force: one patch, two, three, one
   subroutine split_and_merge()
      type(case_spec) :: spec
      type(hard_run) :: run
      integer :: step, ix, iy, t
      real(wp) :: x, y, depth
      character(len=40) :: label

      do t = motion%shift, motion%transient_rolling
         spec = given_case(t, 31, 21)
         spec%geometry%form = 9
         allocate(spec%geometry%h(31*21))
         do step = 1, 60
            depth = 2.0e-3_wp*(1.0_wp - cos(2.0_wp*pi*step/20.0_wp))
            do iy = 1, 21
               do ix = 1, 31
                  x = 0.1_wp*(ix - 16)
                  y = 0.1_wp*(iy - 11)
                  spec%geometry%h(ix + 31*(iy - 1)) = 2.0e-3_wp*(x**2 + y**2) + depth*cos(4.0_wp*x + 0.1_wp*step)
               end do
            end do
            spec%kinematics%cksi = merge(2.0e-5_wp, 5.0e-4_wp, t == motion%shift)
            write(label, "(a, i0, a, i0)") "split and merge, T=", t, ", step ", step
            call expect_solution(suite, run, spec, trim(label), silent=mod(step, 10) /= 0)
            spec%link = time_link%continue_all
            spec%estimate = estimate_choice%previous
         end do
         deallocate(spec%geometry%h)
      end do
      call run%release()
   end subroutine split_and_merge

   !> Two interleaved problems give the results of each alone, bit by bit
   subroutine two_sessions()
      type(case_spec) :: a, b
      type(hard_run) :: alone(2), turn(2)
      integer :: step, k
      type(findings) :: found

      a = given_case(motion%shift, 17, 17)
      b = given_case(motion%steady_rolling, 23, 11)
      b%material%poiss = [0.0_wp, 0.3_wp]
      b%material%gg = [2000.0_wp, 82000.0_wp]
      b%iteration%maxout = 5
      b%normal = normal_control%force
      do step = 1, 20
         call vary(a, b, step)
         call run_case(alone(1), a)
      end do
      a = given_case(motion%shift, 17, 17)
      do step = 1, 20
         call vary(a, b, step)
         call run_case(alone(2), b)
      end do
      do step = 1, 20
         call vary(a, b, step)
         call run_case(turn(1), a)
         call run_case(turn(2), b)
      end do
      do k = 1, 2
         call suite%check(.not. (allocated(alone(k)%error) .or. allocated(turn(k)%error)), "two interleaved problems have no error")
         call suite%check(all(alone(k)%result%px == turn(k)%result%px) .and. all(alone(k)%result%py == turn(k)%result%py) &
            & .and. all(alone(k)%result%pn == turn(k)%result%pn) .and. alone(k)%result%cksi == turn(k)%result%cksi, &
            & "two interleaved problems have the results of each alone")
      end do
      call examine(turn(1), a, found)
      call suite%close_to(found%friction, 0.0_wp, 1.05e-6_wp, "the first of two interleaved problems is solved")
      do k = 1, 2
         call alone(k)%release()
         call turn(k)%release()
      end do
   end subroutine two_sessions

   !> Step of both problems
   subroutine vary(a, b, step)
      type(case_spec), intent(inout) :: a, b
      integer, intent(in) :: step

      a%link = merge(time_link%initiate, time_link%continue_all, step == 1)
      a%estimate = merge(estimate_choice%fresh, estimate_choice%previous, step == 1)
      b%link = a%link
      b%estimate = a%estimate
      a%kinematics%fn = 60.0_wp + 5.0_wp*mod(step, 4)
      a%force = 2
      a%kinematics%fx = 0.8_wp*sin(0.5_wp*step)
      a%kinematics%fy = 0.1_wp
      b%kinematics%fn = 5.0_wp + step
      b%kinematics%cksi = 1.0e-4_wp*step
   end subroutine vary
end program test_hard_sequences
