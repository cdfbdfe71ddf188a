!> Clocks of the benchmark: seconds of one thread, pairs of transforms, requests to the heap
module contact_bench_measure
   use, intrinsic :: iso_c_binding, only : c_associated, c_int, c_long, c_null_ptr, c_ptr
   use contact_base_kinds, only : long, wp
   use contact_base_solve_report, only : solve_report
   use contact_fft_fftw, only : fftw_destroy_plan, fftw_estimate, fftw_execute_dft_c2r, fftw_execute_dft_r2c, &
      & fftw_plan_dft_c2r_2d, fftw_plan_dft_r2c_2d
   implicit none (type, external)
   private

   public :: timed_case, pair_clock, measurement, measure, allocations, trace_allocations, print_places
   public :: cpu_seconds, median, peak_memory

   !> Something that can be solved again and again from the same start
   type, abstract :: timed_case
   contains
      procedure(run_case), deferred :: run
   end type timed_case

   abstract interface
      !> Solve once; the start is part of the case
      subroutine run_case(self, report)
         import :: solve_report, timed_case
         class(timed_case), intent(inout) :: self
         type(solve_report), intent(inout) :: report
      end subroutine run_case
   end interface

   !> One real transform forward and back of a full padded window, as FFTW does it by itself
   type :: pair_clock
      integer :: px = 0, py = 0
      type(c_ptr), private :: forward = c_null_ptr, backward = c_null_ptr
      real(wp), allocatable, private :: field(:, :)
      complex(wp), allocatable, private :: spectrum(:, :)
   contains
      procedure :: prepare => prepare_clock
      procedure :: seconds => seconds_of_wheel_rail
   end type pair_clock

   !> What was measured of a case
   type :: measurement
      !> Seconds of the processor for one case and for one pair, medians
      real(wp) :: seconds = 0.0_wp, pair = 1.0_wp
      !> How many times the case was run
      integer :: repeats = 0
      !> Requests to the heap in a repeated run, -1 when they cannot be counted
      integer(long) :: allocations = -1_long
      type(solve_report) :: report
   end type measurement

   interface
      function bench_allocations() bind(c) result(n)
         import :: c_long
         integer(c_long) :: n
      end function bench_allocations
      subroutine bench_trace(on) bind(c)
         import :: c_int
         integer(c_int), value :: on
      end subroutine bench_trace
      subroutine bench_print_places() bind(c)
      end subroutine bench_print_places
   end interface

contains

   !> Seconds of the processor so far; with one thread the wall clock of an idle machine
   real(wp) function cpu_seconds() result(seconds)
      call cpu_time(seconds)
   end function cpu_seconds

   !> Requests to the heap so far, -1 when unknown
   integer(long) function allocations() result(n)
      n = int(bench_allocations(), long)
   end function allocations

   subroutine trace_allocations(on)
      logical, intent(in) :: on
      call bench_trace(merge(1_c_int, 0_c_int, on))
   end subroutine trace_allocations

   subroutine print_places()
      flush(6)
      call bench_print_places()
   end subroutine print_places

   subroutine prepare_clock(self, px, py)
      class(pair_clock), intent(inout) :: self
      !> Padded window
      integer, intent(in) :: px, py

      if (self%px == px .and. self%py == py) return
      if (c_associated(self%forward)) call fftw_destroy_plan(self%forward)
      if (c_associated(self%backward)) call fftw_destroy_plan(self%backward)
      if (allocated(self%field)) deallocate(self%field, self%spectrum)
      allocate(self%field(px, py), self%spectrum(px/2 + 1, py))
      self%px = px
      self%py = py
      self%forward = fftw_plan_dft_r2c_2d(py, px, self%field, self%spectrum, fftw_estimate)
      self%backward = fftw_plan_dft_c2r_2d(py, px, self%spectrum, self%field, fftw_estimate)
      self%field = 0.0_wp
      self%field(1:(px + 1)/2, 1:(py + 1)/2) = 1.0_wp
      self%spectrum = (0.0_wp, 0.0_wp)
   end subroutine prepare_clock

   !> Seconds of one pair, mean over some milliseconds
   real(wp) function seconds_of_wheel_rail(self) result(seconds)
      class(pair_clock), intent(inout) :: self
      real(wp), parameter :: shortest = 4.0e-3_wp
      real(wp) :: start
      integer :: n, k, block

      n = 0
      block = max(1, 40000/(self%px*self%py))
      start = cpu_seconds()
      do
         do k = 1, block
            call fftw_execute_dft_r2c(self%forward, self%field, self%spectrum)
            call fftw_execute_dft_c2r(self%backward, self%spectrum, self%field)
            self%field = self%field*(1.0_wp/(real(self%px, wp)*self%py))
         end do
         n = n + block
         seconds = cpu_seconds() - start
         if (seconds > shortest) exit
      end do
      seconds = seconds/n
   end function seconds_of_wheel_rail

   !> Run a case until a time is used up, at least once after a first run that is not counted, and
   !> time pairs of transforms in between so that both see the same machine
   subroutine measure(case, clock, limit, result)
      class(timed_case), intent(inout) :: case
      type(pair_clock), intent(inout) :: clock
      !> Seconds after which no further run is begun
      real(wp), intent(in) :: limit
      type(measurement), intent(out) :: result
      integer, parameter :: most = 25
      real(wp), parameter :: shortest = 4.0e-3_wp
      real(wp) :: start, begun, used, seconds(most), pairs(most)
      integer(long) :: before
      integer :: k, n, i

      start = cpu_seconds()
      call case%run(result%report)
      used = cpu_seconds() - start
      seconds(1) = used
      n = max(1, int(shortest/max(used, 1.0e-7_wp)))
      pairs(1) = clock%seconds()
      result%repeats = 1
      if (used > limit) then
         result%seconds = seconds(1)
         result%pair = pairs(1)
         return
      end if
      do i = 1, most
         result%repeats = i
         pairs(i) = clock%seconds()
         before = allocations()
         begun = cpu_seconds()
         do k = 1, n
            call case%run(result%report)
         end do
         seconds(i) = (cpu_seconds() - begun)/n
         result%allocations = (allocations() - before)/n
         if (before < 0) result%allocations = -1
         if (cpu_seconds() - start > limit) exit
      end do
      result%seconds = median(seconds(:result%repeats))
      result%pair = median(pairs(:result%repeats))
   end subroutine measure

   !> Middle value
   pure real(wp) function median(values) result(middle)
      real(wp), intent(in) :: values(:)
      real(wp) :: sorted(size(values)), keep
      integer :: i, j

      sorted = values
      do i = 2, size(sorted)
         keep = sorted(i)
         do j = i - 1, 1, -1
            if (sorted(j) <= keep) exit
            sorted(j + 1) = sorted(j)
         end do
         sorted(j + 1) = keep
      end do
      middle = 0.5_wp*(sorted((size(sorted) + 1)/2) + sorted(size(sorted)/2 + 1))
   end function median

   !> Largest resident memory of this process so far [MB], -1 where /proc does not tell
   real(wp) function peak_memory() result(megabytes)
      character(len=80) :: line
      integer :: unit, status, kilobytes

      megabytes = -1.0_wp
      open(newunit=unit, file="/proc/self/status", status="old", action="read", iostat=status)
      if (status /= 0) return
      do
         read(unit, "(a)", iostat=status) line
         if (status /= 0) exit
         if (line(1:6) /= "VmHWM:") cycle
         read(line(7:), *, iostat=status) kilobytes
         if (status == 0) megabytes = kilobytes/1024.0_wp
         exit
      end do
      close(unit)
   end function peak_memory
end module contact_bench_measure
