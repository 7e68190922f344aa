#include "harness/exchange/axes.h"

#include <string.h>

#include "cases/scene/quantity_type.h"

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

static int *word_in(const entry_field *k, scene_quantity *q)
{
    return (int *)((char *)q + k->at);
}

/* What their quantity extracts, in our axes; what is in those of the section or has none stays. 1:
 * it has axes. */
static int turn_extract(const axes *a, scene_quantity *q, int *sign)
{
    int turns = 0;
    for (const entry_field *k = quantity_type_of(q)->field; k->name != NULL; k++) {
        int *word = word_in(k, q), both = 1;
        const int theirs = *word - k->first;
        if (k->turns == ENTRY_AXIS) {
            *sign *= a->sign[theirs];
            *word = k->first + a->ours[theirs];
        } else if (k->turns != ENTRY_STAYS)
            *word = k->first + component_of(a, theirs, k->turns == ENTRY_DIAGONAL ? &both : sign);
        turns |= k->turns != ENTRY_STAYS;
    }
    return turns;
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
    scene_quantity ours = *q;
    if (memcmp(a, &axes_same, sizeof *a) == 0 || !turn_extract(a, &ours, sign))
        return q;
    turn_reduction(&ours, sign);
    for (int i = 0; i < s->quantities; i++) {
        const scene_quantity *one = &s->quantity[i];
        if (same_reduction(one, &ours) && one->factor == q->factor && one->offset == q->offset &&
            one->what.kind == ours.what.kind &&
            entry_same(quantity_type_of(&ours)->field, one, &ours))
            return one;
    }
    return NULL;
}
