!> Normal contact problem on a window, and procedures shared by all methods
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

   !> Estimates with less than this fraction of the force are discarded; chosen
   real(wp), parameter :: carries_nothing = 1.0e-3_wp
   !> Fraction of a prescribed force by which the sum of the pressures may differ due to round-off
   real(wp), parameter :: force_round_off = 1.0e-12_wp

   !> Data of a normal problem on a window; constant during the solution
   type :: normal_problem
      !> Size of the window
      integer :: mx = 0, my = 0
      !> Sides of the elements [mm]
      real(wp) :: dx = 1.0_wp, dy = 1.0_wp
      !> Undeformed distance including displacements due to tangential tractions [mm], shape (mx, my); above excluded_threshold:
      !> contact is excluded
      real(wp), allocatable :: h(:, :)
      !> Is the force prescribed rather than the approach?
      logical :: force_prescribed = .true.
      !> Normal force [N]
      real(wp) :: fn = 0.0_wp
      !> Tolerance of the contact conditions relative to the approach, maximum number of iterations
      real(wp) :: eps = 1.0e-6_wp
      integer :: maxgs = 999
      !> Is the problem one of a sequence, with the solution of a slightly different one as estimate?
      logical :: follows = .false.
      !> Deadline of the case
      type(deadline_type) :: deadline
      !> Parts with reduced interaction; unallocated: full interaction
      type(contact_parts), allocatable :: parts
   end type normal_problem

contains

   !> Normal displacements due to pressures [mm]
   subroutine pressure_displacement(problem, operator, p, u)
      !> Problem with its parts
      type(normal_problem), intent(in) :: problem
      !> Prepared for the window
      class(compliance), intent(inout) :: operator
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Displacements [mm], shape (mx, my)
      real(wp), contiguous, intent(inout) :: u(:, :)

      call displacement_between(problem%parts, operator, p, u)
   end subroutine pressure_displacement

   !> Scale for violations of the contact conditions [mm]: the approach, limited by round-off
   pure real(wp) function approach_scale(pen, h_min, violation) result(scale)
      !> Approach, smallest undeformed distance, and the violation [mm]
      real(wp), intent(in) :: pen, h_min, violation

      scale = max(abs(pen - h_min), epsilon(scale)*max(abs(h_min), violation), tiny(scale))
   end function approach_scale

   !> Make pressures non-negative, zero where contact is excluded, and of the prescribed total
   subroutine make_admissible(problem, p)
      !> Undeformed distance, and the force if it is prescribed
      type(normal_problem), intent(in) :: problem
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(inout) :: p(:, :)
      real(wp) :: total

      where (problem%h > excluded_threshold .or. .not. p > 0.0_wp) p = 0.0_wp
      if (.not. problem%force_prescribed) return
      total = sum(p)*problem%dx*problem%dy
      ! pressures that already carry the force are not changed, not even by round-off
      if (abs(total - problem%fn) <= force_round_off*problem%fn) return
      if (total > carries_nothing*problem%fn) then
         p = p*(problem%fn/total)
      else
         p = 0.0_wp
      end if
   end subroutine make_admissible

   !> Put the load on the element with the smallest distance
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
