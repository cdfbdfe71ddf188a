!> An input file as a sequence of cases: module lines, result elements, stored input
module contact_input_experiment_file
   use contact_base_error, only : add_context, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_control_digits, only : case_digits
   use contact_grid_potential_contact, only : potential_contact
   use contact_input_problems, only : problem_list, severity
   use contact_input_reader, only : read_case
   use contact_input_toml_case, only : read_toml_case
   use contact_input_toml_cases, only : case_address, toml_cases
   use contact_input_toml_tables, only : toml_memory
   use contact_text_lexer, only : input_lexer, input_value
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: experiment_reader, input_case, is_readable_format

   !> Maximum of the numbers on the module line; maximum number of different result elements
   integer, parameter :: highest_element = 999, highest_patch = 9, max_elements = 100

   !> One case as read from the file
   type, extends(case_address) :: input_case
      !> Number of the case within its result element and patch, from 1
      integer :: number = 0
      !> Digits as in the file
      type(case_digits) :: digits
      type(case_spec) :: spec
      !> Problems of its values
      type(problem_list) :: problems
   end type input_case

   !> Data of the cases of one module, stored for a result element
   type :: element_store
      integer :: module_number = 0, reid = 0, cpid = 1
      !> Number of cases of this module read so far
      integer :: cases = 0
      !> The previous case
      type(case_spec) :: spec
      !> Grid for which influence coefficients were last computed
      type(potential_contact) :: coefficients
      !> Keys given by its cases, in the readable format
      type(toml_memory) :: memory
   end type element_store

   !> An input file with the stored data of its result elements
   type :: experiment_reader
      !> Text of the file
      type(input_lexer) :: lexer
      !> Current module of the reader; 0 if a module line comes next
      integer, private :: module_number = 0
      !> Index of the current store
      integer, private :: current = 0
      !> Stores in the order of their first use
      integer, private :: count = 0
      type(element_store), allocatable, private :: stores(:)
      !> Cases of the readable format; unallocated for the other format
      type(toml_cases), allocatable, private :: cases
      !> Case whose numbers are varied, and the nodes of these numbers
      type(case_address), private :: varied
      integer, allocatable, private :: varied_numbers(:)
      !> Has it been read without a problem before?
      logical, private :: is_repeat = .false.
   contains
      !> Read a file from disk
      procedure :: open_file => open_experiment
      !> Read a text in memory
      procedure :: open_text => open_experiment_text
      procedure :: open_readable => open_readable_text
      !> Return to the beginning of the text
      procedure :: rewind => rewind_experiment
      !> Read the next case
      procedure :: next_case
      !> Advance to the next case of the readable format and find numbers that it gives; read it with other values of these numbers
      procedure :: prepare_variation
      procedure :: read_variation
      !> Replace the stored input of the case that was read last
      procedure :: store_case
      procedure, private :: next_readable_case
      procedure, private :: read_module_line
      procedure, private :: select_store
      procedure, private :: next_number
   end type experiment_reader

contains

   !> Read a file from disk
   subroutine open_experiment(self, file, error, below)
      class(experiment_reader), intent(out) :: self
      !> Path
      character(len=*), intent(in) :: file
      type(error_type), allocatable, intent(out) :: error
      !> Folder below which the file must be; absent: no restriction
      character(len=*), intent(in), optional :: below

      call self%lexer%open_file(file, error, below)
      allocate(self%stores(4))
      if (.not. allocated(error) .and. is_readable_format(file)) call open_cases(self, error)
   end subroutine open_experiment

   !> Is it a file of the readable format, by its name?
   pure logical function is_readable_format(file)
      !> Path
      character(len=*), intent(in) :: file
      character(len=*), parameter :: suffix = ".toml"

      is_readable_format = .false.
      if (len(file) > len(suffix)) is_readable_format = file(len(file) - len(suffix) + 1:) == suffix
   end function is_readable_format

   !> Parse a text in the readable format
   subroutine open_cases(self, error)
      class(experiment_reader), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: text

      call self%lexer%get_text(text)
      allocate(self%cases)
      call self%cases%open_text(text, self%lexer%file, error)
   end subroutine open_cases

   !> Read a text in memory
   subroutine open_experiment_text(self, text, name)
      class(experiment_reader), intent(out) :: self
      !> Text as in a file
      character(len=*), intent(in) :: text
      !> Name of the file in messages
      character(len=*), intent(in) :: name

      call self%lexer%open_text(text, name)
      allocate(self%stores(4))
   end subroutine open_experiment_text

   !> Read a text of the readable format in memory
   subroutine open_readable_text(self, text, name, error)
      !> The reader
      class(experiment_reader), intent(out) :: self
      !> Text in the readable format
      character(len=*), intent(in) :: text
      !> Name of the file in messages
      character(len=*), intent(in) :: name
      !> Allocated if the text cannot be parsed
      type(error_type), allocatable, intent(out) :: error

      call self%open_text(text, name)
      call open_cases(self, error)
   end subroutine open_readable_text

   !> Advance to the next case, which must belong to the same problem as the previous one, and find numbers that it gives
   subroutine prepare_variation(self, names, error, of_first)
      !> The reader
      class(experiment_reader), intent(inout) :: self
      !> Names "group.key", without duplicates
      character(len=*), intent(in) :: names(:)
      !> Allocated if a number cannot be varied
      type(error_type), allocatable, intent(out) :: error
      !> Return to the first case, and vary that one? Default: no
      logical, intent(in), optional :: of_first
      integer :: k
      logical :: ends_module, is_first

      is_first = .false.
      if (present(of_first)) is_first = of_first
      if (is_first) call self%rewind()
      if (.not. allocated(self%cases) .or. (self%current == 0 .and. .not. is_first)) then
         call fatal_error(error, "numbers vary in a case of the readable format that follows another one")
         return
      end if
      call self%cases%go_on(self%varied, ends_module, error)
      if (allocated(error)) return
      if (self%varied%module_number == 0) then
         call fatal_error(error, "there is no case whose numbers vary")
         return
      end if
      if (is_first) call self%select_store(self%varied%module_number, self%varied%reid, self%varied%cpid)
      allocate(self%varied_numbers(size(names)))
      do k = 1, size(names)
         self%varied_numbers(k) = self%cases%find_number(trim(names(k)))
         if (self%varied_numbers(k) > 0) cycle
         call fatal_error(error, "the case gives no number '" // trim(names(k)) // "' that could vary")
         return
      end do
   end subroutine prepare_variation

   !> Read the case of `prepare_variation` with other values; kept values are always those of the case before it, if there is one
   subroutine read_variation(self, values, this)
      !> The reader
      class(experiment_reader), intent(inout) :: self
      !> Values of the numbers, in the units of their keys
      real(wp), intent(in) :: values(:)
      !> The case
      type(input_case), intent(out) :: this
      type(potential_contact) :: coefficients
      integer :: k

      call this%problems%start(self%lexer%file)
      do k = 1, size(values)
         call self%cases%set_number(self%varied_numbers(k), values(k))
      end do
      this%case_address = self%varied
      this%number = 1
      call read_it()
      if (this%problems%is_usable()) then
         self%is_repeat = .true.
         return
      end if
      ! repeated with the values as texts for the message
      do k = 1, size(values)
         call self%cases%write_number(self%varied_numbers(k))
      end do
      call this%problems%start(self%lexer%file)
      call read_it()

   contains

      !> Read the current case with its present values
      subroutine read_it()
         associate (store => self%stores(self%current))
            coefficients = store%coefficients
            call read_toml_case(self%cases%document, self%cases%node, store%memory, self%cases%used, this%module_number, .true., &
               & store%spec, store%cases > 0, this%spec, this%problems, coefficients, this%digits, self%is_repeat)
         end associate
      end subroutine read_it
   end subroutine read_variation

   !> Return to the beginning of the text, and clear the stored data
   subroutine rewind_experiment(self)
      class(experiment_reader), intent(inout) :: self

      self%lexer%line = 0
      self%module_number = 0
      self%current = 0
      self%count = 0
      deallocate(self%stores)
      allocate(self%stores(4))
      if (allocated(self%cases)) call self%cases%rewind()
   end subroutine rewind_experiment

   !> Read the next case; its module number is 0 at the end
   !>
   !> Problems of values are stored in the case and do not stop the reader: its list shows whether the case can be solved, and the
   !> stored input is that of the file in any event. Nothing can be read after an error.
   subroutine next_case(self, this, error)
      class(experiment_reader), intent(inout) :: self
      type(input_case), intent(out) :: this
      type(error_type), allocatable, intent(out) :: error

      call this%problems%start(self%lexer%file)
      if (allocated(self%cases)) then
         call self%next_readable_case(this, error)
         return
      end if
      if (self%module_number == 0) then
         call self%read_module_line(error)
         if (allocated(error)) return
         if (self%module_number == 0) then
            if (.not. self%lexer%at_end()) call this%problems%add(severity%warning, "MODULE = 0 ends the input; text below it is &
               &not read", self%lexer%line)
            return
         end if
      end if

      associate (store => self%stores(self%current))
         this%module_number = self%module_number
         this%reid = store%reid
         this%cpid = store%cpid
         this%number = self%next_number()
         call read_case(self%lexer, self%module_number, store%spec, store%cases > 0, this%number, this%spec, this%problems, error, &
            & store%coefficients, this%first_line, this%digits)
         if (allocated(error)) return
         store%spec = this%spec
         store%cases = store%cases + 1
         if (this%spec%ends_module) self%module_number = 0
      end associate
   end subroutine next_case

   !> Read the next case of the readable format
   subroutine next_readable_case(self, this, error)
      class(experiment_reader), intent(inout) :: self
      type(input_case), intent(inout) :: this
      type(error_type), allocatable, intent(out) :: error
      type(case_address) :: address
      logical :: ends_module

      call self%cases%go_on(address, ends_module, error)
      if (allocated(error) .or. address%module_number == 0) return
      call self%select_store(address%module_number, address%reid, address%cpid)
      if (self%current == 0) then
         call fatal_error(error, "result_element = " // integer_text(address%reid) // " is one too many; there can be " // &
            & integer_text(max_elements), file=self%lexer%file, line=address%first_line)
         return
      end if
      associate (store => self%stores(self%current))
         this%case_address = address
         this%number = self%next_number()
         call read_toml_case(self%cases%document, self%cases%node, store%memory, self%cases%used, address%module_number, &
            & ends_module, store%spec, store%cases > 0, this%spec, this%problems, store%coefficients, this%digits)
         self%lexer%line = min(address%last_line, self%lexer%count_lines())
         store%spec = this%spec
         store%cases = store%cases + 1
      end associate
   end subroutine next_readable_case

   !> Replace the stored input of the case that was read last
   !> For data known only after the case was prepared, such as the curvatures of a Hertzian option.
   subroutine store_case(self, spec)
      class(experiment_reader), intent(inout) :: self
      type(case_spec), intent(in) :: spec

      if (self%current > 0) self%stores(self%current)%spec = spec
   end subroutine store_case

   !> MODULE {REID {CPID}}
   subroutine read_module_line(self, error)
      class(experiment_reader), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(3)

      call self%lexer%read_group("iII", "MODULE REID CPID", v, error)
      if (allocated(error)) then
         if (self%current > 0) call add_context(error, "case " // integer_text(self%next_number()))
         return
      end if
      select case (v(1)%i)
      case (0)
         return
      case (1, 3)
         continue
      case default
         call fatal_error(error, "MODULE = " // v(1)%word // " is not a known module; allowed are 0, 1 and 3", &
            & file=self%lexer%file, line=v(1)%line, column=v(1)%column)
         return
      end select
      call check_number(v(2), highest_element)
      if (allocated(error)) return
      call check_number(v(3), highest_patch)
      if (allocated(error)) return
      if (.not. v(3)%given) v(3)%i = 1
      call self%select_store(v(1)%i, v(2)%i, v(3)%i)
      if (self%current == 0) then
         call fatal_error(error, "REID = " // v(2)%word // " is one result element too many; there can be " // &
            & integer_text(max_elements), file=self%lexer%file, line=v(2)%line, column=v(2)%column)
         return
      end if
      self%module_number = v(1)%i

   contains

      !> Check the range of a number that may be absent
      subroutine check_number(value, highest)
         type(input_value), intent(in) :: value
         integer, intent(in) :: highest

         if (.not. value%given) return
         if (value%i >= 1 .and. value%i <= highest) return
         call fatal_error(error, value%name // " = " // value%word // " is outside its range 1 to " // &
            & integer_text(highest), file=self%lexer%file, line=value%line, column=value%column)
      end subroutine check_number
   end subroutine read_module_line

   !> Number of the next case of the current result element and patch, which counts the cases of both modules
   pure integer function next_number(self) result(number)
      class(experiment_reader), intent(in) :: self

      associate (stores => self%stores(:self%count), current => self%stores(self%current))
         number = 1 + sum(stores%cases, mask=stores%reid == current%reid .and. stores%cpid == current%cpid)
      end associate
   end function next_number

   !> Select the store of a module, result element and patch; 0 if there are too many
   !>
   !> A case keeps values of the previous case of its own module.
   subroutine select_store(self, module_number, reid, cpid)
      class(experiment_reader), intent(inout) :: self
      integer, intent(in) :: module_number, reid, cpid
      type(element_store), allocatable :: longer(:)
      integer :: k, elements

      elements = 0
      do k = 1, self%count
         self%current = k
         if (self%stores(k)%module_number == module_number .and. self%stores(k)%reid == reid &
            & .and. self%stores(k)%cpid == cpid) return
         if (.not. any(self%stores(:k - 1)%reid == self%stores(k)%reid)) elements = elements + 1
      end do
      self%current = 0
      if (elements >= max_elements .and. .not. any(self%stores(:self%count)%reid == reid)) return
      if (self%count == size(self%stores)) then
         allocate(longer(2*self%count))
         longer(:self%count) = self%stores
         call move_alloc(longer, self%stores)
      end if
      self%count = self%count + 1
      self%current = self%count
      self%stores(self%current)%module_number = module_number
      self%stores(self%current)%reid = reid
      self%stores(self%current)%cpid = cpid
   end subroutine select_store
end module contact_input_experiment_file
