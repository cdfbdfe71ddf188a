!> Decimal digits of numbers in JSON files: the fewest of 15 to 17 that are read back as the same number, correctly rounded
program test_number_digits
   use, intrinsic :: iso_c_binding, only : c_char, c_double, c_int
   use contact_base_kinds, only : wp
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> Least and most digits
   integer, parameter :: least = 15, most = 17
   type(test_suite) :: suite
   interface
      pure subroutine number_digits(value, digits, exponent) bind(c, name="contact_number_digits")
         import :: c_char, c_double, c_int, most
         real(c_double), value :: value
         character(kind=c_char), intent(out) :: digits(most)
         integer(c_int), intent(out) :: exponent
      end subroutine number_digits
   end interface

   call suite%start("number_digits")
   call special_numbers(suite)
   call near_powers_of_ten(suite)
   call many_numbers(suite)
   call suite%finish()

contains

   !> Short numbers, those that end half way between 15 or 16 digits, and the ends of the range
   subroutine special_numbers(suite)
      type(test_suite), intent(inout) :: suite
      integer :: k

      call check_number(suite, 1.0_wp)
      call check_number(suite, 0.1_wp)
      call check_number(suite, 0.1_wp + 0.2_wp)
      call check_number(suite, tiny(1.0_wp))
      call check_number(suite, 4.9406564584124654e-324_wp)
      call check_number(suite, 0.7_wp*tiny(1.0_wp))
      call check_number(suite, huge(1.0_wp))
      ! whole numbers of 16 and 17 digits that end in 5 and 50
      do k = 1, 9
         call check_number(suite, 100000000000005.0_wp + 111111111111110.0_wp*k)
         call check_number(suite, 1000000000000005.0_wp + 100000000000010.0_wp*k)
         call check_number(suite, 10000000000000050.0_wp + 1000000000000100.0_wp*k)
         call check_number(suite, 1000000000000000.5_wp + k)
      end do
   end subroutine special_numbers

   !> Rounding to fewer digits carries over all of them
   subroutine near_powers_of_ten(suite)
      type(test_suite), intent(inout) :: suite
      integer :: k

      do k = -300, 300
         call check_number(suite, nearest(10.0_wp**k, -1.0_wp))
         call check_number(suite, 10.0_wp**k)
         call check_number(suite, nearest(10.0_wp**k, 1.0_wp))
      end do
   end subroutine near_powers_of_ten

   !> Quotients, of which nine in ten need 16 or 17 digits, and decimal fractions
   subroutine many_numbers(suite)
      type(test_suite), intent(inout) :: suite
      integer :: k

      do k = 1, 3000
         call check_number(suite, k/7919.0_wp)
         call check_number(suite, 1.0e-3_wp*k)
      end do
   end subroutine many_numbers

   !> Against formatted output with each number of digits
   subroutine check_number(suite, value)
      type(test_suite), intent(inout) :: suite
      real(wp), intent(in) :: value
      character(kind=c_char) :: digits(most)
      character(len=32) :: text
      character(len=most) :: found, expected
      character(len=12) :: form
      real(wp) :: back
      integer(c_int) :: exponent
      integer :: count, mark, power

      do count = least, most
         write(form, "(A, I0, A)") "(ES32.", count - 1, "E4)"
         write(text, form) value
         read(text, *) back
         if (abs(back - value) <= 0.0_wp) exit
      end do
      text = adjustl(text)
      mark = index(text, "E")
      read(text(mark + 1:), *) power
      expected = text(1:1) // text(3:mark - 1)
      expected(count + 1:) = repeat("0", most - count)
      call number_digits(value, digits, exponent)
      found = transfer(digits, found)
      if (found == expected .and. exponent == power) then
         call suite%check(.true., text)
      else
         call suite%equal(found, expected, "digits of " // text)
         call suite%equal(int(exponent), power, "exponent of " // text)
      end if
   end subroutine check_number
end program test_number_digits
