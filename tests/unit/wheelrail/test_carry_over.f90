!> Transfer of tractions from the patches of one time step to those of the next
program test_carry_over
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_time_steps, only : clear_time_step
   use contact_patch_problem, only : patch_problem, traction_fields
   use contact_test_harness, only : test_suite
   use contact_wheelrail_carry_over, only : carried_step, lattice_box, lattice_window, place_on_lattice
   implicit none (type, external)
   real(wp), parameter :: dx = 0.2_wp, ds = 0.1_wp
   type(test_suite) :: suite

   call suite%start("carry over")
   call one_to_one()
   call separate()
   call join()
   call appear_and_vanish()
   call far_along_the_track()
   call other_frame()
   call other_elements()
   call suite%finish()

contains

   !> A patch whose elements around a lattice point are in contact; the tractions identify the element
   subroutine add_patch(moment, k, place, mx, my)
      type(carried_step), intent(inout) :: moment
      integer, intent(in) :: k, mx, my
      !> Place of the contact reference on the lattice [mm]
      real(wp), intent(in) :: place(2)
      type(traction_fields) :: fields
      type(potential_contact) :: grid
      integer :: ix, iy

      grid = window_around(place, mx, my)
      call clear_time_step(fields, grid)
      do iy = 2, my - 1
         do ix = 2, mx - 1
            fields%division(ix, iy) = element%slip
            fields%pn(ix, iy) = 100.0_wp*k + ix + 0.01_wp*iy
            fields%px(ix, iy) = 0.1_wp*ix
            fields%py(ix, iy) = -0.1_wp*iy
         end do
      end do
      call moment%add(k, fields, place, box_around(place, mx, my))
   end subroutine add_patch

   !> Grid on the lattice around a reference
   function window_around(place, mx, my) result(grid)
      real(wp), intent(in) :: place(2)
      integer, intent(in) :: mx, my
      type(potential_contact) :: grid

      grid = potential_contact(mx=mx, my=my, dx=dx, dy=ds)
      grid%xl = (anint(place(1)/dx) - 0.5_wp*mx)*dx - place(1)
      grid%yl = (anint(place(2)/ds) - 0.5_wp*my)*ds - place(2)
      if (mod(mx, 2) == 0) grid%xl = grid%xl + 0.5_wp*dx
      if (mod(my, 2) == 0) grid%yl = grid%yl + 0.5_wp*ds
   end function window_around

   function box_around(place, mx, my) result(box)
      real(wp), intent(in) :: place(2)
      integer, intent(in) :: mx, my
      type(lattice_box) :: box
      box%x = place(1) + 0.5_wp*mx*dx*[-1, 1]
      box%s = place(2) + 0.5_wp*my*ds*[-1, 1]
   end function box_around

   !> Total of all normal and tangential tractions of a time step [N]
   pure function total(moment) result(force)
      type(carried_step), intent(in) :: moment
      real(wp) :: force(3)
      integer :: j

      force = 0.0_wp
      do j = 1, size(moment%patch)
         associate (old => moment%patch(j)%fields)
            force = force + dx*ds*[sum(old%pn), sum(old%px), sum(old%py)]
         end associate
      end do
   end function total

   !> Transfer tractions to patches at the given positions
   subroutine receive(moment, places, mx, my, name, fields, problems)
      type(carried_step), intent(inout) :: moment
      !> Shape (2, patches)
      real(wp), intent(in) :: places(:, :)
      integer, intent(in) :: mx, my
      character(len=*), intent(in) :: name
      type(traction_fields), allocatable, intent(out) :: fields(:)
      type(patch_problem), allocatable, intent(out) :: problems(:)
      type(lattice_box), allocatable :: boxes(:)
      type(lattice_window) :: window
      real(wp) :: force(3)
      integer :: k, n

      n = size(places, 2)
      allocate(boxes(n), fields(n), problems(n))
      do k = 1, n
         boxes(k) = box_around(places(:, k), mx, my)
      end do
      call moment%share_out(boxes)
      force = 0.0_wp
      do k = 1, n
         problems(k)%grid = window_around(places(:, k), mx, my)
         window = place_on_lattice(problems(k)%grid, places(:, k))
         call moment%widen(k, window, problems(k)%grid)
         call moment%hand_over(k, problems(k), window, fields(k))
         associate (f => fields(k))
            force = force + dx*ds*[sum(f%pn), sum(f%px), sum(f%py)]
            call suite%close_to(f%force(1), dx*ds*sum(f%pn), 1.0e-10_wp, name // ": the force is that of the tractions")
         end associate
      end do
      associate (all => total(moment))
         do k = 1, 3
            call suite%close_to(force(k), all(k), 1.0e-9_wp, name // ": the total is conserved")
         end do
      end associate
   end subroutine receive

   !> A patch that moves by less than its size: same tractions at the same points of the lattice
   subroutine one_to_one()
      type(carried_step) :: moment
      type(traction_fields), allocatable :: fields(:)
      type(patch_problem), allocatable :: problems(:)
      real(wp) :: place(2), x, old_x

      call moment%start(1, .true., 0.0_wp)
      call add_patch(moment, 1, [3.13_wp, -0.42_wp], 9, 7)
      place = [3.57_wp, -0.29_wp]
      call receive(moment, reshape(place, [2, 1]), 9, 7, "moved patch", fields, problems)
      call suite%check(all(sources_of(moment, 1) == [1]) .and. size(sources_of(moment, 1)) == 1, "it continues the only patch")
      ! where is the element with the largest pressure of the old patch, (8, 6) of it?
      associate (where => maxloc(fields(1)%pn), old => moment%patch(1)%fields%grid)
         x = problems(1)%grid%x(where(1)) + place(1)
         old_x = old%x(8) + 3.13_wp
         call suite%close_to(x, old_x, 1.0e-12_wp, "the element stays where it is along the track")
         x = problems(1)%grid%y(where(2)) + place(2)
         old_x = old%y(6) - 0.42_wp
         call suite%close_to(x, old_x, 1.0e-12_wp, "the element stays where it is across the rail")
      end associate
   end subroutine one_to_one

   !> One patch becomes two, whose windows overlap
   subroutine separate()
      type(carried_step) :: moment
      type(traction_fields), allocatable :: fields(:)
      type(patch_problem), allocatable :: problems(:)
      real(wp) :: places(2, 2)

      call moment%start(1, .false., 0.0_wp)
      call add_patch(moment, 1, [0.0_wp, 0.0_wp], 9, 31)
      places(:, 1) = [0.1_wp, 0.72_wp]
      places(:, 2) = [-0.1_wp, -0.66_wp]
      call receive(moment, places, 9, 15, "separation", fields, problems)
      call suite%check(size(sources_of(moment, 1)) == 1 .and. size(sources_of(moment, 2)) == 1, "both continue the old patch")
      call suite%check(sum(fields(1)%pn) > 0.0_wp .and. sum(fields(2)%pn) > 0.0_wp, "both get a part")
   end subroutine separate

   !> Two patches become one
   subroutine join()
      type(carried_step) :: moment
      type(traction_fields), allocatable :: fields(:)
      type(patch_problem), allocatable :: problems(:)

      call moment%start(2, .false., 0.0_wp)
      call add_patch(moment, 1, [0.1_wp, 0.72_wp], 9, 13)
      call add_patch(moment, 2, [-0.1_wp, -0.66_wp], 7, 13)
      call receive(moment, reshape([0.0_wp, 0.0_wp], [2, 1]), 5, 9, "joining", fields, problems)
      call suite%check(all(sources_of(moment, 1) == [1, 2]), "the new patch continues both")
      call suite%check(problems(1)%grid%my >= 25, "its window holds them both")
   end subroutine join

   !> A patch without a predecessor has no tractions; tractions of a patch without a successor are dropped
   subroutine appear_and_vanish()
      type(carried_step) :: moment
      type(traction_fields) :: fields
      type(patch_problem) :: problem
      type(lattice_window) :: window

      call moment%share_out([box_around([0.0_wp, 0.0_wp], 5, 5)])
      call suite%check(size(sources_of(moment, 1)) == 0, "the first case has no previous tractions")
      call moment%start(1, .true., 0.0_wp)
      call add_patch(moment, 1, [0.0_wp, 0.0_wp], 9, 7)
      call moment%share_out([box_around([0.0_wp, 5.0_wp], 9, 7)])
      problem%grid = window_around([0.0_wp, 5.0_wp], 9, 7)
      window = place_on_lattice(problem%grid, [0.0_wp, 5.0_wp])
      call moment%widen(1, window, problem%grid)
      call suite%check(problem%grid%my == 7, "the window of a new patch stays")
      call moment%hand_over(1, problem, window, fields)
      call suite%check(size(sources_of(moment, 1)) == 0 .and. .not. any(abs(fields%pn) > 0.0_wp) .and. .not. fields%is_solved, &
         & "a new patch begins without tractions")
      call moment%drop_tangential()
      call suite%check(all(abs(moment%patch(1)%fields%px) <= 0.0_wp) .and. any(moment%patch(1)%fields%pn > 0.0_wp), &
         & "only tangential tractions are dropped")
   end subroutine appear_and_vanish

   !> A thousand kilometres of track: the lattice has 64-bit numbers
   subroutine far_along_the_track()
      type(carried_step) :: moment
      type(traction_fields), allocatable :: fields(:)
      type(patch_problem), allocatable :: problems(:)

      call moment%start(1, .true., 1.0e9_wp)
      call add_patch(moment, 1, [1.0e9_wp + 0.07_wp, 0.0_wp], 9, 7)
      call receive(moment, reshape([1.0e9_wp + 0.29_wp, 0.0_wp], [2, 1]), 9, 7, "far away", fields, problems)
      call suite%check(problems(1)%grid%mx <= 11, "the window stays small")
   end subroutine far_along_the_track

   !> From the lattice of the rail to that of the wheelset and back
   subroutine other_frame()
      type(carried_step) :: moment
      real(wp) :: before

      call moment%start(1, .false., 1234.56_wp)
      call add_patch(moment, 1, [0.05_wp, 0.0_wp], 9, 7)
      before = moment%patch(1)%box%x(1)
      call moment%set_frame(.true.)
      call suite%close_to(moment%patch(1)%box%x(1), before + 1234.56_wp, 0.5_wp*dx + 1.0e-9_wp, "on the rail")
      call moment%set_frame(.false.)
      call suite%close_to(moment%patch(1)%box%x(1), before, 1.0e-9_wp, "back on the wheelset")
   end subroutine other_frame

   !> Tractions on other elements cannot be continued
   subroutine other_elements()
      type(carried_step) :: moment
      integer :: dropped

      call moment%start(1, .false., 0.0_wp)
      call add_patch(moment, 1, [0.0_wp, 0.0_wp], 9, 7)
      call moment%drop_other_elements(dx, ds, dropped)
      call suite%check(dropped == 0, "the same elements")
      call moment%drop_other_elements(2.0_wp*dx, ds, dropped)
      call moment%share_out([box_around([0.0_wp, 0.0_wp], 9, 7)])
      call suite%check(dropped == 1 .and. size(sources_of(moment, 1)) == 0, "larger elements")
   end subroutine other_elements

   !> Patches of the time step before that a present one continues
   function sources_of(moment, k) result(list)
      type(carried_step), intent(in) :: moment
      integer, intent(in) :: k
      integer, allocatable :: list(:)

      call moment%find_sources(k, list)
   end function sources_of
end program test_carry_over
