!> Conversion of control digits to the named choices and parts of a case, and back
module contact_control_translation
   use contact_base_choices, only : slip_source
   use contact_cases_spec, only : case_spec, part_source
   use contact_control_digits, only : case_digits, choice_of, digit_of
   implicit none (type, external)
   private

   public :: apply_digits, digits_of, is_on_roller

contains

   !> Set choices and parts of a case from its digits; groups of unknown digits are treated as not given
   subroutine apply_digits(digits, module_number, spec)
      type(case_digits), intent(in) :: digits
      integer, intent(in) :: module_number
      !> On entry the previous case, whose choices remain if a digit keeps them
      type(case_spec), intent(inout) :: spec

      spec%link = choice("P", digits%p)
      spec%pressure = choice("B", digits%b)
      spec%motion = choice("T", digits%t)
      spec%normal = choice("N", digits%n)
      spec%force = choice("F", digits%f)
      spec%has_stress = digits%s >= 1
      spec%variation = choice("V", digits%v)
      spec%material_model = choice("M", digits%m)
      spec%estimate = choice("I", digits%i)
      spec%mat_file = digits%a
      spec%output_level = digits%o
      spec%flow_level = digits%w
      spec%solve = digits%r <= 1
      spec%ends_module = modulo(digits%r, 2) == 1
      if (digits%l /= 1) spec%friction_law = choice("L", digits%l)
      if (digits%c >= 2) spec%kernel = choice("C", digits%c)
      if (digits%g /= 1) spec%solver = choice("G", digits%g)
      spec%has_heat = digits%h /= 0
      if (digits%m2 /= 1) spec%has_damping = digits%m2 >= 2

      associate (parts => spec%parts)
         parts%iteration = given_unless(digits%g == 1)
         parts%friction = given_unless(digits%l == 1)
         parts%material = source_of(digits%c)
         parts%rolling = given_unless(digits%c < 2)
         parts%damping = given_unless(digits%m2 == 1)
         parts%heat = given_unless(digits%h == 1 .or. digits%h == 2)
         parts%stress_output = given_unless(digits%s == 1)
         parts%stress_points = given_unless(digits%s /= 0 .and. digits%s /= 3)
      end associate
      if (module_number == 1) then
         call apply_wheel_rail_digits(digits, spec)
      else
         if (digits%e /= 1) spec%slip_source = choice("E", digits%e)
         spec%parts%grid = source_of(merge(digits%d, 0, digits%d <= 2))
         spec%parts%geometry = source_of(merge(digits%z, 0, digits%z <= 2))
         spec%parts%extra_slip = given_unless(digits%e == 1)
      end if

   contains

      !> Named choice of a digit
      pure integer function choice(name, digit)
         character(len=*), intent(in) :: name
         integer, intent(in) :: digit

         choice = choice_of(name, digit, module_number)
      end function choice
   end subroutine apply_digits

   !> Is the wheel on a roller, by the digit C1? Otherwise on a track
   pure logical function is_on_roller(digits)
      type(case_digits), intent(in) :: digits

      is_on_roller = digits%c1 == 4 .or. digits%c1 == 5
   end function is_on_roller

   !> Digits that have a meaning for wheel and rail only
   subroutine apply_wheel_rail_digits(digits, spec)
      type(case_digits), intent(in) :: digits
      type(case_spec), intent(inout) :: spec

      if (.not. allocated(spec%wheel_rail)) allocate(spec%wheel_rail)
      spec%wheel_rail%left = digits%c1 == 0 .or. digits%c1 == 4
      spec%wheel_rail%roller = is_on_roller(digits)
      spec%wheel_rail%search%gap_weight = digits%gapwgt
      if (digits%d >= 2) spec%wheel_rail%search%location = choice_of("D", digits%d, 1)
      spec%wheel_rail%new_rail_profile = .false.
      spec%wheel_rail%new_wheel_profile = .false.
      spec%wheel_rail%new_track = .false.
      spec%slip_source = slip_source%none
      associate (parts => spec%parts)
         parts%search = source_of(digits%d)
         parts%track = given_unless(digits%z /= 1 .and. digits%z /= 3)
         parts%rail_profile = given_unless(digits%z /= 3)
         parts%deviations = given_unless(digits%z < 2)
         parts%wheel_profile = given_unless(digits%e /= 3 .and. digits%e /= 5)
         parts%position = given_unless(digits%e < 1)
         parts%velocity = given_unless(digits%e < 2)
         parts%flexibility = given_unless(digits%e < 4)
      end associate
   end subroutine apply_wheel_rail_digits

   !> Control digits of a case
   pure function digits_of(spec) result(digits)
      type(case_spec), intent(in) :: spec
      type(case_digits) :: digits

      digits%p = digit("P", spec%link)
      digits%b = digit("B", spec%pressure)
      digits%t = digit("T", spec%motion)
      digits%n = digit("N", spec%normal)
      digits%f = digit("F", spec%force)
      digits%v = digit("V", spec%variation)
      digits%m = digit("M", spec%material_model)
      digits%i = digit("I", spec%estimate)
      digits%a = spec%mat_file
      digits%o = spec%output_level
      digits%w = spec%flow_level
      digits%r = merge(0, 2, spec%solve) + merge(1, 0, spec%ends_module)
      associate (parts => spec%parts)
         if (spec%has_stress) then
            digits%s = 1
            if (parts%stress_output == part_source%given) digits%s = 2
            if (parts%stress_points == part_source%given) digits%s = 3
         end if
         digits%l = kept_or(parts%friction, digit("L", spec%friction_law))
         digits%c = parts%material
         if (parts%material == part_source%given) digits%c = digit("C", spec%kernel)
         digits%g = kept_or(parts%iteration, digit("G", spec%solver))
         digits%m2 = kept_or(parts%damping, merge(2, 0, spec%has_damping))
         if (spec%has_heat) digits%h = kept_or(parts%heat, 3)
         if (.not. allocated(spec%wheel_rail)) then
            digits%d = parts%grid
            digits%z = parts%geometry
            digits%e = kept_or(parts%extra_slip, digit("E", spec%slip_source))
            return
         end if
         digits%c1 = merge(0, 1, spec%wheel_rail%left) + merge(4, 0, spec%wheel_rail%roller)
         digits%gapwgt = spec%wheel_rail%search%gap_weight
         digits%d = parts%search
         if (parts%search == part_source%given) digits%d = digit("D", spec%wheel_rail%search%location)
         if (parts%rail_profile == part_source%given) then
            digits%z = 3
         else if (parts%deviations == part_source%given) then
            digits%z = 2
         else if (parts%track == part_source%given) then
            digits%z = 1
         end if
         if (parts%position == part_source%given) digits%e = 1
         if (parts%velocity == part_source%given) digits%e = 2
         if (parts%flexibility == part_source%given) digits%e = 4
         if (parts%wheel_profile == part_source%given) digits%e = merge(5, 3, parts%flexibility == part_source%given)
      end associate

   contains

      !> Digit of a choice
      pure integer function digit(name, choice)
         character(len=*), intent(in) :: name
         integer, intent(in) :: choice

         digit = digit_of(name, choice, merge(1, 3, allocated(spec%wheel_rail)))
      end function digit

      !> Digit of a part: 1 if it is kept, otherwise the given digit
      pure integer function kept_or(source, digit)
         !> Member of part_source
         integer, intent(in) :: source
         integer, intent(in) :: digit

         kept_or = merge(digit, 1, source == part_source%given)
      end function kept_or
   end function digits_of

   !> Source of a part whose digit keeps it or gives it
   pure integer function given_unless(is_kept)
      logical, intent(in) :: is_kept

      given_unless = merge(part_source%kept, part_source%given, is_kept)
   end function given_unless

   !> Source of a part whose digit is 0 to keep it, 1 to renew it, and larger to give it
   pure integer function source_of(digit)
      integer, intent(in) :: digit

      source_of = max(part_source%kept, min(part_source%given, digit))
   end function source_of
end module contact_control_translation
