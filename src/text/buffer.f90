!> A text that grows at its end in a time that does not depend on its length
module contact_text_buffer
   implicit none (type, external)
   private

   public :: text_buffer

   !> The first `length` characters of `letters` count
   type :: text_buffer
      integer :: length = 0
      character(len=:), allocatable :: letters
   contains
      procedure :: add
      procedure :: add_line
      procedure :: get
   end type text_buffer

contains

   !> Add a piece
   subroutine add(self, piece)
      class(text_buffer), intent(inout) :: self
      !> Goes behind what is there
      character(len=*), intent(in) :: piece
      integer, parameter :: first_length = 1000
      character(len=:), allocatable :: longer

      if (.not. allocated(self%letters)) allocate(character(len=first_length) :: self%letters)
      if (self%length + len(piece) > len(self%letters)) then
         allocate(character(len=2*(self%length + len(piece))) :: longer)
         longer(:self%length) = self%letters(:self%length)
         call move_alloc(longer, self%letters)
      end if
      self%letters(self%length + 1:self%length + len(piece)) = piece
      self%length = self%length + len(piece)
   end subroutine add

   !> Add a line with its end
   subroutine add_line(self, line)
      class(text_buffer), intent(inout) :: self
      !> Without its end
      character(len=*), intent(in) :: line

      call self%add(line)
      call self%add(achar(10))
   end subroutine add_line

   !> The text
   subroutine get(self, text)
      class(text_buffer), intent(in) :: self
      !> All that was added
      character(len=:), allocatable, intent(out) :: text

      text = ""
      if (self%length > 0) text = self%letters(:self%length)
   end subroutine get
end module contact_text_buffer
