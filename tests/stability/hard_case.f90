!> Hard cases: how they are run, checked and written to the table
!>
!> Every case has a correct result or ends with a clear message. A result is checked by the contact
!> conditions themselves, evaluated from the fields of the result by direct sums over the influence
!> coefficients: without FFT, and without data of the solvers.
module hard_case
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_choices, only : motion, normal_control, pressure_model, time_link
   use contact_base_constants, only : excluded_threshold
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_cases_session, only : contact_session, release_session, solve_case
   use contact_cases_spec, only : case_spec, part_source
   use contact_elastic_halfspace, only : fill_shifted_table, fill_table, kernel_table
   use contact_elastic_material, only : combine, combined_material
   use contact_grid_element_division, only : element
   use contact_patch_result, only : patch_result
   use contact_test_harness, only : test_suite
   use judged_estimate, only : judge_estimate
   implicit none (type, external)
   private

   public :: hard_run, findings, elliptic_case, given_case, open_table, close_table, run_case
   public :: expect_solution, expect_statement, expect_refusal, examine, random_numbers, has_message

   !> One problem through its cases
   type :: hard_run
      type(contact_session) :: session
      type(log_type) :: log
      !> Present and previous time step
      type(patch_result) :: result, before
      !> Does the present time step continue a previous one?
      logical :: linked = .false.
      type(error_type), allocatable :: error
      !> Seconds of the last case, warnings of the last case
      real(wp) :: seconds = 0.0_wp
      integer :: warnings = 0
   contains
      !> Free the memory of the session
      procedure :: release
      !> The same at the end of a scope; one call there compiles faster than the release of all components
      final :: finish
   end type hard_run

   !> Violations of the contact conditions, all relative
   type :: findings
      logical :: finite = .false.
      !> Negative pressure, gap inside and penetration outside the contact area, error of the normal force
      real(wp) :: tension = 0.0_wp, gap = 0.0_wp, penetration = 0.0_wp, normal_force = 0.0_wp
      !> Traction above the bound, residual of the friction law (2-norm, as reported, and largest)
      real(wp) :: excess = 0.0_wp, friction = 0.0_wp, worst = 0.0_wp
      !> Error of the prescribed forces, of the slip in the result, of the totals
      real(wp) :: forces = 0.0_wp, slip = 0.0_wp, totals = 0.0_wp
   end type findings

   !> Unit of the table, 0: none
   integer :: table = 0

contains

   !> Rolling or shift of an elliptical contact, steel on steel, force prescribed
   function elliptic_case(motion_choice, mx, my, aa, bb) result(spec)
      integer, intent(in) :: motion_choice, mx, my
      !> Semi-axes [mm]
      real(wp), intent(in) :: aa, bb
      type(case_spec) :: spec

      spec%link = time_link%initiate
      spec%motion = motion_choice
      spec%normal = normal_control%force
      spec%kinematics%fn = 30000.0_wp*aa*bb/15.0_wp
      spec%parts%grid = part_source%given
      spec%parts%geometry = part_source%given
      spec%grid%form = -3
      spec%grid%mx = mx
      spec%grid%my = my
      spec%grid%aa = aa
      spec%grid%bb = bb
      spec%grid%scale = 1.1_wp
      call common_values(spec)
      spec%rolling%dq = 2.2_wp*aa/mx
      if (motion_choice == motion%shift) spec%rolling%dq = 1.0_wp
   end function elliptic_case

   !> Square elements of 0.1 mm around the origin and a paraboloid of radius 100 mm, force prescribed
   function given_case(motion_choice, mx, my) result(spec)
      integer, intent(in) :: motion_choice, mx, my
      type(case_spec) :: spec

      spec%link = time_link%initiate
      spec%motion = motion_choice
      spec%normal = normal_control%force
      spec%kinematics%fn = 100.0_wp
      spec%parts%grid = part_source%given
      spec%parts%geometry = part_source%given
      spec%grid%form = 1
      spec%grid%mx = mx
      spec%grid%my = my
      spec%grid%dx = 0.1_wp
      spec%grid%dy = 0.1_wp
      spec%grid%xl = -0.05_wp*mx
      spec%grid%yl = -0.05_wp*my
      spec%geometry%form = 1
      spec%geometry%b = [5.0e-3_wp, 0.0_wp, 5.0e-3_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
      call common_values(spec)
      spec%rolling%dq = 0.1_wp
   end function given_case

   !> Steel, friction 0.3, tolerance 1e-6
   subroutine common_values(spec)
      type(case_spec), intent(inout) :: spec

      allocate(spec%friction%sets(1))
      spec%material%gg = 82000.0_wp
      spec%material%poiss = 0.28_wp
      spec%rolling%veloc = 1000.0_wp
      spec%iteration%eps = 1.0e-6_wp
   end subroutine common_values

   !> Start the table of this program in its scratch directory
   subroutine open_table(title)
      character(len=*), intent(in) :: title

      open(newunit=table, file="table.md", status="replace", action="write")
      write(table, "(a)") "## " // title, "", &
         & "| case | contact | stick | normal: it / prod / residual | tangential | it | prod | residual | recomputed | ended |", &
         & "|---|---|---|---|---|---|---|---|---|---|"
   end subroutine open_table

   subroutine close_table()
      write(table, "(a)") ""
      close(table)
   end subroutine close_table

   !> Solve one case and keep the previous time step
   subroutine run_case(run, spec)
      type(hard_run), intent(inout) :: run
      type(case_spec), intent(in) :: spec
      integer :: start, finish, rate, warnings

      run%linked = spec%link /= time_link%initiate
      if (run%linked) run%before = run%result
      warnings = run%log%warnings
      if (allocated(run%error)) deallocate(run%error)
      call system_clock(start, rate)
      call solve_case(run%session, spec, run%log, run%result, run%error)
      call system_clock(finish)
      run%seconds = real(finish - start, wp)/rate
      run%warnings = run%log%warnings - warnings
   end subroutine run_case

   impure elemental subroutine finish(self)
      type(hard_run), intent(inout) :: self
      call self%release()
   end subroutine finish

   subroutine release(self)
      class(hard_run), intent(inout) :: self
      call release_session(self%session)
   end subroutine release

   !> The case must converge, and its result must satisfy the contact conditions
   subroutine expect_solution(suite, run, spec, name, slack, silent, sampled)
      type(test_suite), intent(inout) :: suite
      type(hard_run), intent(inout) :: run
      type(case_spec), intent(in) :: spec
      character(len=*), intent(in) :: name
      !> Allowed violation in multiples of EPS; default 1.05 (FFT against direct sums)
      real(wp), intent(in), optional :: slack
      !> Without a line in the table; default no
      logical, intent(in), optional :: silent
      !> Are distances so rough that a grid of every third one is a different surface, unsuitable to check estimates? Default no
      logical, intent(in), optional :: sampled
      type(findings) :: found
      real(wp) :: allowed, gap_allowed
      logical :: row, is_judged

      row = .true.
      if (present(silent)) row = .not. silent
      is_judged = .true.
      if (present(sampled)) is_judged = .not. sampled
      call run_case(run, spec)
      if (allocated(run%error)) then
         call suite%check(.false., name // ": error " // full_text(run%error))
         if (row) call write_row(run, name, found)
         return
      end if
      allowed = 1.05_wp
      if (present(slack)) allowed = slack
      allowed = allowed*spec%iteration%eps + 1.0e-13_wp
      gap_allowed = allowed
      call examine(run, spec, found)
      if (row) call write_row(run, name, found)
      call suite%check(run%result%normal%succeeded(), name // ": normal problem ends " // ended_text(run%result%normal))
      call suite%check(run%result%tangential%succeeded(), &
         & name // ": tangential problem ends " // ended_text(run%result%tangential))
      call suite%check(found%finite, name // ": all numbers are finite")
      if (.not. found%finite) return
      call suite%close_to(found%tension, 0.0_wp, 0.0_wp, name // ": no tension")
      call suite%close_to(found%normal_force, 0.0_wp, 1.0e-12_wp, name // ": normal force")
      call suite%close_to(found%gap, 0.0_wp, gap_allowed, name // ": gap in the contact area")
      call suite%close_to(found%penetration, 0.0_wp, gap_allowed, name // ": penetration outside")
      call suite%close_to(found%excess, 0.0_wp, 1.0e-12_wp, name // ": tractions within their bounds")
      call suite%close_to(found%friction, 0.0_wp, allowed, name // ": friction law")
      call suite%close_to(found%worst, 0.0_wp, allowed*sqrt(real(max(1, run%result%ncon), wp)) + 1.0e-12_wp, &
         & name // ": friction law, worst element")
      call suite%close_to(found%forces, 0.0_wp, allowed, name // ": prescribed forces")
      call suite%close_to(found%slip, 0.0_wp, 1.0e-9_wp, name // ": slip of the result")
      call suite%close_to(found%totals, 0.0_wp, 1.05_wp*spec%iteration%eps + 1.0e-10_wp, name // ": totals of the result")
      if (is_judged .and. .not. run%linked) call judge_estimate(suite, run%session%problem, run%session%state, run%result, name)
   end subroutine expect_solution

   !> The case must end with a correct result, or with a report and a message about its failure
   subroutine expect_statement(suite, run, spec, name, slack)
      type(test_suite), intent(inout) :: suite
      type(hard_run), intent(inout) :: run
      type(case_spec), intent(in) :: spec
      character(len=*), intent(in) :: name
      real(wp), intent(in), optional :: slack
      type(findings) :: found
      real(wp) :: allowed

      call run_case(run, spec)
      if (allocated(run%error)) then
         call suite%check(has_message(run), name // ": the error has a message")
         call write_row(run, name, found)
         return
      end if
      call examine(run, spec, found)
      call write_row(run, name, found)
      call suite%check(found%finite, name // ": all numbers are finite")
      if (.not. found%finite) return
      allowed = 1.05_wp
      if (present(slack)) allowed = slack
      allowed = allowed*spec%iteration%eps + 1.0e-13_wp
      call suite%close_to(found%tension, 0.0_wp, 0.0_wp, name // ": no tension")
      call suite%close_to(found%excess, 0.0_wp, 1.0e-12_wp, name // ": tractions within their bounds")
      if (run%result%normal%succeeded()) then
         call suite%close_to(max(found%gap, found%penetration), 0.0_wp, allowed, name // ": gap")
         call suite%close_to(found%normal_force, 0.0_wp, 1.0e-12_wp, name // ": normal force")
      else
         call suite%check(run%warnings > 0, name // ": a message reports that the normal problem did not converge")
      end if
      if (run%result%tangential%succeeded()) then
         call suite%close_to(found%friction, 0.0_wp, allowed, name // ": friction law")
         call suite%close_to(found%forces, 0.0_wp, allowed, name // ": prescribed forces")
      else
         call suite%check(run%warnings > 0, name // ": a message reports that friction did not converge")
      end if
   end subroutine expect_statement

   !> The case must be refused with a message that contains a word
   subroutine expect_refusal(suite, run, spec, name, word)
      type(test_suite), intent(inout) :: suite
      type(hard_run), intent(inout) :: run
      type(case_spec), intent(in) :: spec
      character(len=*), intent(in) :: name, word
      type(findings) :: found

      call run_case(run, spec)
      call write_row(run, name, found)
      call suite%check(allocated(run%error), name // ": is refused")
      if (.not. allocated(run%error)) return
      call suite%check(index(run%error%message, word) > 0, name // ": message """ // run%error%message // &
         & """ names " // word)
   end subroutine expect_refusal

   logical function has_message(run)
      type(hard_run), intent(in) :: run
      has_message = .false.
      if (.not. allocated(run%error)) return
      if (allocated(run%error%message)) has_message = len_trim(run%error%message) > 20
   end function has_message

   !> Evaluate the contact conditions by direct sums
   subroutine examine(run, spec, found)
      type(hard_run), intent(in) :: run
      type(case_spec), intent(in) :: spec
      type(findings), intent(out) :: found
      type(kernel_table) :: now, later, old
      type(combined_material) :: material
      real(wp), allocatable :: p(:, :), w(:, :)
      integer, allocatable :: cx(:), cy(:)
      real(wp) :: mu, scale, area, fn, r, g, z(2), s(2), length, total, bounds, sum_g, turn(2), dq, x0, y0, target(2), smax
      integer :: i, j, n, mx, my, ix, iy, k
      logical :: coupled, johnson

      associate (res => run%result)
         mx = res%grid%mx
         my = res%grid%my
         found%finite = all(ieee_is_finite(res%pn)) .and. all(ieee_is_finite(res%px)) .and. all(ieee_is_finite(res%py)) &
            & .and. all(ieee_is_finite(res%sx)) .and. all(ieee_is_finite(res%sy)) .and. ieee_is_finite(res%fn) &
            & .and. ieee_is_finite(res%pen) .and. ieee_is_finite(res%cksi) .and. ieee_is_finite(res%ceta) &
            & .and. ieee_is_finite(res%fx) .and. ieee_is_finite(res%fy) .and. ieee_is_finite(res%mz) &
            & .and. all(ieee_is_finite(res%un)) .and. all(ieee_is_finite(res%ux)) .and. all(ieee_is_finite(res%uy)) &
            & .and. ieee_is_finite(res%residual)
         if (.not. found%finite) return
         area = res%grid%dx*res%grid%dy
         found%tension = max(0.0_wp, -minval(res%pn))
         fn = area*sum(res%pn)
         if (spec%normal == normal_control%force) then
            if (spec%kinematics%fn > 0.0_wp .and. spec%pressure == pressure_model%full) &
               & found%normal_force = abs(fn/spec%kinematics%fn - 1.0_wp)
         else
            found%normal_force = abs(res%fn - fn)/max(fn, tiny(fn))
         end if
         n = count(res%division > element%exterior)
         allocate(cx(n), cy(n), p(n, 3))
         i = 0
         do iy = 1, my
            do ix = 1, mx
               if (res%division(ix, iy) == element%exterior) then
                  if (abs(res%pn(ix, iy)) + abs(res%px(ix, iy)) + abs(res%py(ix, iy)) > 0.0_wp) found%excess = 1.0_wp
                  cycle
               end if
               i = i + 1
               cx(i) = ix
               cy(i) = iy
               p(i, :) = [res%px(ix, iy), res%py(ix, iy), res%pn(ix, iy)]
            end do
         end do
         material = combine(spec%material%poiss, spec%material%gg)
         coupled = material%coupled()
         call fill_table(now, material, res%grid%dx, res%grid%dy, mx, my)

         ! normal gaps; the Johnson process solves them without tangential tractions
         johnson = spec%iteration%maxout <= 1
         if (spec%pressure == pressure_model%full) then
            scale = max(abs(res%pen - minval(res%h)), tiny(scale))
            do iy = 1, my
               do ix = 1, mx
                  if (res%h(ix, iy) > excluded_threshold) then
                     if (res%division(ix, iy) /= element%exterior) found%gap = 1.0_wp
                     cycle
                  end if
                  g = res%h(ix, iy) - res%pen
                  do j = 1, n
                     g = g + now%nn(ix - cx(j), iy - cy(j))*p(j, 3)
                  end do
                  if (coupled .and. .not. johnson) then
                     do j = 1, n
                        g = g - now%xn(ix - cx(j), iy - cy(j))*p(j, 1) - now%yn(ix - cx(j), iy - cy(j))*p(j, 2)
                     end do
                  end if
                  if (res%division(ix, iy) == element%exterior) then
                     found%penetration = max(found%penetration, -g/scale)
                  else
                     found%gap = max(found%gap, abs(g)/scale)
                  end if
               end do
            end do
         end if
         if (spec%motion == motion%none .or. n == 0) return

         ! slip from creepages and displacements
         mu = spec%friction%sets(1)%fstat
         allocate(w(n, 2))
         dq = res%dq
         x0 = spec%kinematics%spinxo
         y0 = spec%kinematics%spinyo
         if (spec%motion == motion%shift) then
            dq = 1.0_wp
         else
            x0 = x0 - spec%rolling%facphi*dq*cos(res%chi)
            y0 = y0 - spec%rolling%facphi*dq*sin(res%chi)
         end if
         do i = 1, n
            w(i, 1) = dq*(res%cksi - spec%kinematics%cphi*(res%grid%y(cy(i)) - y0))
            w(i, 2) = dq*(res%ceta + spec%kinematics%cphi*(res%grid%x(cx(i)) - x0))
         end do
         call add_displacements(now, 1.0_wp)
         if (spec%motion == motion%steady_rolling) then
            turn = [dq*cos(res%chi), 0.0_wp]
            call fill_shifted_table(later, material, res%grid%dx, res%grid%dy, mx, my, turn(1), turn(2))
            call add_displacements(later, -1.0_wp)
         else if (run%linked) then
            call subtract_previous()
         end if

         ! friction law
         r = 1.0_wp/now%xx(0, 0)
         total = 0.0_wp
         bounds = 0.0_wp
         sum_g = 0.0_wp
         smax = maxval(abs(w))
         do i = 1, n
            g = mu*p(i, 3)
            s = w(i, :)
            z = p(i, 1:2) - r*s
            length = norm2(z)
            if (length > g) z = z*(g/length)
            total = total + sum((p(i, 1:2) - z)**2)
            bounds = bounds + g**2
            sum_g = sum_g + g
            found%worst = max(found%worst, norm2(p(i, 1:2) - z))
            if (norm2(p(i, 1:2)) > g) found%excess = max(found%excess, norm2(p(i, 1:2))/max(g, tiny(g)) - 1.0_wp)
            if (res%division(cx(i), cy(i)) == element%slip) found%slip = max(found%slip, &
               & norm2(s - [res%sx(cx(i), cy(i)), res%sy(cx(i), cy(i))]))
         end do
         found%slip = found%slip/max(smax, dq*norm2([res%cksi, res%ceta]), mu*maxval(p(:, 3))/r, tiny(smax))
         found%worst = found%worst/max(mu*maxval(p(:, 3)), tiny(mu))
         target = 0.0_wp
         do k = 1, spec%force
            target(k) = merge(spec%kinematics%fx, spec%kinematics%fy, k == 1)*mu*fn/area
            found%forces = max(found%forces, abs(sum(p(:, k)) - target(k))/max(sum_g, tiny(sum_g)))
         end do
         if (bounds > 0.0_wp) found%friction = sqrt(total/bounds)
         found%totals = max(abs(area*sum(res%px) - res%fx), abs(area*sum(res%py) - res%fy))/max(mu*fn, tiny(fn))
      end associate

   contains

      !> Tangential displacements due to all tractions of this time step
      subroutine add_displacements(kernel, factor)
         type(kernel_table), intent(in) :: kernel
         real(wp), intent(in) :: factor
         integer :: a, b, kx, ky
         real(wp) :: ua, va

         do a = 1, n
            ua = 0.0_wp
            va = 0.0_wp
            do b = 1, n
               kx = cx(a) - cx(b)
               ky = cy(a) - cy(b)
               ua = ua + kernel%xx(kx, ky)*p(b, 1) + kernel%xy(kx, ky)*p(b, 2)
               va = va + kernel%xy(kx, ky)*p(b, 1) + kernel%yy(kx, ky)*p(b, 2)
               if (.not. coupled) cycle
               ua = ua + kernel%xn(kx, ky)*p(b, 3)
               va = va + kernel%yn(kx, ky)*p(b, 3)
            end do
            w(a, :) = w(a, :) + factor*[ua, va]
         end do
      end subroutine add_displacements

      !> Displacements of the same particles at the previous time step, on its window
      subroutine subtract_previous()
         integer :: a, jx, jy, kx, ky, mx_old, my_old
         real(wp) :: shift_x, shift_y, q(3)

         shift_x = 0.0_wp
         shift_y = 0.0_wp
         if (spec%motion == motion%transient_rolling) then
            shift_x = dq*cos(spec%rolling%chi)
            shift_y = dq*sin(spec%rolling%chi)
         end if
         associate (past => run%before)
            mx_old = nint((run%result%grid%xl - past%grid%xl)/past%grid%dx)
            my_old = nint((run%result%grid%yl - past%grid%yl)/past%grid%dy)
            call fill_shifted_table(old, material, past%grid%dx, past%grid%dy, mx + past%grid%mx + abs(mx_old), &
               & my + past%grid%my + abs(my_old), shift_x, shift_y)
            do jy = 1, past%grid%my
               do jx = 1, past%grid%mx
                  if (past%division(jx, jy) == element%exterior) cycle
                  q = [past%px(jx, jy), past%py(jx, jy), past%pn(jx, jy)]
                  do a = 1, n
                     kx = cx(a) + mx_old - jx
                     ky = cy(a) + my_old - jy
                     w(a, 1) = w(a, 1) - old%xx(kx, ky)*q(1) - old%xy(kx, ky)*q(2)
                     w(a, 2) = w(a, 2) - old%xy(kx, ky)*q(1) - old%yy(kx, ky)*q(2)
                     if (.not. coupled) cycle
                     w(a, 1) = w(a, 1) - old%xn(kx, ky)*q(3)
                     w(a, 2) = w(a, 2) - old%yn(kx, ky)*q(3)
                  end do
               end do
            end do
         end associate
      end subroutine subtract_previous
   end subroutine examine

   !> One line of the table
   subroutine write_row(run, name, found)
      type(hard_run), intent(in) :: run
      character(len=*), intent(in) :: name
      type(findings), intent(in) :: found
      character(len=24) :: normal, counts(5)
      character(len=:), allocatable :: method

      if (table == 0) return
      if (allocated(run%error)) then
         write(table, "(a)") "| " // name // " | | | | | | | | | refused: " // run%error%message // " |"
         flush(table)
         return
      end if
      associate (res => run%result, n => run%result%normal, t => run%result%tangential)
         write(normal, "(i0, a, i0, a, es8.1)") n%iterations, " / ", n%products, " / ", max(0.0_wp, n%residual)
         method = trim(t%method)
         if (method == "") method = "-"
         if (t%gave_up /= "") method = trim(t%gave_up) // ", then " // method
         write(counts(1), "(i0, a, i0)") res%ncon, " | ", res%nadh
         write(counts(2), "(i0)") t%iterations
         write(counts(3), "(i0)") t%products
         write(counts(4), "(es8.1)") max(0.0_wp, t%residual)
         write(counts(5), "(es8.1)") max(found%friction, found%gap, found%penetration)
         write(table, "(a)") "| " // name // " | " // trim(counts(1)) // " | " // trim(normal) // " | " // method // " | " // &
            & trim(counts(2)) // " | " // trim(counts(3)) // " | " // trim(adjustl(counts(4))) // " | " // &
            & trim(adjustl(counts(5))) // " | " // endings(n, t, res%status%is_solved()) // " |"
         flush(table)
      end associate
   end subroutine write_row

   !> Outcome of both problems
   function endings(normal, tangential, is_solved) result(text)
      type(solve_report), intent(in) :: normal, tangential
      !> Is the case solved? If not, although both problems converged, the outer iteration did not
      logical, intent(in) :: is_solved
      character(len=:), allocatable :: text

      if (normal%succeeded() .and. tangential%succeeded()) then
         text = "converged"
         if (.not. is_solved) text = "outer iteration at its limit"
         return
      end if
      text = ""
      if (.not. normal%succeeded()) text = "normal: " // ended_text(normal)
      if (.not. tangential%succeeded()) then
         if (len(text) > 0) text = text // ", "
         text = text // "friction: " // ended_text(tangential)
      end if
   end function endings

   function ended_text(report) result(text)
      type(solve_report), intent(in) :: report
      character(len=:), allocatable :: text
      character(len=10) :: residual

      select case (report%ended)
      case (ending%not_started)
         text = "not started"
      case (ending%converged)
         text = "converged"
      case (ending%iteration_limit)
         text = "iteration limit"
      case (ending%stagnated)
         text = "stagnated"
      case default
         text = "diverged"
      end select
      if (report%succeeded()) return
      write(residual, "(es8.1)") report%residual
      text = text // " at " // trim(adjustl(residual))
   end function ended_text

   !> Numbers in (0, 1), the same on every machine (Lehmer, modulus 2**31 - 1)
   subroutine random_numbers(seed, values)
      integer, intent(inout) :: seed
      real(wp), intent(out) :: values(:)
      integer, parameter :: long = selected_int_kind(15)
      integer(long), parameter :: modulus = 2147483647_long, multiplier = 48271_long
      integer :: i

      do i = 1, size(values)
         seed = int(mod(multiplier*seed, modulus))
         values(i) = real(seed, wp)/real(modulus, wp)
      end do
   end subroutine random_numbers
end module hard_case
