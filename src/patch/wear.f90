!> Wear and rolling contact fatigue of a solved patch: quantities from the literature, if a case requests them
!>
!> Sources: T-gamma (tangential forces times creepages and spin moment times spin): Pearce and Sherratt, Wear 144 (1991); T-gamma
!> per contact area: Lewis and Dwyer-Joyce, Proc. IMechE J 218 (2004). Wear depth: Archard, J. Appl. Phys. 24 (1953), along the
!> strips of a contact as Jendel, Wear 253 (2002). Surface fatigue index: Ekberg, Kabo and Andersson, Fatigue Fract. Eng. Mater.
!> Struct. 25 (2002), where 2 pi a b/(3 Fn) is the reciprocal of Hertz's maximum pressure. Shakedown: Johnson, Contact mechanics,
!> 1985, section 9.2. The Python module contact.wear has the same quantities as functions of arrays.
module contact_patch_wear
   use contact_base_choices, only : is_rolling, motion
   use contact_base_constants, only : nmm_per_joule
   use contact_base_kinds, only : wp
   use contact_patch_result, only : patch_result, wear_result
   implicit none (type, external)
   private

   public :: derive_wear, forget_wear, shakedown_limit, wear_spec

   !> Material data of a case
   type :: wear_spec
      !> Archard's coefficient [-], hardness of the softer body, yield stress in cyclic shear [N/mm2]; 0: not given
      real(wp) :: archard = 0.0_wp, hardness = 0.0_wp, shear_yield = 0.0_wp
   end type wear_spec

   !> Maximum shear stress parallel to the surface, below it, relative to the maximum pressure, in a line contact that slides with
   !> ratio f of tangential to normal force: coefficients of f**0 ... f**4, fitted to the stresses of Hertzian pressures and
   !> tractions within 2e-7 up to f = 0.3675
   real(wp), parameter :: shear_below(0:4) = [0.25_wp, 0.29904477_wp, 0.07165843_wp, -0.05709596_wp, 0.03172995_wp]
   !> Ratio of tangential to normal force above which the maximum shear stress, f itself, is at the surface [-]
   real(wp), parameter :: surface_traction = 0.36723_wp

contains

   !> Totals and fields of wear and fatigue, from those of the solution
   pure subroutine derive_wear(spec, spin_centre, result)
      !> Material data
      type(wear_spec), intent(in) :: spec
      !> Reference point of the creepages, relative to that of the moment [mm]
      real(wp), intent(in) :: spin_centre(2)
      !> Solution; `wear`, `power` and `wear_depth` are set
      type(patch_result), intent(inout) :: result
      real(wp) :: mz

      call forget_wear(result)
      allocate(result%wear)
      result%wear = wear_result(has_archard=spec%archard > 0.0_wp, has_yield=spec%shear_yield > 0.0_wp)
      associate (wear => result%wear, area => result%contact_area(), f => hypot(result%fx, result%fy))
         if (is_rolling(result%motion)) then
            ! slip is a distance per step
            result%power = -(result%px*result%sx + result%py*result%sy)/(nmm_per_joule*result%dt)
            wear%max_power = maxval(result%power)
            mz = result%mz + spin_centre(2)*result%fx - spin_centre(1)*result%fy
            wear%t_gamma = abs(result%fx*result%cksi) + abs(result%fy*result%ceta) + abs(mz*result%cphi)
            if (area > 0.0_wp) wear%wear_index = wear%t_gamma/area
         end if
         if (wear%has_archard .and. result%motion /= motion%none) call wear_off(spec%archard/spec%hardness, result)
         if (.not. min(result%fn, result%pmax) > 0.0_wp) return
         wear%traction = f/result%fn
         if (.not. wear%has_yield) return
         wear%load = result%pmax/spec%shear_yield
         wear%shakedown = wear%load/shakedown_limit(wear%traction)
         wear%fatigue = wear%traction - 1.0_wp/wear%load
      end associate
   end subroutine derive_wear

   !> Remove the totals and fields of wear, of which a case has those of its motion and coefficients
   pure subroutine forget_wear(result)
      type(patch_result), intent(inout) :: result

      if (allocated(result%wear)) deallocate(result%wear)
      if (allocated(result%power)) deallocate(result%power)
      if (allocated(result%wear_depth)) deallocate(result%wear_depth)
   end subroutine forget_wear

   !> Wear depth by pressure times sliding distance; in rolling along x a point passes all elements of its row
   pure subroutine wear_off(rate, result)
      !> Wear depth per pressure and distance [mm2/N]
      real(wp), intent(in) :: rate
      type(patch_result), intent(inout) :: result

      result%wear_depth = rate*result%pn*hypot(result%sx, result%sy)
      if (is_rolling(result%motion)) then
         result%wear_depth = result%wear_depth*result%grid%dx/result%dq
         result%wear%depth = maxval(sum(result%wear_depth, 1))
         result%wear%section = sum(result%wear_depth)*result%grid%dy
      else
         result%wear%depth = maxval(result%wear_depth)
      end if
   end subroutine wear_off

   !> Maximum pressure relative to the yield stress in shear at the elastic shakedown limit of a line contact [-]
   !>
   !> By Melan's theorem: residual stresses balance all components but the shear stress parallel to the surface, which must nowhere
   !> exceed the yield stress.
   elemental real(wp) function shakedown_limit(traction) result(limit)
      !> Ratio of tangential to normal force in full sliding [-]
      real(wp), intent(in) :: traction
      real(wp) :: largest
      integer :: k

      largest = traction
      if (traction < surface_traction) then
         largest = 0.0_wp
         do k = ubound(shear_below, 1), 0, -1
            largest = largest*traction + shear_below(k)
         end do
      end if
      limit = 1.0_wp/largest
   end function shakedown_limit
end module contact_patch_wear
