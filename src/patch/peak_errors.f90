!> Error of the largest pressure of a patch, estimated from the shape of the peak and from the peak on elements three times as long
!>
!> See doc/theory/errors.md.
module contact_patch_peak_errors
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_patch_coarse_level, only : coarsening
   use contact_patch_error_scales, only : normal_order, resolved, scale_type, unresolved_floor
   use contact_patch_peak, only : peak_of
   use contact_patch_result, only : patch_result
   use contact_patch_traction_errors, only : trusted
   implicit none (type, external)
   private

   public :: error_of_peak

   !> Lower bound times n^-2, half the rms over offsets of a Hertzian peak; its second difference over an element is 4 n^-2 of the
   !> peak
   real(wp), parameter :: peak_floor = 0.15_wp, smooth_bend = 4.0_wp
   !> Tractions of unlike bodies increase pressures within regions that elements do not resolve: factor of the difference parameter
   !> K times n^-2; of the hard cases
   real(wp), parameter :: coupled_floor = 4.0_wp
   !> A peak whose second difference exceeds this multiple of that of a smooth one is not resolved: its error is this fraction of
   !> the excess; chosen with the hard cases of tests/stability
   real(wp), parameter :: usual_bend = 3.0_wp, unresolved = 0.15_wp
   !> Exponent of the ratio of an error of the largest pressure by the levels to the general error, of like and of unlike bodies,
   !> see trusted
   real(wp), parameter :: peak_trust(2) = [0.65_wp, 0.75_wp]
   !> Number of elements across for which the coarse level, with a third of them, resolves the shape of a peak; with fewer, its
   !> difference is larger than its order predicts, and the exponent is smaller; of viscoelastic bodies and bumpy profiles (seeds 55
   !> and 5301)
   real(wp), parameter :: clear_peak = 20.0_wp
   !> A peak within few elements of an edge of the contact: error over the excess of the outermost pressure above that of a
   !> semi-ellipse; chosen with hard wheels (seed 611)
   real(wp), parameter :: hidden_edge = 0.5_wp
   !> Rough surfaces have peaks between element centres: factor of the standard deviation of heights over the approach, in excess of
   !> that of single jumps of the curvature, times n; of rough profiles of hard wheels (seed 611)
   real(wp), parameter :: rough_peak = 0.6_wp, usual_roughness = 0.02_wp
   !> A strip of n elements is between n - 1 and n + 1 elements wide; for the largest peak pressure that its load may have, its
   !> width is taken as n less this; chosen
   real(wp), parameter :: narrower = 0.5_wp

   !> Shape of a peak along a line of elements through it
   type :: peak_shape
      !> Number of elements in contact without a gap, and their sum of pressures [N/mm2]
      integer :: n = 0
      real(wp) :: load = 0.0_wp
      !> Second difference at the peak, and the same with the harmonic mean of the decreases on both sides [N/mm2]
      real(wp) :: bend = 0.0_wp, cusp = 0.0_wp
      !> Excess of the pressure at an edge within few elements of the peak above that of a semi-ellipse, over the peak [-]
      real(wp) :: step = 0.0_wp
   end type peak_shape

contains

   !> Error of the largest pressure: the error of pressures, with order 1 the difference between the peak and the nearest element
   !> centre, and the height of lower peaks that elements do not resolve
   pure real(wp) function error_of_peak(result, scale, coarse_peak) result(e)
      !> Solved patch, with the contributions of solvers and window
      type(patch_result), intent(in) :: result
      !> See type scale_type
      type(scale_type), intent(in) :: scale
      !> Peak of the pressures of the coarse level [N/mm2]
      real(wp), intent(in) :: coarse_peak
      type(peak_shape) :: shape(2)
      real(wp) :: peak, floor, across, bend, cusp
      integer :: at(2), k

      at = maxloc(result%pn)
      shape = [shape_of(result%pn(:, at(2)), at(1)), shape_of(result%pn(at(1), :), at(2))]
      ! the peak may belong to a part of the contact, and be narrower than the contact
      across = min(scale%across, real(minval(shape%n, mask=shape%n > 0), wp))
      bend = maxval(shape%bend)/result%pmax
      cusp = 0.0_wp
      do k = 1, size(shape)
         if (shape(k)%n > 0) cusp = max(cusp, shape(k)%cusp/result%pmax &
            & - usual_bend*smooth_bend/min(scale%across, real(shape(k)%n, wp))**2)
      end do
      peak = peak_of(result%pn)
      floor = peak_floor*max(1.0_wp/scale%across**2, bend/smooth_bend)
      e = abs(peak - result%pmax + (peak - coarse_peak)/(coarsening**normal_order - 1.0_wp))/result%pmax
      e = trusted(e, floor, merge(peak_trust(2), peak_trust(1), scale%coupling > 0.0_wp)*min(1.0_wp, across/clear_peak)**3)
      floor = max(floor, coupled_floor*scale%coupling/scale%across**2)
      if (scale%across < resolved) floor = floor + unresolved_floor/scale%across**2
      e = max(e, floor, unresolved*cusp, hidden_edge*maxval(shape%step), &
         & rough_peak*max(0.0_wp, scale%roughness - usual_roughness)*scale%across)
      e = max(e, hidden_peak(result%pn)/result%pmax - 1.0_wp)
      e = (e + result%errors%stopping(1) + result%errors%window)*result%pmax
   end function error_of_peak

   !> Largest peak pressure that lower peaks of few elements may have, by their load; at least the highest one [N/mm2]
   pure real(wp) function hidden_peak(pn) result(peak)
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: pn(:, :)
      real(wp) :: highest, least
      integer :: ix, iy, x0, x1, y0, y1

      highest = maxval(pn)
      peak = highest
      ! the load of a single element gives a peak that is higher by the inverse of this ratio
      least = highest*(1.0_wp - narrower)*pi/4.0_wp
      do iy = 1, size(pn, 2)
         y0 = max(1, iy - 1)
         y1 = min(size(pn, 2), iy + 1)
         do ix = 1, size(pn, 1)
            if (pn(ix, iy) < least .or. pn(ix, iy) >= highest) cycle
            x0 = max(1, ix - 1)
            x1 = min(size(pn, 1), ix + 1)
            if (any(pn(x0:x1, y0:y1) > pn(ix, iy))) cycle
            peak = max(peak, by_load(shape_of(pn(:, iy), ix)), by_load(shape_of(pn(ix, :), iy)))
         end do
      end do
   end function hidden_peak

   !> Peak of a semi-ellipse with the load of a few elements; 0 for more elements [N/mm2]
   elemental real(wp) function by_load(shape) result(peak)
      type(peak_shape), intent(in) :: shape

      peak = 0.0_wp
      if (shape%n > 0 .and. shape%n < resolved) peak = 4.0_wp*shape%load/(pi*(shape%n - narrower))
   end function by_load

   !> Shape of a peak along a line; without elements if the line represents a field that is constant in its direction
   pure type(peak_shape) function shape_of(line, i) result(shape)
      !> Pressures [N/mm2], zero before the first and after the last one
      real(wp), intent(in) :: line(:)
      !> Place of the peak
      integer, intent(in) :: i
      real(wp) :: decrease(2)
      integer :: first, last

      if (size(line) < 3) return
      first = i
      do while (first > 1)
         if (.not. line(first - 1) > 0.0_wp) exit
         first = first - 1
      end do
      last = i
      do while (last < size(line))
         if (.not. line(last + 1) > 0.0_wp) exit
         last = last + 1
      end do
      shape%n = last - first + 1
      shape%load = sum(line(first:last))
      decrease = line(i)
      if (i > 1) decrease(1) = line(i) - line(i - 1)
      if (i < size(line)) decrease(2) = line(i) - line(i + 1)
      shape%bend = sum(decrease)
      if (minval(decrease) > 0.0_wp) shape%cusp = 4.0_wp*product(decrease)/sum(decrease)
      ! where the grid cuts off the contact there is no edge
      if (first > 1) shape%step = excess_at_edge(line(first)/line(i), i - first)
      if (last < size(line)) shape%step = max(shape%step, excess_at_edge(line(last)/line(i), last - i))
   end function shape_of

   !> Excess of the pressure of the outermost element in contact above the largest one of a semi-ellipse with the same peak, both
   !> relative to the peak [-]; 0 if the peak is in this element or far from it
   pure real(wp) function excess_at_edge(pressure, distance) result(excess)
      !> Pressure over that of the peak [-]
      real(wp), intent(in) :: pressure
      !> Number of elements from the edge to the peak
      integer, intent(in) :: distance

      excess = 0.0_wp
      if (distance < 1 .or. 2*distance >= resolved) return
      ! the centre of the outermost element is at most one element inside the contact, that of the peak one more for each
      excess = max(0.0_wp, pressure - sqrt(1.0_wp - (distance/(distance + 1.0_wp))**2))
   end function excess_at_edge
end module contact_patch_peak_errors
