!> Errors of forces by few rows of elements: the same contact with narrower rows
!>
!> Contacts of wheels are often long along the track and a few elements wide. Few rows are not coarsened, so that the coarse level
!> does not show their error, which is most of the error. Instead of a bound it is computed: with rows of a third or, of more than
!> two, of a half, and columns as they are or, of many, as on the coarse level and with rows of a third. See doc/theory/errors.md.
module contact_patch_finer_rows
   use contact_base_choices, only : estimate_choice, motion, sensitivity_choice
   use contact_base_constants, only : excluded_threshold
   use contact_base_error, only : error_kind, error_type
   use contact_base_kinds, only : wp
   use contact_friction_law, only : friction_driver
   use contact_grid_element_division, only : bounding_box, contact_box, element, widest_strip
   use contact_patch_between_rows, only : between, cubic_weights, parts
   use contact_patch_error_estimate, only : coarse_level, moment_power
   use contact_patch_error_scales, only : rows_error
   use contact_patch_problem, only : carried, memory_field, patch_problem, patch_state, traction_fields
   use contact_patch_result, only : patch_result
   use contact_patch_solve, only : solve_patch
   implicit none (type, external)
   private

   public :: find_errors_of_rows

   !> Rows in contact that are too few for a coarser level, see contact_patch_coarse_level; rows of the grid needed for cubics
   integer, parameter :: few_rows = 5, fewest_rows = 4
   !> Columns in contact from which on those of the coarse level are used, of which nine are left. Errors of these columns
   !> scatter, so they count less, see rows_error; with 18 more of them were too large. Chosen
   integer, parameter :: many_columns = 27
   !> Finer rows for one row: of contacts of up to `fewer_rows` rows, and on the columns of the coarse level; of others, where the
   !> solution costs most. Chosen; on the columns of the coarse level rows of a half gave errors 1.2 times as large (seeds 21, 411)
   integer, parameter :: fewer_rows = 2, split_of_fewer = 3, split_of_more = 2
   !> Ratio of an error to its difference from that with finer rows: for errors of second order, with rows of a third. Rows of a
   !> half change forces by as much: 0.94 times for three rows, 1.04 for five, in the median of 124 patches of wheels of any
   !> profiles by the second order (seeds 411 and 52201)
   real(wp), parameter :: usual_share = 9.0_wp/8.0_wp
   !> Columns beside the contact that are included; chosen. Finer rows there reach to the centre of the next original row, which is
   !> not in contact
   integer, parameter :: beside = 1
   !> Smallest tolerance; a third of it remains in the forces, less than the errors of few rows. That of pressures, which change
   !> forces less at the same normal force, relative to it. Chosen
   real(wp), parameter :: rows_eps = 2.0e-4_wp, pressures_eps = 2.5_wp

contains

   !> Solve with finer rows, and compare at equal normal forces
   subroutine find_errors_of_rows(problem, state, level, result, column, line, finer, errors, error)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem
      !> Its solution
      type(patch_state), intent(in) :: state
      !> Its coarse level, solved
      type(coarse_level), intent(in) :: level
      !> Solution
      type(patch_result), intent(in) :: result
      !> Column in which the distance is known at `parts` points per element
      integer, intent(in) :: column
      !> These distances [mm]; without points those of the elements are interpolated
      real(wp), intent(in) :: line(:)
      !> Work space
      type(coarse_level), intent(inout) :: finer
      !> Errors by the width of the rows [N, N mm]
      type(rows_error), intent(out) :: errors
      !> Allocated if the time limit is exceeded
      type(error_type), allocatable, intent(out) :: error
      type(bounding_box) :: box
      !> Rows in contact of the widest strip; finer rows for an original one
      integer :: rows, split
      logical :: on_level, possible

      if (.not. is_simple(problem) .or. result%ncon == 0) return
      box = contact_box(result%division)
      rows = widest_strip(result%division)
      if (rows > few_rows .or. problem%grid%my < fewest_rows) return
      on_level = box%ix1 - box%ix0 + 1 >= many_columns .and. level%problem%grid%my == problem%grid%my
      if (on_level) then
         box = contact_box(level%result%division)
         split = split_of_fewer
         call refine_rows(level%problem, level%state%now, box, split, correction(problem, column, line), finer, possible)
      else
         split = merge(split_of_fewer, split_of_more, rows <= fewer_rows)
         call refine_rows(problem, state%now, box, split, correction(problem, column, line), finer, possible)
      end if
      if (.not. possible) return
      finer%problem%fn = result%fn
      finer%problem%settings%eps = max(problem%settings%eps, rows_eps)
      finer%state%creep = [result%cksi, result%ceta]
      call solve_patch(finer%problem, finer%state, finer%workspace, finer%log, finer%result, error)
      if (allocated(error)) then
         if (error%kind == error_kind%time) return
         deallocate(error)
         return
      end if
      if (.not. finer%result%status%has_result() .or. finer%result%ncon == 0 .or. .not. finer%result%has_finite_totals()) return
      errors%known = .true.
      errors%scatters = on_level
      if (on_level) then
         errors%value = usual_share*difference(level%result, finer%result)
      else
         errors%value = usual_share*difference(result, finer%result)
      end if
   end subroutine find_errors_of_rows

   !> Is it a contact on half-spaces whose elements have no properties of their own?
   pure logical function is_simple(problem)
      type(patch_problem), intent(in) :: problem

      is_simple = problem%motion == motion%steady_rolling .and. problem%solves_for_pressure() .and. problem%model%is_flat() &
         & .and. .not. (allocated(problem%given_pressure) .or. allocated(problem%extra_slip) &
         & .or. allocated(problem%static_mu) .or. allocated(problem%simplified) .or. allocated(problem%model%tabulated))
      if (is_simple .and. allocated(problem%friction)) is_simple = .not. (problem%friction%varies_by_row() &
         & .or. problem%friction%driver() == friction_driver%temperature)
   end function is_simple

   !> Distance between the rows less that interpolated from the rows, at all points of a column [mm]
   pure function correction(problem, column, line) result(change)
      type(patch_problem), intent(in) :: problem
      !> See find_errors_of_rows
      integer, intent(in) :: column
      real(wp), intent(in) :: line(:)
      real(wp) :: change(parts*problem%grid%my), h(problem%grid%my)
      integer :: i

      change = 0.0_wp
      if (size(line) /= size(change)) return
      h = problem%h(column, :)
      do i = 1, size(change)
         if (line(i) < excluded_threshold) change(i) = line(i) - between(h, i)
      end do
   end function correction

   !> The problem with finer rows in and beside the contact, and its estimate
   subroutine refine_rows(coarse, old, box, split, change, finer, possible)
      !> Problem and solution with the original rows
      type(patch_problem), intent(in) :: coarse
      type(traction_fields), intent(in) :: old
      !> Its contact
      type(bounding_box), intent(in) :: box
      !> Number of finer rows for an original one
      integer, intent(in) :: split
      !> See correction
      real(wp), intent(in) :: change(:)
      type(coarse_level), intent(inout) :: finer
      !> Is the distance known everywhere?
      logical, intent(out) :: possible
      !> Positions of the finer rows, in original ones, the first at 1
      real(wp) :: at(split*(box%iy1 - box%iy0 + 3)), weight(4), point
      integer :: first, last, columns(2), i, k

      first = max(1, split*(box%iy0 - 2) + 2)
      last = min(split*coarse%grid%my, split*(box%iy1 + 1) - 1)
      columns = [max(1, box%ix0 - beside), min(coarse%grid%mx, box%ix1 + beside)]
      possible = all(coarse%h(columns(1):columns(2), max(1, box%iy0 - 2):min(coarse%grid%my, box%iy1 + 2)) < excluded_threshold)
      if (.not. possible) return
      finer%problem = coarse
      associate (problem => finer%problem, grid => finer%problem%grid)
         grid%my = last - first + 1
         grid%dy = coarse%grid%dy/split
         grid%yl = coarse%grid%yl + (first - 1)*grid%dy
         grid%mx = columns(2) - columns(1) + 1
         grid%xl = coarse%grid%xl + (columns(1) - 1)*coarse%grid%dx
         deallocate(problem%h)
         allocate(problem%h(grid%mx, grid%my))
         do i = 1, grid%my
            at(i) = 0.5_wp + (first + i - 1.5_wp)/split
            call cubic_weights(at(i), coarse%grid%my, k, weight)
            point = 0.5_wp + (at(i) - 0.5_wp)*parts
            problem%h(:, i) = matmul(coarse%h(columns(1):columns(2), k - 1:k + 2), weight) + value_at(change, point)
         end do
         if (allocated(problem%parts)) then
            problem%parts%label = coarse%parts%label(columns(1):columns(2), nint(at(:grid%my)))
         end if
         problem%force_prescribed = .true.
         if (allocated(problem%pressure_estimate)) deallocate(problem%pressure_estimate)
         if (allocated(problem%damping)) deallocate(problem%damping)
         ! temperatures do not act on forces here
         if (allocated(problem%thermal)) deallocate(problem%thermal)
         problem%estimate = estimate_choice%unchanged
         problem%sensitivity = sensitivity_choice%none
         problem%want_exterior = .false.
         ! forces and moment do not need them
         problem%defers_displacements = .true.
         problem%pressure_eps = pressures_eps
         ! tractions are estimated relative to the pressures
         problem%follows_approach = .true.
         problem%shares_table = .true.
      end associate
      call estimate_tractions(coarse, old, columns(1), at(:finer%problem%grid%my), finer)
   end subroutine refine_rows

   !> Value at a position between the points of a line, linear
   pure real(wp) function value_at(line, at) result(value)
      real(wp), intent(in) :: line(:)
      !> Position, the first point at 1; inside the line
      real(wp), intent(in) :: at
      integer :: k

      k = min(int(at), size(line) - 1)
      value = line(k) + (at - k)*(line(k + 1) - line(k))
   end function value_at

   !> Estimate of pressures and tractions on the finer rows
   subroutine estimate_tractions(coarse, old, first, at, finer)
      !> Problem and solution with the original rows
      type(patch_problem), intent(in) :: coarse
      type(traction_fields), intent(in) :: old
      !> First column of the finer grid
      integer, intent(in) :: first
      !> Positions of its rows, see refine_rows
      real(wp), intent(in) :: at(:)
      !> Its problem is complete; the state is set
      type(coarse_level), intent(inout) :: finer
      real(wp) :: p(coarse%grid%my), t(coarse%grid%my, 2), fine_p(size(at)), fine_t(size(at), 2), modulus, bend
      integer :: ix, k, kind

      associate (now => finer%state%now, grid => finer%problem%grid)
         now%grid = grid
         if (allocated(now%pn)) then
            if (any(shape(now%pn) /= [grid%mx, grid%my])) deallocate(now%pn, now%px, now%py, now%division)
         end if
         if (.not. allocated(now%pn)) allocate(now%pn(grid%mx, grid%my), now%px(grid%mx, grid%my), now%py(grid%mx, grid%my), &
            & now%division(grid%mx, grid%my))
         now%division = element%exterior
         do kind = 1, carried%count
            now%memory(kind) = memory_field()
         end do
         modulus = coarse%model%material%gg/(1.0_wp - coarse%model%material%nu)
         do ix = 1, grid%mx
            p = old%pn(first + ix - 1, :)
            t(:, 1) = old%px(first + ix - 1, :)
            t(:, 2) = old%py(first + ix - 1, :)
            k = min(max(maxloc(p, 1), 2), coarse%grid%my - 1)
            bend = sum(coarse%h(first + ix - 1, k - 1:k + 1)*[1.0_wp, -2.0_wp, 1.0_wp])
            call estimate_column(p, t, modulus*bend/coarse%grid%dy, at, fine_p, fine_t)
            now%pn(ix, :) = fine_p
            now%px(ix, :) = fine_t(:, 1)
            now%py(ix, :) = fine_t(:, 2)
         end do
      end associate
      finer%state%started = .true.
      finer%state%is_steady = .true.
      finer%state%before = finer%state%now
   end subroutine estimate_tractions

   !> Pressures and tractions of a column on the finer rows; the load per length is kept
   !>
   !> By Hertz's theory the square of the pressure is a parabola across the contact. Its curvature is that of three rows or, of
   !> fewer, that of a long contact.
   pure subroutine estimate_column(p, t, steepness, at, fine_p, fine_t)
      !> Pressures [N/mm2] and tangential tractions [N/mm2], shape (:, 2), of the original rows
      real(wp), intent(in) :: p(:), t(:, :)
      !> Curvature of the distance, times width of a row and modulus [N/mm2]
      real(wp), intent(in) :: steepness
      !> Positions of the finer rows, see refine_rows
      real(wp), intent(in) :: at(:)
      !> The same for these rows
      real(wp), intent(out) :: fine_p(:), fine_t(:, :)
      !> Squares of the pressures, without pressure on both sides; ratios of tractions to pressures
      real(wp) :: q(0:size(p) + 1), ratio(0:size(p) + 1, 2), slope, bend, d, load, fine_load
      integer :: i, k, side

      fine_p = 0.0_wp
      fine_t = 0.0_wp
      load = sum(p)
      if (.not. load > 0.0_wp) return
      q = 0.0_wp
      q(1:size(p)) = p**2
      ratio = 0.0_wp
      do k = 1, size(p)
         if (p(k) > 0.0_wp) ratio(k, :) = t(k, :)/p(k)
      end do
      do i = 1, size(at)
         k = nint(at(i))
         if (.not. q(k) > 0.0_wp) k = merge(k + 1, k - 1, q(k + 1) > q(k - 1))
         if (.not. q(k) > 0.0_wp) cycle
         d = at(i) - k
         call find_parabola(q, k, -0.5_wp*steepness**2, slope, bend)
         fine_p(i) = sqrt(max(0.0_wp, q(k) + slope*d + 0.5_wp*bend*d**2))
         side = k + merge(1, -1, d > 0.0_wp)
         fine_t(i, :) = ratio(k, :)
         if (q(side) > 0.0_wp) fine_t(i, :) = fine_t(i, :) + abs(d)*(ratio(side, :) - ratio(k, :))
      end do
      fine_load = sum(fine_p)
      if (fine_load > 0.0_wp) fine_p = fine_p*(load/(fine_load*(at(2) - at(1))))
      fine_t(:, 1) = fine_t(:, 1)*fine_p
      fine_t(:, 2) = fine_t(:, 2)*fine_p
   end subroutine estimate_column

   !> Parabola through the squared pressure of a row and those of its neighbours in contact
   pure subroutine find_parabola(q, k, usual, slope, bend)
      !> Squared pressures of the rows, with one without pressure on each side
      real(wp), intent(in) :: q(0:)
      !> Row with pressure
      integer, intent(in) :: k
      !> Second difference where it is not known from three rows
      real(wp), intent(in) :: usual
      !> Derivative at the row, and second derivative
      real(wp), intent(out) :: slope, bend
      logical :: before, behind

      before = q(k - 1) > 0.0_wp
      behind = q(k + 1) > 0.0_wp
      bend = usual
      slope = 0.0_wp
      if (before .and. behind) then
         bend = q(k + 1) - 2.0_wp*q(k) + q(k - 1)
         slope = 0.5_wp*(q(k + 1) - q(k - 1))
      else if (before) then
         if (q(max(0, k - 2)) > 0.0_wp) bend = q(k) - 2.0_wp*q(k - 1) + q(k - 2)
         if (bend >= 0.0_wp) bend = usual
         slope = q(k) - q(k - 1) + 0.5_wp*bend
      else if (behind) then
         if (q(min(size(q) - 1, k + 2)) > 0.0_wp) bend = q(k) - 2.0_wp*q(k + 1) + q(k + 2)
         if (bend >= 0.0_wp) bend = usual
         slope = q(k + 1) - q(k) - 0.5_wp*bend
      end if
   end subroutine find_parabola

   !> Difference of FX, FY and MZ, at the normal force of the second solution
   pure function difference(coarse, fine) result(change)
      type(patch_result), intent(in) :: coarse, fine
      real(wp) :: change(3), load

      load = fine%fn/coarse%fn
      change = [coarse%fx*load, coarse%fy*load, coarse%mz*load**moment_power] - [fine%fx, fine%fy, fine%mz]
   end function difference
end module contact_patch_finer_rows
