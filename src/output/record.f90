!> Results for other programs: named values with units, independent of the file format
!>
!> One description of a case (contact_output_case_record) serves all formats; a format is an extension of this type.
module contact_output_record
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: item_kind, named_value, record_writer

   !> Maximum length of a name, unit, description [characters]
   integer, parameter, public :: name_length = 32
   integer, parameter :: unit_length = 36, title_length = 104

   type :: item_kind_list
      integer :: real_number = 1, real_numbers = 2, whole = 3, text = 4, flag = 5
   end type item_kind_list
   !> Kinds of values
   type(item_kind_list), parameter :: item_kind = item_kind_list()

   !> One named value
   type :: named_value
      !> Name, unit ("-" for a ratio, "" for none), and description
      character(len=name_length) :: name
      character(len=unit_length) :: unit
      character(len=title_length) :: title
      !> Member of item_kind
      integer :: kind = 0
      !> Value of a real number, undefined if NaN or infinite; of an integer or a flag (1 or 0)
      real(wp) :: value = 0.0_wp
      !> Values of several numbers
      real(wp), allocatable :: values(:)
      !> Value of a text
      character(len=:), allocatable :: text
   end type named_value

   !> Receives the values of one case, in groups
   type, abstract :: record_writer
   contains
      !> Begin a group of values; groups do not nest
      procedure(open_interface), deferred :: open_group
      !> End the group
      procedure(close_interface), deferred :: close_group
      !> Receive a value
      procedure(item_interface), deferred :: write_item
      !> Receive a real number, several real numbers, an integer, a text, a flag
      procedure :: number
      procedure :: numbers
      procedure :: count => whole_number
      procedure :: text
      procedure :: flag
   end type record_writer

   abstract interface
      subroutine open_interface(self, name, columns, brief)
         import :: record_writer
         class(record_writer), intent(inout) :: self
         !> Name of the group
         character(len=*), intent(in) :: name
         !> Are these totals, of which curves over the cases can be drawn? Default: false
         logical, intent(in), optional :: columns
         !> May a format that stores columns omit the numbers from the group? Default: false
         logical, intent(in), optional :: brief
      end subroutine open_interface

      subroutine close_interface(self)
         import :: record_writer
         class(record_writer), intent(inout) :: self
      end subroutine close_interface

      subroutine item_interface(self, item)
         import :: named_value, record_writer
         class(record_writer), intent(inout) :: self
         !> A value of the current group, or of the case itself
         type(named_value), intent(in) :: item
      end subroutine item_interface
   end interface

contains

   !> Receive a real number
   subroutine number(self, name, unit, title, value)
      class(record_writer), intent(inout) :: self
      !> See named_value
      character(len=*), intent(in) :: name, unit, title
      !> Value in that unit
      real(wp), intent(in) :: value

      call self%write_item(named_value(name, unit, title, item_kind%real_number, value))
   end subroutine number

   !> Receive several real numbers
   subroutine numbers(self, name, unit, title, values)
      class(record_writer), intent(inout) :: self
      !> See named_value
      character(len=*), intent(in) :: name, unit, title
      !> Values in that unit
      real(wp), intent(in) :: values(:)
      type(named_value) :: item

      item = named_value(name, unit, title, item_kind%real_numbers)
      ! gfortran 12 ignores strides in a constructor
      item%values = values
      call self%write_item(item)
   end subroutine numbers

   !> Receive an integer
   subroutine whole_number(self, name, title, value)
      class(record_writer), intent(inout) :: self
      !> See named_value
      character(len=*), intent(in) :: name, title
      !> Value to be written
      integer, intent(in) :: value

      call self%write_item(named_value(name, "", title, item_kind%whole, real(value, wp)))
   end subroutine whole_number

   !> Receive a text
   subroutine text(self, name, title, value)
      class(record_writer), intent(inout) :: self
      !> See named_value; and the text itself
      character(len=*), intent(in) :: name, title, value

      call self%write_item(named_value(name, "", title, item_kind%text, text=value))
   end subroutine text

   !> Receive a flag
   subroutine flag(self, name, title, value)
      class(record_writer), intent(inout) :: self
      !> See named_value
      character(len=*), intent(in) :: name, title
      !> Value to be written
      logical, intent(in) :: value

      call self%write_item(named_value(name, "", title, item_kind%flag, merge(1.0_wp, 0.0_wp, value)))
   end subroutine flag
end module contact_output_record
