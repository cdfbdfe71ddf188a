!> Where the files of an experiment are
module contact_experiment_place
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

      path = with_own_separators(trim(adjustl(typed)))
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
      if (len_trim(output_folder) > 0) place%results = in_folder(with_own_separators(trim(output_folder)), place%name)
   end function locate_experiment

   !> A file name with the separators of this platform
   pure function with_own_separators(name) result(own)
      character(len=*), intent(in) :: name
      character(len=len(name)) :: own
      integer :: i

      own = name
      do i = 1, len(own)
         if (own(i:i) == foreign_separator) own(i:i) = separator
      end do
   end function with_own_separators

   !> Folder and name in one
   pure function in_folder(folder, name) result(path)
      character(len=*), intent(in) :: folder, name
      character(len=:), allocatable :: path

      path = folder // separator // name
      if (folder(len(folder):) == separator) path = folder // name
   end function in_folder
end module contact_experiment_place
