!> The control digits of module 1 where they differ from those of module 3
!>
!> Digits that mean the same in both modules are looked up in contact_control_digits.
module contact_control_digits1
   use contact_base_choices, only : contact_location, force_control, kernel_model, pressure_model, variation
   use contact_cases_spec, only : case_digits
   use contact_control_digits, only : common_names => digit_names, common_allowed => allowed_text, &
      & common_built => is_built, common_choice => choice_of, common_known => is_known, common_text => digit_text, &
      & decode_words, digit_row, list_length, listed, text_length
   implicit none (type, external)
   private

   public :: digit1_names, digit1_table, digit1_value_is_known, digit1_is_built, choice1_of, digit1_text, allowed1_text
   public :: decode_words1

   type(digit_row), parameter :: digit1_table(*) = [ &
      & digit_row("C1", 0, 0, .true., "left wheel on the track"), &
      & digit_row("C1", 1, 1, .true., "right wheel on the track"), &
      & digit_row("C1", 4, 4, .true., "left wheel on a roller"), &
      & digit_row("C1", 5, 5, .true., "right wheel on a roller"), &
      & digit_row("B", 0, pressure_model%full, .true., "full solution of the normal problem"), &
      & digit_row("B", 1, pressure_model%thin_sheet, .true., "elastic thin sheet with a vertical flexibility"), &
      & digit_row("B", 5, pressure_model%kpec, .true., "Kik-Piotrowski approach with ellipse correction (KPEC)"), &
      & digit_row("B", 6, pressure_model%analyn, .true., "modified ANALYN approach"), &
      & digit_row("F", 0, force_control%creepages, .true., "velocities prescribed"), &
      & digit_row("F", 1, force_control%longitudinal_force, .true., "longitudinal force in place of the pitch velocity"), &
      & digit_row("F", 3, force_control%massless_rail, .true., "rail without mass on springs"), &
      & digit_row("V", 0, variation%none, .true., "one set of friction parameters"), &
      & digit_row("V", 1, variation%by_angle, .true., "friction parameters by the inclination of the rail surface"), &
      & digit_row("V", 2, variation%by_position, .true., "friction parameters by the position along the track"), &
      & digit_row("D", 0, 0, .true., "keep the settings of search and discretisation"), &
      & digit_row("D", 1, 1, .true., "keep the settings of search and discretisation"), &
      & digit_row("D", 2, contact_location%locus, .true., "flat contact, contact locus"), &
      & digit_row("D", 3, contact_location%locus_extended, .true., "flat contact, contact locus, extended rigid slip"), &
      & digit_row("D", 4, contact_location%conformal, .true., "conformal contact, contact locus"), &
      & digit_row("D", 5, contact_location%grid, .true., "flat contact, search over a grid"), &
      & digit_row("D", 6, contact_location%steep_grid, .true., "flat contact, search over a finer grid"), &
      & digit_row("D", 7, contact_location%first_contact, .true., "flat contact, first point of contact as reference"), &
      & digit_row("D", 8, contact_location%oblique_locus, .false., "contact locus in an oblique view that fits few profiles"), &
      & digit_row("D", 9, contact_location%oblique_grid, .false., "grid search in an oblique view that fits few profiles"), &
      & digit_row("C", 0, 0, .true., "as 1"), &
      & digit_row("C", 1, 1, .true., "form the influence coefficients from the values in store"), &
      & digit_row("C", 2, kernel_model%piecewise_constant, .true., "half-space, piecewise constant; read materials"), &
      & digit_row("C", 3, kernel_model%bilinear, .true., "half-space with bilinear tractions"), &
      & digit_row("C", 4, kernel_model%conformal, .true., "half-space with angle correction for conformal contact"), &
      & digit_row("C", 9, kernel_model%tabulated, .true., "numerical influence coefficients from a file"), &
      & digit_row("Z", 0, 0, .true., "keep track and rail"), &
      & digit_row("Z", 1, 1, .true., "read the track dimensions"), &
      & digit_row("Z", 2, 2, .true., "read the deviations of the rail"), &
      & digit_row("Z", 3, 3, .true., "read track dimensions, rail profile and deviations"), &
      & digit_row("E", 0, 0, .true., "keep wheelset, position and velocity"), &
      & digit_row("E", 1, 1, .true., "read the position of the wheelset"), &
      & digit_row("E", 2, 2, .true., "read position and velocity"), &
      & digit_row("E", 3, 3, .true., "read wheelset dimensions, wheel profile, position and velocity"), &
      & digit_row("E", 4, 4, .true., "as 2, with the flexible deviations of the wheelset"), &
      & digit_row("E", 5, 5, .true., "as 3, with the flexible deviations of the wheelset")]

   !> All digits in the order of the control words
   character(len=2), parameter :: digit1_names(*) = ["C1", common_names]

contains

   !> Row of the table of this module, 0 when there is none
   pure integer function row_of(name, digit) result(row)
      character(len=*), intent(in) :: name
      integer, intent(in) :: digit
      character(len=2) :: key

      key = name
      do row = 1, size(digit1_table)
         if (digit1_table(row)%digit == digit .and. digit1_table(row)%name == key) return
      end do
      row = 0
   end function row_of

   !> Does the digit mean something else than in module 3?
   pure logical function is_own(name)
      character(len=*), intent(in) :: name
      character(len=2) :: key

      key = name
      is_own = any(digit1_table%name == key)
   end function is_own

   !> Does the format know this value of the digit?
   pure logical function digit1_value_is_known(name, digit) result(known)
      character(len=*), intent(in) :: name
      integer, intent(in) :: digit

      if (is_own(name)) then
         known = row_of(name, digit) > 0
      else
         known = common_known(name, digit)
      end if
   end function digit1_value_is_known

   !> Can this version compute what the digit asks for?
   pure logical function digit1_is_built(name, digit) result(built)
      character(len=*), intent(in) :: name
      integer, intent(in) :: digit
      integer :: row

      if (is_own(name)) then
         row = row_of(name, digit)
         built = .false.
         if (row > 0) built = digit1_table(row)%built
      else
         built = common_built(name, digit)
      end if
   end function digit1_is_built

   !> Named choice behind a digit; an unknown digit is handed back as it is
   pure integer function choice1_of(name, digit) result(choice)
      character(len=*), intent(in) :: name
      integer, intent(in) :: digit
      integer :: row

      if (.not. is_own(name)) then
         choice = common_choice(name, digit)
         return
      end if
      row = row_of(name, digit)
      choice = digit
      if (row > 0) choice = digit1_table(row)%choice
   end function choice1_of

   !> What the digit means, in words
   pure function digit1_text(name, digit) result(text)
      character(len=*), intent(in) :: name
      integer, intent(in) :: digit
      character(len=text_length) :: text
      integer :: row

      if (.not. is_own(name)) then
         text = common_text(name, digit)
         return
      end if
      row = row_of(name, digit)
      text = "unknown"
      if (row > 0) text = digit1_table(row)%text
   end function digit1_text

   !> The known values of a digit, "0, 1, 4, 5", for messages
   pure function allowed1_text(name) result(text)
      character(len=*), intent(in) :: name
      character(len=list_length) :: text

      if (is_own(name)) then
         text = listed(pack(digit1_table%digit, digit1_table%name == name))
      else
         text = common_allowed(name)
      end if
   end function allowed1_text

   !> Take the control words of module 1 apart, from the right; see decode_words
   pure subroutine decode_words1(word1, word2, word3, digits, second)
      !> C1 P B T N F S; V L D C M Z E; X H G I A O W R
      integer, intent(in) :: word1, word2, word3
      type(case_digits), intent(inout) :: digits
      !> Second number of word 2, 10 GAPWGT + M2; absent means that the damping is kept
      integer, intent(in), optional :: second

      call decode_words(word1, word2, word3, digits, second)
      digits%c1 = abs(word1)/1000000
   end subroutine decode_words1
end module contact_control_digits1
