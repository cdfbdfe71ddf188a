!> Creepages of a wheel on a rail
!>
!> Positions, contact references and creepages are those of the Manchester contact benchmark, case A-2.2,
!> right wheel, as published with the original program (revision 2707).
program test_creepage
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_test_harness, only : test_suite
   use contact_wheelrail_creepage, only : contact_motion, flat_creepage, flat_shift, rigid_motion
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("creepage")
   call benchmark(suite, y=0.0_wp, z=0.1981_wp, roll=0.0_wp, yaw=0.0_wp, omega=-4.34811810_wp, &
      & place=[0.0_wp, 751.8726_wp, 0.1252_wp], delta=-0.0290_wp, pen=0.01596_wp, &
      & expected=[-5.665e-5_wp, 0.0_wp, 6.302e-5_wp], tolerance=[2.0e-7_wp, 1.0e-9_wp, 1.2e-7_wp])
   call benchmark(suite, y=10.0_wp, z=-8.2668_wp, roll=-0.01126431_wp, yaw=0.024_wp, omega=-4.24363750_wp, &
      & place=[-5.2821_wp, 721.0880_wp, 6.5066_wp], delta=-0.7992_wp, pen=0.03411_wp, &
      & expected=[0.02378_wp, 0.03445_wp, 0.001486_wp], tolerance=[5.0e-6_wp, 5.0e-6_wp, 5.0e-7_wp])
   call benchmark(suite, y=5.5_wp, z=-0.0866_wp, roll=-0.0004777_wp, yaw=0.0132_wp, omega=-4.33188640_wp, &
      & place=[-7.37_wp, 726.1169_wp, 3.3006_wp], delta=-0.3363_wp, pen=0.02926_wp, &
      & expected=[0.004379_wp, 0.01401_wp, 7.122e-4_wp], tolerance=[1.0e-6_wp, 5.0e-6_wp, 1.0e-7_wp])
   call pure_rolling(suite)
   call shift(suite)
   call suite%finish()

contains

   subroutine benchmark(suite, y, z, roll, yaw, omega, place, delta, pen, expected, tolerance)
      type(test_suite), intent(inout) :: suite
      real(wp), intent(in) :: y, z, roll, yaw, omega, place(3), delta, pen, expected(3), tolerance(3)
      type(rigid_motion) :: rail, wheel
      type(contact_motion) :: motion
      real(wp) :: axle(3), normal(3)

      wheel%origin = [0.0_wp, y, z - 460.0_wp]
      wheel%velocity = [2000.0_wp, 0.0_wp, 0.0_wp]
      ! second column of Rx(roll) Rz(yaw)
      axle = [-sin(yaw), cos(roll)*cos(yaw), sin(roll)*cos(yaw)]
      wheel%rotation = omega*axle
      normal = [0.0_wp, -sin(delta), cos(delta)]
      motion = flat_creepage(rail, wheel, axle, omega, place, place + pen*normal, delta, .false.)
      call suite%close_to(motion%cksi, expected(1), tolerance(1), "longitudinal creepage")
      call suite%close_to(motion%ceta, expected(2), tolerance(2), "lateral creepage")
      call suite%close_to(motion%cphi, expected(3), tolerance(3), "spin")
      call suite%check(abs(motion%veloc - 2010.0_wp) < 20.0_wp .and. motion%chi == 0.0_wp, "rolling forward")
   end subroutine benchmark

   !> A wheel that rolls without slip, forwards, backwards and on a roller
   subroutine pure_rolling(suite)
      type(test_suite), intent(inout) :: suite
      type(rigid_motion) :: rail, wheel
      type(contact_motion) :: motion
      real(wp), parameter :: axle(3) = [0.0_wp, 1.0_wp, 0.0_wp], place(3) = 0.0_wp

      wheel%origin = [0.0_wp, 0.0_wp, -500.0_wp]
      wheel%velocity = [-1000.0_wp, 0.0_wp, 0.0_wp]
      wheel%rotation = 2.0_wp*axle
      motion = flat_creepage(rail, wheel, axle, 2.0_wp, place, place, 0.0_wp, .false.)
      call suite%close_to([motion%cksi, motion%ceta, motion%cphi, motion%veloc, motion%chi], &
         & [0.0_wp, 0.0_wp, 0.0_wp, 1000.0_wp, pi], 1.0e-12_wp, "backwards without slip")

      wheel%velocity = 0.0_wp
      wheel%rotation = -2.0_wp*axle
      rail%origin = [0.0_wp, 0.0_wp, 250.0_wp]
      rail%rotation = 4.0_wp*axle
      motion = flat_creepage(rail, wheel, axle, -2.0_wp, place, place, 0.0_wp, .true.)
      call suite%close_to([motion%cksi, motion%ceta, motion%cphi, motion%veloc, motion%chi], &
         & [0.0_wp, 0.0_wp, 0.0_wp, 1000.0_wp, 0.0_wp], 1.0e-12_wp, "on a roller without slip")
      ! the axle travels with 300 mm/s on the roller, the contact with a third of it: its radius is half of that of the wheel
      wheel%velocity = [300.0_wp, 0.0_wp, 0.0_wp]
      wheel%rotation = -2.6_wp*axle
      motion = flat_creepage(rail, wheel, axle, -2.6_wp, place, place, 0.0_wp, .true.)
      call suite%close_to([motion%cksi, motion%ceta, motion%cphi, motion%veloc, motion%chi], &
         & [0.0_wp, 0.0_wp, 0.0_wp, 1100.0_wp, 0.0_wp], 1.0e-12_wp, "travelling on a roller without slip")
      wheel%velocity = 0.0_wp

      wheel%rotation = 0.0_wp
      rail%rotation = 0.0_wp
      motion = flat_creepage(rail, wheel, axle, 0.0_wp, place, place, 0.0_wp, .false.)
      call suite%close_to([motion%cksi, motion%ceta, motion%cphi], [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-12_wp, "standstill")
   end subroutine pure_rolling

   !> Displacements of one step, seen in an inclined plane
   subroutine shift(suite)
      type(test_suite), intent(inout) :: suite
      type(rigid_motion) :: rail, wheel
      type(contact_motion) :: motion
      real(wp), parameter :: delta = 0.3_wp, place(3) = 0.0_wp

      wheel%velocity = [0.01_wp, 0.02_wp, 0.0_wp]
      wheel%rotation = [0.0_wp, 0.0_wp, 0.001_wp]
      motion = flat_shift(rail, wheel, place, place, delta)
      call suite%close_to([motion%cksi, motion%ceta, motion%cphi, motion%veloc], [-0.01_wp, -0.02_wp*cos(delta), &
         & -0.001_wp*cos(delta), 1.0_wp], 1.0e-14_wp, "rail minus wheel")
   end subroutine shift
end program test_creepage
