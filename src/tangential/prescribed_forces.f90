!> Creepages that go with prescribed tangential forces
!>
!> Quasi-Newton steps on the relative forces f = sum(p)/sum(g) as functions of the unknown
!> creepages, around any solver for given creepages: the caller solves, hands over the forces
!> and gets the next creepages. One force: secants inside a bracket, because f does not
!> increase with the creepage. Two forces: Broyden (1965) updates of the sensitivities with a
!> limit on the step and return to the best point after a step that failed.
module contact_tangential_prescribed_forces
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : ending
   use contact_elastic_operator, only : elastic_operator
   use contact_tangential_problem, only : tangential_problem
   implicit none (type, external)
   private

   public :: force_iteration

   !> State of the iteration
   type :: force_iteration
      !> Number of prescribed forces
      integer :: n = 0
      !> Prescribed and last relative forces [-]
      real(wp) :: target(2) = 0.0_wp, force(2) = 0.0_wp
      !> Sensitivities d force(i) / d creep(k), the best known ones
      real(wp) :: sensitivity(2, 2) = 0.0_wp
      !> Estimate of the sensitivities by a traction distribution of the shape of the bound
      real(wp) :: linear(2) = 0.0_wp
      !> Evaluations so far, and steps that had to be taken back
      integer :: evaluations = 0, failures = 0
      !> Member of ending; not_started while the iteration goes on
      integer :: ended = 0
      !> All elements slip and the forces stay below the prescribed ones
      logical :: full_sliding = .false.
      !> Tolerance, largest number of evaluations
      real(wp), private :: eps = 1.0e-6_wp
      integer, private :: limit = 25
      !> Largest step [creepage]
      real(wp), private :: reach = 0.0_wp
      !> Best point and its distance to the target
      real(wp), private :: best(2) = 0.0_wp, best_miss(2) = 0.0_wp
      !> Bracket of one creepage and the misses there
      logical, private :: has_low = .false., has_high = .false.
      real(wp), private :: low = 0.0_wp, high = 0.0_wp, low_miss = 0.0_wp, high_miss = 0.0_wp
   contains
      procedure :: start
      procedure :: advance
      procedure, private :: advance_one
      procedure, private :: advance_two
   end type force_iteration

   !> Multiples of the linear creepage at which sliding elements are accepted as full sliding
   real(wp), parameter :: far_out = 100.0_wp

contains

   subroutine start(self, problem, operator, sensitivity)
      class(force_iteration), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem
      type(elastic_operator), intent(inout) :: operator
      !> Sensitivities of the previous case, 0 when unknown
      real(wp), intent(in) :: sensitivity(2, 2)
      real(wp), allocatable :: g(:, :, :), u(:, :, :)
      real(wp) :: sum_g, steps
      integer :: k, n_contact
      logical :: usable

      self%n = problem%n_forces
      self%eps = problem%eps
      self%limit = problem%maxnr*self%n
      self%evaluations = 0
      self%failures = 0
      self%ended = ending%not_started
      self%full_sliding = .false.
      self%has_low = .false.
      self%has_high = .false.
      sum_g = sum(problem%bound, mask=problem%contact)
      self%target = 0.0_wp
      self%linear = -1.0_wp
      self%sensitivity = 0.0_wp
      if (sum_g <= 0.0_wp) return
      self%target(:self%n) = problem%target(:self%n)/sum_g

      ! tractions in proportion to the bound displace the contact area by A g; in rolling an
      ! element collects this on its way, half the length of the contact on average
      n_contact = count(problem%contact)
      steps = 1.0_wp
      if (problem%steady) steps = 0.5_wp*n_contact/count(any(problem%contact, dim=1))
      allocate(g(problem%mx, problem%my, 2), u(problem%mx, problem%my, 2), source=0.0_wp)
      do k = 1, 2
         g = 0.0_wp
         g(:, :, k) = problem%bound
         call operator%tangential(g, u)
         self%linear(k) = -problem%dq*steps*n_contact/sum(u(:, :, k), mask=problem%contact)
      end do
      self%sensitivity(1, 1) = self%linear(1)
      self%sensitivity(2, 2) = self%linear(2)
      self%reach = 2.0_wp/minval(abs(self%linear(:self%n)))
      ! what the previous case left is used if it is of the expected sign and order of magnitude
      usable = all([(sensitivity(k, k)/self%linear(k) > 1.0e-3_wp &
         & .and. sensitivity(k, k)/self%linear(k) < 30.0_wp, k=1, self%n)])
      if (self%n == 2) usable = usable .and. sensitivity(1, 1)*sensitivity(2, 2) - sensitivity(1, 2)*sensitivity(2, 1) &
         & > 1.0e-3_wp*sensitivity(1, 1)*sensitivity(2, 2)
      if (usable) self%sensitivity(:self%n, :self%n) = sensitivity(:self%n, :self%n)
   end subroutine start

   !> Take the forces at the present creepages; choose the next ones or end
   subroutine advance(self, force, adhesion, creep)
      class(force_iteration), intent(inout) :: self
      !> Relative forces sum(p)/sum(g)
      real(wp), intent(in) :: force(2)
      !> Does any element adhere?
      logical, intent(in) :: adhesion
      !> Creepages of these forces on entry, the next ones on exit
      real(wp), intent(inout) :: creep(2)
      real(wp) :: miss(2)

      self%force = force
      self%evaluations = self%evaluations + 1
      miss = 0.0_wp
      miss(:self%n) = self%target(:self%n) - force(:self%n)
      if (sum(abs(miss)) <= self%eps) self%ended = ending%converged
      if (self%ended == ending%not_started .and. .not. adhesion &
         & .and. norm2(force(:self%n)) < norm2(self%target(:self%n)) &
         & .and. maxval(abs(creep(:self%n)*self%linear(:self%n))) > far_out) then
         self%full_sliding = .true.
         self%ended = ending%stagnated
      end if
      if (self%ended == ending%not_started .and. self%evaluations >= self%limit) self%ended = ending%iteration_limit
      if (self%n == 1) then
         call self%advance_one(miss(1), creep(1))
      else
         call self%advance_two(miss, creep)
      end if
   end subroutine advance

   subroutine advance_one(self, miss, creep)
      class(force_iteration), intent(inout) :: self
      real(wp), intent(in) :: miss
      real(wp), intent(inout) :: creep
      real(wp) :: slope, new
      real(wp), parameter :: margin = 0.02_wp

      if (self%evaluations > 1 .and. creep /= self%best(1)) then
         slope = (self%best_miss(1) - miss)/(creep - self%best(1))
         if (slope < 0.0_wp) self%sensitivity(1, 1) = slope
      end if
      ! forces that are too large call for more creepage: miss < 0 at the low end
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
            if (new <= self%low + 1.0e-3_wp*margin*width .or. new >= self%high - 1.0e-3_wp*margin*width) &
               & new = 0.5_wp*(self%low + self%high)
            ! a point beyond the estimate closes the bracket from the other side
            if (mod(self%evaluations, 6) == 0) new = 0.5_wp*(self%low + self%high)
         end associate
      else
         self%reach = 2.0_wp*self%reach
      end if
      creep = new
   end subroutine advance_one

   subroutine advance_two(self, miss, creep)
      class(force_iteration), intent(inout) :: self
      real(wp), intent(in) :: miss(2)
      real(wp), intent(inout) :: creep(2)
      real(wp) :: s(2), y(2), j(2, 2), det, step(2), length
      logical :: better

      better = .true.
      if (self%evaluations > 1) then
         s = creep - self%best
         y = self%best_miss - miss
         if (dot_product(s, s) > 0.0_wp) then
            j = self%sensitivity + spread(y - matmul(self%sensitivity, s), 2, 2) &
               & *spread(s, 1, 2)/dot_product(s, s)
            if (falls(j)) then
               self%sensitivity = j
            else if (dot_product(s, y) < 0.0_wp) then
               ! the slope along the step in all directions, if it has the right sign
               self%sensitivity = 0.0_wp
               self%sensitivity(1, 1) = dot_product(s, y)/dot_product(s, s)
               self%sensitivity(2, 2) = self%sensitivity(1, 1)
            end if
         end if
         better = norm2(miss) < norm2(self%best_miss)
         length = norm2(s)
         if (.not. better) then
            self%failures = self%failures + 1
            self%reach = max(0.4_wp*min(length, self%reach), 1.0e-12_wp*self%reach)
         else if (norm2(miss) < 0.5_wp*norm2(self%best_miss)) then
            self%reach = max(self%reach, 3.0_wp*length)
         else
            self%reach = max(self%reach, 1.5_wp*length)
         end if
      end if
      if (better) then
         self%best = creep
         self%best_miss = miss
      end if
      if (self%ended /= ending%not_started) then
         return
      end if
      det = self%sensitivity(1, 1)*self%sensitivity(2, 2) - self%sensitivity(1, 2)*self%sensitivity(2, 1)
      associate (a => self%sensitivity, m => self%best_miss)
         step = [a(2, 2)*m(1) - a(1, 2)*m(2), a(1, 1)*m(2) - a(2, 1)*m(1)]/det
      end associate
      length = norm2(step)
      if (length > self%reach) step = step*(self%reach/length)
      creep = self%best + step
   end subroutine advance_two

   !> Do forces fall in every direction of creepage? (negative definite symmetric part)
   pure logical function falls(j)
      real(wp), intent(in) :: j(2, 2)
      falls = j(1, 1) < 0.0_wp .and. j(2, 2) < 0.0_wp &
         & .and. 4.0_wp*j(1, 1)*j(2, 2) > (1.0_wp + 1.0e-3_wp)*(j(1, 2) + j(2, 1))**2
   end function falls
end module contact_tangential_prescribed_forces
