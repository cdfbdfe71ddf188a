!> From the gap between wheel and rail to contact patches
!>
!> Every stretch where the bodies interpenetrate becomes a region with a reference (contact_wheelrail_region): the mean of
!> position and surface angle, weighted by the square of the interpenetration, for a wheel that is round along the track.
!> Instead of the mean, the deepest point and the surface angle there can be the reference. Regions close to each other are
!> joined (contact_wheelrail_region_joins).
module contact_wheelrail_regions
   use contact_base_choices, only : contact_location
   use contact_base_kinds, only : wp
   use contact_wheelrail_gap, only : gap_curve, no_surface
   use contact_wheelrail_region, only : contact_region, describe, describe_miss, describe_small, far_away, find_deepest
   use contact_wheelrail_region_joins, only : avoid_vertical, join_regions, refer_to_deepest, shift_near_misses, side_by_side, &
      & sort_regions, turn_regions
   use contact_wheelrail_spec, only : search_spec
   use contact_wheelrail_spots, only : separate_spots, spot
   implicit none (type, external)
   private

   public :: find_regions, smallest_gap

   !> A contact of so few mesh points is described by the parabola through the gap around its deepest point
   integer, parameter :: few_points = 4
   !> Near misses that are kept
   integer, parameter :: max_misses = 2

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

end module contact_wheelrail_regions
