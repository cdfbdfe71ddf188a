!> Elastic field below a uniformly loaded rectangle, from derivatives of one harmonic potential
!>
!> The displacements and their gradients in a half-space under Boussinesq's and Cerruti's point
!> loads follow from one potential A per element, with d2A/dxdy = z ln(z+R) - R for the point
!> load. The 26 second, third and fourth derivatives that occur do not depend on the material;
!> they are summed over the loads first, and combined with Poisson's ratio once per point.
!> Integration over a rectangle turns a point load into a signed sum over four corners (Love
!> 1929). See doc/theory/subsurface.md.
!>
!> Frame: the half-space is z >= 0, loads act on its surface, a normal load is positive into the
!> body, displacements are positive along the axes.
module contact_subsurface_element_field
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: n_derivatives, corner_derivatives, source_derivatives, add_loads, combine_field
   public :: rectangle_derivatives, rectangle_field, hooke, turn_back

   !> Number of derivatives: 6 second, 10 third, 10 fourth ones of which one is to z
   integer, parameter :: n_derivatives = 26

   !> Numbers of the derivatives; the fourth ones are listed by the three directions besides z
   integer, parameter :: xx = 1, xy = 2, xz = 3, yy = 4, yz = 5, zz = 6
   integer, parameter :: xxx = 7, xxy = 8, xxz = 9, xyy = 10, xyz = 11, xzz = 12, yyy = 13, yyz = 14, &
      & yzz = 15, zzz = 16
   integer, parameter :: xxxz = 17, xxyz = 18, xxzz = 19, xyyz = 20, xyzz = 21, xzzz = 22, yyyz = 23, &
      & yyzz = 24, yzzz = 25, zzzz = 26

   !> Number of the derivative to two and to three directions
   integer, parameter :: second(3, 3) = reshape([xx, xy, xz,  xy, yy, yz,  xz, yz, zz], [3, 3])
   integer, parameter :: third(3, 3, 3) = reshape([ &
      & xxx, xxy, xxz,  xxy, xyy, xyz,  xxz, xyz, xzz, &
      & xxy, xyy, xyz,  xyy, yyy, yyz,  xyz, yyz, yzz, &
      & xxz, xyz, xzz,  xyz, yyz, yzz,  xzz, yzz, zzz], [3, 3, 3])
   !> From three directions to the same three and z
   integer, parameter :: and_z = xxxz - xxx

   !> Abscissae and weights of Gauss-Legendre quadrature with four points on (-1/2, 1/2)
   real(wp), parameter :: gauss_root(2) = &
      & [sqrt(3.0_wp/7.0_wp - 2.0_wp/7.0_wp*sqrt(1.2_wp)), sqrt(3.0_wp/7.0_wp + 2.0_wp/7.0_wp*sqrt(1.2_wp))]
   real(wp), parameter, public :: gauss_point(4) = &
      & 0.5_wp*[-gauss_root(2), -gauss_root(1), gauss_root(1), gauss_root(2)]
   real(wp), parameter, public :: gauss_weight(4) = &
      & [18.0_wp - sqrt(30.0_wp), 18.0_wp + sqrt(30.0_wp), 18.0_wp + sqrt(30.0_wp), 18.0_wp - sqrt(30.0_wp)]/72.0_wp
   !> Beyond this many sides of an element quadrature is more accurate than the corner sum
   real(wp), parameter, public :: far_ratio = 20.0_wp
   !> Smallest distance to an edge or corner that is told apart, per side of an element; the field
   !> has a logarithmic singularity there if the load jumps
   real(wp), parameter, public :: edge_ratio = 5.0e-7_wp
   !> Smallest value of 1 - 2 nu in the volumetric part of the stresses
   real(wp), parameter :: incompressible = 1.0e-6_wp

contains

   !> Derivatives of the potential of a uniform unit load on the quadrant that starts in a corner
   !>
   !> Only signed sums over corners have a meaning. The logarithms ln(y+R) are taken as
   !> ln((x**2+z**2)/(R-y)) for y < 0, free of cancellation, and the angles in forms that have
   !> the right limits at the surface.
   pure subroutine corner_derivatives(x, y, z, edge, d)
      !> Observation point relative to the corner [mm], z >= 0
      real(wp), intent(in) :: x, y, z
      !> Smallest distance to the edges that is told apart [mm], positive, the same for all corners
      real(wp), intent(in) :: edge
      !> Derivatives [mm, 1, 1/mm]
      real(wp), intent(out) :: d(n_derivatives)
      real(wp) :: r, rz, rx, ry, lx, ly, lz, tx, ty, tz, floor2

      floor2 = edge**2
      r = sqrt(max(x**2 + y**2 + z**2, floor2))
      rz = r + z
      if (x >= 0.0_wp) then
         rx = r + x
      else
         rx = max(y**2 + z**2, floor2)/(r - x)
      end if
      if (y >= 0.0_wp) then
         ry = r + y
      else
         ry = max(x**2 + z**2, floor2)/(r - y)
      end if
      lx = log(rx)
      ly = log(ry)
      lz = log(rz)
      tx = atan2(x*y, max(x**2 + z*rz, tiny(1.0_wp)))
      ty = atan2(x*y, max(y**2 + z*rz, tiny(1.0_wp)))
      tz = tx + ty

      d(xx) = z*tx - x*ly
      d(yy) = z*ty - y*lx
      d(zz) = x*ly + y*lx - z*tz
      d(xz) = y*lz + z*ly + x*tx
      d(yz) = x*lz + z*lx + y*ty
      d(xy) = z*lz - r

      d(xxx) = y/rz - ly
      d(yyy) = x/rz - lx
      d(zzz) = -tz
      d(xxy) = -x/rz
      d(xyy) = -y/rz
      d(xxz) = tx
      d(yyz) = ty
      d(xzz) = ly
      d(yzz) = lx
      d(xyz) = lz

      d(xyzz) = 1.0_wp/r
      d(xxzz) = x/(r*ry)
      d(yyzz) = y/(r*rx)
      d(zzzz) = -d(xxzz) - d(yyzz)
      d(xzzz) = z/(r*ry)
      d(yzzz) = z/(r*rx)
      d(xxyz) = x/(r*rz)
      d(xyyz) = y/(r*rz)
      d(xxxz) = -d(xyyz) - d(xzzz)
      d(yyyz) = -d(xxyz) - d(yzzz)
   end subroutine corner_derivatives

   !> Derivatives of the potential of a unit point load, which is z ln(z+R) - R
   pure subroutine source_derivatives(x, y, z, d)
      !> Observation point relative to the load [mm], z >= 0, not all zero
      real(wp), intent(in) :: x, y, z
      !> Derivatives [1/mm, 1/mm2, 1/mm3]
      real(wp), intent(out) :: d(n_derivatives)
      real(wp) :: r, f, g, h, k, m, n, r3, r5, rz

      r = sqrt(x**2 + y**2 + z**2)
      rz = r + z
      r3 = r**3
      r5 = r**5
      ! f = 1/(R+z) and its successive quotients (1/R) d/dR; likewise g = 1/(R (R+z))
      f = 1.0_wp/rz
      g = f/r
      k = f*g
      m = -(3.0_wp*r + z)*f**3/r3
      h = -(2.0_wp*r + z)*f**2/r3
      n = (8.0_wp*r**2 + 9.0_wp*r*z + 3.0_wp*z**2)*f**3/r5

      d(xx) = k*x**2 - f
      d(yy) = k*y**2 - f
      d(xy) = k*x*y
      d(xz) = g*x
      d(yz) = g*y
      d(zz) = 1.0_wp/r

      d(xxx) = x*(3.0_wp*k + m*x**2)
      d(yyy) = y*(3.0_wp*k + m*y**2)
      d(xxy) = y*(k + m*x**2)
      d(xyy) = x*(k + m*y**2)
      d(xxz) = g + h*x**2
      d(yyz) = g + h*y**2
      d(xyz) = h*x*y
      d(xzz) = -x/r3
      d(yzz) = -y/r3
      d(zzz) = -z/r3

      d(xxxz) = x*(3.0_wp*h + n*x**2)
      d(yyyz) = y*(3.0_wp*h + n*y**2)
      d(xxyz) = y*(h + n*x**2)
      d(xyyz) = x*(h + n*y**2)
      d(xxzz) = 3.0_wp*x**2/r5 - 1.0_wp/r3
      d(yyzz) = 3.0_wp*y**2/r5 - 1.0_wp/r3
      d(zzzz) = 3.0_wp*z**2/r5 - 1.0_wp/r3
      d(xyzz) = 3.0_wp*x*y/r5
      d(xzzz) = 3.0_wp*x*z/r5
      d(yzzz) = 3.0_wp*y*z/r5
   end subroutine source_derivatives

   !> Add the contribution of one corner or one point load
   pure subroutine add_loads(d, load, total)
      !> Derivatives for unit load
      real(wp), intent(in) :: d(n_derivatives)
      !> Load in x, y and z: signed jump of traction [N/mm2] or force [N]
      real(wp), intent(in) :: load(3)
      !> Derivatives times load, one column per load direction
      real(wp), intent(inout) :: total(n_derivatives, 3)
      integer :: t

      do t = 1, 3
         total(:, t) = total(:, t) + load(t)*d
      end do
   end subroutine add_loads

   !> Displacements and displacement gradients from the summed derivatives
   pure subroutine combine_field(total, z, gg, nu, displacement, gradient)
      !> Derivatives times load, one column per load direction
      real(wp), intent(in) :: total(n_derivatives, 3)
      !> Depth of the observation point [mm], z >= 0
      real(wp), intent(in) :: z
      !> Modulus of rigidity [N/mm2] and Poisson's ratio [-]
      real(wp), intent(in) :: gg, nu
      !> Displacements [mm]
      real(wp), intent(out) :: displacement(3)
      !> Gradients [-]: derivative of component i to direction j at (i, j)
      real(wp), intent(out) :: gradient(3, 3)
      !> Factors of the derivative to zz and of the one to t and i
      real(wp) :: direct, mixed
      real(wp) :: u, du(3)
      integer :: i, j, t

      do i = 1, 3
         u = 0.0_wp
         du = 0.0_wp
         do t = 1, 3
            direct = 0.0_wp
            if (t == i) direct = merge(2.0_wp*(1.0_wp - nu), 2.0_wp, t == 3)
            if (t == 3) then
               mixed = merge(0.0_wp, 2.0_wp*nu - 1.0_wp, i == 3)
            else
               mixed = merge(1.0_wp - 2.0_wp*nu, 2.0_wp*nu, i == 3)
            end if
            u = u + direct*total(zz, t) + mixed*total(second(t, i), t) - z*total(third(t, i, 3), t)
            do j = 1, 3
               du(j) = du(j) + direct*total(third(3, 3, j), t) + mixed*total(third(t, i, j), t) &
                  & - z*total(third(t, i, j) + and_z, t)
            end do
            du(3) = du(3) - total(third(t, i, 3), t)
         end do
         displacement(i) = u/(4.0_wp*pi*gg)
         gradient(i, :) = du/(4.0_wp*pi*gg)
      end do
   end subroutine combine_field

   !> Derivatives of the potential of a unit load per area on one rectangle
   !>
   !> The corner sum near the rectangle, quadrature of the point load far away from it.
   pure subroutine rectangle_derivatives(position, dx, dy, d)
      !> Observation point relative to the centre of the rectangle [mm], z >= 0
      real(wp), intent(in) :: position(3)
      !> Sides of the rectangle [mm]
      real(wp), intent(in) :: dx, dy
      !> Derivatives [mm, 1, 1/mm]
      real(wp), intent(out) :: d(n_derivatives)
      real(wp) :: part(n_derivatives), edge
      integer :: i, j

      d = 0.0_wp
      if (norm2(position) > far_ratio*max(dx, dy)) then
         do j = 1, 4
            do i = 1, 4
               call source_derivatives(position(1) - gauss_point(i)*dx, position(2) - gauss_point(j)*dy, &
                  & position(3), part)
               d = d + gauss_weight(i)*gauss_weight(j)*dx*dy*part
            end do
         end do
      else
         edge = edge_ratio*min(dx, dy)
         do j = -1, 1, 2
            do i = -1, 1, 2
               call corner_derivatives(position(1) + 0.5_wp*i*dx, position(2) + 0.5_wp*j*dy, position(3), edge, part)
               d = d + i*j*part
            end do
         end do
      end if
   end subroutine rectangle_derivatives

   !> Displacements and gradients below one uniformly loaded rectangle
   pure subroutine rectangle_field(position, dx, dy, load, gg, nu, displacement, gradient)
      !> Observation point relative to the centre of the rectangle [mm], z >= 0
      real(wp), intent(in) :: position(3)
      !> Sides of the rectangle [mm]
      real(wp), intent(in) :: dx, dy
      !> Tractions on the surface in x, y and z [N/mm2]
      real(wp), intent(in) :: load(3)
      !> Modulus of rigidity [N/mm2] and Poisson's ratio [-]
      real(wp), intent(in) :: gg, nu
      !> Displacements [mm]
      real(wp), intent(out) :: displacement(3)
      !> Gradients [-]: derivative of component i to direction j at (i, j)
      real(wp), intent(out) :: gradient(3, 3)
      real(wp) :: d(n_derivatives), total(n_derivatives, 3)

      call rectangle_derivatives(position, dx, dy, d)
      total = 0.0_wp
      call add_loads(d, load, total)
      call combine_field(total, position(3), gg, nu, displacement, gradient)
   end subroutine rectangle_field

   !> From the frame of body 2 to the coordinates of the contact
   pure subroutine turn_back(displacement, gradient)
      real(wp), intent(inout) :: displacement(3), gradient(3, 3)

      displacement(2:3) = -displacement(2:3)
      gradient(2:3, 1) = -gradient(2:3, 1)
      gradient(1, 2:3) = -gradient(1, 2:3)
   end subroutine turn_back

   !> Stresses by Hooke's law: xx, xy, xz, yy, yz, zz
   pure function hooke(gradient, gg, nu) result(stress)
      !> Gradients [-]: derivative of component i to direction j at (i, j)
      real(wp), intent(in) :: gradient(3, 3)
      !> Modulus of rigidity [N/mm2] and Poisson's ratio [-]
      real(wp), intent(in) :: gg, nu
      !> Stresses [N/mm2], tension positive
      real(wp) :: stress(6)
      real(wp) :: volumetric

      volumetric = 2.0_wp*gg*nu/max(incompressible, 1.0_wp - 2.0_wp*nu) &
         & *(gradient(1, 1) + gradient(2, 2) + gradient(3, 3))
      stress(1) = 2.0_wp*gg*gradient(1, 1) + volumetric
      stress(2) = gg*(gradient(1, 2) + gradient(2, 1))
      stress(3) = gg*(gradient(1, 3) + gradient(3, 1))
      stress(4) = 2.0_wp*gg*gradient(2, 2) + volumetric
      stress(5) = gg*(gradient(2, 3) + gradient(3, 2))
      stress(6) = 2.0_wp*gg*gradient(3, 3) + volumetric
   end function hooke
end module contact_subsurface_element_field
