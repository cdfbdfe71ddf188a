!> The benchmark: one table of the cost of cases, in milliseconds and in pairs of transforms
!>
!>     performance_bench [--large] [--quick] [SECTION ...]   sections: normal rolling shift classical line table setup
!>     performance_bench --allocations [KIND [MX]]           where repeated cases ask for memory
!>     performance_bench --input MX FILE                     writes the cases of a table as an .inp file
!>     performance_bench --case NAME N                       milliseconds of a rolling contact, without and with set-up
!>     performance_bench --profile NAME [N]                  runs one kind of case for 10 s or N times, for a profiler:
!>                                                           table11, table19, table25, table35 (from the previous
!>                                                           case), fresh11... (from scratch), rolling160, normal160
program performance_bench
   use, intrinsic :: iso_fortran_env, only : output_unit
   use contact_base_choices, only : estimate_choice
   use contact_base_kinds, only : long, wp
   use contact_base_solve_report, only : ending, solve_report
   use contact_bench_measure, only : allocations, cpu_seconds, measure, measurement, pair_clock, peak_memory, print_places, &
      & trace_allocations
   use contact_bench_problems, only : new_line_case, new_normal_case, new_rolling_case, new_shift_case, new_table_case, &
      & normal_case, rolling_contact, rolling_contacts, session_case, set_table_kind, solve_one, table_creepage, table_size, &
      & tangential_case
   use contact_elastic_material, only : combine
   use contact_elastic_model, only : elastic_model
   use contact_elastic_operator, only : elastic_operator
   use contact_tangential_classical, only : classical_method, method_name
   implicit none (type, external)

   !> What a row may have to reach; 0: no goal
   type :: goal_type
      real(wp) :: pairs = 0.0_wp, products = 0.0_wp, milliseconds = 0.0_wp
   end type goal_type

   type(pair_clock) :: clock
   type(normal_case) :: normal
   type(tangential_case) :: tangential
   logical :: large, quick
   integer :: goals, missed
   character(len=80) :: word

   goals = 0
   missed = 0
   large = has_word("--large")
   quick = has_word("--quick")
   call get_command_argument(1, word)
   select case (word)
   case ("--input")
      call write_input()
   case ("--allocations")
      call list_allocations()
   case ("--profile")
      call profile()
   case ("--case")
      call one_case()
   case default
      call make_table()
   end select
   call normal%release()
   call tangential%release()

contains

   !> Was this word given on the command line?
   logical function has_word(name)
      character(len=*), intent(in) :: name
      character(len=80) :: given
      integer :: k

      has_word = .false.
      do k = 1, command_argument_count()
         call get_command_argument(k, given)
         if (given == name) has_word = .true.
      end do
   end function has_word

   !> Is a section wanted? All are when none is named
   logical function wanted(section)
      character(len=*), intent(in) :: section
      character(len=80) :: given
      integer :: k

      wanted = .true.
      do k = 1, command_argument_count()
         call get_command_argument(k, given)
         if (given(1:2) == "--") cycle
         wanted = .false.
      end do
      if (.not. wanted) wanted = has_word(section)
   end function wanted

   subroutine make_table()
      write(output_unit, "(a)") &
         & "| case | grid | in contact | steps | products | pairs counted | ms | cost in pairs | requests to heap | " // &
         & "residual | goal |"
      write(output_unit, "(a)") "|---|---|---|---|---|---|---|---|---|---|---|"
      if (wanted("setup")) call setup_rows()
      if (wanted("normal")) call normal_rows()
      if (wanted("rolling")) call rolling_rows()
      if (wanted("shift")) call shift_rows()
      if (wanted("classical")) call classical_rows()
      if (wanted("line")) call line_rows()
      if (wanted("table")) call table_rows()
      write(output_unit, "(/, 2(a, i0), a)") "Goals: ", goals - missed, " met, ", missed, " missed."
      write(output_unit, "(a, f0.0, a)") "Largest memory of the benchmark: ", peak_memory(), " MB."
   end subroutine make_table

   !> One row; judges the goal
   subroutine row(name, grid, contact, result, goal)
      character(len=*), intent(in) :: name, grid
      integer, intent(in) :: contact
      type(measurement), intent(in) :: result
      type(goal_type), intent(in) :: goal
      character(len=160) :: line, heap, verdict
      character(len=12) :: products, milliseconds
      real(wp) :: cost
      logical :: met

      cost = result%seconds/result%pair
      verdict = ""
      met = .true.
      if (goal%pairs > 0.0_wp) then
         met = cost <= goal%pairs
         write(verdict, "(a, i0, a)") "<= ", nint(goal%pairs), " pairs"
      else if (goal%products > 0.0_wp) then
         met = result%report%products <= goal%products
         write(verdict, "(a, i0, a)") "<= ", nint(goal%products), " products"
      else if (goal%milliseconds > 0.0_wp) then
         met = 1000.0_wp*result%seconds <= goal%milliseconds
         write(verdict, "(a, f0.2, a)") "<= ", goal%milliseconds, " ms"
         if (goal%milliseconds < 1.0_wp) write(verdict, "(a, f4.2, a)") "<= ", goal%milliseconds, " ms"
      end if
      if (.not. result%report%succeeded()) then
         met = .false.
         verdict = trim(verdict) // " (not converged)"
      end if
      if (len_trim(verdict) > 0) then
         goals = goals + 1
         if (.not. met) missed = missed + 1
         verdict = trim(verdict) // merge(": met   ", ": MISSED", met)
      end if
      heap = "-"
      if (result%allocations >= 0) write(heap, "(i0)") result%allocations
      products = "-"
      if (result%report%products > 0) write(products, "(i0)") result%report%products
      write(milliseconds, "(f12.1)") 1000.0_wp*result%seconds
      if (result%seconds < 0.1_wp) write(milliseconds, "(f12.3)") 1000.0_wp*result%seconds
      write(line, "(i0, 3a, f0.1, 3a, f0.1)") result%report%iterations, " | ", trim(products), " | ", &
         & result%report%fft_pairs, " | ", trim(adjustl(milliseconds)), " | ", cost
      write(output_unit, "(5a, i0, 6a, es8.1, 3a)") "| ", name, " | ", grid, " | ", contact, " | ", trim(line), " | ", trim(heap), &
         & " | ", "", result%report%residual, " | ", trim(verdict), " |"
      flush(output_unit)
   end subroutine row

   !> A row of words for what was not run
   subroutine row_left_out(name, grid, why)
      character(len=*), intent(in) :: name, grid, why
      write(output_unit, "(7a)") "| ", name, " | ", grid, " | | | | | | | | | ", why, " |"
      flush(output_unit)
   end subroutine row_left_out

   function square(n) result(text)
      integer, intent(in) :: n
      character(len=:), allocatable :: text
      character(len=24) :: buffer

      write(buffer, "(i0, a, i0)") n, " x ", n
      text = trim(buffer)
   end function square

   !> Kernels, spectra, plans: once per grid and material
   subroutine setup_rows()
      integer, parameter :: sizes(*) = [68, 142, 281]
      type(elastic_operator), allocatable :: operator
      type(measurement) :: result
      real(wp), allocatable :: p(:, :, :), u(:, :, :)
      real(wp) :: start
      integer :: k, n

      do k = 1, size(sizes)
         n = sizes(k)
         allocate(operator, p(n, n, 2), u(n, n, 2))
         p = 1.0_wp
         u = 0.0_wp
         start = cpu_seconds()
         call operator%prepare(elastic_model(combine([0.28_wp, 0.28_wp], [82000.0_wp, 82000.0_wp])), 0.1_wp, 0.1_wp, n, n, 1)
         call operator%steady(p, u)
         result%seconds = cpu_seconds() - start
         call clock%prepare(operator%plan%px, operator%plan%py)
         result%pair = clock%seconds()
         result%report%residual = 0.0_wp
         result%report%products = 1
         result%report%fft_pairs = operator%fft_pairs()
         call row("set-up of a tangential problem, once per grid", square(n), 0, result, goal_type())
         call operator%release()
         deallocate(operator, p, u)
      end do
   end subroutine setup_rows

   subroutine normal_rows()
      integer :: sizes(4), k, tight, control, n_sizes
      real(wp) :: eps
      type(measurement) :: result
      character(len=:), allocatable :: name

      sizes = [78, 160, 318, 632]
      n_sizes = merge(4, merge(1, 3, quick), large)
      do control = 1, 2
         do tight = 1, 2
            eps = merge(1.0e-8_wp, 1.0e-4_wp, tight == 2)
            name = merge("approach", "force   ", control == 2)
            name = "normal, " // trim(name) // merge(", to 1e-8", ", to 1e-4", tight == 2)
            do k = 1, n_sizes
               call new_normal_case(sizes(k), control == 1, eps, normal)
               call clock%prepare(normal%operator%plan%px, normal%operator%plan%py)
               call measure(normal, clock, 1.0_wp, result)
               call row(name, square(sizes(k)), normal%contact, result, &
                  & goal_type(pairs=merge(45.0_wp, 20.0_wp, tight == 2)))
            end do
         end do
      end do
   end subroutine normal_rows

   subroutine rolling_rows()
      integer :: k, i
      integer, parameter :: growth(3) = [68, 142, 281], chosen(3) = [1, 2, 6]

      do k = 1, size(rolling_contacts)
         if (.not. quick) call rolling_row(rolling_contacts(k), 80, goal_type())
         call rolling_row(rolling_contacts(k), 160, goal_type(products=100.0_wp))
         if (.not. quick) call rolling_row(rolling_contacts(k), 320, goal_type(products=130.0_wp))
      end do
      if (quick) return
      do k = 1, size(chosen)
         do i = 1, size(growth)
            call rolling_row(rolling_contacts(chosen(k)), growth(i), goal_type())
         end do
         if (large) call rolling_row(rolling_contacts(chosen(k)), 557, goal_type())
      end do
   end subroutine rolling_rows

   subroutine rolling_row(contact, n, goal)
      type(rolling_contact), intent(in) :: contact
      integer, intent(in) :: n
      type(goal_type), intent(in) :: goal
      type(measurement) :: result

      call new_rolling_case(contact, n, 1.0e-6_wp, tangential)
      call clock%prepare(tangential%operator%plan%px, tangential%operator%plan%py)
      call measure(tangential, clock, 1.0_wp, result)
      call row("rolling, " // trim(contact%name), square(n), count(tangential%problem%contact), result, goal)
   end subroutine rolling_row

   !> Newton against TangCG; the prescribed shift is the one that belongs to 0.7 of the friction limit
   subroutine shift_rows()
      integer, parameter :: sizes(3) = [68, 142, 281]
      type(measurement) :: result
      real(wp) :: shift(2), force(2)
      integer :: k, control, method
      real(wp) :: slowest
      character(len=:), allocatable :: name

      force = [-0.6_wp, 0.36_wp]
      shift = 0.0_wp
      do method = 0, classical_method%tang_cg, classical_method%tang_cg
         do control = 2, 1, -1
            slowest = 0.0_wp
            do k = 1, merge(1, 3, quick)
               name = merge("Newton-Krylov", "TangCG       ", method == 0)
               name = "shift by " // trim(merge("creepage", "force   ", control == 1)) // ", " // trim(name)
               if (slowest > 12.0_wp) then
                  call row_left_out(name, square(sizes(k)), "not run: the smaller one took too long")
                  cycle
               end if
               if (control == 2) then
                  call new_shift_case(sizes(k), [0.0_wp, 0.0_wp], 2, force, 1.0e-6_wp, tangential)
               else
                  call new_shift_case(sizes(k), shift, 0, force, 1.0e-6_wp, tangential)
               end if
               tangential%method = method
               call clock%prepare(tangential%operator%plan%px, tangential%operator%plan%py)
               call measure(tangential, clock, 1.0_wp, result)
               slowest = result%seconds
               if (control == 2 .and. method == 0) shift = tangential%solution%creep
               call row(name, square(sizes(k)), count(tangential%problem%contact), result, goal_type())
            end do
         end do
      end do
   end subroutine shift_rows

   !> The classical solvers of steady rolling, for contrast; cost grows with the square of the elements
   subroutine classical_rows()
      integer, parameter :: sizes(3) = [40, 68, 142], contacts(3) = [1, 2, 6]
      type(measurement) :: result
      integer :: k, i, method
      real(wp) :: slowest
      character(len=:), allocatable :: name
      !> A size is left out when the one before took longer
      real(wp), parameter :: limit = 1.0_wp

      do method = classical_method%steady_gs, classical_method%gd_steady, &
            & classical_method%gd_steady - classical_method%steady_gs
         do i = 1, size(contacts)
            slowest = 0.0_wp
            name = "rolling, " // trim(rolling_contacts(contacts(i))%name) // ", " // trim(method_name(method))
            do k = 1, merge(1, 3, quick)
               if (slowest > limit) then
                  call row_left_out(name, square(sizes(k)), "not run: the smaller one took too long")
                  cycle
               end if
               call new_rolling_case(rolling_contacts(contacts(i)), sizes(k), 1.0e-6_wp, tangential)
               tangential%method = method
               call clock%prepare(tangential%operator%plan%px, tangential%operator%plan%py)
               call measure(tangential, clock, 0.5_wp, result)
               slowest = result%seconds
               call row(name // given_up(result%report), square(sizes(k)), count(tangential%problem%contact), result, goal_type())
            end do
         end do
      end do
   end subroutine classical_rows

   function given_up(report) result(text)
      type(solve_report), intent(in) :: report
      character(len=:), allocatable :: text

      text = ""
      if (report%gave_up /= "") text = " (given up for " // trim(report%method) // ")"
   end function given_up

   !> Problems of one row
   subroutine line_rows()
      type(session_case) :: case
      type(measurement) :: result

      call new_line_case(case)
      call solve_one(case)
      call clock%prepare(2*case%spec%grid%mx + 2, 1)
      call measure(case, clock, 1.0_wp, result)
      call row("2-D rolling (Carter), normal and tangential", "840 x 1", case%result%ncon, result, goal_type(milliseconds=10.0_wp))
      call case%release()
   end subroutine line_rows

   !> Creep-force tables through the session, with and without the previous case as a start
   subroutine table_rows()
      integer, parameter :: sizes(4) = [11, 19, 25, 35]
      real(wp), parameter :: limits(4) = [0.25_wp, 1.0_wp, 2.0_wp, 5.0_wp]
      integer :: k, start

      do start = estimate_choice%previous, estimate_choice%fresh, -1
         do k = 1, size(sizes)
            call table_row(sizes(k), start, merge(100, table_size, quick), goal_type(milliseconds=limits(k)))
         end do
      end do
   end subroutine table_rows

   subroutine table_row(mx, start, cases, goal)
      integer, intent(in) :: mx, start, cases
      type(goal_type), intent(in) :: goal
      type(session_case) :: case
      type(measurement) :: result
      real(wp) :: begun, worst, pairs, products, steps
      integer(long) :: before
      integer :: k, failed, handed_over
      character(len=:), allocatable :: name

      call new_table_case(mx, case)
      call solve_one(case)
      case%spec%estimate = start
      select type (box => case%session%workspace%box)
      type is (elastic_operator)
         call clock%prepare(box%plan%px, box%plan%py)
      end select
      result%pair = 0.0_wp
      before = 0
      worst = 0.0_wp
      pairs = 0.0_wp
      products = 0.0_wp
      steps = 0.0_wp
      failed = 0
      handed_over = 0
      result%allocations = 0
      do k = 1, cases
         if (mod(k, 100) == 1) result%pair = result%pair + clock%seconds()
         call set_creepage(case, k)
         before = allocations()
         begun = cpu_seconds()
         call solve_one(case)
         result%seconds = result%seconds + cpu_seconds() - begun
         if (k > 1) result%allocations = result%allocations + allocations() - before
         associate (report => case%result%tangential)
            worst = max(worst, report%residual)
            pairs = pairs + report%fft_pairs + case%result%normal%fft_pairs
            products = products + report%products
            steps = steps + report%iterations
            if (.not. report%succeeded()) failed = failed + 1
            if (report%gave_up /= "") handed_over = handed_over + 1
         end associate
      end do
      result%seconds = result%seconds/cases
      result%pair = result%pair/((cases + 99)/100)
      result%allocations = nint(result%allocations/(cases - 1.0_wp), long)
      if (before < 0) result%allocations = -1
      result%report%residual = worst
      result%report%fft_pairs = pairs/cases
      result%report%products = nint(products/cases)
      result%report%iterations = nint(steps/cases)
      result%report%ended = merge(ending%converged, ending%iteration_limit, failed == 0)
      name = "table, mean of " // number(cases) // merge(" cases, from the previous one (I=1)", &
         & " cases, from scratch (I=0)         ", start == estimate_choice%previous)
      name = trim(name)
      if (failed > 0) name = name // ", " // number(failed) // " without success"
      if (handed_over > 0) name = name // ", " // number(handed_over) // " handed over"
      call row(name, square(mx), case%result%ncon, result, goal)
      call case%release()
   end subroutine table_row

   subroutine set_creepage(case, k)
      type(session_case), intent(inout) :: case
      integer, intent(in) :: k
      real(wp) :: creepage(3)

      creepage = table_creepage(k)
      case%spec%kinematics%cksi = creepage(1)
      case%spec%kinematics%ceta = creepage(2)
      case%spec%kinematics%cphi = creepage(3)
   end subroutine set_creepage

   function number(n) result(text)
      integer, intent(in) :: n
      character(len=:), allocatable :: text
      character(len=12) :: buffer

      write(buffer, "(i0)") n
      text = trim(buffer)
   end function number

   !> Where 50 repeated cases ask for memory: PLACE count addresses, to be named by addr2line
   subroutine list_allocations()
      type(session_case) :: case
      type(solve_report) :: report
      character(len=80) :: kind, text
      integer :: k, mx

      call get_command_argument(2, kind)
      call get_command_argument(3, text)
      mx = 11
      if (len_trim(text) > 0) read(text, *) mx
      call new_table_case(mx, case)
      call set_table_kind(kind, case)
      do k = 1, 20
         call set_creepage(case, k)
         call case%run(report)
      end do
      call trace_allocations(.true.)
      do k = 21, 70
         call set_creepage(case, k)
         call case%run(report)
      end do
      call trace_allocations(.false.)
      call print_places()
      call case%release()
   end subroutine list_allocations

   !> Ten seconds or a number of one kind of case
   subroutine profile()
      real(wp), parameter :: duration = 10.0_wp
      type(session_case) :: table
      type(solve_report) :: report
      character(len=80) :: name, text
      real(wp) :: start
      integer :: k, mx, cases

      call get_command_argument(2, name)
      call get_command_argument(3, text)
      cases = 0
      if (len_trim(text) > 0) read(text, *) cases
      select case (name)
      case ("table11", "table19", "table25", "table35", "fresh11", "fresh19", "fresh25", "fresh35")
         read(name(6:7), *) mx
         call new_table_case(mx, table)
         table%spec%estimate = merge(estimate_choice%fresh, estimate_choice%previous, name(:5) == "fresh")
      case ("rolling160")
         call new_rolling_case(rolling_contacts(1), 160, 1.0e-6_wp, tangential)
      case ("normal160")
         call new_normal_case(160, .true., 1.0e-8_wp, normal)
      case default
         error stop "usage: performance_bench --profile table11|...|table35|fresh11|...|fresh35|rolling160|normal160 [N]"
      end select
      start = cpu_seconds()
      k = 0
      do
         if (cases > 0) then
            if (k == cases) exit
         else if (cpu_seconds() - start >= duration) then
            exit
         end if
         k = k + 1
         select case (name)
         case ("rolling160")
            call tangential%run(report)
         case ("normal160")
            call normal%run(report)
         case default
            call set_creepage(table, 1 + mod(k - 1, table_size))
            call solve_one(table)
         end select
      end do
      write(output_unit, "(a, i0, a, g0.4, a)") trim(name), k, " cases, ", 1000.0_wp*(cpu_seconds() - start)/k, " ms each"
      call table%release()
   end subroutine profile

   !> Milliseconds of one contact on n by n elements: repeated, and the first time with all set-up
   subroutine one_case()
      character(len=80) :: name, size_text
      type(solve_report) :: report
      type(measurement) :: result
      real(wp) :: start, first
      integer :: k, n

      call get_command_argument(2, name)
      call get_command_argument(3, size_text)
      read(size_text, *) n
      call clock%prepare(8, 8)
      do k = 1, size(rolling_contacts)
         if (rolling_contacts(k)%name /= name) cycle
         start = cpu_seconds()
         call new_rolling_case(rolling_contacts(k), n, 1.0e-6_wp, tangential)
         call tangential%run(report)
         first = cpu_seconds() - start
         call measure(tangential, clock, 0.5_wp, result)
         write(output_unit, "(2f14.4)") 1000.0_wp*result%seconds, 1000.0_wp*first
         return
      end do
      error stop "performance_bench --case: unknown contact"
   end subroutine one_case

   !> The cases of a table for the whole program
   subroutine write_input()
      character(len=240) :: file, size_text
      type(session_case) :: case
      integer :: unit, k, mx

      call get_command_argument(2, size_text)
      call get_command_argument(3, file)
      read(size_text, *) mx
      call new_table_case(mx, case)
      open(newunit=unit, file=trim(file), status="replace", action="write")
      write(unit, "(a)") "3    MODULE"
      do k = 1, table_size
         associate (spec => case%spec)
            write(unit, "(a)") "203100"
            write(unit, "(a)") merge("022020", "100000", k == 1)
            write(unit, "(2a)") merge("00001", "01101", k == 1), merge("01", "00", k == table_size)
            if (k == 1) write(unit, "(a)") "999 100 30 1 1e-5"
            write(unit, "(f10.1, 3es16.7)") spec%kinematics%fn, table_creepage(k)
            if (k > 1) cycle
            write(unit, "(2f6.2)") spec%friction%sets(1)%fstat, spec%friction%sets(1)%fkin
            write(unit, "(3es18.10)") 0.0_wp, spec%rolling%dq, spec%rolling%veloc
            write(unit, "(4f10.2)") spec%material%poiss, spec%material%gg
            write(unit, "(i0)") spec%grid%form
            write(unit, "(2i6, 3f10.4)") mx, mx, spec%grid%aa, spec%grid%bb, spec%grid%scale
         end associate
      end do
      write(unit, "(a)") "0    MODULE: end"
      close(unit)
      call case%release()
   end subroutine write_input
end program performance_bench
