!> Names, columns and values of the .mat file
program test_mat_file
   use contact_base_constants, only : excluded_distance
   use contact_base_error, only : error_kind, error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_output_finished_file, only : case_file_name
   use contact_output_mat_file, only : write_mat_file
   use contact_patch_result, only : patch_result
   use contact_test_harness, only : test_suite
   use output_sample, only : fill_sample, numbers_on, read_lines, text_line
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("output mat file")
   call suite%equal(case_file_name("dir/run", 1, "mat", 0, 1, 0), "dir/run.0001.mat", "first case")
   call suite%equal(case_file_name("run", 9999, "mat", 0, 1, 0), "run.9999.mat", "four digits")
   call suite%equal(case_file_name("run", 10000, "mat", 0, 1, 0), "run.10000.mat", "five digits")
   call suite%equal(case_file_name("run", 1234567, "mat", 0, 1, 0), "run.1234567.mat", "seven digits")
   call suite%equal(case_file_name("run", 1, "mat", 2, 1, 0), "run_re002.0001.mat", "result element")
   call suite%equal(case_file_name("run", 1, "mat", 2, 3, 0), "run_re002_cp3.0001.mat", "contact problem")
   call suite%equal(case_file_name("run", 1, "mat", 0, 1, 2), "run.0001b.mat", "contact patch")
   call check_contents()
   call check_failures()
   call check_plasticity()
   call suite%finish()

contains

   subroutine check_contents()
      type(case_spec) :: spec
      type(patch_result) :: result
      type(error_type), allocatable :: error
      type(text_line), allocatable :: lines(:)
      real(wp), allocatable :: values(:)
      integer :: level, law, model, i
      integer, parameter :: laws(5) = [0, 2, 3, 4, 6], models(4) = [0, 1, 2, 4]

      do level = 1, 2
         do law = 1, size(laws)
            do model = 1, size(models)
               call fill_sample(spec, result, 12, 10)
               spec%mat_file = level
               spec%friction_law = laws(law)
               spec%material_model = models(model)
               spec%motion = 3
               result%motion = spec%motion
               spec%kinematics%spinxo = 0.5_wp
               spec%rolling%veloc = 5000.0_wp
               result%chi = 3.14_wp
               result%h(1, 1) = excluded_distance
               call write_mat_file("sample.mat", spec, result, result%status, error)
               call suite%check(.not. allocated(error), "the file is written")
               call read_lines("sample.mat", lines)
               call suite%equal(size(lines), 13 + merge(120, result%ncon, level == 2), "number of lines")
               do i = 1, size(lines)
                  if (lines(i)%text(1:1) == "%") then
                     call suite%check(i <= 13 .and. mod(i, 2) == 1, "names on every other line of the head")
                  else
                     call suite%equal(size(numbers_on(lines(i)%text)), 11, "number of columns")
                  end if
               end do
            end do
         end do
      end do

      values = numbers_on(lines(2)%text)
      call suite%equal(nint(values(11)), 2410, "number of the format in the last column")
      values = numbers_on(lines(6)%text)
      call suite%close_to(values(10:11), [0.5_wp, 0.0_wp], 1.0e-12_wp, "spin centre")
      values = numbers_on(lines(8)%text)
      call suite%close_to(values, [12.0_wp, 10.0_wp, -1.2_wp, -1.2_wp, 0.2_wp, 0.24_wp, 3.14_wp, 0.2_wp, 0.0_wp, 2.0_wp, &
         & 0.0_wp], 1.0e-12_wp, "grid")
      values = numbers_on(lines(12)%text)
      call suite%close_to(values(1:4), [6.0_wp, 0.0_wp, 5000.0_wp, 0.3_wp], 1.0e-12_wp, "law, heat, velocity, friction")
      values = numbers_on(lines(14)%text)
      call suite%close_to(values(3), excluded_distance, 1.0e-6_wp, "excluded element", relative=.true.)
      values = numbers_on(lines(13 + 52)%text)
      call suite%close_to(values, [52.0_wp, 2.0_wp, result%h(4, 5), 0.3_wp, result%pn(4, 5), 0.0_wp, result%py(4, 5), 0.0_wp, &
         & 0.0_wp, 0.0_wp, 2.0e-4_wp], 1.0e-3_wp, "element with number ix + mx (iy - 1); relative slip")
      call suite%check(index(lines(13)%text, "SREL") > 0, "relative slip in rolling")

      spec%motion = 1
      result%motion = spec%motion
      call write_mat_file("sample.mat", spec, result, result%status, error)
      call read_lines("sample.mat", lines)
      values = numbers_on(lines(8)%text)
      call suite%close_to(values(7:8), [0.0_wp, 1.0_wp], 1.0e-12_wp, "CHI and DQ have no meaning in shifts")
      call suite%check(index(lines(13)%text, "SHFT") > 0, "shift distance")

      result%division = 0
      spec%mat_file = 1
      call write_mat_file("sample.mat", spec, result, result%status, error)
      call read_lines("sample.mat", lines)
      call suite%equal(size(lines), 13, "no contact: no elements")
   end subroutine check_contents

   !> No incomplete file; data that do not fit the layout of this version are refused
   subroutine check_failures()
      type(case_spec) :: spec
      type(patch_result) :: result
      type(error_type), allocatable :: error
      logical :: there

      call fill_sample(spec, result, 12, 10)
      call write_mat_file("no_such_folder/sample.mat", spec, result, result%status, error)
      call suite%check(allocated(error), "a missing folder is an error")
      if (allocated(error)) call suite%equal(error%kind, error_kind%file, "kind of the error")
      inquire(file="sample.mat.tmp", exist=there)
      call suite%check(.not. there, "no temporary file remains")
   end subroutine check_failures

   !> Three more columns where the surface yields
   subroutine check_plasticity()
      type(case_spec) :: spec
      type(patch_result) :: result
      type(error_type), allocatable :: error
      type(text_line), allocatable :: lines(:)
      real(wp), allocatable :: values(:)
      integer :: i

      call fill_sample(spec, result, 12, 10)
      spec%mat_file = 2
      spec%material_model = 4
      spec%material%tau_c0 = 560.0_wp
      allocate(result%tau_c(12, 10), source=570.0_wp)
      allocate(result%uplx(12, 10), result%uply(12, 10), source=-0.25_wp)
      result%uplx(2, 1) = 0.5_wp
      call write_mat_file("plastic.mat", spec, result, result%status, error)
      call suite%check(.not. allocated(error), "plasticity: the file is written")
      call read_lines("plastic.mat", lines)
      do i = 1, size(lines)
         if (lines(i)%text(1:1) == "%") cycle
         call suite%equal(size(numbers_on(lines(i)%text)), 14, "plasticity: number of columns")
      end do
      values = numbers_on(lines(2)%text)
      call suite%close_to(values(14), 2410.0_wp, 0.0_wp, "plasticity: number of the layout in the last column")
      call suite%check(index(lines(13)%text, "TAUCRT        UPLSX         UPLSY") > 0, "plasticity: names")
      values = numbers_on(lines(15)%text)
      call suite%close_to(values(12:14), [570.0_wp, 0.5_wp, -0.25_wp], 0.0_wp, "plasticity: limit and displacements")
   end subroutine check_plasticity
end program test_mat_file
