#include "harness/model/model_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/shared/masses.h"
#include "harness/formulations/formulations.h"

/* Returns 1 if elements compute the nodal forces of loads along members: if the type can do so and
 * has two nodes, and if the scene has such loads and no motion. */
static int takes_loads(const model *m)
{
    int along = 0, moves = 0;
    for (int i = 0; i < m->scene->loads; i++)
        along |=
            scene_load_along(&m->scene->load[i]) && m->scene->load[i].kind != SCENE_TEMPERATURE;
    for (int i = 0; i < m->scene->analyses; i++)
        moves |= m->scene->analysis[i].kind == SCENE_MOTION;
    return m->mesh.type->along != NULL && m->mesh.nodes == 2 && along && !moves;
}

static status choose_options(model *m, const double options[], fault *f)
{
    const element_type *t = m->given;
    parameter_defaults(t->options, m->options);
    if (options != NULL)
        for (int i = 0; i < parameter_count(t->options); i++)
            m->options[i] = options[i];
    TRY(adapters_complete(t, m->options, &m->completed, f));
    m->mesh.type = &m->completed;
    m->mesh.nodes = element_nodes(t, m->options);
    element_places(t, m->options, m->mesh.place);
    lumped_shares(m->mesh.nodes, m->mesh.place, m->mesh.share);
    m->mesh.scalars = element_scalars(t, m->options);
    m->mesh.coordinates = (NODE_COORDINATES + m->mesh.scalars) * m->mesh.nodes;
    m->mesh.strains = element_strains(m->mesh.type, m->options);
    m->mesh.inner = element_inner(m->mesh.type, m->options);
    m->mesh.memory = element_memory(m->mesh.type, m->options);
    m->mesh.history = adapters_history(t, m->options);
    m->mesh.takes = takes_loads(m);
    m->mesh.frees = scene_is_free(m->scene, NULL);
    if (m->mesh.history > 0 && m->mesh.frees)
        return fault_set(f, STATUS_REFUSED,
                         "temperatures, elongations and initial strains of members require strains "
                         "that depend only on the state, but %s has a history; use another "
                         "formulation",
                         t->name);
    if (m->mesh.scalars > 0 && m->mesh.frees)
        return fault_set(f, STATUS_REFUSED,
                         "temperatures, elongations and initial strains of members are not "
                         "available for formulations with additional unknowns, such as %s; use "
                         "another formulation",
                         t->name);
    m->mesh.work_size = m->mesh.strains * (m->mesh.coordinates + m->mesh.strains + 2) +
                        m->mesh.memory + (m->mesh.takes ? slot_along(m) : 0);
    return STATUS_OK;
}

static int stations_of(const scene_analysis *a)
{
    return scene_path_of(a) != NULL ? scene_path_of(a)->stations : 0;
}

/* Checks a lower bound of the memory for elements, matrix patterns and states stored along the
 * path. REFUSED: the machine has less memory. */
static status check_memory(const model *m, fault *f)
{
    const double entries = (double)m->mesh.coordinates * m->mesh.coordinates / 2,
                 words = 10.0 * (m->mesh.nodes - 1) + 2 * m->mesh.strains + m->mesh.inner +
                         m->mesh.history;
    double count = 0, states = 3;
    char what[80];
    for (int i = 0; i < m->scene->members; i++)
        count += (double)division_pieces(&m->division, i) * m->division.each[i];
    for (int i = 0; i < m->scene->analyses; i++)
        states += stations_of(&m->scene->analysis[i]);
    const double each = sizeof(mesh_element) + (m->mesh.nodes - 1) * sizeof(mesh_vertex) +
                        sizeof(double) * (m->mesh.work_size + states * words) +
                        (2 * sizeof(int) + sizeof(double)) * entries;
    snprintf(what, sizeof what, "%.0f elements", count);
    return memory_check(count * each, what, "give fewer", f);
}

static status allocate(model *m, fault *f)
{
    return kinematics_state_alloc(m, &m->rest, f);
}

static int has_rates(const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_MOTION || s->analysis[i].kind == SCENE_HARMONIC ||
            s->analysis[i].damped || scene_inputs_flutter(s, i))
            return 1;
    return 0;
}

static status note_dashpots(model *m, fault *f)
{
    const scene *s = m->scene;
    for (int i = 0; i < s->springs && !has_rates(s); i++)
        if (scene_spring_damps(&s->spring[i]))
            return coordinates_note_left_out(
                m, f,
                "damping of %s%s, which no analysis of the scene uses; add a motion, a harmonic "
                "analysis or damped modes",
                scene_called(s, SCENE_SPRINGS, i).text, s->springs > i + 1 ? " and others" : "");
    return STATUS_OK;
}

static int is_at_rest(const scene *s)
{
    for (int i = 0; i < s->analyses; i++) {
        const scene_column column = scene_column_of(s, i);
        if (column == SCENE_OF_LINEAR || column == SCENE_OF_BUCKLING || column == SCENE_OF_MODAL ||
            column == SCENE_OF_MODAL_LINEAR || column == SCENE_OF_COMPLIANCE)
            return 1;
    }
    return 0;
}

static status note_tables(model *m, fault *f)
{
    const scene *s = m->scene;
    for (int i = 0; i < s->springs && is_at_rest(s); i++)
        for (int k = 0; k < SPRING_STRAINS; k++)
            if (s->spring[i].table[k].at.stations > 2)
                return coordinates_note_left_out(
                    m, f,
                    "tables of %s%s beyond their linear part at 0, in analyses without a path",
                    scene_called(s, SCENE_SPRINGS, i).text,
                    i + 1 < s->springs ? " and others" : "");
    return STATUS_OK;
}

static status note_asymmetry(model *m, int spring, const char *of, double asymmetry, fault *f)
{
    return asymmetry > 0
               ? coordinates_note_left_out(
                     m, f, "the asymmetry of the %s of %s, %.1e of its diagonal: the mean is used",
                     of, scene_called(m->scene, SCENE_SPRINGS, spring).text, asymmetry)
               : STATUS_OK;
}

static status note_means(model *m, fault *f)
{
    const scene *s = m->scene;
    double axis[3];
    for (int i = 0; i < s->nodes; i++)
        if (scene_idle_turn(s, i, axis) != 0)
            TRY(coordinates_note_left_out(
                m, f,
                "the free rotation of %s, which all its members release, so nothing depends on it",
                scene_called(s, SCENE_NODES, i).text));
    for (int i = 0; i < s->sections; i++)
        if (m->section[i].asymmetry > 0)
            TRY(coordinates_note_left_out(
                m, f, "the asymmetry of the matrices of %s, %.1e of the diagonal; the mean is used",
                scene_called(s, SCENE_SECTIONS, i).text, m->section[i].asymmetry));
    for (int i = 0; i < s->springs; i++) {
        TRY(note_asymmetry(m, i, "stiffness", s->spring[i].asymmetry, f));
        TRY(note_asymmetry(m, i, "damping", s->spring[i].damping_asymmetry, f));
    }
    return note_dashpots(m, f);
}

static status divide(model *m, fault *f)
{
    if (m->requested < 1)
        return fault_set(f, STATUS_REFUSED, "%d elements are too few; give at least 1",
                         m->requested);
    if (m->scene->members < 1)
        return fault_set(f, STATUS_REFUSED, "scene %s has no member; add one", m->scene->name);
    TRY(division_make(m->scene, m->requested, &m->division, f));
    return check_memory(m, f);
}

/* Finds the groups of nodes that constraints join. joined[2 i]: first node of the group of node i;
 * joined[2 i + 1]: next node of the group, or NONE. */
static status join_nodes(model *m, fault *f)
{
    const int n = m->scene->nodes;
    int *joined = m->mesh.joined = malloc((size_t)(2 * n + 1) * sizeof *joined);
    if (joined == NULL)
        return fault_memory(f, "constraints");
    for (int i = 0; i < n; i++)
        joined[2 * i] = i;
    for (int k = 0; k < 6 * n; k++) {
        const int other = m->mesh.tie[k].node;
        int a = k / 6, b = other == SCENE_NONE ? a : other;
        while (joined[2 * a] != a)
            a = joined[2 * a];
        while (joined[2 * b] != b)
            b = joined[2 * b];
        joined[a < b ? 2 * b : 2 * a] = a < b ? a : b;
    }
    for (int i = 0; i < n; i++)
        joined[2 * i] = joined[2 * joined[2 * i]];
    for (int i = n - 1; i >= 0; i--) {
        joined[2 * i + 1] = NONE;
        for (int j = i + 1; j < n && joined[2 * i + 1] == NONE; j++)
            if (joined[2 * j] == joined[2 * i])
                joined[2 * i + 1] = j;
    }
    return STATUS_OK;
}

static status build(model *m, const model_request *request, fault *f)
{
    const scene *s = request->scene;
    const element_type *type = request->type;
    char words[200];
    if (missing_refused(s, type, words, sizeof words))
        return fault_set(
            f, STATUS_REFUSED,
            "formulation %s does not support %s, which scene %s requires; use another formulation",
            type->name, words, s->name);
    m->omits = missing_omits(s, type) | request->omit;
    TRY(profile_scene(m, f));
    m->features = (features_needed_of(s, type) & ~m->omits) | (type->offers & FEATURE_CURVATURE);
    if (m->keep_all)
        m->features |= (FEATURE_WARPING | FEATURE_ECCENTRIC) & ~(m->omits | s->omits);
    TRY(choose_options(m, request->options, f));
    m->mesh.driver_coordinate =
        malloc(((size_t)s->drivers + 1) * sizeof *m->mesh.driver_coordinate);
    if (m->mesh.driver_coordinate == NULL)
        return fault_memory(f, "motions");
    TRY(divide(m, f));
    if (s->constraints > 0) {
        m->mesh.tie = malloc((size_t)(6 * s->nodes + 1) * sizeof *m->mesh.tie);
        if (m->mesh.tie == NULL)
            return fault_memory(f, "constraints");
        TRY(scene_ties(s, m->mesh.tie, f));
        TRY(join_nodes(m, f));
    }
    TRY(mesh_build(m, f));
    TRY(discrete_build(m, f));
    TRY(turns_build(m, f));
    TRY(coordinates_number(m, f));
    TRY(note_means(m, f));
    TRY(note_tables(m, f));
    if (lacks_of(s, type, words, sizeof words))
        TRY(coordinates_note_left_out(m, f, "%s", words));
    if (m->omits != 0) {
        missing_omit_words(m->omits, words);
        TRY(coordinates_note_left_out(m, f, "physics: %s", words));
    }
    if (adapters_words(type)[0] != '\0')
        TRY(coordinates_note_left_out(m, f, "%s", adapters_words(type)));
    if (type->limits & LIMIT_NOT_OBJECTIVE)
        TRY(coordinates_note_left_out(
            m, f, "objectivity: rigid rotations of a deformed element change its strains"));
    if (type->limits & LIMIT_PATH_DEPENDENT)
        TRY(coordinates_note_left_out(
            m, f, "path independence: results depend on the path and its steps"));
    if (process_serves(type))
        TRY(coordinates_note_left_out(m, f,
                                      "in all run times: that of the process of the formulation"));
    return allocate(m, f);
}

status model_alloc_imperfect(const model_request *request, const model_imperfect *imperfect,
                             model **out, fault *f)
{
    model *m = calloc(1, sizeof *m);
    *out = NULL;
    if (m == NULL)
        return fault_memory(f, "a model");
    m->scene = request->scene;
    m->imperfect = imperfect;
    m->given = m->mesh.type = request->type;
    m->keep_all = request->keep_all;
    m->requested = request->elements;
    const status outcome = build(m, request, f);
    if (outcome == STATUS_OK)
        *out = m;
    else
        model_free(m);
    return outcome;
}

status model_alloc(const model_request *request, model **out, fault *f)
{
    return model_alloc_imperfect(request, NULL, out, f);
}

static status again(const model *m, int elements, model **out, fault *f)
{
    const model_request request = {m->scene, m->given, m->options, elements, m->keep_all, m->omits};
    return model_alloc_imperfect(&request, m->imperfect, out, f);
}

status model_coarse(const model *m, model **out, fault *f)
{
    return again(m, 1, out, f);
}

status model_halved(const model *m, model **out, fault *f)
{
    return again(m, 2 * m->requested, out, f);
}

void model_free(model *m)
{
    if (m == NULL)
        return;
    for (int i = 0; i < m->mesh.kinds; i++) {
        free(m->mesh.kind[i].data);
        free(m->mesh.kind[i].inner);
    }
    for (int i = 0; i < m->lines; i++)
        free(m->line[i]);
    free(m->line);
    free(m->section);
    free(m->profile);
    free(m->kind_of_section);
    free(m->mesh.vertex);
    free(m->mesh.release);
    free(m->mesh.element);
    free(m->triad);
    free(m->mesh.kind);
    free(m->mesh.warp);
    free(m->mesh.discrete);
    free(m->founded);
    free(m->turn);
    free(m->mesh.first_element);
    division_free(&m->division);
    free(m->mesh.driver_coordinate);
    free(m->mesh.tie);
    free(m->mesh.joined);
    kinematics_state_free(m->rest);
    free(m);
}

int model_spreads(const model *m, int analysis)
{
    return features_spreads(m->scene, analysis, m->mesh.type, m->options);
}

model_size model_sizes(const model *m)
{
    return (model_size){m->mesh.elements, m->mesh.vertices, m->mesh.free,  m->mesh.driven,
                        m->mesh.strains,  m->mesh.inner,    m->mesh.kinds, m->features};
}

const char *model_trouble(const model *m)
{
    return m->mesh.type->trouble != NULL && m->mesh.kinds > 0
               ? m->mesh.type->trouble(m->mesh.kind[0].data)
               : NULL;
}

int model_stresses(const model *m)
{
    return m->mesh.elements * m->mesh.strains + SPRING_STRAINS * m->mesh.springs;
}

const scene *model_scene(const model *m)
{
    return m->scene;
}

int model_body(const model *m, int vertex)
{
    return m->mesh.vertex[vertex].body;
}

int model_is_released(const model *m, int vertex)
{
    return vertex >= m->mesh.first_release;
}

double model_length(const model *m)
{
    return m->size;
}

double model_mass(const model *m)
{
    double mass = 0;
    for (int i = 0; i < m->mesh.elements; i++) {
        const mesh_kind *kind = &m->mesh.kind[m->mesh.element[i].kind];
        const section *c = &m->section[kind->section];
        mass += kind->length * (c->matrices ? c->mass[0] : c->density * c->A);
    }
    return mass;
}

unsigned model_features(const model *m)
{
    return m->features;
}

int model_keeps_all(const model *m)
{
    return m->keep_all;
}

const double *model_options(const model *m)
{
    return m->options;
}

const division *model_division(const model *m)
{
    return &m->division;
}

int model_left_out(const model *m, const char *const **lines)
{
    *lines = (const char *const *)m->line;
    return m->lines;
}

unsigned model_leaves(const model *m)
{
    return m->mesh.type->leaves;
}

const char *model_formulation(const model *m)
{
    return m->mesh.type->name;
}

const section *model_section(const model *m, int index)
{
    return &m->section[index];
}

int model_member_vertices(const model *m, int member, int vertex[])
{
    const int first = m->mesh.first_element[member], last = m->mesh.first_element[member + 1] - 1;
    const int count = (last - first + 1) * (m->mesh.nodes - 1) + 1;
    if (vertex == NULL)
        return count;
    for (int i = first; i <= last; i++)
        for (int k = 0; k < m->mesh.nodes; k++)
            vertex[(i - first) * (m->mesh.nodes - 1) + k] = m->mesh.element[i].vertex[k];
    return count;
}

int model_shape(const model *m, const double x[], double *u, double *position)
{
    if (position != NULL)
        for (int v = 0; v < m->mesh.vertices; v++)
            memcpy(&position[3 * v], m->mesh.vertex[v].position, 3 * sizeof(double));
    if (u == NULL)
        return m->mesh.vertices;
    memset(u, 0, (size_t)m->mesh.vertices * NODE_COORDINATES * sizeof *u);
    for (int i = 0; i < m->mesh.elements; i++) {
        double local[ELEMENT_MAX_COORDINATES];
        kinematics_local(m, m->rest, &m->mesh.element[i], x, local);
        for (int k = 0; k < m->mesh.nodes; k++)
            memcpy(&u[NODE_COORDINATES * m->mesh.element[i].vertex[k]],
                   &local[NODE_COORDINATES * k], NODE_COORDINATES * sizeof(double));
    }
    return m->mesh.vertices;
}
