!> The mean direction of the slip over an element, for rolling of second order
!>
!> Slip of the element and of its neighbours along the row, each a mean over half an element or more, gives the direction in the
!> middle. Derivation: doc/theory/second_order.md.
module contact_tangential_slip_means
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: add_by_shares, local_mean, mean_length, mean_slip

   !> Ratio of the square of slip ahead to that here at which half of the bend of directions counts; chosen
   real(wp), parameter :: half_way = 0.02_wp
   !> What the mean direction over an element differs by from that of its neighbours' mean, per second difference of directions
   real(wp), parameter :: of_bend = 0.125_wp
   !> Mean over an element by slip half a step behind, half a step ahead and three halves ahead of its middle: the parabola
   !> through them, and the straight line without the last
   real(wp), parameter :: by_three(3) = [5.0_wp, 8.0_wp, -1.0_wp]/12.0_wp, by_two(3) = [0.5_wp, 0.5_wp, 0.0_wp]

   !> Slip in its mean direction over an element
   type :: local_mean
      !> [mm]
      real(wp) :: value(2) = 0.0_wp
      !> Columns of the neighbours behind and ahead, that of the element itself where there is none
      integer :: behind = 0, ahead = 0
      !> Parts of the slip behind, here and ahead
      real(wp) :: share(3) = [0.0_wp, 1.0_wp, 0.0_wp]
      !> Factor of the slip behind in the mean of two; zero without a neighbour behind
      real(wp) :: of_behind = 0.0_wp
      !> Part of the bend that counts; zero without neighbours on both sides, at a border of adhesion, and in the three elements at
      !> the leading edge
      real(wp) :: bends = 0.0_wp
      !> Parts by which the neighbours behind and ahead and the bend count, see second_order
      real(wp) :: part(3) = 0.0_wp
   end type local_mean

contains

   !> Slip in the direction of its mean over an element
   !>
   !> Directions count, not lengths: at a border of adhesion slip grows with the root of the distance. Slip of a step is a mean by
   !> length itself, which the factor of the slip behind makes up for. Where something slips ahead the bend of directions is added.
   !> Neighbours count by their pressures: forces would jump if terms appeared or vanished with elements that enter or leave the
   !> contact.
   pure type(local_mean) function mean_slip(mx, my, part, direction, slip, ix, iy) result(mean)
      !> Size of the window
      integer, intent(in) :: mx, my
      !> Parts by which the neighbours of the element behind and ahead and the bend count
      real(wp), intent(in) :: part(3)
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> Slip per step [mm]
      real(wp), intent(in) :: slip(mx, my, 2)
      !> The element
      integer, intent(in) :: ix, iy
      real(wp) :: a, b, c
      integer :: behind, ahead

      behind = ix
      if (part(1) > 0.0_wp) behind = ix - direction
      ahead = ix
      if (part(2) > 0.0_wp) ahead = ix + direction
      mean%behind = behind
      mean%ahead = ahead
      mean%part = part
      a = slip(ix, iy, 1)**2 + slip(ix, iy, 2)**2
      c = slip(ahead, iy, 1)**2 + slip(ahead, iy, 2)**2
      if (part(1) > 0.0_wp) then
         b = slip(behind, iy, 1)**2 + slip(behind, iy, 2)**2
         if (a > 0.0_wp) then
            mean%of_behind = 3.0_wp*a/(a + 2.0_wp*b)
            mean%share = [mean%of_behind, 1.0_wp, 0.0_wp]/(1.0_wp + mean%of_behind)
            if (part(3) > 0.0_wp .and. c > 0.0_wp) then
               mean%bends = part(3)*c/(c + half_way*a)
               mean%share = mean%share - of_bend*mean%bends*[2.0_wp*a/(a + b), -2.0_wp, 2.0_wp*a/(a + c)]
            end if
         end if
      end if
      if (part(1) < 1.0_wp) mean%share = part(1)*mean%share + (1.0_wp - part(1))*line(part(2), a, c)
      mean%value(1) = mean%share(1)*slip(behind, iy, 1) + mean%share(2)*slip(ix, iy, 1) + mean%share(3)*slip(ahead, iy, 1)
      mean%value(2) = mean%share(1)*slip(behind, iy, 2) + mean%share(2)*slip(ix, iy, 2) + mean%share(3)*slip(ahead, iy, 2)
   end function mean_slip

   !> Shares of the slip in the mean without a neighbour behind
   pure function line(ahead, a, c) result(share)
      !> Part by which the neighbour ahead counts
      real(wp), intent(in) :: ahead
      !> Squares of the slip here and ahead [mm2]
      real(wp), intent(in) :: a, c
      real(wp) :: share(3)

      share = [0.0_wp, 1.0_wp + 0.5_wp*ahead, 0.0_wp]
      if (a > 0.0_wp) share(3) = -ahead*a/(a + c)
   end function line

   !> Length of the mean slip over an element [mm]; at a border of adhesion that of two
   pure real(wp) function mean_length(mx, my, mean, slip, ix, iy) result(length)
      !> Size of the window
      integer, intent(in) :: mx, my
      !> Of the element: its neighbours
      type(local_mean), intent(in) :: mean
      !> Slip per step [mm]
      real(wp), intent(in) :: slip(mx, my, 2)
      !> The element
      integer, intent(in) :: ix, iy
      real(wp) :: share(3)

      if (mean%behind /= ix) then
         share = by_two + mean%bends*(by_three - by_two)
      else
         ! lengths count here: the straight line through both, and not through their directions
         share = [0.0_wp, 1.0_wp + 0.5_wp*mean%part(2), -0.5_wp*mean%part(2)]
      end if
      length = norm2(share(1)*slip(mean%behind, iy, :) + share(2)*slip(ix, iy, :) + share(3)*slip(mean%ahead, iy, :))
   end function mean_length

   !> Change of the angle due to the weights of the slip behind, here and ahead in the mean
   pure subroutine add_by_shares(mean, to_mean, behind, here, ahead, by)
      !> That of the element, with neighbours behind
      type(local_mean), intent(in) :: mean
      !> Change of the angle by the mean [1/mm]
      real(wp), intent(in) :: to_mean(2)
      !> Slip of the three elements [mm]
      real(wp), intent(in) :: behind(2), here(2), ahead(2)
      !> Gets the changes by it
      real(wp), intent(inout) :: by(2, 3)
      real(wp) :: a, b, c, s, along(3), g(3)

      b = behind(1)**2 + behind(2)**2
      a = here(1)**2 + here(2)**2
      c = ahead(1)**2 + ahead(2)**2
      along = [to_mean(1)*behind(1) + to_mean(2)*behind(2), to_mean(1)*here(1) + to_mean(2)*here(2), &
         & to_mean(1)*ahead(1) + to_mean(2)*ahead(2)]
      ! by the squares b, a and c: of the factor behind, then of the bend
      s = 6.0_wp*(along(1) - along(2))/((1.0_wp + mean%of_behind)*(a + 2.0_wp*b))**2
      g = [-s*a, s*b, 0.0_wp]
      if (mean%bends > 0.0_wp) then
         s = -of_bend*mean%bends*2.0_wp*along(1)/(a + b)**2
         g = g + [-s*a, s*b, 0.0_wp]
         s = -of_bend*mean%bends*2.0_wp*along(3)/(a + c)**2
         g = g + [0.0_wp, s*c, -s*a]
         s = -of_bend*mean%part(3)*(2.0_wp*a/(a + b)*along(1) - 2.0_wp*along(2) + 2.0_wp*a/(a + c)*along(3)) &
            & *half_way/(c + half_way*a)**2
         g = g + [0.0_wp, -s*c, s*a]
      end if
      g = mean%part(1)*g
      if (mean%part(1) < 1.0_wp .and. mean%part(2) > 0.0_wp) then
         s = -(1.0_wp - mean%part(1))*mean%part(2)*along(3)/(a + c)**2
         g = g + [0.0_wp, s*c, -s*a]
      end if
      by(:, 1) = by(:, 1) + 2.0_wp*g(1)*behind
      by(:, 2) = by(:, 2) + 2.0_wp*g(2)*here
      by(:, 3) = by(:, 3) + 2.0_wp*g(3)*ahead
   end subroutine add_by_shares
end module contact_tangential_slip_means
