!> Acceleration of fixed-point iterations x := g(x) after Anderson (1965)
!>
!> The last values of f = g(x) - x are combined linearly, with weights that sum to one, so that the norm of the combination is
!> minimal; the next x is the same combination of the values of g. For linear g this is equivalent to GMRES (Walker and Ni
!> 2011): it converges where the plain iteration does not. When f has grown, the history no longer describes g and is dropped;
!> the next step is a plain one, shortened if this happens again.
module contact_numeric_anderson
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: anderson_iteration

   !> State of an iteration
   type :: anderson_iteration
      !> Number of steps in the history
      integer, private :: depth = 0
      !> Number of stored differences, and the column to be written next
      integer, private :: used = 0, next_column = 1
      !> Differences of f and of g from step to step, shape (n, depth)
      real(wp), allocatable, private :: df(:, :), dg(:, :)
      !> Last f and g, and the current f, shape (n)
      real(wp), allocatable, private :: f(:), g(:), present_f(:)
      !> For the least-squares fit: orthogonal columns and triangular factor, remainder of f and its components, weights
      real(wp), allocatable, private :: a(:, :), r(:, :), rest(:), y(:), b(:)
      integer, allocatable, private :: pivots(:)
      !> Length of a plain step, in (0, 1]
      real(wp), private :: length = 1.0_wp
      logical, private :: begun = .false.
   contains
      !> Start an iteration with empty history
      procedure :: start
      !> Next x
      procedure :: advance
   end type anderson_iteration

contains

   subroutine start(self, n, depth)
      class(anderson_iteration), intent(inout) :: self
      !> Number of unknowns, number of steps in the history
      integer, intent(in) :: n, depth

      if (allocated(self%f)) then
         if (size(self%f) /= n .or. self%depth /= depth) deallocate(self%f, self%g, self%present_f, self%df, self%dg, &
            & self%a, self%r, self%rest, self%y, self%b, self%pivots)
      end if
      if (.not. allocated(self%f)) allocate(self%f(n), self%g(n), self%present_f(n), self%df(n, depth), self%dg(n, depth), &
         & self%a(n, depth), self%r(depth, depth), self%rest(n), self%y(depth), self%b(depth), self%pivots(depth))
      self%depth = depth
      self%used = 0
      self%next_column = 1
      self%length = 1.0_wp
      self%begun = .false.
   end subroutine start

   subroutine advance(self, x, g)
      class(anderson_iteration), intent(inout) :: self
      !> On entry the argument of g, on exit the next one
      real(wp), intent(inout) :: x(size(self%f))
      !> Value of the map at x, in the unit of x; the iteration solves g(x) = x
      real(wp), intent(in) :: g(size(self%f))
      integer :: k
      !> Growth of f above which the history is dropped
      real(wp), parameter :: growth = 5.0_wp

      self%present_f = g - x
      if (self%begun) then
         if (norm2(self%present_f) > growth*norm2(self%f)) then
            self%used = 0
            self%next_column = 1
            self%length = 0.5_wp*self%length
         else
            self%df(:, self%next_column) = self%present_f - self%f
            self%dg(:, self%next_column) = g - self%g
            self%used = max(self%used, self%next_column)
            self%next_column = 1 + mod(self%next_column, self%depth)
         end if
      end if
      self%f = self%present_f
      self%g = g
      self%begun = .true.
      if (self%used == 0) then
         x = x + self%length*self%f
         return
      end if
      call fit(self)
      x = x + self%f
      do k = 1, self%used
         x = x - self%b(k)*self%dg(:, k)
      end do
   end subroutine advance

   !> Weights w that minimise |f - df w|, as the first values of b
   !>
   !> Columns of df are orthogonalised one after the other, the longest remaining one first (modified Gram-Schmidt, twice).
   subroutine fit(self)
      class(anderson_iteration), intent(inout) :: self
      integer :: i, j, k, rank, longest
      real(wp) :: length, rest
      !> Directions with a smaller relative length are left out
      real(wp), parameter :: smallest = 1.0e-10_wp

      self%a(:, :self%used) = self%df(:, :self%used)
      self%rest = self%f
      do k = 1, self%used
         self%pivots(k) = k
      end do
      rank = 0
      do k = 1, self%used
         longest = k
         length = norm2(self%a(:, k))
         do j = k + 1, self%used
            if (norm2(self%a(:, j)) <= length) cycle
            longest = j
            length = norm2(self%a(:, j))
         end do
         if (k > 1) then
            if (length <= smallest*self%r(1, 1)) exit
         else if (.not. length > 0.0_wp) then
            exit
         end if
         if (longest /= k) call exchange(self, k, longest)
         ! repeated, because the remainder of nearly dependent columns is mostly round-off
         do i = 1, k - 1
            rest = dot_product(self%a(:, i), self%a(:, k))
            self%r(i, k) = self%r(i, k) + rest
            self%a(:, k) = self%a(:, k) - rest*self%a(:, i)
         end do
         length = norm2(self%a(:, k))
         if (.not. length > 0.0_wp) exit
         rank = k
         self%r(k, k) = length
         self%a(:, k) = self%a(:, k)/length
         do j = k + 1, self%used
            self%r(k, j) = dot_product(self%a(:, k), self%a(:, j))
            self%a(:, j) = self%a(:, j) - self%r(k, j)*self%a(:, k)
         end do
         self%y(k) = dot_product(self%a(:, k), self%rest)
         self%rest = self%rest - self%y(k)*self%a(:, k)
      end do
      self%b = 0.0_wp
      do k = rank, 1, -1
         self%y(k) = self%y(k)/self%r(k, k)
         self%y(:k - 1) = self%y(:k - 1) - self%r(:k - 1, k)*self%y(k)
         self%b(self%pivots(k)) = self%y(k)
      end do
   end subroutine fit

   !> Exchange two columns that are not yet processed
   subroutine exchange(self, k, j)
      class(anderson_iteration), intent(inout) :: self
      integer, intent(in) :: k, j
      real(wp) :: kept
      integer :: i

      do i = 1, size(self%a, 1)
         kept = self%a(i, k)
         self%a(i, k) = self%a(i, j)
         self%a(i, j) = kept
      end do
      do i = 1, k - 1
         kept = self%r(i, k)
         self%r(i, k) = self%r(i, j)
         self%r(i, j) = kept
      end do
      i = self%pivots(k)
      self%pivots(k) = self%pivots(j)
      self%pivots(j) = i
   end subroutine exchange
end module contact_numeric_anderson
