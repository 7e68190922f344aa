#include "harness/import_export/import_export_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/scalar.h"

enum { DIMENSIONS = 3 };

typedef struct unit_measure {
    double factor;
    int power[DIMENSIONS];
} unit_measure;

typedef struct symbol {
    const char *name;
    unit_measure is;
} symbol;

static const symbol known[] = {
    {"1", {1, {0}}},
    {"-", {1, {0}}},
    {"%", {0.01, {0}}},
    {"m", {1, {1, 0, 0}}},
    {"mm", {1e-3, {1, 0, 0}}},
    {"cm", {1e-2, {1, 0, 0}}},
    {"um", {1e-6, {1, 0, 0}}},
    {"km", {1e3, {1, 0, 0}}},
    {"in", {0.0254, {1, 0, 0}}},
    {"ft", {0.3048, {1, 0, 0}}},
    {"kg", {1, {0, 1, 0}}},
    {"g", {1e-3, {0, 1, 0}}},
    {"t", {1e3, {0, 1, 0}}},
    {"s", {1, {0, 0, 1}}},
    {"ms", {1e-3, {0, 0, 1}}},
    {"us", {1e-6, {0, 0, 1}}},
    {"min", {60, {0, 0, 1}}},
    {"N", {1, {1, 1, -2}}},
    {"mN", {1e-3, {1, 1, -2}}},
    {"kN", {1e3, {1, 1, -2}}},
    {"MN", {1e6, {1, 1, -2}}},
    {"lbf", {4.4482216152605, {1, 1, -2}}},
    {"J", {1, {2, 1, -2}}},
    {"mJ", {1e-3, {2, 1, -2}}},
    {"kJ", {1e3, {2, 1, -2}}},
    {"MJ", {1e6, {2, 1, -2}}},
    {"Pa", {1, {-1, 1, -2}}},
    {"kPa", {1e3, {-1, 1, -2}}},
    {"MPa", {1e6, {-1, 1, -2}}},
    {"GPa", {1e9, {-1, 1, -2}}},
    {"Hz", {1, {0, 0, -1}}},
    {"kHz", {1e3, {0, 0, -1}}},
    {"rad", {1, {0}}},
    {"mrad", {1e-3, {0}}},
    {"deg", {PI / 180, {0}}},
    {"rpm", {PI / 30, {0, 0, -1}}},
};

static int find_symbol(const char *name, size_t length, unit_measure *out)
{
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strlen(known[i].name) == length && strncmp(known[i].name, name, length) == 0) {
            *out = known[i].is;
            return 1;
        }
    return 0;
}

static void multiply(unit_measure *a, const unit_measure *b, int power)
{
    a->factor *= pow(b->factor, power);
    for (int i = 0; i < DIMENSIONS; i++)
        a->power[i] += power * b->power[i];
}

/* Interprets a blank, an operator or a bracket. Returns 0 for another character and for a second
 * '/'. */
static int read_sign(char c, int *side, int *depth)
{
    if (c == ' ' || c == '*')
        return 1;
    if (c == '(' || c == ')') {
        *depth += c == '(' ? 1 : -1;
        return 1;
    }
    if (c != '/' || *side < 0)
        return 0;
    *side = -1;
    return 1;
}

/* Reads a unit. Returns 0 if the text is not a unit. */
static int read_unit(const char *text, unit_measure *out)
{
    int side = 1, depth = 0, symbols = 0;
    *out = (unit_measure){1, {0}};
    while (*text != '\0') {
        if (read_sign(*text, &side, &depth)) {
            if (depth < 0 || depth > 1)
                return 0;
            text++;
            continue;
        }
        const size_t length = strcspn(text, " */^()");
        long power = 1;
        unit_measure one;
        if (length == 0 || !find_symbol(text, length, &one))
            return 0;
        text += length;
        if (*text == '^') {
            char *end;
            power = strtol(text + 1, &end, 10);
            if (end == text + 1 || labs(power) > 9)
                return 0;
            text = end;
        }
        multiply(out, &one, side * (int)power);
        symbols++;
    }
    return symbols > 0 && depth == 0;
}

status conversion_factor(const char *from, const char *to, double *factor, fault *f)
{
    unit_measure a, b;
    if (!read_unit(from, &a))
        return fault_set(f, STATUS_REFUSED,
                         "unit '%.40s' is unknown; write a product of units such as N, kN, N/mm, N "
                         "mm, mm/N, rad/(N m), MPa, J, kg m/s, Hz, deg, %%, 1",
                         from);
    if (!read_unit(to, &b) || memcmp(a.power, b.power, sizeof a.power) != 0)
        return fault_set(f, STATUS_REFUSED,
                         "unit '%.40s' cannot be converted to '%.40s'; give a unit of the same "
                         "kind, or correct the name of the quantity",
                         from, to);
    *factor = strcmp(from, to) == 0 ? 1 : a.factor / b.factor;
    return STATUS_OK;
}

const axes axes_same = {{0, 1, 2}, {1, 1, 1}};

/* Reads "x=-z" into the entry of x. Returns the rest of the text; NULL: an error. */
static const char *read_one(const char *at, axes *out, int *seen)
{
    at += strspn(at, " ");
    const int imported_axis = at[0] - 'x';
    if (imported_axis < 0 || imported_axis > 2 || at[1] != '=')
        return NULL;
    at += 2;
    const int sign = *at == '-' ? -1 : 1;
    at += *at == '-' || *at == '+';
    const int own_axis = *at - 'x';
    if (own_axis < 0 || own_axis > 2 || (*seen & (1 << imported_axis | 8 << own_axis)) != 0)
        return NULL;
    *seen |= 1 << imported_axis | 8 << own_axis;
    out->own_axis[imported_axis] = own_axis;
    out->sign[imported_axis] = sign;
    return at + 1;
}

int axes_parse(const char *text, axes *out)
{
    int seen = 0;
    for (int i = 0; i < 3 && text != NULL; i++)
        text = read_one(text, out, &seen);
    return text != NULL && text[strspn(text, " ")] == '\0';
}

/* Returns 1, or -1 if the permutation is a reflection. */
static int determinant(const axes *a)
{
    const int even = (a->own_axis[1] - a->own_axis[0] + 3) % 3 == 1;
    return (even ? 1 : -1) * a->sign[0] * a->sign[1] * a->sign[2];
}

/* Returns the component of beamwork that corresponds to a component of the other program.
 * Multiplies *sign by its sign, which for rotations and moments includes the determinant of the
 * axes (-1 for a reflection). */
static int component_of(const axes *a, int imported_axis, int *sign)
{
    const int turns = imported_axis >= SCENE_RX,
              axis = turns ? imported_axis - SCENE_RX : imported_axis - SCENE_UX;
    *sign *= a->sign[axis] * (turns ? determinant(a) : 1);
    return a->own_axis[axis] + (turns ? SCENE_RX : SCENE_UX);
}

static int *word_in(const entry_field *k, scene_quantity *q)
{
    return (int *)((char *)q + k->at);
}

/* Transforms the extracted component to the axes of beamwork. Components in axes of a section, or
 * without axes, do not change. Returns 0 for such components, otherwise 1. */
static int turn_extract(const axes *a, scene_quantity *q, int *sign)
{
    int turns = 0;
    for (const entry_field *k = quantity_type_of(q)->field; k->name != NULL; k++) {
        int *word = word_in(k, q), both = 1;
        const int imported_axis = *word - k->first;
        if (k->turns == ENTRY_AXIS) {
            *sign *= a->sign[imported_axis];
            *word = k->first + a->own_axis[imported_axis];
        } else if (k->turns != ENTRY_FIXED)
            *word = k->first +
                    component_of(a, imported_axis, k->turns == ENTRY_DIAGONAL ? &both : sign);
        turns |= k->turns != ENTRY_FIXED;
    }
    return turns;
}

/* Transforms the reduction. After a change of sign, a maximum becomes a minimum, and a rising
 * crossing becomes a falling crossing. Times, root mean squares, amplitudes of a spectrum and power
 * spectral densities do not change their sign. */
static void turn_reduction(scene_quantity *q, int *sign)
{
    static const scene_reduction other[SCENE_REDUCTIONS] = {[SCENE_MAX] = SCENE_MIN,
                                                            [SCENE_MIN] = SCENE_MAX,
                                                            [SCENE_MAX_TIME] = SCENE_MIN_TIME,
                                                            [SCENE_MIN_TIME] = SCENE_MAX_TIME};
    static const scene_direction back[] = {[SCENE_RISING] = SCENE_FALLING,
                                           [SCENE_FALLING] = SCENE_RISING,
                                           [SCENE_EITHER] = SCENE_EITHER};
    if (*sign > 0)
        return;
    if (other[q->reduction] != SCENE_LAST)
        q->reduction = other[q->reduction];
    if (scene_is_timed(q->reduction)) {
        q->passing.direction = back[q->passing.direction];
        q->passing.level = -q->passing.level;
        *sign = 1;
    }
    if (q->reduction == SCENE_RMS || q->transform != SCENE_HISTORY)
        *sign = 1;
}

static int same_reduction(const scene_quantity *a, const scene_quantity *b)
{
    return a->analysis == b->analysis && a->reduction == b->reduction && a->at == b->at &&
           a->transform == b->transform && a->passing.taper == b->passing.taper &&
           a->passing.level == b->passing.level && a->passing.order == b->passing.order &&
           a->passing.direction == b->passing.direction && a->passing.from == b->passing.from &&
           a->passing.until == b->passing.until;
}

const scene_quantity *axes_quantity(const axes *a, const scene *s, const scene_quantity *q,
                                    int *sign)
{
    *sign = 1;
    scene_quantity converted = *q;
    if (memcmp(a, &axes_same, sizeof *a) == 0 || !turn_extract(a, &converted, sign))
        return q;
    turn_reduction(&converted, sign);
    for (int i = 0; i < s->quantities; i++) {
        const scene_quantity *one = &s->quantity[i];
        if (same_reduction(one, &converted) && one->factor == q->factor &&
            one->offset == q->offset && one->what.kind == converted.what.kind &&
            entry_same(quantity_type_of(&converted)->field, one, &converted))
            return one;
    }
    return NULL;
}
