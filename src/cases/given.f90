!> Which numbers the cases of a sequence have given
!>
!> The numbers of a model are in a group that a case may keep while it selects another model. Before a case has given them they
!> have initial values, which are not meant for a computation.
module contact_cases_given
   use contact_base_choices, only : force_control, material_model, motion, pressure_model
   implicit none (type, external)
   private

   public :: all_given, given_numbers, note_materials, note_velocity

   !> What the cases of a sequence have given so far
   type :: given_numbers
      !> Flexibility of a thin sheet, viscoelastic constants, slope reduction, flexibility of simplified theory, layer
      logical :: sheet = .false., viscoelastic = .false., slopes = .false., flexibility = .false., layer = .false.
      !> Rolling direction, step and velocity; false again when a case without rolling has reset them
      logical :: rolling = .false.
      !> Springs of the rail; cant of a track and radius of a roller
      logical :: springs = .false., cant = .false., roller_radius = .false.
      !> Pitch rate of the wheelset, or the longitudinal force instead; speed along the track, or the pitch rate of a roller
      logical :: pitch_rate = .false., longitudinal_force = .false., speed = .false., roller_rate = .false.
      !> Has there been a case with friction, and are the velocities or creepages given last displacements and rotations of a shift?
      logical :: has_motion = .false., are_shifts = .false.
      !> Are the rates of the rail, those of the flexible wheelset, the extra rigid slip given last those of a shift?
      logical :: rail_shifts = .false., flexible_shifts = .false., slip_shifts = .false.
      !> Was it judged whether the number of outer iterations suits the bodies? Without friction it does not matter
      logical :: outer_iterations_judged = .false.
   end type given_numbers

contains

   !> The group of materials was read
   pure subroutine note_materials(given, pressure, model)
      !> Updated
      type(given_numbers), intent(inout) :: given
      !> Members of pressure_model and material_model
      integer, intent(in) :: pressure, model

      given%sheet = given%sheet .or. pressure == pressure_model%thin_sheet
      select case (model)
      case (material_model%viscoelastic)
         given%viscoelastic = .true.
      case (material_model%interfacial_layer)
         given%layer = .true.
      case (material_model%fastsim_single, material_model%fastsim, material_model%fastrip)
         given%slopes = .true.
         given%flexibility = given%flexibility .or. model == material_model%fastsim_single
      end select
   end subroutine note_materials

   !> The velocities of a wheelset were read
   pure subroutine note_velocity(given, roller, force, moves)
      !> Updated
      type(given_numbers), intent(inout) :: given
      !> Is the wheel on a roller?
      logical, intent(in) :: roller
      !> Members of force_control and motion
      integer, intent(in) :: force, moves

      given%speed = given%speed .or. .not. roller
      given%roller_rate = given%roller_rate .or. roller
      given%longitudinal_force = given%longitudinal_force .or. force == force_control%longitudinal_force
      given%pitch_rate = given%pitch_rate .or. force /= force_control%longitudinal_force
      given%are_shifts = moves == motion%shift
   end subroutine note_velocity

   !> Everything was given: settings of a caller replace initial values that are documented
   pure function all_given(moves) result(given)
      !> Motion to which the velocities belong, member of motion
      integer, intent(in) :: moves
      type(given_numbers) :: given

      given = given_numbers(sheet=.true., viscoelastic=.true., slopes=.true., flexibility=.true., layer=.true., rolling=.true., &
         & springs=.true., cant=.true., roller_radius=.true., pitch_rate=.true., longitudinal_force=.true., speed=.true., &
         & roller_rate=.true., are_shifts=moves == motion%shift)
   end function all_given
end module contact_cases_given
