!> What is known of one contact patch after the solution
module contact_patch_result
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_case_status, only : case_status
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : solve_report
   use contact_grid_potential_contact, only : potential_contact
   implicit none (type, external)
   private

   public :: border_contact, patch_result, hertz_result, subsurface_result

   !> Where contact reaches the end of what is known of the surfaces
   type :: border_contact
      !> Elements in contact in the outer columns and rows of the potential contact
      integer :: elements = 0
      !> Would contact go on beyond a side of the potential contact? x low, x high, y low, y high
      logical :: side(4) = .false.
      !> Does contact end where the surface of a body ends along y? (low and high end, body)
      logical :: surface_end(2, 2) = .false.
      !> Does it end where a surface is hidden by another part of the same body, or turns away from the reference?
      logical :: hidden = .false.
      !> Largest pressure in the elements at those sides and ends [N/mm2]
      real(wp) :: pressure = 0.0_wp
   end type border_contact

   !> Hertz solution that belongs to a Hertzian geometry
   type :: hertz_result
      !> Curvatures [1/mm], semi-axes [mm] and their ratio [-]
      real(wp) :: a1 = 0.0_wp, b1 = 0.0_wp, aa = 0.0_wp, bb = 0.0_wp, aob = 1.0_wp
      !> Effective radius of curvature [mm], effective semi-axis sqrt(aa bb) [mm]
      real(wp) :: rho = 0.0_wp, cp = 0.0_wp
      !> Normal force [N] and approach [mm] of the Hertz solution
      real(wp) :: fn = 0.0_wp, pen = 0.0_wp
   end type hertz_result

   !> Displacements and stresses in one block of points, x fastest, then y, then z
   type :: subsurface_result
      integer :: nx = 0, ny = 0, nz = 0
      !> Coordinates of the points [mm], shape (3, nx*ny*nz)
      real(wp), allocatable :: position(:, :)
      !> Displacements [mm], shape (3, n)
      real(wp), allocatable :: displacement(:, :)
      !> Stresses [N/mm2], tension positive: xx, xy, xz, yy, yz, zz, shape (6, n)
      real(wp), allocatable :: stress(:, :)
      !> Mean stress, von Mises, Tresca, principal stresses in descending order [N/mm2], shape (n)
      real(wp), allocatable :: sighyd(:), sigvm(:), sigtr(:), sigma1(:), sigma2(:), sigma3(:)
      !> Points near the surface and off the centres of elements: there the stresses are those of constant tractions
      integer :: stepped = 0
   end type subsurface_result

   !> Totals, fields and reports of a solved patch
   type :: patch_result
      !> How the solution ended, from the reports below and the prescribed forces
      type(case_status) :: status
      type(potential_contact) :: grid
      !> Hertz data; unallocated for other geometries
      type(hertz_result), allocatable :: hertz
      !> Combined constants: modulus [N/mm2], Poisson ratio [-], difference parameter K [-]
      real(wp) :: gg = 1.0_wp, nu = 0.0_wp, ak = 0.0_wp
      !> Rolling direction [rad], step [mm], velocity [mm/s], time step [s] as used
      real(wp) :: chi = 0.0_wp, dq = 1.0_wp, veloc = 1.0_wp, dt = 1.0_wp
      !> Friction coefficient that scales tangential forces [-]
      real(wp) :: mu_scal = 0.3_wp
      !> Normal force [N], approach [mm], largest pressure [N/mm2]
      real(wp) :: fn = 0.0_wp, pen = 0.0_wp, pmax = 0.0_wp
      !> Relative tangential forces Fx/(mu_scal Fn) [-] and tangential forces on body 1 [N]
      real(wp) :: fx_rel = 0.0_wp, fy_rel = 0.0_wp, fx = 0.0_wp, fy = 0.0_wp
      !> Damping forces Fn, Fx, Fy on body 1 [N], not part of the forces above; unallocated without damping
      real(wp), allocatable :: damping(:)
      !> Moments [N mm]
      real(wp) :: mx = 0.0_wp, my = 0.0_wp, mz = 0.0_wp
      !> Creepages [-] or shifts [mm] as used, prescribed or found; spin [rad/mm]
      real(wp) :: cksi = 0.0_wp, ceta = 0.0_wp, cphi = 0.0_wp
      !> Elastic energy [J], frictional power [W] or work [J], dissipation negative
      real(wp) :: elastic_energy = 0.0_wp, friction_power = 0.0_wp
      !> Simplified theory: flexibilities [mm3/N] and the factor of slope reduction [-]; 0 without it
      real(wp) :: flx(3) = 0.0_wp, k_eff = 0.0_wp
      !> Sensitivities, rows FN, FX/(mu_scal FN), FY/(mu_scal FN), MZ, columns PEN KSI ETA PHI, in N, mm, rad;
      !> 0 when not computed
      real(wp) :: sensitivity(4, 4) = 0.0_wp
      !> Numbers of elements: contact, adhesion, slip, plastic
      integer :: ncon = 0, nadh = 0, nslip = 0, nplast = 0
      !> Passes of NORM and TANG, added up over the outer iterations, -1 for failure
      integer :: inorm = 0, itang = 0
      !> Outer (Panagiotopoulos) iterations
      integer :: outer_iterations = 0
      !> Contact at the border of the potential contact and at the ends of the surfaces
      type(border_contact) :: border
      type(solve_report) :: normal, tangential
      !> Iteration of friction with slip velocity or temperature; unallocated: none
      type(solve_report), allocatable :: friction
      !> True residual of the coupled contact conditions after the outer iteration, relative
      real(wp) :: residual = 0.0_wp
      !> Names of the effects that acted, separated by ", "
      character(len=:), allocatable :: effects
      !> Element states, shape (mx, my), see contact_grid_element_division
      integer, allocatable :: division(:, :)
      !> Undeformed distance [mm], friction coefficient [-], shape (mx, my)
      real(wp), allocatable :: h(:, :), mu(:, :)
      !> Tractions on body 1 [N/mm2], shape (mx, my)
      real(wp), allocatable :: pn(:, :), px(:, :), py(:, :)
      !> Displacement differences [mm], shape (mx, my)
      real(wp), allocatable :: un(:, :), ux(:, :), uy(:, :)
      !> Slip components per step [mm], zero outside the slip area, shape (mx, my)
      real(wp), allocatable :: sx(:, :), sy(:, :)
      !> Rigid slip per step [mm], computed creepages included, shape (mx, my)
      real(wp), allocatable :: wx(:, :), wy(:, :)
      !> Yield limit [N/mm2] and plastic displacement [mm], shape (mx, my); unallocated where nothing yields
      real(wp), allocatable :: tau_c(:, :), uplx(:, :), uply(:, :)
      !> Surface temperatures of bodies 1 and 2 [degC], shape (mx, my); unallocated when not asked for
      real(wp), allocatable :: temp1(:, :), temp2(:, :)
      !> Subsurface blocks; unallocated when not asked for
      type(subsurface_result), allocatable :: subsurface(:)
   contains
      !> Area of the elements in contact [mm2]
      procedure :: contact_area
      !> Are all totals finite numbers?
      procedure :: has_finite_totals
   end type patch_result

contains

   pure real(wp) function contact_area(self) result(area)
      class(patch_result), intent(in) :: self

      area = self%ncon*self%grid%dx*self%grid%dy
   end function contact_area

   !> Sums over all elements of tractions, displacements and slip are among the totals, so that no element escapes
   pure logical function has_finite_totals(self) result(finite)
      class(patch_result), intent(in) :: self

      finite = all(ieee_is_finite([self%fn, self%pen, self%pmax, self%fx, self%fy, self%fx_rel, self%fy_rel, self%mx, self%my, &
         & self%mz, self%cksi, self%ceta, self%cphi, self%elastic_energy, self%friction_power]))
      if (finite .and. allocated(self%temp1)) finite = ieee_is_finite(sum(self%temp1) + sum(self%temp2))
   end function has_finite_totals
end module contact_patch_result
