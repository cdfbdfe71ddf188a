!> Entries that hand out totals and settings of one patch
module contact_capi_results
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use contact_base_choices, only : motion
   use contact_base_kinds, only : wp
   use contact_capi_arguments, only : give, give_list, give_zeros, integer_of
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : complain
   use contact_capi_problem, only : library_problem
   use contact_capi_registry, only : enter, leave, scope
   use contact_capi_view, only : enter_result, look_at, result_view
   use contact_cases_spec, only : case_spec
   use contact_control_units, only : inward, orientation, outward, quantity, quantity_type
   use contact_elastic_material, only : combine, combined_material
   use contact_patch_result, only : patch_result
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: cntc_getparameters, cntc_getreferencevelocity, cntc_gethertzcontact, cntc_getnumelements
   public :: cntc_getgriddiscretization, cntc_getpotcontact, cntc_getpenetration, cntc_getcreepages
   public :: cntc_getcontactforces, cntc_getcontactpatchareas, cntc_getsensitivities, cntc_getcalculationtime
   public :: cntc_resetcalculationtime

contains

   !> Kinematic constants (1), material constants (2), friction law (3)
   subroutine cntc_getparameters(ire, icp, itask, lenarr, values) bind(c, name="inside_cntc_getparameters")
      integer(c_int), intent(in), optional :: ire, icp, itask, lenarr
      real(c_double), intent(inout), optional :: values(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this

      this = entry_type("cntc_getParameters", integer_of(ire), integer_of(icp))
      call enter(this, scope%one_patch, problem)
      if (.not. associated(problem)) return
      select case (integer_of(itask))
      case (1); call give_list(kinematic_constants(problem, this%icp), lenarr, values)
      case (2); call give_list(material_constants(problem, this%icp), lenarr, values)
      case (3); call give_list(friction_constants(problem%spec), lenarr, values)
      case default; call complain(this, "there is no task " // integer_text(integer_of(itask)) // "; 1, 2 and 3 are")
      end select
      call leave(problem)
   end subroutine cntc_getparameters

   !> V, chi, dq, spinxo, spinyo, tau_c0
   function kinematic_constants(problem, icp) result(list)
      type(library_problem), intent(in) :: problem
      integer, intent(in) :: icp
      real(wp) :: list(6)

      associate (units => problem%units, rolling => problem%stored%rolling, kinematics => problem%stored%kinematics)
         list(1:3) = [rolling%veloc, rolling%chi, rolling%dq]
         if (problem%module_number == 1) then
            associate (patch => problem%wheel_rail_result%patches(icp)%contact)
               list(1:3) = [patch%veloc, patch%chi, patch%dq]
            end associate
         end if
         list(4:6) = [kinematics%spinxo, kinematics%spinyo, problem%spec%material%tau_c0]
         list = list*outward(units, [quantity%velocity, quantity%angle, quantity%length, quantity%length, quantity%length, &
            & quantity%pressure])
      end associate
   end function kinematic_constants

   !> The 22 values of material, layer and damping
   function material_constants(problem, icp) result(list)
      type(library_problem), intent(in) :: problem
      integer, intent(in) :: icp
      real(wp) :: list(22)
      type(combined_material) :: both
      real(wp) :: k_eff, flx(3)

      associate (material => problem%spec%material, damping => problem%spec%damping, units => problem%units)
         both = combine(material%poiss, material%gg)
         flx = merge(material%laythk/material%gg3, material%flx, problem%digits%m == 4)
         k_eff = 0.0_wp
         if (problem%has_result) then
            if (problem%module_number == 3) call take_flexibility(problem%result)
            if (problem%module_number == 1) call take_flexibility(problem%wheel_rail_result%patches(icp)%contact)
         end if
         list = [material%gg, both%gg, material%poiss, both%nu, both%ak, flx, material%k0_mf, material%alfamf, &
            & material%betamf, k_eff, material%gg3, material%laythk, material%tau_c0, material%k_tau, damping%cdampn, &
            & damping%cdampt, damping%dfnmax, damping%dftmax]
         associate (pressure => outward(units, quantity%pressure), force => outward(units, quantity%force))
            list(1:3) = list(1:3)*pressure
            list(8:10) = list(8:10)*outward(units, quantity%compliance)
            list(15) = list(15)*pressure
            list(16) = list(16)*outward(units, quantity%length)
            list(17) = list(17)*pressure
            list(18) = list(18)*outward(units, quantity%pressure_slope)
            list(21:22) = list(21:22)*force
         end associate
      end associate

   contains

      !> Flexibilities of simplified theory as used
      subroutine take_flexibility(patch)
         type(patch_result), intent(in) :: patch

         k_eff = patch%k_eff
         if (any(patch%flx > 0.0_wp)) flx = patch%flx
      end subroutine take_flexibility
   end function material_constants

   !> L, number of points, memory; position and coefficients per point, in internal units by contract
   pure function friction_constants(spec) result(list)
      type(case_spec), intent(in) :: spec
      real(wp), allocatable :: list(:)
      integer :: k

      associate (sets => spec%friction%sets)
         list = [real(spec%friction_law, wp), real(size(sets), wp), spec%friction%memdst, spec%friction%mem_s0, &
            & (sets(k)%position, sets(k)%fstat, sets(k)%fkin, k=1, size(sets))]
      end associate
   end function friction_constants

   !> Rolling velocity
   subroutine cntc_getreferencevelocity(ire, icp, veloc) bind(c, name="inside_cntc_getreferencevelocity")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(inout), optional :: veloc
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp) :: constants(6)

      this = entry_type("cntc_getReferenceVelocity", integer_of(ire), integer_of(icp))
      call enter(this, scope%one_patch, problem)
      if (.not. associated(problem)) return
      constants = kinematic_constants(problem, this%icp)
      call give(constants(1), veloc)
      call leave(problem)
   end subroutine cntc_getreferencevelocity

   !> The Hertz solution: a1, b1, aa, bb, rho, cp, scale, bneg, bpos, aob
   subroutine cntc_gethertzcontact(ire, icp, lenarr, rvalues) bind(c, name="inside_cntc_gethertzcontact")
      integer(c_int), intent(in), optional :: ire, icp, lenarr
      real(c_double), intent(inout), optional :: rvalues(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(result_view) :: view
      real(wp) :: list(10)

      this = entry_type("cntc_getHertzContact", integer_of(ire), integer_of(icp))
      call enter(this, scope%contact, problem)
      if (.not. associated(problem)) return
      view = look_at(this, problem)
      if (associated(view%patch)) then
         associate (grid => problem%spec%grid, length => outward(view%units, quantity%length), &
            & curvature => outward(view%units, quantity%curvature))
            list = [grid%a1*curvature, grid%b1*curvature, grid%aa*length, grid%bb*length, 0.0_wp, 0.0_wp, grid%scale, &
               & grid%bneg*length, grid%bpos*length, grid%aob]
            if (allocated(view%patch%hertz)) then
               associate (hertz => view%patch%hertz)
                  list(1:2) = [hertz%a1, hertz%b1]*curvature
                  list(3:6) = [hertz%aa, hertz%bb, hertz%rho, hertz%cp]*length
                  list(8:9) = hertz%bb*length
                  list(10) = hertz%aob
               end associate
            else
               if (grid%a1 + grid%b1 > 0.0_wp) list(5) = 2.0_wp/(grid%a1 + grid%b1)*length
               list(6) = sqrt(max(0.0_wp, grid%aa*grid%bb))*length
            end if
         end associate
         call give_list(list, lenarr, rvalues)
      end if
      call leave(problem)
   end subroutine cntc_gethertzcontact

   !> Numbers of elements of the current grid
   subroutine cntc_getnumelements(ire, icp, mx, my) bind(c, name="inside_cntc_getnumelements")
      integer(c_int), intent(in), optional :: ire, icp
      integer(c_int), intent(inout), optional :: mx, my
      type(library_problem), pointer :: problem
      type(result_view) :: view

      call enter_result(entry_type("cntc_getNumElements", integer_of(ire), integer_of(icp)), problem, view)
      if (.not. associated(problem)) return
      call give(view%patch%grid%mx, mx)
      call give(view%patch%grid%my, my)
      call leave(problem)
   end subroutine cntc_getnumelements

   !> Sides of the elements: of the current grid, or as set for wheel and rail
   subroutine cntc_getgriddiscretization(ire, icp, dx, dy) bind(c, name="inside_cntc_getgriddiscretization")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(inout), optional :: dx, dy
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(result_view) :: view
      real(wp) :: length

      this = entry_type("cntc_getGridDiscretization", integer_of(ire), integer_of(icp))
      call enter(this, scope%any, problem)
      if (.not. associated(problem)) return
      length = outward(problem%units, quantity%length)
      if (this%icp < 0) then
         call give(problem%spec%wheel_rail%search%dx*length, dx)
         call give(problem%spec%wheel_rail%search%ds*length, dy)
      else
         view = look_at(this, problem)
         if (associated(view%patch)) then
            call give(view%patch%grid%dx*length, dx)
            call give(view%patch%grid%dy*length, dy)
         end if
      end if
      call leave(problem)
   end subroutine cntc_getgriddiscretization

   !> The current grid: mx, my, centre of the first element, sides of the elements
   subroutine cntc_getpotcontact(ire, icp, lenarr, rvalues) bind(c, name="inside_cntc_getpotcontact")
      integer(c_int), intent(in), optional :: ire, icp, lenarr
      real(c_double), intent(inout), optional :: rvalues(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(result_view) :: view
      real(wp) :: first_x, first_y, origin(2)

      this = entry_type("cntc_getPotContact", integer_of(ire), integer_of(icp))
      call enter_result(this, problem, view)
      if (.not. associated(problem)) return
      associate (grid => view%patch%grid, length => outward(view%units, quantity%length))
         origin = 0.0_wp
         if (problem%module_number == 1) origin = problem%wheel_rail_result%patches(this%icp)%grid_reference
         first_x = grid%x(1) + origin(1)
         first_y = grid%y(1) + origin(2)
         if (view%left) first_y = -(grid%y(grid%my) + origin(2))
         call give_list([real(grid%mx, wp), real(grid%my, wp), first_x*length, first_y*length, grid%dx*length, &
            & grid%dy*length], lenarr, rvalues)
         call give_zeros(7, lenarr, rvalues)
      end associate
      call leave(problem)
   end subroutine cntc_getpotcontact

   !> Approach, prescribed or found
   subroutine cntc_getpenetration(ire, icp, pen) bind(c, name="inside_cntc_getpenetration")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(inout), optional :: pen
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp) :: length

      this = entry_type("cntc_getPenetration", integer_of(ire), integer_of(icp))
      call enter(this, scope%one_patch, problem)
      if (.not. associated(problem)) return
      length = outward(problem%units, quantity%length)
      if (problem%module_number == 1) then
         call give(problem%wheel_rail_result%patches(this%icp)%contact%pen*length, pen)
      else
         call give(problem%stored%kinematics%pen*length, pen)
      end if
      call leave(problem)
   end subroutine cntc_getpenetration

   !> Creepages or shifts, prescribed or found
   subroutine cntc_getcreepages(ire, icp, vx, vy, phi) bind(c, name="inside_cntc_getcreepages")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(inout), optional :: vx, vy, phi
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp) :: creep(3)
      type(quantity_type) :: of_creep, of_spin
      logical :: left

      this = entry_type("cntc_getCreepages", integer_of(ire), integer_of(icp))
      call enter(this, scope%one_patch, problem)
      if (.not. associated(problem)) return
      creep = [problem%stored%kinematics%cksi, problem%stored%kinematics%ceta, problem%stored%kinematics%cphi]
      left = .false.
      if (problem%module_number == 1) then
         left = problem%spec%wheel_rail%left
         associate (patch => problem%wheel_rail_result%patches(this%icp)%contact)
            creep = [patch%cksi, patch%ceta, patch%cphi]
         end associate
      end if
      of_creep = quantity%number
      of_spin = quantity%spin
      if (problem%motion() == motion%shift) then
         of_creep = quantity%length
         of_spin = quantity%angle
      end if
      call give(creep(1)*outward(problem%units, of_creep, orientation%along, left), vx)
      call give(creep(2)*outward(problem%units, of_creep, orientation%across, left), vy)
      call give(creep(3)*outward(problem%units, of_spin, orientation%across, left), phi)
      call leave(problem)
   end subroutine cntc_getcreepages

   !> Normal force, tangential forces, moment about the normal, without damping
   subroutine cntc_getcontactforces(ire, icp, fn, tx, ty, mz) bind(c, name="inside_cntc_getcontactforces")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(inout), optional :: fn, tx, ty, mz
      type(library_problem), pointer :: problem
      type(result_view) :: view
      real(wp) :: values(4)

      call enter_result(entry_type("cntc_getContactForces", integer_of(ire), integer_of(icp)), problem, view)
      if (.not. associated(problem)) return
      values = view%totals(["fn", "fx", "fy", "mz"])
      call give(values(1), fn)
      call give(values(2), tx)
      call give(values(3), ty)
      call give(values(4), mz)
      call leave(problem)
   end subroutine cntc_getcontactforces

   !> Areas of contact, adhesion and slip
   subroutine cntc_getcontactpatchareas(ire, icp, carea, harea, sarea) bind(c, name="inside_cntc_getcontactpatchareas")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(inout), optional :: carea, harea, sarea
      type(library_problem), pointer :: problem
      type(result_view) :: view
      real(wp) :: area

      call enter_result(entry_type("cntc_getContactPatchAreas", integer_of(ire), integer_of(icp)), problem, view)
      if (.not. associated(problem)) return
      associate (patch => view%patch)
         area = patch%grid%dx*patch%grid%dy*outward(view%units, quantity%area)
         call give(patch%ncon*area, carea)
         call give(patch%nadh*area, harea)
         call give(patch%nslip*area, sarea)
      end associate
      call leave(problem)
   end subroutine cntc_getcontactpatchareas

   !> Sensitivities: rows Fn, Fx, Fy, Mz, columns approach, creepages, spin; the first four by four entries
   subroutine cntc_getsensitivities(ire, icp, lenout, lenin, sens) bind(c, name="inside_cntc_getsensitivities")
      integer(c_int), intent(in), optional :: ire, icp, lenout, lenin
      real(c_double), intent(inout), optional :: sens(*)
      type(library_problem), pointer :: problem
      type(result_view) :: view
      real(wp) :: per_input(4), per_output(4), side
      integer :: i, j, rows

      call enter_result(entry_type("cntc_getSensitivities", integer_of(ire), integer_of(icp)), problem, view)
      if (.not. associated(problem)) return
      rows = max(0, integer_of(lenout))
      if (present(sens)) then
         associate (units => problem%units)
            side = merge(-1.0_wp, 1.0_wp, view%left)
            per_input = [inward(units, quantity%length), 1.0_wp, side, side*inward(units, quantity%spin)]
            if (problem%motion() == motion%shift) per_input(2:4) = [1.0_wp, side, 0.0_wp]*inward(units, quantity%length) &
               & + [0.0_wp, 0.0_wp, side*inward(units, quantity%angle)]
            per_output = [inward(units, quantity%force), 1.0_wp, side, side*inward(units, quantity%moment)]
         end associate
         do j = 1, min(4, integer_of(lenin))
            do i = 1, min(4, rows)
               sens((j - 1)*rows + i) = view%patch%sensitivity(i, j)*per_input(j)/per_output(i)
            end do
         end do
      end if
      call leave(problem)
   end subroutine cntc_getsensitivities

   !> Processor and elapsed time of calculations since the last reset
   subroutine cntc_getcalculationtime(ire, icp, tcpu, twall) bind(c, name="inside_cntc_getcalculationtime")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(inout), optional :: tcpu, twall
      type(library_problem), pointer :: problem
      type(entry_type) :: this

      this = entry_type("cntc_getCalculationTime", integer_of(ire), integer_of(icp))
      call enter(this, scope%one_patch, problem)
      if (.not. associated(problem)) return
      if (problem%module_number == 1) then
         call give(problem%patch_cpu(this%icp), tcpu)
         call give(problem%patch_wall(this%icp), twall)
      else
         call give(problem%watch%cpu, tcpu)
         call give(problem%watch%wall, twall)
      end if
      call leave(problem)
   end subroutine cntc_getcalculationtime

   !> Count the time of calculations from zero again
   subroutine cntc_resetcalculationtime(ire, icp) bind(c, name="inside_cntc_resetcalculationtime")
      integer(c_int), intent(in), optional :: ire, icp
      type(library_problem), pointer :: problem
      type(entry_type) :: this

      this = entry_type("cntc_resetCalculationTime", integer_of(ire), integer_of(icp))
      call enter(this, scope%one_patch, problem)
      if (.not. associated(problem)) return
      if (problem%module_number == 1) then
         problem%patch_cpu(this%icp) = 0.0_wp
         problem%patch_wall(this%icp) = 0.0_wp
      else
         problem%watch%cpu = 0.0_wp
         problem%watch%wall = 0.0_wp
      end if
      call leave(problem)
   end subroutine cntc_resetcalculationtime
end module contact_capi_results
