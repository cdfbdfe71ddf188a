!> A suite with a failure ends with a status other than zero (this test is marked WILL_FAIL)
program harness_fails
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("one failure")
   call suite%check(.true., "passes")
   call suite%check(.false., "fails on purpose")
   call suite%finish()
end program harness_fails
