!> The groups of a case of module 3 that belong to the grid: potential contact, geometry, extra slip
module contact_input_grid3
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : long, wp
   use contact_cases_geometry, only : strip_rows
   use contact_cases_spec, only : case_spec, geometry_spec, grid_spec
   use contact_input_problems, only : problem_list, severity
   use contact_input_values, only : read_list, read_values
   use contact_text_lexer, only : input_lexer, input_value
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: read_grid, read_geometry, read_extra_slip, grid_frame, frame_of, largest_grid

   !> Largest number of elements of a potential contact area
   integer, parameter :: largest_grid = 2000000

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

   !> Potential contact area (D = 2)
   !>
   !> A Hertzian option brings its own geometry, so that IBASE and IPLAN are 1 from there on.
   subroutine read_grid(lexer, spec, problems, line, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      !> Line with IPOTCN, 0 when the case has none
      integer, intent(out) :: line
      type(error_type), allocatable, intent(out) :: error
      type(grid_spec) :: grid
      type(input_value) :: option(1), v(6)

      line = 0
      if (spec%digits%d /= 2) return
      call lexer%read_group("i", "IPOTCN", option, error)
      line = lexer%line
      if (allocated(error)) return
      grid%ipotcn = option(1)%i

      select case (grid%ipotcn)
      case (-1)
         call read_values(lexer, "iirrr", "MX MY A1 B1 SCALE", v, problems, error)
         grid%a1 = v(3)%r
         grid%b1 = v(4)%r
      case (-2)
         call read_values(lexer, "iirrr", "MX MY A1 AOB SCALE", v, problems, error)
         grid%a1 = v(3)%r
         grid%aob = v(4)%r
      case (-3, -5)
         call read_values(lexer, "iirrr", "MX MY AA BB SCALE", v, problems, error)
         grid%aa = v(3)%r
         grid%bb = v(4)%r
      case (-4)
         call read_values(lexer, "iirrr", "MX MY A1 BB SCALE", v, problems, error)
         grid%a1 = v(3)%r
         grid%bb = v(4)%r
      case (-6)
         call read_values(lexer, "iirrrr", "MX MY AA BNEG BPOS SCALE", v, problems, error)
         grid%aa = v(3)%r
         grid%bneg = v(4)%r
         grid%bpos = v(5)%r
      case (1)
         call read_values(lexer, "iirrrr", "MX MY XL YL DX DY", v, problems, error)
         grid%xl = v(3)%r
         grid%yl = v(4)%r
         grid%dx = v(5)%r
         grid%dy = v(6)%r
      case (2)
         call read_values(lexer, "iirrrr", "MX MY XL YL XH YH", v, problems, error)
         grid%xl = v(3)%r
         grid%yl = v(4)%r
         grid%xh = v(5)%r
         grid%yh = v(6)%r
      case (3)
         call read_values(lexer, "iirrrr", "MX MY XC1 YC1 DX DY", v, problems, error)
         grid%xc1 = v(3)%r
         grid%yc1 = v(4)%r
         grid%dx = v(5)%r
         grid%dy = v(6)%r
      case (4)
         call read_values(lexer, "iirrrr", "MX MY XC1 YC1 XCM YCM", v, problems, error)
         grid%xc1 = v(3)%r
         grid%yc1 = v(4)%r
         grid%xcm = v(5)%r
         grid%ycm = v(6)%r
      case default
         call problems%add(severity%error, "IPOTCN = " // option(1)%word // &
            & " is not a known option; allowed are -6 to -1 and 1 to 4", option(1)%line, option(1)%column)
         return
      end select
      if (allocated(error)) return

      grid%mx = v(1)%i
      grid%my = v(2)%i
      select case (grid%ipotcn)
      case (-5:-1)
         grid%scale = v(5)%r
      case (-6)
         grid%scale = v(6)%r
      case (2, 4)
         if (grid%ipotcn == 4) then
            call check_two(v(1))
            call check_two(v(2))
         end if
         call check_order(v(3), v(5))
         call check_order(v(4), v(6))
      end select
      call check_size(v(1), v(2), problems)

      spec%grid = grid
      if (grid%ipotcn < 0) then
         spec%new_geometry = .true.
         spec%geometry = geometry_spec()
         if (grid%ipotcn == -1) then
            spec%geometry%b(1) = grid%a1
            spec%geometry%b(3) = grid%b1
         end if
      end if

   contains

      !> Two centres are needed to tell a distance
      subroutine check_two(number)
         type(input_value), intent(in) :: number

         if (number%i == 1) call problems%add(severity%error, number%name // " = 1 is below its lower bound 2 for " // &
            & "IPOTCN = 4, which derives the sides of elements from the distance of two centres", number%line, number%column)
      end subroutine check_two

      !> The upper end must lie above the lower end
      subroutine check_order(low, high)
         type(input_value), intent(in) :: low, high

         if (high%r > low%r) return
         call problems%add(severity%error, high%name // " = " // high%word // " must be larger than " // low%name // &
            & " = " // low%word, high%line, high%column)
      end subroutine check_order
   end subroutine read_grid

   !> Numbers of elements
   subroutine check_size(mx, my, problems)
      type(input_value), intent(in) :: mx, my
      type(problem_list), intent(inout) :: problems

      if (mx%i < 1 .or. my%i < 1 .or. max(mx%i, my%i) > largest_grid) return
      if (int(mx%i, long)*int(my%i, long) > largest_grid) call problems%add(severity%error, "MX = " // mx%word // &
         & " times MY = " // my%word // " is above its upper bound of " // integer_text(largest_grid) // " elements", &
         & mx%line, mx%column)
   end subroutine check_size

   !> Undeformed distance and planform (Z = 2, grids that are not Hertzian)
   subroutine read_geometry(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(geometry_spec) :: geometry
      type(input_value) :: option(2), v(5)
      real(wp), allocatable :: list(:)
      integer :: n

      if (spec%digits%z /= 2 .or. spec%grid%ipotcn <= 0) return
      call lexer%read_group("ii", "IBASE IPLAN", option, error)
      if (allocated(error)) return
      geometry%ibase = option(1)%i
      geometry%iplan = option(2)%i

      select case (geometry%ibase)
      case (1)
         call read_list(lexer, 6, "B", list, problems, error)
         if (allocated(error)) return
         geometry%b(:6) = list
      case (2)
         call read_values(lexer, "irrrr", "NN XM RM Y1 DY1", v, problems, error)
         if (allocated(error)) return
         call problems%check_integer(v(1), 2, 999999)
         geometry%xm = v(2)%r
         geometry%rm = v(3)%r
         geometry%y1 = v(4)%r
         geometry%dy1 = v(5)%r
         call read_list(lexer, v(1)%i, "B", geometry%profile, problems, error)
         if (allocated(error)) return
      case (3)
         call read_list(lexer, 8, "B", list, problems, error, bounds="B(IBASE3)")
         if (allocated(error)) return
         geometry%b = list
      case (9)
         call element_count(spec%grid, "H", lexer, n, error)
         if (allocated(error)) return
         call read_list(lexer, n, "H", geometry%h, problems, error)
         if (allocated(error)) return
      case default
         call problems%add(severity%error, "IBASE = " // option(1)%word // &
            & " is not a known option; allowed are 1, 2, 3 and 9", option(1)%line, option(1)%column)
      end select

      call read_planform(lexer, option(2), geometry, problems, error)
      if (allocated(error)) return
      spec%geometry = geometry
   end subroutine read_geometry

   !> Restrictions of the contact area in the plane
   subroutine read_planform(lexer, option, geometry, problems, error)
      type(input_lexer), intent(inout) :: lexer
      !> IPLAN
      type(input_value), intent(in) :: option
      type(geometry_spec), intent(inout) :: geometry
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(8)
      real(wp), allocatable :: list(:)
      character(len=:), allocatable :: words
      integer :: n, i, j, k
      !> Most parts of a planform
      integer, parameter :: most_parts = 100

      select case (option%i)
      case (1)
      case (2)
         call read_list(lexer, 6, "PL", list, problems, error)
         if (allocated(error)) return
         geometry%pl(:6) = list
      case (3)
         call read_values(lexer, "rrrrrrrr", "XL1 XH1 YL1 YH1 XL2 XH2 YL2 YH2", v, problems, error)
         if (allocated(error)) return
         geometry%pl = v%r
         if (all(v(1::2)%r < v(2::2)%r)) return
         words = v(1)%word
         do n = 2, size(v)
            words = words // ", " // v(n)%word
         end do
         call problems%add(severity%error, "the rectangles of IPLAN = 3 need XL < XH " // &
            & "and YL < YH; given are XL1, XH1, YL1, YH1, XL2, XH2, YL2, YH2 = " // words, v(1)%line, v(1)%column)
      case (4)
         call lexer%read_group("i", "NP", v, error)
         if (allocated(error)) return
         n = v(1)%i
         if (n < 1 .or. n > most_parts) then
            ! how much to read is not known
            call fatal_error(error, "NP = " // v(1)%word // ", the number of parts of IPLAN = 4, is outside its range 1 to " // &
               & integer_text(most_parts), error_kind%input, lexer%file, v(1)%line, v(1)%column)
            return
         end if
         call read_list(lexer, 4*n, "XL,XH,YL,YH", list, problems, error)
         if (allocated(error)) return
         geometry%rectangles = reshape(list, [4, n])
         if (any(list(1::4) >= list(2::4) .or. list(3::4) >= list(4::4))) call problems%add(severity%error, &
            & "the rectangles of IPLAN = 4 need XL < XH and YL < YH; rectangle " // integer_text(first_bad(geometry%rectangles)) &
            & // " has not", v(1)%line, v(1)%column)
         call read_list(lexer, (n*(n - 1))/2, "FAC", list, problems, error)
         if (allocated(error)) return
         allocate(geometry%interaction(n, n), source=1.0_wp)
         k = 0
         do i = 1, n
            do j = i + 1, n
               k = k + 1
               geometry%interaction(i, j) = list(k)
               geometry%interaction(j, i) = list(k)
            end do
         end do
      case default
         call problems%add(severity%error, "IPLAN = " // option%word // &
            & " is not a known option; allowed are 1 to 4", option%line, option%column)
      end select
   end subroutine read_planform

   !> Number of the first rectangle whose ends are not in order
   pure integer function first_bad(rectangles) result(k)
      !> XL XH YL YH of each, shape (4, n)
      real(wp), intent(in) :: rectangles(:, :)

      do k = 1, size(rectangles, 2)
         if (rectangles(1, k) >= rectangles(2, k) .or. rectangles(3, k) >= rectangles(4, k)) return
      end do
   end function first_bad

   !> Extra term of the rigid slip (E); 0 removes it
   subroutine read_extra_slip(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: list(:)
      integer :: n

      select case (spec%digits%e)
      case (1)
         return
      case (9)
         call element_count(spec%grid, "EXRHS", lexer, n, error)
         if (allocated(error)) return
         call read_list(lexer, 2*n, "EXRHS", list, problems, error)
         if (allocated(error)) return
         spec%extra_slip = reshape(list, [2, n])
      case default
         if (allocated(spec%extra_slip)) deallocate(spec%extra_slip)
      end select
   end subroutine read_extra_slip

   !> Number of elements for a list with one entry per element
   subroutine element_count(grid, name, lexer, n, error)
      type(grid_spec), intent(in) :: grid
      !> The list
      character(len=*), intent(in) :: name
      type(input_lexer), intent(in) :: lexer
      integer, intent(out) :: n
      type(error_type), allocatable, intent(out) :: error

      n = 0
      if (grid%mx >= 1 .and. grid%my >= 1) then
         if (int(grid%mx, long)*int(grid%my, long) <= largest_grid) n = grid%mx*grid%my
      end if
      if (n == 0) call fatal_error(error, "the list " // name // " has one entry for each element, but there is no " // &
         & "grid that can be used: MX = " // integer_text(grid%mx) // ", MY = " // integer_text(grid%my), &
         & file=lexer%file, line=lexer%line)
   end subroutine element_count

   !> Sides of the elements and centre of the first one, where the input alone tells them
   pure type(grid_frame) function frame_of(grid) result(frame)
      type(grid_spec), intent(in) :: grid
      integer :: rows

      frame%mx = grid%mx
      frame%my = grid%my
      if (grid%mx < 1 .or. grid%my < 1) return
      select case (grid%ipotcn)
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
end module contact_input_grid3
