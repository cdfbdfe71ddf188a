!> Normal problem of a contact of few elements: active sets with a Cholesky factor that is reused
!>
!> Influence coefficients depend on offsets only, so that the matrix of the elements in contact does not depend on their
!> position. In a time loop the contact area is often that of the last solution; two triangular solves then give the pressures,
!> or their derivative with respect to the approach, to full accuracy. Elements under tension are removed and elements that
!> overlap are added until nothing changes. If this does not terminate soon, conjugate gradients continue from there.
!>
!> The factor follows the area element by element. An element that leaves is removed by rotations of the columns behind it, which
!> are stable (Golub and Van Loan, Matrix Computations, section 6.5); one that enters is appended. A new factor has its elements in
!> the order of decreasing pressure: those at the border, which leave most often, have few columns behind them.
module contact_normal_few_elements
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_compliance, only : compliance
   use contact_elastic_halfspace, only : kernel_table
   use contact_elastic_model, only : elastic_model
   use contact_elastic_operator, only : elastic_operator
   use contact_elastic_pressure_sums, only : displacements_by_sums
   use contact_normal_factor_loops, only : append_row, area_box, factorize, largest_violation, remove_row, solve_backward, &
      & solve_forward
   use contact_normal_problem, only : approach_scale, normal_problem
   use contact_numeric_vectors, only : smallest_of
   implicit none (type, external)
   private

   public :: area_factor, by_factor, solve_few

   !> Name of the method in reports
   character(len=*), parameter :: by_factor = "Cholesky"

   !> Maximum number of elements of a factor: beyond, transforms are faster
   integer, parameter :: most = 200
   !> Maximum number of changes of the area before conjugate gradients take over, and minimum number of elements
   integer, parameter :: max_changes = 12, least = 4
   !> A new factor is made if more than this fraction of the elements change: its cost is that of about as many changes
   real(wp), parameter :: worth_changing = 0.4_wp
   !> The position of the factor in the window is accepted if at most this number of elements change; chosen
   integer, parameter :: few_changes = 6
   !> Maximum number of changes since a factor was made, so that round-off does not add up
   integer, parameter :: most_changes = 500

   !> Factor of a contact area, and workspace; undefined if `n` is 0
   type :: area_factor
      !> Number of elements in contact
      integer, private :: n = 0
      !> Their positions in the window, and those of the factor in its own window, shape (2, most)
      integer, allocatable, private :: place(:, :), known(:, :)
      !> Range of columns and rows of the factor in known(:, k), shape (2, 2)
      integer, private :: box(2, 2) = 0
      !> Number of changes since it was made
      integer, private :: changes = 0
      !> Positions in the table of coefficients, shape (most)
      integer, allocatable, private :: at(:)
      !> Is an element of the window in the factor? Size at least that of the window
      logical, allocatable, private :: taken(:)
      !> Lower triangle L, shape (most, most), and a vector, shape (most)
      real(wp), allocatable, private :: lower(:, :), x(:)
      !> Solutions w of L w = b for two right-hand sides, which follow the changes of the factor: ones, and the overlap of the
      !> undeformed bodies [mm]; shape (most, 2)
      real(wp), allocatable, private :: w(:, :)
      !> Displacements and residuals on the window [mm], shape (mx, my)
      real(wp), allocatable, private :: u(:, :)
      !> Workspace of direct sums
      integer, allocatable, private :: ranges(:, :)
      !> Parameters of the factor
      real(wp), private :: dx = 0.0_wp, dy = 0.0_wp
      type(elastic_model), private :: model
   contains
      !> Compute the factor of an area, or reuse it
      procedure, private :: fit
      !> Solve for the right-hand side x
      procedure, private :: substitute
      !> Derivative of the pressures with respect to the approach
      procedure :: pressure_derivative
      !> Derivatives of the pressures with respect to changes of the distance
      procedure :: pressure_responses
   end type area_factor

contains

   !> Pressures for a prescribed approach, from an estimate close to the solution
   subroutine solve_few(problem, operator, factor, p, pen, report)
      !> Undeformed distance, tolerance
      type(normal_problem), intent(in) :: problem
      !> Prepared for the window
      class(compliance), intent(inout) :: operator
      !> Kept from call to call
      type(area_factor), intent(inout) :: factor
      !> On entry an estimate, on exit pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(inout) :: p(:, :)
      !> Approach [mm]
      real(wp), intent(in) :: pen
      !> Converged, or not started if another method must be used
      type(solve_report), intent(inout) :: report
      real(wp) :: scale, worst
      integer :: change, changes, ix, iy, k, n
      logical :: fits

      report%ended = ending%not_started
      if (problem%force_prescribed .or. allocated(problem%parts) .or. .not. is_plain(operator)) return
      if (allocated(factor%u)) then
         if (any(shape(factor%u) /= shape(p))) deallocate(factor%u)
      end if
      if (.not. allocated(factor%u)) allocate(factor%u(problem%mx, problem%my))
      changes = 0
      n = 0
      do change = 1, max_changes
         report%iterations = change
         if (change > 1 .and. n >= least .and. n <= most .and. changes <= worth_changing*n) then
            call adapt(factor, operator, p, n, fits, problem%h, pen)
            if (.not. fits) return
         else
            call factor%fit(operator, p, fits)
            if (.not. fits) return
            do k = 1, factor%n
               factor%w(k, 2) = pen - problem%h(factor%place(1, k), factor%place(2, k))
            end do
            call solve_forward(factor%n, most, factor%lower, factor%w(:, 2))
         end if
         do k = 1, factor%n
            factor%x(k) = factor%w(k, 2)
         end do
         call solve_backward(factor%n, most, factor%lower, factor%x)
         changes = 0
         do k = 1, factor%n
            if (.not. factor%x(k) > 0.0_wp) changes = changes + 1
            p(factor%place(1, k), factor%place(2, k)) = max(0.0_wp, factor%x(k))
         end do
         n = factor%n - changes
         if (changes > 0) cycle
         ! pressures move the surfaces apart: nothing can overlap where they do not overlap without them
         call displacements_by_sums(operator%table, p, problem%h, pen, factor%ranges, factor%u)
         worst = largest_violation(size(p), pen, problem%h, factor%u, p)
         scale = approach_scale(pen, smallest_of(size(problem%h), problem%h), worst)
         report%residual = worst/scale
         if (report%residual <= problem%eps) then
            report%method = by_factor
            report%ended = ending%converged
            if (change > 1) call area_box(size(p, 1), size(p, 2), p, n, factor%box)
            return
         end if
         do iy = 1, problem%my
            do ix = 1, problem%mx
               if (p(ix, iy) > 0.0_wp .or. .not. problem%h(ix, iy) < pen) cycle
               if (.not. pen - problem%h(ix, iy) - factor%u(ix, iy) > problem%eps*scale) cycle
               ! any positive pressure means contact: the factor gives its value
               p(ix, iy) = tiny(p)
               changes = changes + 1
            end do
         end do
         if (changes == 0) return
         n = n + changes
      end do
   end subroutine solve_few

   !> Are the coefficients those of plain half-spaces, equal at opposite offsets?
   pure logical function is_plain(operator)
      class(compliance), intent(in) :: operator

      select type (operator)
      type is (elastic_operator)
         is_plain = .not. (allocated(operator%model%memory) .or. allocated(operator%model%inclination))
      class default
         is_plain = .false.
      end select
   end function is_plain

   !> Compute the factor for the elements with pressure
   subroutine fit(self, operator, p, fits)
      class(area_factor), intent(inout) :: self
      !> Operator whose table contains the coefficients
      class(compliance), intent(in) :: operator
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Is the number of elements within the limits?
      logical, intent(out) :: fits
      integer :: box(2, 2), shift(2), n, changes, k

      fits = .false.
      call area_box(size(p, 1), size(p, 2), p, n, box)
      if (n > most .or. n < least) return
      if (.not. allocated(self%lower)) allocate(self%lower(most, most), self%x(most), self%place(2, most), self%known(2, most), &
         & self%at(most), self%w(most, 2))
      if (.not. is_for(self, operator) .or. self%changes > most_changes) then
         self%n = 0
         self%dx = operator%dx
         self%dy = operator%dy
         self%model = operator%model
      end if
      call find_shift(self, p, n, box, shift, changes)
      do k = 1, self%n
         self%place(1, k) = self%known(1, k) + shift(1)
         self%place(2, k) = self%known(2, k) + shift(2)
      end do
      fits = changes == 0
      if (fits) return
      if (changes <= worth_changing*n) call adapt(self, operator, p, n, fits)
      if (.not. fits) call renew(self, operator, p, n, fits)
      self%box = box
   end subroutine fit

   !> Is the factor that of these bodies and elements?
   pure logical function is_for(self, operator)
      class(area_factor), intent(in) :: self
      !> Operator with the sides of elements and the bodies
      class(compliance), intent(in) :: operator

      is_for = .not. (abs(self%dx - operator%dx) > 0.0_wp .or. abs(self%dy - operator%dy) > 0.0_wp)
      if (is_for) is_for = self%model%same_as(operator%model)
   end function is_for

   !> Position of the elements of the factor in this window: as in its own, or relative to the first or the last ones of the area
   pure subroutine find_shift(self, p, n, box, shift, changes)
      type(area_factor), intent(in) :: self
      !> Pressures [N/mm2]
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Number of elements with pressure, and the window around them, see `area_box`
      integer, intent(in) :: n, box(2, 2)
      !> To be added to positions in the window of the factor
      integer, intent(out) :: shift(2)
      !> Number of elements that enter or leave
      integer, intent(out) :: changes
      integer :: candidate(2, 3), c, k, kept

      candidate(:, 1) = 0
      candidate(:, 2) = box(1, :) - self%box(1, :)
      candidate(:, 3) = box(2, :) - self%box(2, :)
      changes = huge(changes)
      shift = 0
      do c = 1, size(candidate, 2)
         if (any([(all(candidate(:, k) == candidate(:, c)), k=1, c - 1)])) cycle
         kept = 0
         do k = 1, self%n
            if (in_contact(p, self%known(1, k) + candidate(1, c), self%known(2, k) + candidate(2, c))) kept = kept + 1
         end do
         if (n + self%n - 2*kept >= changes) cycle
         changes = n + self%n - 2*kept
         shift = candidate(:, c)
         if (changes <= few_changes) return
      end do
   end subroutine find_shift

   !> Does an element have pressure? False outside the window
   pure logical function in_contact(p, ix, iy)
      !> Pressures [N/mm2]
      real(wp), contiguous, intent(in) :: p(:, :)
      integer, intent(in) :: ix, iy

      in_contact = ix >= 1 .and. ix <= size(p, 1) .and. iy >= 1 .and. iy <= size(p, 2)
      if (in_contact) in_contact = p(ix, iy) > 0.0_wp
   end function in_contact

   !> Positions of the elements with pressure, largest pressure first
   pure subroutine put_in_order(p, place)
      !> Pressures [N/mm2]
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Column and row of each element
      integer, contiguous, intent(inout) :: place(:, :)
      integer :: ix, iy, j, k

      k = 0
      do iy = 1, size(p, 2)
         do ix = 1, size(p, 1)
            if (.not. p(ix, iy) > 0.0_wp) cycle
            k = k + 1
            j = k
            do while (j > 1)
               if (p(place(1, j - 1), place(2, j - 1)) >= p(ix, iy)) exit
               place(:, j) = place(:, j - 1)
               j = j - 1
            end do
            place(:, j) = [ix, iy]
         end do
      end do
   end subroutine put_in_order

   !> Remove elements that left the contact from the factor, and append new ones
   subroutine adapt(self, operator, p, n, fits, h, pen)
      !> With the positions of its elements in this window
      type(area_factor), intent(inout) :: self
      !> Operator whose table contains the coefficients
      class(compliance), intent(in) :: operator
      !> Pressures [N/mm2]
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Number of elements with pressure
      integer, intent(in) :: n
      !> Is the matrix positive definite? Otherwise there is no factor any more
      logical, intent(out) :: fits
      !> Distance of the undeformed surfaces and approach [mm], for the right-hand side of new elements
      real(wp), contiguous, intent(in), optional :: h(:, :)
      real(wp), intent(in), optional :: pen
      real(wp) :: sides(2)
      integer :: ix, iy, j, k

      fits = .true.
      do k = self%n, 1, -1
         if (in_contact(p, self%place(1, k), self%place(2, k))) cycle
         call remove_row(self%n, k, most, self%lower, self%x, self%w)
         self%changes = self%changes + 1
         self%n = self%n - 1
         do j = k, self%n
            self%place(1, j) = self%place(1, j + 1)
            self%place(2, j) = self%place(2, j + 1)
         end do
      end do
      if (self%n < n) then
         call mark_taken(self, p)
         associate (table => operator%table, stride => size(operator%table%nn, 1))
            self%at(:self%n) = self%place(1, :self%n) + stride*self%place(2, :self%n)
            do iy = 1, size(p, 2)
               do ix = 1, size(p, 1)
                  if (.not. p(ix, iy) > 0.0_wp .or. self%taken(ix + size(p, 1)*(iy - 1))) cycle
                  k = self%n + 1
                  self%place(:, k) = [ix, iy]
                  self%at(k) = ix + stride*iy
                  call pick(size(table%nn), table%nn, own_place(table) + self%at(k), k, self%at, self%x)
                  sides = [1.0_wp, 0.0_wp]
                  if (present(h)) sides(2) = pen - h(ix, iy)
                  fits = append_row(self%n, most, self%lower, self%x, self%w, sides) > 0
                  if (.not. fits) then
                     self%n = 0
                     return
                  end if
                  self%changes = self%changes + 1
                  self%n = k
               end do
            end do
         end associate
      end if
      do k = 1, n
         self%known(1, k) = self%place(1, k)
         self%known(2, k) = self%place(2, k)
      end do
   end subroutine adapt

   !> Mark the elements of the window that are in the factor
   subroutine mark_taken(self, p)
      type(area_factor), intent(inout) :: self
      !> Pressures [N/mm2]
      real(wp), contiguous, intent(in) :: p(:, :)
      integer :: k

      if (allocated(self%taken)) then
         if (size(self%taken) < size(p)) deallocate(self%taken)
      end if
      if (.not. allocated(self%taken)) allocate(self%taken(2*size(p)))
      self%taken(:size(p)) = .false.
      do k = 1, self%n
         self%taken(self%place(1, k) + size(p, 1)*(self%place(2, k) - 1)) = .true.
      end do
   end subroutine mark_taken

   !> Compute the factor of the elements with pressure
   subroutine renew(self, operator, p, n, fits)
      type(area_factor), intent(inout) :: self
      !> Operator whose table contains the coefficients
      class(compliance), intent(in) :: operator
      !> Pressures [N/mm2]
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Number of elements with pressure
      integer, intent(in) :: n
      !> Is the matrix positive definite?
      logical, intent(out) :: fits
      integer :: k

      call put_in_order(p, self%place)
      associate (table => operator%table, stride => size(operator%table%nn, 1))
         self%at(:n) = self%place(1, :n) + stride*self%place(2, :n)
         do k = 1, n
            call pick(size(table%nn), table%nn, own_place(table) + self%at(k), n - k + 1, self%at(k:), self%lower(k:, k))
         end do
      end associate
      fits = factorize(n, most, self%lower, self%x) > 0
      self%n = merge(n, 0, fits)
      self%changes = 0
      if (.not. fits) return
      self%w(:n, 1) = 1.0_wp
      call solve_forward(n, most, self%lower, self%w(:, 1))
      do k = 1, n
         self%known(1, k) = self%place(1, k)
         self%known(2, k) = self%place(2, k)
      end do
   end subroutine renew

   !> Position of an element on itself in a table of coefficients as a vector, for a sum of positions of two elements
   pure integer function own_place(table)
      type(kernel_table), intent(in) :: table

      own_place = table%nx + 1 + size(table%nn, 1)*table%ny
   end function own_place

   !> Coefficients between an element and others
   pure subroutine pick(total, nn, from, n, at, values)
      !> Size of the table
      integer, intent(in) :: total
      !> Table of coefficients, even in both directions, as a vector
      real(wp), intent(in) :: nn(total)
      !> Position in it of the element on itself, plus the position of the element; number of the others, and their positions
      integer, intent(in) :: from, n, at(n)
      !> Coefficients [mm3/N]
      real(wp), intent(inout) :: values(n)
      integer :: k

      do k = 1, n
         values(k) = nn(from - at(k))
      end do
   end subroutine pick

   !> Forward and backward substitution
   pure subroutine substitute(self)
      class(area_factor), intent(inout) :: self

      call solve_forward(self%n, most, self%lower, self%x)
      call solve_backward(self%n, most, self%lower, self%x)
   end subroutine substitute

   !> Are all elements of the factor, at their last positions, in contact?
   pure logical function is_area(self, p)
      class(area_factor), intent(in) :: self
      !> Pressures [N/mm2]
      real(wp), contiguous, intent(in) :: p(:, :)
      integer :: k

      is_area = .true.
      do k = 1, self%n
         if (in_contact(p, self%place(1, k), self%place(2, k))) cycle
         is_area = .false.
         return
      end do
   end function is_area

   !> Derivative of the pressures with respect to the approach for a fixed area, if the factor is that of the area
   subroutine pressure_derivative(self, operator, p, n, q, found)
      class(area_factor), intent(inout) :: self
      !> Prepared for the window
      class(compliance), intent(in) :: operator
      !> Pressures of the last solution [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Number of elements with pressure
      integer, intent(in) :: n
      !> Derivative [N/mm3], shape (mx, my); zero outside the area
      real(wp), contiguous, intent(inout) :: q(:, :)
      !> Was the factor suitable? Otherwise q is unchanged
      logical, intent(out) :: found
      integer :: k

      found = .false.
      if (self%n == 0 .or. n /= self%n .or. .not. is_plain(operator)) return
      if (.not. (is_for(self, operator) .and. is_area(self, p))) then
         call self%fit(operator, p, found)
         if (.not. found) return
      end if
      found = .true.
      self%x(:self%n) = self%w(:self%n, 1)
      call solve_backward(self%n, most, self%lower, self%x)
      q = 0.0_wp
      do k = 1, self%n
         q(self%place(1, k), self%place(2, k)) = self%x(k)
      end do
   end subroutine pressure_derivative

   !> Pressures that cause given displacements for a fixed area, if there is a factor for the area
   subroutine pressure_responses(self, operator, p, displacement, response, found)
      class(area_factor), intent(inout) :: self
      !> Prepared for the window
      class(compliance), intent(in) :: operator
      !> Pressures of the last solution [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Required displacements on the area [mm per unit], shape (mx, my, cases)
      real(wp), contiguous, intent(in) :: displacement(:, :, :)
      !> Pressures [N/mm2 per unit], same shape; zero outside the area
      real(wp), contiguous, intent(inout) :: response(:, :, :)
      !> Was the factor suitable? Otherwise the response is unchanged
      logical, intent(out) :: found
      integer :: j, k

      found = .false.
      if (.not. is_plain(operator)) return
      call self%fit(operator, p, found)
      if (.not. found) return
      response = 0.0_wp
      do j = 1, size(displacement, 3)
         do k = 1, self%n
            self%x(k) = displacement(self%place(1, k), self%place(2, k), j)
         end do
         call self%substitute()
         do k = 1, self%n
            response(self%place(1, k), self%place(2, k), j) = self%x(k)
         end do
      end do
   end subroutine pressure_responses
end module contact_normal_few_elements
