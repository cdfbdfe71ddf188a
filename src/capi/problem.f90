!> Data of one problem of a caller
!>
!> A problem is one contact patch of a result element (module 3), or a result element with all its patches (module 1). All data are
!> in internal units; conventions are applied at the interface.
module contact_capi_problem
   use, intrinsic :: iso_c_binding, only : c_f_pointer, c_intptr_t, c_loc, c_ptr
   use, intrinsic :: iso_fortran_env, only : int8
   use omp_lib, only : omp_destroy_lock, omp_init_lock, omp_lock_kind
   use contact_base_case_status, only : case_status
   use contact_base_choices, only : grid_form, kernel_model, pressure_model
   use contact_base_constants, only : pi
   use contact_base_guard, only : free_left_blocks, new_owner
   use contact_base_kept_blocks, only : kept_blocks
   use contact_base_kinds, only : wp
   use contact_cases_slot, only : open_contact, open_wheel_rail, problem_slot, release_slot
   use contact_cases_spec, only : case_spec, friction_set, kinematics_spec, material_spec, rolling_spec
   use contact_control_digits, only : case_digits, choice_of
   use contact_control_units, only : unit_convention
   use contact_experiment_stopwatch, only : stopwatch
   use contact_grid_potential_contact, only : potential_contact
   use contact_profile_curve, only : profile_curve
   use contact_profile_surface, only : profile_surface
   use contact_subsurface_points, only : point_block
   use contact_wheelrail_body_frames, only : body_frames
   use contact_wheelrail_spec, only : wheelset_spec
   implicit none (type, external)
   private

   public :: library_problem, given_profile, kind_of_motion, refused_setting, new_problem, release_problem, &
      & abandon_results, abandon_problem, max_patches

   !> Maximum number of patches that can be addressed
   integer, parameter :: max_patches = 9

   !> Subsurface points of one patch of module 1; unallocated: those of the result element
   type :: private_blocks
      type(point_block), allocatable :: list(:)
   end type private_blocks

   !> Metadata of a case, for printing and result files only
   type :: case_metadata
      !> Time [s]; contact point on rail and wheel, x and y [mm]; position of the wheel along the track [mm]
      real(wp) :: time = 0.0_wp, x_rail = 0.0_wp, y_rail = 0.0_wp, x_wheel = 0.0_wp, y_wheel = 0.0_wp, s_wheel = 0.0_wp
      !> Numbers of run, axle and side
      integer :: run = 0, axle = 0, side = 0
   end type case_metadata

   !> Values set by the caller or, if not prescribed, computed by the last case, whichever is later: the next case starts from
   !> them, and callers can get them
   type :: stored_values
      !> Values of contact problems
      type(kinematics_spec) :: kinematics
      !> Direction, step and velocity of rolling as set by the caller; a calculation leaves them
      type(rolling_spec) :: rolling
      !> The same as used in the last calculation, or as set since then: what callers get and files contain. Shifts, steady rolling
      !> and layers have a direction, step and velocity of their own
      type(rolling_spec) :: acting
      !> Values of module 1
      type(wheelset_spec) :: wheelset
   end type stored_values

   !> For which motion values were given that in shifts are displacements and rotations
   type :: kind_of_motion
      !> For a shift?
      logical :: for_shift = .false.
      !> Has no calculation used the values yet? Until then they belong to the motion of the current digit T
      logical :: is_new = .false.
   end type kind_of_motion

   !> Values as given whose meaning and unit depend on the digits T and C1: creepages of contact problems, velocities of a wheelset
   type :: given_motion
      !> Creepages and spin, or as first number the forward velocity or the pitch rate of the roller; the units of the caller then
      real(wp) :: numbers(3) = 0.0_wp
      type(unit_convention) :: units
      type(kind_of_motion) :: values
      !> Is the first number the pitch rate of a roller?
      logical :: for_roller = .false.
      !> The extra rigid slip of the elements; rates of the flexible wheelset and of the rail
      type(kind_of_motion) :: slip, flexible, rail
   end type given_motion

   !> A profile, prepared when it was given
   type :: given_profile
      !> 0: ready for use; 1: nothing was given; others: reason why it cannot be used
      integer :: detail = 1
      type(profile_curve) :: curve
      !> Allocated for variable profiles
      type(profile_surface), allocatable :: surface
      !> Full path of its file when it was read
      character(len=:), allocatable :: path
      !> File to which the points were written for use by an input file; unallocated: not yet
      character(len=:), allocatable :: written_as
   end type given_profile

   !> A setting that was refused, or that is being made
   type :: refused_setting
      !> Name of the routine, blank if no setting is being made
      character(len=28) :: routine = ""
      !> Group of settings: a valid value replaces the refused one. Several groups are separated by "|"
      character(len=48) :: group = ""
      !> Member of library_code, and reason; unallocated if there is no error
      integer :: code = 0
      character(len=:), allocatable :: reason
   end type refused_setting

   !> What getters and stresses below the surface need of the last case that was solved; settings may be those of the next one,
   !> which may have been refused
   type :: solved_bodies
      !> Wheel on rail: markers, and arc lengths of the references of the patches on the profiles of rail and wheel [mm]
      type(body_frames) :: frames
      real(wp) :: along(2, max_patches) = 0.0_wp
      !> Nominal radii of wheel and roller, 0 without them [mm]
      real(wp) :: radii(2) = 0.0_wp
      !> Is it a wheel on the left side of the track, and on a roller?
      logical :: left = .false., roller = .false.
      type(material_spec) :: material
      !> Members of kernel_model, material_model and motion
      integer :: kernel = 0, material_model = 0, motion = 0
   end type solved_bodies

   !> One problem, with data kept from case to case
   type, extends(problem_slot) :: library_problem
      !> Result element; contact patch, -1 in module 1; module
      integer :: ire = 0, icp = -1, module_number = 3
      !> Units of the caller
      type(unit_convention) :: units
      !> Digits given by the caller; the next calculation converts them to choices
      type(case_digits) :: digits
      !> Input of the next calculation, except for the stored values
      type(case_spec) :: spec
      type(stored_values) :: stored
      type(given_motion) :: given
      !> Last case as solved, if its accuracy determined the grid; unallocated otherwise
      type(case_spec), allocatable :: solved
      type(solved_bodies) :: bodies
      !> Profiles of module 1
      type(given_profile) :: rail, wheel
      !> Folder to which names of profiles are relative, in the last calculation
      character(len=:), allocatable :: work_folder
      !> Grid for which influence coefficients were last requested (C of 1 and above); mx = 0: none
      type(potential_contact) :: coefficients
      !> Number of cases so far, and whether there are results
      integer :: cases = 0
      logical :: has_result = .false.
      !> Subsurface points private to patches of module 1
      type(private_blocks) :: blocks(max_patches)
      type(case_metadata) :: metadata
      !> Digits of the last case of wheel and rail whose values are all known, as a list; unallocated before there are any
      integer, allocatable :: known_digits(:)
      !> Write input files of the cases: 0 no, 1 digits as given, 2 complete cases
      integer :: write_input = 0
      !> Time of calculations since the last reset; by patch in module 1
      type(stopwatch) :: watch
      real(wp) :: patch_cpu(max_patches) = 0.0_wp, patch_wall(max_patches) = 0.0_wp
      !> Total time of calculations, and of subsurface stresses, for the timer table
      type(stopwatch) :: total, stresses
      !> Last error; unallocated: none. Its code is a member of library_code
      character(len=:), allocatable :: last_error
      integer :: last_code = 0
      !> The setting being made, and refused settings that were not made since; unallocated: none
      type(refused_setting) :: setting
      type(refused_setting), allocatable :: refused(:)
      !> Status of the last calculation, and whether there was one
      type(case_status) :: status
      logical :: was_calculated = .false.
      !> Owner of the memory that calculations allocate
      integer :: owner = 0
      !> Blocks of memory released by a calculation, for the next one
      type(kept_blocks) :: kept
      !> Number of OpenMP threads of the calling thread, restored after a calculation
      integer :: threads_of_caller = 1
      !> Held by one thread at a time. This and the following components are retained if all others are replaced
      integer(omp_lock_kind) :: lock
      !> Number of threads inside or waiting, protected by the registry's critical section
      integer :: users = 0
   contains
      !> Relative motion of the bodies according to the current digits, member of `motion`
      procedure :: motion
   end type library_problem

   interface
      subroutine c_free(block) bind(c, name="free")
         import :: c_ptr
         type(c_ptr), value :: block
      end subroutine c_free
   end interface

contains

   pure integer function motion(self)
      class(library_problem), intent(in) :: self

      motion = choice_of("T", self%digits%t, self%module_number)
   end function motion

   !> Create a problem with the defaults of the interface
   function new_problem(ire, icp, module_number) result(problem)
      !> Result element; contact patch, -1 for module 1; module 1 or 3
      integer, intent(in) :: ire, icp, module_number
      type(library_problem), pointer :: problem

      allocate(problem)
      problem%ire = ire
      problem%icp = icp
      problem%module_number = module_number
      problem%owner = new_owner()
      call omp_init_lock(problem%lock)
      call set_common_defaults(problem%digits, problem%spec)
      problem%stored%rolling%veloc = 1000.0_wp
      if (module_number == 1) then
         call set_wheel_rail_defaults(problem%digits, problem%spec)
         problem%stored%wheelset%vs = 30000.0_wp
         call open_wheel_rail(problem%problem_slot)
         allocate(problem%wheel_rail_result%patches(0))
      else
         call set_contact_defaults(problem%spec)
         problem%stored%rolling%dq = 2.0_wp
         call open_contact(problem%problem_slot)
      end if
      problem%stored%acting = problem%stored%rolling
   end function new_problem

   !> Free a problem with all its data
   subroutine release_problem(problem)
      type(library_problem), pointer, intent(inout) :: problem

      call release_slot(problem%problem_slot)
      call problem%kept%release()
      call omp_destroy_lock(problem%lock)
      deallocate(problem)
      nullify(problem)
   end subroutine release_problem

   !> Begin a new sequence with the same settings, after a calculation that was abandoned for lack of memory
   !>
   !> Its results are in an undefined state; only their memory can be freed.
   subroutine abandon_results(problem)
      type(library_problem), intent(inout) :: problem

      problem%problem_slot = problem_slot()
      call free_left_blocks(problem%owner)
      problem%owner = new_owner()
      problem%coefficients = potential_contact()
      problem%has_result = .false.
      if (problem%module_number == 1) then
         call open_wheel_rail(problem%problem_slot)
         allocate(problem%wheel_rail_result%patches(0))
      else
         call open_contact(problem%problem_slot)
      end if
   end subroutine abandon_results

   !> Replace a problem by a new one after a setting that was abandoned for lack of memory, which leaves the settings in an
   !> undefined state
   !>
   !> The old one cannot be freed; it is overwritten up to the lock, for which other threads may be waiting.
   subroutine abandon_problem(problem)
      type(library_problem), pointer, intent(in) :: problem
      type(library_problem), pointer :: fresh
      integer(int8), pointer :: old(:), new(:)
      integer(c_intptr_t) :: length

      call problem%kept%release()
      fresh => new_problem(problem%ire, problem%icp, problem%module_number)
      length = transfer(c_loc(problem%lock), length) - transfer(c_loc(problem), length)
      call c_f_pointer(c_loc(problem), old, [length])
      call c_f_pointer(c_loc(fresh), new, [length])
      old = new
      call omp_destroy_lock(fresh%lock)
      call c_free(c_loc(fresh))
   end subroutine abandon_problem

   !> Set defaults of both modules
   subroutine set_common_defaults(digits, spec)
      type(case_digits), intent(inout) :: digits
      type(case_spec), intent(inout) :: spec

      digits%p = 2
      digits%t = 3
      digits%d = 2
      digits%c = 2
      digits%z = 2
      digits%g = 1
      digits%m2 = 0
      digits%w = 1
      digits%r = 1
      spec%kernel = kernel_model%piecewise_constant
      spec%pressure = pressure_model%full
      allocate(spec%friction%sets(1))
      spec%friction%sets = friction_set(sabsh1=10000.0_wp, sabsh2=10000.0_wp)
      ! value of the published interface, a million times the conductivity of steel
      spec%heat%lambda = 50.0e3_wp
      spec%heat%is_given = .true.
   end subroutine set_common_defaults

   !> Set defaults of module 3
   subroutine set_contact_defaults(spec)
      type(case_spec), intent(inout) :: spec

      associate (grid => spec%grid)
         grid%form = grid_form%corner_and_sides
         grid%mx = 1
         grid%my = 1
         grid%xl = -1.0_wp
         grid%yl = -1.0_wp
         grid%dx = 2.0_wp
         grid%dy = 2.0_wp
         grid%aa = 5.0_wp
         grid%bb = 5.0_wp
         grid%bneg = 5.0_wp
         grid%bpos = 5.0_wp
         grid%a1 = 0.001_wp
         grid%b1 = 0.001_wp
      end associate
      spec%geometry%b(1) = 1.0_wp
      spec%geometry%b(3) = 1.0_wp
   end subroutine set_contact_defaults

   !> Set defaults of module 1
   subroutine set_wheel_rail_defaults(digits, spec)
      type(case_digits), intent(inout) :: digits
      type(case_spec), intent(inout) :: spec

      digits%c1 = 1
      digits%z = 0
      allocate(spec%wheel_rail)
      spec%wheel_rail%track%nomradr = 0.0_wp
      spec%wheel_rail%rail_profile%zigzag = 150.0_wp*pi/180.0_wp
   end subroutine set_wheel_rail_defaults
end module contact_capi_problem
