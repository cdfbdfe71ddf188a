!> Influence coefficients from files (C = 9): half-space coefficients that were written to a file must give the
!> solution of half-spaces; files that cannot be used
program test_coefficient_files
   use contact_base_choices, only : kernel_model, motion, solver_choice, time_link
   use contact_base_error, only : error_type, full_text
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : part_source
   use contact_elastic_compliance, only : compliance
   use contact_elastic_halfspace, only : fill_table, kernel_table
   use contact_elastic_material, only : combine, combined_material
   use contact_elastic_model, only : elastic_model
   use contact_elastic_new_compliance, only : new_compliance
   use contact_test_case_builder, only : creep, grid_case, random_numbers, shift, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   character(len=*), parameter :: file = "coefficients.txt"
   integer, parameter :: mx = 17, my = 13
   real(wp), parameter :: dx = 0.12_wp, dy = 0.16_wp
   !> Poisson ratios and moduli of bodies that differ
   real(wp), parameter :: poiss(2) = [0.1_wp, 0.45_wp], gg(2) = [150.0_wp, 400.0_wp]
   type(test_suite) :: suite

   call suite%start("files of influence coefficients")
   call same_solutions(suite)
   call products(suite)
   call direct_sums(suite)
   call single_element(suite)
   call other_sizes(suite)
   call refusals(suite)
   call finish_file()
   call suite%finish()

contains

   !> Write half-space coefficients for a window, the same for each matrix
   subroutine write_file(nx, ny, matrices, side, captions)
      integer, intent(in) :: nx, ny, matrices
      real(wp), intent(in), optional :: side
      !> Lines before each offset in y; default 2
      integer, intent(in), optional :: captions
      type(combined_material) :: material
      type(kernel_table) :: t
      integer :: unit, matrix, k, l, i, n
      real(wp) :: width

      n = 2
      if (present(captions)) n = captions
      width = dx
      if (present(side)) width = side
      material = combine(poiss, gg)
      call fill_table(t, material, width, dy, nx, ny)
      open(newunit=unit, file=file, status="replace", action="write")
      write(unit, "(a, i0, a)") " ", matrices, " 1  % nmatrix, iaconvex"
      write(unit, "(a)") " 0 312", " 1 0"
      write(unit, "(2i6, 2f12.6)") nx, ny, width, dy
      do matrix = 1, matrices
         if (matrices > 1) then
            write(unit, "(a)") "% matrix"
            write(unit, "(i0, a)") matrix, " 0.0 0.0"
         end if
         do l = -ny + 1, ny - 1
            do i = 1, n
               write(unit, "(a)") merge("% offset", "offset  ", i == 1)
            end do
            do k = 0, nx - 1
               write(unit, "(i0, f9.4, 9es25.16)") k, k*width, material%gg*[t%nn(k, l), -t%xn(k, l), -t%yn(k, l), &
                  & t%xn(k, l), t%xx(k, l), t%xy(k, l), t%yn(k, l), t%xy(k, l), t%yy(k, l)]
            end do
         end do
      end do
      close(unit)
   end subroutine write_file

   subroutine finish_file()
      integer :: unit, status
      open(newunit=unit, file=file, iostat=status)
      close(unit, status="delete", iostat=status)
   end subroutine finish_file

   subroutine set_case(case)
      type(test_case), intent(inout) :: case

      case%spec = grid_case(0.02_wp, 0.03_wp, 12.0_wp, mx, my, dx, dy, eps=1.0e-10_wp)
      case%spec%material%poiss = poiss
      case%spec%material%gg = gg
      case%spec%iteration%maxout = 40
      case%spec%grid%xl = -0.9_wp
   end subroutine set_case

   !> Shift, transient and steady rolling to both sides
   subroutine same_solutions(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case, flat
      character(len=*), parameter :: name(5) = [character(len=24) :: "shift", "steady to the right", "steady to the left", &
         & "transient to the right", "transient to the left"]
      integer :: matrices, k
      real(wp) :: scale

      do matrices = 1, my, my - 1
         call write_file(mx, my, matrices)
         do k = 1, size(name)
            call set_case(flat)
            select case (k)
            case (1); call shift(flat%spec, 0.004_wp, -0.002_wp, 0.3_wp)
            case (2, 3); call creep(flat%spec, motion%steady_rolling, 3.0e-3_wp, -2.0e-3_wp, 1.0e-3_wp, 0.3_wp)
            case default; call creep(flat%spec, motion%transient_rolling, 3.0e-3_wp, -2.0e-3_wp, 1.0e-3_wp, 0.3_wp)
            end select
            flat%spec%rolling%dq = dx
            if (k == 3 .or. k == 5) flat%spec%rolling%chi = acos(-1.0_wp)
            case%spec = flat%spec
            case%spec%kernel = kernel_model%tabulated
            case%spec%material%cfname = file
            call flat%run(suite, "half-spaces, " // trim(name(k)))
            call case%run(suite, "file, " // trim(name(k)))
            if (k >= 4) then
               ! a second step, from loaded bodies
               flat%spec%link = time_link%continue_all
               case%spec%link = time_link%continue_all
               flat%spec%parts%grid = part_source%kept
               case%spec%parts%grid = part_source%kept
               call flat%run(suite, "half-spaces, second step, " // trim(name(k)))
               call case%run(suite, "file, second step, " // trim(name(k)))
            end if
            scale = maxval(flat%result%pn)
            call suite%check(flat%result%ncon > 40 .and. flat%result%ncon < 200, trim(name(k)) // ": contact inside the window")
            call suite%equal(case%result%ncon, flat%result%ncon, trim(name(k)) // ": elements in contact")
            call suite%close_to(maxval(abs(case%result%pn - flat%result%pn))/scale, 0.0_wp, 1.0e-7_wp, &
               & trim(name(k)) // ": pressure")
            call suite%close_to(max(maxval(abs(case%result%px - flat%result%px)), &
               & maxval(abs(case%result%py - flat%result%py)))/scale, 0.0_wp, 1.0e-6_wp, trim(name(k)) // ": shear")
            call case%release()
            call flat%release()
         end do
      end do
   end subroutine same_solutions

   !> A classical solver is replaced
   subroutine products(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      integer :: warnings

      call write_file(mx, my, 1, captions=0)
      call set_case(case)
      call creep(case%spec, motion%steady_rolling, 3.0e-3_wp, mu=0.3_wp)
      case%spec%kernel = kernel_model%tabulated
      case%spec%material%cfname = file
      case%spec%solver = solver_choice%gauss_seidel
      call case%run(suite, "G = 3")
      call suite%check(case%result%tangential%asked == "SteadyGS", "the default solver is used, which is reported")
      warnings = case%log%warnings
      case%spec%classical = .true.
      call case%run(suite, "G = 3, classical")
      ! those of the first run, and one that the solver is another one
      call suite%equal(case%log%warnings, 2*warnings + 1, "a warning that the solver is another one")
      call case%release()
   end subroutine products

   !> Random coefficients, a slice for each row, against direct sums on a part of the window
   subroutine direct_sums(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: nx = 6, ny = 5, rows = 8, start = 2
      type(elastic_model) :: model
      class(compliance), allocatable :: operator
      type(random_numbers) :: random
      real(wp) :: p(nx, ny, 3), u(nx, ny, 3), moved(nx, ny, 3), got(nx, ny, 2), one(nx, ny)
      integer :: slices, direction, i, j, b, k, l, s, ix, iy, jx, jy, m

      do slices = 1, rows, rows - 1
         if (allocated(model%tabulated)) deallocate(model%tabulated)
         allocate(model%tabulated)
         model%tabulated%nx = nx
         model%tabulated%ny = rows - 1
         model%tabulated%fingerprint = slices
         model%tabulated%y_first = -1.0_wp
         allocate(model%tabulated%c(0:nx, -rows + 1:rows - 1, 9, slices))
         do s = 1, slices
            do b = 1, 9
               do l = -rows + 1, rows - 1
                  do k = 0, nx
                     model%tabulated%c(k, l, b, s) = random%uniform(-1.0_wp, 1.0_wp)
                  end do
               end do
               if (mod(b, 2) == 0) model%tabulated%c(0, :, b, s) = 0.0_wp
            end do
         end do
         do i = 1, 3
            do iy = 1, ny
               do ix = 1, nx
                  p(ix, iy, i) = random%uniform(-1.0_wp, 1.0_wp)
               end do
            end do
         end do
         do direction = -1, 1, 2
            call new_compliance(model, operator)
            call operator%prepare(model, dx, dy, nx, ny, direction, -1.0_wp + start*dy)
            call operator%normal(p(:, :, 1), one)
            u = 0.0_wp
            moved = 0.0_wp
            ! displacements by the pressures first
            do m = 1, 2
               do b = 1, 9
                  i = (b - 1)/3 + 1
                  j = b - 3*(i - 1)
                  if ((j == 1) .neqv. (m == 1)) cycle
                  do jy = 1, ny
                     s = merge(jy + start, 1, slices > 1)
                     do iy = 1, ny
                        do jx = 1, nx
                           do ix = 1, nx
                              k = ix - jx
                              u(ix, iy, i) = u(ix, iy, i) + entry_of(model, k, iy - jy, b, s)*p(jx, jy, j)
                              moved(ix, iy, i) = moved(ix, iy, i) + (entry_of(model, k, iy - jy, b, s) &
                                 & - entry_of(model, k + direction, iy - jy, b, s))*p(jx, jy, j)
                           end do
                        end do
                     end do
                  end do
               end do
               if (m == 1) then
                  call suite%close_to(maxval(abs(one - u(:, :, 1))), 0.0_wp, 1.0e-12_wp, "normal by normal")
                  call operator%tangential_by_normal(p(:, :, 1), got)
                  call suite%close_to(maxval(abs(got - u(:, :, 2:))), 0.0_wp, 1.0e-12_wp, "tangential by normal")
                  call operator%steady_by_normal(p(:, :, 1), got)
                  call suite%close_to(maxval(abs(got - moved(:, :, 2:))), 0.0_wp, 1.0e-12_wp, "steady by normal")
               else
                  call operator%normal_by_tangential(p(:, :, 2:), one)
                  call suite%close_to(maxval(abs(one - u(:, :, 1))), 0.0_wp, 1.0e-12_wp, "normal by tangential")
                  call operator%tangential(p(:, :, 2:), got)
                  call suite%close_to(maxval(abs(got - u(:, :, 2:))), 0.0_wp, 1.0e-12_wp, "tangential")
                  call operator%steady(p(:, :, 2:), got)
                  call suite%close_to(maxval(abs(got - moved(:, :, 2:))), 0.0_wp, 1.0e-12_wp, "steady")
               end if
               u = 0.0_wp
               moved = 0.0_wp
            end do
            call suite%check(.not. (operator%has_table() .or. operator%can_coarsen()), "no table, no coarse grid")
            call operator%release()
         end do
      end do
   end subroutine direct_sums

   !> Coefficient at any offset: blocks with an even number are odd in x
   pure real(wp) function entry_of(model, k, l, b, s) result(c)
      type(elastic_model), intent(in) :: model
      !> Offsets in x and y, block, slice
      integer, intent(in) :: k, l, b, s

      c = model%tabulated%c(abs(k), l, b, s)
      if (k < 0 .and. mod(b, 2) == 0) c = -c
   end function entry_of

   !> A window of one element, one row, one column
   subroutine single_element(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      integer, parameter :: shapes(2, 3) = reshape([1, 1, 7, 1, 1, 7], [2, 3])
      integer :: k

      do k = 1, 3
         call write_file(shapes(1, k), shapes(2, k), 1)
         case%spec = grid_case(0.02_wp, 0.03_wp, 1.0_wp, shapes(1, k), shapes(2, k), dx, dy, eps=1.0e-8_wp)
         case%spec%material%poiss = poiss
         case%spec%material%gg = gg
         case%spec%iteration%maxout = 40
         call creep(case%spec, motion%steady_rolling, 1.0e-3_wp, mu=0.3_wp)
         case%spec%kernel = kernel_model%tabulated
         case%spec%material%cfname = file
         call case%run(suite, "narrow window")
         call suite%close_to(case%result%fn, 1.0_wp, 1.0e-6_wp, "force of a narrow window")
         call case%release()
      end do
   end subroutine single_element

   !> Larger files give the same, with a warning; smaller ones another solution, with a warning
   subroutine other_sizes(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      real(wp) :: approach(3)
      integer :: k, nx(3)

      nx = [mx, mx + 4, mx - 9]
      do k = 1, 3
         call write_file(nx(k), my + nx(k) - mx, 1)
         call set_case(case)
         ! inside the window, so that there are no other warnings
         case%spec%kinematics%fn = 6.0_wp
         case%spec%grid%xl = -1.02_wp
         case%spec%kernel = kernel_model%tabulated
         case%spec%material%cfname = file
         case%log%warnings = 0
         call case%run(suite, "file of another size")
         approach(k) = case%result%pen
         call suite%check((case%log%warnings > 0) .eqv. (k > 1), "warning when sizes differ")
         call case%release()
      end do
      call suite%close_to(approach(2), approach(1), 1.0e-10_wp, "surplus is ignored", relative=.true.)
      call suite%check(approach(3) < 0.95_wp*approach(1), "missing values are 0")
   end subroutine other_sizes

   subroutine refusals(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: case
      type(error_type), allocatable :: error

      call write_file(mx, my, 1)
      call refused(suite, 1, "2 1", "NMATRIX = 2 cannot be used; accepted is 1, or MY = 13")
      call refused(suite, 1, "1 3", "IACONVEX = 3 cannot be used; accepted is 1 or 2")
      call refused(suite, 2, "1 312", "LQUASID = 1")
      call refused(suite, 2, "0 123", "XYZORDER = 123 cannot be used; accepted is 312")
      call refused(suite, 3, "0 0", "LSYMMX = 0")
      call refused(suite, 3, "1 1", "LSYMMY = 1")
      call refused(suite, 4, "17 13 0.12003 0.16", "DXFILE = 0.12003 mm cannot be used; accepted is DX = 0.12 mm")
      call refused(suite, 4, "17 13 0.12 0.2", "DYFILE = 0.2")
      call refused(suite, 4, "0 13 0.12 0.16", "MXFILE = 0")
      call refused(suite, 4, "17 13 nan 0.16", "is not a finite number")
      call refused(suite, 4, "17 12 0.12 0.16", "after the last coefficients")
      call refused(suite, 4, "17 14 0.12 0.16", "the end of the file is reached; expected IXOFS")
      call refused(suite, 7, "0 0 1 2 1e300 4 5 6 7 8 9", "7:9: CZY = 1e300 is above its upper bound 1.00000E+12 mm")
      call refused(suite, 7, "0 0 1 2 NaN 4 5 6 7 8 9", '7:9: "NaN" is not a finite number')
      call refused(suite, 7, "0 0 1 2 x 4 5 6 7 8 9", '7:9: "x" is not')
      call refused(suite, 7, "nan 0 1 2 3 4 5 6 7 8 9", '7:1: "nan" is not')
      call refused(suite, 7, "0 0 1 2 3 4 5 6 7 8", "has 10 numbers; expected IXOFS")
      call refused(suite, 7, "0 0 1 2 3 4 5 6 7 8 9 10", "has 12 numbers")
      call refused(suite, 7, "0 0 1", "is not the heading that comes here")
      call refused(suite, 7, "0 0 1e9 0 0 0 1 0 0 0 1", "CZZ = ")
      call refused(suite, 7, "caption", "the end of the file is reached")
      call refused(suite, 1, "", "NMATRIX = 0 cannot be used")

      call set_case(case)
      case%spec%kernel = kernel_model%tabulated
      call case%try(error)
      call says(suite, error, "need the name of a file")
      case%spec%material%cfname = "no/such/file.txt"
      call case%try(error)
      call says(suite, error, "the file cannot be opened")
      case%spec%material%cfname = file
      call creep(case%spec, motion%steady_rolling, 1.0e-3_wp, mu=0.3_wp)
      case%spec%rolling%chi = 0.5_wp
      call case%try(error)
      call says(suite, error, "rolling along x only")
      case%spec%motion = motion%transient_rolling
      case%spec%rolling%chi = 0.0_wp
      case%spec%rolling%dq = 0.5_wp*dx
      call case%try(error)
      call says(suite, error, "steps of one element")
      call case%release()
   end subroutine refusals

   !> One line of the file is replaced
   subroutine refused(suite, line, words, phrase)
      type(test_suite), intent(inout) :: suite
      integer, intent(in) :: line
      character(len=*), intent(in) :: words, phrase
      character(len=*), parameter :: changed = "coefficients_changed.txt"
      type(test_case) :: case
      type(error_type), allocatable :: error
      character(len=400) :: text
      integer :: from, to, status, k

      open(newunit=from, file=file, status="old", action="read")
      open(newunit=to, file=changed, status="replace", action="write")
      k = 0
      do
         read(from, "(a)", iostat=status) text
         if (status /= 0) exit
         k = k + 1
         if (k == line) text = words
         write(to, "(a)") trim(text)
      end do
      close(from)
      close(to)
      call set_case(case)
      case%spec%kernel = kernel_model%tabulated
      case%spec%material%cfname = changed
      call case%try(error)
      call says(suite, error, phrase)
      call case%release()
      open(newunit=to, file=changed)
      close(to, status="delete")
   end subroutine refused

   subroutine says(suite, error, phrase)
      type(test_suite), intent(inout) :: suite
      type(error_type), allocatable, intent(in) :: error
      character(len=*), intent(in) :: phrase

      call suite%check(allocated(error), "refused: " // phrase)
      if (allocated(error)) call suite%check(index(full_text(error), phrase) > 0, "says '" // phrase // "': " // full_text(error))
   end subroutine says
end program test_coefficient_files
