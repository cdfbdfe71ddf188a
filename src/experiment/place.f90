!> Location of the files of an experiment
module contact_experiment_place
   use contact_text_words, only : replaced
   implicit none (type, external)
   private

   public :: choose_input, experiment_place, locate_experiment, input_suffix, readable_suffix, written_in_place

   character(len=*), parameter :: separator = "/", foreign_separator = "\"
   !> Suffixes of the two input formats
   character(len=*), parameter :: input_suffix = ".inp", readable_suffix = ".toml"
   !> Suffixes of results that grow under their own name during a run; others have a temporary name first
   character(len=*), parameter :: written_in_place(3) = [character(len=6) :: ".out", ".jsonl", ".pvd"]

   !> The files of an experiment
   type :: experiment_place
      !> Folder of the input, to which file names in the input are relative; "" for the current folder
      character(len=:), allocatable :: folder
      !> Name without folder and suffix
      character(len=:), allocatable :: name
      !> Name of the input file
      character(len=:), allocatable :: input
      !> Folder and base name of the results; a suffix is appended
      character(len=:), allocatable :: results
      !> Was a suffix .inp or .toml removed?
      logical :: shortened = .false.
   end type experiment_place

contains

   !> Determine the file names of an experiment from the name given by the user
   !>
   !> Both kinds of separators are accepted, a suffix .inp or .toml is removed, and results are written to the folder of the
   !> input unless another one is given. Without suffix the input is the .inp file, see choose_input.
   pure function locate_experiment(typed, output_folder) result(place)
      !> Name of the experiment, with or without folder and suffix
      character(len=*), intent(in) :: typed
      !> Folder of the results; "" for that of the input
      character(len=*), intent(in) :: output_folder
      type(experiment_place) :: place
      character(len=:), allocatable :: path, suffix
      integer :: last

      path = replaced(trim(adjustl(typed)), foreign_separator, separator)
      suffix = input_suffix
      if (ends_with(path, readable_suffix)) suffix = readable_suffix
      if (ends_with(path, suffix)) then
         path = path(:len(path) - len(suffix))
         place%shortened = .true.
      end if
      last = index(path, separator, back=.true.)
      place%folder = path(:last)
      place%name = path(last + 1:)
      place%input = path // suffix
      place%results = path
      if (len_trim(output_folder) > 0) then
         path = replaced(trim(output_folder), foreign_separator, separator)
         if (path(len(path):) /= separator) path = path // separator
         place%results = path // place%name
      end if
   end function locate_experiment

   !> Does a path end with a suffix after a non-empty name?
   pure logical function ends_with(path, suffix)
      character(len=*), intent(in) :: path, suffix
      integer :: last

      ends_with = .false.
      last = len(path) - len(suffix)
      if (last > 0) ends_with = path(last + 1:) == suffix .and. path(last:last) /= separator
   end function ends_with

   !> Use the .toml file if no suffix was given and there is no .inp file
   subroutine choose_input(place, has_both)
      !> The suffix of its input is set
      type(experiment_place), intent(inout) :: place
      !> Are there both files, so that .inp is read by default?
      logical, intent(out) :: has_both
      character(len=:), allocatable :: path
      logical :: has_input, has_readable

      has_both = .false.
      if (place%shortened) return
      path = place%folder // place%name
      inquire(file=path // input_suffix, exist=has_input)
      inquire(file=path // readable_suffix, exist=has_readable)
      has_both = has_input .and. has_readable
      if (has_readable .and. .not. has_input) place%input = path // readable_suffix
   end subroutine choose_input
end module contact_experiment_place
