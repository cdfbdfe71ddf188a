!> Control digits: digit, named choice and description, in one table for both modules
!>
!> The table is used for reading, checking, refusal of choices that are not implemented, writing of input files, and the tables of
!> doc/user. Decoding and encoding of the three control words are here as well.
!>
!> Long because most of it is the table, one entry per value of a digit.
module contact_control_digits
   use contact_base_choices, only : contact_location, estimate_choice, force_control, kernel_model, &
      & material_model, motion, normal_control, pressure_model, slip_source, solver_choice, time_link, variation
   use contact_friction_new_law, only : friction_model
   implicit none (type, external)
   private

   public :: case_digits, digit_row, digit_table, digit_names
   public :: row_of, belongs, is_known, is_built, choice_of, digit_of, digit_text, allowed_text, digit_value, put_digit
   public :: decode_words, word_text

   !> Length of the description of a value, and of the list of all values of a digit
   integer, parameter, public :: text_length = 80, list_length = 28
   !> Length of the word for a value in the readable format
   integer, parameter, public :: word_length = 18

   !> All digits in the order of the control words; C1 in module 1 only
   character(len=2), parameter :: digit_names(*) = [character(len=2) :: &
      & "C1", "P", "B", "T", "N", "F", "S", "V", "L", "D", "C", "M", "Z", "E", "M2", "X", "H", "G", "I", "A", "O", "W", "R"]
   !> Positions of the first and last digit of words 1, 2 and 3 in the list, without C1; the digits of a case have one number more,
   !> GAPWGT
   integer, parameter :: first_of_word(3) = [2, 8, 16], last_of_word(3) = [7, 14, 23], number_of_digits = size(digit_names) + 1
   !> Letters of the names that have a letter only
   integer, parameter :: single_letters(*) = merge(iachar(digit_names(:)(1:1)), -1, digit_names(:)(2:2) == " ")

   !> Digits of a case: integers only, in the order of digit_names, so that they can be used as a list
   type :: case_digits
      sequence
      !> Configuration, module 1 only
      integer :: c1 = 0
      integer :: p = 2, b = 0, t = 0, n = 0, f = 0, s = 0
      integer :: v = 0, l = 0, d = 0, c = 0, m = 0, z = 0, e = 0, m2 = 1
      integer :: x = 0, h = 0, g = 0, i = 0, a = 0, o = 0, w = 0, r = 0
      !> Weighting of gaps, written before M2; it has no letter
      integer :: gapwgt = 0
   end type case_digits

   !> The same as a list: converted by `transfer`, without heap memory
   type :: digit_list
      integer :: value(number_of_digits) = 0
   end type digit_list

   !> One value of a control digit
   type :: digit_row
      !> Letter of the digit; the second material digit is called M2
      character(len=2) :: name
      !> The digit
      integer :: digit
      !> Member of the enumeration in contact_base_choices, or the digit itself if there is none
      integer :: choice
      !> Module that has this value, 0 for both
      integer :: module_number
      !> Is it implemented in this version?
      logical :: built
      !> Meaning; the name of the effect if it is not implemented
      character(len=text_length) :: text
      !> The choice in the readable format; blank if it follows from the data of a case, or is not expressed there
      character(len=word_length) :: word = ""
   end type digit_row

   integer, parameter :: both = 0, module_1 = 1, module_3 = 3

   type(digit_row), parameter :: word1_rows(*) = [ &
      & digit_row("C1", 0, 0, module_1, .true., "left wheel on the track", "left_on_track"), &
      & digit_row("C1", 1, 1, module_1, .true., "right wheel on the track", "right_on_track"), &
      & digit_row("C1", 4, 4, module_1, .true., "left wheel on a roller", "left_on_roller"), &
      & digit_row("C1", 5, 5, module_1, .true., "right wheel on a roller", "right_on_roller"), &
      & digit_row("P", 0, time_link%continue_all, both, .true., &
      & "new time step: the previous case gives the previous tractions", "continue_all"), &
      & digit_row("P", 1, time_link%continue_normal, both, .true., &
      & "new time step for pressures; previous shear tractions are zero", "continue_normal"), &
      & digit_row("P", 2, time_link%initiate, both, .true., "new sequence: no previous tractions", "initiate"), &
      & digit_row("P", 3, time_link%repeat_step, both, .true., &
      & "new iteration: previous tractions stay as they are", "repeat_step"), &
      & digit_row("B", 0, pressure_model%full, both, .true., "full solution of the normal problem", "full"), &
      & digit_row("B", 1, pressure_model%thin_sheet, both, .true., &
      & "elastic thin sheet with a vertical flexibility", "thin_sheet"), &
      & digit_row("B", 2, pressure_model%elliptical, module_3, .true., &
      & "Hertzian: elliptical pressure and traction bound", "elliptical"), &
      & digit_row("B", 3, pressure_model%parabolical, module_3, .true., &
      & "Hertzian ellipse with a parabolical traction bound", "parabolical"), &
      & digit_row("B", 4, pressure_model%sdec, module_3, .true., "simple double-elliptical contact (SDEC)", "sdec"), &
      & digit_row("B", 5, pressure_model%kpec, both, .true., "Kik-Piotrowski approach with ellipse correction (KPEC)", "kpec"), &
      & digit_row("B", 6, pressure_model%analyn, both, .true., "modified ANALYN approach", "analyn"), &
      & digit_row("T", 0, motion%none, both, .true., "frictionless compression", "none"), &
      & digit_row("T", 1, motion%shift, both, .true., "shift, or rolling with material-fixed coordinates", "shift"), &
      & digit_row("T", 2, motion%transient_rolling, both, .true., "transient rolling, moving coordinates", "transient_rolling"), &
      & digit_row("T", 3, motion%steady_rolling, both, .true., "steady rolling, direct method", "steady_rolling"), &
      & digit_row("N", 0, normal_control%approach, module_3, .true., "approach PEN prescribed", "approach"), &
      & digit_row("N", 1, normal_control%force, module_3, .true., "normal force FN prescribed", "force"), &
      & digit_row("N", 0, normal_control%approach, module_1, .true., "height Z_WS of the wheelset prescribed", "approach"), &
      & digit_row("N", 1, normal_control%force, module_1, .true., "vertical force FZ prescribed", "force"), &
      & digit_row("F", 0, force_control%creepages, module_3, .true., "creepages CKSI and CETA prescribed", "creepages"), &
      & digit_row("F", 1, force_control%fx_and_ceta, module_3, .true., "force FX and creepage CETA prescribed", "fx_and_ceta"), &
      & digit_row("F", 2, force_control%fx_and_fy, module_3, .true., "forces FX and FY prescribed", "fx_and_fy"), &
      & digit_row("F", 0, force_control%creepages, module_1, .true., "velocities prescribed", "velocities"), &
      & digit_row("F", 1, force_control%longitudinal_force, module_1, .true., &
      & "longitudinal force instead of the pitch velocity", "longitudinal_force"), &
      & digit_row("F", 3, force_control%massless_rail, module_1, .true., "rail without mass on springs", "massless_rail"), &
      & digit_row("S", 0, 0, both, .true., "no subsurface stresses", "none"), &
      & digit_row("S", 1, 1, both, .true., "subsurface stresses in the points in store", "stored_points"), &
      & digit_row("S", 2, 2, both, .true., "as 1, with new output digits"), &
      & digit_row("S", 3, 3, both, .true., "new output digits and new subsurface points")]

   type(digit_row), parameter :: word2_rows(*) = [ &
      & digit_row("V", 0, variation%none, both, .true., "one set of friction parameters", "none"), &
      & digit_row("V", 3, variation%by_row, module_3, .true., "friction parameters for each row of the grid", "by_row"), &
      & digit_row("V", 1, variation%by_angle, module_1, .true., &
      & "friction parameters by the inclination of the rail surface", "by_angle"), &
      & digit_row("V", 2, variation%by_position, module_1, .true., &
      & "friction parameters by the position along the track", "by_position"), &
      & digit_row("L", 0, friction_model%coulomb, both, .true., "Coulomb friction", "coulomb"), &
      & digit_row("L", 1, 1, both, .true., "keep the friction law of the previous case"), &
      & digit_row("L", 2, friction_model%linear, both, .true., "friction falling with slip velocity, piecewise linear", "linear"), &
      & digit_row("L", 3, friction_model%rational, both, .true., "friction falling with slip velocity, rational", "rational"), &
      & digit_row("L", 4, friction_model%exponential, both, .true., &
      & "friction falling with slip velocity, exponential", "exponential"), &
      & digit_row("L", 6, friction_model%temperature, both, .true., "friction changing with surface temperature", "temperature"), &
      & digit_row("D", 0, 0, module_3, .true., "keep the potential contact area"), &
      & digit_row("D", 1, 1, module_3, .true., "form the potential contact area from the values in store"), &
      & digit_row("D", 2, 2, module_3, .true., "read the potential contact area"), &
      & digit_row("D", 0, 0, module_1, .true., "keep the settings of search and discretisation"), &
      & digit_row("D", 1, 1, module_1, .true., "keep the settings of search and discretisation"), &
      & digit_row("D", 2, contact_location%locus, module_1, .true., "flat contact, contact locus", "locus"), &
      & digit_row("D", 3, contact_location%locus_extended, module_1, .true., &
      & "flat contact, contact locus, extended rigid slip", "locus_extended"), &
      & digit_row("D", 4, contact_location%conformal, module_1, .true., "conformal contact, contact locus", "conformal"), &
      & digit_row("D", 5, contact_location%grid, module_1, .true., "flat contact, search over a grid", "grid"), &
      & digit_row("D", 6, contact_location%steep_grid, module_1, .true., &
      & "flat contact, the same search over a grid", "steep_grid"), &
      & digit_row("D", 7, contact_location%first_contact, module_1, .true., &
      & "flat contact, first point of contact as reference", "first_contact"), &
      & digit_row("D", 8, contact_location%oblique_locus, module_1, .false., &
      & "contact locus in an oblique view that fits few profiles", "oblique_locus"), &
      & digit_row("D", 9, contact_location%oblique_grid, module_1, .false., &
      & "grid search in an oblique view that fits few profiles", "oblique_grid"), &
      & digit_row("C", 0, 0, module_3, .true., "keep the influence coefficients"), &
      & digit_row("C", 1, 1, both, .true., "form the influence coefficients from the values in store"), &
      & digit_row("C", 2, kernel_model%piecewise_constant, both, .true., &
      & "half-space, piecewise constant", "piecewise_constant"), &
      & digit_row("C", 3, kernel_model%bilinear, both, .true., "half-space with bilinear tractions", "bilinear"), &
      & digit_row("C", 4, kernel_model%conformal, both, .true., &
      & "half-space with angle correction for conformal contact", "conformal"), &
      & digit_row("C", 9, kernel_model%tabulated, both, .true., "numerical influence coefficients from a file", "tabulated"), &
      & digit_row("C", 0, 0, module_1, .true., "as 1"), &
      & digit_row("M", 0, material_model%elastic, both, .true., "elastic", "elastic"), &
      & digit_row("M", 1, material_model%viscoelastic, both, .true., "viscoelastic", "viscoelastic"), &
      & digit_row("M", 2, material_model%fastsim_single, both, .true., &
      & "simplified theory, one flexibility (modified Fastsim)", "fastsim_single"), &
      & digit_row("M", 3, material_model%fastsim, both, .true., &
      & "simplified theory, three flexibilities (modified Fastsim)", "fastsim"), &
      & digit_row("M", 4, material_model%interfacial_layer, both, .true., &
      & "interfacial layer with near-surface plasticity", "interfacial_layer"), &
      & digit_row("M", 5, material_model%fastrip, both, .true., "modified FaStrip", "fastrip"), &
      & digit_row("M", 6, material_model%fastrip_plain, both, .true., &
      & "FaStrip as published, without slope reduction", "fastrip_plain"), &
      & digit_row("M", 7, material_model%fastrip_sliding, both, .true., &
      & "FaStrip as published, with the correction of full sliding", "fastrip_sliding"), &
      & digit_row("Z", 0, 0, module_3, .true., "keep the undeformed distance and planform"), &
      & digit_row("Z", 1, 1, module_3, .true., "form the undeformed distance from the values in store"), &
      & digit_row("Z", 2, 2, module_3, .true., "read the undeformed distance and planform"), &
      & digit_row("Z", 0, 0, module_1, .true., "keep track and rail"), &
      & digit_row("Z", 1, 1, module_1, .true., "read the track dimensions"), &
      & digit_row("Z", 2, 2, module_1, .true., "read the deviations of the rail"), &
      & digit_row("Z", 3, 3, module_1, .true., "read track dimensions, rail profile and deviations"), &
      & digit_row("E", 0, slip_source%none, module_3, .true., "no extra term in the rigid slip", "none"), &
      & digit_row("E", 1, 1, module_3, .true., "keep the extra term of the previous case"), &
      & digit_row("E", 2, slip_source%no_spin_y, module_3, .true., &
      & "extra term that cancels the lateral part of the spin", "no_spin_y"), &
      & digit_row("E", 3, slip_source%no_spin_x, module_3, .true., &
      & "extra term that cancels the longitudinal part of the spin", "no_spin_x"), &
      & digit_row("E", 9, slip_source%given, module_3, .true., "read an extra term for each element", "given"), &
      & digit_row("E", 0, 0, module_1, .true., "keep wheelset, position and velocity"), &
      & digit_row("E", 1, 1, module_1, .true., "read the position of the wheelset"), &
      & digit_row("E", 2, 2, module_1, .true., "read position and velocity"), &
      & digit_row("E", 3, 3, module_1, .true., "read wheelset dimensions, wheel profile, position and velocity"), &
      & digit_row("E", 4, 4, module_1, .true., "as 2, with the flexible deviations of the wheelset"), &
      & digit_row("E", 5, 5, module_1, .true., "as 3, with the flexible deviations of the wheelset"), &
      & digit_row("M2", 0, 0, both, .true., "no damping", "none"), &
      & digit_row("M2", 1, 1, both, .true., "keep the damping of the previous case"), &
      & digit_row("M2", 2, 2, both, .true., "force-based proportional damping", "proportional")]

   type(digit_row), parameter :: word3_rows(*) = [ &
      & digit_row("X", 0, 0, both, .true., "no fourth control word"), &
      & digit_row("X", 1, 1, both, .true., "a fourth control word follows, which is read and ignored"), &
      & digit_row("H", 0, 0, both, .true., "no surface temperatures", "none"), &
      & digit_row("H", 1, 1, both, .true., "surface temperatures with the values in store"), &
      & digit_row("H", 3, 1, both, .true., "surface temperatures with new values", "flash"), &
      & digit_row("G", 0, solver_choice%default, both, .true., "default solvers", "default"), &
      & digit_row("G", 1, 1, both, .true., "keep the solver settings of the previous case"), &
      & digit_row("G", 2, solver_choice%convex_gs, both, .true., &
      & "with --classical ConvexGS always; relaxation is read", "convex_gs"), &
      & digit_row("G", 3, solver_choice%gauss_seidel, both, .true., &
      & "with --classical SteadyGS in steady rolling; relaxation is read", "gauss_seidel"), &
      & digit_row("G", 4, solver_choice%default_friction, both, .true., &
      & "default solvers, slip velocity iteration is read", "default_friction"), &
      & digit_row("G", 5, solver_choice%gd_steady, both, .true., &
      & "with --classical GDsteady in steady rolling; its parameters are read", "gd_steady"), &
      & digit_row("I", 0, estimate_choice%fresh, both, .true., "start from zero tractions", "fresh"), &
      & digit_row("I", 1, estimate_choice%previous, both, .true., "start from the previous solution, regularised", "previous"), &
      & digit_row("I", 2, estimate_choice%previous_normal, both, .true., &
      & "start from the previous pressures only", "previous_normal"), &
      & digit_row("I", 3, estimate_choice%unchanged, both, .true., "start from the previous solution, untouched", "unchanged"), &
      & digit_row("A", 0, 0, both, .true., "no .mat file"), &
      & digit_row("A", 1, 1, both, .true., ".mat file with the elements in contact"), &
      & digit_row("A", 2, 2, both, .true., ".mat file with all elements"), &
      & digit_row("O", 0, 0, both, .true., "no results in the .out file"), &
      & digit_row("O", 1, 1, both, .true., "global results"), &
      & digit_row("O", 2, 2, both, .true., "as 1, with the input"), &
      & digit_row("O", 3, 3, both, .true., "as 2, with a picture of the contact area"), &
      & digit_row("O", 4, 4, both, .true., "as 3"), &
      & digit_row("O", 5, 5, both, .true., "as 4, with a table of the elements in contact"), &
      & digit_row("O", 6, 6, both, .true., "as 4, with a table of all elements"), &
      & digit_row("W", 0, 0, both, .true., "no flow trace"), &
      & digit_row("W", 1, 1, both, .true., "outer iteration"), &
      & digit_row("W", 2, 2, both, .true., "as 1, with the iteration of slip velocity and friction"), &
      & digit_row("W", 3, 3, both, .true., "as 2, with the normal and tangential algorithms"), &
      & digit_row("W", 4, 4, both, .true., "as 3, with the Newton-Raphson iteration of forces"), &
      & digit_row("W", 5, 5, both, .true., "as 4, with the tangential solvers"), &
      & digit_row("W", 6, 6, both, .true., "as 5, with the normal solver"), &
      & digit_row("W", 7, 7, both, .true., "as 6"), &
      & digit_row("W", 8, 8, both, .true., "as 6"), &
      & digit_row("W", 9, 9, both, .true., "full flow trace, with pictures of the element division"), &
      & digit_row("R", 0, 0, both, .true., "solve; the next case of this module follows"), &
      & digit_row("R", 1, 1, both, .true., "solve; a module line follows"), &
      & digit_row("R", 2, 2, both, .true., "store the input only; the next case of this module follows"), &
      & digit_row("R", 3, 3, both, .true., "store the input only; a module line follows")]

   !> Every accepted value of every digit, in the order of digit_names
   type(digit_row), parameter :: digit_table(*) = [word1_rows, word2_rows, word3_rows]
   !> Names as a separate list, and their first letters with a terminator
   character(len=2), parameter :: row_names(*) = digit_table%name
   integer, parameter :: letters(*) = [iachar(row_names(:)(1:1)), 0]
   integer :: i
   !> First row of each letter, 0: none, and the next row with the same letter; the last one refers to itself
   integer, parameter :: first_row(0:127) = [(findloc(letters(:size(digit_table)), i, dim=1), i=0, 127)]
   integer, parameter :: next_row(*) = [(i + findloc(letters(i + 1:), letters(i), dim=1), i=1, size(digit_table))]
   !> Position in the list of the name that is this letter only, 0: none
   integer, parameter :: place_of_letter(0:127) = [(findloc(single_letters, i, dim=1), i=0, 127)]

contains

   !> Row of the table, 0: none
   pure integer function row_of(name, digit, module_number) result(row)
      !> Capital letter of the digit, with a figure for C1 and similar names
      character(len=*), intent(in) :: name
      !> Value as in the input
      integer, intent(in) :: digit
      integer, intent(in) :: module_number
      character(len=2) :: key

      key = name
      row = first_row(iachar(key(1:1)))
      do while (row > 0)
         if (digit_table(row)%digit == digit .and. belongs(digit_table(row), module_number)) then
            if (digit_table(row)%name == key) return
         end if
         row = merge(0, next_row(row), next_row(row) == row)
      end do
   end function row_of

   !> Does a row apply to a module?
   elemental logical function belongs(row, module_number)
      !> Row of the table
      type(digit_row), intent(in) :: row
      integer, intent(in) :: module_number

      belongs = row%module_number == both .or. row%module_number == module_number
   end function belongs

   !> Does the format have this value of the digit?
   pure logical function is_known(name, digit, module_number)
      !> Capital letter of the digit, with a figure for C1 and similar names
      character(len=*), intent(in) :: name
      !> Value as in the input
      integer, intent(in) :: digit
      integer, intent(in) :: module_number

      is_known = row_of(name, digit, module_number) > 0
   end function is_known

   !> Is this value implemented in this version? False for unknown values as well
   pure logical function is_built(name, digit, module_number)
      !> Capital letter of the digit, with a figure for C1 and similar names
      character(len=*), intent(in) :: name
      !> Value as in the input
      integer, intent(in) :: digit
      integer, intent(in) :: module_number
      integer :: row

      row = row_of(name, digit, module_number)
      is_built = .false.
      if (row > 0) is_built = digit_table(row)%built
   end function is_built

   !> Named choice of a digit; an unknown digit is returned unchanged
   pure integer function choice_of(name, digit, module_number) result(choice)
      !> Capital letter of the digit, with a figure for C1 and similar names
      character(len=*), intent(in) :: name
      !> Value as in the input
      integer, intent(in) :: digit
      integer, intent(in) :: module_number
      integer :: row

      row = row_of(name, digit, module_number)
      choice = digit
      if (row > 0) choice = digit_table(row)%choice
   end function choice_of

   !> Digit of a named choice, -1: none
   pure integer function digit_of(name, choice, module_number) result(digit)
      !> Capital letter of the digit, with a figure for C1 and similar names
      character(len=*), intent(in) :: name
      !> Member of the enumeration in contact_base_choices that belongs to it
      integer, intent(in) :: choice
      integer, intent(in) :: module_number
      integer :: row

      digit = -1
      row = first_row(iachar(name(1:1)))
      do while (row > 0)
         if (digit_table(row)%choice == choice .and. belongs(digit_table(row), module_number)) then
            if (digit_table(row)%name == name) then
               digit = digit_table(row)%digit
               return
            end if
         end if
         row = merge(0, next_row(row), next_row(row) == row)
      end do
   end function digit_of

   !> Meaning of a digit, in words
   pure function digit_text(name, digit, module_number) result(text)
      !> Capital letter of the digit, with a figure for C1 and similar names
      character(len=*), intent(in) :: name
      !> Value as in the input
      integer, intent(in) :: digit
      integer, intent(in) :: module_number
      character(len=text_length) :: text
      integer :: row

      row = row_of(name, digit, module_number)
      text = "unknown"
      if (row > 0) text = digit_table(row)%text
   end function digit_text

   !> The known values of a digit for messages, "0, 1, 2, 3"
   pure function allowed_text(name, module_number) result(text)
      !> Capital letter of the digit, with a figure for C1 and similar names
      character(len=*), intent(in) :: name
      integer, intent(in) :: module_number
      character(len=list_length) :: text
      integer :: digit

      text = ""
      do digit = 0, 9
         if (is_known(name, digit, module_number)) text = trim(text) // ", " // achar(iachar("0") + digit)
      end do
      text = text(3:)
   end function allowed_text

   !> Position of a name in digit_names, 0: none
   pure integer function place_of(name) result(k)
      character(len=*), intent(in) :: name

      k = 0
      if (len(name) == 0) return
      k = place_of_letter(iachar(name(1:1)))
      if (len_trim(name) == 1) return
      do k = 1, size(digit_names)
         if (digit_names(k)(1:1) /= name(1:1)) cycle
         if (digit_names(k) == name) return
      end do
      k = 0
   end function place_of

   !> Value of the digit with the given name, -1: none
   pure integer function digit_value(digits, name) result(digit)
      type(case_digits), intent(in) :: digits
      !> Capital letter of the digit, with a figure for C1 and similar names
      character(len=*), intent(in) :: name
      type(digit_list) :: list
      integer :: k

      digit = -1
      k = place_of(name)
      if (k == 0) return
      list = transfer(digits, list)
      digit = list%value(k)
   end function digit_value

   !> Set a control digit
   pure subroutine put_digit(digits, name, value)
      type(case_digits), intent(inout) :: digits
      !> Capital letter of the digit, with a figure for C1 and similar names
      character(len=*), intent(in) :: name
      !> Value as in the input
      integer, intent(in) :: value
      type(digit_list) :: list
      integer :: k

      k = place_of(name)
      if (k == 0) return
      list = transfer(digits, list)
      list%value(k) = value
      digits = transfer(list, digits)
   end subroutine put_digit

   !> Decode the control words, starting from the right
   !>
   !> Missing leading digits are zero. Excess digits to the left of V and X remain part of V and X, which are then out of range;
   !> digits to the left of P are C1 in module 1 and are ignored in module 3. Signs are checked by the caller.
   pure subroutine decode_words(word1, word2, word3, module_number, digits, second)
      !> C1 P B T N F S; V L D C M Z E; X H G I A O W R
      integer, intent(in) :: word1, word2, word3
      integer, intent(in) :: module_number
      !> Digits of the case; GAPWGT is kept if there is no second number
      type(case_digits), intent(inout) :: digits
      !> Second number of word 2, 10 GAPWGT + M2; absent: damping is kept
      integer, intent(in), optional :: second
      type(digit_list) :: list
      integer :: c1

      c1 = digits%c1
      list = transfer(digits, list)
      call split_digits(word1, list%value(first_of_word(1) - 1:last_of_word(1)))
      call split_digits(word2, list%value(first_of_word(2):last_of_word(2)))
      call split_digits(word3, list%value(first_of_word(3):last_of_word(3)))
      digits = transfer(list, digits)
      if (module_number /= module_1) digits%c1 = c1
      digits%m2 = 1
      if (.not. present(second)) return
      digits%m2 = mod(max(0, second), 10)
      digits%gapwgt = max(0, second)/10
   end subroutine decode_words

   !> Decimal digits of a word; the first one holds all that remains to the left of the others
   pure subroutine split_digits(word, list)
      integer, intent(in) :: word
      integer, intent(out) :: list(:)
      integer :: k, rest

      rest = abs(word)
      do k = size(list), 2, -1
         list(k) = mod(rest, 10)
         rest = rest/10
      end do
      list(1) = rest
   end subroutine split_digits

   !> A control word as written in files, without C1 and X
   pure function word_text(digits, word) result(text)
      type(case_digits), intent(in) :: digits
      !> 1, 2 or 3
      integer, intent(in) :: word
      character(len=last_of_word(word) - first_of_word(word) + merge(0, 1, word == 3)) :: text
      type(digit_list) :: list
      integer :: k

      list = transfer(digits, list)
      do k = 1, len(text)
         text(k:k) = achar(iachar("0") + list%value(last_of_word(word) - len(text) + k))
      end do
   end function word_text
end module contact_control_digits
