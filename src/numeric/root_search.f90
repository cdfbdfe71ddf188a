!> Root of a function of one variable that mostly decreases, with reverse communication
!>
!> The caller evaluates the function at the abscissae that the search requests:
!>
!>     call search%start(x, step, tolerance)
!>     do while (.not. search%finished)
!>        call search%update(f(search%x), saturated)
!>     end do
!>
!> From the start the search moves downhill in growing steps until the sign changes. It then keeps the root bracketed (regula
!> falsi with the Illinois rule, Dowell and Jarratt 1971, and bisection when three steps did not halve the interval). It always
!> terminates: with a root, with a jump across zero, or without a change of sign.
module contact_numeric_root_search
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: root_search

   type :: root_search
      !> Abscissa of the next evaluation
      real(wp) :: x = 0.0_wp
      !> Best point so far, and its value
      real(wp) :: best = 0.0_wp, best_value = huge(1.0_wp)
      !> Finished; a root was found within the tolerance; the sign changed
      logical :: finished = .false., found = .false., bracketed = .false.
      !> Number of evaluations
      integer :: evaluations = 0
      !> Intervals up to this length are treated as a point; set after the start
      real(wp) :: resolution = 0.0_wp
      !> Steps up to this length give no information on a saturated function; set after the start
      real(wp) :: reach = 0.0_wp
      !> Two points with values of opposite sign once bracketed; before, a is the last point
      real(wp), private :: a = 0.0_wp, fa = 0.0_wp, b = 0.0_wp, fb = 0.0_wp
      real(wp), private :: step = 1.0_wp, tolerance = 0.0_wp
      !> Length of the interval some steps ago, and number of these steps
      real(wp), private :: length = 0.0_wp
      integer, private :: steps = 0
   contains
      procedure :: start
      procedure :: update
   end type root_search

   !> Growth factor of the steps before a bracket is found
   real(wp), parameter :: growth = 1.6_wp
   integer, parameter :: max_evaluations = 200

   !> A saturated function that changes by less than this fraction of the tolerance per step is regarded as constant; chosen
   real(wp), parameter :: no_change = 0.1_wp

contains

   !> Start a search
   pure subroutine start(self, x, step, tolerance)
      class(root_search), intent(inout) :: self
      !> First point, length of the first step (positive), tolerance of the value
      real(wp), intent(in) :: x, step, tolerance

      self%x = x
      self%best = x
      self%best_value = huge(x)
      self%finished = .false.
      self%found = .false.
      self%bracketed = .false.
      self%evaluations = 0
      self%step = max(step, tiny(x))
      self%tolerance = tolerance
      self%resolution = 0.0_wp
      self%reach = 0.0_wp
   end subroutine start

   !> Process the value of the function at x, and choose the next abscissa
   pure subroutine update(self, f, saturated)
      class(root_search), intent(inout) :: self
      !> Value of the function at `x` of the search
      real(wp), intent(in) :: f
      !> Can the function change only slowly from here on? The search for a bracket then ends when it is constant
      logical, intent(in) :: saturated

      self%evaluations = self%evaluations + 1
      if (abs(f) <= self%best_value .or. self%evaluations == 1) then
         self%best = self%x
         self%best_value = abs(f)
      end if
      self%found = abs(f) <= self%tolerance
      self%finished = self%found .or. self%evaluations >= max_evaluations .or. f /= f
      if (self%finished) return
      if (self%bracketed) then
         call narrow(self, f)
      else
         call extend(self, f, saturated)
      end if
   end subroutine update

   !> Search for a change of sign
   pure subroutine extend(self, f, saturated)
      class(root_search), intent(inout) :: self
      real(wp), intent(in) :: f
      logical, intent(in) :: saturated

      if (self%evaluations > 1) then
         if ((f > 0.0_wp) .neqv. (self%fa > 0.0_wp)) then
            self%bracketed = .true.
            self%b = self%x
            self%fb = f
            self%length = abs(self%b - self%a)
            self%steps = 0
            call next_inside(self)
            return
         end if
         self%step = growth*self%step
         if (saturated .and. abs(f) > abs(self%fa) - no_change*self%tolerance) then
            if (abs(self%x - self%a) >= 0.5_wp*self%reach) then
               self%finished = .true.
               return
            end if
            self%step = max(self%step, self%reach)
         end if
      end if
      self%a = self%x
      self%fa = f
      self%x = self%a + sign(self%step, f)
   end subroutine extend

   !> Reduce the bracket a, b
   pure subroutine narrow(self, f)
      class(root_search), intent(inout) :: self
      real(wp), intent(in) :: f

      if ((f > 0.0_wp) .neqv. (self%fb > 0.0_wp)) then
         self%a = self%b
         self%fa = self%fb
      else
         self%fa = 0.5_wp*self%fa
      end if
      self%b = self%x
      self%fb = f
      call next_inside(self)
   end subroutine narrow

   !> Next abscissa: zero of the chord, or the midpoint; finished if there is no number in between
   pure subroutine next_inside(self)
      class(root_search), intent(inout) :: self

      self%steps = self%steps + 1
      self%x = self%b - self%fb*((self%b - self%a)/(self%fb - self%fa))
      if (self%steps > 3) then
         if (abs(self%b - self%a) > 0.5_wp*self%length) self%x = 0.5_wp*(self%a + self%b)
         self%length = abs(self%b - self%a)
         self%steps = 0
      end if
      if ((self%x - self%a)*(self%b - self%x) <= 0.0_wp) self%x = 0.5_wp*(self%a + self%b)
      if (abs(self%b - self%a) <= max(self%resolution, 4.0_wp*epsilon(1.0_wp)*max(abs(self%a), abs(self%b)))) &
         & self%finished = .true.
   end subroutine next_inside
end module contact_numeric_root_search
