#include "harness/exchange/conversion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/pi.h"

enum { DIMENSIONS = 3 }; /* m, kg, s */

/* A unit as a factor times powers of m, kg, s. */
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

/* What one sign at the place of a unit says; 0: it is a symbol. */
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

/* 1: the text is a unit. */
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
                         "unit '%.40s' is unknown; write a product as N, kN, N/mm, N mm, mm/N, "
                         "rad/(N m), MPa, J, kg m/s, Hz, deg, %%, 1",
                         from);
    if (!read_unit(to, &b) || memcmp(a.power, b.power, sizeof a.power) != 0)
        return fault_set(f, STATUS_REFUSED, "unit '%.40s' cannot be converted to '%.40s'", from,
                         to);
    *factor = strcmp(from, to) == 0 ? 1 : a.factor / b.factor;
    return STATUS_OK;
}
