!> The .mat and .subs files of wheel and rail: one per contact patch, in the coordinates of its side of the track
module contact_output_wheel_rail_files
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_control_digits, only : case_digits
   use contact_control_translation, only : digits_of
   use contact_output_finished_file, only : case_file_name
   use contact_output_mat_file, only : mat_place, write_mat_file
   use contact_output_subs_file, only : write_subs_file
   use contact_patch_quantities, only : total_list
   use contact_patch_result, only : mirrored, patch_result
   use contact_wheelrail_result, only : in_element_coordinates, wheel_rail_patch, wheel_rail_result
   implicit none (type, external)
   private

   public :: has_files, write_wheel_rail_files

contains

   !> Does a case request any of these files?
   pure logical function has_files(spec)
      !> The case: are files with all elements, or stresses, requested?
      type(case_spec), intent(in) :: spec

      has_files = spec%mat_file >= 1
      if (spec%has_stress) has_files = has_files .or. spec%subsurface%matfil >= 1
   end function has_files

   !> Write the files requested by the case; stops at the first error
   subroutine write_wheel_rail_files(base, case_number, result_element, spec, result, error, time)
      !> Folder and name of the experiment
      character(len=*), intent(in) :: base
      !> Number of the case; result element, 0: none
      integer, intent(in) :: case_number, result_element
      type(case_spec), intent(in) :: spec
      !> Result of a solved case
      type(wheel_rail_result), intent(in) :: result
      type(error_type), allocatable, intent(out) :: error
      !> Time of the case, for the header [s]; default 0
      real(wp), intent(in), optional :: time
      type(patch_result) :: mirror
      integer :: k

      do k = 1, size(result%patches)
         associate (patch => result%patches(k))
            if (spec%mat_file >= 1) then
               if (spec%wheel_rail%left) then
                  mirror = mirrored(in_element_coordinates(patch))
                  call write_mat_file(case_file_name(base, case_number, "mat", result_element, 1, k), spec, mirror, &
                     & result%status, error, place_of(spec, result, patch, k, time))
               else
                  call write_mat_file(case_file_name(base, case_number, "mat", result_element, 1, k), spec, &
                     & in_element_coordinates(patch), result%status, error, place_of(spec, result, patch, k, time))
               end if
               if (allocated(error)) return
            end if
            if (spec%has_stress .and. spec%subsurface%matfil >= 1 .and. allocated(patch%contact%subsurface)) then
               call write_subs_file(case_file_name(base, case_number, "subs", result_element, 1, k), spec, patch%contact, error)
               if (allocated(error)) return
            end if
         end associate
      end do
   end subroutine write_wheel_rail_files

   !> Position of the patch
   pure function place_of(spec, result, patch, number, time) result(place)
      type(case_spec), intent(in) :: spec
      type(wheel_rail_result), intent(in) :: result
      type(wheel_rail_patch), intent(in) :: patch
      integer, intent(in) :: number
      real(wp), intent(in), optional :: time
      type(mat_place) :: place
      type(case_digits) :: digits
      type(total_list) :: totals, markers

      digits = digits_of(spec)
      call patch%totals(totals, spec%wheel_rail%left)
      call result%markers(spec%wheel_rail%left, markers)
      associate (w => spec%wheel_rail%wheelset, roller => spec%wheel_rail%roller)
         place%rail = [0.0_wp, merge(0.0_wp, w%s, roller), w%pitch, markers%of([character(len=6) :: "y_r", "z_r", "roll_r"]), &
            & merge(spec%wheel_rail%track%nomradr, 0.0_wp, roller)]
         place%wheel = [markers%of([character(len=6) :: "x_w", "y_w", "z_w", "roll_w", "yaw_w"]), w%nomradw]
      end associate
      place%reference = totals%of([character(len=8) :: "xcp_tr", "ycp_r", "zcp_r", "deltcp_r", "xcp_w", "ycp_w", "zcp_w"])
      place%spin_centre = totals%of(["x_elem", "y_elem"])
      if (present(time)) place%rail(1) = time
      place%patches = size(result%patches)
      place%patch = number
      place%c1 = digits%c1
      place%d = spec%wheel_rail%search%location
      place%wheel_offset = result%wheel_offset
   end function place_of
end module contact_output_wheel_rail_files
