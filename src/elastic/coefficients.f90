!> Influence coefficients of elastic models that are the same for all loaded elements
module contact_elastic_coefficients
   use contact_base_choices, only : kernel_model
   use contact_base_kinds, only : wp
   use contact_elastic_bilinear, only : fill_bilinear, fill_shifted_bilinear
   use contact_elastic_halfspace, only : complete_table, fill_normal, fill_shifted_table, fill_table, kernel_table, own_tangential
   use contact_elastic_inclination, only : rotate_table
   use contact_elastic_memory, only : fill_with_memory
   use contact_elastic_model, only : elastic_model
   implicit none (type, external)
   private

   public :: complete_coefficients, fill_coefficients, fill_shifted_coefficients, own_coefficients

contains

   !> Coefficients without shift; for a curved surface whose correction depends on rows, those of flat bodies
   !>
   !> Only normal coefficients where these can be computed separately; `complete_coefficients` computes the others.
   subroutine fill_coefficients(table, model, dx, dy, nx, ny)
      !> Receives offsets, sides and coefficients; its arrays are allocated here
      type(kernel_table), intent(inout) :: table
      !> Bodies: half-spaces, layer, memory, or a table from a file
      type(elastic_model), intent(in) :: model
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Maximum offsets in elements
      integer, intent(in) :: nx, ny

      if (allocated(model%memory)) then
         call fill_with_memory(table, model%material, model%memory, model%coupled(), dx, dy, nx, ny)
      else if (model%kernel == kernel_model%bilinear) then
         call fill_bilinear(table, model%material, dx, dy, nx, ny)
      else if (model%rotates_by_offset()) then
         call fill_table(table, model%material, dx, dy, nx, ny)
      else
         call fill_normal(table, model%material, dx, dy, nx, ny)
      end if
      if (model%rotates_by_offset()) call rotate_table(table, model%inclination)
      table%nn(0, 0) = table%nn(0, 0) + model%sheet
      if (allocated(table%xx)) call add_layer(table, model)
   end subroutine fill_coefficients

   !> Add the displacement of an element by the layer below it
   pure subroutine add_layer(table, model)
      !> Table with all coefficients
      type(kernel_table), intent(inout) :: table
      type(elastic_model), intent(in) :: model

      table%xx(0, 0) = table%xx(0, 0) + model%layer
      table%yy(0, 0) = table%yy(0, 0) + model%layer
   end subroutine add_layer

   !> Compute the coefficients omitted by `fill_coefficients`, if any
   subroutine complete_coefficients(table, model)
      !> Table of these bodies
      type(kernel_table), intent(inout) :: table
      !> Bodies
      type(elastic_model), intent(in) :: model

      if (allocated(table%xx) .or. .not. allocated(table%nn)) return
      call complete_table(table)
      call add_layer(table, model)
   end subroutine complete_coefficients

   !> Coefficients nn, xx, yy of an element on itself, also for an incomplete table
   pure function own_coefficients(table, model) result(own)
      !> From `fill_coefficients`
      type(kernel_table), intent(in) :: table
      !> Bodies
      type(elastic_model), intent(in) :: model
      real(wp) :: own(3)

      if (allocated(table%xx)) then
         own = [table%nn(0, 0), table%xx(0, 0), table%yy(0, 0)]
      else
         own = [table%nn(0, 0), own_tangential(table) + model%layer]
      end if
   end function own_coefficients

   !> Coefficients for observation points shifted by (shift_x, shift_y); flat bodies without memory
   !>
   !> The layer is loaded by the traction at the shifted point, interpolated between the surrounding elements.
   subroutine fill_shifted_coefficients(table, model, dx, dy, nx, ny, shift_x, shift_y)
      !> Receives offsets, sides and coefficients; its arrays are allocated here
      type(kernel_table), intent(inout) :: table
      !> Bodies, flat and without memory
      type(elastic_model), intent(in) :: model
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Maximum offsets in elements
      integer, intent(in) :: nx, ny
      !> Shift of the observation points [mm]
      real(wp), intent(in) :: shift_x, shift_y
      integer :: k, l, i, j
      real(wp) :: a, b, share

      if (model%kernel == kernel_model%bilinear) then
         call fill_shifted_bilinear(table, model%material, dx, dy, nx, ny, shift_x, shift_y)
      else
         call fill_shifted_table(table, model%material, dx, dy, nx, ny, shift_x, shift_y)
      end if
      if (model%layer <= 0.0_wp) return
      k = floor(shift_x/dx)
      l = floor(shift_y/dy)
      a = shift_x/dx - k
      b = shift_y/dy - l
      do j = 0, 1
         do i = 0, 1
            if (k + i > nx .or. k + i < -nx .or. l + j > ny .or. l + j < -ny) cycle
            share = model%layer*merge(a, 1.0_wp - a, i == 1)*merge(b, 1.0_wp - b, j == 1)
            table%xx(-k - i, -l - j) = table%xx(-k - i, -l - j) + share
            table%yy(-k - i, -l - j) = table%yy(-k - i, -l - j) + share
         end do
      end do
   end subroutine fill_shifted_coefficients
end module contact_elastic_coefficients
