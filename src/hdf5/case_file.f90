!> A case as groups of an HDF5 file
module contact_hdf5_case_file
   use contact_base_choices, only : is_rolling
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_limits, only : case_limits
   use contact_cases_spec, only : case_spec
   use contact_hdf5_file, only : hdf5_file
   use contact_hdf5_provenance, only : provenance
   use contact_output_case_record, only : case_head, describe_head, describe_list, describe_patch, describe_run, &
      & describe_wheel_rail, run_summary, side_sign
   use contact_output_input_record, only : describe_input
   use contact_patch_quantities, only : element_field, total_list
   use contact_patch_result, only : mirrored, patch_result, subsurface_result
   use contact_profile_curve, only : profile_curve
   use contact_text_words, only : integer_text
   use contact_wheelrail_result, only : wheel_rail_patch, wheel_rail_result
   use contact_wheelrail_spec, only : profile_spec
   implicit none (type, external)
   private

   public :: hdf5_case_file

   !> The HDF5 file of an experiment
   type, extends(hdf5_file) :: hdf5_case_file
      !> Origin of the results
      type(provenance), private :: origin
   contains
      procedure :: open_file
      !> Continue after the given rows of a reopened file, or refuse it
      procedure :: go_on
      procedure :: abandon
      procedure :: close_file
      procedure :: write_case
   end type hdf5_case_file

contains

   subroutine open_file(self, name, experiment, version, input, folder, run, limits, error)
      class(hdf5_case_file), intent(inout) :: self
      !> File, experiment, version of the program
      character(len=*), intent(in) :: name, experiment, version
      !> The input file, and the folder to which names in it are relative
      character(len=*), intent(in) :: input, folder
      !> Number of planned cases
      type(run_summary), intent(in) :: run
      type(case_limits), intent(in) :: limits
      type(error_type), allocatable, intent(out) :: error
      !> The folder if files are confined to it; otherwise unallocated, which is absent in calls
      character(len=:), allocatable :: below

      call self%make_file(name, experiment, "contact " // version, error)
      if (allocated(error)) return
      if (limits%confined) below = folder
      call self%origin%start(self%container, input, folder, below)
      call write_start(self, run, error)
   end subroutine open_file

   !> Begin the run
   subroutine write_start(file, run, error)
      class(hdf5_file), intent(inout) :: file
      type(run_summary), intent(in) :: run
      type(error_type), allocatable, intent(out) :: error

      call file%open_group("")
      call describe_run(file, run)
      call file%text("reason", "", "the run continues, or was ended from outside")
      call file%close_attributes()
      call file%renew()
      if (file%container%failed) call file%finish_file(error)
   end subroutine write_start

   subroutine abandon(self)
      class(hdf5_case_file), intent(inout) :: self

      call self%origin%release(self%container)
      call self%hdf5_file%abandon()
   end subroutine abandon

   subroutine go_on(self, cases, patches, input, folder, run, limits, error)
      class(hdf5_case_file), intent(inout) :: self
      !> Number of rows that are kept
      integer, intent(in) :: cases, patches
      !> The input file, and the folder to which names in it are relative
      character(len=*), intent(in) :: input, folder
      !> Number of planned cases
      type(run_summary), intent(in) :: run
      type(case_limits), intent(in) :: limits
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: final_counts(3) = [character(len=13) :: "solved", "not_converged", "refused"]
      character(len=:), allocatable :: below
      integer :: k

      call self%cut(cases, patches, name_of)
      do k = 1, size(final_counts)
         call self%container%drop_attribute(trim(final_counts(k)))
      end do
      if (limits%confined) below = folder
      call self%origin%start_again(self%container, input, folder, below)
      call write_start(self, run, error)
   end subroutine go_on

   subroutine close_file(self, run, error)
      class(hdf5_case_file), intent(inout) :: self
      !> Write the progress of the run
      type(run_summary), intent(in) :: run
      type(error_type), allocatable, intent(out) :: error

      if (self%is_open()) then
         call self%container%drop_attribute("reason")
         call self%open_group("")
         call describe_run(self, run)
         call self%close_attributes()
      end if
      call self%origin%release(self%container)
      call self%finish_file(error)
   end subroutine close_file

   !> Write a case: its rows of /cases and /patches, and its group
   subroutine write_case(self, head, given, spec, contact, pair, rail, wheel)
      class(hdf5_case_file), intent(inout) :: self
      type(case_head), intent(in) :: head
      !> The case as given, and as solved: an accuracy chooses grid, order and tolerance; absent: there is no result
      type(case_spec), intent(in), optional :: given, spec
      !> Result of module 3
      type(patch_result), intent(in), optional :: contact
      !> Result of module 1
      type(wheel_rail_result), intent(in), optional :: pair
      !> Profiles, or sections at the first contact, in their own axes for a right-hand pair
      type(profile_curve), intent(in), optional :: rail, wheel

      if (present(pair)) then
         call note_profile(self, spec%wheel_rail%rail_profile, spec%limits)
         call note_profile(self, spec%wheel_rail%wheel_profile, spec%limits)
      end if
      call begin(self, head)
      if (present(given)) then
         call self%enter("inputs")
         call describe_input(self, given)
         call self%leave()
      end if
      if (present(contact)) call write_patch(self, head, 1, spec, contact)
      if (present(pair)) call write_pair(self, head, spec, pair, rail, wheel)
      call self%end_case(head%finished)
   end subroutine write_case

   !> Write the results of module 1
   subroutine write_pair(file, head, spec, pair, rail, wheel)
      class(hdf5_file), intent(inout) :: file
      type(case_head), intent(in) :: head
      type(case_spec), intent(in) :: spec
      type(wheel_rail_result), intent(in) :: pair
      type(profile_curve), intent(in), optional :: rail, wheel
      type(total_list) :: markers
      integer :: k

      call describe_wheel_rail(file, spec, pair)
      call pair%markers(spec%wheel_rail%left, markers)
      call describe_list(file, "markers", markers)
      call file%enter("profiles")
      if (present(rail)) call write_profile(file, "rail", spec, rail)
      if (present(wheel)) call write_profile(file, "wheel", spec, wheel)
      call file%leave()
      do k = 1, size(pair%patches)
         call write_patch(file, head, k, spec, pair%patches(k)%contact, pair%patches(k))
      end do
   end subroutine write_pair

   !> Record the origin of a profile
   subroutine note_profile(self, profile, limits)
      type(hdf5_case_file), intent(inout) :: self
      type(profile_spec), intent(in) :: profile
      !> Limits, with whether files must be below the folder of the experiment
      type(case_limits), intent(in) :: limits

      if (allocated(profile%points) .or. .not. allocated(profile%name)) return
      call self%origin%note_profile(self%container, profile%name, limits%confined)
   end subroutine note_profile

   !> Begin a case with its row of /cases
   subroutine begin(file, head)
      class(hdf5_file), intent(inout) :: file
      type(case_head), intent(in) :: head

      call file%begin_case(trim(name_of(head%number, head%result_element, head%contact_problem)), &
         & integer_text(head%result_element) // "." // integer_text(head%contact_problem))
      call file%begin_row(patch=.false.)
      call file%open_group("", columns=.true.)
      call describe_head(file, head)
      call file%close_group()
      if (head%status%is_solved()) return
      call file%open_group("status")
      call file%text("status", "how the case ended", trim(head%status%word()))
      call file%text("iteration", "what did not converge", trim(head%status%iteration_word()))
      call file%text("reason", "which iteration failed, and by how much; or why there is no result", head%status%reason)
      call file%close_group()
      if (head%status%has_result()) return
      call file%open_group("failure")
      call file%text("reason", "why there is no result", head%status%reason)
      call file%close_group()
   end subroutine begin

   !> Name of the group of a case: case_0001, with result elements re001_case_0001
   function name_of(case_number, result_element, contact_problem) result(name)
      integer, intent(in) :: case_number, result_element, contact_problem
      character(len=48) :: name

      write(name, "(A, I0.4)") "case_", case_number
      if (result_element > 0) write(name, "(A, I0.3, A, I0.4)") "re", result_element, "_case_", case_number
      if (contact_problem > 1) name = trim(name) // "_cp" // integer_text(contact_problem)
   end function name_of

   !> Write one contact patch
   subroutine write_patch(file, head, number, spec, contact, place)
      class(hdf5_file), intent(inout) :: file
      type(case_head), intent(in) :: head
      !> Number of the patch in its case
      integer, intent(in) :: number
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: contact
      !> Position of the patch, in module 1
      type(wheel_rail_patch), intent(in), optional :: place
      integer :: k

      call file%begin_row(patch=.true.)
      call file%open_group("", columns=.true.)
      call describe_head(file, head)
      call file%count("patch", "number of the patch in its case", number)
      call file%close_group()
      call file%enter("patch_" // integer_text(number))
      call describe_patch(file, spec, contact, place)
      if (allocated(contact%effects)) then
         call file%open_group("effects")
         call file%text("names", "effects that acted", contact%effects)
         call file%close_group()
      end if
      if (any(contact%flx > 0.0_wp)) then
         call file%open_group("simplified")
         call file%numbers("flx", "mm3/N", "flexibilities L1, L2, L3 of simplified theory, prescribed or computed", contact%flx)
         call file%close_group()
      end if
      if (side_sign(spec) < 0.0_wp) then
         call write_elements(file, .true., mirrored(contact), place)
      else
         call write_elements(file, .false., contact, place)
      end if
      if (present(place)) then
         if (allocated(place%curve)) call write_curve(file, spec, place)
      end if
      if (allocated(contact%subsurface)) then
         call file%enter("subsurface")
         do k = 1, size(contact%subsurface)
            call file%enter("block_" // integer_text(k))
            call write_block(file, contact%subsurface(k))
            call file%leave()
         end do
         call file%leave()
      end if
      call file%leave()
   end subroutine write_patch

   !> Write the elements and their fields
   subroutine write_elements(file, left, contact, place)
      class(hdf5_file), intent(inout) :: file
      !> Does the patch belong to a wheel on the left side of the track?
      logical, intent(in) :: left
      !> Result, in true coordinates of its side of the track
      type(patch_result), target, intent(in) :: contact
      !> Present in module 1
      type(wheel_rail_patch), intent(in), optional :: place
      type(element_field), allocatable :: rows(:)
      type(total_list) :: totals
      real(wp) :: reference(2)
      integer :: i, k

      call file%scale(1, "x_element", "mm", "centres of columns", contact%grid%x([(i, i = 1, contact%grid%mx)]))
      call file%scale(2, "y_element", "mm", "centres of rows", contact%grid%y([(i, i = 1, contact%grid%my)]))
      call file%open_group("grid")
      associate (grid => contact%grid)
         call file%count("mx", "columns", grid%mx)
         call file%count("my", "rows", grid%my)
         call file%number("xl", "mm", "edge of the first column", grid%xl)
         call file%number("yl", "mm", "edge of the first row", grid%yl)
         call file%number("dx", "mm", "length of an element", grid%dx)
         call file%number("dy", "mm", "width of an element", grid%dy)
         call file%numbers("x", "mm", "centres of columns", grid%x([(i, i = 1, grid%mx)]))
         call file%numbers("y", "mm", "centres of rows", grid%y([(i, i = 1, grid%my)]))
      end associate
      if (is_rolling(contact%motion)) then
         call file%number("chi", "rad", "rolling direction", contact%chi)
         call file%number("dq", "mm", "distance of a step", contact%dq)
      end if
      call file%number("veloc", "mm/s", "velocity", contact%veloc)
      if (present(place)) then
         call place%totals(totals, left)
         reference = totals%of(["x_elem", "y_elem"])
         call file%number("x_elem", "mm", "contact reference in the coordinates of the elements", reference(1))
         call file%number("y_elem", "mm", "contact reference in the coordinates of the elements", reference(2))
      end if
      call file%close_group()
      call file%enter("fields")
      call file%division("eldiv", "element state: 0 exterior, 1 adhesion, 2 slip, 3 plastic", contact%division)
      call contact%fields(rows)
      do k = 1, size(rows)
         if (rows(k)%is_written()) call file%field(trim(rows(k)%name), trim(rows(k)%unit), trim(rows(k)%meaning), &
            & rows(k)%values/rows(k)%divisor)
      end do
      call file%leave()
   end subroutine write_elements

   !> Write the curved reference of conformal contact, one point per row of elements
   subroutine write_curve(file, spec, place)
      class(hdf5_file), intent(inout) :: file
      type(case_spec), intent(in) :: spec
      type(wheel_rail_patch), intent(in) :: place
      integer :: last, step
      real(wp) :: s

      s = side_sign(spec)
      step = merge(-1, 1, s < 0.0_wp)
      last = size(place%curve, 2)
      call file%open_group("curve")
      call file%make_table()
      if (step > 0) then
         call put(place%curve)
      else
         call put(place%curve(:, last:1:-1))
      end if
      call file%close_group()

   contains

      subroutine put(curve)
         real(wp), intent(in) :: curve(:, :)

         call file%numbers("y", "mm", "lateral, track coordinates", s*curve(1, :))
         call file%numbers("z", "mm", "vertical, track coordinates", curve(2, :))
         call file%numbers("angle", "rad", "inclination", s*curve(3, :))
      end subroutine put
   end subroutine write_curve

   !> Write the points of a profile, relative to its marker
   subroutine write_profile(file, name, spec, curve)
      class(hdf5_file), intent(inout) :: file
      character(len=*), intent(in) :: name
      type(case_spec), intent(in) :: spec
      type(profile_curve), intent(in) :: curve

      call file%open_group(name)
      call file%make_table()
      call file%numbers("y", "mm", "lateral, about the marker", side_sign(spec)*curve%y%value(curve%y%s))
      call file%numbers("z", "mm", "vertical, about the marker", curve%z%value(curve%y%s))
      call file%close_group()
   end subroutine write_profile

   !> Write displacements and stresses of a block of points
   subroutine write_block(file, block)
      class(hdf5_file), intent(inout) :: file
      type(subsurface_result), intent(in) :: block
      character(len=2), parameter :: component(6) = ["xx", "xy", "xz", "yy", "yz", "zz"]
      character(len=*), parameter :: sense(6) = [character(len=45) :: "normal stress along x, tension positive", &
         & "shear stress, force along y on a plane of x", "shear stress, force along z on a plane of x", &
         & "normal stress along y, tension positive", "shear stress, force along z on a plane of y", &
         & "normal stress along z, tension positive"]
      character(len=*), parameter :: direction(3) = [character(len=12) :: "longitudinal", "lateral", "vertical"]
      integer :: k

      associate (nx => block%nx, ny => block%ny, nz => block%nz)
         call file%scale(1, "x", "mm", "columns of points", block%position(1, :nx))
         call file%scale(2, "y", "mm", "rows of points", block%position(2, :nx*ny:max(1, nx)))
         call file%scale(3, "z", "mm", "depths, positive in body 1", block%position(3, :nx*ny*nz:max(1, nx*ny)))
         call file%open_group("points")
         call file%numbers("x", "mm", "columns of points", block%position(1, :nx))
         call file%numbers("y", "mm", "rows of points", block%position(2, :nx*ny:max(1, nx)))
         call file%numbers("z", "mm", "depths, positive in body 1", block%position(3, :nx*ny*nz:max(1, nx*ny)))
         call file%close_group()
      end associate
      do k = 1, 3
         call put("u" // "xyz"(k:k), "mm", trim(direction(k)) // " displacement", block%displacement(k, :))
      end do
      do k = 1, 6
         call put("sig" // component(k), "N/mm2", trim(sense(k)), block%stress(k, :))
      end do
      call put("sighyd", "N/mm2", "mean stress", block%sighyd)
      call put("sigvm", "N/mm2", "equivalent stress of von Mises", block%sigvm)
      call put("sigtr", "N/mm2", "equivalent stress of Tresca", block%sigtr)
      call put("sigma1", "N/mm2", "largest principal stress", block%sigma1)
      call put("sigma2", "N/mm2", "middle principal stress", block%sigma2)
      call put("sigma3", "N/mm2", "smallest principal stress", block%sigma3)

   contains

      subroutine put(name, unit, title, values)
         character(len=*), intent(in) :: name, unit, title
         real(wp), intent(in) :: values(:)
         call file%block(name, unit, title, values, block%nx, block%ny, block%nz)
      end subroutine put
   end subroutine write_block
end module contact_hdf5_case_file
