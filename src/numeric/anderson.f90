!> Acceleration of fixed-point iterations x := g(x) after Anderson (1965)
!>
!> The last few values of f = g(x) - x are combined linearly, with weights of sum one, so that the norm of the
!> combination is smallest; the same combination of the g is the next x. For linear g this is GMRES
!> in other clothes (Walker and Ni 2011): it converges where the plain iteration does not.
!> A history that no longer describes g is dropped when f has grown; the next step is a plain
!> one, shortened when that happens again.
module contact_numeric_anderson
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: anderson_iteration

   !> Memory of one iteration
   type :: anderson_iteration
      !> Number of steps that are remembered
      integer, private :: depth = 0
      !> Remembered differences, and the column that is written next
      integer, private :: used = 0, next_column = 1
      !> Differences of f and of g from step to step, shape (n, depth)
      real(wp), allocatable, private :: df(:, :), dg(:, :)
      !> Last f and g, and the present f, shape (n)
      real(wp), allocatable, private :: f(:), g(:), present_f(:)
      !> For the fit of weights: matrix, right-hand side and weights, scratch of LAPACK
      real(wp), allocatable, private :: a(:, :), b(:), work(:)
      integer, allocatable, private :: pivots(:)
      !> Length of a plain step, in (0, 1]
      real(wp), private :: length = 1.0_wp
      logical, private :: begun = .false.
   contains
      !> Forget everything
      procedure :: start
      !> Next x
      procedure :: advance
   end type anderson_iteration

   interface
      !> LAPACK: least squares by a complete orthogonal factorisation; columns may depend on each other
      subroutine dgelsy(m, n, nrhs, a, lda, b, ldb, jpvt, rcond, rank, work, lwork, info)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: m, n, nrhs, lda, ldb, lwork
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(inout) :: jpvt(*)
         real(wp), intent(in) :: rcond
         integer, intent(out) :: rank, info
         real(wp), intent(inout) :: work(*)
      end subroutine dgelsy
   end interface

contains

   subroutine start(self, n, depth)
      class(anderson_iteration), intent(inout) :: self
      !> Number of unknowns, steps to remember
      integer, intent(in) :: n, depth

      if (allocated(self%f)) then
         if (size(self%f) /= n .or. self%depth /= depth) deallocate(self%f, self%g, self%present_f, self%df, self%dg, &
            & self%a, self%b, self%work, self%pivots)
      end if
      if (.not. allocated(self%f)) allocate(self%f(n), self%g(n), self%present_f(n), self%df(n, depth), self%dg(n, depth), &
         & self%a(n, depth), self%b(max(n, depth)), self%work(4*depth + 1 + 64*(depth + 1)), self%pivots(depth))
      self%depth = depth
      self%used = 0
      self%next_column = 1
      self%length = 1.0_wp
      self%begun = .false.
   end subroutine start

   subroutine advance(self, x, g)
      class(anderson_iteration), intent(inout) :: self
      !> What g was computed from on entry, what it is to be computed from next on exit
      real(wp), intent(inout) :: x(size(self%f))
      real(wp), intent(in) :: g(size(self%f))
      integer :: k
      !> Growth of f at which the history is dropped
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

   !> Weights w that make |f - df w| smallest, as the first values of b
   subroutine fit(self)
      class(anderson_iteration), intent(inout) :: self
      integer :: n, rank, info
      !> Directions that are known less accurately than this are left out
      real(wp), parameter :: smallest = 1.0e-10_wp

      n = size(self%f)
      self%a(:, :self%used) = self%df(:, :self%used)
      self%b(:n) = self%f
      self%b(n + 1:) = 0.0_wp
      self%pivots = 0
      call dgelsy(n, self%used, 1, self%a, n, self%b, size(self%b), self%pivots, smallest, rank, self%work, size(self%work), &
         & info)
      if (info /= 0) self%b(:self%used) = 0.0_wp
   end subroutine fit
end module contact_numeric_anderson
