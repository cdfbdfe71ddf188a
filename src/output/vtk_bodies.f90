!> Surfaces of rail, roller and wheel near the contact as points of a grid, in track coordinates, wheel on the right side
module contact_output_vtk_bodies
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_profile_curve, only : profile_curve
   use contact_profile_surface, only : profile_surface, surface_cut
   use contact_wheelrail_frame, only : frame, new_frame
   use contact_wheelrail_result, only : wheel_rail_result
   implicit none (type, external)
   private

   public :: body_points, body_profile, get_section

   !> Profile of a body, and its surface if it varies
   type :: body_profile
      type(profile_curve), pointer :: profile => null()
      type(profile_surface), pointer :: surface => null()
   end type body_profile

   !> Number of points of a section, equidistant in arc length
   integer, parameter :: section_points = 150
   !> Length of rail on either side of the wheel [mm]; distance between sections of a variable rail [mm]
   real(wp), parameter :: rail_length = 150.0_wp, rail_step = 10.0_wp
   !> Number of sections of a wheel, and of the part of a roller below it
   integer, parameter :: wheel_sections = 73, roller_sections = 25
   !> Angular range of the roller on either side of its top [rad]
   real(wp), parameter :: roller_angle = pi/6.0_wp

contains

   !> Points of the surface of a body, shape (3, points along the section, sections); no sections if there is no surface
   subroutine body_points(spec, pair, profile, is_wheel, points)
      !> The case
      type(case_spec), intent(in) :: spec
      !> Result, for the positions of the markers
      type(wheel_rail_result), intent(in) :: pair
      !> Profile, or surface, of the body
      type(body_profile), intent(in) :: profile
      !> Is it the wheel? Otherwise the rail
      logical, intent(in) :: is_wheel
      !> Points in track coordinates [mm]
      real(wp), allocatable, intent(out) :: points(:, :, :)
      type(profile_curve), allocatable :: section
      type(frame) :: marker
      real(wp) :: s(2), place, point(2)
      integer :: i, k, n

      associate (w => spec%wheel_rail)
         if (is_wheel) then
            n = wheel_sections
            marker = new_frame([pair%wheel_x, pair%wheel_y, pair%wheel_z], pair%wheel_roll, pair%wheel_yaw)
         else
            n = 2
            if (associated(profile%surface)) n = 1 + nint(2.0_wp*rail_length/rail_step)
            if (w%roller) n = roller_sections
            marker = new_frame([0.0_wp, pair%rail_y, pair%rail_z], pair%rail_roll, 0.0_wp)
         end if
         allocate(points(3, section_points, n))
         do k = 1, n
            place = 2.0_wp*(k - 1)/(n - 1) - 1.0_wp
            if (is_wheel) then
               place = pi*place
               call get_section(profile%profile, profile%surface, place - w%wheelset%pitch_of_wheel(), section)
            else if (w%roller) then
               place = roller_angle*place
               call get_section(profile%profile, profile%surface, w%wheelset%s, section)
            else
               place = pair%wheel_x + rail_length*place
               call get_section(profile%profile, profile%surface, w%wheelset%s + place, section)
            end if
            if (.not. allocated(section)) then
               deallocate(points)
               allocate(points(3, section_points, 0))
               return
            end if
            s = section%s_range()
            do i = 1, section_points
               associate (at => s(1) + (s(2) - s(1))*(i - 1)/(section_points - 1))
                  point = [section%y%value(at), section%z%value(at)]
               end associate
               points(:, i, k) = in_track(point, place)
            end do
         end do
      end associate

   contains

      !> Track coordinates of a point of a section [mm]
      pure function in_track(point, place) result(there)
         !> y, z in profile coordinates [mm]
         real(wp), intent(in) :: point(2)
         !> Angle about the axle [rad], or x [mm]
         real(wp), intent(in) :: place
         real(wp) :: there(3)

         associate (w => spec%wheel_rail)
            if (is_wheel) then
               associate (radius => w%wheelset%nomradw + point(2))
                  there = marker%to_parent([radius*sin(place), point(1), radius*cos(place) - w%wheelset%nomradw])
               end associate
            else
               there = marker%to_parent([0.0_wp, point(1), point(2)])
               if (w%roller) then
                  there([1, 3]) = [0.0_wp, w%track%nomradr] + (w%track%nomradr - there(3))*[sin(place), -cos(place)]
               else
                  there(1) = place
               end if
            end if
         end associate
      end function in_track
   end subroutine body_points

   !> Profile of a body; for a variable profile the section at a position
   subroutine get_section(profile, surface, position, curve)
      !> Profile of a body that does not vary
      type(profile_curve), intent(in) :: profile
      !> Surface of a body that varies
      type(profile_surface), intent(in), optional :: surface
      !> Position along the rail [mm], around the wheel [rad]
      real(wp), intent(in) :: position
      !> Unallocated if the surface has no section there
      type(profile_curve), allocatable, intent(out) :: curve
      type(surface_cut) :: there

      if (.not. present(surface)) then
         allocate(curve, source=profile)
         return
      end if
      call surface%continued(position, there)
      if (there%present) allocate(curve, source=there%curve)
   end subroutine get_section
end module contact_output_vtk_bodies
