!> Points of profiles: along a curve, and along lines of a surface
module contact_profile_sampling
   use contact_base_kinds, only : wp
   use contact_profile_curve, only : profile_curve
   use contact_profile_surface, only : profile_surface, surface_cut
   implicit none (type, external)
   private

   public :: curve_positions, line_kind, line_point, no_point, no_point_along

   type :: line_kind_list
      !> Constant u with v varying; constant v or constant y with u varying
      integer :: at_u = 1, at_v = 2, at_y = 3
   end type line_kind_list
   !> Lines on a surface
   type(line_kind_list), parameter :: line_kind = line_kind_list()

   !> Placeholders for missing points, on lines of constant u and on others [mm]
   real(wp), parameter :: no_point_along = 99.0e9_wp, no_point = 999.0_wp

contains

   !> Arc lengths of points along a curve [mm]
   pure subroutine curve_positions(curve, parts, step, s)
      !> Curve whose pieces are subdivided
      type(profile_curve), intent(in) :: curve
      !> Number of parts of each piece of the spline; 1: constant steps instead; 0 and less: the ends of the pieces
      integer, intent(in) :: parts
      !> Constant step [mm]
      real(wp), intent(in) :: step
      !> Increasing, from the first end on [mm]
      real(wp), allocatable, intent(out) :: s(:)
      integer :: i, n

      associate (nodes => curve%y%s)
         n = size(nodes)
         select case (parts)
         case (:0)
            s = nodes
         case (1)
            s = [(nodes(1) + i*step, i=0, int((nodes(n) - nodes(1))/step))]
         case default
            allocate(s(parts*(n - 1) + 1))
            do i = 0, parts - 1
               s(1 + i:size(s) - 1:parts) = nodes(:n - 1) + i*(nodes(2:) - nodes(:n - 1))/parts
            end do
            s(size(s)) = nodes(n)
         end select
      end associate
   end subroutine curve_positions

   !> A point of a line on a surface
   subroutine line_point(surface, kind, place, position, y, z)
      !> Surface through the slices of a rail or a wheel
      type(profile_surface), intent(in) :: surface
      !> Member of line_kind
      integer, intent(in) :: kind
      !> Constant and varying coordinate
      real(wp), intent(in) :: place, position
      !> Coordinates [mm]; placeholder if there is no point
      real(wp), intent(out) :: y, z
      type(surface_cut) :: section
      logical :: found

      call surface%cut(merge(place, position, kind == line_kind%at_u), section)
      select case (kind)
      case (line_kind%at_u)
         call section%on_line(position, y, z, found)
         if (found) return
         y = no_point_along
         z = no_point_along
      case (line_kind%at_v)
         call section%on_line(place, y, z, found)
         if (found) return
         y = no_point
         z = no_point
      case default
         y = place
         z = no_point
         if (.not. section%present) return
         if (section%curve%has(place)) z = section%curve%height(place)
      end select
   end subroutine line_point
end module contact_profile_sampling
