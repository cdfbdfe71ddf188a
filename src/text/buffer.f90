!> A text buffer that grows in amortised constant time
module contact_text_buffer
   implicit none (type, external)
   private

   public :: text_buffer

   !> The first `length` characters of `letters` are in use
   type :: text_buffer
      integer :: length = 0
      character(len=:), allocatable :: letters
   contains
      procedure :: add
      procedure :: add_line
      procedure :: get
   end type text_buffer

contains

   !> Append a piece of text
   subroutine add(self, piece)
      class(text_buffer), intent(inout) :: self
      !> Text to append
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

   !> Append a line with its line end
   subroutine add_line(self, line)
      class(text_buffer), intent(inout) :: self
      !> Line without line end
      character(len=*), intent(in) :: line

      call self%add(line)
      call self%add(achar(10))
   end subroutine add_line

   !> The text
   subroutine get(self, text)
      class(text_buffer), intent(in) :: self
      !> Complete text
      character(len=:), allocatable, intent(out) :: text

      text = ""
      if (self%length > 0) text = self%letters(:self%length)
   end subroutine get
end module contact_text_buffer
