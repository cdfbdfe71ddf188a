!> The classical solvers, selected by name, with prescribed creepages or forces
module contact_tangential_classical
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_halfspace, only : kernel_table
   use contact_elastic_compliance, only : compliance
   use contact_grid_element_division, only : element
   use contact_tangential_convex_gs, only : convex_gs
   use contact_tangential_gd_steady, only : gd_steady
   use contact_tangential_prescribed_forces, only : force_iteration
   use contact_tangential_problem, only : at_bound, divide_elements, prepare_solution, residual_scale, finish_slip, &
      & slip_of, tangential_problem, tangential_solution, true_residual
   use contact_tangential_steady_gs, only : steady_gs
   use contact_tangential_streaming, only : streaming_rows
   use contact_tangential_tang_cg, only : tang_cg
   implicit none (type, external)
   private

   public :: classical_method, solve_classical, method_name

   type :: classical_method_list
      !> Conjugate gradients; shifts and transient rolling
      integer :: tang_cg = 1
      !> Gauss-Seidel on increments; steady rolling along x, one element per step
      integer :: steady_gs = 2
      !> Gauss-Seidel on tractions; for all problems
      integer :: convex_gs = 3
      !> Gradient descent on increments, followed by SteadyGS if it fails; same problems as SteadyGS
      integer :: gd_steady = 4
   end type classical_method_list
   !> Names of the methods
   type(classical_method_list), parameter :: classical_method = classical_method_list()

   !> Tolerance of the tractions relative to that of prescribed forces; chosen
   real(wp), parameter :: inner_share = 0.2_wp
   !> True residual above which small updates mean stagnation rather than a solution; chosen
   real(wp), parameter :: no_solution = 0.2_wp

   !> Data of one call of solve_classical
   type :: classical_solver
      !> Member of classical_method; GDsteady is replaced permanently if it fails
      integer :: method = 0
      !> Steady rolling with a shifted table of coefficients? Does the method process rows?
      logical :: general = .false., with_rows = .false.
      type(streaming_rows) :: rows
      !> Tolerance of the updates, relative to the tractions [-]
      real(wp) :: eps = 0.0_wp
      !> Scale of the slip, see residual_scale [(N/mm2)/mm]
      real(wp) :: r = 1.0_wp
   contains
      !> Creepages for prescribed forces
      procedure :: find_creepages
      !> Tractions for given creepages
      procedure :: solve
      procedure :: sweep
   end type classical_solver

contains

   !> Name of a method in reports
   pure function method_name(choice) result(name)
      !> Member of classical_method
      integer, intent(in) :: choice
      character(len=14) :: name

      select case (choice)
      case (classical_method%tang_cg)
         name = "TangCG"
      case (classical_method%steady_gs)
         name = "SteadyGS"
      case (classical_method%convex_gs)
         name = "ConvexGS"
      case (classical_method%gd_steady)
         name = "GDsteady"
      case default
         name = "unknown method"
      end select
   end function method_name

   !> Solve a tangential problem, starting from the estimate in the solution
   !>
   !> Always terminates. The solution is admissible and finite in every case; report%ended describes its quality. A method that
   !> is not applicable to the problem is replaced by one that is.
   subroutine solve_classical(problem, operator, choice, solution, report, log, shifted)
      !> Rigid slip, bounds, prescribed forces, tolerance
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window of the problem
      class(compliance), intent(inout) :: operator
      !> Member of classical_method
      integer, intent(in) :: choice
      !> On entry an estimate of tractions and creepages, on exit the solution with slip and element states
      type(tangential_solution), intent(inout) :: solution
      !> Products and transforms are accumulated, all other components describe this call
      type(solve_report), intent(inout) :: report
      !> Receives a line per iteration from flow-trace level 5 on, and warnings if a method is replaced
      type(log_type), intent(inout) :: log
      !> Coefficients of the same particles at the previous time, in steady rolling with steps other than one element or in an
      !> oblique direction (ConvexGS only)
      type(kernel_table), intent(in), optional :: shifted
      type(classical_solver) :: self
      real(wp) :: pairs_before
      integer :: products_before
      logical :: clean

      call prepare_solution(problem, solution)
      report%ended = ending%not_started
      report%iterations = 0
      report%residual = 0.0_wp
      report%tolerance = problem%settings%eps
      report%gave_up = ""
      products_before = operator%products
      pairs_before = operator%fft_pairs()
      self%general = present(shifted) .and. problem%steady
      self%method = suitable_method(problem, choice, self%general)
      report%method = method_name(self%method)
      solution%division = element%exterior
      if (.not. any(problem%contact)) then
         solution%p = 0.0_wp
         solution%slip = 0.0_wp
         return
      end if
      self%r = residual_scale(problem, operator)
      call make_admissible(problem, solution, clean)
      if (.not. clean) then
         report%ended = ending%diverged
         report%residual = -1.0_wp
         where (problem%contact) solution%division = element%adhesion
         return
      end if

      self%with_rows = self%method /= classical_method%tang_cg
      if (self%with_rows) then
         call operator%complete()
         if (self%general) then
            call self%rows%prepare(problem, operator, shifted)
         else
            call self%rows%prepare(problem, operator)
         end if
      end if
      self%eps = problem%settings%eps
      if (problem%n_forces == 0) then
         call self%solve(problem, operator, solution, report, log)
         solution%sensitivity = 0.0_wp
      else
         call self%find_creepages(problem, operator, solution, report, log)
      end if
      report%residual = true_residual(problem, solution%p, solution%slip, self%r)
      if (report%residual > no_solution .and. report%ended == ending%converged) report%ended = ending%stagnated
      call finish_slip(problem, self%r, solution)
      report%products = report%products + operator%products - products_before
      if (self%with_rows) then
         report%products = report%products + self%rows%products()
         call self%rows%release()
      end if
      report%fft_pairs = report%fft_pairs + operator%fft_pairs() - pairs_before
   end subroutine solve_classical

   !> Make an estimate admissible: finite and within the bounds
   subroutine make_admissible(problem, solution, clean)
      type(tangential_problem), intent(in) :: problem
      type(tangential_solution), intent(inout) :: solution
      !> Is the problem finite? Otherwise the solution is zero
      logical, intent(out) :: clean
      integer :: ix, iy
      real(wp) :: length

      clean = all(ieee_is_finite(problem%shift)) .and. all(ieee_is_finite(problem%bound)) &
         & .and. all(ieee_is_finite(problem%target))
      if (.not. all(ieee_is_finite(solution%creep))) solution%creep = 0.0_wp
      if (.not. (clean .and. all(ieee_is_finite(solution%p)))) solution%p = 0.0_wp
      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (.not. problem%contact(ix, iy)) then
               solution%p(ix, iy, :) = 0.0_wp
               cycle
            end if
            length = hypot(solution%p(ix, iy, 1), solution%p(ix, iy, 2))
            if (length > problem%bound(ix, iy)) &
               & solution%p(ix, iy, :) = solution%p(ix, iy, :)*(problem%bound(ix, iy)/length)
         end do
      end do
      if (.not. clean) solution%slip = 0.0_wp
   end subroutine make_admissible

   !> Solve repeatedly for different creepages until the forces equal the prescribed ones
   subroutine find_creepages(self, problem, operator, solution, report, log)
      class(classical_solver), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(tangential_solution), intent(inout) :: solution
      type(solve_report), intent(inout) :: report
      type(log_type), intent(inout) :: log
      type(force_iteration) :: forces
      real(wp) :: creep(2), force(2), sum_g

      ! forces are compared with the tolerance eps, which requires more accurate tractions
      self%eps = inner_share*problem%settings%eps
      sum_g = sum(problem%bound, mask=problem%contact)
      call forces%start(problem, operator, solution%sensitivity)
      creep = solution%creep
      do
         solution%creep = creep
         call self%solve(problem, operator, solution, report, log)
         if (sum_g <= 0.0_wp .or. report%ended == ending%diverged .or. report%ended == ending%out_of_time) exit
         force = [sum(solution%p(:, :, 1)), sum(solution%p(:, :, 2))]/sum_g
         call forces%advance(force, any(solution%division == element%adhesion &
            & .or. solution%division == element%plastic), creep)
         call trace_forces(problem, solution%creep, force, forces%evaluations, report%iterations, log)
         if (forces%ended /= ending%not_started) exit
      end do
      if (forces%ended > ending%converged) report%ended = forces%ended
      solution%sensitivity = 0.0_wp
      solution%sensitivity(:forces%n, :forces%n) = forces%sensitivity(:forces%n, :forces%n)
      if (forces%full_sliding) then
         report%ended = ending%stagnated
         call log%warning("full sliding; the prescribed tangential force cannot be reached")
      end if
   end subroutine find_creepages

   !> Solve for the creepages of the solution
   subroutine solve(self, problem, operator, solution, report, log)
      class(classical_solver), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(tangential_solution), intent(inout) :: solution
      type(solve_report), intent(inout) :: report
      type(log_type), intent(inout) :: log
      character(len=160) :: text

      select case (self%method)
      case (classical_method%tang_cg)
         call mark_states(problem, solution)
         call tang_cg(problem, operator, self%eps, solution%creep, solution%p, solution%division, report, log)
      case (classical_method%gd_steady)
         call mark_states(problem, solution)
         call gd_steady(problem, operator, self%eps, solution%creep, solution%p, solution%division, report, log)
         if (report%ended /= ending%converged) then
            report%gave_up = method_name(self%method)
            self%method = classical_method%steady_gs
            report%method = method_name(self%method)
            call log%trace(3, "      Tang: GDsteady does not converge, continuing with SteadyGS")
            call self%sweep(problem, solution, report, log)
         end if
      case default
         call self%sweep(problem, solution, report, log)
      end select
      if (self%general) then
         call self%rows%get_slip(solution%slip)
      else
         call slip_of(problem, operator, solution%p, solution%creep, solution%slip)
      end if
      call divide_elements(problem, solution%p, solution%slip, self%r, solution%division)
      if (log%shows(4)) then
         write(text, "(4X, I4, A, 2I7)") 1, ", Tang: size of Adhes, Slip area :", &
            & count(solution%division == element%adhesion), count(solution%division == element%slip)
         call log%trace(4, trim(text))
      end if
   end subroutine solve

   !> Solve by one of the Gauss-Seidel methods
   subroutine sweep(self, problem, solution, report, log)
      class(classical_solver), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem
      type(tangential_solution), intent(inout) :: solution
      type(solve_report), intent(inout) :: report
      type(log_type), intent(inout) :: log

      call self%rows%start(problem, solution%creep, solution%p)
      if (self%method == classical_method%steady_gs) then
         call steady_gs(problem, self%rows, self%eps, report, log)
      else
         call convex_gs(problem, self%rows, self%eps, report, log)
      end if
      call self%rows%get_tractions(solution%p)
   end subroutine sweep

   !> Element states of the estimate: slip if the bound is reached
   subroutine mark_states(problem, solution)
      type(tangential_problem), intent(in) :: problem
      type(tangential_solution), intent(inout) :: solution

      solution%division = element%exterior
      where (problem%contact) solution%division = element%adhesion
      where (problem%contact .and. hypot(solution%p(:, :, 1), solution%p(:, :, 2)) >= at_bound*problem%bound) &
         & solution%division = element%slip
   end subroutine mark_states

   !> Write a line of the flow trace for each prescribed force
   subroutine trace_forces(problem, creep, force, evaluations, iterations, log)
      type(tangential_problem), intent(in) :: problem
      !> Creepages [-], and the corresponding relative forces [-]
      real(wp), intent(in) :: creep(2), force(2)
      !> Evaluations so far, and iterations of the last one
      integer, intent(in) :: evaluations, iterations
      type(log_type), intent(inout) :: log
      character(len=160) :: text

      if (.not. log%shows(4)) return
      write(text, "(4X, I6, A, 2ES15.6, A, I5)") evaluations, ", NR_Fx,    Cksi, Fxk: ", creep(1), force(1), "   ItCG:", iterations
      call log%trace(4, trim(text))
      if (problem%n_forces < 2) return
      write(text, "(4X, I6, A, 2ES15.6)") evaluations, ", NR_Fy,    Ceta, Fyk: ", creep(2), force(2)
      call log%trace(4, trim(text))
   end subroutine trace_forces

   !> The selected method, or one that is applicable to the problem
   pure integer function suitable_method(problem, choice, general) result(method)
      type(tangential_problem), intent(in) :: problem
      integer, intent(in) :: choice
      logical, intent(in) :: general

      method = choice
      if (problem%steady .and. choice == classical_method%tang_cg) method = classical_method%steady_gs
      if (.not. problem%steady .and. (choice == classical_method%steady_gs &
         & .or. choice == classical_method%gd_steady)) method = classical_method%tang_cg
      ! the limit of a yielding element depends on its plastic displacement: requires element problems
      if (problem%hardens()) then
         if (.not. problem%steady) method = classical_method%convex_gs
         if (problem%steady .and. method /= classical_method%convex_gs) method = classical_method%steady_gs
      end if
      if (general) method = classical_method%convex_gs
   end function suitable_method
end module contact_tangential_classical
