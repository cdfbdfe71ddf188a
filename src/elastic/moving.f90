!> Compliances that compute displacements and their change per step by the same procedure
module contact_elastic_moving
   use contact_base_kinds, only : wp
   use contact_elastic_operator, only : elastic_operator
   implicit none (type, external)
   private

   public :: moving_operator

   !> Parent of the compliances that do not use the products of half-spaces
   type, abstract, extends(elastic_operator) :: moving_operator
   contains
      procedure :: tangential
      procedure :: steady
      procedure :: tangential_by_normal
      procedure :: steady_by_normal
      !> u_t due to tangential tractions, or its change (A - A') p_t
      procedure(from_tangential), deferred :: pair_product
      !> u_t due to pressures, or its change
      procedure(from_normal), deferred :: by_normal
   end type moving_operator

   abstract interface
      !> Both fields have shape (mx, my, 2)
      subroutine from_tangential(self, p, u, change)
         import :: moving_operator, wp
         implicit none (type, external)
         class(moving_operator), intent(inout) :: self
         !> Tangential tractions on body 1 [N/mm2]
         real(wp), contiguous, intent(in) :: p(:, :, :)
         !> Displacement difference [mm]
         real(wp), contiguous, intent(inout) :: u(:, :, :)
         !> Compute the change per step in steady rolling?
         logical, intent(in) :: change
      end subroutine from_tangential

      !> From shape (mx, my) to (mx, my, 2)
      subroutine from_normal(self, p, u, change)
         import :: moving_operator, wp
         implicit none (type, external)
         class(moving_operator), intent(inout) :: self
         !> Pressures [N/mm2], positive in compression
         real(wp), contiguous, intent(in) :: p(:, :)
         !> Displacement difference [mm]
         real(wp), contiguous, intent(inout) :: u(:, :, :)
         !> Compute the change per step in steady rolling?
         logical, intent(in) :: change
      end subroutine from_normal
   end interface

contains

   subroutine tangential(self, p, u)
      class(moving_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      call self%pair_product(p, u, .false.)
   end subroutine tangential

   subroutine steady(self, p, u)
      class(moving_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      call self%pair_product(p, u, .true.)
   end subroutine steady

   subroutine tangential_by_normal(self, p, u)
      class(moving_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      call self%by_normal(p, u, .false.)
   end subroutine tangential_by_normal

   subroutine steady_by_normal(self, p, u)
      class(moving_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      call self%by_normal(p, u, .true.)
   end subroutine steady_by_normal
end module contact_elastic_moving
