!> Which effects acted in a patch, in words for the report
module contact_cases_effects
   use contact_base_choices, only : contact_location, heat_source_name, kernel_model, motion, pressure_model, &
      & variation
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_patch_problem, only : patch_problem
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: name_effects

contains

   !> Names of the effects that acted
   subroutine name_effects(spec, problem, result)
      type(case_spec), intent(in) :: spec
      !> The problem of the patch as it was solved
      type(patch_problem), intent(in) :: problem
      !> Its `effects` are set; what acts depends on whether there is contact
      type(patch_result), intent(inout) :: result
      !> Room for all names that can come together
      character(len=512) :: text
      integer :: n

      n = 0
      text = ""
      if (allocated(problem%model%tabulated)) then
         call add("elastic bodies with tabulated influence coefficients")
      else if (allocated(problem%model%inclination)) then
         call add("elastic half-spaces with coefficients corrected for inclination")
      else if (allocated(problem%model%memory)) then
         call add("viscoelastic half-spaces")
      else
         call add("elastic half-spaces")
      end if
      if (problem%model%kernel == kernel_model%bilinear) call add(", bilinear tractions")
      if (allocated(spec%wheel_rail)) then
         if (spec%wheel_rail%search%location == contact_location%conformal) call add(", curved reference surface")
      end if
      if (allocated(problem%parts)) call add(", blended parts")
      select case (spec%pressure)
      case (pressure_model%thin_sheet)
         call add(", elastic thin sheet")
      case (pressure_model%elliptical, pressure_model%parabolical)
         call add(", Hertzian pressure")
      case (pressure_model%sdec)
         call add(", double-elliptical pressure")
      case (pressure_model%kpec, pressure_model%analyn)
         call add(", approximate pressure")
      end select
      if (result%ncon > 0) then
         if (allocated(problem%simplified)) then
            call add(", simplified theory (")
            call add(result%tangential%method(:len_trim(result%tangential%method)))
            call add(")")
         end if
         if (problem%motion /= motion%none) then
            call add_friction()
            if (problem%model%layer > 0.0_wp) call add(", elastic layer between the bodies")
            if (result%nplast > 0) call add(", plastic shearing")
            if (problem%model%coupled() .and. .not. allocated(problem%model%tabulated) &
               & .and. (problem%model%material%coupled() .or. .not. allocated(problem%model%inclination)) &
               & .and. .not. allocated(problem%simplified)) call add(", dissimilar bodies")
            if (allocated(problem%extra_slip)) then
               if (any(abs(problem%extra_slip) > 0.0_wp)) call add(", extra rigid slip")
            end if
            if (problem%spin_weight(1) < 1.0_wp) call add(", longitudinal part of the spin cancelled")
            if (problem%spin_weight(2) < 1.0_wp) call add(", lateral part of the spin cancelled")
         end if
         if (allocated(problem%thermal)) then
            call add(", surface temperatures (")
            call add(trim(heat_source_name(problem%thermal%source)))
            call add(")")
         end if
         if (spec%has_stress) call add(", subsurface stresses")
      end if
      if (allocated(result%damping)) then
         if (any(abs(result%damping) > 0.0_wp)) call add(", damping forces")
      end if
      result%effects = text(:n)

   contains

      !> The next words; a buffer, because joining texts would ask for memory in every case
      subroutine add(words)
         character(len=*), intent(in) :: words

         text(n + 1:) = words
         n = min(len(text), n + len(words))
      end subroutine add

      !> Friction law and motion
      subroutine add_friction()
         call add(", ")
         if (allocated(problem%friction)) then
            call add(trim(problem%friction%title()))
            if (problem%friction%varies_by_row()) call add(" by row")
            if (problem%friction_memory%acts() .and. problem%remembers_friction) call add(" with memory")
         else
            call add("Coulomb friction")
         end if
         if (allocated(spec%wheel_rail)) then
            if (spec%variation == variation%by_angle) call add(" by inclination")
            if (spec%variation == variation%by_position) call add(" by position")
         end if
         select case (problem%motion)
         case (motion%shift)
            call add(" in a shift")
         case (motion%transient_rolling)
            call add(" in transient rolling")
         case (motion%steady_rolling)
            call add(" in steady rolling")
         end select
      end subroutine add_friction
   end subroutine name_effects
end module contact_cases_effects
