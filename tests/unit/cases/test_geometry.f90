!> From the numbers of a case to Hertz data, grid and undeformed distance
program test_geometry
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use contact_base_choices, only : normal_control
   use contact_base_constants, only : excluded_distance
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_geometry, only : build_grid, part_labels, solve_hertz, undeformed_distance
   use contact_cases_spec, only : geometry_spec, grid_spec
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_result, only : hertz_result
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   real(wp), parameter :: closed = 100.0_wp*epsilon(1.0_wp)
   real(wp), parameter :: gg = 82000.0_wp, nu = 0.28_wp
   type(test_suite) :: suite

   call suite%start("geometry")
   call hertz_options(suite)
   call hertz_errors(suite)
   call given_windows(suite)
   call strips(suite)
   call forms(suite)
   call planforms(suite)
   call geometry_errors(suite)
   call suite%finish()

contains

   subroutine hertz_options(suite)
      type(test_suite), intent(inout) :: suite
      type(grid_spec) :: spec
      type(geometry_spec) :: shape
      type(hertz_result), allocatable :: hertz
      type(potential_contact) :: grid
      type(error_type), allocatable :: error
      real(wp), allocatable :: h(:, :)
      integer :: option

      spec = grid_spec(mx=44, my=22, a1=0.8e-3_wp, b1=0.2814e-3_wp, aob=0.5_wp, aa=6.0_wp, bb=12.0_wp, scale=1.1_wp)
      do option = -5, -1
         spec%form = option
         call solve_hertz(spec, normal_control%force, 106700.0_wp, 0.0_wp, gg, nu, hertz, error)
         call suite%check(.not. allocated(error) .and. allocated(hertz), "Hertz option is solved")
         call build_grid(spec, hertz, grid, error)
         call suite%check(.not. allocated(error), "grid of a Hertz option")
         call suite%close_to(44*grid%dx, 2.2_wp*hertz%aa, closed, "width of the window", relative=.true.)
         call suite%close_to([grid%xl + 22*grid%dx, grid%yl + 11*grid%dy], [0.0_wp, 0.0_wp], 1.0e-12_wp, "centred window")
         if (option >= -3) call suite%close_to(22*grid%dy, 2.2_wp*hertz%bb, closed, "height of the window", &
            & relative=.true.)
         ! IBASE of the case does not count
         shape%form = 9
         call undeformed_distance(shape, grid, hertz, h, error)
         call suite%check(.not. allocated(error), "distance of a Hertz option")
         call suite%close_to(h(3, 5), hertz%a1*grid%x(3)**2 + hertz%b1*grid%y(5)**2, closed, "Hertzian distance", &
            & relative=.true.)
      end do
      spec%form = -1
      call solve_hertz(spec, normal_control%approach, 0.0_wp, 0.0_wp, gg, nu, hertz, error)
      call build_grid(spec, hertz, grid, error)
      call suite%check(.not. allocated(error), "no contact has a grid")
      call suite%close_to(grid%dx, 1.1_wp*2.0e-9_wp/44, closed, "tiny elements")
      spec%form = -6
      spec%bneg = 3.0_wp
      spec%bpos = 5.0_wp
      call solve_hertz(spec, normal_control%force, 1.0_wp, 0.0_wp, gg, nu, hertz, error)
      call suite%check(.not. allocated(hertz) .and. .not. allocated(error), "SDEC has no Hertz solution")
      call build_grid(spec, hertz, grid, error)
      call suite%close_to([grid%xl, grid%yl], -1.1_wp*[6.0_wp, 4.0_wp], closed, "window of SDEC", relative=.true.)
   end subroutine hertz_options

   subroutine hertz_errors(suite)
      type(test_suite), intent(inout) :: suite
      type(grid_spec) :: good, bad
      type(hertz_result), allocatable :: hertz
      type(potential_contact) :: grid
      type(error_type), allocatable :: error

      good = grid_spec(form=-1, mx=4, my=4, a1=0.1_wp, b1=0.1_wp, aob=1.0_wp, aa=1.0_wp, bb=1.0_wp)
      bad = good
      bad%b1 = 0.0_wp
      call solve_hertz(bad, normal_control%force, 1.0_wp, 0.0_wp, gg, nu, hertz, error)
      call expect_error(suite, error, "B1", "flat in y")
      bad%b1 = ieee_value(1.0_wp, ieee_quiet_nan)
      call solve_hertz(bad, normal_control%force, 1.0_wp, 0.0_wp, gg, nu, hertz, error)
      call expect_error(suite, error, "B1", "not a number")
      call solve_hertz(good, normal_control%force, bad%b1, 0.0_wp, gg, nu, hertz, error)
      call expect_error(suite, error, "FN", "force not a number")
      bad = good
      bad%form = -3
      bad%bb = -1.0_wp
      call solve_hertz(bad, normal_control%force, 1.0_wp, 0.0_wp, gg, nu, hertz, error)
      call expect_error(suite, error, "BB", "negative semi-axis")
      call solve_hertz(good, normal_control%force, 1.0_wp, 0.0_wp, 0.0_wp, nu, hertz, error)
      call expect_error(suite, error, "modulus", "no stiffness")
      call solve_hertz(good, normal_control%force, 1.0_wp, 0.0_wp, gg, nu, hertz, error)
      bad = good
      bad%scale = 0.0_wp
      call build_grid(bad, hertz, grid, error)
      call expect_error(suite, error, "SCALE", "no window")
      call build_grid(good, grid=grid, error=error)
      call expect_error(suite, error, "Hertz solution", "Hertz data missing")
   end subroutine hertz_errors

   subroutine given_windows(suite)
      type(test_suite), intent(inout) :: suite
      type(grid_spec) :: spec
      type(potential_contact) :: grid
      type(error_type), allocatable :: error
      integer :: option

      ! One window, four descriptions
      spec = grid_spec(mx=10, my=4, xl=-1.0_wp, yl=2.0_wp, dx=0.2_wp, dy=0.5_wp, xh=1.0_wp, yh=4.0_wp, &
         & xc1=-0.9_wp, yc1=2.25_wp, xcm=0.9_wp, ycm=3.75_wp)
      do option = 1, 4
         spec%form = option
         call build_grid(spec, grid=grid, error=error)
         call suite%check(.not. allocated(error), "given window")
         call suite%close_to([grid%xl, grid%yl, grid%dx, grid%dy], [-1.0_wp, 2.0_wp, 0.2_wp, 0.5_wp], closed, "given window")
         call suite%equal(grid%npot(), 40, "number of elements")
      end do
      spec%mx = 1
      spec%xcm = spec%xc1
      call build_grid(spec, grid=grid, error=error)
      call expect_error(suite, error, "DX", "one column by two equal centres")
      spec%form = 2
      spec%yh = spec%yl
      call build_grid(spec, grid=grid, error=error)
      call expect_error(suite, error, "DY", "empty window")
      spec%form = 5
      call build_grid(spec, grid=grid, error=error)
      call expect_error(suite, error, "IPOTCN = 5", "unknown option")
      spec%my = 0
      call build_grid(spec, grid=grid, error=error)
      call expect_error(suite, error, "MX, MY", "no rows")
      spec%mx = 100000
      spec%my = 100000
      call build_grid(spec, grid=grid, error=error)
      call expect_error(suite, error, "too many", "ten thousand million elements")
   end subroutine given_windows

   !> The rows of a line contact fit its length exactly
   subroutine strips(suite)
      type(test_suite), intent(inout) :: suite

      call one_strip(suite, 10, 1.0_wp, 10)
      call one_strip(suite, 10, 0.5_wp, 10)
      call one_strip(suite, 12, 1.2_wp, 10)
      call one_strip(suite, 11, 1.2_wp, 9)
      call one_strip(suite, 12, 1.1_wp, 12)
      call one_strip(suite, 1, 1.3_wp, 1)
      call one_strip(suite, 1, 9.0_wp, 1)
      call one_strip(suite, 2, 9.0_wp, 2)
   end subroutine strips

   subroutine one_strip(suite, my, scale, rows)
      type(test_suite), intent(inout) :: suite
      integer, intent(in) :: my
      real(wp), intent(in) :: scale
      !> Expected number of rows within the contact
      integer, intent(in) :: rows
      type(grid_spec) :: spec
      type(hertz_result), allocatable :: hertz
      type(potential_contact) :: grid
      type(error_type), allocatable :: error

      spec = grid_spec(form=-5, mx=8, my=my, aa=0.5_wp, bb=3.0_wp, scale=scale)
      call solve_hertz(spec, normal_control%force, 1000.0_wp, 0.0_wp, gg, nu, hertz, error)
      call build_grid(spec, hertz, grid, error)
      call suite%close_to(rows*grid%dy, 6.0_wp, closed, "rows fit the strip")
      call suite%close_to(grid%yl, -0.5_wp*my*grid%dy, closed, "strip is centred")
      call suite%close_to(grid%xl, -scale*0.5_wp, closed, "width of the strip")
   end subroutine one_strip

   subroutine forms(suite)
      type(test_suite), intent(inout) :: suite
      type(geometry_spec) :: spec
      type(potential_contact) :: grid
      type(error_type), allocatable :: error
      real(wp), allocatable :: h(:, :)
      real(wp) :: x, y
      integer :: i

      grid = potential_contact(6, 5, -1.0_wp, 0.3_wp, 0.4_wp, 0.7_wp)
      x = grid%x(2)
      y = grid%y(4)
      spec%b = [0.1_wp, -0.2_wp, 0.3_wp, 0.04_wp, 0.05_wp, -0.6_wp, 7.0_wp, 8.0_wp]
      call undeformed_distance(spec, grid, h=h, error=error)
      call suite%close_to(h(2, 4), 0.1_wp*x**2 - 0.2_wp*x*y + 0.3_wp*y**2 + 0.04_wp*x + 0.05_wp*y - 0.6_wp, closed, "IBASE 1")
      spec%form = 3
      call undeformed_distance(spec, grid, h=h, error=error)
      call suite%close_to(h(2, 4), 0.1_wp*sin(-0.2_wp*(x - 0.3_wp)) - 0.04_wp*sin(0.05_wp*(x + 0.6_wp)) &
         & + x**2/7.0_wp + y**2/8.0_wp, closed, "IBASE 3")
      spec%form = 9
      spec%h = [(0.01_wp*i, i = 1, 30)]
      call undeformed_distance(spec, grid, h=h, error=error)
      call suite%close_to(h(2, 4), 0.2_wp, closed, "IBASE 9")
      spec%form = 2
      spec%xm = 0.2_wp
      spec%rm = 40.0_wp
      spec%y1 = 1.0_wp
      spec%dy1 = 1.0_wp
      spec%profile = [1.0_wp, 2.0_wp, 5.0_wp]
      call undeformed_distance(spec, grid, h=h, error=error)
      ! Rows at 0.65, 1.35, 2.05, 2.75, 3.45: the first and last outside the profile
      call suite%close_to(h(2, :) - (x - 0.2_wp)**2/80.0_wp, [0.65_wp, 1.35_wp, 2.15_wp, 4.25_wp, 6.35_wp], closed, "IBASE 2")
   end subroutine forms

   subroutine planforms(suite)
      type(test_suite), intent(inout) :: suite
      type(geometry_spec) :: spec
      type(potential_contact) :: grid
      type(error_type), allocatable :: error
      real(wp), allocatable :: h(:, :)

      grid = potential_contact(10, 10, -1.0_wp, -1.0_wp, 0.2_wp, 0.2_wp)
      spec%planform = 2
      ! The circle of radius 0.5 holds the centres with coordinates 0.1 and 0.3 only
      spec%pl(1:6) = [1.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, -0.25_wp]
      call undeformed_distance(spec, grid, h=h, error=error)
      call suite%equal(count(h < excluded_distance), 16, "planform: circle")
      call suite%close_to(h(1, 1), excluded_distance, 0.0_wp, "excluded distance")
      spec%planform = 3
      spec%pl = [-1.0_wp, 0.0_wp, -1.0_wp, 0.0_wp, -0.2_wp, 0.2_wp, -0.2_wp, 0.2_wp]
      call undeformed_distance(spec, grid, h=h, error=error)
      call suite%equal(count(h < excluded_distance), 28, "planform: two rectangles")
      spec%pl = [0.0_wp, -1.0_wp, 0.0_wp, 1.0_wp, 5.0_wp, 6.0_wp, 5.0_wp, 6.0_wp]
      call undeformed_distance(spec, grid, h=h, error=error)
      call expect_error(suite, error, "excludes all", "planform: nothing left")
      spec%planform = 4
      call undeformed_distance(spec, grid, h=h, error=error)
      call expect_error(suite, error, "IPLAN = 4", "planform: several parts without rectangles")
      spec%rectangles = reshape([-1.0_wp, 0.0_wp, -1.0_wp, 0.0_wp, -0.2_wp, 0.2_wp, -0.2_wp, 0.2_wp], [4, 2])
      spec%interaction = reshape([1.0_wp, 0.5_wp, 0.5_wp, 1.0_wp], [2, 2])
      call undeformed_distance(spec, grid, h=h, error=error)
      call suite%check(.not. allocated(error), "planform: two parts")
      call suite%equal(count(h < excluded_distance), 28, "planform: two parts exclude what two rectangles exclude")
      call suite%equal(count(part_labels(spec, grid) == 1), 25, "planform: an element in both belongs to the first part")
   end subroutine planforms

   subroutine geometry_errors(suite)
      type(test_suite), intent(inout) :: suite
      type(geometry_spec) :: spec
      type(potential_contact) :: grid
      type(error_type), allocatable :: error
      real(wp), allocatable :: h(:, :)

      grid = potential_contact(3, 2, 0.0_wp, 0.0_wp, 1.0_wp, 1.0_wp)
      spec%form = 9
      call undeformed_distance(spec, grid, h=h, error=error)
      call expect_error(suite, error, "for 0 elements", "IBASE 9 without values")
      spec%h = [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp]
      call undeformed_distance(spec, grid, h=h, error=error)
      call expect_error(suite, error, "5 elements (IBASE = 9), the potential contact has 3 x 2 = 6", "IBASE 9, wrong size")
      spec%h = [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, ieee_value(1.0_wp, ieee_quiet_nan)]
      call undeformed_distance(spec, grid, h=h, error=error)
      call expect_error(suite, error, "not a number", "IBASE 9, NaN")
      spec%form = 2
      call undeformed_distance(spec, grid, h=h, error=error)
      call expect_error(suite, error, "profile", "IBASE 2 without profile")
      spec%profile = [1.0_wp, 2.0_wp]
      spec%rm = 0.0_wp
      call undeformed_distance(spec, grid, h=h, error=error)
      call expect_error(suite, error, "RM", "IBASE 2, no radius")
      spec%form = 3
      call undeformed_distance(spec, grid, h=h, error=error)
      call expect_error(suite, error, "B7", "IBASE 3, no radius")
      spec%form = 5
      call undeformed_distance(spec, grid, h=h, error=error)
      call expect_error(suite, error, "IBASE = 5", "unknown form")
   end subroutine geometry_errors

   !> An error with a message that holds a text
   subroutine expect_error(suite, error, part, what)
      type(test_suite), intent(inout) :: suite
      type(error_type), allocatable, intent(in) :: error
      character(len=*), intent(in) :: part, what

      if (.not. allocated(error)) then
         call suite%check(.false., what // ": error expected")
         return
      end if
      call suite%check(index(error%message, part) > 0, what // ": " // error%message)
   end subroutine expect_error
end program test_geometry
