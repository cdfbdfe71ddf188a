!> Lengths of transforms
module contact_fft_sizes
   use contact_fft_library, only : fast_lengths
   implicit none (type, external)
   private

   public :: fast_line_size, fast_size, good_size, largest_fast_size

   !> Windows whose padded sides are not longer are small
   integer, parameter :: largest_fast_size = 128
   !> Lengths that are transformed fast by four_lines, by measurement: no longer length takes less time
   integer, parameter :: short_lengths(*) = [2, 4, 6, 8, 12, 16, 20, 24, 28, 32, 36, 40, 48, 54, 64, 72, 80, 84, 96, 100, 112, 128]
   integer, parameter :: long_lengths(*) = [144, 160, 192, 200, 216, 256, 288, 320, 384, 400, 432, 512, 576, 640, 648, 720, &
      & 768, 800, 864, 960, 1024, 1152, 1280, 1296, 1536, 1600, 1728, 2048, 2304, 2400, 2560]

contains

   !> Smallest even number 2^a 3^b 5^c 7^d (a >= 1) that is at least n, or 1 for n <= 1
   pure integer function good_size(n) result(size)
      !> Number of points that are needed, with those of the padding
      integer, intent(in) :: n
      integer :: rest, factor
      integer, parameter :: primes(4) = [2, 3, 5, 7]

      size = max(1, n)
      if (size == 1) return
      if (mod(size, 2) == 1) size = size + 1
      do
         rest = size
         do factor = 1, 4
            do while (mod(rest, primes(factor)) == 0)
               rest = rest/primes(factor)
            end do
         end do
         if (rest == 1) return
         size = size + 2
      end do
   end function good_size

   !> Even length of at least n that is transformed quickly in windows of several rows, or 1 for n <= 1
   pure integer function fast_size(n)
      !> Number of points that are needed, with those of the padding
      integer, intent(in) :: n

      if (n > long_lengths(size(long_lengths))) then
         fast_size = good_size(n)
      else if (n > largest_fast_size) then
         fast_size = minval(long_lengths, long_lengths >= n)
      else if (n > 1) then
         fast_size = minval(short_lengths, short_lengths >= n)
      else
         fast_size = 1
      end if
   end function fast_size

   !> The same for a window of one row, which the library transforms
   pure integer function fast_line_size(n)
      !> Number of points that are needed, with those of the padding
      integer, intent(in) :: n

      if (n > fast_lengths(size(fast_lengths)) .or. n <= 1) then
         fast_line_size = good_size(n)
      else
         fast_line_size = minval(fast_lengths, fast_lengths >= n)
      end if
   end function fast_line_size
end module contact_fft_sizes
