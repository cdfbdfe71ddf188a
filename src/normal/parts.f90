!> Patches of several parts between which pressures act with less than full strength
!>
!> Two contact areas of wheel and rail that come close to each other are one problem before they meet: the
!> displacement in part p by pressures in part q is that of the half-space times a factor f(p, q) between
!> 0 and 1, symmetric, f(p, p) = 1.
module contact_normal_parts
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   implicit none (type, external)
   private

   public :: contact_parts, displacement_between

   !> The parts of a patch
   type :: contact_parts
      !> Number of the part that an element belongs to, 0 for none, shape (mx, my)
      integer, allocatable :: label(:, :)
      !> Factors, shape (parts, parts)
      real(wp), allocatable :: interaction(:, :)
   contains
      !> Normal displacements by pressures
      procedure :: displacement
   end type contact_parts

contains

   !> Normal displacements by pressures, in one part or several
   subroutine displacement_between(parts, operator, p, u)
      !> Unallocated: everything acts with full strength
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
