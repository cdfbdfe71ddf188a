!> Contacts on grids of any place, by both orders in turn, for goals.py
!>
!> Reads "contacts places" and lines "a b b1 b3 fn pen mu nu g cksi ceta cphi"; then lines "motion n eps" until the end, each
!> followed by as many lines "x y" as there are places, parts of an element by which the grid is shifted. Writes for each of
!> these lines "motion n contact place order seconds first fx fy mz fn": processor time of a case from zero on elements that are
!> set up, and of the first one on such elements; forces relative to the friction bound, the moment to that times the root of
!> a b, and FN relative to fn.
program performance_goals
   use, intrinsic :: iso_fortran_env, only : input_unit, iostat_end, output_unit
   use contact_base_choices, only : grid_form, motion, normal_control
   use contact_base_kinds, only : wp
   use contact_bench_measure, only : cpu_seconds
   use contact_bench_problems, only : new_line_case, session_case, solve_one
   use contact_cases_spec, only : case_spec, part_source
   implicit none (type, external)

   !> One contact; lengths [mm], force [N], modulus [N/mm2]
   type :: contact_type
      real(wp) :: a = 0.0_wp, b = 0.0_wp, b1 = 0.0_wp, b3 = 0.0_wp, fn = 0.0_wp, pen = 0.0_wp, mu = 0.0_wp, nu = 0.0_wp, g = 0.0_wp
      real(wp) :: cksi = 0.0_wp, ceta = 0.0_wp, cphi = 0.0_wp
   end type contact_type

   !> The window is longer than the contact by this factor
   real(wp), parameter :: margin = 1.1_wp
   type(contact_type), allocatable :: contacts(:)
   real(wp), allocatable :: places(:, :)
   type(session_case) :: cases(2)
   character(len=8) :: what
   real(wp) :: eps
   integer :: order, k, n, number, status

   read(input_unit, *) number, k
   allocate(contacts(number), places(2, k))
   do k = 1, number
      read(input_unit, *) contacts(k)
   end do
   do order = 1, 2
      ! a session with default settings; its grid is replaced
      call new_line_case(cases(order))
   end do
   do
      read(input_unit, *, iostat=status) what, n, eps
      if (status == iostat_end) exit
      read(input_unit, *) places
      do k = 1, number
         call run_contact(contacts(k), k)
      end do
   end do
   do order = 1, 2
      call cases(order)%release()
   end do
   deallocate(contacts, places)

contains

   !> One contact on all places of a grid
   subroutine run_contact(contact, number)
      type(contact_type), intent(in) :: contact
      integer, intent(in) :: number
      real(wp) :: first(2), seconds
      integer :: order, place, orders(2)

      do order = 1, 2
         call set_case(contact, order, [0.5_wp, 0.5_wp], cases(order)%spec)
         first(order) = timed(cases(order))
      end do
      do place = 1, size(places, 2)
         ! both take turns in being first
         orders = merge([1, 2], [2, 1], mod(place, 2) == 0)
         do order = 1, 2
            associate (case => cases(orders(order)))
               call set_case(contact, orders(order), places(:, place), case%spec)
               seconds = timed(case)
               associate (r => case%result, bound => contact%mu*contact%fn)
                  write(output_unit, "(A, 4(1X, I0), 6(1X, ES16.9))") trim(what), n, number, place, orders(order), seconds, &
                     & first(orders(order)), r%fx/bound, r%fy/bound, r%mz/(bound*sqrt(contact%a*contact%b)), r%fn/contact%fn
               end associate
            end associate
         end do
      end do
      flush(output_unit)
   end subroutine run_contact

   !> Solve once [s]
   real(wp) function timed(case) result(seconds)
      type(session_case), intent(inout) :: case

      seconds = cpu_seconds()
      call solve_one(case)
      seconds = cpu_seconds() - seconds
      if (.not. case%result%status%is_solved()) error stop "a contact has no solution"
   end function timed

   !> A contact on one place of the grid
   subroutine set_case(contact, order, place, spec)
      type(contact_type), intent(in) :: contact
      integer, intent(in) :: order
      !> Parts of an element
      real(wp), intent(in) :: place(2)
      type(case_spec), intent(inout) :: spec

      spec%parts%grid = part_source%given
      spec%parts%geometry = part_source%given
      spec%motion = merge(motion%none, motion%steady_rolling, what == "normal")
      spec%normal = merge(normal_control%approach, normal_control%force, what == "normal")
      spec%material%gg = contact%g
      spec%material%poiss = contact%nu
      spec%friction%sets(1)%fstat = contact%mu
      spec%friction%sets(1)%fkin = contact%mu
      spec%kinematics%fn = contact%fn
      spec%kinematics%pen = contact%pen
      spec%kinematics%cksi = contact%cksi
      spec%kinematics%ceta = contact%ceta
      spec%kinematics%cphi = contact%cphi
      spec%iteration%order = order
      spec%iteration%eps = eps
      spec%geometry%b = 0.0_wp
      spec%geometry%b(1) = contact%b1
      spec%geometry%b(3) = contact%b3
      associate (grid => spec%grid)
         grid%form = grid_form%corner_and_sides
         ! one more, so that all places hold the contact
         grid%mx = n + 1
         grid%my = n + 1
         grid%dx = 2.0_wp*margin*contact%a/n
         grid%dy = 2.0_wp*margin*contact%b/n
         grid%xl = -margin*contact%a + (place(1) - 1.0_wp)*grid%dx
         grid%yl = -margin*contact%b + (place(2) - 1.0_wp)*grid%dy
         spec%rolling%dq = grid%dx
      end associate
   end subroutine set_case
end program performance_goals
