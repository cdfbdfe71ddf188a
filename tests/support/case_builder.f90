!> Cases built in memory for the tests: specifications, one session with its result, random numbers
!>
!>     type(test_case) :: case
!>     case%spec = hertz_case(a1=0.01_wp, b1=0.01_wp, fn=10.0_wp, mx=31, my=31)
!>     call creep(case%spec, motion%steady_rolling, ksi=1.0e-3_wp)
!>     call case%run(suite, "rolling sphere")
module contact_test_case_builder
   use, intrinsic :: iso_fortran_env, only : int64, output_unit
   use contact_base_choices, only : estimate_choice, motion, normal_control, solver_choice, time_link
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_session, only : contact_session, release_session, solve_case
   use contact_cases_spec, only : case_spec, friction_set
   use contact_patch_result, only : patch_result
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   private

   public :: test_case, start_case, random_numbers, hertz_case, ellipse_case, line_case, grid_case, surface_case
   public :: creep, shift, forces, order_of, observed

   !> A specification with the session that solves it
   type :: test_case
      type(case_spec) :: spec
      type(contact_session) :: session
      type(patch_result) :: result
      type(log_type) :: log
   contains
      !> Solve, and check that the solvers converge
      procedure :: run
      !> Solve without a check of convergence
      procedure :: try
      !> Release the memory of the session
      procedure :: release
      !> The same at the end of a scope; one call there compiles faster than the release of all components
      final :: finish
   end type test_case

   !> Reproducible random numbers (xorshift, Marsaglia 2003)
   type :: random_numbers
      integer(int64) :: state = 88172645463325252_int64
   contains
      !> Uniform in [low, high]
      procedure :: uniform
      !> Logarithm uniform in the range
      procedure :: logarithmic
      !> Integer in low...high
      procedure :: whole
   end type random_numbers

contains

   !> Solve the case; a failure or an iteration without convergence is a failed check
   subroutine run(self, suite, what)
      class(test_case), intent(inout) :: self
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: what
      type(error_type), allocatable :: error

      call self%try(error)
      if (allocated(error)) then
         call suite%check(.false., what // ": " // full_text(error))
         return
      end if
      call suite%check(self%result%normal%succeeded(), what // ": the normal problem converges")
      call suite%check(self%result%tangential%succeeded(), what // ": the tangential problem converges")
   end subroutine run

   subroutine try(self, error)
      class(test_case), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      call solve_case(self%session, self%spec, self%log, self%result, error)
   end subroutine try

   impure elemental subroutine finish(self)
      type(test_case), intent(inout) :: self
      call self%release()
   end subroutine finish

   subroutine release(self)
      class(test_case), intent(inout) :: self
      call release_session(self%session)
   end subroutine release

   !> Start again: a case with this specification and without a history
   subroutine start_case(case, spec)
      type(test_case), intent(inout) :: case
      type(case_spec), intent(in) :: spec
      type(test_case) :: fresh

      fresh%spec = spec
      call case%release()
      case = fresh
   end subroutine start_case

   !> Normal compression with a tight tolerance, the initial state of all cases below
   function base_case(fn, eps) result(spec)
      !> Normal force [N]
      real(wp), intent(in) :: fn
      real(wp), intent(in), optional :: eps
      type(case_spec) :: spec

      spec%link = time_link%initiate
      spec%motion = motion%none
      spec%normal = normal_control%force
      spec%estimate = estimate_choice%fresh
      spec%solver = solver_choice%default
      spec%kinematics%fn = fn
      spec%iteration%eps = 1.0e-9_wp
      if (present(eps)) spec%iteration%eps = eps
      spec%iteration%maxgs = 20000
      spec%iteration%maxin = 100
      spec%iteration%maxnr = 100
      allocate(spec%friction%sets(1))
      spec%friction%sets(1) = friction_set()
      spec%material%gg = 200.0_wp
      spec%material%poiss = 0.28_wp
   end function base_case

   !> Quadratic surfaces by their curvatures; the window is `scale` times the contact ellipse
   function hertz_case(a1, b1, fn, mx, my, scale, eps) result(spec)
      !> Curvatures [1/mm]: h = a1 x**2 + b1 y**2; normal force [N]
      real(wp), intent(in) :: a1, b1, fn
      integer, intent(in) :: mx, my
      real(wp), intent(in), optional :: scale, eps
      type(case_spec) :: spec

      spec = base_case(fn, eps)
      spec%grid%form = -1
      spec%grid%a1 = a1
      spec%grid%b1 = b1
      spec%grid%mx = mx
      spec%grid%my = my
      spec%grid%scale = 1.1_wp
      if (present(scale)) spec%grid%scale = scale
   end function hertz_case

   !> Quadratic surfaces by the semi-axes of the contact ellipse
   function ellipse_case(aa, bb, fn, mx, my, scale, eps) result(spec)
      !> Semi-axes [mm]; normal force [N]
      real(wp), intent(in) :: aa, bb, fn
      integer, intent(in) :: mx, my
      real(wp), intent(in), optional :: scale, eps
      type(case_spec) :: spec

      spec = hertz_case(0.0_wp, 0.0_wp, fn, mx, my, scale, eps)
      spec%grid%form = -3
      spec%grid%aa = aa
      spec%grid%bb = bb
   end function ellipse_case

   !> Cylinders: one row of very long elements
   function line_case(aa, bb, fn, mx, scale, eps) result(spec)
      !> Half width and half length [mm]; normal force [N]
      real(wp), intent(in) :: aa, bb, fn
      integer, intent(in) :: mx
      real(wp), intent(in), optional :: scale, eps
      type(case_spec) :: spec

      spec = ellipse_case(aa, bb, fn, mx, 1, scale, eps)
      spec%grid%form = -5
   end function line_case

   !> Quadratic surfaces on a given window, centred at the origin
   function grid_case(a1, b1, fn, mx, my, dx, dy, eps) result(spec)
      real(wp), intent(in) :: a1, b1, fn
      integer, intent(in) :: mx, my
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      real(wp), intent(in), optional :: eps
      type(case_spec) :: spec

      spec = base_case(fn, eps)
      spec%grid%form = 1
      spec%grid%mx = mx
      spec%grid%my = my
      spec%grid%dx = dx
      spec%grid%dy = dy
      spec%grid%xl = -0.5_wp*mx*dx
      spec%grid%yl = -0.5_wp*my*dy
      spec%geometry%form = 1
      spec%geometry%b = 0.0_wp
      spec%geometry%b(1) = a1
      spec%geometry%b(3) = b1
   end function grid_case

   !> Undeformed distance element by element
   function surface_case(h, fn, dx, dy, eps) result(spec)
      !> Undeformed distance [mm], shape (mx, my)
      real(wp), intent(in) :: h(:, :)
      real(wp), intent(in) :: fn, dx, dy
      real(wp), intent(in), optional :: eps
      type(case_spec) :: spec

      spec = grid_case(0.0_wp, 0.0_wp, fn, size(h, 1), size(h, 2), dx, dy, eps)
      spec%geometry%form = 9
      spec%geometry%h = reshape(h, [size(h)])
   end function surface_case

   !> Rolling with prescribed creepages; steps of one element along x
   subroutine creep(spec, kind, ksi, eta, phi, mu)
      type(case_spec), intent(inout) :: spec
      !> Member of motion
      integer, intent(in) :: kind
      real(wp), intent(in), optional :: ksi, eta, phi, mu

      spec%motion = kind
      if (present(ksi)) spec%kinematics%cksi = ksi
      if (present(eta)) spec%kinematics%ceta = eta
      if (present(phi)) spec%kinematics%cphi = phi
      if (present(mu)) then
         spec%friction%sets(1)%fstat = mu
         spec%friction%sets(1)%fkin = mu
      end if
      if (spec%grid%form > 0) spec%rolling%dq = spec%grid%dx
   end subroutine creep

   !> Shift with prescribed displacements [mm]
   subroutine shift(spec, x, y, mu)
      type(case_spec), intent(inout) :: spec
      real(wp), intent(in), optional :: x, y, mu

      call creep(spec, motion%shift, x, y, mu=mu)
   end subroutine shift

   !> Prescribe tangential forces relative to the friction bound instead of creepages
   subroutine forces(spec, fx, fy)
      type(case_spec), intent(inout) :: spec
      real(wp), intent(in) :: fx
      real(wp), intent(in), optional :: fy

      spec%force = 1
      spec%kinematics%fx = fx
      if (.not. present(fy)) return
      spec%force = 2
      spec%kinematics%fy = fy
   end subroutine forces

   !> Observed order: slope of the line through (log h, log |error|), least squares
   pure real(wp) function order_of(h, error) result(order)
      real(wp), intent(in) :: h(:), error(:)
      real(wp) :: x(size(h)), y(size(h))

      x = log(h)
      y = log(abs(error))
      x = x - sum(x)/size(x)
      y = y - sum(y)/size(y)
      order = sum(x*y)/sum(x*x)
   end function order_of

   !> Print the errors on a sequence of grids, check their order and the error on the finest grid
   subroutine observed(suite, name, h, error, order, band, finest)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: name
      !> Sizes of the elements, coarse to fine, and the relative errors
      real(wp), intent(in) :: h(:), error(:)
      !> Expected order, its tolerance, and the largest error on the finest grid
      real(wp), intent(in) :: order, band, finest

      write(output_unit, "(a, t36, a, f5.2, a, *(es9.1))") name, "order", order_of(h, error), "  errors", error
      call suite%close_to(order_of(h, error), order, band, name // ": order")
      call suite%close_to(error(size(error)), 0.0_wp, finest, name // ": error on the finest grid")
   end subroutine observed

   real(wp) function uniform(self, low, high) result(value)
      class(random_numbers), intent(inout) :: self
      real(wp), intent(in) :: low, high

      self%state = ieor(self%state, shiftl(self%state, 13))
      self%state = ieor(self%state, shiftr(self%state, 7))
      self%state = ieor(self%state, shiftl(self%state, 17))
      value = low + (high - low)*real(shiftr(self%state, 11), wp)/2.0_wp**53
   end function uniform

   real(wp) function logarithmic(self, low, high) result(value)
      class(random_numbers), intent(inout) :: self
      !> Positive
      real(wp), intent(in) :: low, high

      value = exp(self%uniform(log(low), log(high)))
   end function logarithmic

   integer function whole(self, low, high) result(value)
      class(random_numbers), intent(inout) :: self
      integer, intent(in) :: low, high

      value = min(high, low + int(self%uniform(0.0_wp, real(high - low + 1, wp))))
   end function whole
end module contact_test_case_builder
