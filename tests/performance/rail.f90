!> Wheel on rail: what the cases of a benchmark cost, inside and outside of the contact solver, and what the search for
!> contact costs on a crossing, against one that evaluates a tensor spline at every point
!>
!>     performance_rail SOURCE      SOURCE is the folder of the project, for its own profiles
program performance_rail
   use, intrinsic :: iso_c_binding, only : c_double, c_long
   use contact_base_choices, only : contact_location, estimate_choice, force_control, motion, normal_control, time_link
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_bench_point_by_point, only : new_tensor_rail, smallest_gaps, tensor_rail
   use contact_cases_wheel_rail_session, only : wheel_rail_session, release_wheel_rail_session, solve_wheel_rail_case
   use contact_cases_spec, only : case_spec, friction_set
   use contact_wheelrail_gap, only : gap_curve
   use contact_wheelrail_geometry, only : measure
   use contact_wheelrail_region, only : contact_region
   use contact_wheelrail_regions, only : find_regions
   use contact_wheelrail_result, only : wheel_rail_result
   use contact_wheelrail_spec, only : search_spec
   use omp_lib, only : omp_set_num_threads
   implicit none (type, external)

   interface
      !> Processor time of this process, and of it what was spent in the solver of patches [s]; calls of that
      function bench_clock() bind(c) result(seconds)
         import :: c_double
         real(c_double) :: seconds
      end function bench_clock
      function bench_inside() bind(c) result(seconds)
         import :: c_double
         real(c_double) :: seconds
      end function bench_inside
      function bench_calls() bind(c) result(n)
         import :: c_long
         integer(c_long) :: n
      end function bench_calls
   end interface

   character(len=500) :: source
   integer :: missed

   call get_command_argument(1, source)
   if (len_trim(source) == 0) error stop "usage: performance_rail SOURCE"
   call omp_set_num_threads(1)
   missed = 0
   call tread_to_flange()
   call crossing()
   write(*, "(/, a, i0, a)") "Goals: ", missed, " missed."

contains

   !> The positions of the Manchester benchmark A-2.2: 0 to 10 mm, 0 to 24 mrad, elements of 0.2 mm
   subroutine tread_to_flange()
      type(wheel_rail_session) :: session
      type(wheel_rail_result) :: result
      type(case_spec) :: spec
      integer, parameter :: rounds = 5
      real(wp) :: total(rounds), outside(rounds), start, inside
      integer :: k, round, calls

      spec = common_case()
      associate (pair => spec%wheel_rail)
         pair%rail_profile%name = trim(source) // "/examples/profiles/60E1.prr"
         pair%track%gaugwd = 1435.0_wp
         do round = 1, rounds
            start = bench_clock()
            inside = bench_inside()
            calls = int(bench_calls())
            do k = 0, 20
               pair%wheelset%y = 0.5_wp*k
               pair%wheelset%yaw = 0.0012_wp*k
               call solve(session, spec, result)
            end do
            total(round) = bench_clock() - start
            outside(round) = total(round) - (bench_inside() - inside)
            calls = int(bench_calls()) - calls
            if (round < rounds) call forget(session)
         end do
      end associate
      write(*, "(a)") "21 cases of a wheel S1002 on a rail 60E1 at 0 to 10 mm, 0 to 24 mrad, elements of 0.2 mm, 10 kN; the " // &
         & "best of five rounds, profiles read anew in each."
      write(*, "(a)") ""
      write(*, "(a)") "| seconds | of them outside of the contact solver | solutions of patches | goal |"
      write(*, "(a)") "|---|---|---|---|"
      k = minloc(total, 1)
      write(*, "(a, f5.3, a, i0, a, i0, a)") "| ", total(k), " | ", nint(100.0_wp*outside(k)/total(k)), " % | ", calls, &
         & " | 0.5 s, 30 %: " // trim(verdict(total(k) <= 0.5_wp .and. outside(k) <= 0.3_wp*total(k))) // " |"
      call forget(session)
   end subroutine tread_to_flange

   !> A nose that rises and widens in 600 mm: the search of the program, and one by points on the same mesh
   subroutine crossing()
      type(wheel_rail_session) :: session
      type(wheel_rail_result) :: result
      type(case_spec) :: spec
      type(tensor_rail) :: tensor
      type(gap_curve) :: by_points
      integer, parameter :: slices = 13, points = 141
      !> Half the length of the mesh along the track, of the wheel's radius
      real(wp), parameter :: reach = 0.125_wp
      real(wp), allocatable :: u(:), x(:)
      type(gap_curve) :: found
      integer, parameter :: kinds(2) = [contact_location%locus, contact_location%grid]
      real(wp) :: start, own(2), other, case, setup, step
      integer, parameter :: repeats = 5
      integer :: i, k, n, kind

      call write_crossing(slices, u)
      spec = common_case()
      associate (pair => spec%wheel_rail, here => session%memory%geometry)
         pair%rail_profile%name = "bench_crossing.slcs"
         pair%track%gaught = -1.0_wp
         pair%track%raily0 = 750.0_wp
         pair%search%location = contact_location%locus
         pair%wheelset%s = 250.0_wp
         call solve(session, spec, result)
         start = bench_clock()
         call solve(session, spec, result)
         case = bench_clock() - start
         start = bench_clock()
         tensor = new_tensor_rail(session%problem%rail_surface, u, points)
         setup = bench_clock() - start
         step = here%gap%x_table(2) - here%gap%x_table(1)
         n = ceiling(reach*here%placement%wheel_radius/step)
         x = [(step*i, i=-n, n)]
         own = huge(1.0_wp)
         other = huge(1.0_wp)
         do k = 1, repeats
            do kind = 1, size(kinds)
               session%problem%spec%search%location = kinds(kind)
               start = bench_clock()
               call measure(session%problem, here, result%z_ws)
               own(kind) = min(own(kind), bench_clock() - start)
            end do
            by_points = here%gap
            start = bench_clock()
            call smallest_gaps(tensor, here%bodies, pair%wheelset%s, x, by_points%y, by_points%gap, by_points%x)
            other = min(other, bench_clock() - start)
         end do
         write(*, "(/, a, i0, a, i0, a)") "Search for contact on a crossing, mesh of ", size(x), " x ", here%gap%n, &
            & " points, elements of 0.2 mm; the best of five times each:"
         write(*, "(a)") ""
         write(*, "(a)") "| | ms |"
         write(*, "(a)") "|---|---|"
         write(*, "(a, f0.1, a)") "| search of the program by the locus (D = 2), sections of the rail included | ", &
            & 1.0e3_wp*own(1), " |"
         write(*, "(a, f0.1, a)") "| the same by the grid (D = 5) | ", 1.0e3_wp*own(2), " |"
         write(*, "(a, f4.2, a, f0.1, a)") "| tensor spline at every point, without its set-up of ", 1.0e3_wp*setup, " ms | ", &
            & 1.0e3_wp*other, " |"
         write(*, "(a, f0.1, a)") "| the whole case with D = 2, the second time | ", 1.0e3_wp*case, " |"
         write(*, "(/, a, f0.1, a, f0.1, a)") "Ratio of the searches: ", other/own(1), " with D = 2, ", other/own(2), &
            & " with D = 5; goal for the first: 20 times faster, " // trim(verdict(other >= 20.0_wp*own(1))) // "."
         do kind = 1, size(kinds)
            session%problem%spec%search%location = kinds(kind)
            call measure(session%problem, here, result%z_ws)
            found = here%gap
            ! weights of the locus in all searches
            if (allocated(found%table)) deallocate(found%table)
            if (allocated(by_points%table)) deallocate(by_points%table)
            call compare_contacts(pair%search, found, by_points)
         end do
      end associate
      call forget(session)
   end subroutine crossing

   !> Both searches find the same: gaps where the bodies are near, and the contact when the wheel has sunk in
   subroutine compare_contacts(search, own, by_points)
      type(search_spec), intent(in) :: search
      type(gap_curve), intent(in) :: own, by_points
      type(contact_region), allocatable :: here(:), there(:), misses(:)
      !> [mm]
      real(wp), parameter :: penetration = 0.15_wp
      real(wp) :: lowest, difference, moved

      lowest = minval(own%gap)
      difference = maxval(abs(own%gap - by_points%gap), own%gap < lowest + penetration)
      call find_regions(own, lowest + penetration, search, 2, here, misses)
      call find_regions(by_points, lowest + penetration, search, 2, there, misses)
      if (size(here) /= size(there) .or. size(here) == 0) error stop "the two searches find different contacts"
      moved = max(maxval(abs(here%x - there%x)), maxval(abs(here%y - there%y)))
      write(*, "(a, f4.2, a, es7.1, a, i0, a, es7.1, a)") "Gaps of both within ", penetration, &
         & " mm of the smallest one differ by at most ", difference, " mm, the references of the ", size(here), &
         & " contacts at that penetration by ", moved, " mm."
      if (difference > 1.0e-4_wp .or. moved > 2.0e-3_wp) error stop "the two searches find different gaps"
   end subroutine compare_contacts

   !> Slices of a nose that rises by 3 mm and moves aside by 12 mm
   subroutine write_crossing(slices, u)
      integer, intent(in) :: slices
      !> Places of the slices [mm]
      real(wp), allocatable, intent(out) :: u(:)
      character(len=40) :: name
      real(wp) :: y, z, rise, aside, x
      integer :: k, i, list, file

      u = [(50.0_wp*(k - 1), k=1, slices)]
      open(newunit=list, file="bench_crossing.slcs", status="replace")
      write(list, "(a)") "0.0 1.0    U_OFFSET, U_SCALE"
      write(list, "(i0, a)") slices, "    NSLC"
      write(list, "(a)") "0 0 0    NFEAT, NKINK, NACCEL"
      write(list, "(a)") "1    U_INTPOL"
      do k = 1, slices
         write(name, "(a, i0, a)") "bench_slice_", k, ".dat"
         write(list, "(f10.3, 3a)") u(k), " '", trim(name), "'"
         x = u(k)/u(slices)
         rise = 3.0_wp*x**2*(3.0_wp - 2.0_wp*x)
         aside = 12.0_wp*x
         open(newunit=file, file=trim(name), status="replace")
         do i = -70, 70
            y = 0.5_wp*i
            z = y**2/(2.0_wp*(150.0_wp + 150.0_wp*x)) + (max(0.0_wp, abs(y) - 22.0_wp)/6.0_wp)**2 + 3.0_wp - rise
            write(file, "(2f16.9)") y + aside, z
         end do
         close(file)
      end do
      close(list)
   end subroutine write_crossing

   function common_case() result(spec)
      type(case_spec) :: spec

      spec%link = time_link%initiate
      spec%estimate = estimate_choice%fresh
      spec%motion = motion%steady_rolling
      spec%normal = normal_control%force
      spec%force = force_control%creepages
      spec%iteration%eps = 1.0e-5_wp
      spec%material%gg = 82000.0_wp
      allocate(spec%friction%sets(1))
      spec%friction%sets(1) = friction_set(fstat=0.3_wp, fkin=0.3_wp)
      allocate(spec%wheel_rail)
      associate (pair => spec%wheel_rail)
         pair%wheel_profile%name = trim(source) // "/examples/profiles/S1002.prw"
         pair%wheelset%fz = 10000.0_wp
         pair%wheelset%vs = 2000.0_wp
         pair%wheelset%vpitch = -4.348_wp
         pair%search%dx = 0.2_wp
         pair%search%ds = 0.2_wp
         pair%search%d_sep = 8.0_wp
         pair%search%d_comb = 4.0_wp
         pair%search%d_turn = 12.0_wp
      end associate
   end function common_case

   subroutine solve(session, spec, result)
      type(wheel_rail_session), intent(inout) :: session
      type(case_spec), intent(in) :: spec
      type(wheel_rail_result), intent(inout) :: result
      type(error_type), allocatable :: error
      type(log_type) :: log

      call solve_wheel_rail_case(session, spec, "", log, result, error)
      if (allocated(error)) error stop full_text(error)
      if (.not. result%status%is_solved()) error stop "the vertical force is not reached"
   end subroutine solve

   !> A session as on the first day
   subroutine forget(session)
      type(wheel_rail_session), intent(inout) :: session
      type(wheel_rail_session) :: fresh

      call release_wheel_rail_session(session)
      session = fresh
   end subroutine forget

   function verdict(met) result(word)
      logical, intent(in) :: met
      character(len=6) :: word

      word = "met"
      if (met) return
      word = "missed"
      missed = missed + 1
   end function verdict
end program performance_rail
