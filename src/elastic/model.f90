!> Elastic model of a contact: all data from which a compliance is created
module contact_elastic_model
   use contact_base_choices, only : kernel_model
   use contact_base_kinds, only : long, wp
   use contact_elastic_material, only : combine, combined_material, coupling_threshold
   implicit none (type, external)
   private

   public :: elastic_model, fading_memory, influence_table, surface_inclination

   !> Additional response of viscoelastic bodies (standard linear solids) after a load, in steady motion
   !>
   !> The creep compliance of body a is (1 + f_a (1 - exp(-t/tau_a)))/G_a.
   type :: fading_memory
      !> Late part of the response per unit load, of each body against a rigid one
      type(combined_material) :: late(2)
      !> Distance travelled in the relaxation time, v_a = V tau_a [mm]; 0: no memory
      real(wp) :: length(2) = 0.0_wp
      !> Motion towards increasing (+1) or decreasing (-1) x
      integer :: direction = 1
   end type fading_memory

   !> Inclination of a curved surface across the rolling direction
   type :: surface_inclination
      !> Variant of sharing the rotation between load and displacement, 1 to 4
      integer :: variant = 4
      !> Is the rate of inclination constant, a straight line through the table?
      logical :: uniform = .false.
      !> Curved lateral coordinates [mm], increasing, and inclinations [rad]
      real(wp), allocatable :: s(:), alpha(:)
   contains
      procedure :: angle
      procedure :: rate
   end type surface_inclination

   !> Influence coefficients computed elsewhere, for both bodies together
   !>
   !> Offsets are receiving minus loaded element; those in x are not negative, the others follow by symmetry. Outside the range
   !> of offsets coefficients are zero.
   type :: influence_table
      !> Offsets are in the ranges 0...nx and -ny...ny
      integer :: nx = 0, ny = 0
      !> Lateral position of the first loaded row [mm]
      real(wp) :: y_first = 0.0_wp
      !> Hash of the content of the file
      integer(long) :: fingerprint = 0
      !> Coefficients nn nx ny xn xx xy yn yx yy [mm/(N/mm2)], shape (0:nx, -ny:ny, 9, 1), or with one slice for each loaded row
      real(wp), allocatable :: c(:, :, :, :)
   contains
      procedure :: same_table
   end type influence_table

   !> Elastic model of two bodies; default: homogeneous half-spaces
   type :: elastic_model
      !> Combined constants of the instantaneous response
      type(combined_material) :: material
      !> Influence coefficients, member of kernel_model
      integer :: kernel = kernel_model%piecewise_constant
      !> Tangential displacement of a thin layer between the bodies per unit traction [mm3/N]; 0: no layer
      real(wp) :: layer = 0.0_wp
      !> Normal displacement of a thin elastic sheet between the bodies per unit pressure [mm3/N]; 0: no sheet
      real(wp) :: sheet = 0.0_wp
      !> Late response in steady motion; unallocated: none
      type(fading_memory), allocatable :: memory
      !> Inclination of the surface for kernel_model%conformal; unallocated: flat
      type(surface_inclination), allocatable :: inclination
      !> Coefficients for kernel_model%tabulated; unallocated: half-spaces
      type(influence_table), allocatable :: tabulated
   contains
      !> Are normal and tangential problems coupled?
      procedure :: coupled
      !> Do displacements depend only on the offset between elements, for any offset?
      procedure :: is_flat
      !> Is there an inclination whose corrections depend on offsets only and preserve all symmetries?
      procedure :: rotates_by_offset
      !> Do both models give the same coefficients?
      procedure :: same_as
      !> Set the constants and memory of viscoelastic bodies
      procedure :: set_viscoelastic
      !> Constants of both bodies after particles have been loaded over a distance
      procedure :: material_after
   end type elastic_model

contains

   pure logical function coupled(self)
      class(elastic_model), intent(in) :: self

      coupled = self%material%coupled() .or. allocated(self%inclination) .or. allocated(self%tabulated)
      if (.not. allocated(self%memory)) return
      associate (memory => self%memory)
         if (memory%length(1) > 0.0_wp .and. memory%length(1) == memory%length(2)) then
            ! the late responses fade alike: only their difference relative to the modulus matters
            coupled = coupled .or. abs(memory%late(1)%ak/memory%late(1)%gg + memory%late(2)%ak/memory%late(2)%gg) &
               & *self%material%gg >= coupling_threshold
         else
            coupled = coupled .or. any(memory%length > 0.0_wp .and. memory%late%coupled())
         end if
      end associate
   end function coupled

   pure logical function is_flat(self)
      class(elastic_model), intent(in) :: self
      is_flat = .not. (allocated(self%inclination) .or. allocated(self%tabulated))
   end function is_flat

   pure logical function rotates_by_offset(self)
      class(elastic_model), intent(in) :: self

      rotates_by_offset = .false.
      if (allocated(self%inclination)) rotates_by_offset = self%inclination%uniform .and. self%inclination%variant == 4
   end function rotates_by_offset

   pure logical function same_as(self, other) result(same)
      class(elastic_model), intent(in) :: self
      !> Model to compare, parameter by parameter
      type(elastic_model), intent(in) :: other

      same = self%material%same_as(other%material) .and. self%kernel == other%kernel .and. self%layer == other%layer &
         & .and. self%sheet == other%sheet .and. (allocated(self%memory) .eqv. allocated(other%memory)) &
         & .and. (allocated(self%inclination) .eqv. allocated(other%inclination)) &
         & .and. (allocated(self%tabulated) .eqv. allocated(other%tabulated))
      if (.not. same) return
      if (allocated(self%memory)) same = all(self%memory%length == other%memory%length) &
         & .and. self%memory%direction == other%memory%direction .and. all(self%memory%late%same_as(other%memory%late))
      if (same .and. allocated(self%tabulated)) same = self%tabulated%same_table(other%tabulated)
      if (.not. allocated(self%inclination)) return
      associate (a => self%inclination, b => other%inclination)
         same = same .and. a%variant == b%variant .and. (a%uniform .eqv. b%uniform) .and. size(a%s) == size(b%s)
         if (same) same = all(a%s == b%s) .and. all(a%alpha == b%alpha)
      end associate
   end function same_as

   !> Do two tables come from the same file, for the same window?
   pure logical function same_table(self, other) result(same)
      class(influence_table), intent(in) :: self
      !> Table to compare, by file and window, not by coefficients
      type(influence_table), intent(in) :: other

      same = self%fingerprint == other%fingerprint .and. self%nx == other%nx .and. self%ny == other%ny &
         & .and. self%y_first == other%y_first .and. all(shape(self%c) == shape(other%c))
   end function same_table

   !> Set the model of viscoelastic bodies; a body with relaxation time 0 responds immediately with its late compliance
   pure subroutine set_viscoelastic(self, poiss, gg, ratio, length, direction)
      class(elastic_model), intent(inout) :: self
      !> Poisson ratios [-] and instantaneous moduli of rigidity [N/mm2] of bodies 1 and 2
      real(wp), intent(in) :: poiss(2), gg(2)
      !> Ratio of late to instantaneous compliance, minus 1 [-]
      real(wp), intent(in) :: ratio(2)
      !> Distance travelled in the relaxation time [mm]
      real(wp), intent(in) :: length(2)
      !> Motion towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      real(wp) :: modulus(2)
      integer :: a

      modulus = gg
      where (length <= 0.0_wp) modulus = gg/(1.0_wp + ratio)
      self%material = combine(poiss, modulus)
      if (allocated(self%memory)) deallocate(self%memory)
      if (.not. any(length > 0.0_wp .and. ratio > 0.0_wp)) return
      allocate(self%memory)
      self%memory%direction = direction
      do a = 1, 2
         if (length(a) <= 0.0_wp .or. ratio(a) <= 0.0_wp) cycle
         self%memory%length(a) = length(a)
         self%memory%late(a)%gg = 2.0_wp*gg(a)/ratio(a)
         self%memory%late(a)%nu = poiss(a)
         self%memory%late(a)%ak = merge(0.5_wp, -0.5_wp, a == 1)*(1.0_wp - 2.0_wp*poiss(a))
      end do
   end subroutine set_viscoelastic

   !> Constants of both bodies together, with the part of the memory of particles that have been loaded over a distance
   pure function material_after(self, distance) result(material)
      class(elastic_model), intent(in) :: self
      !> Distance travelled under load [mm]
      real(wp), intent(in) :: distance
      type(combined_material) :: material
      !> Relaxation times after which nothing remains to relax in double precision
      real(wp), parameter :: forgotten = 45.0_wp
      real(wp) :: flexibility(3)
      integer :: a

      material = self%material
      if (.not. allocated(self%memory)) return
      flexibility = [1.0_wp, 0.0_wp, 0.0_wp]
      associate (memory => self%memory)
         do a = 1, 2
            if (memory%length(a) > 0.0_wp) flexibility(1 + a) = self%material%gg/memory%late(a)%gg &
               & *(1.0_wp - exp(-min(distance/memory%length(a), forgotten)))
         end do
         material%gg = self%material%gg/sum(flexibility)
         material%nu = dot_product(flexibility, [self%material%nu, memory%late%nu])/sum(flexibility)
         material%ak = dot_product(flexibility, [self%material%ak, memory%late%ak])/sum(flexibility)
      end associate
   end function material_after

   !> Inclination at a lateral position [rad], by interpolation; the end intervals are extrapolated
   elemental real(wp) function angle(self, s)
      class(surface_inclination), intent(in) :: self
      !> Curved lateral coordinate [mm]
      real(wp), intent(in) :: s
      integer :: i

      if (self%uniform) then
         angle = self%rate()*s
         return
      end if
      i = max(1, min(size(self%s) - 1, count(self%s <= s)))
      angle = self%alpha(i) + (self%alpha(i + 1) - self%alpha(i))*(s - self%s(i))/(self%s(i + 1) - self%s(i))
   end function angle

   !> Slope of the least-squares line through the table [rad/mm]
   pure real(wp) function rate(self)
      class(surface_inclination), intent(in) :: self
      real(wp) :: mean_s, mean_alpha

      mean_s = sum(self%s)/size(self%s)
      mean_alpha = sum(self%alpha)/size(self%alpha)
      rate = sum((self%s - mean_s)*(self%alpha - mean_alpha))/sum((self%s - mean_s)**2)
   end function rate
end module contact_elastic_model
