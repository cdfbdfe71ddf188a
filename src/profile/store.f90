!> Store of prepared profiles
!>
!> The code that runs the cases owns one store. A profile is kept until the store is released or, when more than `max_profiles`
!> are in use, until it is the least recently used one. A file that has changed is read again: its text is compared by length
!> and hash. A file whose number, length and time stamps are unchanged, and were older than the clock resolution when it was
!> read, is not opened again.
module contact_profile_store
   use contact_base_error, only : add_context, error_type
   use contact_base_kinds, only : long, wp
   use contact_base_log, only : log_type
   use contact_base_system, only : file_stamp, stamp_of
   use contact_profile_curve, only : profile_curve
   use contact_profile_prepare, only : is_slices_file, read_profile
   use contact_profile_request, only : profile_request, same_request
   use contact_profile_slices_file, only : read_slices_file, slices_list
   use contact_profile_surface, only : large_overshoot, new_surface, profile_surface, surface_cut
   use contact_text_lexer, only : input_lexer
   use contact_text_words, only : integer_text, real_text
   implicit none (type, external)
   private

   public :: profile_store, prepared_profile, load_profile

   !> Content of a profile file: one curve, or a surface through slices
   type :: prepared_profile
      type(profile_request) :: request
      !> The curve; for a surface its first slice
      type(profile_curve) :: curve
      !> Allocated for slices files
      type(profile_surface), allocatable :: surface
   end type prepared_profile

   !> A file from which a profile was read
   type :: watched_file
      character(len=:), allocatable :: name
      !> Stamp taken before it was read
      type(file_stamp) :: stamp
   end type watched_file

   type :: store_entry
      !> Owned by the store; its address is stable while the list of entries grows
      type(prepared_profile), pointer :: profile => null()
      integer(long) :: fingerprint = 0
      integer(long) :: last_use = 0
      !> Files on which the fingerprint is based; none for a profile given by points, or confined to a folder
      type(watched_file), allocatable :: files(:)
   end type store_entry

   type :: profile_store
      !> Maximum number of profiles kept
      integer :: max_profiles = 20
      !> Are files checked again if their profile is in the store?
      logical :: watches_files = .true.
      !> Number of profiles read, for tests and timing
      integer :: loads = 0
      !> Number of times that the files of a profile were read for comparison, for tests and timing
      integer :: comparisons = 0
      !> Hash of all files read, in order
      integer(long) :: history = 0
      type(store_entry), allocatable, private :: entries(:)
      integer(long), private :: clock = 0
   contains
      procedure :: get
      procedure :: forget
      procedure :: release
   end type profile_store

   !> Number of the last curve prepared in this process; incremented atomically
   integer(long) :: last_number = 0

contains

   !> Get a profile from the store or from its file
   subroutine get(self, request, profile, log, error)
      class(profile_store), intent(inout) :: self
      !> File, and how it is to be read and smoothed
      type(profile_request), intent(in) :: request
      !> Owned by the store; valid until `max_profiles` others are requested. Null on errors
      type(prepared_profile), pointer, intent(out) :: profile
      !> Receives warnings when a profile is read; they are not repeated for one from the store
      type(log_type), intent(inout) :: log
      !> Gives the file and what is wrong
      type(error_type), allocatable, intent(out) :: error
      type(watched_file), allocatable :: files(:)
      integer(long) :: fingerprint
      integer :: k, slot

      profile => null()
      if (.not. allocated(self%entries)) allocate(self%entries(max(1, self%max_profiles)))
      self%clock = self%clock + 1
      do k = 1, size(self%entries)
         if (.not. associated(self%entries(k)%profile)) cycle
         if (.not. same_request(self%entries(k)%profile%request, request)) cycle
         if (self%watches_files) then
            if (.not. are_untouched(self%entries(k)%files)) cycle
         end if
         self%entries(k)%last_use = self%clock
         profile => self%entries(k)%profile
         return
      end do
      call fingerprint_of(request, fingerprint, files, error)
      self%comparisons = self%comparisons + 1
      if (allocated(error)) return
      slot = 0
      do k = 1, size(self%entries)
         if (.not. associated(self%entries(k)%profile)) cycle
         if (.not. same_request(self%entries(k)%profile%request, request)) cycle
         if (self%entries(k)%fingerprint == fingerprint) then
            self%entries(k)%last_use = self%clock
            call move_alloc(files, self%entries(k)%files)
            profile => self%entries(k)%profile
            return
         end if
         slot = k
      end do
      if (slot == 0) slot = minloc(self%entries%last_use, 1)
      if (associated(self%entries(slot)%profile)) deallocate(self%entries(slot)%profile)
      self%entries(slot)%last_use = 0
      allocate(profile)
      call load_profile(request, profile, log, error)
      profile%curve%number = next_number()
      self%loads = self%loads + 1
      self%history = modulo(31_long*self%history + fingerprint, 2147483647_long)
      if (allocated(error)) then
         deallocate(profile)
         return
      end if
      self%entries(slot)%profile => profile
      self%entries(slot)%fingerprint = fingerprint
      call move_alloc(files, self%entries(slot)%files)
      self%entries(slot)%last_use = self%clock
   end subroutine get

   !> A number that is unique in this process
   integer(long) function next_number()
      !$omp atomic capture
      last_number = last_number + 1
      next_number = last_number
      !$omp end atomic
   end function next_number

   !> Remove the profiles of one body, so that their files are read again
   subroutine forget(self, side)
      class(profile_store), intent(inout) :: self
      !> Member of profile_side
      integer, intent(in) :: side
      integer :: k

      if (.not. allocated(self%entries)) return
      do k = 1, size(self%entries)
         if (.not. associated(self%entries(k)%profile)) cycle
         if (self%entries(k)%profile%request%side /= side) cycle
         deallocate(self%entries(k)%profile)
         self%entries(k)%profile => null()
         self%entries(k)%last_use = 0
      end do
   end subroutine forget

   !> Remove all profiles
   subroutine release(self)
      class(profile_store), intent(inout) :: self
      integer :: k

      if (.not. allocated(self%entries)) return
      do k = 1, size(self%entries)
         if (associated(self%entries(k)%profile)) deallocate(self%entries(k)%profile)
      end do
      deallocate(self%entries)
   end subroutine release

   !> Read a profile, or all slices of a variable one
   subroutine load_profile(request, profile, log, error)
      !> File, and how it is to be read and smoothed
      type(profile_request), intent(in) :: request
      !> The curve, or the surface through all slices
      type(prepared_profile), intent(out) :: profile
      !> Receives warnings
      type(log_type), intent(inout) :: log
      !> Gives the file and what is wrong
      type(error_type), allocatable, intent(out) :: error
      type(input_lexer) :: text
      type(slices_list) :: list
      type(profile_request) :: slice
      type(profile_curve), allocatable :: curves(:)
      integer :: k

      profile%request = request
      if (.not. has_slices(request)) then
         call read_profile(request, profile%curve, log, error)
         return
      end if
      call text%open_file(request%file, error, request%below)
      if (.not. allocated(error)) call read_slices_file(text, request%side, list, error)
      if (allocated(error)) return
      if (.not. text%at_end()) call log%warning(request%file // ": what stands below line " // integer_text(text%line) // &
         & " is ignored: NSLC = " // integer_text(size(list%slices)) // " slices, and the features that NFEAT and NKINK announce, &
         &end there")
      allocate(curves(size(list%slices)))
      slice = request
      do k = 1, size(curves)
         slice%file = list%slices(k)%file
         call read_profile(slice, curves(k), log, error)
         call add_context(error, "slice " // integer_text(k) // " of " // request%file)
         if (allocated(error)) return
      end do
      allocate(profile%surface)
      call new_surface(request%side, list, curves, request%file, profile%surface, error)
      profile%curve = curves(1)
      if (.not. allocated(error)) call warn_of_overshoot(profile%surface, list, curves, request%file, log)
   end subroutine load_profile

   !> Warn if the surface, half-way between two slices, deviates from both of them
   !>
   !> Splines along u overshoot between slices whose outlines differ abruptly without a feature that marks where a part begins
   !> or ends, by many times the difference of the slices.
   subroutine warn_of_overshoot(surface, list, curves, file, log)
      type(profile_surface), intent(in) :: surface
      type(slices_list), intent(in) :: list
      !> One per slice
      type(profile_curve), intent(in) :: curves(:)
      character(len=*), intent(in) :: file
      type(log_type), intent(inout) :: log
      !> Threshold of the overshoot, relative to the difference of the slices [-]; number of positions across the profile
      real(wp), parameter :: relative = 1.0_wp
      integer, parameter :: places = 15
      type(surface_cut) :: section
      real(wp) :: y(places), z(places, 3), range(2), overshoot, largest
      logical :: found(places, 3)
      integer :: i, k, worst

      largest = 0.0_wp
      worst = 0
      do k = 1, size(curves) - 1
         call surface%cut(0.5_wp*(list%slices(k)%u + list%slices(k + 1)%u), section)
         if (.not. section%present) cycle
         associate (before => curves(k)%y_range(), after => curves(k + 1)%y_range(), between => section%curve%y_range())
            range = [max(before(1), after(1), between(1)), min(before(2), after(2), between(2))]
         end associate
         if (range(2) <= range(1)) cycle
         ! slopes at the ends of profiles are steep
         y = [(range(1) + (range(2) - range(1))*i/(places + 1), i = 1, places)]
         call curves(k)%heights(y, z(:, 1), found(:, 1))
         call curves(k + 1)%heights(y, z(:, 2), found(:, 2))
         call section%curve%heights(y, z(:, 3), found(:, 3))
         do i = 1, places
            if (.not. all(found(i, :))) cycle
            overshoot = max(minval(z(i, :2)) - z(i, 3), z(i, 3) - maxval(z(i, :2)))
            if (overshoot <= max(large_overshoot, largest, relative*abs(z(i, 1) - z(i, 2)))) cycle
            largest = overshoot
            worst = k
         end do
      end do
      if (worst == 0) return
      call log%warning(file // ":" // integer_text(list%slices(worst)%line) // ": between slices " // integer_text(worst) // &
         & " and " // integer_text(worst + 1) // " the surface deviates from both of them by " // real_text(largest) // &
         & " mm, because their outlines change abruptly. Between them it is not the shape of the body; mark where a part " // &
         & "begins or ends by features (NFEAT), or give more slices")
   end subroutine warn_of_overshoot

   pure logical function has_slices(request)
      type(profile_request), intent(in) :: request

      has_slices = .false.
      if (.not. allocated(request%points)) has_slices = is_slices_file(request%file)
   end function has_slices

   !> Are all files unchanged since they were read, according to the file system?
   logical function are_untouched(files)
      !> Unallocated if this is unknown
      type(watched_file), intent(in), allocatable :: files(:)
      type(file_stamp) :: now
      integer :: k

      are_untouched = .false.
      if (.not. allocated(files)) return
      do k = 1, size(files)
         now = stamp_of(files(k)%name)
         if (.not. now%is_unchanged_since(files(k)%stamp)) return
      end do
      are_untouched = .true.
   end function are_untouched

   !> Hash of the file, and of all slices that it names
   subroutine fingerprint_of(request, fingerprint, files, error)
      type(profile_request), intent(in) :: request
      integer(long), intent(out) :: fingerprint
      !> Files that were read; unallocated if changes can only be detected by reading them, and on errors
      type(watched_file), allocatable, intent(out) :: files(:)
      type(error_type), allocatable, intent(out) :: error
      type(file_stamp) :: stamp
      type(input_lexer) :: text, slice
      type(slices_list) :: list
      integer(long), parameter :: modulus = 2147483647_long
      integer :: k

      if (allocated(request%points)) then
         fingerprint = 0_long
         do k = 1, size(request%points, 2)
            fingerprint = modulo(31_long*fingerprint + modulo(transfer(request%points(1, k), modulus), modulus) &
               & + modulo(transfer(request%points(2, k), modulus), modulus), modulus)
         end do
         return
      end if
      stamp = stamp_of(request%file)
      call text%open_file(request%file, error, request%below)
      if (allocated(error)) return
      fingerprint = text%fingerprint()
      allocate(list%slices(0))
      if (has_slices(request)) call read_slices_file(text, request%side, list, error)
      if (allocated(error)) return
      allocate(files(size(list%slices) + 1))
      files(1)%name = request%file
      files(1)%stamp = stamp
      do k = 1, size(list%slices)
         files(k + 1)%name = list%slices(k)%file
         files(k + 1)%stamp = stamp_of(list%slices(k)%file)
         call slice%open_file(list%slices(k)%file, error, request%below)
         call add_context(error, "slice " // integer_text(k) // " of " // request%file)
         if (allocated(error)) return
         fingerprint = modulo(31_long*fingerprint + slice%fingerprint(), modulus)
      end do
      ! the target of a symbolic link is checked each time
      if (allocated(request%below)) deallocate(files)
   end subroutine fingerprint_of
end module contact_profile_store
