#include "harness/study/meeting.h"

#include <math.h>

#include "harness/study/reach.h"

/* What a series is measured by; a curve by nothing. */
static const truth *reference_of(const sweep *s, const truths *t, int index, int quantity)
{
    const sweep_point *p = &s->point[0];
    return p->scene.quantity[quantity].reduction == SCENE_CURVE
               ? NULL
               : verdict_reference(t, p, &s->series[index].formulation, quantity);
}

int meeting_asks(const sweep *s, const truths *t, int quantity)
{
    return reference_of(s, t, 0, quantity) != NULL && reference_of(s, t, 1, quantity) != NULL;
}

int meeting_asked(const sweep *s, const truths *t)
{
    int asked = 0;
    for (int q = 0; q < s->point[0].scene.quantities; q++)
        asked += meeting_asks(s, t, q);
    return asked;
}

static int mesh_within(const sweep *s, const truths *t, int index, double level)
{
    int mesh = 0;
    for (int q = 0; q < s->point[0].scene.quantities && mesh >= 0; q++) {
        if (!meeting_asks(s, t, q))
            continue;
        const verdict v = {.series = index, .quantity = q, .truth = reference_of(s, t, index, q)};
        const int here = reach_mesh(s, &v, level);
        mesh = here < 0 || here > mesh ? here : mesh;
    }
    return mesh;
}

static double largest_error(const sweep *s, const truths *t, int index, int mesh)
{
    const scene *wanted = &s->point[0].scene;
    const solve_result *r = &s->series[index].cell[mesh].solve;
    double largest = 0;
    for (int q = 0; q < wanted->quantities; q++)
        if (meeting_asks(s, t, q))
            largest = fmax(largest, fabs(verdict_error(&wanted->quantity[q], r->quantity[q].value,
                                                       reference_of(s, t, index, q)->value)));
    return largest;
}

meeting meeting_at(const sweep *s, const truths *t, double level)
{
    meeting m;
    for (int i = 0; i < 2; i++) {
        m.mesh[i] = mesh_within(s, t, i, level);
        m.error[i] = m.mesh[i] >= 0 ? largest_error(s, t, i, m.mesh[i]) : (double)NAN;
    }
    return m;
}

int meeting_holds(const meeting *m)
{
    return m->mesh[0] >= 0 && m->mesh[1] >= 0;
}
