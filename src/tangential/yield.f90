!> Plastic shearing near the surface: a yield limit with linear hardening or softening
!>
!> Let D be the slip per step of an element without yielding. It is divided into plastic shearing du and slip S, D = S - du,
!> both along the traction: du = l n, S = -s n, n = p/|p|, l, s >= 0. The traction does not exceed the friction bound g and the
!> yield limit t = t' + k l; slip requires |p| = g, yielding |p| = t. Hence |p| depends only on m = |D| = l + s:
!>
!>     t' >= g:   |p| = g                                        (the element slips, it does not yield)
!>     t' <  g:   |p| = t' + k m, not above g (slip takes over), not below the lowest limit
!>
!> and with any r > max(0, -k) all conditions are one equation, p = P(p - r D), where P shortens z = p - r D: the return map of
!> plasticity (Simo and Hughes 1998). Without hardening, k = 0, it is the projection onto the disc of radius min(g, t'); such
!> problems need only this bound, and the states of their elements are determined afterwards.
module contact_tangential_yield
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   implicit none (type, external)
   private

   public :: yield_data, yield_point, return_map

   !> Yield limits of the material in the elements
   type :: yield_data
      !> Limit before the step [N/mm2], shape (mx, my). In steady rolling only the values on the leading side are used, those of
      !> the incoming material.
      real(wp), allocatable :: limit(:, :)
      !> Slope k: increase of the limit with the plastic displacement [N/mm3]; 0: none
      real(wp) :: slope = 0.0_wp
      !> Softening ends at this limit [N/mm2]
      real(wp) :: lowest = 0.0_wp
   end type yield_data

   !> Result of the return map for a vector, and its derivatives
   type :: yield_point
      !> Member of element: adhesion, slip or plastic
      integer :: state = element%adhesion
      !> Length of the result |p| [N/mm2]
      real(wp) :: radius = 0.0_wp
      !> Plastic displacement l [mm]
      real(wp) :: plastic = 0.0_wp
      !> Yield limit after the step [N/mm2]
      real(wp) :: limit = 0.0_wp
      !> Derivatives of the radius with respect to the length |z| and to the limit before the step
      real(wp) :: radius_by_length = 1.0_wp, radius_by_limit = 0.0_wp
      !> The same derivatives of the limit after the step
      real(wp) :: limit_by_length = 0.0_wp, limit_by_limit = 1.0_wp
   end type yield_point

contains

   !> The return map P for a vector z of given length
   elemental function return_map(length, bound, before, slope, lowest, r) result(point)
      !> |z|, friction bound, yield limit before the step [N/mm2]
      real(wp), intent(in) :: length, bound, before
      !> Slope and lower limit as in yield_data
      real(wp), intent(in) :: slope, lowest
      !> Scale of the slip [(N/mm2)/mm], above max(0, -slope)
      real(wp), intent(in) :: r
      type(yield_point) :: point
      real(wp) :: share

      point%limit = before
      if (length <= min(bound, before)) then
         point%radius = length
         return
      end if
      point%radius_by_length = 0.0_wp
      point%state = element%slip
      point%radius = bound
      if (before >= bound) return

      share = slope/(slope + r)
      point%radius = before + share*(length - before)
      if (point%radius >= bound) then
         ! hardened up to the friction bound; the remainder is slip
         point%radius = bound
         point%plastic = (bound - before)/slope
         point%limit = bound
         point%limit_by_limit = 0.0_wp
         return
      end if
      point%state = element%plastic
      if (point%radius <= lowest .and. slope < 0.0_wp) then
         point%radius = lowest
         point%limit_by_limit = 0.0_wp
      else
         point%radius_by_length = share
         point%radius_by_limit = 1.0_wp - share
         point%limit_by_length = share
         point%limit_by_limit = 1.0_wp - share
      end if
      point%limit = point%radius
      point%plastic = (length - point%radius)/r
   end function return_map
end module contact_tangential_yield
