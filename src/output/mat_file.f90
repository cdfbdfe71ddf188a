!> The .mat file: tractions, displacements and slip per element as a table of numbers
!>
!> Loaders skip lines that start with % and require the same number of columns on all others. Some skip 13 lines instead, so
!> information that other programs do not know, the status, is appended to the names of the first line.
module contact_output_mat_file
   use contact_base_case_status, only : case_status
   use contact_base_choices, only : has_slope_reduction, is_rolling, is_simplified, material_model
   use contact_base_error, only : add_context, error_type
   use contact_base_kinds, only : wp
   use contact_cases_collector, only : collector, friction_numbers
   use contact_cases_spec, only : case_spec, friction_set
   use contact_control_digits, only : case_digits
   use contact_control_translation, only : digits_of
   use contact_grid_element_division, only : list_elements
   use contact_numeric_pieces, only : pieces_of
   use contact_output_finished_file, only : finished_file
   use contact_output_formats, only : general, whole
   use contact_patch_quantities, only : element_field
   use contact_patch_result, only : patch_result
   use contact_text_words, only : capital
   implicit none (type, external)
   private

   public :: mat_place, write_mat_file

   !> Version of the layout; readers refuse larger numbers
   integer, parameter :: layout = 2410
   !> Minimum value of A for which all elements are written
   integer, parameter :: all_elements = 2

   !> Lines that are made together; chosen
   integer, parameter :: lines_of_block = 4096

   !> Name of an unused column, of the length of all names: gfortran 12 pads shorter ones in array constructors with implied loops
   !> with the memory that follows them
   character(len=11), parameter :: unused = "-"

   !> Position of a patch of wheel and rail; the default value is for a contact problem of module 3
   type :: mat_place
      !> Time [s], S_WS [mm], pitch [rad], rail marker y, z [mm], roll [rad], roller radius [mm]
      real(wp) :: rail(7) = 0.0_wp
      !> Wheel marker x, y, z [mm], roll, yaw [rad], radius [mm]
      real(wp) :: wheel(6) = 0.0_wp
      !> Contact reference point: x, y, z [mm] and angle [rad] in rail coordinates, x, y, z [mm] in wheel coordinates
      real(wp) :: reference(7) = 0.0_wp
      !> Number of patches of the case, and index of this one
      integer :: patches = 0, patch = 0
      !> Digits C1 and D
      integer :: c1 = 0, d = 2
      !> Lateral position of the wheel profile in the wheelset [mm]
      real(wp) :: wheel_offset = 0.0_wp
      !> Contact reference point in the coordinates of the elements [mm]
      real(wp) :: spin_centre(2) = 0.0_wp
   end type mat_place

contains

   !> Write the file of a solved case; a file of this name is complete or does not exist
   subroutine write_mat_file(file_name, spec, result, status, error, place)
      !> Path
      character(len=*), intent(in) :: file_name
      type(case_spec), intent(in) :: spec
      type(patch_result), target, intent(in) :: result
      !> Status of the case, including all its patches
      type(case_status), intent(in) :: status
      type(error_type), allocatable, intent(out) :: error
      !> Position of a patch of wheel and rail
      type(mat_place), intent(in), optional :: place
      type(mat_place) :: here
      type(finished_file) :: file
      type(element_field), allocatable :: fields(:)

      if (present(place)) here = place
      call result%fields(fields)
      fields = pack(fields, has_column(fields))
      call file%start(file_name, error, spec%limits)
      if (allocated(error)) return
      call write_header(file, spec, result, status, here, fields)
      call write_elements(file, spec, result, fields)
      call file%finish(error)
      call add_context(error, "writing the .mat file")
   end subroutine write_mat_file

   !> Write six pairs of a line of names and a line of values, then the names of the table columns
   subroutine write_header(file, spec, result, status, place, fields)
      type(finished_file), intent(in) :: file
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      type(case_status), intent(in) :: status
      type(mat_place), intent(in) :: place
      !> Fields with a column
      type(element_field), intent(in) :: fields(:)
      character(len=14*(size(fields) + 2)) :: lines(13)
      type(collector) :: friction
      real(wp), allocatable :: values(:)
      character(len=11), allocatable :: constants(:)
      character(len=11) :: names(size(fields) + 1)
      real(wp) :: chi, dq
      logical :: rolling
      type(case_digits) :: digits
      integer :: i, columns

      digits = digits_of(spec)
      columns = size(fields) + 2
      names(1) = "   I  IGS"
      names(2:) = capital(fields%name)
      where (names == "SX") names = merge("SREL", "SHFT", is_rolling(result%motion))
      rolling = is_rolling(spec%motion)
      chi = merge(result%chi, 0.0_wp, rolling)
      dq = merge(result%dq, 1.0_wp, rolling)

      lines(1) = name_line([character(len=11) :: "TIM", "S_WS(FC)", "TH_WS(FC)", "Y_R(TR)", "Z_R(TR)", "ROLL_R(TR)", &
         & "RNOM_ROL", (unused, i = 9, columns), "FMT"])
      lines(2) = reals(place%rail) // integers([(0, i = 9, columns), layout])
      lines(3) = name_line([character(len=11) :: "X_W(TR)", "Y_W(TR)", "Z_W(TR)", "ROLL_W(TR)", "YAW_W(TR)", &
         & "RNOM_WHL", (unused, i = 7, columns)])
      lines(4) = reals([place%wheel, zeros(columns - 6)])
      lines(5) = name_line([character(len=11) :: "X_CP(R)", "Y_CP(R)", "Z_CP(R)", "DELT_CP(R)", "X_CP(W)", "Y_CP(W)", &
         & "Z_CP(W)", "NPATCH", "IPATCH", "SPINXO", "SPINYO", (unused, i = 12, columns)])
      lines(6) = reals(place%reference) // integers([place%patches, place%patch]) // reals([spec%kinematics%spinxo, &
         & spec%kinematics%spinyo] + place%spin_centre) // reals(zeros(columns - 11))
      lines(7) = name_line([character(len=11) :: "  MX   MY", "XL", "YL", "DX", "DY", "CHI", "DQ", "C1", "D", "YNOM_WHL", &
         & (unused, i = 12, columns)])
      lines(8) = two_integers(result%grid%mx, result%grid%my) // reals([result%grid%xl, result%grid%yl, result%grid%dx, &
         & result%grid%dy, chi, dq]) // integers([place%c1, place%d]) // reals([place%wheel_offset, zeros(columns - 11)])
      call list_materials(spec, result, constants, values)
      lines(9) = name_line(completed("   T    M", constants, columns))
      lines(10) = two_integers(digits%t, digits%m) // reals([values, zeros(columns - 2 - size(values))])
      call list_friction(spec, friction)
      lines(11) = name_line(completed("   L    H", [character(len=11) :: "VELOC", friction%names], columns))
      values = [merge(result%veloc, spec%rolling%veloc, place%patches > 0), friction%values]
      lines(12) = two_integers(spec%friction_law, digits%h) // reals([values, zeros(columns - 2 - size(values))])
      lines(13) = name_line(names)
      if (status%is_solved()) then
         call file%line(trim(lines(1)) // "   STATUS: " // trim(status%word()))
      else
         call file%line(trim(lines(1)) // "   STATUS: " // trim(status%word()) // " (" // trim(status%iteration_word()) // "): " &
            & // status%reason)
      end if
      do i = 2, size(lines)
         call file%line(trim(lines(i)))
      end do
   end subroutine write_header

   !> Does a field have a column in the table? Slip has one, its magnitude, at the position of its first component
   elemental logical function has_column(field)
      type(element_field), intent(in) :: field

      has_column = associated(field%values) .and. field%in_files .and. field%name /= "sy"
   end function has_column

   !> Write one line per element, in increasing index; threads share the lines of large grids, a block of them at a time
   subroutine write_elements(file, spec, result, fields)
      type(finished_file), intent(in) :: file
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      !> Fields with a column
      type(element_field), intent(in) :: fields(:)
      character(len=14*(size(fields) + 2)), allocatable :: lines(:)
      integer, allocatable :: at(:, :)
      integer :: first, k, last

      call list_elements(result%division, spec%mat_file >= all_elements, at)
      allocate(lines(min(lines_of_block, size(at, 2))))
      do first = 1, size(at, 2), lines_of_block
         last = min(size(at, 2), first + lines_of_block - 1)
         if (pieces_of(result%grid%npot()) == 1) then
            do k = first, last
               call set_line(result, fields, at(1, k), at(2, k), lines(k - first + 1))
            end do
         else
            !$omp parallel do
            do k = first, last
               call set_line(result, fields, at(1, k), at(2, k), lines(k - first + 1))
            end do
            !$omp end parallel do
         end if
         do k = 1, last - first + 1
            call file%line(trim(lines(k)))
         end do
      end do
   end subroutine write_elements

   !> The line of an element
   pure subroutine set_line(result, fields, ix, iy, line)
      type(patch_result), intent(in) :: result
      !> Fields with a column
      type(element_field), intent(in) :: fields(:)
      !> The element
      integer, intent(in) :: ix, iy
      character(len=14*(size(fields) + 2)), intent(inout) :: line
      real(wp) :: value
      integer :: k

      line = two_integers(ix + result%grid%mx*(iy - 1), result%division(ix, iy))
      do k = 1, size(fields)
         value = fields(k)%values(ix, iy)
         if (fields(k)%name == "sx") value = hypot(value, result%sy(ix, iy))
         line(14*k + 1:14*k + 14) = general(value/fields(k)%divisor, 14, 6)
      end do
   end subroutine set_line

   !> Names and values of the material constants of the model
   pure subroutine list_materials(spec, solved, names, values)
      type(case_spec), intent(in) :: spec
      !> Result, for the flexibilities of simplified theory
      type(patch_result), intent(in) :: solved
      character(len=11), allocatable, intent(out) :: names(:)
      real(wp), allocatable, intent(out) :: values(:)

      names = [character(len=11) :: "GG1", "GG2", "POISS1", "POISS2"]
      associate (material => spec%material)
         values = [material%gg, material%poiss]
         select case (spec%material_model)
         case (material_model%viscoelastic)
            names = [character(len=11) :: names, "FG1", "FG2", "TC1", "TC2"]
            values = [values, material%fg, material%tc]
         case (material_model%interfacial_layer)
            names = [character(len=11) :: names, "GG3", "LAYTHK", "TAU_C0", "K_TAU"]
            values = [values, material%gg3, material%laythk, material%tau_c0, material%k_tau]
         case default
            if (.not. is_simplified(spec%material_model)) return
            names = [character(len=11) :: names(:3), "FLX1", "FLX2", "FLX3", "K0_MF", "ALFAMF", "BETAMF"]
            values = [values(:3), solved%flx, material%k0_mf, material%alfamf, material%betamf]
            ! values of an earlier case in store do not act
            if (.not. has_slope_reduction(spec%material_model)) values(7:9) = 1.0_wp
         end select
      end associate
   end subroutine list_materials

   !> List names and values of the first friction set and of the friction memory
   subroutine list_friction(spec, a)
      type(case_spec), intent(in) :: spec
      type(collector), intent(out) :: a
      type(friction_set) :: set

      if (allocated(spec%friction%sets)) then
         if (size(spec%friction%sets) > 0) set = spec%friction%sets(1)
      end if
      call friction_numbers(a, spec%friction_law, set, spec%friction)
   end subroutine list_friction

   !> Names preceded by `first`, with a dash for each unused column at the end
   pure function completed(first, names, columns) result(all_names)
      !> Name above the first two columns
      character(len=*), intent(in) :: first
      character(len=11), intent(in) :: names(:)
      !> Number of columns of the table
      integer, intent(in) :: columns
      character(len=11), allocatable :: all_names(:)
      integer :: i

      all_names = [character(len=11) :: first, names, [(unused, i = 1, columns - 2 - size(names))]]
   end function completed

   !> Line of names that loaders skip: a name at the fourth character of every 14 columns
   pure function name_line(names) result(line)
      character(len=11), intent(in) :: names(:)
      character(len=14*size(names)) :: line
      integer :: i

      line = ""
      do i = 1, size(names)
         line(14*i - 10:14*i) = names(i)
      end do
      line(1:1) = "%"
   end function name_line

   !> Real numbers in 14 columns each
   pure function reals(values) result(text)
      real(wp), intent(in) :: values(:)
      character(len=14*size(values)) :: text
      integer :: i

      do i = 1, size(values)
         text(14*i - 13:14*i) = general(values(i), 14, 6)
      end do
   end function reals

   !> Integers in 14 columns each
   pure function integers(values) result(text)
      integer, intent(in) :: values(:)
      character(len=14*size(values)) :: text
      integer :: i

      do i = 1, size(values)
         text(14*i - 13:14*i) = whole(values(i), 6)
      end do
   end function integers

   !> Two integers in 14 columns
   pure function two_integers(first, second) result(text)
      integer, intent(in) :: first, second
      character(len=14) :: text
      text = whole(first, 7) // " " // whole(second, 4)
   end function two_integers

   !> An array of zeros
   pure function zeros(count) result(values)
      integer, intent(in) :: count
      real(wp) :: values(max(0, count))
      values = 0.0_wp
   end function zeros
end module contact_output_mat_file
