!> Subsurface stresses for callers
module contact_capi_subsurface
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use contact_base_error, only : add_context, error_type, full_text
   use contact_base_kinds, only : long, wp
   use contact_base_log, only : log_type
   use contact_capi_arguments, only : integer_of, set_argument
   use contact_capi_caller, only : caller
   use contact_capi_files, only : find_result_file
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : report_error, count_fits, first_refusal, library_log
   use contact_capi_problem, only : library_problem
   use contact_capi_registry, only : enter_calculation, leave_calculation, scope
   use contact_capi_view, only : look_at, result_view
   use contact_cases_spec, only : case_spec
   use contact_cases_subsurface, only : subsurface_stresses, warn_of_subsurface
   use contact_cases_subsurface_inputs, only : block_option, longest_list, visit_block, visit_option
   use contact_control_library_codes, only : library_code
   use contact_control_units, only : outward, quantity
   use contact_output_finished_file, only : case_file_name
   use contact_output_report, only : write_subsurface
   use contact_output_subs_file, only : write_subs_file
   use contact_patch_result, only : patch_result, subsurface_result
   use contact_subsurface_points, only : point_block
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: add_block, get_block, get_block_size, subs_calculate

   !> Maximum number of blocks of a problem
   integer, parameter :: max_blocks = 10
   !> Number of columns, and value of unknown ones
   integer, parameter :: max_columns = 21
   real(wp), parameter :: no_column = -999.0_wp
   !> Stress component of columns 13 to 21, the tensor column by column, as index of xx, xy, xz, yy, yz, zz
   integer, parameter :: component(13:21) = [1, 2, 3, 2, 4, 5, 3, 5, 6]

contains

   !> Add a block of points; blocks with the same or a larger index are removed, index 0 removes all
   !>
   !> Points may belong to a single patch of wheel and rail.
   subroutine add_block(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem
      type(point_block) :: block
      real(wp), allocatable :: numbers(:)

      associate (number => a%single(1), patch => a%call_of%icp)
         if (number > 0) then
            call arrange_as_in_files(a, numbers)
            if (.not. a%is_good) return
            call read_block(a, numbers, block)
            if (.not. a%is_good) return
         end if
         if (problem%module_number == 1 .and. patch > 0) then
            call store_block(a%call_of, number, block, problem%blocks(patch)%list)
            if (number == 0 .and. allocated(problem%blocks(patch)%list)) deallocate(problem%blocks(patch)%list)
         else
            call store_block(a%call_of, number, block, problem%spec%subsurface%blocks)
         end if
      end associate
   end subroutine add_block

   !> Read a block from other numbers than those of the caller
   subroutine read_block(a, numbers, block)
      type(caller), intent(inout) :: a
      !> Numbers of the block in the order of input files
      real(wp), intent(in), target :: numbers(:)
      type(point_block), intent(inout), target :: block
      real(wp), pointer :: given(:)
      integer, target :: option

      given => a%numbers(1)%v
      a%numbers(1)%v => numbers
      call visit_option(a, option)
      call visit_block(a, option, block)
      a%numbers(1)%v => given
   end subroutine read_block

   !> Option and lists of a block in the order of input files, each list after its length; ranges have three numbers instead
   subroutine arrange_as_in_files(a, numbers)
      !> Call with the option as second integer; refused unless each range has three numbers
      type(caller), intent(inout) :: a
      !> Values in the units of the caller
      real(wp), allocatable, intent(out) :: numbers(:)
      real(wp) :: lengths(3)
      integer :: k, n(3)

      associate (option => a%single(2), x => a%numbers(1)%v, y => a%numbers(2)%v, z => a%numbers(3)%v)
         do k = 1, 3
            if (.not. is_range(option, k)) cycle
            a%is_good = count_fits(a%call_of, option, size(a%numbers(k)%v), 3, 3)
            if (.not. a%is_good) return
         end do
         lengths = real([size(x), size(y), size(z)], wp)
         ! longer lists are refused by their lengths
         n = min([size(x), size(y), size(z)], longest_list)
         numbers = [real(option, wp)]
         select case (option)
         case (block_option%ranges_by_step, block_option%ranges); numbers = [numbers, x, y]
         case (block_option%lists_by_step, block_option%lists); numbers = [numbers, lengths(:2), x(:n(1)), y(:n(2))]
         case (block_option%free); numbers = [numbers, lengths, x(:n(1)), y(:n(2))]
         end select
         if (.not. is_range(option, 3) .and. option /= block_option%free) numbers = [numbers, lengths(3)]
         numbers = [numbers, z(:n(3))]
      end associate
   end subroutine arrange_as_in_files

   !> Is a list of a block a range of three numbers?
   pure logical function is_range(option, list)
      !> Member of block_option, and list: 1 columns, 2 rows, 3 depths
      integer, intent(in) :: option, list

      if (list == 3) then
         is_range = any(option == [block_option%all_by_step, block_option%ranges_by_step, block_option%lists_by_step])
      else
         is_range = any(option == [block_option%ranges_by_step, block_option%ranges])
      end if
   end function is_range

   !> Store a block in a list
   subroutine store_block(this, number, block, list)
      type(entry_type), intent(in) :: this
      integer, intent(in) :: number
      type(point_block), intent(in) :: block
      type(point_block), allocatable, intent(inout) :: list(:)
      type(point_block), allocatable :: longer(:)
      integer :: n

      n = 0
      if (allocated(list)) n = size(list)
      if (number < 0 .or. number > min(n + 1, max_blocks)) then
         call report_error(this, "the number of the block is " // integer_text(number) // ", it must be 0 to " // &
            & integer_text(min(n + 1, max_blocks)))
         return
      end if
      allocate(longer(number))
      if (number > 1) longer(:number - 1) = list(:number - 1)
      if (number > 0) longer(number) = block
      call move_alloc(longer, list)
   end subroutine store_block

   !> Calculate displacements and stresses in the blocks of points, after a calculation
   subroutine subs_calculate(ire, icp, ierror) bind(c, name="inside_subs_calculate")
      integer(c_int), intent(in), optional :: ire, icp
      integer(c_int), intent(inout), optional :: ierror
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      integer :: code, k

      this = entry_type("subs_calculate", integer_of(ire), integer_of(icp))
      call enter_calculation(this, scope%any, problem, code)
      if (associated(problem)) then
         call problem%stresses%start()
         k = first_refusal(problem, "subs_addBlock")
         if (k > 0) then
            code = problem%refused(k)%code
            call report_error(this, "a block of points was refused and not given again: " // problem%refused(k)%reason, code)
         else if (.not. problem%has_result) then
            code = library_code%other
            call report_error(this, "nothing has been calculated yet", code)
         else if (problem%module_number == 3) then
            call calculate_patch(this, problem, 0, problem%result, code)
         else if (this%icp > 0) then
            call calculate_patch(this, problem, this%icp, problem%wheel_rail_result%patches(this%icp)%contact, code)
         else
            do k = 1, size(problem%wheel_rail_result%patches)
               call calculate_patch(this, problem, k, problem%wheel_rail_result%patches(k)%contact, code)
               if (code /= library_code%success) exit
            end do
         end if
         call problem%stresses%halt()
         call leave_calculation(problem)
      end if
      call set_argument(code, ierror)
   end subroutine subs_calculate

   !> Calculate the blocks of one patch, print the results and write the file
   subroutine calculate_patch(this, problem, number, patch, code)
      type(entry_type), intent(in) :: this
      type(library_problem), intent(in) :: problem
      !> Patch of module 1, 0 in module 3
      integer, intent(in) :: number
      type(patch_result), intent(inout) :: patch
      integer, intent(out) :: code
      type(case_spec) :: request
      type(error_type), allocatable :: error
      type(log_type) :: log
      character(len=:), allocatable :: file

      request%kernel = problem%bodies%kernel
      request%material = problem%bodies%material
      request%material_model = problem%bodies%material_model
      request%motion = problem%bodies%motion
      request%has_stress = .true.
      request%subsurface = problem%spec%subsurface
      if (number > 0) then
         if (allocated(problem%blocks(number)%list)) request%subsurface%blocks = problem%blocks(number)%list
      end if
      code = library_code%success
      if (number == 0) then
         call subsurface_stresses(request, patch, error, problem%bodies%left, problem%session%shelf)
      else
         call subsurface_stresses(request, patch, error, problem%bodies%left)
      end if
      if (.not. allocated(error) .and. allocated(patch%subsurface)) then
         log = library_log()
         !$omp critical (contact_printing)
         call warn_of_subsurface(request, patch, log)
         call write_subsurface(log, request, patch)
         !$omp end critical (contact_printing)
         if (request%subsurface%matfil >= 1) then
            call find_file(problem, number, file)
            call write_subs_file(file, request, patch, error)
         end if
      end if
      if (.not. allocated(error)) return
      if (number > 0) call add_context(error, "contact patch " // integer_text(number))
      code = library_code%other
      call report_error(this, full_text(error), code)
   end subroutine calculate_patch

   !> Name of the file with the stresses
   subroutine find_file(problem, number, file)
      type(library_problem), intent(in) :: problem
      !> Patch of wheel and rail, 0 for a contact problem
      integer, intent(in) :: number
      character(len=:), allocatable, intent(out) :: file
      character(len=20) :: base

      if (number > 0) then
         call find_result_file(case_file_name("caddon", problem%cases, "subs", problem%ire, 1, number), file)
      else
         write(base, '("caddon_re", I3.3, "_cp", I1)') problem%ire, problem%icp
         call find_result_file(case_file_name(trim(base), problem%cases, "subs", 0, 1, 0), file)
      end if
   end subroutine find_file

   !> Get the numbers of points of a block, -1: no such block
   subroutine get_block_size(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), pointer, intent(in) :: problem
      type(result_view) :: view
      integer :: k

      view = look_at(a%call_of, problem)
      k = a%single(1)
      if (has_block(view, k)) then
         associate (block => view%patch%subsurface(k))
            call a%set_each_result([block%nx, block%ny, block%nz])
         end associate
      else
         call a%set_each_result([-1, -1, -1])
      end if
   end subroutine get_block_size

   !> Are there results of a block?
   pure logical function has_block(view, number)
      type(result_view), intent(in) :: view
      integer, intent(in) :: number

      has_block = .false.
      if (.not. associated(view%patch)) return
      if (.not. allocated(view%patch%subsurface)) return
      has_block = number >= 1 .and. number <= size(view%patch%subsurface)
   end function has_block

   !> Get columns of the results of a block
   subroutine get_block(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), pointer, intent(in) :: problem
      type(result_view) :: view
      real(wp), allocatable :: column(:)
      real(c_double), pointer :: values(:)
      integer :: k, n, rows

      view = look_at(a%call_of, problem)
      rows = max(0, a%single(2))
      associate (number => a%single(1), columns => a%integers(1)%v)
         if (.not. has_block(view, number)) then
            call report_error(a%call_of, "there are no results in block " // integer_text(number))
            return
         end if
         values => a%numbers_at(1, int(rows, long)*size(columns))
         if (size(values) == 0) return
         do k = 1, size(columns)
            call get_column(view, view%patch%subsurface(number), columns(k), column)
            n = min(rows, size(column))
            values((k - 1)*rows + 1:(k - 1)*rows + n) = column(:n)
         end do
      end associate
   end subroutine get_block

   !> One column in the units of the caller
   pure subroutine get_column(view, block, number, column)
      type(result_view), intent(in) :: view
      type(subsurface_result), intent(in) :: block
      integer, intent(in) :: number
      real(wp), allocatable, intent(out) :: column(:)

      select case (number)
      case (1:3); column = block%position(number, :)*outward(view%units, quantity%length)
      case (4:6); column = block%displacement(number - 3, :)*outward(view%units, quantity%length)
      case (7); column = block%sighyd
      case (8); column = block%sigvm
      case (9); column = block%sigtr
      case (10); column = block%sigma1
      case (11); column = block%sigma2
      case (12); column = block%sigma3
      case (13:max_columns); column = block%stress(component(number), :)
      case default
         allocate(column(size(block%sigvm)), source=no_column)
         return
      end select
      if (number > 6) column = column*outward(view%units, quantity%pressure)
   end subroutine get_column
end module contact_capi_subsurface
