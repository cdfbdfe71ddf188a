!> Spectra of the responses of a grid, kept for consecutive cases
!>
!> Cases of a series often request stresses at the same points below the same elements. The first case records its request, the
!> second one keeps the spectra, and later ones only multiply: a single case has no extra cost, and a series computes the
!> responses twice.
module contact_subsurface_response_shelf
   use contact_base_kinds, only : wp
   use contact_subsurface_load, only : surface_load
   implicit none (type, external)
   private

   public :: response_shelf

   !> Maximum memory of a shelf [bytes]
   real(wp), parameter :: max_memory = 64.0e6_wp
   !> Bytes per number
   real(wp), parameter :: bytes = 8.0_wp

   !> A request, and the spectra that belong to it
   type :: response_shelf
      private
      !> Sides of the elements [mm], moduli of rigidity [N/mm2] and Poisson's ratios [-], depths [mm]
      real(wp) :: side(2) = 0.0_wp, gg(2) = 0.0_wp, nu(2) = 0.0_wp
      real(wp), allocatable :: z(:)
      !> Do loads decrease linearly to the centres of the neighbours? Non-zero tractions
      logical :: bilinear = .false., acts(3) = .false.
      !> Maximum differences of columns and rows of the spectra; -1: no spectra
      integer, public :: nx = -1, ny = -1
      !> Real or imaginary parts of the spectra, shape (py/2 + 1, px/2 + 1, 4, number of packs, number of depths)
      real(wp), allocatable, public :: factor(:, :, :, :, :)
   contains
      !> Is this request the same as the recorded one, except for the positions of loads and points?
      procedure :: is_for
      !> Record the current request, without spectra
      procedure :: record
      !> Allocate spectra if there is enough memory; they are valid as soon as nx and ny are set
      procedure :: make_room
   end type response_shelf

contains

   pure logical function is_for(self, load, z)
      class(response_shelf), intent(in) :: self
      !> Elements, bodies and tractions
      type(surface_load), intent(in) :: load
      !> Depths [mm]
      real(wp), intent(in) :: z(:)

      is_for = .false.
      if (.not. allocated(self%z)) return
      if (size(self%z) /= size(z) .or. (self%bilinear .neqv. load%bilinear) .or. any(self%acts .neqv. load%acts)) return
      is_for = all([abs(self%side - [load%grid%dx, load%grid%dy]), abs(self%gg - load%gg), abs(self%nu - load%nu), &
         & abs(self%z - z)] <= 0.0_wp)
   end function is_for

   pure subroutine record(self, load, z)
      class(response_shelf), intent(inout) :: self
      !> Elements, bodies and tractions
      type(surface_load), intent(in) :: load
      !> Depths [mm]
      real(wp), intent(in) :: z(:)

      self%side = [load%grid%dx, load%grid%dy]
      self%gg = load%gg
      self%nu = load%nu
      self%bilinear = load%bilinear
      self%acts = load%acts
      self%z = z
      self%nx = -1
      self%ny = -1
      if (allocated(self%factor)) deallocate(self%factor)
   end subroutine record

   pure subroutine make_room(self, sizes, is_there)
      class(response_shelf), intent(inout) :: self
      !> Shape of the spectra
      integer, intent(in) :: sizes(5)
      !> Were they allocated? Otherwise the shelf is empty
      logical, intent(out) :: is_there

      self%nx = -1
      self%ny = -1
      if (allocated(self%factor)) deallocate(self%factor)
      is_there = product(real(sizes, wp))*bytes <= max_memory
      if (is_there) allocate(self%factor(sizes(1), sizes(2), sizes(3), sizes(4), sizes(5)))
   end subroutine make_room
end module contact_subsurface_response_shelf
