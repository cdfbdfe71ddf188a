!> Entries for track, rail and wheelset (module 1)
module contact_capi_wheel_rail_settings
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use contact_base_kinds, only : wp
   use contact_capi_arguments, only : integer_of, real_of, reals_of
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : complain, count_fits, fits, say
   use contact_capi_problem, only : library_problem
   use contact_capi_registry, only : enter, leave, scope
   use contact_capi_setter, only : new_setter, setter
   use contact_cases_rail_inputs, only : visit_deviations, visit_dimensions, visit_flexibility, visit_position, visit_springs, &
      & visit_velocity
   use contact_control_units, only : inward, quantity
   use contact_text_words, only : integer_text
   use contact_wheelrail_spec, only : rail_spec, wheelset_spec
   implicit none (type, external)
   private

   public :: cntc_setverticalforce, cntc_settrackdimensions, cntc_setwheelsetdimensions, cntc_setwheelsetposition
   public :: cntc_setwheelsetvelocity, cntc_setwheelsetflexibility

   !> What is set together
   character(len=*), parameter :: track_group = "track", deviations_group = "deviations of the rail"

contains

   !> What each routine here begins with: the problem, null when the call cannot be meant, method and values
   subroutine begin(name, ire, given_method, nparam, params, this, problem, method, v)
      character(len=*), intent(in) :: name
      integer(c_int), intent(in), optional :: ire, given_method, nparam
      real(c_double), intent(in), optional :: params(*)
      type(entry_type), intent(out) :: this
      type(library_problem), pointer, intent(out) :: problem
      integer, intent(out) :: method
      real(wp), allocatable, intent(out) :: v(:)

      this = entry_type(name, integer_of(ire))
      method = integer_of(given_method)
      v = reals_of(nparam, params)
      call enter(this, scope%wheel_rail, problem)
   end subroutine begin

   !> Prescribed vertical force on the rail (N = 1)
   subroutine cntc_setverticalforce(ire, fz) bind(c, name="inside_cntc_setverticalforce")
      integer(c_int), intent(in), optional :: ire
      real(c_double), intent(in), optional :: fz
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp) :: value

      this = entry_type("cntc_setVerticalForce", integer_of(ire))
      call enter(this, scope%wheel_rail, problem)
      if (.not. associated(problem)) return
      value = real_of(fz)*inward(problem%units, quantity%force)
      if (fits(this, "FZ", [value])) then
         problem%digits%n = 1
         problem%spec%wheel_rail%wheelset%fz = value
      end if
      call leave(problem)
   end subroutine cntc_setverticalforce

   !> Place of the rail in the track, deviations of the rail, springs of a massless rail
   subroutine cntc_settrackdimensions(ire, ztrack, nparam, params) bind(c, name="inside_cntc_settrackdimensions")
      integer(c_int), intent(in), optional :: ire, ztrack, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp), allocatable :: v(:)
      integer :: method, n

      call begin("cntc_setTrackDimensions", ire, ztrack, nparam, params, this, problem, method, v)
      if (.not. associated(problem)) return
      n = size(v)
      ! methods that set the same belong together
      if (method == 1) problem%setting%group = track_group
      if (method == 2) problem%setting%group = deviations_group
      if (method == 3) problem%setting%group = track_group // "|" // deviations_group
      if (method == 32 .or. method == 33) problem%setting%group = "springs of the rail"
      select case (method)
      case (0)
         if (count_fits(this, method, n, 0, 0)) problem%digits%z = 0
      case (1)
         if (count_fits(this, method, n, 5, 6)) call set_track(this, v, problem)
      case (2)
         if (count_fits(this, method, n, 6, 6)) call set_deviations(this, v, problem)
      case (3)
         if (count_fits(this, method, n, 11, 12)) then
            call set_track(this, v(:n - 6), problem)
            call set_deviations(this, v(n - 5:), problem)
         end if
      case (32, 33)
         if (count_fits(this, method, n, 4, 5)) call set_springs(this, v, problem)
      case default
         call complain(this, "there is no track method " // integer_text(method) // "; 0, 1, 2, 3, 32 and 33 are")
      end select
      call leave(problem)
   end subroutine cntc_settrackdimensions

   !> Gauge or absolute placement, cant, roller, curvature
   subroutine set_track(this, values, problem)
      type(entry_type), intent(in) :: this
      real(wp), intent(in) :: values(:)
      type(library_problem), intent(inout) :: problem
      real(wp) :: length, v(6)
      integer :: n

      n = size(values)
      length = inward(problem%units, quantity%length)
      v = 0.0_wp
      v(:n) = values
      v([1, 3, 5]) = v([1, 3, 5])*length
      v(4) = v(4)*inward(problem%units, quantity%angle)
      v(6) = v(6)*inward(problem%units, quantity%curvature)
      if (v(1) > 0.0_wp) then
         if (.not. fits(this, "GAUGHT GAUGSQ GAUGWD CANT", v(:4))) return
      else
         v(2) = v(2)*length
         if (.not. fits(this, "GAUGHT RAILY0 RAILZ0 CANT", v(:4))) return
      end if
      ! a track has no roller
      if (abs(v(5)) > 0.0_wp .or. v(5) /= v(5)) then
         if (.not. fits(this, "NOMRADR", v(5:5))) return
      end if
      if (.not. fits(this, "CURV", v(6:6))) return
      associate (track => problem%spec%wheel_rail%track)
         track%gaught = v(1)
         if (track%gaught > 0.0_wp) then
            track%gaugwd = v(3)
         else
            track%raily0 = v(2)
            track%railz0 = v(3)
         end if
         track%cant = v(4)
         track%nomradr = v(5)
         track%curvature = v(6)
      end associate
      problem%digits%z = 3
   end subroutine set_track

   !> Deviations of the rail and their rates
   subroutine set_deviations(this, values, problem)
      type(entry_type), intent(in) :: this
      real(wp), intent(in) :: values(6)
      type(library_problem), intent(inout) :: problem
      type(rail_spec) :: rail
      type(setter) :: a

      rail = problem%spec%wheel_rail%rail
      a = new_setter(this, problem%units, values)
      call visit_deviations(a, rail)
      call take_rail(a, rail, problem)
   end subroutine set_deviations

   !> Springs and static forces of a massless rail
   subroutine set_springs(this, values, problem)
      type(entry_type), intent(in) :: this
      real(wp), intent(in) :: values(:)
      type(library_problem), intent(inout) :: problem
      type(rail_spec) :: rail
      type(setter) :: a

      rail = problem%spec%wheel_rail%rail
      a = new_setter(this, problem%units, values)
      call visit_springs(a, rail)
      call take_rail(a, rail, problem)
   end subroutine set_springs

   !> Store what was set for the rail
   subroutine take_rail(a, rail, problem)
      type(setter), intent(in) :: a
      type(rail_spec), intent(in) :: rail
      type(library_problem), intent(inout) :: problem

      if (.not. a%is_good) return
      problem%spec%wheel_rail%rail = rail
      problem%digits%z = 3
   end subroutine take_rail

   !> Dimensions of the wheelset
   subroutine cntc_setwheelsetdimensions(ire, ewheel, nparam, params) bind(c, name="inside_cntc_setwheelsetdimensions")
      integer(c_int), intent(in), optional :: ire, ewheel, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp), allocatable :: v(:)
      integer :: method

      call begin("cntc_setWheelsetDimensions", ire, ewheel, nparam, params, this, problem, method, v)
      if (.not. associated(problem)) return
      select case (method)
      case (3, 5)
         if (count_fits(this, method, size(v), 3, 4)) call set_dimensions(this, method, v, problem)
      case (0, 1, 2, 4)
         if (count_fits(this, method, size(v), 0, 0)) call note_dimensions(method, problem)
      case default
         call complain(this, "there is no wheelset method " // integer_text(method) // "; 0 to 5 are")
      end select
      call leave(problem)
   end subroutine cntc_setwheelsetdimensions

   !> Flange-back distance and position, radius, tape line
   subroutine set_dimensions(this, method, values, problem)
      type(entry_type), intent(in) :: this
      integer, intent(in) :: method
      real(wp), intent(in) :: values(:)
      type(library_problem), intent(inout) :: problem
      type(wheelset_spec) :: wheelset
      type(setter) :: a

      wheelset = problem%spec%wheel_rail%wheelset
      a = new_setter(this, problem%units, values)
      call visit_dimensions(a, wheelset)
      if (.not. a%is_good) return
      problem%spec%wheel_rail%wheelset = wheelset
      call note_dimensions(method, problem)
   end subroutine set_dimensions

   !> The digit E that input files of the case get
   subroutine note_dimensions(method, problem)
      integer, intent(in) :: method
      type(library_problem), intent(inout) :: problem

      associate (e => problem%digits%e)
         if (e <= 3) then
            e = method
         else if (e == 4) then
            e = 5
         end if
      end associate
   end subroutine note_dimensions

   !> Position of the wheelset; its height counts when no vertical force is prescribed
   subroutine cntc_setwheelsetposition(ire, ewheel, nparam, params) bind(c, name="inside_cntc_setwheelsetposition")
      integer(c_int), intent(in), optional :: ire, ewheel, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(wheelset_spec) :: wheelset
      type(setter) :: a
      real(wp), allocatable :: v(:)
      integer :: method

      call begin("cntc_setWheelsetPosition", ire, ewheel, nparam, params, this, problem, method, v)
      if (.not. associated(problem)) return
      if (takes_values(this, method, size(v), 6, 6)) then
         wheelset = problem%spec%wheel_rail%wheelset
         a = new_setter(this, problem%units, v)
         ! on rollers as well; which place the first value is will be seen when the case is solved
         call visit_position(a, wheelset, roller=.false., with_force=.false.)
         if (a%is_good) then
            problem%spec%wheel_rail%wheelset = wheelset
            problem%digits%e = max(1, problem%digits%e)
         end if
      end if
      call leave(problem)
   end subroutine cntc_setwheelsetposition

   !> Does a wheelset method take these values? 0 keeps everything
   logical function takes_values(this, method, n, fewest, most)
      type(entry_type), intent(in) :: this
      !> E, number of values, and the numbers that can be
      integer, intent(in) :: method, n, fewest, most

      takes_values = .false.
      if (method == 0) return
      if (method < 1 .or. method > 5) then
         call complain(this, "there is no wheelset method " // integer_text(method) // "; 0 to 5 are")
         return
      end if
      takes_values = count_fits(this, method, n, fewest, most)
   end function takes_values

   !> Velocity of the wheelset; on rollers the first value is the pitch rate of the roller
   subroutine cntc_setwheelsetvelocity(ire, ewheel, nparam, params) bind(c, name="inside_cntc_setwheelsetvelocity")
      integer(c_int), intent(in), optional :: ire, ewheel, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(wheelset_spec) :: wheelset
      type(setter) :: a
      real(wp), allocatable :: v(:)
      integer :: method
      logical :: is_roller

      call begin("cntc_setWheelsetVelocity", ire, ewheel, nparam, params, this, problem, method, v)
      if (.not. associated(problem)) return
      if (takes_values(this, method, size(v), 6, 6)) then
         wheelset = problem%spec%wheel_rail%wheelset
         is_roller = problem%digits%c1 >= 4
         a = new_setter(this, problem%units, v)
         call visit_velocity(a, wheelset, is_roller, with_force=.false.)
         if (a%is_good) then
            if (method == 1) call say(1, this, "method 1 is taken for 2")
            if (is_roller) wheelset%vs = 0.0_wp
            problem%spec%wheel_rail%wheelset = wheelset
            if (problem%digits%e <= 1) problem%digits%e = max(2, method)
         end if
      end if
      call leave(problem)
   end subroutine cntc_setwheelsetvelocity

   !> Flexible deviations of the wheel and their rates
   subroutine cntc_setwheelsetflexibility(ire, ewheel, nparam, params) bind(c, name="inside_cntc_setwheelsetflexibility")
      integer(c_int), intent(in), optional :: ire, ewheel, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(wheelset_spec) :: wheelset
      type(setter) :: a
      real(wp), allocatable :: v(:)
      integer :: method
      logical :: given

      call begin("cntc_setWheelsetFlexibility", ire, ewheel, nparam, params, this, problem, method, v)
      if (.not. associated(problem)) return
      given = method == 4 .or. method == 5
      if (takes_values(this, method, size(v), merge(12, 0, given), merge(12, 1, given))) then
         wheelset = problem%spec%wheel_rail%wheelset
         associate (e => problem%digits%e)
            if (given) then
               a = new_setter(this, problem%units, v)
               call visit_flexibility(a, wheelset)
               if (a%is_good) e = merge(5, 4, method == 5 .or. e == 3 .or. e == 5)
            else
               wheelset%flexible = 0.0_wp
               wheelset%flexible_rate = 0.0_wp
               if (e >= 4) e = e - 2
            end if
         end associate
         if (a%is_good) problem%spec%wheel_rail%wheelset = wheelset
      end if
      call leave(problem)
   end subroutine cntc_setwheelsetflexibility
end module contact_capi_wheel_rail_settings
