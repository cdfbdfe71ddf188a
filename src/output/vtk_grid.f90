!> A structured grid as a VTK file: points in space, and arrays on its points or cells as raw binary data
module contact_output_vtk_grid
   use contact_base_error, only : error_type
   use contact_base_kinds, only : long, wp
   use contact_base_limits, only : case_limits
   use contact_output_finished_file, only : finished_file
   implicit none (type, external)
   private

   public :: finish_grid, put, start_grid, vtk_grid

   !> A VTK file being written: the head has the offsets of the arrays that follow it
   type :: vtk_grid
      type(finished_file) :: file
      character(len=:), allocatable :: head
      !> Number of points in each direction
      integer :: points(3) = 0
      logical :: on_cells = .true.
      !> All arrays one after the other, and the number of values in use
      real(wp), allocatable :: numbers(:)
      integer :: used = 0
      !> Offset of the next array [bytes]
      integer(long) :: offset = 0
      !> Length of each array
      integer, allocatable :: lengths(:)
   end type vtk_grid

contains

   !> Begin a structured grid
   subroutine start_grid(grid, points, on_cells, size_of_all)
      !> The file being written
      type(vtk_grid), intent(inout) :: grid
      !> Number of points in each of the three directions
      integer, intent(in) :: points(3)
      !> Do the arrays belong to cells? Otherwise to points
      logical, intent(in) :: on_cells
      !> Upper bound of the total length of all arrays
      integer, intent(in) :: size_of_all
      character(len=120) :: extent

      grid%points = points
      grid%on_cells = on_cells
      allocate(grid%numbers(size_of_all), grid%lengths(0))
      write(extent, "(5(I0, 1X), I0)") 0, points(1) - 1, 0, points(2) - 1, 0, points(3) - 1
      grid%head = '<?xml version="1.0"?>' // new_line("a") // '<VTKFile type="StructuredGrid" version="1.0" byte_order="' &
         & // byte_order() // '" header_type="UInt64">' // new_line("a") // '<StructuredGrid WholeExtent="' // trim(extent) &
         & // '">' // new_line("a") // '<Piece Extent="' // trim(extent) // '">' // new_line("a") &
         & // merge("<CellData> ", "<PointData>", on_cells) // new_line("a")
   end subroutine start_grid

   !> Byte order of this machine
   pure function byte_order() result(name)
      character(len=12) :: name
      character(len=1) :: bytes(4)

      bytes = transfer(1, bytes)
      name = merge("LittleEndian", "BigEndian   ", iachar(bytes(1)) == 1)
   end function byte_order

   !> Add an array
   subroutine put(grid, name, components, values)
      !> The file being written
      type(vtk_grid), intent(inout) :: grid
      !> Name with its unit
      character(len=*), intent(in) :: name
      !> Number of components per point or cell
      integer, intent(in) :: components
      !> All values, components of a point or cell together
      real(wp), intent(in) :: values(:)
      character(len=120) :: rest

      write(rest, "(A, I0, A, I0, A)") '" NumberOfComponents="', components, '" format="appended" offset="', grid%offset, '"/>'
      grid%head = grid%head // '<DataArray type="Float64" Name="' // name // trim(rest) // new_line("a")
      grid%numbers(grid%used + 1:grid%used + size(values)) = values
      grid%used = grid%used + size(values)
      grid%lengths = [grid%lengths, size(values)]
      grid%offset = grid%offset + 8_long*(1_long + size(values, kind=long))
   end subroutine put

   !> Add the points and write the file
   subroutine finish_grid(grid, name, points, error, limits)
      !> The file being written
      type(vtk_grid), intent(inout) :: grid
      !> Name of the file
      character(len=*), intent(in) :: name
      !> x, y, z of all points [mm]
      real(wp), intent(in) :: points(:)
      !> Allocated if the file cannot be written
      type(error_type), allocatable, intent(out) :: error
      type(case_limits), intent(in) :: limits
      integer :: first, k

      grid%head = grid%head // trim(merge("</CellData> ", "</PointData>", grid%on_cells)) // new_line("a") // "<Points>" &
         & // new_line("a")
      call put(grid, "Points", 3, points)
      grid%head = grid%head // "</Points>" // new_line("a") // "</Piece>" // new_line("a") // "</StructuredGrid>" &
         & // new_line("a") // '<AppendedData encoding="raw">' // new_line("a") // "_"
      call grid%file%start(name, error, limits)
      if (allocated(error)) return
      call grid%file%bytes(grid%head)
      first = 0
      do k = 1, size(grid%lengths)
         call grid%file%bytes(transfer(8_long*grid%lengths(k), "12345678"))
         call grid%file%bytes(grid%numbers(first + 1:first + grid%lengths(k)))
         first = first + grid%lengths(k)
      end do
      call grid%file%line(new_line("a") // "</AppendedData>" // new_line("a") // "</VTKFile>")
      call grid%file%finish(error)
   end subroutine finish_grid
end module contact_output_vtk_grid
