!> Regions of contact that are close to each other: combined to one patch, blended to one patch with several parts, or turned
!> towards a common angle
module contact_wheelrail_region_joins
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_wheelrail_region, only : contact_region, parts_of, region_box, seeds_of
   use contact_wheelrail_spec, only : search_spec
   implicit none (type, external)
   private

   public :: avoid_vertical, draw_lattices, join_regions, refer_to_deepest, shift_near_misses, side_by_side, &
      & sort_regions, turn_regions

   !> Exponent of the decrease of the interaction factor with the distance of blended parts
   real(wp), parameter :: blend_exponent = 0.8_wp
   !> Minimum difference of contact angles to a vertical plane [rad]
   real(wp), parameter :: upright = 1.0e-3_wp

contains

   !> Sort regions, field side (large y) first
   subroutine sort_regions(regions)
      !> Sorted by decreasing y of their references
      type(contact_region), intent(inout) :: regions(:)
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

   !> Distance of two regions, the first one on the field side [mm]; along the track if they overlap laterally
   pure real(wp) function distance(field, gauge, along_track)
      type(region_box), intent(in) :: field, gauge
      !> Include the distance along the track?
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

   !> Do two regions overlap laterally?
   pure logical function side_by_side(a, b)
      !> Bounds of two regions; the lateral ones are compared [mm]
      type(region_box), intent(in) :: a, b
      side_by_side = a%y(1) < b%y(2) .and. b%y(1) < a%y(2)
   end function side_by_side

   !> Combine regions at small distance, then blend those at medium distance
   subroutine join_regions(search, regions, n)
      !> Distances and angles at which regions are joined
      type(search_spec), intent(in) :: search
      !> The first n are in use; those that are close enough are joined
      type(contact_region), intent(inout) :: regions(:)
      !> Number of regions
      integer, intent(inout) :: n

      call join_within(search%d_comb, .false.)
      call join_within(search%d_sep, .true.)

   contains

      !> Join regions until none are close to each other: successive ones across the track, and those that overlap laterally along
      !> it
      subroutine join_within(furthest, blend)
         !> Maximum distance [mm]
         real(wp), intent(in) :: furthest
         !> Keep the description of the parts?
         logical, intent(in) :: blend
         integer :: i, j

         i = 1
         do while (i < n)
            do j = i + 1, n
               if (j > i + 1 .and. .not. side_by_side(regions(i)%box, regions(j)%box)) cycle
               if (distance(regions(i)%box, regions(j)%box, .true.) > furthest) cycle
               if (abs(regions(i)%alpha - regions(j)%alpha) > search%a_sep) cycle
               exit
            end do
            if (j > n) then
               i = i + 1
            else
               call join(i, j, blend)
               call sort_regions(regions(:n))
               i = 1
            end if
         end do
      end subroutine join_within

      !> Replace two regions by one
      subroutine join(i, j, blend)
         !> Indices of the regions, i < j
         integer, intent(in) :: i, j
         !> Keep the description of the parts?
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
            both%seeds = [seeds_of(a), seeds_of(b)]
            both%box%x = [min(a%box%x(1), b%box%x(1)), max(a%box%x(2), b%box%x(2))]
            both%box%y = [min(a%box%y(1), b%box%y(1)), max(a%box%y(2), b%box%y(2))]
            both%box%z = [merge(a%box%z(1), b%box%z(1), a%box%y(1) < b%box%y(1)), &
               & merge(b%box%z(2), a%box%z(2), b%box%y(2) > a%box%y(2))]
            if (allocated(both%part)) deallocate(both%part, both%interaction)
            if (blend) then
               both%part = [parts_of(a), parts_of(b)]
               both%interaction = interactions(both%part, search)
            end if
         end associate
         regions(i) = both
         regions(j:n - 1) = regions(j + 1:n)
         n = n - 1
      end subroutine join
   end subroutine join_regions

   !> Interaction factors between the pressures of parts: 1 up to the combining distance, decreasing to 0 at the separating distance
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

   !> Extend the bounds of regions towards near misses, so that a second contact appears smoothly
   subroutine shift_near_misses(search, misses, regions)
      !> Maximum gap and distance of misses that have an effect
      type(search_spec), intent(in) :: search
      !> Near misses by increasing gap
      type(contact_region), intent(in) :: misses(:)
      !> Their bounds are extended towards near misses
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

   !> Rotate the planes of neighbouring regions towards a common one with decreasing distance
   subroutine turn_regions(search, regions)
      !> Distances and angle between which planes are rotated
      type(search_spec), intent(in) :: search
      !> Their angles are changed towards each other
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

   !> Let the lattices of elements of neighbouring regions approach a common one with decreasing distance
   !>
   !> At the distance at which two regions are joined, the elements of both are those of the joined region, whose reference is the
   !> centre of an element. Otherwise the discretisation, and with it the force, would jump there.
   pure subroutine draw_lattices(search, regions)
      !> Distances and angle between which lattices are moved
      type(search_spec), intent(in) :: search
      !> The common reference with the nearest neighbour is set; the angles must not have been turned yet
      type(contact_region), intent(inout) :: regions(:)
      real(wp) :: d, common(2), share
      integer :: i, j

      do i = 1, size(regions) - 1
         do j = i + 1, size(regions)
            associate (a => regions(i), b => regions(j))
               if (j > i + 1 .and. .not. side_by_side(a%box, b%box)) cycle
               d = distance(a%box, b%box, .true.)
               if (d < search%d_sep .or. d > search%d_turn .or. abs(a%alpha - b%alpha) > search%a_sep) cycle
               share = (search%d_turn - d)/max(search%d_turn - search%d_sep, tiny(d))
               common = (a%weight*[a%x, a%y] + b%weight*[b%x, b%y])/(a%weight + b%weight)
               if (share > a%share) a%common = common
               if (share > b%share) b%common = common
               a%share = max(a%share, share)
               b%share = max(b%share, share)
            end associate
         end do
      end do
   end subroutine draw_lattices

   !> Move the reference of each region to its deepest point
   pure subroutine refer_to_deepest(regions)
      !> Reference and angle are set to those of the deepest point
      type(contact_region), intent(inout) :: regions(:)
      integer :: i

      do i = 1, size(regions)
         regions(i)%x = regions(i)%deepest(1)
         regions(i)%y = regions(i)%deepest(2)
         regions(i)%alpha = regions(i)%deepest(3)
      end do
   end subroutine refer_to_deepest

   !> Rotate planes that are nearly vertical
   subroutine avoid_vertical(regions)
      !> Angles are kept at a minimum difference to vertical planes
      type(contact_region), intent(inout) :: regions(:)
      integer :: i

      do i = 1, size(regions)
         if (abs(abs(regions(i)%alpha) - 0.5_wp*pi) < upright) &
            & regions(i)%alpha = sign(0.5_wp*pi - upright, regions(i)%alpha)
      end do
   end subroutine avoid_vertical
end module contact_wheelrail_region_joins
