!> Correction of half-space coefficients for surfaces that are curved across the rolling direction
!>
!> The directions of traction and displacement differ between loaded and receiving element by the difference of inclinations
!> alpha = alpha_J - alpha_I. With the half-space matrix A in the directions x, s, n and the rotation R(alpha) about x, the
!> corrected matrix is A R(alpha), R(alpha) A, or, with the rotation shared, R(alpha/2) A R(alpha/2).
module contact_elastic_inclination
   use contact_base_kinds, only : wp
   use contact_elastic_halfspace, only : kernel_table
   use contact_elastic_model, only : surface_inclination
   implicit none (type, external)
   private

   public :: rotate_table

contains

   !> Coefficients for a constant rate of inclination with shared rotation, for which all symmetries are preserved
   subroutine rotate_table(table, inclination)
      !> On entry coefficients of flat bodies; coupling coefficients are created if there are none
      type(kernel_table), intent(inout) :: table
      !> Inclination with a constant rate along the surface
      type(surface_inclination), intent(in) :: inclination
      real(wp) :: alpha, c, s, c_half, s_half, half_sum, half_difference, a_xs, a_xn, a_sn
      integer :: k, l

      if (.not. allocated(table%xn)) allocate(table%xn, table%yn, mold=table%nn)
      if (.not. table%material%coupled()) then
         table%xn = 0.0_wp
         table%yn = 0.0_wp
      end if
      do l = -table%ny, table%ny
         alpha = -l*table%dy*inclination%rate()
         c = cos(alpha)
         s = sin(alpha)
         c_half = cos(0.5_wp*alpha)
         s_half = sin(0.5_wp*alpha)
         do k = -table%nx, table%nx
            half_sum = 0.5_wp*(table%yy(k, l) + table%nn(k, l))
            half_difference = 0.5_wp*(table%yy(k, l) - table%nn(k, l))
            a_xs = table%xy(k, l)
            a_xn = table%xn(k, l)
            a_sn = table%yn(k, l)
            table%yy(k, l) = half_difference + half_sum*c + a_sn*s
            table%nn(k, l) = -half_difference + half_sum*c + a_sn*s
            table%yn(k, l) = a_sn*c - half_sum*s
            table%xy(k, l) = a_xs*c_half + a_xn*s_half
            table%xn(k, l) = a_xn*c_half - a_xs*s_half
         end do
      end do
   end subroutine rotate_table
end module contact_elastic_inclination
