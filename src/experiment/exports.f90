!> Optional output files of a run for other programs
module contact_experiment_exports
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_limits, only : case_limits
   use contact_cases_wheel_rail_session, only : wheel_rail_session
   use contact_cases_spec, only : case_spec
   use contact_experiment_journal, only : checkpoint
   use contact_experiment_place, only : experiment_place
   use contact_hdf5_case_file, only : hdf5_case_file
   use contact_output_case_record, only : case_head, run_summary
   use contact_output_json_file, only : json_file
   use contact_output_vtk_bodies, only : body_profile, get_section
   use contact_output_vtk_files, only : vtk_files
   use contact_patch_result, only : patch_result
   use contact_profile_curve, only : profile_curve
   use contact_wheelrail_result, only : wheel_rail_result
   implicit none (type, external)
   private

   public :: export_request, export_files, number_of_exports

   !> Number of kinds of files
   integer, parameter :: number_of_exports = 3

   !> Requested files
   type :: export_request
      !> Totals as JSON lines: "" for the file EXPNAM.jsonl, "-" for the standard output; unallocated: none
      character(len=:), allocatable :: json
      !> Write all results to the HDF5 file EXPNAM.h5?
      logical :: hdf5 = .false.
      !> Write surfaces and subsurface blocks as VTK files with the collection EXPNAM.pvd?
      logical :: vtk = .false.
   contains
      !> Is any file requested?
      procedure :: any => is_any_requested
   end type export_request

   !> Open files; unallocated components were not requested
   type :: export_files
      type(json_file), allocatable :: json
      type(hdf5_case_file), allocatable :: hdf5
      type(vtk_files), allocatable :: vtk
   contains
      procedure :: open_files
      procedure :: close_file
      procedure :: record_ends
      !> Is any file open?
      procedure :: has_any
      procedure :: write_failure
      procedure :: write_contact
      procedure :: write_wheel_rail
   end type export_files

contains

   pure logical function is_any_requested(self)
      class(export_request), intent(in) :: self
      is_any_requested = allocated(self%json) .or. self%hdf5 .or. self%vtk
   end function is_any_requested

   pure logical function has_any(self)
      class(export_files), intent(in) :: self
      has_any = allocated(self%json) .or. allocated(self%hdf5) .or. allocated(self%vtk)
   end function has_any

   !> Open the requested files
   subroutine open_files(self, request, place, version, run, limits, error, from)
      class(export_files), intent(inout) :: self
      !> Requested files
      type(export_request), intent(in) :: request
      !> Location of input and results
      type(experiment_place), intent(in) :: place
      !> Version of the program
      character(len=*), intent(in) :: version
      !> Planned cases
      type(run_summary), intent(in) :: run
      !> As for open_result
      type(case_limits), intent(in) :: limits
      type(error_type), allocatable, intent(out) :: error
      !> Checkpoint from which the run continues
      type(checkpoint), intent(in), optional :: from

      if (present(from)) then
         call continue_files(self, request, place, run, from, limits, error)
         return
      end if
      if (allocated(request%json)) then
         allocate(self%json)
         if (request%json == "-") then
            call self%json%open_file("-", run%planned, limits, error)
         else
            call self%json%open_file(place%results // ".jsonl", run%planned, limits, error)
         end if
         if (allocated(error)) return
      end if
      if (request%hdf5) then
         allocate(self%hdf5)
         call self%hdf5%open_file(place%results // ".h5", place%name, version, place%input, place%folder, run, limits, error)
         if (allocated(error)) return
      end if
      if (request%vtk) then
         allocate(self%vtk)
         call self%vtk%open_collection(place%results, run, limits, error)
      end if
   end subroutine open_files

   !> Continue existing files; the HDF5 file is open already
   subroutine continue_files(self, request, place, run, from, limits, error)
      type(export_files), intent(inout) :: self
      type(export_request), intent(in) :: request
      !> Location of input and results
      type(experiment_place), intent(in) :: place
      type(run_summary), intent(in) :: run
      type(checkpoint), intent(in) :: from
      type(case_limits), intent(in) :: limits
      type(error_type), allocatable, intent(out) :: error

      if (allocated(request%json)) then
         allocate(self%json)
         call self%json%open_file(place%results // ".jsonl", run%planned, limits, error, from%json)
         if (allocated(error)) return
      end if
      if (allocated(self%hdf5)) then
         call self%hdf5%go_on(from%rows(1), from%rows(2), place%input, place%folder, run, limits, error)
         if (allocated(error)) return
      end if
      if (request%vtk) then
         allocate(self%vtk)
         call self%vtk%open_collection(place%results, run, limits, error, from%vtk)
      end if
   end subroutine continue_files

   !> Record the current ends of the files
   subroutine record_ends(self, here)
      class(export_files), intent(in) :: self
      !> Receives the size of each file in bytes
      type(checkpoint), intent(inout) :: here

      if (allocated(self%json)) here%json = self%json%place()
      if (allocated(self%hdf5)) here%rows = [self%hdf5%rows(patch=.false.), self%hdf5%rows(patch=.true.)]
      if (allocated(self%vtk)) here%vtk = self%vtk%place()
   end subroutine record_ends

   !> Record the progress of the run in a file, and close it
   subroutine close_file(self, which, run, error)
      class(export_files), intent(inout) :: self
      !> 1...number_of_exports; does nothing for a file that was not requested
      integer, intent(in) :: which
      type(run_summary), intent(in) :: run
      type(error_type), allocatable, intent(out) :: error

      if (which == 1 .and. allocated(self%json)) then
         call self%json%write_end(run)
         call self%json%close_file(error)
      else if (which == 2 .and. allocated(self%hdf5)) then
         call self%hdf5%close_file(run, error)
      else if (which == 3 .and. allocated(self%vtk)) then
         call self%vtk%close_collection(run, error)
      end if
   end subroutine close_file

   !> Write a case without result
   subroutine write_failure(self, head)
      class(export_files), intent(inout) :: self
      type(case_head), intent(in) :: head

      if (allocated(self%json)) call self%json%write_case(head)
      if (allocated(self%hdf5)) call self%hdf5%write_case(head)
   end subroutine write_failure

   !> Write a solved case of module 3
   subroutine write_contact(self, head, given, spec, contact, error)
      class(export_files), intent(inout) :: self
      type(case_head), intent(in) :: head
      !> The case as given and as solved
      type(case_spec), intent(in) :: given, spec
      type(patch_result), intent(in) :: contact
      type(error_type), allocatable, intent(out) :: error

      if (allocated(self%json)) call self%json%write_case(head, spec, contact)
      if (allocated(self%hdf5)) call self%hdf5%write_case(head, given, spec, contact)
      if (allocated(self%vtk)) call self%vtk%write_contact(head, spec, contact, error)
   end subroutine write_contact

   !> Write a solved case of module 1
   subroutine write_wheel_rail(self, head, given, spec, session, pair, error)
      class(export_files), intent(inout) :: self
      type(case_head), intent(in) :: head
      !> The case as given and as solved
      type(case_spec), intent(in) :: given, spec
      !> Session with the profiles
      type(wheel_rail_session), target, intent(in) :: session
      type(wheel_rail_result), intent(in) :: pair
      type(error_type), allocatable, intent(out) :: error
      type(profile_curve), allocatable :: rail, wheel
      ! position of the first contact on rail and wheel, along the track [mm]
      real(wp) :: place(2)
      type(body_profile) :: bodies(2)

      if (allocated(self%vtk)) then
         bodies(1)%profile => session%problem%rail
         bodies(2)%profile => session%problem%wheel
         if (allocated(session%problem%rail_surface)) bodies(1)%surface => session%problem%rail_surface
         if (allocated(session%problem%wheel_surface)) bodies(2)%surface => session%problem%wheel_surface
         call self%vtk%write_wheel_rail(head, spec, pair, bodies(1), bodies(2), error)
      end if
      if (allocated(self%json)) call self%json%write_case(head, spec, pair=pair)
      if (.not. allocated(self%hdf5)) return
      associate (problem => session%problem, w => spec%wheel_rail%wheelset)
         place = 0.0_wp
         if (size(pair%patches) > 0) place = [pair%patches(1)%x, pair%patches(1)%x_wheel]
         call get_section(problem%rail, problem%rail_surface, w%s + place(1), rail)
         call get_section(problem%wheel, problem%wheel_surface, &
            & asin(min(1.0_wp, max(-1.0_wp, place(2)/w%nomradw))) - w%pitch_of_wheel(), wheel)
         call self%hdf5%write_case(head, given, spec, pair=pair, rail=rail, wheel=wheel)
      end associate
   end subroutine write_wheel_rail
end module contact_experiment_exports
