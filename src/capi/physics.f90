!> Settings of both modules: solvers, materials, temperatures, friction, rolling
module contact_capi_physics
   use contact_base_choices, only : material_model, pressure_model, variation
   use contact_base_kinds, only : wp
   use contact_capi_messages, only : fits, warn
   use contact_capi_problem, only : library_problem
   use contact_capi_caller, only : caller, min_value
   use contact_cases_inputs, only : visit_damping, visit_elastic, visit_friction_memory, visit_friction_set, visit_heat, &
      & visit_iteration, visit_material_model, visit_sheet, visit_wear
   use contact_cases_spec, only : damping_spec, friction_set, friction_spec, heat_spec, iteration_spec, material_spec, wear_spec
   use contact_control_digits, only : choice_of, digit_of
   use contact_friction_new_law, only : friction_model, is_friction_law
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: set_friction, set_heat, set_materials, set_rolling_step, set_solver, set_tangential_forces, set_time_step, set_wear

   !> Prescribed tangential forces are limited to this fraction of the friction bound, because the bound itself is reached at
   !> infinite creepage only
   real(wp), parameter :: largest_force = 1.0_wp - 1.0e-4_wp
   !> Methods: keep existing values; sensitivities among the solvers; damping among the materials: none, kept, given; Polach's
   !> friction law
   integer, parameter :: keep = 1, sensitivities = 6, no_damping = 10, damping_kept = 11, damping_given = 12, polach = 5

contains

   !> Set iteration limits and solver (G)
   subroutine set_solver(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem
      type(iteration_spec), target :: iteration

      associate (method => a%single(1), module_number => problem%module_number)
         if (method == sensitivities) problem%setting%group = "sensitivities"
         if (method < 0 .or. method > 6) call a%refuse_call("solver method " // integer_text(method) // &
            & " is outside its range 0 to 6")
         iteration = problem%spec%iteration
         do while (a%next_pass())
            if (method == sensitivities) then
               call a%integer("MXSENS", iteration%mxsens)
               call a%real("EPSENS", iteration%epsens)
               call a%end_line()
            else if (method /= keep) then
               call visit_iteration(a, iteration, choice_of("G", method, module_number), with_elements=.false.)
            end if
         end do
         if (.not. a%is_good) return
         problem%spec%iteration = iteration
         if (method == sensitivities) return
         problem%digits%g = method
         if (method /= keep) problem%spec%solver = choice_of("G", method, module_number)
      end associate
   end subroutine set_solver

   !> Set materials (M), or damping forces (M2, 10 higher)
   subroutine set_materials(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem
      type(damping_spec) :: damping
      type(material_spec) :: material
      integer :: model

      associate (method => a%single(1), spec => problem%spec)
         if (method >= no_damping) problem%setting%group = "damping"
         if (method < 0 .or. method > damping_given .or. method == 8 .or. method == 9) call a%refuse_call( &
            & "there is no material method " // integer_text(method))
         material = spec%material
         model = choice_of("M", method, problem%module_number)
         do while (a%next_pass())
            if (method == damping_given) then
               call visit_damping(a, damping)
            else if (method >= no_damping) then
               call a%skip(optional=.true.)
            else
               call visit_elastic(a, material)
               call visit_material_model(a, model, material)
               a%may_miss = .true.
               if (problem%digits%b == digit_of("B", pressure_model%thin_sheet, problem%module_number)) &
                  & call visit_sheet(a, material)
               a%may_miss = .false.
            end if
         end do
         if (.not. a%is_good) return
         if (method < no_damping) then
            problem%digits%m = method
            spec%material_model = model
            spec%material = material
            call set_outer_iteration(model, material, spec%iteration)
            return
         end if
         problem%digits%m2 = method - no_damping
         if (method /= damping_kept) spec%damping = damping
         spec%has_damping = method == damping_given
         if (method == damping_kept) spec%has_damping = any([spec%damping%cdampn, spec%damping%cdampt] > 0.0_wp)
      end associate
   end subroutine set_materials

   !> Use an outer iteration for dissimilar bodies
   pure subroutine set_outer_iteration(model, material, iteration)
      !> Member of material_model
      integer, intent(in) :: model
      type(material_spec), intent(in) :: material
      type(iteration_spec), intent(inout) :: iteration

      if (iteration%maxout <= 1 .and. material%are_unlike(model)) iteration%maxout = 10
   end subroutine set_outer_iteration

   !> Set surface temperatures (H)
   subroutine set_heat(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem
      type(heat_spec) :: heat

      associate (method => a%single(1))
         if (all(method /= [0, 1, 3])) call a%refuse_call("there is no temperature method " // integer_text(method) // &
            & "; 0, 1 and 3 are")
         heat = problem%spec%heat
         do while (a%next_pass())
            if (method == 3) then
               call visit_heat(a, heat, with_plastic_work=.true.)
            else
               call a%skip(optional=.true.)
            end if
         end do
         if (.not. a%is_good) return
         problem%digits%h = method
         problem%spec%heat = heat
      end associate
   end subroutine set_heat

   !> Set numbers for wear and fatigue, which also requests their computation
   subroutine set_wear(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem
      type(wear_spec), target :: wear

      do while (a%next_pass())
         call visit_wear(a, wear)
      end do
      if (.not. a%is_good) return
      problem%spec%wear = wear
      problem%spec%has_wear = .true.
   end subroutine set_wear

   !> Set the time step, which is not used: it follows from step and velocity
   subroutine set_time_step(a)
      type(caller), intent(inout) :: a

      if (fits(a%call_of, "TC", a%numbers(1)%v, "dt")) call warn(a%call_of, &
         & "a time step has no effect: shifts have 1 s, rolling the step over the velocity")
   end subroutine set_time_step

   !> Set rolling direction and step; for wheel and rail the step is relative to the element size
   subroutine set_rolling_step(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout), target :: problem

      if (problem%module_number == 1) then
         a%numbers(1)%v => a%numbers(1)%v(2:)
         associate (search => problem%spec%wheel_rail%search)
            call a%real("DQREL", search%dqrel)
            call a%end_line()
            if (a%is_good .and. problem%digits%d == 1) problem%digits%d = digit_of("D", search%location, 1)
         end associate
      else
         associate (rolling => problem%stored%rolling)
            call a%real("CHI", rolling%chi)
            call a%real("DQ", rolling%dq)
            call a%end_line()
            if (.not. a%is_good) return
            problem%stored%acting%chi = rolling%chi
            problem%stored%acting%dq = rolling%dq
         end associate
      end if
   end subroutine set_rolling_step

   !> Set the friction law (L) and its variation (V, 10 each)
   subroutine set_friction(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem
      type(friction_spec) :: friction
      integer :: method, digit, law, varies, n, k
      logical :: is_known_law

      method = max(-1, a%single(1))
      digit = mod(method, 10)
      is_known_law = is_friction_law(choice_of("L", digit, problem%module_number))
      if (method < 0 .or. method > 29 .or. .not. (is_known_law .or. digit == keep .or. digit == polach)) then
         call a%refuse_call("there is no friction method " // integer_text(method))
      else if (method >= 10 .and. problem%module_number /= 1) then
         call a%refuse_call("friction that varies over the rail belongs to wheel and rail, method " // integer_text(method))
      end if
      n = 1
      if (digit == keep) n = 0
      varies = choice_of("V", max(0, method/10), problem%module_number)
      if (varies /= variation%none .and. n > 0) n = number_of_points(a)
      law = choice_of("L", merge(4, digit, digit == polach), problem%module_number)
      friction%memdst = problem%spec%friction%memdst
      friction%mem_s0 = problem%spec%friction%mem_s0
      ! a number of points without values must not allocate memory; at least one set is allocated to find missing values
      allocate(friction%sets(min(n, max(1, size(a%numbers(1)%v)))))
      friction%sets = friction_set(sabsh1=10000.0_wp, sabsh2=10000.0_wp)
      do while (a%next_pass())
         if (varies /= variation%none .and. digit /= keep) call a%skip(optional=.false.)
         do k = 1, n
            if (digit == polach) then
               call visit_polach(a, varies, friction, min(k, size(friction%sets)))
            else
               call visit_friction_set(a, law, varies, friction%sets(min(k, size(friction%sets))))
               call visit_friction_memory(a, law, friction)
            end if
            if (.not. (a%is_good .and. a%is_reading)) cycle
            associate (set => friction%sets(k), previous => friction%sets(max(1, k - 1)))
               if (law == friction_model%temperature) then
                  set%dfheat = max(min_value("FREF") - set%fref, set%dfheat)
                  set%fkin = set%fref + set%dfheat
               end if
               if (k > 1 .and. .not. set%position > previous%position) call a%refuse_call( &
                  & "the positions of friction data must increase; nothing is stored")
            end associate
         end do
      end do
      if (.not. a%is_good) return
      problem%digits%l = merge(4, digit, digit == polach)
      if (digit == keep) return
      problem%digits%v = method/10
      problem%spec%variation = varies
      problem%spec%friction_law = law
      problem%spec%friction = friction
   end subroutine set_friction

   !> Number of points of variable friction, the first value given by the caller
   pure integer function number_of_points(a) result(n)
      type(caller), intent(in) :: a

      n = 0
      associate (values => a%numbers(1)%v)
         if (size(values) == 0) return
         if (abs(values(1)) < 1.0e6_wp) n = max(0, nint(values(1)))
      end associate
   end function number_of_points

   !> Read Polach's law: exponential decay from fstat to A fstat, halved at ln 2/B
   subroutine visit_polach(a, varies, friction, k)
      type(caller), intent(inout) :: a
      !> Member of variation
      integer, intent(in) :: varies
      type(friction_spec), intent(inout), target :: friction
      !> Index of the point
      integer, intent(in) :: k
      real(wp), target :: ratio, decay

      associate (set => friction%sets(k))
         if (varies == variation%by_angle) call a%real("ALPHA", set%position)
         if (varies == variation%by_position) call a%real("SVF", set%position)
         call a%real("FSTAT", set%fstat)
         call a%real("POLACH_A", ratio)
         call a%real("POLACH_B", decay)
         call a%end_line()
         if (.not. (a%is_good .and. a%is_reading)) return
         set%fkin = ratio*set%fstat
         set%coef1 = set%fstat - set%fkin
         set%sabsh1 = max(min_value("SABSH1"), log(2.0_wp)/max(tiny(1.0_wp), decay))
         friction%memdst = 0.001_wp
         friction%mem_s0 = 10.0_wp
      end associate
   end subroutine visit_polach

   !> Set prescribed tangential forces: relative ones (module 3), or the longitudinal force on the rail (module 1)
   subroutine set_tangential_forces(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout), target :: problem
      real(wp) :: shorter

      associate (force => a%numbers(1)%v, kinematics => problem%stored%kinematics)
         if (problem%module_number == 1) then
            call a%real("FX_WS", problem%stored%wheelset%fx)
            call a%end_line()
         ! forces beyond the friction bound are reduced to it, so the bounds of FX are too narrow here
         else if (fits(a%call_of, "CKSI CETA", force, "FX FY")) then
            shorter = max(1.0_wp, hypot(force(1), force(2))/largest_force)
            kinematics%fx = force(1)/shorter
            kinematics%fy = force(2)/shorter
         end if
      end associate
   end subroutine set_tangential_forces
end module contact_capi_physics
