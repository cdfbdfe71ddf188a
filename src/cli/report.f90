!> Commands contact report, study and table: find Python and its package, and pass the rest of the command line to it
module contact_cli_report
   use, intrinsic :: iso_c_binding, only : c_char, c_null_char, c_size_t
   use, intrinsic :: iso_fortran_env, only : error_unit
   use contact_cli_command_line, only : get_word
   use contact_cli_process, only : replace_process, set_variable, word_type
   implicit none (type, external)
   private

   public :: is_report, run_report

   !> Environment variable with the folder of the Python package `contact`, if it is not found in the folder of the program
   character(len=*), parameter :: variable = "CONTACT_PYTHON"
   character(len=*), parameter :: package_file = "/contact/__init__.py"
   !> Commands implemented in Python; each is a part of the package with the same name
   character(len=8), parameter :: commands(3) = [character(len=8) :: "report", "study", "table"]
   !> Relative to the folder of the program: installed, and in the build folder of a checkout
   character(len=*), parameter :: usual_places(3) = [character(len=26) :: "/../share/contact/python", "/../../../python", &
      & "/../../python"]
   !> Runs the part of the package named by the first argument, from the folder given by the second one, or if it is empty from
   !> where Python finds it
   character(len=*), parameter :: start = "import importlib, sys" // new_line("a") &
      & // "part, place = sys.argv.pop(1), sys.argv.pop(1)" // new_line("a") &
      & // "sys.path[:1] = [place] if place else []" // new_line("a") &
      & // "try:" // new_line("a") &
      & // "    main = importlib.import_module('contact.%s.__main__' % part).main" // new_line("a") &
      & // "except ModuleNotFoundError as missing:" // new_line("a") &
      & // "    if not (missing.name or '').startswith('contact'):" // new_line("a") &
      & // "        sys.exit('contact %s: the Python package %s is not found; it comes with: python3 -m pip install " &
      & // "SOURCES/python[%s]' % (part, missing.name, part))" // new_line("a") &
      & // "    sys.exit('contact %s: the Python package contact.%s is not found (%s). It is in the folder python of " &
      & // "the sources and is\ninstalled with the program; name its folder by the environment variable " // variable &
      & // ", or: python3 -m pip install SOURCES/python' % (part, part, missing))" // new_line("a") &
      & // "sys.exit(main())"

   interface
      !> readlink of the C library
      function c_readlink(path, buffer, length) result(used) bind(c, name="readlink")
         import :: c_char, c_size_t
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: length
         integer(c_size_t) :: used
      end function c_readlink
   end interface

contains

   !> Is the first word of the command line a command implemented in Python?
   logical function is_report()
      character(len=8) :: word

      is_report = .false.
      if (command_argument_count() < 1) return
      call get_command_argument(1, word)
      is_report = any(word == commands)
   end function is_report

   !> Run a command implemented in Python, which replaces this program, so that ending it ends the page server. Returns an exit
   !> status only if there is no Python.
   integer function run_report() result(status)
      character(len=:), allocatable :: place, program_name
      type(word_type), allocatable :: words(:)
      integer :: k

      call find_program(program_name)
      call find_package(program_name, place)
      if (len(program_name) > 0) call set_variable("CONTACT_PROGRAM", program_name)
      allocate(words(command_argument_count() + 4))
      words(1)%text = "python3"
      words(2)%text = "-c"
      words(3)%text = start
      call get_word(1, words(4)%text)
      words(5)%text = place
      do k = 2, command_argument_count()
         call get_word(k, words(k + 4)%text)
      end do
      call replace_process(words)
      if (words(4)%text == "report") then
         write(error_unit, "(A)") "contact report: Python 3 is not found; install it together with NumPy and h5py " &
            & // "(apt-get install python3-h5py)"
      else
         write(error_unit, "(A)") "contact " // words(4)%text // ": Python 3 is not found; install it, and then the packages for " &
            & // "studies: python3 -m pip install 'SOURCES/python[study]'"
      end if
      status = 1
   end function run_report

   !> Folder that contains the package, "" if there is none
   subroutine find_package(program_name, place)
      !> Path of the program, "" if unknown
      character(len=*), intent(in) :: program_name
      character(len=:), allocatable, intent(out) :: place
      character(len=4096) :: named
      integer :: k, length
      logical :: is_there

      call get_environment_variable(variable, named, length)
      if (length > 0 .and. length <= len(named)) then
         place = named(:length)
         inquire(file=place // package_file, exist=is_there)
         if (is_there) return
      end if
      do k = 1, size(usual_places)
         if (len(program_name) == 0) exit
         place = program_name(:index(program_name, "/", back=.true.) - 1) // trim(usual_places(k))
         inquire(file=place // package_file, exist=is_there)
         if (is_there) return
      end do
      place = ""
   end subroutine find_package

   !> Path of this program, "" if the system does not provide it
   subroutine find_program(path)
      character(len=:), allocatable, intent(out) :: path
      character(len=4096) :: buffer
      integer(c_size_t) :: used

      path = ""
      used = c_readlink("/proc/self/exe" // c_null_char, buffer, int(len(buffer), c_size_t))
      if (used > 0 .and. used < len(buffer)) then
         path = buffer(:used)
         return
      end if
      call get_command_argument(0, buffer)
      if (index(buffer, "/") > 0) path = trim(buffer)
   end subroutine find_program
end module contact_cli_report
