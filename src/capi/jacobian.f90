!> Entry that returns derivatives of wheel and rail
module contact_capi_jacobian
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_ptr
   use contact_base_kinds, only : wp
   use contact_capi_arguments, only : integer_of, set_argument, set_message
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : report_error
   use contact_capi_problem, only : library_problem
   use contact_capi_registry, only : enter, leave, scope
   use contact_control_units, only : inward, orientation, outward, quantity, quantity_type
   use contact_wheelrail_jacobian, only : differentiate_wheel_rail, jacobian_input, jacobian_row, jacobian_state, &
      & wheel_rail_jacobian
   implicit none (type, external)
   private

   public :: contact_wheel_rail_jacobian

   !> Nothing has been calculated
   integer, parameter :: not_calculated = -1

contains

   !> Derivatives of the last calculation, row by row, in the units and with the signs of the caller
   subroutine contact_wheel_rail_jacobian(ire, room, values, state, message, message_length) &
      & bind(c, name="inside_contact_wheel_rail_jacobian")
      !> Result element, and size of `values`
      integer(c_int), intent(in), optional :: ire, room
      !> All columns of the first row, then of the next one; truncated to the size of `values`
      real(c_double), intent(inout), optional :: values(*)
      !> Member of jacobian_state, or not_calculated
      integer(c_int), intent(inout), optional :: state
      !> Buffer for the reason, null if not requested
      type(c_ptr), value :: message
      !> Size of the buffer, including the terminating null [bytes]
      integer(c_int), intent(in), optional :: message_length
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(wheel_rail_jacobian) :: jacobian
      character(len=:), allocatable :: reason
      integer :: found, i, k, n

      found = not_calculated
      this = entry_type("contact_wheel_rail_jacobian", integer_of(ire))
      call enter(this, scope%wheel_rail, problem)
      reason = "there is no such problem of wheel and rail"
      if (associated(problem)) then
         reason = "nothing has been calculated yet"
         if (problem%has_result .and. problem%was_calculated) then
            found = jacobian_state%none
            reason = "the calculation did not end with a solution"
            if (problem%status%is_solved()) then
               call differentiate_wheel_rail(problem%wheel_rail%problem, problem%wheel_rail%memory, problem%wheel_rail_result, &
                  & jacobian)
               found = jacobian%state
               reason = jacobian%reason
            end if
         end if
         if (found == jacobian_state%none) call report_error(this, "no derivatives: " // reason)
         if (any(found == [jacobian_state%exact, jacobian_state%one_sided]) .and. present(values)) then
            call convert(problem, jacobian%values)
            n = min(max(0, integer_of(room)), size(jacobian%values))
            do k = 1, n
               i = (k - 1)/jacobian_input%count + 1
               values(k) = real(jacobian%values(i, k - (i - 1)*jacobian_input%count), c_double)
            end do
         end if
         call leave(problem)
      end if
      call set_argument(found, state)
      if (present(message_length)) call set_message(reason, message, message_length)
   end subroutine contact_wheel_rail_jacobian

   !> Convert from internal units and a wheel on the right side of the track to units and side of the caller
   subroutine convert(problem, values)
      type(library_problem), intent(in) :: problem
      real(wp), intent(inout) :: values(:, :)
      type(quantity_type) :: of_row(jacobian_row%count), of_column(jacobian_input%count)
      integer :: sign(jacobian_row%count)
      integer :: k

      of_row = quantity%moment
      of_row([1, 2, 3, 7, 8, 9]) = quantity%force
      of_row(jacobian_row%z) = quantity%length
      sign = orientation%along
      sign([2, 4, 6, 8, 10, 12]) = orientation%across
      sign(jacobian_row%z) = orientation%none
      of_column = quantity%angle
      of_column([jacobian_input%y, jacobian_input%z]) = quantity%length
      of_column([jacobian_input%vs, jacobian_input%vy]) = quantity%velocity
      ! on a roller the first velocity is the pitch rate of the roller
      if (problem%bodies%roller) of_column(jacobian_input%vs) = quantity%angle
      of_column(jacobian_input%fz) = quantity%force
      do k = 1, jacobian_input%count
         values(:, k) = values(:, k)*inward(problem%units, of_column(k)) &
            & *outward(problem%units, of_row, sign, problem%bodies%left)
      end do
   end subroutine convert
end module contact_capi_jacobian
