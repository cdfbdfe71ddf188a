!> Normal displacements of a few elements due to pressures, by direct summation
!>
!> For a few displacements no transforms are needed, and no spectra for a window whose size changes from one solution to the
!> next: coefficients are kept for the largest window so far.
module contact_elastic_pressure_sums
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use contact_base_kinds, only : wp
   use contact_elastic_coefficients, only : fill_coefficients
   use contact_elastic_halfspace, only : kernel_table
   use contact_elastic_model, only : elastic_model
   implicit none (type, external)
   private

   public :: displacements_by_sums, pressure_sums

   !> Coefficients of normal displacements due to pressures
   type :: pressure_sums
      private
      type(kernel_table) :: table
      type(elastic_model) :: model
      !> Workspace: ranges of elements, and displacements [mm]
      integer, allocatable :: ranges(:, :)
      real(wp), allocatable :: u(:)
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

   interface
      !> Displacements of ranges of elements in each row, as sums over ranges of pressures
      pure subroutine sums_over_rows(mx, my, ranges, nx, ny, nn, p, u) bind(c, name="contact_sums_displace")
         import :: c_double, c_int
         !> Size of the window
         integer(c_int), value :: mx, my
         !> For each row, elements before and up to the end of the range of pressures, and of that of displacements
         integer(c_int), intent(in) :: ranges(4, my)
         !> Largest offsets of the table of coefficients, and the coefficients [mm3/N]
         integer(c_int), value :: nx, ny
         real(c_double), intent(in) :: nn(-nx:nx, -ny:ny)
         !> Pressures [N/mm2], and displacements [mm]; others are not changed
         real(c_double), intent(in) :: p(mx, my)
         real(c_double), intent(inout) :: u(mx, my)
      end subroutine sums_over_rows

      !> Elements before and up to the end of the range of positive values in each row, 0 if there are none
      pure subroutine positive_ranges(mx, my, a, first, ranges) bind(c, name="contact_sums_ranges")
         import :: c_double, c_int
         !> Size of the field
         integer(c_int), value :: mx, my
         !> Field
         real(c_double), intent(in) :: a(mx, my)
         !> Number of integers of each row before those that are set
         integer(c_int), value :: first
         !> Ranges as in `sums_over_rows`
         integer(c_int), intent(inout) :: ranges(4, my)
      end subroutine positive_ranges
   end interface

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
   subroutine weighted(self, weight, p, total)
      class(pressure_sums), intent(inout) :: self
      !> Weights, few of them non-zero [-], and pressures [N/mm2]; both of the shape of the window
      real(wp), contiguous, intent(in) :: weight(:, :), p(:, :)
      !> The sum [mm]
      real(wp), intent(out) :: total
      integer :: ix, iy, mx

      mx = size(p, 1)
      call find_ranges(p, self%ranges, weight)
      if (allocated(self%u)) then
         if (size(self%u) < size(p)) deallocate(self%u)
      end if
      if (.not. allocated(self%u)) allocate(self%u(2*size(p)))
      call sums_over_rows(mx, size(p, 2), self%ranges, self%table%nx, self%table%ny, self%table%nn, p, self%u)
      total = 0.0_wp
      do iy = 1, size(p, 2)
         do ix = self%ranges(3, iy) + 1, self%ranges(4, iy)
            if (weight(ix, iy) > 0.0_wp) total = total + weight(ix, iy)*self%u(ix + mx*(iy - 1))
         end do
      end do
   end subroutine weighted

   !> Displacements of the elements with pressures [mm]; 0 in the others
   subroutine displace(self, p, u)
      class(pressure_sums), intent(inout) :: self
      !> Pressures [N/mm2], of the shape of the window
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Positive where the surfaces move apart, of the same shape
      real(wp), contiguous, intent(inout) :: u(:, :)
      integer :: ix, iy

      call find_ranges(p, self%ranges)
      u = 0.0_wp
      call sums_over_rows(size(p, 1), size(p, 2), self%ranges, self%table%nx, self%table%ny, self%table%nn, p, u)
      do iy = 1, size(p, 2)
         do ix = self%ranges(1, iy) + 1, self%ranges(2, iy)
            if (.not. p(ix, iy) > 0.0_wp) u(ix, iy) = 0.0_wp
         end do
      end do
   end subroutine displace

   !> Displacements of the elements with pressures, and of others that may be in contact [mm]
   subroutine displacements_by_sums(table, p, h, pen, ranges, u)
      !> Coefficients, even in both directions, for the offsets of the window
      type(kernel_table), intent(in) :: table
      !> Pressures [N/mm2], of the shape of the window
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Distance of the undeformed surfaces, of the same shape [mm]
      real(wp), contiguous, intent(in) :: h(:, :)
      !> Approach [mm]: displacements are computed where h < pen
      real(wp), intent(in) :: pen
      !> Workspace
      integer, allocatable, intent(inout) :: ranges(:, :)
      !> Positive where the surfaces move apart, of the same shape; not changed elsewhere
      real(wp), contiguous, intent(inout) :: u(:, :)
      integer :: first, last, iy

      call find_ranges(p, ranges)
      do iy = 1, size(p, 2)
         do last = size(h, 1), ranges(2, iy) + 1, -1
            if (h(last, iy) < pen) exit
         end do
         do first = 1, merge(ranges(1, iy), last - 1, ranges(2, iy) > 0)
            if (h(first, iy) < pen) exit
         end do
         ranges(3:4, iy) = [first - 1, last]
      end do
      call sums_over_rows(size(p, 1), size(p, 2), ranges, table%nx, table%ny, table%nn, p, u)
   end subroutine displacements_by_sums

   !> Ranges of the elements with positive values in each row of two fields
   pure subroutine find_ranges(a, ranges, b)
      !> Field
      real(wp), contiguous, intent(in) :: a(:, :)
      !> Number of elements before and up to the end of the range of a (1, 2) and of b (3, 4) in each row, 0 if there are none; at
      !> least as many columns as the fields
      integer, allocatable, intent(inout) :: ranges(:, :)
      !> Field of the same shape; default the same one
      real(wp), contiguous, intent(in), optional :: b(:, :)
      integer :: iy

      if (allocated(ranges)) then
         if (size(ranges, 2) < size(a, 2)) deallocate(ranges)
      end if
      if (.not. allocated(ranges)) allocate(ranges(4, 2*size(a, 2)))
      call positive_ranges(size(a, 1), size(a, 2), a, 0, ranges)
      if (present(b)) then
         call positive_ranges(size(b, 1), size(b, 2), b, 2, ranges)
      else
         do iy = 1, size(a, 2)
            ranges(3:4, iy) = ranges(1:2, iy)
         end do
      end if
   end subroutine find_ranges
end module contact_elastic_pressure_sums
