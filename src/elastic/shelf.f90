!> Cache of operators by window size, with their plans, coefficients and spectra
!>
!> The window of a moving contact changes by a row or a column and back again. The owner of an operator has a shelf for it, and
!> fetches the operator of the current window before preparing it.
module contact_elastic_shelf
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_elastic_model, only : elastic_model
   use contact_elastic_one_sided, only : one_sided_operator
   use contact_elastic_operator, only : elastic_operator
   implicit none (type, external)
   private

   public :: operator_shelf

   !> An entry of the cache
   type :: place_type
      class(compliance), allocatable :: operator
      !> Clock value when it was stored; larger is more recent
      integer :: since = 0
   end type place_type

   !> Cache of one owner, which must call release
   type :: operator_shelf
      type(place_type), allocatable, private :: place(:)
      integer, private :: clock = 0
   contains
      !> Exchange the operator of the last window for that of another one
      procedure :: fetch
      !> Free all operators
      procedure :: release
   end type operator_shelf

   !> Maximum number of operators
   integer, parameter :: places = 6
   !> Larger windows are not kept: they are few and need much memory
   integer, parameter :: largest_kept = 4096

contains

   !> Exchange an operator for the one that was prepared for a given window, if there is one, and store it on the shelf
   !>
   !> If there is none, the result is the least recently used operator, or unallocated.
   subroutine fetch(self, model, dx, dy, mx, my, operator)
      class(operator_shelf), intent(inout) :: self
      !> Model for which an operator is required
      type(elastic_model), intent(in) :: model
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Size of the window in elements
      integer, intent(in) :: mx, my
      !> Operator of the last window, unallocated if there was none; to be prepared after the call
      class(compliance), allocatable, intent(inout) :: operator
      class(compliance), allocatable :: last
      integer :: k, found, oldest

      if (.not. allocated(operator)) return
      if (operator%is_for(model, dx, dy, mx, my) .or. .not. keeps(operator) .or. mx*my > largest_kept) return
      if (.not. allocated(self%place)) allocate(self%place(places))
      found = 0
      oldest = 1
      do k = 1, places
         if (self%place(k)%since < self%place(oldest)%since) oldest = k
         if (.not. allocated(self%place(k)%operator)) cycle
         if (.not. self%place(k)%operator%is_for(model, dx, dy, mx, my)) cycle
         found = k
         exit
      end do
      if (found == 0) found = oldest
      call move_alloc(operator, last)
      call move_alloc(self%place(found)%operator, operator)
      call move_alloc(last, self%place(found)%operator)
      self%clock = self%clock + 1
      self%place(found)%since = self%clock
   end subroutine fetch

   !> Is it an operator of half-spaces or of viscoelastic bodies, for a window small enough to be kept? Others belong to a
   !> single patch
   pure logical function keeps(operator)
      class(compliance), intent(in) :: operator

      keeps = .false.
      select type (operator)
      type is (elastic_operator)
         keeps = operator%mx*operator%my <= largest_kept .and. .not. allocated(operator%model%inclination)
      type is (one_sided_operator)
         keeps = operator%mx*operator%my <= largest_kept
      end select
   end function keeps

   subroutine release(self)
      class(operator_shelf), intent(inout) :: self
      integer :: k

      if (.not. allocated(self%place)) return
      do k = 1, places
         if (allocated(self%place(k)%operator)) call self%place(k)%operator%release()
      end do
      deallocate(self%place)
   end subroutine release
end module contact_elastic_shelf
