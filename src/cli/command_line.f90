!> Words of the command line in their full length
module contact_cli_command_line
   implicit none (type, external)
   private

   public :: take_word

contains

   subroutine take_word(k, word)
      !> 1...command_argument_count()
      integer, intent(in) :: k
      !> In its full length
      character(len=:), allocatable, intent(out) :: word
      integer :: length

      call get_command_argument(k, length=length)
      allocate(character(len=length) :: word)
      if (length > 0) call get_command_argument(k, word)
   end subroutine take_word
end module contact_cli_command_line
