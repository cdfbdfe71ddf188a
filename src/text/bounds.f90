!> Bounds of all numbers in the input, each with its reason: one table for all doors
!>
!> The reader of input files adds the position in the file, the library its return code. The bounds exclude meaningless values
!> before they cost computing time or enter a result. They are orders of magnitude beyond practical use: from gels to
!> practically rigid bodies, from nanometres to a kilometre. Units are the internal ones.
!>
!> Long because it is mostly the table, one entry per number of the input.
module contact_text_bounds
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_choices, only : motion
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_text_words, only : integer_text, real_text
   implicit none (type, external)
   private

   public :: number_bounds, bounds_table, bounds_of, is_angle, is_within, describe_breach, check_number, unit_length, unit_of

   !> Length of a unit, or of two with " or "
   integer, parameter :: unit_length = 26

   !> Bounds of one number
   type :: number_bounds
      !> Name in the input files; one name serves for GG1 and GG2, as trailing digits are significant only if they are in the
      !> table
      character(len=11) :: name
      !> Unit; "integer" for integer numbers
      character(len=11) :: unit
      !> Meaning
      character(len=80) :: title
      !> Smallest and largest value
      real(wp) :: lowest, highest
      !> Is the lower bound itself excluded?
      logical :: is_open
      !> Reason for the bounds
      character(len=72) :: reason
      !> Does it have a default value, so that named formats may omit it?
      logical :: is_preset = .false.
   end type number_bounds

   !> Distances beyond any contact problem [mm], and along the track [mm]
   real(wp), parameter :: far = 1.0e6_wp, far_along = 1.0e12_wp
   !> Smallest element side and step [mm], far below the size of an atom
   real(wp), parameter :: tiny_side = 1.0e-8_wp
   !> Two turns [rad]; excludes an angle in degrees without its suffix
   real(wp), parameter :: two_turns = 12.57_wp
   !> Angles that accumulate during a run [rad], and rates [rad/s]
   real(wp), parameter :: many_turns = 1.0e9_wp
   !> Velocities [mm/s], 1000 km/s
   real(wp), parameter :: fast = 1.0e9_wp
   !> Creepages that are practically infinite
   real(wp), parameter :: endless = 1.0e12_wp
   !> Forces [N], beyond any load
   real(wp), parameter :: heavy = 1.0e15_wp
   !> Moduli [N/mm2] and stiffnesses [N/mm] that are practically rigid
   real(wp), parameter :: rigid = 1.0e20_wp

   type(number_bounds), parameter :: solver_rows(*) = [ &
      & number_bounds("MAXGS", "integer", "largest number of iterations of a solver", &
      & 1.0_wp, 999999.0_wp, .false., "at least one iteration", .true.), &
      & number_bounds("MAXIN", "integer", "largest number of changes of the element division", &
      & 1.0_wp, 999999.0_wp, .false., "at least one iteration", .true.), &
      & number_bounds("MAXNR", "integer", "largest number of iterations for forces", &
      & 1.0_wp, 999999.0_wp, .false., "at least one iteration", .true.), &
      & number_bounds("MAXOUT", "integer", "largest number of outer iterations", &
      & 1.0_wp, 999999.0_wp, .false., "at least one iteration", .true.), &
      & number_bounds("MXSENS", "integer", "largest number of iterations for sensitivities", &
      & 1.0_wp, 999999.0_wp, .false., "at least one iteration", .true.), &
      & number_bounds("EPS", "-", "relative tolerance", &
      & 1.0e-20_wp, 1.0_wp, .false., "round-off is 1e-16; a tolerance of 1 solves nothing", .true.), &
      & number_bounds("EPSENS", "-", "relative tolerance of sensitivities", &
      & 1.0e-20_wp, 1.0_wp, .false., "round-off is 1e-16; a tolerance of 1 solves nothing", .true.), &
      & number_bounds("NPOT_MAX", "integer", "largest number of elements of a patch of wheel and rail", &
      & 1.0_wp, 2.0e9_wp, .false., "a number of elements; limited to 100...1000000", .true.), &
      & number_bounds("OMEGAH", "-", "relaxation in the adhesion area", &
      & 0.0_wp, 10.0_wp, .true., "a relaxation factor; beyond 2 the iteration diverges", .true.), &
      & number_bounds("OMEGAS", "-", "relaxation in the slip area", &
      & 0.0_wp, 10.0_wp, .true., "a relaxation factor; beyond 2 the iteration diverges", .true.), &
      & number_bounds("OMGSLP", "-", "relaxation of the slip velocity", &
      & 0.0_wp, 10.0_wp, .true., "a relaxation factor; beyond 2 the iteration diverges", .true.), &
      & number_bounds("INISLP", "-", "start of the slip velocity iteration: its sign chooses the branch", &
      & -1.0e9_wp, 1.0e9_wp, .false., "only the sign has a meaning", .true.), &
      & number_bounds("FDECAY", "-", "GDsteady: part of a step kept after projection, or minus elements", &
      & -1.0e4_wp, 1.0e4_wp, .false., "a factor, or minus a number of elements", .true.), &
      & number_bounds("BETATH", "-", "GDsteady: progress below which the projection changes", &
      & -1.0e4_wp, 1.0e4_wp, .false., "a factor", .true.), &
      & number_bounds("KDOWFB", "integer", "GDsteady: elements of the projection after stagnation", &
      & -1.0e6_wp, 1.0e6_wp, .false., "a number of elements", .true.), &
      & number_bounds("D_IFC", "-", "GDsteady: weight of the first element of an adhesion area", &
      & -1.0e6_wp, 1.0e6_wp, .false., "a weight; values below 0.01 act as 0.01", .true.), &
      & number_bounds("D_LIN", "-", "GDsteady: growth of the weight per element", &
      & -1.0e6_wp, 1.0e6_wp, .false., "a weight per element", .true.), &
      & number_bounds("D_CNS", "-", "GDsteady: weight up or down to which it grows", &
      & -1.0e6_wp, 1.0e6_wp, .false., "a weight; values below 0.01 act as 0.01", .true.), &
      & number_bounds("D_SLP", "-", "GDsteady: weight of the slip area", &
      & -1.0e6_wp, 1.0e6_wp, .false., "a weight; values below 0.01 act as 0.01", .true.), &
      & number_bounds("POW_S", "-", "GDsteady: exponent of the weights in the slip area", &
      & -1.0e4_wp, 1.0e4_wp, .false., "an exponent; limited to 0.01...10", .true.)]

   type(number_bounds), parameter :: motion_rows(*) = [ &
      & number_bounds("PEN", "mm", "approach, prescribed with normal = ""approach""", &
      & -far, far, .false., "an approach of 1 km"), &
      & number_bounds("FN", "N", "normal force, prescribed with normal = ""force""", &
      & 0.0_wp, heavy, .false., "no adhesive forces; beyond any load"), &
      & number_bounds("FX", "-", "relative force FX, prescribed with tangential = ""fx_and_ceta"", ""fx_and_fy""", &
      & -1.0_wp, 1.0_wp, .false., "relative to the friction bound FSTAT FN"), &
      & number_bounds("FY", "-", "relative force FY, prescribed with tangential = ""fx_and_fy""", &
      & -1.0_wp, 1.0_wp, .false., "relative to the friction bound FSTAT FN"), &
      & number_bounds("CKSI", "- or mm", "longitudinal creepage or shift", &
      & -endless, endless, .false., "any creepage, full sliding included; shifts in mm", .true.), &
      & number_bounds("CETA", "- or mm", "lateral creepage or shift", &
      & -endless, endless, .false., "any creepage, full sliding included; shifts in mm", .true.), &
      & number_bounds("CPHI", "rad/mm", "spin or rotation", &
      & -endless, endless, .false., "at most the inverse of a radius of curvature", .true.), &
      & number_bounds("SPINXO", "mm", "spin centre", &
      & -1.0e9_wp, 1.0e9_wp, .false., "a rotation about a centre this far away is a translation"), &
      & number_bounds("SPINYO", "mm", "spin centre", &
      & -1.0e9_wp, 1.0e9_wp, .false., "a rotation about a centre this far away is a translation"), &
      & number_bounds("CHI", "rad", "rolling direction", &
      & -two_turns, two_turns, .false., "two turns; in degrees with a suffix: 180d", .true.), &
      & number_bounds("DQ", "mm", "distance per step", &
      & tiny_side, far, .false., "from less than an atom to 1 km"), &
      & number_bounds("VELOC", "mm/s", "velocity", &
      & 1.0e-9_wp, fast, .false., "up to 1000 km/s"), &
      & number_bounds("FACPHI", "-", "offset of the spin in steps", &
      & -1.0e3_wp, 1.0e3_wp, .false., "a fraction of a step"), &
      & number_bounds("EXRHS", "- or mm", "extra term of the rigid slip", &
      & -endless, endless, .false., "as creepages")]

   type(number_bounds), parameter :: friction_rows(*) = [ &
      & number_bounds("FSTAT", "-", "static coefficient of friction", &
      & 1.0e-6_wp, 1.0e6_wp, .false., "frictionless contact is motion = ""none""; above 100 nothing slips"), &
      & number_bounds("FKIN", "-", "kinetic coefficient of friction", &
      & 0.0_wp, 1.0e6_wp, .false., "friction is not negative; above 100 nothing slips"), &
      & number_bounds("FLIN", "-", "coefficient of a term of the linear law", &
      & 0.0_wp, 1.0e6_wp, .false., "friction is not negative; above 100 nothing slips"), &
      & number_bounds("FRAT", "-", "coefficient of a term of the rational law", &
      & 0.0_wp, 1.0e6_wp, .false., "friction is not negative; above 100 nothing slips"), &
      & number_bounds("FEXP", "-", "coefficient of a term of the exponential law", &
      & 0.0_wp, 1.0e6_wp, .false., "friction is not negative; above 100 nothing slips"), &
      & number_bounds("SABSH", "mm/s", "slip velocity at which a term has fallen to one half", &
      & 1.0e-5_wp, fast, .false., "smaller values make the law discontinuous; 1000 km/s"), &
      & number_bounds("MEMDST", "mm", "distance of the friction memory", &
      & 0.0_wp, far, .false., "not negative; longer than any contact", .true.), &
      & number_bounds("MEM_S0", "mm/s", "lowest velocity of the friction memory", &
      & 0.0_wp, fast, .false., "not negative; 1000 km/s", .true.), &
      & number_bounds("FREF", "-", "coefficient of friction up to TREF", &
      & 0.0_wp, 1.0e6_wp, .false., "friction is not negative; above 100 nothing slips"), &
      & number_bounds("TREF", "degC", "temperature at which friction begins to change", &
      & -273.15_wp, 1.0e5_wp, .false., "absolute zero; above any melting point"), &
      & number_bounds("DFHEAT", "-", "change of the coefficient of friction", &
      & -1.0e6_wp, 1.0e6_wp, .false., "a change of FREF"), &
      & number_bounds("DTHEAT", "degC", "range of temperatures of the change", &
      & 0.0_wp, 1.0e5_wp, .true., "0 makes the law discontinuous; above any melting point"), &
      & number_bounds("POLACH_A", "-", "A of the law of Polach: friction at large slip over the static one", &
      & 0.0_wp, 1.0_wp, .false., "a fraction of the static coefficient"), &
      & number_bounds("POLACH_B", "s/mm", "B of the law of Polach: decay with slip velocity", &
      & 0.0_wp, 1.0e10_wp, .false., "friction decreases with slip velocity"), &
      & number_bounds("NVF", "integer", "number of control points of friction", &
      & 1.0_wp, 10.0_wp, .false., "the format has 1 to 10 control points"), &
      & number_bounds("SVF", "mm", "position of a control point along the track", &
      & -far_along, far_along, .false., "1e6 km of track"), &
      & number_bounds("ALPHA", "rad", "surface inclination of a control point", &
      & -two_turns, two_turns, .false., "two turns; in degrees with a suffix: 60d")]

   type(number_bounds), parameter :: material_rows(*) = [ &
      & number_bounds("POISS", "-", "Poisson ratio", &
      & -1.0_wp, 0.5_wp, .true., "limits of stability of an isotropic elastic solid"), &
      & number_bounds("GG", "N/mm2", "modulus of rigidity", &
      & 1.0e-5_wp, rigid, .false., "from soft gels to practically rigid bodies"), &
      & number_bounds("FLXZ", "mm3/N", "vertical flexibility of the elastic thin sheet", &
      & 1.0e-10_wp, 1.0e10_wp, .false., "from practically rigid to gel"), &
      & number_bounds("FG", "-", "ratio of viscoelastic to elastic flexibility", &
      & 0.0_wp, 1.0e10_wp, .false., "a ratio of moduli"), &
      & number_bounds("TC", "s", "relaxation time", &
      & 0.0_wp, 1.0e15_wp, .false., "not negative; 30 million years"), &
      & number_bounds("FLX", "mm3/N", "flexibility of simplified theory", &
      & 1.0e-10_wp, 1.0e10_wp, .false., "from practically rigid to gel"), &
      & number_bounds("K0_MF", "-", "initial slope reduction", &
      & 1.0e-10_wp, 1.0_wp, .false., "a fraction of the initial slope", .true.), &
      & number_bounds("ALFAMF", "-", "final slope reduction over initial one", &
      & 0.0_wp, 1.0_wp, .false., "a fraction of the initial slope", .true.), &
      & number_bounds("BETAMF", "-", "decay of the slope reduction", &
      & 0.0_wp, 1.0e10_wp, .false., "slopes decrease with creepage", .true.), &
      & number_bounds("GG3", "N/mm2", "modulus of rigidity of the layer", &
      & 1.0e-5_wp, rigid, .false., "from soft gels to practically rigid layers"), &
      & number_bounds("LAYTHK", "mm", "thickness of the layer", &
      & 0.0_wp, far, .false., "not negative; 0 means no layer"), &
      & number_bounds("TAU_C0", "N/mm2", "yield limit", &
      & -rigid, rigid, .false., "no plasticity at 0 or below and at 1e10 or above", .true.), &
      & number_bounds("K_TAU", "N/mm3", "hardening", &
      & -rigid, rigid, .false., "hardening or softening within a nanometre", .true.), &
      & number_bounds("Y,ALPHA", "mm, rad", "lateral position and surface inclination", &
      & -far, far, .false., "1 km from the contact, and any angle"), &
      & number_bounds("CZZ", "mm", "influence coefficient", &
      & -1.0e12_wp, 1.0e12_wp, .false., "an element yields by about its own side"), &
      & number_bounds("IF_METH", "integer", "method for the normal direction", &
      & 0.0_wp, 1.0_wp, .false., "number of an existing method", .true.), &
      & number_bounds("VARIANT", "integer", "variant of the angle correction", &
      & 1.0_wp, 4.0_wp, .false., "number of an existing variant", .true.), &
      & number_bounds("CDAMP", "s", "damping coefficient", &
      & 0.0_wp, 1.0e10_wp, .false., "damping is not negative"), &
      & number_bounds("DFNMAX", "N/s", "largest rate of the normal force", &
      & 0.0_wp, rigid, .false., "a limit is not negative"), &
      & number_bounds("DFTMAX", "N/s", "largest rate of the tangential force", &
      & 0.0_wp, rigid, .false., "a limit is not negative"), &
      & number_bounds("BKTEMP", "degC", "bulk temperature", &
      & -273.15_wp, 1.0e5_wp, .false., "absolute zero; above any melting point"), &
      & number_bounds("HEATCP", "J/(kg degC)", "specific heat capacity", &
      & 1.0e-5_wp, 1.0e10_wp, .false., "water: 4200"), &
      & number_bounds("LAMBDA", "W/(mm degC)", "heat conductivity", &
      & 1.0e-5_wp, 1.0e10_wp, .false., "foam: 3e-5, diamond: 2"), &
      & number_bounds("DENS", "kg/mm3", "density", &
      & 1.0e-12_wp, 1.0e3_wp, .false., "from below any gas to above any solid"), &
      & number_bounds("ARCHARD", "-", "wear coefficient of Archard", &
      & 0.0_wp, 1.0_wp, .false., "wear removes material, at 1 all of the sliding material at once", .true.), &
      & number_bounds("HARDNESS", "N/mm2", "hardness of the softer body", &
      & 0.0_wp, rigid, .false., "a pressure", .true.), &
      & number_bounds("SHEAR_YIELD", "N/mm2", "yield stress in cyclic shear", &
      & 0.0_wp, rigid, .false., "a stress", .true.), &
      & number_bounds("BETAPL", "-", "part of plastic work that becomes heat", &
      & 0.0_wp, 1.0_wp, .false., "a fraction of the plastic work", .true.)]

   type(number_bounds), parameter :: grid_rows(*) = [ &
      & number_bounds("MX", "integer", "number of elements along x", &
      & 1.0_wp, 2.0e6_wp, .false., "MX times MY is at most 2000000"), &
      & number_bounds("MY", "integer", "number of elements along y", &
      & 1.0_wp, 2.0e6_wp, .false., "MX times MY is at most 2000000"), &
      & number_bounds("SCALE", "-", "size of the grid over that of the contact", &
      & 1.0e-6_wp, 1.0e6_wp, .false., "the grid contains the contact or a part of it"), &
      & number_bounds("A1", "1/mm", "half the sum of the bodies' curvatures along x", &
      & 1.0e-12_wp, 1.0e9_wp, .false., "radii from an atom to a planet"), &
      & number_bounds("B1", "1/mm", "half the sum of the bodies' curvatures along y", &
      & 1.0e-12_wp, 1.0e9_wp, .false., "radii from an atom to a planet"), &
      & number_bounds("AOB", "-", "ratio of semi-axes", &
      & 1.0e-6_wp, 1.0e6_wp, .false., "longer contacts are line contacts: IPOTCN = -4"), &
      & number_bounds("AA", "mm", "semi-axis along x", &
      & tiny_side, far, .false., "from less than an atom to 1 km"), &
      & number_bounds("BB", "mm", "semi-axis along y", &
      & tiny_side, far, .false., "from less than an atom to 1 km"), &
      & number_bounds("BNEG", "mm", "semi-axis to negative y", &
      & tiny_side, far, .false., "from less than an atom to 1 km"), &
      & number_bounds("BPOS", "mm", "semi-axis to positive y", &
      & tiny_side, far, .false., "from less than an atom to 1 km"), &
      & number_bounds("XL", "mm", "lower border in x", &
      & -far, far, .false., "1 km from the contact"), &
      & number_bounds("YL", "mm", "lower border in y", &
      & -far, far, .false., "1 km from the contact"), &
      & number_bounds("XH", "mm", "upper border in x", &
      & -far, far, .false., "1 km from the contact"), &
      & number_bounds("YH", "mm", "upper border in y", &
      & -far, far, .false., "1 km from the contact"), &
      & number_bounds("XC1", "mm", "centre of the first element in x", &
      & -far, far, .false., "1 km from the contact"), &
      & number_bounds("YC1", "mm", "centre of the first element in y", &
      & -far, far, .false., "1 km from the contact"), &
      & number_bounds("XCM", "mm", "centre of the last element in x", &
      & -far, far, .false., "1 km from the contact"), &
      & number_bounds("YCM", "mm", "centre of the last element in y", &
      & -far, far, .false., "1 km from the contact"), &
      & number_bounds("DX", "mm", "size of the elements along x", &
      & tiny_side, far, .false., "from less than an atom to 1 km"), &
      & number_bounds("DY", "mm", "size of the elements along y", &
      & tiny_side, far, .false., "from less than an atom to 1 km"), &
      & number_bounds("B", "mm ...", "coefficients of the undeformed distance", &
      & -1.0e9_wp, 1.0e9_wp, .false., "beyond the curvature, slope or height of any body"), &
      & number_bounds("B(IBASE3)", "mm ...", "parameters of the undeformed distance", &
      & -rigid, rigid, .false., "as B; the radius of a flat body may be 1e20"), &
      & number_bounds("NN", "integer", "number of points of the profile", &
      & 2.0_wp, 999999.0_wp, .false., "two points or more determine a line"), &
      & number_bounds("XM", "mm", "x of the highest point", &
      & -far, far, .false., "1 km from the contact"), &
      & number_bounds("RM", "mm", "radius along x", &
      & -rigid, rigid, .false., "the radius of a flat body may be 1e20"), &
      & number_bounds("Y1", "mm", "y of the first point of the profile", &
      & -far, far, .false., "1 km from the contact"), &
      & number_bounds("DY1", "mm", "distance of the points of the profile", &
      & tiny_side, far, .false., "from less than an atom to 1 km"), &
      & number_bounds("H", "mm", "undeformed distance of each element", &
      & -far, 1.0e38_wp, .false., "an overlap of 1 km; 1e30 excludes an element"), &
      & number_bounds("PL", "mm2 ...", "coefficients of the planform", &
      & -rigid, rigid, .false., "1 km2 is 1e12 mm2"), &
      & number_bounds("XL1", "mm", "first rectangle: lower border in x", &
      & -1.0e38_wp, 1.0e38_wp, .false., "an unbounded side is given as 1e30"), &
      & number_bounds("XH1", "mm", "first rectangle: upper border in x", &
      & -1.0e38_wp, 1.0e38_wp, .false., "an unbounded side is given as 1e30"), &
      & number_bounds("YL1", "mm", "first rectangle: lower border in y", &
      & -1.0e38_wp, 1.0e38_wp, .false., "an unbounded side is given as 1e30"), &
      & number_bounds("YH1", "mm", "first rectangle: upper border in y", &
      & -1.0e38_wp, 1.0e38_wp, .false., "an unbounded side is given as 1e30"), &
      & number_bounds("XL2", "mm", "second rectangle: lower border in x", &
      & -1.0e38_wp, 1.0e38_wp, .false., "an unbounded side is given as 1e30"), &
      & number_bounds("XH2", "mm", "second rectangle: upper border in x", &
      & -1.0e38_wp, 1.0e38_wp, .false., "an unbounded side is given as 1e30"), &
      & number_bounds("YL2", "mm", "second rectangle: lower border in y", &
      & -1.0e38_wp, 1.0e38_wp, .false., "an unbounded side is given as 1e30"), &
      & number_bounds("YH2", "mm", "second rectangle: upper border in y", &
      & -1.0e38_wp, 1.0e38_wp, .false., "an unbounded side is given as 1e30"), &
      & number_bounds("XL,XH,YL,YH", "mm", "borders of a part of the planform", &
      & -1.0e38_wp, 1.0e38_wp, .false., "an unbounded side is given as 1e30"), &
      & number_bounds("NP", "integer", "number of parts of the planform", &
      & 1.0_wp, 100.0_wp, .false., "a number of sub-patches"), &
      & number_bounds("FAC", "-", "factor between two parts of the planform", &
      & 0.0_wp, 1.0_wp, .false., "a fraction of the full interaction")]

   type(number_bounds), parameter :: subsurface_rows(*) = [ &
      & number_bounds("MATFIL_S", "integer", "amount of data in the .subs file", &
      & 0.0_wp, 2.0_wp, .false., "number of an existing kind of file"), &
      & number_bounds("OUTPUT_S", "integer", "amount of stresses in the .out file", &
      & 0.0_wp, 4.0_wp, .false., "number of an existing amount of output"), &
      & number_bounds("IXL", "integer", "first column", &
      & 1.0_wp, 999999.0_wp, .false., "a column number"), &
      & number_bounds("IXINC", "integer", "step of columns", &
      & -2.0e9_wp, 2.0e9_wp, .false., "a step; values below 1 act as 1"), &
      & number_bounds("IXH", "integer", "last column", &
      & 1.0_wp, 999999.0_wp, .false., "a column number"), &
      & number_bounds("IYL", "integer", "first row", &
      & 1.0_wp, 999999.0_wp, .false., "a row number"), &
      & number_bounds("IYINC", "integer", "step of rows", &
      & -2.0e9_wp, 2.0e9_wp, .false., "a step; values below 1 act as 1"), &
      & number_bounds("IYH", "integer", "last row", &
      & 1.0_wp, 999999.0_wp, .false., "a row number"), &
      & number_bounds("NX", "integer", "number of points along x", &
      & 1.0_wp, 9999.0_wp, .false., "number of points in one direction"), &
      & number_bounds("NY", "integer", "number of points along y", &
      & 1.0_wp, 9999.0_wp, .false., "number of points in one direction"), &
      & number_bounds("NZ", "integer", "number of depths", &
      & 1.0_wp, 9999.0_wp, .false., "number of points in one direction"), &
      & number_bounds("IX", "-", "columns", &
      & -1.0e9_wp, 1.0e9_wp, .false., "a column number, rounded"), &
      & number_bounds("IY", "-", "rows", &
      & -1.0e9_wp, 1.0e9_wp, .false., "a row number, rounded"), &
      & number_bounds("X", "mm", "x of the points", &
      & -far, far, .false., "1 km from the contact"), &
      & number_bounds("Y", "mm", "y of the points", &
      & -far, far, .false., "1 km from the contact"), &
      & number_bounds("Z", "mm", "depths", &
      & -far, far, .false., "1 km from the contact"), &
      & number_bounds("ZL", "mm", "first depth", &
      & -far, far, .false., "1 km from the contact"), &
      & number_bounds("DZ", "mm", "distance of depths", &
      & 1.0e-9_wp, far, .false., "from less than an atom to 1 km")]

   type(number_bounds), parameter :: track_rows(*) = [ &
      & number_bounds("DS", "mm", "element size along the profile", &
      & tiny_side, far, .false., "from less than an atom to 1 km"), &
      & number_bounds("DQREL", "-", "step in elements", &
      & 5.0e-7_wp, 10.0_wp, .false., "a step in elements", .true.), &
      & number_bounds("A_SEP", "rad", "angle of separate patches", &
      & -1.0e4_wp, 1.0e4_wp, .false., "an angle; from pi on patches are never separated", .true.), &
      & number_bounds("D_SEP", "mm", "distance of separate patches", &
      & -far, far, .false., "a distance between patches", .true.), &
      & number_bounds("D_COMB", "mm", "distance of combined patches", &
      & -far, far, .false., "a distance between patches", .true.), &
      & number_bounds("D_TURN", "mm", "distance of patches with own planes", &
      & -far, far, .false., "a distance between patches"), &
      & number_bounds("G_MISS", "mm", "gap up to which a patch is enlarged", &
      & -far, far, .false., "a gap; negative means never"), &
      & number_bounds("GAUGHT", "mm", "height of the gauge point", &
      & -far, 200.0_wp, .false., "higher than any rail; 0 or less: absolute placement"), &
      & number_bounds("GAUGSQ", "-", "number of the gauge point", &
      & -1.0e9_wp, 1.0e9_wp, .false., "read but not used"), &
      & number_bounds("GAUGWD", "mm", "gauge", &
      & -far, far, .false., "a gauge of 1 km"), &
      & number_bounds("RAILY0", "mm", "lateral position of the rail", &
      & -far, far, .false., "1 km from the track"), &
      & number_bounds("RAILZ0", "mm", "vertical position of the rail", &
      & -far, far, .false., "1 km from the track"), &
      & number_bounds("CANT", "rad", "cant of the rail", &
      & -two_turns, two_turns, .false., "an angle; in degrees with a suffix: 1.43d"), &
      & number_bounds("NOMRAD", "mm", "nominal radius", &
      & 1.0e-3_wp, 1.0e9_wp, .false., "from 1 micrometre to 1000 km"), &
      & number_bounds("CURV", "1/mm", "curvature of the track", &
      & -1.0_wp, 1.0_wp, .false., "a radius of 1 mm"), &
      & number_bounds("DYRAIL", "mm", "lateral deviation of the rail", &
      & -far, far, .false., "1 km from the track", .true.), &
      & number_bounds("DZRAIL", "mm", "vertical deviation of the rail", &
      & -far, far, .false., "1 km from the track", .true.), &
      & number_bounds("DROLLR", "rad", "roll of the rail", &
      & -two_turns, two_turns, .false., "an angle; in degrees with a suffix: 1d", .true.), &
      & number_bounds("VYRAIL", "mm/s", "lateral velocity of the rail", &
      & -fast, fast, .false., "1000 km/s", .true.), &
      & number_bounds("VZRAIL", "mm/s", "vertical velocity of the rail", &
      & -fast, fast, .false., "1000 km/s", .true.), &
      & number_bounds("VROLLR", "rad/s", "roll rate of the rail", &
      & -many_turns, many_turns, .false., "faster than any rotor", .true.), &
      & number_bounds("KYRAIL", "N/mm", "lateral stiffness of the rail", &
      & 0.0_wp, rigid, .false., "stiffness is not negative; practically rigid"), &
      & number_bounds("FYRAIL", "N", "lateral spring force of the rail at rest", &
      & -heavy, heavy, .false., "beyond any load"), &
      & number_bounds("KZRAIL", "N/mm", "vertical stiffness of the rail", &
      & 0.0_wp, rigid, .false., "stiffness is not negative; practically rigid"), &
      & number_bounds("FZRAIL", "N", "vertical spring force of the rail at rest", &
      & -heavy, heavy, .false., "beyond any load"), &
      & number_bounds("DYSTEP0", "mm", "first trial step of the lateral deflection", &
      & 0.0_wp, far, .true., "a positive trial step"), &
      & number_bounds("PROFILE", "mm ...", "number in a profile file", &
      & -1.0e9_wp, 1.0e9_wp, .false., "1 km in micrometres"), &
      & number_bounds("MIRRORY", "integer", "mirror the profile in y?", &
      & -1.0_wp, 1.0_wp, .false., "1: yes; 0 and -1: no", .true.), &
      & number_bounds("MIRRORZ", "integer", "mirror the profile in z?", &
      & -1.0_wp, 1.0_wp, .false., "1: yes; -1: no; 0: chosen from the file"), &
      & number_bounds("SCALEYZ", "-", "factor to mm", &
      & -1.0e9_wp, 1.0e9_wp, .false., "a unit factor", .true.), &
      & number_bounds("SMOOTH", "mm ...", "parameter of smoothing", &
      & -1.0e9_wp, 1.0e9_wp, .false., "a wavelength or a weight", .true.), &
      & number_bounds("PRFOPT", "integer", "groups of options that follow", &
      & 0.0_wp, 2.0_wp, .false., "number of groups"), &
      & number_bounds("ISMOOTH", "integer", "smoothing method", &
      & 0.0_wp, 2.0_wp, .false., "number of an existing method", .true.), &
      & number_bounds("ZIGTHRS", "rad", "turning angle of a zig-zag", &
      & -1.0e4_wp, 1.0e4_wp, .false., "an angle; in degrees with a suffix: 150d", .true.), &
      & number_bounds("KINKHIGH", "rad", "turning angle of a kink", &
      & -1.0e4_wp, 1.0e4_wp, .false., "an angle; in degrees with a suffix: 30d", .true.), &
      & number_bounds("KINKLOW", "rad", "largest turning angle beside a kink", &
      & -1.0e4_wp, 1.0e4_wp, .false., "an angle; in degrees with a suffix: 6d", .true.), &
      & number_bounds("KINKWID", "mm", "reach of a kink", &
      & -far, far, .false., "a distance in a profile", .true.), &
      & number_bounds("ERRHND", "integer", "level of error handling", &
      & -2.0_wp, 1.0_wp, .false., "number of an existing level", .true.), &
      & number_bounds("MAXOMIT", "-", "part of the profile that may be left out", &
      & -1.0e9_wp, 1.0e9_wp, .false., "a fraction of the points", .true.)]

   type(number_bounds), parameter :: wheel_rows(*) = [ &
      & number_bounds("FBDIST", "mm", "flange-back distance", &
      & -far, far, .false., "a wheelset of 1 km"), &
      & number_bounds("FBPOS", "mm", "position of the flange back in the profile", &
      & -far, far, .false., "a wheel of 1 km"), &
      & number_bounds("YTAPE", "mm", "position of the nominal radius", &
      & -1.0e9_wp, 1.0e9_wp, .false., "from 999 on: no tape line"), &
      & number_bounds("S_WS", "mm", "position along the track", &
      & -far_along, far_along, .false., "1e6 km of track", .true.), &
      & number_bounds("X_WS", "mm", "longitudinal position on the roller", &
      & -far, far, .false., "1 km from the roller", .true.), &
      & number_bounds("Y_WS", "mm", "lateral position", &
      & -far, far, .false., "1 km from the track", .true.), &
      & number_bounds("Z_WS", "mm", "height, when prescribed", &
      & -far, far, .false., "1 km from the track"), &
      & number_bounds("FZ", "N", "vertical force, when prescribed", &
      & -heavy, heavy, .false., "beyond any load"), &
      & number_bounds("ROLL", "rad", "roll angle", &
      & -two_turns, two_turns, .false., "an angle; in degrees with a suffix: 1d", .true.), &
      & number_bounds("YAW", "rad", "yaw angle", &
      & -two_turns, two_turns, .false., "an angle; in degrees with a suffix: 1d", .true.), &
      & number_bounds("PITCH", "rad", "pitch angle", &
      & -many_turns, many_turns, .false., "turns accumulate during a run", .true.), &
      & number_bounds("VS", "mm/s", "forward speed", &
      & -fast, fast, .false., "1000 km/s"), &
      & number_bounds("VY", "mm/s", "lateral velocity", &
      & -fast, fast, .false., "1000 km/s", .true.), &
      & number_bounds("VZ", "mm/s", "vertical velocity", &
      & -fast, fast, .false., "1000 km/s", .true.), &
      & number_bounds("VROLL", "rad/s", "roll rate", &
      & -many_turns, many_turns, .false., "faster than any rotor", .true.), &
      & number_bounds("VYAW", "rad/s", "yaw rate", &
      & -many_turns, many_turns, .false., "faster than any rotor", .true.), &
      & number_bounds("VPITCH", "rad/s", "pitch rate, when prescribed", &
      & -many_turns, many_turns, .false., "faster than any rotor"), &
      & number_bounds("RPITCH", "rad/s", "pitch rate of the roller", &
      & -many_turns, many_turns, .false., "faster than any rotor"), &
      & number_bounds("FX_WS", "N", "longitudinal force, when prescribed", &
      & -heavy, heavy, .false., "beyond any load"), &
      & number_bounds("DXWHL", "mm", "longitudinal deviation of the wheel", &
      & -far, far, .false., "a deviation of 1 km", .true.), &
      & number_bounds("DYWHL", "mm", "lateral deviation of the wheel", &
      & -far, far, .false., "a deviation of 1 km", .true.), &
      & number_bounds("DZWHL", "mm", "vertical deviation of the wheel", &
      & -far, far, .false., "a deviation of 1 km", .true.), &
      & number_bounds("DROLLW", "rad", "roll of the wheel", &
      & -two_turns, two_turns, .false., "an angle; in degrees with a suffix: 1d", .true.), &
      & number_bounds("DYAWW", "rad", "yaw of the wheel", &
      & -two_turns, two_turns, .false., "an angle; in degrees with a suffix: 1d", .true.), &
      & number_bounds("DPITCHW", "rad", "pitch of the wheel", &
      & -many_turns, many_turns, .false., "turns accumulate during a run", .true.), &
      & number_bounds("VXWHL", "mm/s", "longitudinal velocity of the wheel", &
      & -fast, fast, .false., "1000 km/s", .true.), &
      & number_bounds("VYWHL", "mm/s", "lateral velocity of the wheel", &
      & -fast, fast, .false., "1000 km/s", .true.), &
      & number_bounds("VZWHL", "mm/s", "vertical velocity of the wheel", &
      & -fast, fast, .false., "1000 km/s", .true.), &
      & number_bounds("VROLLW", "rad/s", "roll rate of the wheel", &
      & -many_turns, many_turns, .false., "faster than any rotor", .true.), &
      & number_bounds("VYAWW", "rad/s", "yaw rate of the wheel", &
      & -many_turns, many_turns, .false., "faster than any rotor", .true.), &
      & number_bounds("VPITCHW", "rad/s", "pitch rate of the wheel", &
      & -many_turns, many_turns, .false., "faster than any rotor", .true.)]

   !> All rows, in the order of the groups of a case
   type(number_bounds), parameter :: bounds_table(*) = [solver_rows, motion_rows, friction_rows, material_rows, grid_rows, &
      & subsurface_rows, track_rows, wheel_rows]
   !> Is the number an angle or its rate?
   logical, parameter :: is_angle(*) = bounds_table%unit == "rad" .or. bounds_table%unit == "rad/s"
   !> Rates in rolling that are displacements and rotations in shifts
   character(len=*), parameter :: rates(*) = [character(len=7) :: "CPHI", "VS", "VY", "VZ", "VROLL", "VYAW", "VPITCH", "RPITCH", &
      & "VYRAIL", "VZRAIL", "VROLLR", "VXWHL", "VYWHL", "VZWHL", "VROLLW", "VYAWW", "VPITCHW"]
   !> The names as an array, to be searched, and their first letters, terminated by 0
   character(len=*), parameter :: names(*) = bounds_table%name
   integer, parameter :: letters(*) = [iachar(names(:)(1:1)), 0]
   integer :: i
   !> First row with a given initial, 0: none, and next row with the same initial; the last one is followed by itself
   integer, parameter :: first_row(0:127) = [(findloc(letters(:size(names)), i, dim=1), i=0, 127)]
   integer, parameter :: next_row(*) = [(i + findloc(letters(i + 1:), letters(i), dim=1), i=1, size(names))]

contains

   !> Row of a name in the table, 0 if there is none
   !>
   !> An index in brackets is ignored. Trailing digits and the trailing letter of a body are significant only if the name is
   !> in the table with them: B(3) is B, GG2 is GG, NOMRADW is NOMRAD.
   pure integer function bounds_of(name) result(row)
      !> Name as in messages and in the manual
      character(len=*), intent(in) :: name
      integer :: last

      row = row_of(name)
      if (row > 0) return
      last = len_trim(name)
      if (name(last:last) == ")") last = index(name, "(") - 1
      row = row_of(name(:last))
      do while (row == 0 .and. last > 1)
         if (verify(name(last:last), "0123456789NTRW") > 0) return
         last = last - 1
         row = row_of(name(:last))
      end do
   end function bounds_of

   !> Row of exactly this name, 0 if there is none
   pure integer function row_of(name) result(row)
      character(len=*), intent(in) :: name
      character(len=len(names)) :: whole
      integer :: letter

      row = 0
      letter = iachar(name(1:1))
      if (len_trim(name) > len(whole) .or. letter > ubound(first_row, 1)) return
      whole = name
      row = first_row(letter)
      if (row == 0) return
      do
         if (names(row) == whole) return
         if (next_row(row) == row) exit
         row = next_row(row)
      end do
      row = 0
   end function row_of

   !> Unit of a number in a case: in shifts creepages and velocities are displacements and rotations
   !>
   !> Without motion either of two units has a meaning, as for the cases that follow: "- or mm". Padded with blanks.
   pure function unit_of(row, moves) result(unit)
      !> Row of the table
      integer, intent(in) :: row
      !> Member of motion
      integer, intent(in) :: moves
      character(len=unit_length) :: unit
      integer :: last

      unit = bounds_table(row)%unit
      last = index(unit, "/") - 1
      if (any(rates == bounds_table(row)%name)) unit = trim(unit) // " or " // unit(:last)
      last = index(unit, " or ")
      if (last == 0 .or. moves == motion%none) return
      if (moves == motion%shift) then
         unit = unit(last + 4:)
      else
         unit = unit(:last - 1)
      end if
   end function unit_of

   !> Is a value within the bounds of a row of the table? False if there is no such row
   pure logical function is_within(row, value)
      !> Row of the table, 0: none
      integer, intent(in) :: row
      !> In the unit of the row
      real(wp), intent(in) :: value

      is_within = .false.
      if (row == 0 .or. .not. ieee_is_finite(value)) return
      if (value > bounds_table(row)%highest) return
      is_within = value > bounds_table(row)%lowest .or. (value >= bounds_table(row)%lowest .and. .not. bounds_table(row)%is_open)
   end function is_within

   !> "GG1 = 1e-30 is below its lower bound 1.00000E-05 N/mm2: from the softest gels ..."
   subroutine describe_breach(name, word, value, complaint, shown)
      !> Name as in the input files
      character(len=*), intent(in) :: name
      !> The value as given, "" to format it here
      character(len=*), intent(in) :: word
      !> In the unit of the row
      real(wp), intent(in) :: value
      !> Unallocated if the value is within its bounds
      character(len=:), allocatable, intent(out) :: complaint
      !> Name to show in the message, if different
      character(len=*), intent(in), optional :: shown
      character(len=:), allocatable :: who
      type(number_bounds) :: bounds
      integer :: row

      row = bounds_of(name)
      if (row == 0) then
         complaint = name // " is missing in the table of bounds of this program, which is a program fault"
         return
      end if
      if (is_within(row, value)) return
      bounds = bounds_table(row)
      who = name
      if (present(shown)) who = shown
      if (.not. ieee_is_finite(value)) then
         complaint = who // " is infinite, not a number or missing"
         return
      end if
      complaint = who // " = " // word
      if (len(word) == 0) complaint = who // " = " // real_text(value)
      if (bounds%unit == "integer") then
         complaint = complaint // " is outside its range " // integer_text(nint(bounds%lowest)) // " to " // &
            & integer_text(nint(bounds%highest))
      else if (value > bounds%highest) then
         complaint = complaint // " is above its upper bound " // real_text(bounds%highest) // unit_text(bounds)
      else if (bounds%is_open) then
         complaint = complaint // " must be larger than " // real_text(bounds%lowest) // unit_text(bounds)
      else
         complaint = complaint // " is below its lower bound " // real_text(bounds%lowest) // unit_text(bounds)
      end if
      complaint = complaint // ": " // trim(bounds%reason)
   end subroutine describe_breach

   !> Does the number have no single unit to be shown?
   pure logical function has_no_unit(bounds)
      type(number_bounds), intent(in) :: bounds
      has_no_unit = bounds%unit(:1) == "-" .or. index(bounds%unit, "...") > 0
   end function has_no_unit

   !> The unit after a number; empty if it depends on the number or there is none
   pure function unit_text(bounds) result(text)
      type(number_bounds), intent(in) :: bounds
      character(len=merge(0, len_trim(bounds%unit) + 1, has_no_unit(bounds))) :: text

      text = ""
      if (len(text) > 0) text = " " // bounds%unit
   end function unit_text

   !> Report a number beyond its bounds as an error; an earlier error is kept
   subroutine check_number(name, value, error, shown)
      !> Name as in the input files
      character(len=*), intent(in) :: name
      !> In the unit of the table
      real(wp), intent(in) :: value
      type(error_type), allocatable, intent(inout) :: error
      !> Name to show in the message, if different
      character(len=*), intent(in), optional :: shown
      character(len=:), allocatable :: complaint

      if (allocated(error)) return
      call describe_breach(name, "", value, complaint, shown)
      if (allocated(complaint)) call fatal_error(error, complaint)
   end subroutine check_number
end module contact_text_bounds
