!> From the specification of a case to its friction law and thermal constants
module contact_cases_friction_setup
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_choices, only : motion, variation
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec, heat_spec
   use contact_friction_law, only : friction_driver, friction_law, friction_set
   use contact_friction_memory, only : friction_memory
   use contact_friction_new_law, only : is_varying_law, new_friction_law
   use contact_patch_problem, only : patch_problem
   use contact_temperature_flash_heating, only : new_body_pair
   implicit none (type, external)
   private

   public :: set_friction, set_thermal

contains

   !> Friction law; not needed for Coulomb friction with one coefficient
   subroutine set_friction(spec, problem, error)
      type(case_spec), intent(in) :: spec
      !> Problem with its grid
      type(patch_problem), intent(inout) :: problem
      type(error_type), allocatable, intent(out) :: error
      class(friction_law), allocatable :: law
      type(friction_set) :: set
      logical :: by_row, has_law
      integer :: iy

      if (allocated(problem%friction)) deallocate(problem%friction)
      problem%remembers_friction = .false.
      problem%mu = 0.0_wp
      ! there are no sets after a case that should have given them and was refused
      if (allocated(spec%friction%sets)) problem%mu = spec%friction%sets(1)%fstat
      by_row = spec%variation == variation%by_row
      has_law = .false.
      if (spec%motion /= motion%none .and. allocated(spec%friction%sets)) &
         & has_law = is_varying_law(spec%friction_law) .or. size(spec%friction%sets) /= 1 .or. by_row
      ! a case with a law reuses the memory of the previous one
      if (.not. has_law .and. allocated(problem%static_mu)) deallocate(problem%static_mu)
      if (spec%motion /= motion%none .and. .not. allocated(spec%friction%sets)) &
         & call fatal_error(error, "no coefficient of friction has been given")
      if (.not. has_law) return
      if (size(spec%friction%sets) /= 1 .and. size(spec%friction%sets) /= problem%grid%my) then
         call fatal_error(error, "friction parameters per row were given for another number of rows")
         return
      end if
      call new_friction_law(spec%friction_law, spec%friction%sets, law, error)
      if (allocated(error)) return
      ! also for a grid of one row, so that relative forces do not depend on the number of rows
      if (by_row .or. law%varies_by_row()) problem%mu = 1.0_wp
      problem%slip_start = sign(1, spec%iteration%inislp)
      if (spec%iteration%inislp == 0) problem%slip_start = 0
      problem%slip_relaxation = spec%iteration%omgslp
      problem%friction_memory = friction_memory(spec%friction%memdst, spec%friction%mem_s0)
      if (law%driver() /= friction_driver%none) then
         if (.not. all(ieee_is_finite([spec%friction%memdst, spec%friction%mem_s0, spec%iteration%omgslp])) &
            & .or. min(spec%friction%memdst, spec%friction%mem_s0) < 0.0_wp) then
            call fatal_error(error, "the distance and the velocity of friction memory must not be negative, and OMGSLP finite")
            return
         end if
         problem%remembers_friction = .true.
      end if
      if (allocated(problem%static_mu)) then
         if (size(problem%static_mu) /= problem%grid%my) deallocate(problem%static_mu)
      end if
      if (.not. allocated(problem%static_mu)) allocate(problem%static_mu(problem%grid%my))
      do iy = 1, problem%grid%my
         set = law%set_of_row(iy)
         problem%static_mu(iy) = set%fstat
      end do
      call move_alloc(law, problem%friction)
   end subroutine set_friction

   !> Thermal constants, if temperatures are requested
   subroutine set_thermal(spec, problem, error)
      type(case_spec), intent(in) :: spec
      type(patch_problem), intent(inout) :: problem
      type(error_type), allocatable, intent(out) :: error

      if (allocated(problem%thermal)) deallocate(problem%thermal)
      if (.not. spec%has_heat) return
      associate (heat => spec%heat)
         if (.not. is_usable(heat)) then
            call fatal_error(error, "bulk temperatures must be finite, heat capacities, conductivities and densities positive")
            return
         end if
         allocate(problem%thermal, source=new_body_pair(heat%bktemp, heat%heatcp, heat%lambda, heat%dens, heat%betapl))
         problem%thermal%source = heat%source
      end associate
   end subroutine set_thermal

   pure logical function is_usable(heat)
      type(heat_spec), intent(in) :: heat

      is_usable = all(ieee_is_finite([heat%bktemp, heat%heatcp, heat%lambda, heat%dens, heat%betapl])) &
         & .and. all([heat%heatcp, heat%lambda, heat%dens] > 0.0_wp) .and. heat%betapl >= 0.0_wp
   end function is_usable
end module contact_cases_friction_setup
