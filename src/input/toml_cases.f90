!> A file of the readable format as a sequence of cases
module contact_input_toml_cases
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : long, wp
   use contact_text_line_words, only : printable
   use contact_text_nearest, only : nearest_word
   use contact_text_words, only : integer_text, real_text
   use contact_toml_document, only : toml_document, toml_kind, toml_kind_text
   use contact_toml_parser, only : parse_toml
   implicit none (type, external)
   private

   public :: case_address, toml_cases

   !> Maximum number of a result element and of a patch
   integer(long), parameter :: highest_element = 999, highest_patch = 9
   !> Real numbers below this bound are exact as integers
   real(wp), parameter :: largest_integer = 2.0_wp**53
   !> Keys at the top level of the file
   character(len=5), parameter :: top_keys(2) = [character(len=5) :: "case", "title"]

   !> The problem to which a case belongs, and its position
   type :: case_address
      !> Module; 0 after the last case
      integer :: module_number = 0
      !> Result element, 0 for the default one, and contact patch
      integer :: reid = 0, cpid = 1
      !> First line of the case: of its control words or of its table; and last line before the next
      integer :: first_line = 0, last_line = 0
   end type case_address

   !> The cases of a file
   type :: toml_cases
      type(toml_document) :: document
      character(len=:), allocatable, private :: file
      !> Which nodes of the document have been read
      logical, allocatable :: used(:)
      !> Table of the current case, 0 before the first, and its address
      integer :: node = 0
      type(case_address), private :: address
   contains
      procedure :: open_text
      procedure :: rewind => rewind_cases
      !> Advance to the next case
      procedure :: go_on
      !> Find numbers given by the current case, and change their values
      procedure :: find_number
      procedure :: set_number
      !> Set the text of its value that messages show
      procedure :: write_number
   end type toml_cases

contains

   !> Parse a text and check its top level
   subroutine open_text(self, text, file, error)
      class(toml_cases), intent(out) :: self
      !> Text as in the file
      character(len=*), intent(in) :: text
      !> Name of the file in messages
      character(len=*), intent(in) :: file
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: key, message
      integer :: child, k, place

      self%file = file
      call parse_toml(text, file, self%document, error)
      if (allocated(error)) return
      allocate(self%used(self%document%count), source=.false.)
      k = self%document%nodes(1)%first
      do while (k > 0)
         key = self%document%key_of(k)
         associate (node => self%document%nodes(k))
            if (all(top_keys /= key)) then
               message = '"' // printable(key) // '" is outside of a case'
               place = nearest_word(key, top_keys)
               if (place > 0) message = message // '; did you mean "' // trim(top_keys(place)) // '"?'
               call fatal_error(error, message // "; a case begins with [[case]], and its groups are tables such as " // &
                  & "[case.friction]", error_kind%input, file, node%key_line, node%key_column)
               return
            end if
            if (key == "case") then
               place = merge(0, k, node%kind == toml_kind%array)
               child = node%first
               do while (child > 0 .and. place == 0)
                  if (self%document%nodes(child)%kind /= toml_kind%table) place = child
                  child = self%document%nodes(child)%next
               end do
               if (place > 0) then
                  call fatal_error(error, "case is " // trim(toml_kind_text(self%document%nodes(place)%kind)) // &
                     & "; each case begins with [[case]], in double brackets", error_kind%input, file, node%line, node%column)
                  return
               end if
            end if
            k = node%next
         end associate
      end do
      if (self%document%child(1, "case") == 0) call fatal_error(error, "there is no case; each one begins with [[case]]", &
         & error_kind%input, file)
   end subroutine open_text

   !> Return to the position before the first case
   subroutine rewind_cases(self)
      class(toml_cases), intent(inout) :: self
      type(case_address) :: start

      self%node = 0
      self%address = start
      self%used = .false.
   end subroutine rewind_cases

   !> Advance to the next case; its module, result element and patch are those of the previous one unless it gives others
   subroutine go_on(self, address, ends_module, error)
      class(toml_cases), intent(inout) :: self
      !> Module 0 if there is no further case
      type(case_address), intent(out) :: address
      !> Does the next case belong to another problem, or is there none?
      logical, intent(out) :: ends_module
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: later
      type(case_address) :: next
      integer :: following

      ends_module = .true.
      if (self%node == 0) then
         following = self%document%nodes(self%document%child(1, "case"))%first
      else
         following = self%document%nodes(self%node)%next
      end if
      if (following == 0) return
      self%node = following
      call find_address(self, following, self%address, error)
      if (allocated(error)) return
      self%address%last_line = huge(1)
      following = self%document%nodes(following)%next
      if (following > 0) then
         next = self%address
         call find_address(self, following, next, later)
         ends_module = allocated(later) .or. next%module_number /= self%address%module_number .or. &
            & next%reid /= self%address%reid .or. next%cpid /= self%address%cpid
         self%address%last_line = max(self%address%first_line, self%document%nodes(following)%line - 1)
      end if
      address = self%address
   end subroutine go_on

   !> Read the problem to which a case belongs
   subroutine find_address(self, node, address, error)
      class(toml_cases), intent(in) :: self
      integer, intent(in) :: node
      !> On entry the problem of the previous case
      type(case_address), intent(inout) :: address
      type(error_type), allocatable, intent(out) :: error
      integer :: index

      address%first_line = self%document%nodes(node)%line
      index = self%document%child(node, "module")
      if (index > 0) then
         select case (self%document%text_of(index))
         case ("3", "contact"); address%module_number = 3
         case ("1", "wheel_rail"); address%module_number = 1
         case default
            call refuse(index, 'module must be "contact" or 3, for two bodies, or "wheel_rail" or 1')
         end select
      else if (address%module_number == 0) then
         call refuse(node, 'the first case must have the key module: "contact", for two bodies, or "wheel_rail"')
      end if
      call read_integer("result_element", 0_long, highest_element, address%reid)
      call read_integer("contact_patch", 1_long, highest_patch, address%cpid)

   contains

      !> An integer within its range
      subroutine read_integer(key, lowest, highest, value)
         character(len=*), intent(in) :: key
         integer(long), intent(in) :: lowest, highest
         integer, intent(inout) :: value
         integer :: k

         k = self%document%child(node, key)
         if (k == 0 .or. allocated(error)) return
         associate (given => self%document%nodes(k))
            if (given%kind == toml_kind%integer .and. given%i >= lowest .and. given%i <= highest) then
               value = int(given%i)
            else
               call refuse(k, key // " must be an integer from " // integer_text(int(lowest)) // " to " // &
                  & integer_text(int(highest)))
            end if
         end associate
      end subroutine read_integer

      !> Problem of an invalid value
      subroutine refuse(place, message)
         integer, intent(in) :: place
         character(len=*), intent(in) :: message

         if (allocated(error)) return
         call fatal_error(error, message, error_kind%input, self%file, self%document%nodes(place)%line, &
            & self%document%nodes(place)%column)
      end subroutine refuse
   end subroutine find_address

   !> The node of a number "group.key" that the current case gives; 0 if it does not give it
   pure integer function find_number(self, name) result(index)
      !> The cases of a text
      class(toml_cases), intent(in) :: self
      !> "group.key", or "key" for a key of the case itself
      character(len=*), intent(in) :: name
      integer :: dot

      dot = index_of_dot(name)
      index = self%node
      if (dot > 0) index = self%document%child(index, name(:dot - 1))
      if (index == 0) return
      index = self%document%child(index, name(dot + 1:))
      if (index == 0) return
      if (self%document%nodes(index)%kind /= toml_kind%integer .and. self%document%nodes(index)%kind /= toml_kind%real) index = 0
   end function find_number

   !> Position of the dot between group and key, 0 if there is none
   pure integer function index_of_dot(name) result(dot)
      !> "group.key"
      character(len=*), intent(in) :: name
      dot = index(name, ".")
   end function index_of_dot

   !> Change the value of a number; a number that was written as an integer becomes real if the value is not an integer
   pure subroutine set_number(self, index, value)
      !> Cases of a text
      class(toml_cases), intent(inout) :: self
      !> Node, from find_number
      integer, intent(in) :: index
      !> Value in the unit of the key
      real(wp), intent(in) :: value

      associate (node => self%document%nodes(index))
         node%kind = toml_kind%real
         node%r = value
         if (.not. (abs(value) < largest_integer)) return
         if (abs(value - anint(value)) > 0.0_wp) return
         node%kind = toml_kind%integer
         node%i = nint(value, long)
      end associate
   end subroutine set_number

   !> Set the text of the value that messages show
   subroutine write_number(self, index)
      !> The cases of a text
      class(toml_cases), intent(inout) :: self
      !> Node, from find_number
      integer, intent(in) :: index

      associate (node => self%document%nodes(index))
         call self%document%keep(real_text(node%r), node%text_first, node%text_last)
      end associate
   end subroutine write_number
end module contact_input_toml_cases
