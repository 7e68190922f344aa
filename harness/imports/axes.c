#include "harness/imports/axes.h"

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
    case SCENE_RELATIVE:
    case SCENE_RATE:
    case SCENE_ORIENTATION:
    case SCENE_BALANCE:
        break;
    }
    return q->what;
}

static int same_extract(const scene_quantity *a, const scene_quantity *b)
{
    if (a->what.kind != b->what.kind)
        return 0;
    if (a->what.kind == SCENE_COORDINATE || a->what.kind == SCENE_REACTION)
        return scene_component_of(a)->node == scene_component_of(b)->node &&
               scene_component_of(a)->component == scene_component_of(b)->component;
    return scene_entry_of(a)->row == scene_entry_of(b)->row &&
           scene_entry_of(a)->column == scene_entry_of(b)->column;
}

static int has_axes(const scene_quantity *q)
{
    return q->what.kind == SCENE_COORDINATE || q->what.kind == SCENE_REACTION ||
           q->what.kind == SCENE_COMPLIANCE_ENTRY || q->what.kind == SCENE_STIFFNESS_ENTRY;
}

const scene_quantity *axes_quantity(const axes *a, const scene *s, const scene_quantity *q,
                                    int *sign)
{
    *sign = 1;
    if (!has_axes(q) || memcmp(a, &axes_same, sizeof *a) == 0)
        return q;
    scene_quantity ours = *q;
    ours.what = extract_of(a, q, sign);
    for (int i = 0; i < s->quantities; i++) {
        const scene_quantity *one = &s->quantity[i];
        if (one->analysis == q->analysis && one->reduction == q->reduction && one->at == q->at &&
            one->factor == q->factor && one->offset == q->offset && same_extract(one, &ours))
            return one;
    }
    return NULL;
}
