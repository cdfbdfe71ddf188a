!> Files written by tests for their own use
module contact_test_files
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: write_file, write_profile

contains

   !> A file that contains a text only
   subroutine write_file(name, text)
      character(len=*), intent(in) :: name, text
      integer :: unit

      open(newunit=unit, file=name, access="stream", form="unformatted", status="replace")
      write(unit) text
      close(unit)
   end subroutine write_file

   !> A profile as a table of y and z [mm]
   subroutine write_profile(name, y, z)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: y(:), z(:)
      integer :: unit, i

      open(newunit=unit, file=name, status="replace")
      do i = 1, size(y)
         write(unit, "(2f24.14)") y(i), z(i)
      end do
      close(unit)
   end subroutine write_profile
end module contact_test_files
