!> The turn of the slip to its mean over an element, for rolling of second order, and its derivative
!>
!> Tractions in the middle of an element are opposed to the mean of the slip over it, by that of the element and of its
!> neighbours along the row. Turns are functions of the slip, smooth where elements slip; the derivative changes each
!> element's slip by one angle that depends on three. Derivation: doc/theory/second_order.md.
module contact_tangential_slip_turns
   use contact_base_kinds, only : wp
   use contact_numeric_pieces, only : most_pieces, pieces_of
   use contact_tangential_slip_means, only : add_by_shares, local_mean, mean_slip
   implicit none (type, external)
   private

   public :: slip_turns, turn_between, turned_residual

   !> Derivative of the acting slip by the slip, in elements where it is not the identity: the weight and the turn, and the
   !> change of the angle by the slip of the element and of its neighbours along the row
   type :: slip_turns
      !> Elements of the window, and how many of them are here
      integer :: window = 0, n = 0
      !> Numbers in the window, counted row by row, of the neighbour behind, of the element and of the neighbour ahead, that of the
      !> element where there is none; shape (3, window)
      integer, allocatable :: at(:, :)
      !> Weight times cosine and sine of the turn [-]; what the acting slip changes by per angle [mm]; shape (2, window)
      real(wp), allocatable :: row(:, :), across(:, :)
      !> The angle per slip behind, here and ahead [1/mm], shape (2, 3, window)
      real(wp), allocatable :: by(:, :, :)
      !> Scratch: changes of the angles, shape (window)
      real(wp), allocatable :: angle(:)
   contains
      !> Derivative at a slip
      procedure :: linearise => linearise_turns
      !> Slip into acting slip, at that of the derivative
      procedure :: act
      !> Change of slip into change of acting slip, and the transposed
      procedure :: apply, apply_transposed
      !> Half a turn of the contact
      procedure :: turn_round => reverse_turns
   end type slip_turns

   !> Part of the difference of slip and mean in the product of their lengths; it is of fourth order where slip is smooth; chosen
   real(wp), parameter :: apart = 0.0625_wp

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

   !> The turn again, and derivatives of its angle by the slip and by its mean
   pure subroutine differentiate_turn(slip, mean, length, turn, by_slip, by_mean)
      !> As in turn_between
      real(wp), intent(in) :: slip(2), mean(2)
      !> Their product of lengths [mm2], positive
      real(wp), intent(in) :: length
      !> Cosine and sine [-]
      real(wp), intent(out) :: turn(2)
      !> [1/mm]
      real(wp), intent(out) :: by_slip(2), by_mean(2)
      real(wp) :: sine, cosine, half, factor, pull(2), scale

      scale = 1.0_wp/length
      sine = (slip(1)*mean(2) - slip(2)*mean(1))*scale
      cosine = (slip(1)*mean(1) + slip(2)*mean(2))*scale
      half = 0.25_wp*sine*(1.0_wp + cosine)
      ! those of the cross and the dot product; then of the length, by which sine and cosine fall
      factor = sine*(1.0_wp + 2.0_wp*cosine)*scale
      pull = 2.0_wp*apart*((slip(1) - mean(1))**2 + (slip(2) - mean(2))**2)*(slip - mean)
      by_slip = (1.0_wp + cosine)*[mean(2), -mean(1)] + sine*mean - factor*((mean(1)**2 + mean(2)**2)*slip + pull)
      by_mean = (1.0_wp + cosine)*[-slip(2), slip(1)] + sine*slip - factor*((slip(1)**2 + slip(2)**2)*mean - pull)
      factor = 1.0_wp/(1.0_wp + half**2)
      turn = [1.0_wp - half**2, 2.0_wp*half]*factor
      factor = 0.5_wp*scale*factor
      by_slip = factor*by_slip
      by_mean = factor*by_mean
   end subroutine differentiate_turn

   !> Sum of |p - P_g(p - r S)|**2 over the contact, S the acting slip: weighted, and turned in elements that slip [(N/mm2)2]
   real(wp) function turned_residual(mx, my, weight, part, is_turned, contact, direction, p, bound, slip, r) result(total)
      !> Size of the window
      integer, intent(in) :: mx, my
      !> Weights of the rows of the equations [-]
      real(wp), intent(in) :: weight(mx, my)
      !> Parts by which the neighbours of an element behind and ahead and the bend of directions count [-]
      real(wp), intent(in) :: part(3, mx, my)
      !> Is slip turned?
      logical, intent(in) :: is_turned
      !> Elements in contact
      logical, intent(in) :: contact(mx, my)
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> Tractions, and their bound [N/mm2]
      real(wp), intent(in) :: p(mx, my, 2), bound(mx, my)
      !> Slip per step [mm], and its scale [(N/mm2)/mm]
      real(wp), intent(in) :: slip(mx, my, 2), r
      real(wp) :: total_of(most_pieces)
      integer :: k

      if (pieces_of(mx*my) == 1) then
         total = residual_of_rows(1, my)
         return
      end if
      !$omp parallel do
      do k = 1, most_pieces
         total_of(k) = residual_of_rows(first_row(my, k), first_row(my, k + 1) - 1)
      end do
      !$omp end parallel do
      total = sum(total_of)

   contains

      !> The sum over some rows
      pure real(wp) function residual_of_rows(first, last) result(total)
         integer, intent(in) :: first, last
         type(local_mean) :: mean
         real(wp) :: w(2), z(2), turn(2)
         integer :: ix, iy

         total = 0.0_wp
         do iy = first, last
            do ix = 1, mx
               if (.not. contact(ix, iy)) cycle
               w = r*weight(ix, iy)*[slip(ix, iy, 1), slip(ix, iy, 2)]
               z = [p(ix, iy, 1) - w(1), p(ix, iy, 2) - w(2)]
               if (.not. leaves_disc(z, bound(ix, iy))) then
                  total = total + (w(1)**2 + w(2)**2)
                  cycle
               end if
               if (is_turned) then
                  mean = mean_slip(mx, my, part(:, ix, iy), direction, slip, ix, iy)
                  turn = turn_between([slip(ix, iy, 1), slip(ix, iy, 2)], mean%value)
                  z = [p(ix, iy, 1) - (turn(1)*w(1) - turn(2)*w(2)), p(ix, iy, 2) - (turn(2)*w(1) + turn(1)*w(2))]
               end if
               if (leaves_disc(z, bound(ix, iy))) z = z*(bound(ix, iy)/sqrt(z(1)**2 + z(2)**2))
               total = total + ((p(ix, iy, 1) - z(1))**2 + (p(ix, iy, 2) - z(2))**2)
            end do
         end do
      end function residual_of_rows
   end function turned_residual

   !> First row of a piece of the window
   pure integer function first_row(my, piece)
      !> Rows of the window, and number of the piece, up to most_pieces + 1
      integer, intent(in) :: my, piece

      first_row = 1 + ((piece - 1)*my)/most_pieces
   end function first_row

   !> Does an element slip? Its traction less its slip lies outside of the disc of its bound
   pure logical function leaves_disc(z, bound) result(leaves)
      !> Traction less scaled slip, and the bound [N/mm2]
      real(wp), intent(in) :: z(2), bound

      leaves = z(1)**2 + z(2)**2 > bound**2
   end function leaves_disc

   subroutine linearise_turns(self, mx, my, weight, part, is_turned, contact, direction, p, bound, slip, r)
      class(slip_turns), intent(inout) :: self
      !> Size of the window
      integer, intent(in) :: mx, my
      !> Weights of the rows of the equations [-]
      real(wp), intent(in) :: weight(mx, my)
      !> Parts by which the neighbours of an element behind and ahead and the bend of directions count [-]
      real(wp), intent(in) :: part(3, mx, my)
      !> Is slip turned?
      logical, intent(in) :: is_turned
      !> Elements in contact
      logical, intent(in) :: contact(mx, my)
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> Tractions, and their bound [N/mm2]
      real(wp), intent(in) :: p(mx, my, 2), bound(mx, my)
      !> Slip per step [mm], and its scale [(N/mm2)/mm]
      real(wp), intent(in) :: slip(mx, my, 2), r
      integer :: at(most_pieces), k

      call fit_turns(self, mx*my)
      self%n = 0
      if (pieces_of(mx*my) == 1) then
         call linearise_rows(1, my, .true., self%n)
         return
      end if
      ! places in the list by the numbers of elements of the pieces before
      !$omp parallel do
      do k = 1, most_pieces
         at(k) = 0
         call linearise_rows(first_row(my, k), first_row(my, k + 1) - 1, .false., at(k))
      end do
      !$omp end parallel do
      self%n = sum(at)
      do k = most_pieces, 1, -1
         at(k) = sum(at(:k - 1))
      end do
      !$omp parallel do
      do k = 1, most_pieces
         call linearise_rows(first_row(my, k), first_row(my, k + 1) - 1, .true., at(k))
      end do
      !$omp end parallel do

   contains

      !> The elements of some rows
      subroutine linearise_rows(first, last, sets, k)
         integer, intent(in) :: first, last
         !> Are derivatives set? Otherwise elements are counted
         logical, intent(in) :: sets
         !> Number of elements in the list before and after
         integer, intent(inout) :: k
         real(wp) :: factor
         integer :: ix, iy
         logical :: slips

         do iy = first, last
            do ix = 1, mx
               if (.not. contact(ix, iy)) cycle
               factor = r*weight(ix, iy)
               slips = is_turned
               if (slips) slips = leaves_disc([p(ix, iy, 1) - factor*slip(ix, iy, 1), p(ix, iy, 2) - factor*slip(ix, iy, 2)], &
                  & bound(ix, iy))
               if (.not. (slips .or. weight(ix, iy) < 1.0_wp)) cycle
               k = k + 1
               if (.not. sets) cycle
               self%at(:, k) = ix + mx*(iy - 1)
               self%row(:, k) = [weight(ix, iy), 0.0_wp]
               self%across(:, k) = 0.0_wp
               self%by(:, :, k) = 0.0_wp
               if (slips) call linearise_element(mx, my, part(:, ix, iy), direction, slip, ix, iy, self%at(:, k), self%row(:, k), &
                  & self%across(:, k), self%by(:, :, k))
            end do
         end do
      end subroutine linearise_rows
   end subroutine linearise_turns

   !> Arrays for a window with this number of elements
   subroutine fit_turns(self, window)
      class(slip_turns), intent(inout) :: self
      integer, intent(in) :: window

      if (self%window == window) return
      if (allocated(self%at)) deallocate(self%at, self%row, self%across, self%by, self%angle)
      allocate(self%at(3, window), self%row(2, window), self%across(2, window), self%by(2, 3, window), self%angle(window))
      self%window = window
   end subroutine fit_turns

   subroutine act(self, slip)
      class(slip_turns), intent(in) :: self
      !> That of the derivative [mm]
      real(wp), intent(inout) :: slip(self%window, 2)
      integer :: k

      if (pieces_of(self%window) == 1) then
         do k = 1, self%n
            call turn_one(self%row(:, k), slip(self%at(2, k), 1), slip(self%at(2, k), 2))
         end do
      else
         !$omp parallel do
         do k = 1, self%n
            call turn_one(self%row(:, k), slip(self%at(2, k), 1), slip(self%at(2, k), 2))
         end do
         !$omp end parallel do
      end if
   end subroutine act

   !> Slip of an element, weighted and turned
   pure subroutine turn_one(row, x, y)
      !> Weight times cosine and sine of the turn
      real(wp), intent(in) :: row(2)
      !> Slip
      real(wp), intent(inout) :: x, y
      real(wp) :: old

      old = x
      x = row(1)*old - row(2)*y
      y = row(2)*old + row(1)*y
   end subroutine turn_one

   !> Turn of an element in slip, and what it changes by
   pure subroutine linearise_element(mx, my, part, direction, slip, ix, iy, at, row, across, by)
      !> As in turned_residual
      integer, intent(in) :: mx, my
      real(wp), intent(in) :: part(3)
      integer, intent(in) :: direction
      real(wp), intent(in) :: slip(mx, my, 2)
      !> The element
      integer, intent(in) :: ix, iy
      !> Of the element, see slip_turns; those without a turn on entry
      integer, intent(inout) :: at(3)
      real(wp), intent(inout) :: row(2), across(2), by(2, 3)
      type(local_mean) :: mean
      real(wp) :: w(2), turn(2), by_slip(2), to_mean(2), length

      mean = mean_slip(mx, my, part, direction, slip, ix, iy)
      w = [slip(ix, iy, 1), slip(ix, iy, 2)]
      length = product_of_lengths(w, mean%value)
      if (.not. length > 0.0_wp) return
      call differentiate_turn(w, mean%value, length, turn, by_slip, to_mean)
      at(1) = mean%behind + mx*(iy - 1)
      at(3) = mean%ahead + mx*(iy - 1)
      row = row(1)*turn
      across = [-row(2)*w(1) - row(1)*w(2), row(1)*w(1) - row(2)*w(2)]
      by(:, 1) = mean%share(1)*to_mean
      by(:, 2) = mean%share(2)*to_mean + by_slip
      by(:, 3) = mean%share(3)*to_mean
      if (any(mean%part(1:2) > 0.0_wp)) call add_by_shares(mean, to_mean, [slip(mean%behind, iy, 1), slip(mean%behind, iy, 2)], w, &
         & [slip(mean%ahead, iy, 1), slip(mean%ahead, iy, 2)], by)
   end subroutine linearise_element

   !> Change of an angle by a field of slip
   pure real(wp) function angle_by(elements, at, by, slip) result(angle)
      !> Elements of the window; those behind, here and ahead
      integer, intent(in) :: elements, at(3)
      !> The angle per slip
      real(wp), intent(in) :: by(2, 3)
      real(wp), intent(in) :: slip(elements, 2)

      angle = by(1, 1)*slip(at(1), 1) + by(2, 1)*slip(at(1), 2) + by(1, 2)*slip(at(2), 1) &
         & + by(2, 2)*slip(at(2), 2) + by(1, 3)*slip(at(3), 1) + by(2, 3)*slip(at(3), 2)
   end function angle_by

   !> slip := slip + the derivative self%angle applied to the slip behind, here and ahead
   pure subroutine add_by_angles(self, slip)
      class(slip_turns), intent(in) :: self
      real(wp), intent(inout) :: slip(self%window, 2)
      integer :: j, k

      do k = 1, self%n
         do j = 1, 3
            associate (i => self%at(j, k))
               slip(i, 1) = slip(i, 1) + self%angle(k)*self%by(1, j, k)
               slip(i, 2) = slip(i, 2) + self%angle(k)*self%by(2, j, k)
            end associate
         end do
      end do
   end subroutine add_by_angles

   subroutine apply(self, slip)
      class(slip_turns), intent(inout) :: self
      !> [mm]
      real(wp), intent(inout) :: slip(self%window, 2)
      integer :: k

      if (pieces_of(self%window) == 1) then
         do k = 1, self%n
            self%angle(k) = angle_by(self%window, self%at(:, k), self%by(:, :, k), slip)
         end do
         do k = 1, self%n
            call apply_one(self%row(:, k), self%across(:, k), self%angle(k), slip(self%at(2, k), 1), slip(self%at(2, k), 2))
         end do
      else
         !$omp parallel do
         do k = 1, self%n
            self%angle(k) = angle_by(self%window, self%at(:, k), self%by(:, :, k), slip)
         end do
         !$omp end parallel do
         !$omp parallel do
         do k = 1, self%n
            call apply_one(self%row(:, k), self%across(:, k), self%angle(k), slip(self%at(2, k), 1), slip(self%at(2, k), 2))
         end do
         !$omp end parallel do
      end if
   end subroutine apply

   !> Change of the acting slip of an element by those of its slip and of its angle
   pure subroutine apply_one(row, across, angle, x, y)
      !> See slip_turns
      real(wp), intent(in) :: row(2), across(2), angle
      !> Change of slip on entry, of acting slip on exit
      real(wp), intent(inout) :: x, y
      real(wp) :: old

      old = x
      x = row(1)*old - row(2)*y + angle*across(1)
      y = row(2)*old + row(1)*y + angle*across(2)
   end subroutine apply_one

   pure subroutine apply_transposed(self, slip)
      class(slip_turns), intent(inout) :: self
      !> A field of the window
      real(wp), intent(inout) :: slip(self%window, 2)
      real(wp) :: x
      integer :: k

      do k = 1, self%n
         associate (i => self%at(2, k), row => self%row(:, k))
            x = slip(i, 1)
            self%angle(k) = self%across(1, k)*x + self%across(2, k)*slip(i, 2)
            slip(i, 1) = row(1)*x + row(2)*slip(i, 2)
            slip(i, 2) = row(1)*slip(i, 2) - row(2)*x
         end associate
      end do
      call add_by_angles(self, slip)
   end subroutine apply_transposed

   subroutine reverse_turns(self)
      class(slip_turns), intent(inout) :: self

      self%at(:, :self%n) = self%window + 1 - self%at(:, :self%n)
   end subroutine reverse_turns
end module contact_tangential_slip_turns
