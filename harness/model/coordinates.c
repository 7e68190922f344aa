#include "harness/model/model_impl.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

status coordinates_note_left_out(model *m, fault *f, const char *format, ...)
{
    char text[160];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    char **longer = realloc(m->line, (size_t)(m->lines + 1) * sizeof *longer);
    if (longer != NULL)
        m->line = longer;
    char *line = longer != NULL ? strdup(text) : NULL;
    if (line == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory");
    m->line[m->lines++] = line;
    return STATUS_OK;
}

static int leaves_plane(const model *m, int vertex, int component)
{
    const int normal = scene_normal(m->scene), turn = component - SCENE_RX;
    const mesh_vertex *v = &m->mesh.vertex[vertex];
    if (normal == SCENE_NONE)
        return 0;
    if (turn < 0)
        return v->turned ? fabs(v->along[3 * normal + component]) > 0.5 : component == normal;
    if (v->angles == 0)
        return turn != normal;
    return turn < v->angles && fabs(v->axis[turn][normal]) < 0.5 * vec3_norm(v->axis[turn]);
}

/* Returns the kind of motion of a component of a body: SCENE_FREE, SCENE_HELD or a driver. */
static int motion_of(const model *m, int vertex, int component)
{
    if (leaves_plane(m, vertex, component))
        return SCENE_HELD;
    if (vertex >= m->scene->nodes)
        return SCENE_FREE;
    const scene_node *n = &m->scene->node[vertex];
    const int motion =
        component < SCENE_RX ? n->translation[component] : n->angle[component - SCENE_RX];
    if (component < SCENE_RX)
        return motion;
    const mesh_vertex *v = &m->mesh.vertex[vertex];
    const int angle = component - SCENE_RX,
              sequence = n->rotation == SCENE_ROTATION_SEQUENCE || v->angles > 0;
    return (sequence && angle >= v->angles) || (v->idle >> angle & 1) ? SCENE_HELD : motion;
}

/* Returns the unknown driver whose value follows from the condition that the known driver `known`
 * imposes on a component; NONE: none. */
static int conditioned_by(const model *m, int vertex, int component, int known)
{
    for (int d = 0; d < m->scene->drivers; d++) {
        const scene_driver *u = &m->scene->driver[d];
        if (u->value == NULL && u->condition_driver == known && u->condition_node == vertex &&
            u->condition_component == component)
            return d;
    }
    return NONE;
}

static void mark_used(const model *m, char *used)
{
    for (int i = 0; i < m->mesh.elements; i++)
        for (int k = 0; k < m->mesh.nodes; k++)
            used[m->mesh.vertex[m->mesh.element[i].vertex[k]].body] = 1;
    for (int i = m->mesh.discretes - m->mesh.springs; i < m->mesh.discretes; i++)
        for (int k = 0; k < m->mesh.discrete[i].el.nodes; k++)
            used[m->mesh.vertex[m->mesh.discrete[i].el.vertex[k]].body] = 1;
}

static void number_release(model *m, int index)
{
    mesh_vertex *v = &m->mesh.vertex[index];
    const mesh_release *r = release_of(m, index);
    for (int c = 0; c < VERTEX_COORDINATES; c++) {
        const int own = c < SCENE_RX ? c < r->slides : c - SCENE_RX < r->turns;
        v->coordinate[c] = own ? m->mesh.free++ : NONE;
    }
}

typedef struct coordinates_tally {
    int held, across, unused, tied;
} coordinates_tally;

static int is_stretched(const model *m, int index)
{
    int tied = 0;
    for (int c = SCENE_RX; c <= SCENE_RZ && index < m->scene->nodes; c++)
        tied |= model_tie(m, index, c) != NULL;
    return tied && m->mesh.vertex[index].angles > 0 &&
           m->scene->node[index].rotation == SCENE_ROTATION_SPATIAL;
}

static void number_vertex(model *m, int index, int pass, int used, coordinates_tally *of)
{
    mesh_vertex *v = &m->mesh.vertex[index];
    for (int c = 0; c < VERTEX_COORDINATES; c++) {
        const int other = c >= SCENE_RX && is_stretched(m, index);
        const int motion = v->body == index && !other ? motion_of(m, index, c) : SCENE_HELD;
        const scene_tie *tie = index < m->scene->nodes ? model_tie(m, index, c) : NULL;
        if (tie != NULL && !(tie->node == index && tie->coordinate == c)) {
            v->coordinate[c] = NONE;
            of->tied += pass == 0;
            continue;
        }
        const int vector = c >= SCENE_RX && v->vector_driver[0] != NONE;
        const int driver = motion >= 0 && !vector;
        const int condition = driver ? conditioned_by(m, index, c, motion) : NONE;
        const int kept = m->keep_all && v->body == index && motion == SCENE_HELD && !other &&
                         !(v->angles > 0 && c - SCENE_RX >= v->angles);
        const int is_free = (used || tie != NULL) && (motion == SCENE_FREE || condition != NONE);
        if (pass == 0) {
            v->coordinate[c] = NONE;
            if (v->body == index && motion == SCENE_HELD && used && !kept)
                *(leaves_plane(m, index, c) ? &of->across : &of->held) += 1;
            of->unused += motion == SCENE_FREE && !used && c == 0;
            if (is_free)
                v->coordinate[c] = m->mesh.free++;
            if (condition != NONE)
                m->mesh.driver_coordinate[motion] = v->coordinate[c];
        } else if (driver && condition == NONE) {
            if (m->mesh.driver_coordinate[motion] == NONE)
                m->mesh.driver_coordinate[motion] = m->mesh.free + m->mesh.driven++;
            v->coordinate[c] = m->mesh.driver_coordinate[motion];
        } else if (vector || kept) {
            v->coordinate[c] = m->mesh.free + m->mesh.driven++;
        }
    }
}

/* Gives dependent coordinates the index of the coordinate that determines them. */
static void share_coordinates(model *m)
{
    for (int i = 0; i < m->scene->nodes; i++)
        for (int c = 0; c < VERTEX_COORDINATES; c++) {
            const scene_tie *tie = model_tie(m, i, c);
            mesh_vertex *v = &m->mesh.vertex[i];
            if (tie != NULL && !(tie->node == i && tie->coordinate == c))
                v->coordinate[c >= SCENE_RX && v->angles > 0 ? SCENE_RX : c] =
                    m->mesh.vertex[tie->node].coordinate[tie->coordinate];
        }
}

static status number_vertices(model *m, coordinates_tally *of, fault *f)
{
    char *used = calloc((size_t)m->mesh.vertices, 1);
    if (used == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory");
    mark_used(m, used);
    for (int pass = 0; pass < 2; pass++) {
        /* Warping amplitudes are free, so they are numbered between the free and the prescribed
         * coordinates. */
        for (int i = 0; i < m->mesh.first_release; i++)
            number_vertex(m, i, pass, used[i], of);
        if (pass > 0)
            continue;
        for (int i = m->mesh.first_release; i < m->mesh.vertices; i++)
            number_release(m, i);
        for (int i = 0; i < m->mesh.warps; i++)
            m->mesh.warp[i].coordinate = m->mesh.free++;
    }
    free(used);
    share_coordinates(m);
    return of->unused > 0 ? coordinates_note_left_out(m, f, "%d node%s not connected to a member",
                                                      of->unused, of->unused == 1 ? "" : "s")
                          : STATUS_OK;
}

int coordinates_held_turn(const model *m, int node)
{
    const mesh_vertex *v = &m->mesh.vertex[node];
    int held = NONE, count = 0;
    if (v->body != node || v->angles > 0 || v->vector_driver[0] != NONE)
        return NONE;
    for (int k = 0; k < 3; k++) {
        const int coordinate = v->coordinate[SCENE_RX + k];
        if (coordinate != NONE && coordinate < m->mesh.free)
            continue;
        held = v->idle >> k & 1 ? NONE : k;
        count++;
    }
    return count == 1 ? held : NONE;
}

/* Adds the coordinates of a released end after all others, rotations first. */
static void index_release(const model *m, int node, mesh_element *el)
{
    const mesh_vertex *v = &m->mesh.vertex[el->vertex[node]];
    const mesh_release *r = release_of(m, el->vertex[node]);
    for (int k = 0; k < r->turns; k++)
        el->index[el->columns++] = v->coordinate[SCENE_RX + k];
    for (int k = 0; k < r->slides; k++)
        el->index[el->columns++] = v->coordinate[k];
    const int swings = m->mesh.vertex[v->body].led;
    for (int c = SCENE_RX; c <= SCENE_RZ && r->turns == 3 && vec3_norm(v->offset) == 0; c++)
        if (c > SCENE_RX || !swings)
            el->index[NODE_COORDINATES * node + c] = NONE;
}

static void index_element(model *m, mesh_element *el)
{
    el->plain = 1;
    el->columns = NODE_COORDINATES * el->nodes;
    for (int k = 0; k < el->nodes; k++)
        for (int i = 0; i < el->scalars; i++)
            el->index[el->columns++] = mesh_scalar(el, k, i) == NONE
                                           ? NONE
                                           : m->mesh.warp[mesh_scalar(el, k, i)].coordinate;
    for (int k = 0; k < el->nodes; k++) {
        const mesh_vertex *v = &m->mesh.vertex[el->vertex[k]], *body = &m->mesh.vertex[v->body];
        for (int c = 0; c < VERTEX_COORDINATES; c++)
            el->index[NODE_COORDINATES * k + c] = body->coordinate[c];
        el->index[NODE_COORDINATES * k + 6] =
            el->warp[k] == NONE ? NONE : m->mesh.warp[el->warp[k]].coordinate;
        el->plain &= v->body == el->vertex[k] && body->angles == 0 && !body->turned;
        if (release_of(m, el->vertex[k]) != NULL)
            index_release(m, k, el);
    }
}

static int fixed_warps(const model *m, int *absent)
{
    int fixed = 0;
    for (int i = 0; i < m->mesh.elements; i++)
        for (int k = 0; k < m->mesh.nodes; k++) {
            unsigned features;
            features_of_section(m, m->mesh.kind[m->mesh.element[i].kind].section, &features, NULL);
            *absent += !(features & FEATURE_WARPING);
            fixed += (features & FEATURE_WARPING) && m->mesh.element[i].warp[k] == NONE;
        }
    return fixed;
}

static int fixed_scalars(const model *m)
{
    int fixed = 0;
    for (int i = 0; i < m->mesh.elements; i++)
        for (int k = 0; k < m->mesh.nodes; k++)
            fixed += __builtin_popcount(m->mesh.element[i].held[k]);
    return fixed;
}

/* Writes one line for each kind of eliminated coordinate (model_left_out). */
static status note_left_out(model *m, const coordinates_tally *of, fault *f)
{
    int absent = 0, attached = 0;
    for (int i = 0; i < m->scene->nodes; i++)
        attached += m->mesh.vertex[i].body != i;
    const int fixed = fixed_warps(m, &absent);
    if (of->held > 0)
        TRY(coordinates_note_left_out(m, f, "%d fixed degrees of freedom", of->held));
    if (of->tied > 0)
        TRY(coordinates_note_left_out(m, f, "%d coordinates determined by constraints", of->tied));
    if (m->scene->plane != SCENE_SPACE)
        TRY(coordinates_note_left_out(m, f, "%d coordinates out of the plane %s", of->across,
                                      scene_plane_name(m->scene)));
    if (attached > 0)
        TRY(coordinates_note_left_out(m, f, "%d coordinates of %d node%s with a rigid body",
                                      6 * attached, attached,
                                      attached == 1 ? " that moves" : "s that move"));
    if (absent > 0)
        TRY(coordinates_note_left_out(
            m, f,
            absent == 1 ? "warping amplitude of %d element end at which nothing warps"
                        : "warping amplitudes of %d element ends at which nothing warps",
            absent));
    if (fixed > 0)
        TRY(coordinates_note_left_out(m, f, "%d warping amplitude%s held at zero", fixed,
                                      fixed == 1 ? "" : "s"));
    if (fixed_scalars(m) > 0)
        TRY(coordinates_note_left_out(
            m, f, "%d additional unknowns held at zero at ends with restrained warping",
            fixed_scalars(m)));
    if (m->mesh.driven > 0)
        TRY(coordinates_note_left_out(m, f, "rows of %d prescribed coordinate%s", m->mesh.driven,
                                      m->mesh.driven == 1 ? "" : "s"));
    return STATUS_OK;
}

status coordinates_number(model *m, fault *f)
{
    coordinates_tally of = {0};
    for (int i = 0; i < m->scene->drivers; i++)
        m->mesh.driver_coordinate[i] = NONE;
    TRY(number_vertices(m, &of, f));
    for (int i = 0; i < m->mesh.elements; i++)
        index_element(m, &m->mesh.element[i]);
    for (int i = 0; i < m->mesh.discretes; i++)
        index_element(m, &m->mesh.discrete[i].el);
    return note_left_out(m, &of, f);
}

void model_words_put(model_words *w, const char *format, ...)
{
    va_list arguments;
    if (w->used >= w->room)
        return;
    va_start(arguments, format);
    w->used += (size_t)vsnprintf(w->text + w->used, w->room - w->used, format, arguments);
    va_end(arguments);
}
