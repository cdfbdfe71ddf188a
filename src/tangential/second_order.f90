!> What rolling needs to be of second order in the size of the elements
!>
!> Three things make the plain scheme one of first order: the tractions begin at the discrete edge of contact, which lies ahead of
!> the true one by some part of an element; the rigid slip and the slip belong to the middle of a step, half an element ahead of
!> the tractions; and so does the direction of slip. The rigid slip is the caller's. Here are
!>
!> - a term kappa p in the slip of the first elements of each row, which moves the discrete edge to where the pressures have theirs;
!> - a turn of the slip to the direction of its mean over the element, in slip areas, kept while the equations are solved
!>   and renewed in between.
!>
!> Rows of the equations are multiplied by a weight and the turn, so that the solver sees slip that it may scale by one number.
!> Derivation: doc/theory/second_order.md.
module contact_tangential_second_order
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: second_order, find_edge_terms

   !> Edge terms and turns of a tangential problem
   type :: second_order
      !> Leading elements with a term: column and row, shape (2, n)
      integer, allocatable :: at(:, :)
      !> Their terms xx, yy, xy [mm/(N/mm2)], shape (3, n)
      real(wp), allocatable :: kappa(:, :)
      !> Terms so large that the inverse of the whole operator says nothing about the element, shape (n)
      logical, allocatable :: stiff(:)
      !> Weight of a row of the equations times cosine and sine of its turn [-], shape (mx, my, 2)
      real(wp), allocatable :: row(:, :, :)
      !> Are the turns those of a former solution, to be kept?
      logical :: keeps_turns = .false.
   contains
      !> u := u + kappa p
      procedure :: add_terms
      !> Slip as the solver sees it: weighted and turned; and back
      procedure :: weigh, unweigh
      !> Around the approximate inverse of the operator: weights of rows taken off and given back; stiff elements left out
      procedure :: to_inverse, restore, keep_stiff
      !> Turns that belong to a slip
      procedure :: set_turns
      !> Slip in the middle of elements in place of that half a step ahead
      procedure :: centre_slip
   end type second_order

   !> Constants of the half-plane with piecewise constant tractions and steps of one element, by the factorisation of its symbol.
   !> Tractions grow as sqrt(n + d0) behind the edge, n elements from the first one; e0 = exp(l0) scales a term there;
   !> 3/2 - l1 is the ratio of the second to the first traction. l0, l1: Fourier coefficients of the logarithm of the even factor
   real(wp), parameter :: d0 = 0.825347_wp, e0 = 0.862164_wp, plain_ratio = 1.425993_wp
   !> Place of the edge that the ratio of pressures is first judged with, and passes that improve it [elements]; chosen
   real(wp), parameter :: first_place = 0.33_wp
   integer, parameter :: passes = 3
   !> Place of the edge in the mean, where nothing tells it [elements]
   real(wp), parameter :: usual_place = 0.5_wp
   !> Bounds of what pressures that are no roots of a distance would give: of the term, of the place and of the other end; chosen
   real(wp), parameter :: least_term = -0.4_wp, least_place = -0.1_wp, least_rest = 0.3_wp
   !> Edges in the outermost rows are steeper than the difference to their one neighbour by this factor: a root, sampled; measured
   real(wp), parameter :: outermost = 1.7_wp
   !> Terms above this part of the compliance of an element are stiff; chosen
   real(wp), parameter :: stiff_share = 0.5_wp
   !> Largest turn [rad]; chosen
   real(wp), parameter :: largest_turn = 0.5_wp
   !> Mean over an element by slip half a step behind, half a step ahead and three halves ahead of its middle: the parabola
   !> through them; without the last the straight line, without the first the straight line through the others
   real(wp), parameter :: by_three(3) = [5.0_wp, 8.0_wp, -1.0_wp]/12.0_wp, by_two(2) = [0.5_wp, 0.5_wp], &
      & by_next(2) = [1.5_wp, -0.5_wp]

contains

   !> Find the leading elements of all rows, where the edge of contact lies by the pressures, and the terms that move it there
   subroutine find_edge_terms(contact, pn, is_root, dx, dy, direction, nu, gg, diagonal, second, keeps_turns)
      !> Elements in contact, shape (mx, my)
      logical, intent(in) :: contact(:, :)
      !> Their pressures [N/mm2], shape (mx, my)
      real(wp), intent(in) :: pn(:, :)
      !> Are pressures a semi-ellipse in each row, at the centres of elements, and not a solution of the contact conditions with
      !> piecewise constant pressures?
      logical, intent(in) :: is_root
      !> Sides of the elements [mm]; a step is one element
      real(wp), intent(in) :: dx, dy
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> Combined Poisson ratio [-] and modulus of rigidity [N/mm2] that the edge feels
      real(wp), intent(in) :: nu, gg
      !> Compliance of an element A_xx(0) [mm/(N/mm2)]
      real(wp), intent(in) :: diagonal
      !> Gets terms and weights
      type(second_order), intent(inout) :: second
      !> Keep the turns as they are, for a problem that is solved again with other pressures; without them otherwise
      logical, intent(in), optional :: keeps_turns
      !> Row, element and place of each edge, in elements ahead of the first column; term relative to that of the kernel
      integer, allocatable :: at(:, :), first(:)
      real(wp), allocatable :: place(:), share(:)
      real(wp) :: slope, nx, ny, scale, mean
      integer :: ix, iy, k, n, last
      logical :: keeps

      keeps = .false.
      if (present(keeps_turns)) keeps = keeps_turns
      n = count_edges(contact, direction)
      allocate(at(2, n), first(size(contact, 2) + 1), place(n), share(n))
      n = 0
      do iy = 1, size(contact, 2)
         first(iy) = n + 1
         ix = merge(size(contact, 1), 1, direction > 0)
         do while (ix >= 1 .and. ix <= size(contact, 1))
            if (.not. contact(ix, iy)) then
               ix = ix - direction
               cycle
            end if
            last = ix
            do while (last >= 1 .and. last <= size(contact, 1))
               if (.not. contact(last, iy)) exit
               last = last - direction
            end do
            n = n + 1
            at(:, n) = [ix, iy]
            share(n) = 0.0_wp
            if (is_root) then
               share(n) = root_share(pn(ix:last + direction:-direction, iy))
            else if (abs(ix - last) > 1) then
               share(n) = edge_share(pn(ix, iy), pn(ix - direction, iy), abs(ix - last))
            end if
            place(n) = direction*ix + d0 - share(n)/(1.0_wp + share(n))
            ix = last
         end do
      end do
      first(size(contact, 2) + 1) = n + 1

      call fit(second, size(contact, 1), size(contact, 2), n, keeps)
      second%at = at
      do k = 1, n
         iy = at(2, k)
         slope = edge_slope(place, first, iy, place(k))*dx/dy
         nx = 1.0_wp/sqrt(1.0_wp + slope**2)
         ny = -slope*nx
         scale = 2.0_wp/gg*dx*nx*e0*share(k)
         second%kappa(:, k) = scale*[1.0_wp - nu*nx**2, 1.0_wp - nu*ny**2, -nu*direction*nx*ny]
         mean = sum(second%kappa(1:2, k))/2
         second%stiff(k) = mean > stiff_share*diagonal
         second%row(at(1, k), iy, :) = second%row(at(1, k), iy, :)*(diagonal/(diagonal + max(mean, 0.0_wp)))
      end do
   end subroutine find_edge_terms

   !> Arrays for so many terms; weights of 1, no turns, or those that are there already
   subroutine fit(second, mx, my, n, keeps_turns)
      type(second_order), intent(inout) :: second
      integer, intent(in) :: mx, my, n
      !> See find_edge_terms
      logical, intent(in) :: keeps_turns
      real(wp) :: length
      integer :: ix, iy

      if (allocated(second%at)) then
         if (size(second%stiff) /= n) deallocate(second%at, second%kappa, second%stiff)
      end if
      if (.not. allocated(second%at)) allocate(second%at(2, n), second%kappa(3, n), second%stiff(n))
      if (allocated(second%row)) then
         if (any(shape(second%row) /= [mx, my, 2])) deallocate(second%row)
      end if
      second%keeps_turns = keeps_turns .and. allocated(second%row)
      if (.not. allocated(second%row)) allocate(second%row(mx, my, 2))
      if (.not. second%keeps_turns) then
         second%row(:, :, 1) = 1.0_wp
         second%row(:, :, 2) = 0.0_wp
         return
      end if
      do iy = 1, my
         do ix = 1, mx
            length = hypot(second%row(ix, iy, 1), second%row(ix, iy, 2))
            second%row(ix, iy, :) = second%row(ix, iy, :)/length
         end do
      end do
   end subroutine fit

   !> Rows may have several stretches of contact, each with an edge
   pure integer function count_edges(contact, direction) result(n)
      logical, intent(in) :: contact(:, :)
      integer, intent(in) :: direction
      integer :: ix, iy
      logical :: ahead

      n = 0
      do iy = 1, size(contact, 2)
         do ix = 1, size(contact, 1)
            if (.not. contact(ix, iy)) cycle
            ahead = .false.
            if (ix + direction >= 1 .and. ix + direction <= size(contact, 1)) ahead = contact(ix + direction, iy)
            if (.not. ahead) n = n + 1
         end do
      end do
   end function count_edges

   !> Term of a leading element relative to that of the kernel, from the ratio of the second to the first pressure
   !>
   !> Pressures in a stretch of n elements go with the root of the distance to both ends; the one to the other end is taken off.
   pure real(wp) function edge_share(first, second, n) result(share)
      !> The first two pressures [N/mm2], and the number of elements
      real(wp), intent(in) :: first, second
      integer, intent(in) :: n
      real(wp) :: place
      integer :: pass

      share = 0.0_wp
      if (.not. first > 0.0_wp) return
      place = first_place
      do pass = 1, passes
         share = max(second/first*sqrt((n - 1 + place)/max(n - 2 + place, least_rest)) - plain_ratio, least_term)
         place = max(d0 - share/(1.0_wp + share), least_place)
      end do
   end function edge_share

   !> The same from a semi-ellipse at the centres of elements: its square is a parabola, whose zero is the edge
   pure real(wp) function root_share(pn) result(share)
      !> Pressures of a stretch, from its leading element on [N/mm2]
      real(wp), intent(in) :: pn(:)
      real(wp) :: bend, width, place

      place = usual_place
      if (size(pn) >= 3) then
         bend = pn(2)**2 - 0.5_wp*(pn(1)**2 + pn(3)**2)
         if (bend > 0.0_wp) then
            ! the square at the first centre is bend*place*(place + width), and width is that between both ends as seen from there
            width = (pn(2)**2 - pn(1)**2)/bend + 1.0_wp
            place = 0.5_wp*(sqrt(width**2 + 4.0_wp*pn(1)**2/bend) - width)
            ! the contact ends with the grid
            if (place > 1.0_wp) place = usual_place
         end if
      end if
      share = (d0 - place)/(1.0_wp - d0 + place)
   end function root_share

   !> Slope of the edge, elements along x per row: mean of the differences to the nearest edges of both neighbouring rows
   pure real(wp) function edge_slope(place, first, iy, here) result(slope)
      !> Places of all edges, and the number of the first one of each row; one more row has none
      real(wp), intent(in) :: place(:)
      integer, intent(in) :: first(:)
      !> Row and place of this edge
      integer, intent(in) :: iy
      real(wp), intent(in) :: here
      real(wp) :: nearest
      integer :: side, row, k, n

      slope = 0.0_wp
      n = 0
      do side = -1, 1, 2
         row = iy + side
         if (row < 1 .or. row > size(first) - 1) cycle
         if (first(row) == first(row + 1)) cycle
         nearest = place(first(row))
         do k = first(row) + 1, first(row + 1) - 1
            if (abs(place(k) - here) < abs(nearest - here)) nearest = place(k)
         end do
         slope = slope + (nearest - here)*side
         n = n + 1
      end do
      if (n == 1) slope = outermost*slope
      if (n == 2) slope = slope/n
   end function edge_slope

   pure subroutine add_terms(self, p, u)
      class(second_order), intent(in) :: self
      !> Tractions [N/mm2], shape (mx, my, 2)
      real(wp), intent(in) :: p(:, :, :)
      !> Change of displacement per step [mm], shape (mx, my, 2)
      real(wp), intent(inout) :: u(:, :, :)
      integer :: k

      do k = 1, size(self%at, 2)
         associate (ix => self%at(1, k), iy => self%at(2, k), c => self%kappa(:, k))
            u(ix, iy, 1) = u(ix, iy, 1) + c(1)*p(ix, iy, 1) + c(3)*p(ix, iy, 2)
            u(ix, iy, 2) = u(ix, iy, 2) + c(3)*p(ix, iy, 1) + c(2)*p(ix, iy, 2)
         end associate
      end do
   end subroutine add_terms

   pure subroutine weigh(self, slip)
      class(second_order), intent(in) :: self
      !> [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: slip(:, :, :)
      real(wp) :: x
      integer :: ix, iy

      do iy = 1, size(slip, 2)
         do ix = 1, size(slip, 1)
            x = slip(ix, iy, 1)
            slip(ix, iy, 1) = self%row(ix, iy, 1)*x - self%row(ix, iy, 2)*slip(ix, iy, 2)
            slip(ix, iy, 2) = self%row(ix, iy, 2)*x + self%row(ix, iy, 1)*slip(ix, iy, 2)
         end do
      end do
   end subroutine weigh

   pure subroutine unweigh(self, slip)
      class(second_order), intent(in) :: self
      !> [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: slip(:, :, :)
      real(wp) :: x, square
      integer :: ix, iy

      do iy = 1, size(slip, 2)
         do ix = 1, size(slip, 1)
            x = slip(ix, iy, 1)
            square = self%row(ix, iy, 1)**2 + self%row(ix, iy, 2)**2
            slip(ix, iy, 1) = (self%row(ix, iy, 1)*x + self%row(ix, iy, 2)*slip(ix, iy, 2))/square
            slip(ix, iy, 2) = (self%row(ix, iy, 1)*slip(ix, iy, 2) - self%row(ix, iy, 2)*x)/square
         end do
      end do
   end subroutine unweigh

   pure subroutine to_inverse(self, v)
      class(second_order), intent(in) :: self
      !> Residuals, shape (mx, my, 2)
      real(wp), intent(inout) :: v(:, :, :)
      integer :: k

      do k = 1, size(self%at, 2)
         associate (ix => self%at(1, k), iy => self%at(2, k))
            if (self%stiff(k)) then
               v(ix, iy, :) = 0.0_wp
            else
               v(ix, iy, :) = v(ix, iy, :)/hypot(self%row(ix, iy, 1), self%row(ix, iy, 2))
            end if
         end associate
      end do
   end subroutine to_inverse

   pure subroutine restore(self, v)
      class(second_order), intent(in) :: self
      !> As to_inverse left it, shape (mx, my, 2); stiff elements stay zero
      real(wp), intent(inout) :: v(:, :, :)
      integer :: k

      do k = 1, size(self%at, 2)
         associate (ix => self%at(1, k), iy => self%at(2, k))
            v(ix, iy, :) = v(ix, iy, :)*hypot(self%row(ix, iy, 1), self%row(ix, iy, 2))
         end associate
      end do
   end subroutine restore

   pure subroutine keep_stiff(self, v, u)
      class(second_order), intent(in) :: self
      !> What was given to the preconditioner, shape (mx, my, 2)
      real(wp), intent(in) :: v(:, :, :)
      !> What it made of it: in stiff elements the same
      real(wp), intent(inout) :: u(:, :, :)
      integer :: k

      do k = 1, size(self%at, 2)
         if (self%stiff(k)) u(self%at(1, k), self%at(2, k), :) = v(self%at(1, k), self%at(2, k), :)
      end do
   end subroutine keep_stiff

   pure subroutine set_turns(self, contact, slips, direction, slip)
      class(second_order), intent(inout) :: self
      !> Elements in contact, and those in slip, shape (mx, my)
      logical, intent(in) :: contact(:, :), slips(:, :)
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> Slip per step, neither weighted nor turned [mm], shape (mx, my, 2)
      real(wp), intent(in) :: slip(:, :, :)
      real(wp) :: weight, angle, mean(2)
      integer :: ix, iy

      do iy = 1, size(contact, 2)
         do ix = 1, size(contact, 1)
            if (.not. contact(ix, iy)) cycle
            weight = hypot(self%row(ix, iy, 1), self%row(ix, iy, 2))
            self%row(ix, iy, :) = [weight, 0.0_wp]
            if (.not. slips(ix, iy)) cycle
            mean = mean_slip(contact, slips, direction, slip, ix, iy)
            associate (s => slip(ix, iy, :))
               ! where slip reverses, within an element or two, its mean tells nothing
               if (s(1)*mean(1) + s(2)*mean(2) <= 0.0_wp) cycle
               angle = atan2(s(1)*mean(2) - s(2)*mean(1), s(1)*mean(1) + s(2)*mean(2))
            end associate
            angle = max(-largest_turn, min(largest_turn, angle))
            self%row(ix, iy, :) = weight*[cos(angle), sin(angle)]
         end do
      end do
   end subroutine set_turns

   !> In slip as long as the mean over the element, against its tractions; zero in adhesion
   pure subroutine centre_slip(self, contact, slips, direction, slip)
      class(second_order), intent(in) :: self
      !> Elements in contact, and those in slip, shape (mx, my)
      logical, intent(in) :: contact(:, :), slips(:, :)
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> On entry as the solver sees it [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: slip(:, :, :)
      real(wp), allocatable :: ahead(:, :, :)
      real(wp) :: length, mean(2)
      integer :: ix, iy

      allocate(ahead, source=slip)
      call self%unweigh(ahead)
      do iy = 1, size(contact, 2)
         do ix = 1, size(contact, 1)
            length = hypot(slip(ix, iy, 1), slip(ix, iy, 2))
            if (.not. slips(ix, iy) .or. .not. length > 0.0_wp) then
               slip(ix, iy, :) = ahead(ix, iy, :)
            else
               mean = mean_slip(contact, slips, direction, ahead, ix, iy)
               slip(ix, iy, :) = slip(ix, iy, :)*(hypot(mean(1), mean(2))/length)
            end if
         end do
      end do
   end subroutine centre_slip

   !> Mean of the slip over an element
   pure function mean_slip(contact, slips, direction, slip, ix, iy) result(mean)
      logical, intent(in) :: contact(:, :), slips(:, :)
      integer, intent(in) :: direction
      real(wp), intent(in) :: slip(:, :, :)
      integer, intent(in) :: ix, iy
      real(wp) :: mean(2)
      logical :: has_behind, has_ahead
      integer :: behind, ahead

      behind = ix - direction
      ahead = ix + direction
      has_behind = behind >= 1 .and. behind <= size(contact, 1)
      if (has_behind) has_behind = contact(behind, iy)
      has_ahead = ahead >= 1 .and. ahead <= size(contact, 1)
      if (has_ahead) has_ahead = slips(ahead, iy)
      if (has_behind .and. has_ahead) then
         mean = by_three(1)*slip(behind, iy, :) + by_three(2)*slip(ix, iy, :) + by_three(3)*slip(ahead, iy, :)
      else if (has_behind) then
         mean = by_two(1)*slip(behind, iy, :) + by_two(2)*slip(ix, iy, :)
      else if (has_ahead) then
         mean = by_next(1)*slip(ix, iy, :) + by_next(2)*slip(ahead, iy, :)
      else
         mean = slip(ix, iy, :)
      end if
   end function mean_slip
end module contact_tangential_second_order
