!> Description of a case in words: what is simulated and what is not, by which method, and the expected cost
module contact_output_case_words
   use contact_base_choices, only : heat_source, is_simplified, motion, slip_source, variation
   use contact_base_kinds, only : wp
   use contact_cases_approximate_methods, only : approximate_method, choose_method
   use contact_cases_estimate, only : case_cost, cost_text
   use contact_cases_machine_pace, only : machine_pace
   use contact_cases_spec, only : case_spec
   use contact_control_digits, only : case_digits, digit_of, digit_text
   use contact_control_translation, only : digits_of
   use contact_control_words, only : form_title, translate_to_words
   use contact_text_buffer, only : text_buffer
   use contact_text_words, only : integer_text, real_text
   implicit none (type, external)
   private

   public :: describe_case

contains

   !> Describe one case
   subroutine describe_case(module_number, reid, number, first_line, spec, description, cost)
      integer, intent(in) :: module_number
      !> Result element, 0 for the default one; index in the file, from 1; line on which the case begins
      integer, intent(in) :: reid, number, first_line
      type(case_spec), intent(in) :: spec
      !> Receives the description, line by line
      type(text_buffer), intent(inout) :: description
      !> Expected cost; absent if the case cannot be computed
      type(case_cost), intent(in), optional :: cost
      character(len=:), allocatable :: title
      type(approximate_method) :: chosen
      type(case_digits) :: digits

      title = "two bodies in contact"
      if (module_number == 1) then
         digits = digits_of(spec)
         title = digit_text("C1", digits%c1, module_number)
      end if
      if (reid > 0) title = trim(title) // ", result element " // integer_text(reid)
      call description%add_line("Case " // integer_text(number) // ", line " // integer_text(first_line) // ": " // trim(title))
      if (.not. spec%solve) then
         call add("Only its input is stored; nothing is computed.")
         return
      end if
      call add("Motion: " // trim(digit("T", spec%motion)))
      call add("Given: " // trim(digit("N", spec%normal)) // merge(";", " ", spec%motion /= motion%none) // &
         & trim(digit_if(spec%motion /= motion%none, "F", spec%force)))
      call add("Pressures: " // trim(digit("B", spec%pressure)))
      if (spec%motion /= motion%none) then
         call add("Friction: " // trim(digit("L", spec%friction_law)) // "; " // trim(digit("V", spec%variation)))
         call add("Solver: " // trim(digit("G", spec%solver)) // merge("; order 2", "         ", spec%iteration%order == 2))
      end if
      if (spec%estimates_errors) call add("Errors of the totals are estimated.")
      if (spec%iteration%accuracy > 0.0_wp) call add("Accuracy: the forces to " // real_text(spec%iteration%accuracy) // &
         & "; elements, order and EPS are chosen")
      if (spec%iteration%accuracy > 0.0_wp .and. spec%iteration%allows_approximate) call choose_method(spec, chosen)
      if (chosen%words /= "") call add("Simplified methods are allowed: " // trim(chosen%words))
      call add("Material: " // trim(digit("M", spec%material_model)))
      if (.not. is_simplified(spec%material_model)) call add("Elasticity: " // trim(digit("C", spec%kernel)))
      if (module_number == 1) then
         call add("Contact search: " // trim(digit("D", spec%wheel_rail%search%location)))
         call add("Elements: " // real_text(spec%wheel_rail%search%dx) // " mm along the track, " // &
            & real_text(spec%wheel_rail%search%ds) // " mm across")
         if (allocated(spec%wheel_rail%rail_profile%name) .and. allocated(spec%wheel_rail%wheel_profile%name)) &
            & call add("Profiles: " // spec%wheel_rail%rail_profile%name // " and " // spec%wheel_rail%wheel_profile%name)
      else
         call add("Elements: " // integer_text(spec%grid%mx) // " along x, " // integer_text(spec%grid%my) // &
            & " along y; " // trim(form_title("IPOTCN", spec%grid%form)))
         if (spec%grid%needs_geometry()) call add("Undeformed distance: " // trim(form_title("IBASE", spec%geometry%form)))
         if (spec%slip_source /= slip_source%none .and. spec%motion /= motion%none) &
            & call add("Rigid slip: " // trim(digit("E", spec%slip_source)))
      end if
      call add("History: " // trim(digit("P", spec%link)) // "; " // trim(digit("I", spec%estimate)))
      if (spec%has_heat) call add("Surface temperatures: flash heating" // &
         & trim(merge(", moving sources               ", ", as in the established program", &
         & spec%heat%source == heat_source%moving)))
      if (spec%has_wear) call add("Wear and fatigue are computed.")
      if (spec%has_damping) call add("Damping: proportional to the rates of the forces")
      if (spec%has_stress .and. allocated(spec%subsurface%blocks)) call add("Stresses below the surface: " // &
         & integer_text(size(spec%subsurface%blocks)) // " blocks of points")
      call add("Not simulated: " // trim(absent(spec)))
      if (.not. present(cost)) return
      if (allocated(cost%refusal)) then
         call add("A run refuses this case: " // cost%refusal)
      else
         call add("Expected on one thread: " // trim(cost_text(cost, machine_pace())))
      end if

   contains

      !> Add one line
      subroutine add(line)
         character(len=*), intent(in) :: line
         character(len=:), allocatable :: text

         call translate_to_words(line, module_number, text)
         call description%add_line("  " // trim(text))
      end subroutine add

      !> Description of a choice, padded with blanks
      pure function digit(name, choice) result(text)
         character(len=*), intent(in) :: name
         integer, intent(in) :: choice
         character(len=80) :: text

         text = digit_text(name, digit_of(name, choice, module_number), module_number)
      end function digit

      !> The same preceded by a blank; blank if it has no meaning
      pure function digit_if(has_meaning, name, choice) result(text)
         logical, intent(in) :: has_meaning
         character(len=*), intent(in) :: name
         integer, intent(in) :: choice
         character(len=81) :: text

         text = ""
         if (has_meaning) text = " " // digit(name, choice)
      end function digit_if
   end subroutine describe_case

   !> Effects that a case neglects, padded with blanks
   pure function absent(spec) result(text)
      type(case_spec), intent(in) :: spec
      character(len=240) :: text

      text = "inertia of the bodies"
      if (spec%motion == motion%none) text = trim(text) // ", friction"
      if (.not. spec%has_heat) text = trim(text) // ", surface temperatures"
      if (.not. spec%has_damping) text = trim(text) // ", damping"
      if (.not. spec%has_plasticity()) text = trim(text) // ", plasticity"
      if (.not. spec%has_stress) text = trim(text) // ", stresses below the surface"
      if (spec%motion /= motion%none .and. spec%variation == variation%none) text = trim(text) // &
         & ", friction that differs from place to place"
   end function absent
end module contact_output_case_words
