!> Control digits and other flags, and metadata of a case
module contact_capi_flags
   use, intrinsic :: iso_c_binding, only : c_int
   use omp_lib, only : omp_in_parallel
   use contact_base_kinds, only : wp
   use contact_capi_caller, only : caller
   use contact_capi_library, only : entry_type
   use contact_capi_lifecycle, only : set_global_flag
   use contact_capi_messages, only : begin_setting, report_error, end_setting, fits, is_heard, log_message, warn
   use contact_capi_motion, only : follow_digits
   use contact_capi_problem, only : library_problem
   use contact_capi_timers, only : set_timer_level
   use contact_cases_accuracy_plan, only : largest_accuracy
   use contact_control_digits, only : choice_of, digit_value, put_digit
   use contact_control_flags, only : accepted_value, flag, flag_table, highest_of, row_of_flag
   use contact_control_units, only : convention_code, find_convention, inward, quantity
   use contact_patch_border, only : border_code
   use contact_patch_resolution, only : min_across
   use contact_patch_result, only : patch_result
   use contact_text_words, only : columns_of, integer_text
   implicit none (type, external)
   private

   public :: get_flags, set_flags, set_metadata

   type :: metadata_code_list
      integer :: time = 2011, x_rail = 2012, y_rail = 2013, x_wheel = 2014, y_wheel = 2015, s_wheel = 2016
      integer :: run = 2021, axle = 2022, side = 2023
   end type metadata_code_list
   !> Codes of cntc_setmetadata
   type(metadata_code_list), parameter :: metadata_code = metadata_code_list()

contains

   !> Set control digits, units and settings of one problem, in the order of the list
   subroutine set_flags(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), intent(inout) :: problem
      integer :: k

      ! each flag is a separate setting
      call end_setting(problem)
      associate (this => a%call_of, codes => a%integers(1)%v, numbers => a%integers(2)%v)
         do k = 1, min(size(codes), size(numbers))
            if (codes(k) == 0) cycle
            if (acts_on_problem(codes(k))) call begin_setting(problem, this, group_of(codes(k)))
            call set_flag(this, codes(k), numbers(k), problem)
            call end_setting(problem)
         end do
      end associate
   end subroutine set_flags

   !> Does a flag change the computation of a problem? False for unknown codes and for flags of the library as a whole
   pure logical function acts_on_problem(code)
      integer, intent(in) :: code
      acts_on_problem = row_of_flag(code) > 0 .and. .not. any(code == [flag%idebug, flag%licdbg, flag%openmp, flag%timers])
   end function acts_on_problem

   !> Group of settings of a flag: the flag itself, or that of the routine for the same setting
   pure function group_of(code) result(group)
      integer, intent(in) :: code
      character(len=32) :: group

      select case (code)
      case (flag%mater); group = "cntc_setMaterialParameters"
      case (flag%frclaw); group = "cntc_setFrictionMethod"
      case (flag%heat); group = "cntc_setTemperatureData"
      case default; group = "flag " // integer_text(code)
      end select
   end function group_of

   !> Set one flag
   subroutine set_flag(this, code, number, problem)
      type(entry_type), intent(in) :: this
      !> Member of `flag`, and its value
      integer, intent(in) :: code, number
      type(library_problem), intent(inout) :: problem
      integer :: row, stored
      logical :: accepted

      row = row_of_flag(code)
      if (row == 0) then
         call refuse(": there is no such flag, it is ignored")
         return
      end if
      if (.not. flag_table(row)%can_set) then
         if (number == digit_value(problem%digits, trim(flag_table(row)%digit))) return
         if (code == flag%mater) call refuse(": the material is set by cntc_setMaterialParameters")
         if (code == flag%frclaw) call refuse(": the friction law is set by cntc_setFrictionMethod")
         if (code == flag%heat) call refuse(": temperatures are set by cntc_setTemperatureData")
         if (any(code == [flag%own_border, flag%own_stepped, flag%own_across])) call refuse(": this is a result, it cannot be set")
         return
      end if
      call accepted_value(flag_table(row), number, problem%module_number, stored, accepted)
      if (.not. accepted) then
         call refuse(" is outside its range " // integer_text(flag_table(row)%lowest) // " to " // &
            & integer_text(highest_of(flag_table(row), problem%module_number)) // "; nothing is stored")
         return
      end if
      if (stored /= number) call warn(this, flag_text(code, number) // " is none of its values and is replaced by " // &
         & integer_text(stored))
      if (is_heard(2)) call log_message(2, this, flag_text(code, stored))
      call store_flag(this, code, stored, problem)
      if (code == flag%tang .or. code == flag%config) call follow_digits(problem)

   contains

      subroutine refuse(reason)
         character(len=*), intent(in) :: reason
         call report_error(this, flag_text(code, number) // reason)
      end subroutine refuse
   end subroutine set_flag

   !> "flag 123 = 4"
   pure function flag_text(code, number) result(text)
      integer, intent(in) :: code, number
      character(len=8 + columns_of(code) + columns_of(number)) :: text

      text = "flag " // integer_text(code) // " = " // integer_text(number)
   end function flag_text

   !> Store an accepted value
   subroutine store_flag(this, code, number, problem)
      type(entry_type), intent(in) :: this
      integer, intent(in) :: code, number
      type(library_problem), intent(inout) :: problem
      logical :: known, is_wheel_rail
      integer, pointer :: place

      is_wheel_rail = problem%module_number == 1
      place => place_of(problem, code)
      if (associated(place)) place = number
      if (code == flag%npomax .and. .not. is_wheel_rail) call log_message(0, this, &
         & "the number of elements is limited for wheel and rail only, the flag is ignored")
      if (associated(place)) return
      associate (spec => problem%spec)
         select case (code)
         case (flag%units)
            call find_convention(number, problem%units, known)
            if (number == convention_code%imperial) &
               & call report_error(this, "imperial units are not available; give another convention")
         case (flag%config)
            if (is_wheel_rail) problem%digits%c1 = number
         case (flag%discns)
            if (.not. is_wheel_rail) then
               call log_message(1, this, "the way to locate the contact belongs to wheel and rail, the flag is ignored")
            else
               problem%digits%d = number
               if (number >= 2) spec%wheel_rail%search%location = choice_of("D", number, 1)
            end if
         case (flag%inflcf)
            problem%digits%c = number
            if (number >= 2) spec%kernel = choice_of("C", number, problem%module_number)
         case (flag%exrhs)
            if (.not. is_wheel_rail) then
               problem%digits%e = number
            else if (number /= 0) then
               call report_error(this, "an extra term in the rigid slip is not available for wheel and rail; nothing is stored")
            end if
         case (flag%force)
            if (is_wheel_rail .and. number == 2) then
               call report_error(this, "a prescribed pitching moment, F = 2, is not available; nothing is stored. 0, 1 and 3 are")
            else
               problem%digits%f = number
            end if
         case (flag%own_angle)
            if (is_wheel_rail) spec%wheel_rail%search%angle_below_axle = number == 0
         case (flag%own_classical)
            spec%classical = number /= 0
         case (flag%own_errors)
            spec%estimates_errors = number /= 0
         case (flag%own_wear)
            spec%has_wear = number /= 0
         case (flag%own_accuracy)
            if (number > 0 .and. number*largest_accuracy < 1.0_wp) then
               call report_error(this, "an accuracy of one part in " // integer_text(number) // " is too rough; " &
                  & // "nothing is stored. 10 to 1000000 are accepted, and 0 for none")
            else
               spec%iteration%accuracy = 0.0_wp
               if (number > 0) spec%iteration%accuracy = 1.0_wp/number
            end if
         case (flag%own_approximate)
            spec%iteration%allows_approximate = number /= 0
         case (flag%timers)
            call set_timer_level(number)
         case (flag%ncase)
            problem%cases = max(0, number - 1)
         case (flag%idebug, flag%licdbg, flag%openmp)
            if (omp_in_parallel()) then
               call report_error(this, "flags of the library as a whole cannot be set inside a parallel region")
            else
               call set_global_flag(code, number)
            end if
         case (flag%xflow)
            ! the word selects debug output, of which there is none; the digit records that it was given
            problem%digits%x = merge(1, 0, number > 0)
         case default
            call put_digit(problem%digits, flag_table(row_of_flag(code))%digit, number)
         end select
      end associate
   end subroutine store_flag

   !> Variable that stores the value of a flag unchanged; null for digits and for flags that act in another way
   function place_of(problem, code) result(place)
      type(library_problem), intent(inout), target :: problem
      !> Member of `flag`
      integer, intent(in) :: code
      integer, pointer :: place

      select case (code)
      case (flag%sens); place => problem%spec%iteration%sensitivity
      case (flag%ifmeth); place => problem%spec%material%if_meth
      case (flag%ifvari); place => problem%spec%material%variant
      case (flag%sbsout); place => problem%spec%subsurface%output
      case (flag%sbsfil); place => problem%spec%subsurface%matfil
      case (flag%npomax); place => problem%spec%iteration%npot_max
      case (flag%wrtinp); place => problem%write_input
      case (flag%own_heat); place => problem%spec%heat%source
      case (flag%own_order); place => problem%spec%iteration%order
      case default; nullify(place)
      end select
   end function place_of

   !> Get control digits as they were given; other elements of the array are unchanged
   subroutine get_flags(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), intent(inout) :: problem
      integer(c_int), pointer :: numbers(:)
      integer :: k, row

      numbers => a%integers_at(1)
      associate (codes => a%integers(1)%v)
         do k = 1, min(size(codes), size(numbers))
            if (codes(k) == 0) cycle
            row = row_of_flag(codes(k))
            if (row > 0) then
               if (flag_table(row)%can_get) then
                  numbers(k) = flag_value(problem, a%call_of%icp, codes(k))
                  cycle
               end if
            end if
            call report_error(a%call_of, "the flag " // integer_text(codes(k)) // " cannot be read")
         end do
      end associate
   end subroutine get_flags

   !> Value of a flag; some have a value of their own for a patch of module 1
   integer function flag_value(problem, icp, code) result(number)
      type(library_problem), intent(inout) :: problem
      integer, intent(in) :: icp, code
      logical :: is_wheel_rail, is_part
      integer, pointer :: place
      integer :: other(2)

      is_wheel_rail = problem%module_number == 1
      is_part = is_wheel_rail .and. icp > 0
      place => place_of(problem, code)
      if (associated(place)) then
         number = place
         if (code == flag%npomax .and. .not. is_wheel_rail) number = 0
         return
      end if
      associate (spec => problem%spec)
         select case (code)
         case (flag%units); number = problem%units%code
         case (flag%ncase); number = problem%cases
         case (flag%own_angle)
            number = 0
            if (is_wheel_rail) number = merge(0, 1, spec%wheel_rail%search%angle_below_axle)
         case (flag%own_classical); number = merge(1, 0, spec%classical)
         case (flag%own_errors); number = merge(1, 0, spec%estimates_errors)
         case (flag%own_wear); number = merge(1, 0, spec%has_wear)
         case (flag%own_accuracy)
            number = 0
            if (spec%iteration%accuracy > 0.0_wp) number = nint(1.0_wp/spec%iteration%accuracy)
         case (flag%own_approximate); number = merge(1, 0, spec%iteration%allows_approximate)
         case (flag%own_reached); number = merge(1, 0, has_reached(problem))
         case (flag%own_border); call look_at_patches(problem, icp, number, other(1), other(2))
         case (flag%own_stepped); call look_at_patches(problem, icp, other(1), number, other(2))
         case (flag%own_across); call look_at_patches(problem, icp, other(1), other(2), number)
         case default; number = digit_value(problem%digits, trim(flag_table(row_of_flag(code))%digit))
         end select
         if (.not. is_part) return
         ! a patch is solved for given approach and creepages, prints nothing itself, and starts from the solution at the previous
         ! height of the wheel
         select case (code)
         case (flag%norm, flag%force, flag%output); number = 0
         case (flag%iestim); if (problem%wheel_rail_result%force_evaluations > 1) number = 1
         case (flag%tang); if (problem%digits%r >= 2) number = 0
         end select
      end associate
   end function flag_value

   !> Did the last calculation reach the requested accuracy?
   pure logical function has_reached(problem)
      type(library_problem), intent(in) :: problem

      has_reached = .false.
      if (.not. problem%has_result) return
      if (problem%module_number == 1) then
         if (allocated(problem%wheel_rail_result%accuracy)) has_reached = problem%wheel_rail_result%accuracy%is_met
      else
         if (allocated(problem%result%accuracy)) has_reached = problem%result%accuracy%is_met
      end if
   end function has_reached

   !> Properties of one patch or of all of them: where contact is truncated, as a sum of bits, see border_code; number of points of
   !> the last subs_calculate near the surface that are not at centres of elements; minimum number of elements across the contact,
   !> 0 without contact
   subroutine look_at_patches(problem, icp, border, stepped, across)
      type(library_problem), intent(in) :: problem
      !> Patch of module 1; less than 1: all
      integer, intent(in) :: icp
      integer, intent(out) :: border, stepped, across
      !> Bit for the inner end of the wheel profile being inside the rail; the next bits are for the outer end, and for another
      !> position along the track
      integer, parameter :: first_buried = 9
      integer :: k

      border = 0
      stepped = 0
      across = 0
      if (.not. problem%has_result) return
      if (problem%module_number /= 1) then
         call add(problem%result, .false.)
         return
      end if
      do k = 1, size(problem%wheel_rail_result%patches)
         if (icp <= 0 .or. icp == k) call add(problem%wheel_rail_result%patches(k)%contact, problem%bodies%left)
      end do
      if (icp > 0) return
      ! ends of the profile belong to no patch
      do k = 1, size(problem%wheel_rail_result%buried)
         if (problem%wheel_rail_result%buried(k)%depth > 0.0_wp) border = ibset(border, first_buried + k - 1)
      end do
      if (problem%wheel_rail_result%beside%depth > 0.0_wp) border = ibset(border, first_buried + 2)

   contains

      !> Include a patch, with the side of the track
      subroutine add(contact, left)
         type(patch_result), intent(in) :: contact
         logical, intent(in) :: left
         integer :: narrowest

         narrowest = min_across(contact%division)
         if (across == 0 .or. (narrowest > 0 .and. narrowest < across)) across = narrowest
         border = ior(border, border_code(contact%border, left))
         if (allocated(contact%subsurface)) stepped = stepped + sum(contact%subsurface%stepped)
      end subroutine add
   end subroutine look_at_patches

   !> Set the metadata of a case, for printing and .mat files
   subroutine set_metadata(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), intent(inout) :: problem
      integer :: k

      associate (codes => a%integers(1)%v, numbers => a%numbers(1)%v)
         if (.not. fits(a%call_of, "SVF", numbers, "metadata")) return
         do k = 1, min(size(codes), size(numbers))
            if (codes(k) /= 0) call set_value(a%call_of, codes(k), numbers(k), problem)
         end do
      end associate
   end subroutine set_metadata

   !> Set one value
   subroutine set_value(this, code, value, problem)
      type(entry_type), intent(in) :: this
      !> Member of metadata_code
      integer, intent(in) :: code
      real(wp), intent(in) :: value
      type(library_problem), intent(inout) :: problem
      real(wp) :: length

      length = value*inward(problem%units, quantity%length)
      associate (metadata => problem%metadata)
         select case (code)
         case (metadata_code%time); metadata%time = value
         case (metadata_code%x_rail); metadata%x_rail = length
         case (metadata_code%y_rail); metadata%y_rail = length
         case (metadata_code%x_wheel); metadata%x_wheel = length
         case (metadata_code%y_wheel); metadata%y_wheel = length
         case (metadata_code%s_wheel); metadata%s_wheel = length
         case (metadata_code%run); metadata%run = whole(value)
         case (metadata_code%axle); metadata%axle = whole(value)
         case (metadata_code%side); metadata%side = whole(value)
         case default; call report_error(this, "there is no metadata code " // integer_text(code) // ", it is ignored")
         end select
      end associate
   end subroutine set_value

   !> Nearest integer
   pure integer function whole(value)
      real(wp), intent(in) :: value
      whole = nint(max(-1.0e9_wp, min(1.0e9_wp, value)))
   end function whole
end module contact_capi_flags
