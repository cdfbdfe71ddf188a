!> Friction laws: a coefficient per element, as a function of slip velocity or temperature
!>
!> A law operates on complete fields; it holds one set of parameters, or one per row of the grid.
module contact_friction_law
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: coulomb_law, friction_driver, friction_law, friction_set, mixed, title_length

   !> Length of the title of a law
   integer, parameter :: title_length = 48

   type :: friction_driver_list
      integer :: none = 0, slip_speed = 1, temperature = 2
   end type friction_driver_list
   !> Quantity on which a law depends
   type(friction_driver_list), parameter :: friction_driver = friction_driver_list()

   !> A set of friction parameters; each law uses some of them
   !>
   !> All components are real numbers: `numbers` and `mixed` treat them as an array.
   type :: friction_set
      !> Angle [rad] or position [mm] of the set, if friction varies over the contact
      real(wp) :: position = 0.0_wp
      !> Coefficient at rest or in the cold state, and limit at high velocity or temperature [-]
      real(wp) :: fstat = 0.3_wp, fkin = 0.3_wp
      !> Two terms that vanish at high velocity [-], and the velocities at which they have decreased by half [mm/s]
      real(wp) :: coef1 = 0.0_wp, sabsh1 = 1.0_wp, coef2 = 0.0_wp, sabsh2 = 1.0_wp
      !> Temperature dependence: coefficient in the cold state [-], temperature at which friction starts to change [degC],
      !> change [-], and temperature range of the change [degC]
      real(wp) :: fref = 0.3_wp, tref = 0.0_wp, dfheat = -0.1_wp, dtheat = 800.0_wp
   contains
      !> All components as an array
      procedure :: numbers
   end type friction_set

   !> Friction law with its parameters
   type, abstract :: friction_law
      !> One set, or one per row of the grid
      type(friction_set), allocatable :: sets(:)
   contains
      !> Coefficient of each element
      procedure(coefficient_interface), deferred :: coefficient
      !> Title of the law, padded with blanks
      procedure(title_interface), deferred, nopass :: title
      !> Member of friction_driver
      procedure, nopass :: driver => no_driver
      !> What is wrong with a set of parameters for this law; blank if nothing
      procedure, nopass :: fault => no_fault
      !> Coefficient of each element at rest and in the cold state
      procedure, non_overridable :: at_rest
      !> Parameters of a row
      procedure, non_overridable :: set_of_row
      !> Does friction differ between rows?
      procedure, non_overridable :: varies_by_row
   end type friction_law

   abstract interface
      pure subroutine coefficient_interface(self, cause, mu)
         import :: friction_law, wp
         implicit none (type, external)
         class(friction_law), intent(in) :: self
         !> Slip velocity [mm/s] or temperature [degC], shape (mx, my); unused by Coulomb's law
         real(wp), contiguous, intent(in) :: cause(:, :)
         !> Coefficient of friction [-], shape (mx, my)
         real(wp), contiguous, intent(inout) :: mu(:, :)
      end subroutine coefficient_interface

      pure function title_interface() result(title)
         import :: title_length
         implicit none (type, external)
         character(len=title_length) :: title
      end function title_interface
   end interface

   !> Coulomb's law: a constant coefficient
   type, extends(friction_law) :: coulomb_law
   contains
      procedure :: coefficient => coulomb_coefficient
      procedure, nopass :: title => coulomb_title
   end type coulomb_law

contains

   !> All components as an array
   pure function numbers(self) result(list)
      class(friction_set), intent(in) :: self
      real(wp) :: list(storage_size(self)/storage_size(0.0_wp))
      type(friction_set) :: set

      set = self
      list = transfer(set, list)
   end function numbers

   !> Parameters by linear interpolation between two sets
   pure function mixed(a, b, t) result(set)
      !> Parameters at the two ends
      type(friction_set), intent(in) :: a, b
      !> Weight of b, 0...1
      real(wp), intent(in) :: t
      type(friction_set) :: set

      set = transfer((1.0_wp - t)*a%numbers() + t*b%numbers(), set)
   end function mixed

   !> Driver of a constant law
   pure integer function no_driver() result(driver)
      driver = friction_driver%none
   end function no_driver

   !> Check of laws without parameter limits of their own
   pure function no_fault(set) result(text)
      !> Parameters of any law
      type(friction_set), intent(in) :: set
      character(len=100) :: text

      associate (unused => set%fstat)
         text = ""
      end associate
   end function no_fault

   !> Parameters of a row: its own, or those of the only set
   pure function set_of_row(self, iy) result(set)
      class(friction_law), intent(in) :: self
      !> Row of the grid, from 1
      integer, intent(in) :: iy
      type(friction_set) :: set
      set = self%sets(min(iy, size(self%sets)))
   end function set_of_row

   !> Coefficient without slip and in the cold state
   pure subroutine at_rest(self, mu)
      class(friction_law), intent(in) :: self
      !> [-], shape (mx, my)
      real(wp), contiguous, intent(inout) :: mu(:, :)
      type(friction_set) :: set
      integer :: iy

      do iy = 1, size(mu, 2)
         set = self%set_of_row(iy)
         mu(:, iy) = set%fstat
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

   pure function coulomb_title() result(title)
      character(len=title_length) :: title
      title = "Coulomb friction"
   end function coulomb_title
end module contact_friction_law
