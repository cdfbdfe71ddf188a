!> A tangential contact problem with given traction bounds, and its true residual
!>
!> The slip per step is  S(p) = W + dq c + B p,  with B the compliance A (shift, transient
!> rolling) or the difference A - A' between two moments (steady rolling). In every element of
!> the contact area: |p| <= g, and where S /= 0, p = -g S/|S|. Written as one equation,
!>
!>     p - P_g(p - r S(p)) = 0
!>
!> with P_g the projection onto the disc of radius g and any r > 0.
module contact_tangential_problem
   use contact_base_kinds, only : wp
   use contact_elastic_operator, only : elastic_operator
   use contact_grid_element_division, only : element
   implicit none (type, external)
   private

   public :: tangential_problem, tangential_solution, prepare_solution
   public :: apply_operator, slip_of, true_residual, divide_elements, reference_compliance

   !> Data of a tangential problem on a window; constant during the solution
   type :: tangential_problem
      !> Size of the window and sides of the elements [mm]
      integer :: mx = 0, my = 0
      real(wp) :: dx = 1.0_wp, dy = 1.0_wp
      !> Elements in contact, shape (mx, my)
      logical, allocatable :: contact(:, :)
      !> Traction bound g [N/mm2], 0 outside contact, shape (mx, my)
      real(wp), allocatable :: bound(:, :)
      !> Rigid slip and other fixed contributions to the slip per step [mm], without the
      !> unknown creepages, shape (mx, my, 2)
      real(wp), allocatable :: shift(:, :, :)
      !> Steady rolling (B = A - A') or not (B = A)
      logical :: steady = .false.
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer :: direction = 1
      !> Distance per step [mm]; multiplies unknown creepages
      real(wp) :: dq = 1.0_wp
      !> Number of prescribed forces: 0, 1 (Fx), 2 (Fx, Fy)
      integer :: n_forces = 0
      !> Prescribed forces as sums of tractions over the elements, F/(dx dy) [N/mm2]
      real(wp) :: target(2) = 0.0_wp
      !> Relative tolerance and iteration limits
      real(wp) :: eps = 1.0e-6_wp
      integer :: maxgs = 999, maxin = 20, maxnr = 25
      !> Relaxation of the Gauss-Seidel methods
      real(wp) :: omegah = 0.9_wp, omegas = 1.0_wp
      !> Parameters of GDsteady
      real(wp) :: fdecay = 0.9_wp, betath = 0.1_wp
      integer :: kdowfb = 1
      real(wp) :: d_ifc = 1.0_wp, d_lin = 1.0_wp, d_cns = 1.0_wp, d_slp = 1.0_wp, pow_s = 0.9_wp
   end type tangential_problem

   !> Estimate on entry, solution on exit
   type :: tangential_solution
      !> Tangential tractions [N/mm2], shape (mx, my, 2)
      real(wp), allocatable :: p(:, :, :)
      !> Slip per step [mm], shape (mx, my, 2)
      real(wp), allocatable :: slip(:, :, :)
      !> Unknown creepages [-] (shifts [mm] for dq = 1); the first n_forces are in use
      real(wp) :: creep(2) = 0.0_wp
      !> Element states, shape (mx, my)
      integer, allocatable :: division(:, :)
      !> Sensitivities of relative forces sum(p)/sum(g) to the unknown creepages, 0 when unknown
      real(wp) :: sensitivity(2, 2) = 0.0_wp
   end type tangential_solution

contains

   !> Allocate a solution for a problem, zero; keeps arrays of the right size and their values
   subroutine prepare_solution(problem, solution)
      type(tangential_problem), intent(in) :: problem
      type(tangential_solution), intent(inout) :: solution

      if (allocated(solution%p)) then
         if (all(shape(solution%division) == [problem%mx, problem%my])) return
         deallocate(solution%p, solution%slip, solution%division)
      end if
      allocate(solution%p(problem%mx, problem%my, 2), source=0.0_wp)
      allocate(solution%slip(problem%mx, problem%my, 2), source=0.0_wp)
      allocate(solution%division(problem%mx, problem%my), source=element%exterior)
   end subroutine prepare_solution

   !> B p, on the whole window
   subroutine apply_operator(problem, operator, p, u)
      type(tangential_problem), intent(in) :: problem
      type(elastic_operator), intent(inout) :: operator
      real(wp), contiguous, intent(in) :: p(:, :, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)

      if (problem%steady) then
         call operator%steady(p, u)
      else
         call operator%tangential(p, u)
      end if
   end subroutine apply_operator

   !> Slip per step S = W + dq c + B p [mm], on the whole window
   subroutine slip_of(problem, operator, p, creep, slip)
      type(tangential_problem), intent(in) :: problem
      type(elastic_operator), intent(inout) :: operator
      real(wp), contiguous, intent(in) :: p(:, :, :)
      real(wp), intent(in) :: creep(2)
      real(wp), contiguous, intent(inout) :: slip(:, :, :)
      integer :: k

      call apply_operator(problem, operator, p, slip)
      slip = slip + problem%shift
      do k = 1, problem%n_forces
         slip(:, :, k) = slip(:, :, k) + problem%dq*creep(k)
      end do
   end subroutine slip_of

   !> The factor 1/r that turns slip into traction: diagonal compliance of A [mm/(N/mm2)]
   pure real(wp) function reference_compliance(operator) result(c)
      type(elastic_operator), intent(in) :: operator
      c = operator%diagonal(2)
   end function reference_compliance

   !> Relative residual of the contact conditions and of the prescribed forces
   !>
   !> sqrt(|p - P_g(p - r S)|^2/|g|^2 + |sum p - target|^2/(sum g)^2), r = 1/A_xx(0)
   pure real(wp) function true_residual(problem, p, slip, r) result(residual)
      type(tangential_problem), intent(in) :: problem
      real(wp), intent(in) :: p(:, :, :), slip(:, :, :)
      !> Scale of the slip, 1/reference_compliance [(N/mm2)/mm]
      real(wp), intent(in) :: r
      integer :: ix, iy, k
      real(wp) :: z(2), length, total, scale, sum_g

      total = 0.0_wp
      scale = 0.0_wp
      sum_g = 0.0_wp
      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (.not. problem%contact(ix, iy)) cycle
            z = p(ix, iy, :) - r*slip(ix, iy, :)
            length = sqrt(z(1)**2 + z(2)**2)
            if (length > problem%bound(ix, iy)) z = z*(problem%bound(ix, iy)/length)
            total = total + sum((p(ix, iy, :) - z)**2)
            scale = scale + problem%bound(ix, iy)**2
            sum_g = sum_g + problem%bound(ix, iy)
         end do
      end do
      residual = 0.0_wp
      if (scale > 0.0_wp) residual = total/scale
      do k = 1, problem%n_forces
         if (sum_g > 0.0_wp) residual = residual + ((sum(p(:, :, k)) - problem%target(k))/sum_g)**2
      end do
      residual = sqrt(residual)
   end function true_residual

   !> Element states that belong to tractions and slip: slip where |p - r S| > g
   subroutine divide_elements(problem, p, slip, r, division)
      type(tangential_problem), intent(in) :: problem
      real(wp), intent(in) :: p(:, :, :), slip(:, :, :)
      real(wp), intent(in) :: r
      integer, intent(inout) :: division(:, :)
      integer :: ix, iy

      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (.not. problem%contact(ix, iy)) then
               division(ix, iy) = element%exterior
            else if (hypot(p(ix, iy, 1) - r*slip(ix, iy, 1), p(ix, iy, 2) - r*slip(ix, iy, 2)) &
               & > problem%bound(ix, iy)) then
               division(ix, iy) = element%slip
            else
               division(ix, iy) = element%adhesion
            end if
         end do
      end do
   end subroutine divide_elements
end module contact_tangential_problem
