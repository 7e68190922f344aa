#include "cases/format/meaning.h"

#include <stdio.h>
#include <string.h>

#include "cases/format/meaning_impl.h"
#include "cases/scene/names.h"

/* Does the node follow a motion in this component, or in any of the turns that follow each other?
 */
static int is_driven(const scene_node *n, int component)
{
    if (component < SCENE_RX)
        return n->translation[component] >= 0;
    if (n->rotation == SCENE_ROTATION_SPATIAL)
        return n->angle[component - SCENE_RX] >= 0;
    return n->angle[0] >= 0 || n->angle[1] >= 0 || n->angle[2] >= 0;
}

static void reaction(FILE *to, const scene *s, const scene_component *what)
{
    const scene_node *n = &s->node[what->node];
    fprintf(to, "%s %c", what->component >= SCENE_RX ? "moment about" : "force along",
            meaning_axis(what->component));
    meaning_node(to, s, is_driven(n, what->component) ? "that drives" : "that holds", what->node);
}

static const char *per_load(int column)
{
    return column < SCENE_RX ? "force along" : "moment about";
}

static void compliance(FILE *to, const scene *s, const scene_quantity *q)
{
    const scene_entry *e = scene_entry_of(q);
    const int node = scene_compliance_of(&s->analysis[q->analysis])->node;
    fputs(e->row < SCENE_RX ? "displacement" : "rotation", to);
    meaning_node(to, s, "of", node);
    fprintf(to, " %s %c for a small unit %s %c there", e->row < SCENE_RX ? "along" : "about",
            meaning_axis(e->row), per_load(e->column), meaning_axis(e->column));
}

static void stiffness(FILE *to, const scene *s, const scene_quantity *q)
{
    const int component = scene_entry_of(q)->row,
              node = scene_compliance_of(&s->analysis[q->analysis])->node;
    fputs("stiffness", to);
    meaning_node(to, s, "of", node);
    fprintf(to, ": small %s %c for a unit %s, all else free to follow", per_load(component),
            meaning_axis(component), component < SCENE_RX ? "displacement" : "rotation");
}

static void critical_factor(FILE *to, const scene_critical_load *load)
{
    meaning_ordinal(to, load->order);
    fprintf(to, " %s factor of the loads at which the structure buckles (linear buckling)",
            load->sign > 0 ? "positive" : "negative");
}

static void frequency(FILE *to, const scene_mode *mode)
{
    static const char *const family[] = {
        [SCENE_ANY] = "",
        [SCENE_NOT_AXIAL] = ", stretching modes left out",
        [SCENE_AXIAL] = " of the stretching modes",
        [SCENE_BENDING_Y] = " of the modes that bend along the section's y",
        [SCENE_BENDING_Z] = " of the modes that bend along the section's z",
        [SCENE_TORSION] = " of the modes that twist"};
    meaning_ordinal(to, mode->order);
    fprintf(to, " natural frequency%s", family[mode->family]);
    if (mode->half_waves > 0)
        fprintf(to, " with %d half-wave%s", mode->half_waves, mode->half_waves > 1 ? "s" : "");
}

static void critical_point(FILE *to, const scene *s, const scene_quantity *q)
{
    const scene_point *p = scene_point_of(q);
    const scene_control *control = &scene_continuation_of(&s->analysis[q->analysis])->control;
    if (p->ordinate == SCENE_LOAD_FACTOR)
        fputs("load factor", to);
    else
        meaning_coordinate(to, s, control->node, control->component);
    fputs(" at the ", to);
    meaning_ordinal(to, p->order);
    fputs(p->kind == SCENE_LIMIT_POINT ? " limit point" : " bifurcation", to);
    fputs(" of the path of the load factor", to);
}

static void motion(FILE *to, const scene *s, int driver)
{
    const scene_driver *d = &s->driver[driver];
    fprintf(to, "value of the motion %s", d->name);
    if (d->condition_driver == SCENE_NONE)
        return;
    fputs(" for which the ", to);
    meaning_coordinate(to, s, d->condition_node, d->condition_component);
    fprintf(to, " is that of the motion %s", s->driver[d->condition_driver].name);
}

/* " of member_0 (node_0 to node_1)" */
static void member(FILE *to, const scene *s, int index)
{
    fprintf(to, " of %s (%s to %s)", scene_name(s, SCENE_MEMBERS, index).text,
            scene_name(s, SCENE_NODES, s->member[index].p).text,
            scene_name(s, SCENE_NODES, s->member[index].q).text);
}

/* 0: its beginning, 1: its end. */
static void place(FILE *to, double where, int before)
{
    if (where == 0 || where == 1)
        fprintf(to, " at the %s", where == 0 ? "beginning" : "end");
    else
        fprintf(to, "%s at %.10g of the length", before ? " right before what acts" : "", where);
}

static void internal(FILE *to, const scene *s, const scene_internal *c)
{
    static const char *const resultant[SCENE_RESULTANTS] = {
        [SCENE_N] = "normal force",
        [SCENE_QY] = "shear force along the section's y",
        [SCENE_QZ] = "shear force along the section's z",
        [SCENE_MX] = "torque",
        [SCENE_MY] = "bending moment about the section's y",
        [SCENE_MZ] = "bending moment about the section's z",
        [SCENE_BIMOMENT] = "bimoment",
        [SCENE_MX_SAINT_VENANT] = "torque of Saint-Venant's torsion",
        [SCENE_MX_WARPING] = "torque of the restrained warping",
        [SCENE_MX_WAGNER] = "torque of the stresses along twisted fibres"};
    static const char *const along[] = {[SCENE_ALONG_MAX] = "largest ",
                                        [SCENE_ALONG_MIN] = "least ",
                                        [SCENE_ALONG_LARGEST] = "largest magnitude of the "};
    fprintf(to, "%s%s", c->along == SCENE_ALONG_PLACE ? "" : along[c->along],
            resultant[c->resultant]);
    if (c->along == SCENE_ALONG_PLACE)
        place(to, c->place, c->before);
    else
        fputs(" along the length", to);
    member(to, s, c->member);
}

static void stress(FILE *to, const scene *s, const scene_stress *c)
{
    static const char *const measure[] = {
        [SCENE_VON_MISES] = "largest von Mises stress",
        [SCENE_NORMAL_MAX] = "largest normal stress (tension is positive)",
        [SCENE_NORMAL_MIN] = "least normal stress (compression is negative)"};
    fputs(measure[c->measure], to);
    if (c->whole)
        fputs(" of all sections", to);
    else
        place(to, c->place, c->before);
    member(to, s, c->member);
}

static void extracted(FILE *to, const scene *s, const scene_quantity *q)
{
    switch (q->what.kind) {
    case SCENE_COORDINATE:
        meaning_coordinate(to, s, scene_component_of(q)->node, scene_component_of(q)->component);
        break;
    case SCENE_REACTION:
        reaction(to, s, scene_component_of(q));
        break;
    case SCENE_COMPLIANCE_ENTRY:
        compliance(to, s, q);
        break;
    case SCENE_STIFFNESS_ENTRY:
        stiffness(to, s, q);
        break;
    case SCENE_CRITICAL_FACTOR:
        critical_factor(to, scene_critical_load_of(q));
        break;
    case SCENE_GROWTH:
        fputs("rate at which the fastest growing small motion grows, 0 where none does", to);
        break;
    case SCENE_FREQUENCY:
        frequency(to, scene_mode_of(q));
        break;
    case SCENE_FACTOR_AT:
        fputs("load factor", to);
        break;
    case SCENE_CRITICAL_POINT:
        critical_point(to, s, q);
        return; /* which names the analysis */
    case SCENE_DRIVER_VALUE:
        motion(to, s, scene_driver_of(q));
        break;
    case SCENE_INTERNAL:
        internal(to, s, scene_internal_of(q));
        break;
    case SCENE_RELATIVE:
        meaning_relative(to, s, scene_relative_of(q));
        break;
    case SCENE_RATE:
        meaning_rate(to, s, scene_component_of(q));
        break;
    case SCENE_ORIENTATION:
        meaning_orientation(to, s, scene_orientation_of(q));
        break;
    case SCENE_BALANCE:
        meaning_balance(to, scene_balance_in(q));
        break;
    case SCENE_STRESS:
        stress(to, s, scene_stress_of(q));
        break;
    }
    meaning_state(to, s, q);
}

/* Without the name of its analysis. */
static void put_sentence(const scene *s, const scene_quantity *q, char *text, size_t size)
{
    FILE *to = fmemopen(text, size, "w");
    text[0] = '\0';
    if (to == NULL)
        return;
    extracted(to, s, q);
    if (q->factor == -1)
        fputs(", with the other sign", to);
    else if (q->factor != 1)
        fprintf(to, ", times %.10g", q->factor);
    if (q->offset != 0)
        fprintf(to, ", plus %.10g", q->offset);
    fclose(to);
    text[size - 1] = '\0';
}

/* Does another analysis of the same kind answer in the same words? */
static int has_twin(const scene *s, const scene_quantity *q, const char *text)
{
    char other[MEANING_ROOM];
    for (int i = 0; i < s->quantities; i++) {
        const scene_quantity *r = &s->quantity[i];
        if (r->analysis == q->analysis || r->what.kind != q->what.kind)
            continue;
        put_sentence(s, r, other, sizeof other);
        if (strcmp(other, text) == 0)
            return 1;
    }
    return 0;
}

void meaning_of_quantity(const scene *s, int quantity, char *text, size_t size)
{
    const scene_quantity *q = &s->quantity[quantity];
    char sentence[MEANING_ROOM];
    put_sentence(s, q, sentence, sizeof sentence);
    if (has_twin(s, q, sentence))
        snprintf(text, size, "%s (%s)", sentence, scene_name(s, SCENE_ANALYSES, q->analysis).text);
    else
        snprintf(text, size, "%s", sentence);
}
