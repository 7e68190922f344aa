#include "harness/import_export/import_export_impl.h"

#include <stdlib.h>

#include "cases/scene/scene.h"

/* Writes the lines of *NODE for the two reference nodes of each body. */
static void body_write_nodes(const body_numbers *, const scene *s, FILE *to);
static void body_write(const body_numbers *, const scene *s, const brick bricks[], FILE *to);
/* Writes *BOUNDARY with the prescribed coordinates at `path`. acting: see scene_acting_of. */
static void body_write_state(const body_numbers *, const scene *s, int acting, double path,
                             FILE *to);
/* Like body_write_state, for a small motion in which the prescribed coordinates do not move.
 * released: free components of `node` (bit i). */
static void body_write_held(const body_numbers *, const scene *s, int node, unsigned released,
                            FILE *to);
static status answers_write(const scene *s, const body_numbers *bodies, FILE *to, fault *f);
static status path_points_of(const scene *s, int analysis, path_points *out, fault *f);
static int path_points_requested(const scene *s, int analysis, const scene_quantity *q,
                                 double point);

status deck_check(const deck_request *r, fault *f)
{
    if (r->elements < 1 || r->elements > DECK_MOST_ELEMENTS)
        return fault_set(f, STATUS_REFUSED,
                         "%d elements along a member are not possible; give -n a number from 1 to "
                         "%d, such as 20",
                         r->elements, DECK_MOST_ELEMENTS);
    if (r->scene->plane != SCENE_SPACE)
        return fault_set(f, STATUS_REFUSED,
                         "scene %.60s is confined to a plane, but solids are not; remove plane: %s "
                         "from the scene",
                         r->scene->name, scene_plane_name(r->scene));
    TRY(export_support_check(r->scene, f));
    return export_support_requests(r->scene, f);
}

/* The numbers of bodies follow those of the bricks. */
static status make_bricks(const deck_request *r, brick out[], body_numbers *bodies, fault *f)
{
    int node = 1, element = 1;
    for (int i = 0; i < r->scene->members; i++) {
        const int own = r->scene->member[i].divisions;
        TRY(brick_init(&out[i], r->scene, i, own > 0 ? own : r->elements, node, element, f));
        node = brick_next_node(&out[i]);
        element = brick_next_element(&out[i]);
    }
    *bodies = (body_numbers){.first = node};
    return STATUS_OK;
}

static void write_deck_head(const deck_request *r, int elements, FILE *to)
{
    fprintf(to,
            "** beamwork: %s as solids with rigid faces, for CalculiX 2.20\n"
            "**CASE %s\n**ELEMENTS %d\n",
            r->scene->name, r->of, elements);
}

static void write_convention(const scene *s, FILE *to)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_COMPLIANCE) {
            fprintf(to, "**CONVENTION %s\n",
                    scene_moments_name(scene_compliance_of(&s->analysis[i])->moments));
            return;
        }
}

static void write_material(const scene *s, int member, FILE *to)
{
    const section_spec *profile = &s->section[s->member[member].section];
    fprintf(to,
            "*MATERIAL,NAME=MATERIAL%d\n*ELASTIC\n%.12e,%.12e\n"
            "*SOLID SECTION,ELSET=MEMBER%d,MATERIAL=MATERIAL%d\n",
            member, profile->young, profile->young / (2 * profile->shear_modulus) - 1, member,
            member);
}

static void write_mesh(const scene *s, const brick bricks[], const body_numbers *bodies, FILE *to)
{
    fputs("*NODE,NSET=NODES\n", to);
    for (int i = 0; i < s->members; i++)
        brick_write_nodes(&bricks[i], to);
    body_write_nodes(bodies, s, to);
    for (int i = 0; i < s->members; i++) {
        fprintf(to, "*ELEMENT,TYPE=C3D20R,ELSET=MEMBER%d\n", i);
        brick_write_elements(&bricks[i], to);
        write_material(s, i, to);
    }
    body_write(bodies, s, bricks, to);
}

static status write_areas(const scene *s, const brick bricks[], FILE *to, fault *f)
{
    for (int i = 0; i < s->members; i++) {
        section constants;
        TRY(scene_constants(s, s->member[i].section, &constants, f));
        fprintf(to, "**AREA %s: %+.3g %% of the beam's\n", scene_called(s, SCENE_MEMBERS, i).text,
                100 * (face_area(&bricks[i].face) / constants.A - 1));
    }
    return STATUS_OK;
}

static status write_with(const deck_request *r, brick bricks[], FILE *to, fault *f)
{
    const scene *s = r->scene;
    body_numbers bodies;
    TRY(make_bricks(r, bricks, &bodies, f));
    write_deck_head(r, brick_next_element(&bricks[s->members - 1]) - 1, to);
    write_convention(s, to);
    TRY(write_areas(s, bricks, to, f));
    write_mesh(s, bricks, &bodies, to);
    return answers_write(s, &bodies, to, f);
}

status deck_write(const deck_request *r, FILE *to, fault *f)
{
    const scene *s = r->scene;
    TRY(deck_check(r, f));
    brick *bricks = calloc((size_t)s->members, sizeof *bricks);
    if (bricks == NULL)
        return fault_memory(f, "a mesh of solids");
    const status outcome = write_with(r, bricks, to, f);
    free(bricks);
    return outcome;
}

enum { COMPONENTS = 6, TRANSLATIONS = 3 };

/* Newton's iterations stop at residuals of 1e-7 of the mean force and corrections of 1e-7 of the
 * largest displacement increment. The defaults of CalculiX are 5e-3 and 1e-2. */
#define CONTROLS "*CONTROLS,PARAMETERS=FIELD\n1e-7,1e-7\n"
#define PRINTS   "*NODE PRINT,NSET=BODIES,FREQUENCY=1000\nU,RF\n*END STEP\n"

typedef struct answers_writer {
    const scene *s;
    const body_numbers *bodies;
    FILE *to;
    int steps;
} answers_writer;

static void write_structure_loads(const answers_writer *w, int acting, double path)
{
    fputs("*CLOAD,OP=NEW\n", w->to);
    for (int node = 0; node < w->s->nodes; node++)
        for (int k = 0; k < COMPONENTS; k++) {
            double sum = 0;
            for (int i = 0; i < w->s->loads; i++) {
                const scene_load *l = &w->s->load[i];
                if (l->where == node && (l->kind == SCENE_MOMENT) == (k >= TRANSLATIONS))
                    sum += scene_acting_factor(w->s, acting, l->load_case) *
                           along_path_factor(l, path) * l->vector[k % TRANSLATIONS];
            }
            if (sum != 0)
                fprintf(w->to, "%d,%d,%.12e\n", body_node(w->bodies, node, k), body_direction(k),
                        sum);
        }
}

/* Writes the step to the state at `path`. The first increment is 1/increments of a nonlinear step;
 * increments 0: the step is linear. */
static void write_state(answers_writer *w, int acting, double path, int increments)
{
    if (increments > 0)
        fprintf(w->to, "*STEP,NLGEOM,INC=1000\n*STATIC,SOLVER=SPOOLES\n%.6g,1.,1e-5,1.\n" CONTROLS,
                1.0 / increments);
    else
        fputs("*STEP\n*STATIC,SOLVER=SPOOLES\n", w->to);
    body_write_state(w->bodies, w->s, acting, path, w->to);
    write_structure_loads(w, acting, path);
    fputs(PRINTS, w->to);
    w->steps++;
}

static void write_unit_load(answers_writer *w, const scene_analysis *a, int component)
{
    const scene_compliance *c = scene_compliance_of(a);
    fputs(a->follows == SCENE_NONE ? "*STEP\n" : "*STEP,PERTURBATION\n", w->to);
    fputs("*STATIC,SOLVER=SPOOLES\n", w->to);
    body_write_held(w->bodies, w->s, c->node, c->released, w->to);
    fprintf(w->to, "*CLOAD,OP=NEW\n%d,%d,1.\n" PRINTS, body_node(w->bodies, c->node, component),
            body_direction(component));
    w->steps++;
}

typedef struct printed {
    const char *what;
    int node, component, reciprocal;
} printed;

static void write_answer(const answers_writer *w, const scene_quantity *q, const printed *p,
                         double point)
{
    fprintf(w->to, "**Q %s|%s|%s|%d|%d|%d|%d|%.17g|%.17g|", q->name, q->unit, p->what, w->steps,
            body_node(w->bodies, p->node, p->component), body_direction(p->component),
            p->reciprocal, q->factor, q->offset);
    if (q->reduction == SCENE_CURVE)
        fprintf(w->to, "%.17g", q->x.factor * point + q->x.offset);
    fputc('\n', w->to);
}

static void answer_component(const answers_writer *w, const scene_quantity *q, double point)
{
    const scene_component *c = scene_component_of(q);
    const printed p = {.what = q->what.kind == SCENE_REACTION ? "forces" : "displacements",
                       .node = c->node,
                       .component = c->component};
    write_answer(w, q, &p, point);
}

static void answer_entry(answers_writer *w, const scene_quantity *q, double point)
{
    const scene_analysis *a = &w->s->analysis[q->analysis];
    const scene_entry *e = scene_entry_of(q);
    const printed p = {.what = "displacements",
                       .node = scene_compliance_of(a)->node,
                       .component = e->row,
                       .reciprocal = q->what.kind == SCENE_STIFFNESS_ENTRY};
    write_unit_load(w, a, e->column);
    write_answer(w, q, &p, point);
}

static int is_entry(const scene_quantity *q)
{
    return q->what.kind == SCENE_COMPLIANCE_ENTRY || q->what.kind == SCENE_STIFFNESS_ENTRY;
}

static void write_undeformed(answers_writer *w)
{
    for (int i = 0; i < w->s->analyses; i++) {
        const int linear = w->s->analysis[i].kind == SCENE_LINEAR, all = scene_solves_all(w->s, i);
        if (linear && !all)
            write_state(w, scene_acting_of(w->s, i), 1, 0);
        for (int k = 0; k < w->s->quantities; k++) {
            const scene_quantity *q = &w->s->quantity[k];
            if (q->analysis == i && all)
                write_state(w, scene_acting_in(w->s, q, 0), 1, 0);
            if (q->analysis == i && linear)
                answer_component(w, q, 1);
            else if (q->analysis == i && is_entry(q) && w->s->analysis[i].follows == SCENE_NONE)
                answer_entry(w, q, 0);
        }
    }
}

static void write_point(answers_writer *w, int analysis, double point)
{
    const int increments = scene_walk_of(&w->s->analysis[analysis])->steps_between;
    write_state(w, scene_acting_of(w->s, analysis), point, increments);
    for (int k = 0; k < w->s->quantities; k++)
        if (w->s->quantity[k].analysis == analysis &&
            path_points_requested(w->s, analysis, &w->s->quantity[k], point))
            answer_component(w, &w->s->quantity[k], point);
    for (int k = 0; k < w->s->quantities; k++)
        if (w->s->quantity[k].analysis != analysis &&
            path_points_requested(w->s, analysis, &w->s->quantity[k], point))
            answer_entry(w, &w->s->quantity[k], point);
}

static status answers_write(const scene *s, const body_numbers *bodies, FILE *to, fault *f)
{
    answers_writer w = {.s = s, .bodies = bodies, .to = to};
    const int path = export_is_static(s);
    path_points points;
    write_undeformed(&w);
    if (path == SCENE_NONE)
        return STATUS_OK;
    TRY(path_points_of(s, path, &points, f));
    for (int i = 0; i < points.count; i++)
        write_point(&w, path, points.value[i]);
    path_points_free(&points);
    return STATUS_OK;
}

enum { BODY_TRANSLATIONS = 3, BODY_COMPONENTS = 6 };

int body_node(const body_numbers *b, int node, int component)
{
    return b->first + 2 * node + (component >= BODY_TRANSLATIONS);
}

int body_direction(int component)
{
    return component % BODY_TRANSLATIONS + 1;
}

static void body_write_nodes(const body_numbers *b, const scene *s, FILE *to)
{
    for (int i = 0; i < s->nodes; i++)
        if (rigid_moves(s, i))
            for (int k = 0; k < BODY_COMPONENTS; k += BODY_TRANSLATIONS) {
                const double *p = s->node[i].position;
                fprintf(to, "%d,%.12e,%.12e,%.12e\n", body_node(b, i, k), p[0], p[1], p[2]);
            }
}

static void write_body(const body_numbers *b, const scene *s, int node, const brick bricks[],
                       FILE *to)
{
    fprintf(to, "*NSET,NSET=BODY%d\n", node);
    for (int i = 0; i < s->members; i++) {
        if (rigid_body(s, s->member[i].p) == node)
            brick_write_face(&bricks[i], 0, to);
        if (rigid_body(s, s->member[i].q) == node)
            brick_write_face(&bricks[i], 1, to);
    }
    fprintf(to, "*RIGID BODY,NSET=BODY%d,REF NODE=%d,ROT NODE=%d\n", node,
            body_node(b, node, SCENE_UX), body_node(b, node, SCENE_RX));
}

static void body_write(const body_numbers *b, const scene *s, const brick bricks[], FILE *to)
{
    for (int i = 0; i < s->nodes; i++)
        if (rigid_moves(s, i))
            write_body(b, s, i, bricks, to);
    fputs("*NSET,NSET=BODIES\n", to);
    for (int i = 0; i < s->nodes; i++)
        if (rigid_moves(s, i))
            for (int k = 0; k < BODY_COMPONENTS; k += BODY_TRANSLATIONS)
                fprintf(to, "%d,\n", body_node(b, i, k));
}

/* Returns the motion of a component of a node: SCENE_FREE, SCENE_HELD or a driver. */
static int mover(const scene_node *n, int component)
{
    const int axis = rigid_single_axis(n), turn = component - BODY_TRANSLATIONS;
    if (component < BODY_TRANSLATIONS)
        return n->translation[component];
    if (axis == SCENE_NONE)
        return n->angle[turn];
    return turn == axis ? n->angle[0] : SCENE_HELD;
}

static void write_boundary(const body_numbers *b, const scene *s, int acting, const double *path,
                           int node, unsigned released, FILE *to)
{
    fputs("*BOUNDARY,OP=NEW\n", to);
    for (int i = 0; i < s->nodes; i++)
        if (rigid_moves(s, i))
            for (int k = 0; k < BODY_COMPONENTS; k++) {
                const int by = mover(&s->node[i], k), direction = body_direction(k);
                if (by == SCENE_FREE || (i == node && (released >> k & 1)))
                    continue;
                const int stays = by == SCENE_HELD || path == NULL;
                fprintf(to, "%d,%d,%d,%.12e\n", body_node(b, i, k), direction, direction,
                        stays ? 0
                              : scene_acting_factor(s, acting, s->driver[by].load_case) *
                                    along_path_value(&s->driver[by], *path));
            }
}

static void body_write_state(const body_numbers *b, const scene *s, int acting, double path,
                             FILE *to)
{
    write_boundary(b, s, acting, &path, SCENE_NONE, 0, to);
}

static void body_write_held(const body_numbers *b, const scene *s, int node, unsigned released,
                            FILE *to)
{
    write_boundary(b, s, 0, NULL, node, released, to);
}

static void insert(path_points *p, double value, double last)
{
    int at = p->count;
    if (value <= 0 || value > last)
        return;
    while (at > 0 && p->value[at - 1] >= value)
        at--;
    if (at < p->count && p->value[at] == value)
        return;
    for (int i = p->count; i > at; i--)
        p->value[i] = p->value[i - 1];
    p->value[at] = value;
    p->count++;
}

static int most_points(const scene *s, const scene_path *stations)
{
    int most = stations->stations + s->quantities;
    for (int i = 0; i < s->drivers; i++)
        most += s->driver[i].stations;
    for (int i = 0; i < s->loads; i++)
        most += s->load[i].stations;
    return most;
}

static int is_about(const scene *s, int analysis, const scene_quantity *q)
{
    return q->analysis == analysis || s->analysis[q->analysis].follows == analysis;
}

static status path_points_of(const scene *s, int analysis, path_points *out, fault *f)
{
    const scene_path *stations = scene_path_of(&s->analysis[analysis]);
    const double last = stations->value[stations->stations - 1];
    *out = (path_points){.value = calloc((size_t)most_points(s, stations), sizeof(double))};
    if (out->value == NULL)
        return fault_memory(f, "a path");
    for (int i = 0; i < stations->stations; i++)
        insert(out, stations->value[i], last);
    for (int i = 0; i < s->quantities; i++)
        if (is_about(s, analysis, &s->quantity[i]) && s->quantity[i].reduction == SCENE_AT)
            insert(out, s->quantity[i].at, last);
    for (int i = 0; i < s->drivers; i++)
        for (int k = 0; k < s->driver[i].stations; k++)
            insert(out, s->driver[i].path[k], last);
    for (int i = 0; i < s->loads; i++)
        for (int k = 0; k < s->load[i].stations; k++)
            insert(out, s->load[i].path[k], last);
    return STATUS_OK;
}

void path_points_free(path_points *p)
{
    free(p->value);
    p->value = NULL;
}

static int path_points_requested(const scene *s, int analysis, const scene_quantity *q,
                                 double point)
{
    const scene_path *stations = scene_path_of(&s->analysis[analysis]);
    int is_station = 0;
    for (int i = 0; i < stations->stations; i++)
        is_station |= stations->value[i] == point;
    if (!is_about(s, analysis, q))
        return 0;
    switch (q->reduction) {
    case SCENE_AT:
        return q->at == point;
    case SCENE_CURVE:
        return is_station;
    default:
        return stations->value[stations->stations - 1] == point;
    }
}
