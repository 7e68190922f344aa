! The beam of timoshenko.c in Fortran: two nodes, one point, strains uniform along the element [m],
!   d = Rm^T (rq - rp) - (l, 0, 0), Rm half way from Rp to Rq, and l log(Rp^T Rq).
! Their derivatives are computed by differences. The module beamwork is elements/element.h in
! Fortran, to be used without changes; the module beam is the example, to be replaced.
!   gfortran -O2 -shared -fPIC timoshenko.f90 -o timoshenko_f90.so
!   beamwork converge tapered_cantilever --element ./timoshenko_f90.so -f all
module beamwork
  use, intrinsic :: iso_c_binding
  implicit none

  enum, bind(c) ! results of functions
    enumerator :: status_ok, status_not_converged, status_singular, status_refused
  end enum
  enum, bind(c) ! physics: offers, features
    enumerator :: feature_warping = 1, feature_shear = 2, feature_eccentric = 4, &
                  feature_trapeze = 8, feature_wagner_moments = 16, feature_wagner_torque = 32, &
                  feature_geometric = 256, feature_large = 512, feature_mass = 1024, &
                  feature_rotary_inertia = 2048, feature_curvature = 4096, feature_coupled = 8192
  end enum
  enum, bind(c) ! restrictions: limits
    enumerator :: limit_doubly_symmetric = 1, limit_order_dependent = 2, limit_quarter_turn = 4, &
                  limit_warping_rigid = 8, limit_flat_arc = 16, limit_half_turn = 32, &
                  limit_tension = 64, limit_eighth_twist = 128, limit_not_objective = 256, &
                  limit_path_dependent = 512
  end enum
  enum, bind(c) ! what is computed by differences: leaves
    enumerator :: leaves_J = 1, leaves_H = 2, leaves_force = 4, leaves_tangent = 8
  end enum
  enum, bind(c) ! theories of shear in stability: shear_theories
    enumerator :: shear_engesser = 1, shear_haringx = 2, shear_own = 4
  end enum

  ! Matrices lie by rows, as in C: an entry i, j of C is (j, i) here.
  type, bind(c) :: section
    real(c_double) :: young, shear_modulus, density, A, Iy, Iz, It, Iw, ys, zs, Ip, wagner_y, &
                      wagner_z, wagner_torque, D(3, 3), F(3, 3), axes_angle, centroid(2)
    integer(c_int) :: matrices
    real(c_double) :: stiffness(6, 6), mass(6, 6), asymmetry
    integer(c_int) :: rectangle
    real(c_double) :: width, height, expansion
  end type

  type, bind(c) :: element_request
    type(c_ptr) :: section ! type(section)
    real(c_double) :: length
    integer(c_int) :: features
    type(c_ptr) :: options, type
    real(c_double) :: curvature(3), strain(3)
  end type

  type, bind(c) :: node_state
    real(c_double) :: r(3), u(3), R_(3, 3), a, scalar(6) ! R_(j, i) = R_ij: R_(j, :) is axis j
  end type

  type, bind(c) :: strain_output ! null: not needed
    type(c_ptr) :: e, J, s, H, history
  end type

  type, bind(c) :: stress_output
    type(c_ptr) :: energy, sigma, C, residual, memory, history, state
  end type

  type, bind(c) :: force_output
    type(c_ptr) :: energy, F, K, history
  end type

  type, bind(c) :: element_rotating_frame
    real(c_double) :: omega(3), centre(3)
  end type

  type, bind(c) :: inertia_output
    type(c_ptr) :: M, potential, force, N, G, rate, acceleration, taken, C, K
  end type

  type, bind(c) :: line_output
    real(c_double) :: at, force(3), moment(3), r(3), R_(3, 3)
    type(c_ptr) :: P, T, H
  end type

  type, bind(c) :: element_type ! members that are not set: not given
    integer(c_int) :: abi = 4
    integer(c_size_t) :: size = 0 ! c_sizeof(the variable)
    type(c_ptr) :: name = c_null_ptr, summary = c_null_ptr, source = c_null_ptr, &
                   family = c_null_ptr
    integer(c_int) :: offers = 0
    type(c_funptr) :: data_size = c_null_funptr, prepare = c_null_funptr, strain = c_null_funptr, &
                      stress = c_null_funptr, force = c_null_funptr
    integer(c_int) :: leaves = 0, limits = 0, lacks = 0
    type(c_ptr) :: lacks_by = c_null_ptr
    integer(c_int) :: shear_theories = 0
    type(c_ptr) :: own_theory = c_null_ptr
    type(c_funptr) :: order = c_null_funptr
    type(c_ptr) :: options(5) = c_null_ptr, judged = c_null_ptr
    type(c_funptr) :: nodes = c_null_funptr, strains = c_null_funptr, inner = c_null_funptr, &
                      memory = c_null_funptr, update = c_null_funptr, rest = c_null_funptr, &
                      geometric = c_null_funptr, inertia = c_null_funptr, &
                      strain_many = c_null_funptr, stress_many = c_null_funptr, &
                      force_many = c_null_funptr
    type(c_ptr) :: constants = c_null_ptr
    type(c_funptr) :: trouble = c_null_funptr
    integer(c_int) :: lanes = 0
    type(c_funptr) :: equations_many = c_null_funptr
    integer(c_int) :: spreads = 0
    type(c_funptr) :: tension = c_null_funptr
    type(c_ptr) :: misprint = c_null_ptr
    type(c_funptr) :: along = c_null_funptr, mass_of_field = c_null_funptr, &
                      unstressed = c_null_funptr, history = c_null_funptr, &
                      begin = c_null_funptr, commit = c_null_funptr, &
                      places = c_null_funptr, damping = c_null_funptr, line = c_null_funptr, &
                      scalars = c_null_funptr
    integer(c_int) :: held = 0
  end type
end module

module beam
  use beamwork
  implicit none
  private

  integer, parameter :: m = 6 ! strains

  type, bind(c) :: element_data
    real(c_double) :: length, stiffness(m) ! [m], [N/m]
  end type

  character(len=80), target, save :: name = "timoshenko_f90"//c_null_char, &
    summary = "two nodes, one integration point, flexible in shear, no warping, in Fortran"//c_null_char, &
    source = "Reissner, J. Appl. Math. Phys. 32 (1981), one point of integration"//c_null_char, &
    family = "example"//c_null_char
  type(element_type), target, save :: this

contains

  ! The function that beamwork calls after it has loaded the file.
  function beamwork_element_type() bind(c) result(formulation)
    type(c_ptr) :: formulation
    this%size = c_sizeof(this)
    this%name = c_loc(name)
    this%summary = c_loc(summary)
    this%source = c_loc(source)
    this%family = c_loc(family)
    this%offers = ior(ior(feature_shear, feature_geometric), &
                      ior(feature_large, ior(feature_mass, feature_rotary_inertia)))
    this%shear_theories = shear_haringx
    this%limits = ior(limit_doubly_symmetric, limit_half_turn)
    this%leaves = leaves_J
    this%data_size = c_funloc(data_size)
    this%prepare = c_funloc(prepare)
    this%strains = c_funloc(strains)
    this%strain = c_funloc(strain)
    this%stress = c_funloc(stress)
    formulation = c_loc(this)
  end function

  function data_size(request) bind(c, name="") result(bytes)
    type(element_request), intent(in) :: request
    integer(c_size_t) :: bytes
    type(element_data) :: one
    bytes = c_sizeof(one)
  end function

  function strains(options) bind(c, name="") result(count)
    real(c_double), intent(in) :: options(*)
    integer(c_int) :: count
    count = m
  end function

  function prepare(request, data, fault) bind(c, name="") result(outcome)
    type(element_request), intent(in) :: request
    type(element_data), intent(out) :: data
    character(kind=c_char), intent(inout) :: fault(*) ! refused: a line, ended by c_null_char
    integer(c_int) :: outcome
    type(section), pointer :: c
    real(c_double) :: l, shear
    call c_f_pointer(request%section, c)
    l = request%length
    shear = 0
    if (iand(request%features, feature_shear) /= 0) shear = l / c%shear_modulus
    data%length = l
    ! Transverse: shear if requested, and the bending that a uniform curvature lacks.
    data%stiffness(1) = c%young * c%A / l
    data%stiffness(2) = 1 / (shear * c%F(1, 1) + l**3 / (12 * c%young * c%Iz))
    data%stiffness(3) = 1 / (shear * c%F(2, 2) + l**3 / (12 * c%young * c%Iy))
    data%stiffness(4:6) = [c%shear_modulus * c%It, c%young * c%Iy, c%young * c%Iz] / l**3
    outcome = status_ok
  end function

  subroutine strain(data, x, out) bind(c, name="")
    type(element_data), intent(in) :: data
    type(node_state), intent(in) :: x(2)
    type(strain_output), intent(in) :: out
    real(c_double), pointer :: e(:)
    real(c_double) :: chord(3), psi(3), p(3), q(3), square, c, k
    if (.not. c_associated(out%e)) return
    call c_f_pointer(out%e, e, [m])
    chord = x(2)%r - x(1)%r
    psi = between(x(1)%R_, x(2)%R_)
    p = matmul(x(1)%R_, chord) ! the chord in the axes of both nodes
    q = matmul(x(2)%R_, chord)
    ! Normal to psi their mean is that of the middle times c; along psi all are equal.
    square = dot_product(psi, psi)
    c = cos(sqrt(square) / 2)
    k = 0
    if (square > 0) k = (1 - 1 / c) / square
    e(1:3) = (p + q) / (2 * c) + k * dot_product(psi, p) * psi
    e(4:6) = data%length * psi
    e(1) = e(1) - data%length
  end subroutine

  ! The rotation vector that takes R to S, in the axes of R; shorter than pi. Both transposed.
  function between(R, S) result(psi)
    real(c_double), intent(in) :: R(3, 3), S(3, 3)
    real(c_double) :: psi(3), T(3, 3), sine
    T = matmul(R, transpose(S))
    psi = [T(3, 2) - T(2, 3), T(1, 3) - T(3, 1), T(2, 1) - T(1, 2)] / 2
    sine = norm2(psi)
    if (sine > 0) psi = psi * (atan2(sine, (T(1, 1) + T(2, 2) + T(3, 3) - 1) / 2) / sine)
  end function

  function stress(data, e, inner, out) bind(c, name="") result(outcome)
    type(element_data), intent(in) :: data
    real(c_double), intent(in) :: e(m)
    type(c_ptr), value :: inner ! none
    type(stress_output), intent(in) :: out
    integer(c_int) :: outcome
    real(c_double), pointer :: energy, sigma(:), C(:, :), residual
    integer :: i
    if (c_associated(out%energy)) then
      call c_f_pointer(out%energy, energy)
      energy = dot_product(data%stiffness * e, e) / 2
    end if
    if (c_associated(out%sigma)) then
      call c_f_pointer(out%sigma, sigma, [m])
      sigma = data%stiffness * e
    end if
    if (c_associated(out%C)) then
      call c_f_pointer(out%C, C, [m, m])
      C = 0
      do i = 1, m
        C(i, i) = data%stiffness(i)
      end do
    end if
    if (c_associated(out%residual)) then
      call c_f_pointer(out%residual, residual)
      residual = 0
    end if
    outcome = status_ok
  end function
end module
