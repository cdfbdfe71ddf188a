!> A tangential problem of the simplified theory, and the tractions for given creepages
module contact_simplified_problem
   use contact_base_choices, only : is_fastrip, material_model
   use contact_base_kinds, only : wp
   use contact_friction_law, only : friction_driver, friction_law
   use contact_grid_element_division, only : bounding_box, element
   use contact_simplified_fastrip, only : apply_strip_theory, strip_data
   use contact_simplified_fastsim, only : march_fastsim, step_fastsim
   use contact_simplified_flexibility, only : blended_flexibilities, contact_extent, ellipse, equivalent_ellipse, slope_factor, &
      & slope_reduction, three_flexibilities
   implicit none (type, external)
   private

   public :: simplified_model, simplified_problem, simplified_solution, complete_problem, tractions_at, mean

   !> Model and flexibility of a case
   type :: simplified_model
      !> Member of material_model for which is_simplified holds
      integer :: choice = material_model%fastsim
      !> Flexibility [mm3/N], for the model with a single one
      real(wp) :: flx = 0.0_wp
      type(slope_reduction) :: reduction
      !> Ellipse of the Hertz solution, whose centre is the origin; zero for non-Hertzian geometries
      type(ellipse) :: hertz
      !> Is the origin the centre of any contact area, as the contact reference of wheel on rail is? Otherwise the centre of a
      !> non-Hertzian one is that of its bounding box
      logical :: is_centred = .false.
   end type simplified_model

   !> Data on the elements of the tangential problem; constant during the solution
   type :: simplified_problem
      type(simplified_model) :: model
      !> Centres of columns and rows [mm], shapes (mx) and (my); sides of the elements [mm]
      real(wp), allocatable :: x(:), y(:)
      real(wp) :: dx = 1.0_wp, dy = 1.0_wp
      !> Elements in contact and pressures [N/mm2], shape (mx, my)
      logical, allocatable :: contact(:, :)
      real(wp), allocatable :: pn(:, :)
      !> Static coefficient of friction of each row, shape (my) [-]
      real(wp), allocatable :: mu(:)
      !> Law for the kinetic coefficient of friction, with one set of parameters or one per row; unallocated for Coulomb friction.
      !> Its slip velocity is the rigid slip velocity without spin [mm/s]
      class(friction_law), allocatable :: law
      real(wp) :: velocity = 0.0_wp
      !> Coefficient of friction that scales forces [-], normal force [N]
      real(wp) :: mu_scal = 0.3_wp, fn = 0.0_wp
      !> Combined modulus of rigidity [N/mm2] and Poisson ratio [-]
      real(wp) :: gg = 1.0_wp, nu = 0.0_wp
      !> Steady rolling? Otherwise one time step from the tractions `before`
      logical :: steady = .true.
      !> Are creepages lengths (shift), which cannot be compared with creepages of rolling?
      logical :: shift = .false.
      !> Rolling towards increasing (+1) or decreasing (-1) x; distance travelled per step [mm]
      integer :: direction = 1
      real(wp) :: dq = 1.0_wp
      !> Tractions of the same particles one step before [N/mm2], shape (mx, my, 2); not used in steady rolling
      real(wp), allocatable :: before(:, :, :)
      !> Creepages [-] (shifts [mm] with dq = 1), spin [rad/mm], spin centre and offset of the spin term [mm]
      real(wp) :: creep(2) = 0.0_wp, spin = 0.0_wp, spin_centre(2) = 0.0_wp, spin_offset(2) = 0.0_wp
      !> Weights of the spin term in x and y [-]
      real(wp) :: spin_weight(2) = 1.0_wp
      !> Extra rigid slip per unit distance [-], shape (mx, my, 2); unallocated: none. complete_problem leaves the part that is no
      !> motion of rigid bodies
      real(wp), allocatable :: extra_slip(:, :, :)
      !> Number of prescribed forces: 0, 1 (Fx), 2 (Fx, Fy), and the forces relative to mu_scal fn [-]
      integer :: n_forces = 0
      real(wp) :: force(2) = 0.0_wp
      !> Tolerance of the relative forces [-]
      real(wp) :: eps = 1.0e-6_wp
      !> The components from here on are set by complete_problem. It refers creepages to the centre of the contact, by adding this
      !> part of the spin and of the extra slip [-]; spin of the extra slip, which it adds as well [rad/mm]
      real(wp) :: added_creep(2) = 0.0_wp, added_spin = 0.0_wp
      !> Ellipse with the area of the contact area, and ellipse that
      !> determines the flexibilities; flexibilities at vanishing creepage [mm3/N]
      type(ellipse) :: area, reference
      !> Centre of the bounding box of the contact area [mm]
      real(wp) :: centre(2) = 0.0_wp
      real(wp) :: flx0(3) = 0.0_wp
   end type simplified_problem

   !> Tractions and the quantities derived from them
   type :: simplified_solution
      !> Tractions [N/mm2], slip and rigid slip per step [mm], all of shape (mx, my, 2); strip theory overwrites the last one
      real(wp), allocatable :: p(:, :, :), slip(:, :, :), shift(:, :, :)
      !> Traction bound [N/mm2], element states, shape (mx, my)
      real(wp), allocatable :: bound(:, :)
      integer, allocatable :: division(:, :)
      !> Coefficient of friction that was used, shape (my) [-]
      real(wp), allocatable :: mu(:)
      !> Creepages at the centre of the contact, prescribed or found [-]
      real(wp) :: creep(2) = 0.0_wp
      !> Flexibilities [mm3/N] before slope reduction, reduction factor [-], flexibilities after it [mm3/N]
      real(wp) :: flx(3) = 0.0_wp, slope = 1.0_wp, compliance(2) = 0.0_wp
      !> Forces relative to mu_scal fn [-]
      real(wp) :: force(2) = 0.0_wp
      !> Do all elements in contact slip?
      logical :: sliding = .false.
   end type simplified_solution

contains

   !> Determine ellipses and flexibilities, and allocate the arrays of the solution
   !>
   !> The flexibilities of creepages and spin are those of an ellipse that turns about its centre. So a spin about another point is
   !> one about the centre and a creepage, and an extra slip has creepages and a spin in it.
   subroutine complete_problem(problem, solution)
      !> Grid, pressures, model and creepages on entry; ellipses and flexibilities are added, and creepages refer to the centre of
      !> the contact
      type(simplified_problem), intent(inout) :: problem
      !> Its arrays get the size of the grid
      type(simplified_solution), intent(inout) :: solution
      type(bounding_box) :: box
      real(wp) :: middle(2), away(2)
      integer :: mx, my, n
      logical :: is_ellipse

      mx = size(problem%contact, 1)
      my = size(problem%contact, 2)
      call contact_extent(problem%contact, n, box)
      if (n > 0) problem%centre = 0.5_wp*[problem%x(box%ix0) + problem%x(box%ix1), problem%y(box%iy0) + problem%y(box%iy1)]
      problem%area = equivalent_ellipse(n, box, problem%dx, problem%dy)
      problem%reference = problem%area
      is_ellipse = min(problem%model%hertz%aa, problem%model%hertz%bb) > 0.0_wp
      if (is_ellipse) problem%reference = problem%model%hertz
      middle = problem%centre
      if (is_ellipse .or. problem%model%is_centred) middle = 0.0_wp
      away = middle - problem%spin_centre
      problem%added_creep = problem%spin*problem%spin_weight*[-away(2), away(1)]
      problem%spin_centre = middle
      problem%added_spin = 0.0_wp
      if (allocated(problem%extra_slip)) call split_extra_slip(problem)
      problem%creep = problem%creep + problem%added_creep
      if (problem%model%choice == material_model%fastsim_single) then
         problem%flx0 = problem%model%flx
      else
         problem%flx0 = three_flexibilities(problem%reference, problem%gg, problem%nu)
      end if
      if (allocated(solution%division)) then
         if (all(shape(solution%division) == [mx, my])) return
         deallocate(solution%p, solution%slip, solution%shift, solution%bound, solution%division, solution%mu)
      end if
      allocate(solution%p(mx, my, 2), solution%slip(mx, my, 2), solution%shift(mx, my, 2), solution%bound(mx, my))
      allocate(solution%division(mx, my), solution%mu(my))
   end subroutine complete_problem

   !> Move creepages and spin of the extra slip to those of the problem: the motion of rigid bodies next to it, by least squares
   !> over the elements in contact
   pure subroutine split_extra_slip(problem)
      !> With the centre of the contact; creepages are added to `added_creep`
      type(simplified_problem), intent(inout) :: problem
      real(wp) :: place(2), total(2), middle(2), inertia, turning, spin, creep(2)
      integer :: ix, iy, n

      n = max(1, count(problem%contact))
      ! the offset of the spin term belongs to any spin
      place = problem%spin_centre - problem%spin_offset
      total = 0.0_wp
      middle = 0.0_wp
      do iy = 1, size(problem%y)
         do ix = 1, size(problem%x)
            if (.not. problem%contact(ix, iy)) cycle
            total = total + problem%extra_slip(ix, iy, :)
            middle = middle + [problem%x(ix), problem%y(iy)]
         end do
      end do
      middle = middle/n
      inertia = 0.0_wp
      turning = 0.0_wp
      do iy = 1, size(problem%y)
         do ix = 1, size(problem%x)
            if (.not. problem%contact(ix, iy)) cycle
            associate (x => problem%x(ix) - middle(1), y => problem%y(iy) - middle(2))
               inertia = inertia + x**2 + y**2
               turning = turning + x*problem%extra_slip(ix, iy, 2) - y*problem%extra_slip(ix, iy, 1)
            end associate
         end do
      end do
      spin = 0.0_wp
      if (inertia > 0.0_wp) spin = turning/inertia
      creep = total/n + spin*[middle(2) - place(2), place(1) - middle(1)]
      do iy = 1, size(problem%y)
         problem%extra_slip(:, iy, 1) = problem%extra_slip(:, iy, 1) - creep(1) + spin*(problem%y(iy) - place(2))
         problem%extra_slip(:, iy, 2) = problem%extra_slip(:, iy, 2) - creep(2) - spin*(problem%x - place(1))
      end do
      problem%added_creep = problem%added_creep + creep
      problem%added_spin = spin
      problem%spin = problem%spin + spin
   end subroutine split_extra_slip

   !> Tractions, slip and forces for given creepages
   subroutine tractions_at(problem, creep, solution)
      !> After complete_problem
      type(simplified_problem), intent(in) :: problem
      !> Longitudinal and lateral creepage [-]
      real(wp), intent(in) :: creep(2)
      !> Tractions, slip, element states and forces are set
      type(simplified_solution), intent(inout) :: solution
      integer :: iy

      solution%creep = creep
      solution%flx = problem%flx0
      if (problem%model%choice /= material_model%fastsim_single .and. problem%model%choice /= material_model%fastrip_plain &
         & .and. problem%n_forces == 0 .and. .not. problem%shift) solution%flx = blended_flexibilities(problem%flx0, &
         & problem%reference, problem%gg, problem%nu, mean(problem%mu)*problem%fn, creep, problem%spin)
      call friction_of_rows(problem, norm2(creep), solution%mu)
      solution%slope = slope_factor(problem%model%reduction, problem%area, problem%gg, problem%nu, mean(solution%mu)*problem%fn, &
         & creep, problem%direction*problem%spin)
      solution%compliance = solution%flx(1:2)/solution%slope
      call rigid_slip(problem, solution)
      do iy = 1, size(solution%mu)
         solution%bound(:, iy) = solution%mu(iy)*problem%pn(:, iy)
      end do
      if (problem%steady) then
         call march_fastsim(problem%contact, solution%bound, solution%shift, solution%compliance, problem%direction, &
            & solution%p, solution%slip, solution%division)
      else
         call step_fastsim(problem%contact, solution%bound, solution%shift, solution%compliance, problem%before, &
            & solution%p, solution%slip, solution%division)
      end if
      if (is_fastrip(problem%model%choice)) then
         call apply_strip_theory(strips_of(problem, solution), problem%x, problem%y, problem%dx, solution%mu, &
            & problem%contact, solution%bound, solution%p, solution%slip, solution%division, scratch=solution%shift)
      end if
      solution%force = problem%dx*problem%dy*[sum(solution%p(:, :, 1)), sum(solution%p(:, :, 2))] &
         & /(problem%mu_scal*problem%fn + tiny(1.0_wp))
      solution%sliding = .not. any(solution%division == element%adhesion)
   end subroutine tractions_at

   !> Coefficient of friction of each row at its rigid slip velocity, without iteration or memory
   subroutine friction_of_rows(problem, creepage, mu)
      type(simplified_problem), intent(in) :: problem
      !> Magnitude of the creepage [-]
      real(wp), intent(in) :: creepage
      real(wp), intent(inout) :: mu(:)
      real(wp), allocatable :: speed(:, :), field(:, :)

      mu = problem%mu
      if (.not. allocated(problem%law)) return
      if (problem%law%driver() /= friction_driver%slip_speed) return
      allocate(speed(1, size(mu)), source=problem%velocity*creepage)
      allocate(field(1, size(mu)))
      call problem%law%coefficient(speed, field)
      mu = field(1, :)
   end subroutine friction_of_rows

   pure real(wp) function mean(values)
      !> At least one value, in any order
      real(wp), intent(in) :: values(:)

      mean = sum(values)/size(values)
   end function mean

   !> Rigid slip per step [mm]; the spin term is weighted such that springs of flexibility L1 and L2 respond like springs of
   !> flexibility L3
   subroutine rigid_slip(problem, solution)
      type(simplified_problem), intent(in) :: problem
      type(simplified_solution), intent(inout) :: solution
      real(wp) :: turn(2), x0, y0
      integer :: iy

      turn = problem%spin_weight*problem%dq*problem%spin*solution%flx(1:2)/solution%flx(3)
      x0 = problem%spin_centre(1) - problem%spin_offset(1)
      y0 = problem%spin_centre(2) - problem%spin_offset(2)
      do iy = 1, size(problem%y)
         solution%shift(:, iy, 1) = problem%dq*solution%creep(1) - turn(1)*(problem%y(iy) - y0)
         solution%shift(:, iy, 2) = problem%dq*solution%creep(2) + turn(2)*(problem%x - x0)
      end do
      if (allocated(problem%extra_slip)) solution%shift = solution%shift + problem%dq*problem%extra_slip
   end subroutine rigid_slip

   !> Data for strip theory
   pure function strips_of(problem, solution) result(strips)
      type(simplified_problem), intent(in) :: problem
      type(simplified_solution), intent(in) :: solution
      type(strip_data) :: strips

      strips%area = problem%area
      strips%centre = problem%centre
      strips%gg = problem%gg
      strips%nu = problem%nu
      strips%fn = problem%fn
      strips%slope = solution%slope
      strips%creep = solution%creep
      strips%spin = problem%spin
      strips%spin_centre = problem%spin_centre
      strips%direction = problem%direction
   end function strips_of
end module contact_simplified_problem
