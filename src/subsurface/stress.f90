!> Displacements and stresses inside both bodies due to the surface tractions
module contact_subsurface_stress
   use contact_base_kinds, only : wp
   use contact_subsurface_direct, only : number_of_terms, sum_directly
   use contact_subsurface_layers, only : padded_size, transform_layers
   use contact_subsurface_load, only : surface_load
   use contact_subsurface_points, only : list_points, point_set
   use contact_subsurface_response_shelf, only : response_shelf
   implicit none (type, external)
   private

   public :: subsurface_field

   !> Stresses below this fraction of the modulus of rigidity are round-off
   real(wp), parameter :: noise = 1.0e-15_wp
   !> Points closer than this to a centre, relative to the element side, are regarded as lying on it
   real(wp), parameter :: on_centre = 1.0e-9_wp
   !> Maximum distance of a column or row
   real(wp), parameter :: farthest = 1.0e6_wp
   !> Measured costs [ns]: a closed-form term of a direct sum; per layer, an element of the padded window, and a difference
   !> between point and load
   real(wp), parameter :: term_cost = 170.0_wp, padded_cost = 220.0_wp, difference_cost = 800.0_wp

contains

   !> Displacements and stresses at a set of points, in body 1 for z >= 0 and in body 2 for z < 0
   !>
   !> Uses fast Fourier transforms if the points are centres of elements and it is faster, otherwise direct sums.
   subroutine subsurface_field(load, points, displacement, stress, shelf)
      !> Surface tractions and constants of the bodies
      type(surface_load), intent(in) :: load
      !> Sorted coordinates
      type(point_set), intent(in) :: points
      !> Displacements of the body that contains the point [mm], shape (3, n), x fastest
      real(wp), contiguous, intent(out) :: displacement(:, :)
      !> Stresses [N/mm2], tension positive: xx, xy, xz, yy, yz, zz, shape (6, n)
      real(wp), contiguous, intent(out) :: stress(:, :)
      !> Spectra kept by consecutive cases for the points of a block; absent: none
      type(response_shelf), intent(inout), optional :: shelf
      integer, allocatable :: ix(:), iy(:)
      real(wp), allocatable :: position(:, :)
      integer :: body, point

      if (size(displacement, 2) == 0) return
      call find_centres(points%x, load%grid%xl, load%grid%dx, ix)
      call find_centres(points%y, load%grid%yl, load%grid%dy, iy)
      if (transforms_are_faster(load, ix, iy)) then
         call transform_layers(load, ix, iy, points%z, displacement, stress, shelf)
      else
         allocate(position(3, points%n()))
         call list_points(points, position)
         call sum_directly(load, position, displacement, stress)
      end if
      do point = 1, size(stress, 2)
         body = merge(1, 2, points%z(1 + (point - 1)/(size(points%x)*size(points%y))) >= 0.0_wp)
         where (abs(stress(:, point)) < noise*load%gg(body)) stress(:, point) = 0.0_wp
      end do
   end subroutine subsurface_field

   !> Columns, or rows, whose centres have the given coordinates
   pure subroutine find_centres(x, xl, dx, ix)
      !> Coordinates [mm]
      real(wp), intent(in) :: x(:)
      !> Lower edge of the grid and element side [mm]
      real(wp), intent(in) :: xl, dx
      !> Indices of columns; unallocated if any coordinate is not at a centre
      integer, allocatable, intent(out) :: ix(:)
      real(wp) :: column(size(x))

      column = (x - xl)/dx + 0.5_wp
      ! also returns for NaN
      if (.not. all(abs(column) <= farthest)) return
      if (all(abs(column - anint(column)) <= on_centre)) ix = nint(column)
   end subroutine find_centres

   !> Are transforms faster than direct sums, per layer?
   pure logical function transforms_are_faster(load, ix, iy) result(is_faster)
      type(surface_load), intent(in) :: load
      !> Columns and rows of the points; unallocated if they are not centres
      integer, allocatable, intent(in) :: ix(:), iy(:)
      real(wp) :: padded, differences

      is_faster = .false.
      if (.not. (allocated(ix) .and. allocated(iy)) .or. .not. any(load%acts)) return
      call padded_size(load, ix, iy, padded, differences)
      is_faster = padded_cost*padded + difference_cost*differences &
         & < term_cost*real(size(ix), wp)*real(size(iy), wp)*number_of_terms(load)
   end function transforms_are_faster
end module contact_subsurface_stress
