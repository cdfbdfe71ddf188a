!> Normal displacements of a few elements due to pressures, by direct summation
!>
!> For a few displacements no transforms are needed, and no spectra for a window whose size changes from one solution to the
!> next: coefficients are kept for the largest window so far.
module contact_elastic_pressure_sums
   use contact_base_kinds, only : wp
   use contact_elastic_coefficients, only : fill_coefficients
   use contact_elastic_halfspace, only : kernel_table
   use contact_elastic_model, only : elastic_model
   implicit none (type, external)
   private

   public :: pressure_sums

   !> Coefficients of normal displacements due to pressures
   type :: pressure_sums
      private
      type(kernel_table) :: table
      type(elastic_model) :: model
   contains
      !> Does a single table of coefficients describe all elements of such bodies?
      procedure, nopass :: suits
      !> Compute the coefficients for a window; existing ones are kept if they suffice
      procedure :: prepare
      !> Weighted sum of displacements
      procedure :: weighted
      !> Displacements where there are pressures
      procedure :: displace
   end type pressure_sums

contains

   pure logical function suits(model)
      !> Bodies to check
      type(elastic_model), intent(in) :: model
      suits = model%is_flat() .and. .not. allocated(model%memory)
   end function suits

   subroutine prepare(self, model, dx, dy, mx, my)
      class(pressure_sums), intent(inout) :: self
      !> Elastic model that `suits` accepts
      type(elastic_model), intent(in) :: model
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Size of the window
      integer, intent(in) :: mx, my
      !> Factor by which windows may grow before coefficients are recomputed
      real(wp), parameter :: room = 1.25_wp
      logical :: same

      same = allocated(self%table%nn)
      if (same) same = abs(self%table%dx - dx) <= 0.0_wp .and. abs(self%table%dy - dy) <= 0.0_wp .and. self%model%same_as(model)
      if (same .and. self%table%nx >= mx .and. self%table%ny >= my) return
      self%model = model
      if (same) then
         call fill_coefficients(self%table, model, dx, dy, max(self%table%nx, ceiling(room*mx)), &
            & max(self%table%ny, ceiling(room*my)))
      else
         call fill_coefficients(self%table, model, dx, dy, mx, my)
      end if
   end subroutine prepare

   !> Sum of weight times displacement [mm]
   pure real(wp) function weighted(self, weight, p) result(total)
      class(pressure_sums), intent(in) :: self
      !> Weights, few of them non-zero [-], and pressures [N/mm2]; both of the shape of the window
      real(wp), contiguous, intent(in) :: weight(:, :), p(:, :)
      real(wp) :: here, row(4)
      integer :: ix, iy, k, l, m, first(size(p, 2)), last(size(p, 2))

      do l = 1, size(p, 2)
         first(l) = size(p, 1) + 1
         last(l) = 0
         do k = 1, size(p, 1)
            if (p(k, l) <= 0.0_wp) cycle
            first(l) = min(first(l), k)
            last(l) = k
         end do
      end do
      total = 0.0_wp
      do iy = 1, size(p, 2)
         do ix = 1, size(p, 1)
            if (.not. weight(ix, iy) > 0.0_wp) cycle
            here = 0.0_wp
            do l = 1, size(p, 2)
               ! four independent sums avoid waiting for the previous addition; coefficients are even in both directions
               row = 0.0_wp
               do k = first(l), last(l) - 3, 4
                  do m = 0, 3
                     row(m + 1) = row(m + 1) + self%table%nn(k + m - ix, l - iy)*p(k + m, l)
                  end do
               end do
               do m = k, last(l)
                  row(1) = row(1) + self%table%nn(m - ix, l - iy)*p(m, l)
               end do
               here = here + sum(row)
            end do
            total = total + weight(ix, iy)*here
         end do
      end do
   end function weighted

   !> Displacements of the elements with pressures [mm]; 0 in the others
   pure subroutine displace(self, p, u)
      class(pressure_sums), intent(in) :: self
      !> Pressures [N/mm2], of the shape of the window
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Positive where the surfaces move apart, of the same shape
      real(wp), contiguous, intent(inout) :: u(:, :)
      real(wp) :: row(4)
      integer :: ix, iy, k, l, m, first, last

      u = 0.0_wp
      do l = 1, size(p, 2)
         last = 0
         first = 0
         do k = 1, size(p, 1)
            if (p(k, l) <= 0.0_wp) cycle
            if (first == 0) first = k
            last = k
         end do
         if (last == 0) cycle
         do iy = 1, size(p, 2)
            do ix = 1, size(p, 1)
               if (p(ix, iy) <= 0.0_wp) cycle
               ! four sums at once do not wait for each other; coefficients are even in both directions
               row = 0.0_wp
               do k = first, last - 3, 4
                  do m = 0, 3
                     row(m + 1) = row(m + 1) + self%table%nn(k + m - ix, l - iy)*p(k + m, l)
                  end do
               end do
               do m = k, last
                  row(1) = row(1) + self%table%nn(m - ix, l - iy)*p(m, l)
               end do
               u(ix, iy) = u(ix, iy) + sum(row)
            end do
         end do
      end do
   end subroutine displace
end module contact_elastic_pressure_sums
