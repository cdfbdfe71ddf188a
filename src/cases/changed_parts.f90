!> Groups of the input whose values differ between two cases
module contact_cases_changed_parts
   use contact_base_choices, only : force_control, normal_control
   use contact_base_kinds, only : wp
   use contact_cases_collector, only : collector
   use contact_cases_spec, only : case_parts, case_spec, kinematics_spec, part_source
   use contact_cases_whole_case, only : visit_case
   implicit none (type, external)
   private

   public :: give_changed_parts, give_first_parts

contains

   !> Let a case give each group that it keeps although the values are others than those of the case before
   !>
   !> A caller of the library may say that a group is kept, and change it by another routine. Groups that a digit gives together
   !> are given together. Grid and geometry of module 3, and points below the surface, are left to the writer.
   subroutine give_changed_parts(before, spec)
      !> The case that was written last; profiles have the names that are written
      type(case_spec), intent(in) :: before
      !> Its parts are updated
      type(case_spec), intent(inout) :: spec
      integer, parameter :: given = part_source%given
      type(case_parts) :: one

      associate (parts => spec%parts)
         one = nothing()
         one%iteration = given
         if (differ(before, spec, one, before%solver /= spec%solver)) parts%iteration = given
         one = nothing()
         one%friction = given
         if (differ(before, spec, one, before%friction_law /= spec%friction_law .or. before%variation /= spec%variation)) &
            & parts%friction = given
         one = nothing()
         one%rolling = given
         one%material = given
         if (differ(before, spec, one, before%kernel /= spec%kernel)) then
            parts%rolling = given
            parts%material = given
         end if
         one = nothing()
         one%damping = given
         if (differ(before, spec, one, before%has_damping .neqv. spec%has_damping)) parts%damping = given
         if (.not. (allocated(spec%wheel_rail) .and. allocated(before%wheel_rail))) return
         associate (old => before%wheel_rail, new => spec%wheel_rail)
            one = nothing()
            one%search = given
            if (differ(before, spec, one, old%search%location /= new%search%location)) parts%search = given
            one = nothing()
            one%track = given
            if (differ(before, spec, one)) parts%track = given
            one = nothing()
            one%rail_profile = given
            if (differ(before, spec, one, names_differ(old%rail_profile%name, new%rail_profile%name))) parts%rail_profile = given
            one = nothing()
            one%deviations = given
            if (differ(before, spec, one)) parts%deviations = given
            one = nothing()
            one%wheel_profile = given
            if (differ(before, spec, one, names_differ(old%wheel_profile%name, new%wheel_profile%name))) parts%wheel_profile = given
         end associate
         one = nothing()
         one%position = given
         if (differ(before, spec, one)) parts%position = given
         one = nothing()
         one%velocity = given
         if (differ(before, spec, one, before%motion /= spec%motion)) parts%velocity = given
         one = nothing()
         one%flexibility = given
         if (differ(before, spec, one)) parts%flexibility = given
         ! one digit gives the track, the deviations, or both and the profile; another one the position, with the velocity, and more
         if (parts%track == given .and. parts%deviations == given) parts%rail_profile = given
         if (parts%rail_profile == given) then
            parts%track = given
            parts%deviations = given
         end if
         if (parts%wheel_profile == given .or. parts%flexibility == given) parts%velocity = given
         if (parts%velocity == given) parts%position = given
      end associate
   end subroutine give_changed_parts

   !> Let the first case of a file give all groups that a first case must not keep, and others whose values are not the initial
   !> ones
   subroutine give_first_parts(spec)
      !> Its parts are updated
      type(case_spec), intent(inout) :: spec
      integer, parameter :: given = part_source%given
      type(case_spec) :: initial
      type(case_parts) :: one

      if (allocated(spec%wheel_rail)) allocate(initial%wheel_rail)
      associate (parts => spec%parts)
         parts%friction = given
         parts%rolling = given
         parts%material = given
         one = nothing()
         one%iteration = given
         if (differ(initial, spec, one, initial%solver /= spec%solver)) parts%iteration = given
         if (spec%has_damping) parts%damping = given
         if (.not. allocated(spec%wheel_rail)) return
         parts%search = given
         parts%track = given
         parts%rail_profile = given
         parts%deviations = given
         parts%wheel_profile = given
         parts%position = given
         parts%velocity = given
         associate (wheelset => spec%wheel_rail%wheelset)
            if (any(abs([wheelset%flexible, wheelset%flexible_rate]) > 0.0_wp)) parts%flexibility = given
         end associate
      end associate
   end subroutine give_first_parts

   !> Are there other choices, other values, or other names of values in some parts of two cases?
   logical function differ(before, spec, only, has_other_choices)
      type(case_spec), intent(in) :: before, spec
      !> The parts
      type(case_parts), intent(in) :: only
      !> Are choices different that these parts belong to? Default no
      logical, intent(in), optional :: has_other_choices
      type(collector) :: old, new

      if (present(has_other_choices)) then
         differ = has_other_choices
         if (differ) return
      end if
      call collect(before, only, old)
      call collect(spec, only, new)
      if (.not. (allocated(old%values) .and. allocated(new%values))) then
         differ = allocated(old%values) .neqv. allocated(new%values)
         return
      end if
      differ = size(old%values) /= size(new%values)
      if (.not. differ) differ = any(old%names /= new%names) .or. any(abs(old%values - new%values) > 0.0_wp)
   end function differ

   !> Values of some parts of a case
   subroutine collect(spec, only, a)
      type(case_spec), intent(in) :: spec
      !> The parts
      type(case_parts), intent(in) :: only
      type(collector), intent(inout) :: a
      type(case_spec), target :: copy

      copy = spec
      copy%parts = only
      copy%has_wear = .false.
      copy%has_stress = .false.
      if (.not. allocated(copy%wheel_rail)) then
         ! every case gives them
         copy%normal = normal_control%force
         copy%force = force_control%creepages
         copy%kinematics = kinematics_spec()
      end if
      call visit_case(a, copy)
   end subroutine collect

   !> No part
   pure function nothing() result(parts)
      type(case_parts) :: parts
      integer, parameter :: kept = part_source%kept

      parts = case_parts(iteration=kept, friction=kept, rolling=kept, material=kept, damping=kept, heat=kept, stress_output=kept, &
         & stress_points=kept, grid=kept, geometry=kept, extra_slip=kept, search=kept, track=kept, rail_profile=kept, &
         & deviations=kept, wheel_profile=kept, position=kept, velocity=kept, flexibility=kept)
   end function nothing

   !> Are two names of files different?
   pure logical function names_differ(one, other)
      character(len=:), allocatable, intent(in) :: one, other

      names_differ = allocated(one) .neqv. allocated(other)
      if (allocated(one) .and. allocated(other)) names_differ = one /= other
   end function names_differ
end module contact_cases_changed_parts
