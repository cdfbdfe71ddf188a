!> The CONTACT library for Fortran: named numbers and interfaces of all routines
!>
!> Compile this file with your program, because module files bind to one compiler; or include
!> caddon_flags.inc and contact_addon.ifc among your own declarations.
module contact_addon
   implicit none
   public

   include "caddon_flags.inc"
   include "contact_addon.ifc"
end module contact_addon
