!> Arguments of C callers: absent ones, lengths that may be anything, texts without a length
!>
!> A null pointer of C is an absent optional argument here. What is absent has no elements and no
!> value, so that no entry has to look at pointers itself.
module contact_capi_arguments
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_double, c_f_pointer, c_int, c_null_char, c_ptr, c_size_t
   use contact_base_kinds, only : wp
   use contact_text_words, only : replaced
   implicit none (type, external)
   private

   public :: no_number, integer_of, real_of, path_of, integers_of, raised, give, give_message, take_text

   !> Stands for an integer that was not given; no code, index or count is that large
   integer, parameter :: no_number = -huge(1)
   !> Status of a call with unusable arguments; failures by their error_kind start behind first_failure
   integer(c_int), parameter, public :: wrong_call = 1, first_failure = 10
   !> Longest name of a file that is copied
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

   !> An integer, or no_number
   pure integer function integer_of(argument) result(value)
      !> Not present where the caller gave a null pointer
      integer(c_int), intent(in), optional :: argument

      value = no_number
      if (present(argument)) value = argument
   end function integer_of

   !> A number, not a number when it was not given
   pure real(wp) function real_of(argument) result(value)
      !> Not present where the caller gave a null pointer
      real(c_double), intent(in), optional :: argument

      value = ieee_value(1.0_wp, ieee_quiet_nan)
      if (present(argument)) value = argument
   end function real_of

   !> Length of an array that is usable: 0 when negative or when length or array are absent
   pure integer function count_of(length, is_there) result(n)
      !> Elements that the caller says there are
      integer(c_int), intent(in), optional :: length
      !> Was the array itself given?
      logical, intent(in) :: is_there

      n = 0
      if (present(length) .and. is_there) n = max(0, length)
   end function count_of

   !> The name of a file or folder, with the separators of this platform and blanks behind only
   !>
   !> It ends at its length, a null character or 256 letters.
   pure function path_of(letters, length) result(path)
      !> As the caller has them, with or without a null at the end
      character(kind=c_char), intent(in), optional :: letters(*)
      !> Letters that the caller says there are; the null ends the text where it is absent
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

   !> The elements of an array of integers
   pure function integers_of(length, array) result(list)
      !> Number of elements, and the elements
      integer(c_int), intent(in), optional :: length, array(*)
      integer, allocatable :: list(:)

      allocate(list(count_of(length, present(array))))
      if (size(list) > 0) list = array(:size(list))
   end function integers_of

   !> What is too small for the models becomes the smallest value; what is negative or not a number stays for the check of bounds
   elemental real(wp) function raised(value, least)
      !> What a caller gave, and the smallest number that the models take; the same unit
      real(wp), intent(in) :: value, least

      raised = value
      if (value >= 0.0_wp) raised = max(least, value)
   end function raised

   !> Hand over one integer
   pure subroutine give(value, argument)
      !> What is handed over
      integer, intent(in) :: value
      !> Where it goes, if anywhere
      integer(c_int), intent(inout), optional :: argument

      if (present(argument)) argument = int(value, c_int)
   end subroutine give

   !> A null-terminated text as a Fortran one, "" for a null pointer
   subroutine take_text(pointer, text)
      !> From the caller
      type(c_ptr), intent(in) :: pointer
      !> Without the null
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
   end subroutine take_text

   !> Copy a text into the buffer of the caller, cut to fit and null-terminated
   subroutine give_message(text, buffer, length)
      !> In one line
      character(len=*), intent(in) :: text
      !> Null where no text is wanted
      type(c_ptr), intent(in) :: buffer
      !> Size of the buffer, the final null included
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
   end subroutine give_message
end module contact_capi_arguments
