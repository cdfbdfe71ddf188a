!> Kind parameters
module contact_base_kinds
   use, intrinsic :: iso_fortran_env, only : int64, real64
   implicit none (type, external)
   private

   !> Working precision of all lengths, forces and tractions
   integer, parameter, public :: wp = real64
   !> Integers that may exceed 2**31, such as products of grid sizes and clock ticks
   integer, parameter, public :: long = int64
end module contact_base_kinds
