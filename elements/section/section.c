#include "elements/section/section.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"
#include "elements/section/walls.h"

void section_spec_init(section_spec *spec)
{
    memset(spec, 0, sizeof *spec);
#define SECTION_UNKNOWN(name) spec->given.name = NAN;
    SECTION_GIVEN(SECTION_UNKNOWN)
#undef SECTION_UNKNOWN
}

static section_spec spec_of(section_kind kind, double young, double shear_modulus)
{
    section_spec spec;
    section_spec_init(&spec);
    spec.kind = kind;
    spec.young = young;
    spec.shear_modulus = shear_modulus;
    return spec;
}

section_spec section_spec_rectangle(double young, double shear_modulus, double width, double height)
{
    section_spec spec = spec_of(SECTION_RECTANGLE, young, shear_modulus);
    spec.width = width;
    spec.height = height;
    return spec;
}

section_spec section_spec_constants(double young, double shear_modulus)
{
    return spec_of(SECTION_CONSTANTS, young, shear_modulus);
}

section_spec section_spec_walls(double young, double shear_modulus, int walls,
                                const double point[][2], const int ends[][2],
                                const double thickness[])
{
    section_spec spec = spec_of(SECTION_WALLS, young, shear_modulus);
    spec.points = walls + 1;
    spec.walls = walls;
    memcpy(spec.point, point, (size_t)spec.points * sizeof spec.point[0]);
    for (int i = 0; i < walls; i++) {
        spec.wall[i].from = ends != NULL ? ends[i][0] : i;
        spec.wall[i].to = ends != NULL ? ends[i][1] : i + 1;
        spec.wall[i].thickness = thickness[i];
    }
    return spec;
}

/* Returns the Saint-Venant constant of a rectangle a x b [m^4], by a series with a relative error
 * below 1e-15 for every ratio. */
static double rectangle_torsion(double a, double b)
{
    const double h = fmax(a, b), t = fmin(a, b);
    /* J = h t^3/3 [1 - 192/pi^5 t/h sum over odd n of tanh(n pi h/2t)/n^5]. The sum of n^-5 is
     * 31/32 zeta(5). From n = 13 on, tanh - 1 = -2/(exp(n pi h/t) + 1) is negligible, because h >=
     * t. */
    const double zeta5 = 1.03692775514336993;
    double sum = 0;
    for (int n = 11; n >= 1; n -= 2)
        sum -= 2 / (exp(n * PI * h / t) + 1) / pow(n, 5);
    sum += 31 * zeta5 / 32;
    return h * t * t * t / 3 * (1 - 192 / pow(PI, 5) * t / h * sum);
}

/* Returns int omega^2 dA [m^6] for Saint-Venant's warping function omega = y z + sum C_n sin(k_n y)
 * sinh(k_n z) with k_n = (2 n + 1) pi/2a, over the half sides a <= b (integrated here). C_n = -4
 * (-1)^n/(a k_n^3 cosh(k_n b)) makes the sides stress-free. For a thin rectangle, the result is (w
 * h)^3/144. For a square, it is 1/52 of this value, and the sum of the three terms loses two
 * digits. */
static double rectangle_warping(double w, double h)
{
    const double a = fmin(w, h) / 2, b = fmax(w, h) / 2;
    /* sum 1/(k_n a)^6 = 1/15; the sum of 3/(k_n a)^7 is 3 (2/pi)^7 127/128 zeta(7) */
    const double zeta7 = 1.00834927738192284;
    double sum = 3 * pow(2 / PI, 7) * 127 / 128 * zeta7;
    for (int n = 0; n < 7; n++) {
        const double ka = (2 * n + 1) * PI / 2, x = ka * (b / a), e = exp(-2 * x);
        sum -= (6 * e / (1 + e) + x * 4 * e / (1 + e) / (1 + e)) / pow(ka, 7);
    }
    return a * a * a * (4 * b * b * b / 9 - 32 * a * a * b / 15 + 16 * a * a * a * sum);
}

static status rectangle(const section_spec *s, section *out, fault *f)
{
    const double w = s->width, h = s->height;
    if (!(w > 0) || !isfinite(w))
        return fault_set(f, STATUS_REFUSED,
                         "section: the width of the rectangle is %g m; give a positive width", w);
    if (!(h > 0) || !isfinite(h))
        return fault_set(
            f, STATUS_REFUSED,
            "section: the thickness of the rectangle is %g m; give a positive thickness", h);
    const double wide = fmax(w, h), thin = fmin(w, h);
    out->A = w * h;
    out->Iy = h * w * w * w / 12;
    out->Iz = w * h * h * h / 12;
    out->Ip = out->Iy + out->Iz;
    out->It = rectangle_torsion(w, h);
    out->Iw = rectangle_warping(w, h);
    /* 1/8 (int r^4 dA - Ip^2/A), where int r^4 dA = wide^5 thin/80 + 2 wide^3 thin^3/144 + wide
     * thin^5/80 (integrated here). N Eq. 46 has only the first term, for a thin rectangle. */
    out->wagner_torque = (pow(wide, 5) * thin + wide * pow(thin, 5)) / 1440;
    const int theory = s->shear_factor[0] > 0 || s->shear_factor[1] > 0;
    for (int i = 0; i < 2; i++)
        out->F[4 * i] = 1 / ((s->shear_factor[i] > 0 ? s->shear_factor[i] : 5.0 / 6) * out->A);
    out->F[8] = theory ? 0 : 1 / (5.0 / 6 * thin * wide * wide * wide / 12);
    out->rectangle = 1;
    out->width = w;
    out->height = h;
    return STATUS_OK;
}

/* Computes the exact constants of a circular ring. The section remains plane in torsion (Iw = 0).
 * Shear stresses in bending follow Saint-Venant's theory without the Poisson effect: 1/k = 7/6 +
 * 10/3 m^2/(1 + m^2)^2 with m = inner/outer radius (Renton, Int. J. Solids Struct. 28, 1991; Cowper
 * 1966 at nu = 0). k is 6/7 for a solid bar and 1/2 for a thin tube. */
static status tube(const section_spec *s, section *out, fault *f)
{
    const double R = s->diameter / 2, t = s->wall_thickness;
    if (!(R > 0) || !isfinite(R))
        return fault_set(f, STATUS_REFUSED,
                         "section: the diameter of the tube is %g m; give a positive diameter",
                         s->diameter);
    if (!(t > 0) || !(t <= R))
        return fault_set(
            f, STATUS_REFUSED,
            "section: the wall thickness of the tube is %g m; give a positive value, at "
            "most half the diameter, %g m",
            t, R);
    const double r = R - t, ring = t * (2 * R - t), square = R * R + r * r, m = R * r / square;
    out->A = PI * ring;
    out->Iy = out->Iz = PI / 4 * ring * square;
    out->Ip = out->It = 2 * out->Iy;
    out->wagner_torque = PI * ring * ring * ring / 96; /* 1/8 int (r^2 - Ip/A)^2 dA */
    out->F[0] = out->F[4] = (7.0 / 6 + 10.0 / 3 * m * m) / out->A;
    return STATUS_OK;
}

/* Computes D = F^-1, or F = D^-1, on the nonzero rows. Zero rows and columns remain zero. */
static status invert_on_support(const double from[9], double to[9], const char *name, fault *f)
{
    double scaled[9], scale[3];
    int index[3], n = 0;
    memset(to, 0, 9 * sizeof(double));
    for (int i = 0; i < 3; i++)
        if (from[4 * i] != 0)
            index[n++] = i;
    static const char *const axis[] = {"y", "z", "w"};
    for (int i = 0; i < n; i++) {
        if (!(from[4 * index[i]] > 0))
            return fault_set(f, STATUS_REFUSED, "section: %s_%s = %g; give a positive value", name,
                             axis[index[i]], from[4 * index[i]]);
        scale[i] = sqrt(from[4 * index[i]]);
    }
    double inverse[9] = {0};
    for (int i = 0; i < n; i++) {
        inverse[i * n + i] = 1;
        for (int j = 0; j < n; j++)
            scaled[i * n + j] = from[3 * index[i] + index[j]] / (scale[i] * scale[j]);
    }
    if (dense_cholesky(n, scaled) != 0)
        return fault_set(f, STATUS_REFUSED,
                         "section: the shear matrix %s is not positive definite, because "
                         "its off-diagonal entries are too large for %s_y = %g, %s_z = %g, %s_w = "
                         "%g; correct the data of the section",
                         name, name, from[0], name, from[4], name, from[8]);
    dense_cholesky_solve(n, n, scaled, inverse);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            to[3 * index[i] + index[j]] = inverse[i * n + j] / (scale[i] * scale[j]);
    return STATUS_OK;
}

static void override(double *value, double given)
{
    if (!isnan(given))
        *value = given;
}

static status apply_given(const section_spec *s, section *out, fault *f)
{
    const struct {
        const char *name;
        double value;
    } whole[] = {
        {"A", s->given.A}, {"Iy", s->given.Iy}, {"Iz", s->given.Iz}, {"beta", s->given.beta}};
    for (size_t i = 0; i < sizeof whole / sizeof whole[0]; i++)
        if (!isnan(whole[i].value) && s->kind != SECTION_WALLS)
            return fault_set(
                f, STATUS_REFUSED,
                "section: 'given: {%s}' applies only to thin walls; for other sections the value "
                "follows from the dimensions; remove it, or give 'constants'",
                whole[i].name);
    override(&out->A, s->given.A);
    override(&out->Iy, s->given.Iy);
    override(&out->Iz, s->given.Iz);
    if (!isnan(s->given.Iy) || !isnan(s->given.Iz))
        out->Ip = out->Iy + out->Iz;
    override(&out->Iw, s->given.Iw);
    override(&out->ys, s->given.ys);
    override(&out->zs, s->given.zs);
    override(&out->It, s->given.It);
    override(&out->Ip, s->given.Ip);
    override(&out->wagner_torque, s->given.wagner_torque);
    const double diagonal[3] = {s->given.Dy, s->given.Dz, s->given.Dw},
                 off[3] = {s->given.Dyz, s->given.Dyw, s->given.Dzw};
    static const int row[3] = {0, 0, 1}, column[3] = {1, 2, 2};
    int changed = 0;
    for (int i = 0; i < 3; i++)
        changed |= !isnan(diagonal[i]) || !isnan(off[i]);
    if (!changed)
        return STATUS_OK;
    for (int i = 0; i < 3; i++) {
        override(&out->D[4 * i], diagonal[i]);
        override(&out->D[3 * row[i] + column[i]], off[i]);
        override(&out->D[3 * column[i] + row[i]], off[i]);
    }
    return invert_on_support(out->D, out->F, "D", f);
}

static status check_material(const section_spec *s, fault *f)
{
    if (!(s->young > 0) || !isfinite(s->young))
        return fault_set(f, STATUS_REFUSED,
                         "section: young = %g Pa; give a positive modulus of elasticity", s->young);
    if (!(s->shear_modulus > 0) || !isfinite(s->shear_modulus))
        return fault_set(f, STATUS_REFUSED,
                         "section: shear_modulus = %g Pa; give a positive shear modulus",
                         s->shear_modulus);
    if (!(s->density >= 0) || !isfinite(s->density))
        return fault_set(f, STATUS_REFUSED,
                         "section: density = %g kg/m^3; give zero or a positive density",
                         s->density);
    return STATUS_OK;
}

static status check_constants(const section *c, fault *f)
{
    const struct {
        const char *name;
        double value;
        int may_vanish;
    } all[] = {{"A", c->A, 0},   {"Iy", c->Iy, 0}, {"Iz", c->Iz, 0},
               {"It", c->It, 1}, {"Iw", c->Iw, 1}, {"Ip", c->Ip, 0}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (!(all[i].value > 0 || (all[i].may_vanish && all[i].value == 0)) ||
            !isfinite(all[i].value))
            return fault_set(f, STATUS_REFUSED, "section: %s = %g; give %s value", all[i].name,
                             all[i].value, all[i].may_vanish ? "zero or a positive" : "a positive");
    if (!isfinite(c->ys) || !isfinite(c->zs))
        return fault_set(f, STATUS_REFUSED,
                         "section: the shear centre (%g, %g) m is not finite; give finite values",
                         c->ys, c->zs);
    return STATUS_OK;
}

static status constants_of(const section_spec *spec, section *out, fault *f)
{
    switch (spec->kind) {
    case SECTION_WALLS:
        return section_walls(spec, out, f);
    case SECTION_RECTANGLE:
        return rectangle(spec, out, f);
    case SECTION_TUBE:
        return tube(spec, out, f);
    case SECTION_CONSTANTS:
    case SECTION_MATRICES:
        break;
    }
    *out = spec->constants;
    return STATUS_OK;
}

status section_compute(const section_spec *spec, section *out, fault *f)
{
    if (!isfinite(spec->expansion))
        return fault_set(f, STATUS_REFUSED, "section: expansion = %g 1/K; give a finite number",
                         spec->expansion);
    if (spec->kind == SECTION_MATRICES) {
        memset(out, 0, sizeof *out);
        out->expansion = spec->expansion;
        return section_matrices(spec, out, f);
    }
    TRY(check_material(spec, f));
    memset(out, 0, sizeof *out);
    TRY(constants_of(spec, out, f));
    out->young = spec->young;
    out->shear_modulus = spec->shear_modulus;
    out->density = spec->density;
    out->expansion = spec->expansion;
    TRY(out->F[0] == 0 && out->D[0] != 0 ? invert_on_support(out->D, out->F, "D", f)
                                         : invert_on_support(out->F, out->D, "F", f));
    TRY(apply_given(spec, out, f));
    return check_constants(out, f);
}
