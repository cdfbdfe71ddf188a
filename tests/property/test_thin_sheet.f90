!> Elastic thin sheet between the bodies (B = 1): u = A p + FLXZ p in the normal problem
program test_thin_sheet
   use contact_base_choices, only : kernel_model, material_model, motion, normal_control, pressure_model, sensitivity_choice
   use contact_base_error, only : error_type
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_grid_element_division, only : element
   use contact_test_case_builder, only : creep, grid_case, test_case
   use contact_test_harness, only : test_suite
   use contact_test_pair_builder, only : pair_case, railway_case
   implicit none (type, external)
   !> Kinds of coefficients: half-spaces by two elements, turned by one rate of inclination, turned row by row, with memory
   character(len=*), parameter :: kinds(5) = [character(len=20) :: "piecewise constant", "bilinear", "inclined", "curved", "memory"]
   type(test_suite) :: suite

   call suite%start("thin sheet")
   call dense()
   call limits()
   call large_grid()
   call stiffness()
   call wheel_on_rail()
   call refusals()
   call suite%finish()

contains

   !> Pressed paraboloid with a sheet
   function sheet_case(flxz, n) result(spec)
      !> [mm3/N]; 0: no sheet
      real(wp), intent(in) :: flxz
      !> Elements along the window of 9 mm
      integer, intent(in) :: n
      type(case_spec) :: spec

      spec = grid_case(0.04_wp, 0.06_wp, 400.0_wp, n, n, 9.0_wp/n, 9.0_wp/n, eps=1.0e-11_wp)
      spec%geometry%b(6) = 0.1_wp
      if (flxz <= 0.0_wp) return
      spec%pressure = pressure_model%thin_sheet
      spec%material%flxz = flxz
   end function sheet_case

   !> Choose one of the kinds of coefficients
   subroutine choose(spec, kind_)
      type(case_spec), intent(inout) :: spec
      integer, intent(in) :: kind_

      if (kind_ == 2) spec%kernel = kernel_model%bilinear
      if (kind_ == 3 .or. kind_ == 4) then
         spec%kernel = kernel_model%conformal
         spec%material%if_meth = kind_ - 3
         spec%material%table_y = [-5.0_wp, 0.0_wp, 5.0_wp]
         spec%material%table_alpha = [-0.3_wp, 0.1_wp, 0.4_wp]
      end if
      if (kind_ == 5) then
         spec%material_model = material_model%viscoelastic
         spec%material%fg = 1.0_wp
         spec%material%tc = 1.0e-3_wp
         call creep(spec, motion%steady_rolling, ksi=1.0e-3_wp, mu=0.3_wp)
         spec%rolling%veloc = 1000.0_wp
      end if
   end subroutine choose

   !> A direct solution: coefficients by logarithms, elimination on the contact area, area by trial
   subroutine dense()
      integer, parameter :: n = 13
      type(test_case) :: case
      real(wp) :: a(n*n, n*n), h(n*n), p(n*n), u(n*n), e, area, s(2)
      real(wp) :: flxz, pen
      logical :: contact(n*n), next(n*n)
      integer :: i, j, k, trial
      character(len=40) :: what

      e = 9.0_wp/n
      area = e*e
      do k = 1, 3
         flxz = 10.0_wp**(k - 4)
         do j = 1, n*n
            do i = 1, n*n
               a(i, j) = love((mod(i - 1, n) - mod(j - 1, n))*e, ((i - 1)/n - (j - 1)/n)*e, e)
            end do
            a(j, j) = a(j, j) + flxz
            s = [mod(j - 1, n), (j - 1)/n]*e + 0.5_wp*e - 4.5_wp
            h(j) = 0.04_wp*s(1)**2 + 0.06_wp*s(2)**2 + 0.1_wp
         end do
         pen = 0.5_wp
         contact = h < pen
         do trial = 1, 50
            p = pressures(a, pen - h, contact)
            u = matmul(a, p)
            next = merge(p > 0.0_wp, h + u < pen, contact)
            if (all(next .eqv. contact)) exit
            contact = next
         end do
         write(what, "(a, es8.1)") "dense, FLXZ = ", flxz
         case%spec = sheet_case(flxz, n)
         case%spec%normal = normal_control%approach
         case%spec%kinematics%pen = pen
         call case%run(suite, trim(what))
         call suite%equal(case%result%ncon, count(contact), trim(what) // ": contact area")
         call suite%close_to(reshape(case%result%pn, [n*n]), p, 1.0e-8_wp*maxval(p), trim(what) // ": pressures")
         call suite%close_to(case%result%elastic_energy, 0.5e-3_wp*area*dot_product(p, u), 1.0e-8_wp, trim(what) // ": energy", &
            & relative=.true.)
         ! the same with the force that belongs to it
         case%spec%normal = normal_control%force
         case%spec%kinematics%fn = area*sum(p)
         call case%run(suite, trim(what))
         call suite%close_to(case%result%pen, pen, 1.0e-8_wp, trim(what) // ": approach for the force", relative=.true.)
      end do
      call case%release()
   end subroutine dense

   !> Displacement at (x, y) by unit pressure on a square of side e around the origin; moduli 200, Poisson ratios 0.28
   real(wp) function love(x, y, e) result(u)
      real(wp), intent(in) :: x, y, e
      real(wp) :: x1, y1
      integer :: i, j

      u = 0.0_wp
      do j = -1, 1, 2
         do i = -1, 1, 2
            x1 = x + 0.5_wp*i*e
            y1 = y + 0.5_wp*j*e
            u = u + i*j*(x1*log(y1 + hypot(x1, y1)) + y1*log(x1 + hypot(x1, y1)))
         end do
      end do
      u = u*0.72_wp/(pi*200.0_wp)
   end function love

   !> Solve a(contact, contact) p = b, by elimination
   function pressures(a, b, contact) result(p)
      real(wp), intent(in) :: a(:, :), b(:)
      logical, intent(in) :: contact(:)
      real(wp) :: p(size(b))
      real(wp), allocatable :: m(:, :), r(:)
      integer, allocatable :: place(:)
      integer :: i, k

      place = pack([(i, i=1, size(b))], contact)
      m = a(place, place)
      r = b(place)
      do k = 1, size(place)
         do i = k + 1, size(place)
            r(i) = r(i) - m(i, k)/m(k, k)*r(k)
            m(i, k:) = m(i, k:) - m(i, k)/m(k, k)*m(k, k:)
         end do
      end do
      do k = size(place), 1, -1
         r(k) = (r(k) - dot_product(m(k, k + 1:), r(k + 1:)))/m(k, k)
      end do
      p = 0.0_wp
      p(place) = r
   end function pressures

   !> Nothing for a vanishing flexibility, a Winkler foundation for a large one, for all kinds of coefficients
   subroutine limits()
      type(test_case) :: plain, sheet
      real(wp), parameter :: large = 1.0e4_wp
      integer :: k

      do k = 1, size(kinds)
         plain%spec = sheet_case(0.0_wp, 15)
         call choose(plain%spec, k)
         call plain%run(suite, trim(kinds(k)))
         sheet%spec = sheet_case(1.0e-10_wp, 15)
         call choose(sheet%spec, k)
         call sheet%run(suite, trim(kinds(k)) // ", almost rigid sheet")
         call suite%close_to(sheet%result%pn, plain%result%pn, 1.0e-6_wp*plain%result%pmax, trim(kinds(k)) // &
            & ": without flexibility there is no sheet")
         sheet%spec = sheet_case(large, 15)
         call choose(sheet%spec, k)
         sheet%spec%normal = normal_control%approach
         sheet%spec%kinematics%pen = 0.5_wp
         call sheet%run(suite, trim(kinds(k)) // ", soft sheet")
         ! the bodies yield by some 1e-2 mm per N/mm2
         call suite%close_to(sheet%result%pn, max(0.0_wp, 0.5_wp - sheet%result%h)/large, 3.0e-5_wp*0.4_wp/large, &
            & trim(kinds(k)) // ": Winkler foundation")
         call suite%check(index(sheet%result%effects, "elastic thin sheet") > 0, trim(kinds(k)) // ": the sheet is named")
      end do
      call plain%release()
      call sheet%release()
   end subroutine limits

   !> A grid that is solved with coarser ones: the contact conditions hold with the displacements that are reported
   subroutine large_grid()
      type(test_case) :: case
      real(wp) :: gap
      integer :: n

      do n = 64, 65
         case%spec = sheet_case(0.02_wp, n)
         call case%run(suite, "large grid")
         gap = maxval(abs(case%result%h + case%result%un - case%result%pen), case%result%division > element%exterior)
         call suite%close_to(gap, 0.0_wp, 1.0e-9_wp, "large grid: no gap in the contact area")
         call suite%check(case%result%normal%iterations < 30, "large grid: coarse grids help")
      end do
      call case%release()
   end subroutine large_grid

   !> dFn/dpen by differences, in rolling
   subroutine stiffness()
      type(test_case) :: case
      real(wp) :: fn(2), rate
      integer :: k
      real(wp), parameter :: change = 1.0e-7_wp

      do k = 0, 2
         case%spec = sheet_case(0.01_wp, 21)
         call creep(case%spec, motion%steady_rolling, ksi=1.0e-3_wp, mu=0.3_wp)
         case%spec%normal = normal_control%approach
         case%spec%kinematics%pen = 0.5_wp + (k - 1)*merge(change, 0.0_wp, k /= 1)
         case%spec%iteration%sensitivity = sensitivity_choice%all
         case%spec%iteration%epsens = 1.0e-8_wp
         case%spec%output_level = 5
         call case%run(suite, "stiffness")
         if (k == 1) then
            rate = case%result%sensitivity(1, 1)
         else
            fn(1 + k/2) = case%result%fn
         end if
      end do
      call suite%close_to(rate, (fn(2) - fn(1))/(2.0_wp*change), 1.0e-4_wp, "stiffness with a sheet", relative=.true.)
      call case%release()
   end subroutine stiffness

   !> Wheel on rail: the force is met, a stiff sheet has no effect, a soft one lowers the wheel
   subroutine wheel_on_rail()
      type(pair_case) :: plain, sheet
      integer :: k
      real(wp), parameter :: flxz(2) = [1.0e-10_wp, 1.0e-4_wp]

      plain%spec = railway_case(3.0_wp, 0.0_wp)
      call plain%run(suite, "wheel on rail")
      do k = 1, 2
         sheet%spec = plain%spec
         sheet%spec%pressure = pressure_model%thin_sheet
         sheet%spec%material%flxz = flxz(k)
         call sheet%run(suite, "wheel on rail with a sheet")
         call suite%close_to(sheet%result%force_track(3), plain%result%force_track(3), 1.0e-4_wp, "wheel on rail: the same force", &
            & relative=.true.)
         if (k == 1) then
            call suite%close_to(sheet%result%z_ws, plain%result%z_ws, 1.0e-6_wp, "wheel on rail: a stiff sheet")
         else
            call suite%check(sheet%result%z_ws > plain%result%z_ws + 1.0e-3_wp, "wheel on rail: a soft sheet")
            call suite%check(maxval(sheet%result%patches(1)%contact%pn) < 0.95_wp*maxval(plain%result%patches(1)%contact%pn), &
               & "wheel on rail: lower pressures")
         end if
      end do
      call plain%release()
      call sheet%release()
   end subroutine wheel_on_rail

   !> A sheet without flexibility is forgotten data, not no sheet
   subroutine refusals()
      type(test_case) :: case
      type(error_type), allocatable :: error

      case%spec = sheet_case(1.0_wp, 5)
      case%spec%material%flxz = 0.0_wp
      call case%try(error)
      call suite%check(allocated(error), "a sheet needs its flexibility")
      if (allocated(error)) call suite%check(index(error%message, "FLXZ") > 0, "the flexibility is named")
   end subroutine refusals
end program test_thin_sheet
