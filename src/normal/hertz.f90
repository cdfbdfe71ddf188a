!> Hertz's solution: frictionless contact of two quadratic surfaces, and of cylinders
!>
!> The undeformed distance is h = a1 x**2 + b1 y**2; the contact area is an ellipse with semi-axes aa, bb along x and y. Each
!> procedure starts from different known quantities and computes the others. Theory and symbols: doc/theory/hertz.md, after
!> Hertz (1882) and Johnson (1985).
module contact_normal_hertz
   use contact_base_choices, only : normal_control
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_numeric_elliptic, only : complete_elliptic, elliptic_integrals
   implicit none (type, external)
   private

   public :: hertz_load, hertz_contact
   public :: hertz_by_curvatures, hertz_by_ratio, hertz_by_axes
   public :: line_contact_by_curvature, line_contact_by_axes
   public :: curvature_ratio, axis_ratio

   !> Approach that represents "just touching" if an area is prescribed without load [mm]
   real(wp), parameter :: min_approach = 1.0e-9_wp

   !> Load of the contact
   type :: hertz_load
      !> Member of normal_control: force or approach prescribed
      integer :: control = normal_control%force
      !> Prescribed normal force [N] or approach [mm]; negative values are treated as zero
      real(wp) :: fn = 0.0_wp, pen = 0.0_wp
      !> Contact modulus G/(1 - nu) of the combined material [N/mm2]
      real(wp) :: modulus = 1.0_wp
   end type hertz_load

   !> Complete solution
   type :: hertz_contact
      !> Curvatures of the undeformed distance along x and y [1/mm]
      real(wp) :: a1 = 0.0_wp, b1 = 0.0_wp
      !> Semi-axes along x and y [mm], zero without load; bb is half the length of a line contact
      real(wp) :: aa = 0.0_wp, bb = 0.0_wp
      !> Ratio aa/bb [-], defined also when both are zero
      real(wp) :: aob = 1.0_wp
      !> Effective radius of curvature 2/(a1 + b1) [mm], effective semi-axis [mm]
      real(wp) :: rho = 0.0_wp, cp = 0.0_wp
      !> Derivative of the logarithm of the ratio of curvatures with respect to that of the ratio of semi-axes [-]; 0 if unknown
      real(wp) :: slope = 0.0_wp
      !> Normal force [N] and approach [mm]; the approach of a line contact is undefined and set to 0
      real(wp) :: fn = 0.0_wp, pen = 0.0_wp
   end type hertz_contact

contains

   !> Ratio of the smaller to the larger curvature for an ellipse of given aspect ratio
   !>
   !> The larger curvature is in the direction of the smaller semi-axis.
   elemental function curvature_ratio(g) result(ratio)
      !> Ratio of the smaller to the larger semi-axis [-], 0 < g <= 1
      real(wp), intent(in) :: g
      real(wp) :: ratio
      type(elliptic_integrals) :: integrals

      integrals = complete_elliptic(g)
      ratio = g**2*(integrals%d/integrals%b)
   end function curvature_ratio

   !> Ratio of the smaller to the larger semi-axis for given curvatures: inverse of curvature_ratio
   !>
   !> Newton's method for log(ratio) as a function of log(g), whose slope is between 3/2 (circle) and 2 (slender ellipse), needs
   !> about five steps for any ratio. Unlike bisection of the modulus k it resolves slender ellipses.
   elemental function axis_ratio(ratio, near) result(g)
      !> Ratio of the smaller to the larger curvature [-], 0 < ratio <= 1
      real(wp), intent(in) :: ratio
      !> Estimate of the result, 0 < near <= 1; by default derived from the ratio
      real(wp), intent(in), optional :: near
      real(wp) :: g
      integer, parameter :: max_steps = 50
      !> The error after a step is less than a tenth of the step squared: the slope of the function changes between 3/2 and 2
      real(wp), parameter :: tolerance = 1.0e-7_wp
      type(elliptic_integrals) :: integrals
      real(wp) :: step
      integer :: i

      ! D >= B, hence ratio >= g**2
      g = min(1.0_wp, sqrt(ratio))
      if (present(near)) g = near
      do i = 1, max_steps
         integrals = complete_elliptic(g)
         step = log(ratio*integrals%b/(g**2*integrals%d))/ratio_slope(g, integrals)
         g = min(1.0_wp, g*exp(step))
         if (abs(step) <= tolerance) exit
      end do
   end function axis_ratio

   !> Derivative of log(curvature ratio) with respect to log(g)
   elemental function ratio_slope(g, integrals) result(slope)
      real(wp), intent(in) :: g
      !> The integrals for this g
      type(elliptic_integrals), intent(in) :: integrals
      real(wp) :: slope
      !> Squared modulus below which the derivative of D at the circle is used
      real(wp), parameter :: nearly_circular = 1.0e-6_wp
      real(wp) :: m, db, dd

      ! derivatives with respect to m = k**2, times g**2
      m = (1.0_wp - g)*(1.0_wp + g)
      if (m > nearly_circular) then
         dd = 0.5_wp*(integrals%b - g**2*integrals%d)/m
      else
         dd = 3.0_wp*pi/32.0_wp
      end if
      db = g**2*(0.5_wp*integrals%d - dd)
      slope = 2.0_wp - 2.0_wp*(dd/integrals%d - db/integrals%b)
   end function ratio_slope

   !> Solution for given curvatures
   elemental function hertz_by_curvatures(load, a1, b1, near) result(hertz)
      !> Prescribed force or approach, and combined elastic constants
      type(hertz_load), intent(in) :: load
      !> Curvatures along x and y [1/mm], positive
      real(wp), intent(in) :: a1, b1
      !> Estimate of the ratio of the smaller to the larger semi-axis, see `axis_ratio`
      real(wp), intent(in), optional :: near
      type(hertz_contact) :: hertz
      real(wp) :: g

      g = axis_ratio(min(a1, b1)/max(a1, b1), near)
      hertz%a1 = a1
      hertz%b1 = b1
      hertz%aob = merge(g, 1.0_wp/g, a1 >= b1)
      call press_together(load, g, hertz)
   end function hertz_by_curvatures

   !> Solution for given curvature along x and ratio of semi-axes
   elemental function hertz_by_ratio(load, a1, aob) result(hertz)
      !> Prescribed force or approach, and combined elastic constants
      type(hertz_load), intent(in) :: load
      !> Curvature along x [1/mm] and ratio aa/bb [-], positive
      real(wp), intent(in) :: a1, aob
      type(hertz_contact) :: hertz
      real(wp) :: g, ratio

      g = min(aob, 1.0_wp/aob)
      ratio = curvature_ratio(g)
      hertz%a1 = a1
      hertz%b1 = merge(a1*ratio, a1/ratio, aob <= 1.0_wp)
      hertz%aob = aob
      call press_together(load, g, hertz)
   end function hertz_by_ratio

   !> Complete a solution from curvatures and ratio of the axes
   pure subroutine press_together(load, g, hertz)
      type(hertz_load), intent(in) :: load
      !> Ratio of the smaller to the larger semi-axis [-]
      real(wp), intent(in) :: g
      !> On entry a1, b1, aob are set
      type(hertz_contact), intent(inout) :: hertz
      type(elliptic_integrals) :: integrals

      integrals = complete_elliptic(g)
      hertz%slope = ratio_slope(g, integrals)
      hertz%rho = 2.0_wp/(hertz%a1 + hertz%b1)
      if (load%control == normal_control%force) then
         hertz%fn = max(0.0_wp, load%fn)
         hertz%cp = (0.75_wp*hertz%fn*hertz%rho*integrals%e/(pi*load%modulus*sqrt(g)))**(1.0_wp/3.0_wp)
         hertz%pen = 2.0_wp*hertz%cp**2*g*integrals%k/(hertz%rho*integrals%e)
      else
         hertz%pen = max(0.0_wp, load%pen)
         hertz%cp = sqrt(0.5_wp*hertz%pen*hertz%rho*integrals%e/(integrals%k*g))
         hertz%fn = force_of_axis(hertz%cp, g, hertz%rho, load%modulus, integrals)
      end if
      hertz%aa = hertz%cp*sqrt(hertz%aob)
      hertz%bb = hertz%cp/sqrt(hertz%aob)
   end subroutine press_together

   !> Normal force [N] of an ellipse with effective semi-axis cp
   elemental function force_of_axis(cp, g, rho, modulus, integrals) result(fn)
      real(wp), intent(in) :: cp, g, rho, modulus
      type(elliptic_integrals), intent(in) :: integrals
      real(wp) :: fn

      fn = 4.0_wp*pi*cp**3*modulus*sqrt(g)/(3.0_wp*rho*integrals%e)
   end function force_of_axis

   !> Solution for given semi-axes; the curvatures follow from the load
   !>
   !> Without load the curvatures are those of a very small approach; force and approach are then zero if the force was
   !> prescribed, and otherwise those of this approach.
   elemental function hertz_by_axes(load, aa, bb) result(hertz)
      !> Prescribed force or approach, and combined elastic constants
      type(hertz_load), intent(in) :: load
      !> Semi-axes [mm], positive
      real(wp), intent(in) :: aa, bb
      type(hertz_contact) :: hertz
      type(elliptic_integrals) :: integrals
      real(wp) :: g, ratio, larger

      g = min(aa, bb)/max(aa, bb)
      integrals = complete_elliptic(g)
      hertz%aa = aa
      hertz%bb = bb
      hertz%aob = aa/bb
      hertz%cp = sqrt(aa)*sqrt(bb)
      if (load%control == normal_control%force .and. load%fn > 0.0_wp) then
         hertz%fn = load%fn
         hertz%rho = 4.0_wp*pi*hertz%cp**3*load%modulus*sqrt(g)/(3.0_wp*load%fn*integrals%e)
         hertz%pen = 2.0_wp*hertz%cp**2*g*integrals%k/(hertz%rho*integrals%e)
      else
         hertz%pen = min_approach
         if (load%control == normal_control%approach) hertz%pen = max(load%pen, min_approach)
         hertz%rho = 2.0_wp*hertz%cp**2*g*integrals%k/(hertz%pen*integrals%e)
         hertz%fn = force_of_axis(hertz%cp, g, hertz%rho, load%modulus, integrals)
         if (load%control == normal_control%force) then
            hertz%fn = 0.0_wp
            hertz%pen = 0.0_wp
         end if
      end if
      ratio = g**2*(integrals%d/integrals%b)
      larger = 2.0_wp/(hertz%rho*(1.0_wp + ratio))
      hertz%a1 = merge(larger, ratio*larger, aa <= bb)
      hertz%b1 = merge(ratio*larger, larger, aa <= bb)
   end function hertz_by_axes

   !> Solution of a line contact of finite length, for given curvature along x and half length
   elemental function line_contact_by_curvature(load, a1, bb) result(hertz)
      !> Load with prescribed force
      type(hertz_load), intent(in) :: load
      !> Curvature along x [1/mm], half length along y [mm], positive
      real(wp), intent(in) :: a1, bb
      type(hertz_contact) :: hertz

      hertz%fn = max(0.0_wp, load%fn)
      hertz%aa = sqrt(hertz%fn/(pi*load%modulus*a1*bb))
      call complete_line(a1, bb, hertz)
   end function line_contact_by_curvature

   !> Solution of a line contact of finite length, for given half width and half length
   !>
   !> Without load the curvature is very small.
   elemental function line_contact_by_axes(load, aa, bb) result(hertz)
      !> Load with prescribed force
      type(hertz_load), intent(in) :: load
      !> Half width along x, half length along y [mm], positive
      real(wp), intent(in) :: aa, bb
      type(hertz_contact) :: hertz
      real(wp) :: a1

      hertz%fn = max(0.0_wp, load%fn)
      hertz%aa = aa
      a1 = min_approach/aa**2
      if (hertz%fn > 0.0_wp) a1 = hertz%fn/(pi*aa**2*load%modulus*bb)
      call complete_line(a1, bb, hertz)
   end function line_contact_by_axes

   !> Complete a line contact from force and half width
   pure subroutine complete_line(a1, bb, hertz)
      real(wp), intent(in) :: a1, bb
      !> On entry fn and aa are set
      type(hertz_contact), intent(inout) :: hertz

      hertz%a1 = a1
      hertz%b1 = 0.0_wp
      hertz%bb = bb
      hertz%aob = hertz%aa/bb
      hertz%rho = 2.0_wp/a1
      hertz%cp = sqrt(4.0_wp*hertz%aa*bb/pi)
      hertz%pen = 0.0_wp
   end subroutine complete_line
end module contact_normal_hertz
