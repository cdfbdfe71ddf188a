!> The tangential problem of a patch in simplified theory
module contact_patch_simplified_step
   use contact_base_choices, only : is_fastrip, motion
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending
   use contact_grid_element_division, only : bounding_box, contact_box, element
   use contact_patch_kinematics, only : rigid_slip
   use contact_patch_problem, only : patch_problem, patch_state, rolling_direction, traction_fields
   use contact_patch_result, only : patch_result
   use contact_patch_workspace, only : patch_workspace
   use contact_simplified_problem, only : simplified_problem
   use contact_simplified_solve, only : solve_simplified
   implicit none (type, external)
   private

   public :: simplified_step

contains

   !> Tangential tractions and slip on a given contact area
   subroutine simplified_step(problem, state, workspace, log, result)
      !> Flexibilities, creepages or forces, friction
      type(patch_problem), intent(in) :: problem
      !> Pressures on entry; tangential tractions on exit
      type(patch_state), intent(inout) :: state
      !> The simplified problem and its solution, as work space
      type(patch_workspace), intent(inout) :: workspace
      !> Receives the trace, and warnings
      type(log_type), intent(inout) :: log
      !> Slip, element states, creepages and the report are set
      type(patch_result), intent(inout) :: result
      type(bounding_box) :: box
      integer :: ix, iy

      box = contact_box(state%now%division)
      workspace%touching = box
      if (box%ix0 > box%ix1) then
         call rigid_slip(problem, result)
         result%tangential%ended = ending%not_started
         return
      end if
      call set_window(problem, state, box, result, workspace%simplified)
      if (is_fastrip(problem%simplified%choice)) then
         if (has_gap(workspace%simplified%contact)) call log%warning("FaStrip on a contact area with a gap across its rows: its &
            &strips are those of one ellipse, and tangential forces are 15 to 42 % too small; the parts should be separate &
            &contacts, or solved by Fastsim")
      end if
      associate (solution => workspace%simplified_solution, report => result%tangential, ix0 => box%ix0, ix1 => box%ix1, &
         & iy0 => box%iy0, iy1 => box%iy1)
         call solve_simplified(workspace%simplified, solution, report)
         report%passes = report%passes + 1
         call trace(log, solution%division, report%iterations, report%method)
         do iy = iy0, iy1
            result%mu(:, iy) = solution%mu(iy - iy0 + 1)
            do ix = ix0, ix1
               state%now%px(ix, iy) = solution%p(ix - ix0 + 1, iy - iy0 + 1, 1)
               state%now%py(ix, iy) = solution%p(ix - ix0 + 1, iy - iy0 + 1, 2)
               result%sx(ix, iy) = solution%slip(ix - ix0 + 1, iy - iy0 + 1, 1)
               result%sy(ix, iy) = solution%slip(ix - ix0 + 1, iy - iy0 + 1, 2)
               state%now%division(ix, iy) = solution%division(ix - ix0 + 1, iy - iy0 + 1)
            end do
         end do
         result%flx = solution%flx
         result%k_eff = solution%slope
         result%centre = workspace%simplified%spin_centre
         result%added_spin = workspace%simplified%added_spin
         if (problem%n_forces >= 1) result%cksi = solution%creep(1) - workspace%simplified%added_creep(1)
         if (problem%n_forces >= 2) result%ceta = solution%creep(2) - workspace%simplified%added_creep(2)
         if (.not. problem%defers_displacements) call rigid_slip(problem, result, spin_weight=solution%flx(1:2)/solution%flx(3))
      end associate
   end subroutine simplified_step

   !> Is there a row without contact between rows with contact?
   pure logical function has_gap(contact)
      !> Elements in contact, in their bounding box
      logical, intent(in) :: contact(:, :)
      integer :: iy

      has_gap = .false.
      do iy = 2, size(contact, 2) - 1
         has_gap = .not. any(contact(:, iy))
         if (has_gap) return
      end do
   end function has_gap

   !> Define the problem on the bounding box of the contact area
   subroutine set_window(problem, state, box, result, window)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      type(bounding_box), intent(in) :: box
      type(patch_result), intent(in) :: result
      type(simplified_problem), intent(inout) :: window
      integer :: ix, iy

      window%model = problem%simplified
      if (allocated(window%contact)) then
         if (any(shape(window%contact) /= [box%ix1 - box%ix0 + 1, box%iy1 - box%iy0 + 1])) deallocate(window%x, window%y)
      end if
      if (.not. allocated(window%x)) then
         associate (mx => box%ix1 - box%ix0 + 1, my => box%iy1 - box%iy0 + 1)
            if (allocated(window%contact)) deallocate(window%contact, window%pn)
            allocate(window%x(mx), window%y(my), window%contact(mx, my), window%pn(mx, my))
         end associate
      end if
      do ix = box%ix0, box%ix1
         window%x(ix - box%ix0 + 1) = problem%grid%x(ix)
      end do
      do iy = box%iy0, box%iy1
         window%y(iy - box%iy0 + 1) = problem%grid%y(iy)
         do ix = box%ix0, box%ix1
            window%contact(ix - box%ix0 + 1, iy - box%iy0 + 1) = state%now%division(ix, iy) > element%exterior
            window%pn(ix - box%ix0 + 1, iy - box%iy0 + 1) = state%now%pn(ix, iy)
         end do
      end do
      window%dx = problem%grid%dx
      window%dy = problem%grid%dy
      window%mu = result%mu(box%ix0, box%iy0:box%iy1)
      if (allocated(window%law)) deallocate(window%law)
      if (allocated(problem%friction)) then
         allocate(window%law, source=problem%friction)
         if (window%law%varies_by_row()) window%law%sets = problem%friction%sets(box%iy0:box%iy1)
      end if
      window%velocity = problem%veloc
      window%mu_scal = result%mu_scal
      window%fn = result%fn
      window%gg = problem%model%material%gg
      window%nu = problem%model%material%nu
      window%steady = problem%motion == motion%steady_rolling
      window%shift = problem%motion == motion%shift
      window%direction = rolling_direction(problem)
      window%dq = problem%dq
      window%creep = problem%creep
      window%spin = problem%spin
      window%spin_weight = problem%spin_weight
      window%spin_centre = problem%spin_centre
      window%spin_offset = problem%spin_offset*problem%dq*[cos(problem%chi), sin(problem%chi)]
      window%n_forces = problem%n_forces
      window%force = problem%force
      window%eps = problem%settings%eps
      if (allocated(window%extra_slip)) deallocate(window%extra_slip)
      if (allocated(problem%extra_slip)) window%extra_slip = problem%extra_slip(box%ix0:box%ix1, box%iy0:box%iy1, :)
      if (allocated(window%before)) deallocate(window%before)
      if (.not. window%steady) then
         allocate(window%before(size(window%x), size(window%y), 2))
         call sample_before(problem, state%before, box, window%before)
      end if
   end subroutine set_window

   !> Tractions of the previous time step at the present positions of the particles
   !>
   !> Linear interpolation between centres of elements if the step is not a whole number of elements.
   pure subroutine sample_before(problem, before, box, p)
      type(patch_problem), intent(in) :: problem
      type(traction_fields), intent(in) :: before
      type(bounding_box), intent(in) :: box
      real(wp), intent(inout) :: p(:, :, :)
      real(wp), parameter :: rounding = 1.0e-9_wp, limit = 1.0e8_wp
      real(wp) :: distance(2), share(2), weight
      integer :: whole(2), ix, iy, jx, jy, k, l

      p = 0.0_wp
      distance = 0.0_wp
      if (problem%motion == motion%transient_rolling) distance = problem%dq*[cos(problem%chi)/problem%grid%dx, &
         & sin(problem%chi)/problem%grid%dy]
      ! beyond the grid there are no tractions, whatever the distance
      distance = max(-limit, min(limit, distance))
      whole = floor(distance + rounding)
      share = max(0.0_wp, distance - whole)
      where (share < rounding) share = 0.0_wp
      do l = 0, 1
         do k = 0, 1
            weight = merge(share(1), 1.0_wp - share(1), k == 1)*merge(share(2), 1.0_wp - share(2), l == 1)
            if (weight <= 0.0_wp) cycle
            do iy = box%iy0, box%iy1
               jy = iy + whole(2) + l
               if (jy < 1 .or. jy > problem%grid%my) cycle
               do ix = box%ix0, box%ix1
                  jx = ix + whole(1) + k
                  if (jx < 1 .or. jx > problem%grid%mx) cycle
                  p(ix - box%ix0 + 1, iy - box%iy0 + 1, 1) = p(ix - box%ix0 + 1, iy - box%iy0 + 1, 1) + weight*before%px(jx, jy)
                  p(ix - box%ix0 + 1, iy - box%iy0 + 1, 2) = p(ix - box%ix0 + 1, iy - box%iy0 + 1, 2) + weight*before%py(jx, jy)
               end do
            end do
         end do
      end do
   end subroutine sample_before

   !> Lines of the flow trace
   subroutine trace(log, division, iterations, method)
      type(log_type), intent(inout) :: log
      integer, intent(in) :: division(:, :), iterations
      character(len=*), intent(in) :: method
      character(len=80) :: line

      if (log%shows(2)) then
         line = " TANG: STEADY STATE ROLLING BY THE FASTSIM APPROACH"
         if (method == "FaStrip") line = " TANG: STEADY STATE ROLLING BY THE FASTRIP APPROACH"
         call log%trace(2, trim(line))
      end if
      if (.not. log%shows(3)) return
      write(line, "(A,2I7,A,I6)") "      Tang: final element division: A, S=", count(division == element%adhesion), &
         & count(division == element%slip), "  ItGS=", iterations
      call log%trace(3, trim(line))
   end subroutine trace
end module contact_patch_simplified_step
