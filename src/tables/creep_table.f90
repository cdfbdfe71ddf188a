!> Creep forces from a table: cubic splines of shape and creepages, continuously differentiable and never above mu Fn
!>
!> For half-spaces of the same material with Hertzian pressure, forces depend on a few parameters only (Kalker 1967; 1996). With
!> semi-axes a along rolling and b across, g = a/b, c = sqrt(a b), q = G a b/(mu Fn),
!>
!>     Fx, Fy, Mz/c = mu Fn f(u, g),   u = q (KX xi, KY eta, c KP phi),
!>
!> where KX, KY, KP are about C11/3, C22/3, C23 of Kalker's linear theory: the creep curve of Vermeulen and Johnson, 1 - (1 -
!> u1)**3, saturates at u1 = 1. The full range of creepages, up to infinity, is mapped to
!>
!>     v1 = u1/sqrt(1 + (k1 u3)**2),  v2 = u2/sqrt(1 + (k2 u3)**2),   k1 = KX/(sqrt(g) KP),  k2 = sqrt(g) KY/KP,
!>     x = v1/(1 + r),  y = v2/(1 + r),  z = u3/(1 + |u3|),   r = (v1**4 + v2**4)**(1/4):
!>
!> in which that curve starts without a quadratic term. Infinite r is sliding without spin, z = 1 is infinite spin; the slip
!> then rotates about the point with coordinates (v2, v1) along and across, relative to the semi-axes. The forces have a bend
!> where this point leaves the contact, at x and y of 1/2. Strips of a contact lose adhesion at u3 of about 1 (Kalker's strip
!> theory), where forces have a sharp bend near a plane of constant z.
!>
!> Creepages and moment of half ellipses refer to the centre of pressure: there sliding without spin has no moment, and forces
!> at large creepages are even functions of 1/r, as for ellipses.
!>
!> f is a spline for u1 >= 0 and u3 >= 0. The other values follow from two symmetries: all creepages and forces change sign
!> together, and the mirror image y -> -y changes the sign of eta, phi, Fy, Mz and of the offset of half ellipses.
module contact_tables_creep_table
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use, intrinsic :: iso_c_binding, only : c_double, c_float, c_int
   use, intrinsic :: iso_fortran_env, only : real32
   use contact_base_kinds, only : wp
   use contact_tables_axis, only : find_basis, order, spline_axis
   implicit none (type, external)
   private

   public :: creep_table, find_creep_force, max_spin, scaled_creepages

   !> Values per node: Fx, Fy, Mz
   integer, parameter, public :: values_per_node = 3
   !> Number of values of a row of nodes along z
   integer, parameter :: stretch = values_per_node*order
   !> Scaled creepages beyond this are practically infinite, and their fourth powers do not overflow [-]
   real(wp), parameter :: infinite = 1.0e15_wp
   !> Numbers of a contact are at most this, its lengths and modulus at least the inverse, in any unit: no product of them overflows
   real(wp), parameter :: largest_number = 1.0e40_wp
   !> Creepages, and q, are limited to this: far beyond sliding for any contact
   real(wp), parameter :: largest_creepage = 1.0e100_wp
   !> A shape that exceeds the range of a table by less than this is on its border: round-off of ratios [-]
   real(wp), parameter :: edge = 1.0e-9_wp
   !> KX, KY and KP as polynomials of g: Kalker's C11/3, C22/3 and C23 for a Poisson ratio of 1/4, within some per cent for 0.1
   !> <= g <= 10. They serve as scales only, and are part of the file format
   real(wp), parameter :: scale_x(3) = [1.0964_wp, 0.325_wp, -0.004_wp], scale_y(3) = [0.8005_wp, 0.4393_wp, -0.0067_wp], &
      & scale_spin(4) = [0.4147_wp, 1.0184_wp, 0.0565_wp, -0.0013_wp]

   !> Outcome of a look-up
   type :: lookup_status_list
      !> Within the table; outside its range of shapes, where the nearest shape is used; invalid arguments, no forces
      integer :: inside = 0, outside = 1, invalid = 2
   end type lookup_status_list
   !> Members of lookup_status_list
   type(lookup_status_list), parameter, public :: lookup_status = lookup_status_list()

   !> A table
   type :: creep_table
      !> Is it for half ellipses rather than for ellipses?
      logical :: has_offset = .false.
      !> Poisson ratio of the bodies [-]
      real(wp) :: nu = 0.0_wp
      !> Forces up to 1 - band are those of the spline, larger ones are smoothly limited to 1, in units of mu Fn [-]
      real(wp) :: band = 0.0_wp
      !> Requested bound of the errors, largest errors found at points that were not used to make the table, relative to mu Fn
      !> for forces and to mu Fn c for the moment [-]; number of these points
      real(wp) :: required = 0.0_wp, error_force = 0.0_wp, error_moment = 0.0_wp, checked = 0.0_wp
      !> Largest difference from results with three times as many elements per side, forces and moment [-]
      real(wp) :: grid_force = 0.0_wp, grid_moment = 0.0_wp
      !> Elements per side, and order of their discretisation
      integer :: elements = 0, discretisation = 0
      !> log(g), offset (bpos - bneg)/(bpos + bneg), x, y, z
      type(spline_axis) :: shape, offset, x, y, z
      !> Coefficients: values of a node first, then along z, y, x, offset, shape; single precision, as look-ups are limited by
      !> memory access
      real(real32), allocatable :: coefficients(:)
   end type creep_table

   interface
      !> Sum over nodes along all axes except z; in sums.c
      pure subroutine contact_sums_of_nodes(coefficients, blocks, start, weight, row, plane, x, y, sums, slope_x, slope_y) bind(c)
         import :: c_double, c_float, c_int, order, stretch
         !> Coefficients of the table
         real(c_float), intent(in) :: coefficients(*)
         !> Number of blocks of nodes along x, y, z; number of coefficients before each block, and its weight
         integer(c_int), value :: blocks
         integer(c_int), intent(in) :: start(order**2)
         real(c_double), intent(in) :: weight(order**2)
         !> Stride in coefficients between nodes along y, and along x
         integer(c_int), value :: row, plane
         !> Basis functions along x and y
         real(c_double), intent(in) :: x(order), y(order)
         !> Sums, and with slopes also those for the derivatives with respect to x and y
         real(c_double), intent(inout) :: sums(stretch, 3)
         !> Slopes of the basis functions; absent: no derivatives
         real(c_double), intent(in), optional :: slope_x(order), slope_y(order)
      end subroutine contact_sums_of_nodes
   end interface

contains

   !> Forces on body 1 in steady rolling towards positive x
   pure subroutine find_creep_force(table, fn, mu, gg, aa, bneg, bpos, creep, force, status, slopes)
      !> Splines over all axes, from read_table
      type(creep_table), intent(in) :: table
      !> Normal force [N], coefficient of friction [-], modulus of rigidity [N/mm2]; forces are zero without normal force or
      !> friction. These and the lengths are at most 1e40, modulus and lengths at least 1e-40
      real(wp), intent(in) :: fn, mu, gg
      !> Semi-axis along x, extents towards negative and positive y from the longest row [mm]
      real(wp), intent(in) :: aa, bneg, bpos
      !> Longitudinal and lateral creepage [-], spin [rad/mm]
      real(wp), intent(in) :: creep(3)
      !> Fx, Fy [N], Mz [N mm]
      real(wp), intent(out) :: force(3)
      !> Member of lookup_status
      integer, intent(out) :: status
      !> Derivatives of each force (first index) with respect to each creepage; absent: not computed
      real(wp), intent(out), optional :: slopes(3, 3)
      real(wp) :: bb, c, arm, offset, scale(3), factor(3), turn(2), u(3), f(3), df(3, 3), unit(3), sizes(4), stiff, &
         & limited(3), sign_x, sign_s
      logical :: is_beyond
      integer :: j

      force = 0.0_wp
      if (present(slopes)) slopes = 0.0_wp
      status = lookup_status%invalid
      sizes = [gg, aa, bneg, bpos]
      ! comparisons with NaN would stop a host that traps invalid operations
      if (.not. (all(ieee_is_finite(creep)) .and. all(ieee_is_finite([fn, mu, sizes])))) return
      if (.not. (all(abs([fn, mu]) <= largest_number) .and. all(sizes >= 1.0_wp/largest_number .and. sizes <= largest_number))) &
         & return
      status = lookup_status%inside
      if (fn <= 0.0_wp .or. mu <= 0.0_wp) return
      bb = 0.5_wp*(bneg + bpos)
      c = sqrt(aa*bb)
      offset = (bpos - bneg)/(bpos + bneg)
      ! from the midpoint of the extents to the centre of pressure; that of each half is at 3/8 of its extent
      arm = (bneg - bpos)/8.0_wp
      scale = scaled_creepages(aa/bb)
      turn = [scale(1)*bb, scale(2)*aa]/(c*scale(3))
      stiff = gg*aa*bb
      factor = scale*(stiff/max(mu*fn, stiff/largest_creepage))
      factor(3) = factor(3)*c
      limited = min(max(creep, -largest_creepage), largest_creepage)
      u = min(max(factor*[limited(1) - arm*limited(3), limited(2:3)], -infinite), infinite)
      ! map to the part covered by the table
      sign_x = sign(1.0_wp, u(1))
      sign_s = sign(1.0_wp, u(3))
      u = u*[sign_x, sign_s, sign_s]
      ! for a table with limited spin: forces are constant beyond it
      is_beyond = u(3) > max_spin(table)
      if (is_beyond) u(3) = max_spin(table)
      unit = mu*fn*[sign_x, sign_s, sign_s*c]
      if (present(slopes)) then
         call evaluate(table, log(aa/bb), sign_x*sign_s*offset, u, turn, f, status, df)
         if (is_beyond) df(:, 3) = 0.0_wp
         call limit_to_friction(table%band, f, df)
      else
         call evaluate(table, log(aa/bb), sign_x*sign_s*offset, u, turn, f, status)
         call limit_to_friction(table%band, f)
      end if
      if (is_beyond) status = lookup_status%outside
      force = unit*f
      force(3) = force(3) - arm*force(1)
      if (.not. present(slopes)) return
      factor = factor*[sign_x, sign_s, sign_s]
      do j = 1, 3
         slopes(:, j) = unit*df(:, j)*factor(j)
      end do
      slopes(:, 3) = slopes(:, 3) - arm*slopes(:, 1)
      slopes(3, :) = slopes(3, :) - arm*slopes(1, :)
   end subroutine find_creep_force

   !> Maximum scaled spin of a table [-]; huge: unlimited
   pure real(wp) function max_spin(table)
      !> Splines over all axes, from read_table
      type(creep_table), intent(in) :: table

      max_spin = huge(max_spin)
      if (table%z%high < 1.0_wp) max_spin = table%z%high/(1.0_wp - table%z%high)
   end function max_spin

   !> KX, KY and KP for a given ratio of semi-axes [-]
   pure function scaled_creepages(g) result(scales)
      !> a/b [-]
      real(wp), intent(in) :: g
      real(wp) :: scales(3), inside
      real(wp), parameter :: narrowest = 0.05_wp, widest = 20.0_wp

      ! within the range of validity of the polynomials
      inside = min(max(g, narrowest), widest)
      scales(1) = scale_x(1) + inside*(scale_x(2) + inside*scale_x(3))
      scales(2) = scale_y(1) + inside*(scale_y(2) + inside*scale_y(3))
      scales(3) = scale_spin(1) + inside*(scale_spin(2) + inside*(scale_spin(3) + inside*scale_spin(4)))
   end function scaled_creepages

   !> The spline, and its derivatives with respect to the scaled creepages
   pure subroutine evaluate(table, shape, offset, u, turn, f, status, df)
      type(creep_table), intent(in) :: table
      !> log(g), offset, scaled creepages; the first and third are not negative
      real(wp), intent(in) :: shape, offset, u(3)
      !> k1 and k2, the ratios of u1 and u2 to spin
      real(wp), intent(in) :: turn(2)
      !> Values
      real(wp), intent(out) :: f(3)
      integer, intent(inout) :: status
      !> Derivatives of each value (first index) with respect to each scaled creepage
      real(wp), intent(out), optional :: df(3, 3)
      real(wp) :: r, r1, r2, whole, largest, s(2), v(2), place(3), inner(3, 3)
      real(wp), dimension(values_per_node) :: by_x, by_y, by_z
      real(wp), dimension(order, 5) :: basis, slope
      integer :: first(5)

      if (shape < table%shape%low - edge .or. shape > table%shape%high + edge) status = lookup_status%outside
      if (abs(offset) > table%offset%high + edge) status = lookup_status%outside
      s = sqrt(1.0_wp + (turn*u(3))**2)
      v = u(:2)/s
      largest = max(v(1), abs(v(2)))
      r = 0.0_wp
      r1 = 0.0_wp
      r2 = 0.0_wp
      if (largest > 0.0_wp) then
         r = sqrt(sqrt((v(1)/largest)**4 + (v(2)/largest)**4))
         r1 = (v(1)/largest/r)**3
         r2 = (v(2)/largest/r)**3
         r = r*largest
      end if
      whole = 1.0_wp + r
      place = [v(1)/whole, v(2)/whole, u(3)/(1.0_wp + u(3))]
      call find_basis(table%shape, shape, first(1), basis(:, 1), slope(:, 1))
      call find_basis(table%offset, offset, first(2), basis(:, 2), slope(:, 2))
      call find_basis(table%x, place(1), first(3), basis(:, 3), slope(:, 3))
      call find_basis(table%y, place(2), first(4), basis(:, 4), slope(:, 4))
      call find_basis(table%z, place(3), first(5), basis(:, 5), slope(:, 5))
      if (.not. present(df)) then
         call sum_nodes(table, first, basis, slope, f)
         return
      end if
      call sum_nodes(table, first, basis, slope, f, by_x, by_y, by_z)
      ! derivatives of the arguments (first index) with respect to v1, v2 and u3, then to u
      inner = reshape([(1.0_wp - place(1)*r1)/whole, -place(2)*r1/whole, 0.0_wp, -place(1)*r2/whole, &
         & (1.0_wp - place(2)*r2)/whole, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp/(1.0_wp + u(3))**2], [3, 3])
      inner(:, 3) = inner(:, 3) - matmul(inner(:, :2), v*(turn/s)**2)*u(3)
      inner(:, 1) = inner(:, 1)/s(1)
      inner(:, 2) = inner(:, 2)/s(2)
      df = matmul(reshape([by_x, by_y, by_z], [3, 3]), inner)
   end subroutine evaluate

   !> Starts of the blocks of nodes around an argument, and their weights along shape and offset, whose derivatives are not
   !> needed
   pure subroutine find_blocks(table, first, basis, blocks, start, weight)
      type(creep_table), intent(in) :: table
      !> Index of the first coefficient along shape, offset, x, y, z
      integer, intent(in) :: first(5)
      !> Basis functions along shape and offset
      real(wp), intent(in) :: basis(order, 2)
      !> Number of blocks of nodes along x, y, z; number of coefficients before each block, and its weight
      integer, intent(out) :: blocks, start(order**2)
      real(wp), intent(out) :: weight(order**2)
      integer :: l, m, plane

      plane = values_per_node*table%z%count*table%y%count
      blocks = 0
      do l = 1, min(order, table%shape%count)
         do m = 1, min(order, table%offset%count)
            blocks = blocks + 1
            weight(blocks) = basis(l, 1)*basis(m, 2)
            start(blocks) = (((first(1) + l - 2)*table%offset%count + first(2) + m - 2)*table%x%count + first(3) - 1)*plane &
               & + ((first(4) - 1)*table%z%count + first(5) - 1)*values_per_node
         end do
      end do
   end subroutine find_blocks

   !> The spline, and optionally its derivatives
   pure subroutine sum_nodes(table, first, basis, slope, value, by_x, by_y, by_z)
      type(creep_table), intent(in) :: table
      !> Index of the first coefficient along shape, offset, x, y, z
      integer, intent(in) :: first(5)
      !> Basis functions and slopes along all axes
      real(wp), intent(in) :: basis(order, 5), slope(order, 5)
      !> The spline and its derivatives with respect to x, y, z, for all values
      real(wp), intent(out) :: value(values_per_node)
      real(wp), dimension(values_per_node), intent(out), optional :: by_x, by_y, by_z
      real(wp) :: weight(order**2), sums(stretch, 3)
      integer :: start(order**2), blocks, row, plane

      call find_blocks(table, first, basis(:, 1:2), blocks, start, weight)
      row = values_per_node*table%z%count
      plane = row*table%y%count
      if (present(by_x)) then
         call contact_sums_of_nodes(table%coefficients, blocks, start, weight, row, plane, basis(:, 3), basis(:, 4), sums, &
            & slope(:, 3), slope(:, 4))
         by_x = along_z(sums(:, 2), basis(:, 5))
         by_y = along_z(sums(:, 3), basis(:, 5))
         by_z = along_z(sums(:, 1), slope(:, 5))
      else
         call contact_sums_of_nodes(table%coefficients, blocks, start, weight, row, plane, basis(:, 3), basis(:, 4), sums)
      end if
      value = along_z(sums(:, 1), basis(:, 5))
   end subroutine sum_nodes

   !> Combine a row of nodes with functions along z
   pure function along_z(sums, weight) result(value)
      !> Values of the nodes
      real(wp), intent(in) :: sums(values_per_node, order)
      !> Basis functions or slopes
      real(wp), intent(in) :: weight(order)
      real(wp) :: value(values_per_node)
      integer :: k

      value = 0.0_wp
      do k = 1, order
         value = value + weight(k)*sums(:, k)
      end do
   end function along_z

   !> Limit forces above 1 - band smoothly to 1, with continuous slope
   pure subroutine limit_to_friction(band, f, df)
      real(wp), intent(in) :: band
      real(wp), intent(inout) :: f(3)
      !> Derivatives; absent: not needed
      real(wp), intent(inout), optional :: df(3, 3)
      real(wp), parameter :: rounding = 4.0_wp*epsilon(1.0_wp)
      real(wp) :: size_, ratio, change, grows(3)
      integer :: j

      size_ = norm2(f(:2))
      if (size_ <= 1.0_wp - band) return
      if (size_ < 1.0_wp + band) then
         ratio = (size_ - (size_ - 1.0_wp + band)**2/(4.0_wp*band))/size_
         ! derivative of the ratio with respect to the magnitude
         change = ((1.0_wp - (size_ - 1.0_wp + band)/(2.0_wp*band)) - ratio)/size_
      else
         ratio = 1.0_wp/size_
         change = -ratio/size_
      end if
      if (present(df)) then
         grows = (f(1)*df(1, :) + f(2)*df(2, :))/size_
         do j = 1, 3
            df(:2, j) = ratio*df(:2, j) + f(:2)*(change*grows(j))
         end do
      end if
      f(:2) = ratio*f(:2)
      ! allow for round-off, here and in the multiplication by the friction bound
      size_ = norm2(f(:2))
      if (size_ > 1.0_wp - rounding) f(:2) = f(:2)*((1.0_wp - rounding)/size_)
   end subroutine limit_to_friction
end module contact_tables_creep_table
