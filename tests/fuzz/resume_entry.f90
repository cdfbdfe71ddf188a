!> For resume.c: a run as by the program, with and without --resume, and the hash of a line of its journal
module contact_fuzz_resume_entry
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_loc, c_long
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : long
   use contact_capi_arguments, only : set_message
   use contact_experiment_run, only : run_experiment, run_settings
   use contact_text_file_text, only : add_to_hash, empty_hash
   implicit none (type, external)
   private

   public :: fuzz_hash, fuzz_run

contains

   !> Run the experiment fuzz with all files, under limits that keep a case within milliseconds; 0, or 1 with a message
   integer(c_int) function fuzz_run(resume, message, length) bind(c)
      !> Not 0: continue the interrupted run
      integer(c_int), value :: resume
      !> Buffer and its size
      integer(c_int), value :: length
      character(kind=c_char), target, intent(inout) :: message(length)
      type(run_settings) :: settings
      type(error_type), allocatable :: error

      settings%experiment = "fuzz"
      settings%exports%json = ""
      settings%exports%hdf5 = .true.
      settings%exports%vtk = .true.
      settings%resume = resume /= 0
      settings%threads = 1
      settings%limits%deadline%seconds = 0.5
      settings%limits%bytes = 200000000_long
      settings%limits%elements = 2500_long
      call run_experiment(settings, error)
      fuzz_run = merge(1_c_int, 0_c_int, allocated(error))
      if (allocated(error)) then
         call set_message(full_text(error), c_loc(message), length)
      else
         call set_message("", c_loc(message), length)
      end if
   end function fuzz_run

   !> Hash of a line
   integer(c_long) function fuzz_hash(line, length) bind(c)
      !> Letters and their number
      integer(c_int), value :: length
      character(kind=c_char), intent(in) :: line(length)
      integer(long) :: hash
      integer :: k

      hash = empty_hash
      do k = 1, length
         call add_to_hash(line(k), hash)
      end do
      fuzz_hash = int(hash, c_long)
   end function fuzz_hash
end module contact_fuzz_resume_entry
