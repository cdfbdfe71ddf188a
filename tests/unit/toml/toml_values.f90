!> Writes the content of TOML texts, for comparison with another parser
!>
!> Usage: toml_values FILE. The file has many texts, each after a line with its length in bytes. For each text the values are
!> written depth first, one a line, strings and real numbers as hexadecimal bytes, and a line "." at the end; or "error" and why.
program toml_values
   use, intrinsic :: iso_fortran_env, only : int64
   use contact_base_error, only : error_type, full_text
   use contact_toml_document, only : toml_document, toml_kind
   use contact_toml_parser, only : parse_toml
   implicit none (type, external)
   character(len=:), allocatable :: all
   character(len=4096) :: file
   integer :: at, length, n, status, unit

   call get_command_argument(1, file)
   open(newunit=unit, file=trim(file), access="stream", form="unformatted", action="read", status="old")
   inquire(unit=unit, size=n)
   allocate(character(len=n) :: all)
   read(unit) all
   close(unit)
   at = 1
   do while (at <= n)
      length = index(all(at:), achar(10))
      read(all(at:at + length - 2), *, iostat=status) n
      if (status /= 0) error stop "no length"
      at = at + length
      call print_text(all(at:at + n - 1))
      at = at + n
      n = len(all)
   end do
   ! otherwise it belongs to the main program and is reported as a leak
   deallocate(all)

contains

   !> One text
   subroutine print_text(text)
      character(len=*), intent(in) :: text
      type(toml_document) :: document
      type(error_type), allocatable :: error

      call parse_toml(text, "text", document, error)
      if (allocated(error)) then
         write(*, "(2A)") "error ", full_text(error)
      else
         call tell_node(document, 1)
      end if
      write(*, "(A)") "."
   end subroutine print_text

   !> A node and its children
   recursive subroutine tell_node(document, index)
      type(toml_document), intent(in) :: document
      integer, intent(in) :: index
      integer :: k

      associate (node => document%nodes(index))
         if (node%parent > 0) then
            if (document%nodes(node%parent)%kind == toml_kind%table) write(*, "(2A)") "key ", hexadecimal(document%key_of(index))
         end if
         if (node%kind == toml_kind%table) then
            write(*, "(A, I0)") "table ", node%count
         else if (node%kind == toml_kind%array) then
            write(*, "(A, I0)") "array ", node%count
         else if (node%kind == toml_kind%string) then
            write(*, "(2A)") "string ", hexadecimal(document%text_of(index))
         else if (node%kind == toml_kind%integer) then
            write(*, "(A, I0)") "integer ", node%i
         else if (node%kind == toml_kind%real) then
            write(*, "(A, Z16.16)") "real ", transfer(node%r, 1_int64)
         else
            write(*, "(A, L1)") "logical ", node%l
         end if
         k = node%first
      end associate
      do while (k > 0)
         call tell_node(document, k)
         k = document%nodes(k)%next
      end do
   end subroutine tell_node

   !> The bytes of a text
   pure function hexadecimal(text) result(bytes)
      character(len=*), intent(in) :: text
      character(len=2*len(text)) :: bytes
      integer :: k

      do k = 1, len(text)
         write(bytes(2*k - 1:2*k), "(Z2.2)") iachar(text(k:k))
      end do
   end function hexadecimal
end program toml_values
