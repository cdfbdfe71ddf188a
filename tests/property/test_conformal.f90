!> Wheel on rail with curved contact patches
!>
!> A sphere in a cylindrical groove has no preferred direction about the axis of the groove: contact at any angle is the
!> same problem, rotated. Its slip is known in closed form; large radii give flat patches.
program test_conformal
   use contact_base_choices, only : contact_location, kernel_model, motion, variation
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_elastic_material, only : combine
   use contact_friction_law, only : friction_set
   use contact_grid_potential_contact, only : potential_contact
   use contact_numeric_spline, only : cubic_spline, natural_splines
   use contact_profile_curve, only : new_curve, profile_curve
   use contact_profile_request, only : profile_side
   use contact_test_harness, only : test_suite
   use contact_wheelrail_creepage, only : contact_motion, rigid_motion
   use contact_wheelrail_curved_patch, only : curved_reference, fit_creepages, straight_reference, surface_slip
   use contact_wheelrail_frame, only : new_frame
   use contact_wheelrail_memory, only : wheel_rail_memory, release_wheel_rail
   use contact_wheelrail_solve, only : solve_wheel_rail
   use contact_wheelrail_problem, only : wheel_rail_problem
   use contact_wheelrail_result, only : wheel_rail_result
   implicit none (type, external)
   !> Sphere and groove [mm], how far their centres are moved together beyond first touch [mm]
   real(wp), parameter :: sphere = 100.0_wp, groove = 105.0_wp, pressed = 0.05_wp
   type(test_suite) :: suite

   call suite%start("conformal")
   call any_direction(suite)
   call mirrored(suite)
   call flat_limit(suite)
   call inclined_coefficients(suite)
   call slip_in_groove(suite)
   call slip_on_interface(suite)
   call yawed_ball(suite)
   call fitted_slip(suite)
   call friction_by_angle(suite)
   call hard_cases(suite)
   call suite%finish()

contains

   !> A profile through points of a circle around (0, z), y rising for rails and falling for wheels
   function arc(side, z, radius, half_angle) result(curve)
      !> Member of profile_side
      integer, intent(in) :: side
      real(wp), intent(in) :: z, radius, half_angle
      type(profile_curve) :: curve
      integer, parameter :: n = 801
      real(wp) :: angle(n), s(n), f(n, 2)
      type(cubic_spline) :: splines(2)
      integer :: i

      angle = half_angle*[((2.0_wp*i - n - 1)/(n - 1), i=1, n)]
      if (side == profile_side%wheel) angle = -angle
      s = radius*abs(angle - angle(1))
      f(:, 1) = radius*sin(angle)
      f(:, 2) = z + radius*cos(angle)
      call natural_splines(s, f, splines)
      curve = new_curve(side, splines(1), splines(2))
   end function arc

   !> A sphere in a groove whose axis goes through the origin; it is moved from there towards an angle
   function sphere_in_groove(angle, location) result(problem)
      !> From the vertical, positive towards the gauge side [rad]
      real(wp), intent(in) :: angle
      !> Member of contact_location
      integer, intent(in) :: location
      type(wheel_rail_problem) :: problem

      problem%rail = arc(profile_side%rail, 0.0_wp, groove, 1.45_wp)
      ! the profile is that of a wheel whose lowest point is its origin
      problem%wheel = arc(profile_side%wheel, -sphere, sphere, 1.45_wp)
      associate (spec => problem%spec)
         spec%track%gaught = -1.0_wp
         spec%wheelset%fbdist = 0.0_wp
         spec%wheelset%fbpos = 0.0_wp
         spec%wheelset%nomradw = sphere
         spec%wheelset%y = -(groove - sphere + pressed)*sin(angle)
         spec%wheelset%z = sphere + (groove - sphere + pressed)*cos(angle)
         spec%search%location = location
         spec%search%dx = 0.2_wp
         spec%search%ds = 0.4_wp
         spec%wheelset%vs = 1000.0_wp
      end associate
      associate (patch => problem%template)
         patch%model%material = combine([0.28_wp, 0.28_wp], [80000.0_wp, 80000.0_wp])
         patch%motion = motion%none
         patch%grid%my = 1
         patch%mu = 0.3_wp
         patch%settings%eps = 1.0e-7_wp
      end associate
      ! the pitch rate of a wheel that rolls at the bottom
      problem%spec%wheelset%vpitch = -problem%spec%wheelset%vs/sphere
   end function sphere_in_groove

   subroutine solve(suite, problem, result, what)
      type(test_suite), intent(inout) :: suite
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_result), intent(out) :: result
      character(len=*), intent(in) :: what
      type(wheel_rail_memory) :: memory
      type(error_type), allocatable :: error
      type(log_type) :: log

      call solve_wheel_rail(problem, memory, log, result, error)
      if (allocated(error)) then
         call suite%check(.false., what // ": " // full_text(error))
         allocate(result%patches(0))
      end if
      call release_wheel_rail(memory)
   end subroutine solve

   !> Size and direction of the force, and its lever, do not depend on where in the groove the sphere is
   subroutine any_direction(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: angle(3) = [0.3_wp, 0.7_wp, 1.1_wp]
      type(wheel_rail_result) :: bottom, side
      real(wp) :: force
      integer :: k

      call solve(suite, sphere_in_groove(0.0_wp, contact_location%conformal), bottom, "bottom")
      call suite%check(size(bottom%patches) == 1, "one patch at the bottom")
      if (size(bottom%patches) /= 1) return
      force = norm2(bottom%force_track)
      call suite%check(force > 1000.0_wp, "there is a force")
      call suite%check(maxval(abs(bottom%patches(1)%curve(3, :))) > 0.1_wp, "the patch is curved")
      call suite%close_to(bottom%force_track(2), 0.0_wp, 1.0e-9_wp*force, "no lateral force at the bottom")
      do k = 1, size(angle)
         call solve(suite, sphere_in_groove(angle(k), contact_location%conformal), side, "side")
         call suite%check(size(side%patches) == 1, "one patch at the side")
         if (size(side%patches) /= 1) cycle
         ! rows have other positions relative to the deepest point
         call suite%close_to(norm2(side%force_track), force, 2.0e-3_wp*force, "the same force in any direction")
         call suite%close_to(side%patches(1)%contact%pmax/bottom%patches(1)%contact%pmax, 1.0_wp, 0.01_wp, &
            & "the same largest pressure")
         call suite%close_to(side%force_track(2:3)/force, [-sin(angle(k)), cos(angle(k))], 2.0e-3_wp, "the force is rotated")
         ! all pressures are normal to the groove: no moment about its axis, where the marker of the rail is
         ! (lever in mm, the radius is 105)
         call suite%close_to(side%moment_rail(1)/force, 0.0_wp, 2.0e-3_wp, "no moment about the axis of the groove")
         call suite%close_to(side%patches(1)%contact%pen, pressed, 1.0e-3_wp*pressed, "approach along the normal")
      end do
   end subroutine any_direction

   !> Reflection of a problem with friction reflects its solution
   subroutine mirrored(suite)
      type(test_suite), intent(inout) :: suite
      type(wheel_rail_problem) :: problem
      type(wheel_rail_result) :: one, other
      real(wp), parameter :: angle = 0.5_wp

      problem = sphere_in_groove(angle, contact_location%conformal)
      problem%template%motion = motion%steady_rolling
      call solve(suite, problem, one, "gauge side")
      problem = sphere_in_groove(-angle, contact_location%conformal)
      problem%template%motion = motion%steady_rolling
      call solve(suite, problem, other, "field side")
      call suite%check(size(one%patches) == 1 .and. size(other%patches) == 1, "one patch each")
      if (size(one%patches) /= 1 .or. size(other%patches) /= 1) return
      associate (a => one%patches(1), b => other%patches(1))
         call suite%check(abs(a%contact%fx) > 10.0_wp, "friction acts")
         call suite%close_to([a%force(1), -a%force(2), a%force(3)], b%force, 1.0e-5_wp*b%force(3), "forces are reflected")
         call suite%close_to([-a%moment(1), a%moment(2), -a%moment(3)], b%moment, 1.0e-3_wp*maxval(abs(b%moment)), &
            & "moments are reflected")
         call suite%close_to([a%contact%cksi, -a%contact%ceta, -a%contact%cphi], &
            & [b%contact%cksi, b%contact%ceta, b%contact%cphi], 1.0e-6_wp*abs(b%contact%cksi) + 1.0e-9_wp, "creepages")
         call suite%equal(a%contact%nslip, b%contact%nslip, "as many elements slip")
         ! values in the axes of the rows agree with the tractions
         call suite%close_to(a%tilde_fn, a%contact%grid%dx*a%contact%grid%dy*sum(a%contact%pn), 1.0e-9_wp*a%tilde_fn, "plain sum")
      end associate
   end subroutine mirrored

   !> A ball on a rail with a radius of 2 m: curved, straight and flat references agree
   !>
   !> Rows beside the middle of the ball are nearer to its axle by s**2/(2 r): the creepages differ by the square of
   !> the width of the patch over the radius, that is in proportion to the approach.
   subroutine flat_limit(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: locations(3) = [contact_location%locus, contact_location%locus_extended, contact_location%conformal]
      real(wp), parameter :: approach(2) = [0.04_wp, 0.01_wp]
      type(wheel_rail_problem) :: problem
      type(wheel_rail_result) :: result(3)
      real(wp) :: difference(2), force(2)
      integer :: i, k

      do i = 1, 2
         do k = 1, 3
            problem = sphere_in_groove(0.0_wp, locations(k))
            problem%rail = arc(profile_side%rail, -2000.0_wp, 2000.0_wp, 0.05_wp)
            problem%spec%wheelset%y = 0.0_wp
            problem%spec%wheelset%z = approach(i)
            problem%spec%wheelset%yaw = 0.002_wp
            problem%spec%wheelset%vpitch = 1.001_wp*problem%spec%wheelset%vpitch
            problem%spec%search%dx = sqrt(approach(i))
            problem%spec%search%ds = problem%spec%search%dx
            problem%template%motion = motion%steady_rolling
            call solve(suite, problem, result(k), "ball on rail")
         end do
         call suite%check(all([(size(result(k)%patches) == 1, k=1, 3)]), "one patch each")
         if (.not. all([(size(result(k)%patches) == 1, k=1, 3)])) return
         associate (flat => result(1)%patches(1)%contact, straight => result(2)%patches(1)%contact)
            call suite%check(abs(flat%fx) > 10.0_wp .and. abs(flat%fy) > 10.0_wp, "creep forces act")
            call suite%close_to(maxval(abs(straight%h - flat%h)), 0.0_wp, 1.0e-9_wp, "distance over a plane, row by row")
            call suite%close_to(straight%fn, flat%fn, 1.0e-6_wp*flat%fn, "the same pressures over a plane")
            call suite%close_to(straight%ceta, flat%ceta, 1.0e-3_wp*abs(flat%ceta), "lateral creepage, straight")
            call suite%close_to(straight%cphi, flat%cphi, 1.0e-9_wp, "spin, straight")
            difference(i) = flat%cksi - straight%cksi
            force(i) = abs(straight%fx/flat%fx - 1.0_wp)
         end associate
         call suite%close_to(result(3)%patches(1)%tilde_fn/result(1)%patches(1)%contact%fn, 1.0_wp, 0.1_wp*approach(i), &
            & "nearly flat: normal force")
         call suite%close_to(result(3)%force_track/result(2)%force_track, [1.0_wp, 1.0_wp, 1.0_wp], 0.2_wp*approach(i), &
            & "nearly flat: forces")
         call suite%check(allocated(result(3)%patches(1)%curve) .and. .not. allocated(result(2)%patches(1)%curve), &
            & "a curve is given for conformal contact only")
      end do
      call suite%close_to(difference(1)/difference(2), 4.0_wp, 0.2_wp, "extended slip decreases with the approach")
      call suite%check(force(2) < 0.4_wp*force(1), "its effect on the force, too")
   end subroutine flat_limit

   !> Corrected coefficients: those of half-spaces in a plane, a stiffer groove, all variants; bilinear ones
   subroutine inclined_coefficients(suite)
      type(test_suite), intent(inout) :: suite
      type(wheel_rail_problem) :: problem
      type(wheel_rail_result) :: plain, corrected
      real(wp) :: first
      integer :: variant

      call solve(suite, sphere_in_groove(0.0_wp, contact_location%conformal), plain, "half-space")
      problem = sphere_in_groove(0.0_wp, contact_location%conformal)
      problem%template%model%kernel = kernel_model%bilinear
      call solve(suite, problem, corrected, "bilinear")
      if (size(plain%patches) /= 1 .or. size(corrected%patches) /= 1) return
      call suite%close_to(corrected%patches(1)%contact%fn, plain%patches(1)%contact%fn, 5.0e-3_wp*plain%patches(1)%contact%fn, &
         & "bilinear pressures")
      call suite%check(abs(corrected%patches(1)%contact%fn - plain%patches(1)%contact%fn) > 1.0e-6_wp*plain%patches(1)%contact%fn, &
         & "bilinear pressures are others")
      ! pressures on the other flank have the effect cos(alpha) of that in a plane
      do variant = 1, 4
         problem = sphere_in_groove(0.0_wp, contact_location%conformal)
         problem%template%model%kernel = kernel_model%conformal
         allocate(problem%template%model%inclination)
         problem%template%model%inclination%variant = variant
         problem%template%model%inclination%uniform = variant == 1
         call solve(suite, problem, corrected, "corrected")
         if (size(corrected%patches) /= 1) cycle
         associate (gain => corrected%patches(1)%contact%fn/plain%patches(1)%contact%fn - 1.0_wp)
            call suite%check(gain > 1.0e-4_wp .and. gain < 0.01_wp, "a groove with corrected coefficients is stiffer")
            if (variant == 1) first = gain
            ! without tangential tractions the first three are the same; the inclination is nearly uniform
            if (variant < 4) call suite%close_to(gain, first, 0.01_wp*first, "variants of the correction")
         end associate
      end do
      ! over a plane there is nothing to correct
      problem = sphere_in_groove(0.0_wp, contact_location%locus)
      call solve(suite, problem, plain, "flat")
      problem%template%model%kernel = kernel_model%conformal
      call solve(suite, problem, corrected, "flat, corrected")
      call suite%close_to(corrected%force_track, plain%force_track, 0.0_wp, "nothing to correct in a plane")
   end subroutine inclined_coefficients

   !> A ball that rolls at the bottom of a groove slips by V (1 - cos) on the flanks, everywhere along the track
   subroutine slip_in_groove(suite)
      type(test_suite), intent(inout) :: suite
      type(wheel_rail_problem) :: problem
      type(wheel_rail_result) :: result
      real(wp) :: expected, worst, place(2), normal(2), height
      integer :: ix, iy

      problem = sphere_in_groove(0.0_wp, contact_location%conformal)
      problem%template%motion = motion%steady_rolling
      call solve(suite, problem, result, "ball in a groove")
      if (size(result%patches) /= 1) return
      worst = 0.0_wp
      associate (contact => result%patches(1)%contact, curve => result%patches(1)%curve)
         do iy = 1, contact%grid%my
            ! the point of the ball on the normal of the row, from the ball's centre
            place = curve(1:2, iy) - [0.0_wp, groove - sphere + pressed]
            normal = [-sin(curve(3, iy)), cos(curve(3, iy))]
            height = -dot_product(place, normal) + sqrt(dot_product(place, normal)**2 - dot_product(place, place) + sphere**2)
            place = place + height*normal
            ! the rail is at rest, the wheel's lowest point, too
            expected = 1.0_wp - place(2)/sphere
            do ix = 1, contact%grid%mx
               if (contact%pn(ix, iy) > 0.0_wp) worst = max(worst, abs(contact%wx(ix, iy)/contact%dq + expected))
            end do
         end do
         call suite%check(maxval(abs(curve(3, :))) > 0.1_wp, "angles are large")
         call suite%close_to(worst, 0.0_wp, 1.0e-5_wp, "slip on the flanks of a groove")
      end associate
   end subroutine slip_in_groove

   !> Particles slide on the surface of the stiffer body
   subroutine slip_on_interface(suite)
      type(test_suite), intent(inout) :: suite
      type(rigid_motion) :: rail, wheel
      type(curved_reference) :: curve
      type(potential_contact) :: grid
      real(wp), allocatable :: slip(:, :, :)
      real(wp) :: on_rail(41, 3), on_wheel(41, 3), angle
      real(wp), parameter :: v = 1000.0_wp, radius = 400.0_wp
      integer :: ix

      grid = potential_contact(41, 3, -10.25_wp, -0.75_wp, 0.5_wp, 0.5_wp)
      curve = straight_reference(new_frame([0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, 0.0_wp), grid)
      wheel%origin = [0.0_wp, 0.0_wp, -radius]
      wheel%velocity = [v, 0.0_wp, 0.0_wp]
      wheel%rotation = [0.0_wp, -v/radius, 0.0_wp]
      on_rail = 0.0_wp
      do ix = 1, grid%mx
         on_wheel(ix, :) = sqrt(radius**2 - grid%x(ix)**2) - radius
      end do
      call surface_slip(rail, wheel, curve, grid, on_rail, on_wheel, 0.0_wp, slip)
      ! a rigid rail: the wheel's surface moves backwards along the rail by V cos
      do ix = 2, grid%mx - 1
         angle = asin(grid%x(ix)/radius)
         call suite%close_to(slip(ix, 2, 1), -v*(1.0_wp - cos(angle)), 1.0e-9_wp*v, "slip on a rigid rail")
      end do
      call surface_slip(rail, wheel, curve, grid, on_rail, on_wheel, 1.0_wp, slip)
      ! a rigid wheel: the rail moves backwards along the wheel's surface by V cos, the wheel by V
      do ix = 2, grid%mx - 1
         angle = asin(grid%x(ix)/radius)
         call suite%close_to(slip(ix, 2, 1), v*(1.0_wp - cos(angle)), 1.0e-7_wp*v, "slip on a rigid wheel")
      end do
      call surface_slip(rail, wheel, curve, grid, on_rail, on_wheel, 0.5_wp, slip)
      call suite%close_to(slip(2:40, 2, 1), spread(0.0_wp, 1, 39), 1.0e-6_wp*v, "no slip midway between equal bodies")
   end subroutine slip_on_interface

   !> A ball that rolls obliquely on a plane slips in its direction of rolling, wherever its axle points: the velocity normal
   !> to the contact has parts along both directions of the deformed surface
   subroutine yawed_ball(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: yaw(5) = [0.0_wp, 0.3_wp, -0.3_wp, 0.8_wp, 1.0_wp], rate = 10.0_wp
      integer, parameter :: location(2) = [contact_location%locus_extended, contact_location%conformal]
      type(wheel_rail_problem) :: problem
      type(wheel_rail_result) :: straight, oblique
      real(wp) :: along, across
      integer :: k, j

      do j = 1, size(location)
         do k = 1, size(yaw)
            problem = sphere_in_groove(0.0_wp, location(j))
            problem%rail = plane_rail()
            problem%template%motion = motion%steady_rolling
            associate (set => problem%spec%wheelset)
               set%z = pressed
               set%yaw = yaw(k)
               set%vs = rate*sphere*cos(yaw(k))
               set%vy = rate*sphere*sin(yaw(k))
               set%vpitch = -rate
            end associate
            call solve(suite, problem, oblique, "oblique ball")
            call suite%equal(size(oblique%patches), 1, "one patch of a ball")
            if (size(oblique%patches) /= 1) return
            if (k == 1) straight = oblique
            ! velocities are divided by the forward speed
            along = straight%patches(1)%contact%cksi
            call suite%check(along < -1.0e-4_wp, "a ball that is pressed in creeps")
            across = along*tan(yaw(k))
            call suite%close_to(oblique%patches(1)%contact%cksi, along, 0.02_wp*abs(along), "creepage of an oblique ball")
            ! elements are larger across the track than along it: slopes of rows are rougher
            call suite%close_to(oblique%patches(1)%contact%ceta, across, 0.02_wp*abs(along) + 0.02_wp*abs(across), &
               & "its lateral creepage")
            call suite%equal(oblique%patches(1)%contact%ncon, straight%patches(1)%contact%ncon, "its elements in contact")
         end do
      end do
   end subroutine yawed_ball

   !> A level rail
   function plane_rail() result(curve)
      type(profile_curve) :: curve
      type(cubic_spline) :: splines(2)
      real(wp) :: s(81), f(81, 2)
      integer :: i

      s = [(1.0_wp*(i - 1), i=1, 81)]
      f(:, 1) = s - 40.0_wp
      f(:, 2) = 0.0_wp
      call natural_splines(s, f, splines)
      curve = new_curve(profile_side%rail, splines(1), splines(2))
   end function plane_rail

   !> Creepages and spin are recovered, other components remain
   subroutine fitted_slip(suite)
      type(test_suite), intent(inout) :: suite
      type(potential_contact) :: grid
      type(contact_motion) :: motion
      logical :: inside(7, 5)
      real(wp) :: slip(7, 5, 2)
      integer :: ix, iy

      grid = potential_contact(7, 5, -1.0_wp, -2.0_wp, 0.5_wp, 0.4_wp)
      do iy = 1, grid%my
         do ix = 1, grid%mx
            slip(ix, iy, :) = [0.001_wp - 0.0003_wp*grid%y(iy), -0.002_wp + 0.0003_wp*grid%x(ix)]
         end do
      end do
      inside = .true.
      inside(:, 1) = .false.
      slip(:, 1, 1) = slip(:, 1, 1) + 0.1_wp
      call fit_creepages(grid, inside, slip, motion)
      call suite%close_to([motion%cksi, motion%ceta, motion%cphi], [0.001_wp, -0.002_wp, 0.0003_wp], 1.0e-15_wp, "fitted creepages")
      call suite%close_to(maxval(abs(slip(:, 2:, :))), 0.0_wp, 1.0e-15_wp, "nothing remains")
      call suite%close_to(slip(:, 1, 1), [(0.1_wp, ix=1, 7)], 1.0e-15_wp, "other components remain")
      ! no element inside, one element inside: no division by zero
      motion = contact_motion()
      motion%cphi = 0.0005_wp
      slip(:, :, :) = 0.01_wp
      inside = .false.
      call fit_creepages(grid, inside, slip, motion)
      call suite%close_to([motion%cksi, motion%ceta, motion%cphi], [0.0_wp, 0.0_wp, 0.0005_wp], 0.0_wp, "no element inside")
      slip(:, :, :) = 0.01_wp
      inside(4, 2) = .true.
      call fit_creepages(grid, inside, slip, motion)
      call suite%close_to(slip(4, 2, :), [0.0_wp, 0.0_wp], 1.0e-15_wp, "one element inside")
      call suite%close_to(motion%cphi, 0.0005_wp, 0.0_wp, "one element does not determine the spin")
   end subroutine fitted_slip

   !> With friction by angle each row has that of its inclination
   subroutine friction_by_angle(suite)
      type(test_suite), intent(inout) :: suite
      type(wheel_rail_problem) :: problem
      type(wheel_rail_result) :: result
      integer :: iy

      problem = sphere_in_groove(0.0_wp, contact_location%conformal)
      problem%template%motion = motion%steady_rolling
      problem%spec%wheelset%vpitch = 1.1_wp*problem%spec%wheelset%vpitch
      problem%variation = variation%by_angle
      problem%control_point = [-0.2_wp, 0.2_wp]
      problem%control = [friction_set(fstat=0.1_wp, fkin=0.1_wp), friction_set(fstat=0.5_wp, fkin=0.5_wp)]
      call solve(suite, problem, result, "friction by angle")
      if (size(result%patches) /= 1) return
      associate (patch => result%patches(1))
         call suite%check(patch%friction_varies, "friction varies")
         do iy = 1, patch%contact%grid%my
            call suite%close_to(patch%contact%mu(1, iy), 0.3_wp + min(0.2_wp, max(-0.2_wp, patch%curve(3, iy))), 1.0e-12_wp, &
               & "friction of a row")
         end do
         ! full sliding: the bound is reached in each row
         call suite%close_to(sum(hypot(patch%contact%px, patch%contact%py)), sum(patch%contact%mu*patch%contact%pn), &
            & 1.0e-5_wp*sum(patch%contact%pn), "full sliding")
      end associate
   end subroutine friction_by_angle

   !> Rows at the end of a rail, no contact, nearly no contact, few elements, no friction, only geometry
   subroutine hard_cases(suite)
      type(test_suite), intent(inout) :: suite
      type(wheel_rail_problem) :: problem
      type(wheel_rail_result) :: result
      real(wp) :: force
      integer :: k

      problem = sphere_in_groove(0.0_wp, contact_location%conformal)
      problem%rail = arc(profile_side%rail, 0.0_wp, groove, 0.06_wp)
      call solve(suite, problem, result, "short rail")
      call suite%check(size(result%patches) == 1, "a rail that ends inside the region has a patch")
      call suite%check(finite(result) .and. result%force_track(3) > 0.0_wp, "contact at both ends of a rail")

      problem = sphere_in_groove(0.0_wp, contact_location%conformal)
      problem%spec%wheelset%z = problem%spec%wheelset%z - 1.0_wp
      call solve(suite, problem, result, "no contact")
      call suite%check(size(result%patches) == 0 .and. norm2(result%force_track) <= 0.0_wp, "no contact")

      problem = sphere_in_groove(0.2_wp, contact_location%conformal)
      associate (share => (groove - sphere + 1.0e-6_wp)/(groove - sphere + pressed), set => problem%spec%wheelset)
         set%y = set%y*share
         set%z = sphere + (set%z - sphere)*share
      end associate
      call solve(suite, problem, result, "a touch")
      call suite%check(finite(result) .and. norm2(result%force_track) < 1.0_wp, "a touch")

      problem = sphere_in_groove(0.0_wp, contact_location%conformal)
      problem%max_elements = 60
      problem%template%motion = motion%steady_rolling
      problem%template%mu = 0.0_wp
      call solve(suite, problem, result, "few elements")
      call suite%check(finite(result) .and. size(result%patches) == 1, "few elements without friction")
      if (size(result%patches) == 1) call suite%check(result%patches(1)%contact%grid%mx <= 20, "elements are doubled")

      problem = sphere_in_groove(0.0_wp, contact_location%conformal)
      problem%geometry_only = .true.
      call solve(suite, problem, result, "geometry only")
      call suite%check(size(result%patches) == 1 .and. norm2(result%force_track) <= 0.0_wp, "geometry only")
      if (size(result%patches) == 1) call suite%check(allocated(result%patches(1)%curve), "geometry only has a curve")

      ! a prescribed force is found at any angle and for any coefficients
      do k = 0, 1
         problem = sphere_in_groove(0.0_wp, contact_location%conformal)
         problem%force_prescribed = .true.
         problem%template%sensitivity = 2
         problem%spec%wheelset%fz = 2500.0_wp
         problem%template%motion = motion%steady_rolling
         problem%template%settings%eps = 1.0e-5_wp
         if (k == 1) then
            problem%template%model%kernel = kernel_model%conformal
            allocate(problem%template%model%inclination)
         end if
         call solve(suite, problem, result, "prescribed force")
         force = result%force_track(3)
         call suite%check(result%status%is_solved(), "the force is reached")
         call suite%close_to(force, 2500.0_wp, 0.3_wp, "prescribed force")
      end do

      ! another reference, the same contact
      problem = sphere_in_groove(0.5_wp, contact_location%first_contact)
      call solve(suite, problem, result, "deepest point")
      call suite%check(size(result%patches) == 1, "one patch at the deepest point")
      if (size(result%patches) == 1) call suite%check(abs(result%patches(1)%delta - 0.5_wp) < 0.01_wp, "angle of the deepest point")
   end subroutine hard_cases

   !> Are all forces numbers?
   pure logical function finite(result)
      type(wheel_rail_result), intent(in) :: result
      finite = all(abs(result%force_track) < 1.0e10_wp) .and. all(abs(result%moment_rail) < 1.0e12_wp)
   end function finite
end program test_conformal
