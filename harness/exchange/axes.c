#include "harness/exchange/axes.h"

#include <string.h>

const axes axes_same = {{0, 1, 2}, {1, 1, 1}};

/* "x=-z" into the entry of x; what follows, or NULL. */
static const char *read_one(const char *at, axes *out, int *seen)
{
    at += strspn(at, " ");
    const int theirs = at[0] - 'x';
    if (theirs < 0 || theirs > 2 || at[1] != '=')
        return NULL;
    at += 2;
    const int sign = *at == '-' ? -1 : 1;
    at += *at == '-' || *at == '+';
    const int ours = *at - 'x';
    if (ours < 0 || ours > 2 || (*seen & (1 << theirs | 8 << ours)) != 0)
        return NULL;
    *seen |= 1 << theirs | 8 << ours;
    out->ours[theirs] = ours;
    out->sign[theirs] = sign;
    return at + 1;
}

int axes_parse(const char *text, axes *out)
{
    int seen = 0;
    for (int i = 0; i < 3 && text != NULL; i++)
        text = read_one(text, out, &seen);
    return text != NULL && text[strspn(text, " ")] == '\0';
}

/* 1, or -1 where the permutation is a reflection. */
static int determinant(const axes *a)
{
    const int even = (a->ours[1] - a->ours[0] + 3) % 3 == 1;
    return (even ? 1 : -1) * a->sign[0] * a->sign[1] * a->sign[2];
}

/* A component of theirs in our axes; rotations and moments change sign with a reflection too. */
static int component_of(const axes *a, int theirs, int *sign)
{
    const int turns = theirs >= SCENE_RX, axis = turns ? theirs - SCENE_RX : theirs - SCENE_UX;
    *sign *= a->sign[axis] * (turns ? determinant(a) : 1);
    return a->ours[axis] + (turns ? SCENE_RX : SCENE_UX);
}

/* An entry of a rotation matrix: both of its vectors are seen in our axes. */
static scene_extract orientation_of(const axes *a, const scene_orientation *what, int *sign)
{
    *sign *= a->sign[what->row] * a->sign[what->column];
    return scene_orientation_entry(what->node, a->ours[what->row], a->ours[what->column]);
}

/* Energies have no axes; an angular momentum turns as a moment does. */
static scene_extract balance_of(const axes *a, scene_balance what, int *sign)
{
    if (what < SCENE_PX)
        return scene_balance_of(what);
    const int theirs =
                  what >= SCENE_LX ? SCENE_RX + (what - SCENE_LX) : SCENE_UX + (what - SCENE_PX),
              ours = component_of(a, theirs, sign);
    return scene_balance_of(ours >= SCENE_RX ? SCENE_LX + (ours - SCENE_RX) : SCENE_PX + ours);
}

/* What their quantity extracts, in our axes. */
static scene_extract extract_of(const axes *a, const scene_quantity *q, int *sign)
{
    switch (q->what.kind) {
    case SCENE_COORDINATE:
        return scene_coordinate(scene_component_of(q)->node,
                                component_of(a, scene_component_of(q)->component, sign));
    case SCENE_REACTION:
        return scene_reaction(scene_component_of(q)->node,
                              component_of(a, scene_component_of(q)->component, sign));
    case SCENE_RATE:
        return scene_rate(scene_component_of(q)->node,
                          component_of(a, scene_component_of(q)->component, sign));
    case SCENE_RELATIVE:
        return scene_relative_to(scene_relative_of(q)->node,
                                 component_of(a, scene_relative_of(q)->component, sign),
                                 scene_relative_of(q)->from);
    case SCENE_ORIENTATION:
        return orientation_of(a, scene_orientation_of(q), sign);
    case SCENE_BALANCE:
        return balance_of(a, scene_balance_in(q), sign);
    case SCENE_COMPLIANCE_ENTRY: {
        const int row = component_of(a, scene_entry_of(q)->row, sign);
        return scene_compliance_entry(row, component_of(a, scene_entry_of(q)->column, sign));
    }
    case SCENE_STIFFNESS_ENTRY: {
        int both = 1;
        return scene_stiffness_entry(component_of(a, scene_entry_of(q)->row, &both));
    }
    case SCENE_CRITICAL_FACTOR:
    case SCENE_GROWTH:
    case SCENE_FREQUENCY:
    case SCENE_FACTOR_AT:
    case SCENE_CRITICAL_POINT:
    case SCENE_DRIVER_VALUE:
    case SCENE_INTERNAL: /* in the section's own axes */
    case SCENE_STRESS:
        break;
    }
    return q->what;
}

/* Of a kind that has axes. */
static int same_extract(const scene_quantity *a, const scene_quantity *b)
{
    if (a->what.kind != b->what.kind)
        return 0;
    switch (a->what.kind) {
    case SCENE_COORDINATE:
    case SCENE_REACTION:
    case SCENE_RATE:
        return scene_component_of(a)->node == scene_component_of(b)->node &&
               scene_component_of(a)->component == scene_component_of(b)->component;
    case SCENE_RELATIVE:
        return scene_relative_of(a)->node == scene_relative_of(b)->node &&
               scene_relative_of(a)->from == scene_relative_of(b)->from &&
               scene_relative_of(a)->component == scene_relative_of(b)->component;
    case SCENE_ORIENTATION:
        return scene_orientation_of(a)->node == scene_orientation_of(b)->node &&
               scene_orientation_of(a)->row == scene_orientation_of(b)->row &&
               scene_orientation_of(a)->column == scene_orientation_of(b)->column;
    case SCENE_BALANCE:
        return scene_balance_in(a) == scene_balance_in(b);
    default:
        return scene_entry_of(a)->row == scene_entry_of(b)->row &&
               scene_entry_of(a)->column == scene_entry_of(b)->column;
    }
}

static int has_axes(const scene_quantity *q)
{
    static const int with = 1 << SCENE_COORDINATE | 1 << SCENE_REACTION | 1 << SCENE_RATE |
                            1 << SCENE_RELATIVE | 1 << SCENE_ORIENTATION | 1 << SCENE_BALANCE |
                            1 << SCENE_COMPLIANCE_ENTRY | 1 << SCENE_STIFFNESS_ENTRY;
    return with >> q->what.kind & 1;
}

/* The largest value of what turns its sign is the least one, a level that it rises through it falls
 * through; a time has no sign. */
static void turn_reduction(scene_quantity *q, int *sign)
{
    static const scene_reduction other[SCENE_REDUCTIONS] = {[SCENE_MAX] = SCENE_MIN,
                                                            [SCENE_MIN] = SCENE_MAX,
                                                            [SCENE_MAX_TIME] = SCENE_MIN_TIME,
                                                            [SCENE_MIN_TIME] = SCENE_MAX_TIME};
    static const scene_direction back[] = {[SCENE_RISING] = SCENE_FALLING,
                                           [SCENE_FALLING] = SCENE_RISING,
                                           [SCENE_EITHER] = SCENE_EITHER};
    const int times = q->reduction > SCENE_CURVE && q->reduction != SCENE_MEAN;
    if (*sign > 0)
        return;
    if (other[q->reduction] != SCENE_LAST)
        q->reduction = other[q->reduction];
    if (times) {
        q->passing.direction = back[q->passing.direction];
        q->passing.level = -q->passing.level;
        *sign = 1;
    }
}

static int same_reduction(const scene_quantity *a, const scene_quantity *b)
{
    return a->analysis == b->analysis && a->reduction == b->reduction && a->at == b->at &&
           a->passing.level == b->passing.level && a->passing.order == b->passing.order &&
           a->passing.direction == b->passing.direction && a->passing.from == b->passing.from &&
           a->passing.until == b->passing.until;
}

const scene_quantity *axes_quantity(const axes *a, const scene *s, const scene_quantity *q,
                                    int *sign)
{
    *sign = 1;
    if (!has_axes(q) || memcmp(a, &axes_same, sizeof *a) == 0)
        return q;
    scene_quantity ours = *q;
    ours.what = extract_of(a, q, sign);
    turn_reduction(&ours, sign);
    for (int i = 0; i < s->quantities; i++) {
        const scene_quantity *one = &s->quantity[i];
        if (same_reduction(one, &ours) && one->factor == q->factor && one->offset == q->offset &&
            same_extract(one, &ours))
            return one;
    }
    return NULL;
}
