!> The state of the library: its run, the problems of its callers, and its one .out file
!>
!> This is the only mutable module variable of the library. It is read and changed inside the critical section `contact_registry`
!> only, which is short; calculations run outside of it.
module contact_capi_library
   use contact_base_log, only : log_type
   use contact_base_output_file, only : output_file
   use contact_capi_problem, only : library_problem, max_patches
   use contact_cases_spec, only : case_spec
   use contact_experiment_stopwatch, only : stopwatch
   implicit none (type, external)
   private

   public :: library, entry_type, element_slot, problem_pointer, existing_problem

   integer, parameter, public :: max_elements = 999
   !> Phases of the library
   integer, parameter, public :: virgin = -3, units_given = -2, finalised = -1, running = 1

   !> A call: routine, result element, patch
   type :: entry_type
      character(len=28) :: name = ""
      integer :: ire = 0
      !> Patch given by the caller, -1: none
      integer :: icp = -1
   end type entry_type

   type :: problem_pointer
      type(library_problem), pointer :: p => null()
      !> Times of calculations and stresses of freed problems with these numbers, for the timer table; and their module
      type(stopwatch) :: total, stresses
      integer :: timed_module = 0
      !> The case with these numbers that was written last to the input file of this run; null: none
      type(case_spec), pointer :: written => null()
   end type problem_pointer

   !> A result element; in module 1 its only problem is the first
   type :: element_slot
      integer :: module_number = 0
      type(problem_pointer) :: patch(max_patches)
   end type element_slot

   type :: library_state
      integer :: phase = virgin
      type(element_slot) :: elements(max_elements)
      integer :: active_elements = 0
      !> Maximum number of threads so far, and number of threads inside a problem
      integer :: max_threads = 1, threads = 1
      !> Level of messages about calls; level of the timer table: 0 none, 1 overview, 2 everything
      integer :: debugging = 0, timer_level = 1
      type(log_type) :: log
      !> The .inp file with the cases; was opening it attempted?
      type(output_file) :: input_dump
      logical :: dump_was_tried = .false.
      !> Folder of that file, absolute, with a separator at its end
      character(len=:), allocatable :: dump_folder
      character(len=:), allocatable :: work_folder, out_folder, name
      type(stopwatch) :: total
      !> Last error that belongs to no problem
      character(len=:), allocatable :: last_error
      integer :: last_code = 0
   end type library_state

   type(library_state), target :: library

contains

   !> The problem with these numbers, null: none; inside the critical section
   function existing_problem(ire, icp) result(problem)
      !> Index of the result element and of the contact problem in it
      integer, intent(in) :: ire, icp
      type(library_problem), pointer :: problem
      integer :: k

      nullify(problem)
      if (ire < 1 .or. ire > max_elements) return
      k = 1
      if (library%elements(ire)%module_number == 3) k = icp
      if (k < 1 .or. k > max_patches) return
      problem => library%elements(ire)%patch(k)%p
   end function existing_problem
end module contact_capi_library
