!> Fields at element centres, layer by layer, by fast Fourier transforms
!>
!> The response at a centre to a load on an element depends only on the differences of their columns and rows, so that the
!> fields at one depth are convolutions. The tractions are transformed once for all depths; the 27 responses at a depth, nine
!> fields by three tractions, in packs of up to four (contact_subsurface_response_packs). Only the nine fields are transformed
!> back. Depths are independent and shared among threads. Consecutive cases may keep the spectra of the responses.
module contact_subsurface_layers
   use contact_base_kinds, only : wp
   use contact_fft_plan, only : fast_size, fft_plan
   use contact_grid_potential_contact, only : potential_contact
   use contact_subsurface_element_field, only : body_responses, corner_derivatives, edge_ratio, far_distance, &
      & farthest_point, load_quadrature, n_derivatives, n_fields, new_quadrature, node_derivatives, odd_in_y, &
      & source_derivatives
   use contact_subsurface_load, only : surface_load
   use contact_subsurface_response_packs, only : add_products, choose_packs, group, n_parts, response_pack, transform_pack
   use contact_subsurface_response_shelf, only : response_shelf
   !$ use omp_lib, only : omp_get_max_threads
   implicit none (type, external)
   private

   public :: transform_layers, padded_size

   !> The window that contains loads and points, and its padding
   type :: layer_window
      !> First column and row, and size
      integer :: ix0 = 1, iy0 = 1, mx = 0, my = 0
      !> Maximum differences of columns and rows between a point and a load
      integer :: nx = 0, ny = 0
      !> Padded size
      integer :: px = 1, py = 1
   end type layer_window

   !> Memory of all threads together [bytes]; limits their number
   real(wp), parameter :: memory = 1.0e9_wp
   !> Spectra are kept for all positions of loads on the grid if this enlarges the padded window by at most this factor; chosen:
   !> products take about a third of the time of the responses
   real(wp), parameter :: max_widening = 4.0_wp

contains

   !> Displacements and stresses at element centres
   subroutine transform_layers(load, ix, iy, z, displacement, stress, shelf)
      !> Surface tractions and constants of the bodies
      type(surface_load), intent(in) :: load
      !> Columns and rows of the points, ascending; they may lie outside the grid
      integer, intent(in) :: ix(:), iy(:)
      !> Depths [mm], positive in body 1
      real(wp), intent(in) :: z(:)
      !> Displacements [mm]
      real(wp), intent(out) :: displacement(3, size(ix), size(iy), size(z))
      !> Stresses [N/mm2], tension positive: xx, xy, xz, yy, yz, zz
      real(wp), intent(out) :: stress(6, size(ix), size(iy), size(z))
      !> Spectra kept by consecutive cases; absent: none
      type(response_shelf), intent(inout), optional :: shelf
      type(layer_window) :: window
      type(response_pack), allocatable :: packs(:)
      complex(wp), allocatable :: spectrum(:, :, :)
      logical :: stores
      integer :: threads

      displacement = 0.0_wp
      stress = 0.0_wp
      if (.not. any(load%acts) .or. size(displacement) == 0) return
      call find_window(load, ix, iy, window)
      call choose_packs(load%acts, packs)
      stores = .false.
      if (present(shelf)) call prepare_shelf(shelf, load, ix, iy, z, size(packs), window, stores)
      call transform_loads(load, window, spectrum)
      threads = 1
      !$ threads = omp_get_max_threads()
      ! memory per thread: 27/4 responses, spectra and fields of a group, and rows of two plans, in padded windows of real
      ! numbers
      threads = min(threads, size(z), max(1, int(memory/(8.0_wp*16.0_wp*real(window%px, wp)*real(window%py, wp)))))
      !$omp parallel num_threads(threads) default(shared)
      call compute_layers(load, window, spectrum, packs, ix, iy, z, displacement, stress, shelf)
      !$omp end parallel
      if (.not. stores) return
      shelf%nx = window%nx
      shelf%ny = window%ny
   end subroutine transform_layers

   !> Determine the window of a case whose spectra are, or will be, kept
   subroutine prepare_shelf(shelf, load, ix, iy, z, n_packs, window, stores)
      type(response_shelf), intent(inout) :: shelf
      type(surface_load), intent(in) :: load
      !> Columns and rows of the points, ascending
      integer, intent(in) :: ix(:), iy(:)
      !> Depths [mm]
      real(wp), intent(in) :: z(:)
      !> Number of spectra per depth
      integer, intent(in) :: n_packs
      !> Window of loads and points; on return enlarged to that of the spectra
      type(layer_window), intent(inout) :: window
      !> Will the spectra of this case be kept?
      logical, intent(out) :: stores
      type(layer_window) :: wide

      stores = .false.
      if (.not. shelf%is_for(load, z)) then
         call shelf%record(load, z)
         return
      end if
      wide = window
      if (window%nx <= shelf%nx .and. window%ny <= shelf%ny) then
         wide%nx = shelf%nx
         wide%ny = shelf%ny
         call pad(wide)
         window = wide
         return
      end if
      ! loads anywhere on the grid
      wide%nx = max(window%nx, ix(size(ix)) - 1, load%grid%mx - ix(1))
      wide%ny = max(window%ny, iy(size(iy)) - 1, load%grid%my - iy(1))
      call pad(wide)
      if (real(wide%px, wp)*wide%py > max_widening*real(window%px, wp)*window%py) return
      call shelf%make_room([wide%py/2 + 1, wide%px/2 + 1, n_parts, n_packs, size(z)], stores)
      if (stores) window = wide
   end subroutine prepare_shelf

   !> Number of padded elements, and of differences between points and loads, as measures of the cost
   pure subroutine padded_size(load, ix, iy, padded, differences)
      !> Surface tractions
      type(surface_load), intent(in) :: load
      !> Columns and rows of the points, ascending
      integer, intent(in) :: ix(:), iy(:)
      !> Elements of the padded window; distinct differences between a point and a load
      real(wp), intent(out) :: padded, differences
      type(layer_window) :: window

      call find_window(load, ix, iy, window)
      padded = real(window%px, wp)*real(window%py, wp)
      differences = real(window%nx + 1, wp)*real(window%ny + 1, wp)
   end subroutine padded_size

   !> Smallest window around loads and points
   pure subroutine find_window(load, ix, iy, window)
      type(surface_load), intent(in) :: load
      integer, intent(in) :: ix(:), iy(:)
      type(layer_window), intent(out) :: window

      associate (box => load%box, ix1 => ix(size(ix)), iy1 => iy(size(iy)))
         window%ix0 = min(ix(1), box%ix0)
         window%iy0 = min(iy(1), box%iy0)
         window%mx = max(ix1, box%ix1) - window%ix0 + 1
         window%my = max(iy1, box%iy1) - window%iy0 + 1
         window%nx = max(ix1 - box%ix0, box%ix1 - ix(1))
         window%ny = max(iy1 - box%iy0, box%iy1 - iy(1))
      end associate
      call pad(window)
   end subroutine find_window

   !> Padded size for differences of both signs without overlap
   pure subroutine pad(window)
      type(layer_window), intent(inout) :: window

      window%px = fast_size(2*window%nx + 1)
      window%py = fast_size(2*window%ny + 1)
   end subroutine pad

   !> Spectra of px, py, pn, scaled for the back transform
   subroutine transform_loads(load, window, spectrum)
      type(surface_load), intent(in) :: load
      type(layer_window), intent(in) :: window
      !> Spectra, shape (py, px/2 + 1, 3); undefined for tractions that are zero
      complex(wp), allocatable, intent(out) :: spectrum(:, :, :)
      type(fft_plan) :: plan
      real(wp), allocatable :: field(:, :)
      integer :: t

      call plan%prepare(window%mx, window%my, window%px, window%py)
      allocate(spectrum(window%py, plan%kx, 3), field(window%mx, window%my))
      field = 0.0_wp
      do t = 1, 3
         if (.not. load%acts(t)) cycle
         field(load%box%ix0 - window%ix0 + 1:load%box%ix1 - window%ix0 + 1, &
            & load%box%iy0 - window%iy0 + 1:load%box%iy1 - window%iy0 + 1) &
            & = load%traction(:, :, t)/(real(window%px, wp)*real(window%py, wp))
         call plan%forward(field, spectrum(:, :, t))
      end do
      call plan%release()
   end subroutine transform_loads

   !> Layers of one thread, with its own plans and workspace
   subroutine compute_layers(load, window, spectrum, packs, ix, iy, z, displacement, stress, shelf)
      type(surface_load), intent(in) :: load
      type(layer_window), intent(in) :: window
      !> Spectra of the tractions, shape (py, px/2 + 1, 3)
      complex(wp), contiguous, intent(in) :: spectrum(:, :, :)
      type(response_pack), intent(in) :: packs(:)
      integer, intent(in) :: ix(:), iy(:)
      real(wp), intent(in) :: z(:)
      real(wp), contiguous, intent(inout) :: displacement(:, :, :, :), stress(:, :, :, :)
      !> Contains the spectra of this window, receives them, or is empty
      type(response_shelf), intent(inout), optional :: shelf
      type(fft_plan) :: plan, period_plan
      !> Responses for differences 0...nx, 0...ny, shape (0:nx, 0:ny, 9, 3)
      real(wp), allocatable :: response(:, :, :, :)
      real(wp), allocatable :: field(:, :), period(:, :), factor(:, :, :)
      complex(wp), allocatable :: product(:, :, :), packed(:, :)
      logical :: has_begun(size(group, 1)), keeps, serves
      integer :: f, g, jx, jy, layer, n

      keeps = .false.
      serves = .false.
      if (present(shelf)) then
         keeps = allocated(shelf%factor)
         serves = keeps .and. shelf%nx >= 0
      end if
      call plan%prepare(window%mx, window%my, window%px, window%py)
      allocate(field(window%mx, window%my), product(window%py, plan%kx, 3))
      if (.not. serves) then
         call period_plan%prepare(window%px, window%py, window%px, window%py)
         allocate(response(0:window%nx, 0:window%ny, n_fields, 3), period(window%px, window%py), packed(window%py, plan%kx), &
            & factor(window%py/2 + 1, plan%kx, n_parts))
      end if
      !$omp do schedule(dynamic)
      do layer = 1, size(z)
         if (abs(z(layer)) > farthest_point) cycle
         if (.not. serves) call fill_responses(load, window, z(layer), response)
         do g = 1, size(group, 2)
            has_begun = .false.
            do n = 1, size(packs)
               if (packs(n)%group /= g) cycle
               if (serves) then
                  call add_products(packs(n), shelf%factor(:, :, :, n, layer), spectrum, product, has_begun)
                  cycle
               end if
               call transform_pack(packs(n), response, period_plan, period, packed, factor)
               call add_products(packs(n), factor, spectrum, product, has_begun)
               if (keeps) shelf%factor(:, :, :, n, layer) = factor
            end do
            do f = 1, size(group, 1)
               if (.not. has_begun(f)) product(:, :, f) = (0.0_wp, 0.0_wp)
               call plan%backward(product(:, :, f), field)
               do jy = 1, size(iy)
                  do jx = 1, size(ix)
                     if (group(f, g) <= 3) then
                        displacement(group(f, g), jx, jy, layer) = field(ix(jx) - window%ix0 + 1, iy(jy) - window%iy0 + 1)
                     else
                        stress(group(f, g) - 3, jx, jy, layer) = field(ix(jx) - window%ix0 + 1, iy(jy) - window%iy0 + 1)
                     end if
                  end do
               end do
            end do
         end do
      end do
      ! no barrier: a thread may have been abandoned, see base/guard.c
      !$omp end do nowait
      call plan%release()
      if (.not. serves) call period_plan%release()
   end subroutine compute_layers

   !> Responses at one depth, for non-negative differences of columns and rows
   pure subroutine fill_responses(load, window, z, response)
      type(surface_load), intent(in) :: load
      type(layer_window), intent(in) :: window
      !> Depth [mm], positive in body 1
      real(wp), intent(in) :: z
      !> Responses, shape (0:nx, 0:ny, 9, 3)
      real(wp), contiguous, intent(out) :: response(0:, 0:, :, :)
      type(load_quadrature) :: rule
      !> Differences along x of the closed forms, for three successive lines of corners or nodes
      real(wp) :: line(n_derivatives, 0:window%nx, 0:2)
      real(wp) :: d(n_derivatives), unit(n_fields, 3), far, mirror
      integer :: body, filled, k, l, near(-1:window%ny)

      body = merge(1, 2, z >= 0.0_wp)
      mirror = merge(1.0_wp, -1.0_wp, body == 1)
      rule = new_quadrature(load%bilinear)
      associate (dx => load%grid%dx, dy => load%grid%dy)
         ! number of differences per row, minus one, for which closed forms are used
         far = far_distance(dx, dy, load%bilinear)
         do l = 0, window%ny
            near(l) = -1
            if (far**2 >= z**2 + (l*dy)**2) near(l) = min(window%nx, int(sqrt(far**2 - z**2 - (l*dy)**2)/dx))
         end do
         near(-1) = near(0)
         filled = 0
         do l = 0, window%ny
            if (near(l) >= 0) then
               do while (filled <= l + merge(2, 1, load%bilinear))
                  call fill_line(filled, near(max(-1, filled - merge(2, 1, load%bilinear))), line(:, :, mod(filled, 3)))
                  filled = filled + 1
               end do
            end if
            do k = 0, window%nx
               if (k <= near(l)) then
                  if (load%bilinear) then
                     d = (line(:, k, mod(l + 2, 3)) - 2.0_wp*line(:, k, mod(l + 1, 3)) + line(:, k, mod(l, 3)))/(dx*dy)
                  else
                     d = line(:, k, mod(l + 1, 3)) - line(:, k, mod(l, 3))
                  end if
               else
                  call integrate(load%grid, rule, k*dx, l*dy, abs(z), d)
               end if
               call body_responses(d, abs(z), load%gg(body), load%nu(body), mirror, unit)
               response(k, l, :, :) = unit
            end do
         end do
      end associate
      if (body == 2) call turn_y(response)

   contains

      !> Differences along x on one line; line 0 is below row 0
      pure subroutine fill_line(number, last, differences)
         integer, intent(in) :: number
         !> Last difference of columns required
         integer, intent(in) :: last
         real(wp), intent(out) :: differences(n_derivatives, 0:window%nx)
         real(wp) :: now(n_derivatives), before(n_derivatives), first(n_derivatives), y, edge
         integer :: i

         associate (dx => load%grid%dx, dy => load%grid%dy)
            edge = edge_ratio*min(dx, dy)
            if (load%bilinear) then
               y = (number - 1)*dy
               call node_derivatives(-dx, y, abs(z), edge, first)
               call node_derivatives(0.0_wp, y, abs(z), edge, before)
               do i = 0, last
                  call node_derivatives((i + 1)*dx, y, abs(z), edge, now)
                  differences(:, i) = (now - before) - (before - first)
                  first = before
                  before = now
               end do
            else
               y = (number - 0.5_wp)*dy
               call corner_derivatives(-0.5_wp*dx, y, abs(z), edge, before)
               do i = 0, last
                  call corner_derivatives((i + 0.5_wp)*dx, y, abs(z), edge, now)
                  differences(:, i) = now - before
                  before = now
               end do
            end if
         end associate
      end subroutine fill_line
   end subroutine fill_responses

   !> Quadrature over one element
   pure subroutine integrate(grid, rule, x, y, depth, sum)
      type(potential_contact), intent(in) :: grid
      type(load_quadrature), intent(in) :: rule
      !> Point relative to the centre of the element, and its distance from the surface [mm]
      real(wp), intent(in) :: x, y, depth
      real(wp), intent(out) :: sum(n_derivatives)
      real(wp) :: part(n_derivatives)
      integer :: i, j

      sum = 0.0_wp
      associate (dx => grid%dx, dy => grid%dy)
         do j = 1, size(rule%point)
            do i = 1, size(rule%point)
               call source_derivatives(x - rule%point(i)*dx, y - rule%point(j)*dy, depth, part)
               sum = sum + rule%weight(i)*rule%weight(j)*dx*dy*part
            end do
         end do
      end associate
   end subroutine integrate

   !> Transform from the frame of body 2, whose y-axis is reversed
   pure subroutine turn_y(response)
      real(wp), contiguous, intent(inout) :: response(:, :, :, :)
      integer :: f, t

      do t = 1, 3
         do f = 1, n_fields
            if (odd_in_y(f, t)) response(:, :, f, t) = -response(:, :, f, t)
         end do
      end do
   end subroutine turn_y
end module contact_subsurface_layers
