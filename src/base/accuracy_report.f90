!> Outcome of a requested accuracy: the chosen grid, order and tolerance, and the remaining error
module contact_base_accuracy_report
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: accuracy_report, longest_method, longest_reason

   !> Length of the reason why an accuracy was not reached
   integer, parameter :: longest_reason = 160
   !> Length of the text about simplified methods
   integer, parameter :: longest_method = 160

   !> Outcome of a search for the discretisation that reaches a requested accuracy
   type :: accuracy_report
      !> Requested bound of the relative error of the forces, and estimated error of the result [-]; a negative estimate: none
      real(wp) :: required = 0.0_wp, estimated = -1.0_wp
      !> Is the estimate within the requested bound?
      logical :: is_met = .false.
      !> Number of elements along x and y, 0 for wheel and rail, where each patch has its own grid; element sides [mm]
      integer :: elements(2) = 0
      real(wp) :: sides(2) = 0.0_wp
      !> Order of the discretisation of rolling; 0: not applicable
      integer :: order = 0
      !> Tolerance of the solvers [-]
      real(wp) :: eps = 0.0_wp
      !> Number of grids solved; elapsed time of all of them, and of the final one [s]
      integer :: levels = 0
      real(wp) :: seconds = 0.0_wp, last_seconds = 0.0_wp
      !> Reason why the accuracy was not reached, padded with blanks; blank if it was
      character(len=longest_reason) :: reason = ""
      !> If simplified methods are allowed: the chosen method and its error, or the reason for choosing none; padded with blanks
      character(len=longest_method) :: method = ""
   end type accuracy_report
end module contact_base_accuracy_report
