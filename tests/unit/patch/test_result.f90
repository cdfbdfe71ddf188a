!> Totals that are not finite are seen, wherever the nonsense is
program test_result
   use, intrinsic :: ieee_arithmetic, only : ieee_positive_inf, ieee_quiet_nan, ieee_value
   use contact_base_kinds, only : wp
   use contact_patch_result, only : patch_result
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("finite totals")
   call totals(suite)
   call suite%finish()

contains

   subroutine totals(suite)
      type(test_suite), intent(inout) :: suite
      type(patch_result) :: good, bad
      real(wp) :: value(2)
      integer :: k, i

      value = [ieee_value(1.0_wp, ieee_quiet_nan), ieee_value(1.0_wp, ieee_positive_inf)]
      allocate(good%temp1(2, 2), good%temp2(2, 2), source=20.0_wp)
      call suite%check(good%has_finite_totals(), "a sound result")
      do k = 1, size(value)
         do i = 1, 9
            bad = good
            select case (i)
            case (1); bad%fn = value(k)
            case (2); bad%pen = value(k)
            case (3); bad%pmax = value(k)
            case (4); bad%fx = value(k)
            case (5); bad%fy_rel = value(k)
            case (6); bad%mz = value(k)
            case (7); bad%cksi = value(k)
            case (8); bad%elastic_energy = value(k)
            case (9); bad%temp2(2, 1) = value(k)
            end select
            call suite%check(.not. bad%has_finite_totals(), "a total that is not finite is seen")
         end do
      end do
   end subroutine totals
end program test_result
