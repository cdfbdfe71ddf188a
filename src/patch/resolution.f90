!> Number of elements across the contact area
!>
!> The contact area consists of whole elements. If it has few of them, area, force and pressure are uncertain, however accurately
!> the equations are solved.
module contact_patch_resolution
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: enough_elements, elements_across, min_across, is_coarse, enough_sides

   !> Contact with fewer elements across is regarded as coarse: compared with Hertz's theory, force and area deviate by some ten per
   !> cent
   integer, parameter :: enough_elements = 5
   !> Recommended number of elements across
   integer, parameter :: advised = 10
   !> Directions of a grid with fewer elements represent plane strain
   integer, parameter :: has_direction = 3

contains

   !> Maximum number of elements in contact in a row along x, and in a column along y; 0 without contact, and where the grid
   !> represents plane strain
   pure function elements_across(division) result(across)
      !> Element states, shape (mx, my)
      integer, intent(in) :: division(:, :)
      integer :: across(2)
      integer :: ix, iy

      across = 0
      do iy = 1, size(division, 2)
         across(1) = max(across(1), count(division(:, iy) > element%exterior))
      end do
      do ix = 1, size(division, 1)
         across(2) = max(across(2), count(division(ix, :) > element%exterior))
      end do
      where (shape(division) < has_direction) across = 0
   end function elements_across

   !> Number of elements across in the narrower direction
   pure integer function min_across(division) result(least)
      !> Element states, shape (mx, my)
      integer, intent(in) :: division(:, :)
      integer :: across(2)

      across = elements_across(division)
      least = minval(across, mask=across > 0)
      if (all(across == 0)) least = 0
   end function min_across

   !> Is contact narrower than `enough_elements`?
   pure logical function is_coarse(result)
      !> Solved
      type(patch_result), intent(in) :: result
      integer :: least

      is_coarse = .false.
      if (result%ncon == 0) return
      ! contact with this number of elements cannot be narrow
      if (result%ncon >= enough_elements*max(result%grid%mx, result%grid%my)) return
      least = min_across(result%division)
      is_coarse = least > 0 .and. least < enough_elements
   end function is_coarse

   !> Sides of elements that give about ten elements across, with two digits; the present side in a direction that has enough of
   !> them
   pure function enough_sides(result) result(sides)
      !> Extent of the contact area, and the grid
      type(patch_result), intent(in) :: result
      !> Sides [mm]
      real(wp) :: sides(2)
      integer :: across(2), k
      real(wp) :: unit

      sides = [result%grid%dx, result%grid%dy]
      across = elements_across(result%division)
      do k = 1, 2
         if (across(k) == 0 .or. across(k) >= enough_elements) cycle
         sides(k) = sides(k)*across(k)/advised
         unit = 10.0_wp**(floor(log10(sides(k))) - 1)
         sides(k) = anint(sides(k)/unit)*unit
      end do
   end function enough_sides
end module contact_patch_resolution
