!> Batch computation: many cases from a text in memory, with their totals returned in arrays; no files are opened or written
!>
!> A batch keeps the sessions of its problems from call to call, so that arrays, tables and plans are reused. The result of a
!> case does not depend on earlier cases, unless the text requests it by `sequence`.
module contact_experiment_batch
   use, intrinsic :: iso_c_binding, only : c_char, c_null_char
   use contact_base_case_status, only : case_state, case_status
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_cases_slot, only : release_slot
   use contact_cases_spec, only : case_spec
   use contact_experiment_state, only : apply_settings, experiment_state, find_slot, run_settings, solve_one
   use contact_input_experiment_file, only : experiment_reader, input_case
   use contact_patch_quantities, only : element_field, total_list
   use contact_patch_result, only : mirrored, patch_result
   use contact_wheelrail_result, only : wheel_rail_result
   implicit none (type, external)
   private

   public :: batch_column, batch_field, batch_room, case_batch, close_batch, find_field, open_batch, solve_cases, solve_variations

   !> Maximum number of columns, and initial number of slots
   integer, parameter, public :: max_columns = 128
   integer, parameter :: first_slots = 4
   !> Name of the text in messages
   character(len=*), parameter :: text_name = "study.toml"

   !> A column of totals
   type :: batch_column
      !> Name, unit and meaning as in JSON and HDF5
      character(len=16) :: name = ""
      character(len=8) :: unit = ""
      character(len=104) :: meaning = ""
      !> Is it a total of wheel and rail rather than of a patch?
      logical :: is_of_pair = .false.
      !> Is it an integer?
      logical :: is_count = .false.
   end type batch_column

   !> State of a batch
   type :: case_batch
      type(experiment_state) :: state
      type(run_settings) :: settings
      !> Columns 1...count are in use
      type(batch_column) :: columns(max_columns)
      integer :: count = 0
      type(total_list), private :: totals
      !> Slot of the last case solved, 0: none; is it a wheel-rail case, on the left side?
      integer, private :: last = 0
      logical, private :: is_pair = .false., is_left = .false.
      !> Mirror image of a patch on the left side whose fields were requested
      type(patch_result), private :: mirror
   end type case_batch

   !> Arrays for the results. A case of module 3 gives one row; wheel and rail one row for the pair, patch 0, and one for each
   !> patch
   type :: batch_room
      !> Totals, shape (columns, rows); entries that a case does not have are unchanged
      real(wp), pointer :: values(:, :) => null()
      !> Case and patch of each row, from 1, shape (2, rows)
      integer, pointer :: places(:, :) => null()
      !> Member of case_state, and of missed_iteration, of each case, shape (2, cases)
      integer, pointer :: states(:, :) => null()
      !> Number of rows and cases filled
      integer :: rows = 0, cases = 0
      !> Why a case was not solved, truncated and null-terminated, shape (length, cases); unchanged for solved cases
      character(kind=c_char), pointer :: reasons(:, :) => null()
   end type batch_room

   !> An element field of a patch; its values are to be multiplied by `factor`
   type :: batch_field
      real(wp), pointer :: values(:, :) => null()
      real(wp) :: factor = 1.0_wp
      !> Unit and meaning
      character(len=8) :: unit = ""
      character(len=48) :: meaning = ""
      !> Centre of the first element and sides of an element [mm]
      real(wp) :: frame(4) = 0.0_wp
   end type batch_field

contains

   !> Initialise a batch
   subroutine open_batch(batch, seconds)
      !> State kept from call to call
      type(case_batch), intent(inout) :: batch
      !> Time limit of each case [s]; not positive: unlimited
      real(wp), intent(in) :: seconds

      allocate(batch%state%slots(first_slots))
      if (seconds > 0.0_wp) batch%state%limits%deadline%seconds = seconds
   end subroutine open_batch

   !> Release the memory of a batch
   subroutine close_batch(batch)
      !> State kept from call to call
      type(case_batch), intent(inout) :: batch
      integer :: k

      do k = 1, batch%state%used
         call release_slot(batch%state%slots(k)%problem_slot)
      end do
      batch%state%used = 0
   end subroutine close_batch

   !> Solve the cases of a text one after the other
   subroutine solve_cases(batch, text, folder, room, error)
      !> State kept from call to call
      type(case_batch), intent(inout) :: batch
      !> Text in the readable format
      character(len=*), intent(in) :: text
      !> Folder to which file names are relative
      character(len=*), intent(in) :: folder
      !> Receives the results
      type(batch_room), intent(inout) :: room
      !> Allocated if the text is invalid or the arrays are too small
      type(error_type), allocatable, intent(out) :: error
      type(experiment_reader) :: reader
      type(input_case) :: this

      batch%state%place%folder = folder
      call reader%open_readable(text, text_name, error)
      do while (.not. allocated(error))
         call reader%next_case(this, error)
         if (allocated(error) .or. this%module_number == 0) exit
         call solve_next(batch, this, room, error)
      end do
   end subroutine solve_cases

   !> Solve the second case of a text for many sets of numbers. The first case only provides what the second one keeps, and is
   !> not solved. If it has errors, it is read itself with each set, as some of the numbers may be the cause
   subroutine solve_variations(batch, text, folder, names, sets, room, error)
      !> State kept from call to call
      type(case_batch), intent(inout) :: batch
      !> Text in the readable format
      character(len=*), intent(in) :: text
      !> Folder to which file names are relative
      character(len=*), intent(in) :: folder
      !> Names of the varied numbers, "group.key"; all must be given in the second case
      character(len=*), intent(in) :: names(:)
      !> Their values, shape (numbers, cases)
      real(wp), intent(in) :: sets(:, :)
      !> Receives the results
      type(batch_room), intent(inout) :: room
      !> Allocated if the text is invalid or the arrays are too small
      type(error_type), allocatable, intent(out) :: error
      type(experiment_reader) :: reader
      type(input_case) :: head, this
      integer :: k

      batch%state%place%folder = folder
      call reader%open_readable(text, text_name, error)
      if (.not. allocated(error)) call reader%next_case(head, error)
      if (.not. allocated(error)) call reader%prepare_variation(names, error, of_first=.not. head%problems%is_usable())
      if (allocated(error) .and. .not. head%problems%is_usable()) call head%problems%first_failure(error)
      do k = 1, size(sets, 2)
         if (allocated(error)) exit
         call reader%read_variation(sets(:, k), this)
         call solve_next(batch, this, room, error, is_alone=.true.)
      end do
   end subroutine solve_variations

   !> Solve a case and store its results
   subroutine solve_next(batch, this, room, error, is_alone)
      !> State kept from call to call
      type(case_batch), intent(inout) :: batch
      type(input_case), intent(inout) :: this
      !> Receives the results
      type(batch_room), intent(inout) :: room
      !> Allocated if the arrays are too small; failures of the case itself are stored in the arrays
      type(error_type), allocatable, intent(out) :: error
      !> Keep nothing of earlier cases, not even a Hertzian geometry laid out for another load? Default: no
      logical, intent(in), optional :: is_alone
      type(error_type), allocatable :: refusal
      type(case_spec), allocatable :: solved
      type(case_status) :: status
      integer :: k

      if (room%cases == size(room%states, 2)) then
         call fatal_error(error, "there are more cases than the arrays have space for")
         return
      end if
      room%cases = room%cases + 1
      batch%last = 0
      if (.not. this%problems%is_usable()) then
         call this%problems%first_failure(refusal)
         call status%refuse(refusal%message)
      else if (this%spec%solve) then
         this%spec%flow_level = 0
         this%spec%output_level = 0
         call apply_settings(batch%state, batch%settings, this)
         call find_slot(batch%state, this%reid, this%cpid, k)
         if (present(is_alone) .and. associated(batch%state%slots(k)%problem_slot%session)) &
            & batch%state%slots(k)%problem_slot%session%problem%has_geometry = .false.
         call solve_one(batch%state, batch%state%slots(k), this, batch%state%log, status, solved, refusal)
         if (status%has_result()) then
            batch%last = k
            call store_results(batch, this, room, error)
         end if
      end if
      room%states(:, room%cases) = [status%state, status%iteration]
      if (status%state /= case_state%solved .and. allocated(status%reason)) &
         & call copy_reason(status%reason, room%reasons(:, room%cases))
   end subroutine solve_next

   !> Copy a text, truncated and null-terminated
   pure subroutine copy_reason(reason, letters)
      character(len=*), intent(in) :: reason
      !> Receives the text
      character(kind=c_char), intent(inout) :: letters(:)
      integer :: i, n

      n = min(len(reason), size(letters) - 1)
      do i = 1, n
         letters(i) = reason(i:i)
      end do
      if (n >= 0) letters(n + 1) = c_null_char
   end subroutine copy_reason

   !> Store the totals of the current case
   subroutine store_results(batch, this, room, error)
      !> State kept from call to call
      type(case_batch), intent(inout) :: batch
      type(input_case), intent(in) :: this
      !> Receives the results
      type(batch_room), intent(inout) :: room
      type(error_type), allocatable, intent(inout) :: error
      integer :: k

      associate (slot => batch%state%slots(batch%last))
         batch%is_pair = this%module_number == 1
         if (batch%is_pair) then
            batch%is_left = this%spec%wheel_rail%left
            call slot%wheel_rail_result%totals(this%spec%wheel_rail, batch%totals)
            call add_row(batch, room, 0, error)
            do k = 1, size(slot%wheel_rail_result%patches)
               call slot%wheel_rail_result%patches(k)%totals(batch%totals, this%spec%wheel_rail%left)
               call add_row(batch, room, k, error)
            end do
         else
            batch%is_left = .false.
            call slot%result%totals(batch%totals)
            call add_row(batch, room, 1, error)
         end if
      end associate
   end subroutine store_results

   !> Store the current totals as a row
   subroutine add_row(batch, room, patch, error)
      !> State kept from call to call
      type(case_batch), intent(inout) :: batch
      !> Receives the results
      type(batch_room), intent(inout) :: room
      !> Index of the patch, 0 for wheel and rail
      integer, intent(in) :: patch
      type(error_type), allocatable, intent(inout) :: error
      integer :: column, k

      if (allocated(error)) return
      if (room%rows == size(room%values, 2)) then
         call fatal_error(error, "there are more rows of totals than the arrays have space for")
         return
      end if
      room%rows = room%rows + 1
      room%places(:, room%rows) = [room%cases, patch]
      column = 0
      do k = 1, batch%totals%length
         associate (row => batch%totals%rows(k))
            if (.not. row%in_files) cycle
            call find_column(batch, row%name, patch == 0, column)
            if (column > min(size(room%values, 1), max_columns)) then
               call fatal_error(error, "there are more totals than columns")
               return
            end if
            if (column > batch%count) then
               batch%count = column
               batch%columns(column) = batch_column(row%name, row%unit, row%meaning, patch == 0, row%is_count)
            end if
            room%values(column, room%rows) = row%value
         end associate
      end do
   end subroutine add_row

   !> Find the column of a total: usually the next one; a new total is appended
   pure subroutine find_column(batch, name, is_of_pair, column)
      type(case_batch), intent(in) :: batch
      character(len=*), intent(in) :: name
      logical, intent(in) :: is_of_pair
      !> On entry the column of the previous total
      integer, intent(inout) :: column

      column = column + 1
      if (column <= batch%count) then
         if (batch%columns(column)%name == name .and. (batch%columns(column)%is_of_pair .eqv. is_of_pair)) return
      end if
      do column = 1, batch%count
         if (batch%columns(column)%name == name .and. (batch%columns(column)%is_of_pair .eqv. is_of_pair)) return
      end do
   end subroutine find_column

   !> A field of a patch of the last case solved; not associated if it does not exist
   subroutine find_field(batch, patch, name, field)
      !> State kept from call to call
      type(case_batch), intent(inout), target :: batch
      !> Index of the patch, from 1
      integer, intent(in) :: patch
      !> Name as in HDF5
      character(len=*), intent(in) :: name
      !> Field with the values of the last case solved
      type(batch_field), intent(out) :: field
      type(patch_result), pointer :: result
      type(wheel_rail_result), pointer :: pair
      type(element_field), allocatable :: rows(:)
      integer :: k

      if (batch%last == 0) return
      nullify(result)
      if (.not. batch%is_pair) then
         if (patch == 1) result => batch%state%slots(batch%last)%result
      else
         pair => batch%state%slots(batch%last)%wheel_rail_result
         if (patch >= 1 .and. patch <= size(pair%patches)) result => pair%patches(patch)%contact
      end if
      if (.not. associated(result)) return
      if (batch%is_left) then
         batch%mirror = mirrored(result)
         result => batch%mirror
      end if
      call result%fields(rows)
      do k = 1, size(rows)
         if (rows(k)%name /= name .or. .not. associated(rows(k)%values)) cycle
         field%values => rows(k)%values
         field%factor = 1.0_wp/rows(k)%divisor
         field%unit = rows(k)%unit
         field%meaning = rows(k)%meaning
         associate (grid => result%grid)
            field%frame = [grid%xl + 0.5_wp*grid%dx, grid%yl + 0.5_wp*grid%dy, grid%dx, grid%dy]
         end associate
      end do
   end subroutine find_field
end module contact_experiment_batch
