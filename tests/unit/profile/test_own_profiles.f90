!> The profiles of the examples: key points of S1002 and 60E1, tangents, and the distance to published files
program test_own_profiles
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_profile_curve, only : profile_curve
   use contact_profile_prepare, only : read_profile
   use contact_profile_request, only : profile_request, profile_side
   use contact_test_harness, only : environment, reference_folder, test_suite
   implicit none (type, external)
   type(test_suite) :: suite
   type(profile_curve) :: wheel, rail

   call suite%start("own profiles")
   call read_file(suite, environment("CONTACT_SOURCE") // "/examples/profiles/S1002.prw", profile_side%wheel, wheel)
   call read_file(suite, environment("CONTACT_SOURCE") // "/examples/profiles/60E1.prr", profile_side%rail, rail)
   call wheel_facts(suite)
   call rail_facts(suite)
   call published(suite)
   call suite%finish()

contains

   subroutine read_file(suite, file, side, curve)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: file
      integer, intent(in) :: side
      type(profile_curve), intent(out) :: curve
      type(profile_request) :: request
      type(error_type), allocatable :: error
      type(log_type) :: log

      request%file = file
      request%side = side
      call read_profile(request, curve, log, error)
      if (allocated(error)) then
         call suite%check(.false., full_text(error))
         call suite%finish()
      end if
      call suite%equal(log%warnings, 0, "no warnings from " // file)
   end subroutine read_file

   !> EN 13715: tape circle, cone, flank, tip of the flange
   subroutine wheel_facts(suite)
      type(test_suite), intent(inout) :: suite
      real(wp) :: s(400)
      integer :: i

      call suite%close_to(wheel%y_range(), [-70.0_wp, 60.0_wp], 1.0e-6_wp, "width of the wheel")
      call suite%close_to(wheel%height([0.0_wp, 60.0_wp, -55.0_wp]), [0.0_wp, -2.635676_wp, 28.0_wp], 1.0e-5_wp, &
         & "tape circle, field side, tip of the flange")
      call suite%close_to(wheel%inclination(wheel%s_at([0.0_wp, 45.0_wp, -39.1_wp])), &
         & [-atan(3.358537e-2_wp), -atan(1.0_wp/15.0_wp), -70.0_wp*pi/180.0_wp], 1.0e-4_wp, &
         & "slopes of tread, cone and flank")
      call suite%close_to(wheel%s_at(0.0_wp), 0.0_wp, 1.0e-6_wp, "s = 0 at the tape circle")
      ! Away from the flange back no radius is smaller than 12 mm
      s = [(-59.0_wp + 130.0_wp*i/400.0_wp, i=1, 400)]
      call suite%check(maxval(abs(curvature(wheel, s))) < 1.05_wp/12.0_wp, "no radius below 12 mm")
   end subroutine wheel_facts

   !> EN 13674-1: radii 300, 80, 13 and sides 1:20, in tangents, symmetric
   subroutine rail_facts(suite)
      type(test_suite), intent(inout) :: suite
      real(wp) :: s, z, y(60)
      integer :: i

      call rail%top(s, z)
      call suite%close_to([s, z], [0.0_wp, 0.0_wp], 1.0e-6_wp, "top in the origin")
      y = [(0.6_wp*i, i=1, 60)]
      call suite%close_to(rail%height(y), rail%height(-y), 1.0e-8_wp, "symmetric")
      call suite%close_to(rail%height([10.228_wp, 26.0265_wp, 36.0_wp]), [0.1744_wp, 2.3025_wp, 14.3_wp], 5.0e-3_wp, &
         & "joints of the arcs")
      call suite%close_to(curvature(rail, rail%s_at([5.0_wp, 18.0_wp, 32.0_wp])), &
         & 1.0_wp/[300.0_wp, 80.0_wp, 13.0_wp], 1.0e-4_wp, "radii")
      call suite%close_to(rail%inclination(rail%s_at(36.5_wp)), atan(20.0_wp), 1.0e-6_wp, "sides 1:20")
   end subroutine rail_facts

   !> Curvature [1/mm], positive where the body is convex
   elemental real(wp) function curvature(curve, s)
      type(profile_curve), intent(in) :: curve
      real(wp), intent(in) :: s

      curvature = (curve%y%slope(s)*curve%z%bend(s) - curve%z%slope(s)*curve%y%bend(s)) &
         & /hypot(curve%y%slope(s), curve%z%slope(s))**3
   end function curvature

   !> The benchmark wheel is the same; the benchmark rail is a variant, inclined 1:40 with the top in the origin
   subroutine published(suite)
      type(test_suite), intent(inout) :: suite
      type(profile_curve) :: curve
      type(profile_curve) :: inclined
      character(len=:), allocatable :: folder
      real(wp) :: y(500), angle, top_s, top_z
      real(wp), allocatable :: nodes(:)
      integer :: i

      folder = reference_folder()
      if (folder == "") then
         call suite%skip("distance to published profiles", "CONTACT_REFERENCE is not there")
         return
      end if
      call read_file(suite, folder // "/examples/MBench_S1002_v3.prw", profile_side%wheel, curve)
      nodes = curve%y%nodes()
      call report("S1002, largest difference in z at the published points [mm]", wheel%height(nodes) - curve%z%nodes())
      ! The polynomials of the standard meet circle D with a step of 1.2e-4 mm, and splines swing there
      call suite%close_to(wheel%height(nodes), curve%z%nodes(), 3.0e-4_wp, "the benchmark wheel is S1002")
      call read_file(suite, folder // "/examples/MBench_UIC60_v3.prr", profile_side%rail, curve)
      angle = 1.0_wp/40.0_wp
      inclined = rail%seen_from([0.0_wp, 0.0_wp], angle)
      call inclined%top(top_s, top_z)
      inclined = rail%seen_from([cos(angle)*inclined%y%value(top_s) - sin(angle)*top_z, &
         & sin(angle)*inclined%y%value(top_s) + cos(angle)*top_z], angle)
      y = [(-40.0_wp + 68.0_wp*i/500.0_wp, i=1, 500)]
      call report("60E1 inclined, largest difference in z [mm]", inclined%height(y) - curve%height(y))
      y = [(-36.0_wp + 62.0_wp*i/500.0_wp, i=1, 500)]
      call report("the same without the sides", inclined%height(y) - curve%height(y))
      call suite%close_to(inclined%height(y), curve%height(y), 0.06_wp, "the benchmark rail is a near relative of 60E1")
   end subroutine published

   subroutine report(what, difference)
      character(len=*), intent(in) :: what
      real(wp), intent(in) :: difference(:)

      print "(2a, es10.2)", what, ": ", maxval(abs(difference))
   end subroutine report
end program test_own_profiles
