!> Elastic field below one loaded element, from derivatives of one harmonic potential
!>
!> The displacements and stresses in a half-space under the point loads of Boussinesq and Cerruti follow from a single potential
!> A per element, with d2A/dxdy = z ln(z+R) - R for the point load. The 26 second, third and fourth derivatives required do not
!> depend on the material. Integration over a rectangle turns a point load into a signed sum over four corners (Love 1929), and
!> a load that decreases linearly in both directions (bilinear element) into second differences over nine nodes. See
!> doc/theory/subsurface.md.
!>
!> Frame: the half-space is z >= 0, loads act on its surface, a normal load is positive into the
!> body, displacements are positive along the axes.
module contact_subsurface_element_field
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: n_derivatives, n_fields, odd_in_x, odd_in_y
   public :: corner_derivatives, node_derivatives, source_derivatives, element_derivatives, body_responses
   public :: load_quadrature, new_quadrature, far_distance

   !> Number of derivatives: 6 second, 10 third, and 10 fourth ones, the latter with at least one derivative to z
   integer, parameter :: n_derivatives = 26
   !> Number of fields: displacements x, y, z, then stresses xx, xy, xz, yy, yz, zz
   integer, parameter :: n_fields = 9

   !> Indices of the derivatives; the fourth ones are named by the three directions besides z
   integer, parameter :: xx = 1, xy = 2, xz = 3, yy = 4, yz = 5, zz = 6
   integer, parameter :: xxx = 7, xxy = 8, xxz = 9, xyy = 10, xyz = 11, xzz = 12, yyy = 13, yyz = 14, &
      & yzz = 15, zzz = 16
   integer, parameter :: xxxz = 17, xxyz = 18, xxzz = 19, xyyz = 20, xyzz = 21, xzzz = 22, yyyz = 23, &
      & yyzz = 24, yzzz = 25, zzzz = 26

   !> Minimum distance to an edge or corner, relative to the element side; the stress has a logarithmic singularity there if the
   !> load jumps
   real(wp), parameter, public :: edge_ratio = 5.0e-7_wp
   !> Beyond this distance in element sides, quadrature is more accurate than differences of closed forms; for constant and for
   !> bilinear loads
   real(wp), parameter :: far_constant = 20.0_wp, far_bilinear = 6.0_wp

   !> Beyond this distance the fields vanish, and powers of distances would overflow [mm]
   real(wp), parameter, public :: farthest_point = 1.0e60_wp

   !> Weights and abscissae of the load on an element in one direction; the weights sum to 1
   type :: load_quadrature
      !> Abscissae relative to the element side [-]
      real(wp), allocatable :: point(:)
      real(wp), allocatable :: weight(:)
   end type load_quadrature

contains

   !> Quadrature for a unit load on an element: Gauss rules for constant weight on (-1/2, 1/2), and for the weight 1 - |s| on
   !> (-1, 1)
   pure function new_quadrature(bilinear) result(rule)
      !> Does the load decrease linearly to the centres of the neighbours? Otherwise it is constant on the element
      logical, intent(in) :: bilinear
      type(load_quadrature) :: rule
      real(wp), parameter :: root(2) = &
         & [sqrt(3.0_wp/7.0_wp - 2.0_wp/7.0_wp*sqrt(1.2_wp)), sqrt(3.0_wp/7.0_wp + 2.0_wp/7.0_wp*sqrt(1.2_wp))]
      real(wp), parameter :: weight(2) = [18.0_wp + sqrt(30.0_wp), 18.0_wp - sqrt(30.0_wp)]/72.0_wp
      real(wp), parameter :: hat_root(3) = &
         & [0.19426367677503889161_wp, 0.5766148082484873353_wp, 0.86573829497881909617_wp]
      real(wp), parameter :: hat_weight(3) = &
         & [0.32302220463941780521_wp, 0.14748123370527284826_wp, 0.029496561655309346531_wp]

      if (bilinear) then
         rule%point = [-hat_root, hat_root]
         rule%weight = [hat_weight, hat_weight]
      else
         rule%point = 0.5_wp*[-root, root]
         rule%weight = [weight, weight]
      end if
   end function new_quadrature

   !> Distance from the centre of an element beyond which quadrature is used [mm]
   pure real(wp) function far_distance(dx, dy, bilinear)
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> As for new_quadrature
      logical, intent(in) :: bilinear

      far_distance = merge(far_bilinear, far_constant, bilinear)*max(dx, dy)
   end function far_distance

   !> Is a field odd in x, for a load in direction 1 (x), 2 or 3 at the origin?
   elemental logical function odd_in_x(field, load)
      !> Index of the field, 1 to 9 (three displacements, six stresses), and direction of the load: 1 (x), 2 (y), 3 (pressure)
      integer, intent(in) :: field, load
      logical, parameter :: by_pressure(n_fields) = &
         & [.true., .false., .false., .false., .true., .true., .false., .false., .false.]

      odd_in_x = by_pressure(field) .neqv. load == 1
   end function odd_in_x

   !> Is it odd in y?
   elemental logical function odd_in_y(field, load)
      !> As for odd_in_x
      integer, intent(in) :: field, load
      logical, parameter :: by_pressure(n_fields) = &
         & [.false., .true., .false., .false., .true., .false., .false., .true., .false.]

      odd_in_y = by_pressure(field) .neqv. load == 2
   end function odd_in_y

   !> Derivatives of the potential of a uniform unit load on the quadrant that starts at a corner
   !>
   !> Only signed sums over corners are meaningful.
   pure subroutine corner_derivatives(x, y, z, edge, d)
      !> Observation point relative to the corner [mm], z >= 0
      real(wp), intent(in) :: x, y, z
      !> Minimum distance to the edges [mm], positive, the same for all corners
      real(wp), intent(in) :: edge
      !> Derivatives [mm, 1, 1/mm]
      real(wp), intent(out) :: d(n_derivatives)
      real(wp) :: r, rz, rx, ry, lx, ly, lz, tx, ty, tz

      call logarithms(x, y, z, edge, r, lx, ly, lz, tx, ty, rx, ry)
      rz = r + z
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

   !> Derivatives of the potential whose second differences give a bilinear load
   !>
   !> The potential Q has Q_xy = A, so that its derivatives are integrals of those of A over x and y. Only second differences in
   !> both directions are meaningful.
   pure subroutine node_derivatives(x, y, z, edge, d)
      !> Observation point relative to the node [mm], z >= 0
      real(wp), intent(in) :: x, y, z
      !> Minimum distance to the axes [mm], positive, the same for all nodes
      real(wp), intent(in) :: edge
      !> Derivatives [mm3, mm2, mm]
      real(wp), intent(out) :: d(n_derivatives)
      real(wp), parameter :: half = 0.5_wp, third = 1.0_wp/3.0_wp, sixth = 1.0_wp/6.0_wp
      real(wp) :: r, lx, ly, lz, tx, ty, tz, x2, y2, z2

      call logarithms(x, y, z, edge, r, lx, ly, lz, tx, ty)
      tz = tx + ty
      x2 = x**2
      y2 = y**2
      z2 = z**2

      d(xx) = half*(y*(z2 - x2)*ly + z*(y2 - x2)*lz) + x*y*z*tx + sixth*(2.0_wp*x2 - y2 - z2)*r
      d(yy) = half*(x*(z2 - y2)*lx + z*(x2 - y2)*lz) + x*y*z*ty + sixth*(2.0_wp*y2 - x2 - z2)*r
      d(zz) = half*(y*(x2 - z2)*ly + x*(y2 - z2)*lx) - x*y*z*tz + sixth*(2.0_wp*z2 - x2 - y2)*r
      d(xz) = x*y*z*ly + half*(x*(y2 - third*x2)*lz + z*(y2 - third*z2)*lx - y*z2*tz + x2*y*tx) + sixth*y*y2*ty &
         & - third*x*z*r
      d(yz) = x*y*z*lx + half*(y*(x2 - third*y2)*lz + z*(x2 - third*z2)*ly - x*z2*tz + y2*x*ty) + sixth*x*x2*tx &
         & - third*y*z*r
      d(xy) = x*y*z*lz + half*(y*(z2 - third*y2)*lx + x*(z2 - third*x2)*ly + x2*z*tx + y2*z*ty) - sixth*z*z2*tz &
         & - third*x*y*r

      d(xxx) = y*z*tx - x*z*lz - x*y*ly + x*r
      d(yyy) = x*z*ty - y*z*lz - x*y*lx + y*r
      d(zzz) = z*r - y*z*ly - x*z*lx - x*y*tz
      d(xzz) = x*y*ly + half*(y2 - z2)*lx - y*z*tz - half*x*r
      d(yzz) = x*y*lx + half*(x2 - z2)*ly - x*z*tz - half*y*r
      d(xxy) = -d(yyy) - d(yzz)
      d(xyy) = -d(xxx) - d(xzz)
      d(xxz) = y*z*ly + half*(y2 - x2)*lz + x*y*tx - half*z*r
      d(yyz) = x*z*lx + half*(x2 - y2)*lz + x*y*ty - half*z*r
      d(xyz) = x*y*lz + x*z*ly + y*z*lx + half*(x2*tx + y2*ty - z2*tz)

      d(xyzz) = x*ly + y*lx - z*tz
      d(xxzz) = y*ly - r
      d(yyzz) = x*lx - r
      d(zzzz) = 2.0_wp*r - x*lx - y*ly
      d(xzzz) = -z*lx - y*tz
      d(yzzz) = -z*ly - x*tz
      d(xxyz) = y*lz + z*ly + x*tx
      d(xyyz) = x*lz + z*lx + y*ty
      d(xxxz) = y*tx - x*lz
      d(yyyz) = x*ty - y*lz
   end subroutine node_derivatives

   !> The distance, the three logarithms and the angles that occur in all derivatives
   !>
   !> ln(y+R) is computed as ln((x**2+z**2)/(R-y)) for y < 0, without cancellation, and the angles in forms that have the
   !> correct limits at the surface.
   pure subroutine logarithms(x, y, z, edge, r, lx, ly, lz, tx, ty, rx, ry)
      !> Observation point [mm], z >= 0
      real(wp), intent(in) :: x, y, z
      !> Minimum distance to the axes [mm], positive
      real(wp), intent(in) :: edge
      !> R [mm]; ln(x+R), ln(y+R), ln(z+R) up to constants; angles [rad]
      real(wp), intent(out) :: r, lx, ly, lz, tx, ty
      !> x+R and y+R [mm]
      real(wp), intent(out), optional :: rx, ry
      real(wp) :: along_x, along_y, floor2, rz

      floor2 = edge**2
      r = sqrt(max(x**2 + y**2 + z**2, floor2))
      rz = r + z
      if (x >= 0.0_wp) then
         along_x = r + x
      else
         along_x = max(y**2 + z**2, floor2)/(r - x)
      end if
      if (y >= 0.0_wp) then
         along_y = r + y
      else
         along_y = max(x**2 + z**2, floor2)/(r - y)
      end if
      lx = log(along_x)
      ly = log(along_y)
      lz = log(rz)
      tx = atan2(x*y, max(x**2 + z*rz, tiny(1.0_wp)))
      ty = atan2(x*y, max(y**2 + z*rz, tiny(1.0_wp)))
      if (present(rx)) rx = along_x
      if (present(ry)) ry = along_y
   end subroutine logarithms

   !> Derivatives of the potential of a unit point load, which is z ln(z+R) - R
   pure subroutine source_derivatives(x, y, z, d)
      !> Observation point relative to the load [mm], z >= 0, not all zero
      real(wp), intent(in) :: x, y, z
      !> Derivatives [1/mm, 1/mm2, 1/mm3]
      real(wp), intent(out) :: d(n_derivatives)
      real(wp) :: r, f, g, h, i, i3, i5, k, m, n

      r = sqrt(x**2 + y**2 + z**2)
      i = 1.0_wp/r
      i3 = i**3
      i5 = i3*i**2
      ! f = 1/(R+z) and its successive quotients (1/R) d/dR; likewise g = 1/(R (R+z))
      f = 1.0_wp/(r + z)
      g = f*i
      k = f*g
      m = -(3.0_wp*r + z)*f**3*i3
      h = -(2.0_wp*r + z)*f**2*i3
      n = (8.0_wp*r**2 + 9.0_wp*r*z + 3.0_wp*z**2)*f**3*i5

      d(xx) = k*x**2 - f
      d(yy) = k*y**2 - f
      d(xy) = k*x*y
      d(xz) = g*x
      d(yz) = g*y
      d(zz) = i

      d(xxx) = x*(3.0_wp*k + m*x**2)
      d(yyy) = y*(3.0_wp*k + m*y**2)
      d(xxy) = y*(k + m*x**2)
      d(xyy) = x*(k + m*y**2)
      d(xxz) = g + h*x**2
      d(yyz) = g + h*y**2
      d(xyz) = h*x*y
      d(xzz) = -x*i3
      d(yzz) = -y*i3
      d(zzz) = -z*i3

      d(xxxz) = x*(3.0_wp*h + n*x**2)
      d(yyyz) = y*(3.0_wp*h + n*y**2)
      d(xxyz) = y*(h + n*x**2)
      d(xyyz) = x*(h + n*y**2)
      d(xxzz) = 3.0_wp*x**2*i5 - i3
      d(yyzz) = 3.0_wp*y**2*i5 - i3
      d(zzzz) = 3.0_wp*z**2*i5 - i3
      d(xyzz) = 3.0_wp*x*y*i5
      d(xzzz) = 3.0_wp*x*z*i5
      d(yzzz) = 3.0_wp*y*z*i5
   end subroutine source_derivatives

   !> Derivatives of the potential of a unit load on one element
   pure subroutine element_derivatives(position, dx, dy, bilinear, d)
      !> Observation point relative to the centre of the element [mm], z >= 0
      real(wp), intent(in) :: position(3)
      !> Sides of the element [mm]
      real(wp), intent(in) :: dx, dy
      !> Does the load decrease to zero at the centres of the neighbours? Otherwise it is 1 on the element
      logical, intent(in) :: bilinear
      !> Derivatives [mm, 1, 1/mm]
      real(wp), intent(out) :: d(n_derivatives)
      type(load_quadrature) :: rule
      real(wp) :: part(n_derivatives), edge
      integer, parameter :: second_difference(-1:1) = [1, -2, 1]
      integer :: i, j

      d = 0.0_wp
      edge = edge_ratio*min(dx, dy)
      if (norm2(position) > far_distance(dx, dy, bilinear)) then
         rule = new_quadrature(bilinear)
         do j = 1, size(rule%point)
            do i = 1, size(rule%point)
               call source_derivatives(position(1) - rule%point(i)*dx, position(2) - rule%point(j)*dy, position(3), part)
               d = d + rule%weight(i)*rule%weight(j)*dx*dy*part
            end do
         end do
      else if (bilinear) then
         do j = -1, 1
            do i = -1, 1
               call node_derivatives(position(1) + i*dx, position(2) + j*dy, position(3), edge, part)
               d = d + second_difference(i)*second_difference(j)*part
            end do
         end do
         d = d/(dx*dy)
      else
         do j = -1, 1, 2
            do i = -1, 1, 2
               call corner_derivatives(position(1) + 0.5_wp*i*dx, position(2) + 0.5_wp*j*dy, position(3), edge, part)
               d = d + i*j*part
            end do
         end do
      end if
   end subroutine element_derivatives

   !> Fields in the coordinates of the contact for unit tractions px, py, pn
   !>
   !> Uses Hooke's law and the harmonic equation: the trace of the strains is (1 - 2 nu) times a derivative, so that nothing is
   !> singular for an incompressible body, and stresses do not depend on the modulus of rigidity. Body 2 carries the reaction
   !> and is rotated by half a revolution about the x-axis.
   pure subroutine body_responses(d, z, gg, nu, mirror, response)
      !> Derivatives for a unit load in the frame of the body, with y reversed for body 2
      real(wp), intent(in) :: d(n_derivatives)
      !> Depth of the observation point [mm], not negative
      real(wp), intent(in) :: z
      !> Modulus of rigidity [N/mm2] and Poisson's ratio [-]
      real(wp), intent(in) :: gg, nu
      !> 1 for body 1, -1 for body 2
      real(wp), intent(in) :: mirror
      !> Displacements [mm] and stresses [N/mm2], tension positive, one column per traction
      real(wp), intent(out) :: response(n_fields, 3)
      !> 2 nu, 1 - 2 nu, factors of displacements and stresses
      real(wp) :: nu2, rest, by_shear, by_stress

      nu2 = 2.0_wp*nu
      rest = 1.0_wp - nu2
      by_shear = 1.0_wp/(4.0_wp*pi*gg)
      by_stress = 1.0_wp/(2.0_wp*pi)

      response(1, 1) = by_shear*(2.0_wp*d(zz) + nu2*d(xx) - z*d(xxz))
      response(2, 1) = by_shear*(nu2*d(xy) - z*d(xyz))
      response(3, 1) = by_shear*(rest*d(xz) - z*d(xzz))
      response(4, 1) = by_stress*(2.0_wp*d(xzz) - nu2*d(xyy) - z*d(xxxz))
      response(5, 1) = by_stress*(d(yzz) + nu2*d(xxy) - z*d(xxyz))
      response(6, 1) = by_stress*(d(zzz) - z*d(xxzz))
      response(7, 1) = by_stress*(-nu2*d(xxx) - z*d(xyyz))
      response(8, 1) = -by_stress*z*d(xyzz)
      response(9, 1) = -by_stress*z*d(xzzz)

      response(1, 2) = response(2, 1)
      response(2, 2) = by_shear*(2.0_wp*d(zz) + nu2*d(yy) - z*d(yyz))
      response(3, 2) = by_shear*(rest*d(yz) - z*d(yzz))
      response(4, 2) = by_stress*(-nu2*d(yyy) - z*d(xxyz))
      response(5, 2) = by_stress*(d(xzz) + nu2*d(xyy) - z*d(xyyz))
      response(6, 2) = response(8, 1)
      response(7, 2) = by_stress*(2.0_wp*d(yzz) - nu2*d(xxy) - z*d(yyyz))
      response(8, 2) = by_stress*(d(zzz) - z*d(yyzz))
      response(9, 2) = -by_stress*z*d(yzzz)

      response(1, 3) = by_shear*(-rest*d(xz) - z*d(xzz))
      response(2, 3) = by_shear*(-rest*d(yz) - z*d(yzz))
      response(3, 3) = by_shear*((1.0_wp + rest)*d(zz) - z*d(zzz))
      response(4, 3) = by_stress*(-nu2*d(yyz) - d(xxz) - z*d(xxzz))
      response(5, 3) = by_stress*(-rest*d(xyz) - z*d(xyzz))
      response(6, 3) = response(9, 1)
      response(7, 3) = by_stress*(-nu2*d(xxz) - d(yyz) - z*d(yyzz))
      response(8, 3) = response(9, 2)
      response(9, 3) = by_stress*(d(zzz) - z*d(zzzz))

      if (mirror > 0.0_wp) return
      response(:, 1) = -response(:, 1)
      response(2:3, :) = -response(2:3, :)
      response(5:6, :) = -response(5:6, :)
   end subroutine body_responses
end module contact_subsurface_element_field
