!> Settings of the geometry and the motion of contact problems (module 3)
module contact_capi_contact
   use contact_base_choices, only : grid_form, slip_source
   use contact_base_kinds, only : wp
   use contact_capi_arguments, only : raised
   use contact_capi_messages, only : fits, is_heard, log_message
   use contact_capi_motion, only : creepages_of, follow_digits
   use contact_capi_problem, only : library_problem
   use contact_capi_caller, only : caller
   use contact_cases_grid_inputs, only : largest_grid, visit_grid
   use contact_cases_rail_inputs, only : visit_search
   use contact_cases_spec, only : geometry_spec, grid_spec
   use contact_control_units, only : inward, quantity
   use contact_text_words, only : integer_text
   use contact_wheelrail_spec, only : search_spec
   use contact_cases_distance, only : distance_form, is_distance_form, list_forms, visit_distance
   implicit none (type, external)
   private

   public :: set_creepages, set_extra_slip, set_grid, set_hertz, set_normal, set_undeformed_distance, set_velocity

   !> Minimum velocity; a body at rest is treated as moving with it [mm/s]
   real(wp), parameter :: min_velocity = 1.0e-9_wp

contains

   !> Set the potential contact area; in module 1 contact search and discretisation
   subroutine set_grid(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem

      if (problem%module_number == 1) then
         call set_search(a, problem)
      else
         call set_window(a, "option " // integer_text(a%single(1)) // " for the potential contact; 1 to 4 are", 1, 4, problem)
      end if
   end subroutine set_grid

   !> Set the contact search of wheel and rail
   subroutine set_search(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem
      type(search_spec), target :: search

      associate (option => a%single(1))
         if (option /= 0 .and. option /= -1) call a%refuse_call("there is no discretisation method " // integer_text(option) // &
            & " for wheel and rail; 0 and -1 are")
         search = problem%spec%wheel_rail%search
         if (option == -1) search%g_miss = -1.0_wp
         do while (a%next_pass())
            if (option == 0) then
               call a%real("DX", search%dx)
               call a%real("DS", search%ds)
               call a%end_line()
               call a%skip(optional=.false.)
            else
               call visit_search(a, search, with_step=.false.)
            end if
         end do
         if (.not. a%is_good) return
         if (option == -1) then
            search%d_comb = max(0.0_wp, search%d_comb)
            if (a%was_given("D_TURN")) search%d_turn = max(0.0_wp, search%d_turn)
         end if
         problem%spec%wheel_rail%search = search
      end associate
   end subroutine set_search

   !> Set the grid of a contact problem
   subroutine set_window(a, unknown, lowest, highest, problem)
      type(caller), intent(inout) :: a
      !> Message for an unknown option, with the known ones
      character(len=*), intent(in) :: unknown
      !> Range of IPOTCN
      integer, intent(in) :: lowest, highest
      type(library_problem), intent(inout) :: problem
      type(grid_spec) :: grid

      ! both routines for the potential contact belong to the same setting
      problem%setting%group = "potential contact"
      grid%form = a%single(1)
      if (grid%form < lowest .or. grid%form > highest) call a%refuse_call("there is no " // unknown)
      do while (a%next_pass())
         call visit_grid(a, grid)
      end do
      if (.not. a%is_good) return
      problem%spec%grid = grid
      ! a Hertzian geometry replaces an undeformed distance that was refused
      if (grid%brings_geometry()) problem%setting%group = "potential contact|cntc_setUndeformedDistc"
      if (grid%form == grid_form%hertz_line_curvature .or. grid%form == grid_form%hertz_line) problem%digits%b = 2
   end subroutine set_window

   !> Set a Hertzian geometry
   subroutine set_hertz(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem

      a%single(1) = max(-99, a%single(1))
      call set_window(a, "Hertzian option " // integer_text(a%single(1)) // "; -6 to -1 are", -6, -1, problem)
   end subroutine set_hertz

   !> Set the undeformed distance
   subroutine set_undeformed_distance(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem
      type(geometry_spec) :: geometry
      character(len=:), allocatable :: forms

      geometry%form = a%single(1)
      if (geometry%form == distance_form%profile) allocate(geometry%profile(number_of_heights(a)))
      if (.not. is_distance_form(geometry%form)) then
         call list_forms(", ", forms)
         call a%refuse_call("there is no form " // integer_text(geometry%form) // " of the undeformed distance; " // &
            & forms // " are")
      end if
      do while (a%next_pass())
         call visit_distance(a, geometry, problem%spec%grid%mx*problem%spec%grid%my)
      end do
      geometry%h_grid = [problem%spec%grid%mx, problem%spec%grid%my]
      if (a%is_good) problem%spec%geometry = geometry
   end subroutine set_undeformed_distance

   !> Number of heights of a profile, from the first value of the caller; 2 if that value cannot be a number of heights
   pure integer function number_of_heights(a) result(n)
      type(caller), intent(in) :: a

      n = 2
      associate (values => a%numbers(1)%v)
         if (size(values) == 0) return
         if (values(1) >= 2.0_wp .and. values(1) < largest_grid) n = nint(values(1))
      end associate
   end function number_of_heights

   !> Set a prescribed approach or force, which determines N
   subroutine set_normal(a, name, value, n, digit)
      type(caller), intent(inout) :: a
      !> Name as in the table of bounds
      character(len=*), intent(in) :: name
      !> Variable of the problem
      real(wp), intent(inout), target :: value
      !> N-digit of the problem
      integer, intent(inout) :: n
      !> New value of the N-digit
      integer, intent(in) :: digit

      call a%real(name, value)
      call a%end_line()
      if (a%is_good) n = digit
   end subroutine set_normal

   !> Set creepages and spin; in shifts displacements and a rotation
   subroutine set_creepages(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem

      associate (numbers => a%numbers(1)%v(:3))
         if (.not. fits(a%call_of, "CKSI CETA CPHI", creepages_of(problem, numbers, problem%units))) return
         problem%given%numbers = numbers
         problem%given%units = problem%units
         problem%given%values%is_new = .true.
         call follow_digits(problem)
      end associate
   end subroutine set_creepages

   !> Set the extra term of the rigid slip, one value per element; missing values are zero
   subroutine set_extra_slip(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem
      real(wp), allocatable :: slip(:, :)
      integer :: n, k, given

      if (.not. fits(a%call_of, "EXRHS", [a%numbers(1)%v, a%numbers(2)%v])) return
      n = problem%spec%grid%mx*problem%spec%grid%my
      allocate(slip(2, n), source=0.0_wp)
      do k = 1, 2
         given = min(n, size(a%numbers(k)%v))
         slip(k, :given) = a%numbers(k)%v(:given)
      end do
      call move_alloc(slip, problem%spec%extra_slip)
      problem%spec%slip_grid = [problem%spec%grid%mx, problem%spec%grid%my]
      problem%digits%e = 1
      problem%spec%slip_source = slip_source%given
      problem%given%slip%is_new = .true.
      call follow_digits(problem)
      if (is_heard(2)) call log_message(2, a%call_of, integer_text(given) // " values for " // integer_text(n) // " elements")
   end subroutine set_extra_slip

   !> Set the rolling velocity
   subroutine set_velocity(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem

      ! by the published interface, the velocity has no sign
      associate (value => raised(abs(a%numbers(1)%v)*inward(problem%units, quantity%velocity), min_velocity))
         if (.not. fits(a%call_of, "VELOC", value)) return
         problem%stored%rolling%veloc = value(1)
         problem%stored%acting%veloc = value(1)
      end associate
   end subroutine set_velocity
end module contact_capi_contact
