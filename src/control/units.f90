!> Units and sign conventions of callers of the library, as tables
!>
!> Internal units are mm, N, s, rad, degC; internally forces act on body 1, and the wheel is on the right side of the track. Input
!> is multiplied by `inward`, output by `outward`; no other part of the library depends on conventions. Time and temperature have
!> the same units in all of them.
module contact_control_units
   use contact_base_kinds, only : wp
   use contact_patch_quantities, only : is_lateral, orientation
   implicit none (type, external)
   private

   public :: unit_convention, convention_code, find_convention, quantity, quantity_type, quantity_of, orientation, inward, outward

   type :: convention_code_list
      integer :: contact = 1934, simpack = 1935, si = 1936, imperial = 1937
   end type convention_code_list
   !> Codes of the conventions in the interface
   type(convention_code_list), parameter :: convention_code = convention_code_list()

   !> A convention: internal value = factor times external value
   type :: unit_convention
      integer :: code = 1934
      !> Length, force, velocity, angle
      real(wp) :: length = 1.0_wp, force = 1.0_wp, velocity = 1.0_wp, angle = 1.0_wp
      !> Body on which returned forces and tractions act: 1 for body 1, -1 for body 2
      real(wp) :: body = 1.0_wp
   contains
      !> Are numbers in internal units?
      procedure :: is_internal
   end type unit_convention

   type(unit_convention), parameter :: conventions(*) = [ &
      & unit_convention(1934, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp), &
      & unit_convention(1935, 1000.0_wp, 1.0_wp, 1000.0_wp, 1.0_wp, -1.0_wp), &
      & unit_convention(1936, 1000.0_wp, 1.0_wp, 1000.0_wp, 1.0_wp, 1.0_wp), &
      & unit_convention(1937, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp)]

   !> A physical quantity as powers of length, force, velocity and angle
   type :: quantity_type
      integer :: length = 0, force = 0, velocity = 0, angle = 0
   end type quantity_type

   type :: quantity_list
      type(quantity_type) :: number = quantity_type()
      type(quantity_type) :: length = quantity_type(length=1)
      type(quantity_type) :: area = quantity_type(length=2)
      type(quantity_type) :: curvature = quantity_type(length=-1)
      type(quantity_type) :: angle = quantity_type(angle=1)
      type(quantity_type) :: velocity = quantity_type(velocity=1)
      !> Slip decay rate [s/mm]
      type(quantity_type) :: per_velocity = quantity_type(velocity=-1)
      type(quantity_type) :: force = quantity_type(force=1)
      type(quantity_type) :: moment = quantity_type(length=1, force=1)
      type(quantity_type) :: pressure = quantity_type(length=-2, force=1)
      !> Slope of the yield limit [N/mm3], stiffness [N/mm], flexibility of a layer [mm3/N]
      type(quantity_type) :: pressure_slope = quantity_type(length=-3, force=1)
      type(quantity_type) :: stiffness = quantity_type(length=-1, force=1)
      type(quantity_type) :: compliance = quantity_type(length=3, force=-1)
      type(quantity_type) :: spin = quantity_type(length=-1, angle=1)
      !> Thermal conductivity [W/(K mm)], density [kg/mm3]
      type(quantity_type) :: conductivity = quantity_type(length=-1)
      type(quantity_type) :: density = quantity_type(length=-3)
   end type quantity_list
   !> Names of quantities
   type(quantity_list), parameter :: quantity = quantity_list()

contains

   !> Are numbers in internal units?
   pure logical function is_internal(self)
      class(unit_convention), intent(in) :: self

      is_internal = all(abs([self%length, self%force, self%velocity, self%angle] - 1.0_wp) <= 0.0_wp)
   end function is_internal

   !> Find a convention by its code; unchanged for an unknown code
   pure subroutine find_convention(code, units, known)
      !> CNTC_un_...
      integer, intent(in) :: code
      type(unit_convention), intent(inout) :: units
      !> Does the convention exist?
      logical, intent(out) :: known
      integer :: k

      known = .false.
      do k = 1, size(conventions)
         if (conventions(k)%code /= code) cycle
         units = conventions(k)
         known = .true.
      end do
   end subroutine find_convention

   !> Quantity of a unit in the table of bounds; `number` for units that are the same for caller and program
   elemental type(quantity_type) function quantity_of(unit) result(what)
      !> Unit as written in the tables: "N/mm2", "rad", "-"
      character(len=*), intent(in) :: unit

      select case (unit)
      case ("mm"); what = quantity%length
      case ("1/mm"); what = quantity%curvature
      case ("rad", "rad/s"); what = quantity%angle
      case ("rad/mm"); what = quantity%spin
      case ("mm/s"); what = quantity%velocity
      case ("s/mm"); what = quantity%per_velocity
      case ("N", "N/s"); what = quantity%force
      case ("N mm"); what = quantity%moment
      case ("mm2"); what = quantity%area
      case ("N/mm2"); what = quantity%pressure
      case ("N/mm3"); what = quantity%pressure_slope
      case ("N/mm"); what = quantity%stiffness
      case ("mm3/N"); what = quantity%compliance
      case ("W/(mm degC)"); what = quantity%conductivity
      case ("kg/mm3"); what = quantity%density
      case default; what = quantity%number
      end select
   end function quantity_of

   !> Factor from the units of a caller to internal ones
   elemental real(wp) function inward(units, what) result(factor)
      type(unit_convention), intent(in) :: units
      !> Powers of length, force, velocity and angle
      type(quantity_type), intent(in) :: what

      factor = units%length**what%length*units%force**what%force*units%velocity**what%velocity*units%angle**what%angle
   end function inward

   !> Factor, with sign, from internal units to those of a caller
   elemental real(wp) function outward(units, what, along, left) result(factor)
      type(unit_convention), intent(in) :: units
      !> Powers of length, force, velocity and angle
      type(quantity_type), intent(in) :: what
      !> Member of orientation; default none
      integer, intent(in), optional :: along
      !> Is it a wheel on the left side of the track?
      logical, intent(in), optional :: left

      factor = 1.0_wp/inward(units, what)
      if (.not. present(along)) return
      if (along == orientation%along .or. along == orientation%across) factor = units%body*factor
      if (.not. present(left)) return
      if (left .and. is_lateral(along)) factor = -factor
   end function outward
end module contact_control_units
