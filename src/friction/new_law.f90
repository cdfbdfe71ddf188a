!> Makes friction laws: the one place that knows which law belongs to which choice
module contact_friction_new_law
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_choices, only : friction_model
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_friction_heated, only : heated_law
   use contact_friction_law, only : coulomb_law, friction_driver, friction_law, friction_parameters
   use contact_friction_slip_laws, only : exponential_law, linear_law, rational_law
   implicit none (type, external)
   private

   public :: new_friction_law

contains

   !> Law with one set of parameters, or one per row of the grid
   subroutine new_friction_law(choice, sets, law, error)
      !> Member of friction_model
      integer, intent(in) :: choice
      !> Parameters: one set, or one per row of the grid, shape (my)
      type(friction_parameters), intent(in) :: sets(:)
      !> Of the type that belongs to the choice
      class(friction_law), allocatable, intent(out) :: law
      !> Allocated when no law has this number
      type(error_type), allocatable, intent(out) :: error
      integer :: k, i

      select case (choice)
      case (friction_model%coulomb)
         allocate(coulomb_law :: law)
         law%name = "Coulomb friction"
      case (friction_model%linear)
         allocate(linear_law :: law)
         law%name = "friction falling linearly with slip"
      case (friction_model%rational)
         allocate(rational_law :: law)
         law%name = "friction falling rationally with slip"
      case (friction_model%exponential)
         allocate(exponential_law :: law)
         law%name = "friction falling exponentially with slip"
      case (friction_model%temperature)
         allocate(heated_law :: law)
         law%name = "friction changing with temperature"
      case default
         call fatal_error(error, "there is no friction law of this number", error_kind%input)
         return
      end select
      select case (choice)
      case (friction_model%linear, friction_model%rational, friction_model%exponential)
         law%driver = friction_driver%slip_speed
      case (friction_model%temperature)
         law%driver = friction_driver%temperature
      end select

      law%sets = sets
      if (size(sets) < 1) call fatal_error(error, "a friction law needs a set of parameters", error_kind%input)
      do k = 1, size(sets)
         if (allocated(error)) return
         associate (set => law%sets(k))
            do i = 1, 2
               ! a term that is not there may have any velocity
               if (abs(set%term(i)) <= 0.0_wp) set%half_speed(i) = 1.0_wp
            end do
            if (.not. all(ieee_is_finite([set%static, set%kinetic, set%term, set%half_speed, set%onset, set%range]))) then
               call fatal_error(error, "the parameters of the friction law must be finite", error_kind%input)
            else if (any([set%static, set%kinetic, set%term] < 0.0_wp)) then
               call fatal_error(error, "coefficients of friction must not be negative", error_kind%input)
            else if (law%driver == friction_driver%slip_speed .and. any(set%half_speed <= 0.0_wp)) then
               call fatal_error(error, "the velocities at which friction has fallen by half must be positive", &
                  & error_kind%input)
            else if (law%driver == friction_driver%temperature .and. set%range <= 0.0_wp) then
               call fatal_error(error, "the range of temperature in which friction changes must be positive", &
                  & error_kind%input)
            end if
         end associate
      end do
   end subroutine new_friction_law
end module contact_friction_new_law
