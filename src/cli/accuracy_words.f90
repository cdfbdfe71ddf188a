!> Command-line options of accuracy: the requested bound of the error, and methods allowed instead of the full theory
module contact_cli_accuracy_words
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_cases_approximate_methods, only : allowances
   use contact_cases_accuracy_plan, only : largest_accuracy, smallest_accuracy
   implicit none (type, external)
   private

   public :: read_accuracy, read_permission

contains

   !> Parse the bound of the relative error of the forces
   subroutine read_accuracy(word, accuracy, error)
      !> Word as typed
      character(len=*), intent(in) :: word
      !> Bound of the relative error, 0 after an error [-]
      real(wp), intent(out) :: accuracy
      !> Not a number, or outside the accepted range
      type(error_type), allocatable, intent(out) :: error
      integer :: status

      accuracy = 0.0_wp
      status = 1
      if (verify(word, "0123456789.+-eEdD") == 0 .and. len(word) > 0) read(word, *, iostat=status) accuracy
      if (status == 0 .and. accuracy >= smallest_accuracy .and. accuracy <= largest_accuracy) return
      call fatal_error(error, "the accuracy, '" // word // "', is not a number from 1e-6 to 0.1")
   end subroutine read_accuracy

   !> Parse the permission to use simplified methods
   subroutine read_permission(word, allows, error)
      !> Word as typed
      character(len=*), intent(in) :: word
      !> Is the word "approximate"?
      logical, intent(out) :: allows
      !> Allocated for any other word
      type(error_type), allocatable, intent(out) :: error

      allows = word == allowances(2)
      if (.not. allows) call fatal_error(error, 'unknown value of --allow "' // word // &
         & '"; accepted: approximate')
   end subroutine read_permission
end module contact_cli_accuracy_words
