!> Cases in the readable format: choices by their words, followed by the groups that a case gives
!>
!> A case contains what differs from the previous one. Digits that the reader derives from the rest of the case are left out, see
!> contact_input_toml_case.
module contact_output_toml_case_writer
   use contact_base_choices, only : estimate_choice, is_rolling, motion, slip_source, time_link, variation
   use contact_base_kinds, only : wp
   use contact_cases_own_keys, only : visit_own_case
   use contact_cases_spec, only : case_spec, friction_set, part_source
   use contact_cases_whole_case, only : visit_case
   use contact_control_digits, only : case_digits, digit_text, digit_value
   use contact_control_translation, only : digits_of
   use contact_control_words, only : is_choice, key_table, word_of_digit
   use contact_output_toml_writer, only : remembered_texts, toml_writer
   use contact_text_buffer, only : text_buffer
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: toml_experiment_writer

   character(len=*), parameter :: line_feed = achar(10)

   !> Texts written last for a result element
   type :: element_memory
      integer :: module_number = 0, reid = 0, cpid = 1
      logical :: is_first = .true.
      type(remembered_texts) :: texts
      type(case_spec) :: spec
   end type element_memory

   !> Writes the cases of a file in turn
   type :: toml_experiment_writer
      !> Text written so far
      type(text_buffer) :: text
      integer, private :: count = 0, current = 0
      type(element_memory), allocatable, private :: elements(:)
   contains
      procedure :: add_case
      procedure, private :: select_element
   end type toml_experiment_writer

contains

   !> Append a case
   subroutine add_case(self, module_number, reid, cpid, spec, remarks)
      class(toml_experiment_writer), intent(inout) :: self
      integer, intent(in) :: module_number
      !> Result element, 0 for the default one, and contact patch
      integer, intent(in) :: reid, cpid
      type(case_spec), intent(in) :: spec
      !> Lines of comments above the case, each with its "# " and line feed
      character(len=*), intent(in) :: remarks
      type(toml_writer) :: a
      type(remembered_texts), target :: presets, texts
      type(case_spec), target :: written
      integer :: before

      before = self%current
      call self%select_element(module_number, reid, cpid)
      associate (element => self%elements(self%current))
         texts = element%texts
         a%memory => texts
         a%presets => presets
         a%moves = spec%motion
         a%is_recording = .true.
         a%case_text = ""
         call make_preset(spec, written)
         call visit_case(a, written)
         a%is_recording = .false.
         a%has_rows = spec%variation == variation%by_row
         a%module_number = module_number
         a%digits = digits_of(spec)
         a%case_text = line_feed // remarks // "[[case]]" // line_feed
         if (self%text%length == 0) a%case_text = remarks // "[[case]]" // line_feed
         call put_element(self, a, before)
         call put_choices(a, module_number, element%is_first, element%spec, spec)
         written = spec
         if (module_number == 3 .and. .not. element%is_first) call complete_motion(a, element%spec, written)
         call visit_case(a, written)
         call put_ends(a, element%spec, spec, element%is_first)
         call self%text%add(a%case_text)
         element%texts = texts
         element%spec = spec
         element%is_first = .false.
      end associate
   end subroutine add_case

   !> A copy of the case in which the numbers that have preset values have these
   subroutine make_preset(spec, preset)
      type(case_spec), intent(in) :: spec
      type(case_spec), intent(out) :: preset
      type(case_spec) :: fresh
      type(friction_set) :: usual

      preset = spec
      preset%iteration = fresh%iteration
      preset%kinematics = fresh%kinematics
      preset%rolling = fresh%rolling
      preset%material%k0_mf = fresh%material%k0_mf
      preset%material%alfamf = fresh%material%alfamf
      preset%material%betamf = fresh%material%betamf
      preset%material%tau_c0 = fresh%material%tau_c0
      preset%material%k_tau = fresh%material%k_tau
      preset%material%if_meth = fresh%material%if_meth
      preset%material%variant = fresh%material%variant
      preset%heat = fresh%heat
      preset%wear = fresh%wear
      preset%friction%memdst = fresh%friction%memdst
      preset%friction%mem_s0 = fresh%friction%mem_s0
      if (allocated(preset%friction%sets)) preset%friction%sets(:)%fkin = usual%fkin
      if (.not. allocated(spec%wheel_rail)) return
      deallocate(preset%wheel_rail)
      allocate(preset%wheel_rail)
      preset%wheel_rail%roller = spec%wheel_rail%roller
      preset%wheel_rail%rail_profile%name = ""
      preset%wheel_rail%wheel_profile%name = ""
   end subroutine make_preset

   !> Write module, result element and patch, if they differ from those of the previous case
   subroutine put_element(self, a, before)
      type(toml_experiment_writer), intent(in) :: self
      type(toml_writer), intent(inout) :: a
      !> Index of the element of the previous case, 0 if there is none
      integer, intent(in) :: before
      type(element_memory) :: old

      if (before > 0) then
         old%module_number = self%elements(before)%module_number
         old%reid = self%elements(before)%reid
         old%cpid = self%elements(before)%cpid
      end if
      associate (new => self%elements(self%current))
         if (new%module_number /= old%module_number) then
            if (new%module_number == 1) a%case_text = a%case_text // 'module = "wheel_rail"' // line_feed
            if (new%module_number == 3) a%case_text = a%case_text // 'module = "contact"' // line_feed
         end if
         if (new%reid /= old%reid) a%case_text = a%case_text // "result_element = " // integer_text(new%reid) // line_feed
         if (new%cpid /= old%cpid) a%case_text = a%case_text // "contact_patch = " // integer_text(new%cpid) // line_feed
      end associate
   end subroutine put_element

   !> Write choices that differ from those of the previous case
   subroutine put_choices(a, module_number, is_first, old, spec)
      type(toml_writer), intent(inout) :: a
      integer, intent(in) :: module_number
      !> Is there no previous case?
      logical, intent(in) :: is_first
      type(case_spec), intent(in) :: old, spec
      type(case_digits) :: digits, usual
      type(case_spec) :: written
      character(len=:), allocatable :: text
      integer :: digit, row

      digits = digits_of(spec)
      usual%o = 2
      do row = 1, size(key_table)
         associate (key => key_table(row))
            if (key%group /= "" .or. all(key%module_number /= [0, module_number])) cycle
            digit = digit_value(digits, trim(key%name))
            if (key%name == "S") then
               if (digit >= 2 .or. (digit == 1 .eqv. (old%has_stress .and. .not. is_first))) cycle
               call forget(a, "stresses")
            else if (key%name == "E") then
               if (digit == 9 .or. digit == 1) cycle
               if (digit == 0 .and. (is_first .or. old%slip_source == slip_source%none)) cycle
               call forget(a, "slip_source")
            end if
            if (is_choice(trim(key%name))) then
               text = '"' // trim(word_of_digit(trim(key%name), digit, module_number)) // '"'
            else
               text = integer_text(digit)
            end if
            if (is_first .and. all(key%name /= ["C1", "T ", "N ", "F ", "O "]) &
               & .and. digit == digit_value(usual, trim(key%name))) call a%memory%keep("." // trim(key%key), text)
            call a%put_choice(trim(key%key), text, trim(digit_text(trim(key%name), digit, module_number)))
         end associate
      end do
      if (.not. spec%solve) a%case_text = a%case_text // "solve = false" // line_feed
      written = spec
      call visit_own_case(a, written)
      if (module_number == 1) then
         if (is_first .and. spec%wheel_rail%search%gap_weight == 0) call a%memory%keep(".gap_weight", "0")
         call a%put_choice("gap_weight", integer_text(spec%wheel_rail%search%gap_weight), "")
      end if
      call put_renewal(a, is_first, old, spec)
   end subroutine put_choices

   !> Give what the reader does not keep when the motion changes
   subroutine complete_motion(a, old, written)
      type(toml_writer), intent(inout) :: a
      !> The previous case
      type(case_spec), intent(in) :: old
      !> The case; its numbers of rolling are given if they are not those of the last case with rolling
      type(case_spec), intent(inout) :: written

      if (is_rolling(written%motion) .and. .not. is_rolling(old%motion) .and. written%parts%material == part_source%renewed) &
         & written%parts%rolling = part_source%given
      if (written%motion == old%motion) return
      ! creepages are no shifts
      if (abs(written%kinematics%cksi) > 0.0_wp) call a%memory%keep("kinematics.cksi", "")
      if (abs(written%kinematics%ceta) > 0.0_wp) call a%memory%keep("kinematics.ceta", "")
      if (abs(written%kinematics%cphi) > 0.0_wp) call a%memory%keep("kinematics.cphi", "")
   end subroutine complete_motion

   !> The earlier text of a choice that is kept by a separate rule is ignored
   subroutine forget(a, key)
      type(toml_writer), intent(inout) :: a
      character(len=*), intent(in) :: key

      call a%memory%keep("." // key, "")
   end subroutine forget

   !> Write the key renew, if the reader would renew other groups
   subroutine put_renewal(a, is_first, old, spec)
      type(toml_writer), intent(inout) :: a
      logical, intent(in) :: is_first
      type(case_spec), intent(in) :: old, spec
      character(len=:), allocatable :: names
      !> Sources that the reader assumes without the key
      integer :: grid, geometry, material
      !> Source of the undeformed distance; that of a Hertzian grid is not read, but formed
      integer :: distance
      logical :: differs

      if (is_first .or. allocated(spec%wheel_rail)) return
      associate (parts => spec%parts)
         distance = parts%geometry
         if (distance == part_source%given .and. parts%grid /= part_source%given .and. spec%grid%brings_geometry()) &
            & distance = part_source%renewed
         grid = part_source%kept
         if (spec%link == time_link%initiate .and. spec%estimate == estimate_choice%fresh .and. old%grid%brings_geometry() &
            & .and. distance /= part_source%given .and. changes_load(old, spec)) grid = part_source%renewed
         material = part_source%kept
         if (parts%grid == part_source%given .or. grid == part_source%renewed .or. (spec%motion >= motion%transient_rolling .neqv. &
            & old%motion >= motion%transient_rolling)) material = part_source%renewed
         geometry = merge(part_source%renewed, part_source%kept, parts%grid == part_source%given .or. grid == part_source%renewed)
         differs = (parts%grid /= part_source%given .and. parts%grid /= grid) .or. &
            & (parts%material /= part_source%given .and. parts%material /= material)
         if (parts%grid == part_source%given .and. spec%grid%brings_geometry()) then
            differs = differs .or. distance == part_source%renewed
         else
            differs = differs .or. (distance /= part_source%given .and. distance /= geometry)
         end if
         if (.not. differs) return
         names = ""
         if (parts%grid == part_source%renewed) names = names // ', "grid"'
         if (distance == part_source%renewed) names = names // ', "geometry"'
         if (parts%material == part_source%renewed) names = names // ', "material"'
      end associate
      a%case_text = a%case_text // "renew = [" // names(min(3, len(names) + 1):) // "]" // line_feed
   end subroutine put_renewal

   !> Does the case change load, approach or elastic constants? Then the file has their keys
   pure logical function changes_load(old, spec)
      type(case_spec), intent(in) :: old, spec

      changes_load = spec%normal /= old%normal .or. differs([spec%kinematics%fn, spec%kinematics%pen], &
         & [old%kinematics%fn, old%kinematics%pen])
      if (spec%parts%material == part_source%given) changes_load = changes_load .or. &
         & differs([spec%material%gg, spec%material%poiss], [old%material%gg, old%material%poiss])

   contains

      pure logical function differs(one, two)
         real(wp), intent(in) :: one(:), two(:)

         differs = any(abs(one - two) > 0.0_wp)
      end function differs
   end function changes_load

   !> Write what ends: damping, temperatures and wear of the previous case; and temperatures that return with kept numbers
   subroutine put_ends(a, old, spec, is_first)
      type(toml_writer), intent(inout) :: a
      type(case_spec), intent(in) :: old, spec
      logical, intent(in) :: is_first

      if (is_first) return
      if (old%has_damping .and. .not. spec%has_damping) call put_model("damping", "none")
      if (old%has_heat .and. .not. spec%has_heat) call put_model("heat", "none")
      if (old%has_wear .and. .not. spec%has_wear) call put_model("wear", "none")
      if (spec%has_heat .and. .not. old%has_heat .and. spec%parts%heat /= part_source%given) call put_model("heat", "flash")

   contains

      !> Write a group with its model only
      subroutine put_model(group, word)
         character(len=*), intent(in) :: group, word

         a%case_text = a%case_text // line_feed // "[case." // group // "]" // line_feed // 'model = "' // word // '"' // line_feed
         call a%memory%keep(group // ".model", '"' // word // '"')
      end subroutine put_model
   end subroutine put_ends

   !> Select the stored texts of a result element
   subroutine select_element(self, module_number, reid, cpid)
      class(toml_experiment_writer), intent(inout) :: self
      integer, intent(in) :: module_number, reid, cpid
      type(element_memory), allocatable :: longer(:)
      integer :: k

      if (.not. allocated(self%elements)) allocate(self%elements(2))
      do k = 1, self%count
         associate (element => self%elements(k))
            if (element%module_number == module_number .and. element%reid == reid .and. element%cpid == cpid) exit
         end associate
      end do
      self%current = k
      if (k <= self%count) return
      if (k > size(self%elements)) then
         allocate(longer(2*size(self%elements)))
         longer(:self%count) = self%elements(:self%count)
         call move_alloc(longer, self%elements)
      end if
      self%count = k
      self%elements(k)%module_number = module_number
      self%elements(k)%reid = reid
      self%elements(k)%cpid = cpid
   end subroutine select_element
end module contact_output_toml_case_writer
