!> Results of one patch for callers: totals, and the settings used in the solution
module contact_capi_results
   use, intrinsic :: iso_c_binding, only : c_double
   use contact_base_choices, only : motion
   use contact_base_kinds, only : long, wp
   use contact_capi_caller, only : caller
   use contact_capi_messages, only : report_error
   use contact_capi_problem, only : library_problem
   use contact_capi_view, only : look_at, result_view
   use contact_cases_spec, only : case_spec
   use contact_control_units, only : inward, orientation, outward, quantity, quantity_type
   use contact_elastic_material, only : combine, combined_material
   use contact_patch_result, only : patch_result
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: get_approach, get_creepages, get_element_sides, get_grid, get_hertz, get_parameters, get_sensitivities, get_time
   public :: kinematic_constants, reset_time

contains

   !> Kinematic constants (1), material constants (2), friction law (3), nominal radii (4)
   subroutine get_parameters(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), intent(in) :: problem

      select case (a%single(1))
      case (1); call a%set_result(1, kinematic_constants(problem, a%call_of%icp))
      case (2); call a%set_result(1, material_constants(problem, a%call_of%icp))
      case (3); call a%set_result(1, friction_constants(problem%spec))
      case (4); call a%set_result(1, problem%bodies%radii*outward(problem%units, quantity%length))
      case default; call report_error(a%call_of, "there is no task " // integer_text(a%single(1)) // "; 1, 2, 3 and 4 are")
      end select
   end subroutine get_parameters

   !> V, chi, dq, spinxo, spinyo, tau_c0
   function kinematic_constants(problem, icp) result(list)
      type(library_problem), intent(in) :: problem
      !> Index of the patch of module 1
      integer, intent(in) :: icp
      real(wp) :: list(6)

      associate (units => problem%units, rolling => problem%stored%acting, kinematics => problem%stored%kinematics)
         list(1:3) = [rolling%veloc, rolling%chi, rolling%dq]
         if (problem%module_number == 1) then
            associate (patch => problem%wheel_rail_result%patches(icp)%contact)
               list(1:3) = [patch%veloc, patch%chi, patch%dq]
            end associate
         end if
         list(4:6) = [kinematics%spinxo, kinematics%spinyo, problem%spec%material%tau_c0]
         if (problem%module_number == 1) then
            list(4:5) = problem%wheel_rail_result%patches(icp)%grid_reference
            if (problem%bodies%left) list(5) = -list(5)
         end if
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
            if (problem%module_number == 3) call get_flexibility(problem%result)
            if (problem%module_number == 1) call get_flexibility(problem%wheel_rail_result%patches(icp)%contact)
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
      subroutine get_flexibility(patch)
         type(patch_result), intent(in) :: patch

         k_eff = patch%k_eff
         if (any(patch%flx > 0.0_wp)) flx = patch%flx
      end subroutine get_flexibility
   end function material_constants

   !> L, number of points, memory; position and coefficients of each point, in internal units by contract
   pure function friction_constants(spec) result(list)
      type(case_spec), intent(in) :: spec
      real(wp), allocatable :: list(:)
      integer :: k

      associate (sets => spec%friction%sets)
         list = [real(spec%friction_law, wp), real(size(sets), wp), spec%friction%memdst, spec%friction%mem_s0, &
            & (sets(k)%position, sets(k)%fstat, sets(k)%fkin, k=1, size(sets))]
      end associate
   end function friction_constants

   !> The Hertz solution: a1, b1, aa, bb, rho, cp, scale, bneg, bpos, aob
   subroutine get_hertz(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), pointer, intent(in) :: problem
      type(result_view) :: view
      real(wp) :: list(10)

      view = look_at(a%call_of, problem)
      if (.not. associated(view%patch)) return
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
      call a%set_result(1, list)
   end subroutine get_hertz

   !> Sides of the elements: of the current grid, or as set for wheel and rail
   subroutine get_element_sides(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), pointer, intent(in) :: problem
      type(result_view) :: view

      associate (length => outward(problem%units, quantity%length))
         if (a%call_of%icp < 0) then
            call a%set_each_result([problem%spec%wheel_rail%search%dx, problem%spec%wheel_rail%search%ds]*length)
         else
            view = look_at(a%call_of, problem)
            if (associated(view%patch)) call a%set_each_result([view%patch%grid%dx, view%patch%grid%dy]*length)
         end if
      end associate
   end subroutine get_element_sides

   !> The current grid: mx, my, centre of the first element, sides of the elements
   subroutine get_grid(a, problem, view)
      type(caller), intent(in) :: a
      type(library_problem), intent(in) :: problem
      type(result_view), intent(in) :: view
      real(wp) :: first_x, first_y, origin(2)

      associate (grid => view%patch%grid, length => outward(view%units, quantity%length))
         origin = 0.0_wp
         if (problem%module_number == 1) origin = problem%wheel_rail_result%patches(a%call_of%icp)%grid_reference
         first_x = grid%x(1) + origin(1)
         first_y = grid%y(1) + origin(2)
         if (view%left) first_y = -(grid%y(grid%my) + origin(2))
         call a%set_result(1, [real(grid%mx, wp), real(grid%my, wp), first_x*length, first_y*length, &
            & grid%dx*length, grid%dy*length], fills=.true.)
      end associate
   end subroutine get_grid

   !> Approach, prescribed or computed
   subroutine get_approach(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), intent(in) :: problem
      real(wp) :: approach

      approach = problem%stored%kinematics%pen
      if (problem%module_number == 1) approach = problem%wheel_rail_result%patches(a%call_of%icp)%contact%pen
      call a%set_each_result([approach*outward(problem%units, quantity%length)])
   end subroutine get_approach

   !> Creepages or shifts, prescribed or computed
   subroutine get_creepages(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), intent(in) :: problem
      integer, parameter :: signs(3) = [orientation%along, orientation%across, orientation%across]
      type(quantity_type) :: units(3)
      real(wp) :: creep(3)
      logical :: left, is_shift

      is_shift = problem%given%values%for_shift
      creep = [problem%stored%kinematics%cksi, problem%stored%kinematics%ceta, problem%stored%kinematics%cphi]
      left = .false.
      if (problem%module_number == 1) then
         left = problem%bodies%left
         associate (patch => problem%wheel_rail_result%patches(a%call_of%icp)%contact)
            creep = [patch%cksi, patch%ceta, patch%cphi]
            is_shift = patch%motion == motion%shift
         end associate
      end if
      units = [quantity%number, quantity%number, quantity%spin]
      if (is_shift) units = [quantity%length, quantity%length, quantity%angle]
      call a%set_each_result(creep*outward(problem%units, units, signs, left))
   end subroutine get_creepages

   !> Sensitivities: rows Fn, Fx, Fy, Mz, columns approach, creepages, spin; the first four by four entries
   subroutine get_sensitivities(a, problem, view)
      type(caller), intent(in) :: a
      type(library_problem), intent(in) :: problem
      type(result_view), intent(in) :: view
      real(wp) :: per_input(4), per_output(4), side
      real(c_double), pointer :: sens(:)
      integer :: columns, i, j, rows

      rows = max(0, a%single(1))
      columns = max(0, min(4, a%single(2)))
      sens => a%numbers_at(1, int(rows, long)*columns)
      if (size(sens) == 0) return
      associate (units => problem%units)
         side = merge(-1.0_wp, 1.0_wp, view%left)
         per_input = [inward(units, quantity%length), 1.0_wp, side, side*inward(units, quantity%spin)]
         if (view%patch%motion == motion%shift) per_input(2:4) = [1.0_wp, side, 0.0_wp]*inward(units, quantity%length) &
            & + [0.0_wp, 0.0_wp, side*inward(units, quantity%angle)]
         per_output = [inward(units, quantity%force), 1.0_wp, side, side*inward(units, quantity%moment)]
      end associate
      do j = 1, columns
         do i = 1, min(4, rows)
            sens((j - 1)*rows + i) = view%patch%sensitivity(i, j)*per_input(j)/per_output(i)
         end do
      end do
   end subroutine get_sensitivities

   !> Processor and elapsed time of calculations since the last reset [s]
   subroutine get_time(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), intent(in) :: problem

      if (problem%module_number == 1) then
         call a%set_each_result([problem%patch_cpu(a%call_of%icp), problem%patch_wall(a%call_of%icp)])
      else
         call a%set_each_result([problem%watch%cpu, problem%watch%wall])
      end if
   end subroutine get_time

   !> Reset the time of calculations to zero
   subroutine reset_time(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), intent(inout) :: problem

      if (problem%module_number == 1) then
         problem%patch_cpu(a%call_of%icp) = 0.0_wp
         problem%patch_wall(a%call_of%icp) = 0.0_wp
      else
         problem%watch%cpu = 0.0_wp
         problem%watch%wall = 0.0_wp
      end if
   end subroutine reset_time
end module contact_capi_results
