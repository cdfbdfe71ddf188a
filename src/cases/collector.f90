!> Archive that collects the names and values of a group, for tables and to count them
module contact_cases_collector
   use contact_base_choices, only : variation
   use contact_base_kinds, only : wp
   use contact_cases_archive, only : case_archive
   use contact_cases_inputs, only : visit_friction_memory, visit_friction_set
   use contact_friction_law, only : friction_set
   use contact_cases_spec, only : friction_spec
   implicit none (type, external)
   private

   public :: collector, friction_numbers

   !> Maximum length of a name
   integer, parameter, public :: collected_length = 13

   !> Names and values so far; texts are not included
   type, extends(case_archive) :: collector
      !> Names as in the input files; the values of a list have the same name
      character(len=collected_length), allocatable :: names(:)
      !> Values in internal units
      real(wp), allocatable :: values(:)
   contains
      procedure :: end_line => collect_line
      procedure :: list => collect_list
   end type collector

contains

   !> Values of one set of friction parameters, and those of the friction memory
   subroutine friction_numbers(a, law, set, memory)
      !> Empty on entry
      type(collector), intent(inout) :: a
      !> Member of friction_model; other numbers have no values
      integer, intent(in) :: law
      type(friction_set), intent(in) :: set
      !> Friction with its memory, if the law has one; absent: without memory
      type(friction_spec), intent(in), optional :: memory
      type(friction_set), target :: here
      type(friction_spec), target :: copy

      here = set
      call visit_friction_set(a, law, variation%none, here)
      if (.not. present(memory)) return
      copy%memdst = memory%memdst
      copy%mem_s0 = memory%mem_s0
      call visit_friction_memory(a, law, copy)
   end subroutine friction_numbers

   !> Store the current items
   subroutine collect_line(self)
      class(collector), intent(inout) :: self
      character(len=collected_length) :: names(self%count)
      real(wp) :: values(self%count)
      integer :: k, n

      n = 0
      do k = 1, self%count
         associate (item => self%items(k))
            if (.not. (associated(item%r) .or. associated(item%i))) cycle
            n = n + 1
            names(n) = item%name
            if (associated(item%r)) values(n) = item%r
            if (associated(item%i)) values(n) = real(item%i, wp)
         end associate
      end do
      call keep(self, names(:n), values(:n))
      call self%finish_line()
   end subroutine collect_line

   !> Store a list
   subroutine collect_list(self, name, values, n, units, bounds)
      class(collector), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: n
      character(len=*), intent(in), optional :: units(:)
      character(len=*), intent(in), optional :: bounds

      associate (unused => n, no_units => present(units), no_bounds => present(bounds))
      end associate
      if (allocated(values)) call keep(self, spread(name, 1, size(values)), values)
   end subroutine collect_list

   !> Append names and values
   subroutine keep(self, names, values)
      class(collector), intent(inout) :: self
      character(len=*), intent(in) :: names(:)
      real(wp), intent(in) :: values(:)

      if (.not. allocated(self%values)) allocate(self%values(0), self%names(0))
      self%names = [character(len=collected_length) :: self%names, names]
      self%values = [self%values, values]
   end subroutine keep
end module contact_cases_collector
