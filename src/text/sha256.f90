!> The hash SHA-256 of a text, as `sha256sum` prints it (FIPS PUB 180-4, sections 4.1.2, 4.2.2, 5 and 6.2)
module contact_text_sha256
   use contact_base_kinds, only : long, wp
   implicit none (type, external)
   private

   public :: sha256

   !> Bytes per block, words of the message schedule
   integer, parameter :: block_bytes = 64, words = 64
   !> All bits of a word. Words are kept in longer integers, so that sums do not overflow
   integer(long), parameter :: all_bits = int(z'FFFFFFFF', long)
   !> First 32 bits of the fractional parts of the square roots of the first 8 primes
   integer(long), parameter :: first_state(8) = [int(z'6a09e667', long), int(z'bb67ae85', long), int(z'3c6ef372', long), &
      & int(z'a54ff53a', long), int(z'510e527f', long), int(z'9b05688c', long), int(z'1f83d9ab', long), int(z'5be0cd19', long)]
   !> The first 64 primes; the fractional parts of their cube roots are the constants of the rounds
   integer, parameter :: primes(words) = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71, 73, 79, 83, &
      & 89, 97, 101, 103, 107, 109, 113, 127, 131, 137, 139, 149, 151, 157, 163, 167, 173, 179, 181, 191, 193, 197, 199, 211, 223, &
      & 227, 229, 233, 239, 241, 251, 257, 263, 269, 271, 277, 281, 283, 293, 307, 311]

contains

   !> Hash of a text in hexadecimal digits
   pure function sha256(text) result(digits)
      !> Any bytes
      character(len=*), intent(in) :: text
      character(len=64) :: digits
      integer(long) :: constants(words), state(8)
      character(len=2*block_bytes) :: tail
      integer :: k, left

      call make_constants(constants)
      state = first_state
      do k = 1, len(text) - block_bytes + 1, block_bytes
         call add_block(text(k:k + block_bytes - 1), constants, state)
      end do
      left = modulo(len(text), block_bytes)
      ! padding: a one bit, zeros, and the length in bits
      tail = repeat(char(0), len(tail))
      tail(:left) = text(len(text) - left + 1:)
      tail(left + 1:left + 1) = char(128)
      k = merge(block_bytes, 2*block_bytes, left < block_bytes - 8)
      call put_length(tail(k - 7:k), 8_long*len(text, kind=long))
      call add_block(tail(:block_bytes), constants, state)
      if (k > block_bytes) call add_block(tail(block_bytes + 1:), constants, state)
      write(digits, "(8Z8.8)") state
      do k = 1, len(digits)
         if (digits(k:k) >= "A" .and. digits(k:k) <= "F") digits(k:k) = achar(iachar(digits(k:k)) + 32)
      end do
   end function sha256

   !> Bits 1 to 32 after the binary point of the cube roots of the primes
   pure subroutine make_constants(constants)
      integer(long), intent(out) :: constants(words)
      integer :: k

      ! 35 bits of the root are needed; the test verifies that 52 suffice for these primes
      do k = 1, words
         constants(k) = iand(int(real(primes(k), wp)**(1.0_wp/3.0_wp)*2.0_wp**32, long), all_bits)
      end do
   end subroutine make_constants

   !> A number as eight bytes, most significant first
   pure subroutine put_length(bytes, number)
      character(len=8), intent(out) :: bytes
      integer(long), intent(in) :: number
      integer :: k

      do k = 1, len(bytes)
         bytes(k:k) = char(iand(shiftr(number, 8*(len(bytes) - k)), 255_long))
      end do
   end subroutine put_length

   !> Process a block of 64 bytes
   pure subroutine add_block(block, constants, state)
      character(len=block_bytes), intent(in) :: block
      integer(long), intent(in) :: constants(words)
      !> Intermediate hash
      integer(long), intent(inout) :: state(8)
      integer(long) :: first, second, v(8), w(words)
      integer :: k

      do k = 1, 16
         w(k) = ior(ior(shiftl(byte(4*k - 3), 24), shiftl(byte(4*k - 2), 16)), ior(shiftl(byte(4*k - 1), 8), byte(4*k)))
      end do
      do k = 17, words
         first = ieor(ieor(rotated(w(k - 15), 7), rotated(w(k - 15), 18)), shiftr(w(k - 15), 3))
         second = ieor(ieor(rotated(w(k - 2), 17), rotated(w(k - 2), 19)), shiftr(w(k - 2), 10))
         w(k) = iand(w(k - 16) + first + w(k - 7) + second, all_bits)
      end do
      v = state
      do k = 1, words
         first = v(8) + ieor(ieor(rotated(v(5), 6), rotated(v(5), 11)), rotated(v(5), 25)) &
            & + ieor(iand(v(5), v(6)), iand(ieor(v(5), all_bits), v(7))) + constants(k) + w(k)
         second = ieor(ieor(rotated(v(1), 2), rotated(v(1), 13)), rotated(v(1), 22)) &
            & + ieor(ieor(iand(v(1), v(2)), iand(v(1), v(3))), iand(v(2), v(3)))
         v(2:8) = v(1:7)
         v(5) = iand(v(5) + first, all_bits)
         v(1) = iand(first + second, all_bits)
      end do
      state = iand(state + v, all_bits)

   contains

      pure integer(long) function byte(place)
         integer, intent(in) :: place
         byte = int(ichar(block(place:place)), long)
      end function byte
   end subroutine add_block

   !> A word rotated to the right
   elemental integer(long) function rotated(word, steps)
      integer(long), intent(in) :: word
      !> Number of bits
      integer, intent(in) :: steps

      rotated = iand(ior(shiftr(word, steps), shiftl(word, 32 - steps)), all_bits)
   end function rotated
end module contact_text_sha256
