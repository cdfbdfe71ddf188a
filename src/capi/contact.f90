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
   use contact_cases_spec, only : geometry_spec, grid_spec
   use contact_control_units, only : inward, quantity
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: cntc_setpotcontact, cntc_sethertzcontact, cntc_setundeformeddistc, cntc_setpenetration, cntc_setnormalforce
   public :: cntc_setcreepages, cntc_setextrarigidslip, cntc_setreferencevelocity

   !> Largest number of elements, as in input files
   real(wp), parameter :: most_elements = 2.0e6_wp
   !> Smallest curvature [1/mm] and velocity [mm/s]: a flat body and one that stands still count as such
   real(wp), parameter :: least_curvature = 1.0e-12_wp, least_velocity = 1.0e-9_wp
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
      real(wp) :: length, factors(7)

      if (option /= 0 .and. option /= -1) then
         call complain(this, "there is no discretisation method " // integer_text(option) // " for wheel and rail; 0 and -1 are")
         return
      end if
      if (.not. count_fits(this, option, size(values), merge(3, 5, option == 0), merge(3, 7, option == 0))) return
      length = inward(problem%units, quantity%length)
      if (option == 0) then
         if (.not. fits(this, "DX DS", values(:2)*length)) return
      else
         factors = [length, length, inward(problem%units, quantity%angle), length, length, length, length]
         if (.not. fits(this, "DX DS A_SEP D_SEP D_COMB D_TURN G_MISS", values*factors(:size(values)))) return
      end if
      associate (search => problem%spec%wheel_rail%search)
         search%dx = values(1)*length
         search%ds = values(2)*length
         if (option == 0) return
         search%a_sep = max(0.0_wp, values(3)*factors(3))
         search%d_sep = max(0.0_wp, values(4)*length)
         search%d_comb = max(0.0_wp, values(5)*length)
         search%d_turn = 2.0_wp*search%d_sep - search%d_comb
         if (size(values) >= 6) search%d_turn = max(0.0_wp, values(6)*length)
         search%g_miss = -1.0_wp
         if (size(values) >= 7) search%g_miss = values(7)*length
      end associate
   end subroutine set_search

   !> Window of a contact problem
   subroutine set_window(this, option, values, problem)
      type(entry_type), intent(in) :: this
      !> IPOTCN
      integer, intent(in) :: option
      real(wp), intent(in) :: values(:)
      type(library_problem), intent(inout) :: problem
      character(len=*), parameter :: window_names(4) = [character(len=16) :: "XL YL DX DY", "XL YL XH YH", "XC1 YC1 DX DY", &
         & "XC1 YC1 XCM YCM"]
      type(grid_spec) :: grid
      real(wp) :: v(6)

      problem%setting%group = potential_contact
      if (option < 1 .or. option > 4) then
         call complain(this, "there is no option " // integer_text(option) // " for the potential contact; 1 to 4 are")
         return
      end if
      if (.not. count_fits(this, option, size(values), 6, 6)) return
      grid%ipotcn = option
      if (.not. sizes_fit(this, values(1:2), grid)) return
      v = values*inward(problem%units, quantity%length)
      if (.not. fits(this, trim(window_names(option)), v(3:6))) return
      select case (option)
      case (1)
         grid%xl = v(3)
         grid%yl = v(4)
         grid%dx = v(5)
         grid%dy = v(6)
      case (2)
         grid%xl = v(3)
         grid%yl = v(4)
         grid%xh = v(5)
         grid%yh = v(6)
      case (3)
         grid%xc1 = v(3)
         grid%yc1 = v(4)
         grid%dx = v(5)
         grid%dy = v(6)
      case (4)
         grid%xc1 = v(3)
         grid%yc1 = v(4)
         grid%xcm = v(5)
         grid%ycm = v(6)
      end select
      problem%spec%grid = grid
   end subroutine set_window

   !> Numbers of elements, rounded
   logical function sizes_fit(this, numbers, grid)
      type(entry_type), intent(in) :: this
      real(wp), intent(in) :: numbers(2)
      type(grid_spec), intent(inout) :: grid

      sizes_fit = fits(this, "MX MY", anint(numbers))
      if (.not. sizes_fit) return
      sizes_fit = anint(numbers(1))*anint(numbers(2)) <= most_elements
      if (.not. sizes_fit) then
         call complain(this, "the potential contact has more than " // integer_text(nint(most_elements)) // " elements")
         return
      end if
      grid%mx = nint(numbers(1))
      grid%my = nint(numbers(2))
   end function sizes_fit

   !> Hertzian geometry
   subroutine cntc_sethertzcontact(ire, icp, ipotcn, nparam, params) bind(c, name="inside_cntc_sethertzcontact")
      integer(c_int), intent(in), optional :: ire, icp, ipotcn, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(grid_spec) :: grid
      character(len=*), parameter :: hertz_names(-6:-1) = [character(len=18) :: "AA BNEG BPOS SCALE", "AA BB SCALE", &
         & "A1 BB SCALE", "AA BB SCALE", "A1 AOB SCALE", "A1 B1 SCALE"]
      real(wp), allocatable :: v(:)
      real(wp) :: length, curvature, factors(4)

      this = entry_type("cntc_setHertzContact", integer_of(ire), integer_of(icp))
      call enter(this, scope%contact, problem)
      if (.not. associated(problem)) return
      problem%setting%group = potential_contact
      v = reals_of(nparam, params)
      grid%ipotcn = max(-99, integer_of(ipotcn))
      length = inward(problem%units, quantity%length)
      curvature = inward(problem%units, quantity%curvature)
      if (grid%ipotcn < -6 .or. grid%ipotcn > -1) then
         call complain(this, "there is no Hertzian option " // integer_text(grid%ipotcn) // "; -6 to -1 are")
      else if (count_fits(this, grid%ipotcn, size(v), merge(6, 5, grid%ipotcn == -6), merge(6, 5, grid%ipotcn == -6))) then
         if (sizes_fit(this, v(1:2), grid)) then
            select case (grid%ipotcn)
            case (-1)
               factors = [curvature, curvature, 1.0_wp, 1.0_wp]
            case (-2)
               factors = [curvature, 1.0_wp, 1.0_wp, 1.0_wp]
            case (-4)
               factors = [curvature, length, 1.0_wp, 1.0_wp]
            case (-6)
               factors = [length, length, length, 1.0_wp]
            case default
               factors = [length, length, 1.0_wp, 1.0_wp]
            end select
            v(3:) = v(3:)*factors(:size(v) - 2)
            if (any(grid%ipotcn == [-1, -2, -4])) v(3) = raised(v(3), least_curvature)
            if (grid%ipotcn == -1) v(4) = raised(v(4), least_curvature)
            if (fits(this, trim(hertz_names(grid%ipotcn)), v(3:))) then
               grid%scale = v(size(v))
               select case (grid%ipotcn)
               case (-1)
                  grid%a1 = v(3)
                  grid%b1 = v(4)
               case (-2)
                  grid%a1 = v(3)
                  grid%aob = v(4)
               case (-3, -5)
                  grid%aa = v(3)
                  grid%bb = v(4)
               case (-4)
                  grid%a1 = v(3)
                  grid%bb = v(4)
               case (-6)
                  grid%aa = v(3)
                  grid%bneg = v(4)
                  grid%bpos = v(5)
               end select
               if (grid%ipotcn == -4 .or. grid%ipotcn == -5) problem%spec%digits%b = 2
               problem%spec%grid = grid
            end if
         end if
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
      real(wp), allocatable :: v(:)
      real(wp) :: length, curvature
      integer :: n
      logical :: good

      this = entry_type("cntc_setUndeformedDistc", integer_of(ire), integer_of(icp))
      call enter(this, scope%contact, problem)
      if (.not. associated(problem)) return
      v = reals_of(nparam, prmudf)
      geometry%ibase = integer_of(ibase)
      length = inward(problem%units, quantity%length)
      curvature = inward(problem%units, quantity%curvature)
      select case (geometry%ibase)
      case (1)
         n = 6
      case (2)
         n = 7
         if (size(v) > 0) then
            if (v(1) >= 2.0_wp .and. v(1) < most_elements) n = 5 + nint(v(1))
         end if
      case (3)
         n = 8
      case (9)
         n = problem%spec%grid%mx*problem%spec%grid%my
      case default
         call complain(this, "there is no form " // integer_text(geometry%ibase) // " of the undeformed distance; 1, 2, 3, 9 are")
         call leave(problem)
         return
      end select
      if (count_fits(this, geometry%ibase, size(v), n, n)) then
         select case (geometry%ibase)
         case (1)
            v = v*[curvature, curvature, curvature, 1.0_wp, 1.0_wp, length]
            good = fits(this, "B", v)
            geometry%b(1:6) = v
         case (2)
            good = fits(this, "NN", v(1:1))
            v = v*length
            if (good) good = fits(this, "XM RM Y1 DY1 B", v(2:))
            geometry%xm = v(2)
            geometry%rm = v(3)
            geometry%y1 = v(4)
            geometry%dy1 = v(5)
            geometry%profile = v(6:)
         case (3)
            v = v*[length, curvature, length, length, curvature, length, length, length]
            good = fits(this, "B(IBASE3)", v, "B")
            geometry%b = v
         case (9)
            v = v*length
            good = fits(this, "H", v)
            geometry%h = v
         end select
         if (good) problem%spec%geometry = geometry
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
         problem%spec%digits%n = 0
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
         problem%spec%digits%n = 1
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
      if (problem%spec%digits%t == motion%shift) then
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
         problem%spec%digits%e = slip_source%keep
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
      value = raised(abs(real_of(veloc))*inward(problem%units, quantity%velocity), least_velocity)
      if (fits(this, "VELOC", [value])) problem%spec%rolling%veloc = value
      call leave(problem)
   end subroutine cntc_setreferencevelocity
end module contact_capi_contact
