!> Fields at arbitrary points, by closed-form expressions
!>
!> As the field of an element is a difference over its corners, the sum over elements is rearranged into a sum over the corners
!> of the grid, with the mixed jumps of traction between the four elements around a corner as loads: four times fewer
!> logarithms, and none where the tractions are constant. For bilinear elements second differences at the centres replace the
!> jumps. The rearranged sum loses digits far away from all loads; there each element is integrated by quadrature of the point
!> load.
module contact_subsurface_direct
   use contact_base_kinds, only : wp
   use contact_subsurface_element_field, only : body_responses, corner_derivatives, edge_ratio, far_distance, &
      & farthest_point, load_quadrature, n_derivatives, n_fields, new_quadrature, node_derivatives, source_derivatives
   use contact_subsurface_load, only : surface_load
   implicit none (type, external)
   private

   public :: sum_directly, number_of_terms

   !> Loads of one kind, in the coordinates of the contact
   type :: load_list
      !> Positions on the surface [mm]
      real(wp), allocatable :: x(:), y(:)
      !> Loads px, py, pn, shape (3, n): jumps [N/mm2], second differences [N/mm4] or forces [N]
      real(wp), allocatable :: load(:, :)
   end type load_list

   !> Rectangle that contains all loaded elements [mm]
   type :: load_area
      real(wp) :: x0 = 0.0_wp, x1 = 0.0_wp, y0 = 0.0_wp, y1 = 0.0_wp
      !> Distance up to which the rearranged sum is used [mm]
      real(wp) :: near = 0.0_wp
   end type load_area

contains

   !> Displacements and stresses at a list of points
   !>
   !> Points with z >= 0 are in body 1, those with z < 0 in body 2. The sum for each point has a fixed order; results do not
   !> depend on the number of threads.
   subroutine sum_directly(load, position, displacement, stress)
      !> Surface tractions and constants of the bodies
      type(surface_load), intent(in) :: load
      !> Points [mm], shape (3, n)
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Displacements of the body that contains the point [mm], shape (3, n)
      real(wp), contiguous, intent(out) :: displacement(:, :)
      !> Stresses [N/mm2], tension positive: xx, xy, xz, yy, yz, zz, shape (6, n)
      real(wp), contiguous, intent(out) :: stress(:, :)
      type(load_list) :: corners, sources
      type(load_area) :: area
      real(wp) :: total(n_fields)
      integer :: point

      displacement = 0.0_wp
      stress = 0.0_wp
      if (.not. any(load%acts)) return
      call find_area(load, area)
      call collect_corners(load, corners)
      do point = 1, size(position, 2)
         if (.not. is_beyond(area, position(:, point))) cycle
         call collect_sources(load, sources)
         exit
      end do

      !$omp parallel do default(shared) private(total) schedule(dynamic, 4)
      do point = 1, size(position, 2)
         if (any(abs(position(:, point)) > farthest_point)) cycle
         if (is_beyond(area, position(:, point))) then
            call sum_sources(load, sources, position(:, point), total)
         else
            call sum_corners(load, corners, position(:, point), total)
         end if
         displacement(:, point) = total(1:3)
         stress(:, point) = total(4:9)
      end do
      !$omp end parallel do
   end subroutine sum_directly

   !> Number of closed-form terms summed per point
   pure integer function number_of_terms(load) result(n)
      !> Surface tractions; unloaded elements are not counted
      type(surface_load), intent(in) :: load
      type(load_list) :: corners

      call collect_corners(load, corners)
      n = size(corners%x)
   end function number_of_terms

   !> Extent of the loads, and range in which the rearranged sum is accurate
   pure subroutine find_area(load, area)
      type(surface_load), intent(in) :: load
      type(load_area), intent(out) :: area
      !> Range in diagonals of the loaded area, for constant and for bilinear loads
      real(wp), parameter :: diagonals_constant = 2.0_wp, diagonals_bilinear = 1.0_wp

      associate (grid => load%grid, box => load%box)
         area%x0 = grid%x(box%ix0) - 0.5_wp*grid%dx
         area%x1 = grid%x(box%ix1) + 0.5_wp*grid%dx
         area%y0 = grid%y(box%iy0) - 0.5_wp*grid%dy
         area%y1 = grid%y(box%iy1) + 0.5_wp*grid%dy
         area%near = max(far_distance(grid%dx, grid%dy, load%bilinear), &
            & merge(diagonals_bilinear, diagonals_constant, load%bilinear)*hypot(area%x1 - area%x0, area%y1 - area%y0))
      end associate
   end subroutine find_area

   !> Positions at which the tractions, or their slopes, jump
   !>
   !> Columns of absent loads remain zero; positions within an area of constant, or linear, traction are omitted.
   pure subroutine collect_corners(load, corners)
      type(surface_load), intent(in) :: load
      type(load_list), intent(out) :: corners
      real(wp), allocatable :: padded(:, :, :)
      real(wp) :: jump(3), shift
      integer :: ix, iy, last, n

      associate (grid => load%grid, box => load%box)
         ! corner (ix, iy) is at the upper end of element (ix, iy); the centre is half an element lower
         last = merge(1, 0, load%bilinear)
         shift = merge(0.0_wp, 0.5_wp, load%bilinear)
         allocate(padded(3, box%ix0 - 2:box%ix1 + 2, box%iy0 - 2:box%iy1 + 2), source=0.0_wp)
         do iy = box%iy0, box%iy1
            do ix = box%ix0, box%ix1
               padded(:, ix, iy) = load%traction(ix, iy, :)
            end do
         end do
         n = (box%ix1 - box%ix0 + 3)*(box%iy1 - box%iy0 + 3)
         allocate(corners%x(n), corners%y(n), corners%load(3, n))
         n = 0
         do iy = box%iy0 - 1, box%iy1 + last
            do ix = box%ix0 - 1, box%ix1 + last
               if (load%bilinear) then
                  jump = slope_jump(slope_jump(padded(:, ix - 1, iy - 1), padded(:, ix, iy - 1), padded(:, ix + 1, iy - 1)), &
                     & slope_jump(padded(:, ix - 1, iy), padded(:, ix, iy), padded(:, ix + 1, iy)), &
                     & slope_jump(padded(:, ix - 1, iy + 1), padded(:, ix, iy + 1), padded(:, ix + 1, iy + 1))) &
                     & /(grid%dx*grid%dy)
               else
                  jump = (padded(:, ix + 1, iy + 1) - padded(:, ix, iy + 1)) - (padded(:, ix + 1, iy) - padded(:, ix, iy))
               end if
               if (all(jump == 0.0_wp)) cycle
               n = n + 1
               corners%x(n) = grid%x(ix) + shift*grid%dx
               corners%y(n) = grid%y(iy) + shift*grid%dy
               corners%load(:, n) = jump
            end do
         end do
      end associate
      corners%x = corners%x(1:n)
      corners%y = corners%y(1:n)
      corners%load = corners%load(:, 1:n)
   end subroutine collect_corners

   !> Second difference
   elemental real(wp) function slope_jump(before, here, behind)
      real(wp), intent(in) :: before, here, behind
      slope_jump = (behind - here) - (here - before)
   end function slope_jump

   !> Quadrature points of all loaded elements
   pure subroutine collect_sources(load, sources)
      type(surface_load), intent(in) :: load
      type(load_list), intent(out) :: sources
      type(load_quadrature) :: rule
      real(wp) :: force(3)
      integer :: i, ix, iy, j, n

      rule = new_quadrature(load%bilinear)
      associate (grid => load%grid, box => load%box)
         n = size(rule%point)**2*size(load%traction)/3
         allocate(sources%x(n), sources%y(n), sources%load(3, n))
         n = 0
         do iy = box%iy0, box%iy1
            do ix = box%ix0, box%ix1
               force = load%traction(ix, iy, :)*grid%dx*grid%dy
               if (all(force == 0.0_wp)) cycle
               do j = 1, size(rule%point)
                  do i = 1, size(rule%point)
                     n = n + 1
                     sources%x(n) = grid%x(ix) + rule%point(i)*grid%dx
                     sources%y(n) = grid%y(iy) + rule%point(j)*grid%dy
                     sources%load(:, n) = rule%weight(i)*rule%weight(j)*force
                  end do
               end do
            end do
         end do
      end associate
      sources%x = sources%x(1:n)
      sources%y = sources%y(1:n)
      sources%load = sources%load(:, 1:n)
   end subroutine collect_sources

   !> Sum over the corners
   !>
   !> Reversing the y-axis exchanges the corners of an element, which changes the sign of all jumps of traction, but not of
   !> second differences.
   pure subroutine sum_corners(load, corners, position, total)
      type(surface_load), intent(in) :: load
      type(load_list), intent(in) :: corners
      !> Point in the coordinates of the contact [mm]
      real(wp), intent(in) :: position(3)
      !> Displacements and stresses
      real(wp), intent(out) :: total(n_fields)
      real(wp) :: d(n_derivatives), response(n_fields, 3), edge, mirror
      integer :: body, n

      call find_body(position(3), body, mirror)
      edge = edge_ratio*min(load%grid%dx, load%grid%dy)
      total = 0.0_wp
      do n = 1, size(corners%x)
         if (load%bilinear) then
            call node_derivatives(position(1) - corners%x(n), mirror*(position(2) - corners%y(n)), abs(position(3)), edge, d)
         else
            call corner_derivatives(position(1) - corners%x(n), mirror*(position(2) - corners%y(n)), abs(position(3)), edge, d)
         end if
         call body_responses(d, abs(position(3)), load%gg(body), load%nu(body), mirror, response)
         total = total + corners%load(1, n)*response(:, 1) + corners%load(2, n)*response(:, 2) &
            & + corners%load(3, n)*response(:, 3)
      end do
      if (.not. load%bilinear) total = mirror*total
   end subroutine sum_corners

   !> Sum over the quadrature points
   pure subroutine sum_sources(load, sources, position, total)
      type(surface_load), intent(in) :: load
      type(load_list), intent(in) :: sources
      !> Point in the coordinates of the contact [mm]
      real(wp), intent(in) :: position(3)
      !> Displacements and stresses
      real(wp), intent(out) :: total(n_fields)
      real(wp) :: d(n_derivatives), response(n_fields, 3), mirror
      integer :: body, n

      call find_body(position(3), body, mirror)
      total = 0.0_wp
      do n = 1, size(sources%x)
         call source_derivatives(position(1) - sources%x(n), mirror*(position(2) - sources%y(n)), abs(position(3)), d)
         call body_responses(d, abs(position(3)), load%gg(body), load%nu(body), mirror, response)
         total = total + sources%load(1, n)*response(:, 1) + sources%load(2, n)*response(:, 2) &
            & + sources%load(3, n)*response(:, 3)
      end do
   end subroutine sum_sources

   !> The body that contains a point
   pure subroutine find_body(z, body, mirror)
      !> Depth [mm]
      real(wp), intent(in) :: z
      !> 1 or 2
      integer, intent(out) :: body
      !> 1 or -1
      real(wp), intent(out) :: mirror

      body = merge(1, 2, z >= 0.0_wp)
      mirror = merge(1.0_wp, -1.0_wp, body == 1)
   end subroutine find_body

   !> Is a point so far from all loads that quadrature is more accurate?
   pure logical function is_beyond(area, position) result(beyond)
      type(load_area), intent(in) :: area
      real(wp), intent(in) :: position(3)

      beyond = norm2([max(area%x0 - position(1), 0.0_wp, position(1) - area%x1), &
         & max(area%y0 - position(2), 0.0_wp, position(2) - area%y1), position(3)]) > area%near
   end function is_beyond
end module contact_subsurface_direct
