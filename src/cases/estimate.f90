!> Estimated cost of a case before it starts: elements, memory, time on one thread
!>
!> Times are rough: those of published and own examples on 11 x 11 to 610 x 610 elements, with the build of 2026-11-27, on the
!> machine whose speed is the unit of contact_cases_machine_pace. The first case on a grid takes up to twice the time, later ones of
!> a sequence a half to a quarter. Subsurface stresses are included in the memory only. Times of prescribed accuracies:
!> contact_cases_accuracy_time.
module contact_cases_estimate
   use contact_base_choices, only : force_control, is_simplified, material_model, motion, normal_control, pressure_model, &
      & solver_choice
   use contact_base_kinds, only : long, wp
   use contact_base_memory, only : bytes_per_element
   use contact_cases_accuracy_grid, only : first_counts, no_direction
   use contact_cases_accuracy_plan, only : accuracy_law, contact_sides, expected_across, expected_law, most_elements
   use contact_cases_accuracy_time, only : constant_time, has_outer_iterations, reading_time, time_per_element
   use contact_cases_approximate_methods, only : approximate_method, choose_method
   use contact_cases_spec, only : case_spec
   use contact_cases_subsurface, only : stress_memory
   use contact_elastic_material, only : combine, combined_material
   use contact_grid_potential_contact, only : potential_contact
   use contact_friction_new_law, only : is_varying_law
   implicit none (type, external)
   private

   public :: case_cost, cost_text, estimate_cost, typical_half_side, usual_margin

   !> Cost of a case
   type :: case_cost
      !> Number of elements of the potential contact area; of one patch in wheel-rail contact
      integer(long) :: elements = 0
      !> Is that number only an upper bound?
      logical :: at_most = .false.
      !> Are there more elements than NPOT_MAX? In shifts and transient rolling elements are fixed to the rail and are not enlarged
      logical :: beyond_most = .false.
      !> Memory [bytes] and processor time [s]
      real(wp) :: bytes = 0.0_wp, seconds = 0.0_wp
      !> Where the cost of an accuracy is from, blank if not to be told
      character(len=120) :: source = ""
      !> Why a run refuses the case; unallocated if it does not, or if that was not examined
      character(len=:), allocatable :: refusal
   end type case_cost

   !> Constant time of a case, and of a search for its patches [s]
   real(wp), parameter :: every_case = 1.0e-4_wp, every_search = 8.0e-4_wp
   !> Time per element [s]: pressures; tractions in shifts and transient rolling; in steady rolling
   real(wp), parameter :: pressures = 6.0e-7_wp, by_step = 1.0e-6_wp, steadily = 1.5e-6_wp
   !> Time per element to the power 1.5 [s]: ConvexGS; SteadyGS and GDsteady
   real(wp), parameter :: by_convex_gs = 3.6e-7_wp, by_steady_gs = 2.2e-7_wp
   !> Factors of the time: friction that varies with slip; bodies that relax, with their outer iterations (18 runs on 20 to 80
   !> elements along each side, kind viscoelastic of tests/accuracy, seed 98122); trials for a prescribed force beyond the first;
   !> outer iterations, of which later ones take little
   real(wp), parameter :: changing_friction = 1.7_wp, remembering = 2.8_wp, trials = 2.0_wp
   integer, parameter :: turns = 2
   !> Multiple of NPOT_MAX that is refused if elements are not enlarged; see check_size of contact_wheelrail_patch_inputs
   integer(long), parameter :: hopeless = 10_long
   !> Ratio of the number of elements of the last grid of a case with an accuracy to that of the expected one, since some contacts
   !> need a finer one
   real(wp), parameter :: more_elements = 1.05_wp
   !> Simplified methods: time per element of pressures and of one march of the tractions [s]; number of marches that determine
   !> creepages for forces
   real(wp), parameter :: simplified = 1.5e-7_wp, marches = 20.0_wp
   !> Typical radius of curvature in wheel-rail contact [mm], and the side of the grid relative to the contact
   real(wp), parameter :: typical_radius = 400.0_wp, usual_margin = 1.25_wp

contains

   !> Estimate the cost from the specification alone
   subroutine estimate_cost(spec, cost)
      type(case_spec), intent(in) :: spec
      !> Cost: elements, seconds and bytes
      type(case_cost), intent(out) :: cost
      type(potential_contact) :: grid
      type(combined_material) :: material
      real(wp) :: n, normal, tangential

      cost%seconds = every_case
      if (.not. spec%solve) return
      if (spec%iteration%accuracy > 0.0_wp) then
         call estimate_accurate(spec, cost)
         return
      end if
      if (allocated(spec%wheel_rail)) then
         call guess_patch(spec, cost)
      else
         cost%elements = int(spec%grid%mx, long)*int(spec%grid%my, long)
      end if
      n = real(cost%elements, wp)
      grid%mx = nint(sqrt(n))
      grid%my = grid%mx
      if (.not. allocated(spec%wheel_rail)) then
         grid%mx = spec%grid%mx
         grid%my = spec%grid%my
      end if
      cost%bytes = n*bytes_per_element + real(stress_memory(spec, grid), wp)
      tangential = 0.0_wp
      normal = pressures*n
      if (.not. any(spec%pressure == [pressure_model%full, pressure_model%thin_sheet])) normal = simplified*n
      select case (spec%motion)
      case (motion%none)
         continue
      case (motion%steady_rolling)
         tangential = steadily*n
         if (spec%classical .and. (spec%solver == solver_choice%gauss_seidel .or. spec%solver == solver_choice%gd_steady)) &
            & tangential = by_steady_gs*n**1.5_wp
      case default
         tangential = by_step*n
      end select
      if (spec%classical .and. spec%solver == solver_choice%convex_gs .and. spec%motion /= motion%none) &
         & tangential = by_convex_gs*n**1.5_wp
      if (is_varying_law(spec%friction_law)) tangential = changing_friction*tangential
      if (spec%material_model == material_model%viscoelastic) tangential = remembering*tangential
      if (is_simplified(spec%material_model) .and. spec%motion /= motion%none) tangential = simplified*n
      if (has_outer_iterations(spec)) then
         tangential = tangential*min(spec%iteration%maxout, turns)
         cost%seconds = cost%seconds + normal*(min(spec%iteration%maxout, turns) - 1)
      end if
      cost%seconds = cost%seconds + reading_time(spec) + normal + tangential
      if (.not. allocated(spec%wheel_rail)) return
      cost%seconds = cost%seconds + every_search
      if (.not. (spec%normal == normal_control%force .or. spec%force /= force_control%creepages)) return
      cost%seconds = cost%seconds + trials*normal
      ! tractions change the pressures of unlike bodies: every trial computes them
      material = combine(spec%material%poiss, spec%material%gg)
      if (material%coupled()) cost%seconds = cost%seconds + trials*tangential
   end subroutine estimate_cost

   !> A case with an accuracy, by the general errors of its kind of contact: single contacts take half or twice the time
   subroutine estimate_accurate(spec, cost)
      type(case_spec), intent(in) :: spec
      type(case_cost), intent(inout) :: cost
      type(potential_contact) :: grid
      type(approximate_method) :: chosen
      type(accuracy_law) :: law
      real(wp) :: n, most, sides(2), lengths(2)
      integer :: counts(2)

      if (spec%iteration%allows_approximate) call choose_method(spec, chosen)
      if (chosen%found) then
         cost%elements = int(chosen%method%elements, long)**2
         cost%bytes = real(cost%elements, wp)*bytes_per_element
         cost%seconds = every_case + simplified*real(cost%elements, wp)
         if (spec%force /= force_control%creepages .and. spec%motion /= motion%none) cost%seconds = cost%seconds + &
            & marches*simplified*real(cost%elements, wp)
         return
      end if
      law = expected_law(spec)
      if (allocated(spec%wheel_rail)) then
         n = (usual_margin*expected_across(law, spec%iteration%accuracy))**2
      else
         call contact_sides(spec, sides)
         call first_counts(spec%grid, expected_across(law, spec%iteration%accuracy), sides, lengths, counts)
         n = product(real(min(counts, merge([spec%grid%mx, spec%grid%my], counts, &
            & [spec%grid%mx, spec%grid%my] <= no_direction)), wp))
      end if
      n = more_elements*n
      most = most_elements(spec%limits)
      if (allocated(spec%wheel_rail)) most = min(most, real(spec%iteration%npot_max, wp))
      cost%at_most = n > most
      n = min(n, most)
      cost%elements = nint(n, long)
      grid%mx = nint(sqrt(n))
      grid%my = grid%mx
      cost%bytes = n*bytes_per_element + real(stress_memory(spec, grid), wp)
      cost%seconds = constant_time(spec) + time_per_element(spec)*n
   end subroutine estimate_accurate

   !> Number of elements of a patch of wheel-rail contact, by Hertz for a ball; the maximum allowed number if no force is prescribed
   subroutine guess_patch(spec, cost)
      type(case_spec), intent(in) :: spec
      type(case_cost), intent(inout) :: cost
      real(wp) :: a, n

      cost%elements = spec%iteration%npot_max
      cost%at_most = .true.
      if (spec%motion == motion%shift .or. spec%motion == motion%transient_rolling) &
         & cost%elements = hopeless*int(spec%iteration%npot_max, long)
      if (spec%normal /= normal_control%force) return
      a = typical_half_side(spec, spec%wheel_rail%wheelset%fz)
      n = (2.0_wp*usual_margin*a)**2/(spec%wheel_rail%search%dx*spec%wheel_rail%search%ds)
      cost%beyond_most = cost%elements > spec%iteration%npot_max .and. n > real(spec%iteration%npot_max, wp)
      if (n >= real(cost%elements, wp)) return
      cost%elements = nint(n, long)
      cost%at_most = .false.
   end subroutine guess_patch

   !> Typical half side of the contact of a wheel, by Hertz for a ball [mm]
   pure real(wp) function typical_half_side(spec, fz) result(a)
      !> Case, with its materials
      type(case_spec), intent(in) :: spec
      !> Vertical force [N]
      real(wp), intent(in) :: fz
      type(combined_material) :: material

      material = combine(spec%material%poiss, spec%material%gg)
      a = (0.75_wp*max(0.0_wp, fz)*typical_radius*(1.0_wp - material%nu)/material%gg)**(1.0_wp/3.0_wp)
   end function typical_half_side

   !> A cost in words, padded with blanks
   pure function cost_text(cost, pace) result(text)
      !> Cost: elements, seconds and bytes
      type(case_cost), intent(in) :: cost
      !> Time of a computation on this machine over that on the machine of the tables
      real(wp), intent(in) :: pace
      character(len=240) :: text
      character(len=12) :: memory, time
      real(wp) :: seconds

      seconds = pace*cost%seconds
      write(memory, "(I0)") int(cost%bytes/1.0e6_wp, long) + 1_long
      write(time, "(ES9.0)") seconds
      if (seconds < 1.0e6_wp) write(time, "(F9.3)") seconds
      if (seconds < 0.01_wp) write(time, "(F9.5)") seconds
      if (seconds >= 1.0_wp .and. seconds < 1.0e6_wp) write(time, "(I0)") nint(seconds)
      write(text, "(2A, I0, 5A)") trim(merge("at most", "about  ", cost%at_most)), " ", cost%elements, " elements, ", &
         & trim(memory), " MB, ", trim(adjustl(time)), " s"
      if (cost%source /= "") text = trim(text) // ", " // cost%source
      if (cost%beyond_most) text = trim(text) // ": more elements than NPOT_MAX, which are not enlarged in shifts and transient &
         &rolling; larger DX and DS make it quick"
   end function cost_text
end module contact_cases_estimate
