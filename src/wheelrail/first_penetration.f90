!> Penetration under a force, estimated by Hertz's theory before any pressure is known
module contact_wheelrail_first_penetration
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: hertz_penetration, min_penetration

   !> Minimum penetration [mm]
   real(wp), parameter :: min_penetration = 1.0e-6_wp
   !> Minimum mean curvature [1/mm]; without curvature Hertz's theory gives zero penetration
   real(wp), parameter :: min_curvature = 1.0e-8_wp

contains

   !> Penetration of a body of revolution [mm], (9 F**2/(16 E**2 R))**(1/3) with 1/R = 2 b
   pure real(wp) function hertz_penetration(load, b) result(pen)
      !> Force over G/(1 - nu) [mm2]
      real(wp), intent(in) :: load
      !> Geometric mean of half the second derivatives of the gap along and across the track [1/mm]
      real(wp), intent(in) :: b

      pen = max((0.75_wp*load*sqrt(2.0_wp*max(b, min_curvature)))**(2.0_wp/3.0_wp), min_penetration)
   end function hertz_penetration
end module contact_wheelrail_first_penetration
