!> Creepages for prescribed tangential forces
!>
!> Quasi-Newton steps on the relative forces f = sum(p)/sum(g) as functions of the unknown creepages, around any solver for
!> given creepages: the caller solves, passes the forces and receives the next creepages. One force: secants within a bracket,
!> as f does not increase with the creepage. Two forces: Broyden (1965) updates of the sensitivities with a limited step, and
!> return to the best point after a failed step; if convergence is slow, near full sliding, the sensitivities are recomputed by
!> differences. Two forces are compared after stretching, F = f/sqrt(1 - |f|**2): forces saturate approximately as c/sqrt(1 +
!> c**2) for creepages c in units of linear theory, so that F depends almost linearly on c.
module contact_tangential_prescribed_forces
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : ending
   use contact_elastic_compliance, only : compliance
   use contact_tangential_problem, only : tangential_problem
   implicit none (type, external)
   private

   public :: force_iteration

   !> State of the iteration
   type :: force_iteration
      !> Number of prescribed forces
      integer :: n = 0
      !> Prescribed and most recent relative forces [-]
      real(wp) :: target(2) = 0.0_wp, force(2) = 0.0_wp
      !> Best known sensitivities d force(i) / d creep(k)
      real(wp) :: sensitivity(2, 2) = 0.0_wp
      !> Sensitivities estimated for tractions proportional to the bound
      real(wp) :: linear(2) = 0.0_wp
      !> Number of evaluations, and number of steps that were reversed
      integer :: evaluations = 0, failures = 0
      !> Member of ending; not_started while the iteration continues
      integer :: ended = 0
      !> Do all elements slip, with forces below the prescribed ones?
      logical :: full_sliding = .false.
      !> Tolerance, maximum number of evaluations
      real(wp), private :: eps = 1.0e-6_wp
      integer, private :: limit = 25
      !> Maximum step [creepage]
      real(wp), private :: reach = 0.0_wp
      !> Creepages beyond which slip of all elements is accepted as full sliding
      real(wp), private :: far = 0.0_wp
      !> Sensitivities of the stretched forces; must they still be converted?
      real(wp), private :: slope(2, 2) = 0.0_wp
      logical, private :: inherited = .false.
      !> Best point and its difference from the target, stretched for two forces
      real(wp), private :: best(2) = 0.0_wp, best_miss(2) = 0.0_wp
      !> Index of the creepage varied for differences, 0: none, and the variation
      integer, private :: probed = 0
      real(wp), private :: change = 0.0_wp
      !> Sensitivities by differences, while they are being computed
      real(wp), private :: differences(2, 2) = 0.0_wp
      !> Number of steps with little progress since the last differences
      integer, private :: slow = 0
      !> Are the sensitivities those by differences at the best point?
      logical, private :: fresh = .false.
      !> Bracket of one creepage, and the differences from the target at its ends
      logical, private :: has_low = .false., has_high = .false.
      real(wp), private :: low = 0.0_wp, high = 0.0_wp, low_miss = 0.0_wp, high_miss = 0.0_wp
   contains
      procedure :: start
      procedure :: advance
      procedure, private :: advance_one
      procedure, private :: advance_two
   end type force_iteration

   !> The same, as a multiple of the linear creepage and of the given creepages
   real(wp), parameter :: far_out = 100.0_wp
   !> Relative change of the creepages for differences
   real(wp), parameter :: probe = 0.002_wp
   !> Keeps stretched forces finite in full sliding
   real(wp), parameter :: tail = 1.0e-10_wp

   !> Maximum first step in linear creepages: beyond two of them the creep curve is nearly flat
   real(wp), parameter :: first_reach = 2.0_wp
   !> Range in which sensitivities of the previous case are used, relative to the linear ones, and minimum determinant for two
   !> forces relative to the product: orders of magnitude, chosen
   real(wp), parameter :: min_usable = 1.0e-3_wp, max_usable = 30.0_wp, min_determinant = 1.0e-3_wp
   !> Minimum distance of trials from the ends of a bracket, relative to its width
   real(wp), parameter :: margin = 2.0e-5_wp
   !> Number of evaluations after which the bracket is halved, as secants may converge slowly from one side
   integer, parameter :: halving = 6
   !> Growth factor of the maximum step per evaluation without a bracket
   real(wp), parameter :: growth_of_one = 2.0_wp
   !> Maximum step of two creepages relative to the last one: after a step that more than halved the difference, after another
   !> one that reduced it, after one that did not. Similar to the usual values for trust regions; chosen
   real(wp), parameter :: after_good = 3.0_wp, after_fair = 1.5_wp, after_bad = 0.4_wp
   !> Maximum fraction of the difference that remains after a good step
   real(wp), parameter :: good_progress = 0.5_wp
   !> Number of steps that were not good after which sensitivities are recomputed by differences; an update for which forces
   !> increase with creepage is equivalent to this number
   integer, parameter :: too_slow = 2
   !> Minimum remaining fraction of the saturation when stretched sensitivities are initialised: its square root is a divisor
   real(wp), parameter :: min_rest = 1.0e-3_wp
   !> Margin of the test that forces decrease in every direction, above round-off
   real(wp), parameter :: definite = 1.0e-6_wp
   !> Larger differences mean that there is no best point: after meaningless differences
   real(wp), parameter :: no_best = 1.0e100_wp

contains

   subroutine start(self, problem, operator, sensitivity)
      class(force_iteration), intent(inout) :: self
      !> Prescribed forces, traction bounds and tolerance
      type(tangential_problem), intent(in) :: problem
      !> Operator whose stiffness gives the initial sensitivities if none are known
      class(compliance), intent(inout) :: operator
      !> Sensitivities of the previous case, 0 if unknown
      real(wp), intent(in) :: sensitivity(2, 2)
      real(wp), allocatable :: g(:, :, :), u(:, :, :)
      real(wp) :: sum_g, steps, shares
      integer :: k, n_contact
      logical :: usable

      self%n = problem%n_forces
      self%eps = problem%settings%eps
      self%limit = problem%settings%maxnr*self%n
      self%evaluations = 0
      self%failures = 0
      self%ended = ending%not_started
      self%full_sliding = .false.
      self%has_low = .false.
      self%has_high = .false.
      self%probed = 0
      self%slow = 0
      self%fresh = .false.
      sum_g = sum(problem%bound, mask=problem%contact)
      self%target = 0.0_wp
      self%linear = -1.0_wp
      self%sensitivity = 0.0_wp
      if (sum_g <= 0.0_wp) return
      self%target(:self%n) = problem%target(:self%n)/sum_g

      ! tractions proportional to the bound displace the contact area by A g; in rolling an element accumulates this along its
      ! path, on average half the length of the contact
      n_contact = count(problem%contact)
      steps = 1.0_wp
      if (problem%steady) steps = 0.5_wp*n_contact/count(any(problem%contact, dim=1))
      shares = n_contact
      if (allocated(problem%share)) shares = sum(problem%share, mask=problem%contact)
      allocate(g(problem%mx, problem%my, 2), u(problem%mx, problem%my, 2), source=0.0_wp)
      do k = 1, 2
         g = 0.0_wp
         g(:, :, k) = problem%bound
         call operator%tangential(g, u)
         self%linear(k) = -problem%dq*steps*shares/sum(u(:, :, k), mask=problem%contact)
      end do
      self%sensitivity(1, 1) = self%linear(1)
      self%sensitivity(2, 2) = self%linear(2)
      self%reach = first_reach/minval(abs(self%linear(:self%n)))
      self%far = far_out*max(1.0_wp/minval(abs(self%linear(:self%n))), maxval(abs(problem%shift))/problem%dq)
      ! sensitivities of the previous case are used if their sign and order of magnitude are as expected
      usable = all([(sensitivity(k, k)/self%linear(k) > min_usable &
         & .and. sensitivity(k, k)/self%linear(k) < max_usable, k=1, self%n)])
      if (self%n == 2) usable = usable .and. sensitivity(1, 1)*sensitivity(2, 2) - sensitivity(1, 2)*sensitivity(2, 1) &
         & > min_determinant*sensitivity(1, 1)*sensitivity(2, 2)
      if (usable) self%sensitivity(:self%n, :self%n) = sensitivity(:self%n, :self%n)
      self%inherited = usable
   end subroutine start

   !> Process the forces at the current creepages; determine the next ones or end
   subroutine advance(self, force, adhesion, creep)
      class(force_iteration), intent(inout) :: self
      !> Relative forces sum(p)/sum(g)
      real(wp), intent(in) :: force(2)
      !> Is there any adhering element?
      logical, intent(in) :: adhesion
      !> On entry the creepages of these forces, on exit the next ones
      real(wp), intent(inout) :: creep(2)
      real(wp) :: miss(2)

      self%force = force
      if (self%probed == 0) self%evaluations = self%evaluations + 1
      miss = 0.0_wp
      miss(:self%n) = self%target(:self%n) - force(:self%n)
      if (sum(abs(miss)) <= self%eps) self%ended = ending%converged
      if (self%ended == ending%not_started .and. .not. adhesion &
         & .and. norm2(force(:self%n)) < norm2(self%target(:self%n)) &
         & .and. maxval(abs(creep(:self%n))) > self%far) then
         self%full_sliding = .true.
         self%ended = ending%stagnated
      end if
      if (self%ended == ending%not_started .and. self%evaluations >= self%limit) self%ended = ending%iteration_limit
      if (self%n == 1) then
         call self%advance_one(miss(1), creep(1))
      else
         call self%advance_two(stretched(self%target) - stretched(force), creep)
      end if
   end subroutine advance

   subroutine advance_one(self, miss, creep)
      class(force_iteration), intent(inout) :: self
      real(wp), intent(in) :: miss
      real(wp), intent(inout) :: creep
      real(wp) :: slope, new

      if (self%evaluations > 1 .and. creep /= self%best(1)) then
         slope = (self%best_miss(1) - miss)/(creep - self%best(1))
         if (slope < 0.0_wp) self%sensitivity(1, 1) = slope
      end if
      ! forces that are too large require more creepage: miss < 0 at the low end
      if (miss < 0.0_wp) then
         if (.not. self%has_low .or. creep > self%low) then
            self%low = creep
            self%low_miss = miss
         end if
         self%has_low = .true.
      else
         if (.not. self%has_high .or. creep < self%high) then
            self%high = creep
            self%high_miss = miss
         end if
         self%has_high = .true.
      end if
      self%best(1) = creep
      self%best_miss(1) = miss
      if (self%ended /= ending%not_started) return

      new = creep + max(-self%reach, min(self%reach, miss/self%sensitivity(1, 1)))
      if (self%has_low .and. self%has_high .and. self%high > self%low) then
         associate (width => self%high - self%low)
            if (new <= self%low + margin*width .or. new >= self%high - margin*width) &
               & new = 0.5_wp*(self%low + self%high)
            ! a point beyond the estimate closes the bracket from the other side
            if (mod(self%evaluations, halving) == 0) new = 0.5_wp*(self%low + self%high)
         end associate
      else
         self%reach = growth_of_one*self%reach
      end if
      creep = new
   end subroutine advance_one

   subroutine advance_two(self, miss, creep)
      class(force_iteration), intent(inout) :: self
      real(wp), intent(in) :: miss(2)
      real(wp), intent(inout) :: creep(2)
      real(wp) :: s(2), y(2), j(2, 2), progress

      if (self%probed > 0) then
         self%differences(:, self%probed) = (self%best_miss - miss)/self%change
         if (self%ended /= ending%not_started) return
         if (self%probed == 1) then
            self%probed = 2
            creep = self%best + [0.0_wp, self%change]
            return
         end if
         self%probed = 0
         self%slow = 0
         self%fresh = determinant(self%differences) > 0.0_wp .and. self%differences(1, 1) < 0.0_wp
         if (self%fresh) then
            self%slope = self%differences
            call report_sensitivity(self)
            creep = self%best + limited_step(self)
         else
            ! so far out that forces do not depend on the creepages
            creep = 0.5_wp*self%best
            self%best_miss = huge(1.0_wp)
         end if
         return
      end if

      if (self%evaluations == 1) then
         self%best = creep
         self%best_miss = miss
         call start_slope(self)
      else if (maxval(self%best_miss) > no_best) then
         self%best = creep
         self%best_miss = miss
      else
         s = creep - self%best
         y = self%best_miss - miss
         progress = norm2(miss)/norm2(self%best_miss)
         if (progress < 1.0_wp) then
            self%reach = max(self%reach, merge(after_good, after_fair, progress < good_progress)*norm2(s))
         else
            self%failures = self%failures + 1
            self%reach = after_bad*min(norm2(s), self%reach)
         end if
         self%slow = self%slow + merge(1, 0, progress > good_progress)
         ! after a failed step, accurate sensitivities and a shorter step are preferable
         if (dot_product(s, s) > 0.0_wp .and. .not. (self%fresh .and. progress >= 1.0_wp)) then
            j = self%slope + spread(y - matmul(self%slope, s), 2, 2)*spread(s, 1, 2)/dot_product(s, s)
            if (falls(j)) then
               self%slope = j
            else
               self%slow = self%slow + too_slow
            end if
         end if
         if (progress < 1.0_wp) then
            self%best = creep
            self%best_miss = miss
            self%fresh = .false.
         end if
      end if
      call report_sensitivity(self)
      if (self%ended /= ending%not_started) return

      if (self%slow >= too_slow .and. .not. self%fresh) then
         self%probed = 1
         self%change = probe*max(norm2(self%best), probe/maxval(abs(self%linear)))
         creep = self%best + [self%change, 0.0_wp]
      else
         creep = self%best + limited_step(self)
      end if
   end subroutine advance_two

   !> Forces without the effect of saturation
   pure function stretched(f) result(large)
      real(wp), intent(in) :: f(2)
      real(wp) :: large(2)
      large = f/sqrt(max(0.0_wp, 1.0_wp - dot_product(f, f)) + tail)
   end function stretched

   !> Sensitivities of the stretched forces from those of the forces, at the first evaluation
   pure subroutine start_slope(self)
      type(force_iteration), intent(inout) :: self
      real(wp) :: rest

      self%slope = self%sensitivity
      if (.not. self%inherited) return
      rest = max(min_rest, 1.0_wp - dot_product(self%force, self%force))
      self%slope = (self%sensitivity + spread(self%force, 2, 2)*spread(matmul(self%force, self%sensitivity), 1, 2)/rest) &
         & /sqrt(rest)
   end subroutine start_slope

   !> Sensitivities of the forces from those of the stretched forces
   pure subroutine report_sensitivity(self)
      type(force_iteration), intent(inout) :: self

      self%sensitivity = (self%slope - spread(self%force, 2, 2)*spread(matmul(self%force, self%slope), 1, 2)) &
         & *sqrt(max(0.0_wp, 1.0_wp - dot_product(self%force, self%force)))
   end subroutine report_sensitivity

   !> Newton step from the best point, with limited length
   pure function limited_step(self) result(step)
      type(force_iteration), intent(in) :: self
      real(wp) :: step(2), length

      associate (a => self%slope, m => self%best_miss)
         step = [a(2, 2)*m(1) - a(1, 2)*m(2), a(1, 1)*m(2) - a(2, 1)*m(1)]/determinant(a)
      end associate
      length = norm2(step)
      if (length > self%reach) step = step*(self%reach/length)
   end function limited_step

   pure real(wp) function determinant(a)
      real(wp), intent(in) :: a(2, 2)
      determinant = a(1, 1)*a(2, 2) - a(1, 2)*a(2, 1)
   end function determinant

   !> Do forces decrease in every direction of creepage? (negative definite symmetric part)
   pure logical function falls(j)
      real(wp), intent(in) :: j(2, 2)
      falls = j(1, 1) < 0.0_wp .and. j(2, 2) < 0.0_wp &
         & .and. 4.0_wp*j(1, 1)*j(2, 2) > (1.0_wp + definite)*(j(1, 2) + j(2, 1))**2
   end function falls
end module contact_tangential_prescribed_forces
