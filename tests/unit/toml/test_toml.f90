!> The tree of a text in TOML, positions, and refused texts; values are compared with another parser by test_toml_values.py
program test_toml
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_test_harness, only : test_suite
   use contact_toml_document, only : toml_document, toml_kind
   use contact_text_nearest, only : edit_distance, nearest_word
   use contact_toml_parser, only : parse_toml
   use contact_toml_quantities, only : read_quantity
   implicit none (type, external)
   character, parameter :: nl = achar(10)
   type(test_suite) :: suite

   call suite%start("toml")
   call tree(suite)
   call places(suite)
   call refusals(suite)
   call long_arrays(suite)
   call quantities(suite)
   call neighbours(suite)
   call suite%finish()

contains

   !> Tables, arrays of tables and values
   subroutine tree(suite)
      type(test_suite), intent(inout) :: suite
      type(toml_document) :: d
      type(error_type), allocatable :: error
      integer :: cases, friction, k

      call parse_toml('title = "ball"' // nl // "[[case]]" // nl // 'motion = "shift"' // nl // "[case.friction]" // nl // &
         & "fstat = 0.3 # dry" // nl // "set = [{svf = 0}, {svf = 1_0.5e1}]" // nl // "[[case]]", "a.toml", d, error)
      call suite%check(.not. allocated(error), "a document is read")
      if (allocated(error)) return
      cases = d%child(1, "case")
      call suite%check(d%nodes(cases)%kind == toml_kind%array .and. d%nodes(cases)%count == 2, "two tables in an array")
      k = d%nodes(cases)%first
      call suite%check(d%text_of(d%child(k, "motion")) == "shift", "a text")
      friction = d%child(k, "friction")
      call suite%close_to(d%nodes(d%child(friction, "fstat"))%r, 0.3_wp, 0.0_wp, "a number")
      k = d%nodes(d%child(friction, "set"))%last
      call suite%close_to(d%nodes(d%child(k, "svf"))%r, 105.0_wp, 0.0_wp, "a number in a table in an array")
      call suite%check(d%child(friction, "fkin") == 0, "a key that is not there")
      call suite%check(d%child(1, "motion") == 0, "a key of another table")
   end subroutine tree

   !> Line and column of keys and values
   subroutine places(suite)
      type(test_suite), intent(inout) :: suite
      type(toml_document) :: d
      type(error_type), allocatable :: error

      call parse_toml("a = 1" // nl // "  b.c = [10," // nl // " 'x']", "a.toml", d, error)
      associate (c => d%child(d%child(1, "b"), "c"))
         call suite%check(all([d%nodes(c)%key_line, d%nodes(c)%key_column, d%nodes(c)%line, d%nodes(c)%column] == [2, 5, 2, 9]), &
            & "position of a key and of its value")
         call suite%check(all([d%nodes(d%nodes(c)%last)%line, d%nodes(d%nodes(c)%last)%column] == [3, 2]), &
            & "position of an element")
      end associate
   end subroutine places

   !> Complaints with their positions
   subroutine refusals(suite)
      type(test_suite), intent(inout) :: suite

      call is_refused(suite, "a = 1" // nl // "a = 2", 'x.toml:2:1: "a" is given twice; it was given in line 1')
      call is_refused(suite, "a = 1979-05-27", "x.toml:1:5: ""1979-05-27"" is a date; dates and times have no meaning here")
      call is_refused(suite, "a = nan", 'x.toml:1:5: "nan" is no number that a case can have')
      call is_refused(suite, "a = 0x10", 'x.toml:1:5: "0x10" is not decimal; write 255, not 0xff')
      call is_refused(suite, "a = coulomb", 'x.toml:1:5: "coulomb" is not a value; a text needs quotes, "coulomb"')
      call is_refused(suite, "a = 460mm", 'x.toml:1:5: "460mm" is no number; with a unit it needs quotes and a blank, "460 mm"')
      call is_refused(suite, "a = .5", 'x.toml:1:5: ".5" is no number, a figure must stand before the point')
      call is_refused(suite, "a = [1 2]", 'x.toml:1:8: "2" found where "," or "]" is expected, in the array that begins in line 1')
      call is_refused(suite, "[a]" // nl // "[a]", 'x.toml:2:2: "a" cannot be opened a second time; it was given in line 1')
      call is_refused(suite, "a = 'x", "x.toml:1:5: the text has no closing quote on its line")
      call is_refused(suite, "a = " // repeat("[", 10000), &
         & "x.toml:1:25: arrays and inline tables are nested more than 20 deep")
      call is_refused(suite, "a = 1 b", &
         & 'x.toml:1:7: "b" found where the end of the line is expected; each key or header needs a separate line')
      call is_refused(suite, "a = 1e999", 'x.toml:1:5: "1e999" is too large for a number')
   end subroutine refusals

   !> A text is refused with these words
   subroutine is_refused(suite, text, words)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: text, words
      type(toml_document) :: d
      type(error_type), allocatable :: error

      call parse_toml(text, "x.toml", d, error)
      call suite%check(allocated(error), "refused: " // words)
      if (allocated(error)) call suite%equal(full_text(error), words, "complaint")
   end subroutine is_refused

   !> Time grows with the length of the text only: these would take minutes otherwise
   subroutine long_arrays(suite)
      type(test_suite), intent(inout) :: suite
      type(toml_document) :: d
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text
      character(len=16) :: line
      integer :: k

      call parse_toml("a = [" // repeat("1.5, ", 300000) // "]", "x.toml", d, error)
      call suite%check(.not. allocated(error) .and. d%count == 300002, "an array of many numbers")
      allocate(character(len=16*100000) :: text)
      do k = 1, 100000
         write(line, "(A, I0.8, A)") "k", k, " = 12" // nl
         text(16*k - 15:16*k) = line
      end do
      call parse_toml(text, "x.toml", d, error)
      call suite%check(.not. allocated(error) .and. d%count == 100001, "a table of many keys")
   end subroutine long_arrays

   !> Numbers with units
   subroutine quantities(suite)
      type(test_suite), intent(inout) :: suite

      call is_quantity(suite, "460 mm", "mm", 460.0_wp)
      call is_quantity(suite, "0.46 m", "mm", 460.0_wp)
      call is_quantity(suite, "0.3 um", "mm", 0.3e-3_wp)
      call is_quantity(suite, "10 kN", "N", 1.0e4_wp)
      call is_quantity(suite, "-12 deg", "rad", -12.0_wp*(pi/180.0_wp))
      call is_quantity(suite, "82 GPa", "N/mm2", 82000.0_wp)
      call is_quantity(suite, "8_2e-1 GPa", "N/mm2", 8200.0_wp)
      call is_quantity(suite, "1.5 m/s", "mm/s", 1500.0_wp)
      call is_quantity(suite, "36 km/h", "mm/s", 36.0e6_wp*(1.0_wp/3600.0_wp))
      call is_quantity(suite, "2 1/m", "1/mm", 2.0e-3_wp)
      call is_quantity(suite, "7850 kg/m3", "kg/mm3", 7850.0e-9_wp)
      call is_quantity(suite, "450 J/(kg K)", "J/(kg degC)", 450.0_wp)
      call is_quantity(suite, "50 W/(m K)", "W/(mm degC)", 0.05_wp)
      call is_quantity(suite, "0.1 %", "- or mm", 1.0e-3_wp)
      call is_quantity(suite, "1 um", "- or mm", 1.0e-3_wp)
      call is_quantity(suite, "1 N/um", "N/mm", 1000.0_wp)
      call is_no_quantity(suite, "5 kN", "mm", 'has the unit "kN", expected is mm or a unit that can be converted to it')
      call is_no_quantity(suite, "5 furlong", "mm", 'has the unknown unit "furlong"; expected is mm')
      call is_no_quantity(suite, "300 K", "degC", "is in kelvin; temperatures are in degC")
      call is_no_quantity(suite, "5 mm", "integer", "has a unit, but a plain number is expected")
      call is_no_quantity(suite, "5 mm//s", "mm/s", 'has the unknown unit "mm//s"; expected is mm/s')
      call is_no_quantity(suite, "5 mm/(s", "mm/s", 'has the unknown unit "mm/(s"; expected is mm/s')
      call is_no_quantity(suite, "1e307 km", "mm", "is too large or too small for a number")
      call is_no_quantity(suite, "mm", "mm", 'is no number with a unit; "460 mm" is one, with a blank between them')
   end subroutine quantities

   !> A text is this number
   subroutine is_quantity(suite, text, unit, expected)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: text, unit
      real(wp), intent(in) :: expected
      character(len=:), allocatable :: complaint
      real(wp) :: value

      call read_quantity(text, unit, value, complaint)
      if (allocated(complaint)) then
         call suite%check(.false., text // " " // complaint)
      else
         call suite%close_to(value, expected, 0.0_wp, text // " in " // unit)
      end if
   end subroutine is_quantity

   !> A text is not a quantity with this unit
   subroutine is_no_quantity(suite, text, unit, words)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: text, unit, words
      character(len=:), allocatable :: complaint
      real(wp) :: value

      call read_quantity(text, unit, value, complaint)
      call suite%check(allocated(complaint), "refused: " // text)
      if (allocated(complaint)) call suite%equal(complaint, words, text)
   end subroutine is_no_quantity

   !> Mistyped words
   subroutine neighbours(suite)
      type(test_suite), intent(inout) :: suite
      character(len=8), parameter :: words(4) = [character(len=8) :: "friction", "fstat", "fkin", "grid"]

      call suite%equal(edit_distance("kitten", "sitting"), 3, "distance")
      call suite%equal(edit_distance("grdi", "grid"), 1, "letters swapped")
      call suite%equal(edit_distance("", "grid"), 4, "distance from nothing")
      call suite%equal(nearest_word("fricton", words), 1, "a letter is missing")
      call suite%equal(nearest_word("ftsat", words), 2, "letters swapped in a word of a list")
      call suite%equal(nearest_word("material", words), 0, "nothing similar")
      call suite%equal(nearest_word("", words), 0, "no word")
   end subroutine neighbours
end program test_toml
