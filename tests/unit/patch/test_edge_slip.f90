!> Slip of the leading elements by the change of their edge terms, against derivatives of these terms
program test_edge_slip
   use contact_base_kinds, only : wp
   use contact_patch_order, only : edge_slip
   use contact_patch_problem, only : patch_problem
   use contact_tangential_problem, only : tangential_problem
   use contact_tangential_second_order, only : find_edge_terms, second_order, unknown_gap
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   integer, parameter :: mx = 12, my = 7
   real(wp), parameter :: nu = 0.28_wp, gg = 82000.0_wp, dx = 0.1_wp, dy = 0.15_wp, diagonal = 2.0e-6_wp
   !> Relative errors of finite differences: round-off, and terms of higher order
   real(wp), parameter :: close = 1.0e-6_wp
   type(test_suite) :: suite
   type(patch_problem) :: problem
   type(tangential_problem) :: tangential
   !> Pressures [N/mm2] and their changes, gaps [mm] and theirs, tractions [N/mm2], slip and its change [mm], change of the turns
   real(wp) :: pressure(mx, my), change(mx, my), gap(mx, my), gap_change(mx, my), p(mx, my, 2), at(mx, my, 2), slip(mx, my, 2)
   real(wp) :: angle(mx, my)

   problem%model%material%nu = nu
   problem%model%material%gg = gg
   tangential%mx = mx
   tangential%my = my
   tangential%dx = dx
   tangential%dy = dy
   allocate(tangential%contact(mx, my), tangential%second)
   at(:, :, 1) = 1.0e-4_wp
   at(:, :, 2) = 0.0_wp

   call suite%start("edge slip")
   call straight_edge()
   call oblique_edge()
   ! displacements of a layer between the bodies as large as those of the bodies
   problem%model%layer = 0.5_wp*diagonal
   call oblique_edge()
   problem%model%layer = 0.0_wp
   call vanishing_pressure()
   call unknown_gaps()
   call suite%finish()

contains

   !> Pressures with the root of the distance from an edge that goes back by `slope` elements per row, with smooth changes; no gap
   !> is known
   subroutine set_contact(slope)
      real(wp), intent(in) :: slope
      integer :: ix, iy

      do iy = 1, my
         do ix = 1, mx
            pressure(ix, iy) = 300.0_wp*sqrt(max(0.0_wp, 10.3_wp - slope*(iy - 1) - ix))
            change(ix, iy) = 50.0_wp + 3.0_wp*ix - 5.0_wp*slope*iy
            p(ix, iy, :) = [20.0_wp + ix, 15.0_wp - iy]
         end do
      end do
      tangential%contact = pressure > 0.0_wp
      where (.not. tangential%contact) change = 0.0_wp
      gap = unknown_gap
      gap_change = 0.0_wp
   end subroutine set_contact

   !> The slip by the routine
   subroutine find_slip()
      call find_edge_terms(tangential%contact, pressure, gap, .false., dx, dy, tangential%direction, nu, gg, diagonal, &
         & problem%model%layer, tangential%second)
      call edge_slip(problem, tangential, diagonal, p, at, pressure, change, gap_change, slip, angle)
      call suite%check(maxval(abs(angle)) <= epsilon(angle), "uniform slip is not turned")
   end subroutine find_slip

   !> A straight edge across, gaps of zero, of nearly zero and larger ones: derivatives of gap/((1 - nu) pn) times the tractions
   subroutine straight_edge()
      real(wp), parameter :: gaps(4) = [0.0_wp, 1.0e-16_wp, 1.0e-9_wp, 1.0e-5_wp]
      character(len=8) :: text
      real(wp) :: term
      integer :: k, sign, lead

      do k = 1, size(gaps)
         do sign = -1, 1, 2
            call set_contact(0.0_wp)
            lead = count(tangential%contact(:, 4))
            gap(lead, :) = gaps(k)
            gap_change(lead, :) = sign*2.0e-4_wp
            call find_slip()
            term = (gap_change(lead, 4) - gaps(k)*change(lead, 4)/pressure(lead, 4))/((1.0_wp - nu)*pressure(lead, 4))
            write(text, "(es8.1)") gaps(k)
            call suite%close_to(slip(lead, 4, 1), (1.0_wp - nu)*term*p(lead, 4, 1), close*abs(term*p(lead, 4, 1)), &
               & "slip along, gap " // text)
            call suite%close_to(slip(lead, 4, 2), term*p(lead, 4, 2), close*abs(term*p(lead, 4, 2)), "slip across, gap " // text)
         end do
      end do
   end subroutine straight_edge

   !> An oblique edge that touches ahead: differences to one side, where gaps are positive, in the three elements with terms
   subroutine oblique_edge()
      real(wp), parameter :: step = 1.0e-5_wp
      type(second_order) :: ahead(0:2)
      real(wp) :: c(3), expected(2), largest
      integer :: ix, iy, k

      call set_contact(0.4_wp)
      do iy = 1, my
         ix = count(tangential%contact(:, iy))
         gap(ix, iy) = 0.0_wp
         gap_change(ix, iy) = 2.0e-4_wp
      end do
      call find_slip()
      do k = 0, 2
         call find_edge_terms(tangential%contact, pressure + k*step*change, gap + k*step*gap_change, .false., dx, dy, &
            & tangential%direction, nu, gg, diagonal, problem%model%layer, ahead(k))
      end do
      largest = maxval(abs(slip))
      call suite%check(size(ahead(0)%at, 2) == 3*my, "three elements of each row have terms")
      do k = 1, size(ahead(0)%at, 2)
         ix = ahead(0)%at(1, k)
         iy = ahead(0)%at(2, k)
         c = (4.0_wp*ahead(1)%kappa(:, k) - ahead(2)%kappa(:, k) - 3.0_wp*ahead(0)%kappa(:, k))/(2.0_wp*step)
         expected = [c(1)*p(ix, iy, 1) + c(3)*p(ix, iy, 2), c(3)*p(ix, iy, 1) + c(2)*p(ix, iy, 2)]
         call suite%close_to(slip(ix, iy, :), expected, close*largest, "slip at an oblique edge")
      end do
   end subroutine oblique_edge

   !> A leading element that hardly carries anything: its term is a quotient by its pressure
   subroutine vanishing_pressure()
      real(wp), parameter :: pressures(3) = [1.0_wp, 1.0e-2_wp, 1.0e-4_wp]
      character(len=8) :: text
      real(wp) :: term
      integer :: k, lead

      do k = 1, size(pressures)
         call set_contact(0.0_wp)
         lead = count(tangential%contact(:, 4))
         gap(lead, :) = 1.0e-5_wp
         gap_change(lead, :) = 2.0e-4_wp
         pressure(lead, :) = pressures(k)
         p(lead, :, :) = 0.1_wp*pressures(k)
         call find_slip()
         term = (gap_change(lead, 4) - gap(lead, 4)*change(lead, 4)/pressures(k))/((1.0_wp - nu)*pressures(k))
         write(text, "(es8.1)") pressures(k)
         call suite%close_to(slip(lead, 4, 2), term*p(lead, 4, 2), 10.0_wp*close*abs(term*p(lead, 4, 2)), &
            & "slip at pressure " // text)
      end do
   end subroutine vanishing_pressure

   !> Unknown gaps stay unknown: terms depend on pressures alone, and do not change if all pressures are scaled
   subroutine unknown_gaps()
      call set_contact(0.0_wp)
      call find_slip()
      call suite%check(maxval(abs(slip)) > 0.0_wp, "terms follow pressures")
      change = pressure
      call find_slip()
      call suite%close_to(slip(:, 4, 1), spread(0.0_wp, 1, mx), 1.0e-12_wp, "scaled pressures do not change the terms")
   end subroutine unknown_gaps
end program test_edge_slip
