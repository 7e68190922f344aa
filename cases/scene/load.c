#include "cases/scene/scene_impl.h"

#include <math.h>
#include <stdlib.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

scene_load scene_load_of(scene_load_kind kind, int where, double x, double y, double z)
{
    scene_load load = {.kind = kind,
                       .where = where,
                       .vector = {x, y, z},
                       .towards = SCENE_NONE,
                       .load_case = SCENE_NONE,
                       .feedback = {.node = SCENE_NONE, .from = SCENE_NONE}};
    load.range[1] = scene_load_along(&load) && !scene_load_within(&load);
    return load;
}

int scene_add_load(scene *s, scene_load_kind kind, int where, double x, double y, double z)
{
    const int i = scene_grow(s, &s->load, &s->loads, sizeof *s->load);
    if (i >= 0)
        s->load[i] = scene_load_of(kind, where, x, y, z);
    return i;
}

int scene_add_load_within(scene *s, scene_load_kind kind, int member, double place, double x,
                          double y, double z)
{
    const int i = scene_add_load(s, kind, member, x, y, z);
    scene_load *load = scene_load_at(s, i);
    load->range[0] = load->range[1] = place;
    return i;
}

scene_load *scene_load_at(scene *s, int i)
{
    return i >= 0 && i < s->loads ? &s->load[i] : &s->scrap.load;
}

static int scene_member_is_free(const scene_member *m)
{
    return m->pretension != 0 || m->unstressed_length != 0 || m->free_curvature[0] != 0 ||
           m->free_curvature[1] != 0;
}

int scene_is_free(const scene *s, scene_words *owner_name)
{
    for (int i = 0; i < s->loads; i++)
        if (s->load[i].kind == SCENE_TEMPERATURE && scene_load_acts(&s->load[i])) {
            if (owner_name != NULL)
                *owner_name = scene_called(s, SCENE_LOADS, i);
            return 1;
        }
    for (int i = 0; i < s->members; i++)
        if (scene_member_is_free(&s->member[i])) {
            if (owner_name != NULL)
                *owner_name = scene_called(s, SCENE_MEMBERS, i);
            return 1;
        }
    return 0;
}

/* Returns EA [N]. Returns 0 if the section varies along the member, couples elongation with other
 * strains, or has no constants. */
static double axial_stiffness(const scene *s, const scene_member *m)
{
    section c;
    int coupled = 0;
    if (scene_member_tapers(m) || scene_constants(s, m->section, &c, NULL) != STATUS_OK)
        return 0;
    for (int k = 1; k < 6; k++)
        coupled |= c.matrices && c.stiffness[k] != 0;
    return coupled ? 0 : c.matrices ? c.stiffness[0] : c.young * c.A;
}

/* Largest relative misfit for which N = EA (L - Lo)/L instead of EA (L - Lo)/Lo is accepted, where
 * Lo is the stress-free length. */
static const double most_misfit = 0.01;

/* Returns 1 if the scene has shifts of nodes, which change the lengths of members, and no
 * imperfections from modes. */
static int is_moved(const scene *s)
{
    int moved = 0;
    for (int i = 0; i < s->imperfections; i++) {
        if (s->imperfection[i].analysis != SCENE_NONE)
            return 0;
        moved |= s->imperfection[i].nodes > 0;
    }
    return moved;
}

status scene_member_elongation(const scene *s, int member, double length, double *out, fault *f)
{
    const scene_member *m = &s->member[member];
    *out = m->unstressed_length != 0 ? (m->unstressed_length - length) / length : 0;
    if (!(fabs(*out) <= most_misfit) && !is_moved(s))
        return fault_set(f, STATUS_REFUSED,
                         "%s: unstressed_length = %g m differs by more than 1 %% from the drawn "
                         "length%s, %g m, to which strains refer; give a length within 1 %% of it, "
                         "or draw the member unstressed and move its end",
                         scene_called(s, SCENE_MEMBERS, member).text, m->unstressed_length,
                         s->imperfections > 0 ? " with imperfections" : "", length);
    if (m->pretension == 0)
        return STATUS_OK;
    const double EA = axial_stiffness(s, m);
    if (!(EA > 0))
        return fault_set(f, STATUS_REFUSED,
                         "%s: pretension requires one section along the whole member, in which an "
                         "axial force causes only elongation; give 'unstressed_length' instead",
                         scene_called(s, SCENE_MEMBERS, member).text);
    *out = -m->pretension / EA;
    return STATUS_OK;
}

int scene_load_along(const scene_load *load)
{
    return load->kind != SCENE_FORCE && load->kind != SCENE_MOMENT && load->kind != SCENE_WEIGHT;
}

int scene_load_within(const scene_load *load)
{
    return load->kind == SCENE_MEMBER_FORCE || load->kind == SCENE_MEMBER_MOMENT;
}

int scene_load_turns(const scene_load *load)
{
    return load->kind == SCENE_MOMENT || load->kind == SCENE_DISTRIBUTED_MOMENT ||
           load->kind == SCENE_MEMBER_MOMENT;
}

int scene_load_acts(const scene_load *load)
{
    return vec3_norm(load->vector) > 0 || (load->varies && vec3_norm(load->last) > 0) ||
           load->tension != 0 || load->elongation != 0 || load->temperature != 0 ||
           load->gradient[0] != 0 || load->gradient[1] != 0;
}

const char *scene_heat_word(const scene_load *load)
{
    return load->elongation != 0 ? "an elongation" : "a temperature";
}

int scene_has_feedback(const scene *s)
{
    for (int i = 0; i < s->loads; i++)
        if (s->load[i].feedback.node != SCENE_NONE)
            return 1;
    return 0;
}

int scene_closes_loop(const scene *s, int analysis, int load)
{
    const scene_load *l = &s->load[load];
    return l->feedback.node != SCENE_NONE && !s->analysis[analysis].open_loops &&
           scene_acting_factor(s, scene_acting_of(s, analysis), l->load_case) != 0;
}

int scene_load_unsymmetric(const scene_load *load)
{
    return (load->follower || scene_load_turns(load)) && scene_load_acts(load);
}

void scene_set_factor(scene *s, int load, int stations, const double path[], const double factor[])
{
    if (load < 0)
        return;
    s->load[load].stations = stations;
    s->load[load].path = scene_copy(s, stations, path);
    s->load[load].factor = scene_copy(s, stations, factor);
}
