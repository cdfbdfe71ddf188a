!> Conversion of values of the readable format to numbers and texts of a case: kinds, units, bounds, lengths of lists
module contact_input_toml_values
   use contact_base_kinds, only : wp
   use contact_cases_archive, only : archive_item, item_kind
   use contact_input_problems, only : severity
   use contact_input_toml_tables, only : leaves_of, list_of, sets_of, toml_tables
   use contact_text_bounds, only : bounds_of, bounds_table, describe_breach, is_within, unit_of
   use contact_text_line_words, only : printable
   use contact_toml_document, only : toml_kind
   use contact_toml_quantities, only : read_quantity
   implicit none (type, external)
   private

   public :: check_item, count_values, fill_list, set_number

contains

   !> Check the bounds of the value of an item
   subroutine check_item(self, item, key, node, bounds)
      class(toml_tables), intent(inout) :: self
      !> Item with its value
      type(archive_item), intent(in) :: item
      !> Key as written in the file
      character(len=*), intent(in) :: key
      !> Index of the value in the tree of the document
      integer, intent(in) :: node
      !> Name of the bounds in the table; default: that of the item
      character(len=*), intent(in), optional :: bounds
      character(len=:), allocatable :: complaint, name
      real(wp) :: value

      name = trim(item%name)
      if (present(bounds)) name = bounds
      if (associated(item%r)) value = item%r
      if (associated(item%i)) value = real(item%i, wp)
      if (is_within(bounds_of(name), value)) return
      if (node > 0) then
         call describe_breach(name, printable(self%document%text_of(node)), value, complaint, key)
      else
         call describe_breach(name, "", value, complaint, key)
      end if
      if (allocated(complaint)) call self%add_problem(severity%error, node, complaint)
   end subroutine check_item

   !> Determine lengths of lists from the lists; -1 for items that are not a length, or without a list
   subroutine count_values(self, name, number)
      class(toml_tables), intent(inout) :: self
      !> Name of the item
      character(len=*), intent(in) :: name
      !> Number of values in the list
      integer, intent(out) :: number
      integer :: array, per, option

      number = -1
      array = 0
      per = 1
      option = 0
      select case (name)
      case ("NN")
         if (self%group == "influence") then
            array = list_of(self, "inclinations")
            per = 2
         else
            array = list_of(self, "b")
         end if
      case ("NP")
         array = list_of(self, "rectangles")
         per = 4
      case ("NVF"); array = sets_of(self)
      case ("NX")
         array = list_of(self, "ix")
         if (array == 0) array = list_of(self, "x")
      case ("NY")
         array = list_of(self, "iy")
         if (array == 0) array = list_of(self, "y")
      case ("NZ"); array = list_of(self, "z")
      case ("PRFOPT")
         if (list_of(self, "ismooth") + list_of(self, "zigthrs") + list_of(self, "kinkhigh") + list_of(self, "kinklow") + &
            & list_of(self, "kinkwid") > 0) option = 1
         if (list_of(self, "errhnd") + list_of(self, "maxomit") > 0) option = 2
         number = option
         return
      end select
      if (array == 0) return
      if (name == "NVF") then
         number = self%document%nodes(array)%count
      else
         number = leaves_of(self%document, array)/per
      end if
   end subroutine count_values

   !> Set an item from a value of the required kind
   subroutine set_number(self, item, index, complaint)
      class(toml_tables), intent(in) :: self
      !> Item whose value is set
      type(archive_item), intent(inout) :: item
      !> Index of the value in the tree of the document
      integer, intent(in) :: index
      !> Reason why the value cannot be used; unallocated if it can
      character(len=:), allocatable, intent(out) :: complaint
      character(len=:), allocatable :: unit
      real(wp) :: value

      associate (node => self%document%nodes(index))
         if (item%kind == item_kind%text) then
            if (node%kind == toml_kind%string) then
               item%s%value = self%document%text_of(index)
               if (index_of_control(item%s%value) > 0) complaint = "has a control character"
            else
               complaint = "must be a text in quotes"
            end if
            return
         end if
         unit = "-"
         if (item%row > 0) unit = trim(unit_of(item%row, self%moves))
         select case (node%kind)
         case (toml_kind%integer, toml_kind%real)
            value = node%r
         case (toml_kind%string)
            call read_quantity(self%document%text_of(index), unit, value, complaint)
            if (allocated(complaint)) return
         case default
            complaint = "must be a number"
            return
         end select
         if (item%kind == item_kind%integer .or. item%kind == item_kind%branch) then
            if (abs(value - anint(value)) > 0.0_wp .or. node%kind == toml_kind%string) then
               complaint = "must be an integer"
            else if (abs(value) > huge(item%i)) then
               complaint = "is too large for an integer"
            else
               item%i = nint(value)
            end if
         else
            item%r = value
         end if
      end associate
   end subroutine set_number

   !> Position of the first control character, 0: none
   pure integer function index_of_control(text) result(k)
      character(len=*), intent(in) :: text

      do k = 1, len(text)
         if (iachar(text(k:k)) < 32 .or. iachar(text(k:k)) == 127) return
      end do
      k = 0
   end function index_of_control

   !> Numbers of an array, including nested arrays
   recursive subroutine fill_list(self, array, key, row, values, filled, units)
      class(toml_tables), intent(inout) :: self
      !> Index of the array in the tree of the document
      integer, intent(in) :: array
      !> Key as written in the file
      character(len=*), intent(in) :: key
      !> Row of the bounds in the table
      integer, intent(in) :: row
      !> Values in internal units; those that are missing in the array are unchanged
      real(wp), intent(inout) :: values(:)
      !> Number of values read so far
      integer, intent(inout) :: filled
      !> Internal unit of each component, if they differ
      character(len=*), intent(in), optional :: units(:)
      character(len=:), allocatable :: complaint, unit
      integer :: k

      k = self%document%nodes(array)%first
      do while (k > 0 .and. self%is_good)
         associate (node => self%document%nodes(k))
            select case (node%kind)
            case (toml_kind%array)
               call fill_list(self, k, key, row, values, filled, units)
            case (toml_kind%integer, toml_kind%real, toml_kind%string)
               filled = filled + 1
               values(filled) = node%r
               if (node%kind == toml_kind%string) then
                  unit = "mm"
                  if (present(units)) then
                     unit = trim(units(modulo(filled - 1, size(units)) + 1))
                  else if (index(bounds_table(row)%unit, " or ") > 0) then
                     unit = trim(unit_of(row, self%moves))
                  end if
                  call read_quantity(self%document%text_of(k), unit, values(filled), complaint)
               end if
               if (.not. allocated(complaint) .and. .not. is_within(row, values(filled))) call describe_breach( &
                  & trim(bounds_table(row)%name), self%document%text_of(k), values(filled), complaint, key)
            case default
               complaint = "must be a number"
            end select
            if (allocated(complaint)) then
               call self%add_problem(severity%error, k, key // ": " // complaint)
               self%is_good = .false.
            end if
            k = node%next
         end associate
      end do
   end subroutine fill_list
end module contact_input_toml_values
