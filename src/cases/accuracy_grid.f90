!> Grids for a requested accuracy: numbers of elements along both sides of the potential contact, of the first grid and of the next
!> ones
module contact_cases_accuracy_grid
   use contact_base_choices, only : grid_form
   use contact_base_kinds, only : wp
   use contact_cases_accuracy_plan, only : finer_across, shorten_aspect, sides_of_window
   use contact_cases_spec, only : grid_spec
   use contact_grid_element_division, only : bounding_box, contact_box
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: across_contact, first_counts, is_cut_off, is_worth, level_grid, next_counts, no_direction, set_elements, stay_below

   !> A grid and its solver tolerance
   type :: level_grid
      !> Numbers of elements along x and y, and sides of the potential contact [mm], 0 if these follow from Hertz's solution
      integer :: counts(2) = 0
      real(wp) :: lengths(2) = 0.0_wp
      !> Tolerance of the solvers [-]
      real(wp) :: eps = 0.0_wp
   end type level_grid

   !> Number of elements of a side that represents plane strain, and is not refined
   integer, parameter :: no_direction = 2
   !> Minimum ratio of the number of elements to that of the previous grid; otherwise a new grid is not worth its cost
   real(wp), parameter :: worth = 1.1_wp

contains

   !> Numbers of elements along both sides of the first grid
   pure subroutine first_counts(grid, across, contact, lengths, counts)
      !> Grid of the case
      type(grid_spec), intent(in) :: grid
      !> Requested number of elements across the contact
      real(wp), intent(in) :: across
      !> Expected sides of the contact [mm]
      real(wp), intent(in) :: contact(2)
      !> Sides of the potential contact [mm], 0 if not yet known
      real(wp), intent(out) :: lengths(2)
      !> Numbers of elements along x and y
      integer, intent(out) :: counts(2)
      real(wp) :: sides(2)

      lengths = sides_of_window(grid)
      if (maxval(lengths) > 0.0_wp) then
         call shorten_aspect(contact, across, sides)
         counts = ceiling(lengths/sides)
      else
         counts = ceiling(across*max(1.0_wp, grid%scale))
      end if
   end subroutine first_counts

   !> Numbers of elements of the next grid, from the size of the contact area
   pure subroutine next_counts(size, present, contact, estimated, order, required, fixed, counts)
      !> Sides of the present elements [mm]
      real(wp), intent(in) :: size(2)
      !> Their numbers along x and y
      integer, intent(in) :: present(2)
      !> Number of elements across the contact, along x and y
      real(wp), intent(in) :: contact(2)
      !> Estimated error of the present grid, negative for none [-]
      real(wp), intent(in) :: estimated
      !> Order of the error
      real(wp), intent(in) :: order
      !> Accuracy for which it is designed [-]
      real(wp), intent(in) :: required
      !> Numbers of elements that must not change, 0 for others
      integer, intent(in) :: fixed(2)
      !> Numbers of elements along x and y
      integer, intent(out) :: counts(2)
      real(wp) :: across(2), sides(2)

      counts = fixed
      if (all(fixed > 0)) return
      across = contact
      if (any(fixed > 0)) across = maxval(across, mask=fixed == 0)
      call shorten_aspect(across*size, finer_across(minval(across), estimated, required, order), sides)
      ! a direction with many elements keeps its number
      sides = min(sides, size)
      counts = ceiling(present*size/sides)
      where (fixed > 0) counts = fixed
   end subroutine next_counts

   !> Number of elements across the contact area of a solution, along x and y; those of the whole grid without contact
   pure function across_contact(result) result(across)
      !> Solution
      type(patch_result), intent(in) :: result
      !> Numbers of elements
      real(wp) :: across(2)
      type(bounding_box) :: box

      across = real([result%grid%mx, result%grid%my], wp)
      if (result%ncon == 0) return
      box = contact_box(result%division)
      across = real([box%ix1 - box%ix0 + 1, box%iy1 - box%iy0 + 1], wp)
   end function across_contact

   !> Does the potential contact area cut off so much of the contact that the finest grid cannot reach the accuracy?
   !>
   !> The estimate is the force of the elements at the border, which is proportional to their size.
   pure logical function is_cut_off(result, required, most, fixed)
      !> Solution with estimated errors
      type(patch_result), intent(in) :: result
      !> Accuracy, and maximum number of elements [-]
      real(wp), intent(in) :: required, most
      !> Numbers of elements that must not change, 0 for others
      integer, intent(in) :: fixed(2)
      real(wp) :: finest

      is_cut_off = .false.
      if (.not. allocated(result%errors)) return
      finest = result%grid%npot()/most
      if (all(fixed == 0)) finest = sqrt(finest)
      is_cut_off = finest*result%errors%window > required
   end function is_cut_off

   !> Reduce the numbers of elements if there are more than allowed
   pure subroutine stay_below(most, fixed, counts)
      !> Maximum total number of elements
      real(wp), intent(in) :: most
      !> Numbers of elements that must not change, 0 for others
      integer, intent(in) :: fixed(2)
      !> Numbers of elements along x and y
      integer, intent(inout) :: counts(2)
      real(wp) :: ratio

      ratio = most/(real(counts(1), wp)*real(counts(2), wp))
      if (ratio >= 1.0_wp) return
      if (all(fixed == 0)) ratio = sqrt(ratio)
      where (fixed == 0) counts = max(1, int(ratio*counts))
   end subroutine stay_below

   !> Does the next grid have sufficiently more elements?
   pure logical function is_worth(counts, next)
      !> Numbers of elements of both grids
      integer, intent(in) :: counts(2), next(2)

      is_worth = real(next(1), wp)*next(2) >= worth*real(counts(1), wp)*counts(2)
   end function is_worth

   !> Set the numbers of elements of a grid in the same potential contact
   pure subroutine set_elements(grid, counts, lengths)
      !> Grid of the case
      type(grid_spec), intent(inout) :: grid
      !> Numbers of elements along x and y
      integer, intent(in) :: counts(2)
      !> Sides of the potential contact [mm]; not used if it follows from Hertz's solution
      real(wp), intent(in) :: lengths(2)
      real(wp) :: corner(2), sides(2)

      sides = lengths/counts
      select case (grid%form)
      case (grid_form%corner_and_sides)
         grid%dx = sides(1)
         grid%dy = sides(2)
      case (grid_form%centre_and_sides)
         corner = [grid%xc1 - 0.5_wp*grid%dx, grid%yc1 - 0.5_wp*grid%dy]
         grid%dx = sides(1)
         grid%dy = sides(2)
         grid%xc1 = corner(1) + 0.5_wp*sides(1)
         grid%yc1 = corner(2) + 0.5_wp*sides(2)
      case (grid_form%centres)
         corner = 0.5_wp*[grid%xc1 + grid%xcm - lengths(1), grid%yc1 + grid%ycm - lengths(2)]
         grid%xc1 = corner(1) + 0.5_wp*sides(1)
         grid%yc1 = corner(2) + 0.5_wp*sides(2)
         grid%xcm = grid%xc1 + (counts(1) - 1)*sides(1)
         grid%ycm = grid%yc1 + (counts(2) - 1)*sides(2)
      end select
      grid%mx = counts(1)
      grid%my = counts(2)
   end subroutine set_elements

end module contact_cases_accuracy_grid
