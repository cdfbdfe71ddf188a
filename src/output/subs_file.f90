!> The .subs file: displacements and stresses in subsurface points as a table of numbers
module contact_output_subs_file
   use contact_base_error, only : add_context, error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_output_finished_file, only : case_file_name, finished_file
   use contact_output_formats, only : general, smart, whole
   use contact_patch_result, only : patch_result, subsurface_result
   implicit none (type, external)
   private

   public :: subs_file_name, write_subs_file

   !> Value of A_s from which on the stress tensor is written
   integer, parameter :: with_tensor = 2

contains

   !> The number of a case with four digits, six from 10000 on; from a million on it is left out
   pure function case_text(case_number) result(text)
      integer, intent(in) :: case_number
      character(len=6) :: text

      text = ""
      if (case_number <= 9999) then
         write(text, "(I4.4)") case_number
      else if (case_number <= 999999) then
         write(text, "(I6.6)") case_number
      end if
   end function case_text

   !> Name of the file: <base>[_reNNN].<case>[<patch>].subs
   pure function subs_file_name(base, case_number, result_element, patch) result(name)
      !> Folder and name of the experiment
      character(len=*), intent(in) :: base
      !> From 1
      integer, intent(in) :: case_number
      !> Result element and contact patch (1 = a), 0 for none
      integer, intent(in) :: result_element, patch
      character(len=len(case_file_name(base, case_text(case_number), "subs", result_element, patch))) :: name

      name = case_file_name(base, case_text(case_number), "subs", result_element, patch)
   end function subs_file_name

   !> Write all blocks; under its name the file is complete or does not exist
   subroutine write_subs_file(file_name, spec, result, error)
      !> Path
      character(len=*), intent(in) :: file_name
      type(case_spec), intent(in) :: spec
      !> The file is not made when the subsurface blocks are unallocated
      type(patch_result), intent(in) :: result
      type(error_type), allocatable, intent(out) :: error
      type(finished_file) :: file
      integer :: i

      if (.not. allocated(result%subsurface)) return
      call file%start(file_name, error, spec%limits)
      if (allocated(error)) return
      do i = 1, size(result%subsurface)
         call write_block(file, result%subsurface(i), spec%subsurface%matfil >= with_tensor)
      end do
      call file%finish(error)
      call add_context(error, "writing the .subs file")
   end subroutine write_subs_file

   !> Sizes, names and points of one block
   subroutine write_block(file, block, tensor)
      type(finished_file), intent(in) :: file
      type(subsurface_result), intent(in) :: block
      !> Write the stress tensor too?
      logical, intent(in) :: tensor
      character(len=9), parameter :: name(14) = [character(len=9) :: "X", "Y", "Z", "UX", "UY", "UZ", "SIGHYD", "SIGVM", &
         & "SIGXX", "SIGXY", "SIGXZ", "SIGYY", "SIGYZ", "SIGZZ"]
      character(len=:), allocatable :: line, dashes
      real(wp) :: values(14)
      integer :: columns, i, point

      columns = merge(14, 8, tensor)
      dashes = ""
      line = whole(block%nx, 6) // whole(block%ny, 12) // whole(block%nz, 12) // "      "
      do i = 4, columns
         dashes = dashes // "           -"
         line = line // general(0.0_wp, 12, 4)
      end do
      call file%line("%   NX          NY          NZ" // dashes)
      call file%line(line)

      line = repeat(" ", 12*columns)
      do i = 1, columns
         line(12*i - 6:12*i) = name(i)
      end do
      line(1:1) = "%"
      call file%line(trim(line))

      do point = 1, size(block%position, 2)
         values = [block%position(:, point), block%displacement(:, point), block%sighyd(point), block%sigvm(point), &
            & block%stress(:, point)]
         do i = 1, columns
            line(12*i - 11:12*i) = smart(values(i), 12, 6, 5)
         end do
         call file%line(line)
      end do
   end subroutine write_block
end module contact_output_subs_file
