!> Entries for calculations
module contact_capi_calculate
   use, intrinsic :: iso_c_binding, only : c_int
   use contact_base_case_status, only : case_status
   use contact_base_error, only : error_type, fatal_error, full_text
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_capi_arguments, only : integer_of, set_argument
   use contact_capi_calculate1, only : check_data, finish_wheel_rail, solve_wheel_rail
   use contact_capi_calculate3, only : finish_contact, solve_contact
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : report_error, first_refusal, keep_status, library_log, log_message
   use contact_capi_motion, only : settle_motion
   use contact_capi_problem, only : library_problem, max_patches
   use contact_capi_registry, only : enter_calculation, leave_calculation, scope, scope_type
   use contact_control_digits, only : case_digits
   use contact_control_library_codes, only : code_text, library_code
   use contact_control_translation, only : apply_digits
   implicit none (type, external)
   private

   public :: cntc_calculate, cntc_calculate1, cntc_calculate3

contains

   !> Solve the case of the current settings: a contact problem, or wheel and rail as a whole
   subroutine cntc_calculate(ire, icp, ierror) bind(c, name="inside_cntc_calculate")
      integer(c_int), intent(in), optional :: ire, icp
      integer(c_int), intent(inout), optional :: ierror

      call calculate(entry_type("cntc_calculate", integer_of(ire), integer_of(icp)), scope%settings, ierror)
   end subroutine cntc_calculate

   !> The same for wheel and rail only
   subroutine cntc_calculate1(ire, ierror) bind(c, name="inside_cntc_calculate1")
      integer(c_int), intent(in), optional :: ire
      integer(c_int), intent(inout), optional :: ierror

      call calculate(entry_type("cntc_calculate1", integer_of(ire)), scope%wheel_rail, ierror)
   end subroutine cntc_calculate1

   !> The same for contact problems only
   subroutine cntc_calculate3(ire, icp, ierror) bind(c, name="inside_cntc_calculate3")
      integer(c_int), intent(in), optional :: ire, icp
      integer(c_int), intent(inout), optional :: ierror

      call calculate(entry_type("cntc_calculate3", integer_of(ire), integer_of(icp)), scope%contact, ierror)
   end subroutine cntc_calculate3

   !> Find the problem, solve it with the allowed number of threads, and report the outcome
   subroutine calculate(this, allowed, ierror)
      type(entry_type), intent(in) :: this
      type(scope_type), intent(in) :: allowed
      integer(c_int), intent(inout), optional :: ierror
      type(library_problem), pointer :: problem
      real(wp) :: cpu, wall
      integer :: code

      call enter_calculation(this, allowed, problem, code)
      if (associated(problem)) then
         call log_message(1, this, "calculating...")
         cpu = problem%watch%cpu
         wall = problem%watch%wall
         call problem%watch%start()
         call problem%total%start()
         call calculate_case(this, problem, code)
         call problem%total%halt()
         call problem%watch%halt()
         if (problem%module_number == 1) call book_patches(problem, problem%watch%cpu - cpu, problem%watch%wall - wall)
         if (code > 0) call log_message(1, this, trim(code_text(code)))
         call log_message(1, this, "done...")
         call leave_calculation(problem)
      end if
      call set_argument(code, ierror)
   end subroutine calculate

   !> Calculate one case: check that the settings are complete and compatible, solve it, report the outcome
   subroutine calculate_case(this, problem, code)
      type(entry_type), intent(in) :: this
      type(library_problem), intent(inout) :: problem
      !> Member of library_code, or in module 3 the number of elements in contact at the border of the grid
      integer, intent(out) :: code
      type(error_type), allocatable :: error
      type(case_digits) :: digits
      type(case_status) :: status
      type(log_type) :: log
      integer :: k

      k = first_refusal(problem, "cntc_set")
      if (k > 0) then
         code = problem%refused(k)%code
         call fatal_error(error, "a setting was refused and not made again: " // problem%refused(k)%reason)
      else
         log = library_log()
         problem%cases = problem%cases + 1
         if (problem%module_number == 1) call check_data(problem, code, error)
      end if
      if (.not. allocated(error)) then
         code = library_code%other
         call settle_motion(this, problem, error)
      end if
      if (.not. allocated(error)) then
         call choose(this, problem, digits)
         if (problem%module_number == 1) then
            call solve_wheel_rail(this, problem, digits, log, code, error)
         else
            call solve_contact(problem, digits, log, code, error)
         end if
      end if
      if (allocated(error)) then
         call log%translate_choices(error)
         call status%refuse(full_text(error))
         call report_error(this, full_text(error), code)
      else if (problem%module_number == 1) then
         call finish_wheel_rail(this, problem, log, status, code)
      else
         call finish_contact(this, problem, log, status, code)
      end if
      if (.not. allocated(error) .and. problem%spec%solve) then
         problem%bodies%material = problem%spec%material
         problem%bodies%kernel = problem%spec%kernel
         problem%bodies%material_model = problem%spec%material_model
         problem%bodies%motion = problem%spec%motion
         if (problem%module_number == 1) then
            problem%bodies%left = problem%spec%wheel_rail%left
            problem%bodies%roller = problem%spec%wheel_rail%roller
            problem%bodies%radii = [problem%spec%wheel_rail%wheelset%nomradw, problem%spec%wheel_rail%track%nomradr]
            if (.not. problem%bodies%roller) problem%bodies%radii(2) = 0.0_wp
         end if
      end if
      call keep_status(problem, status)
   end subroutine calculate_case

   !> Prepare the input of the case: convert digits to choices, and use stored values; a first case does not continue another one
   subroutine choose(this, problem, digits)
      type(entry_type), intent(in) :: this
      type(library_problem), intent(inout) :: problem
      !> Effective digits
      type(case_digits), intent(out) :: digits

      digits = problem%digits
      if (.not. problem%has_result) then
         if (digits%p /= 2) call log_message(1, this, "the first case starts a new sequence, P = 2")
         digits%p = 2
         digits%i = 0
      end if
      problem%spec%kinematics = problem%stored%kinematics
      problem%spec%rolling = problem%stored%rolling
      if (problem%module_number == 1) problem%spec%wheel_rail%wheelset = problem%stored%wheelset
      call apply_digits(digits, problem%module_number, problem%spec)
   end subroutine choose

   !> Distribute the time of wheel and rail over its patches, in proportion to their numbers of elements
   subroutine book_patches(problem, cpu, wall)
      type(library_problem), intent(inout) :: problem
      !> Processor and elapsed time of the calculation [s]
      real(wp), intent(in) :: cpu, wall
      real(wp) :: share(max_patches)
      integer :: k, n

      n = min(max_patches, size(problem%wheel_rail_result%patches))
      if (n == 0) return
      do k = 1, n
         share(k) = real(problem%wheel_rail_result%patches(k)%contact%grid%npot(), wp)
      end do
      share(:n) = share(:n)/max(1.0_wp, sum(share(:n)))
      problem%patch_cpu(:n) = problem%patch_cpu(:n) + share(:n)*cpu
      problem%patch_wall(:n) = problem%patch_wall(:n) + share(:n)*wall
   end subroutine book_patches
end module contact_capi_calculate
