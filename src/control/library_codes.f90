!> Numbers exchanged with callers of the library: error codes, kinds of input files
module contact_control_library_codes
   use contact_base_case_status, only : case_status, missed_iteration
   implicit none (type, external)
   private

   public :: code_of_contact, code_of_wheel_rail
   public :: library_code, code_text, input_type, interface_version

   !> Version returned by the initialisation, 100 major + 10 minor + update of the published interface
   integer, parameter :: interface_version = 2520

   type :: library_code_list
      integer :: success = 0
      !> The problem is in use by another thread
      integer :: in_use = 305
      !> The maximum number of result elements is exceeded
      integer :: not_allowed = -12
      integer :: search = -25, total_force = -26, normal = -27, tangential = -28, tolerance = -29
      integer :: no_patch = -31, profile = -32, friction = -33, discretisation = -34, input_file = -39, other = -99
      !> Invalid call: result element; module 1 or 3 required; patch number out of range, missing or not allowed
      integer :: bad_element = -101, not_module_1 = -102, not_module_3 = -103, bad_patch = -104
      integer :: patch_needed = -105, patch_unwanted = -106
   end type library_code_list
   !> Codes returned by routines with an error argument
   type(library_code_list), parameter :: library_code = library_code_list()

   type :: input_type_list
      integer :: module_1 = 1988, simpack = 1990
   end type input_type_list
   !> Kinds of files that can be read
   type(input_type_list), parameter :: input_type = input_type_list()

contains

   !> Code of a contact problem (module 3) with a result, by its status
   pure integer function code_of_contact(status) result(code)
      type(case_status), intent(in) :: status

      code = library_code%success
      if (status%is_solved()) return
      code = library_code%tangential
      if (status%iteration == missed_iteration%normal) code = library_code%normal
   end function code_of_contact

   !> Code of wheel and rail (module 1) with a result, by its status
   !>
   !> The published interface has no code for patches that did not converge, nor for a wheel beside the rail that cannot reach its
   !> force: contact_case_status reports them.
   pure integer function code_of_wheel_rail(status, patches) result(code)
      type(case_status), intent(in) :: status
      !> Number of contact patches
      integer, intent(in) :: patches

      code = library_code%success
      if (status%iteration == missed_iteration%force .and. patches > 0) code = library_code%tolerance
   end function code_of_wheel_rail

   !> Description of a code
   pure function code_text(code) result(text)
      !> Member of library_code
      integer, intent(in) :: code
      character(len=100) :: text

      select case (code)
      case (library_code%success); text = "success"
      case (library_code%in_use); text = "the problem is in use by another thread"
      case (library_code%not_allowed); text = "more result elements at once than are possible"
      case (library_code%search); text = "the contact search failed"
      case (library_code%total_force); text = "the iteration for the total force failed"
      case (library_code%normal); text = "the normal problem did not converge"
      case (library_code%tangential); text = "the tangential problem did not converge"
      case (library_code%tolerance); text = "the iteration for the total force stopped above its tolerance"
      case (library_code%no_patch); text = "there is no contact patch with this number"
      case (library_code%profile); text = "a profile is missing or cannot be used"
      case (library_code%friction); text = "the friction data cannot be used"
      case (library_code%discretisation); text = "the grid does not fit the one of the previous case"
      case (library_code%input_file); text = "the input file cannot be used"
      case (library_code%other); text = "the calculation failed"
      case (library_code%bad_element); text = "the number of a result element must be 1 to 999"
      case (library_code%not_module_1); text = "the routine is for contact problems (module 3), the result element is " // &
         & "for wheel and rail (module 1)"
      case (library_code%not_module_3); text = "the routine is for wheel and rail (module 1), the result element is for " // &
         & "contact problems (module 3)"
      case (library_code%bad_patch); text = "the number of a contact patch must be 1 to 9; -1 means wheel and rail as a whole"
      case (library_code%patch_needed); text = "the routine needs the number of a contact patch"
      case (library_code%patch_unwanted); text = "the routine works on wheel and rail as a whole, with -1 for the contact patch"
      case default; text = "elements in contact at the border of the potential contact area"
      end select
   end function code_text
end module contact_control_library_codes
