!> Settings of a case that established input files cannot express: options of the program give them, or nothing does
module contact_output_unwritten
   use contact_base_choices, only : heat_source, is_classical, is_rolling
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_text_words, only : real_text
   implicit none (type, external)
   private

   public :: unwritten_setting, unwritten_settings

   !> A setting that an input file cannot express
   type :: unwritten_setting
      !> What the case has, as a sentence without a full stop; blank if the case does not have it
      character(len=60) :: fact = ""
      !> Option of the program that gives it; blank if none does
      character(len=40) :: option = ""
   end type unwritten_setting

   !> Number of such settings
   integer, parameter :: number = 9

contains

   !> The settings of a case that its input file cannot express, each at its own position in the list
   pure function unwritten_settings(spec) result(list)
      !> The case
      type(case_spec), intent(in) :: spec
      type(unwritten_setting) :: list(number)
      character(len=:), allocatable :: accuracy

      if (spec%has_heat .and. spec%heat%source == heat_source%moving) &
         & list(1) = unwritten_setting("temperatures are those of moving sources", "--heat moving-source")
      if (is_rolling(spec%motion) .and. spec%iteration%order == 2) list(2) = unwritten_setting("rolling is of order 2", "--order 2")
      if (spec%classical .and. is_classical(spec%solver)) &
         & list(3) = unwritten_setting("the solver named by G is used", "--classical")
      if (spec%estimates_errors) list(4) = unwritten_setting("errors are estimated", "--errors")
      if (spec%iteration%accuracy > 0.0_wp) then
         accuracy = real_text(spec%iteration%accuracy)
         list(5) = unwritten_setting("the accuracy is " // accuracy, "--accuracy " // accuracy)
      end if
      if (spec%iteration%allows_approximate) &
         & list(6) = unwritten_setting("simplified methods are allowed", "--allow approximate")
      if (spec%has_wear) list(7) = unwritten_setting("wear and fatigue are computed", "")
      if (.not. allocated(spec%wheel_rail)) return
      associate (pair => spec%wheel_rail)
         if (.not. pair%search%angle_below_axle) &
            & list(8) = unwritten_setting("contact angles on varying rails are those of the contact", "--contact-angle contact")
         if (pair%roller .and. abs(pair%track%cant) > 0.0_wp) &
            & list(9) = unwritten_setting("the roller has CANT = " // real_text(pair%track%cant) // " rad", "")
      end associate
   end function unwritten_settings
end module contact_output_unwritten
