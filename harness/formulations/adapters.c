#include "harness/formulations/formulations_impl.h"

#include <string.h>

#include "elements/shared/masses.h"
#include "harness/formulations/adapted.h"

static size_t data_size(const element_request *request)
{
    const element_type *given = request->type;
    return sizeof(element_data) + (given->data_size != NULL ? given->data_size(request) : 0);
}

static status prepare(const element_request *request, element_data *out, fault *f)
{
    const element_type *given = request->type;
    out->given = given;
    out->nodes = element_nodes(given, request->options);
    out->scalars = element_scalars(given, request->options);
    if (absolute_is(given, request->options))
        out->strains = ABSOLUTE_NODE * out->nodes;
    else
        out->strains = given->force == NULL
                           ? element_strains(given, request->options)
                           : places_strains(out->nodes, out->scalars)(request->options);
    element_places(given, request->options, out->place);
    out->history = element_history(given, request->options);
    out->length = request->length;
    field_mass_prepare(request, out->nodes, &out->mass);
    return given->prepare(request, (element_data *)out->own, f);
}

static status stress(const element_data *d, const double e[], const double inner[],
                     stress_output *out)
{
    return d->given->stress(adapted_own(d), e, inner, out);
}

static double update(const element_data *d, const double de[], const double memory[],
                     double inner[])
{
    return d->given->update(adapted_own(d), de, memory, inner);
}

static void rest(const element_data *d, double inner[])
{
    d->given->rest(adapted_own(d), inner);
}

static void geometric(const element_data *d, const double sigma[], double G[])
{
    d->given->geometric(adapted_own(d), sigma, G);
}

static status inertia(const element_data *d, const node_state x[],
                      const element_rotating_frame *frame, inertia_output *out)
{
    return d->given->inertia(adapted_own(d), x, frame, out);
}

static const char *trouble(const element_data *d)
{
    return d->given->trouble(adapted_own(d));
}

static void stress_many(int count, const element_data *const data[], const double *const e[],
                        const double *const inner[], stress_output out[], status outcome[])
{
    const element_data *own[ADAPTED_TOGETHER];
    for (int i = 0; i < count; i += ADAPTED_TOGETHER) {
        const int part = adapted_owns(count - i, data + i, own);
        data[0]->given->stress_many(part, own, e + i, inner + i, out + i, outcome + i);
    }
}

static void unstressed(const element_data *d, const double more[3], const node_state x[],
                       element_data *out)
{
    memcpy(out, d, sizeof *out);
    d->given->unstressed(adapted_own(d), more, x, (element_data *)out->own);
}

static void begin(const element_data *d, const node_state x[], double history[])
{
    d->given->begin(adapted_own(d), x, history);
}

static void commit(const element_data *d, const node_state x[], double history[])
{
    d->given->commit(adapted_own(d), x, history);
}

static void damping(const element_data *d, double V[])
{
    d->given->damping(adapted_own(d), V);
}

static void line(const element_data *d, const node_state x[], int count, line_output out[])
{
    d->given->line(adapted_own(d), x, count, out);
}

static double tension(const element_data *d, const double sigma[])
{
    return d->given->tension(adapted_own(d), sigma);
}

static void along(int count, const element_data *const data[], const node_state x[],
                  along_output out[], status outcome[])
{
    const element_data *own[ADAPTED_TOGETHER];
    for (int i = 0; i < count; i += ADAPTED_TOGETHER) {
        const int part = adapted_owns(count - i, data + i, own);
        data[0]->given->along(part, own, x + (ptrdiff_t)i * data[0]->nodes, out + i, outcome + i);
    }
}

static status spread(const element_data *d, const node_state x[],
                     const element_rotating_frame *frame, inertia_output *out)
{
    const status outcome = field_mass_inertia(&d->mass, x, frame, out);
    inertia_widen(NODE_COORDINATES * d->nodes, adapted_coordinates(d), out);
    return outcome;
}

static int always(const double options[])
{
    (void)options;
    return 1;
}

static void wrap(const element_type *given, element_type *out)
{
    *out = *given;
    out->data_size = data_size;
    out->prepare = prepare;
    out->stress = stress;
    out->update = given->update != NULL ? update : NULL;
    out->rest = given->rest != NULL ? rest : NULL;
    out->geometric = given->geometric != NULL ? geometric : NULL;
    out->inertia = given->inertia != NULL ? inertia : spread;
    out->spreads = given->inertia != NULL ? given->spreads : 1;
    out->mass_of_field = given->inertia != NULL ? given->mass_of_field : always;
    out->strain = differences_strain;
    out->strain_many = given->strain_many != NULL ? differences_strain_many : NULL;
    out->stress_many = given->stress_many != NULL ? stress_many : NULL;
    out->force_many = NULL;
    out->equations_many = NULL;
    out->along = given->along != NULL ? along : NULL;
    out->unstressed = given->unstressed != NULL ? unstressed : NULL;
    out->tension = given->tension != NULL ? tension : NULL;
    out->trouble = given->trouble != NULL ? trouble : NULL;
    out->begin = given->begin != NULL ? begin : NULL;
    out->commit = given->commit != NULL ? commit : NULL;
    out->damping = given->damping != NULL ? damping : NULL;
    out->line = given->line != NULL ? line : NULL;
}

static void make_relative(const element_type *given, const double options[], element_type *out)
{
    out->offers &= ~(unsigned)FEATURE_CURVATURE;
    out->strains = places_strains(element_nodes(given, options), element_scalars(given, options));
    out->inner = NULL;
    out->memory = NULL;
    out->strain = places_strain;
    out->stress = relative_stress;
    out->strain_many = NULL;
    out->stress_many = given->force_many != NULL ? relative_stress_many : NULL;
    out->geometric = relative_geometric;
}

static void make_absolute(const element_type *given, const double options[], element_type *out)
{
    make_relative(given, options, out);
    out->strains = absolute_strains(element_nodes(given, options));
    out->strain = absolute_strain;
    out->stress = absolute_stress;
    out->stress_many = given->force_many != NULL ? absolute_stress_many : NULL;
    out->geometric = NULL; /* so linear buckling is rejected */
    out->begin = absolute_begin;
    out->commit = absolute_commit;
}

static status refuse(const element_type *given, const char *what, fault *f)
{
    return fault_set(f, STATUS_REFUSED, "formulation %s: %s", given->name, what);
}

static status refuse_count(const element_type *given, const char *what, int count, int least,
                           int most, fault *f)
{
    return fault_set(f, STATUS_REFUSED, "formulation %s: the number of %s is %d; give %d to %d",
                     given->name, what, count, least, most);
}

static status check_history(const element_type *given, const double options[], fault *f)
{
    const int count = element_history(given, options);
    if (count < 0 || count > ELEMENT_MAX_HISTORY)
        return refuse_count(given, "history values", count, 0, ELEMENT_MAX_HISTORY, f);
    if (given->force != NULL && count == 0 && given->limits & LIMIT_NOT_OBJECTIVE)
        return refuse(given,
                      "with 'force' and without 'history', strains are relative to the first node "
                      "and thus objective; add 'history', or remove LIMIT_NOT_OBJECTIVE",
                      f);
    if (count == 0 && given->limits & LIMIT_PATH_DEPENDENT)
        return refuse(given,
                      "LIMIT_PATH_DEPENDENT requires 'history'; add 'history', or remove "
                      "LIMIT_PATH_DEPENDENT",
                      f);
    if (absolute_is(given, options) && element_nodes(given, options) > ABSOLUTE_NODES)
        return refuse_count(given, "nodes, with 'force' and 'history',",
                            element_nodes(given, options), 2, ABSOLUTE_NODES, f);
    if (count > 0 && given->force != NULL && given->leaves & LEAVES_FORCE)
        return refuse(given,
                      "with 'history', an energy is given by 'strain' and 'stress'; give these, or "
                      "let 'force' compute forces",
                      f);
    if (count > 0 && given->commit == NULL)
        return refuse(
            given, "'history' requires 'commit', which computes the history values of a state", f);
    if (count > 0 && (given->along != NULL || given->unstressed != NULL ||
                      given->equations_many != NULL || given->line != NULL))
        return refuse(given,
                      "an element with 'history' cannot have 'along', 'unstressed', "
                      "'equations_many' and 'line'; remove them",
                      f);
    return STATUS_OK;
}

static status check_places(const element_type *given, const double options[], fault *f)
{
    const int nodes = element_nodes(given, options);
    double place[ELEMENT_MAX_NODES], share[ELEMENT_MAX_NODES];
    element_places(given, options, place);
    int good = place[0] == 0 && place[nodes - 1] == 1;
    for (int k = 1; k < nodes; k++)
        good = good && place[k] > place[k - 1];
    if (!good)
        return refuse(given,
                      "'places' do not increase from 0 to 1; give increasing numbers, 0 for the "
                      "first node and 1 for the last",
                      f);
    lumped_shares(nodes, place, share);
    for (int k = 0; k < nodes; k++)
        if (!(share[k] > 0))
            return fault_set(f, STATUS_REFUSED,
                             "formulation %s: the polynomial through the nodes gives node %d the "
                             "share %.3g of the mass, which must be positive; choose other "
                             "'places', for example Gauss-Lobatto points",
                             given->name, k + 1, share[k]);
    return STATUS_OK;
}

static status check_scalars(const element_type *given, const double options[], fault *f)
{
    const int count = element_scalars(given, options),
              all = element_nodes(given, options) * (NODE_COORDINATES + count);
    if (count < 0 || count > ELEMENT_MAX_SCALARS)
        return refuse_count(given, "additional unknowns of a node", count, 0, ELEMENT_MAX_SCALARS,
                            f);
    if (all > ELEMENT_MAX_COORDINATES)
        return fault_set(f, STATUS_REFUSED,
                         "formulation %s: %d coordinates of an element exceed %d; use fewer nodes "
                         "or fewer additional unknowns",
                         given->name, all, ELEMENT_MAX_COORDINATES);
    if (count > 0 && given->force != NULL && element_history(given, options) > 0)
        return refuse(given,
                      "with additional unknowns, a history requires 'strain' and 'stress'; give "
                      "these instead of 'force'",
                      f);
    if (count > 0 && (given->along != NULL || given->unstressed != NULL ||
                      given->equations_many != NULL || given->line != NULL))
        return refuse(given,
                      "an element with additional unknowns cannot have 'along', 'unstressed', "
                      "'equations_many' and 'line'; remove them",
                      f);
    return STATUS_OK;
}

static status check(const element_type *given, const double options[], fault *f)
{
    const int nodes = element_nodes(given, options);
    if (given->prepare == NULL)
        return refuse(
            given, "'prepare' is missing; add it, because it passes the section to the element", f);
    if ((given->force != NULL) == (given->strain != NULL || given->stress != NULL))
        return refuse(given,
                      "an element is defined by either 'strain' and 'stress' or 'force'; give "
                      "exactly one of the two",
                      f);
    if (given->force == NULL && (given->strain == NULL || given->stress == NULL))
        return refuse(given, "'strain' or 'stress' is missing; give both", f);
    if (given->force != NULL && (given->along != NULL || given->tension != NULL))
        return refuse(given,
                      "'along' and 'tension' require 'strain' and 'stress'; give these instead of "
                      "'force', or remove 'along' and 'tension'",
                      f);
    if (given->force != NULL && given->damping != NULL)
        return refuse(given,
                      "'damping' is a matrix for the strains that the element computes; give "
                      "'strain' and 'stress' instead of 'force', or remove 'damping'",
                      f);
    if (nodes < 2 || nodes > ELEMENT_MAX_NODES)
        return refuse_count(given, "nodes", nodes, 2, ELEMENT_MAX_NODES, f);
    TRY(check_places(given, options, f));
    if (given->force == NULL && (element_strains(given, options) < 1 ||
                                 element_strains(given, options) > ELEMENT_MAX_STRAINS))
        return refuse_count(given, "strains", element_strains(given, options), 1,
                            ELEMENT_MAX_STRAINS, f);
    TRY(check_scalars(given, options, f));
    return check_history(given, options, f);
}

status adapters_complete(const element_type *given, const double options[], element_type *out,
                         fault *f)
{
    TRY(check(given, options, f));
    *out = *given;
    if (given->leaves == 0 && given->force == NULL && given->inertia != NULL &&
        given->data_size != NULL && element_history(given, options) == 0)
        return STATUS_OK;
    wrap(given, out);
    if (absolute_is(given, options))
        make_absolute(given, options, out);
    else if (given->force != NULL)
        make_relative(given, options, out);
    return STATUS_OK;
}

int adapters_history(const element_type *given, const double options[])
{
    const int own = element_history(given, options);
    return absolute_is(given, options) ? own + ABSOLUTE_KEPT * element_nodes(given, options) : own;
}

double adapters_error(const element_type *given)
{
    if (given->force != NULL && given->leaves & LEAVES_FORCE)
        return 1e-10;
    return given->force != NULL || given->leaves != 0 ? 1e-11 : 0;
}

const char *adapters_words(const element_type *given)
{
    if (given->force != NULL && given->leaves & LEAVES_FORCE)
        return "forces and stiffness (differences of its energy instead)";
    if (given->force != NULL && given->leaves & LEAVES_TANGENT)
        return "stiffness (differences of its forces instead)";
    if (given->leaves & LEAVES_J)
        return "derivatives of its strains (differences instead)";
    return given->leaves & LEAVES_H ? "second derivatives of its strains (differences instead)"
                                    : "";
}
