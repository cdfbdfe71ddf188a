!> Cases of callers written as an input file of the program (flag 2002)
module contact_capi_input_dump
   use contact_capi_problem, only : library_problem
   use contact_capi_registry, only : complain, entry_type, input_dump_folder, open_input_dump, input_dump
   use contact_cases_spec, only : case_spec
   use contact_output_input_case, only : write_contact_case, write_pair_case
   implicit none (type, external)
   private

   public :: dump_contact_case, dump_pair_case

   !> The amount: digits as given, complete cases
   integer, parameter :: as_given = 1, complete = 2

contains

   !> A contact problem, after it was solved
   subroutine dump_contact_case(problem)
      type(library_problem), intent(in) :: problem
      character(len=80) :: line
      integer :: unit, status

      if (problem%write_input < as_given) return
      call open_input_dump()
      unit = input_dump()
      if (unit == 0) return
      write(line, '(i4, 2i5, a, i0)') 3, problem%ire, problem%icp, "   % MODULE, RE, CP: case ", problem%cases
      !$omp critical (contact_printing)
      write(unit, '(a)', iostat=status) trim(line)
      call write_contact_case(unit, problem%spec, problem%result)
      write(unit, '(a)', iostat=status) ""
      !$omp end critical (contact_printing)
   end subroutine dump_contact_case

   !> Wheel on rail, before it is solved
   subroutine dump_pair_case(this, problem)
      type(entry_type), intent(in) :: this
      type(library_problem), intent(in) :: problem
      type(case_spec) :: written
      character(len=80) :: line
      integer :: unit, status

      if (problem%write_input < as_given) return
      written = problem%spec
      associate (digits => written%digits)
         digits%s = 0
         digits%r = merge(1, 3, written%solve)
         if (problem%write_input >= complete) then
            digits%l = written%friction_law
            digits%d = written%wheel_rail%search%location
            digits%c = written%kernel
            digits%m2 = merge(2, 0, written%has_damping)
            digits%z = 3
            if (digits%e < 3) digits%e = 3
            if (digits%e == 4) digits%e = 5
         end if
         if (digits%h == 1) digits%h = 3
         if (digits%z == 3 .and. allocated(written%wheel_rail%rail_profile%points) .or. (digits%e == 3 .or. digits%e == 5) &
            & .and. allocated(written%wheel_rail%wheel_profile%points)) then
            call complain(this, "the case is not written as input: its profiles were given by values, not by files")
            return
         end if
      end associate
      call open_input_dump()
      unit = input_dump()
      if (unit == 0) return
      write(line, '(i4, i5, a, i0)') 1, problem%ire, "   % MODULE, RE: case ", problem%cases
      !$omp critical (contact_printing)
      write(unit, '(a)', iostat=status) trim(line)
      call write_pair_case(unit, written, input_dump_folder())
      write(unit, '(a)', iostat=status) ""
      !$omp end critical (contact_printing)
   end subroutine dump_pair_case
end module contact_capi_input_dump
