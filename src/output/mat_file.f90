!> The .mat file: tractions, displacements and slip per element as a table of numbers
!>
!> Loaders skip lines that start with % and need the same number of columns on all others.
module contact_output_mat_file
   use contact_base_choices, only : friction_model, material_model, motion
   use contact_base_error, only : add_context, error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec, friction_set
   use contact_grid_element_division, only : element
   use contact_output_finished_file, only : case_file_name, finished_file
   use contact_output_formats, only : general, printable, whole
   use contact_output_report_result, only : has_plasticity
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: mat_file_name, write_mat_file

   !> Number of the layout; readers refuse larger numbers
   integer, parameter :: layout = 2410
   !> Number of columns without plasticity and heat
   integer, parameter :: columns = 11
   !> Value of A from which on all elements are written
   integer, parameter :: all_elements = 2

contains

   !> Name of the file: <base>[_reNNN].<case, at least four digits>[<patch>].mat
   pure function mat_file_name(base, case_number, result_element, patch) result(name)
      !> Folder and name of the experiment
      character(len=*), intent(in) :: base
      integer, intent(in) :: case_number
      !> Result element, absent or 0 for none; contact patch (1 = a), absent or 0 for none
      integer, intent(in), optional :: result_element, patch
      character(len=:), allocatable :: name
      character(len=12) :: number

      write(number, '(i0.4)') case_number
      name = case_file_name(base, number, "mat", result_element, patch)
   end function mat_file_name

   !> Write the file of a solved case; under its name it is complete or does not exist
   subroutine write_mat_file(file_name, spec, result, error)
      character(len=*), intent(in) :: file_name
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      type(error_type), allocatable, intent(out) :: error
      type(finished_file) :: file
      integer :: status

      if (has_plasticity(spec) .or. spec%digits%h >= 1 .or. spec%material_model == material_model%fastsim &
         & .or. spec%material_model == material_model%fastrip) then
         call fatal_error(error, "the .mat file cannot hold plasticity, temperature or simplified theory in this version", &
            & error_kind%unsupported, file=file_name)
         return
      end if
      call file%start(file_name, error)
      if (allocated(error)) return
      call write_header(file%unit, spec, result, status)
      if (status == 0) call write_elements(file%unit, spec, result, status)
      call file%finish(status, error)
      call add_context(error, "writing the .mat file")
   end subroutine write_mat_file

   !> Six pairs of a line with names and a line with values, then the names of the table columns
   subroutine write_header(unit, spec, result, status)
      integer, intent(in) :: unit
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      !> 0 or the status of the write statement that failed
      integer, intent(out) :: status
      real(wp) :: chi, dq
      logical :: rolling

      rolling = spec%motion == motion%transient_rolling .or. spec%motion == motion%steady_rolling
      chi = merge(result%chi, 0.0_wp, rolling)
      dq = merge(result%dq, 1.0_wp, rolling)

      call pair([character(len=11) :: "TIM", "S_WS(FC)", "TH_WS(FC)", "Y_R(TR)", "Z_R(TR)", "ROLL_R(TR)", "RNOM_ROL", &
         & "-", "-", "-", "FMT"], reals(spread(0.0_wp, 1, 7)) // integers([0, 0, 0, layout]))
      call pair([character(len=11) :: "X_W(TR)", "Y_W(TR)", "Z_W(TR)", "ROLL_W(TR)", "YAW_W(TR)", "RNOM_WHL", &
         & "-", "-", "-", "-", "-"], reals(spread(0.0_wp, 1, columns)))
      call pair([character(len=11) :: "X_CP(R)", "Y_CP(R)", "Z_CP(R)", "DELT_CP(R)", "X_CP(W)", "Y_CP(W)", "Z_CP(W)", &
         & "NPATCH", "IPATCH", "SPINXO", "SPINYO"], reals(spread(0.0_wp, 1, 7)) // integers([0, 0]) &
         & // reals([spec%kinematics%spinxo, spec%kinematics%spinyo]))
      call pair([character(len=11) :: "MX   MY", "XL", "YL", "DX", "DY", "CHI", "DQ", "C1", "D", "YNOM_WHL"], &
         & two_integers(result%grid%mx, result%grid%my) // reals([result%grid%xl, result%grid%yl, result%grid%dx, &
         & result%grid%dy, chi, dq]) // integers([0, 2]) // reals([0.0_wp]))
      call material_pair()
      call friction_pair()
      if (status == 0) call put(names_line([character(len=11) :: "I    IGS", "H", "MU", "PN", "PX", "PY", "UN", "UX", &
         & "UY", merge("SREL", "SHFT", rolling)]))

   contains

      subroutine put(line)
         character(len=*), intent(in) :: line
         write(unit, '(a)', iostat=status) trim(line)
      end subroutine put

      !> Names, then values; nothing after a failure
      subroutine pair(names, values)
         character(len=*), intent(in) :: names(:), values
         if (spec_started(names(1))) status = 0
         if (status == 0) call put(names_line(names))
         if (status == 0) call put(values)
      end subroutine pair

      pure logical function spec_started(name)
         character(len=*), intent(in) :: name
         spec_started = name == "TIM"
      end function spec_started

      subroutine material_pair()
      end subroutine material_pair

      subroutine friction_pair()
      end subroutine friction_pair
   end subroutine write_header
end module contact_output_mat_file
