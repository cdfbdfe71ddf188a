!> Content of a TOML text: a tree of tables, arrays and values, each with its position in the text
module contact_toml_document
   use contact_base_kinds, only : long, wp
   use contact_text_file_text, only : add_to_hash, empty_hash
   implicit none (type, external)
   private

   public :: toml_document, toml_kind, toml_kind_text, toml_node

   type :: toml_kind_list
      integer :: table = 1, array = 2, string = 3, integer = 4, real = 5, logical = 6
   end type toml_kind_list
   !> Kinds of nodes
   type(toml_kind_list), parameter :: toml_kind = toml_kind_list()

   !> A table, an array or a value
   type :: toml_node
      !> Member of toml_kind
      integer :: kind = 0
      !> Indices of the parent, of the first and last child, and of the next child of the same parent; 0: none
      integer :: parent = 0, first = 0, last = 0, next = 0
      !> Number of children
      integer :: count = 0
      !> Range of the key and of a textual value in the store of the document; empty for array elements and tables
      integer :: key_first = 1, key_last = 0, text_first = 1, text_last = 0
      !> Line and column of the key, or of the header of a table, and of the value
      integer :: key_line = 0, key_column = 0, line = 0, column = 0
      !> Value of an integer, of a number of either kind, of a logical
      integer(long) :: i = 0
      real(wp) :: r = 0.0_wp
      logical :: l = .false.
      !> Is it closed to further headers and to dotted keys? Is it closed to any additions, as an inline table is?
      logical :: is_explicit = .false., is_frozen = .false.
      !> Is it an array of tables, made by headers?
      logical :: has_tables = .false.
   end type toml_node

   !> Tree of nodes; node 1 is the root table
   type :: toml_document
      !> Number of nodes in use
      integer :: count = 0
      type(toml_node), allocatable :: nodes(:)
      !> The parsed text, followed by strings with resolved escapes; the first `used` characters are in use
      character(len=:), allocatable :: store
      integer :: used = 0
      !> Hash table of nodes by parent and key; 0: free slot
      integer, allocatable, private :: places(:)
   contains
      !> Initialise with a text
      procedure :: begin
      !> Append a node to its parent
      procedure :: add
      !> Append a string to the store
      procedure :: keep
      !> Child of a table with a given key, 0 if there is none
      procedure :: child
      !> Key of a node; its value as a text: of a string, or a number as written
      procedure :: key_of
      procedure :: text_of
      procedure, private :: slot_of
      procedure, private :: note_place
   end type toml_document

contains

   !> Initialise a document with a text and an empty root table
   subroutine begin(self, text)
      class(toml_document), intent(out) :: self
      !> Text to parse; copied
      character(len=*), intent(in) :: text
      integer, parameter :: first_size = 64

      self%store = text
      self%used = len(text)
      allocate(self%nodes(first_size))
      allocate(self%places(2*first_size), source=0)
      self%count = 1
      self%nodes(1)%kind = toml_kind%table
      self%nodes(1)%line = 1
      self%nodes(1)%column = 1
   end subroutine begin

   !> Append a node; if it has a key, it is entered in the hash table
   subroutine add(self, parent, node, index)
      class(toml_document), intent(inout) :: self
      !> Index of a table or an array
      integer, intent(in) :: parent
      !> Node with its key and kind
      type(toml_node), intent(in) :: node
      !> Index of the new node
      integer, intent(out) :: index
      type(toml_node), allocatable :: longer(:)
      integer :: k

      if (self%count == size(self%nodes)) then
         allocate(longer(2*self%count))
         longer(:self%count) = self%nodes
         call move_alloc(longer, self%nodes)
         deallocate(self%places)
         allocate(self%places(2*size(self%nodes)), source=0)
         do k = 2, self%count
            call self%note_place(k)
         end do
      end if
      self%count = self%count + 1
      index = self%count
      self%nodes(index) = node
      self%nodes(index)%parent = parent
      associate (above => self%nodes(parent))
         if (above%last > 0) self%nodes(above%last)%next = index
         if (above%first == 0) above%first = index
         above%last = index
         above%count = above%count + 1
      end associate
      call self%note_place(index)
   end subroutine add

   !> Enter a node in the hash table
   subroutine note_place(self, index)
      class(toml_document), intent(inout) :: self
      integer, intent(in) :: index
      integer :: k

      associate (node => self%nodes(index))
         if (self%nodes(node%parent)%kind /= toml_kind%table) return
         k = self%slot_of(node%parent, self%store(node%key_first:node%key_last))
         self%places(k) = index
      end associate
   end subroutine note_place

   !> Slot of a child in `places`: occupied by it, or the free slot for it
   pure integer function slot_of(self, parent, key) result(k)
      class(toml_document), intent(in) :: self
      integer, intent(in) :: parent
      character(len=*), intent(in) :: key
      integer(long) :: hash

      hash = ieor(empty_hash, 31_long*parent)
      call add_to_hash(key, hash)
      k = int(modulo(hash, int(size(self%places), long))) + 1
      do while (self%places(k) > 0)
         associate (node => self%nodes(self%places(k)))
            if (node%parent == parent .and. node%key_last - node%key_first + 1 == len(key)) then
               if (self%store(node%key_first:node%key_last) == key) return
            end if
         end associate
         k = modulo(k, size(self%places)) + 1
      end do
   end function slot_of

   !> Append a string to the store
   subroutine keep(self, text, first, last)
      class(toml_document), intent(inout) :: self
      !> String without quotes and escapes
      character(len=*), intent(in) :: text
      !> Its range in the store
      integer, intent(out) :: first, last
      character(len=:), allocatable :: longer

      first = self%used + 1
      last = self%used + len(text)
      if (last > len(self%store)) then
         allocate(character(len=2*last) :: longer)
         longer(:self%used) = self%store(:self%used)
         call move_alloc(longer, self%store)
      end if
      self%store(first:last) = text
      self%used = last
   end subroutine keep

   !> Child of a table with a given key, 0 if there is none
   pure integer function child(self, parent, key) result(index)
      class(toml_document), intent(in) :: self
      !> Index of a table
      integer, intent(in) :: parent
      !> Key without quotes
      character(len=*), intent(in) :: key

      index = self%places(self%slot_of(parent, key))
   end function child

   !> Key of a node, "" for an element of an array
   pure function key_of(self, index) result(text)
      class(toml_document), intent(in) :: self
      !> Index of a node
      integer, intent(in) :: index
      character(len=self%nodes(index)%key_last - self%nodes(index)%key_first + 1) :: text

      text = self%store(self%nodes(index)%key_first:self%nodes(index)%key_last)
   end function key_of

   !> A value as a text, "" for tables and arrays
   pure function text_of(self, index) result(text)
      class(toml_document), intent(in) :: self
      !> Index of a node
      integer, intent(in) :: index
      character(len=self%nodes(index)%text_last - self%nodes(index)%text_first + 1) :: text

      text = self%store(self%nodes(index)%text_first:self%nodes(index)%text_last)
   end function text_of

   !> Name of a kind, for messages
   pure function toml_kind_text(kind) result(text)
      !> Member of toml_kind
      integer, intent(in) :: kind
      character(len=13) :: text
      character(len=13), parameter :: texts(6) = [character(len=13) :: "a table", "an array", "a text", "an integer", "a number", &
         & "true or false"]

      text = texts(kind)
   end function toml_kind_text
end module contact_toml_document
