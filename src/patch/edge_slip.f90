!> Errors at the leading edge of unlike bodies: slip in an area narrower than elements, and tractions that turn within elements
!>
!> Pressures of unlike bodies drive tractions at the leading edge. Without slip these go as the root of the distance s from the
!> edge times beta/pi log(1/s), with Dundurs' constant beta, so their ratio to the pressures grows towards the edge, and reaches
!> the coefficient of friction at a distance w. Slip between the edge and w displaces the beginning of the tractions in adhesion by
!> a part of w, and so changes them by beta/(pi mu) w/L of the bound, L the length of the row. Elements longer than w miss this, and
!> elements of that length have as large an error. Where the edge slides, the direction of slip turns with log(1/s): tractions of
!> the first element have an error of the change of direction to the next one. No coarser level shows either. See
!> doc/theory/errors.md.
module contact_patch_edge_slip
   use contact_base_choices, only : motion
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_patch_problem, only : patch_problem, rolling_direction
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: edge_slip_error, hidden_adhesion, leading_turn

   !> Distance from the second element of a row at which slip changes its direction if half an element or more would adhere
   !> [elements]
   real(wp), parameter :: to_edge = 1.0_wp
   !> Ratio of the error of the forces to the sum over the rows; distance of the centre of the leading element from the edge
   !> [elements]; exponent of the number of slipping elements by which the error decreases; ratio of beta to the coefficient of
   !> friction below which levels show most of it, and exponent of smaller ones; ratio of the error to the change of the tractions
   !> of leading elements that slide. Of 66 contacts on 20 to 56 elements along the potential contact (kind dissimilar, seeds 70001
   !> and 5551)
   real(wp), parameter :: share = 2.0_wp, usual_place = 0.5_wp, resolved_power = 2.0_wp, strong = 0.5_wp, weak_power = 2.0_wp, &
      & turning_share = 1.5_wp
   !> Power of the number of elements along the rows by which the part of the turn decreases: 1.5 for that of the leading elements
   !> in the pressures, and their turn decreases a little; of five contacts on 20 to 150 elements across (kind dissimilar, seeds
   !> 98001 and 98004)
   real(wp), parameter :: turning_power = 1.8_wp

   !> A row of elements along the rolling direction
   type :: row_type
      !> Elements in contact; those that slip ahead of adhesion
      integer :: n = 0, ahead = 0
      !> Sums of the pressures, and of those in adhesion [N/mm2]
      real(wp) :: load = 0.0_wp, sticking = 0.0_wp
      !> Coefficient of friction where adhesion begins [-]
      real(wp) :: mu = 0.0_wp
      !> Traction over its bound in the leading element [-]
      real(wp) :: used = 0.0_wp
      !> Tractions over their bound ahead of adhesion, or in the leading element that sticks, and behind it [-]
      real(wp) :: before(2) = 0.0_wp, behind(2) = 0.0_wp
   end type row_type

contains

   !> Error of the forces due to slip at the leading edge, and to its direction, relative to the friction bound [-]; or that which
   !> is expected with smaller elements
   pure real(wp) function edge_slip_error(problem, result, finer) result(e)
      !> The problem that was solved: steady rolling along x of bodies with different materials
      type(patch_problem), intent(in) :: problem
      !> Solved, with contact
      type(patch_result), intent(in) :: result
      !> Ratio of the number of elements along a row to that of the solution; default 1
      real(wp), intent(in), optional :: finer
      type(row_type) :: row
      real(wp) :: beta, width, turned, ratio
      integer :: iy

      e = 0.0_wp
      ratio = 1.0_wp
      if (present(finer)) ratio = finer
      beta = abs(problem%model%material%ak)/(1.0_wp - problem%model%material%nu)
      do iy = 1, result%grid%my
         row = row_of(result, iy, rolling_direction(problem))
         e = e + turning_share*turning_of(result, iy, rolling_direction(problem))*ratio**(-turning_power)
         if (.not. (row%sticking > 0.0_wp .and. row%mu > 0.0_wp)) cycle
         ! in elements; an element of which more than half slips counts as one, and of a width that elements resolve the error
         ! decreases
         width = ratio*row%ahead
         if (row%ahead == 0) width = ratio*usual_place*exp(min(0.0_wp, (row%used - 1.0_wp)*pi*row%mu/beta))
         if (width > usual_place) width = part_of_wide(anint(width))
         ! where tractions turn between both slip areas, those behind adhesion change with its place
         turned = 0.5_wp*norm2(row%before - row%behind)
         e = e + factor_of(beta, row%mu)*width/(ratio*row%n)*(row%sticking + turned*(row%load - row%sticking))
      end do
      e = e/max(sum(result%pn), tiny(e))
   end function edge_slip_error

   !> Full sliding: change of the tractions from leading elements to those behind them, relative to the friction bound; 0 if a part
   !> adheres [-]
   pure real(wp) function leading_turn(problem, result) result(change)
      !> The problem that was solved: rolling along x
      type(patch_problem), intent(in) :: problem
      !> Solved, with contact
      type(patch_result), intent(in) :: result
      integer :: iy

      change = 0.0_wp
      if (result%nadh > 0) return
      do iy = 1, result%grid%my
         change = change + turning_of(result, iy, rolling_direction(problem))
      end do
      change = change/max(sum(result%pn), tiny(change))
   end function leading_turn

   !> Error of a row, times its number of elements, if the slip area is one element wide, over the load that it changes [-]
   pure real(wp) function factor_of(beta, mu) result(factor)
      !> Dundurs' constant, and coefficient of friction [-]
      real(wp), intent(in) :: beta, mu

      factor = share*beta/(pi*mu)*min(1.0_wp, beta/(strong*mu))**weak_power
   end function factor_of

   !> Ratio of the error to that of a slip area of one element, of which elements resolve a part [-]
   pure real(wp) function part_of_wide(elements) result(part)
      !> Width of the slip area [elements], at least 1
      real(wp), intent(in) :: elements

      part = elements**(-resolved_power)
   end function part_of_wide

   !> Number of rows that slip altogether although they would adhere next to their leading edge: adhesion narrower than an element,
   !> by the first order
   !>
   !> Slip decreases towards the leading edge, but tractions of the first element, ahead of which there are none, have an error
   !> that adds to its slip. So the slip there is extrapolated from the two elements behind it.
   pure integer function hidden_adhesion(problem, result) result(rows)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem
      !> Solved
      type(patch_result), intent(in) :: result
      real(wp) :: slip(2, 2)
      integer :: iy, ix, k, n

      rows = 0
      if (.not. (problem%motion == motion%steady_rolling .and. allocated(result%sx))) return
      do iy = 1, result%grid%my
         n = 0
         do k = 1, result%grid%mx
            ix = merge(result%grid%mx + 1 - k, k, rolling_direction(problem) > 0)
            if (.not. result%pn(ix, iy) > 0.0_wp) cycle
            if (result%division(ix, iy) == element%adhesion) exit
            n = n + 1
            if (n == 2 .or. n == 3) slip(:, n - 1) = [result%sx(ix, iy), result%sy(ix, iy)]
         end do
         if (k <= result%grid%mx .or. n < 3) cycle
         if (dot_product(to_edge*(slip(:, 1) - slip(:, 2)) + slip(:, 1), slip(:, 1)) < 0.0_wp) rows = rows + 1
      end do
   end function hidden_adhesion

   !> What the estimate needs of a row
   pure type(row_type) function row_of(result, iy, direction) result(row)
      !> Solved
      type(patch_result), intent(in) :: result
      !> Row; rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: iy, direction
      real(wp) :: traction(2)
      integer :: ix, k
      logical :: was_sticking

      was_sticking = .false.
      do k = 1, result%grid%mx
         ix = merge(result%grid%mx + 1 - k, k, direction > 0)
         if (.not. result%pn(ix, iy) > 0.0_wp) cycle
         row%n = row%n + 1
         row%load = row%load + result%pn(ix, iy)
         traction = relative_traction(result, ix, iy)
         if (row%n == 1) then
            row%used = norm2(traction)
            row%before = traction
         end if
         if (result%division(ix, iy) == element%slip) then
            if (.not. row%sticking > 0.0_wp) then
               row%ahead = row%ahead + 1
               row%before = traction
            end if
            if (was_sticking) row%behind = traction
            was_sticking = .false.
         else
            if (.not. row%sticking > 0.0_wp) row%mu = result%mu(ix, iy)
            row%sticking = row%sticking + result%pn(ix, iy)
            row%behind = traction
            was_sticking = .true.
         end if
      end do
   end function row_of

   !> Pressure of the leading element of a row times the change of direction to the next one; 0 unless both slip [N/mm2]
   pure real(wp) function turning_of(result, iy, direction) result(turning)
      !> Solved
      type(patch_result), intent(in) :: result
      !> Row; rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: iy, direction
      integer :: ix, k, leading

      turning = 0.0_wp
      leading = 0
      do k = 1, result%grid%mx
         ix = merge(result%grid%mx + 1 - k, k, direction > 0)
         if (.not. result%pn(ix, iy) > 0.0_wp) cycle
         if (result%division(ix, iy) /= element%slip) return
         if (leading > 0) then
            turning = result%pn(leading, iy)*norm2(relative_traction(result, ix, iy) - relative_traction(result, leading, iy))
            return
         end if
         leading = ix
      end do
   end function turning_of

   !> Traction of an element over its bound [-]
   pure function relative_traction(result, ix, iy) result(traction)
      !> Solved
      type(patch_result), intent(in) :: result
      !> Element in contact
      integer, intent(in) :: ix, iy
      !> Along x and y
      real(wp) :: traction(2)

      traction = [result%px(ix, iy), result%py(ix, iy)]/max(result%mu(ix, iy)*result%pn(ix, iy), tiny(traction))
   end function relative_traction
end module contact_patch_edge_slip
