!> Kinds of contacts whose errors of forces are estimated in different ways, and what their differences of the levels say
!>
!> See doc/theory/errors.md.
module contact_patch_error_kinds
   use contact_base_kinds, only : wp
   use contact_patch_coarse_level, only : coarsening
   use contact_patch_error_scales, only : first_order, normal_order, scale_type
   implicit none (type, external)
   private

   public :: is_first, is_long_step, is_second, is_sliding, is_turning, is_unseen, order_of, part_of, sliding_part, trust_in, &
      & trust_in_first, trusted, usual_ratio

   !> In sliding, and for a moment alone, differences of the levels by the first order scatter more: those above this multiple of
   !> the lower bound are reduced with this exponent, see trusted; fraction in adhesion up to which sliding dominates; the exponent
   !> returns to 1 at twice this fraction
   real(wp), parameter :: usual_ratio = 2.0_wp, sliding_trust = 0.6_wp, sliding = 0.03_wp
   !> Exponent of the ratio of an error by the levels to the general error, if larger than 1: of an error that jumps with the offset
   !> of the grid the levels are two samples, and the general error is that usual for this number of elements. For forces and power
   !> with the second-order scheme, of like and of unlike bodies
   real(wp), parameter :: trust(2) = [0.7_wp, 0.8_wp]

contains

   !> Ratio of the error of the finer level to the difference of the levels; 1 if errors have no clean order
   pure real(wp) function part_of(scale, order) result(part)
      !> See type scale_type
      type(scale_type), intent(in) :: scale
      !> Order of the error
      real(wp), intent(in) :: order

      part = 1.0_wp
      if (scale%clean) part = 1.0_wp/(coarsening**order - 1.0_wp)
   end function part_of

   !> Is it a step of transient rolling for which the second-order scheme is not suited?
   pure logical function is_long_step(scale)
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      is_long_step = scale%steps .and. scale%order <= first_order
   end function is_long_step

   !> Are tractions of both levels not comparable? Steps of one element are not steps of one element on a coarser level
   pure logical function is_unseen(scale)
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      is_unseen = scale%steps .and. scale%order > first_order
   end function is_unseen

   !> Is it steady rolling by the first-order scheme, without a layer?
   pure logical function is_first(scale)
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      is_first = scale%clean .and. scale%order <= first_order
   end function is_first

   !> Exponent for the differences of levels of forces by the first-order scheme, see trusted
   pure real(wp) function trust_in_first(scale) result(power)
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      power = sliding_trust
      if (.not. scale%is_moment_alone) power = 1.0_wp - (1.0_wp - sliding_trust)*sliding_part(scale%sticking)
   end function trust_in_first

   !> Weight of the errors of sliding: 1 in nearly full sliding, 0 from some adhesion on [-]
   elemental real(wp) function sliding_part(sticking) result(part)
      !> Fraction of the elements that sticks [-]
      real(wp), intent(in) :: sticking

      part = min(1.0_wp, max(0.0_wp, 2.0_wp - sticking/sliding))
   end function sliding_part

   !> Exponent for the differences of levels of forces and power, see trusted
   pure real(wp) function trust_in(scale) result(power)
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      power = merge(trust(2), trust(1), scale%coupling > 0.0_wp)
   end function trust_in

   !> Is it full sliding of like bodies with a constant coefficient of friction in steady rolling by the first-order scheme?
   !> The error of first order is that of the direction of slip
   pure logical function is_sliding(scale)
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      is_sliding = is_first(scale) .and. .not. (scale%is_moment_alone .or. scale%sticking > 0.0_wp .or. scale%is_line &
         & .or. scale%coupling > 0.0_wp .or. scale%falling > 0.0_wp .or. scale%warmed > 0.0_wp)
   end function is_sliding

   !> Is it steady rolling by the second-order scheme, unless both forces are prescribed?
   pure logical function is_second(scale)
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      is_second = scale%jumps .and. scale%order < normal_order .and. .not. scale%is_moment_alone
   end function is_second

   !> Is it full sliding of like elastic bodies in steady rolling by the second-order scheme, with a coefficient of friction that
   !> does not depend on slip? Only directions of slip have errors
   pure logical function is_turning(scale)
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      is_turning = is_second(scale) .and. .not. (scale%sticking > 0.0_wp .or. scale%is_line .or. scale%coupling > 0.0_wp &
         & .or. scale%relaxation > 0.0_wp .or. scale%falling > 0.0_wp)
   end function is_turning

   !> Order of the tangential problem: in full sliding no element changes its state
   pure real(wp) function order_of(scale) result(order)
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      order = merge(normal_order, scale%order, is_turning(scale))
   end function order_of

   !> Error from the differences of levels and the general error
   pure real(wp) function trusted(by_levels, floor, power) result(e)
      !> Error by the levels, and general error
      real(wp), intent(in) :: by_levels, floor
      !> Exponent of the ratio of both, if larger than 1
      real(wp), intent(in) :: power

      e = by_levels
      if (by_levels > floor .and. floor > 0.0_wp) e = floor*(by_levels/floor)**power
   end function trusted
end module contact_patch_error_kinds
