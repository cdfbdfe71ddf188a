!> Patches of several parts with reduced interaction between them
!>
!> Two contact areas of wheel and rail that are close to each other form one problem before they merge: the displacement in part
!> p due to pressures in part q is that of the half-space times a factor f(p, q) between 0 and 1, symmetric, with f(p, p) = 1.
module contact_normal_parts
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   implicit none (type, external)
   private

   public :: contact_parts, displacement_between

   !> Parts of a patch
   type :: contact_parts
      !> Index of the part to which an element belongs, 0: none, shape (mx, my)
      integer, allocatable :: label(:, :)
      !> Factors, shape (parts, parts)
      real(wp), allocatable :: interaction(:, :)
   contains
      !> Normal displacements due to pressures
      procedure :: displacement
   end type contact_parts

contains

   !> Normal displacements due to pressures, in one part or several
   subroutine displacement_between(parts, operator, p, u)
      !> Unallocated: full interaction
      type(contact_parts), allocatable, intent(in) :: parts
      !> Prepared for the window
      class(compliance), intent(inout) :: operator
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Normal displacement differences [mm]
      real(wp), contiguous, intent(inout) :: u(:, :)

      if (allocated(parts)) then
         call parts%displacement(operator, p, u)
      else
         call operator%normal(p, u)
      end if
   end subroutine displacement_between

   subroutine displacement(self, operator, p, u)
      class(contact_parts), intent(in) :: self
      !> Prepared for the window
      class(compliance), intent(inout) :: operator
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Normal displacement differences [mm]; 0 outside the parts
      real(wp), contiguous, intent(inout) :: u(:, :)
      real(wp), allocatable :: own(:, :), due(:, :)
      integer :: q, ix, iy

      allocate(own, due, mold=p)
      u = 0.0_wp
      do q = 1, size(self%interaction, 2)
         own = merge(p, 0.0_wp, self%label == q)
         call operator%normal(own, due)
         do iy = 1, size(p, 2)
            do ix = 1, size(p, 1)
               if (self%label(ix, iy) > 0) u(ix, iy) = u(ix, iy) + self%interaction(self%label(ix, iy), q)*due(ix, iy)
            end do
         end do
      end do
   end subroutine displacement
end module contact_normal_parts
