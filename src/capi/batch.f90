!> C interface: many cases of a text in one call; see include/contact.h
module contact_capi_batch
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_f_pointer, c_int, c_loc, c_null_ptr, c_ptr
   use omp_lib, only : omp_get_max_threads, omp_set_num_threads
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_guard, only : cause_text, do_guarded, free_left_blocks, guard_end, new_owner
   use contact_base_kept_blocks, only : kept_blocks
   use contact_capi_arguments, only : copy_text, first_failure, set_message, wrong_call
   use contact_capi_host, only : give_floats_back, hold_floats
   use contact_experiment_batch, only : batch_field, batch_room, case_batch, close_batch, find_field, open_batch, &
      & solve_cases, solve_variations
   implicit none (type, external)
   private

   public :: contact_batch_open, contact_batch_close, contact_batch_solve, contact_batch_column, contact_batch_field, &
      & contact_batch_field_values

   !> Data of the handle of the host
   type :: open_type
      type(case_batch), pointer :: batch => null()
      !> Number of threads of a calculation, and owner of the memory
      integer :: threads = 1, owner = 0
      !> Blocks of memory released by a call, for the next one
      type(kept_blocks) :: kept
      !> Was a call abandoned for lack of memory, so that the batch must not be read any more?
      logical :: is_lost = .false.
   end type open_type

   !> Data of one call, contact_batch_job of the header
   type, bind(c) :: job_type
      type(c_ptr) :: text, folder, names
      integer(c_int) :: numbers, sets
      type(c_ptr) :: given
      integer(c_int) :: room_rows, room_columns, room_cases
      type(c_ptr) :: values, places, states, reasons
      integer(c_int) :: reason_length, rows, cases, columns
   end type job_type

   !> A call, passed to the guarded procedures
   type :: request_type
      type(open_type), pointer :: open => null()
      type(job_type), pointer :: job => null()
      real(c_double) :: seconds = 0.0_c_double
      type(error_type), allocatable :: error
   end type request_type

   !> Request of a field by contact_batch_field
   type :: field_request
      type(open_type), pointer :: open => null()
      integer :: patch = 0
      type(c_ptr) :: name = c_null_ptr
      type(batch_field) :: field
   end type field_request

contains

   !> Create a batch; null if there is not enough memory
   function contact_batch_open(threads, seconds) result(handle) bind(c, name="contact_batch_open")
      integer(c_int), value :: threads
      real(c_double), value :: seconds
      type(c_ptr) :: handle
      type(open_type), pointer :: open
      type(request_type), target :: request
      integer :: cause, status

      handle = c_null_ptr
      allocate(open, stat=status)
      if (status /= 0) return
      open%threads = max(1, int(threads))
      open%owner = new_owner()
      request%open => open
      request%seconds = seconds
      call hold_floats()
      call do_guarded(open_inside, c_loc(request), open%owner, cause)
      call give_floats_back()
      if (cause /= guard_end%done) then
         call free_left_blocks(open%owner)
         deallocate(open)
         return
      end if
      handle = c_loc(open)
   end function contact_batch_open

   !> Create it under the guard
   subroutine open_inside(data) bind(c)
      !> A request_type
      type(c_ptr), value :: data
      type(request_type), pointer :: request

      call c_f_pointer(data, request)
      allocate(request%open%batch)
      call open_batch(request%open%batch, request%seconds)
   end subroutine open_inside

   !> Free a batch; nothing if null
   subroutine contact_batch_close(handle) bind(c, name="contact_batch_close")
      type(c_ptr), value :: handle
      type(open_type), pointer :: open

      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, open)
      if (open%is_lost) then
         call free_left_blocks(open%owner)
      else
         call close_batch(open%batch)
         deallocate(open%batch)
      end if
      call open%kept%release()
      deallocate(open)
   end subroutine contact_batch_close

   !> Solve cases
   function contact_batch_solve(handle, job, message, length) result(status) bind(c, name="contact_batch_solve")
      type(c_ptr), value :: handle
      type(job_type), intent(inout), target, optional :: job
      type(c_ptr), value :: message
      integer(c_int), value :: length
      integer(c_int) :: status
      type(request_type), target :: request
      integer :: cause, threads

      status = wrong_call
      call set_message("", message, length)
      if (.not. present(job)) then
         call set_message("contact_batch_solve: there is no job", message, length)
         return
      end if
      job%rows = 0
      job%cases = 0
      job%columns = 0
      if (.not. c_associated(handle)) then
         call set_message("contact_batch_solve: there is no batch", message, length)
         return
      end if
      call c_f_pointer(handle, request%open)
      if (request%open%is_lost) then
         call set_message("contact_batch_solve: the batch ran out of memory and can only be closed", message, length)
         return
      end if
      if (is_wrong(job)) then
         call set_message("contact_batch_solve: a number of the job is negative, or an array is missing", message, length)
         return
      end if
      request%job => job
      call hold_floats()
      threads = omp_get_max_threads()
      call omp_set_num_threads(request%open%threads)
      call request%open%kept%use_them()
      call do_guarded(solve_inside, c_loc(request), request%open%owner, cause)
      call request%open%kept%stop_using()
      call omp_set_num_threads(threads)
      status = 0
      if (cause /= guard_end%done) then
         request%open%is_lost = .true.
         status = first_failure + int(error_kind%memory, c_int)
         call set_message(trim(cause_text(cause)) // " for the batch", message, length)
      else if (allocated(request%error)) then
         status = first_failure + int(request%error%kind, c_int)
         call set_message(request%error%message, message, length)
      end if
      call give_floats_back()
   end function contact_batch_solve

   !> Is a job invalid?
   logical function is_wrong(job)
      type(job_type), intent(in) :: job

      is_wrong = min(job%numbers, job%sets, job%room_rows, job%room_columns, job%room_cases, job%reason_length) < 0_c_int
      is_wrong = is_wrong .or. .not. (c_associated(job%text) .and. c_associated(job%values) .and. c_associated(job%places) &
         & .and. c_associated(job%states) .and. c_associated(job%reasons))
      if (job%numbers > 0_c_int) is_wrong = is_wrong .or. .not. (c_associated(job%names) .and. c_associated(job%given))
   end function is_wrong

   !> Solve them under the guard
   recursive subroutine solve_inside(data) bind(c)
      !> A request_type
      type(c_ptr), value :: data
      type(request_type), pointer :: request
      type(batch_room) :: room
      real(c_double), pointer :: sets(:, :)
      character(len=:), allocatable :: text, folder, list
      character(len=:), allocatable :: names(:)

      call c_f_pointer(data, request)
      associate (job => request%job)
         call copy_text(job%text, text)
         call copy_text(job%folder, folder)
         if (len(folder) > 0 .and. index(folder, "/", back=.true.) < len(folder)) folder = folder // "/"
         call c_f_pointer(job%values, room%values, [job%room_columns, job%room_rows])
         call c_f_pointer(job%places, room%places, [2, int(job%room_rows)])
         call c_f_pointer(job%states, room%states, [2, int(job%room_cases)])
         call c_f_pointer(job%reasons, room%reasons, [job%reason_length, job%room_cases])
         if (job%numbers == 0) then
            call solve_cases(request%open%batch, text, folder, room, request%error)
         else
            call copy_text(job%names, list)
            call split(list, int(job%numbers), names)
            call c_f_pointer(job%given, sets, [job%numbers, job%sets])
            if (allocated(names)) then
               call solve_variations(request%open%batch, text, folder, names, sets, room, request%error)
            else
               call fatal_error(request%error, "the number of names of the job differs from that of its numbers")
            end if
         end if
         job%rows = int(room%rows, c_int)
         job%cases = int(room%cases, c_int)
         job%columns = int(request%open%batch%count, c_int)
      end associate
   end subroutine solve_inside

   !> Split a list of names at its line ends; unallocated if their number is not `count`
   subroutine split(list, count, names)
      character(len=*), intent(in) :: list
      integer, intent(in) :: count
      character(len=:), allocatable, intent(out) :: names(:)
      character(len=len(list)) :: found(count)
      integer :: first, k, length

      first = 1
      do k = 1, count
         if (first > len(list)) return
         length = index(list(first:), new_line("a")) - 1
         if (length < 0) length = len(list) - first + 1
         found(k) = list(first:first + length - 1)
         first = first + length + 1
      end do
      if (first <= len(list)) return
      names = found
   end subroutine split

   !> Name, unit and meaning of a column of totals
   function contact_batch_column(handle, number, name, unit, meaning, length) result(kind) bind(c, name="contact_batch_column")
      type(c_ptr), value :: handle
      integer(c_int), value :: number
      type(c_ptr), value :: name, unit, meaning
      integer(c_int), value :: length
      !> 0: real number of a patch, 1: integer of a patch, 2, 3: the same for wheel and rail as a whole; -1: no such column
      integer(c_int) :: kind
      type(open_type), pointer :: open
      integer(c_int), parameter :: of_pair = 2_c_int

      kind = -1_c_int
      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, open)
      if (open%is_lost) return
      if (number < 1 .or. number > open%batch%count) return
      associate (column => open%batch%columns(number))
         call set_message(trim(column%name), name, length)
         call set_message(trim(column%unit), unit, length)
         call set_message(trim(column%meaning), meaning, length)
         kind = merge(of_pair, 0_c_int, column%is_of_pair) + merge(1_c_int, 0_c_int, column%is_count)
      end associate
   end function contact_batch_column

   !> Size and position of an element field of the last case
   function contact_batch_field(handle, patch, name, mx, my, frame, unit, length) result(status) &
      & bind(c, name="contact_batch_field")
      type(c_ptr), value :: handle
      integer(c_int), value :: patch
      type(c_ptr), value :: name
      integer(c_int), intent(out), optional :: mx, my
      real(c_double), intent(out), optional :: frame(4)
      type(c_ptr), value :: unit
      integer(c_int), value :: length
      !> 0, or 1 if there is no such field
      integer(c_int) :: status
      type(field_request), target :: request
      integer :: cause

      status = wrong_call
      if (.not. (present(mx) .and. present(my) .and. present(frame))) return
      mx = 0_c_int
      my = 0_c_int
      frame = 0.0_c_double
      call find_it(handle, patch, name, request, cause)
      if (cause /= guard_end%done .or. .not. associated(request%field%values)) return
      mx = size(request%field%values, 1, c_int)
      my = size(request%field%values, 2, c_int)
      frame = request%field%frame
      call set_message(trim(request%field%unit), unit, length)
      status = 0_c_int
   end function contact_batch_field

   !> Values of an element field, x running fastest
   function contact_batch_field_values(handle, patch, name, room, values) result(status) &
      & bind(c, name="contact_batch_field_values")
      type(c_ptr), value :: handle
      integer(c_int), value :: patch
      type(c_ptr), value :: name
      integer(c_int), value :: room
      real(c_double), intent(inout), optional :: values(*)
      !> 0, or 1 if there is no such field or `values` is too short
      integer(c_int) :: status
      type(field_request), target :: request
      integer :: cause, j, mx

      status = wrong_call
      if (.not. present(values)) return
      call find_it(handle, patch, name, request, cause)
      if (cause /= guard_end%done .or. .not. associated(request%field%values)) return
      if (size(request%field%values) > room) return
      mx = size(request%field%values, 1)
      do j = 1, size(request%field%values, 2)
         values(mx*(j - 1) + 1:mx*j) = request%field%factor*request%field%values(:, j)
      end do
      status = 0_c_int
   end function contact_batch_field_values

   !> Find a field
   subroutine find_it(handle, patch, name, request, cause)
      type(c_ptr), intent(in) :: handle, name
      integer(c_int), intent(in) :: patch
      type(field_request), intent(inout), target :: request
      !> Member of guard_end
      integer, intent(out) :: cause

      cause = guard_end%done
      if (.not. (c_associated(handle) .and. c_associated(name))) return
      call c_f_pointer(handle, request%open)
      if (request%open%is_lost) return
      request%patch = patch
      request%name = name
      call do_guarded(find_inside, c_loc(request), request%open%owner, cause)
      if (cause /= guard_end%done) request%open%is_lost = .true.
   end subroutine find_it

   !> Find it under the guard
   subroutine find_inside(data) bind(c)
      !> A field_request
      type(c_ptr), value :: data
      type(field_request), pointer :: request
      character(len=:), allocatable :: name

      call c_f_pointer(data, request)
      call copy_text(request%name, name)
      call find_field(request%open%batch, request%patch, name, request%field)
   end subroutine find_inside
end module contact_capi_batch
