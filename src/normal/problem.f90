!> A normal contact problem on a window, and what every method for it needs
module contact_normal_problem
   use contact_base_constants, only : excluded_threshold
   use contact_base_kinds, only : wp
   use contact_base_limits, only : deadline_type
   use contact_elastic_compliance, only : compliance
   use contact_normal_parts, only : contact_parts, displacement_between
   implicit none (type, external)
   private

   public :: approach_scale, carries_nothing, force_round_off, load_lowest_element, make_admissible, normal_problem, &
      & pressure_displacement

   !> Estimates that carry less than this part of the force are none; chosen
   real(wp), parameter :: carries_nothing = 1.0e-3_wp
   !> Part of a prescribed force by which the sum of the pressures may differ by rounding
   real(wp), parameter :: force_round_off = 1.0e-12_wp

   !> Data of a normal problem on a window; constant during the solution
   type :: normal_problem
      !> Size of the window
      integer :: mx = 0, my = 0
      !> Sides of the elements [mm]
      real(wp) :: dx = 1.0_wp, dy = 1.0_wp
      !> Undeformed distance with displacements by tangential tractions [mm], shape (mx, my);
      !> above excluded_threshold: no contact possible
      real(wp), allocatable :: h(:, :)
      !> Is the force prescribed, or the approach?
      logical :: force_prescribed = .true.
      !> Normal force [N]
      real(wp) :: fn = 0.0_wp
      !> Tolerance on the contact conditions relative to the approach, largest number of iterations
      real(wp) :: eps = 1.0e-6_wp
      integer :: maxgs = 999
      !> Are the pressures that the solver starts from those of a problem that differs a little, again and again?
      logical :: follows = .false.
      !> When the time is up
      type(deadline_type) :: deadline
      !> Parts that act on each other with less than full strength; unallocated: everything acts fully
      type(contact_parts), allocatable :: parts
   end type normal_problem

contains

   !> Normal displacements by pressures [mm]
   subroutine pressure_displacement(problem, operator, p, u)
      !> Its parts decide what acts on each other
      type(normal_problem), intent(in) :: problem
      !> Prepared for the window
      class(compliance), intent(inout) :: operator
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Displacements [mm], shape (mx, my)
      real(wp), contiguous, intent(inout) :: u(:, :)

      call displacement_between(problem%parts, operator, p, u)
   end subroutine pressure_displacement

   !> What violations of the contact conditions are compared with [mm]: the approach, as far as numbers tell it
   pure real(wp) function approach_scale(pen, h_min, violation) result(scale)
      !> Approach, smallest undeformed distance, and the violation [mm]
      real(wp), intent(in) :: pen, h_min, violation

      scale = max(abs(pen - h_min), epsilon(scale)*max(abs(h_min), violation), tiny(scale))
   end function approach_scale

   !> Pressures that are not negative, zero where contact is impossible, and of the right total
   subroutine make_admissible(problem, p)
      !> Undeformed distance, and the force if it is prescribed
      type(normal_problem), intent(in) :: problem
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(inout) :: p(:, :)
      real(wp) :: total

      where (problem%h > excluded_threshold .or. .not. p > 0.0_wp) p = 0.0_wp
      if (.not. problem%force_prescribed) return
      total = sum(p)*problem%dx*problem%dy
      ! pressures that carry the force stay as they are, to the last digit
      if (abs(total - problem%fn) <= force_round_off*problem%fn) return
      if (total > carries_nothing*problem%fn) then
         p = p*(problem%fn/total)
      else
         p = 0.0_wp
      end if
   end subroutine make_admissible

   !> Put the load on the element that is nearest to contact
   subroutine load_lowest_element(problem, p)
      !> Undeformed distance, and the force if it is prescribed
      type(normal_problem), intent(in) :: problem
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(inout) :: p(:, :)
      integer :: place(2)

      place = minloc(problem%h)
      p(place(1), place(2)) = 1.0_wp
   end subroutine load_lowest_element
end module contact_normal_problem
