!> Undeformed distance of a patch between the rows of its elements, for the estimate of errors
module contact_wheelrail_section_distance
   use contact_base_choices, only : contact_location
   use contact_base_constants, only : excluded_distance, excluded_threshold
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_between_rows, only : has_details, parts, section_details, solve_section
   use contact_patch_workspace, only : pressure_displacement
   use contact_profile_curve, only : profile_curve
   use contact_wheelrail_curved_patch, only : curved_reference, new_curved_reference, straight_reference, surface_heights
   use contact_wheelrail_flat_patch, only : start_places, undeformed_distance
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_gap, only : gap_curve, measure_part
   use contact_wheelrail_geometry, only : place, rail_at, wheel_rail_geometry
   use contact_wheelrail_memory, only : patch_slot, wheel_rail_memory
   use contact_wheelrail_placement, only : wheel_rail_placement
   use contact_wheelrail_problem, only : follows_surface, wheel_rail_problem
   use contact_wheelrail_region, only : far_away, find_deepest
   use contact_wheelrail_regions, only : few_points
   use contact_wheelrail_variable, only : variable_distance
   implicit none (type, external)
   private

   public :: find_details

   !> Fewest rows of elements in which details are sought
   integer, parameter :: fewest_rows = 5
   !> Least error of the angle of a region with fewer intervals of the mesh than few_points, over the change of the inclination
   !> across it: a wheel on one row of elements on the flange (seed 77 of tests/stability/hard_wheels.py) had 0.04
   real(wp), parameter :: small_turn = 0.05_wp

contains

   !> Details between rows of elements in all patches, and the errors of their angles
   subroutine find_details(problem, memory, details, turn)
      !> Profiles, and settings of the search
      type(wheel_rail_problem), intent(in) :: problem
      !> Solved patches; `errors` says whether they have a coarse level
      type(wheel_rail_memory), intent(inout) :: memory
      !> Shape at least that of the patches; not known where details do not matter
      type(section_details), intent(out) :: details(:)
      !> Errors of the angles [rad], 0 without details; shape at least that of the patches
      real(wp), intent(out) :: turn(:)
      type(wheel_rail_placement) :: placement
      type(frame) :: plane
      integer :: k

      turn = 0.0_wp
      placement = memory%geometry%placement
      ! the profile of the rail in the track, and the gap, are those without a vertical deflection
      call place(problem, memory%geometry, memory%z_ws)
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            if (slot%result%errors%reason /= "") cycle
            plane = slot%plane
            slot%plane%origin = plane%origin + (memory%geometry%placement%rail%origin - placement%rail%origin)
            call find_section_details(problem, memory%geometry, slot, details(k), turn(k))
            slot%plane = plane
         end associate
      end do
      call find_turns(problem, memory, turn)
      memory%geometry%placement = placement
   end subroutine find_details

   !> Pressures in the section through the largest one, with the details between rows of elements
   subroutine find_section_details(problem, geometry, slot, details, turn)
      !> Profiles
      type(wheel_rail_problem), intent(in) :: problem
      !> Positions of the bodies
      type(wheel_rail_geometry), intent(inout) :: geometry
      !> Solved patch
      type(patch_slot), intent(inout) :: slot
      !> Not known if details do not matter
      type(section_details), intent(out) :: details
      !> On a curved reference: change of the mean inclination, weighted with the pressures [rad]; otherwise not changed
      real(wp), intent(inout) :: turn
      type(curved_reference) :: curve
      real(wp), allocatable :: h(:), un(:, :)
      integer :: ix

      if (slot%result%ncon == 0 .or. slot%problem%grid%my < fewest_rows) return
      if (.not. slot%problem%solves_for_pressure() .or. allocated(slot%problem%parts)) return
      ix = maxloc(maxval(slot%result%pn, dim=2), dim=1)
      if (allocated(problem%rail_surface)) then
         call find_distance(problem, rail_at(problem, geometry%placement, slot%region%x), geometry, slot, ix, h, curve)
      else
         call find_distance(problem, geometry%rail_in_track, geometry, slot, ix, h, curve)
      end if
      details%column = ix
      details%h = h
      if (.not. has_details(slot%result, ix, h)) return
      allocate(un(slot%problem%grid%mx, slot%problem%grid%my))
      call pressure_displacement(slot%problem, slot%workspace, slot%result%pn, un)
      call solve_section(slot%result, ix, un(ix, :), h, details)
      if (.not. details%known .or. problem%spec%search%location /= contact_location%conformal) return
      turn = sum(details%p*curve%alpha)/sum(details%p) - sum(slot%result%pn(ix, :)*slot%curve%alpha)/sum(slot%result%pn(ix, :))
   end subroutine find_section_details

   !> Changes of the angles of patches if their mean inclinations, or those of the deepest points, were those of a finer mesh: that
   !> of the search for contact does not resolve the inclination of a rough rail
   subroutine find_turns(problem, memory, turn)
      !> Profiles, and settings of the search
      type(wheel_rail_problem), intent(in) :: problem
      !> Solved patches, and the positions of the bodies
      type(wheel_rail_memory), intent(in) :: memory
      !> [rad]; not changed for variable bodies and curved references
      real(wp), intent(inout) :: turn(:)
      type(gap_curve) :: fine
      real(wp) :: lowest, deepest(3), least
      integer :: k, first, last
      logical :: is_small

      associate (geometry => memory%geometry, gap => memory%geometry%gap)
         if (geometry%searches_table .or. problem%spec%search%location == contact_location%conformal) return
         do k = 1, memory%used
            associate (bounds => memory%slot(k)%region%box%y)
               first = max(1, floor((bounds(1) - gap%y(1))/gap%dy) + 1)
               last = min(gap%n, ceiling((bounds(2) - gap%y(1))/gap%dy) + 1)
            end associate
            is_small = memory%slot(k)%region%by_parabola .and. .not. allocated(memory%slot(k)%region%seeds)
            if (is_small) then
               least = 0.0_wp
               if (last - first < few_points) least = small_turn*abs(gap%alpha(last) - gap%alpha(first))
               first = max(1, first - 1)
               last = min(gap%n, last + 1)
            end if
            call measure_part(geometry%rail_in_track, problem%wheel, geometry%placement, gap%y(first), gap%dy/parts, &
               & (last - first)*parts + 1, fine)
            associate (region => memory%slot(k)%region)
               if (problem%spec%search%location == contact_location%first_contact) then
                  call find_deepest(fine, fine%gap, 1, fine%n, lowest, deepest)
                  turn(k) = deepest(3) - region%deepest(3)
               else if (is_small) then
                  call keep_stretch(fine, region%deepest(2))
                  turn(k) = mean_angle(fine, 1, problem%weight_power) - region%deepest(3)
               else
                  turn(k) = mean_angle(fine, 1, problem%weight_power) - mean_angle(fine, parts, problem%weight_power)
               end if
            end associate
            if (is_small) turn(k) = sign(max(abs(turn(k)), least), turn(k))
         end do
      end associate
   end subroutine find_turns

   !> Keep the stretch of interpenetration at a lateral position, and open the gap elsewhere: neighbours are other regions
   pure subroutine keep_stretch(gap, y)
      !> Gap at the present height
      type(gap_curve), intent(inout) :: gap
      !> [mm], track coordinates
      real(wp), intent(in) :: y
      integer :: i, first, last

      i = minloc(abs(gap%y(:gap%n) - y), dim=1)
      if (.not. gap%gap(i) < 0.0_wp) return
      first = findloc(gap%gap(:i) < 0.0_wp, .false., dim=1, back=.true.) + 1
      last = i - 1 + findloc([gap%gap(i:gap%n) < 0.0_wp, .false.], .false., dim=1) - 1
      gap%gap(:first - 1) = far_away
      gap%gap(last + 1:gap%n) = far_away
   end subroutine keep_stretch

   !> Mean inclination of the rail where the bodies overlap, weighted as in contact_wheelrail_region [rad]
   pure real(wp) function mean_angle(gap, step, weight_power) result(angle)
      !> Gap at the present height
      type(gap_curve), intent(in) :: gap
      !> Each point of this number is used
      integer, intent(in) :: step
      !> Power of the overlap, 1 or 2
      integer, intent(in) :: weight_power
      real(wp) :: w, total
      integer :: i

      angle = 0.0_wp
      total = 0.0_wp
      do i = 1, gap%n, step
         if (.not. gap%gap(i) < 0.0_wp) cycle
         w = (-gap%gap(i))**weight_power*sqrt(-gap%gap(i))
         total = total + w
         angle = angle + w*gap%alpha(i)
      end do
      if (total > 0.0_wp) angle = angle/total
   end function mean_angle

   !> Undeformed distance at several points of each element of a column
   subroutine find_distance(problem, rail, geometry, slot, ix, h, curve)
      type(wheel_rail_problem), intent(in) :: problem
      !> Section in track coordinates, at the reference; may be that of `geometry`, which is not changed then
      type(profile_curve), intent(in) :: rail
      type(wheel_rail_geometry), intent(inout) :: geometry
      type(patch_slot), intent(inout) :: slot
      !> Column
      integer, intent(in) :: ix
      !> Distance [mm] with the zero of that of the elements, shape (parts*my)
      real(wp), allocatable, intent(out) :: h(:)
      !> Reference at these points, if it is not the plane
      type(curved_reference), intent(out) :: curve
      real(wp), allocatable :: distance(:, :), on_rail(:, :), on_wheel(:, :)
      type(potential_contact) :: line
      real(wp) :: approach
      integer :: iy, left_out

      line = slot%problem%grid
      line%xl = line%xl + (ix - 1)*line%dx
      line%mx = 1
      line%my = parts*line%my
      line%dy = line%dy/parts
      if (follows_surface(problem)) then
         if (problem%spec%search%location == contact_location%conformal) then
            curve = new_curved_reference(rail, geometry%bodies, slot%plane, line)
         else
            curve = straight_reference(slot%plane, line)
         end if
         call surface_heights(geometry%bodies, curve, line, on_rail, on_wheel)
         distance = on_rail - on_wheel
      else if (geometry%searches_table) then
         call variable_distance(geometry%bodies, slot%plane, allocated(slot%region%seeds), line, distance, approach, left_out)
      else
         call start_places(rail, slot%region, slot%distance)
         call undeformed_distance(rail, problem%wheel, geometry%placement, slot%plane, slot%distance, line, distance, approach, &
            & left_out)
      end if
      iy = minloc(slot%problem%h(ix, :), dim=1)
      h = distance(1, :) + (slot%problem%h(ix, iy) - distance(1, parts*(iy - 1) + (parts + 1)/2))
      do iy = 1, slot%problem%grid%my
         if (slot%problem%h(ix, iy) > excluded_threshold) h(parts*(iy - 1) + 1:parts*iy) = excluded_distance
      end do
   end subroutine find_distance
end module contact_wheelrail_section_distance
