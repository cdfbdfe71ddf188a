!> The C interface: the two formats of input, and an experiment in words, see include/contact.h
module contact_capi_readable
   use, intrinsic :: iso_c_binding, only : c_f_pointer, c_int, c_loc, c_ptr
   use contact_base_error, only : error_kind, error_type, fatal_error, full_text
   use contact_base_guard, only : do_guarded, end_text, guard_end
   use contact_capi_arguments, only : give_message
   use contact_capi_host, only : give_floats_back, hold_floats
   use contact_capi_run, only : take_text
   use contact_experiment_convert, only : convert_experiment
   use contact_experiment_explain, only : explain_experiment
   use contact_text_buffer, only : text_buffer
   implicit none (type, external)
   private

   public :: contact_convert_experiment, contact_explain_experiment

   !> Failures by their cause start here, as those of contact_run
   integer(c_int), parameter :: wrong_call = 1, first_failure = 10

   !> A call
   type :: text_request
      type(c_ptr) :: experiment, folder
      !> Explain it? Otherwise convert it
      logical :: explains = .false.
      logical :: overwrite = .false.
      type(c_ptr) :: text
      integer(c_int) :: length = 0, needed = 0
      integer(c_int) :: status = 0
   end type text_request

contains

   !> Write an experiment in the other format
   function contact_convert_experiment(experiment, output_dir, overwrite, message, message_length) result(status) &
      & bind(c, name="contact_convert_experiment")
      !> Path of the experiment, folder of the new file, null-terminated; the folder may be null
      type(c_ptr), value :: experiment, output_dir
      !> Not 0: replace a file that is there
      integer(c_int), value :: overwrite
      !> Buffer of what is told, null if not wanted, and its size
      type(c_ptr), value :: message
      integer(c_int), value :: message_length
      integer(c_int) :: status
      type(text_request), target :: request

      request%experiment = experiment
      request%folder = output_dir
      request%overwrite = overwrite /= 0_c_int
      request%text = message
      request%length = message_length
      call do_request(request)
      status = request%status
   end function contact_convert_experiment

   !> Tell an experiment in words
   function contact_explain_experiment(experiment, text, text_length, needed) result(status) &
      & bind(c, name="contact_explain_experiment")
      !> Path of the experiment, null-terminated
      type(c_ptr), value :: experiment
      !> Buffer of the words, null if not wanted, and its size
      type(c_ptr), value :: text
      integer(c_int), value :: text_length
      !> Size that the whole text needs
      integer(c_int), intent(out), optional :: needed
      integer(c_int) :: status
      type(text_request), target :: request

      request%experiment = experiment
      request%folder = experiment
      request%explains = .true.
      request%text = text
      request%length = text_length
      call do_request(request)
      if (present(needed)) needed = request%needed
      status = request%status
   end function contact_explain_experiment

   !> Do it, and survive want of memory
   subroutine do_request(request)
      type(text_request), intent(inout), target :: request
      integer :: cause

      call hold_floats()
      call do_guarded(do_inside, c_loc(request), 0, cause)
      call give_floats_back()
      if (cause == guard_end%done) return
      request%status = first_failure + int(error_kind%memory, c_int)
      call give_message(trim(end_text(guard_end%no_memory)), request%text, request%length)
   end subroutine do_request

   !> The work itself
   recursive subroutine do_inside(data) bind(c)
      !> A text_request
      type(c_ptr), value :: data
      type(text_request), pointer :: request
      type(error_type), allocatable :: error
      type(text_buffer) :: told
      character(len=:), allocatable :: experiment, folder, output, text

      call c_f_pointer(data, request)
      call take_text(request%experiment, experiment)
      if (len_trim(experiment) == 0) then
         call fatal_error(error, "the name of the experiment is missing")
         request%status = wrong_call
      else if (request%explains) then
         call explain_experiment(experiment, told, error)
      else
         call take_text(request%folder, folder)
         call convert_experiment(experiment, folder, request%overwrite, told, output, error)
      end if
      if (allocated(error)) then
         call told%add_line(full_text(error))
         if (request%status == 0) request%status = first_failure + int(error%kind, c_int)
      end if
      call told%get(text)
      request%needed = int(len(text), c_int) + 1_c_int
      call give_message(text, request%text, request%length)
   end subroutine do_inside
end module contact_capi_readable
