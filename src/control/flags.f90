!> Flags of the library: control digits and settings by their codes, in one table
!>
!> The table is used for setting and getting, and defines the accepted range.
module contact_control_flags
   implicit none (type, external)
   private

   public :: flag, flag_row, flag_table, row_of_flag, accepted_value, highest_of

   type :: flag_list
      integer :: units = 1933, config = 1967, pvtime = 1970, bound = 1971, tang = 1972, norm = 1973, force = 1974
      integer :: frclaw = 1976, discns = 1977, inflcf = 1978, mater = 1979, exrhs = 1980, xflow = 1981, heat = 1982
      integer :: iestim = 1983, output = 1984, flow = 1985, return = 1986, matfil = 1987, sens = 1988
      integer :: ifmeth = 1989, ifvari = 1990, sbsout = 1991, sbsfil = 1992, npomax = 1993
      !> Flags that are not in the published interface: see CNTC_own_... in interface.txt
      integer :: own_heat = 9001, own_border = 9002, own_stepped = 9003, own_angle = 9004, own_across = 9005
      integer :: own_classical = 9006, own_order = 9007, own_errors = 9008, own_accuracy = 9009, own_reached = 9010
      integer :: own_wear = 9011, own_approximate = 9012
      integer :: idebug = 2000, licdbg = 2001, wrtinp = 2002, openmp = 2003, timers = 2004, ncase = 2005
   end type flag_list
   !> Codes of the flags
   type(flag_list), parameter :: flag = flag_list()

   type :: out_of_range_list
      !> The call is refused; the nearest accepted value is used; 0 is used
      integer :: refused = 1, nearest = 2, zero = 3
   end type out_of_range_list
   !> Treatment of values out of range, as documented for the published interface, see CNTC_ic_... there
   type(out_of_range_list), parameter :: out_of_range = out_of_range_list()

   !> One flag
   type :: flag_row
      integer :: code = 0
      !> Name of its control digit; blank for other settings
      character(len=2) :: digit = ""
      !> Range of accepted values, and treatment of others (member of out_of_range)
      integer :: lowest = 0, highest = 0, outside = out_of_range%refused
      !> Can it be set by cntc_setflags, and read by cntc_getflags?
      logical :: can_set = .true., can_get = .true.
   end type flag_row

   !> All flags, with the range of module 1 where the modules differ
   type(flag_row), parameter :: flag_table(*) = [ &
      & flag_row(flag%units, "  ", 1934, 1937, out_of_range%refused), &
      & flag_row(flag%config, "C1", 0, 5, out_of_range%nearest), &
      & flag_row(flag%pvtime, "P ", 0, 3, out_of_range%nearest), &
      & flag_row(flag%bound, "B ", 0, 6, out_of_range%nearest), &
      & flag_row(flag%tang, "T ", 0, 3, out_of_range%nearest), &
      & flag_row(flag%norm, "N ", 0, 1, out_of_range%nearest), &
      & flag_row(flag%force, "F ", 0, 3, out_of_range%nearest), &
      & flag_row(flag%frclaw, "L ", 0, 6, out_of_range%refused, .false., .true.), &
      & flag_row(flag%discns, "D ", 0, 9), &
      & flag_row(flag%inflcf, "C ", 0, 4), &
      & flag_row(flag%mater, "M ", 0, 7, out_of_range%refused, .false., .true.), &
      & flag_row(flag%exrhs, "E ", 0, 3, out_of_range%nearest, .true., .false.), &
      & flag_row(flag%xflow, "X ", 0, 9999999), &
      & flag_row(flag%heat, "H ", 0, 3, out_of_range%refused, .false., .true.), &
      & flag_row(flag%iestim, "I ", 0, 3, out_of_range%nearest), &
      & flag_row(flag%output, "O ", 0, 6, out_of_range%nearest), &
      & flag_row(flag%flow, "W ", 0, 9, out_of_range%nearest), &
      & flag_row(flag%return, "R ", 0, 3, out_of_range%nearest), &
      & flag_row(flag%matfil, "A ", 0, 2, out_of_range%zero), &
      & flag_row(flag%sens, "  ", 0, 3, out_of_range%nearest), &
      & flag_row(flag%ifmeth, "  ", 0, 1, out_of_range%nearest), &
      & flag_row(flag%ifvari, "  ", 1, 4, out_of_range%nearest), &
      & flag_row(flag%sbsout, "  ", 0, 4, out_of_range%nearest), &
      & flag_row(flag%sbsfil, "  ", 0, 2, out_of_range%zero), &
      & flag_row(flag%npomax, "  ", 100, 1000000, out_of_range%nearest), &
      & flag_row(flag%idebug, "  ", -huge(1), huge(1), out_of_range%refused, .true., .false.), &
      & flag_row(flag%licdbg, "  ", -huge(1), huge(1), out_of_range%refused, .true., .false.), &
      & flag_row(flag%wrtinp, "  ", 0, 2), &
      & flag_row(flag%openmp, "  ", -huge(1), huge(1), out_of_range%refused, .true., .false.), &
      & flag_row(flag%timers, "  ", 0, 2, out_of_range%refused, .true., .false.), &
      & flag_row(flag%ncase, "  ", 0, huge(1)), &
      & flag_row(flag%own_heat, "  ", 0, 1), &
      & flag_row(flag%own_angle, "  ", 0, 1), &
      & flag_row(flag%own_classical, "  ", 0, 1), &
      & flag_row(flag%own_order, "  ", 1, 2), &
      & flag_row(flag%own_errors, "  ", 0, 1), &
      & flag_row(flag%own_wear, "  ", 0, 1), &
      & flag_row(flag%own_accuracy, "  ", 0, 1000000), &
      & flag_row(flag%own_approximate, "  ", 0, 1), &
      & flag_row(flag%own_reached, "  ", 0, 1, out_of_range%refused, .false., .true.), &
      & flag_row(flag%own_border, "  ", 0, 4095, out_of_range%refused, .false., .true.), &
      & flag_row(flag%own_stepped, "  ", 0, huge(1), out_of_range%refused, .false., .true.), &
      & flag_row(flag%own_across, "  ", 0, huge(1), out_of_range%refused, .false., .true.)]

contains

   !> Row of the table, 0: none
   pure integer function row_of_flag(code) result(row)
      !> CNTC_ic_... or CNTC_if_...
      integer, intent(in) :: code

      do row = 1, size(flag_table)
         if (flag_table(row)%code == code) return
      end do
      row = 0
   end function row_of_flag

   !> Maximum accepted value of a flag
   pure integer function highest_of(row, module_number) result(highest)
      !> Row of the table of flags
      type(flag_row), intent(in) :: row
      integer, intent(in) :: module_number

      highest = row%highest
      if (row%code == flag%force .and. module_number == 3) highest = 2
   end function highest_of

   !> The value that is stored for a value given by the caller, which may differ, and whether it is stored
   pure subroutine accepted_value(row, value, module_number, stored, accepted)
      !> Row of the table of flags
      type(flag_row), intent(in) :: row
      !> Value given by the caller
      integer, intent(in) :: value
      integer, intent(in) :: module_number
      !> Value to be stored: the nearest accepted one if this is documented
      integer, intent(out) :: stored
      !> False if the call is refused
      logical, intent(out) :: accepted

      stored = value
      accepted = value >= row%lowest .and. value <= highest_of(row, module_number)
      if (.not. accepted) then
         if (row%outside == out_of_range%nearest) stored = max(row%lowest, min(highest_of(row, module_number), value))
         if (row%outside == out_of_range%zero) stored = 0
         accepted = row%outside /= out_of_range%refused
      end if
      ! there is no level 3 for the output of subsurface stresses
      if (row%code == flag%sbsout .and. stored == 3) stored = 2
   end subroutine accepted_value
end module contact_control_flags
