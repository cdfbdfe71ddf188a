!> The problem of a case does not depend on the previous case, whose arrays a session keeps: no data of another law, model or grid
!> remain
program test_unrelated_cases
   use contact_base_error, only : error_type, full_text
   use contact_base_log, only : log_type
   use contact_cases_patch_setup, only : set_problem
   use contact_cases_spec, only : case_spec
   use contact_input_experiment_file, only : experiment_reader, input_case
   use contact_patch_problem, only : patch_problem
   use contact_test_harness, only : test_suite
   implicit none (type, external)

   !> Examples of contact problems with all the physics there is
   character(len=*), parameter :: names(*) = [character(len=19) :: "approximate", "bentall", "carter2d", "cattaneo", &
      & "falling_friction", "groove", "layer_element", "layer_traction", "simplified", "sliding_temperature", "spence35", &
      & "subsurface", "visc_rollers"]
   !> Values of `state_of`
   integer, parameter :: n_states = 30
   type(test_suite) :: suite
   type(case_spec) :: specs(size(names))
   character(len=:), allocatable :: folder
   integer :: first, length, second

   call suite%start("unrelated_cases")
   call get_environment_variable("CONTACT_SOURCE", length=length)
   allocate(character(len=length) :: folder)
   call get_environment_variable("CONTACT_SOURCE", folder)
   folder = folder // "/examples/"
   do first = 1, size(names)
      call read_first_case(trim(names(first)), specs(first))
   end do
   do second = 1, size(names)
      do first = 1, size(names)
         call compare(first, second)
      end do
   end do
   deallocate(folder)
   call suite%finish()

contains

   !> The first case of an example
   subroutine read_first_case(name, spec)
      character(len=*), intent(in) :: name
      type(case_spec), intent(out) :: spec
      type(experiment_reader) :: reader
      type(input_case) :: this
      type(error_type), allocatable :: error

      call reader%open_file(folder // name // ".inp", error)
      if (.not. allocated(error)) call reader%next_case(this, error)
      call suite%check(.not. allocated(error) .and. this%module_number == 3, name // ": the first case is read")
      if (.not. allocated(error)) spec = this%spec
      spec%output_level = 0
   end subroutine read_first_case

   !> Set up the second case alone and after the first one
   subroutine compare(first, second)
      integer, intent(in) :: first, second
      type(patch_problem) :: alone, behind
      integer :: of_one(n_states), of_other(n_states)
      character(len=80) :: what

      call set_up(second, alone)
      call set_up(first, behind)
      call set_up(second, behind)
      of_one = state_of(alone)
      of_other = state_of(behind)
      write(what, "(4A, I0)") trim(names(second)), " behind ", trim(names(first)), ": first difference is in value ", &
         & findloc(of_one /= of_other, .true., dim=1)
      call suite%check(all(of_one == of_other), trim(what))
   end subroutine compare

   !> One case
   subroutine set_up(number, problem)
      integer, intent(in) :: number
      type(patch_problem), intent(inout) :: problem
      type(log_type) :: log
      type(error_type), allocatable :: error

      call set_problem(specs(number), folder, problem, log, error)
      if (.not. allocated(error)) return
      call suite%check(.false., trim(names(number)) // ": " // full_text(error))
   end subroutine set_up

   !> Arrays and models of a problem, with their shapes and requests
   function state_of(problem) result(state)
      type(patch_problem), intent(in) :: problem
      integer :: state(n_states)

      associate (p => problem)
         state = -1
         if (allocated(p%simplified)) state(1) = 1
         if (allocated(p%hertz)) state(2) = 1
         if (allocated(p%h)) state(3:4) = shape(p%h)
         if (allocated(p%parts)) state(5:6) = shape(p%parts%label)
         if (allocated(p%given_pressure)) state(7:8) = shape(p%given_pressure)
         if (allocated(p%pressure_estimate)) state(9:10) = shape(p%pressure_estimate)
         if (allocated(p%extra_slip)) state(11:13) = shape(p%extra_slip)
         if (allocated(p%friction)) state(14:15) = [size(p%friction%sets), p%friction%driver()]
         if (allocated(p%thermal)) state(16) = 1
         if (allocated(p%static_mu)) state(17) = size(p%static_mu)
         if (allocated(p%damping)) state(18) = 1
         state(19:20) = [p%grid%mx, p%grid%my]
         state(21:22) = [p%solver, p%motion]
         state(23:25) = merge(1, 0, [p%remembers_friction, p%remembers_yield, p%force_prescribed])
         state(26:28) = merge(1, 0, [p%corrects_leading_edge, p%general_step, p%want_exterior])
         state(29:30) = [p%n_forces, p%sensitivity]
      end associate
   end function state_of
end program test_unrelated_cases
