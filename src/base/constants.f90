!> Mathematical constants and the sentinels shared by grid functions
module contact_base_constants
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   !> Ratio of circumference and diameter
   real(wp), parameter, public :: pi = 3.141592653589793238462643383279502884_wp
   !> N mm in a joule, and N mm/s in a watt
   real(wp), parameter, public :: nmm_per_joule = 1000.0_wp
   !> Undeformed distance of elements that a planform excludes from contact [mm]
   real(wp), parameter, public :: excluded_distance = 1.0e30_wp
   !> Undeformed distances above this value mean "excluded" [mm]
   real(wp), parameter, public :: excluded_threshold = 1.0e29_wp
end module contact_base_constants
