!> Derivatives of the references of the patches with respect to the position of the wheelset: positions and contact angles
!>
!> The gap at each mesh point changes with the contact locus. These changes are computed from the points of the locus and their
!> derivatives, by central differences of the formula of one point. With them the search for regions is repeated on changed gaps,
!> since joining, rotation and weights of patches follow only from the search. No contact problem is solved.
module contact_wheelrail_reference_motion
   use contact_base_kinds, only : wp
   use contact_wheelrail_displacements, only : coordinate, displaced
   use contact_wheelrail_flat_patch, only : lattice_lead, patch_frame
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_gap, only : gap_curve, no_surface
   use contact_wheelrail_geometry, only : wheel_rail_geometry
   use contact_wheelrail_locus, only : locus_point
   use contact_wheelrail_placement, only : wheel_rail_placement
   use contact_wheelrail_problem, only : wheel_rail_problem
   use contact_wheelrail_region, only : contact_region, parts_of
   use contact_wheelrail_regions, only : find_regions
   implicit none (type, external)
   private

   public :: reference_motion, find_reference_motions

   !> Motion of the reference of one patch per unit of a displacement of the wheelset
   type :: reference_motion
      !> Derivatives of its origin in the track [mm], and of the contact angle [rad]. If the reference moves relative to the
      !> elements, the origin is a point that moves with these
      real(wp) :: origin(3) = 0.0_wp, angle = 0.0_wp
      !> Derivatives of the factors between the parts of a blended patch, shape (parts, parts); unallocated if there are none
      real(wp), allocatable :: interaction(:, :)
   end type reference_motion

   !> Derivatives of the gap [mm] and of the position of the locus along the track [mm] per unit, shape (points, coordinates)
   type :: gap_motion
      real(wp), allocatable :: gap(:, :), x(:, :)
   end type gap_motion

   !> Steps of central differences: displacements [mm] and rotations [rad] of the wheelset for points of the locus, of the position
   !> on the profile [mm], and displacements and rotations for regions. Errors of the first are 1e-8 of the derivatives. Regions are
   !> not smooth where points of the mesh come into contact or leave it: their steps are small compared to the approach of a light
   !> wheel, 2e-3 mm with 100 N, and round-off of a position in the track, 1e-13 mm, is 1e-6 of the motion of a patch
   real(wp), parameter :: locus_step(4) = [1.0e-4_wp, 1.0e-4_wp, 1.0e-6_wp, 1.0e-6_wp], place_step = 1.0e-4_wp
   real(wp), parameter :: region_step(4) = [1.0e-7_wp, 1.0e-7_wp, 1.0e-10_wp, 1.0e-10_wp]
   !> Gaps that are included: those of points beside others with a gap of at most this value, or that of near misses, up to this
   !> number of points away, as they determine the border of a contact, and the parabola of a small one [mm]
   real(wp), parameter :: near_contact = 0.02_wp
   integer, parameter :: points_beside = 2

contains

   !> Motions of the references of all patches
   subroutine find_reference_motions(problem, geometry, z, motions, is_smooth)
      !> Profiles, and settings of the search for patches
      type(wheel_rail_problem), intent(in) :: problem
      !> Gap and position of the bodies
      type(wheel_rail_geometry), intent(in) :: geometry
      !> Height at which regions are searched [mm]
      real(wp), intent(in) :: z
      !> Motions, shape (patches, coordinates); of size zero if displacements to both sides change the number of patches or parts
      type(reference_motion), allocatable, intent(out) :: motions(:, :)
      !> Is the number of patches and parts the same for all displacements?
      logical, intent(out) :: is_smooth
      type(gap_motion) :: whole
      type(gap_motion), allocatable :: near(:)
      type(contact_region), allocatable :: at(:), low(:), high(:)
      type(wheel_rail_placement) :: at_gap
      type(gap_curve) :: gap
      type(gap_curve), allocatable :: closer(:)
      real(wp) :: step
      integer :: k, number
      logical :: below, above

      at_gap = displaced(geometry%placement, coordinate%z, geometry%gap_height - z)
      call differentiate_gap(problem, geometry, at_gap, geometry%gap, z, whole)
      allocate(near(0))
      if (allocated(geometry%closer)) then
         deallocate(near)
         allocate(near(size(geometry%closer)))
         do k = 1, size(near)
            call differentiate_gap(problem, geometry, at_gap, geometry%closer(k), z, near(k))
         end do
      end if
      is_smooth = .true.
      gap = geometry%gap
      allocate(closer(0))
      if (size(near) > 0) closer = geometry%closer
      call regions_at(0, 0.0_wp, at)
      allocate(motions(size(at), coordinate%count))
      do number = 1, coordinate%count
         step = region_step(number)
         ! regions are those of a fixed height, see `lowest_for_regions`
         if (number == coordinate%z .and. geometry%lowest_for_regions > z) cycle
         call regions_at(number, -step, low)
         call regions_at(number, step, high)
         below = alike(at, low)
         above = alike(at, high)
         is_smooth = is_smooth .and. below .and. above
         if (.not. (below .or. above)) then
            deallocate(motions)
            allocate(motions(0, coordinate%count))
            return
         end if
         ! if a patch appears or vanishes, the derivative is the one-sided one to the other side
         if (.not. below) low = at
         if (.not. above) high = at
         if (.not. (below .and. above)) step = 0.5_wp*step
         do k = 1, size(at)
            call difference(problem, geometry, low(k), high(k), 2.0_wp*step, motions(k, number))
         end do
      end do

   contains

      !> Regions after a displacement
      subroutine regions_at(number, step, regions)
         !> Coordinate, 0 for none
         integer, intent(in) :: number
         real(wp), intent(in) :: step
         type(contact_region), allocatable, intent(out) :: regions(:)
         type(contact_region), allocatable :: misses(:)
         integer :: k

         if (number > 0) then
            call displace(geometry%gap, whole, number, step, gap)
            do k = 1, size(near)
               call displace(geometry%closer(k), near(k), number, step, closer(k))
            end do
         end if
         call find_regions(gap, max(z, geometry%lowest_for_regions) - geometry%gap_height, problem%spec%search, &
            & problem%weight_power, regions, misses, closer)
      end subroutine regions_at
   end subroutine find_reference_motions

   !> Gaps and longitudinal positions after a displacement
   pure subroutine displace(from, motion, number, step, to)
      !> Gap without displacement, and its derivatives
      type(gap_curve), intent(in) :: from
      type(gap_motion), intent(in) :: motion
      !> Coordinate, and displacement [mm] or [rad]
      integer, intent(in) :: number
      real(wp), intent(in) :: step
      !> Its copy; gaps and positions are set
      type(gap_curve), intent(inout) :: to

      to%gap(:) = from%gap + step*motion%gap(:, number)
      to%x(:) = from%x + step*motion%x(:, number)
   end subroutine displace

   !> Have two searches found the same numbers of patches and parts?
   pure logical function alike(a, b)
      type(contact_region), intent(in) :: a(:), b(:)
      integer :: k

      alike = size(a) == size(b)
      if (.not. alike) return
      do k = 1, size(a)
         alike = alike .and. size(parts_of(a(k))) == size(parts_of(b(k)))
      end do
   end function alike

   !> Difference quotient of a reference
   subroutine difference(problem, geometry, low, high, step, motion)
      !> With the size of elements
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_geometry), intent(in) :: geometry
      type(contact_region), intent(in) :: low, high
      !> Distance between the two [mm] or [rad]
      real(wp), intent(in) :: step
      type(reference_motion), intent(inout) :: motion
      type(frame) :: from, to
      real(wp) :: sides(2), lead(2)

      sides = [problem%spec%search%dx, problem%spec%search%ds]
      from = patch_frame(geometry%rail_in_track, geometry%placement, low)
      to = patch_frame(geometry%rail_in_track, geometry%placement, high)
      lead = lattice_lead(geometry%rail_in_track, geometry%placement, high, to, sides) &
         & - lattice_lead(geometry%rail_in_track, geometry%placement, low, from, sides)
      motion%origin = (to%origin - from%origin - matmul(from%axes(:, 1:2), lead))/step
      motion%angle = (high%alpha - low%alpha)/step
      if (allocated(high%interaction)) motion%interaction = (high%interaction - low%interaction)/step
   end subroutine difference

   !> Derivatives of the gap at the points of a mesh at which it is small
   subroutine differentiate_gap(problem, geometry, placement, gap, z, motion)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_geometry), intent(in) :: geometry
      !> Position of the bodies when the gap was measured
      type(wheel_rail_placement), intent(in) :: placement
      type(gap_curve), intent(in) :: gap
      !> Height at which regions are searched [mm]
      real(wp), intent(in) :: z
      type(gap_motion), intent(out) :: motion
      type(wheel_rail_placement) :: low(4), high(4)
      real(wp) :: point(3), along(3), by(3), local(3), place, across, near
      logical :: rolls
      integer :: i, number

      allocate(motion%gap(gap%n, coordinate%count), motion%x(gap%n, coordinate%count), source=0.0_wp)
      rolls = placement%roller_radius > 0.0_wp
      near = max(near_contact, problem%spec%search%g_miss)
      do number = 1, coordinate%count
         low(number) = displaced(placement, number, -locus_step(number))
         high(number) = displaced(placement, number, locus_step(number))
      end do
      associate (wheel => problem%wheel, rail => geometry%rail_in_track)
         do i = 1, gap%n
            if (gap%gap(i) >= no_surface) cycle
            if (minval(gap%gap(max(1, i - points_beside):min(gap%n, i + points_beside))) - (z - geometry%gap_height) > near) cycle
            point = [gap%x(i), gap%y(i), gap%z(i) + placement%roller_drop(gap%x(i), gap%z(i)) - gap%gap(i)]
            local = placement%wheel%to_local(point)
            place = wheel%s_at(local(2))
            along = (locus_point(wheel, placement, place + place_step, rail) &
               & - locus_point(wheel, placement, place - place_step, rail))/(2.0_wp*place_step)
            do number = 1, coordinate%count
               by = 0.0_wp
               ! if the height is searched, the gap is measured once and serves all heights
               if ((rolls .and. .not. (number == coordinate%z .and. problem%force_prescribed)) &
                  & .or. number == coordinate%roll .or. number == coordinate%yaw) then
                  by = (locus_point(wheel, high(number), place, rail) - locus_point(wheel, low(number), place, rail)) &
                     & /(2.0_wp*locus_step(number))
               else
                  ! the locus moves with the wheel
                  by(merge(2, 3, number == coordinate%y)) = 1.0_wp
               end if
               ! the position on the profile that moves to the same position in the track
               across = -by(2)/along(2)
               by = by + across*along
               motion%x(i, number) = by(1)
               motion%gap(i, number) = -by(3)
               if (rolls) motion%gap(i, number) = motion%gap(i, number) + by(1)*(placement%roller_drop(gap%x(i) + place_step, &
                  & gap%z(i)) - placement%roller_drop(gap%x(i) - place_step, gap%z(i)))/(2.0_wp*place_step)
            end do
         end do
      end associate
   end subroutine differentiate_gap
end module contact_wheelrail_reference_motion
