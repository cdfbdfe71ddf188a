!> C interface: an experiment run by a host program, conversion between the two formats of input, description of an experiment in
!> words; see include/contact.h
module contact_capi_run
   use, intrinsic :: iso_c_binding, only : c_double, c_f_pointer, c_int, c_loc, c_null_ptr, c_ptr
   use contact_base_choices, only : heat_source
   use contact_base_error, only : error_kind, error_type, fatal_error, full_text
   use contact_base_guard, only : cause_text, do_guarded, guard_end
   use contact_base_kinds, only : long
   use contact_base_limits, only : case_limits, fill_limits
   use contact_capi_arguments, only : copy_text, first_failure, set_message, wrong_call
   use contact_capi_host, only : give_floats_back, hold_floats
   use contact_experiment_complete_cases, only : list_complete_cases
   use contact_experiment_convert, only : convert_experiment
   use contact_experiment_explain, only : explain_experiment
   use contact_experiment_run, only : run_experiment, run_settings
   use contact_text_buffer, only : text_buffer
   implicit none (type, external)
   private

   public :: contact_run_limited, contact_convert_experiment, contact_explain_experiment, contact_complete_cases

   !> Modes that a host may request, as in the header
   integer(c_int), parameter :: mode_run = 2, mode_check = 3
   !> Bits for additional files, for computing options and for a confined run, and all of them together
   integer, parameter :: json_bit = 0, hdf5_bit = 1, vtk_bit = 2, heat_bit = 3, angle_bit = 4, confine_bit = 5, classical_bit = 6
   integer, parameter :: order_bit = 7
   integer(c_int), parameter :: all_outputs = 255

   !> Tasks of a call
   integer, parameter :: to_run = 1, to_convert = 2, to_explain = 3, to_complete = 4

   !> A call
   type :: request_type
      !> Member of the tasks, of which to_run is the first
      integer :: task
      !> Names of the experiment and of the folder of its results, null-terminated; the latter may be null
      type(c_ptr) :: experiment, folder = c_null_ptr
      !> Arguments of contact_run_limited for runs
      integer(c_int) :: mode = mode_run, threads = 0, outputs = 0
      logical :: strict = .false.
      real(c_double) :: limits(3) = 0.0_c_double
      !> For to_convert: is an existing file replaced?
      logical :: overwrite = .false.
      !> Buffer of the text, null if not requested, its size, and the size required by the whole text
      type(c_ptr) :: text = c_null_ptr
      integer(c_int) :: length = 0, needed = 0
      integer(c_int) :: status = 0
   end type request_type

contains

   !> Run or check one experiment without output to the screen
   !>
   !> Returns 0 for success, 1 for a call with unusable arguments, 10 and above for a failure, by its error_kind.
   function contact_run_limited(experiment, mode, output_dir, threads, outputs, strict, seconds, megabytes, elements, message, &
      & message_length) result(status) bind(c, name="contact_run_limited")
      type(c_ptr), value :: experiment
      integer(c_int), value :: mode
      type(c_ptr), value :: output_dir
      integer(c_int), value :: threads, outputs, strict
      real(c_double), value :: seconds, megabytes, elements
      type(c_ptr), value :: message
      integer(c_int), value :: message_length
      integer(c_int) :: status
      type(request_type), target :: request

      request = request_type(to_run, experiment, output_dir, mode, threads, outputs, strict /= 0_c_int, &
         & [seconds, megabytes, elements], text=message, length=message_length)
      call do_request(request)
      status = request%status
   end function contact_run_limited

   !> Convert an experiment to the other format
   function contact_convert_experiment(experiment, output_dir, overwrite, message, message_length) result(status) &
      & bind(c, name="contact_convert_experiment")
      type(c_ptr), value :: experiment, output_dir
      integer(c_int), value :: overwrite
      type(c_ptr), value :: message
      integer(c_int), value :: message_length
      integer(c_int) :: status
      type(request_type), target :: request

      request = request_type(to_convert, experiment, output_dir, overwrite=overwrite /= 0_c_int, text=message, &
         & length=message_length)
      call do_request(request)
      status = request%status
   end function contact_convert_experiment

   !> Describe an experiment in words
   function contact_explain_experiment(experiment, text, text_length, needed) result(status) &
      & bind(c, name="contact_explain_experiment")
      type(c_ptr), value :: experiment, text
      integer(c_int), value :: text_length
      integer(c_int), intent(out), optional :: needed
      integer(c_int) :: status

      status = write_about(to_explain, experiment, text, text_length, needed)
   end function contact_explain_experiment

   !> Write all cases of an experiment with what they keep from earlier cases, in the readable format
   function contact_complete_cases(experiment, text, text_length, needed) result(status) bind(c, name="contact_complete_cases")
      type(c_ptr), value :: experiment, text
      integer(c_int), value :: text_length
      integer(c_int), intent(out), optional :: needed
      integer(c_int) :: status

      status = write_about(to_complete, experiment, text, text_length, needed)
   end function contact_complete_cases

   !> Do a task whose result is a text; arguments and result are those of `contact_explain_experiment`
   integer(c_int) function write_about(task, experiment, text, text_length, needed) result(status)
      !> to_explain or to_complete
      integer, intent(in) :: task
      type(c_ptr), intent(in) :: experiment, text
      integer(c_int), intent(in) :: text_length
      integer(c_int), intent(out), optional :: needed
      type(request_type), target :: request

      request = request_type(task, experiment, text=text, length=text_length)
      call do_request(request)
      if (present(needed)) needed = request%needed
      status = request%status
   end function write_about

   !> Do a task under the guard against lack of memory
   subroutine do_request(request)
      type(request_type), intent(inout), target :: request
      integer :: cause

      ! before the first comparison: a limit that is NaN must not stop a host that traps invalid operations
      call hold_floats()
      call do_guarded(do_inside, c_loc(request), 0, cause)
      if (cause /= guard_end%done) then
         request%status = first_failure + int(error_kind%memory, c_int)
         call do_guarded(report_want_of_memory, c_loc(request), 0, cause)
      end if
      call give_floats_back()
   end subroutine do_request

   !> Report why a task was abandoned
   subroutine report_want_of_memory(data) bind(c)
      !> A request_type
      type(c_ptr), value :: data
      type(request_type), pointer :: request

      call c_f_pointer(data, request)
      if (request%task == to_run) then
         call set_message(trim(cause_text(guard_end%no_memory)) // " for the run", request%text, request%length)
      else
         call set_message(trim(cause_text(guard_end%no_memory)), request%text, request%length)
      end if
   end subroutine report_want_of_memory

   !> Do a task
   recursive subroutine do_inside(data) bind(c)
      !> A request_type
      type(c_ptr), value :: data
      type(request_type), pointer :: request
      type(error_type), allocatable :: error
      type(text_buffer) :: answer
      character(len=:), allocatable :: experiment, folder, output, text

      call c_f_pointer(data, request)
      call copy_text(request%experiment, experiment)
      call copy_text(request%folder, folder)
      if (request%task == to_run) then
         call run(request, experiment, folder, error)
      else if (len_trim(experiment) == 0) then
         call fatal_error(error, "the name of the experiment is missing")
         request%status = wrong_call
      else if (request%task == to_explain) then
         call explain_experiment(experiment, answer, error)
      else if (request%task == to_complete) then
         call list_complete_cases(experiment, answer, error)
      else
         call convert_experiment(experiment, folder, request%overwrite, answer, output, error)
      end if
      if (allocated(error)) then
         call answer%add(full_text(error))
         if (request%task /= to_run) call answer%add(new_line("a"))
         if (request%status == 0) request%status = first_failure + int(error%kind, c_int)
      end if
      call answer%get(text)
      request%needed = int(len(text), c_int) + 1_c_int
      call set_message(text, request%text, request%length)
   end subroutine do_inside

   !> Run or check an experiment
   subroutine run(request, experiment, folder, error)
      type(request_type), intent(inout) :: request
      !> Paths, the latter "" for the folder of the input
      character(len=*), intent(in) :: experiment, folder
      type(error_type), allocatable, intent(out) :: error
      type(run_settings) :: settings

      settings%experiment = experiment
      settings%output_folder = folder
      settings%check_only = request%mode == mode_check
      settings%threads = int(request%threads)
      settings%strict = request%strict
      associate (outputs => request%outputs)
         if (btest(outputs, json_bit)) settings%exports%json = ""
         settings%exports%hdf5 = btest(outputs, hdf5_bit)
         settings%exports%vtk = btest(outputs, vtk_bit)
         if (btest(outputs, heat_bit)) settings%heat_source = heat_source%moving
         if (btest(outputs, angle_bit)) settings%angle_below_axle = .false.
         settings%classical = btest(outputs, classical_bit)
         if (btest(outputs, order_bit)) settings%order = 2
         settings%limits%confined = btest(outputs, confine_bit)
         if (len_trim(experiment) == 0) then
            call fatal_error(error, "contact_run: the name of the experiment is missing")
         else if (request%mode /= mode_run .and. request%mode /= mode_check) then
            call fatal_error(error, "contact_run: the mode is neither CONTACT_RUN nor CONTACT_CHECK")
         else if (request%threads < 0) then
            call fatal_error(error, "contact_run: the number of threads is negative")
         else if (outputs < 0 .or. outputs > all_outputs) then
            call fatal_error(error, "contact_run_with: the outputs are not a sum of CONTACT_WRITE_JSON, _HDF5, _VTK, " // &
               & "CONTACT_MOVING_HEAT, CONTACT_ANGLE_AT_CONTACT, CONTACT_CLASSICAL, CONTACT_SECOND_ORDER and CONTACT_CONFINE")
         else
            call set_limits(request%limits, settings%limits, error)
         end if
      end associate
      if (allocated(error)) then
         request%status = wrong_call
      else
         if (settings%limits%confined) call fill_limits(settings%limits, settings%run_deadline%seconds, settings%output_bytes)
         call run_experiment(settings, error)
      end if
   end subroutine run

   !> Set the limits given by the caller; the first invalid one is an error
   subroutine set_limits(values, limits, error)
      !> Time [s], memory [MB], number of elements; 0: unlimited
      real(c_double), intent(in) :: values(3)
      type(case_limits), intent(inout) :: limits
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: names(3) = [character(len=9) :: "seconds", "megabytes", "elements"]
      character(len=16) :: text
      integer :: k

      do k = 1, size(values)
         if (values(k) >= 0.0_c_double .and. values(k) < 1.0e12_c_double) cycle
         write(text, "(G0.6)") values(k)
         call fatal_error(error, "contact_run_limited: " // trim(names(k)) // " is " // trim(text) // &
            & ", not a limit from 0 to below 1e12; 0 means none")
         return
      end do
      if (values(1) > 0.0_c_double) limits%deadline%seconds = values(1)
      if (values(2) > 0.0_c_double) limits%bytes = int(1.0e6_c_double*values(2), long)
      if (values(3) > 0.0_c_double) limits%elements = int(values(3), long)
   end subroutine set_limits
end module contact_capi_run
