!> Result files of a run: opened or continued, kept current, completed and closed
module contact_experiment_result_files
   use omp_lib, only : omp_get_max_threads
   use contact_base_case_status, only : case_state
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_base_limits, only : wall_clock
   use contact_base_output_file, only : remove_file
   use contact_base_system, only : is_same_file
   use contact_experiment_errors, only : report_error, report_final_error
   use contact_experiment_exports, only : number_of_exports
   use contact_experiment_journal, only : journal_name
   use contact_experiment_place, only : written_in_place
   use contact_experiment_resume, only : resume_point, settings_of
   use contact_experiment_state, only : counted, experiment_state, run_settings
   use contact_input_experiment_file, only : experiment_reader, input_case
   use contact_output_case_record, only : planned_text
   use contact_output_finished_file, only : close_result, open_result, open_result_again
   use contact_output_report, only : timer_line, write_banner, write_closing, write_end
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: close_all_files, keep_files_current, open_all_files

contains

   !> Open the files of a run, or continue existing ones
   subroutine open_all_files(state, requested, point, done)
      type(experiment_state), intent(inout) :: state
      type(run_settings), intent(in) :: requested
      !> Where an earlier run ended, if it is continued
      type(resume_point), intent(in) :: point
      !> Are all files open? If not, the error was reported
      logical, intent(out) :: done
      type(error_type), allocatable :: error
      character(len=:), allocatable :: version

      call check_input_is_apart(state, error)
      done = .not. allocated(error)
      if (.not. done) then
         call report_final_error(state, error)
         return
      end if
      version = ""
      if (allocated(requested%version)) version = requested%version
      if (point%active) then
         call open_result_again(state%log%out, state%place%results // ".out", point%at%out, error, state%limits)
      else
         ! a journal of an earlier run does not describe what is written now
         call remove_file(journal_name(state%place%results))
         call open_out_file(state, error)
      end if
      if (.not. allocated(error)) then
         ! counting the cases requires reading the complete input; for few and quick results it is postponed until the number is
         ! needed
         if (requested%progress .or. requested%exports%any()) call count_planned(state)
         if (point%active) then
            call state%exports%open_files(requested%exports, state%place, version, state%run, state%limits, error, point%at)
         else
            call state%exports%open_files(requested%exports, state%place, version, state%run, state%limits, error)
         end if
      end if
      done = .not. allocated(error)
      if (allocated(error)) then
         call report_final_error(state, error)
         return
      end if
      if (point%active) then
         call state%journal%resume(state%place%results, point%place, point%at, state%limits%confined)
         return
      end if
      state%silent = .not. state%exports%has_any()
      call write_banner(state%log, requested%version)
      if (allocated(state%lock%doubt)) call state%log%warning(state%lock%doubt)
      call state%journal%start(state%place%results, settings_of(requested), state%limits%confined)
   end subroutine open_all_files

   !> Refuse results that would overwrite the input, to which a link in their place leads
   !>
   !> Other results have a temporary name first, and replace a link.
   subroutine check_input_is_apart(state, error)
      type(experiment_state), intent(in) :: state
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: name
      integer :: k

      do k = 0, size(written_in_place)
         name = journal_name(state%place%results)
         if (k > 0) name = state%place%results // trim(written_in_place(max(1, k)))
         if (is_same_file(name, state%place%input)) then
            call fatal_error(error, "the file cannot be written: it is a link to the input " // state%place%input, &
               & error_kind%file, name)
            return
         end if
      end do
   end subroutine check_input_is_apart

   !> Flush the output to the system, so that it survives this process; in a run with a size limit determine the size of the
   !> HDF5 file
   subroutine keep_files_current(state)
      type(experiment_state), intent(inout) :: state
      !> Computing time that a killed run may lose [s]
      real(wp), parameter :: interval = 0.002_wp
      logical :: ignored

      call state%log%out%flush_now()
      if (wall_clock() - state%last_save >= interval) then
         call state%journal%save_line()
         state%last_save = wall_clock()
      end if
      if (.not. associated(state%limits%output) .or. .not. allocated(state%exports%hdf5)) return
      associate (bytes => state%exports%hdf5%bytes_so_far())
         if (bytes > state%hdf5_bytes) ignored = state%limits%output%take(bytes - state%hdf5_bytes)
         state%hdf5_bytes = max(bytes, state%hdf5_bytes)
      end associate
   end subroutine keep_files_current

   !> Record the progress of the run in all files, and close them
   subroutine close_all_files(state)
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable :: error
      integer :: errors, k

      call state%progress%hide()
      call require_planned(state)
      errors = state%errors
      do k = 1, number_of_exports
         call state%exports%close_file(k, state%run, error)
         if (allocated(error)) call report_error(state, error)
      end do
      call close_out_file(state)
      ! files that could not be completed may be completed when there is disk space again
      call state%journal%finish(state%run%is_complete() .and. state%errors == errors)
   end subroutine close_all_files

   !> Count the cases in the input, as far as it can be read
   subroutine count_planned(state)
      type(experiment_state), intent(inout) :: state
      type(experiment_reader) :: reader
      type(input_case) :: this
      type(error_type), allocatable :: error

      state%run%planned = 0
      reader = state%reader
      call reader%rewind()
      do while (.not. allocated(error))
         call reader%next_case(this, error)
         if (allocated(error)) exit
         if (this%module_number == 0) return
         state%run%planned = state%run%planned + 1
      end do
      ! the error belongs to another case
      state%run%planned = state%run%planned + 1
      state%run%readable = .false.
   end subroutine count_planned

   !> Number of planned cases, if not yet counted
   subroutine require_planned(state)
      type(experiment_state), intent(inout) :: state

      if (state%run%planned > 0) return
      state%run%planned = state%run%finished
      if (allocated(state%run%reason)) call count_planned(state)
   end subroutine require_planned

   !> Open the .out file of the run
   subroutine open_out_file(state, error)
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable, intent(out) :: error

      call open_result(state%log%out, state%place%results // ".out", state%place%results // ".out", error, state%limits)
   end subroutine open_out_file

   !> Write timers and closing lines, and close the .out file
   subroutine close_out_file(state)
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable :: error
      type(timer_line) :: lines(4)

      ! the closing lines are always written
      call state%log%out%charge_to(null())
      call state%total%halt()
      call state%total%fill_line("Total", lines(1))
      call state%reading%fill_line("Reading input", lines(2))
      call state%solving%fill_line("Solving cases", lines(3))
      call state%writing%fill_line("Writing results", lines(4))
      call write_end(state%log, omp_get_max_threads(), lines)
      call state%log%line(" " // counted(state%cases, "case") // ": " // &
         & integer_text(state%run%ended(case_state%solved)) // " solved, " // &
         & integer_text(state%run%ended(case_state%not_converged)) // " not converged, " // &
         & integer_text(state%run%ended(case_state%refused)) // " refused")
      if (.not. state%run%is_complete()) call state%log%line(" Not complete: " // trim(planned_text(state%run)) // " finished")
      if (state%silent .and. state%cases > 0) call state%log%line( &
         & " No results were requested: O, A and S are 0 in all cases.")
      call write_closing(state%log, state%errors > 0)
      call close_result(state%log%out, state%place%results // ".out", error)
      if (allocated(error)) call report_error(state, error)
   end subroutine close_out_file
end module contact_experiment_result_files
