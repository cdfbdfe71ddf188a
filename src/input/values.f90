!> Values of an input file together with their bounds: what the groups of a case are read with
module contact_input_values
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_text_bounds, only : bounds_of, bounds_table
   use contact_input_problems, only : problem_list
   use contact_text_lexer, only : input_lexer, input_value
   implicit none (type, external)
   private

   public :: read_values, read_list

contains

   !> Read a group and tell which of its numbers are beyond their bounds
   !>
   !> A value with two names, "A|B", has the bounds of the one that is meant, which the caller checks.
   subroutine read_values(lexer, types, names, values, problems, error)
      type(input_lexer), intent(inout) :: lexer
      !> As for read_group of the lexer
      character(len=*), intent(in) :: types, names
      type(input_value), intent(inout) :: values(:)
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      integer :: k

      call lexer%read_group(types, names, values, error)
      if (allocated(error)) return
      do k = 1, len(types)
         if (types(k:k) == "s" .or. .not. values(k)%given) cycle
         if (index(values(k)%name, "|") == 0) call problems%check_bounds(values(k))
      end do
   end subroutine read_values

   !> Read exactly n numbers and tell the first that is beyond the bounds
   subroutine read_list(lexer, n, name, values, problems, error, angles, line, bounds)
      type(input_lexer), intent(inout) :: lexer
      !> As for read_array of the lexer
      integer, intent(in) :: n
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(out) :: values(:)
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      logical, intent(in), optional :: angles
      integer, intent(out), optional :: line
      !> Name of the bounds in the table; default the name of the array
      character(len=*), intent(in), optional :: bounds
      type(input_value) :: outside
      integer :: row

      row = bounds_of(name)
      if (present(bounds)) row = bounds_of(bounds)
      call lexer%read_array(n, name, values, error, angles, line, bounds_table(row)%lowest, bounds_table(row)%highest, outside)
      if (allocated(error) .or. .not. outside%given) return
      call problems%check_bounds(outside, trim(bounds_table(row)%name))
   end subroutine read_list
end module contact_input_values
