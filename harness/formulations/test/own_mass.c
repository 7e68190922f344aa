/* The beam of timoshenko.c with the mass of own_mass.py, in C. Velocities are linear along the
 * element, and half of the rotary inertia is at each node. */
#define beamwork_element timoshenko
#include "elements/examples/timoshenko.c"
#undef beamwork_element

enum { N = 14 };

typedef struct mass_massive {
    element_data beam;
    double mass;
    double about[3]; /* half of the moments of inertia of the element about its axes [kg m^2] */
} mass_massive;

static size_t massive_size(const element_request *request)
{
    (void)request;
    return sizeof(mass_massive);
}

static status massive_prepare(const element_request *request, element_data *out, fault *f)
{
    const section *c = request->section;
    const double half = c->density * request->length / 2;
    const int rotary = (request->features & FEATURE_ROTARY_INERTIA) != 0;
    mass_massive *own = (mass_massive *)out;
    own->mass = 2 * half * c->A;
    own->about[0] = half * c->Ip;
    own->about[1] = rotary ? half * c->Iy : 0;
    own->about[2] = rotary ? half * c->Iz : 0;
    return prepare(request, out, f);
}

static void add(double M[], int at, int row, int column, double value)
{
    M[N * (at + row) + at + column] += value;
}

/* Adds sign x~ A to the block of M with the rotations at index `at`. A is the identity if NULL. */
static void add_cross(double M[], int at, const double x[3], const double A[9], double sign)
{
    const double X[9] = {0, -x[2], x[1], x[2], 0, -x[0], -x[1], x[0], 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                add(M, at, i, j, sign * X[3 * i + k] * (A != NULL ? A[3 * k + j] : k == j));
}

static void times(const double A[9], const double x[3], double y[3])
{
    for (int i = 0; i < 3; i++)
        y[i] = A[3 * i] * x[0] + A[3 * i + 1] * x[1] + A[3 * i + 2] * x[2];
}

static void turned(const double R[9], const double about[3], double J[9])
{
    for (int i = 0; i < 9; i++) {
        J[i] = 0;
        for (int k = 0; k < 3; k++)
            J[i] += R[i / 3 * 3 + k] * about[k] * R[i % 3 * 3 + k];
    }
}

/* Adds the inertia moment J a + w x J w of one node, with its angular velocity w and angular
 * acceleration a, and its derivatives. */
static void add_node(const double J[9], int at, const double w[3], const double a[3],
                     inertia_output *out)
{
    double p[3], b[3];
    times(J, w, p);
    times(J, a, b);
    if (out->taken != NULL)
        for (int i = 0; i < 3; i++)
            out->taken[at + i] +=
                b[i] + w[(i + 1) % 3] * p[(i + 2) % 3] - w[(i + 2) % 3] * p[(i + 1) % 3];
    if (out->C != NULL) {
        add_cross(out->C, at, w, J, 1);
        add_cross(out->C, at, p, NULL, -1);
    }
    for (int i = 0; i < 9 && out->M != NULL; i++)
        add(out->M, at, i / 3, i % 3, J[i]);
}

static void add_line(double mass, const double acceleration[], inertia_output *out)
{
    for (int i = 0; i < 3; i++)
        for (int node = 0; node < 2; node++)
            for (int other = 0; other < 2; other++) {
                const double share = mass / (node == other ? 3 : 6);
                if (out->M != NULL)
                    out->M[N * (7 * node + i) + 7 * other + i] = share;
                if (out->taken != NULL && acceleration != NULL)
                    out->taken[7 * node + i] += share * acceleration[7 * other + i];
            }
}

static void clear(double *A, int count)
{
    for (int i = 0; i < count && A != NULL; i++)
        A[i] = 0;
}

static status inertia(const element_data *d, const node_state x[],
                      const element_rotating_frame *turning, inertia_output *out)
{
    static const double none[N];
    const mass_massive *own = (const mass_massive *)d;
    const double *rate = out->rate != NULL ? out->rate : none,
                 *acceleration = out->acceleration != NULL ? out->acceleration : none;
    if (turning != NULL)
        return STATUS_REFUSED;
    double *const square[5] = {out->M, out->N, out->G, out->C, out->K};
    for (int i = 0; i < 5; i++)
        clear(square[i], N * N);
    clear(out->potential, 1);
    clear(out->force, N);
    clear(out->taken, N);
    add_line(own->mass, acceleration, out);
    for (int node = 0; node < 2; node++) {
        double J[9];
        turned(x[node].R, own->about, J);
        add_node(J, 7 * node + 3, rate + 7 * node + 3, acceleration + 7 * node + 3, out);
    }
    return STATUS_OK;
}

const element_type beamwork_element = {
    .abi = ELEMENT_ABI,
    .size = sizeof(element_type),
    .name = "own_mass",
    .summary = "two nodes, one integration point, flexible in shear, own mass matrix",
    .source = "Reissner, J. Appl. Math. Phys. 32 (1981), with one integration point",
    .family = "example",
    .offers =
        FEATURE_SHEAR | FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .shear_theories = SHEAR_HARINGX,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_HALF_TURN,
    .leaves = LEAVES_J,
    .data_size = massive_size,
    .prepare = massive_prepare,
    .strains = strains,
    .strain = strain,
    .stress = stress,
    .inertia = inertia,
    .spreads = 1,
};
