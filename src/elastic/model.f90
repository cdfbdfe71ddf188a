!> What kind of surface two bodies form in contact: everything that a compliance is made from
module contact_elastic_model
   use contact_base_choices, only : kernel_model
   use contact_base_kinds, only : wp
   use contact_elastic_material, only : combined_material
   implicit none (type, external)
   private

   public :: elastic_model

   !> Elasticity of a pair of bodies; the plain value means homogeneous half-spaces
   type :: elastic_model
      type(combined_material) :: material
      !> Influence coefficients, one of kernel_model
      integer :: kernel = kernel_model%piecewise_constant
      !> Tangential displacement in a thin layer between the bodies per unit traction [mm3/N]; 0: no layer
      real(wp) :: layer = 0.0_wp
   contains
      !> Do normal and tangential tractions interact?
      procedure :: coupled
      !> Would both give the same coefficients?
      procedure :: same_as
   end type elastic_model

contains

   elemental logical function coupled(self)
      class(elastic_model), intent(in) :: self
      coupled = self%material%coupled()
   end function coupled

   elemental logical function same_as(self, other) result(same)
      class(elastic_model), intent(in) :: self
      type(elastic_model), intent(in) :: other

      same = self%material%gg == other%material%gg .and. self%material%nu == other%material%nu &
         & .and. self%material%ak == other%material%ak .and. self%kernel == other%kernel .and. self%layer == other%layer
   end function same_as
end module contact_elastic_model
