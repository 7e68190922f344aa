#include "cases/scene/scene.h"

#include <math.h>
#include <string.h>

#include "elements/section/section.h"

extern const quantity_type quantity_hinge;

/* Mirrors a section for a reversed member, whose axes x and y have changed direction. On the
 * opposite face of a cut, Qy and Mw (the torque due to restrained warping) keep their signs, and Qz
 * changes sign. */
static void mirror_section(section_spec *spec)
{
    section *c = &spec->constants;
    for (int i = 0; i < spec->points; i++)
        spec->point[i][0] = -spec->point[i][0];
    double *const odd[] = {&c->D[1], &c->D[3], &c->D[5], &c->D[7],       &c->F[1],
                           &c->F[3], &c->F[5], &c->F[7], &c->axes_angle, &c->centroid[0]};
    entry_mirror(entry_section, spec);
    for (size_t i = 0; i < sizeof odd / sizeof odd[0]; i++)
        *odd[i] = -*odd[i];
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) { /* stress resultants, then velocities */
            c->stiffness[6 * i + j] *= (i % 3 == 2) != (j % 3 == 2) ? -1 : 1;
            c->mass[6 * i + j] *= (i % 3 == 2) != (j % 3 == 2) ? -1 : 1;
        }
}

static void replace(scene_quantity *q, scene_extract what)
{
    what.type = q->what.type;
    q->what = what;
}

/* Reverses a quantity of internal forces. The forces act on the opposite face, and the axes x and y
 * change direction. */
static void reverse_internal(scene_quantity *q)
{
    const scene_internal what = *scene_internal_of(q);
    const int odd = what.resultant == SCENE_QZ || what.resultant == SCENE_MZ ||
                    what.resultant == SCENE_BIMOMENT;
    replace(q, what.along == SCENE_ALONG_PLACE
                   ? scene_beside(scene_internal_at(what.member, 1 - what.place, what.resultant),
                                  !what.before)
                   : scene_internal_along(what.member, what.along, what.resultant));
    if (odd && what.along != SCENE_ALONG_LARGEST)
        q->factor = -q->factor;
}

static void reverse_stress(scene_quantity *q)
{
    const scene_stress what = *scene_stress_of(q);
    if (!what.whole)
        replace(q, scene_beside(scene_stress_at(what.member, 1 - what.place, what.measure),
                                !what.before));
}

static void reverse_load(scene_load *load)
{
    const double begin = load->range[0];
    for (int k = 0; k < 2 && load->axes == SCENE_AXES_MEMBER; k++) {
        load->vector[k] = -load->vector[k];
        load->last[k] = -load->last[k];
        load->at[k] = -load->at[k];
    }
    entry_mirror(entry_load, load);
    load->range[0] = 1 - load->range[1];
    load->range[1] = 1 - begin;
    for (int k = 0; k < 3 && load->varies; k++) {
        const double first = load->vector[k];
        load->vector[k] = load->last[k];
        load->last[k] = first;
    }
}

static status reverse(scene *s, fault *f)
{
    for (int i = 0; i < s->sections; i++)
        mirror_section(&s->section[i]);
    for (int i = 0; i < s->members; i++) {
        scene_member *m = &s->member[i];
        const int p = m->p, warp_p = m->warp_p, section_p = m->section;
        if (m->curvature[0] != 0)
            return fault_set(
                f, STATUS_REFUSED,
                "%s: cannot exchange its two nodes, because the member is initially "
                "twisted and its y axis at the other end is not known; remove the twist",
                scene_called(s, SCENE_MEMBERS, i).text);
        for (int k = 0; k < 2 && m->half_waves > 0 && m->half_waves % 2 == 0; k++)
            m->bow[k] = -m->bow[k];
        m->p = m->q;
        m->q = p;
        m->section = m->section_q;
        m->section_q = section_p;
        m->warp_p = m->warp_q;
        m->warp_q = warp_p;
        const scene_release released = m->release[0];
        m->release[0] = m->release[1];
        m->release[1] = released;
        double beside[3];
        memcpy(beside, m->offset[0], sizeof beside);
        memcpy(m->offset[0], m->offset[1], sizeof beside);
        memcpy(m->offset[1], beside, sizeof beside);
        entry_mirror(entry_member, m);
    }
    for (int i = 0; i < s->loads; i++)
        if (scene_load_along(&s->load[i]))
            reverse_load(&s->load[i]);
    for (int i = 0; i < s->quantities; i++) {
        scene_quantity *q = &s->quantity[i];
        if (q->what.kind == SCENE_INTERNAL)
            reverse_internal(q);
        else if (q->what.kind == SCENE_STRESS)
            reverse_stress(q);
        else if (q->what.kind == SCENE_DEFLECTION)
            q->what.of.deflection.place = 1 - q->what.of.deflection.place;
        else if (quantity_type_of(q) == &quantity_hinge)
            return fault_set(f, STATUS_REFUSED,
                             "quantity %s refers to a released end, whose axes change when the "
                             "member is reversed; remove the quantity",
                             q->name);
    }
    return STATUS_OK;
}

/* Transforms a position on the first member, which now ends at `fraction`, to a position on the
 * first or the second member. */
static double split_place(double place, int before, double fraction, int second, int *member)
{
    const int first = before ? place <= fraction : place < fraction;
    *member = first ? 0 : second;
    return first ? place / fraction : (place - fraction) / (1 - fraction);
}

static status split_quantity(scene_quantity *q, double fraction, int second, fault *f)
{
    const int internal = q->what.kind == SCENE_INTERNAL && scene_internal_of(q)->member == 0,
              stress = q->what.kind == SCENE_STRESS && scene_stress_of(q)->member == 0;
    int member;
    if ((internal && scene_internal_of(q)->along != SCENE_ALONG_PLACE) ||
        (stress && scene_stress_of(q)->whole))
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s covers the whole of member 0, which is split; request a "
                         "position on the member",
                         q->name);
    if (internal) {
        const scene_internal what = *scene_internal_of(q);
        const double place = split_place(what.place, what.before, fraction, second, &member);
        replace(q, scene_beside(scene_internal_at(member, place, what.resultant), what.before));
    }
    if (q->what.kind == SCENE_DEFLECTION && q->what.of.deflection.member == 0)
        q->what.of.deflection.place = split_place(q->what.of.deflection.place, 1, fraction, second,
                                                  &q->what.of.deflection.member);
    if (quantity_type_of(q) == &quantity_hinge && q->what.of.reading.node[0] == 0 &&
        q->what.of.reading.component[1] == 1)
        q->what.of.reading.node[0] = second;
    if (stress) {
        const scene_stress what = *scene_stress_of(q);
        const double place = split_place(what.place, what.before, fraction, second, &member);
        replace(q, scene_beside(scene_stress_at(member, place, what.measure), what.before));
    }
    return STATUS_OK;
}

static int unused_name(const scene *s)
{
    int name = 0;
    for (int i = 0; i < s->members; i++) {
        name = s->member[i].warp_p >= name ? s->member[i].warp_p + 1 : name;
        name = s->member[i].warp_q >= name ? s->member[i].warp_q + 1 : name;
    }
    return name;
}

/* Returns the index of the section at `fraction` of the member. For a tapered member, adds this
 * section. */
static int section_between(scene *s, const scene_member *m, double fraction)
{
    section_spec spec;
    if (!scene_member_tapers(m))
        return m->section;
    section_taper_at(&s->section[m->section], &s->section[m->section_q], fraction, &spec);
    return scene_add_section(s, &spec);
}

static void cut_load(scene_load *load, double from, double to)
{
    const scene_load whole = *load;
    const double length = whole.range[1] - whole.range[0];
    for (int k = 0; k < 2; k++) {
        const double place = fmin(fmax(whole.range[k], from), to);
        double *v = k == 0 ? load->vector : load->last;
        for (int i = 0; i < 3 && whole.varies; i++)
            v[i] = ((whole.range[1] - place) * whole.vector[i] +
                    (place - whole.range[0]) * whole.last[i]) /
                   length;
        load->range[k] = (place - from) / (to - from);
    }
}

static void split_load(scene *s, int load, double fraction, int second)
{
    const scene_load whole = *scene_load_at(s, load);
    if (whole.range[1] <= fraction) {
        cut_load(scene_load_at(s, load), 0, fraction);
        return;
    }
    if (whole.range[0] >= fraction) {
        cut_load(scene_load_at(s, load), fraction, 1);
        scene_load_at(s, load)->where = second;
        return;
    }
    const int part = scene_add_load(s, whole.kind, second, 0, 0, 0);
    scene_load *l = scene_load_at(s, part);
    const scene_load empty = *l;
    *l = whole;
    l->where = second;
    l->stations = empty.stations;
    l->path = empty.path;
    l->factor = empty.factor;
    l->function = empty.function;
    memcpy(l->name, empty.name, sizeof l->name);
    cut_load(l, fraction, 1);
    cut_load(scene_load_at(s, load), 0, fraction);
    if (whole.stations > 0)
        scene_set_factor(s, part, whole.stations, whole.path, whole.factor);
    if (part >= 0 && function_copy(&l->function, &whole.function) < 0)
        s->out_of_memory = 1;
}

static status split(scene *s, double fraction, fault *f)
{
    const scene_member first = *scene_member_at(s, 0);
    const int loads = s->loads;
    double between[3], start[3], chord[3];
    if (!(fraction > 0 && fraction < 1))
        return fault_set(f, STATUS_REFUSED,
                         "a member cannot be split at the fraction %g of its length; give a "
                         "fraction between 0 and 1",
                         fraction);
    scene_end(s, 0, 0, start);
    scene_chord(s, 0, chord);
    for (int k = 0; k < 3; k++) {
        if (first.curvature[k] != 0 || first.bow[0] != 0 || first.bow[1] != 0)
            return fault_set(f, STATUS_REFUSED,
                             "member 0 is curved, but only straight members can be split; use more "
                             "elements instead");
        between[k] = start[k] + fraction * chord[k];
    }
    const int name = unused_name(s), middle = scene_add_node(s, between[0], between[1], between[2]);
    const int profile = section_between(s, &first, fraction);
    const int second = scene_add_member(s, middle, first.q, profile, first.y_axis);
    scene_member *m = scene_member_at(s, second);
    *m = first;
    m->name[0] = '\0';
    m->p = middle;
    m->section = profile;
    m->warp_p = name;
    m->release[0].count = 0;
    memset(m->offset[0], 0, sizeof m->offset[0]);
    m = scene_member_at(s, 0);
    m->q = middle;
    m->section_q = profile;
    m->warp_q = name;
    m->release[1].count = 0;
    memset(m->offset[1], 0, sizeof m->offset[1]);
    for (int i = 0; i < loads; i++)
        if (scene_load_along(&s->load[i]) && s->load[i].where == 0)
            split_load(s, i, fraction, second);
    for (int i = 0; i < s->quantities; i++)
        TRY(split_quantity(&s->quantity[i], fraction, second, f));
    return STATUS_OK;
}

status scene_edit_apply(scene *s, const scene_edit *edit, fault *f)
{
    switch (edit->kind) {
    case SCENE_EDIT_NONE:
        break;
    case SCENE_EDIT_REVERSE:
        return reverse(s, f);
    case SCENE_EDIT_SPLIT:
        return split(s, edit->amount, f);
    case SCENE_EDIT_UNIT:
        return scene_change_unit(s, edit->amount, f);
    }
    return STATUS_OK;
}
