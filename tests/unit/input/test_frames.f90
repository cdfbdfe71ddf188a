!> Elements predicted from the input alone are those of the computation
program test_frames
   use contact_base_choices, only : normal_control
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_geometry, only : build_grid, solve_hertz, strip_rows
   use contact_cases_spec, only : grid_spec
   use contact_grid_potential_contact, only : potential_contact
   use contact_cases_continuation, only : frame_of, is_known
   use contact_patch_result, only : hertz_result
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("frames")
   call all_options(suite)
   call rows_of_strips(suite)
   call suite%finish()

contains

   subroutine all_options(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: sizes(2, 6) = reshape([44, 22, 13, 11, 1, 7, 9, 1, 4, 4, 24, 12], [2, 6])
      real(wp), parameter :: scales(4) = [0.8_wp, 1.2_wp, 2.0_wp, 20.0_wp]
      type(grid_spec) :: spec
      type(hertz_result), allocatable :: hertz
      type(potential_contact) :: frame, grid
      type(error_type), allocatable :: error
      character(len=60) :: what
      integer :: option, k, j

      do option = -6, 4
         if (option == 0) cycle
         do k = 1, size(sizes, 2)
            do j = 1, size(scales)
               spec = grid_spec(form=option, mx=sizes(1, k), my=sizes(2, k), a1=0.8e-3_wp, b1=0.28e-3_wp, aob=0.5_wp, &
                  & aa=6.0_wp, bb=12.0_wp, bneg=2.0_wp, bpos=3.0_wp, scale=scales(j), xl=-1.1_wp, yl=-2.3_wp, dx=0.3_wp, &
                  & dy=0.7_wp, xh=5.1_wp, yh=4.9_wp, xc1=-3.3_wp, yc1=-2.9_wp, xcm=4.1_wp, ycm=3.7_wp)
               if (option == 4 .and. any(sizes(:, k) == 1)) cycle
               if (allocated(hertz)) deallocate(hertz)
               if (option < 0 .and. option > -6) then
                  call solve_hertz(spec, normal_control%force, 1.0e5_wp, 0.0_wp, 82000.0_wp, 0.28_wp, hertz, error)
                  call suite%check(.not. allocated(error), "Hertz")
               end if
               call build_grid(spec, hertz, grid, error)
               call suite%check(.not. allocated(error), "grid")
               frame = frame_of(spec)
               write(what, "(a, i0, 2(a, i0), a, f5.1)") "IPOTCN = ", option, ", ", spec%mx, " x ", spec%my, &
                  & ", SCALE = ", spec%scale
               call suite%equal(frame%mx, grid%mx, trim(what) // ": MX")
               call suite%equal(frame%my, grid%my, trim(what) // ": MY")
               call suite%check(is_known(frame) .eqv. any(option == [1, 2, 3, 4, -3, -5, -6]), trim(what) // ": known")
               if (.not. is_known(frame)) cycle
               call suite%close_to([frame%dx, frame%dy], [grid%dx, grid%dy], 1.0e-13_wp, trim(what) // ": sides")
               call suite%close_to([frame%x(1), frame%y(1)], [grid%x(1), grid%y(1)], 1.0e-12_wp, trim(what) // ": first centre")
            end do
         end do
      end do
      frame = frame_of(grid_spec(form=1, mx=0, my=5, dx=0.1_wp, dy=0.1_wp))
      call suite%check(.not. is_known(frame), "no columns")
      frame = frame_of(grid_spec(form=1, mx=5, my=5, dx=0.1_wp, dy=0.0_wp))
      call suite%check(.not. is_known(frame), "flat elements")
      frame = frame_of(grid_spec(form=2, mx=5, my=5, xl=1.0_wp, xh=0.0_wp, yl=0.0_wp, yh=1.0_wp))
      call suite%check(.not. is_known(frame), "corners that are exchanged")
   end subroutine all_options

   !> Rows inside a strip: at least one, as many free rows below as above, and SCALE as nearly as that allows
   subroutine rows_of_strips(suite)
      type(test_suite), intent(inout) :: suite
      integer :: my, k, rows
      real(wp) :: scale

      do my = 1, 40
         do k = 1, 60
            scale = 0.1_wp*k
            rows = strip_rows(my, scale)
            if (scale <= 1.0_wp) then
               call suite%equal(rows, my, "all rows are inside")
            else
               call suite%check(rows >= 1 .and. rows <= my, "rows of the window")
               call suite%equal(mod(my - rows, 2), 0, "the same on both sides")
               call suite%check(rows - my/scale <= 2.0_wp .and. my/scale - rows <= 0.5_wp, "near to SCALE")
            end if
         end do
      end do
   end subroutine rows_of_strips
end program test_frames
