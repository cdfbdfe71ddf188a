!> The table of bounds: refused values and reasons, names, and the manual
program test_bounds
   use, intrinsic :: ieee_arithmetic, only : ieee_positive_inf, ieee_quiet_nan, ieee_value
   use contact_base_kinds, only : wp
   use contact_control_digit_terms, only : translate_to_digits
   use contact_text_bounds, only : bounds_of, bounds_table, describe_breach, number_bounds
   use contact_test_harness, only : test_suite
   use contact_text_words, only : real_text
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("bounds of numbers")
   call rows(suite)
   call names(suite)
   call complaints(suite)
   call what_is_meant_passes(suite)
   call manual(suite)
   call suite%finish()

contains

   !> Each row has ordered bounds, a reason and a unique name, and refuses values that are not finite
   subroutine rows(suite)
      type(test_suite), intent(inout) :: suite
      character(len=:), allocatable :: name
      integer :: k

      do k = 1, size(bounds_table)
         name = trim(bounds_table(k)%name)
         call suite%check(bounds_table(k)%lowest < bounds_table(k)%highest, name // ": order")
         call suite%check(len_trim(bounds_table(k)%reason) > 0, name // ": reason")
         call suite%check(bounds_of(name) == k, name // ": stands once")
         call expect(suite, name, ieee_value(1.0_wp, ieee_quiet_nan), "not a number")
         call expect(suite, name, ieee_value(1.0_wp, ieee_positive_inf), "not a number")
         call expect(suite, name, 1.0e300_wp, trim(bounds_table(k)%reason))
         call expect(suite, name, bounds_table(k)%highest, "")
         call expect(suite, name, bounds_table(k)%lowest, trim(merge("larger", "      ", bounds_table(k)%is_open)))
      end do
   end subroutine rows

   !> Figures, letters of bodies and indices at the end
   subroutine names(suite)
      type(test_suite), intent(inout) :: suite
      character(len=9), parameter :: given(*) = [character(len=9) :: "GG2", "GG3", "B(3)", "NOMRADW", "CDAMPT", "FLIN2", "X(17)"]
      character(len=9), parameter :: meant(*) = [character(len=9) :: "GG", "GG3", "B", "NOMRAD", "CDAMP", "FLIN", "X"]
      integer :: k

      do k = 1, size(given)
         call suite%check(bounds_of(trim(given(k))) == bounds_of(trim(meant(k))) .and. bounds_of(trim(meant(k))) > 0, given(k))
      end do
      call suite%check(bounds_of("NOSUCH") == 0, "unknown name")
      call expect(suite, "NOSUCH", 1.0_wp, "is missing in the table of bounds")
   end subroutine names

   !> Words of complaints
   subroutine complaints(suite)
      type(test_suite), intent(inout) :: suite

      call expect(suite, "GG1", 1.0e-30_wp, "GG1 = 1.00000E-30 is below its lower bound 1.00000E-05 N/mm2: ")
      call expect(suite, "POISS2", -1.0_wp, "POISS2 = -1 must be larger than -1: ")
      call expect(suite, "MAXGS", 0.0_wp, "MAXGS = 0 is outside its range 1 to 999999: ")
      call expect(suite, "CHI", 180.0_wp, "in degrees with a suffix")
   end subroutine complaints

   !> From microns to metres, rubber to rigid, slow to very fast: no realistic value is refused
   subroutine what_is_meant_passes(suite)
      type(test_suite), intent(inout) :: suite
      character(len=9), parameter :: name(*) = [character(len=9) :: "GG1", "GG1", "POISS1", "DX", "DX", "FN", "FN", "VELOC", &
         & "VELOC", "CKSI", "A1", "A1", "NOMRADW", "NOMRADW", "S_WS", "PITCH", "FSTAT", "FSTAT", "PEN", "CHI", "H", "RM", &
         & "XL1", "YTAPE", "CURV", "KZRAIL", "TC1", "BKTEMP1"]
      real(wp), parameter :: value(*) = [0.001_wp, 5.0e5_wp, -0.5_wp, 1.0e-6_wp, 1.0e3_wp, 0.0_wp, 1.0e8_wp, 1.0e-3_wp, &
         & 1.0e7_wp, -2.0_wp, 1.0e-9_wp, 1.0e4_wp, 0.01_wp, 1.0e5_wp, 1.0e9_wp, 1.0e6_wp, 1.0e-4_wp, 100.0_wp, -10.0_wp, &
         & 3.1416_wp, 1.0e30_wp, 1.0e20_wp, -1.0e30_wp, 1000.0_wp, 1.0e-4_wp, 1.0e9_wp, 1.0e4_wp, -40.0_wp]
      integer :: k

      do k = 1, size(name)
         call expect(suite, trim(name(k)), value(k), "")
      end do
   end subroutine what_is_meant_passes

   !> A complaint with these words, or none
   subroutine expect(suite, name, value, words)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: name, words
      real(wp), intent(in) :: value
      character(len=:), allocatable :: complaint

      call describe_breach(name, "", value, complaint)
      if (.not. allocated(complaint)) complaint = ""
      if (len(words) == 0) then
         call suite%check(len(complaint) == 0, name // " is accepted: " // complaint)
      else
         call suite%check(index(complaint, words) > 0, name // ": '" // complaint // "' contains '" // words // "'")
      end if
   end subroutine expect

   !> The manual lists every row: `| GG | modulus of rigidity | N/mm2 | 1.00000E-05 | 1.00000E+20 | reason |`
   subroutine manual(suite)
      type(test_suite), intent(inout) :: suite
      character(len=300) :: folder, line
      character(len=280) :: expected(size(bounds_table))
      logical, allocatable :: seen(:)
      integer :: k, status, unit

      call get_environment_variable("CONTACT_SOURCE", folder, status=status)
      if (status /= 0) folder = "."
      open(newunit=unit, file=trim(folder) // "/doc/user/input.md", status="old", action="read", iostat=status)
      call suite%check(status == 0, "doc/user/input.md is there")
      if (status /= 0) return
      allocate(seen(size(bounds_table)), source=.false.)
      do k = 1, size(bounds_table)
         expected(k) = manual_row(bounds_table(k))
      end do
      do
         read(unit, "(a)", iostat=status) line
         if (status /= 0) exit
         do k = 1, size(bounds_table)
            if (line == expected(k)) seen(k) = .true.
         end do
      end do
      close(unit)
      do k = 1, size(bounds_table)
         call suite%check(seen(k), "the manual has the row " // trim(expected(k)))
      end do
   end subroutine manual

   !> A row of the manual, which names digits
   pure function manual_row(bounds) result(row)
      type(number_bounds), intent(in) :: bounds
      character(len=280) :: row
      character(len=:), allocatable :: lowest, text

      lowest = real_text(bounds%lowest)
      if (bounds%is_open) lowest = "above " // lowest
      call translate_to_digits("| " // trim(bounds%name) // " | " // trim(bounds%title) // " | " // trim(bounds%unit) // " | " // &
         & lowest // " | " // real_text(bounds%highest) // " | " // trim(bounds%reason) // " |", text)
      row = text
   end function manual_row
end program test_bounds
