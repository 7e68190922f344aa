#include "harness/exchange/answers.h"

#include "cases/scene/along_path.h"
#include "harness/exchange/carried.h"
#include "harness/exchange/path_points.h"

enum { COMPONENTS = 6, TRANSLATIONS = 3 };

/* Newton's iterations stop at 1e-7 of the mean force and of the largest displacement (CalculiX by
 * itself: 5e-3 and 1e-2). */
#define CONTROLS "*CONTROLS,PARAMETERS=FIELD\n1e-7,1e-7\n"
#define PRINTS   "*NODE PRINT,NSET=BODIES,FREQUENCY=1000\nU,RF\n*END STEP\n"

typedef struct answers_writer {
    const scene *s;
    const body_numbers *bodies;
    FILE *to;
    int steps; /* written so far */
} answers_writer;

/* Loads on the same coordinate are one card. */
static void write_structure_loads(const answers_writer *w, double path)
{
    fputs("*CLOAD,OP=NEW\n", w->to);
    for (int node = 0; node < w->s->nodes; node++)
        for (int k = 0; k < COMPONENTS; k++) {
            double sum = 0;
            for (int i = 0; i < w->s->loads; i++) {
                const scene_load *l = &w->s->load[i];
                if (l->where == node && (l->kind == SCENE_MOMENT) == (k >= TRANSLATIONS))
                    sum += along_path_factor(l, path) * l->vector[k % TRANSLATIONS];
            }
            if (sum != 0)
                fprintf(w->to, "%d,%d,%.12e\n", body_node(w->bodies, node, k), body_direction(k),
                        sum);
        }
}

/* increments: first try for the step; 0: linear. */
static void write_state(answers_writer *w, double path, int increments)
{
    if (increments > 0)
        fprintf(w->to, "*STEP,NLGEOM,INC=1000\n*STATIC,SOLVER=SPOOLES\n%.6g,1.,1e-5,1.\n" CONTROLS,
                1.0 / increments);
    else
        fputs("*STEP\n*STATIC,SOLVER=SPOOLES\n", w->to);
    body_write_state(w->bodies, w->s, path, w->to);
    write_structure_loads(w, path);
    fputs(PRINTS, w->to);
    w->steps++;
}

/* A unit load on a component of the compliance's node, about the undeformed structure or the state
 * before. */
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

/* Where the answer to a quantity is printed, in the step written last. */
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
        const int linear = w->s->analysis[i].kind == SCENE_LINEAR;
        if (linear)
            write_state(w, 1, 0);
        for (int k = 0; k < w->s->quantities; k++) {
            const scene_quantity *q = &w->s->quantity[k];
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
    write_state(w, point, increments);
    for (int k = 0; k < w->s->quantities; k++)
        if (w->s->quantity[k].analysis == analysis &&
            path_points_asked(w->s, analysis, &w->s->quantity[k], point))
            answer_component(w, &w->s->quantity[k], point);
    for (int k = 0; k < w->s->quantities; k++)
        if (w->s->quantity[k].analysis != analysis &&
            path_points_asked(w->s, analysis, &w->s->quantity[k], point))
            answer_entry(w, &w->s->quantity[k], point);
}

status answers_write(const scene *s, const body_numbers *bodies, FILE *to, fault *f)
{
    answers_writer w = {.s = s, .bodies = bodies, .to = to};
    const int path = carried_static(s);
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
