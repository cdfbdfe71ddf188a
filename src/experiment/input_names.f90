!> Names of files that a case reads: none may lead to a file that the same run writes
module contact_experiment_input_names
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_system, only : find_real_path, is_same_file
   use contact_experiment_journal, only : journal_name
   use contact_experiment_lock, only : is_leftover_rest, lock_suffix
   use contact_experiment_place, only : experiment_place, written_in_place
   use contact_input_experiment_file, only : experiment_reader, input_case
   use contact_profile_prepare, only : is_slices_file
   use contact_profile_slices_file, only : resolve_path
   use contact_text_lexer, only : input_lexer
   use contact_text_words, only : replaced
   use contact_wheelrail_spec, only : profile_spec
   implicit none (type, external)
   private

   public :: refuse_result_names

   !> Message about a file with the name of a result, after that name
   character(len=*), parameter :: reason = " is the name of a result of this experiment, which would replace it; rename the &
      &file or the experiment, or choose another folder by --output-dir"
   !> The same for a name that leads to a result by a link
   character(len=*), parameter :: linked = " leads by a link to a result of this experiment, which would replace it; remove the &
      &link, or choose another folder by --output-dir"

   !> How a name is related to the results of a run
   integer, parameter :: unrelated = 0, by_name = 1, by_link = 2

   !> A text in quotes, of the input
   type :: quoted_text
      character(len=:), allocatable :: text
   end type quoted_text

contains

   !> Refuse profiles, slices and files of influence coefficients that the run would overwrite with its results
   !>
   !> All cases are read for this purpose only if a text in quotes in the input, or in a slices file that it names, leads to a
   !> result.
   subroutine refuse_result_names(reader, place, confined, error)
      !> The input, at its beginning
      type(experiment_reader), intent(in) :: reader
      !> Names of the experiment and of its folders
      type(experiment_place), intent(in) :: place
      !> May the run read files below the folder of the input only?
      logical, intent(in) :: confined
      type(error_type), allocatable, intent(out) :: error
      type(experiment_reader) :: copy
      type(input_case) :: this
      type(error_type), allocatable :: unreadable
      character(len=:), allocatable :: path
      integer :: relation

      if (.not. may_read_results(reader%lexer, place, confined)) return
      copy = reader
      do
         call copy%next_case(this, unreadable)
         ! the error is reported by the run itself
         if (allocated(unreadable) .or. this%module_number == 0) return
         if (allocated(this%spec%wheel_rail)) then
            call refuse_profile(this%spec%wheel_rail%rail_profile, place, confined, error)
            if (allocated(error)) return
            call refuse_profile(this%spec%wheel_rail%wheel_profile, place, confined, error)
            if (allocated(error)) return
         end if
         if (.not. allocated(this%spec%material%cfname)) cycle
         call locate(this%spec%material%cfname, place, path)
         relation = relation_of(path, place)
         if (relation == unrelated) cycle
         call refuse(this%spec%material%cfname, relation, error, place%input, this%first_line, 0)
         return
      end do
   end subroutine refuse_result_names

   !> Refuse a profile that leads to a result, and slices files with such a slice
   subroutine refuse_profile(profile, place, confined, error)
      type(profile_spec), intent(in) :: profile
      type(experiment_place), intent(in) :: place
      logical, intent(in) :: confined
      type(error_type), allocatable, intent(out) :: error
      type(input_lexer) :: slices
      character(len=:), allocatable :: path
      integer :: relation, line

      if (.not. allocated(profile%name)) return
      call locate(profile%name, place, path)
      relation = relation_of(path, place)
      if (relation /= unrelated) then
         call refuse(profile%name, relation, error, place%input, profile%line, profile%column)
         return
      end if
      if (.not. is_slices_file(profile%name)) return
      call open_slices(path, place, confined, slices)
      call find_result(slices, place, path, line, relation)
      if (relation /= unrelated) call refuse(path, relation, error, slices%file, line, 0)
   end subroutine refuse_profile

   !> Could a file that the input names be a result?
   logical function may_read_results(text, place, confined) result(may)
      type(input_lexer), intent(in) :: text
      type(experiment_place), intent(in) :: place
      logical, intent(in) :: confined
      !> Names that are remembered, since cases often repeat them
      integer, parameter :: most = 8
      type(quoted_text) :: seen(most)
      type(input_lexer) :: slices
      character(len=:), allocatable :: name, path
      integer :: k, n, from, line, relation

      may = .true.
      n = 0
      do k = 1, text%count_lines()
         from = 1
         do
            call next_quoted(text%line_text(k), from, name)
            if (.not. allocated(name)) exit
            if (is_seen(name)) cycle
            seen(1 + mod(n, most))%text = name
            n = n + 1
            call locate(name, place, path)
            if (relation_of(path, place) /= unrelated) return
            if (.not. is_slices_file(path)) cycle
            call open_slices(path, place, confined, slices)
            call find_result(slices, place, path, line, relation)
            if (relation /= unrelated) return
         end do
      end do
      may = .false.

   contains

      logical function is_seen(text)
         character(len=*), intent(in) :: text
         integer :: i

         is_seen = .true.
         do i = 1, min(n, most)
            if (seen(i)%text == text) return
         end do
         is_seen = .false.
      end function is_seen
   end function may_read_results

   !> The first text in quotes in a slices file that leads to a result
   subroutine find_result(slices, place, path, line, relation)
      type(input_lexer), intent(in) :: slices
      type(experiment_place), intent(in) :: place
      !> Path of the slice, and its line in the slices file
      character(len=:), allocatable, intent(out) :: path
      integer, intent(out) :: line
      !> Member of unrelated, by_name, by_link
      integer, intent(out) :: relation
      character(len=:), allocatable :: name
      integer :: from

      relation = unrelated
      do line = 1, slices%count_lines()
         from = 1
         do
            call next_quoted(slices%line_text(line), from, name)
            if (.not. allocated(name)) exit
            call resolve_path(slices%file, name, path)
            relation = relation_of(path, place)
            if (relation /= unrelated) return
         end do
      end do
   end subroutine find_result

   !> The text of a slices file; no lines if it cannot be read, which is reported when it is used
   subroutine open_slices(path, place, confined, slices)
      character(len=*), intent(in) :: path
      type(experiment_place), intent(in) :: place
      logical, intent(in) :: confined
      type(input_lexer), intent(out) :: slices
      type(error_type), allocatable :: unreadable

      if (confined) then
         call slices%open_file(path, unreadable, place%folder)
      else
         call slices%open_file(path, unreadable)
      end if
      if (allocated(unreadable)) call slices%open_text("", path)
   end subroutine open_slices

   !> Next text in single or double quotes of a line, comments included
   pure subroutine next_quoted(line, from, text)
      character(len=*), intent(in) :: line
      !> Position to start from; on return that behind the text
      integer, intent(inout) :: from
      !> The text, not empty; unallocated if there is no other one
      character(len=:), allocatable, intent(out) :: text
      integer :: first, length

      do
         length = scan(line(from:), "'""") - 1
         if (length < 0) return
         first = from + length + 1
         length = index(line(first:), line(first - 1:first - 1)) - 1
         if (length < 0) return
         from = first + length + 1
         if (length == 0) cycle
         text = line(first:first + length - 1)
         return
      end do
   end subroutine next_quoted

   !> Path of a file, given by its name in the input
   pure subroutine locate(name, place, path)
      !> Relative to the folder of the input
      character(len=*), intent(in) :: name
      type(experiment_place), intent(in) :: place
      character(len=:), allocatable, intent(out) :: path

      path = trim(replaced(name, "\", "/"))
      if (index(path, "/") /= 1) path = place%folder // path
   end subroutine locate

   !> Does a path lead to a file that a run of the experiment writes or deletes, by its name or by a link on either side?
   integer function relation_of(path, place) result(relation)
      character(len=*), intent(in) :: path
      type(experiment_place), intent(in) :: place
      character(len=:), allocatable :: real_path
      integer :: k

      relation = by_name
      if (is_result_name(path, place)) return
      relation = by_link
      call find_real_path(path, real_path)
      if (len(real_path) > 0) then
         if (is_result_name(real_path, place)) return
         if (is_same_file(path, journal_name(place%results))) return
         do k = 1, size(written_in_place)
            if (is_same_file(path, place%results // trim(written_in_place(k)))) return
         end do
      end if
      relation = unrelated
   end function relation_of

   !> Has a path the name of a file that a run of the experiment writes or deletes?
   logical function is_result_name(path, place) result(is_result)
      character(len=*), intent(in) :: path
      type(experiment_place), intent(in) :: place
      character(len=:), allocatable :: rest
      integer :: last

      last = index(path, "/", back=.true.)
      rest = path(last + 1:)
      is_result = index(rest, place%name // ".") == 1 .or. index(rest, place%name // "_re") == 1
      if (.not. is_result) return
      rest = rest(len(place%name) + 1:)
      ! results of a case have the same names with and without the suffix of an incomplete file
      is_result = any(rest == written_in_place) .or. rest == lock_suffix .or. rest == journal_name("") &
         & .or. is_leftover_rest(rest) .or. is_leftover_rest(rest // ".tmp")
      if (is_result) is_result = is_same_file(path(:last) // ".", place%results(:len(place%results) - len(place%name)) // ".")
   end function is_result_name

   !> Refuse a file that leads to a result
   subroutine refuse(name, relation, error, file, line, column)
      !> Name in the input
      character(len=*), intent(in) :: name
      !> by_name or by_link
      integer, intent(in) :: relation
      type(error_type), allocatable, intent(out) :: error
      !> Where the name is
      character(len=*), intent(in) :: file
      integer, intent(in) :: line, column

      if (relation == by_name) then
         call fatal_error(error, trim(name) // reason, error_kind%input, file, line, column)
      else
         call fatal_error(error, trim(name) // linked, error_kind%input, file, line, column)
      end if
   end subroutine refuse
end module contact_experiment_input_names
