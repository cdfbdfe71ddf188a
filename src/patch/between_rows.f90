!> Details of the undeformed distance between rows of elements, and the pressures they cause
!>
!> Elements know the distance at their centres only. In a section across the contact, through the largest pressure, the distance is
!> given at several points per element as well. Details that are narrower than the contact is long deform the bodies there as in
!> plane strain. So the pressures of the section are computed once more at these points: in plane strain, with the same load per
!> length, and with the difference of the displacements from those of plane strain, which is smooth, as on the elements. See
!> doc/theory/errors.md.
module contact_patch_between_rows
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: between, cubic_weights, has_details, parts, section_details, solve_section

   !> Points of the section per element; odd, so that one is at the centre
   integer, parameter :: parts = 3
   !> Details matter if their largest height would change the largest pressure by more than this fraction of it; chosen
   real(wp), parameter :: matters = 0.003_wp
   !> Distances at the centres that differ by more than this fraction of the approach from those of the elements belong to other
   !> positions of the bodies; chosen
   real(wp), parameter :: same_place = 1.0e-3_wp
   !> Tolerance of the pressures, relative to the load, and maximum number of iterations; chosen
   real(wp), parameter :: tolerance = 1.0e-4_wp
   integer, parameter :: most_iterations = 100
   !> Contact is looked for where the distance is below the approach times this; chosen
   real(wp), parameter :: reach = 1.25_wp
   !> Distances above this are no surface [mm]: values that stand for a missing surface are larger, see excluded_distance and
   !> nothing_there
   real(wp), parameter :: far = 100.0_wp

   !> What details change in a section
   type :: section_details
      !> Is there a section with such details?
      logical :: known = .false.
      !> Largest pressure at the points [N/mm2]
      real(wp) :: peak = 0.0_wp
      !> Change of the approach [mm]
      real(wp) :: approach = 0.0_wp
      !> Pressures at the points [N/mm2]; unallocated if there is no section
      real(wp), allocatable :: p(:)
      !> Column of elements, and undeformed distance at its points [mm]; unallocated if it is not computed
      integer :: column = 0
      real(wp), allocatable :: h(:)
   end type section_details

contains

   !> Does the distance between the centres of elements deviate from a smooth curve through them by so much that pressures change?
   !>
   !> The pressure of a wave of amplitude a and length l in full contact is pi E a/l; waves that elements do not show are up to two
   !> elements long.
   pure logical function has_details(result, ix, fine)
      !> Solved patch
      type(patch_result), intent(in) :: result
      !> Column of elements
      integer, intent(in) :: ix
      !> Undeformed distance at `parts` points of each element of the column [mm], shape (parts*my)
      real(wp), intent(in) :: fine(:)
      real(wp) :: h(result%grid%my), amplitude
      integer :: i, k

      has_details = .false.
      h = result%h(ix, :)
      if (any(abs(fine((parts + 1)/2::parts) - h) > same_place*result%pen .and. h < result%pen)) return
      amplitude = 0.0_wp
      do i = 1, size(fine)
         k = row_of(i)
         if (.not. fine(i) < result%pen .or. k < 3 .or. k > result%grid%my - 2) cycle
         if (any(h(k - 2:k + 2) > far)) cycle
         amplitude = max(amplitude, abs(fine(i) - between(h, i)))
      end do
      has_details = pi*modulus(result)*amplitude/(2.0_wp*result%grid%dy) > matters*result%pmax
   end function has_details

   !> Element that contains a point
   elemental integer function row_of(i)
      !> Index of the point
      integer, intent(in) :: i

      row_of = (i + parts - 1)/parts
   end function row_of

   !> Value at a point by the cubic polynomial through the four nearest centres
   pure real(wp) function between(line, i) result(value)
      !> Values at the centres; at least four
      real(wp), intent(in) :: line(:)
      !> Index of the point
      integer, intent(in) :: i
      real(wp) :: weight(4)
      integer :: k

      call cubic_weights(0.5_wp + (i - 0.5_wp)/parts, size(line), k, weight)
      value = dot_product(weight, line(k - 1:k + 2))
   end function between

   !> Weights of the four nearest centres in the value of the cubic polynomial through them
   pure subroutine cubic_weights(at, n, k, weight)
      !> Position in elements, the first centre at 1
      real(wp), intent(in) :: at
      !> Number of centres; at least four
      integer, intent(in) :: n
      !> The second of the four centres
      integer, intent(out) :: k
      !> Weights of the centres k - 1 to k + 2 [-]
      real(wp), intent(out) :: weight(4)
      real(wp) :: t

      k = min(max(int(at), 2), n - 2)
      t = at - k
      weight = [-t*(t - 1.0_wp)*(t - 2.0_wp)/6.0_wp, (t**2 - 1.0_wp)*(t - 2.0_wp)/2.0_wp, &
         & -t*(t + 1.0_wp)*(t - 2.0_wp)/2.0_wp, t*(t**2 - 1.0_wp)/6.0_wp]
   end subroutine cubic_weights

   !> Modulus of both bodies, by Hertz's theory [N/mm2]
   pure real(wp) function modulus(result)
      type(patch_result), intent(in) :: result

      modulus = result%gg/(1.0_wp - result%nu)
   end function modulus

   !> Pressures of a section in plane strain, at several points per element
   pure subroutine solve_section(result, ix, un, fine, details)
      !> Solved patch
      type(patch_result), intent(in) :: result
      !> Column of elements
      integer, intent(in) :: ix
      !> Normal displacements of the column due to the pressures [mm], shape (my)
      real(wp), intent(in) :: un(:)
      !> See has_details
      real(wp), intent(in) :: fine(:)
      !> Pressures are set; not known where contact is not possible
      type(section_details), intent(inout) :: details
      real(wp) :: rest(size(un)), pn(size(un)), p(size(fine)), given(size(fine))
      logical :: within(size(fine))
      real(wp) :: step, load
      integer :: i, i0, i1

      details%known = .false.
      associate (grid => result%grid)
         pn = result%pn(ix, :)
         load = sum(pn)*grid%dy
         step = grid%dy/parts
         call displace(strip_kernel(modulus(result), grid%dy, size(un)), pn, rest)
         within = fine < min(reach*result%pen, far)
         rest = merge(result%pen - result%h(ix, :), un, pn > 0.0_wp) - rest
         do i = 1, size(fine)
            given(i) = fine(i) + between(rest, i)
            p(i) = merge(pn(row_of(i)), 0.0_wp, within(i))
         end do
         if (.not. (sum(p) > 0.0_wp .and. load > 0.0_wp)) return
         i0 = findloc(within, .true., dim=1)
         i1 = findloc(within, .true., dim=1, back=.true.)
         call press(strip_kernel(modulus(result), step, i1 - i0 + 1), given(i0:i1), within(i0:i1), load/step, p(i0:i1), &
            & details%approach)
         details%known = .true.
         details%p = p
         details%peak = maxval(p)
         details%approach = details%approach - result%pen
      end associate
   end subroutine solve_section

   !> Displacements in plane strain due to unit pressure on a strip, at multiples of its width [mm3/N]
   pure function strip_kernel(modulus, width, n) result(kernel)
      !> Modulus of both bodies [N/mm2]
      real(wp), intent(in) :: modulus
      !> Width of the strip [mm]
      real(wp), intent(in) :: width
      !> Number of strips
      integer, intent(in) :: n
      !> For offsets of -n to n strips
      real(wp) :: kernel(2*n + 1)
      integer :: k

      do k = 0, n
         kernel(n + 1 + k) = -2.0_wp/(pi*modulus)*(primitive((k + 0.5_wp)*width) - primitive((k - 0.5_wp)*width))
         kernel(n + 1 - k) = kernel(n + 1 + k)
      end do
   end function strip_kernel

   !> Integral of the logarithm of the absolute value
   pure real(wp) function primitive(t)
      real(wp), intent(in) :: t
      primitive = t*(log(abs(t)) - 1.0_wp)
   end function primitive

   !> Displacements due to the pressures of strips [mm]
   pure subroutine displace(kernel, p, u)
      !> See strip_kernel
      real(wp), intent(in) :: kernel(:)
      !> Pressures [N/mm2], shape (n)
      real(wp), intent(in) :: p(:)
      !> Shape (n)
      real(wp), intent(out) :: u(:)
      integer :: i, n, middle

      n = size(p)
      middle = (size(kernel) + 1)/2
      u = 0.0_wp
      do i = 1, n
         if (.not. abs(p(i)) > 0.0_wp) cycle
         u = u + p(i)*kernel(middle + 1 - i:middle + n - i)
      end do
   end subroutine displace

   !> Pressures of a given sum: p >= 0, gap >= 0 and p gap = 0, by conjugate gradients after Polonsky and Keer (1999)
   pure subroutine press(kernel, given, within, total, p, approach)
      !> See strip_kernel
      real(wp), intent(in) :: kernel(:)
      !> Undeformed distance [mm], and where contact is possible, shape (n)
      real(wp), intent(in) :: given(:)
      logical, intent(in) :: within(:)
      !> Sum of the pressures [N/mm2]
      real(wp), intent(in) :: total
      !> Estimate on entry, of positive sum
      real(wp), intent(inout) :: p(:)
      !> Approach [mm]
      real(wp), intent(out) :: approach
      real(wp), dimension(size(p)) :: gap, turned, along, before
      real(wp) :: squares, last, length, work
      integer :: iteration, n
      logical :: overlaps

      p = p*(total/sum(p))
      turned = 0.0_wp
      last = 1.0_wp
      overlaps = .true.
      approach = 0.0_wp
      do iteration = 1, most_iterations
         call displace(kernel, p, gap)
         gap = gap + given
         n = count(p > 0.0_wp)
         approach = sum(gap, mask=p > 0.0_wp)/n
         gap = gap - approach
         squares = sum(gap**2, mask=p > 0.0_wp)
         if (.not. squares > 0.0_wp) exit
         if (overlaps) turned = 0.0_wp
         turned = merge(gap + squares/last*turned, 0.0_wp, p > 0.0_wp)
         last = squares
         call displace(kernel, turned, along)
         along = along - sum(along, mask=p > 0.0_wp)/n
         work = sum(along*turned)
         if (.not. work > 0.0_wp) exit
         length = sum(gap*turned)/work
         before = p
         p = max(0.0_wp, p - length*turned)
         overlaps = any(within .and. .not. p > 0.0_wp .and. gap < 0.0_wp)
         where (within .and. .not. p > 0.0_wp .and. gap < 0.0_wp) p = -length*gap
         if (.not. sum(p) > 0.0_wp) then
            p = before
            exit
         end if
         p = p*(total/sum(p))
         if (sum(abs(p - before)) <= tolerance*total) exit
      end do
   end subroutine press
end module contact_patch_between_rows
