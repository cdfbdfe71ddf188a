!> Influence coefficients of viscoelastic bodies in steady motion towards increasing x, or its mirror image
!>
!> A standard linear solid adds to its elastic response the memory of the loads that its particles experienced before. A
!> particle now at X was at X + v s a time of s relaxation times ago, where v is the distance travelled in one relaxation time.
!> The memory coefficients are
!>
!> M(X) = int_0^inf exp(-s) C(X + v s) ds,  with C the coefficients of the late response.
!>
!> They satisfy M(X) = exp(-dx/v) M(X + dx) + int_0^{dx/v} exp(-s) C(X + v s) ds: one short quadrature per element, marching
!> from the largest offset to the smallest. C is a mixed difference of corner functions, and so are these integrals: they are
!> computed once per corner, with the number of Gauss points required by its distance from the load.
module contact_elastic_memory
   use contact_base_kinds, only : wp
   use contact_elastic_corners, only : combine_corners, corner_functions
   use contact_elastic_halfspace, only : fill_table, kernel_table
   use contact_elastic_material, only : combined_material
   use contact_elastic_model, only : fading_memory
   use contact_numeric_quadrature, only : gauss_legendre
   implicit none (type, external)
   private

   public :: fill_with_memory

   !> After this number of relaxation times contributions are below round-off
   real(wp), parameter :: forgotten = 45.0_wp
   !> Maximum length of a quadrature interval in relaxation times
   real(wp), parameter :: longest = 5.0_wp
   !> Number of points per interval: beyond the window, next to an edge of the loaded element, and maximum and minimum elsewhere
   integer, parameter :: n_distant = 12, n_edge = 20, n_most = 16, n_least = 4
   !> Natural logarithm of the ratio of the integral to the quadrature error
   real(wp), parameter :: exactness = 37.0_wp
   !> Signs of the corner functions under reflection in y
   real(wp), parameter :: mirrored(5) = [-1.0_wp, -1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp]
   !> Exponent of the concentration of points near an edge
   integer, parameter :: crowding = 4

   !> Number of coefficients from which on threads share the rows; chosen
   integer, parameter :: worth_threads = 2000

   !> Ends of an interval at which the integrand is not smooth
   type :: edge_list
      integer :: none = 0, first = 1, last = 2
   end type edge_list
   type(edge_list), parameter :: edge = edge_list()

   !> Abscissae and weights of a Gauss rule
   type :: gauss_rule
      integer :: n = 0
      real(wp) :: x(n_edge) = 0.0_wp, w(n_edge) = 0.0_wp
   end type gauss_rule

   !> Quadrature rules, and the fading response to be integrated
   type :: march
      type(combined_material) :: late
      real(wp) :: dx = 0.0_wp, dy = 0.0_wp, length = 1.0_wp
      type(gauss_rule) :: distant, edge
   end type march

contains

   !> Elastic coefficients plus memory; they are not symmetric in x
   subroutine fill_with_memory(table, material, memory, coupled, dx, dy, nx, ny)
      !> Receives offsets, sides and coefficients; its arrays are allocated here
      type(kernel_table), intent(inout) :: table
      !> Constants of the instantaneous response
      type(combined_material), intent(in) :: material
      !> Late response, and distance travelled in a relaxation time
      type(fading_memory), intent(in) :: memory
      !> Include coefficients between pressures and tangential displacements?
      logical, intent(in) :: coupled
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Maximum offsets in elements
      integer, intent(in) :: nx, ny
      integer :: a

      call fill_table(table, material, dx, dy, nx, ny)
      if (coupled .and. .not. allocated(table%xn)) then
         allocate(table%xn, table%yn, mold=table%nn)
         table%xn = 0.0_wp
         table%yn = 0.0_wp
      end if
      if (memory%length(1) > 0.0_wp .and. memory%length(1) == memory%length(2)) then
         call add_memory(table, together(memory%late), memory%length(1))
      else
         do a = 1, 2
            if (memory%length(a) > 0.0_wp) call add_memory(table, memory%late(a), memory%length(a))
         end do
      end if
      if (memory%direction < 0) call turn_around(table)
   end subroutine fill_with_memory

   !> Coefficients for motion towards decreasing x: the mirror image, in which x-components change sign
   pure subroutine turn_around(table)
      type(kernel_table), intent(inout) :: table

      table%nn = table%nn(table%nx:-table%nx:-1, :)
      table%xx = table%xx(table%nx:-table%nx:-1, :)
      table%yy = table%yy(table%nx:-table%nx:-1, :)
      table%xy = -table%xy(table%nx:-table%nx:-1, :)
      if (.not. allocated(table%xn)) return
      table%xn = -table%xn(table%nx:-table%nx:-1, :)
      table%yn = table%yn(table%nx:-table%nx:-1, :)
   end subroutine turn_around

   !> Sum of the responses of both bodies
   pure function together(late) result(both)
      type(combined_material), intent(in) :: late(2)
      type(combined_material) :: both

      both%gg = 1.0_wp/sum(1.0_wp/late%gg)
      both%nu = both%gg*sum(late%nu/late%gg)
      both%ak = both%gg*sum(late%ak/late%gg)
   end function together

   !> Add one fading response
   subroutine add_memory(table, late, length)
      type(kernel_table), intent(inout) :: table
      type(combined_material), intent(in) :: late
      !> Distance travelled in the relaxation time [mm]
      real(wp), intent(in) :: length
      type(march) :: steps
      type(gauss_rule), allocatable :: rules(:)
      !> Integrals across an element from each corner; and differences along x of the integrals from the end of the window
      real(wp), allocatable :: corner(:, :, :), behind(:, :)
      real(wp) :: y
      integer :: k, l

      steps%late = late
      steps%dx = table%dx
      steps%dy = table%dy
      steps%length = length
      steps%distant = rule_of(n_distant)
      steps%edge = rule_of(n_edge)
      allocate(rules(-table%nx - 1:table%nx), corner(5, -table%nx - 1:table%nx, -1:table%ny), behind(5, -1:table%ny))
      do k = -table%nx - 1, table%nx
         rules(k) = rule_of(enough_points(2.0_wp*max(1, abs(k + 1)), min(longest, table%dx/length)))
      end do
      !$omp parallel do private(k, y) schedule(dynamic) if (table%nx*(table%ny + 1) > worth_threads)
      do l = 0, table%ny
         y = (l + 0.5_wp)*table%dy
         behind(:, l) = distant(steps, table%nx*table%dx, y)
         do k = -table%nx - 1, table%nx - 1
            corner(:, k, l) = over_element(steps, rules(k), k, y)
         end do
      end do
      corner(:, :table%nx - 1, -1) = spread(mirrored, 2, 2*table%nx + 1)*corner(:, :table%nx - 1, 0)
      behind(:, -1) = mirrored*behind(:, 0)
      !$omp parallel do if (table%nx*(table%ny + 1) > worth_threads)
      do l = 0, table%ny
         call march_along(l)
      end do

   contains

      !> Coefficients of a row, from its end on
      subroutine march_along(l)
         integer, intent(in) :: l
         real(wp) :: m(6)
         integer :: k

         m = combine_corners(behind(:, l) - behind(:, l - 1), late)
         call add_both(table, table%nx, l, m)
         do k = table%nx - 1, -table%nx, -1
            m = exp(-table%dx/length)*m + combine_corners(corner(:, k, l) - corner(:, k - 1, l) - corner(:, k, l - 1) &
               & + corner(:, k - 1, l - 1), late)
            call add_both(table, k, l, m)
         end do
      end subroutine march_along
   end subroutine add_memory

   !> Gauss rule with n points
   pure type(gauss_rule) function rule_of(n) result(rule)
      !> Number of points, at most the size of the rule
      integer, intent(in) :: n

      rule%n = n
      call gauss_legendre(rule%x(:n), rule%w(:n))
   end function rule_of

   !> Number of Gauss points for exp(-s) times a function whose nearest singularity is on the axis
   !>
   !> With n points the error is about that of the best polynomial of degree 2n: rho^-2n times the maximum on the ellipse around
   !> the interval whose semi-axes have the sum rho, for any such ellipse that excludes the singularity.
   pure integer function enough_points(distance, h) result(n)
      !> Distance of the singularity from the centre of the interval, in half lengths; at least 1
      real(wp), intent(in) :: distance
      !> Length of the interval in relaxation times
      real(wp), intent(in) :: h
      real(wp) :: rho

      do n = n_least, n_most - 1
         rho = max(1.0_wp, min(distance + sqrt(distance**2 - 1.0_wp), 8*n/h))
         if (2*n*log(rho) - 0.25_wp*h*rho >= exactness) return
      end do
   end function enough_points

   !> Add coefficients at an offset and at its mirror image in y
   subroutine add_both(table, k, l, m)
      type(kernel_table), intent(inout) :: table
      integer, intent(in) :: k, l
      !> nn, xx, yy, xy, xn, yn
      real(wp), intent(in) :: m(6)

      call add(l, 1)
      if (l > 0) call add(-l, -1)

   contains

      subroutine add(row, sign_)
         integer, intent(in) :: row, sign_

         table%nn(k, row) = table%nn(k, row) + m(1)
         table%xx(k, row) = table%xx(k, row) + m(2)
         table%yy(k, row) = table%yy(k, row) + m(3)
         if (l > 0) table%xy(k, row) = table%xy(k, row) + sign_*m(4)
         if (.not. allocated(table%xn)) return
         table%xn(k, row) = table%xn(k, row) + m(5)
         if (l > 0) table%yn(k, row) = table%yn(k, row) + sign_*m(6)
      end subroutine add
   end subroutine add_both

   !> Differences along x of the integrals from a distant offset; intervals grow with the distance from the load
   !>
   !> Far from the window the corner functions are much larger than their differences, so that the differences are taken first.
   pure function distant(steps, x, y) result(m)
      type(march), intent(in) :: steps
      !> Centre of an element; row of corners [mm]
      real(wp), intent(in) :: x, y
      real(wp) :: m(5)
      real(wp) :: s, h, at, clearance
      integer :: i
      logical :: coupled

      coupled = steps%late%coupled()
      m = 0.0_wp
      s = 0.0_wp
      clearance = (x - 0.5_wp*steps%dx)/steps%length
      do while (s < forgotten)
         h = min(longest, clearance + s)
         do i = 1, steps%distant%n
            at = s + h*steps%distant%x(i)
            m = m + h*steps%distant%w(i)*exp(-at)*(corner_functions(x + steps%length*at + 0.5_wp*steps%dx, y, coupled) &
               & - corner_functions(x + steps%length*at - 0.5_wp*steps%dx, y, coupled))
         end do
         s = s + h
      end do
   end function distant

   !> The integral across one element from a corner; the integrand of the corner behind the load has an edge in its middle
   pure function over_element(steps, rule, k, y) result(m)
      type(march), intent(in) :: steps
      !> Rule for intervals without an edge
      type(gauss_rule), intent(in) :: rule
      !> The corner is half an element before the centre of this element
      integer, intent(in) :: k
      !> Row of corners [mm]
      real(wp), intent(in) :: y
      real(wp) :: m(5)
      real(wp) :: x, half

      x = (k + 0.5_wp)*steps%dx
      half = 0.5_wp*steps%dx/steps%length
      if (k == -1) then
         m = stretch(steps, rule, x, 0.0_wp, half, y, edge%last) + stretch(steps, rule, x, half, half, y, edge%first)
      else
         m = stretch(steps, rule, x, 0.0_wp, 2.0_wp*half, y, edge%none)
      end if
   end function over_element

   !> Divide a range into intervals, and omit those that have faded below round-off
   pure function stretch(steps, rule, x, s, h, y, sharp) result(m)
      type(march), intent(in) :: steps
      type(gauss_rule), intent(in) :: rule
      !> Start of the integral [mm]; start and length of the range in relaxation times
      real(wp), intent(in) :: x, s, h, y
      !> End at which the integrand is not smooth
      integer, intent(in) :: sharp
      real(wp) :: m(5)
      real(wp) :: part
      integer :: i, n, end_

      m = 0.0_wp
      ! an interval is included only if it has not faded, which limits their number
      n = ceiling(min(h, forgotten*longest)/longest)
      if (h > forgotten*longest) n = nint(forgotten*longest)
      part = h/n
      if (h > forgotten*longest) part = longest
      do i = 1, n
         if (s + (i - 1)*part > forgotten) return
         end_ = edge%none
         if (sharp == edge%first .and. i == 1) end_ = sharp
         if (sharp == edge%last .and. i == n) end_ = sharp
         m = m + piece(steps, rule, x, s + (i - 1)*part, part, y, end_)
      end do
   end function stretch

   !> Integrate one interval by Gauss quadrature
   pure function piece(steps, rule, x, s, h, y, sharp) result(m)
      type(march), intent(in) :: steps
      type(gauss_rule), intent(in) :: rule
      real(wp), intent(in) :: x, s, h, y
      integer, intent(in) :: sharp
      real(wp) :: m(5)
      real(wp) :: t, at, weight
      integer :: i
      logical :: coupled

      coupled = steps%late%coupled()
      m = 0.0_wp
      if (sharp == edge%none) then
         do i = 1, rule%n
            at = s + h*rule%x(i)
            m = m + h*rule%w(i)*exp(-at)*corner_functions(x + steps%length*at, y, coupled)
         end do
         return
      end if
      do i = 1, steps%edge%n
         t = steps%edge%x(i)**crowding
         weight = crowding*steps%edge%x(i)**(crowding - 1)
         at = s + h*merge(t, 1.0_wp - t, sharp == edge%first)
         m = m + h*weight*steps%edge%w(i)*exp(-at)*corner_functions(x + steps%length*at, y, coupled)
      end do
   end function piece
end module contact_elastic_memory
