!> Where the files of an experiment are
module contact_experiment_place
   use contact_text_words, only : replaced
   implicit none (type, external)
   private

   public :: experiment_place, locate_experiment

   character(len=*), parameter :: separator = "/", foreign_separator = "\", input_suffix = ".inp"

   !> The files of an experiment
   type :: experiment_place
      !> Folder of the input, to which names in the input are relative; "" for the current folder
      character(len=:), allocatable :: folder
      !> Name without folder and suffix
      character(len=:), allocatable :: name
      !> Name of the input file
      character(len=:), allocatable :: input
      !> Folder and name of the results, to which a suffix is added
      character(len=:), allocatable :: results
      !> Was a suffix .inp taken off?
      logical :: shortened = .false.
   end type experiment_place

contains

   !> From the name of an experiment as a user types it to the names of its files
   !>
   !> Both kinds of separators are understood, a suffix .inp is taken off, and results go to the folder
   !> of the input unless another one is named.
   pure function locate_experiment(typed, output_folder) result(place)
      !> Name of the experiment, with or without folder and suffix
      character(len=*), intent(in) :: typed
      !> Folder of the results; "" for that of the input
      character(len=*), intent(in) :: output_folder
      type(experiment_place) :: place
      character(len=:), allocatable :: path
      integer :: last

      path = replaced(trim(adjustl(typed)), foreign_separator, separator)
      last = len(path) - len(input_suffix)
      if (last > 0) then
         if (path(last + 1:) == input_suffix .and. path(last:last) /= separator) then
            path = path(:last)
            place%shortened = .true.
         end if
      end if
      last = index(path, separator, back=.true.)
      place%folder = path(:last)
      place%name = path(last + 1:)
      place%input = path // input_suffix
      place%results = path
      if (len_trim(output_folder) > 0) then
         path = replaced(trim(output_folder), foreign_separator, separator)
         if (path(len(path):) /= separator) path = path // separator
         place%results = path // place%name
      end if
   end function locate_experiment
end module contact_experiment_place
