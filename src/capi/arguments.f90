!> Arguments of C callers: absent ones, arbitrary lengths, texts without a length
!>
!> A null pointer of C is an absent optional argument here. Absent arguments have no elements and no value, so that no entry needs
!> to inspect pointers.
module contact_capi_arguments
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_double, c_f_pointer, c_int, c_null_char, c_ptr, c_size_t
   use contact_base_kinds, only : wp
   use contact_text_words, only : replaced
   implicit none (type, external)
   private

   public :: no_number, integer_of, real_of, path_of, integers_of, raised, set_argument, set_message, copy_text

   !> Value of an integer that was not given; no code, index or count is as large
   integer, parameter :: no_number = -huge(1)
   !> Status of a call with unusable arguments; failures start after first_failure, by their error_kind
   integer(c_int), parameter, public :: wrong_call = 1, first_failure = 10
   !> Maximum length of a file name
   integer, parameter :: longest_path = 256

   interface
      !> Length of a null-terminated text
      function c_strlen(text) result(length) bind(c, name="strlen")
         import :: c_ptr, c_size_t
         type(c_ptr), value :: text
         integer(c_size_t) :: length
      end function c_strlen
   end interface

contains

   !> Value of an integer argument, no_number if absent
   pure integer function integer_of(argument) result(value)
      !> Absent if the caller gave a null pointer
      integer(c_int), intent(in), optional :: argument

      value = no_number
      if (present(argument)) value = argument
   end function integer_of

   !> Value of a real argument, NaN if absent
   pure real(wp) function real_of(argument) result(value)
      !> Absent if the caller gave a null pointer
      real(c_double), intent(in), optional :: argument

      value = ieee_value(1.0_wp, ieee_quiet_nan)
      if (present(argument)) value = argument
   end function real_of

   !> Usable length of an array: 0 if negative, or if length or array are absent
   pure integer function count_of(length, is_there) result(n)
      !> Number of elements according to the caller
      integer(c_int), intent(in), optional :: length
      !> Was the array itself given?
      logical, intent(in) :: is_there

      n = 0
      if (present(length) .and. is_there) n = max(0, length)
   end function count_of

   !> Name of a file or folder, with the separators of this platform, and blanks only at the end
   !>
   !> It ends at its length, at a null character or after 256 characters.
   pure function path_of(letters, length) result(path)
      !> Characters of the caller, with or without a terminating null
      character(kind=c_char), intent(in), optional :: letters(*)
      !> Number of characters according to the caller; absent: the text ends at the null
      integer(c_int), intent(in), optional :: length
      character(len=longest_path) :: path
      integer :: i

      path = ""
      do i = 1, min(longest_path, count_of(length, present(letters)))
         if (letters(i) == c_null_char) exit
         path(i:i) = letters(i)
      end do
      path = replaced(adjustl(path), "\", "/")
   end function path_of

   !> Elements of an array of integers
   pure function integers_of(length, array) result(list)
      !> Number of elements, and the elements
      integer(c_int), intent(in), optional :: length, array(*)
      integer, allocatable :: list(:)

      allocate(list(count_of(length, present(array))))
      if (size(list) > 0) list = array(:size(list))
   end function integers_of

   !> Raise values that are too small for the models to the minimum; negative values and NaN are unchanged and left to the check of
   !> bounds
   elemental real(wp) function raised(value, least)
      !> Value given by the caller, and minimum accepted by the models; in the same unit
      real(wp), intent(in) :: value, least

      raised = value
      if (value >= 0.0_wp) raised = max(least, value)
   end function raised

   !> Return one integer
   pure subroutine set_argument(value, argument)
      !> Value to be returned
      integer, intent(in) :: value
      !> Argument that receives it, if present
      integer(c_int), intent(inout), optional :: argument

      if (present(argument)) argument = int(value, c_int)
   end subroutine set_argument

   !> Convert a null-terminated text to a Fortran text, "" for a null pointer
   subroutine copy_text(pointer, text)
      !> Text of the caller
      type(c_ptr), intent(in) :: pointer
      !> Text without the null
      character(len=:), allocatable, intent(out) :: text
      character(kind=c_char), pointer :: letters(:)
      integer :: i

      text = ""
      if (.not. c_associated(pointer)) return
      call c_f_pointer(pointer, letters, [c_strlen(pointer)])
      text = repeat(" ", size(letters))
      do i = 1, size(letters)
         text(i:i) = letters(i)
      end do
   end subroutine copy_text

   !> Copy a text to the buffer of the caller, truncated to its size and null-terminated
   subroutine set_message(text, buffer, length)
      !> Text of one line
      character(len=*), intent(in) :: text
      !> Buffer; null if no text is requested
      type(c_ptr), intent(in) :: buffer
      !> Size of the buffer, including the terminating null
      integer(c_int), intent(in) :: length
      character(kind=c_char), pointer :: letters(:)
      integer :: i, n

      if (.not. c_associated(buffer) .or. length < 1) return
      call c_f_pointer(buffer, letters, [length])
      n = min(len(text), int(length) - 1)
      do i = 1, n
         letters(i) = text(i:i)
      end do
      letters(n + 1) = c_null_char
   end subroutine set_message
end module contact_capi_arguments
