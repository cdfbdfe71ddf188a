!> The problems of the benchmark: those of the specification of the fast solver, and tables
module contact_bench_problems
   use contact_base_choices, only : estimate_choice, material_model, motion, normal_control, pressure_model, &
      & solver_choice, time_link
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : solve_report
   use contact_bench_measure, only : timed_case
   use contact_cases_session, only : contact_session, release_session, solve_case
   use contact_cases_spec, only : case_spec, part_source
   use contact_elastic_material, only : combine, combined_material
   use contact_elastic_model, only : elastic_model
   use contact_elastic_operator, only : elastic_operator
   use contact_normal_conjugate_gradient, only : normal_problem, normal_workspace, release_normal, solve_normal
   use contact_patch_result, only : patch_result
   use contact_tangential_classical, only : solve_classical
   use contact_tangential_nested, only : nested_workspace, release_nested, solve_newton_krylov
   use contact_tangential_problem, only : prepare_solution, tangential_problem, tangential_solution
   use contact_friction_new_law, only : friction_model
   implicit none (type, external)
   private

   public :: normal_case, tangential_case, session_case, rolling_contact, rolling_contacts
   public :: new_normal_case, new_rolling_case, new_shift_case, new_table_case, new_line_case, table_creepage
   public :: table_kind, table_kinds, set_table_kind, solve_one, table_size

   !> A ball on a flat, free boundary
   type, extends(timed_case) :: normal_case
      type(normal_problem) :: problem
      type(elastic_operator) :: operator
      type(normal_workspace) :: workspace
      real(wp), allocatable :: p(:, :)
      !> Approach [mm] when it is prescribed
      real(wp) :: pen = 0.0_wp
      !> Does the next run differ from the last one in the last bit? The same problem again would be answered from memory
      logical :: turn = .false.
      !> Elements in contact after the solution
      integer :: contact = 0
   contains
      procedure :: run => run_normal
      procedure :: release => release_normal_case
   end type normal_case

   !> Tangential problem with given bounds, from zero
   type, extends(timed_case) :: tangential_case
      type(tangential_problem) :: problem
      type(tangential_solution) :: solution
      type(elastic_operator) :: operator
      type(nested_workspace) :: workspace
      !> 0 for Newton-Krylov, else a member of classical_method
      integer :: method = 0
   contains
      procedure :: run => run_tangential
      procedure :: release => release_tangential_case
   end type tangential_case

   !> Cases through a session as the driver does it
   type, extends(timed_case) :: session_case
      type(contact_session), allocatable :: session
      type(case_spec) :: spec
      type(patch_result) :: result
      type(log_type) :: log
      !> See normal_case
      logical :: turn = .false.
   contains
      procedure :: run => run_session
      procedure :: release => release_session_case
   end type session_case

   !> A contact of newton.md
   type :: rolling_contact
      character(len=24) :: name
      !> Semi-axes [mm], force [N]
      real(wp) :: a, b, fn
      !> Creepages [-], spin [rad/mm]
      real(wp) :: ksi, eta, phi
      !> Prescribed forces and their relative values
      integer :: n_forces
      real(wp) :: force(2)
   end type rolling_contact

   real(wp), parameter :: zero(2) = [0.0_wp, 0.0_wp], spin = 3.0e-4_wp, load = 30000.0_wp
   !> newton.md; the prescribed forces at the spin of the first contact
   type(rolling_contact), parameter :: rolling_contacts(*) = [ &
      & rolling_contact("base", 3.0_wp, 5.0_wp, load, 5.0e-4_wp, 0.0_wp, spin, 0, zero), &
      & rolling_contact("fastsim geometry", 8.0_wp, 4.0_wp, 82000.0_wp, 0.0_wp, -6.25e-4_wp, 6.25e-4_wp, 0, zero), &
      & rolling_contact("86 % saturated", 3.0_wp, 5.0_wp, load, 3.0e-3_wp, 1.0e-3_wp, spin, 0, zero), &
      & rolling_contact("full adhesion", 3.0_wp, 5.0_wp, load, 1.0e-6_wp, 0.0_wp, 0.0_wp, 0, zero), &
      & rolling_contact("F (-0.2, 0)", 3.0_wp, 5.0_wp, load, 0.0_wp, 0.0_wp, spin, 2, [-0.2_wp, 0.0_wp]), &
      & rolling_contact("F (-0.573, -0.327)", 3.0_wp, 5.0_wp, load, 0.0_wp, 0.0_wp, spin, 2, [-0.573_wp, -0.327_wp]), &
      & rolling_contact("F (-0.9, 0.1)", 3.0_wp, 5.0_wp, load, 0.0_wp, 0.0_wp, spin, 2, [-0.9_wp, 0.1_wp]), &
      & rolling_contact("F (-0.99, 0)", 3.0_wp, 5.0_wp, load, 0.0_wp, 0.0_wp, spin, 2, [-0.99_wp, 0.0_wp]), &
      & rolling_contact("F (-0.999, 0)", 3.0_wp, 5.0_wp, load, 0.0_wp, 0.0_wp, spin, 2, [-0.999_wp, 0.0_wp]), &
      & rolling_contact("F (-0.7, 0.7)", 3.0_wp, 5.0_wp, load, 0.0_wp, 0.0_wp, spin, 2, [-0.7_wp, 0.7_wp])]
   real(wp), parameter :: mu = 0.3_wp, poisson = 0.28_wp, modulus = 82000.0_wp
   !> A kind of repeated cases: its name in set_table_kind, and how often a case may ask for memory
   type :: table_kind
      character(len=12) :: name
      integer :: requests
   end type table_kind
   !> Friction laws and the model of simplified theory are made anew for each case
   type(table_kind), parameter :: table_kinds(*) = [table_kind("scratch", 0), table_kind("previous", 0), &
      & table_kind("forces", 0), table_kind("hertz", 0), table_kind("shift", 0), table_kind("transient", 0), &
      & table_kind("dissimilar", 0), table_kind("simplified", 1), table_kind("falling", 11)]
   !> Cases in a creep-force table
   integer, parameter :: table_size = 3000

contains

   !> Ball on a flat in a window of 1.25 contact diameters, n by n elements
   subroutine new_normal_case(n, force_prescribed, eps, case)
      integer, intent(in) :: n
      logical, intent(in) :: force_prescribed
      real(wp), intent(in) :: eps
      type(normal_case), intent(inout) :: case
      type(combined_material) :: material
      integer :: ix, iy
      !> Radius of contact for a window of side 1 and radius of curvature 1 [mm]
      real(wp), parameter :: a = 0.4_wp

      material%gg = 1.0_wp
      material%nu = 0.5_wp
      associate (problem => case%problem)
         problem%mx = n
         problem%my = n
         problem%dx = 1.0_wp/n
         problem%dy = 1.0_wp/n
         problem%force_prescribed = force_prescribed
         ! effective modulus G/(1 - nu) = 2
         problem%fn = 4.0_wp/3.0_wp*2.0_wp*a**3
         problem%eps = eps
         if (allocated(problem%h)) deallocate(problem%h, case%p)
         allocate(problem%h(n, n), case%p(n, n))
         do iy = 1, n
            do ix = 1, n
               problem%h(ix, iy) = 0.5_wp*(((ix - 0.5_wp)/n - 0.5_wp)**2 + ((iy - 0.5_wp)/n - 0.5_wp)**2)
            end do
         end do
      end associate
      case%pen = a**2
      call case%operator%prepare(elastic_model(material), 1.0_wp/n, 1.0_wp/n, n, n, 1)
   end subroutine new_normal_case

   subroutine run_normal(self, report)
      class(normal_case), intent(inout) :: self
      type(solve_report), intent(inout) :: report
      real(wp) :: pen

      self%p = 0.0_wp
      self%turn = .not. self%turn
      pen = nearest(self%pen, merge(1.0_wp, -1.0_wp, self%turn))
      self%problem%fn = nearest(self%problem%fn, merge(1.0_wp, -1.0_wp, self%turn))
      report%products = 0
      report%fft_pairs = 0.0_wp
      call solve_normal(self%problem, self%operator, self%workspace, self%p, pen, report)
      self%contact = count(self%p > 0.0_wp)
   end subroutine run_normal

   subroutine release_normal_case(self)
      class(normal_case), intent(inout) :: self
      call self%operator%release()
      call release_normal(self%workspace)
   end subroutine release_normal_case

   !> Steady rolling with Hertz's pressures, n by n elements in a window of 1.1 semi-axes each way
   subroutine new_rolling_case(contact, n, eps, case)
      type(rolling_contact), intent(in) :: contact
      integer, intent(in) :: n
      real(wp), intent(in) :: eps
      type(tangential_case), intent(inout) :: case
      integer :: ix, iy
      real(wp) :: x, y

      associate (problem => case%problem)
         problem%mx = n
         problem%my = n
         problem%dx = 2.2_wp*contact%a/n
         problem%dy = 2.2_wp*contact%b/n
         problem%dq = problem%dx
         problem%steady = .true.
         problem%direction = 1
         problem%settings%eps = eps
         if (allocated(problem%contact)) deallocate(problem%contact, problem%bound, problem%shift)
         allocate(problem%contact(n, n), problem%bound(n, n), problem%shift(n, n, 2))
         do iy = 1, n
            y = (iy - 0.5_wp)*problem%dy - 1.1_wp*contact%b
            do ix = 1, n
               x = (ix - 0.5_wp)*problem%dx - 1.1_wp*contact%a
               problem%bound(ix, iy) = mu*1.5_wp*contact%fn/(pi*contact%a*contact%b) &
                  & *sqrt(max(0.0_wp, 1.0_wp - (x/contact%a)**2 - (y/contact%b)**2))
               problem%shift(ix, iy, 1) = problem%dq*(contact%ksi - contact%phi*y)
               problem%shift(ix, iy, 2) = problem%dq*(contact%eta + contact%phi*x)
            end do
         end do
         problem%contact = problem%bound > 0.0_wp
         problem%n_forces = contact%n_forces
         problem%target = contact%force*sum(problem%bound)
         call prepare_operator(case)
      end associate
   end subroutine new_rolling_case

   !> The first contact in a shift, by creepages [mm] or forces
   subroutine new_shift_case(n, shift, n_forces, force, eps, case)
      integer, intent(in) :: n, n_forces
      real(wp), intent(in) :: shift(2), force(2), eps
      type(tangential_case), intent(inout) :: case
      integer :: k

      call new_rolling_case(rolling_contacts(1), n, eps, case)
      case%problem%steady = .false.
      case%problem%dq = 1.0_wp
      do k = 1, 2
         case%problem%shift(:, :, k) = shift(k)
      end do
      case%problem%n_forces = n_forces
      case%problem%target = force*sum(case%problem%bound)
   end subroutine new_shift_case

   subroutine prepare_operator(case)
      type(tangential_case), intent(inout) :: case

      associate (problem => case%problem)
         call case%operator%prepare(elastic_model(combine([poisson, poisson], [modulus, modulus])), problem%dx, problem%dy, &
            & problem%mx, problem%my, problem%direction)
         if (allocated(case%solution%p)) deallocate(case%solution%p, case%solution%slip, case%solution%division)
         call prepare_solution(problem, case%solution)
      end associate
   end subroutine prepare_operator

   subroutine run_tangential(self, report)
      class(tangential_case), intent(inout) :: self
      type(solve_report), intent(inout) :: report
      type(log_type) :: log

      self%solution%p = 0.0_wp
      self%solution%creep = 0.0_wp
      self%solution%sensitivity = 0.0_wp
      report%products = 0
      report%fft_pairs = 0.0_wp
      if (self%method == 0) then
         call solve_newton_krylov(self%problem, self%operator, self%workspace, self%solution, report)
      else
         call solve_classical(self%problem, self%operator, self%method, self%solution, report, log)
      end if
   end subroutine run_tangential

   subroutine release_tangential_case(self)
      class(tangential_case), intent(inout) :: self
      call self%operator%release()
      call release_nested(self%workspace)
   end subroutine release_tangential_case

   !> A contact of 6 by 4 mm for a creep-force table on mx by mx elements
   subroutine new_table_case(mx, case)
      integer, intent(in) :: mx
      type(session_case), intent(inout) :: case

      call new_session(case)
      associate (spec => case%spec)
         spec%grid%form = -3
         spec%grid%mx = mx
         spec%grid%my = mx
         spec%grid%aa = 6.0_wp
         spec%grid%bb = 4.0_wp
         spec%grid%scale = 1.1_wp
         spec%rolling%dq = 2.0_wp*spec%grid%aa*spec%grid%scale/mx
         spec%rolling%veloc = 30000.0_wp
         spec%kinematics%fn = 75000.0_wp
      end associate
   end subroutine new_table_case

   !> A case of a table of another kind than from scratch
   subroutine set_table_kind(kind, case)
      !> Name of a member of table_kinds
      character(len=*), intent(in) :: kind
      !> From new_table_case
      type(session_case), intent(inout) :: case

      associate (spec => case%spec)
         select case (kind)
         case ("previous")
            spec%estimate = estimate_choice%previous
         case ("forces")
            spec%force = 2
            spec%kinematics%fx = -0.5_wp
            spec%kinematics%fy = 0.2_wp
         case ("hertz")
            spec%pressure = pressure_model%elliptical
         case ("shift")
            spec%motion = motion%shift
         case ("transient")
            spec%motion = motion%transient_rolling
            spec%link = time_link%continue_all
         case ("dissimilar")
            spec%material%gg = [modulus, 2.0_wp*modulus]
            spec%iteration%maxout = 20
         case ("simplified")
            spec%pressure = pressure_model%parabolical
            spec%material_model = material_model%fastsim
         case ("falling")
            spec%friction_law = friction_model%linear
            spec%friction%sets(1)%fkin = 0.5_wp*mu
            spec%friction%sets(1)%coef1 = 0.5_wp*mu
            spec%friction%sets(1)%sabsh1 = 300.0_wp
         end select
      end associate
   end subroutine set_table_kind

   !> Carter's problem with 800 elements in contact and 40 around them, from scratch each time
   subroutine new_line_case(case)
      type(session_case), intent(inout) :: case

      call new_session(case)
      associate (spec => case%spec)
         spec%grid%form = 3
         spec%grid%mx = 840
         spec%grid%my = 1
         spec%grid%dx = 2.0_wp/800
         spec%grid%xc1 = -839.0_wp/800
         spec%grid%dy = 200.0_wp
         spec%geometry%b(1) = 0.001_wp
         spec%rolling%dq = spec%grid%dx
         spec%rolling%veloc = 30000.0_wp
         spec%kinematics%fn = 35780.0_wp
         spec%kinematics%cksi = -2.4e-4_wp
      end associate
   end subroutine new_line_case

   !> What all sessions of the benchmark have in common
   subroutine new_session(case)
      type(session_case), intent(inout) :: case
      type(case_spec) :: fresh

      call case%release()
      allocate(case%session)
      case%spec = fresh
      associate (spec => case%spec)
         spec%link = time_link%initiate
         spec%pressure = pressure_model%full
         spec%motion = motion%steady_rolling
         spec%normal = normal_control%force
         spec%estimate = estimate_choice%fresh
         spec%solver = solver_choice%default
         spec%parts%grid = part_source%given
         spec%material%gg = modulus
         spec%material%poiss = poisson
         allocate(spec%friction%sets(1))
         spec%friction%sets(1)%fstat = mu
         spec%friction%sets(1)%fkin = mu
         spec%iteration%eps = 1.0e-5_wp
      end associate
   end subroutine new_session

   !> Creepages [-] and spin [rad/mm] of one case of a table: 20 by 15 by 10, fine near zero
   pure function table_creepage(k) result(creepage)
      !> 1...table_size
      integer, intent(in) :: k
      real(wp) :: creepage(3)
      integer :: i, j, l

      l = mod(k - 1, 20)
      j = mod((k - 1)/20, 15)
      i = (k - 1)/300
      ! there and back again, so that neighbours in the sequence are neighbours in the table
      if (mod(j, 2) == 1) l = 19 - l
      if (mod(i, 2) == 1) j = 14 - j
      creepage(1) = 5.0e-3_wp*graded(l, 19)
      creepage(2) = 5.0e-3_wp*graded(j, 14)
      creepage(3) = 1.0e-3_wp*graded(i, 9)
   end function table_creepage

   !> Cubic spacing from -1 to 1
   pure real(wp) function graded(i, n)
      integer, intent(in) :: i, n
      graded = (2.0_wp*i/n - 1.0_wp)**3
   end function graded

   subroutine run_session(self, report)
      class(session_case), intent(inout) :: self
      type(solve_report), intent(inout) :: report

      ! not the same normal problem again, which would be answered from memory
      self%turn = .not. self%turn
      associate (kinematics => self%spec%kinematics, way => merge(1.0_wp, -1.0_wp, self%turn))
         kinematics%fn = nearest(kinematics%fn, way)
         kinematics%pen = nearest(kinematics%pen, way)
      end associate
      call solve_one(self)
      report = self%result%tangential
      report%fft_pairs = report%fft_pairs + self%result%normal%fft_pairs
   end subroutine run_session

   subroutine release_session_case(self)
      class(session_case), intent(inout) :: self
      if (.not. allocated(self%session)) return
      call release_session(self%session)
      deallocate(self%session)
   end subroutine release_session_case

   !> One case; the grid is new in the first one only
   subroutine solve_one(case)
      class(session_case), intent(inout) :: case
      type(error_type), allocatable :: error

      call solve_case(case%session, case%spec, case%log, case%result, error)
      if (allocated(error)) error stop full_text(error)
      case%spec%parts%grid = part_source%kept
      case%spec%parts%geometry = part_source%kept
   end subroutine solve_one
end module contact_bench_problems
