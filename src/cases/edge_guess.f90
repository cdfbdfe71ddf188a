!> Errors at the leading edge of unlike bodies that are expected before a case is solved
!>
!> The model of contact_patch_edge_slip, with quantities that follow from loads, creepages and the ellipse. The constants were
!> fitted to the numbers of elements used by 340 contacts with prescribed creepages at accuracies of 1e-2, 1e-3 and 2e-4 (kind
!> dissimilar of tests/accuracy, seeds 88101 to 88103). Creepages are compared with mu p0/G, p0 the largest pressure.
module contact_cases_edge_guess
   use contact_base_choices, only : force_control, normal_control
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_elastic_material, only : combine, combined_material
   use contact_patch_edge_slip, only : expected_edge
   implicit none (type, external)
   private

   public :: guess_edge

   !> Creepage of full sliding; creepage whose tractions at the leading edge reach the friction bound; creepage that slides as much
   !> as a spin of one over the half side; power of the ratio of the sides with which contacts that are longer along the rolling
   !> direction slide earlier
   real(wp), parameter :: sliding_creepage = 1.9_wp, edge_creepage = 2.5_wp, slip_by_spin = 0.7_wp, by_length = 0.5_wp
   !> Width of the slip area over the length of the row if creepages alone reach the bound at the edge
   real(wp), parameter :: widest = 0.45_wp
   !> Change of the direction of slip over beta times the slip across the rolling direction over the square of slip; slip below
   !> which that of the deformation determines the direction; rows in which slip is evaluated [half widths]
   real(wp), parameter :: turning_share = 0.19_wp, least_slip = 1.3_wp, rows(2) = [-0.6_wp, 0.6_wp]

contains

   !> Slip area and tractions at the leading edge in steady rolling; nothing if loads or sides are not known
   pure type(expected_edge) function guess_edge(spec, sides, mu) result(edge)
      !> Case with different materials
      type(case_spec), intent(in) :: spec
      !> Sides of the contact along x and y [mm], 0 if unknown; coefficient of friction [-]
      real(wp), intent(in) :: sides(2), mu
      type(combined_material) :: material
      real(wp) :: side, unit, creepage(2), spin, left, size, along, across, needed, direction

      side = 0.5_wp*sqrt(product(sides))
      if (.not. (side > 0.0_wp .and. mu > 0.0_wp) .or. spec%normal /= normal_control%force .or. allocated(spec%wheel_rail) &
         & .or. .not. spec%kinematics%fn > 0.0_wp) return
      material = combine(spec%material%poiss, spec%material%gg)
      edge%ratio = abs(material%ak)/((1.0_wp - material%nu)*mu)
      unit = 1.5_wp*mu*spec%kinematics%fn/(pi*side**2*material%gg)
      if (spec%force == force_control%fx_and_fy) then
         ! by the theory of Vermeulen and Johnson; tractions have the direction of the force
         creepage = -[spec%kinematics%fx, spec%kinematics%fy]
         left = max(0.0_wp, 1.0_wp - norm2(creepage))**(1.0_wp/3.0_wp)
         creepage = creepage*(1.0_wp - left)*sliding_creepage/max(norm2(creepage), tiny(left))
         spin = 0.0_wp
      else
         creepage = [spec%kinematics%cksi, spec%kinematics%ceta]/unit
         spin = spec%kinematics%cphi/unit
         left = max(0.0_wp, 1.0_wp - (norm2(creepage) + slip_by_spin*abs(spin)*side)/sliding_creepage &
            & *max(1.0_wp, sides(1)/sides(2))**by_length)
      end if
      edge%sticking = left**2
      ! rolling towards decreasing x is a mirror image; interchanged bodies have opposite tractions by pressures
      direction = merge(-1.0_wp, 1.0_wp, cos(spec%rolling%chi) < 0.0_wp)
      spin = direction*spin
      creepage(1) = direction*sign(creepage(1), creepage(1)*material%ak)
      size = max(norm2(creepage), tiny(left))
      along = -creepage(1)/size
      across = creepage(2)/size
      ! of the difference of the directions at both ends, in that part of the load that sticks a little earlier or later
      edge%turned = 0.5_wp*norm2([1.0_wp - along, across])*left
      size = min(1.0_wp, (size + slip_by_spin*abs(spin)*side)/edge_creepage)
      ! what the pressures must add to the tractions of the creepages
      needed = sqrt(max(0.0_wp, 1.0_wp - (size*across)**2)) - size*along
      edge%width = widest*exp(-pi*max(0.0_wp, needed)/edge%ratio)
      edge%turning = turning_share*edge%ratio*mean_turn(creepage, spin, sides)
   end function guess_edge

   !> Slip across the rolling direction over the square of slip, at the leading edge, as a mean of rows [-]
   pure real(wp) function mean_turn(creepage, spin, sides) result(turn)
      !> Creepages [-] and spin [1/mm]
      real(wp), intent(in) :: creepage(2), spin
      !> Sides of the contact along x and y [mm]
      real(wp), intent(in) :: sides(2)
      real(wp) :: slip(2)
      integer :: k

      turn = 0.0_wp
      do k = 1, size(rows)
         slip = [creepage(1) - 0.5_wp*rows(k)*sides(2)*spin, creepage(2) + 0.5_wp*sides(1)*spin]
         turn = turn + abs(slip(2))/(sum(slip**2) + least_slip**2)/size(rows)
      end do
   end function mean_turn
end module contact_cases_edge_guess
