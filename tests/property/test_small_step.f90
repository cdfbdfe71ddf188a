!> Small steps of the approach against solutions at the new approach: the error decreases with the square of the step
program test_small_step
   use contact_base_choices, only : motion, normal_control, sensitivity_choice
   use contact_base_kinds, only : wp
   use contact_patch_problem, only : patch_state
   use contact_patch_result, only : patch_result
   use contact_patch_sensitivities, only : find_sensitivities
   use contact_patch_small_step, only : can_step, small_step, step_with_tractions
   use contact_test_case_builder, only : creep, grid_case, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite
   !> Changes of the approach, relative to it
   real(wp), parameter :: parts(*) = [4.0e-3_wp, 1.0e-3_wp, 2.5e-4_wp, -4.0e-3_wp, -1.0e-3_wp, -2.5e-4_wp]
   !> Error over the square of the change: elements that enter or leave the contact
   real(wp), parameter :: most = 5.0_wp
   !> Approach of the first solution [mm]
   real(wp), parameter :: pen = 0.02_wp
   integer :: k

   call suite%start("small_step")
   do k = 1, 4
      call compare(suite, k, second_order=.false.)
      if (k < 4) call compare(suite, k, second_order=.true.)
   end do
   call suite%finish()

contains

   !> Little, much and full sliding, and no friction at all
   subroutine set_case(kind, second_order, case)
      integer, intent(in) :: kind
      logical, intent(in) :: second_order
      type(test_case), intent(inout) :: case
      real(wp), parameter :: creepage(3) = [4.0e-4_wp, 1.2e-3_wp, 2.0e-2_wp]

      case%spec = grid_case(0.010_wp, 0.016_wp, 1.0_wp, 35, 31, 0.11_wp, 0.11_wp, eps=1.0e-11_wp)
      case%spec%normal = normal_control%approach
      case%spec%kinematics%pen = pen
      case%spec%iteration%order = merge(2, 1, second_order)
      if (kind < 4) call creep(case%spec, motion%steady_rolling, creepage(kind), 0.5_wp*creepage(kind), 2.0e-4_wp, mu=0.3_wp)
   end subroutine set_case

   subroutine compare(suite, kind, second_order)
      type(test_suite), intent(inout) :: suite
      integer, intent(in) :: kind
      logical, intent(in) :: second_order
      type(test_case) :: case, other
      type(patch_state) :: state
      type(patch_result) :: result
      character(len=40) :: what
      real(wp) :: scaled, solved, scale
      integer :: k

      call set_case(kind, second_order, case)
      call case%run(suite, "first approach")
      associate (session => case%session)
         session%problem%follows_approach = .true.
         session%problem%sensitivity = sensitivity_choice%normal
         session%problem%epsens = 1.0e-9_wp
         session%problem%mxsens = 200
         call find_sensitivities(session%problem, session%workspace, session%state, case%result, case%log)
         call suite%check(can_step(session%problem, session%state), "a step is possible")
         do k = 1, size(parts)
            write(what, "(A,I0,A,L1,A,ES8.1)") "kind ", kind, ", order 2 ", second_order, ", ", parts(k)
            call set_case(kind, second_order, other)
            other%spec%kinematics%pen = pen*(1.0_wp + parts(k))
            call other%run(suite, trim(what))
            scale = other%result%fn
            state = session%state
            result = case%result
            call small_step(session%problem, pen*parts(k), state, result)
            scaled = distance(result, other%result)/scale
            call suite%close_to(result%fn/scale, 1.0_wp, most*parts(k)**2, trim(what) // ": normal force")
            state = session%state
            result = case%result
            call step_with_tractions(session%problem, pen*parts(k), state, session%workspace, case%log, result)
            solved = distance(result, other%result)/scale
            call suite%close_to(solved, 0.0_wp, most*parts(k)**2, trim(what) // ": forces with tractions solved")
            call suite%close_to(result%mz/scale, other%result%mz/scale, most*parts(k)**2, trim(what) // ": moment")
            call suite%close_to(scaled, 0.0_wp, 0.2_wp*abs(parts(k)), trim(what) // ": forces with tractions scaled")
            ! where surfaces adhere and slide, scaled tractions are wrong to first order
            if (kind == 2) call suite%check(solved < 0.5_wp*scaled, trim(what) // ": solved tractions are better")
            call other%release()
         end do
      end associate
      call case%release()
   end subroutine compare

   !> Largest difference of forces [N]
   pure real(wp) function distance(a, b)
      type(patch_result), intent(in) :: a, b

      distance = maxval(abs([a%fn - b%fn, a%fx - b%fx, a%fy - b%fy]))
   end function distance
end program test_small_step
