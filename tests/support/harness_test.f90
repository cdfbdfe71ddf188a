!> The harness counts correctly: each failing check below is intended to fail
program harness_test
   use, intrinsic :: ieee_arithmetic, only : ieee_positive_inf, ieee_quiet_nan, ieee_value
   use contact_base_kinds, only : wp
   use contact_test_harness, only : environment, test_suite
   implicit none (type, external)

   type(test_suite) :: inner, suite
   real(wp) :: infinity, nan

   nan = ieee_value(nan, ieee_quiet_nan)
   infinity = ieee_value(infinity, ieee_positive_inf)
   call suite%start("harness")

   call inner%start("failures on purpose")
   call inner%check(.false., "false")
   call inner%close_to(nan, nan, 1.0_wp, "NaN against NaN")
   call inner%close_to(nan, 1.0_wp, infinity, "NaN against a number")
   call inner%close_to(1.0_wp, nan, infinity, "a number against NaN")
   call inner%close_to(1.0_wp, 1.0_wp, nan, "NaN as tolerance")
   call inner%close_to(infinity, 1.0_wp, 1.0_wp, "infinity against a number")
   call inner%close_to(1.2_wp, 1.0_wp, 0.1_wp, "too far")
   call inner%close_to(1.2e-3_wp, 1e-3_wp, 0.1_wp, "too far, relative", relative=.true.)
   call inner%close_to(1e-300_wp, 0.0_wp, 0.1_wp, "relative to zero", relative=.true.)
   call inner%close_to([1.0_wp, 2.0_wp], [1.0_wp, 2.2_wp], 0.1_wp, "second element")
   call inner%close_to([1.0_wp], [1.0_wp, 2.0_wp], 0.1_wp, "other size")
   call inner%equal(1, 2, "integers")
   call inner%equal("a", "a ", "texts")
   call suite%equal(inner%passed, 0, "all false statements fail")
   call suite%equal(inner%failed, 13, "failures are counted")

   call inner%start("right claims")
   call inner%check(.true., "true")
   call inner%close_to(1.05_wp, 1.0_wp, 0.1_wp, "near")
   call inner%close_to(1.05e6_wp, 1e6_wp, 0.1_wp, "near, relative", relative=.true.)
   call inner%close_to(infinity, infinity, 0.0_wp, "infinity is itself")
   call inner%close_to(1.0_wp, 1.0_wp, 0.0_wp, "equal at tolerance zero")
   call inner%close_to([1.0_wp, 2.0_wp], [1.0_wp, 2.05_wp], 0.1_wp, "near, array")
   call inner%equal(2, 2, "integers")
   call inner%equal("a", "a", "texts")
   call inner%skip("a part", "on purpose")
   call suite%equal(inner%passed, 8, "all true statements pass")
   call suite%equal(inner%failed, 0, "no true statement fails")
   call suite%equal(inner%skipped, 1, "skips are counted")

   call suite%check(len(environment("CONTACT_SOURCE")) > 0, "ctest sets the source folder")
   call suite%equal(environment("CONTACT_NO_SUCH_VARIABLE"), "", "an unset variable is empty")
   call suite%finish()
end program harness_test
