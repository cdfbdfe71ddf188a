!> The .subs file: displacements and stresses at subsurface points as a table of numbers
module contact_output_subs_file
   use contact_base_error, only : add_context, error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_output_finished_file, only : finished_file
   use contact_output_formats, only : general, smart, whole
   use contact_patch_result, only : patch_result, subsurface_result
   implicit none (type, external)
   private

   public :: write_subs_file

   !> Minimum value of A_s for which the stress tensor is written
   integer, parameter :: with_tensor = 2

contains

   !> Write all blocks; a file of this name is complete or does not exist
   subroutine write_subs_file(file_name, spec, result, error)
      !> Path
      character(len=*), intent(in) :: file_name
      type(case_spec), intent(in) :: spec
      !> Result; without subsurface blocks no file is written
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

   !> Write sizes, names and points of one block
   subroutine write_block(file, block, tensor)
      type(finished_file), intent(in) :: file
      type(subsurface_result), intent(in) :: block
      !> Write the stress tensor as well?
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
