!> What became of an accuracy that was asked for: grid, order and tolerance that were chosen, and the error that is left
module contact_base_accuracy_report
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: accuracy_report, longest_method, longest_reason

   !> Room for the reason why an accuracy was not reached
   integer, parameter :: longest_reason = 160
   !> Room for what is told of simplified methods
   integer, parameter :: longest_method = 160

   !> An accuracy that was asked for, and how it was sought
   type :: accuracy_report
      !> Largest relative error of the forces that was allowed, and the estimated one of the result [-]; a negative estimate: none
      real(wp) :: asked = 0.0_wp, estimated = -1.0_wp
      !> Is the estimate within what was asked?
      logical :: is_met = .false.
      !> Elements along x and y, 0 for wheel and rail, whose patches have grids of their own; sides of the elements [mm]
      integer :: elements(2) = 0
      real(wp) :: sides(2) = 0.0_wp
      !> Order of the discretisation of rolling; 0: there is none
      integer :: order = 0
      !> Tolerance of the solvers [-]
      real(wp) :: eps = 0.0_wp
      !> Grids that were solved; elapsed time of all of them, and of the one that was kept [s]
      integer :: levels = 0
      real(wp) :: seconds = 0.0_wp, last_seconds = 0.0_wp
      !> Why it is not met, with blanks behind; blank: it is
      character(len=longest_reason) :: reason = ""
      !> Where simplified methods were allowed: the one that was chosen and its error, or why there is none; with blanks behind
      character(len=longest_method) :: method = ""
   end type accuracy_report
end module contact_base_accuracy_report
