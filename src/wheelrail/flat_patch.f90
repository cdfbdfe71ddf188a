!> Grid and undeformed distance of a flat contact patch
!>
!> The plane passes through the contact reference on the rail and is rolled by the contact angle. Coordinates: x along the track, s
!> in the plane, n into the rail. The undeformed distance is the difference of the two surfaces along n. Points of the wheel are
!> computed directly, by Newton's method for the position on the profile and the height above the plane, so that the distance is as
!> smooth as the profiles.
module contact_wheelrail_flat_patch
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_numeric_vectors, only : largest_difference, largest_of, smallest_of
   use contact_profile_curve, only : profile_curve
   use contact_profile_section, only : profile_section
   use contact_wheelrail_frame, only : frame, new_frame
   use contact_wheelrail_placement, only : wheel_rail_placement
   use contact_wheelrail_region, only : contact_region
   use contact_wheelrail_wheel_rows, only : wheel_rows
   implicit none (type, external)
   private

   public :: distance_scratch, lattice_lead, patch_frame, patch_grid, undeformed_distance, start_places, shift_distance

   !> Distance where rail or wheel is missing [mm]
   real(wp), parameter, public :: nothing_there = 999.0_wp

   !> Workspace kept from one distance to the next, so that no memory is allocated; its contents are not used
   type :: distance_scratch
      !> Arc lengths from `start_places`; the first n are set
      real(wp), allocatable :: places(:)
      integer :: n = 0
      type(profile_section), private :: section
      type(wheel_rows), private :: rows
      !> A roller, turned over like a wheel, and its heights over one row of elements [mm]
      type(profile_curve), private :: roller
      type(wheel_rows), private :: roller_rows
      real(wp), allocatable, private :: roller_row(:)
   end type distance_scratch

   !> Initial size of `places`: for one stretch, and its reference
   integer, parameter :: few_places = 4

contains

   !> The plane of a patch in track coordinates
   function patch_frame(rail, placement, region) result(plane)
      !> The rail in track coordinates
      type(profile_curve), intent(in) :: rail
      !> Position of the bodies
      type(wheel_rail_placement), intent(in) :: placement
      !> Region whose weighted centre becomes the contact reference
      type(contact_region), intent(in) :: region
      type(frame) :: plane

      plane = new_frame(on_rail(rail, placement, [region%x, region%y]), region%alpha, 0.0_wp)
   end function patch_frame

   !> Point of the rail below a point of the track
   function on_rail(rail, placement, at) result(point)
      !> The rail in track coordinates
      type(profile_curve), intent(in) :: rail
      !> Position of the bodies
      type(wheel_rail_placement), intent(in) :: placement
      !> Position along and across the track [mm]
      real(wp), intent(in) :: at(2)
      real(wp) :: point(3)

      point = [at, rail%height(at(2))]
      point(3) = point(3) + placement%roller_drop(at(1), point(3))
   end function on_rail

   !> Position of the reference of a patch relative to the centre of an element, along x and s of its plane [mm]
   !>
   !> 0 without neighbour. Near one, the nearest element of the common lattice determines it: half an element at most.
   function lattice_lead(rail, placement, region, plane, sides) result(lead)
      !> The rail in track coordinates
      type(profile_curve), intent(in) :: rail
      !> Position of the bodies
      type(wheel_rail_placement), intent(in) :: placement
      !> Region with its share of a common lattice
      type(contact_region), intent(in) :: region
      !> Its plane, see `patch_frame`
      type(frame), intent(in) :: plane
      !> Sides of the elements [mm]
      real(wp), intent(in) :: sides(2)
      real(wp) :: lead(2)
      real(wp) :: vector(3)

      lead = 0.0_wp
      if (.not. region%share > 0.0_wp) return
      vector = plane%origin - on_rail(rail, placement, region%common)
      lead = matmul(vector, plane%axes(:, 1:2))
      lead = region%share*(lead - anint(lead/sides)*sides)
   end function lattice_lead

   !> Elements that cover a region, with one more on each side
   subroutine patch_grid(rail, sides, region, plane, reference, max_elements, grid)
      !> The rail in track coordinates
      type(profile_curve), intent(in) :: rail
      !> Sides of the elements along the track and across [mm]
      real(wp), intent(in) :: sides(2)
      !> Extent of the interpenetration
      type(contact_region), intent(in) :: region
      !> Contact reference and its axes
      type(frame), intent(in) :: plane
      !> Position of the contact reference relative to the centre of an element [mm]
      real(wp), intent(in) :: reference(2)
      !> Maximum number of elements; elements are doubled in size until there are fewer
      integer, intent(in) :: max_elements
      !> Elements in coordinates of the patch
      type(potential_contact), intent(out) :: grid
      real(wp) :: x(2), s(2), lead(2), dx, ds
      integer :: ix(2), iy(2), doubling

      x = region%box%x - plane%origin(1)
      s = rail%s_at(region%box%y) - rail%s_at(plane%origin(2))
      if (s(1) > s(2)) s = s([2, 1])
      ! beyond its ends the profile is extended by straight lines
      s(1) = min(s(1), region%box%y(1) - plane%origin(2))
      s(2) = max(s(2), region%box%y(2) - plane%origin(2))
      dx = sides(1)
      ds = sides(2)
      do doubling = 1, 40
         ! the reference relative to the centre of its element, which may be many elements from the origin
         lead = reference - anint(reference/[dx, ds])*[dx, ds]
         ix = [floor((x(1) + lead(1))/dx) - 1, ceiling((x(2) + lead(1))/dx) + 1]
         iy = [floor((s(1) + lead(2))/ds) - 1, ceiling((s(2) + lead(2))/ds) + 1]
         grid%mx = ix(2) - ix(1) + 1
         grid%my = iy(2) - iy(1) + 1
         if (real(grid%mx, wp)*grid%my < max_elements) exit
         if (grid%mx <= 10 .and. grid%my <= 10) exit
         if (grid%mx > 10) dx = 2.0_wp*dx
         if (grid%my > 10) ds = 2.0_wp*ds
      end do
      grid%dx = dx
      grid%dy = ds
      grid%xl = (ix(1) - 0.5_wp)*dx - lead(1)
      grid%yl = (iy(1) - 0.5_wp)*ds - lead(2)
   end subroutine patch_grid

   !> Arc lengths on the rail from which the section of a patch is followed [mm]: at its reference and in each of the stretches that
   !> were joined in it
   pure subroutine start_places(rail, region, scratch)
      !> The rail in track coordinates
      type(profile_curve), intent(in) :: rail
      !> Region with its joined stretches
      type(contact_region), intent(in) :: region
      !> Workspace; `places` is set
      type(distance_scratch), intent(inout) :: scratch
      integer :: k

      scratch%n = 2
      if (allocated(region%seeds)) scratch%n = 1 + size(region%seeds)
      if (allocated(scratch%places)) then
         if (size(scratch%places) < scratch%n) deallocate(scratch%places)
      end if
      if (.not. allocated(scratch%places)) allocate(scratch%places(max(few_places, scratch%n)))
      scratch%places(1) = rail%s_at(region%y)
      if (allocated(region%seeds)) then
         do k = 1, size(region%seeds)
            scratch%places(k + 1) = rail%s_at(region%seeds(k))
         end do
      else
         scratch%places(2) = rail%s_at(region%seed)
      end if
   end subroutine start_places

   !> Shift the distance of the undeformed bodies to h, whose minimum is zero, and compute the approach
   !>
   !> If the gap decreases from one row to the next by more than possible for one surface, the line along n has met another part of
   !> the rail or wheel, such as a guard rail. This part and what lies beyond it, as seen from the reference, is treated as missing.
   pure subroutine shift_distance(grid, joined, h, approach, left_out)
      !> Size of the grid
      type(potential_contact), intent(in) :: grid
      !> Was the region joined from several? Then any shape is possible between them, and nothing is left out
      logical, intent(in) :: joined
      !> Distance [mm], negative for interpenetration, on entry; shape (mx, my)
      real(wp), contiguous, intent(inout) :: h(:, :)
      !> Maximum interpenetration along n [mm]; negative if the bodies do not touch
      real(wp), intent(out) :: approach
      !> Number of elements that are left out although the bodies would overlap there
      integer, intent(out) :: left_out
      !> Maximum decrease of the gap from row to row: in mm, and relative to the distance of rows
      real(wp), parameter :: largest_fall = 1.0_wp, steepest_fall = 10.0_wp
      integer :: ix, iy, step, centre, known
      logical :: beyond

      left_out = 0
      if (.not. joined .and. .not. falls_slowly(h, max(largest_fall, steepest_fall*grid%dy))) then
         centre = min(max(nint(0.5_wp - grid%yl/grid%dy), 1), grid%my)
         do step = -1, 1, 2
            do ix = 1, grid%mx
               beyond = .false.
               known = 0
               do iy = centre, merge(1, grid%my, step < 0), step
                  if (h(ix, iy) >= 0.5_wp*nothing_there) cycle
                  if (known > 0 .and. .not. beyond) beyond = h(ix, known) - h(ix, iy) &
                     & > max(largest_fall, steepest_fall*grid%dy*abs(iy - known))
                  known = iy
                  if (.not. beyond) cycle
                  if (h(ix, iy) < 0.0_wp) left_out = left_out + 1
                  h(ix, iy) = nothing_there
               end do
            end do
         end do
      end if
      approach = -smallest_of(size(h), h)
      call raise(size(h), approach, h)
   end subroutine shift_distance

   !> Add a number to contiguous ones
   pure subroutine raise(n, by, values)
      integer, intent(in) :: n
      real(wp), intent(in) :: by
      real(wp), intent(inout) :: values(n)

      values = values + by
   end subroutine raise

   !> Do both bodies exist in all elements, and does the gap change by less than a limit from each row to the next?
   pure logical function falls_slowly(h, limit)
      !> See `shift_distance`
      real(wp), contiguous, intent(in) :: h(:, :)
      !> Limit [mm]
      real(wp), intent(in) :: limit

      falls_slowly = .not. largest_of(size(h), h) >= 0.5_wp*nothing_there
      if (falls_slowly .and. size(h, 2) > 1) &
         & falls_slowly = .not. largest_difference(size(h) - size(h, 1), h(:, 2:), h) > limit
   end function falls_slowly

   !> Distance of the undeformed bodies [mm], shifted so that its minimum is zero, and the approach
   subroutine undeformed_distance(rail, wheel, placement, plane, scratch, grid, h, approach, left_out)
      !> The rail in track coordinates
      type(profile_curve), intent(in) :: rail
      !> The wheel in its own coordinates
      type(profile_curve), intent(in) :: wheel
      !> Position of the bodies
      type(wheel_rail_placement), intent(in) :: placement
      !> Plane of the patch, in track coordinates
      type(frame), intent(in) :: plane
      !> Workspace with the arc lengths of `start_places`, from which the section of the rail is followed
      type(distance_scratch), intent(inout) :: scratch
      !> Centres of the elements
      type(potential_contact), intent(in) :: grid
      !> Distance [mm], shape (mx, my)
      real(wp), allocatable, intent(inout) :: h(:, :)
      !> See `shift_distance`
      real(wp), intent(out) :: approach
      !> Number of elements that are left out, see `shift_distance`
      integer, intent(out) :: left_out
      type(frame) :: seen, on_roller
      real(wp) :: s, n_rail
      integer :: ix, iy
      logical :: rolls, found

      if (allocated(h)) then
         if (any(shape(h) /= [grid%mx, grid%my])) deallocate(h)
      end if
      if (.not. allocated(h)) allocate(h(grid%mx, grid%my))
      rolls = placement%roller_radius > 0.0_wp
      if (rolls) then
         call turn_over(rail, scratch%roller)
         ! the plane in the axes of a wheel: z is reversed
         on_roller = new_frame([plane%origin(1:2), -plane%origin(3)], -plane%roll(), 0.0_wp)
         call scratch%roller_rows%begin([grid%x(1), grid%x(grid%mx)], grid%mx, &
            & [rail%s_at(plane%origin(2) + plane%axes(2, 2)*grid%y(1)), 0.0_wp])
         if (allocated(scratch%roller_row)) then
            if (size(scratch%roller_row) < grid%mx) deallocate(scratch%roller_row)
         end if
         if (.not. allocated(scratch%roller_row)) allocate(scratch%roller_row(grid%mx))
      else
         call scratch%section%follow(rail, plane%origin(2:3), plane%roll(), scratch%places(:scratch%n), &
            & [grid%yl - grid%dy, grid%yl + (grid%my + 1)*grid%dy])
      end if
      ! the plane in the axes of the wheel
      seen = placement%wheel%seen_from_here(plane)
      call scratch%rows%begin([grid%x(1), grid%x(grid%mx)], grid%mx, [wheel%s_at(seen%origin(2)), 0.0_wp])
      do iy = 1, grid%my
         s = grid%y(iy)
         call scratch%rows%find(wheel, placement%wheel_radius, seen, s, -nothing_there, h(:, iy))
         if (rolls) then
            associate (row => scratch%roller_row(:grid%mx))
               call scratch%roller_rows%find(scratch%roller, placement%roller_radius, on_roller, s, -nothing_there, row)
               do ix = 1, grid%mx
                  h(ix, iy) = -row(ix) - h(ix, iy)
               end do
            end associate
         else
            n_rail = nothing_there
            call scratch%section%height(rail, s, n_rail, found)
            do ix = 1, grid%mx
               h(ix, iy) = n_rail - h(ix, iy)
            end do
         end if
      end do
      call shift_distance(grid, scratch%n > 2, h, approach, left_out)
   end subroutine undeformed_distance

   !> The profile of a roller as that of a wheel, whose axle is above it
   pure subroutine turn_over(rail, roller)
      !> In track coordinates
      type(profile_curve), intent(in) :: rail
      !> The same with z reversed, without visible parts; its arrays are kept if they have the right size
      type(profile_curve), intent(inout) :: roller

      if (allocated(roller%y%s)) then
         if (size(roller%y%s) /= size(rail%y%s)) deallocate(roller%y%s, roller%y%c, roller%z%s, roller%z%c)
      end if
      if (.not. allocated(roller%y%s)) allocate(roller%y%s, roller%z%s, mold=rail%y%s)
      if (.not. allocated(roller%y%c)) allocate(roller%y%c, roller%z%c, mold=rail%y%c)
      roller%y%s(:) = rail%y%s
      roller%z%s(:) = rail%y%s
      roller%y%c(:, :) = rail%y%c
      roller%z%c(:, :) = -rail%z%c
   end subroutine turn_over
end module contact_wheelrail_flat_patch
