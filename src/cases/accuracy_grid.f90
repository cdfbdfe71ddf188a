!> The grids of an accuracy that was asked for: elements along both sides of the window, of the first grid and of the next ones
module contact_cases_accuracy_grid
   use contact_base_accuracy_report, only : accuracy_report
   use contact_base_choices, only : grid_form
   use contact_base_kinds, only : wp
   use contact_cases_accuracy_plan, only : finer_across, shorten_aspect
   use contact_cases_spec, only : grid_spec
   use contact_grid_element_division, only : bounding_box, contact_box
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: first_counts, is_worth, level_grid, next_counts, set_elements, sides_of_window, stay_below

   !> A grid, and what cases are solved with on it
   type :: level_grid
      !> Elements along x and y, and sides of the window [mm], 0 where these follow from Hertz's solution
      integer :: counts(2) = 0
      real(wp) :: lengths(2) = 0.0_wp
      !> Tolerance of the solvers
      real(wp) :: eps = 0.0_wp
   end type level_grid

   !> Part of a given window, along each side, that contact takes before anything is known of it
   real(wp), parameter :: usual_share = 0.75_wp
   !> A grid that has less than this factor more elements than the one before brings nothing
   real(wp), parameter :: worth = 1.3_wp

contains

   !> Sides of a window that is given; 0 where it follows from Hertz's solution
   pure function sides_of_window(grid) result(lengths)
      !> As the case describes it
      type(grid_spec), intent(in) :: grid
      !> [mm]
      real(wp) :: lengths(2)

      lengths = 0.0_wp
      select case (grid%form)
      case (grid_form%corner_and_sides, grid_form%centre_and_sides)
         lengths = [grid%mx*grid%dx, grid%my*grid%dy]
      case (grid_form%corners)
         lengths = [grid%xh - grid%xl, grid%yh - grid%yl]
      case (grid_form%centres)
         lengths = [grid%mx*(grid%xcm - grid%xc1)/max(1, grid%mx - 1), grid%my*(grid%ycm - grid%yc1)/max(1, grid%my - 1)]
      end select
   end function sides_of_window

   !> Elements along both sides of the window of the first grid
   pure subroutine first_counts(grid, across, lengths, counts)
      !> As the case describes it
      type(grid_spec), intent(in) :: grid
      !> Elements across the contact
      real(wp), intent(in) :: across
      !> Sides of the window [mm], 0 where they are not known yet
      real(wp), intent(out) :: lengths(2)
      !> Elements along x and y
      integer, intent(out) :: counts(2)
      real(wp) :: sides(2)

      lengths = sides_of_window(grid)
      if (maxval(lengths) > 0.0_wp) then
         call shorten_aspect(usual_share*lengths, across, sides)
         counts = ceiling(lengths/sides)
      else
         counts = ceiling(across*max(1.0_wp, grid%scale))
      end if
   end subroutine first_counts

   !> Elements of the next grid, from where contact is
   pure subroutine next_counts(result, report, order, fixed, counts)
      !> Of the present grid
      type(patch_result), intent(in) :: result
      !> Its estimate, and what is asked
      type(accuracy_report), intent(in) :: report
      !> Of the error
      real(wp), intent(in) :: order
      !> Numbers that stay, 0 for others
      integer, intent(in) :: fixed(2)
      !> Elements along x and y
      integer, intent(out) :: counts(2)
      type(bounding_box) :: box
      real(wp) :: across(2), sides(2), size(2)

      across = real([result%grid%mx, result%grid%my], wp)
      size = [result%grid%dx, result%grid%dy]
      if (result%ncon > 0) then
         box = contact_box(result%division)
         across = real([box%ix1 - box%ix0 + 1, box%iy1 - box%iy0 + 1], wp)
      end if
      if (any(fixed > 0)) across = maxval(across, mask=fixed == 0)
      call shorten_aspect(across*size, finer_across(minval(across), report%estimated, report%asked, order), sides)
      ! a direction with many elements already keeps them
      sides = min(sides, size)
      counts = ceiling([result%grid%mx, result%grid%my]*size/sides)
      where (fixed > 0) counts = fixed
   end subroutine next_counts

   !> Fewer elements where there are more than allowed
   pure subroutine stay_below(most, fixed, counts)
      !> Allowed in all
      real(wp), intent(in) :: most
      !> Numbers that stay, 0 for others
      integer, intent(in) :: fixed(2)
      !> Elements along x and y
      integer, intent(inout) :: counts(2)
      real(wp) :: ratio

      ratio = most/(real(counts(1), wp)*real(counts(2), wp))
      if (ratio >= 1.0_wp) return
      if (all(fixed == 0)) ratio = sqrt(ratio)
      where (fixed == 0) counts = max(1, int(ratio*counts))
   end subroutine stay_below

   !> Has the next grid enough more elements?
   pure logical function is_worth(counts, next)
      !> Elements of both grids
      integer, intent(in) :: counts(2), next(2)

      is_worth = real(next(1), wp)*next(2) >= worth*real(counts(1), wp)*counts(2)
   end function is_worth

   !> The numbers of elements of a grid, in the same window
   pure subroutine set_elements(grid, counts, lengths)
      !> As the case describes it
      type(grid_spec), intent(inout) :: grid
      !> Elements along x and y
      integer, intent(in) :: counts(2)
      !> Sides of the window [mm]; not used where it follows from Hertz's solution
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
