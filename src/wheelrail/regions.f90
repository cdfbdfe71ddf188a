!> From the gap between wheel and rail to contact patches
!>
!> Every stretch where the bodies interpenetrate becomes a region with a reference: the mean of position
!> and surface angle, weighted by the square of the interpenetration (contact model of a wheel that is
!> round along the track). Regions close to each other are joined: combined to one patch, blended to one
!> patch with several parts, or turned towards a common angle. Instead of the mean, the deepest point of a region
!> and the surface angle there can be its reference.
module contact_wheelrail_regions
   use contact_base_choices, only : contact_location
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_wheelrail_gap, only : gap_curve, no_surface
   use contact_wheelrail_spec, only : search_spec
   use contact_wheelrail_spots, only : separate_spots, spot
   implicit none (type, external)
   private

   public :: contact_region, region_box, find_regions, smallest_gap

   !> Bounds in track coordinates [mm]
   type :: region_box
      real(wp) :: x(2) = 0.0_wp, y(2) = 0.0_wp, z(2) = 0.0_wp
   end type region_box

   !> One contact problem, or a near miss
   type :: contact_region
      type(region_box) :: box
      !> Reference: position [mm] in track coordinates and surface angle [rad]
      real(wp) :: x = 0.0_wp, y = 0.0_wp, alpha = 0.0_wp
      !> The same at the deepest point
      real(wp) :: deepest(3) = 0.0_wp
      !> Sum of weights
      real(wp) :: weight = 0.0_wp
      !> Smallest gap [mm], negative for interpenetration
      real(wp) :: gap = 0.0_wp
      !> Lateral positions of the deepest points of the stretches of interpenetration that it was joined of [mm]
      real(wp), allocatable :: seeds(:)
      !> Where the overlap of other regions begins, x and y in track coordinates [mm]: a grid does not grow beyond it
      real(wp) :: others_x(2) = [-huge(1.0_wp), huge(1.0_wp)], others_y(2) = [-huge(1.0_wp), huge(1.0_wp)]
      !> Do the bodies interpenetrate?
      logical :: touches = .false.
      !> Parts of a blended patch with their bounds; of size 1 otherwise
      type(region_box), allocatable :: part(:)
      !> How much pressures of one part act on another, 0...1, shape (parts, parts)
      real(wp), allocatable :: interaction(:, :)
   end type contact_region

   !> Gaps beyond this value do not take part in the search [mm]
   real(wp), parameter :: far_away = 777.0_wp
   !> Least weight of a mesh point; below that of the lightest contact, as points that weigh alike move its reference
   real(wp), parameter :: min_weight = 1.0e-60_wp
   !> A contact of so few mesh points is described by the parabola through the gap around its deepest point
   integer, parameter :: few_points = 4
   !> Exponent of the decrease of interaction with the distance of blended parts
   real(wp), parameter :: blend_exponent = 0.8_wp
   !> Angles nearer than this to a vertical plane are moved away from it [rad]
   real(wp), parameter :: upright = 1.0e-3_wp
   !> Near misses that are kept
   integer, parameter :: max_misses = 2

   !> Least gap of a near miss [mm]: interpolation between mesh points does not make a contact of it
   real(wp), parameter :: open_gap = 1.0e-10_wp

contains

   !> Smallest gap, at mesh points and between them [mm]
   pure recursive real(wp) function smallest_gap(gap, closer) result(smallest)
      !> Gaps at the mesh points, and where the table was looked at
      type(gap_curve), intent(in) :: gap
      !> Smallest gaps that need a finer mesh, see `measure_gap`
      type(gap_curve), intent(in), optional :: closer(:)
      real(wp) :: lowest, place(3)
      integer :: i, k

      smallest = no_surface
      if (gap%n > 0) smallest = minval(gap%gap)
      do i = 2, gap%n - 1
         if (gap%gap(i) > far_away .or. gap%gap(i) > gap%gap(i - 1) .or. gap%gap(i) > gap%gap(i + 1)) cycle
         k = 0
         if (present(closer)) k = findloc(closer%shows, i, dim=1)
         if (k > 0) then
            lowest = smallest_gap(closer(k))
         else
            call find_deepest(gap, gap%gap, i, i, lowest, place)
         end if
         smallest = min(smallest, lowest)
      end do
   end function smallest_gap

   !> Patches for a wheel that is lower by dz than where the gap was measured, field side first
   subroutine find_regions(gap, dz, search, weight_power, regions, misses, closer)
      !> Mesh, gaps, and the table of bodies that vary
      type(gap_curve), intent(in) :: gap
      !> [mm]
      real(wp), intent(in) :: dz
      !> Distances and angles at which regions are joined or separated
      type(search_spec), intent(in) :: search
      !> Weights by the square (2) or the first power (1) of the interpenetration
      integer, intent(in) :: weight_power
      !> One per patch
      type(contact_region), allocatable, intent(out) :: regions(:)
      !> Near misses by rising gap
      type(contact_region), allocatable, intent(out) :: misses(:)
      !> Smallest gaps that need a finer mesh, see `measure_gap`
      type(gap_curve), intent(in), optional :: closer(:)
      real(wp), allocatable :: g(:)

      g = gap%gap - dz
      where (gap%gap > far_away) g = no_surface
      call preliminary_regions(gap, g, weight_power, regions, misses, closer)
      call sort_regions(regions)
      call join_regions(search, regions)
      call shift_near_misses(search, misses, regions)
      if (search%location == contact_location%first_contact) then
         call refer_to_deepest(regions)
      else
         call turn_regions(search, regions)
      end if
      call avoid_vertical(regions)
      call leave_room(regions)
   end subroutine find_regions

   !> Tell every region where others begin: overlap that belongs to two patches would carry its load twice
   pure subroutine leave_room(regions)
      type(contact_region), intent(inout) :: regions(:)
      integer :: i, j

      do i = 1, size(regions)
         do j = 1, size(regions)
            if (i == j) cycle
            associate (me => regions(i), other => regions(j)%box)
               if (side_by_side(me%box, other)) then
                  if (other%x(1) > me%x) me%others_x(2) = min(me%others_x(2), other%x(1))
                  if (other%x(2) < me%x) me%others_x(1) = max(me%others_x(1), other%x(2))
               else
                  if (other%y(1) > me%y) me%others_y(2) = min(me%others_y(2), other%y(1))
                  if (other%y(2) < me%y) me%others_y(1) = max(me%others_y(1), other%y(2))
               end if
            end associate
         end do
      end do
   end subroutine leave_room

   !> One region per stretch of interpenetration, or per spot where it falls apart along the track; the nearest misses
   recursive subroutine preliminary_regions(gap, g, weight_power, regions, misses, closer)
      type(gap_curve), intent(in) :: gap
      !> Gap at the present height [mm]
      real(wp), intent(in) :: g(:)
      integer, intent(in) :: weight_power
      type(contact_region), allocatable, intent(out) :: regions(:), misses(:)
      !> Smallest gaps that need a finer mesh
      type(gap_curve), intent(in), optional :: closer(:)
      type(contact_region) :: region
      type(spot), allocatable :: spots(:)
      integer :: i, k, first, last, n
      logical :: found

      n = size(g)
      allocate(regions(0), misses(0))
      i = 1
      do while (i <= n)
         if (g(i) < 0.0_wp) then
            first = i
            last = i
            do while (last < n)
               if (.not. g(last + 1) < 0.0_wp) exit
               last = last + 1
            end do
            allocate(spots(0))
            if (allocated(gap%table)) call separate_spots(gap, g, first, last, spots)
            found = .false.
            if (last - first < few_points) call look_closer(gap, g, first, last, weight_power, regions, misses, found, closer)
            if (size(spots) == 0 .and. .not. found) then
               call describe(gap, g, first, last, weight_power, region)
               if (last - first < few_points) call describe_small(gap, g, first, last, weight_power, region)
               regions = [regions, region]
            end if
            do k = 1, size(spots)
               call describe(spots(k)%gap, spots(k)%g, spots(k)%first, spots(k)%last, weight_power, region)
               regions = [regions, region]
            end do
            deallocate(spots)
            i = last + 1
         else
            if (is_minimum(g, i)) then
               call look_closer(gap, g, i, i, weight_power, regions, misses, found, closer)
               if (.not. found) then
                  call describe_miss(gap, g, i, region)
                  call describe_small(gap, g, i, i, weight_power, region)
                  if (region%touches) then
                     regions = [regions, region]
                  else
                     call keep_miss(region, misses)
                  end if
               end if
            end if
            i = i + 1
         end if
      end do
   end subroutine preliminary_regions

   !> What a finer mesh shows between two points of this one, where there is one
   recursive subroutine look_closer(gap, g, first, last, weight_power, regions, misses, found, closer)
      type(gap_curve), intent(in) :: gap
      !> Gap at the present height [mm]
      real(wp), intent(in) :: g(:)
      !> The points with g < 0, or a point with a lower gap than its neighbours
      integer, intent(in) :: first, last
      integer, intent(in) :: weight_power
      !> Those of the finer mesh are added
      type(contact_region), allocatable, intent(inout) :: regions(:), misses(:)
      !> Is there a finer mesh?
      logical, intent(out) :: found
      type(gap_curve), intent(in), optional :: closer(:)
      type(contact_region), allocatable :: here(:), nearly(:)
      real(wp), allocatable :: fine(:)
      integer :: i, k

      found = .false.
      i = first - 1 + minloc(g(first:last), dim=1)
      if (first == 1 .or. last == gap%n .or. .not. is_shown(i, closer)) return
      found = .true.
      associate (near => closer(findloc(closer%shows, i, dim=1)))
         fine = near%gap + (g(i) - gap%gap(i))
         where (near%gap > far_away .or. near%y < gap%y(first - 1) - 0.5_wp*near%dy &
            & .or. near%y > gap%y(last + 1) + 0.5_wp*near%dy) fine = no_surface
         call preliminary_regions(near, fine, weight_power, here, nearly)
      end associate
      regions = [regions, here]
      do k = 1, size(nearly)
         call keep_miss(nearly(k), misses)
      end do
   end subroutine look_closer

   !> Are the surroundings of a mesh point shown on a finer mesh?
   pure logical function is_shown(i, closer)
      integer, intent(in) :: i
      type(gap_curve), intent(in), optional :: closer(:)

      is_shown = .false.
      if (present(closer)) is_shown = any(closer%shows == i)
   end function is_shown

   !> Is the gap lower here than on both sides?
   pure logical function is_minimum(g, i)
      real(wp), intent(in) :: g(:)
      integer, intent(in) :: i

      is_minimum = .false.
      if (i <= 1 .or. i >= size(g) .or. g(i) > far_away) return
      is_minimum = g(i) <= g(i - 1) .and. g(i) < g(i + 1) .and. g(i - 1) >= 0.0_wp .and. g(i + 1) >= 0.0_wp
   end function is_minimum

   !> Keep the nearest ones, by rising gap
   subroutine keep_miss(region, misses)
      type(contact_region), intent(in) :: region
      type(contact_region), allocatable, intent(inout) :: misses(:)
      integer :: place

      place = count(misses%gap <= region%gap) + 1
      if (place > max_misses) return
      misses = [misses(:place - 1), region, misses(place:)]
      if (size(misses) > max_misses) misses = misses(:max_misses)
   end subroutine keep_miss

   !> Reference, weight and bounds of a stretch of interpenetration
   pure subroutine describe(gap, g, first, last, weight_power, region)
      type(gap_curve), intent(in) :: gap
      real(wp), intent(in) :: g(:)
      !> The points with g < 0
      integer, intent(in) :: first, last
      integer, intent(in) :: weight_power
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
      ! a patch that reaches the end of the profile: as long on that side as on the other one
      if (first == 1) region%box%y(1) = 2.0_wp*region%y - region%box%y(2)
      if (last == gap%n) region%box%y(2) = 2.0_wp*region%y - region%box%y(1)
      call find_deepest(gap, g, first, last, region%gap, region%deepest)
      allocate(region%seeds(1), source=region%deepest(2))
      allocate(region%part(1), source=region%box)
      allocate(region%interaction(1, 1), source=1.0_wp)
   end subroutine describe

   !> Reference, weight and bounds of a contact that is small compared with the mesh, from the parabola through three points
   !>
   !> A region stays as it is where there is no such parabola, or where it does not reach below zero.
   pure subroutine describe_small(gap, g, first, last, weight_power, region)
      type(gap_curve), intent(in) :: gap
      real(wp), intent(in) :: g(:)
      !> The points with g < 0, or a point with a lower gap than its neighbours
      integer, intent(in) :: first, last
      integer, intent(in) :: weight_power
      !> With the description by mesh points
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
      region%x = x
      region%y = place(2)
      region%alpha = place(3)
      region%gap = lowest
      region%deepest = place
      region%seeds = [place(2)]
      ! the weights of all lateral positions, integrated: (1 - u**2)**2.5 and (1 - u**2)**1.5 from -1 to 1
      region%weight = max(min_weight, w)*half*merge(5.0_wp/16.0_wp, 3.0_wp/8.0_wp, weight_power == 2)*pi
      region%box%x = extent
      region%box%y = place(2) + [-half, half]
      region%box%z = gap%z(i) + (region%box%y - gap%y(i))*(gap%z(i + 1) - gap%z(i - 1))/(2.0_wp*gap%dy)
      region%part = [region%box]
   end subroutine describe_small

   !> Weight of the interpenetration along the track at one lateral position, round wheel: c - kappa (x - x_locus)**2
   pure subroutine weigh_parabola(gap, i, c, power, weight, x, extent)
      type(gap_curve), intent(in) :: gap
      integer, intent(in) :: i
      !> Largest interpenetration [mm]
      real(wp), intent(in) :: c
      !> Power of the interpenetration that is integrated, 1 or 2
      integer, intent(in) :: power
      real(wp), intent(out) :: weight
      !> Its centre, and where it begins and ends [mm]
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

   !> The same from a table of gaps along the track, by its sum; ends on straight lines between places
   !>
   !> A stretch with few points of the table is summed up at places between them, too, on curves through four points:
   !> else the centre of a contact that is as short as the steps of the table would be that of one or two points.
   pure subroutine weigh_table(places, g, locus, power, weight, x, extent)
      real(wp), intent(in) :: places(:), g(:)
      !> Place of the smallest gap [mm], for a stretch too short for the table
      real(wp), intent(in) :: locus
      integer, intent(in) :: power
      real(wp), intent(out) :: weight, x, extent(2)
      !> Stretches with fewer points of the table are refined, and how much
      integer, parameter :: few = 16, parts = 16
      real(wp) :: moment, step, before, now, depth, place
      integer :: i, k, n, first, last

      weight = 0.0_wp
      moment = 0.0_wp
      x = locus
      extent = locus
      n = 1
      if (count(g < 0.0_wp) < few) n = parts
      step = (places(2) - places(1))/n
      ! the smallest value may be positive although the curve dips below zero beside it
      first = minloc(g, 1)
      last = first
      do i = 1, size(g)
         if (.not. g(i) < 0.0_wp) cycle
         first = min(first, i)
         last = max(last, i)
      end do
      first = max(1, first - 1)
      last = min(size(g), last + 1)
      before = g(first)
      do i = first, last
         do k = 1, n
            if (i == last .and. k > 1) exit
            place = places(i) + (k - 1)*step
            now = g(i)
            if (k > 1) now = between(i, real(k - 1, wp)/n)
            if (now < 0.0_wp) then
               depth = abs(now)**power
               weight = weight + depth*step
               moment = moment + depth*(place - locus)*step
               extent = [min(extent(1), place), max(extent(2), place)]
            end if
            ! where the gap vanishes between the place before and this one
            if (min(before, now) < 0.0_wp .and. max(before, now) >= 0.0_wp .and. max(before, now) <= far_away) then
               place = place - step*now/(now - before)
               extent = [min(extent(1), place), max(extent(2), place)]
            end if
            before = now
         end do
      end do
      if (weight > 0.0_wp) x = locus + moment/weight

   contains

      !> Gap between two points of the table, by the cubic with the slopes of parabolas; straight beside missing surfaces
      pure real(wp) function between(i, t)
         integer, intent(in) :: i
         !> Share of the way to the next point
         real(wp), intent(in) :: t
         real(wp) :: rise, bend(2)

         if (max(g(i), g(i + 1)) > far_away) then
            between = merge(g(i), g(i + 1), t < 0.5_wp)
            return
         end if
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
         between = g(i) + t*rise - 0.5_wp*t*(1.0_wp - t)*((1.0_wp - t)*bend(1) + t*bend(2))
      end function between
   end subroutine weigh_table

   !> Lateral position where the gap vanishes between a point inside and its neighbour outside
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

   !> Smallest gap of a stretch, between mesh points by a parabola, and its place
   pure subroutine find_deepest(gap, g, first, last, lowest, place)
      type(gap_curve), intent(in) :: gap
      real(wp), intent(in) :: g(:)
      integer, intent(in) :: first, last
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

   !> A place where the bodies nearly touch
   pure subroutine describe_miss(gap, g, i, region)
      type(gap_curve), intent(in) :: gap
      real(wp), intent(in) :: g(:)
      integer, intent(in) :: i
      type(contact_region), intent(out) :: region

      region%x = gap%x(i)
      region%y = gap%y(i)
      region%alpha = gap%alpha(i)
      region%weight = min_weight
      call find_deepest(gap, g, i, i, region%gap, region%deepest)
      region%gap = max(open_gap, region%gap)
      allocate(region%seeds(1), source=region%y)
      region%box%x = gap%x(i)
      region%box%y = gap%y(i)
      region%box%z = gap%z(i)
      allocate(region%part(1), source=region%box)
      allocate(region%interaction(1, 1), source=1.0_wp)
   end subroutine describe_miss

   !> Field side (large y) first
   subroutine sort_regions(regions)
      type(contact_region), allocatable, intent(inout) :: regions(:)
      type(contact_region) :: moved
      integer :: i, j

      do i = 2, size(regions)
         moved = regions(i)
         j = i - 1
         do while (j >= 1)
            if (regions(j)%y >= moved%y) exit
            regions(j + 1) = regions(j)
            j = j - 1
         end do
         regions(j + 1) = moved
      end do
   end subroutine sort_regions

   !> Distance of two regions, the first one on the field side [mm]; where they are beside each other along the track, along it
   pure real(wp) function distance(field, gauge, along_track)
      type(region_box), intent(in) :: field, gauge
      !> Count the distance along the track, too?
      logical, intent(in) :: along_track
      real(wp) :: d(3)

      d = 0.0_wp
      if (along_track) d(1) = max(0.0_wp, field%x(1) - gauge%x(2), gauge%x(1) - field%x(2))
      if (.not. side_by_side(field, gauge)) then
         d(2) = field%y(1) - gauge%y(2)
         d(3) = field%z(1) - gauge%z(2)
      end if
      distance = norm2(d)
   end function distance

   !> Have two regions lateral positions in common?
   pure logical function side_by_side(a, b)
      type(region_box), intent(in) :: a, b
      side_by_side = a%y(1) < b%y(2) .and. b%y(1) < a%y(2)
   end function side_by_side

   !> First combine what is near, then blend what is not far
   subroutine join_regions(search, regions)
      type(search_spec), intent(in) :: search
      type(contact_region), allocatable, intent(inout) :: regions(:)

      call join_within(search%d_comb, .false.)
      call join_within(search%d_sep, .true.)

   contains

      !> Join neighbours until none are near each other: across the track those that follow each other, and along it
      subroutine join_within(furthest, blend)
         !> Distance [mm]
         real(wp), intent(in) :: furthest
         !> Do the parts stay known?
         logical, intent(in) :: blend
         integer :: i, j

         i = 1
         do while (i < size(regions))
            do j = i + 1, size(regions)
               if (j > i + 1 .and. .not. side_by_side(regions(i)%box, regions(j)%box)) cycle
               if (distance(regions(i)%box, regions(j)%box, .true.) > furthest) cycle
               if (abs(regions(i)%alpha - regions(j)%alpha) > search%a_sep) cycle
               exit
            end do
            if (j > size(regions)) then
               i = i + 1
            else
               call join(i, j, blend)
               call sort_regions(regions)
               i = 1
            end if
         end do
      end subroutine join_within

      !> Make one region of two
      subroutine join(i, j, blend)
         !> Their numbers, i < j
         integer, intent(in) :: i, j
         !> Do the parts stay known?
         logical, intent(in) :: blend
         type(contact_region) :: both
         real(wp) :: w(2)

         associate (a => regions(i), b => regions(j))
            w = [a%weight, b%weight]/(a%weight + b%weight)
            both = a
            both%x = w(1)*a%x + w(2)*b%x
            both%y = w(1)*a%y + w(2)*b%y
            both%alpha = w(1)*a%alpha + w(2)*b%alpha
            both%weight = a%weight + b%weight
            both%gap = min(a%gap, b%gap)
            if (b%gap < a%gap) both%deepest = b%deepest
            both%seeds = [a%seeds, b%seeds]
            both%box%x = [min(a%box%x(1), b%box%x(1)), max(a%box%x(2), b%box%x(2))]
            both%box%y = [min(a%box%y(1), b%box%y(1)), max(a%box%y(2), b%box%y(2))]
            both%box%z = [merge(a%box%z(1), b%box%z(1), a%box%y(1) < b%box%y(1)), &
               & merge(b%box%z(2), a%box%z(2), b%box%y(2) > a%box%y(2))]
            deallocate(both%part, both%interaction)
            if (blend) then
               both%part = [a%part, b%part]
               both%interaction = interactions(both%part, search)
            else
               allocate(both%part(1), source=both%box)
               allocate(both%interaction(1, 1), source=1.0_wp)
            end if
         end associate
         regions = [regions(:i - 1), both, regions(i + 1:j - 1), regions(j + 1:)]
      end subroutine join
   end subroutine join_regions

   !> How much pressures of one part act on the others: fully when near, not at all when far
   pure function interactions(part, search) result(factor)
      type(region_box), intent(in) :: part(:)
      type(search_spec), intent(in) :: search
      real(wp) :: factor(size(part), size(part))
      real(wp) :: d
      integer :: i, j

      factor = 1.0_wp
      do i = 1, size(part)
         do j = i + 1, size(part)
            d = distance(part(i), part(j), .true.)
            if (search%d_sep > search%d_comb) factor(i, j) = &
               & min(1.0_wp, max(0.0_wp, (search%d_sep - d)/(search%d_sep - search%d_comb)))**blend_exponent
            factor(j, i) = factor(i, j)
         end do
      end do
   end function interactions

   !> A patch grows towards a place that is about to touch, so that a second contact opens smoothly
   subroutine shift_near_misses(search, misses, regions)
      type(search_spec), intent(in) :: search
      type(contact_region), intent(in) :: misses(:)
      type(contact_region), intent(inout) :: regions(:)
      real(wp) :: share
      integer :: i, k

      if (.not. search%g_miss > 0.0_wp) return
      do k = 1, size(misses)
         if (misses(k)%gap >= search%g_miss) cycle
         share = 1.0_wp - misses(k)%gap/search%g_miss
         do i = 1, size(regions)
            associate (box => regions(i)%box, y => misses(k)%y)
               if (y < box%y(1) .and. box%y(1) - y <= search%d_comb) box%y(1) = box%y(1) + share*(y - box%y(1))
               if (y > box%y(2) .and. y - box%y(2) <= search%d_comb) box%y(2) = box%y(2) + share*(y - box%y(2))
            end associate
         end do
      end do
   end subroutine shift_near_misses

   !> Planes of neighbouring patches turn towards a common one as they come closer
   subroutine turn_regions(search, regions)
      type(search_spec), intent(in) :: search
      type(contact_region), intent(inout) :: regions(:)
      real(wp) :: d, common, share
      integer :: i

      do i = 1, size(regions) - 1
         associate (a => regions(i), b => regions(i + 1))
            d = distance(a%box, b%box, .false.)
            if (d < search%d_sep .or. d > search%d_turn .or. abs(a%alpha - b%alpha) > search%a_sep) cycle
            common = (a%weight*a%alpha + b%weight*b%alpha)/(a%weight + b%weight)
            share = (search%d_turn - d)/max(search%d_turn - search%d_sep, tiny(d))
            a%alpha = a%alpha + share*(common - a%alpha)
            b%alpha = b%alpha + share*(common - b%alpha)
         end associate
      end do
   end subroutine turn_regions

   !> The deepest point of each region becomes its reference
   pure subroutine refer_to_deepest(regions)
      type(contact_region), intent(inout) :: regions(:)
      integer :: i

      do i = 1, size(regions)
         regions(i)%x = regions(i)%deepest(1)
         regions(i)%y = regions(i)%deepest(2)
         regions(i)%alpha = regions(i)%deepest(3)
      end do
   end subroutine refer_to_deepest

   !> Planes that are nearly vertical are turned away from it
   subroutine avoid_vertical(regions)
      type(contact_region), intent(inout) :: regions(:)
      integer :: i

      do i = 1, size(regions)
         if (abs(abs(regions(i)%alpha) - 0.5_wp*pi) < upright) &
            & regions(i)%alpha = sign(0.5_wp*pi - upright, regions(i)%alpha)
      end do
   end subroutine avoid_vertical
end module contact_wheelrail_regions
