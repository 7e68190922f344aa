#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <string.h>

#include "elements/field/field.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/model/model.h"

static void effects_check(const formulation *chosen, check_results *c);

typedef enum feature_outcome { FINITE, REFUSED, BAD, FEATURE_OUTCOMES } feature_outcome;

static int finite_stiffness(const test_element *s, unsigned seed)
{
    double inner[TEST_ELEMENT_INNER], e[TEST_ELEMENT_STRAINS],
        C[TEST_ELEMENT_STRAINS * TEST_ELEMENT_STRAINS];
    node_state x[ELEMENT_MAX_NODES];
    test_element_state(s, 0.01, seed, x);
    s->type.strain(s->data, x, &(strain_output){.e = e, .history = s->history});
    test_element_rest(s, inner);
    if (test_element_converged(s, e, inner, &(stress_output){.C = C}) != STATUS_OK)
        return 0;
    for (int i = 0; i < s->strains * s->strains; i++)
        if (!isfinite(C[i]))
            return 0;
    return 1;
}

static feature_outcome evaluated(const formulation *chosen, unsigned features, fault *why)
{
    const test_element_request what = {
        .given = chosen->type, .options = chosen->option, .features = features, .unit = 1};
    test_element s;
    feature_outcome out = BAD;
    const status made = test_element_make(&what, &s, why);
    if (made == STATUS_OK)
        out = finite_stiffness(&s, features + 1) ? FINITE : BAD;
    else if (made == STATUS_REFUSED && why->text[0] != '\0')
        out = REFUSED;
    else if (why->text[0] == '\0')
        fault_set(why, made, "no reason is given (status '%s')", status_name(made));
    test_element_free(&s);
    return out;
}

static void accepted(const formulation *chosen, unsigned features, const char *what,
                     check_results *c)
{
    fault why = {""};
    checks_current(c, "prepare, strain and stress with %s", what);
    const feature_outcome found = evaluated(chosen, features, &why);
    checks_require(
        checks_open(c, "all declared features are supported", 0), found == FINITE,
        "offers: with %s the element fails (%s%s); support the feature, or do not declare it", what,
        why.text[0] != '\0' ? "rejected: " : "the stiffness is not finite", why.text);
}

static void single_features(const formulation *chosen, check_results *c)
{
    static const struct {
        unsigned feature, presupposes;
    } needs[] = {{FEATURE_ENGESSER, FEATURE_SHEAR},
                 {FEATURE_HARINGX, FEATURE_SHEAR},
                 {FEATURE_ROTARY_INERTIA, FEATURE_MASS}};
    const unsigned offers = chosen->type->offers;
    accepted(chosen, 0, "no feature", c);
    accepted(chosen, offers & ~(unsigned)FEATURE_CURVATURE, "all features", c);
    for (unsigned bit = 1; bit < FEATURE_END; bit <<= 1) {
        unsigned features = bit;
        for (size_t k = 0; k < sizeof needs / sizeof needs[0]; k++)
            features |= needs[k].feature == bit ? needs[k].presupposes : 0;
        if ((features & ~offers) == 0)
            accepted(chosen, features, feature_name(bit), c);
    }
}

static void features_of_cases(const formulation *chosen, check_results *c)
{
    int runs = 0;
    for (int i = 0; registry_cases[i] != NULL; i++) {
        double value[CASE_MAX_PARAMETERS];
        char words[FAULT_TEXT];
        scene s;
        parameters_default(registry_cases[i], value);
        scene_init(&s, registry_cases[i]->name);
        if (case_build(registry_cases[i], value, &s, NULL) == STATUS_OK &&
            !missing_words(&s, chosen->type, words, sizeof words)) {
            accepted(chosen, features_needed_of(&s, chosen->type), registry_cases[i]->name, c);
            runs++;
        }
        scene_free(&s);
    }
    if (registry_cases[0] != NULL)
        checks_require(checks_open(c, "cases", 0), runs > 0,
                       "offers, limits: the formulation supports no built-in case; declare the "
                       "features that it supports, and only the limits that it has");
}

static void feature_subsets(const formulation *chosen, check_results *c)
{
    enum { OPTIONAL = 7 };
    static const unsigned optional[OPTIONAL] = {
        FEATURE_WARPING,       FEATURE_SHEAR,   FEATURE_TRAPEZE, FEATURE_WAGNER_MOMENTS,
        FEATURE_WAGNER_TORQUE, FEATURE_HARINGX, FEATURE_MASS};
    check_result *finite = checks_open(c, "subsets", 0), *few = checks_open(c, "few refused", 0.5);
    int count[FEATURE_OUTCOMES] = {0};
    for (unsigned subset = 0; subset < 1u << OPTIONAL; subset++) {
        unsigned features = chosen->type->offers & ~(unsigned)FEATURE_CURVATURE;
        char words[200];
        fault why = {""};
        for (int i = 0; i < OPTIONAL; i++)
            features &= subset >> i & 1u ? ~0u : ~optional[i];
        feature_words(features, words, sizeof words);
        checks_current(c, "prepare, strain and stress with %s", words);
        const feature_outcome found = evaluated(chosen, features, &why);
        count[found]++;
        checks_require(finite, found != BAD,
                       "prepare: the element fails with only these features: %s (%s); support this "
                       "combination, or reject it with a reason",
                       words, why.text[0] != '\0' ? why.text : "the stiffness is not finite");
    }
    checks_deviation(
        few, (double)count[REFUSED] / (1 << OPTIONAL),
        "prepare: %d of %d subsets of the declared features are rejected, but at most half may be; "
        "reject a subset only if one of its features requires a feature that is missing",
        count[REFUSED], 1 << OPTIONAL);
}

void checks_features(const formulation *chosen, check_results *out)
{
    single_features(chosen, out);
    features_of_cases(chosen, out);
    feature_subsets(chosen, out);
    effects_check(chosen, out);
}

enum { EFFECTS_M = TEST_ELEMENT_STRAINS, N = TEST_ELEMENT_COORDINATES };

typedef struct effects_answers {
    double e[EFFECTS_M], J[EFFECTS_M * N], energy, sigma[EFFECTS_M], C[EFFECTS_M * EFFECTS_M],
        G[EFFECTS_M * EFFECTS_M];
} effects_answers;

static int answer(const test_element *s, const node_state x[], effects_answers *out)
{
    double inner[TEST_ELEMENT_INNER], stress[EFFECTS_M];
    memset(out, 0, sizeof *out);
    test_element_numbers(s->strains, 67, stress);
    if (s->type.geometric != NULL)
        s->type.geometric(s->data, stress, out->G);
    s->type.strain(s->data, x, &(strain_output){.e = out->e, .J = out->J, .history = s->history});
    test_element_rest(s, inner);
    return test_element_converged(
               s, out->e, inner,
               &(stress_output){.energy = &out->energy, .sigma = out->sigma, .C = out->C}) ==
           STATUS_OK;
}

static int other(int count, const double a[], const double b[])
{
    for (int i = 0; i < count; i++)
        if (a[i] != b[i])
            return 1;
    return 0;
}

static int differ(const effects_answers *a, const effects_answers *b)
{
    return other(EFFECTS_M, a->e, b->e) || other(EFFECTS_M * N, a->J, b->J) ||
           a->energy != b->energy || other(EFFECTS_M, a->sigma, b->sigma) ||
           other(EFFECTS_M * EFFECTS_M, a->C, b->C) || other(EFFECTS_M * EFFECTS_M, a->G, b->G);
}

typedef struct pair {
    test_element with, without;
} pair;

static int makes(const formulation *chosen, unsigned features, profiles_form form,
                 test_element *out)
{
    const test_element_request what = {.given = chosen->type,
                                       .options = chosen->option,
                                       .features = features,
                                       .form = form,
                                       .unit = 1};
    fault f = {""};
    return test_element_make(&what, out, &f) == STATUS_OK;
}

/* Returns 1 if a feature changes a result, 0 if it changes none, and -1 if the type rejects or
 * cannot evaluate one of the two elements. */
static int changes(const formulation *chosen, unsigned features, unsigned bit, profiles_form form)
{
    pair p;
    effects_answers a, b;
    node_state x[ELEMENT_MAX_NODES];
    int found = -1;
    const int made = makes(chosen, features, form, &p.with),
              bare = makes(chosen, features & ~bit, form, &p.without);
    if (made && bare && p.with.strains == p.without.strains) {
        test_element_state(&p.with, 0.04, 61, x);
        if (answer(&p.with, x, &a) && answer(&p.without, x, &b))
            found = differ(&a, &b);
    } else if (made && bare) {
        found = 1;
    }
    test_element_free(&p.with);
    test_element_free(&p.without);
    return found;
}

/* Returns 1 if a result depends on the warping amplitudes of the nodes, 0 if none does, and -1 if
 * the element cannot be evaluated. */
static int warps(const formulation *chosen, unsigned features, profiles_form form)
{
    test_element s;
    effects_answers a, b;
    node_state x[ELEMENT_MAX_NODES];
    int found = -1;
    if (makes(chosen, features, form, &s)) {
        test_element_state(&s, 0.04, 61, x);
        const int first = answer(&s, x, &a);
        for (int k = 0; k < s.nodes; k++)
            x[k].a = 0;
        if (first && answer(&s, x, &b))
            found = differ(&a, &b);
    }
    test_element_free(&s);
    return found;
}

/* Returns 1 if the feature changes a result for a rectangular section or, if the type supports it,
 * for an unsymmetric section. Returns 0 if no result changes, and -1 if no element can be
 * evaluated. bit 0: the effect of the warping amplitudes is examined instead. */
static int anywhere(const formulation *chosen, unsigned features, unsigned bit)
{
    const element_type *t = chosen->type;
    const int forms =
        !(t->limits & LIMIT_DOUBLY_SYMMETRIC) && t->offers & FEATURE_ECCENTRIC ? 2 : 1;
    int found = -1;
    for (int form = 0; form < forms && found < 1; form++) {
        const int here = bit == 0 ? warps(chosen, features, (profiles_form)form)
                                  : changes(chosen, features, bit, (profiles_form)form);
        found = here > found ? here : found;
    }
    return found;
}

static void effects_check(const formulation *chosen, check_results *c)
{
    static const unsigned sections[] = {FEATURE_WARPING, FEATURE_SHEAR, FEATURE_WAGNER_MOMENTS,
                                        FEATURE_WAGNER_TORQUE};
    const unsigned all = test_element_features(chosen->type, 0);
    for (size_t i = 0; i < sizeof sections / sizeof sections[0]; i++) {
        const unsigned bit = sections[i];
        char name[CHECK_NAME];
        if (!(all & bit))
            continue;
        snprintf(name, sizeof name, "%s changes something", feature_name(bit));
        checks_current(c, "strain and stress with and without %s", feature_name(bit));
        check_result *one = checks_open(c, name, 0);
        if (bit == FEATURE_WARPING)
            checks_require(one, anywhere(chosen, all, 0) != 0,
                           "the formulation declares warping, but no result depends on the warping "
                           "amplitudes; let strains depend on them, or do not declare warping");
        else
            checks_require(
                one,
                anywhere(chosen, all,
                         bit == FEATURE_SHEAR ? bit | FEATURE_ENGESSER | FEATURE_HARINGX : bit) !=
                    0,
                "the formulation declares %s, but strains, energy, stresses and C are the same "
                "without this feature; let them depend on the feature, or do not declare it",
                feature_name(bit));
    }
}

enum { MASS_N = TEST_ELEMENT_COORDINATES };

static double size_of(const double A[], int n, int i, int j)
{
    double largest = 0;
    for (int k = 0; k < n; k++)
        largest = fmax(largest, fabs(A[k * n + k]));
    return sqrt(fmax(fabs(A[i * n + i]), 1e-12 * largest) *
                fmax(fabs(A[j * n + j]), 1e-12 * largest));
}

static void symmetric(const test_element *s, const double A[], check_result *one)
{
    const int n = s->coordinates;
    char first[TEST_ELEMENT_WORDS], other[TEST_ELEMENT_WORDS];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            checks_deviation(one, fabs(A[i * n + j] - A[j * n + i]) / size_of(A, n, i, j),
                             "inertia: entry %d, %d (%s, %s) of M is %.6g, but the transposed "
                             "entry is %.6g; make M symmetric%s",
                             i + 1, j + 1, test_element_coordinate(s, i, first),
                             test_element_coordinate(s, j, other), A[i * n + j], A[j * n + i],
                             s->words);
}

/* Checks that a matrix is positive definite: a Cholesky factorisation must exist after scaling to a
 * unit diagonal, which is then slightly increased. */
static void positive(const test_element *s, const double A[], check_result *one)
{
    const int n = s->coordinates;
    double scaled[MASS_N * MASS_N];
    char where[TEST_ELEMENT_WORDS];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            const double size = sqrt(fabs(A[i * n + i]) * fabs(A[j * n + j]));
            scaled[i * n + j] = (size > 0 ? A[i * n + j] / size : 0) + (i == j ? 1e-9 : 0);
        }
    const int pivot = dense_cholesky(n, scaled);
    checks_require(one, pivot == 0,
                   "inertia: M is not positive definite; a motion of the nodes in coordinates 1 to "
                   "%d (the last: %s) has no positive kinetic energy; correct M%s",
                   pivot, test_element_coordinate(s, pivot > 0 ? pivot - 1 : 0, where), s->words);
}

/* Returns v^T M v, twice the kinetic energy, for the velocity field omega x r + shift. */
static double energy(const test_element *s, const node_state x[], const double M[],
                     const double omega[3], const double shift[3])
{
    double v[MASS_N] = {0}, Mv[MASS_N];
    for (int k = 0; k < s->nodes; k++) {
        vec3_cross(omega, x[k].r, v + NODE_COORDINATES * k);
        for (int i = 0; i < 3; i++) {
            v[NODE_COORDINATES * k + i] += shift[i];
            v[NODE_COORDINATES * k + 3 + i] = omega[i];
        }
    }
    dense_mul_vec(s->coordinates, s->coordinates, M, v, Mv);
    return dense_dot(s->coordinates, v, Mv);
}

static double line_mass(const section *c)
{
    return c->matrices ? c->mass[0] : c->density * c->A;
}

static void total(const test_element *s, const node_state x[], const double M[], check_result *one)
{
    static const double none[3] = {0, 0, 0};
    const double mass = line_mass(&s->section) * s->request.length;
    for (int c = 0; c < 3; c++) {
        double shift[3] = {0, 0, 0};
        shift[c] = 1;
        const double found = energy(s, x, M, none, shift);
        checks_deviation(
            one, fabs(found / mass - 1),
            "inertia: the mass along %c is %.6g kg instead of rho A l = %.6g kg; correct M%s",
            "xyz"[c], found, mass, s -> words);
    }
}

static void carried(const test_element *s, const node_state x[], const double M[],
                    check_result *one)
{
    static const double turn[3] = {0.71, -1.93, 1.37};
    const int n = s->coordinates;
    node_state turned[ELEMENT_MAX_NODES];
    double other[MASS_N * MASS_N], T[MASS_N * MASS_N] = {0}, back[MASS_N * MASS_N] = {0},
                                              work[MASS_N * MASS_N], q[4], R[9];
    char first[TEST_ELEMENT_WORDS], second[TEST_ELEMENT_WORDS];
    test_element_rigid_motion(s, turn, x, turned);
    rotation_exp(turn, q);
    rotation_matrix(q, R);
    for (int b = 0; b < n; b += NODE_COORDINATES) {
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < 3; j++)
                T[(b + i) * n + b + i / 3 * 3 + j] = R[3 * (i % 3) + j];
        T[(b + 6) * n + b + 6] = 1;
    }
    s->type.inertia(s->data, turned, NULL, &(inertia_output){.M = other});
    dense_add_congruence(n, n, T, other, back, work);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            checks_deviation(one, fabs(back[i * n + j] - M[i * n + j]) / size_of(M, n, i, j),
                             "inertia: if the element is rotated as a whole and M is rotated back, "
                             "entry %d, %d (%s, %s) is %.6g instead of %.6g; compute M in axes "
                             "that rotate with the element%s",
                             i + 1, j + 1, test_element_coordinate(s, i, first),
                             test_element_coordinate(s, j, second), back[i * n + j], M[i * n + j],
                             s->words);
}

/* Checks the inertia of a straight element that rotates about its first node.
 * FEATURE_ROTARY_INERTIA must add rho l (Ip, Iy, Iz) to the moments of inertia of the line of mass,
 * which are zero about the beam axis. */
static void moments(const test_element *s, check_result *one)
{
    static const double none[3] = {0, 0, 0};
    const section *c = &s->section;
    test_element_request what = s->made;
    test_element line;
    node_state x[ELEMENT_MAX_NODES];
    double M[MASS_N * MASS_N], without[MASS_N * MASS_N];
    fault f = {""};
    if (c->matrices || s->made.curvature[0] != 0 || !(s->made.features & FEATURE_ROTARY_INERTIA))
        return;
    what.features &= ~(unsigned)FEATURE_ROTARY_INERTIA;
    test_element_state(s, 0, 1, x);
    s->type.inertia(s->data, x, NULL, &(inertia_output){.M = M});
    if (test_element_make(&what, &line, &f) == STATUS_OK) {
        line.type.inertia(line.data, x, NULL, &(inertia_output){.M = without});
        const double second[3] = {c->Ip, c->Iy, c->Iz};
        for (int axis = 0; axis < 3; axis++) {
            double omega[3] = {0, 0, 0};
            omega[axis] = 1;
            const double moment = c->density * s->request.length * second[axis],
                         whole = energy(s, x, M, omega, none),
                         thin = energy(&line, x, without, omega, none),
                         found = whole - (axis == 0 ? 0 : thin);
            checks_deviation(one, fabs(found / moment - 1),
                             "inertia: the moment of inertia of the sections about %c is %.6g kg "
                             "m^2 instead of rho l I = %.6g kg m^2; correct M%s",
                             "xyz"[axis], found, moment, s -> words);
            if (axis == 0)
                checks_deviation(
                    one, fabs(thin / moment - 1),
                    "inertia: without rotary inertia, the moment of inertia about x is %.6g kg m^2 "
                    "instead of rho l Ip = %.6g kg m^2; keep the inertia of the twist%s",
                    thin, moment, s->words);
        }
    }
    test_element_free(&line);
}

/* Compares the mass matrix of a straight undeformed element with that of the field that is exact if
 * loads act only at the nodes. */
static void same_as_field(const test_element *s, check_result *one)
{
    const int n = s->coordinates;
    node_state x[ELEMENT_MAX_NODES];
    double M[MASS_N * MASS_N], exact[MASS_N * MASS_N];
    char first[TEST_ELEMENT_WORDS], other[TEST_ELEMENT_WORDS];
    field_mass field;
    field_mass_prepare(&s->request, s->nodes, &field);
    test_element_state(s, 0, 1, x);
    s->type.inertia(s->data, x, NULL, &(inertia_output){.M = M});
    field_mass_inertia(&field, x, NULL, &(inertia_output){.M = exact});
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++)
            checks_deviation(one, fabs(M[i * n + j] - exact[i * n + j]) / size_of(exact, n, i, j),
                             "mass_of_field: entry %d, %d (%s, %s) of M is %.6g, but the field "
                             "that is exact without loads (field/field.h) gives %.6g; correct M, "
                             "or return 0%s",
                             i + 1, j + 1, test_element_coordinate(s, i, first),
                             test_element_coordinate(s, j, other), M[i * n + j], exact[i * n + j],
                             s->words);
}

/* Checks the declaration mass_of_field on an element without warping, because with warping the
 * field of the twist may be approximate. If the section couples shear in y and z, the element has
 * no shear either, because a type may neglect this coupling. */
static void of_field(const test_element *s, check_result *one)
{
    test_element_request what = s->made;
    test_element uniform;
    fault f = {""};
    if (s->type.mass_of_field == NULL || !s->type.mass_of_field(s->options) || s->nodes != 2 ||
        s->scalars > 0 || s->made.curvature[0] != 0)
        return;
    what.features &= ~(unsigned)FEATURE_WARPING;
    if (s->section.F[1] != 0)
        what.features &= ~(unsigned)FEATURE_SHEAR;
    if (test_element_make(&what, &uniform, &f) == STATUS_OK)
        same_as_field(&uniform, one);
    test_element_free(&uniform);
}

static void check(const test_element *s, check_results *c)
{
    node_state x[ELEMENT_MAX_NODES];
    double M[MASS_N * MASS_N];
    checks_current(c, "inertia%s", s->words);
    test_element_state(s, 0.05, 31, x);
    const status outcome = s->type.inertia(s->data, x, NULL, &(inertia_output){.M = M});
    checks_require(checks_open(c, "the element has a mass matrix", 0), outcome == STATUS_OK,
                   "inertia: the status of a moderately strained state is '%s'; compute its M%s",
                   status_name(outcome), s->words);
    if (outcome != STATUS_OK)
        return;
    symmetric(s, M, checks_open(c, "M is symmetric", 1e-13));
    positive(s, M, checks_open(c, "M is positive", 0));
    total(s, x, M, checks_open(c, "the mass is equal to that of the beam", 1e-12));
    carried(s, x, M, checks_open(c, "M rotates with the element", 1e-11));
    moments(s, checks_open(c, "the moments of inertia are equal to those of the beam", 1e-9));
    of_field(s, checks_open(c, "the mass is that of the field, if declared", 1e-9));
}

void checks_mass(const formulation *chosen, check_results *out)
{
    if (!(chosen->type->offers & FEATURE_MASS) || chosen->type->inertia == NULL) {
        checks_not_made(out, "M is symmetric",
                        chosen->type->offers & FEATURE_MASS ? "beamwork computes its inertia"
                                                            : "does not support mass");
        return;
    }
    test_elements_each(chosen, out, check);
}
