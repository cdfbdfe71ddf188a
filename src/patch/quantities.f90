!> Totals and element fields with name, unit, meaning and sign: the lists that all outputs use
!>
!> Each list is written once, beside the values: totals of a patch and fields in contact_patch_result, totals of wheel and rail in
!> contact_wheelrail_result.
module contact_patch_quantities
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: element_field, error_law, error_scale, is_lateral, orientation, total, total_list

   type :: orientation_list
      !> Independent of the body and of the side of the track
      integer :: none = 0
      !> Along the track: the sign depends on the body
      integer :: along = 1
      !> Across the track, and rotation about x and z: the sign depends on body and side
      integer :: across = 2
      !> The sign depends on the side of the track only
      integer :: side = 3
   end type orientation_list
   !> Sign convention of a quantity; internal values refer to body 1 of a pair on the right side
   type(orientation_list), parameter :: orientation = orientation_list()

   type :: error_law_list
      !> No estimate: prescribed, a number of elements, or not investigated
      integer :: none = 0
      !> Determined by the pressures; relative to its own value
      integer :: normal = 1
      !> Force, moment or ratio determined by the tangential tractions; relative to its error_scale
      integer :: friction = 2
      !> Creepage or shift determined by prescribed forces; relative to the larger one of both
      integer :: creepage = 3
      !> Frictional power; relative to its own value
      integer :: power = 4
      !> Maximum of a field at centres of elements; relative to its own value
      integer :: peak = 5
      !> Area, a number of whole elements; relative to its own value
      integer :: area = 6
      !> Elastic energy of all tractions; relative to its own value
      integer :: energy = 7
      !> Maximum stress below the surface, see contact_cases_stress_errors; relative to its own value
      integer :: stress = 8
   end type error_law_list
   !> Law of the error of a total, see contact_patch_error_estimate
   type(error_law_list), parameter :: error_law = error_law_list()

   type :: error_scale_list
      !> Its own value, or that of its law
      integer :: own = 0
      !> Maximum frictional force, maximum frictional moment
      integer :: force = 1
      integer :: moment = 2
      !> Ratio of a force to the maximum frictional force: 1
      integer :: ratio = 3
   end type error_scale_list
   !> Reference value of the relative error of a total that tangential tractions determine
   type(error_scale_list), parameter :: error_scale = error_scale_list()

   !> One total
   type :: total
      !> Name in JSON and HDF5
      character(len=16) :: name = ""
      !> Unit; "-" for a ratio, "" for a number of elements or trials
      character(len=8) :: unit = ""
      !> Meaning
      character(len=104) :: meaning = ""
      real(wp) :: value = 0.0_wp
      !> Member of orientation
      integer :: along = orientation%none
      !> Is it an integer?
      logical :: is_count = .false.
      !> Heading of its column in the .out file, after the maximum pressure; blank: none
      character(len=12) :: heading = ""
      !> Is it written to JSON and HDF5?
      logical :: in_files = .true.
      !> Member of error_law
      integer :: law = error_law%none
      !> Member of error_scale
      integer :: scale = error_scale%own
   end type total

   !> Totals in the order in which they are written
   type :: total_list
      !> Rows; the first `length` of them are in use
      type(total), allocatable :: rows(:)
      integer :: length = 0
      !> Only check that all values are finite, without storing rows? Then no memory is allocated
      logical :: only_judges = .false.
      !> Are all values finite?
      logical :: is_finite = .true.
      !> Do the values refer to the left side of the track?
      logical, private :: left = .false.
   contains
      !> Make the list empty
      procedure :: start
      !> Add a real number; one that tangential tractions determine; an integer
      procedure :: add
      procedure :: add_friction
      procedure :: count
      !> Index of the row with a given name, and values by name
      procedure :: place_of
      procedure :: of
   end type total_list

   !> Description of an element field
   type :: element_field
      !> Name in HDF5; in upper case in the .mat and .out files
      character(len=8) :: name = ""
      !> Unit, "-" for a ratio
      character(len=8) :: unit = ""
      !> Meaning
      character(len=48) :: meaning = ""
      !> Number of the field in the library, CNTC_fld_NAME
      integer :: code = 0
      !> Member of orientation
      integer :: along = orientation%none
      !> Values times `divisor`, shape (mx, my); null: the case does not have this field
      real(wp), pointer :: values(:, :) => null()
      real(wp) :: divisor = 1.0_wp
      !> Is it identically zero because the bodies do not move?
      logical :: is_zero = .false.
      !> Is it written to files?
      logical :: in_files = .true.
      !> Name in VTK files; blank: not written
      character(len=24) :: label = ""
      !> Significant digits in the table of the .out file; 0: not written
      integer :: figures = 0
   contains
      !> Is it written to a file that omits fields that are zero?
      procedure :: is_written
   end type element_field

   !> Initial capacity of the list
   integer, parameter :: usual_rows = 40

contains

   !> Does the sign depend on the side of the track?
   elemental logical function is_lateral(along)
      !> Member of orientation
      integer, intent(in) :: along

      is_lateral = along == orientation%across .or. along == orientation%side
   end function is_lateral

   pure logical function is_written(self)
      class(element_field), intent(in) :: self

      is_written = associated(self%values) .and. self%in_files .and. .not. self%is_zero
   end function is_written

   !> Make the list empty
   pure subroutine start(self, left)
      class(total_list), intent(inout) :: self
      !> Shall values refer to the left side of the track? Otherwise, and by default, to its mirror image
      logical, intent(in), optional :: left

      if (.not. (allocated(self%rows) .or. self%only_judges)) allocate(self%rows(usual_rows))
      self%length = 0
      self%is_finite = .true.
      self%left = .false.
      if (present(left)) self%left = left
   end subroutine start

   !> Add a real number
   pure subroutine add(self, name, unit, meaning, value, along, heading, in_files, law)
      class(total_list), intent(inout) :: self
      !> See total
      character(len=*), intent(in) :: name, unit, meaning
      !> Value on body 1 of a pair on the right side
      real(wp), intent(in) :: value
      !> Member of orientation; default none
      integer, intent(in), optional :: along
      !> See total
      character(len=*), intent(in), optional :: heading
      !> Is it written to files? Default yes
      logical, intent(in), optional :: in_files
      !> Member of error_law; default none
      integer, intent(in), optional :: law
      type(total), allocatable :: longer(:)

      self%is_finite = self%is_finite .and. ieee_is_finite(value)
      if (self%only_judges) return
      if (self%length == size(self%rows)) then
         allocate(longer(2*self%length))
         longer(:self%length) = self%rows
         call move_alloc(longer, self%rows)
      end if
      self%length = self%length + 1
      self%rows(self%length) = total(name, unit, meaning, value)
      associate (row => self%rows(self%length))
         if (present(along)) row%along = along
         if (self%left .and. is_lateral(row%along)) row%value = -value
         if (present(heading)) row%heading = heading
         if (present(in_files)) row%in_files = in_files
         if (present(law)) row%law = law
      end associate
   end subroutine add

   !> Add a force, moment or ratio that tangential tractions determine, with error_law%friction
   pure subroutine add_friction(self, name, unit, meaning, value, along, scale)
      class(total_list), intent(inout) :: self
      !> See total
      character(len=*), intent(in) :: name, unit, meaning
      !> Value on body 1 of a pair on the right side
      real(wp), intent(in) :: value
      !> Members of orientation and of error_scale
      integer, intent(in) :: along, scale

      call self%add(name, unit, meaning, value, along, law=error_law%friction)
      if (.not. self%only_judges) self%rows(self%length)%scale = scale
   end subroutine add_friction

   !> Add an integer
   pure subroutine count(self, name, meaning, value)
      class(total_list), intent(inout) :: self
      !> See total
      character(len=*), intent(in) :: name, meaning
      !> Number of elements, trials or the like
      integer, intent(in) :: value

      call self%add(name, "", meaning, real(value, wp))
      if (.not. self%only_judges) self%rows(self%length)%is_count = .true.
   end subroutine count

   !> Index of the row with a given name; of the last row if there is none
   pure integer function place_of(self, name, guess) result(k)
      class(total_list), intent(in) :: self
      !> Name of a row, see total
      character(len=*), intent(in) :: name
      !> Probable index: that of the row in the list of a similar case
      integer, intent(in), optional :: guess

      if (present(guess)) then
         k = min(guess, self%length)
         if (self%rows(k)%name == name) return
      end if
      do k = 1, self%length - 1
         if (self%rows(k)%name == name) return
      end do
   end function place_of

   !> Values by name
   pure function of(self, names) result(values)
      class(total_list), intent(in) :: self
      !> Names of rows, see total, in any order
      character(len=*), intent(in) :: names(:)
      real(wp) :: values(size(names))
      integer :: k

      do k = 1, size(names)
         values(k) = self%rows(self%place_of(names(k)))%value
      end do
   end function of
end module contact_patch_quantities
