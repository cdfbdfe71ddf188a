!> Sections of a variable profile on an equidistant mesh, and heights between them
!>
!> A section is computed at its first use: most of them are never used. The sections of a wheel are at fixed positions of its
!> surface, and are kept while the wheel turns, as are those of a rail while the wheelset stays where it is. Between sections
!> heights are interpolated by cubic Hermite polynomials.
module contact_wheelrail_strip
   use contact_base_kinds, only : wp
   use contact_profile_surface, only : large_overshoot, profile_surface, surface_cut
   use contact_profile_surface_cut, only : cut_point
   implicit none (type, external)
   private

   public :: lay_out, slice_pair, strip

   !> Sections on an equidistant mesh
   type :: strip
      !> Position of the first section and distance between sections: x in the track [mm], or angle from the bottom [rad]
      real(wp) :: first = 0.0_wp, step = 1.0_wp
      !> Sections in a ring, the first one behind the slot `turned`, and the coordinate u at which each was computed; huge: it was
      !> not
      type(surface_cut), allocatable, private :: sections(:)
      real(wp), allocatable, private :: made_at(:)
      integer, private :: turned = 0
      !> Last point found on each section: the next step, or the next point, is often at or near the same position
      type(cut_point), allocatable, private :: known(:)
      !> The surface, the coordinate u on it of position 0 of the mesh, and axes of the sections (see `cut`)
      type(profile_surface) :: surface
      real(wp) :: origin = 0.0_wp, axes(3) = 0.0_wp
      !> Lateral positions at which heights are expected [mm], and first and last line of the surface around them
      real(wp), private :: expected(2) = [-huge(1.0_wp), huge(1.0_wp)]
      integer, private :: lines(2) = [1, huge(1)]
   contains
      !> Set the lateral positions at which heights are expected
      procedure :: expect
      !> Index in `sections` of a section; the same of one that is computed now unless it has been computed
      procedure, private :: slot
      procedure, private :: ready_slot
      !> Heights on a section, and its lateral range
      procedure :: heights
      procedure :: y_range
      !> Index of the section at a position of the mesh
      procedure :: number_at
      procedure :: at => strip_at
   end type strip

   !> The slices before and after a position along the track, kept for neighbouring positions
   type :: slice_pair
      integer, private :: before = 0
      type(surface_cut), private :: cut(2)
   contains
      !> Height of a rail above both slices
      procedure :: overshoot
   end type slice_pair

   !> Distances from a section, relative to the distance of sections, that are regarded as zero
   real(wp), parameter :: rounding = 1.0e-9_wp
   !> Sections are kept if they are in this part of the mesh, around its middle, where contact usually is: a wheel that turns would
   !> fill the mesh with sections, of 10 kB each
   integer, parameter :: kept_share = 4

contains

   !> A mesh of n sections on both sides of a middle one; sections of the same surface at the same positions are kept
   subroutine lay_out(along, surface, n, middle, step, origin, axes, fixed)
      !> The strip; unallocated for a body that does not vary
      type(strip), allocatable, intent(inout) :: along
      !> Unallocated for a body that does not vary
      type(profile_surface), intent(in), allocatable :: surface
      !> Number of sections on each side of the middle one
      integer, intent(in) :: n
      !> Position of the middle section, and distance of sections: [mm] along the track or [rad] around the wheel
      real(wp), intent(in) :: middle, step
      !> See `strip`
      real(wp), intent(in) :: origin, axes(3)
      !> Are the sections at multiples of their distance on the surface? The middle one is moved by half of it at most
      logical, intent(in) :: fixed
      type(surface_cut) :: nothing
      real(wp) :: first, ahead
      integer :: k

      if (.not. allocated(surface)) then
         if (allocated(along)) deallocate(along)
         return
      end if
      first = middle - n*step
      if (fixed) first = first + step*anint((origin + middle)/step) - (origin + middle)
      if (allocated(along)) then
         if (size(along%sections) /= 2*n + 1 .or. abs(along%step - step) > 0.0_wp .or. any(abs(along%axes - axes) > 0.0_wp) &
            & .or. .not. surface%same_as(along%surface)) deallocate(along)
      end if
      if (.not. allocated(along)) then
         allocate(along)
         along%surface = surface
         along%step = step
         along%axes = axes
         allocate(along%sections(2*n + 1), along%known(2*n + 1))
         allocate(along%made_at(2*n + 1), source=huge(1.0_wp))
      else
         ! points near the last ones have errors of 1e-12 mm, which a case that starts anew does not take over
         along%known = cut_point()
         ahead = ((origin + first) - (along%origin + along%first))/step
         if (abs(ahead) < 2*n + 1) along%turned = modulo(along%turned + nint(ahead), 2*n + 1)
         do k = 1, 2*n + 1
            if (abs(k - (n + 1)) <= n/kept_share) cycle
            along%sections(along%slot(k)) = nothing
            along%made_at(along%slot(k)) = huge(1.0_wp)
         end do
      end if
      along%first = first
      along%origin = origin
      along%expected = [-huge(1.0_wp), huge(1.0_wp)]
      along%lines = [1, huge(1)]
   end subroutine lay_out

   !> Set the lateral positions at which heights are expected: sections of a wheel are computed near them only
   !>
   !> Heights at other positions are found as well, from complete sections.
   subroutine expect(self, range)
      class(strip), intent(inout) :: self
      !> Smallest and largest lateral position [mm]
      real(wp), intent(in) :: range(2)
      !> Range that is added on both sides [mm], for the ends of incomplete sections and for lines that are not straight along the
      !> surface
      real(wp), parameter :: margin = 5.0_wp
      integer :: first, last, g

      self%expected = range
      self%lines = [huge(1), 0]
      do g = 1, size(self%surface%groups)
         associate (group => self%surface%groups(g))
            first = findloc(abs(group%y(:, 1) - 0.5_wp*sum(range)) < 0.5_wp*(range(2) - range(1)) + margin, .true., 1)
            if (first == 0) cycle
            last = findloc(abs(group%y(:, 1) - 0.5_wp*sum(range)) < 0.5_wp*(range(2) - range(1)) + margin, .true., 1, back=.true.)
            self%lines = [min(self%lines(1), group%first + first - 1), max(self%lines(2), group%first + last - 1)]
         end associate
      end do
   end subroutine expect

   !> Index in `sections` of a section
   pure integer function slot(self, number)
      class(strip), intent(in) :: self
      !> Index of the section, from 1
      integer, intent(in) :: number

      slot = number + self%turned
      if (slot > size(self%sections)) slot = slot - size(self%sections)
   end function slot

   !> Index in `sections` of a section, which is computed unless it has been computed
   integer function ready_slot(self, number, y) result(k)
      class(strip), intent(inout) :: self
      !> Index of the section, from 1
      integer, intent(in) :: number
      !> Lateral position at which it is needed [mm]; default: everywhere
      real(wp), intent(in), optional :: y
      real(wp) :: place
      logical :: everywhere

      k = self%slot(number)
      place = self%origin + self%first + (number - 1)*self%step
      associate (section => self%sections(k))
         if (abs(self%made_at(k) - place) <= rounding*self%step) then
            if (present(y)) then
               if (y >= section%valid(1) .and. y <= section%valid(2)) return
            else
               if (section%valid(1) <= -huge(1.0_wp) .and. section%valid(2) >= huge(1.0_wp)) return
            end if
         end if
         everywhere = .true.
         if (present(y)) everywhere = y < self%expected(1) .or. y > self%expected(2)
         if (.not. everywhere) then
            call self%surface%continued(place, section, self%axes, self%lines)
            everywhere = y < section%valid(1) .or. y > section%valid(2)
         end if
         if (everywhere) call self%surface%continued(place, section, self%axes)
      end associate
      self%made_at(k) = place
   end function ready_slot

   !> Heights of the visible points of a section
   subroutine heights(self, number, y, z, found)
      class(strip), intent(inout) :: self
      !> Index of the section, from 1; 0: there is none
      integer, intent(in) :: number
      !> Lateral positions, increasing [mm]
      real(wp), intent(in) :: y(:)
      !> Height at each y [mm], z down; 0 where there is no visible point
      real(wp), intent(out) :: z(:)
      !> Is there a visible point?
      logical, intent(out) :: found(:)
      integer :: k

      z = 0.0_wp
      found = .false.
      if (number == 0) return
      k = self%ready_slot(number)
      if (self%sections(k)%present) call self%sections(k)%curve%heights(y, z, found)
   end subroutine heights

   !> Lateral range of a section [mm]; the second value is below the first one if there is none
   function y_range(self, number) result(range)
      class(strip), intent(inout) :: self
      !> See `heights`
      integer, intent(in) :: number
      real(wp) :: range(2)
      integer :: k

      range = [huge(1.0_wp), -huge(1.0_wp)]
      if (number == 0) return
      k = self%ready_slot(number)
      if (self%sections(k)%present) range = self%sections(k)%curve%y_range()
   end function y_range

   !> Height of a rail above the slices on both sides of a position [mm]; 0 below the threshold for the warning when the rail is
   !> read
   !>
   !> Overshoot of the spline at sudden changes is not a surface that can be in contact.
   real(wp) function overshoot(self, along, x, y, z)
      class(slice_pair), intent(inout) :: self
      !> The sections of the rail
      type(strip), intent(in) :: along
      !> Position in track coordinates; z is the height of the rail there [mm]
      real(wp), intent(in) :: x, y, z
      real(wp) :: height(1, 2)
      logical :: found(1, 2)
      integer :: k, i

      overshoot = 0.0_wp
      associate (slices => along%surface%slices)
         k = count(slices <= along%origin + x)
         if (k == 0 .or. k == size(slices)) return
         if (k /= self%before) then
            do i = 1, 2
               call along%surface%cut(slices(k + i - 1), self%cut(i), along%axes)
            end do
            self%before = k
         end if
      end associate
      do i = 1, 2
         if (.not. self%cut(i)%present) return
         call self%cut(i)%curve%heights([y], height(:, i), found(:, i))
      end do
      if (.not. all(found)) return
      overshoot = minval(height) - z
      if (overshoot < large_overshoot) overshoot = 0.0_wp
   end function overshoot

   !> Index of the nearest section; 0 beyond the ends
   pure integer function number_at(self, place)
      class(strip), intent(in) :: self
      !> Position along the mesh [mm] or [rad]
      real(wp), intent(in) :: place

      number_at = 1 + nint((place - self%first)/self%step)
      if (number_at < 1 .or. number_at > size(self%sections)) number_at = 0
   end function number_at

   !> Height and slopes at a position between two sections
   subroutine strip_at(self, place, y, z, z_y, found, z_place)
      class(strip), intent(inout) :: self
      !> Position along the mesh [mm] or [rad], and lateral position [mm]
      real(wp), intent(in) :: place, y
      !> Height [mm], z down, and its derivative across [-]
      real(wp), intent(out) :: z, z_y
      !> Do both sections have a surface at this lateral position?
      logical, intent(out) :: found
      !> Its derivative along the mesh, per mm or rad
      real(wp), intent(out), optional :: z_place
      real(wp) :: low(4), high(4), t, other, share, before, after
      integer :: k

      z = 0.0_wp
      z_y = 0.0_wp
      if (present(z_place)) z_place = 0.0_wp
      t = (place - self%first)/self%step
      k = floor(t) + 1
      found = k >= 1 .and. k < size(self%sections)
      if (.not. found) return
      t = t - (k - 1)
      ! a position on a section is regarded as such in spite of round-off
      if (t > 1.0_wp - rounding) then
         k = k + 1
         t = 0.0_wp
      end if
      call find_on_section(self, k, y, low, found)
      if (.not. found) return
      if (t <= rounding) then
         z = low(1)
         z_y = low(2)
         if (present(z_place)) z_place = low(3)
         return
      end if
      call find_on_section(self, k + 1, y, high, found)
      if (.not. found) return
      ! Hermite's cubic
      other = 1.0_wp - t
      share = t**2*(3.0_wp - 2.0_wp*t)
      before = self%step*t*other**2
      after = self%step*t**2*other
      z = low(1) + share*(high(1) - low(1)) + before*low(3) - after*high(3)
      z_y = low(2) + share*(high(2) - low(2)) + before*low(4) - after*high(4)
      if (present(z_place)) z_place = 6.0_wp*t*other*(high(1) - low(1))/self%step + low(3)*other*(1.0_wp - 3.0_wp*t) &
         & - high(3)*t*(2.0_wp - 3.0_wp*t)
   end subroutine strip_at

   !> Point of a section; near the last point found by a parabola
   subroutine find_on_section(self, number, y, point, found)
      type(strip), intent(inout) :: self
      !> Index of the section, from 1
      integer, intent(in) :: number
      !> Lateral position [mm]
      real(wp), intent(in) :: y
      !> Height [mm], derivatives across the profile [-] and along the mesh, per mm or rad, and the derivative of the latter across
      !> the profile
      real(wp), intent(out) :: point(4)
      !> Does the section have a surface at this lateral position?
      logical, intent(out) :: found
      !> Range of the parabola about the last point [mm]; its error is of the order of 1e-12 mm
      real(wp), parameter :: nearness = 2.0e-4_wp
      real(wp) :: way
      integer :: k

      k = self%slot(number)
      associate (known => self%known(k))
         way = y - known%y
         found = abs(way) <= nearness
         if (.not. found) then
            k = self%ready_slot(number, y)
            call self%sections(k)%find(y, known, found)
            if (.not. found) return
            way = 0.0_wp
         end if
         point(1) = known%z + way*(known%z_y + 0.5_wp*way*known%z_yy)
         point(2) = known%z_y + way*known%z_yy
         point(3) = known%z_u + way*known%z_uy
         point(4) = known%z_uy
      end associate
   end subroutine find_on_section
end module contact_wheelrail_strip
