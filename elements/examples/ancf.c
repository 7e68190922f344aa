/* A thin beam of the absolute nodal coordinate formulation, defined by its energy. Forces and
 * stiffness are computed by finite differences.
 *
 * As in the original formulation, the line r(x) is a cubic defined by the positions and slopes r'
 * of two nodes (Gerstmayr and Shabana, Nonlinear Dyn. 45 (2006)). The energy depends on the stretch
 * |r'| - 1 and the curvature per undeformed length, |t x t'|, t = r'/|r'| (Gerstmayr and Irschik,
 * J. Sound Vib. 318 (2008)).
 *
 * Unlike in the original formulation, nodes have rotations instead of slopes. A slope has the
 * direction of the x axis of the node, which neighbouring elements share. Each element chooses the
 * length of the slope that minimises the energy of the stretch. Twist, which slopes cannot
 * represent, is the angle between the triads of the nodes after the smallest rotation of both to t
 * (Meier, Popp and Wall, Comput. Methods Appl. Mech. Engrg. 278 (2014)). The mass is that of the
 * displacement field, not the constant mass matrix of slopes.
 *
 *   cc -O2 -shared -fPIC -I FOLDER_OF_BEAMWORK ancf.c -lm -o ancf.so
 *   beamwork verify --element ./ancf.so -f ancf */
#include <math.h>
#include <string.h>

#include "elements/element.h"

/* Number of Gauss points, which equals the number of independent stretches (two slopes and a
 * chord). */
enum { POINTS = 3 };
static const double abscissa[POINTS] = {0.11270166537925831, 0.5, 0.88729833462074169};
static const double weight[POINTS] = {5. / 18, 8. / 18, 5. / 18};

struct element_data {
    double length, EA, EIy, EIz, GIt; /* [m, N, N m^2] */
};

static size_t data_size(const element_request *request)
{
    (void)request;
    return sizeof(element_data);
}

static status prepare(const element_request *request, element_data *out, fault *f)
{
    const section *c = request->section;
    (void)f;
    *out = (element_data){request->length, c->young * c->A, c->young * c->Iy, c->young * c->Iz,
                          c->shear_modulus * c->It};
    return STATUS_OK;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Returns an axis of the triad of a node, which is stored row-major. */
static void axis(const double R[9], int i, double a[3])
{
    for (int k = 0; k < 3; k++)
        a[k] = R[3 * k + i];
}

/* The chord divided by the length, and the directions and lengths of the slopes. */
typedef struct line {
    double chord[3], direction[2][3], slope[2];
} line;

/* Computes r' and l r'' at x = s l. */
static void derivatives(const line *c, double s, double first[3], double second[3])
{
    for (int i = 0; i < 3; i++) {
        const double p = c->slope[0] * c->direction[0][i], q = c->slope[1] * c->direction[1][i];
        first[i] = 6 * s * (1 - s) * c->chord[i] + (1 - s) * (1 - 3 * s) * p - s * (2 - 3 * s) * q;
        second[i] = (6 - 12 * s) * c->chord[i] - (4 - 6 * s) * p + (6 * s - 2) * q;
    }
}

/* Makes one step of Newton's method for the slope lengths that minimise the energy of the stretch.
 * Returns the size of the step. */
static double correct(line *c)
{
    double g[2] = {0}, H[2][2] = {{0}};
    for (int k = 0; k < POINTS; k++) {
        const double s = abscissa[k], h[2] = {(1 - s) * (1 - 3 * s), -s * (2 - 3 * s)};
        double first[3], second[3];
        derivatives(c, s, first, second);
        const double size = sqrt(dot(first, first)), w = weight[k];
        for (int i = 0; i < 2; i++) {
            const double along = dot(first, c->direction[i]) / size;
            g[i] += w * (size - 1) * h[i] * along;
            for (int j = 0; j < 2; j++) {
                const double both = along * dot(first, c->direction[j]) / size;
                const double across = dot(c->direction[i], c->direction[j]) - both;
                H[i][j] += w * h[i] * h[j] * (both + (1 - 1 / size) * across);
            }
        }
    }
    const double det = H[0][0] * H[1][1] - H[0][1] * H[1][0];
    const double change[2] = {(H[0][1] * g[1] - H[1][1] * g[0]) / det,
                              (H[1][0] * g[0] - H[0][0] * g[1]) / det};
    for (int i = 0; i < 2; i++)
        c->slope[i] += change[i];
    return fabs(change[0]) + fabs(change[1]);
}

/* Computes y, the y axis of the triad R after the smallest rotation to t. Returns the rate of
 * rotation of y about t for the rate dt of t. */
static double carried(const double R[9], const double t[3], const double dt[3], double y[3])
{
    double x[3], about[3];
    axis(R, 0, x);
    axis(R, 1, y);
    cross(x, t, about);
    const double whole = 1 + dot(x, t), part = dot(y, t) / whole;
    for (int i = 0; i < 3; i++)
        y[i] -= part * (x[i] + t[i]);
    return -dot(about, dt) / whole;
}

/* Returns the energy per length at x = s l [N]. */
static double density(const element_data *d, const node_state x[], const line *c, double s)
{
    double first[3], second[3], t[3], dt[3], y[2][3], other[3], curvature[3], section_y[3],
        section_z[3];
    derivatives(c, s, first, second);
    const double size = sqrt(dot(first, first));
    for (int i = 0; i < 3; i++)
        t[i] = first[i] / size;
    for (int i = 0; i < 3; i++)
        dt[i] = (second[i] - t[i] * dot(t, second)) / (size * d->length);
    const double turns[2] = {carried(x[0].R, t, dt, y[0]), carried(x[1].R, t, dt, y[1])};
    cross(t, y[0], other);
    const double angle = atan2(dot(other, y[1]), dot(y[0], y[1]));
    const double twist = (1 - s) * turns[0] + s * turns[1] + angle / d->length;
    for (int i = 0; i < 3; i++) /* axes of the cross-section, rotated by a fraction of the angle */
        section_y[i] = cos(s * angle) * y[0][i] + sin(s * angle) * other[i];
    cross(t, section_y, section_z);
    cross(t, dt, curvature);
    const double ky = dot(section_y, curvature), kz = dot(section_z, curvature);
    return (d->EA * (size - 1) * (size - 1) + d->EIy * ky * ky + d->EIz * kz * kz +
            d->GIt * twist * twist) /
           2;
}

static status force(const element_data *d, const node_state x[], force_output *out)
{
    line c;
    for (int i = 0; i < 3; i++)
        c.chord[i] = (x[1].r[i] - x[0].r[i]) / d->length;
    for (int k = 0; k < 2; k++) {
        axis(x[k].R, 0, c.direction[k]);
        c.slope[k] = 1;
    }
    int rounds = 0;
    while (correct(&c) >
           1e-10) /* each step of Newton's method doubles the number of correct digits */
        if (++rounds == 20)
            return STATUS_NOT_CONVERGED;
    *out->energy = 0;
    for (int k = 0; k < POINTS; k++)
        *out->energy += weight[k] * d->length * density(d, x, &c, abscissa[k]);
    return STATUS_OK;
}

const element_type beamwork_element = {
    .abi = ELEMENT_ABI,
    .size = sizeof(element_type),
    .name = "ancf",
    .summary = "two nodes, thin, defined by its energy: a cubic line along the nodes' x axes",
    .source = "Gerstmayr and Shabana (2006), Gerstmayr and Irschik (2008); twist as in Meier, Popp "
              "and Wall (2014)",
    .family = "example",
    .offers = FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_HALF_TURN,
    .leaves = LEAVES_FORCE | LEAVES_TANGENT,
    .data_size = data_size,
    .prepare = prepare,
    .force = force,
};
