!> Warning about contact that is only a few elements wide
module contact_cases_resolution_warning
   use contact_base_log, only : log_type
   use contact_patch_resolution, only : elements_across, enough_elements, enough_sides, is_coarse
   use contact_patch_result, only : patch_result
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: warn_of_few_elements

contains

   !> Warn of a contact with less than the recommended number of elements across
   subroutine warn_of_few_elements(result, name_y, log, patch)
      !> Solution
      type(patch_result), intent(in) :: result
      !> Name of the lateral size of elements in the input: DY, or DS of wheel and rail
      character(len=*), intent(in) :: name_y
      type(log_type), intent(inout) :: log
      !> Index of the contact patch of wheel and rail; absent for module 3
      integer, intent(in), optional :: patch
      character(len=:), allocatable :: text
      character(len=12) :: sides(2)
      integer :: across(2)

      if (.not. is_coarse(result)) return
      across = max(1, elements_across(result%division))
      write(sides, "(G0.3)") enough_sides(result)
      text = "contact is " // integer_text(across(1)) // " x " // integer_text(across(2)) // " elements wide at most. With &
         &fewer than " // integer_text(enough_elements) // " its area, forces and pressures are rough; about ten would be &
         &there with DX = " // trim(sides(1)) // ", " // name_y // " = " // trim(sides(2)) // " mm"
      if (present(patch)) text = "contact patch " // integer_text(patch) // ": " // text
      call log%warning(text)
   end subroutine warn_of_few_elements
end module contact_cases_resolution_warning
