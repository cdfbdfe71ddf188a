!> Transfer of the numbers of a case to and from every format
!>
!> The modules contact_cases_inputs, contact_cases_grid_inputs and contact_cases_rail_inputs list the numbers of each group of the
!> input once, in their order. The operation is defined by an extension of `case_archive`: the reader of input files and a caller of
!> the library set the values, the writer of input files reads them.
!>
!> The numbers of one line are collected first (`real`, `integer`, `text`) and processed together by `end_line`, so that messages
!> can show the whole line. Collected variables must therefore have the attribute `target`, and have new values only after
!> `end_line`.
module contact_cases_archive
   use contact_base_kinds, only : wp
   use contact_text_bounds, only : bounds_of, bounds_table, is_angle
   use contact_text_words, only : integer_text, real_text
   implicit none (type, external)
   private

   public :: archive_item, case_archive, is_pair, item_kind, own_word, text_variable

   !> Maximum number of items on a line, and length of a number with its name
   integer, parameter :: max_items = 12
   integer, parameter, public :: shown_length = 64
   !> Lengths of lists, which need not be given in formats with names
   character(len=6), parameter, public :: lengths(*) = [character(len=6) :: "NN", "NP", "NVF", "NX", "NY", "NZ", "PRFOPT"]

   type :: item_kind_list
      integer :: real = 1, angle = 2, integer = 3, text = 4
      !> An integer that files may write as 1.0
      integer :: branch = 5
   end type item_kind_list
   !> Kinds of items
   type(item_kind_list), parameter :: item_kind = item_kind_list()

   !> A text whose length may change
   type :: text_variable
      character(len=:), allocatable :: value
   end type text_variable

   !> One number of a line, and its variable
   type :: archive_item
      !> Name as in the input files; "A|B" if it is A or B, depending on another number of the line
      character(len=13) :: name = ""
      !> Member of item_kind, and row of the table of bounds, 0 if there is none
      integer :: kind = 0, row = 0
      !> Has it a value before a case gives one?
      logical :: is_preset = .false.
      !> May it be missing? Then the default is used
      logical :: is_optional = .false.
      real(wp) :: default = 0.0_wp
      !> Are bounds checked by the caller, because they depend on other numbers?
      logical :: is_unchecked = .false.
      !> Was it given? Always true unless it is optional and values are being read
      logical :: given = .true.
      !> Variable, by its kind
      real(wp), pointer :: r => null()
      integer, pointer :: i => null()
      type(text_variable), pointer :: s => null()
   end type archive_item

   !> An archive: one format or operation
   type, abstract :: case_archive
      !> Items of the current line, or of the last line until the next begins
      type(archive_item) :: items(max_items)
      integer :: count = 0
      logical, private :: has_ended = .false.
      !> Are values set by the archive?
      logical :: is_reading = .false.
      !> Have values names of their own, so that any of them may be left out?
      logical :: has_names = .false.
      !> Do the rules of the published interface of the library apply? With two coefficients of Coulomb friction, the smaller one is
      !> used instead of the static one, and distances of patches are not compared
      logical :: of_library = .false.
      !> Are all values valid so far?
      logical :: is_good = .true.
   contains
      !> Collect a number, the components of a vector, an integer, a text
      procedure :: real => note_real
      procedure :: reals => note_reals
      procedure :: integer => note_integer
      procedure :: text => note_text
      !> Process the line: set the values of its variables, or read them
      procedure(end_line_interface), deferred :: end_line
      !> A list of numbers on separate lines
      procedure(list_interface), deferred :: list
      !> A choice or a number that exists in the readable format but not in input files, in the current group or in the case itself
      procedure :: own_choice => ignore_choice
      procedure :: own_number => ignore_number
      !> A number of the last line is wrong, doubtful or replaced: reported by `report`, which does nothing if values are not set
      procedure :: refuse
      procedure :: warn
      procedure :: report => report_nothing
      !> Reading cannot continue, with the reason; the name is blank if no number of the last line is the cause
      procedure :: fail => ignore_message
      !> Begin and end a group of numbers; groups are not nested
      procedure :: open_group => ignore_name
      procedure :: close_group => ignore
      !> The numbers of a group are inconsistent or doubtful: reported by `report_group`, which does nothing if values are not set
      procedure :: refuse_group
      procedure :: warn_of_group
      procedure :: report_group => report_nothing_of_group
      !> Add the position at which reading stopped, if it did
      procedure :: add_context => ignore_name
      !> Check the bounds of a number of the last line that was collected as unchecked
      procedure :: check => check_nothing
      !> Position of an item of the last line in its file
      procedure :: place => place_nowhere
      !> Line on which a group begins, 0 if there is none
      procedure :: line_of => no_line
      !> A number of the last line with its name, as given
      procedure :: shown => show_item
      !> Was an optional number of the last line given?
      procedure :: was_given
      !> Index of a number in the last line
      procedure :: place_of
      !> Last step of end_line
      procedure :: finish_line
   end type case_archive

   abstract interface
      !> Process the items, and call `finish_line`
      subroutine end_line_interface(self)
         import :: case_archive
         class(case_archive), intent(inout) :: self
      end subroutine end_line_interface

      !> Process a list
      subroutine list_interface(self, name, values, n, units, bounds)
         import :: case_archive, wp
         class(case_archive), intent(inout) :: self
         !> Name as in the table of bounds and the manual
         character(len=*), intent(in) :: name
         !> Unallocated or of another size if values are set
         real(wp), allocatable, intent(inout) :: values(:)
         !> Number of values
         integer, intent(in) :: n
         !> Unit of each value in turn, repeated cyclically; default mm. If rad is among them, files may use degrees
         character(len=*), intent(in), optional :: units(:)
         !> Name of the bounds in the table; default: that of the list
         character(len=*), intent(in), optional :: bounds
      end subroutine list_interface
   end interface

contains

   !> Add an item
   subroutine add_item(self, name, kind, default)
      class(case_archive), intent(inout) :: self
      character(len=*), intent(in) :: name
      !> Member of item_kind
      integer, intent(in) :: kind
      real(wp), intent(in), optional :: default

      if (self%has_ended) self%count = 0
      self%has_ended = .false.
      self%count = self%count + 1
      associate (item => self%items(self%count))
         item%name = name
         item%row = bounds_of(name)
         item%kind = kind
         item%is_preset = .false.
         if (item%row > 0) item%is_preset = bounds_table(item%row)%is_preset
         item%is_optional = present(default)
         item%default = 0.0_wp
         if (present(default)) item%default = default
         item%is_unchecked = index(name, "|") > 0
         item%given = .true.
         nullify(item%r, item%i, item%s)
      end associate
   end subroutine add_item

   !> Collect a number; angles are identified by the unit rad or rad/s
   subroutine note_real(self, name, value, default, unchecked, preset)
      class(case_archive), intent(inout) :: self
      !> Name as in the table of bounds and the manual
      character(len=*), intent(in) :: name
      !> Variable, in internal units: N, mm, s, rad
      real(wp), intent(inout), target :: value
      !> Value of an optional number that is not given
      real(wp), intent(in), optional :: default
      !> Are bounds checked by the caller?
      logical, intent(in), optional :: unchecked
      !> Has it a value, in this position, before a case gives one? Default as in the table of bounds
      logical, intent(in), optional :: preset

      call add_item(self, name, item_kind%real, default)
      associate (item => self%items(self%count))
         if (item%row > 0) then
            if (is_angle(item%row)) item%kind = item_kind%angle
         end if
         item%r => value
         if (present(unchecked)) item%is_unchecked = unchecked
         if (present(preset)) item%is_preset = preset
      end associate
   end subroutine note_real

   !> Collect the components of a vector: name1, name2, ...
   subroutine note_reals(self, name, values)
      class(case_archive), intent(inout) :: self
      !> Name without the figure of the component
      character(len=*), intent(in) :: name
      !> Variables, in internal units: N, mm, s, rad
      real(wp), intent(inout), target :: values(:)
      integer :: k

      do k = 1, size(values)
         call self%real(name // achar(iachar("0") + k), values(k))
      end do
   end subroutine note_reals

   !> Collect an integer
   subroutine note_integer(self, name, value, default, branch, unchecked)
      class(case_archive), intent(inout) :: self
      !> Name as in the table of bounds and the manual
      character(len=*), intent(in) :: name
      !> Variable, which is read, written or checked by the archive
      integer, intent(inout), target :: value
      !> Value of an optional number that is not given
      integer, intent(in), optional :: default
      !> May files give it as a number with a decimal point, of which the sign is used? Default no
      logical, intent(in), optional :: branch
      !> Are bounds checked by the caller?
      logical, intent(in), optional :: unchecked
      integer :: kind

      kind = item_kind%integer
      if (present(branch)) kind = merge(item_kind%branch, item_kind%integer, branch)
      if (present(default)) then
         call add_item(self, name, kind, real(default, wp))
      else
         call add_item(self, name, kind)
      end if
      self%items(self%count)%i => value
      if (present(unchecked)) self%items(self%count)%is_unchecked = unchecked
   end subroutine note_integer

   !> Collect a text
   subroutine note_text(self, name, value)
      class(case_archive), intent(inout) :: self
      !> Name as in the manual
      character(len=*), intent(in) :: name
      !> Variable, which is read, written or checked by the archive
      type(text_variable), intent(inout), target :: value

      call add_item(self, name, item_kind%text)
      self%items(self%count)%s => value
   end subroutine note_text

   !> Was an item of the last line given?
   pure logical function was_given(self, name)
      class(case_archive), intent(in) :: self
      !> Name of the item as collected
      character(len=*), intent(in) :: name
      integer :: k

      k = self%place_of(name)
      was_given = .false.
      if (k > 0) was_given = self%items(k)%given
   end function was_given

   !> Index of an item in the last line, 0 if it is missing
   pure integer function place_of(self, name) result(k)
      class(case_archive), intent(in) :: self
      !> Name of the item as collected
      character(len=*), intent(in) :: name

      do k = 1, self%count
         if (self%items(k)%name == name) return
      end do
      k = 0
   end function place_of

   !> Do an item and the next one belong to the bodies 1 and 2? Then they form a list
   pure logical function is_pair(items, k)
      !> Items of the line
      type(archive_item), intent(in) :: items(:)
      !> Index of the first item
      integer, intent(in) :: k
      integer :: n

      is_pair = .false.
      if (k >= size(items)) return
      n = len_trim(items(k)%name)
      if (items(k)%name(n:n) /= "1" .or. len_trim(items(k + 1)%name) /= n) return
      is_pair = items(k + 1)%name == items(k)%name(:n - 1) // "2"
   end function is_pair

   !> End the current line
   pure subroutine finish_line(self)
      class(case_archive), intent(inout) :: self

      self%has_ended = .true.
   end subroutine finish_line

   !> A number of the last line is invalid
   subroutine refuse(self, name, text)
      class(case_archive), intent(inout) :: self
      !> Item of the last line
      character(len=*), intent(in) :: name
      !> Message after its name and value
      character(len=*), intent(in) :: text

      call self%report(.true., name, text)
   end subroutine refuse

   !> A number of the last line is doubtful or was replaced
   subroutine warn(self, name, text)
      class(case_archive), intent(inout) :: self
      !> Item of the last line
      character(len=*), intent(in) :: name
      !> Message after its name and value
      character(len=*), intent(in) :: text

      call self%report(.false., name, text)
   end subroutine warn

   !> The numbers of the current group, or of previous groups, are inconsistent
   subroutine refuse_group(self, text)
      class(case_archive), intent(inout) :: self
      !> Message of one sentence
      character(len=*), intent(in) :: text

      call self%report_group(.true., text)
   end subroutine refuse_group

   !> The numbers of the current group are doubtful
   subroutine warn_of_group(self, text)
      class(case_archive), intent(inout) :: self
      !> Message of one sentence
      character(len=*), intent(in) :: text

      call self%report_group(.false., text)
   end subroutine warn_of_group

   !> A choice among words; ignored by formats without keys of their own
   subroutine ignore_choice(self, name, title, words, chosen, usual, none)
      class(case_archive), intent(inout) :: self
      !> Key and meaning; words, which may be numbers, "true" and "false"
      character(len=*), intent(in) :: name, title, words(:)
      !> Index of the chosen word
      integer, intent(inout) :: chosen
      !> Index of the word that applies until a case has the key
      integer, intent(in) :: usual
      !> Index of the word that requests nothing; records leave it out
      integer, intent(in), optional :: none

      associate (unused => self, no_name => name, no_title => title, no_words => words, no_choice => chosen, no_usual => usual, &
         & no_none => present(none))
      end associate
   end subroutine ignore_choice

   !> A number, 0 if none is requested; ignored by formats without keys of their own
   subroutine ignore_number(self, name, title, value, lowest, highest)
      class(case_archive), intent(inout) :: self
      !> Key and meaning
      character(len=*), intent(in) :: name, title
      !> Value in the unit of the key
      real(wp), intent(inout) :: value
      !> Its range, apart from 0
      real(wp), intent(in) :: lowest, highest

      associate (unused => self, no_name => name, no_title => title, no_value => value, no_range => [lowest, highest])
      end associate
   end subroutine ignore_number

   !> A word of a choice as in the readable format: in quotes, except for numbers, "true" and "false"
   pure function own_word(word) result(text)
      !> Word, see own_choice
      character(len=*), intent(in) :: word
      character(len=len(word) + 2) :: text

      text = word
      if (verify(trim(word), "0123456789") > 0 .and. all(word /= ["true ", "false"])) text = '"' // trim(word) // '"'
   end function own_word

   !> Nothing, since values that are not set are valid
   subroutine report_nothing(self, is_error, name, text)
      class(case_archive), intent(inout) :: self
      !> Is the number invalid? Otherwise doubtful
      logical, intent(in) :: is_error
      !> Item of the last line
      character(len=*), intent(in) :: name
      !> Message after its name and value
      character(len=*), intent(in) :: text

      associate (unused => self, no_error => is_error, no_name => name, no_text => text)
      end associate
   end subroutine report_nothing

   !> Nothing, since values that are not set are valid
   subroutine report_nothing_of_group(self, is_error, text)
      class(case_archive), intent(inout) :: self
      !> Are its numbers inconsistent? Otherwise doubtful
      logical, intent(in) :: is_error
      !> Message of one sentence
      character(len=*), intent(in) :: text

      associate (unused => self, no_error => is_error, no_text => text)
      end associate
   end subroutine report_nothing_of_group

   !> Nothing, since values that are not set are valid
   subroutine ignore_message(self, name, text)
      class(case_archive), intent(inout) :: self
      !> Item of the last line
      character(len=*), intent(in) :: name
      !> Message after its name and value
      character(len=*), intent(in) :: text

      associate (unused => self, no_name => name, no_text => text)
      end associate
   end subroutine ignore_message

   !> Nothing, for formats without groups and for values that are not set
   subroutine ignore_name(self, text)
      class(case_archive), intent(inout) :: self
      !> Name of the group, or a remark on it
      character(len=*), intent(in) :: text

      associate (unused => self, no_text => text)
      end associate
   end subroutine ignore_name

   !> Nothing, for formats without groups
   subroutine ignore(self)
      class(case_archive), intent(inout) :: self

      associate (unused => self)
      end associate
   end subroutine ignore

   !> Nothing, since values that are not set are valid
   subroutine check_nothing(self, name, bounds)
      class(case_archive), intent(inout) :: self
      !> Item of the last line
      character(len=*), intent(in) :: name
      !> Name of the bounds in the table; default: that of the item
      character(len=*), intent(in), optional :: bounds

      associate (unused => self, no_name => name, is_there => present(bounds))
      end associate
   end subroutine check_nothing

   !> Values that are not set have no position
   subroutine place_nowhere(self, name, line, column)
      class(case_archive), intent(in) :: self
      !> Item of the last line
      character(len=*), intent(in) :: name
      !> Unchanged
      integer, intent(inout) :: line, column

      associate (unused => self, no_name => name, no_line => line, no_column => column)
      end associate
   end subroutine place_nowhere

   !> Groups of values that are not set have no line
   pure integer function no_line(self, name) result(line)
      class(case_archive), intent(in) :: self
      !> Name of the group
      character(len=*), intent(in) :: name

      line = 0
      associate (unused => self%count, no_name => name)
      end associate
   end function no_line

   !> An item of the last line, "DX = 0.5", padded with blanks
   pure function show_item(self, name) result(text)
      class(case_archive), intent(in) :: self
      !> Name of the item as collected
      character(len=*), intent(in) :: name
      character(len=shown_length) :: text
      integer :: k

      k = self%place_of(name)
      text = name
      if (k == 0) return
      associate (item => self%items(k))
         if (associated(item%r)) text = name // " = " // real_text(item%r)
         if (associated(item%i)) text = name // " = " // integer_text(item%i)
      end associate
   end function show_item
end module contact_cases_archive
