!> From the specification of a case to its elastic model
module contact_cases_elastic_setup
   use contact_base_choices, only : kernel_model, material_model, pressure_model
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_coefficient_file, only : read_coefficients, read_whole_table
   use contact_cases_spec, only : case_spec
   use contact_elastic_material, only : combine
   use contact_elastic_model, only : elastic_model, influence_table
   use contact_grid_potential_contact, only : potential_contact
   use contact_text_lexer, only : input_lexer
   implicit none (type, external)
   private

   public :: kept_table, set_coefficients, set_inclination, set_model, update_table

   !> Thinner layers are ignored [mm]
   real(wp), parameter :: thinnest_layer = 1.0e-10_wp

   !> Influence coefficients from a file, kept from case to case
   type :: kept_table
      !> Table; unallocated if none was needed yet
      type(influence_table), allocatable :: table
      !> DX and DS [mm] and modulus [N/mm2] for which the file was read
      real(wp) :: key(3) = 0.0_wp
   end type kept_table

contains

   subroutine set_model(spec, model, error)
      type(case_spec), intent(in) :: spec
      !> Elastic model; set completely
      type(elastic_model), intent(out) :: model
      type(error_type), allocatable, intent(out) :: error

      model%kernel = spec%kernel
      if (spec%pressure == pressure_model%thin_sheet) model%sheet = spec%material%flxz
      associate (material => spec%material)
         model%material = combine(material%poiss, material%gg)
         if (spec%material_model == material_model%viscoelastic) then
            call model%set_viscoelastic(material%poiss, material%gg, material%fg, spec%rolling%veloc*material%tc, &
               & merge(-1, 1, cos(spec%rolling%chi) < 0.0_wp))
         else if (spec%material_model == material_model%interfacial_layer) then
            if (material%laythk >= thinnest_layer) model%layer = material%laythk/material%gg3
         end if
      end associate
   end subroutine set_model

   !> Conformal contact of module 3: table of inclinations, or the straight line through it
   subroutine set_inclination(spec, model, error)
      type(case_spec), intent(in) :: spec
      !> Elastic model of the patch, with material set
      type(elastic_model), intent(inout) :: model
      type(error_type), allocatable, intent(out) :: error
      integer :: n

      if (spec%kernel /= kernel_model%conformal) return
      n = 0
      if (allocated(spec%material%table_y)) n = size(spec%material%table_y)
      if (n < 2) then
         call fatal_error(error, "conformal contact (material.influence = ""conformal"") needs the surface inclination at &
            &two lateral positions or more", error_kind%input)
      else if (any(spec%material%table_y(2:) <= spec%material%table_y(:n - 1))) then
         call fatal_error(error, "the lateral positions of the surface inclinations (material.influence = &
            &""conformal"") must increase", error_kind%input)
      end if
      if (allocated(error)) return
      allocate(model%inclination)
      associate (material => spec%material, inclination => model%inclination)
         inclination%variant = material%variant
         inclination%uniform = material%if_meth == 0 .or. n == 2
         inclination%s = material%table_y
         inclination%alpha = material%table_alpha
      end associate
   end subroutine set_inclination

   !> Influence coefficients from a file, if the case uses them; the grid must be known
   subroutine set_coefficients(spec, grid, folder, model, log, error)
      type(case_spec), intent(in) :: spec
      type(potential_contact), intent(in) :: grid
      !> Folder to which the name of the file is relative; "" for the current one
      character(len=*), intent(in) :: folder
      !> Elastic model of the patch, with material and inclination set
      type(elastic_model), intent(inout) :: model
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      type(input_lexer) :: text

      if (spec%kernel /= kernel_model%tabulated) return
      call open_coefficients(spec, folder, text, error)
      if (allocated(error)) return
      allocate(model%tabulated)
      call read_coefficients(text, grid, model%material%gg, model%tabulated, log, error)
   end subroutine set_coefficients

   !> Influence coefficients for wheel on rail, if the case uses them; an unchanged file is not read again
   subroutine update_table(spec, folder, kept, log, error)
      type(case_spec), intent(in) :: spec
      !> See set_coefficients
      character(len=*), intent(in) :: folder
      !> The table of the previous case, with name and time of its file
      type(kept_table), intent(inout) :: kept
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      type(input_lexer) :: text
      type(elastic_model) :: model
      real(wp) :: key(3)

      if (spec%kernel /= kernel_model%tabulated) return
      call set_model(spec, model, error)
      if (.not. allocated(error)) call open_coefficients(spec, folder, text, error)
      if (allocated(error)) return
      key = [spec%wheel_rail%search%dx, spec%wheel_rail%search%ds, model%material%gg]
      if (allocated(kept%table)) then
         if (kept%table%fingerprint == text%fingerprint() .and. all(abs(kept%key - key) <= 0.0_wp)) return
         deallocate(kept%table)
      end if
      kept%key = key
      allocate(kept%table)
      call read_whole_table(text, key(1:2), key(3), kept%table, log, error)
      if (allocated(error)) deallocate(kept%table)
   end subroutine update_table

   !> Open the file of coefficients of a case
   subroutine open_coefficients(spec, folder, text, error)
      type(case_spec), intent(in) :: spec
      !> See set_coefficients
      character(len=*), intent(in) :: folder
      type(input_lexer), intent(inout) :: text
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: file

      file = ""
      if (allocated(spec%material%cfname)) file = trim(spec%material%cfname)
      if (len(file) == 0) then
         call fatal_error(error, "numerical influence coefficients (material.influence = ""tabulated"") need the &
            &name of a file, CFNAME", error_kind%input)
      end if
      if (allocated(error)) return
      if (file(:1) /= "/" .and. len(folder) > 0) then
         if (folder(len(folder):) /= "/") file = "/" // file
         file = folder // file
      end if
      if (spec%limits%confined) then
         call text%open_file(file, error, folder)
      else
         call text%open_file(file, error)
      end if
   end subroutine open_coefficients
end module contact_cases_elastic_setup
