!> Cases as input files: what was solved through the library can be solved by the program
module contact_output_input_case
   use contact_base_choices, only : motion, slip_source
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec, geometry_spec
   use contact_grid_element_division, only : bounding_box, contact_box
   use contact_grid_potential_contact, only : potential_contact
   use contact_output_input_groups, only : integers, numbers, put_damping, put_friction, put_heat, put_iteration, put_line, &
      & put_materials, put_words
   use contact_patch_result, only : patch_result
   use contact_wheelrail_spec, only : profile_spec
   implicit none (type, external)
   private

   public :: write_contact_case, write_pair_case

   !> Elements that are kept around the contact area, and sides of the window that is kept without contact
   integer, parameter :: margin = 2, empty_window = 5

contains

   !> A solved case of module 3; a window that is not Hertzian is cut to the contact area and a margin
   subroutine write_contact_case(unit, spec, result)
      integer, intent(in) :: unit
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: result
      type(case_spec) :: written
      type(bounding_box) :: box

      written = spec
      associate (digits => written%digits)
         digits%s = 0
         digits%d = 2
         digits%z = 2
         if (all(spec%slip_source /= [slip_source%no_spin_x, slip_source%no_spin_y])) &
            & digits%e = merge(9, 0, allocated(spec%extra_slip) .and. spec%digits%e > 0)
         digits%r = merge(1, 3, spec%solve)
         ! how materials and temperatures act, not whether they were set again
         if (spec%has_damping) digits%m2 = 2
         if (digits%h == 1) digits%h = 3
      end associate
      box = bounding_box(1, result%grid%mx, 1, result%grid%my)
      if (spec%grid%ipotcn > 0 .and. allocated(result%division)) box = kept_window(result%division)
      call put_words(unit, written%digits, is_pair=.false.)
      call put_iteration(unit, written, with_elements=.false.)
      call put_kinematics(unit, written)
      call put_friction(unit, written)
      if (written%motion >= motion%transient_rolling .and. written%digits%c >= 2) call put_line(unit, &
         & numbers([spec%rolling%chi, spec%rolling%dq, spec%rolling%veloc]), "CHI DQ VELOC")
      call put_materials(unit, written)
      call put_damping(unit, written)
      call put_heat(unit, written)
      call put_grid(unit, written, result%grid, box)
      if (spec%grid%ipotcn > 0) call put_geometry(unit, written%geometry, result%grid, box)
      if (written%digits%e == 9) call put_extra_slip(unit, spec%extra_slip, result%grid, box)
   end subroutine write_contact_case

   !> The contact area with a margin, within the window; without contact its middle
   pure function kept_window(division) result(box)
      !> Element states, shape (mx, my)
      integer, intent(in) :: division(:, :)
      type(bounding_box) :: box
      integer :: n(2)

      n = shape(division)
      box = contact_box(division)
      if (box%ix0 > box%ix1) then
         box = bounding_box((n(1) - empty_window)/2 + 1, (n(1) + empty_window)/2, (n(2) - empty_window)/2 + 1, &
            & (n(2) + empty_window)/2)
      else
         box = bounding_box(box%ix0 - margin, box%ix1 + margin, box%iy0 - margin, box%iy1 + margin)
      end if
      box = bounding_box(max(1, box%ix0), min(n(1), box%ix1), max(1, box%iy0), min(n(2), box%iy1))
   end function kept_window

   !> Approach or force, creepages or forces, spin
   subroutine put_kinematics(unit, spec)
      integer, intent(in) :: unit
      type(case_spec), intent(in) :: spec
      character(len=:), allocatable :: names
      real(wp) :: values(6)

      associate (k => spec%kinematics)
         values = [k%pen, k%cksi, k%ceta, k%cphi, k%spinxo, k%spinyo]
         names = trim(merge("FN ", "PEN", spec%digits%n == 1)) // " " // trim(merge("FX  ", "CKSI", spec%digits%f >= 1)) // &
            & " " // trim(merge("FY  ", "CETA", spec%digits%f >= 2)) // " CPHI SPINXO SPINYO"
         if (spec%digits%n == 1) values(1) = k%fn
         if (spec%digits%f >= 1) values(2) = k%fx
         if (spec%digits%f >= 2) values(3) = k%fy
      end associate
      call put_line(unit, numbers(values), names)
   end subroutine put_kinematics

   !> Potential contact area
   subroutine put_grid(unit, spec, grid, box)
      integer, intent(in) :: unit
      type(case_spec), intent(in) :: spec
      type(potential_contact), intent(in) :: grid
      !> Elements that are kept
      type(bounding_box), intent(in) :: box
      character(len=:), allocatable :: size_of

      associate (g => spec%grid)
         call put_line(unit, integers([min(1, g%ipotcn)]), "IPOTCN")
         size_of = integers([g%mx, g%my]) // " "
         select case (g%ipotcn)
         case (-1)
            call put_line(unit, size_of // numbers([g%a1, g%b1, g%scale]), "MX MY A1 B1 SCALE")
         case (-2)
            call put_line(unit, size_of // numbers([g%a1, g%aob, g%scale]), "MX MY A1 AOB SCALE")
         case (-3, -5)
            call put_line(unit, size_of // numbers([g%aa, g%bb, g%scale]), "MX MY AA BB SCALE")
         case (-4)
            call put_line(unit, size_of // numbers([g%a1, g%bb, g%scale]), "MX MY A1 BB SCALE")
         case (-6)
            call put_line(unit, size_of // numbers([g%aa, g%bneg, g%bpos, g%scale]), "MX MY AA BNEG BPOS SCALE")
         case default
            call put_line(unit, integers([box%ix1 - box%ix0 + 1, box%iy1 - box%iy0 + 1]) // " " // numbers([ &
               & grid%xl + (box%ix0 - 1)*grid%dx, grid%yl + (box%iy0 - 1)*grid%dy, grid%dx, grid%dy]), "MX MY XL YL DX DY")
         end select
      end associate
   end subroutine put_grid

   !> Undeformed distance; planforms cannot be set through the library
   subroutine put_geometry(unit, geometry, grid, box)
      integer, intent(in) :: unit
      type(geometry_spec), intent(in) :: geometry
      type(potential_contact), intent(in) :: grid
      type(bounding_box), intent(in) :: box
      real(wp), allocatable :: h(:, :)
      integer :: iy, k

      call put_line(unit, integers([geometry%ibase, 1]), "IBASE IPLAN")
      select case (geometry%ibase)
      case (1)
         call put_line(unit, numbers(geometry%b(:6)), "B(1) ... B(6)")
      case (2)
         call put_line(unit, integers([size(geometry%profile)]) // " " // numbers([geometry%xm, geometry%rm, geometry%y1, &
            & geometry%dy1]), "NN XM RM Y1 DY1")
         do k = 1, size(geometry%profile)
            call put_line(unit, numbers([geometry%profile(k)]), "B")
         end do
      case (3)
         call put_line(unit, numbers(geometry%b(:4)), "B(1) ... B(4)")
         call put_line(unit, numbers(geometry%b(5:8)), "B(5) ... B(8)")
      case (9)
         h = reshape(geometry%h, [grid%mx, grid%my])
         do iy = box%iy0, box%iy1
            do k = box%ix0, box%ix1, 4
               call put_line(unit, numbers(h(k:min(k + 3, box%ix1), iy)), "H")
            end do
         end do
      end select
   end subroutine put_geometry

   !> Extra rigid slip of the elements that are kept
   subroutine put_extra_slip(unit, slip, grid, box)
      integer, intent(in) :: unit
      !> Shape (2, npot)
      real(wp), intent(in) :: slip(:, :)
      type(potential_contact), intent(in) :: grid
      type(bounding_box), intent(in) :: box
      integer :: ix, iy

      do iy = box%iy0, box%iy1
         do ix = box%ix0, box%ix1
            call put_line(unit, numbers(slip(:, ix + grid%mx*(iy - 1))), "EXRHS")
         end do
      end do
   end subroutine put_extra_slip

   !> A case of module 1, with what its digits ask for
   subroutine write_pair_case(unit, spec)
      integer, intent(in) :: unit
      !> Names of profiles are written as they are here
      type(case_spec), intent(in) :: spec

      call put_words(unit, spec%digits, is_pair=.true.)
      call put_iteration(unit, spec, with_elements=.true.)
      call put_friction(unit, spec)
      call put_materials(unit, spec)
      call put_damping(unit, spec)
      call put_heat(unit, spec)
      if (spec%digits%d >= 2) then
         associate (s => spec%wheel_rail%search)
            call put_line(unit, numbers([s%dx, s%ds, s%dqrel, s%a_sep, s%d_sep, s%d_comb, s%d_turn, s%g_miss]), &
               & "DX DS DQREL A_SEP D_SEP D_COMB D_TURN G_MISS")
         end associate
      end if
      call put_track(unit, spec)
      call put_wheelset(unit, spec)
   end subroutine write_pair_case

   !> Track, rail profile, deviations, springs
   subroutine put_track(unit, spec)
      integer, intent(in) :: unit
      type(case_spec), intent(in) :: spec
      real(wp) :: place(3)

      associate (track => spec%wheel_rail%track, rail => spec%wheel_rail%rail, z => spec%digits%z)
         if (z == 1 .or. z == 3) then
            place = [track%gaught, 0.0_wp, track%gaugwd]
            if (.not. track%gaught > 0.0_wp) place = [track%gaught, track%raily0, track%railz0]
            if (spec%wheel_rail%roller) then
               call put_line(unit, numbers([place, track%nomradr, track%curvature]), &
                  & "GAUGHT GAUGSQ|RAILY0 GAUGWD|RAILZ0 NOMRADR CURV")
            else
               call put_line(unit, numbers([place, track%cant, track%curvature]), "GAUGHT GAUGSQ|RAILY0 GAUGWD|RAILZ0 CANT CURV")
            end if
         end if
         if (z == 3) call put_profile(unit, spec%wheel_rail%rail_profile)
         if (z >= 2) call put_line(unit, numbers([rail%dy, rail%dz, rail%roll, rail%vy, rail%vz, rail%vroll]), &
            & "DYRAIL DZRAIL DROLLR VYRAIL VZRAIL VROLLR")
         if (z >= 2 .and. spec%digits%f == 3) call put_line(unit, numbers([rail%ky, rail%fy, rail%kz, rail%fz, &
            & rail%first_step]), "KYRAIL FYRAIL KZRAIL FZRAIL DYSTEP0")
      end associate
   end subroutine put_track

   !> Wheelset, wheel profile, position, velocity, flexible deviations
   subroutine put_wheelset(unit, spec)
      integer, intent(in) :: unit
      type(case_spec), intent(in) :: spec
      real(wp) :: height, first

      associate (w => spec%wheel_rail%wheelset, e => spec%digits%e)
         if (e == 3 .or. e == 5) then
            call put_line(unit, numbers([w%fbdist, w%fbpos, w%nomradw, w%ytape]), "FBDIST FBPOS NOMRADW YTAPE")
            call put_profile(unit, spec%wheel_rail%wheel_profile)
         end if
         if (e < 1) return
         height = merge(w%fz, w%z, spec%digits%n == 1)
         call put_line(unit, numbers([w%s + w%x, w%y, height, w%roll, w%yaw, w%pitch]), "S|X Y FZ|Z ROLL YAW PITCH")
         if (e < 2) return
         first = merge(w%rpitch, w%vs, spec%wheel_rail%roller)
         call put_line(unit, numbers([first, w%vy, w%vz, w%vroll, w%vyaw, merge(w%fx, w%vpitch, spec%digits%f == 1)]), &
            & "VS|RPITCH VY VZ VROLL VYAW VPITCH|FX")
         if (e < 4) return
         call put_line(unit, numbers(w%flexible), "DXWHL DYWHL DZWHL DROLLW DYAWW DPITCHW")
         call put_line(unit, numbers(w%flexible_rate), "VXWHL VYWHL VZWHL VROLLW VYAWW VPITCHW")
      end associate
   end subroutine put_wheelset

   !> A profile with all that can be chosen
   subroutine put_profile(unit, profile)
      integer, intent(in) :: unit
      type(profile_spec), intent(in) :: profile

      call put_line(unit, "'" // profile%name // "' " // integers([profile%mirror_y]) // " " // numbers([profile%scale, &
         & profile%smoothing]) // " " // integers([profile%mirror_z, 2]), "FNAME MIRRORY SCALEYZ SMOOTH MIRRORZ PRFOPT")
      call put_line(unit, integers([profile%smoothing_method]) // " " // numbers([profile%zigzag, profile%kink_high, &
         & profile%kink_low, profile%kink_width]), "ISMOOTH ZIGTHRS KINKHIGH KINKLOW KINKWID")
      call put_line(unit, integers([profile%error_handling]) // " " // numbers([profile%largest_omission]), "ERRHND MAXOMIT")
   end subroutine put_profile
end module contact_output_input_case
