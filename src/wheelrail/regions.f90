!> Contact regions from the gap between wheel and rail
!>
!> Every stretch of interpenetration is a region with a reference (contact_wheelrail_region): the mean of position and surface
!> angle, weighted by default with the square of the interpenetration, for a wheel that is round along the track. Alternatively the
!> reference is the deepest point with its surface angle. Regions close to each other are joined (contact_wheelrail_region_joins).
module contact_wheelrail_regions
   use contact_base_choices, only : contact_location
   use contact_base_kinds, only : wp
   use contact_wheelrail_gap, only : gap_curve, most_finer, no_surface
   use contact_wheelrail_region, only : contact_region, describe, describe_miss, describe_small, far_away, find_deepest, &
      & region_box
   use contact_wheelrail_region_joins, only : avoid_vertical, draw_lattices, join_regions, refer_to_deepest, shift_near_misses, &
      & side_by_side, sort_regions, turn_regions
   use contact_wheelrail_spec, only : search_spec
   use contact_wheelrail_spots, only : separate_spots, spot
   implicit none (type, external)
   private

   public :: collect_regions, few_points, find_regions, found_regions, remove_region, smallest_gap

   !> Results of a search for regions; arrays are kept from one search to the next
   type :: found_regions
      !> Numbers of regions, field side first, and of near misses by increasing gap; the arrays may be larger
      integer :: n = 0, n_misses = 0
      type(contact_region), allocatable :: region(:), miss(:)
      !> Gap at the present height [mm]
      real(wp), allocatable, private :: lowered(:)
   end type found_regions

   !> Contacts of at most this number of mesh points are described by the parabola through the gap around the deepest point
   integer, parameter :: few_points = 4
   !> Maximum number of near misses, and initial number of regions
   integer, parameter :: max_misses = 2, few_regions = 4

contains

   !> Smallest gap, at mesh points and between them [mm]
   pure recursive real(wp) function smallest_gap(gap, closer) result(smallest)
      !> Gaps at the mesh points, and the table for bodies that vary
      type(gap_curve), intent(in) :: gap
      !> Gaps on finer meshes near local minima, see `measure_gap`
      type(gap_curve), intent(in), optional :: closer(:)
      real(wp) :: lowest, place(3)
      integer :: i, k

      smallest = no_surface
      do i = 1, gap%n
         smallest = min(smallest, gap%gap(i))
      end do
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

   !> Find regions for a wheel that is lower by dz than that of the gap, field side first, as new arrays
   subroutine find_regions(gap, dz, search, weight_power, regions, misses, closer)
      !> Mesh, gaps, and the table for bodies that vary
      type(gap_curve), intent(in) :: gap
      !> Change of the height [mm], positive downwards
      real(wp), intent(in) :: dz
      !> Distances and angles at which regions are joined or separated
      type(search_spec), intent(in) :: search
      !> Weights by the square (2) or the first power (1) of the interpenetration
      integer, intent(in) :: weight_power
      !> Regions, one per patch
      type(contact_region), allocatable, intent(out) :: regions(:)
      !> Near misses by increasing gap
      type(contact_region), allocatable, intent(out) :: misses(:)
      !> Gaps on finer meshes near local minima, see `measure_gap`
      type(gap_curve), intent(in), optional :: closer(:)
      type(found_regions) :: found

      call collect_regions(gap, dz, search, weight_power, found, closer)
      allocate(regions(found%n), misses(found%n_misses))
      regions(:) = found%region(:found%n)
      misses(:) = found%miss(:found%n_misses)
   end subroutine find_regions

   !> Find regions for a wheel that is lower by dz than that of the gap, field side first
   subroutine collect_regions(gap, dz, search, weight_power, found, closer)
      !> Mesh, gaps, and the table for bodies that vary
      type(gap_curve), intent(in) :: gap
      !> Change of the height [mm], positive downwards
      real(wp), intent(in) :: dz
      !> Distances and angles at which regions are joined or separated
      type(search_spec), intent(in) :: search
      !> Weights by the square (2) or the first power (1) of the interpenetration
      integer, intent(in) :: weight_power
      !> One region per patch, and near misses
      type(found_regions), intent(inout) :: found
      !> Gaps on finer meshes near local minima, see `measure_gap`
      type(gap_curve), intent(in), optional :: closer(:)
      integer :: i

      if (.not. allocated(found%region)) allocate(found%region(few_regions), found%miss(max_misses))
      if (allocated(found%lowered)) then
         if (size(found%lowered) /= gap%n) deallocate(found%lowered)
      end if
      if (.not. allocated(found%lowered)) allocate(found%lowered(gap%n))
      do i = 1, gap%n
         found%lowered(i) = merge(no_surface, gap%gap(i) - dz, gap%gap(i) > far_away)
      end do
      found%n = 0
      found%n_misses = 0
      call preliminary_regions(gap, found%lowered, weight_power, found, closer)
      call sort_regions(found%region(:found%n))
      call join_regions(search, found%region, found%n)
      associate (regions => found%region(:found%n))
         call shift_near_misses(search, found%miss(:found%n_misses), regions)
         if (search%location == contact_location%first_contact) then
            call refer_to_deepest(regions)
         else
            call draw_lattices(search, regions)
            call turn_regions(search, regions)
         end if
         call avoid_vertical(regions)
         call set_limits(regions)
      end associate
   end subroutine collect_regions

   !> Add a region to the list
   subroutine add_region(found, region)
      type(found_regions), intent(inout) :: found
      type(contact_region), intent(in) :: region
      type(contact_region), allocatable :: longer(:)

      if (found%n == size(found%region)) then
         allocate(longer(2*found%n))
         longer(:found%n) = found%region
         call move_alloc(longer, found%region)
      end if
      found%n = found%n + 1
      found%region(found%n) = region
   end subroutine add_region

   !> Remove a region from the list
   subroutine remove_region(found, k)
      !> List of regions
      type(found_regions), intent(inout) :: found
      !> Index of the region
      integer, intent(in) :: k
      integer :: i

      found%n = found%n - 1
      do i = k, found%n
         found%region(i) = found%region(i + 1)
      end do
   end subroutine remove_region

   !> Set the positions where other regions begin, and the middle between them and this one: the load of overlap that belongs to two
   !> patches would be counted twice
   pure subroutine set_limits(regions)
      type(contact_region), intent(inout) :: regions(:)
      integer :: i, j

      do i = 1, size(regions)
         do j = 1, size(regions)
            if (i == j) cycle
            associate (me => regions(i), other => regions(j)%box)
               if (side_by_side(me%box, other)) then
                  if (other%x(1) > me%x) me%others_x(2) = min(me%others_x(2), other%x(1))
                  if (other%x(2) < me%x) me%others_x(1) = max(me%others_x(1), other%x(2))
                  if (other%x(1) > me%box%x(2)) me%middle_x(2) = min(me%middle_x(2), 0.5_wp*(me%box%x(2) + other%x(1)))
                  if (other%x(2) < me%box%x(1)) me%middle_x(1) = max(me%middle_x(1), 0.5_wp*(me%box%x(1) + other%x(2)))
               else
                  if (other%y(1) > me%y) me%others_y(2) = min(me%others_y(2), other%y(1))
                  if (other%y(2) < me%y) me%others_y(1) = max(me%others_y(1), other%y(2))
                  call halve(me%box, other, me%middle_yz)
               end if
            end associate
         end do
      end do
   end subroutine set_limits

   !> Set the middle between the bounds of two regions that do not overlap laterally, if the other one is nearer than those before
   pure subroutine halve(own, other, middle)
      type(region_box), intent(in) :: own, other
      !> Middle towards lower and higher y: coordinates y and z [mm]
      real(wp), intent(inout) :: middle(:, :)
      real(wp) :: y
      integer :: side

      side = merge(1, 2, other%y(2) <= own%y(1))
      y = 0.5_wp*(own%y(side) + other%y(3 - side))
      if (merge(y > middle(1, 1), y < middle(1, 2), side == 1)) middle(:, side) = [y, 0.5_wp*(own%z(side) + other%z(3 - side))]
   end subroutine halve

   !> One region per stretch of interpenetration, or per spot if it is divided along the track; the nearest misses
   recursive subroutine preliminary_regions(gap, g, weight_power, found, closer)
      type(gap_curve), intent(in) :: gap
      !> Gap at the present height [mm]
      real(wp), intent(in) :: g(:)
      integer, intent(in) :: weight_power
      !> List to which regions and misses are added
      type(found_regions), intent(inout) :: found
      !> Gaps on finer meshes near local minima
      type(gap_curve), intent(in), optional :: closer(:)
      type(contact_region) :: region
      type(spot), allocatable :: spots(:)
      integer :: i, k, first, last, n, n_spots
      logical :: is_shown_closer

      n = size(g)
      i = 1
      do while (i <= n)
         ! most points are neither in contact nor a minimum
         do while (i > 1 .and. i < n)
            if (.not. (g(i) >= 0.0_wp .and. (g(i) > g(i - 1) .or. g(i) >= g(i + 1)))) exit
            i = i + 1
         end do
         if (g(i) >= 0.0_wp) then
            if (g(i) > g(max(1, i - 1)) .or. g(i) >= g(min(n, i + 1))) then
               i = i + 1
               cycle
            end if
         end if
         if (g(i) < 0.0_wp) then
            first = i
            last = i
            do while (last < n)
               if (.not. g(last + 1) < 0.0_wp) exit
               last = last + 1
            end do
            n_spots = 0
            if (allocated(gap%table)) then
               call separate_spots(gap, g, first, last, spots)
               n_spots = size(spots)
            end if
            is_shown_closer = .false.
            if (last - first < few_points) call look_closer(gap, g, first, last, weight_power, found, is_shown_closer, closer)
            if (n_spots == 0 .and. .not. is_shown_closer) then
               call describe(gap, g, first, last, weight_power, region)
               if (last - first < few_points) call describe_small(gap, g, first, last, weight_power, region)
               call add_region(found, region)
            end if
            do k = 1, n_spots
               call describe(spots(k)%gap, spots(k)%g, spots(k)%first, spots(k)%last, weight_power, region)
               call add_region(found, region)
            end do
            i = last + 1
         else
            if (is_minimum(g, i)) then
               call look_closer(gap, g, i, i, weight_power, found, is_shown_closer, closer)
               if (.not. is_shown_closer) then
                  call describe_miss(gap, g, i, region)
                  call describe_small(gap, g, i, i, weight_power, region)
                  if (region%touches) then
                     call add_region(found, region)
                  else
                     call keep_miss(found, region)
                  end if
               end if
            end if
            i = i + 1
         end if
      end do
   end subroutine preliminary_regions

   !> Add regions from a finer mesh between two points, if there is one
   recursive subroutine look_closer(gap, g, first, last, weight_power, found, is_closer, closer)
      type(gap_curve), intent(in) :: gap
      !> Gap at the present height [mm]
      real(wp), intent(in) :: g(:)
      !> First and last point with g < 0, or a point with a lower gap than its neighbours
      integer, intent(in) :: first, last
      integer, intent(in) :: weight_power
      !> List to which regions of the finer mesh are added
      type(found_regions), intent(inout) :: found
      !> Is there a finer mesh?
      logical, intent(out) :: is_closer
      type(gap_curve), intent(in), optional :: closer(:)
      integer :: i, k

      i = first - 1 + minloc(g(first:last), dim=1)
      k = 0
      if (present(closer) .and. first > 1 .and. last < gap%n) k = findloc(closer%shows, i, dim=1)
      is_closer = k > 0
      if (is_closer) call add_finer(closer(k), g(i) - gap%gap(i), gap%y(first - 1), gap%y(last + 1), weight_power, found)
   end subroutine look_closer

   !> Add regions and misses of a finer mesh between two points of a coarse one
   recursive subroutine add_finer(near, lower, low, high, weight_power, found)
      type(gap_curve), intent(in) :: near
      !> Change of its gaps; lateral positions of the two points [mm]
      real(wp), intent(in) :: lower, low, high
      integer, intent(in) :: weight_power
      type(found_regions), intent(inout) :: found
      real(wp) :: fine(most_finer)
      integer :: i

      do i = 1, near%n
         fine(i) = near%gap(i) + lower
         if (near%gap(i) > far_away .or. near%y(i) < low - 0.5_wp*near%dy .or. near%y(i) > high + 0.5_wp*near%dy) &
            & fine(i) = no_surface
      end do
      call preliminary_regions(near, fine(:near%n), weight_power, found)
   end subroutine add_finer

   !> Is the gap lower here than on both sides?
   pure logical function is_minimum(g, i)
      real(wp), intent(in) :: g(:)
      integer, intent(in) :: i

      is_minimum = .false.
      if (i <= 1 .or. i >= size(g) .or. g(i) > far_away) return
      is_minimum = g(i) <= g(i - 1) .and. g(i) < g(i + 1) .and. g(i - 1) >= 0.0_wp .and. g(i + 1) >= 0.0_wp
   end function is_minimum

   !> Keep the nearest misses, by increasing gap
   subroutine keep_miss(found, region)
      type(found_regions), intent(inout) :: found
      type(contact_region), intent(in) :: region
      integer :: place, i

      place = count(found%miss(:found%n_misses)%gap <= region%gap) + 1
      if (place > max_misses) return
      found%n_misses = min(found%n_misses + 1, max_misses)
      do i = found%n_misses, place + 1, -1
         found%miss(i) = found%miss(i - 1)
      end do
      found%miss(place) = region
   end subroutine keep_miss

end module contact_wheelrail_regions
