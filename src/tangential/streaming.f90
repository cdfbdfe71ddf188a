!> Data structure of Gauss-Seidel methods: rows, ordered from the trailing to the leading edge
!>
!> Columns are numbered 1..mx from the trailing to the leading side, for either rolling direction: for rolling towards
!> decreasing x all arrays are mirrored and x-components change sign, so that both directions use the same computation. Column 0
!> is an exterior column behind the window; it contains the increment -p(1) of an element at the trailing edge.
!>
!> The slip of a row due to the loads of all rows is a convolution (`row_convolution`). Changes within the row are added
!> directly to the remaining elements. This gives the iterates of the classical methods at a cost per sweep of O(mx my (mx +
!> my)) instead of O(mx**2 my**2).
module contact_tangential_streaming
   use contact_base_kinds, only : wp
   use contact_elastic_halfspace, only : kernel_table
   use contact_elastic_compliance, only : compliance
   use contact_grid_element_division, only : element
   use contact_tangential_element_problem, only : element_compliance, relax_element, solve_element, solve_yielding_element
   use contact_tangential_problem, only : at_bound, tangential_problem
   use contact_tangential_row_convolution, only : row_convolution
   use contact_tangential_yield, only : yield_data, yield_point
   implicit none (type, external)
   private

   public :: streaming_rows, loads

   type :: load_list
      !> Displacements due to the tractions themselves: A, or A - A' of a shifted table
      integer :: tractions = 0
      !> A - A' for a shift by one element: A applied to differences with the next upstream element
      integer :: increments = 1
   end type load_list
   !> Quantity to which the kernel is applied
   type(load_list), parameter :: loads = load_list()

   !> A tangential problem with all creepages known, in streaming order
   type :: streaming_rows
      integer :: mx = 0, my = 0
      !> Member of loads
      integer :: load = 0
      !> First and last column in contact per row; first > last if there is none
      integer, allocatable :: first(:), last(:)
      !> Number of elements in contact
      integer :: n_contact = 0
      !> Element states, shape (0:mx + 1, my)
      integer, allocatable :: state(:, :)
      !> Traction bound [N/mm2], shape (mx, my)
      real(wp), allocatable :: bound(:, :)
      !> Rigid slip per step [mm], shape (mx, 2, my)
      real(wp), allocatable :: shift(:, :, :)
      !> Tractions [N/mm2], shape (0:mx + 1, 2, my)
      real(wp), allocatable :: p(:, :, :)
      !> Increments p(i) - p(i + 1) [N/mm2], shape (0:mx, 2, my); used with loads%increments
      real(wp), allocatable :: dp(:, :, :)
      !> Coefficients within a row, offset "receiving minus loaded", -mx:mx [mm/(N/mm2)]
      real(wp), allocatable :: near_xx(:), near_yy(:), near_xy(:)
      !> Rolling direction +1 or -1
      integer :: direction = 1
      !> Yield limits before the step, on the same columns; unallocated unless they have a slope
      type(yield_data), allocatable :: yield
      !> Number of columns to the upstream edge of contact, where the particle entered the contact during the step; 0 for
      !> particles in contact throughout, shape (mx, my); unallocated: 0 everywhere
      integer, allocatable :: edge(:, :)
      !> Coefficients for all row distances, shape (-mx:mx, 1 - my:my - 1); only for elements with an edge
      real(wp), allocatable, private :: all_xx(:, :), all_yy(:, :), all_xy(:, :)
      !> Current yield limits [N/mm2] and plastic displacements [mm], shape (mx + 1, my)
      real(wp), allocatable :: limit(:, :), plastic(:, :)
      !> Is the limit before the step that of the next upstream element?
      logical :: steady = .false.
      !> Displacements of a row due to all loads
      type(row_convolution), private :: convolution
   contains
      !> Set up kernels, geometry and bounds
      procedure :: prepare
      !> Free the plans
      procedure :: release
      !> Set the rigid slip and the tractions for given creepages
      procedure :: start
      !> Update the loads of a row after a change
      procedure :: renew_row
      !> Slip of a row due to the loads of all rows [mm]
      procedure :: row_slip
      !> Compliance of an element whose landing element is some columns downstream
      procedure :: landing_compliance
      !> Compliance of an element on itself
      procedure :: own_compliance
      !> Compliance, and slip, of an element whose particle entered the contact during the step
      procedure :: entered_compliance
      procedure :: entered_slip
      !> Did the particle of an element enter the contact during the step?
      procedure :: entered
      !> New traction and state of an element
      procedure :: solve_one
      !> Largest traction of an adhering element
      procedure :: largest
      !> Tractions in window order
      procedure :: get_tractions
      !> Slip of all rows in window order
      procedure :: get_slip
      !> Number of full products equivalent to all row products so far
      procedure :: products
   end type streaming_rows

contains

   subroutine prepare(self, problem, operator, shifted)
      class(streaming_rows), intent(inout) :: self
      !> Window, rolling direction and elements in contact
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window; its table of coefficients is used
      class(compliance), intent(in) :: operator
      !> Coefficients of the same particles at the previous time step, if it is not one element
      type(kernel_table), intent(in), optional :: shifted
      integer :: ix, iy, jx, mx, my

      mx = problem%mx
      my = problem%my
      self%mx = mx
      self%my = my
      self%direction = problem%direction
      self%load = loads%tractions
      if (problem%steady .and. .not. present(shifted)) self%load = loads%increments
      self%steady = problem%steady
      call reshape_rows(self, mx, my)
      if (allocated(self%yield)) deallocate(self%yield, self%limit, self%plastic)
      if (problem%hardens()) then
         self%yield = problem%yield
         allocate(self%limit(mx + 1, my), self%plastic(mx + 1, my))
         if (self%direction < 0) self%yield%limit = problem%yield%limit(mx:1:-1, :)
      end if
      do iy = 1, my
         self%first(iy) = mx + 1
         self%last(iy) = 0
         do ix = 1, mx
            jx = window_column(self, ix)
            self%state(ix, iy) = element%exterior
            self%bound(ix, iy) = 0.0_wp
            if (.not. problem%contact(jx, iy)) cycle
            self%state(ix, iy) = element%adhesion
            self%bound(ix, iy) = problem%bound(jx, iy)
            self%first(iy) = min(self%first(iy), ix)
            self%last(iy) = ix
         end do
      end do
      self%n_contact = count(self%state /= element%exterior)

      call self%convolution%prepare(operator%table, mx, my, self%direction, shifted)
      self%near_xx = operator%table%xx(-mx:mx, 0)
      self%near_yy = operator%table%yy(-mx:mx, 0)
      self%near_xy = operator%table%xy(-mx:mx, 0)
      if (allocated(self%edge)) deallocate(self%edge, self%all_xx, self%all_yy, self%all_xy)
      if (allocated(problem%edge)) then
         self%edge = problem%edge
         if (self%direction < 0) self%edge = problem%edge(mx:1:-1, :)
         allocate(self%all_xx(-mx:mx, 1 - my:my - 1), self%all_yy(-mx:mx, 1 - my:my - 1), self%all_xy(-mx:mx, 1 - my:my - 1))
         self%all_xx = operator%table%xx(-mx:mx, 1 - my:my - 1)
         self%all_yy = operator%table%yy(-mx:mx, 1 - my:my - 1)
         self%all_xy = operator%table%xy(-mx:mx, 1 - my:my - 1)
      end if
      if (.not. present(shifted)) return
      self%near_xx = self%near_xx - shifted%xx(-mx:mx, 0)
      self%near_yy = self%near_yy - shifted%yy(-mx:mx, 0)
      self%near_xy = self%near_xy - shifted%xy(-mx:mx, 0)
      if (self%direction < 0) then
         self%near_xx = self%near_xx(mx:-mx:-1)
         self%near_yy = self%near_yy(mx:-mx:-1)
         self%near_xy = -self%near_xy(mx:-mx:-1)
      end if
   end subroutine prepare

   subroutine release(self)
      class(streaming_rows), intent(inout) :: self
      call self%convolution%release()
   end subroutine release

   !> Column of the window for a column in streaming order
   elemental integer function window_column(self, ix) result(jx)
      type(streaming_rows), intent(in) :: self
      integer, intent(in) :: ix
      jx = merge(ix, self%mx + 1 - ix, self%direction > 0)
   end function window_column

   subroutine reshape_rows(self, mx, my)
      class(streaming_rows), intent(inout) :: self
      integer, intent(in) :: mx, my

      if (allocated(self%bound)) then
         if (any(shape(self%bound) /= [mx, my])) deallocate(self%bound, self%first, self%last, &
            & self%state, self%shift, self%p, self%dp, self%near_xx, self%near_yy, self%near_xy)
      end if
      if (.not. allocated(self%bound)) allocate(self%bound(mx, my), self%first(my), self%last(my), &
         & self%state(0:mx + 1, my), self%shift(mx, 2, my), self%p(0:mx + 1, 2, my), &
         & self%dp(0:mx, 2, my), self%near_xx(-mx:mx), self%near_yy(-mx:mx), self%near_xy(-mx:mx))
      self%state = element%exterior
      self%p = 0.0_wp
      self%dp = 0.0_wp
   end subroutine reshape_rows

   !> Set rigid slip (including creepages) and tractions, given in window order
   subroutine start(self, problem, creep, p)
      class(streaming_rows), intent(inout) :: self
      !> Rigid slip and the effect of creepages
      type(tangential_problem), intent(in) :: problem
      !> Creepages [-]; the first n_forces are used
      real(wp), intent(in) :: creep(2)
      !> Estimate of the tractions [N/mm2], shape (mx, my, 2), admissible
      real(wp), intent(in) :: p(:, :, :)
      integer :: ix, iy, jx, k
      real(wp) :: sign_, extra, share

      do iy = 1, self%my
         do k = 1, 2
            sign_ = merge(real(self%direction, wp), 1.0_wp, k == 1)
            extra = 0.0_wp
            if (k <= problem%n_forces) extra = problem%dq*creep(k)
            do ix = 1, self%mx
               jx = window_column(self, ix)
               share = 1.0_wp
               if (allocated(problem%share)) share = problem%share(jx, iy)
               self%shift(ix, k, iy) = sign_*(problem%shift(jx, iy, k) + share*extra)
               self%p(ix, k, iy) = 0.0_wp
               if (self%state(ix, iy) /= element%exterior) self%p(ix, k, iy) = sign_*p(jx, iy, k)
            end do
            self%dp(0:self%mx, k, iy) = self%p(0:self%mx, k, iy) - self%p(1:self%mx + 1, k, iy)
         end do
         do ix = self%first(iy), self%last(iy)
            if (self%state(ix, iy) == element%exterior) cycle
            self%state(ix, iy) = element%adhesion
            if (hypot(self%p(ix, 1, iy), self%p(ix, 2, iy)) >= at_bound*self%bound(ix, iy)) &
               & self%state(ix, iy) = element%slip
         end do
         call self%renew_row(iy)
      end do
      if (.not. allocated(self%yield)) return
      self%plastic = 0.0_wp
      self%limit(:self%mx, :) = self%yield%limit
      self%limit(self%mx + 1, :) = self%yield%limit(self%mx, :)
      if (.not. self%steady) return
      do iy = 1, self%my
         call follow_limits(self, iy, self%mx)
      end do
   end subroutine start

   !> Update the yield limits from a column downstream, in steady rolling
   subroutine follow_limits(self, iy, from)
      class(streaming_rows), intent(inout) :: self
      integer, intent(in) :: iy, from
      real(wp) :: limit
      integer :: k

      do k = from, 1, -1
         limit = self%limit(k + 1, iy)
         select case (self%state(k, iy))
         case (element%slip)
            if (self%yield%slope > 0.0_wp) limit = max(limit, self%bound(k, iy))
         case (element%plastic)
            limit = max(self%yield%lowest, limit + self%yield%slope*self%plastic(k, iy))
            if (self%yield%slope > 0.0_wp) limit = max(self%limit(k + 1, iy), min(limit, self%bound(k, iy)))
         end select
         self%limit(k, iy) = limit
      end do
   end subroutine follow_limits

   !> Solve an element problem; sets the state of the element and relaxes the traction
   subroutine solve_one(self, i, iy, c, s0, omegah, omegas, p)
      class(streaming_rows), intent(inout) :: self
      !> Position in the row, in streaming order, and row index
      integer, intent(in) :: i, iy
      !> Coefficients of the element on itself
      type(element_compliance), intent(in) :: c
      !> Slip without the element's own traction [mm]
      real(wp), intent(in) :: s0(2)
      !> Relaxation in adhesion and in slip [-]
      real(wp), intent(in) :: omegah, omegas
      !> New traction [N/mm2]
      real(wp), intent(out) :: p(2)
      type(yield_point) :: point
      real(wp) :: before, old(2)

      ! a copy, because its position in the row is not contiguous and a compiler temporary would use the heap
      old = self%p(i, :, iy)
      if (.not. allocated(self%yield)) then
         call solve_element(c, s0, self%bound(i, iy), p, self%state(i, iy))
         call relax_element(old, self%bound(i, iy), omegah, omegas, self%state(i, iy), p)
         return
      end if
      if (self%steady) then
         before = self%limit(i + 1, iy)
      else
         before = self%yield%limit(i, iy)
      end if
      call solve_yielding_element(c, s0, self%bound(i, iy), before, self%yield%slope, self%yield%lowest, p, point)
      self%state(i, iy) = point%state
      self%plastic(i, iy) = point%plastic
      self%limit(i, iy) = point%limit
      if (point%state /= element%plastic) call relax_element(old, self%largest(i, iy), omegah, omegas, &
         & point%state, p)
      if (self%steady) call follow_limits(self, iy, i - 1)
   end subroutine solve_one

   pure real(wp) function largest(self, i, iy)
      class(streaming_rows), intent(in) :: self
      !> Position in the row, in streaming order, and row index
      integer, intent(in) :: i, iy
      largest = self%bound(i, iy)
      if (allocated(self%yield)) largest = min(largest, self%limit(i, iy))
   end function largest

   !> Update the loads of a row after a change
   subroutine renew_row(self, iy)
      class(streaming_rows), intent(inout) :: self
      !> Row
      integer, intent(in) :: iy
      logical :: loaded

      loaded = self%first(iy) <= self%last(iy)
      if (self%load == loads%increments) then
         call self%convolution%set_row(iy, self%dp(:, :, iy), loaded)
      else
         call self%convolution%set_row(iy, self%p(0:self%mx, :, iy), loaded)
      end if
   end subroutine renew_row

   !> Slip of a row due to the loads of all rows
   subroutine row_slip(self, iy, slip)
      class(streaming_rows), intent(inout) :: self
      !> Row
      integer, intent(in) :: iy
      !> Slip per step [mm], shape (mx, 2)
      real(wp), intent(out) :: slip(:, :)

      call self%convolution%displace(iy, slip)
      slip = self%shift(:, :, iy) + slip
   end subroutine row_slip

   pure function landing_compliance(self, distance) result(c)
      class(streaming_rows), intent(in) :: self
      !> Number of columns between the element and the one where its change of traction ends, at least 1
      integer, intent(in) :: distance
      type(element_compliance) :: c
      c%xx = self%near_xx(0) - self%near_xx(distance)
      c%yy = self%near_yy(0) - self%near_yy(distance)
      c%xy = 0.0_wp
   end function landing_compliance

   pure function own_compliance(self) result(c)
      class(streaming_rows), intent(in) :: self
      type(element_compliance) :: c

      if (self%load == loads%increments) then
         c = self%landing_compliance(1)
      else
         c%xx = self%near_xx(0)
         c%yy = self%near_yy(0)
         c%xy = self%near_xy(0)
      end if
   end function own_compliance

   pure logical function entered(self, i, iy)
      class(streaming_rows), intent(in) :: self
      !> Column and row
      integer, intent(in) :: i, iy

      entered = .false.
      if (allocated(self%edge)) entered = self%edge(i, iy) > 0
   end function entered

   !> The edge, to which the displacement refers, moves with the traction too
   pure function entered_compliance(self, i, iy) result(c)
      class(streaming_rows), intent(in) :: self
      !> Column and row
      integer, intent(in) :: i, iy
      type(element_compliance) :: c

      c%xx = self%all_xx(0, 0) - self%all_xx(self%edge(i, iy), 0)
      c%yy = self%all_yy(0, 0) - self%all_yy(self%edge(i, iy), 0)
      c%xy = 0.0_wp
   end function entered_compliance

   !> Slip due to all current tractions, summed directly, as there are few such elements
   pure function entered_slip(self, i, iy) result(slip)
      class(streaming_rows), intent(in) :: self
      !> Column and row
      integer, intent(in) :: i, iy
      !> Slip per step [mm]
      real(wp) :: slip(2)
      real(wp) :: xx, yy, xy
      integer :: j, l, edge

      slip = self%shift(i, :, iy)
      edge = i + self%edge(i, iy)
      do l = 1, self%my
         do j = self%first(l), self%last(l)
            xx = self%all_xx(i - j, iy - l) - self%all_xx(edge - j, iy - l)
            yy = self%all_yy(i - j, iy - l) - self%all_yy(edge - j, iy - l)
            xy = self%all_xy(i - j, iy - l) - self%all_xy(edge - j, iy - l)
            slip(1) = slip(1) + xx*self%p(j, 1, l) + xy*self%p(j, 2, l)
            slip(2) = slip(2) + xy*self%p(j, 1, l) + yy*self%p(j, 2, l)
         end do
      end do
   end function entered_slip

   pure subroutine get_tractions(self, p)
      class(streaming_rows), intent(in) :: self
      !> Tractions [N/mm2], shape (mx, my, 2)
      real(wp), intent(inout) :: p(:, :, :)
      integer :: ix, iy, jx

      do iy = 1, self%my
         do ix = 1, self%mx
            jx = window_column(self, ix)
            p(jx, iy, 1) = self%direction*self%p(ix, 1, iy)
            p(jx, iy, 2) = self%p(ix, 2, iy)
         end do
      end do
   end subroutine get_tractions

   subroutine get_slip(self, slip)
      class(streaming_rows), intent(inout) :: self
      !> Slip per step [mm], shape (mx, my, 2)
      real(wp), intent(inout) :: slip(:, :, :)
      real(wp) :: row(self%mx, 2)
      integer :: ix, iy, jx

      do iy = 1, self%my
         call self%row_slip(iy, row)
         do ix = 1, self%mx
            jx = window_column(self, ix)
            if (self%entered(ix, iy)) row(ix, :) = self%entered_slip(ix, iy)
            slip(jx, iy, 1) = self%direction*row(ix, 1)
            slip(jx, iy, 2) = row(ix, 2)
         end do
      end do
   end subroutine get_slip

   pure integer function products(self)
      class(streaming_rows), intent(in) :: self
      products = nint(real(self%convolution%rows, wp)/max(1, count(self%first <= self%last)))
   end function products
end module contact_tangential_streaming
