!> The turn of the slip to its mean over an element, for rolling of second order, and its derivative
!>
!> Tractions in the middle of an element are opposed to the mean of the slip over it, by that of the element and of its
!> neighbours along the row. Turns are functions of the slip, smooth where elements slip; the derivative changes each
!> element's slip by one angle that depends on three. Derivation: doc/theory/second_order.md.
module contact_tangential_slip_turns
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: acting_slip, local_mean, mean_slip, slip_turns, turn_between

   !> Derivative of the acting slip by the slip, in elements where it is not the identity: the weight and the turn, and the
   !> change of the angle by the slip of the element and of its neighbours along the row
   type :: slip_turns
      !> How many elements; columns of the neighbour behind, of the element and of the neighbour ahead, that of the element
      !> where there is none, and row; shape (4, mx my)
      integer :: n = 0
      integer, allocatable :: at(:, :)
      !> Weight times cosine and sine of the turn [-]; what the acting slip changes by per angle [mm]; shape (2, mx my)
      real(wp), allocatable :: row(:, :), across(:, :)
      !> The same for the way back: the row over its square, and what the slip changes by per angle, without weight and turn
      real(wp), allocatable :: back(:, :), bare(:, :)
      !> The angle per slip behind, here and ahead [1/mm], shape (2, 3, mx my)
      real(wp), allocatable :: by(:, :, :)
      !> Elimination of the angles, a tridiagonal system for each row: factors of the former one and of the next, and of the
      !> right-hand side, shape (mx my)
      real(wp), allocatable :: former(:), next(:), pivot(:)
      !> Scratch: changes of the angles, shape (mx my)
      real(wp), allocatable :: angle(:)
      !> Is the transposed derivative in use, of a contact that is turned by half a turn?
      logical :: is_transposed = .false.
   contains
      !> Derivative at a slip, and the acting slip there
      procedure :: linearise => linearise_turns
      procedure :: act
      !> Change of slip into change of acting slip, and back
      procedure :: apply, invert
      !> The transposed of both
      procedure :: apply_transposed, invert_transposed
      !> Half a turn of the contact
      procedure :: turn_round => turn_turns_round
   end type slip_turns

   !> Share of the square of slip ahead in that here at which the mean is half way between that of two and that of three; chosen
   real(wp), parameter :: half_way = 0.02_wp
   !> Part of the difference of slip and mean in the product of their lengths; it is of fourth order where slip is smooth; chosen
   real(wp), parameter :: apart = 0.0625_wp
   !> Pivots below this one, where slip is small beside that of the neighbours, are raised: the inverse only preconditions; chosen
   real(wp), parameter :: least_pivot = 0.2_wp
   !> Mean over an element by slip half a step behind, half a step ahead and three halves ahead of its middle: the parabola
   !> through them; without the last the straight line, without the first the straight line through the others
   real(wp), parameter :: by_three(3) = [5.0_wp, 8.0_wp, -1.0_wp]/12.0_wp, &
      & by_two(3) = [0.5_wp, 0.5_wp, 0.0_wp], by_next(3) = [0.0_wp, 1.5_wp, -0.5_wp]

   !> Mean slip over an element
   type :: local_mean
      !> [mm]
      real(wp) :: value(2) = 0.0_wp
      !> Columns of the neighbours behind and ahead, that of the element itself where there is none
      integer :: behind = 0, ahead = 0
      !> Parts of the slip behind, here and ahead
      real(wp) :: share(3) = [0.0_wp, 1.0_wp, 0.0_wp]
      !> Share of the mean of two in that value, where there are neighbours on both sides
      real(wp) :: of_two = 0.0_wp
   end type local_mean

contains

   !> Cosine and sine of the turn for a slip and its mean: by the angle between them where it is small, none where they are opposed
   !>
   !> Of an angle a the turn is 2 atan(sin a (1 + cos a)/4), 0.6 at most. The product of lengths in sine and cosine has a part of
   !> the difference of both, so that turns are smooth where either of them vanishes.
   pure function turn_between(slip, mean) result(turn)
      !> Slip, and its mean over the element [mm]
      real(wp), intent(in) :: slip(2), mean(2)
      real(wp) :: turn(2)
      real(wp) :: length, half

      turn = [1.0_wp, 0.0_wp]
      length = product_of_lengths(slip, mean)
      if (.not. length > 0.0_wp) return
      half = 0.25_wp*(slip(1)*mean(2) - slip(2)*mean(1))/length*(1.0_wp + (slip(1)*mean(1) + slip(2)*mean(2))/length)
      turn = [1.0_wp - half**2, 2.0_wp*half]/(1.0_wp + half**2)
   end function turn_between

   !> Its square is |S|**2 |D|**2 + apart |S - D|**4 [mm2]
   pure real(wp) function product_of_lengths(slip, mean) result(length)
      !> As in turn_between
      real(wp), intent(in) :: slip(2), mean(2)

      length = sqrt((slip(1)**2 + slip(2)**2)*(mean(1)**2 + mean(2)**2) &
         & + apart*((slip(1) - mean(1))**2 + (slip(2) - mean(2))**2)**2)
   end function product_of_lengths

   !> Derivatives of the angle of the turn by the slip and by its mean
   pure subroutine differentiate_turn(slip, mean, by_slip, by_mean)
      !> As in turn_between, not both zero
      real(wp), intent(in) :: slip(2), mean(2)
      !> [1/mm]
      real(wp), intent(out) :: by_slip(2), by_mean(2)
      real(wp) :: length, sine, cosine, half, factor, pull(2)

      length = product_of_lengths(slip, mean)
      sine = (slip(1)*mean(2) - slip(2)*mean(1))/length
      cosine = (slip(1)*mean(1) + slip(2)*mean(2))/length
      half = 0.25_wp*sine*(1.0_wp + cosine)
      ! those of the cross and the dot product; then of the length, by which sine and cosine fall
      by_slip = (1.0_wp + cosine)*[mean(2), -mean(1)] + sine*mean
      by_mean = (1.0_wp + cosine)*[-slip(2), slip(1)] + sine*slip
      factor = sine*(1.0_wp + 2.0_wp*cosine)/length
      pull = 2.0_wp*apart*sum((slip - mean)**2)*(slip - mean)
      by_slip = by_slip - factor*(sum(mean**2)*slip + pull)
      by_mean = by_mean - factor*(sum(slip**2)*mean - pull)
      factor = 0.5_wp/(length*(1.0_wp + half**2))
      by_slip = factor*by_slip
      by_mean = factor*by_mean
   end subroutine differentiate_turn

   !> Slip of an element as the contact conditions see it: weighted, and turned where it slips [mm]
   pure function acting_slip(weight, is_turned, contact, direction, p, bound, slip, r, ix, iy) result(w)
      !> Weights of the rows of the equations [-], shape (mx, my)
      real(wp), intent(in) :: weight(:, :)
      !> Is slip turned?
      logical, intent(in) :: is_turned
      !> Elements in contact, shape (mx, my)
      logical, intent(in) :: contact(:, :)
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> Tractions [N/mm2], shape (mx, my, 2), and their bound, shape (mx, my)
      real(wp), intent(in) :: p(:, :, :), bound(:, :)
      !> Slip per step [mm], shape (mx, my, 2), and its scale [(N/mm2)/mm]
      real(wp), intent(in) :: slip(:, :, :), r
      !> Its column and row
      integer, intent(in) :: ix, iy
      real(wp) :: w(2)
      type(local_mean) :: mean
      real(wp) :: turn(2)

      w = weight(ix, iy)*[slip(ix, iy, 1), slip(ix, iy, 2)]
      if (.not. is_turned) return
      if (.not. leaves_disc([p(ix, iy, 1), p(ix, iy, 2)], w, bound(ix, iy), r)) return
      mean = mean_slip(contact, direction, slip, ix, iy)
      turn = turn_between([slip(ix, iy, 1), slip(ix, iy, 2)], mean%value)
      w = [turn(1)*w(1) - turn(2)*w(2), turn(2)*w(1) + turn(1)*w(2)]
   end function acting_slip

   !> Does an element slip? Its traction less its slip lies outside of the disc of its bound
   pure logical function leaves_disc(p, slip, bound, r) result(leaves)
      !> Traction and bound [N/mm2], weighted slip [mm] and its scale [(N/mm2)/mm]
      real(wp), intent(in) :: p(2), slip(2), bound, r

      leaves = (p(1) - r*slip(1))**2 + (p(2) - r*slip(2))**2 > bound**2
   end function leaves_disc

   subroutine linearise_turns(self, weight, is_turned, contact, direction, p, bound, slip, r)
      class(slip_turns), intent(inout) :: self
      !> Weights of the rows of the equations [-], shape (mx, my)
      real(wp), intent(in) :: weight(:, :)
      !> Is slip turned?
      logical, intent(in) :: is_turned
      !> Elements in contact, shape (mx, my)
      logical, intent(in) :: contact(:, :)
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> Tractions [N/mm2], shape (mx, my, 2), and their bound, shape (mx, my)
      real(wp), intent(in) :: p(:, :, :), bound(:, :)
      !> Slip per step [mm], shape (mx, my, 2), and its scale [(N/mm2)/mm]
      real(wp), intent(in) :: slip(:, :, :), r
      integer :: ix, iy, k, most
      logical :: slips

      most = size(contact)
      if (allocated(self%at)) then
         if (size(self%at, 2) /= most) deallocate(self%at, self%row, self%across, self%back, self%bare, self%by, self%former, &
            & self%next, self%pivot, self%angle)
      end if
      if (.not. allocated(self%at)) then
         allocate(self%at(4, most), self%by(2, 3, most))
         allocate(self%row(2, most), self%across(2, most), self%back(2, most), self%bare(2, most))
         allocate(self%former(most), self%next(most), self%pivot(most), self%angle(most))
      end if
      self%n = 0
      self%is_transposed = .false.
      do iy = 1, size(contact, 2)
         do ix = 1, size(contact, 1)
            if (.not. contact(ix, iy)) cycle
            slips = is_turned
            if (slips) slips = leaves_disc([p(ix, iy, 1), p(ix, iy, 2)], weight(ix, iy)*[slip(ix, iy, 1), slip(ix, iy, 2)], &
               & bound(ix, iy), r)
            if (.not. (slips .or. weight(ix, iy) < 1.0_wp)) cycle
            k = self%n + 1
            self%n = k
            self%at(:, k) = [ix, ix, ix, iy]
            self%row(:, k) = [weight(ix, iy), 0.0_wp]
            self%across(:, k) = 0.0_wp
            self%by(:, :, k) = 0.0_wp
            if (slips) call linearise_element(self, contact, direction, slip, k)
         end do
      end do
      do k = 1, self%n
         associate (row => self%row(:, k), across => self%across(:, k))
            self%back(:, k) = row/(row(1)**2 + row(2)**2)
            self%bare(1, k) = self%back(1, k)*across(1) + self%back(2, k)*across(2)
            self%bare(2, k) = self%back(1, k)*across(2) - self%back(2, k)*across(1)
         end associate
      end do
      call eliminate(self)
   end subroutine linearise_turns

   !> slip := acting slip
   pure subroutine act(self, slip)
      class(slip_turns), intent(in) :: self
      !> That of the derivative [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: slip(:, :, :)
      real(wp) :: x
      integer :: k

      do k = 1, self%n
         associate (ix => self%at(2, k), iy => self%at(4, k))
            x = slip(ix, iy, 1)
            slip(ix, iy, 1) = self%row(1, k)*x - self%row(2, k)*slip(ix, iy, 2)
            slip(ix, iy, 2) = self%row(2, k)*x + self%row(1, k)*slip(ix, iy, 2)
         end associate
      end do
   end subroutine act

   !> Turn of an element in slip, and what it changes by
   pure subroutine linearise_element(self, contact, direction, slip, k)
      class(slip_turns), intent(inout) :: self
      !> As in linearise_turns
      logical, intent(in) :: contact(:, :)
      integer, intent(in) :: direction
      real(wp), intent(in) :: slip(:, :, :)
      !> Number of the element, whose place is known
      integer, intent(in) :: k
      type(local_mean) :: mean
      real(wp) :: w(2), next(2), by_slip(2), to_mean(2), bend

      associate (ix => self%at(2, k), iy => self%at(4, k))
         mean = mean_slip(contact, direction, slip, ix, iy)
         w = slip(ix, iy, :)
         next = slip(mean%ahead, iy, :)
      end associate
      if (.not. product_of_lengths(w, mean%value) > 0.0_wp) return
      self%at(1, k) = mean%behind
      self%at(3, k) = mean%ahead
      self%row(:, k) = self%row(1, k)*turn_between(w, mean%value)
      associate (row => self%row(:, k))
         self%across(:, k) = [-row(2)*w(1) - row(1)*w(2), row(1)*w(1) - row(2)*w(2)]
      end associate
      call differentiate_turn(w, mean%value, by_slip, to_mean)
      self%by(:, 1, k) = mean%share(1)*to_mean
      self%by(:, 2, k) = mean%share(2)*to_mean + by_slip
      self%by(:, 3, k) = mean%share(3)*to_mean
      if (mean%of_two <= 0.0_wp .or. mean%of_two >= 1.0_wp) return
      ! the share of the mean of two, of which s (1 - s) is the derivative by the logarithm of the ratio of both squares
      associate (iy => self%at(4, k))
         bend = 2.0_wp*mean%of_two*(1.0_wp - mean%of_two)*sum(to_mean*((by_two(1) - by_three(1))*slip(mean%behind, iy, :) &
            & + (by_two(2) - by_three(2))*w + (by_two(3) - by_three(3))*next))
      end associate
      self%by(:, 2, k) = self%by(:, 2, k) + bend/sum(w**2)*w
      self%by(:, 3, k) = self%by(:, 3, k) - bend/sum(next**2)*next
   end subroutine linearise_element

   !> Factors for `invert`
   pure subroutine eliminate(self)
      type(slip_turns), intent(inout) :: self
      integer :: k

      do k = 1, self%n
         self%former(k) = 0.0_wp
         self%pivot(k) = 1.0_wp + by_angle_of(self, k, k)
         if (k > 1) then
            self%former(k) = by_angle_of(self, k, k - 1)
            self%pivot(k) = self%pivot(k) - self%former(k)*self%next(k - 1)
         end if
         self%pivot(k) = 1.0_wp/max(least_pivot, self%pivot(k))
         self%next(k) = 0.0_wp
         if (k < self%n) self%next(k) = self%pivot(k)*by_angle_of(self, k, k + 1)
      end do
   end subroutine eliminate

   !> Change of the angle of element k by that of element j, zero where they are no neighbours in a row
   pure real(wp) function by_angle_of(self, k, j) result(change)
      type(slip_turns), intent(in) :: self
      integer, intent(in) :: k, j
      integer :: side

      change = 0.0_wp
      if (self%at(4, j) /= self%at(4, k)) return
      do side = 1, 3
         if (self%at(side, k) == self%at(2, j)) change = change + self%by(1, side, k)*self%bare(1, j) &
            & + self%by(2, side, k)*self%bare(2, j)
      end do
   end function by_angle_of

   !> self%angle := changes of the angles by a field of slip
   pure subroutine find_angles(self, slip)
      class(slip_turns), intent(inout) :: self
      real(wp), contiguous, intent(in) :: slip(:, :, :)
      integer :: k

      do k = 1, self%n
         associate (at => self%at(:, k), by => self%by(:, :, k))
            self%angle(k) = by(1, 1)*slip(at(1), at(4), 1) + by(2, 1)*slip(at(1), at(4), 2) &
               & + by(1, 2)*slip(at(2), at(4), 1) + by(2, 2)*slip(at(2), at(4), 2) &
               & + by(1, 3)*slip(at(3), at(4), 1) + by(2, 3)*slip(at(3), at(4), 2)
         end associate
      end do
   end subroutine find_angles

   !> slip := slip + what self%angle has to do with the slip behind, here and ahead
   pure subroutine add_by_angles(self, slip)
      class(slip_turns), intent(in) :: self
      real(wp), contiguous, intent(inout) :: slip(:, :, :)
      integer :: j, k

      do k = 1, self%n
         do j = 1, 3
            associate (ix => self%at(j, k), iy => self%at(4, k))
               slip(ix, iy, 1) = slip(ix, iy, 1) + self%angle(k)*self%by(1, j, k)
               slip(ix, iy, 2) = slip(ix, iy, 2) + self%angle(k)*self%by(2, j, k)
            end associate
         end do
      end do
   end subroutine add_by_angles

   pure subroutine apply(self, slip)
      class(slip_turns), intent(inout) :: self
      !> [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: slip(:, :, :)
      real(wp) :: x
      integer :: k

      call find_angles(self, slip)
      do k = 1, self%n
         associate (ix => self%at(2, k), iy => self%at(4, k), row => self%row(:, k))
            x = slip(ix, iy, 1)
            slip(ix, iy, 1) = row(1)*x - row(2)*slip(ix, iy, 2) + self%angle(k)*self%across(1, k)
            slip(ix, iy, 2) = row(2)*x + row(1)*slip(ix, iy, 2) + self%angle(k)*self%across(2, k)
         end associate
      end do
   end subroutine apply

   pure subroutine apply_transposed(self, slip)
      class(slip_turns), intent(inout) :: self
      !> Shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: slip(:, :, :)
      real(wp) :: x
      integer :: k

      do k = 1, self%n
         associate (ix => self%at(2, k), iy => self%at(4, k), row => self%row(:, k))
            x = slip(ix, iy, 1)
            self%angle(k) = self%across(1, k)*x + self%across(2, k)*slip(ix, iy, 2)
            slip(ix, iy, 1) = row(1)*x + row(2)*slip(ix, iy, 2)
            slip(ix, iy, 2) = row(1)*slip(ix, iy, 2) - row(2)*x
         end associate
      end do
      call add_by_angles(self, slip)
   end subroutine apply_transposed

   pure subroutine invert(self, slip)
      class(slip_turns), intent(inout) :: self
      !> [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: slip(:, :, :)
      real(wp) :: other, x
      integer :: k

      do k = 1, self%n
         associate (ix => self%at(2, k), iy => self%at(4, k), back => self%back(:, k))
            x = slip(ix, iy, 1)
            slip(ix, iy, 1) = back(1)*x + back(2)*slip(ix, iy, 2)
            slip(ix, iy, 2) = back(1)*slip(ix, iy, 2) - back(2)*x
         end associate
      end do
      call find_angles(self, slip)
      other = 0.0_wp
      do k = 1, self%n
         self%angle(k) = (self%angle(k) - self%former(k)*other)*self%pivot(k)
         other = self%angle(k)
      end do
      other = 0.0_wp
      do k = self%n, 1, -1
         self%angle(k) = self%angle(k) - self%next(k)*other
         other = self%angle(k)
         associate (ix => self%at(2, k), iy => self%at(4, k))
            slip(ix, iy, 1) = slip(ix, iy, 1) - self%angle(k)*self%bare(1, k)
            slip(ix, iy, 2) = slip(ix, iy, 2) - self%angle(k)*self%bare(2, k)
         end associate
      end do
   end subroutine invert

   pure subroutine invert_transposed(self, slip)
      class(slip_turns), intent(inout) :: self
      !> Shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: slip(:, :, :)
      real(wp) :: other, x
      integer :: k

      other = 0.0_wp
      do k = 1, self%n
         associate (ix => self%at(2, k), iy => self%at(4, k))
            self%angle(k) = self%bare(1, k)*slip(ix, iy, 1) + self%bare(2, k)*slip(ix, iy, 2)
         end associate
         if (k > 1) self%angle(k) = self%angle(k) - self%next(k - 1)*other
         other = self%angle(k)
      end do
      other = 0.0_wp
      do k = self%n, 1, -1
         if (k < self%n) self%angle(k) = self%angle(k) - self%former(k + 1)*other
         self%angle(k) = self%angle(k)*self%pivot(k)
         other = self%angle(k)
      end do
      self%angle(:self%n) = -self%angle(:self%n)
      call add_by_angles(self, slip)
      do k = 1, self%n
         associate (ix => self%at(2, k), iy => self%at(4, k), back => self%back(:, k))
            x = slip(ix, iy, 1)
            slip(ix, iy, 1) = back(1)*x - back(2)*slip(ix, iy, 2)
            slip(ix, iy, 2) = back(1)*slip(ix, iy, 2) + back(2)*x
         end associate
      end do
   end subroutine invert_transposed

   subroutine turn_turns_round(self, mx, my)
      class(slip_turns), intent(inout) :: self
      !> Size of the window
      integer, intent(in) :: mx, my

      self%at(1:3, :self%n) = mx + 1 - self%at(1:3, :self%n)
      self%at(4, :self%n) = my + 1 - self%at(4, :self%n)
      self%is_transposed = .true.
   end subroutine turn_turns_round

   !> Mean of the slip over an element
   !>
   !> At the border of adhesion, where nothing slips ahead, it is that of two; else that by three, with a smooth transition.
   pure type(local_mean) function mean_slip(contact, direction, slip, ix, iy) result(mean)
      !> Elements in contact, shape (mx, my)
      logical, intent(in) :: contact(:, :)
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> Slip per step [mm], shape (mx, my, 2)
      real(wp), intent(in) :: slip(:, :, :)
      !> The element
      integer, intent(in) :: ix, iy
      logical :: has_behind, has_ahead
      real(wp) :: here, next
      integer :: behind, ahead

      behind = ix - direction
      ahead = ix + direction
      has_behind = behind >= 1 .and. behind <= size(contact, 1)
      if (has_behind) has_behind = contact(behind, iy)
      has_ahead = ahead >= 1 .and. ahead <= size(contact, 1)
      if (has_ahead) has_ahead = contact(ahead, iy)
      if (.not. has_behind) behind = ix
      if (.not. has_ahead) ahead = ix
      mean%behind = behind
      mean%ahead = ahead
      if (has_behind .and. has_ahead) then
         here = half_way*(slip(ix, iy, 1)**2 + slip(ix, iy, 2)**2)
         next = slip(ahead, iy, 1)**2 + slip(ahead, iy, 2)**2
         mean%of_two = 1.0_wp
         if (next > 0.0_wp) mean%of_two = here/(here + next)
         mean%share = by_three + mean%of_two*(by_two - by_three)
      else if (has_behind) then
         mean%share = by_two
      else if (has_ahead) then
         mean%share = by_next
      end if
      mean%value(1) = mean%share(1)*slip(behind, iy, 1) + mean%share(2)*slip(ix, iy, 1) + mean%share(3)*slip(ahead, iy, 1)
      mean%value(2) = mean%share(1)*slip(behind, iy, 2) + mean%share(2)*slip(ix, iy, 2) + mean%share(3)*slip(ahead, iy, 2)
   end function mean_slip
end module contact_tangential_slip_turns
