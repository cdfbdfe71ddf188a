!> Extrapolation over a sequence of cases in time: estimates for the next case from the last ones
!>
!> The ratio of penetration to F**(2/3) depends little on the force, and changes slowly with the position of the wheelset. It is
!> extrapolated along the path from the case before the last one to the last one. A poor estimate only costs time.
module contact_wheelrail_course
   use contact_base_kinds, only : wp
   use contact_wheelrail_spec, only : wheelset_spec
   implicit none (type, external)
   private

   public :: course_type

   !> Power of the force to which the penetration is roughly proportional
   real(wp), parameter, public :: power = 2.0_wp/3.0_wp

   !> Number of coordinates of the position of a wheelset; they are scaled to lengths with comparable influence
   integer, parameter :: n_place = 3
   !> Length by which angles are scaled [mm]: distance of the wheel from the centre of the track
   real(wp), parameter :: lever = 750.0_wp
   !> Maximum distance for extrapolation [mm]
   real(wp), parameter :: near = 0.5_wp
   !> Limits of the extrapolation, relative to the last step
   real(wp), parameter :: furthest_back = -1.0_wp, furthest_on = 2.0_wp
   !> Largest factor by which the extrapolation changes the penetration: it grows faster where another patch appears, once
   real(wp), parameter :: largest_change = 1.5_wp
   !> Squared steps that are regarded as zero [mm2]
   real(wp), parameter :: no_way = 1.0e-20_wp

   !> Results of the last cases
   type :: course_type
      !> Number of cases that are stored, at most 2: the last one first
      integer, private :: known = 0
      real(wp), private :: place(n_place, 2) = 0.0_wp
      !> Ratio of penetration to F**(2/3) [mm/N**(2/3)]
      real(wp), private :: softness(2) = 0.0_wp
      !> Ratio of the derivative of the force with respect to the height to its value by the stiffness of the contacts [-]
      real(wp) :: stiffer = 1.0_wp
      !> Deviation of the force in the first trial of the last case, relative to it [-]
      real(wp) :: first_miss = 1.0_wp
      !> Change of the ratio of horizontal to vertical forces per change of height [1/mm]
      real(wp) :: sway = 0.0_wp
   contains
      !> Is the last case near this one?
      procedure :: is_near
      !> Estimated penetration, and the multiple of the last step for extrapolations
      procedure :: penetration
      procedure :: part
      !> Store the result of a case
      procedure :: note
      !> Remove all cases
      procedure :: forget
   end type course_type

contains

   !> Scaled position of a wheelset [mm]
   pure function place_of(wheelset) result(place)
      type(wheelset_spec), intent(in) :: wheelset
      real(wp) :: place(n_place)

      place = [wheelset%y, lever*wheelset%roll, lever*wheelset%yaw]
   end function place_of

   !> Is the last case near this one?
   pure logical function is_near(self, wheelset)
      class(course_type), intent(in) :: self
      !> Present position of the wheelset
      type(wheelset_spec), intent(in) :: wheelset

      is_near = self%known > 0
      if (is_near) is_near = all(abs(place_of(wheelset) - self%place(:, 1)) < near)
   end function is_near

   !> Estimated penetration for a given force [mm]
   pure real(wp) function penetration(self, wheelset, force)
      class(course_type), intent(in) :: self
      !> Present position of the wheelset, near the last case
      type(wheelset_spec), intent(in) :: wheelset
      !> Prescribed force [N], positive
      real(wp), intent(in) :: force
      real(wp) :: softness

      softness = self%softness(1)
      if (self%known > 1) softness = softness &
         & *min(max((self%softness(1)/self%softness(2))**self%part(wheelset), 1.0_wp/largest_change), largest_change)
      penetration = softness*force**power
   end function penetration

   !> Step from the last case to this one, along the step from the case before to the last one, relative to it [-]; 0 if not known
   pure real(wp) function part(self, wheelset)
      class(course_type), intent(in) :: self
      !> Present position of the wheelset, near the last case
      type(wheelset_spec), intent(in) :: wheelset
      real(wp) :: way(n_place)

      part = 0.0_wp
      if (self%known < 2) return
      way = self%place(:, 1) - self%place(:, 2)
      if (.not. dot_product(way, way) > no_way) return
      part = dot_product(place_of(wheelset) - self%place(:, 1), way)/dot_product(way, way)
      part = min(max(part, furthest_back), furthest_on)
   end function part

   !> Store the result of a solved case
   pure subroutine note(self, wheelset, force, penetration)
      class(course_type), intent(inout) :: self
      !> Position of the wheelset
      type(wheelset_spec), intent(in) :: wheelset
      !> Prescribed force [N] and penetration found [mm]; if one is not positive, all cases are removed
      real(wp), intent(in) :: force, penetration

      if (.not. (force > 0.0_wp .and. penetration > 0.0_wp)) then
         call self%forget()
         return
      end if
      if (.not. self%is_near(wheelset)) call self%forget()
      self%place(:, 2) = self%place(:, 1)
      self%softness(2) = self%softness(1)
      self%place(:, 1) = place_of(wheelset)
      self%softness(1) = penetration/force**power
      self%known = min(2, self%known + 1)
   end subroutine note

   pure subroutine forget(self)
      class(course_type), intent(inout) :: self

      self%known = 0
      self%stiffer = 1.0_wp
      self%first_miss = 1.0_wp
      self%sway = 0.0_wp
   end subroutine forget
end module contact_wheelrail_course
