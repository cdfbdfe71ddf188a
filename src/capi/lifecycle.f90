!> Entries for the library as a whole: initialisation, global flags, threads, finalisation
!>
!> They are refused inside parallel regions of OpenMP.
module contact_capi_lifecycle
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_ptr
   use omp_lib, only : omp_in_parallel
   use contact_base_case_status, only : case_state, case_status
   use contact_capi_arguments, only : integer_of, integers_of, path_of, set_argument, set_message
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : report_error, stored_error, last_status, log_message, set_debugging
   use contact_capi_registry, only : is_running, max_threads, record_units, register_element, remove_element, set_threads, &
      & start_library, stop_library
   use contact_control_flags, only : flag
   use contact_control_library_codes, only : code_text, interface_version, library_code
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: cntc_setfileunits, cntc_initializefirst, cntc_initializefirst_new, cntc_initialize, cntc_setglobalflags
   public :: cntc_getmaxnumthreads, cntc_finalize, cntc_finalizelast, contact_case_status, contact_last_error, set_global_flag

contains

   !> Specify unit numbers that files may use; before initialisation only, and not needed
   subroutine cntc_setfileunits(nunits, iunits) bind(c, name="inside_cntc_setfileunits")
      integer(c_int), intent(in), optional :: nunits, iunits(*)
      type(entry_type) :: this
      logical :: accepted

      this%name = "cntc_setFileUnits"
      call record_units(accepted)
      if (.not. accepted) call report_error(this, "file units can be given before initialisation only, and once")
      if (accepted .and. size(integers_of(nunits, iunits)) == 0) call log_message(1, this, "no file unit is given")
   end subroutine cntc_setfileunits

   !> Initialise the library: working folder, folder of results, name of the experiment
   subroutine cntc_initializefirst(ifcver, ierror, ioutput, c_wrkdir, c_outdir, c_expnam, len_wrkdir, len_outdir, &
      & len_expnam) bind(c, name="inside_cntc_initializefirst")
      integer(c_int), intent(inout), optional :: ifcver, ierror
      integer(c_int), intent(in), optional :: ioutput, len_wrkdir, len_outdir, len_expnam
      character(kind=c_char), intent(in), optional :: c_wrkdir(*), c_outdir(*), c_expnam(*)
      type(entry_type) :: this
      logical :: started

      this%name = "cntc_initializeFirst"
      if (is_parallel(this)) return
      call start_library(trim(path_of(c_wrkdir, len_wrkdir)), trim(path_of(c_outdir, len_outdir)), &
         & trim(path_of(c_expnam, len_expnam)), integer_of(ioutput) == 1, started)
      call set_argument(interface_version, ifcver)
      call set_argument(library_code%success, ierror)
   end subroutine cntc_initializefirst

   !> The same under its name in an earlier release
   subroutine cntc_initializefirst_new(ifcver, ierror, ioutput, c_wrkdir, c_outdir, c_expnam, len_wrkdir, len_outdir, &
      & len_expnam) bind(c, name="inside_cntc_initializefirst_new")
      integer(c_int), intent(inout), optional :: ifcver, ierror
      integer(c_int), intent(in), optional :: ioutput, len_wrkdir, len_outdir, len_expnam
      character(kind=c_char), intent(in), optional :: c_wrkdir(*), c_outdir(*), c_expnam(*)
      type(entry_type) :: this

      call cntc_initializefirst(ifcver, ierror, ioutput, c_wrkdir, c_outdir, c_expnam, len_wrkdir, len_outdir, len_expnam)
      this%name = "cntc_initializeFirst_new"
      call log_message(0, this, "the same as cntc_initializeFirst")
   end subroutine cntc_initializefirst_new

   !> Create a result element of module 1 or 3; initialises the library if needed
   subroutine cntc_initialize(ire, imodul, ifcver, ierror, c_outdir, len_outdir) bind(c, name="inside_cntc_initialize")
      integer(c_int), intent(in), optional :: ire, imodul, len_outdir
      integer(c_int), intent(inout), optional :: ifcver, ierror
      character(kind=c_char), intent(in), optional :: c_outdir(*)
      type(entry_type) :: this
      integer :: code
      logical :: started, was_active

      this = entry_type("cntc_initialize", integer_of(ire))
      if (is_parallel(this)) return
      call start_library("", trim(path_of(c_outdir, len_outdir)), "", .false., started)
      call set_argument(interface_version, ifcver)
      was_active = .false.
      if (integer_of(imodul) == 1 .or. integer_of(imodul) == 3) then
         call register_element(this%ire, integer_of(imodul), code, was_active)
         if (code /= library_code%success) call report_error(this, trim(code_text(code)), code)
         ! the published interface returns this code for a number that is out of range
         if (code == library_code%bad_element) code = library_code%no_patch
      else
         code = library_code%other
         call report_error(this, "the module must be 1, wheel and rail, or 3, a contact problem", code)
      end if
      if (was_active) call report_error(this, "the result element is active already, nothing is changed", library_code%success)
      call set_argument(code, ierror)
   end subroutine cntc_initialize

   !> Set flags of the library as a whole
   subroutine cntc_setglobalflags(lenflg, params, values) bind(c, name="inside_cntc_setglobalflags")
      integer(c_int), intent(in), optional :: lenflg, params(*), values(*)
      type(entry_type) :: this
      integer, allocatable :: codes(:), numbers(:)
      integer :: k

      this%name = "cntc_setGlobalFlags"
      if (is_parallel(this)) return
      codes = integers_of(lenflg, params)
      numbers = integers_of(lenflg, values)
      do k = 1, min(size(codes), size(numbers))
         if (codes(k) == 0) cycle
         if (any(codes(k) == [flag%idebug, flag%licdbg, flag%openmp])) then
            call set_global_flag(codes(k), numbers(k))
         else if (is_running()) then
            call report_error(this, "the flag " // integer_text(codes(k)) // " is not one of the library as a whole")
         end if
      end do
   end subroutine cntc_setglobalflags

   !> Set one flag of the library as a whole; others are ignored
   subroutine set_global_flag(code, number)
      !> Member of `flag`, and its value
      integer, intent(in) :: code, number

      if (code == flag%idebug) call set_debugging(number)
      if (code == flag%openmp) call set_threads(number)
   end subroutine set_global_flag

   !> Maximum number of simultaneous calculations
   subroutine cntc_getmaxnumthreads(mxthrd) bind(c, name="inside_cntc_getmaxnumthreads")
      integer(c_int), intent(inout), optional :: mxthrd

      call set_argument(max_threads(), mxthrd)
   end subroutine cntc_getmaxnumthreads

   !> Free a result element; the run ends with the last one
   subroutine cntc_finalize(ire) bind(c, name="inside_cntc_finalize")
      integer(c_int), intent(in), optional :: ire
      type(entry_type) :: this
      logical :: removed, was_last

      this = entry_type("cntc_finalize", integer_of(ire))
      if (.not. is_running()) return
      if (is_parallel(this)) return
      call remove_element(this, removed, was_last)
      if (.not. removed) call report_error(this, "there is no such result element, or another thread is at work on it")
      if (was_last) call cntc_finalizelast()
   end subroutine cntc_finalize

   !> Free all result elements and close the files
   subroutine cntc_finalizelast() bind(c, name="inside_cntc_finalizelast")
      type(entry_type) :: this
      logical :: stopped

      this%name = "cntc_finalizeLast"
      if (.not. is_running()) return
      if (is_parallel(this)) return
      call stop_library(stopped)
      if (.not. stopped) call report_error(this, "another thread is calculating, nothing is freed")
   end subroutine cntc_finalizelast

   !> Is the call refused because it is made inside a parallel region?
   logical function is_parallel(this)
      type(entry_type), intent(in) :: this

      is_parallel = omp_in_parallel()
      if (is_parallel) call report_error(this, "the routine cannot be called inside a parallel region")
   end function is_parallel

   !> Last error of a problem or of the library, and its code
   !>
   !> Success and an empty text if there was no error since the last call of this routine, or if there is no such problem; success
   !> and a text for a warning.
   function contact_last_error(ire, icp, message, message_length) result(code) bind(c, name="inside_contact_last_error")
      integer(c_int), value :: ire, icp
      type(c_ptr), value :: message
      integer(c_int), value :: message_length
      integer(c_int) :: code
      character(len=:), allocatable :: text
      integer :: number

      call stored_error(number, text, int(ire), int(icp))
      code = int(number, c_int)
      call set_message(text, message, message_length)
   end function contact_last_error

   !> Final status of the last calculation of a problem, member of case_state
   function contact_case_status(ire, icp, iteration, message, message_length) result(state) &
      & bind(c, name="inside_contact_case_status")
      integer(c_int), value :: ire, icp
      integer(c_int), intent(inout), optional :: iteration
      type(c_ptr), value :: message
      integer(c_int), value :: message_length
      integer(c_int) :: state
      type(case_status) :: status
      logical :: known

      call last_status(int(ire), int(icp), known, status)
      state = int(case_state%not_calculated, c_int)
      if (known) state = int(status%state, c_int)
      if (present(iteration)) iteration = int(status%iteration, c_int)
      if (allocated(status%reason)) then
         call set_message(status%reason, message, message_length)
      else
         call set_message("", message, message_length)
      end if
   end function contact_case_status
end module contact_capi_lifecycle
