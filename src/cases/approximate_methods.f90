!> Simplified methods that replace the full theory if their error is known to be below the requested one, and if the user allows it
!>
!> Errors are the maximum of those of FX, FY, MZ, FN or approach, and creepages that are found, over random ellipses with ratios of
!> semi-axes from 1/5 to 5, from adhesion to full sliding, compared with the full theory on fine grids:
!> tests/accuracy/approximate.py, with a margin above the largest value found. See doc/theory/accuracy.md.
module contact_cases_approximate_methods
   use contact_base_accuracy_report, only : longest_method
   use contact_base_choices, only : force_control, kernel_model, material_model, motion, pressure_model, slip_source, variation
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_geometry, only : solve_hertz
   use contact_cases_spec, only : case_spec
   use contact_elastic_material, only : combine, combined_material
   use contact_friction_new_law, only : is_varying_law
   use contact_patch_result, only : hertz_result
   use contact_text_words, only : integer_text, real_text
   implicit none (type, external)
   private

   public :: approximate_method, choose_method, use_method

   !> Values of the option that allows simplified methods with a requested accuracy: words of the readable format and the command
   !> line
   character(len=*), parameter, public :: allowances(2) = [character(len=11) :: "nothing", "approximate"]

   !> Kinds of contact with known errors
   type :: kind_list
      !> Unknown: no method is chosen
      integer :: unknown = 0
      !> Pressures only
      integer :: normal = 1
      !> Steady rolling with given creepages: without spin; with less spin than creepage; with more spin
      integer :: no_spin = 2, little_spin = 3, much_spin = 4
      !> Steady rolling with given forces and without spin
      integer :: forces = 5
   end type kind_list
   type(kind_list), parameter :: kind_of_contact = kind_list()

   !> A method on a grid, and its maximum error for a kind of contact
   type :: measured_method
      !> Member of kind_of_contact
      integer :: kind = 0
      !> Member of material_model; elastic for pressures only
      integer :: model = material_model%elastic
      !> Number of elements across the ellipse in each direction
      integer :: elements = 20
      !> Maximum relative error of the forces [-]
      real(wp) :: error = 0.0_wp
   end type measured_method

   !> Measured errors; for each kind, methods are in order of increasing time, and the first one that is accurate enough is chosen
   type(measured_method), parameter :: measured(*) = [ &
      & measured_method(kind_of_contact%normal, material_model%elastic, 20, 1.0e-5_wp), &
      & measured_method(kind_of_contact%no_spin, material_model%fastrip, 20, 0.055_wp), &
      & measured_method(kind_of_contact%little_spin, material_model%fastrip, 20, 0.09_wp), &
      & measured_method(kind_of_contact%much_spin, material_model%fastsim, 40, 0.12_wp), &
      & measured_method(kind_of_contact%forces, material_model%fastrip, 20, 0.09_wp)]

   !> Range of ratios of semi-axes in the measurement
   real(wp), parameter :: largest_ratio = 5.0_wp
   !> Bounds for the ratio of spin to spin and creepage, with spin times sqrt(a b): below the first one there is no spin, above the
   !> second one much
   real(wp), parameter :: no_share = 1.0e-6_wp, much_share = 0.5_wp
   !> Sine of the maximum angle between rolling direction and x axis
   real(wp), parameter :: along_x = 1.0e-6_wp

   !> Method that was chosen
   type :: approximate_method
      !> Is there a suitable method?
      logical :: found = .false.
      type(measured_method) :: method
      !> Text for the log, blank-padded: the method and its error, or why there is none
      character(len=longest_method) :: words = ""
   end type approximate_method

contains

   !> Choose the fastest method whose error is known to be below the requested one
   subroutine choose_method(spec, chosen)
      !> Case with a requested accuracy, of either module
      type(case_spec), intent(in) :: spec
      !> A method, or the reason why there is none
      type(approximate_method), intent(out) :: chosen
      character(len=:), allocatable :: why
      integer :: kind, k
      real(wp) :: best

      call find_kind(spec, kind, why)
      best = huge(best)
      do k = 1, size(measured)
         if (measured(k)%kind /= kind) cycle
         best = min(best, measured(k)%error)
         if (measured(k)%error > spec%iteration%accuracy) cycle
         chosen%found = .true.
         chosen%method = measured(k)
         exit
      end do
      if (chosen%found) then
         chosen%words = trim(name_of(chosen%method)) // " on " // integer_text(chosen%method%elements) // " x " // &
            & integer_text(chosen%method%elements) // " elements; largest error that was measured " // trim(title_of(kind)) // &
            & ": " // real_text(chosen%method%error)
      else if (kind /= kind_of_contact%unknown) then
         chosen%words = "none, as errors " // trim(title_of(kind)) // " are up to " // real_text(best)
      else
         chosen%words = "none, as " // why
      end if
   end subroutine choose_method

   !> Kind of a contact, or reason why no error is known for it
   subroutine find_kind(spec, kind, why)
      type(case_spec), intent(in) :: spec
      !> Member of kind_of_contact
      integer, intent(out) :: kind
      !> Reason; set if the kind is unknown
      character(len=:), allocatable, intent(out) :: why

      kind = kind_of_contact%unknown
      why = trim(reason_against(spec))
      if (why == "") call find_kind_of_ellipse(spec, kind, why)
   end subroutine find_kind

   !> Reason why errors are not known for a case, independent of its ellipse, blank-padded; blank if there is none
   function reason_against(spec) result(why)
      type(case_spec), intent(in) :: spec
      character(len=longest_method) :: why
      type(combined_material) :: material

      why = ""
      material = combine(spec%material%poiss, spec%material%gg)
      if (allocated(spec%wheel_rail)) then
         why = "KPEC and ANALYN have errors up to 0.1 on wheels and rails, and take as long as the full theory on fewer elements"
      else if (.not. spec%grid%is_hertzian() .or. spec%grid%is_line_contact()) then
         why = "pressures by Hertz need a Hertzian option for an ellipse"
      else if (all(spec%motion /= [motion%none, motion%steady_rolling])) then
         why = "errors in shifts are not known"
      else if (spec%pressure /= pressure_model%full .or. spec%kernel /= kernel_model%piecewise_constant &
         & .or. spec%material_model /= material_model%elastic) then
         why = "errors are known for elastic half-spaces"
      else if (spec%has_stress .or. spec%has_wear .or. spec%has_heat) then
         why = "errors of stresses, temperatures and wear are not known"
      end if
      if (why /= "" .or. spec%motion == motion%none) return
      if (material%coupled()) then
         why = "errors for dissimilar materials are not known"
      else if (is_varying_law(spec%friction_law) .or. spec%variation /= variation%none) then
         why = "errors with friction that varies are not known"
      else if (spec%slip_source /= slip_source%none .or. abs(spec%kinematics%spinxo) + abs(spec%kinematics%spinyo) > 0.0_wp) then
         why = "errors with a spin centre or extra slip are not known"
      else if (abs(sin(spec%rolling%chi)) > along_x) then
         why = "errors are known for rolling along x"
      else if (all(spec%force /= [force_control%creepages, force_control%fx_and_fy])) then
         why = "errors with one given force are not known"
      end if
   end function reason_against

   !> Kind of a contact by its ellipse, motion and spin
   subroutine find_kind_of_ellipse(spec, kind, why)
      type(case_spec), intent(in) :: spec
      !> Member of kind_of_contact
      integer, intent(out) :: kind
      !> Reason; set if the kind is unknown
      character(len=:), allocatable, intent(inout) :: why
      type(hertz_result), allocatable :: hertz
      type(error_type), allocatable :: error
      type(combined_material) :: material
      real(wp) :: spin, share

      kind = kind_of_contact%unknown
      why = "there is no ellipse"
      material = combine(spec%material%poiss, spec%material%gg)
      call solve_hertz(spec%grid, spec%normal, spec%kinematics%fn, spec%kinematics%pen, material%gg, material%nu, hertz, error)
      if (allocated(error) .or. .not. allocated(hertz)) return
      if (.not. min(hertz%aa, hertz%bb) > 0.0_wp) return
      why = "errors are known for semi-axes of up to 5 to 1"
      if (max(hertz%aa, hertz%bb) > largest_ratio*min(hertz%aa, hertz%bb)) return
      if (spec%motion == motion%none) then
         kind = kind_of_contact%normal
         return
      end if
      spin = abs(spec%kinematics%cphi)*sqrt(hertz%aa*hertz%bb)
      if (spec%force /= force_control%creepages) then
         why = "errors with given forces and spin are not known"
         if (.not. spin > 0.0_wp) kind = kind_of_contact%forces
         return
      end if
      share = 0.0_wp
      if (spin > 0.0_wp) share = spin/(spin + hypot(spec%kinematics%cksi, spec%kinematics%ceta))
      kind = kind_of_contact%no_spin
      if (share > no_share) kind = kind_of_contact%little_spin
      if (share > much_share) kind = kind_of_contact%much_spin
   end subroutine find_kind_of_ellipse

   !> Name of a method, blank-padded
   pure function name_of(method) result(name)
      type(measured_method), intent(in) :: method
      character(len=18) :: name

      select case (method%model)
      case (material_model%fastrip)
         name = "FaStrip"
      case (material_model%fastsim)
         name = "Fastsim"
      case default
         name = "pressures by Hertz"
      end select
   end function name_of

   !> Description of a kind of contact, blank-padded
   pure function title_of(kind) result(title)
      !> Member of kind_of_contact
      integer, intent(in) :: kind
      character(len=30) :: title
      character(len=30), parameter :: titles(5) = [character(len=30) :: "of the approach", "without spin", &
         & "with less spin than creepage", "with more spin than creepage", "with given forces"]

      title = titles(kind)
   end function title_of

   !> Apply the chosen method to a case
   pure subroutine use_method(chosen, spec)
      !> Method that was found
      type(approximate_method), intent(in) :: chosen
      !> Material model, pressures and elements are set
      type(case_spec), intent(inout) :: spec

      spec%pressure = pressure_model%elliptical
      spec%material_model = chosen%method%model
      spec%material%k0_mf = 1.0_wp
      spec%material%alfamf = 1.0_wp
      spec%material%betamf = 1.0_wp
      spec%grid%mx = chosen%method%elements
      spec%grid%my = chosen%method%elements
      spec%grid%scale = 1.0_wp
   end subroutine use_method
end module contact_cases_approximate_methods
