!> Words of the readable format: keys of the choices of a case, and translation of messages about digits into these words
module contact_control_words
   use contact_base_choices, only : grid_form, planform_choice
   use contact_base_kinds, only : wp
   use contact_cases_archive, only : archive_item
   use contact_control_digits, only : belongs, digit_names, digit_table, digit_text, is_known, row_of, word_length
   use contact_text_bounds, only : bounds_of
   use contact_text_words, only : small
   use contact_cases_distance, only : distance_form
   implicit none (type, external)
   private

   public :: key_row, key_table, key_of, digit_of_word, word_of_digit, is_choice, choice_words
   public :: form_row, form_table, form_title, form_value, form_word, form_words, form_key, key_of_item
   public :: translate_to_words

   !> Length of keys and of names of groups
   integer, parameter, public :: key_length = 16
   integer, parameter :: module_1 = 1, module_3 = 3, both = 0
   character(len=word_length), parameter :: no_word = ""

   !> Position of a choice in a case
   type :: key_row
      !> Letter of the digit; module that has this choice, 0 for both
      character(len=2) :: name
      integer :: module_number
      !> Table of the case, "" for the case itself, and key in it
      character(len=key_length) :: group, key
      !> Meaning
      character(len=56) :: title
   end type key_row

   !> Choices; those that are numbers in the input files are in form_table
   type(key_row), parameter :: key_table(*) = [ &
      & key_row("C1", module_1, "", "configuration", "side of the wheel, and what it rolls on"), &
      & key_row("P", both, "", "sequence", "how the case continues the one before"), &
      & key_row("T", both, "", "motion", "relative motion of the bodies"), &
      & key_row("N", both, "", "normal", "what is prescribed in normal direction"), &
      & key_row("F", both, "", "tangential", "what is prescribed in tangential direction"), &
      & key_row("B", both, "", "pressure", "how pressures are found"), &
      & key_row("M", both, "", "material_model", "behaviour of the material"), &
      & key_row("E", module_3, "", "slip_source", "extra term of the rigid slip"), &
      & key_row("S", both, "", "stresses", "stresses below the surface"), &
      & key_row("I", both, "", "estimate", "start of the solution"), &
      & key_row("O", both, "", "output_level", "content of the .out file"), &
      & key_row("A", both, "", "mat_file", "content of the .mat file"), &
      & key_row("W", both, "", "flow_level", "report of the iterations"), &
      & key_row("G", both, "iteration", "solver", "solver of the tangential problem"), &
      & key_row("L", both, "friction", "law", "friction law"), &
      & key_row("V", both, "friction", "variation", "on what the friction parameters depend"), &
      & key_row("C", both, "material", "influence", "influence coefficients"), &
      & key_row("M2", both, "damping", "model", "damping"), &
      & key_row("H", both, "heat", "model", "surface temperatures"), &
      & key_row("D", module_1, "search", "location", "how contact is found and described")]

   !> A number of the input files that selects a choice within a group
   type :: form_row
      !> Name as in the input files
      character(len=6) :: name
      integer :: value
      character(len=24) :: word
      character(len=64) :: title
   end type form_row

   type(form_row), parameter :: form_table(*) = [ &
      & form_row("IPOTCN", grid_form%corner_and_sides, "corner_and_sides", "a corner, and sides of an element"), &
      & form_row("IPOTCN", grid_form%corners, "corners", "two corners"), &
      & form_row("IPOTCN", grid_form%centre_and_sides, "centre_and_sides", "centre of the first element, and its sides"), &
      & form_row("IPOTCN", grid_form%centres, "centres", "centres of the first and the last element"), &
      & form_row("IPOTCN", grid_form%hertz_curvatures, "hertz_curvatures", &
      & "around the contact of bodies with the distance a1 x^2 + b1 y^2"), &
      & form_row("IPOTCN", grid_form%hertz_curvature_ratio, "hertz_curvature_ratio", &
      & "around the contact of a curvature and a ratio of semi-axes"), &
      & form_row("IPOTCN", grid_form%hertz_axes, "hertz_axes", "around an ellipse of these semi-axes"), &
      & form_row("IPOTCN", grid_form%hertz_line_curvature, "hertz_line_curvature", "around a line contact of a curvature"), &
      & form_row("IPOTCN", grid_form%hertz_line, "hertz_line", "around a line contact of this half length and half width"), &
      & form_row("IPOTCN", grid_form%half_ellipses, "half_ellipses", "around two half ellipses"), &
      & form_row("IBASE", distance_form%quadratic, "quadratic", "a quadratic form of x and y"), &
      & form_row("IBASE", distance_form%profile, "profile", "a circle along x and a profile across"), &
      & form_row("IBASE", distance_form%quadratic_and_sines, "quadratic_and_sines", &
      & "a quadratic form and the difference of two sines along x"), &
      & form_row("IBASE", distance_form%elementwise, "elementwise", "one distance for each element"), &
      & form_row("IPLAN", planform_choice%unrestricted, "unrestricted", "the whole grid"), &
      & form_row("IPLAN", planform_choice%quadratic, "quadratic", "where a quadratic form is negative"), &
      & form_row("IPLAN", planform_choice%two_rectangles, "two_rectangles", "the union of two rectangles"), &
      & form_row("IPLAN", planform_choice%weighted_rectangles, "weighted_rectangles", &
      & "rectangles whose pressures act on each other with factors"), &
      & form_row("ISUBS", 5, "all", "all columns and rows, a list of depths"), &
      & form_row("ISUBS", 6, "ranges", "ranges of columns and rows, a list of depths"), &
      & form_row("ISUBS", 7, "lists", "lists of columns and rows, and of depths"), &
      & form_row("ISUBS", 9, "free", "coordinates of the points"), &
      & form_row("ISUBS", 1, "all_by_step", "all columns and rows, depths by first one and step"), &
      & form_row("ISUBS", 2, "ranges_by_step", "ranges of columns and rows, depths by first one and step"), &
      & form_row("ISUBS", 3, "lists_by_step", "lists of columns and rows, depths by first one and step")]

contains

   !> Row of a choice in key_table, 0 if it has no key
   pure integer function key_of(name, module_number) result(row)
      !> Letter of the digit
      character(len=*), intent(in) :: name
      integer, intent(in) :: module_number

      do row = 1, size(key_table)
         if (key_table(row)%name == name .and. any(key_table(row)%module_number == [both, module_number])) return
      end do
      row = 0
   end function key_of

   !> Is the digit selected by a word? Otherwise by a number
   pure logical function is_choice(name)
      !> Letter of the digit
      character(len=*), intent(in) :: name

      is_choice = any(digit_table%name == name .and. digit_table%word /= "")
   end function is_choice

   !> The digit selected by a word, -1 if there is none
   pure integer function digit_of_word(name, word, module_number) result(digit)
      !> Letter of the digit
      character(len=*), intent(in) :: name
      !> Word as in the readable format
      character(len=*), intent(in) :: word
      integer, intent(in) :: module_number
      integer :: row

      digit = -1
      if (word == "") return
      row = findloc(choice_words(name, module_number), word, dim=1)
      if (row > 0) digit = digit_table(row)%digit
   end function digit_of_word

   !> The word for a digit, blank if there is none
   pure function word_of_digit(name, digit, module_number) result(word)
      !> Letter of the digit
      character(len=*), intent(in) :: name
      !> Digit as in input files
      integer, intent(in) :: digit
      integer, intent(in) :: module_number
      character(len=word_length) :: word

      word = ""
      associate (row => row_of(name, digit, module_number))
         if (row > 0) word = digit_table(row)%word
      end associate
   end function word_of_digit

   !> Words of a digit, blank in the rows of the table that belong to other digits
   pure function choice_words(name, module_number) result(words)
      !> Letter of the digit
      character(len=*), intent(in) :: name
      integer, intent(in) :: module_number
      character(len=word_length) :: words(size(digit_table))

      words = merge(digit_table%word, no_word, digit_table%name == name .and. belongs(digit_table, module_number))
   end function choice_words

   !> Number selected by a word
   pure subroutine form_value(name, word, value, is_known_word)
      !> IPOTCN, IBASE, IPLAN or ISUBS
      character(len=*), intent(in) :: name
      !> Word as in the readable format
      character(len=*), intent(in) :: word
      !> Number, 0 if the word is unknown
      integer, intent(out) :: value
      !> Is there such a word?
      logical, intent(out) :: is_known_word
      integer :: row

      value = 0
      is_known_word = .false.
      do row = 1, size(form_table)
         if (form_table(row)%name /= name .or. form_table(row)%word /= word) cycle
         value = form_table(row)%value
         is_known_word = .true.
      end do
   end subroutine form_value

   !> Row of such a number in form_table, 0 if there is none
   pure integer function row_of_form(name, value) result(row)
      !> IPOTCN, IBASE, IPLAN or ISUBS
      character(len=*), intent(in) :: name
      integer, intent(in) :: value

      do row = 1, size(form_table)
         if (form_table(row)%name == name .and. form_table(row)%value == value) return
      end do
      row = 0
   end function row_of_form

   !> Word of such a number, blank if there is none
   pure function form_word(name, value) result(word)
      !> IPOTCN, IBASE, IPLAN or ISUBS
      character(len=*), intent(in) :: name
      !> Number as in input files
      integer, intent(in) :: value
      character(len=24) :: word

      word = ""
      if (row_of_form(name, value) > 0) word = form_table(row_of_form(name, value))%word
   end function form_word

   !> Meaning of such a number, blank if there is none
   pure function form_title(name, value) result(title)
      !> IPOTCN, IBASE, IPLAN or ISUBS
      character(len=*), intent(in) :: name
      !> Number as in input files
      integer, intent(in) :: value
      character(len=64) :: title

      title = ""
      if (row_of_form(name, value) > 0) title = form_table(row_of_form(name, value))%title
   end function form_title

   !> All words of such a number, blank in the rows of others
   pure function form_words(name) result(words)
      !> IPOTCN, IBASE, IPLAN or ISUBS
      character(len=*), intent(in) :: name
      character(len=24) :: words(size(form_table))

      words = form_table%word
      where (form_table%name /= name) words = ""
   end function form_words

   !> Key of such a number, or of a list of groups of numbers, in its group; blank for others
   pure function form_key(name) result(key)
      !> Name as in the manual, in capital letters
      character(len=*), intent(in) :: name
      character(len=key_length) :: key

      select case (name)
      case ("IPOTCN", "IBASE"); key = "form"
      case ("IPLAN"); key = "planform"
      case ("ISUBS"); key = "points"
      case ("Y,ALPHA"); key = "inclinations"
      case ("XL,XH,YL,YH"); key = "rectangles"
      case default; key = ""
      end select
   end function form_key

   !> Key of an item of a line; for "A|B" it is A if the first number of the line is positive
   pure function key_of_item(items, k) result(key)
      !> Items of the line
      type(archive_item), intent(in) :: items(:)
      !> Index of the item
      integer, intent(in) :: k
      character(len=key_length) :: key
      integer :: bar

      associate (item => items(k))
         key = form_key(item%name)
         if (key /= "") return
         bar = index(item%name, "|")
         if (bar == 0) then
            key = small(item%name)
         else if (items(1)%r > 0.0_wp) then
            key = small(item%name(:bar - 1))
         else
            key = small(item%name(bar + 1:))
         end if
      end associate
      if (key == "rfname" .or. key == "wfname" .or. key == "cfname") key = "file"
   end function key_of_item

   !> A message in the words of the readable format: digits as keys and words, names of numbers in small letters
   !>
   !> Text in double quotes is unchanged, since it quotes the input.
   subroutine translate_to_words(message, module_number, text)
      !> Message in the terms of input files
      character(len=*), intent(in) :: message
      integer, intent(in) :: module_number
      !> Message in the terms of the readable format
      character(len=:), allocatable, intent(out) :: text
      character(len=*), parameter :: name_letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_"
      integer :: at, last
      logical :: quoted, is_word

      text = ""
      quoted = .false.
      at = 1
      do while (at <= len(message))
         if (message(at:at) == '"') quoted = .not. quoted
         is_word = .not. quoted .and. message(at:at) >= "A" .and. message(at:at) <= "Z"
         if (is_word .and. at > 1) is_word = verify(message(at - 1:at - 1), " (,;:|") == 0
         if (.not. is_word) then
            text = text // message(at:at)
            at = at + 1
            cycle
         end if
         last = at
         do while (last < len(message))
            if (index(name_letters, message(last + 1:last + 1)) == 0) exit
            last = last + 1
         end do
         call translate_name(message, at, last, module_number, text)
         at = last + 1
      end do
   end subroutine translate_to_words

   !> Translate one name, and the digits after it if there are any
   subroutine translate_name(message, first, last, module_number, text)
      character(len=*), intent(in) :: message
      integer, intent(in) :: first
      !> Position of the last character: on entry of the name, on return of the translated part of the message
      integer, intent(inout) :: last
      integer, intent(in) :: module_number
      character(len=:), allocatable, intent(inout) :: text
      integer :: digit, gap, next
      logical :: is_digit

      is_digit = any(digit_names == message(first:last)) .and. last - first < 2 .and. last + 4 <= len(message)
      if (is_digit) is_digit = message(last + 1:last + 3) == " = " .and. index("0123456789", message(last + 4:last + 4)) > 0
      if (.not. is_digit) then
         if (form_key(message(first:last)) /= "") then
            call translate_form(message, first, last, text)
         else if (last > first .and. bounds_of(message(first:last)) > 0) then
            text = text // small(message(first:last))
         else
            text = text // message(first:last)
         end if
         return
      end if
      next = last + 4
      digit = iachar(message(next:next)) - iachar("0")
      call translate_digit(message(first:last), digit, module_number, .true., text)
      last = next
      ! "3", "2 or 3", "1, 2 or 3"
      do
         gap = gap_behind(message, last)
         if (gap == 0 .or. .not. is_figure(message, last + gap + 1)) return
         text = text // message(last + 1:last + gap)
         last = last + gap + 1
         call translate_digit(message(first:next - 4), iachar(message(last:last)) - iachar("0"), module_number, .false., text)
      end do
   end subroutine translate_name

   !> Length of the ", " or " or " after a position, 0 for neither
   pure integer function gap_behind(message, last) result(gap)
      character(len=*), intent(in) :: message
      integer, intent(in) :: last

      gap = 0
      if (index(message(last + 1:), ", ") == 1) gap = 2
      if (index(message(last + 1:), " or ") == 1) gap = 4
   end function gap_behind

   !> Is there a single figure, not followed by another?
   pure logical function is_figure(message, at)
      character(len=*), intent(in) :: message
      integer, intent(in) :: at

      is_figure = .false.
      if (at > len(message)) return
      is_figure = index("0123456789", message(at:at)) > 0
      if (at < len(message)) is_figure = is_figure .and. verify(message(at + 1:at + 1), "0123456789.") > 0
   end function is_figure

   !> Translate IPOTCN = -3 and similar, "-5, -4 or -1"
   subroutine translate_form(message, first, last, text)
      character(len=*), intent(in) :: message
      integer, intent(in) :: first
      !> Position of the last character: on entry of the name, on return of the translated part of the message
      integer, intent(inout) :: last
      character(len=:), allocatable, intent(inout) :: text
      integer :: end_of_name, gap, length, status, value

      end_of_name = last
      text = text // trim(form_key(message(first:last)))
      gap = 3
      if (index(message(last + 1:), " = ") /= 1) return
      do
         length = verify(message(last + gap + 1:) // " ", "-0123456789") - 1
         if (length < 1) return
         read(message(last + gap + 1:last + gap + length), *, iostat=status) value
         if (status /= 0) return
         if (form_word(message(first:end_of_name), value) == "") return
         text = text // message(last + 1:last + gap) // '"' // trim(form_word(message(first:end_of_name), value)) // '"'
         last = last + gap + length
         gap = gap_behind(message, last)
         if (gap == 0) return
      end do
   end subroutine translate_form

   !> A digit as a key and a word, or as a part that a case gives or not
   subroutine translate_digit(name, digit, module_number, with_key, text)
      character(len=*), intent(in) :: name
      integer, intent(in) :: digit
      integer, intent(in) :: module_number
      !> The key is written for the first one of several only
      logical, intent(in) :: with_key
      character(len=:), allocatable, intent(inout) :: text
      integer :: k, row

      row = key_of(name, module_number)
      if (name /= "H" .and. (word_of_digit(name, digit, module_number) /= "" .or. any(name == ["A", "O", "W"]))) then
         if (with_key) then
            if (key_table(row)%group /= "") text = text // trim(key_table(row)%group) // "."
            text = text // trim(key_table(row)%key) // " = "
         end if
         if (is_choice(name)) then
            text = text // '"' // trim(word_of_digit(name, digit, module_number)) // '"'
         else
            text = text // achar(iachar("0") + digit)
         end if
      else if (part_of(name, digit, module_number) /= "") then
         ! "H = 1 or 3" is one group
         k = index(text, trim(part_of(name, digit, module_number)) // " or ", back=.true.)
         if (k > 0 .and. k == len(text) - len_trim(part_of(name, digit, module_number)) - 3) text = text(:k - 1)
         text = text // trim(part_of(name, digit, module_number))
      else if (is_known(name, digit, module_number)) then
         text = text // "(" // trim(digit_text(name, digit, module_number)) // ")"
      else
         text = text // name // " = " // achar(iachar("0") + digit)
      end if
   end subroutine translate_digit

   !> Condition on the groups of a case that is expressed by a digit that is not a choice; blank for others
   pure function part_of(name, digit, module_number) result(text)
      character(len=*), intent(in) :: name
      integer, intent(in) :: digit, module_number
      character(len=56) :: text

      text = ""
      select case (name)
      case ("D")
         if (module_number == module_3) text = source_of("grid", digit)
         if (module_number == module_1) text = "a case without [case.search]"
      case ("Z")
         if (module_number == module_3) text = source_of("geometry", digit)
         if (module_number == module_1 .and. digit == 0) text = "a case without [case.track] and [case.rail_profile]"
         if (module_number == module_1 .and. digit == 1) text = "[case.track]"
         if (module_number == module_1 .and. digit == 2) text = "[case.deviations]"
         if (module_number == module_1 .and. digit == 3) text = "[case.rail_profile]"
      case ("C"); text = source_of("material", digit)
      case ("L"); text = "a case without [case.friction]"
      case ("G"); text = "a case without [case.iteration]"
      case ("M2"); text = "a case without [case.damping]"
      case ("H"); text = merge("a case without [case.heat]", "[case.heat]               ", digit == 0)
      case ("S"); if (digit == 2) text = "a case without [[case.stress_points]]"
         if (digit == 3) text = "[[case.stress_points]]"
      case ("E")
         if (module_number == module_3) text = "a case without slip_source"
         if (module_number == module_1 .and. digit == 0) text = "a case without [case.position]"
         if (module_number == module_1 .and. digit == 1) text = "[case.position]"
         if (module_number == module_1 .and. digit == 2) text = "[case.velocity]"
         if (module_number == module_1 .and. digit == 3) text = "[case.wheel_profile]"
         if (module_number == module_1 .and. digit == 4) text = "[case.flexibility]"
         if (module_number == module_1 .and. digit == 5) text = "[case.wheel_profile] with [case.flexibility]"
      end select
   end function part_of

   !> A group that is kept, renewed or given
   pure function source_of(group, digit) result(text)
      character(len=*), intent(in) :: group
      integer, intent(in) :: digit
      character(len=40) :: text

      select case (digit)
      case (0); text = "a case without [case." // group // "]"
      case (1); text = 'renew = ["' // group // '"]'
      case default; text = "[case." // group // "]"
      end select
   end function source_of
end module contact_control_words
