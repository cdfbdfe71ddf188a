!> Contact that ends where a profile ends
!>
!> Beyond the last point of a profile nothing is known: contact that would go on there is cut off, and its pressures are those
!> of a sharp edge.
module contact_wheelrail_profile_ends
   use contact_base_constants, only : excluded_threshold
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_patch_result, only : border_contact
   use contact_profile_curve, only : profile_curve
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_geometry, only : pair_geometry
   use contact_wheelrail_memory, only : patch_slot
   use contact_wheelrail_problem, only : pair_problem
   implicit none (type, external)
   private

   public :: mark_profile_ends

   !> Undeformed distances above this value stand for a surface that is missing [mm]; those above excluded_threshold for
   !> elements that may not touch, whatever the surfaces do
   real(wp), parameter :: missing = 500.0_wp

contains

   !> Which ends of the profiles contact reaches: in the next element along y a surface is missing, and the end is near;
   !> where none is near, the surface goes on unseen
   subroutine mark_profile_ends(problem, here, slot, border)
      type(pair_problem), intent(in) :: problem
      type(pair_geometry), intent(in) :: here
      !> Solved
      type(patch_slot), intent(in) :: slot
      !> `surface_end`, `hidden` and `pressure` are set; body 1 is the rail
      type(border_contact), intent(inout) :: border
      !> Elements between the centre of the element without surface and the end, at most
      real(wp), parameter :: nearest = 2.0_wp
      real(wp) :: ends(2, 2, 2), distance(2, 2)
      integer :: found(2), ix, iy, next, side
      logical :: known

      if (slot%result%ncon == 0) return
      known = .false.
      associate (grid => slot%problem%grid, h => slot%problem%h, result => slot%result)
         do iy = 1, grid%my
            do ix = 1, grid%mx
               if (result%division(ix, iy) == element%exterior) cycle
               do side = -1, 1, 2
                  next = iy + side
                  if (next >= 1 .and. next <= grid%my) then
                     if (h(ix, next) < missing .or. h(ix, next) > excluded_threshold) cycle
                  end if
                  if (.not. known) call find_ends(problem, here, ends)
                  known = .true.
                  distance = norm2(ends - spread(spread(point_of(slot, next), 2, 2), 3, 2), dim=1)
                  found = minloc(distance)
                  if (distance(found(1), found(2)) <= nearest*grid%dy) then
                     border%surface_end(found(1), found(2)) = .true.
                  else if (next >= 1 .and. next <= grid%my) then
                     border%hidden = .true.
                  else
                     cycle
                  end if
                  border%pressure = max(border%pressure, result%pn(ix, iy))
               end do
            end do
         end do
      end associate
   end subroutine mark_profile_ends

   !> Lateral position and height of the ends in track coordinates [mm]: (y z, low and high end, rail and wheel)
   subroutine find_ends(problem, here, ends)
      type(pair_problem), intent(in) :: problem
      type(pair_geometry), intent(in) :: here
      real(wp), intent(out) :: ends(2, 2, 2)
      real(wp) :: point(3)
      integer :: k

      do k = 1, 2
         ends(:, k, 1) = end_of(here%rail_in_track, k)
         point = here%placement%wheel%to_parent([0.0_wp, end_of(problem%wheel, k)])
         ends(:, k, 2) = point(2:3)
      end do
   end subroutine find_ends

   !> y and z of an end of a profile [mm]
   pure function end_of(curve, k) result(point)
      type(profile_curve), intent(in) :: curve
      !> 1: the end of the lower y, 2: the other one
      integer, intent(in) :: k
      real(wp) :: point(2)
      real(wp) :: range(2), y(2), z(2), slope(2)
      integer :: i

      range = curve%s_range()
      do i = 1, 2
         call curve%point(range(i), y(i), z(i), slope(1), slope(2))
      end do
      i = merge(k, 3 - k, y(1) <= y(2))
      point = [y(i), z(i)]
   end function end_of

   !> Lateral position and height of a row of elements on the reference surface, in track coordinates [mm]
   pure function point_of(slot, iy) result(point)
      type(patch_slot), intent(in) :: slot
      !> May lie one row outside the grid
      integer, intent(in) :: iy
      real(wp) :: point(2)
      real(wp) :: place(3)
      type(frame) :: row
      integer :: inside

      if (allocated(slot%curve)) then
         inside = min(max(iy, 1), slot%problem%grid%my)
         row = slot%curve%row_axes(inside)
         place = row%to_parent([0.0_wp, (iy - inside)*slot%problem%grid%dy, 0.0_wp])
      else
         place = slot%plane%to_parent([0.0_wp, slot%problem%grid%y(iy), 0.0_wp])
      end if
      point = place(2:3)
   end function point_of
end module contact_wheelrail_profile_ends
