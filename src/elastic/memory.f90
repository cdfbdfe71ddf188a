!> Influence coefficients of viscoelastic bodies in steady motion towards increasing x, or the mirror image of it
!>
!> A standard linear solid adds to its elastic response the memory of what its particles met
!> before. A particle that is at X now was at X + v s when s relaxation times ago, v the distance
!> travelled in one of them, so the memory coefficients are
!>
!>     M(X) = int_0^inf exp(-s) C(X + v s) ds,  C those of the late response.
!>
!> They obey M(X) = exp(-dx/v) M(X + dx) + int_0^{dx/v} exp(-s) C(X + v s) ds: one short
!> quadrature per element, marching from the largest offset to the smallest.
module contact_elastic_memory
   use contact_base_kinds, only : wp
   use contact_elastic_halfspace, only : combine_corners, corner_functions, fill_table, kernel_table
   use contact_elastic_material, only : combined_material
   use contact_elastic_model, only : fading_memory
   use contact_numeric_quadrature, only : gauss_legendre
   implicit none (type, external)
   private

   public :: fill_with_memory

   !> Everything after this many relaxation times is below round-off
   real(wp), parameter :: forgotten = 45.0_wp
   !> Longest piece of quadrature in relaxation times
   real(wp), parameter :: longest = 5.0_wp
   !> Points per piece: of smooth integrands, and next to an edge of the loaded element
   integer, parameter :: n_smooth = 12, n_edge = 20
   !> Points next to an edge crowd towards it like this power
   integer, parameter :: crowding = 4

   !> Named ends of a piece at which the integrand is not smooth
   type :: edge_list
      integer :: none = 0, first = 1, last = 2
   end type edge_list
   type(edge_list), parameter :: edge = edge_list()

   !> Quadrature rules and the fading response that is summed up
   type :: march
      type(combined_material) :: late
      real(wp) :: dx = 0.0_wp, dy = 0.0_wp, length = 1.0_wp
      real(wp) :: smooth_x(n_smooth) = 0.0_wp, smooth_w(n_smooth) = 0.0_wp
      real(wp) :: edge_x(n_edge) = 0.0_wp, edge_w(n_edge) = 0.0_wp
   end type march

contains

   !> Elastic coefficients plus memory; no symmetry in x is left
   subroutine fill_with_memory(table, material, memory, coupled, dx, dy, nx, ny)
      !> Gets offsets, sides and coefficients; its arrays are allocated here
      type(kernel_table), intent(inout) :: table
      !> Constants of the instantaneous response
      type(combined_material), intent(in) :: material
      !> The late response, and the distance travelled in a relaxation time
      type(fading_memory), intent(in) :: memory
      !> With coefficients between pressures and tangential displacements?
      logical, intent(in) :: coupled
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Largest offsets in elements
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

   !> Coefficients of motion towards decreasing x: the mirror image, in which x-components change sign
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

   !> Sum of two responses
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
      !> Distance travelled within the relaxation time [mm]
      real(wp), intent(in) :: length
      type(march) :: steps
      real(wp) :: m(6)
      integer :: k, l

      steps%late = late
      steps%dx = table%dx
      steps%dy = table%dy
      steps%length = length
      call gauss_legendre(steps%smooth_x, steps%smooth_w)
      call gauss_legendre(steps%edge_x, steps%edge_w)
      !$omp parallel do private(k, m) schedule(dynamic) if (table%nx*(table%ny + 1) > 2000)
      do l = 0, table%ny
         m = distant(steps, table%nx*table%dx, l*table%dy)
         call add_both(table, table%nx, l, m)
         do k = table%nx - 1, -table%nx, -1
            m = exp(-table%dx/length)*m + over_element(steps, k, l*table%dy)
            call add_both(table, k, l, m)
         end do
      end do
   end subroutine add_memory

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

   !> Coefficients of the late response at any point
   pure function late_response(steps, x, y) result(c)
      type(march), intent(in) :: steps
      !> Position relative to the centre of the loaded element [mm]
      real(wp), intent(in) :: x, y
      real(wp) :: c(6)
      real(wp) :: x0, x1, y0, y1
      logical :: coupled

      x0 = x - 0.5_wp*steps%dx
      x1 = x + 0.5_wp*steps%dx
      y0 = y - 0.5_wp*steps%dy
      y1 = y + 0.5_wp*steps%dy
      coupled = steps%late%coupled()
      c = combine_corners(corner_functions(x1, y1, coupled) - corner_functions(x0, y1, coupled) &
         & - corner_functions(x1, y0, coupled) + corner_functions(x0, y0, coupled), steps%late)
   end function late_response

   !> The whole integral from a distant offset on; pieces grow with the distance to the load
   pure function distant(steps, x, y) result(m)
      type(march), intent(in) :: steps
      real(wp), intent(in) :: x, y
      real(wp) :: m(6)
      real(wp) :: s, h, clearance

      m = 0.0_wp
      s = 0.0_wp
      clearance = (x - 0.5_wp*steps%dx)/steps%length
      do while (s < forgotten)
         h = min(longest, clearance + s)
         m = m + piece(steps, x, s, h, y, edge%none)
         s = s + h
      end do
   end function distant

   !> The integral across one element; the integrand has corners at its middle for the two central ones
   pure function over_element(steps, k, y) result(m)
      type(march), intent(in) :: steps
      integer, intent(in) :: k
      real(wp), intent(in) :: y
      real(wp) :: m(6)
      real(wp) :: x, half

      x = k*steps%dx
      half = 0.5_wp*steps%dx/steps%length
      select case (k)
      case (-1, 0)
         m = stretch(steps, x, 0.0_wp, half, y, edge%last) + stretch(steps, x, half, half, y, edge%first)
      case (-2, 1)
         m = stretch(steps, x, 0.0_wp, half, y, edge%none) + stretch(steps, x, half, half, y, edge%none)
      case default
         m = stretch(steps, x, 0.0_wp, 2.0_wp*half, y, edge%none)
      end select
   end function over_element

   !> Cut a stretch into pieces, and forget what is older than anything that counts
   pure function stretch(steps, x, s, h, y, sharp) result(m)
      type(march), intent(in) :: steps
      !> Where the integral begins [mm]; start and length of the stretch in relaxation times
      real(wp), intent(in) :: x, s, h, y
      !> End at which the integrand is not smooth
      integer, intent(in) :: sharp
      real(wp) :: m(6)
      real(wp) :: part
      integer :: i, n, end_

      m = 0.0_wp
      ! the last piece counts only when it is not forgotten: no more pieces than that are made
      n = ceiling(min(h, forgotten*longest)/longest)
      if (h > forgotten*longest) n = nint(forgotten*longest)
      part = h/n
      if (h > forgotten*longest) part = longest
      do i = 1, n
         if (s + (i - 1)*part > forgotten) return
         end_ = edge%none
         if (sharp == edge%first .and. i == 1) end_ = sharp
         if (sharp == edge%last .and. i == n) end_ = sharp
         m = m + piece(steps, x, s + (i - 1)*part, part, y, end_)
      end do
   end function stretch

   !> One piece by Gauss' rule
   pure function piece(steps, x, s, h, y, sharp) result(m)
      type(march), intent(in) :: steps
      real(wp), intent(in) :: x, s, h, y
      integer, intent(in) :: sharp
      real(wp) :: m(6)
      real(wp) :: t, at, weight
      integer :: i

      m = 0.0_wp
      if (sharp == edge%none) then
         do i = 1, n_smooth
            at = s + h*steps%smooth_x(i)
            m = m + h*steps%smooth_w(i)*exp(-at)*late_response(steps, x + steps%length*at, y)
         end do
         return
      end if
      do i = 1, n_edge
         t = steps%edge_x(i)**crowding
         weight = crowding*steps%edge_x(i)**(crowding - 1)
         at = s + h*merge(t, 1.0_wp - t, sharp == edge%first)
         m = m + h*weight*steps%edge_w(i)*exp(-at)*late_response(steps, x + steps%length*at, y)
      end do
   end function piece
end module contact_elastic_memory
