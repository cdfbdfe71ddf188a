!> Solution of a problem of the simplified theory, for given creepages or for given forces
!>
!> Forces decrease with the creepages, so each unknown creepage can be bracketed. With two unknowns Newton's method is tried first;
!> the nested search by bracketing always terminates.
module contact_simplified_solve
   use contact_base_choices, only : is_fastrip
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : ending, solve_report
   use contact_numeric_root_search, only : root_search
   use contact_simplified_kalker, only : creepage_coefficients, kalker_coefficients
   use contact_simplified_problem, only : complete_problem, simplified_problem, simplified_solution, mean, &
      & tractions_at
   implicit none (type, external)
   private

   public :: solve_simplified

   !> Tolerance of the inner one of two nested searches, relative to that of the outer one, which sees its error as noise; chosen
   real(wp), parameter :: inner_part = 0.1_wp
   !> Determinants of the sensitivities, scaled by the characteristic creepages, that are regarded as zero: differences over 1e-6 of
   !> these creepages have about ten significant digits
   real(wp), parameter :: singular = 1.0e-12_wp

contains

   !> Tractions, slip and creepages. The iterations of the report are sweeps through the contact area, 0 for given creepages; its
   !> residual is the error of the relative forces.
   subroutine solve_simplified(problem, solution, report)
      !> Problem data; completed here
      type(simplified_problem), intent(inout) :: problem
      !> Tractions, slip, element states, forces, and creepages, prescribed or found
      type(simplified_solution), intent(inout) :: solution
      !> How the search for creepages ended
      type(solve_report), intent(inout) :: report
      real(wp) :: creep(2)
      integer :: n

      report%method = "Fastsim"
      if (is_fastrip(problem%model%choice)) report%method = "FaStrip"
      report%iterations = 0
      report%tolerance = problem%eps
      report%ended = ending%converged
      report%residual = 0.0_wp
      call complete_problem(problem, solution)
      n = problem%n_forces
      creep = problem%creep
      if (n == 0) then
         call tractions_at(problem, creep, solution)
         return
      end if
      creep(:n) = 0.0_wp
      if (min(mean(problem%mu), problem%mu_scal)*problem%fn <= 0.0_wp) then
         ! without friction no force can be reached
         call tractions_at(problem, creep, solution)
         report%residual = maxval(abs(problem%force(:n)))
         if (report%residual > problem%eps) report%ended = ending%stagnated
         return
      end if
      if (n == 1) then
         call find_longitudinal(problem, problem%eps, creep, solution, report)
      else
         call newton(problem, creep, solution, report)
         if (report%residual > problem%eps) call find_both(problem, creep, solution, report)
      end if
      if (report%residual > problem%eps) report%ended = ending%stagnated
   end subroutine solve_simplified

   !> Creepages for which linear theory gives the full friction force [-]
   pure function characteristic_creep(problem) result(creep)
      type(simplified_problem), intent(in) :: problem
      real(wp) :: creep(2)
      type(creepage_coefficients) :: c

      c = kalker_coefficients(problem%area%aa, problem%area%bb, problem%nu)
      creep = mean(problem%mu)*problem%fn/(problem%gg*problem%area%aa*problem%area%bb*problem%model%reduction%k0*[c%c11, c%c22])
      ! a shift [mm] gives this strain over the semi-axis of the contact
      if (problem%shift) creep = creep*problem%area%aa
   end function characteristic_creep

   !> Longitudinal creepage for a given longitudinal force, by bracketing
   subroutine find_longitudinal(problem, tolerance, creep, solution, report)
      type(simplified_problem), intent(in) :: problem
      real(wp), intent(in) :: tolerance
      !> The longitudinal creepage is an estimate on entry and the solution on exit; the lateral one is given [-]
      real(wp), intent(inout) :: creep(2)
      type(simplified_solution), intent(inout) :: solution
      type(solve_report), intent(inout) :: report
      type(root_search) :: search
      real(wp) :: unit(2)

      unit = characteristic_creep(problem)
      call search%start(creep(1), 0.25_wp*unit(1), tolerance)
      do while (.not. search%finished)
         creep(1) = search%x
         call tractions_at(problem, creep, solution)
         call search%update(solution%force(1) - problem%force(1), solution%sliding)
      end do
      report%iterations = report%iterations + search%evaluations
      creep(1) = search%best
      if (solution%creep(1) /= creep(1)) call tractions_at(problem, creep, solution)
      report%residual = search%best_value
   end subroutine find_longitudinal

   !> Both creepages for both forces, by nested bracketing
   subroutine find_both(problem, creep, solution, report)
      type(simplified_problem), intent(in) :: problem
      real(wp), intent(inout) :: creep(2)
      type(simplified_solution), intent(inout) :: solution
      type(solve_report), intent(inout) :: report
      type(root_search) :: search
      real(wp) :: unit(2), best(2), error, best_error

      unit = characteristic_creep(problem)
      best = creep
      best_error = huge(best_error)
      call search%start(creep(2), 0.25_wp*unit(2), 0.5_wp*problem%eps)
      do while (.not. search%finished)
         creep(2) = search%x
         call find_longitudinal(problem, inner_part*problem%eps, creep, solution, report)
         error = maxval(abs(solution%force - problem%force))
         if (error < best_error) then
            best = creep
            best_error = error
         end if
         call search%update(solution%force(2) - problem%force(2), solution%sliding)
      end do
      creep = best
      call tractions_at(problem, creep, solution)
      report%residual = maxval(abs(solution%force - problem%force))
   end subroutine find_both

   !> Newton's method with finite differences; stops without progress and reports its residual
   subroutine newton(problem, creep, solution, report)
      type(simplified_problem), intent(in) :: problem
      real(wp), intent(inout) :: creep(2)
      type(simplified_solution), intent(inout) :: solution
      type(solve_report), intent(inout) :: report
      integer, parameter :: max_steps = 20, max_halvings = 6
      !> Step of the differences, relative to the characteristic creepages
      real(wp), parameter :: share = 1.0e-6_wp
      real(wp) :: unit(2), base(2), missing(2), slope(2, 2), step(2), determinant, factor
      integer :: i, j

      unit = characteristic_creep(problem)
      ! creep force curve of Vermeulen and Johnson (1964)
      factor = 1.0_wp - (max(0.0_wp, 1.0_wp - norm2(problem%force)))**(1.0_wp/3.0_wp)
      creep = -3.0_wp*factor*unit*problem%force/max(norm2(problem%force), tiny(factor))
      call evaluate(creep)
      do i = 1, max_steps
         if (report%residual <= problem%eps) return
         base = creep
         missing = solution%force - problem%force
         do j = 1, 2
            creep = base
            creep(j) = base(j) + share*unit(j)
            call evaluate(creep)
            slope(:, j) = (solution%force - problem%force - missing)/(share*unit(j))
         end do
         determinant = slope(1, 1)*slope(2, 2) - slope(1, 2)*slope(2, 1)
         report%residual = maxval(abs(missing))
         if (determinant*product(unit) <= singular) return
         step = -[slope(2, 2)*missing(1) - slope(1, 2)*missing(2), slope(1, 1)*missing(2) - slope(2, 1)*missing(1)]/determinant
         do j = 0, max_halvings
            creep = base + 0.5_wp**j*step
            call evaluate(creep)
            if (norm2(solution%force - problem%force) < norm2(missing)) exit
         end do
         if (j > max_halvings) then
            creep = base
            report%residual = maxval(abs(missing))
            return
         end if
      end do

   contains

      !> Evaluate the tractions at given creepages, and count the evaluation
      subroutine evaluate(at)
         real(wp), intent(in) :: at(2)

         call tractions_at(problem, at, solution)
         report%iterations = report%iterations + 1
         report%residual = maxval(abs(solution%force - problem%force))
      end subroutine evaluate
   end subroutine newton
end module contact_simplified_solve
