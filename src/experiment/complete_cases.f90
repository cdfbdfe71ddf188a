!> Cases with all their input, including what they keep from earlier cases, in the readable format
module contact_experiment_complete_cases
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_parts, case_spec, part_source
   use contact_experiment_input_cases, only : next_valid_case, open_cases
   use contact_input_experiment_file, only : experiment_reader, input_case
   use contact_output_toml_case_writer, only : toml_experiment_writer
   use contact_text_buffer, only : text_buffer
   implicit none (type, external)
   private

   public :: list_complete_cases

contains

   !> Write each case as if it were the only one of its experiment
   subroutine list_complete_cases(experiment, cases, error)
      !> Name of the experiment, with or without suffix
      character(len=*), intent(in) :: experiment
      !> Receives the cases in the readable format, unless the input is invalid; numbers with preset values are left out
      type(text_buffer), intent(inout) :: cases
      !> Allocated if the input is invalid
      type(error_type), allocatable, intent(out) :: error
      type(experiment_reader) :: reader
      type(input_case) :: this
      type(text_buffer) :: written
      character(len=:), allocatable :: input, text
      logical :: is_case

      call open_cases(experiment, reader, input, error)
      do while (.not. allocated(error))
         call next_valid_case(reader, this, is_case, error)
         if (.not. is_case) exit
         call write_alone(this, text)
         call written%add(text)
      end do
      if (allocated(error)) return
      call written%get(text)
      call cases%add(text)
   end subroutine list_complete_cases

   !> Write a case that gives all of its input
   subroutine write_alone(this, text)
      type(input_case), intent(in) :: this
      character(len=:), allocatable, intent(out) :: text
      type(toml_experiment_writer) :: writer
      type(case_spec) :: spec

      spec = this%spec
      spec%parts = case_parts()
      if (allocated(spec%wheel_rail)) then
         ! flexible deviations are kept until others are given
         associate (wheelset => spec%wheel_rail%wheelset)
            if (.not. any(abs([wheelset%flexible, wheelset%flexible_rate]) > 0.0_wp)) &
               & spec%parts%flexibility = part_source%kept
         end associate
      end if
      call writer%add_case(this%module_number, this%reid, this%cpid, spec, "")
      call writer%text%get(text)
   end subroutine write_alone
end module contact_experiment_complete_cases
