!> Numbers around the switching points of the formats, and comparison with edit descriptors
program test_formats
   use, intrinsic :: ieee_arithmetic, only : ieee_positive_inf, ieee_quiet_nan, ieee_value
   use contact_base_kinds, only : wp
   use contact_output_formats, only : fixed, general, heading, scientific, smart, whole
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite
   !> The values of the table
   real(wp), parameter :: value(9) = [0.0099_wp, 0.01_wp, 0.0999_wp, 0.1_wp, 9999.4_wp, 9999.97_wp, 10000.0_wp, &
      & -0.00001_wp, 0.0_wp]

   call suite%start("output formats")
   call check_general()
   call check_smart()
   call check_special()
   call check_descriptors()
   call check_signs()
   call suite%finish()

contains

   !> A number below 0 has the digits of the one above, and a minus sign, where there is room for it
   subroutine check_signs()
      real(wp) :: number
      integer :: k

      do k = -30, 30
         number = 1.2345678_wp*10.0_wp**k
         call suite%equal(without_sign(fixed(-number, 20, 4)), without_sign(fixed(number, 20, 4)), "fixed")
         call suite%equal(without_sign(general(-number, 14, 4)), without_sign(general(number, 14, 4)), "general")
         call suite%equal(without_sign(smart(-number, 14, 4, 4)), without_sign(smart(number, 14, 4, 4)), "smart")
         call suite%equal(without_sign(scientific(-number, 14, 4)), without_sign(scientific(number, 14, 4)), "scientific")
         call suite%check(index(fixed(-number, 20, 4), "-") > 0 .or. number < 1.0e-4_wp, "a sign")
         call suite%check(index(fixed(-number, 12, 4), "*") == 0, "no stars")
      end do
   end subroutine check_signs

   !> The text from its first digit or point on, without the first minus sign
   function without_sign(text) result(rest)
      character(len=*), intent(in) :: text
      character(len=len(text)) :: rest
      integer :: k

      rest = adjustl(text)
      k = index(rest, "-")
      if (k == 1) rest = rest(2:)
      ! a zero before the point is replaced by the sign
      if (rest(1:2) == "0.") rest = rest(2:)
   end function without_sign

   subroutine check_general()
      character(len=12), parameter :: wide(9) = ["  0.9900E-02", "  0.1000E-01", "  0.9990E-01", "  0.1000    ", &
         & "   9999.    ", "  0.1000E+05", "  0.1000E+05", " -0.1000E-04", "   0.000    "]
      character(len=11), parameter :: narrow(9) = ["  0.990E-02", "  0.100E-01", "  0.999E-01", "  0.100    ", &
         & "  0.100E+05", "  0.100E+05", "  0.100E+05", " -0.100E-04", "   0.00    "]
      character(len=14), parameter :: table(9) = ["  0.990000E-02", "  0.100000E-01", "  0.999000E-01", &
         & "  0.100000    ", "   9999.40    ", "   9999.97    ", "   10000.0    ", " -0.100000E-04", "   0.00000    "]
      integer :: i

      do i = 1, size(value)
         call suite%equal(general(value(i), 12, 4), wide(i), "G 12.4 of " // trim(table(i)))
         call suite%equal(general(value(i), 11, 3), narrow(i), "G 11.3 of " // trim(table(i)))
         call suite%equal(general(value(i), 14, 6), table(i), "G 14.6 of " // trim(table(i)))
      end do
      call suite%equal(general(0.42_wp, 12, 4), "  0.4200    ", "0.42")
      call suite%equal(general(200.0_wp, 12, 4), "   200.0    ", "200")
      call suite%equal(general(1000.0_wp, 12, 4), "   1000.    ", "1000")
      call suite%equal(general(82000.0_wp, 12, 4), "  0.8200E+05", "82000")
      call suite%equal(general(-0.000035_wp, 12, 4), " -0.3500E-04", "-0.000035")
      call suite%equal(general(0.099999_wp, 12, 4), "  0.1000    ", "rounding up to 0.1 switches the format")
   end subroutine check_general

   subroutine check_smart()
      character(len=12), parameter :: four(9) = ["   9.900E-03", "   1.000E-02", "   9.990E-02", "      0.1000", &
         & "       9999.", "      10000.", "   1.000E+04", "  -1.000E-05", "       0.000"]
      character(len=12), parameter :: approach(9) = ["   9.900E-03", "   1.000E-02", "   9.990E-02", "    0.100000", &
         & "     9999.40", "     9999.97", "     10000.0", "  -1.000E-05", "     0.00000"]
      character(len=12), parameter :: points(9) = ["  9.9000E-03", "  1.0000E-02", "  9.9900E-02", "    0.100000", &
         & "     9999.40", "     9999.97", "     10000.0", " -1.0000E-05", "     0.00000"]
      character(len=12), parameter :: three(9) = ["    9.90E-03", "    1.00E-02", "    9.99E-02", "       0.100", &
         & "    1.00E+04", "    1.00E+04", "    1.00E+04", "   -1.00E-05", "        0.00"]
      integer :: i

      do i = 1, size(value)
         call suite%equal(smart(value(i), 12, 4, 4), four(i), "S 12/4/4 of " // four(i))
         call suite%equal(smart(value(i), 12, 6, 4), approach(i), "S 12/6/4 of " // four(i))
         call suite%equal(smart(value(i), 12, 6, 5), points(i), "S 12/6/5 of " // four(i))
         call suite%equal(smart(value(i), 12, 3, 3), three(i), "S 12/3/3 of " // four(i))
      end do
      call suite%equal(smart(0.12345_wp, 12, 4, 4), "      0.1235", "0.12345 is rounded as usual")
      call suite%equal(smart(0.99997_wp, 12, 4, 4), "      1.0000", "the switch looks at the unrounded value")
      call suite%equal(smart(0.108244_wp, 12, 6, 4), "    0.108244", "approach of 0.108244")
      call suite%equal(smart(0.0199_wp, 12, 6, 4), "   1.990E-02", "approach of 0.0199")
      call suite%equal(smart(-7.1964e-6_wp, 12, 6, 5), " -7.1964E-06", "11 characters suffice")
   end subroutine check_smart

   subroutine check_special()
      real(wp) :: zero

      zero = 0.0_wp
      call suite%equal(smart(-zero, 12, 4, 4), "       0.000", "no negative zero, smart")
      call suite%equal(general(-zero, 12, 4), "   0.000    ", "no negative zero, general")
      call suite%equal(fixed(-1.0e-9_wp, 10, 3), "     0.000", "no sign before zeros")
      call suite%equal(general(1.0e-120_wp, 14, 6), "   0.00000    ", "tiny numbers are zero")
      call suite%equal(general(1.0e30_wp, 14, 6), "  0.100000E+31", "distance of excluded elements")
      call suite%equal(general(-1.0e120_wp, 12, 4), "-0.1000E+121", "three digits in the exponent")
      call suite%equal(scientific(9.9996_wp, 10, 3), " 1.000E+01", "rounding up to the next power")
      call suite%equal(fixed(123456.7_wp, 8, 3), "123456.7", "large numbers have fewer decimals")
      call suite%equal(fixed(-0.853264_wp, 10, 3), "    -0.853", "fixed point")
      call suite%check(index(fixed(1.0e12_wp, 10, 3), "*") == 0, "no stars")
      call suite%equal(whole(42, 7), "     42", "integer")
      call suite%equal(whole(-1, 7), "     -1", "negative integer")
      call suite%equal(whole(123456, 3), "123456", "a long integer keeps its digits")
      call suite%equal(smart(ieee_value(zero, ieee_quiet_nan), 12, 4, 4), "         NaN", "NaN")
      call suite%equal(general(ieee_value(zero, ieee_positive_inf), 12, 4), "         Inf", "infinity")
      call suite%equal(trim(heading("NU G AK")), "     NU          G           AK", "heading")
   end subroutine check_special

   !> The same texts as edit descriptors give, for numbers of all sizes without ties in rounding
   subroutine check_descriptors()
      character(len=60) :: expected
      real(wp) :: number
      integer :: i, different

      different = 0
      do i = 1, 4000
         number = 10.0_wp**(-30.0_wp + 0.0151_wp*real(i, wp))*(1.0_wp + 0.37_wp*sin(real(i, wp)))
         if (mod(i, 2) == 0) number = -number
         write(expected, "(g12.4, g11.3, g14.6, es12.3)") number, number, number, number
         if (expected(1:49) /= general(number, 12, 4) // general(number, 11, 3) // general(number, 14, 6) &
            & // scientific(number, 12, 3)) different = different + 1
      end do
      call suite%equal(different, 0, "general and scientific agree with the edit descriptors")
   end subroutine check_descriptors
end program test_formats
