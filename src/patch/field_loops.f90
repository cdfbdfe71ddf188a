!> Loops over the elements of a patch, several elements at once; they are in field_loops.c
module contact_patch_field_loops
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   implicit none (type, external)
   private

   public :: mark_elements, subtract_approach

   interface
      !> Subtract the approach from the undeformed distance, except in excluded elements
      pure subroutine subtract_approach(n, approach, excluded, h) bind(c, name="contact_fields_subtract")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Approach [mm]; elements with distances from this value on are excluded [mm]
         real(c_double), value :: approach, excluded
         !> Distance of the surfaces [mm]; negative on exit where they overlap
         real(c_double), intent(inout) :: h(n)
      end subroutine subtract_approach

      !> Set element states by the pressures, and return the number of elements in contact
      integer(c_int) function mark_elements(n, exterior, adhesion, pn, px, py, division) bind(c, name="contact_fields_mark")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> States of elements without pressure, and of elements in contact that were exterior
         integer(c_int), value :: exterior, adhesion
         !> Pressures [N/mm2]
         real(c_double), intent(in) :: pn(n)
         !> Tangential tractions [N/mm2]; set to zero where there is no pressure
         real(c_double), intent(inout) :: px(n), py(n)
         !> Element states
         integer(c_int), intent(inout) :: division(n)
      end function mark_elements
   end interface
end module contact_patch_field_loops
