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
      !> Last f and g, shape (n)
      real(wp), allocatable, private :: f(:), g(:)
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
         if (size(self%f) /= n .or. self%depth /= depth) deallocate(self%f, self%g, self%df, self%dg)
      end if
      if (.not. allocated(self%f)) allocate(self%f(n), self%g(n), self%df(n, depth), self%dg(n, depth))
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
      real(wp), allocatable :: f(:), weight(:)
      !> Growth of f at which the history is dropped
      real(wp), parameter :: growth = 5.0_wp

      f = g - x
      if (self%begun) then
         if (norm2(f) > growth*norm2(self%f)) then
            self%used = 0
            self%next_column = 1
            self%length = 0.5_wp*self%length
         else
            self%df(:, self%next_column) = f - self%f
            self%dg(:, self%next_column) = g - self%g
            self%used = max(self%used, self%next_column)
            self%next_column = 1 + mod(self%next_column, self%depth)
         end if
      end if
      self%f = f
      self%g = g
      self%begun = .true.
      if (self%used == 0) then
         x = x + self%length*f
         return
      end if
      call fit(self%df(:, :self%used), f, weight)
      x = x + f - matmul(self%dg(:, :self%used), weight)
   end subroutine advance

   !> Weights w that make |f - df w| smallest
   subroutine fit(df, f, weight)
      real(wp), intent(in) :: df(:, :), f(:)
      real(wp), allocatable, intent(out) :: weight(:)
      real(wp), allocatable :: a(:, :), b(:, :), work(:)
      integer :: pivots(size(df, 2)), n, m, rank, info
      !> Directions that are known less accurately than this are left out
      real(wp), parameter :: smallest = 1.0e-10_wp

      n = size(df, 1)
      m = size(df, 2)
      a = df
      allocate(b(max(n, m), 1), source=0.0_wp)
      b(:n, 1) = f
      pivots = 0
      allocate(work(4*m + 1 + 64*(m + 1)))
      call dgelsy(n, m, 1, a, n, b, size(b, 1), pivots, smallest, rank, work, size(work), info)
      weight = b(:m, 1)
      if (info /= 0) weight = 0.0_wp
   end subroutine fit
end module contact_numeric_anderson
