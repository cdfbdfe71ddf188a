!> Effects that were applied in a patch, as words for the report
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

   !> Text so far; a buffer of fixed length, because concatenation would allocate memory in every case
   type :: phrase
      private
      !> Buffer for all names that can occur together, and its length in use
      character(len=512) :: text = ""
      integer :: n = 0
   contains
      !> Append words
      procedure :: add
   end type phrase

contains

   !> Names of the effects that were applied
   subroutine name_effects(spec, problem, result)
      type(case_spec), intent(in) :: spec
      !> The problem of the patch that was solved
      type(patch_problem), intent(in) :: problem
      !> Its `effects` are set; they depend on whether there is contact
      type(patch_result), intent(inout) :: result
      type(phrase) :: words

      call add_bodies(spec, problem, words)
      if (result%ncon > 0) then
         if (allocated(problem%simplified)) then
            call words%add(", simplified theory (")
            call words%add(result%tangential%method(:len_trim(result%tangential%method)))
            call words%add(")")
         end if
         if (problem%motion /= motion%none) then
            call add_friction(spec, problem, words)
            call add_tangential(problem, result%nplast > 0, words)
         end if
         if (allocated(problem%thermal)) then
            call words%add(", surface temperatures (")
            call words%add(trim(heat_source_name(problem%thermal%source)))
            call words%add(")")
         end if
         if (spec%has_stress) call words%add(", subsurface stresses")
      end if
      if (allocated(result%damping)) then
         if (any(abs(result%damping) > 0.0_wp)) call words%add(", damping forces")
      end if
      result%effects = words%text(:words%n)
   end subroutine name_effects

   !> Append words
   pure subroutine add(self, words)
      class(phrase), intent(inout) :: self
      character(len=*), intent(in) :: words

      self%text(self%n + 1:) = words
      self%n = min(len(self%text), self%n + len(words))
   end subroutine add

   !> Material of the bodies, and method for the pressures
   subroutine add_bodies(spec, problem, words)
      type(case_spec), intent(in) :: spec
      type(patch_problem), intent(in) :: problem
      type(phrase), intent(inout) :: words

      if (allocated(problem%model%tabulated)) then
         call words%add("elastic bodies with tabulated influence coefficients")
      else if (allocated(problem%model%inclination)) then
         call words%add("elastic half-spaces with coefficients corrected for inclination")
      else if (allocated(problem%model%memory)) then
         call words%add("viscoelastic half-spaces")
      else
         call words%add("elastic half-spaces")
      end if
      if (problem%model%kernel == kernel_model%bilinear) call words%add(", bilinear tractions")
      if (allocated(spec%wheel_rail)) then
         if (spec%wheel_rail%search%location == contact_location%conformal) call words%add(", curved reference surface")
      end if
      if (allocated(problem%parts)) call words%add(", blended parts")
      select case (spec%pressure)
      case (pressure_model%thin_sheet)
         call words%add(", elastic thin sheet")
      case (pressure_model%elliptical, pressure_model%parabolical)
         call words%add(", Hertzian pressure")
      case (pressure_model%sdec)
         call words%add(", double-elliptical pressure")
      case (pressure_model%kpec, pressure_model%analyn)
         call words%add(", approximate pressure")
      end select
   end subroutine add_bodies

   !> Friction law and motion
   subroutine add_friction(spec, problem, words)
      type(case_spec), intent(in) :: spec
      type(patch_problem), intent(in) :: problem
      type(phrase), intent(inout) :: words

      call words%add(", ")
      if (allocated(problem%friction)) then
         call words%add(trim(problem%friction%title()))
         if (problem%friction%varies_by_row()) call words%add(" by row")
         if (problem%friction_memory%acts() .and. problem%remembers_friction) call words%add(" with memory")
      else
         call words%add("Coulomb friction")
      end if
      if (allocated(spec%wheel_rail)) then
         if (spec%variation == variation%by_angle) call words%add(" by inclination")
         if (spec%variation == variation%by_position) call words%add(" by position")
      end if
      select case (problem%motion)
      case (motion%shift)
         call words%add(" in a shift")
      case (motion%transient_rolling)
         call words%add(" in transient rolling")
      case (motion%steady_rolling)
         call words%add(" in steady rolling")
      end select
   end subroutine add_friction

   !> Other effects on tangential tractions
   subroutine add_tangential(problem, yields, words)
      type(patch_problem), intent(in) :: problem
      !> Are there plastic elements?
      logical, intent(in) :: yields
      type(phrase), intent(inout) :: words

      associate (model => problem%model)
         if (model%layer > 0.0_wp) call words%add(", elastic layer between the bodies")
         if (yields) call words%add(", plastic shearing")
         if (model%coupled() .and. .not. allocated(model%tabulated) .and. (model%material%coupled() .or. &
            & .not. allocated(model%inclination)) .and. .not. allocated(problem%simplified)) call words%add(", dissimilar bodies")
      end associate
      if (allocated(problem%extra_slip)) then
         if (any(abs(problem%extra_slip) > 0.0_wp)) call words%add(", extra rigid slip")
      end if
      if (problem%spin_weight(1) < 1.0_wp) call words%add(", longitudinal part of the spin cancelled")
      if (problem%spin_weight(2) < 1.0_wp) call words%add(", lateral part of the spin cancelled")
   end subroutine add_tangential
end module contact_cases_effects
