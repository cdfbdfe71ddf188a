!> Friction laws: values at rest, at the half-value velocities and far out; rows; refusals
program test_laws
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_friction_heated, only : heated_law
   use contact_friction_law, only : friction_driver, friction_law, friction_set
   use contact_friction_new_law, only : friction_model, new_friction_law
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> A few roundings of closed forms
   real(wp), parameter :: closed = 10.0_wp*epsilon(1.0_wp)
   !> The velocity laws in one list
   integer, parameter :: falling(3) = [friction_model%linear, friction_model%rational, friction_model%exponential]
   type(test_suite) :: suite

   call suite%start("friction laws")
   call values(suite)
   call rows(suite)
   call monotone(suite)
   call no_terms_is_coulomb(suite)
   call own_heat(suite)
   call refusals(suite)
   call suite%finish()

contains

   !> Coefficient of one element in the first row
   real(wp) function mu_at(law, cause) result(mu)
      class(friction_law), intent(in) :: law
      real(wp), intent(in) :: cause
      real(wp) :: field(1, 1)

      field = -1.0_wp
      call law%coefficient(reshape([cause], [1, 1]), field)
      mu = field(1, 1)
   end function mu_at

   !> A law without an error
   subroutine make(suite, choice, sets, law)
      type(test_suite), intent(inout) :: suite
      integer, intent(in) :: choice
      type(friction_set), intent(in) :: sets(:)
      class(friction_law), allocatable, intent(out) :: law
      type(error_type), allocatable :: error

      call new_friction_law(choice, sets, law, error)
      call suite%check(.not. allocated(error), "the law is made")
   end subroutine make

   pure type(friction_set) function two_terms() result(set)
      set%fstat = 0.34_wp
      set%fkin = 0.15_wp
      set%coef1 = 0.12_wp
      set%coef2 = 0.07_wp
      set%sabsh1 = 80.0_wp
      set%sabsh2 = 900.0_wp
   end function two_terms

   subroutine values(suite)
      type(test_suite), intent(inout) :: suite
      class(friction_law), allocatable :: law
      type(friction_set) :: set
      integer :: k

      set = two_terms()
      do k = 1, size(falling)
         call make(suite, falling(k), [set], law)
         call suite%equal(law%driver(), friction_driver%slip_speed, "decreases with slip")
         call suite%close_to(mu_at(law, 0.0_wp), 0.34_wp, closed, "all of it at rest")
      end do
      set%coef2 = 0.0_wp
      set%sabsh2 = 0.0_wp
      do k = 1, size(falling)
         call make(suite, falling(k), [set], law)
         call suite%close_to(mu_at(law, 80.0_wp), 0.21_wp, closed, "half of the term at its velocity")
      end do
      call make(suite, friction_model%linear, [set], law)
      call suite%close_to(mu_at(law, 160.0_wp), 0.15_wp, closed, "linear: zero at twice the velocity")
      call suite%close_to(mu_at(law, 1.0e9_wp), 0.15_wp, closed, "linear: never below the kinetic coefficient")
      call make(suite, friction_model%exponential, [set], law)
      call suite%close_to(mu_at(law, 240.0_wp), 0.165_wp, closed, "exponential: an eighth at three times the velocity")
      call suite%close_to(mu_at(law, 1.0e9_wp), 0.15_wp, closed, "exponential: far out")
      set = two_terms()
      call make(suite, friction_model%rational, [set], law)
      call suite%close_to(mu_at(law, 1800.0_wp), 0.15_wp + 0.12_wp/23.5_wp + 0.07_wp/5.0_wp, closed, "rational: both terms")
      call make(suite, friction_model%coulomb, [set], law)
      call suite%close_to(mu_at(law, 55.0_wp), 0.34_wp, 0.0_wp, "Coulomb: the static coefficient")
      set%fstat = 0.5_wp
      set%fkin = 0.2_wp
      set%tref = 100.0_wp
      set%dtheat = 300.0_wp
      call make(suite, friction_model%temperature, [set], law)
      call suite%equal(law%driver(), friction_driver%temperature, "changes with temperature")
      call suite%close_to(mu_at(law, -40.0_wp), 0.5_wp, closed, "cold")
      call suite%close_to(mu_at(law, 200.0_wp), 0.4_wp, closed, "on the way")
      call suite%close_to(mu_at(law, 4000.0_wp), 0.2_wp, closed, "hot")
   end subroutine values

   !> A set per row acts in its row only
   subroutine rows(suite)
      type(test_suite), intent(inout) :: suite
      class(friction_law), allocatable :: law
      type(friction_set) :: sets(3)
      real(wp) :: mu(4, 3), rest(4, 3)
      integer :: k

      sets = two_terms()
      sets%fkin = [0.1_wp, 0.2_wp, 0.3_wp]
      sets%fstat = sets%fkin + 0.19_wp
      do k = 1, size(falling)
         call make(suite, falling(k), sets, law)
         call suite%check(law%varies_by_row(), "friction varies")
         call law%coefficient(reshape(spread(50.0_wp, 1, 12), [4, 3]), mu)
         call law%at_rest(rest)
         call suite%close_to(mu(4, :) - mu(1, 1), [0.0_wp, 0.1_wp, 0.2_wp], closed, "kinetic coefficients by row")
         call suite%close_to(rest(2, :), sets%fstat, closed, "at rest by row")
      end do
      call make(suite, friction_model%coulomb, sets, law)
      call law%coefficient(mu, rest)
      call suite%close_to(rest(2, :), sets%fstat, closed, "Coulomb by row")
      call make(suite, friction_model%coulomb, sets(1:1), law)
      call suite%check(.not. law%varies_by_row(), "one set does not vary")
   end subroutine rows

   !> Coefficients never increase with slip and are between the limits
   subroutine monotone(suite)
      type(test_suite), intent(inout) :: suite
      class(friction_law), allocatable :: law
      real(wp) :: speed(200, 1), mu(200, 1)
      integer :: k, i

      speed(:, 1) = [(1.0e-3_wp*1.1_wp**i, i=1, 200)]
      do k = 1, size(falling)
         call make(suite, falling(k), [two_terms()], law)
         call law%coefficient(speed, mu)
         call suite%check(all(mu(2:, 1) <= mu(:199, 1)), "friction falls")
         call suite%check(all(mu >= 0.15_wp .and. mu <= 0.34_wp + closed), "between the limits")
      end do
   end subroutine monotone

   subroutine no_terms_is_coulomb(suite)
      type(test_suite), intent(inout) :: suite
      class(friction_law), allocatable :: law
      type(friction_set) :: set
      integer :: k

      set%fstat = 0.27_wp
      set%fkin = 0.27_wp
      do k = 1, size(falling)
         call make(suite, falling(k), [set], law)
         call suite%close_to(mu_at(law, 123.0_wp), 0.27_wp, 0.0_wp, "without terms: Coulomb")
      end do
      call make(suite, friction_model%temperature, [set], law)
      call suite%close_to(mu_at(law, 123.0_wp), 0.27_wp, 0.0_wp, "without change: Coulomb")
   end subroutine no_terms_is_coulomb

   !> The coefficient of elements that heat themselves solves its equation on every piece of the law
   subroutine own_heat(suite)
      type(test_suite), intent(inout) :: suite
      class(friction_law), allocatable :: law
      type(friction_set) :: set
      real(wp) :: mu, theta, rise, temperature
      integer :: i, j, k, sign_

      do sign_ = -1, 1, 2
         set%fstat = 0.4_wp
         set%fkin = 0.4_wp + 0.3_wp*sign_
         set%tref = 100.0_wp
         set%dtheat = 50.0_wp
         call make(suite, friction_model%temperature, [set], law)
         select type (law)
         type is (heated_law)
            do k = 0, 4
               theta = 0.25_wp*k
               do j = 0, 12
                  rise = 100.0_wp*j
                  do i = -10, 30
                     temperature = 7.0_wp*i
                     mu = law%self_heated(1, temperature, rise, theta, 0.35_wp)
                     call suite%close_to(mu, theta*0.35_wp + (1.0_wp - theta)*mu_at(law, temperature + rise*mu), &
                        & 1.0e-12_wp, "agrees with its own heat")
                  end do
               end do
            end do
         end select
      end do
   end subroutine own_heat

   subroutine refusals(suite)
      type(test_suite), intent(inout) :: suite
      type(friction_set) :: set, none(0)

      call refused(suite, friction_model%coulomb, none, "no set at all")
      call refused(suite, 5, [set], "a law that does not exist")
      set%coef1 = 0.1_wp
      set%sabsh1 = 0.0_wp
      call refused(suite, friction_model%linear, [set], "a velocity of zero")
      set%sabsh1 = ieee_value(1.0_wp, ieee_quiet_nan)
      call refused(suite, friction_model%rational, [set], "a velocity of NaN")
      set%sabsh1 = 1.0_wp
      set%fkin = -0.1_wp
      call refused(suite, friction_model%exponential, [set], "negative friction")
      set%fkin = 0.1_wp
      set%dtheat = 0.0_wp
      call refused(suite, friction_model%temperature, [set], "a range of zero")
   end subroutine refusals

   subroutine refused(suite, choice, sets, what)
      type(test_suite), intent(inout) :: suite
      integer, intent(in) :: choice
      type(friction_set), intent(in) :: sets(:)
      character(len=*), intent(in) :: what
      class(friction_law), allocatable :: law
      type(error_type), allocatable :: error

      call new_friction_law(choice, sets, law, error)
      call suite%check(allocated(error), what // " is refused")
   end subroutine refused
end program test_laws
