!> Names, columns and order of the .subs file
program test_subs_file
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_output_finished_file, only : case_file_name
   use contact_output_subs_file, only : write_subs_file
   use contact_patch_result, only : patch_result
   use contact_test_harness, only : test_suite
   use output_sample, only : fill_sample, numbers_on, read_lines, text_line
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("output subs file")
   call suite%equal(case_file_name("dir/run", 1, "subs", 0, 1, 0), "dir/run.0001.subs", "first case")
   call suite%equal(case_file_name("run", 9999, "subs", 0, 1, 0), "run.9999.subs", "four digits")
   call suite%equal(case_file_name("run", 10000, "subs", 0, 1, 0), "run.010000.subs", "six digits")
   call suite%equal(case_file_name("run", 1000000, "subs", 0, 1, 0), "run.subs", "no number")
   call suite%equal(case_file_name("run", 12, "subs", 3, 1, 0), "run_re003.0012.subs", "result element")
   call check_contents()
   call suite%finish()

contains

   subroutine check_contents()
      type(case_spec) :: spec
      type(patch_result) :: result
      type(error_type), allocatable :: error
      type(text_line), allocatable :: lines(:)
      real(wp), allocatable :: values(:)
      integer :: level, columns, block, i, ix, iy, iz, n
      logical :: there

      call fill_sample(spec, result, 12, 10)
      call write_subs_file("none.subs", spec, result, error)
      inquire(file="none.subs", exist=there)
      call suite%check(.not. there .and. .not. allocated(error), "no blocks: no file")

      allocate(result%subsurface(2))
      do block = 1, 2
         associate (points => result%subsurface(block))
            points%nx = 3
            points%ny = block
            points%nz = 2
            n = points%nx*points%ny*points%nz
            allocate(points%position(3, n), points%displacement(3, n), points%stress(6, n), points%sighyd(n), &
               & points%sigvm(n), source=0.0_wp)
            i = 0
            do iz = 1, points%nz
               do iy = 1, points%ny
                  do ix = 1, points%nx
                     i = i + 1
                     points%position(:, i) = [0.2_wp*real(ix - 2, wp), 0.1_wp*real(iy, wp), 1.0e-6_wp*real(iz, wp)]
                     points%stress(:, i) = -612.34_wp
                  end do
               end do
            end do
            points%sigvm = 201.55_wp
         end associate
      end do

      do level = 1, 2
         columns = merge(8, 14, level == 1)
         spec%subsurface%matfil = level
         call write_subs_file("sample.subs", spec, result, error)
         call suite%check(.not. allocated(error), "the file is written")
         call read_lines("sample.subs", lines)
         call suite%equal(size(lines), 3 + 6 + 3 + 12, "number of lines")
         do i = 1, size(lines)
            if (lines(i)%text(1:1) == "%") cycle
            call suite%equal(size(numbers_on(lines(i)%text)), columns, "number of columns")
         end do
         values = numbers_on(lines(2)%text)
         call suite%close_to(values(1:4), [3.0_wp, 1.0_wp, 2.0_wp, 0.0_wp], 0.0_wp, "sizes of the first block")
         values = numbers_on(lines(11)%text)
         call suite%close_to(values(1:3), [3.0_wp, 2.0_wp, 2.0_wp], 0.0_wp, "sizes of the second block")
         values = numbers_on(lines(14)%text)
         call suite%close_to(values(1:3), [0.0_wp, 0.1_wp, 1.0e-6_wp], 1.0e-12_wp, "x runs fastest")
         values = numbers_on(lines(16)%text)
         call suite%close_to(values(1:3), [-0.2_wp, 0.2_wp, 1.0e-6_wp], 1.0e-12_wp, "then y")
         values = numbers_on(lines(24)%text)
         call suite%close_to(values(1:3), [0.2_wp, 0.2_wp, 2.0e-6_wp], 1.0e-12_wp, "z last")
         call suite%close_to(values(8), 201.55_wp, 1.0e-12_wp, "equivalent stress")
         if (level == 2) call suite%close_to(values(14), -612.34_wp, 1.0e-12_wp, "stress component")
      end do
      call suite%equal(lines(13)%text(1:36), "   -0.200000    0.100000  1.0000E-06", "format of the points")
   end subroutine check_contents
end program test_subs_file
