!> Result of the solution of one contact patch
module contact_patch_result
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_accuracy_report, only : accuracy_report
   use contact_base_case_status, only : case_status
   use contact_base_choices, only : is_rolling, motion_choice => motion
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : solve_report
   use contact_grid_element_division, only : element
   use contact_grid_potential_contact, only : potential_contact
   use contact_numeric_pieces, only : copy_field
   use contact_patch_quantities, only : element_field, error_law, error_scale, is_lateral, orientation, total_list
   implicit none (type, external)
   private

   public :: border_contact, copy_result, error_estimate, mirrored, patch_result, hertz_result, reason_length, &
      & subsurface_result, wear_result

   !> Length of the text that says why there is no estimate
   integer, parameter :: reason_length = 96

   !> Contact that reaches the end of the known part of the surfaces
   type :: border_contact
      !> Number of elements in contact in the outer columns and rows of the potential contact
      integer :: elements = 0
      !> Would contact continue beyond a side of the potential contact? x low, x high, y low, y high
      logical :: side(4) = .false.
      !> Does contact reach the end of the surface of a body along y? (low and high end, body)
      logical :: surface_end(2, 2) = .false.
      !> Does contact end where a surface is hidden by another part of the same body, or where it faces away from the contact plane?
      logical :: hidden = .false.
      !> Maximum pressure in the elements at those sides and ends [N/mm2]
      real(wp) :: pressure = 0.0_wp
   end type border_contact

   !> Hertz solution of a Hertzian geometry
   type :: hertz_result
      !> Coefficients of h = a1 x**2 + b1 y**2 [1/mm], semi-axes [mm] and their ratio [-]
      real(wp) :: a1 = 0.0_wp, b1 = 0.0_wp, aa = 0.0_wp, bb = 0.0_wp, aob = 1.0_wp
      !> Effective radius of curvature [mm], effective semi-axis sqrt(aa bb) [mm]
      real(wp) :: rho = 0.0_wp, cp = 0.0_wp
      !> Normal force [N] and approach [mm] of the Hertz solution
      real(wp) :: fn = 0.0_wp, pen = 0.0_wp
   end type hertz_result

   !> Displacements and stresses in a block of points, x fastest, then y, then z
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
      !> Number of points near the surface and off the centres of elements, whose stresses are affected by the piecewise constant
      !> tractions
      integer :: stepped = 0
   end type subsurface_result

   !> Estimated errors of the totals of a patch, see contact_patch_error_estimate
   type :: error_estimate
      !> Estimated error of each row of `totals`, not negative, in its unit; NaN: no estimate. Shape (rows of totals)
      real(wp), allocatable :: value(:)
      !> Reason why there is no estimate; blank if there is one, for totals whose error law is known
      character(len=reason_length) :: reason = ""
      !> Relative contributions of the solvers (normal, tangential problem) and of contact that is cut off at the border [-]
      real(wp) :: stopping(2) = 0.0_wp, window = 0.0_wp
      !> Error of tangential tractions, relative to them, where the levels indicate little of the error at a point, see
      !> contact_patch_traction_errors [-]
      real(wp) :: traction = 0.0_wp
      !> Part of the traction bound that does not contribute to the forces, as tractions have different directions, in rolling [-]
      real(wp) :: cancelled = 0.0_wp
      !> Errors of the tangential force of a patch that slides, across it, by which it turns, and along it, by which it is shorter
      !> [N]. They are independent, errors of FX and FY are not; not known where a part adheres
      real(wp) :: turned = 0.0_wp, shortened = 0.0_wp
      logical :: has_turned = .false.
      !> Number of elements in contact on the coarse level
      integer :: ncon = 0
      !> Fraction of the elements in contact that adhered at the previous time step, negative if there were no tractions [-]
      real(wp) :: adhered_before = -1.0_wp
   end type error_estimate

   !> Wear and fatigue of a patch, see contact_patch_wear
   type :: wear_result
      !> Were Archard's coefficient and the yield stress given?
      logical :: has_archard = .false., has_yield = .false.
      !> T-gamma: dissipation per distance rolled [N]; T-gamma per contact area [N/mm2]; maximum density of frictional power [W/mm2]
      real(wp) :: t_gamma = 0.0_wp, wear_index = 0.0_wp, max_power = 0.0_wp
      !> Maximum wear depth of a passage, or a shift [mm]; cross-section worn off by a passage [mm2]
      real(wp) :: depth = 0.0_wp, section = 0.0_wp
      !> Ratios of tangential to normal force and of maximum pressure to yield stress, the latter relative to its shakedown limit,
      !> surface fatigue index [-]
      real(wp) :: traction = 0.0_wp, load = 0.0_wp, shakedown = 0.0_wp, fatigue = 0.0_wp
   end type wear_result

   !> Totals, fields and reports of a solved patch; those for outputs are listed in `totals` and `fields`
   type :: patch_result
      !> Status of the solution, from the reports below and the prescribed forces
      type(case_status) :: status
      type(potential_contact) :: grid
      !> Relative motion of the bodies, member of motion
      integer :: motion = motion_choice%none
      !> Hertz data; unallocated for other geometries
      type(hertz_result), allocatable :: hertz
      !> Combined elastic constants: modulus of rigidity [N/mm2], Poisson ratio [-], difference parameter K [-]
      real(wp) :: gg = 1.0_wp, nu = 0.0_wp, ak = 0.0_wp
      !> Rolling direction [rad], distance travelled per step [mm], rolling velocity [mm/s], time step [s]
      real(wp) :: chi = 0.0_wp, dq = 1.0_wp, veloc = 1.0_wp, dt = 1.0_wp
      !> Coefficient of friction that scales tangential forces [-]
      real(wp) :: mu_scal = 0.3_wp
      !> Normal force [N], approach [mm], maximum pressure [N/mm2]
      real(wp) :: fn = 0.0_wp, pen = 0.0_wp, pmax = 0.0_wp
      !> Relative tangential forces F/(mu_scal Fn) [-], and tangential forces on body 1 [N]
      real(wp) :: fx_rel = 0.0_wp, fy_rel = 0.0_wp, fx = 0.0_wp, fy = 0.0_wp
      !> Damping forces Fn, Fx, Fy on body 1 [N], not included in the forces above; unallocated without damping
      real(wp), allocatable :: damping(:)
      !> Moments on body 1 about the origin of the contact coordinates [N mm]
      real(wp) :: mx = 0.0_wp, my = 0.0_wp, mz = 0.0_wp
      !> Creepages [-] or shifts [mm], prescribed or found; spin [rad/mm] or rotation [rad]
      real(wp) :: cksi = 0.0_wp, ceta = 0.0_wp, cphi = 0.0_wp
      !> Elastic energy [J], frictional power [W] or work [J], dissipation negative
      real(wp) :: elastic_energy = 0.0_wp, friction_power = 0.0_wp
      !> Simplified theory: flexibilities [mm3/N] and slope reduction factor [-]; 0 otherwise
      real(wp) :: flx(3) = 0.0_wp, k_eff = 0.0_wp
      !> Simplified theory: centre of the contact, about which the spin has a flexibility of its own [mm]
      real(wp) :: centre(2) = 0.0_wp
      !> Simplified theory: spin of the extra rigid slip [rad/mm]
      real(wp) :: added_spin = 0.0_wp
      !> Sensitivities of FN, FX/(mu_scal FN), FY/(mu_scal FN), MZ (rows) to PEN, CKSI, CETA, CPHI (columns), in N, mm, rad; 0 if
      !> not computed
      real(wp) :: sensitivity(4, 4) = 0.0_wp
      !> Numbers of elements: contact, adhesion, slip and plastic area
      integer :: ncon = 0, nadh = 0, nslip = 0, nplast = 0
      !> Number of passes of NORM and TANG, summed over the outer iterations; -1 after failure
      integer :: inorm = 0, itang = 0
      !> Number of outer (Panagiotopoulos) iterations
      integer :: outer_iterations = 0
      !> Contact at the border of the potential contact and at the ends of the surfaces
      type(border_contact) :: border
      type(solve_report) :: normal, tangential
      !> Iteration of the coefficient of friction with slip velocity or temperature; unallocated without it
      type(solve_report), allocatable :: friction
      !> Relative true residual of the coupled contact conditions after the outer iteration [-]
      real(wp) :: residual = 0.0_wp
      !> Names of the effects that were applied, separated by ", "
      character(len=:), allocatable :: effects
      !> Element states, shape (mx, my), see contact_grid_element_division
      integer, allocatable :: division(:, :)
      !> Undeformed distance [mm], coefficient of friction [-], shape (mx, my)
      real(wp), allocatable :: h(:, :), mu(:, :)
      !> Tractions on body 1 [N/mm2], shape (mx, my)
      real(wp), allocatable :: pn(:, :), px(:, :), py(:, :)
      !> Displacement differences [mm], shape (mx, my)
      real(wp), allocatable :: un(:, :), ux(:, :), uy(:, :)
      !> Slip per step [mm], zero outside the slip area, shape (mx, my)
      real(wp), allocatable :: sx(:, :), sy(:, :)
      !> Rigid slip per step [mm], including creepages that were found, shape (mx, my)
      real(wp), allocatable :: wx(:, :), wy(:, :)
      !> Yield limit [N/mm2] and plastic displacement [mm], shape (mx, my); unallocated if nothing yields
      real(wp), allocatable :: tau_c(:, :), uplx(:, :), uply(:, :)
      !> Surface temperatures of bodies 1 and 2 [degC], shape (mx, my); unallocated if not requested
      real(wp), allocatable :: temp1(:, :), temp2(:, :)
      !> Density of frictional power, dissipation positive [W/mm2], and wear depth of a passage or shift in each element [mm], shape
      !> (mx, my); unallocated if not requested
      real(wp), allocatable :: power(:, :), wear_depth(:, :)
      !> Totals of wear and fatigue; unallocated if not requested
      type(wear_result), allocatable :: wear
      !> Subsurface blocks; unallocated if not requested
      type(subsurface_result), allocatable :: subsurface(:)
      !> Estimated errors of the totals; unallocated if not requested
      type(error_estimate), allocatable :: errors
      !> Report on the requested accuracy; unallocated if none was requested
      type(accuracy_report), allocatable :: accuracy
   contains
      !> Area of the elements in contact [mm2]
      procedure :: contact_area
      !> Largest possible friction force
      procedure :: friction_bound
      !> Highest surface temperatures of both bodies in contact [degC]
      procedure :: largest_temperatures
      !> All totals and all element fields, for outputs
      procedure :: totals
      procedure :: fields
      !> Are all totals finite numbers?
      procedure :: has_finite_totals
   end type patch_result

contains

   !> Copy a result; arrays of equal shape are reused
   subroutine copy_result(from, to)
      !> Unchanged on exit
      type(patch_result), intent(inout) :: from
      !> Names of effects are not copied: the caller sets them for the case
      type(patch_result), intent(inout) :: to
      type(patch_result) :: kept, lent

      call move_alloc(to%effects, kept%effects)
      call hand_over(to, kept, .false.)
      call hand_over(from, lent, .false.)
      ! scalars and optional components
      to = from
      call move_alloc(kept%effects, to%effects)
      ! a case with contact search only has no fields
      if (allocated(lent%division)) then
         call hand_over(kept, to, .false.)
         call hand_over(lent, to, .true.)
      end if
      call hand_over(lent, from, .false.)
   end subroutine copy_result

   !> Move the fields of a solution, or copy them into arrays that are reused if their shapes are equal
   subroutine hand_over(from, to, copies)
      type(patch_result), intent(inout) :: from, to
      !> Shall the fields be copied? Otherwise they are moved
      logical, intent(in) :: copies

      if (copies) then
         to%division = from%division
      else
         call move_alloc(from%division, to%division)
      end if
      call one(from%h, to%h)
      call one(from%mu, to%mu)
      call one(from%pn, to%pn)
      call one(from%px, to%px)
      call one(from%py, to%py)
      call one(from%un, to%un)
      call one(from%ux, to%ux)
      call one(from%uy, to%uy)
      call one(from%sx, to%sx)
      call one(from%sy, to%sy)
      call one(from%wx, to%wx)
      call one(from%wy, to%wy)

   contains

      !> Move or copy one field
      subroutine one(here, there)
         real(wp), allocatable, intent(inout) :: here(:, :), there(:, :)

         if (copies) then
            call copy_field(here, there)
         else
            call move_alloc(here, there)
         end if
      end subroutine one
   end subroutine hand_over

   pure real(wp) function contact_area(self) result(area)
      class(patch_result), intent(in) :: self

      area = self%ncon*self%grid%dx*self%grid%dy
   end function contact_area

   !> Largest possible friction force: coefficients of friction times pressures [N]
   pure real(wp) function friction_bound(self) result(bound)
      class(patch_result), intent(in) :: self
      bound = self%grid%dx*self%grid%dy*sum(self%mu*self%pn)
   end function friction_bound

   !> All totals, in the order in which they are written, with name, unit and meaning for all outputs
   pure subroutine totals(self, list, left)
      class(patch_result), intent(in) :: self
      !> List to fill with the rows of a patch; previous rows are removed
      type(total_list), intent(inout) :: list
      !> Is this a wheel on the left side, with the result for its mirror image? Default: no
      logical, intent(in), optional :: left
      real(wp) :: highest(2)

      call list%start(left)
      call list%add("fn", "N", "normal force", self%fn, law=error_law%normal)
      call list%add_friction("fx", "N", "longitudinal force on body 1", self%fx, orientation%along, error_scale%force)
      call list%add_friction("fy", "N", "lateral force on body 1", self%fy, orientation%across, error_scale%force)
      call list%add_friction("mz", "N mm", "moment about the normal through the origin, on body 1; wheel on rail: through the &
         &contact reference", self%mz, orientation%across, error_scale%moment)
      call list%add_friction("fx_rel", "-", "FX over friction coefficient times FN", self%fx_rel, orientation%along, &
         & error_scale%ratio)
      call list%add_friction("fy_rel", "-", "FY over friction coefficient times FN", self%fy_rel, orientation%across, &
         & error_scale%ratio)
      call list%add("mu_scal", "-", "friction coefficient of the relative forces", self%mu_scal)
      call list%add("pen", "mm", "approach of the bodies", self%pen, law=error_law%normal)
      call list%add("pmax", "N/mm2", "largest pressure", self%pmax, law=error_law%peak)
      if (is_rolling(self%motion)) then
         call list%add("cksi", "-", "longitudinal creepage, prescribed or computed", self%cksi, &
            & orientation%along, law=error_law%creepage)
         call list%add("ceta", "-", "lateral creepage, prescribed or computed", self%ceta, &
            & orientation%across, law=error_law%creepage)
         call list%add("cphi", "rad/mm", "spin", self%cphi, orientation%across)
         call list%add("friction_power", "W", "frictional power, dissipation negative", self%friction_power, law=error_law%power)
      else if (self%motion == motion_choice%shift) then
         call list%add("shift_x", "mm", "longitudinal shift, prescribed or computed", self%cksi, &
            & orientation%along, law=error_law%creepage)
         call list%add("shift_y", "mm", "lateral shift, prescribed or computed", self%ceta, &
            & orientation%across, law=error_law%creepage)
         call list%add("rotation", "rad", "rotation", self%cphi, orientation%across)
         call list%add("friction_work", "J", "frictional work, dissipation negative", self%friction_power, law=error_law%power)
      end if
      call list%add("elastic_energy", "J", "elastic energy", self%elastic_energy, law=error_law%energy)
      if (allocated(self%damping)) then
         call list%add("fn_damp", "N", "normal damping force, not part of FN", self%damping(1))
         call list%add("fx_damp", "N", "longitudinal damping force, not part of FX", self%damping(2), orientation%along)
         call list%add("fy_damp", "N", "lateral damping force, not part of FY", self%damping(3), orientation%across)
      end if
      if (allocated(self%temp1)) then
         highest = self%largest_temperatures()
         call list%add("max_temp1", "degC", "highest surface temperature of body 1 in contact", highest(1), law=error_law%peak)
         call list%add("max_temp2", "degC", "highest surface temperature of body 2 in contact", highest(2), law=error_law%peak)
         call list%add("max_temp", "degC", "highest surface temperature in contact", maxval(highest), heading="MAX(T1,T2)", &
            & in_files=.false., law=error_law%peak)
      end if
      call list%add("contact_area", "mm2", "area of the elements in contact", self%contact_area(), law=error_law%area)
      call list%count("ncon", "elements in contact", self%ncon)
      call list%count("border_elements", "elements in contact in the outer rows and columns", self%border%elements)
      call list%count("nadh", "elements in adhesion", self%nadh)
      call list%count("nslip", "slipping elements", self%nslip)
      if (allocated(self%tau_c)) call list%count("nplast", "yielding elements", self%nplast)
      if (allocated(self%wear)) call add_wear(self, self%wear, list)
      if (allocated(self%subsurface) .and. (allocated(self%wear) .or. allocated(self%errors))) call add_stresses(self, list)
   end subroutine totals

   !> Totals of wear and fatigue
   pure subroutine add_wear(contact, wear, list)
      !> Solution
      type(patch_result), intent(in) :: contact
      type(wear_result), intent(in) :: wear
      type(total_list), intent(inout) :: list

      if (is_rolling(contact%motion)) then
         call list%add("t_gamma", "N", "forces times creepages, moment times spin: energy per distance rolled", wear%t_gamma)
         call list%add("wear_index", "N/mm2", "T-gamma over the contact area", wear%wear_index)
         call list%add("max_power", "W/mm2", "largest density of frictional power", wear%max_power)
      end if
      if (wear%has_archard .and. contact%motion /= motion_choice%none) then
         call list%add("max_wear", "mm", "largest wear depth of a passage of the contact, or of a shift", wear%depth)
         if (is_rolling(contact%motion)) call list%add("worn_section", "mm2", "worn area of the section per passage of &
            &the contact", wear%section)
      end if
      if (contact%ncon > 0) then
         call list%add("traction", "-", "tangential over normal force", wear%traction)
         if (wear%has_yield) then
            call list%add("shakedown_load", "-", "largest pressure over yield stress in shear", wear%load)
            call list%add("shakedown", "-", "largest pressure over its shakedown limit, above 1: plastic strain accumulates", &
               & wear%shakedown)
            call list%add("fatigue_index", "-", "surface fatigue index, above 0: fatigue of the surface is expected", wear%fatigue)
         end if
      end if
   end subroutine add_wear

   !> Maximum stresses at the points of all subsurface blocks
   pure subroutine add_stresses(contact, list)
      !> Solution with stresses
      type(patch_result), intent(in) :: contact
      type(total_list), intent(inout) :: list
      real(wp) :: highest(2)
      integer :: k

      highest = 0.0_wp
      do k = 1, size(contact%subsurface)
         highest = max(highest, [maxval(contact%subsurface(k)%sigvm), maxval(contact%subsurface(k)%sigtr)])
      end do
      call list%add("max_mises", "N/mm2", "largest von Mises stress at the points below the surface", highest(1), &
         & law=error_law%stress)
      call list%add("max_tresca", "N/mm2", "largest Tresca stress at the points below the surface", highest(2), &
         & law=error_law%stress)
   end subroutine add_stresses

   !> Highest temperatures of both bodies in the contact area, or anywhere if there is no contact [degC]
   pure function largest_temperatures(self) result(highest)
      !> Result with temperatures
      class(patch_result), intent(in) :: self
      real(wp) :: highest(2)

      highest = [highest_in_contact(self, self%temp1), highest_in_contact(self, self%temp2)]
   end function largest_temperatures

   !> Maximum temperature in the contact area, or anywhere if there is no contact [degC]
   pure real(wp) function highest_in_contact(contact, temperature) result(highest)
      class(patch_result), intent(in) :: contact
      !> Surface temperature [degC], shape (mx, my)
      real(wp), intent(in) :: temperature(:, :)

      highest = maxval(temperature)
      if (contact%ncon > 0) highest = maxval(temperature, contact%division > element%exterior)
   end function highest_in_contact

   !> All element fields, in the order of the columns of the .mat file, with name, unit and meaning for all outputs
   !>
   !> The signs of displacements do not depend on the body that is viewed, contrary to those of tractions and slip.
   subroutine fields(self, rows)
      class(patch_result), target, intent(in) :: self
      !> Rows whose values point to those of `self`; the actual argument must have the target attribute
      type(element_field), allocatable, intent(out) :: rows(:)
      logical :: still, alike

      still = self%motion == motion_choice%none
      ! pressures move the surfaces of unlike bodies sideways without friction, too
      alike = still
      if (still .and. allocated(self%ux) .and. allocated(self%uy)) &
         & alike = .not. (any(abs(self%ux) > 0.0_wp) .or. any(abs(self%uy) > 0.0_wp))
      allocate(rows(0))
      call add(1, "h", "mm", "undeformed distance, approach not subtracted", self%h, label="distance")
      call add(2, "mu", "-", "coefficient of friction", self%mu, label="friction coefficient")
      call add(5, "pn", "N/mm2", "pressure", self%pn, label="pressure")
      call add(3, "px", "N/mm2", "longitudinal traction on body 1", self%px, orientation%along, label="px", zero=still)
      call add(4, "py", "N/mm2", "lateral traction on body 1", self%py, orientation%across, label="py", zero=still)
      call add(9, "un", "mm", "normal displacement difference", self%un, label="un")
      call add(7, "ux", "mm", "longitudinal displacement difference", self%ux, zero=alike, label="ux")
      call add(8, "uy", "mm", "lateral displacement difference", self%uy, orientation%side, zero=alike, label="uy")
      if (is_rolling(self%motion)) then
         call add(15, "sx", "-", "longitudinal slip, relative", self%sx, orientation%along, self%dq, label="sx")
         call add(16, "sy", "-", "lateral slip, relative", self%sy, orientation%across, self%dq, label="sy")
         call add(22, "wx", "-", "longitudinal rigid slip, relative", self%wx, orientation%along, self%dq, &
            & in_files=.false., label="wx")
         call add(23, "wy", "-", "lateral rigid slip, relative", self%wy, orientation%across, self%dq, in_files=.false., label="wy")
      else
         call add(15, "sx", "mm", "longitudinal slip distance", self%sx, orientation%along, zero=still, label="sx")
         call add(16, "sy", "mm", "lateral slip distance", self%sy, orientation%across, zero=still, label="sy")
         call add(22, "wx", "mm", "longitudinal rigid shift", self%wx, orientation%along, in_files=.false., label="wx")
         call add(23, "wy", "mm", "lateral rigid shift", self%wy, orientation%across, in_files=.false., label="wy")
      end if
      call add(11, "taucrt", "N/mm2", "yield limit", self%tau_c, label="yield limit")
      call add(12, "uplsx", "mm", "longitudinal plastic displacement", self%uplx, label="uplsx")
      call add(13, "uplsy", "mm", "lateral plastic displacement", self%uply, orientation%side, label="uplsy")
      call add(20, "temp1", "degC", "surface temperature of body 1", self%temp1, label="temperature 1", figures=4)
      call add(21, "temp2", "degC", "surface temperature of body 2", self%temp2, label="temperature 2", figures=4)
      call add(25, "power", "W/mm2", "density of frictional power", self%power, label="frictional power density")
      call add(26, "wear", "mm", "wear depth of a passage or a shift", self%wear_depth, label="wear")

   contains

      !> Add a row, see element_field
      subroutine add(code, name, unit, meaning, values, along, divisor, zero, label, figures, in_files)
         integer, intent(in) :: code
         character(len=*), intent(in) :: name, unit, meaning
         !> Values, shape (mx, my); unallocated if the case does not have this field
         real(wp), allocatable, target, intent(in) :: values(:, :)
         integer, intent(in), optional :: along, figures
         real(wp), intent(in), optional :: divisor
         logical, intent(in), optional :: zero, in_files
         character(len=*), intent(in), optional :: label
         type(element_field) :: row

         row = element_field(name, unit, meaning, code)
         if (allocated(values)) row%values => values
         if (present(along)) row%along = along
         if (present(divisor)) row%divisor = divisor
         if (present(zero)) row%is_zero = zero
         if (present(label)) row%label = label
         if (present(figures)) row%figures = figures
         if (present(in_files)) row%in_files = in_files
         rows = [rows, row]
      end subroutine add
   end subroutine fields

   !> The mirror image: rows of elements in reversed order, lateral components with opposite sign. Totals and stresses below the
   !> surface are not changed
   function mirrored(right) result(left)
      !> Solution for the right side of the track
      type(patch_result), intent(in) :: right
      type(patch_result) :: left

      left = right
      left%grid%yl = -(right%grid%yl + right%grid%my*right%grid%dy)
      left%division = right%division(:, right%grid%my:1:-1)
      call turn_over(left)

   contains

      !> Reverse the rows of all fields
      subroutine turn_over(contact)
         type(patch_result), target, intent(inout) :: contact
         type(element_field), allocatable :: rows(:)
         integer :: k

         call contact%fields(rows)
         do k = 1, size(rows)
            if (.not. associated(rows(k)%values)) cycle
            associate (values => rows(k)%values)
               values = merge(-1.0_wp, 1.0_wp, is_lateral(rows(k)%along))*values(:, contact%grid%my:1:-1)
            end associate
         end do
      end subroutine turn_over
   end function mirrored

   !> Are all totals finite? They include sums over all elements of tractions, displacements and slip
   pure logical function has_finite_totals(self) result(finite)
      class(patch_result), intent(in) :: self
      type(total_list) :: list

      list%only_judges = .true.
      call self%totals(list)
      finite = list%is_finite .and. all(ieee_is_finite([self%mx, self%my, self%cksi, self%ceta, self%cphi, self%friction_power]))
      ! the maximum temperature would ignore NaN
      if (finite .and. allocated(self%temp1)) finite = ieee_is_finite(sum(self%temp1) + sum(self%temp2))
   end function has_finite_totals
end module contact_patch_result
