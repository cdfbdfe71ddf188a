!> Blocks of points below the surface
module contact_subsurface_points
   use contact_base_kinds, only : long, wp
   use contact_grid_potential_contact, only : potential_contact
   implicit none (type, external)
   private

   public :: point_selection, point_block, point_set, expand_points, list_points
   public :: stepped_depth, stepped_points

   type :: point_selection_list
      !> Centres of all elements
      integer :: all_elements = 1
      !> Centres of the elements in regular ranges of columns and rows
      integer :: ranges = 2
      !> Centres of the elements in lists of columns and rows
      integer :: lists = 3
      !> Coordinates independent of the grid
      integer :: free = 9
   end type point_selection_list
   !> Ways to select x and y; the depths are always a list
   type(point_selection_list), parameter :: point_selection = point_selection_list()

   !> Request for a block of points: the product of sets of x, y and z
   type :: point_block
      !> Member of point_selection
      integer :: selection = 1
      !> First, increment and last of columns and rows, for ranges; clipped to the grid
      integer :: ixl = 1, ixinc = 1, ixh = huge(1), iyl = 1, iyinc = 1, iyh = huge(1)
      !> Columns and rows, for lists, in any order; those outside the grid are ignored
      integer, allocatable :: ix(:), iy(:)
      !> Coordinates [mm], for free points, in any order
      real(wp), allocatable :: x(:), y(:)
      !> Depths [mm], positive in body 1, in any order
      real(wp), allocatable :: z(:)
   end type point_block

   !> All points of the product of three lists of x, y and z
   type :: point_set
      !> Coordinates [mm], ascending
      real(wp), allocatable :: x(:), y(:), z(:)
   contains
      !> Number of points
      procedure :: n => number_of_points
   end type point_set

contains

   !> The coordinates of a block, clipped to the grid and sorted
   !>
   !> Repeated columns and rows count once; repeated coordinates are kept.
   pure subroutine expand_points(block, grid, points)
      !> Coordinates as given
      type(point_block), intent(in) :: block
      !> Potential contact whose centres a block may refer to
      type(potential_contact), intent(in) :: grid
      !> Sorted coordinates, and columns and rows for centres of elements
      type(point_set), intent(out) :: points

      select case (block%selection)
      case (point_selection%free)
         call sort_into(points%x, block%x)
         call sort_into(points%y, block%y)
      case (point_selection%lists)
         points%x = grid%x(chosen(block%ix, grid%mx))
         points%y = grid%y(chosen(block%iy, grid%my))
      case (point_selection%ranges)
         points%x = grid%x(range_within(block%ixl, block%ixinc, block%ixh, grid%mx))
         points%y = grid%y(range_within(block%iyl, block%iyinc, block%iyh, grid%my))
      case default
         points%x = grid%x(range_within(1, 1, grid%mx, grid%mx))
         points%y = grid%y(range_within(1, 1, grid%my, grid%my))
      end select
      call sort_into(points%z, block%z)
   end subroutine expand_points

   !> Positions of all points, x fastest, then y, then z
   pure subroutine list_points(points, position)
      !> Sorted coordinates
      type(point_set), intent(in) :: points
      !> Points [mm], shape (3, number of points)
      real(wp), contiguous, intent(out) :: position(:, :)
      integer :: ix, iy, iz, n

      n = 0
      do iz = 1, size(points%z)
         do iy = 1, size(points%y)
            do ix = 1, size(points%x)
               n = n + 1
               position(:, n) = [points%x(ix), points%y(iy), points%z(iz)]
            end do
         end do
      end do
   end subroutine list_points

   !> Depth above which the jumps of the tractions between elements affect points that are not at centres [mm]
   elemental real(wp) function stepped_depth(grid) result(depth)
      !> Centres and sides of the elements
      type(potential_contact), intent(in) :: grid

      depth = 0.25_wp*grid%dx
   end function stepped_depth

   !> Number of points within the grid that are above this depth and not at centres of elements; 0 for an empty grid
   pure integer function stepped_points(points, grid) result(n)
      !> Sorted coordinates
      type(point_set), intent(in) :: points
      !> Centres and sides of the elements
      type(potential_contact), intent(in) :: grid
      integer :: inside(2), off(2), near

      near = count(abs(points%z) < stepped_depth(grid))
      n = 0
      if (near == 0) return
      call sort_out(points%x, grid%xl, grid%dx, grid%mx, inside(1), off(1))
      call sort_out(points%y, grid%yl, grid%dy, grid%my, inside(2), off(2))
      n = near*(inside(1)*inside(2) - (inside(1) - off(1))*(inside(2) - off(2)))

   contains

      !> Number of coordinates within the grid, and number of these that are not at centres
      pure subroutine sort_out(values, low, step, m, inside, off)
         real(wp), intent(in) :: values(:), low, step
         integer, intent(in) :: m
         integer, intent(out) :: inside, off
         !> Distance from a centre that is treated as zero, relative to the element side
         real(wp), parameter :: at_centre = 0.01_wp
         real(wp) :: place
         integer :: k

         inside = 0
         off = 0
         do k = 1, size(values)
            place = (values(k) - low)/step
            if (.not. (place >= 0.0_wp .and. place < m)) cycle
            inside = inside + 1
            if (abs(place - floor(place) - 0.5_wp) > at_centre) off = off + 1
         end do
      end subroutine sort_out
   end function stepped_points

   !> Number of points of a set
   elemental integer(long) function number_of_points(self) result(n)
      class(point_set), intent(in) :: self

      n = size(self%x, kind=long)*size(self%y, kind=long)*size(self%z, kind=long)
   end function number_of_points

   !> Values first, first + increment, ... up to last that are within 1...m
   pure function range_within(first, increment, last, m) result(numbers)
      !> Ends of the range and increment; increments below 1 mean 1
      integer, intent(in) :: first, increment, last
      !> Largest value allowed
      integer, intent(in) :: m
      integer, allocatable :: numbers(:)
      integer :: i, step, start

      step = max(1, increment)
      start = first
      ! the smallest member of the range that is at least 1
      if (first < 1) start = first + step*((step - first)/step)
      numbers = [(i, i = start, min(last, m), step)]
   end function range_within

   !> Members of a list that are within 1...m, ascending and without repetition
   pure function chosen(list, m) result(numbers)
      !> Values in any order; unallocated: none
      integer, allocatable, intent(in) :: list(:)
      !> Largest value allowed
      integer, intent(in) :: m
      integer, allocatable :: numbers(:)
      logical :: wanted(m)
      integer :: i

      wanted = .false.
      if (allocated(list)) then
         do i = 1, size(list)
            if (list(i) >= 1 .and. list(i) <= m) wanted(list(i)) = .true.
         end do
      end if
      numbers = pack([(i, i = 1, m)], wanted)
   end function chosen

   !> Values in ascending order, by insertion
   pure subroutine sort_into(sorted, list)
      real(wp), allocatable, intent(out) :: sorted(:)
      !> Values in any order; unallocated: none
      real(wp), allocatable, intent(in) :: list(:)
      real(wp) :: value
      integer :: i, j

      if (.not. allocated(list)) then
         allocate(sorted(0))
         return
      end if
      allocate(sorted, source=list)
      do i = 2, size(sorted)
         value = sorted(i)
         do j = i - 1, 1, -1
            if (sorted(j) <= value) exit
            sorted(j + 1) = sorted(j)
         end do
         sorted(j + 1) = value
      end do
   end subroutine sort_into
end module contact_subsurface_points
