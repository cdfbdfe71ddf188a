!> Words of the command line in full length
module contact_cli_command_line
   implicit none (type, external)
   private

   public :: get_word

contains

   subroutine get_word(k, word)
      !> Index, 1...command_argument_count()
      integer, intent(in) :: k
      !> Word in full length
      character(len=:), allocatable, intent(out) :: word
      integer :: length

      call get_command_argument(k, length=length)
      allocate(character(len=length) :: word)
      if (length > 0) call get_command_argument(k, word)
   end subroutine get_word
end module contact_cli_command_line
