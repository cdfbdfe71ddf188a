!> Minimum of a function of one variable x >= 0 that decreases initially, with reverse communication
!>
!> The caller evaluates the function at the abscissae that the search requests:
!>
!>     call search%start(first, tolerance)
!>     do while (.not. search%finished)
!>        call search%update(f(search%x))
!>     end do
!>
!> Starting from 0 the search finds three points of which the middle one has the lowest value, by steps that grow or shrink by a
!> constant factor. It then continues between the outer points by parabolas and golden sections after Brent (1973), chapter 5.
!> It always terminates.
module contact_numeric_minimum_search
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: minimum_search

   type :: minimum_search
      !> Abscissa of the next evaluation
      real(wp) :: x = 0.0_wp
      !> Abscissa of the lowest value so far
      real(wp) :: best = 0.0_wp
      !> No further evaluations are needed
      logical :: finished = .false.
      !> Number of evaluations
      integer :: evaluations = 0
      !> Member of stage
      integer, private :: stage = 0
      !> First step, and relative tolerance of the minimum
      real(wp), private :: first = 1.0_wp, tolerance = 1.0e-3_wp
      !> Interval that contains the minimum
      real(wp), private :: a = 0.0_wp, c = 0.0_wp
      !> Value at 0; value at `best`; second and third lowest points and their values
      real(wp), private :: f0 = 0.0_wp, fx = 0.0_wp, w = 0.0_wp, fw = 0.0_wp, v = 0.0_wp, fv = 0.0_wp
      !> Last step, and the previous one
      real(wp), private :: step = 0.0_wp, last_step = 0.0_wp
   contains
      procedure :: start
      procedure :: update
   end type minimum_search

   type :: stage_list
      integer :: zero = 0, first = 1, shrinking = 2, growing = 3, inside = 4
   end type stage_list
   !> Stages of the search
   type(stage_list), parameter :: stage = stage_list()

   !> Growth factor of the steps before a bracket is found, and maximum number of such evaluations; chosen
   real(wp), parameter :: growth = 3.0_wp
   integer, parameter :: max_outside = 25
   !> Maximum number of evaluations, as in CONTACT's GDsteady
   integer, parameter :: max_evaluations = 99
   !> Golden section, (3 - sqrt(5))/2 to the digits needed
   real(wp), parameter :: golden = 0.381966_wp

contains

   !> Start a search
   pure subroutine start(self, first, tolerance)
      class(minimum_search), intent(inout) :: self
      !> First step, positive; relative tolerance of the minimum
      real(wp), intent(in) :: first, tolerance

      self%first = first
      self%tolerance = tolerance
      self%x = 0.0_wp
      self%a = 0.0_wp
      self%step = 0.0_wp
      self%last_step = 0.0_wp
      self%evaluations = 0
      self%finished = .false.
      self%stage = stage%zero
   end subroutine start

   !> Process the value of the function at x, and choose the next abscissa
   pure subroutine update(self, f)
      class(minimum_search), intent(inout) :: self
      !> Value of the function at `x`
      real(wp), intent(in) :: f

      self%evaluations = self%evaluations + 1
      select case (self%stage)
      case (stage%zero)
         self%f0 = f
         self%best = 0.0_wp
         self%x = self%first
         self%stage = stage%first
      case (stage%first)
         self%best = self%x
         self%fx = f
         if (f >= self%f0) then
            self%stage = stage%shrinking
            call shrink(self)
         else
            self%stage = stage%growing
            self%x = growth*self%best
         end if
      case (stage%shrinking)
         self%best = self%x
         self%fx = f
         call shrink(self)
      case (stage%growing)
         call grow(self, f)
      case default
         call narrow(self, f)
      end select
   end subroutine update

   !> Reduce the step until the value is below that at 0
   pure subroutine shrink(self)
      class(minimum_search), intent(inout) :: self

      if (self%fx >= self%f0 .and. self%evaluations < max_outside) then
         self%c = self%best
         self%x = self%best/growth
      else
         call start_inside(self)
      end if
   end subroutine shrink

   !> Increase the step until the value rises
   pure subroutine grow(self, f)
      class(minimum_search), intent(inout) :: self
      real(wp), intent(in) :: f

      self%c = self%x
      if (f < self%fx .and. self%evaluations <= max_outside) then
         self%a = self%best
         self%best = self%x
         self%fx = f
         self%x = growth*self%x
      else
         call start_inside(self)
      end if
   end subroutine grow

   !> Three bracketing points are known
   pure subroutine start_inside(self)
      class(minimum_search), intent(inout) :: self

      self%stage = stage%inside
      self%w = self%best
      self%v = self%best
      self%fw = self%fx
      self%fv = self%fx
      call propose(self)
   end subroutine start_inside

   !> The next point between a and c: the minimum of the parabola through the three lowest points if it is usable, otherwise a
   !> golden section of the longer part
   pure subroutine propose(self)
      class(minimum_search), intent(inout) :: self
      real(wp) :: middle, tolerance, numerator, denominator, before

      middle = 0.5_wp*(self%a + self%c)
      tolerance = self%tolerance*abs(self%best) + tiny(1.0_wp)
      self%finished = self%evaluations >= max_evaluations &
         & .or. abs(self%best - middle) <= 2.0_wp*tolerance - 0.5_wp*(self%c - self%a)
      if (self%finished) return
      numerator = 0.0_wp
      denominator = 0.0_wp
      before = self%last_step
      associate (x => self%best, w => self%w, v => self%v)
         if (abs(self%last_step) > tolerance) then
            numerator = (x - v)**2*(self%fx - self%fw) - (x - w)**2*(self%fx - self%fv)
            denominator = 2.0_wp*((x - v)*(self%fx - self%fw) - (x - w)*(self%fx - self%fv))
            if (denominator > 0.0_wp) numerator = -numerator
            denominator = abs(denominator)
            self%last_step = self%step
         end if
         if (denominator > 0.0_wp .and. abs(numerator) < abs(0.5_wp*denominator*before) &
            & .and. numerator > denominator*(self%a - x) .and. numerator < denominator*(self%c - x)) then
            self%step = numerator/denominator
         else
            self%last_step = merge(self%c - x, self%a - x, x < middle)
            self%step = golden*self%last_step
         end if
         self%x = x + merge(self%step, sign(tolerance, self%step), abs(self%step) >= tolerance)
      end associate
   end subroutine propose

   !> Process a value within the bracket
   pure subroutine narrow(self, f)
      class(minimum_search), intent(inout) :: self
      real(wp), intent(in) :: f

      associate (u => self%x)
         if (f <= self%fx) then
            if (u >= self%best) self%a = self%best
            if (u < self%best) self%c = self%best
            self%v = self%w
            self%fv = self%fw
            self%w = self%best
            self%fw = self%fx
            self%best = u
            self%fx = f
         else
            if (u < self%best) self%a = u
            if (u >= self%best) self%c = u
            if (f <= self%fw .or. self%w == self%best) then
               self%v = self%w
               self%fv = self%fw
               self%w = u
               self%fw = f
            else if (f <= self%fv .or. self%v == self%best .or. self%v == self%w) then
               self%v = u
               self%fv = f
            end if
         end if
      end associate
      call propose(self)
   end subroutine narrow
end module contact_numeric_minimum_search
