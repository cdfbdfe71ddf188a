!> Surface temperatures of a patch
module contact_patch_heat
   use contact_base_choices, only : motion
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_grid_element_division, only : bounding_box, contact_box, element
   use contact_patch_problem, only : patch_problem, rolling_direction
   use contact_patch_result, only : patch_result
   use contact_temperature_flash_heating, only : heat_passage, min_peclet_number
   implicit none (type, external)
   private

   public :: derive_temperatures, frictional_heat, new_heat_passage

contains

   !> Motion of the surfaces through the contact area
   pure function new_heat_passage(problem, division) result(passage)
      !> Must have thermal constants
      type(patch_problem), intent(in) :: problem
      !> Element states, shape (mx, my)
      integer, intent(in) :: division(:, :)
      type(heat_passage) :: passage

      passage%bodies = problem%thermal
      passage%dx = problem%grid%dx
      passage%veloc = problem%veloc
      passage%direction = rolling_direction(problem)
      allocate(passage%contact(size(division, 1), size(division, 2)))
      passage%contact = division > element%exterior
   end function new_heat_passage

   !> Temperatures of both surfaces from slip and tractions; bulk temperatures without motion
   subroutine derive_temperatures(problem, log, result)
      !> Thermal constants, friction law, motion and step
      type(patch_problem), intent(in) :: problem
      !> Receives a warning if the steps are too long for the model
      type(log_type), intent(inout) :: log
      !> Solution with element states, slip and tractions
      type(patch_result), intent(inout) :: result
      type(heat_passage) :: passage
      real(wp), allocatable :: heat(:, :)

      if (allocated(result%temp1)) deallocate(result%temp1, result%temp2)
      if (.not. allocated(problem%thermal)) return
      allocate(result%temp1(problem%grid%mx, problem%grid%my), source=problem%thermal%bulk(1))
      allocate(result%temp2(problem%grid%mx, problem%grid%my), source=problem%thermal%bulk(2))
      if (problem%motion /= motion%steady_rolling) return
      passage = new_heat_passage(problem, result%division)
      heat = frictional_heat(problem, result)
      call passage%surface_temperatures(heat, result%temp1, result%temp2)
      if (any(heat > 0.0_wp)) call warn_of_slow_motion(problem, log, result)
   end subroutine derive_temperatures

   !> Heat by slip and by plastic work, in steady rolling [N/(mm s)], shape (mx, my)
   pure function frictional_heat(problem, result) result(heat)
      !> Thermal constants and motion
      type(patch_problem), intent(in) :: problem
      !> Solution with slip and tractions
      type(patch_result), intent(in) :: result
      real(wp), allocatable :: heat(:, :)
      integer :: ahead

      heat = hypot(result%sx, result%sy)
      if (allocated(result%uplx)) then
         ! plastic displacement of the step: the difference to the next element upstream
         ahead = rolling_direction(problem)
         heat = heat + problem%thermal%plastic_share*hypot(result%uplx - eoshift(result%uplx, ahead), &
            & result%uply - eoshift(result%uply, ahead))
      end if
      heat = heat*hypot(result%px, result%py)/result%dt
   end function frictional_heat

   !> The temperatures hold for fast motion: warn if conduction along the surface is not slow compared with convection
   subroutine warn_of_slow_motion(problem, log, result)
      !> With thermal constants
      type(patch_problem), intent(in) :: problem
      type(log_type), intent(inout) :: log
      !> With element states
      type(patch_result), intent(in) :: result
      type(bounding_box) :: box
      character(len=12) :: number
      real(wp) :: peclet

      box = contact_box(result%division)
      peclet = problem%thermal%peclet_number(0.5_wp*(box%ix1 - box%ix0 + 1)*problem%grid%dx, problem%veloc)
      if (peclet >= min_peclet_number) return
      write(number, "(F12.3)") peclet
      call log%warning("temperatures are those of fast motion, in which no heat flows along the surface; the Peclet number " // &
         & "V a/(2 kappa) = " // trim(adjustl(number)) // " is below 10, and temperatures are too high")
   end subroutine warn_of_slow_motion
end module contact_patch_heat
