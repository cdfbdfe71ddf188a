!> Hertz data, grid and undeformed distance from the values of a case
module contact_cases_geometry
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_is_nan
   use contact_base_choices, only : grid_form, normal_control, planform_choice
   use contact_base_constants, only : excluded_distance, excluded_threshold
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_guard, only : expect_refusals
   use contact_base_kinds, only : long, wp
   use contact_cases_distance, only : fill_distance, fill_quadratic, quadratic
   use contact_cases_numbers, only : require_finite, require_positive
   use contact_cases_spec, only : geometry_spec, grid_spec
   use contact_grid_potential_contact, only : potential_contact
   use contact_normal_hertz, only : hertz_by_axes, hertz_by_curvatures, hertz_by_ratio, hertz_contact, &
      & hertz_load, line_contact_by_axes, line_contact_by_curvature
   use contact_patch_result, only : hertz_result
   use contact_text_words, only : integer_text, real_text
   implicit none (type, external)
   private

   public :: solve_hertz, build_grid, undeformed_distance, part_labels
   public :: strip_rows

   !> Semi-axis that replaces zero in the definition of a grid [mm]
   real(wp), parameter :: min_axis = 1.0e-9_wp

contains

   !> Solve Hertz's problem for the options that require it (IPOTCN -1...-5).
   !>
   !> A force or approach of zero is allowed and gives no contact: zero semi-axes if the curvatures are given.
   subroutine solve_hertz(spec, control, fn, pen, gg, nu, hertz, error)
      !> Values of the option: semi-axes or curvatures
      type(grid_spec), intent(in) :: spec
      !> Member of normal_control
      integer, intent(in) :: control
      !> Prescribed normal force [N] or approach [mm]
      real(wp), intent(in) :: fn, pen
      !> Combined modulus of rigidity [N/mm2] and Poisson ratio [-]
      real(wp), intent(in) :: gg, nu
      !> Complete solution; unallocated for other options, unchanged after errors
      type(hertz_result), allocatable, intent(inout) :: hertz
      type(error_type), allocatable, intent(out) :: error
      type(hertz_load) :: load
      type(hertz_contact) :: solution

      if (.not. spec%is_hertzian()) then
         if (allocated(hertz)) deallocate(hertz)
         return
      end if
      call check_hertz(spec, control, fn, pen, gg, nu, error)
      if (allocated(error)) return
      load%control = control
      if (control == normal_control%force) then
         load%fn = fn
      else
         load%pen = pen
      end if
      load%modulus = gg/(1.0_wp - nu)
      select case (spec%form)
      case (grid_form%hertz_curvatures)
         solution = hertz_by_curvatures(load, spec%a1, spec%b1)
      case (grid_form%hertz_curvature_ratio)
         solution = hertz_by_ratio(load, spec%a1, spec%aob)
      case (grid_form%hertz_axes)
         solution = hertz_by_axes(load, spec%aa, spec%bb)
      case (grid_form%hertz_line_curvature)
         solution = line_contact_by_curvature(load, spec%a1, spec%bb)
      case (grid_form%hertz_line)
         solution = line_contact_by_axes(load, spec%aa, spec%bb)
      end select
      if (.not. allocated(hertz)) allocate(hertz)
      hertz = hertz_result(a1=solution%a1, b1=solution%b1, aa=solution%aa, bb=solution%bb, &
         & aob=solution%aob, rho=solution%rho, cp=solution%cp, fn=solution%fn, pen=solution%pen)
   end subroutine solve_hertz

   !> Check that Hertz's problem can be solved with these values
   subroutine check_hertz(spec, control, fn, pen, gg, nu, error)
      type(grid_spec), intent(in) :: spec
      integer, intent(in) :: control
      real(wp), intent(in) :: fn, pen, gg, nu
      type(error_type), allocatable, intent(out) :: error

      if (control == normal_control%force) then
         call require_finite("normal force FN", fn, error)
      else
         call require_finite("approach PEN", pen, error)
      end if
      call require_positive("modulus of rigidity", gg, error)
      call require_finite("Poisson ratio", nu, error)
      if (allocated(error)) return
      if (nu >= 1.0_wp) then
         call fatal_error(error, "the combined Poisson ratio must be below 1, it is " // real_text(nu))
         return
      end if
      select case (spec%form)
      case (grid_form%hertz_curvatures)
         call require_positive("curvature A1", spec%a1, error)
         call require_positive("curvature B1", spec%b1, error)
      case (grid_form%hertz_curvature_ratio)
         call require_positive("curvature A1", spec%a1, error)
         call require_positive("ratio AOB", spec%aob, error)
      case (grid_form%hertz_axes, grid_form%hertz_line)
         call require_positive("semi-axis AA", spec%aa, error)
         call require_positive("semi-axis BB", spec%bb, error)
      case (grid_form%hertz_line_curvature)
         call require_positive("curvature A1", spec%a1, error)
         call require_positive("half length BB", spec%bb, error)
      end select
   end subroutine check_hertz

   !> Complete the potential contact from the values of its option (IPOTCN -1...-6 and 1...4)
   subroutine build_grid(spec, hertz, grid, error)
      !> Values of the option: corners, centres or steps
      type(grid_spec), intent(in) :: spec
      !> Hertz solution, for IPOTCN -1...-5; may be absent or unallocated for the others
      type(hertz_result), intent(in), optional :: hertz
      type(potential_contact), intent(out) :: grid
      type(error_type), allocatable, intent(out) :: error

      if (spec%mx < 1 .or. spec%my < 1) then
         call fatal_error(error, "the numbers of elements MX, MY must be positive, they are " &
            & // integer_text(spec%mx) // " and " // integer_text(spec%my))
         return
      end if
      if (int(spec%mx, long)*int(spec%my, long) > int(huge(1), long)) then
         call fatal_error(error, "the potential contact has too many elements: MX = " &
            & // integer_text(spec%mx) // ", MY = " // integer_text(spec%my))
         return
      end if
      if (spec%is_hertzian() .and. .not. present(hertz)) then
         call fatal_error(error, "a Hertzian potential contact needs the Hertz solution", &
            & kind=error_kind%internal)
         return
      end if
      grid%mx = spec%mx
      grid%my = spec%my
      select case (spec%form)
      case (grid_form%half_ellipses:grid_form%hertz_curvatures)
         call require_positive("grid factor SCALE", spec%scale, error)
         if (spec%form == grid_form%half_ellipses) then
            call require_positive("semi-axis AA", spec%aa, error)
            call require_positive("extent BNEG", spec%bneg, error)
            call require_positive("extent BPOS", spec%bpos, error)
         end if
         if (allocated(error)) return
         if (spec%form == grid_form%half_ellipses) then
            call lay_out_window(spec%scale*spec%aa, 0.5_wp*spec%scale*(spec%bneg + spec%bpos), grid)
         else if (spec%is_line_contact()) then
            call lay_out_strip(spec%scale, hertz%aa, hertz%bb, grid)
         else
            call lay_out_window(spec%scale*max(min_axis, hertz%aa), &
               & spec%scale*max(min_axis, hertz%bb), grid)
         end if
      case (grid_form%corner_and_sides:grid_form%centres)
         call lay_out_given(spec, grid)
      case default
         call fatal_error(error, "IPOTCN = " // integer_text(spec%form) // " is not an option for the " &
            & // "potential contact; -6...-1 and 1...4 are")
         return
      end select
      call require_finite("corner XL of the potential contact", grid%xl, error)
      call require_finite("corner YL of the potential contact", grid%yl, error)
      call require_positive("element size DX", grid%dx, error)
      call require_positive("element size DY", grid%dy, error)
   end subroutine build_grid

   !> Potential contact centred at the origin
   pure subroutine lay_out_window(half_x, half_y, grid)
      !> Half sides [mm]
      real(wp), intent(in) :: half_x, half_y
      type(potential_contact), intent(inout) :: grid

      grid%xl = -half_x
      grid%yl = -half_y
      grid%dx = 2.0_wp*half_x/grid%mx
      grid%dy = 2.0_wp*half_y/grid%my
   end subroutine lay_out_window

   !> Potential contact of a line contact: a whole number of rows has exactly the length of the contact
   pure subroutine lay_out_strip(scale, aa, bb, grid)
      !> Size of the potential contact relative to the contact area [-]
      real(wp), intent(in) :: scale
      !> Half width and half length of the contact [mm]
      real(wp), intent(in) :: aa, bb
      type(potential_contact), intent(inout) :: grid

      call lay_out_window(scale*max(min_axis, aa), max(min_axis, bb)*grid%my/strip_rows(grid%my, scale), grid)
   end subroutine lay_out_strip

   !> Number of rows of a potential contact that are inside a line contact
   pure integer function strip_rows(my, scale) result(rows)
      !> Number of rows of the potential contact
      integer, intent(in) :: my
      !> Size of the potential contact relative to the contact area [-]
      real(wp), intent(in) :: scale

      rows = my
      if (scale <= 1.0_wp) return
      rows = max(1, nint(my/scale))
      ! equal numbers of rows outside on both sides, so that the ends of the contact are between rows
      if (mod(my - rows, 2) /= 0) rows = rows + 1
   end function strip_rows

   !> Potential contact given by its corner or first centre, and by steps or the opposite corner or last centre
   pure subroutine lay_out_given(spec, grid)
      type(grid_spec), intent(in) :: spec
      type(potential_contact), intent(inout) :: grid

      select case (spec%form)
      case (grid_form%corner_and_sides, grid_form%centre_and_sides)
         grid%dx = spec%dx
         grid%dy = spec%dy
      case (grid_form%corners)
         grid%dx = (spec%xh - spec%xl)/spec%mx
         grid%dy = (spec%yh - spec%yl)/spec%my
      case (grid_form%centres)
         grid%dx = (spec%xcm - spec%xc1)/max(1, spec%mx - 1)
         grid%dy = (spec%ycm - spec%yc1)/max(1, spec%my - 1)
      end select
      if (any(spec%form == [grid_form%corner_and_sides, grid_form%corners])) then
         grid%xl = spec%xl
         grid%yl = spec%yl
      else
         grid%xl = spec%xc1 - 0.5_wp*grid%dx
         grid%yl = spec%yc1 - 0.5_wp*grid%dy
      end if
   end subroutine lay_out_given

   !> Undeformed distance at the centres of the elements; the approach is not included.
   !>
   !> With Hertz data it is a1 x**2 + b1 y**2, independent of the geometry of the case. Elements outside the planform get
   !> excluded_distance, and so do all values that mean exclusion.
   subroutine undeformed_distance(spec, grid, hertz, h, error)
      !> Form of the undeformed distance with its values
      type(geometry_spec), intent(in) :: spec
      type(potential_contact), intent(in) :: grid
      !> Hertz solution of a Hertzian geometry; may be absent or unallocated
      type(hertz_result), intent(in), optional :: hertz
      !> Undeformed distance [mm], shape (mx, my)
      real(wp), allocatable, intent(out) :: h(:, :)
      type(error_type), allocatable, intent(out) :: error
      integer :: status

      call expect_refusals(.true.)
      allocate(h(grid%mx, grid%my), stat=status)
      call expect_refusals(.false.)
      if (status /= 0) then
         call fatal_error(error, "no memory for " // integer_text(grid%mx) // " x " // integer_text(grid%my) &
            & // " elements", kind=error_kind%memory)
         return
      end if
      if (present(hertz)) then
         call fill_quadratic(grid, [hertz%a1, 0.0_wp, hertz%b1, 0.0_wp, 0.0_wp, 0.0_wp], h)
         return
      end if
      call fill_distance(spec, grid, h, error)
      if (allocated(error)) return
      if (any(ieee_is_nan(h))) then
         call fatal_error(error, "the undeformed distance is not a number in some elements")
         return
      end if
      if (any(h < -huge(1.0_wp))) then
         call fatal_error(error, "the undeformed distance is minus infinity in some elements")
         return
      end if
      h = min(h, excluded_distance)
      call apply_planform(spec, grid, h, error)
      if (allocated(error)) return
      if (all(h > excluded_threshold)) call fatal_error(error, &
         & "the planform excludes all elements of the potential contact from contact")
   end subroutine undeformed_distance

   !> Exclude elements whose centre is outside the planform
   subroutine apply_planform(spec, grid, h, error)
      type(geometry_spec), intent(in) :: spec
      type(potential_contact), intent(in) :: grid
      real(wp), intent(inout) :: h(:, :)
      type(error_type), allocatable, intent(out) :: error
      integer, allocatable :: label(:, :)
      integer :: ix, iy
      logical :: inside

      select case (spec%planform)
      case (planform_choice%unrestricted)
         return
      case (planform_choice%quadratic, planform_choice%two_rectangles)
         if (.not. all(ieee_is_finite(spec%pl(:merge(6, 8, spec%planform == planform_choice%quadratic))))) then
            call fatal_error(error, "the numbers of the planform (IPLAN = " // integer_text(spec%planform) // ") must be finite")
            return
         end if
      case (planform_choice%weighted_rectangles)
         call check_parts(spec, error)
         if (allocated(error)) return
         label = part_labels(spec, grid)
         where (label == 0) h = excluded_distance
         return
      case default
         call fatal_error(error, "IPLAN = " // integer_text(spec%planform) // " is not a planform; 1 to 4 are")
         return
      end select
      do iy = 1, grid%my
         do ix = 1, grid%mx
            if (spec%planform == planform_choice%quadratic) then
               inside = quadratic(spec%pl(1:6), grid%x(ix), grid%y(iy)) < 0.0_wp
            else
               inside = in_rectangle(spec%pl(1:4), grid%x(ix), grid%y(iy)) &
                  & .or. in_rectangle(spec%pl(5:8), grid%x(ix), grid%y(iy))
            end if
            if (.not. inside) h(ix, iy) = excluded_distance
         end do
      end do
   end subroutine apply_planform

   !> Check rectangles and factors of a planform of several parts
   subroutine check_parts(spec, error)
      type(geometry_spec), intent(in) :: spec
      type(error_type), allocatable, intent(out) :: error
      integer :: parts

      parts = 0
      if (allocated(spec%rectangles) .and. allocated(spec%interaction)) parts = size(spec%rectangles, 2)
      if (parts == 0) then
         call fatal_error(error, "a planform of several parts (IPLAN = 4) needs their rectangles and factors")
      else if (.not. (all(ieee_is_finite(spec%rectangles)) .and. all(ieee_is_finite(spec%interaction)))) then
         call fatal_error(error, "the numbers of the planform (IPLAN = 4) must be finite")
      else if (any(shape(spec%interaction) /= parts)) then
         call fatal_error(error, "a planform of several parts (IPLAN = 4) needs a factor for each pair of parts")
      end if
   end subroutine check_parts

   !> Index of the part of a planform that contains the centre of each element: the first one in the list, 0 for none
   pure function part_labels(spec, grid) result(label)
      !> Geometry with rectangles
      type(geometry_spec), intent(in) :: spec
      type(potential_contact), intent(in) :: grid
      integer, allocatable :: label(:, :)
      integer :: ix, iy, k

      allocate(label(grid%mx, grid%my), source=0)
      do iy = 1, grid%my
         do ix = 1, grid%mx
            do k = 1, size(spec%rectangles, 2)
               if (.not. in_rectangle(spec%rectangles(:, k), grid%x(ix), grid%y(iy))) cycle
               label(ix, iy) = k
               exit
            end do
         end do
      end do
   end function part_labels

   !> Is a point inside the closed rectangle xl, xh, yl, yh?
   pure logical function in_rectangle(sides, x, y) result(inside)
      real(wp), intent(in) :: sides(4), x, y
      inside = sides(1) <= x .and. x <= sides(2) .and. sides(3) <= y .and. y <= sides(4)
   end function in_rectangle
end module contact_cases_geometry
