!> Tables of creep forces: splines along axes, coordinates of creepages, symmetries, the bound, files, damaged files
program test_creep_table
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_fortran_env, only : int32, int64, real32, real64
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_tables_axis, only : find_basis, make_axis, order, spline_axis
   use contact_tables_creep_table, only : creep_table, find_creep_force, lookup_status, scaled_creepages, values_per_node
   use contact_tables_table_file, only : read_table
   use contact_test_harness, only : test_suite
   use contact_text_sha256, only : sha256
   implicit none (type, external)
   real(wp), parameter :: fn = 70.0e3_wp, mu = 0.3_wp, gg = 82.0e3_wp, aa = 6.0_wp, bb = 5.0_wp
   !> Coefficients are 32 bit numbers
   real(wp), parameter :: short = 2.0e-6_wp
   real(wp), parameter :: knots_xy(10) = [-1.0_wp, -1.0_wp, -1.0_wp, -1.0_wp, -0.3_wp, 0.3_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp], &
      & knots_z(8) = [-0.5_wp, -0.3_wp, -0.2_wp, 0.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp], &
      & knots_shape(8) = [-1.0_wp, -1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp]
   type(test_suite) :: suite

   call suite%start("creep_table")
   call splines(suite)
   call places(suite)
   call symmetries(suite)
   call the_bound(suite)
   call refusals(suite)
   call magnitudes(suite)
   call files(suite)
   call wrong_heads(suite)
   call suite%finish()

contains

   !> Basis functions add up to 1, with no slope; with coefficients at the means of knots they are the argument
   subroutine splines(suite)
      type(test_suite), intent(inout) :: suite
      type(spline_axis) :: axis
      real(wp) :: value(order), slope(order), place, worst(4)
      integer :: first, k
      logical :: is_good

      call make_axis(axis, 6, knots_xy, is_good)
      call suite%check(is_good, "an axis is made")
      worst = 0.0_wp
      do k = 0, 200
         place = -1.0_wp + 0.01_wp*k
         call find_basis(axis, place, first, value, slope)
         worst(1) = max(worst(1), abs(sum(value) - 1.0_wp))
         worst(2) = max(worst(2), abs(sum(slope)))
         associate (means => [(sum(knots_xy(first + k:first + k + 2))/3.0_wp, k=1, order)])
            worst(3) = max(worst(3), abs(sum(value*means) - place))
            worst(4) = max(worst(4), abs(sum(slope*means) - 1.0_wp))
         end associate
      end do
      call suite%check(all(worst < 1.0e-13_wp), "splines of degree 1 are exact")
      call make_axis(axis, 6, knots_xy(size(knots_xy):1:-1), is_good)
      call suite%check(.not. is_good, "knots that decrease are refused")
   end subroutine splines

   !> A table with f = (p x, p y, p z)
   subroutine make_table(table, p)
      type(creep_table), intent(out) :: table
      real(wp), intent(in) :: p
      integer :: i, j, k, s, n
      logical :: is_good

      table%band = 0.01_wp
      call make_axis(table%shape, 4, knots_shape, is_good)
      call make_axis(table%x, 6, knots_xy, is_good)
      call make_axis(table%y, 6, knots_xy, is_good)
      call make_axis(table%z, 4, knots_z, is_good)
      allocate(table%coefficients(values_per_node*4*6*6*4))
      n = 0
      do s = 1, 4
         do i = 1, 6
            do j = 1, 6
               do k = 1, 4
                  table%coefficients(n + 1:n + 3) = real(p/3.0_wp*[sum(knots_xy(i + 1:i + 3)), &
                     & sum(knots_xy(j + 1:j + 3)), sum(knots_z(k + 1:k + 3))], real32)
                  n = n + values_per_node
               end do
            end do
         end do
      end do
   end subroutine make_table

   !> Forces by the formulas of the module, and derivatives by differences
   subroutine places(suite)
      type(test_suite), intent(inout) :: suite
      type(creep_table) :: table
      real(wp) :: creep(3), force(3), slopes(3, 3), u(3), v(2), factor(3), expected(3), c, q, step(3), one(3), two(3)
      integer :: j, status

      call make_table(table, -0.5_wp)
      creep = [0.001_wp, -0.002_wp, 0.0003_wp]
      call find_creep_force(table, fn, mu, gg, aa, bb, bb, creep, force, status, slopes)
      c = sqrt(aa*bb)
      q = gg*aa*bb/(mu*fn)
      factor = q*scaled_creepages(aa/bb)*[1.0_wp, 1.0_wp, c]
      u = factor*creep
      ! sliding turns round (-eta/phi, xi/phi): where that is the end of a semi-axis, u1 or u2 over u3
      v = u(:2)/sqrt(1.0_wp + (factor(:2)*[bb, aa]/factor(3)*u(3))**2)
      expected(:2) = v/((v(1)**4 + v(2)**4)**0.25_wp + 1.0_wp)
      expected(3) = u(3)/(1.0_wp + u(3))
      expected = -0.5_wp*mu*fn*[1.0_wp, 1.0_wp, c]*expected
      call suite%equal(status, lookup_status%inside, "within the table")
      call suite%check(all(abs(force - expected) < short*mu*fn*c), "forces follow the formulas")
      step = 1.0e-6_wp/factor
      do j = 1, 3
         one = creep
         two = creep
         one(j) = one(j) - step(j)
         two(j) = two(j) + step(j)
         call find_creep_force(table, fn, mu, gg, aa, bb, bb, one, expected, status)
         call find_creep_force(table, fn, mu, gg, aa, bb, bb, two, force, status)
         call suite%check(all(abs((force - expected)/(2.0_wp*step(j)) - slopes(:, j)) < 1.0e-8_wp*mu*fn*c*factor(j)), &
            & "derivatives are those of differences")
      end do
      call find_creep_force(table, fn, mu, gg, aa, bb, bb, [0.0_wp, 0.0_wp, 0.0_wp], force, status, slopes)
      call suite%check(all(abs(force) < short*mu*fn), "no creepage, no force")
      ! KX and KY follow Kalker's coefficients for a circle and a Poisson ratio of 1/4
      associate (scales => scaled_creepages(1.0_wp))
         call suite%check(all(abs(scales/[4.12_wp/3, 3.67_wp/3, 1.47_wp] - 1.0_wp) < 0.05_wp), "scales are Kalker's coefficients")
      end associate
   end subroutine places

   !> Mirror images and signs, exactly
   subroutine symmetries(suite)
      type(test_suite), intent(inout) :: suite
      type(creep_table) :: table
      real(wp) :: creep(3), force(3), other(3), slopes(3, 3)
      integer :: status

      call make_table(table, -0.5_wp)
      creep = [0.0007_wp, 0.002_wp, -0.0003_wp]
      call find_creep_force(table, fn, mu, gg, aa, bb, bb, creep, force, status, slopes)
      call find_creep_force(table, fn, mu, gg, aa, bb, bb, -creep, other, status, slopes)
      call suite%check(all(other == -force), "all creepages turned over turn all forces over")
      call find_creep_force(table, fn, mu, gg, aa, bb, bb, creep*[1, -1, -1], other, status, slopes)
      call suite%check(all(other == force*[1, -1, -1]), "the mirror image changes the signs of lateral force and moment")
   end subroutine symmetries

   !> Forces stay below mu Fn, up to infinite creepages, with a continuous slope where the bound acts
   subroutine the_bound(suite)
      type(test_suite), intent(inout) :: suite
      type(creep_table) :: table
      real(wp) :: force(3), slopes(3, 3), before(3), unit, at, largest, gap, old
      integer :: k, status

      call make_table(table, -1.3_wp)
      unit = mu*fn/(gg*aa*bb)
      largest = 0.0_wp
      gap = 0.0_wp
      do k = 1, 4000
         at = unit*1.0e-3_wp*k
         call find_creep_force(table, fn, mu, gg, aa, bb, bb, [at, 0.0_wp, 0.0_wp], force, status, slopes)
         largest = max(largest, norm2(force(:2)))
         if (k > 1) gap = max(gap, abs(slopes(1, 1) - old))
         before = force
         old = slopes(1, 1)
      end do
      call suite%check(largest <= mu*fn, "forces are never above mu Fn")
      call suite%check(largest > 0.999_wp*mu*fn, "they reach it")
      ! over a band of 0.02 mu Fn the slope decreases to zero, in steps and not at once
      call suite%check(gap < 0.1_wp*mu*fn/unit, "the slope is continuous at the bound")
      call find_creep_force(table, fn, mu, gg, aa, bb, bb, [1.0e30_wp, -1.0e300_wp, 1.0e200_wp], force, status, slopes)
      call suite%check(all(abs(force(:2)) <= mu*fn) .and. all(abs(slopes) < huge(unit)), "endless creepages have forces")
   end subroutine the_bound

   !> Arguments without a contact are reported, and give no forces
   subroutine refusals(suite)
      type(test_suite), intent(inout) :: suite
      type(creep_table) :: table
      real(wp) :: force(3), slopes(3, 3), creep(3)
      integer :: status

      call make_table(table, -0.5_wp)
      creep = [0.001_wp, 0.0_wp, 0.0_wp]
      call find_creep_force(table, fn, mu, gg, 30.0_wp, bb, bb, creep, force, status, slopes)
      call suite%check(status == lookup_status%outside .and. force(1) < 0.0_wp, "a shape outside the table is reported")
      call find_creep_force(table, fn, mu, gg, aa, 0.9_wp*bb, 1.1_wp*bb, creep, force, status, slopes)
      call suite%equal(status, lookup_status%outside, "half ellipses in a table of ellipses are reported")
      call find_creep_force(table, fn, mu, gg, aa, bb, -bb, creep, force, status, slopes)
      call suite%check(status == lookup_status%invalid .and. all(abs(force) <= 0.0_wp), "a negative length is refused")
      creep(2) = ieee_value(1.0_wp, ieee_quiet_nan)
      call find_creep_force(table, fn, mu, gg, aa, bb, bb, creep, force, status, slopes)
      call suite%check(status == lookup_status%invalid .and. all(abs(force) <= 0.0_wp), "NaN is refused")
      call find_creep_force(table, -1.0_wp, mu, gg, aa, bb, bb, [1.0_wp, 0.0_wp, 0.0_wp], force, status, slopes)
      call suite%check(status == lookup_status%inside .and. all(abs(force) <= 0.0_wp), "no normal force, no forces")
   end subroutine refusals

   !> Numbers of all magnitudes: finite forces below mu Fn and finite slopes, or refused
   subroutine magnitudes(suite)
      type(test_suite), intent(inout) :: suite
      !> Decades of numbers: those of contacts, all that is accepted, all that exist
      real(wp), parameter :: decades(3) = [6.0_wp, 40.0_wp, 308.0_wp]
      integer, parameter :: rounds = 20000
      type(creep_table) :: table
      real(wp) :: draw(9), sign_(9), value(9), force(3), slopes(3, 3), bound
      integer :: answers(0:2), k, status, wrong
      integer, allocatable :: seed(:)

      call random_seed(size=k)
      allocate(seed(k), source=20261127)
      call random_seed(put=seed)
      call make_table(table, -1.3_wp)
      answers = 0
      wrong = 0
      do k = 1, rounds
         call random_number(draw)
         call random_number(sign_)
         value = 10.0_wp**((2.0_wp*draw - 1.0_wp)*decades(1 + modulo(k, 3)))
         where (sign_ < 0.1_wp) value = 0.0_wp
         ! lengths and modulus without a sign
         where (sign_ > 0.6_wp .and. [1, 1, 0, 0, 0, 0, 1, 1, 1] == 1) value = -value
         if (sign_(1) < 0.01_wp) value(1) = 1.0e-310_wp
         call find_creep_force(table, value(1), value(2), value(3), value(4), value(5), value(6), value(7:9), force, status, slopes)
         answers(status) = answers(status) + 1
         bound = 0.0_wp
         if (status /= lookup_status%invalid) bound = max(value(1), 0.0_wp)*max(value(2), 0.0_wp)
         if (.not. (all(abs(force) <= huge(bound)) .and. all(abs(slopes) <= huge(bound)) .and. &
            & all(abs(force(:2)) <= bound))) wrong = wrong + 1
      end do
      call suite%check(all(answers > rounds/20), "all answers occur")
      call suite%equal(wrong, 0, "forces and slopes are finite, forces below mu Fn")
      ! an unloading contact: q overflows, and there is no creepage
      call find_creep_force(table, 1.0e-310_wp, mu, gg, aa, bb, bb, [0.0_wp, 0.0_wp, 0.0_wp], force, status, slopes)
      call suite%check(status == lookup_status%inside .and. all(abs(slopes) < huge(bound)), "a load that underflows has forces")
   end subroutine magnitudes

   !> Heads that no program writes, with the right checksum: refused, not used
   subroutine wrong_heads(suite)
      type(test_suite), intent(inout) :: suite
      !> Coefficients along the axes whose product is 0 modulo 2**64
      integer, parameter :: many = 8192
      type(creep_table) :: table
      character(len=:), allocatable :: content, changed
      real(real64) :: knots(many + order)
      integer :: k

      call make_table(table, -0.5_wp)
      call make_content(table, content)
      do k = 17, 36, 4
         changed = content
         changed(k:k + 3) = transfer(-1_int32, changed(1:4))
         call refuse(suite, changed, "a negative number of coefficients, or kind of table, is refused")
      end do
      changed = content
      changed(17:20) = transfer(3_int32, changed(1:4))
      call refuse(suite, changed, "an unknown kind of table is refused")
      do k = 57, 113, 8
         changed = content
         changed(k:k + 7) = transfer(ieee_value(1.0_real64, ieee_quiet_nan), changed(1:8))
         call refuse(suite, changed, "a property that is not a number is refused")
      end do
      knots = [(1.0e-4_real64*k, k=1, size(knots))]
      changed = content(:128) // repeat(bytes_of(knots), 5) // repeat(" ", 64)
      changed(17:48) = transfer([1_int32, [(int(many, int32), k=1, 5)], 9_int32, 2_int32], changed(1:32))
      changed(49:56) = transfer(int(len(changed), int64), changed(1:8))
      call refuse(suite, changed, "numbers of coefficients with a product that overflows are refused")
      ! knots one after the other, of which the first intervals cannot be divided
      changed = content
      changed(129:192) = bytes_of(1.0e-312_real64*[1, 2, 3, 4, 5, 6, 7, 8])
      call refuse(suite, changed, "knots without a distance are refused")
   end subroutine wrong_heads

   !> Check that bytes, with their checksum corrected, are refused
   subroutine refuse(suite, bytes, what)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: bytes, what
      type(creep_table) :: table
      type(error_type), allocatable :: error

      call put("wrong.table", bytes(:len(bytes) - 64) // sha256(bytes(:len(bytes) - 64)))
      call read_table("wrong.table", table, error)
      call suite%check(allocated(error), what)
   end subroutine refuse

   !> A file is read; one with another byte, cut off, or of another kind is refused in one sentence
   subroutine files(suite)
      type(test_suite), intent(inout) :: suite
      type(creep_table) :: table, original
      type(error_type), allocatable :: error
      character(len=:), allocatable :: content
      real(wp) :: force(3), slopes(3, 3), expected(3)
      integer :: k, status

      call make_table(original, -0.5_wp)
      call make_content(original, content)
      call put("good.table", content)
      call read_table("good.table", table, error)
      call suite%check(.not. allocated(error), "a file is read")
      call find_creep_force(table, fn, mu, gg, aa, bb, bb, [0.001_wp, 0.002_wp, 0.0003_wp], force, status, slopes)
      call find_creep_force(original, fn, mu, gg, aa, bb, bb, [0.001_wp, 0.002_wp, 0.0003_wp], expected, status, slopes)
      call suite%check(all(force == expected), "it has the forces of the table that was written")
      do k = 1, len(content), len(content)/40
         call put("bad.table", content(:k - 1) // achar(ieor(iachar(content(k:k)), 16)) // content(k + 1:))
         call read_table("bad.table", table, error)
         call suite%check(allocated(error), "a byte that was changed is noticed")
      end do
      call put("bad.table", content(:len(content)/2))
      call read_table("bad.table", table, error)
      call suite%check(index(error%message, "damaged") > 0, "half a file is damaged")
      call put("bad.table", "something else")
      call read_table("bad.table", table, error)
      call suite%check(index(error%message, "too short") > 0, "something else is refused")
      call read_table("absent.table", table, error)
      call suite%check(index(error%message, "absent.table") > 0, "a file that is not there is named")
      ! knots that decrease, with the right checksum
      content(129:136) = content(137:144)
      content(137:144) = transfer(-5.0_real64, content(1:8))
      content = content(:len(content) - 64)
      content = content // sha256(content)
      call put("bad.table", content)
      call read_table("bad.table", table, error)
      call suite%check(index(error%message, "invalid") > 0, "a file of something else is refused")
   end subroutine files

   !> The bytes of a table
   subroutine make_content(table, content)
      type(creep_table), intent(in) :: table
      character(len=:), allocatable, intent(out) :: content
      character(len=:), allocatable :: body
      integer :: k

      body = bytes_of([knots_shape, knots_xy, knots_xy, knots_z])
      do k = 1, size(table%coefficients), values_per_node
         body = body // transfer(table%coefficients(k:k + 2), repeat(" ", 12))
      end do
      content = "CONTACT table 2" // new_line("a") // transfer([1_int32, 4_int32, 1_int32, 6_int32, 6_int32, 4_int32, 9_int32, &
         & 2_int32], repeat(" ", 32)) // transfer(int(128 + len(body) + 64, int64), repeat(" ", 8)) // bytes_of([0.28_wp, 0.01_wp, &
         & 0.0_wp, 0.0_wp, 0.0_wp, 0.01_wp, 0.0_wp, 0.0_wp, 0.0_wp]) // body
      content = content // sha256(content)
   end subroutine make_content

   pure function bytes_of(values) result(text)
      real(real64), intent(in) :: values(:)
      character(len=8*size(values)) :: text

      text = transfer(values, text)
   end function bytes_of

   subroutine put(file, content)
      character(len=*), intent(in) :: file, content
      integer :: unit

      open(newunit=unit, file=file, access="stream", form="unformatted", status="replace", action="write")
      write(unit) content
      close(unit)
   end subroutine put
end program test_creep_table
