!> The control digits of module 3: digit, named choice and words, in one table
!>
!> The table serves reading, checking, refusing what is not built, writing of input files and
!> the tables of doc/user/input.md. Decoding and encoding of the three control words is here too.
module contact_control_digits
   use contact_base_choices, only : estimate_choice, force_control, friction_model, heat_model, kernel_model, &
      & material_model, motion, normal_control, pressure_model, slip_source, solver_choice, stress_choice, &
      & time_link, variation
   use contact_cases_spec, only : case_digits
   implicit none (type, external)
   private

   public :: digit_row, digit_table, digit_names
   public :: is_known, is_built, choice_of, digit_of, digit_text, allowed_text, listed, digit_value
   public :: decode_words, encode_words, word_text

   !> Length of the words for a value, and of the list of all values of a digit
   integer, parameter, public :: text_length = 80, list_length = 28

   !> One value of one control digit
   type :: digit_row
      !> Letter of the digit; the second material digit is called M2
      character(len=2) :: name
      !> The digit
      integer :: digit
      !> Member of the enumeration in contact_base_choices, or the digit itself where there is none
      integer :: choice
      !> Can this version compute it?
      logical :: built
      !> What it means; for what is not built: the name of the effect
      character(len=text_length) :: text
   end type digit_row

   !> All digits in the order of the control words
   character(len=2), parameter :: digit_names(*) = [character(len=2) :: &
      & "P", "B", "T", "N", "F", "S", "V", "L", "D", "C", "M", "Z", "E", "M2", "X", "H", "G", "I", "A", "O", "W", "R"]

   type(digit_row), parameter :: word1_rows(*) = [ &
      & digit_row("P", 0, time_link%continue_all, .true., "new time step: the previous case gives the previous tractions"), &
      & digit_row("P", 1, time_link%continue_normal, .true., "as 0 for the pressures; previous shear tractions are zero"), &
      & digit_row("P", 2, time_link%initiate, .true., "new sequence: no previous tractions"), &
      & digit_row("P", 3, time_link%repeat_step, .true., "new iteration: previous tractions stay as they are"), &
      & digit_row("B", 0, pressure_model%full, .true., "full solution of the normal problem"), &
      & digit_row("B", 1, pressure_model%thin_sheet, .true., "elastic thin sheet with a vertical flexibility"), &
      & digit_row("B", 2, pressure_model%elliptical, .true., "Hertzian: elliptical pressure and traction bound"), &
      & digit_row("B", 3, pressure_model%parabolical, .true., "Hertzian ellipse with a parabolical traction bound"), &
      & digit_row("B", 4, pressure_model%sdec, .true., "simple double-elliptical contact (SDEC)"), &
      & digit_row("B", 5, pressure_model%kpec, .true., "Kik-Piotrowski approach with ellipse correction (KPEC)"), &
      & digit_row("B", 6, pressure_model%analyn, .true., "modified ANALYN approach"), &
      & digit_row("T", 0, motion%none, .true., "frictionless compression"), &
      & digit_row("T", 1, motion%shift, .true., "shift, or rolling with material-fixed coordinates"), &
      & digit_row("T", 2, motion%transient_rolling, .true., "transient rolling, moving coordinates"), &
      & digit_row("T", 3, motion%steady_rolling, .true., "steady rolling, direct method"), &
      & digit_row("N", 0, normal_control%approach, .true., "approach PEN prescribed"), &
      & digit_row("N", 1, normal_control%force, .true., "normal force FN prescribed"), &
      & digit_row("F", 0, force_control%creepages, .true., "creepages CKSI and CETA prescribed"), &
      & digit_row("F", 1, force_control%fx_and_ceta, .true., "force FX and creepage CETA prescribed"), &
      & digit_row("F", 2, force_control%fx_and_fy, .true., "forces FX and FY prescribed"), &
      & digit_row("S", 0, stress_choice%none, .true., "no subsurface stresses"), &
      & digit_row("S", 1, stress_choice%keep, .true., "subsurface stresses in the points in store"), &
      & digit_row("S", 2, stress_choice%new_output, .true., "as 1, with new output digits"), &
      & digit_row("S", 3, stress_choice%new_points, .true., "new output digits and new subsurface points")]

   type(digit_row), parameter :: word2_rows(*) = [ &
      & digit_row("V", 0, variation%none, .true., "one set of friction parameters"), &
      & digit_row("V", 3, variation%by_row, .true., "friction parameters for each row of the grid"), &
      & digit_row("L", 0, friction_model%coulomb, .true., "Coulomb friction"), &
      & digit_row("L", 1, 1, .true., "keep the friction law of the previous case"), &
      & digit_row("L", 2, friction_model%linear, .true., "friction falling with slip velocity, piecewise linear"), &
      & digit_row("L", 3, friction_model%rational, .true., "friction falling with slip velocity, rational"), &
      & digit_row("L", 4, friction_model%exponential, .true., "friction falling with slip velocity, exponential"), &
      & digit_row("L", 6, friction_model%temperature, .true., "friction changing with surface temperature"), &
      & digit_row("D", 0, 0, .true., "keep the potential contact area"), &
      & digit_row("D", 1, 1, .true., "form the potential contact area from the values in store"), &
      & digit_row("D", 2, 2, .true., "read the potential contact area"), &
      & digit_row("C", 0, 0, .true., "keep the influence coefficients"), &
      & digit_row("C", 1, 1, .true., "form the influence coefficients from the values in store"), &
      & digit_row("C", 2, kernel_model%piecewise_constant, .true., "half-space, piecewise constant; read materials"), &
      & digit_row("C", 3, kernel_model%bilinear, .true., "half-space with bilinear tractions"), &
      & digit_row("C", 4, kernel_model%conformal, .true., "half-space with angle correction for conformal contact"), &
      & digit_row("C", 9, kernel_model%tabulated, .true., "numerical influence coefficients from a file"), &
      & digit_row("M", 0, material_model%elastic, .true., "elastic"), &
      & digit_row("M", 1, material_model%viscoelastic, .true., "viscoelastic"), &
      & digit_row("M", 2, material_model%fastsim_single, .true., "simplified theory, one flexibility (modified Fastsim)"), &
      & digit_row("M", 3, material_model%fastsim, .true., "simplified theory, three flexibilities (modified Fastsim)"), &
      & digit_row("M", 4, material_model%interfacial_layer, .true., "interfacial layer with near-surface plasticity"), &
      & digit_row("M", 5, material_model%fastrip, .true., "modified FaStrip"), &
      & digit_row("M", 6, material_model%fastrip_plain, .true., "FaStrip as published, without slope reduction"), &
      & digit_row("M", 7, material_model%fastrip_sliding, .true., "as 6, with the correction of full sliding"), &
      & digit_row("Z", 0, 0, .true., "keep the undeformed distance and planform"), &
      & digit_row("Z", 1, 1, .true., "form the undeformed distance from the values in store"), &
      & digit_row("Z", 2, 2, .true., "read the undeformed distance and planform"), &
      & digit_row("E", 0, slip_source%none, .true., "no extra term in the rigid slip"), &
      & digit_row("E", 1, slip_source%keep, .true., "keep the extra term of the previous case"), &
      & digit_row("E", 2, slip_source%no_spin_y, .true., "extra term that cancels the lateral part of the spin"), &
      & digit_row("E", 3, slip_source%no_spin_x, .true., "extra term that cancels the longitudinal part of the spin"), &
      & digit_row("E", 9, slip_source%given, .true., "read an extra term for each element"), &
      & digit_row("M2", 0, 0, .true., "no damping"), &
      & digit_row("M2", 1, 1, .true., "keep the damping of the previous case"), &
      & digit_row("M2", 2, 2, .true., "force-based proportional damping")]

   type(digit_row), parameter :: word3_rows(*) = [ &
      & digit_row("X", 0, 0, .true., "no fourth control word"), &
      & digit_row("X", 1, 1, .true., "a fourth control word follows, which is read and ignored"), &
      & digit_row("H", 0, heat_model%none, .true., "no surface temperatures"), &
      & digit_row("H", 1, heat_model%keep, .true., "surface temperatures with the values in store"), &
      & digit_row("H", 3, heat_model%given, .true., "surface temperatures with new values"), &
      & digit_row("G", 0, solver_choice%default, .true., "default solvers"), &
      & digit_row("G", 1, 1, .true., "keep the solver settings of the previous case"), &
      & digit_row("G", 2, solver_choice%convex_gs, .true., "ConvexGS always, relaxation is read"), &
      & digit_row("G", 3, solver_choice%gauss_seidel, .true., "SteadyGS in steady rolling, relaxation is read"), &
      & digit_row("G", 4, solver_choice%default_friction, .true., "default solvers, slip velocity iteration is read"), &
      & digit_row("G", 5, solver_choice%gd_steady, .true., "GDsteady in steady rolling, its parameters are read"), &
      & digit_row("I", 0, estimate_choice%fresh, .true., "start from zero tractions"), &
      & digit_row("I", 1, estimate_choice%previous, .true., "start from the previous solution, regularised"), &
      & digit_row("I", 2, estimate_choice%previous_normal, .true., "start from the previous pressures only"), &
      & digit_row("I", 3, estimate_choice%unchanged, .true., "start from the previous solution, untouched"), &
      & digit_row("A", 0, 0, .true., "no .mat file"), &
      & digit_row("A", 1, 1, .true., ".mat file with the elements in contact"), &
      & digit_row("A", 2, 2, .true., ".mat file with all elements"), &
      & digit_row("O", 0, 0, .true., "no results in the .out file"), &
      & digit_row("O", 1, 1, .true., "global results"), &
      & digit_row("O", 2, 2, .true., "as 1, with the input"), &
      & digit_row("O", 3, 3, .true., "as 2, with a picture of the contact area"), &
      & digit_row("O", 4, 4, .true., "as 3"), &
      & digit_row("O", 5, 5, .true., "as 4, with a table of the elements in contact"), &
      & digit_row("O", 6, 6, .true., "as 4, with a table of all elements"), &
      & digit_row("W", 0, 0, .true., "no flow trace"), &
      & digit_row("W", 1, 1, .true., "outer iteration"), &
      & digit_row("W", 2, 2, .true., "as 1, with the iteration of slip velocity and friction"), &
      & digit_row("W", 3, 3, .true., "as 2, with the normal and tangential algorithms"), &
      & digit_row("W", 4, 4, .true., "as 3, with the Newton-Raphson iteration of forces"), &
      & digit_row("W", 5, 5, .true., "as 4, with the tangential solvers"), &
      & digit_row("W", 6, 6, .true., "as 5, with the normal solver"), &
      & digit_row("W", 7, 7, .true., "as 6"), &
      & digit_row("W", 8, 8, .true., "as 6"), &
      & digit_row("W", 9, 9, .true., "full flow trace, with pictures of the element division"), &
      & digit_row("R", 0, 0, .true., "solve; the next case of this module follows"), &
      & digit_row("R", 1, 1, .true., "solve; a module line follows"), &
      & digit_row("R", 2, 2, .true., "store the input only; the next case of this module follows"), &
      & digit_row("R", 3, 3, .true., "store the input only; a module line follows")]

   !> Every accepted value of every digit, in the order of digit_names
   type(digit_row), parameter :: digit_table(*) = [word1_rows, word2_rows, word3_rows]

contains

   !> Row of the table, 0 when there is none
   pure integer function row_of(name, digit) result(row)
      character(len=*), intent(in) :: name
      integer, intent(in) :: digit
      character(len=2) :: key

      key = name
      do row = 1, size(digit_table)
         if (digit_table(row)%digit == digit .and. digit_table(row)%name == key) return
      end do
      row = 0
   end function row_of

   !> Does the format know this value of the digit?
   pure logical function is_known(name, digit)
      character(len=*), intent(in) :: name
      integer, intent(in) :: digit

      is_known = row_of(name, digit) > 0
   end function is_known

   !> Can this version compute it? False for unknown values too
   pure logical function is_built(name, digit)
      character(len=*), intent(in) :: name
      integer, intent(in) :: digit
      integer :: row

      row = row_of(name, digit)
      is_built = .false.
      if (row > 0) is_built = digit_table(row)%built
   end function is_built

   !> Named choice behind a digit; an unknown digit is handed back as it is
   pure integer function choice_of(name, digit) result(choice)
      character(len=*), intent(in) :: name
      integer, intent(in) :: digit
      integer :: row

      row = row_of(name, digit)
      choice = digit
      if (row > 0) choice = digit_table(row)%choice
   end function choice_of

   !> Digit that stands for a named choice, -1 when there is none
   pure integer function digit_of(name, choice) result(digit)
      character(len=*), intent(in) :: name
      integer, intent(in) :: choice
      integer :: row

      digit = -1
      do row = 1, size(digit_table)
         if (digit_table(row)%choice /= choice .or. digit_table(row)%name /= name) cycle
         digit = digit_table(row)%digit
         return
      end do
   end function digit_of

   !> What the digit means, in words
   pure function digit_text(name, digit) result(text)
      character(len=*), intent(in) :: name
      integer, intent(in) :: digit
      character(len=text_length) :: text
      integer :: row

      row = row_of(name, digit)
      text = "unknown"
      if (row > 0) text = digit_table(row)%text
   end function digit_text

   !> The known values of a digit, "0, 1, 2, 3", for messages
   pure function allowed_text(name) result(text)
      character(len=*), intent(in) :: name
      character(len=list_length) :: text

      text = listed(pack(digit_table%digit, digit_table%name == name))
   end function allowed_text

   !> Digits with commas between
   pure function listed(digits) result(text)
      integer, intent(in) :: digits(:)
      character(len=list_length) :: text

      write(text, '(*(I1, :, ", "))') digits
   end function listed

   !> Value of the digit with the given name
   pure integer function digit_value(digits, name) result(digit)
      type(case_digits), intent(in) :: digits
      character(len=*), intent(in) :: name

      select case (name)
      case ("C1"); digit = digits%c1
      case ("P"); digit = digits%p
      case ("B"); digit = digits%b
      case ("T"); digit = digits%t
      case ("N"); digit = digits%n
      case ("F"); digit = digits%f
      case ("S"); digit = digits%s
      case ("V"); digit = digits%v
      case ("L"); digit = digits%l
      case ("D"); digit = digits%d
      case ("C"); digit = digits%c
      case ("M"); digit = digits%m
      case ("Z"); digit = digits%z
      case ("E"); digit = digits%e
      case ("M2"); digit = digits%m2
      case ("X"); digit = digits%x
      case ("H"); digit = digits%h
      case ("G"); digit = digits%g
      case ("I"); digit = digits%i
      case ("A"); digit = digits%a
      case ("O"); digit = digits%o
      case ("W"); digit = digits%w
      case ("R"); digit = digits%r
      case default; digit = -1
      end select
   end function digit_value

   !> Take the control words of module 3 apart, from the right
   !>
   !> Leading digits that are absent are zero. What stands left of V and X stays in these digits
   !> and makes them out of range; what stands left of P is ignored. The sign is the caller's concern.
   pure subroutine decode_words(word1, word2, word3, digits, second)
      !> P B T N F S; V L D C M Z E; X H G I A O W R
      integer, intent(in) :: word1, word2, word3
      !> GAPWGT keeps its value when there is no second number
      type(case_digits), intent(inout) :: digits
      !> Second number of word 2, 10 GAPWGT + M2; absent means that the damping is kept
      integer, intent(in), optional :: second
      integer :: rest

      rest = abs(word1)
      call take(rest, digits%s)
      call take(rest, digits%f)
      call take(rest, digits%n)
      call take(rest, digits%t)
      call take(rest, digits%b)
      call take(rest, digits%p)

      rest = abs(word2)
      call take(rest, digits%e)
      call take(rest, digits%z)
      call take(rest, digits%m)
      call take(rest, digits%c)
      call take(rest, digits%d)
      call take(rest, digits%l)
      digits%v = rest

      rest = abs(word3)
      call take(rest, digits%r)
      call take(rest, digits%w)
      call take(rest, digits%o)
      call take(rest, digits%a)
      call take(rest, digits%i)
      call take(rest, digits%g)
      call take(rest, digits%h)
      digits%x = rest

      digits%m2 = 1
      if (present(second)) then
         rest = max(0, second)
         call take(rest, digits%m2)
         digits%m2 = min(2, digits%m2)
         digits%gapwgt = rest
      end if
   end subroutine decode_words

   !> Cut the last digit off a number
   pure subroutine take(number, digit)
      integer, intent(inout) :: number
      integer, intent(out) :: digit

      digit = mod(number, 10)
      number = number/10
   end subroutine take

   !> Put the control words of module 3 together
   pure subroutine encode_words(digits, word1, word2, word3, second)
      type(case_digits), intent(in) :: digits
      !> P B T N F S; V L D C M Z E; X H G I A O W R
      integer, intent(out) :: word1, word2, word3
      !> 10 GAPWGT + M2
      integer, intent(out) :: second

      word1 = joined([digits%p, digits%b, digits%t, digits%n, digits%f, digits%s])
      word2 = joined([digits%v, digits%l, digits%d, digits%c, digits%m, digits%z, digits%e])
      word3 = joined([digits%x, digits%h, digits%g, digits%i, digits%a, digits%o, digits%w, digits%r])
      second = 10*digits%gapwgt + digits%m2
   end subroutine encode_words

   !> The number with these decimal digits
   pure integer function joined(list) result(number)
      integer, intent(in) :: list(:)
      integer :: k

      number = 0
      do k = 1, size(list)
         number = 10*number + list(k)
      end do
   end function joined

   !> A control word as it is written in files, with its leading zeros
   pure function word_text(word, width) result(text)
      integer, intent(in) :: word
      !> Number of digits: 6, 7 and 7 or 8 for the words 1, 2 and 3
      integer, intent(in) :: width
      character(len=width) :: text
      integer :: rest, digit, k

      rest = word
      do k = width, 1, -1
         call take(rest, digit)
         text(k:k) = achar(iachar("0") + digit)
      end do
   end function word_text
end module contact_control_digits
