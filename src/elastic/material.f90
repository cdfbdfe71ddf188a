!> Combined elastic constants of two bodies in contact
module contact_elastic_material
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: combined_material, combine, coupling_threshold

   !> For smaller |K| the normal and tangential problems are uncoupled [-]
   real(wp), parameter :: coupling_threshold = 1.0e-6_wp

   !> Combined constants of the two bodies
   type :: combined_material
      !> Combined modulus of rigidity [N/mm2], Poisson ratio [-], difference parameter K [-]
      real(wp) :: gg = 1.0_wp, nu = 0.0_wp, ak = 0.0_wp
   contains
      !> Are normal and tangential problems coupled?
      procedure :: coupled
      procedure :: same_as
   end type combined_material

contains

   !> Combine constants after Kalker (1990): 1/G and nu/G are means over the bodies, K/G is half their difference of (1 - 2
   !> nu)/(2 G)
   pure function combine(poiss, gg) result(material)
      !> Poisson ratios [-] and moduli of rigidity [N/mm2] of bodies 1 and 2
      real(wp), intent(in) :: poiss(2), gg(2)
      type(combined_material) :: material

      material%gg = 2.0_wp/(1.0_wp/gg(1) + 1.0_wp/gg(2))
      material%nu = 0.5_wp*material%gg*(poiss(1)/gg(1) + poiss(2)/gg(2))
      material%ak = 0.25_wp*material%gg*((1.0_wp - 2.0_wp*poiss(1))/gg(1) - (1.0_wp - 2.0_wp*poiss(2))/gg(2))
   end function combine

   elemental logical function coupled(self)
      class(combined_material), intent(in) :: self
      coupled = abs(self%ak) >= coupling_threshold
   end function coupled

   elemental logical function same_as(self, other)
      class(combined_material), intent(in) :: self
      !> Constants to compare, bit by bit
      type(combined_material), intent(in) :: other
      same_as = self%gg == other%gg .and. self%nu == other%nu .and. self%ak == other%ak
   end function same_as
end module contact_elastic_material
