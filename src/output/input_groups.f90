!> The groups of an input file that both modules have, as the reader expects them
module contact_output_input_groups
   use contact_base_choices, only : heat_source
   use contact_base_kinds, only : wp
   use contact_cases_friction_setup, only : values_of
   use contact_cases_spec, only : case_digits, case_spec
   implicit none (type, external)
   private

   public :: put_line, put_words, put_iteration, put_friction, put_materials, put_damping, put_heat, numbers, integers

   !> Sixteen figures tell numbers apart
   integer, parameter :: width = 24

contains

   !> Values, then their names; a comment for readers in both senses
   subroutine put_line(unit, values, names)
      integer, intent(in) :: unit
      character(len=*), intent(in) :: values, names
      integer :: status

      write(unit, '(A)', iostat=status) " " // values // "   % " // names
   end subroutine put_line

   !> Real numbers with all their figures, with blanks behind
   pure function number_row(values) result(text)
      real(wp), intent(in) :: values(:)
      character(len=width*size(values)) :: text
      character(len=width) :: word
      integer :: k, last

      text = ""
      last = -1
      do k = 1, size(values)
         write(word, '(ES23.15E3)') values(k)
         if (abs(values(k)) < 1.0e6_wp .and. abs(values(k)) >= 0.0_wp) then
            if (abs(values(k) - anint(values(k))) <= 0.0_wp) write(word, '(F10.1)') values(k)
         end if
         text(last + 2:) = adjustl(word)
         last = len_trim(text)
      end do
   end function number_row

   !> The same without the blanks
   pure function numbers(values) result(text)
      real(wp), intent(in) :: values(:)
      character(len=len_trim(number_row(values))) :: text

      text = number_row(values)
   end function numbers

   !> Integers, with blanks behind
   pure function integer_row(values) result(text)
      integer, intent(in) :: values(:)
      character(len=12*size(values)) :: text

      write(text, '(*(I0, :, " "))') values
   end function integer_row

   !> The same without the blanks
   pure function integers(values) result(text)
      integer, intent(in) :: values(:)
      character(len=len_trim(integer_row(values))) :: text

      text = integer_row(values)
   end function integers

   !> The three control words
   subroutine put_words(unit, digits, is_pair)
      integer, intent(in) :: unit
      type(case_digits), intent(in) :: digits
      !> Is it a case of module 1, which has a digit more?
      logical, intent(in) :: is_pair
      character(len=7) :: word

      associate (d => digits)
         if (is_pair) then
            write(word, '(7I1)') d%c1, d%p, d%b, d%t, d%n, d%f, d%s
            call put_line(unit, word, "CPBTNFS")
         else
            write(word, '(6I1)') d%p, d%b, d%t, d%n, d%f, d%s
            call put_line(unit, trim(word), "PBTNFS")
         end if
         write(word, '(7I1)') d%v, d%l, d%d, d%c, d%m, d%z, d%e
         call put_line(unit, word // " " // integers([10*d%gapwgt + d%m2]), "VLDCMZE, GAPWGT M2")
         write(word, '(7I1)') d%h, d%g, d%i, d%a, d%o, d%w, d%r
         call put_line(unit, word, "HGIAOWR")
      end associate
   end subroutine put_words

   !> Limits of iterations (G other than 1)
   subroutine put_iteration(unit, spec, with_elements)
      integer, intent(in) :: unit
      type(case_spec), intent(in) :: spec
      !> With the largest number of elements?
      logical, intent(in) :: with_elements

      if (spec%digits%g == 1) return
      associate (it => spec%iteration)
         if (with_elements) then
            call put_line(unit, integers([it%maxgs, it%maxin, it%maxnr, it%maxout]) // " " // numbers([it%eps]) // " " // &
               & integers([it%npot_max]), "MAXGS MAXIN MAXNR MAXOUT EPS NPOT_MAX")
         else
            call put_line(unit, integers([it%maxgs, it%maxin, it%maxnr, it%maxout]) // " " // numbers([it%eps]), &
               & "MAXGS MAXIN MAXNR MAXOUT EPS")
         end if
         select case (spec%digits%g)
         case (2, 3)
            call put_line(unit, numbers([it%omegah, it%omegas]) // " " // integers([it%inislp]) // " " // &
               & numbers([it%omgslp]), "OMEGAH OMEGAS INISLP OMGSLP")
         case (4)
            call put_line(unit, integers([it%inislp]) // " " // numbers([it%omgslp]), "INISLP OMGSLP")
         case (5)
            call put_line(unit, numbers([it%fdecay, it%betath]) // " " // integers([it%kdowfb]) // " " // numbers([it%d_ifc, &
               & it%d_lin, it%d_cns, it%d_slp, it%pow_s]), "FDECAY BETATH KDOWFB D_IFC D_LIN D_CNS D_SLP POW_S")
         end select
      end associate
   end subroutine put_iteration

   !> Friction law with its points, and memory (L other than 1)
   subroutine put_friction(unit, spec)
      integer, intent(in) :: unit
      type(case_spec), intent(in) :: spec
      character(len=:), allocatable :: start
      integer :: k

      if (spec%digits%l == 1) return
      associate (friction => spec%friction)
         if (spec%digits%v > 0) call put_line(unit, integers([size(friction%sets)]), "NVF")
         do k = 1, size(friction%sets)
            start = ""
            if (spec%digits%v > 0) start = numbers([friction%sets(k)%position]) // " "
            call put_line(unit, start // numbers(values_of(spec%friction_law, friction%sets(k))), &
               & trim(merge("POSITION ", "         ", spec%digits%v > 0)) // " FRICTION LAW")
         end do
         if (any(spec%digits%l == [2, 3, 4, 6])) call put_line(unit, numbers([friction%memdst, friction%mem_s0]), "MEMDST MEM_S0")
      end associate
   end subroutine put_friction

   !> Elastic constants and what belongs to the model (C of 2 and above)
   subroutine put_materials(unit, spec)
      integer, intent(in) :: unit
      type(case_spec), intent(in) :: spec

      if (spec%digits%c < 2) return
      associate (m => spec%material)
         ! only wheel and rail, whose inclinations are those of the profiles
         if (spec%digits%c == 4) call put_line(unit, integers([m%if_meth, m%variant]), "IF_METH VARIANT")
         call put_line(unit, numbers([m%poiss, m%gg]), "POISS 1, 2, GG 1, 2")
         if (spec%digits%b == 1) call put_line(unit, numbers([m%flxz]), "FLXZ")
         select case (spec%digits%m)
         case (1)
            call put_line(unit, numbers([m%fg, m%tc]), "FG 1, 2, TC 1, 2")
         case (2)
            call put_line(unit, numbers([m%flx, m%k0_mf, m%alfamf, m%betamf]), "FLX K0_MF ALFAMF BETAMF")
         case (3, 5)
            call put_line(unit, numbers([m%k0_mf, m%alfamf, m%betamf]), "K0_MF ALFAMF BETAMF")
         case (4)
            call put_line(unit, numbers([m%gg3, m%laythk, m%tau_c0, m%k_tau]), "GG3 LAYTHK TAU_C0 K_TAU")
         end select
      end associate
   end subroutine put_materials

   !> Damping (M2 = 2)
   subroutine put_damping(unit, spec)
      integer, intent(in) :: unit
      type(case_spec), intent(in) :: spec

      if (spec%digits%m2 < 2) return
      associate (d => spec%damping)
         call put_line(unit, numbers([d%cdampn, d%cdampt, d%dfnmax, d%dftmax]), "CDAMPN CDAMPT DFNMAX DFTMAX")
      end associate
   end subroutine put_damping

   !> Thermal constants (H = 3)
   subroutine put_heat(unit, spec)
      integer, intent(in) :: unit
      type(case_spec), intent(in) :: spec
      integer :: body

      if (spec%digits%h /= 3) return
      associate (heat => spec%heat)
         do body = 1, 2
            call put_line(unit, numbers([heat%bktemp(body), heat%heatcp(body), heat%lambda(body), heat%dens(body)]), &
               & "BKTEMP HEATCP LAMBDA DENS" // merge(", temperatures as with --heat moving-source", repeat(" ", 43), &
               & heat%source == heat_source%moving))
         end do
         if (spec%digits%m == 4) call put_line(unit, numbers([heat%betapl]), "BETAPL")
      end associate
   end subroutine put_heat
end module contact_output_input_groups
