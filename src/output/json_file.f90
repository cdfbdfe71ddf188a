!> Totals of every case as JSON lines: one object per case and line, RFC 8259 in UTF-8
!>
!> A number with a unit is an object with "value" and "unit"; a number that is not finite is null. Lines are written as a whole, so
!> a truncated file has all cases but the last. Each line has the planned number of cases, and the last line states whether all are
!> finished.
module contact_output_json_file
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use, intrinsic :: iso_c_binding, only : c_char, c_double, c_int
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : long, wp
   use contact_base_limits, only : case_limits
   use contact_base_output_file, only : output_file
   use contact_cases_spec, only : case_spec
   use contact_output_case_record, only : case_head, describe_head, describe_wheel_rail, describe_patch, describe_run, run_summary
   use contact_output_finished_file, only : close_result, open_result, open_result_again
   use contact_output_record, only : item_kind, named_value, record_writer
   use contact_patch_result, only : patch_result
   use contact_text_words, only : integer_text
   use contact_wheelrail_result, only : wheel_rail_patch, wheel_rail_result
   implicit none (type, external)
   private

   public :: json_file, number_text

   !> Maximum length of a number: sign, 17 digits, decimal point, exponent
   integer, parameter :: longest_number = 32
   !> Most digits of a number
   integer, parameter :: most_digits = 17
   integer, parameter :: first_length = 4096

   !> A file of JSON lines, or standard output
   type, extends(record_writer) :: json_file
      type(output_file), private :: file
      character(len=:), allocatable :: name
      !> Number of cases of the input, written on each line
      integer, private :: planned = 0
      !> The current line: its first `length` characters
      character(len=:), allocatable, private :: line
      integer, private :: length = 0
      !> Is a comma needed before the next member?
      logical, private :: follows = .false.
   contains
      procedure :: open_file => open_json_file
      procedure :: close_file => close_json_file
      procedure :: place
      !> Write the last line: the progress of the run
      procedure :: write_end
      procedure :: write_case
      procedure :: open_group => open_object
      procedure :: close_group => close_object
      procedure :: write_item => write_value
      procedure, private :: key
      procedure, private :: add
      procedure, private :: add_quoted
      procedure, private :: end_line
   end type json_file

   interface
      !> Decimal digits of a number, the fewest of 15, 16 and 17 that are read back as the same number
      pure subroutine number_digits(value, digits, exponent) bind(c, name="contact_number_digits")
         import :: c_char, c_double, c_int, most_digits
         !> Finite and positive
         real(c_double), value :: value
         !> most_digits digits, the last ones may be zeros
         character(kind=c_char), intent(out) :: digits(most_digits)
         !> Exponent of the first digit
         integer(c_int), intent(out) :: exponent
      end subroutine number_digits
   end interface

contains

   !> Open a file; standard output if the name is "-"
   subroutine open_json_file(self, name, planned, limits, error, place)
      class(json_file), intent(inout) :: self
      !> Path of the file
      character(len=*), intent(in) :: name
      !> Number of cases of the input
      integer, intent(in) :: planned
      type(case_limits), intent(in) :: limits
      type(error_type), allocatable, intent(out) :: error
      !> Continue after this number of bytes
      integer(long), intent(in), optional :: place

      self%name = name
      self%planned = planned
      allocate(character(len=first_length) :: self%line)
      self%length = 0
      if (name == "-") then
         call self%file%open_standard_output()
         if (.not. self%file%is_open()) call fatal_error(error, "it cannot be written", error_kind%file, "standard output")
         call self%file%charge_to(limits%output)
      else if (present(place)) then
         call open_result_again(self%file, name, place, error, limits)
      else
         call open_result(self%file, name, name, error, limits)
      end if
   end subroutine open_json_file

   !> Number of bytes written so far
   integer(long) function place(self)
      class(json_file), intent(in) :: self
      place = self%file%place()
   end function place

   subroutine close_json_file(self, error)
      class(json_file), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      if (.not. self%file%is_open()) return
      if (self%name == "-") self%name = "standard output"
      call close_result(self%file, self%name, error)
   end subroutine close_json_file

   !> Write the last line: the progress of the run, as a case of number 0 without patches, which readers of cases skip
   subroutine write_end(self, run)
      class(json_file), intent(inout) :: self
      type(run_summary), intent(in) :: run

      call self%add('{"case":0,"solved":false,"converged":true,"status":"end of run","patches":[]')
      self%follows = .true.
      call self%open_group("run")
      call describe_run(self, run)
      call self%close_group()
      call self%end_line()
   end subroutine write_end

   !> Write the line of a case
   subroutine write_case(self, head, spec, contact, pair)
      class(json_file), intent(inout) :: self
      type(case_head), intent(in) :: head
      !> The case as solved; absent: there is no result
      type(case_spec), intent(in), optional :: spec
      !> Result of module 3
      type(patch_result), intent(in), optional :: contact
      !> Result of module 1
      type(wheel_rail_result), intent(in), optional :: pair
      integer :: k

      call self%add("{")
      self%follows = .false.
      call describe_head(self, head)
      call self%count("cases_planned", "", self%planned)
      if (present(pair)) then
         call self%text("side", "", trim(merge("left ", "right", spec%wheel_rail%left)))
         call describe_wheel_rail(self, spec, pair)
      end if
      call self%key("patches")
      call self%add("[")
      if (present(contact)) call write_patch(self, 1, spec, contact)
      if (present(pair)) then
         do k = 1, size(pair%patches)
            if (k > 1) call self%add(",")
            call write_patch(self, k, spec, pair%patches(k)%contact, pair%patches(k))
         end do
      end if
      call self%add("]")
      call self%end_line()
   end subroutine write_case

   !> Write one contact patch as an object
   subroutine write_patch(self, number, spec, contact, place)
      class(json_file), intent(inout) :: self
      !> Index of the patch in its case
      integer, intent(in) :: number
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: contact
      !> Position of the patch, in module 1
      type(wheel_rail_patch), intent(in), optional :: place

      call self%add("{")
      self%follows = .false.
      call self%count("patch", "", number)
      if (allocated(contact%effects)) call self%text("effects", "", contact%effects)
      call describe_patch(self, spec, contact, place)
      call self%add("}")
      self%follows = .true.
   end subroutine write_patch

   subroutine open_object(self, name, columns, brief)
      class(json_file), intent(inout) :: self
      character(len=*), intent(in) :: name
      !> Not used in this format
      logical, intent(in), optional :: columns, brief

      call self%key(name)
      call self%add("{")
      self%follows = .false.
      associate (unused => present(columns) .or. present(brief))
      end associate
   end subroutine open_object

   subroutine close_object(self)
      class(json_file), intent(inout) :: self

      call self%add("}")
      self%follows = .true.
   end subroutine close_object

   subroutine write_value(self, item)
      class(json_file), intent(inout) :: self
      type(named_value), intent(in) :: item
      integer :: k

      call self%key(trim(item%name))
      if (item%unit /= "") call self%add('{"value":')
      select case (item%kind)
      case (item_kind%real_number)
         call self%add(trim(number_text(item%value)))
      case (item_kind%real_numbers)
         do k = 1, size(item%values)
            call self%add(merge("[", ",", k == 1) // trim(number_text(item%values(k))))
         end do
         call self%add(trim(merge("[]", "] ", size(item%values) == 0)))
      case (item_kind%whole)
         call self%add(integer_text(nint(item%value)))
      case (item_kind%flag)
         call self%add(trim(merge("true ", "false", item%value > 0.0_wp)))
      case default
         call self%add_quoted(item%text)
      end select
      if (item%unit == "") return
      call self%add(',"unit":')
      call self%add_quoted(trim(item%unit))
      call self%add("}")
   end subroutine write_value

   !> Write the name of the next member, after a comma if needed
   subroutine key(self, name)
      class(json_file), intent(inout) :: self
      character(len=*), intent(in) :: name

      if (self%follows) call self%add(",")
      call self%add('"' // name // '":')
      self%follows = .true.
   end subroutine key

   !> Add a text to the line
   subroutine add(self, text)
      class(json_file), intent(inout) :: self
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: longer

      if (self%length + len(text) > len(self%line)) then
         allocate(character(len=2*(self%length + len(text))) :: longer)
         longer(:self%length) = self%line(:self%length)
         call move_alloc(longer, self%line)
      end if
      self%line(self%length + 1:self%length + len(text)) = text
      self%length = self%length + len(text)
   end subroutine add

   !> Write the line and flush it
   subroutine end_line(self)
      class(json_file), intent(inout) :: self

      call self%add("}")
      call self%file%line(self%line(:self%length))
      call self%file%flush_now()
      self%length = 0
   end subroutine end_line

   !> A number in the smallest number of digits that are read back as the same number, padded with blanks; null if it is not finite
   pure function number_text(value) result(text)
      !> Value to be written
      real(wp), intent(in) :: value
      character(len=longest_number) :: text
      character(len=most_digits) :: digits
      character(len=12) :: exponent_text
      integer :: exponent, last

      if (.not. ieee_is_finite(value)) then
         text = "null"
         return
      else if (value == 0.0_wp) then
         text = "0"
         return
      end if
      call number_digits(abs(value), digits, exponent)
      last = max(1, verify(digits, "0", back=.true.))
      if (exponent >= 0 .and. exponent <= 15) then
         if (last <= exponent + 1) then
            text = digits(:last) // repeat("0", exponent + 1 - last)
         else
            text = digits(:exponent + 1) // "." // digits(exponent + 2:last)
         end if
      else if (exponent < 0 .and. exponent >= -4) then
         text = "0." // repeat("0", -exponent - 1) // digits(:last)
      else
         write(exponent_text, "(I0)") exponent
         text = digits(1:1) // "e" // exponent_text
         if (last > 1) text = digits(1:1) // "." // digits(2:last) // "e" // exponent_text
      end if
      if (value < 0.0_wp) text = "-" // text(:longest_number - 1)
   end function number_text

   !> Add a text in quotation marks; quotation marks, backslashes and control characters are escaped
   !>
   !> Bytes beyond ASCII are kept if the text is UTF-8; otherwise, as in file names of old systems, each is replaced by "?".
   subroutine add_quoted(self, text)
      class(json_file), intent(inout) :: self
      character(len=*), intent(in) :: text
      character(len=4) :: code
      integer :: byte, first, i
      logical :: good

      good = is_utf8(text)
      call self%add('"')
      first = 1
      do i = 1, len(text)
         byte = iachar(text(i:i))
         if (byte >= 32 .and. (byte < 127 .or. good) .and. text(i:i) /= '"' .and. text(i:i) /= "\") cycle
         call self%add(text(first:i - 1))
         if (byte < 32) then
            write(code, "(Z4.4)") byte
            call self%add("\u" // code)
         else if (byte >= 127) then
            call self%add("?")
         else
            call self%add("\" // text(i:i))
         end if
         first = i + 1
      end do
      call self%add(text(first:) // '"')
   end subroutine add_quoted

   !> Is a text valid UTF-8?
   pure logical function is_utf8(text)
      character(len=*), intent(in) :: text
      integer :: byte, following, i

      following = 0
      is_utf8 = .false.
      do i = 1, len(text)
         byte = iachar(text(i:i))
         if (following > 0) then
            if (byte < 128 .or. byte > 191) return
            following = following - 1
         else if (byte >= 194 .and. byte <= 223) then
            following = 1
         else if (byte >= 224 .and. byte <= 239) then
            following = 2
         else if (byte >= 240 .and. byte <= 244) then
            following = 3
         else if (byte > 127) then
            return
         end if
      end do
      is_utf8 = following == 0
   end function is_utf8
end module contact_output_json_file
