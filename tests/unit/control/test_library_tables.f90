!> Unit conventions, signs, flags and codes of the library: the tables against the published contract
program test_library_tables
   use contact_base_kinds, only : wp
   use contact_control_digits, only : case_digits, digit_value, put_digit
   use contact_control_flags, only : accepted_value, flag, flag_table, row_of_flag
   use contact_control_library_codes, only : code_text, library_code
   use contact_control_units, only : convention_code, find_convention, inward, orientation, outward, quantity, &
      & quantity_of, quantity_type, unit_convention
   use contact_patch_quantities, only : element_field
   use contact_patch_result, only : patch_result
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("tables of the library")
   call factors(suite)
   call there_and_back(suite)
   call signs(suite)
   call ranges(suite)
   call every_flag(suite)
   call texts(suite)
   call suite%finish()

contains

   !> Factors in SI units, where lengths are 1000 mm; the same in Simpack's, none in our own
   subroutine factors(suite)
      type(test_suite), intent(inout) :: suite
      type(unit_convention) :: own, si, simpack
      type(quantity_type) :: all_of_them(8)
      logical :: known

      call find_convention(convention_code%contact, own, known)
      call suite%check(known, "own units are known")
      call find_convention(convention_code%si, si, known)
      call find_convention(convention_code%simpack, simpack, known)
      all_of_them = [quantity%length, quantity%area, quantity%curvature, quantity%velocity, quantity%pressure, &
         & quantity%compliance, quantity%spin, quantity%density]
      call suite%check(all(abs(inward(own, all_of_them) - 1.0_wp) <= 0.0_wp), "own units have factor 1")
      call suite%check(all(abs(inward(si, all_of_them)/[1.0e3_wp, 1.0e6_wp, 1.0e-3_wp, 1.0e3_wp, 1.0e-6_wp, 1.0e9_wp, &
         & 1.0e-3_wp, 1.0e-9_wp] - 1.0_wp) < 1.0e-14_wp), "SI: m, m2, 1/m, m/s, Pa, m3/N, rad/m, kg/m3")
      call suite%check(all(abs(inward(si, all_of_them) - inward(simpack, all_of_them)) <= 0.0_wp), "Simpack has SI units")
      call suite%check(abs(inward(si, quantity%moment) - 1.0e3_wp) <= 0.0_wp, "N m")
      call suite%check(abs(inward(si, quantity%stiffness)/1.0e-3_wp - 1.0_wp) < 1.0e-14_wp, "N/m")
      simpack = own
      call find_convention(4711, simpack, known)
      call suite%check(.not. known .and. simpack%code == own%code, "an unknown convention changes nothing")
   end subroutine factors

   !> Input and output conversions are inverse
   subroutine there_and_back(suite)
      type(test_suite), intent(inout) :: suite
      type(unit_convention) :: units
      type(patch_result), target :: nothing
      type(element_field), allocatable :: fields(:)
      logical :: known
      integer :: code, k
      real(wp) :: factor

      call nothing%fields(fields)
      do code = convention_code%contact, convention_code%imperial
         call find_convention(code, units, known)
         do k = 1, size(fields)
            factor = inward(units, quantity_of(fields(k)%unit))*outward(units, quantity_of(fields(k)%unit))
            call suite%check(abs(factor - 1.0_wp) < 1.0e-14_wp, "field and back")
         end do
      end do
   end subroutine there_and_back

   !> Body and side
   subroutine signs(suite)
      type(test_suite), intent(inout) :: suite
      type(unit_convention) :: si, simpack
      logical :: known

      call find_convention(convention_code%si, si, known)
      call find_convention(convention_code%simpack, simpack, known)
      call expect_sign(suite, si, orientation%along, .true., 1.0_wp, "along, left, body 1")
      call expect_sign(suite, si, orientation%across, .true., -1.0_wp, "across, left, body 1")
      call expect_sign(suite, simpack, orientation%along, .true., -1.0_wp, "along, left, body 2")
      call expect_sign(suite, simpack, orientation%across, .true., 1.0_wp, "across, left, body 2")
      call expect_sign(suite, simpack, orientation%across, .false., -1.0_wp, "across, right, body 2")
      call expect_sign(suite, simpack, orientation%side, .true., -1.0_wp, "side, left")
      call expect_sign(suite, simpack, orientation%side, .false., 1.0_wp, "side, right")
      call expect_sign(suite, simpack, orientation%none, .true., 1.0_wp, "no sign")
   end subroutine signs

   subroutine expect_sign(suite, units, along, left, sign, what)
      type(test_suite), intent(inout) :: suite
      type(unit_convention), intent(in) :: units
      integer, intent(in) :: along
      logical, intent(in) :: left
      real(wp), intent(in) :: sign
      character(len=*), intent(in) :: what

      call suite%check(abs(outward(units, quantity%force, along, left) - sign) <= 0.0_wp, what)
   end subroutine expect_sign

   !> Values out of range: the nearest one is stored if that is documented, otherwise nothing
   subroutine ranges(suite)
      type(test_suite), intent(inout) :: suite

      call expect_range(suite, flag%tang, 9, 3, 3)
      call expect_range(suite, flag%tang, -1, 3, 0)
      call expect_range(suite, flag%matfil, 9, 3, 0)
      call expect_range(suite, flag%sbsout, 3, 3, 2)
      call expect_range(suite, flag%sbsout, 9, 3, 4)
      call expect_range(suite, flag%config, 7, 1, 5)
      call expect_range(suite, flag%force, 3, 1, 3)
      call expect_range(suite, flag%force, 3, 3, 2)
      call expect_range(suite, flag%ifvari, 0, 3, 1)
      call expect_range(suite, flag%npomax, 7, 1, 100)
      call expect_range(suite, flag%output, 6, 3, 6)
      call expect_range(suite, flag%inflcf, 9, 3, -1)
      call expect_range(suite, flag%units, 1, 3, -1)
   end subroutine ranges

   !> Stored value, -1 if nothing is stored
   subroutine expect_range(suite, code, number, module_number, stored)
      type(test_suite), intent(inout) :: suite
      integer, intent(in) :: code, number, module_number, stored
      integer :: got
      logical :: accepted

      call accepted_value(flag_table(row_of_flag(code)), number, module_number, got, accepted)
      if (.not. accepted) got = -1
      call suite%check(got == stored, "range of a flag")
   end subroutine expect_range

   !> Each code is listed once, and flags of digits refer to their digit
   subroutine every_flag(suite)
      type(test_suite), intent(inout) :: suite
      type(case_digits) :: digits
      integer :: k, number

      do k = 1, size(flag_table)
         associate (row => flag_table(k))
            call suite%check(row_of_flag(row%code) == k, "codes differ")
            call suite%check(row%lowest <= row%highest, "range")
            if (row%digit == "" .or. .not. row%can_set) cycle
            number = merge(1, 0, digit_value(digits, trim(row%digit)) == 0)
            call put_digit(digits, row%digit, number)
            call suite%check(digit_value(digits, trim(row%digit)) == number, "digit " // row%digit)
         end associate
      end do
      call suite%check(row_of_flag(1) == 0, "unknown flag")
   end subroutine every_flag

   !> Codes have unique texts
   subroutine texts(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: codes(*) = [library_code%success, library_code%in_use, library_code%not_allowed, &
         & library_code%search, library_code%total_force, library_code%normal, library_code%tangential, &
         & library_code%tolerance, library_code%no_patch, library_code%profile, library_code%friction, &
         & library_code%discretisation, library_code%input_file, library_code%other, library_code%bad_element, &
         & library_code%not_module_1, library_code%not_module_3, library_code%bad_patch, library_code%patch_needed, &
         & library_code%patch_unwanted]
      integer :: i, j

      do i = 1, size(codes)
         do j = 1, i - 1
            call suite%check(codes(i) /= codes(j) .and. code_text(codes(i)) /= code_text(codes(j)), "codes differ")
         end do
      end do
   end subroutine texts
end program test_library_tables
