!> Names of the files of an experiment, text of the progress line, stopwatch, letters of the journal
program test_experiment
   use contact_base_case_status, only : case_state, case_status, missed_iteration
   use contact_base_kinds, only : wp
   use contact_experiment_journal, only : advised, is_advised, letter_of
   use contact_experiment_place, only : experiment_place, locate_experiment
   use contact_experiment_progress, only : progress_text
   use contact_experiment_stopwatch, only : stopwatch
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("experiment")
   call places(suite)
   call progress(suite)
   call stopwatches(suite)
   call letters(suite)
   call suite%finish()

contains

   !> Final status of a case: each has its own letter, in upper case if a larger grid was recommended
   subroutine letters(suite)
      type(test_suite), intent(inout) :: suite
      character(len=*), parameter :: expected = "snrti"
      character(len=1) :: letter
      type(case_status) :: status(5)
      logical :: named
      integer :: k

      status(2)%state = case_state%not_converged
      status(3)%state = case_state%refused
      status(4)%state = case_state%not_converged
      status(4)%iteration = missed_iteration%time
      status([1, 5])%state = case_state%solved
      do k = 1, size(status)
         letter = letter_of(status(k), solved=k /= 5)
         call suite%equal(letter, expected(k:k), "letter of an end")
         call is_advised(letter, named)
         call suite%check(letter == expected(k:k) .and. .not. named, "without a remark " // letter)
         letter = advised(letter)
         call is_advised(letter, named)
         call suite%check(letter == expected(k:k) .and. named, "with a remark " // letter)
      end do
   end subroutine letters

   !> From the argument of the user to the names of files
   subroutine places(suite)
      type(test_suite), intent(inout) :: suite

      call check_place(suite, "run", "", "", "run", "run.inp", "run")
      call check_place(suite, "run.inp", "", "", "run", "run.inp", "run")
      call check_place(suite, " run ", "", "", "run", "run.inp", "run")
      call check_place(suite, ".inp", "", "", ".inp", ".inp.inp", ".inp")
      call check_place(suite, "a/.inp", "", "a/", ".inp", "a/.inp.inp", "a/.inp")
      call check_place(suite, "run.INP", "", "", "run.INP", "run.INP.inp", "run.INP")
      call check_place(suite, "a/b/run", "", "a/b/", "run", "a/b/run.inp", "a/b/run")
      call check_place(suite, "a\b\run.inp", "", "a/b/", "run", "a/b/run.inp", "a/b/run")
      call check_place(suite, "/run", "", "/", "run", "/run.inp", "/run")
      call check_place(suite, "a/run", "out", "a/", "run", "a/run.inp", "out/run")
      call check_place(suite, "a/run", "out\x/", "a/", "run", "a/run.inp", "out/x/run")
      call check_place(suite, "run", "/", "", "run", "run.inp", "/run")
      call check_place(suite, "a/", "", "a/", "", "a/.inp", "a/")
   end subroutine places

   !> One name
   subroutine check_place(suite, typed, output_folder, folder, name, input, results)
      type(test_suite), intent(inout) :: suite
      character(len=*), intent(in) :: typed, output_folder, folder, name, input, results
      type(experiment_place) :: place

      place = locate_experiment(typed, output_folder)
      call suite%check(place%folder == folder .and. len(place%folder) == len(folder), typed // ": folder")
      call suite%check(place%name == name .and. len(place%name) == len(name), typed // ": name")
      call suite%check(place%input == input, typed // ": input is " // place%input)
      call suite%check(place%results == results, typed // ": results are " // place%results)
   end subroutine check_place

   !> Remaining time in the text of the progress line
   subroutine progress(suite)
      type(test_suite), intent(inout) :: suite

      call suite%check(progress_text(0, 20, 1.0_wp) == " case 1 of 20", "no case is finished")
      call suite%check(progress_text(10, 20, 65.0_wp) == " case 11 of 20, 1:05 left", "a half is done")
      call suite%check(progress_text(1, 3, 5000.0_wp) == " case 2 of 3, 2:46:40 left", "hours")
      call suite%check(progress_text(20, 20, 65.0_wp) == " case 20 of 20, 0:00 left", "all is done")
      call suite%check(progress_text(1, huge(1), 1.0e30_wp) == " case 2 of 2147483647, 8333:20:00 left", "for ever")
   end subroutine progress

   !> Calls are counted and times are added
   subroutine stopwatches(suite)
      type(test_suite), intent(inout) :: suite
      type(stopwatch) :: watch
      integer :: k

      do k = 1, 3
         call watch%start()
         call watch%halt()
      end do
      call suite%check(watch%calls == 3, "three calls")
      call suite%check(watch%wall >= 0.0_wp .and. watch%wall < 10.0_wp, "elapsed time")
      call suite%check(watch%cpu >= 0.0_wp .and. watch%cpu < 10.0_wp, "processor time")
   end subroutine stopwatches
end program test_experiment
