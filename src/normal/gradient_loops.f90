!> Loops over the elements of a window, used by conjugate gradients between two products
!>
!> Each of them passes memory once. Fields come as vectors of n elements; threads share long ones by pieces. The loops over a
!> piece are in gradient_loops.c.
module contact_normal_gradient_loops
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use contact_base_kinds, only : wp
   use contact_numeric_pieces, only : first_of, length_of, most_pieces, pieces_of
   implicit none (type, external)
   private

   public :: choose_free, go_along, mean_gap, mean_of_free, project, residuals, turn_direction

   interface
      !> Sum of the distances after deformation over elements with pressure, and their number
      pure subroutine mean_gap_piece(n, h, u, p, sums) bind(c, name="contact_gradient_gap_sums")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Undeformed distances, displacements [mm], and pressures [N/mm2]
         real(c_double), intent(in) :: h(n), u(n), p(n)
         !> Sum [mm] and number
         real(c_double), intent(inout) :: sums(2)
      end subroutine mean_gap_piece

      !> Residuals pen - h - u, without what is negative where there is no pressure; the largest violation of the contact
      !> conditions, NaN if one of them is
      real(c_double) function residuals_piece(n, pen, h, u, p, r) bind(c, name="contact_gradient_residuals")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Approach [mm]
         real(c_double), value :: pen
         !> Undeformed distances, displacements [mm], and pressures [N/mm2]
         real(c_double), intent(in) :: h(n), u(n), p(n)
         !> Residuals [mm]
         real(c_double), intent(inout) :: r(n)
      end function residuals_piece

      !> Elements that have pressure or should get it, and are not excluded; the residual becomes 0 in the others
      pure subroutine choose_free_piece(n, p, h, highest, free, r) bind(c, name="contact_gradient_choose_free")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Pressures [N/mm2], undeformed distances [mm]
         real(c_double), intent(in) :: p(n), h(n)
         !> Upper limit of the distance for possible contact [mm]
         real(c_double), value :: highest
         !> 1 where an element is free, 0 elsewhere
         real(c_double), intent(inout) :: free(n)
         !> Residuals [mm]
         real(c_double), intent(inout) :: r(n)
      end subroutine choose_free_piece

      !> Sum of a field over the free elements, and their number
      pure subroutine mean_of_free_piece(n, free, v, sums) bind(c, name="contact_gradient_free_sums")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> 1 where an element is free, 0 elsewhere; the field
         real(c_double), intent(in) :: free(n), v(n)
         !> Sum and number
         real(c_double), intent(inout) :: sums(2)
      end subroutine mean_of_free_piece

      !> A field less its mean, and 0 where an element is not free; inner products of what it becomes
      pure subroutine project_piece(n, free, mean, v, r, s, products) bind(c, name="contact_gradient_project")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> 1 where an element is free, 0 elsewhere
         real(c_double), intent(in) :: free(n)
         !> Mean to subtract; 0: none
         real(c_double), value :: mean
         !> Field to project
         real(c_double), intent(inout) :: v(n)
         !> Fields for the inner products
         real(c_double), intent(in) :: r(n), s(n)
         !> Products with r and s
         real(c_double), intent(inout) :: products(2)
      end subroutine project_piece

      !> The next direction before it is projected, d := z + beta d; the residual becomes the previous one
      pure subroutine turn_direction_piece(n, beta, z, r, d, previous) bind(c, name="contact_gradient_turn")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Weight of the previous direction
         real(c_double), value :: beta
         !> Preconditioned residual, and residual
         real(c_double), intent(in) :: z(n), r(n)
         !> Direction, and the previous residual
         real(c_double), intent(inout) :: d(n), previous(n)
      end subroutine turn_direction_piece

      !> p := p + alpha d, but what falls below zero is cut off; the lowest value before that, or 0
      real(c_double) function go_along_piece(n, alpha, d, p) bind(c, name="contact_gradient_go_along")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Step length
         real(c_double), value :: alpha
         !> Direction
         real(c_double), intent(in) :: d(n)
         !> Pressures [N/mm2]
         real(c_double), intent(inout) :: p(n)
      end function go_along_piece
   end interface

contains

   !> Mean of the distances after deformation, over elements with pressure; 0 if there are none
   real(wp) function mean_gap(n, h, u, p) result(mean)
      !> Number of elements
      integer, intent(in) :: n
      !> Undeformed distances, displacements [mm], and pressures [N/mm2]
      real(wp), intent(in) :: h(n), u(n), p(n)
      real(wp) :: sums(2, most_pieces)
      integer :: k

      if (pieces_of(n) == 1) then
         call mean_gap_piece(n, h, u, p, sums(:, 1))
      else
         !$omp parallel do
         do k = 1, pieces_of(n)
            associate (i => first_of(n, k))
               call mean_gap_piece(length_of(n, k), h(i), u(i), p(i), sums(:, k))
            end associate
         end do
         !$omp end parallel do
      end if
      mean = sum(sums(1, :pieces_of(n)))/max(1.0_wp, sum(sums(2, :pieces_of(n))))
   end function mean_gap

   !> Residuals pen - h - u, without what is negative where there is no pressure; the largest violation of the contact
   !> conditions, NaN if one of them is
   real(wp) function residuals(n, pen, h, u, p, r) result(worst)
      !> Number of elements
      integer, intent(in) :: n
      !> Approach [mm]
      real(wp), intent(in) :: pen
      !> Undeformed distances, displacements [mm], and pressures [N/mm2]
      real(wp), intent(in) :: h(n), u(n), p(n)
      !> Residuals [mm]
      real(wp), intent(inout) :: r(n)
      real(wp) :: part(most_pieces)
      integer :: k

      if (pieces_of(n) == 1) then
         worst = residuals_piece(n, pen, h, u, p, r)
         return
      end if
      !$omp parallel do
      do k = 1, pieces_of(n)
         associate (i => first_of(n, k))
            part(k) = residuals_piece(length_of(n, k), pen, h(i), u(i), p(i), r(i))
         end associate
      end do
      !$omp end parallel do
      worst = 0.0_wp
      do k = 1, pieces_of(n)
         ! true for NaN, which is kept
         if (.not. part(k) <= worst) worst = part(k)
         if (.not. worst <= huge(worst)) exit
      end do
   end function residuals

   !> Elements that have pressure or should get it, and are not excluded; the residual becomes 0 in the others
   subroutine choose_free(n, p, h, highest, free, r)
      !> Number of elements
      integer, intent(in) :: n
      !> Pressures [N/mm2], undeformed distances [mm]
      real(wp), intent(in) :: p(n), h(n)
      !> Distance below which contact is possible [mm]
      real(wp), intent(in) :: highest
      !> 1 where an element is free, 0 elsewhere
      real(wp), intent(inout) :: free(n)
      !> Residuals [mm]
      real(wp), intent(inout) :: r(n)
      integer :: k

      if (pieces_of(n) == 1) then
         call choose_free_piece(n, p, h, highest, free, r)
         return
      end if
      !$omp parallel do
      do k = 1, pieces_of(n)
         associate (i => first_of(n, k))
            call choose_free_piece(length_of(n, k), p(i), h(i), highest, free(i), r(i))
         end associate
      end do
      !$omp end parallel do
   end subroutine choose_free

   !> Mean of a field over the free elements
   real(wp) function mean_of_free(n, free, v) result(mean)
      !> Number of elements
      integer, intent(in) :: n
      !> 1 where an element is free, 0 elsewhere; the field
      real(wp), intent(in) :: free(n), v(n)
      real(wp) :: sums(2, most_pieces)
      integer :: k

      if (pieces_of(n) == 1) then
         call mean_of_free_piece(n, free, v, sums(:, 1))
      else
         !$omp parallel do
         do k = 1, pieces_of(n)
            call mean_of_free_piece(length_of(n, k), free(first_of(n, k)), v(first_of(n, k)), sums(:, k))
         end do
         !$omp end parallel do
      end if
      mean = sum(sums(1, :pieces_of(n)))/max(1.0_wp, sum(sums(2, :pieces_of(n))))
   end function mean_of_free

   !> A field less its mean, and 0 where an element is not free; inner products of what it becomes
   subroutine project(n, free, mean, v, r, s, products)
      !> Number of elements
      integer, intent(in) :: n
      !> 1 where an element is free, 0 elsewhere
      real(wp), intent(in) :: free(n)
      !> Mean that is taken away; 0 for none
      real(wp), intent(in) :: mean
      !> The field
      real(wp), intent(inout) :: v(n)
      !> What it is multiplied with
      real(wp), intent(in) :: r(n), s(n)
      !> Products with r and s
      real(wp), intent(inout) :: products(2)
      real(wp) :: part(2, most_pieces)
      integer :: k

      if (pieces_of(n) == 1) then
         call project_piece(n, free, mean, v, r, s, products)
         return
      end if
      !$omp parallel do
      do k = 1, pieces_of(n)
         associate (i => first_of(n, k))
            call project_piece(length_of(n, k), free(i), mean, v(i), r(i), s(i), part(:, k))
         end associate
      end do
      !$omp end parallel do
      products = sum(part(:, :pieces_of(n)), dim=2)
   end subroutine project

   !> The next direction before it is projected, d := z + beta d; the residual becomes the previous one
   subroutine turn_direction(n, beta, z, r, d, previous)
      !> Number of elements
      integer, intent(in) :: n
      !> Share of the direction before
      real(wp), intent(in) :: beta
      !> Preconditioned residual, and residual
      real(wp), intent(in) :: z(n), r(n)
      !> Direction, and the previous residual
      real(wp), intent(inout) :: d(n), previous(n)
      integer :: k

      if (pieces_of(n) == 1) then
         call turn_direction_piece(n, beta, z, r, d, previous)
         return
      end if
      !$omp parallel do
      do k = 1, pieces_of(n)
         associate (i => first_of(n, k))
            call turn_direction_piece(length_of(n, k), beta, z(i), r(i), d(i), previous(i))
         end associate
      end do
      !$omp end parallel do
   end subroutine turn_direction

   !> p := p + alpha d, but what falls below zero is cut off; the lowest value before that, or 0
   real(wp) function go_along(n, alpha, d, p) result(lowest)
      !> Number of elements
      integer, intent(in) :: n
      !> Length of the step
      real(wp), intent(in) :: alpha
      !> Direction
      real(wp), intent(in) :: d(n)
      !> Pressures [N/mm2]
      real(wp), intent(inout) :: p(n)
      real(wp) :: part(most_pieces)
      integer :: k

      if (pieces_of(n) == 1) then
         lowest = go_along_piece(n, alpha, d, p)
         return
      end if
      !$omp parallel do
      do k = 1, pieces_of(n)
         part(k) = go_along_piece(length_of(n, k), alpha, d(first_of(n, k)), p(first_of(n, k)))
      end do
      !$omp end parallel do
      lowest = minval(part(:pieces_of(n)))
   end function go_along
end module contact_normal_gradient_loops
