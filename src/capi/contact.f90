!> Entries for the geometry and the motion of contact problems (module 3)
module contact_capi_contact
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use contact_base_choices, only : motion, slip_source
   use contact_base_kinds, only : wp
   use contact_capi_arguments, only : integer_of, raised, real_of, reals_of
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : complain, count_fits, fits, is_heard, say
   use contact_capi_problem, only : library_problem
   use contact_capi_registry, only : enter, leave, scope
   use contact_capi_setter, only : new_setter, setter
   use contact_cases_grid_inputs, only : largest_grid, visit_distance, visit_grid
   use contact_cases_rail_inputs, only : visit_search
   use contact_cases_spec, only : geometry_spec, grid_spec
   use contact_control_units, only : inward, quantity
   use contact_text_words, only : integer_text
   use contact_wheelrail_spec, only : search_spec
   implicit none (type, external)
   private

   public :: cntc_setpotcontact, cntc_sethertzcontact, cntc_setundeformeddistc, cntc_setpenetration, cntc_setnormalforce
   public :: cntc_setcreepages, cntc_setextrarigidslip, cntc_setreferencevelocity

   !> Smallest velocity: a body that stands still counts as such [mm/s]
   real(wp), parameter :: min_velocity = 1.0e-9_wp
   !> What both routines for the potential contact set
   character(len=*), parameter :: potential_contact = "potential contact"

contains

   !> Potential contact area; in module 1 the contact search and discretisation
   subroutine cntc_setpotcontact(ire, icp, ipotcn, nparam, params) bind(c, name="inside_cntc_setpotcontact")
      integer(c_int), intent(in), optional :: ire, icp, ipotcn, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp), allocatable :: values(:)

      this = entry_type("cntc_setPotContact", integer_of(ire), integer_of(icp))
      call enter(this, scope%settings, problem)
      if (.not. associated(problem)) return
      values = reals_of(nparam, params)
      if (problem%module_number == 1) then
         call set_search(this, integer_of(ipotcn), values, problem)
      else
         call set_window(this, integer_of(ipotcn), values, problem)
      end if
      call leave(problem)
   end subroutine cntc_setpotcontact

   !> Contact search of wheel and rail
   subroutine set_search(this, option, values, problem)
      type(entry_type), intent(in) :: this
      integer, intent(in) :: option
      real(wp), intent(in) :: values(:)
      type(library_problem), intent(inout) :: problem
      type(search_spec), target :: search
      type(setter) :: a

      if (option /= 0 .and. option /= -1) then
         call complain(this, "there is no discretisation method " // integer_text(option) // " for wheel and rail; 0 and -1 are")
         return
      end if
      if (.not. count_fits(this, option, size(values), merge(3, 5, option == 0), merge(3, 7, option == 0))) return
      a = new_setter(this, problem%units, values)
      search = problem%spec%wheel_rail%search
      if (option == 0) then
         call a%real("DX", search%dx)
         call a%real("DS", search%ds)
         call a%end_line()
      else
         search%g_miss = -1.0_wp
         call visit_search(a, search, with_step=.false.)
         search%d_comb = max(0.0_wp, search%d_comb)
         if (size(values) >= 6) search%d_turn = max(0.0_wp, search%d_turn)
      end if
      if (a%is_good) problem%spec%wheel_rail%search = search
   end subroutine set_search

   !> Window of a contact problem
   subroutine set_window(this, option, values, problem)
      type(entry_type), intent(in) :: this
      !> IPOTCN
      integer, intent(in) :: option
      real(wp), intent(in) :: values(:)
      type(library_problem), intent(inout) :: problem

      problem%setting%group = potential_contact
      if (option < 1 .or. option > 4) then
         call complain(this, "there is no option " // integer_text(option) // " for the potential contact; 1 to 4 are")
      else if (count_fits(this, option, size(values), 6, 6)) then
         call set_grid(this, option, values, problem)
      end if
   end subroutine set_window

   !> A grid of any form
   subroutine set_grid(this, option, values, problem)
      type(entry_type), intent(in) :: this
      !> IPOTCN
      integer, intent(in) :: option
      !> As many as the form needs
      real(wp), intent(in) :: values(:)
      type(library_problem), intent(inout) :: problem
      type(grid_spec) :: grid
      type(setter) :: a

      grid%form = option
      a = new_setter(this, problem%units, values)
      call visit_grid(a, grid)
      if (.not. a%is_good) return
      problem%spec%grid = grid
      if (option == -4 .or. option == -5) problem%digits%b = 2
   end subroutine set_grid

   !> Hertzian geometry
   subroutine cntc_sethertzcontact(ire, icp, ipotcn, nparam, params) bind(c, name="inside_cntc_sethertzcontact")
      integer(c_int), intent(in), optional :: ire, icp, ipotcn, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp), allocatable :: values(:)
      integer :: option, n

      this = entry_type("cntc_setHertzContact", integer_of(ire), integer_of(icp))
      call enter(this, scope%contact, problem)
      if (.not. associated(problem)) return
      problem%setting%group = potential_contact
      values = reals_of(nparam, params)
      option = max(-99, integer_of(ipotcn))
      n = merge(6, 5, option == -6)
      if (option < -6 .or. option > -1) then
         call complain(this, "there is no Hertzian option " // integer_text(option) // "; -6 to -1 are")
      else if (count_fits(this, option, size(values), n, n)) then
         call set_grid(this, option, values, problem)
      end if
      call leave(problem)
   end subroutine cntc_sethertzcontact

   !> Undeformed distance
   subroutine cntc_setundeformeddistc(ire, icp, ibase, nparam, prmudf) bind(c, name="inside_cntc_setundeformeddistc")
      integer(c_int), intent(in), optional :: ire, icp, ibase, nparam
      real(c_double), intent(in), optional :: prmudf(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(geometry_spec) :: geometry
      type(setter) :: a
      real(wp), allocatable :: v(:)
      integer :: elements, n

      this = entry_type("cntc_setUndeformedDistc", integer_of(ire), integer_of(icp))
      call enter(this, scope%contact, problem)
      if (.not. associated(problem)) return
      v = reals_of(nparam, prmudf)
      geometry%form = integer_of(ibase)
      elements = problem%spec%grid%mx*problem%spec%grid%my
      n = 0
      select case (geometry%form)
      case (1)
         n = 6
      case (2)
         n = 7
         if (size(v) > 0) then
            if (v(1) >= 2.0_wp .and. v(1) < largest_grid) n = 5 + nint(v(1))
         end if
      case (3)
         n = 8
      case (9)
         n = elements
      case default
         call complain(this, "there is no form " // integer_text(geometry%form) // " of the undeformed distance; 1, 2, 3, 9 are")
      end select
      if (n > 0) then
         if (count_fits(this, geometry%form, size(v), n, n)) then
            a = new_setter(this, problem%units, v)
            call visit_distance(a, geometry, elements)
            if (a%is_good) problem%spec%geometry = geometry
         end if
      end if
      call leave(problem)
   end subroutine cntc_setundeformeddistc

   !> Prescribed approach (N = 0)
   subroutine cntc_setpenetration(ire, icp, pen) bind(c, name="inside_cntc_setpenetration")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(in), optional :: pen
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp) :: value

      this = entry_type("cntc_setPenetration", integer_of(ire), integer_of(icp))
      call enter(this, scope%contact, problem)
      if (.not. associated(problem)) return
      value = real_of(pen)*inward(problem%units, quantity%length)
      if (fits(this, "PEN", [value])) then
         problem%digits%n = 0
         problem%spec%kinematics%pen = value
      end if
      call leave(problem)
   end subroutine cntc_setpenetration

   !> Prescribed normal force (N = 1)
   subroutine cntc_setnormalforce(ire, icp, fn) bind(c, name="inside_cntc_setnormalforce")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(in), optional :: fn
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp) :: value

      this = entry_type("cntc_setNormalForce", integer_of(ire), integer_of(icp))
      call enter(this, scope%contact, problem)
      if (.not. associated(problem)) return
      value = real_of(fn)*inward(problem%units, quantity%force)
      if (fits(this, "FN", [value])) then
         problem%digits%n = 1
         problem%spec%kinematics%fn = value
      end if
      call leave(problem)
   end subroutine cntc_setnormalforce

   !> Creepages and spin; in shifts displacements and a rotation, by the T-digit at the time of the call
   subroutine cntc_setcreepages(ire, icp, vx, vy, phi) bind(c, name="inside_cntc_setcreepages")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(in), optional :: vx, vy, phi
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp) :: creep, spin

      this = entry_type("cntc_setCreepages", integer_of(ire), integer_of(icp))
      call enter(this, scope%contact, problem)
      if (.not. associated(problem)) return
      creep = 1.0_wp
      spin = inward(problem%units, quantity%spin)
      if (problem%digits%t == motion%shift) then
         creep = inward(problem%units, quantity%length)
         spin = inward(problem%units, quantity%angle)
      end if
      associate (values => [real_of(vx)*creep, real_of(vy)*creep, real_of(phi)*spin], kinematics => problem%spec%kinematics)
         if (fits(this, "CKSI CETA CPHI", values)) then
            kinematics%cksi = values(1)
            kinematics%ceta = values(2)
            kinematics%cphi = values(3)
         end if
      end associate
      call leave(problem)
   end subroutine cntc_setcreepages

   !> Extra term of the rigid slip, one value per element; what is missing is zero
   subroutine cntc_setextrarigidslip(ire, icp, lenarr, wx, wy) bind(c, name="inside_cntc_setextrarigidslip")
      integer(c_int), intent(in), optional :: ire, icp, lenarr
      real(c_double), intent(in), optional :: wx(*), wy(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp), allocatable :: x(:), y(:), slip(:, :)
      integer :: n, given

      this = entry_type("cntc_setExtraRigidSlip", integer_of(ire), integer_of(icp))
      call enter(this, scope%contact, problem)
      if (.not. associated(problem)) return
      x = reals_of(lenarr, wx)
      y = reals_of(lenarr, wy)
      if (fits(this, "EXRHS", [x, y])) then
         n = problem%spec%grid%mx*problem%spec%grid%my
         allocate(slip(2, n), source=0.0_wp)
         given = min(n, size(x))
         slip(1, :given) = x(:given)
         given = min(n, size(y))
         slip(2, :given) = y(:given)
         call move_alloc(slip, problem%spec%extra_slip)
         problem%digits%e = 1
         problem%spec%slip_source = slip_source%given
         if (is_heard(2)) call say(2, this, integer_text(given) // " values for " // integer_text(n) // " elements")
      end if
      call leave(problem)
   end subroutine cntc_setextrarigidslip

   !> Rolling velocity
   subroutine cntc_setreferencevelocity(ire, icp, veloc) bind(c, name="inside_cntc_setreferencevelocity")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(in), optional :: veloc
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp) :: value

      this = entry_type("cntc_setReferenceVelocity", integer_of(ire), integer_of(icp))
      call enter(this, scope%contact, problem)
      if (.not. associated(problem)) return
      ! as the published interface has it, a velocity without sign
      value = raised(abs(real_of(veloc))*inward(problem%units, quantity%velocity), min_velocity)
      if (fits(this, "VELOC", [value])) problem%spec%rolling%veloc = value
      call leave(problem)
   end subroutine cntc_setreferencevelocity
end module contact_capi_contact
