!> Where the elements of a grid are, as far as the input tells
module contact_input_grid_frame
   use contact_base_kinds, only : wp
   use contact_cases_geometry, only : strip_rows
   use contact_cases_spec, only : grid_spec
   implicit none (type, external)
   private

   public :: grid_frame, frame_of

   !> Where the elements are, as far as the input tells
   type :: grid_frame
      !> False when the Hertz solution is needed first, or when the values make no grid
      logical :: is_known = .false.
      !> Number of elements
      integer :: mx = 0, my = 0
      !> Sides of the elements and centre of the first one [mm]; when known
      real(wp) :: dx = 0.0_wp, dy = 0.0_wp, xc1 = 0.0_wp, yc1 = 0.0_wp
   end type grid_frame

contains

   !> Sides of the elements and centre of the first one, where the input alone tells them
   pure type(grid_frame) function frame_of(grid) result(frame)
      type(grid_spec), intent(in) :: grid
      integer :: rows

      frame%mx = grid%mx
      frame%my = grid%my
      if (grid%mx < 1 .or. grid%my < 1) return
      select case (grid%form)
      case (1)
         frame%dx = grid%dx
         frame%dy = grid%dy
         frame%xc1 = grid%xl + 0.5_wp*grid%dx
         frame%yc1 = grid%yl + 0.5_wp*grid%dy
      case (2)
         frame%dx = (grid%xh - grid%xl)/grid%mx
         frame%dy = (grid%yh - grid%yl)/grid%my
         frame%xc1 = grid%xl + 0.5_wp*frame%dx
         frame%yc1 = grid%yl + 0.5_wp*frame%dy
      case (3)
         frame%dx = grid%dx
         frame%dy = grid%dy
         frame%xc1 = grid%xc1
         frame%yc1 = grid%yc1
      case (4)
         frame%dx = (grid%xcm - grid%xc1)/max(1, grid%mx - 1)
         frame%dy = (grid%ycm - grid%yc1)/max(1, grid%my - 1)
         frame%xc1 = grid%xc1
         frame%yc1 = grid%yc1
      case (-3)
         frame%dx = 2.0_wp*grid%scale*grid%aa/grid%mx
         frame%dy = 2.0_wp*grid%scale*grid%bb/grid%my
         frame%xc1 = -0.5_wp*(grid%mx - 1)*frame%dx
         frame%yc1 = -0.5_wp*(grid%my - 1)*frame%dy
      case (-5)
         rows = strip_rows(grid%my, grid%scale)
         frame%dx = 2.0_wp*grid%scale*grid%aa/grid%mx
         frame%dy = 2.0_wp*grid%bb/rows
         frame%xc1 = -0.5_wp*(grid%mx - 1)*frame%dx
         frame%yc1 = -0.5_wp*(grid%my - 1)*frame%dy
      end select
      frame%is_known = frame%dx > 0.0_wp .and. frame%dy > 0.0_wp
   end function frame_of
end module contact_input_grid_frame
