!> Hertz's solution: closed forms, printed values of the original program, round trips, extremes
program test_hertz
   use contact_base_choices, only : normal_control
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_normal_estimate, only : elliptic_pressure, parabolic_pressure, sdec_pressure
   use contact_normal_hertz, only : axis_ratio, curvature_ratio, hertz_by_axes, hertz_by_curvatures, &
      & hertz_by_ratio, hertz_contact, hertz_load, line_contact_by_axes, line_contact_by_curvature
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> Closed forms with powers and roots
   real(wp), parameter :: closed = 200.0_wp*epsilon(1.0_wp)
   !> Printed with four digits
   real(wp), parameter :: printed = 6.0e-4_wp
   type(test_suite) :: suite

   call suite%start("hertz")
   call circular(suite)
   call printed_values(suite)
   call ratios(suite)
   call round_trips(suite)
   call line_contacts(suite)
   call no_load(suite)
   call displacement_of_centre(suite)
   call pressures(suite)
   call suite%finish()

contains

   !> Sphere on a plane: a**2 = R pen, F = 4/3 (1 - nu**2)-modulus sqrt(R) pen**(3/2); Johnson (1985), section 4.2
   subroutine circular(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: radius = 30.0_wp, pen = 0.02_wp, gg = 8.0e4_wp, nu = 0.3_wp
      ! Two equal bodies: E* of Johnson is G/(1 - nu) of the combined material
      real(wp), parameter :: modulus = gg/(1.0_wp - nu), curvature = 0.5_wp/radius
      type(hertz_contact) :: hertz

      hertz = hertz_by_curvatures(hertz_load(normal_control%approach, pen=pen, modulus=modulus), curvature, curvature)
      call suite%close_to([hertz%aa, hertz%bb, hertz%cp], spread(sqrt(radius*pen), 1, 3), closed, "radius of contact")
      call suite%close_to(hertz%fn, 4.0_wp/3.0_wp*modulus*sqrt(radius*pen)*pen, closed, "force", relative=.true.)
      call suite%close_to(hertz%rho, 2.0_wp*radius, closed, "effective radius", relative=.true.)
   end subroutine circular

   !> Figures of the reference results: cattaneo, fastsim, tractcurv; sample of the file layout
   subroutine printed_values(suite)
      type(test_suite), intent(inout) :: suite
      type(hertz_contact) :: hertz
      real(wp), parameter :: steel = 82000.0_wp/0.72_wp

      hertz = hertz_by_axes(hertz_load(fn=9.1954_wp, modulus=200.0_wp/0.58_wp), 1.0_wp, 1.0_wp)
      call suite%close_to([hertz%a1, hertz%b1], [0.01_wp, 0.01_wp], printed, "cattaneo, curvatures", relative=.true.)
      call suite%close_to(hertz%pen, 0.0200_wp, printed, "cattaneo, approach", relative=.true.)
      hertz = hertz_by_axes(hertz_load(fn=82000.0_wp, modulus=steel), 8.0_wp, 4.0_wp)
      call suite%close_to([hertz%a1, hertz%b1, hertz%rho, hertz%cp], &
         & [0.8464e-3_wp, 0.2406e-2_wp, 614.9_wp, 5.657_wp], printed, "fastsim", relative=.true.)
      call suite%close_to(1.5_wp*hertz%fn/(pi*32.0_wp), 1223.0_wp, printed, "fastsim, largest pressure", relative=.true.)
      hertz = hertz_by_ratio(hertz_load(fn=106700.0_wp, modulus=steel), 0.8e-3_wp, 0.5_wp)
      call suite%close_to([hertz%b1, hertz%aa, hertz%bb, hertz%rho, hertz%cp], &
         & [0.2814e-3_wp, 6.304_wp, 12.61_wp, 1849.0_wp, 8.915_wp], printed, "tractcurv", relative=.true.)
      hertz = hertz_by_axes(hertz_load(fn=1.0e5_wp), 6.0_wp, 3.0_wp)
      call suite%close_to(hertz%b1/hertz%a1, 0.3411_wp/0.1200_wp, printed, "sample, ratio of curvatures", relative=.true.)
      call suite%close_to(hertz%cp, 4.243_wp, printed, "sample, effective semi-axis", relative=.true.)
      call suite%close_to(hertz%rho*hertz%a1, 433.7_wp*0.12e-2_wp, printed, "sample, effective radius", relative=.true.)
   end subroutine printed_values

   !> The two ratios are each other's inverse for any ellipse, and monotone
   subroutine ratios(suite)
      type(test_suite), intent(inout) :: suite
      real(wp) :: g, ratio, previous
      integer :: i

      previous = 0.0_wp
      do i = 0, 400
         g = 10.0_wp**(-20.0_wp + 0.05_wp*i)
         ratio = curvature_ratio(g)
         call suite%check(ratio > previous, "the ratio of curvatures grows with that of the axes")
         call suite%close_to(axis_ratio(ratio), g, closed, "inverse ratio", relative=.true.)
         previous = ratio
      end do
      call suite%close_to(curvature_ratio(1.0_wp), 1.0_wp, closed, "circle")
      call suite%close_to(axis_ratio(1.0_wp), 1.0_wp, closed, "circle, inverse")
      do i = 1, 15
         g = 1.0_wp - 10.0_wp**(-i)
         call suite%close_to(axis_ratio(curvature_ratio(g)), g, closed, "nearly circular")
      end do
   end subroutine ratios

   !> Curvatures -> axes -> curvatures, force -> approach -> force, and mirrored
   subroutine round_trips(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: aob(*) = [1.0e-6_wp, 1.0e-4_wp, 0.02_wp, 0.5_wp, 0.999999_wp, 1.0_wp, 1.3_wp, &
         & 50.0_wp, 1.0e4_wp, 1.0e6_wp]
      real(wp), parameter :: modulus = 1.1e5_wp, fn = 8.0e4_wp, a1 = 1.0e-3_wp
      type(hertz_contact) :: one, two
      integer :: i

      do i = 1, size(aob)
         one = hertz_by_ratio(hertz_load(fn=fn, modulus=modulus), a1, aob(i))
         call suite%close_to(one%aa/one%bb, aob(i), closed, "ratio of the axes", relative=.true.)
         two = hertz_by_curvatures(hertz_load(fn=fn, modulus=modulus), one%a1, one%b1)
         call same(suite, two, one, "by curvatures, N = 1")
         two = hertz_by_curvatures(hertz_load(normal_control%approach, pen=one%pen, modulus=modulus), one%a1, one%b1)
         call same(suite, two, one, "by curvatures, N = 0")
         two = hertz_by_ratio(hertz_load(normal_control%approach, pen=one%pen, modulus=modulus), one%a1, aob(i))
         call same(suite, two, one, "by ratio, N = 0")
         two = hertz_by_axes(hertz_load(fn=fn, modulus=modulus), one%aa, one%bb)
         call same(suite, two, one, "by axes, N = 1")
         two = hertz_by_axes(hertz_load(normal_control%approach, pen=one%pen, modulus=modulus), one%aa, one%bb)
         call same(suite, two, one, "by axes, N = 0")
         two = hertz_by_curvatures(hertz_load(fn=fn, modulus=modulus), one%b1, one%a1)
         call suite%close_to([two%aa, two%bb, two%pen], [one%bb, one%aa, one%pen], closed, "axes exchanged", &
            & relative=.true.)
      end do
   end subroutine round_trips

   subroutine same(suite, actual, expected, what)
      type(test_suite), intent(inout) :: suite
      type(hertz_contact), intent(in) :: actual, expected
      character(len=*), intent(in) :: what

      call suite%close_to([actual%a1, actual%b1, actual%aa, actual%bb, actual%aob, actual%rho, actual%cp, &
         & actual%fn, actual%pen], [expected%a1, expected%b1, expected%aa, expected%bb, expected%aob, &
         & expected%rho, expected%cp, expected%fn, expected%pen], 5.0_wp*closed, what, relative=.true.)
   end subroutine same

   !> Cylinders: a**2 = 4 P R/(pi E*), Johnson (1985), equation 4.43
   subroutine line_contacts(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: radius = 250.0_wp, bb = 7.0_wp, fn = 3.0e4_wp, modulus = 1.1e5_wp
      type(hertz_contact) :: one, two

      one = line_contact_by_curvature(hertz_load(fn=fn, modulus=modulus), 0.5_wp/radius, bb)
      call suite%close_to(one%aa, sqrt(4.0_wp*fn/(2.0_wp*bb)*radius/(pi*modulus)), closed, "half width", relative=.true.)
      call suite%close_to([one%b1, one%bb, one%pen], [0.0_wp, bb, 0.0_wp], closed, "half length")
      call suite%close_to(one%rho, 4.0_wp*radius, closed, "effective radius", relative=.true.)
      two = line_contact_by_axes(hertz_load(fn=fn, modulus=modulus), one%aa, bb)
      call suite%close_to([two%a1, two%cp, two%rho], [one%a1, one%cp, one%rho], closed, "by axes", relative=.true.)
   end subroutine line_contacts

   subroutine no_load(suite)
      type(test_suite), intent(inout) :: suite
      type(hertz_contact) :: hertz
      integer :: control

      do control = normal_control%approach, normal_control%force
         hertz = hertz_by_curvatures(hertz_load(control), 0.1_wp, 0.4_wp)
         call suite%close_to([hertz%aa, hertz%bb, hertz%fn, hertz%pen], spread(0.0_wp, 1, 4), 0.0_wp, "no contact")
         call suite%check(hertz%aob > 1.0_wp, "the ratio of the axes does not need a load")
         hertz = hertz_by_axes(hertz_load(control), 2.0_wp, 1.0_wp)
         call suite%check(hertz%a1 > 0.0_wp .and. hertz%b1 > hertz%a1 .and. hertz%b1 < 1.0e-8_wp, &
            & "axes without load belong to flat bodies")
      end do
      call suite%close_to(hertz%fn, 0.0_wp, 0.0_wp, "force stays zero")
      hertz = line_contact_by_curvature(hertz_load(fn=-1.0_wp), 0.1_wp, 3.0_wp)
      call suite%close_to([hertz%aa, hertz%bb], [0.0_wp, 3.0_wp], 0.0_wp, "line contact without load")
   end subroutine no_load

   !> The pressure of the solution displaces the centre by the approach: a check by quadrature.
   !>
   !> Polar coordinates about the centre cancel the singularity of the influence function
   !> 1/(pi E* r), and leave the area below the pressure along each half chord.
   subroutine displacement_of_centre(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: n = 20000
      real(wp), parameter :: modulus = 3.0_wp
      type(hertz_contact) :: hertz
      real(wp) :: phi, chord, total, p0
      integer :: i

      hertz = hertz_by_curvatures(hertz_load(fn=2.0_wp, modulus=modulus), 0.3_wp, 0.02_wp)
      p0 = 1.5_wp*hertz%fn/(pi*hertz%aa*hertz%bb)
      total = 0.0_wp
      do i = 1, n
         phi = 2.0_wp*pi*(i - 0.5_wp)/n
         ! p0 sqrt(1 - (r/chord)**2) over r = 0...chord
         chord = 1.0_wp/sqrt((cos(phi)/hertz%aa)**2 + (sin(phi)/hertz%bb)**2)
         total = total + 0.25_wp*pi*p0*chord*2.0_wp*pi/n
      end do
      call suite%close_to(total/(pi*modulus), hertz%pen, 1.0e-12_wp, "displacement at the centre is the approach", &
         & relative=.true.)
   end subroutine displacement_of_centre

   !> The sum of the pressures tends to the force under refinement
   subroutine pressures(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: aa = 2.0_wp, bb = 1.5_wp, fn = 100.0_wp
      type(potential_contact) :: grid
      real(wp) :: pn(200, 160), cell

      grid = potential_contact(200, 160, -2.2_wp, -1.6_wp, 0.022_wp, 0.02_wp)
      cell = grid%dx*grid%dy
      call elliptic_pressure(grid, aa, bb, .false., fn, pn)
      call suite%close_to(cell*sum(pn), fn, 1.0e-3_wp, "elliptic, force", relative=.true.)
      call suite%close_to(maxval(pn), 1.5_wp*fn/(pi*aa*bb), 1.0e-3_wp, "elliptic, largest pressure", relative=.true.)
      call suite%close_to(pn(1, :), spread(0.0_wp, 1, 160), 0.0_wp, "elliptic, outside")
      call parabolic_pressure(grid, aa, bb, .false., fn, pn)
      call suite%close_to(cell*sum(pn), fn, 1.0e-3_wp, "parabolic, force", relative=.true.)
      call suite%close_to(maxval(pn), 2.0_wp*fn/(pi*aa*bb), 1.0e-3_wp, "parabolic, largest pressure", relative=.true.)
      call sdec_pressure(grid, aa, 0.9_wp, 2.1_wp, fn, pn)
      call suite%close_to(cell*sum(pn), fn, 1.0e-3_wp, "SDEC, force", relative=.true.)
      call suite%check(minval(pn) >= 0.0_wp, "SDEC, no tension")
      call elliptic_pressure(grid, aa, bb, .true., fn, pn)
      call suite%close_to(cell*sum(pn), fn, 1.0e-3_wp, "elliptic line, force", relative=.true.)
      call suite%close_to(pn(:, 80), pn(:, 10), 0.0_wp, "elliptic line, rows are equal")
      call suite%close_to(pn(:, 5), spread(0.0_wp, 1, 200), 0.0_wp, "elliptic line, beyond its end")
      call parabolic_pressure(grid, aa, bb, .true., fn, pn)
      call suite%close_to(cell*sum(pn), fn, 1.0e-3_wp, "parabolic line, force", relative=.true.)
      call elliptic_pressure(grid, 0.0_wp, 0.0_wp, .false., 0.0_wp, pn)
      call suite%close_to(maxval(pn), 0.0_wp, 0.0_wp, "no contact")
   end subroutine pressures
end program test_hertz
