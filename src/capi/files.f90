!> Paths of the files of the library: its folders, and the file to which cases are written as input
module contact_capi_files
   use contact_capi_host, only : find_current_folder
   use contact_capi_library, only : library
   use contact_capi_messages, only : set_last_error
   use contact_control_library_codes, only : library_code
   implicit none (type, external)
   private

   public :: set_folders, find_result_file, place_result, find_working_folder, find_full_path, open_input_dump, dumps_input, &
      & place_beside_dump, relate_to_dump

contains

   !> Path of a folder with a separator at its end
   pure function with_separator(folder) result(path)
      character(len=*), intent(in) :: folder
      character(len=len(folder) + merge(0, 1, folder(len(folder):) == "/")) :: path

      path = folder
      path(len(path):) = "/"
   end function with_separator

   !> Store the folders and name of the experiment, inside the critical section
   subroutine set_folders(work_folder, out_folder, name)
      !> Empty: keep the previous value, or the default
      character(len=*), intent(in) :: work_folder, out_folder, name
      integer :: slash

      if (.not. allocated(library%name)) library%name = "contact_addon"
      if (.not. allocated(library%work_folder)) library%work_folder = ""
      if (.not. allocated(library%out_folder)) library%out_folder = ""
      if (len(work_folder) > 0) library%work_folder = with_separator(work_folder)
      if (len(out_folder) > 0) library%out_folder = with_separator(out_folder)
      if (len(name) == 0) return
      slash = index(name, "/", back=.true.)
      if (slash > 0 .and. len(work_folder) == 0) library%work_folder = name(:slash)
      if (slash < len(name)) library%name = name(slash + 1:)
   end subroutine set_folders

   !> Path of a file in the folder of results; a relative folder is relative to the working folder
   subroutine find_result_file(file, path)
      !> Name without folder
      character(len=*), intent(in) :: file
      !> Path with folder
      character(len=:), allocatable, intent(out) :: path

      !$omp critical (contact_registry)
      call place_result(file, path)
      !$omp end critical (contact_registry)
   end subroutine find_result_file

   !> The same inside the critical section
   subroutine place_result(file, path)
      !> Name without folder
      character(len=*), intent(in) :: file
      !> Path with folder
      character(len=:), allocatable, intent(out) :: path

      path = library%out_folder // file
      if (path(:1) /= "/") path = library%work_folder // path
   end subroutine place_result

   !> Folder to which file names are relative, with a separator at its end, "" for the current one
   subroutine find_working_folder(folder)
      !> Folder given by the caller of cntc_initializefirst
      character(len=:), allocatable, intent(inout) :: folder

      !$omp critical (contact_registry)
      if (allocated(library%work_folder)) then
         folder = library%work_folder
      else
         folder = ""
      end if
      !$omp end critical (contact_registry)
   end subroutine find_working_folder

   !> Open the file to which cases are written as input; not repeated after a failure
   subroutine open_input_dump()
      character(len=:), allocatable :: path
      character(len=:), allocatable :: reason

      !$omp critical (contact_registry)
      if (.not. library%dump_was_tried) then
         library%dump_was_tried = .true.
         call place_result(library%name // ".inp", path)
         call library%input_dump%open_file(path, reason)
         call make_absolute(path)
         library%dump_folder = path(:index(path, "/", back=.true.))
         if (allocated(reason)) call set_last_error(library_code%other, "the file " // path // " cannot be written: " // reason)
      end if
      !$omp end critical (contact_registry)
   end subroutine open_input_dump

   !> Is there a file to which cases are written as input, and is it complete so far? If not complete, this is reported
   logical function dumps_input()
      character(len=:), allocatable :: path
      logical :: ignored, has_failed

      !$omp critical (contact_registry)
      has_failed = library%input_dump%has_failed()
      dumps_input = library%input_dump%is_open() .and. .not. has_failed
      if (has_failed) then
         call library%input_dump%close_file(ignored)
         call place_result(library%name // ".inp", path)
         call set_last_error(library_code%other, "the file " // path // " is not complete; is the disk full?")
      end if
      !$omp end critical (contact_registry)
   end function dumps_input

   !> Full path of a file with a name of the caller, relative to the working folder
   subroutine find_full_path(name, path)
      !> May be absolute, too
      character(len=*), intent(in) :: name
      !> Absolute path
      character(len=:), allocatable, intent(out) :: path
      character(len=:), allocatable :: folder

      path = name
      if (name(:min(1, len(name))) == "/") return
      call find_working_folder(folder)
      path = folder // name
      call make_absolute(path)
   end subroutine find_full_path

   !> Put the current folder before a relative path
   subroutine make_absolute(path)
      character(len=:), allocatable, intent(inout) :: path
      character(len=:), allocatable :: folder

      if (path(:min(1, len(path))) == "/") return
      call find_current_folder(folder)
      path = folder // "/" // path
   end subroutine make_absolute

   !> Path of a file in the folder of the input file that is written
   subroutine place_beside_dump(file, path)
      !> Name without folder
      character(len=*), intent(in) :: file
      !> Path with folder
      character(len=:), allocatable, intent(out) :: path

      !$omp critical (contact_registry)
      path = library%dump_folder // file
      !$omp end critical (contact_registry)
   end subroutine place_beside_dump

   !> Convert a file name of the caller to one that is valid in the input file that is written
   subroutine relate_to_dump(name, path)
      !> Unchanged if absolute, or if the file is in the folder of the input file or below
      character(len=:), allocatable, intent(inout) :: name
      !> Full path of the file when it was read: the caller may have changed the current folder since
      character(len=*), intent(in) :: path

      if (name(:1) == "/") return
      !$omp critical (contact_registry)
      if (len(library%out_folder) > 0 .or. library%dump_folder // name /= path) name = path
      !$omp end critical (contact_registry)
   end subroutine relate_to_dump
end module contact_capi_files
