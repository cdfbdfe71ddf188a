!> Abstract compliance of a surface, as used by all iterative methods: products and approximate inverses
!>
!> Displacement differences are u = A p. In steady rolling the particles now in the elements were one element further ahead one
!> step before, in the frame of the same tractions, with displacements A' p; the slip requires (A - A') p. Only the child types
!> know how A is computed.
module contact_elastic_compliance
   use contact_base_kinds, only : wp
   use contact_elastic_coefficients, only : complete_coefficients
   use contact_elastic_halfspace, only : kernel_table
   use contact_elastic_model, only : elastic_model
   implicit none (type, external)
   private

   public :: compliance

   !> Compliance on a window of mx by my elements
   type, abstract :: compliance
      !> Size of the window
      integer :: mx = 0, my = 0
      !> Sides of the elements [mm]
      real(wp) :: dx = 0.0_wp, dy = 0.0_wp
      !> Lateral position of the centres of the first row [mm]; used if rows differ
      real(wp) :: y_first = 0.0_wp
      type(elastic_model) :: model
      !> Number of products with the full operator since it was created
      integer :: products = 0
      !> Number of real transforms of the padded window, forward and backward, since it was created
      integer :: transforms = 0
      !> Diagonal coefficients at zero offset: nn, xx, yy [mm/(N/mm2)]
      real(wp) :: diagonal(3) = 0.0_wp
      !> Coefficients in space, for at least all offsets within the window; other than normal ones only after `complete`
      type(kernel_table) :: table
   contains
      !> Set window, model and rolling direction; nothing is recomputed if they are unchanged
      procedure(prepare_interface), deferred :: prepare
      !> u_n = A_nn p_n
      procedure(normal_interface), deferred :: normal
      !> u_t = A_tt p_t
      procedure(tangential_interface), deferred :: tangential
      !> u_t - u_t' = (A - A') p_t in steady rolling
      procedure(tangential_interface), deferred :: steady
      !> z = approximate inverse of A_nn applied to r
      procedure(normal_inverse_interface), deferred :: normal_inverse
      !> z = approximate inverse of A_tt applied to r
      procedure(tangential_inverse_interface), deferred :: tangential_inverse
      !> u_n due to tangential tractions
      procedure(to_normal_interface), deferred :: normal_by_tangential
      !> u_t due to pressures; the difference between two time steps in steady rolling
      procedure(from_normal_interface), deferred :: tangential_by_normal
      procedure(from_normal_interface), deferred :: steady_by_normal
      !> Free resources not managed by Fortran
      procedure(release_interface), deferred :: release
      !> Is there a compliance for larger elements, for an initial estimate on a coarse grid?
      procedure :: can_coarsen
      !> Does the table describe the operator completely, with the same coefficients for all loaded elements?
      procedure :: has_table
      !> Ensure that the table contains all coefficients, not only normal ones
      procedure :: complete
      !> Is the operator prepared for this window and model?
      procedure :: is_for
      !> Number of pairs of forward and backward transforms so far
      procedure :: fft_pairs
      !> Add the pairs of a coarse level, and reset its count
      procedure :: collect_pairs
   end type compliance

   abstract interface
      subroutine prepare_interface(self, model, dx, dy, mx, my, direction, y_first)
         import :: compliance, elastic_model, wp
         implicit none (type, external)
         class(compliance), intent(inout) :: self
         !> Bodies in contact
         type(elastic_model), intent(in) :: model
         !> Sides of the elements [mm]
         real(wp), intent(in) :: dx, dy
         !> Size of the window
         integer, intent(in) :: mx, my
         !> Rolling in direction of increasing (+1) or decreasing (-1) x
         integer, intent(in) :: direction
         !> Lateral position of the centres of the first row [mm]; default 0
         real(wp), intent(in), optional :: y_first
      end subroutine prepare_interface

      !> Fields of one component, shape (mx, my)
      subroutine normal_interface(self, p, u)
         import :: compliance, wp
         implicit none (type, external)
         class(compliance), intent(inout) :: self
         !> Pressures [N/mm2], positive in compression
         real(wp), contiguous, intent(in) :: p(:, :)
         !> Difference of the normal displacements of the bodies [mm], positive if the surfaces move apart
         real(wp), contiguous, intent(inout) :: u(:, :)
      end subroutine normal_interface

      !> Fields of two components, shape (mx, my, 2)
      subroutine tangential_interface(self, p, u)
         import :: compliance, wp
         implicit none (type, external)
         class(compliance), intent(inout) :: self
         !> Tangential tractions on body 1 [N/mm2]: along x, along y
         real(wp), contiguous, intent(in) :: p(:, :, :)
         !> Difference of the displacements, body 1 minus body 2 [mm], along x and along y; its change per step in `steady`
         real(wp), contiguous, intent(inout) :: u(:, :, :)
      end subroutine tangential_interface

      subroutine normal_inverse_interface(self, r, z)
         import :: compliance, wp
         implicit none (type, external)
         class(compliance), intent(inout) :: self
         !> Displacements [mm]
         real(wp), contiguous, intent(in) :: r(:, :)
         !> Tractions [N/mm2]
         real(wp), contiguous, intent(inout) :: z(:, :)
      end subroutine normal_inverse_interface

      subroutine tangential_inverse_interface(self, r, z)
         import :: compliance, wp
         implicit none (type, external)
         class(compliance), intent(inout) :: self
         !> Displacements [mm]
         real(wp), contiguous, intent(in) :: r(:, :, :)
         !> Tractions [N/mm2]
         real(wp), contiguous, intent(inout) :: z(:, :, :)
      end subroutine tangential_inverse_interface

      !> From tractions of shape (mx, my, 2) to displacements of shape (mx, my)
      subroutine to_normal_interface(self, p, u)
         import :: compliance, wp
         implicit none (type, external)
         class(compliance), intent(inout) :: self
         !> Tangential tractions on body 1 [N/mm2]: along x, along y
         real(wp), contiguous, intent(in) :: p(:, :, :)
         !> Difference of the normal displacements of the bodies [mm], positive if the surfaces move apart
         real(wp), contiguous, intent(inout) :: u(:, :)
      end subroutine to_normal_interface

      !> From pressures of shape (mx, my) to displacements of shape (mx, my, 2)
      subroutine from_normal_interface(self, p, u)
         import :: compliance, wp
         implicit none (type, external)
         class(compliance), intent(inout) :: self
         !> Pressures [N/mm2], positive in compression
         real(wp), contiguous, intent(in) :: p(:, :)
         !> Difference of the tangential displacements, body 1 minus body 2 [mm]: along x, along y
         real(wp), contiguous, intent(inout) :: u(:, :, :)
      end subroutine from_normal_interface

      subroutine release_interface(self)
         import :: compliance
         implicit none (type, external)
         class(compliance), intent(inout) :: self
      end subroutine release_interface
   end interface

contains

   pure logical function can_coarsen(self)
      class(compliance), intent(in) :: self
      can_coarsen = self%mx > 0
   end function can_coarsen

   pure logical function has_table(self)
      class(compliance), intent(in) :: self
      has_table = self%mx > 0
   end function has_table

   subroutine complete(self)
      class(compliance), intent(inout) :: self
      call complete_coefficients(self%table, self%model)
   end subroutine complete

   pure logical function is_for(self, model, dx, dy, mx, my)
      class(compliance), intent(in) :: self
      !> Bodies for which an operator is required
      type(elastic_model), intent(in) :: model
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Size of the window in elements
      integer, intent(in) :: mx, my

      is_for = self%mx == mx .and. self%my == my .and. self%dx == dx .and. self%dy == dy
      if (is_for) is_for = self%model%same_as(model)
   end function is_for

   pure real(wp) function fft_pairs(self) result(pairs)
      class(compliance), intent(in) :: self
      pairs = 0.5_wp*self%transforms
   end function fft_pairs

   pure subroutine collect_pairs(self, elements, pairs)
      class(compliance), intent(inout) :: self
      !> Number of elements of the finest window
      integer, intent(in) :: elements
      !> Number of pairs of transforms of the finest window with the same cost
      real(wp), intent(inout) :: pairs

      pairs = pairs + self%fft_pairs()*self%mx*self%my/elements
      self%transforms = 0
      self%products = 0
   end subroutine collect_pairs
end module contact_elastic_compliance
