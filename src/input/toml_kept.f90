!> Numbers of the readable format that a case of contact problems keeps although their meaning has changed
module contact_input_toml_kept
   use contact_base_choices, only : force_control, motion
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_input_problems, only : severity
   use contact_input_toml_reader, only : toml_reader
   use contact_text_words, only : real_text
   implicit none (type, external)
   private

   public :: check_kept_creepages

contains

   !> Refuse creepages that are kept as shifts, and shifts as creepages
   subroutine check_kept_creepages(a, previous, spec)
      !> Reader of the case, which gets the problems
      type(toml_reader), intent(inout) :: a
      !> Case before it, with the kind of motion to which kept creepages belong
      type(case_spec), intent(in) :: previous
      !> A case with friction; its kind of motion is noted
      type(case_spec), intent(inout) :: spec

      spec%given%has_motion = .true.
      spec%given%are_shifts = spec%motion == motion%shift
      if (.not. previous%given%has_motion .or. (spec%given%are_shifts .eqv. previous%given%are_shifts)) return
      if (spec%force == force_control%creepages) call check("cksi", spec%kinematics%cksi)
      if (spec%force /= force_control%fx_and_fy) call check("ceta", spec%kinematics%ceta)
      call check("cphi", spec%kinematics%cphi)

   contains

      subroutine check(key, value)
         !> Key of the group kinematics, and its value
         character(len=*), intent(in) :: key
         real(wp), intent(in) :: value
         integer :: table

         table = a%document%child(a%case_node, "kinematics")
         if (table > 0) then
            if (a%document%child(table, key) > 0) return
         end if
         if (.not. abs(value) > 0.0_wp) return
         call a%add_problem(severity%error, merge(table, a%case_node, table > 0), key // " = " // real_text(value) // &
            & " is kept from " // trim(merge("rolling", "a shift", spec%given%are_shifts)) // ", but in shifts creepages are " // &
            & "distances and rotations: this case must give " // key)
      end subroutine check
   end subroutine check_kept_creepages
end module contact_input_toml_kept
