!> Subsurface blocks of a case: sizes, empty selections, blocks that are too large
program test_blocks
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_cases_subsurface, only : subsurface_stresses
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_result, only : patch_result
   use contact_subsurface_points, only : point_block, point_selection
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("subsurface blocks")
   call run(suite)
   call suite%finish()

contains

   subroutine run(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec
      type(patch_result) :: result
      type(error_type), allocatable :: error
      integer :: i

      result%grid = potential_contact(mx=4, my=3, xl=-2.0_wp, yl=-1.5_wp, dx=1.0_wp, dy=1.0_wp)
      allocate(result%pn(4, 3), source=1.0_wp)
      allocate(result%px(4, 3), result%py(4, 3), source=0.0_wp)
      allocate(result%division(4, 3), source=1)
      result%ncon = 12
      call subsurface_stresses(spec, result, error)
      call suite%check(.not. allocated(error) .and. .not. allocated(result%subsurface), "no blocks: no results")

      allocate(spec%subsurface%blocks(2))
      spec%subsurface%blocks(1)%z = [0.5_wp, -1.0_wp]
      spec%subsurface%blocks(2)%selection = point_selection%lists
      spec%subsurface%blocks(2)%ix = [9]
      spec%subsurface%blocks(2)%iy = [1]
      spec%subsurface%blocks(2)%z = [1.0_wp]
      call subsurface_stresses(spec, result, error)
      call suite%check(.not. allocated(error), "two blocks")
      call suite%check(result%subsurface(1)%nx == 4 .and. result%subsurface(1)%ny == 3 &
         & .and. result%subsurface(1)%nz == 2, "size of the first")
      call suite%check(all(result%subsurface(1)%sigma1 >= result%subsurface(1)%sigma2) &
         & .and. all(result%subsurface(1)%sigma2 >= result%subsurface(1)%sigma3), "principal stresses descend")
      call suite%check(size(result%subsurface(2)%sigvm) == 0, "the second has no columns in the grid")

      spec%subsurface%blocks(2) = point_block(selection=point_selection%free)
      spec%subsurface%blocks(2)%x = [(real(i, wp), i = 1, 9999)]
      spec%subsurface%blocks(2)%y = spec%subsurface%blocks(2)%x
      spec%subsurface%blocks(2)%z = spec%subsurface%blocks(2)%x
      call subsurface_stresses(spec, result, error)
      call suite%check(allocated(error), "10**12 points are refused")
      if (allocated(error)) call suite%check(index(full_text(error), "subsurface block 2") > 0, "with the number of the block")
   end subroutine run
end program test_blocks
