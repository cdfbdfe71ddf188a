!> Entries for track, rail and wheelset (module 1)
module contact_capi_pair_settings
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use contact_base_kinds, only : wp
   use contact_capi_arguments, only : integer_of, real_of, reals_of
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : are_finite, complain, count_fits, say
   use contact_capi_problem, only : library_problem
   use contact_capi_registry, only : enter, leave, scope
   use contact_control_units, only : inward, quantity
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: cntc_setverticalforce, cntc_settrackdimensions, cntc_setwheelsetdimensions, cntc_setwheelsetposition
   public :: cntc_setwheelsetvelocity, cntc_setwheelsetflexibility

   !> Bounds of the nominal radius of a wheel [mm]
   real(wp), parameter :: least_radius = 1.0e-3_wp, largest_radius = 1.0e20_wp
   !> There is no tape line [mm]
   real(wp), parameter :: no_tape = 1000.0_wp

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
      call enter(this, scope%pair, problem)
   end subroutine begin

   !> Prescribed vertical force on the rail (N = 1)
   subroutine cntc_setverticalforce(ire, fz) bind(c)
      integer(c_int), intent(in), optional :: ire
      real(c_double), intent(in), optional :: fz
      type(library_problem), pointer :: problem
      type(entry_type) :: this

      this = entry_type("cntc_setVerticalForce", integer_of(ire))
      call enter(this, scope%pair, problem)
      if (.not. associated(problem)) return
      if (are_finite(this, [real_of(fz)])) then
         problem%spec%digits%n = 1
         problem%spec%wheel_rail%wheelset%fz = real_of(fz)*inward(problem%units, quantity%force)
      end if
      call leave(problem)
   end subroutine cntc_setverticalforce

   !> Place of the rail in the track, deviations of the rail, springs of a massless rail
   subroutine cntc_settrackdimensions(ire, ztrack, nparam, params) bind(c)
      integer(c_int), intent(in), optional :: ire, ztrack, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp), allocatable :: v(:)
      integer :: method, n

      call begin("cntc_setTrackDimensions", ire, ztrack, nparam, params, this, problem, method, v)
      if (.not. associated(problem)) return
      n = size(v)
      if (are_finite(this, v)) then
         select case (method)
         case (0)
            if (count_fits(this, method, n, 0, 0)) problem%spec%digits%z = 0
         case (1)
            if (count_fits(this, method, n, 5, 6)) call set_track(v, problem)
         case (2)
            if (count_fits(this, method, n, 6, 6)) call set_deviations(v, problem)
         case (3)
            if (count_fits(this, method, n, 11, 12)) then
               call set_track(v(:n - 6), problem)
               call set_deviations(v(n - 5:), problem)
            end if
         case (32, 33)
            if (count_fits(this, method, n, 4, 5)) call set_springs(v, problem)
         case default
            call complain(this, "there is no track method " // integer_text(method) // "; 0, 1, 2, 3, 32 and 33 are")
         end select
      end if
      call leave(problem)
   end subroutine cntc_settrackdimensions

   !> Gauge or absolute placement, cant, roller, curvature
   subroutine set_track(v, problem)
      real(wp), intent(in) :: v(:)
      type(library_problem), intent(inout) :: problem
      real(wp) :: length

      length = inward(problem%units, quantity%length)
      associate (track => problem%spec%wheel_rail%track)
         track%gaught = v(1)*length
         if (track%gaught > 0.0_wp) then
            track%gaugwd = v(3)*length
         else
            track%raily0 = v(2)*length
            track%railz0 = v(3)*length
         end if
         track%cant = v(4)*inward(problem%units, quantity%angle)
         track%nomradr = v(5)*length
         track%curvature = 0.0_wp
         if (size(v) >= 6) track%curvature = v(6)*inward(problem%units, quantity%curvature)
      end associate
      problem%spec%digits%z = 3
   end subroutine set_track

   !> Deviations of the rail and their rates
   subroutine set_deviations(v, problem)
      real(wp), intent(in) :: v(6)
      type(library_problem), intent(inout) :: problem

      associate (rail => problem%spec%wheel_rail%rail, length => inward(problem%units, quantity%length), &
         & velocity => inward(problem%units, quantity%velocity), angle => inward(problem%units, quantity%angle))
         rail%dy = v(1)*length
         rail%dz = v(2)*length
         rail%roll = v(3)*angle
         rail%vy = v(4)*velocity
         rail%vz = v(5)*velocity
         rail%vroll = v(6)*angle
      end associate
      problem%spec%digits%z = 3
   end subroutine set_deviations

   !> Springs and static forces of a massless rail
   subroutine set_springs(v, problem)
      real(wp), intent(in) :: v(:)
      type(library_problem), intent(inout) :: problem

      associate (rail => problem%spec%wheel_rail%rail, stiffness => inward(problem%units, quantity%stiffness), &
         & force => inward(problem%units, quantity%force))
         rail%ky = v(1)*stiffness
         rail%fy = v(2)*force
         rail%kz = v(3)*stiffness
         rail%fz = v(4)*force
         rail%first_step = 1.0_wp
         if (size(v) >= 5) rail%first_step = v(5)*inward(problem%units, quantity%length)
      end associate
      problem%spec%digits%z = 3
   end subroutine set_springs

   !> Dimensions of the wheelset
   subroutine cntc_setwheelsetdimensions(ire, ewheel, nparam, params) bind(c)
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
         if (count_fits(this, method, size(v), 3, 4)) then
            if (are_finite(this, v)) call set_dimensions(method, v, problem)
         end if
      case (0, 1, 2, 4)
         if (count_fits(this, method, size(v), 0, 0)) call note_dimensions(method, problem)
      case default
         call complain(this, "there is no wheelset method " // integer_text(method) // "; 0 to 5 are")
      end select
      call leave(problem)
   end subroutine cntc_setwheelsetdimensions

   !> Flange-back distance and position, radius, tape line
   subroutine set_dimensions(method, v, problem)
      integer, intent(in) :: method
      real(wp), intent(in) :: v(:)
      type(library_problem), intent(inout) :: problem
      real(wp) :: length

      length = inward(problem%units, quantity%length)
      associate (wheelset => problem%spec%wheel_rail%wheelset)
         wheelset%fbdist = v(1)*length
         wheelset%fbpos = v(2)*length
         wheelset%nomradw = max(least_radius, min(largest_radius, v(3)*length))
         wheelset%ytape = no_tape
         if (size(v) >= 4) wheelset%ytape = v(4)*length
      end associate
      call note_dimensions(method, problem)
   end subroutine set_dimensions

   !> The digit E that input files of the case get
   subroutine note_dimensions(method, problem)
      integer, intent(in) :: method
      type(library_problem), intent(inout) :: problem

      associate (e => problem%spec%digits%e)
         if (e <= 3) then
            e = method
         else if (e == 4) then
            e = 5
         end if
      end associate
   end subroutine note_dimensions

   !> Position of the wheelset; its height counts when no vertical force is prescribed
   subroutine cntc_setwheelsetposition(ire, ewheel, nparam, params) bind(c)
      integer(c_int), intent(in), optional :: ire, ewheel, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp), allocatable :: v(:)
      integer :: method

      call begin("cntc_setWheelsetPosition", ire, ewheel, nparam, params, this, problem, method, v)
      if (.not. associated(problem)) return
      if (takes_values(this, method, size(v), 6, 6)) then
         if (are_finite(this, v)) then
            associate (wheelset => problem%spec%wheel_rail%wheelset, length => inward(problem%units, quantity%length), &
               & angle => inward(problem%units, quantity%angle))
               wheelset%s = v(1)*length
               wheelset%x = 0.0_wp
               wheelset%y = v(2)*length
               wheelset%z = v(3)*length
               wheelset%roll = v(4)*angle
               wheelset%yaw = v(5)*angle
               wheelset%pitch = v(6)*angle
            end associate
            problem%spec%digits%e = max(1, problem%spec%digits%e)
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
   subroutine cntc_setwheelsetvelocity(ire, ewheel, nparam, params) bind(c)
      integer(c_int), intent(in), optional :: ire, ewheel, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp), allocatable :: v(:)
      integer :: method

      call begin("cntc_setWheelsetVelocity", ire, ewheel, nparam, params, this, problem, method, v)
      if (.not. associated(problem)) return
      if (takes_values(this, method, size(v), 6, 6)) then
         if (are_finite(this, v)) then
            if (method == 1) call say(1, this, "method 1 is taken for 2")
            associate (wheelset => problem%spec%wheel_rail%wheelset, velocity => inward(problem%units, quantity%velocity), &
               & angle => inward(problem%units, quantity%angle))
               if (problem%spec%digits%c1 >= 4) then
                  wheelset%rpitch = v(1)*angle
                  wheelset%vs = 0.0_wp
               else
                  wheelset%vs = v(1)*velocity
               end if
               wheelset%vy = v(2)*velocity
               wheelset%vz = v(3)*velocity
               wheelset%vroll = v(4)*angle
               wheelset%vyaw = v(5)*angle
               wheelset%vpitch = v(6)*angle
            end associate
            if (problem%spec%digits%e <= 1) problem%spec%digits%e = max(2, method)
         end if
      end if
      call leave(problem)
   end subroutine cntc_setwheelsetvelocity

   !> Flexible deviations of the wheel and their rates
   subroutine cntc_setwheelsetflexibility(ire, ewheel, nparam, params) bind(c)
      integer(c_int), intent(in), optional :: ire, ewheel, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp), allocatable :: v(:)
      real(wp) :: length, velocity, angle
      integer :: method
      logical :: given

      call begin("cntc_setWheelsetFlexibility", ire, ewheel, nparam, params, this, problem, method, v)
      if (.not. associated(problem)) return
      given = method == 4 .or. method == 5
      if (takes_values(this, method, size(v), merge(12, 0, given), merge(12, 1, given))) then
         associate (wheelset => problem%spec%wheel_rail%wheelset, e => problem%spec%digits%e)
            if (.not. given) then
               wheelset%flexible = 0.0_wp
               wheelset%flexible_rate = 0.0_wp
               if (e >= 4) e = e - 2
            else if (are_finite(this, v)) then
               length = inward(problem%units, quantity%length)
               velocity = inward(problem%units, quantity%velocity)
               angle = inward(problem%units, quantity%angle)
               wheelset%flexible = v(1:6)*[length, length, length, angle, angle, angle]
               wheelset%flexible_rate = v(7:12)*[velocity, velocity, velocity, angle, angle, angle]
               if (method == 5 .or. e == 3 .or. e == 5) then
                  e = 5
               else
                  e = 4
               end if
            end if
         end associate
      end if
      call leave(problem)
   end subroutine cntc_setwheelsetflexibility
end module contact_capi_pair_settings
