"""Buckling and vibration of a simply supported thin-walled beam. Each half-wave k = n pi/l is a 6 x 6 problem.

The unknowns are the amplitudes V, W, P of v_s, w_s, phi (sin kx) and those of the shear strains g_y, g_z, g_w (cos kx).
With D = F^-1 (section.py), the quadratic forms are
  strain    EIz k^2 (kV - g_y)^2 + EIy k^2 (kW - g_z)^2 + EIw k^2 (kP - g_w)^2 + G It (kP)^2 + G g^T D g
  prestress (v_c'^2 + w_c'^2 + Ip/A phi'^2) - c [(g_y^2 + g_z^2) + 2 (zs g_y - ys g_z) phi'],  v_c = v_s + zs phi, w_c
  = w_s - ys phi
  kinetic   rho [A (v_c^2 + w_c^2) + Ip phi^2 + Iz (v_s' - g_y)^2 + Iy (w_s' - g_z)^2 + Iw (phi' - g_w)^2]
c = 0 gives Engesser's shear theory in stability, and c = 1 gives Haringx's theory (Simo-Reissner). n = 0 is a uniform
rotation of the sections that only shear restrains. For a uniform end moment, the closed form of the monosymmetric beam
with shear deformation is used (reference/ERRATA.md).
"""
from mpmath import mp, mpf, matrix, pi, sqrt, cholesky, inverse, eigsy

from reference.derive import defaults
from reference.derive.section import channel, section

mp.dps = 40
PRINTED = {
    "Iw": "1.3886e-4", "ys": "0.4571", "Dy": "0.0279", "Dz": "0.0158", "Dzw": "-3.70e-3",
    "Dw": "3.65e-3"
}


def channel_data(**given):
    """Returns the Section of c_column. `given` contains the parameters that differ from the defaults."""
    at = defaults.decimals("c_column", given)
    s = channel(at["height"], at["width"], at["flange_thickness"], at["web_thickness"])
    s.E, s.G, s.RHO = at["young"], at["shear_modulus"], at["density"]
    if at["section_data"] == "printed":
        s.Iw, s.ys = mpf(PRINTED["Iw"]), mpf(PRINTED["ys"])
        d = matrix(3, 3)
        d[0, 0], d[1, 1], d[2, 2] = mpf(PRINTED["Dy"]), mpf(PRINTED["Dz"]), mpf(PRINTED["Dw"])
        d[1, 2] = d[2, 1] = mpf(PRINTED["Dzw"])
        s.F = inverse(d)
    return s


def _square(m, factor, row):
    for i, a in enumerate(row):
        for j, b in enumerate(row):
            m[i, j] += factor * a * b


def _strain(s, k, shear):
    n = 6 if shear else 3
    m = matrix(n, n)
    for i, inertia in enumerate((s.Iz, s.Iy, s.Iw)):
        row = [mpf(0)] * n
        row[i] = k
        if shear:
            row[3 + i] = mpf(-1)
        _square(m, s.E * inertia * k ** 2, row)
    m[2, 2] += s.G * s.It * k ** 2
    if shear:
        d = inverse(s.F)
        for i in range(3):
            for j in range(3):
                m[3 + i, 3 + j] += s.G * d[i, j]
    return m


def _prestress(s, k, shear, c):
    n = 6 if shear else 3
    m = matrix(n, n)
    pad = [mpf(0)] * (n - 3)
    _square(m, mpf(1), [k, mpf(0), s.zs * k] + pad)
    _square(m, mpf(1), [mpf(0), k, -s.ys * k] + pad)
    m[2, 2] += s.Ip / s.A * k ** 2
    if shear and c:
        m[3, 3] -= c
        m[4, 4] -= c
        m[2, 3] -= c * s.zs * k
        m[3, 2] -= c * s.zs * k
        m[2, 4] += c * s.ys * k
        m[4, 2] += c * s.ys * k
    return m


def _kinetic(s, k, shear, rotary):
    n = 6 if shear else 3
    m = matrix(n, n)
    pad = [mpf(0)] * (n - 3)
    _square(m, s.RHO * s.A, [mpf(1), mpf(0), s.zs] + pad)
    _square(m, s.RHO * s.A, [mpf(0), mpf(1), -s.ys] + pad)
    m[2, 2] += s.RHO * s.Ip
    for i, inertia in enumerate((s.Iz, s.Iy, s.Iw)):
        row = [mpf(0)] * n
        row[i] = k
        if shear:
            row[3 + i] = mpf(-1)
        if rotary:
            _square(m, s.RHO * inertia, row)
    return m


def _ratios(a, b):
    l = inverse(cholesky(a))
    c = l * b * l.T
    return [v for v in eigsy((c + c.T) / 2, eigvals_only=True)]


def buckling_load(s, length, shear, haringx):
    best = None
    for n in range(1, 6):
        k = n * pi / length
        load = 1 / max(_ratios(_strain(s, k, shear), _prestress(s, k, shear, int(haringx))))
        best = load if best is None or load < best else best
    return best


def frequencies(s, length, shear, rotary, count, load=0, haringx=False, prestress=_prestress):
    """Returns the lowest frequencies under the axial compression `load`. The deformation due to this load is neglected."""
    found = []
    if shear and rotary:  # n = 0: sections rotate and warp in pure shear
        inertia = [s.RHO * i for i in (s.Iz, s.Iy, s.Iw)]
        mass = matrix(3, 3)
        for i in range(3):
            mass[i, i] = inertia[i]
        found += [1 / sqrt(nu) / (2 * pi) for nu in _ratios(s.G * inverse(s.F), mass)]
    for n in range(1, 30):
        k = n * pi / length
        for nu in _ratios(
                _strain(s, k, shear) - load * prestress(s, k, shear, int(haringx)),
                _kinetic(s, k, shear, rotary)):
            if nu > mpf(10) ** -30:
                found.append(1 / sqrt(nu) / (2 * pi))
    return sorted(found)[:count]


def buckling_moments(s, length, shear, haringx, wagner):
    """Returns the critical moments, which are the solutions of W (1 - (1-c) F_zw M/G)^2 + G It - M (b_z - 2 ys) = M^2
    [1/(EIy k^2) + (1-c) F_zz/G] for n = 1, where W = EIw k^2/(1 + F_ww EIw k^2/G)."""
    k = pi / length
    c = 1 if haringx or not shear else 0
    fww = s.F[2, 2] if shear else mpf(0)
    w = s.E * s.Iw * k ** 2 / (1 + fww * s.E * s.Iw * k ** 2 / s.G)
    bz = s.wagner_y / s.Iz if wagner else mpf(0)
    alpha = (1 - c) * s.F[1, 2] / s.G
    p2 = 1 / (s.E * s.Iy * k ** 2) + (1 - c) * s.F[1, 1] / s.G - w * alpha ** 2
    p1 = 2 * w * alpha + bz - 2 * s.ys
    p0 = -(w + s.G * s.It)
    root = sqrt(p1 ** 2 - 4 * p2 * p0)
    return (-p1 - root) / (2 * p2), (-p1 + root) / (2 * p2)


def _text(**given):
    return ";".join(f"{name}={value}" for name, value in given.items())


def length_of(case, given):
    return defaults.decimals(case, given)["length"]


def other_sizes():
    for given in ({"length": 4, "height": "0.9", "width": "0.3"}, {"web_thickness": "0.01"}):
        s, l = channel_data(**given), length_of("c_column", given)
        yield "c_column", _text(**given), "buckling_load", buckling_load(s, l, True, False), "N"
        yield "c_column", _text(**given, shear=0), "buckling_load", buckling_load(
            s, l, False, False), "N"
        for i, value in enumerate(frequencies(s, l, True, True, 4)):
            yield "c_column", _text(**given), f"frequency_{i + 1}", value, "Hz"
        for shear in (0, 1):
            low, high = buckling_moments(s, l, shear, False, True)
            at = _text(**given, **({"shear": 1} if shear else {}))
            yield "moment_buckling", at, "buckling_moment_negative", low, "N m"
            yield "moment_buckling", at, "buckling_moment_positive", high, "N m"


def branched():
    mm = mpf(10) ** -3
    points = [(0, 0), (50, 0), (50, 80), (20, 80), (50, 100)]
    s = section([(y * mm, z * mm) for y, z in points], [(0, 1, 2 * mm), (1, 2, 3 * mm),
                                                        (2, 3, 4 * mm), (2, 4, mm)])
    at = defaults.decimals("unsymmetric_column", {})
    s.E, s.G, s.RHO = at["young"], at["shear_modulus"], at["density"]
    return s


def loaded(s, at):
    """Yields (quantity, value, unit) of a column under an axial load. `at` contains the values of all parameters."""
    l, shear, haringx = at["length"], at["shear"], at["shear_stability"] == "haringx"
    yield "buckling_load", buckling_load(s, l, shear, haringx), "N"
    for i, value in enumerate(
            frequencies(s, l, shear, at["rotary_inertia"], 6, at["axial_load"], haringx)):
        yield f"frequency_{i + 1}", value, "Hz"


def unsymmetric():
    s = branched()
    for given in ({}, {"axial_load": 0}, {"length": mpf("0.6"), "axial_load": 100000}, {
            "length": mpf("0.6"), "shear_stability": "haringx", "axial_load": 100000
    }, {"shear": 0, "rotary_inertia": 0, "axial_load": 0}, {"length": 1, "axial_load": -50000}):
        at = ";".join(
            f"{k}={v if isinstance(v, (int, str)) else float(v)}" for k, v in given.items())
        for row in loaded(s, defaults.decimals("unsymmetric_column", given)):
            yield "unsymmetric_column", at, *row


def rows():
    yield from other_sizes()
    yield from unsymmetric()
    for length in (None, 3, 12):
        at = {} if length is None else {"length": length}
        l = length_of("c_column", at)
        plain, printed = channel_data(), channel_data(section_data="printed")
        yield "c_column", _text(**at), "buckling_load", buckling_load(plain, l, True, False), "N"
        yield "c_column", _text(**at, shear_stability="haringx"), "buckling_load", buckling_load(
            plain, l, True, True), "N"
        yield "c_column", _text(**at, shear=0), "buckling_load", buckling_load(
            plain, l, False, False), "N"
        for i, value in enumerate(frequencies(plain, l, True, True, 13)):
            yield "c_column", _text(**at), f"frequency_{i + 1}", value, "Hz"
        if length is None:
            yield "c_column", "section_data=printed", "buckling_load", buckling_load(
                printed, l, True, False), "N"
            yield "c_column", "section_data=printed;shear=0", "buckling_load", buckling_load(
                printed, l, False, False), "N"
            for i, value in enumerate(frequencies(printed, l, True, True, 13)):
                yield "c_column", "section_data=printed", f"frequency_{i + 1}", value, "Hz"
            for i, value in enumerate(frequencies(plain, l, False, False, 13)):
                yield "c_column", "shear=0;rotary_inertia=0", f"frequency_{i + 1}", value, "Hz"
            yield "c_column", "shear=0;rotary_inertia=0", "buckling_load", buckling_load(
                plain, l, False, False), "N"
        for shear, haringx, wagner in ((0, 0, 1), (0, 0, 0), (1, 0, 1), (1, 0, 0), (1, 1, 1), (1, 1,
                                                                                               0)):
            if length is not None and not wagner:
                continue
            given = dict(at)
            if shear:
                given["shear"] = 1
            if haringx:
                given["shear_stability"] = "haringx"
            if not wagner:
                given["wagner_moments"] = 0
            low, high = buckling_moments(plain, l, shear, haringx, wagner)
            yield "moment_buckling", _text(**given), "buckling_moment_negative", low, "N m"
            yield "moment_buckling", _text(**given), "buckling_moment_positive", high, "N m"
