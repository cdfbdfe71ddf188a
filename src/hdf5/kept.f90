!> Groups and fields of previous cases: if the next case has the same content, the object on disk is linked again
module contact_hdf5_kept
   use hdf5, only : h5olink_f, hid_t, hsize_t
   use contact_base_kinds, only : wp
   use contact_hdf5_container, only : hdf5_container
   use contact_hdf5_values, only : same_number, value_list, write_array
   implicit none (type, external)
   private

   public :: kept_list, kept_object

   !> A group or a field on disk that can be linked
   type :: kept_object
      !> Path within a case, such as "1.1/patch_1/fields/pn", after the name of the contact problem
      character(len=:), allocatable :: place
      !> Identifier of the open object; -1 before the first is written
      integer(hid_t) :: id = -1
      !> Values and shape of a field
      real(wp), allocatable :: values(:)
      integer(hsize_t), allocatable :: dims(:)
      !> Open scales of its dimensions
      integer(hid_t), allocatable :: scales(:)
      !> Content of a group
      type(value_list), allocatable :: group
   contains
      !> Link the object into another group
      procedure :: link
      !> Is it an array with these values and scales?
      procedure :: holds
   end type kept_object

   !> All objects
   type :: kept_list
      type(kept_object), allocatable :: objects(:)
      integer, private :: count = 0
      !> Index of the last one found, since objects come in the same order in each case
      integer, private :: last = 0
   contains
      procedure :: find
      procedure :: replace
      !> Write an array, or link that of the previous case if it is equal
      procedure :: write
      procedure :: release
   end type kept_list

contains

   !> Find the object of a path, or add a new one
   subroutine find(self, place, k)
      class(kept_list), intent(inout) :: self
      !> See kept_object
      character(len=*), intent(in) :: place
      !> Index in `objects`
      integer, intent(out) :: k
      type(kept_object), allocatable :: longer(:)
      integer :: i

      do i = 0, self%count - 1
         k = modulo(self%last + i, self%count) + 1
         if (self%objects(k)%place /= place) cycle
         self%last = k
         return
      end do
      if (.not. allocated(self%objects)) allocate(self%objects(50))
      if (self%count == size(self%objects)) then
         allocate(longer(2*self%count))
         do i = 1, self%count
            longer(i)%id = self%objects(i)%id
            call move_alloc(self%objects(i)%place, longer(i)%place)
            call move_alloc(self%objects(i)%values, longer(i)%values)
            call move_alloc(self%objects(i)%dims, longer(i)%dims)
            call move_alloc(self%objects(i)%scales, longer(i)%scales)
            call move_alloc(self%objects(i)%group, longer(i)%group)
         end do
         call move_alloc(longer, self%objects)
      end if
      self%count = self%count + 1
      k = self%count
      self%objects(k)%place = place
      self%last = k
   end subroutine find

   !> Link the object into a group
   subroutine link(self, container, group, name)
      class(kept_object), intent(in) :: self
      type(hdf5_container), intent(inout) :: container
      !> Open group
      integer(hid_t), intent(in) :: group
      !> Name of the object in the group
      character(len=*), intent(in) :: name
      integer :: status

      call h5olink_f(self%id, group, name, status)
      call container%check(status)
   end subroutine link

   !> Is the object an array of this shape with the same values?
   pure logical function holds(self, values, dims, scales)
      class(kept_object), intent(in) :: self
      !> All values in their order
      real(wp), intent(in) :: values(:)
      !> Extents, the slowest index first
      integer(hsize_t), intent(in) :: dims(:)
      !> Open scales of the dimensions
      integer(hid_t), intent(in) :: scales(:)

      holds = .false.
      if (.not. allocated(self%values)) return
      if (.not. all(self%dims == dims)) return
      if (.not. all(self%scales == scales)) return
      holds = all(same_number(self%values, values))
   end function holds

   !> Replace an object by another one on disk
   subroutine replace(self, container, k, id)
      class(kept_list), intent(inout) :: self
      type(hdf5_container), intent(inout) :: container
      !> Index in `objects`
      integer, intent(in) :: k
      !> The new object, open
      integer(hid_t), intent(in) :: id

      if (self%objects(k)%id >= 0) call container%release(self%objects(k)%id)
      self%objects(k)%id = id
   end subroutine replace

   !> Write an array, or link that of the previous case if it is equal
   subroutine write(self, container, group, place, name, unit, title, values, dims, kind, scales, id)
      class(kept_list), intent(inout) :: self
      type(hdf5_container), intent(inout) :: container
      !> Open group
      integer(hid_t), intent(in) :: group
      !> Path of the group, see kept_object; name, unit and description of the array
      character(len=*), intent(in) :: place, name, unit, title
      !> Shape
      integer(hsize_t), intent(in) :: dims(:)
      !> All values in their order
      real(wp), intent(in), target :: values(product(dims))
      !> Datatype on disk
      integer(hid_t), intent(in) :: kind
      !> Open scales of the dimensions; empty for a scale
      integer(hid_t), intent(in) :: scales(:)
      !> The dataset, open until the next one of that name is written
      integer(hid_t), intent(out), optional :: id
      integer(hid_t) :: data
      integer :: k

      if (container%failed) return
      call self%find(place // "/" // name, k)
      associate (this => self%objects(k))
         if (this%holds(values, dims, scales)) then
            call this%link(container, group, name)
         else
            call write_array(container, group, name, unit, title, values, dims, kind, scales, data)
            this%values = values
            this%dims = dims
            this%scales = scales
            call self%replace(container, k, data)
         end if
         if (present(id)) id = this%id
      end associate
   end subroutine write

   !> Close all objects
   subroutine release(self, container)
      class(kept_list), intent(inout) :: self
      type(hdf5_container), intent(inout) :: container
      integer :: k

      do k = 1, self%count
         if (self%objects(k)%id >= 0) call container%release(self%objects(k)%id)
      end do
   end subroutine release
end module contact_hdf5_kept
