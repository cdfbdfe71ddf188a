!> Errors of forces by few rows of elements: the same contact with rows of a third of the width
!>
!> Contacts of wheels are often long along the track and a few elements wide. Few rows are not coarsened, so that the coarse level
!> does not show their error, which is most of the error. Instead of a bound it is computed: with rows of a third, and columns as
!> they are or, of many, as on the coarse level, where the problem has as many elements as the original one. See
!> doc/theory/errors.md.
module contact_patch_finer_rows
   use contact_base_choices, only : estimate_choice, motion, sensitivity_choice
   use contact_base_constants, only : excluded_threshold
   use contact_base_error, only : error_kind, error_type
   use contact_base_kinds, only : wp
   use contact_friction_law, only : friction_driver
   use contact_grid_element_division, only : bounding_box, contact_box, widest_strip
   use contact_patch_between_rows, only : between, parts
   use contact_patch_error_estimate, only : coarse_level, moment_power
   use contact_patch_error_scales, only : rows_error
   use contact_patch_finer_level, only : interpolate_fields
   use contact_patch_problem, only : patch_problem, patch_state
   use contact_patch_result, only : patch_result
   use contact_patch_solve, only : solve_patch
   implicit none (type, external)
   private

   public :: find_errors_of_rows

   !> Rows in contact that are too few for a coarser level, see contact_patch_coarse_level; rows of the grid needed for cubics
   integer, parameter :: few_rows = 5, fewest_rows = 4
   !> Columns in contact from which on those of the coarse level are used, of which nine are left, since with all columns the
   !> solution costs as much as the original one. Errors of these columns scatter, so they count less, see rows_error; with 18
   !> estimates add 13 instead of 22 % in nine of ten wheels of any profiles, but more of them are too large. Chosen
   integer, parameter :: many_columns = 27
   !> Rows and columns beside the contact that are included; chosen
   integer, parameter :: beside = 1
   !> Smallest tolerance; a third of it remains in the forces, less than the errors of few rows. Chosen
   real(wp), parameter :: rows_eps = 2.0e-4_wp
   !> Ratio of an error of second order to its difference from that with rows of a third
   real(wp), parameter :: second_order_share = real(parts**2, wp)/(parts**2 - 1)

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
      logical :: on_level, possible

      if (.not. is_simple(problem) .or. result%ncon == 0) return
      box = contact_box(result%division)
      if (widest_strip(result%division) > few_rows .or. problem%grid%my < fewest_rows) return
      on_level = box%ix1 - box%ix0 + 1 >= many_columns .and. level%problem%grid%my == problem%grid%my
      if (on_level) then
         call refine_rows(level%problem, level%state, contact_box(level%result%division), correction(problem, column, line), &
            & finer, possible)
      else
         call refine_rows(problem, state, box, correction(problem, column, line), finer, possible)
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
         errors%value = second_order_share*difference(level%result, finer%result)
      else
         errors%value = second_order_share*difference(result, finer%result)
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
   subroutine refine_rows(coarse, state, box, change, finer, possible)
      !> Problem and solution with the original rows
      type(patch_problem), intent(in) :: coarse
      type(patch_state), intent(in) :: state
      !> Its contact
      type(bounding_box), intent(in) :: box
      !> See correction
      real(wp), intent(in) :: change(:)
      type(coarse_level), intent(inout) :: finer
      !> Is the distance known everywhere?
      logical, intent(out) :: possible
      real(wp) :: h(coarse%grid%my)
      integer :: first, last, columns(2), ix, i

      first = max(1, box%iy0 - beside)
      last = min(coarse%grid%my, box%iy1 + beside)
      columns = [max(1, box%ix0 - beside), min(coarse%grid%mx, box%ix1 + beside)]
      possible = all(coarse%h(columns(1):columns(2), max(1, first - beside):min(coarse%grid%my, last + beside)) &
         & < excluded_threshold)
      if (.not. possible) return
      finer%problem = coarse
      associate (problem => finer%problem, grid => finer%problem%grid)
         grid%my = parts*(last - first + 1)
         grid%dy = coarse%grid%dy/parts
         grid%yl = coarse%grid%yl + (first - 1)*coarse%grid%dy
         grid%mx = columns(2) - columns(1) + 1
         grid%xl = coarse%grid%xl + (columns(1) - 1)*coarse%grid%dx
         deallocate(problem%h)
         allocate(problem%h(grid%mx, grid%my))
         do ix = 1, grid%mx
            h = coarse%h(columns(1) + ix - 1, :)
            do i = 1, grid%my
               problem%h(ix, i) = between(h, parts*(first - 1) + i) + change(parts*(first - 1) + i)
            end do
         end do
         if (allocated(problem%parts)) then
            problem%parts%label = coarse%parts%label(columns(1):columns(2), [(first + (i - 1)/parts, i=1, grid%my)])
         end if
         problem%force_prescribed = .true.
         if (allocated(problem%pressure_estimate)) deallocate(problem%pressure_estimate)
         if (allocated(problem%damping)) deallocate(problem%damping)
         ! temperatures do not act on forces here
         if (allocated(problem%thermal)) deallocate(problem%thermal)
         problem%estimate = estimate_choice%unchanged
         problem%sensitivity = sensitivity_choice%none
         problem%want_exterior = .false.
         problem%defers_displacements = .false.
         problem%pressure_eps = 1.0_wp
         problem%follows_approach = .false.
         problem%shares_table = .true.
      end associate
      finer%state = state
      call interpolate_fields(finer%problem%grid, finer%state%now)
      finer%state%before = finer%state%now
   end subroutine refine_rows

   !> Difference of FX, FY and MZ, at the normal force of the second solution
   pure function difference(coarse, fine) result(change)
      type(patch_result), intent(in) :: coarse, fine
      real(wp) :: change(3), load

      load = fine%fn/coarse%fn
      change = [coarse%fx*load, coarse%fy*load, coarse%mz*load**moment_power] - [fine%fx, fine%fy, fine%mz]
   end function difference
end module contact_patch_finer_rows
