!> Results for programs: named values with units, whatever the file they go to
!>
!> One description of a case (contact_output_case_record) serves every format; a format is a child of
!> this type.
module contact_output_record
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: record_writer

   !> Takes the values of one case, in groups
   type, abstract :: record_writer
   contains
      !> Begin a group of values; groups do not nest
      procedure(open_interface), deferred :: open_group
      !> End the group
      procedure(close_interface), deferred :: close_group
      !> A real number
      procedure(number_interface), deferred :: number
      !> Several real numbers
      procedure(numbers_interface), deferred :: numbers
      !> An integer
      procedure(count_interface), deferred :: count
      !> A text
      procedure(text_interface), deferred :: text
      !> Yes or no
      procedure(flag_interface), deferred :: flag
   end type record_writer

   abstract interface
      subroutine open_interface(self, name, columns, brief)
         import :: record_writer
         class(record_writer), intent(inout) :: self
         !> Of the group
         character(len=*), intent(in) :: name
         !> Are these totals, of which a curve over the cases can be drawn? Default false
         logical, intent(in), optional :: columns
         !> May a format that keeps columns leave the numbers to them? Default false
         logical, intent(in), optional :: brief
      end subroutine open_interface

      subroutine close_interface(self)
         import :: record_writer
         class(record_writer), intent(inout) :: self
      end subroutine close_interface

      subroutine number_interface(self, name, unit, title, value)
         import :: record_writer, wp
         class(record_writer), intent(inout) :: self
         !> Name, unit ("-" for a ratio, "" where none is worth telling), and what it is
         character(len=*), intent(in) :: name, unit, title
         !> May be NaN or infinite: then there is no value
         real(wp), intent(in) :: value
      end subroutine number_interface

      subroutine numbers_interface(self, name, unit, title, values)
         import :: record_writer, wp
         class(record_writer), intent(inout) :: self
         !> Of the list; its unit, and in words what it is
         character(len=*), intent(in) :: name, unit, title
         !> In that unit
         real(wp), intent(in) :: values(:)
      end subroutine numbers_interface

      subroutine count_interface(self, name, title, value)
         import :: record_writer
         class(record_writer), intent(inout) :: self
         !> Of the integer, and in words what it is
         character(len=*), intent(in) :: name, title
         !> What is written
         integer, intent(in) :: value
      end subroutine count_interface

      subroutine text_interface(self, name, title, value)
         import :: record_writer
         class(record_writer), intent(inout) :: self
         !> Of the text; in words what it is, and the text itself
         character(len=*), intent(in) :: name, title, value
      end subroutine text_interface

      subroutine flag_interface(self, name, title, value)
         import :: record_writer
         class(record_writer), intent(inout) :: self
         !> Of the answer, and in words the question
         character(len=*), intent(in) :: name, title
         !> What is written
         logical, intent(in) :: value
      end subroutine flag_interface
   end interface
end module contact_output_record
