!> Entries for what both modules know: solvers, materials, temperatures, friction, rolling
module contact_capi_physics
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use contact_base_choices, only : pressure_model
   use contact_base_kinds, only : wp
   use contact_capi_arguments, only : integer_of, integers_of, raised, real_of, reals_of
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : complain, count_fits, fits, say, warn
   use contact_capi_problem, only : library_problem
   use contact_capi_registry, only : enter, leave, scope
   use contact_cases_spec, only : case_spec, damping_spec, friction_set, heat_spec
   use contact_control_digits, only : choice_of, digit_of
   use contact_control_units, only : inward, quantity, unit_convention
   use contact_elastic_material, only : combine, combined_material
   use contact_text_words, only : integer_text, real_text
   implicit none (type, external)
   private

   public :: cntc_setsolverflags, cntc_setmaterialparameters, cntc_settemperaturedata, cntc_settimestep
   public :: cntc_setrollingstepsize, cntc_setfrictionmethod, cntc_settangentialforces

   !> Smallest coefficient of friction, slope reduction factor [-], and modulus of a layer [N/mm2]
   real(wp), parameter :: least_value = 1.0e-6_wp
   !> Coefficients of friction that differ by less, relative, are one number
   real(wp), parameter :: same_friction = 1.0e-3_wp
   !> Smallest half-value slip velocity [mm/s]
   real(wp), parameter :: least_speed = 1.0e-4_wp
   !> Bodies with a smaller difference parameter need no outer iteration [-]
   real(wp), parameter :: quasi_identical = 1.0e-4_wp
   !> Yield limits from here on are never reached [N/mm2]
   real(wp), parameter :: unreachable_yield = 1.0e10_wp

   !> Prescribed tangential forces by the friction bound are shortened to this, because the bound itself is
   !> reached by infinite creepage only
   real(wp), parameter :: largest_force = 1.0_wp - 1.0e-4_wp

contains

   !> Iteration limits and solver (G)
   subroutine cntc_setsolverflags(ire, icp, gdigit, nints, iparam, nreals, rparam) bind(c, name="inside_cntc_setsolverflags")
      integer(c_int), intent(in), optional :: ire, icp, gdigit, nints, iparam(*), nreals
      real(c_double), intent(in), optional :: rparam(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      !> Numbers of integers and reals for each method
      integer, parameter :: n_ints(0:6) = [4, 0, 5, 5, 5, 5, 1], n_reals(0:6) = [1, 0, 4, 4, 2, 8, 1]
      integer, allocatable :: ints(:)
      real(wp), allocatable :: reals(:)
      integer :: method

      this = entry_type("cntc_setSolverFlags", integer_of(ire), integer_of(icp))
      call enter(this, scope%settings, problem)
      if (.not. associated(problem)) return
      method = integer_of(gdigit)
      ints = integers_of(nints, iparam)
      reals = reals_of(nreals, rparam)
      if (method == 6) problem%setting%group = "sensitivities"
      if (method < 0 .or. method > 6) then
         call complain(this, "solver method " // integer_text(method) // " is outside its range 0 to 6")
      else if (count_fits(this, method, size(ints), n_ints(method), n_ints(method))) then
         if (count_fits(this, method, size(reals), n_reals(method), n_reals(method))) then
            call set_solver(this, method, ints, reals, problem%spec)
         end if
      end if
      call leave(problem)
   end subroutine cntc_setsolverflags

   !> Store solver settings whose counts fit
   subroutine set_solver(this, method, ints, reals, spec)
      type(entry_type), intent(in) :: this
      integer, intent(in) :: method, ints(:)
      real(wp), intent(in) :: reals(:)
      type(case_spec), intent(inout) :: spec
      !> Names of the values of each method
      character(len=*), parameter :: integer_names(0:6) = [character(len=32) :: "MAXGS MAXIN MAXNR MAXOUT", "", &
         & "MAXGS MAXIN MAXNR MAXOUT INISLP", "MAXGS MAXIN MAXNR MAXOUT INISLP", "MAXGS MAXIN MAXNR MAXOUT INISLP", &
         & "MAXGS MAXIN MAXNR MAXOUT KDOWFB", "MXSENS"]
      character(len=*), parameter :: real_names(0:6) = [character(len=52) :: "EPS", "", "EPS OMEGAH OMEGAS OMGSLP", &
         & "EPS OMEGAH OMEGAS OMGSLP", "EPS OMGSLP", "EPS FDECAY BETATH D_IFC D_LIN D_CNS D_SLP POW_S", "EPSENS"]

      if (.not. fits(this, trim(integer_names(method)), real(ints, wp))) return
      if (.not. fits(this, trim(real_names(method)), reals)) return
      associate (iteration => spec%iteration)
         if (method == 6) then
            iteration%mxsens = ints(1)
            iteration%epsens = reals(1)
            return
         end if
         spec%digits%g = method
         if (method == 1) return
         spec%solver = choice_of("G", method, 3)
         iteration%maxgs = ints(1)
         iteration%maxin = ints(2)
         iteration%maxnr = ints(3)
         iteration%maxout = ints(4)
         iteration%eps = reals(1)
         select case (method)
         case (2, 3)
            iteration%inislp = ints(5)
            iteration%omegah = reals(2)
            iteration%omegas = reals(3)
            iteration%omgslp = reals(4)
         case (4)
            iteration%inislp = ints(5)
            iteration%omgslp = reals(2)
         case (5)
            iteration%kdowfb = ints(5)
            iteration%fdecay = reals(2)
            iteration%betath = reals(3)
            iteration%d_ifc = max(0.01_wp, reals(4))
            iteration%d_lin = reals(5)
            iteration%d_cns = max(0.01_wp, reals(6))
            iteration%d_slp = max(0.01_wp, reals(7))
            iteration%pow_s = max(0.01_wp, min(10.0_wp, reals(8)))
            if (iteration%d_lin*(iteration%d_cns - iteration%d_ifc) < 0.0_wp) then
               call say(0, this, "d_lin leads away from d_cns; it is replaced by 0, and d_cns by d_ifc")
               iteration%d_lin = 0.0_wp
               iteration%d_cns = iteration%d_ifc
            end if
         end select
      end associate
   end subroutine set_solver

   !> Materials (M), or damping forces (M2, 10 higher)
   subroutine cntc_setmaterialparameters(ire, icp, imeth, nparam, rparam) bind(c, name="inside_cntc_setmaterialparameters")
      integer(c_int), intent(in), optional :: ire, icp, imeth, nparam
      real(c_double), intent(in), optional :: rparam(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      !> Fewest and most values for each method; -1: no such method
      integer, parameter :: fewest(0:12) = [4, 8, 8, 7, 8, 7, 4, 4, -1, -1, 0, 0, 4]
      integer, parameter :: most(0:12) = [4, 8, 8, 7, 8, 7, 4, 4, -1, -1, 1, 1, 4]
      real(wp), allocatable :: values(:)
      integer :: method, with_sheet

      this = entry_type("cntc_setMaterialParameters", integer_of(ire), integer_of(icp))
      call enter(this, scope%settings, problem)
      if (.not. associated(problem)) return
      method = integer_of(imeth)
      values = reals_of(nparam, rparam)
      if (method >= 10) problem%setting%group = "damping"
      if (method < 0 .or. method > 12 .or. method == 8 .or. method == 9) then
         call complain(this, "there is no material method " // integer_text(method))
      else
         ! the flexibility of an elastic thin sheet comes last, where there is one
         with_sheet = 0
         if (method < 10 .and. problem%spec%digits%b == digit_of("B", pressure_model%thin_sheet, problem%module_number)) &
            & with_sheet = 1
         if (.not. count_fits(this, method, size(values), fewest(method), most(method) + with_sheet)) then
            call leave(problem)
            return
         end if
         if (method >= 12) then
            call set_damping(this, values, problem)
         else if (method >= 10) then
            call keep_damping(method == 11, problem%spec)
         else
            call set_material(this, method, values, size(values) > most(method), problem%units, problem%spec)
         end if
      end if
      call leave(problem)
   end subroutine cntc_setmaterialparameters

   !> No damping, or the values in store
   subroutine keep_damping(keep, spec)
      logical, intent(in) :: keep
      type(case_spec), intent(inout) :: spec

      spec%digits%m2 = merge(1, 0, keep)
      if (keep) then
         spec%has_damping = any([spec%damping%cdampn, spec%damping%cdampt] > 0.0_wp)
      else
         spec%damping%cdampn = 0.0_wp
         spec%damping%cdampt = 0.0_wp
         spec%damping%dfnmax = 0.0_wp
         spec%damping%dftmax = 0.0_wp
         spec%has_damping = .false.
      end if
   end subroutine keep_damping

   !> New damping: coefficients [s], largest rates [N/s]
   subroutine set_damping(this, values, problem)
      type(entry_type), intent(in) :: this
      real(wp), intent(in) :: values(4)
      type(library_problem), intent(inout) :: problem
      real(wp) :: v(4)

      v = values
      v(3:4) = values(3:4)*inward(problem%units, quantity%force)
      if (.not. fits(this, "CDAMPN CDAMPT DFNMAX DFTMAX", v)) return
      problem%spec%damping = damping_spec(cdampn=v(1), cdampt=v(2), dfnmax=v(3), dftmax=v(4))
      problem%spec%digits%m2 = 2
      problem%spec%has_damping = .true.
   end subroutine set_damping

   !> Elastic constants and what belongs to the model
   subroutine set_material(this, method, values, with_sheet, units, spec)
      type(entry_type), intent(in) :: this
      integer, intent(in) :: method
      real(wp), intent(in) :: values(:)
      !> Is the last value the flexibility of an elastic thin sheet?
      logical, intent(in) :: with_sheet
      type(unit_convention), intent(in) :: units
      type(case_spec), intent(inout) :: spec
      !> Names of the values of each method; 6 and 7 have those of 0
      character(len=*), parameter :: names(0:7) = [character(len=44) :: "", " FG1 FG2 TC1 TC2", " FLX K0_MF ALFAMF BETAMF", &
         & " K0_MF ALFAMF BETAMF", " GG3 LAYTHK TAU_C0 K_TAU", " K0_MF ALFAMF BETAMF", "", ""]
      type(combined_material) :: both
      real(wp) :: v(9)
      logical :: unlike
      integer :: n

      n = size(values)
      v(:n) = values
      associate (pressure => inward(units, quantity%pressure))
         v(3:4) = v(3:4)*pressure
         select case (method)
         case (2)
            v(5) = v(5)*inward(units, quantity%compliance)
            v(6:8) = raised(v(6:8), least_value)
         case (3, 5)
            v(5:7) = raised(v(5:7), least_value)
         case (4)
            v(5:8) = v(5:8)*[pressure, inward(units, quantity%length), pressure, inward(units, quantity%pressure_slope)]
         end select
      end associate
      if (with_sheet) v(n) = values(n)*inward(units, quantity%compliance)
      if (.not. fits(this, "POISS1 POISS2 GG1 GG2" // trim(names(method)) // trim(merge(" FLXZ", "     ", with_sheet)), v(:n))) &
         & return
      spec%digits%m = method
      spec%material_model = choice_of("M", method, 3)
      associate (material => spec%material)
         material%poiss = v(1:2)
         material%gg = v(3:4)
         if (with_sheet) material%flxz = v(n)
         select case (method)
         case (1)
            material%fg = v(5:6)
            material%tc = v(7:8)
         case (2)
            material%flx = v(5)
            call set_slope_reduction(v(6:8))
         case (3, 5)
            call set_slope_reduction(v(5:7))
         case (4)
            material%gg3 = v(5)
            material%laythk = max(1.0e-9_wp, v(6))
            material%tau_c0 = v(7)
            if (material%tau_c0 >= unreachable_yield) material%tau_c0 = 0.0_wp
            material%k_tau = v(8)
         end select
         both = combine(material%poiss, material%gg)
         unlike = abs(both%ak) >= quasi_identical
         if (method == 1) unlike = unlike .or. material%relaxes_apart()
         if (spec%iteration%maxout >= 2 .and. .not. unlike) spec%iteration%maxout = 1
         if (spec%iteration%maxout <= 1 .and. unlike) spec%iteration%maxout = 10
      end associate

   contains

      !> k0, alfa, beta
      subroutine set_slope_reduction(list)
         real(wp), intent(in) :: list(3)
         spec%material%k0_mf = list(1)
         spec%material%alfamf = list(2)
         spec%material%betamf = list(3)
      end subroutine set_slope_reduction
   end subroutine set_material

   !> Surface temperatures (H)
   subroutine cntc_settemperaturedata(ire, icp, imeth, nparam, params) bind(c, name="inside_cntc_settemperaturedata")
      integer(c_int), intent(in), optional :: ire, icp, imeth, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp), allocatable :: v(:)
      integer :: method

      this = entry_type("cntc_setTemperatureData", integer_of(ire), integer_of(icp))
      call enter(this, scope%any, problem)
      if (.not. associated(problem)) return
      method = integer_of(imeth)
      v = reals_of(nparam, params)
      select case (method)
      case (0, 1)
         if (count_fits(this, method, size(v), 0, 1)) problem%spec%digits%h = method
      case (3)
         if (count_fits(this, method, size(v), 9, 9)) then
            v([3, 7]) = v([3, 7])*inward(problem%units, quantity%conductivity)
            v([4, 8]) = v([4, 8])*inward(problem%units, quantity%density)
            if (fits(this, "BKTEMP1 HEATCP1 LAMBDA1 DENS1 BKTEMP2 HEATCP2 LAMBDA2 DENS2 BETAPL", v)) then
               problem%spec%digits%h = method
               problem%spec%heat = heat_spec(bktemp=v([1, 5]), heatcp=v([2, 6]), lambda=v([3, 7]), dens=v([4, 8]), &
                  & betapl=v(9), source=problem%spec%heat%source)
            end if
         end if
      case default
         call complain(this, "there is no temperature method " // integer_text(method) // "; 0, 1 and 3 are")
      end select
      call leave(problem)
   end subroutine cntc_settemperaturedata

   !> Time step; every solution derives its own from step and velocity
   subroutine cntc_settimestep(ire, icp, dt) bind(c, name="inside_cntc_settimestep")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(in), optional :: dt
      type(library_problem), pointer :: problem
      type(entry_type) :: this

      this = entry_type("cntc_setTimeStep", integer_of(ire), integer_of(icp))
      call enter(this, scope%settings, problem)
      if (.not. associated(problem)) return
      if (fits(this, "TC", [real_of(dt)], "dt")) call say(2, this, "the time step follows from rolling step and velocity")
      call leave(problem)
   end subroutine cntc_settimestep

   !> Rolling direction and step; for wheel and rail the step in elements
   subroutine cntc_setrollingstepsize(ire, icp, chi, dq) bind(c, name="inside_cntc_setrollingstepsize")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(in), optional :: chi, dq
      type(library_problem), pointer :: problem
      type(entry_type) :: this

      this = entry_type("cntc_setRollingStepsize", integer_of(ire), integer_of(icp))
      call enter(this, scope%settings, problem)
      if (.not. associated(problem)) return
      if (problem%module_number == 1) then
         if (fits(this, "DQREL", [real_of(dq)])) then
            problem%spec%wheel_rail%search%dqrel = real_of(dq)
            if (problem%spec%digits%d == 1) problem%spec%digits%d = problem%spec%wheel_rail%search%location
         end if
      else
         associate (values => [real_of(chi)*inward(problem%units, quantity%angle), &
            & real_of(dq)*inward(problem%units, quantity%length)])
            if (fits(this, "CHI DQ", values)) then
               problem%spec%rolling%chi = values(1)
               problem%spec%rolling%dq = values(2)
            end if
         end associate
      end if
      call leave(problem)
   end subroutine cntc_setrollingstepsize

   !> Friction law (L) and its variation (V)
   subroutine cntc_setfrictionmethod(ire, icp, imeth, nparam, params) bind(c, name="inside_cntc_setfrictionmethod")
      integer(c_int), intent(in), optional :: ire, icp, imeth, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      !> Number of values of each law
      integer, parameter :: n_law(0:6) = [2, 0, 7, 7, 7, 3, 6]
      real(wp), allocatable :: values(:)
      integer :: method, law, points

      this = entry_type("cntc_setFrictionMethod", integer_of(ire), integer_of(icp))
      call enter(this, scope%settings, problem)
      if (.not. associated(problem)) return
      method = max(-1, integer_of(imeth))
      values = reals_of(nparam, params)
      law = mod(method, 10)
      if (method < 0 .or. method > 29 .or. law > 6) then
         call complain(this, "there is no friction method " // integer_text(method))
      else if (method >= 10 .and. problem%module_number /= 1) then
         call complain(this, "friction that varies over the rail belongs to wheel and rail, method " // integer_text(method))
      else if (law == 1) then
         if (count_fits(this, method, size(values), 0, 0)) problem%spec%digits%l = 1
      else if (method < 10) then
         if (count_fits(this, method, size(values), n_law(law), n_law(law))) call set_friction_points(this, 0, law, 1, values, &
            & problem)
      else
         points = 0
         if (size(values) > 0) then
            if (abs(values(1)) < 1.0e6_wp) points = max(0, nint(values(1)))
         end if
         if (count_fits(this, method, size(values), 1 + points*(1 + n_law(law)), 1 + points*(1 + n_law(law)))) &
            & call set_friction_points(this, method/10, law, points, values(2:), problem)
      end if
      call leave(problem)
   end subroutine cntc_setfrictionmethod

   !> Store a law with its points
   subroutine set_friction_points(this, variation, law, points, values, problem)
      type(entry_type), intent(in) :: this
      !> V, L, number of points
      integer, intent(in) :: variation, law, points
      !> Values of the law; with variation a position before those of each point
      real(wp), intent(in) :: values(:)
      type(library_problem), intent(inout) :: problem
      type(friction_set), allocatable :: sets(:)
      real(wp) :: memory(2)
      integer :: k, n
      logical :: good

      memory = [problem%spec%friction%memdst, problem%spec%friction%mem_s0]
      allocate(sets(points))
      if (points > 0) n = size(values)/points
      do k = 1, points
         associate (part => values((k - 1)*n + 1:k*n))
            if (variation == 0) then
               call fill_set(this, law, part, problem%units, sets(k), memory, good)
            else
               call fill_set(this, law, part(2:), problem%units, sets(k), memory, good)
               sets(k)%position = part(1)*inward(problem%units, merge(quantity%angle, quantity%length, variation == 1))
               if (good) good = fits(this, trim(merge("ALPHA", "SVF  ", variation == 1)), [sets(k)%position])
            end if
         end associate
         if (.not. good) return
         if (k == 1) cycle
         if (sets(k)%position > sets(k - 1)%position) cycle
         call complain(this, "the positions of friction data must increase; nothing is stored")
         return
      end do
      associate (spec => problem%spec)
         spec%digits%v = variation
         spec%digits%l = merge(4, law, law == 5)
         spec%variation = choice_of("V", variation, problem%module_number)
         spec%friction_law = choice_of("L", spec%digits%l, problem%module_number)
         spec%friction%memdst = memory(1)
         spec%friction%mem_s0 = memory(2)
         call move_alloc(sets, spec%friction%sets)
      end associate
   end subroutine set_friction_points

   !> One set of friction parameters
   subroutine fill_set(this, law, values, units, set, memory, good)
      type(entry_type), intent(in) :: this
      integer, intent(in) :: law
      real(wp), intent(in) :: values(:)
      type(unit_convention), intent(in) :: units
      type(friction_set), intent(out) :: set
      !> Distance [mm] and velocity [mm/s] of friction memory; kept by laws that have none
      real(wp), intent(inout) :: memory(2)
      !> Can the values be used?
      logical, intent(out) :: good
      real(wp) :: velocity, length
      real(wp) :: v(size(values))

      velocity = inward(units, quantity%velocity)
      length = inward(units, quantity%length)
      set%sabsh1 = 10000.0_wp
      set%sabsh2 = 10000.0_wp
      v = values
      select case (law)
      case (0)
         v = raised(v, least_value)
         good = fits(this, "FSTAT", v)
         set%fstat = min(v(1), v(2))
         set%fkin = set%fstat
         if (good .and. abs(v(1) - v(2)) > same_friction*abs(v(1))) call warn(this, "FSTAT = " // real_text(v(1)) // &
            & " and FKIN = " // real_text(v(2)) // " differ; Coulomb friction has one coefficient: here the smaller one, " // &
            & "in an input file FSTAT")
      case (2, 3, 4)
         v(1) = raised(v(1), least_value)
         v([3, 5]) = raised(v([3, 5])*velocity, least_speed)
         v(6:7) = v(6:7)*[length, velocity]
         good = fits(this, "FKIN FLIN1 SABSH1 FLIN2 SABSH2 MEMDST MEM_S0", v)
         set%fkin = v(1)
         set%coef1 = v(2)
         set%sabsh1 = v(3)
         set%coef2 = v(4)
         set%sabsh2 = v(5)
         set%fstat = set%fkin + set%coef1 + set%coef2
         memory = v(6:7)
      case (5)
         ! Polach: exponential decay from fstat to A fstat, halved at ln 2/B
         v(1) = raised(v(1), least_value)
         v(3) = raised(v(3)*inward(units, quantity%per_velocity), tiny(1.0_wp))
         good = fits(this, "FSTAT ALFAMF FG", v, "FSTAT A B")
         set%fstat = v(1)
         set%fkin = v(2)*set%fstat
         set%coef1 = set%fstat - set%fkin
         if (good) set%sabsh1 = max(least_speed, log(2.0_wp)/v(3))
         memory = [0.001_wp, 10.0_wp]
      case default
         v(1) = raised(v(1), least_value)
         v(5:6) = v(5:6)*[length, velocity]
         good = fits(this, "FREF TREF DFHEAT DTHEAT MEMDST MEM_S0", v)
         if (good .and. v(1) + v(3) < 0.0_wp) then
            call complain(this, "FREF + DFHEAT = " // real_text(v(1) + v(3)) // " is below its lower bound 0; nothing is stored")
            good = .false.
         end if
         set%fref = v(1)
         set%tref = v(2)
         set%dfheat = max(least_value - set%fref, v(3))
         set%dtheat = v(4)
         set%fstat = set%fref
         set%fkin = set%fref + set%dfheat
         memory = v(5:6)
      end select
   end subroutine fill_set

   !> Prescribed tangential forces: relative ones (module 3), or the longitudinal force on the rail (module 1)
   subroutine cntc_settangentialforces(ire, icp, fx, fy) bind(c, name="inside_cntc_settangentialforces")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(in), optional :: fx, fy
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp) :: force(2)

      this = entry_type("cntc_setTangentialForces", integer_of(ire), integer_of(icp))
      call enter(this, scope%settings, problem)
      if (.not. associated(problem)) return
      force = [real_of(fx), real_of(fy)]
      if (problem%module_number == 1) then
         force(1) = force(1)*inward(problem%units, quantity%force)
         if (fits(this, "FX_WS", force(:1))) problem%spec%wheel_rail%wheelset%fx = force(1)
      ! forces beyond the friction bound are shortened to it, so that the bounds of FX are too narrow here
      else if (fits(this, "CKSI CETA", force, "FX FY")) then
         force = force/max(1.0_wp, hypot(force(1), force(2))/largest_force)
         problem%spec%kinematics%fx = force(1)
         problem%spec%kinematics%fy = force(2)
      end if
      call leave(problem)
   end subroutine cntc_settangentialforces
end module contact_capi_physics
