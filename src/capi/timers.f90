!> Computing times of the problems of the library, and their table at the end of a run
module contact_capi_timers
   use contact_capi_library, only : library, max_elements, problem_pointer
   use contact_capi_problem, only : max_patches
   use contact_output_report, only : timer_line, write_end
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: book_times, write_timers, set_timer_level

   !> Timer level with all timers
   integer, parameter :: all_timers = 2

contains

   !> Store the times of a problem before it is freed
   subroutine book_times(slot)
      !> Problem; its times are zero afterwards
      type(problem_pointer), intent(inout) :: slot

      slot%timed_module = slot%p%module_number
      call slot%total%add(slot%p%total)
      call slot%stresses%add(slot%p%stresses)
   end subroutine book_times

   !> Write the table of times, in total and per problem; at the highest level with those of stresses
   subroutine write_timers()
      type(timer_line), allocatable :: lines(:)
      integer :: k, i, n

      if (library%debugging < 0 .or. library%timer_level < 1) return
      n = 1
      do k = 1, max_elements
         n = n + 2*count(library%elements(k)%patch%timed_module /= 0)
      end do
      allocate(lines(n))
      n = 1
      call library%total%fill_line("Total", lines(1))
      do k = 1, max_elements
         do i = 1, max_patches
            associate (slot => library%elements(k)%patch(i))
               if (slot%timed_module == 0) cycle
               n = n + 1
               if (slot%timed_module == 3) then
                  call slot%total%fill_line("Cp." // integer_text(i) // " on Res.el." // integer_text(k), lines(n))
               else
                  call slot%total%fill_line("Result element " // integer_text(k), lines(n))
               end if
               if (library%timer_level < all_timers .or. slot%stresses%calls == 0) cycle
               n = n + 1
               call slot%stresses%fill_line("- stresses below", lines(n))
            end associate
         end do
      end do
      call write_end(library%log, library%max_threads, lines(:n))
   end subroutine write_timers

   !> Set the level of the timer table: 0 none, 1 overview, 2 everything
   subroutine set_timer_level(level)
      !> Level as in the flag of the library
      integer, intent(in) :: level

      !$omp critical (contact_registry)
      library%timer_level = level
      !$omp end critical (contact_registry)
   end subroutine set_timer_level
end module contact_capi_timers
