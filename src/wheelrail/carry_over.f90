!> Transfer of the tractions of the previous time step to the patches of the present one
!>
!> Patches appear and vanish, merge and separate. Their tractions are stored on one lattice of elements for wheel and rail: in
!> lateral direction it is fixed to the arc length of the rail profile, along the track to the rail (shifts) or to the wheelset
!> (rolling). The grid of a patch is a window of this lattice. Every element that was in contact is assigned to at most one present
!> patch: the nearest one of those whose bounds overlap with the bounds of its own patch. The window of that patch is extended to
!> include the element: no traction is lost or counted twice. Components along the track, along the profile and normal to it are
!> kept, although the planes of the patches differ by small angles: tractions and traction bound refer to the surface.
module contact_wheelrail_carry_over
   use, intrinsic :: iso_fortran_env, only : int64
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_time_steps, only : clear_time_step, copy_fields
   use contact_patch_problem, only : carried, patch_problem, traction_fields
   implicit none (type, external)
   private

   public :: carried_step, lattice_box, lattice_window, place_on_lattice

   !> Maximum number of patches of wheel and rail
   integer, parameter, public :: max_patches = 10

   !> Bounds of a patch on the lattice [mm]
   type :: lattice_box
      real(wp) :: x(2) = 0.0_wp, s(2) = 0.0_wp
   end type lattice_box

   !> Indices of the first element of a window; element (i, j) of the lattice is centred at (i dx, j ds)
   type :: lattice_window
      integer(int64) :: first(2) = 0_int64
   end type lattice_window

   !> Stored data of one patch
   type :: carried_patch
      type(traction_fields) :: fields
      type(lattice_window) :: window
      type(lattice_box) :: box
      !> Index of the present patch to which an element is assigned, 0 for none; shape of the fields
      integer, allocatable :: owner(:, :)
   end type carried_patch

   !> All patches of wheel and rail in one time step
   type :: carried_step
      !> Patches in the order of the results; unallocated before the first case
      type(carried_patch), allocatable :: patch(:)
      !> Is the lattice fixed to the rail along the track? Otherwise to the wheelset
      logical :: follows_rail = .false.
      !> Position of the wheelset along the rail in that time step [mm]
      real(wp) :: travel = 0.0_wp
   contains
      !> Remove all patches
      procedure :: clear
      !> Store the patches of a solved case
      procedure :: start
      procedure :: add
      !> Change between lattices fixed to the rail and to the wheelset
      procedure :: set_frame
      !> Remove patches with other element sizes
      procedure :: drop_other_elements
      !> Remove tangential tractions
      procedure :: drop_tangential
      !> Assign elements to the patches of the present time step
      procedure :: share_out
      !> Previous patches that a present one continues
      procedure :: find_sources
      !> Extend a window to all elements assigned to a patch
      procedure :: widen
      !> Fields of the previous time step for a present patch
      procedure :: hand_over
      !> Sum of the tractions assigned to a present patch
      procedure :: total_force
   end type carried_step

contains

   !> Remove all patches
   pure subroutine clear(self)
      class(carried_step), intent(inout) :: self
      if (allocated(self%patch)) deallocate(self%patch)
   end subroutine clear

   !> Prepare for the patches of a time step; arrays are kept if the number is the same
   subroutine start(self, patches, follows_rail, travel)
      class(carried_step), intent(inout) :: self
      !> Number of patches
      integer, intent(in) :: patches
      !> Is the lattice fixed to the rail along the track? Otherwise to the wheelset
      logical, intent(in) :: follows_rail
      !> Position of the wheelset along the rail [mm]
      real(wp), intent(in) :: travel

      if (allocated(self%patch)) then
         if (size(self%patch) /= patches) call self%clear()
      end if
      if (.not. allocated(self%patch)) allocate(self%patch(patches))
      self%follows_rail = follows_rail
      self%travel = travel
   end subroutine start

   !> Store the tractions of a patch
   !>
   !> A grid that is not aligned with the lattice, as in steady rolling, is moved to the nearest lattice position.
   subroutine add(self, k, fields, reference, box)
      class(carried_step), intent(inout) :: self
      !> Index of the patch, up to the number given to `start`
      integer, intent(in) :: k
      !> Fields on the grid of the patch
      type(traction_fields), intent(in) :: fields
      !> Position of the contact reference on the lattice [mm]
      real(wp), intent(in) :: reference(2)
      !> Bounds of the solved patch on the lattice [mm]
      type(lattice_box), intent(in) :: box

      associate (kept => self%patch(k)%fields)
         call copy_fields(fields, kept)
         kept%memory = fields%memory
      end associate
      self%patch(k)%window = place_on_lattice(fields%grid, reference)
      self%patch(k)%box = box
   end subroutine add

   !> Lattice position nearest to a grid
   pure function place_on_lattice(grid, reference) result(window)
      !> Grid in coordinates whose origin is the contact reference
      type(potential_contact), intent(in) :: grid
      !> Position of the contact reference on the lattice [mm]
      real(wp), intent(in) :: reference(2)
      type(lattice_window) :: window

      window%first = [nint((grid%x(1) + reference(1))/grid%dx, int64), nint((grid%y(1) + reference(2))/grid%dy, int64)]
   end function place_on_lattice

   !> Change between lattices fixed to the rail and to the wheelset, by whole elements
   pure subroutine set_frame(self, follows_rail)
      class(carried_step), intent(inout) :: self
      !> Is the lattice to be fixed to the rail along the track? Otherwise to the wheelset
      logical, intent(in) :: follows_rail
      integer(int64) :: steps
      integer :: k

      if (.not. allocated(self%patch)) return
      if (self%follows_rail .neqv. follows_rail) then
         do k = 1, size(self%patch)
            associate (patch => self%patch(k))
               steps = nint(self%travel/patch%fields%grid%dx, int64)
               if (.not. follows_rail) steps = -steps
               patch%window%first(1) = patch%window%first(1) + steps
               patch%box%x = patch%box%x + steps*patch%fields%grid%dx
            end associate
         end do
      end if
      self%follows_rail = follows_rail
   end subroutine set_frame

   !> Remove patches whose elements have other sides than those of the lattice
   subroutine drop_other_elements(self, dx, ds, dropped)
      class(carried_step), intent(inout) :: self
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, ds
      !> Number of patches removed
      integer, intent(out) :: dropped
      integer :: k
      real(wp), parameter :: same_side = 1.0e-4_wp

      dropped = 0
      if (.not. allocated(self%patch)) return
      do k = 1, size(self%patch)
         associate (grid => self%patch(k)%fields%grid, division => self%patch(k)%fields%division)
            if (abs(grid%dx - dx) <= same_side*dx .and. abs(grid%dy - ds) <= same_side*ds) cycle
            if (any(division > element%exterior)) dropped = dropped + 1
            division = element%exterior
         end associate
      end do
   end subroutine drop_other_elements

   !> Remove tangential tractions
   pure subroutine drop_tangential(self)
      class(carried_step), intent(inout) :: self
      integer :: k

      if (.not. allocated(self%patch)) return
      do k = 1, size(self%patch)
         self%patch(k)%fields%px = 0.0_wp
         self%patch(k)%fields%py = 0.0_wp
      end do
   end subroutine drop_tangential

   !> Assign every element that was in contact to one of the present patches
   subroutine share_out(self, boxes)
      class(carried_step), intent(inout) :: self
      !> Bounds of the present patches, at most `max_patches` [mm]
      type(lattice_box), intent(in) :: boxes(:)
      integer :: j, k, ix, iy, candidates(max_patches), n, nearest
      real(wp) :: place(2), distance, shortest

      if (.not. allocated(self%patch)) return
      do j = 1, size(self%patch)
         associate (patch => self%patch(j), grid => self%patch(j)%fields%grid)
            if (allocated(patch%owner)) then
               if (any(shape(patch%owner) /= [grid%mx, grid%my])) deallocate(patch%owner)
            end if
            if (.not. allocated(patch%owner)) allocate(patch%owner(grid%mx, grid%my))
            patch%owner = 0
            n = 0
            do k = 1, size(boxes)
               if (.not. overlap(patch%box, boxes(k))) cycle
               n = n + 1
               candidates(n) = k
            end do
            if (n == 0) cycle
            do iy = 1, grid%my
               do ix = 1, grid%mx
                  if (patch%fields%division(ix, iy) <= element%exterior) cycle
                  nearest = candidates(1)
                  if (n > 1) then
                     place = [(patch%window%first(1) + ix - 1)*grid%dx, (patch%window%first(2) + iy - 1)*grid%dy]
                     shortest = huge(1.0_wp)
                     do k = 1, n
                        distance = squared_distance(place, boxes(candidates(k)))
                        if (distance >= shortest) cycle
                        shortest = distance
                        nearest = candidates(k)
                     end do
                  end if
                  patch%owner(ix, iy) = nearest
               end do
            end do
         end associate
      end do
   end subroutine share_out

   !> Do two boxes overlap?
   pure logical function overlap(a, b)
      type(lattice_box), intent(in) :: a, b
      overlap = a%x(1) <= b%x(2) .and. b%x(1) <= a%x(2) .and. a%s(1) <= b%s(2) .and. b%s(1) <= a%s(2)
   end function overlap

   !> Squared distance of a point from a box, 0 inside [mm2]
   pure real(wp) function squared_distance(place, box) result(distance)
      real(wp), intent(in) :: place(2)
      type(lattice_box), intent(in) :: box
      distance = max(box%x(1) - place(1), place(1) - box%x(2), 0.0_wp)**2 &
         & + max(box%s(1) - place(2), place(2) - box%s(2), 0.0_wp)**2
   end function squared_distance

   !> Previous patches that a present one continues, in increasing order
   pure subroutine find_sources(self, k, list)
      class(carried_step), intent(in) :: self
      !> Index of the present patch
      integer, intent(in) :: k
      !> Indices of the previous patches; reallocated if the size changes
      integer, allocatable, intent(inout) :: list(:)
      integer :: found(max_patches)
      integer :: j, n

      n = 0
      if (allocated(self%patch)) then
         do j = 1, size(self%patch)
            if (.not. any(self%patch(j)%owner == k)) cycle
            n = n + 1
            found(n) = j
         end do
      end if
      if (allocated(list)) then
         if (size(list) /= n) deallocate(list)
      end if
      if (.not. allocated(list)) allocate(list(n))
      list(:) = found(:n)
   end subroutine find_sources

   !> Extend a window to all elements assigned to a patch
   pure subroutine widen(self, k, window, grid)
      class(carried_step), intent(in) :: self
      !> Index of the present patch
      integer, intent(in) :: k
      !> Position of the first element on the lattice
      type(lattice_window), intent(inout) :: window
      !> Size and position of the window in coordinates of the patch
      type(potential_contact), intent(inout) :: grid
      integer(int64) :: low(2), high(2)
      integer :: j, ix, iy

      if (.not. allocated(self%patch)) return
      low = window%first
      high = window%first + [grid%mx, grid%my] - 1
      do j = 1, size(self%patch)
         associate (patch => self%patch(j))
            do iy = 1, size(patch%owner, 2)
               do ix = 1, size(patch%owner, 1)
                  if (patch%owner(ix, iy) /= k) cycle
                  low = min(low, patch%window%first + [ix, iy] - 1)
                  high = max(high, patch%window%first + [ix, iy] - 1)
               end do
            end do
         end associate
      end do
      grid%xl = grid%xl - (window%first(1) - low(1))*grid%dx
      grid%yl = grid%yl - (window%first(2) - low(2))*grid%dy
      grid%mx = int(high(1) - low(1) + 1)
      grid%my = int(high(2) - low(2) + 1)
      window%first = low
   end subroutine widen

   !> Fields of the previous time step on the grid of a present patch
   subroutine hand_over(self, k, problem, window, fields)
      class(carried_step), intent(in) :: self
      !> Index of the present patch
      integer, intent(in) :: k
      !> Its problem, on a grid that includes all assigned elements
      type(patch_problem), intent(in) :: problem
      !> Position of the first element of the grid on the lattice
      type(lattice_window), intent(in) :: window
      !> Tractions and quantities of the particles are set; zero outside the previous patches
      type(traction_fields), intent(inout) :: fields
      real(wp) :: fresh(problem%grid%my)
      integer :: j, ix, iy, jx, jy, kind

      call clear_time_step(fields, problem%grid)
      do kind = 1, carried%count
         if (.not. problem%carries(kind)) cycle
         if (allocated(fields%memory(kind)%value)) deallocate(fields%memory(kind)%value)
         call problem%fill_fresh(kind, fresh)
         allocate(fields%memory(kind)%value(problem%grid%mx, problem%grid%my), source=spread(fresh, 1, problem%grid%mx))
      end do
      if (.not. allocated(self%patch)) return
      do j = 1, size(self%patch)
         associate (patch => self%patch(j), old => self%patch(j)%fields)
            do iy = 1, size(patch%owner, 2)
               do ix = 1, size(patch%owner, 1)
                  if (patch%owner(ix, iy) /= k) cycle
                  jx = int(patch%window%first(1) - window%first(1)) + ix
                  jy = int(patch%window%first(2) - window%first(2)) + iy
                  fields%is_solved = .true.
                  ! tractions of two patches that meet in an element are added
                  fields%division(jx, jy) = max(fields%division(jx, jy), old%division(ix, iy))
                  fields%pn(jx, jy) = fields%pn(jx, jy) + old%pn(ix, iy)
                  fields%px(jx, jy) = fields%px(jx, jy) + old%px(ix, iy)
                  fields%py(jx, jy) = fields%py(jx, jy) + old%py(ix, iy)
                  do kind = 1, carried%count
                     ! quantities that both time steps have
                     if (allocated(old%memory(kind)%value) .and. allocated(fields%memory(kind)%value)) &
                        & fields%memory(kind)%value(jx, jy) = old%memory(kind)%value(ix, iy)
                  end do
               end do
            end do
         end associate
      end do
      fields%force = self%total_force(k)
   end subroutine hand_over

   !> Sum of the tractions assigned to a present patch: Fn, Fx, Fs [N]
   pure function total_force(self, k) result(force)
      class(carried_step), intent(in) :: self
      !> Index of the present patch
      integer, intent(in) :: k
      real(wp) :: force(3)
      integer :: j

      force = 0.0_wp
      if (.not. allocated(self%patch)) return
      do j = 1, size(self%patch)
         associate (patch => self%patch(j), old => self%patch(j)%fields)
            force = force + old%grid%dx*old%grid%dy*[sum(old%pn, patch%owner == k), sum(old%px, patch%owner == k), &
               & sum(old%py, patch%owner == k)]
         end associate
      end do
   end function total_force
end module contact_wheelrail_carry_over
