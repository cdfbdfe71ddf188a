!> Coarser problems of nested iteration for the normal problem
module contact_normal_coarse_problem
   use contact_base_constants, only : excluded_distance, excluded_threshold
   use contact_base_kinds, only : wp
   use contact_grid_coarsening, only : coarse_neighbours, coarse_size, coarsening_factor
   use contact_normal_problem, only : normal_problem
   use contact_numeric_pieces, only : pieces_of
   implicit none (type, external)
   private

   public :: coarsen, prolong

contains

   !> The same problem with half as many elements per direction; distances are averaged
   subroutine coarsen(fine, coarse)
      !> Problem on the fine grid
      type(normal_problem), intent(in) :: fine
      !> Receives size, distances, force and limits
      type(normal_problem), intent(inout) :: coarse
      integer :: fx, fy, mx, my, iy

      fx = coarsening_factor(fine%mx)
      fy = coarsening_factor(fine%my)
      mx = coarse_size(fine%mx)
      my = coarse_size(fine%my)
      if (allocated(coarse%h)) then
         if (any(shape(coarse%h) /= [mx, my])) deallocate(coarse%h)
      end if
      if (.not. allocated(coarse%h)) allocate(coarse%h(mx, my))
      coarse%mx = mx
      coarse%my = my
      coarse%dx = fx*fine%dx
      coarse%dy = fy*fine%dy
      coarse%force_prescribed = fine%force_prescribed
      coarse%fn = fine%fn
      coarse%maxgs = fine%maxgs
      coarse%deadline = fine%deadline
      if (pieces_of(fine%mx*fine%my) == 1) then
         do iy = 1, my
            call coarsen_row(iy)
         end do
      else
         !$omp parallel do
         do iy = 1, my
            call coarsen_row(iy)
         end do
         !$omp end parallel do
      end if

   contains

      !> Distances of a coarse row
      subroutine coarsen_row(iy)
         integer, intent(in) :: iy
         integer :: ix, jx, jy, n
         real(wp) :: h

         do ix = 1, mx
            h = 0.0_wp
            n = 0
            do jy = fy*(iy - 1) + 1, min(fy*iy, fine%my)
               do jx = fx*(ix - 1) + 1, min(fx*ix, fine%mx)
                  if (fine%h(jx, jy) > excluded_threshold) cycle
                  h = h + fine%h(jx, jy)
                  n = n + 1
               end do
            end do
            coarse%h(ix, iy) = excluded_distance
            if (n > 0) coarse%h(ix, iy) = h/n
         end do
      end subroutine coarsen_row
   end subroutine coarsen

   !> Bilinear interpolation of pressures to the fine grid
   subroutine prolong(pc, fine, p)
      !> Pressures on the coarse grid [N/mm2]
      real(wp), contiguous, intent(in) :: pc(:, :)
      !> Problem on the fine grid
      type(normal_problem), intent(in) :: fine
      !> Pressures on the fine grid [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(inout) :: p(:, :)
      integer :: iy

      if (pieces_of(fine%mx*fine%my) == 1) then
         do iy = 1, fine%my
            call interpolate_row(iy)
         end do
      else
         !$omp parallel do
         do iy = 1, fine%my
            call interpolate_row(iy)
         end do
         !$omp end parallel do
      end if

   contains

      !> Pressures of a row
      subroutine interpolate_row(iy)
         integer, intent(in) :: iy
         integer :: ix, i0, i1, j0, j1
         real(wp) :: a, b

         call coarse_neighbours(iy, fine%my, j0, j1, b)
         do ix = 1, fine%mx
            call coarse_neighbours(ix, fine%mx, i0, i1, a)
            p(ix, iy) = (1.0_wp - b)*((1.0_wp - a)*pc(i0, j0) + a*pc(i1, j0)) + b*((1.0_wp - a)*pc(i0, j1) + a*pc(i1, j1))
         end do
      end subroutine interpolate_row
   end subroutine prolong
end module contact_normal_coarse_problem
