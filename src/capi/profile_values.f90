!> Points of profiles for callers (module 1)
module contact_capi_profile_values
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_capi_caller, only : caller
   use contact_capi_files, only : find_result_file, find_working_folder
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : report_error
   use contact_capi_problem, only : given_profile, library_problem
   use contact_cases_wheel_rail_session, only : load_profile
   use contact_control_library_codes, only : library_code
   use contact_control_units, only : outward, quantity
   use contact_output_finished_file, only : finished_file
   use contact_profile_curve, only : profile_curve
   use contact_profile_request, only : profile_request, profile_side
   use contact_profile_sampling, only : curve_positions, line_point
   use contact_profile_surface, only : profile_surface, surface_cut
   use contact_text_words, only : integer_text
   use contact_wheelrail_profile_places, only : gauge_places, places_in_track
   use contact_wheelrail_spec, only : profile_spec
   implicit none (type, external)
   private

   public :: get_profile_values

   !> Requested data
   type :: task_list
      integer :: status = -1, count = 0, points = 1, in_track = 2, gauge = 3, arc_length = 4, slope = 5
      !> Lines as in line_kind, shifted by 5; the surface itself
      integer :: along_u = 6, along_v = 7, along_y = 8, dump = 9
   end type task_list
   type(task_list), parameter :: task = task_list()

   !> How a profile is sampled
   type :: sampling
      !> -1: input points, 0: points of the spline, 1: equidistant, k > 1: k parts of each piece of the spline
      integer :: method = 0
      !> Step of equidistant sampling [mm]
      real(wp) :: step = 1.0_wp
      !> Position of the section, and range of positions along the track
      real(wp) :: place = 0.0_wp, first = 0.0_wp, last = 0.0_wp
      logical :: has_range = .false.
   end type sampling

   !> Minimum step of equidistant sampling [mm]
   real(wp), parameter :: min_step = 1.0e-4_wp
   integer, parameter :: max_parts = 100
   !> File to which a surface is written
   character(len=*), parameter :: surface_file = "dump_spl2d.m"

contains

   !> Get points, arc lengths, inclinations of a profile, or whether there is one
   subroutine get_profile_values(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), intent(inout) :: problem
      type(sampling) :: sample
      logical :: is_wheel

      associate (ints => a%integers(1)%v)
         is_wheel = .false.
         if (size(ints) >= 1) is_wheel = ints(1) == 1
         call set_sampling(a%call_of, a%single(1), ints, a%numbers(1)%v, sample)
      end associate
      if (is_wheel) then
         call get_values(a, a%single(1), problem, problem%wheel, is_wheel, sample)
      else
         call get_values(a, a%single(1), problem, problem%rail, is_wheel, sample)
      end if
   end subroutine get_profile_values

   !> Read the sampling from the arguments
   subroutine set_sampling(this, requested_task, ints, reals, sample)
      type(entry_type), intent(in) :: this
      !> Member of `task`; integer and real arguments
      integer, intent(in) :: requested_task, ints(:)
      real(wp), intent(in) :: reals(:)
      type(sampling), intent(out) :: sample

      if (size(ints) >= 2) sample%method = max(-1, min(max_parts, ints(2)))
      if (requested_task >= task%along_u) sample%method = 1
      if (size(reals) >= 1) sample%step = reals(1)
      if (sample%method == 1 .and. .not. sample%step >= min_step) then
         call report_error(this, "the step of an even sampling is too small, the points of the spline are used")
         sample%method = 0
      end if
      if (size(reals) >= 2) sample%place = reals(2)
      sample%has_range = size(reals) >= 4
      if (.not. sample%has_range) return
      sample%first = reals(3)
      sample%last = reals(4)
   end subroutine set_sampling

   !> Return the requested data
   subroutine get_values(a, requested_task, problem, given, is_wheel, sample)
      type(caller), intent(in) :: a
      !> Member of `task`
      integer, intent(in) :: requested_task
      type(library_problem), intent(inout) :: problem
      type(given_profile), intent(in) :: given
      logical, intent(in) :: is_wheel
      type(sampling), intent(in) :: sample
      type(profile_curve) :: curve
      real(wp), allocatable :: s(:)

      if (requested_task == task%status) then
         call a%set_result(1, [real(wp) :: merge(library_code%success, library_code%profile, given%detail == 0), given%detail])
         return
      else if (requested_task < task%status .or. requested_task > task%dump) then
         call report_error(a%call_of, "there is no task " // integer_text(requested_task) // "; -1 to 9 are")
         return
      else if (given%detail /= 0) then
         call report_error(a%call_of, "the profile is missing or cannot be used", library_code%profile)
         return
      else if (requested_task >= task%along_u) then
         call get_values_along(a, requested_task, given, sample)
         return
      end if
      call section_of(a%call_of, problem, given, is_wheel, sample, curve)
      if (.not. allocated(curve%y%s)) then
         call a%set_result(1, [real(library_code%profile, wp)])
         return
      end if
      call curve_positions(curve, sample%method, sample%step, s)
      select case (requested_task)
      case (task%count)
         call a%set_result(1, [real(size(s), wp)])
      case (task%points)
         call a%set_result(1, [curve%y%value(s), curve%z%value(s)])
      case (task%in_track)
         call a%set_result(1, places_in_track(problem%spec%wheel_rail, problem%wheel_rail_result, is_wheel, curve%y%value(s), &
            & curve%z%value(s)))
      case (task%gauge)
         if (is_wheel) then
            call report_error(a%call_of, "a wheel has no gauge point")
            call a%set_result(1, [real(library_code%profile, wp)])
         else
            call a%set_result(1, gauge_places(problem%spec%wheel_rail, problem%wheel_rail_result, curve)* &
               & outward(problem%units, quantity%length))
         end if
      case (task%arc_length)
         call a%set_result(1, s)
      case (task%slope)
         call a%set_result(1, atan2(curve%z%slope(s), curve%y%slope(s))*outward(problem%units, quantity%angle))
      end select
   end subroutine get_values

   !> The sampled curve: the section of a variable profile at a position; for input points their interpolation
   subroutine section_of(this, problem, given, is_wheel, sample, curve)
      type(entry_type), intent(in) :: this
      type(library_problem), intent(inout) :: problem
      type(given_profile), intent(in) :: given
      logical, intent(in) :: is_wheel
      type(sampling), intent(in) :: sample
      !> Has no pieces if there is no profile
      type(profile_curve), intent(out) :: curve
      type(surface_cut) :: section
      type(profile_spec) :: plain
      type(given_profile) :: points
      type(log_type) :: log
      type(error_type), allocatable :: error
      character(len=:), allocatable :: folder
      type(profile_request) :: request

      if (allocated(given%surface)) then
         call given%surface%cut(sample%place, section)
         if (section%present) then
            curve = section%curve
         else
            call report_error(this, "the variable profile has no section at this position")
         end if
      else if (sample%method < 0) then
         ! without smoothing, pieces end at the input points
         plain = problem%spec%wheel_rail%rail_profile
         if (is_wheel) plain = problem%spec%wheel_rail%wheel_profile
         plain%smoothing_method = 0
         plain%smoothing = 0.0_wp
         call find_working_folder(folder)
         call load_profile(problem%wheel_rail%profiles, plain, merge(profile_side%wheel, profile_side%rail, is_wheel), &
            & folder, request, points%curve, points%surface, log, error)
         curve = given%curve
         if (.not. allocated(error)) curve = points%curve
      else
         curve = given%curve
      end if
   end subroutine section_of

   !> Lines on a variable profile: along one of its coordinates u and v, or along the track; or the surface itself
   subroutine get_values_along(a, requested_task, given, sample)
      type(caller), intent(in) :: a
      integer, intent(in) :: requested_task
      type(given_profile), intent(in) :: given
      type(sampling), intent(in) :: sample
      real(wp), allocatable :: list(:)
      real(wp) :: range(2), y, z
      integer :: i, n

      if (.not. allocated(given%surface)) then
         call report_error(a%call_of, "the profile does not vary, task " // integer_text(requested_task) // &
            & " is for variable profiles")
         return
      else if (requested_task == task%dump) then
         call write_surface(a%call_of, given%surface)
         return
      end if
      range = given%surface%u_range
      if (requested_task == task%along_u) range = [0.0_wp, real(given%surface%lines - 1, wp)]
      if (sample%has_range) range = [sample%first, sample%last]
      n = int(max(0.0_wp, min(1.0e7_wp, (range(2) - range(1))/sample%step))) + 1
      if (a%buffers(1)%length == 1) then
         call a%set_result(1, [real(n, wp)])
         return
      end if
      ! no more points than the buffer of the caller holds
      allocate(list(min(3*n, a%buffers(1)%length)))
      do i = 1, min(n, size(list))
         list(i) = range(1) + (i - 1)*sample%step
         if (requested_task == task%along_u) list(i) = sample%place
         if (n + i > size(list)) cycle
         call line_point(given%surface, 1 + requested_task - task%along_u, sample%place, range(1) + (i - 1)*sample%step, y, z)
         list(n + i) = y
         if (2*n + i <= size(list)) list(2*n + i) = z
      end do
      call a%set_result(1, list)
   end subroutine get_values_along

   !> Write the surface as a Matlab or Octave script, a struct with knots and coefficients
   subroutine write_surface(this, surface)
      type(entry_type), intent(in) :: this
      type(profile_surface), intent(in) :: surface
      character(len=:), allocatable :: path
      type(finished_file) :: file
      type(error_type), allocatable :: error
      integer :: g, i

      call find_result_file(surface_file, path)
      call file%start(path, error)
      if (.not. allocated(error)) then
         call file%line("% Surface of a variable profile: lines v = 0, 1, ..., cubic B-splines along u")
         call file%line("% A group has lines that exist over the same range of u: y(i,j), z(i,j) [mm] is coefficient i " // &
            & "of line v(j).")
         call file%line("spl2d.is_wheel = " // integer_text(merge(1, 0, surface%side == profile_side%wheel)) // ";")
         call put_row("spl2d.u_range", surface%u_range)
         do g = 1, size(surface%groups)
            associate (group => surface%groups(g))
               call put_row("spl2d.group(" // integer_text(g) // ").u_range", [group%low, group%high])
               call put_row("spl2d.group(" // integer_text(g) // ").v", [(real(i - 1, wp), i=group%first, group%last)])
               call put_row("spl2d.group(" // integer_text(g) // ").knots", group%t)
               call put_table("spl2d.group(" // integer_text(g) // ").y", transpose(group%y))
               call put_table("spl2d.group(" // integer_text(g) // ").z", transpose(group%z))
            end associate
         end do
         call file%finish(error)
      end if
      if (allocated(error)) call report_error(this, "the file " // path // " cannot be written")

   contains

      subroutine put_row(name, list)
         character(len=*), intent(in) :: name
         real(wp), intent(in) :: list(:)

         call put_table(name, reshape(list, [1, size(list)]))
      end subroutine put_row

      subroutine put_table(name, table)
         character(len=*), intent(in) :: name
         real(wp), intent(in) :: table(:, :)
         character(len=:), allocatable :: row
         integer :: k

         ! its length depends on the number of points of the profile: not on the stack
         allocate(character(len=24*size(table, 2)) :: row)
         call file%line(name // " = [")
         do k = 1, size(table, 1)
            write(row, "(*(ES24.16))") table(k, :)
            call file%line(row)
         end do
         call file%line("];")
      end subroutine put_table
   end subroutine write_surface
end module contact_capi_profile_values
