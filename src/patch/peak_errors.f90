!> Error of the largest pressure of a patch, estimated from the shape of the peak and from the peak on elements three times as long
!>
!> See doc/theory/errors.md.
module contact_patch_peak_errors
   use contact_base_constants, only : excluded_threshold, pi
   use contact_base_kinds, only : wp
   use contact_numeric_vectors, only : largest_of
   use contact_patch_between_rows, only : section_details
   use contact_patch_coarse_level, only : coarsening
   use contact_patch_error_kinds, only : trusted
   use contact_patch_error_scales, only : normal_order, resolved, scale_type
   use contact_patch_peak, only : peak_at, peak_of, place_of
   use contact_patch_problem, only : patch_problem
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: error_of_peak, is_peak_cut_off

   !> Lower bound times n^-2, half the rms over offsets of a Hertzian peak with as many elements in both directions; its second
   !> difference over an element is 4 n^-2 of the peak
   real(wp), parameter :: peak_floor = 0.15_wp, smooth_bend = 4.0_wp
   !> Tractions of unlike bodies increase pressures within regions that elements do not resolve: factor of the difference parameter
   !> K times n^-2; of the hard cases
   real(wp), parameter :: coupled_floor = 4.0_wp
   !> Where tractions of unlike bodies bend at the peak, pressures rise within elements: factor of K times the bend
   real(wp), parameter :: coupled_bend = 1.0_wp/pi
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
   !> Rough surfaces have peaks between element centres: factor of the standard deviation of heights over the approach, in excess of
   !> that of single jumps of the curvature, times n; of rough profiles of hard wheels (seed 611)
   real(wp), parameter :: rough_peak = 0.6_wp, usual_roughness = 0.02_wp
   !> A strip of n elements is between n - 1 and n + 1 elements wide. For the error of its peak, and for the largest peak that its
   !> load may have, its width is taken as n less this; chosen
   real(wp), parameter :: narrower = 0.5_wp
   !> The pressure of an ellipse of semi-axes a > b exceeds that of a strip with the same curvature and load per length across b by
   !> this fraction of b/a, in squares: Hertz's theory gives 4/pi for a circle
   real(wp), parameter :: excess_of_circle = 4.0_wp/pi - 1.0_wp

   !> Shape of a peak along a line of elements through it
   type :: peak_shape
      !> Number of elements in contact without a gap, the first and the last one, and their sum of pressures [N/mm2]
      integer :: n = 0, first = 0, last = 0
      real(wp) :: load = 0.0_wp
      !> Second difference at the peak, of 6 and more elements the larger one of both elements beside it, and that at the peak with
      !> the harmonic mean of the decreases on both sides [N/mm2]
      real(wp) :: bend = 0.0_wp, cusp = 0.0_wp
   end type peak_shape

contains

   !> Error of the largest pressure: the error of pressures, with order 1 the difference between the peak and the nearest element
   !> centre, and the height of lower peaks that elements do not resolve
   pure real(wp) function error_of_peak(problem, result, scale, coarse_peak, details) result(e)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem
      !> Solved patch, with the contributions of solvers and window
      type(patch_result), intent(in) :: result
      !> See type scale_type
      type(scale_type), intent(in) :: scale
      !> Peak of the pressures of the coarse level [N/mm2]
      real(wp), intent(in) :: coarse_peak
      !> Pressures with the details between rows of elements; absent if the distance is known at the elements only
      type(section_details), intent(in), optional :: details
      type(peak_shape) :: shape(2)
      real(wp) :: peak, floor, across, bend, cusp
      integer :: at(2), k

      at = place_of(result%pn, largest_of(size(result%pn), result%pn))
      shape = [shape_of(result%pn(:, at(2)), at(1)), shape_of(result%pn(at(1), :), at(2))]
      ! the peak may belong to a part of the contact, and be narrower than the contact
      across = min(scale%across, real(minval(shape%n, mask=shape%n > 0), wp))
      ! deviations along both directions are independent
      bend = norm2(shape%bend)/sqrt(real(max(1, count(shape%n > 0)), wp))/result%pmax
      cusp = 0.0_wp
      do k = 1, size(shape)
         if (shape(k)%n > 0) cusp = max(cusp, shape(k)%cusp/result%pmax &
            & - usual_bend*smooth_bend/min(scale%across, real(shape(k)%n, wp))**2)
      end do
      peak = peak_of(result%pn)
      floor = peak_floor*max(hypot(1.0_wp/(scale%across - narrower)**2, &
         & 1.0_wp/(scale%mean_across**2/scale%across - narrower)**2)/sqrt(2.0_wp), bend/smooth_bend)
      e = abs(peak - result%pmax + (peak - coarse_peak)/(coarsening**normal_order - 1.0_wp))/result%pmax
      e = trusted(e, floor, merge(peak_trust(2), peak_trust(1), scale%coupling > 0.0_wp)*min(1.0_wp, across/clear_peak)**3)
      if (scale%coupling > 0.0_wp) floor = max(floor, coupled_floor*scale%coupling/scale%across**2, &
         & coupled_bend*scale%coupling*bend_of_tractions(result, at)/result%pmax)
      e = max(e, floor, unresolved*cusp, hidden_peak(problem, result)/result%pmax - 1.0_wp)
      if (scale%roughness > usual_roughness) e = max(e, rough_peak*(scale%roughness - usual_roughness)*scale%across &
         & *part_of_noise(problem%h, result%pn))
      if (present(details)) then
         if (details%known) e = max(e, abs(details%peak/result%pmax - 1.0_wp))
      end if
      e = (e + result%errors%stopping(1) + result%errors%window)*result%pmax
   end function error_of_peak

   !> Is the largest pressure next to a prescribed edge, of the grid or of the planform, where the exact one has no bound?
   pure logical function is_peak_cut_off(problem, result) result(cut)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem
      !> Solved patch
      type(patch_result), intent(in) :: result
      integer :: at(2), next(2), k, side

      cut = .false.
      ! pressures by formula are bounded everywhere
      if (allocated(problem%given_pressure)) return
      at = place_of(result%pn, largest_of(size(result%pn), result%pn))
      do k = 1, 2
         ! no edges across a line contact
         if (size(result%pn, k) == 1) cycle
         do side = -1, 1, 2
            next = at
            next(k) = at(k) + side
            if (next(k) < 1 .or. next(k) > size(result%pn, k)) then
               cut = .true.
            else if (problem%h(next(1), next(2)) > excluded_threshold) then
               cut = .true.
            end if
         end do
      end do
   end function is_peak_cut_off

   !> Is the roughness noise? 1 for heights of no relation, 0 for waves of four elements and more and for curvature that jumps
   !>
   !> Third differences of white noise have the correlation -15/20 with those at the next element, those of waves of length l the
   !> cosine of 2 pi/l, and those of a jump of the curvature 0.3 to 0.5.
   pure real(wp) function part_of_noise(h, pn) result(part)
      !> Undeformed distance [mm] and pressures [N/mm2]
      real(wp), intent(in) :: h(:, :), pn(:, :)
      real(wp), parameter :: of_noise = -15.0_wp/20.0_wp
      real(wp) :: sums(2)
      integer :: ix, iy

      sums = 0.0_wp
      do iy = 1, size(h, 2)
         do ix = 1, size(h, 1)
            if (.not. pn(ix, iy) > 0.0_wp) cycle
            if (ix <= size(h, 1) - 4) sums = sums + products(h(ix:ix + 4, iy))
            if (iy <= size(h, 2) - 4) sums = sums + products(h(ix, iy:iy + 4))
         end do
      end do
      part = 0.0_wp
      if (sums(1) > 0.0_wp) part = min(1.0_wp, max(0.0_wp, sums(2)/(of_noise*sums(1))))
   end function part_of_noise

   !> Square of a third difference, and its product with the next one [mm2]; zero where a value is missing
   pure function products(line)
      !> Undeformed distance of neighbours along a line [mm]
      real(wp), intent(in) :: line(5)
      real(wp) :: products(2)
      real(wp) :: first

      products = 0.0_wp
      if (maxval(line) > excluded_threshold) return
      first = line(4) - 3.0_wp*(line(3) - line(2)) - line(1)
      products = first*[first, line(5) - 3.0_wp*(line(4) - line(3)) - line(2)]
   end function products

   !> Largest second differences of the tractions along their own direction, at an element and next to it: sum of both directions
   !> [N/mm2]
   pure real(wp) function bend_of_tractions(result, at) result(bend)
      type(patch_result), intent(in) :: result
      !> Column and row of the element
      integer, intent(in) :: at(2)
      real(wp) :: along, across
      integer :: ix, iy

      along = 0.0_wp
      across = 0.0_wp
      associate (px => result%px, py => result%py, mx => size(result%pn, 1), my => size(result%pn, 2))
         do iy = max(1, at(2) - 1), min(my, at(2) + 1)
            do ix = max(1, at(1) - 1), min(mx, at(1) + 1)
               if (ix > 1 .and. ix < mx) along = max(along, abs(px(ix - 1, iy) - 2.0_wp*px(ix, iy) + px(ix + 1, iy)))
               if (iy > 1 .and. iy < my) across = max(across, abs(py(ix, iy - 1) - 2.0_wp*py(ix, iy) + py(ix, iy + 1)))
            end do
         end do
      end associate
      bend = along + across
   end function bend_of_tractions

   !> Largest pressure that peaks of few elements may have by their load, and by their load and the curvature of the undeformed
   !> distance; at least the highest one of the elements [N/mm2]
   pure real(wp) function hidden_peak(problem, result) result(peak)
      type(patch_problem), intent(in) :: problem
      type(patch_result), intent(in) :: result
      type(peak_shape) :: shape(2)
      real(wp) :: highest, least, extent(2)
      integer :: ix, iy, x0, x1, y0, y1

      associate (pn => result%pn, modulus => problem%model%material%gg/(1.0_wp - problem%model%material%nu))
         highest = largest_of(size(pn), pn)
         peak = highest
         ! the load of a single element gives a peak that is higher by the inverse of this ratio
         least = highest*(1.0_wp - narrower)*pi/4.0_wp
         do iy = 1, size(pn, 2)
            y0 = max(1, iy - 1)
            y1 = min(size(pn, 2), iy + 1)
            do ix = 1, size(pn, 1)
               if (pn(ix, iy) < least) cycle
               x0 = max(1, ix - 1)
               x1 = min(size(pn, 1), ix + 1)
               ! most elements are lower than one of their row
               if (max(pn(x0, iy), pn(x1, iy)) > pn(ix, iy)) cycle
               if (any(pn(x0:x1, y0:y1) > pn(ix, iy))) cycle
               shape = [shape_of(pn(:, iy), ix), shape_of(pn(ix, :), iy)]
               ! a lower peak has errors, too, and may be the highest one
               if (pn(ix, iy) < highest) peak = max(peak, maxval(by_load(shape)), by_shape(pn, [ix, iy], shape))
               extent = shape%n*[result%grid%dx, result%grid%dy]
               ! fields that are constant in one direction are strips
               where (shape%n == 0) extent = sqrt(huge(highest))
               peak = max(peak, &
                  & by_curvature(pn(:, iy), problem%h(:, iy), shape(1), ix, result%grid%dx, extent(1)/extent(2), modulus), &
                  & by_curvature(pn(ix, :), problem%h(ix, :), shape(2), iy, result%grid%dy, extent(2)/extent(1), modulus))
            end do
         end do
      end associate
   end function hidden_peak

   !> Peak of few elements, or within few elements of an edge of the contact, by Hertz's theory: from the load of these elements and
   !> the largest curvature of the undeformed distance there; 0 for other peaks [N/mm2]
   !>
   !> A strip of contact of load q per length, in which the distance has the curvature k, has the peak sqrt(q E k/pi), with the
   !> modulus E of both bodies. At an edge, beyond which the curvature decreases, the elements up to the peak are such a strip.
   pure real(wp) function by_curvature(line, h, shape, i, side, ratio, modulus) result(peak)
      !> Pressures [N/mm2] and undeformed distances [mm] of elements along a line
      real(wp), intent(in) :: line(:), h(:)
      !> Shape of the peak
      type(peak_shape), intent(in) :: shape
      !> Element of the peak
      integer, intent(in) :: i
      !> Side of the elements along the line [mm]; ratio of the extent of contact along the line to that across [-]; modulus of both
      !> bodies, see above [N/mm2]
      real(wp), intent(in) :: side, ratio, modulus

      peak = 0.0_wp
      if (shape%n == 0) return
      if (2*shape%n < resolved) then
         peak = of_strip(shape%first, shape%last)
         return
      end if
      ! all of few elements are next to an edge, without a flatter part
      if (shape%n < resolved) return
      ! where the grid cuts off the contact there is no edge
      if (shape%first > 1 .and. 2*(i - shape%first) < resolved) peak = of_strip(shape%first, i)
      if (shape%last < size(line) .and. 2*(shape%last - i) < resolved) peak = max(peak, of_strip(i, shape%last))
      ! contact continues on the other side: the peak is between that of the element and that of a strip
      peak = 0.5_wp*(line(i) + peak)

   contains

      !> Peak of a strip of the given elements [N/mm2]
      pure real(wp) function of_strip(first, last)
         integer, intent(in) :: first, last
         real(wp) :: curvature
         integer :: k

         curvature = 0.0_wp
         do k = max(2, first), min(size(h) - 1, last)
            if (maxval(h(k - 1:k + 1)) > excluded_threshold) cycle
            curvature = max(curvature, (h(k - 1) - 2.0_wp*h(k) + h(k + 1))/side**2)
         end do
         of_strip = sqrt(sum(line(first:last))*side*modulus*curvature/pi*(1.0_wp + excess_of_circle*min(1.0_wp, ratio)))
      end function of_strip
   end function by_curvature

   !> Peak of a semi-ellipse with the load of a few elements; 0 for more elements [N/mm2]
   elemental real(wp) function by_load(shape) result(peak)
      type(peak_shape), intent(in) :: shape

      peak = 0.0_wp
      if (shape%n > 0 .and. shape%n < resolved) peak = 4.0_wp*shape%load/(pi*(shape%n - narrower))
   end function by_load

   !> Largest pressure that a lower peak may have by the general error of a peak of that many elements; of 6 and more elements along
   !> both directions also by its parabolas and second differences [N/mm2]
   pure real(wp) function by_shape(pn, at, shape) result(peak)
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), intent(in) :: pn(:, :)
      !> Column and row of the peak
      integer, intent(in) :: at(2)
      !> Its shape along both directions
      type(peak_shape), intent(in) :: shape(2)

      peak = pn(at(1), at(2))*(1.0_wp + peak_floor*max(0.0_wp, maxval(1.0_wp/max(1, shape%n)**2, mask=shape%n > 0)))
      if (all(shape%n == 0 .or. shape%n >= resolved)) &
         & peak = max(peak, peak_at(pn, at)*(1.0_wp + peak_floor*maxval(shape%bend)/(smooth_bend*pn(at(1), at(2)))))
   end function by_shape

   !> Shape of a peak along a line; without elements if the line represents a field that is constant in its direction
   pure type(peak_shape) function shape_of(line, i) result(shape)
      !> Pressures [N/mm2], zero before the first and after the last one
      real(wp), intent(in) :: line(:)
      !> Position of the peak
      integer, intent(in) :: i
      real(wp) :: decrease(2)
      integer :: first, last, next

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
      shape%first = first
      shape%last = last
      shape%load = sum(line(first:last))
      decrease = line(i)
      if (i > 1) decrease(1) = line(i) - line(i - 1)
      if (i < size(line)) decrease(2) = line(i) - line(i + 1)
      shape%bend = sum(decrease)
      if (shape%n >= resolved) then
         ! with another position of the elements the peak may bend as much as at the other element next to it
         next = merge(i - 1, i + 1, decrease(1) < decrease(2))
         if (next >= first .and. next <= last .and. next > 1 .and. next < size(line)) &
            & shape%bend = max(shape%bend, 2.0_wp*line(next) - line(next - 1) - line(next + 1))
      end if
      if (minval(decrease) > 0.0_wp) shape%cusp = 4.0_wp*product(decrease)/sum(decrease)
   end function shape_of
end module contact_patch_peak_errors
