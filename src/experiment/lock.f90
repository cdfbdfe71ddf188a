!> One run at a time on the files of an experiment
!>
!> The lock is a file beside the results that is kept open and locked. The system unlocks it when the process ends in whatever
!> way, so that a file left behind by a killed run locks nobody out. What that run left unfinished is removed.
module contact_experiment_lock
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_null_char
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_system, only : lock_experiment, lock_state, remove_leftovers, unlock_experiment
   use contact_experiment_place, only : experiment_place
   implicit none (type, external)
   private

   public :: experiment_lock, is_leftover_rest

   type :: experiment_lock
      !> Name of the locked file, null-terminated, so that giving the lock back needs no memory
      character(len=:), allocatable, private :: name
      !> Descriptor, negative when there is no lock
      integer(c_int), private :: file = -1
      !> A warning where the folder has no locks; unallocated otherwise
      character(len=:), allocatable :: doubt
   contains
      !> Take the lock, or tell who has it
      procedure :: take
      !> Give it back
      procedure :: release
   end type experiment_lock

   character(len=*), parameter :: suffix = ".lock"

contains

   subroutine take(self, place, error)
      class(experiment_lock), intent(inout) :: self
      !> The experiment whose results are locked
      type(experiment_place), intent(in) :: place
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: what
      integer :: state

      self%name = place%results // suffix // c_null_char
      call lock_experiment(place%results // suffix, self%file, state, what)
      if (state == lock_state%ours) then
         call remove_leftovers(place%results(:len(place%results) - len(place%name)), place%name, is_leftover)
      else if (state == lock_state%held) then
         call fatal_error(error, "another run is writing the results of this experiment: " // what // "; wait until it has " &
            & // "ended, end it, or choose another folder by --output-dir", error_kind%locked, place%results // suffix)
      else
         self%doubt = "the experiment could not be locked (" // place%results // suffix // ": " // what &
            & // "); another run of it at the same time would not be noticed"
      end if
   end subroutine take

   subroutine release(self)
      class(experiment_lock), intent(inout) :: self

      if (self%file < 0) return
      call unlock_experiment(self%file, self%name)
      self%file = -1
   end subroutine release

   !> For remove_leftovers
   function is_leftover(rest, length) result(answer) bind(c)
      !> What follows the name of the experiment in the name of a file
      integer(c_int), value :: length
      character(kind=c_char), intent(in) :: rest(length)
      integer(c_int) :: answer
      character(len=length) :: text
      integer :: k

      do k = 1, length
         text(k:k) = rest(k)
      end do
      answer = merge(1_c_int, 0_c_int, is_leftover_rest(text))
   end function is_leftover

   !> Does this follow the name of an experiment in the name of a file in the making, as output/finished_file and hdf5/file
   !> have them?
   !>
   !> Files of one case, <name>[_reNNN].NNNN[letter].{mat,subs,vts,blockN.vts}, and of a run, <name>.{h5,pvd}, with .tmp or .part
   !> behind them; so no file of an experiment is taken whose name begins with that of this one.
   pure logical function is_leftover_rest(rest) result(ours)
      !> What follows the name of the experiment in a name of a file
      character(len=*), intent(in) :: rest
      character(len=*), parameter :: figures = "0123456789", letters = "abcdefghijklmnopqrstuvwxyz"
      integer :: at, last, dot

      ours = .false.
      last = index(rest, ".", back=.true.) - 1
      if (last < 1) return
      if (rest(last + 1:) /= ".tmp" .and. rest(last + 1:) /= ".part") return
      ours = rest(:last) == ".h5" .or. rest(:last) == ".pvd"
      if (ours) return
      at = 1
      if (index(rest(:last), "_re") == 1) then
         at = verify(rest(4:last), figures) + 3
         if (at < 7) return
      end if
      if (rest(at:at) /= ".") return
      dot = at + index(rest(at + 1:last), ".")
      ! the number of the case, and the letter of a patch
      if (dot - at < 5 .or. verify(rest(at + 1:dot - 2), figures) > 0) return
      if (verify(rest(dot - 1:dot - 1), figures // letters) > 0) return
      select case (rest(dot + 1:last))
      case ("mat", "subs", "vts")
         ours = .true.
      case default
         if (index(rest(dot + 1:last), "block") == 1) ours = verify(rest(dot + 6:last - 4), figures) == 0 &
            & .and. rest(last - 3:last) == ".vts"
      end select
   end function is_leftover_rest
end module contact_experiment_lock
