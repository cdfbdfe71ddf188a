!> A made-up case and its result, and a reader that looks at files as the public scripts do
module output_sample
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : ending
   use contact_cases_spec, only : case_spec
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: fill_sample, find_line, numbers_on, read_lines, text_line, word_count

   !> One line of a file
   type :: text_line
      character(len=:), allocatable :: text
   end type text_line

contains

   !> Sphere on a plane, mx by my elements, adhesion at the leading and slip at the trailing edge; invented numbers
   subroutine fill_sample(spec, result, mx, my)
      type(case_spec), intent(out) :: spec
      type(patch_result), intent(out) :: result
      integer, intent(in) :: mx, my
      real(wp) :: distance
      integer :: ix, iy

      allocate(spec%friction%sets(1))
      spec%material%gg = 82000.0_wp
      spec%grid%form = 1
      spec%iteration%eps = 1.0e-5_wp
      spec%kinematics%fx = -0.5_wp
      spec%kinematics%fy = 0.25_wp
      spec%kinematics%cksi = 1.0e-3_wp
      spec%kinematics%ceta = -2.0e-3_wp

      result%grid%mx = mx
      result%grid%my = my
      result%grid%dx = 2.4_wp/real(mx, wp)
      result%grid%dy = 2.4_wp/real(my, wp)
      result%grid%xl = -1.2_wp
      result%grid%yl = -1.2_wp
      result%gg = 82000.0_wp
      result%nu = 0.28_wp
      result%dq = 0.2_wp
      result%veloc = 5000.0_wp
      result%fn = 100000.0_wp
      result%fx = -15000.0_wp
      result%fy = 7500.0_wp
      result%fx_rel = -0.5_wp
      result%fy_rel = 0.25_wp
      result%mz = 1.0e-3_wp
      result%cksi = 1.0e-3_wp
      result%ceta = -2.0e-3_wp
      result%elastic_energy = 3.62_wp
      result%friction_power = -1250.0_wp
      result%pen = 0.0819_wp
      result%pmax = 770.6_wp
      result%inorm = 1
      result%itang = 2
      result%normal%method = "first method"
      result%normal%ended = ending%converged
      result%normal%iterations = 8
      result%normal%residual = 1.2e-9_wp
      result%tangential%method = "second method"
      result%tangential%ended = ending%converged
      result%tangential%iterations = 31
      result%tangential%residual = 3.4e-7_wp

      allocate(result%division(mx, my), source=0)
      allocate(result%h(mx, my), result%mu(mx, my), result%pn(mx, my), result%px(mx, my), result%py(mx, my), &
         & result%un(mx, my), result%ux(mx, my), result%uy(mx, my), result%sx(mx, my), result%sy(mx, my), &
         & result%wx(mx, my), result%wy(mx, my), source=0.0_wp)
      result%mu = 0.3_wp
      do iy = 1, my
         do ix = 1, mx
            distance = hypot(result%grid%x(ix), result%grid%y(iy))
            result%h(ix, iy) = 0.01_wp*distance**2
            result%wx(ix, iy) = 2.0e-4_wp
            if (distance >= 1.0_wp) cycle
            result%division(ix, iy) = 1
            result%pn(ix, iy) = 770.6_wp*sqrt(1.0_wp - distance**2)
            result%py(ix, iy) = 0.1_wp*result%pn(ix, iy)
            if (result%grid%x(ix) > -0.3_wp) cycle
            result%division(ix, iy) = 2
            result%py(ix, iy) = 0.3_wp*result%pn(ix, iy)
            result%sy(ix, iy) = -4.0e-5_wp
         end do
      end do
      result%ncon = count(result%division >= 1)
      result%nadh = count(result%division == 1)
      result%nslip = count(result%division == 2)
   end subroutine fill_sample

   !> All lines of a file
   subroutine read_lines(name, lines)
      character(len=*), intent(in) :: name
      type(text_line), allocatable, intent(out) :: lines(:)
      character(len=2000) :: buffer
      integer :: unit, status, count, i, length

      open(newunit=unit, file=name, status="old", action="read")
      count = 0
      do
         read(unit, "(a)", iostat=status) buffer
         if (status /= 0) exit
         count = count + 1
      end do
      rewind(unit)
      allocate(lines(count))
      do i = 1, count
         read(unit, "(a)", advance="no", size=length, iostat=status) buffer
         lines(i)%text = buffer(1:length)
      end do
      close(unit)
   end subroutine read_lines

   !> Number of the first line from the given one on that holds a text, 0 if there is none
   pure integer function find_line(lines, text, start) result(found)
      type(text_line), intent(in) :: lines(:)
      character(len=*), intent(in) :: text
      integer, intent(in) :: start
      integer :: i

      found = 0
      do i = start, size(lines)
         if (index(lines(i)%text, text) == 0) cycle
         found = i
         return
      end do
   end function find_line

   !> Number of words between blanks
   pure integer function word_count(text) result(count)
      character(len=*), intent(in) :: text
      integer :: i

      count = 0
      do i = 1, len(text)
         if (text(i:i) == " ") cycle
         if (i == 1) then
            count = count + 1
         else if (text(i - 1:i - 1) == " ") then
            count = count + 1
         end if
      end do
   end function word_count

   !> All numbers of a line, split on blanks; empty when a word is no number
   function numbers_on(text) result(values)
      character(len=*), intent(in) :: text
      real(wp), allocatable :: values(:)
      integer :: status

      allocate(values(word_count(text)))
      read(text, *, iostat=status) values
      if (status /= 0) values = [real(wp) ::]
   end function numbers_on
end module output_sample
