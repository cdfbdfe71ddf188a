!> Creepages, velocities and extra slip of callers: in shifts they are displacements and rotations; on rollers the first velocity is
!> a pitch rate
!>
!> The order of the calls before a calculation does not matter. Values that a calculation has used keep the meaning that they had
!> there: after a change of the motion the caller is warned, and a change between track and roller is refused.
module contact_capi_motion
   use contact_base_choices, only : force_control, motion, slip_source
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : warn
   use contact_capi_problem, only : kind_of_motion, library_problem
   use contact_control_digits, only : choice_of
   use contact_control_translation, only : is_on_roller
   use contact_control_units, only : inward, quantity, unit_convention
   implicit none (type, external)
   private

   public :: creepages_of, follow_digits, settle_motion

contains

   !> Creepages and spin in internal units, by the current motion
   pure function creepages_of(problem, numbers, units) result(creepages)
      type(library_problem), intent(in) :: problem
      !> Longitudinal and lateral creepage, spin
      real(wp), intent(in) :: numbers(3)
      !> Their units; the caller may have other ones meanwhile
      type(unit_convention), intent(in) :: units
      real(wp) :: creepages(3)

      if (problem%motion() == motion%shift) then
         creepages = numbers*inward(units, [quantity%length, quantity%length, quantity%angle])
      else
         creepages = numbers*inward(units, [quantity%number, quantity%number, quantity%spin])
      end if
   end function creepages_of

   !> Give values that no calculation has used the meaning of the current digits T and C1; to be called after a change of these
   subroutine follow_digits(problem)
      type(library_problem), intent(inout) :: problem
      real(wp) :: creepages(3)
      logical :: is_shift

      is_shift = problem%motion() == motion%shift
      associate (given => problem%given, kinematics => problem%stored%kinematics, wheelset => problem%stored%wheelset)
         if (given%slip%is_new) given%slip%for_shift = is_shift
         if (given%flexible%is_new) given%flexible%for_shift = is_shift
         if (given%rail%is_new) given%rail%for_shift = is_shift
         if (.not. given%values%is_new) return
         given%values%for_shift = is_shift
         if (problem%module_number == 3) then
            creepages = creepages_of(problem, given%numbers, given%units)
            kinematics%cksi = creepages(1)
            kinematics%ceta = creepages(2)
            kinematics%cphi = creepages(3)
            return
         end if
         given%for_roller = is_on_roller(problem%digits)
         if (given%for_roller) then
            wheelset%vs = 0.0_wp
            wheelset%rpitch = given%numbers(1)*inward(given%units, quantity%angle)
         else
            wheelset%vs = given%numbers(1)*inward(given%units, quantity%velocity)
         end if
      end associate
   end subroutine follow_digits

   !> Before a calculation: warn of values that are kept from another motion, and refuse velocities that are kept from a track on a
   !> roller, or the other way round
   subroutine settle_motion(this, problem, error)
      type(entry_type), intent(in) :: this
      type(library_problem), intent(inout) :: problem
      type(error_type), allocatable, intent(out) :: error

      if (problem%motion() == motion%none) return
      associate (given => problem%given)
         if (problem%module_number == 3) then
            call settle(given%values, any(abs(acting_creepages(problem)) > 0.0_wp), "creepages", "cntc_setcreepages")
            call settle(given%slip, has_slip(problem), "values of the extra rigid slip", "cntc_setextrarigidslip")
         else if (is_on_roller(problem%digits) .neqv. given%for_roller) then
            call fatal_error(error, "the velocities of the wheelset belong to a " // trim(merge("roller", "track ", &
               & given%for_roller)) // ", where the first one is the " // trim(merge("pitch rate of the roller", &
               & "forward velocity        ", given%for_roller)) // ": give new ones by cntc_setwheelsetvelocity")
         else
            associate (rail => problem%spec%wheel_rail%rail, w => problem%stored%wheelset)
               call settle(given%values, any(abs([w%vs, w%vy, w%vz, w%vroll, w%vyaw, w%vpitch, w%rpitch]) > 0.0_wp), &
                  & "velocities of the wheelset", "cntc_setwheelsetvelocity")
               call settle(given%flexible, any(abs(w%flexible_rate) > 0.0_wp), "velocities of the flexible deviations", &
                  & "cntc_setwheelsetflexibility")
               call settle(given%rail, any(abs([rail%vy, rail%vz, rail%vroll]) > 0.0_wp), "velocities of the rail", &
                  & "cntc_settrackdimensions")
            end associate
         end if
      end associate

   contains

      !> Warn of values that are kept from another motion and act in the case; from now on they belong to its motion
      subroutine settle(values, act, names, routine)
         type(kind_of_motion), intent(inout) :: values
         !> Does at least one of the values act?
         logical, intent(in) :: act
         !> Names of the values, and the routine that sets them
         character(len=*), intent(in) :: names, routine

         if (act .and. (values%for_shift .neqv. problem%motion() == motion%shift)) call warn(this, "the " // names // &
            & " are kept after a change between a shift, T = 1, and rolling, where they have other units: give new ones by " // &
            & routine)
         values = kind_of_motion(for_shift=problem%motion() == motion%shift, is_new=.false.)
      end subroutine settle
   end subroutine settle_motion

   !> Does an extra rigid slip act?
   pure logical function has_slip(problem)
      type(library_problem), intent(in) :: problem

      has_slip = problem%digits%e /= 0 .and. problem%spec%slip_source == slip_source%given .and. allocated(problem%spec%extra_slip)
      if (has_slip) has_slip = any(abs(problem%spec%extra_slip) > 0.0_wp)
   end function has_slip

   !> The creepages that act in addition to prescribed forces; others are 0
   pure function acting_creepages(problem) result(creepages)
      type(library_problem), intent(in) :: problem
      real(wp) :: creepages(3)
      integer :: force

      force = choice_of("F", problem%digits%f, problem%module_number)
      associate (kinematics => problem%stored%kinematics)
         creepages = [kinematics%cksi, kinematics%ceta, kinematics%cphi]
      end associate
      if (force /= force_control%creepages) creepages(1) = 0.0_wp
      if (force == force_control%fx_and_fy) creepages(2) = 0.0_wp
   end function acting_creepages
end module contact_capi_motion
