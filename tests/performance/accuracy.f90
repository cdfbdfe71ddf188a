!> Error against time: errors of the forces and of the peak traction against seconds
!>
!> Writes lines "group,method,elements in contact,grid,tolerance,seconds,force error,peak error" for accuracy.py.
!> Errors are relative to the friction bound and to the peak of the reference: Hertz's solution for the
!> normal problem, the finest grid with a tight tolerance elsewhere.
program performance_accuracy
   use, intrinsic :: iso_fortran_env, only : output_unit
   use contact_base_choices, only : material_model, normal_control, pressure_model
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_bench_measure, only : measure, measurement, pair_clock
   use contact_bench_problems, only : new_normal_case, new_rolling_case, new_shift_case, new_table_case, normal_case, &
      & rolling_contacts, session_case, solve_one, tangential_case
   use contact_tangential_classical, only : classical_method, method_name
   implicit none (type, external)

   !> What is compared
   type :: figures
      !> Forces relative to the friction bound, or to Hertz's force
      real(wp) :: force(2) = 0.0_wp
      !> Largest traction [N/mm2]
      real(wp) :: peak = 1.0_wp
   end type figures

   !> Sizes that are tried, and one that is finer than all of them
   integer, parameter :: sizes(*) = [20, 40, 80, 160], finest = 320
   real(wp), parameter :: tolerances(*) = [1.0e-2_wp, 1.0e-3_wp, 1.0e-4_wp, 1.0e-6_wp, 1.0e-8_wp], tight = 1.0e-9_wp
   !> A classical method is not run on the next size when it took longer than this [s]
   real(wp), parameter :: longest = 1.0_wp
   type(pair_clock) :: clock
   type(normal_case) :: normal
   type(tangential_case) :: tangential

   call clock%prepare(8, 8)
   call normal_group()
   call tangential_group(.true.)
   call tangential_group(.false.)
   call complete_group()
   call normal%release()
   call tangential%release()

contains

   !> Normal problem by approach, against Hertz
   subroutine normal_group()
      type(figures) :: exact, found
      type(measurement) :: result
      integer :: k, l, n
      !> Of the problem: radius of contact, effective modulus [mm, N/mm2]
      real(wp), parameter :: a = 0.4_wp, modulus = 2.0_wp
      integer, parameter :: all_sizes(*) = [sizes, finest]

      exact%force = [1.0_wp, 0.0_wp]
      exact%peak = 2.0_wp*modulus*a/pi
      do k = 1, size(all_sizes)
         n = all_sizes(k)
         do l = 1, size(tolerances)
            call new_normal_case(n, .false., tolerances(l), normal)
            call measure(normal, clock, 0.3_wp, result)
            if (.not. result%report%succeeded()) cycle
            found%force = [sum(normal%p)/(real(n, wp)**2*normal%problem%fn), 0.0_wp]
            found%peak = maxval(normal%p)
            call point("normal problem", "NormCG", normal%contact, n, tolerances(l), result%seconds, found, exact)
         end do
      end do
   end subroutine normal_group

   !> Steady rolling or a shift with given pressures, by all solvers
   subroutine tangential_group(rolling)
      logical, intent(in) :: rolling
      type(figures) :: exact
      type(measurement) :: result
      integer :: k, l, m
      integer, allocatable :: methods(:)
      logical :: too_slow
      character(len=:), allocatable :: name, group

      group = "shift"
      methods = [0, classical_method%tang_cg, classical_method%convex_gs]
      if (rolling) then
         group = "steady rolling"
         methods = [0, classical_method%steady_gs, classical_method%gd_steady, classical_method%convex_gs]
      end if
      call make(rolling, finest, tight, 0)
      call tangential%run(result%report)
      exact = tangential_figures()
      do m = 1, size(methods)
         name = "Newton-Krylov"
         if (methods(m) > 0) name = method_name(methods(m))
         too_slow = .false.
         do k = 1, size(sizes)
            if (too_slow) cycle
            do l = 1, size(tolerances)
               call make(rolling, sizes(k), tolerances(l), methods(m))
               call measure(tangential, clock, 0.3_wp, result)
               if (result%seconds > longest) too_slow = .true.
               ! what another method finished is not its result
               if (result%report%gave_up /= "" .or. .not. result%report%succeeded()) cycle
               call point(group, name, count(tangential%problem%contact), sizes(k), tolerances(l), result%seconds, &
                  & tangential_figures(), exact)
               if (too_slow) exit
            end do
         end do
      end do
   end subroutine tangential_group

   subroutine make(rolling, n, eps, method)
      logical, intent(in) :: rolling
      integer, intent(in) :: n, method
      real(wp), intent(in) :: eps

      if (rolling) then
         call new_rolling_case(rolling_contacts(1), n, eps, tangential)
      else
         call new_shift_case(n, [5.0e-3_wp, -3.0e-3_wp], 0, [0.0_wp, 0.0_wp], eps, tangential)
      end if
      tangential%method = method
   end subroutine make

   type(figures) function tangential_figures() result(found)
      associate (p => tangential%solution%p)
         found%force = [sum(p(:, :, 1)), sum(p(:, :, 2))]/sum(tangential%problem%bound)
         found%peak = maxval(hypot(p(:, :, 1), p(:, :, 2)))
      end associate
   end function tangential_figures

   !> Normal and tangential problem by the session, with the true pressures and with given ones
   subroutine complete_group()
      integer :: k
      integer, parameter :: widths(*) = [11, 19, 35, 71, 141], widest = 283
      real(wp), parameter :: few(*) = [1.0e-2_wp, 1.0e-3_wp, 1.0e-4_wp, 1.0e-6_wp]
      !> Pressures, members of pressure_model, and tangential theories, of material_model
      integer, parameter :: pressures(*) = [pressure_model%full, pressure_model%elliptical, pressure_model%parabolical, &
         & pressure_model%kpec, pressure_model%analyn, pressure_model%parabolical, pressure_model%full, pressure_model%elliptical]
      integer, parameter :: theories(*) = [(material_model%elastic, k=1, 5), material_model%fastsim, material_model%fastsim, &
         & material_model%fastrip]
      character(len=*), parameter :: names(*) = [character(len=24) :: "full (B=0)", "elliptical (B=2)", "parabolical (B=3)", &
         & "KPEC (B=5)", "ANALYN (B=6)", "Fastsim (M=3 B=3)", "Fastsim (M=3 B=0)", "FaStrip (M=5 B=2)"]
      type(figures) :: exact
      type(session_case) :: case
      type(measurement) :: result
      real(wp) :: pen
      integer :: l, m

      call make_complete(case, widest, tight, pressure_model%full, material_model%elastic)
      call solve_one(case)
      exact = complete_figures(case)
      pen = case%result%pen
      do m = 1, size(pressures)
         do k = 1, size(widths)
            do l = 1, size(few)
               call make_complete(case, widths(k), few(l), pressures(m), theories(m))
               ! approximate methods start from the approach
               if (any(pressures(m) == [pressure_model%kpec, pressure_model%analyn])) then
                  case%spec%normal = normal_control%approach
                  case%spec%kinematics%pen = pen
               end if
               call measure(case, clock, 0.3_wp, result)
               if (.not. result%report%succeeded()) cycle
               call point("complete case", trim(names(m)), case%result%ncon, widths(k), few(l), result%seconds, &
                  & complete_figures(case), exact)
            end do
         end do
      end do
      call case%release()
   end subroutine complete_group

   subroutine make_complete(case, mx, eps, pressures, theory)
      type(session_case), intent(inout) :: case
      integer, intent(in) :: mx, pressures, theory
      real(wp), intent(in) :: eps

      call new_table_case(mx, case)
      case%spec%pressure = pressures
      case%spec%material_model = theory
      case%spec%iteration%eps = eps
      case%spec%kinematics%cksi = 1.0e-3_wp
      case%spec%kinematics%ceta = 5.0e-4_wp
      case%spec%kinematics%cphi = 2.0e-4_wp
   end subroutine make_complete

   type(figures) function complete_figures(case) result(found)
      type(session_case), intent(in) :: case
      found%force = [case%result%fx_rel, case%result%fy_rel]
      found%peak = maxval(hypot(case%result%px, case%result%py))
   end function complete_figures

   subroutine point(group, name, contact, n, eps, seconds, found, exact)
      character(len=*), intent(in) :: group, name
      integer, intent(in) :: contact, n
      real(wp), intent(in) :: eps, seconds
      type(figures), intent(in) :: found, exact

      write(output_unit, "(4a, i0, a, i0, 4(a, es11.4))") group, ",", name, ",", contact, ",", n, ",", eps, ",", seconds, ",", &
         & norm2(found%force - exact%force), ",", abs(found%peak - exact%peak)/exact%peak
      flush(output_unit)
   end subroutine point
end program performance_accuracy
