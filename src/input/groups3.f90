!> The groups of a case of module 3 that hold physics: iteration, motion, friction, materials
!>
!> Each reader overwrites its part of the case and checks the values it read.
module contact_input_groups3
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec, friction_set, material_spec
   use contact_input_problems, only : problem_list, severity
   use contact_input_values, only : read_list, read_values
   use contact_text_lexer, only : input_lexer, input_value
   use contact_text_words, only : integer_text, real_text
   implicit none (type, external)
   private

   public :: read_iteration, read_kinematics, read_friction, read_friction_rows, read_rolling, read_materials
   public :: read_damping, read_heat, difference_parameter, read_friction_set, read_friction_memory

   !> Bounds of the largest number of elements of a patch of wheel and rail
   integer, parameter :: fewest_elements = 100, most_elements = 1000000
   !> Coefficients of friction terms below this value switch the term off [-]
   real(wp), parameter :: no_term = 1.0e-8_wp
   !> Half-value slip velocity of a term that is switched off, at least [mm/s]
   real(wp), parameter :: smallest_unused = 1.0e-4_wp
   !> Yield limits outside these bounds mean that there is no plasticity [N/mm2]
   real(wp), parameter :: unreachable_yield = 1.0e10_wp
   !> Difference parameters below this value count as zero [-]
   real(wp), parameter :: quasi_identical = 1.0e-4_wp
   !> Below this there is no difference in the equations, see contact_elastic_material
   real(wp), parameter :: no_difference = 1.0e-6_wp

contains

   !> Settings of the iterative solvers (G other than 1)
   subroutine read_iteration(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(8)

      if (spec%digits%g == 1) return
      associate (iteration => spec%iteration)
         call read_values(lexer, "iiiirI", "MAXGS MAXIN MAXNR MAXOUT EPS NPOT_MAX", v, problems, error)
         if (allocated(error)) return
         iteration%maxgs = v(1)%i
         iteration%maxin = v(2)%i
         iteration%maxnr = v(3)%i
         iteration%maxout = v(4)%i
         iteration%eps = v(5)%r
         if (v(6)%given) then
            iteration%npot_max = max(fewest_elements, min(most_elements, v(6)%i))
            if (iteration%npot_max /= v(6)%i) call problems%add(severity%warning, "NPOT_MAX = " // v(6)%word // &
               & " is replaced by " // integer_text(iteration%npot_max), v(6)%line, v(6)%column)
         end if

         select case (spec%digits%g)
         case (2, 3)
            call read_values(lexer, "rrrr", "OMEGAH OMEGAS INISLP OMGSLP", v, problems, error)
            if (allocated(error)) return
            iteration%omegah = v(1)%r
            iteration%omegas = v(2)%r
            iteration%inislp = branch(v(3)%r)
            iteration%omgslp = v(4)%r
         case (4)
            call read_values(lexer, "rr", "INISLP OMGSLP", v, problems, error)
            if (allocated(error)) return
            iteration%inislp = branch(v(1)%r)
            iteration%omgslp = v(2)%r
         case (5)
            call read_values(lexer, "rrirrrrr", "FDECAY BETATH KDOWFB D_IFC D_LIN D_CNS D_SLP POW_S", v, problems, error)
            if (allocated(error)) return
            iteration%fdecay = v(1)%r
            iteration%betath = v(2)%r
            iteration%kdowfb = v(3)%i
            iteration%d_ifc = max(0.01_wp, v(4)%r)
            iteration%d_lin = v(5)%r
            iteration%d_cns = max(0.01_wp, v(6)%r)
            iteration%d_slp = max(0.01_wp, v(7)%r)
            iteration%pow_s = max(0.01_wp, min(10.0_wp, v(8)%r))
            if (iteration%d_lin*(iteration%d_cns - iteration%d_ifc) < 0.0_wp) then
               call problems%add(severity%warning, "D_LIN = " // v(5)%word // " leads away from D_CNS = " // v(6)%word // &
                  & "; it is replaced by 0, and D_CNS by D_IFC = " // v(4)%word, v(5)%line, v(5)%column)
               iteration%d_lin = 0.0_wp
               iteration%d_cns = iteration%d_ifc
            end if
         end select
      end associate
   end subroutine read_iteration

   !> INISLP as an integer: files in use write it as 0.0 or 1.0 too, and only its sign has a meaning
   pure integer function branch(value)
      real(wp), intent(in) :: value

      branch = int(sign(min(1000.0_wp, anint(abs(value) + 0.49_wp)), value))
   end function branch

   !> Approach or normal force, creepages or tangential forces (always)
   subroutine read_kinematics(lexer, spec, problems, line, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      !> Line of the group
      integer, intent(out) :: line
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(6)
      character(len=:), allocatable :: names

      names = "PEN"
      if (spec%digits%n == 1) names = "FN"
      names = names // trim(merge(" FX  ", " CKSI", spec%digits%f >= 1))
      names = names // trim(merge(" FY  ", " CETA", spec%digits%f >= 2)) // " CPHI SPINXO SPINYO"
      call read_values(lexer, "rrrrRR", names, v, problems, error)
      line = lexer%line
      if (allocated(error)) return

      associate (kinematics => spec%kinematics)
         if (spec%digits%n == 1) then
            kinematics%fn = v(1)%r
         else
            kinematics%pen = v(1)%r
         end if
         if (spec%digits%f >= 1) then
            kinematics%fx = v(2)%r
         else
            kinematics%cksi = v(2)%r
         end if
         if (spec%digits%f >= 2) then
            kinematics%fy = v(3)%r
            if (maxval(abs(v(2:3)%r)) <= 1.0_wp .and. hypot(v(2)%r, v(3)%r) > 1.0_wp) call problems%add(severity%error, &
               & "FX = " // v(2)%word // " and FY = " // v(3)%word // " exceed the friction bound: FX**2 + FY**2 = " // &
               & real_text(hypot(v(2)%r, v(3)%r)**2) // " is above its upper bound 1", v(3)%line, v(3)%column)
         else
            kinematics%ceta = v(3)%r
         end if
         kinematics%cphi = v(4)%r
         kinematics%spinxo = 0.0_wp
         kinematics%spinyo = 0.0_wp
         if (v(6)%given) then
            kinematics%spinxo = v(5)%r
            kinematics%spinyo = v(6)%r
         else if (v(5)%given) then
            call problems%add(severity%warning, "SPINXO = " // v(5)%word // " is given without SPINYO; both are set to 0", &
               & v(5)%line, v(5)%column)
         end if
      end associate
   end subroutine read_kinematics

   !> One set of friction parameters (L other than 1, V other than 3)
   subroutine read_friction(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error

      if (.not. allocated(spec%friction%sets)) allocate(spec%friction%sets(1))
      if (spec%digits%l == 1 .or. spec%digits%v == 3) return
      if (size(spec%friction%sets) /= 1) then
         deallocate(spec%friction%sets)
         allocate(spec%friction%sets(1))
      end if
      call read_friction_set(lexer, spec%digits%l, spec%friction%sets(1), problems, error)
      if (allocated(error)) return
      call read_friction_memory(lexer, spec, problems, error)
   end subroutine read_friction

   !> One set for each row of the grid (L other than 1, V = 3), after the geometry
   subroutine read_friction_rows(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(friction_set), allocatable :: sets(:), longer(:)
      integer :: row, rows

      if (spec%digits%l == 1 .or. spec%digits%v /= 3) return
      rows = max(1, spec%grid%my)
      allocate(sets(min(rows, 100)))
      do row = 1, rows
         if (row > size(sets)) then
            allocate(longer(min(rows, 2*size(sets))))
            longer(:size(sets)) = sets
            call move_alloc(longer, sets)
         end if
         call read_friction_set(lexer, spec%digits%l, sets(row), problems, error)
         if (allocated(error)) return
      end do
      call move_alloc(sets, spec%friction%sets)
      call read_friction_memory(lexer, spec, problems, error)
   end subroutine read_friction_rows

   !> The values of one set
   subroutine read_friction_set(lexer, law, set, problems, error, control)
      type(input_lexer), intent(inout) :: lexer
      !> L
      integer, intent(in) :: law
      type(friction_set), intent(inout) :: set
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      !> Control point that stands before the values: on entry its name, an angle when that is ALPHA
      type(input_value), intent(inout), optional :: control
      type(input_value) :: v(5), all_values(6)
      !> What the coefficients are called in the laws that fall with slip velocity
      character(len=4), parameter :: falling(2:4) = ["FLIN", "FRAT", "FEXP"]
      character(len=:), allocatable :: types, names
      integer :: k, first

      select case (law)
      case (0)
         types = "rr"
         names = "FSTAT FKIN"
      case (2, 3, 4)
         types = "rrrrr"
         names = "FKIN " // falling(law) // "1 SABSH1 " // falling(law) // "2 SABSH2"
      case (6)
         types = "rrrr"
         names = "FREF TREF DFHEAT DTHEAT"
      case default
         return
      end select
      first = 1
      if (present(control)) then
         first = 2
         names = control%name // " " // names
         types = merge("a", "r", control%name == "ALPHA") // types
      end if
      call lexer%read_group(types, names, all_values, error)
      if (allocated(error)) return
      v = all_values(first:first + 4)
      if (any(law == [2, 3, 4])) then
         do k = 2, 4, 2
            if (v(k)%r < no_term) v(k + 1)%r = max(smallest_unused, v(k + 1)%r)
         end do
      end if
      if (present(control)) then
         control = all_values(1)
         call problems%check_bounds(control)
      end if
      do k = 1, len(types) - first + 1
         call problems%check_bounds(v(k))
      end do

      select case (law)
      case (0)
         if (abs(v(1)%r - v(2)%r) > 1.0e-3_wp*abs(v(1)%r)) call problems%add(severity%warning, "FKIN = " // v(2)%word // &
            & " differs from FSTAT; Coulomb friction has one coefficient: in an input file FSTAT = " // v(1)%word // &
            & ", by cntc_setFrictionMethod the smaller one", v(2)%line, v(2)%column)
         set%fstat = v(1)%r
         set%fkin = v(1)%r
      case (2, 3, 4)
         set%fkin = v(1)%r
         set%coef1 = v(2)%r
         set%sabsh1 = v(3)%r
         set%coef2 = v(4)%r
         set%sabsh2 = v(5)%r
         set%fstat = set%fkin + set%coef1 + set%coef2
      case (6)
         if (v(1)%r + v(3)%r < 0.0_wp) call problems%add(severity%error, "DFHEAT = " // v(3)%word // &
            & ": FREF + DFHEAT = " // real_text(v(1)%r + v(3)%r) // " is below its lower bound 0", v(3)%line, v(3)%column)
         set%fref = v(1)%r
         set%tref = v(2)%r
         set%dfheat = v(3)%r
         set%dtheat = v(4)%r
         set%fstat = set%fref
         set%fkin = set%fref + set%dfheat
      end select
   end subroutine read_friction_set

   !> Friction memory of the laws that are not Coulomb's
   subroutine read_friction_memory(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(2)

      if (.not. any(spec%digits%l == [2, 3, 4, 6])) return
      call read_values(lexer, "rr", "MEMDST MEM_S0", v, problems, error)
      if (allocated(error)) return
      spec%friction%memdst = v(1)%r
      spec%friction%mem_s0 = v(2)%r
   end subroutine read_friction_memory

   !> Rolling direction, step and velocity (C of 2 and above, T = 2, 3)
   !>
   !> Other motions replace what is stored by fixed values.
   subroutine read_rolling(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(4)

      associate (rolling => spec%rolling)
         if (spec%digits%t /= 2 .and. spec%digits%t /= 3) then
            rolling%chi = 0.0_wp
            rolling%dq = 1.0_wp
            rolling%veloc = 1.0_wp
            return
         end if
         if (spec%digits%c < 2) return
         call read_values(lexer, "arrR", "CHI DQ VELOC FACPHI", v, problems, error)
         if (allocated(error)) return
         if (spec%digits%m == 1 .and. abs(sin(v(1)%r)) > 0.01_wp) call problems%add(severity%error, "CHI = " // v(1)%word // &
            & " is not along x, 0 or 180 degrees within 0.01 rad, which viscoelastic material needs", v(1)%line, v(1)%column)
         rolling%chi = v(1)%r
         rolling%dq = v(2)%r
         rolling%veloc = v(3)%r
         rolling%facphi = 1.0_wp/6.0_wp
         if (v(4)%given) rolling%facphi = v(4)%r
      end associate
   end subroutine read_rolling

   !> Influence coefficients and materials (C of 2 and above)
   subroutine read_materials(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(4), place

      if (spec%digits%c < 2) return
      associate (material => spec%material)
         select case (spec%digits%c)
         case (4)
            if (allocated(spec%wheel_rail)) then
               call read_conformal_method(lexer, material, problems, error)
            else
               call read_inclinations(lexer, material, problems, error)
            end if
            if (allocated(error)) return
         case (9)
            call read_values(lexer, "s", "CFNAME", v, problems, error)
            if (allocated(error)) return
            material%cfname = v(1)%s
         end select

         call read_values(lexer, "rrrr", "POISS1 POISS2 GG1 GG2", v, problems, error)
         if (allocated(error)) return
         material%poiss = v(1:2)%r
         material%gg = v(3:4)%r
         place = v(1)

         if (spec%digits%b == 1) then
            call read_values(lexer, "r", "FLXZ", v, problems, error)
            if (allocated(error)) return
            material%flxz = v(1)%r
         end if
         call read_material_model(lexer, spec%digits%m, material, problems, error)
         if (allocated(error)) return
         if (minval(material%gg) >= 1.0e-5_wp .and. minval([material%fg, material%tc]) >= 0.0_wp) &
            & call check_outer_iteration(spec, place, problems)
      end associate
   end subroutine read_materials

   !> Conformal contact of wheel and rail (C = 4 of module 1): the inclinations are those of the profiles
   subroutine read_conformal_method(lexer, material, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(material_spec), intent(inout) :: material
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(2)

      call read_values(lexer, "ii", "IF_METH VARIANT", v, problems, error)
      if (allocated(error)) return
      material%if_meth = v(1)%i
      material%variant = v(2)%i
   end subroutine read_conformal_method

   !> Table of surface inclinations for conformal contact (C = 4)
   subroutine read_inclinations(lexer, material, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(material_spec), intent(inout) :: material
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(3)
      real(wp), allocatable :: table(:)
      integer :: n

      call read_values(lexer, "iii", "IF_METH VARIANT NN", v, problems, error)
      if (allocated(error)) return
      material%if_meth = v(1)%i
      material%variant = v(2)%i
      n = max(0, min(v(3)%i, 1000000))
      call read_list(lexer, 2*n, "Y,ALPHA", table, problems, error, angles=.true.)
      if (allocated(error)) return
      material%table_y = table(1::2)
      material%table_alpha = table(2::2)
   end subroutine read_inclinations

   !> The line that belongs to the M-digit
   subroutine read_material_model(lexer, model, material, problems, error)
      type(input_lexer), intent(inout) :: lexer
      !> M
      integer, intent(in) :: model
      type(material_spec), intent(inout) :: material
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(4)

      select case (model)
      case (1)
         call read_values(lexer, "rrrr", "FG1 FG2 TC1 TC2", v, problems, error)
         if (allocated(error)) return
         material%fg = v(1:2)%r
         material%tc = v(3:4)%r
      case (2)
         call read_values(lexer, "rrrr", "FLX K0_MF ALFAMF BETAMF", v, problems, error)
         if (allocated(error)) return
         material%flx = v(1)%r
         call take_slope_reduction(v(2:4))
      case (3, 5)
         call read_values(lexer, "rrr", "K0_MF ALFAMF BETAMF", v, problems, error)
         if (allocated(error)) return
         call take_slope_reduction(v(1:3))
      case (4)
         call read_values(lexer, "rrrr", "GG3 LAYTHK TAU_C0 K_TAU", v, problems, error)
         if (allocated(error)) return
         material%gg3 = v(1)%r
         material%laythk = v(2)%r
         material%tau_c0 = v(3)%r
         if (material%tau_c0 >= unreachable_yield) material%tau_c0 = 0.0_wp
         material%k_tau = v(4)%r
      end select

   contains

      !> Parameters of the slope reduction
      subroutine take_slope_reduction(values)
         !> K0_MF ALFAMF BETAMF
         type(input_value), intent(in) :: values(3)

         material%k0_mf = values(1)%r
         material%alfamf = values(2)%r
         material%betamf = values(3)%r
      end subroutine take_slope_reduction
   end subroutine read_material_model

   !> Dissimilar bodies need the outer iteration, similar bodies do not
   subroutine check_outer_iteration(spec, place, problems)
      type(case_spec), intent(inout) :: spec
      !> First value of the material line
      type(input_value), intent(in) :: place
      type(problem_list), intent(inout) :: problems
      real(wp) :: ak
      logical :: is_dissimilar_shape, relaxes_apart
      character(len=:), allocatable :: given

      if (spec%digits%t == 0) return
      ak = difference_parameter(spec%material)
      is_dissimilar_shape = spec%digits%c == 4 .or. spec%digits%c == 9
      relaxes_apart = spec%digits%m == 1
      ! wrong values have been told already
      if (relaxes_apart) relaxes_apart = min(minval(spec%material%fg), minval(spec%material%tc)) >= 0.0_wp
      if (relaxes_apart) relaxes_apart = spec%material%relaxes_apart()
      given = "MAXOUT = " // integer_text(spec%iteration%maxout)
      if (spec%iteration%maxout >= 2) then
         if (is_dissimilar_shape .or. relaxes_apart .or. abs(ak) >= quasi_identical) return
         ! where pressures and tractions do not act on each other at all, one pass is all that can be done
         if (abs(ak) >= no_difference) call problems%add(severity%warning, given // " is replaced by 1: the bodies are " // &
            & "quasi-identical, AK = " // real_text(ak), place%line, place%column)
         spec%iteration%maxout = 1
      else if (abs(ak) >= quasi_identical) then
         call problems%add(severity%warning, given // " means no outer iteration, but the bodies have dissimilar " // &
            & "materials, AK = " // real_text(ak) // "; MAXOUT = 10 or more is recommended", place%line, place%column)
      else if (is_dissimilar_shape) then
         call problems%add(severity%warning, given // " means no outer iteration, but the bodies have dissimilar " // &
            & "shapes, C = " // integer_text(spec%digits%c) // "; MAXOUT = 10 or more is recommended", place%line, place%column)
      else if (relaxes_apart) then
         call problems%add(severity%warning, given // " means no outer iteration, but the bodies relax differently, M = 1; " // &
            & "MAXOUT = 10 or more is recommended", place%line, place%column)
      end if
   end subroutine check_outer_iteration

   !> Kalker's difference parameter K of two bodies [-]
   pure real(wp) function difference_parameter(material) result(ak)
      type(material_spec), intent(in) :: material

      associate (nu => material%poiss, g => material%gg)
         ak = 0.5_wp*((1.0_wp - 2.0_wp*nu(1))*(g(2)/(g(1) + g(2))) - (1.0_wp - 2.0_wp*nu(2))*(g(1)/(g(1) + g(2))))
      end associate
   end function difference_parameter

   !> Force-based damping (M2); 0 sets all to zero
   subroutine read_damping(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(4)

      if (spec%digits%m2 == 1) return
      if (spec%digits%m2 >= 2) then
         call read_values(lexer, "rrrr", "CDAMPN CDAMPT DFNMAX DFTMAX", v, problems, error)
         if (allocated(error)) return
      end if
      spec%damping%cdampn = v(1)%r
      spec%damping%cdampt = v(2)%r
      spec%damping%dfnmax = v(3)%r
      spec%damping%dftmax = v(4)%r
   end subroutine read_damping

   !> Thermal constants (H = 3)
   subroutine read_heat(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(4)
      character :: number
      integer :: body

      if (spec%digits%h /= 3) return
      do body = 1, 2
         number = achar(iachar("0") + body)
         call read_values(lexer, "rrrr", "BKTEMP" // number // " HEATCP" // number // " LAMBDA" // number // &
            & " DENS" // number, v, problems, error)
         if (allocated(error)) return
         spec%heat%bktemp(body) = v(1)%r
         spec%heat%heatcp(body) = v(2)%r
         spec%heat%lambda(body) = v(3)%r
         spec%heat%dens(body) = v(4)%r
      end do
      if (spec%digits%m /= 4) return
      call read_values(lexer, "r", "BETAPL", v, problems, error)
      if (allocated(error)) return
      spec%heat%betapl = v(1)%r
   end subroutine read_heat
end module contact_input_groups3
