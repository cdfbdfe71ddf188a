!> Input values of grid and planform, once for all formats
!>
!> As in contact_cases_inputs; the undeformed distance is in contact_cases_distance.
module contact_cases_grid_inputs
   use contact_base_choices, only : grid_form, planform_choice
   use contact_base_kinds, only : long, wp
   use contact_cases_archive, only : case_archive
   use contact_cases_spec, only : geometry_spec, grid_spec
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: visit_grid, visit_planform, largest_grid

   !> Maximum number of elements of a potential contact
   integer, parameter :: largest_grid = 2000000
   !> Maximum number of parts of a planform
   integer, parameter :: max_parts = 100

contains

   !> Values that belong to a form of the grid (IPOTCN)
   subroutine visit_grid(a, grid)
      class(case_archive), intent(inout) :: a
      !> The form is set
      type(grid_spec), intent(inout), target :: grid

      call a%integer("MX", grid%mx)
      call a%integer("MY", grid%my)
      select case (grid%form)
      case (grid_form%hertz_curvatures)
         call a%real("A1", grid%a1)
         call a%real("B1", grid%b1)
      case (grid_form%hertz_curvature_ratio)
         call a%real("A1", grid%a1)
         call a%real("AOB", grid%aob)
      case (grid_form%hertz_axes, grid_form%hertz_line)
         call a%real("AA", grid%aa)
         call a%real("BB", grid%bb)
      case (grid_form%hertz_line_curvature)
         call a%real("A1", grid%a1)
         call a%real("BB", grid%bb)
      case (grid_form%half_ellipses)
         call a%real("AA", grid%aa)
         call a%real("BNEG", grid%bneg)
         call a%real("BPOS", grid%bpos)
      case (grid_form%corner_and_sides, grid_form%corners)
         call a%real("XL", grid%xl)
         call a%real("YL", grid%yl)
      case (grid_form%centre_and_sides, grid_form%centres)
         call a%real("XC1", grid%xc1)
         call a%real("YC1", grid%yc1)
      end select
      select case (grid%form)
      case (grid_form%half_ellipses:grid_form%hertz_curvatures)
         call a%real("SCALE", grid%scale)
      case (grid_form%corner_and_sides, grid_form%centre_and_sides)
         call a%real("DX", grid%dx)
         call a%real("DY", grid%dy)
      case (grid_form%corners)
         call a%real("XH", grid%xh)
         call a%real("YH", grid%yh)
      case (grid_form%centres)
         call a%real("XCM", grid%xcm)
         call a%real("YCM", grid%ycm)
      end select
      call a%end_line()

      if (.not. a%is_reading) return
      if (grid%form == grid_form%centres) then
         call check_two("MX", grid%mx)
         call check_two("MY", grid%my)
         call check_order("XC1", grid%xc1, "XCM", grid%xcm)
         call check_order("YC1", grid%yc1, "YCM", grid%ycm)
      else if (grid%form == grid_form%corners) then
         call check_order("XL", grid%xl, "XH", grid%xh)
         call check_order("YL", grid%yl, "YH", grid%yh)
      end if
      if (min(grid%mx, grid%my) < 1 .or. max(grid%mx, grid%my) > largest_grid) return
      if (int(grid%mx, long)*int(grid%my, long) > largest_grid) call a%refuse("MX", " times " // trim(a%shown("MY")) // &
         & " is above its upper bound of " // integer_text(largest_grid) // " elements")

   contains

      !> Two centres are needed to define a distance
      subroutine check_two(name, number)
         character(len=*), intent(in) :: name
         integer, intent(in) :: number

         if (number == 1) call a%refuse(name, " is below its lower bound 2 for IPOTCN = 4, which derives the sides of " // &
            & "elements from the distance of two centres")
      end subroutine check_two

      !> The upper end must be above the lower end
      subroutine check_order(low_name, low, high_name, high)
         character(len=*), intent(in) :: low_name, high_name
         real(wp), intent(in) :: low, high

         if (.not. high > low) call a%refuse(high_name, " must be larger than " // trim(a%shown(low_name)))
      end subroutine check_order
   end subroutine visit_grid

   !> Values that belong to a form of the planform (IPLAN)
   subroutine visit_planform(a, geometry)
      class(case_archive), intent(inout) :: a
      !> The form is set
      type(geometry_spec), intent(inout), target :: geometry
      character(len=3), parameter :: names(8) = ["XL1", "XH1", "YL1", "YH1", "XL2", "XH2", "YL2", "YH2"]
      real(wp), allocatable :: list(:)
      integer :: k

      select case (geometry%planform)
      case (planform_choice%quadratic)
         list = geometry%pl(:6)
         call a%list("PL", list, 6)
         if (a%is_reading .and. a%is_good) geometry%pl(:6) = list
      case (planform_choice%two_rectangles)
         do k = 1, 8
            call a%real(names(k), geometry%pl(k))
         end do
         call a%end_line()
         do k = 1, 7, 2
            if (.not. geometry%pl(k + 1) > geometry%pl(k)) call a%refuse(names(k + 1), " must be larger than " // &
               & trim(a%shown(names(k))))
         end do
      case (planform_choice%weighted_rectangles)
         call visit_parts(a, geometry)
      end select
   end subroutine visit_planform

   !> Parts of a planform, and interaction factors of their pressures
   subroutine visit_parts(a, geometry)
      class(case_archive), intent(inout) :: a
      type(geometry_spec), intent(inout), target :: geometry
      real(wp), allocatable :: list(:), factors(:)
      integer, target :: n
      integer :: i, j, k

      n = 0
      if (allocated(geometry%rectangles)) n = size(geometry%rectangles, 2)
      call a%integer("NP", n, unchecked=.true.)
      call a%end_line()
      ! otherwise the number of values to read is not known
      if (n < 1 .or. n > max_parts) call a%fail("NP", ", the number of parts of IPLAN = 4, is outside its range 1 to " // &
         & integer_text(max_parts))
      if (.not. a%is_good) return
      if (.not. a%is_reading) then
         list = reshape(geometry%rectangles, [4*n])
         factors = [((geometry%interaction(i, j), j = i + 1, n), i = 1, n)]
      end if
      call a%list("XL,XH,YL,YH", list, 4*n)
      if (a%is_reading .and. a%is_good) then
         geometry%rectangles = reshape(list, [4, n])
         do k = 1, n
            if (list(4*k - 3) < list(4*k - 2) .and. list(4*k - 1) < list(4*k)) cycle
            call a%refuse("NP", ": the rectangles of IPLAN = 4 need XL < XH and YL < YH; rectangle " // integer_text(k) // &
               & " has not")
            exit
         end do
      end if
      call a%list("FAC", factors, (n*(n - 1))/2)
      if (.not. (a%is_reading .and. a%is_good)) return
      if (allocated(geometry%interaction)) deallocate(geometry%interaction)
      allocate(geometry%interaction(n, n), source=1.0_wp)
      k = 0
      do i = 1, n
         do j = i + 1, n
            k = k + 1
            geometry%interaction(i, j) = factors(k)
            geometry%interaction(j, i) = factors(k)
         end do
      end do
   end subroutine visit_parts
end module contact_cases_grid_inputs
