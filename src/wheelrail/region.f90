!> One region of contact between wheel and rail: reference, weight and bounds of a stretch of interpenetration
!>
!> The reference is the mean of position and surface angle, weighted with a power of the interpenetration.
module contact_wheelrail_region
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_wheelrail_gap, only : gap_curve
   implicit none (type, external)
   private

   public :: contact_region, region_box, far_away
   public :: describe, describe_miss, describe_small, find_deepest, parts_of, seeds_of

   !> Bounds in track coordinates [mm]
   type :: region_box
      real(wp) :: x(2) = 0.0_wp, y(2) = 0.0_wp, z(2) = 0.0_wp
   end type region_box

   !> A contact region, or a near miss
   type :: contact_region
      type(region_box) :: box
      !> Reference: position [mm] in track coordinates and surface angle [rad]
      real(wp) :: x = 0.0_wp, y = 0.0_wp, alpha = 0.0_wp
      !> Reference in x and y that this region has in common with a neighbour [mm], and the share to which its lattice of elements
      !> is the common one, 0...1: see `draw_lattices`
      real(wp) :: common(2) = 0.0_wp, share = 0.0_wp
      !> The same as the reference at the deepest point
      real(wp) :: deepest(3) = 0.0_wp
      !> Is the reference the deepest point of a parabola through three points of the mesh, not a mean?
      logical :: by_parabola = .false.
      !> Sum of weights
      real(wp) :: weight = 0.0_wp
      !> Smallest gap [mm], negative for interpenetration
      real(wp) :: gap = 0.0_wp
      !> Lateral position of the deepest point of a single stretch of interpenetration [mm]
      real(wp) :: seed = 0.0_wp
      !> Lateral positions of the deepest points of several joined stretches; unallocated for a single one, see `seeds_of`
      real(wp), allocatable :: seeds(:)
      !> Beginning of the overlap of other regions, in x and y, in track coordinates [mm]: grids are not extended beyond it
      real(wp) :: others_x(2) = [-huge(1.0_wp), huge(1.0_wp)], others_y(2) = [-huge(1.0_wp), huge(1.0_wp)]
      !> Middle between this region and its neighbours along the track, x, and across it, y and z, in track coordinates [mm]: the
      !> overlap beyond it belongs to these. Shape (2), (coordinate, side)
      real(wp) :: middle_x(2) = [-huge(1.0_wp), huge(1.0_wp)]
      real(wp) :: middle_yz(2, 2) = reshape([-huge(1.0_wp), 0.0_wp, huge(1.0_wp), 0.0_wp], [2, 2])
      !> Do the bodies interpenetrate?
      logical :: touches = .false.
      !> Parts of a blended patch with their bounds; unallocated for other patches, see `parts_of`
      type(region_box), allocatable :: part(:)
      !> Interaction factors of the pressures of the parts, 0...1, shape (parts, parts); allocated with the parts
      real(wp), allocatable :: interaction(:, :)
   end type contact_region

   !> Gaps above this value are ignored in the search [mm]
   real(wp), parameter :: far_away = 777.0_wp
   !> Minimum weight of a mesh point; below that of the smallest contact, as points of equal weight shift its reference
   real(wp), parameter :: min_weight = 1.0e-60_wp
   !> Minimum gap of a near miss [mm]: interpolation between mesh points does not make it a contact
   real(wp), parameter :: open_gap = 1.0e-10_wp

contains

   !> Reference, weight and bounds of a stretch of interpenetration
   pure subroutine describe(gap, g, first, last, weight_power, region)
      !> Mesh, and the table for bodies that vary
      type(gap_curve), intent(in) :: gap
      !> Gap at the present height [mm], shape (n)
      real(wp), intent(in) :: g(:)
      !> First and last point with g < 0
      integer, intent(in) :: first, last
      !> Power of the interpenetration in the weights, 1 or 2
      integer, intent(in) :: weight_power
      !> Bounds, reference, weight, and deepest point are set
      type(contact_region), intent(out) :: region
      real(wp) :: w, x, total, extent(2), x_low, x_high
      integer :: i

      region%touches = .true.
      total = 0.0_wp
      x_low = huge(x_low)
      x_high = -huge(x_high)
      do i = first, last
         if (allocated(gap%table)) then
            call weigh_table(gap%x_table, gap%table(:, i) + (g(i) - gap%gap(i)), gap%x(i), weight_power, w, x, extent)
         else
            call weigh_parabola(gap, i, -g(i), weight_power, w, x, extent)
         end if
         w = max(min_weight, w)
         total = total + w
         region%x = region%x + w*x
         region%y = region%y + w*gap%y(i)
         region%alpha = region%alpha + w*gap%alpha(i)
         x_low = min(x_low, extent(1))
         x_high = max(x_high, extent(2))
      end do
      region%x = region%x/total
      region%y = region%y/total
      region%alpha = region%alpha/total
      region%weight = total*gap%dy
      region%box%x = [x_low, x_high]
      region%box%y(1) = zero_crossing(gap, g, first, first - 1)
      region%box%y(2) = zero_crossing(gap, g, last, last + 1)
      region%box%z(1) = height_at(gap, region%box%y(1), first)
      region%box%z(2) = height_at(gap, region%box%y(2), last)
      ! if a patch reaches the end of the profile, its bounds are made symmetric about the reference
      if (first == 1) region%box%y(1) = 2.0_wp*region%y - region%box%y(2)
      if (last == gap%n) region%box%y(2) = 2.0_wp*region%y - region%box%y(1)
      call find_deepest(gap, g, first, last, region%gap, region%deepest)
      region%seed = region%deepest(2)
   end subroutine describe

   !> Lateral positions of the deepest points of all stretches of interpenetration in a region [mm]
   pure function seeds_of(region) result(seeds)
      !> Region with one stretch, or several joined ones
      type(contact_region), intent(in) :: region
      real(wp), allocatable :: seeds(:)

      if (allocated(region%seeds)) then
         seeds = region%seeds
      else
         seeds = [region%seed]
      end if
   end function seeds_of

   !> Parts of a region with their bounds; the region itself if it is not blended
   pure function parts_of(region) result(parts)
      !> Blended or not
      type(contact_region), intent(in) :: region
      type(region_box), allocatable :: parts(:)

      if (allocated(region%part)) then
         parts = region%part
      else
         parts = [region%box]
      end if
   end function parts_of

   !> Reference, weight and bounds of a contact that is small compared with the mesh, from the parabola through three points
   !>
   !> A region is not changed if there is no such parabola, or if it is positive everywhere.
   pure subroutine describe_small(gap, g, first, last, weight_power, region)
      !> Mesh and curvature along the track
      type(gap_curve), intent(in) :: gap
      !> Gap at the present height [mm], shape (n)
      real(wp), intent(in) :: g(:)
      !> First and last point with g < 0, or a point with a lower gap than its neighbours
      integer, intent(in) :: first, last
      !> Power of the interpenetration in the weights, 1 or 2
      integer, intent(in) :: weight_power
      !> Region as described by mesh points on entry; updated
      type(contact_region), intent(inout) :: region
      real(wp) :: lowest, place(3), bend, half, w, x, extent(2)
      integer :: i

      i = first - 1 + minloc(g(first:last), dim=1)
      if (i <= 1 .or. i >= gap%n) return
      if (max(g(i - 1), g(i + 1)) > far_away) return
      call find_deepest(gap, g, first, last, lowest, place)
      bend = 0.5_wp*(g(i - 1) - 2.0_wp*g(i) + g(i + 1))/gap%dy**2
      if (.not. (lowest < 0.0_wp .and. bend > 0.0_wp)) return
      half = sqrt(-lowest/bend)
      if (allocated(gap%table)) then
         call weigh_table(gap%x_table, gap%table(:, i) + (lowest - gap%gap(i)), place(1), weight_power, w, x, extent)
      else
         call weigh_parabola(gap, i, -lowest, weight_power, w, x, extent)
         extent = extent + (place(1) - x)
         x = place(1)
      end if
      region%touches = .true.
      region%by_parabola = .true.
      region%x = x
      region%y = place(2)
      region%alpha = place(3)
      region%gap = lowest
      region%deepest = place
      region%seed = place(2)
      ! integral of the weights over all lateral positions: (1 - u**2)**2.5 and (1 - u**2)**1.5 from -1 to 1
      region%weight = max(min_weight, w)*half*merge(5.0_wp/16.0_wp, 3.0_wp/8.0_wp, weight_power == 2)*pi
      region%box%x = extent
      region%box%y = place(2) + [-half, half]
      region%box%z = gap%z(i) + (region%box%y - gap%y(i))*(gap%z(i + 1) - gap%z(i - 1))/(2.0_wp*gap%dy)
   end subroutine describe_small

   !> Weight of the interpenetration along the track at one lateral position, for a round wheel: c - kappa (x - x_locus)**2
   pure subroutine weigh_parabola(gap, i, c, power, weight, x, extent)
      type(gap_curve), intent(in) :: gap
      integer, intent(in) :: i
      !> Maximum interpenetration [mm]
      real(wp), intent(in) :: c
      !> Power of the interpenetration that is integrated, 1 or 2
      integer, intent(in) :: power
      real(wp), intent(out) :: weight
      !> Centre of the interpenetration, and its start and end [mm]
      real(wp), intent(out) :: x, extent(2)
      real(wp) :: t

      t = sqrt(c/gap%kappa)
      if (power == 1) then
         weight = 4.0_wp/3.0_wp*c*t
      else
         weight = 16.0_wp/15.0_wp*c**2*t
      end if
      x = gap%x(i)
      extent = x + [-t, t]
   end subroutine weigh_parabola

   !> The same from a table of gaps along the track, as a sum; ends by linear interpolation
   !>
   !> A stretch with few points of the table is summed at positions in between, too, on curves through four points: otherwise the
   !> centre of a contact as short as the steps of the table would be at one or two points.
   pure subroutine weigh_table(places, g, locus, power, weight, x, extent)
      real(wp), contiguous, intent(in) :: places(:), g(:)
      !> Position of the smallest gap [mm], for a stretch that is too short for the table
      real(wp), intent(in) :: locus
      integer, intent(in) :: power
      real(wp), intent(out) :: weight, x, extent(2)
      !> Number of points of the table below which a stretch is refined, and refinement factor
      integer, parameter :: few = 16, parts = 16
      real(wp) :: moment, step, before, now, depth, place, rise, bend(2)
      integer :: i, k, n, first, last, inside
      logical :: missing

      weight = 0.0_wp
      moment = 0.0_wp
      x = locus
      extent = locus
      inside = count(g < 0.0_wp)
      if (inside == 0) then
         ! the curve may be negative beside the smallest value although that is positive
         first = minloc(g, 1)
         last = first
      else
         first = findloc(g < 0.0_wp, .true., 1)
         last = findloc(g < 0.0_wp, .true., 1, back=.true.)
      end if
      n = 1
      if (inside < few) n = parts
      step = (places(2) - places(1))/n
      first = max(1, first - 1)
      last = min(size(g), last + 1)
      before = g(first)
      do i = first, last
         if (n > 1 .and. i < last) call find_shape(g, i, missing, rise, bend)
         do k = 1, merge(n, 1, i < last)
            place = places(i) + (k - 1)*step
            now = g(i)
            if (k > 1) now = between(g(i), g(i + 1), missing, rise, bend, real(k - 1, wp)/n)
            if (now < 0.0_wp) then
               depth = -now
               if (power > 1) depth = depth**2
               weight = weight + depth*step
               moment = moment + depth*(place - locus)*step
               extent(1) = min(extent(1), place)
               extent(2) = max(extent(2), place)
            end if
            ! position between the last two where the gap vanishes
            if ((now < 0.0_wp .neqv. before < 0.0_wp) .and. max(before, now) <= far_away) then
               place = place - step*now/(now - before)
               extent(1) = min(extent(1), place)
               extent(2) = max(extent(2), place)
            end if
            before = now
         end do
      end do
      if (weight > 0.0_wp) x = locus + moment/weight
   end subroutine weigh_table

   !> Curve between two points of a table: cubic with the slopes of parabolas, straight next to an end
   pure subroutine find_shape(g, i, missing, rise, bend)
      !> Gaps [mm]
      real(wp), intent(in) :: g(:)
      !> Index of the first point
      integer, intent(in) :: i
      !> Is a surface missing at one of the points?
      logical, intent(out) :: missing
      !> Difference of the gaps, and second differences at both points [mm]
      real(wp), intent(out) :: rise, bend(2)

      missing = max(g(i), g(i + 1)) > far_away
      rise = g(i + 1) - g(i)
      bend = 0.0_wp
      if (i > 1) then
         if (g(i - 1) < far_away) bend(1) = g(i - 1) - 2.0_wp*g(i) + g(i + 1)
      end if
      if (i + 2 <= size(g)) then
         if (g(i + 2) < far_away) bend(2) = g(i) - 2.0_wp*g(i + 1) + g(i + 2)
      end if
      if (i == 1) bend(1) = bend(2)
      if (i + 2 > size(g)) bend(2) = bend(1)
   end subroutine find_shape

   !> Gap between two points of a table; next to a missing surface that of the nearer point
   pure real(wp) function between(start, end_, missing, rise, bend, t)
      !> Gaps at both points [mm]
      real(wp), intent(in) :: start, end_
      !> From `find_shape`
      logical, intent(in) :: missing
      real(wp), intent(in) :: rise, bend(2)
      !> Position between the points, 0...1
      real(wp), intent(in) :: t

      if (missing) then
         between = merge(start, end_, t < 0.5_wp)
      else
         between = start + t*rise - 0.5_wp*t*(1.0_wp - t)*((1.0_wp - t)*bend(1) + t*bend(2))
      end if
   end function between

   !> Lateral position where the gap vanishes between a point of overlap and its neighbour outside
   pure real(wp) function zero_crossing(gap, g, inside, outside) result(y)
      type(gap_curve), intent(in) :: gap
      real(wp), intent(in) :: g(:)
      integer, intent(in) :: inside, outside

      if (outside < 1 .or. outside > gap%n) then
         y = gap%y(inside)
      else if (g(outside) > far_away) then
         y = gap%y(outside)
      else
         y = gap%y(inside) + (gap%y(outside) - gap%y(inside))*g(inside)/(g(inside) - g(outside))
      end if
   end function zero_crossing

   !> Height of the rail at a lateral position next to a mesh point
   pure real(wp) function height_at(gap, y, i) result(z)
      type(gap_curve), intent(in) :: gap
      real(wp), intent(in) :: y
      integer, intent(in) :: i
      integer :: j

      j = i
      if (y > gap%y(i)) j = i + 1
      if (y < gap%y(i)) j = i - 1
      z = gap%z(i)
      if (j < 1 .or. j > gap%n .or. j == i) return
      if (gap%gap(j) > far_away) return
      z = gap%z(i) + (gap%z(j) - gap%z(i))*(y - gap%y(i))/(gap%y(j) - gap%y(i))
   end function height_at

   !> Smallest gap of a stretch, between mesh points by a parabola, and its position
   pure subroutine find_deepest(gap, g, first, last, lowest, place)
      !> Mesh and curvature along the track
      type(gap_curve), intent(in) :: gap
      !> Gap at the present height [mm], shape (n)
      real(wp), intent(in) :: g(:)
      !> First and last mesh point of the stretch
      integer, intent(in) :: first, last
      !> The smallest gap, between mesh points by a parabola [mm]
      real(wp), intent(out) :: lowest
      !> Position x, y [mm] and surface angle [rad]
      real(wp), intent(out) :: place(3)
      integer :: i, next
      real(wp) :: bend, shift

      i = first - 1 + minloc(g(first:last), dim=1)
      lowest = g(i)
      place = [gap%x(i), gap%y(i), gap%alpha(i)]
      if (i <= 1 .or. i >= size(g)) return
      if (abs(g(i - 1) - g(i)) > 1.0_wp .or. abs(g(i + 1) - g(i)) > 1.0_wp) return
      bend = g(i - 1) - 2.0_wp*g(i) + g(i + 1)
      if (.not. bend > 0.0_wp) return
      shift = 0.5_wp*(g(i - 1) - g(i + 1))/bend
      lowest = g(i) - 0.5_wp*bend*shift**2
      next = i + merge(1, -1, shift > 0.0_wp)
      place = place + abs(shift)*([gap%x(next), gap%y(next), gap%alpha(next)] - place)
   end subroutine find_deepest

   !> A position where the bodies nearly touch
   pure subroutine describe_miss(gap, g, i, region)
      !> Mesh, with heights and inclinations of the rail
      type(gap_curve), intent(in) :: gap
      !> Gap at the present height [mm], shape (n)
      real(wp), intent(in) :: g(:)
      !> Mesh point with a lower gap than its neighbours
      integer, intent(in) :: i
      !> Reference at this point, and minimum weight
      type(contact_region), intent(out) :: region

      region%x = gap%x(i)
      region%y = gap%y(i)
      region%alpha = gap%alpha(i)
      region%weight = min_weight
      call find_deepest(gap, g, i, i, region%gap, region%deepest)
      region%gap = max(open_gap, region%gap)
      region%seed = region%y
      region%box%x = gap%x(i)
      region%box%y = gap%y(i)
      region%box%z = gap%z(i)
   end subroutine describe_miss
end module contact_wheelrail_region
