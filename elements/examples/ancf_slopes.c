/* The fully parameterised beam of the absolute nodal coordinate formulation: two nodes, each with a
 * position and three slopes, r_x, r_y and r_z (Yakoub and Shabana, J. Mech. Design 123 (2001)). A
 * node has 7 coordinates, of which the warping amplitude is not used, and 6 additional unknowns:
 * the slopes are r_x = R (1 + s1, s2, s3), r_y = R (0, 1 + s4, s6), r_z = R (0, s6, 1 + s5), so R
 * is the rotation of the cross-section. The position of a point of the element is r(x) + y r_y(x) +
 * z r_z(x), r cubic, r_y and r_z linear in x. All products of two of these vectors and their
 * derivatives at the Gauss points are strains. The Green-Lagrange strains of the continuum are
 * linear in them: E_xx = e0 + y e1 + z e2 + y^2 e3 + y z e4 + z^2 e5, 2 E_xy = e6 + y e7 + z e8, 2
 * E_xz = e9 + y e10 + z e11, E_yy = e12, E_zz = e13, 2 E_yz = e14.
 *
 * energy=continuum: the original element, with the energy of a continuum (Saint Venant-Kirchhoff)
 * in a rectangle. It locks. E_yy and E_zz cannot vary over the cross-section, so in bending they
 * remain zero, and the bending stiffness is E I (1-nu)/((1+nu)(1-2nu)): Poisson locking (Gerstmayr,
 * Sugiyama and Mikkola, J. Comput. Nonlinear Dyn. 8 (2013)). Cross-sections do not warp, so the
 * torsional stiffness is G (Iy + Iz).
 * energy=selective: Poisson's ratio acts only on the strains of the axis, integration is reduced,
 * and the shear and torsional stiffnesses are those of the cross-section. If it is rigid in shear,
 * its shear flexibility is l^2/(10 E I); MacNeal, Comput. Struct. 8 (1978), has l^2/(12 E I).
 *
 *   cc -O2 -shared -fPIC -I FOLDER_OF_BEAMWORK ancf_slopes.c -lm -o ancf_slopes.so
 *   beamwork verify --element ./ancf_slopes.so -f ancf_slopes */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/element.h"

enum { SCALARS = 6, STRAINS = 15, POINTS = 3, VECTORS = 5, SLOPES = 4 };
enum { C = 2 * (NODE_COORDINATES + SCALARS) }; /* coordinates */
enum { AXIS, Y, Z, DY, DZ };                   /* r', r_y, r_z, r_y', r_z' */
enum { ALONG, ACROSS, PARTS };                 /* parts of the energy */

/* The strains: products of two vectors, times l^power and a factor. */
static const struct {
    int a, b, power;
    double factor;
} product[STRAINS] = {{AXIS, AXIS, 1, 0.5}, {AXIS, DY, 2, 1}, {AXIS, DZ, 2, 1}, {DY, DY, 3, 0.5},
                      {DY, DZ, 3, 1},       {DZ, DZ, 3, 0.5}, {AXIS, Y, 1, 1},  {DY, Y, 2, 1},
                      {DZ, Y, 2, 1},        {AXIS, Z, 1, 1},  {DY, Z, 2, 1},    {DZ, Z, 2, 1},
                      {Y, Y, 1, 0.5},       {Z, Z, 1, 0.5},   {Y, Z, 1, 1}};

struct element_data {
    double length;                             /* [m] */
    double vector[POINTS][VECTORS][2][SLOPES]; /* vectors from r, r_x, r_y, r_z of both nodes */
    /* weights of the points, and energy per length of strains without powers of l, of both parts */
    double weight[PARTS][POINTS], stiffness[PARTS][STRAINS * STRAINS];
};

static int is_continuum(const double options[])
{
    return options[0] == 1;
}

static int strains(const double options[])
{
    (void)options;
    return POINTS * STRAINS;
}

static int scalars(const double options[])
{
    (void)options;
    return SCALARS;
}

static size_t data_size(const element_request *request)
{
    (void)request;
    return sizeof(element_data);
}

static status refuse(fault *f, const char *why)
{
    snprintf(f->text, sizeof f->text, "%s", why);
    return STATUS_REFUSED;
}

/* Sets an entry of a symmetric stiffness. */
static void put(double stiffness[], int i, int j, double value)
{
    stiffness[i * STRAINS + j] = stiffness[j * STRAINS + i] = value;
}

/* Fills the stiffness of E_yy, E_zz and E_yz and their coupling to E_xx on the axis. */
static void fill_across(const section *c, double lambda, double K[])
{
    for (int i = 12; i < 14; i++) {
        put(K, 0, i, lambda * c->A);
        for (int j = 12; j < 14; j++)
            put(K, i, j, (lambda + (i == j ? 2 * c->shear_modulus : 0)) * c->A);
    }
    put(K, 14, 14, c->shear_modulus * c->A);
}

/* Fills the stiffness of the continuum: integrals of products over a rectangle. */
static void fill_continuum(const section *c, double lambda, double K[])
{
    /* powers of y and z with which strains 0 to 5 and 6 to 8 enter; integral of y^i z^j */
    static const int power[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
    const double G = c->shear_modulus, h2 = c->height * c->height, b2 = c->width * c->width;
    const double moment[5][5] = {
        {1, 0, b2 / 12, 0, b2 * b2 / 80}, {0}, {h2 / 12, 0, h2 * b2 / 144}, {0}, {h2 * h2 / 80}};
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++)
            put(K, i, j,
                (lambda + 2 * G) * c->A *
                    moment[power[i][0] + power[j][0]][power[i][1] + power[j][1]]);
        for (int j = 12; j < 14; j++)
            put(K, i, j, lambda * c->A * moment[power[i][0]][power[i][1]]);
    }
    for (int first = 6; first < 12; first += 3)
        for (int i = 0; i < 3; i++)
            put(K, first + i, first + i, G * c->A * moment[2 * power[i][0]][2 * power[i][1]]);
}

/* Fills the stiffnesses of the cross-section. */
static void fill_selective(const element_request *request, double lambda, element_data *d)
{
    const section *c = request->section;
    const double G = c->shear_modulus, E = c->young, twist = G * c->It / 4,
                 shear = request->features & FEATURE_SHEAR ? 1 / G : 0,
                 bent = request->length * request->length / (10 * E);
    double *K = d->stiffness[ALONG];
    put(K, 0, 0, E * c->A);
    put(K, 1, 1, E * c->Iz);
    put(K, 2, 2, E * c->Iy);
    put(K, 6, 6, 1 / (shear > 0 && c->F[0] > 0 ? shear * c->F[0] : bent / c->Iz));
    put(K, 9, 9, 1 / (shear > 0 && c->F[4] > 0 ? shear * c->F[4] : bent / c->Iy));
    put(K, 8, 8, twist); /* the twist is (e10 - e8)/2 */
    put(K, 10, 10, twist);
    put(K, 8, 10, -twist);
    fill_across(c, lambda, d->stiffness[ACROSS]);
    put(d->stiffness[ACROSS], 0, 0, (lambda + 2 * G - E) * c->A);
}

static status prepare(const element_request *request, element_data *out, fault *f)
{
    /* Gauss points of the continuum; both ends and the middle, with E_yy, E_zz and E_yz at the ends
     */
    static const double at[2][POINTS] = {{0, 0.5, 1},
                                         {0.11270166537925831, 0.5, 0.88729833462074169}},
                        weight[2][PARTS][POINTS] = {{{1. / 6, 4. / 6, 1. / 6}, {0.5, 0, 0.5}},
                                                    {{5. / 18, 8. / 18, 5. / 18}}};
    const section *c = request->section;
    const int whole = is_continuum(request->options);
    const double l = request->length, G = c->shear_modulus, nu = c->young / (2 * G) - 1,
                 lambda = c->young * nu / ((1 + nu) * (1 - 2 * nu));
    if (!(nu > -1 && nu < 0.5))
        return refuse(f, "ancf_slopes: E/(2 G) - 1 is not a Poisson's ratio; give E and G of an "
                         "isotropic material");
    if (whole && (!c->rectangle || !(request->features & FEATURE_SHEAR)))
        return refuse(f, "ancf_slopes: energy=continuum requires a rectangle that is flexible in "
                         "shear; use energy=selective");
    memset(out, 0, sizeof *out);
    out->length = l;
    memcpy(out->weight, weight[whole], sizeof out->weight);
    for (int g = 0; g < POINTS; g++) {
        const double s = at[whole][g], chord = 6 * s * (1 - s) / l, part[2] = {1 - s, s};
        double(*v)[2][SLOPES] = out->vector[g];
        for (int k = 0; k < 2; k++) {
            v[AXIS][k][0] = k ? chord : -chord;
            v[AXIS][k][1] = k ? s * (3 * s - 2) : (1 - s) * (1 - 3 * s);
            v[Y][k][2] = v[Z][k][3] = part[k];
            v[DY][k][2] = v[DZ][k][3] = (k ? 1 : -1) / l;
        }
    }
    if (!whole) {
        fill_selective(request, lambda, out);
        return STATUS_OK;
    }
    fill_across(c, lambda, out->stiffness[ALONG]);
    fill_continuum(c, lambda, out->stiffness[ALONG]);
    return STATUS_OK;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Components of the slopes in the axes of the node: r_x, r_y and r_z are R c[0], R c[1], R c[2]. */
static void components(const double s[SCALARS], double c[3][3])
{
    const double all[3][3] = {{1 + s[0], s[1], s[2]}, {0, 1 + s[3], s[5]}, {0, s[5], 1 + s[4]}};
    memcpy(c, all, sizeof all);
}

/* Adds to J the products of the derivatives of r, r_x, r_y and r_z of a node and the vectors
 * g[SLOPES]. */
static void add_row(const node_state *x, const double slope[SLOPES][3], const double g[SLOPES][3],
                    double node[], double more[])
{
    /* vector and axis of the node that each additional unknown multiplies */
    static const int of[SCALARS][2] = {{1, 0}, {1, 1}, {1, 2}, {2, 1}, {3, 2}, {2, 2}};
    double along[SLOPES][3];
    for (int m = 0; m < SLOPES; m++)
        for (int i = 0; i < 3; i++)
            along[m][i] = x->R[i] * g[m][0] + x->R[3 + i] * g[m][1] + x->R[6 + i] * g[m][2];
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        node[i] += g[0][i];
        for (int m = 1; m < SLOPES; m++)
            node[3 + i] += slope[m][a] * g[m][b] - slope[m][b] * g[m][a];
    }
    for (int i = 0; i < SCALARS; i++)
        more[i] += along[of[i][0]][of[i][1]];
    more[5] += along[3][1];
}

static void strain(const element_data *d, const node_state x[], strain_output *out)
{
    double slope[2][SLOPES][3];
    for (int k = 0; k < 2; k++) {
        double c[3][3];
        components(x[k].scalar, c);
        for (int i = 0; i < 3; i++) {
            slope[k][0][i] = x[k].r[i];
            for (int m = 1; m < SLOPES; m++)
                slope[k][m][i] = dot(&x[k].R[3 * i], c[m - 1]);
        }
    }
    if (out->J != NULL)
        memset(out->J, 0, POINTS * STRAINS * C * sizeof *out->J);
    for (int g = 0; g < POINTS; g++) {
        double v[VECTORS][3] = {{0}};
        for (int n = 0; n < VECTORS * 2 * SLOPES; n++)
            for (int i = 0; i < 3; i++)
                v[n / 8][i] += d->vector[g][n / 8][n / 4 % 2][n % 4] * slope[n / 4 % 2][n % 4][i];
        for (int n = 0; n < STRAINS; n++) {
            const int a = product[n].a, b = product[n].b, row = g * STRAINS + n;
            const double size = product[n].factor * pow(d->length, product[n].power),
                         rest = a == b && a <= Z ? 1 : 0;
            if (out->e != NULL)
                out->e[row] = size * (dot(v[a], v[b]) - rest);
            for (int k = 0; k < 2 && out->J != NULL; k++) {
                double by[SLOPES][3];
                for (int m = 0; m < SLOPES; m++)
                    for (int i = 0; i < 3; i++)
                        by[m][i] = size * (d->vector[g][a][k][m] * v[b][i] +
                                           d->vector[g][b][k][m] * v[a][i]);
                add_row(&x[k], slope[k], by, out->J + row * C + NODE_COORDINATES * k,
                        out->J + row * C + 2 * NODE_COORDINATES + SCALARS * k);
            }
        }
    }
}

static status stress(const element_data *d, const double e[], const double inner[],
                     stress_output *out)
{
    enum { ALL = POINTS * STRAINS };
    double energy = 0;
    (void)inner;
    if (out->C != NULL)
        memset(out->C, 0, ALL * ALL * sizeof *out->C);
    for (int n = 0; n < ALL; n++) {
        const int g = n / STRAINS, i = n % STRAINS;
        double sigma = 0;
        for (int j = 0; j < STRAINS; j++) {
            const int k = i * STRAINS + j;
            const double value = (d->weight[ALONG][g] * d->stiffness[ALONG][k] +
                                  d->weight[ACROSS][g] * d->stiffness[ACROSS][k]) *
                                 pow(d->length, 1 - product[i].power - product[j].power);
            sigma += value * e[g * STRAINS + j];
            if (out->C != NULL)
                out->C[n * ALL + g * STRAINS + j] = value;
        }
        energy += sigma * e[n] / 2;
        if (out->sigma != NULL)
            out->sigma[n] = sigma;
    }
    if (out->energy != NULL)
        *out->energy = energy;
    if (out->residual != NULL)
        *out->residual = 0;
    return STATUS_OK;
}

static const parameter_type energies[] = {
    {"energy", "", 0, 0, 0, "selective|continuum",
     "selective: Poisson's ratio only on the axis, reduced integration; continuum: the original "
     "element, which locks"},
    {0},
};

const element_type beamwork_element = {
    .abi = ELEMENT_ABI,
    .size = sizeof(element_type),
    .name = "ancf_slopes",
    .summary = "two nodes with position and three slopes: the fully parameterised ANCF beam",
    .source = "Yakoub and Shabana (2001); selective integration: Gerstmayr, Sugiyama and Mikkola "
              "(2013)",
    .family = "example",
    .offers =
        FEATURE_SHEAR | FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .shear_theories = SHEAR_ENGESSER,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_HALF_TURN,
    .leaves = LEAVES_H,
    .options = {energies},
    .data_size = data_size,
    .prepare = prepare,
    .strains = strains,
    .scalars = scalars,
    .strain = strain,
    .stress = stress,
};
