!> Wheel on rail through long sequences in which patches appear, vanish, join and separate
!>
!> Every step must end with a solution, tractions must obey friction, and forces must not jump where the
!> number of patches changes: friction forces change there by no more than elsewhere.
program test_hard_pairs
   use contact_base_choices, only : estimate_choice, motion, time_link
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_test_files, only : write_profile
   use contact_test_harness, only : test_suite
   use contact_test_pair_builder, only : ball_case, pair_case, railway_case
   implicit none (type, external)
   real(wp), parameter :: pi = acos(-1.0_wp)
   integer, parameter :: steps = 240
   type(test_suite) :: suite

   call suite%start("hard pairs")
   call swinging_wheel(motion%shift, "shifts")
   call swinging_wheel(motion%transient_rolling, "rolling")
   call hopping_wheel()
   call notched_wheel()
   call undercut_rail()
   call impossible_heights()
   call tiny_elements()
   call small_radii()
   call suite%finish()

contains

   !> A rail with two humps, 0.02 mm above the hollow between them
   subroutine prepare(pair)
      type(pair_case), intent(inout) :: pair
      integer :: i
      real(wp) :: y(161)

      pair%spec = ball_case(0.1_wp)
      y = [(-16.0_wp + 0.2_wp*(i - 1), i=1, size(y))]
      call write_profile("humps.dat", y, 0.01_wp*(1.0_wp + cos(pi*y/4.0_wp)) + (y/20.0_wp)**4)
      associate (r => pair%spec%wheel_rail)
         r%rail_profile%name = "humps.dat"
         r%search%dx = 0.5_wp
         r%search%ds = 0.5_wp
         r%search%d_comb = 0.3_wp
         r%search%d_sep = 1.0_wp
         r%search%d_turn = 0.0_wp
      end associate
   end subroutine prepare

   !> A wheel far inside the rail is refused with the height at which it would touch; one far above has no contact
   subroutine impossible_heights()
      type(pair_case) :: pair
      type(error_type), allocatable :: error
      real(wp), parameter :: inside(3) = [101.0_wp, 1.0e9_wp, 1.0e300_wp]
      integer :: k

      do k = 1, size(inside)
         pair%spec = ball_case(inside(k))
         call pair%try(error)
         call suite%check(allocated(error), "a wheel inside the rail is refused")
         if (.not. allocated(error)) cycle
         call suite%check(index(full_text(error), "deeper into the rail than its radius") > 0, "its reason: " // full_text(error))
         pair%spec%wheel_rail%wheelset%z = -inside(k)
         call pair%run(suite, "a wheel far above the rail")
         call suite%equal(size(pair%result%patches), 0, "a wheel far above the rail: no contact")
      end do
      call pair%release()
   end subroutine impossible_heights

   !> Rollers and wheels whose profiles would reach beyond their axles are refused, those just large enough are solved
   subroutine small_radii()
      type(pair_case) :: pair
      type(error_type), allocatable :: error
      integer :: k

      do k = 1, 2
         pair%spec = too_small(k)
         call pair%try(error)
         call suite%check(allocated(error), "a radius below the size of the profile is refused")
         if (allocated(error)) call suite%check(index(full_text(error), "beyond the axle") > 0, "its reason: " // full_text(error))
      end do
      ! the rail of the ball is 2.02 mm deep
      pair%spec = too_small(1)
      pair%spec%wheel_rail%track%nomradr = 2.1_wp
      call pair%run(suite, "a small roller")
      call suite%check(pair%result%force_track(3) > 0.0_wp, "a small roller: contact")
      call pair%release()
   end subroutine small_radii

   !> A ball on a roller that is too small, and a railway wheel that is
   function too_small(k) result(spec)
      integer, intent(in) :: k
      type(case_spec) :: spec

      if (k == 1) then
         spec = ball_case(0.01_wp)
         spec%wheel_rail%roller = .true.
         spec%wheel_rail%track%nomradr = 1.9_wp
         spec%wheel_rail%wheelset%rpitch = 1.0_wp
      else
         spec = railway_case(0.0_wp, 0.0_wp)
         spec%wheel_rail%wheelset%nomradw = 2.5_wp
      end if
   end function too_small

   !> Elements far smaller than the contact: their number stays bounded, and so does the mesh of the search
   subroutine tiny_elements()
      type(pair_case) :: pair
      real(wp) :: force
      integer :: k

      pair%spec = ball_case(0.01_wp)
      pair%spec%motion = motion%none
      pair%spec%iteration%npot_max = 1000
      do k = 1, 2
         pair%spec%wheel_rail%search%dx = merge(0.1_wp, 1.0e-8_wp, k == 1)
         pair%spec%wheel_rail%search%ds = pair%spec%wheel_rail%search%dx
         call pair%run(suite, "tiny elements")
         if (k == 1) force = pair%result%force_track(3)
      end do
      call suite%close_to(pair%result%force_track(3), force, 0.02_wp*force, "tiny elements: force")
      call pair%release()
   end subroutine tiny_elements

   !> A notch in the profile of a yawed wheel, where its contact locus folds, does not hide what lies beyond it
   subroutine notched_wheel()
      type(pair_case) :: pair
      real(wp) :: z(61), force(2)
      integer :: i, k
      real(wp), parameter :: depth(2) = [0.0_wp, 2.0_wp]

      do k = 1, 2
         pair%spec = ball_case(0.1_wp)
         z = 0.0_wp
         ! 8 mm from the middle of the profile; contact is at 15 mm
         z(23) = -depth(k)
         call write_profile("notched.dat", [(30.0_wp - 1.0_wp*i, i=0, 60)], z)
         associate (r => pair%spec%wheel_rail)
            r%wheel_profile%name = "notched.dat"
            r%wheelset%y = -15.0_wp
            r%wheelset%yaw = 0.1_wp
         end associate
         call pair%run(suite, "notched wheel")
         force(k) = pair%result%force_track(3)
         call pair%release()
      end do
      call suite%check(force(1) > 100.0_wp, "notched wheel: there is contact")
      call suite%close_to(force(2), force(1), 0.02_wp*force(1), "notched wheel: the contact beyond the notch is found")
   end subroutine notched_wheel

   !> The length along a rail with an undercut begins at the point nearest to its origin, and so does the lattice of elements
   subroutine undercut_rail()
      type(pair_case) :: pair
      real(wp) :: y(162), z(162)
      integer :: i
      real(wp), parameter :: radius = 100.0_wp

      pair%spec = ball_case(0.1_wp)
      pair%spec%motion = motion%shift
      y(2:) = [(-19.9_wp + 0.25_wp*i, i=0, 160)]
      z(2:) = radius - sqrt(radius**2 - y(2:)**2)
      y(1) = y(2) + 0.1_wp
      z(1) = z(2) + 0.5_wp
      call write_profile("undercut.dat", y, z)
      pair%spec%wheel_rail%rail_profile%name = "undercut.dat"
      call pair%run(suite, "undercut rail")
      ! the points are at y = 0.1 and -0.15 mm, the contact is at y = 0
      call suite%close_to(pair%result%patches(1)%grid_reference(2), -0.1_wp, 1.0e-3_wp, "undercut rail: origin of the lattice")
      call pair%release()
   end subroutine undercut_rail

   !> The wheel is pressed down and lifted again and again, moves sideways, drives and brakes
   subroutine swinging_wheel(kind, name)
      integer, intent(in) :: kind
      character(len=*), intent(in) :: name
      type(pair_case) :: pair
      real(wp) :: force(3), previous(3), jump(2)
      integer :: step, patches, changes, most, fewest
      character(len=60) :: line

      call prepare(pair)
      pair%spec%motion = kind
      jump = 0.0_wp
      changes = 0
      patches = 0
      most = 0
      fewest = 99
      previous = 0.0_wp
      do step = 1, steps
         associate (w => pair%spec%wheel_rail%wheelset)
            w%z = 0.045_wp + 0.035_wp*sin(2.0_wp*pi*step/40.0_wp)
            w%y = 0.4_wp*sin(2.0_wp*pi*step/90.0_wp)
            w%s = 0.1_wp*step
            w%vs = merge(0.1_wp, 100.0_wp, kind == motion%shift)
            w%vpitch = -w%vs/100.0_wp*(1.0_wp + 0.01_wp*sin(2.0_wp*pi*step/60.0_wp))
         end associate
         call pair%run(suite, name)
         call obeys_friction(pair, name)
         force = pair%result%force_track
         associate (n => size(pair%result%patches))
            if (step > 1) then
               if (n /= patches) then
                  changes = changes + 1
                  jump(1) = max(jump(1), abs(force(1) - previous(1)))
               else
                  jump(2) = max(jump(2), abs(force(1) - previous(1)))
               end if
            end if
            patches = n
            most = max(most, n)
            fewest = min(fewest, n)
         end associate
         previous = force
         pair%spec%link = time_link%continue_all
         pair%spec%estimate = estimate_choice%previous
      end do
      write(line, "(2(a,f0.3))") ": ", jump(1), " N where patches change, elsewhere ", jump(2)
      call suite%check(changes >= 10 .and. most == 2 .and. fewest == 1, name // ": patches join and separate")
      call suite%check(jump(1) <= 1.5_wp*jump(2), name // ": friction does not jump" // trim(line))
      call pair%release()
   end subroutine swinging_wheel

   !> The wheel leaves the rail and comes back: no contact in every second part of the sequence
   subroutine hopping_wheel()
      type(pair_case) :: pair
      integer :: step, without

      call prepare(pair)
      pair%spec%motion = motion%transient_rolling
      without = 0
      do step = 1, 60
         pair%spec%wheel_rail%wheelset%z = 0.05_wp*sin(2.0_wp*pi*step/20.0_wp)
         call pair%run(suite, "hopping")
         call obeys_friction(pair, "hopping")
         if (size(pair%result%patches) == 0) then
            without = without + 1
            call suite%check(all(abs(pair%result%force_track) <= 0.0_wp), "hopping: no contact, no force")
         end if
         pair%spec%link = time_link%continue_all
      end do
      call suite%check(without > 20 .and. without < 40, "hopping: the contact is lost and comes back")
      call pair%release()
   end subroutine hopping_wheel

   !> Tractions within the friction bound in every element, and no NaN
   subroutine obeys_friction(pair, name)
      type(pair_case), intent(in) :: pair
      character(len=*), intent(in) :: name
      integer :: k

      do k = 1, size(pair%result%patches)
         associate (c => pair%result%patches(k)%contact)
            if (.not. all(c%px**2 + c%py**2 <= (0.4_wp*c%pn*(1.0_wp + 1.0e-6_wp) + 1.0e-9_wp)**2)) &
               & call suite%check(.false., name // ": tractions beyond friction")
         end associate
      end do
      if (.not. all(abs(pair%result%force_track) < huge(1.0_wp))) call suite%check(.false., name // ": the force is a number")
   end subroutine obeys_friction
end program test_hard_pairs
