!> Settings of the iterative solution as given in the input; passed as one value from the reader to the solvers
module contact_base_solver_settings
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: solver_settings

   !> Tolerance, limits and parameters of the solvers
   type :: solver_settings
      !> Maximum numbers of iterations of a solver, of changes of the element division, of evaluations per prescribed force, and
      !> of outer iterations
      integer :: maxgs = 999, maxin = 20, maxnr = 25, maxout = 1
      !> Order of the discretisation of rolling: 1 (established scheme) or 2
      integer :: order = 1
      !> Relative tolerance [-]
      real(wp) :: eps = 1.0e-5_wp
      !> Relaxation of the Gauss-Seidel methods in adhesion and slip [-]
      real(wp) :: omegah = 0.9_wp, omegas = 1.0_wp
      !> GDsteady: FDECAY, fraction of an increment that is carried downstream [-]; negative: all of it, over -FDECAY elements
      real(wp) :: fdecay = 0.9_wp
      !> BETATH, progress below which two iterations use KDOWFB [-]; KDOWFB, number of elements over which these carry
      !> increments
      real(wp) :: betath = 0.1_wp
      integer :: kdowfb = 1
      !> Weights of the residual [-]: D_IFC at the trailing edge of an adhesion area, changing by D_LIN per element to D_CNS;
      !> D_SLP in slip, with POW_S the exponent of the reduction by slip velocity
      real(wp) :: d_ifc = 1.0_wp, d_lin = 1.0_wp, d_cns = 1.0_wp, d_slp = 1.0_wp, pow_s = 0.9_wp
   end type solver_settings
end module contact_base_solver_settings
