!> Time steps of a patch: the present one becomes the previous one, on the grid of the next case
module contact_patch_time_steps
   use contact_base_choices, only : estimate_choice, motion, time_link
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_grid_potential_contact, only : is_same_side, potential_contact
   use contact_numeric_pieces, only : clear_long, copy_long, copy_whole, fill_whole
   use contact_patch_problem, only : carried, memory_field, patch_problem, patch_state, traction_fields
   implicit none (type, external)
   private

   public :: link_time_steps, clear_time_step, copy_fields, elements_left_out

contains

   !> Shift the time steps: the present one becomes the previous one, on the grid of this case
   subroutine link_time_steps(problem, link, state, error)
      !> Grid of this case, and quantities that particles carry
      type(patch_problem), intent(in) :: problem
      !> Member of time_link
      integer, intent(in) :: link
      !> On entry the state after the previous case; on exit `now` is the estimate and `before` the previous time step, on the new
      !> grid
      type(patch_state), intent(inout) :: state
      !> Allocated if the grids are not compatible, or the new one omits elements in contact that are needed
      type(error_type), allocatable, intent(out) :: error
      ! values of particles without history, for the quantity in turn
      real(wp), allocatable :: fresh(:)
      integer :: kind, kx, ky, actual
      logical :: linked

      ! in steady rolling the previous tractions are the present ones: a repeated step behind it continues from these
      actual = link
      if (link == time_link%repeat_step .and. state%is_steady .and. state%started) actual = time_link%continue_all
      kx = 0
      ky = 0
      linked = state%started .and. (link /= time_link%initiate .or. problem%estimate /= estimate_choice%fresh)
      if (linked) then
         call offset_of(state%now%grid, problem%grid, kx, ky, error)
         if (.not. allocated(error) .and. link /= time_link%initiate) call check_lost_contact(state, problem%grid, actual, error)
         if (allocated(error)) return
         call move_window(state%now, problem%grid, kx, ky)
         if (state%before%grid%mx > 0) call move_window(state%before, problem%grid, kx, ky)
      else
         call clear_time_step(state%now, problem%grid)
         state%creep = 0.0_wp
      end if
      select case (actual)
      case (time_link%repeat_step)
         if (.not. state%before%grid%mx > 0) call clear_time_step(state%before, problem%grid)
      case (time_link%continue_all)
         if (actual == link) then
            call copy_fields(state%now, state%before)
         else
            ! damping forces of a repeated step are relative to the step before
            call copy_tractions(state%now, state%before)
         end if
      case (time_link%continue_normal)
         call copy_fields(state%now, state%before)
         call clear_long(size(state%before%px), state%before%px)
         call clear_long(size(state%before%py), state%before%py)
         state%before%force(2:3) = 0.0_wp
      case default
         call clear_time_step(state%before, problem%grid)
      end select
      do kind = 1, carried%count
         if (problem%carries(kind)) then
            if (.not. allocated(fresh)) allocate(fresh(problem%grid%my))
            call problem%fill_fresh(kind, fresh)
            call hand_over(problem, actual, linked, kx, ky, fresh, state%now%memory(kind), state%before%memory(kind))
         else
            state%now%memory(kind) = memory_field()
            state%before%memory(kind) = memory_field()
         end if
      end do
   end subroutine link_time_steps

   !> Quantities of the particles at the previous time step, from the present ones
   !>
   !> In rolling the contact moves by one step: the particles that are now in its elements were one step ahead. Values between
   !> elements are interpolated bilinearly.
   subroutine hand_over(problem, link, linked, kx, ky, fresh, now, before)
      type(patch_problem), intent(in) :: problem
      !> Member of time_link
      integer, intent(in) :: link
      !> Does the case continue from a previous one? Otherwise all particles are without history
      logical, intent(in) :: linked
      !> Shift of the grid, in elements
      integer, intent(in) :: kx, ky
      !> Value of particles without history, per row
      real(wp), intent(in) :: fresh(:)
      type(memory_field), intent(inout) :: now, before

      call fit_memory(problem%grid, kx, ky, fresh, now)
      call fit_memory(problem%grid, kx, ky, fresh, before)
      if (.not. linked) then
         call fill_rows(fresh, now%value)
         call fill_rows(fresh, before%value)
         return
      end if
      select case (link)
      case (time_link%repeat_step)
         continue
      case (time_link%continue_all)
         if (problem%motion == motion%transient_rolling .or. problem%motion == motion%steady_rolling) then
            call sample_ahead(now%value, problem%dq*cos(problem%chi)/problem%grid%dx, &
               & problem%dq*sin(problem%chi)/problem%grid%dy, fresh, before%value)
         else
            before%value = now%value
         end if
      case default
         call fill_rows(fresh, before%value)
      end select
   end subroutine hand_over

   !> Move a stored quantity to the grid of this case; particles that enter have no history
   subroutine fit_memory(grid, kx, ky, fresh, field)
      type(potential_contact), intent(in) :: grid
      !> Shift of the grid, in elements
      integer, intent(in) :: kx, ky
      !> Value of particles without history, per row
      real(wp), intent(in) :: fresh(:)
      type(memory_field), intent(inout) :: field
      real(wp), allocatable :: old(:, :)
      integer :: ix, iy

      if (allocated(field%value)) then
         if (kx == 0 .and. ky == 0 .and. all(shape(field%value) == [grid%mx, grid%my])) return
         call move_alloc(field%value, old)
      end if
      allocate(field%value(grid%mx, grid%my))
      call fill_rows(fresh, field%value)
      if (.not. allocated(old)) return
      do iy = max(1, 1 - ky), min(grid%my, size(old, 2) - ky)
         do ix = max(1, 1 - kx), min(grid%mx, size(old, 1) - kx)
            field%value(ix, iy) = old(ix + kx, iy + ky)
         end do
      end do
   end subroutine fit_memory

   !> Fill a field with one value per row
   pure subroutine fill_rows(fresh, field)
      real(wp), intent(in) :: fresh(:)
      !> Shape (mx, size(fresh))
      real(wp), intent(inout) :: field(:, :)
      integer :: iy

      do iy = 1, size(field, 2)
         field(:, iy) = fresh(iy)
      end do
   end subroutine fill_rows

   !> Values of a field at a distance ahead, interpolated bilinearly; fresh values beyond the grid
   pure subroutine sample_ahead(field, steps_x, steps_y, fresh, sampled)
      !> Field, shape (mx, my)
      real(wp), intent(in) :: field(:, :)
      !> Distance, in elements [-]
      real(wp), intent(in) :: steps_x, steps_y
      !> Values beyond the grid, per row
      real(wp), intent(in) :: fresh(:)
      !> Values at the distance, shape (mx, my)
      real(wp), intent(inout) :: sampled(:, :)
      integer :: kx, ky, ix, iy, jx, jy, i, j
      real(wp) :: a, b, corner(0:1, 0:1)
      !> Distances this close to an integer are regarded as integers [-]
      real(wp), parameter :: whole = 1.0e-9_wp

      kx = floor(steps_x + whole)
      ky = floor(steps_y + whole)
      a = max(0.0_wp, steps_x - kx)
      b = max(0.0_wp, steps_y - ky)
      if (a < 2.0_wp*whole) a = 0.0_wp
      if (b < 2.0_wp*whole) b = 0.0_wp
      do iy = 1, size(field, 2)
         do ix = 1, size(field, 1)
            do j = 0, 1
               jy = iy + ky + j
               do i = 0, 1
                  jx = ix + kx + i
                  if (jx >= 1 .and. jx <= size(field, 1) .and. jy >= 1 .and. jy <= size(field, 2)) then
                     corner(i, j) = field(jx, jy)
                  else
                     corner(i, j) = fresh(min(max(jy, 1), size(field, 2)))
                  end if
               end do
            end do
            sampled(ix, iy) = (1.0_wp - b)*((1.0_wp - a)*corner(0, 0) + a*corner(1, 0)) &
               & + b*((1.0_wp - a)*corner(0, 1) + a*corner(1, 1))
         end do
      end do
   end subroutine sample_ahead

   !> Shift of a grid relative to the previous one, in elements
   subroutine offset_of(old, new, kx, ky, error)
      type(potential_contact), intent(in) :: old, new
      integer, intent(out) :: kx, ky
      type(error_type), allocatable, intent(out) :: error

      kx = 0
      ky = 0
      if (.not. (is_same_side(new%dx, old%dx) .and. is_same_side(new%dy, old%dy))) then
         call fatal_error(error, "the element sizes differ from those of the previous case, to which this one is linked; " // &
            & "the same DX and DY, or sequence = ""initiate"" with estimate = ""fresh""")
         return
      end if
      associate (shift => nint(new%offset(old)))
         kx = shift(1)
         ky = shift(2)
      end associate
      if (.not. new%continues(old)) then
         call fatal_error(error, "the potential contact is not shifted by whole elements with respect to the previous case, " // &
            & "to which this one is linked; a shift by whole elements, or sequence = ""initiate"" with estimate = ""fresh""")
      end if
   end subroutine offset_of

   !> Refuse a grid that omits elements in contact whose tractions affect the next time step
   subroutine check_lost_contact(state, grid, link, error)
      type(patch_state), intent(in) :: state
      type(potential_contact), intent(in) :: grid
      !> Member of time_link other than initiate
      integer, intent(in) :: link
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: box(4)
      character(len=80) :: window
      character(len=12) :: number
      integer :: lost

      ! a repeated step keeps its previous time step, and the present one is only an estimate
      if (link == time_link%repeat_step) then
         if (.not. state%before%grid%mx > 0) return
         call elements_left_out(state%before%division, state%before%grid, grid, lost, box)
      else
         call elements_left_out(state%now%division, state%now%grid, grid, lost, box)
      end if
      if (lost == 0) return
      write(number, "(I0)") lost
      write(window, '("x = ", G0.6, " to ", G0.6, ", y = ", G0.6, " to ", G0.6)') box
      call fatal_error(error, "the potential contact leaves out " // trim(number) // " of the elements that were in contact in &
         &the previous case, whose tractions this case continues; a window that contains " // trim(window) // &
         & " mm, or sequence = ""initiate"" with estimate = ""fresh""")
   end subroutine check_lost_contact

   !> Number of elements in contact that are outside another grid with the same elements
   pure subroutine elements_left_out(division, old, new, n, box)
      !> Element states on the old grid
      integer, intent(in) :: division(:, :)
      !> Grids with elements of the same size on the same lattice
      type(potential_contact), intent(in) :: old, new
      !> Number of elements outside
      integer, intent(out) :: n
      !> Bounding box of the contact area: minimum and maximum x, minimum and maximum y [mm]
      real(wp), intent(out) :: box(4)
      integer :: ix, iy, jx, jy

      n = 0
      box = [huge(1.0_wp), -huge(1.0_wp), huge(1.0_wp), -huge(1.0_wp)]
      do iy = 1, size(division, 2)
         jy = iy - nint((new%yl - old%yl)/new%dy)
         do ix = 1, size(division, 1)
            if (division(ix, iy) <= element%exterior) cycle
            box(1:2) = [min(box(1), old%x(ix) - 0.5_wp*old%dx), max(box(2), old%x(ix) + 0.5_wp*old%dx)]
            box(3:4) = [min(box(3), old%y(iy) - 0.5_wp*old%dy), max(box(4), old%y(iy) + 0.5_wp*old%dy)]
            jx = ix - nint((new%xl - old%xl)/new%dx)
            if (jx < 1 .or. jx > new%mx .or. jy < 1 .or. jy > new%my) n = n + 1
         end do
      end do
   end subroutine elements_left_out

   !> Move the fields to a shifted grid: values in the overlap, zero elsewhere
   subroutine move_window(fields, grid, kx, ky)
      type(traction_fields), intent(inout) :: fields
      type(potential_contact), intent(in) :: grid
      integer, intent(in) :: kx, ky
      type(traction_fields) :: old
      integer :: first, last, ix, iy, jy

      if (all(shape(fields%division) == [grid%mx, grid%my])) then
         fields%grid = grid
         if (kx /= 0 .or. ky /= 0) call shift_fields(fields, kx, ky)
         return
      end if
      old%grid = fields%grid
      call move_alloc(fields%division, old%division)
      call move_alloc(fields%pn, old%pn)
      call move_alloc(fields%px, old%px)
      call move_alloc(fields%py, old%py)
      call move_alloc(fields%rate, old%rate)
      call fit_fields(fields, grid%mx, grid%my)
      call clear_fields(fields)
      fields%grid = grid
      if (allocated(old%rate)) allocate(fields%rate(grid%mx, grid%my), source=0.0_wp)
      first = max(1, 1 - kx)
      last = min(grid%mx, old%grid%mx - kx)
      do iy = max(1, 1 - ky), min(grid%my, old%grid%my - ky)
         jy = iy + ky
         do ix = first, last
            fields%division(ix, iy) = old%division(ix + kx, jy)
         end do
         do ix = first, last
            fields%pn(ix, iy) = old%pn(ix + kx, jy)
            fields%px(ix, iy) = old%px(ix + kx, jy)
            fields%py(ix, iy) = old%py(ix + kx, jy)
         end do
         if (.not. allocated(fields%rate)) cycle
         do ix = first, last
            fields%rate(ix, iy) = old%rate(ix + kx, jy)
         end do
      end do
   end subroutine move_window

   !> Shift the values of fields in place, in an order in which no value is overwritten before it is moved
   pure subroutine shift_fields(fields, kx, ky)
      type(traction_fields), intent(inout) :: fields
      !> Offset in columns and rows of the element whose value an element gets; zero if that is outside the grid
      integer, intent(in) :: kx, ky
      integer :: mx, my, i, j, ix, iy, jx, jy

      mx = size(fields%division, 1)
      my = size(fields%division, 2)
      do j = 1, my
         iy = merge(j, my + 1 - j, ky >= 0)
         jy = iy + ky
         do i = 1, mx
            ix = merge(i, mx + 1 - i, kx >= 0)
            jx = ix + kx
            if (min(jx, jy) >= 1 .and. jx <= mx .and. jy <= my) then
               fields%division(ix, iy) = fields%division(jx, jy)
               fields%pn(ix, iy) = fields%pn(jx, jy)
               fields%px(ix, iy) = fields%px(jx, jy)
               fields%py(ix, iy) = fields%py(jx, jy)
               if (allocated(fields%rate)) fields%rate(ix, iy) = fields%rate(jx, jy)
            else
               fields%division(ix, iy) = element%exterior
               fields%pn(ix, iy) = 0.0_wp
               fields%px(ix, iy) = 0.0_wp
               fields%py(ix, iy) = 0.0_wp
               if (allocated(fields%rate)) fields%rate(ix, iy) = 0.0_wp
            end if
         end do
      end do
   end subroutine shift_fields

   !> Set a time step without contact
   subroutine clear_time_step(fields, grid)
      !> Arrays get the size of the grid and are set to zero; all elements are exterior
      type(traction_fields), intent(inout) :: fields
      !> Grid of the time step
      type(potential_contact), intent(in) :: grid

      call fit_fields(fields, grid%mx, grid%my)
      fields%grid = grid
      call clear_fields(fields)
      fields%pen = 0.0_wp
      if (allocated(fields%rate)) deallocate(fields%rate)
      fields%is_solved = .false.
      fields%force = 0.0_wp
   end subroutine clear_time_step

   !> Copy of the fields of a time step, and of its forces
   subroutine copy_fields(from, to)
      !> Solved time step
      type(traction_fields), intent(in) :: from
      !> Copy, without derivative and quantities of the particles; arrays of equal size are reused
      type(traction_fields), intent(inout) :: to

      call copy_tractions(from, to)
      to%is_solved = from%is_solved
      to%force = from%force
   end subroutine copy_fields

   !> Copy of the grid, the tractions and the approach of a time step
   subroutine copy_tractions(from, to)
      !> Solved time step
      type(traction_fields), intent(in) :: from
      !> Its forces stay; arrays of equal size are reused
      type(traction_fields), intent(inout) :: to

      call fit_fields(to, from%grid%mx, from%grid%my)
      to%grid = from%grid
      call copy_whole(size(to%division), from%division, to%division)
      call copy_long(size(to%pn), from%pn, to%pn)
      call copy_long(size(to%px), from%px, to%px)
      call copy_long(size(to%py), from%py, to%py)
      to%pen = from%pen
   end subroutine copy_tractions

   !> Fields of a time step on a grid, without values if new; arrays of equal size are reused
   subroutine fit_fields(fields, grid_mx, grid_my)
      type(traction_fields), intent(inout) :: fields
      integer, intent(in) :: grid_mx, grid_my

      if (allocated(fields%division)) then
         if (all(shape(fields%division) == [grid_mx, grid_my])) return
         deallocate(fields%division, fields%pn, fields%px, fields%py)
      end if
      allocate(fields%division(grid_mx, grid_my))
      allocate(fields%pn(grid_mx, grid_my), fields%px(grid_mx, grid_my), fields%py(grid_mx, grid_my))
   end subroutine fit_fields

   !> Set tractions to zero, and all elements to exterior
   subroutine clear_fields(fields)
      !> With allocated arrays
      type(traction_fields), intent(inout) :: fields

      call fill_whole(size(fields%division), element%exterior, fields%division)
      call clear_long(size(fields%pn), fields%pn)
      call clear_long(size(fields%px), fields%px)
      call clear_long(size(fields%py), fields%py)
   end subroutine clear_fields
end module contact_patch_time_steps
