!> Pressures of a section with details between rows of elements, against Hertz's theory and the wave in full contact
program test_between_rows
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_patch_between_rows, only : has_details, parts, section_details, solve_section
   use contact_patch_result, only : patch_result
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   integer, parameter :: my = 30
   !> Side of the elements [mm], radius of the surface [mm], load per length [N/mm], shear modulus [N/mm2], Poisson's ratio
   real(wp), parameter :: dy = 0.5_wp, radius = 300.0_wp, load = 1.0e4_wp, gg = 82000.0_wp, nu = 0.28_wp
   real(wp), parameter :: modulus = gg/(1.0_wp - nu), half = sqrt(4.0_wp*load*radius/(pi*modulus)), &
      & hertz = sqrt(load*modulus/(pi*radius))
   !> Amplitude of the waves [mm] and radius of the ridge [mm]
   real(wp), parameter :: amplitude = 0.002_wp, sharp = 2.0_wp
   type(test_suite) :: suite
   type(patch_result) :: result
   type(section_details) :: details
   real(wp) :: un(my), fine(my*parts)
   integer :: i

   call suite%start("between rows")
   result%grid%mx = 1
   result%grid%my = my
   result%grid%dy = dy
   result%grid%yl = -0.5_wp*my*dy
   result%gg = gg
   result%nu = nu
   allocate(result%h(1, my), result%pn(1, my))
   call smooth()
   call waves()
   call ridge()
   call no_load()
   call suite%finish()

contains

   !> Position of a point [mm]
   pure real(wp) function point(k)
      integer, intent(in) :: k
      point = result%grid%yl + (k - 0.5_wp)*dy/parts
   end function point

   !> Approach and displacements for the pressures: those of plane strain, with the height of the surface at the first element in
   !> contact
   subroutine set_displacements()
      real(wp) :: left, right
      integer :: j, k

      do i = 1, my
         un(i) = 0.0_wp
         do j = 1, my
            left = (i - j - 0.5_wp)*dy
            right = (i - j + 0.5_wp)*dy
            un(i) = un(i) - 2.0_wp*result%pn(1, j)/(pi*modulus)*(right*(log(abs(right)) - 1.0_wp) - left*(log(abs(left)) - 1.0_wp))
         end do
      end do
      k = maxloc(result%pn(1, :), dim=1)
      un = un + 0.5_wp - un(k)
      result%pen = result%h(1, k) + un(k)
      result%pmax = maxval(result%pn)
   end subroutine set_displacements

   !> A cylinder: nothing between the rows, and the pressures are those of the elements
   subroutine smooth()
      do i = 1, my
         associate (y => result%grid%y(i))
            result%h(1, i) = y**2/(2.0_wp*radius)
            result%pn(1, i) = hertz*sqrt(max(0.0_wp, 1.0_wp - (y/half)**2))
         end associate
      end do
      do i = 1, my*parts
         fine(i) = point(i)**2/(2.0_wp*radius)
      end do
      call set_displacements()
      call suite%check(.not. has_details(result, 1, fine), "a cylinder has no details")
      call solve_section(result, 1, un, fine, details)
      call suite%check(details%known, "the section of a cylinder has pressures")
      call suite%close_to(details%peak, hertz, 0.01_wp, "peak of a cylinder", relative=.true.)
      call suite%close_to(details%approach, 0.0_wp, 1.0e-3_wp*half**2/(2.0_wp*radius), "its approach does not change")
   end subroutine smooth

   !> Waves with zeros at the centres, two elements long: in full contact their pressure is pi E a/l. The highest of the points is
   !> at 0.87 of the amplitude, and elements of a sixth of the wave carry 1.05 of the pressure there
   subroutine waves()
      real(wp), parameter :: wave = pi*modulus*amplitude/(2.0_wp*dy)
      real(wp), parameter :: highest = 0.866_wp*1.05_wp

      do i = 1, my*parts
         fine(i) = point(i)**2/(2.0_wp*radius) + amplitude*cos(pi*point(i)/dy)
      end do
      call suite%check(has_details(result, 1, fine), "waves are details")
      call solve_section(result, 1, un, fine, details)
      call suite%close_to(details%peak - hertz, highest*wave, 0.05_wp*wave, "pressure of waves in full contact")
   end subroutine waves

   !> A ridge that is narrower than two elements carries all the load: Hertz's theory with its radius
   subroutine ridge()
      do i = 1, my
         result%h(1, i) = result%grid%y(i)**2/(2.0_wp*sharp)
      end do
      do i = 1, my*parts
         fine(i) = point(i)**2/(2.0_wp*sharp)
      end do
      ! the elements beside the ridge share the load
      result%pn = 0.0_wp
      result%pn(1, my/2:my/2 + 1) = load/(2.0_wp*dy)
      call set_displacements()
      call solve_section(result, 1, un, fine, details)
      call suite%check(details%peak > 1.1_wp*result%pmax, "the ridge is higher than the elements show")
      call suite%close_to(details%peak, sqrt(load*modulus/(pi*sharp)), 0.15_wp, "peak of a ridge", relative=.true.)
   end subroutine ridge

   !> Without pressures there is no section
   subroutine no_load()
      result%pn = 0.0_wp
      call solve_section(result, 1, un, fine, details)
      call suite%check(.not. details%known, "a section without pressures is not known")
   end subroutine no_load
end program test_between_rows
