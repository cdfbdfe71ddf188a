!> NaN and infinite numbers must never be used silently
program test_hard_numbers
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_negative_inf, ieee_positive_inf, &
      & ieee_quiet_nan, ieee_value
   use contact_base_choices, only : motion, normal_control, slip_source
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use hard_case, only : close_table, elliptic_case, expect_solution, given_case, hard_run, has_message, open_table, run_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("hard numbers")
   call open_table("Recovery after refused numbers")
   call hostile()
   call close_table()
   call suite%finish()

contains

   subroutine hostile()
      type(hard_run) :: run
      type(case_spec) :: spec
      integer :: place, t, kind
      real(wp) :: bad(3)
      character(len=80) :: label

      bad = [ieee_value(1.0_wp, ieee_quiet_nan), ieee_value(1.0_wp, ieee_positive_inf), ieee_value(1.0_wp, ieee_negative_inf)]
      do t = motion%none, motion%steady_rolling
         do kind = 1, 3
            do place = 1, 41
               spec = given_case(t, 7, 7)
               if (place >= 30) spec = elliptic_case(t, 7, 7, 1.0_wp, 1.0_wp)
               call spoil(spec, place, bad(kind))
               if (.not. matters(spec, place)) cycle
               ! an infinite distance means that contact is impossible there
               if (place == 15 .and. kind == 2) cycle
               write(label, "(a, i0, a, i0, a, i0)") "place ", place, ", value ", kind, ", T=", t
               call run_case(run, spec)
               call suite%check(has_message(run), trim(label) // " is refused with a message")
            end do
            ! the session is still usable
            spec = given_case(t, 7, 7)
            spec%kinematics%cksi = 1.0e-4_wp
            write(label, "(a, i0, a, i0)") "after value ", kind, ", T=", t
            call expect_solution(suite, run, spec, trim(label))
         end do
      end do
      call run%release()
   end subroutine hostile

   !> Is this number used by the case at all?
   pure logical function matters(spec, place)
      type(case_spec), intent(in) :: spec
      integer, intent(in) :: place

      matters = .true.
      if (spec%motion == motion%none) then
         select case (place)
         case (3:6, 12:14, 19:24, 40:41)
            matters = .false.
         end select
      else if (spec%motion == motion%shift) then
         matters = place < 20 .or. place > 22
      end if
   end function matters

   !> Replace one value by a bad number
   subroutine spoil(spec, place, value)
      type(case_spec), intent(inout) :: spec
      integer, intent(in) :: place
      real(wp), intent(in) :: value

      select case (place)
      case (1)
         spec%kinematics%fn = value
      case (2)
         spec%normal = normal_control%approach
         spec%kinematics%pen = value
      case (3)
         spec%kinematics%cksi = value
      case (4)
         spec%kinematics%ceta = value
      case (5)
         spec%kinematics%cphi = value
      case (6)
         spec%kinematics%cphi = 1.0e-4_wp
         spec%kinematics%spinxo = value
      case (7)
         spec%grid%xl = value
      case (8)
         spec%grid%dx = value
      case (9)
         spec%grid%dy = value
      case (10)
         spec%material%gg(1) = value
      case (11)
         spec%material%poiss(2) = value
      case (12)
         spec%force = 1
         spec%kinematics%fx = value
      case (13)
         spec%force = 2
         spec%kinematics%fy = value
      case (14)
         spec%friction%sets(1)%fstat = value
      case (15)
         spec%geometry%form = 9
         allocate(spec%geometry%h(49), source=0.0_wp)
         spec%geometry%h(20) = value
      case (16)
         spec%geometry%b(1) = value
      case (17)
         spec%iteration%eps = value
      case (18)
         spec%geometry%planform = 2
         spec%geometry%pl(1:6) = [1.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, value]
      case (19)
         spec%slip_source = slip_source%given
         allocate(spec%extra_slip(2, 49), source=0.0_wp)
         spec%extra_slip(2, 30) = value
      case (20)
         spec%rolling%dq = value
      case (21)
         spec%rolling%chi = value
      case (22)
         spec%rolling%veloc = value
      case (23)
         spec%kinematics%cphi = 1.0e-4_wp
         spec%kinematics%spinyo = value
      case (24)
         spec%friction%sets(1)%fstat = -abs(value)
         if (.not. ieee_is_finite(value)) spec%friction%sets(1)%fstat = value
      case (25)
         spec%grid%yl = value
      case (26)
         spec%material%gg(2) = 0.0_wp
      case (27)
         spec%material%gg(1) = -1.0_wp
      case (28)
         spec%iteration%eps = 0.0_wp
      case (29)
         spec%geometry%b(6) = value
      case (30)
         spec%grid%aa = value
      case (31)
         spec%grid%bb = value
      case (32)
         spec%grid%scale = value
      case (33)
         spec%kinematics%fn = value
      case (34)
         spec%normal = normal_control%approach
         spec%kinematics%pen = value
      case (35)
         spec%material%gg(1) = value
      case (36)
         spec%material%poiss(1) = value
      case (37)
         spec%grid%form = -1
         spec%grid%a1 = value
         spec%grid%b1 = 1.0_wp
      case (38)
         spec%grid%form = -2
         spec%grid%a1 = 1.0_wp
         spec%grid%aob = value
      case (39)
         spec%grid%mx = 0
      case (40)
         spec%kinematics%cksi = value
      case (41)
         spec%friction%sets(1)%fstat = value
      end select
   end subroutine spoil
end program test_hard_numbers
