!> Series of cases that continue one another, each with a requested accuracy
!>
!> The tractions of the previous case are defined on its elements. All cases of a series therefore have the same elements; if one of
!> them needs finer elements, the preceding ones are solved again. See doc/theory/accuracy.md.
module contact_cases_accuracy_series
   use contact_base_choices, only : motion, time_link
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_cases_accuracy_grid, only : level_grid, set_elements
   use contact_cases_accuracy_plan, only : sides_of_window
   use contact_cases_spec, only : case_spec, grid_spec
   implicit none (type, external)
   private

   public :: accuracy_series, has_history

   !> The cases of a series, as requested, and their common grid
   type :: accuracy_series
      !> Cases; the first `used` ones are in use
      type(case_spec), allocatable :: steps(:)
      integer :: used = 0
      !> Grid of the solution that the session holds; without elements if it holds none of this series
      type(level_grid) :: grid
      !> Estimated error of that solution, negative for none [-]
      real(wp) :: estimated = -1.0_wp
   contains
      !> Remove all cases
      procedure :: clear
      !> Add a solved case after those that it continues
      procedure :: take
      !> How a case continues the last one: a step repeated behind steady rolling continues from the steady tractions
      procedure :: link_of
      !> Number of preceding cases that a case continues
      procedure :: before
      !> Does the session hold the solution that a case continues, on this grid?
      procedure :: is_at
      !> Error of the previous case on this grid, as another sample of the error of this one
      procedure :: sample
      !> Refuse a case that cannot continue the series, with the reason
      procedure :: refuse
   end type accuracy_series

contains

   !> Does the solution depend on the previous case?
   pure logical function has_history(spec)
      type(case_spec), intent(in) :: spec

      has_history = any(spec%motion == [motion%shift, motion%transient_rolling]) .and. spec%link /= time_link%initiate
   end function has_history

   pure subroutine clear(self)
      class(accuracy_series), intent(inout) :: self

      self%used = 0
      self%grid%counts = 0
   end subroutine clear

   subroutine take(self, spec, grid, estimated)
      class(accuracy_series), intent(inout) :: self
      !> Case as requested
      type(case_spec), intent(in) :: spec
      !> Grid of the solution
      type(level_grid), intent(in) :: grid
      !> Its estimated error, negative for none [-]
      real(wp), intent(in) :: estimated
      type(case_spec), allocatable :: longer(:)
      integer :: k, link

      k = self%before(spec) + 1
      link = time_link%initiate
      if (has_history(spec)) link = self%link_of(spec)
      ! a repeated step replaces the previous one
      if (link == time_link%repeat_step) link = self%steps(k)%link
      if (.not. allocated(self%steps)) allocate(self%steps(8))
      if (k > size(self%steps)) then
         allocate(longer(2*k))
         longer(:k - 1) = self%steps
         call move_alloc(longer, self%steps)
      end if
      self%steps(k) = spec
      self%steps(k)%link = link
      self%used = k
      self%grid = grid
      self%estimated = estimated
   end subroutine take

   pure integer function link_of(self, spec) result(link)
      class(accuracy_series), intent(in) :: self
      type(case_spec), intent(in) :: spec

      link = spec%link
      if (link /= time_link%repeat_step .or. self%used == 0) return
      if (self%steps(self%used)%motion == motion%steady_rolling) link = time_link%continue_all
   end function link_of

   pure integer function before(self, spec)
      class(accuracy_series), intent(in) :: self
      type(case_spec), intent(in) :: spec

      before = 0
      if (.not. has_history(spec)) return
      before = self%used
      if (self%link_of(spec) == time_link%repeat_step) before = max(0, self%used - 1)
   end function before

   pure logical function is_at(self, spec, grid)
      class(accuracy_series), intent(in) :: self
      type(case_spec), intent(in) :: spec
      !> Grid of the next solution
      type(level_grid), intent(in) :: grid

      ! a repeated step starts from the same state as the previous one
      is_at = .not. has_history(spec) .or. (self%link_of(spec) /= time_link%repeat_step .and. all(self%grid%counts == grid%counts) &
         & .and. self%grid%eps <= grid%eps .and. all(is_same(self%grid%lengths, grid%lengths)))
   end function is_at

   pure real(wp) function sample(self, spec, grid) result(estimated)
      class(accuracy_series), intent(in) :: self
      !> Case that may continue the series
      type(case_spec), intent(in) :: spec
      !> Grid of its solution
      type(level_grid), intent(in) :: grid

      estimated = 0.0_wp
      if (has_history(spec) .and. self%is_at(spec, grid)) estimated = max(0.0_wp, self%estimated)
   end function sample

   subroutine refuse(self, spec, error)
      class(accuracy_series), intent(in) :: self
      type(case_spec), intent(in) :: spec
      !> Allocated if the case cannot continue the series
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: why

      if (.not. has_history(spec)) return
      why = ""
      if (.not. spec%grid%needs_geometry()) then
         why = "a window that follows from the load, in cases that continue one another: a corner and sides do"
      else if (self%used == 0) then
         why = "a case that continues one without an accuracy, or one without a solution"
      else if (.not. is_same_window(self%steps(1)%grid, spec%grid)) then
         why = "a window that moves from case to case"
      end if
      if (why /= "") call fatal_error(error, "an accuracy is required, but the grid cannot be chosen with " // why, &
         & error_kind%unsupported)
   end subroutine refuse

   !> Do two cases have the same potential contact?
   pure logical function is_same_window(first, other) result(same)
      type(grid_spec), intent(in) :: first, other
      type(grid_spec) :: a, b

      same = first%form == other%form .and. all(is_same(sides_of_window(first), sides_of_window(other)))
      if (.not. same) return
      a = first
      b = other
      call set_elements(a, [1, 1], sides_of_window(first))
      call set_elements(b, [1, 1], sides_of_window(first))
      same = all(is_same([a%xl, a%yl, a%xc1, a%yc1], [b%xl, b%yl, b%xc1, b%yc1]))
   end function is_same_window

   !> Are two numbers equal within round-off?
   elemental logical function is_same(a, b)
      real(wp), intent(in) :: a, b
      !> Relative difference; for sums and products of input values [-]
      real(wp), parameter :: slack = 1.0e-9_wp

      is_same = abs(a - b) <= slack*max(abs(a), abs(b))
   end function is_same
end module contact_cases_accuracy_series
