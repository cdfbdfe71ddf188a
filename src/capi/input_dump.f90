!> Cases of callers, written as an input file of the program (flag 2002)
module contact_capi_input_dump
   use contact_base_error, only : error_type
   use contact_base_guard, only : set_owner
   use contact_capi_files, only : dumps_input, open_input_dump, place_beside_dump, relate_to_dump
   use contact_capi_library, only : entry_type, library
   use contact_capi_messages, only : report_error, warn
   use contact_capi_problem, only : given_profile, library_problem
   use contact_cases_changed_parts, only : give_changed_parts, give_first_parts
   use contact_cases_spec, only : case_parts, case_spec, geometry_spec, part_source, subsurface_spec
   use contact_output_finished_file, only : finished_file
   use contact_output_input_case, only : write_contact_case, write_input_case
   use contact_output_unwritten, only : unwritten_setting, unwritten_settings
   use contact_wheelrail_spec, only : profile_spec
   implicit none (type, external)
   private

   public :: dump_contact_case, dump_wheel_rail_case

   !> Value of the flag: digits as given, complete cases
   integer, parameter :: as_given = 1, complete = 2

contains

   !> Write a contact problem, after it was solved
   subroutine dump_contact_case(this, problem, spec)
      type(entry_type), intent(in) :: this
      type(library_problem), intent(inout) :: problem
      !> The case
      type(case_spec), intent(in) :: spec
      type(case_spec) :: given
      character(len=80) :: line
      logical :: ignored

      if (problem%write_input < as_given) return
      given = spec
      call open_input_dump()
      if (.not. dumps_input()) return
      write(line, "(I4, 2I5, A, I0)") 3, problem%ire, problem%icp, "   % MODULE, RE, CP: case ", problem%cases
      !$omp critical (contact_printing)
      call library%input_dump%line(trim(line))
      call follow_written(problem, given)
      call write_contact_case(library%input_dump, given, problem%result, problem%session%state%before)
      call library%input_dump%line("")
      !$omp end critical (contact_printing)
      call warn_of_unwritten(this, spec)
      ignored = dumps_input()
   end subroutine dump_contact_case

   !> Write a wheel on a rail, before it is solved
   subroutine dump_wheel_rail_case(this, problem)
      type(entry_type), intent(in) :: this
      type(library_problem), intent(inout) :: problem
      type(case_spec) :: written
      character(len=80) :: line
      logical :: ignored

      if (problem%write_input < as_given) return
      written = problem%spec
      written%has_stress = .false.
      written%ends_module = .true.
      written%parts%heat = part_source%given
      associate (parts => written%parts)
         if (problem%write_input >= complete) parts = case_parts(iteration=parts%iteration, flexibility=parts%flexibility)
      end associate
      call open_input_dump()
      if (.not. dumps_input()) return
      call name_profile(this, problem%cases, "rail", written%wheel_rail%rail_profile, problem%rail)
      call name_profile(this, problem%cases, "wheel", written%wheel_rail%wheel_profile, problem%wheel)
      write(line, "(I4, I5, A, I0)") 1, problem%ire, "   % MODULE, RE: case ", problem%cases
      !$omp critical (contact_printing)
      call library%input_dump%line(trim(line))
      call follow_written(problem, written)
      call write_input_case(library%input_dump, written)
      call library%input_dump%line("")
      !$omp end critical (contact_printing)
      call warn_of_unwritten(this, written)
      ignored = dumps_input()
   end subroutine dump_wheel_rail_case

   !> Let a case give what differs from the case of this problem that was written last, and store it as the last one; inside the
   !> critical section of the files
   subroutine follow_written(problem, spec)
      type(library_problem), intent(inout) :: problem
      !> Its parts are updated
      type(case_spec), intent(inout) :: spec
      type(case_spec), pointer :: last
      logical :: is_first

      associate (slot => library%elements(problem%ire)%patch(max(1, problem%icp)))
         is_first = .not. associated(slot%written)
         ! a result element of the other module had this number
         if (.not. is_first) is_first = allocated(slot%written%wheel_rail) .neqv. allocated(spec%wheel_rail)
         if (is_first) then
            call give_first_parts(spec)
         else
            call give_changed_parts(slot%written, spec)
         end if
         last => slot%written
         call copy_settings(problem, spec, slot%written)
         if (associated(last)) deallocate(last)
      end associate
   end subroutine follow_written

   !> Copy the settings of a case, without lists of values, into memory outside of the calculation, which may be abandoned
   subroutine copy_settings(problem, spec, copy)
      type(library_problem), intent(inout) :: problem
      type(case_spec), intent(in) :: spec
      !> The copy; undefined on entry
      type(case_spec), pointer, intent(inout) :: copy
      type(case_spec), pointer :: fresh

      call set_owner(0)
      if (problem%module_number == 1) call problem%kept%stop_using()
      allocate(fresh)
      fresh = spec
      fresh%geometry = geometry_spec()
      fresh%subsurface = subsurface_spec()
      if (allocated(fresh%extra_slip)) deallocate(fresh%extra_slip)
      if (allocated(fresh%wheel_rail)) then
         associate (pair => fresh%wheel_rail)
            if (allocated(pair%rail_profile%points)) deallocate(pair%rail_profile%points)
            if (allocated(pair%wheel_profile%points)) deallocate(pair%wheel_profile%points)
         end associate
      end if
      copy => fresh
      if (problem%module_number == 1) call problem%kept%use_again()
      call set_owner(problem%owner)
   end subroutine copy_settings

   !> Warn of each setting that neither the file nor an option of the program has
   subroutine warn_of_unwritten(this, spec)
      type(entry_type), intent(in) :: this
      !> The case
      type(case_spec), intent(in) :: spec
      type(unwritten_setting), allocatable :: settings(:)
      integer :: k

      settings = unwritten_settings(spec)
      do k = 1, size(settings)
         if (settings(k)%fact /= "" .and. settings(k)%option == "") call warn(this, trim(settings(k)%fact) // &
            & ", which is not in the input file that is written")
      end do
   end subroutine warn_of_unwritten

   !> Name of a profile for the input file; a profile that was given by values is written to a file, once
   subroutine name_profile(this, number, body, profile, given)
      type(entry_type), intent(in) :: this
      !> Number of the case
      integer, intent(in) :: number
      !> "rail" or "wheel"
      character(len=*), intent(in) :: body
      type(profile_spec), intent(inout) :: profile
      type(given_profile), intent(inout) :: given
      character(len=40) :: name
      character(len=:), allocatable :: path
      character(len=50) :: point
      type(finished_file) :: file
      type(error_type), allocatable :: error
      integer :: k

      if (.not. allocated(profile%points)) then
         call relate_to_dump(profile%name, given%path)
         return
      end if
      if (.not. allocated(given%written_as)) then
         write(name, '("caddon_re", I3.3, ".", I0.4, ".", A, ".txt")') this%ire, number, body
         given%written_as = trim(name)
         call place_beside_dump(given%written_as, path)
         call file%start(path, error)
         if (.not. allocated(error)) then
            do k = 1, size(profile%points, 2)
               write(point, "(2ES25.16)") profile%points(:, k)
               call file%line(point)
            end do
            call file%finish(error)
         end if
         if (allocated(error)) call report_error(this, "the file " // path // &
            & " for the profile in the input file cannot be written")
      end if
      profile%name = given%written_as
   end subroutine name_profile
end module contact_capi_input_dump
