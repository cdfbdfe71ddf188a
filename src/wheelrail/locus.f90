!> The contact locus: points at which the surface of a round wheel is level along the track, or has the slope of a roller
module contact_wheelrail_locus
   use contact_base_kinds, only : wp
   use contact_profile_curve, only : profile_curve
   use contact_wheelrail_gap_survey, only : along_accuracy, furthest, lateral_accuracy, steepest
   use contact_wheelrail_placement, only : wheel_rail_placement
   implicit none (type, external)
   private

   public :: locus_at, locus_in_piece, locus_point

contains

   !> Point of the locus at a position on the wheel's profile, in track coordinates [mm]
   !>
   !> On a track the normal of the surface of revolution is perpendicular to the track there; on a roller, wheel and roller have the
   !> same slope along it. See doc/theory/wheel_rail.md.
   function locus_in_piece(wheel, placement, piece, place, rail) result(point)
      !> Profile of a round wheel in its own coordinates
      type(profile_curve), intent(in) :: wheel
      !> Position of the bodies
      type(wheel_rail_placement), intent(in) :: placement
      !> Piece of the profile
      integer, intent(in) :: piece
      !> Position in the piece, from its beginning [mm]
      real(wp), intent(in) :: place
      !> Profile of a roller in track coordinates; not used on a track
      type(profile_curve), intent(in) :: rail
      real(wp) :: point(3)
      real(wp) :: radius, lean, x, y, z, across, before, fall, drop
      logical :: on_roller
      integer :: step

      on_roller = placement%roller_radius > 0.0_wp
      associate (cy => wheel%y%c, cz => wheel%z%c)
         y = cy(0, piece) + place*(cy(1, piece) + place*(cy(2, piece) + place*cy(3, piece)))
         z = cz(0, piece) + place*(cz(1, piece) + place*(cz(2, piece) + place*cz(3, piece)))
         across = cy(1, piece) + place*(2.0_wp*cy(2, piece) + place*3.0_wp*cy(3, piece))
         lean = cz(1, piece) + place*(2.0_wp*cz(2, piece) + place*3.0_wp*cz(3, piece))
      end associate
      radius = placement%wheel_radius + z
      lean = radius*(lean/min(steepest, across))
      associate (axes => placement%wheel%axes)
         x = 0.0_wp
         do step = 1, 20
            before = x
            drop = depth(x)
            fall = 0.0_wp
            if (on_roller) then
               point = placement%wheel%to_parent([x, y, drop - placement%wheel_radius])
               fall = roller_slope(placement, point(1), rail%height(point(2)))
            end if
            ! the normal (x, -lean, depth) in the track has no component along (1, 0, fall)
            x = ((axes(1, 2) + fall*axes(3, 2))*lean - (axes(1, 3) + fall*axes(3, 3))*drop)/(axes(1, 1) + fall*axes(3, 1))
            if (on_roller) x = before + (x - before)/(1.0_wp + drop/axle_depth(point))
            x = max(-furthest*placement%wheel_radius, min(furthest*placement%wheel_radius, x))
            ! the depth has no effect if a wheel is upright on a track
            if (.not. (on_roller .or. abs(axes(1, 3)) > 0.0_wp)) exit
            ! every step is smaller than the previous one by a factor of the square of the yaw angle
            if (abs(x - before) <= along_accuracy*placement%wheel_radius) exit
         end do
      end associate
      drop = depth(x) - placement%wheel_radius
      associate (axes => placement%wheel%axes)
         point = placement%wheel%origin + (axes(:, 1)*x + axes(:, 2)*y + axes(:, 3)*drop)
      end associate

   contains

      !> Depth below the axle of the point of this circle at a position along it [mm]
      pure real(wp) function depth(x)
         real(wp), intent(in) :: x
         depth = sqrt(radius**2 - x**2)
      end function depth

      !> Height of a point of the track above the axle of the roller, at least `lowest_on_roller` [mm]
      pure real(wp) function axle_depth(point)
         real(wp), intent(in) :: point(3)
         axle_depth = max(placement%lowest_on_roller(), placement%roller_radius - point(3))
      end function axle_depth
   end function locus_in_piece

   !> The same for an arc length on the profile
   function locus_point(wheel, placement, s, rail) result(point)
      !> Profile of a round wheel in its own coordinates
      type(profile_curve), intent(in) :: wheel
      !> Position of the bodies
      type(wheel_rail_placement), intent(in) :: placement
      !> Arc length on the profile [mm]
      real(wp), intent(in) :: s
      !> As for `locus_in_piece`
      type(profile_curve), intent(in) :: rail
      real(wp) :: point(3)
      real(wp) :: place
      integer :: piece

      call wheel%y%place(s, piece, place)
      point = locus_in_piece(wheel, placement, piece, place, rail)
   end function locus_point

   !> Slope of a roller's surface along the track, dz/dx, at a distance from its top
   pure real(wp) function roller_slope(placement, x, z) result(slope)
      type(wheel_rail_placement), intent(in) :: placement
      !> Longitudinal position, and height of its profile there [mm]
      real(wp), intent(in) :: x, z
      real(wp) :: rho

      rho = placement%roller_radius - z
      slope = x/sqrt(max(tiny(rho), rho**2 - x**2))
   end function roller_slope

   !> Point of the locus with a given lateral position on a piece of the profile, by the Illinois method
   function locus_at(wheel, placement, rail, y, piece, y_high, y_low) result(point)
      !> Profile of a round wheel in its own coordinates
      type(profile_curve), intent(in) :: wheel
      !> Position of the bodies
      type(wheel_rail_placement), intent(in) :: placement
      !> See `locus_in_piece`
      type(profile_curve), intent(in) :: rail
      !> Lateral position in the track [mm]
      real(wp), intent(in) :: y
      !> Number of the piece
      integer, intent(in) :: piece
      !> Lateral positions of its ends [mm], y_low <= y <= y_high
      real(wp), intent(in) :: y_high, y_low
      real(wp) :: point(3)
      real(wp) :: a, b, fa, fb, s, f
      integer :: step, side, here

      a = wheel%y%s(piece)
      b = wheel%y%s(piece + 1)
      fa = y_high - y
      fb = y_low - y
      side = 0
      s = a
      if (abs(fb) < abs(fa)) s = b
      do step = 1, 60
         if (abs(fa - fb) > 0.0_wp) s = (a*fb - b*fa)/(fb - fa)
         ! the end of a piece is part of the next one
         here = piece
         if (s >= wheel%y%s(piece + 1)) here = min(piece + 1, size(wheel%y%s) - 1)
         point = locus_in_piece(wheel, placement, here, s - wheel%y%s(here), rail)
         f = point(2) - y
         if (abs(f) <= lateral_accuracy) exit
         if ((f > 0.0_wp) .eqv. (fa > 0.0_wp)) then
            a = s
            fa = f
            if (side == 1) fb = 0.5_wp*fb
            side = 1
         else
            b = s
            fb = f
            if (side == -1) fa = 0.5_wp*fa
            side = -1
         end if
      end do
   end function locus_at
end module contact_wheelrail_locus
