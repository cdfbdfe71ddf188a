!> Which effects acted in a patch, in words for the report
module contact_cases_effects
   use contact_base_choices, only : contact_location, motion, pressure_model, stress_choice, variation
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
      character(len=:), allocatable :: text, law, on_curve

      on_curve = ""
      law = "Coulomb friction"
      if (allocated(problem%friction)) then
         law = problem%friction%name
         if (problem%friction%varies_by_row()) law = law // " by row"
         if (problem%friction_memory%acts() .and. problem%remembers_friction) law = law // " with memory"
      end if
      if (allocated(spec%wheel_rail)) then
         if (spec%wheel_rail%search%location == contact_location%conformal) on_curve = ", curved reference surface"
         if (spec%variation == variation%by_angle) law = law // " by inclination"
         if (spec%variation == variation%by_position) law = law // " by position"
      end if
      text = "elastic half-spaces"
      if (allocated(problem%model%inclination)) text = "elastic half-spaces with coefficients corrected for inclination"
      if (allocated(problem%model%tabulated)) text = "elastic bodies with tabulated influence coefficients"
      text = text // on_curve
      if (allocated(problem%parts)) text = text // ", blended parts"
      select case (spec%pressure)
      case (pressure_model%elliptical, pressure_model%parabolical)
         text = text // ", Hertzian pressure"
      case (pressure_model%sdec)
         text = text // ", double-elliptical pressure"
      case (pressure_model%kpec, pressure_model%analyn)
         text = text // ", approximate pressure"
      end select
      if (result%ncon > 0) then
         if (allocated(problem%simplified)) text = text // ", simplified theory (" // result%tangential%method // ")"
         if (problem%motion == motion%shift) text = text // ", " // law // " in a shift"
         if (problem%motion == motion%transient_rolling) text = text // ", " // law // " in transient rolling"
         if (problem%motion == motion%steady_rolling) text = text // ", " // law // " in steady rolling"
         if (problem%motion /= motion%none .and. problem%remembers_yield) text = text // ", plastic shearing"
         if (problem%motion /= motion%none .and. problem%model%coupled() .and. .not. allocated(problem%model%tabulated) &
            & .and. (problem%model%material%coupled() .or. .not. allocated(problem%model%inclination)) &
            & .and. .not. allocated(problem%simplified)) text = text // ", dissimilar bodies"
         if (allocated(problem%extra_slip) .and. problem%motion /= motion%none) text = text // ", extra rigid slip"
         if (allocated(problem%thermal)) text = text // ", surface temperatures"
         if (spec%stress /= stress_choice%none) text = text // ", subsurface stresses"
      end if
      if (allocated(problem%damping)) text = text // ", damping forces"
      result%effects = text
   end subroutine name_effects
end module contact_cases_effects
