!> Simplified methods in place of the full theory, where their error is known and below what is asked, and only by permission
!>
!> Errors are the largest of FX, FY, MZ, FN or approach, and creepages that are found, over random ellipses with semi-axes of 1/5 to
!> 5 to each other, from adhesion to full sliding, against the full theory on fine grids: tests/accuracy/approximate.py, with some
!> room above the largest that was seen. See doc/theory/accuracy.md.
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

   public :: approximate_method, choose_method, take_method

   !> What may take the place of the full theory where an accuracy is asked for: words of the readable format and the command line
   character(len=*), parameter, public :: allowances(2) = [character(len=11) :: "nothing", "approximate"]

   !> Kinds of contact that errors are known for
   type :: kind_list
      !> None: what is not measured is not chosen
      integer :: unknown = 0
      !> Pressures only
      integer :: normal = 1
      !> Steady rolling with given creepages: without spin; with less of it than creepage; with more
      integer :: no_spin = 2, little_spin = 3, much_spin = 4
      !> Steady rolling with given forces, and without spin
      integer :: forces = 5
   end type kind_list
   type(kind_list), parameter :: kind_of_contact = kind_list()

   !> A method on a grid, and its largest error in contacts of a kind
   type :: measured_method
      !> Member of kind_of_contact
      integer :: kind = 0
      !> Member of material_model: elastic where there are pressures only
      integer :: model = material_model%elastic
      !> Elements along each side of the ellipse
      integer :: elements = 20
      !> Largest relative error of the forces [-]
      real(wp) :: error = 0.0_wp
   end type measured_method

   !> What was measured; the first one of a kind that is exact enough is chosen, which is the quickest
   type(measured_method), parameter :: measured(*) = [ &
      & measured_method(kind_of_contact%normal, material_model%elastic, 20, 1.0e-5_wp), &
      & measured_method(kind_of_contact%no_spin, material_model%fastrip, 20, 0.055_wp), &
      & measured_method(kind_of_contact%little_spin, material_model%fastrip, 20, 0.09_wp), &
      & measured_method(kind_of_contact%much_spin, material_model%fastsim, 40, 0.12_wp), &
      & measured_method(kind_of_contact%forces, material_model%fastrip, 20, 0.09_wp)]

   !> Ratios of semi-axes that were measured
   real(wp), parameter :: largest_ratio = 5.0_wp
   !> Spin over spin and creepage, spin times the root of a b: what counts as none, and what as much
   real(wp), parameter :: no_share = 1.0e-6_wp, much_share = 0.5_wp
   !> Sines of angles of rolling that are along x
   real(wp), parameter :: along_x = 1.0e-6_wp

   !> What was chosen
   type :: approximate_method
      !> Is there one?
      logical :: found = .false.
      type(measured_method) :: method
      !> What is told, with blanks behind: the method and its error, or why there is none
      character(len=longest_method) :: words = ""
   end type approximate_method

contains

   !> The quickest method whose error is known to be below what is asked
   subroutine choose_method(spec, chosen)
      !> With an accuracy; of either module
      type(case_spec), intent(in) :: spec
      !> A method, or why there is none
      type(approximate_method), intent(out) :: chosen
      character(len=:), allocatable :: why
      integer :: kind, k
      real(wp) :: best

      call judge(spec, kind, why)
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

   !> Kind of a contact, or why no error is known for it
   subroutine judge(spec, kind, why)
      type(case_spec), intent(in) :: spec
      !> Member of kind_of_contact
      integer, intent(out) :: kind
      !> Where the kind is unknown
      character(len=:), allocatable, intent(out) :: why

      kind = kind_of_contact%unknown
      why = trim(reason_against(spec))
      if (why == "") call judge_ellipse(spec, kind, why)
   end subroutine judge

   !> Why errors are not known for a case, whatever its ellipse, with blanks behind; blank where they may be
   function reason_against(spec) result(why)
      type(case_spec), intent(in) :: spec
      character(len=longest_method) :: why
      type(combined_material) :: material

      why = ""
      material = combine(spec%material%poiss, spec%material%gg)
      if (allocated(spec%wheel_rail)) then
         why = "KPEC and ANALYN are wrong by up to 0.1 on wheels and rails, and take as long as the full theory on fewer elements"
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
         why = "errors of unlike bodies are not known"
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

   !> Kind of a contact by its ellipse, its motion and its spin
   subroutine judge_ellipse(spec, kind, why)
      type(case_spec), intent(in) :: spec
      !> Member of kind_of_contact
      integer, intent(out) :: kind
      !> Where the kind is unknown
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
   end subroutine judge_ellipse

   !> Name of a method, with blanks behind
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

   !> A kind of contact in words, with blanks behind
   pure function title_of(kind) result(title)
      !> Member of kind_of_contact
      integer, intent(in) :: kind
      character(len=30) :: title
      character(len=30), parameter :: titles(5) = [character(len=30) :: "of the approach", "without spin", &
         & "with less spin than creepage", "with more spin than creepage", "with given forces"]

      title = titles(kind)
   end function title_of

   !> Make the choice part of a case
   pure subroutine take_method(chosen, spec)
      !> Found
      type(approximate_method), intent(in) :: chosen
      !> Gets the method, its pressures and its elements
      type(case_spec), intent(inout) :: spec

      spec%pressure = pressure_model%elliptical
      spec%material_model = chosen%method%model
      spec%material%k0_mf = 1.0_wp
      spec%material%alfamf = 1.0_wp
      spec%material%betamf = 1.0_wp
      spec%grid%mx = chosen%method%elements
      spec%grid%my = chosen%method%elements
      spec%grid%scale = 1.0_wp
   end subroutine take_method
end module contact_cases_approximate_methods
