!> Problems of the simplified theory on an ellipse, for the tests
module contact_test_elliptic_problem
   use contact_base_choices, only : material_model
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : solve_report
   use contact_simplified_flexibility, only : ellipse
   use contact_simplified_problem, only : simplified_problem, simplified_solution
   use contact_simplified_solve, only : solve_simplified
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   private

   public :: elliptic_problem, solved, claim_sound

contains

   !> Steady rolling of steel bodies with Hertz's pressures
   function elliptic_problem(aa, bb, mx, my, creep, spin, model, direction) result(problem)
      !> Semi-axes [mm]
      real(wp), intent(in) :: aa, bb
      !> Elements over the length and width of the ellipse
      integer, intent(in) :: mx, my
      !> Creepages [-] and spin [rad/mm]
      real(wp), intent(in) :: creep(2), spin
      !> Default: Fastsim with three flexibilities
      integer, intent(in), optional :: model
      !> Default: towards increasing x
      integer, intent(in), optional :: direction
      type(simplified_problem) :: problem
      real(wp) :: shape_
      integer :: ix, iy

      if (present(model)) problem%model%choice = model
      if (present(direction)) problem%direction = direction
      problem%gg = 82000.0_wp
      problem%nu = 0.28_wp
      problem%fn = 1.0e5_wp
      problem%model%flx = 1.0e-4_wp
      problem%dx = 2.0_wp*aa/mx
      problem%dy = 2.0_wp*bb/my
      problem%dq = problem%dx
      problem%x = [(-aa + (ix - 0.5_wp)*problem%dx, ix = 1, mx)]
      problem%y = [(-bb + (iy - 0.5_wp)*problem%dy, iy = 1, my)]
      allocate(problem%contact(mx, my), source=.false.)
      allocate(problem%pn(mx, my), source=0.0_wp)
      allocate(problem%mu(my), source=0.3_wp)
      problem%model%hertz = ellipse(aa, bb)
      problem%creep = creep
      problem%spin = spin
      problem%spin_offset = [problem%direction*problem%dq/6.0_wp, 0.0_wp]
      do iy = 1, my
         do ix = 1, mx
            shape_ = 1.0_wp - (problem%x(ix)/aa)**2 - (problem%y(iy)/bb)**2
            if (shape_ <= 0.0_wp) cycle
            problem%contact(ix, iy) = .true.
            problem%pn(ix, iy) = 1.5_wp*problem%fn/(pi*aa*bb)*sqrt(shape_)
         end do
      end do
   end function elliptic_problem

   !> Solution of a problem
   function solved(problem, report) result(solution)
      type(simplified_problem), intent(in) :: problem
      type(solve_report), intent(out), optional :: report
      type(simplified_solution) :: solution
      type(simplified_problem) :: copy
      type(solve_report) :: ended

      copy = problem
      call solve_simplified(copy, solution, ended)
      if (present(report)) report = ended
   end function solved

   !> Finite numbers, tractions within the bound, slip against the traction, no tractions outside
   subroutine claim_sound(suite, problem, solution, what)
      type(test_suite), intent(inout) :: suite
      type(simplified_problem), intent(in) :: problem
      type(simplified_solution), intent(in) :: solution
      character(len=*), intent(in) :: what
      real(wp), parameter :: rounding = 1.0e-12_wp
      real(wp), allocatable :: length(:, :), work(:, :)

      allocate(length, source=norm2(solution%p, dim=3))
      allocate(work, source=solution%p(:, :, 1)*solution%slip(:, :, 1) + solution%p(:, :, 2)*solution%slip(:, :, 2))
      call suite%check(all(abs(solution%p) <= huge(1.0_wp)) .and. all(abs(solution%slip) <= huge(1.0_wp)), &
         & what // ": finite numbers")
      call suite%check(all(length <= solution%bound*(1.0_wp + rounding)), what // ": within the bound")
      call suite%check(all(work <= 0.0_wp), what // ": friction dissipates energy")
      call suite%check(all(length <= 0.0_wp .or. problem%contact), what // ": no tractions outside the contact")
   end subroutine claim_sound
end module contact_test_elliptic_problem
