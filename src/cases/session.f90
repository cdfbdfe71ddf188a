!> One contact problem through its cases: specification in, result out
module contact_cases_session
   use contact_base_choices, only : estimate_choice, motion, normal_control, pressure_model, &
      & slip_source, solver_choice, stress_choice, time_link
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_geometry, only : build_grid, is_line_contact, solve_hertz, undeformed_distance
   use contact_cases_numbers, only : check_numbers
   use contact_cases_spec, only : case_spec
   use contact_elastic_material, only : combine
   use contact_grid_element_division, only : element
   use contact_grid_potential_contact, only : potential_contact
   use contact_normal_estimate, only : elliptic_pressure, parabolic_pressure
   use contact_patch_problem, only : patch_problem, patch_state, traction_fields
   use contact_patch_result, only : patch_result
   use contact_patch_solve, only : fit_fields, patch_workspace, release_workspace, solve_patch
   use contact_subsurface_points, only : expand_points
   use contact_subsurface_stress, only : stress_invariants, subsurface_field
   implicit none (type, external)
   private

   public :: contact_session, release_session, solve_case

   !> Memory of one problem: what the physics remembers, and scratch
   type :: contact_session
      type(patch_state) :: state
      type(patch_workspace) :: workspace
      type(patch_problem) :: problem
      !> Undeformed distance may be reused while grid, geometry and load stay what they are
      logical :: has_geometry = .false.
   end type contact_session

contains

   !> Solve one case, or only take note of its input (R = 2, 3)
   subroutine solve_case(session, spec, log, result, error)
      type(contact_session), intent(inout) :: session
      !> Complete specification
      type(case_spec), intent(in) :: spec
      type(log_type), intent(inout) :: log
      !> Arrays of the right size are reused
      type(patch_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error

      log%level = spec%flow_level
      call set_problem(session, spec, log, result, error)
      if (allocated(error)) return
      call link_moments(session%problem, spec%link, session%state, error)
      if (allocated(error)) then
         call forget(session, result)
         return
      end if
      call choose_estimate(session, spec, result)
      if (.not. spec%solve) return
      call solve_patch(session%problem, session%state, session%workspace, log, result, error)
      if (allocated(error)) return
      call name_effects(spec, session%problem, result)
      if (allocated(result%subsurface)) deallocate(result%subsurface)
      if (spec%stress /= stress_choice%none) call subsurface_stresses(spec, result)
   end subroutine solve_case

   !> Free what a session holds outside Fortran's memory; call it before the session goes
   subroutine release_session(session)
      type(contact_session), intent(inout) :: session
      call release_workspace(session%workspace)
   end subroutine release_session

   !> From the specification to the problem of the patch
   subroutine set_problem(session, spec, log, result, error)
      type(contact_session), intent(inout) :: session
      type(case_spec), intent(in) :: spec
      type(log_type), intent(inout) :: log
      type(patch_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      call check_numbers(spec, error)
      if (allocated(error)) return
      associate (problem => session%problem)
         problem%material = combine(spec%material%poiss, spec%material%gg)
         call solve_hertz(spec%grid, spec%normal, spec%kinematics%fn, spec%kinematics%pen, problem%material%gg, &
            & problem%material%nu, result%hertz, error)
         if (allocated(error)) return
         problem%fn = spec%kinematics%fn
         problem%pen = spec%kinematics%pen
         problem%force_prescribed = spec%normal == normal_control%force
         ! a Hertzian geometry is laid out anew when the case gives a grid, not when the load changes
         if (spec%new_grid .or. spec%new_geometry .or. .not. session%has_geometry) then
            call set_geometry(session, spec, result, error)
            if (allocated(error)) return
         end if
         call set_pressures(spec, result, problem)
         problem%motion = spec%motion
         problem%estimate = spec%estimate
         problem%solver = spec%solver
         problem%n_forces = spec%force
         problem%force = [spec%kinematics%fx, spec%kinematics%fy]
         problem%creep = [spec%kinematics%cksi, spec%kinematics%ceta]
         problem%spin = spec%kinematics%cphi
         problem%spin_centre = [spec%kinematics%spinxo, spec%kinematics%spinyo]
         problem%mu = spec%friction%sets(1)%fstat
         problem%eps = spec%iteration%eps
         problem%maxgs = spec%iteration%maxgs
         problem%maxin = spec%iteration%maxin
         problem%maxnr = spec%iteration%maxnr
         problem%maxout = spec%iteration%maxout
         problem%relaxation_given = spec%solver == solver_choice%convex_gs .or. spec%solver == solver_choice%gauss_seidel
         problem%omegah = spec%iteration%omegah
         problem%omegas = spec%iteration%omegas
         problem%fdecay = spec%iteration%fdecay
         problem%betath = spec%iteration%betath
         problem%kdowfb = spec%iteration%kdowfb
         problem%d_ifc = spec%iteration%d_ifc
         problem%d_lin = spec%iteration%d_lin
         problem%d_cns = spec%iteration%d_cns
         problem%d_slp = spec%iteration%d_slp
         problem%pow_s = spec%iteration%pow_s
         problem%want_exterior = spec%mat_file >= 2 .or. spec%output_level >= 6
         call set_rolling(spec, problem, log)
         if (allocated(problem%extra_slip)) deallocate(problem%extra_slip)
         if (spec%slip_source == slip_source%given .or. spec%slip_source == slip_source%keep) then
            if (.not. allocated(spec%extra_slip)) then
               call fatal_error(error, "extra rigid slip is to be kept (E=1), but none was given before")
               return
            end if
            if (size(spec%extra_slip, 2) /= problem%grid%npot()) then
               call fatal_error(error, "the extra rigid slip was given for another number of elements")
               return
            end if
            allocate(problem%extra_slip(problem%grid%mx, problem%grid%my, 2))
            do i = 1, 2
               problem%extra_slip(:, :, i) = reshape(spec%extra_slip(i, :), [problem%grid%mx, problem%grid%my])
            end do
         end if
      end associate
   end subroutine set_problem

   !> Potential contact and undeformed distance
   subroutine set_geometry(session, spec, result, error)
      type(contact_session), intent(inout) :: session
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      type(error_type), allocatable, intent(out) :: error
      type(potential_contact) :: grid

      session%has_geometry = .false.
      call build_grid(spec%grid, result%hertz, grid, error)
      if (allocated(error)) return
      session%problem%grid = grid
      call undeformed_distance(spec%geometry, grid, result%hertz, session%problem%h, error)
      if (allocated(error)) return
      session%has_geometry = .true.
   end subroutine set_geometry

   !> Given pressures, or an estimate of them, from the Hertz solution
   subroutine set_pressures(spec, result, problem)
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      type(patch_problem), intent(inout) :: problem

      if (allocated(problem%given_pressure)) deallocate(problem%given_pressure)
      if (.not. allocated(result%hertz)) return
      select case (spec%pressure)
      case (pressure_model%elliptical)
         allocate(problem%given_pressure(problem%grid%mx, problem%grid%my))
         call elliptic_pressure(problem%grid, result%hertz%aa, result%hertz%bb, is_line_contact(spec%grid), &
            & result%hertz%fn, problem%given_pressure)
      case (pressure_model%parabolical)
         allocate(problem%given_pressure(problem%grid%mx, problem%grid%my))
         call parabolic_pressure(problem%grid, result%hertz%aa, result%hertz%bb, is_line_contact(spec%grid), &
            & result%hertz%fn, problem%given_pressure)
      end select
      if (allocated(problem%given_pressure)) then
         problem%fn = result%hertz%fn
         problem%pen = result%hertz%pen
      end if
   end subroutine set_pressures

   !> Rolling direction and step; steady solvers work with steps of one element along x
   subroutine set_rolling(spec, problem, log)
      type(case_spec), intent(in) :: spec
      type(patch_problem), intent(inout) :: problem
      type(log_type), intent(inout) :: log
      real(wp), parameter :: angle_tolerance = 0.01_wp, step_tolerance = 0.01_wp
      logical :: rolling

      rolling = spec%motion == motion%transient_rolling .or. spec%motion == motion%steady_rolling
      problem%chi = 0.0_wp
      problem%dq = 1.0_wp
      problem%veloc = 1.0_wp
      problem%spin_offset = 0.0_wp
      if (.not. rolling) return
      problem%chi = spec%rolling%chi
      problem%dq = spec%rolling%dq
      problem%veloc = spec%rolling%veloc
      problem%spin_offset = spec%rolling%facphi
      if (spec%motion /= motion%steady_rolling) then
         if (problem%dq > (1.0_wp + step_tolerance)*problem%grid%dx) call log%warning( &
            & "DQ is larger than DX: slip near the leading edge is less accurate, it is not corrected in this version")
         return
      end if
      if (abs(sin(problem%chi)) > angle_tolerance) then
         call log%warning("steady rolling goes along x: CHI is set to 0")
         problem%chi = 0.0_wp
      end if
      if (abs(problem%dq - problem%grid%dx) > step_tolerance*problem%grid%dx) &
         & call log%warning("steady rolling advances by one element per step: DQ is set to DX")
      problem%dq = problem%grid%dx
   end subroutine set_rolling

   !> Present moment becomes the previous one, on the window of this case
   subroutine link_moments(problem, link, state, error)
      type(patch_problem), intent(in) :: problem
      !> Member of time_link
      integer, intent(in) :: link
      type(patch_state), intent(inout) :: state
      type(error_type), allocatable, intent(out) :: error
      integer :: kx, ky
      logical :: linked

      linked = state%started .and. (link /= time_link%initiate .or. problem%estimate /= estimate_choice%fresh)
      if (linked) then
         call offset_of(state%now%grid, problem%grid, kx, ky, error)
         if (allocated(error)) return
         call move_window(state%now, problem%grid, kx, ky)
         if (state%before%grid%mx > 0) call move_window(state%before, problem%grid, kx, ky)
      else
         call clear(state%now, problem%grid)
         state%creep = 0.0_wp
      end if
      select case (link)
      case (time_link%repeat_step)
         if (.not. state%before%grid%mx > 0) call clear(state%before, problem%grid)
      case (time_link%continue_all)
         call copy_fields(state%now, state%before)
      case (time_link%continue_normal)
         call copy_fields(state%now, state%before)
         state%before%px = 0.0_wp
         state%before%py = 0.0_wp
      case default
         call clear(state%before, problem%grid)
      end select
   end subroutine link_moments

   !> Number of elements by which a window was moved
   subroutine offset_of(old, new, kx, ky, error)
      type(potential_contact), intent(in) :: old, new
      integer, intent(out) :: kx, ky
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: x, y
      !> Tolerances of the guide: 0.01 % of the step, 0.1 % of an element
      real(wp), parameter :: step_tolerance = 1.0e-4_wp, place_tolerance = 1.0e-3_wp

      kx = 0
      ky = 0
      if (abs(new%dx - old%dx) > step_tolerance*new%dx .or. abs(new%dy - old%dy) > step_tolerance*new%dy) then
         call fatal_error(error, "the element sizes differ from those of the previous case, to which this one is linked; " // &
            & "the same DX and DY, or P=2 with I=0")
         return
      end if
      x = (new%xl - old%xl)/new%dx
      y = (new%yl - old%yl)/new%dy
      kx = nint(x)
      ky = nint(y)
      if (abs(x - kx) > place_tolerance .or. abs(y - ky) > place_tolerance) then
         call fatal_error(error, "the potential contact is not shifted by whole elements with respect to the previous case, " // &
            & "to which this one is linked; a shift by whole elements, or P=2 with I=0")
      end if
   end subroutine offset_of

   !> Fields on a moved window: values of the overlap, zero where new
   subroutine move_window(fields, grid, kx, ky)
      type(traction_fields), intent(inout) :: fields
      type(potential_contact), intent(in) :: grid
      integer, intent(in) :: kx, ky
      type(traction_fields) :: old
      integer :: ix, iy, jx, jy

      if (kx == 0 .and. ky == 0 .and. all(shape(fields%division) == [grid%mx, grid%my])) then
         fields%grid = grid
         return
      end if
      old = fields
      deallocate(fields%division, fields%pn, fields%px, fields%py)
      call fit_fields(fields, grid%mx, grid%my)
      fields%grid = grid
      do iy = 1, grid%my
         jy = iy + ky
         if (jy < 1 .or. jy > old%grid%my) cycle
         do ix = 1, grid%mx
            jx = ix + kx
            if (jx < 1 .or. jx > old%grid%mx) cycle
            fields%division(ix, iy) = old%division(jx, jy)
            fields%pn(ix, iy) = old%pn(jx, jy)
            fields%px(ix, iy) = old%px(jx, jy)
            fields%py(ix, iy) = old%py(jx, jy)
         end do
      end do
   end subroutine move_window

   !> No contact
   subroutine clear(fields, grid)
      type(traction_fields), intent(inout) :: fields
      type(potential_contact), intent(in) :: grid

      call fit_fields(fields, grid%mx, grid%my)
      fields%grid = grid
      fields%division = element%exterior
      fields%pn = 0.0_wp
      fields%px = 0.0_wp
      fields%py = 0.0_wp
      fields%pen = 0.0_wp
   end subroutine clear

   !> Copy of the fields of a moment
   subroutine copy_fields(from, to)
      type(traction_fields), intent(in) :: from
      type(traction_fields), intent(inout) :: to

      call fit_fields(to, from%grid%mx, from%grid%my)
      to%grid = from%grid
      to%division = from%division
      to%pn = from%pn
      to%px = from%px
      to%py = from%py
      to%pen = from%pen
   end subroutine copy_fields

   !> Zero tractions and no contact, after a case that could not be linked
   subroutine forget(session, result)
      type(contact_session), intent(inout) :: session
      type(patch_result), intent(inout) :: result

      call clear(session%state%now, session%problem%grid)
      call clear(session%state%before, session%problem%grid)
      session%state%started = .true.
      result%ncon = 0
   end subroutine forget

   !> What the iteration starts from
   subroutine choose_estimate(session, spec, result)
      type(contact_session), intent(inout) :: session
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result

      associate (problem => session%problem, now => session%state%now)
         if (allocated(problem%pressure_estimate)) deallocate(problem%pressure_estimate)
         select case (spec%estimate)
         case (estimate_choice%fresh)
            now%px = 0.0_wp
            now%py = 0.0_wp
            now%pn = 0.0_wp
            now%division = element%exterior
            session%state%creep = 0.0_wp
            if (allocated(result%hertz) .and. .not. allocated(problem%given_pressure)) then
               allocate(problem%pressure_estimate(problem%grid%mx, problem%grid%my))
               call elliptic_pressure(problem%grid, result%hertz%aa, result%hertz%bb, is_line_contact(spec%grid), &
                  & result%hertz%fn, problem%pressure_estimate)
            end if
         case (estimate_choice%previous_normal)
            now%px = 0.0_wp
            now%py = 0.0_wp
            where (now%division > element%exterior) now%division = element%adhesion
            session%state%creep = 0.0_wp
         end select
      end associate
   end subroutine choose_estimate

   !> Names of the effects that acted
   subroutine name_effects(spec, problem, result)
      type(case_spec), intent(in) :: spec
      type(patch_problem), intent(in) :: problem
      type(patch_result), intent(inout) :: result
      character(len=:), allocatable :: text

      text = "elastic half-spaces"
      if (allocated(problem%given_pressure)) text = text // ", Hertzian pressure"
      if (result%ncon > 0) then
         if (problem%motion == motion%shift) text = text // ", Coulomb friction in a shift"
         if (problem%motion == motion%transient_rolling) text = text // ", Coulomb friction in transient rolling"
         if (problem%motion == motion%steady_rolling) text = text // ", Coulomb friction in steady rolling"
         if (problem%motion /= motion%none .and. problem%material%coupled()) text = text // ", dissimilar bodies"
         if (allocated(problem%extra_slip) .and. problem%motion /= motion%none) text = text // ", extra rigid slip"
         if (spec%stress /= stress_choice%none) text = text // ", subsurface stresses"
      end if
      result%effects = text
   end subroutine name_effects

   !> Displacements and stresses in the blocks of points
   subroutine subsurface_stresses(spec, result)
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(inout) :: result
      integer :: k, n

      if (.not. allocated(spec%subsurface%blocks)) return
      allocate(result%subsurface(size(spec%subsurface%blocks)))
      do k = 1, size(result%subsurface)
         associate (points => result%subsurface(k))
            call expand_points(spec%subsurface%blocks(k), result%grid, points%nx, points%ny, points%nz, points%position)
            n = size(points%position, 2)
            allocate(points%displacement(3, n), points%stress(6, n), points%sighyd(n), points%sigvm(n), points%sigtr(n), &
               & points%sigma1(n), points%sigma3(n))
            call subsurface_field(result%grid, result%pn, result%px, result%py, spec%material%gg, spec%material%poiss, &
               & points%position, points%displacement, points%stress)
            call stress_invariants(points%stress, points%sighyd, points%sigvm, points%sigtr, points%sigma1, points%sigma3)
         end associate
      end do
   end subroutine subsurface_stresses
end module contact_cases_session
