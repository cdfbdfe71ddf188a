!> The same contact on elements three times as long: the coarse level for error estimates
!>
!> With a factor of three, the centre of a coarse element is the centre of a fine one. Undeformed distance, given pressures,
!> friction per row and all other data per element are therefore taken from the fine problem without interpolation. The coarse
!> problem costs about a ninth of the fine one.
module contact_patch_coarse_level
   use contact_base_choices, only : estimate_choice, motion, sensitivity_choice, solver_choice, time_link
   use contact_base_constants, only : excluded_distance, excluded_threshold
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : bounding_box, contact_box, element
   use contact_patch_problem, only : carried, patch_problem, patch_state, traction_fields
   use contact_patch_result, only : patch_result, reason_length
   use contact_patch_time_steps, only : link_time_steps
   implicit none (type, external)
   private

   public :: coarsen_patch, coarsening

   !> Number of fine elements on each side of the centre one, and ratio of the sides of coarse and fine elements
   integer, parameter :: beside = 1, coarsening = 2*beside + 1
   !> A contact of fewer elements across is not coarsened in that direction: fewer than two coarse elements would be left; chosen
   integer, parameter :: fewest_across = 6
   !> Tolerance of the coarse solution; its discretisation error exceeds 1e-4 on grids of less than a million elements
   real(wp), parameter :: coarse_eps = 3.0e-5_wp
   !> Steps whose relative difference to the length of an element is below this value are one element
   real(wp), parameter :: step_slack = 0.01_wp

   !> Coarse elements in one direction
   type :: coarse_axis
      !> Ratio of the sides: `coarsening`, or 1 where that is not possible
      integer :: factor = 1
      !> Fine element at the centre of the first coarse one, possibly outside the fine grid; number of coarse elements
      integer :: first = 1, count = 0
   contains
      !> Fine element at the centre of a coarse one
      procedure :: centre
   end type coarse_axis

contains

   elemental integer function centre(self, k) result(i)
      class(coarse_axis), intent(in) :: self
      !> Index of the coarse element
      integer, intent(in) :: k

      i = self%first + (k - 1)*self%factor
   end function centre

   !> Problem and estimate of the coarse level of a solved patch
   subroutine coarsen_patch(fine, state, link, result, coarse, coarse_state, reason)
      !> The problem that was solved
      type(patch_problem), intent(in) :: fine
      !> Its solution, and the previous time step
      type(patch_state), intent(in) :: state
      !> Relation to the previous case, member of time_link
      integer, intent(in) :: link
      !> Element states and creepages of the solution
      type(patch_result), intent(in) :: result
      !> The problem on coarse elements
      type(patch_problem), intent(inout) :: coarse
      !> On entry the state after the previous case; on exit the estimate from the mean tractions of the fine solution, and the
      !> previous time step of the coarse level
      type(patch_state), intent(inout) :: coarse_state
      !> Reason why there is no coarse level, blank-padded; blank if there is one
      character(len=reason_length), intent(out) :: reason
      type(bounding_box) :: box
      type(coarse_axis) :: x, y
      type(error_type), allocatable :: error
      logical :: continues

      reason = ""
      box = contact_box(result%division)
      if (result%ncon == 0) then
         reason = "there is no contact"
      else if (allocated(fine%model%tabulated)) then
         reason = "tabulated influence coefficients are valid for one size of elements"
      else if (fine%remembers_yield .and. fine%motion /= motion%steady_rolling) then
         reason = "plastic layers have a history in each element"
      else if (fine%motion == motion%transient_rolling .and. .not. fine%model%is_flat()) then
         reason = "steps of transient rolling on curved surfaces are one element long"
      end if
      if (reason /= "") return
      call choose_axis(fine%grid%mx, box%ix0, box%ix1, x)
      call choose_axis(fine%grid%my, box%iy0, box%iy1, y)
      continues = has_history(fine) .and. link /= time_link%initiate
      if (continues .and. coarse_state%started) then
         if (link == time_link%repeat_step .and. coarse_state%before%grid%mx > 0 .and. .not. coarse_state%is_steady) then
            call align_with_previous(fine, coarse_state%before, x, y)
         else
            call align_with_previous(fine, coarse_state%now, x, y)
         end if
      end if
      ! general steps need square coarsening: the step is the side of elements along the rolling direction
      if (fine%general_step .and. x%factor /= y%factor) then
         x = coarse_axis(1, 1, fine%grid%mx)
         y = coarse_axis(1, 1, fine%grid%my)
      end if
      if (x%factor*y%factor == 1) then
         reason = "contact is too few elements wide for a coarser level"
         return
      end if
      call coarsen_problem(fine, x, y, coarse)
      if (continues) then
         if (.not. coarse_state%started) then
            reason = "the coarser level has no history: request errors from the first case on"
            return
         end if
         call link_time_steps(coarse, link, coarse_state, error)
         if (allocated(error)) then
            reason = "the coarser level of the previous case does not fit this one"
            return
         end if
      else
         call coarsen_step(fine, state%before, x, y, coarse, coarse_state%before)
      end if
      call coarsen_step(fine, state%now, x, y, coarse, coarse_state%now)
      coarse_state%started = .true.
      coarse_state%creep = [result%cksi, result%ceta]
   end subroutine coarsen_patch

   !> Does the solution depend on the previous case?
   pure logical function has_history(problem)
      type(patch_problem), intent(in) :: problem

      has_history = problem%motion == motion%shift .or. problem%motion == motion%transient_rolling
   end function has_history

   !> Align coarse elements with those of the previous case, and include the contact area of that case
   pure subroutine align_with_previous(fine, former, x, y)
      !> The problem of the present case
      type(patch_problem), intent(in) :: fine
      !> Solution of the previous case on the coarse level
      type(traction_fields), intent(in) :: former
      type(coarse_axis), intent(inout) :: x, y
      type(bounding_box) :: box

      box = contact_box(former%division)
      call align_axis(nint((fine%grid%xl - former%grid%xl)/fine%grid%dx), box%ix0, box%ix1, x)
      call align_axis(nint((fine%grid%yl - former%grid%yl)/fine%grid%dy), box%iy0, box%iy1, y)
   end subroutine align_with_previous

   !> Alignment in one direction
   pure subroutine align_axis(shift, low, high, axis)
      !> Position of the first fine element relative to the start of the previous coarse grid, in fine elements
      integer, intent(in) :: shift
      !> First and last coarse element in contact in the previous case; high < low for none
      integer, intent(in) :: low, high
      type(coarse_axis), intent(inout) :: axis
      integer :: start, missing

      if (axis%factor == 1) return
      ! fine element at the centre of the first coarse element of the previous case
      start = 1 + beside - shift
      missing = modulo(axis%first - start, axis%factor)
      if (missing > 0) then
         axis%first = axis%first - missing
         axis%count = axis%count + 1
      end if
      if (high < low) return
      missing = max(0, (axis%first - start)/axis%factor - (low - 1))
      axis%first = axis%first - missing*axis%factor
      axis%count = axis%count + missing
      axis%count = max(axis%count, high - (axis%first - start)/axis%factor)
   end subroutine align_axis

   !> Coarse elements that cover the contact area, and one more at each end unless contact reaches the border
   pure subroutine choose_axis(n, low, high, axis)
      !> Number of fine elements; the first and the last one in contact
      integer, intent(in) :: n, low, high
      type(coarse_axis), intent(out) :: axis
      integer :: covered, across
      logical :: cut_low, cut_high

      across = high - low + 1
      cut_low = low == 1
      cut_high = high == n
      axis = coarse_axis(1, 1, n)
      if (across < fewest_across) return
      ! a grid that cuts off contact at both ends must keep its length
      if (cut_low .and. cut_high .and. mod(n, coarsening) /= 0) return
      axis%factor = coarsening
      axis%count = (across + coarsening - 1)/coarsening
      covered = axis%count*coarsening
      if (cut_low) then
         axis%first = 1
      else if (cut_high) then
         axis%first = n - covered + 1
      else
         axis%first = low - (covered - across)/2
      end if
      axis%first = axis%first + beside
      if (.not. cut_low) then
         axis%first = axis%first - coarsening
         axis%count = axis%count + 1
      end if
      if (.not. cut_high) axis%count = axis%count + 1
   end subroutine choose_axis

   !> The problem on the coarse elements
   subroutine coarsen_problem(fine, x, y, coarse)
      type(patch_problem), intent(in) :: fine
      type(coarse_axis), intent(in) :: x, y
      type(patch_problem), intent(inout) :: coarse
      integer :: column(x%count), row(y%count), i, k

      coarse = fine
      column = [(min(max(x%centre(i), 1), fine%grid%mx), i=1, x%count)]
      row = [(min(max(y%centre(i), 1), fine%grid%my), i=1, y%count)]
      associate (grid => coarse%grid)
         grid%mx = x%count
         grid%my = y%count
         grid%dx = x%factor*fine%grid%dx
         grid%dy = y%factor*fine%grid%dy
         grid%xl = fine%grid%x(x%first) - 0.5_wp*grid%dx
         grid%yl = fine%grid%y(y%first) - 0.5_wp*grid%dy
      end associate
      call coarsen_distance(fine, x, y, coarse%h)
      if (allocated(fine%given_pressure)) then
         coarse%given_pressure = fine%given_pressure(column, row)
         do i = 1, x%count
            if (x%centre(i) /= column(i)) coarse%given_pressure(i, :) = 0.0_wp
         end do
         do k = 1, y%count
            if (y%centre(k) /= row(k)) coarse%given_pressure(:, k) = 0.0_wp
         end do
      end if
      if (allocated(fine%parts)) coarse%parts%label = fine%parts%label(column, row)
      if (allocated(fine%extra_slip)) coarse%extra_slip = fine%extra_slip(column, row, :)
      if (allocated(fine%static_mu)) coarse%static_mu = fine%static_mu(row)
      if (allocated(fine%friction)) then
         if (fine%friction%varies_by_row()) coarse%friction%sets = fine%friction%sets(row)
      end if
      ! the mean pressures of the fine solution are a better estimate
      if (allocated(coarse%pressure_estimate)) deallocate(coarse%pressure_estimate)
      if (allocated(coarse%damping)) deallocate(coarse%damping)
      coarse%estimate = estimate_choice%unchanged
      coarse%sensitivity = sensitivity_choice%none
      coarse%want_exterior = .false.
      ! elastic energies of both levels are compared
      coarse%defers_displacements = .false.
      coarse%pressure_eps = 1.0_wp
      coarse%shares_table = .true.
      coarse%settings%eps = max(fine%settings%eps, coarse_eps)
      if (.not. fine%general_step) coarse%solver = solver_choice%default
      ! in steady rolling the step is one element; a time step is not changed
      if (fine%motion == motion%steady_rolling) then
         coarse%dq = x%factor*fine%dq
      else if (fine%corrects_leading_edge) then
         coarse%corrects_leading_edge = coarse%dq > (1.0_wp + step_slack)*coarse%grid%dx
      end if
   end subroutine coarsen_problem

   !> Undeformed distance at the centres of coarse elements; extrapolated by parabolas outside the fine grid
   pure subroutine coarsen_distance(fine, x, y, h)
      type(patch_problem), intent(in) :: fine
      type(coarse_axis), intent(in) :: x, y
      !> Undeformed distance [mm], shape (x%count, y%count)
      real(wp), allocatable, intent(inout) :: h(:, :)
      real(wp), allocatable :: lines(:, :)
      !> Are all coarse rows at rows of the fine grid? Beyond it they are extrapolated from its three outermost ones
      logical :: inside
      integer :: i, k

      if (allocated(h)) deallocate(h)
      allocate(h(x%count, y%count))
      inside = y%first >= 1 .and. y%centre(y%count) <= fine%grid%my
      if (.not. inside) then
         allocate(lines(x%count, fine%grid%my))
         do k = 1, fine%grid%my
            if (k > 3 .and. k < fine%grid%my - 2) cycle
            do i = 1, x%count
               lines(i, k) = value_at(fine%h(:, k), x%centre(i))
            end do
         end do
      end if
      do k = 1, y%count
         if (y%centre(k) >= 1 .and. y%centre(k) <= fine%grid%my) then
            do i = 1, x%count
               h(i, k) = value_at(fine%h(:, y%centre(k)), x%centre(i))
            end do
         else
            do i = 1, x%count
               h(i, k) = value_at(lines(i, :), y%centre(k))
            end do
         end if
      end do
   end subroutine coarsen_distance

   !> Value at a position of a line; beyond its ends extrapolated by the parabola through the last three values
   pure real(wp) function value_at(line, i) result(value)
      real(wp), intent(in) :: line(:)
      integer, intent(in) :: i
      integer :: n, distance
      real(wp) :: last(3)

      n = size(line)
      if (i >= 1 .and. i <= n) then
         value = line(i)
         return
      end if
      value = excluded_distance
      if (n < size(last)) return
      if (i < 1) then
         last = line(1:3)
         distance = 1 - i
      else
         last = line(n:n - 2:-1)
         distance = i - n
      end if
      if (any(last > excluded_threshold)) return
      value = last(1) + distance*(last(1) - last(2)) + 0.5_wp*distance*(distance + 1)*(last(1) - 2.0_wp*last(2) + last(3))
   end function value_at

   !> One time step: the force of a fine element is distributed over the coarse element that contains it
   subroutine coarsen_step(fine, step, x, y, coarse, mean)
      type(patch_problem), intent(in) :: fine
      type(traction_fields), intent(in) :: step
      type(coarse_axis), intent(in) :: x, y
      type(patch_problem), intent(in) :: coarse
      type(traction_fields), intent(inout) :: mean
      integer :: i, k, kind, i0, i1, k0, k1, ix, iy
      !> Part of a coarse element that a fine one covers; sums of the tractions
      real(wp) :: share, pn, px, py
      real(wp) :: fresh(coarse%grid%my)

      mean%grid = coarse%grid
      mean%pen = step%pen
      mean%is_solved = step%is_solved
      mean%force = step%force
      if (allocated(mean%pn)) deallocate(mean%pn, mean%px, mean%py, mean%division)
      allocate(mean%pn(x%count, y%count), mean%px(x%count, y%count), mean%py(x%count, y%count), source=0.0_wp)
      allocate(mean%division(x%count, y%count), source=element%exterior)
      do kind = 1, carried%count
         if (allocated(mean%memory(kind)%value)) deallocate(mean%memory(kind)%value)
         if (allocated(step%memory(kind)%value)) allocate(mean%memory(kind)%value(x%count, y%count))
      end do
      if (.not. allocated(step%pn)) return
      share = 1.0_wp/(x%factor*y%factor)
      do k = 1, y%count
         k0 = max(1, y%centre(k) - y%factor/2)
         k1 = min(fine%grid%my, y%centre(k) + y%factor/2)
         do i = 1, x%count
            i0 = max(1, x%centre(i) - x%factor/2)
            i1 = min(fine%grid%mx, x%centre(i) + x%factor/2)
            pn = 0.0_wp
            px = 0.0_wp
            py = 0.0_wp
            kind = element%exterior
            do iy = k0, k1
               do ix = i0, i1
                  pn = pn + step%pn(ix, iy)
                  px = px + step%px(ix, iy)
                  py = py + step%py(ix, iy)
                  kind = max(kind, step%division(ix, iy))
               end do
            end do
            mean%pn(i, k) = share*pn
            mean%px(i, k) = share*px
            mean%py(i, k) = share*py
            if (mean%pn(i, k) > 0.0_wp) mean%division(i, k) = kind
         end do
      end do
      do kind = 1, carried%count
         if (.not. allocated(step%memory(kind)%value)) cycle
         call coarse%fill_fresh(kind, fresh)
         do k = 1, y%count
            do i = 1, x%count
               mean%memory(kind)%value(i, k) = fresh(k)
               if (min(x%centre(i), y%centre(k)) < 1 .or. x%centre(i) > fine%grid%mx .or. y%centre(k) > fine%grid%my) cycle
               mean%memory(kind)%value(i, k) = step%memory(kind)%value(x%centre(i), y%centre(k))
            end do
         end do
      end do
   end subroutine coarsen_step
end module contact_patch_coarse_level
