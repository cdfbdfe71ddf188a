!> Files of influence coefficients computed by other programs (C = 9)
!>
!>     NMATRIX  IACONVEX               1 or MY matrices; body with the convex surface, for the reader only
!>     LQUASID  XYZORDER               0 312
!>     LSYMMX  LSYMMY                  1 0
!>     MXFILE  MYFILE  DXFILE  DYFILE
!>     IMATRIX  XCENTR  YCENTR         before each matrix if there are several
!>     IXOFS  XREL  CZZ CZX CZY  CXZ CXX CXY  CYZ CYX CYY
!>
!> with one line for each offset in x, 0 to MXFILE-1, and for each offset in y, -(MYFILE-1) to MYFILE-1. After the heading, lines
!> that do not begin with a number are captions, in any number. Lines are identified by their order. Coefficients are multiplied
!> with the combined modulus of rigidity.
module contact_cases_coefficient_file
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_text_bounds, only : bounds_of, bounds_table, describe_breach
   use contact_elastic_model, only : influence_table
   use contact_grid_potential_contact, only : potential_contact
   use contact_text_lexer, only : input_lexer, input_value
   use contact_text_line_words, only : printable
   use contact_text_words, only : integer_text, real_text, to_real, word_state
   implicit none (type, external)
   private

   public :: read_coefficients, read_whole_table

   !> Number of values on a line of coefficients, and on the first line of a matrix
   integer, parameter :: line_length = 11, heading_length = 3
   !> Names of the columns of coefficients
   character(len=3), parameter :: names(3:line_length) = ["CZZ", "CZX", "CZY", "CXZ", "CXX", "CXY", "CYZ", "CYX", "CYY"]
   !> Tolerance for the sides of elements [mm]
   real(wp), parameter :: spacing_tolerance = 1.0e-5_wp
   !> Maximum number of rows or columns, and maximum number of coefficients of a case
   integer, parameter :: max_rows = 100000
   real(wp), parameter :: max_coefficients = 5.0e8_wp

contains

   !> Read the coefficients that a grid needs, with a warning if the file has fewer or more
   subroutine read_coefficients(text, grid, gg, table, log, error)
      !> The file, positioned at its first line
      type(input_lexer), intent(inout) :: text
      type(potential_contact), intent(in) :: grid
      !> Combined modulus of rigidity [N/mm2]
      real(wp), intent(in) :: gg
      !> Coefficients for all offsets on the grid
      type(influence_table), intent(out) :: table
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      integer :: matrices, mx, my
      character(len=:), allocatable :: sizes

      call read_heading(text, [grid%dx, grid%dy], ["DX", "DY"], grid%my, matrices, mx, my, log, error)
      if (allocated(error)) return
      sizes = text%file // " has influence coefficients for " // integer_text(mx) // " by " // integer_text(my) // &
         & " elements, the case has " // integer_text(grid%mx) // " by " // integer_text(grid%my)
      if (mx < grid%mx .or. my < grid%my) call log%warning(sizes // ": coefficients at larger distances are 0")
      if (mx > grid%mx .or. my > grid%my) call log%warning(sizes // ": coefficients at larger distances are not used")
      ! one column more than the grid has, for the shift by one element in steady rolling
      table%nx = grid%mx
      table%ny = grid%my - 1
      table%y_first = grid%y(1)
      call fill_table(text, matrices, mx, my, gg, table, error)
   end subroutine read_coefficients

   !> Read all coefficients of a file with one matrix, for grids whose size is not yet known
   subroutine read_whole_table(text, sides, gg, table, log, error)
      !> The file, positioned at its first line
      type(input_lexer), intent(inout) :: text
      !> Sides of the elements of wheel on rail, DX and DS [mm]
      real(wp), intent(in) :: sides(2)
      !> Combined modulus of rigidity [N/mm2]
      real(wp), intent(in) :: gg
      !> Coefficients for all offsets in the file
      type(influence_table), intent(out) :: table
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      integer :: matrices, mx, my

      call read_heading(text, sides, ["DX", "DS"], 0, matrices, mx, my, log, error)
      if (allocated(error)) return
      table%nx = mx
      table%ny = my - 1
      call fill_table(text, matrices, mx, my, gg, table, error)
   end subroutine read_whole_table

   !> Read the coefficients after the heading, for the offsets of a table
   subroutine fill_table(text, matrices, mx, my, gg, table, error)
      type(input_lexer), intent(in) :: text
      !> Numbers of matrices, columns and rows in the file
      integer, intent(in) :: matrices, mx, my
      !> Combined modulus of rigidity [N/mm2]
      real(wp), intent(in) :: gg
      !> Table with its range of offsets
      type(influence_table), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error

      table%fingerprint = text%fingerprint()
      if (real(table%nx + 1, wp)*(2*table%ny + 1)*9*matrices > max_coefficients) then
         call fatal_error(error, "a table for " // integer_text(table%nx) // " by " // integer_text(table%ny + 1) &
            & // " elements with " // integer_text(matrices) // " matrices needs too many coefficients; accepted are 5e8", &
            & file=text%file)
         return
      end if
      allocate(table%c(0:table%nx, -table%ny:table%ny, 9, matrices), source=0.0_wp)
      call read_matrices(text, matrices, mx, my, table, error)
      if (allocated(error)) return
      call check_table(text, table, error)
      if (allocated(error)) return
      table%c = table%c/gg
      ! extrapolation beyond the last column of a file that just covers the grid: proportional to 1/distance
      if (mx == table%nx) table%c(mx, :, :, :) = table%c(mx - 1, :, :, :)*(mx - 1)/mx
      ! components that are odd in x
      table%c(0, :, [2, 4, 6, 8], :) = 0.0_wp
   end subroutine fill_table

   !> Read the four groups before the coefficients
   subroutine read_heading(text, sides, side_names, rows, matrices, mx, my, log, error)
      type(input_lexer), intent(inout) :: text
      !> Sides of the elements of the case [mm], and their names
      real(wp), intent(in) :: sides(2)
      character(len=2), intent(in) :: side_names(2)
      !> Number of rows of the grid; 0: patches, whose number of rows is not known in advance
      integer, intent(in) :: rows
      !> Numbers of matrices, columns and rows in the file
      integer, intent(out) :: matrices, mx, my
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(4)

      matrices = 0
      mx = 0
      my = 0
      call text%read_group("ii", "NMATRIX IACONVEX", v, error)
      if (allocated(error)) return
      matrices = v(1)%i
      if (matrices /= 1 .and. rows > 0) call accept(v(1), [rows], "1, or MY = ")
      if (matrices /= 1 .and. rows == 0) call fatal_error(error, "NMATRIX = " // integer_text(matrices) // " cannot be used: " // &
         & "the rows of patches of wheel on rail are found and have no fixed place among matrices by row; accepted is 1, a " // &
         & "file with one matrix, or material.influence = ""conformal"" with search.location = ""conformal""", file=text%file, &
         & line=v(1)%line, column=v(1)%column)
      if (.not. allocated(error)) call accept(v(2), [1, 2])
      if (allocated(error)) return
      call log%line(" Influence coefficients from " // text%file // ", body " // integer_text(v(2)%i) // " (" &
         & // trim(merge("rail ", "wheel", v(2)%i == 1)) // ") above")
      call text%read_group("ii", "LQUASID XYZORDER", v, error)
      if (.not. allocated(error)) call accept(v(1), [0])
      if (.not. allocated(error)) call accept(v(2), [312])
      if (.not. allocated(error)) call text%read_group("ii", "LSYMMX LSYMMY", v, error)
      if (.not. allocated(error)) call accept(v(1), [1])
      if (.not. allocated(error)) call accept(v(2), [0])
      if (.not. allocated(error)) call text%read_group("iirr", "MXFILE MYFILE DXFILE DYFILE", v, error)
      if (.not. allocated(error)) call accept_size(v(1))
      if (.not. allocated(error)) call accept_size(v(2))
      if (.not. allocated(error)) call accept_side(v(3), sides(1), side_names(1))
      if (.not. allocated(error)) call accept_side(v(4), sides(2), side_names(2))
      if (allocated(error)) return
      mx = v(1)%i
      my = v(2)%i

   contains

      subroutine accept(value, good, words)
         type(input_value), intent(in) :: value
         integer, intent(in) :: good(:)
         !> Text before the accepted values
         character(len=*), intent(in), optional :: words
         character(len=:), allocatable :: list

         if (any(value%i == good)) return
         list = integer_text(good(1))
         if (size(good) > 1) list = list // " or " // integer_text(good(2))
         if (present(words)) list = words // list
         call fatal_error(error, value%name // " = " // integer_text(value%i) // " cannot be used; accepted is " // list, &
            & file=text%file, line=value%line, column=value%column)
      end subroutine accept

      subroutine accept_size(value)
         type(input_value), intent(in) :: value

         if (value%i >= 1 .and. value%i <= max_rows) return
         call fatal_error(error, value%name // " = " // integer_text(value%i) // " cannot be used; accepted are 1 to " // &
            & integer_text(max_rows), file=text%file, line=value%line, column=value%column)
      end subroutine accept_size

      subroutine accept_side(value, side, name)
         type(input_value), intent(in) :: value
         !> Side of the elements of the case [mm], and its name
         real(wp), intent(in) :: side
         character(len=*), intent(in) :: name

         if (abs(value%r - side) <= spacing_tolerance) return
         call fatal_error(error, value%name // " = " // real_text(value%r) // " mm cannot be used; accepted is " // name // " = " &
            & // real_text(side) // " mm of the case, up to 1e-5 mm", file=text%file, line=value%line, column=value%column)
      end subroutine accept_side
   end subroutine read_heading

   !> Read all coefficients, before the division by the modulus
   subroutine read_matrices(text, matrices, mx, my, table, error)
      type(input_lexer), intent(in) :: text
      !> Numbers of matrices, columns and rows in the file
      integer, intent(in) :: matrices, mx, my
      type(influence_table), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: values(line_length)
      integer :: line, n, first, matrix, ix, iy, headings

      matrix = 1
      ix = 0
      iy = -my + 1
      headings = 0
      do line = text%line + 1, text%count_lines()
         call read_line(text, line, values, n, first, error)
         if (allocated(error)) return
         if (n == 0) cycle
         if (n == heading_length) then
            headings = headings + 1
            if (headings == matrix .and. ix == 0 .and. iy == -my + 1 .and. matrix <= matrices &
               & .and. abs(values(1) - matrix) < 0.5_wp) cycle
            call refuse("is not the heading that comes here; expected " // trim(expected()))
         else if (n /= line_length) then
            call refuse("has " // integer_text(n) // " numbers; expected " // trim(expected()))
         else if (matrix > matrices) then
            call refuse("comes after the last coefficients; expected is the end of the file")
         end if
         if (allocated(error)) return
         if (ix <= table%nx .and. abs(iy) <= table%ny) table%c(ix, iy, :, matrix) = values(3:)
         ix = ix + 1
         if (ix < mx) cycle
         ix = 0
         iy = iy + 1
         if (iy < my) cycle
         iy = -my + 1
         matrix = matrix + 1
      end do
      if (matrix <= matrices) call fatal_error(error, "the end of the file is reached; expected " // trim(expected()), &
         & file=text%file, line=text%count_lines())

   contains

      !> Description of the expected line
      function expected() result(words)
         character(len=120) :: words

         words = "IXOFS XREL and the nine coefficients for offset " // integer_text(ix) // " in x, " // integer_text(iy) // &
            & " in y, of matrix " // integer_text(matrix) // " of " // integer_text(matrices)
      end function expected

      subroutine refuse(complaint)
         character(len=*), intent(in) :: complaint
         call fatal_error(error, 'the line "' // printable(text%line_text(line)) // '" ' // complaint, file=text%file, line=line, &
            & column=first)
      end subroutine refuse
   end subroutine read_matrices

   !> Read the values of a line; none if it does not begin with a number
   subroutine read_line(text, line, values, n, first, error)
      type(input_lexer), intent(in) :: text
      integer, intent(in) :: line
      real(wp), intent(out) :: values(line_length)
      !> Number of values on the line, and column of the first one
      integer, intent(out) :: n, first
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: words, complaint
      character(len=*), parameter :: separators = " ,"
      real(wp) :: value
      integer :: from, to, length, state, row

      values = 0.0_wp
      n = 0
      first = 1
      words = text%line_text(line)
      length = len(words)
      if (index(words, "%") > 0) length = index(words, "%") - 1
      to = 0
      do while (to < length)
         from = verify(words(to + 1:length), separators)
         if (from == 0) return
         from = to + from
         to = scan(words(from:length), separators)
         to = merge(length, from + to - 2, to == 0)
         call to_real(words(from:to), value, state)
         if (n == 0) then
            first = from
            if (state == word_state%malformed) return
         end if
         if (state /= word_state%good) then
            call fatal_error(error, '"' // printable(words(from:to)) // '" is not a finite number; expected value ' // &
               & integer_text(n + 1) // " of the eleven IXOFS XREL CZZ CZX CZY CXZ CXX CXY CYZ CYX CYY", &
               & file=text%file, line=line, column=from)
            return
         end if
         n = n + 1
         if (n <= line_length) values(n) = value
         if (n == 3) row = bounds_of("CZZ")
         if (n < 3 .or. n > line_length) cycle
         if (value >= bounds_table(row)%lowest .and. value <= bounds_table(row)%highest) cycle
         call describe_breach("CZZ", words(from:to), value, complaint, names(n))
         call fatal_error(error, complaint, file=text%file, line=line, column=from)
         return
      end do
   end subroutine read_line

   !> Check that the displacement of an element by its own load is the largest one
   subroutine check_table(text, table, error)
      type(input_lexer), intent(in) :: text
      type(influence_table), intent(in) :: table
      type(error_type), allocatable, intent(out) :: error
      character(len=3), parameter :: name(3) = ["CZZ", "CXX", "CYY"]
      integer :: matrix, i, b

      do matrix = 1, size(table%c, 4)
         do i = 1, 3
            b = 4*i - 3
            if (table%c(0, 0, b, matrix) > 0.0_wp .and. table%c(0, 0, b, matrix) >= maxval(abs(table%c(:, :, b, matrix)))) cycle
            call fatal_error(error, name(i) // " = " // real_text(table%c(0, 0, b, matrix)) // " at offset 0, matrix " // &
               & integer_text(matrix) // ", cannot be used; accepted are positive numbers not below those at other offsets", &
               & file=text%file)
            return
         end do
      end do
   end subroutine check_table
end module contact_cases_coefficient_file
