#include "cases/format/units.h"

#include <stdio.h>
#include <string.h>

/* Behind a word of the SI and its power; NULL: it is none. */
static const char *word_end(const char *at)
{
    static const char *const si[] = {"1", "m", "rad", "s", "kg", "N", "Pa", "J", "W", "Hz"};
    const size_t length = strcspn(at, " /^()");
    for (size_t i = 0; i < sizeof si / sizeof si[0]; i++)
        if (strlen(si[i]) == length && strncmp(si[i], at, length) == 0) {
            at += length;
            return at[0] == '^' && at[1] >= '2' && at[1] <= '9' ? at + 2 : at;
        }
    return NULL;
}

static const char *product_end(const char *at)
{
    at = word_end(at);
    while (at != NULL && *at == ' ')
        at = word_end(at + 1);
    return at;
}

/* "N m", "kg/m^3", "rad/(N m)": behind the stroke one word, or several in parentheses. */
static int is_si(const char *unit)
{
    const char *at = product_end(unit);
    if (at == NULL || *at != '/')
        return at != NULL && *at == '\0';
    const int several = at[1] == '(';
    at = several ? product_end(at + 2) : word_end(at + 1);
    return at != NULL && strcmp(at, several ? ")" : "") == 0;
}

static const struct {
    const char *unit, *remedy;
} foreign[] = {{"mm", "write 20 mm as 20e-3 and unit: m"},
               {"cm", "write 20 cm as 0.2 and unit: m"},
               {"km", "write 2 km as 2e3 and unit: m"},
               {"in", "write 2 in as 2*25.4e-3 and unit: m"},
               {"mm^2", "write 2 mm^2 as 2e-6 and unit: m^2"},
               {"mm^4", "write 2 mm^4 as 2e-12 and unit: m^4"},
               {"kN", "write 2 kN as 2e3 and unit: N"},
               {"MN", "write 2 MN as 2e6 and unit: N"},
               {"kNm", "write 2 kNm as 2e3 and unit: N m"},
               {"Nm", "write unit: N m"},
               {"m2", "write unit: m^2"},
               {"m3", "write unit: m^3"},
               {"m4", "write unit: m^4"},
               {"kg/m3", "write unit: kg/m^3"},
               {"N/m2", "write unit: Pa"},
               {"kN m", "write 2 kN m as 2e3 and unit: N m"},
               {"kJ", "write 2 kJ as 2e3 and unit: J"},
               {"kW", "write 2 kW as 2e3 and unit: W"},
               {"deg/s", "write 45 deg/s as 45*deg and unit: rad/s"},
               {"N mm", "write 2 N mm as 2e-3 and unit: N m"},
               {"N/mm", "write 2 N/mm as 2e3 and unit: N/m"},
               {"kN/m", "write 2 kN/m as 2e3 and unit: N/m"},
               {"MPa", "write 210 MPa as 210e6 and unit: Pa"},
               {"N/mm^2", "write 210 N/mm^2 as 210e6 and unit: Pa"},
               {"GPa", "write 210 GPa as 210e9 and unit: Pa"},
               {"deg", "write 45 deg as 45*deg and unit: rad"},
               {"degree", "write 45 degrees as 45*deg and unit: rad"},
               {"g", "write 2 g as 2e-3 and unit: kg"},
               {"t", "write 2 t as 2e3 and unit: kg"},
               {"ms", "write 2 ms as 2e-3 and unit: s"},
               {"kHz", "write 2 kHz as 2e3 and unit: Hz"},
               {"rpm", "write 60 rpm as 60*2*pi/60 and unit: rad/s"},
               {"-", "write unit: 1"},
               {"", "write unit: 1"}};

void units_check(const document_node *unit, mistakes *m)
{
    if (is_si(unit->text))
        return;
    for (size_t i = 0; i < sizeof foreign / sizeof foreign[0]; i++)
        if (strcmp(foreign[i].unit, unit->text) == 0) {
            document_mistake(m, unit, 0, "unit '%s': all values are SI; %s", unit->text,
                             foreign[i].remedy);
            return;
        }
    document_mistake(m, unit, 0,
                     "unit '%.40s' is unknown; all values are SI, as m, rad, N, N m, N/m, Pa, "
                     "kg/m^3, Hz, 1",
                     unit->text);
}

typedef struct named_unit {
    const char *name;
    double value; /* in SI */
} named_unit;

static const named_unit lengths[] = {{"m", 1},       {"cm", 1e-2},   {"mm", 1e-3}, {"um", 1e-6},
                                     {"in", 0.0254}, {"ft", 0.3048}, {NULL, 0}},
                        forces[] = {{"N", 1},
                                    {"mN", 1e-3},
                                    {"kN", 1e3},
                                    {"MN", 1e6},
                                    {"lbf", 4.4482216152605},
                                    {NULL, 0}},
                        stresses[] = {{"Pa", 1},
                                      {"kPa", 1e3},
                                      {"MPa", 1e6},
                                      {"GPa", 1e9},
                                      {"psi", 4.4482216152605 / (0.0254 * 0.0254)},
                                      {NULL, 0}};

static const named_unit *find_unit(const named_unit list[], const char *text, size_t length)
{
    for (; list->name != NULL; list++)
        if (strlen(list->name) == length && strncmp(list->name, text, length) == 0)
            return list;
    return NULL;
}

/* One word of the three; 0: it is told. */
static int units_read_unit(const document_node *n, const char *word, size_t length,
                           unit_system *out, double *stress, mistakes *m)
{
    const named_unit *L = find_unit(lengths, word, length), *F = find_unit(forces, word, length),
                     *S = find_unit(stresses, word, length);
    if (L != NULL && out->name_of_length == NULL) {
        out->length = L->value;
        out->name_of_length = L->name;
    } else if (F != NULL && out->name_of_force == NULL) {
        out->force = F->value;
        out->name_of_force = F->name;
    } else if (S != NULL && *stress == 0) {
        *stress = S->value;
        snprintf(out->name_of_stress, sizeof out->name_of_stress, "%s", S->name);
    } else {
        document_mistake(m, n, 0,
                         "units: '%.*s'; give one of m, cm, mm, um, in, ft and one of N, mN, kN, "
                         "MN, lbf, and for stress Pa, kPa, MPa, GPa or psi, as mm, N, MPa",
                         (int)length, word);
        return 0;
    }
    return 1;
}

void units_read(const document_node *n, mistakes *m, unit_system *out)
{
    double stress = 0;
    int good = 1;
    *out = (unit_system){.length = 1, .force = 1};
    if (n == NULL)
        return;
    if (n->kind == DOCUMENT_MAP) {
        document_mistake(m, n, 0, "units: a text is expected, as mm, N, MPa");
        return;
    }
    for (int i = 0; n->kind == DOCUMENT_LIST && good && i < n->count; i++) {
        const char *word = n->item[i]->kind == DOCUMENT_TEXT ? n->item[i]->text : "?";
        good = units_read_unit(n, word, strlen(word), out, &stress, m);
    }
    for (const char *at = n->text; n->kind == DOCUMENT_TEXT && good && *at != '\0';) {
        at += strspn(at, ", ");
        const size_t length = strcspn(at, ", ");
        good = length == 0 || units_read_unit(n, at, length, out, &stress, m);
        at += length;
    }
    if (!good)
        return;
    if (out->name_of_length == NULL || out->name_of_force == NULL) {
        document_mistake(m, n, 0, "units: of length and of force, as mm, N, MPa");
        return;
    }
    const double own = out->force / (out->length * out->length);
    if (stress == 0)
        snprintf(out->name_of_stress, sizeof out->name_of_stress, "%s/%s^2", out->name_of_force,
                 out->name_of_length);
    else if (!(stress > own * (1 - 1e-9) && stress < own * (1 + 1e-9))) {
        document_mistake(m, n, 0,
                         "units: %s are not %s/%s^2, and numbers of one scene fit each other; "
                         "leave the stress out, and give moduli in %s/%s^2",
                         out->name_of_stress, out->name_of_force, out->name_of_length,
                         out->name_of_force, out->name_of_length);
        return;
    }
    out->given = 1;
}

void units_translate(const unit_system *s, const char *unit, size_t size, char out[])
{
    static const char *const whole[][2] = {{"kg m/s", "N s"}, {"kg m^2/s", "N m s"}, {"J", "N m"}};
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    size_t used = 0;
    for (size_t i = 0; s->given && i < sizeof whole / sizeof whole[0]; i++)
        if (strcmp(unit, whole[i][0]) == 0)
            unit = whole[i][1];
    out[0] = '\0';
    while (*unit != '\0' && used + 1 < size) {
        const size_t word = strspn(unit, letters), length = word > 0 ? word : 1;
        const char *put = unit;
        size_t room = length;
        if (s->given && word == 1 && (*unit == 'm' || *unit == 'N')) {
            put = *unit == 'm' ? s->name_of_length : s->name_of_force;
            room = strlen(put);
        } else if (s->given && word == 2 && strncmp(unit, "Pa", 2) == 0) {
            put = s->name_of_stress;
            room = strlen(put);
        }
        room = room < size - 1 - used ? room : size - 1 - used;
        memcpy(out + used, put, room);
        used += room;
        out[used] = '\0';
        unit += length;
    }
}
