!> The program: one call, and the only place that ends the process
program contact
   use contact_cli_arguments, only : run_command_line
   implicit none (type, external)

   stop run_command_line(), quiet=.true.
end program contact
