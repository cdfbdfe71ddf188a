!> Tables of influence coefficients of homogeneous half-spaces, piecewise constant tractions, from contact_elastic_corners
module contact_elastic_halfspace
   use contact_base_kinds, only : wp
   use contact_elastic_corners, only : combine_corners, corner_functions, normal_coefficient
   use contact_elastic_material, only : combined_material
   implicit none (type, external)
   private

   public :: kernel_table, fill_normal, complete_table, own_tangential, fill_table, fill_shifted_table
   public :: shape_table, set_mirrored, set_entry, middle_of_table

   !> Influence coefficients over a range of offsets, divided by the modulus [mm/(N/mm2)]
   !>
   !> The first indices are offsets "receiving minus loaded element" in x and y. The coupling coefficients nx, ny are -xn, -yn;
   !> yx equals xy.
   type :: kernel_table
      !> Offsets are in the ranges -nx...nx and -ny...ny
      integer :: nx = -1, ny = -1
      !> Sides of the elements [mm]
      real(wp) :: dx = 0.0_wp, dy = 0.0_wp
      !> Offset of the observation point from the element centre [mm]
      real(wp) :: shift_x = 0.0_wp, shift_y = 0.0_wp
      type(combined_material) :: material
      real(wp), allocatable :: nn(:, :)
      !> Unallocated while only nn has been requested
      real(wp), allocatable :: xx(:, :), yy(:, :), xy(:, :)
      !> Tangential displacements due to pressures; unallocated if uncoupled
      real(wp), allocatable :: xn(:, :), yn(:, :)
      !> Corner functions of the last table without shift, reused for tables of other sizes, shape (5, -1:..., -1:...); their
      !> parameters
      real(wp), allocatable, private :: corner(:, :, :)
      real(wp), private :: corner_sides(2) = 0.0_wp
      logical, private :: corner_coupled = .false.
   end type kernel_table

   !> Corner functions of larger tables are not kept, as windows of that size do not change from case to case; threads share the
   !> rows of such tables
   integer, parameter :: largest_kept = 20000

contains

   !> All coefficients without shift
   subroutine fill_table(table, material, dx, dy, nx, ny)
      !> Receives offsets, sides and coefficients; its arrays are allocated here
      type(kernel_table), intent(inout) :: table
      !> Combined constants of both bodies
      type(combined_material), intent(in) :: material
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Maximum offsets in elements
      integer, intent(in) :: nx, ny

      call fill_normal(table, material, dx, dy, nx, ny)
      call complete_table(table)
   end subroutine fill_table

   !> Coefficients nn only, without shift: one quadrant is computed, the others follow by symmetry
   subroutine fill_normal(table, material, dx, dy, nx, ny)
      !> Receives offsets, sides and nn; contains no others on exit
      type(kernel_table), intent(inout) :: table
      !> Combined constants of both bodies
      type(combined_material), intent(in) :: material
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Maximum offsets in elements
      integer, intent(in) :: nx, ny
      integer :: l

      if (allocated(table%nn)) then
         if (table%nx /= nx .or. table%ny /= ny) deallocate(table%nn)
      end if
      if (.not. allocated(table%nn)) allocate(table%nn(-nx:nx, -ny:ny))
      if (allocated(table%xx)) deallocate(table%xx, table%yy, table%xy)
      if (allocated(table%xn)) deallocate(table%xn, table%yn)
      call name_table(table, material, dx, dy, nx, ny)
      table%shift_x = 0.0_wp
      table%shift_y = 0.0_wp
      call find_corners(table, dx, dy, nx, ny, material%coupled())
      if (nx*ny > largest_kept) then
         !$omp parallel do
         do l = 0, ny
            call set_normal_rows(table, l)
         end do
         !$omp end parallel do
      else
         do l = 0, ny
            call set_normal_rows(table, l)
         end do
      end if
   end subroutine fill_normal

   !> Coefficients nn at one distance across, to both sides
   subroutine set_normal_rows(table, l)
      !> Named, with corner functions
      type(kernel_table), intent(inout) :: table
      !> Offset along y, not negative
      integer, intent(in) :: l
      integer :: k

      do k = 0, table%nx
         table%nn(k, l) = normal_coefficient(difference_of_corners(table, k, l), table%material)
      end do
      do k = 1, table%nx
         table%nn(-k, l) = table%nn(k, l)
      end do
      if (l > 0) table%nn(:, -l) = table%nn(:, l)
   end subroutine set_normal_rows

   !> The coefficients of smaller offsets of a table
   pure subroutine middle_of_table(from, n, to)
      !> Table with all coefficients
      type(kernel_table), intent(in) :: from
      !> Maximum offsets along x and y, at most those of the table
      integer, intent(in) :: n(2)
      !> Table of these offsets
      type(kernel_table), intent(out) :: to

      to%nx = n(1)
      to%ny = n(2)
      to%dx = from%dx
      to%dy = from%dy
      to%shift_x = from%shift_x
      to%shift_y = from%shift_y
      to%material = from%material
      call copy_middle(from%nn, to%nn)
      call copy_middle(from%xx, to%xx)
      call copy_middle(from%yy, to%yy)
      call copy_middle(from%xy, to%xy)
      if (.not. allocated(from%xn)) return
      call copy_middle(from%xn, to%xn)
      call copy_middle(from%yn, to%yn)

   contains

      !> One of the coefficients
      pure subroutine copy_middle(larger, smaller)
         real(wp), allocatable, intent(in) :: larger(:, :)
         real(wp), allocatable, intent(inout) :: smaller(:, :)

         allocate(smaller(-n(1):n(1), -n(2):n(2)))
         smaller = larger(-n(1):n(1), -n(2):n(2))
      end subroutine copy_middle
   end subroutine middle_of_table

   !> The coefficients that `fill_normal` leaves out; nothing where they are there
   subroutine complete_table(table)
      !> Table without shift
      type(kernel_table), intent(inout) :: table
      integer :: l

      if (allocated(table%xx) .or. .not. allocated(table%nn)) return
      associate (nx => table%nx, ny => table%ny)
         allocate(table%xx(-nx:nx, -ny:ny), table%yy(-nx:nx, -ny:ny), table%xy(-nx:nx, -ny:ny))
         if (table%material%coupled()) allocate(table%xn(-nx:nx, -ny:ny), table%yn(-nx:nx, -ny:ny))
         if (nx*ny > largest_kept) then
            !$omp parallel do
            do l = 0, ny
               call set_tangential_rows(table, l)
            end do
            !$omp end parallel do
            deallocate(table%corner)
         else
            do l = 0, ny
               call set_tangential_rows(table, l)
            end do
         end if
      end associate
   end subroutine complete_table

   !> The coefficients of `complete_table` at one distance across, to both sides
   subroutine set_tangential_rows(table, l)
      !> With normal coefficients and corner functions
      type(kernel_table), intent(inout) :: table
      !> Offset along y, not negative
      integer, intent(in) :: l
      integer :: k
      real(wp) :: v(6)

      do k = 0, table%nx
         v = combine_corners(difference_of_corners(table, k, l), table%material)
         ! a coefficient that is odd in an offset is exactly zero at offset 0
         if (k == 0 .or. l == 0) v(4) = 0.0_wp
         table%xx(k, l) = v(2)
         table%yy(k, l) = v(3)
         table%xy(k, l) = v(4)
         if (.not. allocated(table%xn)) cycle
         table%xn(k, l) = merge(0.0_wp, v(5), k == 0)
         table%yn(k, l) = merge(0.0_wp, v(6), l == 0)
      end do
      call mirror_row(table%nx, table%ny, l, 1, 1, table%xx)
      call mirror_row(table%nx, table%ny, l, 1, 1, table%yy)
      call mirror_row(table%nx, table%ny, l, -1, -1, table%xy)
      if (.not. allocated(table%xn)) return
      call mirror_row(table%nx, table%ny, l, -1, 1, table%xn)
      call mirror_row(table%nx, table%ny, l, 1, -1, table%yn)
   end subroutine set_tangential_rows

   !> Coefficients xx and yy of an element on itself, for a table of normal coefficients
   pure function own_tangential(table) result(own)
      !> Table without shift, with corner functions
      type(kernel_table), intent(in) :: table
      real(wp) :: own(2), v(6)

      v = combine_corners(difference_of_corners(table, 0, 0), table%material)
      own = v(2:3)
   end function own_tangential

   !> Signed sum of the corner functions over the corners of an element
   pure function difference_of_corners(table, k, l) result(d)
      !> Table with corner functions
      type(kernel_table), intent(in) :: table
      !> Offset, not negative
      integer, intent(in) :: k, l
      real(wp) :: d(5)

      d = 0.0_wp
      associate (f => table%corner)
         d(:size(f, 1)) = f(:, k, l) - f(:, k - 1, l) - f(:, k, l - 1) + f(:, k - 1, l - 1)
      end associate
   end function difference_of_corners

   !> Corner functions up to the maximum offsets; values known from other sizes are reused
   subroutine find_corners(table, dx, dy, nx, ny, coupled)
      !> On exit its `corner` contains all required values
      type(kernel_table), intent(inout) :: table
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Maximum offsets in elements
      integer, intent(in) :: nx, ny
      !> Are all five functions required?
      logical, intent(in) :: coupled
      real(wp), allocatable :: wider(:, :, :)
      integer :: l, known(2), number, wanted(2)
      logical :: is_square

      known = -2
      if (allocated(table%corner)) then
         if (all(abs(table%corner_sides - [dx, dy]) <= 0.0_wp) .and. (table%corner_coupled .eqv. coupled)) &
            & known = [ubound(table%corner, 2), ubound(table%corner, 3)]
      end if
      if (all(known >= [nx, ny])) return
      wanted = max(known, [nx, ny])
      number = merge(5, 3, coupled)
      allocate(wider(number, -1:wanted(1), -1:wanted(2)))
      is_square = abs(dx - dy) <= 0.0_wp
      if (nx*ny > largest_kept) then
         ! rows that are mirrored in part take less time
         !$omp parallel do schedule(dynamic, 4)
         do l = -1, wanted(2)
            call fill_row(l)
         end do
         !$omp end parallel do
         !$omp parallel do schedule(dynamic, 4)
         do l = -1, wanted(2)
            call mirror_in_row(l)
         end do
         !$omp end parallel do
      else
         ! without threads: a parallel region requests memory
         do l = -1, wanted(2)
            call fill_row(l)
         end do
         do l = -1, wanted(2)
            call mirror_in_row(l)
         end do
      end if
      call move_alloc(wider, table%corner)
      table%corner_sides = [dx, dy]
      table%corner_coupled = coupled

   contains

      !> A row of functions, copied where they are known, without those that are mirrored
      subroutine fill_row(l)
         !> Index of the row
         integer, intent(in) :: l
         integer :: k

         do k = -1, wanted(1)
            if (k <= known(1) .and. l <= known(2)) then
               wider(:, k, l) = table%corner(:, k, l)
            else if (.not. is_mirrored(k, l)) then
               wider(:, k, l) = some_functions(number, (k + 0.5_wp)*dx, (l + 0.5_wp)*dy)
            end if
         end do
      end subroutine fill_row

      !> The functions of a row that are mirrored
      subroutine mirror_in_row(l)
         !> Index of the row
         integer, intent(in) :: l
         integer :: k

         do k = -1, wanted(1)
            if (is_mirrored(k, l) .and. (k > known(1) .or. l > known(2))) wider(:, k, l) = mirrored(number, wider(:, l, k))
         end do
      end subroutine mirror_in_row

      !> Are the functions those of the corner with x and y exchanged, which square elements have?
      pure logical function is_mirrored(k, l)
         integer, intent(in) :: k, l

         is_mirrored = is_square .and. l > k .and. l <= wanted(1) .and. k <= wanted(2)
      end function is_mirrored
   end subroutine find_corners

   !> The first three functions, or all five
   pure function some_functions(number, x, y) result(f)
      integer, intent(in) :: number
      real(wp), intent(in) :: x, y
      real(wp) :: f(number), all_five(5)

      all_five = corner_functions(x, y, number == 5)
      f = all_five(:number)
   end function some_functions

   !> The functions with x and y exchanged
   pure function mirrored(number, f) result(g)
      integer, intent(in) :: number
      real(wp), intent(in) :: f(number)
      real(wp) :: g(number)

      g(1) = f(2)
      g(2) = f(1)
      g(3) = f(3)
      if (number == 5) g(4:5) = [f(5), f(4)]
   end function mirrored

   !> Set a row of a kernel that is even (+1) or odd (-1) in each offset for negative offsets, and the row on the other side
   pure subroutine mirror_row(nx, ny, l, sign_x, sign_y, kernel)
      !> Maximum offsets, and that of the row
      integer, intent(in) :: nx, ny, l
      integer, intent(in) :: sign_x, sign_y
      !> The row is given for non-negative offsets
      real(wp), intent(inout) :: kernel(-nx:nx, -ny:ny)
      integer :: k

      do k = 1, nx
         kernel(-k, l) = sign_x*kernel(k, l)
      end do
      if (l == 0) return
      do k = -nx, nx
         kernel(k, -l) = sign_y*kernel(k, l)
      end do
   end subroutine mirror_row

   !> All coefficients for observation points shifted by (shift_x, shift_y)
   subroutine fill_shifted_table(table, material, dx, dy, nx, ny, shift_x, shift_y)
      !> Receives offsets, sides and coefficients; its arrays are allocated here
      type(kernel_table), intent(inout) :: table
      !> Combined constants of both bodies
      type(combined_material), intent(in) :: material
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Maximum offsets in elements
      integer, intent(in) :: nx, ny
      !> Shift of the observation points [mm]
      real(wp), intent(in) :: shift_x, shift_y
      integer :: k, l
      real(wp) :: v(6)
      real(wp), allocatable :: corner(:, :, :)

      call shape_table(table, material, dx, dy, nx, ny)
      table%shift_x = shift_x
      table%shift_y = shift_y
      allocate(corner(5, -nx - 1:nx, -ny - 1:ny))
      !$omp parallel do private(k) if (nx*ny > largest_kept)
      do l = -ny - 1, ny
         do k = -nx - 1, nx
            corner(:, k, l) = corner_functions((k + 0.5_wp)*dx + shift_x, (l + 0.5_wp)*dy + shift_y, material%coupled())
         end do
      end do
      !$omp parallel do private(k, v) if (nx*ny > largest_kept)
      do l = -ny, ny
         do k = -nx, nx
            v = combine_corners(corner(:, k, l) - corner(:, k - 1, l) - corner(:, k, l - 1) + corner(:, k - 1, l - 1), material)
            call set_entry(table, k, l, v)
         end do
      end do
   end subroutine fill_shifted_table

   !> Set the coefficients at an offset and at its three mirror images
   pure subroutine set_mirrored(table, k, l, v)
      !> Table that contains the offset; see `shape_table`
      type(kernel_table), intent(inout) :: table
      !> Offset, not negative
      integer, intent(in) :: k, l
      !> nn, xx, yy, xy, xn, yn
      real(wp), intent(in) :: v(6)
      real(wp) :: w(6)
      integer :: i, j

      ! a coefficient that is odd in an offset is exactly zero at offset 0
      w = v
      if (k == 0 .or. l == 0) w(4) = 0.0_wp
      if (k == 0) w(5) = 0.0_wp
      if (l == 0) w(6) = 0.0_wp
      do j = -1, 1, 2
         do i = -1, 1, 2
            call set_entry(table, i*k, j*l, [w(1:3), i*j*w(4), i*w(5), j*w(6)])
         end do
      end do
   end subroutine set_mirrored

   !> Set the coefficients at an offset
   pure subroutine set_entry(table, k, l, v)
      !> Table that contains the offset; see `shape_table`
      type(kernel_table), intent(inout) :: table
      !> Offset along x and y in elements, of either sign
      integer, intent(in) :: k, l
      !> nn, xx, yy, xy, xn, yn
      real(wp), intent(in) :: v(6)

      table%nn(k, l) = v(1)
      table%xx(k, l) = v(2)
      table%yy(k, l) = v(3)
      table%xy(k, l) = v(4)
      if (.not. allocated(table%xn)) return
      table%xn(k, l) = v(5)
      table%yn(k, l) = v(6)
   end subroutine set_entry

   !> Allocate the arrays of a table for a range of offsets
   subroutine shape_table(table, material, dx, dy, nx, ny, coupled)
      !> Receives offsets, sides and arrays; coefficients are not set
      type(kernel_table), intent(inout) :: table
      !> Combined constants of both bodies, stored in the table
      type(combined_material), intent(in) :: material
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Maximum offsets in elements
      integer, intent(in) :: nx, ny
      !> Allocate coefficients xn, yn? Default: if the material is coupled
      logical, intent(in), optional :: coupled
      logical :: with_coupling

      with_coupling = material%coupled()
      if (present(coupled)) with_coupling = coupled
      if (table%nx /= nx .or. table%ny /= ny .or. (with_coupling .neqv. allocated(table%xn)) .or. .not. allocated(table%xx)) then
         if (allocated(table%nn)) deallocate(table%nn)
         if (allocated(table%xx)) deallocate(table%xx, table%yy, table%xy)
         if (allocated(table%xn)) deallocate(table%xn, table%yn)
         allocate(table%nn(-nx:nx, -ny:ny), table%xx(-nx:nx, -ny:ny), table%yy(-nx:nx, -ny:ny), &
            & table%xy(-nx:nx, -ny:ny))
         if (with_coupling) allocate(table%xn(-nx:nx, -ny:ny), table%yn(-nx:nx, -ny:ny))
      end if
      call name_table(table, material, dx, dy, nx, ny)
   end subroutine shape_table

   !> Set the parameters of a table
   pure subroutine name_table(table, material, dx, dy, nx, ny)
      !> All components except arrays and shift are set
      type(kernel_table), intent(inout) :: table
      !> Combined constants of both bodies
      type(combined_material), intent(in) :: material
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Maximum offsets in elements
      integer, intent(in) :: nx, ny

      table%nx = nx
      table%ny = ny
      table%dx = dx
      table%dy = dy
      table%material = material
   end subroutine name_table
end module contact_elastic_halfspace
