!> Lock of an experiment: one run at a time may write its files
!>
!> The lock is a file in the folder of the results that is kept open and locked. The system releases it when the process ends for
!> any reason, so that a file left by a killed run does not block later ones. Incomplete files of that run are deleted.
module contact_experiment_lock
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_null_char
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_system, only : lock_experiment, lock_state, remove_leftovers, unlock_experiment
   use contact_experiment_place, only : experiment_place
   implicit none (type, external)
   private

   public :: experiment_lock, is_leftover_rest, lock_suffix

   type :: experiment_lock
      !> Name of the lock file, null-terminated, so that releasing the lock needs no memory
      character(len=:), allocatable, private :: name
      !> Descriptor, negative if there is no lock
      integer(c_int), private :: file = -1
      !> Warning if the folder does not support locks; unallocated otherwise
      character(len=:), allocatable :: doubt
   contains
      !> Take the lock, or report its holder
      procedure :: take
      !> Release the lock
      procedure :: release
   end type experiment_lock

   !> Suffix of the lock file
   character(len=*), parameter :: lock_suffix = ".lock"

contains

   subroutine take(self, place, error)
      class(experiment_lock), intent(inout) :: self
      !> The experiment whose results are locked
      type(experiment_place), intent(in) :: place
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: what
      integer :: state

      self%name = place%results // lock_suffix // c_null_char
      call lock_experiment(place%results // lock_suffix, self%file, state, what)
      if (state == lock_state%ours) then
         call remove_leftovers(place%results(:len(place%results) - len(place%name)), place%name, is_leftover)
      else if (state == lock_state%held) then
         call fatal_error(error, "another run is writing the results of this experiment: " // what // "; wait until it has " &
            & // "ended, end it, or choose another folder by --output-dir", error_kind%locked, place%results // lock_suffix)
      else
         self%doubt = "the experiment could not be locked (" // place%results // lock_suffix // ": " // what &
            & // "); another run of it at the same time would not be noticed"
      end if
   end subroutine take

   subroutine release(self)
      class(experiment_lock), intent(inout) :: self

      if (self%file < 0) return
      call unlock_experiment(self%file, self%name)
      self%file = -1
   end subroutine release

   !> Test for remove_leftovers
   function is_leftover(rest, length) result(answer) bind(c)
      !> Part of the file name after the name of the experiment
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

   !> Is this the rest of a name of an incomplete file, after the name of the experiment, as in output/finished_file and
   !> hdf5/file?
   !>
   !> Files of a case are <name>[_reNNN].NNNN[letter].{mat,subs,vts,blockN.vts}, and of a run <name>.{h5,pvd}, followed by .tmp
   !> or .part; files of an experiment whose name starts with that of this one are not included.
   pure logical function is_leftover_rest(rest) result(ours)
      !> Part of the file name after the name of the experiment
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
      ! number of the case, and letter of a patch
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
