!> Mathematical constants, and the markers of excluded elements
module contact_base_constants
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   !> Ratio of the circumference of a circle to its diameter
   real(wp), parameter, public :: pi = 3.141592653589793238462643383279502884_wp
   !> N mm per joule, and N mm/s per watt
   real(wp), parameter, public :: nmm_per_joule = 1000.0_wp
   !> Undeformed distance assigned to elements that a planform excludes from contact [mm]
   real(wp), parameter, public :: excluded_distance = 1.0e30_wp
   !> Elements with larger undeformed distances are excluded [mm]
   real(wp), parameter, public :: excluded_threshold = 1.0e29_wp
end module contact_base_constants
