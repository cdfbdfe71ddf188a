!> Factory of friction laws: the only procedure that maps choices to laws
module contact_friction_new_law
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_friction_heated, only : heated_law
   use contact_friction_law, only : coulomb_law, friction_driver, friction_law, friction_set
   use contact_friction_slip_laws, only : exponential_law, linear_law, rational_law
   implicit none (type, external)
   private

   public :: friction_model, is_friction_law, is_varying_law, new_friction_law

   !> Friction laws (L)
   type :: friction_model_list
      integer :: coulomb = 0, linear = 2, rational = 3, exponential = 4, temperature = 6
   end type friction_model_list
   type(friction_model_list), parameter :: friction_model = friction_model_list()

contains

   !> Look up a law: whether it exists, whether its coefficient varies, and optionally the law without parameters
   subroutine find_law(choice, is_law, varies, law)
      !> Member of friction_model, or any other value
      integer, intent(in) :: choice
      !> Does the law exist, and does its coefficient vary with slip or temperature?
      logical, intent(out) :: is_law, varies
      !> Unallocated if it does not exist
      class(friction_law), allocatable, intent(out), optional :: law

      is_law = .true.
      varies = .false.
      select case (choice)
      case (friction_model%coulomb); call take(coulomb_law())
      case (friction_model%linear); call take(linear_law())
      case (friction_model%rational); call take(rational_law())
      case (friction_model%exponential); call take(exponential_law())
      case (friction_model%temperature); call take(heated_law())
      case default; is_law = .false.
      end select

   contains

      !> Set the results for a law; only the law itself is allocated
      subroutine take(kind)
         class(friction_law), intent(in) :: kind

         varies = kind%driver() /= friction_driver%none
         if (present(law)) allocate(law, source=kind)
      end subroutine take
   end subroutine find_law

   !> Is there a law for this choice?
   logical function is_friction_law(choice) result(is_law)
      !> Member of friction_model, or any other value
      integer, intent(in) :: choice
      logical :: varies

      call find_law(choice, is_law, varies)
   end function is_friction_law

   !> Does the coefficient of a law vary with slip or temperature? False if there is no such law
   logical function is_varying_law(choice) result(varies)
      !> Member of friction_model, or any other value
      integer, intent(in) :: choice
      logical :: is_law

      call find_law(choice, is_law, varies)
   end function is_varying_law

   !> Create a law with one set of parameters, or one per row of the grid
   subroutine new_friction_law(choice, sets, law, error)
      !> Member of friction_model
      integer, intent(in) :: choice
      !> Parameters: one set, or one per row of the grid, shape (my)
      type(friction_set), intent(in) :: sets(:)
      !> Law of the type that belongs to the choice
      class(friction_law), allocatable, intent(out) :: law
      !> Allocated if there is no such law
      type(error_type), allocatable, intent(out) :: error
      logical :: is_law, varies
      integer :: k

      call find_law(choice, is_law, varies, law)
      if (.not. is_law) then
         call fatal_error(error, "there is no friction law with this number", error_kind%input)
         return
      end if
      law%sets = sets
      if (size(sets) < 1) call fatal_error(error, "a friction law needs a set of parameters", error_kind%input)
      do k = 1, size(sets)
         if (allocated(error)) return
         associate (set => law%sets(k))
            ! an absent term may have any velocity
            if (abs(set%coef1) <= 0.0_wp) set%sabsh1 = 1.0_wp
            if (abs(set%coef2) <= 0.0_wp) set%sabsh2 = 1.0_wp
            if (.not. all(ieee_is_finite(set%numbers()))) then
               call fatal_error(error, "the parameters of the friction law must be finite", error_kind%input)
            else if (any([set%fstat, set%fkin, set%coef1, set%coef2] < 0.0_wp)) then
               call fatal_error(error, "coefficients of friction must not be negative", error_kind%input)
            else if (law%fault(set) /= "") then
               call fatal_error(error, trim(law%fault(set)), error_kind%input)
            end if
         end associate
      end do
   end subroutine new_friction_law
end module contact_friction_new_law
