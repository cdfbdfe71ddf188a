!> The C interface: an experiment run by a host program, see include/contact.h
module contact_capi_run
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_double, c_f_pointer, c_int, c_loc, c_ptr, c_size_t
   use contact_base_choices, only : heat_source
   use contact_base_error, only : error_kind, error_type, fatal_error, full_text
   use contact_base_guard, only : do_guarded, end_text, guard_end
   use contact_base_kinds, only : long
   use contact_base_limits, only : case_limits, fill_limits
   use contact_capi_arguments, only : give_message
   use contact_capi_host, only : give_floats_back, hold_floats
   use contact_experiment_run, only : run_experiment, run_settings
   implicit none (type, external)
   private

   public :: contact_run, contact_run_limited, contact_run_with, take_text

   !> What a host may ask for, as in the header
   integer(c_int), parameter :: mode_run = 2, mode_check = 3
   !> Bits that ask for more files, for other ways to compute, for a confined run, and all of them together
   integer, parameter :: json_bit = 0, hdf5_bit = 1, vtk_bit = 2, heat_bit = 3, angle_bit = 4, confine_bit = 5
   integer(c_int), parameter :: all_outputs = 63
   !> Failures by their cause start here, so that 1 stays free for a wrong call
   integer(c_int), parameter :: wrong_call = 1, first_failure = 10

   !> A call of contact_run_limited
   type :: run_request
      type(c_ptr) :: experiment
      integer(c_int) :: mode
      type(c_ptr) :: output_dir
      integer(c_int) :: threads, outputs, strict
      real(c_double) :: seconds, megabytes, elements
      type(c_ptr) :: message
      integer(c_int) :: message_length
      integer(c_int) :: status = 0
   end type run_request

   interface
      !> Length of a null-terminated text
      function c_strlen(text) result(length) bind(c, name="strlen")
         import :: c_ptr, c_size_t
         type(c_ptr), value :: text
         integer(c_size_t) :: length
      end function c_strlen
   end interface

contains

   !> Run or check one experiment silently, with the usual files
   function contact_run(experiment, mode, output_dir, threads, message, message_length) result(status) &
      & bind(c, name="contact_run")
      !> As for contact_run_with
      type(c_ptr), value :: experiment
      integer(c_int), value :: mode
      type(c_ptr), value :: output_dir
      integer(c_int), value :: threads
      type(c_ptr), value :: message
      integer(c_int), value :: message_length
      integer(c_int) :: status

      status = contact_run_with(experiment, mode, output_dir, threads, 0_c_int, message, message_length)
   end function contact_run

   !> Run or check one experiment silently, without limits
   function contact_run_with(experiment, mode, output_dir, threads, outputs, message, message_length) result(status) &
      & bind(c, name="contact_run_with")
      !> As for contact_run_limited
      type(c_ptr), value :: experiment
      integer(c_int), value :: mode
      type(c_ptr), value :: output_dir
      integer(c_int), value :: threads
      integer(c_int), value :: outputs
      type(c_ptr), value :: message
      integer(c_int), value :: message_length
      integer(c_int) :: status

      status = contact_run_limited(experiment, mode, output_dir, threads, outputs, 0_c_int, 0.0_c_double, 0.0_c_double, &
         & 0.0_c_double, message, message_length)
   end function contact_run_with

   !> Run or check one experiment silently
   !>
   !> 0 is success, 1 a call with unusable arguments, 10 and above a failure by its error_kind.
   function contact_run_limited(experiment, mode, output_dir, threads, outputs, strict, seconds, megabytes, elements, message, &
      & message_length) result(status) bind(c, name="contact_run_limited")
      !> Path of the experiment, null-terminated
      type(c_ptr), value :: experiment
      integer(c_int), value :: mode
      !> Folder of the results, null-terminated; null or empty for that of the input
      type(c_ptr), value :: output_dir
      !> Number of threads, 0 for the default
      integer(c_int), value :: threads
      !> Files beside the usual ones and ways to compute, a sum of bits as in the header
      integer(c_int), value :: outputs
      !> Not 0: a case that does not converge is a failure
      integer(c_int), value :: strict
      !> Limits of each case: time [s], memory [MB], number of elements; 0 for none
      real(c_double), value :: seconds, megabytes, elements
      !> Buffer of the reason of a failure, null if not wanted, and its size
      type(c_ptr), value :: message
      integer(c_int), value :: message_length
      integer(c_int) :: status
      type(run_request), target :: request
      integer :: cause

      request = run_request(experiment, mode, output_dir, threads, outputs, strict, seconds, megabytes, elements, message, &
         & message_length)
      call do_guarded(run_request_inside, c_loc(request), 0, cause)
      status = request%status
      if (cause == guard_end%done) return
      call give_floats_back()
      status = first_failure + int(error_kind%memory, c_int)
      call do_guarded(tell_want_of_memory, c_loc(request), 0, cause)
   end function contact_run_limited

   !> Why a run was left
   subroutine tell_want_of_memory(data) bind(c)
      !> A run_request
      type(c_ptr), value :: data
      type(run_request), pointer :: request

      call c_f_pointer(data, request)
      call give_message(trim(end_text(guard_end%no_memory)) // " for the run", request%message, request%message_length)
   end subroutine tell_want_of_memory

   !> Run what a request says
   subroutine run_request_inside(data) bind(c)
      !> A run_request
      type(c_ptr), value :: data
      type(run_request), pointer :: request

      call c_f_pointer(data, request)
      associate (r => request)
         call run_unguarded(r%experiment, r%mode, r%output_dir, r%threads, r%outputs, r%strict, r%seconds, r%megabytes, &
            & r%elements, r%message, r%message_length, r%status)
      end associate
   end subroutine run_request_inside

   !> The run itself
   subroutine run_unguarded(experiment, mode, output_dir, threads, outputs, strict, seconds, megabytes, elements, message, &
      & message_length, status)
      !> As for contact_run_limited
      type(c_ptr), intent(in) :: experiment, output_dir, message
      integer(c_int), intent(in) :: mode, threads, outputs, strict, message_length
      real(c_double), intent(in) :: seconds, megabytes, elements
      integer(c_int), intent(out) :: status
      type(run_settings) :: settings
      type(error_type), allocatable :: error

      ! before the first comparison: a limit that is not a number must not stop a host that traps invalid operations
      call hold_floats()
      call take_text(experiment, settings%experiment)
      call take_text(output_dir, settings%output_folder)
      settings%check_only = mode == mode_check
      settings%threads = int(threads)
      settings%strict = strict /= 0_c_int
      if (btest(outputs, json_bit)) settings%exports%json = ""
      settings%exports%hdf5 = btest(outputs, hdf5_bit)
      settings%exports%vtk = btest(outputs, vtk_bit)
      if (btest(outputs, heat_bit)) settings%heat_source = heat_source%moving
      if (btest(outputs, angle_bit)) settings%angle_below_axle = .false.
      settings%limits%confined = btest(outputs, confine_bit)
      if (len_trim(settings%experiment) == 0) then
         call fatal_error(error, "contact_run: the name of the experiment is missing")
      else if (mode /= mode_run .and. mode /= mode_check) then
         call fatal_error(error, "contact_run: the mode is neither CONTACT_RUN nor CONTACT_CHECK")
      else if (threads < 0) then
         call fatal_error(error, "contact_run: the number of threads is negative")
      else if (outputs < 0 .or. outputs > all_outputs) then
         call fatal_error(error, "contact_run_with: the outputs are not a sum of CONTACT_WRITE_JSON, _HDF5, _VTK, " // &
            & "CONTACT_MOVING_HEAT, CONTACT_ANGLE_AT_CONTACT and CONTACT_CONFINE")
      else
         call set_limits(settings%limits, error)
      end if
      if (settings%limits%confined) call fill_limits(settings%limits, settings%run_deadline%seconds, settings%output_bytes)
      status = 0
      if (allocated(error)) then
         status = wrong_call
      else
         call run_experiment(settings, error)
         if (allocated(error)) status = first_failure + int(error%kind, c_int)
      end if
      if (allocated(error)) then
         call give_message(full_text(error), message, message_length)
      else
         call give_message("", message, message_length)
      end if
      call give_floats_back()

   contains

      !> The limits of the caller, or an error about the first that cannot be one
      subroutine set_limits(limits, problem)
         type(case_limits), intent(inout) :: limits
         type(error_type), allocatable, intent(out) :: problem
         character(len=*), parameter :: names(3) = [character(len=9) :: "seconds", "megabytes", "elements"]
         real(c_double) :: asked(3)
         character(len=16) :: text
         integer :: k

         asked = [seconds, megabytes, elements]
         do k = 1, size(asked)
            if (asked(k) >= 0.0_c_double .and. asked(k) < 1.0e12_c_double) cycle
            write(text, "(G0.6)") asked(k)
            call fatal_error(problem, "contact_run_limited: " // trim(names(k)) // " is " // trim(text) // &
               & ", not a limit from 0 to below 1e12; 0 stands for none")
            return
         end do
         if (seconds > 0.0_c_double) limits%deadline%seconds = seconds
         if (megabytes > 0.0_c_double) limits%bytes = int(1.0e6_c_double*megabytes, long)
         if (elements > 0.0_c_double) limits%elements = int(elements, long)
      end subroutine set_limits
   end subroutine run_unguarded

   !> A null-terminated text as a Fortran one, "" for a null pointer
   subroutine take_text(pointer, text)
      type(c_ptr), intent(in) :: pointer
      character(len=:), allocatable, intent(out) :: text
      character(kind=c_char), pointer :: letters(:)
      integer :: i

      text = ""
      if (.not. c_associated(pointer)) return
      call c_f_pointer(pointer, letters, [c_strlen(pointer)])
      text = repeat(" ", size(letters))
      do i = 1, size(letters)
         text(i:i) = letters(i)
      end do
   end subroutine take_text
end module contact_capi_run
