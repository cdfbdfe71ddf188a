!> The program: one call, and the only statement that ends the process
program contact
   use contact_cli_arguments, only : run_command_line
   use contact_cli_process, only : fill_streams
   implicit none (type, external)

   call fill_streams()
   stop run_command_line(), quiet=.true.
end program contact
