! The steel block with a round hole of solids_in_c.c, from Fortran: each function and struct of raylane.h that a program
! uses is declared once, with the same names.
module raylane
    use, intrinsic :: iso_c_binding
    implicit none

    integer(c_int32_t), parameter :: no_material = -1 ! RAYLANE_NO_MATERIAL: all bits are set
    integer(c_int), parameter :: exact = 2            ! RAYLANE_EXACT

    type, bind(c) :: double_vec3
        real(c_double) :: x, y, z
    end type
    type, bind(c) :: double_box
        type(double_vec3) :: corner, edge_u, edge_v, edge_w
    end type
    type, bind(c) :: double_sphere
        type(double_vec3) :: center
        real(c_double) :: radius
    end type
    type, bind(c) :: double_rays
        integer(c_size_t) :: count
        type(c_ptr) :: origin_x, origin_y, origin_z, direction_x, direction_y, direction_z
        type(c_ptr) :: t_min, t_max, origin_shape, origin_face, origin_inward, refused
    end type

    interface
        function error_text() bind(c, name="raylane_error_text")
            import
            type(c_ptr) :: error_text
        end function
        integer(c_int) function builder_create(builder) bind(c, name="raylane_builder_create")
            import
            type(c_ptr), intent(out) :: builder
        end function
        subroutine builder_release(builder) bind(c, name="raylane_builder_release")
            import
            type(c_ptr), value :: builder
        end subroutine
        integer(c_int) function solid_box(shape, material, solid) bind(c, name="raylane_solid_box")
            import
            type(double_box), intent(in) :: shape
            integer(c_int32_t), value :: material
            type(c_ptr), intent(out) :: solid
        end function
        integer(c_int) function solid_sphere(shape, material, solid) bind(c, name="raylane_solid_sphere")
            import
            type(double_sphere), intent(in) :: shape
            integer(c_int32_t), value :: material
            type(c_ptr), intent(out) :: solid
        end function
        integer(c_int) function solid_difference(whole, taken_away, count, material, solid) &
            bind(c, name="raylane_solid_difference")
            import
            type(c_ptr), value :: whole
            type(c_ptr), intent(in) :: taken_away(*)
            integer(c_size_t), value :: count
            integer(c_int32_t), value :: material
            type(c_ptr), intent(out) :: solid
        end function
        subroutine solid_release(solid) bind(c, name="raylane_solid_release")
            import
            type(c_ptr), value :: solid
        end subroutine
        integer(c_int) function add_solid(builder, solid, material, first) bind(c, name="raylane_add_solid")
            import
            type(c_ptr), value :: builder, solid
            integer(c_int32_t), value :: material
            integer(c_int32_t), intent(out) :: first
        end function
        integer(c_int) function build(builder, scene) bind(c, name="raylane_build")
            import
            type(c_ptr), value :: builder
            type(c_ptr), intent(out) :: scene
        end function
        subroutine scene_release(scene) bind(c, name="raylane_scene_release")
            import
            type(c_ptr), value :: scene
        end subroutine
        integer(c_int) function tracer_create(scene, threads, precision, tracer) bind(c, name="raylane_tracer_create")
            import
            type(c_ptr), value :: scene
            integer(c_int), value :: threads, precision
            type(c_ptr), intent(out) :: tracer
        end function
        subroutine tracer_release(tracer) bind(c, name="raylane_tracer_release")
            import
            type(c_ptr), value :: tracer
        end subroutine
        integer(c_int) function crossings_doubles(tracer, rays, most, normals, rows) &
            bind(c, name="raylane_crossings_doubles")
            import
            type(c_ptr), value :: tracer
            type(double_rays), intent(in) :: rays
            integer(c_size_t), value :: most
            integer(c_int), value :: normals
            type(c_ptr), intent(out) :: rows
        end function
        integer(c_int) function path_lengths_doubles(tracer, rays, rows) bind(c, name="raylane_path_lengths_doubles")
            import
            type(c_ptr), value :: tracer
            type(double_rays), intent(in) :: rays
            type(c_ptr), intent(out) :: rows
        end function
        integer(c_int) function solid_lengths_doubles(tracer, rays, rows) bind(c, name="raylane_solid_lengths_doubles")
            import
            type(c_ptr), value :: tracer
            type(double_rays), intent(in) :: rays
            type(c_ptr), intent(out) :: rows
        end function
        function rows_first(rows) bind(c, name="raylane_rows_first")
            import
            type(c_ptr), value :: rows
            type(c_ptr) :: rows_first
        end function
        function rows_t(rows) bind(c, name="raylane_rows_t")
            import
            type(c_ptr), value :: rows
            type(c_ptr) :: rows_t
        end function
        function rows_shape_id(rows) bind(c, name="raylane_rows_shape_id")
            import
            type(c_ptr), value :: rows
            type(c_ptr) :: rows_shape_id
        end function
        function rows_length(rows) bind(c, name="raylane_rows_length")
            import
            type(c_ptr), value :: rows
            type(c_ptr) :: rows_length
        end function
        subroutine rows_release(rows) bind(c, name="raylane_rows_release")
            import
            type(c_ptr), value :: rows
        end subroutine
    end interface

contains

    ! Prints the message of a call that failed, and ends the program.
    subroutine check(status)
        integer(c_int), intent(in) :: status
        character(kind=c_char), pointer :: text(:)
        integer :: i
        if (status == 0) return
        call c_f_pointer(error_text(), text, [1000])
        do i = 1, size(text)
            if (text(i) == c_null_char) exit
            write (*, "(a)", advance="no") text(i)
        end do
        print *
        error stop 1
    end subroutine
end module

program solids_in_fortran
    use raylane
    implicit none

    integer, parameter :: count = 3
    real(c_double), target :: x(count) = -20, y(count) = [0, 3, 11], zero(count) = 0, dx(count) = 1
    type(c_ptr) :: scene, tracer, rows
    type(double_rays) :: rays
    integer(c_int64_t), pointer :: first(:)
    integer(c_int32_t), pointer :: solid(:)
    real(c_double), pointer :: t(:), length(:)
    integer :: ray
    logical :: good

    scene = block_with_hole()
    call check(tracer_create(scene, 0_c_int, exact, tracer))
    call scene_release(scene) ! the tracer keeps it alive
    rays = double_rays(int(count, c_size_t), c_loc(x), c_loc(y), c_loc(zero), c_loc(dx), c_loc(zero), c_loc(zero), &
                       c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr)

    call check(crossings_doubles(tracer, rays, 0_c_size_t, 0_c_int, rows))
    call c_f_pointer(rows_first(rows), first, [count + 1])
    call c_f_pointer(rows_t(rows), t, [first(count + 1)])
    do ray = 1, count ! row offsets count from 0
        print "(a, i0, a, 4f6.1)", "ray ", ray, " crosses at", t(first(ray) + 1:first(ray + 1))
    end do
    good = all(first == [0, 4, 8, 8])
    good = good .and. all(t == [10, 15, 25, 30, 10, 16, 24, 30])
    call rows_release(rows)

    call check(path_lengths_doubles(tracer, rays, rows))
    call c_f_pointer(rows_first(rows), first, [count + 1])
    call c_f_pointer(rows_length(rows), length, [first(count + 1)])
    print "(a, 2f6.1)", "lengths inside of steel", length
    good = good .and. size(length) == 2
    good = good .and. all(length == [10, 12])
    call rows_release(rows)

    call check(solid_lengths_doubles(tracer, rays, rows)) ! the same, as there is one solid
    call c_f_pointer(rows_first(rows), first, [count + 1])
    call c_f_pointer(rows_shape_id(rows), solid, [first(count + 1)])
    call c_f_pointer(rows_length(rows), length, [first(count + 1)])
    good = good .and. size(length) == 2
    good = good .and. all(solid == 0) .and. all(length == [10, 12])
    call rows_release(rows)
    call tracer_release(tracer)
    if (.not. good) error stop 1

contains

    function block_with_hole() result(scene)
        type(c_ptr) :: scene, builder, whole, hole, solid
        integer(c_int32_t) :: first_id
        call check(builder_create(builder))
        call check(solid_box(double_box(double_vec3(-10, -10, -10), double_vec3(20, 0, 0), double_vec3(0, 20, 0), &
                                        double_vec3(0, 0, 20)), no_material, whole))
        call check(solid_sphere(double_sphere(double_vec3(0, 0, 0), 5), no_material, hole))
        call check(solid_difference(whole, [hole], 1_c_size_t, no_material, solid))
        call check(add_solid(builder, solid, no_material, first_id)) ! the default material
        call solid_release(solid)
        call solid_release(hole)
        call solid_release(whole)
        call check(build(builder, scene))
        call builder_release(builder)
    end function
end program
