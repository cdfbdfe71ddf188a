!> What rolling needs to be of second order in the size of the elements
!>
!> Three things make the plain scheme one of first order: the tractions begin at the discrete edge of contact, which lies ahead of
!> the true one by some part of an element; the rigid slip and the slip belong to the middle of a step, half an element ahead of
!> the tractions; and so does the direction of slip. The rigid slip is the caller's. Here are
!>
!> - a term kappa p in the slip of the first elements of each row, which moves the discrete edge to where the pressures have theirs;
!> - a turn of the slip to the direction of its mean over the element, in slip areas (`contact_tangential_slip_turns`).
!>
!> Rows of the equations are multiplied by a weight, so that the solver sees slip that it may scale by one number.
!> Derivation: doc/theory/second_order.md.
module contact_tangential_second_order
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_tangential_edge_neighbours, only : edge_slope, find_parts
   use contact_tangential_slip_means, only : local_mean, mean_length, mean_slip
   use contact_tangential_slip_turns, only : turn_between
   implicit none (type, external)
   private

   public :: bodies_end, find_edge_terms, is_known, second_order, unknown_gap

   !> Edge terms of a tangential problem, and whether its slip is turned
   type :: second_order
      !> Elements with a term, column and row, shape (2, n): the leading ones, then the second and third of their rows
      integer, allocatable :: at(:, :)
      !> Distance of the surfaces in the element ahead of a leading one [mm], `unknown_gap` where it is not known, `bodies_end`
      !> where no contact is possible, shape (mx, my)
      real(wp), allocatable :: gap(:, :)
      !> Their terms xx, yy, xy [mm/(N/mm2)], shape (3, n)
      real(wp), allocatable :: kappa(:, :)
      !> Terms so large that the inverse of the whole operator does not represent the element, shape (n)
      logical, allocatable :: stiff(:)
      !> Weight of a row of the equations [-], shape (mx, my)
      real(wp), allocatable :: weight(:, :)
      !> Parts of the neighbours behind and ahead and of the bend of directions in the mean of the slip [-], shape (3, mx, my)
      real(wp), allocatable :: part(:, :, :)
      !> Is the slip turned? Not while a solution is far off
      logical :: turns = .true.
   contains
      !> u := u + kappa p
      procedure :: add_terms
      !> Before and behind the approximate inverse of the operator: stiff elements left out
      procedure :: leave_stiff, keep_stiff
      !> Cosine and sine of the turn of the slip of an element
      procedure :: turn_of
      !> Slip in the middle of elements in place of that half a step ahead
      procedure :: centre_slip
      !> Half a turn of the contact
      procedure :: turn_round
   end type second_order

   !> Gap that is not known [mm]. Known gaps are not negative, but their changes may take them below zero
   real(wp), parameter :: unknown_gap = -huge(1.0_wp)
   !> In place of a gap that is not known: the bodies end between this element and the one ahead, so contact ends there at the
   !> latest
   real(wp), parameter :: bodies_end = 0.75_wp*unknown_gap
   !> Constants of the half-plane with piecewise constant tractions and steps of one element, by the factorisation of its symbol.
   !> Tractions grow as sqrt(n + d0) behind the edge, n elements from the first one; e0 = exp(l0) scales a term there;
   !> 3/2 - l1 is the ratio of the second to the first traction. l0, l1: Fourier coefficients of the logarithm of the even factor
   real(wp), parameter :: d0 = 0.825347_wp, e0 = 0.862164_wp, plain_ratio = 1.425993_wp
   !> Position of the edge for the first evaluation of the ratio of pressures [elements], passes that improve it; chosen
   real(wp), parameter :: first_place = 0.33_wp
   integer, parameter :: passes = 3
   !> Mean position of the edge, used where it is not known [elements]
   real(wp), parameter :: usual_place = 0.5_wp
   !> Border of an element, and the term of an edge there: the least one where the bodies end
   real(wp), parameter :: border = 0.5_wp, border_share = (d0 - border)/(1.0_wp - d0 + border)
   !> Bounds for pressures that are not roots of a distance: of the term, of the position and of the other end; chosen
   real(wp), parameter :: least_term = -0.4_wp, least_place = -0.1_wp, least_rest = 0.3_wp
   !> Passes of positions of edges from gaps, which need slopes, and of slopes from positions; chosen
   integer, parameter :: slope_passes = 2
   !> Maximum term behind an oblique edge relative to the compliance of an element: elements that are short along the direction of
   !> rolling are beyond the fit, and equations with a larger negative term need not have a solution; chosen
   real(wp), parameter :: largest_oblique = 0.5_wp
   !> Terms above this part of the compliance of an element are stiff; chosen
   real(wp), parameter :: stiff_share = 0.5_wp

   !> A layer of flexibility r, relative to that of an element, has e0 + r + ln(1 + r (c(1) + c(2)/(1 + c(3) r^c(4))))/pi in place
   !> of e0, and 1 - (1 - d0)/(1 + b(1) r^b(2)) in place of d0. Fitted to the integrals of the factorisation, within 4e-3
   real(wp), parameter :: layer_scale(4) = [0.57_wp, 0.505_wp, 0.58_wp, 0.8_wp], layer_place(2) = [3.1_wp, 0.85_wp]
   !> Distance from the pole of the term of a layer below which it does not grow any more [elements]: the first traction vanishes
   real(wp), parameter :: nearest_pole = 1.0e-3_wp

   !> Edges at the leading ends of all stretches of contact, row by row
   type :: edge_list
      !> Column and row of the leading elements, shape (2, edges); index of the first edge of each row, and of one more row
      integer, allocatable :: at(:, :), first(:)
      !> Numbers of elements of the stretches, and the sums of their pressures [N/mm2]
      integer, allocatable :: length(:)
      real(wp), allocatable :: load(:)
      !> Positions along the rolling direction [elements]; terms of the leading elements relative to that of the kernel [-]
      real(wp), allocatable :: place(:), share(:)
   end type edge_list

contains

   !> Find the leading elements of all rows, where the edge of contact lies by the pressures, and the terms that move it there
   subroutine find_edge_terms(contact, pn, gap, is_root, dx, dy, direction, nu, gg, diagonal, layer, second)
      !> Elements in contact, shape (mx, my)
      logical, intent(in) :: contact(:, :)
      !> Their pressures [N/mm2], shape (mx, my)
      real(wp), intent(in) :: pn(:, :)
      !> Distance of the surfaces in the element ahead [mm], shape (mx, my), see `gap` of the result. Only values of leading
      !> elements are used. The terms are smooth functions of known gaps, also where these pass zero
      real(wp), intent(in) :: gap(:, :)
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
      !> Part of it that is the displacement of a layer between the bodies
      real(wp), intent(in) :: layer
      !> Gets terms and weights
      type(second_order), intent(inout) :: second
      type(edge_list) :: edges
      real(wp) :: slope, nx, ny, flexibility, scale, excess, unit, mean, ahead, part(2), oblique(3)
      integer :: ix, iy, k, behind, j

      call find_edges(contact, pn, gap, is_root, dx, dy, direction, (1.0_wp - nu)/gg, second, edges)
      call fit(second, size(edges%place) + count(edges%length > 1) + count(edges%length > 2))
      second%gap = gap
      behind = size(edges%place)
      do k = 1, size(edges%place)
         ix = edges%at(1, k)
         iy = edges%at(2, k)
         slope = edge_slope(edges%place, edges%load, edges%first, iy, k)
         nx = 1.0_wp/sqrt(1.0_wp + (slope*dx/dy)**2)
         ny = -slope*dx/dy*nx
         flexibility = 2.0_wp/gg*dx*nx
         unit = flexibility*e0
         scale = unit*edges%share(k)
         excess = max(scale, 0.0_wp)
         if (is_known(gap(ix, iy))) then
            scale = gap(ix, iy)/((1.0_wp - nu)*pn(ix, iy))
            excess = scale
         end if
         second%at(:, k) = edges%at(:, k)
         second%kappa(:, k) = scale*[1.0_wp - nu*nx**2, 1.0_wp - nu*ny**2, -nu*direction*nx*ny]
         oblique = 2.0_wp/gg*dx*nu*oblique_terms(slope, dx/dy)*[1, 1, direction]
         ! next to a layer the bodies do not see the steps of the edge
         oblique = bounded(oblique/(1.0_wp + layer/flexibility), diagonal)
         ahead = d0 - scale/(unit + scale)
         if (layer > 0.0_wp) second%kappa(:, k) = layer_terms(ahead, flexibility, nu, layer, [nx, direction*ny], -huge(1.0_wp))
         mean = sum(second%kappa(1:2, k))/2
         second%stiff(k) = mean > stiff_share*diagonal
         second%weight(ix, iy) = diagonal/(diagonal + max(mean, 0.0_wp))
         ! the terms behind move from element to element as the edge does, so that forces are continuous
         part(1) = unit/(unit + excess)
         part(2) = 1.0_wp - part(1)
         do j = 1, min(2, edges%length(k) - 1)
            behind = behind + 1
            second%at(:, behind) = [ix - j*direction, iy]
            second%kappa(:, behind) = part(j)*oblique
            ! next to a layer tractions begin farther ahead of an element than the edge lies where another one enters
            if (j == 1 .and. layer > 0.0_wp) second%kappa(:, behind) = second%kappa(:, behind) &
               & + layer_terms(ahead + 1.0_wp, flexibility, nu, layer, [nx, direction*ny], 0.0_wp)
            second%stiff(behind) = .false.
         end do
      end do
   end subroutine find_edge_terms

   !> Find the leading elements of all rows, the parts of neighbours, and where the edge of contact lies
   subroutine find_edges(contact, pn, gap, is_root, dx, dy, direction, compliance, second, edges)
      !> Elements in contact, shape (mx, my)
      logical, intent(in) :: contact(:, :)
      !> Their pressures [N/mm2], and the distances of the surfaces in the elements ahead [mm], see find_edge_terms, shape (mx, my)
      real(wp), intent(in) :: pn(:, :), gap(:, :)
      !> Are pressures a semi-ellipse in each row?
      logical, intent(in) :: is_root
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> (1 - nu)/G that the edge feels [mm2/N]
      real(wp), intent(in) :: compliance
      !> Gets the parts of neighbours
      type(second_order), intent(inout) :: second
      !> The edges, row by row
      type(edge_list), intent(out) :: edges
      !> Terms by the gap of a straight edge, relative to that of the kernel [-]
      real(wp), allocatable :: by_gap(:)
      real(wp) :: slope
      integer :: ix, iy, k, n, last, pass

      n = count_edges(contact, direction)
      allocate(edges%at(2, n), edges%first(size(contact, 2) + 1), edges%place(n), edges%share(n), edges%length(n), edges%load(n), &
         & by_gap(n))
      call fit_fields(second, size(contact, 1), size(contact, 2))
      associate (at => edges%at, first => edges%first, place => edges%place, share => edges%share, length => edges%length, &
         & load => edges%load)
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
               length(n) = abs(ix - last)
               call find_parts(pn(:, iy), ix, length(n), direction, 1.0_wp/plain_ratio, second%part(:, :, iy), load(n))
               share(n) = 0.0_wp
               if (is_known(gap(ix, iy))) then
                  by_gap(n) = gap(ix, iy)/(compliance*pn(ix, iy)*2.0_wp*dx*e0)
                  share(n) = by_gap(n)
               else if (is_root) then
                  share(n) = root_share(pn(ix:last + direction:-direction, iy))
               else if (length(n) > 1) then
                  share(n) = edge_share(pn(ix, iy), pn(ix - direction, iy), length(n))
               end if
               ! pressures grow towards the end of a body, and their ratio does not tell where it is
               if (ends(gap(ix, iy)) .and. .not. is_root) share(n) = max(share(n), border_share)
               place(n) = direction*ix + d0 - share(n)/(1.0_wp + share(n))
               ix = last
            end do
         end do
         first(size(contact, 2) + 1) = n + 1

         do pass = 1, slope_passes
            do k = 1, n
               if (.not. is_known(gap(at(1, k), at(2, k)))) cycle
               slope = edge_slope(place, load, first, at(2, k), k)
               share(k) = by_gap(k)*sqrt(1.0_wp + (slope*dx/dy)**2)
            end do
            place = direction*at(1, :) + d0 - share/(1.0_wp + share)
         end do
      end associate
   end subroutine find_edges

   !> Terms xx, yy, xy of an element by its distance from the edge, where there is a layer between the bodies [mm/(N/mm2)]
   !>
   !> With E + 2 r |sin(theta/2)| in place of the even factor E, r the flexibility of the layer relative to that of an element, the
   !> factorisation gives terms P f, f = t/(1 - t), t = Z - place, with P and Z in place of e0 and d0. Along and across the edge r
   !> is different.
   pure function layer_terms(place, flexibility, nu, layer, normal, least) result(terms)
      !> Distance of the edge ahead of the centre of the element [elements]
      real(wp), intent(in) :: place
      !> Of an element to tractions along the edge, 2/G h n_x [mm/(N/mm2)]; to those across it 1 - nu times that
      real(wp), intent(in) :: flexibility, nu
      !> Displacement of the layer per unit traction [mm/(N/mm2)]
      real(wp), intent(in) :: layer
      !> Normal of the edge [-], and the least part of an element by which a term moves the edge
      real(wp), intent(in) :: normal(2), least
      real(wp) :: terms(3)
      !> Across and along the edge
      real(wp) :: flexible(2), term(2)
      real(wp) :: ratio, scale, pole
      integer :: k

      flexible = flexibility*[1.0_wp - nu, 1.0_wp]
      do k = 1, 2
         ratio = layer/flexible(k)
         scale = e0 + ratio &
            & + log(1.0_wp + ratio*(layer_scale(1) + layer_scale(2)/(1.0_wp + layer_scale(3)*ratio**layer_scale(4))))/pi
         pole = (1.0_wp - d0)/(1.0_wp + layer_place(1)*ratio**layer_place(2))
         term(k) = flexible(k)*scale*max(1.0_wp - pole - place, least)/max(place + pole, nearest_pole)
      end do
      terms = [term(1)*normal(1)**2 + term(2)*normal(2)**2, term(1)*normal(2)**2 + term(2)*normal(1)**2, &
         & (term(1) - term(2))*normal(1)*normal(2)]
   end function layer_terms

   !> Is a gap known?
   elemental logical function is_known(gap)
      !> [mm]
      real(wp), intent(in) :: gap

      is_known = gap > 0.5_wp*unknown_gap
   end function is_known

   !> Do the bodies end at this element?
   elemental logical function ends(gap)
      !> [mm]
      real(wp), intent(in) :: gap

      ends = gap > 0.5_wp*unknown_gap + 0.5_wp*bodies_end .and. .not. is_known(gap)
   end function ends

   !> Terms behind an oblique edge, one of whose principal values is negative, reduced to a part of the compliance of an element
   pure function bounded(oblique, diagonal) result(terms)
      !> Terms xx, yy, xy with a trace of zero, and compliance of an element [mm/(N/mm2)]
      real(wp), intent(in) :: oblique(3), diagonal
      real(wp) :: terms(3)

      terms = min(1.0_wp, largest_oblique*diagonal/max(norm2(oblique([1, 3])), tiny(1.0_wp)))*oblique
   end function bounded

   !> Terms xx, yy, xy of the second element of a row at an oblique edge, relative to nu 2/G h
   pure function oblique_terms(slope, ratio) result(terms)
      !> Elements along x per row by which the edge goes forward
      real(wp), intent(in) :: slope
      !> Of the sides of the elements, along x to across
      real(wp), intent(in) :: ratio
      real(wp) :: terms(3)
      real(wp) :: along, square
      !> Fitted to residuals of tractions in proportion to pressures, by the adjoint of adhesion, of ellipses with sides of elements
      !> of 1:4 to 4:1; tests/accuracy/oblique_edges.py compares them with those of the kernel
      real(wp), parameter :: of_direction = 1.0_wp/24.0_wp, of_steps = 0.1204_wp, few_steps = 12.9_wp, narrow = 0.746_wp
      real(wp), parameter :: of_diagonal = 0.0229_wp, few_rows = 31.0_wp, of_ratio = 0.42_wp

      along = slope*ratio
      square = slope**2
      terms(3) = of_direction*along/(1.0_wp + along**2) &
         & + sign(of_steps*square/(ratio*(square + few_steps) + narrow*square*ratio**2), slope)
      terms(1) = of_diagonal*abs(slope)*square/((square + few_rows)*ratio**of_ratio)
      terms(2) = -terms(1)
   end function oblique_terms

   !> Arrays for this number of terms
   subroutine fit(second, n)
      type(second_order), intent(inout) :: second
      integer, intent(in) :: n

      if (allocated(second%at)) then
         if (size(second%stiff) /= n) deallocate(second%at, second%kappa, second%stiff)
      end if
      if (.not. allocated(second%at)) allocate(second%at(2, n), second%kappa(3, n), second%stiff(n))
      second%turns = .true.
   end subroutine fit

   !> Fields of this size; weights of 1
   subroutine fit_fields(second, mx, my)
      type(second_order), intent(inout) :: second
      integer, intent(in) :: mx, my

      if (allocated(second%weight)) then
         if (any(shape(second%weight) /= [mx, my])) deallocate(second%weight, second%part)
      end if
      if (.not. allocated(second%weight)) allocate(second%weight(mx, my), second%part(3, mx, my))
      second%weight = 1.0_wp
      second%part = 0.0_wp
   end subroutine fit_fields

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

   pure subroutine leave_stiff(self, v)
      class(second_order), intent(in) :: self
      !> Residuals, shape (mx, my, 2); zero in stiff elements on exit
      real(wp), intent(inout) :: v(:, :, :)
      integer :: k

      do k = 1, size(self%at, 2)
         if (self%stiff(k)) v(self%at(1, k), self%at(2, k), :) = 0.0_wp
      end do
   end subroutine leave_stiff

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

   subroutine turn_round(self, mx, my)
      class(second_order), intent(inout) :: self
      !> Size of the window
      integer, intent(in) :: mx, my

      self%at(1, :) = mx + 1 - self%at(1, :)
      self%at(2, :) = my + 1 - self%at(2, :)
      self%weight = self%weight(mx:1:-1, my:1:-1)
      self%part = self%part(:, mx:1:-1, my:1:-1)
      self%gap = self%gap(mx:1:-1, my:1:-1)
   end subroutine turn_round

   pure function turn_of(self, mx, my, direction, slip, ix, iy) result(turn)
      class(second_order), intent(in) :: self
      !> Size of the window; rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: mx, my, direction
      !> Slip per step [mm]
      real(wp), intent(in) :: slip(mx, my, 2)
      !> The element
      integer, intent(in) :: ix, iy
      real(wp) :: turn(2)
      type(local_mean) :: mean

      mean = mean_slip(mx, my, self%part(:, ix, iy), direction, slip, ix, iy)
      turn = turn_between([slip(ix, iy, 1), slip(ix, iy, 2)], mean%value)
   end function turn_of

   !> In slip as long as the mean over the element, against its tractions
   pure subroutine centre_slip(self, contact, slips, direction, slip)
      class(second_order), intent(in) :: self
      !> Elements in contact, and those in slip, shape (mx, my)
      logical, contiguous, intent(in) :: contact(:, :), slips(:, :)
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> On entry half a step ahead [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: slip(:, :, :)
      real(wp), allocatable :: ahead(:, :, :)
      type(local_mean) :: mean
      real(wp) :: w(2), turn(2)
      integer :: ix, iy

      allocate(ahead, source=slip)
      do iy = 1, size(contact, 2)
         do ix = 1, size(contact, 1)
            if (.not. slips(ix, iy)) cycle
            w = ahead(ix, iy, :)
            mean = mean_slip(size(contact, 1), size(contact, 2), self%part(:, ix, iy), direction, ahead, ix, iy)
            if (.not. any(abs(w) > 0.0_wp)) cycle
            turn = [1.0_wp, 0.0_wp]
            if (self%turns) turn = turn_between(w, mean%value)
            slip(ix, iy, :) = mean_length(size(contact, 1), size(contact, 2), mean, ahead, ix, iy)/norm2(w) &
               & *[turn(1)*w(1) - turn(2)*w(2), turn(2)*w(1) + turn(1)*w(2)]
         end do
      end do
   end subroutine centre_slip

end module contact_tangential_second_order
