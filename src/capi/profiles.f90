!> Profiles of rail and wheel given by callers (module 1)
!>
!> A profile is read at once. A failure is stored, and reported when a calculation or data of the profile are requested.
module contact_capi_profiles
   use contact_base_constants, only : pi
   use contact_base_error, only : error_kind, error_type, full_text
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_capi_files, only : find_full_path, find_working_folder
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : report_error, fits, library_log, warn
   use contact_capi_problem, only : library_problem, given_profile
   use contact_capi_caller, only : caller
   use contact_cases_wheel_rail_session, only : load_profile
   use contact_control_library_codes, only : library_code
   use contact_control_units, only : inward, quantity
   use contact_profile_request, only : profile_request, profile_side
   use contact_profile_store, only : profile_store
   use contact_wheelrail_spec, only : profile_spec
   implicit none (type, external)
   private

   public :: read_given_profile, set_profile

   !> Scales below this value are replaced by the unit of length of the caller [-]
   real(wp), parameter :: no_scale = 5.0e-4_wp
   !> Names of the real options
   character(len=*), parameter :: option_names = "SCALEYZ SMOOTH MAXOMIT ZIGTHRS KINKHIGH KINKLOW KINKWID"
   !> Groups of settings replaced by a profile of a rail and of a wheel
   character(len=*), parameter :: profile_groups(0:1) = [character(len=20) :: "profile of the rail", "profile of the wheel"]
   !> Minimum turning angle of a zig-zag [rad]
   real(wp), parameter :: min_zigzag = 0.25_wp*pi

contains

   !> Set a profile, from a file or from a table y1, z1, y2, z2, ...
   subroutine set_profile(a, problem)
      type(caller), intent(inout) :: a
      type(library_problem), intent(inout) :: problem
      type(profile_spec) :: profile
      integer, allocatable :: options(:)
      real(wp), allocatable :: values(:)
      integer :: kind
      logical :: is_file

      is_file = allocated(a%path)
      options = a%integers(1)%v
      kind = merge(-1, 1, is_file)
      if (size(options) >= 1) kind = options(1)
      profile%name = "<values>"
      values = a%numbers(1)%v
      if (is_file) then
         profile%name = a%path
         if (kind /= 0 .and. kind /= 1) kind = merge(1, 0, names_wheel(profile%name))
      else
         kind = max(0, min(1, kind))
         values = a%numbers(2)%v
      end if
      problem%setting%group = profile_groups(kind)
      if (len(profile%name) == 0) then
         call a%refuse_call("the name of the file is missing; nothing is stored")
      else if (.not. is_file .and. size(a%numbers(1)%v) < 4) then
         call a%refuse_call("a profile needs at least two points and at most a million; nothing is stored")
      else if (fits(a%call_of, option_names, values)) then
         call set_options(options, values, problem, profile)
         if (.not. is_file) then
            if (.not. fits(a%call_of, "Y", a%numbers(1)%v*profile%scale)) return
            profile%points = reshape(a%numbers(1)%v, [2, size(a%numbers(1)%v)/2])
         end if
         call store_profile(a%call_of, kind == 1, profile, problem)
      end if
   end subroutine set_profile

   !> Does the extension of a file indicate a wheel?
   pure logical function names_wheel(name)
      character(len=*), intent(in) :: name
      character(len=4) :: extension
      integer :: i

      extension = name(index(name, ".", back=.true.) + 1:)
      do i = 1, 4
         if (extension(i:i) >= "A" .and. extension(i:i) <= "Z") extension(i:i) = achar(iachar(extension(i:i)) + 32)
      end do
      names_wheel = any(extension == ["prw ", "whl ", "slcw"])
   end function names_wheel

   !> Set the options for the processing of a profile
   subroutine set_options(ints, reals, problem, profile)
      !> Kind, unused, mirror y, mirror z, error handling, smoothing method
      integer, intent(in) :: ints(:)
      !> Scale, smoothing, omission, zig-zag, kinks high, low, width
      real(wp), intent(in) :: reals(:)
      type(library_problem), intent(in) :: problem
      type(profile_spec), intent(inout) :: profile

      profile%zigzag = 5.0_wp*pi/6.0_wp
      profile%kink_high = pi/6.0_wp
      profile%scale = inward(problem%units, quantity%length)
      if (size(ints) >= 3) profile%mirror_y = merge(1, 0, ints(3) == 1)
      if (size(ints) >= 4) profile%mirror_z = max(-1, min(1, ints(4)))
      if (size(ints) >= 5) profile%error_handling = max(-2, min(1, ints(5)))
      if (size(ints) >= 6) profile%smoothing_method = max(0, min(2, ints(6)))
      if (size(reals) >= 1) then
         if (reals(1) > no_scale) profile%scale = reals(1)
      end if
      if (size(reals) >= 2) profile%smoothing = max(0.0_wp, reals(2))
      if (size(reals) >= 3) profile%largest_omission = max(0.0_wp, min(1.0_wp, reals(3)))
      if (size(reals) >= 4) profile%zigzag = max(min_zigzag, reals(4))
      if (size(reals) >= 5) profile%kink_high = reals(5)
      profile%kink_low = 0.2_wp*profile%kink_high
      if (size(reals) >= 6) profile%kink_low = reals(6)
      if (size(reals) >= 7) profile%kink_width = reals(7)*inward(problem%units, quantity%length)
   end subroutine set_options

   !> Store and read a profile
   subroutine store_profile(this, is_wheel, profile, problem)
      type(entry_type), intent(in) :: this
      logical, intent(in) :: is_wheel
      type(profile_spec), intent(in) :: profile
      type(library_problem), intent(inout) :: problem

      if (is_wheel) then
         problem%spec%wheel_rail%wheel_profile = profile
         call problem%wheel_rail%profiles%forget(profile_side%wheel)
         call read_given_profile(this, problem%wheel_rail%profiles, profile, profile_side%wheel, problem%wheel)
      else
         problem%spec%wheel_rail%rail_profile = profile
         call problem%wheel_rail%profiles%forget(profile_side%rail)
         call read_given_profile(this, problem%wheel_rail%profiles, profile, profile_side%rail, problem%rail)
      end if
   end subroutine store_profile

   !> Read a profile, and store the reason if this fails
   subroutine read_given_profile(this, profiles, profile, side, given)
      type(entry_type), intent(in) :: this
      !> Profiles of all problems, each read once
      type(profile_store), intent(inout) :: profiles
      !> Name of the file and its processing
      type(profile_spec), intent(in) :: profile
      !> Member of profile_side
      integer, intent(in) :: side
      !> Receives the curve, or the reason of the failure
      type(given_profile), intent(inout) :: given
      type(error_type), allocatable :: error
      type(log_type) :: log
      type(profile_request) :: wanted
      character(len=:), allocatable :: doubts, folder

      !> Reasons of failures: the file cannot be opened, its content cannot be used
      integer, parameter :: no_file = 2, no_use = 99

      log = library_log()
      call find_working_folder(folder)
      profiles%watches_files = .false.
      call log%hold()
      call load_profile(profiles, profile, side, folder, wanted, given%curve, given%surface, log, error)
      call log%take_held(doubts)
      given%detail = 0
      if (allocated(given%written_as)) deallocate(given%written_as)
      call find_full_path(profile%name, given%path)
      if (len(doubts) > 0) call warn(this, doubts)
      if (.not. allocated(error)) return
      given%detail = merge(no_file, no_use, error%kind == error_kind%file)
      call report_error(this, full_text(error), library_code%profile)
   end subroutine read_given_profile
end module contact_capi_profiles
