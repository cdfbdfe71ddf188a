!> Friction that depends on the surface temperature
!>
!>     mu(T) = mu_cold + (mu_hot - mu_cold) min(1, max(0, (T - T_onset)/range))
module contact_friction_heated
   use contact_base_kinds, only : wp
   use contact_friction_law, only : friction_driver, friction_law, friction_set, title_length
   implicit none (type, external)
   private

   public :: heated_law

   type, extends(friction_law) :: heated_law
   contains
      procedure :: coefficient
      procedure, nopass :: title
      procedure, nopass :: driver
      procedure, nopass :: fault
      !> Coefficient of elements that are heated by their own friction
      procedure :: self_heated
   end type heated_law

contains

   pure function title()
      character(len=title_length) :: title
      title = "friction changing with temperature"
   end function title

   pure integer function driver()
      driver = friction_driver%temperature
   end function driver

   !> The range of temperatures must be positive
   pure function fault(set) result(text)
      type(friction_set), intent(in) :: set
      character(len=100) :: text

      text = ""
      if (set%dtheat <= 0.0_wp) text = "the temperature range in which friction changes must be positive"
   end function fault

   pure subroutine coefficient(self, cause, mu)
      class(heated_law), intent(in) :: self
      real(wp), contiguous, intent(in) :: cause(:, :)
      real(wp), contiguous, intent(inout) :: mu(:, :)
      type(friction_set) :: set
      integer :: iy

      do iy = 1, size(mu, 2)
         set = self%set_of_row(iy)
         mu(:, iy) = set%fstat + (set%fkin - set%fstat) &
            & *min(1.0_wp, max(0.0_wp, (cause(:, iy) - set%tref)/set%dtheat))
      end do
   end subroutine coefficient

   !> Coefficient of an element whose temperature rises with its own friction
   !>
   !> Solves mu = theta mu_before + (1 - theta) mu(temperature + rise mu), which is linear on each of the three pieces of the
   !> law. Where friction increases so steeply with temperature that two solutions are stable, the cold one is taken.
   pure real(wp) function self_heated(self, iy, temperature, rise, theta, mu_before) result(mu)
      class(heated_law), intent(in) :: self
      !> Row of the element
      integer, intent(in) :: iy
      !> Temperature without the heat of the element itself [degC], and temperature rise per unit of mu, at least 0
      real(wp), intent(in) :: temperature, rise
      !> Weight of the coefficient that particles had before, 0...1, and this coefficient [-]
      real(wp), intent(in) :: theta, mu_before
      real(wp) :: change, slope
      type(friction_set) :: set

      set = self%set_of_row(iy)
      mu = theta*mu_before + (1.0_wp - theta)*set%fstat
      if (temperature + rise*mu <= set%tref) return
      change = (1.0_wp - theta)*(set%fkin - set%fstat)
      slope = change/set%dtheat
      if (temperature + rise*(mu + change) >= set%tref + set%dtheat) then
         mu = mu + change
      else
         mu = (mu + slope*(temperature - set%tref))/(1.0_wp - slope*rise)
      end if
   end function self_heated
end module contact_friction_heated
