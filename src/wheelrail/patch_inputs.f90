!> Grid, undeformed distance, creepages and friction of one patch of a pair
module contact_wheelrail_patch_inputs
   use contact_base_choices, only : contact_location, motion, variation
   use contact_base_constants, only : excluded_distance
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : long, wp
   use contact_base_memory, only : bytes_per_element
   use contact_grid_potential_contact, only : potential_contact
   use contact_friction_new_law, only : is_varying_law, new_friction_law
   use contact_profile_curve, only : profile_curve
   use contact_wheelrail_carry_over, only : place_on_lattice
   use contact_wheelrail_creepage, only : flat_creepage, flat_shift, rigid_motion
   use contact_wheelrail_curved_patch, only : curved_rows, new_curved_reference, straight_reference, surface_heights, &
      & surface_motion
   use contact_wheelrail_flat_patch, only : lattice_lead, patch_frame, patch_grid, shift_distance, start_places, &
      & undeformed_distance
   use contact_wheelrail_geometry, only : lattice_x, wheel_rail_geometry, rail_at
   use contact_wheelrail_memory, only : patch_slot
   use contact_wheelrail_placement, only : forward_velocity, rail_motion, wheel_motion
   use contact_wheelrail_problem, only : follows_surface, friction_by_row, keeps_lattice, parameters_at, share_of_rail, &
      & wheel_rail_problem
   use contact_wheelrail_variable, only : variable_distance
   implicit none (type, external)
   private

   public :: set_up_patch

   !> Steps longer than an element by less than this factor are treated as one element
   real(wp), parameter :: longer_step = 1.01_wp

contains

   !> Set up the problem of one patch for its region: all data except the initial estimate
   subroutine set_up_patch(problem, geometry, number, slot, error)
      !> Specification of wheel and rail
      type(wheel_rail_problem), intent(in) :: problem
      !> Positions of the bodies, and the rail in the track
      type(wheel_rail_geometry), intent(inout) :: geometry
      !> Number of the patch
      integer, intent(in) :: number
      !> On entry with the region; grid, distance, creepages and friction are set
      type(patch_slot), intent(inout) :: slot
      !> Allocated if the grid would be too large
      type(error_type), allocatable, intent(out) :: error

      if (allocated(problem%rail_surface)) then
         call set_up_over(rail_at(problem, geometry%placement, slot%region%x), problem, geometry, number, slot, error)
      else
         call set_up_over(geometry%rail_in_track, problem, geometry, number, slot, error)
      end if
   end subroutine set_up_patch

   !> The same, with a section of the rail
   subroutine set_up_over(rail, problem, geometry, number, slot, error)
      !> Section in track coordinates, at the reference; may be that of `geometry`, which is not changed then
      type(profile_curve), intent(in) :: rail
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_geometry), intent(inout) :: geometry
      !> Number of the patch
      integer, intent(in) :: number
      type(patch_slot), intent(inout) :: slot
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: h(:, :)
      real(wp) :: approach, sides(2)

      sides = [problem%spec%search%dx, problem%spec%search%ds]
      slot%plane = patch_frame(rail, geometry%placement, slot%region)
      call move_alloc(slot%problem%h, h)
      slot%problem = problem%template
      slot%problem%pressure_eps = geometry%pressure_eps
      slot%problem%traction_eps = geometry%traction_eps
      slot%problem%follows_approach = geometry%follows
      if (allocated(slot%curve)) deallocate(slot%curve)
      slot%reference = [lattice_x(problem, geometry, slot%region%x), rail%s_at(slot%region%y) - geometry%profile_origin]
      if (keeps_lattice(problem)) then
         call patch_grid(rail, sides, slot%region, slot%plane, slot%reference, huge(1), slot%problem%grid)
      else
         call patch_grid(rail, geometry%coarser*sides, slot%region, slot%plane, lattice_lead(rail, geometry%placement, &
            & slot%region, slot%plane, geometry%coarser*sides), problem%max_elements, slot%problem%grid)
      end if
      if (problem%spec%search%location == contact_location%conformal) &
         & call curved_rows(rail, geometry%bodies, slot%region, slot%plane, slot%problem%grid)
      if (keeps_lattice(problem)) then
         slot%window = place_on_lattice(slot%problem%grid, slot%reference)
         call geometry%before%widen(number, slot%window, slot%problem%grid)
      else
         slot%window = place_on_lattice(slot%problem%grid, [0.0_wp, 0.0_wp])
      end if
      call check_size(problem, slot%problem%grid, error)
      if (.not. allocated(error)) call check_sides(problem, slot%problem%grid, error)
      if (allocated(error)) return
      if (follows_surface(problem)) then
         call follow_surface(problem, geometry, rail, slot, h, approach)
      else
         call cover_overlap(problem, geometry, rail, slot, h, approach)
      end if
      call move_alloc(h, slot%problem%h)
      slot%problem%force_prescribed = .false.
      slot%problem%pen = approach
      if (allocated(slot%region%part)) call divide_patch(rail, slot)
      slot%problem%n_forces = 0
      if (problem%geometry_only) slot%problem%motion = motion%none
      call set_patch_friction(problem, slot, error)
      if (allocated(error)) return
      call set_motion(problem, geometry, slot, approach)
   end subroutine set_up_over

   !> Refuse a grid beyond the limits of the case, and one with which a transient case cannot be solved in practice
   !>
   !> The elements of transient cases are fixed to the rail and are not enlarged if NPOT_MAX is exceeded.
   subroutine check_size(problem, grid, error)
      type(wheel_rail_problem), intent(in) :: problem
      type(potential_contact), intent(in) :: grid
      type(error_type), allocatable, intent(out) :: error
      !> Multiple of NPOT_MAX
      integer(long), parameter :: hopeless = 10_long
      character(len=200) :: text
      integer(long) :: number

      number = int(grid%mx, long)*int(grid%my, long)
      call problem%limits%check(number, bytes_per_element, "elements", error)
      if (allocated(error) .or. number <= hopeless*problem%max_elements) return
      write(text, "(A, I0, A, I0, A)") "a contact patch needs ", number, " elements, more than ten times NPOT_MAX = ", &
         & problem%max_elements, "; larger elements DX and DS, a larger NPOT_MAX, or stiffer bodies"
      call fatal_error(error, trim(text), error_kind%input)
   end subroutine check_size

   !> Refuse elements that NPOT_MAX makes larger than those of a table of influence coefficients
   subroutine check_sides(problem, grid, error)
      type(wheel_rail_problem), intent(in) :: problem
      type(potential_contact), intent(in) :: grid
      type(error_type), allocatable, intent(out) :: error
      !> Relative tolerance
      real(wp), parameter :: same = 1.0e-6_wp
      character(len=280) :: text

      if (.not. allocated(problem%template%model%tabulated)) return
      associate (search => problem%spec%search)
         if (abs(grid%dx - search%dx) <= same*search%dx .and. abs(grid%dy - search%ds) <= same*search%ds) return
      end associate
      write(text, "(A, F0.4, A, F0.4, A, I0, A)") "a contact patch needs larger elements than DX x DS, ", grid%dx, " x ", &
         & grid%dy, " mm, because of NPOT_MAX = ", problem%max_elements, ", but influence coefficients from a file " // &
         & "(material.influence = ""tabulated"") hold for DX x DS only; a larger NPOT_MAX, or a file for larger elements"
      call fatal_error(error, trim(text), error_kind%input)
   end subroutine check_sides

   !> Undeformed distance of a flat patch, on a grid that contains all of the overlap
   !>
   !> The bounds of a region are derived from the vertical gap. Along the normal of the plane the bodies may overlap elsewhere, if
   !> the surface is steep or rough and the wheel yawed; truncating contact there would make the force discontinuous.
   subroutine cover_overlap(problem, geometry, rail, slot, h, approach)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_geometry), intent(inout) :: geometry
      !> The rail in track coordinates in the section of the reference
      type(profile_curve), intent(in) :: rail
      !> With grid and window
      type(patch_slot), intent(inout) :: slot
      !> Undeformed distance [mm] with its minimum at zero, shape (mx, my)
      real(wp), allocatable, intent(inout) :: h(:, :)
      !> Maximum interpenetration along the normal [mm]
      real(wp), intent(out) :: approach
      integer :: most(2)
      logical :: grown

      most = max_elements(slot%problem%grid)
      do
         if (geometry%searches_table) then
            call variable_distance(geometry%bodies, slot%plane, allocated(slot%region%seeds), slot%problem%grid, h, approach, &
               & slot%left_out)
         else
            call start_places(rail, slot%region, slot%distance)
            call undeformed_distance(rail, problem%wheel, geometry%placement, slot%plane, slot%distance, slot%problem%grid, h, &
               & approach, slot%left_out)
         end if
         call leave_to_others(slot, h, approach)
         call grow(slot, h, approach, most, .true., grown)
         if (.not. grown) exit
      end do
   end subroutine cover_overlap

   !> Maximum number of elements in each direction, for a grid that grows because it does not contain all of the overlap
   pure function max_elements(grid) result(most)
      type(potential_contact), intent(in) :: grid
      integer :: most(2)
      !> Multiple of its size; number of added elements for small grids
      integer, parameter :: times = 3, more = 40

      most = max(times*[grid%mx, grid%my], [grid%mx, grid%my] + more)
   end function max_elements

   !> Add elements at sides where the bodies overlap in the outermost elements
   subroutine grow(slot, h, approach, most, rows_too, grown)
      type(patch_slot), intent(inout) :: slot
      !> Undeformed distance in the elements of its grid, and the approach: the bodies overlap where it is larger [mm]
      real(wp), intent(in) :: h(:, :), approach
      !> Maximum number of columns and rows
      integer, intent(in) :: most(2)
      !> May rows be added, too?
      logical, intent(in) :: rows_too
      !> Was the grid changed?
      logical, intent(out) :: grown
      integer :: more(2, 2), side
      real(wp) :: y(2)

      associate (grid => slot%problem%grid, plane => slot%plane, region => slot%region)
         more(1, :) = merge(1, 0, [any(h(1, :) < approach), any(h(grid%mx, :) < approach)])
         more(2, :) = merge(1, 0, [any(h(:, 1) < approach), any(h(:, grid%my) < approach)])
         if (.not. rows_too) more(2, :) = 0
         ! beyond the centre of the outermost elements the overlap belongs to another patch
         if (plane%origin(1) + grid%x(1) < region%others_x(1)) more(1, 1) = 0
         if (plane%origin(1) + grid%x(grid%mx) > region%others_x(2)) more(1, 2) = 0
         y = plane%origin(2) + cos(plane%roll())*[grid%y(1), grid%y(grid%my)]
         if (minval(y) < region%others_y(1)) more(2, merge(1, 2, y(1) < y(2))) = 0
         if (maxval(y) > region%others_y(2)) more(2, merge(2, 1, y(1) < y(2))) = 0
         do side = 1, 2
            ! in small steps, as the overlap of a neighbouring patch must remain outside
            more(:, side) = more(:, side)*(1 + [grid%mx, grid%my]/32)
         end do
         grown = any(more > 0) .and. .not. any([grid%mx, grid%my] + sum(more, dim=2) > most)
         if (.not. grown) return
         grid%mx = grid%mx + sum(more(1, :))
         grid%my = grid%my + sum(more(2, :))
         grid%xl = grid%xl - more(1, 1)*grid%dx
         grid%yl = grid%yl - more(2, 1)*grid%dy
         slot%window%first = slot%window%first - more(:, 1)
      end associate
   end subroutine grow

   !> Reference surface of a patch at the rows of its grid, and the undeformed distance along its normals
   subroutine follow_surface(problem, geometry, rail, slot, h, approach)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_geometry), intent(inout) :: geometry
      !> The rail in track coordinates in the section of the reference
      type(profile_curve), intent(in) :: rail
      !> With grid
      type(patch_slot), intent(inout) :: slot
      !> Undeformed distance [mm] with its minimum at zero, shape (mx, my)
      real(wp), allocatable, intent(inout) :: h(:, :)
      !> Maximum interpenetration along normals [mm]
      real(wp), intent(out) :: approach
      integer :: most(2), iy
      logical :: conformal, grown

      associate (patch => slot%problem)
         conformal = problem%spec%search%location == contact_location%conformal
         most = max_elements(patch%grid)
         do
            if (conformal) then
               slot%curve = new_curved_reference(rail, geometry%bodies, slot%plane, patch%grid)
            else
               slot%curve = straight_reference(slot%plane, patch%grid)
            end if
            call surface_heights(geometry%bodies, slot%curve, patch%grid, slot%on_rail, slot%on_wheel)
            h = slot%on_rail - slot%on_wheel
            call shift_distance(patch%grid, allocated(slot%region%seeds), h, approach, slot%left_out)
            call leave_to_others(slot, h, approach)
            ! rows of a curved reference are chosen with a margin
            call grow(slot, h, approach, most, .not. conformal, grown)
            if (.not. grown) exit
         end do
         if (allocated(patch%model%inclination)) then
            patch%model%inclination%s = [(patch%grid%y(iy), iy=1, patch%grid%my)]
            patch%model%inclination%alpha = slot%curve%alpha
         end if
      end associate
   end subroutine follow_surface

   !> Exclude the overlap that belongs to neighbouring patches: beyond the middle between their bounds and those of this one
   subroutine leave_to_others(slot, h, approach)
      !> With grid, plane or curve, and region
      type(patch_slot), intent(in) :: slot
      !> Undeformed distance with its minimum at zero, and maximum interpenetration [mm]; changed if elements are excluded
      real(wp), intent(inout) :: h(:, :), approach
      !> Do a column and a row of elements belong to this patch?
      logical, allocatable :: column(:), row(:)
      real(wp) :: s(2), x, lowest
      integer :: ix, iy, side

      associate (region => slot%region, plane => slot%plane, grid => slot%problem%grid, far => huge(1.0_wp))
         if (all(abs([region%middle_x, region%middle_yz(1, :)]) >= far)) return
         allocate(column(grid%mx), row(grid%my))
         s = [-far, far]
         do side = 1, 2
            if (abs(region%middle_yz(1, side)) >= far) cycle
            s(side) = dot_product(region%middle_yz(:, side) - plane%origin(2:3), plane%axes(2:3, 2))
         end do
         ! the axis of the plane points to smaller y if the surface is turned upside down
         if (plane%axes(2, 2) < 0.0_wp) s = s([2, 1])
         do iy = 1, grid%my
            row(iy) = grid%y(iy) >= s(1) .and. grid%y(iy) <= s(2)
            if (allocated(slot%curve)) row(iy) = slot%curve%y(iy) >= region%middle_yz(1, 1) .and. slot%curve%y(iy) &
               & <= region%middle_yz(1, 2)
         end do
         do ix = 1, grid%mx
            x = plane%origin(1) + grid%x(ix)
            column(ix) = x >= region%middle_x(1) .and. x <= region%middle_x(2)
         end do
      end associate
      ! a contact that is smaller than an element may have the centre of none on its side
      if (all(column) .and. all(row) .or. .not. (any(column) .and. any(row))) return
      do iy = 1, size(row)
         do ix = 1, size(column)
            if (.not. (column(ix) .and. row(iy))) h(ix, iy) = excluded_distance
         end do
      end do
      lowest = minval(h)
      h = h - lowest
      approach = approach - lowest
   end subroutine leave_to_others

   !> Divide the elements among the parts of a blended patch: each belongs to the nearest one
   subroutine divide_patch(rail, slot)
      !> The rail in track coordinates in the section of the reference
      type(profile_curve), intent(in) :: rail
      type(patch_slot), intent(inout) :: slot
      type(profile_curve) :: section
      real(wp) :: x, y, away, nearest
      integer :: ix, iy, k

      allocate(slot%problem%parts)
      associate (parts => slot%problem%parts, grid => slot%problem%grid, plane => slot%plane)
         call start_places(rail, slot%region, slot%distance)
         section = rail%seen_from([plane%origin(2), rail%height(plane%origin(2))], plane%roll(), &
            & around=slot%distance%places(:slot%distance%n))
         allocate(parts%label(grid%mx, grid%my), source=0)
         parts%interaction = slot%region%interaction
         do iy = 1, grid%my
            y = plane%origin(2) + cos(plane%roll())*grid%y(iy)
            ! the rail curves away from a steep plane
            if (section%has(grid%y(iy))) y = y - sin(plane%roll())*section%height(grid%y(iy))
            if (allocated(slot%curve)) y = slot%curve%y(iy)
            do ix = 1, grid%mx
               x = plane%origin(1) + grid%x(ix)
               nearest = huge(nearest)
               do k = 1, size(slot%region%part)
                  associate (box => slot%region%part(k))
                     away = max(0.0_wp, box%x(1) - x, x - box%x(2))**2 + max(0.0_wp, box%y(1) - y, y - box%y(2))**2
                  end associate
                  if (away >= nearest) cycle
                  nearest = away
                  parts%label(ix, iy) = k
               end do
            end do
         end do
      end associate
   end subroutine divide_patch

   !> Friction of the patch: if it varies, that for the contact angle or for the position along the track
   subroutine set_patch_friction(problem, slot, error)
      type(wheel_rail_problem), intent(in) :: problem
      type(patch_slot), intent(inout) :: slot
      type(error_type), allocatable, intent(out) :: error
      integer :: iy

      associate (patch => slot%problem)
         if (allocated(patch%static_mu)) deallocate(patch%static_mu)
         if (allocated(slot%friction)) deallocate(slot%friction)
         if (friction_by_row(problem) .and. problem%template%motion /= motion%none) then
            slot%friction = [(parameters_at(problem, slot%curve%alpha(iy)), iy=1, patch%grid%my)]
            call new_friction_law(problem%friction_law, slot%friction, patch%friction, error)
            if (allocated(error)) return
            patch%mu = 1.0_wp
            patch%static_mu = patch%friction%sets%fstat
            return
         end if
         if (problem%variation /= variation%none .and. problem%template%motion /= motion%none) then
            if (problem%variation == variation%by_angle) then
               slot%friction = [parameters_at(problem, slot%plane%roll())]
            else
               slot%friction = [parameters_at(problem, problem%spec%wheelset%s)]
            end if
            patch%mu = slot%friction(1)%fstat
            if (is_varying_law(problem%friction_law)) then
               call new_friction_law(problem%friction_law, slot%friction, patch%friction, error)
               if (allocated(error)) return
            end if
         end if
         if (allocated(patch%friction)) allocate(patch%static_mu(patch%grid%my), source=patch%mu)
      end associate
   end subroutine set_patch_friction

   !> Creepages of a patch from the motion of the bodies
   subroutine set_motion(problem, geometry, slot, approach)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_geometry), intent(in) :: geometry
      type(patch_slot), intent(inout) :: slot
      real(wp), intent(in) :: approach
      type(rigid_motion) :: rail, wheel
      real(wp) :: on_wheel(3), pitch_rate, forward

      pitch_rate = geometry%pitch_rate
      rail = rail_motion(problem%spec, geometry%placement)
      wheel = wheel_motion(problem%spec, geometry%placement, pitch_rate)
      associate (plane => slot%plane)
         on_wheel = plane%origin + approach*plane%axes(:, 3)
         if (problem%template%motion == motion%shift) then
            slot%motion = flat_shift(rail, wheel, plane%origin, on_wheel, plane%roll())
         else
            slot%motion = flat_creepage(rail, wheel, geometry%placement%wheelset%axes(:, 2), pitch_rate, plane%origin, on_wheel, &
               & plane%roll(), problem%spec%roller)
         end if
      end associate
      if (allocated(slot%curve)) then
         forward = 0.0_wp
         if (problem%template%motion /= motion%shift) forward = forward_velocity(problem%spec)
         call surface_motion(rail, wheel, slot%curve, slot%problem%grid, slot%on_rail, slot%on_wheel, &
            & slot%on_rail < slot%on_wheel, share_of_rail(problem, approach, slot%motion%veloc), forward, slot%motion, &
            & slot%problem%extra_slip)
      end if
      associate (patch => slot%problem)
         patch%creep = [slot%motion%cksi, slot%motion%ceta]
         patch%spin = slot%motion%cphi
         patch%spin_centre = 0.0_wp
         if (allocated(patch%simplified)) patch%simplified%is_centred = .true.
         patch%chi = 0.0_wp
         patch%dq = 1.0_wp
         patch%veloc = 1.0_wp
         patch%spin_offset = 0.0_wp
         if (patch%motion == motion%transient_rolling .or. patch%motion == motion%steady_rolling) then
            patch%chi = slot%motion%chi
            patch%veloc = max(slot%motion%veloc, tiny(1.0_wp))
            patch%dq = problem%relative_step*patch%grid%dx
            if (patch%motion == motion%steady_rolling) patch%dq = patch%grid%dx
            patch%spin_offset = 1.0_wp/6.0_wp
         end if
         if (allocated(problem%relaxation)) then
            associate (bodies => problem%relaxation)
               call patch%model%set_viscoelastic(bodies%poiss, bodies%gg, bodies%ratio, patch%veloc*bodies%time, &
                  & merge(-1, 1, cos(patch%chi) < 0.0_wp))
            end associate
         end if
         ! as in module 3: a layer that yields follows its particles, simplified theory restarts at each edge
         patch%corrects_leading_edge = patch%motion == motion%transient_rolling .and. patch%dq > longer_step*patch%grid%dx &
            & .and. .not. allocated(patch%simplified) .and. .not. patch%remembers_yield
      end associate
   end subroutine set_motion
end module contact_wheelrail_patch_inputs
