!> Wheel on rail in memory for the tests: profiles of simple shapes, specifications, one session with its result
module contact_test_pair_builder
   use contact_base_choices, only : estimate_choice, force_control, motion, normal_control, time_link
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_wheel_rail_session, only : wheel_rail_session, release_wheel_rail_session, solve_wheel_rail_case
   use contact_cases_spec, only : case_spec, friction_set
   use contact_test_files, only : write_profile
   use contact_test_harness, only : environment, test_suite
   use contact_wheelrail_result, only : wheel_rail_result
   implicit none (type, external)
   private

   public :: pair_case, railway_case, ball_case

   !> A specification with the session that solves it
   type :: pair_case
      type(case_spec) :: spec
      type(wheel_rail_session) :: session
      type(wheel_rail_result) :: result
      type(log_type) :: log
   contains
      !> Solve, and check that there is a solution
      procedure :: run
      !> Solve without a check
      procedure :: try
      !> Release the memory of the session
      procedure :: release
      !> The same at the end of a scope; one call there compiles faster than the release of all components
      final :: finish
   end type pair_case

contains

   !> Solve; a failure, or forces that are not reached, are a failed check
   subroutine run(self, suite, what)
      class(pair_case), intent(inout) :: self
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: what
      type(error_type), allocatable :: error
      integer :: k

      call self%try(error)
      if (allocated(error)) then
         call suite%check(.false., what // ": " // full_text(error))
         return
      end if
      call suite%check(self%result%status%is_solved(), what // ": the forces are reached")
      do k = 1, size(self%result%patches)
         associate (contact => self%result%patches(k)%contact)
            if (.not. (contact%normal%succeeded() .and. contact%tangential%succeeded())) &
               & call suite%check(.false., what // ": the contact problem converges")
         end associate
      end do
   end subroutine run

   subroutine try(self, error)
      class(pair_case), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      call solve_wheel_rail_case(self%session, self%spec, "", self%log, self%result, error)
   end subroutine try

   impure elemental subroutine finish(self)
      type(pair_case), intent(inout) :: self
      call self%release()
   end subroutine finish

   subroutine release(self)
      class(pair_case), intent(inout) :: self
      call release_wheel_rail_session(self%session)
   end subroutine release

   !> A wheel S1002 on a rail 60E1: 60 kN, slightly driven, on elements of half a millimetre
   function railway_case(y, yaw) result(spec)
      !> Lateral position [mm] and yaw angle [rad] of the wheelset
      real(wp), intent(in) :: y, yaw
      type(case_spec) :: spec

      spec = common_case(82000.0_wp, 0.35_wp)
      associate (pair => spec%wheel_rail)
         pair%rail_profile%name = environment("CONTACT_SOURCE") // "/examples/profiles/60E1.prr"
         pair%wheel_profile%name = environment("CONTACT_SOURCE") // "/examples/profiles/S1002.prw"
         pair%track%cant = 0.025_wp
         pair%wheelset%y = y
         pair%wheelset%yaw = yaw
         pair%wheelset%fz = 60000.0_wp
         pair%wheelset%vs = 20000.0_wp
         pair%wheelset%vpitch = -43.5_wp
      end associate
   end function railway_case

   !> A cylindrical wheel across a rail of the same radius 100, whose contact is that of a ball on a plane; both are soft
   function ball_case(pen) result(spec)
      !> Penetration [mm]
      real(wp), intent(in) :: pen
      type(case_spec) :: spec
      real(wp), parameter :: radius = 100.0_wp
      integer :: i

      call write_profile("ball_rail.dat", [(-20.0_wp + 0.25_wp*i, i=0, 160)], &
         & [(radius - sqrt(radius**2 - (-20.0_wp + 0.25_wp*i)**2), i=0, 160)])
      call write_profile("ball_wheel.dat", [(30.0_wp - 1.0_wp*i, i=0, 60)], [(0.0_wp, i=0, 60)])
      spec = common_case(200.0_wp, 0.4_wp)
      spec%normal = normal_control%approach
      associate (pair => spec%wheel_rail)
         pair%rail_profile%name = "ball_rail.dat"
         pair%wheel_profile%name = "ball_wheel.dat"
         pair%track%gaught = -1.0_wp
         pair%wheelset%fbdist = 0.0_wp
         pair%wheelset%fbpos = 0.0_wp
         pair%wheelset%nomradw = radius
         pair%wheelset%z = pen
         pair%wheelset%vs = 100.0_wp
         pair%wheelset%vpitch = -0.996_wp
      end associate
   end function ball_case

   function common_case(gg, mu) result(spec)
      !> Modulus [N/mm2], coefficient of friction [-]
      real(wp), intent(in) :: gg, mu
      type(case_spec) :: spec

      spec%link = time_link%initiate
      spec%estimate = estimate_choice%fresh
      spec%motion = motion%steady_rolling
      spec%normal = normal_control%force
      spec%force = force_control%creepages
      spec%iteration%eps = 1.0e-6_wp
      spec%material%gg = gg
      allocate(spec%friction%sets(1))
      spec%friction%sets(1) = friction_set(fstat=mu, fkin=mu)
      allocate(spec%wheel_rail)
   end function common_case
end module contact_test_pair_builder
