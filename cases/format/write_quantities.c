/* Quantities of a scene file. */
#include "cases/format/write_impl.h"

static void write_which(writer *w, int order)
{
    write_values_if(w, "which", order, 0);
}

static void write_where(writer *w, double place, int before)
{
    fputs(", where: ", w->to);
    write_values_number(w, place);
    fputs(before ? ", side: from" : "", w->to);
}

/* Which section of a member, and what of it. */
static void write_place(writer *w, const scene_internal *c)
{
    static const char *const resultant[] = {"N",          "Qy",       "Qz",       "Mx",
                                            "My",         "Mz",       "bimoment", "Mx_saint_venant",
                                            "Mx_warping", "Mx_wagner"},
                             *const along[] = {"", "max", "min", "largest"};
    write_values_named(w, ", member: ", SCENE_MEMBERS, c->member);
    if (c->along != SCENE_ALONG_PLACE) {
        fprintf(w->to, ", along: %s", along[c->along]);
    } else if (c->place == 0 || c->place == 1) {
        fprintf(w->to, ", end: %s", c->place == 1 ? "to" : "from");
    } else {
        write_where(w, c->place, c->before);
    }
    fprintf(w->to, ", resultant: %s", resultant[c->resultant]);
}

static void write_stress(writer *w, const scene_stress *c)
{
    static const char *const measure[] = {"von_mises", "normal_max", "normal_min"};
    write_values_named(w, ", member: ", SCENE_MEMBERS, c->member);
    if (!c->whole)
        write_where(w, c->place, c->before);
    fprintf(w->to, ", measure: %s", measure[c->measure]);
}

/* "kind: {analysis: ...", what is extracted. */
static void write_extract(writer *w, const scene_quantity *q)
{
    static const char *const key[] = {[SCENE_COORDINATE] = "displacement",
                                      [SCENE_REACTION] = "reaction",
                                      [SCENE_COMPLIANCE_ENTRY] = "compliance",
                                      [SCENE_STIFFNESS_ENTRY] = "stiffness",
                                      [SCENE_CRITICAL_FACTOR] = "critical_factor",
                                      [SCENE_GROWTH] = "growth",
                                      [SCENE_FREQUENCY] = "frequency",
                                      [SCENE_FACTOR_AT] = "factor_at",
                                      [SCENE_CRITICAL_POINT] = "critical_point",
                                      [SCENE_DRIVER_VALUE] = "motion",
                                      [SCENE_INTERNAL] = "internal",
                                      [SCENE_STRESS] = "stress",
                                      [SCENE_RATE] = "rate",
                                      [SCENE_ORIENTATION] = "orientation",
                                      [SCENE_BALANCE] = "balance",
                                      [SCENE_RELATIVE] = "relative"};
    static const char *const family[] = {"any",       "not_axial", "axial",
                                         "bending_y", "bending_z", "torsion"};
    const char *word = key[q->what.kind];
    if (q->what.kind == SCENE_BALANCE)
        word = scene_balance_in(q) < SCENE_PX ? "energy" : "momentum";
    fprintf(w->to, "%s: {", word);
    write_values_named(w, "analysis: ", SCENE_ANALYSES, q->analysis);
    switch (q->what.kind) {
    case SCENE_COORDINATE:
    case SCENE_RATE:
    case SCENE_REACTION:
        write_values_named(w, ", node: ", SCENE_NODES, scene_component_of(q)->node);
        fprintf(w->to, ", component: %s", write_values_component[scene_component_of(q)->component]);
        break;
    case SCENE_COMPLIANCE_ENTRY:
        fprintf(w->to, ", row: %s, column: %s", write_values_component[scene_entry_of(q)->row],
                write_values_component[scene_entry_of(q)->column]);
        break;
    case SCENE_INTERNAL:
        write_place(w, scene_internal_of(q));
        break;
    case SCENE_STRESS:
        write_stress(w, scene_stress_of(q));
        break;
    case SCENE_STIFFNESS_ENTRY:
        fprintf(w->to, ", component: %s", write_values_component[scene_entry_of(q)->row]);
        break;
    case SCENE_CRITICAL_FACTOR:
        fputs(scene_critical_load_of(q)->sign < 0 ? ", sign: negative" : "", w->to);
        write_which(w, scene_critical_load_of(q)->order);
        break;
    case SCENE_FREQUENCY:
        write_which(w, scene_mode_of(q)->order);
        fprintf(w->to, ", family: %s", family[scene_mode_of(q)->family]);
        write_values_if(w, "half_waves", scene_mode_of(q)->half_waves, 0);
        break;
    case SCENE_CRITICAL_POINT:
        fprintf(w->to, ", kind: %s, value: %s",
                scene_point_of(q)->kind == SCENE_LIMIT_POINT ? "limit" : "bifurcation",
                scene_point_of(q)->ordinate == SCENE_CONTROL ? "coordinate" : "factor");
        write_which(w, scene_point_of(q)->order);
        break;
    case SCENE_DRIVER_VALUE:
        fputs(", motion: ", w->to);
        write_values_motion(w, scene_driver_of(q));
        break;
    case SCENE_RELATIVE:
        write_values_named(w, ", node: ", SCENE_NODES, scene_relative_of(q)->node);
        write_values_named(w, ", from: ", SCENE_NODES, scene_relative_of(q)->from);
        fprintf(w->to, ", component: %s", write_values_component[scene_relative_of(q)->component]);
        break;
    case SCENE_ORIENTATION:
        write_values_named(w, ", node: ", SCENE_NODES, scene_orientation_of(q)->node);
        fprintf(w->to, ", row: %c, column: %c", "xyz"[scene_orientation_of(q)->row],
                "xyz"[scene_orientation_of(q)->column]);
        break;
    case SCENE_BALANCE: {
        static const char *const part[] = {"kinetic",    "strain", "energy", "work",
                                           "dissipated", "drift",  "px",     "py",
                                           "pz",         "lx",     "ly",     "lz"};
        fprintf(w->to, ", %s: %s", scene_balance_in(q) < SCENE_PX ? "of" : "component",
                part[scene_balance_in(q)]);
        break;
    }
    case SCENE_GROWTH:
    case SCENE_FACTOR_AT:
        break;
    }
}

static void write_reduction(writer *w, const scene_quantity *q)
{
    switch (q->reduction) {
    case SCENE_LAST:
        break;
    case SCENE_MAX:
        fputs(", take: max", w->to);
        break;
    case SCENE_MIN:
        fputs(", take: min", w->to);
        break;
    case SCENE_CURVE:
        fputs(", take: curve", w->to);
        break;
    case SCENE_AT:
        fputs(", at: ", w->to);
        write_values_number(w, q->at);
        break;
    case SCENE_MAX_TIME:
        fputs(", take: max_time", w->to);
        break;
    case SCENE_MIN_TIME:
        fputs(", take: min_time", w->to);
        break;
    case SCENE_CROSSING:
        fputs(", take: crossing", w->to);
        break;
    case SCENE_PERIOD:
        fputs(", take: period", w->to);
        break;
    case SCENE_PER_SECOND:
        fputs(", take: per_second", w->to);
        break;
    case SCENE_MEAN:
        fputs(", take: mean", w->to);
        break;
    case SCENE_REDUCTIONS:
        break;
    }
    fputc('}', w->to);
}

/* What of a motion, as far as it is not usual. */
static void write_passing(writer *w, const scene_quantity *q)
{
    static const char *const way[] = {"rising", "falling", "either"};
    const scene_passing *p = &q->passing;
    if (p->level == 0 && p->direction == SCENE_RISING && p->order == 0 && p->from == 0 &&
        p->until == 0)
        return;
    fprintf(w->to, ", when: {direction: %s", way[p->direction]);
    write_values_if(w, "level", p->level, 0);
    write_values_if(w, "which", p->order, 0);
    write_values_if(w, "from", p->from, 0);
    write_values_if(w, "until", p->until, 0);
    fputc('}', w->to);
}

static void write_rest(writer *w, const scene_quantity *q)
{
    fputs(", unit: ", w->to);
    write_values_quoted(w, q->unit);
    /* also where it is one: units are then what the scene says they are */
    fputs(", factor: ", w->to);
    write_values_number(w, q->factor);
    write_values_if(w, "offset", q->offset, 0);
    write_values_if(w, "near_zero", q->near_zero, 0);
    write_values_if(w, "tolerance", q->tolerance, SCENE_TOLERANCE);
    write_values_if(w, "order", q->least_order, 0);
    if (q->reduction == SCENE_CURVE) {
        fputs(q->x.is_quantity ? ", x: {quantity: " : ", x: {name: ", w->to);
        write_values_quoted(w, q->x.name);
        if (!q->x.is_quantity) {
            fputs(", unit: ", w->to);
            write_values_quoted(w, q->x.unit);
            write_values_if(w, "factor", q->x.factor, 1);
            write_values_if(w, "offset", q->x.offset, 0);
        }
        fputc('}', w->to);
    }
    write_passing(w, q);
    if (q->prediction.source != NULL) {
        fputs(", prediction: {value: ", w->to);
        write_values_number(w, q->prediction.value);
        fputs(", source: ", w->to);
        write_values_quoted(w, q->prediction.source);
        fputc('}', w->to);
    }
}

void write_quantities(writer *w)
{
    fputs(w->scene->quantities > 0 ? "quantities:\n" : "", w->to);
    for (int i = 0; i < w->scene->quantities; i++) {
        const scene_quantity *q = &w->scene->quantity[i];
        fputs("  ", w->to);
        write_values_quoted(w, q->name);
        fputs(": {", w->to);
        write_extract(w, q);
        write_reduction(w, q);
        write_rest(w, q);
        fputs("}\n", w->to);
    }
}
