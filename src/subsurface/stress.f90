!> Displacements and stresses inside both bodies due to the surface tractions
!>
!> The tractions are constant per element. Since the field of an element is a signed sum over its
!> corners, the sum over elements is rearranged into one over the corners of the grid, with the
!> mixed jumps of traction between the four elements around a corner as loads: four times fewer
!> logarithms, and none where the tractions do not change. The rearranged sum loses digits far
!> away from all loads; there each element is integrated by quadrature of the point load. Layers
!> of many points at element centres use a table of responses instead.
module contact_subsurface_stress
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_subsurface_element_field, only : add_loads, combine_field, corner_derivatives, edge_ratio, &
      & far_ratio, gauss_point, gauss_weight, hooke, n_derivatives, source_derivatives, turn_back
   use contact_subsurface_layer, only : layer_end, layer_field, layer_offsets, place_layer
   implicit none (type, external)
   private

   public :: subsurface_field, stress_invariants, principal_stresses

   !> Loads of one kind, all in the coordinates of the contact
   type :: load_list
      !> Places on the surface [mm]
      real(wp), allocatable :: x(:), y(:)
      !> Loads on body 1 in x, y and z, shape (3, n): jumps [N/mm2] or forces [N]
      real(wp), allocatable :: load(:, :)
   end type load_list

   !> Rectangle that holds all loaded elements [mm]
   type :: load_box
      real(wp) :: x0 = 0.0_wp, x1 = 0.0_wp, y0 = 0.0_wp, y1 = 0.0_wp
   end type load_box

   !> Stresses below this fraction of the modulus of rigidity are rounding noise
   real(wp), parameter :: noise = 1.0e-15_wp

contains

   !> Displacements and stresses in a list of points
   !>
   !> Points with z >= 0 lie in body 1, those with z < 0 in body 2. Body 2 is treated as a
   !> half-space that is turned by half a revolution about the x-axis.
   subroutine subsurface_field(grid, pn, px, py, gg, nu, position, displacement, stress)
      type(potential_contact), intent(in) :: grid
      !> Tractions on body 1 [N/mm2], shape (mx, my); pn positive for compression
      real(wp), contiguous, intent(in) :: pn(:, :), px(:, :), py(:, :)
      !> Modulus of rigidity [N/mm2] and Poisson's ratio [-] of body 1 and 2
      real(wp), intent(in) :: gg(2), nu(2)
      !> Points [mm], shape (3, n)
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Displacements of the body that the point belongs to [mm], shape (3, n)
      real(wp), contiguous, intent(out) :: displacement(:, :)
      !> Stresses [N/mm2], tension positive: xx, xy, xz, yy, yz, zz, shape (6, n)
      real(wp), contiguous, intent(out) :: stress(:, :)
      type(load_list) :: corners, sources
      type(load_box) :: box
      type(layer_offsets) :: offsets
      real(wp) :: total(n_derivatives, 3), gradient(3, 3), edge, near, mirror
      logical, allocatable :: pending(:)
      logical :: worthwhile
      integer :: body, first, last, point

      displacement = 0.0_wp
      stress = 0.0_wp
      if (size(pn) == 0) return
      if (all(pn == 0.0_wp) .and. all(px == 0.0_wp) .and. all(py == 0.0_wp)) return
      call collect_corners(grid, pn, px, py, corners, box)
      allocate(pending(size(position, 2)), source=.true.)
      first = 1
      do while (first <= size(position, 2))
         last = layer_end(position, first)
         call place_layer(grid, position(:, first:last), size(corners%x), offsets, worthwhile)
         if (worthwhile) then
            call layer_field(grid, offsets, pn, px, py, gg, nu, position(3, first), displacement(:, first:last), &
               & stress(:, first:last))
            pending(first:last) = .false.
         end if
         first = last + 1
      end do

      edge = edge_ratio*min(grid%dx, grid%dy)
      near = max(far_ratio*max(grid%dx, grid%dy), 2.0_wp*hypot(box%x1 - box%x0, box%y1 - box%y0))
      if (any_beyond(box, near, position, pending)) call collect_sources(grid, pn, px, py, sources)

      !$omp parallel do default(shared) private(body, mirror, total, gradient) schedule(dynamic, 16)
      do point = 1, size(position, 2)
         if (.not. pending(point)) cycle
         body = merge(1, 2, position(3, point) >= 0.0_wp)
         mirror = merge(1.0_wp, -1.0_wp, body == 1)
         if (is_beyond(box, near, position(:, point))) then
            call sum_sources(sources, position(:, point), mirror, total)
         else
            call sum_corners(corners, position(:, point), mirror, edge, total)
         end if
         call combine_field(total, abs(position(3, point)), gg(body), nu(body), displacement(:, point), gradient)
         if (body == 2) call turn_back(displacement(:, point), gradient)
         stress(:, point) = hooke(gradient, gg(body), nu(body))
      end do
      !$omp end parallel do

      do point = 1, size(position, 2)
         body = merge(1, 2, position(3, point) >= 0.0_wp)
         where (abs(stress(:, point)) < noise*gg(body)) stress(:, point) = 0.0_wp
      end do
   end subroutine subsurface_field

   !> Corners of the grid at which the tractions jump
   !>
   !> For frictionless contact the columns of px and py stay zero; corners inside an area of
   !> constant traction drop out.
   subroutine collect_corners(grid, pn, px, py, corners, box)
      type(potential_contact), intent(in) :: grid
      real(wp), contiguous, intent(in) :: pn(:, :), px(:, :), py(:, :)
      type(load_list), intent(out) :: corners
      type(load_box), intent(out) :: box
      real(wp), allocatable :: padded(:, :, :)
      real(wp) :: jump(3)
      integer :: ix, iy, mx, my, n

      mx = size(pn, 1)
      my = size(pn, 2)
      allocate(padded(3, 0:mx+1, 0:my+1), source=0.0_wp)
      padded(1, 1:mx, 1:my) = px
      padded(2, 1:mx, 1:my) = py
      padded(3, 1:mx, 1:my) = pn
      allocate(corners%x((mx + 1)*(my + 1)), corners%y((mx + 1)*(my + 1)), corners%load(3, (mx + 1)*(my + 1)))
      box = load_box(huge(1.0_wp), -huge(1.0_wp), huge(1.0_wp), -huge(1.0_wp))
      n = 0
      do iy = 0, my
         do ix = 0, mx
            jump = (padded(:, ix+1, iy+1) - padded(:, ix, iy+1)) - (padded(:, ix+1, iy) - padded(:, ix, iy))
            if (all(jump == 0.0_wp)) cycle
            n = n + 1
            corners%x(n) = grid%xl + ix*grid%dx
            corners%y(n) = grid%yl + iy*grid%dy
            corners%load(:, n) = jump
            box%x0 = min(box%x0, corners%x(n))
            box%x1 = max(box%x1, corners%x(n))
            box%y0 = min(box%y0, corners%y(n))
            box%y1 = max(box%y1, corners%y(n))
         end do
      end do
      corners%x = corners%x(1:n)
      corners%y = corners%y(1:n)
      corners%load = corners%load(:, 1:n)
   end subroutine collect_corners

   !> Quadrature points of all loaded elements
   subroutine collect_sources(grid, pn, px, py, sources)
      type(potential_contact), intent(in) :: grid
      real(wp), contiguous, intent(in) :: pn(:, :), px(:, :), py(:, :)
      type(load_list), intent(out) :: sources
      real(wp) :: load(3)
      integer :: i, ix, iy, j, n

      n = 16*count(pn /= 0.0_wp .or. px /= 0.0_wp .or. py /= 0.0_wp)
      allocate(sources%x(n), sources%y(n), sources%load(3, n))
      n = 0
      do iy = 1, size(pn, 2)
         do ix = 1, size(pn, 1)
            load = [px(ix, iy), py(ix, iy), pn(ix, iy)]*grid%dx*grid%dy
            if (all(load == 0.0_wp)) cycle
            do j = 1, 4
               do i = 1, 4
                  n = n + 1
                  sources%x(n) = grid%x(ix) + gauss_point(i)*grid%dx
                  sources%y(n) = grid%y(iy) + gauss_point(j)*grid%dy
                  sources%load(:, n) = gauss_weight(i)*gauss_weight(j)*load
               end do
            end do
         end do
      end do
   end subroutine collect_sources

   !> Sum over the corners, in the frame of the body
   !>
   !> Turning the y-axis changes the sign of py for body 2, turning both axes and exchanging
   !> action and reaction changes that of px; exchanging the corners of an element changes the
   !> sign of all jumps.
   pure subroutine sum_corners(corners, position, mirror, edge, total)
      type(load_list), intent(in) :: corners
      !> Point in the coordinates of the contact [mm]
      real(wp), intent(in) :: position(3)
      !> 1 for body 1, -1 for body 2
      real(wp), intent(in) :: mirror
      !> Smallest distance to the edges that is told apart [mm]
      real(wp), intent(in) :: edge
      !> Derivatives times load
      real(wp), intent(out) :: total(n_derivatives, 3)
      real(wp) :: d(n_derivatives), factor(3)
      integer :: n

      factor = mirror*[mirror, 1.0_wp, 1.0_wp]
      total = 0.0_wp
      do n = 1, size(corners%x)
         call corner_derivatives(position(1) - corners%x(n), mirror*(position(2) - corners%y(n)), &
            & mirror*position(3), edge, d)
         call add_loads(d, factor*corners%load(:, n), total)
      end do
   end subroutine sum_corners

   !> Sum over the quadrature points, in the frame of the body
   pure subroutine sum_sources(sources, position, mirror, total)
      type(load_list), intent(in) :: sources
      !> Point in the coordinates of the contact [mm]
      real(wp), intent(in) :: position(3)
      !> 1 for body 1, -1 for body 2
      real(wp), intent(in) :: mirror
      !> Derivatives times load
      real(wp), intent(out) :: total(n_derivatives, 3)
      real(wp) :: d(n_derivatives), factor(3)
      integer :: n

      factor = [mirror, 1.0_wp, 1.0_wp]
      total = 0.0_wp
      do n = 1, size(sources%x)
         call source_derivatives(position(1) - sources%x(n), mirror*(position(2) - sources%y(n)), &
            & mirror*position(3), d)
         call add_loads(d, factor*sources%load(:, n), total)
      end do
   end subroutine sum_sources

   !> Does a point lie so far from all loads that quadrature is the better way?
   pure logical function is_beyond(box, near, position) result(beyond)
      type(load_box), intent(in) :: box
      !> Distance up to which the corner sum is used [mm]
      real(wp), intent(in) :: near
      real(wp), intent(in) :: position(3)

      beyond = norm2([max(box%x0 - position(1), 0.0_wp, position(1) - box%x1), &
         & max(box%y0 - position(2), 0.0_wp, position(2) - box%y1), position(3)]) > near
   end function is_beyond

   !> Does any of the pending points lie far from all loads?
   pure logical function any_beyond(box, near, position, pending) result(beyond)
      type(load_box), intent(in) :: box
      real(wp), intent(in) :: near
      real(wp), intent(in) :: position(:, :)
      logical, intent(in) :: pending(:)
      integer :: point

      beyond = .false.
      do point = 1, size(position, 2)
         if (pending(point)) beyond = beyond .or. is_beyond(box, near, position(:, point))
      end do
   end function any_beyond

   !> Mean stress, equivalent stresses and extreme principal stresses
   pure subroutine stress_invariants(stress, sighyd, sigvm, sigtr, sigma1, sigma3)
      !> Stresses [N/mm2]: xx, xy, xz, yy, yz, zz, shape (6, n)
      real(wp), contiguous, intent(in) :: stress(:, :)
      !> Mean stress, von Mises, Tresca, largest and smallest principal stress [N/mm2], shape (n)
      real(wp), contiguous, intent(out) :: sighyd(:), sigvm(:), sigtr(:), sigma1(:), sigma3(:)
      real(wp) :: s(6), principal(3)
      integer :: point

      do point = 1, size(stress, 2)
         s = stress(:, point)
         sighyd(point) = (s(1) + s(4) + s(6))/3.0_wp
         ! from differences, which unlike the squares of the stresses do not cancel
         sigvm(point) = sqrt(0.5_wp*((s(1) - s(4))**2 + (s(4) - s(6))**2 + (s(6) - s(1))**2) &
            & + 3.0_wp*(s(2)**2 + s(3)**2 + s(5)**2))
         principal = principal_stresses(s)
         sigma1(point) = principal(1)
         sigma3(point) = principal(3)
         sigtr(point) = principal(1) - principal(3)
      end do
   end subroutine stress_invariants

   !> Principal stresses in descending order, by Jacobi's rotations
   !>
   !> Rotations keep full relative accuracy where the closed form with a cosine loses half of
   !> the digits (nearly equal principal stresses), and need no library.
   pure function principal_stresses(stress) result(principal)
      !> Stresses [N/mm2]: xx, xy, xz, yy, yz, zz
      real(wp), intent(in) :: stress(6)
      !> Principal stresses [N/mm2]
      real(wp) :: principal(3)
      integer, parameter :: max_sweeps = 20
      real(wp) :: a(3, 3), c, s, t, theta, scale, row
      integer :: p, q, r, sweep

      scale = maxval(abs(stress))
      principal = 0.0_wp
      if (.not. scale > 0.0_wp) return
      a = reshape(stress([1, 2, 3, 2, 4, 5, 3, 5, 6])/scale, [3, 3])
      do sweep = 1, max_sweeps
         if (max(abs(a(1, 2)), abs(a(1, 3)), abs(a(2, 3))) < 0.01_wp*epsilon(1.0_wp)) exit
         do p = 1, 2
            do q = p + 1, 3
               if (abs(a(p, q)) < tiny(1.0_wp)) cycle
               r = 6 - p - q
               theta = 0.5_wp*(a(q, q) - a(p, p))
               t = a(p, q)/(theta + sign(hypot(theta, a(p, q)), theta))
               c = 1.0_wp/sqrt(1.0_wp + t**2)
               s = t*c
               a(p, p) = a(p, p) - t*a(p, q)
               a(q, q) = a(q, q) + t*a(p, q)
               a(p, q) = 0.0_wp
               a(q, p) = 0.0_wp
               row = a(p, r)
               a(p, r) = c*row - s*a(q, r)
               a(q, r) = s*row + c*a(q, r)
               a(r, p) = a(p, r)
               a(r, q) = a(q, r)
            end do
         end do
      end do
      principal(1) = max(a(1, 1), a(2, 2), a(3, 3))
      principal(3) = min(a(1, 1), a(2, 2), a(3, 3))
      principal(2) = max(min(a(1, 1), a(2, 2)), min(max(a(1, 1), a(2, 2)), a(3, 3)))
      principal = scale*principal
   end function principal_stresses
end module contact_subsurface_stress
