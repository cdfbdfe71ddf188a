!> Data of particles that are transferred from one time step to the next
program test_moments
   use contact_base_choices, only : estimate_choice, motion, time_link
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_time_steps, only : link_time_steps
   use contact_patch_problem, only : carried, patch_problem, patch_state
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> What is looked at
   integer, parameter :: yield = carried%tau_c
   real(wp), parameter :: closed = 100.0_wp*epsilon(1.0_wp)
   type(test_suite) :: suite

   call suite%start("moments")
   call rolling(suite)
   call moved_window(suite)
   call other_links(suite)
   call suite%finish()

contains

   !> A window of 5 by 3 elements on which yield limits are remembered
   subroutine new_problem(problem)
      type(patch_problem), intent(out) :: problem

      problem%grid = potential_contact(mx=5, my=3, dx=0.5_wp, dy=2.0_wp, xl=0.0_wp, yl=0.0_wp)
      problem%motion = motion%transient_rolling
      problem%dq = 0.5_wp
      problem%estimate = estimate_choice%unchanged
      problem%remembers_yield = .true.
      problem%initial_yield_limit = 7.0_wp
   end subroutine new_problem

   !> A state in which the yield limit is a linear function of the position of the element
   subroutine fill(problem, state)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(inout) :: state
      type(error_type), allocatable :: error
      integer :: ix, iy

      call link_time_steps(problem, time_link%initiate, state, error)
      state%started = .true.
      do iy = 1, problem%grid%my
         do ix = 1, problem%grid%mx
            state%now%memory(yield)%value(ix, iy) = 10.0_wp*ix + iy
         end do
      end do
   end subroutine fill

   subroutine rolling(suite)
      type(test_suite), intent(inout) :: suite
      type(patch_problem) :: problem
      type(patch_state) :: state
      type(error_type), allocatable :: error

      call new_problem(problem)
      call fill(problem, state)
      call suite%close_to(state%before%memory(yield)%value(3, 2), 7.0_wp, closed, "fresh material at the start of a sequence")

      call link_time_steps(problem, time_link%continue_all, state, error)
      call suite%close_to(state%before%memory(yield)%value(:, 2), [22.0_wp, 32.0_wp, 42.0_wp, 52.0_wp, 7.0_wp], closed, &
         & "one element per step: the particles were one element ahead")

      problem%dq = 0.625_wp
      call link_time_steps(problem, time_link%continue_all, state, error)
      call suite%close_to(state%before%memory(yield)%value(2, 3), 35.5_wp, closed, "a step of 1.25 elements: interpolated")

      problem%chi = pi
      call link_time_steps(problem, time_link%continue_all, state, error)
      call suite%close_to(state%before%memory(yield)%value(4, 3), 30.5_wp, 1.0e-12_wp, "the same in the other direction")
      call suite%close_to(state%before%memory(yield)%value(1, 3), 7.0_wp, 1.0e-12_wp, "fresh material at the leading edge")

      problem%chi = 0.5_wp*pi
      problem%dq = 1.0_wp
      call link_time_steps(problem, time_link%continue_all, state, error)
      call suite%close_to(state%before%memory(yield)%value(2, 1), 21.5_wp, 1.0e-12_wp, "rolling sideways by half an element")
   end subroutine rolling

   subroutine moved_window(suite)
      type(test_suite), intent(inout) :: suite
      type(patch_problem) :: problem
      type(patch_state) :: state
      type(error_type), allocatable :: error

      call new_problem(problem)
      problem%motion = motion%shift
      problem%dq = 1.0_wp
      call fill(problem, state)
      problem%grid = potential_contact(mx=4, my=4, dx=0.5_wp, dy=2.0_wp, xl=1.0_wp, yl=-2.0_wp)
      call link_time_steps(problem, time_link%continue_all, state, error)
      call suite%check(.not. allocated(error), "a window that moves by whole elements")
      call suite%check(all(shape(state%before%memory(yield)%value) == [4, 4]), "fields have the size of the window")
      call suite%close_to(state%before%memory(yield)%value(:, 2), [31.0_wp, 41.0_wp, 51.0_wp, 7.0_wp], closed, &
         & "values stay in place")
      call suite%close_to(state%before%memory(yield)%value(:, 1), [7.0_wp, 7.0_wp, 7.0_wp, 7.0_wp], closed, &
         & "fresh where the window is new")
   end subroutine moved_window

   subroutine other_links(suite)
      type(test_suite), intent(inout) :: suite
      type(patch_problem) :: problem
      type(patch_state) :: state
      type(error_type), allocatable :: error

      call new_problem(problem)
      call fill(problem, state)
      call link_time_steps(problem, time_link%continue_all, state, error)
      state%now%memory(yield)%value = 1.0_wp
      call link_time_steps(problem, time_link%repeat_step, state, error)
      call suite%close_to(state%before%memory(yield)%value(1, 2), 22.0_wp, closed, "a repeated step keeps the previous time step")
      call link_time_steps(problem, time_link%continue_normal, state, error)
      call suite%close_to(state%before%memory(yield)%value(1, 2), 7.0_wp, closed, "new material if only pressures are continued")
      problem%remembers_yield = .false.
      call link_time_steps(problem, time_link%continue_all, state, error)
      call suite%check(.not. allocated(state%before%memory(yield)%value) .and. .not. allocated(state%now%memory(yield)%value), &
         & "only data required by an effect are transferred")
   end subroutine other_links
end program test_moments
