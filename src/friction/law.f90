!> What a friction law is: a coefficient per element, from the slip velocity or the temperature
!>
!> A law works on whole fields of the grid; it holds one set of parameters, or one per row.
module contact_friction_law
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: coulomb_law, friction_driver, friction_law, friction_parameters

   type :: friction_driver_list
      integer :: none = 0, slip_speed = 1, temperature = 2
   end type friction_driver_list
   !> What a law depends on
   type(friction_driver_list), parameter :: friction_driver = friction_driver_list()

   !> One set of parameters; a law uses those that it has
   type :: friction_parameters
      !> Coefficient at rest or in the cold, and limit at high velocity or temperature [-]
      real(wp) :: static = 0.3_wp, kinetic = 0.3_wp
      !> Contributions of two terms that vanish at high velocity [-] and the velocities [mm/s] at which
      !> half of them is left
      real(wp) :: term(2) = 0.0_wp, half_speed(2) = 1.0_wp
      !> Temperature at which friction begins to change and range over which it does [degC]
      real(wp) :: onset = 0.0_wp, range = 1.0_wp
   end type friction_parameters

   !> Friction law with its parameters
   type, abstract :: friction_law
      !> One set, or one per row of the grid
      type(friction_parameters), allocatable :: sets(:)
      !> Member of friction_driver
      integer :: driver = friction_driver%none
      !> The law in words
      character(len=:), allocatable :: name
   contains
      !> Coefficient in every element
      procedure(coefficient_interface), deferred :: coefficient
      !> Coefficient at rest and in the cold in every element
      procedure, non_overridable :: at_rest
      !> Number of the set of a row
      procedure, non_overridable :: set_of_row
      !> Does friction differ between rows?
      procedure, non_overridable :: varies_by_row
   end type friction_law

   abstract interface
      pure subroutine coefficient_interface(self, cause, mu)
         import :: friction_law, wp
         implicit none (type, external)
         class(friction_law), intent(in) :: self
         !> Slip velocity [mm/s] or temperature [degC], shape (mx, my); without meaning for Coulomb's law
         real(wp), contiguous, intent(in) :: cause(:, :)
         !> Coefficient of friction [-], shape (mx, my)
         real(wp), contiguous, intent(inout) :: mu(:, :)
      end subroutine coefficient_interface
   end interface

   !> Coulomb's law: one coefficient, whatever slip and temperature
   type, extends(friction_law) :: coulomb_law
   contains
      procedure :: coefficient => coulomb_coefficient
   end type coulomb_law

contains

   !> Number of the set that belongs to a row
   pure integer function set_of_row(self, iy) result(number)
      class(friction_law), intent(in) :: self
      !> Row of the grid, from 1
      integer, intent(in) :: iy
      number = min(iy, size(self%sets))
   end function set_of_row

   !> Coefficient without slip and in the cold
   pure subroutine at_rest(self, mu)
      class(friction_law), intent(in) :: self
      !> [-], shape (mx, my)
      real(wp), contiguous, intent(inout) :: mu(:, :)
      integer :: iy

      do iy = 1, size(mu, 2)
         mu(:, iy) = self%sets(self%set_of_row(iy))%static
      end do
   end subroutine at_rest

   pure logical function varies_by_row(self)
      class(friction_law), intent(in) :: self
      varies_by_row = size(self%sets) > 1
   end function varies_by_row

   pure subroutine coulomb_coefficient(self, cause, mu)
      class(coulomb_law), intent(in) :: self
      real(wp), contiguous, intent(in) :: cause(:, :)
      real(wp), contiguous, intent(inout) :: mu(:, :)

      associate (unused => cause)
         call self%at_rest(mu)
      end associate
   end subroutine coulomb_coefficient
end module contact_friction_law
