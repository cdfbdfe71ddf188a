!> Options of wheel on rail by their limits: rollers, flexible wheelsets, viscoelastic bodies, friction by position
program test_pair_options
   use contact_base_choices, only : contact_location, material_model, variation
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : friction_set
   use contact_grid_element_division, only : element
   use contact_test_harness, only : test_suite
   use contact_test_pair_builder, only : ball_case, pair_case, railway_case
   use contact_wheelrail_result, only : wheel_rail_result
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("pair options")
   call large_roller()
   call roller_curvature()
   call roller_sides()
   call flexible_wheelset()
   call viscoelastic_limits()
   call viscoelastic_lag()
   call viscoelastic_backwards()
   call friction_in_the_patch()
   call suite%finish()

contains

   !> A roller approaches a track with increasing radius: the difference decreases with the radius
   subroutine large_roller()
      type(pair_case) :: track, roller
      real(wp), parameter :: radius(2) = [1.0e5_wp, 1.0e6_wp]
      real(wp) :: difference(2)
      integer :: k

      track%spec = railway_case(3.0_wp, 0.004_wp)
      ! the rail rolls about the origin of its profile, not about the axle of the roller
      track%spec%wheel_rail%rail%vroll = 0.05_wp
      ! a gauge would put the top of a rail at height zero, but not that of a roller
      track%spec%wheel_rail%track%gaught = -1.0_wp
      track%spec%wheel_rail%track%raily0 = 755.0_wp
      ! the contact moves along with a wheelset that yaws
      track%spec%wheel_rail%wheelset%vyaw = -0.5_wp
      ! a curve yaws rail and roller about the centre of the track
      track%spec%wheel_rail%track%curvature = 2.0e-6_wp
      call track%run(suite, "track")
      do k = 1, 2
         roller%spec = track%spec
         call put_on_roller(roller%spec%wheel_rail%roller, roller%spec%wheel_rail%track%nomradr, radius(k))
         roller%spec%wheel_rail%wheelset%rpitch = track%spec%wheel_rail%wheelset%vs/radius(k)
         call roller%run(suite, "large roller")
         difference(k) = roller%result%z_ws - track%result%z_ws
         call suite%close_to(roller%result%force_track, track%result%force_track, 4.0e6_wp/radius(k), "force on a large roller")
      end do
      call suite%check(all(abs(difference) > 0.0_wp), "the roller is seen")
      call suite%close_to(difference(1)/difference(2), 10.0_wp, 1.0_wp, "the height differs by its curvature")
      call track%release()
      call roller%release()
   end subroutine large_roller

   subroutine put_on_roller(roller, nominal, radius)
      logical, intent(out) :: roller
      real(wp), intent(out) :: nominal
      real(wp), intent(in) :: radius

      roller = .true.
      nominal = radius
   end subroutine put_on_roller

   !> 1/Rw + 1/Rr: radii of 100 and 100 press as a wheel of radius 50 on a track
   subroutine roller_curvature()
      type(pair_case) :: small_wheel, roller

      small_wheel%spec = ball_case(0.05_wp)
      small_wheel%spec%wheel_rail%wheelset%nomradw = 50.0_wp
      call small_wheel%run(suite, "small wheel")
      roller%spec = ball_case(0.05_wp)
      call put_on_roller(roller%spec%wheel_rail%roller, roller%spec%wheel_rail%track%nomradr, 100.0_wp)
      roller%spec%wheel_rail%wheelset%rpitch = 1.0_wp
      call roller%run(suite, "roller")
      associate (a => roller%result, b => small_wheel%result)
         call suite%equal(size(a%patches), 1, "one patch on the roller")
         if (size(a%patches) /= 1 .or. size(b%patches) /= 1) return
         ! the next terms of both shapes differ by (a/R)**2, 5e-4
         call suite%close_to(a%patches(1)%contact%fn/b%patches(1)%contact%fn, 1.0_wp, 2.0e-3_wp, "force")
         call suite%close_to(a%patches(1)%contact%pmax/b%patches(1)%contact%pmax, 1.0_wp, 2.0e-3_wp, "pressure")
      end associate
      call small_wheel%release()
      call roller%release()
   end subroutine roller_curvature

   !> Left roller and wheel are the mirror image of the right ones
   subroutine roller_sides()
      type(pair_case) :: right, left

      right%spec = railway_case(3.0_wp, 0.004_wp)
      call put_on_roller(right%spec%wheel_rail%roller, right%spec%wheel_rail%track%nomradr, 500.0_wp)
      right%spec%wheel_rail%wheelset%rpitch = 40.0_wp
      call right%run(suite, "right roller")
      left%spec = right%spec
      left%spec%wheel_rail%left = .true.
      left%spec%wheel_rail%wheelset%y = -3.0_wp
      left%spec%wheel_rail%wheelset%yaw = -0.004_wp
      call left%run(suite, "left roller")
      call suite%close_to(left%result%force_track, right%result%force_track, tiny(1.0_wp), "left is the mirror image of right")
      call right%release()
      call left%release()
   end subroutine roller_sides

   !> Deviations of a flexible wheelset act as if the rigid one were there and moved so
   subroutine flexible_wheelset()
      type(pair_case) :: rigid, flexible
      integer :: k

      rigid%spec = railway_case(3.0_wp, 0.0_wp)
      rigid%spec%wheel_rail%wheelset%vy = 20.0_wp
      call rigid%run(suite, "rigid wheelset")
      flexible%spec = railway_case(2.0_wp, 0.0_wp)
      associate (wheelset => flexible%spec%wheel_rail%wheelset)
         wheelset%vy = 15.0_wp
         wheelset%flexible = [0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
         wheelset%flexible_rate = [0.0_wp, 5.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
      end associate
      call flexible%run(suite, "flexible wheelset")
      do k = 1, 3
         call suite%close_to(flexible%result%force_track(k), rigid%result%force_track(k), 1.0_wp, "flexible as rigid")
      end do
      ! rotations add up; the rolling velocity that creepages refer to is that of the rigid wheelset, 0.1 % different
      associate (wheelset => flexible%spec%wheel_rail%wheelset)
         ! the flexible rotation is about the origin of the wheel profile; with this velocity it is about the axle
         wheelset%flexible_rate(6) = 0.1_wp
         wheelset%flexible_rate(1) = 0.1_wp*wheelset%nomradw
         wheelset%vpitch = wheelset%vpitch - 0.1_wp
      end associate
      call flexible%run(suite, "flexible wheelset that twists")
      call suite%close_to(flexible%result%force_track/rigid%result%force_track, [1.0_wp, 1.0_wp, 1.0_wp], 2.0e-3_wp, &
         & "flexible rotation")
      flexible%spec%wheel_rail%wheelset%flexible_rate = 0.0_wp
      call flexible%run(suite, "without rates")
      call suite%check(norm2(flexible%result%force_track - rigid%result%force_track) > 100.0_wp, "the rates are seen")
      call rigid%release()
      call flexible%release()
   end subroutine flexible_wheelset

   !> No relaxation, an instantaneous and an endless one are elastic, the late ones with the modulus of their time
   subroutine viscoelastic_limits()
      type(pair_case) :: elastic, soft, one
      integer, parameter :: places(3) = [contact_location%locus, contact_location%locus_extended, contact_location%conformal]
      integer :: k

      elastic%spec = ball_case(0.05_wp)
      call elastic%run(suite, "elastic")
      soft%spec = elastic%spec
      soft%spec%material%gg = 0.5_wp*elastic%spec%material%gg
      call soft%run(suite, "softer")
      one%spec = elastic%spec
      one%spec%material_model = material_model%viscoelastic
      one%spec%material%fg = 0.0_wp
      one%spec%material%tc = 0.01_wp
      call one%run(suite, "nothing relaxes")
      call suite%close_to(one%result%force_track, elastic%result%force_track, 1.0e-6_wp, "FG = 0")
      one%spec%material%fg = 1.0_wp
      one%spec%material%tc = 0.0_wp
      call one%run(suite, "relaxed at once")
      call suite%close_to(one%result%force_track, soft%result%force_track, 1.0e-6_wp, "TC = 0")
      one%spec%material%tc = 1.0e5_wp
      call one%run(suite, "relaxed never")
      call suite%close_to(one%result%force_track/elastic%result%force_track(3), &
         & elastic%result%force_track/elastic%result%force_track(3), 1.0e-3_wp, "TC without end")
      ! a rail that has relaxed under a wheel that does not; slip per element depends on the compliances of both
      do k = 1, size(places)
         one%spec%wheel_rail%search%location = places(k)
         one%spec%wheel_rail%wheelset%yaw = 0.02_wp
         one%spec%material%poiss = 0.45_wp
         one%spec%material%fg = [3.0_wp, 1.0_wp]
         one%spec%material%tc = [0.0_wp, 1.0e15_wp]
         one%spec%iteration%maxout = 20
         soft%spec = one%spec
         soft%spec%material_model = material_model%elastic
         soft%spec%material%gg = one%spec%material%gg/[4.0_wp, 1.0_wp]
         call one%run(suite, "one body relaxed")
         call soft%run(suite, "one body softer")
         call suite%close_to(one%result%force_track/soft%result%force_track(3), soft%result%force_track &
            & /soft%result%force_track(3), 1.0e-5_wp, "one body relaxed at once")
         call suite%close_to(one%result%patches(1)%contact%cksi, soft%result%patches(1)%contact%cksi, 1.0e-7_wp, &
            & "one body relaxed at once, creepage")
      end do
      call elastic%release()
      call soft%release()
      call one%release()
   end subroutine viscoelastic_limits

   !> In between the inlet carries more than the outlet, and the velocity matters
   subroutine viscoelastic_lag()
      type(pair_case) :: slow, fast

      slow%spec = ball_case(0.05_wp)
      slow%spec%material_model = material_model%viscoelastic
      slow%spec%material%fg = 1.0_wp
      slow%spec%material%tc = 0.02_wp
      call slow%run(suite, "slow")
      fast%spec = slow%spec
      fast%spec%wheel_rail%wheelset%vs = 10.0_wp*slow%spec%wheel_rail%wheelset%vs
      fast%spec%wheel_rail%wheelset%vpitch = 10.0_wp*slow%spec%wheel_rail%wheelset%vpitch
      call fast%run(suite, "fast")
      call suite%check(pressure_place(slow%result) > 0.05_wp, "the pressure leads")
      call suite%check(fast%result%force_track(3) > 1.1_wp*slow%result%force_track(3), "a faster wheel meets stiffer bodies")
      call slow%release()
      call fast%release()
   end subroutine viscoelastic_lag

   !> Mean position of the pressure along the track [mm]
   real(wp) function pressure_place(result) result(x)
      type(wheel_rail_result), intent(in) :: result
      integer :: ix

      associate (contact => result%patches(1)%contact)
         x = 0.0_wp
         do ix = 1, contact%grid%mx
            x = x + contact%grid%x(ix)*sum(contact%pn(ix, :))
         end do
         x = x/sum(contact%pn)
      end associate
   end function pressure_place

   !> Rolling backwards is the mirror image of rolling ahead
   subroutine viscoelastic_backwards()
      type(pair_case) :: ahead, back

      ahead%spec = ball_case(0.05_wp)
      ahead%spec%material_model = material_model%viscoelastic
      ahead%spec%material%fg = 1.0_wp
      ahead%spec%material%tc = 1.0e-2_wp
      back%spec = ahead%spec
      back%spec%wheel_rail%wheelset%vs = -100.0_wp
      back%spec%wheel_rail%wheelset%vpitch = 0.996_wp
      call ahead%run(suite, "memory, rolling ahead")
      call back%run(suite, "memory, rolling backwards")
      call suite%close_to(back%result%force_track, ahead%result%force_track*[-1.0_wp, 1.0_wp, 1.0_wp], &
         & 1.0e-5_wp*ahead%result%force_track(3), "memory backwards: forces")
      call suite%check(abs(ahead%result%force_track(1)) > 1.0e-3_wp*ahead%result%force_track(3), "memory backwards: a force")
      call ahead%release()
      call back%release()
   end subroutine viscoelastic_backwards

   !> The friction parameters of a patch are in its result
   subroutine friction_in_the_patch()
      type(pair_case) :: one

      one%spec = railway_case(0.0_wp, 0.0_wp)
      call one%run(suite, "one friction")
      call suite%check(.not. allocated(one%result%patches(1)%friction), "no parameters if friction is the same everywhere")
      one%spec%variation = variation%by_position
      deallocate(one%spec%friction%sets)
      allocate(one%spec%friction%sets(2))
      one%spec%friction%sets = [friction_set(position=0.0_wp, fstat=0.2_wp, fkin=0.2_wp), &
         & friction_set(position=100.0_wp, fstat=0.4_wp, fkin=0.4_wp)]
      one%spec%wheel_rail%wheelset%s = 25.0_wp
      call one%run(suite, "friction by position")
      call suite%check(allocated(one%result%patches(1)%friction), "and given if it varies")
      if (allocated(one%result%patches(1)%friction)) &
         & call suite%close_to(one%result%patches(1)%friction%fstat, [0.25_wp], 1.0e-12_wp, "between the points")
      call suite%check(any(one%result%patches(1)%contact%division > element%exterior), "with contact")
      call one%release()
   end subroutine friction_in_the_patch
end program test_pair_options
