!> Speed of this machine, by which expected times are multiplied
module contact_cases_machine_pace
   use contact_base_kinds, only : wp
   use contact_base_limits, only : wall_clock
   use contact_fft_plan, only : fft_plan
   implicit none (type, external)
   private

   public :: machine_pace

   !> Time of the transforms below on the machine on which the expected times were measured [s]
   real(wp), parameter :: usual = 1.4e-4_wp
   !> Window of the transforms, half of the padded one; transforms forward and back of one measurement; measurements, of which the
   !> shortest counts, because other processes only add time
   integer, parameter :: side = 40, transforms = 8, measurements = 7
   !> Ratio found, 0 before the first measurement
   real(wp) :: found = 0.0_wp

contains

   !> Time that a computation takes here over that on the machine of the tables; measured in the first call of a process, in 1.5 ms
   real(wp) function machine_pace() result(ratio)
      !$omp critical (contact_machine_pace)
      if (.not. found > 0.0_wp) call measure(found)
      ratio = found
      !$omp end critical (contact_machine_pace)
   end function machine_pace

   !> Measure the ratio by transforms, which take most of the time of a case
   subroutine measure(ratio)
      real(wp), intent(out) :: ratio
      type(fft_plan) :: plan
      real(wp), allocatable :: field(:, :)
      complex(wp), allocatable :: spectrum(:, :)
      real(wp) :: start, shortest
      integer :: k, n

      call plan%prepare(side, side, 2*side, 2*side)
      allocate(field(side, side), source=1.0_wp)
      allocate(spectrum(2*side, plan%kx), source=(0.0_wp, 0.0_wp))
      shortest = huge(1.0_wp)
      do k = 1, measurements
         start = wall_clock()
         do n = 1, transforms
            call plan%forward(field, spectrum)
            call plan%backward(spectrum, field)
            field = field/(2*side)**2
         end do
         shortest = min(shortest, wall_clock() - start)
      end do
      call plan%release()
      ratio = shortest/usual
   end subroutine measure
end module contact_cases_machine_pace
