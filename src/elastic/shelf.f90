!> Operators of windows that were in use before: their plans, coefficients and spectra are kept by size
!>
!> A contact that moves changes the size of its window by a row or a column and back again. Whoever owns an operator has a
!> shelf beside it, and fetches the one for the window at hand before it is prepared.
module contact_elastic_shelf
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_elastic_model, only : elastic_model
   use contact_elastic_one_sided, only : one_sided_operator
   use contact_elastic_operator, only : elastic_operator
   implicit none (type, external)
   private

   public :: operator_shelf

   !> A place for an operator
   type :: place_type
      class(compliance), allocatable :: operator
      !> When it was put there; the highest number is the latest
      integer :: since = 0
   end type place_type

   !> Places of one owner, who calls release before it goes
   type :: operator_shelf
      type(place_type), allocatable, private :: place(:)
      integer, private :: clock = 0
   contains
      !> The operator of a window instead of that of another one
      procedure :: fetch
      !> Free all of them
      procedure :: release
   end type operator_shelf

   !> Operators that are kept at most
   integer, parameter :: places = 6
   !> Larger windows are not kept: they are few, and take memory
   integer, parameter :: largest_kept = 4096

contains

   !> Exchange an operator for the one that was prepared for a window, if there is one; it is put on the shelf
   !>
   !> Where there is none, the operator is the one that was not in use for the longest time, or unallocated.
   subroutine fetch(self, model, dx, dy, mx, my, operator)
      class(operator_shelf), intent(inout) :: self
      !> Bodies that an operator is wanted for
      type(elastic_model), intent(in) :: model
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Size of the window in elements
      integer, intent(in) :: mx, my
      !> That of the last window, unallocated when there was none; still to be prepared on exit
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

   !> Is it that of plain half-spaces or of bodies that remember, on a window of a size that is kept? The others belong to one patch
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
