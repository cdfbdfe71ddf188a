!> Settings of the iterative solution, as the input gives them; one value from the reader to the solvers
module contact_base_solver_settings
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: solver_settings

   !> Tolerance, limits and parameters of the solvers
   type :: solver_settings
      !> Largest numbers of: iterations of a solver, changes of the element division, evaluations for each prescribed force,
      !> outer iterations
      integer :: maxgs = 999, maxin = 20, maxnr = 25, maxout = 1
      !> Order of the discretisation of rolling: 1, the established scheme, or 2
      integer :: order = 1
      !> Relative tolerance [-]
      real(wp) :: eps = 1.0e-5_wp
      !> Relaxation of the Gauss-Seidel methods in adhesion and slip [-]
      real(wp) :: omegah = 0.9_wp, omegas = 1.0_wp
      !> GDsteady: FDECAY, the part of an increment that is carried downstream [-]; below 0: all of it, for -FDECAY elements
      real(wp) :: fdecay = 0.9_wp
      !> BETATH, progress below which two iterations use KDOWFB [-]; KDOWFB, for how many elements they carry increments
      real(wp) :: betath = 0.1_wp
      integer :: kdowfb = 1
      !> Weights of the residual [-]: D_IFC at the trailing edge of an adhesion area, growing by D_LIN per element to D_CNS;
      !> D_SLP in slip, where POW_S is the power of the reduction by the slip velocity
      real(wp) :: d_ifc = 1.0_wp, d_lin = 1.0_wp, d_cns = 1.0_wp, d_slp = 1.0_wp, pow_s = 0.9_wp
   end type solver_settings
end module contact_base_solver_settings
