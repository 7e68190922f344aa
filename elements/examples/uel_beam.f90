! A user element as Abaqus calls it: a corotational Euler-Bernoulli beam of two nodes, the equations
! of corotational.c. To be replaced by one's own; uel.c makes a formulation of it.
! PROPS: E, G, A, Iy, Iz, It. COORDS of the undeformed element lie along x, its y and z axes are
! those of the section. U: displacements and rotation vectors; moments in RHS and AMATRX belong to
! spatial increments of rotation. ENERGY(2): strain energy.
subroutine uel(rhs, amatrx, svars, energy, ndofel, nrhs, nsvars, props, nprops, coords, mcrd, &
               nnode, u, du, v, a, jtype, time, dtime, kstep, kinc, jelem, params, ndload, &
               jdltyp, adlmag, predef, npredf, lflags, mlvarx, ddlmag, mdload, pnewdt, jprops, &
               njprop, period)
  implicit none
  integer :: ndofel, nrhs, nsvars, nprops, mcrd, nnode, jtype, kstep, kinc, jelem, ndload, npredf, &
             mlvarx, mdload, njprop, jdltyp(mdload, *), lflags(*), jprops(*)
  double precision :: rhs(mlvarx, *), amatrx(ndofel, ndofel), svars(*), energy(8), props(*), &
                      coords(mcrd, nnode), u(ndofel), du(mlvarx, *), v(ndofel), a(ndofel), &
                      time(2), dtime, params(*), adlmag(mdload, *), predef(2, npredf, nnode), &
                      ddlmag(mdload, *), pnewdt, period
  double precision :: E(3, 3), S(3, 3, 2), t(6), M(6), k(6, 6), r(12), W(3, 12), P(6, 12), D(6, 12)
  double precision :: F(12), T12(12, 12), H(3, 3), dq(3, 12, 2), q(3), d0(3), moved(3), chord(3)
  double precision :: near(3), far(3), l, ln, n, torque, dmean(3, 12)
  integer :: i, j, b, o

  d0 = coords(:, 2) - coords(:, 1)
  moved = u(7:9) - u(1:3)
  chord = d0 + moved
  l = norm2(d0)
  ln = norm2(chord)
  n = props(1) * props(3) / l * dot_product(moved, d0 + chord) / (ln + l)

  ! Axes E (rows): x along the chord, y in the plane of it and the mean of the nodes' y axes.
  S(:, :, 1) = rotation(u(4:6))
  S(:, :, 2) = rotation(u(10:12))
  E(1, :) = chord / ln
  E(3, :) = matmul(spin(chord), (S(:, 2, 1) + S(:, 2, 2)) / 2)
  E(3, :) = E(3, :) / norm2(E(3, :))
  E(2, :) = matmul(spin(E(3, :)), E(1, :))
  near = [props(2) * props(6), 4 * props(1) * props(4), 4 * props(1) * props(5)] / l
  far = [-props(2) * props(6), 2 * props(1) * props(4), 2 * props(1) * props(5)] / l
  k = 0
  do i = 1, 3
    k(i, i) = near(i)
    k(i + 3, i + 3) = near(i)
    k(i, i + 3) = far(i)
    k(i + 3, i) = far(i)
  end do
  do b = 1, 2
    S(:, :, b) = matmul(E, S(:, :, b))
    t(3 * b - 2:3 * b) = [S(3, 2, b) - S(2, 3, b), S(1, 3, b) - S(3, 1, b), &
                          S(2, 1, b) - S(1, 2, b)] / 2
  end do
  M = matmul(k, t)

  ! Stretch r, turn W of the axes, turns P of the nodes in them, rates D of t.
  q = (S(:, 2, 1) + S(:, 2, 2)) / 2
  r = 0
  r(1) = -1
  r(7) = 1
  W = 0
  P = 0
  do b = 1, 2
    o = 6 * b - 6
    W(3, o + 2) = r(o + 1) / ln
    W(2, o + 3) = -r(o + 1) / ln
    W(1, o + 3) = q(1) / q(2) * W(2, o + 3)
    W(1, o + 4) = S(2, 2, b) / (2 * q(2))
    W(1, o + 5) = -S(1, 2, b) / (2 * q(2))
    P(3 * b - 2:3 * b, o + 4:o + 6) = identity()
  end do
  P(1:3, :) = P(1:3, :) - W
  P(4:6, :) = P(4:6, :) - W
  amatrx = props(1) * props(3) / l * outer(r, r)
  torque = 0
  do b = 1, 2
    i = 3 * b - 2
    j = 3 * b
    H = (trace(S(:, :, b)) * identity() - S(:, :, b)) / 2
    D(i:j, :) = matmul(H, P(i:j, :))
    torque = torque + dot_product(H(:, 1), M(i:j))
    H = -outer(M(i:j), t(i:j)) - matmul(transpose(S(:, :, b)), spin(M(i:j))) / 2
    amatrx = amatrx + matmul(transpose(P(i:j, :)), matmul(H, P(i:j, :)))
    dq(:, :, b) = -matmul(spin(S(:, 2, b)), P(i:j, :))
  end do
  F = n * r + matmul(M, D)
  amatrx = amatrx + matmul(transpose(D), matmul(k, D))

  ! The forces turn with the axes, and W changes.
  dmean = (dq(:, :, 1) + dq(:, :, 2)) / 2
  do b = 1, 2
    o = 6 * b - 6
    amatrx(o + 1:o + 3, :) = amatrx(o + 1:o + 3, :) - matmul(spin(F(o + 1:o + 3)), W)
    amatrx(o + 4:o + 6, :) = amatrx(o + 4:o + 6, :) - matmul(spin(F(o + 4:o + 6)), W)
    amatrx(o + 2:o + 3, :) = amatrx(o + 2:o + 3, :) - outer(F(o + 2:o + 3), r) / ln
    amatrx(o + 3, :) = amatrx(o + 3, :) &
                       - torque * W(2, o + 3) * (dmean(1, :) - q(1) / q(2) * dmean(2, :)) / q(2)
    amatrx(o + 4, :) = amatrx(o + 4, :) &
                       - torque * (dq(2, :, b) - S(2, 2, b) / q(2) * dmean(2, :)) / (2 * q(2))
    amatrx(o + 5, :) = amatrx(o + 5, :) &
                       + torque * (dq(1, :, b) - S(1, 2, b) / q(2) * dmean(2, :)) / (2 * q(2))
  end do
  T12 = 0
  do i = 1, 12, 3
    T12(i:i + 2, i:i + 2) = E
  end do
  amatrx = matmul(transpose(T12), matmul(amatrx, T12))
  rhs(1:12, 1) = -matmul(F, T12)
  energy(2) = (n * n * l / (props(1) * props(3)) + dot_product(t, M)) / 2

contains
  function identity() result(one)
    double precision :: one(3, 3)
    one = reshape([1d0, 0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 1d0], [3, 3])
  end function

  double precision function trace(x)
    double precision, intent(in) :: x(3, 3)
    trace = x(1, 1) + x(2, 2) + x(3, 3)
  end function

  function outer(x, y) result(xy)
    double precision, intent(in) :: x(:), y(:)
    double precision :: xy(size(x), size(y))
    xy = matmul(reshape(x, [size(x), 1]), reshape(y, [1, size(y)]))
  end function

  function spin(x) result(x_cross)
    double precision, intent(in) :: x(3)
    double precision :: x_cross(3, 3)
    x_cross = reshape([0d0, x(3), -x(2), -x(3), 0d0, x(1), x(2), -x(1), 0d0], [3, 3])
  end function

  function rotation(x) result(turn)
    double precision, intent(in) :: x(3)
    double precision :: turn(3, 3), angle, half
    angle = norm2(x)
    turn = identity() + spin(x)
    if (angle < 1d-8) return
    half = 2 * sin(angle / 2)**2 / angle**2
    turn = identity() + sin(angle) / angle * spin(x) + half * matmul(spin(x), spin(x))
  end function
end subroutine
