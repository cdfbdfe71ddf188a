!> The input of a case for programs: its specification, kept groups included, by the groups, keys and words of the readable format
module contact_output_input_record
   use contact_base_choices, only : motion
   use contact_base_kinds, only : wp
   use contact_cases_archive, only : archive_item, case_archive, is_pair, item_kind, lengths, own_word
   use contact_cases_spec, only : case_parts, case_spec, part_source
   use contact_cases_whole_case, only : visit_case
   use contact_control_digits, only : case_digits, digit_value
   use contact_control_translation, only : digits_of
   use contact_control_words, only : form_key, form_title, form_word, is_choice, key_length, key_of_item, key_table, &
      & word_of_digit
   use contact_output_record, only : record_writer
   use contact_text_bounds, only : bounds_of, bounds_table, unit_of
   use contact_text_words, only : capital, small
   implicit none (type, external)
   private

   public :: describe_input

   !> Values of a key, one for each set or body if there are several
   type :: key_values
      character(len=key_length) :: key = ""
      character(len=11) :: unit = ""
      character(len=80) :: title = ""
      logical :: is_count = .false., is_list = .false.
      real(wp), allocatable :: values(:)
      !> A word instead of values
      character(len=:), allocatable :: text
   end type key_values

   !> The archive that writes each group to a record
   type, extends(case_archive) :: input_archive
      class(record_writer), pointer :: record => null()
      !> Data of the case: module 1 or 3, choices
      integer :: module_number = 3
      type(case_digits) :: digits
      !> Motion on which units depend, member of motion: a shift or rolling
      integer :: moves = motion%steady_rolling
      !> Number of keys of the current group so far, and the keys 1...n_keys
      integer :: n_keys = 0
      type(key_values), allocatable :: keys(:)
   contains
      procedure :: end_line => collect_line
      procedure :: list => collect_list
      procedure :: own_choice => record_choice
      procedure :: own_number => record_number
      procedure :: open_group => begin_group
      procedure :: close_group => end_group
      procedure, private :: add
   end type input_archive

contains

   !> Choices by their words, digits as given by the case, and all groups of numbers that the case uses, without points below the
   !> surface and lists of all elements
   subroutine describe_input(record, spec)
      class(record_writer), intent(inout), target :: record
      type(case_spec), intent(in) :: spec
      type(input_archive) :: a
      type(case_spec), target :: whole
      type(case_digits) :: given
      integer :: k

      a%record => record
      a%module_number = merge(1, 3, allocated(spec%wheel_rail))
      if (spec%motion == motion%shift) a%moves = motion%shift
      whole = spec
      ! all groups used by the case; lists of all elements and points are stored elsewhere
      whole%parts = case_parts(extra_slip=part_source%kept)
      whole%has_stress = .false.
      a%digits = digits_of(whole)
      call record%open_group("choices")
      call describe_choices(a, "")
      call record%close_group()
      call record%open_group("digits")
      given = digits_of(spec)
      do k = 1, size(key_table)
         associate (row => key_table(k))
            if (any(row%module_number == [0, a%module_number])) call record%count(trim(small(row%name)), trim(row%title), &
               & digit_value(given, trim(row%name)))
         end associate
      end do
      call record%close_group()
      call visit_case(a, whole)
   end subroutine describe_input

   !> Choices of a group, "" for those of the case itself, by their words
   subroutine describe_choices(self, group)
      class(input_archive), intent(inout) :: self
      character(len=*), intent(in) :: group
      integer :: digit, k

      do k = 1, size(key_table)
         associate (row => key_table(k))
            if (row%group /= group .or. all(row%module_number /= [0, self%module_number])) cycle
            digit = digit_value(self%digits, trim(row%name))
            if (.not. is_choice(trim(row%name))) then
               call self%record%count(trim(row%key), trim(row%title), digit)
            else if (word_of_digit(trim(row%name), digit, self%module_number) /= "") then
               call self%record%text(trim(row%key), trim(row%title), &
                  & trim(word_of_digit(trim(row%name), digit, self%module_number)))
            end if
         end associate
      end do
   end subroutine describe_choices

   subroutine begin_group(self, text)
      class(input_archive), intent(inout) :: self
      !> Name of the group
      character(len=*), intent(in) :: text

      call self%record%open_group(text)
      call describe_choices(self, text)
      self%n_keys = 0
      if (.not. allocated(self%keys)) allocate(self%keys(16))
   end subroutine begin_group

   !> A choice by its word, unless it requests nothing
   subroutine record_choice(self, name, title, words, chosen, usual, none)
      class(input_archive), intent(inout) :: self
      character(len=*), intent(in) :: name, title, words(:)
      integer, intent(inout) :: chosen
      integer, intent(in) :: usual
      integer, intent(in), optional :: none

      associate (unused => usual)
      end associate
      if (present(none)) then
         if (chosen == none) return
      end if
      if (own_word(words(chosen)) == words(chosen)) then
         call self%record%count(name, title, iachar(words(chosen)(1:1)) - iachar("0"))
      else
         call self%record%text(name, title, trim(words(chosen)))
      end if
   end subroutine record_choice

   !> A number, unless the value means that none is requested
   subroutine record_number(self, name, title, value, lowest, highest)
      class(input_archive), intent(inout) :: self
      character(len=*), intent(in) :: name, title
      real(wp), intent(inout) :: value
      real(wp), intent(in) :: lowest, highest

      associate (unused => [lowest, highest])
      end associate
      if (value > 0.0_wp) call self%record%number(name, "-", title, value)
   end subroutine record_number

   !> Write the group to the record
   subroutine end_group(self)
      class(input_archive), intent(inout) :: self
      integer :: k, method

      do k = 1, self%n_keys
         associate (row => self%keys(k))
            ! a weight for smoothing splines, a wavelength for the other methods
            if (row%key == "smooth") then
               call find_key(self, "ismooth", 0, method)
               row%unit = merge("mm3", "mm ", nint(self%keys(method)%values(1)) == 0)
            end if
            if (allocated(row%text)) then
               call self%record%text(trim(row%key), trim(row%title), row%text)
            else if (size(row%values) > 1 .or. row%is_list) then
               call self%record%numbers(trim(row%key), trim(row%unit), trim(row%title), row%values)
            else if (row%is_count) then
               call self%record%count(trim(row%key), trim(row%title), nint(row%values(1)))
            else
               call self%record%number(trim(row%key), trim(row%unit), trim(row%title), row%values(1))
            end if
         end associate
      end do
      call self%record%close_group()
   end subroutine end_group

   !> Collect the current items; values that are repeated, for the next set or the second body, form a list
   subroutine collect_line(self)
      class(input_archive), intent(inout) :: self
      character(len=key_length) :: key
      integer :: k

      k = 0
      do while (k < self%count)
         k = k + 1
         if (any(lengths == self%items(k)%name)) cycle
         key = key_of_item(self%items, k)
         if (is_pair(self%items(:self%count), k)) then
            key = key(:len_trim(key) - 1)
            call self%add(key, self%items(k))
            k = k + 1
         end if
         call self%add(key, self%items(k))
      end do
      call self%finish_line()
   end subroutine collect_line

   !> Append the value of an item to those of its key
   subroutine add(self, key, item)
      class(input_archive), intent(inout) :: self
      character(len=*), intent(in) :: key
      type(archive_item), intent(in) :: item
      integer :: at, bounds

      bounds = item%row
      ! the item has one of two names
      if (bounds == 0) bounds = bounds_of(trim(capital(key)))
      call find_key(self, key, bounds, at)
      associate (row => self%keys(at))
         select case (item%kind)
         case (item_kind%text)
            row%title = "name as typed"
            row%text = item%s%value
         case (item_kind%integer, item_kind%branch)
            if (form_key(item%name) /= "") then
               row%title = form_title(item%name, item%i)
               row%text = trim(form_word(item%name, item%i))
               return
            end if
            row%is_count = .true.
            call append(row, [real(item%i, wp)])
         case default
            call append(row, [item%r])
         end select
      end associate
   end subroutine add

   !> Index of a key in the group, which is added if necessary, with unit and description from the table of bounds
   subroutine find_key(self, key, bounds, at)
      class(input_archive), intent(inout) :: self
      character(len=*), intent(in) :: key
      !> Row of the table, 0 if there is none
      integer, intent(in) :: bounds
      integer, intent(out) :: at
      type(key_values), allocatable :: longer(:)

      do at = 1, self%n_keys
         if (self%keys(at)%key == key) return
      end do
      if (self%n_keys == size(self%keys)) then
         allocate(longer(2*size(self%keys)))
         longer(:self%n_keys) = self%keys(:self%n_keys)
         call move_alloc(longer, self%keys)
      end if
      self%n_keys = at
      self%keys(at) = key_values(key=key)
      if (bounds == 0) return
      self%keys(at)%title = bounds_table(bounds)%title
      if (index(bounds_table(bounds)%unit, "...") == 0) self%keys(at)%unit = trim(unit_of(bounds, self%moves))
   end subroutine find_key

   !> Append values to those of a key
   subroutine append(row, values)
      type(key_values), intent(inout) :: row
      real(wp), intent(in) :: values(:)

      if (.not. allocated(row%values)) allocate(row%values(0))
      row%values = [row%values, values]
   end subroutine append

   !> A list, under its own name
   subroutine collect_list(self, name, values, n, units, bounds)
      class(input_archive), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: n
      character(len=*), intent(in), optional :: units(:)
      character(len=*), intent(in), optional :: bounds
      integer :: at, row

      row = bounds_of(name)
      if (present(bounds)) row = bounds_of(bounds)
      if (form_key(name) == "") then
         call find_key(self, small(name), row, at)
      else
         call find_key(self, trim(form_key(name)), row, at)
      end if
      if (present(units)) self%keys(at)%unit = units(1)
      self%keys(at)%is_list = .true.
      if (n > 0) call append(self%keys(at), values(:n))
      if (n == 0) call append(self%keys(at), [real(wp) ::])
   end subroutine collect_list
end module contact_output_input_record
