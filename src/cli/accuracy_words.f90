!> What the command line says of an accuracy: how large an error may be, and what may take the place of the full theory
module contact_cli_accuracy_words
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_cases_approximate_methods, only : allowances
   use contact_cases_accuracy_plan, only : largest_accuracy, smallest_accuracy
   implicit none (type, external)
   private

   public :: read_accuracy, read_permission

contains

   !> The largest relative error of the forces
   subroutine read_accuracy(word, accuracy, error)
      !> As it was typed
      character(len=*), intent(in) :: word
      !> Largest relative error, 0 after a mistake [-]
      real(wp), intent(out) :: accuracy
      !> Not a number, or one that cannot be asked for
      type(error_type), allocatable, intent(out) :: error
      integer :: status

      accuracy = 0.0_wp
      status = 1
      if (verify(word, "0123456789.+-eEdD") == 0 .and. len(word) > 0) read(word, *, iostat=status) accuracy
      if (status == 0 .and. accuracy >= smallest_accuracy .and. accuracy <= largest_accuracy) return
      call fatal_error(error, "the accuracy, '" // word // "', is not a number from 1e-6 to 0.1")
   end subroutine read_accuracy

   !> May simplified methods be chosen?
   subroutine read_permission(word, allows, error)
      !> As it was typed
      character(len=*), intent(in) :: word
      !> Was the word approximate said?
      logical, intent(out) :: allows
      !> Another word than approximate
      type(error_type), allocatable, intent(out) :: error

      allows = word == allowances(2)
      if (.not. allows) call fatal_error(error, "what may take the place of the full theory, '" // word // &
         & "', is not known; approximate is")
   end subroutine read_permission
end module contact_cli_accuracy_words
