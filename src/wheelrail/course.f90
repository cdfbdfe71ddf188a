!> Cases one after the other in time: what the last ones tell of the next one
!>
!> Penetration over F**(2/3) hardly depends on the force, and changes slowly with the position of the wheelset. It is continued
!> along the way that the wheelset went from the case before the last one to the last one. A wrong guess costs time only.
module contact_wheelrail_course
   use contact_base_kinds, only : wp
   use contact_wheelrail_spec, only : wheelset_spec
   implicit none (type, external)
   private

   public :: course_type

   !> Power of the force that the penetration of a contact goes with
   real(wp), parameter, public :: power = 2.0_wp/3.0_wp

   !> Place of a wheelset, in lengths that matter as much as each other
   integer, parameter :: n_place = 3
   !> An angle matters as much as so many millimetres: the distance of the wheel from the centre of the track
   real(wp), parameter :: lever = 750.0_wp
   !> From further away nothing is continued [mm]
   real(wp), parameter :: near = 0.5_wp
   !> Parts of the last way that are believed
   real(wp), parameter :: furthest_back = -1.0_wp, furthest_on = 2.0_wp
   !> Steps that are no way [mm2]
   real(wp), parameter :: no_way = 1.0e-20_wp

   !> What the last cases have found
   type :: course_type
      !> Cases that are known, 2 at most: the last one first
      integer, private :: known = 0
      real(wp), private :: place(n_place, 2) = 0.0_wp
      !> Penetration over F**(2/3) [mm/N**(2/3)]
      real(wp), private :: softness(2) = 0.0_wp
      !> Derivative of the force to the height, over what follows from the stiffness of the contacts [-]
      real(wp) :: stiffer = 1.0_wp
   contains
      !> Was the last case near this one?
      procedure :: is_near
      !> Expected penetration
      procedure :: penetration
      !> Take note of a case
      procedure :: note
      !> Begin anew
      procedure :: forget
   end type course_type

contains

   !> Place of a wheelset [mm]
   pure function place_of(wheelset) result(place)
      type(wheelset_spec), intent(in) :: wheelset
      real(wp) :: place(n_place)

      place = [wheelset%y, lever*wheelset%roll, lever*wheelset%yaw]
   end function place_of

   !> Was the last case near this one?
   pure logical function is_near(self, wheelset)
      class(course_type), intent(in) :: self
      !> Where the wheelset is now
      type(wheelset_spec), intent(in) :: wheelset

      is_near = self%known > 0
      if (is_near) is_near = all(abs(place_of(wheelset) - self%place(:, 1)) < near)
   end function is_near

   !> Penetration that is expected to carry a force [mm]
   pure real(wp) function penetration(self, wheelset, force)
      class(course_type), intent(in) :: self
      !> Where the wheelset is now, near the last case
      type(wheelset_spec), intent(in) :: wheelset
      !> Prescribed force [N], positive
      real(wp), intent(in) :: force
      real(wp) :: way(n_place), softness, part

      softness = self%softness(1)
      if (self%known > 1) then
         way = self%place(:, 1) - self%place(:, 2)
         if (dot_product(way, way) > no_way) then
            part = dot_product(place_of(wheelset) - self%place(:, 1), way)/dot_product(way, way)
            part = min(max(part, furthest_back), furthest_on)
            softness = softness*(self%softness(1)/self%softness(2))**part
         end if
      end if
      penetration = softness*force**power
   end function penetration

   !> Take note of a case that was solved
   pure subroutine note(self, wheelset, force, penetration)
      class(course_type), intent(inout) :: self
      !> Where the wheelset was
      type(wheelset_spec), intent(in) :: wheelset
      !> Prescribed force [N] and penetration that carried it [mm]; without both the course begins anew
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
   end subroutine forget
end module contact_wheelrail_course
