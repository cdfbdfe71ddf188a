!> Names of files that a case reads: none may be that of a result of the same run
module contact_experiment_input_names
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_system, only : is_same_file
   use contact_experiment_journal, only : journal_name
   use contact_experiment_lock, only : is_leftover_rest, lock_suffix
   use contact_experiment_place, only : experiment_place, written_in_place
   use contact_input_experiment_file, only : experiment_reader, input_case
   use contact_text_words, only : replaced
   use contact_wheelrail_spec, only : profile_spec
   implicit none (type, external)
   private

   public :: refuse_result_names

   !> Message about a file with the name of a result, after that name
   character(len=*), parameter :: reason = " is the name of a result of this experiment, which would replace it; rename the &
      &file or the experiment, or choose another folder by --output-dir"

contains

   !> Refuse profiles and files of influence coefficients that the run would overwrite with its results
   !>
   !> All cases are read for this purpose if the text of the input contains the name of the experiment before a dot or "_re".
   subroutine refuse_result_names(reader, place, error)
      !> The input, at its beginning
      type(experiment_reader), intent(in) :: reader
      !> Names of the experiment and of its folders
      type(experiment_place), intent(in) :: place
      type(error_type), allocatable, intent(out) :: error
      type(experiment_reader) :: copy
      type(input_case) :: this
      type(error_type), allocatable :: unreadable
      character(len=:), allocatable :: text

      call reader%lexer%get_text(text)
      if (index(text, place%name // ".") == 0 .and. index(text, place%name // "_re") == 0) return
      copy = reader
      do
         call copy%next_case(this, unreadable)
         ! the error is reported by the run itself
         if (allocated(unreadable) .or. this%module_number == 0) return
         if (allocated(this%spec%wheel_rail)) then
            call refuse_profile(this%spec%wheel_rail%rail_profile, place, error)
            if (allocated(error)) return
            call refuse_profile(this%spec%wheel_rail%wheel_profile, place, error)
            if (allocated(error)) return
         end if
         if (.not. allocated(this%spec%material%cfname)) cycle
         if (.not. is_result(this%spec%material%cfname, place)) cycle
         call fatal_error(error, message(this%spec%material%cfname), error_kind%input, place%input, this%first_line)
         return
      end do
   end subroutine refuse_result_names

   !> Refuse a profile that has the name of a result
   subroutine refuse_profile(profile, place, error)
      type(profile_spec), intent(in) :: profile
      type(experiment_place), intent(in) :: place
      type(error_type), allocatable, intent(out) :: error

      if (.not. allocated(profile%name)) return
      if (is_result(profile%name, place)) call fatal_error(error, message(profile%name), error_kind%input, place%input, &
         & profile%line, profile%column)
   end subroutine refuse_profile

   !> Does a name in the input lead to a file that a run of the experiment writes or deletes?
   logical function is_result(name, place)
      !> Path, relative to the folder of the input
      character(len=*), intent(in) :: name
      type(experiment_place), intent(in) :: place
      character(len=:), allocatable :: path, rest
      integer :: last

      path = trim(replaced(name, "\", "/"))
      if (index(path, "/") /= 1) path = place%folder // path
      last = index(path, "/", back=.true.)
      rest = path(last + 1:)
      is_result = index(rest, place%name // ".") == 1 .or. index(rest, place%name // "_re") == 1
      if (.not. is_result) return
      rest = rest(len(place%name) + 1:)
      ! results of a case have the same names with and without the suffix of an incomplete file
      is_result = any(rest == written_in_place) .or. rest == lock_suffix .or. rest == journal_name("") &
         & .or. is_leftover_rest(rest) .or. is_leftover_rest(rest // ".tmp")
      if (is_result) is_result = is_same_file(path(:last) // ".", place%results(:len(place%results) - len(place%name)) // ".")
   end function is_result

   !> The whole message
   pure function message(name) result(text)
      !> Name in the input
      character(len=*), intent(in) :: name
      character(len=len_trim(name) + len(reason)) :: text

      text = trim(name) // reason
   end function message
end module contact_experiment_input_names
